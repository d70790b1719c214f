"""The shipped certificates, read and checked once for all tests."""

from pathlib import Path

import pytest

from certify.kernel.certificate import Certificate
from certify.kernel.check import Completeness, Verdict
from certify.kernel.theorems import Outcome, check_all


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
