"""Explanations are proofs that the kernel replays, and what is printed is what they say."""

import json
import re
import shutil
import subprocess
from collections import Counter
from collections.abc import Callable, Iterator
from copy import deepcopy
from functools import cache
from itertools import product
from pathlib import Path
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st
from pysat.solvers import Solver

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
from certify.atlas.explain.outlines import explained, reasons_of, refutations
from certify.atlas.explain.outlines import shipped as outlines
from certify.atlas.explain.reasons import ANY, SIGN, Reason, Reasons, Signs, literals_for
from certify.atlas.explain.shorten import Problem, length_of, shorten
from certify.atlas.explain.words import account, as_latex, as_markdown, as_text, cycles
from certify.kernel.certificate import Certificate, No, read_certificate
from certify.kernel.check import refuted_formula
from certify.kernel.evidence import Evidence
from certify.kernel.orientations import Clause, has_sign
from certify.kernel.refutation import NotRefuted, replay
from certify.kernel.triangulation import label, orientation
from tests.commands import CHECKOUT, run
from tests.geometry import examples

NAMES = [*refutations()]
QUICK = ["11_AD.valid", "12_U.valid", "15_A.realizable", "15_G.valid", "15_H.convex"]
"""Of all three questions, with cases, with a symmetry, and with a final polynomial."""

every_refutation = pytest.mark.parametrize("name", NAMES)


def certificate_of(name: str) -> Certificate:
    pattern = name.partition(".")[0]
    return read_certificate(pattern, Evidence(CHECKOUT).certificate(pattern))


@cache
def reasons(name: str) -> Reasons:
    return reasons_of(certificate_of(name), name.partition(".")[2])


@cache
def explanation(name: str) -> Explanation:
    return explained(certificate_of(name), name.partition(".")[2])


def formula(name: str) -> tuple[Clause, ...]:
    """Return what the kernel refutes."""
    certificate, question = certificate_of(name), name.partition(".")[2]
    answer = certificate.answers[question]
    assert isinstance(answer, No)
    return refuted_formula(question, answer, orientation(certificate.tetrahedra))


# They are proofs.


def test_every_refutation_has_an_outline() -> None:
    assert [*outlines()] == NAMES
    assert len(NAMES) == 50


@every_refutation
def test_the_kernel_replays_what_an_outline_says(name: str) -> None:
    """Against its own formula; and without its last lemma, or any hint, it does not."""
    found = explain(reasons(name), outlines()[name])
    replay(formula(name), found.lrat)
    *rest, last = found.lrat.splitlines(keepends=True)
    with pytest.raises(NotRefuted):
        replay(formula(name), "".join(rest) or "\n")
    *_, hint, end = last.split(" ")
    with pytest.raises(NotRefuted):
        replay(formula(name), "".join(rest) + last.removesuffix(f" {hint} {end}") + " 0\n")


def test_they_are_as_short_as_the_document_says() -> None:
    found = re.findall(r"at most (\d+)( steps,|\.$)", (CHECKOUT / "CHECKING.md").read_text(), re.M)
    ((said, _), (valid, _)) = found
    longest = dict.fromkeys(("realizable", "convex", "valid"), 0)
    for name, outline in outlines().items():
        question = name.partition(".")[2]
        longest[question] = max(longest[question], length_of(outline)[0])
    assert (longest["realizable"], longest["valid"]) == (int(said), int(valid))


@every_refutation
def test_every_step_is_used(name: str) -> None:
    items = [*explanation(name).items()]
    assert [item.number for item in items] == [*range(1, len(items) + 1)]
    used = {0}
    for item in items:
        if isinstance(item, Step):
            used.update(item.uses)
        if isinstance(item, Case):
            used.add(item.steps[-1].number)
        if isinstance(item, Mirror):
            used.add(item.of)
    assert used >= {item.number for item in items[:-1]}
    assert items[-1].fact.signs == 0


@every_refutation
def test_the_length_is_that_of_the_outline(name: str) -> None:
    items = [*explanation(name).items()]
    cases = sum(isinstance(item, Case) for item in items)
    assert (len(items), cases) == length_of(outlines()[name])


@pytest.mark.parametrize("name", QUICK)
def test_the_clauses_that_a_step_names_show_its_fact(name: str) -> None:
    """With what the step uses, and the fact denied, they have no solution."""
    clauses = dict(enumerate(formula(name), start=1))
    for step in (item for item in explanation(name).items() if isinstance(item, Step)):
        used = [c for q, signs in step.before.items() for c in literals_for(q, signs)]
        for wanted in literals_for(step.fact.determinant, step.fact.signs):
            denied = [(-literal,) for literal in wanted]
            known = literals_for(step.fact.determinant, step.fact.signs | step.excluded)
            own = [clauses[number] for number in step.clauses]
            with Solver(bootstrap_with=[*own, *used, *known, *denied]) as solver:
                assert not solver.solve()
            with Solver(bootstrap_with=[*used, *known, *denied]) as solver:
                assert solver.solve()


def test_idle_steps_are_left_out() -> None:
    """Whatever else is put in front of the shipped outline, it alone remains."""
    name = "15_K.valid"
    outline, known = outlines()[name], reasons(name).given
    mentioned = {entry[1] for entry in outline}
    now = {
        r: tuple(known.get(q, (ANY,))[0] for q in r.determinants)
        for r in reasons(name).reasons.values()
    }
    idle = [
        [reason.name, label(q)]
        for reason, signs in now.items()
        for q, before, after in zip(reason.determinants, signs, reason.conclude(signs), strict=True)
        if after != before and label(q) not in mentioned
    ]
    assert idle
    assert without_idle_steps(reasons(name), [idle[0], *outline]) == outline


# Spoiled outlines.


def places(outline: Outline) -> Iterator[Outline]:
    """Yield the outline and those inside it."""
    yield outline
    for entry in outline:
        if isinstance(entry, dict):
            yield from places(entry["then"])


def spoiled(name: str, change: Callable[[Outline], Any]) -> Iterator[Outline]:
    """Yield the outline with one of its parts changed."""
    for k in range(len([*places(outlines()[name])])):
        copied = deepcopy(outlines()[name])
        change([*places(copied)][k])
        yield copied


CHANGES: dict[str, Callable[[Outline], Any]] = {
    "without the end": lambda outline: outline.pop(),
    "without the beginning": lambda outline: outline.pop(0),
    "the same twice": lambda outline: outline.insert(0, outline[0]),
    "another reason": lambda outline: outline.insert(-1, ["12|3456", "5678"]),
    "no reason": lambda outline: outline.insert(0, ["magic", "1234"]),
    "no determinant": lambda outline: outline.insert(0, ["12|3456", "12"]),
    "a case that is none": lambda outline: outline.insert(
        0, {"suppose": ["1357", 7], "then": outline[:]}
    ),
    "a case that does not fail": lambda outline: outline.insert(
        0, {"suppose": ["1357", 4], "then": []}
    ),
    "nothing": lambda outline: outline.clear(),
}


@pytest.mark.parametrize("name", QUICK)
@pytest.mark.parametrize("change", CHANGES.values(), ids=CHANGES)
def test_a_spoiled_outline_explains_nothing(name: str, change: Callable[[Outline], Any]) -> None:
    for outline in spoiled(name, change):
        with pytest.raises(BadOutline):
            explain(reasons(name), outline)


@pytest.mark.parametrize("digits", ["12345678", "21345678", "21436587"])
def test_only_symmetries_of_the_pattern_repeat_a_case(digits: str) -> None:
    """The identity says nothing new; an exchange of 1 and 2 is none; a reflection is none of it."""
    outline = deepcopy(outlines()["11_AD.valid"])
    (case, *_) = (entry for entry in outline if isinstance(entry, dict))
    case["also"] = [digits]
    with pytest.raises(BadOutline):
        explain(reasons("11_AD.valid"), outline)


# Reasons.


def allowed(reason: Reason, clauses: dict[int, Clause]) -> list[tuple[int, ...]]:
    """Return the signs of its determinants that satisfy the clauses of a reason."""
    found = []
    for values in product((-1, 0, 1), repeat=len(reason.determinants)):
        true = {
            has_sign(quadruple, sign) if sign == value else -has_sign(quadruple, sign)
            for quadruple, value in zip(reason.determinants, values, strict=True)
            for sign in (1, -1)
        }
        if all(not true.isdisjoint(clauses[number]) for number in reason.clauses):
            found.append(values)
    return found


SHORT = [
    (name, reason)
    for name in ("15_A.convex", "15_K.valid")
    for reason in [*reasons(name).reasons.values()][::37]
]


@pytest.mark.parametrize(("name", "reason"), SHORT, ids=lambda x: getattr(x, "name", x))
@examples(30)
@given(st.lists(st.integers(1, 7), min_size=6, max_size=6))
def test_a_reason_concludes_what_its_clauses_imply(
    name: str, reason: Reason, masks: list[Signs]
) -> None:
    signs = tuple(masks[: len(reason.determinants)])
    values = allowed(reason, dict(enumerate(reasons(name).formula, start=1)))
    remaining = [0] * len(signs)
    for row in values:
        bits = [next(bit for bit, sign in SIGN.items() if sign == value) for value in row]
        if all(bit & mask for bit, mask in zip(bits, signs, strict=True)):
            remaining = [r | bit for r, bit in zip(remaining, bits, strict=True)]
    assert reason.conclude(signs) == tuple(remaining)


def test_every_clause_is_in_one_reason() -> None:
    for name in ("15_A.convex", "15_G.valid"):
        found = reasons(name)
        numbers = [k for reason in found.reasons.values() for k in reason.clauses]
        numbers += [k for _, k in found.given.values()]
        numbers += found.exclusive.values()
        twice = {k for k in numbers if numbers.count(k) > 1} if name == "15_G.valid" else set()
        assert not twice
        assert len(found.reasons) == len({reason.name for reason in found.reasons.values()})
        missing = set(range(1, len(found.formula) + 1)) - set(numbers)
        assert all(len(found.formula[k - 1]) == 1 for k in missing)  # corners that are tetrahedra


# The search.


@pytest.mark.parametrize("name", ["12_U.valid", "12_Y.valid"])
def test_the_search_finds_explanations(name: str) -> None:
    problem = Problem(reasons(name))
    found = [*shorten(problem, 7, 3, [])]
    assert found
    for one in found:
        explain(reasons(name), one.outline)
    assert [one.length for one in found] == sorted((one.length for one in found), reverse=True)
    assert [*shorten(problem, 7, 3, [])] == found


def test_another_instance_is_explained_too(tmp_path: Path) -> None:
    """The shipped outline does not fit its labels."""
    certificate = certificate_of("12_Y.valid")
    renamed = dict(zip(range(1, 9), (2, 1, 4, 3, 6, 5, 8, 7), strict=True))
    tetrahedra = tuple(sorted(tuple(sorted(renamed[v] for v in t)) for t in certificate.tetrahedra))
    other = Certificate("12_Y", certificate.boundary, 1, tetrahedra, certificate.answers)
    assert explained(other, "valid").lrat != explanation("12_Y.valid").lrat


# Words.


def told(name: str) -> Any:
    _, _, question = name.partition(".")
    return account(explanation(name), certificate_of(name), question)


def test_a_final_polynomial_is_told_so_that_it_can_be_followed() -> None:
    """Its signs are the facts that the last step uses, and its determinants cancel."""
    for name, number in (
        ("15_G.valid", 1),
        ("15_F.convex", 1),
        ("13_T.convex", 1),
        ("15_G.convex", 2),
    ):
        account_ = told(name)
        assert [final.number for final in account_.polynomials] == [*range(1, number + 1)]
        facts = {*account_.given, *(line.says for line in account_.lines)}
        for final in account_.polynomials:
            assert len(facts.intersection(final.signs)) >= len(final.signs) - 1
            surplus: Counter[str] = Counter()
            for own in final.inequalities:
                surplus.update({q: own.times * own.larger.count(q) for q in own.larger})
                surplus.subtract({q: own.times * own.smaller.count(q) for q in own.smaller})
            assert not any(surplus.values())
            assert ">" in {own.compared for own in final.inequalities}
        text = as_text(account_)
        assert text.count("Final polynomial ") == number
        assert max(map(len, text.splitlines())) <= 80
    assert told("15_K.valid").polynomials == ()


@every_refutation
def test_text_fits_a_terminal(name: str) -> None:
    text = as_text(told(name))
    assert text.isascii()
    assert all(len(line) <= 80 for line in text.splitlines())
    assert text.rstrip().splitlines()[0].startswith(name.partition(".")[0])
    numbers = re.findall(r"^ *(\d+)\. ", text, re.MULTILINE)
    assert numbers == [str(k) for k in range(1, len(numbers) + 1)]
    assert len(numbers) == length_of(outlines()[name])[0]


@pytest.mark.parametrize("name", QUICK)
def test_markdown_has_a_line_for_every_step(name: str) -> None:
    text = as_markdown(told(name))
    assert text.count("- **") == length_of(outlines()[name])[0]
    assert text.count("$") % 2 == 0


@pytest.mark.skipif(not shutil.which("pdflatex"), reason="pdflatex is not installed")
@pytest.mark.parametrize("name", QUICK)
def test_latex_compiles(tmp_path: Path, name: str) -> None:
    (tmp_path / "x.tex").write_text(as_latex(told(name)))
    command = ["pdflatex", "-interaction=nonstopmode", "-halt-on-error", "x.tex"]
    done = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stdout[-2000:]
    assert "Overfull" not in done.stdout


def test_cycles() -> None:
    assert cycles((7, 6, 5, 8, 3, 2, 1, 4)) == "(1 7)(2 6)(3 5)(4 8)"
    assert cycles((2, 3, 1, 4, 5, 6, 7, 8)) == "(1 2 3)"


# The command.


def test_command(shipped: Path) -> None:
    code, out, err = run(shipped, "explain", "15_K", "valid")
    assert (code, err) == (0, "")
    assert out == as_text(told("15_K.valid")) + "\n"
    code, out, _ = run(shipped, "explain", "15_K", "valid", "--format", "json")
    assert code == 0
    record = json.loads(out)
    assert record["title"] == "15_K carries no valid hexahedron"
    assert record["lines"][-1]["says"] == "contradiction"


def test_the_table_of_lengths(shipped: Path) -> None:
    code, out, err = run(shipped, "explain", "--all", "--format", "json")
    assert (code, err) == (0, "")
    found = json.loads(out)["explanations"]
    assert len(found) == len(NAMES)
    assert [own["steps"] for own in found] == sorted((own["steps"] for own in found), reverse=True)
    for own in found:
        name = f"{own['pattern']}.{own['question']}"
        assert own["steps"] == own["cases"] + own["mirrored"] + sum(own["kinds"].values())
        assert (own["steps"], own["cases"]) == length_of(outlines()[name])


def test_a_rejected_certificate_never_makes_the_table_shorter(root: Path) -> None:
    code, out, _ = run(root, "explain", "--all")
    assert code == 1
    assert "\nrejected: certificates/15_B.json: " in out
    code, out, _ = run(root, "explain", "--all", "--format", "json")
    assert code == 1
    assert any("15_B.json" in fault for fault in json.loads(out)["rejected"])


@pytest.mark.parametrize(
    ("arguments", "code", "message"),
    [
        ((), 2, "name a pattern and a question, or else --all"),
        (("5_A",), 2, "name a pattern and a question, or else --all"),
        (("5_A", "valid", "--all"), 2, "name a pattern and a question, or else --all"),
        (("--all", "--format", "latex"), 2, "--all is printed as text or json, not as latex"),
        (("5_A", "round"), 2, "unknown question round; it must be one of "),
        (("16_A", "valid"), 2, "unknown pattern 16_A; see 'certify list'"),
        (("15_A", "valid", "--format", "word"), 2, "Invalid value for '--format'"),
    ],
)
def test_bad_requests(shipped: Path, arguments: tuple[str, ...], code: int, message: str) -> None:
    found, out, err = run(shipped, "explain", *arguments)
    assert (found, out) == (code, "")
    assert err.startswith(f"certify: {message}")
    assert err.count("\n") == 1


def test_what_is_rejected_is_not_explained(root: Path) -> None:
    (root / "proofs" / "15_A.valid.lrat").write_text("1 0 0\n")
    code, out, err = run(root, "explain", "15_A", "realizable")
    assert (code, out) == (1, "")
    assert err.startswith("certify: rejected: certificates/15_A.json: valid: ")
