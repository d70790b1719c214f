"""One labelling for each hexahedron: the least of the 24 that rotations make one of another.

The 24 others of the 48 symmetries mirror the hexahedron: with them its Jacobian is negative. So a
valid hexahedron has 24 labellings, and no two valid ones differ by a symmetry.
"""

from functools import lru_cache
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from certify.kernel.chirotope import QUADRUPLES
from certify.kernel.hexahedron import CORNERS, SYMMETRIES, image
from certify.mesh.census.region import table
from certify.mesh.instances import QUADRUPLE_INDEX, handedness

NEIGHBOURS = np.array(
    [
        [w - 1 for w, d in CORNERS.items() if sum(x != y for x, y in zip(c, d, strict=True)) == 1]
        for c in CORNERS.values()
    ]
)
"""The three neighbours of each of the template's vertices, from 0."""


def canonical(
    hexahedra: NDArray[np.int64], instances: NDArray[np.int64], root: Path
) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
    """Return labellings, and labelled triangulations, with the least vertex first.

    Second is the least of its neighbours; that settles the rest.

    Args:
        hexahedra: An array (k, 8) of vertices.
        instances: An array (k,), the labelled triangulation that each is.
        root: Where the certificates are.
    """
    rotations, moved = _rotations(root)
    rows = np.arange(len(hexahedra))
    first = hexahedra.argmin(axis=1)
    second = NEIGHBOURS[first, hexahedra[rows[:, None], NEIGHBOURS[first]].argmin(axis=1)]
    own = _place()[first, second]
    return hexahedra[rows[:, None], rotations[own]], moved[own, instances]


@lru_cache(maxsize=1)
def _place() -> NDArray[np.int64]:
    """Return for the first two vertices the place of the rotation among the 24."""
    place = np.full((8, 8), -1)
    for own, rotation in enumerate(_orders()):
        place[rotation[0], rotation[1]] = own
    return place


@lru_cache(maxsize=1)
def _orders() -> NDArray[np.int64]:
    return np.array([own for own in SYMMETRIES if handedness(own) > 0]) - 1


@lru_cache(maxsize=4)
def _rotations(root: Path) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
    """Return the 24 orders of the vertices, and what each makes of every labelled triangulation.

    Vertex order[i] becomes i. So the quadruple Q of the new labelling is that which the order takes
    Q to of the old one.
    """
    keys = table(root).keys
    bits = np.unpackbits(keys.view(np.uint8), axis=1, bitorder="little")
    by_key = np.lexsort((keys[:, 0], keys[:, 1]))
    moved = np.empty((len(_orders()), len(keys)), np.int64)
    for own, order in enumerate(_orders()):
        source = [QUADRUPLE_INDEX[image(tuple(order + 1), q)] for q in QUADRUPLES]
        images = np.zeros_like(bits)
        images[:, : len(source)] = bits[:, source]
        found = np.packbits(images, axis=1, bitorder="little").view(np.uint64)
        moved[own, np.lexsort((found[:, 0], found[:, 1]))] = by_key  # both have the same keys
    return _orders(), moved
