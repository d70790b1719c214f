"""Decomposition graphs, and the 174 classes a second time: from the spheres with nine vertices."""

import json
from collections import Counter
from itertools import combinations
from pathlib import Path

import networkx as nx
import pytest
from networkx.algorithms.isomorphism import categorical_multiedge_match

from certify.kernel.triangulation import NotATriangulation, orbit
from certify.search.decomposition import (
    DASHED,
    PLAIN,
    SENTENCES,
    SecondDerivation,
    adjacency_key,
    automorphisms,
    canonical_key,
    chordless_cycles,
    decomposition_graph,
    interior_edges,
    second_derivation,
)
from certify.search.spheres import Complex

CERTIFICATES = Path(__file__).parent.parent / "certificates"
TABLE = {5: 1, 6: 5, 7: 5, 8: 7, 9: 13, 10: 20, 11: 35, 12: 30, 13: 28, 14: 19, 15: 11}
"""Number of tetrahedra -> number of classes: the paper's Table 1."""

CORE = (1, 3, 6, 8)
FIVE: Complex = ((1, 2, 3, 6), (1, 3, 4, 8), CORE, (1, 5, 6, 8), (3, 6, 7, 8))
SIX_AROUND_A_DIAGONAL: Complex = (
    (1, 2, 3, 7), (1, 2, 6, 7), (1, 3, 4, 7), (1, 4, 7, 8), (1, 5, 6, 7), (1, 5, 7, 8),
)  # fmt: skip
TEN: Complex = (
    (1, 2, 3, 5), (1, 2, 3, 8), (1, 2, 4, 8), (1, 3, 5, 6), (1, 3, 6, 7),
    (1, 3, 7, 8), (1, 5, 6, 7), (1, 5, 7, 8), (2, 3, 4, 8), (2, 3, 5, 6),
)  # fmt: skip
CYCLE: Complex = (
    (1, 2, 3, 8), (1, 3, 7, 8), (1, 5, 7, 8), (1, 5, 6, 7), (1, 3, 5, 6), (1, 2, 3, 5),
)  # fmt: skip
"""A simple chordless cycle of plain edges of TEN that goes around no interior edge."""


@pytest.fixture(scope="module")
def derivation() -> SecondDerivation:
    return second_derivation(lambda _: None)


def test_graph_of_the_cube_in_five() -> None:
    graph = decomposition_graph(FIVE)
    corners = [tetrahedron for tetrahedron in FIVE if tetrahedron != CORE]
    edges = Counter(
        (frozenset((one, other)), kind) for one, other, kind in graph.edges(data="kind")
    )
    assert edges == Counter(
        [(frozenset((CORE, corner)), PLAIN) for corner in corners]
        + [(frozenset(pair), DASHED) for pair in combinations(corners, 2)]
    )
    assert automorphisms(graph) == 24
    assert interior_edges(FIVE) == set()
    assert chordless_cycles(FIVE) == []


def test_edges_stand_for_triangles_and_diagonals() -> None:
    keys = {key for *_, key in decomposition_graph(FIVE).edges(keys=True)}
    assert {key for key in keys if len(key) == 3} == set(combinations(CORE, 3))
    assert {key for key in keys if len(key) == 2} == set(combinations(CORE, 2))


def test_cycle_around_an_interior_edge() -> None:
    graph = decomposition_graph(SIX_AROUND_A_DIAGONAL)
    assert interior_edges(SIX_AROUND_A_DIAGONAL) == {(1, 7)}
    assert [set(cycle) for cycle in chordless_cycles(SIX_AROUND_A_DIAGONAL)] == [
        set(SIX_AROUND_A_DIAGONAL)
    ]
    both = Counter(frozenset(ends) for *ends, _ in graph.edges(keys=True))
    assert set(both.values()) == {2}


def test_no_graph_of_something_else() -> None:
    with pytest.raises(NotATriangulation):
        decomposition_graph(FIVE[1:])


def test_cycle_that_no_interior_edge_explains() -> None:
    shared = {
        frozenset((i, j)): len(set(one) & set(other))
        for (i, one), (j, other) in combinations(enumerate(CYCLE), 2)
    }
    for pair, common in shared.items():
        i, j = sorted(pair)
        assert (common == 3) == (j - i in (1, 5))
    assert set.intersection(*map(set, CYCLE)) == {1}
    assert set(CYCLE) in [set(cycle) for cycle in chordless_cycles(TEN)]


def test_the_same_174_classes(derivation: SecondDerivation) -> None:
    assert derivation.agrees
    assert derivation.spheres == 1296
    assert derivation.graphs == len(derivation.hexahedra) == 174
    assert Counter(map(len, derivation.hexahedra)) == TABLE
    assert sum(len(orbit(tetrahedra)) for tetrahedra in derivation.hexahedra) == 6966


def test_what_the_paper_says_of_decomposition_graphs(derivation: SecondDerivation) -> None:
    assert derivation.findings.keys() == SENTENCES.keys()
    fail = {
        name: len(finding.counterexamples)
        for name, finding in derivation.findings.items()
        if not finding.holds
    }
    assert fail == {"cycle to edge": 122, "adjacency": 14, "ball": 5}


def test_cycles_without_interior_edge(derivation: SecondDerivation) -> None:
    exceptions = derivation.findings["cycle to edge"].counterexamples
    patterns = Counter(len(pattern) for pattern, _ in exceptions)
    assert patterns == {10: 10, 11: 26, 12: 28, 13: 28, 14: 19, 15: 11}
    assert min(len(cycle) for _, cycle in exceptions) == 6
    assert any(orbit(pattern) == orbit(TEN) for pattern, _ in exceptions)


def test_what_adjacency_does_not_tell_apart(derivation: SecondDerivation) -> None:
    groups = derivation.findings["adjacency"].counterexamples
    assert sum(map(len, groups)) == 29
    assert min(len(pattern) for group in groups for pattern in group) == 6
    same_kinds = categorical_multiedge_match("kind", None)
    for group in groups:
        for one, other in combinations(map(decomposition_graph, group), 2):
            assert nx.is_isomorphic(nx.Graph(one), nx.Graph(other))
            assert not nx.is_isomorphic(one, other, edge_match=same_kinds)
            assert adjacency_key(one) == adjacency_key(other)
            assert canonical_key(one) != canonical_key(other)


def test_patterns_that_are_one_ball(derivation: SecondDerivation) -> None:
    certificates = [json.loads(path.read_text()) for path in CERTIFICATES.glob("*.json")]
    by_class = {
        min(orbit(tuple(map(tuple, certificate["tetrahedra"])))): certificate
        for certificate in certificates
    }
    groups = [
        [by_class[pattern] for pattern in group]
        for group in derivation.findings["ball"].counterexamples
    ]
    assert sorted(map(len, groups)) == [2, 2, 2, 2, 3]
    for group in groups:
        for question in ("realizable", "convex"):
            assert len({certificate[question]["answer"] for certificate in group}) == 1
    flat = {c["pattern"] for c in certificates if c["realizable"]["answer"] == "no"}
    assert flat in [{certificate["pattern"] for certificate in group} for group in groups]
