"""What a census found, as a row of the paper's Tables 3 and 4, and rechecked by the kernel."""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from fractions import Fraction
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from certify.kernel.chirotope import chirotope
from certify.kernel.embedding import NotRealized, require_realization
from certify.kernel.hexahedron import VERTICES, simplex
from certify.kernel.jacobian import require_positive_jacobian
from certify.mesh.census.counting import Census
from certify.mesh.instances import Instance, instances

SIZES = range(5, 16)
"""The triangulations of the hexahedron have so many tetrahedra."""


@dataclass(frozen=True)
class Run:
    """What is kept of a census.

    mesh: its name; patterns: name -> how many valid hexahedra, for those that occur; undecided: how
    many hexahedra nobody knows to be valid or not; kernel: how many patterns it confirmed.
    """

    mesh: str
    vertices: int
    tetrahedra: int
    patterns: Mapping[str, int]
    undecided: int
    kernel: int

    @property
    def hexahedra(self) -> int:
        """How many valid hexahedra."""
        return sum(self.patterns.values())

    @property
    def row(self) -> tuple[int, ...]:
        """How many patterns with 5, 6, ..., 15 tetrahedra, as in Tables 3 and 4 of the paper."""
        sizes = [_size(name) for name in self.patterns]
        return tuple(sizes.count(size) for size in SIZES)

    @property
    def occurrences(self) -> tuple[int, ...]:
        """How many valid hexahedra with 5, 6, ..., 15 tetrahedra."""
        return tuple(
            sum(times for name, times in self.patterns.items() if _size(name) == size)
            for size in SIZES
        )

    def record(self) -> dict[str, Any]:
        """Return it for JSON."""
        return {
            "mesh": self.mesh,
            "vertices": self.vertices,
            "tetrahedra": self.tetrahedra,
            "hexahedra": self.hexahedra,
            "undecided": self.undecided,
            "row": list(self.row),
            "confirmed_by_the_kernel": self.kernel,
            "patterns": dict(self.patterns),
        }


def _size(name: str) -> int:
    return int(name.partition("_")[0])


class NotConfirmed(ValueError):
    """The kernel does not find in a hexahedron what the census found; the message says what."""


def confirmed(
    mesh: str,
    points: NDArray[np.float64],
    tetrahedra: NDArray[np.integer[Any]],
    found: Census,
    root: Path,
) -> Run:
    """Return a census of which the kernel has confirmed the first hexahedron of each pattern.

    Their tetrahedra are taken from the mesh once more. The kernel decides whether the points
    realize the pattern and whether the Jacobian is positive; how often it says so is counted. What
    it does not decide is that a Jacobian needs more subdivisions than it makes.

    Raises:
        NotConfirmed: It says that this is not so.
    """
    near = np.isin(tetrahedra, np.unique([*found.witnesses.values()])).all(axis=1)
    cells = tetrahedra[near]
    kernel = 0
    for pattern, vertices in found.witnesses.items():
        own = _instance(pattern, vertices, cells, root)
        eight = [tuple(map(Fraction, points[vertex].tolist())) for vertex in vertices]
        try:
            require_realization(dict(own.signs), chirotope(eight))
            require_positive_jacobian(eight)
            kernel += 1
        except NotRealized as fault:
            if "not shown positive" not in str(fault):
                raise NotConfirmed(f"{_told(pattern, vertices)}: {fault}") from None
    return Run(mesh, found.vertices, found.tetrahedra, found.patterns, len(found.undecided), kernel)


def _instance(
    pattern: str, vertices: tuple[int, ...], cells: NDArray[np.integer[Any]], root: Path
) -> Instance:
    """Return the labelled triangulation of a pattern whose tetrahedra are in the mesh."""
    names = dict(zip(vertices, VERTICES, strict=True))
    own = cells[np.isin(cells, vertices).all(axis=1)]
    there = {simplex(tuple(names[vertex] for vertex in cell)) for cell in own.tolist()}
    for known in instances(root):
        if known.pattern == pattern and there.issuperset(known.tetrahedra):
            return known
    raise NotConfirmed(f"{_told(pattern, vertices)}: its tetrahedra are not in the mesh")


def _told(pattern: str, vertices: tuple[int, ...]) -> str:
    return f"{pattern} with the vertices {' '.join(str(vertex + 1) for vertex in vertices)}"


def spread(runs: list[Run]) -> Iterator[tuple[str, tuple[int, ...], int, int]]:
    """Yield the least and the most of each entry of the rows, of their totals, and of hexahedra."""
    for name, choose in (("least", min), ("most", max)):
        row = tuple(choose(column) for column in zip(*(run.row for run in runs), strict=True))
        total = choose(sum(run.row) for run in runs)
        yield name, row, total, choose(run.hexahedra for run in runs)
