"""Closed and full outputs, killed processes, a bad environment: one line, and never a traceback."""

import os
import signal
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path
from time import sleep
from typing import NoReturn

import pytest

from certify import __version__
from tests.commands import CHECKOUT

pytestmark = pytest.mark.skipif(os.name != "posix", reason="a shell closes the outputs")

CERTIFY, DOOR = "certify", "certify.kernel"
LONG = "x" * 5000


def shell(module: str, line: str, **environment: str) -> "subprocess.CompletedProcess[str]":
    """Run a module with arguments and redirections, as a shell does."""
    return subprocess.run(
        ["bash", "-c", f'set -o pipefail; "$0" -m {module} {line}', sys.executable],
        cwd=CHECKOUT,
        env=os.environ | environment,
        capture_output=True,
        text=True,
        check=False,
    )


@pytest.mark.parametrize(
    ("module", "line"),
    [
        (CERTIFY, "check-all"),
        (CERTIFY, "check-all --jobs 2"),
        (CERTIFY, "audit"),
        (DOOR, ""),
    ],
)
def test_standard_error_may_be_closed(module: str, line: str) -> None:
    closed, open_ = (shell(module, f"{line} {end}") for end in ("2>&-", ""))
    assert (closed.returncode, open_.returncode) == (0, 0)
    assert closed.stdout.splitlines()[:-1] == open_.stdout.splitlines()[:-1] != []


@pytest.mark.parametrize("line", ["--version", "--help", "check 5_A", "list --json"])
def test_both_may_be_closed(line: str) -> None:
    done = shell(CERTIFY, f"{line} >&- 2>&-")
    assert (done.returncode, done.stdout, done.stderr) == (1, "", "")


def test_usage_error_without_standard_error() -> None:
    assert shell(CERTIFY, "frobnicate 2>&-").returncode == 2
    assert shell(CERTIFY, "frobnicate 2>/dev/full").returncode == 2


FULL = "No space left on device"


@pytest.mark.parametrize(
    ("module", "line", "words"),
    [
        *(
            (CERTIFY, f"{line} {end}", words)
            for line in ("--version", "--help", "check --help", "check 5_A", "show 5_A --json")
            for end, words in ((">&-", "standard output is closed"), (">/dev/full", FULL))
        ),
        (CERTIFY, "check-all --jobs 2 >&-", "standard output is closed"),
        (CERTIFY, "check-all --jobs 2 >/dev/full", FULL),
        (DOOR, ">&-", "standard output is closed"),
        (DOOR, "--help >/dev/full", FULL),
        (DOOR, ">/dev/full", FULL),
        (DOOR, "| head -c 0", "Broken pipe"),
        (DOOR, LONG, "File name too long"),
    ],
)
def test_one_line_and_exit_code_one(module: str, line: str, words: str) -> None:
    done = shell(module, line)
    assert (done.returncode, done.stdout) == (1, "")
    assert len(done.stderr.splitlines()) == 1
    assert words in done.stderr


@pytest.mark.parametrize("root", [LONG, "README.md", "nowhere"])
def test_root_that_is_none(root: str) -> None:
    done = shell(CERTIFY, f"check-all --root {root}")
    assert (done.returncode, done.stdout) == (2, "")
    assert len(done.stderr.splitlines()) == 1


def test_door_of_a_file() -> None:
    done = shell(DOOR, "README.md")
    assert (done.returncode, done.stderr) == (2, "")
    assert len(done.stdout.splitlines()) == 1


SETTINGS = [
    {"SYMPY_USE_CACHE": "maybe"},
    {"SYMPY_DEBUG": "x"},
    {"SYMPY_CACHE_SIZE": "x"},
    {"SYMPY_GROUND_TYPES": "nonsense", "PYTHONWARNINGS": "error::UserWarning"},
]


@pytest.mark.parametrize("setting", SETTINGS, ids=lambda setting: next(iter(setting)))
@pytest.mark.parametrize(
    ("module", "line"),
    [(CERTIFY, "check-all"), (CERTIFY, "show 5_A"), (CERTIFY, "spheres"), (DOOR, "")],
)
def test_setting_that_sympy_refuses(module: str, line: str, setting: dict[str, str]) -> None:
    done = shell(module, line, **setting)
    assert (done.returncode, done.stdout) == (1, "")
    assert len(done.stderr.splitlines()) == 1
    assert "cannot be imported: " in done.stderr


def test_help_needs_no_sympy() -> None:
    assert shell(CERTIFY, "--version", **SETTINGS[0]).stdout == f"certify {__version__}\n"
    assert shell(CERTIFY, "frobnicate", **SETTINGS[0]).returncode == 2


# Folders without permissions, for users whom that keeps out


needs_permissions = pytest.mark.skipif(
    not hasattr(os, "geteuid") or os.geteuid() == 0, reason="this user reads everything"
)


@pytest.fixture
def closed(root: Path) -> Iterator[Path]:
    """Return a root whose certificates cannot be listed, nor read."""
    (root / "certificates").chmod(0)
    yield root
    (root / "certificates").chmod(0o700)


@needs_permissions
@pytest.mark.parametrize(("module", "option"), [(CERTIFY, "check-all --root"), (DOOR, "")])
def test_certificates_that_cannot_be_listed(closed: Path, module: str, option: str) -> None:
    done = shell(module, f"{option} '{closed}'")
    assert (done.returncode, done.stderr) == (1, "")
    assert "rejected: certificates: the folder cannot be listed: Permission denied" in done.stdout


@needs_permissions
@pytest.mark.parametrize(("module", "option"), [(CERTIFY, "check-all --root"), (DOOR, "")])
def test_root_that_cannot_be_searched(root: Path, module: str, option: str) -> None:
    root.chmod(0)
    done = shell(module, f"{option} '{root}'")
    root.chmod(0o700)
    assert done.returncode in (1, 2)
    assert len((done.stdout + done.stderr).splitlines()) == 1


# Processes that are killed


WAITING = """
from certify.cli import main
from certify.kernel import theorems
from tests.test_surroundings import work_for_ever

theorems.check_pattern = work_for_ever
main()
"""


def work_for_ever(root: Path, _: str) -> NoReturn:
    """Tell who does this."""
    (root / f"worker-{os.getpid()}").touch()
    while True:
        sleep(1)


@pytest.fixture
def working(root: Path) -> Iterator[tuple["subprocess.Popen[str]", list[int]]]:
    """Return check-all in two processes that never end, and these two."""
    command = ["check-all", "--jobs", "2", "--root", str(root)]
    process = subprocess.Popen(
        [sys.executable, "-c", WAITING, *command], cwd=CHECKOUT, stderr=subprocess.PIPE, text=True
    )
    while len(found := sorted(root.glob("worker-*"))) < 2 and process.poll() is None:
        sleep(0.05)
    yield process, [int(path.name.removeprefix("worker-")) for path in found]
    process.kill()
    process.communicate()


def is_running(process: int) -> bool:
    """Is there such a process, and not only what is left of it until somebody asks?"""
    try:
        state = Path(f"/proc/{process}/stat").read_text().rpartition(")")[2].split()[0]
    except FileNotFoundError:
        return False
    return state != "Z"


needs_proc = pytest.mark.skipif(not Path("/proc/self/stat").exists(), reason="there is no /proc")


@needs_proc
def test_no_process_outlives_its_parent(
    working: tuple["subprocess.Popen[str]", list[int]],
) -> None:
    parent, workers = working
    assert [is_running(worker) for worker in workers] == [True, True]
    parent.kill()
    parent.wait()
    for _ in range(1200):  # a minute, on a machine that has other things to do
        if not any(map(is_running, workers)):
            break
        sleep(0.05)
    assert [is_running(worker) for worker in workers] == [False, False]


def test_a_killed_process_is_told_in_one_line(
    working: tuple["subprocess.Popen[str]", list[int]],
) -> None:
    parent, workers = working
    os.kill(workers[0], signal.SIGKILL)
    _, told = parent.communicate(timeout=300)
    assert (parent.returncode, told) == (1, "certify: a process that checks was killed\n")
