"""Small integer points that realize a pattern, found by walking on a grid.

A step moves one vertex to where the fewest conditions fail, of some places drawn at random. All is
done in integers, so the points depend on the random seed alone and on no machine. A hexahedron that
is not valid is then brought to as coarse a grid as the walks reach. Valid ones climb: each witness
sets the bar for the next, whose least scaled Jacobian at the corners has to be larger.
"""

from collections.abc import Iterator, Mapping
from fractions import Fraction

import numpy as np

from certify.kernel.hexahedron import CORNERS, VERTICES, Simplex
from certify.search.sieve import Array, Sieve, shape

WIDTH = 10
"""Width of the grid: coordinates are 0..10."""

PLACES = 64
"""Places that a step chooses from."""

PATIENCE = 100
"""Steps without progress after which a walk ends."""

CUBE: Array = np.array([CORNERS[vertex] for vertex in VERTICES])


def place(
    orientation: Mapping[Simplex, int],
    *,
    convex: bool,
    valid: bool,
    rng: np.random.Generator,
    starts: int = 400,
) -> Array | None:
    """Return eight integer points, one a row, that realize the pattern as asked, or None.

    If valid, the best shaped that was found; else the one on the coarsest grid.
    """
    sieve = Sieve(orientation, convex, valid)
    return (best_shaped if valid else coarsest)(sieve, rng, starts)


def coarsest(sieve: Sieve, rng: np.random.Generator, starts: int) -> Array | None:
    """Return the first witness that is found, brought to as coarse a grid as the walks reach."""
    for _ in range(starts):
        start = rng.integers(0, WIDTH + 1, (8, 3))
        if (witness := walk(start, sieve, rng, WIDTH, reach=WIDTH)) is not None:
            return squeeze(witness, sieve, rng, tries=100)
    return None


def squeeze(witness: Array, sieve: Sieve, rng: np.random.Generator, tries: int) -> Array:
    """Return the witness on the coarsest grid before so many walks to the next coarser one fail."""
    width = WIDTH
    while tries:
        closer: Array = witness - (2 * witness > width)
        found = walk(closer, sieve, rng, width - 1, reach=width)
        if found is None:
            tries -= 1
        else:
            witness, width = found, width - 1
    return witness


def best_shaped(sieve: Sieve, rng: np.random.Generator, starts: int) -> Array | None:
    """Return the best shaped of ten witnesses that climb, the three best of them for longer."""
    witnesses: list[Array] = []
    for start in perturbed_cubes(rng, starts):
        sieve.bar = Fraction(0)
        if (witness := walk(start, sieve, rng, WIDTH, reach=WIDTH)) is not None:
            witnesses.append(climb(witness, sieve, rng, tries=1))
        if len(witnesses) == 10:
            break
    best = sorted(witnesses, key=shape, reverse=True)[:3]
    climbed = [climb(witness, sieve, rng, tries=15) for witness in best]
    if not climbed:
        return None
    points = max(climbed, key=shape)
    points = points - points.min(axis=0)
    return np.asarray(points // np.gcd.reduce(points, axis=None))


def perturbed_cubes(rng: np.random.Generator, starts: int) -> Iterator[Array]:
    """Yield the cube, then cubes whose vertices are moved inwards at random."""
    yield WIDTH * CUBE
    for _ in range(starts):
        yield WIDTH // 2 * CUBE + rng.integers(0, WIDTH // 2 + 1, (8, 3))


def climb(witness: Array, sieve: Sieve, rng: np.random.Generator, tries: int) -> Array:
    """Return the best shaped witness that is reached before so many walks find no better one."""
    sieve.bar = shape(witness)
    while tries and sieve.bar < 1:
        better = walk(witness, sieve, rng, WIDTH, reach=2)
        if better is None:
            tries -= 1
        else:
            witness, sieve.bar = better, shape(better)
    return witness


def walk(
    points: Array, sieve: Sieve, rng: np.random.Generator, width: int, reach: int
) -> Array | None:
    """Return a witness in the grid 0..width that the steps lead to, or None if they do not.

    A vertex moves by at most ``reach`` along each axis. It stays only where every move is worse:
    a walk has to drift across plateaus.
    """
    fewest, patience = sieve.failures(points[None])[0], PATIENCE
    while fewest and patience:
        vertex = rng.integers(8)
        low = np.maximum(points[vertex] - reach, 0)
        high = np.minimum(points[vertex] + reach, width)
        moved = np.tile(points, (PLACES + 1, 1, 1))
        moved[:-1, vertex] = rng.integers(low, high + 1, (PLACES, 3))
        failures = sieve.failures(moved)
        best = failures.argmin()
        points = moved[best]
        patience = PATIENCE if failures[best] < fewest else patience - 1
        fewest = min(fewest, failures[best])
    return None if fewest else points
