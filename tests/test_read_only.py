"""A checkout is only read: by what checks, by what audits, and by what exports to elsewhere."""

import os
import shutil
import stat
import subprocess
import sys
from pathlib import Path

import pytest

from certify.manifest import NAME
from tests.commands import CHECKOUT

READING = [
    "check-all --jobs 2 --junit OUT/report.xml",
    "audit",
    "check 8_E 15_A",
    "show 15_K",
    "list",
    "export 15_A realizable --to OUT",
    "export complete a --core --to OUT",
    "export 8_E valid --to OUT",
    "export 8_E --mesh OUT/8_E.vtu",
]
WRITING = [
    "export 8_E valid --to inside",
    "export 8_E --mesh 8_E.vtu",
    "check-all --junit report.xml",
    "build",
]

LOCKED = """
mount --bind . . && mount -o remount,bind,ro . && cd "$PWD" || exit 99
exec "$@"
"""
"""For root, whom modes do not stop: a mount that only this process sees."""


@pytest.fixture
def copy(tmp_path: Path) -> Path:
    """Return a copy of the code and the evidence."""
    checkout = tmp_path / "checkout"
    for folder in ("certify", "certificates", "proofs"):
        ignored = shutil.ignore_patterns("__pycache__")
        shutil.copytree(CHECKOUT / folder, checkout / folder, ignore=ignored)
    shutil.copy(CHECKOUT / NAME, checkout)
    (tmp_path / "OUT").mkdir()
    return checkout


def run(
    checkout: Path, command: str, *before: str, **environment: str
) -> "subprocess.CompletedProcess[str]":
    words = [word.replace("OUT", str(checkout.parent / "OUT")) for word in command.split()]
    return subprocess.run(
        [*before, sys.executable, "-m", "certify", *words],
        cwd=checkout,
        env=os.environ | {"PYTHONPATH": str(checkout)} | environment,
        capture_output=True,
        text=True,
        check=False,
    )


def state(folder: Path) -> dict[str, tuple[int, int]]:
    """Return what there is, with mode and time of the last change."""
    paths = [folder, *folder.rglob("*")]
    return {str(path): (path.stat().st_mode, path.stat().st_mtime_ns) for path in paths}


def test_nothing_is_written(copy: Path) -> None:
    before = state(copy)
    for command in READING:
        result = run(copy, command, PYTHONDONTWRITEBYTECODE="1")
        assert (result.returncode, result.stderr) == (0, ""), command
    assert state(copy) == before
    assert len(list((copy.parent / "OUT").iterdir())) == 1 + 3 + 3 + 1 + 1


@pytest.fixture
def locked(copy: Path) -> tuple[str, ...]:
    """Take the right to write from a copy, and return what a command has to begin with."""
    for path in (copy, *copy.rglob("*")):
        path.chmod(path.stat().st_mode & ~(stat.S_IWUSR | stat.S_IWGRP | stat.S_IWOTH))
    before = ("unshare", "--mount", "bash", "-c", LOCKED, "bash") if os.geteuid() == 0 else ()
    try:
        touched = subprocess.run(
            [*before, "touch", "x"], cwd=copy, capture_output=True, check=False
        )
    except OSError as error:
        pytest.skip(f"nothing is read-only for root here: {error}")
    if touched.returncode != 1:
        pytest.skip("nothing is read-only for root here")
    return before


def test_a_read_only_checkout_does(copy: Path, locked: tuple[str, ...]) -> None:
    for command in READING:
        result = run(copy, command, *locked)
        assert (result.returncode, result.stderr) == (0, ""), command


@pytest.mark.parametrize("command", WRITING)
def test_what_would_write_to_it_says_so(copy: Path, locked: tuple[str, ...], command: str) -> None:
    result = run(copy, command, *locked)
    (line,) = result.stderr.splitlines()
    assert (result.returncode, result.stdout) == (2, "")
    assert line.endswith((": Read-only file system", ": Permission denied", "is not writable."))
