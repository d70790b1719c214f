"""Commands for readers: explain, atlas."""

# ruff: noqa: PLC0415 - the kernel (with it sympy) is imported where it is needed

from __future__ import annotations

from pathlib import Path
from tempfile import TemporaryDirectory

import click

from certify.cli.common import (
    columns,
    examples,
    existing_root,
    fail,
    jobs_option,
    needing,
    pattern_argument,
    print_json,
    print_table,
    progress,
    require_question,
    root_option,
    verdict_line,
)
from certify.printable import printable


@click.command(
    epilog=examples(
        "certify explain 15_K valid",
        "certify explain 15_A realizable --format latex > 15_A.tex",
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
    """Explain why the answer to a question is no, in steps that a person can follow.

    QUESTION is realizable, convex or valid. Each step is a fact about one determinant, with its
    reason. What is printed has been replayed by the kernel, step by step, against its own formula.
    """
    from certify.atlas.explanation import BadOutline

    if every == bool(pattern) or bool(pattern) != bool(question):
        fail("name a pattern and a question, or else --all", code=2)
    try:
        if every:
            _print_lengths(existing_root(root), form)
        elif pattern and question:
            _explain(existing_root(root), pattern, require_question(question), form)
    except BadOutline as error:
        fail(str(error), code=1)


def _explain(root: Path, pattern: str, question: str, form: str) -> None:
    from certify.atlas.outlines import explained
    from certify.atlas.words import account, as_json, as_latex, as_markdown, as_text
    from certify.kernel.check import check_pattern

    verdict = check_pattern(root, pattern)
    if verdict.fault is not None or verdict.certificate is None:
        fail(verdict_line(verdict), code=1)
    if verdict.answers[question] != "no":
        answer = verdict.answers[question]
        fail(f"{pattern} {question} is answered by {answer}; only a no is explained", code=2)
    explanation = explained(verdict.certificate, question)
    told = account(explanation, pattern, question, verdict.certificate.tetrahedra)
    if form == "json":
        print_json(as_json(told))
    else:
        texts = {"text": lambda: as_text(told, columns())}
        texts |= {"markdown": lambda: as_markdown(told), "latex": lambda: as_latex(told)}
        click.echo(texts[form]())


def _print_lengths(root: Path, form: str) -> None:
    """Print a table, or an object, of the explanations of all refutations that are accepted."""
    from certify.atlas.outlines import lengths
    from certify.run import run

    if form not in ("text", "json"):
        fail(f"--all is printed as text or json, not as {form}", code=2)
    with progress() as show:
        verdicts = run(root, report=show).verdicts
        accepted = [v.certificate for v in verdicts if v.fault is None and v.certificate]
        found = lengths(accepted, show)
    if form == "json":
        print_json({"explanations": [own._asdict() for own in found]})
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


@click.command(epilog=examples("certify atlas --to site --jobs 2", "certify atlas --serve"))
@click.option(
    "--to", type=click.Path(path_type=Path), metavar="DIR", help="Folder to write the site to."
)
@click.option("--serve", is_flag=True, help="Show it to the browsers of this machine.")
@click.option(
    "--port", type=click.IntRange(0, 65535), default=8174, help="For --serve (default 8174)."
)
@jobs_option
@root_option
def atlas(to: Path | None, serve: bool, port: int, jobs: int, root: Path | None) -> None:
    """Write the atlas: a site with a page for every pattern.

    It opens from the disk, and needs no network. Everything is checked first; nothing is written
    unless all is accepted.
    """
    from certify.run import run

    if to is None and not serve:
        fail("nothing to do: give --to DIR, or --serve, or both", code=2)
    folder = existing_root(root)
    with needing("atlas"):
        from certify.atlas.site.build import write_site
    with TemporaryDirectory() as scratch:
        place = to or Path(scratch) / "atlas"
        with progress() as show:
            outcome = run(folder, jobs, show)
            if outcome.faults:
                fail(f"rejected: {outcome.faults[0]}", code=1)
            try:
                write_site(folder, outcome, place, jobs, show)
            except ValueError as error:  # no explanation, or a file that has changed
                fail(str(error), code=1)
        if to:
            click.echo(f"atlas: {printable(str(place / 'index.html'))}")
        if serve:
            _serve(place, port)


def _serve(folder: Path, port: int) -> None:
    from certify.atlas.site.serve import serving

    try:
        with serving(folder, port) as server:
            click.echo(f"atlas: http://127.0.0.1:{server.server_port}/ until it is interrupted")
            server.serve_forever()
    except OSError as error:
        fail(f"--port {port}: {error.strerror}", code=2)
