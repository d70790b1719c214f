"""Small integer points that realize a pattern: start, improve, round, shrink.

A start is a perturbed cube, or points whose determinants approach a sign vector that a solver
drew from the kernel's formula. From there the smallest of all the quantities that must be positive
(determinants, distances to supporting planes, Bernstein coefficients) is made as large as it gets.
Random affine images of the result, rounded to coarser and coarser grids, are then sieved for exact
witnesses: all three properties are invariant under affine maps, so there are many to choose from.
"""

from collections.abc import Iterable, Iterator, Mapping
from itertools import combinations, product
from math import comb
from typing import Any, TypeAlias

import numpy as np
from numpy.typing import NDArray
from pysat.solvers import Solver
from scipy.optimize import minimize

from certify.kernel.chirotope import QUADRUPLES, QUINTUPLES, dependence
from certify.kernel.hexahedron import CORNERS, VERTICES, Simplex
from certify.kernel.orientations import (
    VARIABLES,
    convex_formula,
    has_sign,
    realization_formula,
)

Array: TypeAlias = NDArray[Any]

MAX_WIDTH = 20
"""Widest grid tried: coordinates 0..20, which centred are at most 10 in absolute value."""

CUBE: Array = 2.0 * np.array([CORNERS[vertex] for vertex in VERTICES]) - 1
_QUADS: Array = np.array(QUADRUPLES) - 1
_PAIRS: Array = np.array([(v, w) for v in range(8) for w in range(8) if v != w])


def place(
    orientation: Mapping[Simplex, int],
    *,
    convex: bool,
    valid: bool,
    rng: np.random.Generator,
    starts: int = 400,
    enough: int = 4,
) -> Array | None:
    """Return eight integer points, one a row, that realize the pattern as asked, or None.

    Of the witnesses that ``enough`` successful starts lead to, the one on the coarsest grid.
    """
    sieve = Sieve(orientation, convex, valid)
    best, width, successes = None, MAX_WIDTH + 1, 0
    for start in starting_points(orientation, convex, valid, rng, starts):
        improved = improve(start, orientation, convex, valid)
        exact = [points for points in (improved, start) if len(sieve(np.rint(2000 * points)[None]))]
        if not exact:
            continue
        points = exact[0]
        successes += 1
        for smaller in range(1, width):
            witnesses = sieve(rounded_images(points, smaller, rng))
            if len(witnesses):
                best, width = witnesses[0], smaller
                break
        if successes == enough:
            break
    return best


def starting_points(
    orientation: Mapping[Simplex, int],
    convex: bool,
    valid: bool,
    rng: np.random.Generator,
    starts: int,
) -> Iterator[Array]:
    """Yield the cube, then perturbed cubes and, unless validity is asked for, sampled points."""
    yield CUBE
    formula = (convex_formula if convex else realization_formula)(orientation)
    with Solver("minisat22", bootstrap_with=formula) as solver:
        for n in range(starts):
            if valid or n % 2:
                noise = rng.normal(size=(8, 3)) * rng.choice([0.1, 0.3, 0.5])
                yield np.clip(0.6 * CUBE + noise, -1, 1)
            else:
                yield approach(sampled_signs(solver, rng), rng)


def sampled_signs(solver: Solver, rng: np.random.Generator) -> Array:
    """Return the signs of the 70 quadruples in a model of the solver's formula, drawn at random."""
    phases = np.arange(1, VARIABLES + 1) * rng.choice([-1, 1], VARIABLES)
    solver.set_phases(phases.tolist())
    assumed: list[int] = []
    for quadruple in rng.permutation(len(QUADRUPLES))[:25]:
        literal = has_sign(QUADRUPLES[quadruple], int(rng.choice([-1, 1])))
        if solver.solve(assumptions=[*assumed, literal]):
            assumed.append(literal)
    solver.solve(assumptions=assumed)
    model = solver.get_model()
    return np.array([model[2 * k] > 0 for k in range(len(QUADRUPLES))]) * 2 - 1


def approach(signs: Array, rng: np.random.Generator) -> Array:
    """Return points whose determinants have, as nearly as a descent finds, the given signs."""

    def loss(flat: Array) -> tuple[float, Array]:
        values, gradients = determinants(flat.reshape(8, 3), _QUADS)
        gap = np.maximum(0, 0.1 - signs * values)
        return float(gap @ gap), -2 * np.tensordot(gap * signs, gradients, 1).ravel()

    start = rng.uniform(-1, 1, 24)
    result = minimize(loss, start, jac=True, method="L-BFGS-B", bounds=[(-1.5, 1.5)] * 24)
    return np.asarray(np.clip(result.x.reshape(8, 3) / 1.5, -1, 1))


def determinants(points: Array, quadruples: Array) -> tuple[Array, Array]:
    """Return the determinants of rows of indices, shape (n,), and their gradients (n, 8, 3)."""
    a, b, c, d = (points[quadruples[:, i]] for i in range(4))
    b, c, d = b - a, c - a, d - a
    by_b, by_c, by_d = np.cross(c, d), np.cross(d, b), np.cross(b, c)
    gradients = np.zeros((len(quadruples), 8, 3))
    for i, part in enumerate((-(by_b + by_c + by_d), by_b, by_c, by_d)):
        gradients[np.arange(len(quadruples)), quadruples[:, i]] = part
    return np.einsum("ni,ni->n", b, by_b), gradients


def _bernstein_tables() -> tuple[Array, Array]:
    """Return the 64 triples of edges, indices of shape (64, 3, 2), and their weights (27, 64)."""
    index = {corner: vertex - 1 for vertex, corner in CORNERS.items()}
    edges, weights = [], np.zeros((3, 3, 3, 64))
    for n, (v1, w1, u2, w2, u3, v3) in enumerate(product((0, 1), repeat=6)):
        ends = (
            ((0, v1, w1), (1, v1, w1)),
            ((u2, 0, w2), (u2, 1, w2)),
            ((u3, v3, 0), (u3, v3, 1)),
        )
        edges.append([[index[corner] for corner in edge] for edge in ends])
        i, j, k = u2 + u3, v1 + v3, w1 + w2
        weights[i, j, k, n] = 1 / (comb(2, i) * comb(2, j) * comb(2, k))
    return np.array(edges), weights.reshape(27, 64)


_EDGES, _WEIGHTS = _bernstein_tables()


def bernstein(points: Array) -> tuple[Array, Array]:
    """Return the 27 Bernstein coefficients of the Jacobian and their gradients (27, 8, 3)."""
    u, v, w = (points[_EDGES[:, i, 1]] - points[_EDGES[:, i, 0]] for i in range(3))
    parts = (np.cross(v, w), np.cross(w, u), np.cross(u, v))
    gradients = np.zeros((64, 8, 3))
    for i, part in enumerate(parts):
        gradients[np.arange(64), _EDGES[:, i, 1]] += part
        gradients[np.arange(64), _EDGES[:, i, 0]] -= part
    return _WEIGHTS @ np.einsum("ni,ni->n", u, parts[0]), np.tensordot(_WEIGHTS, gradients, 1)


def improve(start: Array, orientation: Mapping[Simplex, int], convex: bool, valid: bool) -> Array:
    """Return points in [-1,1]^3 near a local maximum of the least margin.

    Variables: 24 coordinates; for convexity 24 more, a vector for each vertex in whose direction
    it lies beyond all others; last the margin, below every constraint.
    """
    quadruples = np.array(list(orientation)) - 1
    signs = np.array(list(orientation.values()))
    directions = start - start.mean(axis=0)
    variables = np.concatenate([start.ravel(), directions.ravel() if convex else [], [-1.0]])

    def constraints(z: Array) -> tuple[Array, Array]:
        points = z[:24].reshape(8, 3)
        values, gradients = determinants(points, quadruples)
        blocks = [(signs * values, signs[:, None, None] * gradients)]
        if valid:
            blocks.append(bernstein(points))
        jacobian = np.zeros((sum(len(values) for values, _ in blocks), len(z)))
        jacobian[:, :24] = np.concatenate([g.reshape(-1, 24) for _, g in blocks])
        values = np.concatenate([values for values, _ in blocks])
        if convex:
            distances, slopes = distances_beyond(points, z[24:48].reshape(8, 3))
            values = np.concatenate([values, 3 * distances])
            jacobian = np.vstack([jacobian, np.pad(3 * slopes, [(0, 0), (0, 1)])])
        jacobian[:, -1] = -1
        return values - z[-1], jacobian

    objective = np.zeros(len(variables))
    objective[-1] = -1
    result = minimize(
        lambda z: -z[-1],
        variables,
        jac=lambda _: objective,
        bounds=[(-1, 1)] * (len(variables) - 1) + [(-5, 1)],
        constraints={
            "type": "ineq",
            "fun": lambda z: constraints(z)[0],
            "jac": lambda z: constraints(z)[1],
        },
        method="SLSQP",
        options={"maxiter": 150, "ftol": 1e-5},
    )
    return np.asarray(result.x[:24].reshape(8, 3))


def distances_beyond(points: Array, directions: Array) -> tuple[Array, Array]:
    """Return how far v lies beyond w in v's direction, for all v != w, and the slopes (56, 48)."""
    v, w = _PAIRS.T
    apart = points[v] - points[w]
    slopes = np.zeros((len(_PAIRS), 2, 8, 3))
    rows = np.arange(len(_PAIRS))
    slopes[rows, 0, v] = directions[v]
    slopes[rows, 0, w] = -directions[v]
    slopes[rows, 1, v] = apart
    return np.einsum("ni,ni->n", directions[v], apart), slopes.reshape(-1, 48)


def rounded_images(points: Array, width: int, rng: np.random.Generator, n: int = 4000) -> Array:
    """Return affine images of the points rounded to the grid {0..width}^3, shape (m, 8, 3)."""
    maps = np.eye(3) + rng.normal(size=(n, 3, 3)) * rng.choice([0, 0.1, 0.3, 0.6], (n, 1, 1))
    maps *= np.sign(np.linalg.det(maps))[:, None, None]
    images = np.einsum("vi,nij->nvj", points, maps)
    low, high = images.min(axis=1, keepdims=True), images.max(axis=1, keepdims=True)
    images = (images - low) / (high - low) * width + rng.uniform(-0.3, 0.3, (n, 1, 3))
    return np.unique(np.clip(np.rint(images), 0, width).astype(int), axis=0)


class Sieve:
    """Selects the exact witnesses among many integer placements at once (64-bit integers)."""

    def __init__(self, orientation: Mapping[Simplex, int], convex: bool, valid: bool) -> None:
        self.tetrahedra = np.array([QUADRUPLES.index(t) for t in orientation])
        self.signs = np.array(list(orientation.values()))
        self.forbidden_pair = np.zeros(256, dtype=bool)
        self.forbidden_side = np.zeros(256, dtype=bool)
        for tetrahedron in orientation:
            for size in (1, 2, 3, 4):
                for face in combinations(tetrahedron, size):
                    self.forbidden_pair[_bits(face)] = True
        if convex:
            self.forbidden_side[[_bits((vertex,)) for vertex in VERTICES]] = True
        self.valid = valid

    def __call__(self, placements: Array) -> Array:
        """Return those of the placements, shape (n, 8, 3), that are witnesses."""
        placements = placements.astype(np.int64)
        for step in (self._oriented, self._embedded, self._positive):
            placements = placements[step(placements)]
        return placements

    def _oriented(self, placements: Array) -> Array:
        values = _determinants(placements, _QUADS[self.tetrahedra])
        return np.asarray((values * self.signs > 0).all(axis=1))

    def _embedded(self, placements: Array) -> Array:
        chirotopes = np.sign(_determinants(placements, _QUADS))
        good = np.ones(len(placements), dtype=bool)
        for terms in map(dependence, QUINTUPLES):
            columns = [QUADRUPLES.index(quadruple) for _, quadruple, _ in terms]
            values = chirotopes[:, columns] * np.array([sign for _, _, sign in terms])
            bits = np.array([_bits((vertex,)) for vertex, _, _ in terms])
            positive, negative = (values > 0) @ bits, (values < 0) @ bits
            good &= ~(self.forbidden_pair[positive] & self.forbidden_pair[negative])
            good &= ~(self.forbidden_side[positive] | self.forbidden_side[negative])
        return good

    def _positive(self, placements: Array) -> Array:
        if not self.valid:
            return np.ones(len(placements), dtype=bool)
        u, v, w = (
            placements[:, _EDGES[:, i, 1]] - placements[:, _EDGES[:, i, 0]] for i in range(3)
        )
        jacobians = (u * np.cross(v, w)).sum(axis=-1)
        return np.asarray((jacobians @ _WEIGHTS.T > 1e-6).all(axis=1))


def _bits(vertices: Iterable[int]) -> int:
    return sum(1 << (vertex - 1) for vertex in vertices)


def _determinants(placements: Array, quadruples: Array) -> Array:
    """Return the determinants of many placements, shape (n, len(quadruples))."""
    a, b, c, d = (placements[:, quadruples[:, i]] for i in range(4))
    return np.asarray(((b - a) * np.cross(c - a, d - a)).sum(axis=-1))
