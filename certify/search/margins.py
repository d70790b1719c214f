"""The quantities that a good placement makes large, with their gradients."""

from itertools import product
from math import comb
from typing import Any, TypeAlias

import numpy as np
from numpy.typing import NDArray

from certify.kernel.hexahedron import CORNERS

Array: TypeAlias = NDArray[Any]

_PAIRS: Array = np.array([(v, w) for v in range(8) for w in range(8) if v != w])


def determinants(points: Array, quadruples: Array) -> tuple[Array, Array]:
    """Return the determinants of rows of indices, shape (n,), and their gradients (n, 8, 3)."""
    a, b, c, d = (points[quadruples[:, i]] for i in range(4))
    b, c, d = b - a, c - a, d - a
    by_b, by_c, by_d = np.cross(c, d), np.cross(d, b), np.cross(b, c)
    gradients = np.zeros((len(quadruples), 8, 3))
    for i, part in enumerate((-(by_b + by_c + by_d), by_b, by_c, by_d)):
        gradients[np.arange(len(quadruples)), quadruples[:, i]] = part
    return np.einsum("ni,ni->n", b, by_b), gradients


def _bernstein_tables() -> tuple[Array, Array]:
    """Return the 64 triples of edges, indices of shape (64, 3, 2), and their weights (27, 64)."""
    index = {corner: vertex - 1 for vertex, corner in CORNERS.items()}
    edges, weights = [], np.zeros((3, 3, 3, 64))
    for n, (v1, w1, u2, w2, u3, v3) in enumerate(product((0, 1), repeat=6)):
        ends = (
            ((0, v1, w1), (1, v1, w1)),
            ((u2, 0, w2), (u2, 1, w2)),
            ((u3, v3, 0), (u3, v3, 1)),
        )
        edges.append([[index[corner] for corner in edge] for edge in ends])
        i, j, k = u2 + u3, v1 + v3, w1 + w2
        weights[i, j, k, n] = 1 / (comb(2, i) * comb(2, j) * comb(2, k))
    return np.array(edges), weights.reshape(27, 64)


EDGES, WEIGHTS = _bernstein_tables()


def bernstein(points: Array) -> tuple[Array, Array]:
    """Return the 27 Bernstein coefficients of the Jacobian and their gradients (27, 8, 3)."""
    u, v, w = (points[EDGES[:, i, 1]] - points[EDGES[:, i, 0]] for i in range(3))
    parts = (np.cross(v, w), np.cross(w, u), np.cross(u, v))
    gradients = np.zeros((64, 8, 3))
    for i, part in enumerate(parts):
        gradients[np.arange(64), EDGES[:, i, 1]] += part
        gradients[np.arange(64), EDGES[:, i, 0]] -= part
    return WEIGHTS @ np.einsum("ni,ni->n", u, parts[0]), np.tensordot(WEIGHTS, gradients, 1)


def distances_beyond(points: Array, directions: Array) -> tuple[Array, Array]:
    """Return how far v lies beyond w in v's direction, for all v != w, and the slopes (56, 48)."""
    v, w = _PAIRS.T
    apart = points[v] - points[w]
    slopes = np.zeros((len(_PAIRS), 2, 8, 3))
    rows = np.arange(len(_PAIRS))
    slopes[rows, 0, v] = directions[v]
    slopes[rows, 0, w] = -directions[v]
    slopes[rows, 1, v] = apart
    return np.einsum("ni,ni->n", directions[v], apart), slopes.reshape(-1, 48)
