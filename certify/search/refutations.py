"""Proofs of unsatisfiability: found by a solver, trimmed to their core, given hints."""

from collections.abc import Sequence
from typing import NamedTuple

from pysat.solvers import Solver

from certify.kernel.orientations import Clause
from certify.propagation import Propagator
from certify.search.enumeration import SOLVER

ROUNDS = 8
"""Proofs that are looked for at most, each in the core of the one before while that shrinks."""


class Step(NamedTuple):
    """A clause, and the numbers of those that yield it by unit propagation, in this order."""

    number: int
    clause: Clause
    hints: tuple[int, ...]


def refute(formula: Sequence[Clause]) -> list[Step] | None:
    """Return a trimmed proof that the formula is unsatisfiable, or None if it is satisfiable.

    Clauses of the formula are numbered from 1, lemmas from there on.
    """
    numbers = list(range(1, len(formula) + 1))
    best: list[Step] | None = None
    for _ in range(ROUNDS):
        lemmas = _solve([formula[number - 1] for number in numbers])
        if lemmas is None:
            return None
        steps = trim([formula[number - 1] for number in numbers], lemmas)
        steps = _renumber(steps, dict(enumerate(numbers, start=1)), len(formula))
        if best is not None and _length(steps) >= _length(best):
            break
        best = steps
        used = {hint for step in steps for hint in step.hints}
        numbers = [number for number in numbers if number in used]
    return best


def model(formula: Sequence[Clause]) -> list[int] | None:
    """Return a satisfying assignment, entry k - 1 being k or -k, or None if there is none."""
    with Solver(SOLVER, bootstrap_with=formula) as solver:
        return list(solver.get_model()) if solver.solve() else None


def lrat(steps: Sequence[Step]) -> str:
    """Return the proof in the LRAT format."""
    return "".join(
        f"{' '.join(map(str, (step.number, *step.clause, 0, *step.hints, 0)))}\n" for step in steps
    )


def trim(formula: Sequence[Clause], lemmas: Sequence[Clause]) -> list[Step]:
    """Return, with hints, the lemmas that the last one needs (Wetzler, Heule and Hunt 2014)."""
    clauses = [*formula, *lemmas]
    propagator = Propagator(clauses)
    needed = {len(clauses)}
    steps = []
    for number in range(len(clauses), len(formula), -1):
        if number in needed:
            hints = propagator.derive(clauses[number - 1], number, needed)
            needed.update(hints)
            steps.append(Step(number, clauses[number - 1], hints))
    return steps[::-1]


def _solve(formula: Sequence[Clause]) -> list[Clause] | None:
    """Return the solver's lemmas, the last one empty, or None if the formula is satisfiable."""
    with Solver(SOLVER, bootstrap_with=formula, with_proof=True) as solver:
        if solver.solve():
            return None
        lines = [line.split() for line in solver.get_proof()]
    lemmas = [tuple(int(word) for word in line[:-1]) for line in lines if line[0] != "d"]
    if () not in lemmas:
        lemmas.append(())
    return lemmas[: lemmas.index(()) + 1]


def _renumber(steps: Sequence[Step], names: dict[int, int], last: int) -> list[Step]:
    """Return the steps with new numbers: ``names`` for the formula's, after ``last`` for lemmas."""
    for name, step in enumerate(steps, start=last + 1):
        names[step.number] = name
    return [
        Step(names[step.number], step.clause, tuple(names[hint] for hint in step.hints))
        for step in steps
    ]


def _length(steps: Sequence[Step]) -> int:
    """Return the number of all hints."""
    return sum(len(step.hints) for step in steps)
