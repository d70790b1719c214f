"""Tetrahedra overlap iff a search for a common inner point, written for this test, finds one."""

from fractions import Fraction
from itertools import combinations
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray
from scipy.spatial import Delaunay

from certify.mesh.overlaps import coincident, overlap, separated, sides
from certify.mesh.signs import numbers, orientations, signs

Array = NDArray[Any]


def det(a: Any, b: Any, c: Any) -> Any:
    return (
        a[0] * (b[1] * c[2] - b[2] * c[1])
        - a[1] * (b[0] * c[2] - b[2] * c[0])
        + a[2] * (b[0] * c[1] - b[1] * c[0])
    )


def half_spaces(tetrahedron: Any) -> list[tuple[list[Fraction], Fraction]]:
    """Return (n, d) for each side, none if it is flat: inside is n.x > d."""
    found = []
    for k in range(4):
        a, b, c, inner = ([Fraction(x) for x in tetrahedron[(k + i) % 4]] for i in range(4))
        u, v = ([x - y for x, y in zip(end, a, strict=True)] for end in (b, c))
        n = [u[i - 2] * v[i - 1] - u[i - 1] * v[i - 2] for i in range(3)]
        above = dot(n, inner) - dot(n, a)
        if above:
            n = [x * (1 if above > 0 else -1) for x in n]
            found.append((n, dot(n, a)))
    return found


def dot(a: Any, b: Any) -> Any:
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def have_a_common_inner_point(one: Any, other: Any) -> bool:
    """The middle of the vertices of the intersection is inside, if anything is."""
    spaces = half_spaces(one) + half_spaces(other)
    vertices = []
    for three in combinations(spaces, 3):
        rows, right = [n for n, _ in three], [d for _, d in three]
        below = det(*rows)
        if below:
            columns = list(zip(*rows, strict=True))
            point = tuple(
                det(*(right if j == i else columns[j] for j in range(3))) / below for i in range(3)
            )
            if all(dot(n, point) >= d for n, d in spaces):
                vertices.append(point)
    if not vertices:
        return False
    middle = [sum(own) / len(vertices) for own in zip(*vertices, strict=True)]
    return all(dot(n, middle) > d for n, d in spaces)


small = st.lists(st.tuples(*[st.integers(-2, 2)] * 3), min_size=8, max_size=8)
"""Eight points that often are in special position."""


@given(small)
@settings(deadline=None, max_examples=300)
def test_separated_are_those_without_a_common_inner_point(eight: list[tuple[int, ...]]) -> None:
    one, other = eight[:4], eight[4:]
    if half_spaces(one) and half_spaces(other):
        found = separated(signs(np.array([eight], float)))[0]
        assert found == (not have_a_common_inner_point(one, other))


def overlapping(points: Array, cells: Array) -> set[tuple[int, int]]:
    places = [[tuple(points[v].tolist()) for v in cell] for cell in cells.tolist()]
    return {
        (i, j)
        for i, j in combinations(range(len(cells)), 2)
        if have_a_common_inner_point(places[i], places[j])
    }


def positive(points: Any, cells: Any) -> Array:
    """Return the tetrahedra that are not flat, with positive determinants."""
    rows = np.array(cells, np.int64)
    found = orientations(points, rows)
    rows[found < 0] = rows[found < 0][:, [0, 1, 3, 2]]
    kept: Array = rows[found != 0]
    return kept


def spoiled_mesh(seed: int) -> tuple[Array, Array]:
    """Return what is left of a mesh when a vertex was moved, or two meshes near one another."""
    random = np.random.default_rng(seed)
    points = random.integers(0, 9, (12, 3)).astype(float)
    if seed % 2:
        cells = positive(points, Delaunay(points).simplices)
        points[seed % 12] = random.integers(0, 9, 3)
        return points, cells[orientations(points, cells) > 0]
    near, far = points[:6], points[6:] + random.integers(0, 9, 3)
    both = [Delaunay(near).simplices, 6 + Delaunay(far).simplices]
    points = np.concatenate([near, far])
    return points, positive(points, np.concatenate(both))


def test_a_mesh_overlaps_iff_two_of_its_tetrahedra_do() -> None:
    answers = []
    for seed in range(24):
        points, cells = spoiled_mesh(seed)
        one, _, outside = sides(len(points), cells)
        if one < 0:
            found, wanted = overlap(points, cells, outside), overlapping(points, cells)
            assert (found is not None) == bool(wanted)
            assert found is None or tuple(sorted(found)) in wanted
            answers.append(found is not None)
    assert {*answers} == {True, False}
    assert len(answers) > 10


def far_away(points: Array) -> Any:
    """Return the same shape in numbers that no filter decides."""
    return numbers(np.array([[Fraction(int(x)) + 10**40 for x in p] for p in points], object))


def test_fractions_are_compared_exactly() -> None:
    for seed in range(0, 20, 2):
        points, cells = spoiled_mesh(seed)
        _, _, outside = sides(len(points), cells)
        assert (overlap(far_away(points), cells, outside) is None) == (
            overlap(points, cells, outside) is None
        )


CORNER = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]], float)


@pytest.mark.parametrize(
    ("shift", "wanted"),
    [
        ((0, 0, 1), False),  # a vertex on a vertex
        ((0.25, 0.25, 0.5), False),  # a vertex inside a triangle
        ((0.25, 0.25, 0.5 - 2.0**-54), True),
        ((0, 0.5, 0), True),
        ((0, 0, 0), True),  # the same place
        ((0.0625, 0.0625, 0.0625), True),
        ((0.5, 0, 0.5), False),  # edges that touch
        ((2.0**60, 0, 0), False),
    ],
)
def test_touching_is_not_overlapping(shift: tuple[float, ...], wanted: bool) -> None:
    points = np.concatenate([CORNER, CORNER + shift])
    cells = np.array([[0, 1, 2, 3], [4, 5, 6, 7]])
    found = overlap(points, cells, np.ones(2, np.bool_))
    assert (found is not None) == wanted


def test_one_inside_another_overlaps() -> None:
    """Their surfaces do not meet."""
    points = np.concatenate([16 * CORNER, CORNER + 1])
    assert overlap(points, np.array([[0, 1, 2, 3], [4, 5, 6, 7]]), np.ones(2, np.bool_))


@pytest.mark.parametrize("chunk", [1, 5, 1 << 20])
def test_outside_are_those_with_a_triangle_in_no_other(chunk: int) -> None:
    points = np.random.default_rng(3).random((60, 3))
    mesh = Delaunay(points)
    cells = positive(points, mesh.simplices)
    assert len(cells) == len(mesh.simplices)
    one, other, outside = sides(len(points), cells, chunk)
    assert (one, other) == (-1, -1)
    assert outside.tolist() == (mesh.neighbors < 0).any(axis=1).tolist()
    assert 0 < outside.sum() < len(cells)


def test_two_on_the_same_side_are_named() -> None:
    points = np.concatenate([CORNER, [[2, 2, 2]]])
    assert sides(5, positive(points, [[0, 1, 2, 3], [0, 1, 2, 4]]))[:2] == (0, 1)


def test_vertices_at_the_same_point_are_found() -> None:
    points = np.concatenate([CORNER, CORNER])
    assert coincident(points, [np.array([[0, 1, 2, 3]])]) is None
    assert coincident(points, [np.array([[0, 1, 2, 3]]), np.array([[5, 0, 2, 3]])]) == (1, 5)
    zeros = np.array([[0.0, 0, 0], [-0.0, 0, 0], [1, 0, 0], [0, 1, 0]])
    assert coincident(zeros, [np.array([[0, 1, 2, 3]])]) == (0, 1)
    exact = np.array([[Fraction(x) / 3 for x in p] for p in points.tolist()], object)
    assert coincident(exact, [np.array([[0, 1, 2, 3]]), np.array([[5, 0, 2, 3]])]) == (1, 5)
