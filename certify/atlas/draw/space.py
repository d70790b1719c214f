"""Eight points in space, and from where to look at them.

The axes of a view are x to the right, y upwards and z towards the viewer, who is so far away that
all rays are parallel. A view is exact: what is rounded, the choice where to stand and how to
stretch the points, is chosen first and then applied to them exactly.
"""

from collections.abc import Iterable, Sequence
from fractions import Fraction
from functools import cache
from itertools import combinations
from math import lcm, sqrt
from typing import TypeAlias

from certify.kernel.chirotope import Point
from certify.kernel.hexahedron import CORNERS, VERTICES, Simplex

Number: TypeAlias = int | Fraction | float
Spot: TypeAlias = tuple[Number, ...]
Matrix: TypeAlias = tuple[Spot, ...]

CUBE: tuple[Point, ...] = tuple(tuple(map(Fraction, CORNERS[vertex])) for vertex in VERTICES)
"""The template's corners."""

IDENTITY: Matrix = ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0))


def dot(a: Sequence[Number], b: Sequence[Number]) -> Number:
    """Return the scalar product."""
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def plus(a: Sequence[Number], b: Sequence[Number]) -> Spot:
    """Return a + b."""
    return tuple(x + y for x, y in zip(a, b, strict=True))


def minus(a: Sequence[Number], b: Sequence[Number]) -> Spot:
    """Return a - b."""
    return tuple(x - y for x, y in zip(a, b, strict=True))


def cross(a: Sequence[Number], b: Sequence[Number]) -> Spot:
    """Return the vector product."""
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def centre(spots: Sequence[Spot]) -> Spot:
    """Return the mean of some points."""
    return tuple(sum(axis) * Fraction(1, len(spots)) for axis in zip(*spots, strict=True))


def _applied(matrix: Matrix, spot: Spot) -> Spot:
    return tuple(dot(row, spot) for row in matrix)


def _product(one: Matrix, other: Matrix) -> Matrix:
    columns = tuple(zip(*other, strict=True))
    return tuple(tuple(dot(row, column) for column in columns) for row in one)


def _inverse(m: Matrix) -> Matrix:
    """Return the inverse of a regular matrix of fractions or of rounded numbers."""
    rows = (cross(m[1], m[2]), cross(m[2], m[0]), cross(m[0], m[1]))
    determinant = dot(m[0], rows[0])
    return tuple(tuple(row[i] / determinant for row in rows) for i in range(3))


def _rounded(matrix: Matrix) -> Matrix:
    return tuple(tuple(float(x) for x in row) for row in matrix)


# Stretching.

GRAIN = 1 << 10
"""What the entries of maps are rounded to: 1/GRAIN of the side of the cube."""


def like_the_cube(points: Sequence[Point]) -> list[Spot]:
    """Return the image under an affine map that makes the points look like the cube's corners.

    It is the map whose images are nearest to the corners, by the sum of squares, followed by one
    that swells what this made thin. Once rounded it is what it is: exact, with a positive
    determinant, so that it keeps planes and sides.
    """
    spots, corners = _centred(points), _centred(CUBE)
    nearest = _product(_gram(corners, spots), _inverse(_gram(spots, spots)))
    images = [_applied(nearest, spot) for spot in spots]
    spread = tuple(tuple(float(x) / 2 for x in row) for row in _gram(images, images))
    swollen = _product(_inverse_root(spread), nearest)
    rounded = tuple(tuple(Fraction(round(GRAIN * x), GRAIN) for x in row) for row in swollen)
    keeps_sides = dot(rounded[0], cross(rounded[1], rounded[2])) > 0
    return [_applied(rounded if keeps_sides else nearest, spot) for spot in spots]


def _centred(points: Sequence[Point]) -> list[Spot]:
    middle = centre(points)
    return [minus(point, middle) for point in points]


def _gram(one: Sequence[Spot], other: Sequence[Spot]) -> Matrix:
    """Return the scalar products of the coordinates of some points with those of others."""
    return tuple(
        tuple(sum(x * y for x, y in zip(xs, ys, strict=True)) for ys in zip(*other, strict=True))
        for xs in zip(*one, strict=True)
    )


def _inverse_root(matrix: Matrix) -> Matrix:
    """Return about the inverse of the square root of a positive symmetric matrix.

    By the iteration of Denman and Beavers, which needs no more than inverses and means.
    """
    one, other = matrix, IDENTITY
    for _ in range(12):
        one, other = _mean(one, _inverse(other)), _mean(other, _inverse(one))
    return other


def _mean(one: Matrix, other: Matrix) -> Matrix:
    return tuple(
        tuple((x + y) / 2 for x, y in zip(row, rival, strict=True))
        for row, rival in zip(one, other, strict=True)
    )


# Where to stand.

STEPS = (-5, -4, -6, -3, -7, 3, 4, 5, 6, 7, -2, 2)
"""How far to turn from a look straight at a face: by twice the arc tangent of STEPS/24."""

NODS = (Fraction(1, 6), Fraction(1, 4), Fraction(1, 10))
"""From how far above: twice the arc tangent of NODS."""

FRONT = len(STEPS)
"""So many standpoints of a nod are before the facet 1265, as for the cubes in textbooks."""

BESIDE = 0.9
"""What a clear view is worth from where the facet 1265 is not in front."""


def _circle(t: Fraction) -> tuple[Fraction, Fraction]:
    """Return the cosine and sine, both rational, of twice the arc tangent of ``t``."""
    return (1 - t * t) / (1 + t * t), 2 * t / (1 + t * t)


@cache
def standpoints() -> tuple[tuple[Matrix, float], ...]:
    """Return rotations to look through, a turn and a nod, and what a clear view there is worth."""
    found = []
    for cosine, sine in map(_circle, NODS):
        nod: Matrix = ((1, 0, 0), (0, sine, cosine), (0, -cosine, sine))
        for quarter in range(4):
            for step in STEPS:
                c, s = _circle(Fraction(step, 24))
                c, s = ((c, s), (-s, c), (-c, -s), (s, -c))[quarter]
                turn: Matrix = ((c, -s, 0), (s, c, 0), (0, 0, 1))
                found.append((_product(nod, turn), BESIDE if quarter else 1.0))
    return tuple(found)


def off_segment(p: Sequence[float], a: Sequence[float], b: Sequence[float]) -> float:
    """Return the distance of a point of the plane from a segment."""
    dx, dy = b[0] - a[0], b[1] - a[1]
    t = ((p[0] - a[0]) * dx + (p[1] - a[1]) * dy) / ((dx * dx + dy * dy) or 1.0)
    t = min(1.0, max(0.0, t))
    x, y = p[0] - a[0] - t * dx, p[1] - a[1] - t * dy
    return sqrt(x * x + y * y)


def clearance(flat: Sequence[Sequence[float]], edges: Iterable[Simplex]) -> float:
    """Return how far vertices keep from each other and from edges, as part of the size."""
    size: float = max(max(axis) - min(axis) for axis in list(zip(*flat, strict=True))[:2])
    apart = min(off_segment(a, b, b) for a, b in combinations(flat, 2))
    off = min(
        off_segment(flat[v - 1], flat[a - 1], flat[b - 1])
        for a, b in edges
        for v in VERTICES
        if v not in {a, b}
    )
    return min(apart, 2 * off) / size


@cache
def viewed(points: tuple[Point, ...], edges: frozenset[Simplex]) -> tuple[Spot, ...]:
    """Return the points as they are seen from where they and the edges are best told apart."""
    spots = like_the_cube(points)
    near = _rounded(tuple(spots))
    best, chosen = -1.0, standpoints()[0][0]
    for turn, worth in standpoints():
        matrix = _rounded(turn)
        flat = [tuple(map(float, _applied(matrix, spot))) for spot in near]
        score = round(worth * clearance(flat, sorted(edges)), 3)
        if score > best:
            best, chosen = score, turn
    return _whole([_applied(chosen, spot) for spot in spots])


def cube_seen() -> tuple[Spot, ...]:
    """Return the cube's corners as they are seen from where all its edges are told apart."""
    return viewed(CUBE, frozenset(combinations(VERTICES, 2)))


MAX_BITS = 200
"""With so many, even the squares of areas are floating-point numbers."""


def _whole(spots: Sequence[Spot]) -> tuple[Spot, ...]:
    """Return the points, all stretched by their common denominator: integers are faster.

    Unless that is so large that they would be far from any floating-point number.
    """
    scale = lcm(*(Fraction(x).denominator for spot in spots for x in spot))
    if scale.bit_length() > MAX_BITS:
        return tuple(spots)
    return tuple(tuple(int(x * scale) for x in spot) for spot in spots)
