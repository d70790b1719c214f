"""Which quadrilaterals do the cells of a mesh have, and do they fit together?

Cells are counted from 0 through all kinds, in the order of WIDTHS. Of each quadrilateral one bit is
asked: is it cut through its least vertex (0), or not (1)? The bits of a cell make a number below
64, bit p for its quadrilateral p. That is its choice of kinds.py, but for the bits of ``turns``.
"""

from collections.abc import Mapping
from dataclasses import dataclass
from itertools import combinations
from typing import Any

import numpy as np
from numpy.typing import NDArray

from certify.mesh.reading import BadMesh
from certify.mesh.split.kinds import QUADRILATERALS, TRIANGLES, WIDTHS, Rows

SLOTS = 6
"""No cell has more quadrilaterals."""

NONE = -1


@dataclass(frozen=True)
class Faces:
    """The cells and their faces.

    cells: kind -> rows of vertices. quadrilaterals: (m, 4), each in cyclic order from its least
    vertex. sides: (m, 2), the cells that have it; NONE where there is but one. slots: (n, 6), the
    quadrilaterals of a cell by bit, NONE beyond. turns: (n,), the bits in which a cell's choice
    and its bits differ. triangles: the triangular faces, (k, 3), sorted, each once; their_sides:
    (k, 2).
    """

    cells: dict[str, Rows]
    quadrilaterals: Rows
    sides: Rows
    slots: Rows
    turns: Rows
    triangles: Rows
    their_sides: Rows

    @property
    def number(self) -> int:
        """How many cells there are."""
        return sum(map(len, self.cells.values()))

    def start(self, kind: str) -> int:
        """Return the number of the first cell of a kind."""
        kinds = [*WIDTHS]
        before = kinds[: kinds.index(kind)]
        return sum(len(self.cells[own]) for own in before if own in self.cells)

    def place(self, cell: int) -> tuple[str, int]:
        """Return the kind of a cell, and its index among those of its kind."""
        for kind, rows in self.cells.items():
            if cell < len(rows):
                return kind, cell
            cell -= len(rows)
        raise IndexError("there are not so many cells")

    def name(self, cell: int) -> str:
        """Return what a cell is called: its kind, and its number among them from 1."""
        kind, index = self.place(cell)
        return f"{kind} {index + 1}"

    def vertices(self, cell: int) -> Rows:
        """Return the vertices of a cell."""
        kind, index = self.place(cell)
        row: Rows = self.cells[kind][index]
        return row


def faces_of(cells: Mapping[str, Rows]) -> Faces:
    """Return the faces of the cells.

    Raises:
        BadMesh: A vertex is twice in a cell, or the cells do not fit together: two have the same
            vertices, or lie on the same side of a face, or a face is in three; or two faces have
            three common vertices without being the same.
    """
    ordered = {kind: cells[kind] for kind in WIDTHS if len(cells.get(kind, ()))}
    names = Faces(ordered, *[np.empty((0, 0), np.int64)] * 6)
    _require_different(names)
    quads, owners = _stacked(ordered, QUADRILATERALS, 4)
    cyclic, forward = _from_least(quads)
    corners, number = _unique(np.sort(quads, axis=1))
    shapes = np.empty_like(corners)
    shapes[number] = cyclic
    crossed = (shapes[number] != cyclic).any(axis=1)
    if crossed.any():
        index = int(crossed.argmax())
        other = owners[(number == number[index]) & (shapes[number[index]] == cyclic).all(axis=1)]
        raise BadMesh(
            f"{names.name(owners[index])} and {names.name(other[0])} have {_listed(quads[index])} "
            "in different cyclic orders"
        )
    sides = _sides(names, quads, owners, number, forward, len(corners))
    triangles, their_owners = _stacked(ordered, TRIANGLES, 3)
    small, their_number = _unique(np.sort(triangles, axis=1))
    even = _even(triangles)
    their_sides = _sides(names, triangles, their_owners, their_number, even, len(small))
    _require_separate(names, shapes, sides, small, their_sides)
    slots, turns = _slots(ordered, quads, number)
    return Faces(ordered, shapes, sides, slots, turns, small, their_sides)


def _listed(vertices: Any) -> str:
    return " ".join(str(int(vertex) + 1) for vertex in vertices)


def _require_different(names: Faces) -> None:
    """Raise BadMesh if a cell has a vertex twice, or two cells have the same vertices."""
    for kind, rows in names.cells.items():
        ordered = np.sort(rows, axis=1)
        twice = (ordered[:, 1:] == ordered[:, :-1]).any(axis=1)
        if twice.any():
            raise BadMesh(f"{kind} {int(twice.argmax()) + 1} has a vertex twice")
        _, number = _unique(ordered)
        counts = np.bincount(number)
        if counts.max() > 1:
            first, second = np.flatnonzero(number == counts.argmax())[:2] + 1
            raise BadMesh(f"{kind} {first} and {kind} {second} have the same vertices")


def _stacked(
    cells: Mapping[str, Rows], faces: Mapping[str, Any], width: int
) -> tuple[Rows, NDArray[np.int64]]:
    """Return the faces of all cells, cell by cell, and for each the cell that has it."""
    found, owners, start = [np.empty((0, width), np.int64)], [np.empty(0, np.int64)], 0
    for kind, rows in cells.items():
        if faces[kind]:
            found.append(rows[:, np.array(faces[kind])].reshape(-1, width))
            owners.append(np.repeat(np.arange(start, start + len(rows)), len(faces[kind])))
        start += len(rows)
    return np.concatenate(found), np.concatenate(owners)


def _from_least(quads: Rows) -> tuple[Rows, NDArray[np.bool_]]:
    """Return them from the least vertex, the lesser neighbour next; and whether that is forward."""
    least = quads.argmin(axis=1)[:, None]
    turned = np.take_along_axis(quads, (least + np.arange(4)) % 4, axis=1)
    forward: NDArray[np.bool_] = turned[:, 1] < turned[:, 3]
    return np.where(forward[:, None], turned, turned[:, [0, 3, 2, 1]]), forward


def _even(triangles: Rows) -> NDArray[np.bool_]:
    """Are the vertices an even permutation of the increasing ones?"""
    a, b, c = triangles.T
    odd: NDArray[np.bool_] = (a > b) ^ (a > c) ^ (b > c)
    return ~odd


def _unique(rows: Rows) -> tuple[Rows, Rows]:
    """Return the different rows in lexicographic order, and for each row its number there."""
    if not len(rows):
        return rows, np.empty(0, np.int64)
    order = np.lexsort(rows.T[::-1])
    ordered = rows[order]
    new = np.ones(len(rows), np.bool_)
    new[1:] = (ordered[1:] != ordered[:-1]).any(axis=1)
    number = np.empty(len(rows), np.int64)
    number[order] = np.cumsum(new) - 1
    return ordered[new], number


def _sides(
    names: Faces, faces: Rows, owners: Rows, number: Rows, forward: NDArray[np.bool_], total: int
) -> Rows:
    """Return the cells on the two sides of each face.

    Raises:
        BadMesh: There are three, or two that see it counterclockwise from the same side.
    """
    counts = np.bincount(number, minlength=total)
    if (counts > 2).any():
        face = int(counts.argmax())
        found = ", ".join(names.name(owner) for owner in owners[number == face][:3])
        raise BadMesh(f"face {_listed(faces[number == face][0])} is in three cells: {found}")
    sides = np.full((total, 2), NONE, np.int64)
    for column, own in enumerate((forward, ~forward)):
        same = np.bincount(number[own], minlength=total) > 1
        if same.any():
            face = int(same.argmax())
            first, second = (names.name(owner) for owner in owners[number == face])
            raise BadMesh(
                f"{first} and {second} are on the same side of face "
                f"{_listed(faces[number == face][0])}"
            )
        sides[number[own], column] = owners[own]
    return sides


def _require_separate(
    names: Faces, quads: Rows, sides: Rows, triangles: Rows, their_sides: Rows
) -> None:
    """Raise BadMesh if two faces have three common vertices."""
    ordered = np.sort(quads, axis=1)
    threes = [ordered[:, list(three)] for three in combinations(range(4), 3)]
    rows, number = _unique(np.concatenate([*threes, triangles]))
    counts = np.bincount(number, minlength=len(rows))
    if not len(rows) or counts.max() == 1:
        return
    owners = np.concatenate([sides.max(axis=1)] * 4 + [their_sides.max(axis=1)])
    three = int(counts.argmax())
    first, second = (names.name(owner) for owner in np.sort(owners[number == three])[:2])
    raise BadMesh(
        f"a face of {first} and another face of {second} have the vertices "
        f"{_listed(rows[three])} in common: the mesh is not conforming"
    )


def _slots(cells: Mapping[str, Rows], quads: Rows, number: Rows) -> tuple[Rows, Rows]:
    """Return the quadrilaterals of each cell by bit, and which of its bits are turned."""
    total = sum(map(len, cells.values()))
    slots, turns = np.full((total, SLOTS), NONE, np.int64), np.zeros(total, np.int64)
    turned = quads.argmin(axis=1) % 2
    cell = face = 0
    for kind, rows in cells.items():
        width = len(QUADRILATERALS[kind])
        if width:
            own = slice(face, face + width * len(rows))
            slots[cell : cell + len(rows), :width] = number[own].reshape(-1, width)[:, ::-1]
            bits = turned[own].reshape(-1, width) << np.arange(width - 1, -1, -1)
            turns[cell : cell + len(rows)] = bits.sum(axis=1)
        cell, face = cell + len(rows), face + width * len(rows)
    return slots, turns
