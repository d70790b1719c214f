"""Draw a certificate's triangulation, whole and pulled apart, as SVG.

    python docs/picture.py 5_A 15_E > docs/picture.svg

One row a pattern. The points are those of the certificate's last "yes" (a valid hexahedron, where
there is one); the projection is parallel, and each tetrahedron moves away from the centre.
"""

import colorsys
import sys
from collections.abc import Sequence
from itertools import combinations
from math import cos, hypot, radians, sin
from pathlib import Path

from certify.kernel.certificate import Yes
from certify.kernel.check import check_pattern
from certify.kernel.hexahedron import FACETS, Simplex

Vector = tuple[float, ...]

ROOT = Path(__file__).resolve().parents[1]
SIZE = 380
TILT = radians(20)
DEFAULT_VIEW = (24, 1.0)
VIEW = {"5_A": (24, 1.0), "15_E": (90, 1.9)}
"""Pattern -> how far to turn it, in degrees, and how far apart to pull it; what looks good."""


def minus(a: Vector, b: Vector) -> Vector:
    """Return a - b."""
    return tuple(x - y for x, y in zip(a, b, strict=True))


def centre(points: Sequence[Vector]) -> Vector:
    """Return the mean of some points."""
    return tuple(sum(column) / len(points) for column in zip(*points, strict=True))


def cross(a: Vector, b: Vector) -> Vector:
    """Return the vector product."""
    return tuple(a[i - 2] * b[i - 1] - a[i - 1] * b[i - 2] for i in range(3))


def dot(a: Vector, b: Vector) -> float:
    """Return the scalar product."""
    return sum(x * y for x, y in zip(a, b, strict=True))


def turned(point: Vector, degrees: float) -> Vector:
    """Return the point as the viewer has it: to the right, up, and towards the viewer."""
    x, y, z = point
    angle = radians(degrees)
    right, away = x * cos(angle) - y * sin(angle), x * sin(angle) + y * cos(angle)
    return right, z * cos(TILT) + away * sin(TILT), z * sin(TILT) - away * cos(TILT)


def certificate(pattern: str) -> tuple[list[Vector], Sequence[Simplex]]:
    """Return the points, centred and scaled to a radius of one, and the tetrahedra.

    Only what the kernel accepts is drawn.
    """
    verdict = check_pattern(ROOT, pattern)
    if verdict.fault is not None:
        sys.exit(f"rejected: {verdict.fault}")
    accepted = verdict.certificate
    assert accepted is not None
    answers = [answer for answer in accepted.answers.values() if isinstance(answer, Yes)]
    turn, _ = VIEW.get(pattern, DEFAULT_VIEW)
    points = [turned(tuple(map(float, point)), turn) for point in answers[-1].points]
    middle = centre(points)
    points = [minus(point, middle) for point in points]
    radius = max(hypot(*point) for point in points)
    return [tuple(x / radius for x in point) for point in points], accepted.tetrahedra


def place(point: Vector, column: float, row: float, scale: float) -> str:
    """Return "x,y" on the page."""
    x, y = (column + 0.5) * SIZE + scale * point[0], (row + 0.5) * SIZE - scale * point[1]
    return f"{x:.1f},{y:.1f}"


def shade(hue: float, normal: Vector) -> str:
    """Return the colour of a face: brighter the more it looks up, to the left and to the viewer."""
    light = dot(normal, (-0.35, 0.6, 0.72)) / hypot(*normal)
    red, green, blue = colorsys.hls_to_rgb(hue, 0.56 + 0.20 * light, 0.55)
    return f"#{round(255 * red):02x}{round(255 * green):02x}{round(255 * blue):02x}"


def whole(points: list[Vector], tetrahedra: Sequence[Simplex], row: int) -> list[str]:
    """Draw the edges, those of the hexahedron's boundary in front of the others."""
    frame = {frozenset((q[i - 1], q[i])) for q in FACETS for i in range(4)}
    diagonals = {frozenset(pair) for q in FACETS for pair in ((q[0], q[2]), (q[1], q[3]))}
    edges = {frozenset(edge) for t in tetrahedra for edge in combinations(t, 2)}
    styles = (
        (edges - frame - diagonals, "inner"),
        (edges & diagonals, "diagonal"),
        (frame, "edge"),
    )
    lines = []
    for kind, style in styles:
        for edge in sorted(kind, key=sorted):
            ends = " ".join(place(points[v - 1], 0, row, 145) for v in sorted(edge))
            lines.append(f'<polyline class="{style}" points="{ends}"/>')
    for vertex, point in enumerate(points, start=1):
        x, y = place(point, 0, row, 145).split(",")
        lines.append(
            f'<circle cx="{x}" cy="{y}" r="10"/><text x="{x}" y="{y}" dy="4.5">{vertex}</text>'
        )
    return lines


def apart(points: list[Vector], tetrahedra: Sequence[Simplex], row: int, by: float) -> list[str]:
    """Draw the tetrahedra, each moved away from the centre, the farthest first."""
    pieces = []
    for number, tetrahedron in enumerate(tetrahedra):
        corners = [points[v - 1] for v in tetrahedron]
        middle = centre(corners)
        moved = [tuple(x + by * m for x, m in zip(c, middle, strict=True)) for c in corners]
        pieces.append((middle[2], number / len(tetrahedra), moved))
    lines = []
    for _, hue, moved in sorted(pieces):
        for a, b, c in combinations(moved, 3):
            normal = cross(minus(b, a), minus(c, a))
            if dot(normal, minus(a, centre(moved))) < 0:
                normal = minus((0, 0, 0), normal)
            if normal[2] > 0:
                face = " ".join(place(point, 1.2, row, 178 / (1 + by / 2)) for point in (a, b, c))
                lines.append(f'<polygon fill="{shade(hue, normal)}" points="{face}"/>')
    return lines


def main(patterns: list[str]) -> None:
    """Write the picture to standard output."""
    width, height = round(2.25 * SIZE), SIZE * len(patterns)
    body = []
    for row, pattern in enumerate(patterns):
        points, tetrahedra = certificate(pattern)
        body += whole(points, tetrahedra, row)
        body += apart(points, tetrahedra, row, VIEW.get(pattern, DEFAULT_VIEW)[1])
        body.append(f'<text class="name" x="34" y="{row * SIZE + 40}">{pattern}</text>')
    style = (
        "polyline{fill:none;stroke-linecap:round}.edge{stroke:#1c2430;stroke-width:2.6}"
        ".diagonal{stroke:#3b6ea8;stroke-width:1.6}.inner{stroke:#c2603a;stroke-width:1.6;"
        "stroke-dasharray:5 4}polygon{stroke:#fff;stroke-width:1.2;stroke-linejoin:round;"
        "fill-opacity:.94}circle{fill:#1c2430}text{font:bold 12px sans-serif;fill:#fff;"
        "text-anchor:middle}.name{font-size:18px;fill:#1c2430;text-anchor:start}"
    )
    print(f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width} {height}">')
    print(f"<style>{style}</style>")
    print(f'<rect width="{width}" height="{height}" rx="16" fill="#f7f5f0"/>')
    print(*body, "</svg>", sep="\n")


if __name__ == "__main__":
    main(sys.argv[1:])
