"""What forgeries are made from, and what they are: drafts that become certificates and proofs.

Where a proof is changed, the certificate states its new SHA-256, so that the hash cannot be what
tells. Answers that a forgery is not about are left open: nothing else in it can be what is refused.
"""

import json
from collections.abc import Callable
from dataclasses import dataclass, field
from hashlib import sha256
from random import Random
from typing import Any, TypeAlias

from certify.kernel.certificate import PATTERN_NAMES, QUESTIONS
from certify.kernel.check import Tetrahedra
from certify.kernel.evidence import Evidence, completeness_file, proof_file
from certify.kernel.hexahedron import BOUNDARY_TYPES
from certify.kernel.theorems import Outcome

Record: TypeAlias = dict[str, Any]


@dataclass(frozen=True)
class Forgery:
    """A certificate for a pattern, with the proofs that it names: path below the root -> bytes."""

    pattern: str
    certificate: bytes
    proofs: dict[str, bytes]


@dataclass(frozen=True)
class ForgedList:
    """A proof that no triangulation with a type of boundary is missing from a list."""

    letter: str
    known: tuple[Tetrahedra, ...]
    proof: bytes


@dataclass(frozen=True, eq=False)
class Corpus:
    """What forgeries are made from: all that ships, with all of it accepted."""

    certificates: dict[str, bytes]
    proofs: dict[str, str]
    known: dict[str, tuple[Tetrahedra, ...]]
    """Type of boundary -> all triangulations with the representative boundary."""
    answers: dict[str, list[tuple[str, str]]]
    """Answer -> the (pattern, question) that have it; under "polynomials" and "lemmas" those noes
    whose evidence has some."""

    def record(self, pattern: str) -> Record:
        """Return a pattern's certificate as JSON gives it, to be changed at will."""
        record: Record = json.loads(self.certificates[pattern])
        return record


def read_corpus(outcome: Outcome, evidence: Evidence) -> Corpus:
    """Return the corpus of a root that was accepted."""
    certificates = {name: evidence.certificate(name) for name in PATTERN_NAMES}
    answers: dict[str, list[tuple[str, str]]] = {
        answer: [] for answer in ("yes", "no", "open", "polynomials", "lemmas")
    }
    proofs = {file: evidence.proof(file) for file in map(completeness_file, BOUNDARY_TYPES)}
    for name, content in certificates.items():
        record = json.loads(content)
        for question in QUESTIONS:
            answer = record[question]
            answers[answer["answer"]].append((name, question))
            if answer.get("final_polynomials"):
                answers["polynomials"].append((name, question))
            if "proof" in answer:
                proofs[answer["proof"]] = text = evidence.proof(answer["proof"])
                if len(text.splitlines()) > 1:
                    answers["lemmas"].append((name, question))
    return Corpus(
        certificates,
        proofs,
        {result.boundary: tuple(sorted(result.listed)) for result in outcome.completeness},
        answers,
    )


def size(pattern: str) -> str:
    """Return the number of tetrahedra, as the name has it."""
    return pattern.partition("_")[0]


Mutator: TypeAlias = Callable[[Random, Corpus], Forgery | ForgedList]


@dataclass
class Draft:
    """A certificate in the making, with the text of the proof of each no."""

    record: Record
    proofs: dict[str, str] = field(default_factory=dict)

    @classmethod
    def of(cls, corpus: Corpus, name: str, *questions: str) -> "Draft":
        """Return a shipped certificate, with the answers to other questions left open."""
        left_open: Record = {q: {"answer": "open"} for q in QUESTIONS if q not in questions}
        record = corpus.record(name) | left_open
        proofs = {q: corpus.proofs[record[q]["proof"]] for q in questions if "proof" in record[q]}
        return cls(record, proofs)

    def rename(self, name: str) -> None:
        """Let the certificate be that of another pattern."""
        self.record["pattern"] = name
        for question in self.proofs:
            self.record[question]["proof"] = proof_file(name, question)

    def answer_no(self, question: str, proof: str) -> None:
        """Answer a question with no, by the text of a proof."""
        self.proofs[question] = proof
        path = proof_file(self.record["pattern"], question)
        self.record[question] = {"answer": "no", "proof": path}

    def finished(self) -> Forgery:
        """Return the certificate with the hash of each proof."""
        proofs = {}
        for question, proof in self.proofs.items():
            content = proof.encode()
            self.record[question]["sha256"] = sha256(content).hexdigest()
            proofs[self.record[question]["proof"]] = content
        return Forgery(self.record["pattern"], json.dumps(self.record).encode(), proofs)
