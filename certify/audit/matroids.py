"""Uniform sign vectors: the oriented matroids of section 4, without the value zero.

A literal is k if the k-th of the 70 quadruples is positive, -k if it is negative.
"""

from collections import defaultdict
from collections.abc import Iterable, Iterator, Mapping, Sequence
from functools import cache
from itertools import chain, combinations, product
from typing import TypeAlias

from certify.audit.graphs import Tetrahedra
from certify.kernel.chirotope import QUADRUPLES, QUINTUPLES, dependence
from certify.kernel.hexahedron import VERTICES, Simplex, inversions, simplex
from certify.kernel.orientations import Clause, no_overlap, on_hull
from certify.kernel.triangulation import orientation

Watched: TypeAlias = Mapping[int, Sequence[Clause]]
"""Literal -> the clauses that contain its opposite."""

_NUMBER = {quadruple: k for k, quadruple in enumerate(QUADRUPLES, start=1)}


def relations() -> Iterator[tuple[tuple[Simplex, Simplex, int], ...]]:
    """Yield the terms (two brackets and a sign) of the three-term Grassmann-Pluecker relations."""
    for s in combinations(VERTICES, 2):
        for a, b, c, d in combinations([v for v in VERTICES if v not in s], 4):
            yield (
                ((*s, a, b), (*s, c, d), 1),
                ((*s, a, c), (*s, b, d), -1),
                ((*s, a, d), (*s, b, c), 1),
            )


def sign_of(signs: Mapping[Simplex, int], vertices: Simplex) -> int:
    """Return the sign of four vertices in the order given."""
    return -signs[simplex(vertices)] if inversions(vertices) % 2 else signs[simplex(vertices)]


def is_uniform_chirotope(signs: Mapping[Simplex, int]) -> bool:
    """Are all signs 1 or -1, and both among the three terms of every relation?"""
    return set(signs.values()) <= {1, -1} and all(
        {sign_of(signs, x) * sign_of(signs, y) * e for x, y, e in terms} == {1, -1}
        for terms in relations()
    )


def _literal(vertices: Simplex, sign: int) -> int:
    number = sign * _NUMBER[simplex(vertices)]
    return -number if inversions(vertices) % 2 else number


def _uniform(clause: Clause) -> Clause | None:
    """Translate a clause of the kernel, in which "not negative" now is "positive".

    None stands for a clause that is always true.
    """
    literals = {
        (1 if (abs(literal) % 2 == 1) == (literal > 0) else -1) * ((abs(literal) + 1) // 2)
        for literal in clause
    }
    return None if any(-literal in literals for literal in literals) else tuple(sorted(literals))


@cache
def _axioms() -> Watched:
    """Return the clauses of acyclic uniform oriented matroids in convex position."""
    clauses: list[Clause] = []
    for terms in relations():
        factors = [(_literal(x, e), _literal(y, 1)) for x, y, e in terms]
        for sign, *choice in product((1, -1), repeat=4):  # not: all three terms have this sign
            signs = [(-sign * g * x, -g * y) for (x, y), g in zip(factors, choice, strict=True)]
            clauses.append(tuple(chain.from_iterable(signs)))
    clauses += [
        tuple(-_literal(quadruple, factor * sign) for _, quadruple, factor in dependence(five))
        for five in QUINTUPLES
        for sign in (1, -1)
    ]
    return _watched([*clauses, *_translated(on_hull())])


def _translated(clauses: Iterable[Clause]) -> list[Clause]:
    return [uniform for uniform in set(map(_uniform, clauses)) if uniform]


@cache
def convex_sign_vectors(tetrahedra: Tetrahedra) -> int | None:
    """Return how many uniform oriented matroids realize the tetrahedra in convex position.

    They satisfy the five constraints of section 4.2, and no vertex is inside a tetrahedron of four
    others. Decided by failed literals: a sign whose assumption leads to a contradiction by unit
    propagation is wrong. The answer is 0 if both signs of a quadruple are wrong, 1 if what is not
    wrong is one sign for each, and None if that leaves more.
    """
    signs = orientation(tetrahedra)
    clauses = (_axioms(), _watched(_translated(no_overlap(signs))))
    known = _extended(frozenset(), [_literal(t, sign) for t, sign in signs.items()], clauses)
    for literal in [k * sign for k in (*_NUMBER.values(), *_NUMBER.values()) for sign in (1, -1)]:
        if known is None:
            return 0
        if known.isdisjoint((literal, -literal)) and _extended(known, [literal], clauses) is None:
            known = _extended(known, [-literal], clauses)
    if known is None:
        return 0
    return 1 if len(known) == len(QUADRUPLES) else None


def _watched(clauses: Iterable[Clause]) -> Watched:
    found = defaultdict(list)
    for clause in clauses:
        for literal in clause:
            found[-literal].append(clause)
    return dict(found)


def _extended(
    known: frozenset[int], more: list[int], clauses: Sequence[Watched]
) -> frozenset[int] | None:
    """Return all that follows from the literals by unit propagation, None if a contradiction."""
    true, waiting = set(known), list(more)
    while waiting:
        literal = waiting.pop()
        if -literal in true:
            return None
        if literal in true:
            continue
        true.add(literal)
        for clause in chain.from_iterable(watched.get(literal, ()) for watched in clauses):
            free = 0
            for candidate in clause:
                if candidate in true or (free and -candidate not in true):
                    break
                if -candidate not in true:
                    free = candidate
            else:
                if not free:
                    return None
                waiting.append(free)
    return frozenset(true)
