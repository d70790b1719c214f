"""The atlas: what its pages say, that they hold together, and how they work in a browser."""

import json
import random
import re
import shutil
import subprocess
import sys
from collections.abc import Callable, Iterator
from dataclasses import replace
from functools import cache
from html.parser import HTMLParser
from importlib.util import find_spec
from io import BytesIO
from itertools import combinations
from pathlib import Path
from typing import Any
from urllib.parse import unquote, urlsplit

import pytest

from certify.atlas.site.records import ROWS, Pattern, pattern_of, table
from certify.audit import load_shipped
from certify.graphs import ball, isomorphic
from certify.kernel.certificate import PATTERN_NAMES, QUESTIONS
from certify.kernel.check import check_pattern
from certify.kernel.cube import TETRAHEDRON_TYPES
from certify.kernel.hexahedron import SYMMETRIES, image
from certify.kernel.theorems import Outcome
from certify.kernel.triangulation import label
from tests.commands import CHECKOUT, run

SCRIPTS = CHECKOUT / "certify" / "atlas" / "site" / "static"
CHROMIUM = shutil.which("chromium")
NODE = shutil.which("node")
TSC = shutil.which("tsc")

needs_node = pytest.mark.skipif(NODE is None, reason="node is not installed")


@cache
def pattern(name: str) -> Pattern:
    return pattern_of(check_pattern(CHECKOUT, name))


# What the pages say.


def test_the_first_table_counts_what_was_accepted(outcome: Outcome) -> None:
    patterns = [pattern_of(verdict) for verdict in outcome.verdicts]
    for row, wanted in ROWS.items():
        cells = table(patterns)[row]
        *each, total = (cell.count for cell in cells)
        assert sum(each) == total
        for cell in cells:
            asked = dict(part.split("=") for part in cell.filters.split("&") if part)
            size = asked.pop("size", None)
            assert asked == wanted
            assert cell.count == sum(
                verdict.size == int(size or verdict.size)
                and all(verdict.answers[q] == a for q, a in wanted.items())
                for verdict in outcome.verdicts
            )


@pytest.mark.parametrize("name", ["5_A", "8_E", "13_Y", "15_A"])
def test_facts_of_a_pattern(name: str) -> None:
    found = pattern(name)
    tetrahedra = found.certificate.tetrahedra
    assert sorted(t for own in found.by_type.values() for t in own) == sorted(
        map(label, tetrahedra)
    )
    for kind, own in found.by_type.items():
        assert {TETRAHEDRON_TYPES[tuple(map(int, t))] for t in own} == {kind}
    assert (1 + len(found.automorphisms)) * found.instances == len(SYMMETRIES)
    edges = {edge for t in tetrahedra for edge in combinations(t, 2)}
    for vertex, (of_edges, of_tetrahedra) in found.degrees.items():
        assert of_edges == sum(vertex in edge for edge in edges)
        assert of_tetrahedra == sum(vertex in t for t in tetrahedra)
    assert len(found.inner_edges) == len(edges) - 12 - 6


def test_the_scene_has_each_witness_once() -> None:
    for name in ("5_A", "13_T", "15_A"):
        scene = json.loads(pattern(name).scene)
        own = [answer.points for answer in pattern(name).answers if answer.points]
        assert len(scene["witnesses"]) == len(set(own))
        asked = [question for witness in scene["witnesses"] for question in witness["questions"]]
        assert sorted(asked) == sorted(q for q in QUESTIONS if pattern(name).answer(q) == "yes")
        for witness in scene["witnesses"]:
            for points in (witness["points"], witness["best"]):
                assert max(abs(x) for point in points for x in point) == 1


def test_a_scene_may_have_several_witnesses() -> None:
    """No shipped certificate has different points for its questions, but it may."""
    found = pattern("5_A")
    stretched = tuple((2 * x, y, z) for x, y, z in found.answers[0].points)
    answers = (replace(found.answers[0], points=stretched), *found.answers[1:])
    scene = json.loads(replace(found, answers=answers).scene)
    assert [own["questions"] for own in scene["witnesses"]] == [["realizable"], ["convex", "valid"]]


def test_what_was_rejected_has_no_page(root: Path) -> None:
    (root / "proofs" / "15_A.valid.lrat").write_text("1 0 0\n")
    with pytest.raises(ValueError, match="15_A was not accepted"):
        pattern_of(check_pattern(root, "15_A"))


# Search.


def asked_of_node(script: str, *arguments: object) -> Any:
    program = (SCRIPTS / "search.js").read_text() + script
    command = [str(NODE), "-e", program, *map(json.dumps, arguments)]
    done = subprocess.run(command, capture_output=True, text=True, check=True)
    return json.loads(done.stdout)


@needs_node
def test_search_finds_each_pattern_in_any_labelling() -> None:
    dice = random.Random(174)
    tetrahedra = {name: pattern(name).certificate.tetrahedra for name in PATTERN_NAMES}
    texts = {}
    for name, own in tetrahedra.items():
        names = dice.sample("abcdefgh12345678", 8)
        renamed = [[names[v - 1] for v in dice.sample(t, 4)] for t in dice.sample(own, len(own))]
        texts[name] = " ".join("".join(t) for t in renamed)
    found = asked_of_node(
        """
        const [texts, patterns] = process.argv.slice(1).map((text) => JSON.parse(text));
        const found = Object.entries(texts).map(([name, text]) =>
          [name, [...patternsOf(readTetrahedra(text), patterns).keys()]]);
        console.log(JSON.stringify(Object.fromEntries(found)));
        """,
        texts,
        {name: list(map(label, own)) for name, own in tetrahedra.items()},
    )
    for name, own in found.items():
        assert name in own
        for other in own:
            assert isomorphic(ball(tetrahedra[name]), ball(tetrahedra[other]))


@needs_node
@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("1236, 1248", [["1", "2", "3", "6"], ["1", "2", "4", "8"]]),
        ("[1, 2, 3, 10], [2, 3, 10, 11]", [["1", "2", "3", "10"], ["2", "3", "10", "11"]]),
        ("1123", None),
        ("123", None),
        ("", None),
        ("8_E", None),
    ],
)
def test_tetrahedra_are_read(text: str, expected: object) -> None:
    script = "console.log(JSON.stringify(readTetrahedra(JSON.parse(process.argv[1]))));"
    assert asked_of_node(script, text) == expected


@pytest.mark.skipif(TSC is None, reason="tsc, the type checker of TypeScript, is not installed")
def test_scripts_are_typed() -> None:
    options = "--noEmit --allowJs --checkJs --strict --target es2022 --lib es2022,dom,dom.iterable"
    scripts = sorted(map(str, [*SCRIPTS.glob("*.js"), *SCRIPTS.glob("*.d.ts")]))
    done = subprocess.run(
        [str(TSC), *options.split(), *scripts], capture_output=True, text=True, check=False
    )
    assert done.returncode == 0, done.stdout


# The command.


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ((), "nothing to do: give --to DIR, or --serve, or both"),
        (("--to", "{file}"), "{file} is not a folder"),
        (("--to", "{file}/x"), "{file} is not a folder"),
        (("--serve", "--port", "x"), "Invalid value for '--port'"),
    ],
)
def test_bad_requests(
    shipped: Path, tmp_path: Path, arguments: tuple[str, ...], message: str
) -> None:
    file = tmp_path / "file"
    file.write_text("")
    code, out, err = run(shipped, "atlas", *(a.format(file=file) for a in arguments))
    assert (code, out) == (2, "")
    assert err.startswith(f"certify: {message.format(file=file)}")
    assert err.count("\n") == 1


def test_a_folder_of_something_else_is_left_alone(shipped: Path, tmp_path: Path) -> None:
    (tmp_path / "index.html").write_text("mine")
    code, out, err = run(shipped, "atlas", "--to", str(tmp_path))
    assert (code, out) == (2, "")
    assert err == f"certify: {tmp_path} is neither empty nor an atlas\n"
    assert [path.name for path in tmp_path.iterdir()] == ["index.html"]


def test_nothing_is_written_of_what_is_rejected(root: Path, tmp_path: Path) -> None:
    (root / "proofs" / "15_A.valid.lrat").write_text("1 0 0\n")
    code, out, err = run(root, "atlas", "--to", str(tmp_path / "site"))
    assert (code, out) == (1, "")
    assert err.startswith("certify: rejected: certificates/")
    assert err.count("\n") == 1
    assert not (tmp_path / "site").exists()


# The site, whole. All these tests need it, so one process runs them.


slow = [pytest.mark.slow, pytest.mark.xdist_group("atlas")]


def slowly(test: Any) -> Any:
    for mark in slow:
        test = mark(test)
    return test


@pytest.fixture(scope="module")
def site(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("atlas") / "site"
    code, out, err = run(CHECKOUT, "atlas", "--to", str(folder), "--jobs", "2")
    assert (code, err) == (0, "")
    assert out == f"atlas: {folder / 'index.html'}\n"
    return folder


class Links(HTMLParser):
    """Collects what a page links to, its anchors, and its labels."""

    def __init__(self, text: str) -> None:
        super().__init__()
        self.links: list[str] = []
        self.ids: list[str] = []
        self.feed(text)

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:  # noqa: ARG002
        for name, value in attrs:
            if name in ("href", "src"):
                self.links.append(value or "")
            if name == "id":
                self.ids.append(value or "")


def pages(folder: Path) -> list[Path]:
    return sorted(folder.rglob("*.html"))


@slowly
def test_every_link_leads_somewhere(site: Path) -> None:
    found = {page: Links(page.read_text("utf-8")) for page in pages(site)}
    assert len(found) == len(PATTERN_NAMES) + 6
    for page, own in found.items():
        assert len(own.ids) == len(set(own.ids)), page
        for link in own.links:
            parts = urlsplit(link)
            if parts.scheme:
                assert page.name == "checking.html"  # its bibliography
                continue
            target = (page.parent / unquote(parts.path)).resolve() if parts.path else page
            assert target.is_file(), f"{page.name}: {link}"
            if parts.fragment and target.suffix == ".html" and "=" not in parts.fragment:
                assert unquote(parts.fragment) in found[target].ids, f"{page.name}: {link}"


@slowly
def test_the_evidence_is_what_was_checked(site: Path) -> None:
    for folder in ("certificates", "proofs"):
        names = sorted(path.name for path in (CHECKOUT / folder).iterdir())
        assert sorted(path.name for path in (site / folder).iterdir()) == names
        for name in names:
            assert (site / folder / name).read_bytes() == (CHECKOUT / folder / name).read_bytes()


@slowly
def test_sizes(site: Path) -> None:
    """The index loads fast; only pages of patterns load the library for space."""
    pictures = sum(path.stat().st_size for path in (site / "pictures").iterdir())
    scripts = sum(p.stat().st_size for p in (site / "static").iterdir() if "plotly" not in p.name)
    assert (site / "index.html").stat().st_size + pictures + scripts < 1_000_000
    for page in pages(site):
        assert ("plotly.min.js" in page.read_text("utf-8")) == (
            page.parent.name == "patterns" and not page.stem.startswith(("15_A", "15_B", "15_J"))
        )
    assert (site / "static" / "plotly-LICENSE.txt").read_text().startswith("MIT License")


@slowly
def test_every_pattern_and_claim_is_told(site: Path, outcome: Outcome) -> None:
    audit = (site / "audit.html").read_text("utf-8")
    assert all(f'id="{claim.id}"' in audit for claim in load_shipped())
    told = (site / "theorems.html").read_text("utf-8")
    assert all(f'id="{theorem.id}"' in told for theorem in outcome.theorems)
    for verdict in outcome.verdicts:
        text = (site / "patterns" / f"{verdict.pattern}.html").read_text("utf-8")
        for question, answer in verdict.answers.items():
            assert f'{question.capitalize()}: <span class="answer {answer}">' in text
        assert text.count("<summary>Why? ") == 3
        assert f"certify check {verdict.pattern}" in text


# In a browser.

needs_chromium = pytest.mark.skipif(
    CHROMIUM is None or find_spec("playwright") is None,
    reason="chromium, or playwright that drives it, is not installed",
)

ARGUMENTS = (
    *("--no-sandbox", "--disable-gpu", "--no-first-run", "--disable-background-networking"),
    *("--disable-component-update", "--disable-sync", "--disable-quic"),
    *("--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--ignore-gpu-blocklist"),
)


class Browser:
    """A browser with the site, which remembers what went wrong and what was asked for."""

    def __init__(self, browser: Any, site: Path) -> None:
        self.browser = browser
        self.site = site
        self.wrong: list[str] = []
        self.asked: list[str] = []

    def miss(self, path: str, request: Any) -> None:
        if request.failure != "net::ERR_ABORTED":  # by leaving the page before all was there
            self.wrong.append(f"{path}: {request.url}: {request.failure}")

    def hear(self, path: str, message: Any) -> None:
        if message.type == "error":
            self.wrong.append(f"{path}: {message.text}")

    def open(self, path: str, width: int = 1280, scheme: str = "light") -> Any:
        context = self.browser.new_context(
            viewport={"width": width, "height": 900}, color_scheme=scheme
        )
        page = context.new_page()
        page.on("request", lambda request: self.asked.append(request.url))
        page.on("requestfailed", lambda request: self.miss(path, request))
        page.on("pageerror", lambda error: self.wrong.append(f"{path}: {error}"))
        page.on("console", lambda message: self.hear(path, message))
        page.goto(f"{self.site.as_uri()}/{path}")
        return page


@pytest.fixture(scope="module")
def browser(site: Path) -> Iterator[Browser]:
    from playwright.sync_api import sync_playwright  # noqa: PLC0415 - where it is installed

    with sync_playwright() as playwright:
        chromium = playwright.chromium.launch(executable_path=CHROMIUM, args=[*ARGUMENTS])
        found = Browser(chromium, site)
        yield found
        chromium.close()
    assert found.wrong == []
    assert {url for url in found.asked if not url.startswith(site.as_uri())} <= set()


def soon(page: Any, ask: Callable[[], Any], wanted: Any) -> bool:
    """Whether the answer becomes what is wanted: a page answers in its own time."""
    for _ in range(200):
        if ask() == wanted:
            return True
        page.wait_for_timeout(50)
    return False


def drawn(page: Any) -> None:
    """Wait until plotly has drawn."""
    page.wait_for_selector("#view canvas")
    page.wait_for_function("() => document.getElementById('view').data?.length > 0")


def solids(page: Any) -> list[dict[str, Any]]:
    found: list[dict[str, Any]] = page.evaluate(
        "() => document.getElementById('view').data.filter((t) => t.type === 'mesh3d')"
        ".map((t) => ({name: t.name, visible: t.visible, x: [...t.x], opacity: t.opacity}))"
    )
    return found


def shown(page: Any) -> set[str]:
    return {own["name"] for own in solids(page) if own["visible"]}


STAND_IN = """
  window.Plotly = {
    react: async (view, data) => { view.data = data; view.on = () => {}; return view; },
  };
"""
"""For plotly, whose start takes seconds where a processor has to draw."""


@slowly
@needs_chromium
def test_every_page_loads(browser: Browser) -> None:
    page = browser.open("index.html")
    page.route("**/plotly.min.js", lambda route: route.fulfill(body=STAND_IN))
    for path in pages(browser.site):
        page.goto(path.as_uri())
        if page.query_selector("#view"):
            assert len(solids(page)) == int(path.stem.partition("_")[0])
    assert browser.wrong == []


@slowly
@needs_chromium
@pytest.mark.parametrize("name", ["5_A", "9_A", "13_T", "15_G"])
def test_plotly_draws(browser: Browser, name: str) -> None:
    page = browser.open(f"patterns/{name}.html")
    drawn(page)
    assert len(solids(page)) == int(name.partition("_")[0])
    assert browser.wrong == []


@slowly
@needs_chromium
def test_filters_count_as_the_theorems_do(browser: Browser, outcome: Outcome) -> None:
    page = browser.open("index.html")
    assert page.inner_text("#found") == "174 patterns"
    links = page.query_selector_all("#table a")
    assert len(links) > 40
    for link in links:
        link.click()
        count = int(link.inner_text())
        told = f"{count} pattern{'s' * (count != 1)}"
        assert soon(page, lambda: page.inner_text("#found"), told)
        assert page.locator("#cards li:visible").count() == count
    for question in QUESTIONS:
        page.click("button[type=reset]")
        page.select_option(f"#{question}", "yes")
        count = sum(verdict.answers[question] == "yes" for verdict in outcome.verdicts)
        assert page.inner_text("#found") == f"{count} patterns"
    page.click("button[type=reset]")
    page.fill("#quality", "0.9")
    wanted = {v.pattern for v in outcome.verdicts if (pattern(v.pattern).quality or 0) >= 0.9}
    cards = page.locator("#cards li:visible b").all_inner_texts()
    assert set(cards) == wanted
    assert 0 < len(wanted) < 143


@slowly
@needs_chromium
def test_the_address_tells_what_is_shown(browser: Browser) -> None:
    page = browser.open("index.html")
    page.select_option("#size", "15")
    page.select_option("#valid", "yes")
    page.select_option("#sort", "quality")
    page.wait_for_function("() => location.hash.includes('sort')")
    told, cards = page.inner_text("#found"), page.locator("#cards li:visible b").all_inner_texts()
    assert told == "3 patterns"
    values = [pattern(name).quality or 0 for name in cards]
    assert values == sorted(values, reverse=True)
    other = browser.open(page.url.rpartition("/")[2])
    assert other.inner_text("#found") == told
    assert other.locator("#cards li:visible b").all_inner_texts() == cards


@slowly
@needs_chromium
def test_search_finds_a_relabelled_pattern(browser: Browser) -> None:
    own = pattern("8_E").certificate.tetrahedra
    renamed = dict(zip(range(1, 9), "hgfedcba", strict=True))
    page = browser.open("index.html")
    page.fill("#q", " ".join("".join(renamed[v] for v in t) for t in reversed(own)))
    assert page.locator("#cards li:visible b").all_inner_texts() == ["8_E"]
    assert page.inner_text("#found").startswith("8_E, with ")
    mirrored = [label(image(SYMMETRIES[-1], t)) for t in own]
    page.fill("#q", ", ".join(mirrored))
    assert page.locator("#cards li:visible b").all_inner_texts() == ["8_E"]
    page.fill("#q", "1234 5678")
    assert page.inner_text("#found") == "No pattern has these 2 tetrahedra. 0 patterns"
    page.fill("#q", "what now?")
    assert page.inner_text("#found").startswith("Neither a name nor a list of tetrahedra.")
    page.fill("#q", "15_k")
    assert page.locator("#cards li:visible b").all_inner_texts() == ["15_K"]
    page.fill("#q", "9_")
    assert page.locator("#cards li:visible").count() == 13


@slowly
@needs_chromium
def test_the_view_obeys_its_controls(browser: Browser) -> None:
    page = browser.open("patterns/8_E.html")
    drawn(page)
    before = solids(page)
    assert len(before) == 8
    assert all(own["visible"] for own in before)
    page.focus("#apart")
    page.keyboard.press("End")
    assert soon(page, lambda: in_place(page, before), 0)
    page.keyboard.press("Home")
    assert soon(page, lambda: solids(page), before)
    # Hiding, and neighbours.
    first = before[0]["name"]
    page.locator("#tetrahedra input").first.uncheck()
    assert soon(page, lambda: shown(page), {own["name"] for own in before} - {first})
    page.click("#all")
    page.locator("#tetrahedra button").first.click()
    near = {o["name"] for o in before if len(set(o["name"]) & set(first)) >= 3}
    assert soon(page, lambda: shown(page), near)
    page.click("#all")
    # What the facets show.
    page.check("#jacobian")
    assert page.is_checked("#curved")
    types = "() => document.getElementById('view').data.map((t) => t.type)"
    assert soon(page, lambda: page.evaluate(types).count("surface"), 6)
    assert page.is_visible("#scale")
    page.uncheck("#curved")
    assert not page.is_checked("#jacobian")
    # Turning.
    eye = "() => document.getElementById('view').layout.scene.camera.eye"
    seen = page.evaluate(eye)
    page.focus("[data-turn=left]")
    page.keyboard.press("Enter")
    assert soon(page, lambda: page.evaluate(eye) != seen, True)
    turned = page.evaluate(eye)
    assert far(turned) == pytest.approx(far(seen))
    page.click("[data-turn=in]")
    assert soon(page, lambda: far(page.evaluate(eye)) < far(turned), True)


def in_place(page: Any, before: list[dict[str, Any]]) -> int:
    """Return how many tetrahedra are where they were."""
    return sum(a["x"] == b["x"] for a, b in zip(before, solids(page), strict=True))


def far(eye: dict[str, float]) -> float:
    return sum(x * x for x in eye.values())


@slowly
@needs_chromium
@pytest.mark.parametrize("width", [1280, 390])
@pytest.mark.parametrize("name", ["5_A", "7_A", "8_E", "15_G"])
def test_all_of_it_is_in_sight(browser: Browser, name: str, width: int) -> None:
    """No pixel at the rim of the view has another colour than the rest of the rim."""
    page = browser.open(f"patterns/{name}.html", width)
    page.wait_for_selector("#view canvas")
    assert soon(page, lambda: len(colours(page)[1]) > 3, True)
    rim, _ = colours(page)
    assert len(rim) == 1


def colours(page: Any) -> tuple[set[Any], set[Any]]:
    """Return the colours at the rim of the view, and all of them."""
    from matplotlib.image import imread  # noqa: PLC0415 - as above

    pixels = imread(BytesIO(page.locator("#view").screenshot()))[4:-4, 4:-4]
    rim = [*pixels[0], *pixels[-1], *pixels[:, 0], *pixels[:, -1]]
    every = pixels[::3, ::3].reshape(-1, pixels.shape[2])
    return set(map(tuple, map(list, rim))), set(map(tuple, every.tolist()))


@slowly
@needs_chromium
def test_a_click_hides_a_tetrahedron(browser: Browser) -> None:
    page = browser.open("patterns/5_A.html")
    drawn(page)
    box = page.locator("#view").bounding_box()
    x, y = box["x"] + box["width"] / 2, box["y"] + box["height"] / 2
    for shift in (0, 8, -8, 16, -16):  # the first may be on an edge
        page.mouse.move(x + shift, y + shift, steps=4)
        page.wait_for_timeout(500)
        page.mouse.down()
        page.mouse.up()
        page.wait_for_timeout(500)
        if len(shown(page)) == 4:
            break
    assert len(shown(page)) == 4
    assert page.locator("#tetrahedra input:checked").count() == 4


@slowly
@needs_chromium
def test_proportions(browser: Browser) -> None:
    page = browser.open("patterns/15_E.html")
    drawn(page)
    before = solids(page)
    page.check("#true")
    assert soon(page, lambda: in_place(page, before), 0)


@slowly
@needs_chromium
@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_light_and_dark(browser: Browser, scheme: str) -> None:
    page = browser.open("index.html", scheme=scheme)
    colour = "() => getComputedStyle(document.body).backgroundColor"
    before = page.evaluate(colour)
    page.click("#theme")
    assert page.evaluate(colour) != before
    page.reload()
    assert page.evaluate(colour) != before


@slowly
@needs_chromium
@pytest.mark.parametrize(
    "path", ["index.html", "patterns/15_A.html", "audit.html", "checking.html"]
)
def test_a_phone_scrolls_in_one_direction(browser: Browser, path: str) -> None:
    page = browser.open(path, width=360)
    assert page.evaluate("() => document.documentElement.scrollWidth") <= 360


@slowly
@needs_chromium
@pytest.mark.skipif(find_spec("axe_playwright_python") is None, reason="axe is not installed")
@pytest.mark.parametrize(("scheme", "width"), [("light", 1280), ("dark", 1280), ("light", 390)])
@pytest.mark.parametrize(
    "path",
    [
        *("index.html", "theorems.html", "audit.html", "boundaries.html", "cube.html"),
        *("checking.html", "patterns/8_E.html", "patterns/15_A.html"),
    ],
)
def test_accessibility(browser: Browser, path: str, scheme: str, width: int) -> None:
    from axe_playwright_python.sync_playwright import Axe  # noqa: PLC0415 - as above

    page = browser.open(path, width, scheme)
    page.evaluate("() => document.querySelectorAll('details').forEach((d) => (d.open = true))")
    found = Axe().run(page, options={"preload": False})  # it would fetch style sheets
    assert found.violations_count == 0, found.generate_report()


@slowly
@needs_chromium
def test_it_is_served_too(shipped: Path, site: Path) -> None:
    """From a web server of this machine, with the same pages."""
    program = (
        "from pathlib import Path; import sys, threading, urllib.request;"
        "from certify.atlas.site.serve import serving\n"
        "with serving(Path(sys.argv[1]), 0) as server:\n"
        "    threading.Thread(target=server.serve_forever, daemon=True).start()\n"
        "    url = f'http://127.0.0.1:{server.server_port}/patterns/8_E.html'\n"
        "    sys.stdout.buffer.write(urllib.request.urlopen(url).read())\n"
        "    server.shutdown()\n"
    )
    command = [sys.executable, "-c", program, str(site)]
    done = subprocess.run(command, capture_output=True, check=True)
    assert done.stdout == (site / "patterns" / "8_E.html").read_bytes()


@slowly
def test_the_same_bytes_again(site: Path) -> None:
    """Whatever order sets happen to have."""
    program = (
        "from certify.atlas.site.build import _drawn; from certify.kernel.check import *;"
        "from pathlib import Path; import sys, hashlib;"
        "found = [_drawn(check_pattern(Path(sys.argv[1]), n)) for n in sys.argv[2:]];"
        "print(hashlib.sha256(repr(found).encode()).hexdigest())"
    )
    digests = {
        subprocess.run(
            [sys.executable, "-c", program, str(CHECKOUT), "8_E", "15_A", "15_K"],
            capture_output=True,
            text=True,
            check=True,
            env={"PYTHONHASHSEED": seed, "PYTHONPATH": str(CHECKOUT)},
        ).stdout
        for seed in ("1", "2")
    }
    assert len(digests) == 1
    assert re.fullmatch(r"[0-9a-f]{64}\n", digests.pop())
