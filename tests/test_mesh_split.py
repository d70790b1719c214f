"""Meshes are split wherever trying all diagonals finds a split, and only there."""

from collections import Counter
from collections.abc import Callable
from fractions import Fraction
from itertools import combinations, product
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from certify.kernel.chirotope import chirotope
from certify.kernel.embedding import NotRealized, require_realization
from certify.kernel.hexahedron import BOUNDARIES, FACETS, simplex
from certify.kernel.refutation import replay
from certify.mesh.files import positive
from certify.mesh.instances import QUADRUPLE_INDEX
from certify.mesh.reading import BadMesh
from certify.mesh.realized import fillable_at_all, labelled
from certify.mesh.signs import signs
from certify.mesh.split import Answer, NotSplit, require_split, split
from certify.mesh.split.choices import choices_of
from certify.mesh.split.faces import faces_of
from certify.mesh.split.kinds import (
    QUADRILATERALS,
    fillings,
    quadruples,
    realized_fillings,
    signs_of,
    surface,
)
from certify.mesh.split.solving import clauses, numbers_of
from certify.mesh.split.tetrahedra import by_numbers, by_template
from certify.search.refutations import lrat, refute
from tests.meshes import grid, mixed, schoenhardt, shuffled, warped

LAID = (536, 8, 6, 2, 1, 1)
"""A mesh that cannot be split without boundary tetrahedra."""

RING = (3870, 10, 5, 3, 3, 1)
"""A mesh in which four cells contradict each other, and no three."""

NO = [(157, 10, 7, 2, 1, 1), (9, 10, 6, 2, 2, 2), (43, 10, 6, 2, 2, 2), RING]
YES = [(1, 10, 0, 2, 2, 2), (1, 10, 3, 3, 3, 3), (2, 10, 4, 3, 3, 3), (4, 10, 5, 4, 4, 4), LAID]

unhurried = settings(deadline=None)

# The kinds of cells.


def chain(signed: Any) -> dict[tuple[int, ...], int]:
    """Return the boundary of signed tetrahedra: triangle -> how often."""
    found: Counter[tuple[int, ...]] = Counter()
    for four, sign in signed:
        for i in range(4):
            found[four[:i] + four[i + 1 :]] += sign * (-1) ** (3 - i)
    return {triangle: times for triangle, times in found.items() if times}


def surface_chain(kind: str, choice: int) -> dict[tuple[int, ...], int]:
    swaps = [sum(a > b for a, b in combinations(t, 2)) for t in surface(kind, choice)]
    return {simplex(t): (-1) ** s for t, s in zip(surface(kind, choice), swaps, strict=True)}


@pytest.mark.parametrize("kind", ["wedge", "pyramid"])
def test_fillings_are_all_oriented_sets_of_tetrahedra_with_this_boundary(kind: str) -> None:
    fours = quadruples(kind)
    boundaries = [surface_chain(kind, n) for n in range(2 ** len(QUADRILATERALS[kind]))]
    expected = set()
    for bits in range(1, 2 ** len(fours)):
        chosen = [four for i, four in enumerate(fours) if bits >> i & 1]
        times = Counter(three for four in chosen for three in combinations(four, 3))
        once = {three for three in times if times[three] == 1}
        if max(times.values()) > 2 or once not in [set(own) for own in boundaries]:
            continue
        for signs_ in product((1, -1), repeat=len(chosen)):
            signed = tuple(zip(chosen, signs_, strict=True))
            if chain(signed) in boundaries:
                expected.add((boundaries.index(chain(signed)), signed))
    assert {(own.choice, own.signs) for own in fillings(kind)} == expected


@pytest.mark.parametrize("kind", ["wedge", "pyramid"])
@unhurried
@given(seed=st.integers(0, 10**6), most=st.integers(2, 4))
def test_fillings_are_realized_where_the_kernel_says_so(kind: str, seed: int, most: int) -> None:
    width = 6 if kind == "wedge" else 5
    points = np.random.default_rng(seed).integers(-most, most + 1, (width, 3))
    more = np.random.default_rng(seed).integers(-9, 10, (8 - width, 3))  # in no tetrahedron
    all_signs = chirotope([tuple(map(int, p)) for p in (*points, *more)])  # type: ignore[misc]
    found = realized_fillings(kind, signs_of(points, kind, np.arange(width)[None]))[0]
    for own, yes in zip(fillings(kind), found, strict=True):
        oriented = {tuple(v + 1 for v in four): sign for four, sign in own.signs}
        assert _realizes(oriented, all_signs) == yes


def _realizes(oriented: Any, all_signs: Any) -> bool:
    try:
        require_realization(oriented, all_signs)
    except NotRealized:
        return False
    return True


def fillable_choices(points: Any, kind: str) -> set[int]:
    found = realized_fillings(kind, signs_of(points, kind, np.arange(len(points))[None]))[0]
    return {own.choice for own, yes in zip(fillings(kind), found, strict=True) if yes}


def test_a_prism_is_cut_in_six_ways_and_a_pyramid_in_two() -> None:
    prism = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1], [1, 0, 1], [0, 1, 1]])
    assert fillable_choices(prism, "wedge") == {1, 2, 3, 4, 5, 6}
    pyramid = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [0, 0, 1]])
    assert fillable_choices(pyramid, "pyramid") == {0, 1}


def test_schoenhardts_polyhedron_cannot_be_filled() -> None:
    dented = {turn: fillable_choices(schoenhardt(turn), "wedge") & {0, 7} for turn in (30, -30)}
    assert sorted(map(len, dented.values())) == [1, 1]  # the other one, which bulges, is filled
    assert dented[30] != dented[-30]


# The cells fit together.

POINTS, CELLS = grid(2, 1, 1)
FIRST, SECOND = CELLS["hexahedron"].tolist()
COMMON = [SECOND[i] for i in (0, 3, 7, 4)]
MIRROR = [4, 5, 6, 7, 0, 1, 2, 3]
BAD = {
    "hexahedron 1 has a vertex twice": [[*FIRST[:7], FIRST[0]], SECOND],
    "hexahedron 2 and hexahedron 3 have the same vertices": [FIRST, SECOND, SECOND],
    "in three cells: hexahedron 1, hexahedron 2, hexahedron 3": [
        FIRST,
        SECOND,
        [*COMMON, 12, 13, 14, 15],
    ],
    "hexahedron 1 and hexahedron 2 are on the same side of face": [
        SECOND,
        [*COMMON, 12, 13, 14, 15],
    ],
    "hexahedron 1 and hexahedron 2 have": [FIRST, [*COMMON[:2], *COMMON[:1:-1], 12, 13, 14, 15]],
    "another face of hexahedron 2 have the vertices": [FIRST, [*COMMON[:3], 12, 13, 14, 15, 16]],
    "hexahedron 1 is inside out: its vertices are in the order of its mirror image": [
        [FIRST[i] for i in MIRROR]
    ],
}


@pytest.mark.parametrize("fault", BAD)
def test_bad_meshes_are_refused(fault: str) -> None:
    points = np.concatenate([POINTS, 5 + np.random.default_rng(1).random((8, 3))])
    with pytest.raises(BadMesh) as raised:
        split(points, {"hexahedron": np.array(BAD[fault])})
    assert fault in str(raised.value)


def test_a_tetrahedron_on_half_a_quadrilateral_is_refused() -> None:
    points = np.concatenate([POINTS, [[3.0, 0, 0]]])
    cells = {"hexahedron": np.array([SECOND]), "tetra": np.array([[*SECOND[1:3], SECOND[5], 12]])}
    with pytest.raises(BadMesh, match="a face of hexahedron 1 and another face of tetra 1 have"):
        split(points, cells)


def test_tetrahedra_must_be_positive() -> None:
    points = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1], [1, 1, 0]])
    with pytest.raises(BadMesh, match="tetra 2 is inside out"):
        split(points, {"tetra": np.array([[0, 1, 2, 3], [1, 2, 4, 3]])})
    with pytest.raises(BadMesh, match="tetra 1 is flat"):
        split(points, {"tetra": np.array([[0, 1, 2, 4]])})


# Clauses.


@settings(deadline=None, max_examples=200)
@given(word=st.integers(0, 2**64 - 1), dense=st.booleans())
def test_clauses_say_what_is_allowed_and_none_of_it_is_idle(word: int, dense: bool) -> None:
    word = word | word << 1 & 2**64 - 1 if dense else word
    slots = np.arange(6)[None]
    rows = [
        clause
        for _, found in clauses(slots, np.array([word], np.uint64))
        for clause in found.tolist()
    ]

    def allowed(own: list[list[int]]) -> int:
        return sum(
            1 << n
            for n in range(64)
            if all(any((x > 0) != (n >> abs(x) - 1 & 1) for x in clause) for clause in own)
        )

    assert allowed(rows) == word
    for i, clause in enumerate(rows):
        others = rows[:i] + rows[i + 1 :]
        assert allowed(others) != word
        for x in clause:
            assert allowed([*others, [y for y in clause if y != x]]) != word


# Everything that can be tried is tried.


def trying_all(points: Any, cells: Any) -> bool:
    """Is there a split, by trying all diagonals of all quadrilaterals that are not outside?"""
    rows = cells["hexahedron"]
    quads = Counter(frozenset(row[v - 1] for v in f) for row in rows.tolist() for f in FACETS)
    ways = []
    for row, filled in zip(rows.tolist(), fillable_at_all(signs(points[rows])), strict=True):
        own = set()
        for diagonals in (b for b, yes in zip(BOUNDARIES, filled, strict=True) if yes):
            cut = [frozenset(row[v - 1] for v in diagonal) for diagonal in diagonals]
            faces = {quad: d for quad in quads for d in cut if d < quad <= set(row)}
            own.add(frozenset((q, d) for q, d in faces.items() if quads[q] == 2))
        ways.append([dict(cut) for cut in own])
    return _extends({}, ways)


def _extends(chosen: dict[Any, Any], ways: list[list[dict[Any, Any]]]) -> bool:
    return not ways or any(
        _extends({**chosen, **cut}, ways[1:])
        for cut in ways[0]
        if all(chosen.get(quad, diagonal) == diagonal for quad, diagonal in cut.items())
    )


@pytest.mark.parametrize("mesh", [*YES, *NO])
def test_yes_and_no_are_those_of_trying_all_diagonals(mesh: Any) -> None:
    points, cells = warped(*mesh)
    answer = split(points, cells)
    assert (answer.tetrahedra is not None) == (mesh in YES)
    if len(cells["hexahedron"]) < 10:
        assert trying_all(points, cells) == (mesh in YES)


@unhurried
@given(seed=st.integers(0, 10**6), size=st.sampled_from([(1, 1, 1), (2, 1, 1), (2, 2, 1)]))
def test_random_meshes_are_split_iff_some_diagonals_do(seed: int, size: Any) -> None:
    points, cells = shuffled(seed, *warped(seed, 10, 7, *size))
    try:
        answer = split(points, cells)
    except BadMesh:
        return
    assert (answer.tetrahedra is not None) == trying_all(points, cells)
    if answer.tetrahedra:
        require_split(points, cells, answer.tetrahedra.vertices, answer.tetrahedra.cells)


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


def test_a_ring_of_four_contradicts_itself() -> None:
    (found,) = split(*warped(*RING)).contradictions
    assert len(found.cells) == 4


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
    turned = answer.faces.cells
    require_split(points, turned, answer.tetrahedra.vertices, answer.tetrahedra.cells)
    assert answer.faces.name(answer.faces.number - 1) == "tetra 1"
    counts = np.bincount(answer.tetrahedra.cells)
    assert counts[-1] == 1
    assert counts[answer.faces.start("pyramid")] >= 2


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


# What is no split is refused.


def spoiled(change: Callable[[Any, Any, Any], Any]) -> str:
    points, cells = warped(1, 10, 3, 2, 2, 2)
    own = split(points, cells).tetrahedra
    assert own
    vertices, owners = change(own.vertices.copy(), own.cells.copy(), cells)
    with pytest.raises(NotSplit) as raised:
        require_split(points, cells, vertices, owners)
    return str(raised.value)


def test_spoiled_splits_are_refused() -> None:
    swapped = [0, 1, 3, 2]
    assert "tetrahedron 1 is inverted" in spoiled(lambda t, o, _: (t[:, swapped], o))
    assert "not every cell has tetrahedra" in spoiled(lambda t, o, _: (t[o > 0], o[o > 0]))
    more = spoiled(lambda t, o, _: (np.concatenate([t, t[:1]]), np.concatenate([o, [9]])))
    assert "a tetrahedron belongs to no cell" in more
    assert "do not have its faces" in spoiled(lambda t, o, _: (t[1:], o[1:]))
    assert "with another vertex" in spoiled(lambda t, o, _: (t, np.roll(o, 1)))
    doubled = spoiled(lambda t, o, _: (np.concatenate([t, t]), np.concatenate([o, o])))
    assert "do not have its faces" in doubled


def test_a_split_of_each_cell_alone_is_refused_as_not_conforming() -> None:
    points, cells = warped(1, 10, 3, 2, 2, 2)
    parts = [split(points, {"hexahedron": row[None]}).tetrahedra for row in cells["hexahedron"]]
    vertices = np.concatenate([part.vertices for part in parts if part])
    owners = np.concatenate([part.cells + i for i, part in enumerate(parts) if part])
    with pytest.raises(NotSplit, match="does not have a tetrahedron on each side"):
        require_split(points, cells, vertices, owners)


def test_overlapping_tetrahedra_are_refused() -> None:
    """Positive ones with a surface that crosses itself: triangulations that are no realization."""
    refused = 0
    for seed in range(400):
        points = np.random.default_rng(seed).integers(-3, 4, (8, 3)).astype(float)
        found = signs(points[None])[0]
        for own in labelled()[::37]:
            places = [(QUADRUPLE_INDEX[four], sign) for four, sign in own.signs]
            if all(found[place] == sign for place, sign in places):
                rows = [positive(tuple(v - 1 for v in four), sign) for four, sign in own.signs]
                realized_ = _realizes(dict(own.signs), chirotope(_exact(points)))
                try:
                    require_split(
                        points,
                        {"hexahedron": np.arange(8)[None]},
                        np.array(rows),
                        np.zeros(len(rows), np.int64),
                    )
                except NotSplit:
                    assert not realized_
                    refused += 1
                else:
                    assert realized_
    assert refused


def _exact(points: Any) -> Any:
    return [tuple(map(Fraction, point)) for point in points.tolist()]
