"""What a claim of the paper is, and how it gets its verdict."""

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from typing import Literal, NamedTuple, TypeAlias

from certify.audit.graphs import Balls, Tetrahedra
from certify.kernel.certificate import PATTERN_NAMES
from certify.kernel.check import Completeness, Verdict
from certify.kernel.cube import triangulates_cube, triangulates_finite_precision_cube
from certify.kernel.theorems import Facts, theorems

Decision: TypeAlias = Literal["confirmed", "corrected", "strengthened", "not decided here"]

DECISIONS: tuple[Decision, ...] = ("confirmed", "corrected", "strengthened", "not decided here")


@dataclass(frozen=True)
class Finding:
    """What became of one statement of the paper.

    claim: the statement, in our words; truth: what is true instead, or more, else empty; evidence:
    the theorems, certificates, proofs and computations that the verdict rests on.
    """

    id: str
    place: str
    claim: str
    verdict: Decision
    truth: str
    evidence: tuple[str, ...]


class Case:
    """What one run has accepted: the facts that claims are tested against."""

    def __init__(self, verdicts: Sequence[Verdict], completeness: Sequence[Completeness]) -> None:
        self.facts = Facts(verdicts, completeness)
        self.proved = {t.id for t in theorems(verdicts, completeness) if t.ok}

    @cached_property
    def tetrahedra(self) -> dict[str, Tetrahedra]:
        """Pattern -> its least instance, in the order of the names."""
        patterns = self.facts.patterns
        return {name: min(patterns[name].instances) for name in PATTERN_NAMES if name in patterns}

    @cached_property
    def cube(self) -> set[str]:
        """The patterns that the vertices of the unit cube realize."""
        return self.facts.where(triangulates_cube)

    @cached_property
    def slivers(self) -> set[str]:
        """The patterns of the cube with slivers on core diagonals."""
        return self.facts.where(triangulates_finite_precision_cube)

    @property
    def not_convex(self) -> set[str]:
        """The patterns that are realizable, but not in convex position."""
        return self.no("convex") & self.yes("realizable")

    @property
    def instances(self) -> list[int]:
        """The sizes of all classes, in increasing order."""
        return self.facts.instances(set(self.facts.patterns))

    def balls(self, names: Iterable[str] = PATTERN_NAMES) -> Balls:
        """Return the patterns, or some of them, with their least instances."""
        return tuple((n, self.tetrahedra[n]) for n in PATTERN_NAMES if n in set(names))

    def all(self, test: Callable[[Tetrahedra], bool]) -> bool:
        """Do all patterns pass a test?"""
        return all(map(test, self.tetrahedra.values()))

    def yes(self, question: str) -> set[str]:
        """Return the patterns for which the answer yes was accepted."""
        return self.facts.answering(question, "yes")

    def no(self, question: str) -> set[str]:
        """Return the patterns for which the answer no was accepted."""
        return self.facts.answering(question, "no")

    def answer(self, pattern: str, question: str) -> str | None:
        """Return the accepted answer of one pattern, None if there is no accepted certificate."""
        verdict = self.facts.patterns.get(pattern)
        return verdict.answers[question] if verdict else None

    def of_size(self, names: Iterable[str], size: int) -> set[str]:
        """Return those of the patterns that have this number of tetrahedra."""
        return {name for name in names if self.facts.patterns[name].size == size}


Predicate: TypeAlias = Callable[[Case], bool]


class Truth(NamedTuple):
    """A statement of ours, and the test that it is true."""

    statement: str
    holds: Predicate


@dataclass(frozen=True)
class Claim:
    """A statement of the paper, and how to decide it.

    holds: the test of the statement, or None where nothing here decides it; theorems and answers
    ("15_K valid"): what must have been accepted in this run before anything is tested; recomputed:
    what the tests compute beyond that; correction: what is true if the statement is not; stronger:
    what is true beyond it. The test of a correction has to contradict the statement.
    """

    id: str
    place: str
    claim: str
    holds: Predicate | None
    theorems: tuple[str, ...] = field(default=(), kw_only=True)
    answers: tuple[str, ...] = field(default=(), kw_only=True)
    recomputed: str = field(default="", kw_only=True)
    correction: Truth | None = field(default=None, kw_only=True)
    stronger: Truth | None = field(default=None, kw_only=True)


def decide(claim: Claim, case: Case) -> Finding:
    """Return the finding about a claim.

    Where something that the claim rests on was not accepted, it is not decided, whatever the tests
    would say; nor is it where neither the statement nor its correction passes its test.
    """
    decision: Decision = "not decided here"
    truth = ""
    if claim.holds and _stands(claim, case):
        if claim.holds(case):
            decision = "confirmed"
            if claim.stronger and claim.stronger.holds(case):
                decision, truth = "strengthened", claim.stronger.statement
        elif claim.correction and claim.correction.holds(case):
            decision, truth = "corrected", claim.correction.statement
    return Finding(claim.id, claim.place, claim.claim, decision, truth, _evidence(claim, case))


def _stands(claim: Claim, case: Case) -> bool:
    """Was everything that the claim rests on accepted?"""
    answers = (case.answer(*answer.split()) for answer in claim.answers)
    return case.proved.issuperset(claim.theorems) and all(a in ("yes", "no") for a in answers)


def _evidence(claim: Claim, case: Case) -> tuple[str, ...]:
    files = []
    for pattern, question in map(str.split, claim.answers):
        files.append(f"certificates/{pattern}.json")
        if case.answer(pattern, question) == "no":
            files.append(f"proofs/{pattern}.{question}.lrat")
    theorem_ids = [f"theorem {name}" for name in claim.theorems]
    recomputed = [claim.recomputed] if claim.recomputed else []
    return tuple(dict.fromkeys((*theorem_ids, *files, *recomputed)))
