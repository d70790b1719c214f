"""What pictures are put together from: a closed hexahedron, pieces of it, a graph, a legend."""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import replace
from fractions import Fraction
from itertools import combinations, pairwise, product
from math import sqrt
from typing import NamedTuple, TypeAlias

from certify.atlas.draw.apart import pulled_apart
from certify.atlas.draw.layout import layout
from certify.atlas.draw.picture import (
    TYPES,
    Circle,
    Label,
    Line,
    Mark,
    Place,
    Polygon,
    tetrahedron_kind,
)
from certify.atlas.draw.scene import (
    HEXAHEDRON_EDGES,
    Face,
    between,
    edge_kind,
    inner_sides,
    painters_order,
    shell,
    stretches,
)
from certify.atlas.draw.space import Number, Spot, centre, cube_seen, minus, off_segment
from certify.graphs import Tetrahedra, decomposition, edges
from certify.kernel.cube import TETRAHEDRON_TYPES
from certify.kernel.hexahedron import VERTICES, Simplex, boundary_triangles
from certify.kernel.triangulation import label, triangles

Box: TypeAlias = tuple[float, float, float, float]
"""Left, top, width, height."""


class Frame(NamedTuple):
    """Where spots of a view are on the page: scaled, then moved; y goes down."""

    scale: float
    x: float
    y: float

    def place(self, spot: Sequence[Number]) -> Place:
        """Return the place of a spot."""
        return self.x + self.scale * float(spot[0]), self.y - self.scale * float(spot[1])


def fitted(spots: Iterable[Sequence[Number]], box: Box) -> Frame:
    """Return the frame in which the spots fill a box: left, top, width, height."""
    xs, ys, *_ = zip(*spots, strict=True)
    left, top, width, height = box
    low_x, high_x, low_y, high_y = (float(f(a)) for a in (xs, ys) for f in (min, max))
    scale = min(width / (high_x - low_x), height / (high_y - low_y))
    return Frame(
        scale,
        left + width / 2 - scale * (low_x + high_x) / 2,
        top + height / 2 + scale * (low_y + high_y) / 2,
    )


def shade(corners: Sequence[Spot]) -> str:
    """Return how bright a face is: the light comes from the left, above and behind the viewer."""
    a, b, c = ([float(x) for x in spot] for spot in corners[:3])
    u, v = [x - y for x, y in zip(b, a, strict=True)], [x - y for x, y in zip(c, a, strict=True)]
    n = (u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0])
    light = (-0.35 * n[0] + 0.65 * n[1] + 0.67 * n[2]) / (sqrt(sum(x * x for x in n)) or 1)
    return "lit" if light > 0.75 else "plain" if light > 0.4 else "shaded"


def _lines(
    ends: Iterable[tuple[Simplex, Spot, Spot]], faces: Sequence[Face], frame: Frame, hidden: bool
) -> list[Line]:
    """Return the parts of edges that are seen, or those that are hidden."""
    found = []
    for edge, a, b in ends:
        for stretch in stretches(a, b, faces):
            if stretch.hidden == hidden:
                ab = (frame.place(between(a, b, t)) for t in (stretch.start, stretch.end))
                found.append(Line(edge_kind(edge) + "-hidden" * hidden, tuple(ab)))
    order = ("inner", "diagonal", "hexahedron")
    return sorted(found, key=lambda line: order.index(line.kind.removesuffix("-hidden")))


_DIRECTIONS = tuple(
    (x / sqrt(x * x + y * y), y / sqrt(x * x + y * y))
    for x, y in (
        *((2, 0), (2, 1), (1, 1), (1, 2), (0, 2), (-1, 2), (-1, 1), (-2, 1)),
        *((-2, 0), (-2, -1), (-1, -1), (-1, -2), (0, -2), (1, -2), (1, -1), (2, -1)),
    )
)


def _numbers(
    places: Mapping[int, Place],
    lines: Sequence[Line],
    kind: str,
    size: float,
    before: Iterable[Mark] = (),
) -> list[Label]:
    """Return the numbers of vertices, each beside its vertex where there is most room."""
    middle = centre(list(places.values()))
    others = [mark.at for mark in before if isinstance(mark, Label)]
    labels: list[Label] = []
    for vertex, place in places.items():
        taken = [*places.values(), *others, *(label.at for label in labels)]
        away = minus(place, middle)
        out = [x / (sqrt(sum(y * y for y in away)) or 1.0) for x in away]
        best, at = -1e9, place
        for (dx, dy), far in product(_DIRECTIONS, (0.85 * size, 1.1 * size)):
            spot = (place[0] + far * dx, place[1] + far * dy)
            room = [off_segment(spot, *line.points) for line in lines]
            room += [off_segment(spot, other, other) - size / 3 for other in taken]
            liked = min(*room, 0.8 * size) + 0.15 * far * (dx * out[0] + dy * out[1])
            if liked > best + 1e-6:
                best, at = liked, spot
        labels.append(Label(kind, at, str(vertex)))
    return labels


def closed_marks(
    spots: Sequence[Spot],
    boundary: Mapping[Simplex, Spot],
    shown: Iterable[Simplex],
    box: Box,
) -> list[Mark]:
    """Return a hexahedron as if of glass: what is behind its boundary is seen through.

    boundary: its triangles, each with a point on its inner side; shown: the edges.
    """
    frame = fitted(spots, box)
    faces = shell(spots, boundary)
    ends = [(edge, spots[edge[0] - 1], spots[edge[1] - 1]) for edge in sorted(shown)]
    marks: list[Mark] = [
        Polygon(f"face-{shade(face.corners)}", tuple(map(frame.place, face.corners)))
        for face in painters_order(faces)
    ]
    behind, front = (_lines(ends, faces, frame, hidden) for hidden in (True, False))
    lines = [*behind, *front]
    places = {vertex: frame.place(spots[vertex - 1]) for vertex in VERTICES}
    hidden = {v: "-hidden" * _is_hidden(spots[v - 1], faces) for v in VERTICES}
    order = sorted(VERTICES, key=lambda v: hidden[v], reverse=True)
    dots = [Circle("vertex" + hidden[v], places[v], 3) for v in order]
    numbers = _numbers(places, lines, "number", 15)
    numbers = [replace(n, kind=n.kind + hidden[int(n.text)]) for n in numbers]
    return [*marks, *lines, *dots, *numbers]


def ball_marks(spots: Sequence[Spot], tetrahedra: Tetrahedra, box: Box) -> list[Mark]:
    """Return the closed hexahedron that the tetrahedra fill, with all their edges."""
    return closed_marks(spots, inner_sides(spots, tetrahedra), edges(tetrahedra), box)


def cube_marks(diagonals: frozenset[Simplex], box: Box) -> list[Mark]:
    """Return the template's cube with diagonals on its facets."""
    shown = HEXAHEDRON_EDGES | diagonals
    spots = cube_seen()
    middle = tuple(sum(axis) / Fraction(8) for axis in zip(*spots, strict=True))
    boundary = dict.fromkeys(boundary_triangles(diagonals), middle)
    return closed_marks(spots, boundary, shown, box)


def _is_hidden(spot: Spot, faces: Sequence[Face]) -> bool:
    """Is a point behind a face?"""
    return any(stretch.hidden for stretch in stretches(spot, spot, faces))


# Pulled apart.

ROOM = 25
"""How far pieces keep from each other: there are numbers between them."""


def apart_marks(spots: Sequence[Spot], tetrahedra: Tetrahedra, box: Box) -> list[Mark]:
    """Return the tetrahedra pulled apart, so that none hides another."""
    frame, moves = _exploded(spots, tetrahedra, box)
    marks: list[Mark] = []
    for tetrahedron, (x, y) in zip(tetrahedra, moves, strict=True):
        moved = frame._replace(x=frame.x + x, y=frame.y + y)
        marks += _piece_marks(spots, tetrahedron, moved, marks)
    return marks


def _exploded(spots: Sequence[Spot], tetrahedra: Tetrahedra, box: Box) -> tuple[Frame, list[Place]]:
    """Return the frame, the same for all pieces, and how far each is moved on the page.

    The gaps between pieces do not scale, so the scale is found in a few rounds.
    """
    left, top, width, height = box
    outlines = [[(float(spots[v - 1][0]), -float(spots[v - 1][1])) for v in t] for t in tetrahedra]
    xs, ys = zip(*(spot for outline in outlines for spot in outline), strict=True)
    scale = min(width / (max(xs) - min(xs)), height / (max(ys) - min(ys))) / 2
    for _ in range(6):
        on_page = [[(scale * x, scale * y) for x, y in outline] for outline in outlines]
        pieces = pulled_apart(on_page, ROOM, width / height)
        fits = min(width / pieces.size()[0], height / pieces.size()[1])
        if 0.96 < fits <= 1.0:
            break
        scale *= fits * (0.99 if fits < 1 else 1)
    xs, ys = zip(*pieces.moved(), strict=True)
    x, y = ((min(axis) + max(axis)) / 2 for axis in (xs, ys))
    return Frame(scale, left + width / 2 - x, top + height / 2 - y), pieces.moves


def _piece_marks(
    spots: Sequence[Spot], tetrahedron: Simplex, frame: Frame, before: Iterable[Mark] = ()
) -> list[Mark]:
    """Return one tetrahedron, its hidden edges too, and its numbers, off those made before."""
    corners = [spots[v - 1] for v in tetrahedron]
    inner = centre(corners)
    faces = shell(spots, dict.fromkeys(triangles(tetrahedron), inner))
    kind = TETRAHEDRON_TYPES[tetrahedron]
    marks: list[Mark] = [
        Polygon(tetrahedron_kind(kind, shade(f.corners)), tuple(map(frame.place, f.corners)))
        for f in faces
    ]
    ends = [(edge, spots[edge[0] - 1], spots[edge[1] - 1]) for edge in combinations(tetrahedron, 2)]
    behind, front = (_lines(ends, faces, frame, hidden) for hidden in (True, False))
    places = {v: frame.place(spots[v - 1]) for v in tetrahedron}
    lines = [*behind, *front]
    return [*marks, *lines, *_numbers(places, lines, "piece", 10, before)]


# The decomposition graph.

NODE = 17
"""The radius of a node."""


def _bowed(a: Place, b: Place, by: float) -> tuple[Place, ...]:
    """Return an arc from one place to another, which leaves the chord by so much at most."""
    dx, dy = b[0] - a[0], b[1] - a[1]
    length = sqrt(dx * dx + dy * dy) or 1.0
    steps = [k / 12 for k in range(1, 12)]
    bends = [4 * t * (1 - t) * by / length for t in steps]
    between_ends = (
        (a[0] + t * dx - h * dy, a[1] + t * dy + h * dx) for t, h in zip(steps, bends, strict=True)
    )
    return (a, *between_ends, b) if by else (a, b)


def _dashed(a: Place, b: Place, others: Sequence[Place], twin: bool) -> tuple[Place, ...]:
    """Return a dashed edge: straight, or an arc where it has a twin or meets other nodes.

    The arc is on the side that is farther from the middle.
    """
    middle = centre([a, b, *others])
    outwards = (a[0] + b[0] - 2 * middle[0], a[1] + b[1] - 2 * middle[1])
    side = 1 if (b[0] - a[0]) * outwards[1] - (b[1] - a[1]) * outwards[0] > -1e-6 else -1
    for by in (() if twin else (0,)) + (16, -16, 28, -28, 42, -42, 60, -60, 80, -80):
        arc = _bowed(a, b, side * by)
        if all(off_segment(o, *ends) > NODE + 4 for o in others for ends in pairwise(arc)):
            return arc
    return _bowed(a, b, 16 * side)


def graph_marks(tetrahedra: Tetrahedra, box: Box, dashes: bool = True) -> list[Mark]:
    """Return the edges of the decomposition graph, plain and perhaps dashed, then its nodes."""
    nodes = decomposition(tetrahedra)
    frame = fitted(layout(tetrahedra)[0], box)
    places = [frame.place(spot) for spot in layout(tetrahedra)[0]]
    marks: list[Mark] = [Line("plain", (places[a], places[b])) for a, b in nodes.plain]
    for a, b in nodes.dashed if dashes else ():
        others = [place for k, place in enumerate(places) if k not in {a, b}]
        arc = _dashed(places[a], places[b], others, (a, b) in nodes.plain)
        marks.append(Line("dashed", arc))
    for place, tetrahedron in zip(places, tetrahedra, strict=True):
        marks.append(Circle(tetrahedron_kind(TETRAHEDRON_TYPES[tetrahedron], "node"), place, NODE))
        marks.append(Label("piece", place, label(tetrahedron)))
    return marks


def in_cube_marks(tetrahedron: Simplex, box: Box) -> list[Mark]:
    """Return one tetrahedron in the template's cube, whose other edges are thin."""
    spots = cube_seen()
    frame = fitted(spots, box)
    marks: list[Mark] = [
        Line("hexahedron-hidden", (frame.place(spots[a - 1]), frame.place(spots[b - 1])))
        for a, b in sorted(HEXAHEDRON_EDGES - edges([tetrahedron]))
    ]
    return [*marks, *_piece_marks(spots, tetrahedron, frame)]


# Legends.


class Entry(NamedTuple):
    """What a legend explains: a kind of line or of node, in words."""

    kind: str
    says: str


EDGES = (
    Entry("hexahedron", "edge of the hexahedron"),
    Entry("diagonal", "diagonal of a facet"),
    Entry("inner", "inner edge, seen on a piece"),
    Entry("inner-hidden", "inner edge, behind"),
    Entry("hexahedron-hidden", "hidden"),
)
JOINED = (Entry("plain", "a triangle in common"), Entry("dashed", "on the same facet"))


def types_of(tetrahedra: Tetrahedra) -> list[Entry]:
    """Return what explains the colours of some tetrahedra."""
    present = {TETRAHEDRON_TYPES[tetrahedron] for tetrahedron in tetrahedra}
    return [Entry(tetrahedron_kind(t, "node"), t) for t in TYPES if t in present]


LETTER, SAMPLE = 5.6, 26
"""About how wide a letter of a legend is, and how wide a sample."""


def legend_marks(entries: Iterable[Entry], left: float, top: float, width: float) -> list[Mark]:
    """Return samples with words, in rows."""
    marks: list[Mark] = []
    x, y = left, top
    for kind, says in entries:
        need = SAMPLE + 8 + LETTER * len(says)
        if x > left and x + need > left + width:
            x, y = left, y + 18
        if kind.endswith("node"):
            marks.append(Circle(kind, (x + SAMPLE - 8, y), 6))
        else:
            marks.append(Line(kind, ((x, y), (x + SAMPLE, y))))
        marks.append(Label("legend", (x + SAMPLE + 6, y), says))
        x += need + 18
    return marks
