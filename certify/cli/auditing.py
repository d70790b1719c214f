"""Commands about the paper: audit, spheres."""

# ruff: noqa: PLC0415 - the kernel (with it sympy) is imported where it is needed

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import asdict
from pathlib import Path
from typing import TYPE_CHECKING

import click

from certify.cli.common import (
    examples,
    existing_root,
    exit_with,
    fail,
    jobs_option,
    json_option,
    print_json,
    print_wrapped,
    progress,
    root_option,
)

if TYPE_CHECKING:
    from certify.audit import Finding


@click.command(
    epilog=examples("certify audit --only corrected", "certify audit convex-13 pattern-15-k")
)
@click.argument("claims", nargs=-1, metavar="[ID...]")
@click.option("--only", metavar="VERDICT", help="Print the claims with this verdict only.")
@jobs_option
@root_option
@json_option
def audit(
    claims: tuple[str, ...], only: str | None, jobs: int, root: Path | None, as_json: bool
) -> None:
    """Give every claim of the paper a verdict.

    Everything is checked first; a claim that rests on something rejected is not decided. With IDs,
    only these claims are printed. Corrections are printed in the order of their weight.
    """
    from certify.audit import VERDICTS, summary
    from certify.audit import audit as findings_of
    from certify.run import run

    folder = existing_root(root)
    if only is not None and only not in VERDICTS:
        fail(f"unknown verdict {only}; it must be one of: {', '.join(VERDICTS)}", code=2)
    with progress("checking") as show:
        outcome = run(folder, jobs, show)
    findings = findings_of(outcome)
    unknown = set(claims).difference(finding.id for finding in findings)
    if unknown:
        fail(f"unknown claim {min(unknown)}; certify audit lists them all", code=2)
    chosen = [
        finding
        for finding in findings
        if (not claims or finding.id in claims) and only in (None, finding.verdict)
    ]
    if as_json:
        record = {"summary": summary(findings), "findings": list(map(asdict, chosen))}
        print_json({**record, "rejected": outcome.faults})
    else:
        for fault in outcome.faults:
            click.echo(f"rejected: {fault}")
        _print_findings(chosen)
        counts = ", ".join(f"{number} {verdict}" for verdict, number in summary(findings).items())
        print_wrapped(f"{len(findings)} claims: {counts}", hanging="")
    exit_with(not outcome.faults)


def _print_findings(findings: Sequence[Finding]) -> None:
    for finding in findings:
        click.echo(f"{finding.verdict}: {finding.id}")
        print_wrapped(finding.place, indent="    ", hanging="")
        print_wrapped(f"Claim: {finding.claim}", indent="    ")
        if finding.amendment:
            print_wrapped(f"Amended: {finding.amendment}", indent="    ")
        print_wrapped(f"Reason: {'; '.join(finding.reasons)}", indent="    ")
        click.echo()


@click.command(epilog=examples("certify spheres"))
@json_option
def spheres(as_json: bool) -> None:
    """Derive the 174 patterns the paper's way.

    They come from the triangulations of the 3-sphere with nine vertices. This is a second opinion:
    no theorem needs it.
    """
    raise NotImplementedError
