"""Pictures show what the certificates say: what is seen is seen, and what is hidden is hidden."""

import subprocess
import sys
from collections import defaultdict
from collections.abc import Iterator
from fractions import Fraction
from importlib.util import find_spec
from itertools import chain, combinations, pairwise, product
from pathlib import Path
from xml.etree import ElementTree

import pytest
from click.testing import CliRunner

from certify.atlas import marks, scene
from certify.atlas.apart import pulled_apart
from certify.atlas.drawings import boundary_type, closed, graph, pair, unrealized, view
from certify.atlas.figures import FIGURES, figure
from certify.atlas.layout import layout, permutations_of
from certify.atlas.marks import NODE, ROOM, Frame, fitted
from certify.atlas.picture import LOOKS, PALETTE, STYLE_SHEET, Circle, Label, Line, Picture, svg
from certify.atlas.scene import Face, painters_order, witness
from certify.atlas.space import Spot, off_segment
from certify.cli import cli
from certify.graphs import boundary, decomposition, edges
from certify.kernel.certificate import PATTERN_NAMES, Certificate, read_certificate
from certify.kernel.check import Rejected
from certify.kernel.chirotope import chirotope
from certify.kernel.cube import TETRAHEDRON_TYPES
from certify.kernel.evidence import Evidence
from certify.kernel.hexahedron import BOUNDARY_TYPES, FACETS, SYMMETRIES, Simplex, image
from certify.kernel.triangulation import label
from tests.commands import CHECKOUT, assert_rejects, assert_usage_error, run

UNREALIZABLE = ("15_A", "15_B", "15_J")
REALIZABLE = [name for name in PATTERN_NAMES if name not in UNREALIZABLE]
SOME = ["5_A", "8_E", "10_K", "12_U", "15_G", "15_K"]
"""A cube, a valid hexahedron, a thin one, three whose boundary is not convex."""

needs_matplotlib = pytest.mark.skipif(
    find_spec("matplotlib") is None, reason="matplotlib is not installed"
)


def certificate(name: str) -> Certificate:
    return read_certificate(name, Evidence(CHECKOUT).certificate(name))


def spots_of(shown: Certificate) -> tuple[Spot, ...]:
    found = witness(shown)
    assert found is not None
    return view(found[1], shown.tetrahedra)


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


def drawn(
    picture: Picture, frame: Frame, shown: Certificate
) -> dict[Simplex, list[tuple[float, float, str]]]:
    """Return, for each edge, the parameters between which lines lie on it, and their kind."""
    places = [frame.place(spot) for spot in spots_of(shown)]
    found = defaultdict(list)
    for line in picture.marks:
        if not isinstance(line, Line):
            continue
        start, end = line.points
        (edge,) = (
            edge
            for edge in combinations(range(1, 9), 2)
            if kind_of(edge) == line.kind.removesuffix("-hidden")
            and all(
                off_segment(p, places[edge[0] - 1], places[edge[1] - 1]) < 1e-6
                for p in (start, end)
            )
        )
        a, b = (places[vertex - 1] for vertex in edge)
        axis = 0 if abs(a[0] - b[0]) > abs(a[1] - b[1]) else 1
        t, u = ((p[axis] - a[axis]) / (b[axis] - a[axis]) for p in (start, end))
        found[edge].append((min(t, u), max(t, u), line.kind))
    return {edge: sorted(parts) for edge, parts in found.items()}


def wrong(shown: Certificate) -> Iterator[str]:
    """Yield what is drawn of an edge as seen or hidden, but is not so."""
    spots = spots_of(shown)
    frame = fitted(spots, (24, 24, 192, 192))
    triangles = [tuple(spots[v - 1] for v in triangle) for triangle in boundary(shown.tetrahedra)]
    for edge, parts in drawn(closed(shown), frame, shown).items():
        a, b = (spots[vertex - 1] for vertex in edge)
        for start, end, kind in parts:
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
    assert [*wrong(shown)] == []
    parts = drawn(closed(shown), fitted(spots_of(shown), (24, 24, 192, 192)), shown)
    assert {*parts} == edges(shown.tetrahedra)
    for stretches in parts.values():
        ends = [0.0, *chain.from_iterable((start, end) for start, end, _ in stretches), 1.0]
        assert all(abs(a - b) < 1e-6 for a, b in zip(ends[::2], ends[1::2], strict=True))


@pytest.mark.parametrize("spoil", ["a face is missing", "all that is behind is seen"])
def test_rays_tell_what_is_drawn_wrong(monkeypatch: pytest.MonkeyPatch, spoil: str) -> None:
    shell = scene.shell
    keep = 1 if spoil == "a face is missing" else 99
    monkeypatch.setattr(marks, "shell", lambda *args: shell(*args)[keep:])
    assert [*wrong(certificate("12_U"))]


@pytest.mark.parametrize("name", REALIZABLE)
def test_a_view_keeps_all_signs(name: str) -> None:
    """So what is drawn is realized by the points that the kernel accepted, and not mirrored."""
    shown = certificate(name)
    found = witness(shown)
    assert found is not None
    seen = [tuple(map(Fraction, spot)) for spot in spots_of(shown)]
    assert chirotope(seen) == chirotope(found[1])


def test_lines_do_not_pass_the_eye_by() -> None:
    """A segment behind, before and through a triangle; along its edge; and one that is a point."""
    face = Face(((0, 0, 0), (4, 0, 0), (0, 4, 0)))

    def hidden(a: Spot, b: Spot) -> list[tuple[Fraction, Fraction]]:
        parts = scene.stretches(a, b, [face])
        assert [(parts[0].start, parts[-1].end)] == [(0, 1)]
        assert all(one.end == other.start for one, other in pairwise(parts))
        return [(start, end) for start, end, unseen in parts if unseen]

    assert hidden((-1, 1, -1), (7, 1, -1)) == [(Fraction(1, 8), Fraction(1, 2))]
    assert hidden((-1, 1, 1), (7, 1, 1)) == []
    assert hidden((1, 1, -1), (1, 1, 3)) == [(0, Fraction(1, 4))]
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


def test_three_faces_in_a_ring_are_cut() -> None:
    """Each lies before the next: without a cut no order is right."""
    bar: list[Spot] = [(0, 0, 0), (6, 0, 3), (6, 1, 3)]
    turned = [((x, y, z), (-x - y, x, z), (y, -x - y, z)) for x, y, z in bar]
    moved = [
        tuple((a + i, b - i, c) for a, b, c in corners)
        for i, corners in enumerate(zip(*turned, strict=True))
    ]
    faces = [Face(corners if area(Face(corners)) > 0 else corners[::-1]) for corners in moved]
    assert paint_faults(list(painters_order(faces))) == 0


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
    return a[2] - slope_x * (x - a[0]) - slope_y * (y - a[1])


def paint_faults(parts: list[Face]) -> int:
    """Return how often a part that is farther away is painted over a nearer one, on a grid."""
    xs, ys, _ = zip(*chain.from_iterable(part.corners for part in parts), strict=True)
    grid = [
        [Fraction(min(axis)) + Fraction(2 * k + 1, 48) * (max(axis) - min(axis)) for k in range(24)]
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
    flat = [
        [
            (float(x) / 1e3, float(y) / 1e3)
            for x, y, _ in map(spots_of(shown).__getitem__, (v - 1 for v in t))
        ]
        for t in shown.tetrahedra
    ]
    size = max(x for piece in flat for x, _ in piece) - min(x for piece in flat for x, _ in piece)
    flat = [[(100 * x / size, 100 * y / size) for x, y in piece] for piece in flat]
    assert any(distance(one, other) == 0 for one, other in combinations(flat, 2))
    pieces = pulled_apart(flat, ROOM, 1.0)
    moved = [
        [(x + dx, y + dy) for x, y in piece]
        for piece, (dx, dy) in zip(flat, pieces.moves, strict=True)
    ]
    assert all(distance(one, other) >= ROOM / 3 for one, other in combinations(moved, 2))


def distance(one: list[tuple[float, float]], other: list[tuple[float, float]]) -> float:
    """Return the distance of the hulls of two pieces; 0 if an edge of one meets one of the other."""
    least = 1e9
    for (a, b), (c, d) in product(combinations(one, 2), combinations(other, 2)):
        sides = [
            (q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0])
            for p, q, r in ((a, b, c), (a, b, d), (c, d, a), (c, d, b))
        ]
        if sides[0] * sides[1] < 0 and sides[2] * sides[3] < 0:
            return 0.0
        least = min(
            least,
            off_segment(a, c, d),
            off_segment(b, c, d),
            off_segment(c, a, b),
            off_segment(d, a, b),
        )
    return least


@pytest.mark.parametrize("name", SOME)
def test_a_pair_names_all_vertices_of_all_pieces(name: str) -> None:
    shown = certificate(name)
    texts = [
        mark.text for mark in pair(shown).marks if isinstance(mark, Label) and mark.kind == "piece"
    ]
    assert sorted(texts) == sorted("".join(map(label, shown.tetrahedra)))
    numbers = [
        mark.text for mark in pair(shown).marks if isinstance(mark, Label) and "number" in mark.kind
    ]
    assert sorted(numbers) == [*"12345678"]


# Graphs.


@pytest.mark.parametrize("name", PATTERN_NAMES[::6])
def test_a_graph_shows_all_nodes_and_edges(name: str) -> None:
    tetrahedra = certificate(name).tetrahedra
    picture = graph(tetrahedra)
    nodes = [mark for mark in picture.marks if isinstance(mark, Circle) and mark.radius == NODE]
    labels = [mark for mark in picture.marks if isinstance(mark, Label) and mark.kind == "piece"]
    assert [mark.text for mark in labels] == [*map(label, tetrahedra)]
    assert [mark.at for mark in labels] == [mark.centre for mark in nodes]
    assert [mark.kind for mark in nodes] == [
        TETRAHEDRON_TYPES[t].replace(" ", "-") + "-node" for t in tetrahedra
    ]
    places = [mark.centre for mark in nodes]
    assert min(off_segment(a, b, b) for a, b in combinations(places, 2)) > 3 * NODE
    lines = [mark for mark in picture.marks if isinstance(mark, Line)][:-2]  # but the legend's
    for kind, pairs in zip(("plain", "dashed"), decomposition(tetrahedra)[1:], strict=True):
        found = [
            (places.index(m.points[0]), places.index(m.points[-1])) for m in lines if m.kind == kind
        ]
        assert found == [*pairs]
    for line in lines:
        ends = {line.points[0], line.points[-1]}
        for place in {*places} - ends:
            assert min(off_segment(place, *piece) for piece in pairwise(line.points)) > NODE


@pytest.mark.parametrize(("name", "symmetries"), [("5_A", 8), ("6_B", 12), ("6_E", 6), ("15_E", 2)])
def test_layouts_show_symmetries(name: str, symmetries: int) -> None:
    """So many permutations of the nodes keep all distances, and they are symmetries."""
    tetrahedra = certificate(name).tetrahedra
    places, many = layout(tetrahedra)
    assert many == symmetries
    kept = [p for p in permutations_of(tetrahedra) if keeps_distances(places, p)]
    assert len(kept) == symmetries


def keeps_distances(places: tuple[tuple[float, float], ...], permutation: tuple[int, ...]) -> bool:
    moved = [places[k] for k in permutation]
    return all(
        abs(off_segment(a, b, b) - off_segment(c, d, d)) < 1e-6
        for (a, c), (b, d) in combinations(zip(places, moved, strict=True), 2)
    )


@pytest.mark.parametrize("name", ["5_A", "7_C", "8_E"])
def test_permutations_are_those_of_symmetries(name: str) -> None:
    tetrahedra = certificate(name).tetrahedra
    fixing = [s for s in SYMMETRIES if {image(s, t) for t in tetrahedra} == {*tetrahedra}]
    assert len(permutations_of(tetrahedra)) <= len(fixing) == 48 // certificate(name).instances


# SVG.


def parsed(text: str) -> ElementTree.Element:
    return ElementTree.fromstring(text)


@pytest.mark.parametrize("name", PATTERN_NAMES)
def test_thumbnails_are_small(name: str) -> None:
    picture = closed(certificate(name))
    for standalone in (True, False):
        text = svg(picture, standalone)
        assert len(text.encode()) < 5000
        assert parsed(text).attrib["role"] == "img"
    assert svg(picture) == svg(closed(certificate(name)))


@pytest.mark.parametrize("letter", BOUNDARY_TYPES)
def test_boundaries(letter: str) -> None:
    picture = boundary_type(letter)
    root = parsed(svg(picture))
    assert "".join(root.itertext()).startswith(f"Boundary of type {letter}The cube 12345678")
    lines = [mark for mark in picture.marks if isinstance(mark, Line)]
    assert [
        sum(mark.kind.startswith(kind) for mark in lines)
        for kind in ("hexahedron", "diagonal", "inner")
    ] == [12, 6, 0]


@pytest.mark.parametrize("name", UNREALIZABLE)
def test_what_no_points_realize(name: str) -> None:
    for picture in (closed(certificate(name)), pair(certificate(name))):
        assert "no points realize it" in svg(picture)
        assert not any("inner" in mark.kind for mark in picture.marks)
    assert pair(certificate(name)) == unrealized(certificate(name))


def test_the_style_sheet_has_all_kinds_and_colours() -> None:
    assert all(f".drawing .{kind}{{" in STYLE_SHEET for kind in LOOKS)
    assert all(STYLE_SHEET.count(f"--drawing-{colour}:") == 4 for colour in PALETTE)
    used = {name for look in LOOKS.values() for name in (look.fill, look.stroke) if name}
    assert used <= {*PALETTE}
    for text in ("prefers-color-scheme:dark", "[data-theme=dark] ", "[data-theme=light] "):
        assert text in STYLE_SHEET


def test_text_is_escaped() -> None:
    picture = Picture(9, 9, (Label("name", (1, 1), "<&"),), 'a "<b>"', "x < y")
    assert [*parsed(svg(picture)).itertext()].count("<&") == 1


def test_colours_are_told_apart_in_grey() -> None:
    """Faces of a type by their shades, and lines by their dashes or widths where not by colour."""

    def grey(colour: str) -> float:
        red, green, blue = (int(colour[i : i + 2], 16) for i in (1, 3, 5))
        return 0.299 * red + 0.587 * green + 0.114 * blue

    for name in PALETTE:
        if name.endswith("-lit"):
            for night in (0, 1):
                shades = [
                    grey(PALETTE[name.replace("lit", s)][night]) for s in ("lit", "plain", "shaded")
                ]
                assert shades == sorted(shades, reverse=True)
    drawn_as = {
        (LOOKS[kind].width, LOOKS[kind].dash) for kind in ("hexahedron", "diagonal", "inner")
    }
    assert len(drawn_as) == 3


# The same bytes.

TWICE = """
import hashlib, sys
from certify.atlas.drawings import graph, pair
from certify.atlas.picture import svg
from tests.test_draw import certificate
for name in ("8_E", "15_E"):
    shown = certificate(name)
    for picture in (pair(shown), graph(shown.tetrahedra)):
        print(hashlib.sha256(svg(picture).encode()).hexdigest())
"""


def test_bytes_do_not_depend_on_the_process() -> None:
    outs = [
        subprocess.run(
            [sys.executable, "-c", TWICE],
            cwd=CHECKOUT,
            env={"PYTHONHASHSEED": seed, "PATH": ""},
            capture_output=True,
            check=True,
        ).stdout
        for seed in ("1", "2")
    ]
    assert outs[0] == outs[1]
    assert outs[0].count(b"\n") == 4


# Figures.


@pytest.mark.parametrize("number", [2, 4, 5, 6, 8, 10, 12])
def test_figures(shipped: Path, number: int) -> None:
    assert parsed(svg(figure(number, shipped))).tag.endswith("svg")


@pytest.mark.parametrize(
    ("number", "names"),
    [
        (3, "5_A 6_A 6_B 6_C 6_D 6_E"),
        (5, "7_B 7_C 7_D 7_E"),
        (8, "a b c d e f g"),
        (12, "8_A 8_B 8_C 8_D 8_F 8_G"),
        (13, "15_C 15_D 15_E 15_K"),
        (14, "15_A 15_F 15_B 15_G 15_J 15_H 15_I"),
    ],
)
def test_figures_show_what_the_paper_does(shipped: Path, number: int, names: str) -> None:
    picture = figure(number, shipped)
    shown = [m.text for m in picture.marks if isinstance(m, Label) and m.kind == "name"]
    assert shown == names.split()


def test_a_figure_says_that_a_pattern_is_not_valid(shipped: Path) -> None:
    """The paper shows four valid hexahedra in Figure 13; of 15_K there is none."""
    says = figure(13, shipped).says
    assert says.count("Points of a valid hexahedron") == 3
    assert "15_K: Points in convex position; there is no valid hexahedron" in says


def test_a_figure_needs_certificates_that_are_accepted(root: Path) -> None:
    with pytest.raises(Rejected, match=r"certificates/8_A\.json: "):
        figure(12, root)


# The command.


@pytest.mark.parametrize("args", [("5_A",), ("15_A",), ("5_A", "--graph"), ("--boundary", "c")])
def test_command(root: Path, tmp_path: Path, args: tuple[str, ...]) -> None:
    to = tmp_path / "new" / "x.svg"
    assert run(root, "draw", *args, "--to", str(to))[0] == 0
    content = to.read_bytes()
    assert parsed(content.decode()).tag == "{http://www.w3.org/2000/svg}svg"
    assert run(root, "draw", *args, "--to", str(to))[0] == 0
    assert to.read_bytes() == content


@needs_matplotlib
@pytest.mark.parametrize(("ending", "magic"), [("pdf", b"%PDF-"), ("png", b"\x89PNG")])
def test_command_by_matplotlib(root: Path, tmp_path: Path, ending: str, magic: bytes) -> None:
    contents = []
    for name in ("one", "two"):
        to = tmp_path / f"{name}.{ending}"
        assert run(root, "draw", "5_A", "--to", str(to)) == (0, f"5_A: {to}\n", "")
        contents.append(to.read_bytes())
    assert contents[0] == contents[1]
    assert contents[0].startswith(magic)
    assert not any(word in contents[0] for word in (b"CreationDate", b"ModDate", b"atplotlib"))


def test_without_matplotlib(root: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "matplotlib", None)
    assert run(root, "draw", "5_A", "--to", str(tmp_path / "x.svg"))[0] == 0
    outcome = run(root, "draw", "5_A", "--to", str(tmp_path / "x.pdf"))
    assert_usage_error(outcome, "matplotlib is not installed: run pip install '.[atlas]'")


@pytest.mark.parametrize(
    ("args", "message"),
    [
        (("5_Z", "--to", "x.svg"), "unknown pattern 5_Z; see 'certify list'"),
        (("5_A", "--to", "x.gif"), "x.gif does not end in .svg, .pdf or .png"),
        (("5_A",), "Missing option '--to'"),
        (("--to", "x.svg"), "draw needs one of: a pattern, --boundary, --figure"),
        (("5_A", "--figure", "8", "--to", "x.svg"), "draw needs one of"),
        (("--figure", "8", "--graph", "--to", "x.svg"), "--graph is for a pattern"),
        (("--figure", "7", "--to", "x.svg"), "figure 7 is not drawn; it must be one of 2, 3, "),
        (("--figure", "x", "--to", "x.svg"), "Invalid value for '--figure'"),
        (("--boundary", "h", "--to", "x.svg"), "unknown boundary type h"),
    ],
)
def test_bad_requests(root: Path, args: tuple[str, ...], message: str) -> None:
    assert_usage_error(run(root, "draw", *args), message)


def test_bad_targets(root: Path, tmp_path: Path) -> None:
    folder = tmp_path / "folder.svg"
    folder.mkdir()
    assert_usage_error(run(root, "draw", "5_A", "--to", str(folder)), "folder.svg is a folder")
    file = tmp_path / "file"
    file.write_text("")
    assert_usage_error(run(root, "draw", "5_A", "--to", str(file / "x.svg")), str(file))
    nowhere = run(tmp_path / "nowhere", "draw", "5_A", "--to", str(tmp_path / "x.svg"))
    assert_usage_error(nowhere, "nowhere is not a folder")


def test_what_is_rejected_is_not_drawn(root: Path, tmp_path: Path) -> None:
    (root / "proofs" / "15_A.valid.lrat").write_text("1 0 0\n")
    to = tmp_path / "x.svg"
    assert_rejects(run(root, "draw", "15_A", "--to", str(to)), "15_A.json", "valid: ")
    assert_rejects(run(root, "draw", "--figure", "14", "--to", str(to)), "15_A.json", "valid: ")
    assert not to.exists()


def test_help_names_all_figures() -> None:
    result = CliRunner().invoke(cli, ["draw", "--help"])
    assert "2 to 6, 8, 10, 12 to 14" in " ".join(result.output.split())
    assert [*FIGURES] == [2, 3, 4, 5, 6, 8, 10, 12, 13, 14]
