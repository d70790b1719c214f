"""The Jacobian against sympy's expansion, closed forms, samples and another bound."""

from collections.abc import Sequence
from fractions import Fraction
from itertools import product
from math import comb, lcm, prod
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st
from sympy import QQ, ring

from certify.kernel.chirotope import Point
from certify.kernel.embedding import NotRealized
from certify.kernel.jacobian import (
    Coefficients,
    bernstein_coefficients,
    halves,
    require_positive_jacobian,
)
from tests.geometry import CUBE, PLACEMENTS, Placement, exact, examples, near

RING, *UVW = ring("u,v,w", QQ)
SMALL = st.integers(-3, 3)


def jacobian(points: Sequence[Sequence[int | Fraction]]) -> Any:
    """Return the Jacobian determinant of the trilinear map, expanded by sympy."""
    weights = [
        prod((x if bit else 1 - x) for x, bit in zip(UVW, corner, strict=True)) for corner in CUBE
    ]
    coordinates = [
        sum((QQ(x) * weight for x, weight in zip(axis, weights, strict=True)), RING(0))
        for axis in zip(*points, strict=True)
    ]
    a, b, c = ([coordinate.diff(x) for x in UVW] for coordinate in coordinates)
    return (
        a[0] * (b[1] * c[2] - b[2] * c[1])
        - a[1] * (b[0] * c[2] - b[2] * c[0])
        + a[2] * (b[0] * c[1] - b[1] * c[0])
    )


def evaluate(polynomial: Any, point: tuple[Any, ...]) -> Any:
    return polynomial.evaluate(list(zip(UVW, point, strict=True)))


def bernstein_form(coefficients: Coefficients) -> Any:
    """Return the polynomial with these Bernstein coefficients, expanded by sympy."""
    return sum(
        (
            value
            * prod(comb(2, i) * x**i * (1 - x) ** (2 - i) for i, x in zip(index, UVW, strict=True))
            for index, value in coefficients.items()
        ),
        RING(0),
    )


@examples(40)
@given(PLACEMENTS, st.lists(st.integers(1, 6), min_size=8, max_size=8))
def test_coefficients_are_eight_times_those_of_the_jacobian(
    placement: Placement, denominators: list[int]
) -> None:
    points = exact(
        [Fraction(x, d) for x in p] for p, d in zip(placement, denominators, strict=True)
    )
    scale = prod(lcm(*(x.denominator for x in axis)) for axis in zip(*points, strict=True))
    assert bernstein_form(bernstein_coefficients(points)) == 8 * scale * jacobian(points)


@pytest.mark.parametrize("axis", range(3))
@examples(10)
@given(st.lists(st.integers(-99, 99), min_size=27, max_size=27))
def test_halves_are_four_times_the_polynomial_on_each_half(axis: int, values: list[int]) -> None:
    coefficients: Coefficients = dict(zip(product(range(3), repeat=3), values, strict=True))
    polynomial, x = bernstein_form(coefficients), UVW[axis]
    lower, upper = halves(coefficients, axis)
    assert bernstein_form(lower) == 4 * polynomial.compose(x, x / 2)
    assert bernstein_form(upper) == 4 * polynomial.compose(x, (x + 1) / 2)


# Verdicts.

NOT_POSITIVE = "the Jacobian is not positive everywhere"
UNDECIDED = "the Jacobian is not shown positive by 6 subdivisions"


def verdict(points: Sequence[Point]) -> int | str:
    """Return the depth of subdivision, or the reason of the refusal."""
    try:
        return require_positive_jacobian(points)
    except NotRealized as error:
        return str(error)


def twisted(
    a: int | Fraction, b: int | Fraction, c: int | Fraction, d: int | Fraction
) -> tuple[Point, ...]:
    """Map the top of the unit cube by the matrix (a b; c d). The Jacobian is then

    det((1-w) + w (a b; c d)) = (1-w)^2 + (a+d) w(1-w) + (ad-bc) w^2.
    """
    return exact((a * x + b * y, c * x + d * y, z) if z else (x, y, z) for x, y, z in CUBE)


@pytest.mark.parametrize(
    ("points", "outcome"),
    [
        pytest.param(exact(CUBE), 0, id="cube"),
        pytest.param(exact((2 * x + 3 * y, y + 5 * z, 7 * z) for x, y, z in CUBE), 0, id="affine"),
        pytest.param(twisted(1, -1, 1, 1), 0, id="eighth of a turn"),
        pytest.param(twisted(0, -1, 1, -1), 1, id="third of a turn"),
        pytest.param(twisted(-2, -1, 1, -2), 3, id="sharper turn"),
        pytest.param(twisted(-2, -Fraction(1, 8), Fraction(1, 8), -2), 6, id="nearly a half turn"),
        pytest.param(twisted(-2, -Fraction(1, 16), Fraction(1, 16), -2), UNDECIDED, id="too near"),
        pytest.param(twisted(-2, 0, 0, -2), UNDECIDED, id="zero at w = 1/3"),
        pytest.param(twisted(-3, 0, 0, -3), NOT_POSITIVE, id="zero at w = 1/4"),
        pytest.param(twisted(-1, 0, 0, -1), NOT_POSITIVE, id="zero at w = 1/2"),
        pytest.param(twisted(-3, 5, 1, -3), NOT_POSITIVE, id="positive at the corners only"),
        pytest.param(twisted(1, 0, 0, -1), NOT_POSITIVE, id="inverted at the top"),
        pytest.param(twisted(1, 0, 0, 0), NOT_POSITIVE, id="top collapsed to an edge"),
        pytest.param(exact((-x, y, z) for x, y, z in CUBE), NOT_POSITIVE, id="mirrored"),
        pytest.param(exact((x, y, 0) for x, y, _ in CUBE), NOT_POSITIVE, id="flat"),
        pytest.param(exact([(0, 0, 0)] * 8), NOT_POSITIVE, id="one point"),
        pytest.param(exact([CUBE[1], *CUBE[1:]]), NOT_POSITIVE, id="edge of length zero"),
    ],
)
def test_verdict(points: Sequence[Point], outcome: int | str) -> None:
    assert verdict(points) == outcome


@pytest.mark.parametrize(
    "points",
    [exact(CUBE[1:]), exact([*CUBE, CUBE[0]]), exact([CUBE[0][:2], *CUBE[1:]])],
    ids=["seven points", "nine points", "a point of the plane"],
)
def test_other_than_eight_points_of_space_are_an_error(points: Sequence[Point]) -> None:
    with pytest.raises(ValueError, match=r"zip\(\)"):
        require_positive_jacobian(points)


@examples(100)
@given(SMALL, SMALL, SMALL, SMALL)
def test_verdict_on_twisted_cubes_is_that_of_a_quadratic(a: int, b: int, c: int, d: int) -> None:
    """1 + t x + n x^2 > 0 for all x in [0, oo] iff n > 0, and t >= 0 or t^2 < 4n."""
    t, n = a + d, a * d - b * c
    positive = n > 0 and (t >= 0 or t * t < 4 * n)
    assert isinstance(verdict(twisted(a, b, c, d)), int) == positive


def decided_otherwise(polynomial: Any) -> bool | None:
    """Is the polynomial positive on the unit cube? By its monomials, on up to 200 smaller boxes.

    On [-1,1]^3 it is at least its constant coefficient, minus the absolute value of every other
    one, except that the monomials with even exponents are not below zero.
    """
    for x in UVW:
        polynomial = polynomial.compose(x, (x + 1) / 2)
    pending = [(polynomial, 0)]
    for _ in range(200):
        if not pending:
            return True
        box, axis = pending.pop(0)
        if any(evaluate(box, corner) <= 0 for corner in product((-1, 1), repeat=3)):
            return False
        constant, loss = box.coeff(1), 0
        for exponents, coefficient in (box - constant).terms():
            odd = any(i % 2 for i in exponents)
            loss += abs(coefficient) if odd else max(-coefficient, 0)
        if constant <= loss:
            x = UVW[axis]
            pending += [(box.compose(x, (x + side) / 2), (axis + 1) % 3) for side in (-1, 1)]
    return None


TURNED: Placement = tuple((-y, x - y, z) if z else (x, y, z) for x, y, z in CUBE)
"""The top turned by a third, where the Jacobian falls to 1/4."""


@pytest.mark.parametrize(
    ("base", "size", "shift"),
    [(CUBE, 4, 1), (CUBE, 8, 3), (CUBE, 4, 2), (CUBE, 1, 1), (TURNED, 6, 1)],
)
def test_verdict_near(base: Placement, size: int, shift: int) -> None:
    """Samples and another bound agree with it."""

    @examples(40)
    @given(near(base, size, shift))
    def run(placement: Placement) -> None:
        polynomial, positive = jacobian(placement), isinstance(verdict(exact(placement)), int)
        assert decided_otherwise(polynomial) in (positive, None)
        if positive:
            for sample in product([QQ(i, 5) for i in range(6)], repeat=3):
                assert evaluate(polynomial, sample) > 0

    run()
