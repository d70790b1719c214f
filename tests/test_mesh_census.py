"""The census finds what trying everything finds, hexahedron by hexahedron, however it is run."""

import doctest
import json
import os
import signal
import subprocess
import sys
from collections import Counter
from fractions import Fraction
from itertools import product
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray
from scipy.spatial import Delaunay

import certify.mesh.census
from certify.kernel.certificate import PATTERN_NAMES, Yes, read_certificate
from certify.kernel.evidence import Evidence
from certify.mesh.census import Census, NotAMesh, count, hexahedra, streamed
from certify.mesh.census.blocks import blocks
from certify.mesh.census.journal import NotItsJournal
from certify.mesh.census.prepare import prepare
from certify.mesh.census.running import mapping
from certify.mesh.curve import along_the_curve, places
from certify.mesh.realized import labelled
from tests import brute_census
from tests.commands import CHECKOUT
from tests.geometry import CUBE, CUBE_TRIANGULATIONS

Array = NDArray[Any]


def scattered(seed: int, number: int) -> Array:
    """Return random points: in a cube, in a flat box, or crowded at a corner."""
    points = np.random.default_rng(seed).random((number, 3))
    return (points, points * (1, 1, 0.1), points**3)[seed % 3]


def mesh(seed: int, number: int) -> tuple[Array, Array]:
    points = scattered(seed, number)
    return points, Delaunay(points).simplices


def patterns_of(points: Array, tetrahedra: Array) -> dict[tuple[int, ...], str]:
    """Return the hexahedra that the census finds, each with its pattern."""
    found, own = hexahedra(points, tetrahedra)
    names = [labelled()[i].pattern for i in own]
    by_hexahedron = dict(zip(map(tuple, found.tolist()), names, strict=True))
    assert len(by_hexahedron) == len(found)  # each once
    return by_hexahedron


def by_trying(points: Array, tetrahedra: Array) -> dict[tuple[int, ...], str]:
    found = brute_census.patterns(brute_census.hexahedra(points.tolist(), tetrahedra.tolist()))
    assert all(len(own) == 1 for own in found.values())  # one region for each hexahedron
    return {eight: min(own) for eight, own in found.items()}


# What is found.


@pytest.mark.parametrize(("seed", "number"), [(0, 24), (1, 24), (2, 24), (3, 40), (4, 50), (5, 60)])
def test_the_census_is_what_trying_everything_finds(seed: int, number: int) -> None:
    own = mesh(seed, number)
    found = patterns_of(*own)
    assert found == by_trying(*own)
    assert len(found) > number


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(20))
def test_the_census_of_hundreds_of_points_is_what_trying_everything_finds(seed: int) -> None:
    own = mesh(seed, 100 + 10 * seed)
    assert patterns_of(*own) == by_trying(*own)


@pytest.mark.parametrize("seed", range(3))
def test_what_is_found_consists_of_tetrahedra_of_the_mesh(seed: int) -> None:
    points, tetrahedra = mesh(seed, 50)
    solid = {frozenset(t) for t in tetrahedra.tolist()}
    found, own = hexahedra(points, tetrahedra)
    for eight, i in zip(found.tolist(), own, strict=True):
        region = {frozenset(eight[v - 1] for v in t) for t in labelled()[i].tetrahedra}
        assert region <= solid


def _valid_points() -> dict[str, tuple[Array, tuple[tuple[int, ...], ...]]]:
    """Return for each valid pattern the certificate's points, and its tetrahedra from 0."""
    found = {}
    for name in PATTERN_NAMES:
        certificate = read_certificate(name, Evidence(CHECKOUT).certificate(name))
        answer = certificate.answers["valid"]
        if isinstance(answer, Yes):
            cells = tuple(tuple(v - 1 for v in t) for t in certificate.tetrahedra)
            found[name] = (np.array(answer.points, float), cells)
    return found


def test_every_valid_pattern_is_found_where_its_certificate_shows_it() -> None:
    shown = _valid_points()
    assert len(shown) == 143
    for name, (points, cells) in shown.items():
        found = patterns_of(points, np.array(cells))
        assert found[brute_census.rotated(range(8))] == name


def test_a_mirrored_pattern_is_found_as_what_it_is() -> None:
    """The mesh is mirrored, so the hexahedron is as well: another labelling has a Jacobian > 0."""
    for name, (points, cells) in [*_valid_points().items()][::20]:
        found = patterns_of(points * (1, 1, -1), np.array(cells))
        mirrored = [v ^ 4 for v in range(8)]  # 1 and 5, 2 and 6, ... change places
        assert found[brute_census.rotated(mirrored)] == name


def test_patterns_that_are_not_valid_never_occur() -> None:
    """The theorem says that they cannot; this looks whether one does."""
    found = Counter(name for seed in range(9) for name in count(*mesh(seed, 300)).patterns)
    assert len(found) > 40
    assert _valid_points().keys() >= found.keys()


@pytest.mark.parametrize("kind", CUBE_TRIANGULATIONS)
def test_the_unit_cube(kind: str) -> None:
    cells = np.array(CUBE_TRIANGULATIONS[kind]) - 1
    own = {own.tetrahedra: own.pattern for own in labelled()}
    pattern = own[tuple(sorted(CUBE_TRIANGULATIONS[kind]))]
    assert patterns_of(np.array(CUBE, float), cells) == {tuple(range(8)): pattern}


def kuhn(size: tuple[int, int, int]) -> tuple[Array, Array]:
    """Return a grid of cubes, each cut into six tetrahedra around its diagonal."""
    points = np.array([*product(*map(range, size))], float)
    at = {tuple(point): i for i, point in enumerate(points.astype(int).tolist())}
    cells = []
    for corner in product(*(range(n - 1) for n in size)):
        for axes in ((0, 1, 2), (0, 2, 1), (1, 0, 2), (1, 2, 0), (2, 0, 1), (2, 1, 0)):
            path = [list(corner)]
            for axis in axes:
                path.append([x + (i == axis) for i, x in enumerate(path[-1])])
            cells.append([at[tuple(x)] for x in path])
    return points, np.array(cells)


@pytest.mark.parametrize("scale", [1, 0.1, 2.0**-300])
def test_grids_with_corners_that_are_flat(scale: float) -> None:
    """Here are Jacobians that are zero at a corner: they are not positive."""
    points, cells = kuhn((3, 3, 4))
    found = patterns_of(points * scale, cells)
    assert found == by_trying(points * scale, cells)
    assert len(found) > 2 * 2 * 3
    assert not count(points * scale, cells).undecided


@pytest.mark.parametrize("number", [0, 1, 2])
def test_vertices_with_many_neighbours(number: int) -> None:
    """All points are on a sphere, but for one at its centre, or two."""
    points = np.random.default_rng(number).normal(size=(40, 3))
    points /= np.linalg.norm(points, axis=1)[:, None]
    points[:number] *= 0.01
    own = (points, Delaunay(points).simplices)
    assert patterns_of(*own) == by_trying(*own)


def test_a_hub_of_thousands_is_no_obstacle() -> None:
    points = np.random.default_rng(4).normal(size=(3000, 3))
    points /= np.linalg.norm(points, axis=1)[:, None]
    points[0] = 0
    assert count(points, Delaunay(points).simplices, size=50).hexahedra > 0


# How it is numbered, and what is no mesh.


@pytest.mark.parametrize("seed", range(3))
def test_numbers_and_orders_do_not_matter(seed: int) -> None:
    points, cells = mesh(seed, 80)
    random = np.random.default_rng(seed)
    order = random.permutation(len(points))  # new vertex i is the old order[i]
    new = np.argsort(order)[random.permuted(cells, axis=1)]
    found = patterns_of(points[order], random.permutation(new))
    assert {
        brute_census.rotated(order[list(eight)].tolist()): pattern
        for eight, pattern in found.items()
    } == patterns_of(points, cells)


def bad(cells: list[Any]) -> Any:
    return np.array([*CUBE_CELLS, *cells])


CUBE_CELLS = (np.array(CUBE_TRIANGULATIONS["core"]) - 1).tolist()


@pytest.mark.parametrize(
    ("cell", "message"),
    [
        ([0, 1, 2, 3], "with the vertices .0, 1, 2, 3., is flat"),
        ([0, 1, 2, 2], "is flat"),
        ([0, 1, 2, 8], "that is none of the 8"),
        ([0, 1, 2, -1], "below 0"),
        ([0, 1, 2, 4], "on the same side as tetrahedron"),
        ([1, 2, 0, 5], "on the same side as tetrahedron"),
    ],
)
def test_what_is_no_mesh_is_refused(cell: list[int], message: str) -> None:
    with pytest.raises(NotAMesh, match=message) as caught:
        count(CUBE, bad([cell]))
    assert caught.value.cell == 5


@pytest.mark.parametrize(
    ("points", "cells", "message"),
    [
        (np.zeros((8, 2)), CUBE_CELLS, "shape"),
        (CUBE, np.zeros((3, 5), int), "shape"),
        (CUBE, np.zeros((3, 4)), "integer"),
        (np.full((8, 3), np.nan), CUBE_CELLS, "finite"),
        ([[Fraction(1, 3)] * 3] * 8, CUBE_CELLS, "64 bits"),
    ],
)
def test_what_are_no_arrays_of_a_mesh_is_refused(points: Any, cells: Any, message: str) -> None:
    with pytest.raises(ValueError, match=message):
        count(points, cells)


def twins(scale: float, shift: float) -> tuple[Array, Array]:
    """Return two cubes of five tetrahedra each."""
    points = np.concatenate([CUBE, scale * np.array(CUBE, float) + shift])
    return points, np.array([*CUBE_CELLS, *(np.array(CUBE_CELLS) + 8)])


@pytest.mark.parametrize(("scale", "shift"), [(1, 0.5), (0.5, 0.25), (4, -1)])
def test_meshes_that_overlap_are_refused(scale: float, shift: float) -> None:
    with pytest.raises(NotAMesh, match=r"tetrahedron [5-9], .* overlaps tetrahedron [0-4]"):
        count(*twins(scale, shift))


def test_vertices_at_the_same_point_are_refused() -> None:
    with pytest.raises(
        NotAMesh, match=r"tetrahedron \d, .* has vertex .*, which is the same point"
    ):
        count(*twins(1, 1))
    unused = np.concatenate([CUBE, CUBE])
    assert count(unused, CUBE_CELLS).patterns == count(CUBE, CUBE_CELLS).patterns


def test_a_mesh_of_nothing_has_nothing() -> None:
    assert count(np.zeros((0, 3)), np.zeros((0, 4), int)) == Census(0, 0, {}, {}, ())
    assert count(CUBE, np.zeros((0, 4), int)).patterns == {}


# The curve.


def test_the_curve_goes_from_cell_to_neighbouring_cell() -> None:
    points = np.array([*product(range(8), repeat=3)], float)
    along = points[along_the_curve(points)]
    assert (np.abs(np.diff(along, axis=0)).sum(axis=1) == 1).all()
    assert len(set(places(points).tolist())) == 512


# Blocks, processes, journals.


@pytest.fixture(scope="module")
def many() -> tuple[Array, Array, Census]:
    own = mesh(0, 500)
    return (*own, count(*own))


def test_blocks_do_not_matter(many: tuple[Array, Array, Census]) -> None:
    points, cells, whole = many
    for size in (7, 50, 499):
        assert count(points, cells, size=size) == whole
        parts = [
            tuple(eight) for own in streamed(points, cells, size=size) for eight in own.vertices
        ]
        assert sorted(parts) == sorted(map(tuple, hexahedra(points, cells)[0]))


def test_a_block_is_a_part() -> None:
    """Only then is memory bounded. It has only vertices from its beginning on."""
    own = prepare(*mesh(0, 3000))
    parts = [*blocks(own, 20, CHECKOUT)]
    assert max(len(part.tetrahedra) for part in parts) < len(own.tetrahedra) / 3
    assert len(parts[-1].points) == 20


def test_processes_do_not_matter(many: tuple[Array, Array, Census]) -> None:
    points, cells, whole = many
    told: list[tuple[str, int, int]] = []

    def report(*what: Any) -> None:
        told.append(what)

    assert count(points, cells, jobs=2, size=100, report=report) == whole
    assert told == [("searching", done, 5) for done in range(6)]


def test_a_process_that_is_killed_is_told() -> None:
    with pytest.raises(ChildProcessError, match="killed"), mapping(2) as mapped:
        next(mapped(os._exit, [1]))


def test_a_cluster_does_not_matter(many: tuple[Array, Array, Census]) -> None:
    distributed = pytest.importorskip("distributed")
    points, cells, whole = many
    with distributed.LocalCluster(
        n_workers=1, threads_per_worker=1, processes=False, dashboard_address=None
    ) as cluster:
        assert count(points, cells, scheduler=cluster.scheduler_address, size=200) == whole


def test_witnesses_show_their_pattern(many: tuple[Array, Array, Census]) -> None:
    points, cells, whole = many
    found = patterns_of(points, cells)
    assert whole.patterns == Counter(found.values())
    assert whole.witnesses.keys() == whole.patterns.keys()
    for name, eight in whole.witnesses.items():
        assert found[eight] == name


def test_a_journal_goes_on(many: tuple[Array, Array, Census], tmp_path: Path) -> None:
    points, cells, whole = many
    journal = tmp_path / "journal"

    def interrupt(_: str, done: int, total: int) -> None:
        if done == 2:
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        count(points, cells, size=100, journal=journal, report=interrupt)
    kept = journal.read_bytes()
    assert kept.count(b"\n") == 3
    journal.write_bytes(kept + b'{"block": 2, "pat')  # killed while it wrote
    told: list[tuple[str, int, int]] = []
    again = count(points, cells, size=100, journal=journal, report=lambda *what: told.append(what))
    assert again == whole
    assert [done for _, done, _ in told] == [2, 3, 4, 5]
    assert journal.read_bytes().startswith(kept)
    assert count(points, cells, size=100, journal=journal) == whole


def test_an_interrupt_is_one_while_compiled_code_runs(tmp_path: Path) -> None:
    """Whatever Numba makes of it; and what was done is kept."""
    journal = tmp_path / "journal"
    program = (
        "import signal; signal.signal(signal.SIGINT, signal.default_int_handler)\n"
        "import sys; from pathlib import Path; from scipy.spatial import Delaunay\n"
        "from certify.mesh.census import count; import numpy\n"
        "points = numpy.random.default_rng(0).random((40000, 3))\n"
        "cells = Delaunay(points).simplices\n"
        "try:\n"
        "    count(points, cells, size=100, journal=Path(sys.argv[1]), report=print)\n"
        "except KeyboardInterrupt: sys.exit(130)\n"
    )
    own = subprocess.Popen(
        [sys.executable, "-c", program, str(journal)],
        stdout=subprocess.PIPE,
        cwd=CHECKOUT,
        text=True,
    )
    assert own.stdout
    for line in own.stdout:
        if line.startswith("searching 3 "):
            own.send_signal(signal.SIGINT)
    assert own.wait() == 130
    assert journal.read_bytes().count(b"\n") >= 4


def test_the_journal_is_what_the_census_says(tmp_path: Path) -> None:
    """Blocks that a journal has are not searched again."""
    points, cells = mesh(0, 60)
    journal = tmp_path / "journal"
    count(points, cells, size=30, journal=journal)
    lines = journal.read_text().splitlines()
    record = json.loads(lines[1])
    record["patterns"]["5_A"] = 10**6
    journal.write_text("\n".join([lines[0], json.dumps(record), *lines[2:]]) + "\n")
    assert count(points, cells, size=30, journal=journal).patterns["5_A"] >= 10**6


@pytest.mark.parametrize("content", ["", "{}\n", "no json\n"])
def test_another_file_is_no_journal(content: str, tmp_path: Path) -> None:
    points, cells = mesh(0, 20)
    journal = tmp_path / "journal"
    count(*mesh(1, 20), journal=journal)
    if content:
        journal.write_text(content)
    with pytest.raises(NotItsJournal, match="not the journal"):
        count(points, cells, journal=journal)


def test_a_line_that_is_no_block_is_refused(tmp_path: Path) -> None:
    points, cells = mesh(0, 20)
    journal = tmp_path / "journal"
    count(points, cells, journal=journal)
    with journal.open("a") as file:
        file.write('{"block": 1}\n')
    with pytest.raises(NotItsJournal, match="line 3"):
        count(points, cells, journal=journal)


def test_doctests() -> None:
    failed, tried = doctest.testmod(certify.mesh.census)
    assert tried
    assert not failed
