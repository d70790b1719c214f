"""Decomposition graphs, and the paper's road to the 174 classes as a second derivation of them.

The decomposition graph (section 3.3 of the paper, after Meshkat and Talmor 2000) has a node for
each tetrahedron, a plain edge for each triangle that two tetrahedra share, and a dashed edge for
each facet of the hexahedron, between the two tetrahedra that have its triangles. These are two
because there is no boundary tetrahedron. A plain and a dashed edge may join the same tetrahedra.

:func:`second_derivation` sorts the hexahedra that are found in the 3-spheres with nine vertices by
their decomposition graphs, compares the classes with those of :mod:`certify.search.enumeration`,
and tests what the paper says of decomposition graphs. Not all of it holds, see :data:`SENTENCES`.
"""

from collections import Counter, defaultdict
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from itertools import combinations
from typing import TypeAlias

import networkx as nx
import pynauty

from certify.kernel.hexahedron import Simplex, simplex
from certify.kernel.triangulation import boundary_diagonals, orbit, triangles
from certify.search.enumeration import patterns
from certify.search.spheres import Complex, Report, canonical, hexahedra, spheres

PLAIN, DASHED = "plain", "dashed"

Pairs: TypeAlias = set[tuple[int, int]]
"""Which nodes 0, 1, ... are joined by an edge of one kind, the smaller number first."""

Key: TypeAlias = tuple[int, tuple[tuple[tuple[int, int], ...], ...]]
"""The number of nodes and, kind by kind, the edges, in labels that are nauty's."""


def decomposition_graph(tetrahedra: Complex) -> nx.MultiGraph:
    """Return the decomposition graph of a triangulation of the hexahedron.

    Its nodes are the tetrahedra. The key of an edge is what it stands for: the shared triangle of a
    plain edge, the diagonal of a dashed one; the attribute ``kind`` says which it is.

    Raises:
        certify.kernel.triangulation.NotATriangulation: They are not bounded by the hexahedron.
    """
    diagonals = boundary_diagonals(tetrahedra)
    graph = nx.MultiGraph()
    graph.add_nodes_from(tetrahedra)
    at = defaultdict(list)
    for tetrahedron in tetrahedra:
        for triangle in triangles(tetrahedron):
            at[triangle].append(tetrahedron)
    for triangle, sides in at.items():
        if len(sides) == 2:
            graph.add_edge(*sides, key=triangle, kind=PLAIN)
    for diagonal in sorted(diagonals):
        ends = [
            sides[0]
            for triangle, sides in at.items()
            if len(sides) == 1 and set(diagonal) < set(triangle)
        ]
        graph.add_edge(*ends, key=diagonal, kind=DASHED)
    return graph


def canonical_key(graph: nx.MultiGraph) -> Key:
    """Return what two decomposition graphs have in common iff they are isomorphic.

    That is, iff a bijection of the nodes takes plain edges to plain and dashed to dashed ones.
    """
    return _key(len(graph), [_edges(graph, PLAIN), _edges(graph, DASHED)])


def adjacency_key(graph: nx.MultiGraph) -> Key:
    """Return what two decomposition graphs have in common iff their adjacencies are isomorphic.

    That is, iff a bijection of the nodes takes joined nodes to joined nodes, by whatever edges.
    """
    return _key(len(graph), [_edges(graph, PLAIN, DASHED)])


def automorphisms(graph: nx.MultiGraph) -> int:
    """Return the number of isomorphisms of a decomposition graph to itself."""
    layered = _layered(len(graph), [_edges(graph, PLAIN), _edges(graph, DASHED)])
    _, mantissa, exponent, *_ = pynauty.autgrp(layered)
    order: int = round(mantissa * 10**exponent)
    return order


def _edges(graph: nx.MultiGraph, *kinds: str) -> Pairs:
    """Return the pairs that are joined by an edge of these kinds, with nodes numbered from 0."""
    number = {tetrahedron: k for k, tetrahedron in enumerate(sorted(graph))}
    return {
        _pair(number[one], number[other])
        for one, other, kind in graph.edges(data="kind")
        if kind in kinds
    }


def _pair(one: int, other: int) -> tuple[int, int]:
    return min(one, other), max(one, other)


def _layered(size: int, layers: list[Pairs]) -> pynauty.Graph:
    """Return a graph with one copy of the nodes for each kind of edge, the first joined to all.

    Two plain edges never join the same nodes (two tetrahedra that share two triangles are one), nor
    do two dashed ones (two facets have six or more vertices); so a set of pairs has them all.
    """
    neighbours = defaultdict(list)
    for k, layer in enumerate(layers):
        for one, other in layer:
            neighbours[k * size + one].append(k * size + other)
    for node in range(size):
        neighbours[node] += [k * size + node for k in range(1, len(layers))]
    return pynauty.Graph(
        size * len(layers),
        adjacency_dict=dict(neighbours),
        vertex_coloring=[set(range(k * size, (k + 1) * size)) for k in range(len(layers))],
    )


def _key(size: int, layers: list[Pairs]) -> Key:
    """Return the edges in the labels that nauty gives all graphs isomorphic to this one.

    Equal keys prove isomorphism. That isomorphic graphs have equal keys is up to nauty.
    """
    order = pynauty.canon_label(_layered(size, layers))[:size]
    label = {node: k for k, node in enumerate(order)}
    return size, tuple(
        tuple(sorted(_pair(label[one], label[other]) for one, other in layer)) for layer in layers
    )


def interior_edges(tetrahedra: Complex) -> set[Simplex]:
    """Return the edges that are not in the boundary of a triangulation of the hexahedron."""
    count = Counter(triangle for t in tetrahedra for triangle in triangles(t))
    on_boundary = {
        simplex(edge)
        for triangle, times in count.items()
        if times == 1
        for edge in combinations(triangle, 2)
    }
    edges = {simplex(edge) for t in tetrahedra for edge in combinations(t, 2)}
    return edges - on_boundary


def chordless_cycles(tetrahedra: Complex) -> list[Complex]:
    """Return the simple chordless cycles of plain edges, each in cyclic order, the shortest first.

    A chord would be a plain edge between two tetrahedra of the cycle that are not neighbours in it.
    """
    graph = decomposition_graph(tetrahedra)
    plain = nx.Graph([ends for *ends, kind in graph.edges(data="kind") if kind == PLAIN])
    return sorted(map(tuple, nx.chordless_cycles(plain)), key=len)


Counterexample: TypeAlias = tuple[Complex, ...]
"""A triangulation of the hexahedron and what contradicts: others that are wrongly the same to the
sentence, or a cycle of its tetrahedra. It is alone if it is simply an exception."""


@dataclass(frozen=True)
class Finding:
    """What became of a sentence of the paper when it was tested on all 174 classes."""

    sentence: str
    counterexamples: tuple[Counterexample, ...]

    @property
    def holds(self) -> bool:
        """Was no counterexample found?"""
        return not self.counterexamples


def _degree_not_four(classes: list[Complex]) -> Iterator[Counterexample]:
    for instance in _instances(classes):
        if any(degree != 4 for _, degree in decomposition_graph(instance).degree):
            yield (instance,)


def _not_six_dashed(classes: list[Complex]) -> Iterator[Counterexample]:
    for instance in _instances(classes):
        graph = decomposition_graph(instance)
        if len(_edges(graph, DASHED)) != 6 or graph.number_of_edges() != 2 * len(graph):
            yield (instance,)


def _interior_edge_without_cycle(classes: list[Complex]) -> Iterator[Counterexample]:
    for tetrahedra in classes:
        cycles = [set(cycle) for cycle in chordless_cycles(tetrahedra)]
        rounds = [_around(tetrahedra, edge) for edge in sorted(interior_edges(tetrahedra))]
        for k, around in enumerate(rounds):
            if set(around) not in cycles or around in rounds[:k]:
                yield tetrahedra, around


def _cycle_without_interior_edge(classes: list[Complex]) -> Iterator[Counterexample]:
    for tetrahedra in classes:
        rounds = [set(_around(tetrahedra, edge)) for edge in interior_edges(tetrahedra)]
        others = [cycle for cycle in chordless_cycles(tetrahedra) if set(cycle) not in rounds]
        if others:
            yield tetrahedra, others[0]


def _instance_with_another_graph(classes: list[Complex]) -> Iterator[Counterexample]:
    for tetrahedra in classes:
        key = canonical_key(decomposition_graph(tetrahedra))
        for instance in sorted(orbit(tetrahedra)):
            if canonical_key(decomposition_graph(instance)) != key:
                yield tetrahedra, instance


def _same_graph(classes: list[Complex]) -> Iterator[Counterexample]:
    return _not_told_apart(classes, lambda t: canonical_key(decomposition_graph(t)))


def _other_symmetries(classes: list[Complex]) -> Iterator[Counterexample]:
    for tetrahedra in classes:
        if automorphisms(decomposition_graph(tetrahedra)) * len(orbit(tetrahedra)) != 48:
            yield (tetrahedra,)


def _same_adjacency(classes: list[Complex]) -> Iterator[Counterexample]:
    return _not_told_apart(classes, lambda t: adjacency_key(decomposition_graph(t)))


def _same_ball(classes: list[Complex]) -> Iterator[Counterexample]:
    return _not_told_apart(classes, canonical)


def _instances(classes: list[Complex]) -> Iterator[Complex]:
    for tetrahedra in classes:
        yield from sorted(orbit(tetrahedra))


def _around(tetrahedra: Complex, edge: Simplex) -> Complex:
    return tuple(tetrahedron for tetrahedron in tetrahedra if set(edge) <= set(tetrahedron))


def _not_told_apart(
    classes: list[Complex], key: Callable[[Complex], object]
) -> Iterator[Counterexample]:
    """Yield the classes, two or more at a time, that have the same key."""
    same = defaultdict(list)
    for tetrahedra in classes:
        same[key(tetrahedra)].append(tetrahedra)
    return (tuple(group) for group in same.values() if len(group) > 1)


SENTENCES: Mapping[str, tuple[str, Callable[[list[Complex]], Iterator[Counterexample]]]] = {
    "degree": (
        "Each vertex of a decomposition graph is of degree 4, a plain and a dashed edge between "
        "the same two tetrahedra being counted as two.",
        _degree_not_four,
    ),
    "dashed edges": (
        "There are six dashed edges, one for each diagonal.",
        _not_six_dashed,
    ),
    "edge to cycle": (
        "The tetrahedra around an interior edge are a simple chordless cycle of plain edges, "
        "different ones for different edges.",
        _interior_edge_without_cycle,
    ),
    "cycle to edge": (
        "Every simple chordless cycle of plain edges goes around an interior edge.",
        _cycle_without_interior_edge,
    ),
    "triangulation to graph": (
        "Triangulations that a symmetry of the hexahedron takes to each other have isomorphic "
        "decomposition graphs.",
        _instance_with_another_graph,
    ),
    "graph to triangulation": (
        "Triangulations with isomorphic decomposition graphs are taken to each other by a "
        "symmetry of the hexahedron.",
        _same_graph,
    ),
    "symmetries": (
        "A triangulation has as many symmetries as its decomposition graph.",
        _other_symmetries,
    ),
    "adjacency": (
        "Decomposition graphs are isomorphic if a bijection of their vertices takes adjacent "
        "vertices to adjacent ones, whatever the color of the edges.",
        _same_adjacency,
    ),
    "ball": (
        "Triangulations that are the same up to a relabeling of the eight vertices have "
        "isomorphic decomposition graphs.",
        _same_ball,
    ),
}
"""What section 3.3 says of decomposition graphs, and the search for exceptions to each sentence.

The sentences are the paper's made precise; where it can be read in two ways, both are here. The
first two and "triangulation to graph" are tested on all labelled instances, the others on one
instance of each class. Three fail:

* "cycle to edge". In 122 of the 174 classes there are chordless cycles, of six to twelve
  tetrahedra, around no interior edge: in 10, 26, 28, 28, 19 and 11 of those with 10, ..., 15
  tetrahedra. (Those of three, four or five tetrahedra do all go around an interior edge.)
* "adjacency", which is how the paper spells out what an isomorphism of graphs is. The kind of an
  edge has to be kept as well: otherwise 29 classes become 14, so that 159 are left. Among the 29
  are two triangulations of the cube into six tetrahedra.
* "ball". The boundary triangles of a ball can be paired into facets in several ways, and not always
  does an automorphism of the ball take these to each other. So the 174 are the classes of balls
  with six facets marked; the balls by themselves form 168. One of them is three of the 174, those
  without a realization.
"""


@dataclass(frozen=True)
class SecondDerivation:
    """What the paper's road leads to."""

    spheres: int
    """How many 3-spheres with nine vertices there are."""
    hexahedra: frozenset[Complex]
    """The least instance of every class of hexahedra found in them."""
    graphs: int
    """How many classes their decomposition graphs form."""
    agrees: bool
    """Are the classes by decomposition graphs, by symmetries, and of the enumeration the same?"""
    findings: dict[str, Finding]
    """What became of :data:`SENTENCES`."""


def second_derivation(report: Report) -> SecondDerivation:
    """Derive the classes of triangulated hexahedra from the 3-spheres with nine vertices."""
    nine_vertex_spheres = spheres(9, report)
    least = defaultdict(set)
    for tetrahedra in hexahedra(nine_vertex_spheres):
        least[canonical_key(decomposition_graph(tetrahedra))].add(min(orbit(tetrahedra)))
    found = frozenset[Complex]().union(*least.values())
    report(f"{len(found)} classes of hexahedra, {len(least)} of decomposition graphs")
    enumerated = {min(orbit(pattern.tetrahedra)) for pattern in patterns()}
    classes = sorted(found, key=lambda tetrahedra: (len(tetrahedra), tetrahedra))
    findings = {}
    for name, (sentence, exceptions) in SENTENCES.items():
        finding = findings[name] = Finding(sentence, tuple(exceptions(classes)))
        report(f"{name}: {len(finding.counterexamples) or 'no'} counterexamples")
    return SecondDerivation(
        spheres=len(nine_vertex_spheres),
        hexahedra=found,
        graphs=len(least),
        agrees=found == enumerated and all(len(instances) == 1 for instances in least.values()),
        findings=findings,
    )
