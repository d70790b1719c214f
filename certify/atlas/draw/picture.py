"""A picture is a list of marks on a page; here it becomes SVG.

What a mark looks like is said by its kind, in one table, for all formats. In a web page the page
brings the style sheet, whose colours follow light and dark; a file of its own brings its own.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from html import escape
from itertools import groupby
from typing import NamedTuple, TypeAlias

Place: TypeAlias = tuple[float, float]
"""To the right and downwards, in units of a pixel."""


@dataclass(frozen=True)
class Polygon:
    """A filled polygon."""

    kind: str
    points: tuple[Place, ...]


@dataclass(frozen=True)
class Line:
    """A line through some points."""

    kind: str
    points: tuple[Place, ...]


@dataclass(frozen=True)
class Circle:
    """A filled circle."""

    kind: str
    centre: Place
    radius: float


@dataclass(frozen=True)
class Label:
    """Text whose middle, or start, is somewhere."""

    kind: str
    at: Place
    text: str


Mark: TypeAlias = Polygon | Line | Circle | Label


@dataclass(frozen=True)
class Picture:
    """Marks, the first at the bottom, on a page; ``title`` and ``says`` tell what they show."""

    width: float
    height: float
    marks: tuple[Mark, ...]
    title: str
    says: str = ""


# What marks look like.

TYPES = ("corner", "staircase", "slanted", "core", "core diagonal", "boundary")
"""The types of tetrahedra, in the order of their colours."""

SHADES = ("lit", "plain", "shaded")

PALETTE: dict[str, tuple[str, str]] = {
    "paper": ("#ffffff", "#14181f"),
    "ink": ("#1d2530", "#e8ecf2"),
    "faint": ("#97a1ae", "#78828f"),
    "diagonal": ("#1f5fa8", "#79b4f2"),
    "inner": ("#b5461b", "#f29a6b"),
    "face-lit": ("#f6f8fa", "#232a34"),
    "face-plain": ("#edf0f4", "#1e252e"),
    "face-shaded": ("#e3e8ee", "#1a2028"),
    "corner-lit": ("#bcdcf5", "#4d86ad"),
    "corner-plain": ("#a3cdec", "#3d7298"),
    "corner-shaded": ("#88b9dc", "#306083"),
    "staircase-lit": ("#c8e6b5", "#5f9150"),
    "staircase-plain": ("#b0d79a", "#4e7d40"),
    "staircase-shaded": ("#97c47f", "#3f6a33"),
    "slanted-lit": ("#fbe3a4", "#a58a3a"),
    "slanted-plain": ("#f2d27e", "#8f762c"),
    "slanted-shaded": ("#e0bd62", "#786221"),
    "core-lit": ("#f5bfae", "#ab6551"),
    "core-plain": ("#e9a590", "#955442"),
    "core-shaded": ("#d68b75", "#7e4536"),
    "boundary-lit": ("#c9e4e2", "#5b8f8c"),
    "boundary-plain": ("#b2d6d3", "#4a7b78"),
    "boundary-shaded": ("#9ac6c2", "#3b6663"),
    "core-diagonal-lit": ("#d9c6ee", "#7f69a3"),
    "core-diagonal-plain": ("#c6afe2", "#6c578f"),
    "core-diagonal-shaded": ("#b298d2", "#5a477a"),
}
"""Colour -> as it is by day and by night."""


class Look(NamedTuple):
    """How marks of a kind are drawn: colours by name, lengths in pixels; weight of text."""

    fill: str | None = None
    stroke: str | None = None
    width: float = 0
    dash: tuple[float, ...] = ()
    size: float = 0
    bold: bool = False
    start: bool = False


def tetrahedron_kind(type_: str, what: str) -> str:
    """Return the kind of mark for a tetrahedron of a type: one of SHADES, or "node"."""
    return f"{type_.replace(' ', '-')}-{what}"


_TYPED = [tetrahedron_kind(type_, "") for type_ in TYPES]

LOOKS: dict[str, Look] = {
    **{
        f"{name}{s}": Look(f"{name}{s}", f"{name}{s}", 0.4)
        for name in ("face-", *_TYPED)
        for s in SHADES
    },
    **{f"{name}node": Look(f"{name}plain", "ink", 1.2) for name in _TYPED},
    "hexahedron": Look(stroke="ink", width=2.2),
    "diagonal": Look(stroke="diagonal", width=1.4),
    "inner": Look(stroke="inner", width=1.2),
    "hexahedron-hidden": Look(stroke="faint", width=1.8, dash=(5, 4)),
    "diagonal-hidden": Look(stroke="diagonal", width=1.0, dash=(4, 4)),
    "inner-hidden": Look(stroke="inner", width=1.4, dash=(0.1, 3.2)),
    "vertex": Look(fill="ink", stroke="paper", width=1),
    "vertex-hidden": Look(fill="faint", stroke="paper", width=1),
    "number": Look(fill="ink", size=14, bold=True),
    "number-hidden": Look(fill="faint", size=14, bold=True),
    "piece": Look(fill="ink", size=9),
    "plain": Look(stroke="ink", width=1.8),
    "dashed": Look(stroke="faint", width=1.6, dash=(6, 4)),
    "name": Look(fill="ink", size=15, bold=True),
    "caption": Look(fill="ink", size=12),
    "legend": Look(fill="ink", size=11, start=True),
    "statement": Look(fill="inner", size=13, bold=True),
}
"""Kind of mark -> how it is drawn."""

# SVG.


def _number(x: float) -> str:
    text = f"{x:.1f}".removesuffix(".0")
    return "0" if text == "-0" else text


def _path(points: Sequence[Place]) -> str:
    return "M" + "L".join(f"{_number(x)} {_number(y)}" for x, y in points)


def _elements(marks: Sequence[Mark]) -> Iterator[str]:
    """Yield an element a mark, but one for all lines of a kind that follow each other."""
    for (form, kind), run in groupby(marks, key=lambda mark: (type(mark), mark.kind)):
        if form is Line:
            data = "".join(_path(line.points) for line in run if isinstance(line, Line))
            yield f'<path class="{kind}" d="{data}"/>'
            continue
        for mark in run:
            match mark:
                case Polygon():
                    yield f'<path class="{kind}" d="{_path(mark.points)}Z"/>'
                case Circle():
                    x, y = map(_number, mark.centre)
                    yield f'<circle class="{kind}" cx="{x}" cy="{y}" r="{_number(mark.radius)}"/>'
                case Label():
                    x = _number(mark.at[0])
                    y = _number(mark.at[1] + BASELINE * LOOKS[kind].size)
                    yield f'<text class="{kind}" x="{x}" y="{y}">{escape(mark.text)}</text>'


BASELINE = 0.35
"""How far below the middle of a digit its baseline is, as part of the size of the font."""


def svg(picture: Picture, standalone: bool = True) -> str:
    """Return the picture as SVG: a file with its own style, or an element for a web page."""
    w, h = _number(picture.width), _number(picture.height)
    head = f'viewBox="0 0 {w} {h}" width="{w}" height="{h}" role="img" class="drawing"'
    words = f"<title>{escape(picture.title)}</title>"
    if picture.says:
        words += f"<desc>{escape(picture.says)}</desc>"
    body = "\n".join(_elements(picture.marks))
    if not standalone:
        return f"<svg {head}>{words}\n{body}\n</svg>\n"
    kinds = {mark.kind for mark in picture.marks}
    return (
        f'<svg xmlns="http://www.w3.org/2000/svg" {head}>{words}\n<style>{_own_style(kinds)}'
        f'</style>\n<rect class="page" width="{w}" height="{h}"/>\n{body}\n</svg>\n'
    )


def _rule(kind: str, colour: str = "{}") -> str:
    """Return the declarations of a kind, where ``colour`` is made of the name of a colour."""
    look = LOOKS[kind]
    parts = [f"fill:{colour.format(look.fill) if look.fill else 'none'}"]
    if look.stroke:
        parts += [f"stroke:{colour.format(look.stroke)}", f"stroke-width:{look.width}"]
    if look.dash:
        parts.append(f"stroke-dasharray:{' '.join(map(str, look.dash))}")
    if look.size:
        parts.append(f"font-size:{look.size}px")
    if look.bold:
        parts.append("font-weight:600")
    if look.start:
        parts.append("text-anchor:start")
    return ";".join(parts)


_COMMON = (
    "path{stroke-linecap:round;stroke-linejoin:round}",
    "text{font-family:system-ui,sans-serif;text-anchor:middle}",
)


def _own_style(kinds: set[str]) -> str:
    """Return a style sheet with colours written out, as some programs know no variables."""
    shown = [kind for kind in LOOKS if kind in kinds]
    day, night = ({name: pair[k] for name, pair in PALETTE.items()} for k in (0, 1))
    rules = [*_COMMON, f".page{{fill:{day['paper']}}}"]
    dark = [f".page{{fill:{night['paper']}}}"]
    for kind in shown:
        rule = _rule(kind, "@{}@")
        rules.append(f".{kind}{{{_coloured(rule, day)}}}")
        parts = (part for part in _coloured(rule, night).split(";") if "#" in part)
        dark.append(f".{kind}{{{';'.join(parts)}}}")
    return "".join([*rules, "@media(prefers-color-scheme:dark){", *dark, "}"])


def _coloured(rule: str, colours: dict[str, str]) -> str:
    for name, value in colours.items():
        rule = rule.replace(f"@{name}@", value)
    return rule


def _style_sheet() -> str:
    day, night = (
        "".join(f"--drawing-{name}:{pair[k]};" for name, pair in PALETTE.items()) for k in (0, 1)
    )
    lines = [
        f".drawing{{{day}}}",
        f"@media(prefers-color-scheme:dark){{.drawing{{{night}}}}}",
        f"[data-theme=light] .drawing{{{day}}}",
        f"[data-theme=dark] .drawing{{{night}}}",
        *(f".drawing {rule}" for rule in _COMMON),
        *(f".drawing .{kind}{{{_rule(kind, 'var(--drawing-{})')}}}" for kind in LOOKS),
    ]
    return "\n".join(lines) + "\n"


STYLE_SHEET = _style_sheet()
"""The style of pictures inside a web page.

It follows the system's light and dark, or an attribute data-theme="light" or "dark" of an element
around them. A page may set the variables, such as --drawing-paper, on .drawing itself.
"""
