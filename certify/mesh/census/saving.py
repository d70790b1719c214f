"""The hexahedra that a census found, as a mesh."""

from collections.abc import Sequence
from pathlib import Path

import meshio
import numpy as np
from numpy.typing import NDArray

from certify.kernel.certificate import PATTERN_NAMES
from certify.mesh.census.blocks import Hexahedra
from certify.mesh.files import silence
from certify.mesh.instances import instances


def write_hexahedra(
    path: Path, points: NDArray[np.float64], found: Sequence[Hexahedra], root: Path
) -> None:
    """Write hexahedra as cells of a VTU file; they overlap, as many share tetrahedra.

    Each has as data the number of its tetrahedra and its pattern, counted from 1 in the order of
    ``certify list``. Those of one pattern follow one another.
    """
    every = instances(root)
    number = np.array([PATTERN_NAMES.index(own.pattern) + 1 for own in every])
    size = np.array([len(own.signs) for own in every])
    own = np.concatenate([np.zeros(0, np.int64), *(part.instances for part in found)])
    cells = np.concatenate([np.zeros((0, 8), np.int64), *(part.vertices for part in found)])
    order = np.lexsort((*cells.T[::-1], number[own]))
    data = {"pattern": [number[own[order]]], "tetrahedra": [size[own[order]]]}
    with silence():
        meshio.write(
            path,
            meshio.Mesh(points, [("hexahedron", cells[order])], cell_data=data),
            "vtu",
            binary=True,
            compression="zlib",
        )
