"""Do points realize tetrahedra, in convex position? Planes and corners of intersections."""

from collections.abc import Sequence
from fractions import Fraction
from itertools import combinations
from typing import TypeAlias

Point: TypeAlias = Sequence[Fraction]


def volume(a: Point, b: Point, c: Point, d: Point) -> Fraction:
    """Return six times the signed volume of a tetrahedron."""
    (a1, a2, a3), (b1, b2, b3), (c1, c2, c3) = (
        [x - y for x, y in zip(p, a, strict=True)] for p in (b, c, d)
    )
    return (
        a1 * (b2 * c3 - b3 * c2) - a2 * (b1 * c3 - b3 * c1) + a3 * (b1 * c2 - b2 * c1)
    ) * Fraction(1)


def realization_fault(tetrahedra: Sequence[tuple[int, ...]], points: Sequence[Point]) -> str | None:
    """Return why the points do not realize the tetrahedra, or None if they do."""
    at = dict(enumerate(points, start=1))
    for t in tetrahedra:
        if volume(*(at[v] for v in t)) == 0:
            return f"tetrahedron {t} is flat"
    for s, t in combinations(tetrahedra, 2):
        if not (_beyond(s, t, at) or _beyond(t, s, at) or _meet_in_face(s, t, at)):
            return f"tetrahedra {s} and {t} overlap"
    return None


def _beyond(s: tuple[int, ...], t: tuple[int, ...], at: dict[int, Point]) -> bool:
    """Is what T has beyond the common vertices strictly beyond a plane of S through these?"""
    for apex in set(s) - set(t):
        face = [at[v] for v in s if v != apex]
        inside = volume(*face, at[apex])
        if all(volume(*face, at[v]) * inside < 0 for v in t if v not in s):
            return True
    return False


def _meet_in_face(s: tuple[int, ...], t: tuple[int, ...], at: dict[int, Point]) -> bool:
    """Are all corners of the intersection in the face that the common vertices span?"""
    for one, other in ((s, t), (t, s)):
        for size in (2, 1):
            for cell in combinations(one, size + 1 if size == 1 else 2):
                for face in combinations(other, 3):
                    for corner in _crossing([at[v] for v in cell], [at[v] for v in face]):
                        weights = _weights(corner, s, at)
                        if (
                            min(weights.values()) >= 0
                            and min(_weights(corner, t, at).values()) >= 0
                        ):
                            if any(w and v not in t for v, w in weights.items()):
                                return False
    return all(
        min(_weights(at[v], other, at).values()) < 0
        for one, other in ((s, t), (t, s))
        for v in one
        if v not in other
    )


def _weights(p: Point, s: tuple[int, ...], at: dict[int, Point]) -> dict[int, Fraction]:
    whole = volume(*(at[v] for v in s))
    return {v: volume(*(p if w == v else at[w] for w in s)) / whole for v in s}


def _crossing(ends: list[Point], face: list[Point]) -> list[Point]:
    a, b = (volume(*face, end) for end in ends)
    if a == b or a * b > 0:
        return []
    t = a / (a - b)
    return [[x + t * (y - x) for x, y in zip(*ends, strict=True)]]


def convexity_fault(points: Sequence[Point]) -> str | None:
    """Return a vertex that is no extreme point of the hull, or None if all are."""
    for v, p in enumerate(points):
        others = [q for w, q in enumerate(points) if w != v]
        if any(_in_hull_of_four(p, four) for four in combinations(others, 4)):
            return f"vertex {v + 1} is not extreme"
    return None


def _in_hull_of_four(p: Point, four: Sequence[Point]) -> bool:
    whole = volume(*four)
    if whole == 0:
        return False
    return all(
        volume(*(p if j == i else q for j, q in enumerate(four))) * whole >= 0 for i in range(4)
    )
