"""The formula of all triangulations with a given boundary is right, and its proofs can fail."""

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import replace
from itertools import combinations, product
from pathlib import Path
from shutil import copytree

import numpy as np
import pytest
from pysat.solvers import Solver

from certify.kernel.check import (
    Completeness,
    Verdict,
    check_completeness,
    completeness_formula,
    instances_bounded_by,
)
from certify.kernel.completeness import (
    INNER,
    _count,
    edge_clauses,
    listed,
    triangle_clauses,
    triangulation_formula,
    vertex_clauses,
)
from certify.kernel.evidence import completeness_file
from certify.kernel.hexahedron import BOUNDARY_TYPES, FACETS, Simplex, boundary_triangles
from certify.kernel.orientations import Clause
from certify.kernel.triangulation import boundary_diagonals
from tests.geometry import QUADRUPLES, VERTICES, Tetrahedra

Verdicts = dict[str, Verdict]

NUMBER = {tetrahedron: k for k, tetrahedron in enumerate(INNER, start=1)}

every_boundary = pytest.mark.parametrize("letter", BOUNDARY_TYPES)


def boundary(letter: str) -> set[Simplex]:
    return set(boundary_triangles(BOUNDARY_TYPES[letter]))


def with_boundary(letter: str, verdicts: Verdicts) -> set[Tetrahedra]:
    """Return the accepted instances whose boundary is the representative of its type."""
    return {
        instance
        for verdict in verdicts.values()
        if verdict.boundary == letter
        for instance in verdict.instances
        if boundary_diagonals(instance) == BOUNDARY_TYPES[letter]
    }


def choice(tetrahedra: Iterable[Simplex]) -> list[int]:
    """Return the literals that say "exactly these tetrahedra"."""
    chosen = set(tetrahedra)
    return [k if tetrahedron in chosen else -k for tetrahedron, k in NUMBER.items()]


def variables(clauses: Iterable[Clause]) -> set[int]:
    return {abs(literal) for clause in clauses for literal in clause}


def holds(clauses: Iterable[Clause], true: set[int]) -> bool:
    return not any(true.isdisjoint(clause) for clause in clauses)


def test_variables_are_the_quadruples_that_are_no_facets() -> None:
    facets = {tuple(sorted(facet)) for facet in FACETS}
    assert list(INNER) == [q for q in QUADRUPLES if q not in facets]


# The formula as a whole.


@every_boundary
def test_triangulations_satisfy_the_formula(letter: str, verdicts: Verdicts) -> None:
    """And unit propagation gives every further variable its one value.

    A solver does not tell what it implies without assumptions, so every clause gets one.
    """
    formula = triangulation_formula(BOUNDARY_TYPES[letter])
    instances = with_boundary(letter, verdicts)
    always = max(variables(formula)) + 1
    assert instances
    with Solver("glucose4", bootstrap_with=[(*clause, -always) for clause in formula]) as solver:
        for instance in instances:
            consistent, implied = solver.propagate(assumptions=[always, *choice(instance)])
            assert consistent
            assert sorted(map(abs, implied)) == [*range(1, always + 1)]
            assert holds(formula, set(implied))


@every_boundary
def test_models_are_the_triangulations(letter: str, verdicts: Verdicts) -> None:
    instances = with_boundary(letter, verdicts)
    formula = triangulation_formula(BOUNDARY_TYPES[letter])
    found: set[Tetrahedra] = set()
    with Solver("minisat22", bootstrap_with=formula) as solver:
        while solver.solve() and len(found) <= len(instances):
            model = solver.get_model()[: len(INNER)]
            found.add(tuple(t for t, literal in zip(INNER, model, strict=True) if literal > 0))
            solver.add_clause([-literal for literal in model])
    assert found == instances


def test_instances_are_spread_evenly_over_the_boundaries(verdicts: Verdicts) -> None:
    """The representatives carry what the 64 boundaries carry, each type its share."""
    sizes = dict(zip("abcdefg", (2, 12, 4, 24, 4, 6, 12), strict=True))
    for letter, size in sizes.items():
        total = sum(len(v.instances) for v in verdicts.values() if v.boundary == letter)
        assert total == size * len(with_boundary(letter, verdicts))


def test_listed_excludes_one_choice_only() -> None:
    clause = listed(INNER[3:9])
    assert sorted(clause) == sorted(-literal for literal in choice(INNER[3:9]))


# Families.


@every_boundary
def test_triangle_clauses_count(letter: str) -> None:
    """For each triangle, all choices of the tetrahedra that contain it; clauses have only those."""
    clauses = list(triangle_clauses(boundary(letter)))
    used = 0
    for face in combinations(VERTICES, 3):
        around = [k for t, k in NUMBER.items() if set(face) < set(t)]
        own = [c for c in clauses if variables([c]) <= set(around)]
        used += len(own)
        allowed = {1} if face in boundary(letter) else {0, 2}
        for signs in product((1, -1), repeat=len(around)):
            true = {sign * k for sign, k in zip(signs, around, strict=True)}
            assert holds(own, true) == (signs.count(1) in allowed)
    assert used == len(clauses)


def links(vertices: Sequence[int], ends: set[int], banned: set[Simplex]) -> Iterator[set[Simplex]]:
    """Yield the graphs in which the ends have one neighbour, any other vertex none or two."""
    pairs = [pair for pair in combinations(vertices, 2) if pair not in banned]

    def extend(k: int, chosen: tuple[Simplex, ...]) -> Iterator[set[Simplex]]:
        degree = {v: sum(v in pair for pair in chosen) for v in vertices}
        if any(degree[v] > (1 if v in ends else 2) for v in vertices):
            return
        if k < len(pairs):
            yield from extend(k + 1, chosen)
            yield from extend(k + 1, (*chosen, pairs[k]))
        elif all(degree[v] in ((1,) if v in ends else (0, 2)) for v in vertices):
            yield set(chosen)

    return extend(0, ())


def is_connected(graph: set[Simplex]) -> bool:
    """Can all edges be reached from any one?"""
    rest = [set(pair) for pair in graph]
    reached = rest.pop() if rest else set()
    while more := [pair for pair in rest if pair & reached]:
        reached = reached.union(*more)
        rest = [pair for pair in rest if pair not in more]
    return not rest


@every_boundary
def test_edge_clauses_exclude_all_links_that_are_not_connected(letter: str) -> None:
    """Among the links, of every edge, that satisfy the triangle clauses."""
    clauses = list(edge_clauses(boundary(letter)))
    seen: set[Clause] = set()
    outcomes: set[bool] = set()
    facets = {tuple(sorted(facet)) for facet in FACETS}
    for edge in combinations(VERTICES, 2):
        others = [v for v in VERTICES if v not in edge]
        ends = {v for v in others if tuple(sorted((*edge, v))) in boundary(letter)}
        stars = {pair: tuple(sorted((*edge, *pair))) for pair in combinations(others, 2)}
        own = [c for c in clauses if variables([c]) <= {NUMBER.get(q) for q in stars.values()}]
        for link in links(others, ends, {pair for pair, q in stars.items() if q in facets}):
            true = {k if pair in link else -k for pair, q in stars.items() if (k := NUMBER.get(q))}
            assert holds(own, true) == is_connected(link)
            outcomes.add(is_connected(link))
        seen.update(own)
    assert seen == set(clauses)
    assert outcomes == {True, False}


def satisfies_euler(letter: str, tetrahedra: Tetrahedra) -> bool:
    """Do b boundary triangles, i inner edges and b - 2 + 2i tetrahedra meet at every vertex?"""
    outer = {edge for face in boundary(letter) for edge in combinations(face, 2)}
    inner = {edge for t in tetrahedra for edge in combinations(t, 2)} - outer
    return all(
        sum(v in t for t in tetrahedra)
        == sum(v in face for face in boundary(letter)) - 2 + 2 * sum(v in edge for edge in inner)
        for v in VERTICES
    )


@every_boundary
def test_vertex_clauses_are_eulers_formula(letter: str, verdicts: Verdicts) -> None:
    """For triangulations with this and other boundaries, and these with a tetrahedron changed."""
    rng = np.random.default_rng(11)
    instances = sorted(instance for v in verdicts.values() for instance in v.instances)
    chosen = [instances[k] for k in rng.choice(len(instances), 400)]
    chosen += sorted(with_boundary(letter, verdicts))[:100]
    chosen += [
        tuple(set(instance) ^ {INNER[int(rng.integers(len(INNER)))]}) for instance in chosen[:100]
    ]
    found = set()
    with Solver("glucose4", bootstrap_with=vertex_clauses(boundary(letter))) as solver:
        for tetrahedra in chosen:
            expected = satisfies_euler(letter, tetrahedra)
            assert solver.solve(assumptions=choice(tetrahedra)) == expected
            found.add(expected)
    assert found == {True, False}


@pytest.mark.parametrize("size", range(7))
def test_counter_counts(size: int) -> None:
    """For all inputs: one value for each further variable, and the last ones are the count."""
    inputs = [3 + 2 * n for n in range(size)]
    for most in range(1, size + 2):
        clauses, at_least, fresh = _count(inputs, most, 100)
        defined = range(100, fresh)
        assert variables(clauses) <= {*inputs, *defined}
        assert len(at_least) == min(most, size)
        with Solver("minisat22", bootstrap_with=clauses) as solver:
            for signs in product((1, -1), repeat=size):
                true = [sign * k for sign, k in zip(signs, inputs, strict=True)]
                consistent, implied = solver.propagate(assumptions=true)
                assert consistent
                assert set(defined) <= set(map(abs, implied))
                for j, literal in enumerate(at_least, start=1):
                    assert (literal in implied) == (signs.count(1) >= j)


# The proofs.


@every_boundary
def test_completeness_is_accepted(
    letter: str, verdicts: Verdicts, completeness: list[Completeness]
) -> None:
    (found,) = (found for found in completeness if found.boundary == letter)
    assert found.fault is None
    assert found.listed == with_boundary(letter, verdicts)


@every_boundary
def test_no_instance_is_superfluous(letter: str, verdicts: Verdicts) -> None:
    """Without the clause of any one of them, the formula has a model: that one."""
    formula = completeness_formula(letter, instances_bounded_by(letter, verdicts.values()))
    common = len(triangulation_formula(BOUNDARY_TYPES[letter]))
    assert len(formula) == common + len(with_boundary(letter, verdicts))
    with Solver("glucose4", bootstrap_with=formula[:common]) as solver:
        for clause in formula[common:]:
            assert solver.solve(assumptions=[-literal for literal in clause])


def is_rejected(root: Path, letter: str, verdicts: Iterable[Verdict]) -> bool:
    """Is the proof rejected, with its name?"""
    found = check_completeness(root, letter, verdicts)
    assert found.boundary == letter
    assert (found.fault is None) == bool(found.listed)
    assert found.fault is None or found.fault.startswith(f"{completeness_file(letter)}: ")
    return found.fault is not None


@every_boundary
def test_a_verdict_left_out_is_noticed(shipped: Path, letter: str, verdicts: Verdicts) -> None:
    """Any verdict about a pattern with this boundary; all others do not matter."""
    own = {name for name, verdict in verdicts.items() if verdict.boundary == letter}
    for name in own:
        others = [v for other, v in verdicts.items() if other != name]
        assert is_rejected(shipped, letter, others)
    assert not is_rejected(shipped, letter, [verdicts[name] for name in own])


@every_boundary
def test_an_instance_left_out_is_noticed(shipped: Path, letter: str, verdicts: Verdicts) -> None:
    for instance in sorted(with_boundary(letter, verdicts))[::7]:
        fewer = [replace(v, instances=v.instances - {instance}) for v in verdicts.values()]
        assert is_rejected(shipped, letter, fewer)


@every_boundary
def test_the_proof_of_another_boundary_is_rejected(
    tmp_path: Path, shipped: Path, letter: str, verdicts: Verdicts
) -> None:
    (tmp_path / "proofs").mkdir()
    for other in BOUNDARY_TYPES.keys() - {letter}:
        content = (shipped / completeness_file(other)).read_bytes()
        (tmp_path / completeness_file(letter)).write_bytes(content)
        assert is_rejected(tmp_path, letter, verdicts.values())


@every_boundary
def test_a_proof_that_is_missing_or_cut_short_is_rejected(
    tmp_path: Path, shipped: Path, letter: str, verdicts: Verdicts
) -> None:
    copytree(shipped / "proofs", tmp_path / "proofs")
    path = tmp_path / completeness_file(letter)
    lines = path.read_text().splitlines(keepends=True)
    for rest in (lines[:-1], lines[1:], [], [*lines[:-1], "\u00e9"]):
        path.write_text("".join(rest))
        assert is_rejected(tmp_path, letter, verdicts.values())
    path.unlink()
    assert is_rejected(tmp_path, letter, verdicts.values())
