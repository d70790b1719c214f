"""The command line: parse, call, print. What is true is decided in certify/kernel alone."""

# ruff: noqa: PLC0415 - the kernel (with it sympy) and rich's tables are imported where needed

from __future__ import annotations

import json
import sys
from collections.abc import Iterable, Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from time import perf_counter
from typing import TYPE_CHECKING, Annotated, Any, NoReturn

import typer
from typer.core import TyperGroup

from certify import __version__

if TYPE_CHECKING:
    from rich.console import Console
    from rich.table import Table

    from certify.audit import Finding
    from certify.kernel.check import Verdict


def main() -> None:
    """Run the command line; whatever a terminal cannot show is written as an escape."""
    for stream in (sys.stdout, sys.stderr):
        if hasattr(stream, "reconfigure"):
            stream.reconfigure(errors="backslashreplace")
    try:
        app(prog_name="certify")
    except KeyboardInterrupt:
        sys.exit(130)


class _Guarded(TyperGroup):
    """Commands that end with one line, and not a traceback, when they cannot go on."""

    def invoke(self, ctx: Any) -> Any:
        try:
            return super().invoke(ctx)
        except KeyboardInterrupt:
            typer.echo("certify: interrupted", err=True)
            raise typer.Exit(130) from None
        except BrokenPipeError:
            raise
        except OSError as error:
            _fail(str(error), code=2)


def _fail(message: str, code: int) -> NoReturn:
    from certify.locate import printable

    typer.echo(f"certify: {printable(message)}", err=True)
    raise typer.Exit(code)


app = typer.Typer(
    cls=_Guarded, pretty_exceptions_enable=False, no_args_is_help=True, add_completion=False
)

RootOption = Annotated[
    Path | None,
    typer.Option("--root", metavar="DIR", help="Folder that holds certificates/ and proofs/."),
]
JsonOption = Annotated[bool, typer.Option("--json", help="Print one JSON object.")]
JobsOption = Annotated[int, typer.Option("--jobs", min=1, metavar="N", help="Processes to use.")]
PatternArgument = Annotated[str, typer.Argument(metavar="PATTERN", help="A name like 15_A.")]


def _print_version(wanted: bool) -> None:
    if wanted:
        typer.echo(f"certify {__version__}")
        raise typer.Exit


@app.callback(epilog="Example: certify check-all --jobs 4")
def _certify(
    version: Annotated[
        bool,
        typer.Option("--version", is_eager=True, callback=_print_version, help="Print version."),
    ] = False,
) -> None:
    """Exact audit of the 174 subdivisions of the hexahedron into tetrahedra.

    Exit code 0: all is accepted; 1: something was rejected; 2: it was asked wrongly.
    """


@app.command(epilog="Example: certify check 15_A 15_B")
def check(
    patterns: Annotated[list[str], typer.Argument(metavar="PATTERN...", help="Names like 15_A.")],
    root: RootOption = None,
    as_json: JsonOption = False,
) -> None:
    """Check the certificates of some patterns."""
    from certify import locate

    folder = _existing_root(root)
    _require_patterns(patterns)
    verdicts = list(locate.verdicts(folder, patterns))
    ok = all(verdict.fault is None for verdict in verdicts)
    if as_json:
        from certify.export import verdict_record

        _print_json({"ok": ok, "patterns": list(map(verdict_record, verdicts))})
    else:
        for verdict in verdicts:
            typer.echo(_verdict_line(verdict))
    _exit(ok)


@app.command(epilog="Example: certify check-all --jobs 4 --junit report.xml")
def check_all(
    jobs: JobsOption = 1,
    root: RootOption = None,
    as_json: JsonOption = False,
    junit: Annotated[
        typer.FileBinaryWrite | None,
        typer.Option(lazy=False, metavar="FILE", help="Write a report as JUnit XML."),
    ] = None,
) -> None:
    """Check every certificate, and the theorems that they prove together."""
    start = perf_counter()
    from certify import export, locate
    from certify.kernel.certificate import PATTERN_NAMES
    from certify.kernel.theorems import theorems

    folder = _existing_root(root)
    checking = locate.verdicts(folder, PATTERN_NAMES, jobs)
    verdicts = list(_with_progress(checking, len(PATTERN_NAMES)))
    completeness = locate.completeness(folder, verdicts)
    verdicts += locate.strays(folder)
    proved = theorems(verdicts, completeness)
    outcome = (verdicts, completeness, proved, perf_counter() - start)
    summary = export.summary(*outcome)
    if junit:
        junit.write(export.junit(*outcome))
    if as_json:
        _print_json(summary)
    else:
        _print_summary(summary, verdicts)
    _exit(summary["ok"])


@app.command("list", epilog="Example: certify list --json")
def list_(root: RootOption = None, as_json: JsonOption = False) -> None:
    """List the patterns and the answers that their certificates claim, without checking them."""
    from certify import export, locate
    from certify.kernel.certificate import PATTERN_NAMES
    from certify.kernel.check import Verdict

    folder = _existing_root(root)
    readings = [locate.read(folder, pattern) for pattern in PATTERN_NAMES]
    rejected = [reading for reading in readings if isinstance(reading, Verdict)]
    claims = [export.claim_record(r) for r in readings if not isinstance(r, Verdict)]
    note = "as claimed; check-all decides"
    if as_json:
        _print_json({"note": note, "patterns": claims, "rejected": export.rejections(rejected)})
    else:
        _print_claims(claims, note)
        for verdict in rejected:
            typer.echo(_verdict_line(verdict))
    _exit(not rejected)


@app.command(epilog="Example: certify show 8_E")
def show(pattern: PatternArgument, root: RootOption = None, as_json: JsonOption = False) -> None:
    """Show a certificate with its evidence, and the verdict on it."""
    from certify import export, locate
    from certify.kernel.check import Verdict

    folder = _existing_root(root)
    _require_patterns([pattern])
    verdict = locate.verdict(folder, pattern)
    certificate = locate.read(folder, pattern)
    record = None
    if not isinstance(certificate, Verdict):
        record = export.certificate_record(certificate, folder)
    if as_json:
        _print_json({"certificate": record, "verdict": export.verdict_record(verdict)})
    else:
        if record:
            _print_certificate(record)
        typer.echo(f"verdict: {_verdict_line(verdict)}")
    _exit(verdict.fault is None)


@app.command("export", epilog="Example: certify export 15_A realizable --to /tmp")
def export_(
    pattern: Annotated[str, typer.Argument(metavar="PATTERN", help='A name, or "complete".')],
    question: Annotated[
        str, typer.Argument(metavar="QUESTION", help="realizable, convex, valid; or a letter a..g.")
    ],
    to: Annotated[Path, typer.Option(metavar="DIR", help="Folder to write to.")],
    root: RootOption = None,
) -> None:
    """Write the evidence for one answer, if it is accepted, in formats that other programs read.

    For a no: the refuted formula as DIMACS, with the proof as LRAT and as DRAT. For a yes: the
    points and the tetrahedra as JSON. "complete" with a letter: the formula and the proofs that
    no pattern with this type of boundary is missing.
    """
    from certify import locate
    from certify.kernel.certificate import Malformed

    folder = _existing_root(root)
    try:
        if pattern == "complete":
            written = _export_completeness(folder, question, to)
        else:
            written = _export_answer(folder, pattern, question, to)
    except Malformed as error:
        _fail(f"rejected: {error}", code=1)
    for path in written:
        typer.echo(f"{pattern} {question}: {locate.printable(str(path))}")


def _export_completeness(root: Path, letter: str, to: Path) -> list[Path]:
    from certify import export, locate
    from certify.kernel.certificate import PATTERN_NAMES
    from certify.kernel.hexahedron import BOUNDARY_TYPES

    if letter not in BOUNDARY_TYPES:
        _fail(f"{letter} is no boundary type; these are: {', '.join(BOUNDARY_TYPES)}", code=2)
    verdicts = list(locate.verdicts(root, PATTERN_NAMES))
    faults = export.faults(verdicts) + export.faults(locate.completeness(root, verdicts))
    if faults:
        _fail(f"rejected: {faults[0]}", code=1)
    return export.export_completeness(root, letter, verdicts, to)


def _export_answer(root: Path, pattern: str, question: str, to: Path) -> list[Path]:
    from certify import export, locate
    from certify.kernel.certificate import QUESTIONS
    from certify.kernel.check import Verdict

    _require_patterns([pattern])
    if question not in QUESTIONS:
        _fail(f"{question} is no question; these are: {', '.join(QUESTIONS)}", code=2)
    verdict = locate.verdict(root, pattern)
    certificate = locate.read(root, pattern)
    if verdict.fault is not None or isinstance(certificate, Verdict):
        _fail(_verdict_line(verdict), code=1)
    if verdict.answers[question] == "open":
        _fail(f"{pattern} {question} is open: there is nothing to export", code=2)
    return export.export_answer(root, certificate, question, to)


@app.command(epilog="Example: certify audit --json")
def audit(root: RootOption = None, jobs: JobsOption = 1, as_json: JsonOption = False) -> None:
    """Go through the paper, from abstract to discussion, with a verdict on every claim.

    Exit code 1 only if a certificate was rejected: then claims that rest on it are not decided.
    """
    from dataclasses import asdict

    from certify import export, locate
    from certify.audit import audit as findings_of
    from certify.audit import summary
    from certify.kernel.certificate import PATTERN_NAMES

    folder = _existing_root(root)
    verdicts = list(
        _with_progress(locate.verdicts(folder, PATTERN_NAMES, jobs), len(PATTERN_NAMES))
    )
    completeness = locate.completeness(folder, verdicts)
    findings = findings_of(verdicts, completeness)
    faults = export.faults(verdicts) + export.faults(completeness)
    if as_json:
        record = {"summary": summary(findings), "findings": list(map(asdict, findings))}
        _print_json(record | {"rejected": faults})
    else:
        for fault in faults:
            typer.echo(f"rejected: {fault}")
        _print_findings(findings)
    _exit(not faults)


@app.command(epilog="Example: certify build --jobs 2 --root found")
def build(jobs: JobsOption = 1, root: RootOption = None) -> None:
    """Find all certificates and proofs again, and put them in the place of the old ones.

    They prove nothing until they are checked.
    """
    from certify.locate import default_root

    if root is None and default_root().name == "data":
        _fail("an installed package keeps its certificates: give --root DIR", code=2)
    folder = _existing_root(root, empty=True)
    with _needing_search():
        from certify.search.build import build as find
    find(folder, jobs, _report)


@app.command(epilog="Example: certify spheres")
def spheres(as_json: JsonOption = False) -> None:
    """Derive the 174 patterns once more, as the paper does: from the 3-spheres with nine vertices.

    Also tests what the paper says of decomposition graphs. A second opinion: no theorem needs it.
    """
    with _needing_search():
        from certify.search.decomposition import second_derivation
    found = second_derivation(_report)
    findings = [
        {"id": name, "sentence": finding.sentence, "counterexamples": len(finding.counterexamples)}
        for name, finding in found.findings.items()
    ]
    if as_json:
        counts = {"spheres": found.spheres, "classes": len(found.hexahedra), "graphs": found.graphs}
        _print_json(counts | {"agrees": found.agrees, "findings": findings})
    else:
        for finding in findings:
            exceptions = finding["counterexamples"]
            status = f"false, {exceptions} counterexamples" if exceptions else "true"
            typer.echo(f"{status}: {finding['sentence']}")
        typer.echo(
            f"{'ok' if found.agrees else 'not ok'}: {found.spheres} spheres with nine vertices, "
            f"{len(found.hexahedra)} classes of hexahedra, {found.graphs} of decomposition graphs"
        )
    _exit(found.agrees)


@contextmanager
def _needing_search() -> Iterator[None]:
    try:
        yield
    except ImportError as error:
        _fail(f"{error.name or error} cannot be imported: install certify[search]", code=2)


def _report(message: str) -> None:
    from certify.locate import printable

    typer.echo(printable(message), err=True)


def _existing_root(root: Path | None, *, empty: bool = False) -> Path:
    """Return the folder that was asked for, or the default; unless ``empty``, it has contents."""
    from certify.locate import default_root

    folder = default_root() if root is None else root
    if not folder.is_dir():
        _fail(f"{folder} is not a folder", code=2)
    if not empty and not (folder / "certificates").is_dir():
        _fail(f"{folder} has no folder certificates", code=2)
    return folder


def _require_patterns(patterns: Iterable[str]) -> None:
    from certify.kernel.certificate import PATTERN_NAMES

    for pattern in patterns:
        if pattern not in PATTERN_NAMES:
            _fail(f"{pattern} is no pattern; certify list lists them", code=2)


def _exit(ok: bool) -> None:
    if not ok:
        raise typer.Exit(1)


def _print_json(record: dict[str, Any]) -> None:
    typer.echo(json.dumps(record, indent=2))


def _verdict_line(verdict: Verdict) -> str:
    if verdict.fault is not None:
        return f"rejected: {verdict.fault}"
    answers = ", ".join(f"{question} {answer}" for question, answer in verdict.answers.items())
    return f"{verdict.pattern}: {answers}"


def _with_progress(verdicts: Iterable[Verdict], total: int) -> Iterable[Verdict]:
    """Yield the verdicts, with a bar on standard error if that is a terminal."""
    if not sys.stderr.isatty():
        return verdicts
    from rich.console import Console
    from rich.progress import track

    # Without auto_refresh there is no second thread when the checking processes are forked.
    return track(
        verdicts,
        "checking",
        total=total,
        console=Console(stderr=True),
        transient=True,
        auto_refresh=False,
    )


def _console() -> Console:
    """Return a console that takes text as it is, and is wide enough for the tables."""
    from rich.console import Console

    console = Console(markup=False, emoji=False, highlight=False)
    console.width = max(console.width, 80)
    return console


def _table(*headings: str, title: str | None = None) -> Table:
    """Return an empty table, its first column left- and the others right-justified."""
    from rich import box
    from rich.table import Table

    table = Table(title=title, title_justify="left", box=box.SIMPLE_HEAD, pad_edge=False)
    for index, heading in enumerate(headings):
        table.add_column(heading, justify="right" if index else "left", overflow="fold")
    return table


def _print_summary(summary: dict[str, Any], verdicts: Sequence[Verdict]) -> None:
    for rejection in summary["rejected"]:
        typer.echo(f"rejected: {rejection['fault']}")
    _print_counts([verdict for verdict in verdicts if verdict.fault is None])
    questions = [f"{pattern} {question}" for pattern, question in summary["open"]]
    if questions:
        typer.echo(f"open: {', '.join(questions)}")
    for theorem in summary["theorems"]:
        status = "ok" if theorem["ok"] else "not shown"
        typer.echo(f"{status}: {theorem['id']}: {theorem['statement']}")
    shown = sum(theorem["ok"] for theorem in summary["theorems"])
    typer.echo(
        f"{'ok' if summary['ok'] else 'not ok'}: {summary['patterns']} accepted, "
        f"{len(summary['rejected'])} rejected, {len(questions)} open, "
        f"{shown} of {len(summary['theorems'])} theorems shown, {summary['seconds']:.1f} s"
    )


def _print_counts(accepted: Sequence[Verdict]) -> None:
    """Print the paper's Table 1 as far as the accepted certificates show it."""
    from certify.export import count
    from certify.kernel.certificate import PATTERN_COUNTS, QUESTIONS

    table = _table("tetrahedra", *map(str, PATTERN_COUNTS), "Sum")

    def add(name: str, sizes: Iterable[int]) -> None:
        row = list(sizes)
        table.add_row(name, *map(str, [*row, sum(row)]))

    by_size = [[v for v in accepted if v.size == size] for size in PATTERN_COUNTS]
    add("combinatorial", map(len, by_size))
    for question in QUESTIONS:
        add(question, (count(group, question, "yes") for group in by_size))
    if any(count(accepted, question, "open") for question in QUESTIONS):
        add("open", (sum(count(group, q, "open") for q in QUESTIONS) for group in by_size))
    _console().print(table)


def _print_findings(findings: Sequence[Finding]) -> None:
    from certify.audit import summary

    for finding in findings:
        typer.echo(f"{finding.verdict}: {finding.id} ({finding.place})")
        typer.echo(f"    {finding.claim}")
        if finding.truth:
            typer.echo(f"    In truth: {finding.truth}")
        typer.echo(f"    Evidence: {'; '.join(finding.evidence)}")
    counts = ", ".join(f"{number} {verdict}" for verdict, number in summary(findings).items())
    typer.echo(f"{len(findings)} claims: {counts}")


def _print_claims(records: Sequence[dict[str, Any]], note: str) -> None:
    headings = ("pattern", "tetrahedra", "boundary", "instances", "realizable", "convex", "valid")
    table = _table(*headings, title=note)
    for record in records:
        table.add_row(*(str(record[heading]) for heading in headings))
    _console().print(table)


def _print_certificate(record: dict[str, Any]) -> None:
    from certify.kernel.certificate import QUESTIONS

    tetrahedra = ["".join(map(str, tetrahedron)) for tetrahedron in record["tetrahedra"]]
    typer.echo(
        f"{record['pattern']}: {len(tetrahedra)} tetrahedra, boundary {record['boundary']}, "
        f"{record['instances']} instances"
    )
    typer.echo(f"tetrahedra: {' '.join(tetrahedra)}")
    for question in QUESTIONS:
        evidence = record[question]
        points = evidence.get("points")
        first = next(q for q in QUESTIONS if record[q].get("points") == points)
        typer.echo(f"{question}: {evidence['answer']}{_shown_by(evidence, first, question)}")
        if points and first == question:
            _print_points(points)
        if "scaled_jacobians" in evidence:
            scaled = " ".join(f"{value:.3f}" for value in evidence["scaled_jacobians"])
            typer.echo(f"Jacobian at least {evidence['jacobian_at_least']} on the closed cube")
            typer.echo(f"scaled Jacobian at the vertices 1..8: {scaled}")


def _shown_by(evidence: dict[str, Any], first: str, question: str) -> str:
    """Return what shows an answer; ``first`` is the first question that has the same points."""
    if "points" in evidence:
        return ", by points:" if first == question else f", by the points of {first}"
    if "proof" in evidence:
        lemmas = "?" if evidence["lemmas"] is None else evidence["lemmas"]
        polynomials = evidence["final_polynomials"]
        return f", by {evidence['proof']}: {lemmas} lemmas, {polynomials} final polynomials"
    return ""


def _print_points(points: Sequence[Sequence[int | str]]) -> None:
    table = _table("vertex", "x", "y", "z")
    for vertex, point in enumerate(points, start=1):
        table.add_row(str(vertex), *map(str, point))
    _console().print(table)
