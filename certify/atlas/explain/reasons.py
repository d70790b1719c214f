"""The clauses of a refuted formula, gathered to reasons that a person can follow.

A *reason* is what some clauses of the kernel's formula say together about a few determinants: one
Grassmann-Plücker relation about six, the circuit of five points about five. It takes the signs that
each of them may still have, and returns those that remain. What it returns is only a proposal: a
step counts once the kernel has replayed it (see :mod:`certify.atlas.explain.explanation`).
"""

from collections import defaultdict
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cache
from itertools import product
from typing import TypeAlias

from certify.families import Families
from certify.kernel.chirotope import QUADRUPLES, RELATIONS
from certify.kernel.hexahedron import VERTICES, Simplex, sorted_with_sign
from certify.kernel.orientations import Clause, has_sign

Signs: TypeAlias = int
"""The signs that a determinant may have: a sum of some of the three below; 0 is a contradiction."""

NEGATIVE, ZERO, POSITIVE = 1, 2, 4
ANY: Signs = 7
SIGN = {NEGATIVE: -1, ZERO: 0, POSITIVE: 1}

Conclude: TypeAlias = Callable[[tuple[Signs, ...]], tuple[Signs, ...]]


def opposite(signs: Signs) -> Signs:
    """Return the signs of the negated determinant."""
    return (signs & ZERO) | (signs & NEGATIVE) << 2 | (signs & POSITIVE) >> 2


@dataclass(frozen=True)
class Reason:
    """Some clauses about some determinants.

    vertices: what it is about: of a relation the six, two common ones first; of a circuit the five;
    of an edge its two; of a section the facets, as eight. determinants: the quadruples. clauses:
    their numbers in the formula. conclude: signs of the determinants -> those that remain; all are
    0 if none do.
    """

    kind: str
    vertices: tuple[int, ...]
    determinants: tuple[Simplex, ...]
    clauses: tuple[int, ...] = field(repr=False)
    conclude: Conclude = field(repr=False, compare=False)

    @property
    def name(self) -> str:
        """A short name, unique in a formula."""
        digits = "".join(map(str, self.vertices))
        return f"{digits[:2]}|{digits[2:]}" if self.kind == "relation" else f"{self.kind} {digits}"


@dataclass(frozen=True)
class Reasons:
    """A formula as a person meets it.

    given: determinant -> its signs, and the number of the unit clause that says so; exclusive: the
    number of the clause that a determinant has one sign only; reasons: all others, by name.
    """

    formula: tuple[Clause, ...] = field(repr=False)
    given: Mapping[Simplex, tuple[Signs, int]]
    exclusive: Mapping[Simplex, int]
    reasons: Mapping[str, Reason]


def gather(families: Families) -> Reasons:
    """Return the clauses of a refuted formula as reasons."""
    formula = tuple(clause for clauses in families.values() for clause in clauses)
    numbered: dict[str, list[tuple[int, Clause]]] = {}
    last = 0
    for family, clauses in families.items():
        numbered[family] = list(enumerate(clauses, start=last + 1))
        last += len(clauses)
    given: dict[Simplex, tuple[Signs, int]] = {}
    for family in ("oriented", "corners"):
        for number, (literal,) in numbered.get(family, ()):
            given[quadruple_of(literal)] = (signs_of(literal), number)
    exclusive = {quadruple_of(clause[0]): number for number, clause in numbered["exclusive"]}
    reasons = [
        *_relations(numbered["Grassmann-Pluecker"]),
        *_circuits([*numbered["no overlap"], *numbered.get("on hull", ())]),
        *_pairs("edge", numbered.get("edges", ())),
        *_pairs("section", numbered.get("sections", ())),
        *_polynomials(numbered["final polynomials"]),
    ]
    return Reasons(formula, given, exclusive, {reason.name: reason for reason in reasons})


def quadruple_of(literal: int) -> Simplex:
    """Return the quadruple that a literal is about."""
    return QUADRUPLES[(abs(literal) - 1) // 2]


def signs_of(literal: int) -> Signs:
    """Return the signs for which a literal is true."""
    signs = POSITIVE if literal % 2 else NEGATIVE
    return signs if literal > 0 else ANY - signs


def _about(clauses: Iterable[Clause]) -> tuple[Simplex, ...]:
    return tuple(sorted({quadruple_of(literal) for clause in clauses for literal in clause}))


# Grassmann-Plücker relations.


def _relations(numbered: Sequence[tuple[int, Clause]]) -> Iterator[Reason]:
    size = len(numbered) // len(RELATIONS)
    for k, terms in enumerate(RELATIONS):
        factors = [(*sorted_with_sign(x), *sorted_with_sign(y), e) for x, y, e in terms]
        determinants = tuple(q for x, _, y, _, _ in factors for q in (x, y))
        flips = tuple(flip for _, p, _, r, e in factors for flip in (p * e, r))
        first, _, _ = terms
        numbers = tuple(number for number, _ in numbered[k * size : (k + 1) * size])
        yield Reason(
            "relation",
            (*first[0], *first[1][2:]),
            determinants,
            numbers,
            _flipped(flips, conclude_relation),
        )


def _flipped(flips: tuple[int, ...], conclude: Conclude) -> Conclude:
    """Return the conclusions about determinants some of which are negated."""

    def flip(signs: tuple[Signs, ...]) -> tuple[Signs, ...]:
        return tuple(opposite(s) if f < 0 else s for s, f in zip(signs, flips, strict=True))

    return cache(lambda signs: flip(conclude(flip(signs))))


@cache
def conclude_relation(signs: tuple[Signs, ...]) -> tuple[Signs, ...]:
    """Return what remains for x, y, z, w, u, v if xy + zw + uv = 0."""
    remaining = [0] * 6
    for values in product(*map(_members, signs)):
        terms = {SIGN[values[i]] * SIGN[values[i + 1]] for i in (0, 2, 4)}
        if (1 in terms) == (-1 in terms):
            for i, value in enumerate(values):
                remaining[i] |= value
    return tuple(remaining)


def _members(signs: Signs) -> list[Signs]:
    return [sign for sign in (NEGATIVE, ZERO, POSITIVE) if sign & signs]


# All others.


def _circuits(numbered: Iterable[tuple[int, Clause]]) -> Iterator[Reason]:
    """Two determinants of a circuit tell its five points, and every clause has two."""
    of_five: defaultdict[tuple[int, ...], list[tuple[int, Clause]]] = defaultdict(list)
    for number, clause in numbered:
        points = {vertex for literal in clause for vertex in quadruple_of(literal)}
        of_five[tuple(sorted(points))].append((number, clause))
    for vertices, own in sorted(of_five.items()):
        yield _by_table("circuit", vertices, own)


def _pairs(kind: str, numbered: Sequence[tuple[int, Clause]]) -> Iterator[Reason]:
    """Of edges and sections two clauses each say the same but for the sign."""
    for i in range(0, len(numbered), 2):
        own = numbered[i : i + 2]
        quadruples = _about(clause for _, clause in own)
        if kind == "edge":  # the one thing that all its determinants have in common
            common = set(VERTICES).intersection(*map(set, quadruples))
            vertices = tuple(sorted(common))
        else:
            vertices = tuple(vertex for quadruple in quadruples for vertex in quadruple)
        yield _by_table(kind, vertices, own)


def _by_table(
    kind: str, vertices: tuple[int, ...], numbered: Sequence[tuple[int, Clause]]
) -> Reason:
    """Return the reason that is all of some clauses about at most five determinants."""
    numbers, clauses = zip(*numbered, strict=True)
    determinants = _about(clauses)
    place = {quadruple: i for i, quadruple in enumerate(determinants)}
    wanted = [[(place[quadruple_of(x)], signs_of(x)) for x in clause] for clause in clauses]
    allowed = [
        values
        for values in product((NEGATIVE, ZERO, POSITIVE), repeat=len(determinants))
        if all(any(values[i] & signs for i, signs in literals) for literals in wanted)
    ]

    @cache
    def conclude(signs: tuple[Signs, ...]) -> tuple[Signs, ...]:
        remaining = [0] * len(signs)
        for values in allowed:
            if all(value & s for value, s in zip(values, signs, strict=True)):
                remaining = [r | value for r, value in zip(remaining, values, strict=True)]
        return tuple(remaining)

    return Reason(kind, vertices, determinants, numbers, conclude)


def _polynomials(numbered: Iterable[tuple[int, Clause]]) -> Iterator[Reason]:
    for k, (number, clause) in enumerate(numbered, start=1):
        yield Reason("polynomial", (k,), _about([clause]), (number,), _by_clause(clause))


def _by_clause(clause: Clause) -> Conclude:
    """Return the conclusions from one clause, however long."""
    wanted = dict.fromkeys(_about([clause]), 0)
    for literal in clause:
        wanted[quadruple_of(literal)] |= signs_of(literal)

    def conclude(signs: tuple[Signs, ...]) -> tuple[Signs, ...]:
        true = [s & w for s, w in zip(signs, wanted.values(), strict=True)]
        if sum(map(bool, true)) > 1:
            return signs
        if not any(true):
            return (0,) * len(signs)
        return tuple(t or s for t, s in zip(true, signs, strict=True))

    return conclude


def literals_for(quadruple: Simplex, signs: Signs) -> list[tuple[int, ...]]:
    """Return the clauses that together say that a determinant has one of these signs."""
    positive, negative = has_sign(quadruple, 1), has_sign(quadruple, -1)
    clauses: dict[Signs, list[tuple[int, ...]]] = {
        POSITIVE: [(positive,)],
        NEGATIVE: [(negative,)],
        ZERO: [(-positive,), (-negative,)],
        POSITIVE + ZERO: [(-negative,)],
        NEGATIVE + ZERO: [(-positive,)],
        POSITIVE + NEGATIVE: [(positive, negative)],
        0: [()],
        ANY: [],
    }
    return clauses[signs]
