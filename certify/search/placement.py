"""Small integer points that realize a pattern: start, improve, round, shrink or refine.

A start is a perturbed cube, or points whose determinants approach a sign vector that a solver
drew from the kernel's formula. From there the smallest of all the quantities that must be positive
(determinants, distances to supporting planes, Bernstein coefficients) is made as large as it gets.
Random affine images of the result, rounded to a grid, are then sieved for exact witnesses: all
three properties are invariant under affine maps, so there are many to choose from. Of valid
hexahedra the best shaped is kept, of other realizations the one on the coarsest grid.
"""

from collections.abc import Iterator, Mapping
from itertools import product

import numpy as np
from pysat.solvers import Solver
from scipy.optimize import minimize

from certify.kernel.chirotope import QUADRUPLES
from certify.kernel.hexahedron import CORNERS, VERTICES, Simplex
from certify.kernel.orientations import (
    VARIABLES,
    convex_formula,
    has_sign,
    realization_formula,
)
from certify.search.margins import Array, bernstein, determinants, distances_beyond
from certify.search.sieve import QUADS, Sieve, scaled_jacobians

MAX_WIDTH = 20
"""Widest grid tried: coordinates 0..20, which centred are at most 10 in absolute value."""

FINE_WIDTH = 10
"""Width of the grid on which valid hexahedra are refined."""

CUBE: Array = 2.0 * np.array([CORNERS[vertex] for vertex in VERTICES]) - 1
_MOVES: Array = np.array([move for move in product((-2, -1, 0, 1, 2), repeat=3) if any(move)])


def place(
    orientation: Mapping[Simplex, int],
    *,
    convex: bool,
    valid: bool,
    rng: np.random.Generator,
    starts: int = 400,
) -> Array | None:
    """Return eight integer points, one a row, that realize the pattern as asked, or None.

    Of the witnesses that a few successful starts lead to: if valid, the one with the largest
    scaled Jacobian on the fine grid, else the one on the coarsest grid.
    """
    choose, enough = (best_shaped, 10) if valid else (coarsest, 4)
    sieve = Sieve(orientation, convex, valid)
    witnesses: list[Array] = []
    for start in starting_points(orientation, convex, valid, rng, starts):
        improved = improve(start, orientation, convex, valid)
        exact = [points for points in (improved, start) if len(sieve(np.rint(2000 * points)[None]))]
        if exact:
            witnesses.extend(choose(exact[0], sieve, rng))
        if len(witnesses) == enough:
            break
    if not witnesses:
        return None
    if valid:
        return max(witnesses, key=lambda points: (shape(points), -points.max()))
    return min(witnesses, key=lambda points: int(points.max()))


def shape(points: Array) -> float:
    """Return the least scaled Jacobian at the corners, rounded to tell no noise apart."""
    return round(float(scaled_jacobians(points[None])[0]), 9)


def coarsest(points: Array, sieve: Sieve, rng: np.random.Generator) -> list[Array]:
    """Return one witness, an affine image of the points rounded to the coarsest grid there is."""
    for width in range(1, MAX_WIDTH + 1):
        witnesses = sieve(rounded_images(points, width, rng))
        if len(witnesses):
            return [witnesses[0]]
    return []


def best_shaped(points: Array, sieve: Sieve, rng: np.random.Generator) -> list[Array]:
    """Return one witness, the best shaped image on the fine grid, refined vertex by vertex."""
    witnesses = sieve(rounded_images(points, FINE_WIDTH, rng))
    if not len(witnesses):
        return []
    best = witnesses[np.argmax(scaled_jacobians(witnesses))]
    while (better := improved_by_one_vertex(best, sieve)) is not None:
        best = better
    best = best - best.min(axis=0)
    return [best // np.gcd.reduce(best, axis=None)]


def improved_by_one_vertex(points: Array, sieve: Sieve) -> Array | None:
    """Return the best shaped witness with one vertex moved by at most two, if it is better."""
    moved = np.tile(points, (8 * len(_MOVES), 1, 1))
    for vertex in range(8):
        moved[vertex * len(_MOVES) : (vertex + 1) * len(_MOVES), vertex] += _MOVES
    moved = moved[((moved >= 0) & (moved <= FINE_WIDTH)).all(axis=(1, 2))]
    values = scaled_jacobians(moved)
    better = np.argsort(-values, kind="stable")[: int((values > shape(points) + 1e-9).sum())]
    witnesses = sieve(moved[better])
    return witnesses[0] if len(witnesses) else None


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
        values, gradients = determinants(flat.reshape(8, 3), QUADS)
        gap = np.maximum(0, 0.1 - signs * values)
        return float(gap @ gap), -2 * np.tensordot(gap * signs, gradients, 1).ravel()

    start = rng.uniform(-1, 1, 24)
    result = minimize(loss, start, jac=True, method="L-BFGS-B", bounds=[(-1.5, 1.5)] * 24)
    return np.asarray(np.clip(result.x.reshape(8, 3) / 1.5, -1, 1))


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


def rounded_images(points: Array, width: int, rng: np.random.Generator, n: int = 4000) -> Array:
    """Return affine images of the points rounded to the grid {0..width}^3, shape (m, 8, 3)."""
    maps = np.eye(3) + rng.normal(size=(n, 3, 3)) * rng.choice([0, 0.1, 0.3, 0.6], (n, 1, 1))
    maps *= np.sign(np.linalg.det(maps))[:, None, None]
    images = np.einsum("vi,nij->nvj", points, maps)
    low, high = images.min(axis=1, keepdims=True), images.max(axis=1, keepdims=True)
    images = (images - low) / (high - low) * width + rng.uniform(-0.3, 0.3, (n, 1, 3))
    return np.unique(np.clip(np.rint(images), 0, width).astype(int), axis=0)
