"""Meshes that cannot be exported: one line, the right exit code, and nothing left behind."""

import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

import meshio
import pytest

from certify.kernel.hexahedron import CORNERS
from tests.commands import CHECKOUT, assert_rejects, assert_usage_error, five_a, run, to_nothing
from tests.commands import write as write_certificate


def nothing_new(folder: Path) -> Callable[[], None]:
    before = sorted(folder.rglob("*"))

    def check() -> None:
        assert sorted(folder.rglob("*")) == before

    return check


@pytest.mark.parametrize(
    ("words", "message"),
    [
        ("16_A --mesh new.vtu", "unknown pattern 16_A"),
        ("complete --mesh new.vtu", "unknown pattern complete"),
        ("5_A beautiful --mesh new.vtu", "unknown question beautiful"),
        ("5_A --mesh new.xyz", "new.xyz: unknown ending; it must be one of .vtu, .vtk, "),
        ("5_A --mesh new", "new: unknown ending;"),
        ("5_A --mesh .vtu", ".vtu: unknown ending;"),
        ("5_A --mesh .", ".: unknown ending;"),
        ("15_A --mesh new.vtu", "15_A realizable is no: there are no points"),
        ("15_A convex --mesh new.vtu", "15_A convex is no: there are no points"),
        ("5_A --mesh new.obj --hexahedron", ".obj files have no cells like a hexahedron"),
        ("5_A --mesh new.stl --hexahedron", ".stl files have no cells like a hexahedron"),
        ("5_A --mesh new.vtu --to out", "--to cannot be used with --mesh"),
        ("5_A --mesh new.vtu --core", "--core cannot be used with --mesh"),
        ("5_A --mesh new.vtu --format vtk", "--format cannot be used with --mesh"),
        ("5_A valid --to out --hexahedron", "--hexahedron cannot be used with PATTERN"),
        ("5_A valid --to out --format vtk", "--format cannot be used with PATTERN"),
        ("5_A --to out", "Missing QUESTION"),
        ("5_A valid", "Missing --to"),
        ("--to out", "Missing PATTERN, QUESTION."),
        ("--mesh new.vtu", "Missing PATTERN"),
        ("--all", "Missing --to"),
        ("5_A --all --to out", "PATTERN cannot be used with --all"),
        ("--all --to out --mesh new.vtu", "--mesh cannot be used with --all"),
        ("--all --to out --format xyz", "unknown format xyz; it must be one of .vtu, "),
        ("--all --to out --format obj --hexahedron", ".obj files have no cells"),
    ],
)
def test_usage_errors(
    root: Path, monkeypatch: pytest.MonkeyPatch, words: str, message: str
) -> None:
    monkeypatch.chdir(root)
    check = nothing_new(root)
    assert_usage_error(run(root, "export", *words.split()), message)
    check()


def test_an_open_question_has_no_mesh(root: Path) -> None:
    write_certificate(root, five_a() | {"valid": {"answer": "open"}})
    path = root / "new.vtu"
    outcome = run(root, "export", "5_A", "valid", "--mesh", str(path))
    assert_usage_error(outcome, "5_A valid is open: there are no points to export")
    assert not path.exists()
    assert run(root, "export", "5_A", "--mesh", str(path))[1] == f"5_A convex: {path}\n"


def test_a_rejected_certificate_has_no_mesh(root: Path) -> None:
    flat = [[x, y, 0] for x, y, _ in CORNERS.values()]
    write_certificate(root, five_a() | {"convex": {"answer": "yes", "points": flat}})
    check = nothing_new(root)
    outcome = run(root, "export", "5_A", "valid", "--mesh", str(root / "new.vtu"))
    assert_rejects(outcome, "certificates/5_A.json", "tetrahedron 3678 is degenerate")
    outcome = run(root, "export", "--all", "--to", str(root / "out"))
    assert_rejects(outcome, "certificates/5_A.json", "tetrahedron 3678 is degenerate")
    check()


def test_all_needs_all_certificates(root: Path) -> None:
    outcome = run(root, "export", "--all", "--to", str(root / "out"))
    assert_rejects(outcome, "certificates/6_A.json", "missing")
    assert not (root / "out").exists()


def to_a_file(path: Path) -> None:
    path.write_text("old")


@pytest.mark.parametrize("make", [to_a_file, Path.mkdir, to_nothing])
def test_nothing_is_replaced(root: Path, make: Callable[[Path], None]) -> None:
    make(root / "5_C.vtu")
    check = nothing_new(root)
    message = "5_C.vtu exists already, and no mesh replaces a file"
    (root / "5_C.vtu").rename(root / "6_C.vtu")
    for words in (["5_A", "--mesh", str(root / "6_C.vtu")], ["--all", "--to", str(root)]):
        assert_usage_error(run(root, "export", *words), message.replace("5_C", "6_C"))
    (root / "6_C.vtu").rename(root / "5_C.vtu")
    check()


@pytest.mark.usefixtures("ten")
def test_a_file_where_a_folder_should_be(root: Path) -> None:
    file = root / "file"
    file.write_text("old")
    outcome = run(root, "export", "5_A", "--mesh", str(file / "new.vtu"))
    assert_usage_error(outcome, "file")
    assert_usage_error(run(CHECKOUT, "export", "--all", "--to", str(file)), "file")
    assert file.read_text() == "old"


@pytest.fixture
def without_meshio(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "meshio", None)


@pytest.mark.usefixtures("without_meshio")
def test_without_meshio(root: Path) -> None:
    check = nothing_new(root)
    for words in (["5_A", "--mesh", str(root / "new.vtu")], ["--all", "--to", str(root / "out")]):
        message = "meshio is not installed: run pip install '.[mesh]'"
        assert_usage_error(run(root, "export", *words), message)
    check()
    assert run(root, "export", "5_A", "valid", "--to", str(root / "out"))[0] == 0


@pytest.mark.usefixtures("ten")
@pytest.mark.parametrize("error", [OSError(28, "No space left on device"), KeyboardInterrupt()])
def test_what_breaks_off_leaves_nothing(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, error: BaseException
) -> None:
    """At the last of all files."""
    original, written = meshio.write, []

    def break_off(path: Path, *args: Any, **settings: Any) -> None:
        original(path, *args, **settings)
        written.append(path)
        if len(written) == 10:
            raise error

    monkeypatch.setattr(meshio, "write", break_off)
    code, out, err = run(CHECKOUT, "export", "--all", "--to", str(tmp_path))
    assert (out, len(err.strip().splitlines())) == ("", 1)
    assert code == (1 if isinstance(error, OSError) else 130)
    assert [*tmp_path.iterdir()] == []
    assert len(written) == 10
