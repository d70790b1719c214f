"""The quadrilaterals at a vertex.

A quadrilateral vpsq is a facet that a hexahedron might have at its vertex v: it has a diagonal, vs
or pq, with both its triangles in the mesh. Of each, only those are listed whose other vertices are
greater than v: it is the least of its hexahedron.
"""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from certify.mesh.census.rings import Ints, Rings, meets
from certify.mesh.compiled import borrowing, compiled

BOTH = 3
"""Kinds of quadrilaterals: 1 has the diagonal vs, 2 has pq, 3 has both; 4 has both and vpsq is a
tetrahedron of the mesh with a positive determinant, 5 likewise with a negative one."""


class Star(NamedTuple):
    """The quadrilaterals at a vertex v, each twice: sorted by p, then by q.

    A neighbour of v is known by its number among all of them, from 0.
    count: how many neighbours; begin: where the runs of each p begin, and the end; q: of each run;
    start: where its quadrilaterals begin, and the end; s, kind: of each quadrilateral, the kind as
    it is seen from p; to_p, to_q: the edges from s.
    Those of p's run of q are in the same order as those of q's run of p.
    """

    count: int
    begin: Ints
    q: Ints
    start: Ints
    s: Ints
    kind: Ints
    to_p: Ints
    to_q: Ints


@compiled
def star(rings: Rings, v: int, number: Ints, rows: Ints) -> tuple[Star, Ints]:
    """Return the quadrilaterals at a vertex, and the scratch array, which may have grown.

    number: for each vertex of the mesh a scratch number; rows: of six.
    """
    begin, end = rings.first[v], rings.first[v + 1]
    for e in range(begin, end):
        number[rings.heads[e]] = e - begin
    found = _listed(rings, v, number, rows)
    while found > len(rows):
        rows = grown(rows)
        found = _listed(rings, v, number, rows)
    return _sorted(rows, found, end - begin), rows


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
    for i in range(4):
        if rings.tetrahedra[tetrahedron, i] == vertex:
            return True
    return False


@borrowing
def _with_the_diagonal_across(
    rings: Rings, v: int, number: Ints, rows: Ints, found: int
) -> int:
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
def _sorted(rows: Ints, found: int, count: int) -> Star:
    """Return the quadrilaterals, each twice, by two passes that keep the order of equal ones."""
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
    columns = np.empty((5, 2 * found), np.int32)
    q, s, kind, to_p, to_q = columns
    place[:] = begin
    for own in by_q:
        row, side = rows[own >> 1], own & 1
        k = place[row[side]]
        place[row[side]] += 1
        q[k], s[k], kind[k] = row[1 - side], row[2], turned(row[3]) if side else row[3]
        to_p[k], to_q[k] = row[4 + side], row[5 - side]
    runs, start = 0, np.empty(2 * found + 1, np.int32)
    for p in range(count):
        low, high = begin[p], begin[p + 1]
        begin[p] = runs
        for k in range(low, high):
            if k == low or q[k] != q[k - 1]:
                start[runs] = k
                runs += 1
    begin[count], start[runs] = runs, 2 * found
    for run in range(runs):
        q[run] = q[start[run]]
    return Star(count, begin, q, start, s, kind, to_p, to_q)
