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

from certify.atlas.explanation import Outline
from certify.atlas.reasons import ANY, Reason, Reasons, Signs, opposite
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
        return State([*self.signs], [[*shown] for shown in self.shown], scope)

    @property
    def freedom(self) -> float:
        return sum(FREEDOM[signs] for signs in self.signs)


@dataclass
class Found:
    """An outline, and how long it is for a reader."""

    outline: Outline
    steps: int
    cases: int


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
        self.symmetries = [*self._symmetries()]

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

    def closure(self, signs: list[Signs], start: Iterable[int]) -> bool:
        """Narrow the signs as far as single reasons do; return whether they are not contradictory."""
        waiting = [k for place in start for k in self.at[place]]
        queued = set(waiting)
        while waiting:
            k = waiting.pop()
            queued.discard(k)
            places = self.places[k]
            remaining = self.reasons[k].conclude(tuple([signs[p] for p in places]))
            for place, left in zip(places, remaining, strict=True):
                if left != signs[place]:
                    if not left:
                        return False
                    signs[place] = left
                    for other in self.at[place]:
                        if other not in queued and other != k:
                            queued.add(other)
                            waiting.append(other)
        return True


Weigh = Callable[[int, int], float]
"""Reason and determinant -> what a step costs."""


@dataclass
class Try:
    """One way to a contradiction."""

    problem: Problem
    weigh: Weigh
    random: Random
    noise: float
    events: list[Event] = field(default_factory=list)

    def run(self) -> int | None:
        """Return the event that is the last contradiction, None if the cases would be too deep."""
        size = len(QUADRUPLES)
        state = State([ANY] * size, [[] for _ in range(size)])
        for determinant, signs in self.problem.given.items():
            self._note(state, Event(determinant, signs, None, (), 0, 0))
        return self._solve(state, [*self.problem.given], 0)

    def _note(self, state: State, event: Event) -> int:
        self.events.append(event)
        number = len(self.events) - 1
        state.signs[event.determinant] = event.signs
        state.shown[event.determinant].append((event.signs, number))
        return number

    # Without suppositions.

    def _propagate(self, state: State, start: Iterable[int]) -> int | None:
        """Add facts, cheap ones first; return the contradiction if there is one."""
        waiting: list[tuple[float, int, int, int, Signs, tuple[int, ...]]] = []
        serial = count()
        for k in {k for place in start for k in self.problem.at[place]}:
            self._fire(state, k, waiting, serial)
        while waiting:
            cost, _, k, place, signs, needs = heappop(waiting)
            left = signs & state.signs[place]
            if left == state.signs[place]:
                continue
            if left != signs:
                needs = tuple({*needs, state.shown[place][-1][1]})
            reason = self.problem.reasons[k]
            number = self._note(state, Event(place, left, reason, needs, cost, state.scope))
            if not left:
                return number
            for other in self.problem.at[place]:
                self._fire(state, other, waiting, serial)
        return None

    def _fire(self, state: State, k: int, waiting: list, serial: Iterator[int]) -> None:
        places = self.problem.places[k]
        now = [state.signs[place] for place in places]
        remaining = self.problem.reasons[k].conclude(tuple(now))
        for i, place in enumerate(places):
            if remaining[i] != now[i]:
                needs = self._needs(state, k, i, remaining[i])
                cost = self.weigh(k, place) + sum(self.events[n].cost for n in needs)
                heappush(waiting, (cost, next(serial), k, place, remaining[i], needs))

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

    def _solve(self, state: State, start: Iterable[int], depth: int) -> int | None:
        """Return the contradiction to which a state leads, None if it is too deep."""
        while (contradiction := self._propagate(state, start)) is None:
            choice = self._choice(state)
            if choice is None or depth >= DEPTH:
                return None
            place, signs = choice
            changed = self._suppose(state, place, signs, depth)
            if changed is None:
                return None
            start = changed
        return contradiction

    def _choice(self, state: State) -> tuple[int, Signs] | None:
        """Return what to suppose: of what fails, what tells most; else what tells most by far."""
        base = state.freedom
        best, best_score = None, -1.0
        for place, signs in enumerate(state.signs):
            for pair in SPLITS.get(signs, ()):
                gains = []
                for part in pair:
                    tried = [*state.signs]
                    tried[place] = part
                    open_ = self.problem.closure(tried, [place])
                    gains.append(base - sum(FREEDOM[s] for s in tried) if open_ else base + 1000)
                noise = 1 + self.noise * self.random.random()
                for part, other in ((0, 1), (1, 0)):
                    # The part fails, or is the one that tells more; then the other becomes a fact.
                    if gains[part] >= gains[other] or gains[part] > 999:
                        score = noise * (gains[part] * gains[other] + gains[other])
                        if score > best_score:
                            best, best_score = (place, pair[part]), score
        return best

    def _suppose(self, state: State, place: int, signs: Signs, depth: int) -> list[int] | None:
        """Show that a determinant has not these signs; return the determinants with new facts."""
        scope = len(self.events) + 1
        inner = state.copy(scope)
        supposed = self._note(inner, Event(place, signs, None, self._last(state, place), 0, scope))
        contradiction = self._solve(inner, [place], depth + 1)
        if contradiction is None:
            return None
        cause = Supposed(supposed, contradiction)
        cost = self.events[contradiction].cost + 1
        rest = state.signs[place] & ~signs
        needs = (contradiction, *self._last(state, place))
        case = self._note(state, Event(place, rest, cause, needs, cost, state.scope))
        return [place, *self._images(state, case, place, signs, cost)]

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
        needed: set[int] = set()
        waiting = [contradiction]
        while waiting:
            number = waiting.pop()
            if number not in needed:
                needed.add(number)
                waiting += self.events[number].needs
        causes = [self.events[number].cause for number in needed]
        return Found(
            self._outline(sorted(needed), 0),
            sum(cause is not None for cause in causes),
            sum(isinstance(cause, Supposed) for cause in causes),
        )

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


def shorten(problem: Problem, seed: int, tries: int) -> Iterator[Found]:
    """Yield what is found in some tries, each shorter than the one before."""
    random = Random(seed)
    best: Found | None = None
    cheap: dict[tuple[str, str], float] = {}
    for k in range(tries):
        weights: dict[tuple[int, int], float] = {}

        def weigh(reason: int, place: int) -> float:
            key = (reason, place)
            if key not in weights:
                digits = "".join(map(str, QUADRUPLES[place]))
                used = cheap.get((problem.reasons[reason].name, digits), 1.0)
                weights[key] = used * (1 + 0.4 * random.random())
            return weights[key]

        one = Try(problem, weigh, random, random.choice((0, 0.2, 1)) if k else 0)
        contradiction = one.run()
        if contradiction is not None:
            found = one.found(contradiction)
            if best is None or (found.steps, found.cases) <= (best.steps, best.cases):
                if best is None or (found.steps, found.cases) < (best.steps, best.cases):
                    yield found
                best = found
                cheap = dict.fromkeys(_entries(found.outline), 0.6)


def _entries(outline: Outline) -> Iterator[tuple[str, str]]:
    for entry in outline:
        if isinstance(entry, dict):
            yield from _entries(entry["then"])
        else:
            yield entry[0], entry[1]
