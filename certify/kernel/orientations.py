"""The CNF that the signs of every realization satisfy, whatever the position of the points.

Two variables stand for a quadruple q, the k-th of 1234, 1235, ..., 5678 (k = 1..70):

    2k - 1 is true iff det q > 0,        2k is true iff det q < 0,

so both are false iff the four points are coplanar. A realization, mirrored if need be, satisfies
every clause of :func:`realization_formula`; if its vertices are moreover on the boundary of their
convex hull, every clause of :func:`convex_formula`. A proof that the formula is unsatisfiable is
therefore a proof that there is no such placement. Clauses are tuples of non-zero integers, as in
DIMACS; their order is part of the certificate format, since proofs refer to clauses by number.
"""

from collections.abc import Iterator, Mapping
from functools import lru_cache
from itertools import product
from typing import TypeAlias

from certify.kernel.chirotope import QUADRUPLES, QUINTUPLES, RELATIONS, dependence
from certify.kernel.hexahedron import Simplex, sorted_with_sign

Clause: TypeAlias = tuple[int, ...]

_NUMBER = {quadruple: k for k, quadruple in enumerate(QUADRUPLES, start=1)}


def has_sign(quadruple: Simplex, sign: int) -> int:
    """Return the literal "the determinant of the quadruple has this sign", for sign 1 or -1."""
    return 2 * _NUMBER[quadruple] - (sign > 0)


def bracket(vertices: tuple[int, ...], sign: int) -> int:
    """Return the literal "the determinant of the vertices, in the order given, has this sign"."""
    quadruple, parity = sorted_with_sign(vertices)
    return has_sign(quadruple, parity * sign)


def exclusive() -> Iterator[Clause]:
    """No determinant is both positive and negative."""
    for quadruple in QUADRUPLES:
        yield (-has_sign(quadruple, 1), -has_sign(quadruple, -1))


def grassmann_pluecker() -> Iterator[Clause]:
    """Three-term Grassmann-Pluecker relations, for any signs, zero included.

    The three terms have the sum zero. Hence if one of them is positive, another one is negative,
    and vice versa. "Term xy has sign e" is (x, y) having signs (e, 1) or (-e, -1); "term xy has not
    sign -e" is implied by (x not -e and y not -1), and by (x not e and y not 1). One clause
    excludes one choice of these for a term of sign e and two terms without sign -e.
    """
    for terms in RELATIONS:
        for sign in (1, -1):
            for i, (x, y, e) in enumerate(terms):
                strict = [(-bracket(x, f * sign * e), -bracket(y, f)) for f in (1, -1)]
                weak = [
                    [(bracket(x, -f * sign * e), bracket(y, -f)) for f in (1, -1)]
                    for x, y, e in terms[:i] + terms[i + 1 :]
                ]
                for choice in product(strict, *weak):
                    yield tuple(literal for pair in choice for literal in pair)


def oriented(orientation: Mapping[Simplex, int]) -> Iterator[Clause]:
    """Every tetrahedron is non-degenerate and has its sign."""
    for tetrahedron, sign in orientation.items():
        yield (has_sign(tetrahedron, sign),)


def no_overlap(tetrahedra: Mapping[Simplex, int]) -> Iterator[Clause]:
    """No circuit has X+ in one tetrahedron and X- in another (the lemma of embedding.py).

    The dependence of a quintuple, where it does not vanish, is a circuit. Let F and G be what two
    tetrahedra have of the quintuple, together all of it. If some coefficient on F is positive, or
    some on G negative, then it does not vanish, so some coefficient outside F is positive or some
    outside G negative.
    """
    for quintuple in QUINTUPLES:
        traces = {frozenset(quintuple).intersection(tetrahedron) for tetrahedron in tetrahedra}
        maximal = sorted((t for t in traces if not any(t < other for other in traces)), key=sorted)
        coefficient = {
            (vertex, sign): has_sign(quadruple, sign * factor)
            for vertex, quadruple, factor in dependence(quintuple)
            for sign in (1, -1)
        }
        for f, g in product(maximal, repeat=2):
            if len(f | g) == len(quintuple):
                escape = [coefficient[vertex, 1] for vertex in quintuple if vertex not in f]
                escape += [coefficient[vertex, -1] for vertex in quintuple if vertex not in g]
                for vertex in sorted(f):
                    yield (-coefficient[vertex, 1], *escape)
                for vertex in sorted(g):
                    yield (-coefficient[vertex, -1], *escape)


def on_hull() -> Iterator[Clause]:
    """No vertex is inside a tetrahedron of four others, as none is inside the hull.

    Vertex v is inside abcd iff in the dependence of vabcd it has one sign and all others the
    opposite sign. (Points on the boundary of abcd are not excluded: this is the weaker demand.)
    """
    for quintuple in QUINTUPLES:
        terms = dependence(quintuple)
        for inner, _, _ in terms:
            for sign in (1, -1):
                yield tuple(
                    -has_sign(quadruple, factor * (sign if vertex == inner else -sign))
                    for vertex, quadruple, factor in terms
                )


@lru_cache(maxsize=1)
def _axioms() -> tuple[Clause, ...]:
    return (*exclusive(), *grassmann_pluecker())


def realization_formula(orientation: Mapping[Simplex, int]) -> tuple[Clause, ...]:
    """Return the clauses that every realization of the oriented tetrahedra satisfies."""
    return (*_axioms(), *oriented(orientation), *no_overlap(orientation))


def convex_formula(orientation: Mapping[Simplex, int]) -> tuple[Clause, ...]:
    """Return those every realization with all vertices on the boundary of the hull satisfies."""
    return (*realization_formula(orientation), *on_hull())
