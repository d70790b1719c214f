"""Exported evidence: the formula is the kernel's, the core is a part of it, rows are oriented."""

import json
import re
from fractions import Fraction
from pathlib import Path
from typing import Any

import pytest

from certify import export
from certify.dimacs import read_dimacs
from certify.families import Families, of_completeness, of_question
from certify.kernel.certificate import Certificate, No, Yes
from certify.kernel.check import (
    Verdict,
    completeness_formula,
    instances_bounded_by,
    refuted_formula,
)
from certify.kernel.orientations import Clause
from certify.kernel.refutation import replay
from certify.kernel.theorems import Outcome, check_all
from certify.kernel.triangulation import orientation
from tests.geometry import volume


@pytest.fixture(scope="module")
def outcome(shipped: Path) -> Outcome:
    return check_all(shipped)


def accepted(verdict: Verdict) -> Certificate:
    assert verdict.certificate is not None
    return verdict.certificate


def joined(families: Families) -> tuple[Clause, ...]:
    return tuple(clause for clauses in families.values() for clause in clauses)


def test_families_make_the_formula(outcome: Outcome) -> None:
    seen = set()
    for certificate in map(accepted, outcome.verdicts):
        signs = orientation(certificate.tetrahedra)
        for question, answer in certificate.answers.items():
            if isinstance(answer, No):
                families = of_question(question, answer, signs)
                assert joined(families) == refuted_formula(question, answer, signs)
                seen |= {(question, family) for family in families if families[family]}
    assert len(seen) == 3 * 4 + 1 + 3 + 2  # four families always, and then those of a question


@pytest.mark.parametrize("letter", "abcdefg")
def test_families_make_the_formula_of_completeness(outcome: Outcome, letter: str) -> None:
    known = instances_bounded_by(letter, outcome.verdicts)
    assert joined(of_completeness(letter, known)) == completeness_formula(letter, known)


def check_core(stem: Path, whole: tuple[Clause, ...]) -> int:
    """Check the formula that was written, and return how many clauses it has."""
    text = stem.with_name(f"{stem.name}.cnf").read_text()
    formula = read_dimacs(text)
    trace = text.partition("number in the whole:")[2]
    numbers = {int(k): int(n) for k, n in re.findall(r"^c (\d+): (\d+)$", trace, re.M)}
    assert [*numbers] == [*range(1, len(formula) + 1)]
    assert [whole[number - 1] for number in numbers.values()] == formula
    counted = re.findall(r"^c family .*: clauses (\d+) to (\d+)$", text, re.M)
    bounds = [int(bound) for pair in counted for bound in pair]
    assert [bounds[0], bounds[-1]] == [1, len(formula)]
    assert all(b + 1 == c for b, c in zip(bounds[1::2], bounds[2::2], strict=False))
    replay(formula, stem.with_name(f"{stem.name}.lrat").read_text())
    return len(formula)


@pytest.mark.parametrize(
    ("pattern", "question"), [("15_A", "realizable"), ("15_G", "convex"), ("15_K", "valid")]
)
def test_core_of_a_refutation(
    shipped: Path, outcome: Outcome, tmp_path: Path, pattern: str, question: str
) -> None:
    (verdict,) = (found for found in outcome.verdicts if found.pattern == pattern)
    certificate = accepted(verdict)
    answer = certificate.answers[question]
    assert isinstance(answer, No)
    export.export_answer(shipped, certificate, question, tmp_path, core=True)
    whole = refuted_formula(question, answer, orientation(certificate.tetrahedra))
    assert check_core(tmp_path / f"{pattern}.{question}", whole) < len(whole) / 50


def test_core_of_completeness(shipped: Path, outcome: Outcome, tmp_path: Path) -> None:
    export.export_completeness(shipped, outcome, "a", tmp_path, core=True)
    whole = completeness_formula("a", instances_bounded_by("a", outcome.verdicts))
    assert check_core(tmp_path / "complete.a", whole) < len(whole) / 5


@pytest.mark.parametrize("core", [False, True])
def test_plain_is_the_same_without_comments(
    shipped: Path, outcome: Outcome, tmp_path: Path, core: bool
) -> None:
    (certificate,) = (accepted(v) for v in outcome.verdicts if v.pattern == "15_K")
    for name, plain in (("full", False), ("plain", True)):
        export.export_answer(shipped, certificate, "valid", tmp_path / name, core, plain)
        export.export_completeness(shipped, outcome, "a", tmp_path / name, core, plain)
    for path in (tmp_path / "full").iterdir():
        lines = path.read_text().splitlines(keepends=True)
        proper = "".join(line for line in lines if not line.startswith("c"))
        assert (tmp_path / "plain" / path.name).read_text() == proper


def test_core_keeps_deletions(tmp_path: Path) -> None:
    families: Families = {"one": ((1, 2), (3,), (1, -2)), "two": ((-1, 3), (-1, -3), (2, 3))}
    proof = "7 1 0 1 3 0\n7 d 1 3 2 0\n8 0 7 4 5 0\n"
    written = export.refutation(families, proof, [], core=True)
    assert read_dimacs(written["cnf"]) == [(1, 2), (1, -2), (-1, 3), (-1, -3)]
    assert written["lrat"] == "5 1 0 1 2 0\n5 d 1 2 0\n6 0 5 3 4 0\n"
    assert written["drat"] == "1 0\n0\n"
    assert "c family one: clauses 1 to 2\nc family two: clauses 3 to 4\n" in written["cnf"]


def test_exported_tetrahedra_have_positive_volume(
    shipped: Path, outcome: Outcome, tmp_path: Path
) -> None:
    for certificate in map(accepted, outcome.verdicts):
        for question, answer in certificate.answers.items():
            if isinstance(answer, Yes):
                (path,) = export.export_answer(shipped, certificate, question, tmp_path)
                record = json.loads(path.read_text())
                points: Any = [tuple(map(Fraction, point)) for point in record["points"]]
                rows = record["tetrahedra"]
                assert sorted(tuple(sorted(row)) for row in rows) == [*certificate.tetrahedra]
                assert all(volume(*(points[v - 1] for v in row)) > 0 for row in rows)
