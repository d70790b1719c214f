"""What a census costs: as a multiple of the triangulation of the same points, and of trying all.

    python -m benchmarks.census [POINTS] [JOBS ...]

The points are random in the unit cube, and triangulated by Qhull in the same run. The processor
time of one process is compared as well as the time on the clock: other programs disturb it less.
"""

import resource
import sys
import time
from collections.abc import Callable
from functools import partial
from typing import Any

import numpy as np
from scipy.spatial import Delaunay

from certify.mesh.census import count, hexahedra
from tests import brute_census

FEW = 60
"""So many points are enough for trying all."""


def timed(function: Callable[[], Any]) -> tuple[Any, float, float]:
    """Return a result, the seconds it took, and those of the processor, in this process."""
    clock, processor = time.perf_counter(), time.process_time()
    result = function()
    return result, time.perf_counter() - clock, time.process_time() - processor


def main() -> None:
    """Print a table of ratios, and the largest memory of one process."""
    number = int(sys.argv[1]) if len(sys.argv) > 1 else 100_000
    jobs = [int(word) for word in sys.argv[2:]] or [1, 2]
    points = np.random.default_rng(0).random((number, 3))
    few = points[:FEW]
    cells = Delaunay(few).simplices
    found, _ = hexahedra(few, cells)  # compiles, or reads what was compiled
    tried, _, trying = timed(lambda: brute_census.hexahedra(few.tolist(), cells.tolist()))
    if set(map(tuple, found.tolist())) != set(tried):
        raise SystemExit("the census is not what trying all finds")
    by_trying = len(tried) / trying
    mesh, unit, _ = timed(lambda: Delaunay(points))
    print(f"{number} points, {len(mesh.simplices)} tetrahedra, triangulated in {unit:.1f} s")
    for own in jobs:
        census, clock, processor = timed(partial(count, points, mesh.simplices, jobs=own))
        print(
            f"{own} {'process' if own == 1 else 'processes'}: "
            f"{census.hexahedra} valid hexahedra of {len(census.patterns)} patterns, "
            f"{clock / unit:.2f} x triangulating, "
            f"{census.hexahedra / clock:,.0f} a second, "
            f"{census.hexahedra / clock / by_trying:,.0f} x as fast as trying all"
            + (f"; {census.hexahedra / processor:,.0f} a processor second" if own == 1 else "")
        )
    peak = max(
        resource.getrusage(who).ru_maxrss
        for who in (resource.RUSAGE_SELF, resource.RUSAGE_CHILDREN)
    )
    print(f"peak memory of a process {peak / 1024:.0f} MB")


if __name__ == "__main__":
    main()
