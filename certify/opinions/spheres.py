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
reach 1296 of them, which are spheres. They do not reach the last (known as the twisted product of
S^2 and S^1), which is not orientable, hence no sphere. So the list is proved to be complete as far
as this code is right. The numbers of the literature are no input but a check: 1, 2, 5, 39 and 1296
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

from certify.kernel.hexahedron import FACETS, Simplex, simplex

Complex: TypeAlias = tuple[Simplex, ...]
"""The facets (simplices of the highest dimension) of a simplicial complex, in increasing order."""

Report: TypeAlias = Callable[[str], None]


class Undecided(RuntimeError):
    """The two ways to list the spheres do not fit together; the message says how."""


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
    """Yield what single bistellar moves make of a manifold with the vertices 1, 2, ..., n.

    None of the results has more vertices than ``most``.

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
    fresh = len(vertices_of(facets)) + 1
    for old, star in around.items():
        new = tuple(v for v in vertices_of(star) if v not in old)
        if not new and fresh <= most:
            new = (fresh,)
        # In a manifold a link with as many vertices as the boundary of a simplex is that boundary.
        if len(old) + len(new) == dimension + 2 and new not in around:
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
    """Return all closed connected 3-manifolds with five to ten vertices, up to isomorphism.

    Nine vertices take a quarter of a minute; ten have not been tried.

    None is missed: let v be a vertex of greatest degree k in a manifold M. Its link is a 2-sphere
    with k vertices. Call v 1 and the others 2, ..., k + 1, in such a way that the link is one of
    those that :func:`moved` lists. Then M is one of the completions of the star of v.
    """
    if not 5 <= vertices <= 10:
        raise ValueError("between five and ten vertices")
    found: set[Complex] = set()
    for link in sorted(moved(2, vertices - 1), key=lambda link: (len(link), link)):
        degree = len(vertices_of(link))
        link_of_1 = relabelled(link, {v: v + 1 for v in range(1, degree + 1)})
        found.update(map(canonical, _Search(vertices, degree).manifolds(link_of_1)))
        if report:
            report(f"vertex of degree {degree}: {len(found)} manifolds so far")
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
        self.degree = degree
        self.vertices, self.edges, self.triangles, self.tetrahedra = (
            [simplex(face) for face in combinations(range(1, vertices + 1), size)]
            for size in (1, 2, 3, 4)
        )
        faces = self.vertices + self.edges + self.triangles
        self.around = {face: _containing(face, self.tetrahedra) for face in faces}
        self.triangles_at = {face: _containing(face, self.triangles) for face in faces}
        self.around_edges_at = {
            v: [self.around[edge] for edge in self.edges if v[0] in edge] for v in self.vertices
        }
        self.boundary = [
            sum(self.triangles_at[triangle] for triangle in combinations(tetrahedron, 3))
            for tetrahedron in self.tetrahedra
        ]

    def manifolds(self, link_of_1: Complex) -> Iterator[Complex]:
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
        if len(face) == 2 and around.bit_count() >= 6:  # two cycles have six edges
            return _is_connected([set(self.tetrahedra[k]).difference(face) for k in _bits(around)])
        return True

    def degree_of(self, vertex: Simplex, chosen: int) -> int:
        """Return the number of edges at a vertex."""
        return sum([bool(chosen & around) for around in self.around_edges_at[vertex]])


def _containing(face: Simplex, simplices: list[Simplex]) -> int:
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
        rest = [part for part in rest if part not in touching]
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
            if other not in signs:
                signs[other] = sign
                waiting.append(other)
            elif signs[other] != sign:
                return False
    return True


def spheres(vertices: int = 9, report: Report | None = None) -> list[Complex]:
    """Return all triangulated 3-spheres with that many vertices, up to isomorphism.

    Raises:
        Undecided: A manifold is neither reached by bistellar moves nor non-orientable, so it is
            unknown whether it is a sphere; or a sphere is not among the manifolds.
    """
    found = {sphere for sphere in moved(3, vertices) if len(vertices_of(sphere)) == vertices}
    if report:
        report(f"{len(found)} spheres with {vertices} vertices reached by bistellar moves")
    all_manifolds = manifolds(vertices, report)
    if not found <= all_manifolds:
        raise Undecided("a sphere that bistellar moves reach is not among the manifolds")
    others = all_manifolds - found
    if any(is_orientable(manifold) for manifold in others):
        raise Undecided("an orientable manifold is not reached by bistellar moves")
    if report:
        report(f"{len(all_manifolds)} manifolds, {len(others)} of them not orientable")
    return sorted(found, key=lambda sphere: (len(sphere), sphere))


def hexahedra(nine_vertex_spheres: Iterable[Complex]) -> Iterator[Complex]:
    """Yield the triangulations of the hexahedron in these spheres, in the template's labels.

    Each ball that is left when a vertex joined to all others is removed occurs once for each way
    to pair its boundary triangles into the six facets, unless it has a boundary tetrahedron then.
    The labels are one of the 48 choices, which the symmetries of the cube carry to each other.
    """
    facets = set(map(simplex, FACETS))
    for sphere in nine_vertex_spheres:
        for vertex in vertices_of(sphere):
            star = [tetrahedron for tetrahedron in sphere if vertex in tetrahedron]
            link = [tuple(v for v in tetrahedron if v != vertex) for tetrahedron in star]
            if len(vertices_of(link)) == 8:
                ball = [tetrahedron for tetrahedron in sphere if vertex not in tetrahedron]
                for labels in template_labels(link):
                    tetrahedra = relabelled(ball, labels)
                    if facets.isdisjoint(tetrahedra):
                        yield tetrahedra


_CUBE = nx.Graph(
    [tuple(sorted(edge)) for a, b, c, d in FACETS for edge in ((a, b), (b, c), (c, d), (d, a))]
)
"""The twelve edges of the template. Its cycles of length four are the six facets."""


def template_labels(boundary: Iterable[Simplex]) -> Iterator[dict[int, int]]:
    """Yield, for each way to make a sphere of twelve triangles the hexahedron's, one labelling.

    A way is a choice of six edges, one in each triangle (the diagonals), such that the other
    twelve are the edges of a cube. The two triangles at a diagonal have a cycle of four of these
    around them, hence make a facet. Any other labelling for the same choice comes from the one
    given by a symmetry of the cube, as the 48 are all automorphisms of the cube's graph.
    """
    triangles = list(boundary)
    edges = {edge for triangle in triangles for edge in combinations(triangle, 2)}
    for diagonals in _pairings(triangles):
        graph = nx.Graph(sorted(edges - set(diagonals)))
        if all(degree == 3 for _, degree in graph.degree) and len(graph) == 8:
            labels = nx.vf2pp_isomorphism(graph, _CUBE)
            if labels:
                yield labels


def _pairings(triangles: list[Simplex]) -> Iterator[list[Simplex]]:
    """Yield every set of edges of a closed surface of which each triangle has exactly one."""
    if not triangles:
        yield []
        return
    first, *others = triangles
    for edge in combinations(first, 2):
        for other in others:
            if set(edge) < set(other):
                for rest in _pairings([triangle for triangle in others if triangle != other]):
                    yield [edge, *rest]
