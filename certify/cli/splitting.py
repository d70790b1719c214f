"""The command that splits a mesh into tetrahedra: split."""

# ruff: noqa: PLC0415 - numba, meshio and pysat are imported where they are needed

from __future__ import annotations

from collections.abc import Callable, Sequence
from os.path import lexists
from pathlib import Path
from typing import TYPE_CHECKING

import click

from certify.cli.common import (
    examples,
    existing_root,
    exit_with,
    fail,
    json_option,
    needing,
    plural,
    print_json,
    print_table,
    print_wrapped,
    progress,
    root_option,
)
from certify.printable import printable

if TYPE_CHECKING:
    from certify.mesh.signs import Floats
    from certify.mesh.split import Answer
    from certify.mesh.split.contradictions import Contradiction
    from certify.mesh.split.tetrahedra import Shape

SHOWN = 10
"""So many cells that cannot be filled are printed; --json has all."""


@click.command(
    epilog=examples(
        "certify split part.vtu --to tetrahedra.vtu",
        "certify split part.msh --to tetrahedra.msh --quality best",
        "certify split part.vtk --proof contradictions",
    )
)
@click.argument("mesh", type=click.Path(path_type=Path))
@click.option(
    "--to",
    type=click.Path(path_type=Path),
    metavar="FILE",
    help="Write the tetrahedra; FILE ends in .vtu, .vtk, .msh or .mesh.",
)
@click.option(
    "--quality",
    default="greedy",
    metavar="HOW",
    help="Of many solutions: greedy (default), best or none.",
)
@click.option(
    "--proof",
    type=click.Path(path_type=Path),
    metavar="DIR",
    help="Write why cells contradict each other, as DIMACS and LRAT.",
)
@root_option
@json_option
def split(
    mesh: Path, to: Path | None, quality: str, proof: Path | None, root: Path | None, as_json: bool
) -> None:
    """Split hexahedra into tetrahedra: no new vertex, none inverted, all conforming.

    MESH has hexahedra, and perhaps wedges, pyramids and tetrahedra. Every quadrilateral gets one
    diagonal, the same for its two cells, so that every cell is filled by tetrahedra. Whether that
    is possible is decided exactly: by the complete list of triangulations of the hexahedron, and a
    SAT solver.

    Yes: tetrahedra that are checked from the definition, beside what a fixed recipe makes of the
    mesh. They have as data the number and the kind of their cell, and the pattern. The angles
    depend on --quality: "greedy" makes them large; with "best" no other diagonals have a larger
    least angle; "none" does not look at them. No file is replaced.

    No: the cells that no tetrahedra fill, and cells that contradict each other, none of them
    needlessly, with a proof that the kernel has replayed.

    Exit code 1: no; or the mesh is not what it should be.
    """
    from certify.kernel.evidence import Malformed

    folder = existing_root(root)
    with needing("mesh"):
        from certify.mesh.compiled import interruptible
        from certify.mesh.reading import BadMesh, read_mesh
        from certify.mesh.split import NotSplit
        from certify.mesh.split import split as answer
        from certify.mesh.split.solving import QUALITIES
    if quality not in QUALITIES:
        fail(f"unknown quality {quality}; it must be one of {', '.join(QUALITIES)}", code=2)
    if to is not None:
        _require_new(to)
    try:
        given = read_mesh(mesh)
        with progress() as show, interruptible():
            found = answer(given.points, given.cells, quality, folder, show)
    except BadMesh as error:
        message = str(error)
        fail(message if message.startswith(f"{mesh}: ") else f"{mesh}: {message}", code=1)
    except (Malformed, NotSplit) as error:
        fail(f"rejected: {error}", code=1)
    proofs = [_proof(own) for own in found.contradictions]
    written = to if found.tetrahedra is not None else None
    if written is not None:
        _write(written, found)
    if proof is not None and proofs:
        _write_proofs(proof, mesh, found, proofs)
    if as_json:
        from certify.mesh.split.reporting import record

        own = record(str(mesh), found, proofs, quality)
        print_json(own | {"written": None if written is None else str(written)})
    else:
        _print(mesh, found, proofs)
        if written is not None:
            click.echo(f"written, read back and compared: {printable(str(written))}")
        if proof is not None and proofs:
            click.echo(f"formulas and proofs: {printable(str(proof))}")
        elif proof is not None:
            click.echo("no cells contradict each other, so there is no proof to write")
    exit_with(found.tetrahedra is not None)


def _require_new(path: Path) -> None:
    """Fail unless tetrahedra can be written to a file, and there is none."""
    from certify.mesh.split.reporting import FORMATS

    if path.suffix.lower() not in FORMATS:
        fail(f"{path}: unknown ending; it must be one of {', '.join(FORMATS)}", code=2)
    if lexists(path):
        fail(f"{path} exists already, and no mesh replaces a file", code=2)


def _write(path: Path, found: Answer) -> None:
    from certify.mesh.files import NotExact
    from certify.mesh.split.reporting import write_tetrahedra
    from certify.writing import written_to

    try:
        with written_to(path.parent) as scratch:
            write_tetrahedra(scratch / path.name, found)
    except NotExact as error:
        fail(str(error), code=1)


def _proof(own: Contradiction) -> str:
    """Return a proof in the LRAT format, which the kernel has replayed."""
    from certify.kernel.refutation import NotRefuted, replay
    from certify.search.refutations import lrat, refute

    steps = refute(own.formula)
    text = lrat(steps or [])
    try:
        replay(own.formula, text)
    except NotRefuted as error:
        fail(f"rejected: the proof that cells contradict each other: {error}", code=1)
    return text


def _write_proofs(folder: Path, mesh: Path, found: Answer, proofs: Sequence[str]) -> None:
    """Write each formula with comments that say what it is about, and its proof."""
    from certify.dimacs import write_dimacs
    from certify.mesh.split.reporting import comments
    from certify.writing import write_files

    contents = {}
    for number, (own, proof) in enumerate(zip(found.contradictions, proofs, strict=True), start=1):
        legend = comments(printable(mesh.name), found, own)
        contents[f"contradiction-{number}.cnf"] = write_dimacs(own.formula, legend).encode()
        contents[f"contradiction-{number}.lrat"] = proof.encode()
    write_files(folder, contents)


def _print(mesh: Path, found: Answer, proofs: Sequence[str]) -> None:
    counts = [_count(len(rows), kind) for kind, rows in found.faces.cells.items()]
    sides = found.faces.sides
    outside = int((sides < 0).any(axis=1).sum()) if len(sides) else 0
    print_wrapped(
        f"{printable(str(mesh))}: {', '.join(counts)}; {_count(len(sides), 'quadrilateral')}, "
        f"{outside} of them outside"
    )
    click.echo()
    if found.tetrahedra is not None:
        _print_yes(found)
        return
    print_wrapped(
        "no: whatever diagonals are chosen, these cells cannot all be filled by tetrahedra "
        "without further vertices"
    )
    click.echo()
    from certify.mesh.split.contradictions import MANY

    if found.unfillable:
        _print_unfillable(found)
    for own, proof in zip(found.contradictions, proofs, strict=True):
        _print_contradiction(found, own, proof)
    if len(proofs) == MANY:
        click.echo(f"no more than {MANY} such sets are looked for; there may be others")
    click.echo()
    _print_table(found)


PLURALS = {"hexahedron": "hexahedra", "tetra": "tetrahedra", "tetrahedron": "tetrahedra"}


def _count(number: int, noun: str) -> str:
    """Return a number with its noun, which may have a plural of its own."""
    return f"{number} {PLURALS[noun]}" if noun in PLURALS and number != 1 else plural(number, noun)


def _print_yes(found: Answer) -> None:
    print_wrapped(
        "yes: with one diagonal for each quadrilateral every cell is filled by tetrahedra, all "
        "positively oriented. Checked from the definition, exactly."
    )
    click.echo()
    _print_table(found)
    click.echo()
    if found.patterns:
        names = ", ".join(f"{name} {number}" for name, number in found.patterns.items())
        print_wrapped(f"patterns of the hexahedra: {names}")
    if laid := found.laid:
        print_wrapped(
            f"with {_count(laid, 'tetrahedron')} laid on them, on the four vertices of a "
            "quadrilateral each"
        )


def _print_table(found: Answer) -> None:
    """Print what fixed recipes give, beside what was found."""
    columns = {"by numbers": found.by_numbers, "by template": found.by_template}
    if found.shape is not None:
        columns = {"this split": found.shape, **columns}
    rows = [[name, *map(value, columns.values())] for name, value in _ROWS.items()]
    print_table(("", *columns), rows)
    print_wrapped(
        "By numbers: each quadrilateral is cut at its vertex with the least number, and each cell "
        f"is the cone of that vertex. {_beyond(found)}"
    )
    print_wrapped(
        "By template: all cells of a kind are cut alike, hexahedra into six tetrahedra around the "
        "diagonal from their first vertex to their seventh."
    )


def _least(values: Floats, form: str) -> str:
    return format(values.min(), form) if len(values) else "-"


_ROWS: dict[str, Callable[[Shape], object]] = {
    "tetrahedra": lambda own: own.tetrahedra,
    "  inverted or flat": lambda own: own.not_positive,
    "  cells with such": lambda own: own.cells,
    "quadrilaterals cut in two ways": lambda own: own.disagreements,
    "least dihedral angle": lambda own: (
        "inverted" if own.not_positive else f"{_least(own.angles, '.2f')}°"
    ),
    "least mean ratio": lambda own: "inverted" if own.not_positive else _least(own.ratios, ".4f"),
}


def _beyond(found: Answer) -> str:
    """Say how many cells the diagonals by numbers leave without a filling."""
    number = found.beyond_numbers
    if not number:
        return "These diagonals leave no cell without a filling."
    cells = "1 cell" if number == 1 else f"{number} cells"
    return f"With these diagonals no tetrahedra at all fill {cells}."


def _print_unfillable(found: Answer) -> None:
    number = len(found.unfillable)
    what = "1 cell" if number == 1 else f"{number} cells, each by itself"
    print_wrapped(f"no tetrahedra fill {what}:")
    for cell in found.unfillable[:SHOWN]:
        print_wrapped(_unfillable(found, cell), indent="  ")
    if number > SHOWN:
        click.echo(f"  and {number - SHOWN} more, which --json lists")


def _unfillable(found: Answer, cell: int) -> str:
    own = found.why(cell)
    vertices = " ".join(str(vertex + 1) for vertex in own.corners)
    where = f"; inverted or flat at {'vertices' if ' ' in vertices else 'vertex'} {vertices}"
    if own.crossing == own.boundaries:
        reason = "its surface crosses itself however it is cut"
    elif own.crossing:
        reason = f"its surface crosses itself in {own.crossing} of {own.boundaries} ways to cut it"
    else:
        reason = f"in none of {own.boundaries} ways to cut it"
    return f"{found.faces.name(cell)}: {reason}{where if vertices else ''}"


def _print_contradiction(found: Answer, own: Contradiction, proof: str) -> None:
    names = ", ".join(found.faces.name(cell) for cell in own.cells)
    what = "no fewer cells do" if own.smallest else "without any of them the others do not"
    print_wrapped(
        f"{len(own.cells)} cells contradict each other: {names} ({what}; the kernel replayed the "
        f"proof, {plural(len(proof.splitlines()), 'step')})"
    )
