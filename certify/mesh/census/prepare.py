"""A tetrahedral mesh made ready for the census: checked, oriented, and along a curve.

What is required of a mesh: no tetrahedron is flat, on each side of a triangle is at most one, none
overlap, and no two vertices of tetrahedra are the same point.
"""

from hashlib import sha256
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from certify.mesh.census.rings import Ints
from certify.mesh.compiled import interruptible
from certify.mesh.curve import along_the_curve
from certify.mesh.overlaps import coincident, overlap, sides
from certify.mesh.signs import Floats, numbers, orientations


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
        NotAMesh: A tetrahedron is none, is flat, has a triangle on the same side as another, or
            overlaps it, or one of its vertices is the same point as another vertex.
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
    if pair := coincident(given, [cells]):
        cell = int((cells == pair[1]).any(axis=1).argmax())
        raise NotAMesh(cell, f"has vertex {pair[1]}, which is the same point as vertex {pair[0]}")
    order = along_the_curve(given)
    rank = np.empty(len(order), np.int32)
    rank[order] = np.arange(len(order), dtype=np.int32)
    own, along = rank[cells], np.ascontiguousarray(given[order])
    signs = orientations(along, own)
    _require(signs != 0, "is flat", cells)
    own[signs < 0, 2:] = own[signs < 0, :1:-1]
    by_least = np.argsort(own.min(axis=1, initial=len(along)), kind="stable")
    own = np.ascontiguousarray(own[by_least])
    first, second, outside = sides(len(along), own)
    if first >= 0:
        _refuse(by_least[[first, second]], "has a triangle on the same side as")
    if pair := overlap(along, own, outside):
        _refuse(by_least[[*pair]], "overlaps")
    return Mesh(along, own, order)


def _cells(tetrahedra: ArrayLike) -> NDArray[Any]:
    given = np.asarray(tetrahedra)
    if given.ndim != 2 or given.shape[1] != 4:
        raise ValueError(f"the tetrahedra have the shape {given.shape} instead of (m, 4)")
    if given.dtype.kind not in "iu":
        raise ValueError("a vertex of a tetrahedron is not an integer")
    return given


def _refuse(pair: NDArray[np.int64], fault: str) -> None:
    one, other = sorted(pair.tolist())
    raise NotAMesh(other, f"{fault} tetrahedron {one}")


def _require(good: NDArray[np.bool_], fault: str, cells: NDArray[Any]) -> None:
    """Raise NotAMesh for the first cell that is not good."""
    if not good.all():
        cell = int(np.argwhere(~good)[0][0])
        raise NotAMesh(cell, f"with the vertices {cells[cell].tolist()}, {fault}")
