"""An explanation in words: as text, Markdown, LaTeX or JSON.

All four are made from the same lines, and these from what the kernel has replayed.
"""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import asdict, dataclass
from itertools import combinations, product
from typing import Any

from certify.atlas.explanation import Case, Explanation, Fact, Item, Mirror, Step
from certify.atlas.reasons import ANY, SIGN, Reason, Signs
from certify.kernel.chirotope import RELATIONS, dependence
from certify.kernel.hexahedron import Simplex, sorted_with_sign
from certify.kernel.triangulation import label

RELATION_TO_ZERO = {1: "<", 2: "=", 3: "<=", 4: ">", 5: "!=", 6: ">="}
MARK = {0: "!", 1: "-", 2: "0", 3: "≤", 4: "+", 5: "≠", 6: "≥", 7: "?"}


@dataclass(frozen=True)
class Term:
    """A term of a Grassmann-Plücker relation: its sign, and two brackets with what is known."""

    sign: int
    brackets: tuple[tuple[str, str], tuple[str, str]]


@dataclass(frozen=True)
class Line:
    """One line of an explanation.

    depth: in how many cases it is; number: None for the line that opens a case; says: the fact;
    because: the reason; terms: if that is a relation, the whole of it; uses: earlier lines.
    """

    depth: int
    number: int | None
    says: str
    because: str
    terms: tuple[Term, ...] = ()
    uses: tuple[str, ...] = ()


def lines(explanation: Explanation, faces: frozenset[Simplex]) -> Iterator[Line]:
    """Yield the lines of an explanation; faces: those of the tetrahedra, of all dimensions."""
    return _lines(explanation.steps, (), faces)


def _lines(
    items: Sequence[Item], open_cases: tuple[str, ...], faces: frozenset[Simplex]
) -> Iterator[Line]:
    depth = len(open_cases)
    for item in items:
        match item:
            case Step():
                uses = tuple(_use(k) for k in item.uses)
                because, terms = _because(item, faces)
                yield Line(depth, item.number, says(item.fact), because, terms, uses)
            case Case():
                supposed = says(item.supposed)
                yield Line(depth, None, supposed, "suppose")
                yield from _lines(item.steps, (*open_cases, supposed), faces)
                yield Line(depth, item.number, says(item.fact), f"it is not so that {supposed}")
            case Mirror():
                because = f"as {item.of}, with {exchanged(item.symmetry)}"
                yield Line(depth, item.number, says(item.fact), because)


def _use(number: int) -> str:
    return "given" if number == 0 else "supposed" if number < 0 else str(number)


def says(fact: Fact) -> str:
    """Return a fact as a formula."""
    if not fact.signs:
        return "contradiction"
    return f"[{label(fact.determinant)}] {RELATION_TO_ZERO[fact.signs]} 0"


def exchanged(symmetry: tuple[int, ...]) -> str:
    """Return a relabelling as its cycles."""
    cycles = []
    seen: set[int] = set()
    for start in range(1, 9):
        cycle = []
        vertex = start
        while vertex not in seen:
            seen.add(vertex)
            cycle.append(vertex)
            vertex = symmetry[vertex - 1]
        if len(cycle) > 1:
            cycles.append(f"({' '.join(map(str, cycle))})")
    return "".join(cycles)


def _because(step: Step, faces: frozenset[Simplex]) -> tuple[str, tuple[Term, ...]]:
    reason = step.reason
    match reason.kind:
        case "relation":
            return f"Grassmann-Plücker {reason.name}", terms_of(reason, step.before)
        case "circuit":
            return _circuit(step, faces), ()
        case "edge":
            return f"Jacobian along the edge {label(reason.vertices)}", ()
        case "section":
            one, other = reason.determinants
            return f"section lemma, facets {label(one)} and {label(other)}", ()
    return f"final polynomial {reason.vertices[0]}", ()


# Relations.


def terms_of(reason: Reason, known: Mapping[Simplex, Signs]) -> tuple[Term, ...]:
    """Return a relation with brackets in increasing order, the first term positive."""
    s, t, a, b, c, d = reason.vertices
    relation = next(
        terms for terms in RELATIONS if (terms[0][0], terms[0][1]) == ((s, t, a, b), (s, t, c, d))
    )
    found = []
    for x, y, sign in relation:
        (first, p), (second, q) = sorted_with_sign(x), sorted_with_sign(y)
        pair = ((label(first), _mark(known, first)), (label(second), _mark(known, second)))
        found.append(Term(sign * p * q, pair))
    return tuple(Term(term.sign * found[0].sign, term.brackets) for term in found)


def _mark(known: Mapping[Simplex, Signs], quadruple: Simplex) -> str:
    return MARK[known.get(quadruple, ANY)]


# Circuits.


def _circuit(step: Step, faces: frozenset[Simplex]) -> str:
    """Say what would be wrong if the determinant had one of the excluded signs.

    If more than one thing may be wrong, say which vertices are on the two sides for certain.
    """
    may = {quadruple: step.before.get(quadruple, ANY) for quadruple in step.reason.determinants}
    may[step.fact.determinant] = step.excluded
    circuits = [
        _sides(step.reason.vertices, dict(zip(may, signs, strict=True)))
        for signs in product(*map(_values, may.values()))
    ]
    wrong = {_wrong(*sides, faces) for sides in circuits if any(sides)}
    if len(wrong) == 1:
        return f"else {wrong.pop()}"
    one, other = (
        label([v for v in step.reason.vertices if all(v in sides[k] for sides in circuits)])
        for k in (0, 1)
    )
    ending = " or a vertex be inside the hull" if any("hull" in what for what in wrong) else ""
    if one and other:
        return f"else a face with {one} would meet one with {other}{ending}"
    return f"else faces of {label(step.reason.vertices)} would meet{ending}"


def _sides(vertices: Simplex, signs: Mapping[Simplex, int]) -> tuple[Simplex, Simplex]:
    """Return the two sides of the circuit of five points."""
    values = [(vertex, factor * signs[q]) for vertex, q, factor in dependence(vertices)]
    return tuple(v for v, value in values if value > 0), tuple(
        v for v, value in values if value < 0
    )


def _wrong(positive: Simplex, negative: Simplex, faces: frozenset[Simplex]) -> str:
    one, other = sorted((positive, negative), key=len)
    if one in faces and other in faces:
        return meeting(one, other)
    return f"vertex {label(one)} would be inside the hull, in {label(other)}"


def _values(signs: Signs) -> list[int]:
    return [value for sign, value in SIGN.items() if sign & signs]


def meeting(one: Simplex, other: Simplex) -> str:
    """Say how two faces without a common vertex meet, the smaller one first."""
    match len(one), len(other):
        case 1, 2:
            return f"vertex {label(one)} would lie on edge {label(other)}"
        case 1, 3:
            return f"vertex {label(one)} would lie in triangle {label(other)}"
        case 1, 4:
            return f"vertex {label(one)} would lie inside tetrahedron {label(other)}"
        case 2, 2:
            return f"edges {label(one)} and {label(other)} would cross"
        case 2, 3:
            return f"edge {label(one)} would pierce triangle {label(other)}"
    return f"{label(one)} and {label(other)} would meet"


def faces_of(tetrahedra: Sequence[Simplex]) -> frozenset[Simplex]:
    """Return all faces of some tetrahedra."""
    return frozenset(
        face for t in tetrahedra for size in (1, 2, 3, 4) for face in combinations(t, size)
    )


# Formats.


def as_json(explanation: Explanation, faces: frozenset[Simplex]) -> dict[str, Any]:
    """Return the explanation as a JSON object."""
    return {
        "given": [says(Fact(q, signs)) for q, signs in explanation.given.items()],
        "lines": [asdict(line) for line in lines(explanation, faces)],
        "lrat": explanation.lrat,
    }


def as_text(explanation: Explanation, faces: frozenset[Simplex]) -> str:
    """Return the explanation as plain text of at most 80 columns."""
    out = ["Given:"]
    given = [says(Fact(q, signs)) for q, signs in explanation.given.items()]
    rows = (given[i : i + 5] for i in range(0, len(given), 5))
    out += ["   " + "  ".join(f"{fact:<12}" for fact in row).rstrip() for row in rows]
    for line in lines(explanation, faces):
        pad = "   " * line.depth
        if line.number is None:
            out += ["", f"{pad}Suppose {line.says}."]
            continue
        uses = f" ({', '.join(line.uses)})" if line.uses else ""
        out.append(f"{pad}{line.number:>3}. {line.says:<13} {line.because}{uses}")
        if line.terms:
            out += [f"{pad}{'':18}  {row}" for row in _rows(line.terms)]
    return "\n".join(out)


def _rows(terms: Sequence[Term]) -> tuple[str, str]:
    above, below = "", ""
    for k, term in enumerate(terms):
        sign = "" if k == 0 else " + " if term.sign > 0 else " - "
        above += sign + "".join(f"[{name}]" for name, _ in term.brackets)
        below += " " * len(sign) + "".join(f"{mark:^6}" for _, mark in term.brackets)
    return f"{above} = 0", below.rstrip()
