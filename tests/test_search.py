"""What is found is deterministic and accepted by the kernel; names agree with the paper's."""

from collections import Counter
from collections.abc import Callable, Sequence
from itertools import combinations
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given

from certify import paper
from certify.kernel.certificate import QUESTIONS, Certificate, No, Yes
from certify.kernel.check import Verdict, check_pattern
from certify.kernel.chirotope import chirotope, integral
from certify.kernel.embedding import NotRealized, require_convex_position, require_realization
from certify.kernel.hexahedron import BOUNDARY_TYPES, Simplex
from certify.kernel.jacobian import bernstein_coefficients
from certify.kernel.orientations import Clause
from certify.kernel.refutation import excluded_signs, replay
from certify.kernel.triangulation import boundary_diagonals, orbit, orientation
from certify.search import build
from certify.search.build import Finding, Refutation, investigate, status, write
from certify.search.enumeration import Pattern, patterns
from certify.search.final_polynomials import (
    final_polynomial,
    refute_with_polynomials,
    sign_vector,
)
from certify.search.margins import Array, bernstein, determinants, distances_beyond
from certify.search.naming import amended_letters, assign_names
from certify.search.placement import place
from certify.search.refutations import Step, lrat, model, refute, trim
from certify.search.sieve import QUADS, Sieve
from tests.geometry import (
    CUBE,
    CUBE_TRIANGULATIONS,
    PLACEMENTS,
    Placement,
    exact,
    examples,
    signs_of,
    true_literals,
    volume,
)
from tests.test_refutation import FORMULAS, SIGNS, UNSATISFIABLE, Formula, satisfiable
from tests.test_validity import determinants as volumes

Certificates = dict[str, Certificate]


@pytest.fixture(scope="module")
def enumerated() -> list[Pattern]:
    return patterns()


@pytest.fixture(scope="module")
def shipped_findings(shipped: Path, certificates: Certificates) -> dict[str, dict[str, Finding]]:
    """Return what would have to be found for the shipped certificates to be written."""

    def finding(name: str, question: str) -> Finding:
        answer = certificates[name].answers[question]
        if isinstance(answer, Yes):
            return [list(map(int, point)) for point in answer.points]
        if isinstance(answer, No):
            return Refutation(steps_of(shipped / answer.proof), list(answer.final_polynomials))
        return None

    return {name: {q: finding(name, q) for q in QUESTIONS} for name in certificates}


def steps_of(path: Path) -> list[Step]:
    """Read the steps of an LRAT file without deletions."""
    steps = []
    for line in path.read_text().splitlines():
        number, *numbers = map(int, line.split())
        end = numbers.index(0)
        steps.append(Step(number, tuple(numbers[:end]), tuple(numbers[end + 1 : -1])))
    return steps


# Enumeration.


def test_174_patterns_are_enumerated(enumerated: list[Pattern], certificates: Certificates) -> None:
    assert len(enumerated) == 174
    assert {(c.boundary, c.tetrahedra) for c in certificates.values()} == set(enumerated)
    assert enumerated == sorted(enumerated, key=lambda p: (len(p.tetrahedra), p.tetrahedra))


def test_patterns_are_least_with_the_boundary_of_their_type(enumerated: list[Pattern]) -> None:
    for letter, tetrahedra in enumerated:
        diagonals = BOUNDARY_TYPES[letter]
        fitting = [i for i in orbit(tetrahedra) if boundary_diagonals(i) == diagonals]
        assert tetrahedra == min(fitting)


# Names.


@pytest.fixture(scope="module")
def facts(
    enumerated: list[Pattern],
    certificates: Certificates,
    shipped_findings: dict[str, dict[str, Finding]],
) -> dict[str, tuple[int, str, str]]:
    """Return, by shipped name and in the order of enumeration, what a name says."""
    names = {certificate.tetrahedra: name for name, certificate in certificates.items()}
    return {
        (name := names[pattern.tetrahedra]): (
            len(pattern.tetrahedra),
            pattern.boundary,
            status(pattern, shipped_findings[name]),
        )
        for pattern in enumerated
    }


def test_names_are_assigned(facts: dict[str, tuple[int, str, str]]) -> None:
    assert assign_names(list(facts.values())) == list(facts)
    assert len(facts) == 174


def test_names_say_what_is_true(facts: dict[str, tuple[int, str, str]]) -> None:
    """But for four letters, of two pairs of patterns with 13 tetrahedra."""
    for name, (size, _, found) in facts.items():
        assert (size, found) == (paper.size(name), paper.printed_status(name))
    differing = {n: letter for n, (_, letter, _) in facts.items() if letter != paper.LETTERS[n]}
    assert differing == {"13_S": "c", "13_T": "d", "13_W": "g", "13_X": "f"}
    counts = {fact: list(facts.values()).count(fact) for fact in facts.values()}
    assert amended_letters(counts) == {name: letter for name, (_, letter, _) in facts.items()}


def test_fewer_letters_cannot_differ(facts: dict[str, tuple[int, str, str]]) -> None:
    """Two cells, of one size and status, have other counts than printed, and so two others."""
    printed = [
        (paper.size(n), letter, paper.printed_status(n)) for n, letter in paper.LETTERS.items()
    ]
    found = list(facts.values())
    differences = {cell: found.count(cell) - printed.count(cell) for cell in {*found, *printed}}
    assert sum(map(abs, differences.values())) == 2 * 4


# Refutations.


@examples(100)
@given(UNSATISFIABLE)
def test_refutations_are_replayed(formula: Formula) -> None:
    steps = refute(formula)
    assert steps is not None
    assert replay(formula, lrat(steps)) == len(steps)
    assert steps[-1].clause == ()


@examples(100)
@given(FORMULAS)
def test_only_unsatisfiable_formulas_are_refuted(formula: Formula) -> None:
    assert (refute(formula) is None) == satisfiable(formula)
    assert (model(formula) is None) != satisfiable(formula)


def pigeons(holes: int) -> Formula:
    """Return the formula that as many pigeons and one more have a hole each."""
    place = [[holes * p + h + 1 for h in range(holes)] for p in range(holes + 1)]
    crowded = [(-one[h], -other[h]) for one, other in combinations(place, 2) for h in range(holes)]
    return [*map(tuple, place), *crowded]


def random_formula(seed: int, variables: int = 25) -> Formula:
    rng = np.random.default_rng(seed)
    chosen = [rng.choice(variables, 3, replace=False) + 1 for _ in range(8 * variables)]
    return [tuple((three * rng.choice([-1, 1], 3)).tolist()) for three in chosen]


@pytest.mark.parametrize("formula", [pigeons(4), *map(random_formula, range(8))])
def test_longer_refutations_are_replayed(formula: Formula) -> None:
    steps = refute(formula)
    assert steps is not None
    assert len(steps) > 1
    assert replay(formula, lrat(steps)) == len(steps)


def test_trimming_keeps_what_is_needed() -> None:
    formula: list[Clause] = [(1, 2), (1, -2), (-1, 3), (-1, -3), (4, 5)]
    steps = trim(formula, [(4, 5, 1), (1,), (5, 1), ()])
    assert steps == [Step(7, (1,), steps[0].hints), Step(9, (), steps[1].hints)]
    assert set(steps[0].hints) == {1, 2}
    assert set(steps[1].hints) == {7, 3, 4}


def test_trimming_refuses_what_does_not_follow() -> None:
    with pytest.raises(ValueError, match="does not follow by unit propagation"):
        trim([(1, 2), (-1, 2)], [()])


# Final polynomials.


def test_signs_that_no_points_have_are_excluded() -> None:
    polynomial = final_polynomial(SIGNS)
    assert polynomial is not None
    assert true_literals(SIGNS).isdisjoint(excluded_signs(polynomial))


@pytest.mark.parametrize(
    "placement",
    [
        CUBE,
        tuple((k, k**2, k**3) for k in range(8)),
        tuple((k // 2, k % 2, k // 4) for k in range(8)),
        ((0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1), *[(2, 3, 4)] * 4),
    ],
)
def test_signs_of_points_are_not_excluded(placement: Placement) -> None:
    assert final_polynomial(signs_of(placement)) is None


def test_polynomials_join_the_formula() -> None:
    """Nothing has the signs above; the cube has its own."""
    fixed: list[Clause] = [(literal,) for literal in sorted(true_literals(SIGNS), key=abs)]
    steps, (polynomial,) = refute_with_polynomials(fixed) or ([], [])
    assert replay([*fixed, excluded_signs(polynomial)], lrat(steps)) == len(steps)
    signs = signs_of(CUBE)
    literals: list[Clause] = [(literal,) for literal in sorted(true_literals(signs), key=abs)]
    assert refute_with_polynomials(literals) is None
    assert sign_vector([literal for (literal,) in literals]) == signs


# Placements.


def moved(points: Array, noise: float, count: int, rng: np.random.Generator) -> Array:
    return np.rint(20 * (points + noise * rng.normal(size=(count, 8, 3)))).astype(int)


def refusal(test: Callable[..., object], *args: object) -> str | None:
    """Return why the kernel's test refuses, if it does."""
    try:
        test(*args)
    except NotRealized as error:
        return str(error)
    return None


def samples(certificate: Certificate, rng: np.random.Generator) -> Array:
    """Return a witness, what is near to it, degenerate placements, and some with the right signs.

    Among the last, tetrahedra often overlap, and on the small grid the Jacobian often vanishes.
    """
    signs = orientation(certificate.tetrahedra)
    (points,) = {a.points for a in [certificate.answers["realizable"]] if isinstance(a, Yes)}
    witness = np.array(integral(points))
    oriented = []
    for width in (3, 20):
        anything = rng.integers(0, width, (60_000, 8, 3))
        right = np.sign(volumes(anything, list(signs))) == list(signs.values())
        oriented.append(anything[right.all(axis=1)][:20])
    return np.concatenate(
        [
            20 * witness[None],
            *(moved(witness, noise, 6, rng) for noise in (0.02, 0.2, 1.0)),
            rng.integers(0, 3, (4, 8, 3)),
            *oriented,
        ]
    )


@pytest.fixture(scope="module")
def sampled(certificates: Certificates) -> list[tuple[dict[Simplex, int], Array]]:
    """Return an oriented triangulation of each size, and placements to try."""
    rng = np.random.default_rng(13)
    realizable = [c for c in certificates.values() if isinstance(c.answers["realizable"], Yes)]
    of_each_size = {len(c.tetrahedra): c for c in realizable}.values()
    return [(orientation(c.tetrahedra), samples(c, rng)) for c in of_each_size]


@pytest.mark.parametrize("convex", [False, True])
@pytest.mark.parametrize("valid", [False, True])
def test_sieve_lets_pass_what_the_kernel_accepts(
    sampled: list[tuple[dict[Simplex, int], Array]], convex: bool, valid: bool
) -> None:
    outcomes = Counter[str]()
    for signs, placements in sampled:
        sieve = Sieve(signs, convex, valid)
        for placement in placements:
            points = exact(placement.tolist())
            found = chirotope(points)
            reason = refusal(require_realization, signs, found)
            if convex:
                reason = reason or refusal(require_convex_position, found)
            if valid and min(bernstein_coefficients(points).values()) <= 0:
                reason = reason or "invalid"
            assert len(sieve(placement[None])) == (reason is None)
            outcomes[(reason or "good").partition(" ")[0]] += 1
    assert outcomes["good"] > 20
    assert outcomes["tetrahedron"] > 20
    assert outcomes["faces"] > 20
    assert (outcomes["vertex"] > 5) == convex
    assert (outcomes["invalid"] > 5) == valid


@examples(30)
@given(PLACEMENTS)
def test_margins_are_exact_on_integers(placement: Placement) -> None:
    points = np.array(placement, dtype=float)
    values, _ = determinants(points, QUADS)
    assert values.tolist() == [volume(*(placement[v] for v in q)) for q in QUADS]
    coefficients = bernstein_coefficients(exact(placement)).values()
    assert np.allclose(8 * bernstein(points)[0], list(coefficients))


@pytest.mark.parametrize("seed", range(3))
def test_margins_have_their_gradients(seed: int) -> None:
    """Against difference quotients; all the functions are of degree at most two in one step."""
    rng = np.random.default_rng(seed)
    points, step = rng.normal(size=(8, 3)), rng.normal(size=(8, 3))
    directions, turn = rng.normal(size=(8, 3)), rng.normal(size=(8, 3))
    h = 1e-4

    for function in (lambda p: determinants(p, QUADS), bernstein):
        quotient = (function(points + h * step)[0] - function(points - h * step)[0]) / (2 * h)
        assert np.allclose(np.tensordot(function(points)[1], step, 2), quotient, atol=1e-6)

    beyond, slopes = distances_beyond(points, directions)
    ahead, _ = distances_beyond(points + h * step, directions + h * turn)
    back, _ = distances_beyond(points - h * step, directions - h * turn)
    assert np.allclose(
        slopes @ np.concatenate([step.ravel(), turn.ravel()]), (ahead - back) / (2 * h)
    )
    assert len(beyond) == 56


def test_what_has_no_valid_hexahedron_is_not_placed(certificates: Certificates) -> None:
    """From three starts; it would not be found from more either."""
    signs = orientation(certificates["15_K"].tetrahedra)
    rng = np.random.default_rng(14)
    assert place(signs, convex=True, valid=True, rng=rng, starts=2) is None


# From a pattern to its certificate, and back.


def accepted(root: Path, name: str, pattern: Pattern, answers: dict[str, Finding]) -> Verdict:
    """Write a certificate below a new root; return the verdict on it, which is no rejection."""
    for folder in ("certificates", "proofs"):
        (root / folder).mkdir()
    write(root, name, pattern, answers)
    verdict = check_pattern(root, name)
    assert verdict.fault is None
    return verdict


def test_investigation_is_deterministic(tmp_path: Path) -> None:
    pattern = Pattern("a", CUBE_TRIANGULATIONS["core"])
    answers = investigate(pattern, 1)
    assert investigate(pattern, 1) == answers
    assert accepted(tmp_path, "5_A", pattern, answers).answers == dict.fromkeys(QUESTIONS, "yes")


def test_refutations_are_found_again(tmp_path: Path, certificates: Certificates) -> None:
    certificate = certificates["15_A"]
    pattern = Pattern(certificate.boundary, certificate.tetrahedra)
    answers = investigate(pattern, 1)
    assert investigate(pattern, 2) == answers
    assert accepted(tmp_path, "15_A", pattern, answers).answers == dict.fromkeys(QUESTIONS, "no")


def test_what_is_not_found_is_open(tmp_path: Path) -> None:
    pattern = Pattern("a", CUBE_TRIANGULATIONS["core"])
    nothing: dict[str, Finding] = dict.fromkeys(QUESTIONS)
    verdict = accepted(tmp_path, "5_A", pattern, nothing)
    assert verdict.answers == dict.fromkeys(QUESTIONS, "open")


def test_building_writes_what_is_shipped(
    tmp_path: Path,
    shipped: Path,
    certificates: Certificates,
    shipped_findings: dict[str, dict[str, Finding]],
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """Byte for byte, once the same points and proofs are found; and it clears away all else."""
    names = {certificate.tetrahedra: name for name, certificate in certificates.items()}
    proofs = {
        letter: steps_of(shipped / f"proofs/complete.{letter}.lrat") for letter in BOUNDARY_TYPES
    }
    pending = iter(proofs.values())

    def found_again(pattern: Pattern, seed: int) -> dict[str, Finding]:
        return shipped_findings[names[pattern.tetrahedra]]

    def proved_again(formula: Sequence[Clause]) -> list[Step]:
        return next(pending)

    monkeypatch.setattr(build, "investigate", found_again)
    monkeypatch.setattr(build, "refute", proved_again)
    (tmp_path / "certificates").mkdir()
    (tmp_path / "certificates" / "16_A.json").write_text("stale")
    reports: list[str] = []
    build.build(tmp_path, 1, reports.append)
    for folder in ("certificates", "proofs"):
        assert contents(tmp_path / folder) == contents(shipped / folder)
    assert reports[-1] == "174 certificates written"


def contents(folder: Path) -> dict[str, bytes]:
    return {path.name: path.read_bytes() for path in folder.iterdir()}
