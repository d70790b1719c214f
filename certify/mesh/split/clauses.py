"""The choices of a cell as few short clauses.

Variable q + 1 stands for quadrilateral q, counted from 0: it is true iff the quadrilateral is cut
through its least vertex. A clause excludes the numbers of a cell that have certain bits: a *cube*.
Those of a cell are prime cubes of excluded numbers, none of which can be widened; they are taken
greedily, the widest first, until all excluded numbers are covered, and those that the others cover
are left out again. So no clause and no literal can be left out.
"""

from collections.abc import Iterator
from functools import lru_cache
from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray

from certify.mesh.compiled import compiled
from certify.mesh.split.faces import SLOTS
from certify.mesh.split.kinds import Rows

Words: TypeAlias = NDArray[np.uint64]
Clause: TypeAlias = tuple[int, ...]

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
    excluded, number = np.unique(whole(slots) & ~allowed, return_inverse=True)
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


def formula(slots: Rows, allowed: Words) -> list[Clause]:
    """Return the clauses of a few cells, cell by cell."""
    rows = [
        (cell, tuple(clause))
        for cells, found in clauses(slots, allowed)
        for cell, clause in zip(cells.tolist(), found.tolist(), strict=True)
    ]
    return [clause for _, clause in sorted(rows, key=lambda row: (row[0], len(row[1]), row[1]))]
