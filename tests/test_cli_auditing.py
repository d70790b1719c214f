"""The commands audit, spheres and build."""

import sys
from collections.abc import Callable
from pathlib import Path
from shutil import copytree
from types import ModuleType, SimpleNamespace
from typing import Any

import pytest

from tests.commands import CHECKOUT, assert_usage_error, five_a, run, run_json, write

# audit


def test_audit_of_the_checkout() -> None:
    code, record = run_json(CHECKOUT, "audit")
    assert code == 0
    assert record["rejected"] == []
    assert sum(record["summary"].values()) == len(record["findings"])
    corrected = {f["id"] for f in record["findings"] if f["verdict"] == "corrected"}
    assert "discussion-smallest" in corrected


def test_audit_prints_every_finding() -> None:
    code, out, _ = run(CHECKOUT, "audit")
    _, record = run_json(CHECKOUT, "audit")
    assert code == 0
    assert all(len(line) <= 80 for line in out.splitlines())
    words = " ".join(out.split())
    for finding in record["findings"]:
        assert f": {finding['id']}\n    " in out
        for text in (finding["place"], finding["claim"], finding["amendment"]):
            assert text in words
    assert "12_U, 12_Y, 13_T, 13_W, 14_A" in words
    assert (
        "Reasons: 15_C, 15_D, 15_E valid = yes; 15_K convex = yes; 15_K valid = no; check" in words
    )
    counts = ", ".join(f"{count} {verdict}" for verdict, count in record["summary"].items())
    assert words.endswith(f"{len(record['findings'])} claims: {counts}")


def test_audit_of_some_claims() -> None:
    _, out, _ = run(CHECKOUT, "audit", "theorem-1", "figure-valid-15s")
    assert out.startswith("confirmed: theorem-1\n")
    assert "\ncorrected (mathematics): figure-valid-15s\n" in out
    assert out.count("Claim: ") == 2
    assert_usage_error(run(CHECKOUT, "audit", "theorem-9"), "unknown claim theorem-9")


def test_audit_of_some_verdicts() -> None:
    _, record = run_json(CHECKOUT, "audit", "--only", "corrected")
    weights = [finding["weight"] for finding in record["findings"]]
    assert len(weights) == record["summary"]["corrected"]
    assert weights == sorted(weights, key=["mathematics", "table", "misprint", "wording"].index)
    assert_usage_error(run(CHECKOUT, "audit", "--only", "wrong"), "unknown verdict wrong")


def test_audit_decides_nothing_on_rejected_certificates(root: Path) -> None:
    code, record = run_json(root, "audit")
    assert code == 1
    assert record["summary"]["not decided here"] > len(record["findings"]) / 2
    (smallest,) = (f for f in record["findings"] if f["id"] == "discussion-smallest")
    assert smallest["verdict"] == "not decided here"
    assert "theorem valid-sizes" in smallest["failed"]
    _, out, _ = run(root, "audit", "discussion-smallest")
    assert "    Failed: theorem valid-sizes; 11_AD, 11_AE valid = no; " in out


def test_audit_fails_where_an_answer_is_open(tmp_path: Path) -> None:
    copytree(CHECKOUT / "certificates", tmp_path / "certificates")
    copytree(CHECKOUT / "proofs", tmp_path / "proofs")
    write(tmp_path, five_a() | {"valid": {"answer": "open"}})
    code, record = run_json(tmp_path, "audit")
    assert (code, record["rejected"]) == (1, [])
    failed = [finding for finding in record["findings"] if finding["failed"]]
    assert {finding["verdict"] for finding in failed} == {"not decided here"}


# spheres


def fake_derivation(agrees: bool) -> ModuleType:
    def second_derivation(_: object, report: Callable[[str], None]) -> SimpleNamespace:
        report("looking")
        return SimpleNamespace(spheres=3, hexahedra={1, 2}, graphs=2, agrees=agrees)

    module = ModuleType("certify.opinions.derivation")
    module.__dict__["second_derivation"] = second_derivation
    return module


@pytest.mark.parametrize("agrees", [True, False])
def test_spheres_tells_what_it_found(monkeypatch: pytest.MonkeyPatch, agrees: bool) -> None:
    monkeypatch.setitem(sys.modules, "certify.opinions.derivation", fake_derivation(agrees))
    found = (
        f"{'ok' if agrees else 'not ok'}: 3 spheres with nine vertices, 2 classes of hexahedra,\n"
        "2 classes of decomposition graphs; these are "
        f"{'' if agrees else 'not '}the accepted patterns\n"
    )
    assert run(CHECKOUT, "spheres") == (0 if agrees else 1, found, "")
    _, record = run_json(CHECKOUT, "spheres")
    assert record == {"spheres": 3, "classes": 2, "graphs": 2, "agrees": agrees, "rejected": []}


def test_spheres_fails_where_something_is_rejected(
    root: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setitem(sys.modules, "certify.opinions.derivation", fake_derivation(True))
    code, out, err = run(root, "spheres")
    assert (code, err) == (1, "")
    assert out.startswith("rejected: certificates/6_A.json: 6_A.json is missing")
    assert out.endswith("these are the accepted patterns\n")


# build


def fake_build(calls: list[dict[str, Any]]) -> ModuleType:
    def build(root: Path, jobs: int, report: Callable[[str, int, int], None]) -> None:
        calls.append({"root": root, "jobs": jobs})
        report("half done", 1, 2)

    module = ModuleType("certify.search.build")
    module.__dict__["build"] = build
    return module


def test_build_calls_the_search(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    calls: list[dict[str, Any]] = []
    monkeypatch.setitem(sys.modules, "certify.search.build", fake_build(calls))
    code, out, err = run(tmp_path, "build", "-j", "3")
    assert (code, err) == (0, "")
    assert out == f"174 certificates written to {tmp_path}; certify check-all checks them\n"
    assert run(tmp_path / "new", "build")[0] == 0
    assert calls == [{"root": tmp_path, "jobs": 3}, {"root": tmp_path / "new", "jobs": 1}]


def test_build_without_the_extra(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.delitem(sys.modules, "certify.search.build", raising=False)
    monkeypatch.setitem(sys.modules, "numpy", None)
    message = "numpy is not installed: run pip install '.[search]' in a checkout, or pip install"
    assert_usage_error(run(tmp_path, "build"), message)


def test_build_needs_a_folder(tmp_path: Path) -> None:
    (tmp_path / "file").touch()
    assert_usage_error(run(tmp_path / "file", "build"), "file")
