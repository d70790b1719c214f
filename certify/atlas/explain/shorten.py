"""The search for short explanations. Nothing here is believed: what it finds is followed anew.

Facts are derived best first, from what is given on, each by the reason that makes the sum of its
own cost and that of what it needs least; costs are random, so that every try finds another way.
Where that ends without a contradiction, a supposition is made: one that fails, if there is one
(then its opposite is a fact); else the one that tells most, whose case is explained in the same
way. What the last contradiction does not need is left out.
"""

from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass, field
from heapq import heappop, heappush
from itertools import count
from math import log2
from random import Random
from typing import NamedTuple, TypeAlias

from certify.atlas.explain.explanation import Outline
from certify.atlas.explain.reasons import ANY, Reason, Reasons, Signs, opposite
from certify.kernel.chirotope import QUADRUPLES
from certify.kernel.hexahedron import SYMMETRIES, sorted_with_sign

_NUMBER = {quadruple: k for k, quadruple in enumerate(QUADRUPLES)}

DEPTH = 4
"""How deep cases may be nested."""

SPLITS: dict[Signs, tuple[tuple[Signs, Signs], ...]] = {
    7: ((4, 3), (1, 6)),
    6: ((4, 2),),
    5: ((4, 1),),
    3: ((1, 2),),
}
"""Signs that are left -> how a supposition may divide them."""

FREEDOM = (0.0, *(log2(signs.bit_count()) for signs in range(1, 8)))


class Choice(NamedTuple):
    """A determinant, the signs that are supposed, and what to suppose in that case."""

    place: int
    signs: Signs
    inner: "Sequence[Choice]"


@dataclass
class Event:
    """A fact that was found: why, and the numbers of the events that it needs."""

    determinant: int
    signs: Signs
    cause: "Reason | Supposed | Image | None"
    needs: tuple[int, ...]
    cost: float
    scope: int


@dataclass(frozen=True)
class Supposed:
    """That a supposition failed: the event that was supposed, and the contradiction."""

    supposed: int
    contradiction: int


@dataclass(frozen=True)
class Image:
    """That the supposition of another event fails under other names of the vertices."""

    of: int
    symmetry: tuple[int, ...]


@dataclass
class State:
    """What is known in a scope."""

    signs: list[Signs]
    shown: list[list[tuple[Signs, int]]]
    """Determinant -> (signs, event), each more narrow than the one before."""
    scope: int = 0

    def copy(self, scope: int) -> "State":
        """Return the same, as the beginning of another scope."""
        return State([*self.signs], [[*shown] for shown in self.shown], scope)

    @property
    def freedom(self) -> float:
        """The number of bits that the signs leave open."""
        return sum(FREEDOM[signs] for signs in self.signs)


class Found(NamedTuple):
    """An outline, with the number of its steps and of its cases."""

    outline: Outline
    length: tuple[int, int]


class Problem:
    """A formula, indexed for the search."""

    def __init__(self, reasons: Reasons) -> None:
        self.reasons = [*reasons.reasons.values()]
        self.places = [tuple(_NUMBER[q] for q in r.determinants) for r in self.reasons]
        self.at: list[list[int]] = [[] for _ in QUADRUPLES]
        for k, places in enumerate(self.places):
            for place in places:
                self.at[place].append(k)
        self.given = {_NUMBER[q]: signs for q, (signs, _) in reasons.given.items()}
        polynomials = any(reason.kind == "polynomial" for reason in self.reasons)
        self.symmetries = [] if polynomials else [*self._symmetries()]

    def _symmetries(self) -> Iterator[tuple[tuple[int, ...], list[tuple[int, int]]]]:
        """Yield the relabellings that keep what is given, up to a mirror image of all points.

        With each: determinant -> its image and the sign that this gets.
        """
        for symmetry in SYMMETRIES[1:]:
            images = []
            for quadruple in QUADRUPLES:
                mapped, parity = sorted_with_sign(tuple(symmetry[v - 1] for v in quadruple))
                images.append((_NUMBER[mapped], parity))
            for mirror in (1, -1):
                signed = [(k, parity * mirror) for k, parity in images]
                if all(
                    self.given.get(k) == (s if sign > 0 else opposite(s))
                    for q, s in self.given.items()
                    for k, sign in [signed[q]]
                ):
                    yield symmetry, signed

    def closure(self, signs: list[Signs], place: int) -> int:
        """Narrow the signs as far as single reasons do, in rounds.

        Return 0, or the number of the round that ends with a contradiction.
        """
        now = {*self.at[place]}
        rounds = 0
        while now:
            rounds += 1
            after: set[int] = set()
            for k in sorted(now):
                places = self.places[k]
                seen = tuple([signs[p] for p in places])
                remaining = self.reasons[k].conclude(seen)
                if remaining != seen:
                    for other, left in zip(places, remaining, strict=True):
                        if left != signs[other]:
                            if not left:
                                return rounds
                            signs[other] = left
                            after.update(self.at[other])
            now = after
        return 0


def _best(scored: list[tuple[float, Choice]]) -> list[Choice]:
    return [choice for _, choice in sorted(scored, reverse=True)[:8]]


Waiting: TypeAlias = tuple[float, int, int, int, Signs, tuple[int, ...]]
"""Cost, serial number, reason, determinant, what it will have, and what that needs."""

Weigh: TypeAlias = Callable[[int, int], float]
"""Reason and determinant -> what a step costs."""


@dataclass
class Try:
    """One way to a contradiction."""

    problem: Problem
    weigh: Weigh
    random: Random
    noise: float
    thrift: float
    events: list[Event] = field(default_factory=list)

    def run(self, plan: Iterable[Choice]) -> tuple[int, list[Choice]] | None:
        """Return the event that is the last contradiction, and what was supposed.

        None if the cases would be too deep. plan: what to suppose first.
        """
        size = len(QUADRUPLES)
        state = State([ANY] * size, [[] for _ in range(size)])
        for determinant, signs in self.problem.given.items():
            self._note(state, Event(determinant, signs, None, (), 0, 0))
        return self._solve(state, [*self.problem.given], plan, 0)

    def _note(self, state: State, event: Event) -> int:
        self.events.append(event)
        number = len(self.events) - 1
        state.signs[event.determinant] = event.signs
        state.shown[event.determinant].append((event.signs, number))
        return number

    # Without suppositions.

    def _propagate(self, state: State, start: Iterable[int]) -> int | None:
        """Add facts, cheap ones first; return the contradiction if there is one."""
        waiting: list[Waiting] = []
        serial = count()
        for k in {k for place in start for k in self.problem.at[place]}:
            self._fire(state, k, waiting, serial)
        while waiting:
            cost, _, k, place, left, needs = heappop(waiting)
            now = self._concluded(state, k)[self.problem.places[k].index(place)]
            if now == state.signs[place]:
                continue
            if now != left:  # more is known by now, and then found anew
                continue
            reason = self.problem.reasons[k]
            number = self._note(state, Event(place, left, reason, needs, cost, state.scope))
            if not left:
                return number
            for other in self.problem.at[place]:
                self._fire(state, other, waiting, serial)
        return None

    def _fire(self, state: State, k: int, waiting: list[Waiting], serial: Iterator[int]) -> None:
        remaining = self._concluded(state, k)
        for i, place in enumerate(self.problem.places[k]):
            if remaining[i] != state.signs[place]:
                needs = self._needs(state, k, i, remaining[i])
                cost = self.weigh(k, place) + sum(self.events[n].cost for n in needs)
                heappush(waiting, (cost, next(serial), k, place, remaining[i], needs))

    def _concluded(self, state: State, k: int) -> tuple[Signs, ...]:
        now = tuple([state.signs[place] for place in self.problem.places[k]])
        return self.problem.reasons[k].conclude(now)

    def _needs(self, state: State, k: int, i: int, signs: Signs) -> tuple[int, ...]:
        """Return events from which the conclusion follows, without the dearest ones if possible."""
        places, conclude = self.problem.places[k], self.problem.reasons[k].conclude
        now = [state.signs[place] for place in places]
        now_here = now[i]
        latest = [shown[-1][1] if (shown := state.shown[p]) else -1 for p in places]
        needs = set()
        for j in sorted(range(len(places)), key=lambda j: -self._cost(latest[j])):
            if latest[j] < 0:
                continue
            for weaker, event in ((ANY, -1), *state.shown[places[j]]):
                now[j] = weaker
                here = now[i] if j == i else now_here
                if conclude(tuple(now))[i] & here == signs:
                    if j == i:
                        now_here = here
                    if event >= 0:
                        needs.add(event)
                    break
        return tuple(sorted(needs))

    def _cost(self, event: int) -> float:
        return self.events[event].cost if event >= 0 else 0.0

    # With suppositions.

    def _solve(
        self, state: State, start: Iterable[int], plan: Iterable[Choice], depth: int
    ) -> tuple[int, list[Choice]] | None:
        """Return the contradiction to which a state leads, None if it is too deep."""
        planned = iter(plan)
        chosen: list[Choice] = []
        while (contradiction := self._propagate(state, start)) is None:
            choice = next(planned, None) or self._choice(state)
            if choice is None or depth >= DEPTH:
                return None
            place, signs, inner = choice
            if not signs & state.signs[place] or not state.signs[place] & ~signs:
                start = ()
                continue
            changed = self._suppose(state, place, signs, inner, depth)
            if changed is None:
                return None
            start, inner = changed
            chosen.append(Choice(place, signs, inner))
        return contradiction, chosen

    def _choice(self, state: State) -> Choice | None:
        """Return what to suppose: what fails, as its opposite does; what fails; what tells most."""
        base = state.freedom
        ends: list[tuple[float, Choice]] = []
        failing: list[tuple[float, Choice]] = []
        others: list[tuple[float, Choice]] = []
        places = [k for k, signs in enumerate(state.signs) if signs in SPLITS]
        if self.noise:
            places = self.random.sample(places, (len(places) + 1) // 2)
        for place in places:
            for pair in SPLITS[state.signs[place]]:
                gains, rounds = [], []
                for part in pair:
                    tried = [*state.signs]
                    tried[place] = part
                    rounds.append(self.problem.closure(tried, place))
                    gains.append(base - sum(FREEDOM[s] for s in tried))
                noise = 1 + self.noise * self.random.random()
                if all(rounds):
                    ends.append((-sum(rounds) * noise, Choice(place, pair[0], ())))
                elif any(rounds):
                    part = 0 if rounds[0] else 1
                    score = gains[1 - part] * noise
                    failing.append((score, Choice(place, pair[part], ())))
                else:
                    part = 0 if gains[0] >= gains[1] else 1
                    score = gains[0] * gains[1] + min(gains)
                    others.append((score * noise, Choice(place, pair[part], ())))
        if ends:
            return min(_best(ends), key=lambda c: self._size(state, c, both=True))
        if failing:
            gain = {choice: score for score, choice in failing}
            if not self.thrift:
                return _best(failing)[0]
            size = {c: self._size(state, c, both=False) for c in _best(failing)}
            return max(size, key=lambda c: gain[c] / size[c] ** self.thrift)
        return max(others)[1] if others else None

    def _size(self, state: State, choice: Choice, both: bool) -> int:
        """Return how many facts it takes to refute a supposition, or also its opposite."""
        kept = len(self.events)
        ends = []
        rest = [state.signs[choice.place] & ~choice.signs] if both else []
        for signs in (choice.signs, *rest):
            inner = state.copy(-1)
            last = self._last(state, choice.place)
            self._note(inner, Event(choice.place, signs, None, last, 0, -1))
            ends.append(self._propagate(inner, [choice.place]))
        size = len(self._needed(end for end in ends if end is not None))
        del self.events[kept:]
        return size

    def _needed(self, events: Iterable[int]) -> set[int]:
        """Return some events and all that they need."""
        needed: set[int] = set()
        waiting = [*events]
        while waiting:
            number = waiting.pop()
            if number not in needed:
                needed.add(number)
                waiting += self.events[number].needs
        return needed

    def _suppose(
        self, state: State, place: int, signs: Signs, plan: Iterable[Choice], depth: int
    ) -> tuple[list[int], list[Choice]] | None:
        """Show that a determinant has not these signs; return the determinants with new facts."""
        scope = len(self.events) + 1
        inner = state.copy(scope)
        left = state.signs[place] & signs
        supposed = self._note(inner, Event(place, left, None, self._last(state, place), 0, scope))
        solved = self._solve(inner, [place], plan, depth + 1)
        if solved is None:
            return None
        contradiction, chosen = solved
        cause = Supposed(supposed, contradiction)
        cost = self.events[contradiction].cost + 1
        rest = state.signs[place] & ~signs
        needs = (contradiction, *self._last(state, place))
        case = self._note(state, Event(place, rest, cause, needs, cost, state.scope))
        return [place, *self._images(state, case, place, signs, cost)], chosen

    def _last(self, state: State, place: int) -> tuple[int, ...]:
        return (state.shown[place][-1][1],) if state.shown[place] else ()

    def _images(
        self, state: State, case: int, place: int, signs: Signs, cost: float
    ) -> Iterator[int]:
        """Outside all cases, note what the symmetries make of a fact, and yield where."""
        for symmetry, images in self.problem.symmetries if state.scope == 0 else ():
            other, sign = images[place]
            rest = state.signs[other] & ~(signs if sign > 0 else opposite(signs))
            if rest != state.signs[other]:
                needs = (case, *self._last(state, other))
                event = Event(other, rest, Image(case, symmetry), needs, cost, 0)
                self._note(state, event)
                yield other

    # What was found.

    def found(self, contradiction: int) -> Found:
        """Return what the contradiction needs as an outline."""
        needed = self._needed([contradiction])
        outline = self._outline(sorted(needed), 0)
        return Found(outline, length_of(outline))

    def _outline(self, needed: Sequence[int], scope: int) -> Outline:
        outline: Outline = []
        entries = {}
        for number in needed:
            event = self.events[number]
            if event.scope != scope or event.cause is None:
                continue
            digits = "".join(map(str, QUADRUPLES[event.determinant]))
            if isinstance(event.cause, Reason):
                outline.append([event.cause.name, digits])
            if isinstance(event.cause, Supposed):
                supposed = self.events[event.cause.supposed]
                inner = self._outline(needed, supposed.scope)
                entries[number] = {"suppose": [digits, supposed.signs], "then": inner}
                outline.append(entries[number])
            if isinstance(event.cause, Image):
                also = entries[event.cause.of].setdefault("also", [])
                also.append("".join(map(str, event.cause.symmetry)))
        return outline


def shorten(problem: Problem, seed: int, tries: int, outline: Outline) -> Iterator[Found]:
    """Yield what some tries find, each shorter than the one before and than a given outline.

    The best one so far is changed: other steps for the same suppositions, or, from one of them on,
    other suppositions. An empty outline stands for none.
    """
    random = Random(seed)
    best, plan = outline, plan_of(outline)
    length = length_of(outline) if outline else None
    for _ in range(tries):
        anew = not best or random.random() < 0.3
        kept = [] if anew else shortened(plan, random) if random.random() < 0.5 else plan
        weights = Weights(problem, random, [] if anew else best)
        noise, thrift = random.choice((0.0, 0.5, 2.0)), random.choice((0.0, 0.3, 1.0))
        one = Try(problem, weights, random, noise, thrift)
        solved = one.run(kept)
        if solved is None:
            continue
        contradiction, chosen = solved
        found = one.found(contradiction)
        if length is None or found.length <= length:
            shorter = length is None or found.length < length
            best, plan, length = found.outline, chosen, found.length
            if shorter:
                yield found


def plan_of(outline: Outline) -> list[Choice]:
    """Return what is supposed in an outline."""
    return [
        Choice(_NUMBER[tuple(map(int, digits))], signs, plan_of(entry["then"]))
        for entry in outline
        if isinstance(entry, dict)
        for digits, signs in [entry["suppose"]]
    ]


def length_of(outline: Outline) -> tuple[int, int]:
    """Return how many steps an outline has, and how many cases."""
    steps = cases = 0
    for entry in outline:
        steps += 1
        if isinstance(entry, dict):
            inner = length_of(entry["then"])
            steps += inner[0] + len(entry.get("also", ()))
            cases += inner[1] + 1
    return steps, cases


def shortened(plan: Sequence[Choice], random: Random) -> list[Choice]:
    """Return a plan without some of its end, or the end of one of its cases, or one entry."""
    if not plan:
        return []
    k = random.randrange(len(plan))
    place, signs, inner = plan[k]
    if inner and random.random() < 0.5:
        changed = Choice(place, signs, shortened(inner, random))
        return [*plan[:k], changed, *plan[k + 1 :]]
    return [*plan[:k], *(plan[k + 1 :] if random.random() < 0.5 else ())]


class Weights:
    """Random costs of steps; those of an outline are cheap."""

    def __init__(self, problem: Problem, random: Random, outline: Outline) -> None:
        self._random = random
        self._names = [reason.name for reason in problem.reasons]
        self._cheap = {*_entries(outline)}
        self._spread = random.choice((0.1, 0.4, 1.0))
        self._discount = random.choice((0.5, 0.7, 0.9))
        self._weights: dict[tuple[int, int], float] = {}

    def __call__(self, reason: int, place: int) -> float:
        """Return what it costs to use a reason for a determinant."""
        key = (reason, place)
        if key not in self._weights:
            weight = 1 + self._spread * self._random.random()
            if (self._names[reason], digits_of(place)) in self._cheap:
                weight *= self._discount
            self._weights[key] = weight
        return self._weights[key]


def digits_of(place: int) -> str:
    """Return the name of a determinant."""
    return "".join(map(str, QUADRUPLES[place]))


def _entries(outline: Outline) -> Iterator[tuple[str, str]]:
    for entry in outline:
        if isinstance(entry, dict):
            yield from _entries(entry["then"])
        else:
            yield entry[0], entry[1]
