"""Forged points: moved, exchanged, coincident, in one plane, or of another pattern or question.

Points have room to move, so some of these are true.
"""

from collections.abc import Callable
from fractions import Fraction
from random import Random
from typing import TypeAlias

from certify.kernel.certificate import QUESTIONS
from certify.opinions.attack.corpus import Corpus, Draft, Forgery, Mutator, size

Points: TypeAlias = list[list[Fraction]]


def _nudged(random: Random, points: Points) -> None:
    """A coordinate moves by up to twice the extent of the points."""
    extent = max(max(column) - min(column) for column in zip(*points, strict=True))
    step = extent * random.choice((1, 2, 5, 10, 20)) / random.choice((1, 10, 100))
    random.choice(points)[random.randrange(3)] += random.choice((-1, 1)) * round(step)


def _rational(random: Random, points: Points) -> None:
    """A coordinate moves by a fraction."""
    step = Fraction(random.randint(-999, 999), random.choice((7, 1000, 10**12)))
    random.choice(points)[random.randrange(3)] += step


def _swapped(random: Random, points: Points) -> None:
    """Two vertices exchange their points, or two of their coordinates."""
    v, w = random.sample(range(8), 2)
    for axis in random.choice(((0,), (1,), (2,), (0, 1, 2))):
        points[v][axis], points[w][axis] = points[w][axis], points[v][axis]


def _coincident(random: Random, points: Points) -> None:
    """A vertex moves to the place of another one."""
    v, w = random.sample(range(8), 2)
    points[v] = list(points[w])


def _collinear(random: Random, points: Points) -> None:
    """A vertex moves to the line through two others."""
    v, a, b = random.sample(range(8), 3)
    t = random.choice((Fraction(1, 2), Fraction(1, 3), Fraction(-1), Fraction(2)))
    points[v] = [p + t * (q - p) for p, q in zip(points[a], points[b], strict=True)]


def _coplanar(random: Random, points: Points) -> None:
    """A vertex moves along an axis to the plane of three others, or a little beyond it."""
    v, a, b, c = random.sample(range(8), 4)
    axis = random.randrange(3)
    here = _volume(points[v], points[a], points[b], points[c])
    moved = list(points[v])
    moved[axis] += 1
    rate = _volume(moved, points[a], points[b], points[c]) - here
    if rate:
        points[v][axis] -= here / rate * random.choice((1, 1, Fraction(101, 100)))


def _volume(a: list[Fraction], b: list[Fraction], c: list[Fraction], d: list[Fraction]) -> Fraction:
    u, v, w = ([x - y for x, y in zip(p, a, strict=True)] for p in (b, c, d))
    return sum(
        (u[i] * (v[i - 2] * w[i - 1] - v[i - 1] * w[i - 2]) for i in range(3)), start=Fraction()
    )


def _mirrored(random: Random, points: Points) -> None:
    """All points are mirrored."""
    axis = random.randrange(3)
    for point in points:
        point[axis] = -point[axis]


def _projected(random: Random, points: Points) -> None:
    """All points, or some, move into one plane."""
    axis, size = random.randrange(3), random.randint(3, 8)
    for v in random.sample(range(8), size):
        points[v][axis] = points[0][axis]


_POINTS: dict[str, Callable[[Random, Points], None]] = {
    "nudged": _nudged,
    "rational": _rational,
    "swapped": _swapped,
    "coincident": _coincident,
    "collinear": _collinear,
    "coplanar": _coplanar,
    "mirrored": _mirrored,
    "projected": _projected,
}


def _changing_points(change: Callable[[Random, Points], None]) -> Mutator:
    def forge(random: Random, corpus: Corpus) -> Forgery:
        name, question = random.choice(corpus.answers["yes"])
        draft = Draft.of(corpus, name, question)
        answer = draft.record[question]
        points = [[Fraction(value) for value in point] for point in answer["points"]]
        change(random, points)
        answer["points"] = [[written(value) for value in point] for point in points]
        return draft.finished()

    return forge


def written(value: Fraction) -> int | str:
    """Return a coordinate as certificates have it."""
    if value.denominator == 1:
        return value.numerator
    return f"{value.numerator}/{value.denominator}"


def _points_of(*same: str) -> Mutator:
    """Points come from another pattern of the same size, or from another question."""

    def forge(random: Random, corpus: Corpus) -> Forgery:
        name, question = random.choice(corpus.answers["yes"])
        others = [
            (pattern, asked)
            for pattern, asked in corpus.answers["yes"]
            if ("pattern" in same) == (pattern == name)
            and size(pattern) == size(name)
            and ("question" not in same or asked == question)
        ]
        other, asked = random.choice(others or corpus.answers["yes"])
        draft = Draft.of(corpus, name, question)
        wanted = random.choice(QUESTIONS) if "pattern" in same else question
        draft.record[question] = {"answer": "open"}
        draft.record[wanted] = corpus.record(other)[asked]
        return draft.finished()

    return forge


KINDS: dict[str, Mutator] = {
    **{f"points: {name}": _changing_points(change) for name, change in _POINTS.items()},
    "points: of another pattern": _points_of("question"),
    "points: of another question": _points_of("pattern"),
}
"""Kind -> how one forgery of it is made."""
