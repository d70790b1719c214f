"""Graphs of a triangulation, by hand and against networkx and nauty."""

from collections.abc import Callable
from itertools import combinations

import networkx as nx
import pynauty
import pytest

from certify.graphs import (
    Network,
    Tetrahedra,
    around_interior_edges,
    ball,
    boundary,
    chordless_cycles,
    classes,
    coloured,
    colourless,
    cone,
    decomposition,
    dual,
    isomorphic,
)
from certify.kernel.check import Verdict
from certify.kernel.hexahedron import SYMMETRIES, image
from certify.kernel.triangulation import NotATriangulation, boundary_diagonals, triangles

FIVE: Tetrahedra = ((1, 2, 3, 6), (1, 3, 4, 8), (1, 3, 6, 8), (1, 5, 6, 8), (3, 6, 7, 8))
CORE = 2
"""The place in FIVE of the tetrahedron that shares its four triangles."""
SIX_AROUND_A_DIAGONAL: Tetrahedra = (
    (1, 2, 3, 7), (1, 2, 6, 7), (1, 3, 4, 7), (1, 4, 7, 8), (1, 5, 6, 7), (1, 5, 7, 8),
)  # fmt: skip
TEN: Tetrahedra = (
    (1, 2, 3, 5), (1, 2, 3, 8), (1, 2, 4, 8), (1, 3, 5, 6), (1, 3, 6, 7),
    (1, 3, 7, 8), (1, 5, 6, 7), (1, 5, 7, 8), (2, 3, 4, 8), (2, 3, 5, 6),
)  # fmt: skip
CYCLE: Tetrahedra = (
    (1, 2, 3, 8), (1, 3, 7, 8), (1, 5, 7, 8), (1, 5, 6, 7), (1, 3, 5, 6), (1, 2, 3, 5),
)  # fmt: skip
"""A simple chordless cycle of plain edges of TEN that goes around no interior edge."""

Kind = Callable[[Tetrahedra], Network]

KINDS: dict[Kind, int] = {coloured: 174, colourless: 159, dual: 165, ball: 168}
"""With the number of classes of the 174 patterns."""


@pytest.fixture(scope="session")
def balls(verdicts: dict[str, Verdict]) -> dict[str, Tetrahedra]:
    return {name: min(verdict.instances) for name, verdict in verdicts.items()}


def test_graph_of_the_cube_in_five() -> None:
    size, plain, dashed = decomposition(FIVE)
    corners = [k for k in range(5) if k != CORE]
    assert size == 5
    assert {frozenset(pair) for pair in plain} == {frozenset((CORE, k)) for k in corners}
    assert {frozenset(pair) for pair in dashed} == set(map(frozenset, combinations(corners, 2)))
    assert around_interior_edges(FIVE) == {}
    assert chordless_cycles(plain) == set()


def test_a_plain_and_a_dashed_edge_may_join_the_same_tetrahedra() -> None:
    _, plain, dashed = decomposition(SIX_AROUND_A_DIAGONAL)
    assert set(map(frozenset, plain)) == set(map(frozenset, dashed))
    assert set(coloured(SIX_AROUND_A_DIAGONAL).joined.values()) == {3}
    assert around_interior_edges(SIX_AROUND_A_DIAGONAL) == {(1, 7): frozenset(range(6))}
    assert chordless_cycles(plain) == {frozenset(range(6))}


def test_edges_stand_for_triangles_and_facets(balls: dict[str, Tetrahedra]) -> None:
    for tetrahedra in balls.values():
        size, plain, dashed = decomposition(tetrahedra)
        shared = [triangles(tetrahedra[a]) for a, _ in plain]
        assert len(set(plain)) == (4 * size - 12) // 2
        for (_, b), faces in zip(plain, shared, strict=True):
            assert len(set(faces) & set(triangles(tetrahedra[b]))) == 1
        for (a, b), diagonal in zip(dashed, sorted(boundary_diagonals(tetrahedra)), strict=True):
            assert a != b
            assert set(diagonal) <= set(tetrahedra[a]) & set(tetrahedra[b])


def test_no_graph_of_something_else() -> None:
    with pytest.raises(NotATriangulation):
        decomposition(FIVE[1:])


def test_a_cone_shares_the_boundary() -> None:
    assert len(boundary(FIVE)) == len(cone(FIVE, 9)) == 12
    assert boundary(cone(FIVE, 9)) == boundary(FIVE)
    assert boundary((*FIVE, *cone(FIVE, 9))) == []


def test_a_cycle_around_no_interior_edge() -> None:
    for (i, one), (j, other) in combinations(enumerate(CYCLE), 2):
        assert (len(set(one) & set(other)) == 3) == (j - i in (1, 5))
    assert set.intersection(*map(set, CYCLE)) == {1}
    places = frozenset(map(TEN.index, CYCLE))
    assert places in chordless_cycles(decomposition(TEN).plain)
    assert places not in around_interior_edges(TEN).values()


def test_chordless_cycles_are_those_of_networkx(balls: dict[str, Tetrahedra]) -> None:
    for tetrahedra in balls.values():
        plain = decomposition(tetrahedra).plain
        cycles = set(map(frozenset, nx.chordless_cycles(nx.Graph(plain))))
        assert chordless_cycles(plain) == cycles
        around = around_interior_edges(tetrahedra)
        assert len(cycles.intersection(around.values())) == len(around)


def test_chordless_cycles_of_small_graphs() -> None:
    assert chordless_cycles([(0, 1), (1, 2), (2, 3), (0, 3)]) == {frozenset(range(4))}
    assert len(chordless_cycles(combinations(range(4), 2))) == 4
    assert chordless_cycles([(0, 1), (1, 2)]) == set()


def nauty_key(network: Network) -> object:
    """Return what isomorphic networks have in common: a joined pair is a node between the two."""
    size = len(network.nodes)
    pairs = sorted((kind, pair) for pair, kind in network.joined.items() if pair[0] < pair[1])
    kinds = [("node", kind) for kind in network.nodes] + [("pair", kind) for kind, _ in pairs]
    colours = sorted(set(kinds))
    parts = [{k for k, kind in enumerate(kinds) if kind == colour} for colour in colours]
    graph = pynauty.Graph(
        size + len(pairs),
        adjacency_dict={size + k: list(pair) for k, (_, pair) in enumerate(pairs)},
        vertex_coloring=parts,
    )
    return tuple(zip(colours, map(len, parts), strict=True)), pynauty.certificate(graph)


@pytest.mark.parametrize("kind", KINDS)
def test_classes_are_those_of_nauty(kind: Kind, balls: dict[str, Tetrahedra]) -> None:
    groups: dict[object, set[str]] = {}
    for name, tetrahedra in balls.items():
        groups.setdefault(nauty_key(kind(tetrahedra)), set()).add(name)
    ours = classes(balls, kind)
    assert set(map(frozenset, ours)) == set(map(frozenset, groups.values()))
    assert len(ours) == KINDS[kind]


def test_what_one_ball_admits(verdicts: dict[str, Verdict], balls: dict[str, Tetrahedra]) -> None:
    several = [names for names in classes(balls, ball) if len(names) > 1]
    assert sorted(map(len, several)) == [2, 2, 2, 2, 3]
    for names in several:  # realizations know nothing of facets, valid hexahedra do
        for question in ("realizable", "convex"):
            assert len({verdicts[name].answers[question] for name in names}) == 1
    assert {"15_A", "15_B", "15_J"} in several


@pytest.mark.parametrize("kind", KINDS)
def test_symmetries_change_nothing(kind: Kind) -> None:
    networks = [
        kind(tuple(sorted(image(symmetry, tetrahedron) for tetrahedron in TEN)))
        for symmetry in SYMMETRIES
    ]
    assert all(isomorphic(networks[0], other) for other in networks)
