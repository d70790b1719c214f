"""Commands about the paper: audit, spheres."""

# ruff: noqa: PLC0415 - the kernel (with it sympy) is imported where it is needed

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import asdict
from itertools import groupby
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from certify.cli.common import (
    examples,
    existing_root,
    exit_with,
    fail,
    jobs_option,
    json_option,
    needing,
    print_json,
    print_wrapped,
    progress,
    root_option,
    status,
)

if TYPE_CHECKING:
    from click.shell_completion import CompletionItem

    from certify.audit import Finding


def _completed_claims(*arguments: Any) -> list[str | CompletionItem]:
    from certify.audit import load_shipped

    return [claim.id for claim in load_shipped() if claim.id.startswith(arguments[-1])]


def _completed_verdicts(*arguments: Any) -> list[str | CompletionItem]:
    from certify.audit import VERDICTS

    return [verdict for verdict in VERDICTS if verdict.startswith(arguments[-1])]


@click.command(
    epilog=examples("certify audit --only corrected", "certify audit convex-13 figure-valid-15s")
)
@click.argument("claims", nargs=-1, metavar="[ID...]", shell_complete=_completed_claims)
@click.option(
    "--only",
    metavar="VERDICT",
    shell_complete=_completed_verdicts,
    help="Print the claims with this verdict only.",
)
@jobs_option
@root_option
@json_option
def audit(
    claims: tuple[str, ...], only: str | None, jobs: int, root: Path | None, as_json: bool
) -> None:
    """Give every claim of the paper a verdict.

    Everything is checked first; a claim that rests on something rejected or open is not decided,
    and the exit code is then 1. With IDs, only these claims are printed. With --only corrected, the
    weightiest corrections come first.
    """
    from certify.audit import VERDICTS, corrections, load_shipped, summary
    from certify.audit import audit as findings_of
    from certify.run import run

    folder = existing_root(root)
    if only is not None and only not in VERDICTS:
        fail(f"unknown verdict {only}; it must be one of: {', '.join(VERDICTS)}", code=2)
    unknown = set(claims).difference(claim.id for claim in load_shipped())
    if unknown:
        fail(f"unknown claim {min(unknown)}; certify audit lists them all", code=2)
    with progress() as show:
        outcome = run(folder, jobs, show)
    findings = findings_of(outcome)
    in_order = corrections(findings) if only == "corrected" else findings
    chosen = [
        finding
        for finding in in_order
        if (not claims or finding.id in claims) and only in (None, finding.verdict)
    ]
    if as_json:
        record = {"summary": summary(findings), "findings": list(map(asdict, chosen))}
        print_json({**record, "rejected": outcome.faults})
    else:
        for fault in outcome.faults:
            click.echo(f"rejected: {fault}")
        for finding in chosen:
            _print_finding(finding)
        if not chosen:
            click.echo("none of the claims asked for has this verdict\n")
        counts = ", ".join(f"{number} {verdict}" for verdict, number in summary(findings).items())
        print_wrapped(f"{len(findings)} claims: {counts}", hanging="")
    exit_with(not outcome.faults and not any(finding.failed for finding in findings))


def _print_finding(finding: Finding) -> None:
    weight = f" ({finding.weight})" if finding.weight else ""
    amended = ", and amended" if finding.verdict == "argued" and finding.amendment else ""
    click.echo(f"{finding.verdict}{amended}{weight}: {finding.id}")
    amendment = "In examples" if finding.verdict == "illustrated" else "Amended"
    for text in (
        finding.place,
        f"Claim: {finding.claim}",
        finding.amendment and f"{amendment}: {finding.amendment}",
        f"Reasons: {_grouped(finding.reasons)}",
        finding.failed and f"Failed: {_grouped(finding.failed)}",
    ):
        if text:
            print_wrapped(text, indent="    ")
    click.echo()


def _grouped(reasons: Sequence[str]) -> str:
    """Join reasons; neighbours that differ in the pattern only are said once, with all patterns."""

    def answer(reason: str) -> str:
        name, _, rest = reason.partition(" ")
        return rest if "_" in name else reason

    parts = []
    for rest, group in groupby(reasons, answer):
        names = [reason.removesuffix(rest).strip() for reason in group]
        parts.append(f"{', '.join(names)} {rest}".strip())
    return "; ".join(parts)


@click.command(epilog=examples("certify spheres"))
@root_option
@json_option
def spheres(root: Path | None, as_json: bool) -> None:
    """Derive the 174 patterns the paper's way.

    They come from the triangulations of the 3-sphere with nine vertices, and are compared with
    those that the kernel accepts. This is a second opinion: no theorem needs it. The exit code is 1
    if they differ, or if anything was rejected.
    """
    from certify.run import run

    with needing("search"):
        from certify.opinions.derivation import second_derivation
    outcome = run(existing_root(root))
    with status("looking for spheres") as report:
        found = second_derivation(outcome, report)
    record = {
        "spheres": found.spheres,
        "classes": len(found.hexahedra),
        "graphs": found.graphs,
        "agrees": found.agrees,
    }
    if as_json:
        print_json({**record, "rejected": outcome.faults})
    else:
        for fault in outcome.faults:
            click.echo(f"rejected: {fault}")
        click.echo(
            f"{'ok' if found.agrees else 'not ok'}: {found.spheres} spheres with nine vertices, "
            f"{len(found.hexahedra)} classes of hexahedra,\n"
            f"{found.graphs} classes of decomposition graphs; "
            f"these are {'' if found.agrees else 'not '}the accepted patterns"
        )
    exit_with(found.agrees and not outcome.faults)
