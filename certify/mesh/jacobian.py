"""Is the Jacobian of trilinear hexahedra positive on the closed cube? For many at once, exactly.

The Jacobian is positive where its 27 Bernstein coefficients are, and at the corners of a box it
equals coefficients (certify/kernel/jacobian.py); boxes that this does not settle are halved. Three
roads lead to the answer; each decides, or hands on:

1. A filter. Let X be the largest difference of first coordinates along an edge, as computed, Y and
   Z likewise, and F = XYZ. A coefficient is the mean of at most eight determinants of edges, each a
   sum of six products. With u = 2^-53, as long as nothing over- or underflows, a product as
   computed has at most 12 factors 1 + δ, |δ| <= u: three differences, two products, and sums, one
   in a vector product, one of two of these, two in a scalar product, three of four of these. So the
   coefficient's error is at most ((1+u)^12 - 1) 6F' for the exact F', hence less than 92 u F. A
   halving replaces coefficients by means of them, which keeps their error, and rounds twice numbers
   below 6.1 F in absolute value: it adds less than 12.3 u F. After at most HALVINGS = 30 halvings
   the error is below 461 u F, and that below 2^-44 F, also when this product is rounded. Nothing
   under- or overflows if the points are safe (signs.py): all numbers are multiples of
   2^-(876 + 3 + 60), and less than 2^910.
2. A filter without error. If all coordinates are multiples of a power of two, g, then everything
   after h halvings is a multiple of g^3 / (8 * 4^h), and at most 6 F: it is computed without error
   as long as their quotient is below 2^53.
3. Integers of any size, in the kernel's functions. An edge of the cube is then decided at once: on
   it the Jacobian is a quadratic polynomial with the coefficients a, b, c, which is positive on
   [0, 1] iff a > 0, c > 0, and b >= 0 or b^2 < ac. What is halved more than DEPTH times stays
   undecided: that takes a Jacobian that is zero somewhere off the edges and negative nowhere near.
"""

from collections.abc import Iterator
from fractions import Fraction
from itertools import product
from operator import mul
from typing import Any, NamedTuple, TypeAlias

import numpy as np
from numpy.typing import NDArray

from certify.kernel.chirotope import Point
from certify.kernel.hexahedron import CORNERS, Simplex, simplex
from certify.kernel.jacobian import Coefficients, bernstein_coefficients, halves
from certify.kernel.validity import across
from certify.mesh.compiled import borrowing, compiled
from certify.mesh.quality import jacobian_bounds
from certify.mesh.signs import UNKNOWN, Floats, Numbers, Signs, exact_signs, numbers, safe

HALVINGS = 30
"""The filter halves a box no more often: ten times in each direction."""

BOXES = 2000
"""The filter looks at no more boxes."""

EIGHTHS = 6
"""A lower bound is that of all parts of the cube halved twice in each direction."""

DEPTH = 60
"""Boxes smaller than 2^-60 are not tried. (Among 27 million hexahedra of random points a few need
2^-13: on an edge their Jacobian is almost zero.)"""

_ROUNDING = 2.0**-44
_LATTICE = 15

Box: TypeAlias = NDArray[np.float64]
"""27 Bernstein coefficients; that with the indices i, j, k is at 9i + 3j + k."""

_BIT = (0, 1)
_AT: dict[tuple[int, ...], int] = {corner: vertex - 1 for vertex, corner in CORNERS.items()}
_EDGES = np.array(
    [
        [_AT[(*ends[:axis], side, *ends[axis:])] for side in _BIT]
        for axis in range(3)
        for ends in product(_BIT, repeat=2)
    ]
)
"""The edges in the directions u, v and w: that from (0, v, w) is 2v + w, and so on."""

_CROSSES = np.array(
    [
        (2 * v1 + w1, 4 + 2 * u2 + w2, 6 * v1 + 3 * u2 + w1 + w2)
        for v1, w1, u2, w2 in product(_BIT, repeat=4)
    ]
)
"""An edge in direction u, one in direction v, and the place of the sum their product belongs to."""

_DOTS = np.array(
    [
        (6 * v1 + 3 * u2 + k, 8 + 2 * u3 + v3, 9 * (u2 + u3) + 3 * (v1 + v3) + k)
        for v1, u2, u3, v3 in product(_BIT, repeat=4)
        for k in range(3)
    ]
)
"""Such a place, an edge in direction w, and the coefficient that their product belongs to."""

_SCALES = np.array([0.5 ** index.count(1) for index in product(range(3), repeat=3)])


_AT_CORNERS = np.array(
    [[vertex - 1, *(across(vertex, axis) - 1 for axis in range(3))] for vertex in CORNERS]
)
_PARITY = [(-1) ** sum(corner) for corner in CORNERS.values()]
"""At a corner the Jacobian is this times the determinant of it and its three neighbours."""


def positive(points: Numbers) -> Signs:
    """Return for each hexahedron 1 if its Jacobian is positive on the closed cube, else -1.

    A hexahedron that is not decided has a 0; its Jacobian would have to touch zero.

    Args:
        points: An array (n, 8, 3) of integers, floating-point numbers or Fractions; vertex 1 first,
            in the order of the template, which is that of VTK.

    Raises:
        ValueError: The array has another shape, or what is in it are no finite numbers.

    >>> positive([list(CORNERS.values())]).tolist()
    [1]
    """
    given = numbers(points)
    if given.ndim != 3 or given.shape[1:] != (8, 3):
        raise ValueError(f"the array has the shape {given.shape} instead of (n, 8, 3)")
    out = np.full(len(given), UNKNOWN, np.int8)
    if given.dtype != object:
        _filter(given, out)
    for index in np.flatnonzero(out == UNKNOWN):
        out[index] = decided(given[index])
    return out


def least(points: Numbers) -> Floats:
    """Return for each hexahedron a lower bound of its Jacobian on the closed cube: (n,).

    It is positive if the Jacobian is, unless that is so small that no float is below it.

    Args:
        points: As for :func:`positive`; the bound is in volume units.
    """
    given = numbers(points)
    out = np.full(len(given), np.nan)
    if given.dtype != object:
        _least(given, out)
    for index in np.flatnonzero(np.isnan(out)):
        out[index] = _below(jacobian_bounds(_kernels(given[index]))[0])
    return out


def _below(value: Fraction) -> float:
    """Return a floating-point number at most as large, and next to it."""
    try:
        near = float(value)
    except OverflowError:
        return float(np.finfo(float).max) if value > 0 else -np.inf
    return near if near <= value else float(np.nextafter(near, -np.inf))


def decided(points: NDArray[Any]) -> int:
    """Return 1, -1 or 0 as :func:`positive` does, for one hexahedron, by integers of any size."""
    if min(map(mul, exact_signs(points, _AT_CORNERS), _PARITY)) <= 0:
        return -1  # which is by far the most frequent answer, and takes little
    return _decided(bernstein_coefficients(_kernels(points)))


def _decided(coefficients: Coefficients) -> int:
    if any(_failing(coefficients)):
        return -1
    boxes = [coefficients]
    for step in range(3 * DEPTH):
        boxes = [half for box in boxes for half in halves(box, step % 3) if min(half.values()) <= 0]
        if any(min(box[corner] for corner in _CORNERS) <= 0 for box in boxes):
            return -1
        if not boxes or len(boxes) > BOXES:
            break
    return 0 if boxes else 1


_CORNERS = [*product((0, 2), repeat=3)]


def failing_edges(points: NDArray[Any]) -> list[Simplex]:
    """Return the edges of one hexahedron on which its Jacobian is not positive everywhere."""
    return sorted(_failing(bernstein_coefficients(_kernels(points))))


def _kernels(points: NDArray[Any]) -> list[Point]:
    """Return points as the kernel takes them."""
    return [tuple(map(Fraction, point)) for point in points.tolist()]


def _failing(coefficients: Coefficients) -> Iterator[Simplex]:
    """Yield the edges of the cube on which the Jacobian is not positive everywhere."""
    for edge, places in _ON_EDGES.items():
        a, b, c = (coefficients[place] for place in places)
        if a <= 0 or c <= 0 or (b < 0 and b * b >= a * c):
            yield edge


def _edges() -> dict[Simplex, list[tuple[int, ...]]]:
    """Return for each edge of the cube where the three coefficients on it are."""
    found = {}
    for vertex, corner in CORNERS.items():
        for axis in range(3):
            if corner[axis] == 0:
                end = tuple(2 * bit for bit in corner)
                places = [(*end[:axis], i, *end[axis + 1 :]) for i in range(3)]
                found[simplex((vertex, across(vertex, axis)))] = places
    return found


_ON_EDGES = _edges()


@compiled
def _filter(points: Floats, out: Signs) -> None:
    scratch = workspace()
    for h in range(len(points)):
        out[h] = filtered_jacobian(points[h], scratch)


class Workspace(NamedTuple):
    """What :func:`filtered_jacobian` writes on.

    boxes: a stack; depths: how often each was halved; edges: the twelve; crosses: sums of vector
    products of edges.
    """

    boxes: Floats
    depths: NDArray[np.int64]
    edges: Floats
    crosses: Floats


@compiled
def _least(points: Floats, out: Floats) -> None:
    scratch = workspace()
    for h in range(len(points)):
        if safe(points[h]):
            error = _ROUNDING * _coefficients(points[h], scratch)
            out[h] = _lower_bound(scratch, error)


@compiled
def workspace() -> Workspace:
    """Return something to write on."""
    depths = np.zeros(HALVINGS + 2, np.int64)
    return Workspace(np.empty((HALVINGS + 2, 27)), depths, np.empty((12, 3)), np.empty((12, 3)))


@borrowing
def filtered_jacobian(points: Floats, scratch: Workspace) -> int:
    """Return 1, -1 or UNKNOWN for eight points."""
    if not safe(points):
        return UNKNOWN
    return filtered_safe(points, scratch)


@borrowing
def filtered_safe(points: Floats, scratch: Workspace) -> int:
    """Return what :func:`filtered_jacobian` does, for points that are safe."""
    size = _coefficients(points, scratch)
    found = _subdivided(scratch, _ROUNDING * size, HALVINGS)
    if found == UNKNOWN:
        halvings = _halvings_without_error(points, size)
        if halvings >= 0:
            _coefficients(points, scratch)
            found = _subdivided(scratch, 0.0, halvings)
    return found


@borrowing
def _coefficients(points: Floats, scratch: Workspace) -> float:
    """Put the 27 Bernstein coefficients into the first box and return F."""
    edges, crosses, box = scratch.edges, scratch.crosses, scratch.boxes[0]
    size = 1.0
    for axis in range(3):
        most = 0.0
        for k in range(12):
            edges[k, axis] = points[_EDGES[k, 1], axis] - points[_EDGES[k, 0], axis]
            most = max(most, abs(edges[k, axis]))
        size *= most
    crosses[:] = 0.0
    for k in range(16):
        a, b, place = edges[_CROSSES[k, 0]], edges[_CROSSES[k, 1]], _CROSSES[k, 2]
        crosses[place, 0] += a[1] * b[2] - a[2] * b[1]
        crosses[place, 1] += a[2] * b[0] - a[0] * b[2]
        crosses[place, 2] += a[0] * b[1] - a[1] * b[0]
    box[:] = 0.0
    for k in range(48):
        a, c = crosses[_DOTS[k, 0]], edges[_DOTS[k, 1]]
        box[_DOTS[k, 2]] += a[0] * c[0] + a[1] * c[1] + a[2] * c[2]
    for place in range(27):
        box[place] *= _SCALES[place]
    return size


@borrowing
def _subdivided(scratch: Workspace, error: float, halvings: int) -> int:
    """Return the answer for the first box, whose coefficients have at most this error.

    The boxes that wait are a stack.
    """
    boxes, depths = scratch.boxes, scratch.depths
    depths[0] = 0
    top, looked = 1, 0
    while top:
        top, looked = top - 1, looked + 1
        box, depth = boxes[top], depths[top]
        least = box[0]
        for place in range(1, 27):
            least = min(least, box[place])
        if least > error:
            continue
        for place in (0, 2, 6, 8, 18, 20, 24, 26):
            if box[place] <= -error:
                return -1
        if depth == halvings or looked > BOXES:
            return UNKNOWN
        for place in (0, 2, 6, 8, 18, 20, 24, 26):
            if box[place] <= error:
                return UNKNOWN
        _halve(box, boxes[top + 1], depth % 3)
        depths[top] = depths[top + 1] = depth + 1
        top += 2
    return 1


@borrowing
def _lower_bound(scratch: Workspace, error: float) -> float:
    """Return a lower bound for the first box, whose coefficients have at most this error.

    Boxes are halved EIGHTHS times, and on until the coefficients are positive, or one at a corner,
    which is a value, is not.
    """
    boxes, depths = scratch.boxes, scratch.depths
    depths[0] = 0
    top, looked, bound = 1, 0, np.inf
    while top:
        top, looked = top - 1, looked + 1
        box, depth = boxes[top], depths[top]
        lowest, corner = np.inf, np.inf
        for place in range(27):
            lowest = min(lowest, box[place])
        for place in (0, 2, 6, 8, 18, 20, 24, 26):
            corner = min(corner, box[place])
        enough = lowest > error or corner <= error or looked > BOXES
        if depth == HALVINGS or (depth >= EIGHTHS and enough):
            bound = min(bound, lowest - error)
        else:
            _halve(box, boxes[top + 1], depth % 3)
            depths[top] = depths[top + 1] = depth + 1
            top += 2
    return bound


@borrowing
def _halve(box: Box, other: Box, axis: int) -> None:
    """Replace the coefficients of a box by those of its lower half, and give the upper's."""
    step = (9, 3, 1)[axis]
    for i in range(9):
        start = (i, 9 * (i // 3) + i % 3, 3 * i)[axis]
        a, b, c = box[start], box[start + step], box[start + 2 * step]
        ab, bc = 0.5 * (a + b), 0.5 * (b + c)
        middle = 0.5 * (ab + bc)
        box[start + step], box[start + 2 * step] = ab, middle
        other[start], other[start + step], other[start + 2 * step] = middle, bc, c


@borrowing
def _halvings_without_error(points: Floats, size: float) -> int:
    """Return how many halvings are exact, for safe points; -1 if the coefficients are not."""
    most, bits = 0.0, 0
    for point in points:
        for x in point:
            most = max(most, abs(x))
    if most == 0.0 or size == 0.0:
        return HALVINGS
    exponent = int(np.ceil(np.log2(most))) + 1
    scale = 2.0 ** (_LATTICE - exponent)
    for point in points:
        for x in point:
            whole = int(x * scale)
            if whole != x * scale:
                return -1
            bits |= whole
    unit = 1.0 / scale
    while not bits & 1:
        bits, unit = bits >> 1, 2.0 * unit
    halvings = -1
    room = 48.0 * (size / unit / unit / unit)
    while halvings < HALVINGS and room < 2.0**53:
        halvings, room = halvings + 1, 4.0 * room
    return halvings
