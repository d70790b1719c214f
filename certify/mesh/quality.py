"""How good is a valid hexahedron? No verdict depends on it."""

from collections.abc import Sequence
from fractions import Fraction
from math import lcm, prod, sqrt

from certify.kernel.chirotope import Point, denominators, determinant
from certify.kernel.hexahedron import CORNERS
from certify.kernel.jacobian import bernstein_coefficients, halves
from certify.kernel.validity import across

DEPTH = 3
"""Subdivisions behind the lower bound; each brings it closer to the minimum."""


def jacobian_lower_bound(points: Sequence[Point]) -> Fraction:
    """Return an exact lower bound of the Jacobian on the closed unit cube, in volume units.

    It is the least Bernstein coefficient on the 8^DEPTH parts of the cube (see jacobian.py).
    """
    boxes = [bernstein_coefficients(points)]
    unit = 8 * prod(denominators(points))
    for axis in (0, 1, 2) * DEPTH:
        boxes = [half for box in boxes for half in halves(box, axis)]
        unit *= 4
    return Fraction(min(min(box.values()) for box in boxes), unit)


def scaled_jacobians(points: Sequence[Point]) -> list[float]:
    """Return the scaled Jacobian at the corners 1..8: 1 for a right-angled corner, at most 1.

    It is the determinant of the three edges at the corner over the product of their lengths.
    """
    scale = lcm(*denominators(points))  # one for all axes, as lengths are compared
    scaled = [[int(x * scale) for x in point] for point in points]
    result = []
    for vertex, corner in CORNERS.items():
        edges = [
            [
                h - t
                for t, h in zip(scaled[vertex - 1], scaled[across(vertex, axis) - 1], strict=True)
            ]
            for axis in range(3)
        ]
        value = (-1) ** sum(corner) * determinant(edges)
        squares = prod(sum(x * x for x in edge) for edge in edges)
        # The square is at most 1, so it fits into a float however large the integers are.
        square = float(Fraction(value**2, squares)) if squares else 0.0
        result.append(((value > 0) - (value < 0)) * sqrt(square))
    return result
