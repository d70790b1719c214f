"""What the theorems mean for given hexahedra: triangulations, boundaries, validity, quality.

What is so is decided exactly; the qualities are floating-point figures. A hexahedron is *mirrored*
if its points realize triangulations only as in a mirror: then its vertices are in the order of the
mirrored template, and what is found is what its mirror image realizes.
"""

from dataclasses import dataclass, field
from fractions import Fraction
from functools import cached_property, lru_cache
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from certify.kernel.certificate import PATTERN_NAMES
from certify.kernel.chirotope import QUADRUPLES, Point
from certify.kernel.hexahedron import BOUNDARIES, CORNERS, Simplex, simplex, sorted_with_sign
from certify.kernel.jacobian import bernstein_coefficients
from certify.kernel.validity import across
from certify.mesh.compiled import compiled
from certify.mesh.instances import QUADRUPLE_INDEX, Instance
from certify.mesh.jacobian import positive
from certify.mesh.quality import jacobian_bounds
from certify.mesh.realized import Booleans, fillable, fillable_at_all, labelled, realized
from certify.mesh.shapes import least_dihedral_angles, mean_ratios, scaled_jacobians
from certify.mesh.signs import Floats, Signs, signs

VALID = {1: "yes", -1: "no", 0: "undecided"}
"""What certify.mesh.jacobian.positive says, in words."""

NONE = -1.0
"""Stands for the angle of a triangulation that is not realized."""

LONGEST = 15
"""The largest triangulations have so many tetrahedra."""


class Best(NamedTuple):
    """The best realized triangulation of a pattern, and how many are realized.

    The best has the largest least dihedral angle, in degrees. The mean ratio is the least of its
    tetrahedra; that of a regular one is 1.
    """

    instance: Instance
    realized: int
    dihedral: float
    mean_ratio: float


@dataclass(frozen=True)
class Hexahedra:
    """Some hexahedra: an array (n, 8, 3) of float64 or of Fractions, vertex 1 first.

    root: where the certificates are whose tetrahedra are asked for; boundaries: those of the 64
    that are asked for, (64,).
    """

    points: NDArray[Any]
    root: Path
    boundaries: Booleans = field(default_factory=lambda: np.ones(len(BOUNDARIES), np.bool_))

    @cached_property
    def _given(self) -> tuple[Signs, Booleans]:
        found = signs(self.points)
        return found, realized(found, self.root)

    @cached_property
    def mirrored(self) -> Booleans:
        """Which are mirrored: (n,)."""
        found, own = self._given
        mirrored: Booleans = np.zeros(len(own), np.bool_)
        without = np.flatnonzero(~own.any(axis=1))
        mirrored[without] = realized(-found[without], self.root).any(axis=1)
        return mirrored

    @cached_property
    def chirotopes(self) -> Signs:
        """The signs (n, 70), of the mirror image if it is mirrored."""
        return np.where(self.mirrored[:, None], -self._given[0], self._given[0])

    @cached_property
    def realized(self) -> Booleans:
        """Which labelled triangulations with the boundaries asked for are realized: (n, 6966)."""
        own = self._given[1].copy()
        own[self.mirrored] = realized(self.chirotopes[self.mirrored], self.root)
        return own & self.boundaries[[each.boundary for each in labelled(self.root)]]

    @cached_property
    def fillable(self) -> Booleans:
        """Which of the boundaries asked for a realized triangulation fills: (n, 64)."""
        return fillable(self.realized, self.root)

    @cached_property
    def fillable_at_all(self) -> Booleans:
        """Which of these can be filled, be it with boundary tetrahedra: (n, 64)."""
        return fillable_at_all(self.chirotopes, self.root) & self.boundaries

    @cached_property
    def valid(self) -> Signs:
        """Whether the Jacobian is positive on the closed cube, as VALID says: (n,)."""
        return positive(self.points)

    @cached_property
    def corners(self) -> Booleans:
        """At which corners the Jacobian is not positive: (n, 8)."""
        found = [self._given[0][:, place] * sign <= 0 for place, sign in _CORNERS]
        return np.stack(found, axis=1)

    def edges(self, index: int) -> list[Simplex]:
        """Return the edges of a hexahedron on which the Jacobian is not positive everywhere.

        On an edge it is a quadratic polynomial with Bernstein coefficients a, b, c. It is positive
        iff a > 0, c > 0 and, if b < 0, also b^2 < ac: then its least value, which it has where
        t : 1-t is a-b : c-b, is (ac - b^2) / (a - 2b + c).
        """
        if self.valid[index] > 0:
            return []
        found = bernstein_coefficients(self.exact(index))
        rows = [(edge, *(found[place] for place in places)) for edge, places in _EDGES.items()]
        return [edge for edge, a, b, c in rows if min(a, c) <= 0 or (b < 0 and b**2 >= a * c)]

    def jacobian_bounds(self, index: int) -> tuple[Fraction, Fraction]:
        """Return exact bounds of the least Jacobian of a hexahedron; see quality.py."""
        return jacobian_bounds(self.exact(index))

    def exact(self, index: int) -> tuple[Point, ...]:
        """Return the points of a hexahedron as the kernel takes them."""
        return tuple(tuple(map(Fraction, point)) for point in self.points[index].tolist())

    @cached_property
    def scaled_jacobians(self) -> Floats:
        """The scaled Jacobian at each of the corners: (n, 8)."""
        return scaled_jacobians(self._figures)

    @cached_property
    def _figures(self) -> Floats:
        """The hexahedra moved to the origin and scaled to unit size, as floating-point numbers."""
        moved = self.points / 4 - self.points[:, :1] / 4  # no difference overflows
        size = np.abs(moved).max(axis=(1, 2), keepdims=True)
        return (moved / np.where(size == 0, 1, size)).astype(np.float64)

    @cached_property
    def _tetrahedra(self) -> tuple[Floats, Floats]:
        """The least dihedral angle and the mean ratio of all tetrahedra: (n, 70)."""
        own = self._figures[:, np.array(QUADRUPLES) - 1]
        flat = own.reshape(-1, 4, 3)
        shape = own.shape[:2]
        return least_dihedral_angles(flat).reshape(shape), mean_ratios(flat).reshape(shape)

    @property
    def sizes(self) -> NDArray[np.int64]:
        """The number of tetrahedra of each labelled triangulation: (6966,)."""
        found: NDArray[np.int64] = (_rows(self.root) >= 0).sum(axis=1)
        return found

    @cached_property
    def dihedrals(self) -> Floats:
        """The least dihedral angle of each realized triangulation, else NONE: (n, 6966)."""
        return _least(self.realized, self._tetrahedra[0], _rows(self.root))

    def described(self, index: int, place: int, count: int) -> Best:
        """Return a realized triangulation as the best of so many."""
        rows = _rows(self.root)[place]
        ratio = self._tetrahedra[1][index, rows[rows >= 0]].min()
        own = labelled(self.root)[place]
        return Best(own, count, float(self.dihedrals[index, place]), float(ratio))

    def best(self, index: int) -> list[Best]:
        """Return the best triangulation of each pattern that is realized, the smallest first."""
        found = []
        for places in _patterns(self.root).values():
            count = int(self.realized[index, places].sum())
            if count:
                best = places[self.dihedrals[index, places].argmax()]
                found.append(self.described(index, int(best), count))
        return found


_CORNERS = [
    (QUADRUPLE_INDEX[own], parity * (-1) ** sum(corner))
    for vertex, corner in CORNERS.items()
    for own, parity in [sorted_with_sign((vertex, *(across(vertex, axis) for axis in range(3))))]
]
"""For each corner the quadruple of it and its neighbours, with its sign in the reference cube."""


def _edges() -> dict[Simplex, list[tuple[int, ...]]]:
    """Return for each edge of the template where its three Bernstein coefficients are."""
    found = {}
    for vertex, corner in CORNERS.items():
        for axis in range(3):
            if corner[axis] == 0:
                start = [2 * x for x in corner]
                places = [(*start[:axis], i, *start[axis + 1 :]) for i in range(3)]
                found[simplex((vertex, across(vertex, axis)))] = places
    return dict(sorted(found.items()))


_EDGES = _edges()


@lru_cache(maxsize=4)
def _rows(root: Path) -> NDArray[np.int64]:
    """Return the places of the tetrahedra of each labelled triangulation, then -1: (6966, 15)."""
    table = np.full((len(labelled(root)), LONGEST), -1)
    for row, own in zip(table, labelled(root), strict=True):
        row[: len(own.signs)] = [QUADRUPLE_INDEX[tetrahedron] for tetrahedron in own.tetrahedra]
    return table


@lru_cache(maxsize=4)
def _patterns(root: Path) -> dict[str, NDArray[np.int64]]:
    """Return the places of each pattern's labelled triangulations, the smallest patterns first."""
    names = np.array([own.pattern for own in labelled(root)])
    return {pattern: np.flatnonzero(names == pattern) for pattern in PATTERN_NAMES}


@compiled
def _least(found: Booleans, values: Floats, rows: NDArray[np.int64]) -> Floats:
    """Return the least value of the tetrahedra of each triangulation found, else NONE."""
    out = np.full(found.shape, NONE)
    for h in range(len(found)):
        for t in range(found.shape[1]):
            if found[h, t]:
                least = np.inf
                for q in rows[t]:
                    if q >= 0:
                        least = min(least, values[h, q])
                out[h, t] = least
    return out
