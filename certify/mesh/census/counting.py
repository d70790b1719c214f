"""The census: all valid hexahedra that the tetrahedra of a mesh combine to, counted by pattern.

A *hexahedron of a mesh* is a labelling of eight of its vertices, up to the symmetries of the cube,
such that the region it encloses is a union of tetrahedra of the mesh on these vertices, one of the
labelled triangulations of the hexahedron. It is *valid* if its Jacobian is positive on the closed
cube, exactly. That it has the twelve edges, and two triangles on each facet, follows.
"""

from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path

import numpy as np
from numpy.typing import ArrayLike, NDArray

from certify.kernel.certificate import PATTERN_NAMES
from certify.kernel.evidence import default_root
from certify.mesh.census.blocks import Block, Hexahedra, blocks, least, number_of_blocks, searched
from certify.mesh.census.journal import Counts, opened
from certify.mesh.census.prepare import Mesh, prepare
from certify.mesh.census.running import mapping
from certify.mesh.compiled import interruptible
from certify.mesh.instances import instances

BLOCK = 10_000
"""A block owns so many vertices, unless told otherwise."""

Report = Callable[[str, int, int], object]
"""Told what is being done, how much of it is done, and how much there is."""


@dataclass(frozen=True)
class Census:
    """What a mesh has.

    vertices, tetrahedra: how many; patterns: name -> how many valid hexahedra, for those that
    occur, in the order of the names; witnesses: name -> the first of them along the curve, eight
    vertices in the order of the template; undecided: hexahedra of which nobody knows whether the
    Jacobian is positive, which are counted nowhere else.
    """

    vertices: int
    tetrahedra: int
    patterns: dict[str, int]
    witnesses: dict[str, tuple[int, ...]]
    undecided: tuple[tuple[int, ...], ...]

    @property
    def hexahedra(self) -> int:
        """How many valid hexahedra."""
        return sum(self.patterns.values())


def count(
    points: ArrayLike,
    tetrahedra: ArrayLike,
    jobs: int = 1,
    scheduler: str | None = None,
    journal: Path | None = None,
    report: Report | None = None,
    size: int = BLOCK,
    root: Path | None = None,
    take: Callable[[Hexahedra], object] | None = None,
) -> Census:
    """Count the valid hexahedra of a mesh by pattern.

    Args:
        points: An array (n, 3) of floating-point numbers.
        tetrahedra: An array (m, 4) of vertices, from 0, in any order.
        jobs: How many processes.
        scheduler: The address of a Dask scheduler, whose workers search instead.
        journal: A file that keeps the blocks done. If it has some of this mesh, they are not done
            again.
        report: Told about the progress.
        size: How many vertices a block owns.
        root: Where the certificates are.
        take: Given the hexahedra of each block that is searched, in any order.

    Raises:
        ValueError: This is no mesh, or the journal is another's.
        ChildProcessError: One of the processes was killed.
    """
    mesh, root = prepare(points, tetrahedra), root or default_root()
    total = number_of_blocks(mesh, size)
    done, keeping = opened(journal, {"mesh": mesh.digest, "size": size})
    _compile(root)
    with interruptible(), keeping as keep, mapping(jobs, scheduler) as mapped:
        rest = blocks(mesh, size, root, frozenset(done))
        _tell(report, len(done), total)
        for number, counts in (
            _taken(mapped(searched, rest), take, root) if take else mapped(_counted, rest)
        ):
            done[number] = counts
            keep(number, counts)
            _tell(report, len(done), total)
    return _summed(mesh, [done[number] for number in sorted(done)])


def hexahedra(
    points: ArrayLike, tetrahedra: ArrayLike, root: Path | None = None
) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
    """Return the valid hexahedra of a mesh: an array (k, 8) of vertices, and (k,) of what they are.

    Each is in its least labelling, in the order of the template, which is that of VTK. What it is
    is the place of its tetrahedra among :func:`certify.mesh.labelled`.

    Raises:
        ValueError: This is no mesh.
    """
    found = [*streamed(points, tetrahedra, root=root)]
    return (
        np.concatenate([np.zeros((0, 8), np.int64), *(own.vertices for own in found)]),
        np.concatenate([np.zeros(0, np.int64), *(own.instances for own in found)]),
    )


def streamed(
    points: ArrayLike,
    tetrahedra: ArrayLike,
    jobs: int = 1,
    scheduler: str | None = None,
    report: Report | None = None,
    size: int = BLOCK,
    root: Path | None = None,
) -> Iterator[Hexahedra]:
    """Yield the valid hexahedra of a mesh, each in its least labelling, a block when it is done.

    Whoever writes them to a file never holds them all. The arguments are those of :func:`count`;
    the blocks come in any order if there are several processes.

    Raises:
        ValueError: This is no mesh.
        ChildProcessError: One of the processes was killed.
    """
    mesh, root = prepare(points, tetrahedra), root or default_root()
    total = number_of_blocks(mesh, size)
    _compile(root)
    with interruptible(), mapping(jobs, scheduler) as mapped:
        _tell(report, 0, total)
        own = blocks(mesh, size, root)
        for done, found in enumerate(mapped(_least, own), start=1):
            yield found
            _tell(report, done, total)


def counted(found: Hexahedra, root: Path) -> Counts:
    """Return how many there are of each pattern, and the first of each in its least labelling."""
    patterns = _patterns(root)[found.instances]
    times = np.bincount(patterns, minlength=len(PATTERN_NAMES)).tolist()
    first = np.zeros(len(PATTERN_NAMES), np.int64)
    first[patterns[::-1]] = np.arange(len(patterns))[::-1]
    present = [i for i, k in enumerate(times) if k]
    witnesses = Hexahedra(
        0, found.vertices[first[present]], found.instances[first[present]], found.undecided
    )
    shown = least(witnesses, root).vertices.tolist()
    return Counts(
        {PATTERN_NAMES[i]: times[i] for i in present},
        {PATTERN_NAMES[i]: tuple(own) for i, own in zip(present, shown, strict=True)},
        tuple(map(tuple, found.undecided.tolist())),
    )


def _taken(
    found: Iterable[Hexahedra], take: Callable[[Hexahedra], object], root: Path
) -> Iterator[tuple[int, Counts]]:
    for own in found:
        take(least(own, root))
        yield own.number, counted(own, root)


@lru_cache(maxsize=4)
def _patterns(root: Path) -> NDArray[np.int64]:
    """Return the place of the pattern of each labelled triangulation among the names."""
    place = {name: i for i, name in enumerate(PATTERN_NAMES)}
    return np.array([place[own.pattern] for own in instances(root)])


def _compile(root: Path) -> None:
    """Search a block of nothing: then processes find the search compiled, on disk at least."""
    nothing = np.zeros((0, 3)), np.zeros((0, 4), np.int32), np.zeros(0, np.int64)
    with interruptible():
        _counted(Block(0, *nothing, 0, root))


def _counted(block: Block) -> tuple[int, Counts]:
    return block.number, counted(searched(block), block.root)


def _least(block: Block) -> Hexahedra:
    return least(searched(block), block.root)


def _tell(report: Report | None, done: int, total: int) -> None:
    if report:
        report("searching", done, total)


def _summed(mesh: Mesh, parts: list[Counts]) -> Census:
    """Add up the blocks, which are in the order of the curve."""
    patterns = {name: sum(part.patterns.get(name, 0) for part in parts) for name in PATTERN_NAMES}
    witnesses = {
        name: next(part.witnesses[name] for part in parts if name in part.witnesses)
        for name, times in patterns.items()
        if times
    }
    return Census(
        len(mesh.points),
        len(mesh.tetrahedra),
        {name: times for name, times in patterns.items() if times},
        witnesses,
        tuple(own for part in parts for own in part.undecided),
    )
