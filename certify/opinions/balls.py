"""Is a set of tetrahedra a ball bounded by the hexahedron? By links and a collapse.

Nothing of the kernel is used, and no shelling. The tetrahedra are a triangulated 3-ball if

* no triangle lies in more than two of them;
* the link of every vertex is a disc, so that the complex is a combinatorial 3-manifold (vertices
  1..8 are all on its boundary, which is the template's);
* the complex collapses to a point. A collapsible combinatorial manifold is a ball, as it is a
  regular neighbourhood of that point (J. H. C. Whitehead, Simplicial spaces, nuclei and m-groups,
  Proceedings of the London Mathematical Society 45, 1939).

Conversely a ball has the first two properties. Only one way to collapse is tried, so a ball might
be refused in principle.
"""

from collections import Counter
from collections.abc import Collection, Iterable, Iterator
from itertools import combinations
from typing import TypeAlias

Face: TypeAlias = tuple[int, ...]
"""The vertices of a simplex, in increasing order."""

CORNERS: dict[int, tuple[int, int, int]] = {
    1: (0, 0, 0), 2: (1, 0, 0), 3: (1, 1, 0), 4: (0, 1, 0),
    5: (0, 0, 1), 6: (1, 0, 1), 7: (1, 1, 1), 8: (0, 1, 1),
}  # fmt: skip
"""Vertex -> its corner of the reference cube."""

FACETS: tuple[Face, ...] = tuple(
    tuple(v for v in CORNERS if CORNERS[v][axis] == side) for axis in range(3) for side in (0, 1)
)
"""The four vertices of each facet, in increasing order."""

EDGES: frozenset[Face] = frozenset(
    pair for pair in combinations(CORNERS, 2) if sum(set(pair) <= set(f) for f in FACETS) == 2
)
"""The twelve edges of the template: two facets meet in each."""


def written(face: Iterable[int]) -> str:
    """Return a face's vertices in a row."""
    return "".join(map(str, face))


def faces(tops: Iterable[Face]) -> set[Face]:
    """Return all non-empty faces of some simplices."""
    return {
        face for top in tops for size in range(1, len(top) + 1) for face in combinations(top, size)
    }


def ball_fault(tetrahedra: Iterable[Face]) -> str | None:
    """Say why the tetrahedra do not triangulate the hexahedron; None if they do."""
    tops = list(tetrahedra)
    for top in tops:
        if len(top) != 4 or list(top) != sorted(set(top)) or not set(top) <= set(CORNERS):
            return f"{top} is not an increasing list of four of the vertices 1 to 8"
    if len(set(tops)) < len(tops):
        return "a tetrahedron occurs twice"
    faults = (boundary_fault(tops), *(link_fault(tops, v) for v in CORNERS))
    if fault := next(filter(None, faults), None):
        return fault
    if not collapses(tops):
        return "no collapse to a point is found"
    return None


def boundary_fault(tops: Collection[Face]) -> str | None:
    """Say why the boundary is not the template's, or which facet is a tetrahedron.

    In each facet there are two triangles of exactly one tetrahedron, made by one of the two
    diagonals: they share an edge that is not one of the template. Such are all triangles of
    exactly one tetrahedron, and none lies in more than two.
    """
    for facet in FACETS:
        if facet in tops:
            return f"{written(facet)} is a boundary tetrahedron"
    count = Counter(triangle for top in tops for triangle in combinations(top, 3))
    for triangle, times in count.items():
        if times > 2:
            return f"triangle {written(triangle)} lies in {times} tetrahedra"
    outer = {triangle for triangle, times in count.items() if times == 1}
    for facet in FACETS:
        halves = [set(triangle) for triangle in outer if set(triangle) <= set(facet)]
        if len(halves) != 2 or tuple(sorted(set.intersection(*halves))) in EDGES:
            return f"facet {written(facet)} is not cut in two by a diagonal"
    if len(outer) != 12:
        return f"{len(outer)} triangles, not 12, lie in exactly one tetrahedron"
    return None


def link_fault(tops: Iterable[Face], vertex: int) -> str | None:
    """Say why a vertex's link is not a disc; None if it is. No triangle lies in three tetrahedra.

    Every edge of the link lies in one or two of its triangles, as these are triangles and
    tetrahedra at the vertex. So the link is a surface iff the link of each of its vertices, the
    other ends of the edges at it and the edges opposite to it, is connected: having one or two
    neighbours everywhere, it is then a path or a cycle. A connected surface with a boundary and
    Euler characteristic 1 is a disc: the one other surface with this number, the projective plane,
    has no boundary.
    """
    link = link_of(tops, vertex)
    name = f"the link of vertex {vertex}"
    if not link or len(pieces(link)) > 1:
        return f"{name} is not connected"
    for (other,) in (face for face in faces(link) if len(face) == 1):
        if len(pieces(link_of(link, other))) > 1:
            return f"{name} is not a surface at vertex {other}"
    edges = Counter(edge for triangle in link for edge in combinations(triangle, 2))
    if 1 not in edges.values():
        return f"{name} has no boundary"
    euler = sum((-1) ** (len(face) - 1) for face in faces(link))
    if euler != 1:
        return f"{name} has Euler characteristic {euler}"
    return None


def link_of(tops: Iterable[Face], vertex: int) -> list[Face]:
    """Return the faces opposite to a vertex in the simplices that contain it."""
    return [tuple(v for v in top if v != vertex) for top in tops if vertex in top]


def pieces(tops: Iterable[Face]) -> list[set[int]]:
    """Return the vertices of each connected component."""
    found: list[set[int]] = []
    for top in tops:
        touched = [piece for piece in found if not piece.isdisjoint(top)]
        found = [piece for piece in found if piece.isdisjoint(top)]
        found.append(set(top).union(*touched))
    return found


def collapses(tops: Iterable[Face]) -> bool:
    """Does the complex of these tetrahedra collapse to a point, if one goes on without a plan?

    An elementary collapse removes a face and the only other face that contains it. Those that
    remove tetrahedra can come first, then those that remove triangles, then edges. Only how the
    tetrahedra go leaves a choice that matters: of a complex of triangles, a collapse that goes on
    as long as triangles go ends in the same way whatever its order, with a graph if any does; and
    a graph collapses to a point iff it is a tree. So a True is a proof, a False is none. Of the
    patterns and all their instances none needs another choice.
    """
    left = faces(tops)
    for size in (4, 3, 2):
        while pair := _free_pair(left, size):
            left.difference_update(pair)
    return len(left) == 1


def _free_pair(left: set[Face], size: int) -> tuple[Face, Face] | None:
    """Return a face of ``size`` vertices and a facet of it that is in no other such face."""
    large = sorted(face for face in left if len(face) == size)
    count = Counter(small for face in large for small in combinations(face, size - 1))
    for face in large:
        for small in combinations(face, size - 1):
            if count[small] == 1 and small in left:
                return face, small
    return None


def coherent_orientation(tetrahedra: Iterable[Face]) -> dict[Face, int]:
    """Return the sign of det(b-a, c-a, d-a) for each tetrahedron abcd of a hexahedron.

    It is the sign in every embedding that lies as the reference cube does, and a chain whose
    boundary has no inner triangle: the sum of sign times tetrahedron. In the boundary of abcd the
    triangle without the i-th vertex, counted from 0, has the coefficient (-1)^i. At a boundary
    triangle the tetrahedron lies on the side of the cube's centre, and has the sign that it would
    have with the centre in place of its other vertex.

    Raises:
        ValueError: There are no such signs.
    """
    tops = list(tetrahedra)
    count = Counter(side for top in tops for _, side in _sides(top))
    signs: dict[Face, int] = {}
    wanted: dict[Face, int] = {}
    """A triangle -> the coefficient that the next tetrahedron at it is to give to it."""
    for top in tops:
        for i, triangle in _sides(top):
            if count[triangle] == 1:
                wanted[triangle] = _side_of_centre(top, top[i]) * (-1) ** i
    waiting = tops
    while ready := [top for top in waiting if any(side in wanted for _, side in _sides(top))]:
        top = ready[0]
        waiting = [other for other in waiting if other != top]
        demands = {wanted[side] * (-1) ** i for i, side in _sides(top) if side in wanted}
        if len(demands) > 1:
            raise ValueError(f"two signs for tetrahedron {written(top)}")
        signs[top] = demands.pop()
        wanted.update((side, -signs[top] * (-1) ** i) for i, side in _sides(top))
    if waiting:
        raise ValueError(f"tetrahedron {written(waiting[0])} is not joined to the boundary")
    return signs


def _sides(top: Face) -> Iterator[tuple[int, Face]]:
    """Yield each place in a tetrahedron, with the triangle of the other three vertices."""
    for i in range(4):
        yield i, top[:i] + top[i + 1 :]


def _side_of_centre(top: Face, apex: int) -> int:
    """Return the sign of a tetrahedron in the cube if one vertex is moved to the cube's centre.

    Twice the size, with the centre as origin, the corners have coordinates 1 and -1. The other
    vertices are in one facet, not in a line, or there is no sign and a ValueError.
    """
    points = {v: [2 * x - 1 for x in CORNERS[v]] for v in top}
    points[apex] = [0, 0, 0]
    a, *others = (points[v] for v in top)
    p, q, r = ([x - y for x, y in zip(b, a, strict=True)] for b in others)
    volume = sum(
        p[i] * (q[j] * r[k] - q[k] * r[j]) for i, j, k in ((0, 1, 2), (1, 2, 0), (2, 0, 1))
    )
    if volume == 0:
        raise ValueError(f"a side of tetrahedron {written(top)} is in no facet")
    return 1 if volume > 0 else -1


def symmetries() -> list[dict[int, int]]:
    """Return the automorphisms of the graph of the template's edges: the cube's 48 symmetries.

    A cycle of four edges in this graph is a facet, so an automorphism permutes the facets.
    """
    partial: list[dict[int, int]] = [{}]
    for v in CORNERS:
        partial = [
            {**images, v: image}
            for images in partial
            for image in CORNERS
            if image not in images.values()
            and all(_adjacent(v, w) == _adjacent(image, images[w]) for w in images)
        ]
    return partial


def _adjacent(v: int, w: int) -> bool:
    return (min(v, w), max(v, w)) in EDGES


def instances(tetrahedra: Iterable[Face]) -> set[tuple[Face, ...]]:
    """Return the images of the tetrahedra under the 48 symmetries, each in increasing order."""
    tops = list(tetrahedra)
    return {
        tuple(sorted(tuple(sorted(images[v] for v in top)) for top in tops))
        for images in symmetries()
    }
