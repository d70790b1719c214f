"""Exact geometry by other means than the kernel's, and placements for the tests to try.

A *placement* is eight integer points, vertex 1 first. Nothing of the kernel is used here but its
type aliases, so what this module says of a placement is a second opinion.
"""

from collections.abc import Iterable, Mapping, Sequence
from fractions import Fraction
from functools import cache
from itertools import combinations, permutations, product
from random import Random
from typing import TypeAlias

from hypothesis import settings
from hypothesis import strategies as st

from certify.kernel.chirotope import Point
from certify.kernel.hexahedron import Simplex

Vector: TypeAlias = tuple[int, ...]
Placement: TypeAlias = tuple[Vector, ...]
Tetrahedra: TypeAlias = tuple[Simplex, ...]

VERTICES = range(1, 9)
QUADRUPLES: tuple[Simplex, ...] = tuple(combinations(VERTICES, 4))
CUBE: Placement = (
    (0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1),
)  # fmt: skip


def simplices(text: str) -> tuple[Simplex, ...]:
    """Read "1236 1348" as ((1, 2, 3, 6), (1, 3, 4, 8))."""
    return tuple(tuple(map(int, word)) for word in text.split())


CUBE_TRIANGULATIONS: dict[str, Tetrahedra] = {
    name: simplices(text)
    for name, text in {
        "core": "1236 1348 1368 1568 3678",
        "corner": "1236 1346 1468 1568 3468 3678",
        "slab": "1235 1348 1358 2357 2567 3578",
        "ring": "1235 1345 2356 3458 3567 3578",
        "twist": "1235 1345 2356 3457 3567 4578",
        "stair": "1235 1345 2357 2567 3457 4578",
    }.items()
}
"""One of each class of triangulations of the unit cube itself."""


def exact(placement: Iterable[Sequence[int | Fraction]]) -> tuple[Point, ...]:
    """Return the points as the kernel takes them."""
    return tuple(tuple(map(Fraction, point)) for point in placement)


def sign(value: int | Fraction) -> int:
    return (value > 0) - (value < 0)


def minus(p: Vector, q: Vector) -> Vector:
    return tuple(x - y for x, y in zip(p, q, strict=True))


def dot(p: Vector, q: Vector) -> int:
    return sum(x * y for x, y in zip(p, q, strict=True))


def cross(p: Vector, q: Vector) -> Vector:
    return p[1] * q[2] - p[2] * q[1], p[2] * q[0] - p[0] * q[2], p[0] * q[1] - p[1] * q[0]


def volume(a: Vector, b: Vector, c: Vector, d: Vector) -> int:
    """Return det(b-a, c-a, d-a), as a triple product."""
    return dot(cross(minus(b, a), minus(c, a)), minus(d, a))


def leibniz(rows: Sequence[Sequence[Fraction]]) -> Fraction:
    """Return the determinant as the sum over all permutations."""
    total = Fraction(0)
    for columns in permutations(range(len(rows))):
        term = Fraction((-1) ** sum(i > j for i, j in combinations(columns, 2)))
        for row, column in zip(rows, columns, strict=True):
            term *= row[column]
        total += term
    return total


def signs_of(placement: Placement) -> dict[Simplex, int]:
    """Return the sign of every quadruple's volume."""
    return {q: sign(volume(*(placement[v - 1] for v in q))) for q in QUADRUPLES}


def spans_space(placement: Placement) -> bool:
    return any(signs_of(placement).values())


def null_space(rows: Sequence[Sequence[int]]) -> list[list[Fraction]]:
    """Return a basis of the vectors c with sum c_i rows_i = 0, by Gaussian elimination."""
    width = len(rows[0])
    pending = [
        list(map(Fraction, (*row, *(i == j for j in range(len(rows))))))
        for i, row in enumerate(rows)
    ]
    for column in range(width):
        pivot = next((row for row in pending if row[column]), None)
        if pivot is None:
            continue
        pending.remove(pivot)
        for row in pending:
            factor = row[column] / pivot[column]
            row[:] = [x - factor * y for x, y in zip(row, pivot, strict=True)]
    return [row[width:] for row in pending]


def half_spaces(corners: Sequence[Vector]) -> list[tuple[Vector, int]]:
    """Return the four (n, k) with the tetrahedron = all x such that n.x >= k."""
    result = []
    for i, apex in enumerate(corners):
        a, b, c = (*corners[:i], *corners[i + 1 :])
        normal = cross(minus(b, a), minus(c, a))
        if dot(normal, apex) < dot(normal, a):
            normal = minus((0, 0, 0), normal)
        result.append((normal, dot(normal, a)))
    return result


def strictly_inside(point: Vector, corners: Sequence[Vector]) -> bool:
    """Is the point in the interior of the (perhaps flat, then empty) tetrahedron?"""
    return volume(*corners) != 0 and all(dot(n, point) > k for n, k in half_spaces(corners))


def meet_in_common_face(placement: Placement, s: Simplex, t: Simplex) -> bool:
    """Is the intersection of two solid tetrahedra the hull of their common vertices?

    The intersection is a polytope; it is that hull iff each of its vertices is a common vertex.
    A vertex is where three of the eight planes meet in one point that is in all eight half-spaces.
    """
    planes = [h for face in (s, t) for h in half_spaces([placement[v - 1] for v in face])]
    common = [placement[v - 1] for v in s if v in t]
    for (n1, k1), (n2, k2), (n3, k3) in combinations(planes, 3):
        n23, n31, n12 = cross(n2, n3), cross(n3, n1), cross(n1, n2)
        scale = dot(n1, n23)
        if scale == 0:
            continue
        vertex = [k1 * x + k2 * y + k3 * z for x, y, z in zip(n23, n31, n12, strict=True)]
        if scale < 0:
            scale, vertex = -scale, [-x for x in vertex]
        if all(dot(n, tuple(vertex)) >= k * scale for n, k in planes) and not any(
            all(x == scale * y for x, y in zip(vertex, p, strict=True)) for p in common
        ):
            return False
    return True


def realizes(placement: Placement, orientation: dict[Simplex, int]) -> bool:
    """Have all tetrahedra their signs, and meet any two in a common face?"""
    signs = signs_of(placement)
    return all(signs[t] == orientation[t] != 0 for t in orientation) and all(
        meet_in_common_face(placement, s, t) for s, t in combinations(orientation, 2)
    )


def is_extreme(placement: Placement, vertex: int) -> bool:
    """Is there a direction in which the vertex alone is farthest? By Fourier-Motzkin elimination.

    Wanted is n with n.(p_vertex - p) > 0 for all other p. Eliminating a coordinate of n leaves the
    positive combinations of two inequalities in which it cancels; at last "0 > 0" or nothing.
    """
    tip = placement[vertex - 1]
    rows = [minus(tip, p) for v, p in zip(VERTICES, placement, strict=True) if v != vertex]
    for axis in range(3):
        rows = [row for row in rows if row[axis] == 0] + [
            tuple(x * -down[axis] + y * up[axis] for x, y in zip(up, down, strict=True))
            for up in rows
            for down in rows
            if up[axis] > 0 > down[axis]
        ]
    return not rows


@cache
def cube_symmetries() -> tuple[tuple[int, ...], ...]:
    """Return all permutations of the cube's vertices that preserve distances."""

    def distance(v: int, w: int) -> int:
        return sum(x != y for x, y in zip(CUBE[v - 1], CUBE[w - 1], strict=True))

    partial: list[tuple[int, ...]] = [()]
    for new in VERTICES:
        partial = [
            (*images, v)
            for images in partial
            for v in VERTICES
            if v not in images
            and all(distance(v, w) == distance(new, old) for old, w in enumerate(images, start=1))
        ]
    return tuple(partial)


def relabel(symmetry: tuple[int, ...], faces: Iterable[Simplex]) -> frozenset[Simplex]:
    return frozenset(tuple(sorted(symmetry[v - 1] for v in face)) for face in faces)


def true_literals(signs: Mapping[Simplex, int]) -> frozenset[int]:
    """Return which literals hold: 2k-1 is "the k-th determinant is positive", 2k "negative"."""
    truth = {}
    for k, quadruple in enumerate(QUADRUPLES, start=1):
        truth[2 * k - 1] = signs[quadruple] > 0
        truth[2 * k] = signs[quadruple] < 0
    return frozenset(v if value else -v for v, value in truth.items())


# Hypothesis.


def examples(count: int) -> settings:
    """Return settings for a deterministic run without time limits."""
    return settings(max_examples=count, derandomize=True, deadline=None, database=None)


def eight(points: Sequence[Vector]) -> st.SearchStrategy[Placement]:
    """Return random choices, with repetition, of eight of the points.

    The draw is uniform, whereas hypothesis favours repeated values: it would make most placements
    degenerate, where degenerate ones are only wanted as often as a small grid has them.
    """
    return st.integers(0, 2**64 - 1).map(lambda seed: tuple(Random(seed).choices(points, k=8)))


SCATTERED = eight(list(product(range(-20, 21), repeat=3)))
"""Almost always in general position."""

CROWDED = eight(list(product(range(3), repeat=3)))
"""Points of a small grid: coincident, collinear and coplanar ones abound."""

FLAT = eight([(x, y, x - 2 * y + 1) for x, y in product(range(-3, 4), repeat=2)])
"""All eight points in one plane."""

SHUFFLED_CUBE = st.permutations(CUBE).map(tuple)

PLACEMENTS = st.one_of(SCATTERED, CROWDED, eight(CUBE), SHUFFLED_CUBE)

ON_HULL = st.one_of(
    eight([p for p in product(range(3), repeat=3) if p != (1, 1, 1)]),
    eight([p for p in product(range(-7, 8), repeat=3) if dot(p, p) == 50]),
)
"""Corners, edge and facet midpoints of one cube; or points of one sphere."""


def near(placement: Placement, size: int, shift: int) -> st.SearchStrategy[Placement]:
    """Return placements ``size`` times as large, each coordinate moved by at most ``shift``."""
    shifts = eight(list(product(range(-shift, shift + 1), repeat=3)))
    return shifts.map(
        lambda moves: tuple(
            tuple(size * x + y for x, y in zip(point, move, strict=True))
            for point, move in zip(placement, moves, strict=True)
        )
    )
