"""Every version of Python that is declared, as far as it is installed on this machine."""

import os
import shutil
import subprocess
import tomllib
from pathlib import Path

import pytest

from tests.commands import CHECKOUT

PROJECT = tomllib.loads((CHECKOUT / "pyproject.toml").read_text())
CLASSIFIER = "Programming Language :: Python :: 3."
DECLARED = [
    f"3.{words.removeprefix(CLASSIFIER)}"
    for words in PROJECT["project"]["classifiers"]
    if words.startswith(CLASSIFIER)
]


def interpreter(version: str) -> str | None:
    """Return a Python of this version that runs: one on the PATH, or one that pyenv keeps."""
    name = f"python{version}"
    found = [shutil.which(name)]
    if shutil.which("pyenv"):
        command = ["pyenv", "whence", "--path", name]
        kept = subprocess.run(command, capture_output=True, text=True, check=False)
        found += kept.stdout.splitlines()
    ask = ["-c", "import sys; print('%d.%d' % sys.version_info[:2])"]
    for path in filter(None, found):
        told = subprocess.run([path, *ask], capture_output=True, text=True, check=False)
        if told.stdout.strip() == version:
            return path
    return None


def test_the_lowest_version_is_that_of_the_linter_and_of_the_metadata() -> None:
    """So no syntax is used that is newer: ruff reports it."""
    lowest = DECLARED[0]
    assert PROJECT["project"]["requires-python"] == f">={lowest}"
    assert PROJECT["tool"]["ruff"]["target-version"] == f"py{lowest.replace('.', '')}"


@pytest.mark.slow
@pytest.mark.parametrize("version", DECLARED)
def test_all_is_accepted_without_a_warning(version: str, tmp_path: Path) -> None:
    """By the kernel's door in the checkout, and by the installed program elsewhere."""
    python = interpreter(version)
    if python is None:
        pytest.skip(f"there is no Python {version} on this machine")
    subprocess.run([python, "-m", "venv", tmp_path / "venv"], check=True)
    new = tmp_path / "venv" / "bin" / "python"
    subprocess.run([new, "-m", "pip", "install", "--quiet", CHECKOUT], check=True)
    alone = {name: value for name, value in os.environ.items() if name != "PYTHONPATH"}
    for folder, module, *words in (
        (CHECKOUT, "certify.kernel", "."),
        (tmp_path, "certify.kernel"),
        (tmp_path, "certify", "check-all", "--jobs", "2"),
        (tmp_path, "certify", "audit"),
    ):
        command = [str(new), "-W", "error", "-m", module, *words]
        result = subprocess.run(
            command, cwd=folder, env=alone, capture_output=True, text=True, check=False
        )
        assert (result.returncode, result.stderr) == (0, ""), command
