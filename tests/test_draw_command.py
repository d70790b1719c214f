"""Graphs, figures, formats and the command of drawings."""

import subprocess
import sys
from collections import Counter
from collections.abc import Iterator
from functools import cache
from importlib.util import find_spec
from itertools import combinations, pairwise, product
from pathlib import Path
from xml.etree import ElementTree

import pytest
from click.testing import CliRunner

from certify.atlas.draw.drawings import boundary_type, closed, graph, pair, unrealized
from certify.atlas.draw.figures import FIGURES, figure
from certify.atlas.draw.layout import layout, permutations_of
from certify.atlas.draw.marks import NODE
from certify.atlas.draw.picture import (
    LOOKS,
    PALETTE,
    SHADES,
    STYLE_SHEET,
    Circle,
    Label,
    Line,
    Picture,
    Place,
    Polygon,
    svg,
)
from certify.atlas.draw.space import off_segment
from certify.cli import cli
from certify.graphs import decomposition
from certify.kernel.certificate import PATTERN_NAMES
from certify.kernel.check import Rejected
from certify.kernel.cube import TETRAHEDRON_TYPES
from certify.kernel.hexahedron import BOUNDARY_TYPES, SYMMETRIES, image
from certify.kernel.triangulation import label
from tests.commands import CHECKOUT, assert_rejects, assert_usage_error, run
from tests.test_draw import REALIZABLE, certificate, lines_of, texts

UNREALIZABLE = [name for name in PATTERN_NAMES if name not in REALIZABLE]

needs_matplotlib = pytest.mark.skipif(
    find_spec("matplotlib") is None, reason="matplotlib is not installed"
)


# Graphs.


@pytest.mark.parametrize("name", PATTERN_NAMES[::6])
def test_a_graph_shows_all_nodes_and_edges(name: str) -> None:
    tetrahedra = certificate(name).tetrahedra
    picture = graph(tetrahedra)
    nodes = [mark for mark in picture.marks if isinstance(mark, Circle) and mark.radius == NODE]
    types = [TETRAHEDRON_TYPES[tetrahedron] for tetrahedron in tetrahedra]
    assert texts(picture, "piece") == [*map(label, tetrahedra)]
    assert [mark.kind for mark in nodes] == [f"{t.replace(' ', '-')}-node" for t in types]
    places = [mark.centre for mark in nodes]
    assert [m.at for m in picture.marks if isinstance(m, Label)][: len(nodes)] == places
    assert min(off_segment(a, b, b) for a, b in combinations(places, 2)) > 3 * NODE
    lines = lines_of(picture)[:-2]  # the last are the legend's
    for kind, pairs in zip(("plain", "dashed"), decomposition(tetrahedra)[1:], strict=True):
        ends = [(m.points[0], m.points[-1]) for m in lines if m.kind == kind]
        assert [(places.index(a), places.index(b)) for a, b in ends] == [*pairs]
    for line in lines:
        for place in {*places} - {line.points[0], line.points[-1]}:
            assert min(off_segment(place, *part) for part in pairwise(line.points)) > NODE


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
    kinds = Counter(line.kind.removesuffix("-hidden") for line in lines_of(picture))
    assert kinds == {"hexahedron": 12, "diagonal": 6}


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

    for name, night in product((name for name in PALETTE if name.endswith("-lit")), (0, 1)):
        shades = [grey(PALETTE[name.replace("lit", shade)][night]) for shade in SHADES]
        assert shades == sorted(shades, reverse=True)
    kinds = [LOOKS[kind] for kind in ("hexahedron", "diagonal", "inner", "inner-hidden")]
    assert len({(look.width, look.dash) for look in kinds}) == 4


# The same bytes.

TWICE = """
import hashlib, sys
from certify.atlas.draw.drawings import graph, pair
from certify.atlas.draw.picture import svg
from tests.test_draw import certificate
for name in ("7_C",):
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
    assert outs[0].count(b"\n") == 2


# Figures.


@cache
def drawn(number: int) -> Picture:
    return figure(number, CHECKOUT)


@pytest.mark.parametrize(
    ("number", "names"),
    [
        (2, "corner, staircase, slanted, core"),
        (3, "5_A, 6_A, 6_B, 6_C, 6_D, 6_E"),
        (4, "core diagonal, boundary"),
        (5, "7_B, 7_C, 7_D, 7_E"),
        (6, ""),
        (8, "a, b, c, d, e, f, g"),
        (10, "8_E"),
        (12, "8_A, 8_B, 8_C, 8_D, 8_F, 8_G"),
        (13, "15_C, 15_D, 15_E, 15_K"),
        (14, "15_A, 15_F, 15_B, 15_G, 15_J, 15_H, 15_I"),
    ],
)
def test_figures_show_what_the_paper_does(number: int, names: str) -> None:
    picture = drawn(number)
    assert ", ".join(texts(picture, "name")) == names
    assert parsed(svg(picture)).tag.endswith("svg")
    xs, ys = zip(*places_of(picture), strict=True)
    assert min(*xs, *ys) > 0
    assert max(xs) < picture.width
    assert max(ys) < picture.height


def places_of(picture: Picture) -> Iterator[Place]:
    for mark in picture.marks:
        match mark:
            case Line() | Polygon():
                yield from mark.points
            case Circle():
                yield mark.centre
            case Label():
                yield mark.at


def test_a_figure_says_that_a_pattern_is_not_valid() -> None:
    """The paper shows four valid hexahedra in Figure 13; of 15_K there is none."""
    says = drawn(13).says
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
