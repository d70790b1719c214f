"""The CNF that every triangulation of the hexahedron with a given boundary satisfies.

Variable k = 1..64 says that the k-th quadruple of 1..8 that is no facet is one of the tetrahedra.
Later variables are defined by clauses in terms of earlier ones, so that every choice of tetrahedra
extends to them in exactly one way: they exclude nothing by themselves.

If the formula for a boundary, with one more clause for each triangulation that is listed, is
unsatisfiable, then the list is complete for that boundary. Symmetries carry each of the 64
boundaries to one of seven.
"""

from collections.abc import Collection, Iterable, Iterator
from itertools import combinations

from certify.kernel.chirotope import QUADRUPLES
from certify.kernel.hexahedron import FACETS, VERTICES, Simplex, boundary_triangles, simplex
from certify.kernel.orientations import Clause

INNER: tuple[Simplex, ...] = tuple(q for q in QUADRUPLES if q not in set(map(simplex, FACETS)))
"""The 64 quadruples that are no facet: every tetrahedron of a triangulation is one of them."""

_NUMBER = {tetrahedron: k for k, tetrahedron in enumerate(INNER, start=1)}


def _containing(face: Simplex) -> list[int]:
    """Return the variables of the tetrahedra that contain a face."""
    return [k for tetrahedron, k in _NUMBER.items() if set(face) <= set(tetrahedron)]


def triangle_clauses(boundary: Collection[Simplex]) -> Iterator[Clause]:
    """A boundary triangle lies in one tetrahedron, every other in none or in two.

    Necessary: in a 3-manifold every triangle has one side or two, one iff it is in the boundary.
    """
    for face in combinations(VERTICES, 3):
        around = _containing(face)
        if face in boundary:
            yield tuple(around)
        else:
            for k in around:
                yield (-k, *(other for other in around if other != k))
        for several in combinations(around, 2 if face in boundary else 3):
            yield tuple(-k for k in several)


def edge_clauses(boundary: Collection[Simplex]) -> Iterator[Clause]:
    """The link of an edge is one path if the edge is in the boundary, else one cycle or empty.

    Necessary: in a 3-manifold the tetrahedra around an edge form a fan or a wheel. By the triangle
    clauses every vertex of the link has two neighbours in it or none, except that the two ends of
    a boundary edge's path have one. So only these are to be excluded: around a boundary edge, a
    cycle on vertices that are not ends (three or four of four); around another, two cycles (three
    and three of six).
    """
    for edge in combinations(VERTICES, 2):
        others = [vertex for vertex in VERTICES if vertex not in edge]
        ends = [vertex for vertex in others if simplex((*edge, vertex)) in boundary]
        free = [vertex for vertex in others if vertex not in ends]
        if ends:
            forbidden = [cycle for size in (3, 4) for cycle in _cycles(free, size)]
        else:
            forbidden = [
                [*cycle, *other]
                for cycle in _cycles(free, 3)
                for other in _cycles([v for v in free if all(v not in pair for pair in cycle)], 3)
                if cycle < other
            ]
        for pairs in forbidden:
            around = [_NUMBER.get(simplex((*edge, *pair))) for pair in pairs]
            if None not in around:
                yield tuple(-k for k in around if k)


def _cycles(vertices: list[int], length: int) -> list[list[Simplex]]:
    """Return the cycles of length three or four on some of the vertices, as lists of pairs."""
    if length == 3:
        return [list(combinations(three, 2)) for three in combinations(vertices, 3)]
    return [
        [pair for pair in combinations(four, 2) if pair not in (skip, simplex(rest))]
        for four in combinations(vertices, 4)
        for skip in combinations(four, 2)
        if four[0] in skip
        for rest in [tuple(v for v in four if v not in skip)]
    ]


def vertex_clauses(boundary: Collection[Simplex]) -> Iterator[Clause]:
    """The number of tetrahedra at a vertex is b - 2 + 2i.

    Here b boundary triangles and i edges that are not in the boundary meet at the vertex.
    Necessary: the link of a vertex on the boundary of a 3-manifold is a disc. It has one triangle
    for each tetrahedron, b boundary vertices, as many boundary edges, and i inner vertices; by
    Euler's formula a disc has b - 2 + 2i triangles.
    """
    boundary_edges = {edge for face in boundary for edge in combinations(face, 2)}
    inner_edges = {
        edge: len(INNER) + n
        for n, edge in enumerate(
            (edge for edge in combinations(VERTICES, 2) if edge not in boundary_edges), start=1
        )
    }
    for edge, used in inner_edges.items():
        around = _containing(edge)
        yield (-used, *around)
        yield from ((used, -k) for k in around)
    fresh = len(INNER) + len(inner_edges) + 1
    for vertex in VERTICES:
        edges = [used for edge, used in inner_edges.items() if vertex in edge]
        least = sum(vertex in face for face in boundary) - 2
        clauses, some_edges, fresh = _count(edges, len(edges), fresh)
        yield from clauses
        most = least + 2 * len(edges) + 1
        clauses, some_tetrahedra, fresh = _count(_containing((vertex,)), most, fresh)
        yield from clauses
        for i in range(len(edges) + 1):
            at_least_i = [-some_edges[i - 1]] if i else []
            more_than_i = [some_edges[i]] if i < len(edges) else []
            yield (*at_least_i, some_tetrahedra[least + 2 * i - 1])
            yield (*more_than_i, -some_tetrahedra[least + 2 * i])


def _count(inputs: list[int], most: int, fresh: int) -> tuple[list[Clause], list[int], int]:
    """Return clauses, variables "at least j of the inputs are true" for j = 1..most, next fresh.

    The sequential counter: "at least j of the first n" iff "at least j of the first n-1", or
    the n-th and "at least j-1 of the first n-1". Variables from ``fresh`` on are defined.
    """
    clauses: list[Clause] = []
    before: list[int] = []
    for n, literal in enumerate(inputs):
        now = list(range(fresh, fresh + min(n + 1, most)))
        fresh += len(now)
        for j, defined in enumerate(now):
            enough = [before[j]] if j < len(before) else []
            one_less = [before[j - 1]] if j else []
            clauses += [(defined, -k) for k in enough]
            clauses.append((defined, -literal, *(-k for k in one_less)))
            clauses.append((-defined, *enough, literal))
            clauses += [(-defined, *enough, k) for k in one_less]
        before = now
    return clauses, before, fresh


def listed(triangulation: Iterable[Simplex]) -> Clause:
    """Return the clause "the tetrahedra are not exactly these"."""
    chosen = set(triangulation)
    return tuple(-k if tetrahedron in chosen else k for tetrahedron, k in _NUMBER.items())


def triangulation_formula(diagonals: frozenset[Simplex]) -> tuple[Clause, ...]:
    """Return the clauses that every triangulation with this boundary satisfies."""
    boundary = boundary_triangles(diagonals).keys()
    return (*triangle_clauses(boundary), *edge_clauses(boundary), *vertex_clauses(boundary))
