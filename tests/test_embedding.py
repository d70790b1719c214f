"""Verdicts on placements against intersections and extreme points computed another way."""

from itertools import combinations

import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from certify.kernel.chirotope import chirotope
from certify.kernel.embedding import NotRealized, require_convex_position, require_realization
from certify.kernel.hexahedron import Simplex
from tests.geometry import (
    CROWDED,
    CUBE,
    CUBE_TRIANGULATIONS,
    ON_HULL,
    PLACEMENTS,
    QUADRUPLES,
    SCATTERED,
    SHUFFLED_CUBE,
    VERTICES,
    Placement,
    Tetrahedra,
    exact,
    examples,
    is_extreme,
    meet_in_common_face,
    near,
    realizes,
    signs_of,
    simplices,
    spans_space,
)

cube_triangulations = pytest.mark.parametrize(
    "tetrahedra", CUBE_TRIANGULATIONS.values(), ids=CUBE_TRIANGULATIONS
)


def is_realized(placement: Placement, orientation: dict[Simplex, int]) -> bool:
    try:
        require_realization(orientation, chirotope(exact(placement)))
    except NotRealized:
        return False
    return True


def is_convex(placement: Placement) -> bool:
    try:
        require_convex_position(chirotope(exact(placement)))
    except NotRealized:
        return False
    return True


def moved(placement: Placement, **places: tuple[int, int, int]) -> Placement:
    """Return the placement with vertices, named v1 to v8, put elsewhere."""
    return tuple(places.get(f"v{v}", p) for v, p in zip(VERTICES, placement, strict=True))


# Two tetrahedra.

BIG = ((0, 0, 0), (6, 0, 0), (0, 6, 0), (0, 0, 6))
"""The tetrahedron 1234 of the next test."""


@pytest.mark.parametrize(
    ("other", "points", "proper"),
    [
        pytest.param("5678", [(9, 9, 9), (9, 9, 8), (9, 8, 9), (8, 9, 9)], True, id="apart"),
        pytest.param("5678", [(1, 1, 1), (2, 1, 1), (1, 2, 1), (1, 1, 2)], False, id="nested"),
        pytest.param("5678", [(2, 2, 2), (9, 9, 9), (9, 9, 8), (9, 8, 9)], False, id="touch facet"),
        pytest.param(
            "5678", [(3, 0, 0), (3, -1, 0), (4, -1, 0), (3, -1, 1)], False, id="touch edge"
        ),
        pytest.param(
            "5678", [(0, 0, 6), (0, 0, 9), (0, 1, 9), (1, 0, 9)], False, id="touch vertex"
        ),
        pytest.param(
            "5678", [(3, 1, -1), (3, -1, 1), (3, -5, -5), (4, -5, -5)], False, id="edges cross"
        ),
        pytest.param(
            "5678", [(1, 1, 0), (2, 1, 0), (1, 2, 0), (1, 1, -3)], False, id="facets overlap"
        ),
        pytest.param("1567", [(-1, 0, 0), (0, -1, 0), (0, 0, -1)], True, id="common vertex"),
        pytest.param("1567", [(3, 0, 0), (0, -3, 0), (0, 0, -3)], False, id="edge in edge"),
        pytest.param("1567", [(2, 2, 0), (0, -3, 0), (0, 0, -3)], False, id="edge in facet"),
        pytest.param("1256", [(0, -6, 0), (0, 0, -6)], True, id="common edge"),
        pytest.param("1256", [(0, 3, 0), (0, 0, -6)], False, id="common edge, facets overlap"),
        pytest.param(
            "1256", [(0, 9, 3), (0, 3, 9)], False, id="common edge, one through the other"
        ),
        pytest.param("1235", [(1, 1, -6)], True, id="common triangle"),
        pytest.param("1235", [(1, 1, 6)], False, id="common triangle, same side"),
    ],
)
def test_two_tetrahedra_placed_by_hand(
    other: str, points: list[tuple[int, int, int]], proper: bool
) -> None:
    placement = (*BIG, *points, *[(0, 0, 0)] * (4 - len(points)))
    signs = signs_of(placement)
    pair = simplices(f"1234 {other}")
    assert meet_in_common_face(placement, *pair) is proper
    assert is_realized(placement, {t: signs[t] for t in pair}) is proper


@pytest.mark.parametrize("sign", [1, -1])
def test_a_single_tetrahedron_has_its_sign(sign: int) -> None:
    placement = (*BIG, *[(0, 0, 0)] * 4)
    turned = placement if sign == 1 else (*BIG[:2], BIG[3], BIG[2], *placement[4:])
    signs = chirotope(exact(turned))
    require_realization({(1, 2, 3, 4): sign}, signs)
    with pytest.raises(NotRealized, match="1234 is inverted"):
        require_realization({(1, 2, 3, 4): -sign}, signs)
    with pytest.raises(NotRealized, match="1235 is degenerate"):
        require_realization({(1, 2, 3, 5): sign}, signs)


PAIRS = {
    shared: [
        (s, t) for s, t in combinations(QUADRUPLES, 2) if len(set(s).intersection(t)) == shared
    ]
    for shared in range(4)
}


@pytest.mark.parametrize("shared", PAIRS)
@pytest.mark.parametrize(
    "placements",
    [SCATTERED, CROWDED, SHUFFLED_CUBE],
    ids=["any", "grid", "cube"],
)
def test_two_tetrahedra(shared: int, placements: st.SearchStrategy[Placement]) -> None:
    """Whichever tetrahedra the other points would make, only these two matter."""

    @examples(120)
    @given(placements, st.sampled_from(PAIRS[shared]))
    def run(placement: Placement, pair: Tetrahedra) -> None:
        signs = signs_of(placement)
        orientation = {t: signs[t] for t in pair}
        assume(all(orientation.values()))
        assert is_realized(placement, orientation) == meet_in_common_face(placement, *pair)

    run()


# Triangulations.


@cube_triangulations
def test_the_cube_carries_its_triangulations(tetrahedra: Tetrahedra) -> None:
    signs = chirotope(exact(CUBE))
    require_realization({t: signs[t] for t in tetrahedra}, signs)


@cube_triangulations
@pytest.mark.parametrize(
    ("placement", "reason"),
    [
        (tuple((-x, y, z) for x, y, z in CUBE), "inverted"),
        (tuple((x, y, 0) for x, y, _ in CUBE), "degenerate"),
        (moved(CUBE, v7=(0, 0, 0)), "degenerate|inverted"),
    ],
    ids=["mirrored", "flattened", "collapsed"],
)
def test_wrong_signs_are_named(tetrahedra: Tetrahedra, placement: Placement, reason: str) -> None:
    signs = signs_of(CUBE)
    with pytest.raises(NotRealized, match=f"tetrahedron [1-8]{{4}} is ({reason})"):
        require_realization({t: signs[t] for t in tetrahedra}, chirotope(exact(placement)))


def test_right_signs_are_not_enough() -> None:
    """Vertices 2 and 5, on the outer sides of 136 and 168, are so far out that they cross."""
    cube = signs_of(CUBE)
    placement = moved(CUBE, v2=(-1, -3, 0), v5=(1, -3, 0))
    orientation = {t: cube[t] for t in CUBE_TRIANGULATIONS["core"]}
    signs = chirotope(exact(placement))
    assert {t: signs[t] for t in orientation} == orientation
    with pytest.raises(NotRealized, match=r"faces [1-8]+ and [1-8]+ intersect"):
        require_realization(orientation, signs)


@examples(200)
@given(
    st.one_of(near(CUBE, 4, 1), near(CUBE, 4, 3), near(CUBE, 1, 1)),
    st.sampled_from(list(CUBE_TRIANGULATIONS.values())),
)
def test_triangulations_on_moved_cubes(placement: Placement, tetrahedra: Tetrahedra) -> None:
    cube = signs_of(CUBE)
    orientation = {t: cube[t] for t in tetrahedra}
    assert is_realized(placement, orientation) == realizes(placement, orientation)


# Convex position.


@examples(300)
@given(st.one_of(PLACEMENTS, ON_HULL, near(CUBE, 4, 1)).filter(spans_space))
def test_convex_position(placement: Placement) -> None:
    assert is_convex(placement) == all(is_extreme(placement, v) for v in VERTICES)


@pytest.mark.parametrize(
    ("place", "reason"),
    [
        ((2, 2, 2), None),
        ((3, 3, 3), None),
        ((1, 1, 1), "vertex 7"),
        ((2, 1, 0), "vertex 7"),
        ((1, 1, 0), "vertex 7"),
        ((2, 0, 2), "vertex [67]"),
        ((4, 0, 4), "vertex 6"),
    ],
    ids=["cube", "spike", "inside", "in an edge", "in a facet", "on vertex 6", "beyond vertex 6"],
)
def test_convex_position_with_vertex_7_at(place: tuple[int, int, int], reason: str | None) -> None:
    placement = moved(tuple(tuple(2 * x for x in p) for p in CUBE), v7=place)
    assert is_convex(placement) is (reason is None)
    if reason:
        with pytest.raises(NotRealized, match=f"{reason} is not an extreme point of the hull"):
            require_convex_position(chirotope(exact(placement)))
