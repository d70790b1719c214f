"""Every triangulation of the hexahedron with a given boundary, by exhaustive search.

This is section 5 of CHECKING without a formula and without a solver. Tetrahedra are added one at a
time, on a triangle that still needs one, in all possible ways.

*Nothing is missed.* Let B be a triangulated ball with the given boundary, all eight vertices of
which are on the boundary. A set S of tetrahedra of B is *closed* if each boundary triangle lies in
one of them and every other in none or two. Claim: a closed S is all of B. A triangle of B that lies
in a tetrahedron of S has every tetrahedron of B on it in S: the only one if it is in the boundary,
and else both. Let T be a tetrahedron of B and v a vertex of T. As v is on the boundary, some
tetrahedron of S has the vertex v. The link of v in B is a disc, so one passes from that tetrahedron
to T through triangles at v, and never leaves S. So while the search has a proper part of B, some
triangle needs a tetrahedron, and B has exactly one that can be added there: one branch leads to B,
and only one.

*What is found.* Where no triangle needs a tetrahedron, the set is kept if the link of each edge is
one path, one cycle or empty, and that of each vertex a disc. All this holds in a ball. A set that
is kept is a 3-manifold with the given boundary; that it is a ball is for the kernel's shelling to
show.

Nothing is pruned: the whole search visits some 700,000 sets, and takes less than half a minute.
"""

from collections.abc import Callable, Iterable
from dataclasses import dataclass, field
from itertools import combinations
from typing import TypeAlias

Vertices: TypeAlias = tuple[int, ...]
Triangulation: TypeAlias = frozenset[Vertices]

VERTICES: Vertices = (1, 2, 3, 4, 5, 6, 7, 8)
FACETS: tuple[Vertices, ...] = (
    (1, 2, 3, 4), (1, 2, 5, 6), (1, 4, 5, 8), (2, 3, 6, 7), (3, 4, 7, 8), (5, 6, 7, 8),
)  # fmt: skip
TETRAHEDRA = tuple(t for t in combinations(VERTICES, 4) if t not in FACETS)
TRIANGLES = tuple(combinations(VERTICES, 3))
EDGES: tuple[Vertices, ...] = tuple(combinations(VERTICES, 2))

# A set of tetrahedra is a mask, with bit k for TETRAHEDRA[k].


def mask(face: Iterable[int]) -> int:
    """Return the set of all tetrahedra with this face."""
    vertices = set(face)
    return sum(1 << k for k, t in enumerate(TETRAHEDRA) if vertices <= set(t))


def members(chosen: int) -> list[int]:
    """Return the numbers of the tetrahedra in a set."""
    return [k for k in range(chosen.bit_length()) if chosen >> k & 1]


ON = {face: mask(face) for size in (1, 2, 3) for face in combinations(VERTICES, size)}
"""Vertex, edge or triangle -> the tetrahedra with this face."""


def boundary_of(diagonals: Iterable[Vertices]) -> frozenset[Vertices]:
    """Return the twelve triangles into which the diagonals cut the facets."""
    cuts = [set(diagonal) for diagonal in diagonals]
    return frozenset(
        triangle
        for triangle in TRIANGLES
        if any(set(triangle) < set(facet) for facet in FACETS)
        and any(cut < set(triangle) for cut in cuts)
    )


@dataclass
class Search:
    """The search for all triangulations with one boundary."""

    boundary: frozenset[Vertices]
    found: set[Triangulation] = field(default_factory=set)
    visited: int = 0
    """How many sets of tetrahedra there were on the way, the closed ones included."""
    closed: int = 0
    """How many closed sets."""

    def extend(self, chosen: int, barred: int) -> None:
        """Find all that contain the chosen tetrahedra and none of the barred ones.

        Those on a triangle that has all its tetrahedra are barred, except the chosen ones.
        """
        self.visited += 1
        places = self.places(chosen, barred)
        if not places:
            self.closed += 1
            if is_manifold(chosen):
                self.found.add(frozenset(TETRAHEDRA[k] for k in members(chosen)))
            return
        for k in members(min(places, key=int.bit_count)):
            larger = chosen | 1 << k
            self.extend(larger, barred | self.filled(larger, TETRAHEDRA[k]))

    def places(self, chosen: int, barred: int) -> list[int]:
        """Return, for each triangle that needs a tetrahedron, those that could be added there."""
        places = []
        for triangle in TRIANGLES:
            there = (ON[triangle] & chosen).bit_count()
            if there == 0 if triangle in self.boundary else there == 1:
                places.append(ON[triangle] & ~chosen & ~barred)
        return places

    def filled(self, chosen: int, newcomer: Vertices) -> int:
        """Return the tetrahedra on those triangles of the newcomer that now have all they may."""
        full = 0
        for triangle in combinations(newcomer, 3):
            if triangle in self.boundary or (ON[triangle] & chosen).bit_count() == 2:
                full |= ON[triangle]
        return full


def link(face: Vertices, chosen: int) -> list[set[int]]:
    """Return the simplices of the link of a face: what completes it to chosen tetrahedra."""
    return [set(TETRAHEDRA[k]) - set(face) for k in members(ON[face] & chosen)]


def is_manifold(chosen: int) -> bool:
    """Are the links of edges single paths or cycles, or empty, and those of vertices discs?

    The set is closed; so each component of an edge's link is a path or a cycle.
    """
    return all(len(components(link(edge, chosen))) <= 1 for edge in EDGES) and all(
        is_disc(link((v,), chosen)) for v in VERTICES
    )


def components(cells: list[set[int]]) -> list[list[set[int]]]:
    """Return the cells in classes: those that share a vertex are in the same one."""
    parts: list[list[set[int]]] = []
    for cell in cells:
        touching = [part for part in parts if any(cell & other for other in part)]
        parts = [part for part in parts if part not in touching]
        parts.append([cell, *(other for part in touching for other in part)])
    return parts


def is_disc(triangles: list[set[int]]) -> bool:
    """Is a surface with a boundary a disc?

    It is iff it is connected and has Euler characteristic one. That it is a surface means that the
    link of each vertex in it is a single path or cycle.
    """
    faces = {face for t in triangles for n in (1, 2, 3) for face in combinations(sorted(t), n)}
    return len(components(triangles)) == 1 and sum((-1) ** (len(f) - 1) for f in faces) == 1


def triangulations(
    diagonals: Iterable[Vertices], report: Callable[[str], object] = lambda _: None
) -> set[Triangulation]:
    """Return all triangulations of the hexahedron whose boundary has these six diagonals."""
    search = Search(boundary_of(diagonals))
    search.extend(0, 0)
    report(
        f"{len(search.found)} triangulations among {search.closed} closed sets, "
        f"{search.visited} sets visited"
    )
    return search.found
