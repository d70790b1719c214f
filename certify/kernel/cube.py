"""The unit cube, exactly and in finite precision (the paper's section 2)."""

from collections.abc import Mapping
from fractions import Fraction
from itertools import combinations

from certify.kernel.chirotope import QUADRUPLES, chirotope
from certify.kernel.embedding import NotRealized, require_realization
from certify.kernel.hexahedron import CORNERS, FACETS, Simplex

CUBE_SIGNS = chirotope([tuple(map(Fraction, corner)) for corner in CORNERS.values()])
"""The chirotope of the vertices of [0,1]^3."""

_TYPE = {3: "corner", 2: "staircase", 1: "slanted", 0: "core"}


def tetrahedron_type(quadruple: Simplex) -> str:
    """Return the type of four vertices of the cube.

    Non-degenerate: corner, staircase, slanted or core, with three, two, one or no triangles on the
    cube's facets. Coplanar: boundary, if the four are a facet; else core diagonal.
    """
    facets = [set(facet) for facet in FACETS]
    if CUBE_SIGNS[quadruple] == 0:
        return "boundary" if set(quadruple) in facets else "core diagonal"
    on_facets = sum(
        any(set(triangle) <= facet for facet in facets) for triangle in combinations(quadruple, 3)
    )
    return _TYPE[on_facets]


TETRAHEDRON_TYPES = {quadruple: tetrahedron_type(quadruple) for quadruple in QUADRUPLES}


def triangulates_cube(orientation: Mapping[Simplex, int]) -> bool:
    """Do the vertices of the unit cube realize the triangulation?"""
    try:
        require_realization(orientation, CUBE_SIGNS)
    except NotRealized:
        return False
    return True


def triangulates_finite_precision_cube(orientation: Mapping[Simplex, int]) -> bool:
    """Does it triangulate the cube once slivers are allowed, and only then?

    A sliver is a core diagonal tetrahedron: four coplanar points that count as a tetrahedron of
    volume zero, of either sign. All other tetrahedra have the sign of their orientation. That is
    enough: the boundary of the ball is mapped once onto that of the cube, so a point in no facet
    of a tetrahedron is covered once, counted with signs, and no sign but the positive occurs.
    """
    slivers = {t for t in orientation if TETRAHEDRON_TYPES[t] == "core diagonal"}
    return bool(slivers) and all(
        CUBE_SIGNS[tetrahedron] == sign
        for tetrahedron, sign in orientation.items()
        if tetrahedron not in slivers
    )
