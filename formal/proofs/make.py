"""Find the proofs in this folder anew.

    python3 formal/proofs/make.py

writes NAME.lrat for the sixteen patterns without a valid hexahedron whose proofs in proofs/ rest on
sections. They refute the formula of Valid.v with the clauses "separations" of Formula.v instead;
for 15_I corners and edges are enough. The solver and this script need not be trusted: the proofs
are checked in Coq. It needs the package's search extra, and nothing that is built needs it.
"""

import json
from collections.abc import Iterator
from pathlib import Path

from certify.kernel.chirotope import QUINTUPLES, dependence
from certify.kernel.orientations import Clause, bracket, has_sign, realization_formula
from certify.kernel.triangulation import orientation
from certify.kernel.validity import across, corners, edges
from certify.search.refutations import lrat, refute

HERE = Path(__file__).resolve().parent
WITHOUT_SECTIONS = ("15_I",)
WITH_SECTIONS = (
    *("11_AD", "11_AE", "12_M", "12_N", "12_T", "12_W", "13_AA", "13_AB"),
    *("13_C", "13_L", "13_Y", "13_Z", "14_Q", "14_S", "15_K"),
)


def separations() -> Iterator[Clause]:
    """No circuit has one side in A and the other in B, if det A and det B have opposite signs."""
    for i, j, k in ((0, 1, 2), (1, 2, 0), (2, 0, 1)):
        a = (1, across(1, j), across(1, k), across(1, j, k))
        b = tuple(across(v, i) for v in a)
        for sign in (1, -1):
            facing = (-bracket(a, sign), -bracket(b, -sign))
            for quintuple in QUINTUPLES:
                coefficient = {
                    (vertex, s): has_sign(quadruple, s * factor)
                    for vertex, quadruple, factor in dependence(quintuple)
                    for s in (1, -1)
                }
                f = [v for v in quintuple if v in a]
                g = [v for v in quintuple if v in b]
                for x, y in ((f, g), (g, f)):
                    escape = [coefficient[v, 1] for v in quintuple if v not in x]
                    escape += [coefficient[v, -1] for v in quintuple if v not in y]
                    for v in x:
                        yield (*facing, -coefficient[v, 1], *escape)
                    for v in y:
                        yield (*facing, -coefficient[v, -1], *escape)


def main() -> None:
    """Write the proofs."""
    for name in (*WITHOUT_SECTIONS, *WITH_SECTIONS):
        certificate = json.loads((HERE.parents[1] / f"certificates/{name}.json").read_text("utf-8"))
        signs = orientation(tuple(map(tuple, certificate["tetrahedra"])))
        formula = [*realization_formula(signs), *corners(), *edges()]
        if name in WITH_SECTIONS:
            formula += separations()
        steps = refute(formula)
        if steps is None:
            raise SystemExit(f"{name}: the formula is satisfiable")
        (HERE / f"{name}.lrat").write_text(lrat(steps), "ascii")


if __name__ == "__main__":
    main()
