"""Section 5: the discussion, and what Tables 3 and 4 say of meshes, as far as arithmetic goes."""

from collections.abc import Sequence

from certify import paper
from certify.audit.claims import Case, Claim, Truth

Row = tuple[tuple[int, ...], int]
"""Entries for 5, 6, ..., 15 tetrahedra, and the printed total."""

ALL_UP_TO_9 = (1, 5, 5, 7, 13)


def _meshes() -> list[Row]:
    """Return the rows of Table 3."""
    return [(row, total) for _, _, row, total in paper.MESHES]


def _random_points() -> list[Row]:
    """Return the rows of Table 4."""
    return [(row, total) for _, row, total in paper.RANDOM_POINTS]


def _sums_are_right(rows: Sequence[Row]) -> bool:
    return all(sum(row) == total for row, total in rows)


def _up_to(case: Case, size: int) -> set[str]:
    return {name for name, verdict in case.facts.patterns.items() if verdict.size <= size}


def _fit_below(rows: Sequence[Row], most: Sequence[int]) -> bool:
    """Does no entry exceed what there is of that size?"""
    return all(a <= b for row, _ in rows for a, b in zip(row, most, strict=True))


def _only_first_sum_is_wrong() -> bool:
    """Is it only the row of 3,000 points, and would 5 for its 2 mend it?"""
    (points, row, total), *others = paper.RANDOM_POINTS
    mended = (*row[:2], 5, *row[3:])
    return (
        (points, sum(row), total, row[2]) == (3_000, 48, 51, 2)
        and sum(mended) == total
        and all(sum(other) == printed for _, other, printed in others)
    )


def _fewer_than_random() -> bool:
    """Has each mesh fewer patterns than the largest set of random points that is not larger?

    The one mesh smaller than all sets is compared with the smallest set.
    """
    for _, vertices, row, _ in paper.MESHES:
        smaller = [other for points, other, _ in paper.RANDOM_POINTS if points <= vertices]
        if sum(row) >= sum(smaller[-1] if smaller else paper.RANDOM_POINTS[0][1]):
            return False
    return True


def _totals(least: int, most: int | None = None) -> list[int]:
    """Return the totals of the meshes with that many vertices or more, and at most so many."""
    return sorted(
        total
        for _, vertices, _, total in paper.MESHES
        if vertices >= least and (most is None or vertices <= most)
    )


DISCUSSION = (
    Claim(
        "discussion-consistent",
        "section 5",
        "The triangulations of the cube known from the literature, 74 in six classes, are among "
        "the 174.",
        lambda case: sum(case.facts.instances(case.cube)) == 74 and len(case.cube) == 6,
        theorems=("cube",),
    ),
    Claim(
        "discussion-theorem-4",
        "section 5",
        "It is wrong that there are only 10 triangulations with 5, 6 or 7 tetrahedra.",
        lambda case: len(_up_to(case, 7)) > 10,
        theorems=("ten", "sizes"),
        answers=("7_A realizable", "7_A valid"),
        stronger=Truth(
            "There are eleven. The one that was missed is 7_A; it carries a valid hexahedron.",
            lambda case: (
                len(_up_to(case, 7)) == 11
                and _up_to(case, 7) - (case.cube | case.slivers) == {"7_A"}
                and case.answer("7_A", "valid") == "yes"
            ),
        ),
    ),
    Claim(
        "discussion-161",
        "section 5",
        "161 geometrical triangulations are new.",
        lambda case: (
            (case.cube | case.slivers) <= case.yes("realizable")
            and len(case.yes("realizable") - (case.cube | case.slivers)) == 161
        ),
        theorems=("ten", "realizable"),
    ),
    Claim(
        "discussion-smallest",
        "section 5",
        "The smallest triangulations without a valid hexahedron have 12 tetrahedra.",
        lambda case: min(paper.size(name) for name in case.no("valid")) == 12,
        theorems=("valid-sizes",),
        answers=("11_AD valid", "11_AE valid"),
        correction=Truth(
            "They have 11 tetrahedra: 11_AD and 11_AE, which are realizable in convex position.",
            lambda case: (
                {name for name in case.no("valid") if paper.size(name) <= 11} == {"11_AD", "11_AE"}
                and {"11_AD", "11_AE"} <= case.yes("convex")
            ),
        ),
    ),
    Claim(
        "discussion-largest",
        "section 5",
        "The largest triangulations with a valid hexahedron have 15 tetrahedra.",
        lambda case: max(paper.size(name) for name in case.yes("valid")) == 15,
        theorems=("valid-sizes",),
        answers=("15_C valid", "15_D valid", "15_E valid"),
        stronger=Truth(
            "Exactly three with 15 tetrahedra carry one: 15_C, 15_D, 15_E.",
            lambda case: (
                case.of_size(case.yes("valid"), 15) == {"15_C", "15_D", "15_E"}
                and len(case.of_size(case.no("valid"), 15)) == 8
            ),
        ),
    ),
    Claim(
        "discussion-missed",
        "section 5",
        "Methods that look for the ten known patterns miss hexahedra; dozens more have to be "
        "looked for.",
        lambda case: len(case.yes("valid") - (case.cube | case.slivers)) >= 24,
        theorems=("ten", "valid"),
        stronger=Truth(
            "133 more carry valid hexahedra; the ten all do.",
            lambda case: (
                len(case.yes("valid") - (case.cube | case.slivers)) == 133
                and (case.cube | case.slivers) <= case.yes("valid")
            ),
        ),
    ),
)

MESH_TABLES = (
    Claim(
        "table-3-totals",
        "Table 3",
        "The rows sum to the printed totals.",
        lambda _: _sums_are_right(_meshes()),
        recomputed="recomputed: rows of Table 3",
    ),
    Claim(
        "table-4-totals",
        "Table 4",
        "The rows sum to the printed totals.",
        lambda _: _sums_are_right(_random_points()),
        recomputed="recomputed: rows of Table 4",
        correction=Truth(
            "The row of 3,000 points sums to 48, and 51 is printed. With 5 in place of 2 patterns "
            "of seven tetrahedra it would be right.",
            lambda _: _only_first_sum_is_wrong(),
        ),
    ),
    Claim(
        "tables-3-4-possible",
        "Table 3; Table 4",
        "The numbers of patterns found are possible.",
        lambda case: _fit_below(
            _meshes() + _random_points(), case.facts.row(case.yes("realizable"))
        ),
        theorems=("realizable-sizes", "valid"),
        recomputed="recomputed: entries of Tables 3 and 4 against the rows of Table 1",
        stronger=Truth(
            "No entry even exceeds the number of patterns that carry a valid hexahedron.",
            lambda case: _fit_below(
                _meshes() + _random_points(), case.facts.row(case.yes("valid"))
            ),
        ),
    ),
    Claim(
        "table-3-entries",
        "Table 3",
        "The entries are the numbers of patterns found in twelve meshes.",
        None,
        recomputed="a census of the meshes would decide it",
    ),
    Claim(
        "table-4-entries",
        "Table 4",
        "The entries are the numbers of patterns found in Delaunay triangulations.",
        None,
        recomputed="a census of random points would decide it",
    ),
    Claim(
        "meshes-171",
        "section 5.1",
        "The hexahedra found, which are all valid, are compared with the 171 patterns.",
        lambda case: case.yes("valid") <= case.yes("realizable"),
        theorems=("realizable", "valid"),
        stronger=Truth(
            "Only 143 of them can occur, those that carry a valid hexahedron.",
            lambda case: len(case.yes("valid")) == 143,
        ),
    ),
    Claim(
        "meshes-additional",
        "section 5.1",
        "By Tables 3 and 4, many patterns beyond the ten occur.",
        lambda _: max(total for _, total in _meshes()) - 10 >= 24,
        recomputed="recomputed: totals of Tables 3 and 4, as printed",
        stronger=Truth(
            "By its totals at least 44 in a mesh, and 95 among random points.",
            lambda _: (
                [max(total for _, total in rows) - 10 for rows in (_meshes(), _random_points())]
                == [44, 95]
            ),
        ),
    ),
    Claim(
        "random-up-to-9",
        "section 5.1",
        "By Table 4, all realizable patterns with up to 9 tetrahedra occur among 3,000 points.",
        lambda case: (
            tuple(case.facts.row(case.yes("realizable")))[:5] == _random_points()[0][0][:5]
        ),
        theorems=("realizable-sizes",),
        recomputed="recomputed: rows of Table 4 against Table 1",
        correction=Truth(
            "The row of 3,000 points has 2 of the 5 with seven tetrahedra; only with 5 there, as "
            "its total demands, is it so. From 10,000 points on all occur.",
            lambda case: (
                tuple(case.facts.row(case.yes("realizable")))[:5] == ALL_UP_TO_9
                and _random_points()[0][0][:5] == (1, 5, 2, 7, 13)
                and _only_first_sum_is_wrong()
                and all(row[:5] == ALL_UP_TO_9 for row, _ in _random_points()[1:])
            ),
        ),
    ),
    Claim(
        "meshes-fewer",
        "section 5.1",
        "By Tables 3 and 4, meshes made for hexahedra have fewer patterns than random points.",
        lambda _: _fewer_than_random(),
        recomputed="recomputed: each mesh against the random set of the next lower size",
    ),
    Claim(
        "meshes-independent",
        "section 5.1",
        "By Table 3, the number of patterns hardly depends on the model or the number of vertices.",
        lambda _: _totals(0)[-1] <= 2 * _totals(0)[0],  # within a factor of two
        recomputed="recomputed: totals of Table 3",
        correction=Truth(
            "From 71,947 vertices on it is 26 to 30; the three smaller meshes have 9, 44 and 54.",
            lambda _: (
                _totals(71_947)[:: len(_totals(71_947)) - 1] == [26, 30]
                and _totals(0, 71_946) == [9, 44, 54]
            ),
        ),
    ),
    Claim(
        "meshes-rare",
        "section 5.1",
        "Triangulations with more than 11 tetrahedra occur rarely.",
        None,
        recomputed="Table 3 has none, Table 4 up to 23 patterns; it does not count occurrences",
    ),
    Claim(
        "future-decide",
        "section 5.2",
        "The list decides which triangulations, without boundary tetrahedra, eight points have.",
        lambda case: sum(case.facts.instances(case.cube)) == 74,
        theorems=("patterns", "instances", "cube"),
        recomputed="recomputed: the 74 of the unit cube among the 6966 instances",
    ),
)
