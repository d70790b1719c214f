"""No file makes a command stumble: one line says what is wrong with it."""

import json
from collections.abc import Callable
from hashlib import sha256
from pathlib import Path

import pytest

from certify.kernel import check as checking
from certify.kernel.evidence import MAX_CERTIFICATE_BYTES
from tests.commands import (
    NO_FILES,
    assert_rejects,
    five_a,
    run,
    to_itself,
    to_nothing,
    to_outside,
    write,
)


def replaced(old: str, new: str) -> Callable[[], bytes]:
    def content() -> bytes:
        text = json.dumps(five_a())
        assert old in text
        return text.replace(old, new, 1).encode("utf-8", "surrogatepass")

    return content


def refuted(proof: str) -> Callable[[], bytes]:
    answer = {"answer": "no", "proof": proof, "sha256": "0" * 64}
    return lambda: json.dumps(five_a() | {"valid": answer}).encode()


@pytest.mark.parametrize(
    ("content", "fault"),
    [
        (lambda: b"", "not JSON"),
        (lambda: b"\0\1\2", "not JSON"),
        (lambda: b"\xff\xfe{}", "not UTF-8"),
        (lambda: json.dumps(five_a()).encode()[:99], "not JSON"),
        (lambda: json.dumps(five_a()).encode("utf-16"), "not UTF-8"),
        (lambda: b"[" * 60_000, "nested too deeply"),
        (lambda: b" " * MAX_CERTIFICATE_BYTES + b"{}", "larger than"),
        (lambda: b"[]", "not an object"),
        (lambda: b"{}", '"format" is missing'),
        (replaced('"certify-pattern/1"', '"certify-pattern/2"'), "format is not"),
        (replaced('"5_A"', '"5_B"'), "pattern is not one of the 174 names"),
        (replaced('"5_A"', '"6_A"'), "pattern is 6_A, but the file is named after 5_A"),
        (replaced('"5_A"', '["5_A"]'), "pattern is not a string"),
        (replaced('"a"', '"z"'), "boundary is not"),
        (replaced('"a"', '"b"'), "boundary: stated b, but it is a"),
        (replaced(": 2", ": true"), "instances is not an integer"),
        (replaced(": 2", f": {'9' * 5000}"), "more than 40 characters"),
        (replaced(": 2", ": 2.0"), "2.0 is not an integer"),
        (replaced(": 2", ": NaN"), "NaN is not an integer"),
        (replaced(": 2", ': 2, "instances": 2'), "an object has the same key twice"),
        (replaced(": 2", ': 2, "extra": 2'), "unknown key 'extra'"),
        (replaced("[1, 2, 3, 6]", "[1, 2, 6, 3]"), "tetrahedra are not"),
        (replaced("[1, 2, 3, 6]", "[1, 2, 3, 9]"), "tetrahedra are not"),
        (replaced("[1, 2, 3, 6], ", ""), "tetrahedra: "),
        (
            replaced("[1, 0, 0]", "[1, 0]"),
            "point 2: it has 2 coordinates instead of three",
        ),
        (replaced("[1, 0, 0]", "[1, 0, 0.5]"), "0.5 is not an integer"),
        (
            replaced("[1, 0, 0]", '[1, 0, "1/0"]'),
            "point 2: a coordinate is neither an integer nor",
        ),
        (replaced("[1, 0, 0]", "[0, 0, 0]"), "realizable: tetrahedron 1236 is degenerate"),
        (replaced('"yes"', '"maybe"'), "realizable: answer is not"),
        (refuted("../x.lrat"), "valid: proof is not proofs/5_A.valid.lrat"),
        (refuted("/etc/passwd"), "valid: proof is not proofs/5_A.valid.lrat"),
        (refuted("proofs/../5_A.valid.lrat"), "valid: proof is not proofs/5_A.valid.lrat"),
    ],
)
def test_spoiled_certificate(root: Path, content: Callable[[], bytes], fault: str) -> None:
    (root / "certificates" / "5_A.json").write_bytes(content())
    assert_rejects(run(root, "check", "5_A"), "certificates/5_A.json", fault)
    to = str(root / "exported")
    assert_rejects(run(root, "export", "5_A", "valid", "--to", to), "certificates/5_A.json", fault)
    code, out, _ = run(root, "show", "5_A")
    assert code == 1
    assert fault in out.splitlines()[0]
    assert run(root, "list")[0] == 1
    assert not Path(to).exists()


@pytest.mark.parametrize("place", NO_FILES)
def test_no_regular_certificate(root: Path, place: Callable[[Path], None]) -> None:
    path = root / "certificates" / "5_A.json"
    path.unlink()
    place(path)
    linked = place in (to_nothing, to_itself)
    fault = "is a symbolic link" if linked else "is missing, or is not a regular file"
    for command in ("check", "show"):
        assert_rejects(run(root, command, "5_A"), "5_A.json", fault)


@pytest.mark.parametrize("place", [*NO_FILES, to_outside])
def test_no_regular_proof(root: Path, place: Callable[[Path], None]) -> None:
    path = root / "proofs" / "15_A.realizable.lrat"
    path.unlink()
    place(path)
    assert_rejects(run(root, "check", "15_A"), "certificates/15_A.json", "")
    code, out, _ = run(root, "show", "15_A")
    assert code == 1
    shown = "not there, or not the proof that the certificate names"
    assert f"realizable: no is claimed, but rejected, by proofs/{path.name}: {shown}" in out


def test_unreadable_certificate(root: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def refuse(*_: object, **__: object) -> None:
        raise PermissionError(13, "Permission denied")

    monkeypatch.setattr(Path, "open", refuse)
    assert_rejects(run(root, "check", "5_A"), "5_A.json", "cannot be read: Permission denied")


@pytest.mark.parametrize(
    ("spoil", "fault"),
    [
        (lambda proof: proof.replace(b" 0", b"  0", 1), "line 1: not a step in the LRAT format"),
        (lambda proof: proof.splitlines(keepends=True)[0], "without the empty clause"),
        (lambda _: b"99999 0 99998 0\n", "line 1: there is no clause 99998"),
        (lambda _: "99999 0 \N{SUPERSCRIPT TWO} 0\n".encode(), "is not ASCII"),
    ],
)
def test_spoiled_proof(root: Path, spoil: Callable[[bytes], bytes], fault: str) -> None:
    path = root / "proofs" / "15_A.realizable.lrat"
    path.write_bytes(spoil(path.read_bytes()))
    assert_rejects(
        run(root, "check", "15_A"), path.name, "is not the one that the certificate states"
    )
    document = json.loads((root / "certificates" / "15_A.json").read_text())
    document["realizable"]["sha256"] = sha256(path.read_bytes()).hexdigest()
    write(root, document)
    assert_rejects(run(root, "check", "15_A"), "certificates/15_A.json: ", fault)


@pytest.mark.parametrize(
    "key", ["\x1b[31m[bold red]x", "\ud800", "a\nb", "\u202e:smile:", "\x9b2J"]
)
def test_hostile_text_is_escaped(root: Path, key: str) -> None:
    write(root, five_a() | {key: 1})
    for command in (["check", "5_A"], ["show", "5_A"], ["list"], ["check-all"]):
        _, out, err = run(root, *command)
        assert ascii(key)[1:-1] in out
        assert all(char.isprintable() for char in (out + err).replace("\n", ""))


def test_hostile_file_name_is_escaped(root: Path) -> None:
    (root / "certificates" / "\x1b[2J[red]\n.json").touch()
    code, out, _ = run(root, "check-all")
    assert code == 1
    assert r"rejected: certificates/\x1b[2J[red]\n.json: the file is not named after" in out


def test_a_kernel_that_breaks_off_rejects(root: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def break_off(*_: object) -> None:
        raise RuntimeError("out of order")

    monkeypatch.setattr(checking, "shelling", break_off)
    fault = "RuntimeError('out of order')"
    assert_rejects(run(root, "check", "5_A"), "certificates/5_A.json", fault)
