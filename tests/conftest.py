"""The shipped certificates, read and checked once for all tests."""

from pathlib import Path

import pytest

from certify.kernel.certificate import PATTERN_NAMES, Certificate, read_certificate
from certify.kernel.check import Completeness, Verdict, check_completeness, check_pattern
from certify.kernel.hexahedron import BOUNDARY_TYPES


@pytest.fixture(scope="session")
def shipped() -> Path:
    """Return the folder that holds certificates/ and proofs/."""
    return Path(__file__).resolve().parents[1]


@pytest.fixture(scope="session")
def certificates(shipped: Path) -> dict[str, Certificate]:
    """Return every certificate as it is read, by pattern."""
    folder = shipped / "certificates"
    return {name: read_certificate(folder / f"{name}.json") for name in PATTERN_NAMES}


@pytest.fixture(scope="session")
def verdicts(shipped: Path) -> dict[str, Verdict]:
    """Return the kernel's verdict on every certificate, by pattern."""
    return {name: check_pattern(shipped, name) for name in PATTERN_NAMES}


@pytest.fixture(scope="session")
def completeness(shipped: Path, verdicts: dict[str, Verdict]) -> list[Completeness]:
    """Return the kernel's verdict on every proof that no pattern is missing."""
    return [check_completeness(shipped, letter, verdicts.values()) for letter in BOUNDARY_TYPES]
