"""The search for all valid hexahedra of a mesh, each from its least vertex.

The hexahedron has the vertices

    v p s1 q r s3 t s2

in the order of the template: v is the least, its neighbours are p, q and r, and opposite to v on
the facets that they span are s1 (p and q), s2 (q and r) and s3 (r and p). The quadrilaterals
at v are joined, three around v, and then the far corner t is sought on the other three facets. At
every corner the three edges have a positive determinant, which is the Jacobian there; whatever
certainly has not is left as soon as its vertices are known.
"""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from certify.mesh.census.region import Table, Walk, region, walk
from certify.mesh.census.rings import Ints, Rings, along, bent, meets, product
from certify.mesh.census.star import BOTH, Star, grown, star, turned
from certify.mesh.compiled import borrowing, compiled
from certify.mesh.jacobian import Workspace, filtered_safe, workspace
from certify.mesh.signs import UNKNOWN

V, P, S1, Q, R, S3, T, S2 = range(8)


class Memory(NamedTuple):
    """What the search writes on.

    eight: the hexahedron; kinds: of its facets; runs: of quadrilaterals, those of p and q as seen
    from q, of q and r as seen from q, and of r and p as seen from p; ends: the candidates for t,
    each with the kind of the facet at q; walk, jacobian, points: for what is called.
    """

    eight: Ints
    kinds: Ints
    runs: Ints
    ends: Ints
    walk: Walk
    jacobian: Workspace
    points: NDArray[np.float64]


@compiled
def _memory(rings: Rings) -> Memory:
    longest = 0
    for e in range(len(rings.heads)):
        longest = max(longest, rings.start[e + 1] - rings.start[e])
    return Memory(
        np.empty(8, np.int32),
        np.empty(6, np.int32),
        np.empty(3, np.int32),
        np.empty((2 * longest + 1, 2), np.int32),
        walk(len(rings.points)),
        workspace(),
        np.empty((8, 3)),
    )


@compiled
def search(rings: Rings, table: Table, begin: int, end: int) -> Ints:
    """Return the hexahedra whose least vertex is in a range: eight vertices, and what it is.

    That is the number of the labelled triangulation, i, if the filter knows that the Jacobian is
    positive; if it does not know it is -1 - i.
    """
    memory = _memory(rings)
    number, mark = np.full(len(rings.points), -1, np.int32), np.full(16, -1, np.int32)
    rows, out, found = np.empty((256, 6), np.int32), np.empty((1024, 9), np.int32), 0
    for v in range(begin, end):
        quadrilaterals, rows = star(rings, v, number, rows)
        if quadrilaterals.neighbours > len(mark):
            mark = np.full(2 * quadrilaterals.neighbours, -1, np.int32)
        memory.eight[V] = v
        after = _joined(rings, table, memory, quadrilaterals, mark, found, out)
        while after > len(out):
            out = grown(out)
            after = _joined(rings, table, memory, quadrilaterals, mark, found, out)
        found = after
    return out[:found]


@borrowing
def _joined(
    rings: Rings, table: Table, memory: Memory, at: Star, mark: Ints, found: int, out: Ints
) -> int:
    """Add the hexahedra from v. Of the three neighbours, q has the least number.

    mark: a scratch number for each neighbour; it is -1 except as said here.
    """
    eight, runs = memory.eight, memory.runs
    v, first = eight[V], rings.first[eight[V]]
    for q in range(at.neighbours):
        eight[Q] = rings.heads[first + q]
        for a in range(at.begin[q], at.begin[q + 1]):
            p = at.q[a]
            if p < q:
                continue
            eight[P] = rings.heads[first + p]
            for c in range(at.begin[p], at.begin[p + 1]):
                mark[at.q[c]] = c
            for b in range(at.begin[q], at.begin[q + 1]):
                r = at.q[b]
                if r > q and mark[r] >= 0:
                    eight[R] = rings.heads[first + r]
                    if not bent(rings, v, eight[P], eight[Q], eight[R]):
                        runs[0], runs[1], runs[2] = a, b, mark[r]
                        found = _around(rings, table, memory, at, found, out)
            for c in range(at.begin[p], at.begin[p + 1]):
                mark[at.q[c]] = -1
    return found


@borrowing
def _around(rings: Rings, table: Table, memory: Memory, at: Star, found: int, out: Ints) -> int:
    """Add the hexahedra with known v, p, q, r: choose s1 and s2, then s3, then t."""
    eight, (run_a, run_b, run_c) = memory.eight, memory.runs
    v, p, q, r = eight[V], eight[P], eight[Q], eight[R]
    for a in range(at.start[run_a], at.start[run_a + 1]):
        s1 = at.s[a]
        if s1 == r:
            continue
        eight[S1], normal = s1, product(rings, q, v, s1)
        for b in range(at.start[run_b], at.start[run_b + 1]):
            s2 = at.s[b]
            if s2 in (p, s1) or along(rings, normal, q, s2) <= -rings.rounding[q]:
                continue
            eight[S2] = s2
            ends = _ends(rings, memory, at, a, b)
            if not ends:
                continue
            for c in range(at.start[run_c], at.start[run_c + 1]):
                s3 = at.s[c]
                if s3 in (q, s1, s2) or bent(rings, p, v, s3, s1) or bent(rings, r, v, s2, s3):
                    continue
                eight[S3] = s3
                for i in range(ends):
                    if _closed(rings, memory, i, at.to_q[a], at.to_q[b], at.to_p[c], at.to_q[c]):
                        own = _decided(
                            rings, table, memory, at.to_p[a], at.kind[a], at.kind[b], at.kind[c]
                        )
                        if own:
                            if found < len(out):
                                for k in range(8):
                                    out[found, k] = eight[k]
                                out[found, 8] = own - 1 if own > 0 else own
                            found += 1
    return found


@borrowing
def _ends(rings: Rings, memory: Memory, at: Star, a: int, b: int) -> int:
    """Find the vertices t such that s1 t s2 q is a quadrilateral; return how many.

    Those at which the corner s1 or s2 is bent are left out. a, b: the quadrilaterals with q, p and
    with q, r.
    """
    ends, found = memory.ends, 0
    if at.ahead[a] & at.aback[b]:
        for i in range(at.tips[a], at.tips[a + 1]):
            if at.side[i] & 1:
                for k in range(at.tips[b], at.tips[b + 1]):
                    if at.tip[k] == at.tip[i] and at.side[k] & 2:
                        ends[found, 0], ends[found, 1] = at.tip[i], 2
                        found += 1
    across = meets(rings, at.to_p[a], at.s[b])
    return found if across < 0 else _ends_across(rings, memory, rings.near[across], found)


@borrowing
def _ends_across(rings: Rings, memory: Memory, edge: int, before: int) -> int:
    """Add those of which s1 s2 has the triangles, and return how many there are then."""
    eight, ends, found = memory.eight, memory.ends, before
    v, p, q, r, s1, s2 = eight[V], eight[P], eight[Q], eight[R], eight[S1], eight[S2]
    for k in range(rings.start[edge], rings.start[edge + 1]):
        t = rings.apex[k]
        if t > v and not _same(t, p, q, r):
            known = 0
            while known < before and ends[known, 0] != t:
                known += 1
            if known < before:
                ends[known, 1] = BOTH
            elif not bent(rings, s1, q, p, t) and not bent(rings, s2, r, q, t):
                ends[found, 0], ends[found, 1] = t, 1
                found += 1
    return found


@borrowing
def _same(t: int, a: int, b: int, c: int) -> bool:
    return t == a or t == b or t == c  # noqa: PLR1714 - compiled, and the types differ


@borrowing
def _closed(
    rings: Rings, memory: Memory, end: int, s1_p: int, s2_r: int, s3_p: int, s3_r: int
) -> bool:
    """Are the last two facets quadrilaterals, and the last two corners not bent?"""
    eight, kinds = memory.eight, memory.kinds
    t, s3 = memory.ends[end, 0], eight[S3]
    if t == s3:
        return False
    kinds[3] = _facet(rings, s1_p, s3_p, s3, t)
    if not kinds[3]:
        return False
    kinds[5] = _facet(rings, s2_r, s3_r, s3, t)
    if not kinds[5]:
        return False
    kinds[4], eight[T] = memory.ends[end, 1], t
    return not (bent(rings, s3, eight[P], eight[R], t) or bent(rings, t, eight[S1], s3, eight[S2]))


@borrowing
def _facet(rings: Rings, a: int, b: int, s: int, t: int) -> int:
    """Return the kind of the facet p, s, t, s' for the edges a = s'p and b = sp; 0 if it is none.

    The kind is 1 if pt has its triangles, plus 2 if ss' has.
    """
    kind = 1 if meets(rings, a, t) >= 0 and meets(rings, b, t) >= 0 else 0
    k = meets(rings, a, s)
    if k >= 0 and meets(rings, rings.near[k], t) >= 0:
        kind += 2
    return kind


@borrowing
def _decided(rings: Rings, table: Table, memory: Memory, s1_q: int, a: int, b: int, c: int) -> int:
    """Return what the hexahedron is: i + 1 or -1 - i as in :func:`search`, or 0 if it is not valid.

    s1_q: the edge; a, b, c: the kinds of the facets at v, seen from q, from q and from p.
    """
    eight, kinds = memory.eight, memory.kinds
    known = True
    for i in range(8):
        known &= rings.rounding[eight[i]] < np.inf
        for axis in range(3):
            memory.points[i, axis] = rings.points[eight[i], axis]
    sign = filtered_safe(memory.points, memory.jacobian) if known else UNKNOWN
    if sign < 0:
        return 0
    kinds[0], kinds[1], kinds[2] = min(a, BOTH), min(c, BOTH), min(b, BOTH)
    kind, own = turned(a), -1
    if kind not in (2, 4):  # the region may have the diagonal v s1, hence v s1 q
        begin = rings.inner[meets(rings, s1_q, eight[V])]
        own = region(rings, table, memory.walk, eight, kinds, begin)
    if own < 0 and kind not in (1, 5):  # it may have p q, hence p s1 q
        begin = rings.inner[meets(rings, s1_q, eight[P])]
        own = region(rings, table, memory.walk, eight, kinds, begin)
    if own < 0:
        return 0
    return -1 - own if sign == UNKNOWN else own + 1
