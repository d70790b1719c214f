"""Graphs, balls and spheres made of a triangulation, and whether two of them are the same."""

from collections import Counter, defaultdict
from collections.abc import Callable, Hashable, Iterable, Iterator
from functools import cache
from itertools import chain, combinations
from typing import NamedTuple, TypeAlias

from certify.kernel.hexahedron import VERTICES, Simplex
from certify.kernel.triangulation import boundary_diagonals, triangles

Tetrahedra: TypeAlias = tuple[Simplex, ...]
Pair: TypeAlias = tuple[int, int]


class Decomposition(NamedTuple):
    """The decomposition graph of section 3.3: its nodes are the numbers of the tetrahedra.

    plain: a pair for each interior triangle; dashed: a pair for each diagonal of a facet.
    """

    size: int
    plain: tuple[Pair, ...]
    dashed: tuple[Pair, ...]


@cache
def decomposition(tetrahedra: Tetrahedra) -> Decomposition:
    """Return the decomposition graph of a triangulation of the hexahedron."""
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


@cache
def boundary(tetrahedra: Tetrahedra) -> tuple[Simplex, ...]:
    """Return the triangles that lie in one tetrahedron only."""
    count = Counter(chain.from_iterable(map(triangles, tetrahedra)))
    return tuple(sorted(triangle for triangle, times in count.items() if times == 1))


def edges(simplices: Iterable[Simplex]) -> set[Simplex]:
    """Return the edges of some simplices."""
    return {edge for face in simplices for edge in combinations(face, 2)}


def interior_edges(tetrahedra: Tetrahedra) -> set[Simplex]:
    """Return the edges that are not in the boundary."""
    return edges(tetrahedra) - edges(boundary(tetrahedra))


def is_sphere(facets: Iterable[Simplex]) -> bool:
    """Do the triangles form one closed surface with Euler characteristic 2?"""
    facets = list(facets)
    count = Counter(edge for triangle in facets for edge in combinations(triangle, 2))
    vertices = set(chain.from_iterable(facets))
    reached, waiting = {facets[0]}, [facets[0]]
    while waiting:
        near = waiting.pop()
        new = [t for t in facets if t not in reached and len(set(t).intersection(near)) == 2]
        reached.update(new)
        waiting += new
    return (
        set(count.values()) == {2}
        and len(reached) == len(facets)
        and len(vertices) - len(count) + len(facets) == 2
    )


def cone(tetrahedra: Tetrahedra, apex: int) -> Tetrahedra:
    """Return the tetrahedra that join a new vertex to the boundary triangles."""
    return tuple((*triangle, apex) for triangle in boundary(tetrahedra))


@cache
def chordless_cycles(size: int, pairs: tuple[Pair, ...]) -> frozenset[frozenset[int]]:
    """Return the node sets of the chordless cycles of a graph, triangles included."""
    near: list[set[int]] = [set() for _ in range(size)]
    for a, b in pairs:
        near[a].add(b)
        near[b].add(a)

    def longer(path: list[int]) -> Iterator[frozenset[int]]:
        """Extend a chordless path that starts at its least node; yield where it closes."""
        for node in near[path[-1]]:
            if node > path[0] and not any(node in (v, *near[v]) for v in path[1:-1]):
                if len(path) > 1 and node in near[path[0]]:
                    yield frozenset((*path, node))
                else:
                    yield from longer([*path, node])

    return frozenset(cycle for start in range(size) for cycle in longer([start]))


@cache
def around_interior_edges(tetrahedra: Tetrahedra) -> frozenset[frozenset[int]]:
    """Return, for each interior edge, the numbers of the tetrahedra around it."""
    return frozenset(
        frozenset(k for k, tetrahedron in enumerate(tetrahedra) if set(edge) <= set(tetrahedron))
        for edge in interior_edges(tetrahedra)
    )


class Network(NamedTuple):
    """A graph with kinds of nodes, and kinds (not 0) of joined pairs, each in both orders."""

    nodes: tuple[int, ...]
    joined: dict[Pair, int]


def coloured(tetrahedra: Tetrahedra) -> Network:
    """Return the decomposition graph, plain and dashed edges told apart."""
    size, plain, dashed = decomposition(tetrahedra)
    return _network((0,) * size, [(pair, 1) for pair in plain] + [(pair, 2) for pair in dashed])


def colourless(tetrahedra: Tetrahedra) -> Network:
    """Return the decomposition graph as the mere relation of being joined."""
    size, plain, dashed = decomposition(tetrahedra)
    return _network((0,) * size, [(pair, 1) for pair in {*map(_sorted, (*plain, *dashed))}])


def dual(tetrahedra: Tetrahedra) -> Network:
    """Return the graph of the tetrahedra that share triangles."""
    size, plain, _ = decomposition(tetrahedra)
    return _network((0,) * size, [(pair, 1) for pair in plain])


def complex_of(tetrahedra: Tetrahedra) -> Network:
    """Return the ball itself, without the facets: its vertices, then its tetrahedra.

    Vertices are joined as often as they are in a tetrahedron together, which is for speed only:
    the incidences of vertices and tetrahedra say it all.
    """
    first = len(VERTICES)
    pairs = [((v - 1, first + k), 1) for k, t in enumerate(tetrahedra) for v in t]
    pairs += [((a - 1, b - 1), 1) for t in tetrahedra for a, b in combinations(t, 2)]
    return _network((0,) * first + (1,) * len(tetrahedra), pairs)


def _sorted(pair: Pair) -> Pair:
    return min(pair), max(pair)


def _network(nodes: tuple[int, ...], pairs: Iterable[tuple[Pair, int]]) -> Network:
    joined: Counter[Pair] = Counter()
    for (a, b), kind in pairs:
        joined[a, b] += kind
        joined[b, a] += kind
    return Network(nodes, dict(joined))


def _colours(network: Network) -> list[int]:
    """Return a colour for each node, the same for nodes that an isomorphism may exchange."""
    neighbours: list[list[Pair]] = [[] for _ in network.nodes]
    for (a, b), kind in network.joined.items():
        neighbours[a].append((kind, b))
    colours = list(network.nodes)
    for _ in range(4):
        colours = [
            hash((colours[a], *sorted((kind, colours[b]) for kind, b in near)))
            for a, near in enumerate(neighbours)
        ]
    return colours


def _searched(network: Network) -> list[int]:
    """Return the nodes, of a connected network, so that each is joined to an earlier one."""
    neighbours = defaultdict(list)
    for a, b in network.joined:
        neighbours[a].append(b)
    order = {0: None}
    waiting = [0]
    for node in waiting:
        waiting += [other for other in neighbours[node] if other not in order]
        order.update(dict.fromkeys(neighbours[node]))
    return list(order)


def isomorphic(one: Network, other: Network) -> bool:
    """Does a bijection take one connected network to another, keeping all kinds?"""
    colours, others = _colours(one), _colours(other)
    if sorted(colours) != sorted(others):
        return False
    image: dict[int, int] = {}

    def fits(node: int, candidate: int) -> bool:
        return colours[node] == others[candidate] and all(
            one.joined.get((node, a)) == other.joined.get((candidate, b)) for a, b in image.items()
        )

    def extended(nodes: list[int]) -> bool:
        if not nodes:
            return True
        for candidate in set(range(len(others))) - set(image.values()):
            if fits(nodes[0], candidate):
                image[nodes[0]] = candidate
                if extended(nodes[1:]):
                    return True
                del image[nodes[0]]
        return False

    return extended(_searched(one))


Balls: TypeAlias = tuple[tuple[str, Tetrahedra], ...]
"""Patterns, each with an instance."""


@cache
def classes(balls: Balls, kind: Callable[[Tetrahedra], Network]) -> tuple[tuple[str, ...], ...]:
    """Sort patterns by isomorphism of what ``kind`` makes of them."""
    buckets: defaultdict[Hashable, list[list[tuple[str, Network]]]] = defaultdict(list)
    for name, tetrahedra in balls:
        network = kind(tetrahedra)
        found = buckets[tuple(sorted(_colours(network)))]
        for same in found:
            if isomorphic(network, same[0][1]):
                same.append((name, network))
                break
        else:
            found.append([(name, network)])
    return tuple(tuple(name for name, _ in same) for found in buckets.values() for same in found)
