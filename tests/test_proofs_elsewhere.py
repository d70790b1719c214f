"""Every proof, without its hints, before two other checkers.

One is drup (on PyPI), which was extracted from a correctness proof in Why3. It has wheels for some
platforms only. The other is below: propagation by counting, where the kernel follows the hints.
"""

import importlib.util
from collections import Counter
from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import NamedTuple

import pytest
from pysat.solvers import Solver

from certify.kernel.certificate import QUESTIONS, Certificate, No
from certify.kernel.check import (
    Verdict,
    completeness_formula,
    instances_bounded_by,
    refuted_formula,
)
from certify.kernel.evidence import completeness_file
from certify.kernel.hexahedron import BOUNDARY_TYPES
from certify.kernel.orientations import Clause
from certify.kernel.triangulation import orientation

needs_drup = pytest.mark.skipif(
    importlib.util.find_spec("drup") is None, reason="drup has no wheel for this platform"
)
every_question = pytest.mark.parametrize("question", QUESTIONS)
every_boundary = pytest.mark.parametrize("letter", BOUNDARY_TYPES)


class Proved(NamedTuple):
    """A formula that the kernel writes, and what is on disk to refute it."""

    path: str
    formula: Sequence[Clause]
    lemmas: list[Clause]
    hints: list[Clause]

    @property
    def core(self) -> list[Clause]:
        """The clauses of the formula that the hints name."""
        named = {hint for hints in self.hints for hint in hints if hint <= len(self.formula)}
        return [self.formula[number - 1] for number in sorted(named)]


def read(root: Path, path: str, formula: Sequence[Clause]) -> Proved:
    """Read lemmas and hints from an LRAT file without deletions."""
    lemmas, hints = [], []
    for line in (root / path).read_text().splitlines():
        _, *numbers = map(int, line.split())
        end = numbers.index(0)
        lemmas.append(tuple(numbers[:end]))
        hints.append(tuple(numbers[end + 1 : -1]))
    return Proved(path, formula, lemmas, hints)


@pytest.fixture(scope="module")
def refutations(shipped: Path, certificates: dict[str, Certificate]) -> dict[str, list[Proved]]:
    """Return all refutations, by question."""
    found: dict[str, list[Proved]] = {question: [] for question in QUESTIONS}
    for certificate in certificates.values():
        signs = orientation(certificate.tetrahedra)
        for question, answer in certificate.answers.items():
            if isinstance(answer, No):
                formula = refuted_formula(question, answer, signs)
                found[question].append(read(shipped, answer.proof, formula))
    return found


@pytest.fixture(scope="module")
def completions(shipped: Path, verdicts: dict[str, Verdict]) -> dict[str, Proved]:
    """Return the proofs that no pattern is missing, by boundary type."""
    return {
        letter: read(
            shipped,
            completeness_file(letter),
            completeness_formula(letter, instances_bounded_by(letter, verdicts.values())),
        )
        for letter in BOUNDARY_TYPES
    }


# The files.


def test_proofs_are_those_that_are_named(
    shipped: Path, refutations: dict[str, list[Proved]], completions: dict[str, Proved]
) -> None:
    named = [proved.path for proofs in refutations.values() for proved in proofs]
    named += [proved.path for proved in completions.values()]
    stems = [f"proofs/{path.stem}" for path in map(Path, named)]
    files = [f"proofs/{path.name}" for path in (shipped / "proofs").iterdir()]
    assert sorted(files) == sorted(f"{stem}.lrat" for stem in stems)
    assert Counter(stem.rpartition(".")[2] for stem in stems) == {
        **{question: len(proofs) for question, proofs in refutations.items()},
        **dict.fromkeys(BOUNDARY_TYPES, 1),
    }


# A checker that ignores hints.


class Counting:
    """Unit propagation that counts, for every clause, the literals that are not false."""

    def __init__(self, clauses: Iterable[Clause]) -> None:
        self.clauses: list[Clause] = []
        self.left: list[int] = []
        self.containing: dict[int, list[int]] = {}
        self.true: dict[int, None] = {}
        self.refuted = False
        for clause in clauses:
            self.add(clause)

    def add(self, clause: Clause) -> None:
        """Add a clause for good, with what follows from it by unit propagation."""
        literals = tuple(dict.fromkeys(clause))
        number = len(self.clauses)
        self.clauses.append(literals)
        for literal in literals:
            self.containing.setdefault(literal, []).append(number)
        open_literals = [literal for literal in literals if -literal not in self.true]
        self.left.append(len(open_literals))
        if not open_literals or (len(open_literals) == 1 and self._propagate(open_literals)):
            self.refuted = True

    def implies(self, clause: Clause) -> bool:
        """Does unit propagation lead to a conflict if all literals of the clause are false?"""
        before = len(self.true)
        conflict = self.refuted or self._propagate([-literal for literal in clause])
        while len(self.true) > before:
            literal, _ = self.true.popitem()
            for number in self.containing.get(-literal, ()):
                self.left[number] += 1
        return conflict

    def _propagate(self, pending: list[int]) -> bool:
        """Make the literals true, and all that follow; is a clause false then?"""
        conflict = False
        while pending and not conflict:
            literal = pending.pop()
            if -literal in self.true:
                return True
            if literal in self.true:
                continue
            self.true[literal] = None
            for number in self.containing.get(-literal, ()):
                self.left[number] -= 1
                if self.left[number] == 0:
                    conflict = True
                elif self.left[number] == 1:
                    pending += [x for x in self.clauses[number] if -x not in self.true]
        return conflict


def first_failure(formula: Iterable[Clause], lemmas: Iterable[Clause]) -> int | None:
    """Return the index of the first lemma that does not follow, or None if all do."""
    propagation = Counting(formula)
    for index, lemma in enumerate(lemmas):
        if not propagation.implies(lemma):
            return index
        propagation.add(lemma)
    return None


@every_question
def test_refutations_need_no_hints(question: str, refutations: dict[str, list[Proved]]) -> None:
    assert refutations[question]
    for proved in refutations[question]:
        assert first_failure(proved.formula, proved.lemmas) is None


@every_boundary
def test_completeness_needs_no_hints(letter: str, completions: dict[str, Proved]) -> None:
    assert first_failure(completions[letter].formula, completions[letter].lemmas) is None


# The verified checker.


def drup_accepts(formula: Iterable[Clause], lemmas: Iterable[Clause]) -> bool:
    import drup  # noqa: PLC0415

    return bool(drup.check_proof(formula, lemmas).outcome == drup.Outcome.VALID)


@needs_drup
def test_drup_accepts_refutations(refutations: dict[str, list[Proved]]) -> None:
    """These before the whole formula; all before their cores in test_second_opinions.py."""
    for proved in refutations["realizable"]:
        assert drup_accepts(proved.formula, proved.lemmas), proved.path


@needs_drup
@pytest.mark.parametrize("letter", "ab")
def test_drup_accepts_completeness(letter: str, completions: dict[str, Proved]) -> None:
    """Its propagation is naive, so it gets that part of the formula that the hints name."""
    assert drup_accepts(completions[letter].core, completions[letter].lemmas)


# Both can fail.


def satisfiable(formula: Sequence[Clause]) -> bool:
    with Solver("glucose4", bootstrap_with=formula) as solver:
        return bool(solver.solve())


@needs_drup
def test_proofs_of_satisfiable_formulas_are_rejected(refutations: dict[str, list[Proved]]) -> None:
    """Of the part that the hints name, one clause is left out."""
    for proofs in refutations.values():
        for proved in proofs:
            core = proved.core
            fewer = next(
                weaker
                for k in range(len(core))
                if satisfiable(weaker := [*core[:k], *core[k + 1 :]])
            )
            assert first_failure(fewer, proved.lemmas) is not None
            assert not drup_accepts(fewer, proved.lemmas)


@needs_drup
@pytest.mark.slow
def test_spoiled_proofs_are_rejected(refutations: dict[str, list[Proved]]) -> None:
    """Of a proof remains the last lemma alone; or one lemma is left out, or a literal negated.

    The latter may do no harm. What follows by propagation drup must accept; it may accept more,
    as it knows resolution asymmetric tautologies.
    """
    rejected = Counter[str]()
    for proofs in refutations.values():
        for proved in proofs:
            *lemmas, last = proved.lemmas
            for k, lemma in enumerate(lemmas):
                before, after = lemmas[:k], [*lemmas[k + 1 :], last]
                spoiled = {
                    "the last lemma": [last],
                    "without a lemma": [*before, *after],
                    "with a literal negated": [*before, (-lemma[0], *lemma[1:]), *after],
                }
                for how, rest in spoiled.items():
                    follows = first_failure(proved.core, rest) is None
                    accepted = drup_accepts(proved.core, rest)
                    assert accepted or not follows
                    assert not (accepted and how == "the last lemma")
                    rejected[how] += not accepted
    assert min(rejected.values()) > 0
