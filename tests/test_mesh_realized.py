"""Signs and realized triangulations of arrays are those that the kernel finds, one by one."""

import doctest
from fractions import Fraction
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import certify.mesh
from certify.kernel.certificate import PATTERN_NAMES, Yes, read_certificate
from certify.kernel.chirotope import QUADRUPLES, chirotope
from certify.kernel.embedding import NotRealized, require_realization
from certify.kernel.evidence import Evidence
from certify.kernel.hexahedron import BOUNDARIES, CORNERS
from certify.kernel.triangulation import boundary_diagonals, orbit, orientation
from certify.mesh import realized
from certify.mesh.realized import embedded, fillable, labelled, triangulations
from certify.mesh.signs import numbers, orientations, signs
from tests.commands import CHECKOUT

CUBE = np.array([*CORNERS.values()], float)


def exact(points: Any) -> list[tuple[Fraction, ...]]:
    return [tuple(map(Fraction, point)) for point in np.asarray(points).tolist()]


def by_the_kernel(points: Any) -> list[int]:
    return [*chirotope(exact(points)).values()]


def realized_by_the_kernel(points: Any) -> list[bool]:
    found = chirotope(exact(points))
    return [_realizes(dict(own.signs), found) for own in labelled()]


def _realizes(oriented: dict[Any, int], found: Any) -> bool:
    try:
        require_realization(oriented, found)
    except NotRealized:
        return False
    return True


unhurried = settings(deadline=None)
"""The first example waits for the compiler."""

# The table.


def test_the_table_has_every_instance_once() -> None:
    names = [own.pattern for own in labelled()]
    assert len(names) == len({own.tetrahedra for own in labelled()}) == 6966
    assert set(names) == set(PATTERN_NAMES)
    assert [own.boundary for own in labelled()] == sorted(own.boundary for own in labelled())


def test_the_table_is_what_the_kernel_says() -> None:
    for own in labelled()[::29]:
        assert dict(own.signs) == orientation(own.tetrahedra)
        assert BOUNDARIES[own.boundary] == boundary_diagonals(own.tetrahedra)
        content = Evidence(CHECKOUT).certificate(own.pattern)
        assert own.tetrahedra in orbit(read_certificate(own.pattern, content).tetrahedra)


# The signs.

LATTICE = st.integers(-2, 2)
SIZES = st.sampled_from([1.0, 0.1, 1 / 3, 2.0**-60, 2.0**-300, 2.0**300, 2.0**-1074, 1e-200])
WILD = st.floats(allow_nan=False, allow_infinity=False)


def eight(coordinate: st.SearchStrategy[Any]) -> st.SearchStrategy[Any]:
    return st.lists(st.lists(coordinate, min_size=3, max_size=3), min_size=8, max_size=8)


@unhurried
@given(eight(LATTICE), SIZES)
def test_signs_of_small_lattices(points: list[list[int]], size: float) -> None:
    scaled = np.array(points) * size
    assert signs([scaled])[0].tolist() == by_the_kernel(scaled)


@unhurried
@given(eight(WILD))
def test_signs_of_any_floats(points: list[list[float]]) -> None:
    assert signs([points])[0].tolist() == by_the_kernel(points)


@unhurried
@given(eight(LATTICE), st.integers(0, 7), st.integers(0, 2), st.integers(-3, 3))
def test_signs_next_to_a_degenerate_position(
    points: list[list[int]], vertex: int, axis: int, steps: int
) -> None:
    moved = np.array(points) + 0.1
    for _ in range(abs(steps)):
        moved[vertex, axis] = np.nextafter(moved[vertex, axis], np.inf * np.sign(steps))
    assert signs([moved])[0].tolist() == by_the_kernel(moved)


@unhurried
@given(eight(st.fractions(max_denominator=7)))
def test_signs_of_fractions(points: list[list[Fraction]]) -> None:
    want = [*chirotope([tuple(point) for point in points]).values()]
    assert signs([points])[0].tolist() == want
    assert orientations(points, np.array(QUADRUPLES) - 1).tolist() == want


@unhurried
@given(eight(st.integers(-(10**40), 10**40)))
def test_signs_of_large_integers(points: list[list[int]]) -> None:
    assert signs([points])[0].tolist() == by_the_kernel(np.array(points, object))


@unhurried
@given(eight(LATTICE), SIZES)
def test_orientations_are_signs(points: list[list[int]], size: float) -> None:
    scaled = np.array(points) * size
    rows = np.array(QUADRUPLES) - 1
    assert orientations(scaled, rows).tolist() == signs([scaled])[0].tolist()


@pytest.mark.parametrize("bad", [float("nan"), float("inf"), "1", None, 1j, [1]])
def test_what_is_no_number_is_refused(bad: object) -> None:
    points: list[list[Any]] = CUBE.tolist()
    points[3][1] = bad
    with pytest.raises(ValueError, match=r"finite number|inhomogeneous"):
        signs([points])


@pytest.mark.parametrize("shape", [(8, 3), (1, 7, 3), (1, 8, 2), (1, 1, 8, 3)])
def test_another_shape_is_refused(shape: tuple[int, ...]) -> None:
    with pytest.raises(ValueError, match="shape"):
        signs(np.zeros(shape))


def test_numbers_are_floats_only_if_they_are_the_same() -> None:
    assert numbers([[2**53]]).dtype == np.float64
    assert numbers([[2**53 + 1]]).dtype == object
    assert numbers([[Fraction(1, 3)]])[0, 0] == Fraction(1, 3)
    assert numbers([[10**400]])[0, 0] == 10**400


# The triangulations.


@pytest.mark.parametrize("size", [0, 0.1, 0.3, 1, 2])
def test_triangulations_of_bent_cubes(size: float) -> None:
    points = CUBE + size * (np.random.default_rng(7).random((4, 8, 3)) - 0.5)
    found = triangulations(points)
    for own, hexahedron in zip(found, points, strict=True):
        assert own.tolist() == realized_by_the_kernel(hexahedron)
    assert found.any()


@pytest.mark.parametrize("seed", range(6))
def test_triangulations_of_degenerate_positions(seed: int) -> None:
    """Points of a lattice next to the cube's: coplanar, collinear, coincident ones too."""
    points = 2 * CUBE + np.random.default_rng(seed).integers(-1, 2, (8, 3))
    found = triangulations([points])[0]
    assert (signs([points]) == 0).any()
    assert found.tolist() == realized_by_the_kernel(points)


def test_the_certificates_points_realize_their_pattern() -> None:
    columns = {own.tetrahedra: index for index, own in enumerate(labelled())}
    shown = 0
    for name in PATTERN_NAMES:
        certificate = read_certificate(name, Evidence(CHECKOUT).certificate(name))
        for answer in certificate.answers.values():
            if isinstance(answer, Yes):
                (found,) = triangulations([answer.points])
                assert found[columns[tuple(sorted(certificate.tetrahedra))]]
                shown += 1
    assert shown > 3 * 140


def test_a_mirrored_hexahedron_has_none() -> None:
    assert not triangulations([CUBE * (1, 1, -1)]).any()


def test_the_boundaries_of_the_cube() -> None:
    """All 64 are embedded, 46 can be filled, and no triangulation of another is realized."""
    chirotopes = signs([CUBE])
    found = triangulations([CUBE])
    assert embedded(chirotopes).all()
    filled = {own.boundary for own, yes in zip(labelled(), found[0], strict=True) if yes}
    assert np.flatnonzero(fillable(found)[0]).tolist() == sorted(filled)
    assert len(filled) == 46


def test_a_boundary_that_crosses_itself_is_not_embedded() -> None:
    """With vertex 7 pulled through facet 1234, its triangles pass through that facet's."""
    points = CUBE.copy()
    points[6] = (0.6, 0.6, -1)
    assert not embedded(signs([points])).any()


def test_doctests() -> None:
    for module in (certify.mesh, realized):
        failed, tried = doctest.testmod(module)
        assert tried
        assert not failed
