"""Commands that check: check-all, check, replay."""

# ruff: noqa: PLC0415 - the kernel (with it sympy) is imported where it is needed

from __future__ import annotations

from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import asdict
from pathlib import Path
from time import perf_counter
from typing import TYPE_CHECKING, Any

import click

from certify.cli.common import (
    examples,
    existing_root,
    exit_with,
    fail,
    jobs_option,
    json_option,
    pattern_argument,
    print_json,
    print_manifest,
    print_opinions,
    print_table,
    print_wrapped,
    progress,
    root_option,
    second_opinion_option,
    second_opinions,
    verdict_line,
)
from certify.printable import printable

if TYPE_CHECKING:
    from certify.kernel.check import Verdict

MAX_REPLAY_BYTES = 1 << 28


@click.command(epilog=examples("certify check-all --jobs 2 --junit report.xml"))
@jobs_option
@root_option
@json_option
@click.option(
    "--junit",
    type=click.Path(path_type=Path, dir_okay=False, writable=True),
    metavar="FILE",
    help="Write JUnit XML as well.",
)
@second_opinion_option
def check_all(
    jobs: int, root: Path | None, as_json: bool, junit: Path | None, second_opinion: bool
) -> None:
    """Check everything, and print the theorems that follow.

    Each of the 174 certificates is checked; --jobs shares the work between processes. If the folder
    has a manifest, a file that is not as listed there is a failure. With --second-opinion so is a
    difference between the kernel and another opinion; what did not run is named.
    """
    start = perf_counter()
    from certify import report
    from certify.manifest import compare
    from certify.run import run
    from certify.writing import write_file

    folder = existing_root(root)
    if junit and not junit.parent.is_dir():
        fail(f"--junit: {junit.parent} is not a folder", code=2)
    with progress() as show:
        outcome = run(folder, jobs, show)
    seconds = perf_counter() - start
    manifest = compare(folder, outcome)
    summary = report.summary(outcome, seconds, manifest)
    if junit:
        write_file(junit, report.junit(outcome, seconds, manifest))
    opinions = second_opinions(folder, outcome, jobs) if second_opinion else []
    if as_json:
        extra = {"second_opinions": list(map(asdict, opinions))} if second_opinion else {}
        print_json(summary | extra)
    else:
        _print_summary(summary, outcome.verdicts)
        print_opinions(opinions)
    exit_with(summary["ok"] and not any(opinion.faults for opinion in opinions))


@click.command(epilog=examples("certify check 15_A 8_E"))
@pattern_argument("patterns", nargs=-1, required=True, metavar="PATTERN...")
@root_option
@json_option
def check(patterns: tuple[str, ...], root: Path | None, as_json: bool) -> None:
    """Check the certificates of some patterns."""
    from certify import report
    from certify.kernel.check import check_pattern

    folder = existing_root(root)
    verdicts = [check_pattern(folder, pattern) for pattern in patterns]
    ok = all(verdict.fault is None for verdict in verdicts)
    if as_json:
        print_json({"ok": ok, "patterns": list(map(report.verdict_record, verdicts))})
    else:
        for verdict in verdicts:
            click.echo(verdict_line(verdict))
    exit_with(ok)


@click.command(epilog=examples("certify replay formula.cnf proof.lrat"))
@click.argument("formula", type=click.Path(path_type=Path), metavar="FORMULA.cnf")
@click.argument("proof", type=click.Path(path_type=Path), metavar="PROOF.lrat")
@json_option
def replay(formula: Path, proof: Path, as_json: bool) -> None:
    """Replay any LRAT proof of a formula in DIMACS.

    The kernel's own replay: every step has to follow by unit propagation along its hints. Steps by
    the RAT rule (those with negative hints) are outside this format and are rejected.
    """
    from certify.dimacs import read_dimacs
    from certify.kernel.evidence import Malformed
    from certify.kernel.refutation import NotRefuted
    from certify.kernel.refutation import replay as kernel_replay

    for path in (formula, proof):
        if not path.is_file():
            fail(f"{path} is missing, or is not a regular file", code=2)
    steps, fault = None, None
    try:
        with _naming(formula):
            clauses = read_dimacs(_text(formula))
        with _naming(proof):
            steps = kernel_replay(clauses, _text(proof))
    except (Malformed, NotRefuted) as error:
        fault = printable(str(error))
    if as_json:
        print_json({"ok": fault is None, "steps": steps, "fault": fault})
    elif fault:
        click.echo(f"rejected: {fault}")
    else:
        click.echo(printable(f"ok: {proof} refutes {formula} in {steps} steps"))
    exit_with(fault is None)


@contextmanager
def _naming(path: Path) -> Iterator[None]:
    """Put the name of a file before what is wrong with it."""
    from certify.kernel.evidence import Malformed

    try:
        yield
    except ValueError as error:
        raise Malformed(f"{path}: {error}") from None


def _text(path: Path) -> str:
    from certify.kernel.evidence import Malformed, read_file

    try:
        if path.stat().st_size > MAX_REPLAY_BYTES:  # not read at all, then
            raise Malformed(f"larger than {MAX_REPLAY_BYTES} bytes")
        return read_file(path, MAX_REPLAY_BYTES).decode("ascii")
    except UnicodeDecodeError:
        raise Malformed("not ASCII text; binary formats are not read") from None


def _print_summary(summary: dict[str, Any], verdicts: Sequence[Verdict]) -> None:
    for rejection in summary["rejected"]:
        click.echo(f"rejected: {rejection['fault']}")
    _print_counts([verdict for verdict in verdicts if verdict.fault is None])
    if questions := [f"{pattern} {question}" for pattern, question in summary["open"]]:
        print_wrapped(f"open: {', '.join(questions)}")
    for theorem in summary["theorems"]:
        status = "ok" if theorem["ok"] else "not shown"
        print_wrapped(f"{status}: {theorem['id']}: {theorem['statement']}")
    print_manifest(summary["manifest"])
    shown = sum(theorem["ok"] for theorem in summary["theorems"])
    print_wrapped(
        f"{'ok' if summary['ok'] else 'not ok'}: {summary['patterns']} accepted, "
        f"{len(summary['rejected'])} rejected, {len(questions)} open, "
        f"{shown} of {len(summary['theorems'])} theorems, {summary['seconds']:.1f} s"
    )


def _print_counts(accepted: Sequence[Verdict]) -> None:
    """Print the paper's Table 1 as far as the accepted certificates show it."""
    from certify.kernel.certificate import PATTERN_COUNTS, QUESTIONS
    from certify.report import count

    by_size = [[v for v in accepted if v.size == size] for size in PATTERN_COUNTS]
    rows = {"combinatorial": list(map(len, by_size))}
    for question in QUESTIONS:
        rows[question] = [count(group, question, "yes") for group in by_size]
    if any(count(accepted, question, "open") for question in QUESTIONS):
        rows["open"] = [sum(count(group, q, "open") for q in QUESTIONS) for group in by_size]
    headings = ("tetrahedra", *map(str, PATTERN_COUNTS), "Sum")
    print_table(headings, ([name, *row, sum(row)] for name, row in rows.items()))
