"""Mesh files say what the certificates say, exactly, or they are not written."""

import re
from collections.abc import Callable
from fractions import Fraction
from itertools import combinations
from pathlib import Path
from typing import Any

import meshio
import pytest

from certify.kernel.certificate import PATTERN_NAMES, Certificate, Yes
from certify.kernel.check import Verdict, check_answer, check_pattern
from certify.kernel.evidence import Evidence
from certify.kernel.hexahedron import CORNERS, FACETS
from certify.kernel.triangulation import orientation
from certify.mesh import files
from certify.mesh.files import FORMATS, model, write_mesh
from tests.commands import CHECKOUT, assert_rejects, five_a, run
from tests.commands import write as write_certificate
from tests.geometry import CUBE, cross, dot, exact, volume

ENDINGS = [*FORMATS]
SOLID = [ending for ending, form in FORMATS.items() if form.solid]
SURFACES = [ending for ending in ENDINGS if ending not in SOLID]
STRONGEST = {"5_A": "valid", "8_E": "valid", "15_K": "convex", "15_I": "realizable"}

Point = tuple[int, ...]
Cells = list[tuple[str, list[Point], int, int]]
"""Kind, corners, type and facet, each from 1, or 0."""

FACES_ON_THE_CUBE = {1: 3, 2: 2, 3: 1, 4: 0, 5: 0}
"""Number of a type -> how many triangles of such a tetrahedron are on the facets of the cube."""


def integers(values: Any) -> Point:
    """Return integers, given as such or as floats that are."""
    assert all(value == int(value) for value in values)
    return tuple(map(int, values))


def tags_of(mesh: Any, ending: str, number: int, kind: str) -> tuple[list[int], list[int]]:
    """Return the types and the facets of a block of cells."""
    none = [0] * len(mesh.cells[number].data)
    if ending == ".stl":  # it has no data, but an order
        return none, [facet for facet in range(1, 7) for _ in range(2)]
    data = {name: [*map(int, blocks[number])] for name, blocks in mesh.cell_data.items()}
    if ending in (".vtu", ".vtk"):
        return data.get("type", none), data.get("facet", none)
    if ending == ".obj":
        return none, [group + 1 for group in data["obj:group_ids"]]
    tags, *others = data.values()
    assert all(other == tags for other in others)
    return (none, tags) if kind == "triangle" else (tags, none)


def read(path: Path) -> tuple[list[Point], Cells]:
    """Return the points and the cells that another program would find, as meshio reads them."""
    mesh = meshio.read(path)
    points = [integers(point) for point in mesh.points.tolist()]
    cells: Cells = []
    for number, block in enumerate(mesh.cells):
        corners = [[points[v] for v in cell] for cell in block.data.tolist()]
        tags = tags_of(mesh, path.suffix, number, block.type)
        cells += zip([block.type] * len(corners), corners, *tags, strict=True)
    return points, cells


def scaled(verdict: Verdict, question: str) -> list[Point]:
    """Return the points of a yes, of integers."""
    assert verdict.certificate is not None
    answer = verdict.certificate.answers[question]
    assert isinstance(answer, Yes)
    return [integers(point) for point in answer.points]


def check_surface(points: list[Point], cells: Cells) -> int:
    """Check the triangles of the boundary; return six times the volume that they enclose."""
    surface = [(corners, facet) for kind, corners, _, facet in cells if kind == "triangle"]
    assert [facet for _, facet in surface] == [1, 1, 2, 2, 3, 3, 4, 4, 5, 5, 6, 6]
    for corners, facet in surface:
        assert {points.index(p) + 1 for p in corners} < {*FACETS[facet - 1]}
    edges = [(t[i], t[i - 1]) for t, _ in surface for i in range(3)]
    assert sorted(edges) == sorted((b, a) for a, b in edges)  # closed, and coherent
    assert len({*edges}) == len(edges) == 36
    return sum(dot(a, cross(b, c)) for (a, b, c), _ in surface)


def check_tetrahedra(points: list[Point], cells: Cells, verdict: Verdict) -> int:
    """Check the tetrahedra; return six times the volume of them all."""
    assert verdict.certificate is not None
    solids = [(corners, number) for kind, corners, number, _ in cells if kind == "tetra"]
    found = [tuple(points.index(p) + 1 for p in corners) for corners, _ in solids]
    assert sorted(tuple(sorted(t)) for t in found) == [*verdict.certificate.tetrahedra]
    volumes = [volume(*corners) for corners, _ in solids]
    assert min(volumes) > 0
    for tetrahedron, (_, number) in zip(found, solids, strict=True):
        triples = combinations([CUBE[v - 1] for v in tetrahedron], 3)
        flat = sum(any(len({*axis}) == 1 for axis in zip(*t, strict=True)) for t in triples)
        assert flat == FACES_ON_THE_CUBE[number]
        in_one_plane = volume(*(CUBE[v - 1] for v in tetrahedron)) == 0
        assert in_one_plane == (number == 5)
    return sum(volumes)


def check_file(path: Path, pattern: str, question: str, verdict: Verdict) -> None:
    """Check everything in a file with tetrahedra, or with the boundary alone."""
    points, cells = read(path)
    expected = scaled(verdict, question)
    assert sorted(points) == sorted(expected)
    enclosed = check_surface(expected, cells)
    assert enclosed > 0
    if path.suffix in SOLID:
        assert points == expected  # vertex v is point v
        assert len(cells) == verdict.size + 12
        assert check_tetrahedra(points, cells, verdict) == enclosed
    else:
        assert len(cells) == 12


def test_formats_are_those_that_are_asked_for() -> None:
    assert ENDINGS == [".vtu", ".vtk", ".msh", ".mesh", ".obj", ".stl"]
    assert SURFACES == [".obj", ".stl"]
    pages = (CHECKOUT / "tests" / "help.txt").read_text()
    page = " ".join(pages.partition("$ certify export")[2].split())
    assert f"{', '.join(ENDINGS[:-1])} or {ENDINGS[-1]}" in page


reads_stl = pytest.mark.filterwarnings("ignore:overflow encountered:RuntimeWarning")
"""Meshio tries whether an STL file is binary, and there finds a large number."""


@reads_stl
@pytest.mark.parametrize("ending", ENDINGS)
@pytest.mark.parametrize("pattern", STRONGEST)
def test_mesh_of_a_pattern(
    tmp_path: Path, verdicts: dict[str, Verdict], pattern: str, ending: str
) -> None:
    path = tmp_path / f"new{ending}"
    code, out, err = run(CHECKOUT, "export", pattern, "--mesh", str(path))
    assert (code, out, err) == (0, f"{pattern} {STRONGEST[pattern]}: {path}\n", "")
    check_file(path, pattern, STRONGEST[pattern], verdicts[pattern])
    assert [*tmp_path.iterdir()] == [path]


def test_mesh_of_a_question(root: Path) -> None:
    moved(2, 0, root)
    verdict = check_pattern(root, "5_A")
    for question, size in (("realizable", 1), ("valid", 2)):
        path = root / f"{question}.mesh"
        assert run(root, "export", "5_A", question, "--mesh", str(path))[0] == 0
        check_file(path, "5_A", question, verdict)
        assert check_surface(*read(path)) == 6 * size**3


@pytest.fixture(scope="module")
def supplement(tmp_path_factory: pytest.TempPathFactory) -> tuple[Path, list[str]]:
    """Return the folder that --all writes, and the lines that it prints."""
    to = tmp_path_factory.mktemp("all")
    code, out, err = run(CHECKOUT, "export", "--all", "--to", str(to / "new" / "folder"))
    assert (code, err) == (0, "")
    return to / "new" / "folder", out.splitlines()


def test_all_that_are_realizable_are_written(
    supplement: tuple[Path, list[str]], verdicts: dict[str, Verdict]
) -> None:
    folder, lines = supplement
    absent = {"15_A", "15_B", "15_J"}
    assert {path.name for path in folder.iterdir()} == {
        f"{name}.vtu" for name in PATTERN_NAMES if name not in absent
    }
    assert len(lines) == 174
    assert lines[171:] == [f"{n} realizable: no, so there is no mesh" for n in sorted(absent)]
    written = [re.fullmatch(r"(\w+) (\w+): (.*)", line) for line in lines[:171]]
    questions = [match[2] for match in written if match]
    assert [questions.count(q) for q in ("valid", "convex", "realizable")] == [143, 15, 13]
    for match in written:
        assert match is not None
        assert Path(match[3]) == folder / f"{match[1]}.vtu"
        check_file(Path(match[3]), match[1], match[2], verdicts[match[1]])


def test_the_kernel_accepts_what_is_read(
    supplement: tuple[Path, list[str]], certificates: dict[str, Certificate]
) -> None:
    for line in supplement[1][:171]:
        pattern, question, file = line.replace(":", "", 1).split(" ", 2)
        signs = orientation(certificates[pattern].tetrahedra)
        points = exact(read(Path(file))[0])
        assert check_answer(question, Yes(points), signs, Evidence(CHECKOUT)) == "yes"


@pytest.mark.parametrize("ending", ENDINGS)
def test_bytes_are_the_same_twice(
    tmp_path: Path, verdicts: dict[str, Verdict], ending: str
) -> None:
    shown = model(verdicts["8_E"], "valid")
    contents = []
    for name in ("a", "b"):
        write_mesh(tmp_path / f"{name}{ending}", shown)
        contents.append((tmp_path / f"{name}{ending}").read_bytes())
    assert contents[0] == contents[1]
    assert b"meshio" not in contents[0]  # nor its version


# The hexahedron

VTK_CORNERS = (
    (0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1),
)  # fmt: skip
"""vtkHexahedron: the parametric coordinates of its points 0..7."""

VTK_FACES = (
    (0, 4, 7, 3), (1, 2, 6, 5), (0, 1, 5, 4), (3, 7, 6, 2), (0, 3, 2, 1), (4, 5, 6, 7),
)  # fmt: skip
"""vtkHexahedron: its faces, each counterclockwise seen from outside."""


def rotated(cycle: tuple[int, ...]) -> tuple[int, ...]:
    """Return a cycle with its least member first."""
    start = cycle.index(min(cycle))
    return cycle[start:] + cycle[:start]


def test_the_order_of_vtk_is_that_of_the_template() -> None:
    assert dict(enumerate(VTK_CORNERS, start=1)) == CORNERS
    outward = {rotated(tuple(v - 1 for v in reversed(facet))) for facet in FACETS}
    assert outward == {rotated(face) for face in VTK_FACES}


@pytest.mark.parametrize("ending", SOLID)
def test_hexahedron(tmp_path: Path, verdicts: dict[str, Verdict], ending: str) -> None:
    path = tmp_path / f"new{ending}"
    assert run(CHECKOUT, "export", "8_E", "--hexahedron", "--mesh", str(path))[0] == 0
    mesh = meshio.read(path)
    assert [block.type for block in mesh.cells] == ["hexahedron"]
    assert mesh.cells[0].data.tolist() == [[*range(8)]]
    assert [integers(point) for point in mesh.points.tolist()] == scaled(verdicts["8_E"], "valid")


@pytest.mark.usefixtures("ten")
def test_all_hexahedra(tmp_path: Path) -> None:
    words = ["--hexahedron", "--format", "mesh", "--to", str(tmp_path)]
    assert run(CHECKOUT, "export", "--all", *words)[0] == 0
    contents = [path.read_bytes() for path in tmp_path.glob("*.mesh")]
    assert len(contents) == 10
    assert all(b"\nHexahedra\n1\n1 2 3 4 5 6 7 8 " in content for content in contents)


# Coordinates


def moved(factor: Fraction | int, shift: int, root: Path) -> Path:
    """Give 5_A, where it is valid, the unit cube times a factor, and then shifted."""
    points = [[str(x * factor + shift) for x in corner] for corner in CORNERS.values()]
    written: list[list[int | str]] = [[x if "/" in x else int(x) for x in p] for p in points]
    write_certificate(root, five_a() | {"valid": {"answer": "yes", "points": written}})
    return root


@reads_stl
@pytest.mark.parametrize("ending", ENDINGS)
def test_fractions_become_integers(root: Path, ending: str) -> None:
    path = root / f"new{ending}"
    assert run(moved(Fraction(2, 3), 0, root), "export", "5_A", "--mesh", str(path))[0] == 0
    corners = {tuple(2 * x for x in corner) for corner in CUBE}
    assert {*read(path)[0]} == corners
    assert b"5_A valid, coordinates times 3" in path.read_bytes()


@reads_stl
@pytest.mark.parametrize("ending", ENDINGS)
def test_the_largest_exact_coordinates(root: Path, ending: str) -> None:
    path, most = root / f"new{ending}", 2**53
    assert run(moved(2 * most, -most, root), "export", "5_A", "--mesh", str(path))[0] == 0
    assert {x for point in read(path)[0] for x in point} == {-most, most}
    path.unlink()
    for factor, shift, too_large in ((1, most, most + 1), (1, -most - 1, most + 1)):
        outcome = run(moved(factor, shift, root), "export", "5_A", "--mesh", str(path))
        assert_rejects(outcome, str(too_large), "above 2^53")
        assert not path.exists()


@pytest.mark.parametrize("ending", SOLID)
def test_a_file_says_what_its_numbers_mean(tmp_path: Path, ending: str) -> None:
    path = tmp_path / f"new{ending}"
    assert run(CHECKOUT, "export", "8_E", "--mesh", str(path))[0] == 0
    assert (
        b"8_E valid, coordinates times 1; "
        b"type: 1 corner, 2 staircase, 3 slanted, 4 core, 5 core diagonal; "
        b"facet: 1 1234, 2 1256, 3 1458, 4 2367, 5 3478, 6 5678; "
        b"every tetrahedron has positive volume\n"
    ) in path.read_bytes().replace(b"-->", b"\n")
    if ending == ".msh":
        groups = {name: group.tolist() for name, group in meshio.read(path).field_data.items()}
        facets = {f"facet {name}": [k + 1, 2] for k, name in enumerate(files.FACET_NAMES)}
        assert groups == {"corner": [1, 3], "staircase": [2, 3], "slanted": [3, 3], **facets}


# What is read back


def add(content: bytes) -> bytes:
    return content.replace(b"1 3 0 1", b"1 3 0 2")


def turn(content: bytes) -> bytes:
    return content.replace(b" 1 2 3 7\n", b" 2 1 3 7\n")


def tag(content: bytes) -> bytes:
    return content.replace(b"1 4 2 2 2 ", b"1 4 2 3 2 ")


def drop(content: bytes) -> bytes:
    return content.replace(b"20 2 2 6 6 6 7 5\n", b"").replace(b"s\n20\n", b"s\n19\n")


def cut(content: bytes) -> bytes:
    return content[:-40]


def no_title(content: bytes) -> bytes:
    return content.replace(b"$EndMeshFormat", b"$Other")


@pytest.mark.parametrize(
    ("change", "fault"),
    [
        (add, "other cells or coordinates"),
        (turn, "other cells or coordinates"),
        (drop, "other cells or coordinates"),
        (tag, "another gmsh:physical"),
        (cut, "cannot be read back"),
        (no_title, "no place for a heading"),
    ],
)
def test_what_differs_is_refused(
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    change: Callable[[bytes], bytes],
    fault: str,
) -> None:
    original = meshio.write

    def spoiling(path: Path, *args: Any, **settings: Any) -> None:
        original(path, *args, **settings)
        content = path.read_bytes()
        path.write_bytes(change(content))
        assert path.read_bytes() != content

    monkeypatch.setattr(meshio, "write", spoiling)
    outcome = run(CHECKOUT, "export", "8_E", "--mesh", str(tmp_path / "8_E.msh"))
    assert_rejects(outcome, "", fault)
    assert [*tmp_path.iterdir()] == []


def test_points_that_nobody_accepted_have_no_mesh(verdicts: dict[str, Verdict]) -> None:
    wrong = Verdict("5_A", None, verdicts["5_A"].certificate, answers={"valid": "rejected"})
    for verdict in (wrong, verdicts["15_A"], Verdict("5_A", "no certificate")):
        with pytest.raises(ValueError, match="no points were accepted"):
            model(verdict, "valid")


def test_nothing_but_the_lines_is_printed(
    tmp_path: Path, verdicts: dict[str, Verdict], capfd: pytest.CaptureFixture[str]
) -> None:
    """Meshio tells the console of some formats that they are not for everyone."""
    for ending in ENDINGS:
        write_mesh(tmp_path / f"new{ending}", model(verdicts["5_A"], "valid"))
    assert capfd.readouterr() == ("", "")
