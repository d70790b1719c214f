"""What a part of a large census costs: is ten million points feasible on this machine?

    python -m benchmarks.slice_of_census [TILES] [POINTS] [BLOCKS]

The mesh is made of boxes side by side, each of so many random points, triangulated by Qhull; all
points in one box would want more memory than a small machine has. The mesh is made ready as a
whole. Then blocks evenly spread over it are searched, and the time of all is told from theirs.
"""

import resource
import sys
import time

import numpy as np
from scipy.spatial import Delaunay

from certify.kernel.evidence import default_root
from certify.mesh.census import hexahedra
from certify.mesh.census.blocks import blocks, number_of_blocks, searched
from certify.mesh.census.counting import BLOCK
from certify.mesh.census.prepare import prepare

DEFAULTS = (10, 1_000_000, 20)


def peak() -> str:
    """Return the largest memory of this process so far."""
    return f"peak memory {resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024:,.0f} MB"


def main() -> None:
    """Print the times, the rate and the memory."""
    tiles, number, wanted = [*map(int, sys.argv[1:]), *DEFAULTS[len(sys.argv) - 1 :]]
    hexahedra(few := np.random.default_rng(0).random((60, 3)), Delaunay(few).simplices)  # compiles
    points = np.empty((tiles * number, 3))
    cells, unit = [], 0.0
    for tile in range(tiles):
        own = np.random.default_rng(tile).random((number, 3)) + np.array([2 * tile, 0, 0])
        begin = time.perf_counter()
        cells.append(Delaunay(own).simplices + np.int32(tile * number))
        unit += time.perf_counter() - begin
        points[tile * number : (tile + 1) * number] = own
    tetrahedra = np.concatenate(cells)
    cells.clear()
    print(f"{len(points):,} points, {len(tetrahedra):,} tetrahedra, triangulated; {peak()}")
    begin = time.perf_counter()
    mesh = prepare(points, tetrahedra)
    del points, tetrahedra
    ready = time.perf_counter() - begin
    print(f"made ready: {ready / unit:.2f} x triangulating; {peak()}")
    total = number_of_blocks(mesh, BLOCK)
    chosen = {total * k // wanted for k in range(wanted)}
    others = frozenset(range(total)) - chosen
    begin = time.perf_counter()
    parts = blocks(mesh, BLOCK, default_root(), others)
    first = searched(next(parts))
    cutting, found = time.perf_counter() - begin, len(first.vertices)
    begin = time.perf_counter()
    for block in parts:
        found += len(searched(block).vertices)
    searching = time.perf_counter() - begin
    rate = (found - len(first.vertices)) / searching
    print(f"the first block, with what all need: {cutting / unit:.2f} x triangulating")
    print(
        f"{len(chosen)} of {total} blocks: {found:,} valid hexahedra, {rate:,.0f} a second; "
        f"{peak()}\nso the whole, by one process, would take "
        f"{(ready + cutting + searching * total / (len(chosen) - 1)) / unit:.2f} x triangulating "
        f"and find about {found * total // len(chosen):,}"
    )


if __name__ == "__main__":
    main()
