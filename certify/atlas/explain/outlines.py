"""The shipped outlines of all refutations, and the program that looks for shorter ones.

    python -m certify.atlas.explain.outlines --tries 100 --jobs 2 [15_K.valid ...]

It starts from what is there, prints steps and cases, and overwrites outlines.json.
"""

import argparse
import json
from collections import Counter
from collections.abc import Iterator, Sequence
from functools import partial
from pathlib import Path
from typing import NamedTuple

import click

from certify.atlas.explain.explanation import (
    BadOutline,
    Case,
    Explanation,
    Mirror,
    Outline,
    Step,
    explain,
    without_idle_steps,
)
from certify.atlas.explain.reasons import Reasons, gather
from certify.atlas.explain.shorten import Problem, shorten
from certify.families import of_question
from certify.kernel.certificate import PATTERN_NAMES, Certificate, No, read_certificate
from certify.kernel.evidence import Evidence, default_root
from certify.kernel.triangulation import orientation
from certify.processes import Report, mapping
from certify.writing import write_file

OUTLINES = Path(__file__).with_name("outlines.json")

TRIES = 3
"""How often an explanation is looked for where the shipped outline does not fit."""


KINDS = ("relation", "circuit", "edge", "section", "polynomial")
"""The kinds of reasons."""


class Length(NamedTuple):
    """How long an explanation is.

    cases: steps that close a case; mirrored: those that a symmetry makes of such; kinds: all other
    steps, by the kind of their reason.
    """

    pattern: str
    question: str
    steps: int
    cases: int
    mirrored: int
    kinds: dict[str, int]


def shipped() -> dict[str, Outline]:
    """Return the shipped outlines, by names such as 15_K.valid."""
    outlines: dict[str, Outline] = json.loads(OUTLINES.read_text("utf-8"))
    return outlines


def reasons_of(certificate: Certificate, question: str) -> Reasons:
    """Return the formula that the certificate's no refutes, as reasons.

    Raises:
        ValueError: The answer is no no.
    """
    answer = certificate.answers[question]
    if not isinstance(answer, No):
        raise ValueError(f"{certificate.pattern} {question} is not answered by no")
    return gather(of_question(question, answer, orientation(certificate.tetrahedra)))


def explained(certificate: Certificate, question: str) -> Explanation:
    """Return an explanation of a refutation: the shipped one, or one that is found on the spot.

    Raises:
        BadOutline: None is found.
    """
    reasons = reasons_of(certificate, question)
    outline = shipped().get(f"{certificate.pattern}.{question}")
    try:
        if outline is not None:
            return explain(reasons, outline)
    except BadOutline:  # of another instance, say
        pass
    found = [*shorten(Problem(reasons), 1, TRIES, [])]
    if not found:
        raise BadOutline(f"no explanation of {certificate.pattern} {question} is found")
    return explain(reasons, without_idle_steps(reasons, found[-1].outline))


def length(pattern: str, question: str, explanation: Explanation) -> Length:
    """Return how long an explanation is."""
    items = [*explanation.items()]
    kinds = Counter(item.reason.kind for item in items if isinstance(item, Step))
    cases, mirrored = (sum(isinstance(item, own) for item in items) for own in (Case, Mirror))
    by_kind = {kind: kinds[kind] for kind in KINDS if kinds[kind]}
    return Length(pattern, question, len(items), cases, mirrored, by_kind)


def lengths(certificates: Sequence[Certificate], report: Report | None = None) -> list[Length]:
    """Return how long the explanations of all refutations are, the longest first.

    Raises:
        BadOutline: None is found of one of them.
    """
    asked = [
        (certificate, question)
        for certificate in certificates
        for question, answer in certificate.answers.items()
        if isinstance(answer, No)
    ]
    found = []
    for done, (certificate, question) in enumerate(asked, start=1):
        explanation = explained(certificate, question)
        found.append(length(certificate.pattern, question, explanation))
        if report:
            report("explaining", done, len(asked))
    return sorted(found, key=lambda own: own.steps, reverse=True)


# The search.


def main(arguments: Sequence[str] | None = None) -> None:
    """Look for shorter outlines, print how long they are, and write them."""
    parser = argparse.ArgumentParser(
        prog="python -m certify.atlas.explain.outlines", description=__doc__
    )
    parser.add_argument("names", nargs="*", metavar="NAME", help="such as 15_K.valid; default: all")
    parser.add_argument("--tries", type=int, default=0)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--jobs", type=int, default=1)
    options = parser.parse_args(arguments)
    known = shipped() if OUTLINES.exists() else {}
    names = options.names or [*refutations()]
    search = partial(_shortened, known, options.seed, options.tries)
    with mapping(options.jobs) as apply:
        for name, (outline, own) in zip(names, apply(search, names), strict=True):
            known[name] = outline
            click.echo(f"{name:<18} {own.steps:>4} {own.cases:>3}")
            ordered = {name: known[name] for name in refutations() if name in known}
            write_file(OUTLINES, (json.dumps(ordered, separators=(",", ":")) + "\n").encode())


def refutations() -> Iterator[str]:
    """Yield the names of all refutations that ship."""
    for pattern in PATTERN_NAMES:
        for question, answer in _certificate(pattern).answers.items():
            if isinstance(answer, No):
                yield f"{pattern}.{question}"


def _certificate(pattern: str) -> Certificate:
    return read_certificate(pattern, Evidence(default_root()).certificate(pattern))


def _shortened(
    known: dict[str, Outline], seed: int, tries: int, name: str
) -> tuple[Outline, Length]:
    pattern, _, question = name.partition(".")
    reasons = reasons_of(_certificate(pattern), question)
    outline = known.get(name, [])
    for found in shorten(Problem(reasons), seed, tries, outline):
        outline = found.outline
    outline = without_idle_steps(reasons, outline)
    return outline, length(pattern, question, explain(reasons, outline))


if __name__ == "__main__":
    main()
