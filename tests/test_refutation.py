"""Replay against truth tables, and final polynomials against real points."""

from collections.abc import Iterator, Sequence
from itertools import combinations, permutations, product

import pytest
from hypothesis import given
from hypothesis import strategies as st

from certify.kernel.hexahedron import Simplex
from certify.kernel.orientations import Clause, grassmann_pluecker
from certify.kernel.refutation import FinalPolynomial, NotRefuted, excluded_signs, replay
from tests.geometry import PLACEMENTS, QUADRUPLES, Placement, examples, signs_of, true_literals

Formula = list[Clause]

LAST = 4
"""The variables of the random formulas are 1..4."""

LITERALS = st.sampled_from([x for v in range(1, LAST + 1) for x in (v, -v)])
CLAUSES = st.lists(LITERALS, min_size=1, max_size=3, unique_by=abs).map(tuple)
FORMULAS: st.SearchStrategy[Formula] = st.lists(CLAUSES, min_size=1, max_size=24)


def models(formula: Formula) -> Iterator[set[int]]:
    """Yield all assignments that satisfy the formula, as sets of true literals."""
    for signs in product((1, -1), repeat=LAST):
        true = {e * v for v, e in enumerate(signs, start=1)}
        if all(true.intersection(clause) for clause in formula):
            yield true


def satisfiable(formula: Formula) -> bool:
    return any(models(formula))


UNSATISFIABLE = FORMULAS.filter(lambda formula: not satisfiable(formula))


def line(number: int, clause: Sequence[int], hints: Sequence[int]) -> str:
    return " ".join(map(str, (number, *clause, 0, *hints, 0)))


def proof_by_splitting(formula: Formula, deleting: bool = False) -> list[str]:
    """Refute an unsatisfiable formula by branching on 1, 2, ...: each branch proves its clause.

    A branch is given by the literals it makes false. Where they contain a clause of the formula
    there is nothing to prove; elsewhere the clauses of the two sub-branches resolve.
    """
    lines: list[str] = []
    last = len(formula)

    def prove(false: Clause) -> int:
        nonlocal last
        for number, clause in enumerate(formula, start=1):
            if set(clause) <= set(false):
                return number
        split = len(false) + 1
        hints = [prove((*false, split)), prove((*false, -split))]
        last += 1
        lines.append(line(last, false, hints))
        if deleting and false:
            used = [hint for hint in hints if hint > len(formula)]
            lines.append(" ".join(map(str, (last, "d", *used, 0))))
        return last

    prove(())
    return lines


def reason(formula: Formula, proof: str) -> str | None:
    """Return why the proof is refused, or None if it is accepted."""
    try:
        replay(formula, proof)
    except NotRefuted as error:
        return str(error)
    return None


# Random formulas.


@pytest.mark.parametrize("deleting", [False, True])
@examples(80)
@given(UNSATISFIABLE)
def test_a_proof_by_splitting_is_accepted(deleting: bool, formula: Formula) -> None:
    lines = proof_by_splitting(formula, deleting)
    assert replay(formula, "\n".join(lines)) == len(lines)


@examples(80)
@given(UNSATISFIABLE)
def test_a_proof_does_not_refute_a_satisfiable_formula(formula: Formula) -> None:
    """Weaken each clause in turn, by a literal or entirely."""
    proof = "\n".join(proof_by_splitting(formula))
    for k, clause in enumerate(formula):
        for weaker in ((*clause, 1), (*clause, -LAST), (1, -1)):
            weakened = [*formula[:k], weaker, *formula[k + 1 :]]
            assert not satisfiable(weakened) or reason(weakened, proof)


NUMBERS = st.integers(-LAST, 12)
STEPS = st.one_of(
    st.builds(
        line, st.integers(1, 20), st.lists(LITERALS, max_size=2), st.lists(NUMBERS, max_size=4)
    ),
    st.lists(st.one_of(NUMBERS.map(str), st.just("d")), max_size=8).map(" ".join),
)


@examples(400)
@given(FORMULAS, st.lists(STEPS, max_size=8).map("\n".join))
def test_what_is_accepted_is_unsatisfiable(formula: Formula, proof: str) -> None:
    assert reason(formula, proof) or not satisfiable(formula)


def propagates_to_conflict(formula: Formula, clause: Clause) -> bool:
    """Does unit propagation, as long as it goes, refute the formula with the clause false?"""
    true = {-literal for literal in clause}
    while True:
        free = [[x for x in c if -x not in true] for c in formula if not true.intersection(c)]
        if not all(free):
            return True
        new = {literals[0] for literals in free if len(literals) == 1}
        if not new:
            return False
        if any(-x in new for x in new):
            return True
        true |= new


@examples(40)
@given(st.lists(CLAUSES, min_size=1, max_size=4))
def test_a_step_is_accepted_iff_unit_propagation_proves_it(formula: Formula) -> None:
    """For all clauses of up to two literals, and all orders of hints."""
    every_order = [
        hints
        for size in range(len(formula) + 1)
        for hints in permutations(range(1, len(formula) + 1), size)
    ]
    literals = [x for v in range(1, LAST + 1) for x in (v, -v)]
    clauses = [c for size in (1, 2) for c in combinations(literals, size) if c[0] != -c[-1]]
    for clause in clauses:
        steps = [line(len(formula) + 1, clause, hints) for hints in every_order]
        accepted = "the proof ends without the empty clause" in {reason(formula, s) for s in steps}
        assert accepted == propagates_to_conflict(formula, clause)
        assert not accepted or all(true.intersection(clause) for true in models(formula))


# Reasons.

SQUARE: Formula = [(1, 2), (-1, 2), (1, -2), (-1, -2)]
PROOF = "5 2 0 1 2 0\n6 0 5 3 4 0"


@pytest.mark.parametrize(
    ("proof", "steps"),
    [
        (PROOF, 2),
        ("5 2 0 1 2 0\n5 d 1 2 0\n6 0 5 3 4 0\n", 3),
        ("5 d 0\n7 2 0 2 1 0\n9 0 7 4 3 0", 3),
        ("5 2 0 1 2 0\n6 -2 0 3 4 0\n7 0 5 6 0", 3),
    ],
)
def test_square_is_refuted(proof: str, steps: int) -> None:
    assert replay(SQUARE, proof) == steps


@pytest.mark.parametrize(
    ("proof", "why"),
    [
        ("", "line 1: not a step in the LRAT format"),
        ("5 2 0 1 2 0\n6 0 5 3 4 0\n\n", "line 3: the proof goes on after the empty clause"),
        ("5 2 0 1 2 0\x0c6 0 5 3 4 0", "line 1: not a step in the LRAT format"),
        ("5 2 0 1 2 0", "the proof ends without the empty clause"),
        ("5 2 0 1 9 0", "line 1: there is no clause 9"),
        ("5 0 5 0", "line 1: there is no clause 5"),
        ("6 2 0 1 2 0\n7 0 5 3 4 0", "line 2: there is no clause 5"),
        ("5 d 9 0", "line 1: there is no clause 9"),
        ("5 d 1 1 0", "line 1: there is no clause 1"),
        ("5 2 0 1 2 0\n5 d 5 0\n6 0 5 3 4 0", "line 3: there is no clause 5"),
        ("5 d 1 0\n5 2 0 1 2 0", "line 2: there is no clause 1"),
        ("5 0 1 2 0", "line 1: hint 1 has 2 literals that are not false"),
        ("5 2 0 1 2 0\n6 0 5 1 3 0", "line 2: hint 2 has 2 literals that are not false"),
        ("5 3 0 1 2 0", "line 1: hint 1 has 2 literals that are not false"),
        ("5 2 0 1 0", "line 1: the hints do not reach a contradiction"),
        ("5 2 0 0", "line 1: the hints do not reach a contradiction"),
        ("4 2 0 1 2 0", "line 1: clause number 4 is not larger than 4"),
        ("5 2 0 1 2 0\n5 0 5 3 4 0", "line 2: clause number 5 is not larger than 5"),
        ("7 2 0 1 2 0\n6 0 7 3 4 0", "line 2: clause number 6 is not larger than 7"),
    ],
)
def test_reason(proof: str, why: str) -> None:
    assert reason(SQUARE, proof) == why


@pytest.mark.parametrize(
    "step",
    [
        "",
        "5",
        "5 0",
        "5 2 0 1 2",
        "5 2 1 2 0",
        "5 2 0 1 2 0 0",
        "5 2 0 1 0 2 0",
        "5 2 0 1 2 0 ",
        " 5 2 0 1 2 0",
        "5  2 0 1 2 0",
        "5\t2 0 1 2 0",
        "5 2.0 0 1 2 0",
        "5 two 0 1 2 0",
        "x 2 0 1 2 0",
        "0 2 0 1 2 0",
        "-5 2 0 1 2 0",
        "+5 2 0 1 2 0",
        "05 2 0 1 2 0",
        "5 -0 0 1 2 0",
        "5 2 0 1_0 2 0",
        "5 2 0 \N{SUPERSCRIPT ONE} 2 0",
        "5 2 0 \N{ARABIC-INDIC DIGIT ONE} 2 0",
        "d 1 0",
        "5 d",
        "5 d 1",
        "5 d -1 0",
        "5 d 1 0 2 0",
        "5 2 d 0 1 2 0",
        "c a comment",
        "5 " + "9" * 5000 + " 0 1 2 0",
        "5 0 -1 x 0",
        "5 0 -1 2 0 c",
    ],
)
def test_malformed_line(step: str) -> None:
    assert reason(SQUARE, f"{step}\n{PROOF}") == "line 1: not a step in the LRAT format"


@pytest.mark.parametrize("step", ["5 2 0 -1 2 0", "5 2 0 1 -2 3 0", "5 0 -1 0"])
def test_rat_steps_are_told_apart(step: str) -> None:
    why = "line 1: a hint is negative: RAT steps are outside this format"
    assert reason(SQUARE, step) == why


def test_binary_lrat_is_told_apart() -> None:
    why = "line 1: the binary form of LRAT is outside this format"
    assert reason(SQUARE, "a\n\4\0\2\4\0".replace("\n", "\5")) == why


@pytest.mark.parametrize(
    ("step", "why"),
    [
        ("5 2 2 0 1 2 0", "variable 2 occurs 2 times"),
        ("5 2 1 -2 0 1 2 0", "variable 2 occurs 2 times"),
        ("5 2 0 1 1 2 0", "hint 1 occurs 2 times"),
    ],
)
def test_nothing_is_repeated(step: str, why: str) -> None:
    """So that the time to replay a proof is bounded by its length alone."""
    assert reason(SQUARE, f"{step}\n{PROOF}") == f"line 1: {why}"


def test_a_clause_of_the_formula_may_repeat_a_literal() -> None:
    assert replay([(1, 1), (-1, -1, -1)], "3 0 1 2 0") == 1


# Final polynomials.

Six = tuple[int, ...]

INEQUALITIES: tuple[Six, ...] = (
    (1, 7, 3, 6, 8, 5), (2, 4, 3, 8, 6, 5), (2, 5, 4, 8, 6, 7),
    (3, 4, 2, 6, 8, 7), (3, 7, 1, 8, 6, 4), (5, 7, 1, 6, 8, 2),
)  # fmt: skip
"""Every determinant occurs equally often on the larger and on the smaller side."""

NEGATIVE = (
    "1234 1235 1236 1237 1245 1246 1247 1256 1345 1346 1347 1356 2346 2356 2456 3456 3468 3568 "
    "4567 4568"
)
SIGNS: dict[Simplex, int] = {
    q: -1 if "".join(map(str, q)) in NEGATIVE.split() else 1 for q in QUADRUPLES
}
"""Signs that imply these inequalities, yet satisfy all Grassmann-Pluecker clauses."""


def brackets(six: Six) -> list[tuple[Six, Six]]:
    """Return [s t a b][s t c d], [s t a c][s t b d], [s t a d][s t b c], as pairs."""
    s, t, a, b, c, d = six
    return [
        ((s, t, w, x), (s, t, y, z)) for w, x, y, z in ((a, b, c, d), (a, c, b, d), (a, d, b, c))
    ]


def unordered(vertices: Six) -> Simplex:
    return tuple(sorted(vertices))


NEEDED = {unordered(v) for six in INEQUALITIES for pair in brackets(six)[1:] for v in pair}


def polynomial(
    signs: dict[Simplex, int], inequalities: Sequence[Six], multiplier: int = 1
) -> FinalPolynomial:
    return FinalPolynomial(signs, tuple((multiplier, six) for six in inequalities))


def refusal(candidate: FinalPolynomial) -> str | None:
    try:
        excluded_signs(candidate)
    except NotRefuted as error:
        return str(error)
    return None


def relabelled(order: Sequence[int]) -> tuple[dict[Simplex, int], list[Six]]:
    """Return the needed signs and the inequalities with vertex v renamed order[v-1]."""
    signs = {}
    for q in NEEDED:
        named = tuple(order[v - 1] for v in q)
        odd = sum(a > b for a, b in combinations(named, 2)) % 2
        signs[unordered(named)] = -SIGNS[q] if odd else SIGNS[q]
    return signs, [tuple(order[v - 1] for v in six) for six in INEQUALITIES]


def test_final_polynomial_excludes_signs_that_grassmann_pluecker_relations_allow() -> None:
    clause = excluded_signs(polynomial({q: SIGNS[q] for q in NEEDED}, INEQUALITIES))
    literals = true_literals(SIGNS)
    assert not any(literals.isdisjoint(c) for c in grassmann_pluecker())
    assert literals.isdisjoint(clause)
    assert {QUADRUPLES[(abs(x) - 1) // 2] for x in clause} == NEEDED


@examples(100)
@given(st.permutations(range(1, 9)), PLACEMENTS)
def test_no_points_have_excluded_signs(order: list[int], placement: Placement) -> None:
    signs, inequalities = relabelled(order)
    clause = excluded_signs(polynomial(signs, inequalities))
    assert not true_literals(signs_of(placement)).isdisjoint(clause)
    assert refusal(polynomial(signs_of(placement), inequalities))


SIX = (1, 2, 3, 4, 5, 6)
SWAPPED = (1, 2, 3, 5, 4, 6)
"""The same relation, with the larger and the smaller product exchanged."""


def test_two_inequalities_of_one_relation_exclude_what_no_numbers_satisfy() -> None:
    """A = B - C is impossible, whatever the numbers, if A, -B and C have the same sign."""
    six = [unordered(v) for pair in brackets(SIX) for v in pair]
    for values in product((-1, 0, 1), repeat=6):
        signs = dict(zip(six, values, strict=True))
        a, b, c = (signs[x] * signs[y] for x, y in brackets(SIX))
        accepted = refusal(polynomial(signs, [SIX, SWAPPED])) is None
        assert accepted == ({a, -b, c} in ({1}, {-1}))


@examples(20)
@given(PLACEMENTS)
def test_the_signs_of_points_imply_no_contradiction(placement: Placement) -> None:
    signs = signs_of(placement)
    for s, t in combinations(range(1, 9), 2):
        others = [v for v in range(1, 9) if v not in (s, t)]
        for a, b, c, d in permutations(others, 4):
            assert refusal(polynomial(signs, [(s, t, a, b, c, d), (s, t, a, c, b, d)]))


@pytest.mark.parametrize("multiplier", [1, 2, 10**30])
def test_equal_multipliers_do_not_matter(multiplier: int) -> None:
    assert refusal(polynomial(SIGNS, INEQUALITIES, multiplier)) is None


ONLY_IN_THE_REST = NEEDED - {unordered(v) for six in INEQUALITIES for v in brackets(six)[1]}


@pytest.mark.parametrize("zero", sorted(ONLY_IN_THE_REST))
def test_an_inequality_may_be_weak(zero: Simplex) -> None:
    signs = {q: SIGNS[q] for q in NEEDED} | {zero: 0}
    clause = excluded_signs(polynomial(signs, INEQUALITIES))
    assert true_literals(SIGNS | {zero: 0}).isdisjoint(clause)
    assert not true_literals(SIGNS).isdisjoint(clause)
    assert not true_literals(SIGNS | {zero: -SIGNS[zero]}).isdisjoint(clause)


NO_CONTRADICTION = "the inequalities do not multiply to a contradiction"


def test_one_inequality_must_be_strict() -> None:
    """A zero factor makes the rest zero, whatever the other; then |A| = |B| is no contradiction."""
    (_, smaller, rest) = brackets(SIX)
    signs = {unordered(v): 1 for v in (*brackets(SIX)[0], *smaller)} | {unordered(rest[0]): 0}
    assert refusal(polynomial(signs, [SIX, SWAPPED])) == NO_CONTRADICTION


@pytest.mark.parametrize("strict", INEQUALITIES)
def test_one_strict_inequality_is_enough(strict: Six) -> None:
    """Whatever the sign of its rest: both occur."""
    zeros = {unordered(brackets(six)[2][0]): 0 for six in INEQUALITIES if six != strict}
    signs = {q: SIGNS[q] for q in NEEDED} | zeros
    assert refusal(polynomial(signs, INEQUALITIES)) is None


@pytest.mark.parametrize("quadruple", sorted(NEEDED))
def test_every_sign_is_needed(quadruple: Simplex) -> None:
    without = {q: sign for q, sign in SIGNS.items() if q != quadruple}
    unknown = refusal(polynomial(without, INEQUALITIES))
    assert unknown == f"no sign is assumed for {quadruple}"
    opposite = refusal(polynomial(SIGNS | {quadruple: -SIGNS[quadruple]}, INEQUALITIES))
    assert opposite is not None
    assert opposite.startswith("the signs do not imply the inequality of")


@pytest.mark.parametrize("k", range(len(INEQUALITIES)))
def test_every_inequality_is_needed_as_often_as_the_others(k: int) -> None:
    fewer = INEQUALITIES[:k] + INEQUALITIES[k + 1 :]
    assert refusal(polynomial(SIGNS, fewer)) == NO_CONTRADICTION
    assert refusal(polynomial(SIGNS, (*INEQUALITIES, INEQUALITIES[k]))) == NO_CONTRADICTION


@pytest.mark.parametrize("multiplier", [0, -1])
def test_multipliers_are_positive(multiplier: int) -> None:
    candidate = polynomial(SIGNS, INEQUALITIES, multiplier)
    assert refusal(candidate) == f"multiplier {multiplier} is not positive"


def test_no_inequalities_are_no_contradiction() -> None:
    assert refusal(polynomial(SIGNS, [])) == NO_CONTRADICTION


@pytest.mark.parametrize("zero", sorted(NEEDED - ONLY_IN_THE_REST))
def test_the_smaller_side_is_not_zero(zero: Simplex) -> None:
    why = refusal(polynomial(SIGNS | {zero: 0}, INEQUALITIES))
    assert why is not None
    assert why.startswith("the signs do not imply the inequality of")
