"""The command that throws forgeries at the kernel: attack."""

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
    print_table,
    progress,
    root_option,
)

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
    from certify.run import printable

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
    from certify.opinions.attack.judge import OUTCOMES

    return {
        "seed": seed,
        "tried": found.tried,
        "false_acceptances": found.total["false"],
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
    total = found.total
    click.echo(
        f"{found.tried} forgeries: {total['refused']} refused, {total['true']} accepted and true\n"
        f"checks broken off: {total['broken off']}\n"
        f"false acceptances: {total['false']}"
    )
