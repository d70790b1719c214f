"""Is the Jacobian of the trilinear hexahedron positive on the whole closed unit cube? Exactly.

The trilinear map sends (u,v,w) in [0,1]^3 to the sum over vertices of (weight of the vertex's
reference corner) times point. Its Jacobian determinant J has degree two in each variable, so it is
a combination of the 27 products of quadratic Bernstein polynomials; these are non-negative with
sum one, hence J > 0 where all 27 coefficients are positive (Johnen, Remacle and Geuzaine 2013,
"Geometrical validity of curvilinear finite elements"). Where not, the cube is halved in each
direction and each part is asked again. At the corners of a box J equals the corner coefficients,
so one that is not positive settles the matter the other way.
"""

from collections.abc import Sequence
from itertools import product
from math import comb, prod
from typing import TypeAlias

from certify.kernel.chirotope import Point, determinant, integral
from certify.kernel.embedding import NotRealized
from certify.kernel.hexahedron import CORNERS

Coefficients: TypeAlias = dict[tuple[int, ...], int]
"""(i, j, k) in {0,1,2}^3 -> a positive multiple, the same for all, of the Bernstein coefficient."""

MAX_DEPTH = 6
"""Boxes smaller than 2^-6 are not tried: a Jacobian that needs them is refused as undecided."""

_BIT = (0, 1)


def bernstein_coefficients(points: Sequence[Point]) -> Coefficients:
    """Return eight times the 27 Bernstein coefficients of J, for the points made integral.

    The derivative in u is constant in u and linear in v and w, with the four edges in direction u
    as coefficients; likewise for v and w. In a product of linear Bernstein polynomials
    B_a B_b = B^2_{a+b} / binomial(2, a+b). So coefficient (i,j,k) is a sum of determinants of
    edges, divided by the three binomials.
    """
    vertex_at: dict[tuple[int, ...], int] = {corner: v for v, corner in CORNERS.items()}
    scaled = dict(zip(CORNERS, integral(points), strict=True))

    def edge(start: tuple[int, ...], end: tuple[int, ...]) -> list[int]:
        tail, head = scaled[vertex_at[start]], scaled[vertex_at[end]]
        return [h - t for t, h in zip(tail, head, strict=True)]

    total: Coefficients = dict.fromkeys(product(range(3), repeat=3), 0)
    for v1, w1, u2, w2, u3, v3 in product(_BIT, repeat=6):
        total[u2 + u3, v1 + v3, w1 + w2] += determinant(
            [
                edge((0, v1, w1), (1, v1, w1)),
                edge((u2, 0, w2), (u2, 1, w2)),
                edge((u3, v3, 0), (u3, v3, 1)),
            ]
        )
    return {index: value * 8 // prod(comb(2, i) for i in index) for index, value in total.items()}


def halves(coefficients: Coefficients, axis: int) -> tuple[Coefficients, Coefficients]:
    """Return the coefficients, times four, on the two halves of the box (de Casteljau)."""
    lower: Coefficients = {}
    upper: Coefficients = {}
    for index in coefficients:
        if index[axis] == 0:
            i0, i1, i2 = ((*index[:axis], i, *index[axis + 1 :]) for i in range(3))
            a, b, c = coefficients[i0], coefficients[i1], coefficients[i2]
            lower[i0], lower[i1], lower[i2] = 4 * a, 2 * a + 2 * b, a + 2 * b + c
            upper[i0], upper[i1], upper[i2] = a + 2 * b + c, 2 * b + 2 * c, 4 * c
    return lower, upper


def require_positive_jacobian(points: Sequence[Point]) -> int:
    """Raise :class:`NotRealized` unless J > 0 on [0,1]^3; return the depth of subdivision used."""
    boxes, depth = [bernstein_coefficients(points)], 0
    while boxes := [box for box in boxes if min(box.values()) <= 0]:
        for box in boxes:
            if min(box[corner] for corner in product((0, 2), repeat=3)) <= 0:
                raise NotRealized("the Jacobian is not positive everywhere")
        if depth == MAX_DEPTH:
            raise NotRealized(f"the Jacobian is not shown positive by {MAX_DEPTH} subdivisions")
        for axis in range(3):
            boxes = [half for box in boxes for half in halves(box, axis)]
        depth += 1
    return depth
