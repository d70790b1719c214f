"""Witnesses, and what is printed of them, checked by other means than theirs."""

from collections.abc import Mapping
from functools import cache
from itertools import combinations, product
from typing import Any

import pytest

from certify.atlas.explain.witness import Witness, witness
from certify.atlas.explain.witness_words import Page, page
from certify.kernel.certificate import PATTERN_NAMES, Certificate, Yes, read_certificate
from certify.kernel.evidence import Evidence
from tests.commands import CHECKOUT
from tests.geometry import CUBE, Placement, dot, leibniz, sign, volume


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
some = pytest.mark.parametrize(("pattern", "question"), SHOWN)


@cache
def found(pattern: str, question: str) -> Witness:
    return witness(certificate(pattern), question)


def told(pattern: str, question: str) -> Page:
    return page(found(pattern, question), pattern)


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
