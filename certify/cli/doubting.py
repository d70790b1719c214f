"""Commands for whoever does not believe the kernel: attack, trust."""

# ruff: noqa: PLC0415 - the kernel (with it sympy) is imported where it is needed

from __future__ import annotations

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
    print_json,
    print_manifest,
    print_opinions,
    print_table,
    print_wrapped,
    progress,
    root_option,
    second_opinion_option,
    second_opinions,
)
from certify.printable import printable

if TYPE_CHECKING:
    from certify.opinions.attack.campaign import Attack


@click.command(epilog=examples("certify attack --seed 1 --count 200000 --jobs 2"))
@click.option("--seed", type=int, default=1, metavar="S", help="Which forgeries (default 1).")
@click.option(
    "--count",
    type=click.IntRange(min=1),
    default=10_000,
    metavar="N",
    help="How many forgeries (default 10000).",
)
@click.option(
    "--to",
    type=click.Path(path_type=Path),
    default=Path("forgeries"),
    metavar="DIR",
    help="Folder for forgeries that are not refused and false (default forgeries).",
)
@jobs_option
@root_option
@json_option
def attack(seed: int, count: int, to: Path, jobs: int, root: Path | None, as_json: bool) -> None:
    """Throw forged certificates and proofs at the kernel.

    Each is a shipped one with one thing changed. What the kernel accepts of it has to be true by
    code that shares nothing with the kernel, else it is a false acceptance: it is written out as a
    root of its own, and the exit code is 1; the same if the check breaks off. The outcome depends
    on the seed alone, not on --jobs.
    """
    from certify.opinions.attack.campaign import NotAccepted, write_out
    from certify.opinions.attack.campaign import attack as attack_with

    folder = existing_root(root)
    try:
        with progress() as show:
            found = attack_with(folder, seed, count, jobs, show)
    except NotAccepted as error:
        fail(f"rejected: {error}", code=1)
    written = [(finding, str(write_out(to, finding))) for finding in found.findings]
    if as_json:
        print_json(_record(found, seed, [path for _, path in written]))
    else:
        _print_counts(found)
        for finding, path in written:
            click.echo(printable(f"{finding.outcome}: {finding.kind}: {finding.reason}: {path}"))
    exit_with(not found.findings)


def _record(found: Attack, seed: int, paths: list[str]) -> dict[str, Any]:
    from certify.kernel.evidence import kernel_digest
    from certify.opinions.attack.judge import OUTCOMES

    return {
        "seed": seed,
        "kernel_sha256": kernel_digest(),
        "figures": _figures(found),
        "kinds": {
            kind: {"tried": counts.total(), **{o: counts[o] for o in OUTCOMES}}
            for kind, counts in found.counts.items()
        },
        "written": paths,
    }


def _print_counts(found: Attack) -> None:
    from certify.opinions.attack.judge import OUTCOMES

    print_table(
        ("kind", "tried", *OUTCOMES),
        (
            (kind, counts.total(), *(counts[outcome] for outcome in OUTCOMES))
            for kind, counts in found.counts.items()
        ),
        "what is accepted is true or false",
    )
    for name, number in _figures(found).items():
        click.echo(f"{name}: {number}")


def _figures(found: Attack) -> dict[str, int]:
    total = found.total
    return {
        "forgeries": total.total(),
        "refused": total["refused"],
        "accepted and true": total["true"],
        "checks broken off": total["broken off"],
        "false acceptances": total["false"],
    }


@click.command(epilog=examples("certify trust", "certify trust --second-opinion --jobs 2"))
@jobs_option
@root_option
@json_option
@second_opinion_option
def trust(jobs: int, root: Path | None, as_json: bool, second_opinion: bool) -> None:
    """Say on one page what the verdicts rest on.

    What has to be trusted, what was replayed in this run, which second opinions agree and which did
    not run, how the kernel stood forgeries and mutations, and known limits.
    """
    from certify.manifest import compare
    from certify.opinions.second import not_asked
    from certify.opinions.trust import page
    from certify.run import run

    folder = existing_root(root)
    with progress() as show:
        outcome = run(folder, jobs, show)
    opinions = second_opinions(folder, outcome, jobs) if second_opinion else list(not_asked())
    found = page(outcome, compare(folder, outcome), opinions)
    if as_json:
        print_json(found)
    else:
        _print_trusted(found["trusted"])
        _print_replayed(found["replayed"])
        _print_heading("Second opinions")
        if not second_opinion:
            print_wrapped("Not asked in this run; certify trust --second-opinion asks them.")
        print_opinions(opinions)
        _print_on_record(found["on_record"])
        _print_heading("Known limits")
        for limit in found["limits"]:
            print_wrapped(f"- {limit}", hanging="  ")
    exit_with(found["replayed"]["ok"] and not any(opinion.faults for opinion in opinions))


def _print_heading(text: str) -> None:
    click.echo(f"\n{text}\n{'-' * len(text)}")


def _print_trusted(trusted: dict[str, Any]) -> None:
    print_table(
        ("certify/kernel/", "lines", "of code", "SHA-256"),
        [(m["file"], m["lines"], m["code"], m["sha256"][:16]) for m in trusted["kernel"]],
        "What is trusted",
    )
    lines, code = (sum(m[key] for m in trusted["kernel"]) for key in ("lines", "code"))
    print_wrapped(f"the kernel: {lines} lines, {code} of them neither empty nor words")
    click.echo(f"its SHA-256: {trusted['kernel_sha256']}")
    print_wrapped(
        f"it runs on {trusted['python']}; of sympy {trusted['sympy']} it uses the determinant "
        f"({trusted['determinants']})"
    )
    click.echo("its mathematics: CHECKING.md, sections 4 to 8")


def _print_replayed(replayed: dict[str, Any]) -> None:
    _print_heading("What was replayed in this run")
    for fault in replayed["rejected"]:
        click.echo(f"rejected: {fault}")
    shown = sum(replayed["theorems"].values())
    print_wrapped(
        f"{'ok' if replayed['ok'] else 'not ok'}: {replayed['certificates']} certificates "
        f"accepted, {len(replayed['rejected'])} rejected, {replayed['open']} open questions, "
        f"{shown} of {len(replayed['theorems'])} theorems, from {replayed['files']} files"
    )
    click.echo(f"their SHA-256: {replayed['evidence_sha256']}")
    print_manifest(replayed["manifest"])


def _print_on_record(records: dict[str, dict[str, Any] | None]) -> None:
    from certify.opinions.trust import RECORDS

    _print_heading("Attacks on record")
    for name, record in records.items():
        again = f"again: {RECORDS[name]}"
        if record is None:
            print_wrapped(f"{name}: nothing is on record; {again}")
            continue
        stale = "" if record["for_this_kernel"] else "found for another kernel; "
        figures = ", ".join(f"{number} {what}" for what, number in record["figures"].items())
        print_wrapped(f"{name}: {figures}; {stale}{again}")
