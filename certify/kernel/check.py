"""One certificate -> a verdict; all certificates -> the theorems they prove together."""

from collections import Counter
from collections.abc import Iterable, Sequence
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
from certify.kernel.embedding import NotRealized, require_convex_position, require_realization
from certify.kernel.hexahedron import Simplex, boundary_letter
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

PATTERN_COUNTS = {5: 1, 6: 5, 7: 5, 8: 7, 9: 13, 10: 20, 11: 35, 12: 30, 13: 28, 14: 19, 15: 11}
"""Number of tetrahedra -> number of patterns that the paper's Table 1 claims."""


def pattern_names() -> tuple[str, ...]:
    """Return the paper's 174 names 5_A .. 15_K, in order; after 11_Z comes 11_AA."""
    alphabet = "ABCDEFGHIJKLMNOPQRSTUVWXYZ"
    suffixes = [*alphabet, *("A" + letter for letter in alphabet)]
    return tuple(f"{size}_{s}" for size, count in PATTERN_COUNTS.items() for s in suffixes[:count])


@dataclass(frozen=True)
class Verdict:
    """What one certificate proves; ``fault`` says why it was rejected, and is None if it was not.

    answers: question -> "yes", "no" or "open"; representative: the least instance of the class.
    """

    pattern: str
    answers: dict[str, str] = field(default_factory=dict)
    representative: tuple[Simplex, ...] = ()
    fault: str | None = None

    @property
    def size(self) -> int:
        """The number of tetrahedra of the pattern."""
        return int(self.pattern.partition("_")[0])


@dataclass(frozen=True)
class Theorem:
    """A statement, and whether the certificates accepted in this run prove it."""

    id: str
    statement: str
    ok: bool


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
        except (NotRealized, NotRefuted) as error:
            raise Rejected(f"{question}: {error}") from None
    return Verdict(certificate.pattern, answers, min(instances))


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
        replay(refuted_formula(question, answer, signs), read_proof(root, answer))
        return "no"
    return "open"


def refuted_formula(question: str, answer: No, signs: dict[Simplex, int]) -> tuple[Clause, ...]:
    """Return the clauses that the answer's proof refutes: the kernel's, then the polynomials'."""
    return (*FORMULAS[question](signs), *map(excluded_signs, answer.final_polynomials))


@lru_cache(maxsize=4)
def _chirotope(points: tuple[Point, ...]) -> Chirotope:
    return chirotope(points)


def count(verdicts: Iterable[Verdict], question: str, answer: str) -> int:
    """Return how many of the verdicts answer the question so."""
    return sum(verdict.answers.get(question) == answer for verdict in verdicts)


def theorems(verdicts: Sequence[Verdict]) -> list[Theorem]:
    """Return what the paper claims of the patterns, each with whether these verdicts prove it."""
    accepted = [verdict for verdict in verdicts if verdict.fault is None]
    sizes = Counter(verdict.size for verdict in accepted)
    classes = len({verdict.representative for verdict in accepted})
    complete = sizes == PATTERN_COUNTS and classes == len(accepted)

    def exactly(question: str, yes: int) -> bool:
        no = len(pattern_names()) - yes
        counts = (count(accepted, question, "yes"), count(accepted, question, "no"))
        return complete and counts == (yes, no)

    return [
        Theorem(
            "patterns",
            "There are 174 pairwise inequivalent triangulations of the hexahedron, with 5 to 15 "
            "tetrahedra, as many of each size as in the paper's Table 1.",
            complete,
        ),
        Theorem(
            "realizable",
            "Exactly 171 of them have a realization; the other 3 have none, in any position.",
            exactly("realizable", 171),
        ),
        Theorem(
            "convex",
            "Exactly 158 of them have a realization in convex position; the other 16 have none, "
            "not even with vertices on the boundary of the hull.",
            exactly("convex", 158),
        ),
    ]
