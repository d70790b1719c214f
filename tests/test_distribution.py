"""What is built of a commit: the same bytes twice, with all that it needs and nothing else."""

import shutil
import subprocess
import tarfile
import zipfile
from collections.abc import Iterable, Mapping
from hashlib import sha256
from pathlib import Path

import pytest

from certify.manifest import KERNEL, NAME
from tests.commands import CHECKOUT

pytestmark = [
    pytest.mark.slow,
    pytest.mark.skipif(shutil.which("git") is None, reason="git is not installed"),
    pytest.mark.skipif(not (CHECKOUT / ".git").exists(), reason="this is no checkout"),
]

Content = Mapping[str, bytes]

NOT_IN_THE_SDIST = (".gitattributes", ".github/", ".pre-commit", "action.yml")
"""What only the host of the repository needs; paths begin so."""


@pytest.fixture(scope="module")
def built(tmp_path_factory: pytest.TempPathFactory) -> tuple[str, Path]:
    """Return what .ci/release prints, and the folder with what it built twice and compared."""
    folder = tmp_path_factory.mktemp("built") / "dist"
    result = subprocess.run(
        [CHECKOUT / ".ci" / "release", "HEAD", folder], capture_output=True, text=True, check=False
    )
    assert result.returncode == 0, result.stdout + result.stderr
    return result.stdout, folder


@pytest.fixture(scope="module")
def wheel(built: tuple[str, Path]) -> Content:
    (path,) = built[1].glob("*.whl")
    with zipfile.ZipFile(path) as archive:
        return {name: archive.read(name) for name in archive.namelist()}


@pytest.fixture(scope="module")
def sdist(built: tuple[str, Path]) -> Content:
    """Return the files of the source archive, by their paths below its only folder."""
    (path,) = built[1].glob("*.tar.gz")
    content = {}
    with tarfile.open(path) as archive:
        for member in archive:
            if file := archive.extractfile(member):
                content[member.name.removeprefix(f"{path.name[:-7]}/")] = file.read()
    return content


def committed(*folders: str) -> list[str]:
    command = ["git", "ls-tree", "-r", "--name-only", "HEAD", *folders]
    listed = subprocess.run(command, cwd=CHECKOUT, capture_output=True, text=True, check=True)
    return listed.stdout.splitlines()


def in_the_wheel(names: Iterable[str]) -> list[str]:
    """Return where the wheel has these files of the checkout."""
    return [name if name.startswith("certify/") else f"certify/data/{name}" for name in names]


def test_two_builds_are_equal_and_the_wheel_checks_itself(built: tuple[str, Path]) -> None:
    lines = built[0].splitlines()
    assert (
        lines[0] == f"manifest: {len((CHECKOUT / NAME).read_text().splitlines())} files as listed"
    )
    assert lines[1].startswith("ok: 174 accepted, 0 rejected, 0 open, 16 of 16 theorems")
    assert lines[-1].endswith("are equal, byte by byte")
    names = {path.name for path in built[1].iterdir()}
    sums = (built[1] / "SHA256SUMS").read_text().split()
    assert {*sums[1::2], "SHA256SUMS"} == names
    assert len(names) == 3


def test_the_wheel_has_the_code_and_the_evidence_only(wheel: Content) -> None:
    expected = in_the_wheel(committed("certify/", "certificates/", "formal/", "proofs/", NAME))
    assert f"{KERNEL}/check.py" in expected
    assert "certify/py.typed" in expected
    about = {name for name in wheel if ".dist-info/" in name}
    assert sorted(wheel.keys() - about) == sorted(expected)
    kinds = {name.partition(".dist-info/")[2] for name in about}
    assert kinds == {"METADATA", "WHEEL", "RECORD", "entry_points.txt", "licenses/LICENSE"}


def test_the_sdist_has_all_but_what_the_host_needs(sdist: Content) -> None:
    expected = [name for name in committed() if not name.startswith(NOT_IN_THE_SDIST)]
    assert "tests/conftest.py" in expected
    assert sorted(sdist) == sorted([*expected, "PKG-INFO"])


def test_both_are_as_listed(wheel: Content, sdist: Content) -> None:
    for content, names in ((sdist, list), (wheel, in_the_wheel)):
        (place,) = names([NAME])
        listed = [line.split("  ") for line in content[place].decode().splitlines()]
        assert len(listed) > 200
        found = [sha256(content[name]).hexdigest() for name in names(name for _, name in listed)]
        assert found == [digest for digest, _ in listed]
