"""The template against the coordinates of the cube."""

from itertools import combinations, pairwise, product

import pytest
from hypothesis import given
from hypothesis import strategies as st

from certify.kernel.hexahedron import (
    BOUNDARIES,
    BOUNDARY_TYPES,
    CORNERS,
    FACETS,
    SYMMETRIES,
    VERTICES,
    Simplex,
    boundary_letter,
    boundary_triangles,
    image,
    simplex,
    sorted_with_sign,
)
from tests.geometry import CUBE, cube_symmetries, examples, minus, relabel, simplices, volume

EDGES = {
    (v, w)
    for v, w in combinations(VERTICES, 2)
    if sum(map(abs, minus(CUBE[v - 1], CUBE[w - 1]))) == 1
}
FACET_SETS = {
    tuple(v for v in VERTICES if CUBE[v - 1][axis] == side)
    for axis, side in product(range(3), (0, 1))
}


def sees_counterclockwise_from_inside(a: int, b: int, c: int) -> bool:
    """Is the centre of the cube (scaled by two) on the positive side of abc?"""
    p, q, r = (tuple(2 * x for x in CUBE[v - 1]) for v in (a, b, c))
    return volume(p, q, r, (1, 1, 1)) > 0


def test_corners_are_those_of_the_unit_cube() -> None:
    assert tuple(CORNERS) == VERTICES
    assert tuple(CORNERS.values()) == CUBE


def test_facets_are_cyclic_and_counterclockwise_seen_from_inside() -> None:
    assert {simplex(facet) for facet in FACETS} == FACET_SETS
    assert len(FACETS) == 6
    for a, b, c, d in FACETS:
        assert {simplex(edge) for edge in pairwise((a, b, c, d, a))} <= EDGES
        for triangle in ((a, b, c), (b, c, d), (c, d, a), (d, a, b)):
            assert sees_counterclockwise_from_inside(*triangle)


def test_symmetries_are_the_permutations_that_preserve_distances() -> None:
    assert len(SYMMETRIES) == 48
    assert set(SYMMETRIES) == set(cube_symmetries())


def test_symmetries_form_a_group() -> None:
    assert VERTICES in SYMMETRIES
    composed = {tuple(g[v - 1] for v in h) for g in SYMMETRIES for h in SYMMETRIES}
    assert composed == set(SYMMETRIES)


@pytest.mark.parametrize("faces", [EDGES, FACET_SETS], ids=["edges", "facets"])
def test_symmetries_preserve(faces: set[Simplex]) -> None:
    for symmetry in SYMMETRIES:
        assert {image(symmetry, face) for face in faces} == faces


@examples(100)
@given(st.permutations(range(1, 7)))
def test_sign_is_that_of_the_number_of_swaps_that_sort(order: list[int]) -> None:
    vertices, swaps = tuple(order), 0
    for i in range(6):
        j = order.index(i + 1)
        if i != j:
            order[i], order[j] = order[j], order[i]
            swaps += 1
    assert sorted_with_sign(vertices) == (tuple(order), (-1) ** swaps)
    assert simplex(vertices) == tuple(order)


def test_there_are_64_boundaries_of_one_diagonal_a_facet() -> None:
    diagonals = [
        [pair for pair in combinations(facet, 2) if pair not in EDGES] for facet in FACET_SETS
    ]
    assert set(BOUNDARIES) == {frozenset(choice) for choice in product(*diagonals)}
    assert len(BOUNDARIES) == 64


def test_boundary_triangles_form_a_coherently_oriented_sphere() -> None:
    for diagonals in BOUNDARIES:
        triangles = boundary_triangles(diagonals)
        assert len(triangles) == 12
        assert all(simplex(triangle) == key for key, triangle in triangles.items())
        assert all(sees_counterclockwise_from_inside(*triangle) for triangle in triangles.values())
        directed = [e for a, b, c in triangles.values() for e in ((a, b), (b, c), (c, a))]
        assert len(set(directed)) == len(directed) == 36
        assert {simplex(edge) for edge in directed} == EDGES | diagonals
        assert {(w, v) for v, w in directed} == set(directed)


def orbit(diagonals: frozenset[Simplex]) -> set[frozenset[Simplex]]:
    return {relabel(symmetry, diagonals) for symmetry in cube_symmetries()}


@pytest.mark.parametrize(
    ("letter", "size"),
    [("a", 2), ("b", 12), ("c", 4), ("d", 24), ("e", 4), ("f", 6), ("g", 12)],
)
def test_boundary_type_has_its_orbit_and_letter(letter: str, size: int) -> None:
    instances = orbit(BOUNDARY_TYPES[letter])
    assert len(instances) == size
    assert all(boundary_letter(diagonals) == letter for diagonals in instances)


def test_boundary_types_cover_all_boundaries() -> None:
    assert list(BOUNDARY_TYPES) == list("abcdefg")
    assert set().union(*map(orbit, BOUNDARY_TYPES.values())) == set(BOUNDARIES)


@pytest.mark.parametrize(
    "nonsense",
    [
        "",
        "13 16 18 36 38",
        "13 16 18 36 38 68 57",
        "13 24 18 36 38 68",
        "12 16 18 36 38 68",
        "17 28 35 46 13 16",
    ],
    ids=["none", "five", "seven", "both of one facet", "an edge", "space diagonals"],
)
def test_boundary_letter_refuses_nonsense(nonsense: str) -> None:
    with pytest.raises(KeyError):
        boundary_letter(frozenset(simplices(nonsense)))
