"""The shipped certificates, read and checked once for all tests."""

from pathlib import Path
from shutil import copy, copytree

import pytest

from certify.kernel import certificate
from certify.kernel.certificate import PATTERN_NAMES, Certificate
from certify.kernel.check import Completeness, Verdict
from certify.kernel.theorems import Outcome, check_all
from tests.commands import CHECKOUT, five_a, write


@pytest.fixture(scope="session")
def shipped() -> Path:
    """Return the folder that holds certificates/ and proofs/."""
    return Path(__file__).resolve().parents[1]


@pytest.fixture(scope="session")
def outcome(shipped: Path) -> Outcome:
    """Return what the kernel finds when it checks everything."""
    return check_all(shipped)


@pytest.fixture(scope="session")
def verdicts(outcome: Outcome) -> dict[str, Verdict]:
    """Return the kernel's verdict on every certificate, by pattern."""
    return {verdict.pattern: verdict for verdict in outcome.verdicts}


@pytest.fixture(scope="session")
def certificates(verdicts: dict[str, Verdict]) -> dict[str, Certificate]:
    """Return every certificate as it is read, by pattern."""
    return {name: v.certificate for name, v in verdicts.items() if v.certificate}


@pytest.fixture(scope="session")
def completeness(outcome: Outcome) -> list[Completeness]:
    """Return the kernel's verdict on every proof that no pattern is missing."""
    return list(outcome.completeness)


@pytest.fixture
def root(tmp_path: Path) -> Path:
    """Return a root with two certificates: 5_A, by hand, and the non-realizable 15_A."""
    for folder in ("certificates", "proofs"):
        (tmp_path / folder).mkdir()
    write(tmp_path, five_a())
    copy(CHECKOUT / "certificates" / "15_A.json", tmp_path / "certificates")
    for proof in (CHECKOUT / "proofs").glob("15_A.*"):
        copy(proof, tmp_path / "proofs")
    return tmp_path


@pytest.fixture
def everything(tmp_path: Path) -> Path:
    """Return a root with all certificates and proofs."""
    for folder in ("certificates", "proofs"):
        copytree(CHECKOUT / folder, tmp_path / folder)
    return tmp_path


@pytest.fixture
def ten(monkeypatch: pytest.MonkeyPatch) -> None:
    """Let there be ten patterns, to save time."""
    monkeypatch.setattr(certificate, "PATTERN_NAMES", PATTERN_NAMES[:10])
