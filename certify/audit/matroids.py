"""Uniform oriented matroids (section 4 of the paper): sign vectors without zero."""

from collections.abc import Callable, Mapping
from typing import TypeAlias

from certify.graphs import Tetrahedra
from certify.kernel.chirotope import QUADRUPLES, circuits
from certify.kernel.hexahedron import Simplex
from certify.kernel.orientations import Clause, has_sign
from certify.kernel.triangulation import orientation
from certify.propagation import Propagator

Formula: TypeAlias = Callable[[Mapping[Simplex, int]], tuple[Clause, ...]]


def uniform_sign_vectors(tetrahedra: Tetrahedra, formula: Formula) -> int | None:
    """Return how many acyclic uniform sign vectors satisfy one of the kernel's formulas.

    Decided by failed literals: a sign is wrong if unit propagation from it reaches a contradiction.
    0: that leaves some quadruple without a sign, even if acyclicity is not asked for. 1: it leaves
    one sign for each, and those satisfy everything. None: neither, so this does not decide it.
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
                    return 0
    left = dict(item for item in signs if item not in wrong)
    true = {has_sign(*item) * (-1 if item in wrong else 1) for item in signs}
    acyclic = all(positive and negative for positive, negative in circuits(left))
    return 1 if acyclic and all(not true.isdisjoint(clause) for clause in clauses) else None
