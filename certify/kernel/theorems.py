"""The theorems that the accepted certificates prove together.

Each statement is fixed, and is shown or not by what was accepted in this run: a theorem about all
patterns needs all 174 certificates, and one that says "exactly" needs the seven completeness
proofs too.
"""

from collections import Counter
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import TypeAlias

from certify.kernel.certificate import PATTERN_COUNTS, PATTERN_NAMES
from certify.kernel.check import Completeness, Verdict
from certify.kernel.cube import (
    TETRAHEDRON_TYPES,
    triangulates_cube,
    triangulates_finite_precision_cube,
)
from certify.kernel.hexahedron import BOUNDARIES, boundary_letter
from certify.kernel.triangulation import orientation


@dataclass(frozen=True)
class Theorem:
    """A statement, the files it rests on, and whether this run proves it."""

    id: str
    statement: str
    rests_on: tuple[str, ...]
    ok: bool


class Facts:
    """What the verdicts of one run establish. Sizes are numbers of tetrahedra."""

    def __init__(self, verdicts: Sequence[Verdict], completeness: Sequence[Completeness]) -> None:
        self.patterns = {v.pattern: v for v in verdicts if v.fault is None}
        classes = {min(verdict.instances) for verdict in self.patterns.values()}
        self.distinct = len(classes) == len(self.patterns)
        # Each of the 64 boundaries has one of the types whose list is proved complete.
        proved = {c.boundary for c in completeness if c.fault is None}
        self.complete = (
            self.patterns.keys() == set(PATTERN_NAMES)
            and self.distinct
            and proved.issuperset(map(boundary_letter, BOUNDARIES))
        )

    def answering(self, question: str, answer: str) -> set[str]:
        """Return the names of the patterns for which the answer to the question was accepted."""
        return {name for name, v in self.patterns.items() if v.answers[question] == answer}

    def where(self, test: Callable[[dict[tuple[int, ...], int]], bool]) -> set[str]:
        """Return the names of the patterns whose oriented tetrahedra pass the test."""
        return {n for n, v in self.patterns.items() if test(orientation(min(v.instances)))}

    def row(self, names: set[str]) -> list[int]:
        """Return how many of the patterns have 5, 6, ..., 15 tetrahedra."""
        sizes = Counter(self.patterns[name].size for name in names)
        return [sizes[size] for size in PATTERN_COUNTS]

    def instances(self, names: set[str]) -> list[int]:
        """Return the sizes of the patterns' classes, in increasing order."""
        return sorted(len(self.patterns[name].instances) for name in names)

    def decides(self, *questions: str) -> bool:
        """Is the list complete, and are the questions answered for every pattern?"""
        return self.complete and not any(self.answering(q, "open") for q in questions)


def theorems(verdicts: Sequence[Verdict], completeness: Sequence[Completeness]) -> list[Theorem]:
    """Return every theorem, each with whether these verdicts prove it."""
    facts = Facts(verdicts, completeness)
    everything = ("certificates/*.json", "proofs/*.lrat")
    return [
        *(Theorem(name, text, (), ok) for name, text, ok in _of_the_template()),
        *(
            Theorem(name, text, everything, facts.complete and ok)
            for name, text, ok in (*_of_the_list(facts), *_of_the_cube(facts), *_of_space(facts))
        ),
    ]


Shown: TypeAlias = tuple[str, str, bool]
"""Id, statement, and whether it is true of the facts."""


def _of_the_template() -> list[Shown]:
    letters = Counter(map(boundary_letter, BOUNDARIES))
    types = Counter(TETRAHEDRON_TYPES.values())
    return [
        (
            "boundaries",
            "The boundary of the hexahedron has 64 triangulations in 7 classes a..g "
            "of 2, 12, 4, 24, 4, 6, 12.",
            letters == dict(zip("abcdefg", (2, 12, 4, 24, 4, 6, 12), strict=True)),
        ),
        (
            "tetrahedra",
            "Four vertices of the unit cube are one of 8 corner, 24 staircase, 24 slanted and 2 "
            "core tetrahedra, or coplanar: 6 core diagonal, 6 boundary.",
            types
            == {
                "corner": 8,
                "staircase": 24,
                "slanted": 24,
                "core": 2,
                "core diagonal": 6,
                "boundary": 6,
            },
        ),
    ]


def _of_the_list(facts: Facts) -> list[Shown]:
    names = set(facts.patterns)
    letters = Counter(verdict.boundary for verdict in facts.patterns.values())
    instances = facts.instances(names)
    return [
        (
            "patterns",
            "The hexahedron has exactly 174 triangulations, without boundary tetrahedra, "
            "up to its 48 symmetries.",
            len(names) == 174,
        ),
        (
            "sizes",
            "1, 5, 5, 7, 13, 20, 35, 30, 28, 19, 11 of them have 5, 6, ..., 15 tetrahedra.",
            facts.row(names) == [1, 5, 5, 7, 13, 20, 35, 30, 28, 19, 11],
        ),
        (
            "letters",
            "2, 7, 14, 47, 19, 21, 64 of them have the boundary type a, b, ..., g.",
            letters == dict(zip("abcdefg", (2, 7, 14, 47, 19, 21, 64), strict=True)),
        ),
        (
            "instances",
            "Each is a class of 2, 4, 8, 12, 16, 24 or 48 instances, and all these occur; "
            "there are 6966 labelled triangulations.",
            set(instances) == {2, 4, 8, 12, 16, 24, 48} and sum(instances) == 6966,
        ),
    ]


def _of_the_cube(facts: Facts) -> list[Shown]:
    cube = facts.where(triangulates_cube)
    slivers = facts.where(triangulates_finite_precision_cube)
    small = {name for name, verdict in facts.patterns.items() if verdict.size <= 7}
    return [
        (
            "cube",
            "The unit cube has exactly 74 triangulations in 6 classes of 2, 4, 8, 12, 24, 24: "
            "one of 5 tetrahedra, five of 6.",
            facts.instances(cube) == [2, 4, 8, 12, 24, 24]
            and facts.row(cube) == [1, 5, 0, 0, 0, 0, 0, 0, 0, 0, 0],
        ),
        (
            "finite-precision-cube",
            "Slivers on core diagonals give the cube exactly four further patterns, of 7 "
            "tetrahedra: 7_B, 7_C, 7_D, 7_E.",
            slivers == {"7_B", "7_C", "7_D", "7_E"},
        ),
        (
            "ten",
            "The cube, exact and with slivers, has ten patterns; the only other one with at most "
            "7 tetrahedra is 7_A.",
            len(cube | slivers) == 10 and small - cube - slivers == {"7_A"},
        ),
    ]


def _of_space(facts: Facts) -> list[Shown]:
    realizable, unrealizable = (facts.answering("realizable", a) for a in ("yes", "no"))
    convex, nonconvex = (facts.answering("convex", a) for a in ("yes", "no"))
    valid, invalid = (facts.answering("valid", a) for a in ("yes", "no"))
    row = facts.row
    return [
        (
            "realizable",
            "Exactly 171 are realizable; 15_A, 15_B, 15_J are not, in any position of the points.",
            facts.decides("realizable") and unrealizable == {"15_A", "15_B", "15_J"},
        ),
        (
            "realizable-sizes",
            "1, 5, 5, 7, 13, 20, 35, 30, 28, 19, 8 of the realizable ones have 5, 6, ..., 15 "
            "tetrahedra.",
            facts.decides("realizable")
            and row(realizable) == [1, 5, 5, 7, 13, 20, 35, 30, 28, 19, 8],
        ),
        (
            "convex",
            "Exactly 158 are realizable in convex position; of the others 13 are realizable, "
            "but not even with all vertices on the boundary of their hull.",
            facts.decides("realizable", "convex")
            and len(convex) == 158
            and len(nonconvex & realizable) == 13,
        ),
        (
            "valid",
            "Exactly 143 carry a valid hexahedron, one with positive Jacobian on the closed cube.",
            facts.decides("valid") and len(valid) == 143,
        ),
        (
            "not-valid",
            "Of the 31 that carry none, 3 are not realizable, 13 not in convex position, and 15 "
            "are realizable in convex position.",
            facts.decides("realizable", "convex", "valid")
            and [len(invalid & names) for names in (unrealizable, nonconvex & realizable, convex)]
            == [3, 13, 15],
        ),
        (
            "valid-sizes",
            "The smallest patterns that carry no valid hexahedron are 11_AD and 11_AE; the largest "
            "that carry one are 15_C, 15_D, 15_E.",
            facts.decides("valid")
            and {n for n in invalid if facts.patterns[n].size <= 11} == {"11_AD", "11_AE"}
            and {n for n in valid if facts.patterns[n].size == 15} == {"15_C", "15_D", "15_E"},
        ),
    ]
