"""The command that writes the evidence for other programs: export."""

# ruff: noqa: PLC0415 - the kernel (with it sympy) and meshio are imported where they are needed

from __future__ import annotations

from collections.abc import Mapping
from os.path import lexists
from pathlib import Path
from typing import TYPE_CHECKING

import click

from certify.cli.common import (
    examples,
    existing_root,
    fail,
    needing,
    progress,
    require_pattern,
    require_question,
    root_option,
    verdict_line,
)
from certify.printable import printable

if TYPE_CHECKING:
    from certify.kernel.check import Verdict
    from certify.mesh.files import Model

USES = {
    "--all": ({"--to"}, {"--format", "--hexahedron"}),
    "--mesh": ({"PATTERN"}, {"QUESTION", "--hexahedron"}),
    "PATTERN": ({"QUESTION", "--to"}, {"--core", "--plain"}),
}
"""What export is for -> what must be given with it, and what may be. The first use counts."""


def _require_use(given: set[str]) -> None:
    """Raise a usage error unless these arguments and options go together."""
    use = next((name for name in USES if name in given), "PATTERN")
    needed, allowed = USES[use]
    missing = [name for name in ("PATTERN", "QUESTION", "--to") if name in {use, *needed} - given]
    if missing:
        raise click.UsageError(f"Missing {', '.join(missing)}")
    if surplus := sorted(given - needed - allowed - {use}):
        raise click.UsageError(f"{surplus[0]} cannot be used with {use}")


@click.command(
    epilog=examples(
        "certify export 15_A realizable --to out",
        "certify export complete g --core --to out",
        "certify export 8_E --mesh 8_E.vtu",
        "certify export --all --to meshes --format msh",
    )
)
@click.argument("pattern", required=False)
@click.argument(
    "question", required=False, shell_complete=lambda *_: ["realizable", "convex", "valid"]
)
@click.option("--to", type=click.Path(path_type=Path), metavar="DIR", help="Folder to write to.")
@click.option("--core", is_flag=True, help="Of a formula only the clauses that its proof names.")
@click.option("--plain", is_flag=True, help="No comments, for programs that cannot read them.")
@click.option(
    "--mesh",
    type=click.Path(path_type=Path),
    metavar="FILE",
    help="Write a mesh; FILE ends in .vtu, .vtk, .msh, .mesh, .obj or .stl.",
)
@click.option("--hexahedron", is_flag=True, help="The hexahedron as one cell, and no tetrahedra.")
@click.option("--all", "every", is_flag=True, help="Write a mesh of every realizable pattern.")
@click.option("--format", "ending", metavar="ENDING", help="Of all these files (default vtu).")
@root_option
def export(
    pattern: str | None,
    question: str | None,
    to: Path | None,
    core: bool,
    plain: bool,
    mesh: Path | None,
    hexahedron: bool,
    every: bool,
    ending: str | None,
    root: Path | None,
) -> None:
    """Write the evidence for one answer for other programs.

    Nothing is written unless the kernel accepts it.

    QUESTION is realizable, convex or valid. For a no: the refuted formula as DIMACS, with the proof
    as LRAT and as DRAT. For a yes: the points and the tetrahedra as JSON, each tetrahedron with
    its vertices in an order in which its volume is positive.

    With "complete" for PATTERN and a letter a..g for QUESTION: the formula and the proofs that no
    pattern with this type of boundary is missing.

    With --mesh, the points of a yes become a mesh, by meshio; without a QUESTION those of the
    strongest yes: valid, else convex, else realizable. Coordinates are integers. Tetrahedra have
    their type as data, the triangles of the boundary their facet; the file says which is which.
    OBJ and STL hold the boundary alone. No file is replaced.
    """
    given: Mapping[str, object] = {
        "PATTERN": pattern,
        "QUESTION": question,
        "--to": to,
        "--core": core,
        "--plain": plain,
        "--mesh": mesh,
        "--hexahedron": hexahedron,
        "--all": every,
        "--format": ending,
    }
    _require_use({name for name, value in given.items() if value not in (None, False)})
    folder = existing_root(root)
    if every and to is not None:
        _export_all_meshes(folder, to, f".{(ending or 'vtu').removeprefix('.')}", hexahedron)
    elif mesh is not None and pattern is not None:
        _export_mesh(folder, pattern, question, mesh, hexahedron)
    elif to is not None and pattern is not None and question is not None:
        _export_evidence(folder, pattern, question, to, core, plain)


def _export_evidence(
    root: Path, pattern: str, question: str, to: Path, core: bool, plain: bool
) -> None:
    from certify.kernel.evidence import Malformed

    try:
        if pattern == "complete":
            written = _export_completeness(root, question, to, core, plain)
        else:
            written = _export_answer(root, pattern, question, to, core, plain)
    except Malformed as error:
        fail(f"rejected: {error}", code=1)
    for path in written:
        click.echo(f"{pattern} {question}: {printable(str(path))}")


def _export_completeness(root: Path, letter: str, to: Path, core: bool, plain: bool) -> list[Path]:
    from certify.export import export_completeness
    from certify.kernel.hexahedron import BOUNDARY_TYPES
    from certify.run import run

    if letter not in BOUNDARY_TYPES:
        fail(f"unknown boundary type {letter}; it must be one of a to g", code=2)
    outcome = run(root)
    if outcome.faults:
        fail(f"rejected: {outcome.faults[0]}", code=1)
    return export_completeness(root, outcome, letter, to, core, plain)


def _export_answer(
    root: Path, name: str, question: str, to: Path, core: bool, plain: bool
) -> list[Path]:
    from certify.export import export_answer
    from certify.kernel.check import check_pattern

    pattern = require_pattern(name)
    require_question(question)
    verdict = check_pattern(root, pattern)
    if verdict.fault is not None or verdict.certificate is None:
        fail(verdict_line(verdict), code=1)
    if verdict.answers[question] == "open":
        fail(f"{pattern} {question} is open: there is nothing to export", code=2)
    return export_answer(root, verdict.certificate, question, to, core, plain)


def _export_mesh(root: Path, name: str, question: str | None, path: Path, hexahedron: bool) -> None:
    from certify.kernel.check import check_pattern
    from certify.mesh.files import model

    pattern = require_pattern(name)
    if question is not None:
        require_question(question)
    _require_format(path.suffix, f"{path}: unknown ending", hexahedron)
    _require_new(path)
    verdict = check_pattern(root, pattern)
    if verdict.fault is not None:
        fail(verdict_line(verdict), code=1)
    asked = question or _strongest(verdict)
    if verdict.answers[asked] != "yes":
        fail(
            f"{pattern} {asked} is {verdict.answers[asked]}: there are no points to export", code=2
        )
    _write_meshes(path.parent, {path.name: model(verdict, asked, hexahedron)})


def _export_all_meshes(root: Path, to: Path, ending: str, hexahedron: bool) -> None:
    from certify.kernel.certificate import PATTERN_NAMES
    from certify.kernel.check import check_pattern
    from certify.mesh.files import model

    _require_format(ending, f"unknown format {ending.removeprefix('.')}", hexahedron)
    for pattern in PATTERN_NAMES:
        _require_new(to / f"{pattern}{ending}")
    shown, without = {}, []
    with progress() as show:
        for done, pattern in enumerate(PATTERN_NAMES, start=1):
            verdict = check_pattern(root, pattern)
            if verdict.fault is not None:
                fail(verdict_line(verdict), code=1)
            show("checking", done, len(PATTERN_NAMES))
            asked = _strongest(verdict)
            if verdict.answers[asked] == "yes":
                shown[f"{pattern}{ending}"] = model(verdict, asked, hexahedron)
            else:
                without.append(f"{pattern} {asked}: {verdict.answers[asked]}, so there is no mesh")
    _write_meshes(to, shown)
    for line in without:
        click.echo(line)


def _require_format(ending: str, fault: str, hexahedron: bool) -> None:
    """Fail unless files with this ending can be written, and hold what is to be shown."""
    from certify.mesh.files import FORMATS

    if ending not in FORMATS:
        fail(f"{fault}; it must be one of {', '.join(FORMATS)}", code=2)
    if hexahedron and not FORMATS[ending].solid:
        fail(f"{ending} files have no cells like a hexahedron", code=2)
    with needing("mesh"):
        import meshio  # noqa: F401 - before anything is checked


def _require_new(path: Path) -> None:
    if lexists(path):
        fail(f"{path} exists already, and no mesh replaces a file", code=2)


def _strongest(verdict: Verdict) -> str:
    """Return the question whose points are the default: the last with a yes, else the first."""
    from certify.kernel.certificate import QUESTIONS

    return next((q for q in reversed(QUESTIONS) if verdict.answers[q] == "yes"), QUESTIONS[0])


def _write_meshes(folder: Path, shown: Mapping[str, Model]) -> None:
    """Write all files, or none of them, and say what they show."""
    from certify.mesh.files import NotExact, write_mesh
    from certify.writing import written_to

    try:
        with written_to(folder) as scratch:
            for name, mesh in shown.items():
                write_mesh(scratch / name, mesh)
    except NotExact as error:
        fail(str(error), code=1)
    for name, mesh in shown.items():
        click.echo(f"{mesh.pattern} {mesh.question}: {printable(str(folder / name))}")
