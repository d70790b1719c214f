"""Forgeries thrown at the kernel; what it accepts has to be true by other means.

Each forgery ends in one of three ways. The kernel refuses it; or it accepts something that is true;
or it accepts something that is false, and then the kernel is wrong. Truth is established without
the code that accepted it. Triangulations are judged by :mod:`balls`, points by :mod:`planes` and
:mod:`bounds`. A no has to be the shipped answer for the same tetrahedra, up to symmetry, and a list
has to contain the shipped one. Their proofs have to pass :func:`proof_fault`, which ignores hints
and compares the clauses with those of :mod:`formulas`.
"""

import json
from collections import Counter, defaultdict
from collections.abc import Callable, Collection, Iterable, Iterator, Sequence
from concurrent.futures import ProcessPoolExecutor
from concurrent.futures.process import BrokenProcessPool
from contextlib import ExitStack, contextmanager
from dataclasses import dataclass
from fractions import Fraction
from functools import lru_cache, partial
from hashlib import sha256
from pathlib import Path
from random import Random
from signal import SIG_IGN, SIGINT, signal
from typing import Any, TypeAlias
from unittest.mock import patch

from certify.kernel import check, refutation
from certify.kernel.certificate import No, read_certificate
from certify.kernel.check import Tetrahedra, Verdict
from certify.kernel.completeness import triangulation_formula
from certify.kernel.evidence import Evidence, Malformed, completeness_file
from certify.kernel.hexahedron import BOUNDARY_TYPES
from certify.kernel.orientations import Clause
from certify.kernel.triangulation import orientation
from certify.opinions import formulas
from certify.opinions.balls import ball_fault, coherent_orientation, instances
from certify.opinions.bounds import jacobian_fault
from certify.opinions.forgeries import KINDS, Corpus, ForgedList, Forgery, Record, read_corpus
from certify.opinions.planes import convexity_fault, realization_fault
from certify.run import Report, run

CHUNK = 100
OUTCOMES = ("refused", "true", "false")
"""What becomes of a forgery: it is refused, or what is accepted of it is true, or is not."""

SCHEDULE: tuple[str, ...] = tuple(
    kind for turn in range(4) for kind in KINDS if turn == 0 or "completeness" not in kind
)
"""The kinds in turn; the proofs of completeness are long, and come less often."""

Points: TypeAlias = tuple[tuple[Fraction, ...], ...]


class NotAccepted(ValueError):
    """What ships is not accepted, so that nothing can be measured by it."""


@dataclass(frozen=True)
class FalseAcceptance:
    """A forgery that the kernel accepted, and why what it accepted is false."""

    number: int
    kind: str
    reason: str
    forgery: Forgery | ForgedList


@dataclass(frozen=True)
class Attack:
    """How many forgeries of each kind ended how, and those that the kernel should have refused."""

    counts: dict[str, Counter[str]]
    false: tuple[FalseAcceptance, ...]

    @property
    def tried(self) -> int:
        """The number of forgeries."""
        return sum(counter.total() for counter in self.counts.values())


def attack(
    root: Path, seed: int, count: int, jobs: int = 1, report: Report | None = None
) -> Attack:
    """Try forgeries 0, 1, ..., count - 1 of a seed; the outcome does not depend on ``jobs``.

    Raises:
        NotAccepted: What ships below the root is not accepted.
        ChildProcessError: One of the processes was killed.
    """
    _judge.cache_clear()
    _judge(root)
    counts: dict[str, Counter[str]] = {kind: Counter() for kind in KINDS}
    false: list[FalseAcceptance] = []
    chunks = [range(start, min(start + CHUNK, count)) for start in range(0, count, CHUNK)]
    done = 0
    try:
        with _mapping(min(jobs, len(chunks))) as mapped:
            for found, wrong in mapped(partial(_try, root, seed), chunks):
                for (kind, outcome), number in found.items():
                    counts[kind][outcome] += number
                false += wrong
                done += found.total()
                if report:
                    report("forging", done, count)
    except BrokenProcessPool:
        raise ChildProcessError("a process that tries forgeries was killed") from None
    return Attack(counts, tuple(false))


@contextmanager
def _mapping(jobs: int) -> Iterator[Callable[..., Iterable[Any]]]:
    """Give the built-in ``map``, or that of a pool of processes."""
    if jobs <= 1:
        yield map
        return
    with ProcessPoolExecutor(jobs, initializer=signal, initargs=(SIGINT, SIG_IGN)) as pool:
        yield pool.map


def forge(corpus: Corpus, seed: int, number: int) -> tuple[str, Forgery | ForgedList]:
    """Return the kind of a forgery, and the forgery."""
    kind = SCHEDULE[number % len(SCHEDULE)]
    return kind, KINDS[kind](Random(f"{seed}/{number}"), corpus)


def _try(
    root: Path, seed: int, numbers: range
) -> tuple[Counter[tuple[str, str]], list[FalseAcceptance]]:
    judge = _judge(root)
    found: Counter[tuple[str, str]] = Counter()
    false = []
    with _formulas_kept():
        for number in numbers:
            kind, forgery = forge(judge.corpus, seed, number)
            outcome, reason = judge.outcome(forgery)
            found[kind, outcome] += 1
            if outcome == "false":
                false.append(FalseAcceptance(number, kind, reason, forgery))
    return found, false


@contextmanager
def _formulas_kept() -> Iterator[None]:
    """Let the kernel write each formula once, not once for each forgery. Verdicts are not kept."""

    def kept(formula: Callable[[dict[Any, int]], Any]) -> Callable[[dict[Any, int]], Any]:
        write = lru_cache(maxsize=64)(lambda items: formula(dict(items)))
        return lambda signs: write(tuple(signs.items()))

    with ExitStack() as stack:
        formulas = {question: kept(formula) for question, formula in check.FORMULAS.items()}
        stack.enter_context(patch.dict(check.FORMULAS, formulas))
        once = lru_cache(triangulation_formula)
        stack.enter_context(patch.object(check, "triangulation_formula", once))
        yield


@lru_cache(maxsize=1)
def _judge(root: Path) -> "Judge":
    outcome = run(root)
    if not outcome.ok:
        raise NotAccepted(next(iter(outcome.faults), "a theorem is not shown"))
    return Judge(read_corpus(outcome, Evidence(root)))


@dataclass
class _Memory(Evidence):
    """Evidence that is not in files: path -> bytes."""

    content: dict[str, bytes] | None = None

    def _read(self, name: str, limit: int) -> bytes:
        content = (self.content or {}).get(name)
        if content is None or len(content) > limit:
            raise Malformed(f"{name} is missing, or too large")
        self.files[name] = sha256(content).hexdigest()
        return content


class Judge:
    """Asks the kernel, and finds out whether what it accepts is true."""

    def __init__(self, corpus: Corpus) -> None:
        self.corpus = corpus
        self.shipped: dict[Tetrahedra, Record] = {}
        """Least instance of a class -> the certificate that ships for it."""
        for name in corpus.certificates:
            record = corpus.record(name)
            self.shipped[min(_class_of(_tetrahedra(record)))] = record

    def outcome(self, forgery: Forgery | ForgedList) -> tuple[str, str]:
        """Return what becomes of a forgery, and why what is accepted is false."""
        if isinstance(forgery, ForgedList):
            return self._list(forgery)
        return self._certificate(forgery)

    def _certificate(self, forgery: Forgery) -> tuple[str, str]:
        evidence = _Memory(Path(), content=forgery.proofs)
        try:
            certificate = read_certificate(forgery.pattern, forgery.certificate)
            verdict = check.check_certificate(certificate, evidence)
        except Exception:  # where its check breaks off the kernel accepts nothing
            return "refused", ""
        try:
            fault = self._fault(forgery, verdict)
        except (ValueError, KeyError, TypeError, AttributeError) as error:
            fault = f"the certificate cannot be read: {error!r}"
        if fault:
            return "false", fault
        return ("true" if verdict.fault is None else "refused"), ""

    def _list(self, forgery: ForgedList) -> tuple[str, str]:
        name = completeness_file(forgery.letter)
        formula = check.completeness_formula(forgery.letter, forgery.known)
        try:
            text = _Memory(Path(), content={name: forgery.proof}).proof(name)
            refutation.replay(formula, text)
        except Exception:  # as above
            return "refused", ""
        if not set(self.corpus.known[forgery.letter]) <= set(forgery.known):
            return "false", "a triangulation is missing from the list"
        again = _clauses_of_list(forgery.letter, forgery.known)
        fault = proof_fault(formula, again, text)
        return ("false", fault) if fault else ("true", "")

    def _fault(self, forgery: Forgery, verdict: Verdict) -> str | None:
        """Return what is false of all that was accepted: the tetrahedra, and some answers."""
        record = _strict(forgery.certificate)
        tetrahedra = _tetrahedra(record)
        if fault := _ball_fault(tetrahedra):
            return fault
        shipped = self.shipped.get(min(_class_of(tetrahedra)))
        if shipped is None:
            return "there is no such pattern among the 174"
        facts = {
            "pattern": forgery.pattern,
            "boundary": shipped["boundary"],
            "instances": len(_class_of(tetrahedra)),
        }
        wrong = [key for key, fact in facts.items() if record[key] != fact]
        if forgery.pattern.partition("_")[0] != str(len(tetrahedra)):
            wrong.append("number of tetrahedra")
        if wrong:
            return f"not as stated: {', '.join(wrong)}"
        for question, accepted in verdict.answers.items():
            fault = _answer_fault(question, accepted, tetrahedra, record, forgery, verdict)
            if {accepted, shipped[question]["answer"]} == {"yes", "no"}:
                fault = f"the shipped answer is not {accepted}"
            if fault:
                return f"{question}: {fault}"
        return None


def _answer_fault(
    question: str,
    accepted: str,
    tetrahedra: Tetrahedra,
    record: Record,
    forgery: Forgery,
    verdict: Verdict,
) -> str | None:
    """Return what is false of an answer if it was accepted, or None."""
    answer = record[question]
    if accepted not in ("rejected", answer["answer"]):
        return f"{accepted} is accepted, but not stated"
    if accepted == "yes":
        points = tuple(tuple(map(_coordinate, point)) for point in answer["points"])
        return _points_fault(question, tetrahedra, points)
    if accepted == "no":
        content = forgery.proofs[answer["proof"]]
        if sha256(content).hexdigest() != answer["sha256"]:
            return "the SHA-256 is not that of the proof"
        again = _clauses_of(question, tetrahedra) | _excluded(answer.get("final_polynomials", []))
        return proof_fault(_refuted(question, verdict), again, content.decode())
    return None


def _refuted(question: str, verdict: Verdict) -> tuple[Clause, ...]:
    """Return the formula that the kernel refuted, whose numbering the proof uses."""
    assert verdict.certificate is not None
    answer = verdict.certificate.answers[question]
    assert isinstance(answer, No)
    return check.refuted_formula(question, answer, orientation(verdict.certificate.tetrahedra))


# Reading


def _strict(content: bytes) -> Record:
    """Return a certificate if it has the right keys, each once, and no number but integers."""

    def unique(pairs: list[tuple[str, Any]]) -> Record:
        if len(dict(pairs)) < len(pairs):
            raise ValueError("a key occurs twice")
        return dict(pairs)

    def no_number(literal: str) -> Any:
        raise ValueError(f"{literal} is no integer")

    record: Record = json.loads(
        content.decode(),
        object_pairs_hook=unique,
        parse_float=no_number,
        parse_constant=no_number,
    )
    if record.keys() != _HEADS | _WRITE.keys() or record["format"] != "certify-pattern/1":
        raise ValueError("it has other keys, or another format")
    for question in _WRITE:
        keys = record[question].keys() - {"final_polynomials"}
        if keys != _KEYS[record[question]["answer"]]:
            raise ValueError("an answer has other keys")
    return record


_HEADS = {"format", "pattern", "boundary", "instances", "tetrahedra"}
_KEYS = {
    "yes": {"answer", "points"},
    "no": {"answer", "proof", "sha256"},
    "open": {"answer"},
}


def _tetrahedra(record: Record) -> Tetrahedra:
    tetrahedra = tuple(map(tuple, record["tetrahedra"]))
    if any(type(v) is not int or not 1 <= v <= 8 for t in tetrahedra for v in t):
        raise ValueError("a vertex is not one of 1..8")
    if any(len(t) != 4 or list(t) != sorted(set(t)) for t in tetrahedra):
        raise ValueError("a tetrahedron is not an increasing quadruple")
    return tetrahedra


def _coordinate(value: Any) -> Fraction:
    if type(value) is int:
        return Fraction(value)
    numerator, denominator = value.split("/")
    return Fraction(int(numerator), int(denominator))


# Truth

_ball_fault = lru_cache(maxsize=4096)(ball_fault)


@lru_cache(maxsize=4096)
def _class_of(tetrahedra: Tetrahedra) -> frozenset[Tetrahedra]:
    return frozenset(instances(tetrahedra))


@lru_cache(maxsize=64)
def _points_fault(question: str, tetrahedra: Tetrahedra, points: Points) -> str | None:
    """Return why points do not answer a question with yes, or None if they do."""
    fault = realization_fault(tetrahedra, points)
    if fault is None and question == "convex":
        return convexity_fault(points)
    if fault is None and question == "valid":
        return jacobian_fault(points)
    return fault


_WRITE = {
    "realizable": formulas.realizable,
    "convex": formulas.convex,
    "valid": formulas.valid,
}


@lru_cache(maxsize=64)
def _clauses_of(question: str, tetrahedra: Tetrahedra) -> frozenset[formulas.Clause]:
    """Return the formula for a question as it was written a second time."""
    return frozenset(clause for _, clause in _WRITE[question](coherent_orientation(tetrahedra)))


@lru_cache(maxsize=16)
def _clauses_of_list(letter: str, known: tuple[Tetrahedra, ...]) -> frozenset[formulas.Clause]:
    again = formulas.completeness(BOUNDARY_TYPES[letter], known)
    return frozenset(clause for _, clause in again)


def _excluded(polynomials: Iterable[Record]) -> frozenset[formulas.Clause]:
    """Return the clauses of final polynomials; raise ValueError if one of them is not absurd."""
    clauses = set()
    for polynomial in polynomials:
        signs = {tuple(map(int, key)): sign for key, sign in polynomial["signs"].items()}
        inequalities = [(times, tuple(six)) for times, six in polynomial["inequalities"]]
        if any(times < 1 for times, _ in inequalities) or set(signs.values()) - {-1, 0, 1}:
            raise ValueError("a multiplier is not positive, or a sign is none")
        clauses.add(formulas.excluded(signs, inequalities)[1])
    return frozenset(clauses)


def proof_fault(
    formula: Sequence[Clause], again: Collection[formulas.Clause], proof: str
) -> str | None:
    """Return which lemma does not follow by unit propagation, or None if the proof is one.

    Of the formula only the clauses that occur as hints are used, and each of them must occur in the
    formula as written ``again``; the order of the hints is not used.
    """
    steps = [words for line in proof.splitlines() if (words := line.split())[1] != "d"]
    used = {int(word) for words in steps for word in words[words.index("0") + 1 : -1]}
    propagation = _Propagation()
    for number in sorted(number for number in used if number <= len(formula)):
        if frozenset(formula[number - 1]) not in again:
            return f"clause {number} does not belong to the formula"
        propagation.add(formula[number - 1])
    for words in steps:
        lemma = tuple(map(int, words[1 : words.index("0")]))
        if not propagation.refutes([-literal for literal in lemma]):
            return f"lemma {words[0]} does not follow by unit propagation"
        if not lemma:
            return None
        propagation.add(lemma)
    return "the proof does not reach the empty clause"


class _Propagation:
    """Unit propagation to the end, with two watched literals in each clause."""

    def __init__(self) -> None:
        self.true: set[int] = set()
        """The literals that the clauses alone make true."""
        self.absurd = False
        self.watching: defaultdict[int, list[list[int]]] = defaultdict(list)

    def add(self, clause: Clause) -> None:
        """Add a clause, and propagate if it is a unit by now."""
        literals = set(clause)
        if literals & self.true or any(-literal in literals for literal in literals):
            return
        free = sorted(literal for literal in literals if -literal not in self.true)
        if len(free) > 1:
            self.watching[free[0]].append(free)
            self.watching[free[1]].append(free)
        else:
            self.absurd = self.absurd or not free or self._conflict(self.true, free)

    def refutes(self, assumed: list[int]) -> bool:
        """Do the assumed literals propagate to a contradiction?"""
        return self.absurd or self._conflict(set(self.true), assumed)

    def _conflict(self, true: set[int], pending: list[int]) -> bool:
        pending = list(pending)
        while pending:
            literal = pending.pop()
            if -literal in true:
                return True
            if literal not in true:
                true.add(literal)
                self._visit(-literal, true, pending)
        return False

    def _visit(self, false: int, true: set[int], pending: list[int]) -> None:
        """Let every clause that watches a false literal watch another one, or be a unit."""
        kept = []
        for clause in self.watching[false]:
            if clause[0] == false:
                clause[0], clause[1] = clause[1], clause[0]
            for i in range(2, len(clause)):
                if -clause[i] not in true:
                    clause[1], clause[i] = clause[i], clause[1]
                    self.watching[clause[1]].append(clause)
                    break
            else:
                kept.append(clause)
                pending.append(clause[0])
        self.watching[false] = kept


# Keeping


def write_out(folder: Path, found: FalseAcceptance) -> Path:
    """Write a forgery as a root of its own, with what is wrong in ``forgery.json``."""
    place = folder / str(found.number)
    forgery = found.forgery
    note: Record = {"number": found.number, "kind": found.kind, "reason": found.reason}
    if isinstance(forgery, ForgedList):
        files = {completeness_file(forgery.letter): forgery.proof}
        note |= {"boundary": forgery.letter, "listed": forgery.known}
    else:
        files = {f"certificates/{forgery.pattern}.json": forgery.certificate, **forgery.proofs}
        note |= {"pattern": forgery.pattern}
    files["forgery.json"] = json.dumps(note).encode()
    for name, content in files.items():
        (place / name).parent.mkdir(parents=True, exist_ok=True)
        (place / name).write_bytes(content)
    return place
