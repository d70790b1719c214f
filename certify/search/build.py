"""Everything found again: all patterns, with answers, names, certificates and proofs."""

import json
from hashlib import sha256
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from certify.kernel.certificate import FORMAT, PATTERN_NAMES, QUESTIONS
from certify.kernel.check import (
    FORMULAS,
    check_pattern,
    completeness_formula,
    instances_bounded_by,
)
from certify.kernel.chirotope import QUADRUPLES
from certify.kernel.evidence import completeness_file
from certify.kernel.hexahedron import BOUNDARY_TYPES
from certify.kernel.orientations import convex_formula, has_sign
from certify.kernel.refutation import FinalPolynomial
from certify.kernel.triangulation import label, orbit, orientation
from certify.manifest import EVIDENCE, evidence
from certify.processes import Report, mapping
from certify.search.enumeration import Pattern, patterns
from certify.search.final_polynomials import refute_with_polynomials
from certify.search.naming import assign_names
from certify.search.placement import place
from certify.search.refutations import Step, lrat, model, refute
from certify.writing import written_to


class Refutation(NamedTuple):
    """A clausal proof and the final polynomials that it builds on."""

    steps: list[Step]
    polynomials: list[FinalPolynomial]


Finding = list[list[int]] | Refutation | None
"""What was found for one question: points, or a refutation, or nothing."""

INVESTIGATING = "searching"
COMPLETING = "completing"


def build(root: Path, jobs: int, report: Report) -> None:
    """Put certificates/ and proofs/, found anew, below ``root``, which is created if need be.

    They replace old ones at the end, file by file, and old certificates and proofs that were not
    found again are removed. A build that is interrupted before the end changes nothing; at the very
    end, between two renames, some files are new and others old, each of them whole, and the digests
    in the certificates tell. What is found depends on the code
    and the libraries' versions, not on the number of jobs or on how a machine rounds: every pattern
    has a random generator of its own, seeded by its position; there is no time limit; points are
    sought in integers; and linear programs have one cheapest solution.
    """
    with written_to(root) as scratch:
        for folder in EVIDENCE:
            (scratch / folder).mkdir()
        write_patterns(scratch, jobs, report)
        write_completeness(scratch, report)
        found = evidence(scratch)
    for name in set(evidence(root)).difference(found):
        (root / name).unlink()


def write_patterns(root: Path, jobs: int, report: Report) -> None:
    """Find every pattern and its answers, and write its certificate and proofs."""
    found = patterns()
    findings: list[dict[str, Finding]] = []
    report(INVESTIGATING, 0, len(found))
    with mapping(jobs) as mapped:
        for answers in mapped(investigate, found, range(len(found))):
            findings.append(answers)
            report(INVESTIGATING, len(findings), len(found))
    facts = [
        (len(pattern.tetrahedra), pattern.boundary, status(pattern, answers))
        for pattern, answers in zip(found, findings, strict=True)
    ]
    for name, pattern, answers in zip(assign_names(facts), found, findings, strict=True):
        write(root, name, pattern, answers)


def write_completeness(root: Path, report: Report) -> None:
    """Write, for every boundary, the proof that no pattern is missing among those written."""
    verdicts = [check_pattern(root, name) for name in PATTERN_NAMES]
    for done, letter in enumerate(BOUNDARY_TYPES):
        report(COMPLETING, done, len(BOUNDARY_TYPES))
        if steps := refute(completeness_formula(letter, instances_bounded_by(letter, verdicts))):
            write_proof(root / completeness_file(letter), steps)
    report(COMPLETING, len(BOUNDARY_TYPES), len(BOUNDARY_TYPES))


def investigate(pattern: Pattern, seed: int) -> dict[str, Finding]:
    """Return what was found for each question: refutations first, then one point set."""
    signs = orientation(pattern.tetrahedra)
    answers: dict[str, Finding] = dict.fromkeys(QUESTIONS)
    for question, formula in FORMULAS.items():
        if refutation := refute_with_polynomials(formula(signs)):
            answers[question] = Refutation(*refutation)
    possible = [question for question in QUESTIONS if answers[question] is None]
    rng = np.random.default_rng(seed)
    while possible:
        points = place(signs, convex="convex" in possible, valid="valid" in possible, rng=rng)
        if points is not None:
            return answers | dict.fromkeys(possible, points.tolist())
        possible.pop()
    return answers


def status(pattern: Pattern, answers: dict[str, Finding]) -> str:
    """Return what the paper would say of the pattern (see printed_status in paper.py).

    It looked for uniform sign vectors only, those without zeros.
    """
    if isinstance(answers["realizable"], Refutation):
        return "no realization"
    if not isinstance(answers["convex"], Refutation):
        return "convex"
    uniform = [(has_sign(quadruple, 1), has_sign(quadruple, -1)) for quadruple in QUADRUPLES]
    if model([*convex_formula(orientation(pattern.tetrahedra)), *uniform]):
        return "not convex, by a final polynomial"
    return "not convex"


def write(root: Path, name: str, pattern: Pattern, answers: dict[str, Finding]) -> None:
    """Write the certificate of one pattern, and its proofs."""
    record: dict[str, Any] = {
        "format": FORMAT,
        "pattern": name,
        "boundary": pattern.boundary,
        "instances": len(orbit(pattern.tetrahedra)),
        "tetrahedra": pattern.tetrahedra,
    }
    for question, finding in answers.items():
        record[question] = write_answer(root, f"proofs/{name}.{question}", finding)
    lines = ",\n ".join(f"{json.dumps(key)}: {json.dumps(value)}" for key, value in record.items())
    path = root / "certificates" / f"{name}.json"
    path.write_text(f"{{{lines}}}\n", encoding="utf-8")


def write_answer(root: Path, stem: str, finding: Finding) -> dict[str, Any]:
    """Return the JSON object that answers a question, having written its proofs."""
    if finding is None:
        return {"answer": "open"}
    if not isinstance(finding, Refutation):
        return {"answer": "yes", "points": finding}
    digest = write_proof(root / f"{stem}.lrat", finding.steps)
    answer = {"answer": "no", "proof": f"{stem}.lrat", "sha256": digest}
    if not finding.polynomials:
        return answer
    return answer | {"final_polynomials": list(map(polynomial_record, finding.polynomials))}


def write_proof(path: Path, steps: list[Step]) -> str:
    """Write a proof as LRAT; return its digest."""
    proof = lrat(steps).encode("ascii")
    path.write_bytes(proof)
    return sha256(proof).hexdigest()


def polynomial_record(polynomial: FinalPolynomial) -> dict[str, Any]:
    """Return a final polynomial as the certificate format has it."""
    return {
        "signs": {label(quadruple): sign for quadruple, sign in polynomial.signs.items()},
        "inequalities": polynomial.inequalities,
    }
