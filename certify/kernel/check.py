"""One certificate -> a verdict; the certificates of all patterns -> is their list complete?"""

from collections.abc import Iterable
from dataclasses import dataclass, field
from functools import lru_cache
from pathlib import Path
from typing import TypeAlias

from certify.kernel.certificate import Answer, Certificate, No, Yes, read_certificate
from certify.kernel.chirotope import Chirotope, Point, chirotope
from certify.kernel.completeness import listed, triangulation_formula
from certify.kernel.embedding import NotRealized, require_convex_position, require_realization
from certify.kernel.evidence import (
    Evidence,
    Malformed,
    certificate_file,
    completeness_file,
    proof_file,
)
from certify.kernel.hexahedron import BOUNDARY_TYPES, Simplex, boundary_letter
from certify.kernel.jacobian import require_positive_jacobian
from certify.kernel.orientations import Clause, convex_formula, realization_formula
from certify.kernel.refutation import NotRefuted, excluded_signs, replay
from certify.kernel.triangulation import (
    NotATriangulation,
    boundary_diagonals,
    orbit,
    orientation,
    shelling,
)
from certify.kernel.validity import valid_formula

Tetrahedra: TypeAlias = tuple[Simplex, ...]


@dataclass(frozen=True)
class Verdict:
    """What one certificate proves; ``fault`` says why it was rejected, and is None if it was not.

    certificate: what was read, None if the file is no certificate; boundary: the letter of its
    type; instances: its class, each a sorted tuple of tetrahedra, empty unless the tetrahedra were
    accepted; answers: question -> "yes", "no" or "open" as accepted, or "rejected"; files: path
    below the root -> SHA-256, of all that was read.
    """

    pattern: str
    fault: str | None = None
    certificate: Certificate | None = field(default=None, repr=False)
    boundary: str = ""
    instances: frozenset[Tetrahedra] = field(default=frozenset(), repr=False)
    answers: dict[str, str] = field(default_factory=dict)
    files: dict[str, str] = field(default_factory=dict, repr=False)

    @property
    def size(self) -> int:
        """The number of tetrahedra of the pattern."""
        return int(self.pattern.partition("_")[0])

    def rests_on(self, question: str) -> tuple[str, ...]:
        """Return the files below the root on which the accepted answer to a question rests."""
        if self.answers.get(question) not in ("yes", "no"):
            raise ValueError(f"no answer to {question!a} was accepted")
        proof = (proof_file(self.pattern, question),) if self.answers[question] == "no" else ()
        return (certificate_file(self.pattern), *proof)


@dataclass(frozen=True)
class Completeness:
    """That no triangulation with the representative boundary of a type is missing from a list.

    listed: all triangulations with that boundary; fault: why this is not shown, None if it is;
    files: path below the root -> SHA-256, of the proof.
    """

    boundary: str
    listed: frozenset[Tetrahedra]
    fault: str | None
    files: dict[str, str] = field(default_factory=dict)


FORMULAS = {
    "realizable": realization_formula,
    "convex": convex_formula,
    "valid": valid_formula,
}
"""Question -> the clauses that placements which would make the answer yes satisfy."""


class Rejected(ValueError):
    """The certificate does not prove what it claims; the message says where it fails."""


def check_pattern(root: Path, pattern: str) -> Verdict:
    """Check the certificate of one pattern below ``root``; every failure becomes a verdict."""
    evidence = Evidence(root)
    try:
        certificate = read_certificate(pattern, evidence.certificate(pattern))
        return check_certificate(certificate, evidence)
    except (Malformed, Rejected) as error:
        reason = str(error)
    except Exception as error:  # whatever makes the check break off is not accepted
        reason = ascii(error)
    return Verdict(pattern, fault=f"{certificate_file(pattern)}: {reason}", files=evidence.files)


def check_certificate(certificate: Certificate, evidence: Evidence) -> Verdict:
    """Decide everything that a certificate claims; raise Rejected if its tetrahedra are wrong.

    Each answer is decided by itself: a wrong one spoils the certificate, but no other answer.
    """
    tetrahedra = certificate.tetrahedra
    try:
        letter = boundary_letter(boundary_diagonals(tetrahedra))
        shelling(tetrahedra)
    except NotATriangulation as error:
        raise Rejected(f"tetrahedra: {error}") from None
    instances = orbit(tetrahedra)
    claims = {
        "number of tetrahedra": (certificate.pattern.partition("_")[0], str(len(tetrahedra))),
        "boundary": (certificate.boundary, letter),
        "instances": (certificate.instances, len(instances)),
    }
    for claim, (stated, found) in claims.items():
        if stated != found:
            raise Rejected(f"{claim}: stated {stated}, but it is {found}")
    signs = orientation(tetrahedra)
    answers, faults = {}, []
    for question, answer in certificate.answers.items():
        try:
            answers[question] = check_answer(question, answer, signs, evidence)
        except (Malformed, NotRealized, NotRefuted) as error:
            answers[question] = "rejected"
            faults.append(f"{question}: {error}")
    fault = f"{certificate_file(certificate.pattern)}: {'; '.join(faults)}" if faults else None
    return Verdict(
        certificate.pattern, fault, certificate, letter, instances, answers, evidence.files
    )


def check_answer(
    question: str, answer: Answer, signs: dict[Simplex, int], evidence: Evidence
) -> str:
    """Return the accepted answer, or raise NotRealized, NotRefuted or Malformed."""
    if isinstance(answer, Yes):
        require_realization(signs, _chirotope(answer.points))
        if question == "convex":
            require_convex_position(_chirotope(answer.points))
        if question == "valid":
            require_positive_jacobian(answer.points)
        return "yes"
    if isinstance(answer, No):
        proof = evidence.proof(answer.proof, answer.digest)
        replay(refuted_formula(question, answer, signs), proof)
        return "no"
    return "open"


def refuted_formula(question: str, answer: No, signs: dict[Simplex, int]) -> tuple[Clause, ...]:
    """Return the clauses that the answer's proof refutes: the kernel's, then the polynomials'."""
    return (*FORMULAS[question](signs), *map(excluded_signs, answer.final_polynomials))


def check_completeness(root: Path, letter: str, verdicts: Iterable[Verdict]) -> Completeness:
    """Replay the proof that no triangulation with this boundary is missing from the verdicts."""
    evidence = Evidence(root)
    known = instances_bounded_by(letter, verdicts)
    name = completeness_file(letter)
    try:
        replay(completeness_formula(letter, known), evidence.proof(name))
        return Completeness(letter, frozenset(known), None, evidence.files)
    except (Malformed, NotRefuted) as error:
        reason = str(error)
    except Exception as error:  # as above
        reason = ascii(error)
    return Completeness(letter, frozenset(), f"{name}: {reason}", evidence.files)


def instances_bounded_by(letter: str, verdicts: Iterable[Verdict]) -> list[Tetrahedra]:
    """Return the accepted triangulations whose boundary is the type's representative, sorted.

    Only those of its letter can have it: they alone are looked at, to save time.
    """
    return sorted(
        instance
        for verdict in verdicts
        if verdict.boundary == letter
        for instance in verdict.instances
        if boundary_diagonals(instance) == BOUNDARY_TYPES[letter]
    )


def completeness_formula(letter: str, known: Iterable[Tetrahedra]) -> tuple[Clause, ...]:
    """Return the clauses of a triangulation, with the representative boundary, not in the list."""
    return (*triangulation_formula(BOUNDARY_TYPES[letter]), *map(listed, known))


@lru_cache(maxsize=4)
def _chirotope(points: tuple[Point, ...]) -> Chirotope:
    return chirotope(points)
