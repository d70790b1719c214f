"""The kernel is asked about a forgery; what it accepts has to be true by other means.

Truth is established without the code that accepted it. Triangulations are judged by :mod:`balls`,
points by :mod:`planes` and :mod:`bounds`. A no has to be the shipped answer for the same
tetrahedra, up to symmetry, and a list has to contain the shipped one. Their proofs have to pass
:mod:`rup`, and the clauses that they use have to be among those of :mod:`formulas`.
"""

import json
from collections.abc import Iterable
from dataclasses import dataclass
from fractions import Fraction
from functools import lru_cache
from hashlib import sha256
from pathlib import Path
from typing import Any, TypeAlias

from certify.kernel import check, refutation
from certify.kernel.certificate import No, read_certificate
from certify.kernel.check import Tetrahedra, Verdict
from certify.kernel.evidence import Evidence, Malformed, completeness_file
from certify.kernel.hexahedron import BOUNDARY_TYPES
from certify.kernel.refutation import NotRefuted
from certify.kernel.triangulation import orientation
from certify.opinions import formulas
from certify.opinions.attack.corpus import Corpus, ForgedList, Forgery, Record
from certify.opinions.balls import ball_fault, coherent_orientation, instances
from certify.opinions.bounds import jacobian_fault
from certify.opinions.planes import convexity_fault, realization_fault
from certify.opinions.rup import proof_fault

Points: TypeAlias = tuple[tuple[Fraction, ...], ...]

OUTCOMES = ("refused", "broken off", "true", "false")
"""What becomes of a forgery: it is refused, or its check breaks off, or what is accepted of it is
true, or is not."""


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
        """Return what becomes of a forgery, and why it is false or the check breaks off."""
        if isinstance(forgery, ForgedList):
            return self._list(forgery)
        return self._certificate(forgery)

    def _certificate(self, forgery: Forgery) -> tuple[str, str]:
        evidence = _Memory(Path(), content=forgery.proofs)
        try:
            certificate = read_certificate(forgery.pattern, forgery.certificate)
            verdict = check.check_certificate(certificate, evidence)
        except (Malformed, check.Rejected):
            return "refused", ""
        except Exception as error:  # where its check breaks off the kernel accepts nothing
            return "broken off", ascii(error)
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
        except (Malformed, NotRefuted):
            return "refused", ""
        except Exception as error:  # as above
            return "broken off", ascii(error)
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


def _refuted(question: str, verdict: Verdict) -> tuple[tuple[int, ...], ...]:
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

    if any(word in content for word in (b"true", b"false", b"null")):
        raise ValueError("a value is no string, number, list or object")
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
        if set(signs.values()) - {-1, 0, 1}:
            raise ValueError("a sign is none")
        clauses.add(formulas.excluded(signs, inequalities)[1])
    return frozenset(clauses)
