"""What the commands share: options, the root, errors of one line, and ways to print."""

# ruff: noqa: PLC0415 - the kernel (with it sympy) and rich are imported where they are needed

from __future__ import annotations

import shutil
import sys
import textwrap
from collections.abc import Callable, Iterable, Iterator, Sequence
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import TYPE_CHECKING, Any, NoReturn, TypeVar

import click

from certify.printable import printable

if TYPE_CHECKING:
    from click.shell_completion import CompletionItem

    from certify.kernel.check import Verdict
    from certify.kernel.theorems import Outcome
    from certify.opinions.second import Opinion

F = TypeVar("F", bound=Callable[..., Any])

root_option = click.option(
    "--root",
    type=click.Path(path_type=Path),
    metavar="DIR",
    help="Folder with certificates/ and proofs/; by default those that come with certify.",
)
json_option = click.option("--json", "as_json", is_flag=True, help="Print one JSON object.")
second_opinion_option = click.option(
    "--second-opinion",
    is_flag=True,
    help="Ask every accepted answer again, by other code and by other checkers.",
)


def _at_least_one(_context: click.Context, _parameter: click.Parameter, value: int) -> int:
    if value < 1:
        raise click.BadParameter("there must be at least one process.")
    return value


jobs_option = click.option(
    "-j",
    "--jobs",
    type=int,
    default=1,
    metavar="N",
    callback=_at_least_one,
    help="Number of processes (default 1, at most 61).",
)


def examples(*lines: str) -> str:
    """Return the end of a help page: examples, a line each."""
    return "\n".join(
        ("\b", "Example:" if len(lines) == 1 else "Examples:", *(f"  {line}" for line in lines))
    )


def require_pattern(name: str) -> str:
    """Return the name if it is one of the 174, else fail."""
    from certify.kernel.certificate import PATTERN_NAMES

    if name not in PATTERN_NAMES:
        fail(f"unknown pattern {name}; see 'certify list'", code=2)
    return name


def require_question(name: str) -> str:
    """Return the name if it is one of the three questions, else fail."""
    from certify.kernel.certificate import QUESTIONS

    if name not in QUESTIONS:
        fail(f"unknown question {name}; it must be one of {', '.join(QUESTIONS)}", code=2)
    return name


def _known(_context: click.Context, _parameter: click.Parameter, value: Any) -> Any:
    if value is None:
        return None
    if isinstance(value, str):
        return require_pattern(value)
    return tuple(map(require_pattern, value))


def _completed(
    _context: click.Context, _parameter: click.Parameter, incomplete: str
) -> list[str | CompletionItem]:
    from certify.kernel.certificate import PATTERN_NAMES

    return [name for name in PATTERN_NAMES if name.startswith(incomplete)]


def pattern_argument(name: str, **settings: Any) -> Callable[[F], F]:
    """Return an argument that takes names of patterns, which the shell completes."""
    return click.argument(name, callback=_known, shell_complete=_completed, **settings)


def fail(message: str, code: int) -> NoReturn:
    """Print one line on standard error, and exit."""
    with suppress(OSError):  # the exit code tells it too
        click.echo(f"certify: {printable(message)}", err=True)
    sys.exit(code)


def require_target(target: Path | None, source: Path | None) -> None:
    """Fail if a file to be written is a folder, or the file that is read."""
    if target is None:
        return
    if target.is_dir():
        fail(f"{target} is a folder", code=2)
    if source is not None and target.exists() and source.exists() and target.samefile(source):
        fail(f"{target} is the file that is read", code=2)


def exit_with(ok: bool) -> None:
    """Exit with code 1 unless all is well."""
    if not ok:
        sys.exit(1)


def existing_root(root: Path | None) -> Path:
    """Return the folder that was asked for, or the default, if it has certificates."""
    from certify.kernel.evidence import default_root

    folder = default_root() if root is None else root
    if not folder.is_dir():
        fail(f"{folder} is not a folder", code=2)
    if not (folder / "certificates").is_dir():
        fail(f"{folder} has no folder certificates", code=2)
    return folder


@contextmanager
def needing(extra: str) -> Iterator[None]:
    """Say how to install the libraries that an import in this block lacks."""
    try:
        yield
    except ImportError as error:
        if error.name is None or error.name.partition(".")[0] == "certify":
            raise
        fail(
            f"{error.name} is not installed: run pip install '.[{extra}]' in a checkout, "
            f"or pip install 'certify[{extra}]' where certify is on a package index",
            code=2,
        )


def print_json(record: dict[str, Any]) -> None:
    """Print an object as JSON."""
    from certify.report import json_text

    click.echo(json_text(record))


def print_wrapped(text: str, indent: str = "", hanging: str = "    ") -> None:
    """Print a paragraph, wrapped to the terminal, or to 80 columns where there is none."""
    click.echo(
        textwrap.fill(
            text,
            width=columns(),
            initial_indent=indent,
            subsequent_indent=indent + hanging,
            break_on_hyphens=False,
            break_long_words=False,
        )
    )


def columns() -> int:
    """Return how wide printed paragraphs are: at most 100 columns."""
    if not sys.stdout.isatty():
        return 80
    return max(40, min(shutil.get_terminal_size().columns, 100))


def verdict_line(verdict: Verdict) -> str:
    """Return a verdict in one line."""
    if verdict.fault is not None:
        return f"rejected: {verdict.fault}"
    answers = ", ".join(f"{question} {answer}" for question, answer in verdict.answers.items())
    return f"ok: {verdict.pattern}: {answers}"


@contextmanager
def progress() -> Iterator[Callable[[str, int, int], None]]:
    """Give a function to be told what is done, and how much of how much.

    It shows one live line on a terminal, and nothing elsewhere.
    """
    if not sys.stderr.isatty():
        yield lambda _what, _done, _total: None
        return
    from rich.console import Console
    from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn, TimeElapsedColumn

    columns = (
        TextColumn("{task.description}"),
        BarColumn(bar_width=30),
        MofNCompleteColumn(),
        TextColumn("{task.fields[rate]}"),
        TimeElapsedColumn(),
    )
    # Without auto_refresh there is no second thread when the checking processes are forked.
    with Progress(
        *columns, console=Console(stderr=True), transient=True, auto_refresh=False
    ) as live:
        task = live.add_task("", total=None, rate="")

        def show(what: str, done: int, total: int) -> None:
            per_second = done / (live.tasks[0].elapsed or 1)
            rate = f"{per_second:.0f}/s" if per_second >= 1 else f"{60 * per_second:.0f}/min"
            live.update(
                task, description=what, completed=done, total=total, rate=rate, refresh=True
            )

        yield show


@contextmanager
def status(what: str) -> Iterator[Callable[[str], None]]:
    """Give a function to be told what is going on; a terminal shows the latest in one live line."""
    if not sys.stderr.isatty():
        yield lambda _message: None
        return
    from rich.console import Console

    with Console(stderr=True).status(what) as live:
        yield live.update


def print_table(headings: Sequence[str], rows: Iterable[Sequence[object]], title: str = "") -> None:
    """Print a table, its first column left- and the others right-justified, and an empty line."""
    from rich import box
    from rich.console import Console
    from rich.table import Table

    table = Table(title=title or None, title_justify="left", box=box.SIMPLE_HEAD, pad_edge=False)
    for index, heading in enumerate(headings):
        table.add_column(heading, justify="right" if index else "left", overflow="fold")
    for row in rows:
        table.add_row(*map(str, row))
    console = Console(width=max(columns(), 80), markup=False, emoji=False, highlight=False)
    with console.capture() as printed:
        console.print(table)
    lines = [line.rstrip().removeprefix(" ") for line in printed.get().splitlines()]
    click.echo("\n".join([*filter(None, lines), ""]))


def plural(number: int, noun: str) -> str:
    """Return a number with its noun, which takes an s unless it is one."""
    return f"{number} {noun}" if number == 1 else f"{number} {noun}s"


def second_opinions(root: Path, outcome: Outcome, jobs: int) -> list[Opinion]:
    """Ask every opinion, with a live line."""
    from certify.opinions.second import second_opinions as ask

    with progress() as show:
        return ask(root, outcome, jobs, show)


def print_opinions(opinions: Sequence[Opinion]) -> None:
    """Print a line for every opinion, and one for everything on which it differs."""
    for opinion in opinions:
        agree = opinion.asked - len(opinion.faults)
        if opinion.absent:
            print_wrapped(f"did not run: {opinion.name}: {opinion.absent}")
        elif not opinion.asked:
            print_wrapped(f"not asked: {opinion.name}: {opinion.means}")
        else:
            status = "differs" if opinion.faults else "agrees"
            print_wrapped(f"{status}: {opinion.name}: {agree} of {opinion.asked}, {opinion.means}")
        for fault in opinion.faults:
            click.echo(f"differs: {opinion.name}: {fault}")


def print_manifest(manifest: dict[str, Any] | None) -> None:
    """Print one line if the files are as listed, and else a line for each that is not."""
    from certify.manifest import NAME

    if manifest is None:
        click.echo(f"no manifest: there is no {NAME} beside certificates/")
        return
    for fault in manifest["faults"]:
        click.echo(f"not as listed: {fault}")
    if not manifest["faults"]:
        other = "" if manifest["kernel"] else "; it does not speak of the kernel that runs"
        print_wrapped(f"manifest: {manifest['files']} files as listed{other}")
