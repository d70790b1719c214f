"""All shipped certificates are accepted, and none that says anything else than they do."""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import replace
from hashlib import sha256
from itertools import product
from math import lcm
from pathlib import Path
from typing import NamedTuple, TypeVar

import numpy as np
import pytest

from certify.kernel.certificate import (
    PATTERN_COUNTS,
    PATTERN_NAMES,
    Answer,
    Certificate,
    No,
    Open,
    Yes,
)
from certify.kernel.check import Rejected, Verdict, check_certificate
from certify.kernel.chirotope import Point
from certify.kernel.evidence import Evidence, certificate_file
from certify.kernel.hexahedron import BOUNDARY_TYPES, Simplex, boundary_letter
from certify.kernel.refutation import FinalPolynomial
from certify.kernel.triangulation import boundary_diagonals, orbit, orientation
from tests.geometry import QUADRUPLES, VERTICES, Placement, exact, is_extreme, realizes
from tests.test_validity import determinants

Points = tuple[Point, ...]
Certificates = dict[str, Certificate]
T = TypeVar("T")

CORNERS_OF_THE_CUBE: Points = exact(product((0, 1), repeat=3))

every_pattern = pytest.mark.parametrize("name", PATTERN_NAMES)


class Refuted(NamedTuple):
    """A shipped refutation."""

    certificate: Certificate
    question: str
    answer: No
    proof: str


@pytest.fixture(scope="module")
def refuted(shipped: Path, certificates: Certificates) -> list[Refuted]:
    """Return all shipped refutations."""
    return [
        Refuted(certificate, question, answer, (shipped / answer.proof).read_text())
        for certificate in certificates.values()
        for question, answer in certificate.answers.items()
        if isinstance(answer, No)
    ]


def answering(certificate: Certificate, question: str, answer: Answer) -> Certificate:
    """Return the certificate with another answer to one question."""
    return replace(certificate, answers=certificate.answers | {question: answer})


def fault(certificate: Certificate, root: Path) -> str:
    """Return why the certificate is rejected."""
    try:
        verdict = check_certificate(certificate, Evidence(root))
    except Rejected as error:
        return str(error)
    if verdict.fault is None:
        return f"nothing is wrong with {verdict.pattern}"
    assert "rejected" in verdict.answers.values()
    return verdict.fault.removeprefix(f"{certificate_file(certificate.pattern)}: ")


def yeses(certificate: Certificate) -> Iterator[tuple[str, Points]]:
    """Yield the questions that are answered by points."""
    for question, answer in certificate.answers.items():
        if isinstance(answer, Yes):
            yield question, answer.points


def placement(points: Points) -> Placement:
    """Return integer points in the same position."""
    scale = lcm(*(x.denominator for point in points for x in point))
    return tuple(tuple(int(x * scale) for x in point) for point in points)


# What is shipped.


def test_there_is_one_certificate_a_pattern(shipped: Path) -> None:
    files = {path.name for path in (shipped / "certificates").iterdir()}
    assert files == {f"{name}.json" for name in PATTERN_NAMES}
    assert len(files) == sum(PATTERN_COUNTS.values()) == 174


@every_pattern
def test_certificate_is_accepted(
    certificates: Certificates, verdicts: dict[str, Verdict], name: str
) -> None:
    certificate, verdict = certificates[name], verdicts[name]
    word = {Yes: "yes", No: "no", Open: "open"}
    assert verdict.fault is None
    assert verdict.pattern == certificate.pattern == name
    assert verdict.boundary == certificate.boundary
    assert len(verdict.instances) == certificate.instances
    assert certificate.tetrahedra in verdict.instances
    assert verdict.size == len(certificate.tetrahedra)
    assert verdict.answers == {q: word[type(a)] for q, a in certificate.answers.items()}


@every_pattern
def test_points_pass_by_other_means_than_the_kernels(certificates: Certificates, name: str) -> None:
    """Solid tetrahedra are intersected, and directions sought in which a vertex is farthest."""
    certificate = certificates[name]
    signs = orientation(certificate.tetrahedra)
    answers = dict(yeses(certificate))
    for points in set(answers.values()):
        assert realizes(placement(points), signs)
    if "convex" in answers:
        assert all(is_extreme(placement(answers["convex"]), vertex) for vertex in VERTICES)


def test_points_can_be_checked_by_hand(certificates: Certificates) -> None:
    """Integers that are at most 10 in absolute value."""
    for certificate in certificates.values():
        for _, points in yeses(certificate):
            assert all(x.denominator == 1 and abs(x) <= 10 for point in points for x in point)


# Spoiled points.


MOVES: dict[str, Callable[[Points], Points]] = {
    "two points coincide": lambda p: (p[1], *p[1:]),
    "two points are exchanged": lambda p: (p[1], p[0], *p[2:]),
    "all points are mirrored": lambda p: tuple((-x, y, z) for x, y, z in p),
    "all points are in a plane": lambda p: tuple((x, y, x - y) for x, y, _ in p),
}
"""Every pattern has a tetrahedron with the edge 12."""


@every_pattern
def test_spoiled_points_are_rejected(shipped: Path, certificates: Certificates, name: str) -> None:
    certificate = certificates[name]
    for question, points in yeses(certificate):
        for move in MOVES.values():
            found = fault(answering(certificate, question, Yes(move(points))), shipped)
            assert found.startswith(f"{question}: tetrahedron ")
            assert found.endswith((" is degenerate", " is inverted"))


@pytest.mark.parametrize("name", ["5_A", "6_A", "6_C", "7_B", "8_C"])
def test_overlapping_tetrahedra_are_rejected(
    shipped: Path, certificates: Certificates, name: str
) -> None:
    """Random points, where all determinants have the right signs and yet solid tetrahedra meet."""
    certificate = certificates[name]
    signs = orientation(certificate.tetrahedra)
    anything = np.random.default_rng(15).integers(0, 20, (100_000, 8, 3))
    right = np.sign(determinants(anything, list(signs))) == list(signs.values())
    overlapping = [
        points
        for rows in anything[right.all(axis=1)][:50].tolist()
        if not realizes(placement(points := exact(rows)), signs)
    ]
    assert overlapping
    for points in overlapping:
        found = fault(answering(certificate, "realizable", Yes(points)), shipped)
        assert found.startswith("realizable: faces ")
        assert found.endswith(" intersect")


def test_points_of_one_question_do_not_answer_the_next(
    shipped: Path, certificates: Certificates
) -> None:
    """Realizations that are not convex or not valid, of the patterns that have no others."""
    expected = {"convex": "vertex ", "valid": "the Jacobian is not "}
    tried = dict.fromkeys(expected, 0)
    for certificate in certificates.values():
        for question, reason in expected.items():
            for _, points in yeses(certificate):
                if isinstance(certificate.answers[question], No):
                    found = fault(answering(certificate, question, Yes(points)), shipped)
                    assert found.startswith(f"{question}: {reason}")
                    tried[question] += 1
    assert tried == {"convex": 13, "valid": 13 + 2 * 15}


# Spoiled refutations.


def drop_last_line(lines: list[str]) -> None:
    del lines[-1]


def drop_first_hint(lines: list[str]) -> None:
    """In the last line, which ends with the conflict."""
    clause, hints = lines[-1].split(" 0 ", 1)
    lines[-1] = f"{clause} 0 {hints.partition(' ')[2]}"


def drop_last_hint(lines: list[str]) -> None:
    *words, _, end = lines[0].split(" ")
    lines[0] = " ".join((*words, end))


def negate_first_literal(lines: list[str]) -> None:
    """Where the proof has but one line, and that no literal, put one."""
    number, literal, *words = lines[0].split(" ")
    negated = ["1", "0"] if literal == "0" else [str(-int(literal))]
    lines[0] = " ".join((number, *negated, *words))


def drop_everything(lines: list[str]) -> None:
    lines.clear()


def fault_with_proof(root: Path, refutation: Refuted, proof: str) -> str:
    """Return why the answer is rejected with this proof, and the digest of this proof, alone."""
    certificate, question, answer, _ = refutation
    path = root / answer.proof
    path.parent.mkdir(exist_ok=True)
    path.write_text(proof)
    answer = replace(answer, digest=sha256(proof.encode()).hexdigest())
    return fault(replace(certificate, answers={question: answer}), root)


@pytest.mark.parametrize(
    "spoil",
    [drop_last_line, drop_first_hint, drop_last_hint, negate_first_literal, drop_everything],
)
def test_spoiled_proofs_are_rejected(
    tmp_path: Path, refuted: list[Refuted], spoil: Callable[[list[str]], None]
) -> None:
    for refutation in refuted:
        lines = refutation.proof.splitlines()
        assert fault_with_proof(tmp_path, refutation, "\n".join(lines)).startswith("nothing")
        spoil(lines)
        found = fault_with_proof(tmp_path, refutation, "\n".join(lines))
        assert found.startswith((f"{refutation.question}: line ", f"{refutation.question}: the"))


def test_proofs_are_of_one_formula_only(tmp_path: Path, refuted: list[Refuted]) -> None:
    for refutation, other in zip(refuted, (*refuted[1:], refuted[0]), strict=True):
        found = fault_with_proof(tmp_path, refutation, other.proof)
        assert found.startswith(f"{refutation.question}: line ")


def test_proofs_have_their_digest(shipped: Path, refuted: list[Refuted]) -> None:
    for certificate, question, answer, _ in refuted:
        wrong = replace(answer, digest=sha256(answer.digest.encode()).hexdigest())
        found = fault(answering(certificate, question, wrong), shipped)
        assert found.startswith(f"{question}: the SHA-256 of {answer.proof} is not the one")


def without(items: Sequence[T], k: int) -> tuple[T, ...]:
    return (*items[:k], *items[k + 1 :])


def spoiled_polynomials(polynomial: FinalPolynomial) -> Iterator[FinalPolynomial]:
    """Yield the polynomial without signs, without an inequality, and with one counted twice."""
    yield replace(polynomial, signs={})
    for k, (multiplier, six) in enumerate(polynomial.inequalities):
        others = without(polynomial.inequalities, k)
        yield replace(polynomial, inequalities=others)
        yield replace(polynomial, inequalities=(*others, (2 * multiplier, six)))


def test_spoiled_final_polynomials_are_rejected(shipped: Path, refuted: list[Refuted]) -> None:
    with_polynomials = [refutation for refutation in refuted if refutation.answer.final_polynomials]
    assert with_polynomials
    for certificate, question, answer, _ in with_polynomials:
        polynomials = answer.final_polynomials
        for k, polynomial in enumerate(polynomials):
            others = without(polynomials, k)
            for spoiled in spoiled_polynomials(polynomial):
                wrong = replace(answer, final_polynomials=(*others, spoiled))
                found = fault(replace(certificate, answers={question: wrong}), shipped)
                assert found.startswith(f"{question}: ")
            wrong = replace(answer, final_polynomials=others)
            found = fault(replace(certificate, answers={question: wrong}), shipped)
            assert found.startswith(f"{question}: line ")


# Answers turned into their opposites.


@every_pattern
def test_opposite_answers_are_rejected(
    shipped: Path, certificates: Certificates, refuted: list[Refuted], name: str
) -> None:
    """A yes becomes a no by the first proof for that question, a no a yes at the unit cube."""
    certificate = certificates[name]
    for question, answer in certificate.answers.items():
        if isinstance(answer, Yes):
            no = next(other.answer for other in refuted if other.question == question)
            found = fault(answering(certificate, question, no), shipped)
            assert found.startswith(f"{question}: line ")
        if isinstance(answer, No):
            yes = Yes(CORNERS_OF_THE_CUBE)
            found = fault(answering(certificate, question, yes), shipped)
            assert found.startswith(f"{question}: tetrahedron ")


def test_nobodys_points_realize_what_is_refuted(
    shipped: Path, certificates: Certificates, refuted: list[Refuted]
) -> None:
    everybodys = {points for c in certificates.values() for _, points in yeses(c)}
    for certificate, question, _, _ in refuted:
        if question == "realizable":
            for points in everybodys:
                found = fault(replace(certificate, answers={question: Yes(points)}), shipped)
                assert found.startswith("realizable: ")


# Spoiled tetrahedra and claims.


def neighbours(tetrahedra: tuple[Simplex, ...]) -> Iterator[set[Simplex]]:
    """Yield the set without one tetrahedron, with one more, and with another for the first."""
    for tetrahedron in tetrahedra:
        yield set(tetrahedra) - {tetrahedron}
    for tetrahedron in QUADRUPLES:
        if tetrahedron not in tetrahedra:
            yield {*tetrahedra, tetrahedron}
            yield {*tetrahedra[1:], tetrahedron}


@every_pattern
def test_spoiled_tetrahedra_are_rejected(
    shipped: Path, certificates: Certificates, name: str
) -> None:
    certificate = certificates[name]
    for tetrahedra in neighbours(certificate.tetrahedra):
        spoiled = replace(certificate, tetrahedra=tuple(sorted(tetrahedra)))
        assert fault(spoiled, shipped).startswith("tetrahedra: ")


def test_what_only_a_shelling_refuses_is_rejected(
    shipped: Path, certificates: Certificates
) -> None:
    """Nine tetrahedra bounded like a hexahedron that form no ball, with all else stated right."""
    text = "1235 1257 1267 1348 1357 1378 1568 1678 2357"
    tetrahedra = tuple(tuple(map(int, word)) for word in text.split())
    letter = boundary_letter(boundary_diagonals(tetrahedra))
    spoiled = Certificate(
        pattern="9_A",
        boundary=letter,
        instances=len(orbit(tetrahedra)),
        tetrahedra=tetrahedra,
        answers=dict.fromkeys(certificates["9_A"].answers, Open()),
    )
    assert (letter, spoiled.instances) == ("b", 48)
    assert fault(spoiled, shipped) == "tetrahedra: no shelling goes beyond 8 of 9 tetrahedra"


@every_pattern
def test_false_claims_are_rejected(shipped: Path, certificates: Certificates, name: str) -> None:
    certificate = certificates[name]
    size = len(certificate.tetrahedra)
    for letter in BOUNDARY_TYPES.keys() - {certificate.boundary}:
        found = fault(replace(certificate, boundary=letter), shipped)
        assert found == f"boundary: stated {letter}, but it is {certificate.boundary}"
    for number in {0, 1, 2, 24, 48, -certificate.instances} - {certificate.instances}:
        found = fault(replace(certificate, instances=number), shipped)
        assert found == f"instances: stated {number}, but it is {certificate.instances}"
    for other in PATTERN_COUNTS.keys() - {size}:
        found = fault(replace(certificate, pattern=f"{other}_A"), shipped)
        assert found == f"number of tetrahedra: stated {other}, but it is {size}"
