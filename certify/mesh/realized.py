"""Which triangulations do eight points realize? Exactly, and for many hexahedra at once.

Lemma. Let the eight points have a mapping of a triangulation of the hexahedron to R^3, linear on
each tetrahedron. It is a realization iff every determinant has its tetrahedron's sign, and the
twelve triangles of the boundary meet only in common faces.
Proof. Only if is clear. If: the boundary is then an embedded sphere, and winds once around what it
encloses, not at all around the rest. A point y on no image of a triangle lies in as many images of
tetrahedra as the boundary winds around it, since all are oriented alike: in one or none. So
tetrahedra share no interior points. At a point x inside the ball the mapping is then open: so it is
inside a tetrahedron, and inside a triangle, whose two tetrahedra lie on its two sides; around an
edge the tetrahedra wind, and had they wound twice they would share interior points; and there are
no vertices inside. Let x != x' have the same image. If one of them is inside the ball, a
neighbourhood of it covers one of the image, which contains interior points of the image of a
tetrahedron at the other: shared ones. If both are on the boundary, they are the same, as it is
embedded. So the mapping is injective, which is what a realization is.

The triangles of a boundary meet only in common faces iff no circuit has its two sides in two of
them (the lemma of certify/kernel/embedding.py, whose proof holds for triangles as it stands, if
they are not degenerate; and they are faces of tetrahedra that are not). So the signs of the 56
quintuples, looked up in a table of 56 * 3^5 sets of boundaries, tell which of the 64 boundaries are
embedded, and a comparison of bits tells which of their triangulations have the right signs.

A *boundary tetrahedron* has the four vertices of one facet. A triangulation without further points
that has some is one of ours with boundary tetrahedra laid on it, each of which exchanges the
diagonal of its facet: the outer edge of such a tetrahedron lies in no other, so it meets the others
in two triangles, and the rest is a ball. The lemma holds for these as well.
"""

from dataclasses import dataclass
from functools import lru_cache
from itertools import combinations, product
from pathlib import Path
from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray

from certify.kernel.chirotope import QUADRUPLES, QUINTUPLES, dependence
from certify.kernel.evidence import default_root
from certify.kernel.hexahedron import (
    BOUNDARIES,
    FACETS,
    Simplex,
    boundary_triangles,
    sorted_with_sign,
)
from certify.mesh.compiled import compiled
from certify.mesh.instances import QUADRUPLE_INDEX, Instance, instances
from certify.mesh.signs import Numbers, Signs
from certify.mesh.signs import signs as signs_of

Booleans: TypeAlias = NDArray[np.bool_]
Words: TypeAlias = NDArray[np.uint64]

WORD = 64
"""The 70 quadruples are bits of two words."""


def triangulations(points: Numbers, root: Path | None = None) -> Booleans:
    """Return which labelled triangulations of the hexahedron the points realize.

    A mirrored realization is none here: determinants have the signs of the reference cube. For
    those, ask with the points mirrored.

    Args:
        points: An array (n, 8, 3) of integers, floating-point numbers or Fractions; vertex 1 first,
            in the order of the template, which is that of VTK.
        root: Where the certificates are whose tetrahedra are asked for.

    Returns:
        An array (n, 6966), its columns in the order of :func:`labelled`.

    Raises:
        ValueError: The array has another shape, or what is in it are no finite numbers.
        Malformed: A certificate cannot be read.

    >>> from certify.kernel.hexahedron import CORNERS
    >>> int(triangulations([list(CORNERS.values())]).sum())
    74
    """
    return realized(signs_of(points), root)


def labelled(root: Path | None = None) -> tuple[Instance, ...]:
    """Return the 6,966 labelled triangulations, in the order of the columns."""
    return instances(root or default_root())


def realized(chirotopes: Signs, root: Path | None = None) -> Booleans:
    """Return which labelled triangulations are realized, by the signs (n, 70) of the points."""
    tables = _tables(root or default_root())
    out = np.zeros((len(chirotopes), len(tables.needs)), np.bool_)
    excluded = _crossed(chirotopes, tables.quintuples, tables.crossed)
    _compare(chirotopes, excluded, tables.needs, tables.starts, out)
    return out


def embedded(chirotopes: Signs) -> Booleans:
    """Return which of the 64 boundaries have triangles that meet only in common faces: (n, 64).

    That is so if the triangles are not degenerate; those of a realized triangulation are not.
    """
    quintuples, crossed = _circuit_tables()
    bits = np.arange(len(BOUNDARIES), dtype=np.uint64)
    out: Booleans = (_crossed(chirotopes, quintuples, crossed)[:, None] >> bits) % 2 == 0
    return out


def fillable(found: Booleans, root: Path | None = None) -> Booleans:
    """Return which of the 64 boundaries have a realized triangulation: (n, 64)."""
    out: Booleans = np.logical_or.reduceat(
        found, _tables(root or default_root()).starts[:-1], axis=1
    )
    return out


def fillable_at_all(chirotopes: Signs, root: Path | None = None) -> Booleans:
    """Return which of the 64 boundaries can be filled, be it with boundary tetrahedra: (n, 64).

    That a boundary which is none of these has no triangulation without further points rests on the
    theorem ``patterns``: there are no others than the 6,966.
    """
    tables = _tables(root or default_root())
    oriented = np.zeros((len(chirotopes), len(tables.needs)), np.bool_)
    nothing = np.zeros(len(chirotopes), np.uint64)
    _compare(chirotopes, nothing, tables.needs, tables.starts, oriented)
    inside = fillable(oriented, root)
    laid = [chirotopes[:, index] * parity for index, parity in _FACET_SIGNS]
    out = np.zeros_like(inside)
    for outer, flipped in product(range(len(BOUNDARIES)), repeat=2):
        own = inside[:, outer ^ flipped]
        for facet, signs in enumerate(laid):
            bit = 1 << (len(laid) - 1 - facet)
            if flipped & bit:
                own = own & (signs == (-1 if outer & bit else 1))
        out[:, outer] |= own
    at_all: Booleans = out & embedded(chirotopes)
    return at_all


_FACET_SIGNS = [(QUADRUPLE_INDEX[own], sign) for own, sign in map(sorted_with_sign, FACETS)]
"""For each facet abcd its quadruple, and the sign of abcd relative to that.

With the diagonal ac the triangle abc is seen counterclockwise from inside, so that the tetrahedron
lies inside if its sign is positive; with bd, if it is negative.
"""


@dataclass(frozen=True)
class _Tables:
    """The 64 boundaries, and the triangulations that fill them, as numbers.

    quintuples, crossed: see _circuit_tables; needs: for each triangulation four words, the
    quadruples that are positive in it and those that are negative; starts: where the triangulations
    of each of the boundaries begin, and the end.
    """

    quintuples: NDArray[np.int64]
    crossed: Words
    needs: Words
    starts: NDArray[np.int64]


@lru_cache(maxsize=4)
def _tables(root: Path) -> _Tables:
    every = instances(root)
    needs = np.array([_bits(own) for own in every], np.uint64)
    starts = np.searchsorted([own.boundary for own in every], np.arange(len(BOUNDARIES) + 1))
    return _Tables(*_circuit_tables(), needs, starts.astype(np.int64))


def _bits(instance: Instance) -> list[int]:
    """Return the positive and the negative quadruples of a triangulation, two words each."""
    words = [0, 0, 0, 0]
    for tetrahedron, sign in instance.signs:
        word, bit = divmod(QUADRUPLE_INDEX[tetrahedron], WORD)
        words[word + (0 if sign > 0 else 2)] |= 1 << bit
    return words


@lru_cache(maxsize=1)
def _circuit_tables() -> tuple[NDArray[np.int64], Words]:
    """Return for each quintuple its five quadruples, and the boundaries that its circuit excludes.

    The second is an array (56, 3^5) of words with a bit for each of the 64 boundaries. Its column
    is the number with the digits sign + 1 of the five quadruples, the most significant first.
    """
    faces = [_faces(diagonals) for diagonals in BOUNDARIES]
    quintuples = [dependence(quintuple) for quintuple in QUINTUPLES]
    crossed = [
        [
            _excluded([(t[0], t[2] * sign) for t, sign in zip(terms, signs, strict=True)], faces)
            for signs in product((-1, 0, 1), repeat=5)
        ]
        for terms in quintuples
    ]
    places = [[QUADRUPLE_INDEX[quadruple] for _, quadruple, _ in terms] for terms in quintuples]
    return np.array(places, np.int64), np.array(crossed, np.uint64)


def _faces(diagonals: frozenset[Simplex]) -> set[frozenset[int]]:
    """Return the faces of a boundary: its triangles, their edges and vertices."""
    return {
        frozenset(face)
        for triangle in boundary_triangles(diagonals)
        for size in (1, 2, 3)
        for face in combinations(triangle, size)
    }


def _excluded(coefficients: list[tuple[int, int]], faces: list[set[frozenset[int]]]) -> int:
    """Return the boundaries, as bits, of which both sides of a circuit are faces."""
    positive = frozenset(vertex for vertex, value in coefficients if value > 0)
    negative = frozenset(vertex for vertex, value in coefficients if value < 0)
    return sum(1 << i for i, own in enumerate(faces) if positive in own and negative in own)


@compiled
def _crossed(chirotopes: Signs, quintuples: NDArray[np.int64], crossed: Words) -> Words:
    """Return for each chirotope the boundaries that some circuit excludes, as bits."""
    out = np.zeros(len(chirotopes), np.uint64)
    for h in range(len(chirotopes)):
        for q in range(len(quintuples)):
            column = 0
            for i in quintuples[q]:
                column = 3 * column + chirotopes[h, i] + 1
            out[h] |= crossed[q, column]
    return out


@compiled
def _compare(
    chirotopes: Signs,
    excluded: Words,
    needs: Words,
    starts: NDArray[np.int64],
    out: Booleans,
) -> None:
    """Set for each chirotope the triangulations with the right signs and no excluded boundary."""
    have = np.zeros(4, np.uint64)
    for h in range(len(chirotopes)):
        have[:] = 0
        for q in range(len(QUADRUPLES)):
            if chirotopes[h, q]:
                word = q // WORD + (0 if chirotopes[h, q] > 0 else 2)
                have[word] |= np.uint64(1) << np.uint64(q % WORD)
        for b in range(len(starts) - 1):
            if not excluded[h] >> np.uint64(b) & np.uint64(1):
                for t in range(starts[b], starts[b + 1]):
                    out[h, t] = not (
                        needs[t, 0] & ~have[0]
                        | needs[t, 1] & ~have[1]
                        | needs[t, 2] & ~have[2]
                        | needs[t, 3] & ~have[3]
                    )
