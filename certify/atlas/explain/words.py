"""An explanation in words: as text, Markdown, LaTeX or JSON.

All four are made from the same lines, and these from what the kernel has replayed.
"""

import re
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import asdict, dataclass
from itertools import combinations, product
from textwrap import wrap
from typing import Any

from certify.atlas.explain.explanation import Case, Explanation, Fact, Item, Mirror, Step
from certify.atlas.explain.reasons import ANY, SIGN, Reason, Signs
from certify.kernel.certificate import Certificate, No
from certify.kernel.chirotope import RELATIONS, dependence
from certify.kernel.hexahedron import Simplex, sorted_with_sign
from certify.kernel.refutation import FinalPolynomial, products
from certify.kernel.triangulation import label

COMPARED = {1: "< 0", 2: "= 0", 3: "<= 0", 4: "> 0", 5: "!= 0", 6: ">= 0"}
MARKS = {0: "", 1: "-", 2: "0", 3: "<=", 4: "+", 5: "!=", 6: ">=", 7: "?"}
"""Signs -> how they are written under a bracket."""
FORMULA = re.compile(r"\[\d+\] \S+ 0|\d+\|\d+")
"""In a reason: a fact, or the name of a Grassmann-Plücker relation."""


@dataclass(frozen=True)
class Term:
    """A term of a Grassmann-Plücker relation: its sign, and two brackets with what is known."""

    sign: int
    brackets: tuple[tuple[str, str], tuple[str, str]]


@dataclass(frozen=True)
class Line:
    """One line of an explanation.

    depth: in how many cases it is; number: None for the line that opens a case; says: the fact;
    because: the reason; terms: if that is a relation, the whole of it; uses: numbers of earlier
    lines; clauses: numbers of the kernel's clauses that show the fact.
    """

    depth: int
    number: int | None
    says: str
    because: str
    terms: tuple[Term, ...] = ()
    uses: tuple[int, ...] = ()
    clauses: tuple[int, ...] = ()


@dataclass(frozen=True)
class Inequality:
    """An inequality between absolute values of products of two determinants.

    times: how often it is multiplied; larger, smaller: two brackets; compared: ">" or ">=";
    relation: the name of the Grassmann-Plücker relation that shows it.
    """

    times: int
    larger: tuple[str, str]
    compared: str
    smaller: tuple[str, str]
    relation: str


@dataclass(frozen=True)
class Polynomial:
    """A final polynomial: the signs under which its inequalities hold, whose product is absurd."""

    number: int
    signs: tuple[str, ...]
    inequalities: tuple[Inequality, ...]


@dataclass(frozen=True)
class Account:
    """All that is said: a title, what is assumed, what that gives, and the lines.

    polynomials: the final polynomials that the lines name.
    """

    title: str
    assumed: str
    given: tuple[str, ...]
    lines: tuple[Line, ...]
    polynomials: tuple[Polynomial, ...]


TITLES = {
    "realizable": "{} has no realization",
    "convex": "{} has no realization in convex position",
    "valid": "{} carries no valid hexahedron",
}
ASSUMED = {
    "realizable": "Suppose that eight points realize {}, not mirrored.",
    "convex": "Suppose that eight points realize {}, not mirrored, and none is inside the hull.",
    "valid": "Suppose that eight points realize {}, not mirrored, and that the Jacobian is "
    "positive on the closed cube.",
}
NOTATION = (
    "[abcd] is the determinant of p_b - p_a, p_c - p_a, p_d - p_a. Its sign, as far as it is "
    "known, is written at a bracket. Numbers in parentheses are those of earlier steps."
)


POLYNOMIAL = "Under the signs"
FOLLOWS = (
    "these inequalities hold between absolute values. Beside each is the name of its "
    "Grassmann-Pluecker relation: with A = [stab][stcd], B = [stac][stbd] and C = [stad][stbc], "
    "for the vertices s, t, a, b, c, d of the name, it says A = B - C. Here B is not zero, and C "
    "has not its sign, so that A is in absolute value the sum of both."
)
ABSURD = (
    "Multiply them all, each as often as it says: every determinant occurs equally often on both "
    "sides, and an inequality is strict, which is absurd."
)


def account(explanation: Explanation, certificate: Certificate, question: str) -> Account:
    """Return in words what has been replayed of a certificate's no."""
    given = tuple(says(Fact(q, signs)) for q, signs in explanation.given.items())
    found = tuple(_lines(explanation.steps, 0, faces_of(certificate.tetrahedra)))
    title, assumed = (what[question].format(certificate.pattern) for what in (TITLES, ASSUMED))
    return Account(
        title, assumed, given, found, tuple(_polynomials(explanation, certificate, question))
    )


def _polynomials(
    explanation: Explanation, certificate: Certificate, question: str
) -> Iterator[Polynomial]:
    """Yield the final polynomials that steps name, as the certificate has them."""
    answer = certificate.answers[question]
    polynomials = answer.final_polynomials if isinstance(answer, No) else ()
    steps = [item.reason for item in explanation.items() if isinstance(item, Step)]
    for number in sorted({own.vertices[0] for own in steps if own.kind == "polynomial"}):
        final = polynomials[number - 1]
        signs = tuple(f"[{label(q)}] {COMPARED[BY_SIGN[s]]}" for q, s in final.signs.items())
        yield Polynomial(number, signs, tuple(_inequalities(final)))


BY_SIGN = {value: signs for signs, value in SIGN.items()}
"""Sign -> the signs that a determinant may have if that is the only one."""


def _inequalities(final: FinalPolynomial) -> Iterator[Inequality]:
    for times, six in final.inequalities:
        larger, smaller, rest = (
            tuple(sorted_with_sign(bracket)[0] for bracket in product_)
            for product_ in products(six)
        )
        compared = ">" if all(final.signs.get(q) for q in rest) else ">="
        (a, b), (c, d) = (map(label, larger), map(label, smaller))
        yield Inequality(times, (a, b), compared, (c, d), f"{label(six[:2])}|{label(six[2:])}")


def _lines(items: Sequence[Item], depth: int, faces: frozenset[Simplex]) -> Iterator[Line]:
    for item in items:
        match item:
            case Step():
                uses = tuple(k for k in item.uses if k > 0)
                because, terms = _because(item, faces)
                yield Line(depth, item.number, says(item.fact), because, terms, uses, item.clauses)
            case Case():
                yield Line(depth, None, says(item.supposed), "suppose")
                yield from _lines(item.steps, depth + 1, faces)
                because = f"for {says(item.supposed)} is contradictory"
                yield Line(depth, item.number, says(item.fact), because)
            case Mirror():
                because = f"as {item.of}, with the vertices exchanged by {cycles(item.symmetry)}"
                yield Line(depth, item.number, says(item.fact), because)


def says(fact: Fact) -> str:
    """Return a fact as a formula."""
    if not fact.signs:
        return "contradiction"
    return f"[{label(fact.determinant)}] {COMPARED[fact.signs]}"


def cycles(symmetry: tuple[int, ...]) -> str:
    """Return a relabelling as its cycles, such as (1 7)(2 6)."""
    text, seen = "", set[int]()
    for start in range(1, len(symmetry) + 1):
        cycle, vertex = [], start
        while vertex not in seen:
            seen.add(vertex)
            cycle.append(vertex)
            vertex = symmetry[vertex - 1]
        if len(cycle) > 1:
            text += f"({' '.join(map(str, cycle))})"
    return text


def faces_of(tetrahedra: Sequence[Simplex]) -> frozenset[Simplex]:
    """Return all faces of some tetrahedra."""
    return frozenset(
        face for t in tetrahedra for size in (1, 2, 3, 4) for face in combinations(t, size)
    )


def _because(step: Step, faces: frozenset[Simplex]) -> tuple[str, tuple[Term, ...]]:
    reason = step.reason
    otherwise = "else " if step.fact.signs else ""
    match reason.kind:
        case "relation":
            return f"Grassmann-Pluecker {reason.name}", terms_of(reason, step.before)
        case "circuit":
            five = label(reason.vertices)
            return f"circuit {five}: {otherwise}{_circuit(step, faces)}", ()
        case "edge":
            edge = label(reason.vertices)
            return f"{otherwise}the Jacobian would not be positive along edge {edge}", ()
        case "section":
            one, other = map(label, reason.determinants)
            return f"{otherwise}a plane between {one} and {other} would cut no disc", ()
    return f"final polynomial {reason.vertices[0]}", ()


# Relations.


def terms_of(reason: Reason, known: Mapping[Simplex, Signs]) -> tuple[Term, ...]:
    """Return a relation with brackets in increasing order, its first term positive."""
    s, t, a, b, c, d = reason.vertices
    first = ((s, t, a, b), (s, t, c, d))
    relation = next(terms for terms in RELATIONS if terms[0][:2] == first)
    found = []
    for x, y, sign in relation:
        sorted_ = sorted_with_sign(x), sorted_with_sign(y)
        one, other = ((label(q), MARKS[known.get(q, ANY)]) for q, _ in sorted_)
        found.append(Term(sign * sorted_[0][1] * sorted_[1][1], (one, other)))
    return tuple(Term(term.sign * found[0].sign, term.brackets) for term in found)


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
    # Coefficients whose sum is zero have both signs, or none.
    wrong = {_wrong(*sides, faces) for sides in circuits if all(sides)}
    if not wrong:
        return "its dependence would have one sign only"
    if len(wrong) == 1:
        return wrong.pop()
    one, other = (
        label([v for v in step.reason.vertices if all(v in sides[k] for sides in circuits)])
        for k in (0, 1)
    )
    ending = " or a vertex be inside the hull" if any("hull" in what for what in wrong) else ""
    if one and other:
        return f"a face with {one} would meet one with {other}{ending}"
    return f"two faces would meet{ending}"


def _sides(vertices: Simplex, signs: Mapping[Simplex, int]) -> tuple[Simplex, Simplex]:
    """Return the two sides of the circuit of five points."""
    values = [(vertex, factor * signs[q]) for vertex, q, factor in dependence(vertices)]
    return tuple(v for v, value in values if value > 0), tuple(
        v for v, value in values if value < 0
    )


def _values(signs: Signs) -> list[int]:
    return [value for sign, value in SIGN.items() if sign & signs]


def _wrong(positive: Simplex, negative: Simplex, faces: frozenset[Simplex]) -> str:
    one, other = sorted((positive, negative), key=lambda side: (len(side), side))
    if one not in faces or other not in faces:
        return f"vertex {label(one)} would be inside the hull, in {label(other)}"
    first, second = label(one), label(other)
    return {
        (1, 1): f"vertices {first} and {second} would coincide",
        (1, 2): f"vertex {first} would be on edge {second}",
        (1, 3): f"vertex {first} would be in triangle {second}",
        (1, 4): f"vertex {first} would be inside tetrahedron {second}",
        (2, 2): f"edges {first} and {second} would cross",
        (2, 3): f"edge {first} would pierce triangle {second}",
    }[len(one), len(other)]


# Formats.


def as_json(told: Account) -> dict[str, Any]:
    """Return the account as a JSON object."""
    return asdict(told)


def as_text(told: Account, width: int = 80) -> str:
    """Return the account as plain text."""
    out = [told.title, "", *wrap(f"{told.assumed} {NOTATION}", width), ""]
    rows = (told.given[i : i + 5] for i in range(0, len(told.given), 5))
    out += ["   " + "  ".join(f"{fact:<12}" for fact in row).rstrip() for row in rows]
    out.append("")
    for line in told.lines:
        pad = "   " * line.depth
        if line.number is None:
            out.append(f"{pad}Suppose {line.says}.")
            continue
        head = f"{pad}{line.number:>3}. {line.says:<14}"
        body = f"{line.because}{_used(line)}"
        first, *more = wrap(body, width - len(head))
        out += [head + first, *(" " * len(head) + part for part in more)]
        out += [f"{pad}{'':5}{row}" for row in _rows(line.terms)]
    for final in told.polynomials:
        words = f"{_heading(final)} {POLYNOMIAL} {', '.join(final.signs)} {FOLLOWS}"
        out += ["", *wrap(words, width), ""]
        for own in final.inequalities:
            larger, smaller = (
                "".join(f"[{name}]" for name in p) for p in (own.larger, own.smaller)
            )
            line_ = f"{larger} {own.compared:2} {smaller}"
            out.append(f"{own.times:>5} x  {line_:<30}{own.relation}")
        out += ["", *wrap(ABSURD, width)]
    return "\n".join(out)


def _heading(final: Polynomial) -> str:
    return f"Final polynomial {final.number}."


def _used(line: Line) -> str:
    return f" ({', '.join(map(str, line.uses))})" if line.uses else ""


def _rows(terms: Sequence[Term]) -> Iterator[str]:
    """Yield a relation, and under each bracket its sign."""
    above = below = ""
    for term in terms:
        sign = (" + " if term.sign > 0 else " - ") if above else ""
        above += sign + "".join(f"[{name}]" for name, _ in term.brackets)
        below += " " * len(sign) + "".join(f"{mark:^6}" for _, mark in term.brackets)
    if terms:
        yield f"{above} = 0"
        yield below.rstrip()


def as_markdown(told: Account) -> str:
    """Return the account as Markdown with formulas that a code host sets."""
    out = [f"# {told.title}", "", f"{told.assumed} {NOTATION}", ""]
    out += [", ".join(f"${_tex(fact)}$" for fact in told.given) + ".", ""]
    for line in told.lines:
        pad = "  " * line.depth
        if line.number is None:
            out.append(f"{pad}- Suppose ${_tex(line.says)}$.")
            continue
        fact = line.says if line.says == "contradiction" else f"${_tex(line.says)}$"
        formula = f": ${_relation(line.terms)}$" if line.terms else ""
        out.append(
            f"{pad}- **{line.number}.** {fact}; {_words(line.because)}{_used(line)}{formula}."
        )
    for final in told.polynomials:
        signs = ", ".join(f"${_tex(fact)}$" for fact in final.signs)
        out += ["", f"**{_heading(final)}** {POLYNOMIAL} {signs} {_words(FOLLOWS)}", ""]
        out += [
            f"- {own.times} × ${_inequality(own)}$, ${own.relation}$" for own in final.inequalities
        ]
        out += ["", ABSURD]
    return "\n".join(out)


def _inequality(own: Inequality) -> str:
    larger, smaller = (r"\,".join(f"[{name}]" for name in p) for p in (own.larger, own.smaller))
    return rf"|{larger}| {_tex(own.compared)} |{smaller}|"


def as_latex(told: Account) -> str:
    """Return the account as a LaTeX document."""
    title = _escaped(told.title)
    out = [LATEX_HEAD, rf"\section*{{{title}}}", f"{_escaped(told.assumed)} {LATEX_NOTATION}"]
    out += ["", r"\medskip", ", ".join(f"${_tex(fact)}$" for fact in told.given) + "."]
    out += ["", LATEX_BEGIN]
    depth = 0
    for line in told.lines:
        out += [LATEX_BEGIN] * (line.depth - depth) + [LATEX_END] * (depth - line.depth)
        depth = line.depth
        if line.number is None:
            out.append(rf"\item[] Suppose ${_tex(line.says)}$.")
            continue
        fact = line.says if line.says == "contradiction" else f"${_tex(line.says)}$"
        formula = rf" \[{_relation(line.terms)}\]" if line.terms else "."
        because = _escaped(_words(line.because))
        out.append(rf"\item[{line.number}.] {fact}; {because}{_used(line)}{formula}")
    out += [LATEX_END] * (depth + 1)
    for final in told.polynomials:
        signs = ", ".join(f"${_tex(fact)}$" for fact in final.signs)
        follows = _escaped(_words(FOLLOWS))
        out += ["", r"\medskip", rf"\textbf{{{_heading(final)}}} {POLYNOMIAL} {signs} {follows}"]
        out.append(LATEX_BEGIN)
        out += [
            rf"\item[${own.times} \times$] ${_inequality(own)}$, ${own.relation}$"
            for own in final.inequalities
        ]
        out += [LATEX_END, ABSURD]
    return "\n".join([*out, LATEX_TAIL])


LATEX_HEAD = r"""\documentclass[a4paper]{article}
\usepackage[margin=25mm]{geometry}
\usepackage{amsmath}
\setlength{\parindent}{0pt}
\begin{document}
\raggedright
\abovedisplayskip=2pt \belowdisplayskip=2pt"""
LATEX_NOTATION = (
    r"$[abcd]$ is the determinant of $p_b - p_a$, $p_c - p_a$, $p_d - p_a$. Its sign, as far as it "
    "is known, is written at a bracket. Numbers in parentheses are those of earlier steps."
)
LATEX_BEGIN = r"\begin{itemize}\setlength{\itemsep}{0pt}\setlength{\parskip}{0pt}"
LATEX_END, LATEX_TAIL = r"\end{itemize}", r"\end{document}"


def _escaped(text: str) -> str:
    return text.replace("_", r"\_").replace("Pl\u00fccker", r"Pl\"ucker")


def _tex(formula: str) -> str:
    for plain, command in (("<=", r"\le"), (">=", r"\ge"), ("!=", r"\ne")):
        formula = formula.replace(plain, command)
    return formula


def _words(because: str) -> str:
    """Return a reason with its formulas, and the names of relations, set as formulas."""
    set_as = FORMULA.sub(lambda found: f"${_tex(found[0])}$", because)
    return set_as.replace("Pluecker", "Plücker")


def _relation(terms: Sequence[Term]) -> str:
    text = ""
    for term in terms:
        text += (" + " if term.sign > 0 else " - ") if text else ""
        text += "".join(rf"\overset{{{_tex(mark)}}}{{[{name}]}}" for name, mark in term.brackets)
    return f"{text} = 0"
