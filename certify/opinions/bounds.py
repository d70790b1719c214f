"""Is the Jacobian of the trilinear map positive on the cube? Values at 27 nodes of each box."""

from collections.abc import Sequence
from fractions import Fraction
from itertools import product
from typing import TypeAlias

from certify.opinions.planes import volume

Point: TypeAlias = Sequence[Fraction]

_CORNERS = ((0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1))
_ORIGIN = (Fraction(0),) * 3


def jacobian_fault(points: Sequence[Point]) -> str | None:
    """Return why the Jacobian is not shown to be positive on the closed cube, or None if it is."""
    pending = [(Fraction(0),) * 3]
    size = Fraction(1)
    for _ in range(8):
        left = []
        for corner in pending:
            nodes = {
                ijk: _jacobian(points, [c + size * i / 2 for c, i in zip(corner, ijk, strict=True)])
                for ijk in product(range(3), repeat=3)
            }
            if min(nodes.values()) <= 0:
                return "the Jacobian is not positive"
            if min(_bernstein(nodes).values()) <= 0:
                left.append(corner)
        if not left:
            return None
        size /= 2
        pending = [
            (a + size * i, b + size * j, c + size * k)
            for a, b, c in left
            for i, j, k in product((0, 1), repeat=3)
        ]
    return "the Jacobian is not shown to be positive"


def _jacobian(points: Sequence[Point], at: Sequence[Fraction]) -> Fraction:
    columns = []
    for axis in range(3):
        column = [Fraction(0)] * 3
        for corner, point in zip(_CORNERS, points, strict=True):
            weight = Fraction(2 * corner[axis] - 1)
            for other in range(3):
                if other != axis:
                    weight *= at[other] if corner[other] else 1 - at[other]
            column = [x + weight * y for x, y in zip(column, point, strict=True)]
        columns.append(column)
    return volume(_ORIGIN, *columns)


def _bernstein(nodes: dict[tuple[int, ...], Fraction]) -> dict[tuple[int, ...], Fraction]:
    """Return the coefficients of a polynomial of degree two in each variable from its values."""
    for axis in range(3):
        found = dict(nodes)
        for index in nodes:
            if index[axis] == 1:
                low, high = ((*index[:axis], i, *index[axis + 1 :]) for i in (0, 2))
                found[index] = 2 * nodes[index] - (nodes[low] + nodes[high]) / 2
        nodes = found
    return nodes
