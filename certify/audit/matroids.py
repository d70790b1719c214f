"""Uniform oriented matroids (section 4 of the paper): sign vectors without zero."""

from collections.abc import Callable, Mapping
from typing import TypeAlias

from certify.graphs import Tetrahedra
from certify.kernel.chirotope import QUADRUPLES, circuits
from certify.kernel.hexahedron import Simplex
from certify.kernel.orientations import Clause, has_sign
from certify.kernel.triangulation import orientation
from certify.propagation import Propagator

SignVector: TypeAlias = dict[Simplex, int]
Formula: TypeAlias = Callable[[Mapping[Simplex, int]], tuple[Clause, ...]]


def uniform_sign_vectors(tetrahedra: Tetrahedra, formula: Formula) -> list[SignVector] | None:
    """Return the acyclic uniform sign vectors that satisfy one of the kernel's formulas.

    Decided by failed literals: a sign is wrong if unit propagation from it reaches a contradiction.
    If that leaves some quadruple without a sign, even though acyclicity is not asked for, there is
    none. If it leaves one sign for each, and those satisfy everything, there is one. Otherwise this
    does not decide it, and the value is None.
    """
    signs = [(quadruple, sign) for quadruple in QUADRUPLES for sign in (1, -1)]
    clauses = list(formula(orientation(tetrahedra)))
    clauses += [(has_sign(quadruple, 1), has_sign(quadruple, -1)) for quadruple in QUADRUPLES]
    propagator = Propagator(clauses)
    wrong: set[tuple[Simplex, int]] = set()
    for quadruple, sign in (*signs, *signs):
        if wrong.isdisjoint({(quadruple, 1), (quadruple, -1)}):
            literal = has_sign(quadruple, sign)
            if propagator.implies((-literal,)):
                wrong.add((quadruple, sign))
                propagator.add((-literal,))
                if propagator.implies(()):
                    return []
    left = dict(item for item in signs if item not in wrong)
    true = {has_sign(*item) * (-1 if item in wrong else 1) for item in signs}
    acyclic = all(positive and negative for positive, negative in circuits(left))
    return [left] if acyclic and all(not true.isdisjoint(clause) for clause in clauses) else None
