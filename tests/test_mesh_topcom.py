"""TOPCOM and we find the same triangulations of convex point sets, degenerate ones too."""

from collections import Counter
from functools import cache
from itertools import chain, product
from random import Random

import numpy as np
import pytest

from certify.kernel.hexahedron import (
    BOUNDARIES,
    CORNERS,
    FACETS,
    boundary_triangles,
    simplex,
    sorted_with_sign,
)
from certify.kernel.triangulation import triangles
from certify.mesh.instances import QUADRUPLE_INDEX
from certify.mesh.realized import fillable_at_all, labelled, triangulations
from certify.mesh.signs import signs
from tests.topcom import ALL, Tetrahedra, all_triangulations

pytestmark = pytest.mark.skipif(ALL is None, reason="TOPCOM is not installed")

Points = tuple[tuple[int, ...], ...]

CUBE: Points = tuple(CORNERS.values())
FACET_VERTICES = {simplex(facet) for facet in FACETS}
BY_TRIANGLES = {frozenset(boundary_triangles(own)): k for k, own in enumerate(BOUNDARIES)}


def moved_cubes() -> list[Points]:
    """Cubes whose vertices are moved a little, so that many facets stay plane, or more."""
    random = Random(1)
    found = [CUBE]
    for size, reach in product((3, 6, 40, 1000), (1, 2)):
        for _ in range(10):
            moved = [[size * x + random.randint(-reach, reach) for x in own] for own in CUBE]
            found.append(tuple(map(tuple, moved)))
    return found


def frusta() -> list[Points]:
    """Two squares of different sizes, one pushed aside: all facets, or four, are plane."""
    found: list[Points] = []
    for a, b, size, turned in product((-1, 0, 2), (0, 1), (1, 3, 4), (0, 1)):
        bottom = [(4 * x, 4 * y, 0) for x, y, _ in CUBE[:4]]
        top = [(a + size * x + turned * y, b + size * y - turned * x, 3) for x, y, _ in CUBE[:4]]
        found.append((*bottom, *top))
    return found


def on_a_sphere() -> list[Points]:
    """Points in convex position, up to rounding; the hull need not have the facets' triangles."""
    centred = np.array(CUBE) - 0.5
    drawn = centred + 0.4 * np.random.default_rng(2).normal(size=(60, 8, 3))
    scaled = 1000 * drawn / np.linalg.norm(drawn, axis=2, keepdims=True)
    return [tuple(tuple(map(int, point)) for point in own.round()) for own in scaled]


ALL_POINTS = [*moved_cubes(), *frusta(), *on_a_sphere()]

found_by_topcom = cache(all_triangulations)


def boundary(tetrahedra: Tetrahedra) -> int | None:
    """Return which of the 64 boundaries some tetrahedra have, or None if another."""
    times = Counter(chain.from_iterable(map(triangles, tetrahedra)))
    return BY_TRIANGLES.get(frozenset(face for face in times if times[face] == 1))


def without_boundary_tetrahedra(tetrahedra: Tetrahedra) -> Tetrahedra:
    return tuple(t for t in tetrahedra if t not in FACET_VERTICES)


def ours(points: Points) -> dict[Tetrahedra, int]:
    """Return the realized triangulations with their boundaries, those of the mirror image too."""
    both = triangulations([points, [(-x, y, z) for x, y, z in points]]).any(axis=0)
    return {labelled()[k].tetrahedra: labelled()[k].boundary for k in np.flatnonzero(both)}


def is_hull(points: Points, diagonals: int) -> bool:
    """Is every point on one side of every triangle of a boundary, or in its plane?"""
    own = signs([points])[0]
    sides = set()
    for triangle in boundary_triangles(BOUNDARIES[diagonals]).values():
        for vertex in {*range(1, 9)} - {*triangle}:
            quadruple, parity = sorted_with_sign((*triangle, vertex))
            sides.add(parity * int(own[QUADRUPLE_INDEX[quadruple]]))
    return sides <= {0, 1} or sides <= {0, -1}


@pytest.mark.parametrize("points", ALL_POINTS)
def test_every_triangulation_with_the_facets_is_ours(points: Points) -> None:
    known = ours(points)
    filled = {own for own in found_by_topcom(points) if boundary(own) is not None}
    assert {without_boundary_tetrahedra(own) for own in filled} <= known.keys()


@pytest.mark.parametrize("points", ALL_POINTS)
def test_none_of_ours_that_fills_the_hull_is_missing(points: Points) -> None:
    whole = {own for own, diagonals in ours(points).items() if is_hull(points, diagonals)}
    assert whole <= found_by_topcom(points)


@pytest.mark.parametrize("points", ALL_POINTS)
def test_the_hull_can_be_filled_as_topcom_says(points: Points) -> None:
    """Be it with boundary tetrahedra, which are triangulations for TOPCOM."""
    filled = {boundary(own) for own in found_by_topcom(points)}
    found = signs([points])
    can = fillable_at_all(found)[0] | fillable_at_all(-found)[0]
    for diagonals in range(len(BOUNDARIES)):
        if is_hull(points, diagonals):
            assert (diagonals in filled) == can[diagonals]


def test_where_the_facets_bound_the_hull_all_are_the_same() -> None:
    """Then ours that do not fill the hull do so with boundary tetrahedra, in one way."""
    compared = 0
    for points in ALL_POINTS:
        found = found_by_topcom(points)
        if all(boundary(own) is not None for own in found):
            assert {without_boundary_tetrahedra(own) for own in found} == ours(points).keys()
            compared += 1
    assert compared > 80


def test_the_cube() -> None:
    assert found_by_topcom(CUBE) == ours(CUBE).keys()
    assert len(found_by_topcom(CUBE)) == 74


def test_there_are_all_kinds() -> None:
    """Sets of points with as many triangulations as the cube, with more, and with fewer."""
    numbers = {len(ours(points)) for points in ALL_POINTS}
    assert min(numbers) < 74 < max(numbers)
