"""Eight points and their tetrahedra as somebody sees them: what hides what is decided exactly.

Everything is a sum, a product or a comparison of integers or fractions. Only the choice where to
stand is made with rounded numbers, and nothing that is said rests on it. The axes of a view are x
to the right, y upwards and z towards the viewer, who is so far away that rays are parallel.
"""

from collections.abc import Iterable, Iterator, Mapping, Sequence
from fractions import Fraction
from functools import cache
from itertools import combinations
from math import lcm, sqrt
from typing import NamedTuple, TypeAlias

from certify.kernel.certificate import Certificate, Yes
from certify.kernel.chirotope import Point
from certify.kernel.hexahedron import CORNERS, FACETS, VERTICES, Simplex, simplex
from certify.kernel.triangulation import triangles

Number: TypeAlias = int | Fraction
Spot: TypeAlias = tuple[Number, ...]
"""A point of a view."""

Matrix: TypeAlias = tuple[tuple[Fraction, ...], ...]
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


CUBE: tuple[Point, ...] = tuple(tuple(map(Fraction, CORNERS[vertex])) for vertex in VERTICES)
"""The template's corners."""


def edge_kind(edge: Simplex) -> str:
    """Return what an edge is: of the hexahedron, a diagonal of a facet, or an inner one."""
    if edge in HEXAHEDRON_EDGES:
        return "hexahedron"
    return "diagonal" if edge in DIAGONALS else "inner"


# Where to stand.


class Face(NamedTuple):
    """A triangle whose outside is seen, corners counterclockwise, and the piece it belongs to."""

    corners: tuple[Spot, ...]
    piece: int


def _dot(a: Sequence[Number], b: Sequence[Number]) -> Number:
    return sum(x * y for x, y in zip(a, b, strict=True))


def _minus(a: Sequence[Number], b: Sequence[Number]) -> Spot:
    return tuple(x - y for x, y in zip(a, b, strict=True))


def _cross(a: Sequence[Number], b: Sequence[Number]) -> Spot:
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def _applied(matrix: Matrix, point: Sequence[Number]) -> Spot:
    return tuple(_dot(row, point) for row in matrix)


def _product(one: Matrix, other: Matrix) -> Matrix:
    columns = tuple(zip(*other, strict=True))
    return tuple(tuple(Fraction(_dot(row, c)) for c in columns) for row in one)


def _inverse(m: Matrix) -> Matrix:
    """Return the inverse of a regular 3 x 3 matrix."""
    rows = (_cross(m[1], m[2]), _cross(m[2], m[0]), _cross(m[0], m[1]))
    determinant = _dot(m[0], rows[0])
    return tuple(tuple(Fraction(row[i]) / determinant for row in rows) for i in range(3))


def centred(points: Sequence[Point]) -> list[Spot]:
    """Return the points with their mean at the origin."""
    middle = [sum(axis) / Fraction(len(points)) for axis in zip(*points, strict=True)]
    return [_minus(point, middle) for point in points]


def _gram(one: Sequence[Spot], other: Sequence[Spot]) -> Matrix:
    """Return the sum of the products of columns and rows: one^T other."""
    return tuple(
        tuple(Fraction(sum(a[i] * b[j] for a, b in zip(one, other, strict=True))) for j in range(3))
        for i in range(3)
    )


GRAIN = 1 << 10
"""What the entries of maps are rounded to: 1/GRAIN of the side of the cube."""


def like_the_cube(points: Sequence[Point]) -> list[Spot]:
    """Return the image under the affine map that takes the points nearest to the cube's corners.

    "Nearest" by the sum of squares. The map, once rounded, is what it is: exact, with a positive
    determinant, so that it keeps planes, sides and volumes' signs. Of points near a plane the
    nearest map would make a thin thing, so half of the inverse least-squares map is mixed in.
    """
    spots = centred(points)
    corners = centred(CUBE)
    there = _product(_gram(corners, spots), _inverse(_gram(spots, spots)))
    rounded = tuple(tuple(Fraction(round(GRAIN * x), GRAIN) for x in row) for row in there)
    matrix = rounded if _dot(rounded[0], _cross(rounded[1], rounded[2])) > 0 else there
    return [_applied(matrix, spot) for spot in spots]


def _turn(t: Fraction) -> tuple[Fraction, Fraction]:
    """Return the cosine and sine, both rational, of twice the arc tangent of ``t``."""
    return (1 - t * t) / (1 + t * t), 2 * t / (1 + t * t)


STEPS = (-5, -4, -6, -3, -7, 3, 4, 5, 6, 7, -2, 2)
"""How far to turn from a look straight at a face: by twice the arc tangent of STEPS/24."""

NODS = (Fraction(1, 6), Fraction(1, 4), Fraction(1, 10))


@cache
def standpoints() -> tuple[Matrix, ...]:
    """Return rotations to look through: a turn around the upright axis, then a nod."""
    one, zero = Fraction(1), Fraction(0)
    turns = []
    for step in STEPS:
        c, s = _turn(Fraction(step, 24))
        turns.append([(c, s), (-s, c), (-c, -s), (s, -c)])
    return tuple(
        _product(
            ((one, zero, zero), (zero, s, c), (zero, -c, s)),
            ((a, -b, zero), (b, a, zero), (zero, zero, one)),
        )
        for c, s in map(_turn, NODS)
        for quarter in range(4)
        for a, b in (turn[quarter] for turn in turns)
    )


def whole(spots: Sequence[Spot]) -> list[Spot]:
    """Return the points, all stretched by their common denominator: integers are faster."""
    scale = lcm(*(Fraction(x).denominator for spot in spots for x in spot))
    return [tuple(int(x * scale) for x in spot) for spot in spots]


def _distance(p: Sequence[float], a: Sequence[float], b: Sequence[float]) -> float:
    """Return the distance of a point of the picture from a segment."""
    dx, dy = b[0] - a[0], b[1] - a[1]
    t = ((p[0] - a[0]) * dx + (p[1] - a[1]) * dy) / ((dx * dx + dy * dy) or 1.0)
    t = min(1.0, max(0.0, t))
    x, y = p[0] - a[0] - t * dx, p[1] - a[1] - t * dy
    return sqrt(x * x + y * y)


def clearance(spots: Sequence[Spot], edges: Iterable[Simplex]) -> float:
    """Return how far vertices keep from each other and from edges, as part of the size."""
    flat = [(float(x), float(y)) for x, y, _ in spots]
    size: float = max(max(axis) - min(axis) for axis in zip(*flat, strict=True))
    apart = min(_distance(a, b, b) for a, b in combinations(flat, 2))
    off = min(
        _distance(flat[v - 1], flat[a - 1], flat[b - 1])
        for a, b in edges
        for v in VERTICES
        if v not in (a, b)
    )
    return min(apart, 2 * off) / size


def straight(points: Sequence[Point]) -> list[Spot]:
    """Return the points of a cube from where cubes are mostly drawn."""
    return whole([_applied(standpoints()[0], spot) for spot in centred(points)])


def viewed(points: Sequence[Point], edges: frozenset[Simplex]) -> list[Spot]:
    """Return the points as they are seen from where they and the edges are best told apart."""
    spots = like_the_cube(points)
    views = [[_applied(turn, spot) for spot in spots] for turn in standpoints()]
    scores = [round(clearance(view, edges), 3) for view in views]
    return whole(views[scores.index(max(scores))])


# What hides what.


def outside(a: Spot, b: Spot, c: Spot, inner: Spot) -> tuple[Spot, ...] | None:
    """Return a triangle's corners counterclockwise if its side away from ``inner`` is seen."""
    area = _cross(_minus(b, a), _minus(c, a))
    away = _dot(area, _minus(a, inner))
    if area[2] == 0 or (away > 0) != (area[2] > 0):
        return None
    return (a, b, c) if area[2] > 0 else (a, c, b)


def _plane(face: Face) -> tuple[Spot, Number]:
    a, b, c = face.corners[:3]
    normal = _cross(_minus(b, a), _minus(c, a))
    return normal, _dot(normal, a)


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
        sides = [_dot(normal, corner) - height for corner in face.corners]
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
    conditions = [(height - _dot(normal, a), height - _dot(normal, b))]
    for i, corner in enumerate(corners):
        last = corners[i - 1]
        dx, dy = corner[0] - last[0], corner[1] - last[1]
        conditions.append(
            tuple(dx * (p[1] - last[1]) - dy * (p[0] - last[0]) for p in (a, b))  # type: ignore[arg-type]
        )
    low, high = Fraction(0), Fraction(1)
    for at_a, at_b in conditions:
        if max(at_a, at_b) <= 0 and min(at_a, at_b) < 0:
            return None  # outside, or it only touches
        if at_a * at_b < 0:
            crossing = Fraction(at_a) / (at_a - at_b)
            low, high = (max(low, crossing), high) if at_a < 0 else (low, min(high, crossing))
    if low >= high or conditions[0] == (0, 0):
        return None
    return low, high


# What is to be seen.


def piece_faces(corners: Sequence[Sequence[Spot]]) -> list[Face]:
    """Return the faces that are seen of tetrahedra, each given by its four corners."""
    found = []
    for piece, four in enumerate(corners):
        for k in range(4):
            a, b, c = (spot for i, spot in enumerate(four) if i != k)
            seen = outside(a, b, c, four[k])
            if seen:
                found.append(Face(seen, piece))
    return found


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
    return [Face(corners, number) for number, corners in enumerate(filter(None, seen))]


def apart(
    spots: Sequence[Spot], tetrahedra: Sequence[Simplex], by: Fraction
) -> list[tuple[Spot, ...]]:
    """Return the corners of each tetrahedron, moved from the centre by a multiple of its distance.

    They meet no more than before: stretched as a whole, each shrinks into its own stretched place.
    """
    middle = [sum(axis) / Fraction(len(spots)) for axis in zip(*spots, strict=True)]
    pieces = []
    for tetrahedron in tetrahedra:
        four = [spots[v - 1] for v in tetrahedron]
        away = [
            by * (sum(axis) / Fraction(4) - m)
            for axis, m in zip(zip(*four, strict=True), middle, strict=True)
        ]
        pieces.append([tuple(x + y for x, y in zip(spot, away, strict=True)) for spot in four])
    integral = whole([spot for piece in pieces for spot in piece])
    return [tuple(integral[i : i + 4]) for i in range(0, len(integral), 4)]
