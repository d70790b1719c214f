"""The page on trust says what is so: of the kernel, of the run, and of what is on record."""

import ast
import json
import re
import shutil
from hashlib import sha256
from pathlib import Path

import pytest

from certify.kernel.evidence import kernel_digest
from certify.kernel.theorems import Outcome
from certify.manifest import compare
from certify.opinions import trust
from certify.opinions.second import not_asked
from certify.opinions.trust import RECORDS, modules, on_record, page
from tests.commands import CHECKOUT, run, run_json

KERNEL = CHECKOUT / "certify" / "kernel"


def test_every_file_of_the_kernel_is_there() -> None:
    assert [m.file for m in modules()] == sorted(path.name for path in KERNEL.glob("*.py"))
    for module in modules():
        content = (KERNEL / module.file).read_bytes()
        assert module.sha256 == sha256(content).hexdigest()
        assert module.lines == content.count(b"\n")


def test_code_is_what_is_left_without_words() -> None:
    text = '"""Two\nlines."""\n\n# why\nx = 1  # so\n\n\ndef f():\n    """One."""\n    return x\n'
    assert trust._code(text) == {5, 8, 10}
    for module in modules():
        tree = ast.parse((KERNEL / module.file).read_text())
        statements = {n.lineno for n in ast.walk(tree) if isinstance(n, ast.stmt)}
        words = {
            n.lineno
            for n in ast.walk(tree)
            if isinstance(n, ast.Expr) and isinstance(n.value, ast.Constant)
        }
        assert len(statements - words) <= module.code <= module.lines


def test_checking_md_says_how_long_the_kernel_is() -> None:
    text = (CHECKOUT / "CHECKING.md").read_text()
    (stated,) = re.findall(r"about ([0-9,]+) lines of Python", text)
    assert abs(sum(m.code for m in modules()) - int(stated.replace(",", ""))) <= 25


def test_page_tells_of_this_run(outcome: Outcome) -> None:
    found = page(outcome, compare(CHECKOUT, outcome), list(not_asked()))
    assert found["trusted"]["kernel_sha256"] == kernel_digest()
    assert found["replayed"]["ok"]
    assert found["replayed"]["certificates"] == 174
    assert found["replayed"]["files"] == 174 + 57
    assert set(found["replayed"]["theorems"].values()) == {True}
    assert all(opinion["asked"] == 0 for opinion in found["second_opinions"])


def test_page_of_a_spoiled_root(shipped: Path, tmp_path: Path) -> None:
    for folder in ("certificates", "proofs"):
        shutil.copytree(shipped / folder, tmp_path / folder)
    (tmp_path / "certificates" / "5_A.json").write_text("{}")
    code, record = run_json(tmp_path, "trust")
    assert (code, record["replayed"]["ok"], record["replayed"]["certificates"]) == (1, False, 173)
    code, out, _ = run(tmp_path, "trust")
    assert code == 1
    assert "\nrejected: certificates/5_A.json: " in out
    assert "\nnot ok: 173 certificates accepted, 1 rejected" in out


def test_records_tell_which_kernel_they_are_of(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(trust, "__file__", str(tmp_path / "trust.py"))
    assert on_record("mutants", "0") is None
    (tmp_path / "measured").mkdir()
    record = {"kernel_sha256": "0", "figures": {"mutants": 7}}
    (tmp_path / "measured" / "mutants.json").write_text(json.dumps(record))
    for kernel, same in (("0", True), ("1", False)):
        assert on_record("mutants", kernel) == record | {"for_this_kernel": same}


def test_command(shipped: Path) -> None:
    code, out, err = run(shipped, "trust")
    assert (code, err) == (0, "")
    assert all(len(line) <= 80 for line in out.splitlines())
    assert kernel_digest() in out
    assert all(module.file in out for module in modules())
    assert "\nnot asked: balls: " in out
    assert all(f"\n{name}: " in out for name in RECORDS)
