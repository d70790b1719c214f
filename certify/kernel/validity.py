"""Clauses that the signs of every valid hexahedron satisfy, beyond those of a realization.

Valid: the points realize the triangulation, not mirrored, and the Jacobian J of the trilinear map
(see jacobian.py) is positive on the closed unit cube. Variables and clauses are those of
orientations.py. As there, no position of the points is excluded.
"""

from collections.abc import Iterable, Iterator, Mapping
from itertools import combinations

from certify.kernel.hexahedron import CORNERS, VERTICES, Simplex
from certify.kernel.orientations import Clause, bracket, realization_formula

_VERTEX_AT = {corner: vertex for vertex, corner in CORNERS.items()}


def across(vertex: int, *axes: int) -> int:
    """Return the vertex whose reference corner differs in exactly the given axes 0, 1, 2."""
    x, y, z = (bit ^ (axis in axes) for axis, bit in enumerate(CORNERS[vertex]))
    return _VERTEX_AT[x, y, z]


def corners() -> Iterator[Clause]:
    """The Jacobian is positive at the eight corners.

    There it is the determinant of the three edges at the vertex, taken along the axes: up to the
    sign of the axes that point back, the determinant of the vertex and its three neighbours.
    """
    for vertex, corner in CORNERS.items():
        neighbours = (across(vertex, axis) for axis in range(3))
        yield (bracket((vertex, *neighbours), (-1) ** sum(corner)),)


def edges() -> Iterator[Clause]:
    """The Jacobian is positive along the twelve edges.

    Let the edge run from v to w; from v let p and q be across the two other axes, from w P and Q.
    On the edge J(t) = a (1-t)^2 + (b + c) t (1-t) + d t^2 where, up to one common sign,
    a = [vwpq], b = [vwpQ], c = [vwPq], d = [vwPQ]. If J > 0 on [0,1], then a, d > 0 and, at the t
    where sqrt(a) (1-t) = sqrt(d) t, b + c > -2 sqrt(ad). So if b and c are negative, then
    2 sqrt(bc) <= |b| + |c| < 2 sqrt(ad). By the Grassmann-Pluecker relation ad - bc = [vwpP][vwqQ]:
    if b and c are negative, this product is positive.
    """
    for i, j, k in ((0, 1, 2), (1, 2, 0), (2, 0, 1)):
        for v, corner in CORNERS.items():
            if corner[i] == 0:
                w = across(v, i)
                sign = (-1) ** (corner[j] + corner[k])
                mixed = ((v, w, across(v, j), across(w, k)), (v, w, across(w, j), across(v, k)))
                escape = [-bracket(vertices, -sign) for vertices in mixed]
                first, second = ((v, w, across(v, axis), across(w, axis)) for axis in (j, k))
                for e in (1, -1):
                    yield (*escape, bracket(first, e), bracket(second, -e))


def sections(tetrahedra: Iterable[Simplex]) -> Iterator[Clause]:
    """Opposite facets whose separating section could not be a disc do not face each other.

    Let A = a1..a4 and B = b1..b4 be opposite facets in corresponding order, ai joined to bi.

    Section lemma. If J vanishes nowhere on the closed cube, and det A and det B have opposite
    signs, then some plane H has all of A strictly on one side and all of B strictly on the other.
    Proof. Let ai(t) run from ai to bi. det(a1(t)..a4(t)) changes sign, so it vanishes for some
    0 < t < 1: the trilinear map sends that section of the cube into a plane H, with normal n. There
    the cross product of its two partial derivatives along the section is j n for a function j, and
    J = j e, where e is n times the third derivative. As J has no zero, neither has e: it has one
    sign. At the corners e = n (bi - ai), and ai(t) lies on H strictly between ai and bi.

    Consequence. H meets no vertex and crosses, of the boundary's edges, those from A to B: four
    edges ai bi and, in between, one diagonal of each of the four facets; that is one circle. So in
    a realized ball H cuts out a surface that lies in a plane and has one boundary circle: a disc.
    Its vertices, edges and faces are the edges, triangles and tetrahedra with vertices in both A
    and B. Where their alternating sum is not 1, det A and det B have no opposite signs.
    """
    cells = {
        frozenset(cell)
        for tetrahedron in tetrahedra
        for size in (2, 3, 4)
        for cell in combinations(tetrahedron, size)
    }
    for axis in range(3):
        a = tuple(v for v in VERTICES if CORNERS[v][axis] == 0)
        b = tuple(across(v, axis) for v in a)
        crossing = [cell for cell in cells if not (cell.isdisjoint(a) or cell.isdisjoint(b))]
        if sum((-1) ** len(cell) for cell in crossing) != 1:
            for sign in (1, -1):
                yield (-bracket(a, sign), -bracket(b, -sign))


def valid_formula(orientation: Mapping[Simplex, int]) -> tuple[Clause, ...]:
    """Return the clauses that every valid hexahedron with these tetrahedra satisfies."""
    return (*realization_formula(orientation), *corners(), *edges(), *sections(orientation))
