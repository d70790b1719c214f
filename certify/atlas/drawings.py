"""Pictures of a certificate that the kernel accepted: closed, pulled apart, and its graph."""

from collections.abc import Iterable, Mapping, Sequence
from fractions import Fraction
from math import sqrt
from typing import NamedTuple, TypeAlias

from certify.atlas.layout import layout
from certify.atlas.picture import (
    Circle,
    Label,
    Line,
    Mark,
    Picture,
    Place,
    Polygon,
    tetrahedron_kind,
)
from certify.atlas.scene import (
    CUBE,
    HEXAHEDRON_EDGES,
    Face,
    Number,
    Spot,
    apart,
    between,
    edge_kind,
    inner_sides,
    painters_order,
    piece_faces,
    shell,
    straight,
    stretches,
    viewed,
    witness,
)
from certify.graphs import Tetrahedra, decomposition, edges
from certify.kernel.certificate import Certificate
from certify.kernel.cube import TETRAHEDRON_TYPES
from certify.kernel.hexahedron import BOUNDARY_TYPES, Simplex, boundary_triangles
from certify.kernel.triangulation import boundary_diagonals, label

Box: TypeAlias = tuple[float, float, float, float]
"""Left, top, width, height."""


class Frame(NamedTuple):
    """Where spots of a view are on the page: scaled, then moved; y goes down."""

    scale: float
    x: float
    y: float

    def place(self, spot: Sequence[Number | float]) -> Place:
        """Return the place of a spot."""
        return self.x + self.scale * float(spot[0]), self.y - self.scale * float(spot[1])


def fitted(spots: Iterable[Sequence[Number | float]], box: Box) -> Frame:
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


def _segment_distance(p: Place, a: Place, b: Place) -> float:
    dx, dy = b[0] - a[0], b[1] - a[1]
    t = ((p[0] - a[0]) * dx + (p[1] - a[1]) * dy) / ((dx * dx + dy * dy) or 1.0)
    t = min(1.0, max(0.0, t))
    x, y = p[0] - a[0] - t * dx, p[1] - a[1] - t * dy
    return sqrt(x * x + y * y)


_DIRECTIONS = tuple(
    (x / sqrt(x * x + y * y), y / sqrt(x * x + y * y))
    for x, y in (
        *((2, 0), (2, 1), (1, 1), (1, 2), (0, 2), (-1, 2), (-1, 1), (-2, 1)),
        *((-2, 0), (-2, -1), (-1, -1), (-1, -2), (0, -2), (1, -2), (1, -1), (2, -1)),
    )
)


def _numbers(
    places: Sequence[Place], lines: Sequence[Line], seen: Sequence[bool], size: float
) -> list[Mark]:
    """Return the vertices as dots, and their numbers where there is most room beside them."""
    middle = (sum(x for x, _ in places) / 8, sum(y for _, y in places) / 8)
    marks: list[Mark] = []
    taken: list[Place] = []
    for vertex, place in enumerate(places):
        kind = "" if seen[vertex] else "-hidden"
        marks.append(Circle("vertex" + kind, place, 3))
        out = (place[0] - middle[0], place[1] - middle[1])
        best, at = -1e9, place
        for far in (0.9, 1.15):
            for dx, dy in _DIRECTIONS:
                spot = (place[0] + far * size * dx, place[1] + far * size * dy)
                room = [_segment_distance(spot, *line.points) for line in lines]
                room += [
                    sqrt((x - spot[0]) ** 2 + (y - spot[1]) ** 2) - size / 2
                    for x, y in (*taken, *places)
                ]
                outwards = (dx * out[0] + dy * out[1]) / (sqrt(out[0] ** 2 + out[1] ** 2) or 1)
                score = min(*room, 0.8 * size) + 0.12 * size * outwards - 0.2 * size * far
                if score > best + 1e-9:
                    best, at = score, spot
        taken.append(at)
        marks.append(Label("number" + kind, at, str(vertex + 1)))
    return marks


def _closed_marks(
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
    seen = [
        any(spot in face.corners for face in faces) and not _covered(spot, faces) for spot in spots
    ]
    places = [frame.place(spot) for spot in spots]
    return [*marks, *behind, *front, *_numbers(places, [*behind, *front], seen, 15)]


def _ball_marks(spots: Sequence[Spot], tetrahedra: Tetrahedra, box: Box) -> list[Mark]:
    """Return the closed hexahedron that the tetrahedra fill, with all their edges."""
    return _closed_marks(spots, inner_sides(spots, tetrahedra), edges(tetrahedra), box)


def _cube_marks(diagonals: frozenset[Simplex], box: Box) -> list[Mark]:
    """Return the template's cube with diagonals on its facets."""
    shown = HEXAHEDRON_EDGES | diagonals
    spots = straight(CUBE)
    middle = tuple(sum(axis) / Fraction(8) for axis in zip(*spots, strict=True))
    boundary = dict.fromkeys(boundary_triangles(diagonals), middle)
    return _closed_marks(spots, boundary, shown, box)


def _covered(spot: Spot, faces: Sequence[Face]) -> bool:
    """Is a point behind a face?"""
    return any(stretch.hidden for stretch in stretches(spot, spot, faces))


def closed(certificate: Certificate) -> Picture:
    """Return the hexahedron of a certificate's best points, its inner edges seen through it."""
    found = witness(certificate)
    if found is None:
        return unrealized(certificate)
    _, points = found
    tetrahedra = certificate.tetrahedra
    spots = viewed(points, frozenset(edges(tetrahedra)))
    marks = _ball_marks(spots, tetrahedra, (24, 24, 192, 192))
    return Picture(240, 240, tuple(marks), f"{certificate.pattern}, closed", "")


# Pulled apart.

APART = Fraction(6, 5)
"""How far each tetrahedron is moved: so many times its distance from the middle."""


def _apart_marks(spots: Sequence[Spot], tetrahedra: Tetrahedra, box: Box) -> list[Mark]:
    """Return the tetrahedra pulled apart, each with the names of its vertices."""
    pieces = apart(spots, tetrahedra, APART)
    frame = fitted([spot for piece in pieces for spot in piece], box)
    faces = piece_faces(pieces)
    types = [TETRAHEDRON_TYPES[tetrahedron] for tetrahedron in tetrahedra]
    marks: list[Mark] = [
        Polygon(
            tetrahedron_kind(types[face.piece], shade(face.corners)),
            tuple(map(frame.place, face.corners)),
        )
        for face in painters_order(faces)
    ]
    ends = [
        (tuple(tetrahedron[i] for i in pair), piece[pair[0]], piece[pair[1]])
        for tetrahedron, piece in zip(tetrahedra, pieces, strict=True)
        for pair in ((0, 1), (0, 2), (0, 3), (1, 2), (1, 3), (2, 3))
    ]
    lines = _lines(ends, faces, frame, hidden=False)
    return [*marks, *lines, *_piece_labels(tetrahedra, faces, lines, frame)]


_WITHIN = tuple((i / 12, j / 12, (12 - i - j) / 12) for i in range(1, 11) for j in range(1, 12 - i))
"""Places inside a triangle, as weights of its corners."""


def _piece_labels(
    tetrahedra: Tetrahedra, faces: Sequence[Face], lines: Sequence[Line], frame: Frame
) -> list[Mark]:
    """Return the vertices of each piece, where it shows most of itself."""
    marks: list[Mark] = []
    for piece, tetrahedron in enumerate(tetrahedra):
        best, at = 0.0, None
        for face in faces:
            if face.piece != piece:
                continue
            corners = [tuple(map(float, corner)) for corner in face.corners]
            others = [other for other in faces if other.piece != piece]
            for weights in _WITHIN:
                spot = tuple(
                    sum(w * c[i] for w, c in zip(weights, corners, strict=True)) for i in range(3)
                )
                x, y = frame.place(spot)
                room = min(
                    _segment_distance((x + dx, y), *line.points)
                    for line in lines
                    for dx in (-8, 0, 8)
                )
                if room > best and not _roughly_covered(spot, others):
                    best, at = room, (x, y)
        if at is not None and best > 3:
            marks.append(Label("piece", at, label(tetrahedron)))
    return marks


def _roughly_covered(spot: Sequence[float], faces: Sequence[Face]) -> bool:
    """Is a point behind a face, as far as rounded numbers tell?"""
    exact = tuple(Fraction(x) for x in spot)
    return _covered(exact, faces)


def pair(certificate: Certificate) -> Picture:
    """Return the tetrahedra pulled apart, and beside them the closed hexahedron."""
    found = witness(certificate)
    if found is None:
        return unrealized(certificate)
    _question, points = found
    tetrahedra = certificate.tetrahedra
    spots = viewed(points, frozenset(edges(tetrahedra)))
    marks = _apart_marks(spots, tetrahedra, (20, 20, 420, 420))
    marks += _ball_marks(spots, tetrahedra, (500, 80, 300, 300))
    return Picture(840, 460, tuple(marks), certificate.pattern, "")


# The decomposition graph.

NODE = 17
"""The radius of a node."""


def _bowed(a: Place, b: Place, by: float) -> tuple[Place, ...]:
    """Return an arc from one place to another, which leaves the chord by so much at most."""
    dx, dy = b[0] - a[0], b[1] - a[1]
    length = sqrt(dx * dx + dy * dy) or 1.0
    bend = [4 * k / 12 * (1 - k / 12) * by / length for k in range(13)]
    return tuple(
        (a[0] + k / 12 * dx - h * dy, a[1] + k / 12 * dy + h * dx) for k, h in enumerate(bend)
    )


def _graph_marks(tetrahedra: Tetrahedra, box: Box) -> list[Mark]:
    """Return the edges of the decomposition graph, then its nodes."""
    nodes = decomposition(tetrahedra)
    frame = fitted(layout(tetrahedra)[0], box)
    places = [frame.place(spot) for spot in layout(tetrahedra)[0]]
    marks: list[Mark] = [Line("plain", (places[a], places[b])) for a, b in nodes.plain]
    for number, (a, b) in enumerate(nodes.dashed):
        before = nodes.dashed[:number].count((a, b)) + nodes.plain.count((a, b))
        marks.append(
            Line(
                "dashed",
                _bowed(places[a], places[b], (0, 16, -16)[before])
                if before
                else (places[a], places[b]),
            )
        )
    for place, tetrahedron in zip(places, tetrahedra, strict=True):
        marks.append(Circle(tetrahedron_kind(TETRAHEDRON_TYPES[tetrahedron], "node"), place, NODE))
        marks.append(Label("piece", place, label(tetrahedron)))
    return marks


def graph(tetrahedra: Tetrahedra) -> Picture:
    """Return the decomposition graph: plain and dashed edges, nodes coloured by type."""
    return Picture(
        460, 460, tuple(_graph_marks(tetrahedra, (40, 40, 380, 380))), "Decomposition graph"
    )


# Boundaries.


def boundary_type(letter: str) -> Picture:
    """Return the representative boundary of a type on the template's cube."""
    diagonals = BOUNDARY_TYPES[letter]
    names = ", ".join(map(label, sorted(diagonals)))
    says = f"The cube 12345678 with the diagonals {names}."
    marks = _cube_marks(diagonals, (24, 24, 192, 192))
    return Picture(240, 240, tuple(marks), f"Boundary of type {letter}", says)


def unrealized(certificate: Certificate) -> Picture:
    """Return, of a pattern without points: its boundary on the cube, its graph, and the words."""
    tetrahedra = certificate.tetrahedra
    marks = [
        *_graph_marks(tetrahedra, (40, 40, 400, 380)),
        *_cube_marks(boundary_diagonals(tetrahedra), (540, 90, 240, 240)),
        Label("statement", (660, 400), "no points realize it"),
    ]
    return Picture(840, 460, tuple(marks), f"{certificate.pattern}: no points realize it", "")
