"""Which pattern is a set of tetrahedra on eight vertices, however these are called?

Six facets with four vertices each make a hexahedron of the boundary's twelve triangles. Every way
to join the triangles in pairs is tried, or only that with the marked facets. If the edges that
remain are those of a cube, the vertices are named after the template, up to its 48 symmetries, and
the tetrahedra compared with those of the certificates. Tetrahedra may be several patterns at once,
with other facets each.
"""

from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import combinations
from pathlib import Path
from typing import TypeAlias

from certify.kernel.certificate import PATTERN_NAMES
from certify.kernel.evidence import default_root
from certify.kernel.hexahedron import (
    CORNERS,
    FACETS,
    SYMMETRIES,
    VERTICES,
    Simplex,
    image,
    simplex,
)
from certify.kernel.triangulation import (
    NotATriangulation,
    boundary_diagonals,
    label,
    shelling,
)
from certify.mesh.instances import certified

Face: TypeAlias = frozenset[str]
"""The names of the vertices of a tetrahedron, a facet, a triangle or an edge."""

Tetrahedra: TypeAlias = tuple[Simplex, ...]
"""Those of a triangulation, sorted, with the vertices of the template."""

Names: TypeAlias = Mapping[str, int]
"""The name of a vertex -> the vertex of the template, 1 to 8."""

_FACETS = frozenset(map(frozenset, FACETS))
_EDGES = frozenset(
    frozenset((a, b))
    for a, b in combinations(VERTICES, 2)
    if sum(x != y for x, y in zip(CORNERS[a], CORNERS[b], strict=True)) == 1
)


class NotNamed(ValueError):
    """The tetrahedra are no pattern; the message says why."""


@dataclass(frozen=True)
class Reading:
    """A pattern, and the renaming of the vertices that makes its certificate's tetrahedra."""

    pattern: str
    names: Names

    def facets(self) -> list[list[str]]:
        """Return the names of the vertices of each of the template's facets, in cyclic order."""
        back = {vertex: name for name, vertex in self.names.items()}
        return [[back[vertex] for vertex in facet] for facet in FACETS]


def readings(
    tetrahedra: Sequence[Iterable[str]],
    facets: Sequence[Iterable[str]] | None = None,
    root: Path | None = None,
) -> list[Reading]:
    """Return the patterns that the tetrahedra are, one for each choice of the facets that fits.

    Args:
        tetrahedra: Four different names of vertices each.
        facets: The marked facets, if they are known: four names each, in any order.
        root: Where the certificates are that the tetrahedra are compared with.

    Raises:
        NotNamed: They are no triangulation of a hexahedron, or none with these facets.
        Malformed: A certificate cannot be read.
    """
    solids = [frozenset(tetrahedron) for tetrahedron in tetrahedra]
    _require_eight(solids)
    marked = None if facets is None else {frozenset(facet) for facet in facets}
    known = {own: pattern for pattern, own in certified(root or default_root()).items()}
    found, faults = [], []
    for names in _hexahedra(_surface(solids), marked):
        own = tuple(sorted(simplex(tuple(names[v] for v in solid)) for solid in solids))
        try:
            boundary_diagonals(own)
            shelling(own)
        except NotATriangulation as fault:
            faults.append(f"with the vertices {_listed(names)} as 1..8: {fault}")
            continue
        found.append(_recognized(own, names, known))
    if not found:
        asked = "" if marked is None else "with the marked facets "
        raise NotNamed(
            faults[0] if faults else f"{asked}the boundary's twelve triangles make no hexahedron"
        )
    return sorted(found, key=lambda reading: PATTERN_NAMES.index(reading.pattern))


def _require_eight(solids: Collection[Face]) -> None:
    vertices = frozenset().union(*solids)
    if len(vertices) != len(VERTICES):
        raise NotNamed(f"the tetrahedra have {len(vertices)} vertices, and a hexahedron has 8")
    for solid in solids:
        if len(solid) != 4:
            raise NotNamed(f"{_listed(solid)} are not four different vertices of a tetrahedron")
    if len(set(solids)) != len(solids):
        raise NotNamed("a tetrahedron is there twice")


def _listed(names: Iterable[str]) -> str:
    return ", ".join(names if isinstance(names, Mapping) else sorted(names))


def _surface(solids: Iterable[Face]) -> list[Face]:
    """Return the triangles in exactly one tetrahedron, sorted; there must be twelve of them."""
    at: dict[Face, int] = {}
    for solid in solids:
        for triangle in map(frozenset, combinations(solid, 3)):
            at[triangle] = at.get(triangle, 0) + 1
    single = sorted((triangle for triangle, times in at.items() if times == 1), key=sorted)
    if len(single) != 12:
        raise NotNamed(
            f"{len(single)} triangles lie in exactly one tetrahedron, and the boundary of a "
            "hexahedron has 12"
        )
    return single


def _hexahedra(triangles: list[Face], marked: set[Face] | None) -> Iterator[Names]:
    """Yield names of the vertices for each way to make a hexahedron of twelve triangles."""
    for facets in _pairings(triangles):
        if marked is None or marked == set(facets):
            names = _names(triangles, facets)
            if names is not None:
                yield names


def _pairings(triangles: list[Face]) -> Iterator[list[Face]]:
    """Yield the ways to join triangles in pairs with a common edge, as the unions of the pairs."""
    if not triangles:
        yield []
        return
    first, *others = triangles
    for other in others:
        if len(first & other) == 2:
            for rest in _pairings([own for own in others if own != other]):
                yield [first | other, *rest]


def _names(triangles: list[Face], facets: list[Face]) -> Names | None:
    """Return a name for each vertex so that the facets and edges are the template's, if they are.

    Names of a corner and its three neighbours determine those of the others, and the symmetries
    make all choices of these equal.
    """
    diagonals = {frozenset(a & b) for a, b in combinations(triangles, 2) if a | b in facets}
    edges = {frozenset(edge) for own in triangles for edge in combinations(own, 2)} - diagonals
    corner = min(frozenset().union(*facets))
    near = sorted(v for edge in edges if corner in edge for v in edge - {corner})
    if len(near) != 3:
        return None
    names = {corner: 1, near[0]: 2, near[1]: 4, near[2]: 5}
    for known, fourth in (((1, 2, 4), 3), ((1, 2, 5), 6), ((1, 4, 5), 8), ((2, 3, 6), 7)):
        three = frozenset(name for name, vertex in names.items() if vertex in known)
        missing = {v for facet in facets if three < facet for v in facet - three}
        names |= dict.fromkeys(missing, fourth)
    named = {frozenset(names.get(v, 0) for v in facet) for facet in facets}
    joined = {frozenset(names.get(v, 0) for v in edge) for edge in edges}
    return names if named == _FACETS and joined == _EDGES else None


def _recognized(own: Tetrahedra, names: Names, known: Mapping[Tetrahedra, str]) -> Reading:
    """Return the pattern that some symmetry makes of a triangulation."""
    for symmetry in SYMMETRIES:
        pattern = known.get(tuple(sorted(image(symmetry, solid) for solid in own)))
        if pattern is not None:
            moved = {name: symmetry[vertex - 1] for name, vertex in names.items()}
            return Reading(pattern, dict(sorted(moved.items(), key=lambda item: item[1])))
    raise NotNamed(
        f"{' '.join(map(label, own))} is no pattern of the certificates, though it triangulates "
        "the hexahedron: one of them is missing"
    )
