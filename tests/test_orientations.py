"""The clauses against the signs of real points, and against placements that they must exclude."""

from collections import Counter
from collections.abc import Iterable
from functools import cache
from itertools import combinations, product

import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from certify.kernel.chirotope import chirotope
from certify.kernel.embedding import NotRealized, require_realization
from certify.kernel.hexahedron import Simplex
from certify.kernel.orientations import (
    Clause,
    bracket,
    convex_formula,
    exclusive,
    grassmann_pluecker,
    has_sign,
    no_overlap,
    on_hull,
    oriented,
    realization_formula,
)
from tests.geometry import (
    CROWDED,
    CUBE,
    CUBE_TRIANGULATIONS,
    FLAT,
    ON_HULL,
    PLACEMENTS,
    QUADRUPLES,
    SCATTERED,
    VERTICES,
    Placement,
    Tetrahedra,
    exact,
    examples,
    near,
    realizes,
    sign,
    signs_of,
    strictly_inside,
    true_literals,
    volume,
)

ANY = st.one_of(PLACEMENTS, FLAT)
TRIANGULATIONS = st.sampled_from(list(CUBE_TRIANGULATIONS.values()))
GRASSMANN_PLUECKER = tuple(grassmann_pluecker())
HULL = tuple(on_hull())


def satisfied(clauses: Iterable[Clause], literals: frozenset[int]) -> bool:
    return not any(literals.isdisjoint(clause) for clause in clauses)


def on_the_cube(tetrahedra: Tetrahedra) -> dict[Simplex, int]:
    """Return the signs that the tetrahedra have where the cube carries them."""
    signs = signs_of(CUBE)
    return {t: signs[t] for t in tetrahedra}


# Literals.


@examples(60)
@given(ANY, st.sampled_from(QUADRUPLES), st.sampled_from((1, -1)))
def test_literals_say_what_signs_are(placement: Placement, q: Simplex, wanted: int) -> None:
    literals = true_literals(signs_of(placement))
    value = sign(volume(*(placement[v - 1] for v in q)))
    assert (has_sign(q, wanted) in literals) == (value == wanted)
    assert (-has_sign(q, wanted) in literals) == (value != wanted)


@examples(60)
@given(ANY, st.permutations(VERTICES), st.sampled_from((1, -1)))
def test_brackets_alternate(placement: Placement, order: list[int], wanted: int) -> None:
    vertices = tuple(order[:4])
    value = sign(volume(*(placement[v - 1] for v in vertices)))
    literals = true_literals(signs_of(placement))
    assert (bracket(vertices, wanted) in literals) == (value == wanted)


def test_formulas_are_made_of_the_families_in_this_order() -> None:
    orientation = on_the_cube(CUBE_TRIANGULATIONS["stair"])
    realization = (
        *exclusive(), *GRASSMANN_PLUECKER, *oriented(orientation), *no_overlap(orientation)
    )  # fmt: skip
    assert realization_formula(orientation) == realization
    assert convex_formula(orientation) == realization + HULL
    assert {abs(literal) for clause in realization for literal in clause} == set(
        range(1, 2 * 70 + 1)
    )


# Whatever the position.


@examples(60)
@given(ANY)
def test_points_satisfy_exclusive_and_grassmann_pluecker(placement: Placement) -> None:
    literals = true_literals(signs_of(placement))
    assert satisfied(exclusive(), literals)
    assert satisfied(GRASSMANN_PLUECKER, literals)


def test_exclusive_is_one_clause_a_quadruple() -> None:
    for quadruple, clause in zip(QUADRUPLES, exclusive(), strict=True):
        assert set(clause) == {-has_sign(quadruple, 1), -has_sign(quadruple, -1)}


@cache
def relation_clauses(s: Simplex, others: Simplex) -> tuple[Clause, ...]:
    """Return the clauses on the six determinants of one relation."""
    six = {(*s, *pair) for pair in combinations(others, 2)}
    variables = {has_sign(tuple(sorted(q)), e) for q in six for e in (1, -1)}
    return tuple(c for c in GRASSMANN_PLUECKER if {abs(literal) for literal in c} <= variables)


@pytest.mark.parametrize(
    ("s", "others"),
    [
        ((1, 2), (3, 4, 5, 6)),
        ((7, 8), (1, 2, 3, 4)),
        ((2, 7), (1, 4, 6, 8)),
        ((3, 6), (1, 5, 7, 8)),
    ],
)
def test_grassmann_pluecker_excludes_exactly_what_no_numbers_satisfy(
    s: Simplex, others: Simplex
) -> None:
    """Three terms have sum zero for some numbers iff all are zero, or two have opposite signs."""
    a, b, c, d = others
    terms = [((a, b), (c, d), 1), ((a, c), (b, d), -1), ((a, d), (b, c), 1)]
    six = [pair for x, y, _ in terms for pair in (x, y)]
    for values in product((-1, 0, 1), repeat=6):
        value = dict(zip(six, values, strict=True))
        literals = {
            literal if v == e else -literal
            for pair, v in value.items()
            for e in (1, -1)
            for literal in [bracket((*s, *pair), e)]
        }
        signs = {e * value[x] * value[y] for x, y, e in terms}
        expected = signs == {0} or {1, -1} <= signs
        assert satisfied(relation_clauses(s, others), frozenset(literals)) == expected


def test_every_relation_has_its_clauses() -> None:
    relations = {
        frozenset(tuple(sorted((*s, *pair))) for pair in combinations(others, 2))
        for s in combinations(VERTICES, 2)
        for others in combinations([v for v in VERTICES if v not in s], 4)
    }
    found = Counter(
        frozenset(QUADRUPLES[(abs(literal) - 1) // 2] for literal in clause)
        for clause in set(GRASSMANN_PLUECKER)
    )
    assert len(relations) == 420
    assert found == dict.fromkeys(relations, 48)


# Tetrahedra.


@examples(60)
@given(near(CUBE, 4, 2), TRIANGULATIONS)
def test_oriented_holds_iff_all_tetrahedra_have_their_signs(
    placement: Placement, tetrahedra: Tetrahedra
) -> None:
    signs, orientation = signs_of(placement), on_the_cube(tetrahedra)
    holds = all(signs[t] == orientation[t] for t in tetrahedra)
    assert satisfied(oriented(orientation), true_literals(signs)) == holds


@pytest.mark.parametrize("name", CUBE_TRIANGULATIONS)
def test_the_cube_satisfies_the_convex_formula(name: str) -> None:
    formula = convex_formula(on_the_cube(CUBE_TRIANGULATIONS[name]))
    assert satisfied(formula, true_literals(signs_of(CUBE)))


@examples(100)
@given(near(CUBE, 4, 1), TRIANGULATIONS)
def test_realizations_satisfy_the_realization_formula(
    placement: Placement, tetrahedra: Tetrahedra
) -> None:
    orientation = on_the_cube(tetrahedra)
    assume(realizes(placement, orientation))
    assert satisfied(realization_formula(orientation), true_literals(signs_of(placement)))


def some(size: int) -> st.SearchStrategy[Tetrahedra]:
    return st.lists(st.sampled_from(QUADRUPLES), min_size=size, max_size=size, unique=True).map(
        tuple
    )


@pytest.mark.parametrize(
    ("placements", "complexes"),
    [
        pytest.param(SCATTERED, some(2), id="any two"),
        pytest.param(SCATTERED, some(3), id="any three"),
        pytest.param(CROWDED, some(2), id="two on a grid"),
        pytest.param(CROWDED, some(3), id="three on a grid"),
        pytest.param(near(CUBE, 4, 2), TRIANGULATIONS, id="near the cube"),
    ],
)
def test_no_overlap_holds_iff_the_points_realize_their_tetrahedra(
    placements: st.SearchStrategy[Placement], complexes: st.SearchStrategy[Tetrahedra]
) -> None:
    """The tetrahedra have the signs that they have in the placement."""

    @examples(200)
    @given(placements, complexes)
    def run(placement: Placement, tetrahedra: Tetrahedra) -> None:
        signs = signs_of(placement)
        orientation = {t: signs[t] for t in tetrahedra}
        assume(all(orientation.values()))
        proper = realizes(placement, orientation)
        assert satisfied(no_overlap(orientation), true_literals(signs)) == proper
        try:
            require_realization(orientation, chirotope(exact(placement)))
            assert proper
        except NotRealized:
            assert not proper

    run()


# The hull.


@examples(100)
@given(ON_HULL)
def test_points_on_the_boundary_of_their_hull_satisfy_on_hull(placement: Placement) -> None:
    assert satisfied(HULL, true_literals(signs_of(placement)))


@examples(150)
@given(ANY)
def test_on_hull_holds_iff_no_vertex_is_inside_four_others(placement: Placement) -> None:
    inside = any(
        strictly_inside(placement[v - 1], [placement[w - 1] for w in q])
        for v in VERTICES
        for q in QUADRUPLES
        if v not in q
    )
    assert satisfied(HULL, true_literals(signs_of(placement))) == (not inside)
