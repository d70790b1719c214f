"""The region that a hexahedron encloses in a mesh, and which labelled triangulation it is.

The region is what a walk through the tetrahedra reaches from inside a triangle of the boundary, if
it crosses no triangle that lies on a facet with another one along a diagonal. Its tetrahedra, as
bits of two words, are looked up among the 6,966 labelled triangulations: whatever the walk went
through, only what is equal to one of these is a hexahedron.

Lemma. In a mesh the eight points have at most one region that is such a triangulation, and the walk
finds it.
Proof. Let R be one. Its twelve boundary triangles are barriers, so from inside one of them the walk
does not leave R. A barrier inside R would be a triangle on a facet abcd with both its diagonals,
abc and acd in the boundary of R, say, and abd and bcd inside R. These four triangles bound the
tetrahedron abcd, which then is a part of R; it has no vertices inside, as R has none there; so abcd
itself is a tetrahedron of R, which has no boundary tetrahedra. Hence the walk reaches all that is
connected to its beginning in R without crossing a triangle of the boundary, all of R. So any two
such regions that are on the same side of the same triangle are equal. Let both diagonals of a facet
have their triangles. Of the two pairs, R must have the one that leaves abcd outside, by the same
argument; so the triangles from which the walk begins are the same for all R.
"""

from functools import lru_cache
from pathlib import Path
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from certify.kernel.hexahedron import FACETS, Simplex, simplex
from certify.mesh.census.rings import Ints, Rings
from certify.mesh.compiled import borrowing, compiled
from certify.mesh.instances import QUADRUPLE_INDEX, instances

SLOTS = 1 << 15
"""Places in the table of the labelled triangulations, a few for each."""

WORD = 64


class Table(NamedTuple):
    """The labelled triangulations, ready to be looked up.

    bit: for a set of vertices, as bits, the place of the quadruple among the 70, or -1 if it is
    none or a facet; barriers: for each facet and diagonal the two triangles, as sets of vertices;
    keys: the tetrahedra of each triangulation, as bits; slots: an open hash table of the keys.
    """

    bit: NDArray[np.int64]
    barriers: NDArray[np.int64]
    keys: NDArray[np.uint64]
    slots: Ints


@lru_cache(maxsize=4)
def table(root: Path) -> Table:
    """Return the table of the labelled triangulations that a root has certificates for."""
    facets = {simplex(facet) for facet in FACETS}
    bit = np.full(256, -1, np.int64)
    for quadruple, place in QUADRUPLE_INDEX.items():
        if quadruple not in facets:
            bit[_set(quadruple)] = place
    barriers = [
        [[_set((a, b, c)), _set((a, c, d))], [_set((a, b, d)), _set((b, c, d))]]
        for a, b, c, d in FACETS
    ]
    keys = np.array([_key(own.tetrahedra) for own in instances(root)], np.uint64)
    slots = np.full(SLOTS, -1, np.int32)
    _fill(keys, slots)
    return Table(bit, np.array(barriers, np.int64), keys, slots)


def _set(vertices: Simplex) -> int:
    return sum(1 << (vertex - 1) for vertex in vertices)


def _key(tetrahedra: tuple[Simplex, ...]) -> list[int]:
    words = [0, 0]
    for tetrahedron in tetrahedra:
        word, place = divmod(QUADRUPLE_INDEX[tetrahedron], WORD)
        words[word] |= 1 << place
    return words


@compiled
def _fill(keys: NDArray[np.uint64], slots: Ints) -> None:
    for own in range(len(keys)):
        slot = _slot(keys[own, 0], keys[own, 1])
        while slots[slot] >= 0:
            slot = (slot + 1) % SLOTS
        slots[slot] = own


@borrowing
def _slot(low: np.uint64, high: np.uint64) -> np.int64:
    mixed = low * np.uint64(0x9E3779B97F4A7C15) + high * np.uint64(0xC2B2AE3D27D4EB4F)
    mixed ^= mixed >> np.uint64(32)
    mixed *= np.uint64(0xD6E8FEB86659FD93)
    return np.int64(mixed >> np.uint64(49))


@borrowing
def looked_up(table: Table, low: np.uint64, high: np.uint64) -> int:
    """Return the labelled triangulation with exactly these tetrahedra, or -1."""
    slot = _slot(low, high)
    while table.slots[slot] >= 0:
        own = table.slots[slot]
        if table.keys[own, 0] == low and table.keys[own, 1] == high:
            return own  # type: ignore[no-any-return]
        slot = (slot + 1) % SLOTS
    return -1


class Walk(NamedTuple):
    """What a walk remembers, next to its number, which tells it from those before.

    place: for each vertex of the mesh its place among the eight, plus eight times the number of the
    walk that it was in; closed: for each set of vertices whether it is a barrier; seen: the number
    of the walk that visited it; stack: tetrahedra to visit.
    """

    number: NDArray[np.int64]
    place: NDArray[np.int64]
    closed: NDArray[np.bool_]
    seen: NDArray[np.int64]
    stack: NDArray[np.int64]


@compiled
def walk(count: int) -> Walk:
    """Return the memory for walks through a mesh with so many vertices."""
    return Walk(
        np.zeros(1, np.int64),
        np.zeros(count, np.int64),
        np.zeros(256, np.bool_),
        np.zeros(256, np.int64),
        np.empty(512, np.int64),
    )


@borrowing
def region(rings: Rings, table: Table, memory: Walk, eight: Ints, kinds: Ints, begin: int) -> int:
    """Return the labelled triangulation that the region is, or -1.

    eight: the vertices in the order of the template; kinds: for each facet abcd, 1 if ac has its
    triangles, plus 2 if bd has; begin: the tetrahedron to begin with, or -1.
    """
    memory.number[0] += 1
    for i in range(8):
        memory.place[eight[i]] = 8 * memory.number[0] + i
    for f in range(6):
        for d in range(2):
            memory.closed[table.barriers[f, d, 0]] = kinds[f] >> d & 1
            memory.closed[table.barriers[f, d, 1]] = kinds[f] >> d & 1
    low, high = _walked(rings, table, memory, begin)
    return looked_up(table, low, high)


@borrowing
def _walked(rings: Rings, table: Table, memory: Walk, begin: int) -> tuple[np.uint64, np.uint64]:
    """Return the tetrahedra of the region as bits, or zeros if it leaves the eight vertices.

    There are at most 64 sets of four vertices to be visited: the stack is long enough.
    """
    number, words, top = memory.number[0], (np.uint64(0), np.uint64(0)), 1
    low, high = words
    memory.stack[0] = begin
    while top:
        top -= 1
        t = memory.stack[top]
        if t < 0:
            return words
        a, b = memory.place[rings.tetrahedra[t, 0]], memory.place[rings.tetrahedra[t, 1]]
        c, d = memory.place[rings.tetrahedra[t, 2]], memory.place[rings.tetrahedra[t, 3]]
        if min(a, b, c, d) < 8 * number:
            return words
        bits = (1 << (a & 7), 1 << (b & 7), 1 << (c & 7), 1 << (d & 7))
        own = bits[0] | bits[1] | bits[2] | bits[3]
        if memory.seen[own] == number:
            continue
        memory.seen[own] = number
        place = table.bit[own]
        if place < 0:
            return words
        if place < WORD:
            low |= np.uint64(1) << np.uint64(place)
        else:
            high |= np.uint64(1) << np.uint64(place - WORD)
        for i in range(4):
            memory.stack[top] = rings.across[t, i]
            top += not memory.closed[own ^ bits[i]]
    return low, high
