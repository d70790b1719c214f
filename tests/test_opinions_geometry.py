"""Balls, realizations, convex position and Jacobians by other roads than the kernel's."""

import json
from collections import Counter
from collections.abc import Iterator
from fractions import Fraction
from itertools import combinations, product
from pathlib import Path
from random import Random
from typing import Any, TypeAlias

import pytest
from hypothesis import given
from hypothesis import strategies as st

from certify.kernel.chirotope import chirotope
from certify.kernel.embedding import NotRealized, require_convex_position, require_realization
from certify.kernel.jacobian import require_positive_jacobian
from certify.kernel.triangulation import (
    NotATriangulation,
    boundary_diagonals,
    label,
    orbit,
    orientation,
    shelling,
)
from certify.opinions import bounds
from certify.opinions.balls import (
    FACETS,
    ball_fault,
    coherent_orientation,
    collapses,
    instances,
    link_fault,
    symmetries,
)
from certify.opinions.bounds import jacobian, jacobian_fault
from certify.opinions.planes import convexity_fault, planes_of, realization_fault, separator
from tests.commands import CHECKOUT
from tests.geometry import (
    CUBE,
    CUBE_TRIANGULATIONS,
    PLACEMENTS,
    QUADRUPLES,
    Placement,
    Tetrahedra,
    exact,
    examples,
    near,
    simplices,
    spans_space,
)
from tests.test_jacobian import twisted
from tests.test_quality import jacobian_at

Points: TypeAlias = tuple[tuple[int | Fraction, ...], ...]

CORE = CUBE_TRIANGULATIONS["core"]


def read(path: Path) -> dict[str, Any]:
    """Return a certificate, its points as exact numbers."""
    pattern: dict[str, Any] = json.loads(path.read_text(encoding="utf-8"))
    pattern["tetrahedra"] = tuple(map(tuple, pattern["tetrahedra"]))
    for question in ("realizable", "convex", "valid"):
        answer = pattern[question]
        if answer["answer"] == "yes":
            answer["points"] = tuple(
                tuple(Fraction(x) if isinstance(x, str) else x for x in point)
                for point in answer["points"]
            )
    return pattern


PATTERNS = {path.stem: read(path) for path in sorted(CHECKOUT.glob("certificates/*.json"))}


def witnesses(question: str) -> dict[str, Points]:
    """Return the points of every yes to a question, by pattern."""
    return {
        name: pattern[question]["points"]
        for name, pattern in PATTERNS.items()
        if pattern[question]["answer"] == "yes"
    }


# Balls.


def kernel_ball(tetrahedra: Tetrahedra) -> bool:
    try:
        boundary_diagonals(tetrahedra)
        shelling(tetrahedra)
    except NotATriangulation:
        return False
    return True


def test_every_pattern_is_a_ball() -> None:
    assert {name: ball_fault(p["tetrahedra"]) for name, p in PATTERNS.items()} == dict.fromkeys(
        PATTERNS
    )
    assert len(PATTERNS) == 174


@pytest.mark.slow
def test_every_instance_is_a_ball() -> None:
    for pattern in PATTERNS.values():
        assert not any(map(ball_fault, instances(pattern["tetrahedra"])))


def test_every_pattern_is_oriented_in_the_same_way() -> None:
    for pattern in PATTERNS.values():
        assert coherent_orientation(pattern["tetrahedra"]) == orientation(pattern["tetrahedra"])


def test_every_pattern_has_the_same_instances() -> None:
    """Their numbers are the stated ones, and no two patterns have one in common."""
    seen = set()
    for pattern in PATTERNS.values():
        found = instances(pattern["tetrahedra"])
        assert found == orbit(pattern["tetrahedra"])
        assert len(found) == pattern["instances"]
        seen |= found
    assert len(seen) == sum(pattern["instances"] for pattern in PATTERNS.values())


def test_there_are_48_symmetries() -> None:
    """Each takes facets to facets."""
    facets = set(map(frozenset, FACETS))
    assert len({tuple(images.values()) for images in symmetries()}) == 48
    for images in symmetries():
        assert {frozenset(images[v] for v in facet) for facet in facets} == facets


@pytest.mark.parametrize(
    ("tetrahedra", "fault"),
    [
        ("1234 1236", "1234 is a boundary tetrahedron"),
        ("1236 1348 1368 1568 3678 2367", "2367 is a boundary tetrahedron"),
        ("1235 1236 1238", "triangle 123 lies in 3 tetrahedra"),
        ("1236 1236 1348 1568 3678", "a tetrahedron occurs twice"),
        ("1236 1348 1368 1568", "facet 2367 is not cut in two by a diagonal"),
        ("1236 1348 1568 3678", "16 triangles, not 12, lie in exactly one tetrahedron"),
        ("1245 1348", "facet 1458 is not cut in two by a diagonal"),
        ("1245 1247 1257 1457 2457", "facet 1458 is not cut in two by a diagonal"),
        ("", "facet 1458 is not cut in two by a diagonal"),
        ("1326", "(1, 3, 2, 6) is not an increasing list of four of the vertices 1 to 8"),
        ("1236 139", "(1, 3, 9) is not an increasing list of four of the vertices 1 to 8"),
        ("1239", "(1, 2, 3, 9) is not an increasing list of four of the vertices 1 to 8"),
        (
            "1235 1257 1267 1348 1357 1378 1568 1678 2357",
            "the link of vertex 1 is not a surface at vertex 5",
        ),
        (
            "1236 1348 1368 1568 3678 1245 1247 1257 1457 2457",
            "the link of vertex 1 is not a surface at vertex 2",
        ),
    ],
)
def test_no_ball(tetrahedra: str, fault: str) -> None:
    tops = simplices(tetrahedra)
    assert ball_fault(tops) == fault
    assert not kernel_ball(tops)


def test_boundary_tetrahedra_are_named() -> None:
    for facet in FACETS:
        assert ball_fault([*CORE, facet]) == f"{label(facet)} is a boundary tetrahedron"


@pytest.mark.parametrize(
    ("link", "fault"),
    [
        ("123 124", None),
        ("123 456", "is not connected"),
        ("", "is not connected"),
        ("123 145", "is not a surface at vertex 1"),
        ("123 124 134 234", "has no boundary"),
        ("124 126 135 136 145 234 235 256 346 456", "has no boundary"),
        ("124 245 235 356 136 146", "has Euler characteristic 0"),
        ("123 234 345 145 125", "has Euler characteristic 0"),
    ],
    ids=["disc", "two", "none", "bow", "sphere", "projective plane", "annulus", "Moebius band"],
)
def test_links(link: str, fault: str | None) -> None:
    found = link_fault([(*triangle, 8) for triangle in simplices(link)], 8)
    assert found == (fault and f"the link of vertex 8 {fault}")


def test_the_link_of_every_vertex_is_looked_at() -> None:
    """A tetrahedron gives way to the cone over its boundary from a vertex elsewhere."""
    impostors: list[Tetrahedra] = []
    for pattern in PATTERNS.values():
        tops = pattern["tetrahedra"]
        old = {triangle for top in tops for triangle in combinations(top, 3)}
        for base, apex in product(tops, range(1, 9)):
            cone = {tuple(sorted((*side, apex))) for side in combinations(base, 3)}
            new = {triangle for top in cone for triangle in combinations(top, 3)}
            if apex not in base and new & old == set(combinations(base, 3)) and len(cone) == 4:
                impostors.append((*(top for top in tops if top != base), *cone))
    faults = Counter((ball_fault(tops) or "none")[:18] for tops in impostors)
    assert faults["the link of vertex"] > 100
    assert "none" not in faults


def klein_bottle() -> Iterator[tuple[int, ...]]:
    """Yield the 27 tetrahedra of the 3-manifold with nine vertices that is no sphere.

    They bound the nine 4-simplices of five consecutive vertices of a cycle.
    """
    for start, gap in product(range(9), (1, 2, 3)):
        yield tuple(sorted((start + step) % 9 for step in range(5) if step != gap))


def test_a_manifold_that_is_no_ball_does_not_collapse() -> None:
    """All links are discs after a vertex's star is removed, and the boundary is a sphere."""
    tops = [top for top in klein_bottle() if 0 not in top]
    assert len(tops) == 15
    assert [link_fault(tops, v) for v in range(1, 9)] == [None] * 8
    assert not collapses(tops)
    sides = Counter(triangle for top in tops for triangle in combinations(top, 3))
    outer = [triangle for triangle, times in sides.items() if times == 1]
    assert len(outer) == 12
    assert collapses([(*triangle, 9) for triangle in outer])  # while the cone over it does


def test_a_ball_must_collapse(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("certify.opinions.balls.collapses", lambda tops: len(tops) > 5)
    assert ball_fault(CORE) == "no collapse to a point is found"
    assert ball_fault(CUBE_TRIANGULATIONS["corner"]) is None


def test_one_tetrahedron_changed_gets_the_same_verdict() -> None:
    random = Random(174)
    for pattern in PATTERNS.values():
        tops = list(pattern["tetrahedra"])
        tops[random.randrange(len(tops))] = random.choice(QUADRUPLES)
        assert (ball_fault(tops) is None) == kernel_ball(tuple(tops))


@pytest.mark.parametrize(
    ("tetrahedra", "fault"),
    [
        ("1236 1245 1247 1257 1457 2457", "two signs for tetrahedron 1236"),
        ("1245 1247 1257 1457 2457", "tetrahedron 1245 is not joined to the boundary"),
        ("1357", "a side of tetrahedron 1357 is in no facet"),
    ],
)
def test_no_orientation(tetrahedra: str, fault: str) -> None:
    with pytest.raises(ValueError, match=fault):
        coherent_orientation(simplices(tetrahedra))


# Realizations and convex position.


def test_every_realization_and_convex_position() -> None:
    counts = {}
    for question in ("realizable", "convex", "valid"):
        found = witnesses(question)
        counts[question] = len(found)
        for name, points in found.items():
            assert realization_fault(PATTERNS[name]["tetrahedra"], points) is None
            if question == "convex":
                assert convexity_fault(points) is None
    assert counts == {"realizable": 171, "convex": 158, "valid": 143}


def test_what_has_no_convex_realization_is_not_in_convex_position() -> None:
    names = set(witnesses("realizable")) - set(witnesses("convex"))
    faults = [convexity_fault(PATTERNS[name]["realizable"]["points"]) for name in names]
    assert len(faults) == 13
    assert all(fault and fault.endswith("not an extreme point of the hull") for fault in faults)


def moved(vertex: int, *point: int | Fraction) -> Points:
    """Return the unit cube with one vertex moved."""
    return (*CUBE[: vertex - 1], point, *CUBE[vertex:])


CROSSING: Points = (*CUBE[:1], (5, 1, 1), *CUBE[2:6], (9, 1, 1), *CUBE[7:])
"""All tetrahedra of the core are as they should be, but 1236 and 3678 overlap at the edge 36."""


@pytest.mark.parametrize(
    ("tetrahedra", "points", "fault"),
    [
        (CORE, CUBE, None),
        (CORE, tuple((-x, y, z) for x, y, z in CUBE), "tetrahedron 1236 is inverted"),
        (CORE, tuple((x, y, 0) for x, y, _ in CUBE), "tetrahedron 1236 is degenerate"),
        (CORE, (CUBE[0],) * 8, "tetrahedron 1236 is degenerate"),
        (CORE, moved(7, Fraction(2, 3), Fraction(2, 3), Fraction(2, 3)), "degenerate"),
        (CORE, moved(7, Fraction(1, 2), Fraction(1, 2), Fraction(1, 2)), "3678 is inverted"),
        (CORE, moved(7, 9, 9, 9), None),
        (CORE, CROSSING, "no plane separates 1236 and 3678"),
    ],
)
def test_realization(tetrahedra: Tetrahedra, points: Points, fault: str | None) -> None:
    found = realization_fault(tetrahedra, points)
    assert found is None if fault is None else fault in str(found)


@pytest.mark.parametrize(
    ("points", "fault"),
    [
        (CUBE, None),
        (moved(7, Fraction(2, 3), Fraction(2, 3), Fraction(2, 3)), "vertex 7 is not an extreme"),
        (moved(7, Fraction(3, 4), Fraction(3, 4), Fraction(3, 4)), None),
        (moved(3, Fraction(1, 2), Fraction(1, 2), 0), "vertex 3 is not an extreme"),
        (moved(2, 0, 0, 0), "vertex 1 is not an extreme"),
        (tuple((x, y, x + y) for x, y, _ in CUBE), "the points lie in one plane"),
        (((1, 2, 3),) * 8, "the points lie in one plane"),
    ],
)
def test_convex_position(points: Points, fault: str | None) -> None:
    found = convexity_fault(points)
    assert found is None if fault is None else fault in str(found)


def test_a_separator_is_an_affine_function() -> None:
    """On the cube its values have the same sum at the ends of all four long diagonals."""
    planes = planes_of(CUBE)
    for first, second in combinations(CORE, 2):
        values = separator(planes, first, second)
        assert values is not None
        assert (
            len({values[v - 1] + values[w - 1] for v, w in ((1, 7), (2, 8), (3, 5), (4, 6))}) == 1
        )
    assert separator(planes, (1, 7), (2, 8, 3, 5)) is None


def kernel_realizes(tetrahedra: Tetrahedra, points: Points) -> bool:
    try:
        require_realization(orientation(tetrahedra), chirotope(exact(points)))
    except NotRealized:
        return False
    return True


def kernel_convex(points: Points) -> bool:
    try:
        require_convex_position(chirotope(exact(points)))
    except NotRealized:
        return False
    return True


@st.composite
def disturbed(draw: st.DrawFn) -> tuple[str, Points]:
    """Return a pattern, with its points moved a little, often onto a common plane or inside."""
    name = draw(st.sampled_from(sorted(witnesses("realizable"))))
    random = Random(draw(st.integers(0, 2**32)))
    scale = random.choice((1, 1, 2, 4))
    moves = [random.choice((0, 0, 0, 1)) for _ in range(8)]
    return name, tuple(
        tuple(scale * x + move * random.randint(-2, 2) for x in point)
        for move, point in zip(moves, PATTERNS[name]["realizable"]["points"], strict=True)
    )


def test_disturbed_points_get_the_same_verdicts() -> None:
    counts: Counter[tuple[str, bool]] = Counter()

    @examples(300)
    @given(disturbed())
    def run(case: tuple[str, Points]) -> None:
        name, points = case
        tetrahedra = PATTERNS[name]["tetrahedra"]
        realizes, convex = kernel_realizes(tetrahedra, points), kernel_convex(points)
        assert (realization_fault(tetrahedra, points) is None) == realizes
        if spans_space(points):  # type: ignore[arg-type]
            assert (convexity_fault(points) is None) == convex
        counts["realizes", realizes] += 1
        counts["convex", convex] += 1

    run()
    assert (
        min(counts[key, verdict] for key in ("realizes", "convex") for verdict in (False, True))
        > 20
    )


@examples(100)
@given(st.one_of(PLACEMENTS, near(CUBE, 2, 1)))
def test_any_points_get_the_same_verdicts(placement: Placement) -> None:
    for tetrahedra in CUBE_TRIANGULATIONS.values():
        realizes = kernel_realizes(tetrahedra, placement)
        assert (realization_fault(tetrahedra, placement) is None) == realizes
    expected = spans_space(placement) and kernel_convex(placement)
    assert (convexity_fault(placement) is None) == expected


# Jacobians.


def kernel_positive(points: Points) -> bool:
    try:
        require_positive_jacobian(exact(points))
    except NotRealized:
        return False
    return True


def test_every_valid_hexahedron_has_a_positive_jacobian() -> None:
    found = witnesses("valid")
    assert {name: jacobian_fault(points) for name, points in found.items()} == dict.fromkeys(found)


def place_of(fault: str | None) -> tuple[Fraction, ...]:
    """Return the point at which a fault says that the Jacobian is not positive."""
    head, _, place = str(fault).partition("at (")
    assert head == "the Jacobian is not positive "
    return tuple(map(Fraction, place.rstrip(")").split(", ")))


def test_what_has_no_valid_realization_has_a_bad_point() -> None:
    names = set(witnesses("realizable")) - set(witnesses("valid"))
    assert len(names) == 28
    for name in names:
        points = PATTERNS[name]["realizable"]["points"]
        place = place_of(jacobian_fault(points))
        assert all(0 <= x <= 1 for x in place)
        assert jacobian_at(exact(points), place) <= 0


UNDECIDED = "undecided: the Jacobian is not shown to be positive with 2000 boxes"


@pytest.mark.parametrize(
    ("points", "fault"),
    [
        pytest.param(CUBE, None, id="cube"),
        pytest.param(twisted(0, -1, 1, -1), None, id="third of a turn"),
        pytest.param(twisted(-2, -1, 1, -2), None, id="sharper turn"),
        pytest.param(
            twisted(-2, -Fraction(1, 16), Fraction(1, 16), -2), None, id="nearly a half turn"
        ),
        pytest.param(twisted(-2, 0, 0, -2), UNDECIDED, id="zero at w = 1/3"),
        pytest.param(twisted(-3, 0, 0, -3), "at (1/2, 1/2, 1/4)", id="zero at w = 1/4"),
        pytest.param(twisted(-1, 0, 0, -1), "at (1/2, 1/2, 1/2)", id="zero at w = 1/2"),
        pytest.param(twisted(1, 0, 0, -1), "not positive at", id="inverted at the top"),
        pytest.param(twisted(1, 0, 0, 0), "not positive at", id="top collapsed to an edge"),
        pytest.param([(-x, y, z) for x, y, z in CUBE], "not positive at", id="mirrored"),
        pytest.param([(x, y, 0) for x, y, _ in CUBE], "not positive at", id="flat"),
        pytest.param([(0, 0, 0)] * 8, "not positive at", id="one point"),
        pytest.param([CUBE[1], *CUBE[1:]], "at (0, 0, 0)", id="edge of length zero"),
    ],
)
def test_jacobian(points: Points, fault: str | None) -> None:
    found = jacobian_fault(points)
    assert found is None if fault is None else fault in str(found)


def test_boxes_are_limited(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(bounds, "MAX_BOXES", 0)
    assert jacobian_fault(CUBE) is None
    fault = jacobian_fault(twisted(-2, -1, 1, -2))
    assert fault == "undecided: the Jacobian is not shown to be positive with 0 boxes"


@examples(50)
@given(st.one_of(PLACEMENTS, near(CUBE, 8, 3)))
def test_polynomial_is_the_jacobian(placement: Placement) -> None:
    polynomial = jacobian(placement)
    for u, v, w in product((Fraction(0), Fraction(1, 3), Fraction(4, 5)), repeat=3):
        value = sum(x * u**i * v**j * w**k for (i, j, k), x in polynomial.items())
        assert value == jacobian_at(exact(placement), (u, v, w))


TURNED: Placement = tuple((-y, x - y, z) if z else (x, y, z) for x, y, z in CUBE)
"""The top turned by a third, where the Jacobian falls to 1/4."""


@pytest.mark.parametrize(
    ("base", "size", "shift"),
    [(CUBE, 4, 1), (CUBE, 8, 3), (CUBE, 4, 2), (CUBE, 1, 1), (TURNED, 6, 1)],
)
def test_disturbed_jacobians_get_the_same_verdict(base: Placement, size: int, shift: int) -> None:
    @examples(60)
    @given(near(base, size, shift))
    def run(placement: Placement) -> None:
        fault = jacobian_fault(placement)
        assert (fault is None) == kernel_positive(placement)
        if fault:
            assert jacobian_at(exact(placement), place_of(fault)) <= 0

    run()
