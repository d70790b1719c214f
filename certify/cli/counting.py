"""The command that counts the hexahedra of tetrahedral meshes: census."""

# ruff: noqa: PLC0415 - numba, scipy and meshio are imported where they are needed

from __future__ import annotations

import re
from collections.abc import Callable, Iterator, Mapping, Sequence
from pathlib import Path
from time import perf_counter
from typing import TYPE_CHECKING, Any

import click

from certify.cli.common import (
    examples,
    existing_root,
    exit_with,
    fail,
    jobs_option,
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
    from certify.mesh.census.blocks import Hexahedra
    from certify.mesh.census.tally import Run

Mesh = tuple[str, Any, Any]
"""Name, points and tetrahedra."""

Show = Callable[[str, int, int], None]

ADDRESS = re.compile(r"(\w+://)?(\[[0-9a-fA-F:]+\]|[^\s:/]+):\d{1,5}/?|inproc://\S+")
"""What Dask understands; with anything else its threads outlive the error."""


@click.command(
    epilog=examples(
        "certify census part.vtu --jobs 2",
        "certify census part.vtu --save hexahedra.vtu",
        "certify census --random 3000 --seeds 20 --plot census.png",
        "certify census part.vtu --scheduler tcp://host:8786 --journal part.journal",
    )
)
@click.argument("mesh", required=False, type=click.Path(path_type=Path))
@click.option(
    "--random",
    type=click.IntRange(5, 100_000_000),
    metavar="N",
    multiple=True,
    help="Instead of MESH: the Delaunay triangulation of N random points.",
)
@click.option(
    "--seeds",
    type=click.IntRange(1, 10_000),
    default=1,
    metavar="K",
    help="How many such triangulations, with the seeds 0 to K-1 (default 1).",
)
@jobs_option
@click.option("--scheduler", metavar="ADDRESS", help="Let the workers of a Dask cluster search.")
@click.option(
    "--journal",
    type=click.Path(path_type=Path),
    metavar="FILE",
    help="Keep what is done; with the same FILE an interrupted census goes on.",
)
@click.option(
    "--block", type=click.IntRange(1), metavar="N", help="Vertices of a block (default 10000)."
)
@click.option(
    "--save",
    type=click.Path(path_type=Path),
    metavar="FILE",
    help="Write the hexahedra as cells, with their patterns; FILE ends in .vtu. It holds them all.",
)
@click.option(
    "--plot", type=click.Path(path_type=Path), metavar="FILE", help="Draw it: .png, .svg or .pdf."
)
@root_option
@json_option
def census(
    mesh: Path | None,
    random: tuple[int, ...],
    seeds: int,
    jobs: int,
    scheduler: str | None,
    journal: Path | None,
    block: int | None,
    save: Path | None,
    plot: Path | None,
    root: Path | None,
    as_json: bool,
) -> None:
    """Count the valid hexahedra that the tetrahedra of a mesh combine to, by pattern.

    A hexahedron has eight vertices of MESH, its region is a union of tetrahedra on them, in one of
    the 6,966 labelled ways, and its Jacobian is positive on the closed cube: all found, all decided
    exactly. Tetrahedra may share them. The first of each pattern is checked again by the kernel.

    Memory is bounded by blocks of vertices, each searched with three layers of tetrahedra around
    it, by processes of this machine or by a Dask cluster.

    Exit code 1: MESH is not what it should be, or a pattern occurs that carries no valid
    hexahedron; then a theorem would be wrong.
    """
    if bool(random) == (mesh is not None):
        raise click.UsageError("Name a mesh, or else give --random")
    if mesh is not None and seeds > 1:
        raise click.UsageError("--seeds goes with --random")
    if (journal or save) and len(random) * seeds > 1:
        raise click.UsageError("--journal and --save go with one mesh")
    if journal and save:
        raise click.UsageError("--save keeps hexahedra, and --journal only counts them")
    _require_endings(save, plot)
    for target in (save, plot, journal):
        require_target(target, mesh)
    folder = existing_root(root)
    with needing("mesh"):
        from certify.mesh.census.tally import NotConfirmed
        from certify.mesh.reading import BadMesh
    if scheduler is not None:
        if not ADDRESS.fullmatch(scheduler):
            raise click.UsageError("--scheduler takes an address such as tcp://HOST:8786")
        with needing("cluster"):
            import distributed  # noqa: F401 - before anything is computed
    how = {"jobs": jobs, "scheduler": scheduler, "journal": journal, "size": block}
    how = {key: value for key, value in how.items() if value is not None}
    start = perf_counter()
    try:
        with progress() as show:
            meshes = _meshes(mesh, random, seeds)
            runs = [_run(own, folder, how, save, show) for own in meshes]
    except (BadMesh, NotConfirmed) as error:
        fail(str(error), code=1)
    seconds = perf_counter() - start
    impossible = _impossible(folder, runs)
    if as_json:
        print_json(_record(runs, impossible))
    else:
        _print(runs, impossible, seconds)
    if plot is not None:
        _plot(plot, runs)
    exit_with(not impossible)


def _require_endings(save: Path | None, plot: Path | None) -> None:
    for path, endings in ((save, (".vtu",)), (plot, (".png", ".svg", ".pdf"))):
        if path is not None and path.suffix not in endings:
            fail(f"{path}: unknown ending; it must be {' or '.join(endings)}", code=2)


def _meshes(path: Path | None, random: Sequence[int], seeds: int) -> Iterator[Mesh]:
    """Yield the name, the points and the tetrahedra of each mesh."""
    if path is not None:
        from certify.mesh.reading import BadMesh, read_mesh

        given = read_mesh(path)
        if "tetra" not in given.cells:
            raise BadMesh(f"{path}: there are no tetrahedra in it")
        others = [
            plural(len(own), f"{kind} cell") for kind, own in given.cells.items() if kind != "tetra"
        ]
        if others:
            click.echo(f"left out, as they are no tetrahedra: {', '.join(others)}", err=True)
        yield str(path), given.points, given.cells["tetra"]
    for number in random:
        for seed in range(seeds):
            from certify.mesh.census.random import random_mesh

            yield f"{number} random points, seed {seed}", *random_mesh(number, seed)


def _run(mesh: Mesh, root: Path, how: Mapping[str, Any], save: Path | None, show: Show) -> Run:
    """Count the hexahedra of a mesh, save them if asked to, and have the kernel confirm some."""
    from certify.mesh.census import count
    from certify.mesh.census.tally import confirmed
    from certify.mesh.reading import BadMesh

    name, points, tetrahedra = mesh
    found: list[Hexahedra] = []
    take = found.append if save else None
    try:
        counts = count(points, tetrahedra, report=show, root=root, take=take, **how)
    except ValueError as error:
        raise BadMesh(f"{name}: {error}") from None
    if save is not None:
        _save(save, points, found, root)
    return confirmed(name, points, tetrahedra, counts, root)


def _save(path: Path, points: Any, found: Sequence[Hexahedra], root: Path) -> None:
    from certify.mesh.census.saving import write_hexahedra
    from certify.writing import written_to

    with written_to(path.parent) as scratch:
        write_hexahedra(scratch / path.name, points, found, root)


def _impossible(root: Path, runs: Sequence[Run]) -> list[str]:
    """Return the patterns that occur though the kernel does not accept that they can.

    Of those that occur it must accept the points of a valid hexahedron; then they are among those
    that carry one.
    """
    from certify.kernel.check import check_pattern

    occurring = sorted({name for run in runs for name in run.patterns})
    return [name for name in occurring if check_pattern(root, name).answers.get("valid") != "yes"]


def _plot(path: Path, runs: Sequence[Run]) -> None:
    from certify.mesh.census.plots import draw
    from certify.paper import RANDOM_POINTS
    from certify.writing import written_to

    with written_to(path.parent) as scratch:
        draw(scratch / path.name, runs, {points: total for points, _, total in RANDOM_POINTS})


def _record(runs: Sequence[Run], impossible: Sequence[str]) -> dict[str, Any]:
    from certify import __version__

    return {
        "certify": __version__,
        "impossible": list(impossible),
        "runs": [run.record() for run in runs],
    }


def _print(runs: Sequence[Run], impossible: Sequence[str], seconds: float) -> None:
    if len(runs) == 1:
        _print_one(runs[0])
    else:
        _print_many(runs)
    names = {name for run in runs for name in run.patterns}
    if impossible:
        print_wrapped(
            f"CONTRADICTION: {', '.join(impossible)} occur, of which the kernel does not accept "
            "that they carry a valid hexahedron"
        )
    else:
        print_wrapped(
            f"each of the {len(names)} is one of the patterns that carry a valid hexahedron "
            "(theorem valid); had another occurred, the theorem would be wrong"
        )
    confirmed, patterns = sum(run.kernel for run in runs), sum(len(run.patterns) for run in runs)
    print_wrapped(
        f"confirmed by the kernel: the first hexahedron of {confirmed} of {patterns} patterns"
    )
    if undecided := sum(run.undecided for run in runs):
        print_wrapped(f"not counted, as their Jacobian is not decided: {undecided} hexahedra")
    click.echo(f"{seconds:.1f} s")


def _print_one(run: Run) -> None:
    """Print the patterns and the hexahedra by number of tetrahedra, and by pattern."""
    from certify.mesh.census.tally import SIZES

    print_wrapped(
        f"{printable(run.mesh)}: {run.vertices} vertices, {run.tetrahedra} tetrahedra, "
        f"{run.hexahedra} valid hexahedra in {plural(len(run.patterns), 'pattern')}"
    )
    click.echo()
    rows = [
        (size, patterns, times, f"{100 * times / run.hexahedra:.3f} %")
        for size, patterns, times in zip(SIZES, run.row, run.occurrences, strict=True)
        if patterns
    ]
    print_table(("tetrahedra", "patterns", "hexahedra", "of all"), rows)
    for size in SIZES:
        own = [f"{name} {n}" for name, n in run.patterns.items() if name.startswith(f"{size}_")]
        if own:
            print_wrapped(", ".join(own))
    click.echo()


def _print_many(runs: Sequence[Run]) -> None:
    """Print a table like the paper's for each number of points, with ranges over the seeds."""
    from certify.mesh.census.tally import SIZES, spread
    from certify.paper import RANDOM_POINTS

    headings = ("", *map(str, SIZES), "total", "hexahedra")
    for number in dict.fromkeys(run.vertices for run in runs):
        own = [run for run in runs if run.vertices == number]
        rows = [
            (f"seed {seed}", *run.row, sum(run.row), run.hexahedra) for seed, run in enumerate(own)
        ]
        rows += [(name, *row, total, most) for name, row, total, most in spread(own)]
        rows += [
            ("paper", *row, total, "") for points, row, total in RANDOM_POINTS if points == number
        ]
        print_table(headings, rows, f"{number} random points: patterns by number of tetrahedra")
