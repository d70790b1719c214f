"""The triangulations of the 3-sphere with few vertices, and the hexahedra inside them.

This is the paper's own road (sections 3.1 and 3.2): a ball with eight vertices, together with the
cone over its boundary, is a 3-sphere with nine. So take each triangulated 3-sphere with nine
vertices, remove a vertex joined to all the others, and keep the ball if its boundary is that of a
hexahedron. The paper takes the spheres from the literature. Here they are made from the
definitions alone, in two ways.

*Bistellar moves.* :func:`moved` follows them from the boundary of a simplex. A move keeps the
homeomorphism type, so all it finds are spheres. Nothing says that it finds all: Pachner's theorem
(1987) lets the number of vertices rise in between, and here it is bounded. In dimension two it
does find all, by Wagner's theorem (1936) on edge flips.

*Exhaustion.* :func:`manifolds` finds every closed connected 3-manifold with a given number of
vertices; its docstring has the proof.

:func:`spheres` runs both and compares. With nine vertices there are 1297 manifolds. The moves
reach 1296 of them, which are spheres. They never reach the last, the twisted product of S^2 and
S^1; it is not orientable, hence no sphere. So the list is proved to be complete as far as this
code is right, and the numbers of the literature are a check and no input: 1, 2, 5, 39 and 1296
spheres with five to nine vertices (Altshuler and Steinberg 1976; Lutz 2008, who also has the 1297).

Isomorphic complexes are recognized by :func:`canonical`. Its value is the complex itself with
other labels, so a mistake of nauty could list a class twice, but never lose one.
"""

from collections import defaultdict
from collections.abc import Callable, Iterable, Iterator
from itertools import combinations
from typing import NamedTuple, TypeAlias

import networkx as nx
import pynauty

from certify.kernel.hexahedron import BOUNDARIES, FACETS, Simplex, boundary_triangles, simplex

Complex: TypeAlias = tuple[Simplex, ...]
"""The facets (simplices of the highest dimension) of a simplicial complex, in increasing order."""

Report: TypeAlias = Callable[[str], None]


class Undecided(RuntimeError):
    """The two ways to list the spheres do not fit together."""


def vertices_of(facets: Iterable[Simplex]) -> Simplex:
    """Return the vertices of a complex, in increasing order."""
    return tuple(sorted({vertex for facet in facets for vertex in facet}))


def relabelled(facets: Iterable[Simplex], labels: dict[int, int]) -> Complex:
    """Return the complex with every vertex v called ``labels[v]``."""
    return tuple(sorted(simplex(tuple(labels[v] for v in facet)) for facet in facets))


def canonical(facets: Iterable[Simplex]) -> Complex:
    """Return the complex with labels 1, 2, ... that are the same for isomorphic complexes.

    The labels are nauty's, for the graph of the incidences between vertices and facets.
    """
    facets = list(facets)
    vertices = vertices_of(facets)
    size, total = len(vertices), len(vertices) + len(facets)
    graph = pynauty.Graph(
        total,
        adjacency_dict={
            size + i: [vertices.index(vertex) for vertex in facet] for i, facet in enumerate(facets)
        },
        vertex_coloring=[set(range(size)), set(range(size, total))],
    )
    order = pynauty.canon_label(graph)[:size]
    return relabelled(facets, {vertices[v]: label for label, v in enumerate(order, start=1)})


def bistellar_moves(facets: Complex, most: int) -> Iterator[Complex]:
    """Yield the results of all bistellar moves on a manifold 1, 2, ... with at most that many.

    A move takes a face A whose link is the boundary of a simplex B that is no face itself: the
    simplices around A, A joined with the boundary of B, give way to the boundary of A joined
    with B. If A is a facet, then B is a new vertex.
    """
    around = defaultdict(list)
    for facet in facets:
        for size in range(1, len(facet) + 1):
            for face in combinations(facet, size):
                around[face].append(facet)
    dimension = len(facets[0]) - 1
    vertices = vertices_of(facets)
    for old, star in around.items():
        if len(old) == dimension + 1:
            new: Simplex = (len(vertices) + 1,)
        else:
            new = tuple(v for v in vertices_of(star) if v not in old)
        # In a manifold a link with as many vertices as the boundary of a simplex is that boundary.
        if len(old) + len(new) == dimension + 2 and new not in around and new[0] <= most:
            kept = [facet for facet in facets if facet not in star]
            put = [simplex((*face, *new)) for face in combinations(old, len(old) - 1)]
            yield tuple(kept + put)


def moved(dimension: int, most: int) -> set[Complex]:
    """Return all that bistellar moves make of the boundary of a simplex, up to isomorphism.

    Never are there more than ``most`` vertices. Everything returned is a sphere.
    """
    start = canonical(combinations(range(1, dimension + 3), dimension + 1))
    reached, waiting = {start}, [start]
    while waiting:
        for result in map(canonical, bistellar_moves(waiting.pop(), most)):
            if result not in reached:
                reached.add(result)
                waiting.append(result)
    return reached


def manifolds(vertices: int, report: Report | None = None) -> set[Complex]:
    """Return all closed connected 3-manifolds with at most ten vertices, up to isomorphism.

    None is missed: let v be a vertex of greatest degree k in a manifold M. Its link is a 2-sphere
    with k vertices. Call v 1 and the others 2, ..., k + 1, in such a way that the link is one of
    those that :func:`moved` lists. Then M is one of the completions of the star of v.
    """
    found: set[Complex] = set()
    for link in sorted(moved(2, vertices - 1), key=lambda link: (len(link), link)):
        link_of_1 = relabelled(link, {v: v + 1 for v in vertices_of(link)})
        found.update(map(canonical, _Search(vertices, len(vertices_of(link))).all(link_of_1)))
        if report:
            report(f"vertex of degree {len(vertices_of(link))}: {len(found)} manifolds so far")
    return found


class _Partial(NamedTuple):
    """Some tetrahedra of a manifold: sets of tetrahedra and triangles as bits of integers."""

    chosen: int
    """The tetrahedra."""
    allowed: int
    """The tetrahedra that may be added."""
    open: int
    """The triangles that lie in exactly one chosen tetrahedron."""


class _Search:
    """All 3-manifolds with the vertices 1, ..., n and no vertex of more than a given degree.

    A triangle of a closed manifold lies in exactly two tetrahedra. As long as there is an open
    one, try all allowed tetrahedra as its second. A manifold is strongly connected, so the
    tetrahedra chosen along it are all of it once no triangle is open. Dropped on the way is only
    what no manifold contains:

    * a third tetrahedron at a triangle, or another one at an edge or a vertex all of whose
      triangles are closed: its link is then a whole cycle or sphere;
    * an edge whose link falls into several cycles;
    * a vertex of too great a degree, or with closed triangles and not 2d - 4 tetrahedra, d being
      its degree: such is, by Euler's formula, a sphere with d vertices;
    * a vertex beyond the first that has not occurred: those are interchangeable.

    What is left has cycles as links of edges, hence surfaces as links of vertices, each of Euler
    characteristic 2 and with at most nine vertices. It is connected, hence a sphere: of several
    surfaces with sum 2 one is no sphere and has six vertices or more, another has four or more.
    """

    def __init__(self, vertices: int, degree: int) -> None:
        names = range(1, vertices + 1)
        self.degree = degree
        self.vertices = [(v,) for v in names]
        self.tetrahedra = list(combinations(names, 4))
        self.triangles = list(combinations(names, 3))
        faces = [face for size in (1, 2, 3) for face in combinations(names, size)]
        self.around = {face: _bits_containing(face, self.tetrahedra) for face in faces}
        self.triangles_at = {face: _bits_containing(face, self.triangles) for face in faces}
        self.boundary = [
            sum(self.triangles_at[triangle] for triangle in combinations(tetrahedron, 3))
            for tetrahedron in self.tetrahedra
        ]
        self.edges_at = {
            (v,): [edge for edge in combinations(names, 2) if v in edge] for v in names
        }

    def all(self, link_of_1: Complex) -> Iterator[Complex]:
        """Yield every manifold in which vertex 1 has this link."""
        start: _Partial | None = _Partial(0, (1 << len(self.tetrahedra)) - 1, 0)
        for triangle in link_of_1:
            if start:
                start = self.added(start, self.tetrahedra.index((1, *triangle)))
        if start:
            yield from self.completions(start)

    def completions(self, partial: _Partial) -> Iterator[Complex]:
        """Yield every manifold that contains the chosen tetrahedra, and otherwise allowed ones."""
        absent = [v for v in self.vertices if not partial.chosen & self.around[v]]
        if not partial.open:
            if not absent:
                yield tuple(self.tetrahedra[k] for k in _bits(partial.chosen))
            return
        candidates = min(
            (partial.allowed & self.around[self.triangles[k]] for k in _bits(partial.open)),
            key=int.bit_count,
        )
        for later in absent[1:]:
            candidates &= ~self.around[later]
        for k in _bits(candidates):
            if larger := self.added(partial, k):
                yield from self.completions(larger)

    def added(self, partial: _Partial, number: int) -> _Partial | None:
        """Return the partial manifold with one more tetrahedron, or None if that cannot be."""
        tetrahedron = self.tetrahedra[number]
        chosen, allowed = partial.chosen | 1 << number, partial.allowed & ~(1 << number)
        now_open = partial.open ^ self.boundary[number]
        for size in (3, 2, 1):
            for face in combinations(tetrahedron, size):
                if size == 1 and self.degree_of(face, chosen) > self.degree:
                    return None
                if not now_open & self.triangles_at[face]:
                    allowed &= ~self.around[face]
                    if not self.is_closed(face, chosen):
                        return None
        return _Partial(chosen, allowed, now_open)

    def is_closed(self, face: Simplex, chosen: int) -> bool:
        """Is the link of a face all of whose triangles are closed a cycle, or a sphere?"""
        around = chosen & self.around[face]
        if len(face) == 1:
            return around.bit_count() == 2 * self.degree_of(face, chosen) - 4
        if len(face) == 2:
            link = [set(self.tetrahedra[k]).difference(face) for k in _bits(around)]
            return around.bit_count() < 6 or _is_connected(link)
        return True

    def degree_of(self, vertex: Simplex, chosen: int) -> int:
        """Return the number of edges at a vertex."""
        return sum(bool(chosen & self.around[edge]) for edge in self.edges_at[vertex])


def _bits_containing(face: Simplex, simplices: list[Simplex]) -> int:
    """Return the set of the simplices that contain a face, the k-th of them as the k-th bit."""
    return sum(1 << k for k, other in enumerate(simplices) if set(face) <= set(other))


def _bits(members: int) -> Iterator[int]:
    """Yield the elements of a set that is kept as an integer."""
    while members:
        lowest = members & -members
        yield lowest.bit_length() - 1
        members ^= lowest


def _is_connected(parts: list[set[int]]) -> bool:
    """Do these sets, joined where they meet, form one piece?"""
    piece, rest = set(parts[0]), parts[1:]
    while touching := [part for part in rest if piece & part]:
        piece.update(*touching)
        rest = [part for part in rest if not piece & part]
    return not rest


def is_orientable(facets: Complex) -> bool:
    """Can the tetrahedra of a closed connected manifold be oriented coherently?

    They are if every triangle gets opposite signs from its two tetrahedra.
    """
    signs, waiting = {facets[0]: 1}, [facets[0]]
    while waiting:
        facet = waiting.pop()
        for i, vertex in enumerate(facet):
            triangle = set(facet) - {vertex}
            other = next(f for f in facets if f != facet and triangle < set(f))
            j = next(j for j, v in enumerate(other) if v not in triangle)
            sign = -signs[facet] * (-1) ** (i + j)
            if signs.setdefault(other, sign) != sign:
                return False
            if other not in waiting and other != facet:
                pass
    return True
