"""Unit propagation outside the kernel: for trimming proofs, and for failed literals."""

from collections import defaultdict
from collections.abc import Collection, Iterable

from certify.kernel.orientations import Clause


class Propagator:
    """Unit propagation with two watched literals over clauses numbered from 1."""

    def __init__(self, clauses: Iterable[Clause]) -> None:
        self.clauses: list[list[int]] = [[]]
        self.units: list[int] = []
        self.watching: defaultdict[int, list[int]] = defaultdict(list)
        for clause in clauses:
            self.add(clause)

    def add(self, clause: Clause) -> None:
        """Add one more clause, with the next number."""
        number = len(self.clauses)
        self.clauses.append(list(clause))
        if len(clause) == 1:
            self.units.append(number)
        for literal in clause[:2]:
            self.watching[literal].append(number)

    def implies(self, clause: Clause) -> bool:
        """Does the clause follow from all the others by unit propagation?"""
        try:
            self.derive(clause, len(self.clauses), ())
        except ValueError:
            return False
        return True

    def derive(self, clause: Clause, before: int, preferred: Collection[int]) -> tuple[int, ...]:
        """Return numbers below ``before`` that propagate the negated clause to a contradiction.

        Preferred clauses are propagated first, so that lemmas share as much as they can.

        Raises:
            ValueError: The clause does not follow by unit propagation.
        """
        reason = {-literal: 0 for literal in clause}
        trail = list(reason)
        for number in sorted(self.units, key=lambda unit: unit not in preferred):
            literal = self.clauses[number][0]
            if number < before and -literal in reason:
                return self._explain(number, reason, trail)
            if number < before and literal not in reason:
                reason[literal] = number
                trail.append(literal)
        conflict = self._propagate(reason, trail, before, preferred)
        return self._explain(conflict, reason, trail)

    def _propagate(
        self, reason: dict[int, int], trail: list[int], before: int, preferred: Collection[int]
    ) -> int:
        """Return the number of the first clause to become false as the trail is extended."""
        head = {True: 0, False: 0}
        while head[False] < len(trail):
            core = head[True] < len(trail)
            false = -trail[head[core]]
            head[core] += 1
            for number in list(self.watching[false]):
                if number >= before or (number in preferred) != core:
                    continue
                clause = self.clauses[number]
                if clause[0] == false:
                    clause[0], clause[1] = clause[1], clause[0]
                other = clause[0]
                for i in range(2, len(clause)):
                    if -clause[i] not in reason:
                        clause[1], clause[i] = clause[i], clause[1]
                        self.watching[false].remove(number)
                        self.watching[clause[1]].append(number)
                        break
                else:
                    if -other in reason:
                        return number
                    if other not in reason:
                        reason[other] = number
                        trail.append(other)
        raise ValueError("the clause does not follow by unit propagation")

    def _explain(self, conflict: int, reason: dict[int, int], trail: list[int]) -> tuple[int, ...]:
        """Return the reasons that the conflict needs, in the order of propagation."""
        needed = {-literal for literal in self.clauses[conflict]}
        hints = [conflict]
        for literal in reversed(trail):
            if literal in needed and reason[literal]:
                hints.append(reason[literal])
                needed.update(-other for other in self.clauses[reason[literal]])
        return tuple(reversed(hints))
