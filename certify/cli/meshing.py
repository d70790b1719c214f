"""Commands for engineers: triangulate, name."""

# ruff: noqa: PLC0415 - numba and meshio are imported where they are needed

from __future__ import annotations

from collections.abc import Sequence
from decimal import ROUND_CEILING, ROUND_FLOOR, Context, Decimal
from fractions import Fraction
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
    require_target,
    root_option,
)
from certify.printable import printable

if TYPE_CHECKING:
    from certify.kernel.hexahedron import Simplex
    from certify.mesh.naming import Reading
    from certify.mesh.realized import Booleans

Record = dict[str, Any]


def _diagonals(_context: click.Context, _parameter: click.Parameter, value: str) -> list[Simplex]:
    """Return the diagonals that were asked for, at most one of each facet."""
    from certify.kernel.hexahedron import BOUNDARIES

    words = value.replace(",", " ").split()
    known = {f"{a}{b}": (a, b) for boundary in BOUNDARIES for a, b in boundary}
    for word in words:
        if word not in known:
            raise click.BadParameter(f"{word} is no diagonal of a facet; 13 is one.")
    wanted: list[Simplex] = sorted({known[word] for word in words})
    if not any(boundary.issuperset(wanted) for boundary in BOUNDARIES):
        raise click.BadParameter("two of these are diagonals of the same facet.")
    return wanted


@click.command(
    epilog=examples(
        "certify triangulate cube.csv",
        "certify triangulate cube.csv --diagonals 13,16,18",
        "certify triangulate part.vtu --to hexahedra.parquet",
        "certify triangulate part.vtu --cell 17",
    )
)
@click.argument("file", type=click.Path(path_type=Path))
@click.option(
    "--diagonals",
    default="",
    metavar="LIST",
    callback=_diagonals,
    help="Only triangulations whose boundary has these diagonals.",
)
@click.option("--cell", type=int, metavar="N", help="One hexahedron of many, counted from 1.")
@click.option(
    "--to",
    type=click.Path(path_type=Path),
    metavar="TABLE",
    help="Write a row for each hexahedron; TABLE ends in .csv, .json or .parquet.",
)
@root_option
@json_option
def triangulate(
    file: Path,
    diagonals: list[Simplex],
    cell: int | None,
    to: Path | None,
    root: Path | None,
    as_json: bool,
) -> None:
    """Which triangulations do the eight vertices of a hexahedron realize?

    FILE has the coordinates of vertices 1 to 8, in the order of VTK's hexahedron: as CSV, eight
    lines of three numbers or a line of 24 for each hexahedron; as JSON, a list of eight points or
    of hexahedra; or it is a mesh with hexahedra that meshio reads. Integers, fractions and decimals
    are taken exactly; a floating-point number is the rational number that it is.

    Told are the realized ones of the 6,966 labelled triangulations, by pattern, with the best of
    each; which of the 64 triangulated boundaries can be filled; and whether the trilinear
    hexahedron is valid. All this is exact; angles, ratios and scaled Jacobians are rounded.

    Exit code 1: a hexahedron has no such triangulation.
    """
    folder = existing_root(root)
    if to is not None:
        _require_table(to)
        require_target(to, file)
    with needing("mesh"):
        from certify.kernel.evidence import Malformed
        from certify.mesh.hexahedra import Hexahedra
        from certify.mesh.reading import BadMesh, read_hexahedra
        from certify.mesh.realized import labelled
        from certify.mesh.records import boundaries_with, record
    try:
        points, names = read_hexahedra(file)
        labelled(folder)
    except BadMesh as error:
        fail(str(error), code=1)
    except Malformed as error:
        fail(f"rejected: {error}", code=1)
    if cell is not None:
        if not 1 <= cell <= len(points):
            fail(f"there is no hexahedron {cell} in {file}; the last is {len(points)}", 2)
        points, names = points[cell - 1 : cell], names[cell - 1 : cell]
    wanted = boundaries_with(diagonals)
    if to is not None or len(points) > 1:
        _many(points, names, folder, wanted, to, as_json)
        return
    found = record(Hexahedra(points, folder, wanted), 0, names[0])
    if as_json:
        print_json(found)
    else:
        _print_one(found, bool(diagonals))
    exit_with(found["realized"] > 0)


def _require_table(path: Path) -> None:
    formats = {".csv": "mesh", ".json": "mesh", ".parquet": "parquet"}
    if path.suffix.lower() not in formats:
        fail(f"{path}: unknown ending; it must be one of {', '.join(formats)}", code=2)
    if path.suffix.lower() == ".parquet":
        with needing("parquet"):
            import pyarrow  # noqa: F401 - before anything is computed


def _many(
    points: Any, names: Sequence[str], root: Path, wanted: Booleans, to: Path | None, as_json: bool
) -> None:
    """Look at many hexahedra: write or print a row for each, and print a summary."""
    from certify.mesh.compiled import interruptible
    from certify.mesh.records import Summary, rows, write_table
    from certify.writing import written_to

    summary = Summary()
    with progress() as show, interruptible():
        found = summary.over(rows(points, names, root, wanted, show))
        if to is not None:
            with written_to(to.parent) as scratch:
                write_table(scratch / to.name, found)
        kept = [*found] if to is None and as_json else [None for _ in found]
    if as_json:
        print_json({"summary": summary.record()} | ({} if to else {"hexahedra": kept}))
    else:
        _print_summary(summary.record(), summary.worst)
        if to is not None:
            click.echo(f"a row for each: {printable(str(to))}")
    exit_with(not summary.without)


def _print_one(found: Record, restricted: bool) -> None:
    least, most = (Fraction(found["jacobian"][key]) for key in ("at_least", "at_most"))
    print_wrapped(f"{printable(found['hexahedron'])}: {_validity(found)}")
    click.echo(f"  least Jacobian    {_between(least, most)}")
    scaled = " ".join(f"{value:6.3f}" for value in found["scaled_jacobians"])
    click.echo(f"  scaled Jacobians {scaled}")
    click.echo()
    if found["mirrored"]:
        print_wrapped(
            "mirrored: these vertices are in the order of the mirrored template; what follows is "
            "about the mirror image"
        )
    asked = " with these diagonals" if restricted else ""
    print_wrapped(
        f"realized{asked}: {found['realized']} of the 6,966 labelled triangulations, "
        f"in {plural(len(found['patterns']), 'pattern')}"
    )
    if found["patterns"]:
        _print_patterns(found["patterns"])
    _print_boundaries(found["boundaries"])


def _validity(found: Record) -> str:
    """Say whether a hexahedron is valid, and where it fails."""
    if found["valid"] == "yes":
        return "valid, the Jacobian is positive on the closed cube"
    if found["valid"] == "undecided":
        return "undecided, whether the Jacobian is positive on the closed cube"
    corners, edges = found["failing_corners"], found["failing_edges"]
    places = [f"at {' '.join(map(str, corners))}"] if corners else []
    places += [f"on {' '.join(edges)}"] if edges else []
    where = " and ".join(places) or "inside or on a facet, though at every vertex and on every edge"
    return f"not valid, the Jacobian is not positive {where}"


def _between(least: Fraction, most: Fraction) -> str:
    """Write exact bounds with six digits, rounded away from each other."""
    low, high = (
        Context(prec=6, rounding=rounding).divide(Decimal(x.numerator), Decimal(x.denominator))
        for x, rounding in ((least, ROUND_FLOOR), (most, ROUND_CEILING))
    )
    return f"{low:g}" if low == high else f"between {low:g} and {high:g}"


def _print_patterns(patterns: Sequence[Record]) -> None:
    """Print a table of the patterns, and the tetrahedra of the best of all."""
    headings = ("pattern", "tetrahedra", "realized", "best: least dihedral", "mean ratio")
    keys = ("pattern", "tetrahedra", "realized")
    click.echo()
    print_table(
        headings,
        (
            [
                *(own[key] for key in keys),
                f"{own['least_dihedral']:.2f}°",
                f"{own['mean_ratio']:.4f}",
            ]
            for own in patterns
        ),
    )
    best = max(patterns, key=lambda own: float(own["least_dihedral"]))
    print_wrapped(f"the best: {best['pattern']}: {' '.join(best['best'])}", hanging=" " * 15)
    click.echo()


def _print_boundaries(boundaries: Record) -> None:
    filled: list[str] = boundaries["filled"]
    more: list[str] = boundaries["with_boundary_tetrahedra"]
    impossible: list[str] = boundaries["impossible"]
    total = len(filled) + len(more) + len(impossible)
    print_wrapped(f"boundaries filled by these: {len(filled)} of {total}")
    if more:
        print_wrapped(f"filled only with tetrahedra on the four vertices of a facet: {len(more)}")
        _print_columns(more)
    if impossible:
        print_wrapped(
            f"impossible without further points: {len(impossible)}; there are no triangulations "
            "but the 6,966 (theorem patterns, replayed by certify check-all)"
        )
        _print_columns(impossible)


def _print_columns(words: Sequence[str]) -> None:
    for start in range(0, len(words), PER_LINE):
        click.echo("  " + "   ".join(words[start : start + PER_LINE]))


PER_LINE = 3
"""So many boundaries fit into a line of 80 columns."""


def _print_summary(summary: Record, worst: Sequence[Record]) -> None:
    """Print what many hexahedra have in common, and the worst of them."""
    click.echo(
        f"{summary['hexahedra']} hexahedra: {summary['valid']} valid, "
        f"{summary['not_valid']} not valid, {summary['undecided']} undecided, "
        f"{summary['mirrored']} mirrored"
    )
    least, most = summary["realized"]
    click.echo(f"triangulations realized by each: {least} to {most}")
    if summary["tetrahedra"]:
        click.echo("their tetrahedra: {} to {}".format(*summary["tetrahedra"]))
    click.echo(f"hexahedra without a triangulation: {summary['without_triangulation']}")
    click.echo()
    headings = (
        "hexahedron",
        "valid",
        "failing vertices",
        "scaled Jacobian",
        "realized",
        "dihedral",
    )
    print_table(
        headings,
        map(_worst, worst),
        "The worst; vertices are those at which the Jacobian is not positive",
    )


def _worst(row: Record) -> list[str]:
    angle = "" if row["least_dihedral"] is None else f"{row['least_dihedral']:.2f}°"
    return [
        printable(row["hexahedron"]),
        row["valid"],
        row["failing_corners"],
        f"{row['scaled_jacobian']:.4f}",
        str(row["realized"]),
        angle,
    ]


@click.command(epilog=examples("certify name tetrahedra.json", "certify name part.vtu --json"))
@click.argument("file", type=click.Path(path_type=Path))
@root_option
@json_option
def name(file: Path, root: Path | None, as_json: bool) -> None:
    """Say which pattern a set of tetrahedra on eight vertices is.

    FILE has four names of vertices for each tetrahedron, whatever the vertices are called: a line
    each, or words of four characters; or JSON, a list of them or an object with "tetrahedra" and,
    if they are known, the marked "facets"; or it is a mesh of tetrahedra that meshio reads.

    Shown is the vertex of the template to which each vertex goes. Without marked facets the
    tetrahedra may be several patterns, with other facets each.

    Exit code 1: they are none.
    """
    from certify.kernel.evidence import Malformed
    from certify.mesh.naming import NotNamed, readings

    folder = existing_root(root)
    with needing("mesh"):
        from certify.mesh.reading import BadMesh, read_tetrahedra
    try:
        given = read_tetrahedra(file)
        found = readings(given.cells, given.facets, folder)
    except BadMesh as error:
        fail(str(error), code=1)
    except NotNamed as error:
        fail(f"{file}: {error}", code=1)
    except Malformed as error:
        fail(f"rejected: {error}", code=1)
    if as_json:
        print_json({"patterns": [_reading_record(own) for own in found]})
    else:
        for own in found:
            _print_reading(own)


def _reading_record(reading: Reading) -> Record:
    return {
        "pattern": reading.pattern,
        "vertices": dict(reading.names),
        "facets": reading.facets(),
    }


def _print_reading(reading: Reading) -> None:
    facets = ", ".join(" ".join(facet) for facet in reading.facets())
    print_wrapped(f"{reading.pattern}, with the facets {printable(facets)}")
    width = max(map(len, reading.names))
    for heading, words in (
        ("vertex", reading.names),
        (reading.pattern, map(str, reading.names.values())),
    ):
        click.echo(f"  {heading:6}  " + "  ".join(printable(word).rjust(width) for word in words))
