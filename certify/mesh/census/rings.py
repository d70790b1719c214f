"""Who is next to whom in a tetrahedral mesh: neighbours, and around each edge the ring.

The *ring* of a directed edge xp has an entry for every triangle xpz of the mesh: the vertex z, and
the tetrahedron on the positive side of xpz, which is the one whose fourth vertex w makes
det(p-x, z-x, w-x) positive, or -1. All is linear in the number of tetrahedra, whatever the degrees.
"""

from typing import NamedTuple, TypeAlias

import numpy as np
from numpy.typing import NDArray

from certify.mesh.compiled import borrowing, compiled
from certify.mesh.signs import Floats

Ints: TypeAlias = NDArray[np.int32]
Words: TypeAlias = NDArray[np.uint64]


class Rings(NamedTuple):
    """A mesh of tetrahedra with positive determinants, ready to be searched.

    points: (n, 3); rounding: for each vertex a bound of the error of determinants of three edges
    from it; tetrahedra: (m, 4); across: (m, 4), the neighbour opposite to each vertex, or -1.
    Edges: first, where those from each vertex begin, and the end; heads, to where they lead,
    increasing; reverse, the edge back.
    Rings: start, where that of each edge begins, and the end; apex, the vertices z; inner, the
    tetrahedra; near and far, the edges xz and pz; hint, a word for each edge that has the bit of
    every z, see :func:`meets`.
    """

    points: Floats
    rounding: NDArray[np.float64]
    tetrahedra: Ints
    across: Ints
    first: Ints
    heads: Ints
    reverse: Ints
    start: Ints
    apex: Ints
    inner: Ints
    near: Ints
    far: Ints
    hint: Words


def rings(points: Floats, tetrahedra: Ints) -> Rings:
    """Return the rings of a mesh whose tetrahedra have positive determinants and are conforming."""
    across = np.full((len(tetrahedra), 4), -1, np.int32)
    begin, around = incident(len(points), tetrahedra)
    first, heads = _edges(begin, around, tetrahedra)
    start, apex, inner = _entries(begin, around, tetrahedra, first, heads)
    _pair(tetrahedra, first, heads, start, apex, inner, across)
    start, apex, inner = _with_the_hull(tetrahedra, across, first, heads, start, apex, inner)
    reverse, near, far, hint = _links(first, heads, start, apex)
    return Rings(
        points, _rounding(points, first, heads), tetrahedra, across,
        first, heads, reverse, start, apex, inner, near, far, hint,
    )  # fmt: skip


@borrowing
def meets(rings: Rings, edge: int, vertex: int) -> int:
    """Return the entry of a vertex in the ring of an edge, or -1."""
    if rings.hint[edge] >> np.uint64(vertex & 63) & np.uint64(1):
        for k in range(rings.start[edge], rings.start[edge + 1]):
            if rings.apex[k] == vertex:
                return k
    return -1


@borrowing
def product(rings: Rings, x: int, a: int, b: int) -> tuple[float, float, float]:
    """Return the vector product of two edges xa and xb."""
    points = rings.points
    a0, a1, a2 = (
        points[a, 0] - points[x, 0],
        points[a, 1] - points[x, 1],
        points[a, 2] - points[x, 2],
    )
    b0, b1, b2 = (
        points[b, 0] - points[x, 0],
        points[b, 1] - points[x, 1],
        points[b, 2] - points[x, 2],
    )
    return a1 * b2 - a2 * b1, a2 * b0 - a0 * b2, a0 * b1 - a1 * b0


@borrowing
def along(rings: Rings, normal: tuple[float, float, float], x: int, c: int) -> float:
    """Return the scalar product of a vector product and an edge xc, with an error < rounding[x]."""
    points = rings.points
    return float(
        normal[0] * (points[c, 0] - points[x, 0])
        + normal[1] * (points[c, 1] - points[x, 1])
        + normal[2] * (points[c, 2] - points[x, 2])
    )


@borrowing
def bent(rings: Rings, x: int, a: int, b: int, c: int) -> bool:
    """Is det(a-x, b-x, c-x) certainly not positive?"""
    return bool(along(rings, product(rings, x, a, b), x, c) <= -rings.rounding[x])


NEXT = np.array([[1, 2, 3], [0, 3, 2], [3, 0, 1], [2, 1, 0]], np.int64)
"""For each place in a tetrahedron the three others, in the order that keeps the determinant."""


@compiled
def incident(count: int, tetrahedra: Ints) -> tuple[Ints, Ints]:
    """Return the tetrahedra at each vertex: where they begin, and the end; and then all in a row.

    There they are numbers: four times the tetrahedron's, plus the place that the vertex has in it.
    """
    begin = np.zeros(count + 1, np.int32)
    for t in range(len(tetrahedra)):
        for i in range(4):
            begin[tetrahedra[t, i] + 1] += 1
    for x in range(count):
        begin[x + 1] += begin[x]
    filled = begin.copy()
    around = np.empty(4 * len(tetrahedra), np.int32)
    for t in range(len(tetrahedra)):
        for i in range(4):
            x = tetrahedra[t, i]
            around[filled[x]] = 4 * t + i
            filled[x] += 1
    return begin, around


@compiled
def _edges(begin: Ints, around: Ints, tetrahedra: Ints) -> tuple[Ints, Ints]:
    """Return where the edges from each vertex begin, and to where they lead, increasing."""
    count = len(begin) - 1
    first = np.zeros(count + 1, np.int32)
    seen = np.full(count, -1, np.int32)
    heads = np.empty(3 * len(around), np.int32)
    found = 0
    for x in range(count):
        for k in range(begin[x], begin[x + 1]):
            t = around[k] >> 2
            for i in range(4):
                p = tetrahedra[t, i]
                if p != x and seen[p] != x:
                    seen[p] = x
                    heads[found] = p
                    found += 1
        _sort(heads, first[x], found)
        first[x + 1] = found
    return first, heads[:found].copy()


@compiled
def _sort(values: Ints, low: int, high: int) -> None:
    """Sort a part of an array, which is short as a rule."""
    if high - low > 64:
        values[low:high] = np.sort(values[low:high])
        return
    for i in range(low + 1, high):
        value, k = values[i], i
        while k > low and values[k - 1] > value:
            values[k] = values[k - 1]
            k -= 1
        values[k] = value


@compiled
def _entries(
    begin: Ints, around: Ints, tetrahedra: Ints, first: Ints, heads: Ints
) -> tuple[Ints, Ints, Ints]:
    """Return the entries with a tetrahedron: three for each tetrahedron and vertex."""
    count = len(begin) - 1
    start = np.zeros(len(heads) + 1, np.int32)
    apex, inner = np.empty(3 * len(around), np.int32), np.empty(3 * len(around), np.int32)
    edge = np.empty(count, np.int32)
    for x in range(count):
        for e in range(first[x], first[x + 1]):
            edge[heads[e]] = e
        for k in range(begin[x], begin[x + 1]):
            t, i = around[k] >> 2, around[k] & 3
            for j in range(3):
                start[edge[tetrahedra[t, NEXT[i, j]]] + 1] += 1
        for e in range(first[x], first[x + 1]):
            start[e + 1] += start[e]
        for k in range(begin[x], begin[x + 1]):
            t, i = around[k] >> 2, around[k] & 3
            for j in range(3):
                e = edge[tetrahedra[t, NEXT[i, j]]]
                start[e + 1] -= 1
                apex[start[e + 1]] = tetrahedra[t, NEXT[i, (j + 1) % 3]]
                inner[start[e + 1]] = t
        # The ends were moved down to the beginnings: move them up again.
        for e in range(first[x], first[x + 1]):
            start[e] = start[e + 1]
        start[first[x + 1]] = 3 * begin[x + 1]
    return start, apex, inner


@compiled
def _other(tetrahedra: Ints, t: int, a: int, b: int, c: int) -> int:
    """Return the vertex of a tetrahedron that is none of three."""
    for i in range(4):
        x = tetrahedra[t, i]
        if x != a and x != b and x != c:  # noqa: PLR1714 - numba
            return i
    return -1


@compiled
def _pair(
    tetrahedra: Ints, first: Ints, heads: Ints, start: Ints, apex: Ints, inner: Ints, across: Ints
) -> None:
    """Set the neighbours: across xpw from the tetrahedron xpzw is that on xpw's positive side."""
    count = len(first) - 1
    entry = np.empty(count, np.int32)
    seen = np.full(count, -1, np.int32)
    for x in range(count):
        for e in range(first[x], first[x + 1]):
            p = heads[e]
            if p < x:
                continue
            for k in range(start[e], start[e + 1]):
                entry[apex[k]], seen[apex[k]] = k, e
            for k in range(start[e], start[e + 1]):
                t, z = inner[k], apex[k]
                w = tetrahedra[t, _other(tetrahedra, t, x, p, z)]
                if seen[w] == e:
                    s = inner[entry[w]]
                    across[t, _other(tetrahedra, t, x, p, w)] = s
                    across[s, _other(tetrahedra, s, x, p, w)] = t


@compiled
def _with_the_hull(
    tetrahedra: Ints, across: Ints, first: Ints, heads: Ints, start: Ints, apex: Ints, inner: Ints
) -> tuple[Ints, Ints, Ints]:
    """Return the entries with those of triangles that have no tetrahedron on the positive side."""
    hull = 0
    for t in range(len(across)):
        for i in range(4):
            hull += across[t, i] < 0
    starts = np.empty_like(start)
    apices = np.empty(len(apex) + 3 * hull, np.int32)
    inners = np.empty(len(apex) + 3 * hull, np.int32)
    found = 0
    for x in range(len(first) - 1):
        for e in range(first[x], first[x + 1]):
            starts[e] = found
            for k in range(start[e], start[e + 1]):
                apices[found], inners[found] = apex[k], inner[k]
                found += 1
            for k in range(start[e], start[e + 1]):
                t, z = inner[k], apex[k]
                i = _other(tetrahedra, t, x, heads[e], z)
                w = tetrahedra[t, i]
                if across[t, _other(tetrahedra, t, x, heads[e], w)] < 0:
                    apices[found], inners[found] = w, -1
                    found += 1
    starts[-1] = found
    return starts, apices, inners


@compiled
def _links(first: Ints, heads: Ints, start: Ints, apex: Ints) -> tuple[Ints, Ints, Ints, Words]:
    """Return the reverse edges, those from both ends to the vertices on rings, and the hints."""
    count = len(first) - 1
    reverse, near, far = np.empty_like(heads), np.empty_like(apex), np.empty_like(apex)
    hint = np.zeros(len(heads), np.uint64)
    place, entry = first.copy(), np.empty(count, np.int32)
    for x in range(count):  # the heads of edges increase: so the edges back are met in order
        for e in range(first[x], first[x + 1]):
            reverse[e] = place[heads[e]]
            place[heads[e]] += 1
            entry[heads[e]] = e
        for k in range(start[first[x]], start[first[x + 1]]):
            near[k] = entry[apex[k]]
    for e in range(len(heads)):
        for k in range(start[e], start[e + 1]):
            entry[apex[k]] = near[k]
            hint[e] |= np.uint64(1) << np.uint64(apex[k] & 63)
        back = reverse[e]
        for k in range(start[back], start[back + 1]):
            far[k] = entry[apex[k]]
    return reverse, near, far, hint


@compiled
def _rounding(points: Floats, first: Ints, heads: Ints) -> NDArray[np.float64]:
    """Return for each vertex x a bound of the error of det(b-x, c-x, d-x) for edges xb, xc, xd.

    Let R be the largest coordinate of an edge, as computed. As in signs.py, the error is at most
    ((1 + u)^8 - 1) 6R'^3, u = 2^-53, for the exact R'; that is less than 2^-47 R^3, as computed.
    """
    out = np.full(len(first) - 1, np.inf)
    for x in range(len(first) - 1):
        most, least = 0.0, 1.0
        reach = 0.0
        for axis in range(3):
            size = abs(points[x, axis])
            most = max(most, size)
            least = min(least, size) if size > 0.0 else least
            for e in range(first[x], first[x + 1]):
                other = points[heads[e], axis]
                size = abs(other)
                most = max(most, size)
                least = min(least, size) if size > 0.0 else least
                reach = max(reach, abs(other - points[x, axis]))
        if most <= 2.0**300 and least >= 2.0**-240:
            out[x] = 2.0**-47 * reach * reach * reach
    return out
