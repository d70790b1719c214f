"""Section 3 and Table 2: the template, the 174, balls and spheres, decomposition graphs."""

from collections import Counter
from collections.abc import Callable, Iterable
from itertools import combinations, pairwise

from certify import paper
from certify.audit.claims import Case, Claim, Truth
from certify.audit.graphs import (
    Network,
    Tetrahedra,
    around_interior_edges,
    boundary,
    chordless_cycles,
    classes,
    coloured,
    colourless,
    complex_of,
    cone,
    decomposition,
    edges,
    is_sphere,
)
from certify.kernel.hexahedron import (
    BOUNDARIES,
    CORNERS,
    FACETS,
    VERTICES,
    Simplex,
    boundary_letter,
    boundary_triangles,
    simplex,
)
from certify.kernel.triangulation import boundary_diagonals, triangles

APEX = len(VERTICES) + 1
"""The ninth vertex, over which a ball becomes a sphere."""


def _face(label: str) -> Simplex:
    return tuple(map(int, label))


def _template_edges() -> set[Simplex]:
    """Return the sides of the kernel's facets, which are the edges of the reference cube."""
    return {simplex(side) for facet in FACETS for side in pairwise((*facet, facet[0]))}


def _printed_facet_sides() -> set[Simplex]:
    """Return the sides of the facets as the paper prints them, each in cyclic order."""
    facets = map(_face, paper.FACETS)
    return {simplex(side) for facet in facets for side in pairwise((*facet, facet[0]))}


def _edges_are_right() -> bool:
    return set(map(_face, paper.EDGES)) == _printed_facet_sides()


def _only_36_is_wrong() -> bool:
    printed = set(map(_face, paper.EDGES))
    return (
        printed - _template_edges() == {(3, 6)}
        and _template_edges() - printed == {(3, 7)}
        and _template_edges() == _printed_facet_sides()
        and {3, 6} < set(_face("2376"))
    )


def _facets_are_right() -> bool:
    """Are the printed facets those of the reference cube, each in cyclic order?"""
    sides = Counter(
        simplex(side) for facet in map(_face, paper.FACETS) for side in pairwise((*facet, facet[0]))
    )
    one_apart = {
        (a, b)
        for a, b in combinations(VERTICES, 2)
        if sum(x != y for x, y in zip(CORNERS[a], CORNERS[b], strict=True)) == 1
    }
    return sides == dict.fromkeys(one_apart, 2) and len(one_apart) == 12


EDGE_LIST = Truth(
    "The edge 36 has to be 37: 36 is a diagonal of the paper's own facet 2376, 37 a side of it.",
    lambda _: _only_36_is_wrong(),
)


def _has_boundary_of_section_3(tetrahedra: Tetrahedra) -> bool:
    """Are there 8 vertices, 12 triangles, two to a facet, and the 12 edges among the 18?"""
    faces = boundary(tetrahedra)
    facets = Counter(
        facet for facet in map(frozenset, FACETS) for face in faces if set(face) < facet
    )
    return (
        {v for face in faces for v in face} == set(VERTICES)
        and len(faces) == 12
        and list(facets.values()) == [2] * 6
        and _template_edges() < edges(faces)
        and len(edges(faces)) == 18
    )


def _no_boundary_tetrahedra(tetrahedra: Tetrahedra) -> bool:
    return not set(tetrahedra).intersection(map(simplex, FACETS))


def _is_closed(tetrahedra: Iterable[Simplex]) -> bool:
    """Is every triangle in exactly two tetrahedra?"""
    count = Counter(triangle for t in tetrahedra for triangle in triangles(t))
    return set(count.values()) == {2}


def _coned_is_closed(tetrahedra: Tetrahedra) -> bool:
    """Does the cone close the ball to a manifold with nine vertices, around a sphere?"""
    return _is_closed((*tetrahedra, *cone(tetrahedra, APEX))) and is_sphere(boundary(tetrahedra))


def _star_leaves_ball(tetrahedra: Tetrahedra) -> bool:
    """Is the star of the apex twelve tetrahedra whose removal from the sphere leaves the ball?"""
    sphere = {*tetrahedra, *cone(tetrahedra, APEX)}
    star = {tetrahedron for tetrahedron in sphere if APEX in tetrahedron}
    return len(star) == 12 and sphere - star == set(tetrahedra)


def _link_has_tetrahedra(tetrahedra: Tetrahedra) -> bool:
    """Does the link of the apex consist of the tetrahedra at it?"""
    star = [t for t in cone(tetrahedra, APEX) if APEX in t]
    link = {tuple(v for v in tetrahedron if v != APEX) for tetrahedron in star}
    return link == set(star)


def _pentagon_cone() -> tuple[Simplex, ...]:
    """Return the cone over a pentagon 1..5 cut into three triangles, with apex 6."""
    disc = [(1, 2, 3), (1, 3, 4), (1, 4, 5)]
    count = Counter(edge for triangle in disc for edge in combinations(triangle, 2))
    return (*disc, *((*edge, 6) for edge, times in count.items() if times == 1))


def _found(case: Case, names: Iterable[str]) -> Counter[tuple[int, str]]:
    """Count patterns by number of tetrahedra and type of boundary."""
    patterns = case.facts.patterns
    return Counter((patterns[name].size, patterns[name].boundary) for name in names)


def _printed(names: Iterable[str]) -> Counter[tuple[int, str]]:
    """Count names by number of tetrahedra and printed letter."""
    return Counter((paper.size(name), paper.LETTERS[name]) for name in names)


def _underlined_but_for_two(case: Case) -> bool:
    """Do the printed letters c and f of 13_T and 13_W stand where d and g were found?"""
    printed, found = _printed(paper.UNDERLINED), _found(case, case.not_convex)
    return (
        printed - found == Counter({(13, "c"): 1, (13, "f"): 1})
        and found - printed == Counter({(13, "d"): 1, (13, "g"): 1})
        and {name for name in paper.UNDERLINED if paper.size(name) == 13} == {"13_T", "13_W"}
        and {paper.LETTERS["13_T"], paper.LETTERS["13_W"]} == {"c", "f"}
    )


def _number_of_classes(case: Case, kind: Callable[[Tetrahedra], Network]) -> int:
    return len(classes(case.balls(), kind))


def _same(case: Case, kind: Callable[[Tetrahedra], Network], *names: str) -> bool:
    """Are these patterns the same as far as ``kind`` shows?"""
    return any(set(names) <= set(group) for group in classes(case.balls(), kind))


def _degrees_are_4(tetrahedra: Tetrahedra) -> bool:
    graph = decomposition(tetrahedra)
    degrees = Counter(node for pair in (*graph.plain, *graph.dashed) for node in pair)
    return degrees == dict.fromkeys(range(graph.size), 4)


def _six_dashed(tetrahedra: Tetrahedra) -> bool:
    graph = decomposition(tetrahedra)
    interior = (4 * graph.size - 12) // 2
    return len(set(graph.dashed)) == 6 and len(set(graph.plain)) == interior


def _extra_cycles(tetrahedra: Tetrahedra) -> int:
    """Return how many chordless cycles there are besides those around interior edges.

    -1 if one of those is missing.
    """
    size, plain, _ = decomposition(tetrahedra)
    cycles, around = chordless_cycles(size, plain), around_interior_edges(tetrahedra)
    return len(cycles - around) if around <= cycles else -1


def _names_have_no_gaps() -> bool:
    """Do the names of each column go on without gap, as 174 different ones?"""
    suffixes: dict[int, list[str]] = {}
    for name in paper.LETTERS:
        suffixes.setdefault(paper.size(name), []).append(name.partition("_")[2])
    alphabet = [chr(code) for code in range(ord("A"), ord("Z") + 1)]
    alphabet += ["A" + letter for letter in alphabet]
    return len(paper.LETTERS) == 174 and all(
        found == alphabet[: len(found)] for found in suffixes.values()
    )


DEFINITIONS = (
    Claim(
        "template-edges",
        "section 3",
        "The template has the edges 12, 14, 15, 23, 26, 34, 36, 48, 56, 58, 67, 78.",
        lambda _: _edges_are_right(),
        recomputed="recomputed: sides of the printed facets",
        correction=EDGE_LIST,
    ),
    Claim(
        "template-facets",
        "section 3",
        "The template has the facets 1234, 1265, 1485, 2376, 3487, 5678.",
        lambda _: _facets_are_right(),
        recomputed="recomputed: edges of the reference cube, each a side of two printed facets",
    ),
    Claim(
        "template-boundary",
        "section 3",
        "The boundary has the 8 vertices, the 12 edges, and 12 triangles, two for each facet.",
        lambda case: case.all(_has_boundary_of_section_3),
        theorems=("patterns",),
        recomputed="recomputed: boundaries of the 174 patterns",
    ),
    Claim(
        "definition-manifold",
        "section 3",
        "A triangulation of the hexahedron is a 3-manifold with this boundary and these vertices.",
        lambda case: case.all(_has_boundary_of_section_3),
        theorems=("patterns",),
        recomputed="shellings of the 174 patterns (kernel/triangulation.py)",
        stronger=Truth(
            "Every such manifold is a ball: completeness asks for no more than a manifold, and all "
            "that are listed can be shelled.",
            lambda case: case.facts.complete,
        ),
    ),
    Claim(
        "theorem-1",
        "section 3, Theorem 3.1",
        "There are 174 triangulations of the hexahedron, up to isomorphism, without boundary "
        "tetrahedra.",
        lambda case: len(case.tetrahedra) == 174 and case.all(_no_boundary_tetrahedra),
        theorems=("patterns",),
    ),
)

TABLE_2 = (
    Claim(
        "table-2-names",
        "Table 2",
        "The table lists 174 names, in each column from A on without gap.",
        lambda _: _names_have_no_gaps(),
        recomputed="recomputed: names of Table 2",
    ),
    Claim(
        "table-2-letters",
        "Table 2",
        "Of each number of tetrahedra there are as many triangulations with each boundary as the "
        "table's letters say.",
        lambda case: _printed(paper.LETTERS) == _found(case, case.tetrahedra),
        theorems=("patterns", "letters"),
        recomputed="recomputed: letters of Table 2, column by column",
    ),
    Claim(
        "table-2-bold",
        "Table 2 and its caption",
        "Three names are bold: 15_A, 15_B, 15_J, with the letters g, f, g, are not realizable.",
        lambda case: (
            case.no("realizable") == paper.BOLD
            and len(paper.BOLD) == 3
            and _found(case, paper.BOLD) == _printed(paper.BOLD)
        ),
        theorems=("realizable",),
        recomputed="recomputed: letters of the bold names",
    ),
    Claim(
        "table-2-underlined",
        "Table 2 and its caption",
        "Thirteen names are underlined: 2, 2, 5 and 4 with 12, 13, 14 and 15 tetrahedra are "
        "realizable, but not in convex position.",
        lambda case: (
            case.facts.row(case.not_convex)
            == [sum(paper.size(n) == size for n in paper.UNDERLINED) for size in range(5, 16)]
            and len(case.not_convex) == len(paper.UNDERLINED) == 13
        ),
        theorems=("convex",),
        recomputed="recomputed: underlined names of Table 2",
    ),
    Claim(
        "table-2-underlined-letters",
        "Table 2",
        "The underlined names have the letters of the boundaries: c for 13_T, f for 13_W.",
        lambda case: _printed(paper.UNDERLINED) == _found(case, case.not_convex),
        theorems=("convex",),
        answers=("13_T convex", "13_W convex"),
        recomputed="recomputed: letters of the underlined names",
        correction=Truth(
            "The two with 13 tetrahedra have boundary types d and g. So the wrong letters are "
            "printed, or the wrong names are underlined; the other eleven are right.",
            _underlined_but_for_two,
        ),
    ),
    Claim(
        "table-2-figure",
        "caption of Table 2",
        "The letters a to g stand for the triangulations in Figure 5.",
        lambda _: len(set(paper.LETTERS.values())) == paper.CAPTION_REFERS_TO[1],
        recomputed="recomputed: number of letters, and of triangulations in Figures 5 and 8",
        correction=Truth(
            "They stand for those in Figure 8, seven of the boundary; Figure 5 has four "
            "triangulations of the finite precision cube.",
            lambda _: len(set(paper.LETTERS.values())) == paper.CAPTION_MEANS[1],
        ),
    ),
)

BALLS = (
    Claim(
        "ball-misprint",
        "section 3.1",
        "Triangulations of the 3-sphere correspond to triangulations of the 3-sphere, as those of "
        "the 2-sphere do to those of the 2-ball.",
        lambda case: case.all(lambda tetrahedra: not boundary(tetrahedra)),
        theorems=("patterns",),
        recomputed="recomputed: boundaries of the 174 patterns, and their cones",
        correction=Truth(
            "The second must be the 3-ball: what is coned over has a boundary.",
            lambda case: case.all(lambda t: bool(boundary(t)) and _coned_is_closed(t)),
        ),
    ),
    Claim(
        "ball-cone",
        "section 3.1",
        "A triangulation of the hexahedron is a ball with 8 vertices; the cone over its boundary "
        "makes it a sphere with 9.",
        lambda case: case.all(_coned_is_closed),
        theorems=("patterns",),
        recomputed="recomputed: cones over the boundaries of the 174 patterns",
    ),
    Claim(
        "ball-link",
        "section 3.1",
        "Removing a vertex of the sphere and its link, the tetrahedra at it, leaves the ball.",
        lambda case: case.all(_link_has_tetrahedra),
        theorems=("patterns",),
        recomputed="recomputed: stars and links in the cones over the 174 patterns",
        correction=Truth(
            "The tetrahedra at a vertex are its star. The link is the boundary of the ball and "
            "stays.",
            lambda case: (
                case.all(_star_leaves_ball)
                and not any(map(_link_has_tetrahedra, case.tetrahedra.values()))
            ),
        ),
    ),
    Claim(
        "ball-1296",
        "section 3.1",
        "There are 1296 triangulations of the 3-sphere with 9 vertices.",
        None,
        recomputed="certify spheres (certify/search/spheres.py) finds them, outside the kernel",
    ),
    Claim(
        "ball-nine",
        "section 3.1",
        "Each of the 1296 gives nine triangulations of the ball with eight vertices.",
        None,
        recomputed="certify spheres (certify/search/spheres.py) finds those with a hexahedron's "
        "boundary, outside the kernel",
    ),
    Claim(
        "ball-pentagon",
        "section 3.1; caption of Figure 7",
        "The cone over the five edges of a pentagon cut into 3 triangles makes a 2-sphere of 8.",
        lambda _: len(_pentagon_cone()) == 8 and is_sphere(_pentagon_cone()),
        recomputed="recomputed: the cone over a pentagon",
    ),
)

BOUNDARY = (
    Claim(
        "boundary-18",
        "section 3.2",
        "The triangulated boundary has 18 edges: 12 fixed ones and 6 diagonals.",
        lambda _: all(
            len(diagonals) == 6
            and not diagonals & _template_edges()
            and edges(boundary_triangles(diagonals)) == diagonals | _template_edges()
            for diagonals in BOUNDARIES
        ),
        recomputed="recomputed: edges of the 64 boundaries",
    ),
    Claim(
        "boundary-64",
        "section 3.2",
        "Two choices for each diagonal make 64 triangulations of the boundary.",
        lambda _: len(set(BOUNDARIES)) == 2**6 == 64,
        theorems=("boundaries",),
    ),
    Claim(
        "boundary-7",
        "section 3.2; caption of Figure 8",
        "Up to isomorphism there are 7.",
        lambda _: len(set(map(boundary_letter, BOUNDARIES))) == 7,
        theorems=("boundaries", "letters"),
        stronger=Truth(
            "Each of the seven bounds some of the 174: 2, 7, 14, 47, 19, 21 and 64 of them.",
            lambda case: (
                Counter(v.boundary for v in case.facts.patterns.values())
                == dict(zip("abcdefg", (2, 7, 14, 47, 19, 21, 64), strict=True))
            ),
        ),
    ),
)

GRAPHS = (
    Claim(
        "graph-degree",
        "section 3.3",
        "Every node of a decomposition graph has degree 4.",
        lambda case: case.all(_degrees_are_4),
        theorems=("patterns",),
        recomputed="recomputed: decomposition graphs of the 174 patterns; a plain and a dashed "
        "edge between the same nodes count as two",
    ),
    Claim(
        "graph-edges",
        "section 3.3",
        "Plain edges are the interior triangles; the six dashed ones are the diagonals of the "
        "facets.",
        lambda case: case.all(_six_dashed),
        theorems=("patterns",),
        recomputed="recomputed: decomposition graphs of the 174 patterns",
    ),
    Claim(
        "graph-cycles",
        "section 3.3",
        "Simple chordless cycles of plain edges and interior edges correspond to each other.",
        lambda case: case.all(lambda tetrahedra: _extra_cycles(tetrahedra) == 0),
        theorems=("patterns",),
        recomputed="recomputed: chordless cycles of the decomposition graphs of the 174 patterns",
        correction=Truth(
            "Around every interior edge there is such a cycle, but in 122 of the 174 "
            "triangulations there are others, around no edge; the smallest have ten tetrahedra.",
            lambda case: (
                [
                    min(map(_extra_cycles, case.tetrahedra.values())),
                    sum(_extra_cycles(t) > 0 for t in case.tetrahedra.values()),
                    min(len(t) for t in case.tetrahedra.values() if _extra_cycles(t)),
                ]
                == [0, 122, 10]
            ),
        ),
    ),
    Claim(
        "graph-edges-again",
        "section 3.3",
        "The edges 12, 14, 15, 23, 26, 34, 36, 48, 56, 58, 67, 78 are fixed.",
        lambda _: _edges_are_right(),
        recomputed="recomputed: sides of the printed facets",
        correction=EDGE_LIST,
    ),
    Claim(
        "graph-isomorphism",
        "section 3.3",
        "Triangulations are isomorphic iff their decomposition graphs are.",
        lambda case: _number_of_classes(case, coloured) == 174,
        theorems=("patterns",),
        recomputed="recomputed: isomorphism of the coloured decomposition graphs",
    ),
    Claim(
        "graph-adjacency",
        "section 3.3",
        "An isomorphism of the graphs is a bijection of their nodes that keeps adjacency.",
        lambda case: _number_of_classes(case, colourless) == 174,
        theorems=("patterns",),
        recomputed="recomputed: isomorphism of the decomposition graphs without their colours",
        correction=Truth(
            "It has to keep the colours of the edges, too. By adjacency alone 159 classes are "
            "left; two triangulations of the cube fall together, 6_C and 6_E.",
            lambda case: (
                _number_of_classes(case, colourless) == 159
                and _same(case, colourless, "6_C", "6_E")
            ),
        ),
    ),
    Claim(
        "graph-relabelling",
        "abstract; section 1; section 3.3",
        "The 174 are counted up to a relabelling of the vertices.",
        lambda case: _number_of_classes(case, complex_of) == 174,
        theorems=("patterns",),
        recomputed="recomputed: isomorphism of the 174 patterns as simplicial complexes",
        correction=Truth(
            "Only up to one that keeps the hexahedron. Otherwise 168 are left: the boundary of a "
            "ball may be paired into facets in several ways.",
            lambda case: _number_of_classes(case, complex_of) == 168,
        ),
    ),
    Claim(
        "graph-diagonals",
        "section 3.3",
        "One diagonal is chosen in each of the six facets.",
        lambda case: case.all(lambda t: boundary_diagonals(t) in BOUNDARIES),
        theorems=("patterns",),
        recomputed="recomputed: boundaries of the 174 patterns",
    ),
)
