"""Whether Jacobians of arrays are positive is what the kernel's functions say, one by one."""

import doctest
from fractions import Fraction
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray

from certify.kernel.embedding import NotRealized
from certify.kernel.hexahedron import CORNERS
from certify.kernel.jacobian import MAX_DEPTH, bernstein_coefficients, require_positive_jacobian
from certify.mesh import jacobian
from certify.mesh.jacobian import positive
from certify.mesh.signs import UNKNOWN

CUBE = np.array([*CORNERS.values()], float)

unhurried = settings(deadline=None)
"""The first example waits for the compiler."""


def by_the_kernel(points: Any) -> int:
    """Return 1, -1, or 0 where the kernel does not know."""
    try:
        require_positive_jacobian([tuple(map(Fraction, p)) for p in np.asarray(points).tolist()])
    except NotRealized as fault:
        return 0 if str(MAX_DEPTH) in str(fault) else -1
    return 1


def agrees(points: Any) -> bool:
    """Is the answer the kernel's? Where that has none, anything but a wrong yes is allowed."""
    want, found = by_the_kernel(points), positive([points])[0]
    return found == want or (want == 0 and not (found == 1 and least(points) <= 0))


def least(points: Any) -> Fraction:
    """Return the least of many values of the Jacobian."""
    exact = bernstein_coefficients([tuple(map(Fraction, p)) for p in np.asarray(points).tolist()])
    ticks = [Fraction(i, 24) for i in range(25)]
    weights = [((1 - x) ** 2, 2 * x * (1 - x), x * x) for x in ticks]
    values = np.array([exact[index] for index in np.ndindex(3, 3, 3)], object).reshape(3, 3, 3)
    table = np.array(weights, object)
    found: Fraction = np.einsum(
        "ai,bj,ck,ijk->abc", table, table, table, values, optimize=True
    ).min()
    return found


@pytest.mark.parametrize("size", [0.3, 0.8, 1.1, 1.5])
def test_bent_cubes(size: float) -> None:
    points = CUBE + size * (np.random.default_rng(3).random((60, 8, 3)) - 0.5)
    want = [by_the_kernel(own) for own in points]
    assert positive(points).tolist() == want
    assert 1 in want


LATTICE = st.integers(-1, 1)
SIZES = st.sampled_from([1.0, 0.1, 1 / 3, 2.0**-60, 2.0**-300, 2.0**300, 2.0**-1070, 1e-200, 1e250])
WILD = st.floats(allow_nan=False, allow_infinity=False)


def eight(coordinate: st.SearchStrategy[Any]) -> st.SearchStrategy[Any]:
    return st.lists(st.lists(coordinate, min_size=3, max_size=3), min_size=8, max_size=8)


@unhurried
@given(eight(LATTICE), st.integers(1, 4), SIZES)
def test_cubes_moved_on_a_lattice(moves: list[list[int]], size: int, scale: float) -> None:
    """Coplanar, collinear and coincident points abound, and Jacobians that are zero somewhere."""
    assert agrees((size * CUBE + np.array(moves)) * scale)


@unhurried
@given(eight(WILD))
def test_any_floats(points: list[list[float]]) -> None:
    assert agrees(points)


@unhurried
@given(eight(LATTICE), st.integers(0, 7), st.integers(0, 2), st.integers(-2, 2))
def test_next_to_a_degenerate_position(
    moves: list[list[int]], vertex: int, axis: int, steps: int
) -> None:
    points = 2 * CUBE + np.array(moves) + 0.1
    for _ in range(abs(steps)):
        points[vertex, axis] = np.nextafter(points[vertex, axis], np.inf * np.sign(steps))
    assert agrees(points)


@unhurried
@given(eight(st.fractions(-1, 1, max_denominator=7)))
def test_fractions(moves: list[list[Fraction]]) -> None:
    points = [
        [3 * int(x) + y for x, y in zip(corner, move, strict=True)]
        for corner, move in zip(CUBE.tolist(), moves, strict=True)
    ]
    assert agrees(np.array(points, object))


def flattened(x: Fraction | float) -> NDArray[Any]:
    """Return a cube of which corner 7 is moved along its diagonal. At 2/3 that corner is flat."""
    points = CUBE.astype(object)
    points[6] = [x, x, x]
    return points


def test_the_filter_leaves_what_is_not_clear() -> None:
    near = [2 / 3, 2 / 3 + 1e-9, 2 / 3 - 1e-9]
    points = np.array([flattened(x) for x in near], float)
    out = np.empty(3, np.int8)
    jacobian._filter(points, out)
    assert out.tolist() == [UNKNOWN, 1, -1]
    assert positive(points).tolist() == [by_the_kernel(own) for own in points]
    assert positive(np.array([flattened(Fraction(2, 3))])).tolist() == [-1]


def test_small_integers_need_no_python(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(jacobian, "decided", None)
    points = 4 * CUBE + np.random.default_rng(1).integers(-2, 3, (500, 8, 3))
    found = positive(points)
    assert found.tolist() == [by_the_kernel(own) for own in points]
    assert {*found.tolist()} == {1, -1}


def quadratic(zero: Fraction, shift: Fraction) -> list[Fraction]:
    """Return the three coefficients of (x - zero)^2 + shift on [0, 1]."""
    return [zero**2 + shift, -zero * (1 - zero) + shift, (1 - zero) ** 2 + shift]


@pytest.mark.parametrize("zero", [Fraction(1, 3), Fraction(1, 7), Fraction(2, 5)])
def test_zeros_on_edges_are_found_wherever_they_are(zero: Fraction) -> None:
    for shift, want in ((Fraction(0), -1), (Fraction(-1, 10**30), -1), (Fraction(1, 10**3), 1)):
        unit = 9 * 25 * 49 * 10**30
        own = [int(unit * x) for x in quadratic(zero, shift)]
        assert jacobian._decided({index: own[index[1]] for index in np.ndindex(3, 3, 3)}) == want


ALMOST_ZERO = (
    "0x1.c4d5fd37f5b30p-3 0x1.de6a7d1729a92p-1 0x1.9aa9991364982p-1",
    "0x1.d3a4fc797da94p-3 0x1.e3fef41c7b855p-1 0x1.a2606e1353e20p-1",
    "0x1.b6f5b3bca97a8p-3 0x1.e7ed44fae38f6p-1 0x1.9f33258cf9ce0p-1",
    "0x1.c273673a7e408p-3 0x1.e6c617c939584p-1 0x1.9ccc03cd122b0p-1",
    "0x1.c4d45f504b208p-3 0x1.dbd0cc5bdc05ap-1 0x1.a1b37a96b6ee1p-1",
    "0x1.c3795e22b04a0p-3 0x1.dd3a658870164p-1 0x1.a461d75cbe6bap-1",
    "0x1.b2e232dc99b80p-3 0x1.e30c2edb139a2p-1 0x1.9ea26e0255f15p-1",
    "0x1.c1d69984edd60p-3 0x1.ded7e6f869a45p-1 0x1.9a6e6c1927d1bp-1",
)
"""A hexahedron of a million random points; on edge 14 its Jacobian is almost zero."""


def test_what_almost_touches_zero_is_decided() -> None:
    points = np.array([[*map(float.fromhex, row.split())] for row in ALMOST_ZERO])
    exact = bernstein_coefficients([tuple(map(Fraction, p)) for p in points.tolist()])
    start, middle, end = exact[0, 0, 0], exact[0, 1, 0], exact[0, 2, 0]
    assert middle < 0 < start * end - middle**2 < start * end / 10**6
    assert positive([points]).tolist() == [1]


@pytest.mark.parametrize(("shift", "want"), [(-(10**-5), -1), (0, 0), (10**-5, 1)])
def test_what_touches_zero_inside_is_undecided(shift: float, want: int) -> None:
    """The sum of three squares: zero at (1/3, 1/3, 1/3) only, which no halving meets."""
    own = [int(9 * 10**30 * x) for x in quadratic(Fraction(1, 3), Fraction(shift) / 3)]
    coefficients = {index: sum(own[i] for i in index) for index in np.ndindex(3, 3, 3)}
    assert jacobian._decided(coefficients) == want


@pytest.mark.parametrize("bad", [float("nan"), float("inf"), None])
def test_what_is_no_number_is_refused(bad: object) -> None:
    points = CUBE.tolist()
    points[3][1] = bad
    with pytest.raises(ValueError, match="finite number"):
        positive([points])


@pytest.mark.parametrize("shape", [(8, 3), (1, 7, 3), (1, 8, 2)])
def test_another_shape_is_refused(shape: tuple[int, ...]) -> None:
    with pytest.raises(ValueError, match="shape"):
        positive(np.zeros(shape))


def test_nothing_has_no_answers() -> None:
    assert positive(np.zeros((0, 8, 3))).tolist() == []


def test_doctests() -> None:
    failed, tried = doctest.testmod(jacobian)
    assert tried
    assert not failed
