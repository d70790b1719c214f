"""One diagonal for each quadrilateral, so that every cell can be filled: a SAT problem.

Variable q + 1 stands for quadrilateral q, counted from 0: it is true iff the quadrilateral is cut
through its least vertex. A clause excludes the numbers of a cell that have certain bits: a *cube*.
Those of a cell are prime cubes of excluded numbers, none of which can be widened; they are taken
greedily, the widest first, until all excluded numbers are covered, and those that the others cover
are left out again. So no clause and no literal can be left out.

Any solution will do for a yes. Which one is found matters to the angles alone:

- ``none``: whatever the solver comes across.
- ``greedy``: the solver starts from the diagonal that looks better from both sides; then, as long
  as that helps, each cell takes that of its numbers with which the least angle of it and of its
  neighbours is largest. The result is no optimum.
- ``best``: in addition, the least angle of the whole mesh is the largest that any split reaches,
  compared as floating-point numbers. Thresholds are tried by halving, each by the solver.
"""

from collections.abc import Callable, Iterator
from functools import lru_cache
from typing import Any, TypeAlias

import numpy as np
from numpy.typing import NDArray
from pysat.solvers import Solver

from certify.mesh.compiled import compiled
from certify.mesh.realized import Booleans
from certify.mesh.split.faces import SLOTS
from certify.mesh.split.kinds import Rows

Words: TypeAlias = NDArray[np.uint64]
Clause: TypeAlias = tuple[int, ...]
SOLVER = "glucose4"
QUALITIES = ("greedy", "best", "none")

Qualities: TypeAlias = NDArray[np.float32]
Show: TypeAlias = Callable[[str, int, int], None]

PASSES = 20
"""How often the cells are gone through at most."""

ENOUGH = 1e-4
"""Degrees; an improvement by less is none. So the improvements come to an end."""

_NUMBERS = np.arange(2**SLOTS)


_EVERY = 2**SLOTS


def whole(slots: Rows) -> Words:
    """Return for each cell the word in which every number that it can have is allowed."""
    used = (slots >= 0).sum(axis=1).astype(np.uint64)
    numbers = np.uint64(1) << used  # 64 at most
    ones = np.uint64(2**64 - 1)
    out: Words = np.where(numbers == _EVERY, ones, (np.uint64(1) << (numbers % _EVERY)) - 1)
    return out


@lru_cache(maxsize=1)
def _cubes() -> tuple[NDArray[np.int64], Words, NDArray[np.int64]]:
    """Return all cubes, the widest first.

    As (729, 2) numbers, which bits are fixed, and to what; as words, the numbers that have these
    bits; and the cubes (729, 6) that are wider by one bit, -1 where that bit is free already.
    """
    cubes = [
        (care, value) for care in range(_EVERY) for value in range(_EVERY) if not value & ~care
    ]
    cubes.sort(key=lambda cube: (cube[0].bit_count(), cube))
    place = {cube: index for index, cube in enumerate(cubes)}
    words = [sum(1 << n for n in range(_EVERY) if n & care == value) for care, value in cubes]
    wider = [
        [place[care & ~bit, value & ~bit] if care & bit else -1 for bit in _BITS]
        for care, value in cubes
    ]
    return np.array(cubes, np.int64), np.array(words, np.uint64), np.array(wider, np.int64)


_BITS = [1 << slot for slot in range(SLOTS)]


@compiled
def _cover(excluded: Words, words: Words, wider: Rows, out: Rows) -> None:
    """Put for each word the cubes that cover it exactly, and then -1, into a row of ``out``."""
    prime = np.empty(len(words), np.int64)
    inside = np.zeros(len(words), np.bool_)
    for index in range(len(excluded)):
        word = excluded[index]
        primes = 0
        for cube in range(len(words)):
            inside[cube] = words[cube] & ~word == 0
            if inside[cube]:
                widest = True
                for other in wider[cube]:
                    if other >= 0 and inside[other]:
                        widest = False
                if widest:
                    prime[primes] = cube
                    primes += 1
        left, taken = word, 0
        while left != 0:
            best, most = -1, 0
            for p in range(primes):
                gain, rest = 0, words[prime[p]] & left
                while rest != 0:
                    rest &= rest - np.uint64(1)
                    gain += 1
                if gain > most:
                    best, most = prime[p], gain
            out[index, taken] = best
            taken += 1
            left &= ~words[best]
        kept = 0
        for place in range(taken):
            others = np.uint64(0)
            for other in range(taken):
                if other < kept or other > place:
                    others |= words[out[index, other]]
            if words[out[index, place]] & ~others != 0:
                out[index, kept] = out[index, place]
                kept += 1
        out[index, kept:] = -1


def clauses(slots: Rows, allowed: Words) -> Iterator[tuple[Rows, Rows]]:
    """Yield cells and a clause for each of them, an array (n, k) of literals, k from 0 to 6.

    Clauses of one length come together. A cell comes as often as it has clauses.
    """
    used = whole(slots)
    every = np.uint64(2**64 - 1) // used  # the bits of no quadrilateral do not matter
    excluded, number = np.unique((used & ~allowed) * every, return_inverse=True)
    cubes, words, wider = _cubes()
    found = np.empty((len(excluded), _EVERY), np.int64)
    _cover(excluded, words, wider, found)
    for care in range(_EVERY):
        bits = [bit for bit in range(SLOTS) if care >> bit & 1]
        for value in np.flatnonzero(cubes[:, 0] == care):
            has = (found == value).any(axis=1)
            if has.any():
                cells = np.flatnonzero(has[number])
                signs = np.array([1 if cubes[value, 1] >> bit & 1 else -1 for bit in bits], int)
                # Bit 0 is the variable true: excluded is 0, so the literal is negative.
                yield cells, (slots[cells][:, bits] + 1) * signs


def formula(slots: Rows, allowed: Words) -> list[tuple[int, Clause]]:
    """Return the clauses of a few cells, each with the index of its cell, cell by cell."""
    rows = [
        (cell, tuple(clause))
        for cells, found in clauses(slots, allowed)
        for cell, clause in zip(cells.tolist(), found.tolist(), strict=True)
    ]
    return sorted(rows, key=lambda row: (row[0], len(row[1]), row[1]))


def solve(slots: Rows, allowed: Words, total: int, start: Booleans | None = None) -> Any:
    """Return which quadrilaterals are cut through their least vertex, or None if it cannot be.

    Args:
        slots: The quadrilaterals of each cell, (n, 6).
        allowed: The numbers of each cell.
        total: How many quadrilaterals there are.
        start: What the solver tries first.
    """
    with Solver(SOLVER) as solver:
        for _, found in clauses(slots, allowed):
            if not found.shape[1]:
                return None
            solver.append_formula(found.tolist(), no_return=True)
        variables = np.arange(1, total + 1)
        if start is not None:
            solver.set_phases(np.where(start, variables, -variables).tolist())
        if not solver.solve():
            return None
        model = np.array(solver.get_model(), np.int64)
    cut = np.ones(total, np.bool_) if start is None else start.copy()
    model = model[np.abs(model) <= total]
    cut[np.abs(model) - 1] = model > 0
    return cut


def numbers_of(slots: Rows, cut: Booleans) -> Rows:
    """Return the number of each cell."""
    bits = ~np.append(cut, True)[slots]  # the one that NONE leads to is the last
    out: Rows = (bits.astype(np.int64) << np.arange(SLOTS)).sum(axis=1)
    return out


def solved(
    slots: Rows,
    sides: Rows,
    allowed: Words,
    qualities: Qualities,
    quality: str,
    show: Show | None = None,
) -> Any:
    """Return as solve does, with a solution as good as ``quality`` says."""
    if quality == "none":
        return solve(slots, allowed, len(sides))
    cut = solve(slots, allowed, len(sides), preferred(slots, allowed, qualities, len(sides)))
    if cut is None:
        return None
    cut = improved(slots, sides, allowed, qualities, cut)
    if quality == "best":
        cut = _bottleneck(slots, sides, allowed, qualities, cut, show)
    return cut


def preferred(slots: Rows, allowed: Words, qualities: Qualities, total: int) -> Booleans:
    """Return for each quadrilateral whether a cut through its least vertex promises more.

    That is: the worse of its two cells could have a larger least angle with it.
    """
    best = np.full((2, total), np.inf, np.float32)
    valued = np.where(_may(allowed), qualities, np.float32(-1))
    for slot in range(SLOTS):
        own = np.flatnonzero(slots[:, slot] >= 0)
        for bit in range(2):
            most = valued[own][:, _NUMBERS >> slot & 1 == bit].max(axis=1)
            np.minimum.at(best[bit], slots[own, slot], most)
    out: Booleans = best[0] >= best[1]
    return out


def _may(allowed: Words) -> Booleans:
    """Return which numbers are allowed: (n, 64)."""
    out: Booleans = (allowed[:, None] >> _NUMBERS.astype(np.uint64)) & np.uint64(1) == 1
    return out


def improved(
    slots: Rows, sides: Rows, allowed: Words, qualities: Qualities, cut: Booleans
) -> Booleans:
    """Return a solution that is nowhere worse, as good as changing one cell at a time gets."""
    numbers = numbers_of(slots, cut)
    _improve(slots, sides, allowed, qualities, numbers)
    out, own = cut.copy(), slots >= 0
    out[slots[own]] = ((numbers[:, None] >> np.arange(SLOTS)) & 1 == 0)[own]
    return out


@compiled
def _improve(slots: Rows, sides: Rows, allowed: Words, qualities: Qualities, numbers: Rows) -> None:
    """Change the numbers of cells, with those of their neighbours, while that helps."""
    involved, flips = np.empty(SLOTS + 1, np.int64), np.empty(SLOTS + 1, np.int64)
    active = np.ones(len(slots), np.bool_)
    for _ in range(PASSES):
        changed = False
        for h in range(len(slots)):
            if not active[h]:
                continue
            active[h] = False
            best, best_least, best_sum = 0, np.float32(0), np.float32(0)
            for flip in range(1, 2**SLOTS):
                count = _flipped(slots, sides, h, flip, involved, flips)
                least_now, least_then = np.float32(180), np.float32(180)
                sum_now, sum_then = np.float32(0), np.float32(0)
                for i in range(count):
                    cell, now = involved[i], numbers[involved[i]]
                    then = now ^ flips[i]
                    if not allowed[cell] >> np.uint64(then) & np.uint64(1):
                        count = 0
                        break
                    least_now = min(least_now, qualities[cell, now])
                    least_then = min(least_then, qualities[cell, then])
                    sum_now += qualities[cell, now]
                    sum_then += qualities[cell, then]
                gain, more = least_then - least_now, sum_then - sum_now
                helps = gain > ENOUGH or (gain >= 0 and more > ENOUGH)
                most = gain > best_least or (gain == best_least and more > best_sum)
                if count and helps and most:
                    best, best_least, best_sum = flip, gain, more
            if best:
                changed = True
                count = _flipped(slots, sides, h, best, involved, flips)
                for i in range(count):
                    numbers[involved[i]] ^= flips[i]
                    active[involved[i]] = True
                    for slot in range(SLOTS):
                        if slots[involved[i], slot] >= 0:
                            for other in sides[slots[involved[i], slot]]:
                                if other >= 0:
                                    active[other] = True
        if not changed:
            break


@compiled
def _flipped(slots: Rows, sides: Rows, cell: int, flip: int, involved: Rows, flips: Rows) -> int:
    """List the cells that have a part in cutting some quadrilaterals of a cell the other way.

    flip: these, as bits. Returns how many cells there are, 0 if it has no such quadrilateral.
    """
    involved[0], flips[0] = cell, flip
    count = 1
    for slot in range(SLOTS):
        if not flip >> slot & 1:
            continue
        quad = slots[cell, slot]
        if quad < 0:
            return 0
        other = sides[quad, 0] if sides[quad, 0] != cell else sides[quad, 1]
        if other < 0:
            continue
        bit = 0
        for own in range(SLOTS):
            if slots[other, own] == quad:
                bit = 1 << own
        place = 0
        for i in range(1, count):
            if involved[i] == other:
                place = i
        if place:
            flips[place] |= bit
        else:
            involved[count], flips[count] = other, bit
            count += 1
    return count


def _bottleneck(
    slots: Rows,
    sides: Rows,
    allowed: Words,
    qualities: Qualities,
    cut: Booleans,
    show: Show | None,
) -> Booleans:
    """Return a solution whose least angle is the largest."""
    cells = np.flatnonzero(slots[:, 0] >= 0)
    if not len(cells):
        return cut
    may = _may(allowed)
    most = np.where(may, qualities, np.float32(-1))[cells].max(axis=1).min()
    least = qualities[cells, numbers_of(slots, cut)[cells]].min()
    values = np.unique(qualities[may & (qualities > least) & (qualities <= most)])
    low, high, tried = 0, len(values), 0  # values[:low] are reached, values[high:] are not
    rounds = int(high).bit_length() + 1
    while low < high:
        middle = high - 1 if not tried else (low + high) // 2  # the largest is often reached
        fine = np.where(qualities >= values[middle], np.uint64(1), np.uint64(0))
        enough = allowed & (fine << _NUMBERS.astype(np.uint64)).sum(axis=1, dtype=np.uint64)
        enough = np.where(slots[:, 0] >= 0, enough, allowed)
        found = solve(slots, enough, len(sides), cut)
        tried += 1
        if show:
            show("trying least angles", min(tried, rounds), rounds)
        if found is None:
            high = middle
        else:
            cut, low = improved(slots, sides, enough, qualities, found), middle + 1
    return cut
