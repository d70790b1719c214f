"""Strict reading of one certificate: what is not exactly as specified is refused.

A certificate is a JSON object, format "certify-pattern/1"; FORMAT.md specifies it key by key.
Reading it establishes only that it is well formed. What it claims is decided in check.py.
"""

import json
import re
from collections.abc import Callable, Iterable
from dataclasses import dataclass
from fractions import Fraction
from string import ascii_uppercase
from typing import Any, TypeAlias, TypeVar

from certify.kernel.chirotope import QUADRUPLES, Point
from certify.kernel.evidence import Malformed, proof_file
from certify.kernel.hexahedron import BOUNDARY_TYPES, VERTICES, Simplex
from certify.kernel.refutation import FinalPolynomial

FORMAT = "certify-pattern/1"
QUESTIONS = ("realizable", "convex", "valid")

PATTERN_COUNTS = {5: 1, 6: 5, 7: 5, 8: 7, 9: 13, 10: 20, 11: 35, 12: 30, 13: 28, 14: 19, 15: 11}
"""Number of tetrahedra -> number of patterns in the paper's Table 1."""

_SUFFIXES = (*ascii_uppercase, *("A" + letter for letter in ascii_uppercase))

PATTERN_NAMES: tuple[str, ...] = tuple(
    f"{size}_{suffix}" for size, count in PATTERN_COUNTS.items() for suffix in _SUFFIXES[:count]
)
"""The paper's 174 names 5_A .. 15_K, in order; after 11_Z comes 11_AA."""

MAX_DIGITS = 40
"""Longest integer, and half the longest fraction: enough for honest points, too short to stall."""

_QUADRUPLE = {"".join(map(str, quadruple)): quadruple for quadruple in QUADRUPLES}
_DIGEST = re.compile(r"[0-9a-f]{64}")
_FRACTION = re.compile(r"-?(0|[1-9][0-9]*)/[1-9][0-9]*")


@dataclass(frozen=True)
class Yes:
    """The eight points that show it, vertex 1 first."""

    points: tuple[Point, ...]


@dataclass(frozen=True)
class No:
    """The clausal proof that shows it (a file below the root), and polynomials it builds on."""

    proof: str
    digest: str
    final_polynomials: tuple[FinalPolynomial, ...]


@dataclass(frozen=True)
class Open:
    """Nobody has found out yet."""


Answer: TypeAlias = Yes | No | Open
T = TypeVar("T")


@dataclass(frozen=True)
class Certificate:
    """One pattern: its tetrahedra, what is said of them, and the answers to the questions."""

    pattern: str
    boundary: str
    instances: int
    tetrahedra: tuple[Simplex, ...]
    answers: dict[str, Answer]


def read_certificate(pattern: str, content: bytes) -> Certificate:
    """Return the certificate that a file named after the pattern holds, or raise Malformed."""
    record = _object(_parse(content), "the file")
    _keys(record, ("format", "pattern", "boundary", "instances", "tetrahedra", *QUESTIONS))
    if record["format"] != FORMAT:
        raise Malformed(f'format is not "{FORMAT}"')
    name = _text(record["pattern"], "pattern")
    if name not in PATTERN_NAMES:
        raise Malformed("pattern is not one of the 174 names")
    if name != pattern:
        raise Malformed(f"pattern is {name}, but the file is named after {pattern}")
    boundary = _text(record["boundary"], "boundary")
    if boundary not in BOUNDARY_TYPES:
        raise Malformed("boundary is not one of the letters a to g")
    tetrahedra = tuple(
        tuple(_integer(vertex, "a vertex") for vertex in _list(row, "a tetrahedron"))
        for row in _list(record["tetrahedra"], "tetrahedra")
    )
    if not set(tetrahedra) <= set(QUADRUPLES) or list(tetrahedra) != sorted(set(tetrahedra)):
        raise Malformed("tetrahedra are not increasing quadruples of 1..8 in increasing order")
    return Certificate(
        pattern=name,
        boundary=boundary,
        instances=_integer(record["instances"], "instances"),
        tetrahedra=tetrahedra,
        answers={
            question: _located(question, _answer, record[question], name, question)
            for question in QUESTIONS
        },
    )


def _parse(content: bytes) -> object:
    def unique(pairs: list[tuple[str, object]]) -> dict[str, object]:
        record = dict(pairs)
        if len(record) < len(pairs):
            raise Malformed("an object has the same key twice")
        return record

    def refuse(literal: str) -> object:
        raise Malformed(f"{literal[:20]} is not an integer")

    def integer(literal: str) -> int:
        if len(literal) > MAX_DIGITS:
            raise Malformed(f"an integer has more than {MAX_DIGITS} characters")
        return int(literal)

    try:
        return json.loads(
            content.decode("utf-8"),
            object_pairs_hook=unique,
            parse_int=integer,
            parse_float=refuse,
            parse_constant=refuse,
        )
    except UnicodeDecodeError:
        raise Malformed("the file is not UTF-8 text") from None
    except json.JSONDecodeError as error:
        raise Malformed(f"the file is not JSON: {error}") from None
    except RecursionError:
        raise Malformed("the file is nested too deeply") from None


def _located(where: str, read: Callable[..., T], *arguments: Any) -> T:
    """Return what is read, and put the place before what is wrong with it."""
    try:
        return read(*arguments)
    except Malformed as error:
        raise Malformed(f"{where}: {error}") from None


def _answer(value: object, pattern: str, question: str) -> Answer:
    record = _object(value, "the answer")
    match record.get("answer"):
        case "open":
            _keys(record, ("answer",))
            return Open()
        case "yes":
            _keys(record, ("answer", "points"))
            points = _list(record["points"], "points")
            if len(points) != len(VERTICES):
                raise Malformed(f"points has {len(points)} points instead of eight")
            return Yes(
                tuple(
                    _located(f"point {vertex}", _point, point)
                    for vertex, point in zip(VERTICES, points, strict=True)
                )
            )
        case "no":
            _keys(record, ("answer", "proof", "sha256"), optional=("final_polynomials",))
            proof = _text(record["proof"], "proof")
            if proof != proof_file(pattern, question):
                raise Malformed(f"proof is not {proof_file(pattern, question)}")
            polynomials = _list(record.get("final_polynomials", []), "final_polynomials")
            digest = _text(record["sha256"], "sha256")
            if not _DIGEST.fullmatch(digest):
                raise Malformed("sha256 is not 64 hexadecimal digits")
            return No(proof, digest, tuple(map(_final_polynomial, polynomials)))
    raise Malformed('answer is not "yes", "no" or "open"')


def _point(value: object) -> Point:
    point = tuple(map(_coordinate, _list(value, "the point")))
    if len(point) != 3:
        raise Malformed(f"it has {len(point)} coordinates instead of three")
    return point


def _coordinate(value: object) -> Fraction:
    if isinstance(value, str) and len(value) <= 2 * MAX_DIGITS and _FRACTION.fullmatch(value):
        return Fraction(value)
    if type(value) is not int:
        raise Malformed("a coordinate is neither an integer nor a fraction p/q")
    return Fraction(value)


def _final_polynomial(value: object) -> FinalPolynomial:
    record = _object(value, "a final polynomial")
    _keys(record, ("signs", "inequalities"))
    signs = {}
    for key, sign in _object(record["signs"], "signs").items():
        if key not in _QUADRUPLE or _integer(sign, "a sign") not in (-1, 0, 1):
            raise Malformed("signs does not map quadruples like 1234 to -1, 0 or 1")
        signs[_QUADRUPLE[key]] = sign
    inequalities = []
    for row in _list(record["inequalities"], "inequalities"):
        multiplier, indices = _pair(row)
        six = tuple(_integer(v, "a vertex") for v in _list(indices, "the indices"))
        if len(six) != 6 or len(set(six)) != 6 or not set(six) <= set(VERTICES):
            raise Malformed("an inequality does not have six different vertices")
        inequalities.append((_integer(multiplier, "a multiplier"), six))
    return FinalPolynomial(signs, tuple(inequalities))


def _pair(value: object) -> tuple[object, object]:
    row = _list(value, "an inequality")
    if len(row) != 2:
        raise Malformed("an inequality is not [multiplier, vertices]")
    return row[0], row[1]


def _object(value: object, what: str) -> dict[str, Any]:
    if not isinstance(value, dict):
        raise Malformed(f"{what} is not an object")
    return value


def _list(value: object, what: str) -> list[Any]:
    if not isinstance(value, list):
        raise Malformed(f"{what} is not a list")
    return value


def _text(value: object, what: str) -> str:
    if not isinstance(value, str):
        raise Malformed(f"{what} is not a string")
    return value


def _integer(value: object, what: str) -> int:
    if type(value) is not int:  # a bool is an int to isinstance
        raise Malformed(f"{what} is not an integer")
    return value


def _keys(record: dict[str, Any], needed: Iterable[str], optional: Iterable[str] = ()) -> None:
    for key in needed:
        if key not in record:
            raise Malformed(f'"{key}" is missing')
    for key in record:
        if key not in (*needed, *optional):
            raise Malformed(f"unknown key {key[:40]!a}")
