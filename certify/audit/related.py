"""Section 2: the cube, exact and in finite precision."""

from collections import Counter
from itertools import combinations

from certify.audit.claims import Case, Claim, Truth
from certify.audit.graphs import (
    Tetrahedra,
    around_interior_edges,
    chordless_cycles,
    classes,
    decomposition,
    dual,
    edges,
)
from certify.kernel.cube import (
    CUBE_SIGNS,
    TETRAHEDRON_TYPES,
)
from certify.kernel.hexahedron import (
    CORNERS,
    FACETS,
    SYMMETRIES,
    VERTICES,
    Simplex,
    image,
    inversions,
    simplex,
)

SOLID = ("corner", "staircase", "slanted", "core")
FLAT = ("core diagonal", "boundary")

DIAMETERS = {
    (a, b)
    for a, b in combinations(VERTICES, 2)
    if all(x != y for x, y in zip(CORNERS[a], CORNERS[b], strict=True))
}
"""The pairs of opposite vertices of the cube."""


def _triangles_on_facets(tetrahedron: Simplex) -> int:
    """Return how many of a tetrahedron's triangles are on facets of the cube."""
    return sum(len(set(facet).intersection(tetrahedron)) == 3 for facet in FACETS)


def _types_are_orbits() -> bool:
    """Is each type of tetrahedra all that the symmetries make of any one of them?"""
    orbits = {
        frozenset(image(symmetry, quadruple) for symmetry in SYMMETRIES)
        for quadruple in TETRAHEDRON_TYPES
    }
    return len(orbits) == len({TETRAHEDRON_TYPES[q] for orbit in orbits for q in orbit}) == 6


def _apex_types() -> set[tuple[tuple[str, int], ...]]:
    """Return, for all triangles on a facet, the types that its four possible apexes make."""
    found = set()
    for facet in FACETS:
        for triangle in combinations(facet, 3):
            apexes = (vertex for vertex in VERTICES if vertex not in facet)
            types = Counter(TETRAHEDRON_TYPES[simplex((*triangle, apex))] for apex in apexes)
            found.add(tuple(sorted(types.items())))
    return found


def _edge_lengths(tetrahedron: Simplex) -> set[int]:
    """Return the squared lengths of a tetrahedron's edges in the unit cube."""
    return {
        sum((x - y) ** 2 for x, y in zip(CORNERS[a], CORNERS[b], strict=True))
        for a, b in combinations(tetrahedron, 2)
    }


def _of_the_cube(case: Case) -> list[Tetrahedra]:
    """Return all labelled triangulations of the unit cube."""
    return [
        instance for name in case.cube for instance in sorted(case.facts.patterns[name].instances)
    ]


def _regular_and_diameters(case: Case) -> set[tuple[int, int]]:
    """Return how many regular tetrahedra and diameters a triangulation of the cube may have."""
    return {
        (
            sum(len(_edge_lengths(tetrahedron)) == 1 for tetrahedron in tetrahedra),
            len(edges(tetrahedra) & DIAMETERS),
        )
        for tetrahedra in _of_the_cube(case)
    }


def _with_regular(case: Case) -> list[Tetrahedra]:
    """Return the triangulations of the cube with a regular tetrahedron."""
    return [t for t in _of_the_cube(case) if any(len(_edge_lengths(four)) == 1 for four in t)]


def _told_apart_by_duals(case: Case) -> bool:
    """Are the dual graphs of the cube's classes with a diameter all different?"""
    second = {name for name in case.cube if edges(case.tetrahedra[name]) & DIAMETERS}
    return len(second) == len(classes(case.balls(second), dual)) == 5


def _cycles_are_edges(case: Case) -> bool:
    """In the cube's classes, do the dual graph's chordless cycles go around interior edges?"""
    for name in case.cube:
        size, plain, _ = decomposition(case.tetrahedra[name])
        if chordless_cycles(size, plain) != around_interior_edges(case.tetrahedra[name]):
            return False
    return True


def _prisms(tetrahedra: Tetrahedra) -> list[int]:
    """Return how many tetrahedra are on either side of the only sliver; nothing if there is none.

    Nor is anything returned if there are several slivers, or a tetrahedron on both sides.
    """
    slivers = [t for t in tetrahedra if TETRAHEDRON_TYPES[t] == "core diagonal"]
    if len(slivers) != 1:
        return []
    sliver = slivers[0]
    sides: Counter[int] = Counter()
    for tetrahedron in tetrahedra:
        fours = [(*sliver[:3], v) for v in tetrahedron if v not in sliver]
        touched = {CUBE_SIGNS[simplex(four)] * (-1) ** inversions(four) for four in fours}
        if tetrahedron != sliver:
            if len(touched) != 1:
                return []
            sides.update(touched)
    return sorted(sides.values())


def _patch_weights(u: int, v: int) -> list[int]:
    """Return four times the weights of a facet's vertices at (u/2, v/2) of its bilinear patch."""
    return [(2 - u) * (2 - v), u * (2 - v), u * v, (2 - u) * v]


THE_CUBE = (
    Claim(
        "cube-types",
        "section 2, The cube",
        "A tetrahedron of the cube's vertices is a corner, staircase, slanted or core tetrahedron, "
        "and no two of these types are the same up to symmetry.",
        lambda _: (
            {TETRAHEDRON_TYPES[q] for q in TETRAHEDRON_TYPES if CUBE_SIGNS[q]} == set(SOLID)
            and _types_are_orbits()
        ),
        theorems=("tetrahedra",),
        recomputed="recomputed: orbits of the 70 quadruples",
    ),
    Claim(
        "cube-triangles-on-facets",
        "section 2, The cube",
        "Corner, staircase, slanted and core tetrahedra have three, two, one and no triangle on "
        "the facets of the cube.",
        lambda _: all(
            _triangles_on_facets(q) == 3 - SOLID.index(TETRAHEDRON_TYPES[q])
            for q in TETRAHEDRON_TYPES
            if CUBE_SIGNS[q]
        ),
        recomputed="recomputed: triangles of the 70 quadruples",
    ),
    Claim(
        "cube-four-apexes",
        "section 2, The cube",
        "A triangle on a facet has four apexes that make a tetrahedron, which are three cases.",
        lambda _: _apex_types() == {(("corner", 1), ("slanted", 1), ("staircase", 2))},
        recomputed="recomputed: the 24 triangles on facets with their four apexes",
    ),
    Claim(
        "cube-74",
        "section 2, The cube",
        "The cube has 74 triangulations in 6 classes.",
        lambda case: len(_of_the_cube(case)) == 74 and len(case.cube) == 6,
        theorems=("cube",),
    ),
    Claim(
        "cube-regular-or-diameter",
        "section 2, The cube",
        "Each triangulation of the cube has a regular tetrahedron or a diameter.",
        lambda case: all(sum(found) > 0 for found in _regular_and_diameters(case)),
        theorems=("cube",),
        recomputed="recomputed: edges of the 74 triangulations",
        stronger=Truth(
            "Each has exactly one of the two: one regular tetrahedron or one diameter.",
            lambda case: _regular_and_diameters(case) == {(1, 0), (0, 1)},
        ),
    ),
    Claim(
        "cube-two-of-the-first-type",
        "section 2, The cube",
        "Two triangulations have a regular tetrahedron; a symmetry exchanges them.",
        lambda case: (
            len(_with_regular(case)) == 2
            and any(
                set(_with_regular(case)) == set(case.facts.patterns[name].instances)
                for name in case.cube
            )
        ),
        theorems=("cube",),
        recomputed="recomputed: edges of the 74 triangulations",
    ),
    Claim(
        "cube-dual-complexes",
        "section 2, The cube",
        "The dual complexes tell the classes with a diameter apart.",
        _told_apart_by_duals,
        theorems=("cube",),
        recomputed="recomputed: isomorphism of the dual graphs",
    ),
    Claim(
        "cube-class-sizes",
        "caption of Figure 3",
        "The six classes of the cube have 2 to 24 members each.",
        lambda case: case.facts.instances(case.cube)[::5] == [2, 24],
        theorems=("cube",),
    ),
    Claim(
        "cube-cells",
        "section 2, The cube",
        "A 2-cell of the dual complex stands for an interior edge.",
        _cycles_are_edges,
        theorems=("cube",),
        recomputed="recomputed: chordless cycles of the six dual graphs",
    ),
)

FINITE_PRECISION = (
    Claim(
        "sliver-types",
        "section 2, The 3-cube in finite precision",
        "Two more types of tetrahedra appear in finite precision: core diagonal and boundary.",
        lambda _: (
            {TETRAHEDRON_TYPES[q] for q in TETRAHEDRON_TYPES if not CUBE_SIGNS[q]} == set(FLAT)
        ),
        theorems=("tetrahedra",),
    ),
    Claim(
        "sliver-no-facet",
        "section 2, The 3-cube in finite precision",
        "Core diagonal tetrahedra have no triangle on the boundary, boundary tetrahedra have the "
        "four vertices of a facet.",
        lambda _: (
            {_triangles_on_facets(q) for q, t in TETRAHEDRON_TYPES.items() if t == FLAT[0]} == {0}
            and {q for q, t in TETRAHEDRON_TYPES.items() if t == FLAT[1]}
            == set(map(simplex, FACETS))
        ),
        recomputed="recomputed: triangles of the 70 quadruples",
    ),
    Claim(
        "sliver-prisms",
        "section 2, The 3-cube in finite precision",
        "A core diagonal tetrahedron leaves two prisms of the cube, three tetrahedra each.",
        lambda case: all(_prisms(case.tetrahedra[name]) == [3, 3] for name in case.slivers),
        theorems=("finite-precision-cube",),
        recomputed="recomputed: sides of the sliver's plane in 7_B, 7_C, 7_D, 7_E",
    ),
    Claim(
        "sliver-four",
        "section 2, The 3-cube in finite precision; caption of Figure 5",
        "This gives four more triangulations, of seven tetrahedra.",
        lambda case: case.facts.row(case.slivers) == [0, 0, 4, *[0] * 8],
        theorems=("finite-precision-cube",),
        stronger=Truth(
            "There are no others, however many slivers are allowed: ten patterns in all.",
            lambda case: len(case.cube | case.slivers) == 10,
        ),
    ),
    Claim(
        "sliver-patch",
        "section 2, The 3-cube in finite precision",
        "The bilinear patch of a facet is strictly inside its boundary tetrahedron.",
        lambda _: all(min(_patch_weights(u, v)) > 0 for u in range(3) for v in range(3)),
        recomputed="recomputed: weights of the bilinear patch",
        correction=Truth(
            "Only without its own four edges, which are edges of the tetrahedron.",
            lambda _: all(
                min(_patch_weights(u, v)) >= 0 and (min(_patch_weights(u, v)) > 0) == (u == v == 1)
                for u in range(3)
                for v in range(3)
            ),
        ),
    ),
    Claim(
        "sliver-all-types",
        "section 2, The 3-cube in finite precision",
        "A tetrahedron in a triangulation of the hexahedron is of one of these six types.",
        lambda case: all(
            tetrahedron in TETRAHEDRON_TYPES
            for tetrahedra in case.tetrahedra.values()
            for tetrahedron in tetrahedra
        ),
        theorems=("tetrahedra", "patterns"),
        stronger=Truth(
            "All but the excluded boundary tetrahedra do occur.",
            lambda case: (
                {TETRAHEDRON_TYPES[t] for four in case.tetrahedra.values() for t in four}
                == {*SOLID, "core diagonal"}
            ),
        ),
    ),
)
