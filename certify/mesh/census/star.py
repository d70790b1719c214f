"""The quadrilaterals at a vertex.

A quadrilateral vpsq is a facet that a hexahedron might have at its vertex v: it has a diagonal, vs
or pq, with both its triangles in the mesh. Of each, only those are listed whose other vertices are
greater than v: it is the least of its hexahedron.
"""

from typing import NamedTuple

import numpy as np

from certify.mesh.census.rings import Ints, Rings, Words, along, meets, product
from certify.mesh.compiled import borrowing, compiled

BOTH = 3
"""Kinds of quadrilaterals: 1 has the diagonal vs, 2 has pq, 3 has both; 4 has both and vpsq is a
tetrahedron of the mesh with a positive determinant, 5 likewise with a negative one."""


class Star(NamedTuple):
    """The quadrilaterals at a vertex v, each twice: sorted by p, then by q.

    A neighbour of v is known by its number among all of them, from 0.
    neighbours: how many; begin: where the runs of each p begin, and the end; q: of each run;
    start: where its quadrilaterals begin, and the end; s, kind: of each quadrilateral, the kind as
    it is seen from p; to_p, to_q: the edges from s.
    Towards the far corner, if p < q: tips, where the vertices of the ring of sp begin at which the
    corner s might have a positive determinant, and the end; tip, those; side, 1 if the order of
    the corner's edges must be sp, sq, to the tip, 2 if it must be sq, sp, to the tip, 3 if both are
    possible; ahead and aback: the hints, see Rings, of those of either order.
    """

    neighbours: int
    begin: Ints
    q: Ints
    start: Ints
    s: Ints
    kind: Ints
    to_p: Ints
    to_q: Ints
    tips: Ints
    tip: Ints
    side: Ints
    ahead: Words
    aback: Words


@compiled
def star(rings: Rings, v: int, number: Ints, rows: Ints) -> tuple[Star, Ints]:
    """Return the quadrilaterals at a vertex, and the scratch array, which may have grown.

    number: for each vertex of the mesh a scratch number; rows: of six.
    """
    first, end = rings.first[v], rings.first[v + 1]
    for e in range(first, end):
        number[rings.heads[e]] = e - first
    found = _listed(rings, v, number, rows)
    while found > len(rows):
        rows = grown(rows)
        found = _listed(rings, v, number, rows)
    begin, q, start, columns = _sorted(rows, found, end - first)
    tips, tip, side, hints = _tips(rings, v, begin, start, q, columns)
    s, kind, to_p, to_q = columns
    quadrilaterals = Star(
        len(begin) - 1, begin, q, start, s, kind, to_p, to_q, tips, tip, side, hints[0], hints[1]
    )
    return quadrilaterals, rows


@compiled
def grown(rows: Ints) -> Ints:
    """Return an array with twice as many rows."""
    out = np.empty((2 * len(rows), rows.shape[1]), np.int32)
    out[: len(rows)] = rows
    return out


@borrowing
def _listed(rings: Rings, v: int, number: Ints, rows: Ints) -> int:
    """Put the quadrilaterals into rows, as far as there are some, and return how many they are."""
    found = _with_the_diagonal_at(rings, v, number, rows)
    return _with_the_diagonal_across(rings, v, number, rows, found)


@borrowing
def _with_the_diagonal_at(rings: Rings, v: int, number: Ints, rows: Ints) -> int:
    """Put the quadrilaterals with the diagonal vs into rows: p, q, s, kind, edges sp and sq."""
    found = 0
    for e in range(rings.first[v], rings.first[v + 1]):
        s = rings.heads[e]
        if s < v:
            continue
        for k in range(rings.start[e], rings.start[e + 1]):
            p = rings.apex[k]
            if p < v:
                continue
            for m in range(k + 1, rings.start[e + 1]):
                q = rings.apex[m]
                if q < v:
                    continue
                kind = 1
                if meets(rings, rings.far[k], q) >= 0 and meets(rings, rings.near[k], q) >= 0:
                    kind = _kind(rings, k, m)
                if found < len(rows):
                    row = rows[found]
                    row[0], row[1], row[2] = number[p], number[q], s
                    row[3], row[4], row[5] = kind, rings.far[k], rings.far[m]
                found += 1
    return found


@borrowing
def _kind(rings: Rings, k: int, m: int) -> int:
    """Return the kind of vpsq, which has both diagonals, by the entries of p and q on vs's ring."""
    q, p = rings.apex[m], rings.apex[k]
    if rings.inner[m] >= 0 and _has(rings, rings.inner[m], p):
        return 4
    if rings.inner[k] >= 0 and _has(rings, rings.inner[k], q):
        return 5
    return BOTH


@borrowing
def _has(rings: Rings, tetrahedron: int, vertex: int) -> bool:
    own = rings.tetrahedra[tetrahedron]
    return bool(vertex == own[0] or vertex == own[1] or vertex == own[2] or vertex == own[3])


@borrowing
def _with_the_diagonal_across(rings: Rings, v: int, number: Ints, rows: Ints, found: int) -> int:
    """Add the quadrilaterals that have only the diagonal pq."""
    for e in range(rings.first[v], rings.first[v + 1]):
        p = rings.heads[e]
        if p < v:
            continue
        for k in range(rings.start[e], rings.start[e + 1]):
            q = rings.apex[k]
            if q < p:
                continue
            for m in range(rings.start[rings.far[k]], rings.start[rings.far[k] + 1]):
                s = rings.apex[m]
                if s <= v or (meets(rings, e, s) >= 0 and meets(rings, rings.near[k], s) >= 0):
                    continue
                if found < len(rows):
                    row = rows[found]
                    row[0], row[1], row[2], row[3] = number[p], number[q], s, 2
                    row[4], row[5] = rings.reverse[rings.near[m]], rings.reverse[rings.far[m]]
                found += 1
    return found


@borrowing
def turned(kind: int) -> int:
    """Return the kind of vqsp, if that of vpsq is given."""
    return 9 - kind if kind > BOTH else kind


@compiled
def _sorted(rows: Ints, found: int, count: int) -> tuple[Ints, Ints, Ints, Ints]:
    """Return the quadrilaterals, each twice, by two passes that keep the order of equal ones.

    These are the runs, begin, q and start, and the columns s, kind, to_p and to_q.
    """
    begin = np.zeros(count + 1, np.int32)
    for i in range(found):
        begin[rows[i, 0] + 1] += 1
        begin[rows[i, 1] + 1] += 1
    for p in range(count):
        begin[p + 1] += begin[p]
    by_q, place = np.empty(2 * found, np.int32), begin.copy()
    for i in range(found):
        for side in range(2):
            q = rows[i, 1 - side]
            by_q[place[q]] = 2 * i + side
            place[q] += 1
    other, columns = np.empty(2 * found, np.int32), np.empty((4, 2 * found), np.int32)
    place[:] = begin
    for own in by_q:
        row, side = rows[own >> 1], int(own & 1)
        to = place[row[side]]
        place[row[side]] += 1
        other[to], columns[0, to] = row[1 - side], row[2]
        columns[1, to] = turned(row[3]) if side else row[3]
        columns[2, to], columns[3, to] = row[4 + side], row[5 - side]
    runs, start = 0, np.empty(2 * found + 1, np.int32)
    for p in range(count):
        low, high = begin[p], begin[p + 1]
        begin[p] = runs
        for k in range(low, high):
            if k == low or other[k] != other[k - 1]:
                start[runs], other[runs] = k, other[k]
                runs += 1
    begin[count], start[runs] = runs, 2 * found
    return begin, other, start, columns


@compiled
def _tips(
    rings: Rings, v: int, begin: Ints, start: Ints, q: Ints, columns: Ints
) -> tuple[Ints, Ints, Ints, Words]:
    """Return the tips of the quadrilaterals, and the two hints of each."""
    total, found = 0, 0
    for k in range(columns.shape[1]):
        total += rings.start[columns[2, k] + 1] - rings.start[columns[2, k]]
    tips, tip = np.zeros(columns.shape[1] + 1, np.int32), np.empty(total, np.int32)
    side, hints = np.empty(total, np.int32), np.zeros((2, columns.shape[1]), np.uint64)
    for p in range(len(begin) - 1):
        for run in range(begin[p], begin[p + 1]):
            ends = rings.heads[rings.first[v] + p], rings.heads[rings.first[v] + q[run]]
            for k in range(start[run], start[run + 1]):
                tips[k] = found
                if p < q[run]:
                    found = _tips_of(rings, v, columns[0, k], ends, columns[2, k], tip, side, found)
                    for i in range(tips[k], found):
                        bit = np.uint64(1) << np.uint64(tip[i] & 63)
                        hints[0, k] |= bit * np.uint64(side[i] & 1)
                        hints[1, k] |= bit * np.uint64(side[i] >> 1)
    tips[columns.shape[1]] = found
    return tips, tip, side, hints


@borrowing
def _tips_of(
    rings: Rings,
    v: int,
    s: int,
    ends: tuple[int, int],
    edge: int,
    tip: Ints,
    side: Ints,
    found: int,
) -> int:
    """Add the tips of one quadrilateral, and return how many there are then."""
    normal, low = product(rings, s, ends[0], ends[1]), -rings.rounding[s]
    for k in range(rings.start[edge], rings.start[edge + 1]):
        t = rings.apex[k]
        if t > v and t != ends[1]:
            value = along(rings, normal, s, t)
            tip[found] = t
            side[found] = (value > low) + 2 * (value < -low)
            found += 1
    return found
