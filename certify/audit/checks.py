"""The named checks: what a claim needs to have computed, beyond theorems and accepted answers.

A check is a function of :class:`Inputs` that returns whether its docstring holds of them. It is
registered under its name, with hyphens. Here are those about what the paper prints and about the
template; those about the accepted patterns are in :mod:`certify.audit.pattern_checks`.
"""

from collections import Counter
from collections.abc import Callable, Mapping
from itertools import combinations, pairwise, permutations
from math import comb, prod
from typing import Any, NamedTuple, TypeAlias

from sympy import ZZ
from sympy.polys.rings import ring

from certify import paper
from certify.audit.examples import DENTED, IN_THE_PLANE, ON_A_SPHERE
from certify.audit.samples import RANDOM, Sample
from certify.graphs import edges
from certify.kernel import names
from certify.kernel.certificate import PATTERN_COUNTS
from certify.kernel.check import Verdict
from certify.kernel.chirotope import QUINTUPLES, RELATIONS, Point, Term, chirotope, dependence
from certify.kernel.cube import TETRAHEDRON_TYPES
from certify.kernel.hexahedron import (
    BOUNDARIES,
    CORNERS,
    FACETS,
    SYMMETRIES,
    VERTICES,
    Simplex,
    boundary_triangles,
    image,
    simplex,
    sorted_with_sign,
)

Row: TypeAlias = tuple[int, ...]


class Inputs(NamedTuple):
    """All that checks look at: what the run accepted, what the paper prints, the template."""

    patterns: Mapping[str, Verdict]
    """Name -> verdict, for the patterns whose tetrahedra were accepted."""
    table_1: Mapping[str, tuple[Row, int]] = paper.TABLE_1
    letters: Mapping[str, str] = names.LETTERS
    bold: frozenset[str] = names.BOLD
    underlined: frozenset[str] = names.UNDERLINED
    no_matroid: tuple[str, ...] = paper.NO_UNIFORM_MATROID
    edges: tuple[str, ...] = paper.EDGES
    facets: tuple[str, ...] = paper.FACETS
    triangulations_in_figure: Mapping[int, int] = paper.TRIANGULATIONS_IN_FIGURE
    meshes: tuple[tuple[str, int, Row, int], ...] = paper.MESHES
    random_points: tuple[tuple[int, Row, int], ...] = paper.RANDOM_POINTS
    boundaries: tuple[frozenset[Simplex], ...] = BOUNDARIES
    types: Mapping[Simplex, str] = TETRAHEDRON_TYPES
    relations: tuple[tuple[Term, ...], ...] = RELATIONS
    dependences: tuple[tuple[tuple[int, Simplex, int], ...], ...] = tuple(
        map(dependence, QUINTUPLES)
    )
    on_a_sphere: tuple[Point, ...] = ON_A_SPHERE
    dented: tuple[Point, ...] = DENTED
    in_the_plane: tuple[tuple[tuple[int, int], ...], ...] = IN_THE_PLANE
    random_samples: tuple[Sample, ...] = RANDOM


Check: TypeAlias = Callable[[Inputs], bool]

CHECKS: dict[str, Check] = {}
"""Name -> check."""


def check(function: Check) -> Check:
    """Register a check."""
    CHECKS[function.__name__.replace("_", "-")] = function
    return function


# Tables 1 and 2


@check
def table_1_adds_up(inputs: Inputs) -> bool:
    """Both rows of Table 1 have the printed sums."""
    return all(sum(row) == total for row, total in inputs.table_1.values())


@check
def table_2_has_the_counts_of_table_1(inputs: Inputs) -> bool:
    """Table 2 has as many names of each size as Table 1, and as many in bold as it takes away."""
    (every, _), (realizable, _) = inputs.table_1["combinatorial"], inputs.table_1["geometrical"]
    bold = tuple(a - b for a, b in zip(every, realizable, strict=True))
    return _by_size(inputs.letters) == every and _by_size(inputs.bold) == bold


def _by_size(names: Mapping[str, str] | frozenset[str]) -> Row:
    return tuple(sum(paper.size(name) == size for name in names) for size in PATTERN_COUNTS)


@check
def table_2_has_no_gaps(inputs: Inputs) -> bool:
    """The names of each size in Table 2 are A, B, ..., Z, AA, AB, ... without gap."""
    alphabet = [first + chr(code) for first in ("", "A") for code in range(ord("A"), ord("Z") + 1)]
    columns: dict[int, list[str]] = {}
    for name in inputs.letters:
        columns.setdefault(paper.size(name), []).append(name.partition("_")[2])
    return all(found == alphabet[: len(found)] for found in columns.values())


@check
def letters_are_seven(inputs: Inputs) -> bool:
    """Table 2 has as many letters as Figure 8 has triangulations; Figure 5 has fewer."""
    figures = inputs.triangulations_in_figure
    return figures[5] < len(set(inputs.letters.values())) == figures[8]


@check
def text_names_the_underlined(inputs: Inputs) -> bool:
    """The names listed in section 4.4, together with 15_G, are the underlined ones."""
    return sorted((*inputs.no_matroid, names.NEEDS_FINAL_POLYNOMIAL)) == sorted(inputs.underlined)


# The template


def _sides(facets: tuple[str, ...]) -> Counter[str]:
    return Counter(
        "".join(sorted(side)) for facet in facets for side in pairwise((*facet, facet[0]))
    )


@check
def facets_are_those_of_a_cube(inputs: Inputs) -> bool:
    """The sides of the printed facets are the edges of the reference cube, each of two facets."""
    one_apart = [
        f"{a}{b}"
        for a, b in combinations(VERTICES, 2)
        if sum(x != y for x, y in zip(CORNERS[a], CORNERS[b], strict=True)) == 1
    ]
    return _sides(inputs.facets) == dict.fromkeys(one_apart, 2)


@check
def edge_36_is_a_diagonal(inputs: Inputs) -> bool:
    """The printed edges are the sides of the printed facets, but for 36 in the place of 37.

    The facet 2376 has both of its ends, so 36 is a diagonal.
    """
    printed, sides = set(inputs.edges), _sides(inputs.facets).keys()
    return printed - sides == {"36"} and sides - printed == {"37"}


@check
def boundaries_have_18_edges(inputs: Inputs) -> bool:
    """Each triangulation of the boundary has 18 edges: those of the template and 6 diagonals."""
    sides = {simplex(side) for facet in FACETS for side in pairwise((*facet, facet[0]))}
    found = [(edges(boundary_triangles(diagonals)), diagonals) for diagonals in inputs.boundaries]
    return {(len(all_), len(all_ - sides), all_ - sides == six) for all_, six in found} == {
        (18, 6, True)
    }


# Tetrahedra in the cube


@check
def types_are_orbits(inputs: Inputs) -> bool:
    """The symmetries of the cube take a tetrahedron to exactly all others of its type."""
    types: dict[str, set[Simplex]] = {}
    for quadruple, kind in inputs.types.items():
        types.setdefault(kind, set()).add(quadruple)
    orbits = {frozenset(image(symmetry, q) for symmetry in SYMMETRIES) for q in inputs.types}
    return orbits == set(map(frozenset, types.values()))


@check
def triangles_have_four_apexes(inputs: Inputs) -> bool:
    """On a triangle in a facet stand one corner, two staircase and one slanted tetrahedron."""
    return all(
        Counter(inputs.types[simplex((*triangle, v))] for v in VERTICES if v not in facet)
        == {"corner": 1, "staircase": 2, "slanted": 1}
        for facet in FACETS
        for triangle in combinations(facet, 3)
    )


@check
def core_diagonals_touch_no_facet(inputs: Inputs) -> bool:
    """No core diagonal tetrahedron has a triangle in a facet."""
    return all(
        len(set(facet).intersection(quadruple)) < 3
        for quadruple, kind in inputs.types.items()
        if kind == "core diagonal"
        for facet in FACETS
    )


# Chirotopes of points


def _symbols(vectors: int, *start: int) -> list[list[Any]]:
    """Return vectors of R^4 with symbols as coordinates, the first ones fixed if given."""
    free = 4 - len(start)
    over, *symbols = ring(f"x:{vectors * free}", ZZ)
    rows = [symbols[k * free : (k + 1) * free] for k in range(vectors)]
    return [[*map(over, start), *row] for row in rows]


def _determinant(rows: list[list[Any]]) -> Any:
    return sum(
        sorted_with_sign(order)[1] * prod(row[k] for row, k in zip(rows, order, strict=True))
        for order in permutations(range(len(rows)))
    )


@check
def grassmann_pluecker_is_an_identity(inputs: Inputs) -> bool:
    """All 420 relations, over two elements and four others, hold for any eight vectors of R^4.

    The relations are one polynomial, up to the names of the six vectors; it is expanded.
    """
    polynomials = set()
    for relation in inputs.relations:
        order = list(dict.fromkeys(v for x, y, _ in relation for v in (*x, *y)))
        polynomials.add(tuple((*map(order.index, (*x, *y)), e) for x, y, e in relation))
    vectors = _symbols(6)

    def bracket(places: tuple[int, ...]) -> Any:
        return _determinant([vectors[place] for place in places])

    return len(set(inputs.relations)) == comb(8, 2) * comb(6, 4) and all(
        sum(bracket(term[:4]) * bracket(term[4:8]) * term[8] for term in polynomial) == 0
        for polynomial in polynomials
    )


@check
def cramer_is_an_identity(inputs: Inputs) -> bool:
    """The numbers (-1)^i det(all but the i-th) are an affine dependence of any five points.

    So their sum is zero, and so is the sum of the points times these numbers.
    """
    shapes = {
        tuple((five.index(v), tuple(map(five.index, four)), sign) for v, four, sign in terms)
        for terms in inputs.dependences
        for five in [[v for v, _, _ in terms]]
    }
    points = _symbols(5, 1)
    return len(inputs.dependences) == comb(8, 5) and all(
        sum(sign * _determinant([points[k] for k in four]) * points[v][i] for v, four, sign in s)
        == 0
        for s in shapes
        for i in range(4)
    )


@check
def cospherical_points_can_be_uniform(inputs: Inputs) -> bool:
    """The eight points of the example are on the unit sphere, and no four of them are coplanar."""
    return (
        all(sum(x * x for x in point) == 1 for point in inputs.on_a_sphere)
        and 0 not in chirotope(inputs.on_a_sphere).values()
    )


@check
def one_triangle_turns(inputs: Inputs) -> bool:
    """The chirotopes of the two examples of four points in the plane differ in one triangle."""
    inside, outside = (
        [_determinant([[1, *point] for point in three]) for three in combinations(points, 3)]
        for points in inputs.in_the_plane
    )
    turned = [a * b < 0 for a, b in zip(inside, outside, strict=True)]
    return 0 not in (*inside, *outside) and sum(turned) == 1


# Tables 3 and 4


@check
def table_3_adds_up(inputs: Inputs) -> bool:
    """Every row of Table 3 has the printed total."""
    return all(sum(row) == total for _, _, row, total in inputs.meshes)


@check
def row_of_3000_points_is_wrong(inputs: Inputs) -> bool:
    """It alone in Table 4 does not sum to its total, but to 48 instead of 51.

    It has 2 patterns with seven tetrahedra; with 5, the sum would be right.
    """
    wrong = [row for row in inputs.random_points if sum(row[1]) != row[2]]
    return [(points, row[2], sum(row), total) for points, row, total in wrong] == [
        (3_000, 2, 48, 51)
    ]


@check
def meshes_have_eight_or_more(inputs: Inputs) -> bool:
    """By Table 3 every mesh has a pattern with eight or more tetrahedra."""
    return all(any(row[3:]) for _, _, row, _ in inputs.meshes)


@check
def meshes_have_fewer_than_random_points(inputs: Inputs) -> bool:
    """By Tables 3 and 4 each mesh has fewer patterns than the next smaller set of random points.

    The mesh that is smaller than all sets is compared with the smallest. Totals are summed anew.
    """
    first, *_ = inputs.random_points
    for _, vertices, row, _ in inputs.meshes:
        smaller = [found for points, found, _ in inputs.random_points if points <= vertices]
        if sum(row) >= sum(smaller[-1] if smaller else first[1]):
            return False
    return True


# Our own samples of random points


@check
def table_4_lies_within_samples(inputs: Inputs) -> bool:
    """Each row of Table 4 with five or more samples here has its entries between their extremes.

    But for one: with 3,000 points there are 5 patterns with seven tetrahedra in all samples, and
    not 2.
    """
    outside = []
    compared = 0
    for points, row, _ in inputs.random_points:
        found = [sample.row for sample in inputs.random_samples if sample.vertices == points]
        if len(found) >= 5:
            compared += 1
            columns = zip(row, zip(*found, strict=True), strict=True)
            outside += [(points, e, *c) for e, c in columns if not min(c) <= e <= max(c)]
    return compared >= 6 and [(*own[:2], {*own[2:]}) for own in outside] == [(3_000, 2, {5})]


@check
def random_points_have_all_up_to_nine(inputs: Inputs) -> bool:
    """In all twenty samples of 3,000 points there are all patterns with up to nine tetrahedra."""
    found = [sample.row for sample in inputs.random_samples if sample.vertices == 3_000]
    return len(found) == 20 and all(row[:5] == tuple(PATTERN_COUNTS.values())[:5] for row in found)


@check
def more_than_eleven_are_rare(inputs: Inputs) -> bool:
    """Of hexahedra among equally many points at most two in 100,000 have more than 11 tetrahedra.

    And in samples of each number of points there are some.
    """
    for points in {sample.vertices for sample in inputs.random_samples}:
        own = [sample for sample in inputs.random_samples if sample.vertices == points]
        rare, every = (sum(sample.occurrences(above) for sample in own) for above in (11, 0))
        if not 0 < 50_000 * rare <= every:
            return False
    return True
