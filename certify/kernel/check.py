"""One certificate -> a verdict; the certificates of all patterns -> is their list complete?"""

from collections.abc import Iterable
from dataclasses import dataclass, field
from functools import lru_cache
from pathlib import Path

from certify.kernel.certificate import (
    Answer,
    Certificate,
    Malformed,
    No,
    Yes,
    read_certificate,
    read_proof,
)
from certify.kernel.chirotope import Chirotope, Point, chirotope
from certify.kernel.completeness import listed, triangulation_formula
from certify.kernel.embedding import NotRealized, require_convex_position, require_realization
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


@dataclass(frozen=True)
class Verdict:
    """What one certificate proves; ``fault`` says why it was rejected, and is None if it was not.

    boundary: the letter of its type; instances: its class, each a sorted tuple of tetrahedra;
    answers: question -> "yes", "no" or "open".
    """

    pattern: str
    fault: str | None = None
    boundary: str = ""
    instances: frozenset[tuple[Simplex, ...]] = frozenset()
    answers: dict[str, str] = field(default_factory=dict)

    @property
    def size(self) -> int:
        """The number of tetrahedra of the pattern."""
        return int(self.pattern.partition("_")[0])


@dataclass(frozen=True)
class Completeness:
    """Whether the accepted patterns are all that have a boundary of this type; if not, why."""

    boundary: str
    fault: str | None = None


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
    try:
        certificate = read_certificate(root / "certificates" / f"{pattern}.json")
        return check_certificate(certificate, root)
    except (Malformed, Rejected) as error:
        return Verdict(pattern, fault=f"certificates/{pattern}.json: {error}")


def check_certificate(certificate: Certificate, root: Path) -> Verdict:
    """Decide everything that a certificate claims, or raise Rejected or Malformed."""
    tetrahedra = certificate.tetrahedra
    try:
        letter = boundary_letter(boundary_diagonals(tetrahedra))
        shelling(tetrahedra)
    except NotATriangulation as error:
        raise Rejected(f"tetrahedra: {error}") from None
    instances = orbit(tetrahedra)
    claims = {
        "pattern": (certificate.pattern.partition("_")[0], str(len(tetrahedra))),
        "boundary": (certificate.boundary, letter),
        "instances": (certificate.instances, len(instances)),
    }
    for claim, (said, true) in claims.items():
        if said != true:
            raise Rejected(f"{claim}: {said} is said, {true} is true")
    signs = orientation(tetrahedra)
    answers = {}
    for question, answer in certificate.answers.items():
        try:
            answers[question] = check_answer(question, answer, signs, root)
        except (Malformed, NotRealized, NotRefuted) as error:
            raise Rejected(f"{question}: {error}") from None
    return Verdict(certificate.pattern, None, letter, instances, answers)


def check_answer(question: str, answer: Answer, signs: dict[Simplex, int], root: Path) -> str:
    """Return the accepted answer, or raise NotRealized, NotRefuted or Malformed."""
    if isinstance(answer, Yes):
        require_realization(signs, _chirotope(answer.points))
        if question == "convex":
            require_convex_position(_chirotope(answer.points))
        if question == "valid":
            require_positive_jacobian(answer.points)
        return "yes"
    if isinstance(answer, No):
        replay(
            refuted_formula(question, answer, signs), read_proof(root, answer.proof, answer.digest)
        )
        return "no"
    return "open"


def refuted_formula(question: str, answer: No, signs: dict[Simplex, int]) -> tuple[Clause, ...]:
    """Return the clauses that the answer's proof refutes: the kernel's, then the polynomials'."""
    return (*FORMULAS[question](signs), *map(excluded_signs, answer.final_polynomials))


def check_completeness(root: Path, letter: str, verdicts: Iterable[Verdict]) -> Completeness:
    """Replay the proof that no triangulation with this boundary is missing from the verdicts."""
    name = completeness_proof(letter)
    try:
        replay(completeness_formula(letter, verdicts), read_proof(root, name))
    except (Malformed, NotRefuted) as error:
        return Completeness(letter, f"{name}: {error}")
    return Completeness(letter)


def completeness_proof(letter: str) -> str:
    """Return the path of the proof below the root."""
    return f"proofs/complete.{letter}.lrat"


def completeness_formula(letter: str, verdicts: Iterable[Verdict]) -> tuple[Clause, ...]:
    """Return the clauses of a triangulation, with the type's boundary, that no verdict is about.

    The accepted instances with exactly this boundary are listed in lexicographic order.
    """
    diagonals = BOUNDARY_TYPES[letter]
    instances = sorted(
        instance
        for verdict in verdicts
        if verdict.boundary == letter
        for instance in verdict.instances
        if boundary_diagonals(instance) == diagonals
    )
    return (*triangulation_formula(diagonals), *map(listed, instances))


@lru_cache(maxsize=4)
def _chirotope(points: tuple[Point, ...]) -> Chirotope:
    return chirotope(points)
