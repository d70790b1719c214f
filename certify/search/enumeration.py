"""All triangulations of the hexahedron, from nothing but the template: all models of a CNF."""

from collections.abc import Iterator
from typing import NamedTuple

from pysat.solvers import Solver

from certify.kernel.completeness import INNER, listed, triangulation_formula
from certify.kernel.hexahedron import BOUNDARY_TYPES, Simplex
from certify.kernel.triangulation import boundary_diagonals, orbit

SOLVER = "glucose4"


class Pattern(NamedTuple):
    """A class: its boundary type, and its least instance with the boundary of BOUNDARY_TYPES."""

    boundary: str
    tetrahedra: tuple[Simplex, ...]


def triangulations(diagonals: frozenset[Simplex]) -> Iterator[tuple[Simplex, ...]]:
    """Yield every model of the formula for this boundary, each a sorted tuple of tetrahedra."""
    with Solver(SOLVER, bootstrap_with=triangulation_formula(diagonals)) as solver:
        while solver.solve():
            chosen = zip(INNER, solver.get_model(), strict=False)
            found = tuple(tetrahedron for tetrahedron, literal in chosen if literal > 0)
            yield found
            solver.add_clause(listed(found))


def patterns() -> list[Pattern]:
    """Return all classes of triangulations, by number of tetrahedra and then lexicographically."""
    found = {
        Pattern(letter, min(i for i in orbit(instance) if boundary_diagonals(i) == diagonals))
        for letter, diagonals in BOUNDARY_TYPES.items()
        for instance in triangulations(diagonals)
    }
    return sorted(found, key=lambda pattern: (len(pattern.tetrahedra), pattern.tetrahedra))
