"""Do tetrahedra split a mesh? Decided from the definition, whatever found them.

A split of a mesh are tetrahedra, each of which belongs to a cell, such that

1. each has four vertices of its cell, and a positive determinant;
2. those of a cell meet only in common faces, and the triangles that lie in but one of them are the
   triangular faces of the cell, and two for each quadrilateral, on both sides of a diagonal: so
   they fill what these triangles enclose (kinds.py);
3. every triangle lies in at most two tetrahedra of the mesh; it lies in one iff the face of which
   it is part belongs to one cell: so the two cells of a face cut it in the same way;
4. the volumes of a cell's tetrahedra sum up to the volume that its triangles enclose, exactly.
   (That follows from the others. It is asked as well.)

Not said is that tetrahedra of different cells do not overlap: overlaps.py decides that.
"""

from collections.abc import Mapping
from itertools import combinations
from math import lcm
from typing import Any

import numpy as np
from numpy.typing import NDArray

from certify.kernel.chirotope import dependence
from certify.mesh.compiled import compiled
from certify.mesh.signs import Numbers, Signs, numbers, orientations
from certify.mesh.split.kinds import QUADRILATERALS, TRIANGLES, WIDTHS, Row, Rows


class NotSplit(ValueError):
    """The tetrahedra do not split the mesh; the message says what is wrong."""


def require_split(
    points: Numbers, cells: Mapping[str, Rows], tetrahedra: Rows, owners: Rows
) -> None:
    """Raise NotSplit unless the tetrahedra split the mesh.

    Args:
        points: An array (n, 3) of integers, floating-point numbers or Fractions.
        cells: Kind -> rows of vertices, in the order of kinds.py; a wedge may be either way round.
        tetrahedra: An array (t, 4).
        owners: The cell of each, counted from 0 through the kinds in the order of WIDTHS.
    """
    given = numbers(points)
    total = sum(map(len, cells.values()))
    if len(owners) != len(tetrahedra) or not np.isin(np.arange(total), owners).all():
        raise NotSplit("not every cell has tetrahedra")
    if owners.min() < 0 or owners.max() >= total:
        raise NotSplit("a tetrahedron belongs to no cell")
    signs = orientations(given, tetrahedra)
    if (signs <= 0).any():
        index = int((signs <= 0).argmax())
        raise NotSplit(f"tetrahedron {index + 1} is {'inverted' if signs[index] else 'flat'}")
    order = np.argsort(owners, kind="stable")
    ordered, start = owners[order], 0
    surfaces = []
    for kind in WIDTHS:
        rows = cells.get(kind, np.empty((0, WIDTHS[kind]), np.int64))
        low, high = np.searchsorted(ordered, [start, start + len(rows)])
        own = tetrahedra[order[low:high]]
        if len(rows):
            cuts = _require_filled(given, kind, rows, own, ordered[low:high] - start)
            _require_volume(given, rows, own, ordered[low:high] - start, kind, cuts)
            surfaces.append(_faces(kind, rows, cuts))
        start += len(rows)
    triangles, faces = (np.concatenate(parts) for parts in zip(*surfaces, strict=True))
    _require_conforming(tetrahedra, triangles, faces)


def _require_filled(
    points: NDArray[Any], kind: str, rows: Rows, tetrahedra: Rows, owners: Rows
) -> Rows:
    """Require 1 and 2 of the cells of a kind; return for each quadrilateral how it is cut: 0 or 1.

    0 is the diagonal from its first to its third vertex.
    """
    same = tetrahedra[:, :, None] == rows[owners][:, None, :]
    if not same.any(axis=2).all():
        index = int((~same.any(axis=2)).any(axis=1).argmax())
        raise NotSplit(f"{kind} {owners[index] + 1} has a tetrahedron with another vertex")
    masks = (1 << same.argmax(axis=2)).sum(axis=1)
    starts = np.searchsorted(owners, np.arange(len(rows) + 1))
    cuts = np.zeros((len(rows), len(QUADRILATERALS[kind])), np.int64)
    faults = np.zeros(len(rows), np.int64)
    quads, triangles = _masks(QUADRILATERALS[kind], 4), _masks(TRIANGLES[kind], 3)
    quintuples, places, factors = _circuits(WIDTHS[kind])
    fours = rows[:, np.array([*combinations(range(WIDTHS[kind]), 4)])]
    signs = orientations(points, fours.reshape(-1, 4)).reshape(fours.shape[:2])
    _examine(signs, starts, masks, quads, triangles, quintuples, places, factors, cuts, faults)
    if faults.any():
        index = int((faults != 0).argmax())
        raise NotSplit(f"{kind} {index + 1}: {_FAULTS[int(faults[index])]}")
    return cuts


_FAULTS = {
    1: "a triangle lies in three of its tetrahedra",
    2: "its tetrahedra do not have its faces, each quadrilateral cut by one diagonal",
    3: "its tetrahedra overlap",
}


def _masks(faces: Any, width: int) -> Rows:
    """Return each vertex of each face as a bit: (number, width)."""
    return np.array([[1 << v for v in face] for face in faces], np.int64).reshape(-1, width)


def _circuits(vertices: int) -> tuple[Rows, Rows, Rows]:
    """Return of each quintuple the vertices as bits, the places of quadruples, and the factors."""
    fours: list[Row] = [*combinations(range(vertices), 4)]
    terms = [dependence(own) for own in combinations(range(vertices), 5)]
    return (
        np.array([[1 << t[0] for t in own] for own in terms], np.int64).reshape(-1, 5),
        np.array([[fours.index(t[1]) for t in own] for own in terms], np.int64).reshape(-1, 5),
        np.array([[t[2] for t in own] for own in terms], np.int64).reshape(-1, 5),
    )


@compiled
def _examine(
    signs: Signs,
    starts: Rows,
    masks: Rows,
    quads: Rows,
    triangles: Rows,
    quintuples: Rows,
    places: Rows,
    factors: Rows,
    cuts: Rows,
    faults: Rows,
) -> None:
    """Set what is wrong with each cell, and how its quadrilaterals are cut."""
    count = np.zeros(256, np.int64)
    for cell in range(len(starts) - 1):
        own = masks[starts[cell] : starts[cell + 1]]
        count[:] = 0
        for mask in own:
            for vertex in range(8):
                if mask >> vertex & 1:
                    count[mask & ~(1 << vertex)] += 1
        once = 0
        for times in count:
            once += times == 1
            if times > 2:
                faults[cell] = 1
        expected = 2 * len(quads) + len(triangles)
        right = once == expected
        for i in range(len(triangles)):
            right &= count[triangles[i].sum()] == 1
        for i in range(len(quads)):
            a, b, c, d = quads[i]
            first = count[a | b | c] == 1 and count[a | c | d] == 1
            second = count[a | b | d] == 1 and count[b | c | d] == 1
            right &= first != second
            cuts[cell, i] = second
        if not right:
            faults[cell] = 2
        for q in range(len(quintuples)):
            above, below = 0, 0
            for i in range(5):
                sign = signs[cell, places[q, i]] * factors[q, i]
                if sign > 0:
                    above |= quintuples[q, i]
                elif sign < 0:
                    below |= quintuples[q, i]
            has_above = has_below = False
            for mask in own:
                has_above |= above & ~mask == 0
                has_below |= below & ~mask == 0
            if above and has_above and has_below:
                faults[cell] = 3


def _halves(kind: str, cut: int) -> Rows:
    """Return the halves of all quadrilaterals that are cut in one way."""
    own = [(0, 1, 3), (1, 2, 3)] if cut else [(0, 1, 2), (0, 2, 3)]
    return np.array(
        [[[face[i] for i in half] for half in own] for face in QUADRILATERALS[kind]], np.int64
    ).reshape(-1, 2, 3)


def _faces(kind: str, rows: Rows, cuts: Rows) -> tuple[Rows, Rows]:
    """Return the triangles of the surfaces of cells, and the face of which each is part.

    The triangles are counterclockwise seen from inside, all halves of quadrilaterals first. A face
    is a row of four vertices, the last of a triangle being -1.
    """
    quads = rows[:, np.array(QUADRILATERALS[kind], np.int64).reshape(-1, 4)]
    one, other = (rows[:, _halves(kind, cut)] for cut in (0, 1))
    halves = np.where(cuts[:, :, None, None] == 1, other, one).reshape(-1, 3)
    triangles = rows[:, np.array(TRIANGLES[kind], np.int64).reshape(-1, 3)].reshape(-1, 3)
    padded = np.column_stack([triangles, np.full(len(triangles), -1)])
    faces = np.concatenate([np.repeat(quads.reshape(-1, 4), 2, axis=0), padded])
    return np.concatenate([halves, triangles]), faces


def _require_conforming(tetrahedra: Rows, triangles: Rows, faces: Rows) -> None:
    """Require 3: a triangle inside a cell is in two tetrahedra, part of a face in as many as cells.

    triangles: those of the surfaces of all cells, as often as cells have them; faces: theirs.
    """
    _, face = _numbered(np.sort(faces, axis=1))
    cells = np.bincount(face)[face] // np.where((faces >= 0).all(axis=1), 2, 1)
    solid = np.sort(tetrahedra[:, [*combinations(range(4), 3)]].reshape(-1, 3), axis=1)
    rows = np.concatenate([solid, np.sort(triangles, axis=1)])
    total, number = _numbered(rows)
    times = np.bincount(number[: len(solid)], minlength=total)
    expected = np.full(total, 2)
    expected[number[len(solid) :]] = cells
    if (times > 2).any():
        index = int((times[number] > 2).argmax())
        raise NotSplit(f"triangle {_listed(rows[index])} lies in three tetrahedra")
    if (times != expected).any():
        index = int((times != expected)[number].argmax())
        raise NotSplit(f"triangle {_listed(rows[index])} does not have a tetrahedron on each side")


def _numbered(rows: Rows) -> tuple[int, Rows]:
    """Return how many different rows there are, and a number for each row."""
    keys = [*(rows + 1).T]
    if rows.max(initial=0) < (1 << 21) - 1:  # three vertices fit into one key, which is faster
        keys[:3] = [keys[0] << 42 | keys[1] << 21 | keys[2]]
    order = np.lexsort(keys[::-1])
    new = np.zeros(len(rows), np.bool_)
    for key in keys:
        new[1:] |= key[order][1:] != key[order][:-1]
    number = np.empty(len(rows), np.int64)
    number[order] = np.cumsum(new)
    return int(number.max(initial=-1)) + 1, number


def _listed(row: Rows) -> str:
    return " ".join(str(vertex + 1) for vertex in row.tolist())


def _require_volume(
    points: NDArray[Any], rows: Rows, tetrahedra: Rows, owners: Rows, kind: str, cuts: Rows
) -> None:
    """Require 4, with integers of any size."""
    whole = _whole(points)
    a, b, c, d = (whole[tetrahedra[:, i]] for i in range(4))
    inside = np.add.reduceat(_determinants(b - a, c - a, d - a), np.flatnonzero(_first(owners)))
    surface, _ = _faces(kind, rows, cuts)
    halves = 2 * len(QUADRILATERALS[kind]) * len(rows)
    apex = whole[rows[:, 0]]
    enclosed = np.zeros(len(rows), object)
    for part in (surface[:halves], surface[halves:]):
        if len(part):
            a, b, c = (whole[part[:, i]].reshape(len(rows), -1, 3) for i in range(3))
            own = apex[:, None]
            enclosed = enclosed + _determinants(b - a, c - a, own - a).sum(axis=1)
    if kind == "wedge":
        enclosed = np.abs(enclosed)  # it may be either way round
    if (inside != enclosed).any():
        index = int((inside != enclosed).argmax())
        raise NotSplit(f"{kind} {index + 1}: its tetrahedra have another volume")


def _first(owners: Rows) -> NDArray[np.bool_]:
    return np.concatenate([[True], owners[1:] != owners[:-1]])


def _whole(points: NDArray[Any]) -> NDArray[Any]:
    """Return the points times a common denominator, as Python's integers."""
    ratios = [x.as_integer_ratio() for x in points.ravel().tolist()]
    unit = lcm(*{below for _, below in ratios})
    whole = [above * (unit // below) for above, below in ratios]
    return np.array(whole, object).reshape(points.shape)


def _determinants(a: NDArray[Any], b: NDArray[Any], c: NDArray[Any]) -> NDArray[Any]:
    x, y, z = (a[..., i] for i in range(3))
    out: NDArray[Any] = (
        x * (b[..., 1] * c[..., 2] - b[..., 2] * c[..., 1])
        - y * (b[..., 0] * c[..., 2] - b[..., 2] * c[..., 0])
        + z * (b[..., 0] * c[..., 1] - b[..., 1] * c[..., 0])
    )
    return out
