"""Accepted points as mesh files for other programs. Nothing here is trusted.

Vertex v of the template is point v of the file, counted as the format counts. Coordinates are the
certificate's, times their common denominator: integers. Every tetrahedron has positive volume in
the order of its vertices. The twelve triangles of the boundary are counterclockwise seen from
outside, two for each facet of the template. The hexahedron as a cell has the template's order of
vertices, which is that of VTK; it is a valid one if the question is valid.

A file is written by meshio, given a heading without dates or versions, and read back: unless all
coordinates, cells and tags are found as they should be, it is refused.
"""

import re
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager, redirect_stderr, redirect_stdout
from dataclasses import dataclass
from io import StringIO
from math import lcm
from pathlib import Path
from typing import Any, NamedTuple
from warnings import catch_warnings, simplefilter

from certify.kernel.certificate import Yes
from certify.kernel.check import Verdict
from certify.kernel.chirotope import denominators
from certify.kernel.cube import TETRAHEDRON_TYPES
from certify.kernel.hexahedron import FACETS, VERTICES, Simplex, boundary_triangles, simplex
from certify.kernel.triangulation import boundary_diagonals, label, orientation

TYPES = ("corner", "staircase", "slanted", "core", "core diagonal")
"""The types of tetrahedra, numbered from 1; kernel/cube.py says what they mean."""

FACET_NAMES = tuple(label(simplex(facet)) for facet in FACETS)
"""The template's facets, numbered from 1, each by its vertices in increasing order."""

EXACT = 2**53
"""Every integer up to this size is a double; the next is not."""

NAMES = {
    "tetra": TYPES,
    "triangle": tuple(f"facet {name}" for name in FACET_NAMES),
    "hexahedron": ("hexahedron",),
}
"""Kind of cell -> what its tags mean, from 1."""


class NotExact(ValueError):
    """A file would not have the coordinates or the cells that it should; the message says why."""


class Cell(NamedTuple):
    """A cell; its tag is the number of its type or of its facet, from 1; a hexahedron's is 1."""

    kind: str
    vertices: Simplex
    tag: int


@dataclass(frozen=True)
class Model:
    """What a file shows: integer points, vertex 1 first; ``factor``: what they were multiplied by.

    cells: those of one kind follow one another.
    """

    pattern: str
    question: str
    factor: int
    points: tuple[tuple[int, ...], ...]
    cells: tuple[Cell, ...]

    @property
    def kinds(self) -> tuple[str, ...]:
        """The kinds of its cells, each once, in order."""
        return tuple(dict.fromkeys(cell.kind for cell in self.cells))


class Format(NamedTuple):
    """How meshio writes a file, and what is done about it.

    data: name of an array of meshio -> the kinds of cells whose tags it has, for others 0.
    title: the first match is replaced by ``heading``, in which %s is what the file shows.
    """

    name: str
    title: str
    heading: str
    data: Mapping[str, Sequence[str]]
    options: Mapping[str, Any]
    solid: bool = True


_VTK = {"type": ("tetra",), "facet": ("triangle",)}

FORMATS = {
    ".vtu": Format("vtu", "<!--.*?-->", "<!--%s-->", _VTK, {"binary": True, "compression": None}),
    ".vtk": Format("vtk", r"\n.*\n", "\n%s\n", _VTK, {"binary": True}),
    ".msh": Format(
        "gmsh22",
        r"\$EndMeshFormat\n",
        "$EndMeshFormat\n$Comments\n%s\n$EndComments\n",
        dict.fromkeys(("gmsh:physical", "gmsh:geometrical"), (*NAMES,)),
        {"binary": False, "float_fmt": ".0f"},
    ),
    ".mesh": Format(
        "medit",
        r"\AMeshVersionFormatted 2\n",
        "MeshVersionFormatted 2\n# %s\n",
        {"medit:ref": (*NAMES,)},
        {"float_fmt": ".0f"},
    ),
    ".obj": Format("obj", r"\A#.*\n", "# %s\n", {}, {}, solid=False),
    ".stl": Format("stl", r"\Asolid\n", "solid %s\n", {}, {"binary": False}, solid=False),
}
"""Ending -> format. OBJ and STL know no solids: they get the triangles of the boundary."""


def positive(tetrahedron: Simplex, sign: int) -> Simplex:
    """Return the vertices in an order in which the determinant is positive."""
    a, b, c, d = tetrahedron
    return tetrahedron if sign > 0 else (a, b, d, c)


def model(verdict: Verdict, question: str, hexahedron: bool = False) -> Model:
    """Return what a file shows of an accepted yes.

    hexahedron: the hexahedron instead of its tetrahedra and the triangles of the boundary.

    Raises:
        ValueError: The kernel has accepted no yes.
    """
    certificate = verdict.certificate
    answer = certificate.answers[question] if certificate else None
    if not certificate or not isinstance(answer, Yes) or verdict.answers.get(question) != "yes":
        raise ValueError(f"{verdict.pattern} {question}: no points were accepted")
    factor = lcm(*denominators(answer.points))  # one for all axes: the shape stays
    points = tuple(tuple(int(x * factor) for x in point) for point in answer.points)
    cells = (Cell("hexahedron", VERTICES, 1),) if hexahedron else _cells(certificate.tetrahedra)
    return Model(verdict.pattern, question, factor, points, cells)


def _cells(tetrahedra: tuple[Simplex, ...]) -> tuple[Cell, ...]:
    solids = [
        Cell("tetra", positive(t, sign), TYPES.index(TETRAHEDRON_TYPES[t]) + 1)
        for t, sign in sorted(orientation(tetrahedra).items())
    ]
    inward = boundary_triangles(boundary_diagonals(tetrahedra)).values()
    surface = [
        Cell("triangle", triangle[::-1], number)
        for number, facet in enumerate(FACETS, start=1)
        for triangle in inward
        if set(triangle) < set(facet)
    ]
    return (*solids, *surface)


def write_mesh(path: Path, shown: Model) -> None:
    """Write a file of the format that the ending of ``path`` tells, and compare what it says.

    Raises:
        NotExact: The format cannot hold the coordinates, or the file differs.
    """
    import meshio  # noqa: PLC0415 - an optional library

    most = max(abs(x) for point in shown.points for x in point)
    if most > EXACT:
        told = str(most) if most < 10**40 else f"with {len(str(most))} digits"
        raise NotExact(f"coordinate {told} is above 2^53, up to which mesh files are exact")
    form = FORMATS[path.suffix]
    kinds = [kind for kind in shown.kinds if form.solid or kind == "triangle"]
    blocks = [[cell for cell in shown.cells if cell.kind == kind] for kind in kinds]
    mesh = meshio.Mesh(
        [list(map(float, point)) for point in shown.points],
        [(block[0].kind, [[v - 1 for v in cell.vertices] for cell in block]) for block in blocks],
        cell_data={
            name: [_tags(block, tagged) for block in blocks]
            for name, tagged in form.data.items()
            if set(tagged).intersection(kinds)
        },
        field_data=_groups(shown.cells) if form.name == "gmsh22" else {},
    )
    with silence():
        meshio.write(path, mesh, form.name, **form.options)
        path.write_bytes(_headed(path.read_bytes(), shown, form))
        _require_equal(path, shown.points, [cell for block in blocks for cell in block], form)


def _tags(cells: Sequence[Cell], tagged: Sequence[str]) -> list[int]:
    return [cell.tag if cell.kind in tagged else 0 for cell in cells]


def _groups(cells: Sequence[Cell]) -> dict[str, list[int]]:
    """Return the names of Gmsh's physical groups, each with its number and its dimension."""
    return {
        NAMES[kind][tag - 1]: [tag, 2 if kind == "triangle" else 3]
        for kind, tag in sorted({(cell.kind, cell.tag) for cell in cells})
    }


def _headed(content: bytes, shown: Model, form: Format) -> bytes:
    """Return a file with a heading that says what it shows, and an OBJ file with groups as well."""
    about = f"{shown.pattern} {shown.question}, coordinates times {shown.factor}"
    if form.data and "tetra" in shown.kinds:
        about += f"; type: {_numbered(TYPES)}; facet: {_numbered(FACET_NAMES)}"
    if "tetra" in shown.kinds and form.solid:
        about += "; every tetrahedron has positive volume"
    heading = (form.heading % about).encode("ascii")
    headed, found = re.subn(form.title.encode("ascii"), lambda _: heading, content, count=1)
    if not found:
        raise NotExact(f"{form.name}: there is no place for a heading")
    if form.name == "obj":
        names = iter(FACET_NAMES)
        pair_of_faces = rb"(?:f .*\n){2}"
        headed = re.sub(
            pair_of_faces, lambda pair: f"g facet_{next(names)}\n".encode() + pair[0], headed
        )
    return headed


def _numbered(names: Sequence[str]) -> str:
    return ", ".join(f"{number} {name}" for number, name in enumerate(names, start=1))


def _require_equal(
    path: Path, points: Sequence[Sequence[int]], cells: Sequence[Cell], form: Format
) -> None:
    """Read a file back, and raise NotExact unless it has these cells, coordinates and tags."""
    import meshio  # noqa: PLC0415

    try:
        mesh = meshio.read(path)
        found = [(part.type, mesh.points[row].tolist()) for part in mesh.cells for row in part.data]
    except (Exception, SystemExit) as error:  # it exits where it knows no reader that does
        raise NotExact(f"{path.name} cannot be read back: {error!a}") from None
    if found != [(c.kind, [list(points[v - 1]) for v in c.vertices]) for c in cells]:
        raise NotExact(f"{path.name} has other cells or coordinates when it is read back")
    for name, tagged in form.data.items():
        tags = [int(tag) for part in mesh.cell_data.get(name, ()) for tag in part]
        if tags != _tags(cells, tagged) and set(tagged).intersection(cell.kind for cell in cells):
            raise NotExact(f"{path.name} has another {name} when it is read back")


@contextmanager
def silence() -> Iterator[StringIO]:
    """Keep from the console what meshio says there about formats, and the warnings of numpy.

    What it says is given instead.
    """
    said = StringIO()
    with redirect_stdout(said), redirect_stderr(said), catch_warnings():
        simplefilter("ignore")
        yield said
