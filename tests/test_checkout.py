"""A checkout by a Git that converts the ends of lines, as that for Windows does by default."""

import shutil
import subprocess
from pathlib import Path

import pytest

from certify.kernel.check import check_pattern
from certify.kernel.evidence import certificate_file, proof_file

ATTRIBUTES = Path(__file__).parents[1] / ".gitattributes"
FILES = [certificate_file("15_K"), proof_file("15_K", "valid")]

pytestmark = [
    pytest.mark.skipif(shutil.which("git") is None, reason="git is not installed"),
    pytest.mark.skipif(not ATTRIBUTES.exists(), reason="this is no checkout"),
]


def git(folder: Path, *arguments: str) -> None:
    identity = ("-c", "user.name=a", "-c", "user.email=a@example.org")
    subprocess.run(["git", *identity, *arguments], cwd=folder, check=True, capture_output=True)


def converted(shipped: Path, folder: Path, attributes: bool) -> Path:
    """Return a clone, with core.autocrlf, of a repository with some of the evidence."""
    origin, clone = folder / "origin", folder / "clone"
    for file in FILES:
        (origin / file).parent.mkdir(parents=True)
        shutil.copy(shipped / file, origin / file)
    if attributes:
        shutil.copy(ATTRIBUTES, origin)
    git(origin, "init", "-q")
    git(origin, "add", "-A")
    git(origin, "commit", "-qm", "evidence")
    git(folder, "clone", "-q", "-c", "core.autocrlf=true", str(origin), str(clone))
    return clone


def test_attributes_keep_the_ends_of_lines(shipped: Path, tmp_path: Path) -> None:
    clone = converted(shipped, tmp_path, attributes=True)
    assert all((clone / file).read_bytes() == (shipped / file).read_bytes() for file in FILES)
    assert check_pattern(clone, "15_K").fault is None


def test_converted_ends_of_lines_are_named(shipped: Path, tmp_path: Path) -> None:
    clone = converted(shipped, tmp_path, attributes=False)
    fault = check_pattern(clone, "15_K").fault
    assert fault is not None
    assert fault.endswith("the certificate states; its line ends were converted")
