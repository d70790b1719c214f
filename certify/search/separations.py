"""Find proofs for Coq: that seventeen patterns carry no valid hexahedron, without plane sections.

    python -m certify.search.separations [FOLDER]

writes NAME.lrat, by default into formal/proofs, for the seventeen patterns whose proofs in proofs/
have clauses of the family "sections". In their place these proofs have "separations", which
formal/Separation.v proves; for 15_B and 15_I corners and edges are enough. Neither the solver nor
this program needs to be trusted: Coq checks the proofs. Nothing that is compiled needs it.
"""

import sys
from collections.abc import Iterator
from pathlib import Path

from certify.kernel.certificate import read_certificate
from certify.kernel.chirotope import QUINTUPLES, dependence
from certify.kernel.evidence import Evidence, default_root
from certify.kernel.orientations import Clause, bracket, has_sign, realization_formula
from certify.kernel.triangulation import orientation
from certify.kernel.validity import across, corners, edges
from certify.search.refutations import lrat, refute

WITHOUT = ("15_B", "15_I")
WITH = (
    *("11_AD", "11_AE", "12_M", "12_N", "12_T", "12_W", "13_AA", "13_AB"),
    *("13_C", "13_L", "13_Y", "13_Z", "14_Q", "14_S", "15_K"),
)
"""The patterns whose proofs need no separations, and those whose proofs do."""


def formula(pattern: str) -> tuple[Clause, ...]:
    """Return the formula of a pattern, in the order of formal/NotValid.v."""
    root = default_root()
    certificate = read_certificate(pattern, Evidence(root).certificate(pattern))
    signs = orientation(certificate.tetrahedra)
    own = separations() if pattern in WITH else ()
    return (*realization_formula(signs), *corners(), *edges(), *own)


def separations() -> Iterator[Clause]:
    """Yield: no circuit has a side in each of two opposite facets that face one another.

    The tetrahedra A and B of opposite facets have determinants of opposite signs then, and by
    formal/Separation.v there is a plane with A on one side and B on the other.
    """
    for i, j, k in ((0, 1, 2), (1, 2, 0), (2, 0, 1)):
        a = (1, across(1, j), across(1, k), across(1, j, k))
        b = tuple(across(v, i) for v in a)
        for sign in (1, -1):
            facing = (-bracket(a, sign), -bracket(b, -sign))
            for quintuple in QUINTUPLES:
                yield from _separated(facing, quintuple, a, b)


def _separated(
    facing: Clause, quintuple: tuple[int, ...], a: tuple[int, ...], b: tuple[int, ...]
) -> Iterator[Clause]:
    positive, negative = (
        {v: has_sign(quadruple, s * factor) for v, quadruple, factor in dependence(quintuple)}
        for s in (1, -1)
    )
    f, g = ([v for v in quintuple if v in side] for side in (a, b))
    for x, y in ((f, g), (g, f)):
        escape = [positive[v] for v in quintuple if v not in x]
        escape += [negative[v] for v in quintuple if v not in y]
        yield from ((*facing, -positive[v], *escape) for v in x)
        yield from ((*facing, -negative[v], *escape) for v in y)


def main() -> None:
    """Write the proofs."""
    folder = Path(sys.argv[1]) if len(sys.argv) > 1 else default_root() / "formal" / "proofs"
    for name in (*WITHOUT, *WITH):
        steps = refute(formula(name))
        if steps is None:
            raise SystemExit(f"{name}: the formula is satisfiable")
        (folder / f"{name}.lrat").write_text(lrat(steps), "ascii")


if __name__ == "__main__":
    main()
