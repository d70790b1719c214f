"""A witness shows what it says: its numbers are checked here from what is printed alone."""

import json
import re
from collections import Counter
from collections.abc import Callable
from dataclasses import replace
from itertools import combinations
from random import Random
from typing import Any

import jsonschema
import pytest
from hypothesis import given
from hypothesis import strategies as st

from certify.atlas.explain.witness import (
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
from certify.atlas.explain.witness_words import as_json, as_text
from certify.kernel.certificate import Yes
from certify.kernel.chirotope import QUINTUPLES, chirotope
from certify.kernel.embedding import NotRealized, require_convex_position, require_realization
from certify.kernel.jacobian import require_positive_jacobian
from certify.kernel.triangulation import orientation
from certify.report import json_text
from tests.commands import CHECKOUT
from tests.geometry import (
    CUBE,
    CUBE_TRIANGULATIONS,
    FLAT,
    ON_HULL,
    PLACEMENTS,
    Placement,
    Tetrahedra,
    exact,
    examples,
    near,
    sign,
    simplices,
)
from tests.witnesses import (
    SCHEMA,
    YES,
    asked,
    certificate,
    coherent,
    digits,
    every_pattern,
    found,
    require_record,
    some,
    told,
)


def test_there_is_one_for_every_yes() -> None:
    counts = Counter(question for _, question in YES)
    assert counts == {"realizable": 171, "convex": 158, "valid": 143}


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
    text = as_text(told(*flat[0]))
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


def test_support_is_what_it_says() -> None:
    assert found("5_A", "convex").supports[0] == Support(1, (-1, -1, -1), 0, -1)
