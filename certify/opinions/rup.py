"""Proofs by unit propagation (RUP) checked without their hints.

A lemma follows from clauses if their unit propagation, begun with the negation of the lemma, comes
to a contradiction (Goldberg and Novikov, DATE 2003). The kernel replays the hints in their order;
here they only say which clauses of the formula are needed, and all of these are propagated.
"""

from collections import defaultdict
from collections.abc import Collection, Iterable, Sequence

from certify.opinions.formulas import Clause


def proof_fault(
    formula: Sequence[Iterable[int]], again: Collection[Clause], proof: str
) -> str | None:
    """Return which lemma does not follow by unit propagation, or None if the proof is one.

    Of the formula only the clauses that occur as hints are used, and each of them must occur in the
    formula as written ``again``; the order of the hints is not used.
    """
    steps = [words for line in proof.splitlines() if (words := line.split())[1] != "d"]
    used = {int(word) for words in steps for word in words[words.index("0") + 1 : -1]}
    propagation = _Propagation()
    for number in sorted(number for number in used if number <= len(formula)):
        if frozenset(formula[number - 1]) not in again:
            return f"clause {number} does not belong to the formula"
        propagation.add(formula[number - 1])
    for words in steps:
        lemma = tuple(map(int, words[1 : words.index("0")]))
        if not propagation.refutes([-literal for literal in lemma]):
            return f"lemma {words[0]} does not follow by unit propagation"
        if not lemma:
            return None
        propagation.add(lemma)
    return "the proof does not reach the empty clause"


class _Propagation:
    """Unit propagation to the end, with two watched literals in each clause."""

    def __init__(self) -> None:
        self.true: set[int] = set()
        """The literals that the clauses alone make true."""
        self.absurd = False
        self.watching: defaultdict[int, list[list[int]]] = defaultdict(list)

    def add(self, clause: Iterable[int]) -> None:
        """Add a clause, and propagate if it is a unit by now."""
        literals = set(clause)
        if literals & self.true or any(-literal in literals for literal in literals):
            return
        free = sorted(literal for literal in literals if -literal not in self.true)
        if len(free) > 1:
            self.watching[free[0]].append(free)
            self.watching[free[1]].append(free)
        else:
            self.absurd = self.absurd or not free or self._conflict(self.true, free)

    def refutes(self, assumed: list[int]) -> bool:
        """Do the assumed literals propagate to a contradiction?"""
        return self.absurd or self._conflict(set(self.true), assumed)

    def _conflict(self, true: set[int], pending: list[int]) -> bool:
        pending = list(pending)
        while pending:
            literal = pending.pop()
            if -literal in true:
                return True
            if literal not in true:
                true.add(literal)
                self._visit(-literal, true, pending)
        return False

    def _visit(self, false: int, true: set[int], pending: list[int]) -> None:
        """Let every clause that watches a false literal watch another one, or be a unit."""
        kept = []
        for clause in self.watching[false]:
            if clause[0] == false:
                clause[0], clause[1] = clause[1], clause[0]
            for i in range(2, len(clause)):
                if -clause[i] not in true:
                    clause[1], clause[i] = clause[i], clause[1]
                    self.watching[clause[1]].append(clause)
                    break
            else:
                kept.append(clause)
                pending.append(clause[0])
        self.watching[false] = kept
