"""Is this set of tetrahedra a triangulated 3-ball bounded by the hexahedron?

A *triangulation of the hexahedron* (the paper's section 3) is a set of tetrahedra on the vertices
1..8 that triangulates a 3-ball whose boundary is the template with one diagonal in each facet, and
in which no tetrahedron has the four vertices of one facet (a *boundary* tetrahedron, section 2).
"""

from collections import Counter
from collections.abc import Iterable
from itertools import combinations

from certify.kernel.hexahedron import (
    BOUNDARIES,
    FACETS,
    SYMMETRIES,
    Simplex,
    boundary_triangles,
    image,
    simplex,
    sorted_with_sign,
)


class NotATriangulation(ValueError):
    """The tetrahedra do not triangulate the hexahedron; the message says which test failed."""


def triangles(tetrahedron: Simplex) -> tuple[Simplex, ...]:
    """Return the four triangles of a tetrahedron."""
    return tuple(combinations(tetrahedron, 3))


def label(face: Iterable[int]) -> str:
    """Write a face as the paper does: its vertices in a row."""
    return "".join(map(str, face))


_FACET_VERTICES = frozenset(map(simplex, FACETS))
_DIAGONALS_OF = {frozenset(boundary_triangles(chosen)): chosen for chosen in BOUNDARIES}


def boundary_diagonals(tetrahedra: tuple[Simplex, ...]) -> frozenset[Simplex]:
    """Return the six diagonals of the boundary, or raise :class:`NotATriangulation`.

    Decides: no boundary tetrahedron; every triangle in at most two tetrahedra; the triangles in
    exactly one are the 12 boundary triangles of one of the 64 triangulated boundaries.
    """
    for tetrahedron in tetrahedra:
        if tetrahedron in _FACET_VERTICES:
            raise NotATriangulation(f"{label(tetrahedron)} is a boundary tetrahedron")
    count = Counter(face for tetrahedron in tetrahedra for face in triangles(tetrahedron))
    for face, times in count.items():
        if times > 2:
            raise NotATriangulation(f"triangle {label(face)} lies in {times} tetrahedra")
    diagonals = _DIAGONALS_OF.get(frozenset(face for face in count if count[face] == 1))
    if diagonals is None:
        raise NotATriangulation(
            "the triangles in exactly one tetrahedron do not form one of the 64 triangulated "
            "boundaries"
        )
    return diagonals


def shelling(tetrahedra: tuple[Simplex, ...]) -> tuple[Simplex, ...]:
    """Return the tetrahedra in a shelling order, or raise :class:`NotATriangulation`.

    In a shelling every tetrahedron but the first meets the union of its predecessors in one, two
    or three whole triangles. It does so exactly when its *restriction* R, the vertices opposite
    those triangles, is no face of a predecessor: a face of the newcomer lies in none of those
    triangles iff it contains R.

    Lemma (Danaraj and Klee 1974, Proposition 1.2): a shellable complex of tetrahedra in which
    every triangle lies in at most two, and some in one, is a 3-ball. Indeed one, two or three
    triangles of a tetrahedron form a disc, and two 3-balls that share exactly a disc of both
    boundaries form a 3-ball.

    The order is sought greedily from every first tetrahedron in turn. So a ball could in principle
    be refused (none of ours is), but nothing else accepted.
    """
    longest = 0
    for first in tetrahedra:
        order, waiting = [first], [t for t in tetrahedra if t != first]
        while newcomer := next((t for t in waiting if _attaches(t, order)), None):
            order.append(newcomer)
            waiting.remove(newcomer)
        if not waiting:
            return tuple(order)
        longest = max(longest, len(order))
    raise NotATriangulation(f"no shelling goes beyond {longest} of {len(tetrahedra)} tetrahedra")


def _attaches(tetrahedron: Simplex, order: list[Simplex]) -> bool:
    """Does the tetrahedron meet the union of ``order`` in one, two or three triangles?

    That there is one needs no question: an empty restriction would be a face of all of them.
    """
    shared = [set(tetrahedron).intersection(other) for other in order]
    restriction = {
        vertex
        for vertex in tetrahedron
        if any(len(common) == 3 and vertex not in common for common in shared)
    }
    return len(restriction) <= 3 and not any(restriction <= common for common in shared)


def orientation(tetrahedra: tuple[Simplex, ...]) -> dict[Simplex, int]:
    """Return each tetrahedron's sign in the coherent orientation that the hexahedron induces.

    The sign of a tetrahedron abcd, a < b < c < d, is that of det(b-a, c-a, d-a) wherever the
    tetrahedra are embedded as the template's reference cube is (not mirrored). A triangle that
    is counterclockwise seen from inside has the tetrahedron inside it on its positive side; two
    tetrahedra that share a triangle lie on opposite sides of it. The tetrahedra must triangulate
    the hexahedron: a ball is orientable, hence no tetrahedron gets two signs.
    """
    boundary = boundary_triangles(boundary_diagonals(tetrahedra))
    pending = [sorted_with_sign(seen) for seen in boundary.values()]
    signs: dict[Simplex, int] = {}
    while pending:
        face, side = pending.pop()
        for tetrahedron in tetrahedra:
            if tetrahedron not in signs and set(face) < set(tetrahedron):
                apex = next(i for i, v in enumerate(tetrahedron) if v not in face)
                sign = signs[tetrahedron] = side * (-1) ** (3 - apex)
                for i, vertex in enumerate(tetrahedron):
                    opposite = tuple(v for v in tetrahedron if v != vertex)
                    pending.append((opposite, -sign * (-1) ** (3 - i)))
    return signs


def orbit(tetrahedra: tuple[Simplex, ...]) -> frozenset[tuple[Simplex, ...]]:
    """Return the *instances* of the class: the images under the 48 symmetries, each sorted."""
    return frozenset(
        tuple(sorted(image(symmetry, tetrahedron) for tetrahedron in tetrahedra))
        for symmetry in SYMMETRIES
    )
