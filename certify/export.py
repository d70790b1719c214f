"""The evidence for one claim in other people's formats: DIMACS, LRAT, DRAT, JSON. Not trusted."""

from collections.abc import Iterable
from pathlib import Path
from typing import Any

from certify.dimacs import write_dimacs
from certify.kernel.certificate import Certificate, No, Yes
from certify.kernel.check import (
    Verdict,
    completeness_formula,
    instances_bounded_by,
    refuted_formula,
)
from certify.kernel.chirotope import QUADRUPLES
from certify.kernel.completeness import INNER
from certify.kernel.evidence import (
    MAX_PROOF_BYTES,
    Evidence,
    Malformed,
    completeness_file,
    read_file,
)
from certify.kernel.orientations import has_sign
from certify.kernel.triangulation import label, orientation
from certify.report import coordinates, json_text


def steps(root: Path, certificate: Certificate) -> dict[str, int | None]:
    """Return, by question, how many clauses the proof adds; None where there is none to read."""
    return {
        question: _steps(root, answer) if isinstance(answer, No) else None
        for question, answer in certificate.answers.items()
    }


def _steps(root: Path, answer: No) -> int | None:
    try:
        lines = Evidence(root).proof(answer.proof, answer.digest).splitlines()
    except Malformed:
        return None
    return sum(line.split(" ")[1:2] != ["d"] for line in lines)


def export_answer(root: Path, certificate: Certificate, question: str, folder: Path) -> list[Path]:
    """Write the evidence for one answer to files in ``folder``; return them.

    A yes makes a JSON file; a no makes a formula and two proofs of its unsatisfiability; an open
    question makes nothing.

    Raises:
        Malformed: A proof cannot be read.
    """
    answer = certificate.answers[question]
    contents: dict[str, str | bytes] = {}
    if isinstance(answer, Yes):
        contents["json"] = json_text(_placement(certificate, question, answer)) + "\n"
    if isinstance(answer, No):
        contents["cnf"] = _refuted_dimacs(certificate, question, answer)
        contents["lrat"] = Evidence(root).proof(answer.proof, answer.digest)
        contents["drat"] = _read_drat(root, answer.proof)
    return _write_all(folder / f"{certificate.pattern}.{question}", contents)


def export_completeness(
    root: Path, letter: str, verdicts: Iterable[Verdict], folder: Path
) -> list[Path]:
    """Write the formula and the two proofs that no triangulation with this boundary is missing."""
    formula = completeness_formula(letter, instances_bounded_by(letter, verdicts))
    comments = [
        f"Triangulations of the hexahedron with boundary type {letter} that are not listed.",
        "Unsatisfiable: the list is complete. The tetrahedra of the variables:",
        *(f"{k}: {label(tetrahedron)}" for k, tetrahedron in enumerate(INNER, start=1)),
    ]
    proof = completeness_file(letter)
    contents: dict[str, str | bytes] = {
        "cnf": write_dimacs(formula, comments),
        "lrat": Evidence(root).proof(proof),
        "drat": _read_drat(root, proof),
    }
    return _write_all(folder / f"complete.{letter}", contents)


def _write_all(stem: Path, contents: dict[str, str | bytes]) -> list[Path]:
    stem.parent.mkdir(parents=True, exist_ok=True)
    written = []
    for suffix, content in contents.items():
        path = stem.with_name(f"{stem.name}.{suffix}")
        path.write_bytes(content.encode("ascii") if isinstance(content, str) else content)
        written.append(path)
    return written


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
    return write_dimacs(formula, comments)


def _read_drat(root: Path, proof: str) -> bytes:
    path = (root / proof).with_suffix(".drat")
    if path.is_symlink():
        raise Malformed(f"proofs/{path.name} is a symbolic link")
    return read_file(path, MAX_PROOF_BYTES)
