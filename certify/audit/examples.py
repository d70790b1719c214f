"""Placements of eight points, vertex 1 first, that decide statements of the paper."""

from fractions import Fraction

from certify.kernel.chirotope import Point


def _points(*rows: tuple[int, ...]) -> tuple[Point, ...]:
    return tuple(tuple(map(Fraction, row)) for row in rows)


ON_A_SPHERE: tuple[Point, ...] = tuple(
    (Fraction(2 * a, 1 + s), Fraction(2 * b, 1 + s), Fraction(s - 1, 1 + s))
    for a, b in ((0, 0), (0, 1), (0, 2), (1, 0), (1, 4), (1, 5), (2, 1), (2, 5))
    for s in [a * a + b * b]
)
"""Points of the unit sphere, by stereographic projection."""

DENTED = _points(
    (1, 1, 1), (3, 2, 0), (1, 3, 2), (0, 3, 2), (0, 1, 3), (2, 0, 1), (3, 3, 4), (0, 4, 3)
)
"""A hexahedron with vertex 3 inside the hull of the others."""

IN_THE_PLANE = (
    ((0, 0), (3, 0), (0, 3), (1, 1)),
    ((0, 0), (3, 0), (0, 3), (2, 2)),
)
"""Four points, the last one inside the triangle of the others, and then moved out."""
