"""Our own censuses, on record: what ``certify census`` printed, as it printed it.

A census takes longer than an audit may, so that it is not made again in a run. Each file of
certify/mesh/measured/ is the output of one command, which docs/meshes.md names.
"""

import json
from collections.abc import Mapping
from importlib.resources import files
from typing import NamedTuple, TypeAlias

Row: TypeAlias = tuple[int, ...]


class Sample(NamedTuple):
    """A mesh, and how many valid hexahedra of each pattern its tetrahedra combine to."""

    vertices: int
    patterns: Mapping[str, int]

    @property
    def sizes(self) -> list[int]:
        """The number of tetrahedra of each pattern that occurs."""
        return [int(name.partition("_")[0]) for name in self.patterns]

    @property
    def row(self) -> Row:
        """How many patterns with 5, 6, ..., 15 tetrahedra, as in Tables 3 and 4."""
        return tuple(self.sizes.count(size) for size in range(5, 16))

    def occurrences(self, above: int = 0) -> int:
        """Return how many hexahedra have more than so many tetrahedra."""
        counts = zip(self.sizes, self.patterns.values(), strict=True)
        return sum(times for size, times in counts if size > above)


def recorded(*names: str) -> tuple[Sample, ...]:
    """Return the meshes of some files."""
    folder = files("certify.mesh") / "measured"
    return tuple(
        Sample(run["vertices"], run["patterns"])
        for name in names
        for run in json.loads((folder / f"{name}.json").read_text("utf-8"))["runs"]
    )


RANDOM = recorded(*(f"random-{n}" for n in (3000, 10000, 20000, 100000, 500000, 1000000)))
"""Delaunay triangulations of random points, some for each of these numbers."""
