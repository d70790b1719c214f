"""Which choices of diagonals can each cell take, and what is the best filling for each of them?

Whether a boundary can be filled is decided exactly. For a hexahedron: one of the 6,966 labelled
triangulations that its points realize; or one of these with boundary tetrahedra laid on it, which
exchange the diagonals of their facets (certify/mesh/realized.py). There are no others (theorem
``patterns``). For a wedge and a pyramid all fillings are known (kinds.py).

The best filling of all is the one whose least dihedral angle is largest, by floating-point figures.
"""

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from functools import lru_cache
from itertools import combinations
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from certify.kernel.evidence import default_root
from certify.kernel.hexahedron import BOUNDARIES
from certify.mesh.compiled import compiled
from certify.mesh.instances import QUADRUPLE_INDEX
from certify.mesh.reading import BadMesh
from certify.mesh.realized import _FACET_SIGNS, Booleans, embedded, labelled, realized
from certify.mesh.signs import Floats, Signs, orientations
from certify.mesh.split.faces import Faces
from certify.mesh.split.kinds import (
    WIDTHS,
    Row,
    Rows,
    fillings,
    quadruples,
    realized_fillings,
    signs_of,
)

Words = NDArray[np.uint64]
Show = Callable[[str, int, int], None]

CHUNK = 4096
"""Hexahedra that are looked at together: their triangulations take 28 megabytes."""

WITHOUT = -1


class Arrays(NamedTuple):
    """What is known of cells, by number of the cell and by its bits (not its choice): (n, 64).

    best: number of the best filling, WITHOUT where there is none. For a hexahedron it is the place
    in labelled(); for others that in fillings(). laid: facets, as bits of a choice, on which
    boundary tetrahedra are laid. quality: its least dihedral angle in degrees.
    """

    best: NDArray[np.int16]
    laid: NDArray[np.uint8]
    quality: NDArray[np.float32]


@dataclass(frozen=True)
class Choices:
    """The choices of all cells. allowed: a word for each cell, with a bit for each number below 64.

    A tetrahedron has one choice, which is allowed.
    """

    arrays: Arrays
    allowed: Words


def choices_of(
    points: NDArray[Any], faces: Faces, root: Path | None = None, show: Show | None = None
) -> Choices:
    """Return what the cells can take; ``show`` is told what is done.

    Args:
        points: An array (n, 3) as certify.mesh.signs.numbers returns it.
        faces: The cells.
        root: Where the certificates are.
        show: Is told what is done, how much of how much.

    Raises:
        BadMesh: A cell is inside out.
    """
    shape = (faces.number, len(BOUNDARIES))
    arrays = Arrays(
        np.full(shape, WITHOUT, np.int16), np.zeros(shape, np.uint8), np.zeros(shape, np.float32)
    )
    own_root = root or default_root()
    for kind, rows in faces.cells.items():
        for part in _parts(len(rows)):
            own = slice(faces.start(kind) + part.start, faces.start(kind) + part.stop)
            taken = Arrays(arrays.best[own], arrays.laid[own], arrays.quality[own])
            _FILLED[kind](points, rows[part], faces.turns[own], taken, own_root)
            if kind != "tetra":
                _require_not_mirrored(points, kind, rows[part], part.start, taken, own_root)
            if show:
                show("filling cells", own.stop, faces.number)
    bits = np.uint64(1) << np.arange(len(BOUNDARIES), dtype=np.uint64)
    allowed = np.zeros(faces.number, np.uint64)
    for part in _parts(faces.number):
        found = arrays.best[part] != WITHOUT
        allowed[part] = np.bitwise_or.reduce(np.where(found, bits, np.uint64(0)), axis=1)
    return Choices(arrays, allowed)


def _parts(total: int) -> Iterator[slice]:
    for start in range(0, total, CHUNK):
        yield slice(start, min(start + CHUNK, total))


def figures(points: NDArray[Any]) -> Floats:
    """Return cells (n, k, 3) moved to the origin and scaled to unit size, as floats."""
    moved = points / 4 - points[:, :1] / 4  # no difference overflows
    size = np.abs(moved).max(axis=(1, 2), keepdims=True)
    return (moved / np.where(size == 0, 1, size)).astype(np.float64)


def _qualities(kind: str, points: NDArray[Any]) -> Floats:
    """Return the least dihedral angle of the tetrahedra on all quadruples: (n, number of these)."""
    threes: list[Row] = [*combinations(range(WIDTHS[kind]), 3)]
    fours = quadruples(kind)
    sides = [[threes.index(four[:i] + four[i + 1 :]) for i in range(4)] for four in fours]
    out = np.empty((len(points), len(fours)))
    _angles(figures(points), np.array(threes), np.array(sides), out)
    return out


@compiled
def _angles(points: Floats, threes: Rows, sides: Rows, out: Floats) -> None:
    """Set least dihedral angles in degrees, as certify.mesh.shapes has them, but faster.

    Let N(abc) be the normal on the side from which abc is counterclockwise. For increasing vertices
    the normal of the triangle opposite vertex i of four points outwards if it is multiplied by
    (-1)^i, or all four do if they are multiplied by -(-1)^i: so the cosine of the angle between i
    and j is -(-1)^(i + j) times the product of their normals.
    """
    normals = np.empty((len(threes), 3))
    for h in range(len(points)):
        for t in range(len(threes)):
            a, b, c = points[h, threes[t, 0]], points[h, threes[t, 1]], points[h, threes[t, 2]]
            x1, y1, z1 = b[0] - a[0], b[1] - a[1], b[2] - a[2]
            x2, y2, z2 = c[0] - a[0], c[1] - a[1], c[2] - a[2]
            x, y, z = y1 * z2 - z1 * y2, z1 * x2 - x1 * z2, x1 * y2 - y1 * x2
            length = np.sqrt(x * x + y * y + z * z)
            scale = 1.0 / length if length > 0 else 0.0
            normals[t, 0], normals[t, 1], normals[t, 2] = x * scale, y * scale, z * scale
        for f in range(len(sides)):
            most = -1.0
            for i in range(4):
                for j in range(i):
                    m, n = normals[sides[f, i]], normals[sides[f, j]]
                    product = m[0] * n[0] + m[1] * n[1] + m[2] * n[2]
                    most = max(most, product if (i + j) % 2 else -product)
            out[h, f] = np.degrees(np.arccos(min(most, 1.0)))


def _tetrahedra(_points: Any, _rows: Rows, _turns: Rows, out: Arrays, _root: Path) -> None:
    out.best[:, 0] = 0


def _small(kind: str) -> Callable[[Any, Rows, Rows, Arrays, Path], None]:
    def fill(points: Any, rows: Rows, turns: Rows, out: Arrays, _root: Path) -> None:
        """Take the best of the realized fillings for each choice."""
        found = realized_fillings(kind, signs_of(points, kind, rows))
        fours = quadruples(kind)
        angles = _qualities(kind, points[rows])
        for index, filling in enumerate(fillings(kind)):
            used = [fours.index(tetrahedron) for tetrahedron, _ in filling.signs]
            quality = angles[:, used].min(axis=1)
            cell = np.flatnonzero(found[:, index])
            bits = filling.choice ^ turns[cell]
            better = (out.best[cell, bits] == WITHOUT) | (quality[cell] > out.quality[cell, bits])
            out.best[cell[better], bits[better]] = index
            out.quality[cell[better], bits[better]] = quality[cell[better]]

    return fill


def _hexahedra(points: Any, rows: Rows, turns: Rows, out: Arrays, root: Path) -> None:
    chirotopes = signs_of(points, "hexahedron", rows)
    laid = np.stack([chirotopes[:, index] * sign for index, sign in _FACET_SIGNS], axis=1)
    _best_fillings(
        realized(chirotopes, root),
        embedded(chirotopes),
        laid.astype(np.int8),
        _qualities("hexahedron", points[rows]),
        *_instance_tables(root),
        np.array([index for index, _ in _FACET_SIGNS]),
        turns,
        out.best,
        out.laid,
        out.quality,
    )


@lru_cache(maxsize=4)
def _instance_tables(root: Path) -> tuple[Rows, Rows]:
    """Return the boundary of each labelled triangulation, and its quadruples, ended by -1."""
    every = labelled(root)
    longest = max(len(own.signs) for own in every) + 1
    used = np.full((len(every), longest), -1, np.int64)
    for index, own in enumerate(every):
        used[index, : len(own.signs)] = [QUADRUPLE_INDEX[t] for t in own.tetrahedra]
    return np.array([own.boundary for own in every], np.int64), used


@compiled
def _best_fillings(
    found: Booleans,
    allowed: Booleans,
    sides: Signs,
    angles: Floats,
    boundary: Rows,
    used: Rows,
    facet_quadruples: Rows,
    turns: Rows,
    best: NDArray[np.int16],
    laid: NDArray[np.uint8],
    quality: NDArray[np.float32],
) -> None:
    """Take for each choice the best realized triangulation, be it with some laid on it.

    sides: signs of the tetrahedra on the facets, positive if one lies inside with the diagonal 0.
    """
    plain, value = np.empty(64, np.int64), np.empty(64)
    for h in range(len(found)):
        plain[:], value[:] = WITHOUT, 0.0
        for t in range(len(boundary)):
            if found[h, t]:
                least, k = 180.0, 0
                while used[t, k] >= 0:
                    least = min(least, angles[h, used[t, k]])
                    k += 1
                b = boundary[t]
                if plain[b] == WITHOUT or least > value[b]:
                    plain[b], value[b] = t, least
        for b in range(64):
            bits = b ^ turns[h]
            if plain[b] != WITHOUT:
                best[h, bits], quality[h, bits] = plain[b], value[b]
            if not allowed[h, b]:
                continue
            layable = 0
            for f in range(6):
                bit = 1 << (5 - f)
                if sides[h, f] == (-1 if b & bit else 1):
                    layable |= bit
            flipped = layable
            while flipped:  # all sets of facets on which one can be laid
                inner = b ^ flipped
                if plain[inner] != WITHOUT:
                    least = value[inner]
                    for f in range(6):
                        if flipped & (1 << (5 - f)):
                            least = min(least, angles[h, facet_quadruples[f]])
                    if best[h, bits] == WITHOUT or least > quality[h, bits]:
                        best[h, bits], quality[h, bits] = plain[inner], least
                        laid[h, bits] = flipped
                flipped = (flipped - 1) & layable


_FILLED: dict[str, Callable[[Any, Rows, Rows, Arrays, Path], None]] = {
    "hexahedron": _hexahedra,
    "wedge": _small("wedge"),
    "pyramid": _small("pyramid"),
    "tetra": _tetrahedra,
}


def require_right_way(points: NDArray[Any], cells: Mapping[str, Rows]) -> None:
    """Raise BadMesh if all corners of a cell are negative, or a tetrahedron is flat."""
    for kind, rows in cells.items():
        found = corners(points, kind, rows)
        if kind == "tetra" and (found == 0).any():
            raise BadMesh(f"tetra {int((found == 0).argmax()) + 1} is flat")
        _require_none(kind, np.flatnonzero((found < 0).all(axis=1)))


def _require_not_mirrored(
    points: NDArray[Any], kind: str, rows: Rows, start: int, taken: Arrays, root: Path
) -> None:
    """Raise BadMesh if a cell cannot be filled, but its mirror image can."""
    empty = np.flatnonzero((taken.best == WITHOUT).all(axis=1))
    signs = -signs_of(points, kind, rows[empty])
    found = realized(signs, root) if kind == "hexahedron" else realized_fillings(kind, signs)
    _require_none(kind, start + empty[found.any(axis=1)])


def _require_none(kind: str, inside_out: Rows) -> None:
    if len(inside_out):
        more = f" (and {len(inside_out) - 1} more)" if len(inside_out) > 1 else ""
        raise BadMesh(
            f"{kind} {inside_out[0] + 1}{more} is inside out: its vertices are in the order of its "
            "mirror image"
        )


_CORNERS = {
    "hexahedron": (
        (0, 1, 3, 4), (1, 2, 0, 5), (2, 3, 1, 6), (3, 0, 2, 7),
        (4, 7, 5, 0), (5, 4, 6, 1), (6, 5, 7, 2), (7, 6, 4, 3),
    ),
    "wedge": (
        (0, 1, 2, 3), (1, 2, 0, 4), (2, 0, 1, 5), (3, 5, 4, 0), (4, 3, 5, 1), (5, 4, 3, 2),
    ),
    "pyramid": ((0, 1, 3, 4), (1, 2, 0, 4), (2, 3, 1, 4), (3, 0, 2, 4)),
    "tetra": ((0, 1, 2, 3),),
}  # fmt: skip
"""A vertex with three edges, and their ends, positive in the reference cell."""


def corners(points: NDArray[Any], kind: str, rows: Rows) -> Signs:
    """Return the signs of the corners of cells: (n, number of corners with three edges)."""
    own = rows[:, np.array(_CORNERS[kind])]
    return orientations(points, own.reshape(-1, 4)).reshape(own.shape[:2])
