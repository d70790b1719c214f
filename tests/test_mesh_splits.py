"""What is found of meshes: splits, contradictions, cells that cannot be filled."""

from collections import Counter
from fractions import Fraction
from itertools import combinations
from typing import Any

import numpy as np
import pytest
from pysat.examples.optux import OptUx
from pysat.formula import WCNF

from certify.kernel.hexahedron import BOUNDARIES, FACETS
from certify.kernel.refutation import replay
from certify.mesh.instances import QUADRUPLE_INDEX
from certify.mesh.reading import BadMesh
from certify.mesh.realized import embedded, fillable_at_all, labelled, realized
from certify.mesh.shapes import least_dihedral_angles
from certify.mesh.signs import signs
from certify.mesh.split import Answer, NotSplit, contradictions, require_split, split
from certify.mesh.split.choices import _qualities, choices_of
from certify.mesh.split.faces import faces_of
from certify.mesh.split.solving import formula, numbers_of
from certify.mesh.split.tetrahedra import by_numbers, by_template
from certify.search.refutations import lrat, refute
from tests.meshes import (
    LAID,
    NO,
    RING,
    YES,
    grid,
    mixed,
    schoenhardt,
    shuffled,
    trying_all,
    warped,
)

POINTS, CELLS = grid(2, 1, 1)

# Good meshes.


def by_definition(points: Any, cells: Any, answer: Answer) -> None:
    assert answer.tetrahedra
    require_split(points, cells, answer.tetrahedra.vertices, answer.tetrahedra.cells)


def test_a_structured_grid_is_split_by_anything() -> None:
    answer = split(*grid(3, 4, 5))
    by_definition(*grid(3, 4, 5), answer)
    assert answer.shape
    assert answer.by_numbers.not_positive == answer.beyond_numbers == 0
    assert answer.by_template.disagreements == 0
    assert answer.shape.angles.min() == pytest.approx(45)
    require_split(*grid(3, 4, 5), *by_numbers(answer.faces))


def test_numbers_of_vertices_decide_what_one_template_does() -> None:
    points, cells = shuffled(1, *grid(3, 3, 3))
    answer = split(points, cells)
    by_definition(points, cells, answer)
    assert answer.by_template.disagreements > 0
    assert answer.by_numbers.disagreements == 0
    require_split(points, cells, *by_numbers(answer.faces))
    with pytest.raises(NotSplit, match="does not have a tetrahedron on each side"):
        require_split(points, cells, *by_template(answer.faces)[:2])


def test_warped_grids_are_split_where_recipes_fail() -> None:
    points, cells = warped(1, 10, 5, 4, 4, 4)
    answer = split(points, cells)
    by_definition(points, cells, answer)
    assert answer.shape
    assert answer.shape.not_positive == 0
    assert min(answer.by_numbers.not_positive, answer.by_template.not_positive) > 0
    assert answer.beyond_numbers > 0
    assert sum(answer.patterns.values()) == 64


@pytest.mark.parametrize("depth", [0.3, 0.45, 0.55, 0.8])
def test_a_corner_is_pushed_into_its_cell(depth: float) -> None:
    """Beyond 1/3 it is inverted; beyond 1/2 so are the two tetrahedra that the recipe has there."""
    points, cells = grid(2, 2, 2)
    points[8] += depth * np.array([1, -1, -1])
    answer = split(points, cells)
    by_definition(points, cells, answer)
    assert answer.by_numbers.not_positive == (2 if depth > 1 / 2 else 0)


def test_boundary_tetrahedra_are_laid_where_nothing_else_helps() -> None:
    answer = split(*warped(*LAID))
    by_definition(*warped(*LAID), answer)
    assert answer.laid > 0
    assert answer.tetrahedra
    own = answer.tetrahedra.patterns == 0
    quads = {frozenset(quad) for quad in answer.faces.quadrilaterals.tolist()}
    assert all(frozenset(t) in quads for t in answer.tetrahedra.vertices[own].tolist())


def test_fractions_and_huge_numbers_are_taken_exactly() -> None:
    points, cells = warped(*LAID)
    thirds = np.array([[Fraction(int(x), 3) for x in point] for point in points], object)
    for scaled in (thirds, points * 1e200, points * 1e-290):
        answer = split(scaled, cells)
        by_definition(scaled, cells, answer)


def test_the_same_mesh_is_split_in_the_same_way() -> None:
    first, second = split(*warped(*YES[2])), split(*warped(*YES[2]))
    assert first.tetrahedra
    assert second.tetrahedra
    assert np.array_equal(first.tetrahedra.vertices, second.tetrahedra.vertices)


# Quality.


def test_angles_are_those_of_certify_mesh_shapes() -> None:
    points = np.random.default_rng(1).random((50, 8, 3))
    fours = points[:, np.array([*combinations(range(8), 4)])].reshape(-1, 4, 3)
    angles = least_dihedral_angles(fours).reshape(50, 70)
    assert np.allclose(_qualities("hexahedron", points), angles)


@pytest.mark.parametrize("seed", range(20))
def test_the_best_filling_is_the_best_of_all(seed: int) -> None:
    points, cells = warped(seed, 10, 6, 1, 1, 1)
    own = points[cells["hexahedron"]]
    chirotopes, faces = signs(own), faces_of(cells)
    angles = _qualities("hexahedron", own)[0]
    inside: dict[int, float] = {}
    for instance, yes in zip(labelled(), realized(chirotopes)[0], strict=True):
        if yes:
            least = min(angles[QUADRUPLE_INDEX[four]] for four in instance.tetrahedra)
            inside[instance.boundary] = max(inside.get(instance.boundary, 0), least)
    arrays = choices_of(points, faces).arrays
    for outer, yes in enumerate(embedded(chirotopes)[0]):
        options = []
        for inner, least in inside.items():
            laid = [f for f in range(6) if (outer ^ inner) >> (5 - f) & 1]
            fours = [tuple(sorted(FACETS[f])) for f in laid]
            swaps = [sum(a > b for a, b in combinations(FACETS[f], 2)) for f in laid]
            up = [chirotopes[0, QUADRUPLE_INDEX[four]] for four in fours]
            fine = [
                sign * (-1) ** swap == (-1) ** (outer >> (5 - f) & 1)
                for f, sign, swap in zip(laid, up, swaps, strict=True)
            ]
            if yes and all(fine):
                options.append(min([least, *(angles[QUADRUPLE_INDEX[four]] for four in fours)]))
        place = 0, outer ^ int(faces.turns[0])
        assert (arrays.best[place] >= 0) == bool(options)
        assert arrays.quality[place] == pytest.approx(max(options, default=0), rel=1e-6)


@pytest.mark.parametrize("seed", range(8))
def test_best_is_the_largest_least_angle_of_all_diagonals(seed: int) -> None:
    points, cells = warped(seed, 10, 4, 2, 1, 1)
    faces = faces_of(cells)
    choices = choices_of(points, faces)
    free = len(faces.quadrilaterals)
    most = 0.0
    for bits in range(2**free):
        cut = np.array([bits >> quad & 1 for quad in range(free)], np.bool_)
        numbers = numbers_of(faces.slots, cut)
        if all(int(word) >> int(n) & 1 for word, n in zip(choices.allowed, numbers, strict=True)):
            most = max(most, float(choices.arrays.quality[[0, 1], numbers].min()))
    least = {}
    for quality in ("best", "greedy", "none"):
        found = split(points, cells, quality).shape
        assert found
        least[quality] = found.angles.min()
    assert least["best"] == pytest.approx(most, rel=1e-5)
    assert least["best"] >= max(least["greedy"], least["none"]) - 1e-4


def test_best_is_no_worse_in_a_larger_mesh() -> None:
    points, cells = warped(3, 20, 7, 6, 6, 6)
    shapes = {
        quality: split(points, cells, quality).shape for quality in ("best", "greedy", "none")
    }
    best, greedy, none = (own.angles.min() if own else 0 for own in shapes.values())
    assert best >= greedy > none


def test_an_unknown_quality_is_refused() -> None:
    with pytest.raises(ValueError, match="unknown quality 'good'"):
        split(POINTS, CELLS, "good")


# Contradictions.


@pytest.mark.parametrize("mesh", NO)
def test_contradicting_cells_are_minimal_and_their_clauses_true(mesh: Any) -> None:
    points, cells = warped(*mesh)
    rows = cells["hexahedron"]
    answer = split(points, cells)
    assert answer.unfillable == ()
    found = answer.contradictions[0]
    own = [*found.cells]
    assert not trying_all(points, {"hexahedron": rows[own]})
    for cell in own:
        rest = [other for other in own if other != cell]
        assert trying_all(points, {"hexahedron": rows[rest]})
    assert found.smallest
    for fewer in combinations(range(len(rows)), len(own) - 1):
        assert trying_all(points, {"hexahedron": rows[[*fewer]]})
    replay(found.formula, lrat(refute(found.formula) or []))
    filled = fillable_at_all(signs(points[rows]))
    for cell, clause in zip(found.owners, found.formula, strict=True):
        for diagonals, yes in zip(BOUNDARIES, filled[cell], strict=True):
            cut = [frozenset(rows[cell][v - 1] for v in diagonal) for diagonal in diagonals]
            true = [_is_true(answer, found.quadrilaterals, literal, cut) for literal in clause]
            assert any(true) or not yes


def _is_true(answer: Answer, quads: Any, literal: int, cut: Any) -> bool:
    least, _, opposite, _ = answer.faces.quadrilaterals[quads[abs(literal) - 1]].tolist()
    return (frozenset((least, opposite)) in cut) == (literal > 0)


@pytest.mark.parametrize("mesh", NO)
def test_no_smaller_set_is_found_by_optux(mesh: Any) -> None:
    answer = split(*warped(*mesh))
    slots = answer.faces.slots
    first = len(answer.faces.quadrilaterals) + 1
    formula_ = WCNF()
    for cell, clause in formula(slots, answer.choices.allowed):
        formula_.append([*clause, -first - cell])
    for cell in range(len(slots)):
        formula_.append([first + cell], weight=1)
    with OptUx(formula_) as optux:
        assert len(optux.compute()) == len(answer.contradictions[0].cells)


@pytest.mark.parametrize("meshes", [(RING, NO[1]), (NO[1], RING)])
def test_the_smallest_set_comes_first_wherever_the_solver_starts(meshes: Any) -> None:
    parts = [warped(*mesh) for mesh in meshes]
    points = np.concatenate([parts[0][0], parts[1][0] + 1000])
    shifted = parts[1][1]["hexahedron"] + len(parts[0][0])
    cells = {"hexahedron": np.concatenate([parts[0][1]["hexahedron"], shifted])}
    found = split(points, cells).contradictions
    assert [(len(own.cells), own.smallest) for own in found] == [(3, True), (4, False)]


def test_a_ring_of_four_contradicts_itself() -> None:
    (found,) = split(*warped(*RING)).contradictions
    assert len(found.cells) == 4


def test_nothing_is_called_smallest_that_is_not_known_to_be(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr(contradictions, "LARGE", 0)
    (found,) = split(*warped(*RING)).contradictions
    assert not found.smallest
    monkeypatch.setattr(contradictions, "LARGE", 10**6)
    monkeypatch.setattr(contradictions, "ROUNDS", 1)
    (found,) = split(*warped(*RING)).contradictions
    assert not found.smallest


def test_two_contradictions_have_no_common_cell() -> None:
    points, cells = warped(*NO[0])
    twice = np.concatenate([points, points + 1000])
    rows = np.concatenate([cells["hexahedron"], cells["hexahedron"] + len(points)])
    found = split(twice, {"hexahedron": rows}).contradictions
    assert [own.cells for own in found] == [(0, 1), (2, 3)] or [own.cells for own in found] == [
        (2, 3),
        (0, 1),
    ]


def test_cells_that_cannot_be_filled_are_named_and_the_rest_is_asked() -> None:
    points, cells = warped(*NO[0])
    crossed = grid(1, 1, 1)[0] + 1000
    crossed[[0, 1]] = crossed[[1, 0]]
    rows = np.concatenate([np.arange(12, 20)[None], cells["hexahedron"]])
    rows[0] = 12 + grid(1, 1, 1)[1]["hexahedron"][0]
    answer = split(np.concatenate([points, crossed]), {"hexahedron": rows})
    assert answer.tetrahedra is None
    assert answer.unfillable == (0,)
    assert [own.cells for own in answer.contradictions] == [(1, 2)]
    why = answer.why(0)
    assert why.boundaries == 64
    assert why.corners


# Other kinds of cells.


@pytest.mark.parametrize("seed", range(6))
def test_mixed_meshes_are_split(seed: int) -> None:
    points, cells = mixed(*warped(seed, 10, 2, 3, 3, 1), wedges=(0, 3, 8), pyramids=(4, 5))
    assert set(cells) == {"hexahedron", "wedge", "pyramid", "tetra"}
    answer = split(points, cells)
    assert answer.tetrahedra
    by_definition(points, cells, answer)
    assert answer.faces.name(answer.faces.number - 1) == "tetra 1"
    counts = np.bincount(answer.tetrahedra.cells)
    assert counts[-1] == 1
    assert counts[answer.faces.start("pyramid")] >= 2


@pytest.mark.parametrize("quality", ["greedy", "best", "none"])
def test_tetrahedra_alone_stay_what_they_are(quality: str) -> None:
    points = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1], [1, 1, 1]])
    cells = {"tetra": np.array([[0, 1, 2, 3], [1, 2, 3, 4]])}
    answer = split(points, cells, quality)
    by_definition(points, cells, answer)
    assert answer.tetrahedra
    assert answer.tetrahedra.vertices.tolist() == cells["tetra"].tolist()
    assert answer.by_template.disagreements == 0


def test_wedges_that_no_diagonals_fill_are_named() -> None:
    points = schoenhardt(175)
    answer = split(points, {"wedge": np.arange(6)[None]})
    assert answer.unfillable == (0,)
    assert answer.faces.name(0) == "wedge 1"
    assert answer.why(0).crossing is None


def test_a_wedge_between_two_others_may_contradict_them() -> None:
    """Three twisted wedges around an edge: found by the solver, as trying all their cuts does."""
    found = Counter[bool]()
    for seed in range(150):
        points, cells = mixed(*warped(seed, 4, 2, 2, 1, 1), wedges=(0, 1), pyramids=())
        try:
            answer = split(points, cells)
        except BadMesh:
            continue
        masks = [int(word) for word in answer.choices.allowed]
        quads = len(answer.faces.quadrilaterals)
        yes = any(
            all(
                mask >> int(n) & 1
                for mask, n in zip(masks, _numbers(answer, bits, quads), strict=True)
            )
            for bits in range(2**quads)
        )
        assert yes == (answer.tetrahedra is not None)
        found[yes] += 1
    assert min(found[True], found[False]) > 5


def _numbers(answer: Answer, bits: int, quads: int) -> Any:
    cut = np.array([bits >> quad & 1 for quad in range(quads)], np.bool_)
    return numbers_of(answer.faces.slots, cut)
