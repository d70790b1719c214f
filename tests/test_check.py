"""What the kernel's verdicts say when something is wrong, one certificate or proof at a time."""

from dataclasses import replace
from hashlib import sha256
from pathlib import Path

import pytest

from certify.kernel import check
from certify.kernel.certificate import Certificate, Open
from certify.kernel.check import (
    Completeness,
    Verdict,
    check_certificate,
    check_completeness,
    check_pattern,
    instances_bounded_by,
)
from certify.kernel.evidence import Evidence
from certify.kernel.hexahedron import BOUNDARY_TYPES
from certify.kernel.triangulation import boundary_diagonals

Verdicts = dict[str, Verdict]

LETTER = "a"
PROOF = "proofs/complete.a.lrat"


def test_an_open_answer_is_neither_yes_nor_no(
    shipped: Path, certificates: dict[str, Certificate]
) -> None:
    certificate = certificates["5_A"]
    certificate = replace(certificate, answers=certificate.answers | {"valid": Open()})
    verdict = check_certificate(certificate, Evidence(shipped))
    assert verdict.answers == {"realizable": "yes", "convex": "yes", "valid": "open"}
    assert verdict.rests_on("convex") == ("certificates/5_A.json",)
    for question in ("valid", "round"):
        with pytest.raises(ValueError, match=f"^no answer to '{question}' was accepted$"):
            verdict.rests_on(question)


def test_a_rejected_certificate_tells_what_was_read(root: Path) -> None:
    path = root / "certificates" / "5_A.json"
    path.write_text("{}")
    verdict = check_pattern(root, "5_A")
    assert verdict.fault == 'certificates/5_A.json: "format" is missing'
    assert verdict.files == {"certificates/5_A.json": sha256(b"{}").hexdigest()}
    assert (verdict.boundary, verdict.instances, verdict.answers) == ("", frozenset(), {})


def test_a_check_that_breaks_off_rejects(root: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(check, "shelling", break_off)
    fault = "certificates/5_A.json: RuntimeError('out of order')"
    assert check_pattern(root, "5_A").fault == fault


def break_off(*_: object) -> None:
    raise RuntimeError("out of order")


# Completeness.


def completeness(root: Path, verdicts: Verdicts) -> Completeness:
    return check_completeness(root, LETTER, verdicts.values())


@pytest.fixture
def proof(tmp_path: Path, shipped: Path) -> Path:
    """Return the proof for one letter, below a root of its own."""
    (tmp_path / "proofs").mkdir()
    (tmp_path / PROOF).write_bytes((shipped / PROOF).read_bytes())
    return tmp_path / PROOF


def test_all_with_this_boundary_are_listed(shipped: Path, verdicts: Verdicts) -> None:
    every = {instance for verdict in verdicts.values() for instance in verdict.instances}
    listed = {i for i in every if boundary_diagonals(i) == BOUNDARY_TYPES[LETTER]}
    digest = sha256((shipped / PROOF).read_bytes()).hexdigest()
    expected = Completeness(LETTER, frozenset(listed), None, {PROOF: digest})
    assert completeness(shipped, verdicts) == expected
    assert instances_bounded_by(LETTER, verdicts.values()) == sorted(listed)
    assert instances_bounded_by(LETTER, reversed(verdicts.values())) == sorted(listed)


def test_nothing_is_listed_without_the_proof(
    proof: Path, tmp_path: Path, verdicts: Verdicts
) -> None:
    text = proof.read_text()
    proof.write_text(text[: text.rindex("\n", 0, -1)])
    found = completeness(tmp_path, verdicts)
    assert found.fault == f"{PROOF}: the proof ends without the empty clause"
    assert found.listed == frozenset()
    assert found.files.keys() == {PROOF}
    proof.unlink()
    found = completeness(tmp_path, verdicts)
    fault = f"{PROOF}: complete.a.lrat is missing, or is not a regular file"
    assert found == Completeness(LETTER, frozenset(), fault)


def test_nothing_is_listed_if_one_is_missing(shipped: Path, verdicts: Verdicts) -> None:
    (some, *_) = (name for name, verdict in verdicts.items() if verdict.boundary == LETTER)
    found = completeness(shipped, {k: v for k, v in verdicts.items() if k != some})
    assert found.listed == frozenset()
    assert found.fault is not None
    assert found.fault.startswith(f"{PROOF}: line ")


def test_nothing_is_listed_if_the_replay_breaks_off(
    shipped: Path, verdicts: Verdicts, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(check, "replay", break_off)
    found = completeness(shipped, verdicts)
    assert (found.listed, found.fault) == (frozenset(), f"{PROOF}: RuntimeError('out of order')")
