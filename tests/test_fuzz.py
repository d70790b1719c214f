"""What the kernel reads is fuzzed for a moment; and fuzzing finds what it should."""

import shutil
from importlib.util import find_spec
from pathlib import Path

import pytest

from tests.fuzz.__main__ import CHECKOUT, TARGETS, fuzz

pytestmark = [
    pytest.mark.slow,
    pytest.mark.skipif(not find_spec("atheris"), reason="atheris is not installed"),
]


@pytest.mark.parametrize("target", TARGETS)
def test_nothing_is_found(tmp_path: Path, target: str) -> None:
    found = fuzz(target, tmp_path, seconds=60, runs=1000)
    assert found["findings"] == []
    assert found["inputs"] > 100
    assert found["inputs kept"] > 3


BLIND = {
    "certificate": ("certificate", "_keys = lambda *_, **__: None"),
    "proof": ("refutation", "_require_implied = lambda *_: None"),
    "replay": ("refutation", "_require_implied = lambda *_: None"),
}
"""Target -> a module of the kernel, and the line after which it checks one thing less."""


@pytest.mark.parametrize("target", BLIND)
def test_a_blind_kernel_is_found_out(tmp_path: Path, target: str) -> None:
    for folder in ("certify", "certificates", "proofs", "tests"):
        shutil.copytree(CHECKOUT / folder, tmp_path / folder)
    module, line = BLIND[target]
    with (tmp_path / "certify" / "kernel" / f"{module}.py").open("a") as file:
        file.write(f"\n{line}\n")
    findings = tmp_path / "findings"
    found = fuzz(target, findings, seconds=300, runs=100_000, checkout=tmp_path)
    assert [(findings / name).is_file() for name in found["findings"]] == [True]
