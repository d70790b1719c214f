"""The quality of a hexahedron, against direct evaluation."""

from fractions import Fraction
from itertools import product
from math import dist, isclose

import pytest
from hypothesis import given
from hypothesis import strategies as st

from certify.kernel.certificate import Certificate, Yes
from certify.kernel.chirotope import Point
from certify.mesh.quality import NEAR, jacobian_bounds, scaled_jacobians
from tests.geometry import CUBE, PLACEMENTS, Placement, exact, examples, leibniz, near

Points = tuple[Point, ...]

STEPS = [Fraction(k, 4) for k in range(5)]
GRID = list(product(STEPS, repeat=3))


def jacobian_at(points: Points, place: tuple[Fraction, ...]) -> Fraction:
    """Return the Jacobian of the trilinear map: the determinant of its three derivatives."""
    columns = []
    for axis in range(3):
        column = [Fraction(0)] * 3
        for corner, point in zip(CUBE, points, strict=True):
            weight = Fraction(2 * corner[axis] - 1)
            for other, x in enumerate(place):
                if other != axis:
                    weight *= x if corner[other] else 1 - x
            column = [total + weight * x for total, x in zip(column, point, strict=True)]
        columns.append(column)
    return leibniz(columns)


def neighbours(vertex: int) -> list[int]:
    """Return the indices of the vertices across the three axes."""
    flipped = [tuple(x ^ (axis == k) for k, x in enumerate(CUBE[vertex])) for axis in range(3)]
    return [CUBE.index(corner) for corner in flipped]


@examples(25)
@given(st.one_of(PLACEMENTS, near(CUBE, 10, 4)))
def test_bounds_are_bounds(placement: Placement) -> None:
    points = exact(placement)
    least, most = jacobian_bounds(points)
    assert (
        least <= most <= min(jacobian_at(points, place) for place in product(STEPS[::4], repeat=3))
    )
    assert all(least <= jacobian_at(points, place) for place in GRID)


@pytest.mark.parametrize("scale", [1, 10, Fraction(1, 7)])
def test_lower_bound_of_a_box_is_its_volume(scale: Fraction) -> None:
    points = exact([(scale * x, 2 * scale * y, z) for x, y, z in CUBE])
    assert jacobian_bounds(points)[0] == 2 * scale**2


@examples(10)
@given(near(CUBE, 10, 4), st.fractions(Fraction(1, 9), 9, max_denominator=9))
def test_lower_bound_is_a_volume(placement: Placement, scale: Fraction) -> None:
    points = exact(placement)
    larger = exact([[scale * x for x in point] for point in points])
    assert jacobian_bounds(larger)[0] == scale**3 * jacobian_bounds(points)[0]


def test_lower_bound_is_sharp_at_corners() -> None:
    """A value at a corner is a coefficient, and here the least."""
    points = exact([*CUBE[:6], (Fraction(4, 5),) * 3, CUBE[7]])
    least = min(jacobian_at(points, place) for place in GRID)
    assert least == jacobian_at(points, (Fraction(1),) * 3) > 0
    assert jacobian_bounds(points)[0] == least


def test_lower_bound_comes_near_inside() -> None:
    """A cube whose top is turned by more than a right angle has its least value half way up."""
    turned = [(x, y, z) if z == 0 else (1 - y, x, z) for x, y, z in CUBE]
    twisted = [(2 * x - y, x + 2 * y, z) if z else (2 * x, 2 * y, z) for x, y, z in turned]
    points = exact(twisted)
    middle = jacobian_at(points, (Fraction(1, 2),) * 3)
    least, most = jacobian_bounds(points)
    assert 0 < least <= middle < jacobian_at(points, (Fraction(0),) * 3)
    assert most - least <= NEAR * most


def test_bounds_of_valid_witnesses_are_near(
    certificates: dict[str, Certificate],
) -> None:
    for certificate in certificates.values():
        answer = certificate.answers["valid"]
        if isinstance(answer, Yes):
            least, most = jacobian_bounds(answer.points)
            assert 0 < least <= most
            assert most - least <= NEAR * most
            assert least <= min(jacobian_at(answer.points, place) for place in GRID[::7])


@examples(100)
@given(st.one_of(PLACEMENTS, near(CUBE, 10, 4)))
def test_scaled_jacobians_are_those_of_the_corners(placement: Placement) -> None:
    points = exact(placement)
    found = scaled_jacobians(points)
    for vertex, corner in enumerate(CUBE):
        value = float(jacobian_at(points, tuple(map(Fraction, corner))))
        for other in neighbours(vertex):
            length = dist(placement[vertex], placement[other])
            value = value / length if length else 0.0
        assert isclose(found[vertex], value, abs_tol=1e-9)
        assert abs(found[vertex]) <= 1 + 1e-9


def test_scaled_jacobians_of_the_cube() -> None:
    assert scaled_jacobians(exact(CUBE)) == [1.0] * 8
    assert scaled_jacobians(exact([(-x, y, z) for x, y, z in CUBE])) == [-1.0] * 8
    assert scaled_jacobians(exact([(0, 0, 0)] * 8)) == [0.0] * 8


@examples(30)
@given(near(CUBE, 10, 4), st.fractions(Fraction(1, 9), 9, max_denominator=9))
def test_scaled_jacobians_have_no_unit(placement: Placement, scale: Fraction) -> None:
    larger = exact([[scale * x for x in point] for point in placement])
    assert scaled_jacobians(larger) == pytest.approx(scaled_jacobians(exact(placement)))
