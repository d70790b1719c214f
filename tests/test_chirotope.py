"""Determinants, signs and circuits against schoolbook linear algebra over the rationals."""

from collections import Counter
from fractions import Fraction
from itertools import combinations

from hypothesis import given
from hypothesis import strategies as st

from certify.kernel.chirotope import (
    QUINTUPLES,
    chirotope,
    circuits,
    dependence,
    determinant,
    integral,
)
from tests.geometry import (
    CUBE,
    FLAT,
    PLACEMENTS,
    QUADRUPLES,
    VERTICES,
    Placement,
    exact,
    examples,
    leibniz,
    null_space,
    sign,
    signs_of,
    spans_space,
    volume,
)

RATIONALS = st.one_of(
    st.integers(-2, 2).map(Fraction),
    st.fractions(-9, 9, max_denominator=12),
    st.builds(Fraction, st.integers(-(10**20), 10**20), st.integers(1, 10**20)),
)
RATIONAL_POINTS = st.lists(st.tuples(RATIONALS, RATIONALS, RATIONALS), min_size=8, max_size=8)


@st.composite
def square_matrices(draw: st.DrawFn) -> list[list[int]]:
    """Draw square matrices; small entries make singular ones frequent."""
    size = draw(st.integers(1, 5))
    entries = draw(st.sampled_from([st.integers(-1, 1), st.integers(-(10**30), 10**30)]))
    row = st.lists(entries, min_size=size, max_size=size)
    return draw(st.lists(row, min_size=size, max_size=size))


@examples(200)
@given(square_matrices())
def test_determinant_is_the_leibniz_sum(rows: list[list[int]]) -> None:
    assert determinant(rows) == leibniz([list(map(Fraction, row)) for row in rows])


@examples(100)
@given(RATIONAL_POINTS)
def test_an_axis_of_integral_points_is_a_positive_multiple(
    points: list[tuple[Fraction, ...]],
) -> None:
    for given_axis, axis in zip(
        zip(*points, strict=True), zip(*integral(points), strict=True), strict=True
    ):
        pairs = list(zip(given_axis, axis, strict=True))
        scale = next((y / x for x, y in pairs if x), Fraction(1))
        assert scale > 0
        assert all(type(y) is int and y == scale * x for x, y in pairs)


@examples(40)
@given(RATIONAL_POINTS)
def test_chirotope_of_rational_points(points: list[tuple[Fraction, ...]]) -> None:
    rows = [[Fraction(1), *point] for point in points]
    assert chirotope(points) == {q: sign(leibniz([rows[v - 1] for v in q])) for q in QUADRUPLES}


@examples(60)
@given(PLACEMENTS)
def test_chirotope_of_integer_points(placement: Placement) -> None:
    assert chirotope(exact(placement)) == signs_of(placement)


def test_chirotope_of_the_cube_and_of_its_mirror_image() -> None:
    signs = chirotope(exact(CUBE))
    assert sum(value == 0 for value in signs.values()) == 12
    assert signs[1, 2, 4, 5] == 1
    mirrored = chirotope(exact((-x, y, z) for x, y, z in CUBE))
    assert mirrored == {q: -value for q, value in signs.items()}


@examples(60)
@given(PLACEMENTS, st.sampled_from(QUINTUPLES))
def test_dependence_has_sum_zero_and_moment_zero(
    placement: Placement, quintuple: tuple[int, ...]
) -> None:
    terms = dependence(quintuple)
    assert [vertex for vertex, _, _ in terms] == list(quintuple)
    assert all({vertex, *quadruple} == set(quintuple) for vertex, quadruple, _ in terms)
    coefficients = [s * volume(*(placement[w - 1] for w in q)) for _, q, s in terms]
    for row in zip(*((1, *placement[v - 1]) for v in quintuple), strict=True):
        assert sum(x * y for x, y in zip(coefficients, row, strict=True)) == 0


def minimal_dependences(placement: Placement) -> set[frozenset[frozenset[int]]]:
    """Return {X+, X-} for every set of at most five points with one dependence, full on it.

    One with support S is minimal iff all dependences on S are its multiples: among two others,
    some combination would vanish somewhere on S, but not everywhere.
    """
    found = set()
    for size in (2, 3, 4, 5):
        for support in combinations(VERTICES, size):
            basis = null_space([(1, *placement[v - 1]) for v in support])
            if len(basis) == 1 and all(basis[0]):
                positive = frozenset(v for v, x in zip(support, basis[0], strict=True) if x > 0)
                found.add(frozenset((positive, frozenset(support) - positive)))
    return found


@examples(60)
@given(PLACEMENTS.filter(spans_space))
def test_circuits_are_the_minimal_dependences(placement: Placement) -> None:
    found = {frozenset(circuit) for circuit in circuits(chirotope(exact(placement)))}
    assert found == minimal_dependences(placement)


def test_circuits_of_the_cube() -> None:
    """Of each of twelve rectangles the diagonals; and each space diagonal pierces two triangles."""
    found = {frozenset(circuit) for circuit in circuits(chirotope(exact(CUBE)))}
    sizes = Counter(tuple(sorted(map(len, circuit))) for circuit in found)
    assert sizes == {(2, 2): 12, (2, 3): 8}


@examples(20)
@given(FLAT)
def test_coplanar_points_are_outside_the_lemma(placement: Placement) -> None:
    assert minimal_dependences(placement)
    assert not list(circuits(chirotope(exact(placement))))
