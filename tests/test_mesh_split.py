"""Meshes are split wherever trying all diagonals finds a split, and only there."""

from collections import Counter
from collections.abc import Callable
from itertools import combinations, product
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from certify.kernel.chirotope import chirotope
from certify.kernel.hexahedron import simplex
from certify.mesh.files import positive
from certify.mesh.instances import QUADRUPLE_INDEX
from certify.mesh.reading import BadMesh
from certify.mesh.realized import labelled
from certify.mesh.signs import signs
from certify.mesh.split import NotSplit, require_split, split
from certify.mesh.split.checking import _require_filled, _require_volume
from certify.mesh.split.kinds import (
    QUADRILATERALS,
    fillings,
    quadruples,
    realized_fillings,
    signs_of,
    surface,
)
from certify.mesh.split.solving import clauses
from tests.meshes import (
    NO,
    YES,
    exact,
    grid,
    realizes,
    schoenhardt,
    shuffled,
    trying_all,
    warped,
)

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
    all_signs = chirotope(exact(np.concatenate([points, more])))
    found = realized_fillings(kind, signs_of(points, kind, np.arange(width)[None]))[0]
    for own, yes in zip(fillings(kind), found, strict=True):
        oriented = {tuple(v + 1 for v in four): sign for four, sign in own.signs}
        assert realizes(oriented, all_signs) == yes


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


CUBE, CUBE_CELLS = grid(1, 1, 1)


@pytest.mark.parametrize("other", [CUBE + 0.5, CUBE / 2 + 0.25, 4 * CUBE - 1])
def test_cells_that_overlap_are_refused(other: Any) -> None:
    points = np.concatenate([CUBE, other])
    rows = np.concatenate([CUBE_CELLS["hexahedron"], CUBE_CELLS["hexahedron"] + 8])
    with pytest.raises(BadMesh, match="hexahedron 1 and hexahedron 2 overlap"):
        split(points, {"hexahedron": rows})


@pytest.mark.parametrize("shift", [[1, 0.5, 0.5], [1, 1, 0.5], [0.5, 1, 0.25]])
def test_cells_that_touch_are_split(shift: list[float]) -> None:
    points = np.concatenate([CUBE, CUBE + np.array(shift)])
    rows = np.concatenate([CUBE_CELLS["hexahedron"], CUBE_CELLS["hexahedron"] + 8])
    assert split(points, {"hexahedron": rows}).tetrahedra is not None


def test_vertices_at_the_same_point_are_refused() -> None:
    points = np.concatenate([CUBE, CUBE + np.array([0, 0, 1])])
    rows = np.concatenate([CUBE_CELLS["hexahedron"], CUBE_CELLS["hexahedron"] + 8])
    with pytest.raises(BadMesh, match="hexahedron 2 has point 9, which is the same as point 2"):
        split(points, {"hexahedron": rows})


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


@pytest.mark.parametrize("kind", ["hexahedron", "wedge", "pyramid"])
def test_another_volume_is_refused(kind: str) -> None:
    cube = grid(1, 1, 1)[0][[0, 4, 6, 2, 1, 5, 7, 3]]
    points = {"hexahedron": cube, "wedge": schoenhardt(0), "pyramid": cube[:5]}[kind]
    rows = np.arange(len(points))[None]
    own = split(points, {kind: rows}).tetrahedra
    assert own
    cuts = _require_filled(points, kind, rows, own.vertices, own.cells)
    _require_volume(points, rows, own.vertices, own.cells, kind, cuts)
    with pytest.raises(NotSplit, match=f"{kind} 1: its tetrahedra have another volume"):
        _require_volume(points, rows, own.vertices[1:], own.cells[1:], kind, cuts)


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
                realized_ = realizes(dict(own.signs), chirotope(exact(points)))
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
