"""The kernel's own door, opened in this process; test_architecture.py opens it in another."""

import json
import runpy
import sys
from dataclasses import replace
from io import StringIO
from pathlib import Path
from typing import Any

import pytest

from certify.kernel import __main__ as door
from certify.kernel.check import Verdict
from certify.kernel.theorems import Outcome

pytestmark = pytest.mark.filterwarnings("ignore:.*found in sys.modules:RuntimeWarning")


def answer(
    outcome: Outcome,
    root: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> tuple[int, list[str], dict[str, Any]]:
    """Return exit code, lines and record of the door if this is what checking finds."""

    def check_all(asked: Path) -> Outcome:
        assert asked == root
        return outcome

    monkeypatch.setattr(door, "check_all", check_all)
    code = door.main([str(root)])
    *lines, last = capsys.readouterr().out.splitlines()
    return code, lines, json.loads(last)


def test_all_is_accepted(
    shipped: Path,
    outcome: Outcome,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    code, lines, record = answer(outcome, shipped, monkeypatch, capsys)
    assert code == 0
    assert lines == [f"ok: {theorem.id}: {theorem.statement}" for theorem in outcome.theorems]
    assert record == {
        "ok": True,
        "accepted": 174,
        "rejected": 0,
        "open": 0,
        "theorems": 16,
        **outcome.about,
    }


def test_not_all_is_accepted(
    shipped: Path,
    outcome: Outcome,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    """One certificate is rejected, another has an open answer, and the first theorem is not so."""
    one, other, *verdicts = outcome.verdicts
    answers = {**other.answers, "valid": "open"}
    verdicts += [Verdict(one.pattern, fault="spoiled"), replace(other, answers=answers)]
    first, *theorems = outcome.theorems
    spoiled = Outcome(tuple(verdicts), outcome.completeness, (replace(first, ok=False), *theorems))
    code, lines, record = answer(spoiled, shipped, monkeypatch, capsys)
    assert code == 1
    assert lines[0] == "rejected: spoiled"
    assert lines[1] == f"not shown: {first.id}: {first.statement}"
    assert [line.partition(":")[0] for line in lines[2:]] == ["ok"] * 15
    assert record["ok"] is False
    assert [record[key] for key in ("accepted", "rejected", "open", "theorems")] == [173, 1, 1, 15]


def test_without_a_root_it_checks_the_one_that_comes_with_the_code(
    shipped: Path, outcome: Outcome, monkeypatch: pytest.MonkeyPatch
) -> None:
    roots = []

    def check_all(root: Path) -> Outcome:
        roots.append(root)
        return outcome

    monkeypatch.setattr(door, "check_all", check_all)
    assert door.main([]) == 0
    assert roots == [shipped]


@pytest.mark.parametrize(
    ("arguments", "code"),
    [(["-h"], 0), (["--help"], 0), (["nowhere"], 2), ([".", "."], 2), (["-h", "-h"], 2), ([""], 2)],
)
def test_usage(
    arguments: list[str],
    code: int,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    for name in ("-h", "--help"):  # a folder of this name is not meant
        (tmp_path / name / "certificates").mkdir(parents=True)
    monkeypatch.chdir(tmp_path)
    assert door.main(arguments) == code
    usage = "usage: python -m certify.kernel [ROOT], with a folder ROOT/certificates\n"
    assert capsys.readouterr().out == usage


def test_two_roots_are_a_usage_error(shipped: Path) -> None:
    assert door.main([str(shipped), str(shipped)]) == 2


@pytest.mark.parametrize(("arguments", "code"), [(["--help"], 0), (["nowhere"], 2)])
def test_the_program_ends_with_the_code(
    arguments: list[str], code: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(sys, "argv", ["certify.kernel", *arguments])
    with pytest.raises(SystemExit) as ended:
        runpy.run_module("certify.kernel", run_name="__main__")
    assert ended.value.code == code


def test_the_program_can_be_interrupted(shipped: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def interrupted(_: Path) -> None:
        raise KeyboardInterrupt

    monkeypatch.setattr("certify.kernel.theorems.check_all", interrupted)
    monkeypatch.setattr(sys, "argv", ["certify.kernel", str(shipped)])
    with pytest.raises(SystemExit) as ended:
        runpy.run_module("certify.kernel", run_name="__main__")
    assert ended.value.code == 130


def ending(monkeypatch: pytest.MonkeyPatch, *arguments: str) -> object:
    """Return what the program exits with: a code, or a line for standard error."""
    monkeypatch.setattr(sys, "argv", ["certify.kernel", *arguments])
    with pytest.raises(SystemExit) as ended:
        runpy.run_module("certify.kernel", run_name="__main__")
    return ended.value.code


def test_closed_output(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(sys, "stdout", None)
    assert ending(monkeypatch, "--help") == "standard output is closed"


class Full(StringIO):
    """What cannot be written in the end, nor closed."""

    closings = 0

    def flush(self) -> None:
        raise OSError(28, "No space left on device")

    def close(self) -> None:
        self.closings += 1
        raise OSError(28, "No space left on device")


def test_output_that_cannot_be_written(monkeypatch: pytest.MonkeyPatch) -> None:
    full = Full()
    monkeypatch.setattr(sys, "stdout", full)
    assert ending(monkeypatch, "--help") == "[Errno 28] No space left on device"
    assert full.closings == 1


def test_a_kernel_that_cannot_be_imported(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "certify.kernel.theorems", None)
    said = ending(monkeypatch, "--help")
    assert isinstance(said, str)
    assert said.startswith("the kernel cannot be imported: ")


def test_nothing_is_checked_when_it_is_imported(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(sys, "argv", ["certify.kernel", "nowhere"])
    assert callable(runpy.run_module("certify.kernel.__main__")["main"])
