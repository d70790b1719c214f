"""A yes as a list of numbers that a person can check: few determinants, and what they show.

The lemma of embedding.py: non-degenerate tetrahedra meet only in common faces iff no circuit has
X+ in one of them and X- in another. So it is enough that on one side of the circuit of every
quintuple there are, for certain, vertices that are no face; two of its five determinants may show
that. No general position is needed: a determinant that is zero puts no vertex on a side. Extreme
points are shown by linear functions; circuits would need 58 to 70 of the 70 determinants for that.

What :func:`witness` returns satisfies this criterion as it stands, in the numbers that it lists.
"""

from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from fractions import Fraction
from functools import cache
from itertools import combinations, product
from math import gcd
from typing import TypeAlias

from certify.kernel.certificate import Certificate, Yes
from certify.kernel.chirotope import (
    QUADRUPLES,
    QUINTUPLES,
    Point,
    denominators,
    dependence,
    determinant,
    integral,
)
from certify.kernel.hexahedron import VERTICES, Simplex
from certify.kernel.jacobian import Coefficients, bernstein_coefficients
from certify.kernel.triangulation import label, orientation

Vector: TypeAlias = tuple[int, ...]

IN_ONE_PLANE = "in one plane"
NO_FACE = {2: "no edge", 3: "no triangle", 4: "no tetrahedron"}
"""Number of vertices that are no face -> what they are not."""

TIGHTEST = 3
"""So many determinants are shown as the tightest."""

SMALL = 9
"""Linear functions with coefficients of at most this size are tried first."""


class BadWitness(ValueError):
    """The numbers do not show the answer; the message says where."""


@dataclass(frozen=True)
class Line:
    """A quintuple of vertices whose circuit makes no two faces meet.

    side: vertices that are certainly on one side of the circuit, and in no tetrahedron together;
    none if all five are in one plane, where their dependence vanishes and determines no circuit.
    """

    quintuple: Simplex
    side: Simplex

    @property
    def reason(self) -> str:
        """What the vertices of the side are not, or where all five are."""
        return NO_FACE[len(self.side)] if self.side else IN_ONE_PLANE


@dataclass(frozen=True)
class Support:
    """A linear function that is larger at one vertex than at the others, which is thus extreme."""

    vertex: int
    function: Vector
    value: int
    elsewhere: int
    """The largest value at the others."""


@dataclass(frozen=True)
class Witness:
    """What shows a yes, checked as it stands here."""

    question: str
    tetrahedra: tuple[Simplex, ...]
    points: tuple[Vector, ...]
    scales: Vector
    """By what the coordinates x, y and z of the certificate were multiplied."""
    determinants: Mapping[Simplex, int]
    """Those of the tetrahedra, and of the other quadruples that are needed."""
    lines: tuple[Line, ...]
    """One for each of the 56 quintuples."""
    supports: tuple[Support, ...] = ()
    """If the question is convex: one for each vertex."""
    bernstein: Coefficients = field(default_factory=dict)
    """If the question is valid: eight times the Bernstein coefficients of the Jacobian."""

    @property
    def whole(self) -> int:
        """Six times the volume of all tetrahedra together."""
        return sum(abs(self.determinants[t]) for t in self.tetrahedra)

    @property
    def tightest(self) -> tuple[Simplex, ...]:
        """The listed determinants that are next to zero, but not zero."""
        listed = [q for q, value in self.determinants.items() if value]
        return tuple(sorted(listed, key=lambda q: (abs(self.determinants[q]), q))[:TIGHTEST])

    def coefficients(self, line: Line) -> dict[int, int]:
        """Return the coefficients of the dependence that a line needs, from what is listed."""
        known = coefficients(line.quintuple, self.determinants)
        return {v: known[v] for v in line.side or line.quintuple if v in known}


def witness(certificate: Certificate, question: str) -> Witness:
    """Return what shows a certificate's yes.

    Raises:
        ValueError: The answer is no yes.
        BadWitness: The points do not show it.
    """
    answer = certificate.answers[question]
    if not isinstance(answer, Yes):
        raise ValueError(f"{certificate.pattern} {question} is not answered by yes")
    return demonstrate(certificate.tetrahedra, answer.points, question)


def demonstrate(tetrahedra: tuple[Simplex, ...], points: Sequence[Point], question: str) -> Witness:
    """Return what shows that the points realize a triangulation, or raise BadWitness."""
    scaled = integral(points)
    kept = few(tetrahedra, determinants(scaled, QUADRUPLES))
    found = Witness(
        question,
        tetrahedra,
        tuple(scaled),
        tuple(denominators(points)),
        kept,
        chosen_lines(kept, missing_faces(tetrahedra)),
        tuple(supports(scaled)) if question == "convex" else (),
        bernstein_coefficients(points) if question == "valid" else {},
    )
    require(found)
    return found


# The criterion.


def require(found: Witness) -> None:
    """Raise BadWitness unless the points have these numbers, and these show the answer."""
    if determinants(found.points, found.determinants) != dict(found.determinants):
        raise BadWitness("the points have other determinants")
    for tetrahedron, sign in orientation(found.tetrahedra).items():
        if found.determinants.get(tetrahedron, 0) * sign <= 0:
            raise BadWitness(f"tetrahedron {label(tetrahedron)} is degenerate or inverted")
    if tuple(line.quintuple for line in found.lines) != QUINTUPLES:
        raise BadWitness("there is not one line for each quintuple")
    for line in found.lines:
        _require_line(line, found)
    if found.question == "convex":
        _require_supports(found)
    if found.question == "valid":
        _require_jacobian(found)


def _require_line(line: Line, found: Witness) -> None:
    """The side is on one side, and in no tetrahedron; or the dependence vanishes."""
    known = coefficients(line.quintuple, found.determinants)
    if not line.side:
        shown = [known.get(v) for v in line.quintuple] == [0] * 5
    else:
        signs = {_sign(known.get(v, 0)) for v in line.side}
        shown = signs in ({1}, {-1}) and not any({*line.side} <= {*t} for t in found.tetrahedra)
    if not shown:
        raise BadWitness(f"the line of {label(line.quintuple)} is not true")


def _require_supports(found: Witness) -> None:
    """Each vertex is where a linear function is largest, and only there."""
    if tuple(support.vertex for support in found.supports) != VERTICES:
        raise BadWitness("there is not one linear function for each vertex")
    for support in found.supports:
        values = [_dot(support.function, point) for point in found.points]
        value = values.pop(support.vertex - 1)
        if (value, max(values)) != (support.value, support.elsewhere) or value <= max(values):
            raise BadWitness(f"vertex {support.vertex} is not shown to be an extreme point")


def _require_jacobian(found: Witness) -> None:
    """All Bernstein coefficients are positive, as they stand, without any subdivision."""
    if found.bernstein != bernstein_coefficients([tuple(map(Fraction, p)) for p in found.points]):
        raise BadWitness("the Jacobian has other Bernstein coefficients")
    for index, value in found.bernstein.items():
        if value <= 0:
            raise BadWitness(f"the 27 Bernstein coefficients are not all positive: {label(index)}")


# Determinants.


def determinants(
    points: Sequence[Vector], quadruples: Sequence[Simplex] | Mapping[Simplex, int]
) -> dict[Simplex, int]:
    """Return the determinants of some quadruples of the points, vertex 1 first."""
    return {q: determinant([(1, *points[vertex - 1]) for vertex in q]) for q in quadruples}


def coefficients(quintuple: Simplex, listed: Mapping[Simplex, int]) -> dict[int, int]:
    """Return the coefficients of the affine dependence whose determinants are listed."""
    return {v: sign * listed[q] for v, q, sign in dependence(quintuple) if q in listed}


def few(tetrahedra: tuple[Simplex, ...], values: Mapping[Simplex, int]) -> dict[Simplex, int]:
    """Return the tetrahedra's determinants, and of the others as few as each quintuple needs.

    They are left out one by one, the tightest first. What remains is minimal, though another order
    may keep one or two less.
    """
    missing, kept = missing_faces(tetrahedra), dict(values)
    for quintuple in QUINTUPLES:
        if not any(lines(quintuple, kept, missing)):
            raise BadWitness(f"both sides of the circuit of {label(quintuple)} are faces")
    for q in sorted(values, key=lambda q: (abs(values[q]), q)):
        rest = {other: value for other, value in kept.items() if other != q}
        touched = (quintuple for quintuple in QUINTUPLES if {*q} < {*quintuple})
        if q not in tetrahedra and all(any(lines(t, rest, missing)) for t in touched):
            kept = rest
    return kept


# Lines.


def missing_faces(tetrahedra: tuple[Simplex, ...]) -> tuple[Simplex, ...]:
    """Return the smallest sets of vertices that are in no tetrahedron, with at most four."""
    found: list[Simplex] = []
    for size in NO_FACE:
        for face in combinations(VERTICES, size):
            if not any({*face} <= {*t} for t in tetrahedra):
                found += [face] * (not any({*smaller} < {*face} for smaller in found))
    return tuple(found)


def lines(
    quintuple: Simplex, listed: Mapping[Simplex, int], missing: Sequence[Simplex]
) -> Iterator[Line]:
    """Yield every line that the listed determinants allow for a quintuple.

    If all five are listed, there is none iff both sides of the circuit are faces.
    """
    known = coefficients(quintuple, listed)
    if len(known) == 5 and not any(known.values()):
        yield Line(quintuple, ())
    positive, negative = ({v for v in known if known[v] * sign > 0} for sign in (1, -1))
    for face in missing:
        if positive.issuperset(face) or negative.issuperset(face):
            yield Line(quintuple, face)


def chosen_lines(listed: Mapping[Simplex, int], missing: Sequence[Simplex]) -> tuple[Line, ...]:
    """Return a line for each quintuple: short ones first, and few different sides."""
    open_ = {quintuple: [*lines(quintuple, listed, missing)] for quintuple in QUINTUPLES}
    found: dict[Simplex, Line] = {}
    while open_:
        often = Counter(line.side for choice in open_.values() for line in choice)
        side = min(often, key=lambda side: (len(side), -often[side], side))
        for choice in [*open_.values()]:
            for line in choice:
                if line.side == side:
                    found[line.quintuple] = line
                    del open_[line.quintuple]
    return tuple(found[quintuple] for quintuple in QUINTUPLES)


# Extreme points.


def supports(points: Sequence[Vector]) -> Iterator[Support]:
    """Yield for each vertex a linear function that is largest there, with small coefficients."""
    for vertex in VERTICES:
        sure = _support(vertex, _sum_of_normals(vertex, points), points)
        if sure.value <= sure.elsewhere:
            raise BadWitness(f"vertex {vertex} is not an extreme point of the hull")
        found = (_support(vertex, function, points) for function in _small_functions())
        yield next((one for one in found if one.value > one.elsewhere), sure)


@cache
def _small_functions() -> tuple[Vector, ...]:
    """Return the linear functions with small coefficients, the simplest first."""
    return tuple(
        sorted(
            product(range(-SMALL, SMALL + 1), repeat=3),
            key=lambda function: (sum(map(abs, function)), max(map(abs, function)), function),
        )
    )


def _support(vertex: int, function: Vector, points: Sequence[Vector]) -> Support:
    values = [_dot(function, point) for point in points]
    value = values.pop(vertex - 1)
    return Support(vertex, function, value, max(values))


def _sum_of_normals(vertex: int, points: Sequence[Vector]) -> Vector:
    """Return the sum of outward normals of the planes that support the hull at a vertex.

    The hull, if it is solid, touches all these planes together exactly in the smallest of its faces
    that has the vertex; so the function is largest at the vertex alone iff that is extreme.
    """
    tip = points[vertex - 1]
    total: Vector = (0, 0, 0)
    edges = [tuple(x - y for x, y in zip(point, tip, strict=True)) for point in points]
    for (a, b, c), (d, e, f) in combinations(edges, 2):
        normal = (b * f - c * e, c * d - a * f, a * e - b * d)
        heights = [_dot(normal, edge) for edge in edges]
        for sign in (1, -1):
            if all(sign * height <= 0 for height in heights):
                total = tuple(x + sign * y for x, y in zip(total, normal, strict=True))
    divisor = gcd(*total) or 1
    return tuple(x // divisor for x in total)


def _dot(p: Vector, q: Vector) -> int:
    return sum(x * y for x, y in zip(p, q, strict=True))


def _sign(value: int) -> int:
    return (value > 0) - (value < 0)
