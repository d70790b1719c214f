"""The named checks about the accepted patterns. Each needs the tetrahedra of all 174."""

from collections import Counter
from collections.abc import Callable, Iterable
from itertools import chain, combinations

from certify.audit.checks import Check, Inputs, check
from certify.audit.matroids import uniform_sign_vectors
from certify.graphs import (
    Network,
    Tetrahedra,
    around_interior_edges,
    ball,
    chordless_cycles,
    classes,
    coloured,
    colourless,
    cone,
    decomposition,
    dual,
    edges,
)
from certify.kernel.certificate import PATTERN_COUNTS, PATTERN_NAMES, No
from certify.kernel.chirotope import chirotope, circuits
from certify.kernel.cube import CUBE_SIGNS
from certify.kernel.embedding import NotRealized, require_realization
from certify.kernel.hexahedron import (
    CORNERS,
    VERTICES,
    Simplex,
    sorted_with_sign,
)
from certify.kernel.jacobian import require_positive_jacobian
from certify.kernel.names import NEEDS_FINAL_POLYNOMIAL
from certify.kernel.orientations import convex_formula, realization_formula
from certify.kernel.refutation import excluded_signs
from certify.kernel.triangulation import orbit, orientation, triangles
from certify.paper import size

CUBE = tuple(name for name in PATTERN_NAMES if size(name) <= 6)
"""The patterns with five or six tetrahedra. They are the cube's (theorems cube, sizes)."""

WITH_SLIVER = ("7_B", "7_C", "7_D", "7_E")
"""The patterns of the finite precision cube (theorem finite-precision-cube)."""


def check_of_patterns(function: Check) -> Check:
    """Register a check that fails unless the tetrahedra of all patterns were accepted."""

    def complete(inputs: Inputs) -> bool:
        return inputs.patterns.keys() == set(PATTERN_NAMES) and function(inputs)

    complete.__name__, complete.__doc__ = function.__name__, function.__doc__
    return check(complete)


def _balls(inputs: Inputs, names: Iterable[str] = PATTERN_NAMES) -> dict[str, Tetrahedra]:
    """Return the least instance of each of the patterns."""
    return {name: min(inputs.patterns[name].instances) for name in names}


def _classes(inputs: Inputs, kind: Callable[[Tetrahedra], Network]) -> list[set[str]]:
    return classes(_balls(inputs), kind)


# Letters of Table 2


def _printed(inputs: Inputs, names: Iterable[str]) -> Counter[tuple[int, str]]:
    """Count names by number of tetrahedra and printed letter."""
    return Counter((size(name), inputs.letters[name]) for name in names)


def _found(inputs: Inputs, **answers: str) -> Counter[tuple[int, str]]:
    """Count the patterns with these answers by number of tetrahedra and type of boundary."""
    return Counter(
        (verdict.size, verdict.boundary)
        for verdict in inputs.patterns.values()
        if all(verdict.answers[question] == answer for question, answer in answers.items())
    )


@check_of_patterns
def letters_fit_in_one_way(inputs: Inputs) -> bool:
    """Every letter has the counts, size by size, of one type of boundary, which is ours."""
    columns = {
        tuple(_found(inputs)[size, letter] for size in PATTERN_COUNTS) for letter in "abcdefg"
    }
    return _printed(inputs, inputs.letters) == _found(inputs) and len(columns) == 7


@check_of_patterns
def letters_of_the_bold_are_right(inputs: Inputs) -> bool:
    """The patterns that are not realizable have the letters of the names in bold."""
    return _printed(inputs, inputs.bold) == _found(inputs, realizable="no")


@check_of_patterns
def letters_of_two_underlined_are_wrong(inputs: Inputs) -> bool:
    """13_T and 13_W have the letters c and f instead of d and g; the other underlined are right.

    Compared are the underlined names with the patterns that are realizable, but not convex.
    """
    two = {"13_T", "13_W"}
    found = _found(inputs, realizable="yes", convex="no")
    return (
        two < inputs.underlined
        and _printed(inputs, two) == Counter([(13, "c"), (13, "f")])
        and _printed(inputs, inputs.underlined - two) + Counter([(13, "d"), (13, "g")]) == found
    )


# The cube


def _of_the_cube(inputs: Inputs) -> list[Tetrahedra]:
    return [instance for name in CUBE for instance in inputs.patterns[name].instances]


def _lengths(tetrahedron: Simplex) -> list[int]:
    """Return the squared lengths of a tetrahedron's, or an edge's, edges in the unit cube."""
    return [
        sum((x - y) ** 2 for x, y in zip(CORNERS[a], CORNERS[b], strict=True))
        for a, b in combinations(tetrahedron, 2)
    ]


def _regular(tetrahedra: Tetrahedra) -> int:
    """Return how many tetrahedra have six edges of equal length."""
    return sum(len(set(_lengths(tetrahedron))) == 1 for tetrahedron in tetrahedra)


def _diameters(tetrahedra: Tetrahedra) -> int:
    """Return how many edges join opposite vertices of the cube."""
    return sum(_lengths(edge) == [3] for edge in edges(tetrahedra))


@check_of_patterns
def either_regular_or_diameter(inputs: Inputs) -> bool:
    """Each of the 74 has one regular tetrahedron or one diameter, and not both."""
    found = [(_regular(instance), _diameters(instance)) for instance in _of_the_cube(inputs)]
    return len(found) == 74 and set(found) == {(1, 0), (0, 1)}


@check_of_patterns
def two_have_a_regular_tetrahedron(inputs: Inputs) -> bool:
    """Two of the 74 have a regular tetrahedron, and a symmetry takes one to the other."""
    found = [instance for instance in _of_the_cube(inputs) if _regular(instance)]
    return len(found) == 2 and orbit(found[0]) == set(found)


@check_of_patterns
def duals_tell_five_apart(inputs: Inputs) -> bool:
    """The dual graphs of the cube's classes with a diameter, five, are not isomorphic."""
    second = {name: t for name, t in _balls(inputs, CUBE).items() if _diameters(t)}
    return len(second) == len(classes(second, dual)) == 5


@check_of_patterns
def cells_of_cubes_are_interior_edges(inputs: Inputs) -> bool:
    """In the cube's classes the chordless cycles of the dual graph go around the interior edges."""
    return all(
        chordless_cycles(decomposition(t).plain) == set(around_interior_edges(t).values())
        for t in _balls(inputs, CUBE).values()
    )


@check_of_patterns
def slivers_leave_two_prisms(inputs: Inputs) -> bool:
    """7_B to 7_E have one core diagonal tetrahedron, three others on either side of its plane."""
    return all(_prisms(inputs, t) == [3, 3] for t in _balls(inputs, WITH_SLIVER).values())


def _prisms(inputs: Inputs, tetrahedra: Tetrahedra) -> list[int]:
    """Return how many tetrahedra are on either side of the only core diagonal one, else nothing.

    Those on both sides are not counted.
    """
    slivers = [t for t in tetrahedra if inputs.types[t] == "core diagonal"]
    if len(slivers) != 1:
        return []
    sides: Counter[int] = Counter()
    for tetrahedron in tetrahedra:
        others = [vertex for vertex in tetrahedron if vertex not in slivers[0]]
        fours = (sorted_with_sign((*slivers[0][:3], vertex)) for vertex in others)
        touched = {sign * CUBE_SIGNS[four] for four, sign in fours}
        if len(touched) == 1:
            sides.update(touched)
    return sorted(sides.values())


# Balls and decomposition graphs

APEX = len(VERTICES) + 1
"""The ninth vertex, over which a ball becomes a sphere."""


@check_of_patterns
def cones_close_the_balls(inputs: Inputs) -> bool:
    """Every pattern has 12 boundary triangles; with the cone over them all triangles are shared.

    Then each triangle, with the ninth vertex or without, is in exactly two tetrahedra.
    """
    for t in _balls(inputs).values():
        sphere = (*t, *cone(t, APEX))
        times = Counter(chain.from_iterable(map(triangles, sphere)))
        if len(sphere) != len(t) + 12 or set(times.values()) != {2}:
            return False
    return True


@check_of_patterns
def cycles_need_not_be_edges(inputs: Inputs) -> bool:
    """Each interior edge has a chordless cycle, but in 122 patterns there are more cycles.

    In 105 of these some have no dashed chord either. The smallest have ten tetrahedra.
    """
    more, without_dashed_chord = [], []
    for t in _balls(inputs).values():
        _, plain, dashed = decomposition(t)
        cycles, around = chordless_cycles(plain), around_interior_edges(t)
        others = cycles.difference(around.values())
        if len(cycles) - len(others) != len(around):
            return False
        more += [len(t)] if others else []
        chords = [pair for pair in dashed if pair not in plain and pair[::-1] not in plain]
        if any(not any(cycle.issuperset(chord) for chord in chords) for cycle in others):
            without_dashed_chord.append(len(t))
    return [len(more), len(without_dashed_chord)] == [122, 105] and min(without_dashed_chord) == 10


@check_of_patterns
def coloured_graphs_tell_patterns_apart(inputs: Inputs) -> bool:
    """No two of the 174 coloured decomposition graphs are isomorphic."""
    return len(_classes(inputs, coloured)) == 174


@check_of_patterns
def isomorphism_needs_colours(inputs: Inputs) -> bool:
    """Up to bijections that keep adjacency alone, 159 graphs are left; 6_C and 6_E are the same."""
    found = _classes(inputs, colourless)
    return len(found) == 159 and any({"6_C", "6_E"} <= names for names in found)


@check_of_patterns
def balls_forget_facets(inputs: Inputs) -> bool:
    """Up to any relabelling there are 168 balls; 15_A, 15_B and 15_J are one, 15_D and 15_K too."""
    found = _classes(inputs, ball)
    return len(found) == 168 and {"15_A", "15_B", "15_J"} in found and {"15_D", "15_K"} in found


# Oriented matroids and placements


@check_of_patterns
def three_have_no_oriented_matroid(inputs: Inputs) -> bool:
    """No uniform sign vector satisfies the constraints of section 4.2 for the names in bold."""
    bold = _balls(inputs, sorted(inputs.bold)).values()
    return len(bold) == 3 and all(uniform_sign_vectors(t, realization_formula) == [] for t in bold)


@check_of_patterns
def of_thirteen_one_has_an_oriented_matroid(inputs: Inputs) -> bool:
    """With no vertex inside four others, 15_G has one uniform oriented matroid, the rest none."""
    balls = _balls(inputs, sorted(inputs.underlined))
    found = {name: uniform_sign_vectors(t, convex_formula) for name, t in balls.items()}
    some = {name: vectors for name, vectors in found.items() if vectors != []}
    return len(found) == 13 and [*some] == [NEEDS_FINAL_POLYNOMIAL] and None not in some.values()


@check_of_patterns
def final_polynomial_excludes_the_oriented_matroid(inputs: Inputs) -> bool:
    """The only uniform oriented matroid of 15_G has the signs of one of its final polynomials."""
    certificate = inputs.patterns[NEEDS_FINAL_POLYNOMIAL].certificate
    answer = certificate.answers["convex"] if certificate else None
    if certificate is None or not isinstance(answer, No):
        return False
    vectors = uniform_sign_vectors(certificate.tetrahedra, convex_formula) or []
    return any(
        polynomial.signs.items() <= vector.items() and excluded_signs(polynomial) != ()
        for vector in vectors
        for polynomial in answer.final_polynomials
    )


@check_of_patterns
def valid_need_not_be_convex(inputs: Inputs) -> bool:
    """The example realizes 5_A with positive Jacobian, and one point is inside four others."""
    signs = chirotope(inputs.dented)
    try:
        require_realization(orientation(_balls(inputs, ["5_A"])["5_A"]), signs)
        require_positive_jacobian(inputs.dented)
    except NotRealized:
        return False
    return any({len(side) for side in circuit} == {1, 4} for circuit in circuits(signs))


@check_of_patterns
def tables_3_and_4_are_possible(inputs: Inputs) -> bool:
    """No entry exceeds the number of patterns of that size that carry a valid hexahedron."""
    found = Counter(v.size for v in inputs.patterns.values() if v.answers["valid"] == "yes")
    rows = [row for _, _, row, _ in inputs.meshes] + [row for _, row, _ in inputs.random_points]
    return all(
        entry <= found[size]
        for row in rows
        for size, entry in zip(PATTERN_COUNTS, row, strict=True)
    )
