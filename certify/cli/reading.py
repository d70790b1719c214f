"""Commands for readers: explain."""

# ruff: noqa: PLC0415 - the kernel (with it sympy) is imported where it is needed

from __future__ import annotations

from pathlib import Path

import click

from certify.cli.common import (
    columns,
    examples,
    existing_root,
    fail,
    pattern_argument,
    print_json,
    require_question,
    root_option,
    verdict_line,
)


@click.command(
    epilog=examples(
        "certify explain 15_K valid", "certify explain 15_A realizable --format latex > 15_A.tex"
    )
)
@pattern_argument("pattern")
@click.argument("question", shell_complete=lambda *_: ["realizable", "convex", "valid"])
@click.option(
    "--format",
    "form",
    type=click.Choice(("text", "markdown", "latex", "json")),
    default="text",
    help="What to print (default text).",
)
@root_option
def explain(pattern: str, question: str, form: str, root: Path | None) -> None:
    """Explain why the answer to a question is no, in steps that a person can follow.

    QUESTION is realizable, convex or valid. Each step is a fact about one determinant, with its
    reason. What is printed has been replayed by the kernel, step by step, against its own formula.
    """
    from certify.atlas.explanation import BadOutline
    from certify.atlas.outlines import explained
    from certify.atlas.words import account, as_json, as_latex, as_markdown, as_text
    from certify.kernel.check import check_pattern

    require_question(question)
    verdict = check_pattern(existing_root(root), pattern)
    if verdict.fault is not None or verdict.certificate is None:
        fail(verdict_line(verdict), code=1)
    if verdict.answers[question] != "no":
        answer = verdict.answers[question]
        fail(f"{pattern} {question} is answered by {answer}; only a no is explained", code=2)
    try:
        explanation = explained(verdict.certificate, question)
    except BadOutline as error:
        fail(str(error), code=1)
    told = account(explanation, pattern, question, verdict.certificate.tetrahedra)
    if form == "json":
        print_json(as_json(told))
    else:
        texts = {"text": lambda: as_text(told, columns())}
        texts |= {"markdown": lambda: as_markdown(told), "latex": lambda: as_latex(told)}
        click.echo(texts[form]())
