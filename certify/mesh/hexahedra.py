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
from certify.kernel.hexahedron import BOUNDARIES, CORNERS, Simplex, sorted_with_sign
from certify.kernel.validity import across
from certify.mesh.compiled import compiled
from certify.mesh.instances import QUADRUPLE_INDEX, Instance
from certify.mesh.jacobian import failing_edges, least, positive
from certify.mesh.quality import jacobian_bounds
from certify.mesh.realized import Booleans, fillable, fillable_at_all, labelled, realized
from certify.mesh.shapes import least_dihedral_angles, mean_ratios, scaled_jacobians
from certify.mesh.signs import Floats, Signs, signs

VALID = {1: "yes", -1: "no", 0: "undecided"}
"""What certify.mesh.jacobian.positive says, in words."""

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
        """Return the edges of a hexahedron on which the Jacobian is not positive everywhere."""
        return [] if self.valid[index] > 0 else failing_edges(self.points[index])

    @cached_property
    def jacobian_at_least(self) -> Floats:
        """A lower bound of the Jacobian on the closed cube, positive if it is valid: (n,)."""
        return least(self.points)

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

    @cached_property
    def _dihedrals(self) -> Floats:
        """The least dihedral angle of each realized triangulation: (n, 6966)."""
        return _least(self.realized, self._tetrahedra[0], _columns(self.root)[0])

    def best(self, index: int) -> list[Best]:
        """Return the best triangulation of each pattern that is realized, the smallest first."""
        tetrahedra, patterns = _columns(self.root)
        places = np.flatnonzero(self.realized[index])
        ordered = places[np.lexsort((-self._dihedrals[index, places], patterns[places]))]
        _, first, counts = np.unique(patterns[ordered], return_index=True, return_counts=True)
        found = []
        for place, count in zip(ordered[first].tolist(), counts.tolist(), strict=True):
            own = labelled(self.root)[place]
            ratio = self._tetrahedra[1][index, tetrahedra[place, : len(own.signs)]].min()
            found.append(Best(own, count, float(self._dihedrals[index, place]), float(ratio)))
        return found


_CORNERS = [
    (QUADRUPLE_INDEX[own], parity * (-1) ** sum(corner))
    for vertex, corner in CORNERS.items()
    for own, parity in [sorted_with_sign((vertex, *(across(vertex, axis) for axis in range(3))))]
]
"""For each corner the quadruple of it and its neighbours, with its sign in the reference cube."""


@lru_cache(maxsize=4)
def _columns(root: Path) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
    """Return the places of the tetrahedra of each labelled triangulation, and those of patterns.

    They are an array (6966, 15), whose rows are filled up with a place that is repeated, and one
    (6966,) of numbers that count the patterns from the smallest.
    """
    every = labelled(root)
    tetrahedra = np.empty((len(every), LONGEST), np.int64)
    for row, own in zip(tetrahedra, every, strict=True):
        places = [QUADRUPLE_INDEX[tetrahedron] for tetrahedron in own.tetrahedra]
        row[:] = (*places, *[places[0]] * (LONGEST - len(places)))
    return tetrahedra, np.array([PATTERN_NAMES.index(own.pattern) for own in every])


@compiled
def _least(found: Booleans, values: Floats, places: NDArray[np.int64]) -> Floats:
    """Return the least value at the places of each triangulation that is found."""
    out = np.zeros(found.shape)
    for h in range(len(found)):
        for t in range(found.shape[1]):
            if found[h, t]:
                out[h, t] = np.inf
                for place in places[t]:
                    out[h, t] = min(out[h, t], values[h, place])
    return out
