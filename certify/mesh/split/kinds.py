"""The kinds of cells: their faces, and the ways to fill wedges and pyramids.

Vertices of a cell are counted from 0, in the order of VTK. Faces are counterclockwise seen from
inside. A *choice* is a number with a bit for each quadrilateral, the first one the most
significant, as in the kernel's BOUNDARIES: 0 stands for the diagonal from the first vertex to the
third, 1 for the other.

VTK's manual and Gmsh's disagree about which of the two triangles of a wedge comes first, and so do
files; so a wedge may be either way round. Here the first triangle is counterclockwise seen from the
other one, as Gmsh has it.
"""

from collections.abc import Iterator
from dataclasses import dataclass
from functools import lru_cache
from itertools import combinations, product
from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray

from certify.kernel.chirotope import dependence
from certify.kernel.hexahedron import FACETS, Simplex, sorted_with_sign
from certify.mesh.realized import Booleans
from certify.mesh.signs import Numbers, Signs, orientations

Row: TypeAlias = tuple[int, ...]
Rows: TypeAlias = NDArray[np.int64]

WIDTHS = {"hexahedron": 8, "wedge": 6, "pyramid": 5, "tetra": 4}
"""Kind -> how many vertices; cells are counted in this order of kinds."""

QUADRILATERALS: dict[str, tuple[Row, ...]] = {
    "hexahedron": tuple(tuple(vertex - 1 for vertex in facet) for facet in FACETS),
    "wedge": ((0, 3, 4, 1), (1, 4, 5, 2), (2, 5, 3, 0)),
    "pyramid": ((0, 1, 2, 3),),
    "tetra": (),
}

TRIANGLES: dict[str, tuple[Row, ...]] = {
    "hexahedron": (),
    "wedge": ((0, 1, 2), (3, 5, 4)),
    "pyramid": ((0, 4, 1), (1, 4, 2), (2, 4, 3), (3, 4, 0)),
    "tetra": ((0, 1, 2), (0, 3, 1), (1, 3, 2), (2, 3, 0)),
}

VTK_TYPES = {"tetra": 10, "hexahedron": 12, "wedge": 13, "pyramid": 14}


@dataclass(frozen=True)
class Filling:
    """Tetrahedra that fill the boundary of a wedge or a pyramid, if they have these signs.

    choice: how the quadrilaterals are cut; signs: increasing quadruple -> sign.
    """

    choice: int
    signs: tuple[tuple[Row, int], ...]


def surface(kind: str, choice: int) -> tuple[Row, ...]:
    """Return the triangles of the boundary of a cell, counterclockwise seen from inside."""
    triangles = [*TRIANGLES[kind]]
    quadrilaterals = QUADRILATERALS[kind]
    for place, (a, b, c, d) in enumerate(quadrilaterals):
        if choice >> (len(quadrilaterals) - 1 - place) & 1:
            triangles += [(a, b, d), (b, c, d)]
        else:
            triangles += [(a, b, c), (a, c, d)]
    return tuple(triangles)


@lru_cache(maxsize=4)
def fillings(kind: str) -> tuple[Filling, ...]:
    """Return all sets of tetrahedra on a wedge's or a pyramid's vertices that bound its boundary.

    That is: every triangle lies in at most two of the tetrahedra, which are on two sides of it;
    those in one are the triangles of the boundary. Lemma: points at which such tetrahedra have
    their signs and meet only in common faces make them fill what the boundary encloses. Proof. The
    boundary of their union is the surface. And every filling without further vertices is one of
    these, as each of its triangles has tetrahedra on both sides, or is on the boundary.

    They are found by laying tetrahedra on triangles that are still open. So the list is complete.
    """
    return tuple(
        Filling(choice, own)
        for choice in range(2 ** len(QUADRILATERALS[kind]))
        for own in sorted(
            {tuple(sorted(found.items())) for found in _fill(kind, surface(kind, choice))}
        )
    )


def _fill(kind: str, triangles: tuple[Row, ...]) -> Iterator[dict[Row, int]]:
    yield from _laid(WIDTHS[kind], dict(map(sorted_with_sign, triangles)), frozenset(), {})


def _laid(
    vertices: int, front: dict[Simplex, int], closed: frozenset[Simplex], used: dict[Row, int]
) -> Iterator[dict[Row, int]]:
    """Yield what can be added to the tetrahedra that are used, so that no triangle is open.

    front: open triangles, with the sign of their order seen from where they are open.
    """
    if not front:
        yield used
        return
    triangle = min(front)
    for apex in set(range(vertices)).difference(triangle):
        tetrahedron, parity = sorted_with_sign((*triangle, apex))
        sign = parity * front[triangle]
        after, done = dict(front), set(closed)
        for index in range(4):
            face = tetrahedron[:index] + tetrahedron[index + 1 :]
            seen = sign * (-1) ** (3 - index)
            if face in done or after.get(face, seen) != seen:
                break
            if face in after:
                del after[face]
                done.add(face)
            else:
                after[face] = -seen
        else:
            if tetrahedron not in used:
                yield from _laid(vertices, after, frozenset(done), {**used, tetrahedron: sign})


def quadruples(kind: str) -> tuple[Row, ...]:
    """Return the quadruples of a cell's vertices, in increasing order."""
    return tuple(combinations(range(WIDTHS[kind]), 4))


def signs_of(points: Numbers, kind: str, cells: Rows) -> Signs:
    """Return the signs of all quadruples of each cell: (n, number of quadruples)."""
    rows = cells[:, np.array(quadruples(kind), np.int64)]
    return orientations(points, rows.reshape(-1, 4)).reshape(rows.shape[:2])


def realized_fillings(kind: str, signs: Signs) -> Booleans:
    """Return which of the fillings of wedges or pyramids have their signs and do not overlap.

    The tetrahedra meet only in common faces iff no circuit has its two sides in two of them: the
    lemma of certify/kernel/embedding.py, whose proof holds for any number of points.

    Args:
        kind: "wedge" or "pyramid".
        signs: What signs_of returns.

    Returns:
        An array (n, number of fillings).
    """
    own = fillings(kind)
    place = {quadruple: index for index, quadruple in enumerate(quadruples(kind))}
    out = np.ones((len(signs), len(own)), np.bool_)
    for index, filling in enumerate(own):
        for tetrahedron, sign in filling.signs:
            out[:, index] &= signs[:, place[tetrahedron]] == sign
    for quintuple in combinations(range(WIDTHS[kind]), 5):
        terms = dependence(quintuple)
        column = np.zeros(len(signs), np.int64)
        for _, quadruple, _ in terms:
            column = 3 * column + signs[:, place[quadruple]] + 1
        out &= ~_crossing(kind, quintuple)[column]
    return out


@lru_cache(maxsize=16)
def _crossing(kind: str, quintuple: Row) -> Booleans:
    """Return which fillings have both sides of the circuit of a quintuple as faces: (3^5, n)."""
    faces = [
        {
            frozenset(face)
            for tetrahedron, _ in filling.signs
            for size in (1, 2, 3, 4)
            for face in combinations(tetrahedron, size)
        }
        for filling in fillings(kind)
    ]
    table = []
    for signs in product((-1, 0, 1), repeat=5):
        values = [(t[0], t[2] * sign) for t, sign in zip(dependence(quintuple), signs, strict=True)]
        positive = frozenset(vertex for vertex, value in values if value > 0)
        negative = frozenset(vertex for vertex, value in values if value < 0)
        table.append([positive in own and negative in own for own in faces])
    return np.array(table, np.bool_)


def way_round(points: Numbers, wedges: Rows) -> Rows:
    """Return the wedges with the two triangles exchanged where only then they can be filled."""
    signs = signs_of(points, "wedge", wedges)
    turned = wedges[:, [3, 4, 5, 0, 1, 2]]
    swap = ~realized_fillings("wedge", signs).max(axis=1, initial=False)
    swap[swap] = realized_fillings("wedge", signs_of(points, "wedge", turned[swap])).max(axis=1)
    return np.where(swap[:, None], turned, wedges)
