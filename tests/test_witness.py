"""A witness shows what it says: its numbers are checked here from what is printed alone."""

import json
import re
import shutil
import subprocess
from collections import Counter
from collections.abc import Callable, Mapping
from dataclasses import replace
from functools import cache
from itertools import combinations, product
from pathlib import Path
from random import Random
from typing import Any

import jsonschema
import pytest
from hypothesis import given
from hypothesis import strategies as st

from certify.atlas.witness import (
    BadWitness,
    Line,
    Support,
    Witness,
    demonstrate,
    few,
    lines,
    missing_faces,
    require,
    supports,
    witness,
)
from certify.atlas.witness_words import as_json, as_latex, as_markdown, as_text, linear, page
from certify.kernel.certificate import PATTERN_NAMES, Certificate, Yes, read_certificate
from certify.kernel.chirotope import QUINTUPLES, chirotope
from certify.kernel.embedding import NotRealized, require_convex_position, require_realization
from certify.kernel.evidence import Evidence
from certify.kernel.jacobian import require_positive_jacobian
from certify.kernel.triangulation import orientation
from certify.report import json_text
from tests.commands import CHECKOUT, five_a, run, write
from tests.geometry import (
    CUBE,
    CUBE_TRIANGULATIONS,
    FLAT,
    ON_HULL,
    PLACEMENTS,
    Placement,
    Tetrahedra,
    dot,
    exact,
    examples,
    leibniz,
    near,
    sign,
    simplices,
    volume,
)


@cache
def certificate(pattern: str) -> Certificate:
    return read_certificate(pattern, Evidence(CHECKOUT).certificate(pattern))


def answered_by_yes() -> list[tuple[str, str]]:
    return [
        (pattern, question)
        for pattern in PATTERN_NAMES
        for question, answer in certificate(pattern).answers.items()
        if isinstance(answer, Yes)
    ]


YES = answered_by_yes()
SHOWN = [("5_A", "valid"), ("8_E", "valid"), ("13_T", "realizable"), ("15_K", "convex")]
"""Those that were looked at."""

every_pattern = pytest.mark.parametrize("pattern", [*dict(YES)])
some = pytest.mark.parametrize(("pattern", "question"), SHOWN, ids=".".join)


@cache
def found(pattern: str, question: str) -> Witness:
    return witness(certificate(pattern), question)


def test_there_is_one_for_every_yes() -> None:
    counts = Counter(question for _, question in YES)
    assert counts == {"realizable": 171, "convex": 158, "valid": 143}


# The criterion, from the printed JSON alone.


def digits(text: str) -> tuple[int, ...]:
    return tuple(map(int, text))


def printed_coefficients(record: Mapping[str, Any], quintuple: str) -> dict[str, int]:
    """Return the coefficients whose determinants are printed."""
    rest = [(v, quintuple[:i] + quintuple[i + 1 :], (-1) ** i) for i, v in enumerate(quintuple)]
    listed = record["determinants"]
    return {v: factor * listed[q] for v, q, factor in rest if q in listed}


def require_record(record: Mapping[str, Any]) -> None:
    """Fail unless the printed numbers are those of the points, and show the answer."""
    points = dict(zip("12345678", map(tuple, record["points"]), strict=True))
    for q, value in record["determinants"].items():
        assert value == volume(*(points[v] for v in q))
    for tetrahedron in record["tetrahedra"]:
        assert record["determinants"][tetrahedron]
    printed = [line["quintuple"] for line in record["lines"]]
    assert printed == ["".join(five) for five in combinations("12345678", 5)]
    for line in record["lines"]:
        require_line(record, line)
    if record["question"] == "convex":
        require_extreme(record)
    if record["question"] == "valid":
        require_bernstein(record)


def require_line(record: Mapping[str, Any], line: Mapping[str, Any]) -> None:
    known = printed_coefficients(record, line["quintuple"])
    needed = line["side"] or line["quintuple"]
    assert line["coefficients"] == {v: known[v] for v in needed}
    if not line["side"]:
        assert line["reason"] == "in one plane"
        assert [*known.values()] == [0] * 5
        return
    assert {sign(known[v]) for v in line["side"]} in ({1}, {-1})
    assert not any(set(line["side"]) <= set(t) for t in record["tetrahedra"])
    words = {2: "no edge", 3: "no triangle", 4: "no tetrahedron"}
    assert line["reason"] == words[len(line["side"])]


def require_extreme(record: Mapping[str, Any]) -> None:
    assert [support["vertex"] for support in record["supports"]] == [*range(1, 9)]
    for support in record["supports"]:
        values = [dot(support["function"], point) for point in record["points"]]
        value = values.pop(support["vertex"] - 1)
        assert (value, max(values)) == (support["value"], support["elsewhere"])
        assert value > max(values)


def jacobian(points: Placement, at: tuple[int, ...]) -> int:
    """Return the Jacobian: its columns are sums of edges, weighted with the other coordinates."""
    columns = []
    for axis in range(3):
        column = [0, 0, 0]
        for corner, point in zip(CUBE, points, strict=True):
            weight = 2 * corner[axis] - 1
            for other in {0, 1, 2} - {axis}:
                weight *= at[other] if corner[other] else 1 - at[other]
            column = [x + weight * y for x, y in zip(column, point, strict=True)]
        columns.append(column)
    return int(leibniz([[*map(int, column)] for column in columns]))  # type: ignore[list-item]


def require_bernstein(record: Mapping[str, Any]) -> None:
    """All are positive, and the polynomial is eight times J at 27 points: so it is everywhere."""
    assert len(record["bernstein"]) == 27
    assert min(record["bernstein"].values()) > 0
    basis = [[(1 - t) ** 2, 2 * t * (1 - t), t**2] for t in range(3)]
    points = tuple(map(tuple, record["points"]))
    for u, v, w in product(range(3), repeat=3):
        value = sum(
            b * basis[u][i] * basis[v][j] * basis[w][k]
            for index, b in record["bernstein"].items()
            for i, j, k in [digits(index)]
        )
        assert value == 8 * jacobian(points, (u, v, w))


def coherent(record: Mapping[str, Any]) -> bool:
    """Do any two tetrahedra with a common triangle lie on its two sides?"""
    points = dict(zip("12345678", map(tuple, record["points"]), strict=True))

    def side(common: set[str], apex: set[str]) -> int:
        a, b, c, d = (points[v] for v in (*sorted(common), *apex))
        return sign(volume(a, b, c, d))

    return all(
        side(s & t, s - t) == -side(s & t, t - s) != 0
        for s, t in combinations(map(set, record["tetrahedra"]), 2)
        if len(s & t) == 3
    )


def asked(pattern: str) -> list[str]:
    """Return the questions that are answered by yes."""
    return [question for name, question in YES if name == pattern]


@every_pattern
def test_what_is_printed_shows_the_answer(pattern: str) -> None:
    for question in asked(pattern):
        require_what_is_printed(pattern, question)


def require_what_is_printed(pattern: str, question: str) -> None:
    printed = json_text(as_json(found(pattern, question), pattern))
    record = json.loads(printed)
    assert (record["pattern"], record["question"]) == (pattern, question)
    assert [*map(digits, record["tetrahedra"])] == [*certificate(pattern).tetrahedra]
    require_record(record)
    assert coherent(record)
    jsonschema.validate(record, SCHEMA)


@every_pattern
def test_the_points_are_those_of_the_certificate(pattern: str) -> None:
    for question in asked(pattern):
        require_the_points(pattern, question)


def require_the_points(pattern: str, question: str) -> None:
    shown, answer = found(pattern, question), certificate(pattern).answers[question]
    assert isinstance(answer, Yes)
    for point, original in zip(shown.points, answer.points, strict=True):
        assert point == tuple(x * s for x, s in zip(original, shown.scales, strict=True))


SCHEMA = {
    "type": "object",
    "additionalProperties": False,
    "required": ["title", "pattern", "question", "tetrahedra", "scales", "points", "determinants",
                 "lines", "whole", "tightest"],
    "properties": {
        "title": {"type": "string"},
        "pattern": {"enum": [*PATTERN_NAMES]},
        "question": {"enum": ["realizable", "convex", "valid"]},
        "tetrahedra": {"type": "array", "minItems": 5, "items": {"$ref": "#/$defs/quadruple"}},
        "scales": {"$ref": "#/$defs/vector"},
        "points": {"type": "array", "minItems": 8, "maxItems": 8,
                   "items": {"$ref": "#/$defs/vector"}},
        "determinants": {"type": "object", "propertyNames": {"$ref": "#/$defs/quadruple"},
                         "additionalProperties": {"type": "integer"}},
        "lines": {"type": "array", "minItems": 56, "maxItems": 56, "items": {
            "type": "object",
            "additionalProperties": False,
            "required": ["quintuple", "side", "reason", "coefficients"],
            "properties": {
                "quintuple": {"type": "string", "pattern": "^[1-8]{5}$"},
                "side": {"type": "string", "pattern": "^([1-8]{2,4})?$"},
                "reason": {"enum": ["no edge", "no triangle", "no tetrahedron", "in one plane"]},
                "coefficients": {"type": "object", "propertyNames": {"pattern": "^[1-8]$"},
                                 "additionalProperties": {"type": "integer"}}}}},
        "whole": {"type": "integer", "minimum": 1},
        "tightest": {"type": "array", "minItems": 3, "maxItems": 3,
                     "items": {"$ref": "#/$defs/quadruple"}},
        "supports": {"type": "array", "minItems": 8, "maxItems": 8, "items": {
            "type": "object",
            "additionalProperties": False,
            "required": ["vertex", "function", "value", "elsewhere"],
            "properties": {"vertex": {"type": "integer"}, "value": {"type": "integer"},
                           "function": {"$ref": "#/$defs/vector"},
                           "elsewhere": {"type": "integer"}}}},
        "bernstein": {"type": "object", "propertyNames": {"pattern": "^[012]{3}$"},
                      "additionalProperties": {"type": "integer"}},
    },
    "dependentSchemas": {"bernstein": {"properties": {"question": {"const": "valid"}}},
                         "supports": {"properties": {"question": {"const": "convex"}}}},
    "$defs": {"quadruple": {"type": "string", "pattern": "^[1-8]{4}$"},
              "vector": {"type": "array", "minItems": 3, "maxItems": 3,
                         "items": {"type": "integer"}}},
}  # fmt: skip


# Few determinants.


def test_as_few_as_the_changelog_says() -> None:
    counts = [len(found(*name).determinants) for name in YES]
    assert f"({min(counts)} to {max(counts)} of the 70)" in (CHECKOUT / "CHANGELOG.md").read_text()


@some
def test_none_can_be_left_out(pattern: str, question: str) -> None:
    shown = found(pattern, question)
    missing = missing_faces(shown.tetrahedra)
    for q in shown.determinants.keys() - {*shown.tetrahedra}:
        rest = {other: value for other, value in shown.determinants.items() if other != q}
        assert not all(any(lines(quintuple, rest, missing)) for quintuple in QUINTUPLES)


@every_pattern
def test_the_tightest_are_the_smallest(pattern: str) -> None:
    for shown in (found(pattern, question) for question in asked(pattern)):
        sizes = sorted(abs(value) for value in shown.determinants.values() if value)
        assert [abs(shown.determinants[q]) for q in shown.tightest] == sizes[:3]
        assert shown.whole == sum(abs(shown.determinants[t]) for t in shown.tetrahedra)


@some
def test_missing_faces(pattern: str, question: str) -> None:
    """A set of two to five vertices is in no tetrahedron iff it has one of them."""
    tetrahedra = certificate(pattern).tetrahedra
    missing = missing_faces(tetrahedra)
    for size in (2, 3, 4):
        for face in combinations(range(1, 9), size):
            has_one = any({*one} <= {*face} for one in missing)
            assert has_one != any({*face} <= {*t} for t in tetrahedra)
    assert not any({*one} < {*other} for one in missing for other in missing)


# The kernel accepts the same.


def kernel_accepts(tetrahedra: Tetrahedra, placement: Placement, question: str) -> bool:
    """Does the kernel accept the points, a Jacobian without any subdivision?"""
    points = exact(placement)
    try:
        require_realization(orientation(tetrahedra), chirotope(points))
        if question == "convex":
            require_convex_position(chirotope(points))
        return question != "valid" or require_positive_jacobian(points) == 0
    except NotRealized:
        return False


def accepts(tetrahedra: Tetrahedra, placement: Placement, question: str) -> bool:
    """Is there a witness? Then what is printed of it must be right too."""
    try:
        shown = demonstrate(tetrahedra, exact(placement), question)
    except BadWitness:
        return False
    require_record(as_json(shown, "5_A"))
    return True


PATTERNS = st.sampled_from(["5_A", "7_C", "9_F", "11_AD", "13_T", "15_A", "15_K"])
QUESTIONS = st.sampled_from(["realizable", "convex", "valid"])


@examples(200)
@given(PATTERNS, QUESTIONS, st.one_of(PLACEMENTS, FLAT, ON_HULL))
def test_whatever_the_points(pattern: str, question: str, placement: Placement) -> None:
    tetrahedra = certificate(pattern).tetrahedra
    expected = kernel_accepts(tetrahedra, placement, question)
    assert accepts(tetrahedra, placement, question) == expected


@examples(150)
@given(st.sampled_from([*CUBE_TRIANGULATIONS.values()]), QUESTIONS, near(CUBE, 4, 1))
def test_near_the_cube(tetrahedra: Tetrahedra, question: str, placement: Placement) -> None:
    expected = kernel_accepts(tetrahedra, placement, question)
    assert accepts(tetrahedra, placement, question) == expected


def shaken(placement: Placement, shift: int, random: Random) -> Placement:
    return tuple(tuple(x + random.randint(-shift, shift) for x in p) for p in placement)


@pytest.mark.parametrize("question", ["realizable", "convex", "valid"])
def test_around_the_certificates(question: str) -> None:
    """Shaken a little and much, so that some are accepted, some not, and many degenerate."""
    random, outcomes = Random(174), {True: 0, False: 0}
    for pattern, answered in YES[::7]:
        answer = certificate(pattern).answers[answered]
        assert isinstance(answer, Yes)
        tetrahedra = certificate(pattern).tetrahedra
        start = tuple(tuple(map(int, point)) for point in answer.points)
        for shift in (0, 1, 1, 2):
            placement = shaken(start, shift, random)
            expected = kernel_accepts(tetrahedra, placement, question)
            assert accepts(tetrahedra, placement, question) == expected
            outcomes[expected] += 1
    assert min(outcomes.values()) > 40


@examples(200)
@given(st.one_of(ON_HULL, PLACEMENTS, near(CUBE, 3, 1)))
def test_supports_exist_in_convex_position_only(placement: Placement) -> None:
    signs = chirotope(exact(placement))
    if not any(signs.values()):
        return
    try:
        require_convex_position(signs)
    except NotRealized:
        with pytest.raises(BadWitness):
            [*supports(placement)]
    else:
        assert [support.vertex for support in supports(placement)] == [*range(1, 9)]


def test_supports_with_large_coefficients() -> None:
    """Where no small function will do, the sum of normals does."""
    narrow = tuple((x + 100 * y, y, z) for x, y, z in CUBE)
    found_ = [*supports(narrow)]
    assert max(abs(x) for support in found_ for x in support.function) > 100


def test_five_points_in_one_plane() -> None:
    """The only shipped witness with such a line says so."""
    flat = [name for name in YES for line in found(*name).lines if not line.side]
    assert len(flat) == 1
    text = as_text(page(found(*flat[0]), flat[0][0]))
    assert re.search(r"^  in one plane +\d{5} 00000$", text, re.MULTILINE)
    assert "Five points in one plane need no such vertices" in text


# Spoiled witnesses.


def with_line(shown: Witness, index: int, line: Line) -> Witness:
    return replace(shown, lines=(*shown.lines[:index], line, *shown.lines[index + 1 :]))


def without(shown: Witness, quadruple: tuple[int, ...]) -> Witness:
    rest = {q: value for q, value in shown.determinants.items() if q != quadruple}
    return replace(shown, determinants=rest)


def a_needed_one(shown: Witness) -> tuple[int, ...]:
    return next(q for q in shown.determinants if q not in shown.tetrahedra)


def other_support(shown: Witness, **changes: Any) -> Witness:
    first, *rest = shown.supports
    return replace(shown, supports=(replace(first, **changes), *rest))


SPOILED: dict[str, tuple[str, Callable[[Witness], Witness]]] = {
    "a determinant": (
        "valid",
        lambda w: replace(w, determinants={q: 2 * value for q, value in w.determinants.items()}),
    ),
    "a point": ("valid", lambda w: replace(w, points=((1, 1, 1), *w.points[1:]))),
    "a tetrahedron unlisted": ("valid", lambda w: without(w, w.tetrahedra[0])),
    "another unlisted": ("valid", lambda w: without(w, a_needed_one(w))),
    "mirrored": (
        "realizable",
        lambda w: replace(
            w,
            points=tuple((-x, y, z) for x, y, z in w.points),
            determinants={q: -value for q, value in w.determinants.items()},
        ),
    ),
    "a line missing": ("valid", lambda w: replace(w, lines=w.lines[1:])),
    "lines exchanged": ("valid", lambda w: replace(w, lines=w.lines[::-1])),
    "one vertex": ("valid", lambda w: with_line(w, 0, replace(w.lines[0], side=(2,)))),
    "all vertices": (
        "valid",
        lambda w: with_line(w, 0, replace(w.lines[0], side=w.lines[0].quintuple)),
    ),
    "not in the quintuple": ("valid", lambda w: with_line(w, 0, replace(w.lines[0], side=(1, 7)))),
    "no vertex": ("valid", lambda w: with_line(w, 0, replace(w.lines[0], side=()))),
    "no support": ("convex", lambda w: replace(w, supports=w.supports[1:])),
    "a support moved": ("convex", lambda w: other_support(w, vertex=2)),
    "no function": ("convex", lambda w: other_support(w, function=(0, 0, 0))),
    "opposite": ("convex", lambda w: other_support(w, function=(1, 1, 1), value=0, elsewhere=3)),
    "a larger value": ("convex", lambda w: other_support(w, value=9)),
    "no Bernstein coefficients": ("valid", lambda w: replace(w, bernstein={})),
    "another of them": ("valid", lambda w: replace(w, bernstein={**w.bernstein, (1, 1, 1): 9})),
}


@pytest.mark.parametrize("how", SPOILED)
def test_a_spoiled_witness_shows_nothing(how: str) -> None:
    question, spoil = SPOILED[how]
    shown = found("5_A", question)
    require(shown)
    with pytest.raises(BadWitness):
        require(spoil(shown))


def test_every_sign_matters() -> None:
    """With any side on the wrong side of one of its determinants, a line is refused."""
    shown = found("8_E", "valid")
    for index, line in enumerate(shown.lines):
        for v in line.quintuple:
            side = tuple(sorted({*line.side} ^ {v}))
            changed = with_line(shown, index, replace(line, side=side))
            values = {sign(shown.coefficients(line).get(u, 0)) for u in line.side}
            true = side and not any({*side} <= {*t} for t in shown.tetrahedra)
            known = {sign(c) for c in shown.coefficients(changed.lines[index]).values()}
            complete = len(shown.coefficients(changed.lines[index])) == len(side)
            assert values in ({1}, {-1})
            if true and complete and known == values:
                require(changed)
            else:
                with pytest.raises(BadWitness):
                    require(changed)


def test_faces_that_meet_are_named() -> None:
    with pytest.raises(BadWitness, match="both sides of the circuit of 12345 are faces"):
        few(simplices("1234 1235"), dict.fromkeys(combinations(range(1, 9), 4), 1))


def test_only_a_yes_has_a_witness() -> None:
    with pytest.raises(ValueError, match="15_A valid is not answered by yes"):
        witness(certificate("15_A"), "valid")


# Words.


def told(pattern: str, question: str) -> Any:
    return page(found(pattern, question), pattern)


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


def test_support_is_what_it_says() -> None:
    assert found("5_A", "convex").supports[0] == Support(1, (-1, -1, -1), 0, -1)
