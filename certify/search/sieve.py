"""The kernel's tests on many integer placements at once: how many conditions does each fail?

All arithmetic is on integers, in which numpy is exact and calls no BLAS: the counts are the same
on every machine. Determinants fit into 32 bits as long as coordinates are at most 400 apart, the
comparison of shapes into 64 bits on grids that are at most 20 wide.
"""

from collections.abc import Iterable, Mapping
from fractions import Fraction
from itertools import combinations, product
from typing import Any, TypeAlias

import numpy as np
from numpy.typing import NDArray

from certify.kernel.chirotope import QUADRUPLES, QUINTUPLES, dependence
from certify.kernel.hexahedron import CORNERS, VERTICES, Simplex

Array: TypeAlias = NDArray[Any]


def _bits(vertices: Iterable[int]) -> int:
    return sum(1 << (vertex - 1) for vertex in vertices)


_QUADS: Array = np.array(QUADRUPLES) - 1
_TERMS = [dependence(quintuple) for quintuple in QUINTUPLES]
_TERM_QUADS: Array = np.array([[QUADRUPLES.index(q) for _, q, _ in terms] for terms in _TERMS])
_TERM_SIGNS: Array = np.array([[[s] for _, _, s in terms] for terms in _TERMS], dtype=np.int32)
_TERM_BITS: Array = np.array([[[_bits((v,))] for v, _, _ in t] for t in _TERMS], dtype=np.uint8)


def _jacobian_terms() -> tuple[Array, Array]:
    """Return the 64 triples of edges, (64, 3, 2), and the number of each in order, (64,).

    Up to a positive factor each of the 27 Bernstein coefficients of the Jacobian is a sum of
    determinants of triples of edges, and each of the 64 determinants occurs in one of these sums.
    """
    index = {corner: vertex - 1 for vertex, corner in CORNERS.items()}
    terms = []
    for v1, w1, u2, w2, u3, v3 in product((0, 1), repeat=6):
        ends = (
            ((0, v1, w1), (1, v1, w1)),
            ((u2, 0, w2), (u2, 1, w2)),
            ((u3, v3, 0), (u3, v3, 1)),
        )
        edges = [[index[corner] for corner in edge] for edge in ends]
        terms.append((9 * (u2 + u3) + 3 * (v1 + v3) + w1 + w2, edges))
    terms.sort()
    return np.array([edges for _, edges in terms]), np.array([number for number, _ in terms])


_EDGES, _COEFFICIENTS = _jacobian_terms()
_, _FIRST, _SIZES = np.unique(_COEFFICIENTS, return_index=True, return_counts=True)
_AT_CORNERS: Array = _FIRST[_SIZES == 1]
"""At a corner the Jacobian is one determinant."""


class Sieve:
    """The conditions that make a placement a witness: realization, and as asked convex and valid.

    The bar is the square of the scaled Jacobian that a valid witness has to exceed at its corners.
    """

    def __init__(self, orientation: Mapping[Simplex, int], convex: bool, valid: bool) -> None:
        self.tetrahedra = np.array([QUADRUPLES.index(t) for t in orientation])
        self.signs = np.array([[sign] for sign in orientation.values()], dtype=np.int32)
        face = np.zeros(256, dtype=bool)
        for tetrahedron in orientation:
            for size in (1, 2, 3, 4):
                face[[_bits(vertices) for vertices in combinations(tetrahedron, size)]] = True
        self.forbidden = face[:, None] & face
        if convex:
            vertices = [_bits((vertex,)) for vertex in VERTICES]
            self.forbidden[vertices] = self.forbidden[:, vertices] = True
        self.valid = valid
        self.bar = Fraction(0)

    def failures(self, placements: Array) -> Array:
        """Return how many conditions each of the placements, shape (n, 8, 3), fails.

        They are the signs of the tetrahedra, the circuits (see embedding.py in the kernel), the
        Bernstein coefficients, undivided, and the shape of the corners.
        """
        points = np.ascontiguousarray(placements.transpose(1, 2, 0), dtype=np.int32)
        values = _determinants(points[_QUADS[:, 1:]] - points[_QUADS[:, :1]])
        count = (values[self.tetrahedra] * self.signs <= 0).sum(axis=0)
        terms = values[_TERM_QUADS] * _TERM_SIGNS
        positive = ((terms > 0) * _TERM_BITS).sum(axis=1, dtype=np.uint8)
        negative = ((terms < 0) * _TERM_BITS).sum(axis=1, dtype=np.uint8)
        count += self.forbidden[positive, negative].sum(axis=0)
        if self.valid:
            edges, jacobians = _jacobians(points)
            count += (np.add.reduceat(jacobians, _FIRST) <= 0).sum(axis=0)
            above, below = _squared_shapes(edges, jacobians)
            count += (above * self.bar.denominator <= below * self.bar.numerator).sum(axis=0)
        return np.asarray(count)


def shape(points: Array) -> Fraction:
    """Return the square of the least scaled Jacobian at the corners, with its sign.

    At a corner: the determinant of the three edges over the product of their lengths.
    """
    above, below = _squared_shapes(*_jacobians(points[:, :, None]))
    return min(map(Fraction, above[:, 0].tolist(), below[:, 0].tolist()))


def _jacobians(points: Array) -> tuple[Array, Array]:
    """Return the triples of edges, (64, 3, 3, n), and their determinants, (64, n)."""
    edges = points[_EDGES[:, :, 1]] - points[_EDGES[:, :, 0]]
    return edges, _determinants(edges)


def _squared_shapes(edges: Array, jacobians: Array) -> tuple[Array, Array]:
    """Return d |d|, d the Jacobian at a corner, and its edges' product of squares, each (8, n)."""
    d = jacobians[_AT_CORNERS].astype(np.int64)
    return d * abs(d), (edges[_AT_CORNERS] ** 2).sum(axis=2).prod(axis=1)


def _determinants(vectors: Array) -> Array:
    """Return the determinants of triples of vectors, (m, 3, 3, n), as an array (m, n)."""
    a, b, c = vectors.transpose(1, 2, 0, 3)
    return np.asarray(
        a[0] * (b[1] * c[2] - b[2] * c[1])
        + a[1] * (b[2] * c[0] - b[0] * c[2])
        + a[2] * (b[0] * c[1] - b[1] * c[0])
    )
