"""What splitting a mesh costs, as multiples of what Delaunay tetrahedra of its vertices cost.

    python benchmarks/cost_of_splitting.py [CELLS_ALONG_AN_EDGE]

The mesh is a grid of cubes, every vertex moved by up to 0.35 of an edge: some cells are not convex,
and a fixed recipe inverts tetrahedra. It is split once for each quality; then the check alone, by
require_split, is timed, and what reading and writing take. The unit is scipy.spatial.Delaunay of
the same points, whose tetrahedra do not know of the cells. Processor time on one core; the medians
of three rounds count.
"""

import statistics
import sys
import tempfile
import time
from collections.abc import Callable
from functools import partial
from pathlib import Path

import meshio
from scipy.spatial import Delaunay

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))

from certify.mesh.reading import read_mesh
from certify.mesh.split import require_split, split
from certify.mesh.split.reporting import write_tetrahedra
from certify.mesh.split.solving import QUALITIES
from tests.meshes import warped


def timed(work: Callable[[], object], rounds: int = 3) -> float:
    """Return the median processor time of a round."""
    seconds = []
    for _ in range(rounds):
        start = time.process_time()
        work()
        seconds.append(time.process_time() - start)
    return statistics.median(seconds)


def main(edge: int) -> None:
    """Print a table of ratios."""
    points, cells = warped(1, 100, 35, edge, edge, edge)
    answer = split(points, cells)  # compiles
    own = answer.tetrahedra
    if own is None or answer.shape is None:
        sys.exit("the mesh cannot be split")
    recipe = answer.by_numbers
    print(f"{edge**3} hexahedra, {answer.shape.tetrahedra} tetrahedra; by a fixed recipe")
    print(f"{recipe.tetrahedra}, {recipe.not_positive} of them inverted or flat\n")
    unit = timed(lambda: Delaunay(points))
    with tempfile.TemporaryDirectory() as folder:
        given, out = Path(folder, "given.vtu"), Path(folder, "out.vtu")
        meshio.write(given, meshio.Mesh(points, [*cells.items()]))
        works: dict[str, Callable[[], object]] = {
            f"split, quality {quality}": partial(split, points, cells, quality)
            for quality in QUALITIES
        }
        check = partial(require_split, points, cells, own.vertices, own.cells)
        works["of which require_split"] = check
        works["reading the mesh"] = partial(read_mesh, given)
        works["writing, and reading back"] = partial(write_tetrahedra, out, answer)
        for name, work in works.items():
            seconds = timed(work)
            print(
                f"{name:26} {seconds / unit:6.2f} x scipy.spatial.Delaunay   "
                f"{edge**3 / seconds:9.0f} hexahedra a second"
            )


if __name__ == "__main__":
    main(int(sys.argv[1]) if sys.argv[1:] else 46)
