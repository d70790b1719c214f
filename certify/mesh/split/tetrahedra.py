"""The tetrahedra of a mesh whose quadrilaterals are cut; and those of a fixed recipe."""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from certify.kernel.certificate import PATTERN_NAMES
from certify.kernel.evidence import default_root
from certify.mesh.files import positive
from certify.mesh.realized import labelled
from certify.mesh.shapes import least_dihedral_angles, mean_ratios
from certify.mesh.signs import Floats, orientations
from certify.mesh.split.choices import Choices, figures
from certify.mesh.split.faces import NONE, SLOTS, Faces
from certify.mesh.split.kinds import QUADRILATERALS, WIDTHS, Rows, fillings, surface


@dataclass(frozen=True)
class Tetrahedra:
    """Tetrahedra (t, 4), by cell, each positive in the order of its vertices.

    cells: (t,) the cell of each. patterns: (t,) the place in PATTERN_NAMES, from 1, of the
    triangulation of which it is part; 0 if its cell is no hexahedron, or if it is a boundary
    tetrahedron that was laid on a facet.
    """

    vertices: Rows
    cells: Rows
    patterns: Rows


def tetrahedra_of(
    faces: Faces, choices: Choices, numbers: Rows, root: Path | None = None
) -> Tetrahedra:
    """Return the best fillings of all cells, if these have these numbers."""
    parts = [*_parts(faces, choices, numbers, root or default_root())]
    vertices, cells, patterns = (np.concatenate(own) for own in zip(*parts, strict=True))
    order = np.argsort(cells, kind="stable")
    return Tetrahedra(vertices[order], cells[order], patterns[order])


def _parts(
    faces: Faces, choices: Choices, numbers: Rows, root: Path
) -> Iterator[tuple[Rows, Rows, Rows]]:
    for kind, rows in faces.cells.items():
        cells = np.arange(faces.start(kind), faces.start(kind) + len(rows))
        best = choices.arrays.best[cells, numbers[cells]].astype(np.int64)
        table, patterns = _table(kind, root)
        own = table[best]
        used = own[:, :, 0] >= 0
        which, place = np.nonzero(used)
        local = own[which, place]
        yield rows[which[:, None], local], cells[which], patterns[best][which]
        laid = choices.arrays.laid[cells, numbers[cells]]
        yield from _laid(kind, rows, cells, numbers[cells] ^ faces.turns[cells], laid)


def _laid(
    kind: str, rows: Rows, cells: Rows, choice: Rows, laid: NDArray[np.uint8]
) -> Iterator[tuple[Rows, Rows, Rows]]:
    """Yield the boundary tetrahedra on each facet."""
    facets = QUADRILATERALS[kind]
    for place, (a, b, c, d) in enumerate(facets):
        shift = len(facets) - 1 - place
        own = np.flatnonzero(laid >> shift & 1)
        other = choice[own, None] >> shift & 1 == 1
        vertices = np.where(other, rows[own][:, [a, b, d, c]], rows[own][:, [a, b, c, d]])
        yield vertices, cells[own], np.zeros(len(own), np.int64)


@lru_cache(maxsize=8)
def _table(kind: str, root: Path) -> tuple[Rows, Rows]:
    """Return the tetrahedra of all fillings of a cell, -1 where there are no more; and patterns."""
    names = {name: number for number, name in enumerate(PATTERN_NAMES, start=1)}
    if kind == "hexahedron":
        every = [
            ([positive(tuple(v - 1 for v in t), sign) for t, sign in own.signs], names[own.pattern])
            for own in labelled(root)
        ]
    elif kind == "tetra":
        every = [([(0, 1, 2, 3)], 0)]
    else:
        every = [([positive(*own) for own in filling.signs], 0) for filling in fillings(kind)]
    table = np.full((len(every), max(len(own) for own, _ in every), 4), -1, np.int64)
    for row, (own, _) in zip(table, every, strict=True):
        row[: len(own)] = own
    return table, np.array([pattern for _, pattern in every], np.int64)


def by_numbers(faces: Faces) -> tuple[Rows, Rows]:
    """Return what a fixed recipe makes of a mesh: tetrahedra, and the cell of each.

    Every quadrilateral is cut through its least vertex (Dompierre, Labbé, Vallet and Camarero 1999,
    "How to subdivide pyramids, prisms and hexahedra into tetrahedra"); and every cell is the cone
    of its least vertex over the triangles of its surface that do not have it. Both cells of a
    quadrilateral cut it in the same way; that a tetrahedron is positive nobody says.
    """
    return _cones(faces, faces.cells)


def by_template(faces: Faces) -> tuple[Rows, Rows, int]:
    """Return what one template for all cells of a kind makes of a mesh; and how many disagreements.

    A hexahedron becomes six tetrahedra around the diagonal from its first vertex to its seventh.
    Disagreements are quadrilaterals that their two cells cut in different ways.
    """
    ranks = {kind: np.tile(_ORDER[: WIDTHS[kind]], (len(r), 1)) for kind, r in faces.cells.items()}
    numbers = np.concatenate([_choices(kind, own) for kind, own in ranks.items()]) ^ faces.turns
    bits = numbers[:, None] >> np.arange(SLOTS) & 1
    used = faces.slots != NONE
    seen = np.zeros((len(faces.sides), 2), np.bool_)
    seen[faces.slots[used], bits[used]] = True
    return *_cones(faces, ranks), int(seen.all(axis=1).sum())


_ORDER = np.array([0, 2, 3, 4, 5, 6, 1, 7])
"""The seventh vertex comes next to the first."""


def _choices(kind: str, ranks: Rows) -> Rows:
    """Return how each cell is cut if every quadrilateral is so through its vertex of least rank."""
    out = np.zeros(len(ranks), np.int64)
    for quad in QUADRILATERALS[kind]:
        out = 2 * out + ranks[:, quad].argmin(axis=1) % 2
    return out


def _cones(faces: Faces, ranks: Mapping[str, Rows]) -> tuple[Rows, Rows]:
    """Return the cones of the vertices of least rank over the other sides of their cells."""
    vertices, cells = [], []
    for kind, rows in faces.cells.items():
        triangles = _surfaces(kind)[_choices(kind, ranks[kind])]
        least = ranks[kind].argmin(axis=1)
        which, place = np.nonzero((triangles != least[:, None, None]).all(axis=2))
        local = np.column_stack([triangles[which, place], least[which]])
        vertices.append(rows[which[:, None], local])
        cells.append(which + faces.start(kind))
    return np.concatenate(vertices), np.concatenate(cells)


@lru_cache(maxsize=8)
def _surfaces(kind: str) -> Rows:
    return np.array([surface(kind, n) for n in range(2 ** len(QUADRILATERALS[kind]))], np.int64)


@dataclass(frozen=True)
class Shape:
    """How good tetrahedra are. not_positive: how many are inverted or flat; cells: in how many.

    disagreements: how many quadrilaterals their two cells cut in different ways.
    angles and ratios are those of the positive ones: least dihedral angles in degrees, mean ratios.
    """

    tetrahedra: int
    not_positive: int
    cells: int
    angles: Floats
    ratios: Floats
    disagreements: int = 0


def shape(points: NDArray[Any], vertices: Rows, cells: Rows, disagreements: int = 0) -> Shape:
    """Return how good tetrahedra are; ``cells`` are theirs."""
    good = orientations(points, vertices) > 0
    own = figures(points[vertices[good]])
    return Shape(
        len(vertices),
        int((~good).sum()),
        len(np.unique(cells[~good])),
        least_dihedral_angles(own),
        mean_ratios(own),
        disagreements,
    )
