"""The JSON Schema describes the format that the kernel reads."""

import json
from collections.abc import Callable
from itertools import combinations
from pathlib import Path
from typing import Any

import pytest
from jsonschema import Draft202012Validator

import certify
from certify.kernel.certificate import (
    FORMAT,
    MAX_DIGITS,
    PATTERN_NAMES,
    QUESTIONS,
    read_certificate,
)
from certify.kernel.evidence import Malformed
from certify.kernel.hexahedron import BOUNDARY_TYPES

SCHEMA = json.loads((Path(certify.__file__).parent / "schema" / "pattern.schema.json").read_text())
VALIDATOR = Draft202012Validator(SCHEMA)
CERTIFICATES = Path(__file__).resolve().parents[1] / "certificates"

Document = dict[str, Any]
Spoil = Callable[[Document], object]


def document() -> Document:
    """Return a well-formed document with one answer of each kind; nothing in it is true."""
    return {
        "format": FORMAT,
        "pattern": "8_E",
        "boundary": "d",
        "instances": 48,
        "tetrahedra": [[1, 2, 3, 4], [1, 2, 3, 8], [5, 6, 7, 8]],
        "realizable": {"answer": "yes", "points": [[i, -i, f"-{i}/7"] for i in range(8)]},
        "convex": {"answer": "open"},
        "valid": {
            "answer": "no",
            "proof": "proofs/8_E.valid.lrat",
            "sha256": "0" * 64,
            "final_polynomials": [
                {
                    "signs": {"1234": 1, "1235": -1, "5678": 0},
                    "inequalities": [[2, [1, 2, 3, 4, 5, 6]], [1, [8, 7, 6, 5, 4, 3]]],
                }
            ],
        },
    }


def is_read(content: object) -> bool:
    """Does the kernel read this, in a file of the right name?"""
    try:
        read_certificate("8_E", json.dumps(content).encode())
    except Malformed:
        return False
    return True


def put(*keys: str | int, value: object) -> Spoil:
    """Return the spoil that replaces what is found under these keys, one below the other."""

    def spoil(content: Any) -> None:
        for key in keys[:-1]:
            content = content[key]
        content[keys[-1]] = value

    return spoil


def drop(*keys: str | int) -> Spoil:
    """Return the spoil that removes what is found under these keys, one below the other."""

    def spoil(content: Any) -> None:
        for key in keys[:-1]:
            content = content[key]
        del content[keys[-1]]

    return spoil


POINT = ("realizable", "points", 3)
POLYNOMIAL = ("valid", "final_polynomials", 0)
SIX = (*POLYNOMIAL, "inequalities", 0, 1)

NO_COORDINATES: list[object] = [
    *(0.5, None, False, [], "", "1", "1.5", "1/0", "1/-2", "+1/2", "01/2", "1/02"),
    *("1 / 2", " 1/2", "a/b", "1/2/3", "\u0661/2"),
]

ALLOWED: list[Spoil] = [
    lambda content: content,
    put("instances", value=-3),
    put("tetrahedra", value=[]),
    put("realizable", value={"answer": "open"}),
    put(*POINT, 0, value=10**MAX_DIGITS - 1),
    put(*POINT, 0, value=1 - 10 ** (MAX_DIGITS - 1)),
    put(*POINT, 0, value="-0/9"),
    put(*POINT, 0, value="1" * MAX_DIGITS + "/" + "1" * (MAX_DIGITS - 1)),
    drop("valid", "final_polynomials"),
    put("valid", "final_polynomials", value=[]),
    put(*POLYNOMIAL, "signs", value={}),
    put(*POLYNOMIAL, "inequalities", value=[]),
    put(*POLYNOMIAL, "inequalities", 0, 0, value=-1),
]

SPOILED: list[Spoil] = [
    *(drop(key) for key in document()),
    *(put(key, value=None) for key in document()),
    *(put(key, value=[]) for key in document() if key != "tetrahedra"),
    *(put(question, value="yes") for question in QUESTIONS),
    put("extra", value=1),
    put("format", value="certify-pattern/2"),
    put("format", value=1),
    *(put("pattern", value=name) for name in ("", "8_e", "8_H", "4_A", "08_E", "8_E ", "x8_E")),
    put("boundary", value="h"),
    put("boundary", value="D"),
    put("boundary", value=""),
    *(put("instances", value=value) for value in ("48", 48.5, True, [48], 10**MAX_DIGITS)),
    put("instances", value=-(10 ** (MAX_DIGITS - 1))),
    put("tetrahedra", value={}),
    put("tetrahedra", 0, value="1234"),
    put("tetrahedra", 0, value=[1, 2, 4, 3]),
    put("tetrahedra", 0, value=[1, 2, 3, 3]),
    put("tetrahedra", 0, value=[1, 2, 3]),
    put("tetrahedra", 0, value=[1, 2, 3, 4, 5]),
    put("tetrahedra", 0, value=[0, 1, 2, 3]),
    put("tetrahedra", 2, value=[6, 7, 8, 9]),
    put("tetrahedra", 0, value=[True, 2, 3, 4]),
    put("tetrahedra", 0, value=[1, 2, 3, "4"]),
    put("tetrahedra", 1, value=[1, 2, 3, 4]),
    put("convex", "answer", value="maybe"),
    put("convex", "answer", value=True),
    put("convex", value={}),
    put("convex", "points", value=[]),
    drop("realizable", "points"),
    put("realizable", "proof", value="proofs/8_E.realizable.lrat"),
    put("realizable", "answer", value="no"),
    put("realizable", "points", value="points"),
    drop("realizable", "points", 0),
    put("realizable", "points", value=[[0, 0, 0]] * 9),
    put(*POINT, value=[0, 0]),
    put(*POINT, value=[0, 0, 0, 0]),
    put(*POINT, value={"x": 0}),
    *(put(*POINT, 1, value=value) for value in NO_COORDINATES),
    put(*POINT, 1, value="1" * MAX_DIGITS + "/" + "1" * MAX_DIGITS),
    put(*POINT, 1, value=10**MAX_DIGITS),
    drop("valid", "proof"),
    drop("valid", "sha256"),
    put("valid", "points", value=[]),
    put("valid", "sha256", value=0),
    put("valid", "sha256", value="0" * 63),
    put("valid", "sha256", value="A" * 64),
    put("valid", "proof", value=0),
    *(
        put("valid", "proof", value=proof)
        for proof in (
            "../x.lrat",
            "/proofs/8_E.valid.lrat",
            "proofs/../8_E.valid.lrat",
            "./proofs/8_E.valid.lrat",
            "proofs/8_E.valid.drat",
            "proofs/8_E.convex.lrat",
            "proofs/8_E.valid.lrat/",
            "proofs/8_Exvalid.lrat",
        )
    ),
    put("valid", "final_polynomials", value={}),
    put("valid", "final_polynomials", value=None),
    put(*POLYNOMIAL, value=[]),
    put(*POLYNOMIAL, "extra", value=[]),
    drop(*POLYNOMIAL, "signs"),
    drop(*POLYNOMIAL, "inequalities"),
    put(*POLYNOMIAL, "signs", value=[]),
    put(*POLYNOMIAL, "inequalities", value={}),
    *(
        put(*POLYNOMIAL, "signs", key, value=1)
        for key in ("", "123", "1324", "1123", "12345", "0123", "6789", "1 23", "abcd")
    ),
    *(put(*POLYNOMIAL, "signs", "1234", value=value) for value in (2, -2, "1", True, None, 0.5)),
    put(*POLYNOMIAL, "inequalities", 0, value=[1]),
    put(*POLYNOMIAL, "inequalities", 0, value=[1, [1, 2, 3, 4, 5, 6], 1]),
    put(*POLYNOMIAL, "inequalities", 0, value=[[1, 2, 3, 4, 5, 6], 1]),
    put(*POLYNOMIAL, "inequalities", 0, 0, value="1"),
    put(*POLYNOMIAL, "inequalities", 0, 0, value=True),
    put(*SIX, value=[1, 2, 3, 4, 5]),
    put(*SIX, value=[1, 2, 3, 4, 5, 6, 7]),
    put(*SIX, value=[1, 2, 3, 4, 5, 5]),
    put(*SIX, value=[0, 2, 3, 4, 5, 6]),
    put(*SIX, value=[9, 2, 3, 4, 5, 6]),
    put(*SIX, value=[True, 2, 3, 4, 5, 6]),
    put(*SIX, value="123456"),
]


def test_the_schema_is_one() -> None:
    Draft202012Validator.check_schema(SCHEMA)


@pytest.mark.parametrize("name", PATTERN_NAMES)
def test_certificates_conform(name: str) -> None:
    VALIDATOR.validate(json.loads((CERTIFICATES / f"{name}.json").read_text()))


@pytest.mark.parametrize("change", ALLOWED)
def test_both_accept(change: Spoil) -> None:
    content = document()
    change(content)
    assert is_read(content)
    VALIDATOR.validate(content)


@pytest.mark.parametrize("spoil", SPOILED)
def test_both_reject(spoil: Spoil) -> None:
    content = document()
    spoil(content)
    assert json.dumps(content) != json.dumps(document())
    assert not is_read(content)
    assert not VALIDATOR.is_valid(content)


@pytest.mark.parametrize("content", [None, [], "certificate", 1, {}, [document()]])
def test_both_reject_what_is_no_object(content: object) -> None:
    assert not is_read(content)
    assert not VALIDATOR.is_valid(content)


def test_names_and_letters_are_the_kernels() -> None:
    properties = SCHEMA["properties"]
    suffixes = [*"ABCDEFGHIJKLMNOPQRSTUVWXYZ"]
    suffixes += [a + b for a in suffixes for b in suffixes[:26]]
    names = [f"{size}_{suffix}" for size in range(20) for suffix in suffixes]
    pattern = Draft202012Validator(properties["pattern"])
    assert {name for name in names if pattern.is_valid(name)} == set(PATTERN_NAMES)
    assert properties["boundary"]["enum"] == list(BOUNDARY_TYPES)
    assert [key for key in properties if key in QUESTIONS] == list(QUESTIONS)
    assert properties.keys() == set(SCHEMA["required"])
    quadruples = SCHEMA["$defs"]["quadruple"]["enum"]
    assert quadruples == [list(four) for four in combinations(range(1, 9), 4)]


@pytest.mark.parametrize(
    "change",
    [
        put("pattern", value="8_D"),
        put("tetrahedra", value=document()["tetrahedra"][::-1]),
        put("instances", value=48.0),
        put("valid", "proof", value="proofs/8_D.valid.lrat"),
    ],
)
def test_the_reader_is_stricter_where_the_schema_says_so(change: Spoil) -> None:
    content = document()
    change(content)
    assert VALIDATOR.is_valid(content)
    assert not is_read(content)
