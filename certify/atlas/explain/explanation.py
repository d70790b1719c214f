"""A refutation as steps that a person can follow, each of them replayed by the kernel.

An *outline* says only in which order to look where: "relation 12|3456, for 1256", or "suppose
1357 > 0, and then ...". Following it yields the facts, the earlier facts that each of them needs,
and lemmas in the LRAT format. An :class:`Explanation` exists only if the kernel has accepted these
lemmas as a proof against its own formula.
"""

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from itertools import count
from typing import Any, TypeAlias

from certify.atlas.explain.reasons import (
    ANY,
    Reason,
    Reasons,
    Signs,
    literals_for,
    opposite,
    quadruple_of,
    signs_of,
)
from certify.kernel.hexahedron import SYMMETRIES, Simplex, sorted_with_sign
from certify.kernel.orientations import Clause, has_sign
from certify.kernel.refutation import replay
from certify.propagation import Propagator

Outline: TypeAlias = list[Any]
"""Entries [reason, quadruple], or {"suppose": [quadruple, signs], "then": outline, "also": [...]}.

"also" lists relabellings, as eight digits, under which the same supposition fails as well.
"""


class BadOutline(ValueError):
    """An outline does not explain the refutation; the message says where."""


@dataclass(frozen=True)
class Fact:
    """A determinant, and the signs that it may still have."""

    determinant: Simplex
    signs: Signs


@dataclass(frozen=True)
class Step:
    """A fact, the reason for it, and the facts it needs (by number; 0 for what is given)."""

    number: int
    fact: Fact
    reason: Reason
    before: Mapping[Simplex, Signs]
    """What is used: determinant of the reason -> signs that were known."""
    uses: tuple[int, ...]
    """The steps that showed this: 0 for what is given, -k for the k-th open supposition."""
    excluded: Signs
    """The signs that the determinant might still have had, and has not."""
    clauses: tuple[int, ...]
    """The numbers of the formula's clauses that the kernel is told to use."""


@dataclass(frozen=True)
class Case:
    """A supposition that leads to a contradiction, and the fact that this shows."""

    number: int
    fact: Fact
    supposed: Fact
    steps: tuple["Item", ...]


@dataclass(frozen=True)
class Mirror:
    """A fact that a symmetry of the pattern makes of another case's."""

    number: int
    fact: Fact
    of: int
    symmetry: tuple[int, ...]


Item: TypeAlias = Step | Case | Mirror


@dataclass(frozen=True)
class Explanation:
    """A refutation that the kernel has replayed in these steps."""

    given: Mapping[Simplex, Signs]
    """The signs that are used among those that the pattern and the question give."""
    steps: tuple[Item, ...]
    lrat: str = field(repr=False)

    def items(self) -> Iterator[Item]:
        """Yield all steps in the order in which they are read."""
        yield from _flat(self.steps)

    def used(self) -> set[int]:
        """Return the numbers of the steps that others need, with that of the contradiction."""
        items = [*self.items()]
        used = {items[-1].number}
        for item in items:
            match item:
                case Step():
                    used.update(item.uses)
                case Case():
                    used.add(item.steps[-1].number)
                case Mirror():
                    used.add(item.of)
        return used


def _flat(items: Iterable[Item]) -> Iterator[Item]:
    for item in items:
        if isinstance(item, Case):
            yield from _flat(item.steps)
        yield item


@dataclass
class _Known:
    """What is known in one scope: the suppositions, and what each determinant has been shown."""

    supposed: tuple[int, ...]
    history: dict[Simplex, list[tuple[Signs, int]]]
    """Determinant -> (signs, number of the step), each more narrow than the one before."""

    def signs(self, quadruple: Simplex) -> Signs:
        history = self.history.get(quadruple)
        return history[-1][0] if history else ANY

    def add(self, fact: Fact, number: int) -> None:
        self.history.setdefault(fact.determinant, []).append((fact.signs, number))

    def within(self, literal: int) -> "_Known":
        copied = {quadruple: [*history] for quadruple, history in self.history.items()}
        return _Known((*self.supposed, literal), copied)


class _Follower:
    """Follows an outline, and writes lemmas."""

    def __init__(self, reasons: Reasons) -> None:
        self.reasons = reasons
        self.lemmas: list[tuple[Clause, tuple[int, ...]]] = []
        self.of_step: dict[int, list[int]] = {}
        """Number of a step -> the numbers of the clauses that say what it shows."""
        self.number = 0
        self.used: dict[Simplex, Signs] = {}
        self._numbers: dict[frozenset[int], int] = {}

    def follow(self, outline: Outline, known: _Known) -> tuple[Item, ...]:
        """Return the steps of an outline, the last of which is a contradiction."""
        items: list[Item] = []
        for entry in outline:
            if isinstance(entry, dict):
                items += self._case(entry, known)
            else:
                items.append(self._step(entry, known))
        if not items or items[-1].fact.signs:
            raise BadOutline("it ends without a contradiction")
        return tuple(items)

    # One step.

    def _step(self, entry: Sequence[str], known: _Known) -> Step:
        name, digits = entry
        reason = self.reasons.reasons.get(name)
        target = tuple(map(int, digits))
        if reason is None or target not in reason.determinants:
            raise BadOutline(f"no reason {name} for {digits}")
        place = reason.determinants.index(target)
        now = tuple(known.signs(q) for q in reason.determinants)
        signs = reason.conclude(now)[place] & now[place]
        if signs == now[place]:
            raise BadOutline(f"{name} says nothing new about {digits}")
        before, uses = self._needed(reason, place, signs, known)
        fact = Fact(target, signs)
        self.number += 1
        clauses = self._show(self.number, fact, reason, before, uses, known)
        known.add(fact, self.number)
        return Step(self.number, fact, reason, before, uses, now[place] & ~signs, clauses)

    def _needed(
        self, reason: Reason, place: int, signs: Signs, known: _Known
    ) -> tuple[dict[Simplex, Signs], tuple[int, ...]]:
        """Return the least that has to be known, and the steps that showed it."""
        choices: list[list[tuple[Signs, int | None]]] = [
            [(ANY, None), *known.history.get(q, ())] for q in reason.determinants
        ]
        chosen = [len(options) - 1 for options in choices]

        def enough() -> bool:
            now = tuple(options[k][0] for options, k in zip(choices, chosen, strict=True))
            return reason.conclude(now)[place] & now[place] == signs

        def latest(i: int) -> int:
            return choices[i][chosen[i]][1] or 0

        for i in sorted(range(len(choices)), key=latest, reverse=True):
            if reason.kind == "circuit" and latest(i) == 0:
                continue  # with all that is given the picture is clearer
            best = chosen[i]
            for chosen[i] in range(best + 1):
                if enough():
                    break
        before, uses = {}, []
        for q, options, k in zip(reason.determinants, choices, chosen, strict=True):
            seen, number = options[k]
            if number is not None:
                before[q] = seen
                uses.append(number)
            if number == 0:
                self.used[q] = seen
        return before, tuple(sorted(set(uses)))

    # Cases.

    def _case(self, entry: Mapping[str, Any], known: _Known) -> Iterator[Item]:
        digits, signs = entry["suppose"]
        target = tuple(map(int, digits))
        literal = self._literal(target, signs, known)
        inner = known.within(literal)
        depth = -len(inner.supposed)  # stands for the number of a step
        supposed = Fact(target, known.signs(target) & signs)
        self.of_step[depth] = self._shown(target, known)
        inner.add(supposed, depth)
        steps = self.follow(entry["then"], inner)
        self.number += 1
        case = Case(self.number, Fact(target, known.signs(target) & ~signs), supposed, steps)
        # The contradiction at the end of a case is itself the lemma that it cannot be.
        (lemma,) = self.of_step[steps[-1].number]
        self._add(case, lemma, known)
        yield case
        for digits in entry.get("also", ()):
            if known.supposed:
                raise BadOutline("a symmetry is used inside a case")
            yield self._mirror(case, literal, lemma, tuple(map(int, digits)), known)

    def _shown(self, quadruple: Simplex, known: _Known) -> list[int]:
        """Return the clauses that say what is known of a determinant, beyond what is given."""
        history = known.history.get(quadruple)
        return self.of_step.get(history[-1][1], []) if history else []

    def _add(self, item: Item, lemma: int, known: _Known) -> None:
        """Note what follows from a lemma that excludes some signs, and from what was known."""
        self.of_step[item.number] = [lemma, *self._shown(item.fact.determinant, known)]
        known.add(item.fact, item.number)

    def _literal(self, target: Simplex, signs: Signs, known: _Known) -> int:
        """Return the literal that says, of what is known, that only these signs are left."""
        for sign in (1, -1):
            for literal in (has_sign(target, sign), -has_sign(target, sign)):
                if signs_of(literal) & known.signs(target) == signs & known.signs(target):
                    return literal
        raise BadOutline(f"no case is {signs} for {target}")

    def _mirror(
        self, case: Case, literal: int, lemma: int, symmetry: tuple[int, ...], known: _Known
    ) -> Mirror:
        """The same supposition fails with other names for the vertices, for the same reasons."""
        relabelled = self._relabelling(symmetry)
        copies: dict[int, int] = {}
        for number in self._needed_for(lemma):
            clause, hints = self.lemmas[number - len(self.reasons.formula) - 1]
            mapped = tuple(map(relabelled, clause))
            copies[number] = self._write(
                mapped, tuple(copies.get(hint) or self._image(hint, relabelled) for hint in hints)
            )
        self.number += 1
        other = relabelled(literal)
        target = quadruple_of(other)
        fact = Fact(target, known.signs(target) & ~signs_of(other))
        mirror = Mirror(self.number, fact, case.number, symmetry)
        self._add(mirror, copies[lemma], known)
        return mirror

    def _relabelling(self, symmetry: tuple[int, ...]) -> Callable[[int], int]:
        """Return what a symmetry makes of a literal; it may mirror all points."""
        if symmetry not in SYMMETRIES:
            raise BadOutline("it names what is no symmetry of the cube")
        quadruple, (signs, _) = next(iter(self.reasons.given.items()))
        mapped, parity = sorted_with_sign(tuple(symmetry[v - 1] for v in quadruple))
        seen = self.reasons.given.get(mapped, (ANY, 0))[0]
        mirror = 1 if seen == (signs if parity > 0 else opposite(signs)) else -1

        def relabelled(literal: int) -> int:
            vertices = tuple(symmetry[v - 1] for v in quadruple_of(literal))
            mapped, parity = sorted_with_sign(vertices)
            sign = (1 if abs(literal) % 2 else -1) * parity * mirror
            return has_sign(mapped, sign) if literal > 0 else -has_sign(mapped, sign)

        return relabelled

    def _image(self, number: int, relabelled: Callable[[int], int]) -> int:
        """Return the number of what a relabelling makes of a clause of the formula."""
        if not self._numbers:
            formula = enumerate(self.reasons.formula, start=1)
            self._numbers = {frozenset(clause): k for k, clause in formula}
        clause = frozenset(map(relabelled, self.reasons.formula[number - 1]))
        if clause not in self._numbers:
            raise BadOutline("it names what is no symmetry of the pattern")
        return self._numbers[clause]

    def _needed_for(self, lemma: int) -> list[int]:
        """Return the numbers of the lemmas on which one rests, in their order."""
        size = len(self.reasons.formula)
        needed = {lemma}
        for number in range(lemma, size, -1):
            if number in needed:
                needed.update(h for h in self.lemmas[number - size - 1][1] if h > size)
        return sorted(needed)

    # Lemmas.

    def _show(
        self,
        number: int,
        fact: Fact,
        reason: Reason,
        before: Mapping[Simplex, Signs],
        uses: Iterable[int],
        known: _Known,
    ) -> tuple[int, ...]:
        """Write lemmas that the fact follows from the clauses of the reason and the facts used.

        Return which clauses of the formula they name.
        """
        reasons = self.reasons
        numbers = [reasons.exclusive[quadruple] for quadruple in reason.determinants]
        numbers += reason.clauses
        numbers += [shown for used in uses for shown in self.of_step.get(used, ())]
        numbers += [reasons.given[q][1] for q in before if q in reasons.given]
        clauses = [*map(self._clause, numbers)]
        escape = tuple(-literal for literal in known.supposed)
        written = len(self.lemmas)
        self.of_step[number] = [
            self._lemma((*clause, *(e for e in escape if e not in clause)), clauses)
            for clause in literals_for(fact.determinant, fact.signs)
            if not set(clause).intersection(known.supposed)  # else it was just supposed
        ]
        named = {hint for _, hints in self.lemmas[written:] for hint in hints}
        return tuple(sorted(hint for hint in named if hint <= len(reasons.formula)))

    def _clause(self, number: int) -> tuple[int, Clause]:
        size = len(self.reasons.formula)
        if number <= size:
            return number, self.reasons.formula[number - 1]
        return number, self.lemmas[number - size - 1][0]

    def _lemma(self, clause: Clause, clauses: list[tuple[int, Clause]]) -> int:
        """Write a clause that others imply, and what it takes to see it; return its number."""
        propagator = Propagator(own for _, own in clauses)
        try:
            hints = propagator.derive(clause, len(clauses) + 1, ())
        except ValueError:
            variable = self._undecided(clause, clauses)
            for literal in (variable, -variable):
                extended = (*clause, literal)
                clauses = [*clauses, (self._lemma(extended, clauses), extended)]
            return self._lemma(clause, clauses)
        return self._write(clause, tuple(clauses[hint - 1][0] for hint in hints))

    def _undecided(self, clause: Clause, clauses: Iterable[tuple[int, Clause]]) -> int:
        taken = set(map(abs, clause))
        return next(abs(x) for _, own in clauses for x in own if abs(x) not in taken)

    def _write(self, clause: Clause, hints: tuple[int, ...]) -> int:
        self.lemmas.append((clause, hints))
        return len(self.reasons.formula) + len(self.lemmas)

    def lrat(self) -> str:
        first = len(self.reasons.formula) + 1
        return "".join(
            f"{' '.join(map(str, (number, *clause, 0, *hints, 0)))}\n"
            for number, (clause, hints) in enumerate(self.lemmas, start=first)
        )


def explain(reasons: Reasons, outline: Outline) -> Explanation:
    """Follow an outline and let the kernel replay what it says.

    Raises:
        BadOutline: It cannot be followed.
        certify.kernel.refutation.NotRefuted: The kernel does not accept the lemmas.
    """
    follower = _Follower(reasons)
    history = {q: [(signs, 0)] for q, (signs, _) in reasons.given.items()}
    steps = follower.follow(outline, _Known((), history))
    lrat = follower.lrat()
    replay(reasons.formula, lrat)
    return Explanation(dict(sorted(follower.used.items())), steps, lrat)


def without_idle_steps(reasons: Reasons, outline: Outline) -> Outline:
    """Return an outline without the steps that no other step needs.

    Raises:
        BadOutline: It cannot be followed.
    """
    while True:
        used = explain(reasons, outline).used()
        shorter = _only(used, outline, count(1))
        if shorter == outline:
            return outline
        outline = shorter


def _only(used: set[int], outline: Outline, numbers: Iterator[int]) -> Outline:
    """Return the entries that are used; they are numbered in the order in which they are shown."""
    kept: Outline = []
    for entry in outline:
        if not isinstance(entry, dict):
            if next(numbers) in used:
                kept.append(entry)
            continue
        then = _only(used, entry["then"], numbers)
        needed = next(numbers) in used
        also = [digits for digits in entry.get("also", ()) if next(numbers) in used]
        if needed or also:
            kept.append({"suppose": entry["suppose"], "then": then})
            kept[-1] |= {"also": also} if also else {}
    return kept
