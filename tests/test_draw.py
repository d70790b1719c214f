"""Pictures show what the certificates say: what is seen is seen, and what is hidden is hidden."""

from collections import defaultdict
from collections.abc import Iterator
from fractions import Fraction
from functools import cache
from itertools import chain, combinations, pairwise, permutations, product
from typing import Any

import pytest

from certify.atlas.draw import marks, scene
from certify.atlas.draw.apart import pulled_apart
from certify.atlas.draw.drawings import closed, pair, view
from certify.atlas.draw.marks import ROOM, fitted
from certify.atlas.draw.picture import (
    Label,
    Line,
    Picture,
    Place,
)
from certify.atlas.draw.scene import Face, painters_order, witness
from certify.atlas.draw.space import Spot, off_segment
from certify.graphs import boundary, edges
from certify.kernel.certificate import PATTERN_NAMES, Certificate, read_certificate
from certify.kernel.chirotope import chirotope
from certify.kernel.evidence import Evidence
from certify.kernel.hexahedron import FACETS, Simplex
from certify.kernel.triangulation import label
from tests.commands import CHECKOUT

REALIZABLE = [name for name in PATTERN_NAMES if name not in {"15_A", "15_B", "15_J"}]
SOME = ["5_A", "8_E", "10_K", "12_U", "15_G", "15_K"]
"""A cube, a valid hexahedron, a thin one, three whose boundary is not convex."""


@cache
def certificate(name: str) -> Certificate:
    return read_certificate(name, Evidence(CHECKOUT).certificate(name))


def spots_of(shown: Certificate) -> tuple[Spot, ...]:
    found = witness(shown)
    assert found is not None
    return view(found[1], shown.tetrahedra)


def texts(picture: Picture, kind: str) -> list[str]:
    """Return the labels of a kind, in their order."""
    return [m.text for m in picture.marks if isinstance(m, Label) and m.kind.startswith(kind)]


def lines_of(picture: Picture) -> list[Line]:
    return [mark for mark in picture.marks if isinstance(mark, Line)]


# What is seen of a closed hexahedron, by another road: rays.


def determinant(a: Spot, b: Spot, c: Spot) -> Fraction:
    return Fraction(
        a[0] * (b[1] * c[2] - b[2] * c[1])
        - a[1] * (b[0] * c[2] - b[2] * c[0])
        + a[2] * (b[0] * c[1] - b[1] * c[0])
    )


def is_behind(point: Spot, triangle: tuple[Spot, ...]) -> bool:
    """Does the ray from a point to the viewer meet a triangle beyond the point?

    Cramer: point + h (0, 0, 1) = x a + y b + z c with x + y + z = 1; all exact.
    """
    a, b, c = triangle
    ab, ac, ap = (tuple(x - y for x, y in zip(other, a, strict=True)) for other in (b, c, point))
    whole = determinant(ab, ac, (0, 0, -1))
    if whole == 0:
        return False
    y = determinant(ap, ac, (0, 0, -1)) / whole
    z = determinant(ab, ap, (0, 0, -1)) / whole
    h = determinant(ab, ac, ap) / whole
    return y >= 0 and z >= 0 and y + z <= 1 and h > 0


def kind_of(edge: Simplex) -> str:
    """Return the kind of an edge, from the facets."""
    facet = next((facet for facet in FACETS if {*edge} <= {*facet}), None)
    if facet is None:
        return "inner"
    return "hexahedron" if (facet.index(edge[0]) - facet.index(edge[1])) % 2 else "diagonal"


Parts = dict[Simplex, list[tuple[float, float, str]]]
"""Edge -> the parameters between which lines lie on it, and their kind."""


def drawn(shown: Certificate) -> Parts:
    """Return what the thumbnail shows of the edges."""
    spots = spots_of(shown)
    places = dict(enumerate(map(fitted(spots, (24, 24, 192, 192)).place, spots), start=1))
    found = defaultdict(list)
    for line in lines_of(closed(shown)):
        ((a, b),) = (
            (a, b)
            for a, b in combinations(places, 2)
            if kind_of((a, b)) == line.kind.removesuffix("-hidden")
            and all(off_segment(p, places[a], places[b]) < 1e-6 for p in line.points)
        )
        (x, y), (u, v) = places[a], places[b]
        whole = (u - x) ** 2 + (v - y) ** 2
        t, r = (((p - x) * (u - x) + (q - y) * (v - y)) / whole for p, q in line.points)
        found[a, b].append((min(t, r), max(t, r), line.kind))
    return {edge: sorted(parts) for edge, parts in found.items()}


def wrong(shown: Certificate, parts: Parts) -> Iterator[str]:
    """Yield what is drawn of an edge as seen or hidden, but is not so."""
    spots = spots_of(shown)
    triangles = [tuple(spots[v - 1] for v in triangle) for triangle in boundary(shown.tetrahedra)]
    for edge, stretches in parts.items():
        a, b = (spots[vertex - 1] for vertex in edge)
        for start, end, kind in stretches:
            for k in (1, 4, 8):
                t = Fraction(start) + Fraction(k, 9) * (Fraction(end) - Fraction(start))
                point = tuple(x + t * (y - x) for x, y in zip(a, b, strict=True))
                hidden = any(is_behind(point, triangle) for triangle in triangles)
                if kind != kind_of(edge) + "-hidden" * hidden:
                    yield f"{edge} at {float(t)} is drawn as {kind}"


@pytest.mark.parametrize("name", REALIZABLE)
def test_lines_are_hidden_where_rays_say_so(name: str) -> None:
    """And all edges are drawn, each from one end to the other."""
    shown = certificate(name)
    parts = drawn(shown)
    assert [*wrong(shown, parts)] == []
    assert {*parts} == edges(shown.tetrahedra)
    for stretches in parts.values():
        ends = [0.0, *chain.from_iterable((start, end) for start, end, _ in stretches), 1.0]
        assert all(abs(a - b) < 1e-6 for a, b in zip(ends[::2], ends[1::2], strict=True))


@pytest.mark.parametrize("name", SOME)
@pytest.mark.parametrize("keep", [0, 1], ids=["no faces", "all but the largest face"])
def test_rays_tell_what_is_drawn_wrong(
    monkeypatch: pytest.MonkeyPatch, name: str, keep: int
) -> None:
    def without(*args: Any) -> list[Face]:
        faces = sorted(scene.shell(*args), key=area)
        return faces[:-1] if keep else []

    monkeypatch.setattr(marks, "shell", without)
    assert [*wrong(certificate(name), drawn(certificate(name)))]


@pytest.mark.parametrize("name", REALIZABLE)
def test_a_view_keeps_all_signs(name: str) -> None:
    """So what is drawn is realized by the points that the kernel accepted, and not mirrored."""
    shown = certificate(name)
    found = witness(shown)
    assert found is not None
    seen = [tuple(Fraction(x) for x in spot) for spot in spots_of(shown)]
    assert chirotope(seen) == chirotope(found[1])


def test_lines_do_not_pass_the_eye_by() -> None:
    """A segment behind, before and through a triangle; along its edge; and one that is a point."""
    face = Face(((0, 0, 0), (4, 0, 0), (0, 4, 0)))

    def hidden(a: Spot, b: Spot) -> list[tuple[float, float]]:
        parts = scene.stretches(a, b, [face])
        assert [parts[0].start, parts[-1].end] == [0, 1]
        assert all(one.end == other.start for one, other in pairwise(parts))
        return [(float(start), float(end)) for start, end, unseen in parts if unseen]

    assert hidden((-1, 1, -1), (7, 1, -1)) == [(0.125, 0.5)]
    assert hidden((-1, 1, 1), (7, 1, 1)) == []
    assert hidden((1, 1, -1), (1, 1, 3)) == [(0, 0.25)]
    assert hidden((0, 0, 0), (4, 0, 0)) == []
    assert hidden((0, 0, -1), (4, 0, -1)) == [(0, 1)]
    assert hidden((1, 1, -1), (1, 1, -1)) == [(0, 1)]
    assert hidden((4, 4, -1), (5, 5, -1)) == []


# The painter.


@pytest.mark.parametrize("name", SOME)
def test_the_painter_covers_nothing_that_is_before(name: str) -> None:
    """Where two painted parts overlap, the later one is nearer; and no part is lost."""
    shown = certificate(name)
    spots = spots_of(shown)
    faces = scene.shell(spots, scene.inner_sides(spots, shown.tetrahedra))
    assert paint_faults(list(painters_order(faces))) == 0
    areas = [sum(map(area, some)) for some in (faces, painters_order(faces))]
    assert areas[0] == areas[1] > 0


def test_four_bars_in_a_ring_are_cut() -> None:
    """Each lies before the next: without a cut no order is right."""
    faces = [
        Face(((-1, -1, 0), (9, -1, 4), (9, 1, 4), (-1, 1, 0))),
        Face(((9, -1, 0), (9, 9, 4), (7, 9, 4), (7, -1, 0))),
        Face(((9, 9, 0), (-1, 9, 4), (-1, 7, 4), (9, 7, 0))),
        Face(((-1, 9, 0), (-1, -1, 4), (1, -1, 4), (1, 9, 0))),
    ]
    assert all(area(face) > 0 for face in faces)
    assert all(paint_faults([faces[0], *order]) > 0 for order in permutations(faces[1:]))
    assert all(paint_faults([*order, faces[0]]) > 0 for order in permutations(faces[1:]))
    assert paint_faults([*painters_order(faces)]) == 0


def area(face: Face) -> Fraction:
    """Return twice the area of a part on the page."""
    pairs = zip(face.corners, (*face.corners[1:], face.corners[0]), strict=True)
    return Fraction(sum(a[0] * b[1] - a[1] * b[0] for a, b in pairs))


def height(face: Face, x: Fraction, y: Fraction) -> Fraction | None:
    """Return how near a part is to the viewer at a place strictly inside it."""
    corners = face.corners
    for i, corner in enumerate(corners):
        last = corners[i - 1]
        if (corner[0] - last[0]) * (y - last[1]) <= (corner[1] - last[1]) * (x - last[0]):
            return None
    a, b, c = corners[:3]
    ab, ac = (tuple(p - q for p, q in zip(other, a, strict=True)) for other in (b, c))
    down = ab[0] * ac[1] - ab[1] * ac[0]
    slope_x = (ab[1] * ac[2] - ab[2] * ac[1]) / Fraction(down)
    slope_y = (ab[2] * ac[0] - ab[0] * ac[2]) / Fraction(down)
    return Fraction(a[2] - slope_x * (x - a[0]) - slope_y * (y - a[1]))


def paint_faults(parts: list[Face]) -> int:
    """Return how often a part that is farther away is painted over a nearer one, on a grid."""
    xs, ys, _ = zip(*chain.from_iterable(part.corners for part in parts), strict=True)
    grid = [
        [Fraction(min(axis)) + Fraction(2 * k + 1, 32) * (max(axis) - min(axis)) for k in range(16)]
        for axis in (xs, ys)
    ]
    faults = 0
    for x, y in product(*grid):
        heights = [h for part in parts if (h := height(part, x, y)) is not None]
        faults += sum(later < earlier for earlier, later in pairwise(heights))
    return faults


# Pieces pulled apart.


@pytest.mark.parametrize("name", SOME)
def test_no_piece_hides_another(name: str) -> None:
    shown = certificate(name)
    places = [fitted(spots_of(shown), (0, 0, 120, 120)).place(spot) for spot in spots_of(shown)]
    whole = [[places[v - 1] for v in tetrahedron] for tetrahedron in shown.tetrahedra]
    assert any(distance(one, other) == 0 for one, other in combinations(whole, 2))
    moves = pulled_apart(whole, ROOM, 1.0).moves
    moved = [
        [(x + dx, y + dy) for x, y in piece] for piece, (dx, dy) in zip(whole, moves, strict=True)
    ]
    assert all(distance(one, other) >= ROOM / 3 for one, other in combinations(moved, 2))


def distance(one: list[Place], other: list[Place]) -> float:
    """Return the distance of two pieces' edges; 0 if an edge of one crosses one of the other."""
    least = 1e9
    for (a, b), (c, d) in product(combinations(one, 2), combinations(other, 2)):
        if turn(a, b, c) * turn(a, b, d) < 0 and turn(c, d, a) * turn(c, d, b) < 0:
            return 0.0
        ends = ((a, c, d), (b, c, d), (c, a, b), (d, a, b))
        least = min(least, *(off_segment(*three) for three in ends))
    return least


def turn(a: Place, b: Place, c: Place) -> float:
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])


@pytest.mark.parametrize("name", SOME)
def test_a_pair_names_all_vertices_of_all_pieces(name: str) -> None:
    shown = certificate(name)
    picture = pair(shown)
    assert sorted(texts(picture, "piece")) == sorted("".join(map(label, shown.tetrahedra)))
    assert sorted(texts(picture, "number")) == [*"12345678"]
