"""Commands that show the evidence: list, show."""

# ruff: noqa: PLC0415 - the kernel (with it sympy) is imported where it is needed

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from certify.cli.common import (
    examples,
    existing_root,
    exit_with,
    json_option,
    pattern_argument,
    plural,
    print_json,
    print_table,
    print_wrapped,
    root_option,
    verdict_line,
)

if TYPE_CHECKING:
    from certify.kernel.check import Verdict


@click.command("list", epilog=examples("certify list --json"))
@root_option
@json_option
def list_(root: Path | None, as_json: bool) -> None:
    """List the patterns and the answers that are claimed.

    Nothing is checked: that is what check-all is for.
    """
    from certify import report
    from certify.kernel.certificate import PATTERN_NAMES, read_certificate
    from certify.kernel.evidence import Evidence, Malformed, certificate_file

    evidence = Evidence(existing_root(root))
    claims, rejected = [], []
    for pattern in PATTERN_NAMES:
        try:
            certificate = read_certificate(pattern, evidence.certificate(pattern))
            claims.append(report.claim_record(certificate))
        except Malformed as error:
            fault = f"{certificate_file(pattern)}: {error}"
            rejected.append({"pattern": pattern, "fault": fault})
    note = "as claimed; check-all decides"
    if as_json:
        print_json({"note": note, "patterns": claims, "rejected": rejected})
    else:
        _print_claims(claims, note)
        for rejection in rejected:
            click.echo(f"rejected: {rejection['fault']}")
    exit_with(not rejected)


@click.command(epilog=examples("certify show 8_E"))
@pattern_argument("pattern")
@root_option
@json_option
def show(pattern: str, root: Path | None, as_json: bool) -> None:
    """Show the verdict on a certificate, and its evidence."""
    from certify import export, report
    from certify.kernel.check import check_pattern

    folder = existing_root(root)
    verdict = check_pattern(folder, pattern)
    record = None
    if verdict.certificate:
        steps = export.steps(folder, verdict.certificate)
        record = report.evidence_record(verdict.certificate, steps)
    if as_json:
        print_json({"verdict": report.verdict_record(verdict), "certificate": record})
    else:
        click.echo(verdict_line(verdict))
        if record:
            _print_evidence(record, verdict)
    exit_with(verdict.fault is None)


def _print_claims(records: Sequence[dict[str, Any]], note: str) -> None:
    headings = ("pattern", "tetrahedra", "boundary", "instances", "realizable", "convex", "valid")
    print_table(headings, ([record[h] for h in headings] for record in records), note)


def _print_evidence(record: dict[str, Any], verdict: Verdict) -> None:
    from certify.kernel.certificate import QUESTIONS
    from certify.kernel.evidence import certificate_file

    tetrahedra = ["".join(map(str, tetrahedron)) for tetrahedron in record["tetrahedra"]]
    print_wrapped(
        f"{len(tetrahedra)} tetrahedra, boundary type {record['boundary']}, "
        f"{record['instances']} instances; from {certificate_file(record['pattern'])}"
    )
    click.echo()
    print_wrapped(f"tetrahedra: {' '.join(tetrahedra)}", hanging=" " * 12)
    for question in QUESTIONS:
        evidence = record[question]
        same = [q for q in QUESTIONS if record[q].get("points") == evidence.get("points")]
        accepted = verdict.answers.get(question) == evidence["answer"]
        answer = (
            evidence["answer"] if accepted else f"{evidence['answer']} is claimed, but rejected"
        )
        click.echo(f"{question}: {answer}{_shown_by(evidence, same[0], question)}")
        if "points" in evidence and same[0] == question:
            _print_points(evidence["points"])
        if "scaled_jacobians" in evidence:
            scaled = " ".join(f"{value:.3f}" for value in evidence["scaled_jacobians"])
            print_wrapped(f"Jacobian at least {evidence['jacobian_at_least']} on the closed cube,")
            print_wrapped(f"scaled at the vertices 1..8: {scaled}")


def _shown_by(evidence: dict[str, Any], first: str, question: str) -> str:
    """Return what shows an answer; ``first`` is the first question that has the same points."""
    if "points" in evidence:
        return ", by these points" if first == question else f", by the points of {first}"
    if "proof" in evidence:
        return f", by {evidence['proof']}: {_steps(evidence)}"
    return ""


def _steps(evidence: dict[str, Any]) -> str:
    if evidence["steps"] is None:
        return "not there, or not the proof that the certificate names"
    steps = plural(evidence["steps"], "step")
    polynomials = evidence["final_polynomials"]
    return f"{steps}, {plural(polynomials, 'final polynomial')}" if polynomials else steps


def _print_points(points: Sequence[Sequence[int | str]]) -> None:
    rows = ([vertex, *point] for vertex, point in enumerate(points, start=1))
    print_table(("vertex", "x", "y", "z"), rows)
