"""Whatever is wrong with a file, the verdict says so in one line, and nothing is raised."""

import json
from collections.abc import Callable, Iterator
from fractions import Fraction
from hashlib import sha256
from math import lcm
from pathlib import Path
from shutil import copy
from typing import Any, TypeAlias

import pytest
from hypothesis import given
from hypothesis import strategies as st

from certify.kernel.certificate import QUESTIONS, Certificate, No, Open, Yes, read_certificate
from certify.kernel.check import Verdict, check_pattern
from certify.kernel.evidence import MAX_CERTIFICATE_BYTES, MAX_PROOF_BYTES
from certify.kernel.refutation import FinalPolynomial
from tests.geometry import (
    CUBE,
    QUADRUPLES,
    VERTICES,
    exact,
    examples,
    is_extreme,
    realizes,
    signs_of,
)
from tests.test_schema import Document, Spoil, document, drop, put

YES, NO = "5_A", "15_A"
"""Patterns with three answers of this kind."""

PROOF = f"proofs/{NO}.realizable.lrat"

Json: TypeAlias = Any
Arrange: TypeAlias = Callable[[Path], object]


@pytest.fixture
def root(tmp_path: Path, shipped: Path) -> Path:
    return partial_copy(shipped, tmp_path)


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory, shipped: Path) -> Path:
    """Return a root whose certificates are overwritten again and again."""
    return partial_copy(shipped, tmp_path_factory.mktemp("root"))


def partial_copy(shipped: Path, root: Path) -> Path:
    """Copy the certificates of two patterns, with their proofs."""
    for place in ("certificates", "proofs"):
        (root / place).mkdir()
        for name in (YES, NO):
            for file in (shipped / place).glob(f"{name}.*"):
                copy(file, root / place)
    return root


def path_of(root: Path, name: str = YES) -> Path:
    return root / "certificates" / f"{name}.json"


def fault(root: Path, name: str = YES) -> str:
    """Return why the certificate is rejected, without the file's name, which comes first."""
    verdict = check_pattern(root, name)
    assert verdict.fault is not None
    assert not verdict.instances or "rejected" in verdict.answers.values()
    file, _, reason = verdict.fault.partition(": ")
    assert file == f"certificates/{name}.json"
    assert verdict.fault.isprintable()
    return reason


def test_what_is_spoiled_below_is_accepted(root: Path) -> None:
    assert check_pattern(root, YES).answers == dict.fromkeys(QUESTIONS, "yes")
    assert check_pattern(root, NO).answers == dict.fromkeys(QUESTIONS, "no")
    path_of(root, "8_E").write_text(json.dumps(document()))
    assert fault(root, "8_E") == "tetrahedra: 1234 is a boundary tetrahedron"


# The file.


def instead(place: Arrange) -> Arrange:
    """Return what puts something else where a file was."""

    def arrange(path: Path) -> None:
        path.unlink()
        place(path)

    return arrange


def link_to_nowhere(path: Path) -> None:
    path.symlink_to("nowhere")


def link_to_itself(path: Path) -> None:
    path.symlink_to(path)


def linked(path: Path) -> None:
    """Put a link to the same content, in the same folder, in the place of a file."""
    path.symlink_to(path.rename(path.with_suffix(".moved")))


def linked_folder(path: Path) -> None:
    """Put a link in the place of the folder of a file."""
    path.parent.symlink_to(path.parent.rename(path.parents[1] / "elsewhere"))


A_LINK = "is a symbolic link, or lies behind one"


ARRANGEMENTS: dict[str, tuple[Arrange, str]] = {
    "missing": (Path.unlink, "5_A.json is missing, or is not a regular file"),
    "a folder": (instead(Path.mkdir), "5_A.json is missing, or is not a regular file"),
    "a link": (linked, f"certificates/5_A.json {A_LINK}"),
    "in a folder that is a link": (linked_folder, f"certificates/5_A.json {A_LINK}"),
    "a broken link": (instead(link_to_nowhere), f"certificates/5_A.json {A_LINK}"),
    "a circle of links": (instead(link_to_itself), "5_A.json is missing, or is not a regular file"),
    "no folder": (
        lambda path: path.parent.rename(path.parents[1] / "elsewhere"),
        "5_A.json is missing, or is not a regular file",
    ),
    "too large": (
        lambda path: path.write_bytes(path.read_bytes().ljust(MAX_CERTIFICATE_BYTES + 1)),
        f"5_A.json is larger than {MAX_CERTIFICATE_BYTES} bytes",
    ),
    "of another name": (
        lambda path: path_of(path.parents[1], NO).replace(path),
        "pattern is 15_A, but the file is named after 5_A",
    ),
}


@pytest.mark.parametrize(("arrange", "reason"), ARRANGEMENTS.values(), ids=ARRANGEMENTS)
def test_file_is_refused(root: Path, arrange: Arrange, reason: str) -> None:
    arrange(path_of(root))
    assert fault(root) == reason


def test_largest_file_is_read(root: Path) -> None:
    path = path_of(root)
    path.write_bytes(path.read_bytes().ljust(MAX_CERTIFICATE_BYTES))
    assert check_pattern(root, YES).fault is None


def test_unreadable_file_is_refused(root: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def refuse(path: Path, mode: str) -> None:
        raise PermissionError(13, "Permission denied")

    monkeypatch.setattr(Path, "open", refuse)
    assert fault(root) == "5_A.json cannot be read: Permission denied"


# Its text.


TEXTS: dict[str, tuple[bytes, str]] = {
    "empty": (b"", "the file is not JSON: Expecting value"),
    "not UTF-8": (b'{"format": "\xe9"}', "the file is not UTF-8 text"),
    "UTF-16": ("{}".encode("utf-16"), "the file is not UTF-8 text"),
    "a byte-order mark": (b"\xef\xbb\xbf{}", "the file is not JSON: Unexpected UTF-8 BOM"),
    "binary": (bytes(range(128)), "the file is not JSON: "),
    "truncated": (b'{"format": "certify-pat', "the file is not JSON: Unterminated string"),
    "continued": (b"{} {}", "the file is not JSON: Extra data"),
    "a comment": (b"{} // nothing", "the file is not JSON: Extra data"),
    "single quotes": (b"{'format': 1}", "the file is not JSON: "),
    "a control character": (b'{"for\nmat": 1}', "the file is not JSON: Invalid control character"),
    "nested lists": (b"[" * 30_000 + b"]" * 30_000, "the file is nested too deeply"),
    "nested objects": (b'{"a":' * 12_000, "the file is nested too deeply"),
    "a key twice": (b'{"format": 1, "format": 1}', "an object has the same key twice"),
    "an escaped key twice": (b'{"a": 1, "\\u0061": 1}', "an object has the same key twice"),
    "an inner key twice": (b'{"a": [{"b": 1, "b": 1}]}', "an object has the same key twice"),
    "a float": (b'{"instances": 2.0}', "2.0 is not an integer"),
    "an exponent": (b'{"instances": 1e999}', "1e999 is not an integer"),
    "a long float": (b"0." + b"1" * 9999, f"0.{'1' * 18} is not an integer"),
    "not a number": (b'{"instances": NaN}', "NaN is not an integer"),
    "infinity": (b"[Infinity]", "Infinity is not an integer"),
    "minus infinity": (b"-Infinity", "-Infinity is not an integer"),
    "a huge integer": (b"1" * 5000, "an integer has more than 40 characters"),
    "41 characters": (b"-" + b"1" * 40, "an integer has more than 40 characters"),
    "no object": (b"[]", "the file is not an object"),
    "null": (b"null", "the file is not an object"),
}


@pytest.mark.parametrize(("content", "reason"), TEXTS.values(), ids=TEXTS)
def test_text_is_refused(root: Path, content: bytes, reason: str) -> None:
    path_of(root).write_bytes(content)
    assert fault(root).startswith(reason)


# What it says. The document in test_schema.py is well formed.


NAME = "pattern is not one of the 174 names"
ORDER = "tetrahedra are not increasing quadruples of 1..8 in increasing order"
VERTEX = "a vertex is not an integer"
COORDINATE = "realizable: point 1: a coordinate is neither an integer nor a fraction p/q"
NO_PROOF = "valid: proof is not proofs/8_E.valid.lrat"
SIGNS = "signs does not map quadruples like 1234 to -1, 0 or 1"
SIX = "an inequality does not have six different vertices"

QUADS = "tetrahedra"
POINTS = ("realizable", "points")
POLYNOMIALS = ("valid", "final_polynomials")
POLYNOMIAL = (*POLYNOMIALS, 0)
INEQUALITY = (*POLYNOMIAL, "inequalities", 0)

NO_COORDINATES: list[object] = [
    *("1/0", "1/00", "1.5", "01/2", "1/02", "1/-2", "+1/2", "--1/2", " 1/2", "1/2\n", "1 /2"),
    *("1/2/3", "1", "", "a/b", "1_0/3", "\u0661/\u0662", "\uff11/2", "\u00bd"),
    *(None, True, [], {}, "1" * 40 + "/" + "1" * 40, "1" * 40 + "/" + "1" * 99),
]

STATEMENTS: list[tuple[Spoil, str]] = [
    *((drop(key), f'"{key}" is missing') for key in document()),
    (put("extra", value=1), "unknown key 'extra'"),
    (put("line\nbreak", value=1), r"unknown key 'line\nbreak'"),
    (put("\ud800", value=1), r"unknown key '\ud800'"),
    (put("x" * 99, value=1), f"unknown key '{'x' * 40}'"),
    (put("format", value="certify-pattern/2"), 'format is not "certify-pattern/1"'),
    (put("format", value=None), 'format is not "certify-pattern/1"'),
    (put("pattern", value="8_D"), "pattern is 8_D, but the file is named after 8_E"),
    (put("pattern", value="8_e"), NAME),
    (put("pattern", value=8), "pattern is not a string"),
    (put("boundary", value="h"), "boundary is not one of the letters a to g"),
    (put("boundary", value="de"), "boundary is not one of the letters a to g"),
    (put("boundary", value=["d"]), "boundary is not a string"),
    (put("instances", value=True), "instances is not an integer"),
    (put("instances", value="48"), "instances is not an integer"),
    (put(QUADS, value={}), "tetrahedra is not a list"),
    (put(QUADS, 0, value="1234"), "a tetrahedron is not a list"),
    (put(QUADS, 0, 0, value=True), VERTEX),
    (put(QUADS, 0, 0, value="1"), VERTEX),
    (put(QUADS, 0, value=[2, 1, 3, 4]), ORDER),
    (put(QUADS, 0, value=[1, 2, 3, 3]), ORDER),
    (put(QUADS, 0, value=[1, 2, 3]), ORDER),
    (put(QUADS, 0, value=[]), ORDER),
    (put(QUADS, 0, value=[1, 2, 3, 4, 5]), ORDER),
    (put(QUADS, 0, value=[0, 1, 2, 3]), ORDER),
    (put(QUADS, 2, value=[6, 7, 8, 9]), ORDER),
    (put(QUADS, 1, value=[1, 2, 3, 4]), ORDER),
    (put(QUADS, value=document()[QUADS][::-1]), ORDER),
    (put("convex", value="open"), "convex: the answer is not an object"),
    (put("convex", value={}), 'convex: answer is not "yes", "no" or "open"'),
    (put("convex", "answer", value="maybe"), 'convex: answer is not "yes", "no" or "open"'),
    (put("convex", "answer", value=["yes"]), 'convex: answer is not "yes", "no" or "open"'),
    (put("convex", "points", value=[]), "convex: unknown key 'points'"),
    (put("realizable", "proof", value=""), "realizable: unknown key 'proof'"),
    (put("valid", "points", value=[]), "valid: unknown key 'points'"),
    (drop("realizable", "points"), 'realizable: "points" is missing'),
    (drop("valid", "proof"), 'valid: "proof" is missing'),
    (drop("valid", "sha256"), 'valid: "sha256" is missing'),
    # Points.
    (put(*POINTS, value="points"), "realizable: points is not a list"),
    (drop(*POINTS, 0), "realizable: points has 7 points instead of eight"),
    (put(*POINTS, value=[[0, 0, 0]] * 9), "realizable: points has 9 points instead of eight"),
    (put(*POINTS, 0, value=0), "realizable: point 1: the point is not a list"),
    (put(*POINTS, 0, value=[0, 0]), "realizable: point 1: it has 2 coordinates instead of three"),
    (put(*POINTS, 0, value=[0] * 4), "realizable: point 1: it has 4 coordinates instead of three"),
    *((put(*POINTS, 0, 0, value=value), COORDINATE) for value in NO_COORDINATES),
    # Refutations.
    (put("valid", "proof", value=0), "valid: proof is not a string"),
    *(
        (put("valid", "proof", value=path), NO_PROOF)
        for path in [
            *("", "proofs/../proofs/8_E.valid.lrat", "../proofs/8_E.valid.lrat"),
            *("/proofs/8_E.valid.lrat", "./proofs/8_E.valid.lrat", "proofs//8_E.valid.lrat"),
            *("proofs/8_D.valid.lrat", "proofs/8_E.convex.lrat", "proofs/8_E.valid.drat"),
            *("proofs/8_E.valid.lrat\n", "proofs/8_E.valid.lrat\0", "proofs/8_e.valid.lrat"),
        ]
    ),
    (put("valid", "sha256", value=0), "valid: sha256 is not a string"),
    *(
        (put("valid", "sha256", value=digest), "valid: sha256 is not 64 hexadecimal digits")
        for digest in ["", "0" * 63, "0" * 65, "0" * 64 + "\n", "A" * 64, "x" * 64, "\u0660" * 64]
    ),
    # Final polynomials.
    (put(*POLYNOMIALS, value={}), "valid: final_polynomials is not a list"),
    (put(*POLYNOMIALS, value=None), "valid: final_polynomials is not a list"),
    (put(*POLYNOMIAL, value=[]), "valid: a final polynomial is not an object"),
    (put(*POLYNOMIAL, "extra", value=0), "valid: unknown key 'extra'"),
    (drop(*POLYNOMIAL, "signs"), 'valid: "signs" is missing'),
    (drop(*POLYNOMIAL, "inequalities"), 'valid: "inequalities" is missing'),
    (put(*POLYNOMIAL, "signs", value=[]), "valid: signs is not an object"),
    *(
        (put(*POLYNOMIAL, "signs", key, value=1), f"valid: {SIGNS}")
        for key in ("", "123", "1243", "1123", "12345", "1239", "1 2 3 4", "\u0661234")
    ),
    (put(*POLYNOMIAL, "signs", "1234", value=2), f"valid: {SIGNS}"),
    (put(*POLYNOMIAL, "signs", "1234", value=True), "valid: a sign is not an integer"),
    (put(*POLYNOMIAL, "signs", "1234", value="1"), "valid: a sign is not an integer"),
    (put(*POLYNOMIAL, "inequalities", value={}), "valid: inequalities is not a list"),
    (put(*INEQUALITY, value={}), "valid: an inequality is not a list"),
    (put(*INEQUALITY, value=[1]), "valid: an inequality is not [multiplier, vertices]"),
    (put(*INEQUALITY, value=[1, [], 1]), "valid: an inequality is not [multiplier, vertices]"),
    (put(*INEQUALITY, 0, value=True), "valid: a multiplier is not an integer"),
    (put(*INEQUALITY, 0, value="1"), "valid: a multiplier is not an integer"),
    (put(*INEQUALITY, 1, value="123456"), "valid: the indices is not a list"),
    (put(*INEQUALITY, 1, value=[1, 2, 3, 4, 5]), f"valid: {SIX}"),
    (put(*INEQUALITY, 1, value=[1, 2, 3, 4, 5, 5]), f"valid: {SIX}"),
    (put(*INEQUALITY, 1, value=[1, 2, 3, 4, 5, 6, 7]), f"valid: {SIX}"),
    (put(*INEQUALITY, 1, value=[1, 2, 3, 4, 5, 6, 6]), f"valid: {SIX}"),
    (put(*INEQUALITY, 1, value=[0, 2, 3, 4, 5, 6]), f"valid: {SIX}"),
    (put(*INEQUALITY, 1, value=[1, 2, 3, 4, 5, 9]), f"valid: {SIX}"),
    (put(*INEQUALITY, 1, 0, value="1"), f"valid: {VERTEX}"),
    (put(*INEQUALITY, 1, 0, value=True), f"valid: {VERTEX}"),
]


@pytest.mark.parametrize(("spoil", "reason"), STATEMENTS)
def test_statement_is_refused(root: Path, spoil: Spoil, reason: str) -> None:
    content = document()
    spoil(content)
    path_of(root, "8_E").write_text(json.dumps(content))
    assert fault(root, "8_E") == reason


def test_the_longest_coordinate_that_ships_has_two_characters(
    certificates: dict[str, Certificate],
) -> None:
    """FORMAT.md says so, to show that the limits are far away."""
    answers = (a for c in certificates.values() for a in c.answers.values() if isinstance(a, Yes))
    assert max(len(str(x)) for a in answers for point in a.points for x in point) == 2


def test_what_is_well_formed_is_read() -> None:
    """Up to the limits of the format, and no answer is taken for another."""
    content = document()
    longest = ["1" * 40 + "/" + "3" * 39, -(10**38), 10**39]
    content["realizable"]["points"][1] = longest
    content["tetrahedra"] = list(QUADRUPLES)
    found = read_certificate("8_E", json.dumps(content).encode())
    places: list[list[int | Fraction]] = [[i, -i, Fraction(-i, 7)] for i in range(8)]
    places[1] = [Fraction(int("1" * 40), int("3" * 39)), -(10**38), 10**39]
    assert found == Certificate(
        pattern="8_E",
        boundary="d",
        instances=48,
        tetrahedra=QUADRUPLES,
        answers={
            "realizable": Yes(exact(places)),
            "convex": Open(),
            "valid": No(
                "proofs/8_E.valid.lrat",
                "0" * 64,
                (
                    FinalPolynomial(
                        {(1, 2, 3, 4): 1, (1, 2, 3, 5): -1, (5, 6, 7, 8): 0},
                        ((2, (1, 2, 3, 4, 5, 6)), (1, (8, 7, 6, 5, 4, 3))),
                    ),
                ),
            ),
        },
    )


# Its proofs.


PROOFS: dict[str, tuple[Arrange, str]] = {
    "missing": (Path.unlink, "15_A.realizable.lrat is missing, or is not a regular file"),
    "a folder": (instead(Path.mkdir), "15_A.realizable.lrat is missing, or is not a regular file"),
    "no folder": (
        lambda path: path.parent.rename(path.parents[1] / "elsewhere"),
        "15_A.realizable.lrat is missing, or is not a regular file",
    ),
    "a link": (linked, f"{PROOF} {A_LINK}"),
    "in a folder that is a link": (linked_folder, f"{PROOF} {A_LINK}"),
    "a broken link": (instead(link_to_nowhere), f"{PROOF} {A_LINK}"),
    "a circle of links": (
        instead(link_to_itself),
        "15_A.realizable.lrat is missing, or is not a regular file",
    ),
    "of another digest": (
        lambda path: path.write_bytes(path.read_bytes() + b"\n"),
        f"the SHA-256 of {PROOF} is not the one that the certificate states",
    ),
    "with other ends of lines": (
        lambda path: path.write_bytes(path.read_bytes().replace(b"\n", b"\r\n")),
        f"the SHA-256 of {PROOF} is not the one that the certificate states; "
        "its line ends were converted",
    ),
    "empty": (
        lambda path: path.write_bytes(b""),
        f"the SHA-256 of {PROOF} is not the one that the certificate states",
    ),
    "too large": (
        lambda path: path.open("ab").truncate(MAX_PROOF_BYTES + 1),
        f"15_A.realizable.lrat is larger than {MAX_PROOF_BYTES} bytes",
    ),
}


@pytest.mark.parametrize(("arrange", "reason"), PROOFS.values(), ids=PROOFS)
def test_proof_is_refused(root: Path, arrange: Arrange, reason: str) -> None:
    arrange(root / PROOF)
    assert fault(root, NO).split("; convex: ")[0] == f"realizable: {reason}"


def test_a_root_may_be_a_link(root: Path, tmp_path_factory: pytest.TempPathFactory) -> None:
    link = tmp_path_factory.mktemp("beside") / "link"
    link.symlink_to(root)
    assert check_pattern(link, NO).fault is None


def test_other_proof_than_ascii_is_refused(root: Path) -> None:
    content = (root / PROOF).read_bytes() + "\u0661".encode()
    (root / PROOF).write_bytes(content)
    record = json.loads(path_of(root, NO).read_bytes())
    record["realizable"]["sha256"] = sha256(content).hexdigest()
    path_of(root, NO).write_text(json.dumps(record))
    assert fault(root, NO) == f"realizable: {PROOF} is not ASCII text, nor is binary LRAT"


# Anything else.


def is_accepted(root: Path, original: Verdict) -> bool:
    """Is the file accepted? If so, what it says now is true.

    Points are looked at again by other means: those of the class of 5_A, whose instances are
    oriented as the unit cube is.
    """
    name = original.pattern
    verdict = check_pattern(root, name)
    if verdict.fault is not None:
        assert fault(root, name)
        if not verdict.instances:
            return False
    assert verdict.boundary == original.boundary
    assert verdict.instances == original.instances
    record = json.loads(path_of(root, name).read_bytes())
    signs = {t: signs_of(CUBE)[t] for t in map(tuple, record["tetrahedra"])}
    for question, answer in verdict.answers.items():
        assert answer in (original.answers[question], "open", "rejected")
        if answer == "yes":
            points = [[Fraction(x) for x in point] for point in record[question]["points"]]
            scale = lcm(*(x.denominator for point in points for x in point))
            placement = tuple(tuple(int(x * scale) for x in point) for point in points)
            assert realizes(placement, signs)
            assert question != "convex" or all(is_extreme(placement, v) for v in VERTICES)
    return verdict.fault is None


JSON: st.SearchStrategy[Json] = st.recursive(
    st.one_of(
        st.none(),
        st.booleans(),
        st.integers(-9, 9),
        st.integers(),
        st.floats(),
        st.text(max_size=5),
        st.sampled_from(["1/2", "-7/3", "yes", "no", "open", PROOF]),
    ),
    lambda values: st.one_of(
        st.lists(values, max_size=4),
        st.dictionaries(st.text(max_size=3) | st.sampled_from([*document()]), values, max_size=4),
    ),
    max_leaves=8,
)


@examples(200)
@given(st.binary(max_size=60) | JSON.map(lambda value: json.dumps(value).encode()))
def test_anything_is_rejected(folder: Path, content: bytes) -> None:
    path_of(folder).write_bytes(content)
    assert fault(folder)


def places(value: Json, way: tuple[str | int, ...] = ()) -> Iterator[tuple[str | int, ...]]:
    """Yield the ways to all that is inside a JSON value."""
    items: list[tuple[str | int, Json]] = []
    if isinstance(value, dict):
        items = list(value.items())
    if isinstance(value, list):
        items = list(enumerate(value))
    for key, inner in items:
        yield (*way, key)
        yield from places(inner, (*way, key))


@pytest.mark.parametrize("name", [YES, NO])
@examples(200)
@given(data=st.data())
def test_a_document_with_another_value_is_rejected_or_true(
    folder: Path, shipped: Path, verdicts: dict[str, Verdict], name: str, data: st.DataObject
) -> None:
    record: Document = json.loads(path_of(shipped, name).read_bytes())
    place = data.draw(st.sampled_from(list(places(record))))
    change = drop(*place) if data.draw(st.booleans()) else put(*place, value=data.draw(JSON))
    change(record)
    path_of(folder, name).write_text(json.dumps(record))
    is_accepted(folder, verdicts[name])


@pytest.mark.parametrize("name", [YES, NO])
def test_a_file_with_another_character_is_rejected_or_true(
    folder: Path, shipped: Path, verdicts: dict[str, Verdict], name: str
) -> None:
    """In turn, a character is dropped, doubled, or replaced by some digit."""
    text = path_of(shipped, name).read_text()
    accepted = []
    for k, old in enumerate(text):
        new = ("", 2 * old, str((7 * k + ord(old)) % 10))[k % 3]
        path_of(folder, name).write_text(text[:k] + new + text[k + 1 :])
        accepted.append(is_accepted(folder, verdicts[name]))
    assert {True, False} == set(accepted)
