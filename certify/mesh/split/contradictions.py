"""Cells that contradict each other: each can be filled, but not all of them together.

A set of cells is *minimal* if without any one of them the others can be filled. It is *smallest* if
no fewer cells of the mesh contradict each other; that is said only where it is shown, by smallest
hitting sets (Ignatiev, Previti, Liffiton and Marques-Silva 2015, "Smallest MUS extraction with
minimal hitting set dualization"): contradicting cells have one in common with every set of cells
without which the rest can be filled; so if no set with fewer cells than ours has one in common with
each of some such sets, ours is smallest.
"""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass

import numpy as np
from pysat.examples.hitman import Hitman
from pysat.solvers import Solver

from certify.mesh.split.kinds import Rows
from certify.mesh.split.solving import SOLVER, Clause, Words, clauses, formula

MANY = 10
"""So many sets of cells are looked for at most, no two with a common cell."""

LARGE = 5000
"""Cells with clauses; beyond that it is not asked whether a set of more than two is smallest."""

ROUNDS = 200
"""Hitting sets that are tried at most."""


@dataclass(frozen=True)
class Contradiction:
    """Cells that contradict each other. They are minimal.

    cells: in increasing order. quadrilaterals: that of each variable, from 1. formula: clauses that
    say what the cells allow, unsatisfiable. owners: the cell of each clause. smallest: are they
    known to be smallest?
    """

    cells: tuple[int, ...]
    quadrilaterals: tuple[int, ...]
    formula: tuple[Clause, ...]
    owners: tuple[int, ...]
    smallest: bool


def contradictions(slots: Rows, allowed: Words, cells: Iterable[int]) -> list[Contradiction]:
    """Return sets of these cells that contradict each other, no two with a common cell.

    If there are fewer than MANY, the cells that are in none of them do not contradict each other.
    """
    found: list[Contradiction] = []
    with Selecting(slots, allowed, [*cells]) as chosen:
        left = chosen.cells
        while len(found) < MANY and (core := _minimal(chosen, left)):
            core, smallest = (core, len(core) == 2) if found else _smallest(chosen, core)
            found.append(_contradiction(slots, allowed, core, smallest))
            left = [cell for cell in left if cell not in set(core)]
    return found


def _contradiction(
    slots: Rows, allowed: Words, cells: Sequence[int], smallest: bool
) -> Contradiction:
    """Give the quadrilaterals of the cells small numbers, and write the formula."""
    rows = formula(slots[list(cells)], allowed[list(cells)])
    used = sorted({abs(literal) for _, clause in rows for literal in clause})
    number = {old: new for new, old in enumerate(used, start=1)}
    return Contradiction(
        tuple(cells),
        tuple(old - 1 for old in used),
        tuple(
            tuple(number[abs(x)] if x > 0 else -number[abs(x)] for x in clause)
            for _, clause in rows
        ),
        tuple(cells[row] for row, _ in rows),
        smallest,
    )


class Selecting:
    """A solver that is asked about some of the cells. cells: those that have clauses."""

    def __init__(self, slots: Rows, allowed: Words, cells: list[int]) -> None:
        own = np.array(cells, np.int64)
        self._first = int(slots[own].max(initial=0)) + 2
        self._solver = Solver(SOLVER)
        with_clauses: list[int] = []
        for rows, found in clauses(slots[own], allowed[own]):
            selectors = -(own[rows] + self._first)
            self._solver.append_formula(np.column_stack([found, selectors]).tolist())
            with_clauses += own[rows].tolist()
        self.cells = sorted(set(with_clauses))
        self._solver.set_phases([cell + self._first for cell in self.cells])

    def __enter__(self) -> "Selecting":
        return self

    def __exit__(self, *_: object) -> None:
        self._solver.delete()

    def core(self, cells: Iterable[int]) -> list[int] | None:
        """Return which of these cells contradict each other, or None if they do not."""
        if self._solver.solve(assumptions=[cell + self._first for cell in cells]):
            return None
        return sorted(literal - self._first for literal in self._solver.get_core())

    def fulfilled(self) -> set[int]:
        """Return the cells that the last answer fills, all at least that were asked for."""
        model = self._solver.get_model()
        return {cell for cell in self.cells if model[cell + self._first - 1] > 0}


def _minimal(chosen: Selecting, cells: Sequence[int]) -> list[int] | None:
    """Return a minimal set of these cells that contradict each other, or None if they do not."""
    core = chosen.core(cells)
    if core is None:
        return None
    while (smaller := chosen.core(core)) is not None and len(smaller) < len(core):
        core = smaller
    needed: list[int] = []
    while core:
        cell = core.pop()
        rest = chosen.core(needed + core)
        if rest is None:
            needed.append(cell)
        else:
            core = [own for own in core if own in set(rest)]
    return sorted(needed)


def _smallest(chosen: Selecting, core: list[int]) -> tuple[list[int], bool]:
    """Return a set that is no larger, and whether it is smallest. No cell contradicts itself."""
    if len(core) <= 2:
        return core, True
    if len(chosen.cells) > LARGE:
        return core, False
    with Hitman(solver=SOLVER, htype="sorted") as hitting:
        for _ in range(ROUNDS):
            tried = hitting.get()
            if len(tried) >= len(core):
                return core, True
            if chosen.core(tried) is not None:
                return sorted(tried), True
            hitting.hit(_left_out(chosen))
    return core, False


def _left_out(chosen: Selecting) -> list[int]:
    """Return cells without which the rest can be filled, all of them needed for that."""
    kept = chosen.fulfilled()
    out = []
    for cell in chosen.cells:
        if cell not in kept:
            if chosen.core([*kept, cell]) is None:
                kept |= chosen.fulfilled()
            else:
                out.append(cell)
    return out
