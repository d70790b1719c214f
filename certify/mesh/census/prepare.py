"""A tetrahedral mesh made ready for the census: checked, oriented, and along a curve.

The curve fills space: vertices that are near one another on it are neighbours.

What is required of a mesh: no tetrahedron is flat, and on each side of a triangle is at most one.
Of tetrahedra that overlap without having a triangle in common nothing is noticed; the census then
says what it finds, which need not be embedded.
"""

from hashlib import sha256
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from certify.mesh.census.rings import NEXT, Ints
from certify.mesh.compiled import borrowing, compiled, interruptible
from certify.mesh.signs import Floats, numbers, orientations

CHUNK = 1 << 20
"""The triangles of so many vertices are looked at together."""


BITS = 20
"""Every axis is cut into 2^BITS parts; a place on the curve takes three times as many bits."""


class NotAMesh(ValueError):
    """The tetrahedra are no mesh; the message and ``cell``, from 0, say where."""

    def __init__(self, cell: int, fault: str) -> None:
        super().__init__(f"tetrahedron {cell}, counted from 0, {fault}")
        self.cell = cell


class Mesh(NamedTuple):
    """A mesh along the curve.

    points: (n, 3); tetrahedra: (m, 4), with positive determinants, sorted by their least vertex;
    order: the number that each vertex was given with.
    """

    points: Floats
    tetrahedra: Ints
    order: NDArray[np.int64]

    @property
    def digest(self) -> str:
        """The SHA-256 of the mesh, which tells it from all others."""
        found = sha256()
        for part in self:
            found.update(np.ascontiguousarray(part).data)
        return found.hexdigest()


def prepare(points: ArrayLike, tetrahedra: ArrayLike) -> Mesh:
    """Return the mesh along the curve.

    Args:
        points: An array (n, 3) of floating-point numbers.
        tetrahedra: An array (m, 4) of vertices, from 0, in any order.

    Raises:
        NotAMesh: A tetrahedron is none, is flat, or has a triangle on the same side as another.
        ValueError: An array has another shape, or what is in it are no finite numbers.
    """
    with interruptible():
        return _prepared(numbers(points), _cells(tetrahedra))


def _prepared(given: NDArray[Any], cells: NDArray[Any]) -> Mesh:
    if given.ndim != 2 or given.shape[1] != 3:
        raise ValueError(f"the points have the shape {given.shape} instead of (n, 3)")
    if given.dtype == object:
        raise ValueError("a coordinate is not a floating-point number of 64 bits")
    _require(cells >= 0, "has a vertex below 0", cells)
    _require(cells < len(given), f"has a vertex that is none of the {len(given)}", cells)
    order = along_the_curve(given)
    rank = np.empty(len(order), np.int32)
    rank[order] = np.arange(len(order), dtype=np.int32)
    own, along = rank[cells], np.ascontiguousarray(given[order])
    signs = orientations(along, own)
    _require(signs != 0, "is flat", cells)
    own[signs < 0, 2:] = own[signs < 0, :1:-1]
    first, second = _clash(len(along), own, CHUNK)
    if first >= 0:
        raise NotAMesh(int(second), f"has a triangle on the same side as tetrahedron {first}")
    by_least = np.argsort(own.min(axis=1, initial=len(along)), kind="stable")
    return Mesh(along, np.ascontiguousarray(own[by_least]), order)


def _cells(tetrahedra: ArrayLike) -> NDArray[Any]:
    given = np.asarray(tetrahedra)
    if given.ndim != 2 or given.shape[1] != 4:
        raise ValueError(f"the tetrahedra have the shape {given.shape} instead of (m, 4)")
    if given.dtype.kind not in "iu":
        raise ValueError("a vertex of a tetrahedron is not an integer")
    return given


def _require(good: NDArray[np.bool_], fault: str, cells: NDArray[Any]) -> None:
    """Raise NotAMesh for the first cell that is not good."""
    if not good.all():
        cell = int(np.argwhere(~good)[0][0])
        raise NotAMesh(cell, f"with the vertices {cells[cell].tolist()}, {fault}")


def _clash(count: int, tetrahedra: Ints, chunk: int) -> tuple[int, int]:
    """Return two tetrahedra on the same side of a triangle, or -1 twice."""
    for low in range(0, count, chunk):
        found = _clash_between(tetrahedra, low, min(low + chunk, count))
        if found[0] >= 0:
            return found
    return -1, -1


@compiled
def _clash_between(tetrahedra: Ints, low: int, high: int) -> tuple[int, int]:
    """Look only at triangles whose least vertex is in a range."""
    end = np.zeros(high - low + 1, np.int64)
    for t in range(len(tetrahedra)):
        for i in range(4):
            x = _triangle(tetrahedra[t], i)[0]
            if low <= x < high:
                end[x - low + 1] += 1
    end = np.cumsum(end)
    place, keys, owners = end.copy(), np.empty(end[-1], np.int64), np.empty(end[-1], np.int32)
    for t in range(len(tetrahedra)):
        for i in range(4):
            x, b, c = _triangle(tetrahedra[t], i)
            if low <= x < high:
                k = place[x - low]
                keys[k], owners[k] = np.int64(b) << 32 | np.int64(c), t
                place[x - low] += 1
    for x in range(high - low):
        own = keys[end[x] : end[x + 1]]
        order = np.argsort(own)
        for k in range(1, len(own)):
            if own[order[k]] == own[order[k - 1]]:
                one, other = owners[end[x] + order[k]], owners[end[x] + order[k - 1]]
                return min(one, other), max(one, other)
    return -1, -1


@borrowing
def _triangle(tetrahedron: Ints, i: int) -> tuple[int, int, int]:
    """Return the triangle opposite to a vertex, seen from inside, beginning with the least."""
    a, b, c = tetrahedron[NEXT[i, 0]], tetrahedron[NEXT[i, 1]], tetrahedron[NEXT[i, 2]]
    if b < a and b < c:
        return b, c, a
    if c < a and c < b:
        return c, a, b
    return a, b, c


def along_the_curve(points: Floats) -> NDArray[np.int64]:
    """Return the order in which Hilbert's curve visits the points; ties keep their order."""
    return np.argsort(places(points), kind="stable")


def places(points: Floats) -> NDArray[np.int64]:
    """Return the place of each point on Hilbert's curve through the cube around all points.

    The method is Skilling's (2004, "Programming the Hilbert curve"): undo the rotations of the
    levels, from the coarsest to the finest, take the Gray code back, and interleave the bits.
    """
    if not len(points):
        return np.zeros(0, np.int64)
    low, high = points.min(axis=0), points.max(axis=0)
    half = float((0.5 * high - 0.5 * low).max()) or 1.0  # halves, as the difference may overflow
    with np.errstate(under="ignore"):
        parts = (0.5 * points - 0.5 * low) / half * (2**BITS - 1)
    x, y, z = np.clip(parts, 0, 2**BITS - 1).astype(np.int64).T.copy()
    for level in range(BITS - 1, 0, -1):
        bit, below = 1 << level, (1 << level) - 1
        x ^= np.where(x & bit, below, 0)
        for axis in (y, z):
            swapped = np.where(axis & bit, 0, (x ^ axis) & below)
            x ^= np.where(axis & bit, below, swapped)
            np.bitwise_xor(axis, swapped, out=axis)
    y ^= x
    z ^= y
    flip = np.zeros_like(x)
    for level in range(BITS - 1, 0, -1):
        flip ^= np.where(z & (1 << level), (1 << level) - 1, 0)
    out: NDArray[np.int64] = np.zeros_like(x)
    for level in range(BITS - 1, -1, -1):
        for axis in (x, y, z):
            out = out << 1 | ((axis ^ flip) >> level & 1)
    return out
