"""What is found is deterministic and accepted by the kernel; names agree with the paper's."""

import os
import subprocess
import sys
from collections import Counter
from collections.abc import Callable, Iterator, Sequence
from fractions import Fraction
from itertools import combinations
from pathlib import Path
from typing import Any

import cvxpy as cp
import numpy as np
import pytest
from hypothesis import given

from certify import load, paper
from certify.kernel import names
from certify.kernel.certificate import QUESTIONS, Certificate, No, Yes
from certify.kernel.check import FORMULAS as QUESTIONS_AS_FORMULAS
from certify.kernel.check import Verdict, check_pattern
from certify.kernel.chirotope import chirotope, integral
from certify.kernel.embedding import NotRealized, require_convex_position, require_realization
from certify.kernel.hexahedron import BOUNDARY_TYPES, Simplex
from certify.kernel.jacobian import bernstein_coefficients
from certify.kernel.orientations import Clause
from certify.kernel.refutation import excluded_signs, replay
from certify.kernel.triangulation import boundary_diagonals, orbit, orientation
from certify.manifest import EVIDENCE
from certify.mesh.quality import scaled_jacobians
from certify.search import build
from certify.search.build import Finding, Refutation, investigate, status, write
from certify.search.enumeration import Pattern, patterns
from certify.search.final_polynomials import (
    final_polynomial,
    refute_with_polynomials,
    sign_vector,
)
from certify.search.naming import amended_letters, assign_names
from certify.search.placement import place
from certify.search.refutations import Step, lrat, model, refute, trim
from certify.search.sieve import Array, Sieve, shape
from tests.geometry import (
    CUBE,
    CUBE_TRIANGULATIONS,
    Placement,
    exact,
    examples,
    near,
    signs_of,
    true_literals,
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
    differing = {n: letter for n, (_, letter, _) in facts.items() if letter != names.LETTERS[n]}
    assert differing == names.AMENDED == {"13_S": "c", "13_T": "d", "13_W": "g", "13_X": "f"}
    counts = {fact: list(facts.values()).count(fact) for fact in facts.values()}
    assert amended_letters(counts) == {name: letter for name, (_, letter, _) in facts.items()}


def test_fewer_letters_cannot_differ(facts: dict[str, tuple[int, str, str]]) -> None:
    """Two cells, of one size and status, have other counts than printed, and so two others."""
    printed = [
        (paper.size(n), letter, paper.printed_status(n)) for n, letter in names.LETTERS.items()
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


def test_final_polynomials_do_not_depend_on_the_solver(
    certificates: Certificates, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Each is the only cheapest one: an interior-point method comes to the shipped ones as well."""
    solve = cp.Problem.solve

    def solve_otherwise(problem: cp.Problem, **_: object) -> None:
        solve(problem, solver=cp.SCIPY, scipy_options={"method": "highs-ipm"})

    monkeypatch.setattr(cp.Problem, "solve", solve_otherwise)
    found = 0
    for certificate in certificates.values():
        for question, answer in certificate.answers.items():
            if isinstance(answer, No) and answer.final_polynomials:
                formula = QUESTIONS_AS_FORMULAS[question](orientation(certificate.tetrahedra))
                _, polynomials = refute_with_polynomials(formula) or ([], [])
                assert polynomials == list(answer.final_polynomials)
                found += len(polynomials)
    assert found == 5


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
    return np.asarray(np.rint(20 * (points + noise * rng.normal(size=(count, 8, 3)))), dtype=int)


def refusal(test: Callable[..., object], *args: object) -> str | None:
    """Return why the kernel's test refuses, if it does."""
    try:
        test(*args)
    except NotRealized as error:
        return str(error)
    return None


def points_of(certificate: Certificate, question: str) -> Array:
    (points,) = {a.points for a in [certificate.answers[question]] if isinstance(a, Yes)}
    return np.array(integral(points))


def samples(certificate: Certificate, rng: np.random.Generator) -> Array:
    """Return a witness, what is near to it, degenerate placements, and some with the right signs.

    Among the last, tetrahedra often overlap, and on the small grid the Jacobian often vanishes.
    """
    signs = orientation(certificate.tetrahedra)
    witness = points_of(certificate, "realizable")
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
            assert (sieve.failures(placement[None]) == 0) == (reason is None)
            outcomes[(reason or "good").partition(" ")[0]] += 1
    assert outcomes["good"] > 20
    assert outcomes["tetrahedron"] > 20
    assert outcomes["faces"] > 20
    assert (outcomes["vertex"] > 5) == convex
    assert (outcomes["invalid"] > 5) == valid


@examples(100)
@given(near(CUBE, 10, 4))
def test_shape_is_the_square_of_the_least_scaled_jacobian(placement: Placement) -> None:
    points = np.array(placement)
    least = min(scaled_jacobians(exact(placement)))
    assert float(shape(points)) == pytest.approx(least * abs(least))


def test_corners_that_do_not_exceed_the_bar_fail(certificates: Certificates) -> None:
    certificate = certificates["13_A"]
    points = points_of(certificate, "valid")
    squares = [x * x for x in scaled_jacobians(exact(points.tolist()))]
    sieve = Sieve(orientation(certificate.tetrahedra), convex=True, valid=True)
    for bar in (Fraction(0), shape(points), Fraction(1, 2), Fraction(9, 10)):
        sieve.bar = bar
        expected = sum(square < bar + 1e-9 for square in squares)
        assert sieve.failures(points[None]).tolist() == [expected]


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


def test_the_cube_is_found(tmp_path: Path) -> None:
    pattern = Pattern("a", CUBE_TRIANGULATIONS["core"])
    answers = investigate(pattern, 1)
    assert answers["valid"] == [list(corner) for corner in CUBE]
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


def investigate_again(names: Sequence[str], root: Path) -> None:
    """Investigate these patterns of the shipped ones, and write what is found below the root."""
    for folder in EVIDENCE:
        (root / folder).mkdir()
    tetrahedra = {name: load(name).tetrahedra for name in names}
    for seed, pattern in enumerate(patterns()):
        for name in names:
            if tetrahedra[name] == pattern.tetrahedra:
                write(root, name, pattern, investigate(pattern, seed))


def assert_shipped(root: Path, shipped: Path, files: int) -> None:
    """Require that so many files below the root are the shipped ones, byte for byte."""
    found = {path.relative_to(root): path.read_bytes() for path in root.glob("*/*")}
    assert found == {path: (shipped / path).read_bytes() for path in found}
    assert len(found) == files


def test_what_is_shipped_is_found_again(tmp_path: Path, shipped: Path) -> None:
    """Refutations, a coarse realization and two valid hexahedra."""
    investigate_again(["6_A", "8_A", "13_T", "15_J"], tmp_path)
    assert_shipped(tmp_path, shipped, 4 + 2 + 3)


OLD = "X86_V3 X86_V4 AVX512_ICL"
MACHINES = {
    "one thread": {"OPENBLAS_NUM_THREADS": "1"},
    "two threads": {"OPENBLAS_NUM_THREADS": "2"},
    "an old processor": {"OPENBLAS_CORETYPE": "Prescott", "NPY_DISABLE_CPU_FEATURES": OLD},
}
"""What makes numpy and its BLAS compute otherwise."""


@pytest.mark.slow
@pytest.mark.parametrize("machine", MACHINES)
def test_what_is_found_does_not_depend_on_the_machine(
    tmp_path: Path, shipped: Path, machine: str
) -> None:
    names = ["9_A", "11_AD", "13_A", "14_B", "15_D", "15_G"]
    subprocess.run(
        [sys.executable, "-c", AGAIN, str(tmp_path), *names],
        cwd=shipped,
        env=os.environ | MACHINES[machine],
        check=True,
    )
    assert_shipped(tmp_path, shipped, len(names) + 1 + 2)


AGAIN = """
import pathlib, sys
from tests.test_search import investigate_again
investigate_again(sys.argv[2:], pathlib.Path(sys.argv[1]))
"""


def test_building_writes_what_is_shipped(
    tmp_path: Path,
    shipped: Path,
    certificates: Certificates,
    shipped_findings: dict[str, dict[str, Finding]],
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """Byte for byte, once the same is found; in a new folder, and in the place of an old one.

    There, certificates and proofs that were not found again are removed, and nothing else.
    """
    names = {certificate.tetrahedra: name for name, certificate in certificates.items()}
    proofs = {
        letter: steps_of(shipped / f"proofs/complete.{letter}.lrat") for letter in BOUNDARY_TYPES
    }
    pending: Iterator[list[Step]]

    def found_again(pattern: Pattern, seed: int) -> dict[str, Finding]:
        return shipped_findings[names[pattern.tetrahedra]]

    def proved_again(formula: Sequence[Clause]) -> list[Step]:
        return next(pending)

    monkeypatch.setattr(build, "investigate", found_again)
    monkeypatch.setattr(build, "refute", proved_again)
    root = tmp_path / "new" / "folder"
    once = [(build.INVESTIGATING, done, 174) for done in range(175)]
    once += [(build.COMPLETING, done, 7) for done in range(8)]
    reports: list[tuple[str, int, int]] = []
    for builds in (1, 2):
        pending = iter(proofs.values())
        build.build(root, 1, lambda *line: reports.append(line))
        assert reports == builds * once
        assert {path.name for path in root.iterdir()} == set(EVIDENCE)
        for folder, suffix in EVIDENCE.items():
            kept = {"notes": b"mine"} if builds == 2 else {}
            assert contents(root / folder) == contents(shipped / folder) | kept
            (root / folder / f"16_A{suffix}").write_text("stale")
            (root / folder / "notes").write_text("mine")


def contents(folder: Path) -> dict[str, bytes]:
    return {path.name: path.read_bytes() for path in folder.iterdir()}


def test_an_interrupted_build_creates_nothing(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def interrupted(*_: Any) -> None:
        raise KeyboardInterrupt

    monkeypatch.setattr(build, "write_patterns", interrupted)
    with pytest.raises(KeyboardInterrupt):
        build.build(tmp_path / "new", 1, lambda *_: None)
    assert list(tmp_path.iterdir()) == []
    (tmp_path / "file").touch()
    with pytest.raises(FileExistsError):
        build.build(tmp_path / "file", 1, lambda *_: None)


def test_an_interrupted_build_changes_nothing(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def interrupted(*_: Any) -> None:
        raise KeyboardInterrupt

    (tmp_path / "certificates").mkdir()
    (tmp_path / "certificates" / "5_A.json").write_text("old")
    monkeypatch.setattr(build, "write_completeness", interrupted)
    monkeypatch.setattr(build, "write_patterns", lambda root, *_: (root / "proofs/x").touch())
    with pytest.raises(KeyboardInterrupt):
        build.build(tmp_path, 1, lambda *_: None)
    assert {path.name for path in tmp_path.rglob("*")} == {"certificates", "5_A.json"}
    assert contents(tmp_path / "certificates") == {"5_A.json": b"old"}
