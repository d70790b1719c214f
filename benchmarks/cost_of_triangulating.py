"""How fast eight points get all their triangulations, against TOPCOM on the same points.

    python benchmarks/cost_of_triangulating.py [HEXAHEDRA]

Each hexahedron is a cube of which every vertex is moved a little, to integers: convex, with all
facets bent. TOPCOM gets one process for each; what it takes for a tetrahedron is its start-up, and
told apart. Both must find equally many triangulations. One core; the median of three rounds counts.
"""

import statistics
import sys
import time
from collections.abc import Callable
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))

from certify.kernel.hexahedron import CORNERS
from certify.mesh.realized import triangulations
from tests.topcom import ALL, all_triangulations

TETRAHEDRON = [(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)]
COPIES = 100
"""Ours are timed on so many copies of the hexahedra: one would be over at once."""


def timed(work: Callable[[], object], rounds: int = 3) -> float:
    """Return the median time of a round."""
    seconds = []
    for _ in range(rounds):
        start = time.perf_counter()
        work()
        seconds.append(time.perf_counter() - start)
    return statistics.median(seconds)


def main(number: int) -> None:
    """Print what each costs, and the ratio."""
    if ALL is None:
        sys.exit("TOPCOM is not installed")
    random = np.random.default_rng(1)
    points = 1000 * np.array([*CORNERS.values()]) + random.integers(-150, 151, size=(number, 8, 3))
    found = triangulations(points).sum(axis=1)
    assert found.tolist() == [len(all_triangulations(own)) for own in points.tolist()]
    many = np.tile(points, (COPIES, 1, 1)).astype(float)
    own = timed(lambda: [triangulations(part) for part in np.array_split(many, COPIES)]) / COPIES
    start = timed(lambda: [all_triangulations(TETRAHEDRON) for _ in range(number)])
    topcom = timed(lambda: [all_triangulations(own) for own in points.tolist()])
    print(f"{number} hexahedra, {found.sum()} triangulations, as many by TOPCOM")
    print(f"certify.mesh.triangulations: {number / own:.0f} hexahedra a second")
    print(
        f"TOPCOM takes {topcom / own:.0f} times as long, "
        f"without start-up {(topcom - start) / own:.0f}"
    )


if __name__ == "__main__":
    main(int(sys.argv[1]) if sys.argv[1:] else 300)
