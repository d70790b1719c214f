"""Is the Jacobian of the trilinear hexahedron positive on the closed cube? By its Taylor form.

Nothing of the kernel is used, and no Bernstein polynomials. The trilinear map and its Jacobian J
are written out as polynomials in u, v, w, by multiplication. In coordinates t in [-1,1]^3 of a box,
J is a sum of coefficients c_a times monomials t^a, and each monomial but the constant one lies
between -1 and 1, or between 0 and 1 if its exponents are even. So

    J >= c_0 - sum of |c_a| (exponents not all even) - sum of max(0, -c_a) (all even, not all zero).

Where this is not positive, the box is halved. Where J > 0 on the whole closed cube this comes to
an end: on small boxes c_0 is near J, the other coefficients near zero. On the other hand, one point
with J <= 0, sought among the corners and centres of the boxes, proves the opposite.
"""

from collections.abc import Sequence
from fractions import Fraction
from itertools import product
from math import comb
from typing import NamedTuple, TypeAlias

from certify.opinions.balls import CORNERS

Number: TypeAlias = int | Fraction
Polynomial: TypeAlias = dict[tuple[int, int, int], Number]
"""Exponents of u, v, w -> coefficient."""

MAX_BOXES = 2000
"""So many boxes are looked at before the question is left undecided."""

ONE: Polynomial = {(0, 0, 0): 1}


def plus(p: Polynomial, q: Polynomial, factor: Number = 1) -> Polynomial:
    """Return p + factor q."""
    return {a: p.get(a, 0) + factor * q.get(a, 0) for a in {**p, **q}}


def times(p: Polynomial, q: Polynomial) -> Polynomial:
    """Return the product."""
    total: Polynomial = {}
    for ((i, j, k), x), ((a, b, c), y) in product(p.items(), q.items()):
        place = (i + a, j + b, k + c)
        total[place] = total.get(place, 0) + x * y
    return total


def variable(axis: int) -> Polynomial:
    """Return u, v or w."""
    return {(int(axis == 0), int(axis == 1), int(axis == 2)): 1}


def derivative(p: Polynomial, axis: int) -> Polynomial:
    """Return the derivative in u, v or w."""
    total: Polynomial = {}
    for (i, j, k), coefficient in p.items():
        power = (i, j, k)[axis]
        if power:
            lower = (i - (axis == 0), j - (axis == 1), k - (axis == 2))
            total[lower] = power * coefficient
    return total


def trilinear(values: Sequence[Number]) -> Polynomial:
    """Return the polynomial, linear in each variable, with these values at the eight corners."""
    total: Polynomial = {}
    for corner, value in zip(CORNERS.values(), values, strict=True):
        weight = ONE
        for axis, side in enumerate(corner):
            factor = variable(axis) if side else plus(ONE, variable(axis), -1)
            weight = times(weight, factor)
        total = plus(total, weight, value)
    return total


def jacobian(points: Sequence[Sequence[Number]]) -> Polynomial:
    """Return the determinant of the derivatives of the trilinear map, vertex 1 first."""
    x, y, z = (trilinear([point[k] for point in points]) for k in range(3))
    total: Polynomial = {}
    for i, j, k in ((0, 1, 2), (1, 2, 0), (2, 0, 1)):
        minor = plus(
            times(derivative(y, j), derivative(z, k)),
            times(derivative(y, k), derivative(z, j)),
            -1,
        )
        total = plus(total, times(derivative(x, i), minor))
    return total


class Box(NamedTuple):
    """A part of the cube, and J on it."""

    centre: tuple[Fraction, ...]
    half: tuple[Fraction, ...]
    """Half the size in each direction."""
    terms: Polynomial
    """A positive multiple of J, in coordinates that are -1 and 1 on the sides of the box."""


def stretched(p: Polynomial, axis: int, offset: int, denominator: int) -> Polynomial:
    """Put (offset + t) / denominator for one variable, and multiply by the denominator squared.

    The degree in that variable must not be over two.
    """
    total: Polynomial = {}
    for exponents, coefficient in p.items():
        power = exponents[axis]
        for new in range(power + 1):
            i, j, k = (new if at == axis else e for at, e in enumerate(exponents))
            term = coefficient * comb(power, new) * offset ** (power - new)
            total[i, j, k] = total.get((i, j, k), 0) + term * denominator ** (2 - power)
    return total


def whole_cube(polynomial: Polynomial) -> Box:
    """Return the unit cube as a box."""
    for axis in range(3):
        polynomial = stretched(polynomial, axis, 1, 2)
    return Box((Fraction(1, 2),) * 3, (Fraction(1, 2),) * 3, polynomial)


def halves(box: Box, axis: int) -> list[Box]:
    """Return the two halves of a box."""
    half = tuple(h / 2 if k == axis else h for k, h in enumerate(box.half))
    return [
        Box(
            tuple(c + side * half[k] if k == axis else c for k, c in enumerate(box.centre)),
            half,
            stretched(box.terms, axis, side, 2),
        )
        for side in (-1, 1)
    ]


def losses(box: Box) -> dict[tuple[int, int, int], Number]:
    """Return for each monomial but the constant how far below zero its term may come."""
    result: dict[tuple[int, int, int], Number] = {}
    for exponents, coefficient in box.terms.items():
        if any(exponents):
            most = coefficient if any(e % 2 for e in exponents) else 0
            result[exponents] = max(most, -coefficient)
    return result


def point_not_positive(box: Box) -> tuple[Fraction, ...] | None:
    """Return the centre or a corner of the box where J is not positive, if it is not at all."""
    for i, j, k in ((0, 0, 0), *product((-1, 1), repeat=3)):
        if sum(x * i**a * j**b * k**c for (a, b, c), x in box.terms.items()) <= 0:
            return tuple(
                c + side * h for c, side, h in zip(box.centre, (i, j, k), box.half, strict=True)
            )
    return None


def jacobian_fault(points: Sequence[Sequence[Number]]) -> str | None:
    """Say why J is not positive on [0,1]^3, or not shown to be; None if it is positive."""
    pending = [whole_cube(jacobian(points))]
    for box in pending:  # which grows meanwhile: the largest boxes come first
        loss = losses(box)
        if box.terms.get((0, 0, 0), 0) > sum(loss.values()):
            continue
        if point := point_not_positive(box):
            return f"the Jacobian is not positive at ({', '.join(map(str, point))})"
        if len(pending) > MAX_BOXES:
            return f"undecided: the Jacobian is not shown to be positive with {MAX_BOXES} boxes"
        in_direction = [sum(x for e, x in loss.items() if e[axis]) for axis in range(3)]
        pending += halves(box, in_direction.index(max(in_direction)))
    return None
