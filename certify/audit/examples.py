"""Placements of eight points that decide general statements of the paper, and tests of points."""

from collections.abc import Sequence
from fractions import Fraction

from certify.audit.graphs import Tetrahedra
from certify.kernel.chirotope import (
    QUADRUPLES,
    QUINTUPLES,
    Point,
    chirotope,
    circuits,
    dependence,
    determinant,
    integral,
)
from certify.kernel.embedding import NotRealized, require_convex_position, require_realization
from certify.kernel.hexahedron import CORNERS, Simplex, inversions, simplex
from certify.kernel.jacobian import bernstein_coefficients, require_positive_jacobian
from certify.kernel.triangulation import orientation


def _cube_with(moved: dict[int, Sequence[int | Fraction]]) -> tuple[Point, ...]:
    """Return the vertices of the unit cube, some of them moved."""
    return tuple(
        tuple(map(Fraction, moved.get(vertex, corner))) for vertex, corner in CORNERS.items()
    )


MOMENT: tuple[Point, ...] = tuple((Fraction(t), Fraction(t**2), Fraction(t**3)) for t in range(8))
"""Points of the moment curve: no four are coplanar."""

ON_A_SPHERE: tuple[Point, ...] = tuple(
    (Fraction(2 * a, 1 + s), Fraction(2 * b, 1 + s), Fraction(s - 1, 1 + s))
    for a, b in ((0, 0), (0, 1), (0, 2), (1, 0), (1, 4), (1, 5), (2, 1), (2, 5))
    for s in [a * a + b * b]
)
"""Points of the unit sphere (by stereographic projection), no four of them coplanar."""

PINCHED = _cube_with({7: [Fraction(2, 3)] * 3})
"""The unit cube with vertex 7 moved into the plane of its neighbours.

The trilinear map is (u,v,w) -> (u,v,w) - uvw/3 (1,1,1). Points with the same image differ by a
multiple of (1,1,1). Along that direction u - uvw/3 is strictly increasing: its derivative
1 - (uv + vw + wu)/3 is positive on the cube but for u = v = w = 1. So the map is injective; and
that derivative is the Jacobian.
"""

SAGGING = _cube_with({2: (1, 0, Fraction(-1, 4)), 4: (0, 1, Fraction(-1, 4))})
"""The unit cube with the ends of a diagonal of a facet moved outwards."""

DENTED: tuple[Point, ...] = tuple(
    tuple(map(Fraction, point))
    for point in (
        (1, 1, 1), (3, 2, 0), (1, 3, 2), (0, 3, 2), (0, 1, 3), (2, 0, 1), (3, 3, 4), (0, 4, 3),
    )
)  # fmt: skip
"""Vertex 3 is inside the hull of the others."""


def realizes(points: Sequence[Point], tetrahedra: Tetrahedra) -> bool:
    """Do the points realize the triangulation?"""
    try:
        require_realization(orientation(tetrahedra), chirotope(points))
    except NotRealized:
        return False
    return True


def is_convex(points: Sequence[Point]) -> bool:
    """Is every point an extreme point of the hull?"""
    try:
        require_convex_position(chirotope(points))
    except NotRealized:
        return False
    return True


def has_inner_point(points: Sequence[Point]) -> bool:
    """Is some point inside a tetrahedron of four others?"""
    return any(
        len(side) == 1 and len(other) == 4
        for circuit in circuits(chirotope(points))
        for side, other in (circuit, circuit[::-1])
    )


def has_positive_jacobian(points: Sequence[Point]) -> bool:
    """Is the Jacobian positive on the closed cube?"""
    try:
        require_positive_jacobian(points)
    except NotRealized:
        return False
    return True


def jacobian_vanishes_at_a_corner_only(points: Sequence[Point]) -> bool:
    """Is one corner coefficient of the Jacobian zero, and every other coefficient positive?"""
    coefficients = bernstein_coefficients(points)
    (smallest, value), (_, second), *_ = sorted(coefficients.items(), key=lambda item: item[1])
    return value == 0 and second > 0 and set(smallest) <= {0, 2}


def separates(points: Sequence[Point], triangle: Simplex) -> bool:
    """Are there points strictly on both sides of a triangle?"""
    signs = chirotope(points)
    sides = {
        signs[simplex(four)] * (-1) ** inversions(four)
        for four in ((*triangle, v) for v in CORNERS if v not in triangle)
    }
    return {1, -1} <= sides


def radon_points_are_as_printed(points: Sequence[Point]) -> bool:
    """Do the signs (-1)^i det(five points without the i-th) split the five as Radon's theorem does?

    For each five of the points: the numbers are an affine dependence, no smaller one, and the two
    sides share the point that it says.
    """
    rows = [(1, *point) for point in integral(points)]
    values = {four: determinant([rows[v - 1] for v in four]) for four in QUADRUPLES}
    for five in QUINTUPLES:
        terms = [(rows[v - 1], sign * values[four]) for v, four, sign in dependence(five)]
        positive = [(row, value) for row, value in terms if value > 0]
        negative = [(row, -value) for row, value in terms if value < 0]
        if len(positive) + len(negative) != len(five) or not positive or not negative:
            return False
        if _weighted_sum(positive) != _weighted_sum(negative):
            return False
    return True


def _weighted_sum(terms: Sequence[tuple[tuple[int, ...], int]]) -> list[int]:
    return [sum(row[k] * value for row, value in terms) for k in range(4)]
