"""The abstract, the introduction, and Table 1."""

from certify import paper
from certify.audit.claims import Claim, Truth
from certify.audit.examples import (
    PINCHED,
    has_positive_jacobian,
    jacobian_vanishes_at_a_corner_only,
)


def _names_per_size() -> list[int]:
    """Return how many names the big table prints with 5, 6, ..., 15 tetrahedra."""
    return [sum(paper.size(name) == size for name in paper.LETTERS) for size in range(5, 16)]


ABSTRACT = (
    Claim(
        "abstract-174",
        "abstract; section 1; section 5",
        "The hexahedron has 174 subdivisions into tetrahedra, up to symmetry.",
        lambda case: len(case.facts.patterns) == 174,
        theorems=("patterns",),
    ),
    Claim(
        "abstract-cube",
        "abstract",
        "The cube has one subdivision into 5 tetrahedra and five into 6.",
        lambda case: case.facts.row(case.cube) == [1, 5, *[0] * 9],
        theorems=("cube",),
    ),
    Claim(
        "abstract-more-than-the-cube",
        "abstract",
        "Other positions of the vertices admit subdivisions that the cube does not.",
        lambda case: bool(case.yes("realizable") - case.cube),
        theorems=("cube", "realizable"),
    ),
    Claim(
        "abstract-ten",
        "abstract; section 1",
        "The subdivisions known before are ten of the 174.",
        lambda case: len(case.cube | case.slivers) == 10,
        theorems=("ten",),
    ),
    Claim(
        "abstract-sizes",
        "abstract; section 1",
        "The least number of tetrahedra is 5 and the greatest 15.",
        lambda case: {v.size for v in case.facts.patterns.values()} == set(range(5, 16)),
        theorems=("sizes",),
    ),
    Claim(
        "abstract-instances",
        "abstract",
        "A class has between 2 and 48 instances.",
        lambda case: (case.instances[0], case.instances[-1]) == (2, 48),
        theorems=("instances",),
    ),
    Claim(
        "abstract-171",
        "abstract; section 1; section 5",
        "Exactly 171 of the subdivisions have a geometrical realization.",
        lambda case: len(case.yes("realizable")) == 171 and len(case.no("realizable")) == 3,
        theorems=("realizable",),
    ),
    Claim(
        "abstract-15-jacobian",
        "abstract",
        "There are hexahedra with strictly positive Jacobian subdivided into 15 tetrahedra.",
        lambda case: bool(case.of_size(case.yes("valid"), 15)),
        answers=("15_C valid", "15_D valid", "15_E valid"),
    ),
)

INTRODUCTION = (
    Claim(
        "introduction-valid",
        "section 1; section 5",
        "A hexahedron is valid as long as its trilinear map is injective; later, if the Jacobian "
        "is strictly positive.",
        lambda _: has_positive_jacobian(PINCHED) or not jacobian_vanishes_at_a_corner_only(PINCHED),
        recomputed="recomputed: Jacobian of the unit cube with vertex 7 at (2/3, 2/3, 2/3)",
        correction=Truth(
            "These are two notions: the unit cube with vertex 7 at (2/3, 2/3, 2/3) has an "
            "injective map whose Jacobian vanishes at a corner. All answers here are about the "
            "Jacobian.",
            lambda _: (
                jacobian_vanishes_at_a_corner_only(PINCHED) and not has_positive_jacobian(PINCHED)
            ),
        ),
    ),
    Claim(
        "introduction-instances",
        "section 1",
        "A class has 2, 4, 8, 12, 16, 24 or 48 instances.",
        lambda case: set(case.instances) == set(paper.INSTANCES),
        theorems=("instances",),
        stronger=Truth(
            "Each of these numbers occurs, and there are 6966 instances in all.",
            lambda case: sum(case.instances) == 6966,
        ),
    ),
    Claim(
        "introduction-beyond-13",
        "section 1; section 5",
        "There are realizable subdivisions with 14 and with 15 tetrahedra, against the belief that "
        "13 is the most.",
        lambda case: all(case.of_size(case.yes("realizable"), size) for size in (14, 15)),
        theorems=("realizable-sizes", "valid"),
        stronger=Truth(
            "Twelve with 14 and three with 15 even carry hexahedra with positive Jacobian.",
            lambda case: [len(case.of_size(case.yes("valid"), n)) for n in (14, 15)] == [12, 3],
        ),
    ),
)

TABLE_1 = (
    Claim(
        "table-1-combinatorial",
        "Table 1",
        "The row of the combinatorial triangulations is 1, 5, 5, 7, 13, 20, 35, 30, 28, 19, 11.",
        lambda case: (
            tuple(case.facts.row(set(case.facts.patterns))) == paper.TABLE_1["combinatorial"][0]
        ),
        theorems=("sizes",),
    ),
    Claim(
        "table-1-geometrical",
        "Table 1",
        "The row of the geometrical triangulations differs from it only with 15 tetrahedra: 8.",
        lambda case: (
            tuple(case.facts.row(case.yes("realizable"))) == paper.TABLE_1["geometrical"][0]
        ),
        theorems=("realizable-sizes",),
    ),
    Claim(
        "table-1-sums",
        "Table 1",
        "The rows sum to 174 and 171.",
        lambda _: (
            [(sum(row), total) for row, total in paper.TABLE_1.values()] == [(174, 174), (171, 171)]
        ),
        recomputed="recomputed: sums of Table 1",
    ),
    Claim(
        "table-1-names",
        "Table 1; Table 2",
        "Table 2 has as many names in each column as Table 1 counts; without those in bold, as "
        "many as Table 1 counts as geometrical.",
        lambda _: (
            tuple(_names_per_size()) == paper.TABLE_1["combinatorial"][0]
            and [a - b for a, b in zip(*(row for row, _ in paper.TABLE_1.values()), strict=True)]
            == [sum(paper.size(name) == size for name in paper.BOLD) for size in range(5, 16)]
        ),
        recomputed="recomputed: names of Table 2 against the rows of Table 1",
    ),
)
