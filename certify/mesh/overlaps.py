"""Do tetrahedra of a mesh overlap? Decided exactly, for meshes of millions.

Two tetrahedra overlap if their interiors have a common point; touching is not overlapping.

Lemma 1. Let no tetrahedron be flat, and let each triangle have at most one tetrahedron on each
side. If two tetrahedra overlap, so do two of which one is outside: it has a triangle that is in no
other.
Proof. Let a point go from where two overlap along a line that meets no edge, to infinity. Where it
leaves a tetrahedron through a triangle with another one behind, it enters that. So the number of
tetrahedra around it falls from above 1 only where it leaves one that is outside; just before, it is
in that and in another.

Lemma 2. Two tetrahedra that do not overlap are separated by a plane through three of their
vertices.
Proof. The planes n.x = d with n.a <= d <= n.b for all vertices a of one and b of the other make a
cone in four dimensions, with others than 0, as convex bodies without a common inner point are
separated. It contains no line, as the vertices lie in no plane. So it has an extreme ray, on which
three independent ones of the inequalities are equations.
"""

from collections.abc import Iterable, Iterator
from itertools import combinations
from sys import float_info
from typing import Any

import numpy as np
from numpy.typing import NDArray

from certify.kernel.chirotope import QUADRUPLES
from certify.mesh.compiled import borrowing, compiled
from certify.mesh.signs import UNKNOWN, Floats, Signs, filtered, safe, signs

Cells = NDArray[Any]
"""An array (m, 4) of vertices, int32 or int64."""

CHUNK = 1 << 20
"""The triangles of so many vertices are looked at together."""

LEAF = 8
"""So many tetrahedra have a box together, the smallest there is."""

BATCH = 1024
"""When so many pairs wait for exact arithmetic, it is their turn."""

OPPOSITE = np.array([[1, 3, 2], [0, 2, 3], [0, 3, 1], [0, 1, 2]])
"""The triangle opposite to each vertex of a positive tetrahedron, seen from inside."""


def coincident(points: NDArray[Any], cells: Iterable[Cells]) -> tuple[int, int] | None:
    """Return two vertices of cells that are the same point, None if there are none."""
    used = np.zeros(len(points), np.bool_)
    for rows in cells:
        used[rows] = True
    vertices = np.flatnonzero(used)
    own = points[vertices]
    if own.dtype == object:
        places: dict[tuple[Any, ...], int] = {}
        for vertex, point in zip(vertices.tolist(), map(tuple, own), strict=True):
            if places.setdefault(point, vertex) != vertex:
                return places[point], vertex
        return None
    order = np.lexsort(own.T)
    same = np.flatnonzero((own[order[1:]] == own[order[:-1]]).all(axis=1))
    if not len(same):
        return None
    one, other = vertices[order[same[0] : same[0] + 2]].tolist()
    return one, other


def sides(vertices: int, tetrahedra: Cells, chunk: int = CHUNK) -> tuple[int, int, Any]:
    """Return two tetrahedra on the same side of a triangle, or -1 twice; and which are outside.

    Args:
        vertices: How many there are.
        tetrahedra: They have positive determinants.
        chunk: The triangles of so many vertices are looked at together.
    """
    outside = np.zeros(len(tetrahedra), np.bool_)
    for low in range(0, vertices, chunk):
        one, other = _sides(tetrahedra, low, min(low + chunk, vertices), outside)
        if one >= 0:
            return int(one), int(other), outside
    return -1, -1, outside


@compiled
def _sides(tetrahedra: Cells, low: int, high: int, outside: NDArray[np.bool_]) -> tuple[int, int]:
    """Look only at triangles whose least vertex is in a range."""
    end = np.zeros(high - low + 1, np.int64)
    for t in range(len(tetrahedra)):
        for i in range(4):
            x = _triangle(tetrahedra[t], i)[0]
            if low <= x < high:
                end[x - low + 1] += 1
    end = np.cumsum(end)
    place, keys, owners = end.copy(), np.empty(end[-1], np.int64), np.empty(end[-1], np.int64)
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
        ordered = own[order]
        for k in range(len(ordered)):
            owner = owners[end[x] + order[k]]
            if k and ordered[k] == ordered[k - 1]:
                before = owners[end[x] + order[k - 1]]
                return min(owner, before), max(owner, before)
            behind = (ordered[k] & 0xFFFFFFFF) << 32 | ordered[k] >> 32
            at = np.searchsorted(ordered, behind)
            if at == len(ordered) or ordered[at] != behind:
                outside[owner] = True
    return -1, -1


@borrowing
def _triangle(tetrahedron: Cells, i: int) -> tuple[int, int, int]:
    """Return the triangle opposite to a vertex, seen from inside, beginning with the least."""
    a = tetrahedron[OPPOSITE[i, 0]]
    b = tetrahedron[OPPOSITE[i, 1]]
    c = tetrahedron[OPPOSITE[i, 2]]
    if b < a and b < c:
        return b, c, a
    if c < a and c < b:
        return c, a, b
    return a, b, c


def overlap(
    points: NDArray[Any], tetrahedra: Cells, outside: NDArray[np.bool_]
) -> tuple[int, int] | None:
    """Return two tetrahedra that overlap, the first of them outside; None if there are none.

    It is the faster, the nearer to one another in space those are that follow one another.

    Args:
        points: An array (n, 3) of float64 or of Fractions.
        tetrahedra: As Lemma 1 wants them.
        outside: Which are.
    """
    for pairs in _doubtful(points, tetrahedra, np.flatnonzero(outside)):
        eight = np.concatenate([tetrahedra[pairs[:, 0]], tetrahedra[pairs[:, 1]]], axis=1)
        together = np.flatnonzero(~separated(signs(points[eight])))
        if len(together):
            one, other = pairs[together[0]].tolist()
            return one, other
    return None


def separated(found: Signs) -> NDArray[np.bool_]:
    """Return whether pairs of tetrahedra are separated by a plane through three vertices.

    Args:
        found: The signs of the eight vertices, an array (k, 70); those of one tetrahedron first.
    """
    out = np.zeros(len(found), np.bool_)
    for columns, factors in _PLANES:
        above = found[:, columns] * factors
        one_way = (above >= 0).all(axis=1) | (above <= 0).all(axis=1)
        out |= one_way & (above != 0).any(axis=1)
    return out


def _plane(three: tuple[int, ...]) -> tuple[list[int], list[int]]:
    """Return of the other five vertices where the sign is, and a factor.

    The sign times the factor tells the side of the plane for vertices of the first tetrahedron, and
    the other side for those of the second.
    """
    columns, factors = [], []
    for other in set(range(8)).difference(three):
        columns.append(QUADRUPLES.index(tuple(v + 1 for v in sorted((*three, other)))))
        parity = (-1) ** sum(v > other for v in three)
        factors.append(parity if other < 4 else -parity)
    return columns, factors


_THREES = sorted(combinations(range(8), 3), key=lambda own: sum(v < 4 for v in own) in (1, 2))
"""Three of eight vertices; those of one tetrahedron, which often are enough, come first."""

_PLANES = [_plane(three) for three in _THREES]

_TRIPLES = np.array(_THREES)


def _doubtful(
    points: NDArray[Any], tetrahedra: Cells, outside: NDArray[np.int64]
) -> Iterator[NDArray[np.int64]]:
    """Yield pairs, the first of each outside, whose boxes overlap and that may overlap themselves.

    That is, no plane is known for certain to separate them.
    """
    below, above = _bounds(points)
    certain = points.dtype != object and bool(safe(below))
    low, high = _boxes(below, above, tetrahedra)
    done = 0
    while done < len(outside):
        pairs, done = _near(below, above, certain, tetrahedra, outside, done, low, high)
        if len(pairs):
            yield pairs


def _bounds(points: NDArray[Any]) -> tuple[Floats, Floats]:
    """Return floating-point numbers not above and not below the coordinates."""
    if points.dtype != object:
        return points, points
    near = nearest(points)
    return np.nextafter(near, -np.inf), np.nextafter(near, np.inf)


def nearest(points: NDArray[Any]) -> Floats:
    """Return the finite floating-point numbers that are nearest to the coordinates."""
    if points.dtype != object:
        return points
    return np.array([_nearest(x) for x in points.ravel().tolist()]).reshape(points.shape)


def _nearest(number: Any) -> float:
    try:
        return float(number)
    except OverflowError:
        return float_info.max if number > 0 else -float_info.max


@compiled
def _boxes(below: Floats, above: Floats, tetrahedra: Cells) -> tuple[Floats, Floats]:
    """Return the boxes of a binary tree: those of node k are 2k and 2k + 1, and 1 is the root."""
    size = 1
    while size * LEAF < len(tetrahedra):
        size *= 2
    low, high = np.full((2 * size, 3), np.inf), np.full((2 * size, 3), -np.inf)
    for t in range(len(tetrahedra)):
        k = size + t // LEAF
        for i in range(4):
            for axis in range(3):
                low[k, axis] = min(low[k, axis], below[tetrahedra[t, i], axis])
                high[k, axis] = max(high[k, axis], above[tetrahedra[t, i], axis])
    for k in range(size - 1, 0, -1):
        for axis in range(3):
            low[k, axis] = min(low[2 * k, axis], low[2 * k + 1, axis])
            high[k, axis] = max(high[2 * k, axis], high[2 * k + 1, axis])
    return low, high


@compiled
def _near(
    below: Floats,
    above: Floats,
    certain: bool,
    tetrahedra: Cells,
    outside: NDArray[np.int64],
    start: int,
    low: Floats,
    high: Floats,
) -> tuple[NDArray[np.int64], int]:
    """Return doubtful pairs of the tetrahedra outside from ``start`` on, and how far that goes."""
    pairs, found = np.empty((BATCH, 2), np.int64), 0
    stack = np.empty(128, np.int64)
    size = len(low) // 2
    least, most = np.empty(3), np.empty(3)
    done = start
    while done < len(outside) and found < BATCH:
        t = outside[done]
        done += 1
        for axis in range(3):
            least[axis], most[axis] = np.inf, -np.inf
            for i in range(4):
                least[axis] = min(least[axis], below[tetrahedra[t, i], axis])
                most[axis] = max(most[axis], above[tetrahedra[t, i], axis])
        stack[0], height = 1, 1
        while height:
            height -= 1
            k = stack[height]
            if not _meet(low[k], high[k], least, most):
                continue
            if k < size:
                stack[height], stack[height + 1] = 2 * k + 1, 2 * k
                height += 2
                continue
            for s in range((k - size) * LEAF, min((k - size + 1) * LEAF, len(tetrahedra))):
                if s == t or (certain and _apart(below, tetrahedra[t], tetrahedra[s])):
                    continue
                if found == len(pairs):
                    pairs = np.concatenate((pairs, np.empty_like(pairs)))
                pairs[found, 0], pairs[found, 1] = t, s
                found += 1
    return pairs[:found], done


@borrowing
def _meet(low: Floats, high: Floats, least: Floats, most: Floats) -> bool:
    """Do the interiors of two boxes meet? Those of flat boxes never do."""
    meet = True
    for axis in range(3):
        meet &= least[axis] < high[axis] and low[axis] < most[axis]
    return meet


@compiled
def _apart(points: Floats, one: Cells, other: Cells) -> bool:
    """Is a plane known to separate two tetrahedra, with safe points?"""
    eight = np.empty(8, np.int64)
    for i in range(4):
        eight[i], eight[4 + i] = one[i], other[i]
    for three in _TRIPLES:
        a, b, c = eight[three[0]], eight[three[1]], eight[three[2]]
        side, good = 0, True
        for i in range(8):
            x = eight[i]
            if x in (a, b, c):
                continue  # in the plane
            sign = filtered(points[a], points[b], points[c], points[x])
            if sign == UNKNOWN:
                good = False
                break
            if i >= 4:
                sign = -sign
            if side == 0:
                side = sign
            elif sign == -side:
                good = False
                break
        if good and side != 0:
            return True
    return False
