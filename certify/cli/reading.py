"""Commands for readers: explain."""

# ruff: noqa: PLC0415 - the kernel (with it sympy) is imported where it is needed

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypeAlias

import click

from certify.cli.common import (
    columns,
    examples,
    existing_root,
    exit_with,
    fail,
    pattern_argument,
    print_json,
    print_table,
    progress,
    require_question,
    root_option,
    verdict_line,
)
from certify.printable import printable

if TYPE_CHECKING:
    from certify.kernel.certificate import Certificate

Formats: TypeAlias = dict[str, Callable[[], Any]]
"""Format -> what makes an explanation in it."""


@click.command(
    epilog=examples(
        "certify explain 15_K valid",
        "certify explain 15_A realizable --format latex > 15_A.tex",
        "certify explain 5_A valid",
        "certify explain --all",
    )
)
@pattern_argument("pattern", required=False)
@click.argument(
    "question", required=False, shell_complete=lambda *_: ["realizable", "convex", "valid"]
)
@click.option(
    "--format",
    "form",
    type=click.Choice(("text", "markdown", "latex", "json")),
    default="text",
    help="What to print (default text).",
)
@click.option("--all", "every", is_flag=True, help="How long all explanations of a no are.")
@root_option
def explain(
    pattern: str | None, question: str | None, form: str, every: bool, root: Path | None
) -> None:
    """Explain why the answer to a question is yes or no.

    QUESTION is realizable, convex or valid. A no is explained in steps that a person can follow,
    each a fact about one determinant, with its reason; they have been replayed by the kernel, step
    by step, against its own formula. A yes is explained by numbers that a person can check: the
    points, the determinants that matter, and what they show of any five vertices; they have been
    checked as they stand, after the kernel accepted the points.
    """
    if every == bool(pattern) or bool(pattern) != bool(question):
        fail("name a pattern and a question, or else --all", code=2)
    if every:
        _print_lengths(existing_root(root), form)
    elif pattern and question:
        _explain(existing_root(root), pattern, require_question(question), form)


def _explain(root: Path, pattern: str, question: str, form: str) -> None:
    from certify.kernel.check import check_pattern

    verdict = check_pattern(root, pattern)
    if verdict.fault is not None or verdict.certificate is None:
        fail(verdict_line(verdict), code=1)
    answer = verdict.answers[question]
    if answer not in _FORMATS:
        fail(f"{pattern} {question} is answered by {answer}; a yes or a no is explained", code=2)
    formats = _FORMATS[answer](verdict.certificate, question)
    if form == "json":
        print_json(formats["json"]())
    else:
        click.echo(formats[form]())


def _refutation(certificate: Certificate, question: str) -> Formats:
    from certify.atlas.explain.explanation import BadOutline
    from certify.atlas.explain.outlines import explained
    from certify.atlas.explain.words import account, as_json, as_latex, as_markdown, as_text

    try:
        explanation = explained(certificate, question)
    except BadOutline as error:
        fail(str(error), code=1)
    told = account(explanation, certificate, question)
    return {
        "text": lambda: as_text(told, columns()),
        "markdown": lambda: as_markdown(told),
        "latex": lambda: as_latex(told),
        "json": lambda: as_json(told),
    }


def _witness(certificate: Certificate, question: str) -> Formats:
    from certify.atlas.explain.witness import BadWitness, witness
    from certify.atlas.explain.witness_words import as_json, as_latex, as_markdown, as_text, page

    try:
        found = witness(certificate, question)
    except BadWitness as error:
        fail(f"{certificate.pattern} {question}: {error}", code=1)
    told = page(found, certificate.pattern)
    return {
        "text": lambda: as_text(told, columns()),
        "markdown": lambda: as_markdown(told),
        "latex": lambda: as_latex(told),
        "json": lambda: as_json(found, certificate.pattern),
    }


_FORMATS = {"yes": _witness, "no": _refutation}
"""Answer -> what makes its explanation, in each of the formats."""


def _print_lengths(root: Path, form: str) -> None:
    """Print a table, or an object, of the explanations of all refutations that are accepted."""
    from certify.atlas.explain.explanation import BadOutline
    from certify.atlas.explain.outlines import lengths
    from certify.run import run

    if form not in ("text", "json"):
        fail(f"--all is printed as text or json, not as {form}", code=2)
    with progress() as show:
        outcome = run(root, report=show)
        accepted = [v.certificate for v in outcome.verdicts if v.fault is None and v.certificate]
        try:
            found = lengths(accepted, show)
        except BadOutline as error:
            fail(str(error), code=1)
    if form == "json":
        explanations = [own._asdict() for own in found]
        print_json({"explanations": explanations, "rejected": outcome.faults})
    else:
        rows = [
            (
                f"{own.pattern} {own.question}",
                own.steps,
                own.cases,
                ", ".join(f"{kind} {count}" for kind, count in own.kinds.items()),
            )
            for own in found
        ]
        print_table(("refutation", "steps", "cases", "other steps by reason"), rows)
        for fault in outcome.faults:
            click.echo(f"rejected: {printable(fault)}")
    exit_with(not outcome.faults)
