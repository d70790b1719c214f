"""Certificates, verdicts and outcomes as JSON objects and as JUnit XML. Nothing here is trusted."""

import json
from collections.abc import Iterable, Mapping
from dataclasses import asdict
from fractions import Fraction
from typing import Any
from xml.etree import ElementTree

from certify import __version__
from certify.kernel.certificate import QUESTIONS, Answer, Certificate, No, Yes
from certify.kernel.check import Verdict
from certify.kernel.chirotope import Point
from certify.kernel.theorems import Outcome
from certify.manifest import NAME, Manifest
from certify.mesh.quality import jacobian_bounds, scaled_jacobians


def json_text(value: object, indent: str = "") -> str:
    """Return JSON text in which a list without lists or objects in it has a line to itself."""
    inner = f"{indent}  "
    if isinstance(value, Mapping) and value:
        items = [f"{json.dumps(key)}: {json_text(item, inner)}" for key, item in value.items()]
    elif isinstance(value, list | tuple) and any(isinstance(v, list | tuple | dict) for v in value):
        items = [json_text(item, inner) for item in value]
    else:
        return json.dumps(value)
    opening, closing = "{}" if isinstance(value, Mapping) else "[]"
    return f"{opening}\n{inner}" + f",\n{inner}".join(items) + f"\n{indent}{closing}"


def coordinates(points: Iterable[Point]) -> list[list[int | str]]:
    """Return the points as a certificate writes them: integers, or strings p/q."""
    return [[rational(coordinate) for coordinate in point] for point in points]


def rational(value: Fraction) -> int | str:
    """Return a number as a certificate writes it."""
    return value.numerator if value.denominator == 1 else str(value)


def claimed(answer: Answer) -> str:
    """Return what a certificate says, in one word."""
    return "yes" if isinstance(answer, Yes) else "no" if isinstance(answer, No) else "open"


def claim_record(certificate: Certificate) -> dict[str, Any]:
    """Return what a certificate claims, without the evidence."""
    return {
        "pattern": certificate.pattern,
        "tetrahedra": len(certificate.tetrahedra),
        "boundary": certificate.boundary,
        "instances": certificate.instances,
        **{question: claimed(answer) for question, answer in certificate.answers.items()},
    }


def verdict_record(verdict: Verdict) -> dict[str, Any]:
    """Return a verdict: what was accepted, or why it was rejected, and on which files it rests."""
    return {
        "pattern": verdict.pattern,
        "ok": verdict.fault is None,
        **{question: verdict.answers.get(question) for question in QUESTIONS},
        "fault": verdict.fault,
        "rests_on": {
            question: verdict.rests_on(question)
            for question, answer in verdict.answers.items()
            if answer in ("yes", "no")
        },
    }


def evidence_record(certificate: Certificate, steps: Mapping[str, int | None]) -> dict[str, Any]:
    """Return a certificate with its evidence; ``steps``: how many clauses the proofs add."""
    evidence = {
        question: {"answer": claimed(answer), **_evidence(question, answer, steps)}
        for question, answer in certificate.answers.items()
    }
    return {**claim_record(certificate), "tetrahedra": certificate.tetrahedra, **evidence}


def _evidence(question: str, answer: Answer, steps: Mapping[str, int | None]) -> dict[str, Any]:
    if isinstance(answer, No):
        return {
            "proof": answer.proof,
            "steps": steps[question],
            "final_polynomials": len(answer.final_polynomials),
        }
    if not isinstance(answer, Yes):
        return {}
    record: dict[str, Any] = {"points": coordinates(answer.points)}
    if question == "valid":
        record["jacobian_at_least"] = rational(jacobian_bounds(answer.points)[0])
        record["scaled_jacobians"] = [round(j, 4) for j in scaled_jacobians(answer.points)]
    return record


def count(verdicts: Iterable[Verdict], question: str, answer: str) -> int:
    """Return how many of the verdicts answer the question so."""
    return sum(verdict.answers.get(question) == answer for verdict in verdicts)


def summary(outcome: Outcome, seconds: float, manifest: Manifest | None) -> dict[str, Any]:
    """Return the outcome of checking everything, and what was run on what.

    Rejected proofs of completeness are listed after the certificates, with no pattern.
    """
    accepted = [verdict for verdict in outcome.verdicts if verdict.fault is None]
    rejected = [
        {"pattern": getattr(result, "pattern", None), "fault": result.fault}
        for result in outcome.results
        if result.fault is not None
    ]
    return {
        "ok": outcome.ok and not (manifest and manifest.faults),
        "certify": __version__,
        **outcome.about,
        "manifest": asdict(manifest) if manifest else None,
        "patterns": len(accepted),
        **{question: count(accepted, question, "yes") for question in QUESTIONS},
        "open": outcome.open,
        "rejected": rejected,
        "theorems": [asdict(theorem) for theorem in outcome.theorems],
        "seconds": round(seconds, 3),
    }


def junit(outcome: Outcome, seconds: float, manifest: Manifest | None) -> bytes:
    """Return the outcome as JUnit XML, with a test case for each pattern and each theorem."""
    cases = [("patterns", verdict.pattern, verdict.fault) for verdict in outcome.verdicts]
    cases += [("completeness", c.boundary, c.fault) for c in outcome.completeness]
    cases += [
        ("theorems", theorem.id, None if theorem.ok else f"not shown: {theorem.statement}")
        for theorem in outcome.theorems
    ]
    if manifest:
        cases.append(("manifest", NAME, "; ".join(manifest.faults) or None))
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
