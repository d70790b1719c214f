"""What the pages show, as plain records: all of it from one outcome of the kernel."""

import json
import re
from collections import Counter, defaultdict
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property
from typing import Any

from certify.atlas.draw.space import like_the_cube
from certify.atlas.explain.words import cycles
from certify.audit import Finding
from certify.graphs import boundary, decomposition, edges
from certify.kernel.certificate import QUESTIONS, Certificate, No, Yes
from certify.kernel.check import Verdict
from certify.kernel.chirotope import Point
from certify.kernel.cube import (
    TETRAHEDRON_TYPES,
    triangulates_cube,
    triangulates_finite_precision_cube,
)
from certify.kernel.evidence import certificate_file
from certify.kernel.hexahedron import CORNERS, FACETS, SYMMETRIES, VERTICES, image
from certify.kernel.triangulation import label, orientation
from certify.mesh.quality import jacobian_bounds, scaled_jacobians
from certify.paper import printed_status
from certify.report import coordinates, rational

TYPES = ("corner", "staircase", "slanted", "core", "core diagonal")
"""The types of tetrahedra, as the paper's section 2 names them."""

SENTENCES = {
    ("realizable", "yes"): "Eight points realize it.",
    ("realizable", "no"): "No eight points realize it.",
    ("convex", "yes"): "Eight points in convex position realize it.",
    ("convex", "no"): "No eight points in convex position realize it.",
    ("valid", "yes"): "A hexahedron with positive Jacobian is cut in this way.",
    ("valid", "no"): "No hexahedron with positive Jacobian is cut in this way.",
}


@dataclass(frozen=True)
class Answer:
    """An accepted answer: what it says, the files it rests on, and the points of a yes."""

    question: str
    answer: str
    sentence: str
    files: tuple[str, ...]
    points: tuple[Point, ...]
    polynomials: int

    @property
    def rows(self) -> list[list[int | str]]:
        """The exact coordinates, a row a vertex."""
        return coordinates(self.points)


@dataclass(frozen=True)
class Pattern:
    """All that a page says of one pattern, but for pictures and explanations."""

    verdict: Verdict
    certificate: Certificate
    answers: tuple[Answer, ...]

    @property
    def name(self) -> str:
        """Such as 8_E."""
        return self.verdict.pattern

    @property
    def size(self) -> int:
        """The number of tetrahedra."""
        return len(self.certificate.tetrahedra)

    @property
    def letter(self) -> str:
        """The type of its boundary."""
        return self.verdict.boundary

    @property
    def instances(self) -> int:
        """The number of labelled triangulations in its class."""
        return len(self.verdict.instances)

    @property
    def file(self) -> str:
        """The certificate's, below the root."""
        return certificate_file(self.name)

    @property
    def printed(self) -> str:
        """What the paper's table says of it."""
        return printed_status(self.name)

    def answer(self, question: str) -> str:
        """Return yes, no or open."""
        return self.verdict.answers[question]

    @cached_property
    def by_type(self) -> dict[str, list[str]]:
        """Type -> the tetrahedra of that type, for types that occur."""
        found = defaultdict(list)
        for tetrahedron in self.certificate.tetrahedra:
            found[TETRAHEDRON_TYPES[tetrahedron]].append(label(tetrahedron))
        return {kind: found[kind] for kind in TYPES if found[kind]}

    @cached_property
    def automorphisms(self) -> list[str]:
        """The symmetries of the hexahedron that keep it, but for the identity, as cycles."""
        own = set(self.certificate.tetrahedra)
        kept = [s for s in SYMMETRIES if {image(s, t) for t in own} == own]
        return [cycles(symmetry) for symmetry in kept if symmetry != VERTICES]

    @cached_property
    def degrees(self) -> dict[int, tuple[int, int]]:
        """Vertex -> how many edges, and how many tetrahedra, it has."""
        at = Counter(v for edge in edges(self.certificate.tetrahedra) for v in edge)
        of = Counter(v for tetrahedron in self.certificate.tetrahedra for v in tetrahedron)
        return {vertex: (at[vertex], of[vertex]) for vertex in VERTICES}

    @cached_property
    def inner_edges(self) -> list[str]:
        """The edges that are not on the boundary."""
        tetrahedra = self.certificate.tetrahedra
        return [label(edge) for edge in sorted(edges(tetrahedra) - edges(boundary(tetrahedra)))]

    @cached_property
    def scaled(self) -> list[float]:
        """The scaled Jacobian at the vertices of the valid hexahedron; empty if there is none."""
        return [round(j, 4) for j in scaled_jacobians(self._valid)] if self._valid else []

    @property
    def quality(self) -> float | None:
        """The least of them."""
        return min(self.scaled) if self.scaled else None

    @cached_property
    def jacobian_bound(self) -> str:
        """An exact lower bound of its Jacobian."""
        return str(rational(jacobian_bounds(self._valid)[0])) if self._valid else ""

    @property
    def _valid(self) -> tuple[Point, ...]:
        return next((own.points for own in self.answers if own.question == "valid"), ())

    @cached_property
    def cube(self) -> str:
        """Whether it triangulates the unit cube: yes, with slivers, or no."""
        signs = orientation(self.certificate.tetrahedra)
        if triangulates_cube(signs):
            return "yes"
        return "with slivers" if triangulates_finite_precision_cube(signs) else "no"

    @property
    def scene(self) -> str:
        """What the three-dimensional view needs, as JSON."""
        tetrahedra = self.certificate.tetrahedra
        near: list[list[int]] = [[] for _ in tetrahedra]
        for a, b in decomposition(tetrahedra).plain:
            near[a].append(b)
            near[b].append(a)
        scene = {
            "name": self.name,
            "tetrahedra": tetrahedra,
            "types": [TETRAHEDRON_TYPES[t] for t in tetrahedra],
            "near": [sorted(own) for own in near],
            "facets": FACETS,
            "corners": [*CORNERS.values()],
            "witnesses": [*_witnesses(self.answers)],
        }
        return _for_a_page(scene)


def _witnesses(answers: Sequence[Answer]) -> Iterator[dict[str, Any]]:
    """Yield the points of yeses, each once, as floats: they are looked at, not computed with.

    That is, as they are, and as they look best. The latter come from the former by an affine map,
    which keeps what meets, and multiplies all Jacobians by the same positive number.
    """
    shown: dict[tuple[Point, ...], list[str]] = defaultdict(list)
    for own in answers:
        if own.points:
            shown[own.points].append(own.question)
    for points, questions in shown.items():
        best = like_the_cube(points)
        yield {"questions": questions, "points": _centred(points), "best": _centred(best)}


def _centred(points: Sequence[Sequence[Fraction | float]]) -> list[list[float]]:
    """Return the points about the origin, at most 1 away from it along each axis."""
    middle = [
        sum(map(Fraction, axis), Fraction(0)) / len(points) for axis in zip(*points, strict=True)
    ]
    moved = [[Fraction(x) - m for x, m in zip(point, middle, strict=True)] for point in points]
    largest = max(abs(x) for point in moved for x in point)
    return [[float(f"{float(x / largest):.6g}") for x in point] for point in moved]


def _for_a_page(value: object) -> str:
    """Return JSON that may stand inside a script element."""
    return json.dumps(value, separators=(",", ":")).replace("<", "\\u003c")


def pattern_of(verdict: Verdict) -> Pattern:
    """Return the record of an accepted certificate.

    Raises:
        ValueError: It was not accepted.
    """
    certificate = verdict.certificate
    if verdict.fault is not None or certificate is None:
        raise ValueError(f"{verdict.pattern} was not accepted")
    answers = tuple(_answer(verdict, certificate, question) for question in QUESTIONS)
    return Pattern(verdict, certificate, answers)


def _answer(verdict: Verdict, certificate: Certificate, question: str) -> Answer:
    word, shown = verdict.answers[question], certificate.answers[question]
    return Answer(
        question,
        word,
        SENTENCES.get((question, word), "Nobody has decided this."),
        verdict.rests_on(question) if word in ("yes", "no") else (),
        shown.points if isinstance(shown, Yes) else (),
        len(shown.final_polynomials) if isinstance(shown, No) else 0,
    )


def tetrahedra_by_name(patterns: Iterable[Pattern]) -> str:
    """Return, as JSON, all patterns' tetrahedra, among which the index searches."""
    named = {p.name: [label(t) for t in p.certificate.tetrahedra] for p in patterns}
    return _for_a_page(named)


# Tables of counts.

ROWS: dict[str, Mapping[str, str]] = {
    "combinatorial": {},
    "realizable": {"realizable": "yes"},
    "convex": {"convex": "yes"},
    "valid": {"valid": "yes"},
}
"""Row of the first table -> the answers that it counts."""


@dataclass(frozen=True)
class Cell:
    """A count, and the filters that show what is counted, as the index writes them."""

    count: int
    filters: str


def table(patterns: Sequence[Pattern]) -> dict[str, list[Cell]]:
    """Return the paper's Table 1, with two more rows; each ends with its sum."""
    sizes = sorted({pattern.size for pattern in patterns})
    return {
        row: [
            Cell(
                sum(_fits(pattern, wanted, size) for pattern in patterns),
                "&".join([f"{q}={a}" for q, a in wanted.items()] + ([f"size={size}"] * bool(size))),
            )
            for size in (*sizes, 0)
        ]
        for row, wanted in ROWS.items()
    }


def _fits(pattern: Pattern, wanted: Mapping[str, str], size: int) -> bool:
    return size in (0, pattern.size) and all(pattern.answer(q) == a for q, a in wanted.items())


# The audit.

_NAME = re.compile(r"\b\d{1,2}_[A-Z]{1,2}\b")


def names_in(finding: Finding) -> set[str]:
    """Return the patterns that a finding names."""
    texts = (finding.claim, finding.amendment, *finding.reasons)
    return {name for text in texts for name in _NAME.findall(text)}


def findings_by_pattern(findings: Iterable[Finding]) -> dict[str, list[Finding]]:
    """Return, by pattern, the findings that name it."""
    found = defaultdict(list)
    for finding in findings:
        for name in names_in(finding):
            found[name].append(finding)
    return dict(found)
