"""The template: a cube's eight vertices, its facets, symmetries and triangulated boundaries.

Everything is finite and read off the unit cube. The facets are the paper's (section 3): 1234,
1265, 1485, 2376, 3487, 5678. Its list of edges there has 36, a diagonal of its own facet 2376,
where that facet has the edge 37; the facets are what we follow.
"""

from itertools import combinations, permutations, product
from typing import TypeAlias

Simplex: TypeAlias = tuple[int, ...]
"""The vertices of a simplex, in increasing order."""

VERTICES: Simplex = (1, 2, 3, 4, 5, 6, 7, 8)

CORNERS: dict[int, tuple[int, int, int]] = {
    1: (0, 0, 0), 2: (1, 0, 0), 3: (1, 1, 0), 4: (0, 1, 0),
    5: (0, 0, 1), 6: (1, 0, 1), 7: (1, 1, 1), 8: (0, 1, 1),
}  # fmt: skip
"""Vertex -> the corner of the reference cube [0,1]^3 that the trilinear map sends to it."""

FACETS: tuple[Simplex, ...] = (
    (1, 2, 3, 4), (1, 5, 6, 2), (1, 4, 8, 5), (2, 6, 7, 3), (3, 7, 8, 4), (5, 8, 7, 6),
)  # fmt: skip
"""The six quadrilaterals, each in cyclic order, counterclockwise seen from inside the cube."""


def simplex(vertices: tuple[int, ...]) -> Simplex:
    """Return the vertices in increasing order."""
    return tuple(sorted(vertices))


def sorted_with_sign(vertices: tuple[int, ...]) -> tuple[Simplex, int]:
    """Return the vertices in increasing order, and the sign of the permutation that sorts them."""
    inversions = sum(a > b for a, b in combinations(vertices, 2))
    return simplex(vertices), (-1) ** inversions


def _symmetries() -> tuple[tuple[int, ...], ...]:
    """The 48 symmetries of the cube: permute the three axes, then reflect some of them."""
    vertex_at = {corner: vertex for vertex, corner in CORNERS.items()}
    return tuple(
        tuple(
            vertex_at[corner[x] ^ flip[0], corner[y] ^ flip[1], corner[z] ^ flip[2]]
            for corner in CORNERS.values()
        )
        for x, y, z in permutations(range(3))
        for flip in product((0, 1), repeat=3)
    )


SYMMETRIES: tuple[tuple[int, ...], ...] = _symmetries()
"""The 48 relabellings that map the template to itself; entry v-1 of one is the image of v."""


def image(symmetry: tuple[int, ...], face: Simplex) -> Simplex:
    """Return the simplex to which a symmetry takes ``face``."""
    return simplex(tuple(symmetry[vertex - 1] for vertex in face))


def boundary_triangles(diagonals: frozenset[Simplex]) -> dict[Simplex, Simplex]:
    """Return the 12 boundary triangles that the six chosen facet diagonals make.

    The key is the triangle; the value lists its vertices counterclockwise seen from inside.
    """
    oriented = []
    for a, b, c, d in FACETS:
        if simplex((a, c)) in diagonals:
            oriented += [(a, b, c), (a, c, d)]
        else:
            oriented += [(a, b, d), (b, c, d)]
    return {simplex(triangle): triangle for triangle in oriented}


BOUNDARIES: tuple[frozenset[Simplex], ...] = tuple(
    frozenset(choice)
    for choice in product(*((simplex((a, c)), simplex((b, d))) for a, b, c, d in FACETS))
)
"""All 2^6 = 64 triangulations of the boundary, each as its set of six diagonals."""

BOUNDARY_TYPES: dict[str, frozenset[Simplex]] = {
    letter: frozenset(simplex((int(d[0]), int(d[1]))) for d in diagonals.split())
    for letter, diagonals in {
        "a": "13 16 18 36 38 68",
        "b": "13 16 18 27 38 68",
        "c": "13 16 36 45 47 57",
        "d": "13 16 18 27 38 57",
        "e": "13 16 18 27 47 57",
        "f": "13 16 27 38 45 68",
        "g": "13 16 27 38 45 57",
    }.items()
}
"""One representative of each boundary type. The letters are the paper's (big table): this is the
only bijection between types and letters for which every cell of that table has the right count."""


_LETTERS = {
    frozenset(image(symmetry, diagonal) for diagonal in representative): letter
    for letter, representative in BOUNDARY_TYPES.items()
    for symmetry in SYMMETRIES
}


def boundary_letter(diagonals: frozenset[Simplex]) -> str:
    """Return the type a..g of one of the 64 triangulated boundaries.

    A symmetry takes the type's representative to it. There is a letter for each of the 64, and
    only one, because the orbits of the seven representatives have 64 members together, none twice
    (a KeyError would tell of a missing one; theorems.py counts).
    """
    return _LETTERS[diagonals]
