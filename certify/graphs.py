"""Graphs and complexes made of a triangulation, and whether two of them are isomorphic.

The *decomposition graph* (section 3.3 of the paper, after Meshkat and Talmor 2000) has a node for
each tetrahedron, a plain edge for each triangle that two tetrahedra share, and a dashed edge for
each facet of the hexahedron, between the two tetrahedra that have its triangles. These are two
because there is no boundary tetrahedron. A plain and a dashed edge may join the same tetrahedra.
"""

from collections import Counter, defaultdict
from collections.abc import Callable, Iterable, Iterator, Mapping
from functools import cache
from itertools import chain, combinations
from typing import NamedTuple, TypeAlias

from certify.kernel.hexahedron import VERTICES, Simplex
from certify.kernel.triangulation import boundary_diagonals, triangles

Tetrahedra: TypeAlias = tuple[Simplex, ...]
Pair: TypeAlias = tuple[int, int]


class Decomposition(NamedTuple):
    """A decomposition graph, whose nodes 0, 1, ... are the tetrahedra in their order.

    plain: a pair for each interior triangle; dashed: a pair for each diagonal of a facet.
    """

    size: int
    plain: tuple[Pair, ...]
    dashed: tuple[Pair, ...]


@cache
def decomposition(tetrahedra: Tetrahedra) -> Decomposition:
    """Return the decomposition graph of a triangulation of the hexahedron.

    Raises:
        certify.kernel.triangulation.NotATriangulation: The hexahedron does not bound them.
    """
    at = defaultdict(list)
    for number, tetrahedron in enumerate(tetrahedra):
        for triangle in triangles(tetrahedron):
            at[triangle].append(number)
    plain = tuple((pair[0], pair[1]) for pair in at.values() if len(pair) == 2)
    dashed = []
    for diagonal in sorted(boundary_diagonals(tetrahedra)):
        a, b = (at[t][0] for t in at if len(at[t]) == 1 and set(diagonal) < set(t))
        dashed.append((a, b))
    return Decomposition(len(tetrahedra), plain, tuple(dashed))


def boundary(tetrahedra: Iterable[Simplex]) -> list[Simplex]:
    """Return the triangles that lie in one tetrahedron only."""
    count = Counter(chain.from_iterable(map(triangles, tetrahedra)))
    return sorted(triangle for triangle, times in count.items() if times == 1)


def cone(tetrahedra: Tetrahedra, apex: int) -> Tetrahedra:
    """Return the tetrahedra that join a new vertex to the boundary triangles."""
    return tuple((*triangle, apex) for triangle in boundary(tetrahedra))


def edges(simplices: Iterable[Simplex]) -> set[Simplex]:
    """Return the edges of some simplices."""
    return {edge for face in simplices for edge in combinations(face, 2)}


def around_interior_edges(tetrahedra: Tetrahedra) -> dict[Simplex, frozenset[int]]:
    """Return, for each edge that is not in the boundary, the numbers of the tetrahedra at it."""
    return {
        edge: frozenset(k for k, tetrahedron in enumerate(tetrahedra) if {*edge} < {*tetrahedron})
        for edge in sorted(edges(tetrahedra) - edges(boundary(tetrahedra)))
    }


def chordless_cycles(pairs: Iterable[Pair]) -> set[frozenset[int]]:
    """Return the node sets of the chordless cycles of a graph, triangles included."""
    near = defaultdict(set)
    for a, b in pairs:
        near[a].add(b)
        near[b].add(a)

    def closed(path: list[int]) -> Iterator[frozenset[int]]:
        """Extend a chordless path that starts at its least node; yield where it closes."""
        for node in near[path[-1]]:
            if node > path[0] and not any(node in (v, *near[v]) for v in path[1:-1]):
                if len(path) > 1 and node in near[path[0]]:
                    yield frozenset((*path, node))
                else:
                    yield from closed([*path, node])

    return {cycle for start in list(near) for cycle in closed([start])}


class Network(NamedTuple):
    """A connected graph with kinds of nodes, and kinds (not 0) of joined pairs, in both orders."""

    nodes: tuple[int, ...]
    joined: dict[Pair, int]


def coloured(tetrahedra: Tetrahedra) -> Network:
    """Return the decomposition graph, plain and dashed edges told apart."""
    size, plain, dashed = decomposition(tetrahedra)
    return _network((0,) * size, [(pair, 1) for pair in plain] + [(pair, 2) for pair in dashed])


def colourless(tetrahedra: Tetrahedra) -> Network:
    """Return the decomposition graph as the mere relation of being joined."""
    nodes, joined = coloured(tetrahedra)
    return Network(nodes, dict.fromkeys(joined, 1))


def dual(tetrahedra: Tetrahedra) -> Network:
    """Return the graph of the tetrahedra that share triangles: the dual complex's."""
    size, plain, _ = decomposition(tetrahedra)
    return _network((0,) * size, [(pair, 1) for pair in plain])


def ball(tetrahedra: Tetrahedra) -> Network:
    """Return the simplicial complex itself, without facets: which vertices the tetrahedra have."""
    first = len(VERTICES)
    pairs = [((v - 1, first + k), 1) for k, t in enumerate(tetrahedra) for v in t]
    return _network((0,) * first + (1,) * len(tetrahedra), pairs)


def _network(nodes: tuple[int, ...], pairs: Iterable[tuple[Pair, int]]) -> Network:
    """Return the network; pairs that are joined twice have the sum of both kinds."""
    joined: Counter[Pair] = Counter()
    for (a, b), kind in pairs:
        joined[a, b] += kind
        joined[b, a] += kind
    return Network(nodes, dict(joined))


def _colours(network: Network) -> list[int]:
    """Return a colour for each node, the same for nodes that an isomorphism may exchange."""
    colours = list(network.nodes)
    for _ in range(4):
        near = defaultdict(list)
        for (a, b), kind in network.joined.items():
            near[a].append((kind, colours[b]))
        colours = [hash((colour, *sorted(near[a]))) for a, colour in enumerate(colours)]
    return colours


def _in_reach(network: Network) -> list[int]:
    """Return the nodes so that each but the first is joined to an earlier one."""
    order = [0]
    for node in order:
        order += [b for a, b in network.joined if a == node and b not in order]
    return order


def isomorphic(one: Network, other: Network) -> bool:
    """Does a bijection of the nodes take one network to the other, keeping all kinds?"""
    colours, others = _colours(one), _colours(other)
    if sorted(colours) != sorted(others):
        return False
    image: dict[int, int] = {}

    def extended(nodes: list[int]) -> bool:
        if not nodes:
            return True
        node, *rest = nodes
        for candidate, colour in enumerate(others):
            if (
                colour == colours[node]
                and candidate not in image.values()
                and all(
                    one.joined.get((node, a)) == other.joined.get((candidate, b))
                    for a, b in image.items()
                )
            ):
                image[node] = candidate
                if extended(rest):
                    return True
                del image[node]
        return False

    return extended(_in_reach(one))


def classes(
    balls: Mapping[str, Tetrahedra], kind: Callable[[Tetrahedra], Network]
) -> list[set[str]]:
    """Sort named triangulations by isomorphism of what ``kind`` makes of them."""
    found: defaultdict[tuple[int, ...], list[tuple[Network, set[str]]]] = defaultdict(list)
    for name, tetrahedra in balls.items():
        network = kind(tetrahedra)
        alike = found[tuple(sorted(_colours(network)))]
        same = next((names for first, names in alike if isomorphic(network, first)), None)
        if same is None:
            alike.append((network, {name}))
        else:
            same.add(name)
    return [names for alike in found.values() for _, names in alike]
