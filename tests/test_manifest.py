"""The manifest: it is current, and whatever differs from it is named."""

import os
import re
import shutil
import subprocess
from collections.abc import Callable
from hashlib import sha256
from pathlib import Path
from shutil import copy, copytree
from xml.etree import ElementTree

import pytest

from certify import manifest
from certify.kernel.theorems import Outcome
from certify.manifest import KERNEL, NAME, compare
from tests.commands import CHECKOUT, run, run_json

needs_sha256sum = pytest.mark.skipif(
    shutil.which("sha256sum") is None, reason="sha256sum is not installed"
)


@needs_sha256sum
def test_it_is_what_the_command_in_the_documents_writes(tmp_path: Path) -> None:
    """If this fails, run that command, and commit what it writes."""
    (block,) = re.findall(
        rf"^```sh\n(.* > {NAME}.*)\n```$", (CHECKOUT / "CONTRIBUTING.md").read_text(), re.MULTILINE
    )
    for folder in (KERNEL, *manifest.EVIDENCE):
        copytree(CHECKOUT / folder, tmp_path / folder)
    subprocess.run(["bash", "-c", block], cwd=tmp_path, check=True)
    assert (tmp_path / NAME).read_text() == (CHECKOUT / NAME).read_text()


@needs_sha256sum
def test_sha256sum_reads_it() -> None:
    command = ["sha256sum", "--check", "--strict", "--quiet", NAME]
    assert subprocess.run(command, cwd=CHECKOUT, check=False).returncode == 0


def test_what_is_released_is_as_listed(outcome: Outcome) -> None:
    found = compare(CHECKOUT, outcome)
    assert found is not None
    assert (found.kernel, found.faults) == (True, ())
    assert found.files == len((CHECKOUT / NAME).read_text().splitlines())


# What differs. The run is that of the checkout, and the folder has the manifest only.


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Return a folder with a copy of the manifest, as if it came with the kernel that runs."""
    copy(CHECKOUT / NAME, tmp_path)
    monkeypatch.setattr(manifest, "default_root", lambda: tmp_path)
    return tmp_path


def faults(folder: Path, outcome: Outcome) -> tuple[str, ...]:
    found = compare(folder, outcome)
    assert found is not None
    assert found.kernel
    return found.faults


def test_converted_line_ends_are_named(folder: Path, outcome: Outcome) -> None:
    path = folder / "proofs" / "more.lrat"
    path.parent.mkdir()
    path.write_bytes(b"1 0 2 0\r\n")
    with (folder / NAME).open("a") as file:
        file.write(f"{sha256(b'1 0 2 0' + bytes([10])).hexdigest()}  proofs/more.lrat\n")
    (said,) = faults(folder, outcome)
    assert said == f"proofs/more.lrat is not the one in {NAME}; its line ends were converted"
    text = (folder / NAME).read_bytes()
    (folder / NAME).write_bytes(text.replace(b"\n", b"\r\n"))
    assert faults(folder, outcome) == (f"{NAME}: its line ends were converted",)


FILES = [f"{KERNEL}/check.py", "certificates/5_A.json", "proofs/15_A.valid.lrat"]


@pytest.mark.parametrize("name", FILES)
def test_a_file_that_is_another(folder: Path, outcome: Outcome, name: str) -> None:
    text = (folder / NAME).read_text()
    other = re.sub(rf"^.*  {name}$", f"{'0' * 64}  {name}", text, flags=re.MULTILINE)
    (folder / NAME).write_text(other)
    assert faults(folder, outcome) == (f"{name} is not the one in {NAME}",)
    found = compare(folder, outcome)
    assert found is not None
    assert found.files == len(text.splitlines()) - 1


@pytest.mark.parametrize("name", FILES)
def test_a_file_that_is_not_listed(folder: Path, outcome: Outcome, name: str) -> None:
    text = (folder / NAME).read_text()
    (folder / NAME).write_text(re.sub(rf"^.*  {name}\n", "", text, flags=re.MULTILINE))
    assert faults(folder, outcome) == (f"{name} is not in {NAME}",)


@pytest.mark.parametrize("name", FILES)
def test_a_file_that_is_missing(folder: Path, outcome: Outcome, name: str) -> None:
    absent = Path(name).with_stem("absent")
    with (folder / NAME).open("a") as file:
        file.write(f"{'0' * 64}  {absent}\n")
    assert faults(folder, outcome) == (f"{absent} is missing",)


@pytest.mark.parametrize("name", ["certificates/more.json", "proofs/\x1b[2J\n.lrat"])
def test_a_file_that_the_kernel_did_not_read(folder: Path, outcome: Outcome, name: str) -> None:
    (folder / name).parent.mkdir()
    (folder / name).write_text("more")
    assert faults(folder, outcome) == (f"{ascii(name)[1:-1]} is not in {NAME}",)
    (folder / name).rename(folder / "proofs.lrat")
    assert faults(folder, outcome) == ()


@pytest.mark.parametrize("place", [Path.mkdir, os.mkfifo, lambda path: path.symlink_to(path)])
def test_a_listed_file_that_the_kernel_did_not_read(
    folder: Path, outcome: Outcome, place: Callable[[Path], None]
) -> None:
    more = folder / "proofs" / "more.lrat"
    more.parent.mkdir()
    more.write_text("more")
    with (folder / NAME).open("a") as file:
        file.write(f"{sha256(b'more').hexdigest()}  proofs/more.lrat\n")
    assert faults(folder, outcome) == ()
    more.unlink()
    place(more)
    assert faults(folder, outcome) == (f"proofs/more.lrat is not the one in {NAME}",)


LISTED = f"{'0' * 64}  proofs/a.lrat\n"


@pytest.mark.parametrize(
    ("content", "line"),
    [
        ("", 1),
        ("\n", 1),
        (LISTED + "\n", 2),
        (LISTED + LISTED, 2),
        (LISTED.replace("0" * 64, "A" * 64), 1),
        (LISTED.replace("  ", " *"), 1),
        (LISTED.replace("proofs/", "proofs/../"), 1),
        (LISTED.replace("proofs/", "/proofs/"), 1),
        (LISTED.replace("proofs/a.lrat", "README.md"), 1),
        (LISTED.replace("a.lrat", "a.drat"), 1),
        ("\xff", 1),
    ],
)
def test_no_manifest_at_all(folder: Path, outcome: Outcome, content: str, line: int) -> None:
    (folder / NAME).write_bytes(content.encode("latin-1"))
    (fault,) = faults(folder, outcome)
    assert fault.startswith(f"{NAME}, line {line}: not the SHA-256 and the name of")


@pytest.mark.parametrize("place", [Path.mkdir, os.mkfifo, lambda path: path.symlink_to(path)])
def test_no_regular_manifest(folder: Path, outcome: Outcome, place: Callable[[Path], None]) -> None:
    (folder / NAME).unlink()
    assert compare(folder, outcome) is None
    place(folder / NAME)
    (fault,) = faults(folder, outcome)
    assert fault.startswith(f"{NAME} ")


def test_an_endless_manifest(folder: Path, outcome: Outcome) -> None:
    (folder / NAME).write_bytes(b"0" * (manifest.MAX_BYTES + 1))
    assert faults(folder, outcome) == (f"{NAME} is larger than {manifest.MAX_BYTES} bytes",)


# By the command.


def test_check_all_says_when_there_is_none(everything: Path) -> None:
    code, out, _ = run(everything, "check-all")
    *_, line, last = out.splitlines()
    assert (code, line) == (0, f"no manifest: there is no {NAME} beside certificates/")
    assert last.startswith("ok: 174 accepted")
    assert run_json(everything, "check-all")[1]["manifest"] is None


def test_check_all_of_another_root_compares_the_evidence(everything: Path) -> None:
    text = (CHECKOUT / NAME).read_text()
    (everything / NAME).write_text(re.sub(rf".*  {KERNEL}/names.py\n", "", text))
    code, out, _ = run(everything, "check-all")
    count = len(manifest.evidence(CHECKOUT))
    told = f"manifest: {count} files as listed; it does not speak of the kernel that runs"
    assert (code, out.splitlines()[-2]) == (0, told)
    record = run_json(everything, "check-all")[1]
    assert record["manifest"] == {"files": count, "kernel": False, "faults": []}


def test_check_all_fails_by_the_manifest_alone(everything: Path) -> None:
    """All theorems stand, but these are not the files that were released."""
    copy(CHECKOUT / NAME, everything)
    copy(everything / "proofs" / "15_A.valid.lrat", everything / "proofs" / "more.lrat")
    fault = f"proofs/more.lrat is not in {NAME}"
    report = everything / "report.xml"
    code, out, _ = run(everything, "check-all", "--junit", str(report))
    *_, line, last = out.splitlines()
    assert (code, line) == (1, f"not as listed: {fault}")
    assert last.startswith("not ok: 174 accepted, 0 rejected, 0 open, 16 of 16 theorems")
    (failure,) = ElementTree.parse(report).iter("failure")
    assert failure.get("message") == fault
    code, record = run_json(everything, "check-all")
    assert (code, record["ok"], record["manifest"]["faults"]) == (1, False, [fault])
    assert all(theorem["ok"] for theorem in record["theorems"])
