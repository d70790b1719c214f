"""The clauses of the kernel's formulas by family, as FORMAT.md names them. Nothing here is trusted.

A family is what section 7, 8 or 5 of CHECKING.md argues at once. The order is that of the formula.
"""

from collections.abc import Iterable, Mapping, Sequence
from typing import TypeAlias

from certify.kernel.certificate import No
from certify.kernel.check import Tetrahedra
from certify.kernel.completeness import edge_clauses, listed, triangle_clauses, vertex_clauses
from certify.kernel.hexahedron import BOUNDARY_TYPES, Simplex, boundary_triangles
from certify.kernel.orientations import (
    Clause,
    exclusive,
    grassmann_pluecker,
    no_overlap,
    on_hull,
    oriented,
)
from certify.kernel.refutation import excluded_signs
from certify.kernel.validity import corners, edges, sections

Families: TypeAlias = dict[str, tuple[Clause, ...]]


def of_question(question: str, answer: No, signs: Mapping[Simplex, int]) -> Families:
    """Return the families of the formula that the answer's proof refutes."""
    families: dict[str, Iterable[Clause]] = {
        "exclusive": exclusive(),
        "Grassmann-Pluecker": grassmann_pluecker(),
        "oriented": oriented(signs),
        "no overlap": no_overlap(signs),
    }
    if question == "convex":
        families["on hull"] = on_hull()
    if question == "valid":
        families |= {"corners": corners(), "edges": edges(), "sections": sections(signs)}
    families["final polynomials"] = map(excluded_signs, answer.final_polynomials)
    return {family: tuple(clauses) for family, clauses in families.items()}


def of_completeness(letter: str, known: Sequence[Tetrahedra]) -> Families:
    """Return the families of the formula that says that a triangulation is missing."""
    boundary = boundary_triangles(BOUNDARY_TYPES[letter]).keys()
    families: dict[str, Iterable[Clause]] = {
        "triangles": triangle_clauses(boundary),
        "edges": edge_clauses(boundary),
        "vertices": vertex_clauses(boundary),
        "listed": map(listed, known),
    }
    return {family: tuple(clauses) for family, clauses in families.items()}
