"""Thousands of valid hexahedra against the clauses, and the identities behind these in symbols.

Everything is exact: hexahedra have integer points, and numpy computes in 64-bit integers that
nothing here overflows.
"""

from collections.abc import Iterable, Iterator, Sequence
from functools import cache
from itertools import combinations, product
from math import prod
from typing import Any, TypeAlias

import numpy as np
import pytest
from numpy.typing import NDArray
from pysat.solvers import Solver
from sympy import ZZ
from sympy.polys.rings import ring

from certify.kernel.certificate import Certificate, No, Yes
from certify.kernel.chirotope import integral
from certify.kernel.hexahedron import Simplex
from certify.kernel.orientations import Clause, bracket, realization_formula
from certify.kernel.triangulation import orientation
from certify.kernel.validity import across, corners, edges, sections, valid_formula
from certify.search.sieve import Sieve
from tests.geometry import (
    CUBE,
    QUADRUPLES,
    VERTICES,
    Tetrahedra,
    Vector,
    sign,
    signs_of,
    true_literals,
    volume,
)

Integers: TypeAlias = NDArray[np.int64]
Truth: TypeAlias = NDArray[np.bool_]

AXES = range(3)

OPPOSITE: tuple[tuple[Simplex, Simplex], ...] = (
    ((1, 4, 5, 8), (2, 3, 6, 7)),
    ((1, 2, 5, 6), (4, 3, 8, 7)),
    ((1, 2, 3, 4), (5, 6, 7, 8)),
)
"""The opposite facets, with corresponding vertices in corresponding places."""


def test_across_changes_the_given_coordinates_only() -> None:
    for vertex in VERTICES:
        for axes in [(), *combinations(AXES, 1), *combinations(AXES, 2), (0, 1, 2)]:
            moved = [x ^ (axis in axes) for axis, x in enumerate(CUBE[vertex - 1])]
            assert CUBE[across(vertex, *axes) - 1] == tuple(moved)


# The identities, for indeterminate points.


@cache
def jacobian() -> tuple[Any, list[Vector], Any]:
    """Return the Jacobian of the trilinear map, the eight points, and the three coordinates.

    All are elements of one ring of polynomials with integer coefficients.
    """
    domain, *symbols = ring("u v w " + " ".join(f"{x}{i}" for i in VERTICES for x in "xyz"), ZZ)
    coordinates, rest = symbols[:3], symbols[3:]
    points = [tuple(rest[i : i + 3]) for i in range(0, 24, 3)]
    image = [domain.zero] * 3
    for corner, point in zip(CUBE, points, strict=True):
        weight = domain.one
        for bit, x in zip(corner, coordinates, strict=True):
            weight *= x if bit else 1 - x
        image = [total + weight * x for total, x in zip(image, point, strict=True)]
    columns = [tuple(f.diff(x) for f in image) for x in coordinates]
    origin = (domain.zero,) * 3
    return volume(origin, *columns), points, coordinates


def det(*vertices: int) -> Any:
    """Return [abcd] for the indeterminate points."""
    points = jacobian()[1]
    return volume(*(points[vertex - 1] for vertex in vertices))


def positive_at(vertices: Simplex) -> int:
    """Return the sign of the determinant at the unit cube, whose Jacobian is 1."""
    return sign(volume(*(CUBE[vertex - 1] for vertex in vertices)))


def test_corner_clauses_say_that_the_jacobian_is_positive_there() -> None:
    polynomial, _, coordinates = jacobian()
    clauses = []
    for vertex in VERTICES:
        four = (vertex, *(across(vertex, axis) for axis in AXES))
        here = polynomial.evaluate(list(zip(coordinates, CUBE[vertex - 1], strict=True)))
        there = det(*four) * positive_at(four)
        assert here.as_expr() == there.as_expr()
        clauses.append((bracket(four, positive_at(four)),))
    assert list(corners()) == clauses


EDGES = [(v, axis) for v in VERTICES for axis in AXES if across(v, axis) > v]
"""Each of the twelve edges by one end and its direction."""


@pytest.mark.parametrize(("v", "axis"), EDGES)
def test_jacobian_on_an_edge(v: int, axis: int) -> None:
    """The formula for J(t), the Grassmann-Pluecker relation, and the clauses that they imply."""
    j, k = (other for other in AXES if other != axis)
    w = across(v, axis)
    p, q, pp, qq = across(v, j), across(v, k), across(w, j), across(w, k)
    e = positive_at((v, w, p, q))
    a, b, c, d = (e * det(v, w, x, y) for x, y in ((p, q), (p, qq), (pp, q), (pp, qq)))

    polynomial, _, coordinates = jacobian()
    t = coordinates[axis] if CUBE[v - 1][axis] == 0 else 1 - coordinates[axis]
    fixed = [(coordinates[other], CUBE[v - 1][other]) for other in (j, k)]
    on_edge = polynomial.subs(fixed)
    assert on_edge == a * (1 - t) ** 2 + (b + c) * t * (1 - t) + d * t**2

    assert a * d - b * c == det(v, w, p, pp) * det(v, w, q, qq)

    not_both = (-bracket((v, w, p, qq), -e), -bracket((v, w, pp, q), -e))
    expected = {
        frozenset((*not_both, bracket((v, w, p, pp), s), bracket((v, w, q, qq), -s)))
        for s in (1, -1)
    }
    assert expected <= set(map(frozenset, edges()))
    assert len(list(edges())) == 2 * len(EDGES) == 24


# Random valid hexahedra.


def jacobian_values(placements: Integers, steps: int) -> Integers:
    """Return steps^6 times the Jacobian at the points of a grid, shape (steps + 1, .. 3 times, n).

    The derivative in one direction is the mean of the four edges in that direction, weighted.
    """
    grid = list(product(range(steps + 1), repeat=3))
    values = np.empty((steps + 1, steps + 1, steps + 1, len(placements)), dtype=np.int64)
    for place in grid:
        columns = np.zeros((3, len(placements), 3), dtype=np.int64)
        for (vertex, corner), axis in product(enumerate(CUBE), AXES):
            near = (x if bit else steps - x for x, bit in zip(place, corner, strict=True))
            weights = [w for other, w in enumerate(near) if other != axis]
            if all(weights):
                columns[axis] += (2 * corner[axis] - 1) * prod(weights) * placements[:, vertex]
        values[place] = (columns[0] * np.cross(columns[1], columns[2])).sum(axis=-1)
    return values


def are_valid(placements: Integers) -> Truth:
    """Return which Jacobians are seen to be positive after one subdivision of the cube.

    On each of the eight parts all Bernstein coefficients are positive. Those of a quadratic
    polynomial f on [0,1] are f(0), 2 f(1/2) - (f(0) + f(1)) / 2 and f(1).
    """
    good = np.asarray((jacobian_values(placements, 1) > 0).all(axis=(0, 1, 2)))
    values = jacobian_values(placements[good], 4)
    positive = np.ones(values.shape[-1], dtype=np.bool_)
    for x, y, z in product((0, 2), repeat=3):
        part = values[x : x + 3, y : y + 3, z : z + 3]
        for axis in AXES:
            start, middle, end = np.moveaxis(part, axis, 0)
            part = np.moveaxis(np.stack([2 * start, 4 * middle - start - end, 2 * end]), 0, axis)
        positive &= (part > 0).all(axis=(0, 1, 2))
    good[good] = positive
    return good


def twisted_cubes(rng: np.random.Generator, count: int) -> Iterator[Integers]:
    """Yield perturbed cubes, flat or not, with the top turned about the vertical axis."""
    cube = 2.0 * np.array(CUBE) - 1
    for noise, twist, height in product((0.1, 0.3, 0.5, 0.7), (0, 1.2, 2.5), (0.2, 1)):
        angles = rng.uniform(-twist, twist, count)
        turn = np.array([[np.cos(angles), np.sin(angles)], [-np.sin(angles), np.cos(angles)]])
        placements = np.repeat(cube[None], count, axis=0)
        placements[:, 4:, :2] = np.einsum("vi,ijn->nvj", cube[4:, :2], turn)
        placements[:, :, 2] *= height
        placements += noise * rng.normal(size=placements.shape)
        maps = np.eye(3) + 0.2 * rng.normal(size=(count, 3, 3))
        yield np.rint(200 * np.einsum("nvi,nij->nvj", placements, maps)).astype(np.int64)


@pytest.fixture(scope="module")
def hexahedra() -> Integers:
    """Return tens of thousands of valid hexahedra; each axis comes first in a third of them."""
    found = []
    for n, placements in enumerate(twisted_cubes(np.random.default_rng(8), 12_000)):
        turned = np.array([relabelled(n % 3, vertex) for vertex in VERTICES]) - 1
        found.append(placements[are_valid(placements)][:, turned])
    return np.concatenate(found)


def relabelled(turns: int, vertex: int) -> int:
    """Return the vertex whose corner is that of the given one with the axes turned cyclically."""
    corner = CUBE[vertex - 1]
    return CUBE.index((*corner[turns:], *corner[:turns])) + 1


def determinants(placements: Integers, quadruples: Sequence[Simplex]) -> Integers:
    """Return one row a placement, one column a quadruple."""
    columns = []
    for quadruple in quadruples:
        a, b, c, d = (placements[:, vertex - 1] for vertex in quadruple)
        columns.append(((b - a) * np.cross(c - a, d - a)).sum(axis=-1))
    return np.array(columns).T


def literals(placements: Integers) -> dict[int, Truth]:
    """Return which placements satisfy each literal."""
    truth: dict[int, Truth] = {}
    for k, values in enumerate(determinants(placements, QUADRUPLES).T, start=1):
        for literal, holds in ((2 * k - 1, values > 0), (2 * k, values < 0)):
            truth[literal], truth[-literal] = holds, ~holds
    return truth


def satisfied(clauses: Iterable[Clause], truth: dict[int, Truth]) -> Truth:
    """Return which placements satisfy all the clauses."""
    each = [np.any([truth[literal] for literal in clause], axis=0) for clause in clauses]
    return np.asarray(np.all(each, axis=0))


def separated(placements: Integers, a: Simplex, b: Simplex) -> Truth:
    """Return where some plane strictly separates two quadruples, the first not coplanar.

    The differences of points of the two hulls form a polytope. It does not contain zero iff one of
    its facets separates it from zero. A facet is parallel to a triangle of one quadruple, or to an
    edge of each.
    """
    first, second = placements[:, np.array(a) - 1], placements[:, np.array(b) - 1]
    normals = [
        np.cross(hull[:, j] - hull[:, i], hull[:, k] - hull[:, i])
        for hull in (first, second)
        for i, j, k in combinations(range(4), 3)
    ]
    normals += [
        np.cross(first[:, j] - first[:, i], second[:, m] - second[:, k])
        for i, j in combinations(range(4), 2)
        for k, m in combinations(range(4), 2)
    ]
    apart = np.zeros(len(placements), dtype=np.bool_)
    for normal in normals:
        x, y = ((hull * normal[:, None]).sum(axis=-1) for hull in (first, second))
        apart |= (x.max(axis=1) < y.min(axis=1)) | (y.max(axis=1) < x.min(axis=1))
    return apart


def opposite_signs(placements: Integers, axis: int) -> Truth:
    """Return where the two facets across an axis have determinants of strictly opposite signs."""
    first, second = np.sign(determinants(placements, OPPOSITE[axis])).T
    return np.asarray(first * second < 0)


def test_jacobian_of_a_box_is_its_volume() -> None:
    boxes = np.array([CUBE, 2 * np.array(CUBE) + 3])
    assert are_valid(boxes).all()
    assert not are_valid(-boxes).any()
    assert (jacobian_values(boxes, 4) == 4**6 * np.array([1, 8])).all()


def test_hexahedra_are_many(hexahedra: Integers) -> None:
    assert len(hexahedra) > 100_000
    assert np.abs(hexahedra).max() < 2000


def test_valid_hexahedra_satisfy_corners_and_edges(hexahedra: Integers) -> None:
    truth = literals(hexahedra)
    assert satisfied(corners(), truth).all()
    assert satisfied(edges(), truth).all()


def test_edge_clauses_are_not_idle(hexahedra: Integers) -> None:
    """Both mixed coefficients are negative on every edge of many; not valid hexahedra may fail.

    The coefficient between the two ends is their mean: nothing is to be seen without subdivision.
    """
    truth = literals(hexahedra)
    strained = [~truth[first] & ~truth[second] for first, second, *_ in edges()]
    assert np.sum(strained, axis=1).min() > 100
    rng = np.random.default_rng(9)
    placements = np.concatenate(list(twisted_cubes(rng, 500)))
    truth = literals(placements)
    good_corners = satisfied(corners(), truth)
    assert (good_corners & ~satisfied(edges(), truth)).sum() > 30


@pytest.mark.parametrize("axis", AXES)
def test_section_lemma(hexahedra: Integers, axis: int) -> None:
    """Facets with determinants of opposite signs are separated by a plane, others need not be."""
    opposite = opposite_signs(hexahedra, axis)
    apart = separated(hexahedra, *OPPOSITE[axis])
    assert apart[opposite].all()
    assert opposite.sum() > 10_000
    assert (~apart).sum() > 1000


# Triangulations.


def crossing(tetrahedra: Iterable[Simplex], axis: int) -> int:
    """Return vertices - edges + faces of a section between the two facets across an axis."""
    first, second = OPPOSITE[axis]
    cells = [
        {
            tuple(sorted((*x, *y)))
            for x, y in product(combinations(first, m), combinations(second, n))
        }
        for m, n in ((1, 1), (1, 2), (2, 1), (1, 3), (2, 2), (3, 1))
    ]
    counts = [sum(any(set(cell) <= set(t) for t in tetrahedra) for cell in some) for some in cells]
    return counts[0] - sum(counts[1:3]) + sum(counts[3:])


def valid_witnesses(certificates: dict[str, Certificate]) -> Iterator[tuple[Tetrahedra, Integers]]:
    """Yield triangulations and the valid hexahedra that carry them, of shape (1, 8, 3)."""
    for certificate in certificates.values():
        answer = certificate.answers["valid"]
        if isinstance(answer, Yes):
            yield certificate.tetrahedra, np.array([integral(answer.points)])


def test_witnesses_satisfy_all_clauses(certificates: dict[str, Certificate]) -> None:
    for tetrahedra, witness in valid_witnesses(certificates):
        true = true_literals(signs_of(tuple(map(tuple, witness[0].tolist()))))
        formula = valid_formula(orientation(tetrahedra))
        assert not any(true.isdisjoint(clause) for clause in formula)


def test_section_clauses_are_for_sections_that_are_no_discs(
    certificates: dict[str, Certificate],
) -> None:
    found = []
    for certificate in certificates.values():
        expected = [
            (-bracket(first, s), -bracket(second, -s))
            for axis, (first, second) in enumerate(OPPOSITE)
            if crossing(certificate.tetrahedra, axis) != 1
            for s in (1, -1)
        ]
        assert sorted(sections(certificate.tetrahedra)) == sorted(expected)
        found.append(len(expected) // 2)
    assert 0 < sum(found) < 3 * len(found)


@pytest.mark.parametrize("tetrahedra", [[], [(1, 2, 5, 6), (3, 4, 7, 8)]])
def test_section_clauses_forbid_opposite_signs(
    hexahedra: Integers, tetrahedra: list[Simplex]
) -> None:
    """No disc, or two of them, is not one: all three pairs of facets are concerned."""
    few = hexahedra[::100]
    clauses = list(sections(tetrahedra))
    forbidden = np.any([opposite_signs(few, axis) for axis in AXES], axis=0)
    assert len(clauses) == 6
    assert (satisfied(clauses, literals(few)) == ~forbidden).all()
    assert 0 < forbidden.sum() < len(few)


def test_sections_of_realized_triangulations(certificates: dict[str, Certificate]) -> None:
    """Near every witness: facets of opposite signs are separated; separated ones have a disc."""
    rng = np.random.default_rng(10)
    cases = {"opposite": 0, "separated": 0, "no disc": 0}
    for tetrahedra, witness in valid_witnesses(certificates):
        moved = np.concatenate([10 * witness, 10 * witness + rng.integers(-9, 10, (200, 8, 3))])
        sieve = Sieve(orientation(tetrahedra), convex=False, valid=True)
        placements = moved[sieve.failures(moved) == 0]
        discs = [crossing(tetrahedra, axis) == 1 for axis in AXES]
        for axis, disc in enumerate(discs):
            opposite = opposite_signs(placements, axis)
            apart = separated(placements, *OPPOSITE[axis])
            assert apart[opposite].all()
            assert disc or not apart.any()
            cases["opposite"] += int(opposite.sum())
            cases["separated"] += int(apart.sum())
            cases["no disc"] += 0 if disc else len(placements)
    assert min(cases.values()) > 100, cases


def satisfiable(formula: Iterable[Clause]) -> bool:
    with Solver("glucose4", bootstrap_with=formula) as solver:
        return bool(solver.solve())


def test_fifteen_patterns_need_the_section_lemma(certificates: dict[str, Certificate]) -> None:
    """They are those that have a convex realization, but no valid one; all have boundary type g."""
    needing = 0
    for certificate in certificates.values():
        convex, valid = certificate.answers["convex"], certificate.answers["valid"]
        if isinstance(convex, Yes) and isinstance(valid, No):
            signs = orientation(certificate.tetrahedra)
            assert satisfiable([*realization_formula(signs), *corners(), *edges()])
            assert not satisfiable(valid_formula(signs))
            assert certificate.boundary == "g"
            needing += 1
    assert needing == 15
