"""The census of the hexahedra of a tetrahedral mesh.

>>> from certify.kernel.hexahedron import CORNERS
>>> from certify.mesh.census import count
>>> cube = [[float(x) for x in corner] for corner in CORNERS.values()]
>>> count(cube, [[0, 1, 2, 5], [0, 2, 3, 7], [0, 2, 5, 7], [0, 4, 5, 7], [2, 5, 6, 7]]).patterns
{'5_A': 1}

The functions need the extra ``mesh``; those that ask a Dask scheduler, the extra ``cluster``.
"""

from certify.mesh.census.counting import Census, count, counted, hexahedra, streamed
from certify.mesh.census.prepare import NotAMesh

__all__ = ["Census", "NotAMesh", "count", "counted", "hexahedra", "streamed"]
