"""Exact selection of witnesses among many integer placements at once."""

from collections.abc import Iterable, Mapping
from itertools import combinations

import numpy as np

from certify.kernel.chirotope import QUADRUPLES, QUINTUPLES, dependence
from certify.kernel.hexahedron import CORNERS, VERTICES, Simplex
from certify.kernel.validity import across
from certify.search.margins import EDGES, WEIGHTS, Array

QUADS: Array = np.array(QUADRUPLES) - 1
_CORNER_EDGES: Array = np.array([[across(v, axis) for axis in range(3)] for v in VERTICES]) - 1
_CORNER_SIGNS: Array = np.array([(-1) ** sum(corner) for corner in CORNERS.values()])


class Sieve:
    """The kernel's tests in 64-bit integers; validity by Bernstein coefficients, undivided."""

    def __init__(self, orientation: Mapping[Simplex, int], convex: bool, valid: bool) -> None:
        self.tetrahedra = np.array([QUADRUPLES.index(t) for t in orientation])
        self.signs = np.array(list(orientation.values()))
        self.forbidden_pair = np.zeros(256, dtype=bool)
        self.forbidden_side = np.zeros(256, dtype=bool)
        for tetrahedron in orientation:
            for size in (1, 2, 3, 4):
                for face in combinations(tetrahedron, size):
                    self.forbidden_pair[_bits(face)] = True
        if convex:
            self.forbidden_side[[_bits((vertex,)) for vertex in VERTICES]] = True
        self.valid = valid

    def __call__(self, placements: Array) -> Array:
        """Return those of the placements, shape (n, 8, 3), that are witnesses."""
        placements = placements.astype(np.int64)
        for step in (self._oriented, self._embedded, self._positive):
            placements = placements[step(placements)]
        return placements

    def _oriented(self, placements: Array) -> Array:
        values = _determinants(placements, QUADS[self.tetrahedra])
        return np.asarray((values * self.signs > 0).all(axis=1))

    def _embedded(self, placements: Array) -> Array:
        chirotopes = np.sign(_determinants(placements, QUADS))
        good = np.ones(len(placements), dtype=bool)
        for terms in map(dependence, QUINTUPLES):
            columns = [QUADRUPLES.index(quadruple) for _, quadruple, _ in terms]
            values = chirotopes[:, columns] * np.array([sign for _, _, sign in terms])
            bits = np.array([_bits((vertex,)) for vertex, _, _ in terms])
            positive, negative = (values > 0) @ bits, (values < 0) @ bits
            good &= ~(self.forbidden_pair[positive] & self.forbidden_pair[negative])
            good &= ~(self.forbidden_side[positive] | self.forbidden_side[negative])
        return good

    def _positive(self, placements: Array) -> Array:
        if not self.valid:
            return np.ones(len(placements), dtype=bool)
        u, v, w = (placements[:, EDGES[:, i, 1]] - placements[:, EDGES[:, i, 0]] for i in range(3))
        jacobians = (u * np.cross(v, w)).sum(axis=-1)
        return np.asarray((jacobians @ WEIGHTS.T > 1e-6).all(axis=1))


def _bits(vertices: Iterable[int]) -> int:
    return sum(1 << (vertex - 1) for vertex in vertices)


def _determinants(placements: Array, quadruples: Array) -> Array:
    """Return the determinants of many placements, shape (n, len(quadruples))."""
    a, b, c, d = (placements[:, quadruples[:, i]] for i in range(4))
    return np.asarray(((b - a) * np.cross(c - a, d - a)).sum(axis=-1))


def scaled_jacobians(placements: Array) -> Array:
    """Return the least scaled Jacobian at the corners of each placement, shape (n,).

    At a corner: the determinant of the three edges over the product of their lengths.
    """
    edges = placements[:, _CORNER_EDGES] - placements[:, :, None]
    values = (edges[:, :, 0] * np.cross(edges[:, :, 1], edges[:, :, 2])).sum(axis=-1)
    lengths = np.sqrt((edges.astype(float) ** 2).sum(axis=-1)).prod(axis=-1)
    with np.errstate(invalid="ignore"):
        scaled = _CORNER_SIGNS * values / lengths
    return np.asarray(np.nan_to_num(scaled, nan=-1.0).min(axis=-1))
