"""The question and its answer: can a mesh be split into tetrahedra, and how, or why not?"""

from collections import Counter
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from certify.kernel.certificate import PATTERN_NAMES
from certify.mesh.curve import along_the_curve
from certify.mesh.overlaps import coincident, nearest, overlap, sides
from certify.mesh.reading import BadMesh
from certify.mesh.realized import embedded
from certify.mesh.signs import Numbers, numbers
from certify.mesh.split.checking import require_split
from certify.mesh.split.choices import Choices, Show, choices_of, corners, require_right_way
from certify.mesh.split.contradictions import Contradiction, contradictions
from certify.mesh.split.faces import NONE, Faces, faces_of
from certify.mesh.split.kinds import WIDTHS, Rows, signs_of, way_round
from certify.mesh.split.solving import QUALITIES, numbers_of, solved, whole
from certify.mesh.split.tetrahedra import (
    Shape,
    Tetrahedra,
    by_numbers,
    by_template,
    shape,
    tetrahedra_of,
)


class Unfillable(NamedTuple):
    """A cell that no tetrahedra on its vertices fill, however its quadrilaterals are cut.

    boundaries: how many ways there are to cut them; crossing: in how many of these the triangles
    cross each other, None if it is no hexahedron; corners: its vertices at which the edges are not
    positively oriented.
    """

    cell: int
    boundaries: int
    crossing: int | None
    corners: tuple[int, ...]


@dataclass(frozen=True)
class Answer:
    """Either ``tetrahedra``, which were checked; or cells that no choice of diagonals fills.

    points: an array (n, 3) of float64 or of Fractions. unfillable: cells that each by itself cannot
    be filled. contradictions: sets of others that cannot be filled together.
    """

    points: NDArray[Any]
    faces: Faces
    choices: Choices
    tetrahedra: Tetrahedra | None
    unfillable: tuple[int, ...]
    contradictions: tuple[Contradiction, ...]

    @cached_property
    def shape(self) -> Shape | None:
        """How good the tetrahedra are."""
        own = self.tetrahedra
        return shape(self.points, own.vertices, own.cells) if own else None

    @cached_property
    def by_numbers(self) -> Shape:
        """How good those are that a recipe by the numbers of vertices makes of the same mesh."""
        return shape(self.points, *by_numbers(self.faces))

    @cached_property
    def by_template(self) -> Shape:
        """How good those are that one template makes of the same mesh."""
        return shape(self.points, *by_template(self.faces))

    @property
    def beyond_numbers(self) -> int:
        """How many cells no tetrahedra fill if each quadrilateral is cut at its least number."""
        return int((self.choices.allowed & np.uint64(1) == 0).sum())

    @cached_property
    def patterns(self) -> dict[str, int]:
        """How many hexahedra have which pattern, the most frequent first."""
        if self.tetrahedra is None:
            return {}
        own = self.tetrahedra.patterns
        pairs = np.unique(np.column_stack([self.tetrahedra.cells, own])[own > 0], axis=0)
        found = Counter(PATTERN_NAMES[pattern - 1] for pattern in pairs[:, 1].tolist())
        return dict(sorted(found.items(), key=lambda item: (-item[1], item[0])))

    @property
    def laid(self) -> int:
        """How many boundary tetrahedra are laid on hexahedra."""
        if self.tetrahedra is None:
            return 0
        hexahedra = len(self.faces.cells.get("hexahedron", ()))  # they come first
        own = self.tetrahedra
        return int(((own.patterns == 0) & (own.cells < hexahedra)).sum())

    def why(self, cell: int) -> Unfillable:
        """Return what is known about a cell that cannot be filled."""
        kind, index = self.faces.place(cell)
        row = self.faces.cells[kind][index : index + 1]
        ways = int(2 ** (self.faces.slots[cell] != NONE).sum())
        crossing = None
        if kind == "hexahedron":
            crossing = int((~embedded(signs_of(self.points, kind, row))).sum())
        bad = corners(self.points, kind, row)[0] <= 0
        return Unfillable(cell, ways, crossing, tuple(row[0][: len(bad)][bad].tolist()))


def split(
    points: Numbers,
    cells: Mapping[str, Rows],
    quality: str = "greedy",
    root: Path | None = None,
    show: Show | None = None,
) -> Answer:
    """Split a mesh into tetrahedra without further vertices, or find out why that is impossible.

    Both answers are exact: the signs of determinants are those of the numbers given, the tetrahedra
    were checked by require_split, and there are no others than those that were tried.

    Args:
        points: An array (n, 3) of integers, floating-point numbers or Fractions.
        cells: Kind -> array of indices from 0, one row for each cell, in the order of VTK: kinds
            are hexahedron, wedge, pyramid and tetra. A wedge may be either way round.
        quality: One of QUALITIES; see solving.py.
        root: Where the certificates are whose tetrahedra are used.
        show: Is told what is done, and how much of how much.

    Raises:
        BadMesh: The cells do not fit together or overlap, one is inside out, or two vertices are
            the same point; the message names a cell.
        ValueError: An argument is not what it should be.
        NotSplit: The tetrahedra were refused: a mistake in this program.
    """
    if quality not in QUALITIES:
        raise ValueError(f"unknown quality {quality!r}; it must be one of {', '.join(QUALITIES)}")
    given = numbers(points)
    if not any(map(len, cells.values())):
        raise ValueError("there are no cells")
    if given.ndim != 2 or given.shape[1] != 3:
        raise ValueError(f"the array has the shape {given.shape} instead of (n, 3)")
    own = {kind: np.asarray(rows, np.int64) for kind, rows in cells.items() if len(rows)}
    for kind, rows in own.items():
        if kind not in WIDTHS or rows.ndim != 2 or rows.shape[1] != WIDTHS[kind]:
            raise ValueError(f"{kind} cells of the shape {rows.shape} are unknown")
        if rows.min() < 0 or rows.max() >= len(given):
            raise ValueError(f"a {kind} has a vertex that does not exist")
    _require_different(given, own)
    if "wedge" in own:
        own["wedge"] = way_round(given, own["wedge"])
    require_right_way(given, own)
    faces = faces_of(own)
    choices = choices_of(given, faces, root, show)
    empty = choices.allowed == 0
    allowed = np.where(empty, whole(faces.slots), choices.allowed)
    asked = "none" if empty.any() else quality
    cut = solved(faces.slots, faces.sides, allowed, choices.arrays.quality, asked, show)
    if cut is None:
        found = contradictions(faces.slots, allowed, np.flatnonzero(~empty).tolist())
        return _no(given, faces, choices, found)
    if empty.any():
        return _no(given, faces, choices, [])
    tetrahedra = tetrahedra_of(faces, choices, numbers_of(faces.slots, cut), root)
    if show:
        show("checking tetrahedra", 0, len(tetrahedra.vertices))
    require_split(given, own, tetrahedra.vertices, tetrahedra.cells)
    _require_apart(given, faces, tetrahedra)
    return Answer(given, faces, choices, tetrahedra, (), ())


def _require_different(points: NDArray[Any], cells: Mapping[str, Rows]) -> None:
    """Raise BadMesh if two vertices are the same point: cells that meet there are not joined."""
    if pair := coincident(points, cells.values()):
        kind = next(kind for kind, rows in cells.items() if (rows == pair[1]).any())
        number = int((cells[kind] == pair[1]).any(axis=1).argmax()) + 1
        raise BadMesh(
            f"{kind} {number} has point {pair[1] + 1}, which is the same as point {pair[0] + 1}"
        )


def _require_apart(points: NDArray[Any], faces: Faces, tetrahedra: Tetrahedra) -> None:
    """Raise BadMesh if tetrahedra overlap; they are of different cells, by require_split."""
    order = along_the_curve(nearest(points)[tetrahedra.vertices[:, 0]])
    along = tetrahedra.vertices[order]
    _, _, outside = sides(len(points), along)
    if pair := overlap(points, along, outside):
        one, other = (faces.name(cell) for cell in sorted(tetrahedra.cells[order[[*pair]]]))
        raise BadMesh(f"{one} and {other} overlap, at least as their quadrilaterals are cut here")


def _no(points: NDArray[Any], faces: Faces, choices: Choices, found: list[Contradiction]) -> Answer:
    unfillable = np.flatnonzero(choices.allowed == 0).tolist()
    return Answer(points, faces, choices, None, tuple(unfillable), tuple(found))
