"""All hexahedra of a tetrahedral mesh by trying everything: from the definition, in plain Python.

Nothing of certify/mesh/census is used here.
"""

from collections.abc import Iterator, Sequence
from fractions import Fraction
from functools import cache
from itertools import combinations, product

from certify.kernel.hexahedron import FACETS
from certify.kernel.jacobian import bernstein_coefficients, halves
from certify.mesh.realized import labelled
from tests.geometry import Vector, minus, sign, volume

Hexahedron = tuple[int, ...]
"""Eight vertices of a mesh, from 0, in the order of the template; see :func:`rotated`."""

DEPTH = 20
"""How often a box is halved in each direction until nobody knows."""

AT = ((0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1))


@cache
def rotations() -> tuple[tuple[int, ...], ...]:
    """Return the 24 orders of the template's vertices that rotations of the cube make, from 0."""
    found = []
    for a, b, c, d in (
        (a, b, c, d)
        for a in range(8)
        for b in range(8)
        for c in range(8)
        for d in range(8)
        if all(sum(map(abs, minus(AT[a], AT[x]))) == 1 for x in (b, c, d))
    ):
        u, v, w = (minus(AT[x], AT[a]) for x in (b, c, d))
        if volume(AT[a], AT[b], AT[c], AT[d]) == 1:
            found.append(
                tuple(
                    AT.index(
                        tuple(
                            p + i * x + j * y + k * z
                            for p, x, y, z in zip(AT[a], u, v, w, strict=True)
                        )
                    )
                    for i, j, k in AT
                )
            )
    return tuple(found)


def rotated(hexahedron: Sequence[int]) -> Hexahedron:
    """Return the least of the 24 labellings of a hexahedron that rotations make one of another.

    The 24 others of the 48 mirror it: their Jacobian is negative where its own is positive.
    """
    return min(tuple(int(hexahedron[v]) for v in order) for order in rotations())


def hexahedra(
    points: Sequence[Sequence[float]], tetrahedra: Sequence[Sequence[int]]
) -> dict[Hexahedron, set[frozenset[frozenset[int]]]]:
    """Return the valid hexahedra of a mesh, each with the sets of tetrahedra that it consists of.

    A mesh should allow only one such set for a hexahedron; that is for the tests to say.
    """
    whole = _integers(points)
    solid = {frozenset(map(int, t)) for t in tetrahedra}
    faces = {frozenset(face) for t in solid for size in (2, 3) for face in combinations(t, size)}
    found = {}
    for eight in _candidates(len(whole), faces):
        own = [whole[v] for v in eight]
        if _valid(own):
            regions = set(_regions(own, eight, solid))
            if regions:
                found[rotated(eight)] = regions
    return found


def patterns(
    found: dict[Hexahedron, set[frozenset[frozenset[int]]]],
) -> dict[Hexahedron, set[str]]:
    """Return the names of the patterns of the hexahedra that :func:`hexahedra` found."""
    return {
        eight: {
            _names()[frozenset(frozenset(eight.index(v) + 1 for v in t) for t in region)]
            for region in regions
        }
        for eight, regions in found.items()
    }


@cache
def _names() -> dict[frozenset[frozenset[int]], str]:
    return {frozenset(map(frozenset, own.tetrahedra)): own.pattern for own in labelled()}


def _integers(points: Sequence[Sequence[float]]) -> list[Vector]:
    exact = [tuple(Fraction(float(x)) for x in point) for point in points]
    unit = max(x.denominator for point in exact for x in point)  # they are powers of two
    return [tuple(int(x * unit) for x in point) for point in exact]


def _candidates(count: int, faces: set[frozenset[int]]) -> Iterator[Hexahedron]:
    """Yield what has the edges and the facets, each once for its 24 rotations."""
    next_to = [{q for q in range(count) if frozenset((p, q)) in faces} for p in range(count)]

    def between(a: int, b: int, d: int) -> list[int]:
        return [
            c
            for c in next_to[b] & next_to[d]
            if c > first and c not in (a, b, d) and facet(a, b, c, d)
        ]

    def facet(a: int, b: int, c: int, d: int) -> bool:
        one = frozenset((a, b, c)) in faces and frozenset((a, c, d)) in faces
        return one or (frozenset((a, b, d)) in faces and frozenset((b, c, d)) in faces)

    for first in range(count):
        ahead = [p for p in next_to[first] if p > first]
        for two, four, five in ((p, q, r) for p in ahead for q in ahead for r in ahead):
            if two < four and two < five and four != five:
                yield from (
                    eight
                    for three in between(first, two, four)
                    for six in between(first, five, two)
                    for eighth in between(first, four, five)
                    for seven in next_to[three] & next_to[six] & next_to[eighth]
                    for eight in [(first, two, three, four, five, six, seven, eighth)]
                    if seven > first
                    and len(set(eight)) == 8
                    and all(facet(*(eight[v - 1] for v in f)) for f in FACETS)
                )


def _valid(own: Sequence[Vector]) -> bool:
    """Is the Jacobian positive on the cube? First at the corners, then by halving."""
    for v, corner in enumerate(AT):
        a, b, c = (AT.index((*corner[:i], 1 - corner[i], *corner[i + 1 :])) for i in range(3))
        if (-1) ** sum(corner) * sign(volume(own[v], own[a], own[b], own[c])) <= 0:
            return False
    boxes = [bernstein_coefficients([tuple(map(Fraction, point)) for point in own])]
    for step in range(3 * DEPTH):
        boxes = [box for box in boxes if min(box.values()) <= 0]
        if any(min(box[corner] for corner in product((0, 2), repeat=3)) <= 0 for box in boxes):
            return False
        boxes = [half for box in boxes for half in halves(box, step % 3)]
    assert not boxes, f"nobody knows whether {own} is valid"
    return True


def _regions(
    own: Sequence[Vector], eight: Hexahedron, solid: set[frozenset[int]]
) -> Iterator[frozenset[frozenset[int]]]:
    """Yield every labelled triangulation that is in the mesh with the signs that it must have."""
    have = {
        (quadruple, sign(volume(*(own[v - 1] for v in quadruple))))
        for quadruple in combinations(range(1, 9), 4)
        if frozenset(eight[v - 1] for v in quadruple) in solid
    }
    for instance in labelled():
        if have.issuperset(instance.signs):
            yield frozenset(frozenset(eight[v - 1] for v in t) for t in instance.tetrahedra)
