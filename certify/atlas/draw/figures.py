"""The paper's figures of triangulations, made anew from certificates that the kernel accepts.

A number is that of the figure in the order of the paper's source. The paper prints no list of
tetrahedra, so which of the patterns that fit a figure is which of its pictures is not known; the
captions say our names.
"""

from collections.abc import Callable, Sequence
from itertools import chain, zip_longest
from pathlib import Path
from typing import NamedTuple

from certify.atlas.draw.drawings import shown, view
from certify.atlas.draw.marks import (
    EDGES,
    JOINED,
    Box,
    Entry,
    apart_marks,
    ball_marks,
    cube_marks,
    graph_marks,
    in_cube_marks,
    legend_marks,
    types_of,
)
from certify.atlas.draw.picture import Label, Mark, Picture
from certify.atlas.draw.scene import witness
from certify.atlas.draw.space import cube_seen
from certify.kernel.certificate import PATTERN_NAMES, Certificate
from certify.kernel.check import Rejected, check_pattern
from certify.kernel.cube import (
    TETRAHEDRON_TYPES,
    triangulates_cube,
    triangulates_finite_precision_cube,
)
from certify.kernel.hexahedron import BOUNDARIES, BOUNDARY_TYPES, Simplex, boundary_letter
from certify.kernel.triangulation import boundary_diagonals, label, orientation
from certify.paper import size


def accepted(root: Path, *sizes: int) -> list[Certificate]:
    """Return the certificates with some numbers of tetrahedra.

    Raises:
        certify.kernel.check.Rejected: The kernel does not accept one of them.
    """
    found = []
    for pattern in PATTERN_NAMES:
        if size(pattern) in sizes:
            verdict = check_pattern(root, pattern)
            if verdict.fault is not None or verdict.certificate is None:
                raise Rejected(verdict.fault)
            found.append(verdict.certificate)
    return found


class Cell(NamedTuple):
    """A part of a figure, with what is written under it."""

    marks: Sequence[Mark]
    name: str
    says: str = ""


Draw = Callable[[Box], Cell]
"""Draws a cell into a box."""


def _grid(
    title: str, cells: Sequence[Draw | None], columns: int, width: float, height: float
) -> Picture:
    """Return the cells in rows, each with its name and a caption."""
    marks: list[Mark] = []
    said = []
    for number, draw in enumerate(cells):
        if draw is None:
            continue
        row, column = divmod(number, columns)
        left, top = 20 + column * (width + 24), 20 + row * (height + 56)
        cell = draw((left, top, width, height))
        marks += cell.marks
        marks.append(Label("name", (left + width / 2, top + height + 18), cell.name))
        marks.append(Label("caption", (left + width / 2, top + height + 37), cell.says))
        said.append(f"{cell.name}: {cell.says}" if cell.says else cell.name)
    rows = -(-len(cells) // columns)
    whole = 16 + columns * (width + 24)
    return Picture(whole, 20 + rows * (height + 56), tuple(marks), title, "; ".join(said) + ".")


def _with_legend(picture: Picture, entries: Sequence[Entry]) -> Picture:
    """Return the picture with a legend below it."""
    legend = legend_marks(entries, 24, picture.height + 6, picture.width - 48)
    bottom = max(mark.at[1] for mark in legend if isinstance(mark, Label))
    return Picture(
        picture.width, bottom + 20, (*picture.marks, *legend), picture.title, picture.says
    )


def _inset(box: Box, by: float) -> Box:
    left, top, width, height = box
    return left + by, top + by, width - 2 * by, height - 2 * by


def _split(box: Box, part: float) -> tuple[Box, Box]:
    """Return the left part of a box, and the rest."""
    left, top, width, height = box
    return (left, top, part * width, height), (
        left + part * width,
        top,
        width - part * width,
        height,
    )


def _halves(box: Box, part: float) -> tuple[Box, Box]:
    """Return the upper part of a box, and the rest."""
    left, top, width, height = box
    return (left, top, width, part * height), (
        left,
        top + part * height,
        width,
        height - part * height,
    )


# Cells.


def _tetrahedron(tetrahedron: Simplex) -> Draw:
    kind = TETRAHEDRON_TYPES[tetrahedron]
    return lambda box: Cell(in_cube_marks(tetrahedron, _inset(box, 22)), kind, label(tetrahedron))


def _in_the_cube(certificate: Certificate, dashes: bool) -> Draw:
    def draw(box: Box) -> Cell:
        upper, lower = _halves(box, 0.56)
        tetrahedra = certificate.tetrahedra
        marks = [
            *apart_marks(cube_seen(), tetrahedra, _inset(upper, 12)),
            *graph_marks(tetrahedra, _inset(lower, 34), dashes),
        ]
        return Cell(marks, certificate.pattern, f"one of {certificate.instances} alike")

    return draw


def _boundary(letter: str) -> Draw:
    alike = sum(boundary_letter(diagonals) == letter for diagonals in BOUNDARIES)
    diagonals = BOUNDARY_TYPES[letter]
    return lambda box: Cell(cube_marks(diagonals, _inset(box, 22)), letter, f"one of {alike} alike")


def _solid(certificate: Certificate, graph: bool = False) -> Draw:
    def draw(box: Box) -> Cell:
        found = witness(certificate)
        assert found is not None
        question, points = found
        tetrahedra = certificate.tetrahedra
        spots = view(points, tetrahedra)
        left, right = _split(box, 0.42 if graph else 0.6)
        marks = apart_marks(spots, tetrahedra, _inset(left, 14))
        if graph:
            right, last = _split(right, 0.45)
            marks += graph_marks(tetrahedra, _inset(last, 36))
        marks += ball_marks(spots, tetrahedra, _inset(right, 26))
        return Cell(marks, certificate.pattern, shown(certificate, question))

    return draw


def _graph(certificate: Certificate) -> Draw:
    def draw(box: Box) -> Cell:
        left, right = _split(box, 0.6)
        tetrahedra = certificate.tetrahedra
        marks = [
            *graph_marks(tetrahedra, _inset(left, 30)),
            *cube_marks(boundary_diagonals(tetrahedra), _inset(right, 34)),
        ]
        return Cell(marks, certificate.pattern, "No points realize it")

    return draw


# Figures.


def _all(certificates: Sequence[Certificate]) -> tuple[Simplex, ...]:
    return tuple(t for certificate in certificates for t in certificate.tetrahedra)


def _types(_: Path) -> Picture:
    cells = [_tetrahedron(t) for t in ((1, 2, 4, 5), (1, 2, 3, 5), (1, 2, 3, 8), (1, 3, 6, 8))]
    return _grid("The four types of tetrahedra in the cube", cells, 4, 210, 210)


def _cube(root: Path) -> Picture:
    shown = [c for c in accepted(root, 5, 6) if triangulates_cube(orientation(c.tetrahedra))]
    title = f"The {len(shown)} triangulations of the cube and their dual complexes"
    picture = _grid(title, [_in_the_cube(c, dashes=False) for c in shown], 3, 330, 480)
    return _with_legend(picture, [*types_of(_all(shown)), *EDGES[:3], EDGES[-1], JOINED[0]])


def _flat_types(_: Path) -> Picture:
    cells = [_tetrahedron(t) for t in ((1, 3, 5, 7), (1, 2, 3, 4))]
    return _grid("Two types of tetrahedra in a finite precision cube", cells, 2, 210, 210)


def _finite_precision(root: Path) -> Picture:
    shown = [
        c
        for c in accepted(root, 7)
        if triangulates_finite_precision_cube(orientation(c.tetrahedra))
    ]
    title = f"The {len(shown)} triangulations of the finite precision cube with seven tetrahedra"
    picture = _grid(title, [_in_the_cube(c, dashes=True) for c in shown], 4, 310, 520)
    return _with_legend(picture, [*types_of(_all(shown)), *EDGES[:3], EDGES[-1], *JOINED])


def _template(_: Path) -> Picture:
    marks = cube_marks(frozenset(), (34, 28, 172, 172))
    says = "The hexahedron 12345678 with its twelve edges."
    return Picture(240, 230, tuple(marks), "Hexahedron template", says)


def _boundaries(_: Path) -> Picture:
    cells = [_boundary(letter) for letter in BOUNDARY_TYPES]
    title = f"The {len(cells)} triangulations of the hexahedron's boundary"
    return _with_legend(_grid(title, cells, 4, 200, 190), [*EDGES[:2], EDGES[-1]])


def _eight_e(root: Path) -> Picture:
    shown = [c for c in accepted(root, 8) if c.pattern == "8_E"]
    picture = _grid("8_E and its decomposition graph", [_solid(shown[0], graph=True)], 1, 1080, 400)
    return _with_legend(picture, [*types_of(_all(shown)), *EDGES, *JOINED])


def _eights(root: Path) -> Picture:
    shown = [c for c in accepted(root, 8) if c.pattern != "8_E"]
    title = "Six triangulations into eight tetrahedra, 8_E aside"
    return _solids(title, shown, 2)


def _solids(title: str, shown: Sequence[Certificate], columns: int) -> Picture:
    picture = _grid(title, [_solid(c) for c in shown], columns, 640, 340)
    return _with_legend(picture, [*types_of(_all(shown)), *EDGES])


def _convex_fifteens(root: Path) -> Picture:
    shown = [c for c in accepted(root, 15) if witness(c) and best(c) != "realizable"]
    return _solids("The triangulations into 15 tetrahedra with points in convex position", shown, 2)


def best(certificate: Certificate) -> str:
    """Return the best question that is answered by points, or nothing."""
    found = witness(certificate)
    return found[0] if found else ""


def _other_fifteens(root: Path) -> Picture:
    fifteens = accepted(root, 15)
    without, bent = ([c for c in fifteens if best(c) == kind] for kind in ("", "realizable"))
    rows = zip_longest(map(_graph, without), map(_solid, bent))
    title = "The triangulations into 15 tetrahedra that are not realizable, or not convex"
    picture = _grid(title, [*chain.from_iterable(rows)], 2, 640, 360)
    return _with_legend(picture, [*types_of(_all([*without, *bent])), *EDGES, *JOINED])


FIGURES: dict[int, Callable[[Path], Picture]] = {
    2: _types,
    3: _cube,
    4: _flat_types,
    5: _finite_precision,
    6: _template,
    8: _boundaries,
    10: _eight_e,
    12: _eights,
    13: _convex_fifteens,
    14: _other_fifteens,
}
"""Figure of the paper -> what draws it from the certificates below a root."""


def figure(number: int, root: Path) -> Picture:
    """Return a figure of the paper, made from the certificates below a root.

    Raises:
        KeyError: There is no such figure, or it shows no triangulation.
        certify.kernel.check.Rejected: The kernel does not accept a certificate that it needs.
    """
    return FIGURES[number](root)
