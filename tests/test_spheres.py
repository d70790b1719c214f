"""Spheres with few vertices against the counts of the literature, and the hexahedra in them."""

from collections import Counter
from itertools import combinations, permutations
from random import Random

import pytest

from certify.kernel.hexahedron import BOUNDARIES, BOUNDARY_TYPES, SYMMETRIES, boundary_triangles
from certify.kernel.triangulation import orbit
from certify.opinions.spheres import (
    Complex,
    bistellar_moves,
    canonical,
    hexahedra,
    is_orientable,
    manifolds,
    moved,
    relabelled,
    spheres,
    template_labels,
    vertices_of,
)

SIMPLEX: Complex = tuple(combinations(range(1, 6), 4))
TWISTED: Complex = tuple(
    sorted(
        tuple(sorted((i + step) % 9 + 1 for step in steps))
        for i in range(9)
        for steps in ((0, 1, 2, 4), (0, 1, 3, 4), (0, 2, 3, 4))
    )
)
"""Kuehnel's: the boundary of nine 4-simplices in a ring, with a twist."""

CUBE_IN_FIVE: Complex = ((1, 2, 3, 6), (1, 3, 4, 8), (1, 3, 6, 8), (1, 5, 6, 8), (3, 6, 7, 8))


def shuffled(facets: Complex, random: Random) -> Complex:
    vertices = list(vertices_of(facets))
    return relabelled(
        facets, dict(zip(vertices, random.sample(vertices, len(vertices)), strict=True))
    )


def numbers_of_edges(complexes: set[Complex]) -> Counter[int]:
    return Counter(
        len({edge for facet in facets for edge in combinations(facet, 2)}) for facets in complexes
    )


@pytest.mark.parametrize(("vertices", "count"), [(5, 1), (6, 2), (7, 5), (8, 39)])
def test_spheres_with_up_to_eight_vertices(vertices: int, count: int) -> None:
    found = spheres(vertices)
    assert len(found) == count
    assert all(vertices_of(sphere) == tuple(range(1, vertices + 1)) for sphere in found)


def test_spheres_and_manifolds_with_nine_vertices() -> None:
    found = {sphere for sphere in moved(3, 9) if len(vertices_of(sphere)) == 9}
    assert len(found) == 1296
    assert numbers_of_edges(found)[36] == 50  # neighborly: Altshuler and Steinberg 1974
    assert manifolds(9) == found | {canonical(TWISTED)}


@pytest.mark.parametrize("vertices", [4, 11])
def test_only_five_to_ten_vertices(vertices: int) -> None:
    with pytest.raises(ValueError, match="between five and ten"):
        manifolds(vertices)


def test_spheres_of_dimension_two() -> None:
    count = Counter(len(vertices_of(sphere)) for sphere in moved(2, 8))
    assert count == {4: 1, 5: 1, 6: 2, 7: 5, 8: 14}


def test_progress_is_reported() -> None:
    lines: list[str] = []
    spheres(6, lines.append)
    assert lines[0] == "2 spheres with 6 vertices reached by bistellar moves"
    assert lines[-1] == "2 manifolds, 0 of them not orientable"


def test_moves_have_inverses() -> None:
    assert not list(bistellar_moves(SIMPLEX, 5))
    assert len(list(bistellar_moves(SIMPLEX, 6))) == 5
    for sphere in moved(3, 7):
        for result in map(canonical, bistellar_moves(sphere, 7)):
            assert sphere in map(canonical, bistellar_moves(result, 7))


def test_canonical_labels_forget_the_labels() -> None:
    random = Random(1)
    for sphere in sorted(moved(3, 8)):
        assert canonical(shuffled(sphere, random)) == sphere


def test_orientability() -> None:
    assert not is_orientable(TWISTED)
    assert all(is_orientable(sphere) for sphere in moved(3, 7))


@pytest.mark.parametrize("letter", BOUNDARY_TYPES)
def test_template_labels_are_all_up_to_symmetry(letter: str) -> None:
    boundary = tuple(boundary_triangles(BOUNDARY_TYPES[letter]))
    wanted = {tuple(sorted(boundary_triangles(diagonals))) for diagonals in BOUNDARIES}
    by_force = {
        labels
        for labels in permutations(range(1, 9))
        if relabelled(boundary, dict(enumerate(labels, start=1))) in wanted
    }
    found = [
        tuple(symmetry[labels[v] - 1] for v in range(1, 9))
        for labels in template_labels(boundary)
        for symmetry in SYMMETRIES
    ]
    assert len(found) == len(by_force)
    assert set(found) == by_force


def test_six_spheres_bound_the_seven_types_of_hexahedra() -> None:
    types = {
        letter: canonical(boundary_triangles(diagonals))
        for letter, diagonals in BOUNDARY_TYPES.items()
    }
    assert types["f"] == types["g"]
    assert len(set(types.values())) == 6


def test_a_cube_is_found_in_its_sphere() -> None:
    triangles = Counter(face for t in CUBE_IN_FIVE for face in combinations(t, 3))
    cone = tuple((*face, 9) for face, times in triangles.items() if times == 1)
    sphere = shuffled(tuple(sorted(CUBE_IN_FIVE + cone)), Random(2))
    assert {orbit(found) for found in hexahedra([sphere])} == {orbit(CUBE_IN_FIVE)}
