"""A witness in words: as text, Markdown, LaTeX or JSON.

All but JSON are made from one :class:`Page`. Its sentences and cells are plain text in which $...$
is a formula and `...` is to be set with letters of one width; every format can write both.
"""

import re
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from fractions import Fraction
from itertools import zip_longest
from textwrap import wrap
from typing import Any, TypeAlias

from certify.atlas.explain.witness import IN_ONE_PLANE, Line, Support, Witness
from certify.atlas.explain.words import LATEX_HEAD, LATEX_TAIL
from certify.kernel.hexahedron import CORNERS, Simplex, boundary_triangles
from certify.kernel.triangulation import boundary_diagonals, label
from certify.kernel.validity import across

Group: TypeAlias = tuple[str, tuple[str, ...]]
"""What is written in front of some cells, and the cells."""


@dataclass(frozen=True)
class Table:
    """Cells that are set in columns, as many as fit, or as many as ``columns`` says."""

    groups: tuple[Group, ...]
    columns: int = 0


@dataclass(frozen=True)
class Part:
    """A part of the page: a heading, a paragraph, a table, and what is said below it."""

    heading: str
    text: str
    table: Table | None = None
    below: str = ""


@dataclass(frozen=True)
class Page:
    """All that is said."""

    title: str
    parts: tuple[Part, ...]


TITLES = {
    "realizable": "{} has a realization",
    "convex": "{} has a realization in convex position",
    "valid": "{} carries a valid hexahedron",
}
SHOWN = {
    "realizable": "",
    "convex": ", and every vertex is an extreme point of the hull",
    "valid": ", and the Jacobian of the trilinear hexahedron is positive on the closed cube",
}


def page(found: Witness, pattern: str) -> Page:
    """Return in words what has been checked."""
    parts = [_points(found), _determinants(found), _circuits(found)]
    if found.question == "convex":
        parts.append(_extreme_points(found))
    if found.question == "valid":
        parts.append(_jacobian(found))
    return Page(TITLES[found.question].format(pattern), (*parts, _tightest(found)))


def _points(found: Witness) -> Part:
    text = (
        f"With these eight points the {len(found.tetrahedra)} tetrahedra of part 1 meet only in "
        f"common faces{SHOWN[found.question]}."
    )
    if set(found.scales) != {1}:
        scales = ", ".join(map(str, found.scales))
        text += f" (To make them integers, $x, y, z$ were multiplied by ${scales}$.)"
    cells = tuple(
        f"{vertex} $({', '.join(map(str, point))})$"
        for vertex, point in enumerate(found.points, start=1)
    )
    return Part("Claim", text, Table((("", cells),)))


def _determinants(found: Witness) -> Part:
    text = (
        "$[abcd]$ is the determinant of $p_b - p_a$, $p_c - p_a$, $p_d - p_a$. Of the 70 "
        f"these {len(found.determinants)} are needed. None of the tetrahedra is flat. (That two "
        "with a common triangle lie on its two sides follows from part 2.)"
    )
    values = {q: f"$[{label(q)}] = {value}$" for q, value in found.determinants.items()}
    others = tuple(cell for q, cell in values.items() if q not in found.tetrahedra)
    tetrahedra = tuple(values[t] for t in found.tetrahedra)
    return Part("1. Determinants", text, Table((("tetrahedra", tetrahedra), ("others", others))))


def _circuits(found: Witness) -> Part:
    text = (
        "Five vertices $a < b < c < d < e$ that are not in one plane have, but for a factor, one "
        "affine dependence. Its coefficients are $[bcde]$, $-[acde]$, $[abde]$, $-[abce]$, "
        "$[abcd]$. (Their sum is zero, a check on the arithmetic.) If two tetrahedra met elsewhere "
        "than in a common face, then for some five vertices one tetrahedron would have all with a "
        "positive coefficient, and one all with a negative: this is the lemma that "
        "certify/kernel/embedding.py proves. Here it is otherwise for each of the "
        "56: some vertices, written in front, have coefficients of one sign, and no tetrahedron "
        "has all of them. A dot is a coefficient that is not needed."
    )
    sides = sorted({line.side for line in found.lines}, key=lambda side: (len(side), side))
    groups = tuple(
        (
            f"{label(side)} {lines[0].reason}".strip(),
            tuple(f"`{label(line.quintuple)} {_marks(found, line)}`" for line in lines),
        )
        for side in sides
        for lines in [[line for line in found.lines if line.side == side]]
    )
    return Part("2. Circuits", text, Table(groups), _example(found))


def _marks(found: Witness, line: Line) -> str:
    """Return the signs of a dependence as far as they are needed."""
    known = found.coefficients(line)
    return "".join(_mark(known.get(v)) for v in line.quintuple)


def _mark(value: int | None) -> str:
    return "." if value is None else "+" if value > 0 else "-" if value < 0 else "0"


def _example(found: Witness) -> str:
    """Read the first row aloud, and say what to do with five points in one plane."""
    line = next(line for line in found.lines if line.side)
    values = " and ".join(
        f"${value}$ for {vertex}" for vertex, value in found.coefficients(line).items()
    )
    text = (
        f"To check the row of {label(line.quintuple)}: the coefficients are {values}, and no "
        f"tetrahedron has {label(line.side)}."
    )
    if len(line.side) == 2:
        one, other = line.side
        plane = label(v for v in line.quintuple if v not in line.side)
        text += f" (That is, the plane {plane} separates {one} from {other}.)"
    if any(line.reason == IN_ONE_PLANE for line in found.lines):
        text += " Five points in one plane need no such vertices: other quintuples show the rest."
    return text


def _extreme_points(found: Witness) -> Part:
    text = (
        "Each vertex has a linear function that is larger there than at all others: the function, "
        "its value there, and the next largest."
    )
    cells = tuple(
        f"{support.vertex}: ${linear(support.function)}$: ${support.value} > {support.elsewhere}$"
        for support in found.supports
    )
    return Part("3. Extreme points", text, Table((("", cells),)))


def linear(function: Sequence[int]) -> str:
    """Return a linear function as a formula in x, y and z."""
    text = ""
    for factor, name in zip(function, "xyz", strict=True):
        if factor:
            sign = (" - " if text else "-") if factor < 0 else (" + " if text else "")
            text += sign + (str(abs(factor)) if abs(factor) > 1 else "") + name
    return text


def _jacobian(found: Witness) -> Part:
    corners = ", ".join(label(corner) for corner in CORNERS.values())
    text = (
        f"The trilinear map takes $(u, v, w)$ = {corners} to the points 1 to 8. Its Jacobian is "
        "the sum of 27 numbers $b_{ijk}$ times $B_i(u) B_j(v) B_k(w)$, where "
        "$B_0(t) = (1 - t)^2$, $B_1(t) = 2t(1 - t)$, $B_2(t) = t^2$. These products are "
        "non-negative and have the sum 1, so the Jacobian is positive if the 27 numbers are. "
        "$b_{ijk}$ is the mean of the determinants of an edge in direction $u$ "
        f"({_edges(0)}; 12 is $p_2 - p_1$), one in direction $v$ ({_edges(1)}) and one in "
        f"direction $w$ ({_edges(2)}), over all choices in which the other coordinates of the "
        "edges, 0 or 1, add up: the two $u$ to $i$, the two $v$ to $j$, the two $w$ to $k$. So "
        "$b_{000}$ is that of 12, 14, 15, and $b_{100}$ is the mean of those of 12, 14, 26 and of "
        "12, 23, 15. Below are the $8 b_{ijk}$, with $i$ = 0, 1, 2 along the rows."
    )
    head = ("", tuple(_blocks([f"$k = {k}$", "", ""] for k in range(3))))
    groups = (
        (
            f"$j = {j}$",
            tuple(_blocks([f"${found.bernstein[i, j, k]}$" for i in range(3)] for k in range(3))),
        )
        for j in range(3)
    )
    return Part("3. Jacobian", text, Table((head, *groups), 11), _not_mirrored(found))


def _edges(axis: int) -> str:
    """Return the edges in a direction, each from coordinate 0 to 1."""
    tails = (vertex for vertex, corner in CORNERS.items() if not corner[axis])
    return ", ".join(label((tail, across(tail, axis))) for tail in tails)


def _blocks(blocks: Iterable[Sequence[str]]) -> Iterator[str]:
    """Yield the cells of some blocks, and an empty one between any two."""
    for k, block in enumerate(blocks):
        yield from ("", *block) if k else block


def _not_mirrored(found: Witness) -> str:
    """Say of one triangle of the boundary how it is seen from inside; part 2 says the rest."""
    triangles = boundary_triangles(boundary_diagonals(found.tetrahedra)).values()
    first, second, third, apex = min(
        (*triangle[i:], *triangle[:i], *apex)
        for triangle in triangles
        for i in range(3)
        for t in found.tetrahedra
        for apex in [{*t}.difference(triangle)]
        if len(apex) == 1
    )
    return (
        f"The tetrahedra are not mirrored: $[{first}{second}{third}{apex}] > 0$, so seen from "
        f"{apex} the triangle {first}{second}{third} of the boundary runs counterclockwise, as it "
        "does in the reference cube seen from inside."
    )


def _tightest(found: Witness) -> Part:
    listed = ", ".join(
        f"$[{label(q)}] = {found.determinants[q]}$ ({share(found, q)})" for q in found.tightest
    )
    text = (
        f"Six times the volume of all tetrahedra, the sum of their determinants without signs, is "
        f"{found.whole}. Closest to zero, compared with that, are {listed}."
    )
    if found.bernstein:
        text += f" The least $8 b_{{ijk}}$ is {min(found.bernstein.values())}."
    return Part(f"{3 + (found.question != 'realizable')}. How tight", text)


def share(found: Witness, quadruple: Simplex) -> str:
    """Return how large a determinant is, compared with six times the whole volume."""
    return f"{float(Fraction(100 * abs(found.determinants[quadruple]), found.whole)):.2g}%"


# Formats.


def as_json(found: Witness, pattern: str) -> dict[str, Any]:
    """Return the witness as a JSON object."""
    record: dict[str, Any] = {
        "title": TITLES[found.question].format(pattern),
        "pattern": pattern,
        "question": found.question,
        "tetrahedra": [*map(label, found.tetrahedra)],
        "scales": [*found.scales],
        "points": [[*point] for point in found.points],
        "determinants": {label(q): value for q, value in found.determinants.items()},
        "lines": [_line_record(found, line) for line in found.lines],
        "whole": found.whole,
        "tightest": [*map(label, found.tightest)],
    }
    if found.supports:
        record["supports"] = [*map(_support_record, found.supports)]
    if found.bernstein:
        record["bernstein"] = {label(index): value for index, value in found.bernstein.items()}
    return record


def _line_record(found: Witness, line: Line) -> dict[str, Any]:
    return {
        "quintuple": label(line.quintuple),
        "side": label(line.side),
        "reason": line.reason,
        "coefficients": {str(v): value for v, value in found.coefficients(line).items()},
    }


def _support_record(support: Support) -> dict[str, Any]:
    return {
        "vertex": support.vertex,
        "function": [*support.function],
        "value": support.value,
        "elsewhere": support.elsewhere,
    }


def as_text(told: Page, width: int = 80) -> str:
    """Return the page as plain text."""
    out = [told.title]
    for part in told.parts:
        out += ["", *wrap(_plain(f"{part.heading}. {part.text}"), width)]
        if part.table:
            out += ["", *_text_rows(part.table, width)]
        if part.below:
            out += ["", *wrap(_plain(part.below), width)]
    return "\n".join(out)


def _plain(text: str) -> str:
    return re.sub(r"_\{(\w+)\}", r"_\1", re.sub("[$`]", "", text))


def _text_rows(table: Table, width: int) -> Iterator[str]:
    """Yield the rows of a table, aligned in columns."""
    number = columns_of(table, width)
    aligned = [(head, *cells) for head, cells in rows(table, number)]
    widths = [
        max(len(_plain(text)) for text in column) for column in zip_longest(*aligned, fillvalue="")
    ]
    if not widths[0]:
        aligned, widths = [row[1:] for row in aligned], widths[1:]
    for row in aligned:
        cells = (f"{_plain(text):<{size}}" for text, size in zip(row, widths, strict=False))
        yield f"  {'  '.join(cells)}".rstrip()


def rows(table: Table, number: int) -> Iterator[Group]:
    """Yield what is in front of a row, and its cells, at most so many."""
    for head, cells in table.groups:
        for i in range(0, len(cells), number):
            yield ("" if i else head), cells[i : i + number]


WIDE = 80
"""Markdown and LaTeX have as many columns as a text of this width."""


def columns_of(table: Table, width: int = WIDE) -> int:
    """Return how many columns of cells a table has on a page of some width."""
    lead = max(len(head) for head, _ in table.groups)
    cell = max(len(_plain(text)) for _, cells in table.groups for text in cells)
    return table.columns or max(1, (width - lead - 2 * bool(lead)) // (cell + 2))


def as_markdown(told: Page) -> str:
    """Return the page as Markdown with formulas that a code host sets."""
    out = [f"# {told.title}"]
    for part in told.parts:
        out += ["", f"## {part.heading}", "", part.text]
        if part.table:
            number = columns_of(part.table)
            out += ["", "|" + " |" * (number + 1), "|" + "---|" * (number + 1)]
            for head, cells in rows(part.table, number):
                padded = (head, *cells, *[""] * (number - len(cells)))
                out.append(f"| {' | '.join(padded)} |")
        if part.below:
            out += ["", part.below]
    return "\n".join(out)


def as_latex(told: Page) -> str:
    """Return the page as a LaTeX document."""
    out = [_HEAD_OF_PAGE, rf"\section*{{{_escaped(told.title)}}}"]
    for part in told.parts:
        out += ["", rf"\textbf{{{part.heading}.}} {_escaped(part.text)}"]
        if part.table:
            number = columns_of(part.table)
            out += ["", rf"\begin{{tabular}}{{l*{{{number}}}{{l}}}}"]
            for head, cells in rows(part.table, number):
                out.append(" & ".join(map(_escaped, (head, *cells))) + r" \\")
            out += [r"\end{tabular}"]
        if part.below:
            out += ["", _escaped(part.below)]
    return "\n".join([*out, LATEX_TAIL])


_HEAD_OF_PAGE = LATEX_HEAD.replace(
    r"\begin{document}",
    "\\geometry{margin=15mm}\n\\setlength{\\parskip}{1ex}\n\\pagestyle{empty}\n"
    "\\begin{document}\n\\small",
)


def _escaped(text: str) -> str:
    """Return text with what LaTeX takes for commands escaped, but in formulas."""
    parts = text.split("$")
    parts[::2] = [_code(part.replace("_", r"\_").replace("%", r"\%")) for part in parts[::2]]
    return "$".join(parts)


def _code(text: str) -> str:
    """Set what is between backticks with letters of one width, and keep signs apart."""
    parts = text.split("`")
    parts[1::2] = [rf"\texttt{{{part.replace('-', '{-}')}}}" for part in parts[1::2]]
    return "".join(parts)
