"""How good are many tetrahedra and hexahedra? Floating-point figures; no verdict depends on them.

Figures have no unit: the points may be in any, as long as squares and products of their differences
neither over- nor underflow.
"""

from itertools import combinations

import numpy as np

from certify.kernel.hexahedron import CORNERS
from certify.kernel.validity import across
from certify.mesh.signs import Floats

_ACROSS = np.array([[across(vertex, axis) - 1 for axis in range(3)] for vertex in CORNERS])
_PARITY = np.array([(-1) ** sum(corner) for corner in CORNERS.values()])


def least_dihedral_angles(points: Floats) -> Floats:
    """Return the least of the six dihedral angles of each tetrahedron, in degrees: (n,).

    That of a regular one is about 70.53; of a flat one 0.

    Args:
        points: An array (n, 4, 3) of floating-point numbers.
    """
    normals = np.stack([_normal(points, opposite) for opposite in range(4)], axis=1)
    cosines = [-(normals[:, i] * normals[:, j]).sum(axis=1) for i, j in combinations(range(4), 2)]
    angles = np.degrees(np.arccos(np.clip(np.max(cosines, axis=0), -1, 1)))
    out: Floats = np.where(_six_volumes(points) == 0, 0, angles)
    return out


def _six_volumes(points: Floats) -> Floats:
    a, b, c = (points[:, i] - points[:, 0] for i in (1, 2, 3))
    out: Floats = np.abs((a * np.cross(b, c)).sum(axis=1))
    return out


def _normal(points: Floats, opposite: int) -> Floats:
    """Return unit normals of the triangles opposite one vertex, pointing away from it."""
    a, b, c = (points[:, i] for i in range(4) if i != opposite)
    normal = np.cross(b - a, c - a)
    inside = (normal * (points[:, opposite] - a)).sum(axis=1, keepdims=True)
    length = np.linalg.norm(normal, axis=1, keepdims=True)
    out: Floats = np.where(inside > 0, -1, 1) * normal / np.where(length == 0, 1, length)
    return out


def mean_ratios(points: Floats) -> Floats:
    """Return the mean ratio of each tetrahedron: (n,). It is 1 if it is regular, 0 if it is flat.

    It is 12 (3 V)^(2/3) over the sum of the squares of the six edges, for the volume V (Liu and Joe
    1994, "On the shape of tetrahedra from bisection").

    Args:
        points: An array (n, 4, 3) of floating-point numbers.
    """
    edges = [points[:, j] - points[:, i] for i, j in combinations(range(4), 2)]
    squares = sum((edge**2).sum(axis=1) for edge in edges)
    out: Floats = 12 * (_six_volumes(points) / 2) ** (2 / 3) / np.where(squares == 0, 1, squares)
    return out


def scaled_jacobians(points: Floats) -> Floats:
    """Return the scaled Jacobians of each hexahedron at the corners 1..8: (n, 8).

    See certify/mesh/quality.py, which is slower and does not mind the size of the numbers.

    Args:
        points: An array (n, 8, 3) of floating-point numbers.
    """
    edges = points[:, _ACROSS] - points[:, :, None]
    values = (edges[:, :, 0] * np.cross(edges[:, :, 1], edges[:, :, 2])).sum(axis=2) * _PARITY
    lengths = np.linalg.norm(edges, axis=3).prod(axis=2)
    out: Floats = values / np.where(lengths == 0, 1, lengths)
    return out
