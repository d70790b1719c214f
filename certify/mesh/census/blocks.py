"""A mesh cut into blocks, each of which can be searched apart from the others.

A block owns a range of the vertices along the curve, and with them the hexahedra whose least vertex
is one of these.

Lemma. The tetrahedra that have only vertices from the beginning of the range on, and that are in
three layers around its vertices, suffice. The first layer are those with a vertex in the range, and
each next one those with a vertex in the one before.
Proof. The hexahedron has only such vertices, and none but the one across from the least is more
than two edges away from it. Every tetrahedron on its vertices, and every one with a triangle on a
facet, has three others of them, thus one that is at most two edges away, in the second layer.
"""

from collections.abc import Iterator
from functools import lru_cache
from pathlib import Path
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from certify.kernel.chirotope import QUADRUPLES
from certify.kernel.hexahedron import CORNERS, SYMMETRIES, image
from certify.mesh.census.prepare import Mesh
from certify.mesh.census.region import table
from certify.mesh.census.rings import Ints, incident, rings
from certify.mesh.census.search import search
from certify.mesh.compiled import compiled
from certify.mesh.instances import QUADRUPLE_INDEX, handedness
from certify.mesh.jacobian import decided
from certify.mesh.signs import Floats

LAYERS = 3

NEIGHBOURS = np.array(
    [
        [w - 1 for w, d in CORNERS.items() if sum(x != y for x, y in zip(c, d, strict=True)) == 1]
        for c in CORNERS.values()
    ]
)
"""The three neighbours of each of the template's vertices, from 0."""


class Block(NamedTuple):
    """A part of a mesh, with vertices numbered along the curve.

    number: from 0; points, tetrahedra: its own; order: the number that each vertex was given with;
    owned: how many of them, the first, it owns; root: where the certificates are.
    """

    number: int
    points: Floats
    tetrahedra: Ints
    order: NDArray[np.int64]
    owned: int
    root: Path


class Hexahedra(NamedTuple):
    """Valid hexahedra of a block, in the order in which they were found.

    number: the block's; vertices: (k, 8), as they were given, in the order of the template;
    instances: (k,), which of the labelled triangulations each is; undecided: (j, 8), those of which
    nobody knows whether the Jacobian is positive.
    """

    number: int
    vertices: NDArray[np.int64]
    instances: NDArray[np.int64]
    undecided: NDArray[np.int64]


def blocks(
    mesh: Mesh, size: int, root: Path, done: frozenset[int] = frozenset()
) -> Iterator[Block]:
    """Yield the blocks that own ``size`` vertices each, along the curve, except those done."""
    count = len(mesh.points)
    begin, around = incident(count, mesh.tetrahedra)
    layer, seen = np.full(count, -1, np.int32), np.full(len(mesh.tetrahedra), -1, np.int32)
    local = np.empty(count, np.int32)
    for number, low in enumerate(range(0, count, size)):
        if number not in done:
            high = min(low + size, count)
            vertices, cells = _around(mesh.tetrahedra, begin, around, low, high, layer, seen)
            local[vertices] = np.arange(len(vertices), dtype=np.int32)
            yield Block(
                number,
                mesh.points[vertices],
                local[mesh.tetrahedra[cells]],
                mesh.order[vertices],
                int(np.searchsorted(vertices, high)),
                root,
            )


def number_of_blocks(mesh: Mesh, size: int) -> int:
    """Return how many blocks there are."""
    return -(-len(mesh.points) // size)


@compiled
def _around(
    tetrahedra: Ints, begin: Ints, around: Ints, low: int, high: int, layer: Ints, seen: Ints
) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
    """Return the vertices and the tetrahedra that a block needs, both increasing.

    layer, seen: scratch numbers for each vertex and tetrahedron; those of other blocks are
    different, as they are taken from ``low``.
    """
    vertices, count = np.empty(4 * (high - low) + 64, np.int64), high - low
    cells, found = np.empty(8 * (high - low) + 64, np.int64), 0
    vertices[:count] = np.arange(low, high)
    layer[low:high] = low
    first = 0
    for _ in range(LAYERS):
        last = count
        for i in range(first, last):
            x = vertices[i]
            for k in range(begin[x], begin[x + 1]):
                t = around[k] >> 2
                if seen[t] == low or tetrahedra[t].min() < low:
                    continue
                seen[t] = low
                if found == len(cells):
                    cells = np.concatenate((cells, np.empty_like(cells)))
                cells[found] = t
                found += 1
                for j in range(4):
                    y = tetrahedra[t, j]
                    if layer[y] != low:
                        layer[y] = low
                        if count == len(vertices):
                            vertices = np.concatenate((vertices, np.empty_like(vertices)))
                        vertices[count] = y
                        count += 1
        first = last
    return np.sort(vertices[:count]), np.sort(cells[:found])


def searched(block: Block) -> Hexahedra:
    """Return the valid hexahedra that a block owns; every Jacobian is decided, or listed."""
    found = search(rings(block.points, block.tetrahedra), table(block.root), 0, block.owned)
    local, own = found[:, :8], found[:, 8].astype(np.int64)
    answers = np.ones(len(own), np.int8)
    for index in np.flatnonzero(own < 0):
        own[index], answers[index] = -1 - own[index], decided(block.points[local[index]])
    good = answers > 0
    vertices, undecided = block.order[local[good]], block.order[local[answers == 0]]
    return Hexahedra(block.number, vertices, own[good], undecided)


def least(found: Hexahedra, root: Path) -> Hexahedra:
    """Return the hexahedra in their least labellings, of the 24 that rotations make one of another.

    The 24 others of the 48 symmetries mirror the hexahedron: with them its Jacobian is negative. So
    no two labellings of valid hexahedra differ by another symmetry than a rotation.
    """
    return Hexahedra(
        found.number, *_canonical(found.vertices, found.instances, root), found.undecided
    )


def _canonical(
    hexahedra: NDArray[np.int64], instances: NDArray[np.int64], root: Path
) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
    """Return labellings, and labelled triangulations, with the least vertex first.

    Second is the least of its neighbours; that settles the rest.

    Args:
        hexahedra: An array (k, 8) of vertices.
        instances: An array (k,), the labelled triangulation that each is.
        root: Where the certificates are.
    """
    rotations, moved = _rotations(root)
    rows = np.arange(len(hexahedra))
    first = hexahedra.argmin(axis=1)
    second = NEIGHBOURS[first, hexahedra[rows[:, None], NEIGHBOURS[first]].argmin(axis=1)]
    own = _place()[first, second]
    return hexahedra[rows[:, None], rotations[own]], moved[own, instances]


@lru_cache(maxsize=1)
def _place() -> NDArray[np.int64]:
    """Return for the first two vertices the place of the rotation among the 24."""
    place = np.full((8, 8), -1)
    for own, rotation in enumerate(_orders()):
        place[rotation[0], rotation[1]] = own
    return place


@lru_cache(maxsize=1)
def _orders() -> NDArray[np.int64]:
    return np.array([own for own in SYMMETRIES if handedness(own) > 0]) - 1


@lru_cache(maxsize=4)
def _rotations(root: Path) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
    """Return the 24 orders of the vertices, and what each makes of every labelled triangulation.

    Vertex order[i] becomes i. So the quadruple Q of the new labelling is that which the order takes
    Q to of the old one.
    """
    keys = table(root).keys
    bits = np.unpackbits(keys.view(np.uint8), axis=1, bitorder="little")
    by_key = np.lexsort((keys[:, 0], keys[:, 1]))
    moved = np.empty((len(_orders()), len(keys)), np.int64)
    for own, order in enumerate(_orders()):
        source = [QUADRUPLE_INDEX[image(tuple(order + 1), q)] for q in QUADRUPLES]
        images = np.zeros_like(bits)
        images[:, : len(source)] = bits[:, source]
        found = np.packbits(images, axis=1, bitorder="little").view(np.uint64)
        moved[own, np.lexsort((found[:, 0], found[:, 1]))] = by_key  # both have the same keys
    return _orders(), moved
