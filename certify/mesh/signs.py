"""The signs of determinants of four points, exactly, for many points at once.

Floating-point numbers are rational numbers, and the sign asked for is that of the exact determinant
of these. Three roads lead to it; each decides, or hands on:

1. A filter. det(b-a, c-a, d-a) is a sum of six products of three differences. As long as nothing
   over- or underflows, every operation multiplies its exact result by some 1 + δ, |δ| <= 2^-53.
   Each of the six products, as computed, has at most 8 such factors: three differences, two
   products, three sums. With P for the sum of the absolute values of the six, the error is thus at
   most ((1 + 2^-53)^8 - 1) P; and P as computed, P', is at least (1 - 2^-53)^8 P. Hence it is less
   than 9 * 2^-53 P', which is less than 2^-49 P', also when this product is rounded: a determinant
   beyond that has its sign. If P' is 0, so are all six products, and the determinant.
   Nothing under- or overflows if each coordinate is 0 or in absolute value between 2^-240 and
   2^300: differences are multiples of 2^-292, products of three of them of 2^-876, and less than
   2^905.
2. Integers. If all coordinates of the points are multiples of a power of two, and less than 2^19
   times as large, then the determinant is computed in 64 bits: its six products are below 2^60.
3. Otherwise, Python's integers.
"""

from collections.abc import Sequence
from fractions import Fraction
from math import frexp, isfinite, lcm
from numbers import Rational
from typing import Any, TypeAlias

import numpy as np
from numpy.typing import ArrayLike, NDArray

from certify.kernel.chirotope import QUADRUPLES
from certify.mesh.compiled import borrowing, compiled

Floats: TypeAlias = NDArray[np.float64]
Signs: TypeAlias = NDArray[np.int8]
Numbers: TypeAlias = ArrayLike | Sequence[Any]
"""What numpy can make an array of integers, floating-point numbers or Fractions of."""

UNKNOWN = 2
"""Stands for a sign that the filter does not know."""

_LEAST, _MOST = 2.0**-240, 2.0**300
_ROUNDING = 2.0**-49
_LATTICE = 19

_QUADRUPLES = np.array(QUADRUPLES, dtype=np.int64) - 1


def signs(points: Numbers) -> Signs:
    """Return the chirotopes of n hexahedra: an array (n, 70) of -1, 0 or 1.

    Args:
        points: An array (n, 8, 3) of integers, floating-point numbers or Fractions; vertex 1 first.

    Returns:
        The sign of every quadruple, in the order of the kernel's QUADRUPLES.

    Raises:
        ValueError: The array has another shape, or what is in it are no finite numbers.
    """
    given = numbers(points)
    if given.ndim != 3 or given.shape[1:] != (8, 3):
        raise ValueError(f"the array has the shape {given.shape} instead of (n, 8, 3)")
    out = np.empty((len(given), len(QUADRUPLES)), np.int8)
    if given.dtype == object:
        for own, row in zip(given, out, strict=True):
            row[:] = exact_signs(own, _QUADRUPLES)
        return out
    _filter_hexahedra(given, _QUADRUPLES, out)
    for index in np.flatnonzero((out == UNKNOWN).any(axis=1)):
        unknown = np.flatnonzero(out[index] == UNKNOWN)
        out[index, unknown] = exact_signs(given[index], _QUADRUPLES[unknown])
    return out


def orientations(points: Numbers, rows: ArrayLike) -> Signs:
    """Return the signs of det(b-a, c-a, d-a) for m quadruples a, b, c, d of n points.

    Args:
        points: An array (n, 3) of integers, floating-point numbers or Fractions.
        rows: An array (m, 4) of indices from 0.

    Raises:
        ValueError: The points have another shape, or what is in them are no finite numbers.
    """
    given, quadruples = numbers(points), np.asarray(rows, np.int64)
    if given.ndim != 2 or given.shape[1] != 3:
        raise ValueError(f"the array has the shape {given.shape} instead of (n, 3)")
    out = np.full(len(quadruples), UNKNOWN, np.int8)
    if given.dtype != object:
        _filter_quadruples(given, quadruples, out)
    for index in np.flatnonzero(out == UNKNOWN):
        out[index] = exact_signs(given[quadruples[index]], np.arange(4)[None])[0]
    return out


def numbers(points: Numbers) -> NDArray[Any]:
    """Return the numbers as float64 if they all are, exactly; else as objects, all Fractions.

    Raises:
        ValueError: They are no finite numbers.
    """
    given = np.asarray(points)
    if given.dtype.kind == "f" and given.dtype.itemsize <= 8:
        found = given.astype(np.float64)
        if not np.isfinite(found).all():
            raise ValueError("a coordinate is not a finite number")
        return found
    if given.dtype.kind in "iu" and np.abs(given.astype(np.float64)).max(initial=0) < 2**53:
        return given.astype(np.float64)
    exact = np.array([_fraction(x) for x in given.ravel().tolist()], object).reshape(given.shape)
    try:
        found = exact.astype(np.float64)
    except OverflowError:
        return exact
    same = all(map(Fraction.__eq__, exact.ravel(), map(Fraction, found.ravel().tolist())))
    return found if same else exact


def _fraction(number: object) -> Fraction:
    if isinstance(number, Rational) or (isinstance(number, float) and isfinite(number)):
        return Fraction(number)
    raise ValueError(f"{number!r:.80} is not a finite number")


def exact_signs(points: NDArray[Any], quadruples: NDArray[np.int64]) -> list[int]:
    """Return the signs of quadruples of some points, by integers of any size."""
    ratios = [x.as_integer_ratio() for x in points.ravel().tolist()]
    unit = lcm(*{below for _, below in ratios})
    whole = [above * (unit // below) for above, below in ratios]
    rows = [whole[i : i + 3] for i in range(0, len(whole), 3)]
    return [_sign(*(rows[i] for i in quadruple)) for quadruple in quadruples.tolist()]


def _sign(a: Sequence[int], b: Sequence[int], c: Sequence[int], d: Sequence[int]) -> int:
    """Return the sign of det(b-a, c-a, d-a)."""
    x1, y1, z1 = b[0] - a[0], b[1] - a[1], b[2] - a[2]
    x2, y2, z2 = c[0] - a[0], c[1] - a[1], c[2] - a[2]
    x3, y3, z3 = d[0] - a[0], d[1] - a[1], d[2] - a[2]
    value = x1 * (y2 * z3 - z2 * y3) - y1 * (x2 * z3 - z2 * x3) + z1 * (x2 * y3 - y2 * x3)
    return (value > 0) - (value < 0)


@borrowing
def safe(points: Floats) -> bool:
    """Can nothing over- or underflow in a determinant of these points?"""
    for point in points:
        for x in point:
            size = abs(x)
            if size > _MOST or (size < _LEAST and size != 0.0):
                return False
    return True


@compiled
def filtered(a: Floats, b: Floats, c: Floats, d: Floats) -> int:
    """Return the sign of det(b-a, c-a, d-a) for safe points, or UNKNOWN."""
    x1, y1, z1 = b[0] - a[0], b[1] - a[1], b[2] - a[2]
    x2, y2, z2 = c[0] - a[0], c[1] - a[1], c[2] - a[2]
    x3, y3, z3 = d[0] - a[0], d[1] - a[1], d[2] - a[2]
    yz, zy, xz, zx, xy, yx = y2 * z3, z2 * y3, x2 * z3, z2 * x3, x2 * y3, y2 * x3
    value = x1 * (yz - zy) - y1 * (xz - zx) + z1 * (xy - yx)
    size = (
        abs(x1) * (abs(yz) + abs(zy))
        + abs(y1) * (abs(xz) + abs(zx))
        + abs(z1) * (abs(xy) + abs(yx))
    )
    bound = _ROUNDING * size
    if value > bound:
        return 1
    if value < -bound:
        return -1
    return 0 if size == 0.0 else UNKNOWN


@compiled
def _lattice(points: Floats, whole: NDArray[np.int64]) -> bool:
    """Put the points, times a power of two, into ``whole``, unless that takes more than 20 bits."""
    most = 0.0
    for point in points:
        for x in point:
            most = max(most, abs(x))
    scale = 2.0 ** (_LATTICE - frexp(most)[1])
    for i in range(len(points)):
        for axis in range(3):
            x = points[i, axis] * scale
            whole[i, axis] = np.int64(x)
            if x != whole[i, axis]:
                return False
    return True


@compiled
def _whole_sign(whole: NDArray[np.int64], row: NDArray[np.int64]) -> int:
    a, b, c, d = whole[row[0]], whole[row[1]], whole[row[2]], whole[row[3]]
    x1, y1, z1 = b[0] - a[0], b[1] - a[1], b[2] - a[2]
    x2, y2, z2 = c[0] - a[0], c[1] - a[1], c[2] - a[2]
    x3, y3, z3 = d[0] - a[0], d[1] - a[1], d[2] - a[2]
    value = x1 * (y2 * z3 - z2 * y3) - y1 * (x2 * z3 - z2 * x3) + z1 * (x2 * y3 - y2 * x3)
    return np.sign(value)  # type: ignore[no-any-return]


@compiled
def _filter_hexahedra(points: Floats, quadruples: NDArray[np.int64], out: Signs) -> None:
    whole = np.empty((8, 3), np.int64)
    for h in range(len(points)):
        if not safe(points[h]):
            out[h] = UNKNOWN
            continue
        unknown = False
        for q in range(len(quadruples)):
            i, j, k, m = quadruples[q]
            out[h, q] = filtered(points[h, i], points[h, j], points[h, k], points[h, m])
            unknown |= out[h, q] == UNKNOWN
        if unknown and _lattice(points[h], whole):
            for q in range(len(quadruples)):
                if out[h, q] == UNKNOWN:
                    out[h, q] = _whole_sign(whole, quadruples[q])


@compiled
def _filter_quadruples(points: Floats, rows: NDArray[np.int64], out: Signs) -> None:
    whole, order, four = np.empty((4, 3), np.int64), np.arange(4), np.empty((4, 3))
    for m in range(len(rows)):
        for i in range(4):
            four[i] = points[rows[m, i]]
        if not safe(four):
            continue
        out[m] = filtered(four[0], four[1], four[2], four[3])
        if out[m] == UNKNOWN and _lattice(four, whole):
            out[m] = _whole_sign(whole, order)
