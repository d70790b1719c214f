"""Where the nodes of a decomposition graph go in the plane, so that its symmetry is seen.

A symmetry of the triangulation permutes the tetrahedra. Some of them are made rotations and
reflections of the plane; a layout that they leave as it is spreads the nodes by their distances
along edges. Only sums, products, quotients and square roots are taken, which round alike
everywhere, so that a graph has the same picture on every machine.
"""

from collections.abc import Iterator, Sequence
from functools import cache
from itertools import combinations
from math import sqrt
from typing import NamedTuple, TypeAlias

from certify.atlas.draw.picture import Place
from certify.atlas.draw.space import off_segment
from certify.graphs import Decomposition, Tetrahedra, decomposition
from certify.kernel.hexahedron import SYMMETRIES, image

Permutation: TypeAlias = tuple[int, ...]
Motion: TypeAlias = tuple[float, float, float, float]
"""A 2 x 2 matrix, row by row."""

IDENTITY: Motion = (1.0, 0.0, 0.0, 1.0)
MIRROR: Motion = (-1.0, 0.0, 0.0, 1.0)
COSINES = {1: 1.0, 2: -1.0, 3: -0.5, 4: 0.0, 6: 0.5}
"""Order of a rotation -> cosine of its angle; no symmetry of the cube has another order."""


class Action(NamedTuple):
    """Permutations of the nodes, and what each does to the plane."""

    motions: tuple[tuple[Permutation, Motion], ...]


def permutations_of(tetrahedra: Tetrahedra) -> tuple[Permutation, ...]:
    """Return how the symmetries of a triangulation permute its tetrahedra, the identity first."""
    number = {tetrahedron: k for k, tetrahedron in enumerate(tetrahedra)}
    found = {tuple(range(len(tetrahedra))): None}
    for symmetry in SYMMETRIES:
        images = [image(symmetry, tetrahedron) for tetrahedron in tetrahedra]
        if set(images) == set(tetrahedra):
            found.setdefault(tuple(number[t] for t in images))
    return tuple(found)


def _after(g: Permutation, h: Permutation) -> Permutation:
    return tuple(g[k] for k in h)


def _times(m: Motion, n: Motion) -> Motion:
    a, b, c, d = m
    e, f, g, h = n
    return (a * e + b * g, a * f + b * h, c * e + d * g, c * f + d * h)


def _powers(g: Permutation) -> list[Permutation]:
    found = [tuple(range(len(g)))]
    while (following := _after(g, found[-1])) != found[0]:
        found.append(following)
    return found


def actions(group: Sequence[Permutation]) -> Iterator[Action]:
    """Yield ways to make some symmetries motions of the plane, at most one node in the middle."""
    one = group[0]
    seen = set()
    for g in group:
        powers = _powers(g)
        order = len(powers)
        if sum(any(h[k] == k for h in powers[1:]) for k in one) > 1:
            continue
        cosine = COSINES[order]
        turn = (cosine, -sqrt(1 - cosine * cosine), sqrt(1 - cosine * cosine), cosine)
        motions = [IDENTITY]
        while len(motions) < order:
            motions.append(_times(turn, motions[-1]))
        rotations = tuple(zip(powers, motions, strict=True))
        for s in group:
            # s = 1 stands for no reflection.
            if s != one and (
                s in powers or _after(s, s) != one or _after(s, _after(g, s)) != powers[-1]
            ):
                continue
            mirrored = tuple((_after(h, s), _times(m, MIRROR)) for h, m in rotations)
            action = Action(rotations + mirrored * (s != one))
            kind = frozenset(p for p, _ in action.motions), order
            if kind not in seen:
                seen.add(kind)
                yield action


def _symmetric(places: Sequence[Place], action: Action) -> list[Place]:
    """Return the mean of all images of a layout."""
    sums = [[0.0, 0.0] for _ in places]
    for permutation, (a, b, c, d) in action.motions:
        for k, (x, y) in zip(permutation, places, strict=True):
            sums[k][0] += a * x + b * y
            sums[k][1] += c * x + d * y
    many = len(action.motions)
    return [(x / many, y / many) for x, y in sums]


def _distances(graph: Decomposition) -> list[list[float]]:
    """Return how many edges nodes are apart; a dashed edge counts more than a plain one."""
    size = graph.size
    far = [[0.0 if a == b else 99.0 for b in range(size)] for a in range(size)]
    for pairs, length in ((graph.dashed, 1.5), (graph.plain, 1.0)):
        for a, b in pairs:
            far[a][b] = far[b][a] = length
    for c in range(size):
        for a in range(size):
            for b in range(size):
                far[a][b] = min(far[a][b], far[a][c] + far[c][b])
    return far


class _Dice:
    """Numbers that look random and are always the same."""

    def __init__(self) -> None:
        self.state = 174

    def roll(self) -> float:
        """Return a number between -1 and 1."""
        self.state = (self.state * 1103515245 + 12345) % (1 << 31)
        return self.state / (1 << 30) - 1


def _spread(
    places: list[Place], far: Sequence[Sequence[float]], action: Action, rounds: int
) -> list[Place]:
    """Return the places after some rounds of majorization: nodes as far apart as edges tell."""
    size = len(places)
    for _ in range(rounds):
        moved = []
        for i, (x, y) in enumerate(places):
            sx = sy = total = 0.0
            for j, (u, v) in enumerate(places):
                if i != j:
                    want = far[i][j]
                    weight = 1 / (want * want)
                    dx, dy = x - u, y - v
                    ratio = want / (sqrt(dx * dx + dy * dy) or 1e-3)
                    sx += weight * (u + ratio * dx)
                    sy += weight * (v + ratio * dy)
                    total += weight
            moved.append((sx / total, sy / total) if size > 1 else (x, y))
        places = _symmetric(moved, action)
    return places


def _side(a: Place, b: Place, c: Place) -> float:
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])


def _cross(a: Place, b: Place, c: Place, d: Place) -> bool:
    return _side(a, b, c) * _side(a, b, d) < 0 and _side(c, d, a) * _side(c, d, b) < 0


NODE_GAP, EDGE_GAP = 0.8, 0.45
"""Wanted distances of nodes from each other and from edges, where an edge has about length 1."""


class _Taste:
    """What is ugly in layouts of one graph."""

    def __init__(self, graph: Decomposition) -> None:
        """Note which lines there are, and which of them could cross."""
        dashed = sorted({*graph.dashed} - {*graph.plain})
        lines = [*((pair, 1.0) for pair in graph.plain), *((pair, 0.6) for pair in dashed)]
        self.lines = [pair for pair, _ in lines]
        self.crossing = [
            (*one, *other, weight * other_weight)
            for (one, weight), (other, other_weight) in combinations(lines, 2)
            if not {*one} & {*other}
        ]
        self.pairs = [*combinations(range(graph.size), 2)]

    def ugliness(self, places: Sequence[Place], limit: float = 1e9) -> float:
        """Return how much there is to complain of; beyond the limit no more is counted.

        Nodes too near to each other, long lines, lines too near to nodes, and crossings.
        """
        total = 0.0
        for a, b in self.pairs:
            gap = off_segment(places[a], places[b], places[b])
            if gap < NODE_GAP:
                total += 12 * (1 - gap / NODE_GAP)
        for a, b in self.lines:
            total += self._line(places, a, b)
            if total >= limit:
                return total
        for a, b, c, d, weight in self.crossing:
            if _cross(places[a], places[b], places[c], places[d]):
                total += weight
        return total

    def _line(self, places: Sequence[Place], a: int, b: int) -> float:
        (x, y), (u, v) = places[a], places[b]
        total = 0.05 * ((x - u) ** 2 + (y - v) ** 2)
        left, right = min(x, u) - EDGE_GAP, max(x, u) + EDGE_GAP
        low, high = min(y, v) - EDGE_GAP, max(y, v) + EDGE_GAP
        for k, place in enumerate(places):
            if left < place[0] < right and low < place[1] < high and k not in {a, b}:
                gap = off_segment(place, (x, y), (u, v))
                if gap < EDGE_GAP:
                    total += 4 * (1 - gap / EDGE_GAP)
        return total


def _improved(
    places: list[Place], taste: _Taste, action: Action, dice: _Dice
) -> tuple[float, list[Place]]:
    """Return a layout after moving nodes, with their images, wherever this makes it nicer."""
    best = taste.ugliness(places)
    for k in range(TRIES):
        step = 1.2 * (1 - k / TRIES) + 0.05
        node = k % len(places)
        moved = list(places)
        x, y = places[node][0] + step * dice.roll(), places[node][1] + step * dice.roll()
        for permutation, (a, b, c, d) in action.motions:
            moved[permutation[node]] = (a * x + b * y, c * x + d * y)
        moved = _symmetric(moved, action)
        cost = taste.ugliness(moved, best)
        if cost < best - 1e-9:
            best, places = cost, moved
    return best, places


STARTS, ROUNDS, TRIES = 10, 30, 150
"""Layouts to begin with, rounds of spreading each, and moves of nodes in the two best."""

WAYS, PRIZE = 6, 0.8
"""How many ways to show symmetry are tried, and what each symmetry shown is worth."""


@cache
def layout(tetrahedra: Tetrahedra) -> tuple[tuple[Place, ...], int]:
    """Return the places of the nodes, and how many symmetries the layout shows."""
    graph = decomposition(tetrahedra)
    far, taste, dice = _distances(graph), _Taste(graph), _Dice()
    found = []
    ways = sorted(actions(permutations_of(tetrahedra)), key=lambda action: -len(action.motions))
    for action in ways[:WAYS]:
        starts = []
        for _ in range(STARTS):
            places = [(dice.roll(), dice.roll()) for _ in range(graph.size)]
            places = _spread(_symmetric(places, action), far, action, ROUNDS)
            starts.append((taste.ugliness(places), places))
        for _, places in sorted(starts)[:2]:
            cost, better = _improved(places, taste, action, dice)
            found.append((cost - PRIZE * len(action.motions), len(action.motions), better))
    _, many, places = min(found)
    return tuple(places), many
