"""Certificates and verdicts in other people's formats. Nothing here is trusted.

DIMACS, LRAT and DRAT for outside proof checkers, JSON for programs, JUnit XML for build servers.
"""

import json
from collections.abc import Iterable, Sequence
from dataclasses import asdict
from fractions import Fraction
from pathlib import Path
from typing import Any
from xml.etree import ElementTree

from certify.kernel.certificate import (
    MAX_PROOF_BYTES,
    QUESTIONS,
    Answer,
    Certificate,
    Malformed,
    No,
    Yes,
    read_file,
    read_proof,
)
from certify.kernel.check import (
    Completeness,
    Verdict,
    completeness_formula,
    completeness_proof,
    refuted_formula,
)
from certify.kernel.chirotope import QUADRUPLES, Point
from certify.kernel.completeness import INNER
from certify.kernel.orientations import Clause, has_sign
from certify.kernel.theorems import Theorem
from certify.kernel.triangulation import label, orientation
from certify.quality import jacobian_lower_bound, scaled_jacobians


def dimacs(formula: Sequence[Clause], comments: Iterable[str] = ()) -> str:
    """Return the formula as DIMACS text, with the comments on top."""
    variables = max((abs(literal) for clause in formula for literal in clause), default=0)
    lines = [f"c {comment}" for comment in comments]
    lines.append(f"p cnf {variables} {len(formula)}")
    lines += [" ".join(map(str, (*clause, 0))) for clause in formula]
    return "\n".join(lines) + "\n"


def export_answer(root: Path, certificate: Certificate, question: str, folder: Path) -> list[Path]:
    """Write the evidence for one answer to files in ``folder``; return them.

    A yes makes a JSON file; a no makes a formula and two proofs of its unsatisfiability; an open
    question makes nothing. Raise Malformed if a proof cannot be read.
    """
    answer = certificate.answers[question]
    contents: dict[str, str | bytes] = {}
    if isinstance(answer, Yes):
        contents["json"] = json.dumps(_placement(certificate, question, answer)) + "\n"
    if isinstance(answer, No):
        contents["cnf"] = _refuted_dimacs(certificate, question, answer)
        contents["lrat"] = read_proof(root, answer.proof, answer.digest)
        contents["drat"] = _read_drat(root, answer.proof)
    return _write_all(folder / f"{certificate.pattern}.{question}", contents)


def export_completeness(
    root: Path, letter: str, verdicts: Iterable[Verdict], folder: Path
) -> list[Path]:
    """Write the formula and the two proofs that no triangulation with this boundary is missing."""
    formula = completeness_formula(letter, verdicts)
    comments = [
        f"Triangulations of the hexahedron with boundary type {letter} that are not listed.",
        "Unsatisfiable: the list is complete. The tetrahedra of the variables:",
        *(f"{k}: {label(tetrahedron)}" for k, tetrahedron in enumerate(INNER, start=1)),
    ]
    proof = completeness_proof(letter)
    contents: dict[str, str | bytes] = {
        "cnf": dimacs(formula, comments),
        "lrat": read_proof(root, proof),
        "drat": _read_drat(root, proof),
    }
    return _write_all(folder / f"complete.{letter}", contents)


def _write_all(stem: Path, contents: dict[str, str | bytes]) -> list[Path]:
    stem.parent.mkdir(parents=True, exist_ok=True)
    return [
        _write(stem.with_name(f"{stem.name}.{suffix}"), content)
        for suffix, content in contents.items()
    ]


def _placement(certificate: Certificate, question: str, answer: Yes) -> dict[str, Any]:
    return {
        "pattern": certificate.pattern,
        "question": question,
        "points": coordinates(answer.points),
        "tetrahedra": certificate.tetrahedra,
    }


def _refuted_dimacs(certificate: Certificate, question: str, answer: No) -> str:
    formula = refuted_formula(question, answer, orientation(certificate.tetrahedra))
    comments = [
        f"Pattern {certificate.pattern}, question {question}: clauses that every placement of the",
        "eight points with that property satisfies. Unsatisfiable: there is no such placement.",
        "det abcd is the determinant of p_b - p_a, p_c - p_a, p_d - p_a.",
    ]
    if added := len(answer.final_polynomials):
        comments.append(f"The last {added} of the clauses are those of final polynomials.")
    for quadruple in QUADRUPLES:
        positive, negative = (has_sign(quadruple, sign) for sign in (1, -1))
        det = f"det {label(quadruple)}"
        comments.append(f"{positive}: {det} > 0, {negative}: {det} < 0")
    return dimacs(formula, comments)


def _read_drat(root: Path, proof: str) -> bytes:
    path = (root / proof).with_suffix(".drat")
    if path.is_symlink():
        raise Malformed(f"proofs/{path.name} is a symbolic link")
    return read_file(path, MAX_PROOF_BYTES)


def _write(path: Path, content: str | bytes) -> Path:
    path.write_bytes(content.encode("ascii") if isinstance(content, str) else content)
    return path


def coordinates(points: Sequence[Point]) -> list[list[int | str]]:
    """Return the points as a certificate writes them: integers, or strings p/q."""
    return [[_coordinate(coordinate) for coordinate in point] for point in points]


def _coordinate(value: Fraction) -> int | str:
    return value.numerator if value.denominator == 1 else str(value)


def lemmas(root: Path, answer: No) -> int | None:
    """Return how many clauses a stored proof adds, or None if it cannot be read."""
    try:
        lines = read_proof(root, answer.proof, answer.digest).splitlines()
    except Malformed:
        return None
    return sum(line.split(" ")[1:2] != ["d"] for line in lines)


def claimed(answer: Answer) -> str:
    """Return what the certificate says, in one word."""
    return "yes" if isinstance(answer, Yes) else "no" if isinstance(answer, No) else "open"


def verdict_record(verdict: Verdict) -> dict[str, Any]:
    """Return a verdict as a JSON object."""
    accepted = verdict.fault is None
    answers = {question: verdict.answers.get(question) for question in QUESTIONS}
    return {"pattern": verdict.pattern, "ok": accepted, **answers, "fault": verdict.fault}


def claim_record(certificate: Certificate) -> dict[str, Any]:
    """Return what a certificate claims as a JSON object, without the evidence."""
    return {
        "pattern": certificate.pattern,
        "tetrahedra": len(certificate.tetrahedra),
        "boundary": certificate.boundary,
        "instances": certificate.instances,
        **{question: claimed(answer) for question, answer in certificate.answers.items()},
    }


def certificate_record(certificate: Certificate, root: Path) -> dict[str, Any]:
    """Return a certificate with its evidence as a JSON object."""
    evidence = {
        question: _evidence(question, answer, root)
        for question, answer in certificate.answers.items()
    }
    return {**claim_record(certificate), "tetrahedra": certificate.tetrahedra, **evidence}


def _evidence(question: str, answer: Answer, root: Path) -> dict[str, Any]:
    record: dict[str, Any] = {"answer": claimed(answer)}
    if isinstance(answer, Yes):
        record["points"] = coordinates(answer.points)
        if question == "valid":
            record["jacobian_at_least"] = _coordinate(jacobian_lower_bound(answer.points))
            record["scaled_jacobians"] = [round(j, 4) for j in scaled_jacobians(answer.points)]
    if isinstance(answer, No):
        record["proof"] = answer.proof
        record["lemmas"] = lemmas(root, answer)
        record["final_polynomials"] = len(answer.final_polynomials)
    return record


def rejections(verdicts: Iterable[Verdict]) -> list[dict[str, Any]]:
    """Return the rejections among the verdicts as JSON objects."""
    faults = [(verdict.pattern, verdict.fault) for verdict in verdicts]
    return [{"pattern": pattern, "fault": fault} for pattern, fault in faults if fault is not None]


def summary(
    verdicts: Sequence[Verdict],
    completeness: Sequence[Completeness],
    theorems: Sequence[Theorem],
    seconds: float,
) -> dict[str, Any]:
    """Return the outcome of checking everything as a JSON object.

    Rejected proofs of completeness are listed after the certificates, with no pattern.
    """
    accepted = [verdict for verdict in verdicts if verdict.fault is None]
    rejected = rejections(verdicts)
    rejected += [{"pattern": None, "fault": fault} for fault in faults(completeness)]
    return {
        "ok": not rejected and all(theorem.ok for theorem in theorems),
        "patterns": len(accepted),
        **{question: count(accepted, question, "yes") for question in QUESTIONS},
        "open": [
            [verdict.pattern, question]
            for verdict in accepted
            for question, answer in verdict.answers.items()
            if answer == "open"
        ],
        "rejected": rejected,
        "theorems": [asdict(theorem) for theorem in theorems],
        "seconds": round(seconds, 3),
    }


def count(verdicts: Iterable[Verdict], question: str, answer: str) -> int:
    """Return how many of the verdicts answer the question so."""
    return sum(verdict.answers.get(question) == answer for verdict in verdicts)


def faults(results: Iterable[Verdict | Completeness]) -> list[str]:
    """Return why some of the results are rejections, in their order."""
    return [result.fault for result in results if result.fault is not None]


def junit(
    verdicts: Iterable[Verdict],
    completeness: Iterable[Completeness],
    theorems: Iterable[Theorem],
    seconds: float,
) -> bytes:
    """Return the outcome as JUnit XML, with a test case for each pattern and each theorem."""
    not_shown = "; ".join(["not shown", *faults(completeness)])
    cases = [("patterns", verdict.pattern, verdict.fault) for verdict in verdicts]
    cases += [("theorems", t.id, None if t.ok else f"{not_shown}: {t.statement}") for t in theorems]
    failures = sum(fault is not None for _, _, fault in cases)
    totals = {"tests": str(len(cases)), "failures": str(failures), "errors": "0"}
    totals["time"] = f"{seconds:.3f}"
    suites = ElementTree.Element("testsuites", totals)
    suite = ElementTree.SubElement(suites, "testsuite", {"name": "certify", **totals})
    for kind, name, fault in cases:
        attributes = {"classname": f"certify.{kind}", "name": name, "time": "0"}
        case = ElementTree.SubElement(suite, "testcase", attributes)
        if fault is not None:
            ElementTree.SubElement(case, "failure", {"message": fault})
    xml: bytes = ElementTree.tostring(suites, encoding="utf-8", xml_declaration=True)
    return xml
