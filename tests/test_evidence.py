"""Digests, strays and the default root. What is read is in test_certificate_reading.py."""

from hashlib import sha256
from pathlib import Path

import pytest

from certify.kernel import evidence
from certify.kernel.evidence import default_root, digest, kernel_digest, kernel_files, strays

KERNEL = Path(evidence.__file__).parent


def test_limits() -> None:
    """They are those of FORMAT.md."""
    assert evidence.MAX_CERTIFICATE_BYTES == 65_536
    assert evidence.MAX_PROOF_BYTES == 1_048_576


def test_strays(root: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """They are named in one order, in whichever order the folder has them."""
    folder = root / "certificates"
    for name in ("5_A.json.bak", "5_a.json", "x\n.json", "0_A.json"):
        (folder / name).touch()
    fault = "the file is not named after a pattern"
    names = [f"certificates/{name}" for name in ("0_A.json", "5_a.json", "x\\n.json")]
    for files in (sorted(folder.iterdir()), sorted(folder.iterdir(), reverse=True)):
        monkeypatch.setattr(Path, "iterdir", lambda _, files=files: iter(files))
        found = strays(root, ["5_A", "15_A", "5_B"])
        assert [*found.items()] == [(name, fault) for name in names]
    monkeypatch.undo()
    unlisted = "the folder cannot be listed: No such file or directory"
    assert strays(tmp_path / "nowhere", []) == {"certificates": unlisted}


def test_a_digest_is_that_of_a_list_in_the_order_of_the_names() -> None:
    files = {name: sha256(name.encode()).hexdigest() for name in "bca"}
    lines = "".join(f"{files[name]}  {name}\n" for name in "abc")
    assert digest(files) == sha256(lines.encode()).hexdigest()
    assert digest({}) == sha256(b"").hexdigest()


def test_the_digest_of_the_kernel_is_of_all_its_modules() -> None:
    names = sorted(path.name for path in KERNEL.iterdir() if path.suffix == ".py")
    expected = {name: sha256((KERNEL / name).read_bytes()).hexdigest() for name in names}
    assert kernel_files() == expected
    assert kernel_digest() == digest(expected)


def test_the_default_root_comes_with_the_code(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    package = tmp_path / "certify"
    monkeypatch.setattr(evidence, "__file__", str(package / "kernel" / "evidence.py"))
    assert default_root() == tmp_path
    (package / "data").mkdir(parents=True)
    assert default_root() == package / "data"
