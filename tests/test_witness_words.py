"""What is said of a witness is true, and well formed in all formats."""

import json
import re
import shutil
import subprocess
from itertools import product
from pathlib import Path

import pytest

from certify.atlas.explain.witness_words import as_json, as_latex, as_markdown, as_text, linear
from tests.commands import five_a, run, write
from tests.geometry import CUBE, cross, dot, minus, sign, volume
from tests.witnesses import (
    YES,
    asked,
    certificate,
    digits,
    every_pattern,
    found,
    printed_coefficients,
    require_record,
    some,
    told,
)


@every_pattern
def test_text_fits_a_terminal(pattern: str) -> None:
    for text in (as_text(told(pattern, question)) for question in asked(pattern)):
        assert text.isascii()
        assert not re.search(r"[$`{}\\]", text)
        assert all(len(line) <= 80 and line == line.rstrip() for line in text.splitlines())
        assert text.startswith(f"{pattern} ")


@every_pattern
def test_the_text_has_every_number(pattern: str) -> None:
    """What can be read off it are the determinants, and 56 rows of true signs with their sides."""
    for question in asked(pattern):
        require_every_number(pattern, question)


def require_every_number(pattern: str, question: str) -> None:
    shown, text = found(pattern, question), as_text(told(pattern, question))
    table = text.partition("1. Determinants.")[2].partition("2. Circuits.")[0]
    read = {digits(q): int(value) for q, value in re.findall(r"\[(\d{4})\] = (-?\d+)", table)}
    assert read == shown.determinants
    rows: dict[str, tuple[str, str]] = {}
    side = ""
    for line in text.partition("2. Circuits.")[2].splitlines():
        if re.search(r"\d{5} [-+.0]{5}", line):
            side = head[1] if (head := re.match(r"  (\d*) ?(?:no|in) ", line)) else side
            rows |= {
                five: (marks, side) for five, marks in re.findall(r"(\d{5}) ([-+.0]{5})", line)
            }
    record = as_json(shown, pattern)
    assert len(rows) == 56
    for five, (marks, side) in rows.items():
        known = printed_coefficients(record, five)
        for v, mark in zip(five, marks, strict=True):
            assert mark == "." or "0+-"[sign(known[v])] == mark
            assert (mark != ".") == (v in (side or five))


def valid_texts() -> dict[str, str]:
    """Return the text for every valid pattern, in one line."""
    return {
        name: " ".join(as_text(told(name, question)).split())
        for name, question in YES
        if question == "valid"
    }


def test_the_coefficients_are_the_means_that_the_text_describes() -> None:
    """Its lists of edges, each with two coordinates 0 or 1 that stay as they are."""
    text = valid_texts()["8_E"]
    directions = [
        [digits(edge) for edge in re.findall(r"\b\d\d\b", listed.partition(";")[0])]
        for listed in re.findall(r"in direction [uvw] \(([^)]*)\)", text)
    ]
    for axis, edges in enumerate(directions):
        steps = {minus(CUBE[head - 1], CUBE[tail - 1]) for tail, head in edges}
        assert (len(edges), steps) == (4, {tuple(int(k == axis) for k in range(3))})
    points = found("8_E", "valid").points
    values: dict[tuple[int, ...], list[int]] = {index: [] for index in product(range(3), repeat=3)}
    for chosen in product(*directions):
        tails = [CUBE[tail - 1] for tail, _ in chosen]
        sums = (sum(tails[k][axis] for k in range(3) if k != axis) for axis in range(3))
        u, v, w = (minus(points[head - 1], points[tail - 1]) for tail, head in chosen)
        values[tuple(sums)].append(dot(cross(u, v), w))
    for index, b in found("8_E", "valid").bernstein.items():
        assert b * len(values[index]) == 8 * sum(values[index])


def test_the_examples_of_the_text_are_right() -> None:
    """Of all choices, these are the one for 000 and the two for 100."""
    text = valid_texts()["5_A"]
    assert "So b_000 is that of 12, 14, 15, and b_100 is the mean of those of 12, 14, 26" in text
    assert "12, 14, 26 and of 12, 23, 15." in text
    for edges, index in ((("12", "14", "15"), 0), (("12", "14", "26"), 1), (("12", "23", "15"), 1)):
        tails = [CUBE[int(edge[0]) - 1] for edge in edges]
        sums = [sum(tails[k][axis] for k in range(3) if k != axis) for axis in range(3)]
        assert sums == [index, 0, 0]


def test_a_triangle_shows_that_nothing_is_mirrored() -> None:
    """It is on the boundary, and counterclockwise seen from the middle of the cube."""
    double = tuple(tuple(2 * x for x in corner) for corner in CUBE)
    for name, text in valid_texts().items():
        sentence = r"not mirrored: \[(\d{4})\] > 0, so seen from (\d) the triangle (\d{3}) of"
        ((quadruple, apex, triangle),) = re.findall(sentence, text)
        assert quadruple == triangle + apex
        points = found(name, "valid").points
        a, b, c, d = digits(quadruple)
        assert tuple(sorted((a, b, c, d))) in certificate(name).tetrahedra
        assert volume(points[a - 1], points[b - 1], points[c - 1], points[d - 1]) > 0
        assert volume(double[a - 1], double[b - 1], double[c - 1], (1, 1, 1)) > 0
        assert any(
            {double[v - 1][axis] for v in (a, b, c)} == {side}
            for axis in range(3)
            for side in (0, 2)
        )


def test_the_example_row_is_true() -> None:
    """The two are separated by the plane of the three others, and have the printed coefficients."""
    for pattern, question in YES[::5]:
        text = " ".join(as_text(told(pattern, question)).split())
        sentence = (
            r"To check the row of (\d{5}): the coefficients are (.*?), and no .*? has (\d+)\."
        )
        ((five, values, side),) = re.findall(sentence, text)
        known = printed_coefficients(as_json(found(pattern, question), pattern), five)
        assert values == " and ".join(f"{known[v]} for {v}" for v in side)
        for plane, *pair in re.findall(r"the plane (\d{3}) separates (\d) from (\d)", text):
            a, b, c = (found(pattern, question).points[v - 1] for v in digits(plane))
            one, other = (found(pattern, question).points[int(v) - 1] for v in pair)
            assert (side, sorted(plane + side)) == ("".join(pair), sorted(five))
            assert volume(a, b, c, one) * volume(a, b, c, other) < 0


@some
def test_narrow_text(pattern: str, question: str) -> None:
    assert all(len(line) <= 70 for line in as_text(told(pattern, question), 70).splitlines())


@every_pattern
def test_markdown_and_latex_are_well_formed(pattern: str) -> None:
    for question in asked(pattern):
        require_well_formed(pattern, question)


def require_well_formed(pattern: str, question: str) -> None:
    markdown, latex = as_markdown(told(pattern, question)), as_latex(told(pattern, question))
    assert all(text.count("$") % 2 == 0 for text in (*markdown.splitlines(), *latex.splitlines()))
    assert markdown.count("`") == 2 * 56
    for table in re.findall(r"(?:^\|.*\n)+", markdown, re.MULTILINE):
        assert len({row.count("|") for row in table.splitlines()}) == 1
    assert latex.count(r"\begin{tabular}") == latex.count(r"\end{tabular}") >= 3
    assert latex.count("{") == latex.count("}")
    assert latex.count(r"\texttt{") == 56
    assert latex.endswith(r"\end{document}")


@pytest.mark.skipif(not shutil.which("pdflatex"), reason="pdflatex is not installed")
@some
def test_latex_is_one_page(tmp_path: Path, pattern: str, question: str) -> None:
    (tmp_path / "x.tex").write_text(as_latex(told(pattern, question)))
    command = ["pdflatex", "-interaction=nonstopmode", "-halt-on-error", "x.tex"]
    done = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stdout[-2000:]
    assert "Overfull" not in done.stdout
    assert "Output written on x.pdf (1 page" in done.stdout


def test_linear_functions() -> None:
    functions = [(1, -2, 3), (-1, 0, 1), (0, -4, -1), (0, 1, 0)]
    assert [*map(linear, functions)] == ["x - 2y + 3z", "-x + z", "-4y - z", "y"]


def test_fractions_are_made_integers(root: Path) -> None:
    document = five_a()
    for question in ("realizable", "convex", "valid"):
        points = [[f"{x}/2", y, f"{z}/3"] for x, y, z in CUBE]
        document[question] = {"answer": "yes", "points": points}
    write(root, document)
    code, out, _ = run(root, "explain", "5_A", "valid")
    assert code == 0
    assert "(To make them integers, x, y, z were multiplied by 2, 1, 3.)" in " ".join(out.split())
    text = as_text(told("5_A", "valid"))
    assert out.partition("1. Determinants")[2].strip() == text.partition("1. Determinants")[2]


# The command.


@some
def test_command(shipped: Path, pattern: str, question: str) -> None:
    code, out, err = run(shipped, "explain", pattern, question)
    assert (code, out, err) == (0, as_text(told(pattern, question)) + "\n", "")
    code, out, err = run(shipped, "explain", pattern, question, "--format", "json")
    assert (code, err) == (0, "")
    require_record(json.loads(out))
    for form, start in (("markdown", f"# {pattern} "), ("latex", r"\documentclass")):
        code, out, _ = run(shipped, "explain", pattern, question, "--format", form)
        assert code == 0
        assert out.startswith(start)


def test_open_is_not_explained(root: Path) -> None:
    write(root, five_a() | {"valid": {"answer": "open"}})
    code, out, err = run(root, "explain", "5_A", "valid")
    assert (code, out) == (2, "")
    assert err == "certify: 5_A valid is answered by open; a yes or a no is explained\n"


def test_what_is_rejected_is_not_explained(root: Path) -> None:
    write(root, five_a() | {"valid": {"answer": "yes", "points": [[0, 0, 0]] * 8}})
    code, out, err = run(root, "explain", "5_A", "realizable")
    assert (code, out) == (1, "")
    assert err.startswith("certify: rejected: certificates/5_A.json: valid: ")


NEEDS_SUBDIVISION = [
    [1, 0, -2], [2, 2, 1], [2, 4, 0], [-1, 5, -2], [-1, -2, 5], [2, 1, 4], [6, 5, 5], [-2, 6, 5],
]  # fmt: skip


def test_what_needs_subdivision_is_refused(root: Path) -> None:
    """The kernel accepts these points, but the 27 coefficients do not show it."""
    write(root, five_a() | {"valid": {"answer": "yes", "points": NEEDS_SUBDIVISION}})
    assert run(root, "check", "5_A")[0] == 0
    code, out, err = run(root, "explain", "5_A", "valid")
    assert (code, out) == (1, "")
    assert err.startswith("certify: 5_A valid: the 27 Bernstein coefficients are not all positive")
    assert err.count("\n") == 1
