"""Final polynomials by linear programming: sign vectors that no eight points have."""

from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from itertools import combinations, permutations
from math import gcd, lcm, prod
from typing import NamedTuple

import cvxpy as cp
import numpy as np
from numpy.typing import NDArray
from sympy import QQ
from sympy.polys.matrices import DomainMatrix

from certify.kernel.chirotope import QUADRUPLES
from certify.kernel.hexahedron import VERTICES, Simplex, simplex, sorted_with_sign
from certify.kernel.orientations import Clause, has_sign
from certify.kernel.refutation import Brackets, FinalPolynomial, excluded_signs, products
from certify.search.refutations import Step, model, refute


class Inequality(NamedTuple):
    """|A| >= |B|, from A = B - C (see refutation.py): the brackets of A, of B and of C."""

    indices: tuple[int, ...]
    larger: Brackets
    smaller: Brackets
    rest: Brackets
    strict: bool


def refute_with_polynomials(
    formula: Sequence[Clause],
) -> tuple[list[Step], list[FinalPolynomial]] | None:
    """Return a proof and the final polynomials it needs, or None if a sign vector has none."""
    polynomials: list[FinalPolynomial] = []
    clauses = list(formula)
    while assignment := model(clauses):
        polynomial = final_polynomial(sign_vector(assignment))
        if polynomial is None:
            return None
        polynomials.append(polynomial)
        clauses.append(excluded_signs(polynomial))
    steps = refute(clauses)
    return (steps, polynomials) if steps else None


def sign_vector(assignment: Sequence[int]) -> dict[Simplex, int]:
    """Return the sign of every quadruple under an assignment of the formula's variables."""
    true = set(assignment)
    return {q: (has_sign(q, 1) in true) - (has_sign(q, -1) in true) for q in QUADRUPLES}


def inequalities(signs: Mapping[Simplex, int]) -> Iterator[Inequality]:
    """Yield the inequalities that the three-term Grassmann-Pluecker relations imply."""

    def product(brackets: Brackets) -> int:
        factors = map(sorted_with_sign, brackets)
        return prod(parity * signs[quadruple] for quadruple, parity in factors)

    for s in combinations(VERTICES, 2):
        for four in combinations([v for v in VERTICES if v not in s], 4):
            # The first of the four stays first: [sab][scd] is the same up to sign for
            # the other orders that keep the pair {ab, cd}.
            for b, c, d in permutations(four[1:]):
                indices = (*s, four[0], b, c, d)
                larger, smaller, rest = products(indices)
                sign, sign_rest = product(smaller), product(rest)
                if sign not in (0, sign_rest):
                    yield Inequality(indices, larger, smaller, rest, sign_rest != 0)


def final_polynomial(signs: Mapping[Simplex, int]) -> FinalPolynomial | None:
    """Return a biquadratic final polynomial that excludes the sign vector, if there is one.

    Bokowski and Richter 1990: multipliers x >= 0 of the inequalities such that every determinant
    cancels and some strict inequality counts. A basic solution has linearly independent columns,
    so its support determines it and it can be made exact. The inequalities cost different amounts,
    drawn at random: the cheapest solution is then the only one, whatever rounding errors do.
    """
    candidates = list(inequalities(signs))
    exponents = np.array([exponent_vector(candidate) for candidate in candidates]).T
    strict = np.array([candidate.strict for candidate in candidates], dtype=float)
    x = cp.Variable(len(candidates), nonneg=True)
    costs = np.random.default_rng(0).integers(100, 1000, len(candidates))
    problem = cp.Problem(cp.Minimize(costs @ x), [exponents @ x == 0, strict @ x == 1])
    problem.solve(solver=cp.SCIPY, scipy_options={"method": "highs-ds"})
    if x.value is None:
        return None
    support = [i for i, value in enumerate(x.value) if value > 1e-9]
    used = [candidates[i] for i in support]
    multipliers = integer_kernel_vector(exponents[:, support])
    assumed = {simplex(bracket) for c in used for bracket in (*c.smaller, *c.rest)}
    return FinalPolynomial(
        {q: signs[q] for q in QUADRUPLES if q in assumed},
        tuple((m, c.indices) for m, c in zip(multipliers, used, strict=True)),
    )


def exponent_vector(inequality: Inequality) -> list[int]:
    """Return how often each determinant occurs on the larger side, less on the smaller."""
    surplus = Counter(map(simplex, inequality.larger))
    surplus.subtract(map(simplex, inequality.smaller))
    return [surplus[q] for q in QUADRUPLES]


def integer_kernel_vector(matrix: NDArray[np.int64]) -> list[int]:
    """Return the positive integer vector that spans the kernel of an integer matrix."""
    rows = [[QQ(int(entry)) for entry in row] for row in matrix]
    (vector,) = DomainMatrix(rows, matrix.shape, QQ).nullspace().to_list()
    scale = lcm(*(int(entry.denominator) for entry in vector))
    integers = [abs(int(entry * scale)) for entry in vector]
    return [entry // gcd(*integers) for entry in integers]
