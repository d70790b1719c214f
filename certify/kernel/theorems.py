"""The one entry, :func:`check_all`: a root -> verdicts -> the theorems that they prove together.

Each statement is fixed, and is shown or not by what was accepted in this run: a theorem about all
patterns needs all 174 certificates and the seven proofs of completeness.
"""

import platform
from collections import Counter
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from functools import cached_property, partial
from pathlib import Path
from typing import NamedTuple, TypeAlias

import sympy

from certify.kernel.certificate import PATTERN_COUNTS, PATTERN_NAMES
from certify.kernel.check import Completeness, Verdict, check_completeness, check_pattern
from certify.kernel.cube import (
    TETRAHEDRON_TYPES,
    triangulates_cube,
    triangulates_finite_precision_cube,
)
from certify.kernel.evidence import (
    certificate_file,
    completeness_file,
    digest,
    kernel_digest,
    proof_file,
    strays,
)
from certify.kernel.hexahedron import BOUNDARIES, BOUNDARY_TYPES, Simplex, boundary_letter
from certify.kernel.names import mean_what_the_table_says
from certify.kernel.triangulation import orientation

Apply: TypeAlias = Callable[[Callable[[str], Verdict], Sequence[str]], Iterable[Verdict]]


@dataclass(frozen=True)
class Theorem:
    """A statement, the files it rests on, and whether this run proves it."""

    id: str
    statement: str
    rests_on: tuple[str, ...]
    ok: bool


@dataclass(frozen=True)
class Outcome:
    """What one run found: a verdict on every certificate, and what follows from them together.

    Verdicts on the patterns come first, in their order, then rejections of files that are no
    pattern's. Completeness is empty unless the tetrahedra of every pattern were accepted.
    """

    verdicts: tuple[Verdict, ...]
    completeness: tuple[Completeness, ...]
    theorems: tuple[Theorem, ...]

    @property
    def results(self) -> tuple[Verdict | Completeness, ...]:
        """All verdicts, then all results on completeness."""
        return (*self.verdicts, *self.completeness)

    @property
    def faults(self) -> list[str]:
        """Why something was rejected, in the order of checking."""
        return [result.fault for result in self.results if result.fault is not None]

    @property
    def open(self) -> list[tuple[str, str]]:
        """The questions that certificates leave open, as (pattern, question)."""
        return [(v.pattern, q) for v in self.verdicts for q, a in v.answers.items() if a == "open"]

    @property
    def ok(self) -> bool:
        """Was nothing rejected, and is every theorem shown?"""
        return not self.faults and all(theorem.ok for theorem in self.theorems)

    @property
    def evidence_digest(self) -> str:
        """One SHA-256 for all files that were read (see :func:`certify.kernel.evidence.digest`)."""
        return digest({f: sha for result in self.results for f, sha in result.files.items()})

    @property
    def about(self) -> dict[str, str]:
        """What was run on what: the versions of Python and sympy, the kernel, and the evidence."""
        return {
            "python": platform.python_version(),
            "sympy": sympy.__version__,
            "kernel_sha256": kernel_digest(),
            "evidence_sha256": self.evidence_digest,
        }


def check_all(root: Path, apply: Apply = map) -> Outcome:
    """Check every certificate below ``root``, and return what they prove together.

    apply: how to check many patterns: ``map``, or something that does the same in several
    processes or shows how far it is. Whoever passes another than ``map`` trusts it.
    """
    verdicts = list(apply(partial(check_pattern, root), PATTERN_NAMES))
    completeness = []
    if all(verdict.instances for verdict in verdicts):
        completeness = [check_completeness(root, letter, verdicts) for letter in BOUNDARY_TYPES]
    shown = theorems(verdicts, completeness)
    verdicts += [
        Verdict(place, fault=f"{place}: {fault}")
        for place, fault in strays(root, PATTERN_NAMES).items()
    ]
    return Outcome(tuple(verdicts), tuple(completeness), tuple(shown))


class Facts:
    """What verdicts and completeness establish. Sizes are numbers of tetrahedra."""

    def __init__(self, verdicts: Iterable[Verdict], completeness: Iterable[Completeness]) -> None:
        self.patterns = {v.pattern: v for v in verdicts if v.instances}
        classes = {min(verdict.instances) for verdict in self.patterns.values()}
        known = set[object]().union(*(v.instances for v in self.patterns.values()))
        # All triangulations with a proved boundary are known; each of the 64 boundaries has a type.
        proved = {c.boundary for c in completeness if c.fault is None and c.listed <= known}
        self.complete = (
            self.patterns.keys() == set(PATTERN_NAMES)
            and len(classes) == len(self.patterns)
            and proved.issuperset(map(boundary_letter, BOUNDARIES))
        )

    def answering(self, question: str, answer: str) -> set[str]:
        """Return the names of the patterns for which the answer to the question was accepted."""
        return {name for name, v in self.patterns.items() if v.answers[question] == answer}

    def decides(self, question: str) -> bool:
        """Is the question answered by yes or no for every pattern?"""
        answered = self.answering(question, "yes") | self.answering(question, "no")
        return answered == self.patterns.keys()

    def row(self, names: set[str]) -> list[int]:
        """Return how many of the patterns have 5, 6, ..., 15 tetrahedra."""
        sizes = Counter(self.patterns[name].size for name in names)
        return [sizes[size] for size in PATTERN_COUNTS]

    def instances(self, names: Iterable[str]) -> list[int]:
        """Return the sizes of the patterns' classes, in increasing order."""
        return sorted(len(self.patterns[name].instances) for name in names)

    @cached_property
    def oriented(self) -> dict[str, dict[Simplex, int]]:
        """Pattern -> the signs of its tetrahedra."""
        return {name: orientation(min(v.instances)) for name, v in self.patterns.items()}

    @cached_property
    def cube(self) -> set[str]:
        """The patterns that the vertices of the unit cube realize."""
        return {name for name, signs in self.oriented.items() if triangulates_cube(signs)}

    @cached_property
    def slivers(self) -> set[str]:
        """The patterns of the unit cube with slivers on core diagonals, and only with them."""
        return {
            n for n, signs in self.oriented.items() if triangulates_finite_precision_cube(signs)
        }

    @property
    def not_realizable(self) -> set[str]:
        """The patterns that are not realizable."""
        return self.answering("realizable", "no")

    @property
    def not_convex(self) -> set[str]:
        """The patterns that are realizable, but not in convex position."""
        return self.answering("realizable", "yes") & self.answering("convex", "no")

    def of_size(self, names: set[str], *sizes: int) -> set[str]:
        """Return those of the patterns that have so many tetrahedra."""
        return {name for name in names if self.patterns[name].size in sizes}


class _Statement(NamedTuple):
    id: str
    questions: tuple[str, ...] | None
    """The questions it is about; None if it is about the template alone, not about patterns."""
    statement: str
    holds: Callable[[Facts], bool]


_STATEMENTS = (
    _Statement(
        "boundaries",
        None,
        "The boundary of the hexahedron has 64 triangulations. Up to symmetry there are 7, "
        "called a to g, which stand for 2, 12, 4, 24, 4, 6 and 12 of them.",
        lambda _: (
            Counter(map(boundary_letter, BOUNDARIES))
            == {"a": 2, "b": 12, "c": 4, "d": 24, "e": 4, "f": 6, "g": 12}
        ),
    ),
    _Statement(
        "tetrahedra",
        None,
        "Four vertices of the unit cube span one of 8 corner, 24 staircase, 24 slanted and 2 core "
        "tetrahedra, or are coplanar: 6 core diagonal, 6 boundary.",
        lambda _: (
            Counter(TETRAHEDRON_TYPES.values())
            == {
                "corner": 8,
                "staircase": 24,
                "slanted": 24,
                "core": 2,
                "core diagonal": 6,
                "boundary": 6,
            }
        ),
    ),
    _Statement(
        "patterns",
        (),
        "The hexahedron has exactly 174 triangulations without boundary tetrahedra, up to its 48 "
        "symmetries.",
        lambda facts: len(facts.patterns) == 174,
    ),
    _Statement(
        "sizes",
        (),
        "Of the 174 triangulations, 1, 5, 5, 7, 13, 20, 35, 30, 28, 19 and 11 have 5, 6, ..., 15 "
        "tetrahedra.",
        lambda facts: facts.row(set(facts.patterns)) == [1, 5, 5, 7, 13, 20, 35, 30, 28, 19, 11],
    ),
    _Statement(
        "letters",
        (),
        "Of the 174 triangulations, 2, 7, 14, 47, 19, 21 and 64 have a boundary of type a, b, ..., "
        "g.",
        lambda facts: (
            Counter(verdict.boundary for verdict in facts.patterns.values())
            == {"a": 2, "b": 7, "c": 14, "d": 47, "e": 19, "f": 21, "g": 64}
        ),
    ),
    _Statement(
        "instances",
        (),
        "Each of the 174 triangulations stands for 2, 4, 8, 12, 16, 24 or 48 labelled ones, its "
        "instances, and all these numbers occur; there are 6966 labelled triangulations.",
        lambda facts: (
            set(facts.instances(facts.patterns)) == {2, 4, 8, 12, 16, 24, 48}
            and sum(facts.instances(facts.patterns)) == 6966
        ),
    ),
    _Statement(
        "cube",
        (),
        "The unit cube has exactly 74 triangulations, in 6 classes of 2, 4, 8, 12, 24 and 24: one "
        "class with 5 tetrahedra, five with 6.",
        lambda facts: (
            facts.instances(facts.cube) == [2, 4, 8, 12, 24, 24]
            and facts.row(facts.cube) == [1, 5, 0, 0, 0, 0, 0, 0, 0, 0, 0]
        ),
    ),
    _Statement(
        "finite-precision-cube",
        (),
        "Exactly four of the 174 triangulations fill the unit cube only if flat tetrahedra on core "
        "diagonals are allowed: 7_B, 7_C, 7_D and 7_E, with 7 tetrahedra.",
        lambda facts: facts.slivers == {"7_B", "7_C", "7_D", "7_E"},
    ),
    _Statement(
        "ten",
        (),
        "The unit cube realizes ten of the 174 triangulations, flat tetrahedra allowed; the only "
        "other one with at most 7 tetrahedra is 7_A.",
        lambda facts: (
            len(facts.cube | facts.slivers) == 10
            and facts.of_size(set(facts.patterns), 5, 6, 7) - facts.cube - facts.slivers == {"7_A"}
        ),
    ),
    _Statement(
        "realizable",
        ("realizable",),
        "Exactly 171 of the 174 triangulations are realizable; 15_A, 15_B and 15_J are not, "
        "wherever the points lie.",
        lambda facts: facts.not_realizable == {"15_A", "15_B", "15_J"},
    ),
    _Statement(
        "realizable-sizes",
        ("realizable",),
        "Of the 171 realizable triangulations, 1, 5, 5, 7, 13, 20, 35, 30, 28, 19 and 8 have 5, 6, "
        "..., 15 tetrahedra.",
        lambda facts: (
            facts.row(facts.answering("realizable", "yes"))
            == [1, 5, 5, 7, 13, 20, 35, 30, 28, 19, 8]
        ),
    ),
    _Statement(
        "convex",
        ("realizable", "convex"),
        "Exactly 158 of the 174 triangulations are realizable in convex position; 13 more are "
        "realizable, but only with a vertex in the interior of the hull.",
        lambda facts: len(facts.answering("convex", "yes")) == 158 and len(facts.not_convex) == 13,
    ),
    _Statement(
        "names",
        ("realizable", "convex"),
        "Every pattern has the size, the letter and the status of its name in the paper's big "
        "table, but for the letters of 13_S, 13_T, 13_W and 13_X, which are c, d, g and f; and no "
        "two patterns of a cell can exchange their names.",
        lambda facts: mean_what_the_table_says(facts.patterns),
    ),
    _Statement(
        "valid",
        ("valid",),
        "Exactly 143 of the 174 triangulations carry a valid hexahedron, one whose Jacobian is "
        "positive on the closed cube.",
        lambda facts: len(facts.answering("valid", "yes")) == 143,
    ),
    _Statement(
        "not-valid",
        ("realizable", "convex", "valid"),
        "Of the 31 triangulations that carry no valid hexahedron, 3 are not realizable, 13 are "
        "realizable but not in convex position, and 15 are realizable in convex position.",
        lambda facts: (
            [
                len(facts.answering("valid", "no") & names)
                for names in (
                    facts.not_realizable,
                    facts.not_convex,
                    facts.answering("convex", "yes"),
                )
            ]
            == [3, 13, 15]
        ),
    ),
    _Statement(
        "valid-sizes",
        ("valid",),
        "The smallest triangulations that carry no valid hexahedron are 11_AD and 11_AE; the "
        "largest that carry one are 15_C, 15_D and 15_E.",
        lambda facts: (
            facts.of_size(facts.answering("valid", "no"), *range(12)) == {"11_AD", "11_AE"}
            and facts.of_size(facts.answering("valid", "yes"), 15) == {"15_C", "15_D", "15_E"}
        ),
    ),
)


def theorems(verdicts: Sequence[Verdict], completeness: Iterable[Completeness]) -> list[Theorem]:
    """Return every theorem, each with whether these results prove it.

    A proof of completeness counts only for verdicts that have accepted all it lists.
    """
    facts = Facts(verdicts, completeness)
    everything = [*map(certificate_file, PATTERN_NAMES), *map(completeness_file, BOUNDARY_TYPES)]
    found = []
    for name, questions, statement, holds in _STATEMENTS:
        if questions is None:
            found.append(Theorem(name, statement, (), holds(facts)))
            continue
        refutations = [
            proof_file(pattern, question)
            for question in questions
            for pattern in sorted(facts.answering(question, "no"))
        ]
        ok = facts.complete and all(map(facts.decides, questions)) and holds(facts)
        found.append(Theorem(name, statement, (*everything, *refutations), ok))
    return found
