"""Hilbert's curve, which fills space: points that are near one another on it are neighbours."""

import numpy as np
from numpy.typing import NDArray

from certify.mesh.signs import Floats

BITS = 20
"""Every axis is cut into 2^BITS parts; a place on the curve takes three times as many bits."""


def along_the_curve(points: Floats) -> NDArray[np.int64]:
    """Return the order in which Hilbert's curve visits the points; ties keep their order."""
    return np.argsort(places(points), kind="stable")


def places(points: Floats) -> NDArray[np.int64]:
    """Return the place of each point on Hilbert's curve through the cube around all points.

    The method is Skilling's (2004, "Programming the Hilbert curve"): undo the rotations of the
    levels, from the coarsest to the finest, take the Gray code back, and interleave the bits.
    """
    if not len(points):
        return np.zeros(0, np.int64)
    low, high = points.min(axis=0), points.max(axis=0)
    half = float((0.5 * high - 0.5 * low).max()) or 1.0  # halves, as the difference may overflow
    with np.errstate(under="ignore"):
        parts = (0.5 * points - 0.5 * low) / half * (2**BITS - 1)
    x, y, z = np.clip(parts, 0, 2**BITS - 1).astype(np.int64).T.copy()
    for level in range(BITS - 1, 0, -1):
        bit, below = 1 << level, (1 << level) - 1
        x ^= np.where(x & bit, below, 0)
        for axis in (y, z):
            swapped = np.where(axis & bit, 0, (x ^ axis) & below)
            x ^= np.where(axis & bit, below, swapped)
            np.bitwise_xor(axis, swapped, out=axis)
    y ^= x
    z ^= y
    flip = np.zeros_like(x)
    for level in range(BITS - 1, 0, -1):
        flip ^= np.where(z & (1 << level), (1 << level) - 1, 0)
    out: NDArray[np.int64] = np.zeros_like(x)
    for level in range(BITS - 1, -1, -1):
        for axis in (x, y, z):
            out = out << 1 | ((axis ^ flip) >> level & 1)
    return out
