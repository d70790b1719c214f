"""Section 4: realizations, oriented matroids, convex position, and the captions of its figures."""

from functools import partial
from itertools import chain, combinations, product

from certify import paper
from certify.audit.claims import Case, Claim, Truth
from certify.audit.examples import (
    DENTED,
    MOMENT,
    ON_A_SPHERE,
    SAGGING,
    has_inner_point,
    has_positive_jacobian,
    is_convex,
    radon_points_are_as_printed,
    realizes,
    separates,
)
from certify.audit.graphs import classes, complex_of
from certify.audit.matroids import convex_sign_vectors, is_uniform_chirotope
from certify.kernel.certificate import PATTERN_NAMES
from certify.kernel.chirotope import QUINTUPLES, chirotope, dependence
from certify.kernel.hexahedron import boundary_triangles
from certify.kernel.orientations import Clause, has_sign, no_overlap, on_hull
from certify.kernel.triangulation import boundary_diagonals, orientation

BOLD = tuple(name for name in PATTERN_NAMES if name in paper.BOLD)
UNDERLINED = tuple(name for name in PATTERN_NAMES if name in paper.UNDERLINED)
FIFTEENS = tuple(name for name in PATTERN_NAMES if paper.size(name) == 15)
CONVEX_FIFTEENS = tuple(n for n in FIFTEENS if n not in (*BOLD, *UNDERLINED))


def _answers(names: tuple[str, ...], *questions: str) -> tuple[str, ...]:
    return tuple(f"{name} {question}" for name in names for question in questions)


def _sagging_union_is_not_the_hull(case: Case) -> bool:
    """Do convex points realize 5_A so that a boundary triangle has points on both sides?"""
    tetrahedra = case.tetrahedra["5_A"]
    return (
        realizes(SAGGING, tetrahedra)
        and is_convex(SAGGING)
        and any(
            separates(SAGGING, triangle)
            for triangle in boundary_triangles(boundary_diagonals(tetrahedra)).values()
        )
    )


def _is_one_ball(case: Case, *names: str) -> bool:
    """Are the patterns the same ball with other facets?"""
    return len(classes(case.balls(names), complex_of)) == 1


def _plane_circuits() -> dict[tuple[int, ...], int]:
    """Return the possible signs of the four triples of plane points, with the size of a side.

    The dependence of points a, b, c, d has the signs (-1)^i of the triples without the i-th point;
    they are not all equal. The smaller side of this circuit has one point (inside the triangle of
    the others) or two (the diagonals of a convex quadrilateral).
    """
    found = {}
    for signs in product((1, -1), repeat=4):
        positive = sum(sign * (-1) ** i > 0 for i, sign in enumerate(signs))
        if 0 < positive < 4:
            found[signs] = min(positive, 4 - positive)
    return found


def _one_triangle_turns() -> bool:
    """Are there two configurations, and does each turn into the other by one triangle?"""
    sides = _plane_circuits()
    return set(sides.values()) == {1, 2} and all(
        any(sides.get((*signs[:i], -signs[i], *signs[i + 1 :])) == 3 - side for i in range(4))
        for signs, side in sides.items()
    )


def _acyclic_clauses() -> set[Clause]:
    """Return the clauses "the dependence of these five has not this sign in every place"."""
    return {
        tuple(sorted(-has_sign(quadruple, factor * sign) for _, quadruple, factor in dependence(q)))
        for q in QUINTUPLES
        for sign in (1, -1)
    }


def _acyclicity_is_not_asked(case: Case) -> bool:
    """Do the refuted formulas ask nowhere that the dependence of five points has two signs?

    Only two families of their clauses are about five points.
    """
    forbidden = _acyclic_clauses()
    return not any(
        tuple(sorted(clause)) in forbidden
        for name in (*BOLD, *UNDERLINED)
        for clause in chain(no_overlap(orientation(case.tetrahedra[name])), on_hull())
    )


def _hull_clauses_are_all() -> bool:
    """Do the kernel's clauses exclude, for each five points, that one has a sign of its own?"""
    signs = {
        tuple(
            (1 if -literal == has_sign(quadruple, factor) else -1)
            for literal, (_, quadruple, factor) in zip(clause, dependence(five), strict=True)
        )
        for five, clauses in zip(QUINTUPLES, _in_tens(tuple(on_hull())), strict=True)
        for clause in clauses
    }
    return signs == {s for s in product((1, -1), repeat=5) if abs(sum(s)) == 3}


def _in_tens(clauses: tuple[Clause, ...]) -> list[tuple[Clause, ...]]:
    return [clauses[i : i + 10] for i in range(0, len(clauses), 10)]


def _sign_vectors(case: Case) -> dict[str, int | None]:
    """Return how many uniform oriented matroids each underlined pattern has, if convex."""
    return {name: convex_sign_vectors(case.tetrahedra[name]) for name in UNDERLINED}


def _only_15_g_has_sign_vectors(case: Case) -> bool:
    """Has each underlined pattern but that one no uniform oriented matroid in convex position?"""
    found = _sign_vectors(case)
    return [name for name in UNDERLINED if found[name] != 0] == [paper.NEEDS_FINAL_POLYNOMIAL]


def _no_pattern_is_lost(case: Case) -> bool:
    return case.yes("valid") <= case.yes("convex") and len(case.yes("valid")) == 143


def _a_valid_hexahedron_is_not_convex(case: Case) -> bool:
    return (
        realizes(DENTED, case.tetrahedra["5_A"])
        and has_positive_jacobian(DENTED)
        and has_inner_point(DENTED)
    )


REALIZATION = (
    Claim(
        "realization-hull",
        "section 4",
        "In a valid triangulation the union of the tetrahedra is the convex hull of the points.",
        lambda case: case.yes("realizable") <= case.yes("convex"),
        theorems=("realizable", "convex"),
        recomputed="recomputed: 5_A on the unit cube with vertices 2 and 4 lowered by 1/4",
        correction=Truth(
            "This cannot be meant: all vertices are on the boundary of the union, but in 13 of the "
            "171 never all on that of the hull. Nor does every realization in convex position fill "
            "the hull: see 5_A. What is used is that the tetrahedra intersect properly.",
            lambda case: (
                len(case.yes("realizable")) == 171
                and len(case.not_convex) == 13
                and _sagging_union_is_not_the_hull(case)
            ),
        ),
    ),
    Claim(
        "theorem-2",
        "section 4, Theorem 4.1; section 4.3",
        "171 of the 174 have a geometrical realization.",
        lambda case: len(case.yes("realizable")) == 171 and len(case.facts.patterns) == 174,
        theorems=("patterns", "realizable"),
    ),
    Claim(
        "realization-three",
        "section 4",
        "The three without a realization have 15 tetrahedra.",
        lambda case: (
            len(case.no("realizable")) == 3
            and case.of_size(case.no("realizable"), 15) == case.no("realizable")
        ),
        theorems=("realizable",),
        answers=_answers(BOLD, "realizable"),
        recomputed="recomputed: isomorphism of 15_A, 15_B, 15_J as simplicial complexes",
        stronger=Truth(
            "They are one and the same ball of tetrahedra, its boundary paired into facets in "
            "three ways.",
            lambda case: _is_one_ball(case, *BOLD),
        ),
    ),
)

DEFINITIONS = (
    Claim(
        "matroid-alternating",
        "section 4.1",
        "A chirotope gives 1 or -1 to all r-tuples of elements and is alternating.",
        lambda _: any(value == -value for value in (1, -1)),
        recomputed="exchange of two equal elements",
        correction=Truth(
            "Only to tuples of different elements: to exchange two equal ones would change the "
            "sign of a value that stays the same, so it would have to be 0.",
            lambda _: [value for value in (-1, 0, 1) if value == -value] == [0],
        ),
    ),
    Claim(
        "matroid-relations",
        "section 4.1",
        "The signs of points, no four of them coplanar, satisfy the condition on r-2 elements and "
        "four others.",
        lambda _: all(is_uniform_chirotope(chirotope(p)) for p in (MOMENT, ON_A_SPHERE)),
        recomputed="recomputed: the 420 relations for two sets of eight points",
    ),
    Claim(
        "matroid-general-position",
        "section 4.1; section 4.2",
        "The results suppose points in general position: no four coplanar, no five cospherical.",
        lambda case: len(case.no("realizable")) == 3 and len(case.not_convex) == 13,
        theorems=("realizable", "convex"),
        stronger=Truth(
            "Not needed: the refutations allow every position, coinciding and coplanar points "
            "included.",
            lambda case: (
                case.no("realizable") == paper.BOLD and case.no("convex").issuperset(UNDERLINED)
            ),
        ),
    ),
    Claim(
        "matroid-cospherical",
        "section 4.1; section 4.2",
        "For the signs to be uniform it takes that no five points are cospherical.",
        lambda _: 0 in chirotope(ON_A_SPHERE).values(),
        recomputed="recomputed: signs of eight rational points of the unit sphere",
        correction=Truth(
            "Spheres do not matter: eight points of one sphere may have all signs non-zero. It "
            "takes that no four are coplanar.",
            lambda _: (
                all(sum(x * x for x in point) == 1 for point in ON_A_SPHERE)
                and 0 not in chirotope(ON_A_SPHERE).values()
            ),
        ),
    ),
    Claim(
        "matroid-plane",
        "caption of Figure 11",
        "Four points of the plane have two configurations; one of their 4 triangles turns between "
        "them.",
        lambda _: _one_triangle_turns() and len(tuple(combinations("abcd", 3))) == 4,
        recomputed="recomputed: the 14 acyclic sign vectors of four plane points",
    ),
)

FORMULATION = (
    Claim(
        "constraint-acyclic",
        "section 4.2",
        "The oriented matroid has to be acyclic.",
        lambda case: len(case.no("realizable")) == 3,
        theorems=("realizable", "convex"),
        answers=(*_answers(BOLD, "realizable"), *_answers(UNDERLINED, "convex")),
        recomputed="clauses of the refuted formulas (kernel/orientations.py)",
        stronger=Truth(
            "True of points, but not needed: the formulas that are refuted do not ask for it.",
            _acyclicity_is_not_asked,
        ),
    ),
    Claim(
        "constraint-oriented",
        "section 4.2",
        "All tetrahedra can be taken as positive, since they are coherently oriented.",
        lambda case: all(
            len(orientation(tetrahedra)) == len(tetrahedra)
            for tetrahedra in case.tetrahedra.values()
        ),
        theorems=("patterns",),
        recomputed="coherent orientations of the 174 patterns (kernel/triangulation.py)",
    ),
    Claim(
        "constraint-circuits",
        "section 4.2",
        "The signs (-1)^i of five points without the i-th are their circuit; its two sides share a "
        "point, and no other.",
        lambda _: radon_points_are_as_printed(MOMENT) and radon_points_are_as_printed(ON_A_SPHERE),
        recomputed="recomputed: the 56 circuits of two sets of eight points",
    ),
    Claim(
        "constraint-result",
        "section 4.2",
        "15_A, 15_B, 15_J admit no oriented matroid with the five constraints.",
        lambda case: case.no("realizable") == paper.BOLD,
        theorems=("realizable",),
        answers=_answers(BOLD, "realizable"),
        stronger=Truth(
            "Nor one with zeros: no sign vector of any placement, coplanar points allowed.",
            lambda case: case.no("realizable") == paper.BOLD,
        ),
    ),
    Claim(
        "figure-8s",
        "caption of Figure 12",
        "The seven triangulations with 8 tetrahedra, six and 8_E, have realizations.",
        lambda case: (
            len(case.of_size(case.facts.patterns, 8)) == 7
            and case.of_size(case.yes("realizable"), 8) == case.of_size(case.facts.patterns, 8)
            and "8_E" in case.yes("realizable")
        ),
        theorems=("sizes", "realizable-sizes"),
        answers=_answers(tuple(f"8_{letter}" for letter in "ABCDEFG"), "realizable"),
    ),
    Claim(
        "realized-all",
        "section 4.3",
        "Every triangulation that admits an oriented matroid has a realization.",
        lambda case: case.yes("realizable") | case.no("realizable") == set(case.facts.patterns),
        theorems=("patterns", "realizable"),
    ),
)

CONVEX = (
    Claim(
        "convex-inside",
        "section 4.4",
        "Points in general position are convex iff none is inside a tetrahedron of four others.",
        lambda _: _hull_clauses_are_all(),
        recomputed="clauses of kernel/orientations.py: no circuit with one point on one side",
    ),
    Claim(
        "convex-reasonable",
        "section 4.4",
        "Convex position is a reasonable condition where valid hexahedra are wanted.",
        lambda case: case.yes("valid") <= case.yes("convex"),
        theorems=("convex", "valid"),
        recomputed="recomputed: eight points that realize 5_A, one inside the hull",
        stronger=Truth(
            "It costs no pattern: all 143 that carry a valid hexahedron are realizable in convex "
            "position. A single valid hexahedron may still have a vertex inside the hull.",
            lambda case: _no_pattern_is_lost(case) and _a_valid_hexahedron_is_not_convex(case),
        ),
    ),
    Claim(
        "convex-13",
        "section 4.4",
        "13 of the 171 have no realization in convex position.",
        lambda case: len(case.not_convex) == 13,
        theorems=("convex",),
        answers=_answers(UNDERLINED, "convex"),
        stronger=Truth(
            "They have none even with all vertices on the boundary of the hull.",
            lambda case: len(case.not_convex) == 13 and _hull_clauses_are_all(),
        ),
    ),
    Claim(
        "convex-names",
        "section 4.4; Table 2",
        "The twelve names listed and 15_G are those underlined in the big table.",
        lambda _: (
            {*paper.NO_UNIFORM_MATROID, paper.NEEDS_FINAL_POLYNOMIAL} == paper.UNDERLINED
            and len(paper.NO_UNIFORM_MATROID) == 12
        ),
        recomputed="recomputed: names in the text against names in Table 2",
    ),
    Claim(
        "convex-therefore",
        "section 4.4",
        "The twelve listed are not realizable.",
        lambda case: case.no("realizable").issuperset(paper.NO_UNIFORM_MATROID),
        answers=_answers(paper.NO_UNIFORM_MATROID, "realizable", "convex"),
        correction=Truth(
            "All twelve are realizable, as the big table says; not in convex position.",
            lambda case: case.not_convex.issuperset(paper.NO_UNIFORM_MATROID),
        ),
    ),
    Claim(
        "convex-no-matroid",
        "section 4.4",
        "Of the 13 all but 15_G admit no uniform oriented matroid in convex position.",
        _only_15_g_has_sign_vectors,
        theorems=("convex",),
        recomputed="recomputed: sign vectors, by failed literals (certify/audit/matroids.py)",
    ),
    Claim(
        "convex-15-g",
        "section 4.4",
        "15_G admits an oriented matroid, which a final polynomial shows to be not realizable.",
        lambda case: (
            _only_15_g_has_sign_vectors(case)
            and case.answer(paper.NEEDS_FINAL_POLYNOMIAL, "convex") == "no"
        ),
        theorems=("convex",),
        answers=("15_G convex",),
        recomputed="recomputed: sign vectors, by failed literals (certify/audit/matroids.py)",
        stronger=Truth(
            "It admits exactly one.",
            lambda case: sorted(str(n) for n in _sign_vectors(case).values()) == ["0"] * 12 + ["1"],
        ),
    ),
)

CAPTIONS = (
    Claim(
        "figure-convex-15s",
        "caption of Figure 13",
        "Four triangulations with 15 tetrahedra are realizable in convex position.",
        lambda case: case.of_size(case.yes("convex"), 15) == set(CONVEX_FIFTEENS),
        theorems=("convex",),
        answers=_answers(CONVEX_FIFTEENS, "convex"),
    ),
    Claim(
        "figure-valid-15s",
        "caption of Figure 13",
        "The hexahedra of these four are valid: their Jacobian is strictly positive.",
        lambda case: case.yes("valid").issuperset(CONVEX_FIFTEENS),
        answers=_answers(CONVEX_FIFTEENS, "valid"),
        recomputed="recomputed: isomorphism of 15_D and 15_K as simplicial complexes",
        correction=Truth(
            "Three of them: 15_C, 15_D, 15_E. 15_K, the only one with boundary g, carries no valid "
            "hexahedron; it is the ball of 15_D with other facets.",
            lambda case: (
                case.yes("valid") & set(CONVEX_FIFTEENS) == {"15_C", "15_D", "15_E"}
                and "15_K" in case.no("valid")
                and [n for n in CONVEX_FIFTEENS if case.facts.patterns[n].boundary == "g"]
                == ["15_K"]
                and _is_one_ball(case, "15_D", "15_K")
            ),
        ),
    ),
    Claim(
        "figure-all-15s",
        "caption of Figure 14",
        "Of the 11 with 15 tetrahedra 3 are not realizable, and 4 not in convex position.",
        lambda case: (
            [
                len(case.of_size(names, 15))
                for names in (set(case.facts.patterns), case.no("realizable"), case.not_convex)
            ]
            == [11, 3, 4]
        ),
        theorems=("sizes", "realizable", "convex"),
    ),
)


def _has_answers(name: str, wanted: dict[str, str], case: Case) -> bool:
    return all(case.answer(name, question) == answer for question, answer in wanted.items())


def _of_one_fifteen(name: str) -> Claim:
    """Return what the paper says of one pattern with 15 tetrahedra."""
    place = "Table 2; caption of Figure 14"
    answers = _answers((name,), "realizable", "convex", "valid")
    key = "pattern-" + name.replace("_", "-").lower()
    if name in BOLD:
        return Claim(
            key,
            place,
            f"{name} has no realization.",
            partial(_has_answers, name, {"realizable": "no"}),
            answers=answers,
            stronger=Truth(
                "In no position of the points, coplanar ones included.",
                partial(_has_answers, name, {"realizable": "no", "convex": "no", "valid": "no"}),
            ),
        )
    if name in UNDERLINED:
        return Claim(
            key,
            place,
            f"{name} is realizable, but not in convex position.",
            partial(_has_answers, name, {"realizable": "yes", "convex": "no"}),
            answers=answers,
            stronger=Truth(
                "Not even with all vertices on the boundary of the hull; it carries no valid "
                "hexahedron.",
                partial(_has_answers, name, {"realizable": "yes", "convex": "no", "valid": "no"}),
            ),
        )
    return Claim(
        key,
        "Table 2; caption of Figure 13",
        f"{name} is realizable in convex position by a hexahedron with strictly positive Jacobian.",
        partial(_has_answers, name, {"realizable": "yes", "convex": "yes", "valid": "yes"}),
        answers=answers,
        correction=Truth(
            "It is realizable in convex position, but carries no valid hexahedron.",
            partial(_has_answers, name, {"realizable": "yes", "convex": "yes", "valid": "no"}),
        ),
    )


ONE_BY_ONE = tuple(map(_of_one_fifteen, FIFTEENS))
