"""The command that splits a mesh into tetrahedra: split."""

# ruff: noqa: PLC0415 - numba, meshio and pysat are imported where they are needed

from __future__ import annotations

from collections.abc import Sequence
from os.path import lexists
from pathlib import Path
from typing import TYPE_CHECKING, Any

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
    from certify.mesh.split import Answer
    from certify.mesh.split.contradictions import Contradiction
    from certify.mesh.split.tetrahedra import Shape

Record = dict[str, Any]

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

    No: the cells that no tetrahedra fill, or a smallest set of cells that contradict each other,
    with a proof that the kernel has replayed.

    Exit code 1: no; or the mesh is not what it should be.
    """
    folder = existing_root(root)
    with needing("mesh"):
        from certify.mesh.reading import BadMesh, read_mesh
        from certify.mesh.split import split as answer
        from certify.mesh.split.solving import QUALITIES
    if quality not in QUALITIES:
        fail(f"unknown quality {quality}; it must be one of {', '.join(QUALITIES)}", code=2)
    if to is not None:
        _require_new(to)
    try:
        given = read_mesh(mesh)
        with progress() as show:
            found = answer(given.points, given.cells, quality, folder, show)
    except BadMesh as error:
        message = str(error)
        fail(message if message.startswith(f"{mesh}: ") else f"{mesh}: {message}", code=1)
    proofs = [_proof(own) for own in found.contradictions]
    if to is not None and found.tetrahedra is not None:
        _write(to, found)
    if proof is not None and proofs:
        _write_proofs(proof, mesh, found, proofs)
    if as_json:
        print_json(_record(mesh, found, proofs, quality))
    else:
        _print(mesh, found, proofs)
        if to is not None and found.tetrahedra is not None:
            click.echo(f"written, read back and compared: {printable(str(to))}")
        if proof is not None:
            _print_proofs(proof, len(proofs))
    exit_with(found.tetrahedra is not None)


def _require_new(path: Path) -> None:
    """Fail unless tetrahedra can be written to a file, and there is none."""
    from certify.mesh.split.writing import FORMATS

    if path.suffix.lower() not in FORMATS:
        fail(f"{path}: unknown ending; it must be one of {', '.join(FORMATS)}", code=2)
    if lexists(path):
        fail(f"{path} exists already, and no mesh replaces a file", code=2)


def _write(path: Path, found: Answer) -> None:
    from certify.mesh.files import NotExact
    from certify.mesh.split.writing import write_tetrahedra
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
    from certify.writing import write_files

    contents = {}
    for number, (own, proof) in enumerate(zip(found.contradictions, proofs, strict=True), start=1):
        comments = _comments(mesh, found, own)
        contents[f"contradiction-{number}.cnf"] = write_dimacs(own.formula, comments).encode()
        contents[f"contradiction-{number}.lrat"] = proof.encode()
    write_files(folder, contents)


def _print_proofs(folder: Path, number: int) -> None:
    if number:
        click.echo(f"formulas and proofs: {printable(str(folder))}")
    else:
        click.echo("no cells contradict each other, so there is no proof to write")


def _print(mesh: Path, found: Answer, proofs: Sequence[str]) -> None:
    counts = ", ".join(plural(len(rows), kind) for kind, rows in found.faces.cells.items())
    sides = found.faces.sides
    outside = int((sides < 0).any(axis=1).sum()) if len(sides) else 0
    print_wrapped(
        f"{printable(str(mesh))}: {_plurals(counts)}; {plural(len(sides), 'quadrilateral')}, "
        f"{outside} of them outside"
    )
    if found.tetrahedra is not None:
        _print_yes(found)
        return
    click.echo()
    print_wrapped("no: these cells cannot be split together into tetrahedra without new vertices")
    if found.unfillable:
        _print_unfillable(found)
    for own, proof in zip(found.contradictions, proofs, strict=True):
        _print_contradiction(found, own, proof)
    click.echo()
    print_wrapped(_recipe_alone(found))


def _plurals(text: str) -> str:
    return text.replace("hexahedrons", "hexahedra").replace("tetras", "tetrahedra")


def _print_yes(found: Answer) -> None:
    own = found.shape
    if own is None:
        return
    click.echo()
    print_wrapped(
        "yes: with one diagonal for each quadrilateral every cell is filled by tetrahedra, all "
        "positively oriented; checked from the definition, exactly"
    )
    click.echo()
    rows = [
        (name, value(own), value(found.recipe))
        for name, value in (
            ("tetrahedra", lambda s: str(s.tetrahedra)),
            ("inverted or flat", lambda s: str(s.not_positive)),
            ("cells with such", lambda s: str(s.cells)),
            ("least dihedral angle", _least_angle),
            ("mean ratio, least", lambda s: _ratio(s, "min")),
            ("mean ratio, mean of all", lambda s: _ratio(s, "mean")),
        )
    ]
    print_table(("", "this split", "fixed recipe"), rows)
    print_wrapped(
        "The recipe cuts every quadrilateral through its vertex with the least number, and takes "
        "for every cell the cone of its least vertex. " + _beyond(found)
    )
    if found.patterns:
        names = ", ".join(f"{name} {number}" for name, number in found.patterns.items())
        print_wrapped(f"hexahedra by pattern: {names}")
    if laid := found.laid:
        print_wrapped(
            f"{plural(laid, 'tetrahedron')} on the four vertices of a quadrilateral, each laid on "
            "the pattern of its hexahedron"
        )


def _least_angle(own: Shape) -> str:
    if own.not_positive or not len(own.angles):
        return "none" if not len(own.angles) else "inverted"
    return f"{own.angles.min():.2f}°"


def _ratio(own: Shape, which: str) -> str:
    return f"{getattr(own.ratios, which)():.4f}" if len(own.ratios) else "none"


def _beyond(found: Answer) -> str:
    """Say how many cells the diagonals of the recipe leave without a filling."""
    number = found.beyond_recipe
    if not number:
        return "With these diagonals every cell can be filled."
    return f"With these diagonals {plural(number, 'cell')} cannot be filled at all."


def _recipe_alone(found: Answer) -> str:
    own = found.recipe
    return (
        "For comparison: cutting every quadrilateral through its vertex with the least number "
        f"gives {plural(own.not_positive, 'tetrahedron')} that are inverted or flat, in "
        f"{plural(own.cells, 'cell')}. " + _beyond(found)
    ).replace("tetrahedrons", "tetrahedra")


def _print_unfillable(found: Answer) -> None:
    number = len(found.unfillable)
    what = "1 cell" if number == 1 else f"{number} cells, each by itself"
    print_wrapped(f"no tetrahedra on its own vertices fill {what}:")
    for cell in found.unfillable[:SHOWN]:
        print_wrapped(_unfillable(found, cell), indent="  ")
    if number > SHOWN:
        click.echo(f"  and {number - SHOWN} more, which --json lists")


def _unfillable(found: Answer, cell: int) -> str:
    own = found.why(cell)
    ways = f"{plural(own.boundaries, 'way')} to cut its quadrilaterals"
    crossing = "" if own.crossing is None else f", {own.crossing} with crossing triangles"
    corners = " ".join(str(vertex + 1) for vertex in own.corners)
    where = f"; its edges are inverted or flat at vertex {corners}" if corners else ""
    return f"{found.faces.name(cell)}: {ways}{crossing}{where}"


def _print_contradiction(found: Answer, own: Contradiction, proof: str) -> None:
    names = ", ".join(found.faces.name(cell) for cell in own.cells)
    what = (
        "a smallest set, no fewer do" if own.smallest else "any of them left out, the rest do not"
    )
    steps = plural(len(proof.splitlines()), "step")
    print_wrapped(
        f"{plural(len(own.cells), 'cell')} contradict each other ({what}): {names}; the proof of "
        f"{steps} was replayed by the kernel"
    )
