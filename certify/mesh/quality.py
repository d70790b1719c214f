"""How good is a valid hexahedron? No verdict depends on it."""

from collections.abc import Sequence
from fractions import Fraction
from heapq import heappop, heappush
from itertools import count, product
from math import lcm, prod, sqrt

from certify.kernel.chirotope import Point, denominators, determinant
from certify.kernel.hexahedron import CORNERS
from certify.kernel.jacobian import Coefficients, bernstein_coefficients, halves
from certify.kernel.validity import across

NEAR = Fraction(1, 20)
"""The bounds of the least Jacobian are to differ by no more than this part of the upper one."""

BOXES = 512
"""More parts of the cube are not looked at."""

_CORNERS = tuple(product((0, 2), repeat=3))


def jacobian_bounds(points: Sequence[Point]) -> tuple[Fraction, Fraction]:
    """Return exact bounds of the least Jacobian on the closed unit cube, in volume units.

    The lower one is the least Bernstein coefficient on the parts of a subdivided cube, the upper
    one the least value at their corners (see kernel/jacobian.py). The part with the least
    coefficient is divided next.
    """
    unit = 8 * prod(denominators(points))
    first = bernstein_coefficients(points)
    counter = count()
    parts = [(Fraction(min(first.values()), unit), next(counter), unit, first)]
    upper = Fraction(min(first[corner] for corner in _CORNERS), unit)
    while upper - parts[0][0] > NEAR * abs(upper) and len(parts) < BOXES:
        _, _, unit, box = heappop(parts)
        for part in _eighths(box):
            least = Fraction(min(part.values()), 64 * unit)
            upper = min(upper, Fraction(min(part[c] for c in _CORNERS), 64 * unit))
            heappush(parts, (least, next(counter), 64 * unit, part))
    return parts[0][0], upper


def _eighths(box: Coefficients) -> list[Coefficients]:
    """Return the coefficients, times 64, on the eight parts of a box halved along each axis."""
    boxes = [box]
    for axis in range(3):
        boxes = [half for box in boxes for half in halves(box, axis)]
    return boxes


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
