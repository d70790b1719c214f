"""The labelled triangulations of the hexahedron, as tables. Nothing here is trusted.

The 48 symmetries make of the 174 patterns 6,966 labelled triangulations of one hexahedron. They are
made here of the tetrahedra that the certificates name; that there are no others is the theorem
``patterns``, which ``certify check-all`` replays.
"""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from fractions import Fraction
from functools import lru_cache
from pathlib import Path
from typing import TypeAlias

from certify.kernel.certificate import PATTERN_NAMES, read_certificate
from certify.kernel.chirotope import QUADRUPLES, chirotope
from certify.kernel.evidence import Evidence, Malformed, certificate_file
from certify.kernel.hexahedron import (
    BOUNDARIES,
    CORNERS,
    SYMMETRIES,
    Simplex,
    image,
    sorted_with_sign,
)
from certify.kernel.triangulation import (
    NotATriangulation,
    boundary_diagonals,
    orientation,
    shelling,
)

Signed: TypeAlias = tuple[tuple[Simplex, int], ...]

QUADRUPLE_INDEX = {quadruple: index for index, quadruple in enumerate(QUADRUPLES)}
"""Four vertices in increasing order -> their place among the 70 quadruples."""

BOUNDARY_INDEX = {diagonals: index for index, diagonals in enumerate(BOUNDARIES)}
"""Six diagonals -> their place among the 64 triangulated boundaries."""


@dataclass(frozen=True)
class Instance:
    """A labelled triangulation of the hexahedron.

    pattern: its name; boundary: the place of its diagonals among the 64; signs: its tetrahedra in
    increasing order, each with the sign that its determinant has where it is realized.
    """

    pattern: str
    boundary: int
    signs: Signed

    @property
    def tetrahedra(self) -> tuple[Simplex, ...]:
        """The tetrahedra, sorted, each as an increasing quadruple of 1..8."""
        return tuple(tetrahedron for tetrahedron, _ in self.signs)


@lru_cache(maxsize=4)
def instances(root: Path) -> tuple[Instance, ...]:
    """Return all labelled triangulations, by boundary, then in the order of the patterns.

    Raises:
        Malformed: A certificate cannot be read, or has tetrahedra that are no triangulation.
    """
    found = [own for item in certified(root).items() for own in _instances_of(*item)]
    return tuple(sorted(found, key=lambda own: own.boundary))


@lru_cache(maxsize=4)
def certified(root: Path) -> Mapping[str, tuple[Simplex, ...]]:
    """Return the tetrahedra that the certificate of each pattern names.

    Raises:
        Malformed: A certificate cannot be read.
    """
    evidence = Evidence(root)
    found = {}
    for pattern in PATTERN_NAMES:
        try:
            content = evidence.certificate(pattern)
            found[pattern] = read_certificate(pattern, content).tetrahedra
        except Malformed as error:
            raise Malformed(f"{certificate_file(pattern)}: {error}") from None
    return found


def _instances_of(pattern: str, tetrahedra: tuple[Simplex, ...]) -> Iterator[Instance]:
    """Yield the instances of a pattern, sorted by their tetrahedra."""
    try:
        diagonals = boundary_diagonals(tetrahedra)
        shelling(tetrahedra)
    except NotATriangulation as fault:
        raise Malformed(f"{certificate_file(pattern)}: {fault}") from None
    signs = orientation(tetrahedra)
    found = {
        tuple(sorted(_carried(symmetry, signs).items())): frozenset(
            image(symmetry, diagonal) for diagonal in diagonals
        )
        for symmetry in SYMMETRIES
    }
    for own in sorted(found):
        yield Instance(pattern, BOUNDARY_INDEX[found[own]], own)


def _carried(symmetry: tuple[int, ...], signs: dict[Simplex, int]) -> dict[Simplex, int]:
    """Return where a symmetry takes oriented tetrahedra; a reflection mirrors them."""
    turned = handedness(symmetry)
    carried = {}
    for tetrahedron, sign in signs.items():
        moved = tuple(symmetry[vertex - 1] for vertex in tetrahedron)
        target, parity = sorted_with_sign(moved)
        carried[target] = turned * parity * sign
    return carried


def handedness(symmetry: tuple[int, ...]) -> int:
    """Return 1 for a rotation of the cube, -1 for a reflection, by what becomes of a corner."""
    corner, parity = sorted_with_sign(tuple(symmetry[vertex - 1] for vertex in (1, 2, 4, 5)))
    return parity * _CUBE[corner]


_CUBE = chirotope([tuple(map(Fraction, corner)) for corner in CORNERS.values()])
"""The signs of the reference cube, in which corner 1245 is positive."""
