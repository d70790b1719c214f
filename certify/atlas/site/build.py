"""The site: an outcome of the kernel -> pages and all they need, in one folder.

Pages link to each other, and to copies of the evidence, by relative paths only. So the folder may
be opened from a disk or put on any web server, and nothing that it shows comes from elsewhere.
"""

import re
from collections import Counter, defaultdict
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from importlib.metadata import files as of_distribution
from importlib.resources import files
from pathlib import Path
from typing import Any

from jinja2 import Environment, PackageLoader, StrictUndefined, select_autoescape
from markdown_it import MarkdownIt
from markupsafe import Markup, escape

from certify import __version__
from certify.atlas.draw.drawings import boundary_type, closed, graph, pair, unrealized
from certify.atlas.draw.picture import STYLE_SHEET, svg
from certify.atlas.explain.outlines import explained
from certify.atlas.explain.witness import witness
from certify.atlas.explain.witness_words import Page, page
from certify.atlas.explain.words import (
    ABSURD,
    FOLLOWS,
    FORMULA,
    NOTATION,
    POLYNOMIAL,
    Account,
    account,
)
from certify.atlas.site.records import (
    Pattern,
    findings_by_pattern,
    pattern_of,
    table,
    tetrahedra_by_name,
)
from certify.audit import Finding, audit, summary
from certify.kernel.certificate import QUESTIONS
from certify.kernel.check import Verdict
from certify.kernel.evidence import Evidence, certificate_file, default_root
from certify.kernel.hexahedron import BOUNDARIES, BOUNDARY_TYPES, boundary_letter
from certify.kernel.theorems import Outcome
from certify.kernel.triangulation import label
from certify.processes import Report, mapping
from certify.writing import written_to

MENU = (
    ("index.html", "Patterns"),
    ("theorems.html", "Theorems"),
    ("audit.html", "Audit"),
    ("boundaries.html", "Boundaries"),
    ("cube.html", "Cube"),
    ("checking.html", "How to check"),
)

STATIC = ("atlas.css", "icon.svg", "index.js", "search.js", "theme.js", "view.js")

SIGNS = {"-": "−", "<=": "≤", ">=": "≥", "!=": "≠"}
"""Signs as they are written in a page; others are written as they are."""


@dataclass(frozen=True)
class Drawn:
    """What takes long to make for one pattern: its pictures, and its explanations in words."""

    thumbnail: str
    pictures: dict[str, str]
    told: dict[str, Account | Page | None]


def write_site(root: Path, outcome: Outcome, folder: Path, jobs: int, report: Report) -> None:
    """Write the site of an outcome whose certificates lie below a root.

    Raises:
        OSError: It cannot be written.
        ValueError: A certificate was rejected.
    """
    patterns = [pattern_of(verdict) for verdict in outcome.verdicts]
    with written_to(folder) as scratch:
        for name, content in _contents(root, outcome, patterns, jobs, report):
            path = scratch / name
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_bytes(content)


def _contents(
    root: Path, outcome: Outcome, patterns: Sequence[Pattern], jobs: int, report: Report
) -> Iterator[tuple[str, bytes]]:
    """Yield the files of the site: their paths in its folder, and what is in them."""
    report("auditing", 0, 1)
    findings = audit(outcome)
    pages = _Pages(outcome, patterns, findings)
    yield from pages.general()
    with mapping(jobs) as apply:
        drawn = apply(_drawn, [pattern.verdict for pattern in patterns])
        for done, (pattern, own) in enumerate(zip(patterns, drawn, strict=True), start=1):
            yield f"pictures/{pattern.name}.svg", own.thumbnail.encode()
            yield f"patterns/{pattern.name}.html", pages.pattern(pattern, own)
            report("drawing", done, len(patterns))
    yield from _evidence(root, outcome)
    yield from _static(patterns)


def _drawn(verdict: Verdict) -> Drawn:
    pattern = pattern_of(verdict)
    certificate = pattern.certificate
    realized = verdict.answers["realizable"] == "yes"
    whole = pair(certificate) if realized else unrealized(certificate)
    pictures = {
        "pair": whole,
        "graph": graph(certificate.tetrahedra),
        "boundary": boundary_type(verdict.boundary),
    }
    inline = {name: svg(picture, standalone=False) for name, picture in pictures.items()}
    told = {question: _told(pattern, question) for question in QUESTIONS}
    return Drawn(svg(closed(certificate) if realized else whole), inline, told)


def _told(pattern: Pattern, question: str) -> Account | Page | None:
    """Return the explanation of an answer: of a no an account, of a yes a page."""
    certificate = pattern.certificate
    match pattern.answer(question):
        case "no":
            explanation = explained(certificate, question)
            return account(explanation, certificate, question)
        case "yes":
            return page(witness(certificate, question), pattern.name)
    return None


class _Pages:
    """Fills the templates with the records of one run."""

    def __init__(
        self, outcome: Outcome, patterns: Sequence[Pattern], findings: Sequence[Finding]
    ) -> None:
        self.outcome = outcome
        self.patterns = patterns
        self.findings = findings
        self._by_pattern = findings_by_pattern(findings)
        self._names = [pattern.name for pattern in patterns]
        self._environment = Environment(
            loader=PackageLoader("certify.atlas.site"),
            autoescape=select_autoescape(),
            undefined=StrictUndefined,
            trim_blocks=True,
            lstrip_blocks=True,
        )
        self._environment.filters |= FILTERS
        self._environment.globals |= {
            "about": self._about(),
            "letters": [*BOUNDARY_TYPES],
            "menu": MENU,
            "names": frozenset(self._names),
            "notation": NOTATION,
            "under": POLYNOMIAL,
            "follows": FOLLOWS,
            "absurd": ABSURD,
            "patterns": patterns,
            "questions": QUESTIONS,
            "sizes": sorted({pattern.size for pattern in patterns}),
            "version": __version__,
        }

    def _about(self) -> dict[str, Any]:
        theorems = self.outcome.theorems
        return {
            "patterns": len(self.outcome.verdicts),
            "accepted": sum(verdict.fault is None for verdict in self.outcome.verdicts),
            "theorems": len(theorems),
            "shown": sum(theorem.ok for theorem in theorems),
            "kernel": self.outcome.about["kernel_sha256"],
        }

    def _page(self, template: str, base: str = "", **own: Any) -> bytes:
        text = self._environment.get_template(template).render(base=base, here=template, **own)
        return (text + "\n").encode()

    def general(self) -> Iterator[tuple[str, bytes]]:
        """Yield the pages that are about no single pattern."""
        patterns = self.patterns
        own: dict[str, dict[str, Any]] = {
            "index.html": {
                "table": table(patterns),
                "words": sorted({p.answer(q) for p in patterns for q in QUESTIONS}, reverse=True),
                "class_sizes": sorted({pattern.instances for pattern in patterns}),
            },
            "theorems.html": {"theorems": self.outcome.theorems},
            "audit.html": {
                "findings": self.findings,
                "summary": {k: n for k, n in summary(self.findings).items() if n},
                "by_verdict": _by_verdict(self.findings),
            },
            "boundaries.html": {"boundaries": [*_boundaries(patterns)]},
            "cube.html": {
                "exact": [pattern for pattern in patterns if pattern.cube == "yes"],
                "slivers": [pattern for pattern in patterns if pattern.cube == "with slivers"],
            },
            "checking.html": {"text": Markup(checking())},
        }
        for name, values in own.items():
            yield name, self._page(name, **values)

    def pattern(self, pattern: Pattern, drawn: Drawn) -> bytes:
        """Return the page of a pattern."""
        place = self._names.index(pattern.name)
        points = [own.points for own in pattern.answers if own.points]
        return self._page(
            "pattern.html",
            base="../",
            p=pattern,
            pictures=drawn.pictures,
            told=drawn.told,
            first_with={own: points.index(own) for own in points},
            findings=self._by_pattern.get(pattern.name, ()),
            before=self._names[place - 1] if place else None,
            after=self._names[place + 1] if place + 1 < len(self._names) else None,
        )


def _by_verdict(findings: Iterable[Finding]) -> dict[str, list[Finding]]:
    found = defaultdict(list)
    for finding in findings:
        found[finding.verdict].append(finding)
    return {verdict: found[verdict] for verdict in summary(()) if found[verdict]}


def _boundaries(patterns: Sequence[Pattern]) -> Iterator[dict[str, Any]]:
    instances = Counter(map(boundary_letter, BOUNDARIES))
    for letter, diagonals in BOUNDARY_TYPES.items():
        own = [pattern for pattern in patterns if pattern.letter == letter]
        yield {
            "letter": letter,
            "picture": svg(boundary_type(letter), standalone=False),
            "diagonals": sorted(map(label, diagonals)),
            "instances": instances[letter],
            "count": len(own),
            "by_size": Counter(pattern.size for pattern in own),
        }


# Files that are copied.


def _evidence(root: Path, outcome: Outcome) -> Iterator[tuple[str, bytes]]:
    """Yield the certificates and proofs, if they are still what was accepted."""
    again = Evidence(root)
    for verdict in outcome.verdicts:
        yield certificate_file(verdict.pattern), again.certificate(verdict.pattern)
    digests = {name: own for result in outcome.results for name, own in result.files.items()}
    for name, digest in digests.items():
        if name not in again.files:
            yield name, again.proof(name).encode()
        if again.files[name] != digest:
            raise ValueError(f"{name} has changed since it was checked")


def _static(patterns: Sequence[Pattern]) -> Iterator[tuple[str, bytes]]:
    """Yield style and scripts; plotly's with its licence."""
    ours = files("certify.atlas.site") / "static"
    for name in STATIC:
        content = (ours / name).read_bytes()
        yield f"static/{name}", content + (STYLE_SHEET.encode() if name == "atlas.css" else b"")
    named = tetrahedra_by_name(patterns)
    yield "static/tetrahedra.js", f"const TETRAHEDRA = {named};\n".encode()
    library = (files("plotly") / "package_data" / "plotly.min.js").read_bytes()
    yield "static/plotly.min.js", library
    yield "static/plotly-LICENSE.txt", _licence()


def _licence() -> bytes:
    found = next(f for f in of_distribution("plotly") or () if f.name.startswith("LICENSE"))
    return found.read_binary()


# CHECKING.md.


def checking() -> str:
    """Return CHECKING.md as HTML, its sections with anchors.

    Links to files that the site does not have become plain text. What may be wider than a phone is
    reached by the keyboard, and scrolls.
    """
    source = (default_root() / "CHECKING.md").read_text("utf-8")
    html: str = MarkdownIt("commonmark").enable("table").render(source)
    html = re.sub(r"<h([2-4])>(.*?)</h\1>", _with_anchor, html)
    html = re.sub(r"<(pre|table)>", r'<\1 tabindex="0">', html)
    return re.sub(r'<a href="(?!#|https?:)[^"]*">(.*?)</a>', r"\1", html)


def _with_anchor(found: re.Match[str]) -> str:
    level, text = found.groups()
    anchor = re.sub(r"[^\w\- ]", "", re.sub("<.*?>", "", text).lower()).replace(" ", "-")
    return f'<h{level} id="{anchor}">{text}</h{level}>'


# Filters of the templates.


def _slug(text: str) -> str:
    return text.replace(" ", "-")


def _sign(mark: str) -> str:
    return SIGNS.get(mark, mark)


def _formula(text: str) -> Markup:
    """Return a fact or a reason with formulas told apart from words."""
    parts, last = [], 0
    for found in FORMULA.finditer(text):
        parts += [escape(_said(text[last : found.start()]))]
        parts += [Markup("<span class=formula>{}</span>").format(_in_signs(found[0]))]
        last = found.end()
    return Markup("").join([*parts, escape(_said(text[last:]))])


def _said(text: str) -> str:
    return text.replace("Pluecker", "Plücker")


def _in_signs(formula: str) -> str:
    return " ".join(map(_sign, formula.split(" ")))


def _by_names(text: str, names: Iterable[str]) -> list[str]:
    """Return the text in parts, of which some are names of patterns."""
    return [part for part in re.split(r"(\b\d{1,2}_[A-Z]{1,2}\b)", text) if part or part in names]


def _marked(text: str) -> Markup:
    """Return a text of witness_words.py, its formulas and codes told apart from words."""
    html = re.sub(r"`([^`]*)`", r"<code>\1</code>", str(escape(text)))
    html = re.sub(r"\$([^$]*)\$", lambda found: _raised(found[1]), html)
    return Markup(html)


def _raised(formula: str) -> str:
    formula = re.sub(r"_(?:\{(\w+)\}|(\w))", lambda f: f"<sub>{f[1] or f[2]}</sub>", formula)
    formula = re.sub(r"\^(\w)", r"<sup>\1</sup>", formula)
    return f'<span class="formula">{formula.replace("-", "−")}</span>'


FILTERS: Mapping[str, Any] = {
    "slug": _slug,
    "sign": _sign,
    "formula": _formula,
    "by_names": _by_names,
    "marked": _marked,
}
