"""Tetrahedra pulled apart on the page until none hides another.

Each is moved as a whole, away from the middle, and then away from those it still touches. Nothing
is turned or stretched. Only where the pieces go is computed with rounded numbers.
"""

from collections.abc import Sequence
from itertools import combinations
from math import sqrt
from typing import TypeAlias

from certify.atlas.draw.picture import Place

Outline: TypeAlias = Sequence[Place]
"""The corners of a piece on the page; all that is asked of them is their hull."""

FIRST = 0.5
"""Pieces begin at so many times their distance from the middle."""

STEP, ROUNDS, LAST = 0.5, 160, 60
"""How much of what lacks is made good in a round; how many rounds, and so many at the end in which
nothing pulls the pieces together."""

PULL = 0.012
"""How much nearer to the middle they are pulled in each round but the last."""


class Pieces:
    """Outlines on the page, and how far each has been moved."""

    def __init__(self, outlines: Sequence[Outline], gap: float) -> None:
        """Begin a little apart."""
        middles = [_middle(outline) for outline in outlines]
        x, y = _middle(middles)
        self.outlines, self.gap = outlines, gap
        self.moves = [(FIRST * (a - x), FIRST * (b - y)) for a, b in middles]
        self.spans = {
            pair: [
                (axis, *(_span(outlines[k], axis) for k in pair)) for axis in _axes(outlines, pair)
            ]
            for pair in combinations(range(len(outlines)), 2)
        }

    def lack(self, pair: tuple[int, int]) -> tuple[float, Place]:
        """Return how much two pieces lack of the gap, and in which direction they lack least."""
        i, j = pair
        (a, b), (c, d) = self.moves[i], self.moves[j]
        dx, dy = c - a, d - b
        least, along = 1e9, (0.0, 0.0)
        for (x, y), (low, high), (low2, high2) in self.spans[pair]:
            shift = x * dx + y * dy
            ahead, behind = high - low2 - shift, high2 - low + shift
            if ahead < least:
                least, along = ahead, (x, y)
            if behind < least:
                least, along = behind, (-x, -y)
            if least <= -self.gap:
                break
        return least + self.gap, along

    def push(self) -> bool:
        """Move pieces that are too near to each other; return whether there were any."""
        found = False
        for pair in self.spans:
            need, (a, b) = self.lack(pair)
            if need > 1e-3 * self.gap:
                found = True
                for piece, sign in zip(pair, (-1, 1), strict=True):
                    step = sign * STEP * min(need, 4 * self.gap)
                    x, y = self.moves[piece]
                    self.moves[piece] = (x + step * a, y + step * b)
        return found

    def pull(self, aspect: float) -> None:
        """Draw all pieces together, more in the direction in which they need more of the page."""
        width, height = self.size()
        wide = min(2.0, max(0.0, width / height / aspect))
        px, py = 1 - PULL * wide, 1 - PULL * (2 - wide)
        self.moves = [(px * x, py * y) for x, y in self.moves]

    def moved(self) -> list[Place]:
        """Return the corners of all pieces where they are now."""
        return [
            (x + dx, y + dy)
            for outline, (dx, dy) in zip(self.outlines, self.moves, strict=True)
            for x, y in outline
        ]

    def size(self) -> Place:
        """Return the width and the height of all pieces together."""
        xs, ys = zip(*self.moved(), strict=True)
        return max(xs) - min(xs), max(ys) - min(ys)


def pulled_apart(outlines: Sequence[Outline], gap: float, aspect: float) -> Pieces:
    """Return the pieces where all keep a gap from each other; aspect: width by height, as wished.

    That no two overlap is certain: at the end all are moved on until it is so.
    """
    pieces = Pieces(outlines, gap)
    for k in range(ROUNDS):
        if not pieces.push() and k > ROUNDS - LAST:
            break
        if k < ROUNDS - LAST:
            pieces.pull(aspect)
    while any(pieces.lack(pair)[0] > gap / 2 for pair in pieces.spans):
        pieces.moves = [(1.02 * x, 1.02 * y) for x, y in pieces.moves]
    return pieces


def _middle(outline: Sequence[Place]) -> Place:
    return sum(x for x, _ in outline) / len(outline), sum(y for _, y in outline) / len(outline)


def _axes(outlines: Sequence[Outline], pair: tuple[int, int]) -> list[Place]:
    """Return the directions across the edges of two outlines: one separates them if any does."""
    found = []
    for k in pair:
        for (a, b), (c, d) in combinations(outlines[k], 2):
            length = sqrt((c - a) ** 2 + (d - b) ** 2)
            if length:
                found.append(((b - d) / length, (c - a) / length))
    return found


def _span(outline: Outline, axis: Place) -> Place:
    heights = [axis[0] * x + axis[1] * y for x, y in outline]
    return min(heights), max(heights)
