"""The census of a mesh, as a user meets it."""

from pathlib import Path
from typing import Any

import meshio
import numpy as np
import pytest

from certify.kernel.hexahedron import CORNERS
from certify.mesh import census
from certify.mesh.census.random import random_mesh
from certify.mesh.census.tally import NotConfirmed, Run, confirmed
from certify.mesh.reading import read_mesh
from tests.commands import CHECKOUT, assert_rejects, assert_usage_error, run, run_json

CUBE = np.array([*CORNERS.values()], float)
FIVE = np.array([[0, 1, 2, 5], [0, 2, 3, 7], [0, 2, 5, 7], [0, 4, 5, 7], [2, 5, 6, 7]])


def write(path: Path, points: Any, tetrahedra: Any) -> Path:
    meshio.write(path, meshio.Mesh(points, [("tetra", tetrahedra)]))
    return path


@pytest.fixture
def cube(tmp_path: Path) -> Path:
    return write(tmp_path / "cube.vtu", CUBE, FIVE)


def test_a_cube(cube: Path) -> None:
    code, out, err = run(CHECKOUT, "census", str(cube))
    assert (code, err) == (0, "")
    assert "8 vertices, 5 tetrahedra, 1 valid hexahedra in 1 pattern" in " ".join(out.split())
    assert "\n5_A 1\n" in out
    assert "confirmed by the kernel: the first hexahedron of 1 of 1 patterns" in out
    assert max(map(len, out.splitlines())) <= 80


def test_json_is_what_the_library_says() -> None:
    code, found = run_json(CHECKOUT, "census", "--random", "300", "--seeds", "2")
    assert code == 0
    assert found["impossible"] == []
    for seed, own in enumerate(found["runs"]):
        counted = census.count(*random_mesh(300, seed))
        assert own["mesh"] == f"300 random points, seed {seed}"
        assert own["patterns"] == counted.patterns
        assert own["hexahedra"] == counted.hexahedra > 1000
        assert own["confirmed_by_the_kernel"] == len(counted.patterns)
        assert sum(own["row"]) == len(counted.patterns)


def test_a_table_like_the_papers() -> None:
    code, out, _ = run(CHECKOUT, "census", "--random", "100", "--random", "200", "--seeds", "2")
    assert code == 0
    assert max(map(len, out.splitlines())) <= 80
    titles = [line for line in out.splitlines() if "random points" in line]
    assert titles == [f"{n} random points: patterns by number of tetrahedra" for n in (100, 200)]
    rows = [line.split()[0] for line in out.splitlines() if line.startswith(("seed", "l", "m"))]
    assert rows == ["seed", "seed", "least", "most"] * 2


@pytest.mark.parametrize(
    "words", [["--jobs", "2"], ["--block", "40"], ["--jobs", "2", "--block", "9"]]
)
def test_the_same_however_it_is_cut(words: list[str]) -> None:
    whole = run_json(CHECKOUT, "census", "--random", "200")
    assert run_json(CHECKOUT, "census", "--random", "200", *words) == whole


def test_a_journal(tmp_path: Path) -> None:
    journal = tmp_path / "journal"
    words = ["census", "--random", "200", "--block", "50", "--journal", str(journal)]
    first = run_json(CHECKOUT, *words)
    lines = journal.read_text().splitlines(keepends=True)
    assert len(lines) == 5
    journal.write_text("".join(lines[:3]) + lines[3][:20])
    assert run_json(CHECKOUT, *words) == first
    assert len(journal.read_text().splitlines()) == 5
    other = run(CHECKOUT, "census", "--random", "201", "--block", "50", "--journal", str(journal))
    assert_rejects(other, "journal", "is not the journal of a census of this mesh")


@pytest.mark.parametrize("option", ["--save", "--journal"])
def test_the_mesh_is_never_replaced(cube: Path, option: str) -> None:
    content = cube.read_bytes()
    words = run(CHECKOUT, "census", str(cube), option, str(cube))
    assert_usage_error(words, f"{cube} is the file that is read")
    assert cube.read_bytes() == content


def test_a_folder_is_no_target(cube: Path, tmp_path: Path) -> None:
    (tmp_path / "new.png").mkdir()
    words = run(CHECKOUT, "census", str(cube), "--plot", str(tmp_path / "new.png"))
    assert_usage_error(words, f"{tmp_path / 'new.png'} is a folder")


@pytest.mark.parametrize("address", ["nonsense", "tcp://host", "host:port", ""])
def test_what_is_no_address(cube: Path, address: str) -> None:
    words = run(CHECKOUT, "census", str(cube), "--scheduler", address)
    assert_usage_error(words, "--scheduler takes an address such as tcp://HOST:8786")


def test_cells_that_are_left_out_are_told(tmp_path: Path) -> None:
    path = tmp_path / "mixed.vtu"
    points = np.concatenate([CUBE, CUBE + 3])
    cells = [("tetra", FIVE), ("hexahedron", [[*range(8, 16)]])]
    meshio.write(path, meshio.Mesh(points, cells))
    code, out, err = run(CHECKOUT, "census", str(path))
    assert (code, err) == (0, "left out, as they are no tetrahedra: 1 hexahedron cell\n")
    assert "1 valid hexahedra" in " ".join(out.split())


def test_hexahedra_are_saved(tmp_path: Path) -> None:
    path = tmp_path / "found.vtu"
    code, found = run_json(CHECKOUT, "census", "--random", "200", "--save", str(path))
    assert code == 0
    points, tetrahedra = random_mesh(200, 0)
    saved = read_mesh(path)
    assert saved.points.tolist() == points.tolist()
    vertices, _ = census.hexahedra(points, tetrahedra)
    assert sorted(saved.cells["hexahedron"].tolist()) == sorted(vertices.tolist())
    data = meshio.read(path).cell_data
    sizes = data["tetrahedra"][0].tolist()
    assert sizes == sorted(sizes)
    numbers = sorted(set(data["pattern"][0].astype(int).tolist()))
    legend = ", ".join(
        f"{k} {name}" for k, name in zip(numbers, found["runs"][0]["patterns"], strict=True)
    )
    assert f"<!--pattern: {legend}-->".encode() in path.read_bytes()


@pytest.mark.parametrize("ending", ["png", "svg", "pdf"])
@pytest.mark.parametrize("seeds", ["1", "2"])
def test_pictures(tmp_path: Path, ending: str, seeds: str) -> None:
    path = tmp_path / f"new.{ending}"
    words = ["census", "--random", "100", "--seeds", seeds, "--plot", str(path)]
    assert run(CHECKOUT, *words)[0] == 0
    assert path.stat().st_size > 1000


@pytest.mark.parametrize(
    ("words", "message"),
    [
        ("", "Name a mesh, or else give --random"),
        ("new.vtu --random 10", "Name a mesh, or else give --random"),
        ("new.vtu --seeds 2", "--seeds goes with --random"),
        ("--random 4", "4 is not in the range"),
        ("--random 10 --seeds 2 --journal x", "--journal and --save go with one mesh"),
        ("--random 10 --save x.vtu --journal x", "--save keeps hexahedra"),
        ("--random 10 --save x.vtk", "x.vtk: unknown ending; it must be .vtu"),
        ("--random 10 --plot x.gif", "x.gif: unknown ending; it must be .png or .svg or .pdf"),
        ("new.vtu", "new.vtu: No such file"),
    ],
)
def test_usage_errors(words: str, message: str) -> None:
    assert_usage_error(run(CHECKOUT, "census", *words.split()), message)


def test_bad_meshes(tmp_path: Path) -> None:
    flat = CUBE @ np.array([[1, 0, 0], [0, 1, 0], [3, 3, 0]])
    path = write(tmp_path / "flat.vtu", flat, FIVE)
    assert_rejects(run(CHECKOUT, "census", str(path)), "flat.vtu", "is flat")
    two = np.concatenate([CUBE, CUBE * 0.5 + 0.25])
    path = write(tmp_path / "overlapping.vtu", two, np.concatenate([FIVE, FIVE + 8]))
    assert_rejects(run(CHECKOUT, "census", str(path)), "overlapping.vtu", "overlaps tetrahedron")
    path = write(tmp_path / "twice.vtu", CUBE, np.concatenate([FIVE, FIVE[:1]]))
    assert_rejects(run(CHECKOUT, "census", str(path)), "twice.vtu", "on the same side")
    cells = [("hexahedron", [[*range(8)]])]
    meshio.write(tmp_path / "hexahedra.vtu", meshio.Mesh(CUBE, cells))
    path = tmp_path / "hexahedra.vtu"
    assert_rejects(run(CHECKOUT, "census", str(path)), "hexahedra.vtu", "no tetrahedra in it")


# What would be a contradiction.


def test_a_pattern_that_cannot_occur_is_a_contradiction(
    cube: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    from certify.mesh.census import tally  # noqa: PLC0415

    def also_15_k(*_: Any) -> Run:
        return Run("cube", 8, 5, {"5_A": 1, "15_K": 1}, 0, 1)

    monkeypatch.setattr(tally, "confirmed", also_15_k)
    code, out, _ = run(CHECKOUT, "census", str(cube))
    assert code == 1
    assert "CONTRADICTION: 15_K occur" in out


@pytest.mark.parametrize(
    ("pattern", "vertices", "points", "message"),
    [
        ("5_A", (0, 1, 2, 3, 4, 5, 6, 7), CUBE * [1, 1, -1], "tetrahedron 1236 is inverted"),
        ("6_A", (0, 1, 2, 3, 4, 5, 6, 7), CUBE, "6_A with the vertices 1 2 3 4 5 6 7 8: its tetra"),
        ("5_A", (1, 0, 2, 3, 4, 5, 6, 7), CUBE, "its tetrahedra are not in the mesh"),
    ],
)
def test_the_kernel_is_asked(
    pattern: str, vertices: tuple[int, ...], points: Any, message: str
) -> None:
    found = census.Census(8, 5, {pattern: 1}, {pattern: vertices}, ())
    with pytest.raises(NotConfirmed, match=message):
        confirmed("cube", points, FIVE, found, CHECKOUT)
