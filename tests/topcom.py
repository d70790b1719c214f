"""TOPCOM (Rambau 2002), which enumerates the triangulations of a point configuration.

Its programs are called topcom-... in Debian, whose package is ``topcom``, and not so elsewhere.
"""

import re
import shutil
import subprocess
from collections.abc import Sequence

from certify.kernel.hexahedron import Simplex

ALL = shutil.which("topcom-points2alltriangs") or shutil.which("points2alltriangs")
"""The program that finds all triangulations, or None if TOPCOM is not installed."""

Tetrahedra = tuple[Simplex, ...]


def all_triangulations(points: Sequence[Sequence[int]]) -> set[Tetrahedra]:
    """Return all triangulations of the convex hull of integer points, with vertices 1, 2, ..."""
    assert ALL is not None
    rows = ",".join(f"[{','.join(map(str, [*point, 1]))}]" for point in points)
    result = subprocess.run([ALL], input=f"[{rows}]", capture_output=True, text=True, check=True)
    found = set()
    for line in result.stdout.splitlines():
        simplices = re.findall(r"\{(\d+(?:,\d+)*)\}", line.partition(":=")[2])
        found.add(tuple(sorted(tuple(int(v) + 1 for v in s.split(",")) for s in simplices)))
    return found
