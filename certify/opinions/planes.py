"""Do exact points realize a triangulation? In convex position? By planes that separate.

Nothing of the kernel is used, and no circuits. That two tetrahedra meet only in their common face
is shown by a plane between them, and a vertex is shown to be extreme by a plane that cuts it off.

A *plane* is here an affine function f of the points that is not constant.

Lemma 1. For non-degenerate tetrahedra S, T: conv S ∩ conv T = conv(S ∩ T) iff some f is 0 on
S ∩ T, positive on the rest of S and negative on the rest of T.
Proof. If there is such an f, then a common point x has f(x) >= 0 and f(x) <= 0, hence f(x) = 0, and
as a convex combination of S it needs only vertices in S ∩ T. If there is none, then by Motzkin's
transposition theorem some numbers, not all zero, not negative on S - T and not positive on T - S,
are an affine dependence of S ∪ T. Its positive part is on S, its negative part on T; divided by
their sum, the two are convex combinations with the same value x. One of the numbers outside S ∩ T,
say on S - T, is not zero, as S ∩ T has no dependence. So x is not in conv(S ∩ T), because
barycentric coordinates in S are unique.

Lemma 2. v is outside the convex hull of other points iff some f is positive at v and negative at
them. (Two compact convex sets that are disjoint have a plane strictly between them.)

Lemma 3. Let P and N be sets of points that together span R^3. If some f is 0 on P ∩ N, positive on
the rest of P and negative on the rest of N, then so is the sum of all planes through three points
of P ∪ N that are 0 on P ∩ N, not negative on P and not positive on N.
Proof. The f that are 0 on P ∩ N, not negative on P and not positive on N, form a closed convex
cone. It contains no line, because an f that is 0 on P ∪ N is 0. So it is the sum of its extreme
rays. On such a ray, f is 0 on points that determine it up to a factor, so on three that are not in
one line: it is one of those planes. Hence the sum is in the relative interior of the cone. At a
point of P or N where some f in the cone is not 0, no f in the relative interior is.

So the sum is what is looked for, and what is checked in the end.
"""

from collections.abc import Callable, Collection, Iterable, Sequence
from fractions import Fraction
from itertools import combinations
from typing import TypeAlias

from certify.opinions.balls import Face, coherent_orientation, written

Number: TypeAlias = int | Fraction
Point: TypeAlias = Sequence[Number]
Values: TypeAlias = tuple[Number, ...]
"""The values of an affine function at the eight points, vertex 1 first."""


def affine_through(p: Point, q: Point, r: Point) -> Callable[[Point], Number]:
    """Return the function x -> det(q-p, r-p, x-p), which is 0 if p, q, r are in one line."""
    a, b, c = (y - x for x, y in zip(p, q, strict=True))
    d, e, f = (y - x for x, y in zip(p, r, strict=True))
    normal = (b * f - c * e, c * d - a * f, a * e - b * d)

    def value(x: Point) -> Number:
        return sum(n * (y - z) for n, y, z in zip(normal, x, p, strict=True))

    return value


def planes_of(points: Sequence[Point]) -> dict[Face, Values]:
    """Return the values of the plane through any three of the points, at all of them."""
    planes: dict[Face, Values] = {}
    for triple in combinations(range(1, len(points) + 1), 3):
        value = affine_through(*(points[v - 1] for v in triple))
        planes[triple] = tuple(map(value, points))
    return planes


def is_separating(values: Values, positive: Collection[int], negative: Collection[int]) -> bool:
    """Is it 0 at the common vertices, positive at the other first ones, negative at the rest?"""
    return all(
        (values[v - 1] > 0) == (v not in negative) and (values[v - 1] < 0) == (v not in positive)
        for v in {*positive, *negative}
    )


def is_weakly_separating(
    values: Values, positive: Collection[int], negative: Collection[int]
) -> bool:
    """Is it not negative at the first vertices and not positive at the others?"""
    return all(values[v - 1] >= 0 for v in positive) and all(values[v - 1] <= 0 for v in negative)


def separator(
    planes: dict[Face, Values], positive: Collection[int], negative: Collection[int]
) -> Values | None:
    """Return the values of a plane that separates the vertices; None if there is none.

    The vertices must span R^3 (Lemma 3). That the values returned are those of an affine function
    is clear, as they are a sum of such values, and that it separates is checked.
    """
    total: Values = (0,) * 8
    for triple in combinations(sorted({*positive, *negative}), 3):
        values = planes[triple]
        if is_weakly_separating(values, positive, negative):
            total = tuple(x + y for x, y in zip(total, values, strict=True))
        if is_weakly_separating(values, negative, positive):
            total = tuple(x - y for x, y in zip(total, values, strict=True))
    return total if is_separating(total, positive, negative) else None


def realization_fault(tetrahedra: Iterable[Face], points: Sequence[Point]) -> str | None:
    """Say why the points do not realize the tetrahedra, not mirrored; None if they do.

    The tetrahedra must triangulate the hexahedron. Each has the sign of the coherent orientation,
    and a plane separates any two.
    """
    signs = coherent_orientation(tetrahedra)
    planes = planes_of(points)
    for (a, b, c, d), sign in signs.items():
        volume = planes[a, b, c][d - 1]
        if volume * sign <= 0:
            fault = "inverted" if volume else "degenerate"
            return f"tetrahedron {written((a, b, c, d))} is {fault}"
    for first, second in combinations(signs, 2):
        if separator(planes, first, second) is None:
            return f"no plane separates {written(first)} and {written(second)}"
    return None


def convexity_fault(points: Sequence[Point]) -> str | None:
    """Say why the points are not in convex position; None if a plane cuts each of them off.

    Points in one plane realize nothing and are refused. Of two points that coincide, none is
    extreme.
    """
    planes = planes_of(points)
    if not any(any(values) for values in planes.values()):
        return "the points lie in one plane"
    vertices = range(1, len(points) + 1)
    for vertex in vertices:
        if separator(planes, (vertex,), [v for v in vertices if v != vertex]) is None:
            return f"vertex {vertex} is not an extreme point of the hull"
    return None
