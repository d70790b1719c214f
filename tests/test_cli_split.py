"""certify split: what is printed and written, and what is refused in one line."""

from pathlib import Path
from typing import Any

import meshio
import numpy as np
import pytest

from certify.dimacs import read_dimacs
from certify.kernel.certificate import PATTERN_NAMES
from certify.kernel.refutation import replay
from certify.mesh.reading import read_mesh
from certify.mesh.signs import orientations
from certify.mesh.split import require_split
from certify.mesh.split.reporting import FORMATS, write_tetrahedra
from certify.mesh.split.splitting import split
from tests.commands import CHECKOUT, assert_rejects, assert_usage_error, run, run_json, to_nothing
from tests.meshes import LAID, NO, RING, grid, mixed, shuffled, warped


def written(path: Path, points: Any, cells: Any) -> str:
    meshio.write(path, meshio.Mesh(points, [*cells.items()]))
    return str(path)


@pytest.fixture
def yes(tmp_path: Path) -> str:
    return written(tmp_path / "yes.vtu", *mixed(*warped(1, 10, 3, 3, 3, 1), (0, 3), (4,)))


@pytest.fixture
def no(tmp_path: Path) -> str:
    return written(tmp_path / "no.vtu", *warped(*RING))


@pytest.mark.parametrize("ending", FORMATS)
def test_what_is_written_splits_the_mesh(tmp_path: Path, yes: str, ending: str) -> None:
    path = tmp_path / f"out{ending}"
    code, out, err = run(CHECKOUT, "split", yes, "--to", str(path))
    assert (code, err) == (0, "")
    assert f"written, read back and compared: {path}" in out
    given, found = read_mesh(Path(yes)), meshio.read(path)
    (block,) = found.cells
    assert block.type == "tetra"
    assert np.array_equal(found.points, given.points)
    assert (orientations(given.points, block.data) > 0).all()
    if ending == ".mesh":
        return
    data = {name: np.concatenate(found.cell_data[name]) for name in ("cell", "kind", "pattern")}
    kinds = {"hexahedron": 12, "wedge": 13, "pyramid": 14, "tetra": 10}
    start, owners = 0, np.zeros(len(block.data), np.int64)
    for kind, number in kinds.items():
        own = data["kind"] == number
        owners[own] = data["cell"][own].astype(np.int64) - 1 + start
        start += len(given.cells[kind])
    require_split(given.points, given.cells, block.data.astype(np.int64), owners)
    laid = (data["kind"] == 12) & (data["pattern"] == 0)
    quads = {
        frozenset(row) for row in split(given.points, given.cells).faces.quadrilaterals.tolist()
    }
    assert all(frozenset(row) in quads for row in block.data[laid].tolist())
    assert data["pattern"].max() <= len(PATTERN_NAMES)
    assert data["pattern"][data["kind"] != 12].max() == 0
    for cell in set(data["cell"][data["kind"] == 12]):
        own = (data["cell"] == cell) & (data["kind"] == 12) & ~laid
        (pattern,) = set(data["pattern"][own].astype(int))
        assert int(PATTERN_NAMES[pattern - 1].partition("_")[0]) == own.sum()


def test_a_file_that_differs_is_refused(
    tmp_path: Path, yes: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    read = meshio.read

    def moved(path: Path) -> Any:
        mesh = read(path)
        if path.name == "out.vtk":
            mesh.points[3, 1] += 1e-9
        return mesh

    monkeypatch.setattr(meshio, "read", moved)
    outcome = run(CHECKOUT, "split", yes, "--to", str(tmp_path / "out.vtk"))
    assert_rejects(outcome, "out.vtk", "has other cells or coordinates when it is read back")
    assert [path.name for path in tmp_path.iterdir()] == ["yes.vtu"]


def test_yes_is_printed_beside_two_recipes(tmp_path: Path) -> None:
    mesh = written(tmp_path / "mesh.vtk", *shuffled(1, *warped(1, 10, 5, 4, 4, 4)))
    code, out, _ = run(CHECKOUT, "split", mesh)
    assert code == 0
    lines = out.splitlines()
    assert max(map(len, lines[1:])) <= 80
    assert any(
        line.split() == ["this", "split", "by", "numbers", "by", "template"] for line in lines
    )
    ways = next(line for line in lines if line.startswith("quadrilaterals cut in two ways"))
    assert ways.split()[-3:-1] == ["0", "0"]
    assert int(ways.split()[-1]) > 0
    assert "patterns of the hexahedra: " in out


def test_the_record_has_what_is_printed(yes: str) -> None:
    out = str(Path(yes).with_name("out.vtu"))
    code, record = run_json(CHECKOUT, "split", yes, "--quality", "best", "--to", out)
    assert code == 0
    assert record["written"] == out
    assert record["split"] == "yes"
    assert record["cells"] == {"hexahedron": 6, "wedge": 4, "pyramid": 6, "tetra": 1}
    assert record["tetrahedra"]["inverted_or_flat"] == 0
    assert record["tetrahedra"]["least_dihedral"] > 0
    assert sum(record["patterns"].values()) == 6
    assert record["unfillable"] == record["contradictions"] == []


def test_boundary_tetrahedra_are_counted(tmp_path: Path) -> None:
    mesh = written(tmp_path / "mesh.vtu", *warped(*LAID))
    code, record = run_json(CHECKOUT, "split", mesh)
    assert code == 0
    assert record["laid_on_facets"] > 0
    assert "laid on them" in run(CHECKOUT, "split", mesh)[1]


def test_a_no_comes_with_a_proof(tmp_path: Path, no: str) -> None:
    folder = tmp_path / "proof"
    code, out, err = run(CHECKOUT, "split", no, "--proof", str(folder))
    assert (code, err) == (1, "")
    assert "4 cells contradict each other" in out
    assert "no fewer cells do" in " ".join(out.split())
    assert max(map(len, out.splitlines()[1:-1])) <= 80
    text = (folder / "contradiction-1.cnf").read_text()
    formula = read_dimacs(text)
    proof = (folder / "contradiction-1.lrat").read_text()
    assert replay(formula, proof) == len(proof.splitlines())
    assert text.count(": quadrilateral ") == max(abs(x) for clause in formula for x in clause)
    _, record = run_json(CHECKOUT, "split", no)
    (own,) = record["contradictions"]
    assert own["clauses"] == len(formula)
    assert own["smallest"]
    assert all(cell in text for cell in own["cells"])
    assert {path.name for path in folder.iterdir()} == {
        "contradiction-1.cnf",
        "contradiction-1.lrat",
    }


def test_a_no_writes_no_mesh(tmp_path: Path, no: str) -> None:
    assert run(CHECKOUT, "split", no, "--to", str(tmp_path / "out.vtu"))[0] == 1
    assert [path.name for path in tmp_path.iterdir()] == ["no.vtu"]


def test_a_yes_writes_no_proof(tmp_path: Path, yes: str) -> None:
    code, out, _ = run(CHECKOUT, "split", yes, "--proof", str(tmp_path / "proof"))
    assert code == 0
    assert "no cells contradict each other" in out
    assert not (tmp_path / "proof").exists()


def test_cells_that_cannot_be_filled_are_named(tmp_path: Path) -> None:
    points, cells = grid(3, 1, 1)
    points[[0, 1]] = points[[1, 0]]
    mesh = written(tmp_path / "mesh.vtu", points, cells)
    code, out, _ = run(CHECKOUT, "split", mesh)
    assert code == 1
    assert "no tetrahedra fill 1 cell:\n  hexahedron 1: " in out
    record = run_json(CHECKOUT, "split", mesh)[1]
    assert [own["cell"] for own in record["unfillable"]] == ["hexahedron 1"]
    assert record["unfillable"][0]["boundaries"] == 64


def test_many_cells_that_cannot_be_filled_are_counted(tmp_path: Path) -> None:
    points, cells = grid(30, 1, 1)
    points[:, 1] *= (-1) ** points[:, 0]
    mesh = written(tmp_path / "mesh.vtu", points, cells)
    out = run(CHECKOUT, "split", mesh)[1]
    assert "30 cells, each by itself" in out
    assert "  and 20 more, which --json lists" in out
    assert len(run_json(CHECKOUT, "split", mesh)[1]["unfillable"]) == 30


def test_bad_meshes_are_refused_in_one_line(tmp_path: Path) -> None:
    points, cells = grid(2, 1, 1)
    rows = cells["hexahedron"]
    inverted = written(tmp_path / "inverted.vtu", points, {"hexahedron": np.roll(rows, 4, axis=1)})
    assert_rejects(run(CHECKOUT, "split", inverted), "inverted.vtu", "hexahedron 1 (and 1 more)")
    double = written(tmp_path / "double.vtu", points, {"hexahedron": rows[[0, 1, 1]]})
    assert_rejects(run(CHECKOUT, "split", double), "double.vtu", "have the same vertices")
    two = np.concatenate([points, points + 0.25])
    cells = {"hexahedron": np.concatenate([rows[:1], rows[:1] + len(points)])}
    overlapping = written(tmp_path / "overlapping.vtu", two, cells)
    assert_rejects(
        run(CHECKOUT, "split", overlapping, "--to", str(tmp_path / "out.vtu")),
        *("overlapping.vtu", "hexahedron 1 and hexahedron 2 overlap"),
    )
    assert not (tmp_path / "out.vtu").exists()
    (tmp_path / "empty.vtu").write_text("")
    assert_rejects(
        run(CHECKOUT, "split", str(tmp_path / "empty.vtu")), "empty.vtu", "nothing in it"
    )


def test_usage_errors(tmp_path: Path, yes: str) -> None:
    for words, fault in {
        ("--quality", "good"): "unknown quality good; it must be one of greedy, best, none",
        ("--to", str(tmp_path / "out.stl")): "unknown ending; it must be one of .vtu, .vtk,",
        ("--to", yes): "exists already, and no mesh replaces a file",
    }.items():
        assert_usage_error(run(CHECKOUT, "split", yes, *words), fault)
    to_nothing(tmp_path / "link.vtu")
    link = str(tmp_path / "link.vtu")
    assert_usage_error(run(CHECKOUT, "split", yes, "--to", link), "exists already")
    assert_usage_error(run(CHECKOUT, "split", str(tmp_path / "none.vtu")), "none.vtu: No such file")
    assert_usage_error(run(CHECKOUT, "split", yes, "--to", f"{yes}/out.vtu"), "is not a folder")


def test_coordinates_that_are_no_doubles_are_not_written(tmp_path: Path) -> None:
    from fractions import Fraction  # noqa: PLC0415

    from certify.mesh.files import NotExact  # noqa: PLC0415

    points, cells = grid(1, 1, 1)
    thirds = np.array([[Fraction(int(x), 3) for x in point] for point in points], object)
    with pytest.raises(NotExact, match="no double"):
        write_tetrahedra(tmp_path / "out.vtu", split(thirds, cells))
    with pytest.raises(ValueError, match="no tetrahedra"):
        write_tetrahedra(tmp_path / "out.vtu", split(*warped(*NO[0])))
