"""Nothing is half written: full disks, interrupts, and processes that are killed."""

import os
import signal
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from certify import writing
from tests.commands import CHECKOUT, run, spawn

OLD = {name: f"old {name}".encode() * 999 for name in ("a", "b", "c")}
NEW = {name: content.replace(b"old", b"new") for name, content in OLD.items()}


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    """Return a folder with the old files."""
    for name, content in OLD.items():
        (tmp_path / name).write_bytes(content)
    return tmp_path


def contents(folder: Path) -> dict[str, bytes]:
    return {path.name: path.read_bytes() for path in folder.iterdir() if path.is_file()}


def leftovers(folder: Path) -> list[str]:
    return [path.name for path in folder.iterdir() if path.is_dir()]


def test_files_take_their_places(folder: Path) -> None:
    written = writing.write_files(folder, NEW)
    assert written == [folder / name for name in NEW]
    assert (contents(folder), leftovers(folder)) == (NEW, [])


def test_a_new_folder_and_its_files_have_the_usual_modes(tmp_path: Path) -> None:
    (tmp_path / "usual").mkdir()
    (tmp_path / "usual" / "a").touch()
    writing.write_files(tmp_path / "new", NEW)
    for name in (".", "a"):
        usual, new = (tmp_path / kind / name for kind in ("usual", "new"))
        assert new.stat().st_mode == usual.stat().st_mode


@pytest.mark.parametrize("error", [OSError(28, "No space left on device"), KeyboardInterrupt()])
@pytest.mark.parametrize("method", ["write_bytes", "replace"])
def test_what_breaks_off_leaves_whole_files(
    folder: Path, monkeypatch: pytest.MonkeyPatch, method: str, error: BaseException
) -> None:
    """At the second file. The places are taken only when all files are complete."""
    original: Callable[..., object] = getattr(Path, method)

    def break_off(path: Path, argument: Any) -> object:
        if path.name != "b":
            return original(path, argument)
        path.write_text("half")
        raise error

    monkeypatch.setattr(Path, method, break_off)
    with pytest.raises(type(error)) as raised:
        writing.write_files(folder, NEW)
    if isinstance(error, OSError):
        assert str(raised.value) == f"[Errno 28] No space left on device: '{folder}'"
    first = NEW if method == "replace" else OLD
    assert (contents(folder), leftovers(folder)) == (OLD | {"a": first["a"]}, [])


KILLED = """
import os, pathlib, signal, sys
from certify.writing import write_files
from tests.test_writing import NEW

folder, method, name = sys.argv[1:]
original = getattr(pathlib.Path, method)

def kill(path, argument):
    if path.name == name:
        path.write_text("half")
        os.kill(os.getpid(), signal.SIGKILL)
    return original(path, argument)

setattr(pathlib.Path, method, kill)
write_files(pathlib.Path(folder), NEW)
"""


@pytest.mark.parametrize("name", OLD)
@pytest.mark.parametrize("method", ["write_bytes", "replace"])
def test_a_killed_process_leaves_whole_files(folder: Path, method: str, name: str) -> None:
    command = [sys.executable, "-c", KILLED, str(folder), method, name]
    killed = subprocess.run(command, cwd=CHECKOUT, check=False)
    assert killed.returncode == -signal.SIGKILL
    replaced = [other for other in OLD if other < name and method == "replace"]
    assert contents(folder) == OLD | {other: NEW[other] for other in replaced}
    (scratch,) = leftovers(folder)
    assert scratch.startswith(".certify-")
    writing.write_files(folder, NEW)
    assert contents(folder) == NEW


def test_a_symbolic_link_is_followed(folder: Path) -> None:
    (folder / "below").mkdir()
    (folder / "below" / "link").symlink_to("../a")
    writing.write_file(folder / "below" / "link", NEW["a"])
    assert contents(folder) == OLD | {"a": NEW["a"]}
    assert (folder / "below" / "link").is_symlink()


# By commands.


def test_a_pipe_is_written_to(root: Path) -> None:
    written = spawn(
        "check-all", "--json", "--root", str(root), "--junit", "/dev/stdout", capture_output=True
    )
    assert written.stdout.startswith("<?xml")
    assert Path("/dev/stdout").exists()


@pytest.mark.skipif(not Path("/dev/full").exists(), reason="there is no /dev/full")
def test_a_full_disk(root: Path) -> None:
    line = "No space left on device\n"
    outcome = run(root, "check-all", "--junit", "/dev/full")
    assert outcome == (1, "", f"certify: {line}")
    with Path("/dev/full").open("w") as full:
        result = spawn("list", "--root", str(root), stdout=full, stderr=subprocess.PIPE)
    assert (result.returncode, result.stderr) == (1, f"certify: {line}")


def test_no_room_for_an_export(root: Path, tmp_path: Path) -> None:
    """The limit on the size of a file is less than that of the formula, more than of the proof."""
    out = tmp_path / "out"
    command = [sys.executable, "-m", "certify", "export", "15_A", "realizable", "--root", str(root)]
    assert run(root, "export", "15_A", "realizable", "--core", "--to", str(out))[0] == 0
    before = contents(out)
    result = subprocess.run(
        ["bash", "-c", 'ulimit -f 100; exec "$@"', "bash", *command, "--to", str(out)],
        cwd=CHECKOUT,
        env=os.environ | {"PYTHONDONTWRITEBYTECODE": "1"},
        capture_output=True,
        text=True,
        check=False,
    )
    assert (result.returncode, result.stdout) == (1, "")
    assert result.stderr == f"certify: {out}: File too large\n"
    assert (contents(out), leftovers(out)) == (before, [])


@pytest.mark.parametrize(
    "command", [("export", "5_A", "valid", "--to"), ("check-all", "--junit")], ids=lambda c: c[0]
)
def test_a_folder_that_cannot_be_written_to(
    root: Path, monkeypatch: pytest.MonkeyPatch, command: tuple[str, ...]
) -> None:
    def refuse(*_: object, **__: object) -> None:
        raise PermissionError(13, "Permission denied", "/somewhere/.certify-x")

    monkeypatch.setattr(writing, "TemporaryDirectory", refuse)
    place = root / "report.xml" if "--junit" in command else root
    code, out, err = run(root, *command, str(place))
    assert (code, out, err) == (2, "", f"certify: {root}: Permission denied\n")
