"""Signs of four points, and the circuits they determine. No position is excluded.

The *chirotope* of eight points p1..p8 in R^3 gives each quadruple a < b < c < d the sign of

    det [[1, p_a], [1, p_b], [1, p_c], [1, p_d]] = det(p_b - p_a, p_c - p_a, p_d - p_a).

A *circuit* is a minimal affine dependence: coefficients, not all zero, with sum 0 and
sum of coefficient times point 0, whose support contains no smaller dependent set. It is written
(X+, X-), the sets of points with positive and with negative coefficient; the convex hulls of the
two sets then share a point of the relative interior of both (Radon).
"""

from collections.abc import Iterator, Mapping, Sequence
from fractions import Fraction
from itertools import combinations
from math import lcm
from typing import TypeAlias

from sympy import ZZ
from sympy.polys.matrices import DomainMatrix

from certify.kernel.hexahedron import VERTICES, Simplex

Point: TypeAlias = tuple[Fraction, ...]
Chirotope: TypeAlias = Mapping[Simplex, int]
Circuit: TypeAlias = tuple[frozenset[int], frozenset[int]]
Term: TypeAlias = tuple[tuple[int, ...], tuple[int, ...], int]
"""Two brackets [p q r s] and a sign, which stand for the sign times the product of the two."""

QUADRUPLES: tuple[Simplex, ...] = tuple(combinations(VERTICES, 4))
QUINTUPLES: tuple[Simplex, ...] = tuple(combinations(VERTICES, 5))

RELATIONS: tuple[tuple[Term, Term, Term], ...] = tuple(
    (((*s, a, b), (*s, c, d), 1), ((*s, a, c), (*s, b, d), -1), ((*s, a, d), (*s, b, c), 1))
    for s in combinations(VERTICES, 2)
    for a, b, c, d in combinations([v for v in VERTICES if v not in s], 4)
)
"""The 420 three-term Grassmann-Pluecker relations: the three terms of each have the sum zero.

[s a b][s c d] - [s a c][s b d] + [s a d][s b c] = 0 is an identity for six vectors of R^4, where s
stands for two of them.
"""


def determinant(rows: Sequence[Sequence[int]]) -> int:
    """Return the determinant of a square integer matrix, computed by sympy over ZZ."""
    size = len(rows)
    return int(DomainMatrix([list(map(ZZ, row)) for row in rows], (size, size), ZZ).det())


def denominators(points: Sequence[Point]) -> list[int]:
    """Return the least common denominator of the coordinates along each of the three axes."""
    return [lcm(*(x.denominator for x in axis)) for axis in zip(*points, strict=True)]


def integral(points: Sequence[Point]) -> list[tuple[int, ...]]:
    """Return the points with each axis stretched by its common denominator: integer coordinates.

    This is a linear map whose determinant is positive, the product of the three. It keeps the sign
    of every determinant, multiplies the Jacobian by its own, and so changes no answer. One scale
    for all axes would do as well, but make a determinant up to three times as long.
    """
    scales = denominators(points)
    return [tuple(int(x * s) for x, s in zip(point, scales, strict=True)) for point in points]


def chirotope(points: Sequence[Point]) -> Chirotope:
    """Return the sign (-1, 0 or 1) of every quadruple of the eight points, vertex 1 first."""
    rows = [(1, *point) for point in integral(points)]
    return {
        quadruple: (value > 0) - (value < 0)
        for quadruple in QUADRUPLES
        for value in [determinant([rows[vertex - 1] for vertex in quadruple])]
    }


def dependence(quintuple: Simplex) -> tuple[tuple[int, Simplex, int], ...]:
    """Return (vertex, quadruple without it, sign) for the five vertices of a quintuple.

    By Cramer's rule the coefficients (-1)^i det(quintuple without its i-th vertex) are an affine
    dependence of the five points: coefficient sign = ``sign`` times the chirotope's value.
    """
    return tuple(
        (vertex, quintuple[:i] + quintuple[i + 1 :], (-1) ** i)
        for i, vertex in enumerate(quintuple)
    )


_DEPENDENCES = tuple(map(dependence, QUINTUPLES))


def circuits(signs: Chirotope) -> Iterator[Circuit]:
    """Yield circuits of eight points from their chirotope, each with one of its two signs.

    Lemma. If the eight points are not all in one plane, these are all the circuits.
    Proof. Let the dependence of a quintuple not vanish. Then the five points span R^3, their
    dependences are a line, and this one, having no smaller rival, is a circuit. Conversely take
    any circuit on k points, of affine dimension k-2. Points outside can be added to it one by one,
    each raising the dimension, until the dimension is 3: then there are k + (3 - (k-2)) = 5
    points, they span R^3, and the circuit, being a dependence of theirs, is the only one.
    """
    for terms in _DEPENDENCES:
        coefficients = [(vertex, sign * signs[quadruple]) for vertex, quadruple, sign in terms]
        if any(value for _, value in coefficients):
            yield (
                frozenset(vertex for vertex, value in coefficients if value > 0),
                frozenset(vertex for vertex, value in coefficients if value < 0),
            )
