"""Meshes to try: grids, warped ones, mixed ones; and what trying everything says of them."""

from collections import Counter
from collections.abc import Sequence
from fractions import Fraction
from typing import Any

import numpy as np
from numpy.typing import NDArray

from certify.kernel.embedding import NotRealized, require_realization
from certify.kernel.hexahedron import BOUNDARIES, FACETS
from certify.mesh.realized import fillable_at_all
from certify.mesh.signs import signs

Cells = dict[str, NDArray[np.int64]]

LAID = (536, 8, 6, 2, 1, 1)
"""A mesh that cannot be split without boundary tetrahedra."""

RING = (3870, 10, 5, 3, 3, 1)
"""A mesh in which four cells contradict each other, and no three."""

NO = [(157, 10, 7, 2, 1, 1), (9, 10, 6, 2, 2, 2), (43, 10, 6, 2, 2, 2), RING]
YES = [(1, 10, 0, 2, 2, 2), (1, 10, 3, 3, 3, 3), (2, 10, 4, 3, 3, 3), (4, 10, 5, 4, 4, 4), LAID]


def grid(*sizes: int) -> tuple[NDArray[np.float64], Cells]:
    """Return the points and the hexahedra of a grid of unit cubes."""
    axes = [np.arange(size + 1) for size in sizes]
    points = np.stack(np.meshgrid(*axes, indexing="ij"), axis=-1).reshape(-1, 3)
    number = np.arange(len(points)).reshape([size + 1 for size in sizes])
    low, high = slice(None, -1), slice(1, None)
    corners = [
        (low, low, low), (high, low, low), (high, high, low), (low, high, low),
        (low, low, high), (high, low, high), (high, high, high), (low, high, high),
    ]  # fmt: skip
    rows = np.stack([number[corner].ravel() for corner in corners], axis=1)
    return points.astype(float), {"hexahedron": rows.astype(np.int64)}


def warped(seed: int, unit: int, most: int, *sizes: int) -> tuple[NDArray[np.float64], Cells]:
    """Return a grid with the given unit, every coordinate moved by an integer up to ``most``."""
    points, cells = grid(*sizes)
    random = np.random.default_rng(seed)
    return points * unit + random.integers(-most, most + 1, points.shape), cells


def shuffled(seed: int, points: Any, cells: Cells) -> tuple[Any, Cells]:
    """Return the same mesh with other numbers of vertices, and with other first vertices."""
    random = np.random.default_rng(seed)
    order = random.permutation(len(points))
    place = np.argsort(order)
    turns = [[0, 1, 2, 3, 4, 5, 6, 7], [1, 2, 3, 0, 5, 6, 7, 4], [1, 5, 6, 2, 0, 4, 7, 3]]
    rows = np.array([place[row[turns[random.integers(3)]]] for row in cells["hexahedron"]])
    return points[order], {**cells, "hexahedron": rows}


def mixed(points: Any, cells: Cells, wedges: Sequence[int], pyramids: Sequence[int]) -> Any:
    """Return the mesh with some hexahedra cut into two wedges, and some into six pyramids.

    The wedges' triangles halve the first and the last quadrilateral of the hexahedron, so no other
    cell may have these. Every second pair has a wedge that is turned round, and a tetrahedron.
    """
    rows = cells["hexahedron"]
    keep = [cell for cell in range(len(rows)) if cell not in {*wedges, *pyramids}]
    prisms, tips, tetrahedra = [], [], []
    points = np.asarray(points)
    for number, cell in enumerate(wedges):
        a, b, c, d, e, f, g, h = rows[cell].tolist()
        prisms += [[a, b, c, e, f, g], [e, g, h, a, c, d] if number % 2 else [a, c, d, e, g, h]]
        if number % 2:
            tetrahedra.append([a, c, b, len(points)])
            below = points[[a, b, c]].mean(axis=0) - 2 * (points[e] - points[a])
            points = np.concatenate([points, below[None]])
    for cell in pyramids:
        a, b, c, d, e, f, g, h = rows[cell].tolist()
        quads = [(a, b, c, d), (a, e, f, b), (a, d, h, e), (b, f, g, c), (c, g, h, d), (e, h, g, f)]
        tips += [[*quad, len(points)] for quad in quads]
        points = np.concatenate([points, points[rows[cell]].mean(axis=0, keepdims=True)])
    made = {"hexahedron": rows[keep]}
    for kind, own in {"wedge": prisms, "pyramid": tips, "tetra": tetrahedra}.items():
        if own:
            made[kind] = np.array(own, np.int64)
    return points, made


def schoenhardt(turn: float) -> NDArray[np.float64]:
    """Return the vertices of a triangular prism whose upper triangle is turned by some degrees."""
    angles = np.radians([0, 120, 240])
    low = np.column_stack([np.cos(angles), np.sin(angles), np.zeros(3)])
    angles = angles + np.radians(turn)
    return np.concatenate([low, np.column_stack([np.cos(angles), np.sin(angles), np.ones(3)])])


def exact(points: Any) -> Any:
    return [tuple(map(Fraction, point)) for point in points.tolist()]


def realizes(oriented: Any, all_signs: Any) -> bool:
    try:
        require_realization(oriented, all_signs)
    except NotRealized:
        return False
    return True


def trying_all(points: Any, cells: Any) -> bool:
    """Is there a split, by trying all diagonals of all quadrilaterals that are not outside?"""
    rows = cells["hexahedron"]
    quads = Counter(frozenset(row[v - 1] for v in f) for row in rows.tolist() for f in FACETS)
    ways = []
    for row, filled in zip(rows.tolist(), fillable_at_all(signs(points[rows])), strict=True):
        own = set()
        for diagonals in (b for b, yes in zip(BOUNDARIES, filled, strict=True) if yes):
            cut = [frozenset(row[v - 1] for v in diagonal) for diagonal in diagonals]
            faces = {quad: d for quad in quads for d in cut if d < quad <= set(row)}
            own.add(frozenset((q, d) for q, d in faces.items() if quads[q] == 2))
        ways.append([dict(cut) for cut in own])
    return _extends({}, ways)


def _extends(chosen: dict[Any, Any], ways: list[list[dict[Any, Any]]]) -> bool:
    return not ways or any(
        _extends({**chosen, **cut}, ways[1:])
        for cut in ways[0]
        if all(chosen.get(quad, diagonal) == diagonal for quad, diagonal in cut.items())
    )
