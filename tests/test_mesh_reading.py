"""Files that engineers have are read exactly; what is wrong with one is told in one line."""

import json
import os
from fractions import Fraction
from pathlib import Path
from typing import Any

import meshio
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from certify.kernel.hexahedron import CORNERS
from certify.mesh.files import silence
from certify.mesh.reading import BadMesh, read_hexahedra, read_mesh, read_tetrahedra

CUBE = np.array([*CORNERS.values()], float)
TWO = np.concatenate([CUBE, CUBE[4:] + np.array([0, 0, 1])])
"""The vertices of two cubes, one above the other."""
HEXAHEDRA = np.array([[0, 1, 2, 3, 4, 5, 6, 7], [4, 5, 6, 7, 8, 9, 10, 11]])
TETRAHEDRA = np.array([[0, 1, 3, 4], [1, 2, 3, 6]])
WRITERS = {
    ".vtk": "vtk",
    ".vtu": "vtu",
    ".msh": "gmsh22",
    ".mesh": "medit",
    ".inp": "abaqus",
}


def write(path: Path, points: Any, cells: Any, form: str | None = None, **options: Any) -> Path:
    with silence():
        meshio.write(path, meshio.Mesh(np.array(points), cells), form, **options)
    return path


def refused(path: Path, read: Any, *words: str) -> None:
    with pytest.raises(BadMesh) as caught:
        read(path)
    message = str(caught.value)
    assert message.startswith(f"{path}: ")
    assert len(message.splitlines()) == 1
    for word in words:
        assert word in message


# Meshes.


@pytest.mark.parametrize("ending", WRITERS)
def test_meshes_are_read_as_they_were_written(tmp_path: Path, ending: str) -> None:
    cells = [("tetra", TETRAHEDRA), ("hexahedron", HEXAHEDRA), ("triangle", [[0, 1, 2]])]
    moved = TWO + np.random.default_rng(1).random(TWO.shape)
    mesh = read_mesh(write(tmp_path / f"new{ending}", moved, cells, WRITERS[ending]))
    assert np.allclose(mesh.points, moved, atol=0, rtol=1e-14)
    assert {kind: rows.tolist() for kind, rows in mesh.cells.items()} == {
        "tetra": TETRAHEDRA.tolist(),
        "hexahedron": HEXAHEDRA.tolist(),
    }


def test_what_gmsh_writes(tmp_path: Path) -> None:
    gmsh = pytest.importorskip("gmsh")
    gmsh.initialize(interruptible=False)
    try:
        gmsh.option.setNumber("General.Terminal", 0)
        gmsh.model.occ.addBox(0, 0, 0, 1, 1, 1)
        gmsh.model.occ.synchronize()
        gmsh.model.mesh.generate(3)
        gmsh.write(str(tmp_path / "new.msh"))
        kinds, _, nodes = gmsh.model.mesh.getElements(3)
    finally:
        gmsh.finalize()
    assert len(read_mesh(tmp_path / "new.msh").cells["tetra"]) == len(nodes[0]) // 4
    assert kinds.tolist() == [4]


def test_blocks_of_one_kind_follow_one_another(tmp_path: Path) -> None:
    cells = [("tetra", TETRAHEDRA[:1]), ("wedge", [[0, 1, 3, 4, 5, 7]]), ("tetra", TETRAHEDRA[1:])]
    mesh = read_mesh(write(tmp_path / "new.vtu", TWO, cells))
    assert mesh.cells["tetra"].tolist() == TETRAHEDRA.tolist()
    assert len(mesh.cells["wedge"]) == 1


def test_single_precision_is_taken_as_it_is(tmp_path: Path) -> None:
    path = write(tmp_path / "new.vtu", (TWO + 0.1).astype(np.float32), [("tetra", TETRAHEDRA)])
    assert read_mesh(path).points[0, 0] == float(np.float32(0.1))


@pytest.mark.parametrize(
    ("points", "cells", "words"),
    [
        (TWO, [("triangle", [[0, 1, 2]])], "there are no solid cells"),
        (TWO, [("tetra10", [[*range(10)]])], "cell 1 is of the kind tetra10"),
        (TWO, [("tetra", [[0, 1, 2, 12]])], "tetra 1 has vertex 13, with 12 points"),
        (TWO, [("tetra", [*TETRAHEDRA.tolist(), [0, 1, -1, 3]])], "tetra 3 has vertex 0"),
        (TWO, [("tetra", [[0, 1, 2, 1]])], "tetra 1 has a vertex twice"),
        (TWO[:, :2], [("tetra", TETRAHEDRA)], "coordinates"),
        (np.where(TWO == 2, np.nan, TWO), [("tetra", TETRAHEDRA)], "point 9 has a coordinate"),
        (np.where(TWO == 2, np.inf, TWO), [("tetra", TETRAHEDRA)], "point 9 has a coordinate"),
    ],
)
def test_bad_meshes(tmp_path: Path, points: Any, cells: Any, words: str) -> None:
    try:
        path = write(tmp_path / "new.vtk", points, cells)
    except Exception:
        pytest.skip("meshio does not write it")
    if points.shape[1] == 2:
        mesh = read_mesh(path)  # VTK has three coordinates; the last is zero
        assert not mesh.points[:, 2].any()
    else:
        refused(path, read_mesh, words)


@pytest.mark.parametrize("ending", WRITERS)
@pytest.mark.parametrize("part", [0.1, 0.5, 0.9])
def test_truncated_meshes(tmp_path: Path, ending: str, part: float) -> None:
    """A file that ends too early may still be one; it is never a traceback."""
    whole = write(tmp_path / f"whole{ending}", TWO, [("hexahedron", HEXAHEDRA)], WRITERS[ending])
    content = whole.read_bytes()
    path = tmp_path / f"part{ending}"
    path.write_bytes(content[: int(part * len(content))])
    refused(path, read_mesh)


@pytest.mark.parametrize("form", ["gmsh22", "gmsh"])
@pytest.mark.parametrize("binary", [False, True])
def test_a_gmsh_file_without_its_last_bytes(tmp_path: Path, form: str, binary: bool) -> None:
    """Without the last digit of a vertex, 18 would be taken for 1."""
    cells = [("hexahedron", HEXAHEDRA)]
    whole = write(tmp_path / "whole.msh", TWO, cells, form, binary=binary)
    content = whole.read_bytes()
    path = tmp_path / "part.msh"
    for less in range(2, 60):
        path.write_bytes(content[:-less])
        refused(path, read_mesh)
    path.write_bytes(content + b"\n \n")
    assert read_mesh(path).cells["hexahedron"].tolist() == HEXAHEDRA.tolist()


def test_nastran(tmp_path: Path) -> None:
    """Without its end, meshio would read it for ever."""
    whole = write(tmp_path / "whole.bdf", TWO, [("hexahedron", HEXAHEDRA)], "nastran")
    assert read_mesh(whole).cells["hexahedron"].tolist() == HEXAHEDRA.tolist()
    path = tmp_path / "part.bdf"
    for content in (b"BEGIN BULK\n", whole.read_bytes()[:300]):
        path.write_bytes(content)
        refused(path, read_mesh, "it is cut off: Nastran's ENDDATA is missing")


def test_tecplot_is_not_supported(tmp_path: Path) -> None:
    path = write(tmp_path / "new.dat", TWO, [("hexahedron", HEXAHEDRA)], "tecplot")
    refused(path, read_mesh, "files of Tecplot are not supported")


def test_a_point_that_is_not_there(tmp_path: Path) -> None:
    path = write(tmp_path / "new.inp", TWO, [("hexahedron", HEXAHEDRA)], "abaqus")
    path.write_text(path.read_text().replace("1,2,3,4,5,6,7,8", "1,2,3,4,5,6,7,99"))
    refused(path, read_mesh, "it names 99, which is not there")


@pytest.mark.parametrize("ending", [*WRITERS, ".stl", ".xyz", ".bdf", ".unv", ""])
@pytest.mark.parametrize(
    "content", [b"", b"\n\n", b"\0" * 100, b"\x7fELF\x02\x01" + bytes(range(256)), b"{" * 5000]
)
def test_files_that_are_no_meshes(tmp_path: Path, ending: str, content: bytes) -> None:
    path = tmp_path / f"new{ending}"
    path.write_bytes(content)
    refused(path, read_mesh)


@pytest.mark.parametrize("ending", [*WRITERS, ".csv", ".json"])
def test_a_gigabyte_of_nothing(tmp_path: Path, ending: str) -> None:
    path = tmp_path / f"new{ending}"
    path.touch()
    os.truncate(path, 1 << 30)
    refused(path, read_hexahedra, "there is nothing in it")


@pytest.mark.parametrize(
    ("ending", "content"),
    [
        (".vtk", "# vtk DataFile Version 3.0\nx\nASCII\nDATASET UNSTRUCTURED_GRID\n"
                 "POINTS 999999999999999 double\n0 0 0\n"),
        (".vtk", "# vtk DataFile Version 3.0\nx\nBINARY\nDATASET UNSTRUCTURED_GRID\n"
                 "POINTS 999999999999999 double\n0 0 0\n"),
        (".msh", "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n99999999999999\n1 0 0 0\n"),
        (".msh", "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Elements\n99999999999999\n"),
        (".mesh", "MeshVersionFormatted 2\nDimension 3\nVertices\n99999999999999\n0 0 0 0\n"),
    ],
)  # fmt: skip
def test_files_that_promise_too_much(tmp_path: Path, ending: str, content: str) -> None:
    path = tmp_path / f"new{ending}"
    path.write_text(content)
    refused(path, read_mesh)


def test_entities_are_not_expanded(tmp_path: Path) -> None:
    levels = "".join(f'<!ENTITY a{k} "{f"&a{k - 1};" * 10}">' for k in range(1, 10))
    path = tmp_path / "new.vtu"
    path.write_text(f'<?xml version="1.0"?><!DOCTYPE x [<!ENTITY a0 "a">{levels}]><x>&a9;</x>')
    refused(path, read_mesh, "declarations of a document type")


@pytest.mark.parametrize("make", [os.mkfifo, os.mkdir])
def test_what_is_no_file(tmp_path: Path, make: Any) -> None:
    make(tmp_path / "new.vtu")
    refused(tmp_path / "new.vtu", read_mesh, "it is not a regular file")


def test_a_missing_file(tmp_path: Path) -> None:
    with pytest.raises(FileNotFoundError):
        read_mesh(tmp_path / "new.vtu")


# Hexahedra.

ROWS = "\n".join(" ".join(map(str, map(int, point))) for point in CUBE)


@pytest.mark.parametrize(
    "text",
    [
        ROWS,
        ROWS.replace(" ", ","),
        ROWS.replace(" ", " ; "),
        f"x,y,z\n{ROWS}",
        f"# a cube\n\n{ROWS}  # the last\n",
        ROWS.replace("\n", " "),
        ROWS.replace("\n", "\r\n"),
        f"\ufeff{ROWS}",
        ROWS.replace("1", "1.00"),
        ROWS.replace("1", "2/2"),
        ROWS.replace("1", "+10e-1"),
    ],
)
def test_a_cube_as_csv(tmp_path: Path, text: str) -> None:
    path = tmp_path / "cube.csv"
    path.write_text(text, encoding="utf-8")
    points, names = read_hexahedra(path)
    assert points.dtype == np.float64
    assert points.tolist() == [CUBE.tolist()]
    assert names == ["cube.csv"]


def test_many_as_csv(tmp_path: Path) -> None:
    path = tmp_path / "cubes.txt"
    path.write_text("\n".join([ROWS] * 3))
    points, names = read_hexahedra(path)
    assert points.tolist() == [CUBE.tolist()] * 3
    assert names == ["1", "2", "3"]


COORDINATES = st.one_of(
    st.integers(), st.fractions(), st.decimals(allow_nan=False, allow_infinity=False, places=3)
)


@settings(deadline=None)
@given(st.lists(st.lists(COORDINATES, min_size=3, max_size=3), min_size=8, max_size=8))
def test_numbers_are_exact(tmp_path_factory: pytest.TempPathFactory, points: Any) -> None:
    want = [[[Fraction(x) for x in point] for point in points]]
    folder = tmp_path_factory.mktemp("numbers")
    (folder / "a.csv").write_text("\n".join(",".join(map(str, point)) for point in points))
    quoted = [[str(x) if isinstance(x, Fraction) else x for x in p] for p in points]
    (folder / "a.json").write_text(json.dumps(quoted, default=float))
    assert exact(read_hexahedra(folder / "a.csv")[0]) == want
    if not any(isinstance(x, float) for p in quoted for x in p):
        text = json.dumps(quoted, default=lambda x: f"<{x}>").replace('"<', "").replace('>"', "")
        (folder / "a.json").write_text(text)
        assert exact(read_hexahedra(folder / "a.json")[0]) == want


def exact(points: Any) -> list[list[list[Fraction]]]:
    return [[[Fraction(x) for x in point] for point in own] for own in points.tolist()]


@pytest.mark.parametrize(
    "value",
    [
        CUBE.tolist(),
        [CUBE.tolist()],
        {"points": CUBE.tolist(), "more": 1},
        CUBE.astype(str).tolist(),
    ],
)
def test_a_cube_as_json(tmp_path: Path, value: Any) -> None:
    path = tmp_path / "cube.JSON"
    path.write_text(json.dumps(value))
    assert read_hexahedra(path)[0].tolist() == [CUBE.tolist()]


def test_hexahedra_of_a_mesh(tmp_path: Path) -> None:
    path = write(tmp_path / "two.vtu", TWO, [("hexahedron", HEXAHEDRA), ("tetra", TETRAHEDRA)])
    points, names = read_hexahedra(path)
    assert points.tolist() == TWO[HEXAHEDRA].tolist()
    assert names == ["1", "2"]
    refused(
        write(tmp_path / "no.vtu", TWO, [("tetra", TETRAHEDRA)]), read_hexahedra, "no hexahedra"
    )


@pytest.mark.parametrize(
    ("ending", "text", "words"),
    [
        (".csv", ROWS[:-6], "7 lines are not eight points"),
        (".csv", ROWS + " 1", "line 8 has 4 numbers"),
        (".csv", "x,y,z", "0 lines are not eight points"),
        (".csv", ROWS.replace("1 1 1", "1 1 nan"), "line 7: 'nan' is not a number"),
        (".csv", ROWS.replace("1 1 1", "1 1 1/0"), "line 7: '1/0' is not a number"),
        (".csv", ROWS.replace("1 1 1", "1 1 1e999"), "line 7: the exponent"),
        (".csv", ROWS.replace("1 1 1", f"1 1 {'9' * 500}"), "is not a number"),
        (".csv", ROWS.replace("1 1 1", "1 1 ١"), "is not a number"),
        (".csv", ROWS.replace("1 1 1", "1 1 \0"), "a NUL"),
        (".csv", "x,y,z\n" + ROWS.replace("1 1 1", "a b c"), "line 8: 'a' is not a number"),
        (".json", "[" * 100_000, "it is not JSON"),
        (".json", "{}", "no list of points"),
        (".json", "[]", "not a list of eight points"),
        (".json", "[[1, 2, 3]]", "not a list of eight points"),
        (".json", json.dumps(CUBE.tolist()[:7]), "hexahedron 1 is not a list of eight points"),
        (".json", json.dumps([[*CUBE.tolist()[:7], [1, 2]]]), "hexahedron 1, point 8"),
        (".json", json.dumps([[*CUBE.tolist()[:7], [1, 2, None]]]), "is not a number"),
        (".json", json.dumps([[*CUBE.tolist()[:7], [1, 2, True]]]), "is not a number"),
        (".json", json.dumps([[*CUBE.tolist()[:7], [1, 2, [3]]]]), "is not a number"),
        (".json", json.dumps([[*CUBE.tolist()[:7], [1, 2, float("nan")]]]), "is not a number"),
    ],
)
def test_bad_hexahedra(tmp_path: Path, ending: str, text: str, words: str) -> None:
    path = tmp_path / f"new{ending}"
    path.write_text(text, encoding="utf-8")
    refused(path, read_hexahedra, words)


def test_other_encodings(tmp_path: Path) -> None:
    path = tmp_path / "new.csv"
    path.write_bytes(ROWS.encode() + b"\xff")
    refused(path, read_hexahedra, "not UTF-8")


# Tetrahedra.

FIVE = ("1236", "1348", "1368", "1568", "3678")


@pytest.mark.parametrize(
    ("ending", "text"),
    [
        (".txt", " ".join(FIVE)),
        (".txt", "\n".join(FIVE)),
        (".csv", "\n".join(",".join(word) for word in FIVE)),
        (".json", json.dumps(FIVE)),
        (".json", json.dumps([[*word] for word in FIVE])),
        (".json", json.dumps({"tetrahedra": [[*map(int, word)] for word in FIVE]})),
    ],
)
def test_five_tetrahedra(tmp_path: Path, ending: str, text: str) -> None:
    path = tmp_path / f"new{ending}"
    path.write_text(text)
    assert read_tetrahedra(path).cells == tuple(map(tuple, FIVE))
    assert read_tetrahedra(path).facets is None


def test_tetrahedra_of_a_mesh_are_counted_from_one(tmp_path: Path) -> None:
    path = write(tmp_path / "new.vtu", CUBE, [("tetra", TETRAHEDRA)])
    assert read_tetrahedra(path).cells == (("1", "2", "4", "5"), ("2", "3", "4", "7"))
    other = write(tmp_path / "two.vtu", TWO, [("tetra", TETRAHEDRA), ("hexahedron", HEXAHEDRA)])
    refused(other, read_tetrahedra, "not tetrahedra alone")


def test_marked_facets(tmp_path: Path) -> None:
    path = tmp_path / "new.json"
    path.write_text(json.dumps({"tetrahedra": FIVE, "facets": ["1234", "1562"]}))
    assert read_tetrahedra(path).facets == (tuple("1234"), tuple("1562"))


def test_long_names(tmp_path: Path) -> None:
    """Four names in a line, eight in all, are names; more of them are words."""
    path = tmp_path / "new.txt"
    path.write_text("\n".join(" ".join(f"100{v}" for v in word) for word in FIVE))
    assert read_tetrahedra(path).cells[0] == ("1001", "1002", "1003", "1006")


@pytest.mark.parametrize(
    ("ending", "text", "words"),
    [
        (".txt", "1234 123", "line 1: '123' has not a character"),
        (".txt", "# nothing", "no tetrahedra in it"),
        (".json", "{}", "no list of tetrahedra"),
        (".json", "[]", "no list of tetrahedra"),
        (".json", '["1234", "123"]', "number 2 of the tetrahedra has not four"),
        (".json", "[[1, 2, 3, [4]]]", "number 1 of the tetrahedra has not four"),
        (".json", '{"tetrahedra": ["1234"], "facets": 7}', "no list of facets"),
        (".json", '"1234"', "no list of tetrahedra"),
    ],
)
def test_bad_tetrahedra(tmp_path: Path, ending: str, text: str, words: str) -> None:
    path = tmp_path / f"new{ending}"
    path.write_text(text)
    refused(path, read_tetrahedra, words)
