"""The commands audit, spheres and build."""

import json
import sys
from collections.abc import Callable
from pathlib import Path
from types import ModuleType, SimpleNamespace
from typing import Any

import pytest
from click.testing import CliRunner

from certify.cli import cli
from tests.commands import CHECKOUT, assert_usage_error, run, run_json

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
    for finding in record["findings"]:
        assert f"{finding['verdict']}: {finding['id']} ({finding['place']})" in out


def test_audit_decides_nothing_on_rejected_certificates(root: Path) -> None:
    code, record = run_json(root, "audit")
    assert code == 1
    assert record["summary"]["not decided here"] > len(record["findings"]) / 2
    (smallest,) = (f for f in record["findings"] if f["id"] == "discussion-smallest")
    assert smallest["verdict"] == "not decided here"


# spheres


def fake_decomposition(agrees: bool) -> ModuleType:
    def second_derivation(report: Callable[[str], None]) -> SimpleNamespace:
        report("looking")
        findings = {"degree": SimpleNamespace(sentence="Four.", counterexamples=("x", "y"))}
        return SimpleNamespace(
            spheres=3, hexahedra={1, 2}, graphs=2, agrees=agrees, findings=findings
        )

    module = ModuleType("certify.search.decomposition")
    module.__dict__["second_derivation"] = second_derivation
    return module


@pytest.mark.parametrize("agrees", [True, False])
def test_spheres_tells_what_it_found(monkeypatch: pytest.MonkeyPatch, agrees: bool) -> None:
    name = "certify.search.decomposition"
    monkeypatch.setitem(sys.modules, name, fake_decomposition(agrees))
    result = CliRunner().invoke(cli, ["spheres"])
    assert result.exit_code == (0 if agrees else 1)
    assert result.stderr == "looking\n"
    assert result.stdout.splitlines() == [
        "false, 2 counterexamples: Four.",
        f"{'ok' if agrees else 'not ok'}: 3 spheres with nine vertices, 2 classes of hexahedra, "
        "2 of decomposition graphs",
    ]
    record = json.loads(CliRunner().invoke(cli, ["spheres", "--json"]).stdout)
    assert (record["spheres"], record["agrees"]) == (3, agrees)


# build


def fake_build(calls: list[dict[str, Any]]) -> ModuleType:
    def build(root: Path, jobs: int, report: Callable[[str], None]) -> None:
        calls.append({"root": root, "jobs": jobs})
        report("half\x1b done")

    module = ModuleType("certify.search.build")
    module.__dict__["build"] = build
    return module


def test_build_calls_the_search(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    calls: list[dict[str, Any]] = []
    monkeypatch.setitem(sys.modules, "certify.search.build", fake_build(calls))
    outcome = run(tmp_path, "build", "--jobs", "3")
    assert outcome == (0, "", "half\\x1b done\n")
    assert run(tmp_path, "build")[0] == 0
    assert calls == [
        {"root": tmp_path, "jobs": 3},
        {"root": tmp_path, "jobs": 1},
    ]


def test_build_without_the_extra(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "certify.search.build", None)
    assert_usage_error(run(tmp_path, "build"), "install certify[search]")


def test_build_needs_a_folder(tmp_path: Path) -> None:
    assert_usage_error(run(tmp_path / "nowhere", "build"), "nowhere is not a folder")
