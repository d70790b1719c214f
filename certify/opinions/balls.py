"""Do tetrahedra make a ball bounded by the hexahedron? Links of vertices, not shellings."""

from collections import Counter
from collections.abc import Sequence
from itertools import combinations

_QUADRILATERALS = ("1234", "1265", "1485", "2376", "3487", "5678")


def ball_fault(tetrahedra: Sequence[tuple[int, ...]]) -> str | None:
    """Return why the tetrahedra are no ball bounded by the hexahedron, or None if they are."""
    if len(set(tetrahedra)) < len(tetrahedra) or not tetrahedra:
        return "a tetrahedron occurs twice, or there is none"
    around = Counter(face for t in tetrahedra for face in combinations(t, 3))
    boundary = {face for face, number in around.items() if number == 1}
    if max(around.values()) > 2 or len(boundary) != 12:
        return "the triangles do not close up to a boundary of twelve"
    for quadrilateral in _QUADRILATERALS:
        facet = {int(digit) for digit in quadrilateral}
        if any(set(t) == facet for t in tetrahedra):
            return "there is a boundary tetrahedron"
        a, b, c, d = (int(digit) for digit in quadrilateral)
        halves = [face for face in boundary if set(face) < facet]
        if {frozenset(facet - set(face)) for face in halves} not in (
            {frozenset({a}), frozenset({c})},
            {frozenset({b}), frozenset({d})},
        ):
            return "the boundary is not that of the hexahedron"
    for vertex in range(1, 9):
        link = [tuple(v for v in t if v != vertex) for t in tetrahedra if vertex in t]
        edges = {edge for face in link for edge in combinations(face, 2)}
        corners = {v for face in link for v in face}
        if not link or len(corners) - len(edges) + len(link) != 1 or not _connected(link):
            return f"the link of vertex {vertex} is not a disc"
    faces = {f for t in tetrahedra for size in (1, 2, 3, 4) for f in combinations(t, size)}
    if sum(-((-1) ** len(face)) for face in faces) != 1:
        return "the Euler characteristic is not 1"
    return None if _connected(tetrahedra) else "the tetrahedra are not connected"


def _connected(cells: Sequence[tuple[int, ...]]) -> bool:
    reached, rest = {cells[0]}, set(cells[1:])
    while new := {c for c in rest if any(len(set(c) & set(o)) == len(c) - 1 for o in reached)}:
        reached |= new
        rest -= new
    return not rest
