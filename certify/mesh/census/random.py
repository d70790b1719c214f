"""Delaunay triangulations of random points, as in the paper's Table 4."""

from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import Delaunay


def random_mesh(points: int, seed: int) -> tuple[NDArray[np.float64], NDArray[np.integer[Any]]]:
    """Return uniformly random points in the unit cube, (n, 3), and their tetrahedra, (m, 4).

    The same seed gives the same points on every machine (numpy's default generator) and, unless
    rounding decides, the same tetrahedra (scipy's, which is qhull's).
    """
    drawn = np.random.default_rng(seed).random((points, 3))
    return drawn, Delaunay(drawn).simplices
