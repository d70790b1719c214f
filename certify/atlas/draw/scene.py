"""What is seen of a triangulated ball, and what hides what: decided exactly.

Everything is a sum, a product or a comparison of integers or fractions. The axes are those of
space.py: the viewer looks against z.
"""

from collections.abc import Iterable, Iterator, Mapping, Sequence
from fractions import Fraction
from typing import NamedTuple, TypeAlias

from certify.atlas.draw.space import Number, Spot, cross, dot, minus
from certify.kernel.certificate import Certificate, Yes
from certify.kernel.chirotope import Point
from certify.kernel.hexahedron import FACETS, Simplex, simplex
from certify.kernel.triangulation import triangles

Interval: TypeAlias = tuple[Fraction, Fraction]

HEXAHEDRON_EDGES = frozenset(
    simplex((facet[i - 1], facet[i])) for facet in FACETS for i in range(4)
)
DIAGONALS = frozenset(simplex(facet[i : i + 3 : 2]) for facet in FACETS for i in range(2))

BEST_FIRST = ("valid", "convex", "realizable")
"""Questions, in the order in which their points are liked for a picture."""


def witness(certificate: Certificate) -> tuple[str, tuple[Point, ...]] | None:
    """Return the best question that is answered by points, with them; None if there is none."""
    for question in BEST_FIRST:
        answer = certificate.answers[question]
        if isinstance(answer, Yes):
            return question, answer.points
    return None


def edge_kind(edge: Simplex) -> str:
    """Return what an edge is: of the hexahedron, a diagonal of a facet, or an inner one."""
    if edge in HEXAHEDRON_EDGES:
        return "hexahedron"
    return "diagonal" if edge in DIAGONALS else "inner"


# What hides what.


class Face(NamedTuple):
    """A triangle, or a part of one, whose outside is seen; its corners are counterclockwise."""

    corners: tuple[Spot, ...]


def outside(a: Spot, b: Spot, c: Spot, inner: Spot) -> tuple[Spot, ...] | None:
    """Return a triangle's corners counterclockwise if its side away from ``inner`` is seen.

    Of a sliver, where ``inner`` is in the plane of the triangle, either side is.
    """
    area = cross(minus(b, a), minus(c, a))
    away = dot(area, minus(a, inner))
    if area[2] == 0 or away * area[2] < 0:
        return None
    return (a, b, c) if area[2] > 0 else (a, c, b)


def _plane(face: Face) -> tuple[Spot, Number]:
    a, b, c = face.corners[:3]
    normal = cross(minus(b, a), minus(c, a))
    return normal, dot(normal, a)


def painters_order(faces: Sequence[Face]) -> Iterator[Face]:
    """Yield the faces from back to front, cut where they must be: a tree of half-spaces.

    Every face looks at the viewer. So what is on the outer side of its plane can be hidden by
    nothing on the inner side, and is painted later.
    """
    if len(faces) < 2:
        yield from faces
        return
    splits = [_split_by(faces, k) for k in range(len(faces))]
    behind, level, before = min(splits, key=lambda parts: sum(map(len, parts)))
    yield from painters_order(behind)
    yield from level
    yield from painters_order(before)


def _split_by(faces: Sequence[Face], k: int) -> tuple[list[Face], list[Face], list[Face]]:
    """Return what lies behind, in and before the plane of one of the faces."""
    normal, height = _plane(faces[k])
    behind, level, before = [], [], []
    for face in faces:
        sides = [dot(normal, corner) - height for corner in face.corners]
        if all(side == 0 for side in sides):
            level.append(face)
        elif all(side <= 0 for side in sides):
            behind.append(face)
        elif all(side >= 0 for side in sides):
            before.append(face)
        else:
            behind.append(_part(face, [-side for side in sides]))
            before.append(_part(face, sides))
    return behind, level, before


def _part(face: Face, sides: Sequence[Number]) -> Face:
    """Return the part of a face where a function, given at its corners, is not negative."""
    corners = []
    for i, (corner, side) in enumerate(zip(face.corners, sides, strict=True)):
        last, before = face.corners[i - 1], sides[i - 1]
        if side * before < 0:
            corners.append(between(last, corner, Fraction(before) / (before - side)))
        if side >= 0:
            corners.append(corner)
    return face._replace(corners=tuple(corners))


def between(a: Spot, b: Spot, t: Number) -> Spot:
    """Return the point at the parameter ``t`` of a segment."""
    return tuple(x + t * (y - x) for x, y in zip(a, b, strict=True))


class Stretch(NamedTuple):
    """A part of a segment that is seen as a whole, or hidden as a whole."""

    start: Fraction
    end: Fraction
    hidden: bool


def stretches(a: Spot, b: Spot, faces: Iterable[Face]) -> list[Stretch]:
    """Return the parts of a segment, in order, that are hidden by the faces or not."""
    parts = []
    at, last = Fraction(0), Fraction(1)
    for start, end in sorted(filter(None, (_hidden(a, b, face) for face in faces))):
        if end <= at:
            continue
        if start > at:
            parts.append(Stretch(at, start, hidden=False))
            at = start
        if parts and parts[-1].hidden:
            parts[-1] = parts[-1]._replace(end=end)
        else:
            parts.append(Stretch(at, end, hidden=True))
        at = end
    if at < last:
        parts.append(Stretch(at, last, hidden=False))
    return parts


def _hidden(a: Spot, b: Spot, face: Face) -> Interval | None:
    """Return the interval of a segment that is behind a face that looks at the viewer.

    Over the closed triangle, and strictly behind its plane: so the triangle hides none of its own
    edges. The interval is open where it ends at the plane.
    """
    corners = face.corners
    if any(
        max(a[i], b[i]) < min(c[i] for c in corners) or min(a[i], b[i]) > max(c[i] for c in corners)
        for i in (0, 1)
    ):
        return None
    normal, height = _plane(face)
    conditions = [(height - dot(normal, a), height - dot(normal, b))]
    for i, corner in enumerate(corners):
        last = corners[i - 1]
        dx, dy = corner[0] - last[0], corner[1] - last[1]
        at_a, at_b = (dx * (p[1] - last[1]) - dy * (p[0] - last[0]) for p in (a, b))
        conditions.append((at_a, at_b))
    low, high = Fraction(0), Fraction(1)
    for at_a, at_b in conditions:
        if max(at_a, at_b) <= 0 and min(at_a, at_b) < 0:
            return None  # outside, or it only touches
        if at_a * at_b < 0:
            crossing = Fraction(at_a) / Fraction(at_a - at_b)
            low, high = (max(low, crossing), high) if at_a < 0 else (low, min(high, crossing))
    if low >= high or conditions[0] == (0, 0):
        return None
    return low, high


# What is to be seen.


def inner_sides(spots: Sequence[Spot], tetrahedra: Sequence[Simplex]) -> dict[Simplex, Spot]:
    """Return the boundary triangles of a ball, each with a point on its inner side."""
    apex: dict[Simplex, int | None] = {}
    for tetrahedron in tetrahedra:
        for triangle in triangles(tetrahedron):
            (other,) = set(tetrahedron) - set(triangle)
            apex[triangle] = None if triangle in apex else other
    return {triangle: spots[v - 1] for triangle, v in sorted(apex.items()) if v is not None}


def shell(spots: Sequence[Spot], boundary: Mapping[Simplex, Spot]) -> list[Face]:
    """Return those triangles of a boundary whose outside is seen."""
    seen = (
        outside(spots[a - 1], spots[b - 1], spots[c - 1], inner)
        for (a, b, c), inner in boundary.items()
    )
    return [Face(corners) for corners in seen if corners]
