"""Triangulated balls, got by brute force and by flips, and complexes that only look like one."""

from collections import Counter
from collections.abc import Callable, Iterator
from functools import cache
from itertools import combinations

import pytest

from certify.kernel.hexahedron import Simplex, boundary_triangles
from certify.kernel.triangulation import (
    NotATriangulation,
    boundary_diagonals,
    label,
    orbit,
    orientation,
    shelling,
    triangles,
)
from tests.geometry import (
    CUBE,
    CUBE_TRIANGULATIONS,
    QUADRUPLES,
    VERTICES,
    Tetrahedra,
    cube_symmetries,
    meet_in_common_face,
    relabel,
    signs_of,
    simplices,
    volume,
)

Complex = frozenset[Simplex]

FLAT = {q for q, sign in signs_of(CUBE).items() if sign == 0}
FACETS = {q for q in FLAT if any(len({CUBE[v - 1][axis] for v in q}) == 1 for axis in range(3))}
TABLE = {5: 1, 6: 5, 7: 5, 8: 7, 9: 13, 10: 20, 11: 35, 12: 30, 13: 28, 14: 19, 15: 11}
"""Number of tetrahedra -> number of classes: the paper's Table 1."""

cube_triangulations = pytest.mark.parametrize(
    "tetrahedra", CUBE_TRIANGULATIONS.values(), ids=CUBE_TRIANGULATIONS
)


def faces(tetrahedra: Complex, size: int) -> set[Simplex]:
    return {face for tetrahedron in tetrahedra for face in combinations(tetrahedron, size)}


def star(tetrahedra: Complex, face: Simplex) -> set[Simplex]:
    return {t for t in tetrahedra if set(face) <= set(t)}


def instances(tetrahedra: Tetrahedra) -> set[Complex]:
    return {relabel(symmetry, tetrahedra) for symmetry in cube_symmetries()}


# The unit cube.


def triangulations_of_the_cube() -> Iterator[Complex]:
    """Choose compatible solid tetrahedra, in increasing order, until they fill the cube."""
    size = {q: abs(volume(*(CUBE[v - 1] for v in q))) for q in QUADRUPLES if q not in FLAT}
    compatible = {pair for pair in combinations(size, 2) if meet_in_common_face(CUBE, *pair)}

    def extend(chosen: Tetrahedra, candidates: Tetrahedra, room: int) -> Iterator[Complex]:
        if room == 0:
            yield frozenset(chosen)
        for i, new in enumerate(candidates):
            if size[new] <= room:
                fitting = tuple(t for t in candidates[i + 1 :] if (new, t) in compatible)
                yield from extend((*chosen, new), fitting, room - size[new])

    return extend((), tuple(size), room=6)


def test_the_cube_has_74_triangulations_in_six_classes() -> None:
    """As is well known (De Loera, Rambau and Santos, Triangulations, 2010)."""
    found = list(triangulations_of_the_cube())
    assert len(found) == 74
    assert set(found) == set().union(*map(instances, CUBE_TRIANGULATIONS.values()))


@pytest.mark.parametrize(
    ("name", "size"),
    [("core", 2), ("corner", 8), ("slab", 12), ("ring", 4), ("twist", 24), ("stair", 24)],
)
def test_orbit_of_a_triangulation_of_the_cube(name: str, size: int) -> None:
    instances_found = orbit(CUBE_TRIANGULATIONS[name])
    assert len(instances_found) == size
    assert set(map(frozenset, instances_found)) == instances(CUBE_TRIANGULATIONS[name])
    assert all(list(instance) == sorted(instance) for instance in instances_found)


@cube_triangulations
def test_orientation_is_that_of_the_cube(tetrahedra: Tetrahedra) -> None:
    signs = signs_of(CUBE)
    assert orientation(tetrahedra) == {t: signs[t] for t in tetrahedra}


# All patterns: flips lead from balls to balls.


def moves() -> Iterator[tuple[Simplex, Simplex, Complex, Complex]]:
    """Yield all (edge, triangle, two, three): five vertices carry two tetrahedra, with a common
    triangle, or three around an edge.
    """
    for five in combinations(VERTICES, 5):
        for edge in combinations(five, 2):
            triangle = tuple(v for v in five if v not in edge)
            two = frozenset(tuple(sorted((*triangle, v))) for v in edge)
            three = frozenset(tuple(v for v in five if v != w) for w in triangle)
            yield edge, triangle, two, three


MOVES = tuple(moves())


def flips(tetrahedra: Complex) -> Iterator[Complex]:
    """Yield what one flip makes of a ball; boundary tetrahedra are allowed on the way.

    Two tetrahedra on five vertices become three around a new edge, or the reverse. A boundary
    tetrahedron is laid on a facet, where it changes the diagonal to one that is new, or taken off.
    """
    edges, inner = faces(tetrahedra, 2), faces(tetrahedra, 3)
    for edge, triangle, two, three in MOVES:
        if two <= tetrahedra and edge not in edges:
            yield tetrahedra - two | three
        if three <= tetrahedra and triangle not in inner and star(tetrahedra, edge) == three:
            yield tetrahedra - three | two
    for facet in FACETS:
        if facet in tetrahedra:
            yield tetrahedra - {facet}
        elif sum(pair in edges for pair in combinations(facet, 2)) == 5:
            yield tetrahedra | {facet}


@cache
def patterns() -> tuple[Tetrahedra, ...]:
    """Return one triangulation of the hexahedron from every class that flips lead to."""
    maps = [
        {q: tuple(sorted(symmetry[v - 1] for v in q)) for q in QUADRUPLES}
        for symmetry in cube_symmetries()
    ]

    def least(tetrahedra: Complex) -> Tetrahedra:
        return min(tuple(sorted(map(image.__getitem__, tetrahedra))) for image in maps)

    seen = {CUBE_TRIANGULATIONS["core"]}
    pending = list(seen)
    while pending:
        new = set(map(least, flips(frozenset(pending.pop())))) - seen
        seen |= new
        pending += new
    return tuple(sorted(t for t in seen if not FACETS & set(t)))


def test_flips_lead_to_174_classes() -> None:
    assert Counter(map(len, patterns())) == TABLE
    assert len({min(orbit(tetrahedra)) for tetrahedra in patterns()}) == 174


def test_every_pattern_has_a_shelling_by_the_definition() -> None:
    """Each tetrahedron meets the earlier ones in the union of one, two or three triangles."""

    def closure(tetrahedron: Simplex) -> set[Simplex]:
        return {face for size in (1, 2, 3, 4) for face in combinations(tetrahedron, size)}

    for tetrahedra in patterns():
        order = shelling(tetrahedra)
        assert sorted(order) == list(tetrahedra)
        earlier = closure(order[0])
        for tetrahedron in order[1:]:
            met = closure(tetrahedron) & earlier
            shared = [face for face in met if len(face) == 3]
            assert 1 <= len(shared) <= 3
            assert met == set().union(*map(closure, shared))
            earlier |= closure(tetrahedron)


def test_oriented_tetrahedra_have_the_oriented_hexahedron_as_boundary() -> None:
    """As chains: the signed sum of all triangles is that of the triangles seen from inside."""
    for tetrahedra in patterns():
        chain: Counter[Simplex] = Counter()
        for (a, b, c, d), sign in orientation(tetrahedra).items():
            chain.update({(a, b, c): sign, (a, b, d): -sign, (a, c, d): sign, (b, c, d): -sign})
        seen = boundary_triangles(boundary_diagonals(tetrahedra))
        assert {triangle: n for triangle, n in chain.items() if n} == {
            (a, b, c): 1 if (a, b, c) in {(x, y, z), (y, z, x), (z, x, y)} else -1
            for (a, b, c), (x, y, z) in seen.items()
        }


# What is no triangulation.


@pytest.mark.parametrize(
    ("tetrahedra", "reason"),
    [
        ("1234 1236", "1234 is a boundary tetrahedron"),
        ("1236 1348 1368 1568 3678 2367", "2367 is a boundary tetrahedron"),
        ("1235 1236 1238", "triangle 123 lies in 3 tetrahedra"),
        ("1236 1236 1348 1368 1568 3678", "triangle 136 lies in 3 tetrahedra"),
        ("1236 1236 1348 1568 3678", "do not form one of the 64"),
        ("1236 1348 1368 1568", "do not form one of the 64"),
        ("1236 1348 1568 3678", "do not form one of the 64"),
        ("1245 1247 1257 1457 2457", "do not form one of the 64"),
        ("", "do not form one of the 64"),
    ],
)
def test_boundary_is_refused(tetrahedra: str, reason: str) -> None:
    with pytest.raises(NotATriangulation, match=reason):
        boundary_diagonals(simplices(tetrahedra))


def link_is_disc(tetrahedra: Tetrahedra, vertex: int) -> bool:
    """Is the link connected, with Euler characteristic 1? (It has edges in <= 2 triangles.)"""
    link = {tuple(v for v in t if v != vertex) for t in tetrahedra if vertex in t}
    edges = {edge for triangle in link for edge in combinations(triangle, 2)}
    reached = set(min(link))
    while new := {v for edge in edges if reached & set(edge) for v in edge} - reached:
        reached |= new
    points = {v for triangle in link for v in triangle}
    return reached == points and len(points) - len(edges) + len(link) == 1


def test_the_links_of_all_patterns_are_discs() -> None:
    assert all(link_is_disc(tetrahedra, v) for tetrahedra in patterns() for v in VERTICES)


def beside_a_sphere() -> Iterator[Tetrahedra]:
    """Add to five tetrahedra the boundary of a 4-simplex, which shares only edges with them."""
    yield CUBE_TRIANGULATIONS["core"] + simplices("1245 1247 1257 1457 2457")


def pinched() -> Iterator[Tetrahedra]:
    """Replace a tetrahedron of a ball by the four that cone its triangles to a vertex elsewhere."""
    for tetrahedra in patterns():
        old = faces(frozenset(tetrahedra), 3)
        for base in tetrahedra:
            for apex in set(VERTICES) - set(base):
                cone = frozenset(tuple(sorted((*face, apex))) for face in triangles(base))
                if not cone & FACETS and faces(cone, 3) & old == set(triangles(base)):
                    yield (*(t for t in tetrahedra if t != base), *cone)


@pytest.mark.parametrize("family", [beside_a_sphere, pinched])
def test_what_has_the_boundary_but_is_no_ball_has_no_shelling(
    family: Callable[[], Iterator[Tetrahedra]],
) -> None:
    impostors = list(family())
    assert impostors
    for tetrahedra in impostors:
        assert boundary_diagonals(tetrahedra)
        assert not all(link_is_disc(tetrahedra, v) for v in VERTICES)
        with pytest.raises(NotATriangulation, match="no shelling goes beyond"):
            shelling(tetrahedra)


def test_shelling_says_how_far_it_came() -> None:
    disjoint = simplices("1236 1348 1368 4578")
    with pytest.raises(NotATriangulation, match="no shelling goes beyond 3 of 4 tetrahedra"):
        shelling(disjoint)


def test_nothing_has_no_shelling() -> None:
    with pytest.raises(NotATriangulation, match="no shelling goes beyond 0 of 0 tetrahedra"):
        shelling(())


def test_a_tetrahedron_may_meet_others_in_three_triangles_but_not_in_four() -> None:
    """Four of the five tetrahedra on five vertices are a ball; all five are a sphere."""
    five = tuple(combinations(range(1, 6), 4))
    for four in combinations(five, 4):
        assert shelling(four) == four
    with pytest.raises(NotATriangulation, match="no shelling goes beyond 4 of 5 tetrahedra"):
        shelling(five)


def test_label_is_the_vertices_in_a_row() -> None:
    assert label((1, 3, 8)) == "138"
