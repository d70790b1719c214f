"""The hexahedra that a census found, as a mesh."""

import re
from collections.abc import Sequence
from pathlib import Path
from shutil import copyfileobj

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
    ``certify list``; a comment tells the names. Those of one pattern follow one another.
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
    occurring = np.unique(number[own]).tolist()
    _name(path, "pattern: " + ", ".join(f"{k} {PATTERN_NAMES[k - 1]}" for k in occurring))


def _name(path: Path, legend: str) -> None:
    """Put a legend in the place of the comment that meshio writes."""
    beside = path.with_suffix(".part")
    with path.open("rb") as old, beside.open("wb") as new:
        start = old.read(1 << 12)
        new.write(re.sub(rb"<!--.*?-->", f"<!--{legend}-->".encode(), start, count=1))
        copyfileobj(old, new)
    beside.replace(path)
