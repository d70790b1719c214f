"""Commands that show: draw, atlas."""

# ruff: noqa: PLC0415 - the kernel (with it sympy) and matplotlib are imported where needed

from __future__ import annotations

from collections.abc import Callable
from importlib import import_module
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import TYPE_CHECKING

import click

from certify.cli.common import (
    examples,
    existing_root,
    fail,
    jobs_option,
    needing,
    pattern_argument,
    progress,
    root_option,
    verdict_line,
)
from certify.printable import printable

if TYPE_CHECKING:
    from certify.atlas.draw.picture import Picture

ENDINGS = (".svg", ".pdf", ".png")


@click.command(
    epilog=examples(
        "certify draw 8_E --to 8_E.svg",
        "certify draw 15_E --graph --to graph.pdf",
        "certify draw --boundary c --to c.png",
        "certify draw --figure 12 --to eights.svg",
    )
)
@pattern_argument("pattern", required=False)
@click.option(
    "--to",
    type=click.Path(path_type=Path),
    metavar="FILE",
    required=True,
    help="File to write: .svg, or .pdf or .png, which need matplotlib.",
)
@click.option("--graph", "as_graph", is_flag=True, help="The decomposition graph of PATTERN.")
@click.option("--boundary", metavar="LETTER", help="A type of boundary, a to g, on the cube.")
@click.option(
    "--figure", type=int, metavar="N", help="A figure of the paper: 2 to 6, 8, 10, 12 to 14."
)
@root_option
def draw(
    pattern: str | None,
    to: Path,
    as_graph: bool,
    boundary: str | None,
    figure: int | None,
    root: Path | None,
) -> None:
    """Draw a pattern: its tetrahedra pulled apart, and the closed hexahedron.

    The points are those of the best yes: of a valid hexahedron, or else in convex position, or else
    any. Nothing is drawn unless the kernel accepts the certificate. Of a pattern that no points
    realize, the decomposition graph is drawn, with the diagonals on the cube.

    A figure is counted in the order of the paper's source, and made from our certificates.
    """
    if sum(wanted is not None for wanted in (pattern, boundary, figure)) != 1:
        fail(
            "draw needs one of: a pattern, --boundary, --figure; see 'certify draw --help'", code=2
        )
    if as_graph and pattern is None:
        fail("--graph is for a pattern", code=2)
    if to.suffix not in ENDINGS:
        fail(f"{to} does not end in {', '.join(ENDINGS[:-1])} or {ENDINGS[-1]}", code=2)
    if to.is_dir():
        fail(f"{to} is a folder", code=2)
    content = _format(to.suffix)
    if boundary is not None:
        name, picture = f"boundary {boundary}", _boundary(boundary)
    elif figure is not None:
        name, picture = f"figure {figure}", _figure(figure, existing_root(root))
    else:
        name = str(pattern)
        picture = _pattern(name, existing_root(root), as_graph)
    from certify.writing import write_file

    write_file(to, content(picture))
    click.echo(f"{name}: {printable(str(to))}")


def _pattern(pattern: str, root: Path, as_graph: bool) -> Picture:
    from certify.atlas.draw.drawings import graph, pair
    from certify.kernel.check import check_pattern

    verdict = check_pattern(root, pattern)
    if verdict.fault is not None or verdict.certificate is None:
        fail(verdict_line(verdict), code=1)
    return graph(verdict.certificate.tetrahedra) if as_graph else pair(verdict.certificate)


def _boundary(letter: str) -> Picture:
    from certify.atlas.draw.drawings import boundary_type
    from certify.kernel.hexahedron import BOUNDARY_TYPES

    if letter not in BOUNDARY_TYPES:
        fail(f"unknown boundary type {letter}; it must be one of a to g", code=2)
    return boundary_type(letter)


def _figure(number: int, root: Path) -> Picture:
    from certify.atlas.draw.figures import FIGURES, figure
    from certify.kernel.check import Rejected

    if number not in FIGURES:
        known = ", ".join(map(str, FIGURES))
        fail(f"figure {number} is not drawn; it must be one of {known}", code=2)
    try:
        return figure(number, root)
    except Rejected as error:
        fail(f"rejected: {error}", code=1)


def _format(ending: str) -> Callable[[Picture], bytes]:
    """Return what makes a file with this ending of a picture; fail if its library is missing."""
    from certify.atlas.draw.picture import svg

    if ending == ".svg":
        return lambda picture: svg(picture).encode()
    from certify.atlas.draw.render import pdf, png

    with needing("atlas"):
        import_module("matplotlib")
    return pdf if ending == ".pdf" else png


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
    if to is not None and to.is_dir() and not _may_hold_an_atlas(to):
        fail(f"{to} is neither empty nor an atlas", code=2)
    folder = existing_root(root)
    with needing("atlas"):
        from certify.atlas.site.build import write_site

        import_module("plotly")
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


def _may_hold_an_atlas(folder: Path) -> bool:
    return (folder / "static" / "view.js").exists() or not any(folder.iterdir())


def _serve(folder: Path, port: int) -> None:
    from certify.atlas.site.serve import serving

    try:
        with serving(folder, port) as server:
            click.echo(f"atlas: http://127.0.0.1:{server.server_port}/ until it is interrupted")
            server.serve_forever()
    except OSError as error:
        fail(f"--port {port}: {error.strerror}", code=2)
