"""The command line: what it prints, how it exits, and that no file makes it stumble."""

import json
import os
import pty
import subprocess
import sys
from collections.abc import Callable, Sequence
from concurrent.futures.process import BrokenProcessPool
from hashlib import sha256
from pathlib import Path
from shutil import copy, copytree
from types import ModuleType, SimpleNamespace
from typing import Any
from xml.etree import ElementTree

import pytest
from click.testing import CliRunner

from certify import __version__
from certify import run as running
from certify.cli import cli
from certify.kernel import check as checking
from certify.kernel import evidence, theorems
from certify.kernel.certificate import PATTERN_NAMES, QUESTIONS
from certify.kernel.evidence import MAX_CERTIFICATE_BYTES
from certify.kernel.hexahedron import CORNERS
from certify.kernel.refutation import replay
from certify.kernel.theorems import Theorem

CHECKOUT = Path(__file__).resolve().parents[1]
COMMANDS = ("check", "check-all", "list", "show", "export", "audit", "build", "spheres")

Outcome = tuple[int, str, str]


@pytest.fixture
def root(tmp_path: Path) -> Path:
    """Return a root with two certificates: 5_A, by hand, and the non-realizable 15_A."""
    for folder in ("certificates", "proofs"):
        (tmp_path / folder).mkdir()
    write(tmp_path, five_a())
    copy(CHECKOUT / "certificates" / "15_A.json", tmp_path / "certificates")
    for proof in (CHECKOUT / "proofs").glob("15_A.*"):
        copy(proof, tmp_path / "proofs")
    return tmp_path


def five_a() -> dict[str, Any]:
    return {
        "format": "certify-pattern/1",
        "pattern": "5_A",
        "boundary": "a",
        "instances": 2,
        "tetrahedra": [[1, 2, 3, 6], [1, 3, 4, 8], [1, 3, 6, 8], [1, 5, 6, 8], [3, 6, 7, 8]],
        **{question: {"answer": "yes", "points": list(CORNERS.values())} for question in QUESTIONS},
    }


def write(root: Path, document: dict[str, Any]) -> None:
    path = root / "certificates" / f"{document['pattern']}.json"
    path.write_text(json.dumps(document))


def run(root: Path, *args: str) -> Outcome:
    """Return exit code, standard output and standard error of a command on this root."""
    result = CliRunner().invoke(cli, [*args, "--root", str(root)])
    assert result.exception is None or isinstance(result.exception, SystemExit), result.exception
    assert "Traceback" not in result.output
    return result.exit_code, result.stdout, result.stderr


def run_json(root: Path, *args: str) -> tuple[int, dict[str, Any]]:
    code, out, err = run(root, *args, "--json")
    assert err == ""
    record = json.loads(out)
    assert isinstance(record, dict)
    return code, record


def spawn(*args: str, **settings: Any) -> "subprocess.CompletedProcess[str]":
    """Run the command line in a process of its own."""
    command = [sys.executable, "-m", "certify", *args]
    return subprocess.run(command, cwd=CHECKOUT, text=True, check=False, **settings)


def assert_rejects(outcome: Outcome, file: str, fault: str) -> None:
    """One line names the file and the fault, and the exit code is 1."""
    code, out, err = outcome
    (line,) = (out + err).splitlines()
    assert code == 1
    assert file in line
    assert fault in line


def assert_usage_error(outcome: Outcome, message: str) -> None:
    code, out, err = outcome
    assert (code, out) == (2, "")
    assert len(err.splitlines()) == 1
    assert message in err


# check


def test_check_prints_a_line_a_pattern(root: Path) -> None:
    code, out, err = run(root, "check", "5_A", "15_A")
    first, second = out.splitlines()
    assert (code, err) == (0, "")
    assert first == "5_A: realizable yes, convex yes, valid yes"
    assert second.startswith("15_A: realizable no, convex no, valid ")


def test_check_json(root: Path) -> None:
    code, record = run_json(root, "check", "5_A")
    yes = dict.fromkeys(QUESTIONS, "yes")
    assert code == 0
    rests_on = {question: ["certificates/5_A.json"] for question in QUESTIONS}
    assert record == {
        "ok": True,
        "patterns": [{"pattern": "5_A", "ok": True, **yes, "fault": None, "rests_on": rests_on}],
    }


def test_a_no_rests_on_its_certificate_and_its_proof(root: Path) -> None:
    _, record = run_json(root, "check", "15_A")
    assert record["patterns"][0]["rests_on"]["realizable"] == [
        "certificates/15_A.json",
        "proofs/15_A.realizable.lrat",
    ]


def test_check_rejects_one_and_accepts_the_other(root: Path) -> None:
    write(root, five_a() | {"instances": 3})
    code, out, _ = run(root, "check", "5_A", "15_A")
    assert code == 1
    assert out.startswith(
        "rejected: certificates/5_A.json: instances: stated 3, but it is 2\n15_A:"
    )
    code, record = run_json(root, "check", "5_A", "15_A")
    assert code == 1
    assert [entry["ok"] for entry in record["patterns"]] == [False, True]
    assert not record["ok"]


@pytest.mark.parametrize("name", ["5_B", "16_A", "", "../5_A", "5_a", "5_A.json", "\x1b[2J"])
@pytest.mark.parametrize("command", ["check", "show", "export"])
def test_unknown_pattern(root: Path, command: str, name: str) -> None:
    more = ["valid", "--to", str(root)] if command == "export" else []
    outcome = run(root, command, name, *more)
    assert_usage_error(outcome, "unknown pattern")
    assert "\x1b" not in outcome[2]


@pytest.mark.parametrize("args", [["check", "5_A"], ["check-all"], ["list"], ["show", "5_A"]])
def test_missing_root(tmp_path: Path, args: Sequence[str]) -> None:
    assert_usage_error(run(tmp_path / "nowhere", *args), "nowhere is not a folder")
    assert_usage_error(run(tmp_path, *args), "has no folder certificates")


# Files that are no certificates


def replaced(old: str, new: str) -> Callable[[], bytes]:
    def content() -> bytes:
        text = json.dumps(five_a())
        assert old in text
        return text.replace(old, new, 1).encode("utf-8", "surrogatepass")

    return content


def refuted(proof: str) -> Callable[[], bytes]:
    answer = {"answer": "no", "proof": proof, "sha256": "0" * 64}
    return lambda: json.dumps(five_a() | {"valid": answer}).encode()


@pytest.mark.parametrize(
    ("content", "fault"),
    [
        (lambda: b"", "not JSON"),
        (lambda: b"\0\1\2", "not JSON"),
        (lambda: b"\xff\xfe{}", "not UTF-8"),
        (lambda: json.dumps(five_a()).encode()[:99], "not JSON"),
        (lambda: json.dumps(five_a()).encode("utf-16"), "not UTF-8"),
        (lambda: b"[" * 200_000, "nested too deeply"),
        (lambda: b" " * MAX_CERTIFICATE_BYTES + b"{}", "larger than"),
        (lambda: b"[]", "not an object"),
        (lambda: b"{}", '"format" is missing'),
        (replaced('"certify-pattern/1"', '"certify-pattern/2"'), "format is not"),
        (replaced('"5_A"', '"5_B"'), "pattern is not one of the 174 names"),
        (replaced('"5_A"', '"6_A"'), "pattern is 6_A, but the file is named after 5_A"),
        (replaced('"5_A"', '["5_A"]'), "pattern is not a string"),
        (replaced('"a"', '"z"'), "boundary is not"),
        (replaced('"a"', '"b"'), "boundary: stated b, but it is a"),
        (replaced(": 2", ": true"), "instances is not an integer"),
        (replaced(": 2", f": {'9' * 5000}"), "more than 40 characters"),
        (replaced(": 2", ": 2.0"), "2.0 is not an integer"),
        (replaced(": 2", ": NaN"), "NaN is not an integer"),
        (replaced(": 2", ': 2, "instances": 2'), "an object has the same key twice"),
        (replaced(": 2", ': 2, "extra": 2'), "unknown key 'extra'"),
        (replaced("[1, 2, 3, 6]", "[1, 2, 6, 3]"), "tetrahedra are not"),
        (replaced("[1, 2, 3, 6]", "[1, 2, 3, 9]"), "tetrahedra are not"),
        (replaced("[1, 2, 3, 6], ", ""), "tetrahedra: "),
        (replaced("[1, 0, 0]", "[1, 0]"), "a point has 2 coordinates instead of three"),
        (replaced("[1, 0, 0]", "[1, 0, 0.5]"), "0.5 is not an integer"),
        (replaced("[1, 0, 0]", '[1, 0, "1/0"]'), "is not an integer"),
        (replaced("[1, 0, 0]", "[0, 0, 0]"), "realizable: tetrahedron 1236 is degenerate"),
        (replaced('"yes"', '"maybe"'), "realizable: answer is not"),
        (refuted("../x.lrat"), "valid: proof is not proofs/5_A.valid.lrat"),
        (refuted("/etc/passwd"), "valid: proof is not proofs/5_A.valid.lrat"),
        (refuted("proofs/../5_A.valid.lrat"), "valid: proof is not proofs/5_A.valid.lrat"),
    ],
)
def test_spoiled_certificate(root: Path, content: Callable[[], bytes], fault: str) -> None:
    (root / "certificates" / "5_A.json").write_bytes(content())
    assert_rejects(run(root, "check", "5_A"), "certificates/5_A.json", fault)
    to = str(root / "exported")
    assert_rejects(run(root, "export", "5_A", "valid", "--to", to), "certificates/5_A.json", fault)
    code, out, _ = run(root, "show", "5_A")
    assert code == 1
    assert fault in out.splitlines()[0]
    assert run(root, "list")[0] == 1
    assert not Path(to).exists()


def to_nothing(path: Path) -> None:
    path.symlink_to("nothing")


def to_itself(path: Path) -> None:
    path.symlink_to(path.name)


def to_outside(path: Path) -> None:
    outside = path.parent.parent / "outside"
    outside.write_bytes((CHECKOUT / path.parent.name / path.name).read_bytes())
    path.symlink_to(outside)


def nothing(_: Path) -> None:
    """Leave the place empty."""


NO_FILES = [to_nothing, to_itself, Path.mkdir, os.mkfifo, nothing]


@pytest.mark.parametrize("place", NO_FILES)
def test_no_regular_certificate(root: Path, place: Callable[[Path], None]) -> None:
    path = root / "certificates" / "5_A.json"
    path.unlink()
    place(path)
    assert_rejects(run(root, "check", "5_A"), "5_A.json", "is missing, or is not a regular file")
    assert_rejects(run(root, "show", "5_A"), "5_A.json", "is missing, or is not a regular file")


@pytest.mark.parametrize("place", [*NO_FILES, to_outside])
def test_no_regular_proof(root: Path, place: Callable[[Path], None]) -> None:
    path = root / "proofs" / "15_A.realizable.lrat"
    path.unlink()
    place(path)
    assert_rejects(run(root, "check", "15_A"), "certificates/15_A.json", "")
    code, out, _ = run(root, "show", "15_A")
    assert code == 1
    assert "realizable: no, by proofs/15_A.realizable.lrat: it cannot be read" in out


def test_unreadable_certificate(root: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def refuse(*_: object, **__: object) -> None:
        raise PermissionError(13, "Permission denied")

    monkeypatch.setattr(Path, "open", refuse)
    assert_rejects(run(root, "check", "5_A"), "5_A.json", "cannot be read: Permission denied")


@pytest.mark.parametrize(
    ("spoil", "fault"),
    [
        (lambda proof: proof.replace(b" 0", b"  0", 1), "line 1: not a step in the LRAT format"),
        (lambda proof: proof.splitlines(keepends=True)[0], "without the empty clause"),
        (lambda _: b"99999 0 99998 0\n", "line 1: there is no clause 99998"),
        (lambda _: "99999 0 \N{SUPERSCRIPT TWO} 0\n".encode(), "is not ASCII"),
    ],
)
def test_spoiled_proof(root: Path, spoil: Callable[[bytes], bytes], fault: str) -> None:
    path = root / "proofs" / "15_A.realizable.lrat"
    path.write_bytes(spoil(path.read_bytes()))
    assert_rejects(
        run(root, "check", "15_A"), path.name, "is not the one that the certificate states"
    )
    document = json.loads((root / "certificates" / "15_A.json").read_text())
    document["realizable"]["sha256"] = sha256(path.read_bytes()).hexdigest()
    write(root, document)
    assert_rejects(run(root, "check", "15_A"), "certificates/15_A.json: ", fault)


@pytest.mark.parametrize(
    "key", ["\x1b[31m[bold red]x", "\ud800", "a\nb", "\u202e:smile:", "\x9b2J"]
)
def test_hostile_text_is_escaped(root: Path, key: str) -> None:
    write(root, five_a() | {key: 1})
    for command in (["check", "5_A"], ["show", "5_A"], ["list"], ["check-all"]):
        _, out, err = run(root, *command)
        assert ascii(key)[1:-1] in out
        assert all(char.isprintable() for char in (out + err).replace("\n", ""))


def test_hostile_file_name_is_escaped(root: Path) -> None:
    (root / "certificates" / "\x1b[2J[red]\n.json").touch()
    code, out, _ = run(root, "check-all")
    assert code == 1
    assert r"rejected: certificates/'\x1b[2J[red]\n.json': the file is not named after" in out


def test_a_kernel_that_breaks_off_rejects(root: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def break_off(*_: object) -> None:
        raise RuntimeError("out of order")

    monkeypatch.setattr(checking, "shelling", break_off)
    fault = "RuntimeError('out of order')"
    assert_rejects(run(root, "check", "5_A"), "certificates/5_A.json", fault)


# check-all


def test_check_all_of_the_checkout() -> None:
    code, record = run_json(CHECKOUT, "check-all")
    assert list(record) == [
        "ok", "certify", "python", "sympy", "kernel_sha256", "evidence_sha256",
        "patterns", *QUESTIONS, "open", "rejected", "theorems", "seconds",
    ]  # fmt: skip
    assert (code, record["ok"], record["patterns"], record["rejected"]) == (0, True, 174, [])
    for theorem in record["theorems"]:
        assert list(theorem) == ["id", "statement", "rests_on", "ok"]
        assert theorem["ok"]
    assert all(pattern in PATTERN_NAMES and q in QUESTIONS for pattern, q in record["open"])


def test_check_all_prints_the_papers_table() -> None:
    _, out, _ = run(CHECKOUT, "check-all")
    table, _, theorems_and_summary = out.partition("\n\n")
    rows = {line.split()[0]: line.split()[1:] for line in table.splitlines()}
    assert rows["tetrahedra"] == [*map(str, range(5, 16)), "Sum"]
    assert rows["combinatorial"] == "1 5 5 7 13 20 35 30 28 19 11 174".split()  # noqa: SIM905
    for question in QUESTIONS:
        *cells, total = map(int, rows[question])
        assert len(cells) == 11
        assert sum(cells) == total
    *_, summary = theorems_and_summary.splitlines()
    assert summary.startswith("ok: 174 accepted, 0 rejected, 0 open, 15 of 15 theorems, ")
    assert all(len(line) <= 80 for line in out.splitlines())


def test_check_all_reports_what_is_missing(root: Path) -> None:
    code, record = run_json(root, "check-all")
    assert code == 1
    assert not record["ok"]
    assert [record[key] for key in ("patterns", "realizable", "convex")] == [2, 1, 1]
    assert len(record["rejected"]) == 172
    assert record["rejected"][0]["pattern"] == "6_A"
    assert "missing" in record["rejected"][0]["fault"]
    assert "patterns" in [theorem["id"] for theorem in record["theorems"] if not theorem["ok"]]
    code, out, err = run(root, "check-all")
    assert (code, err) == (1, "")
    assert "rejected: certificates/6_A.json: 6_A.json is missing" in out
    assert "not shown: patterns: " in out
    assert out.splitlines()[-1].startswith("not ok: 2 accepted, 172 rejected, ")


def test_check_all_counts_open_questions(root: Path) -> None:
    write(root, five_a() | {"convex": {"answer": "open"}})
    _, record = run_json(root, "check-all")
    assert ["5_A", "convex"] in record["open"]
    _, out, _ = run(root, "check-all")
    assert "open: 5_A convex" in out
    assert ["open", "1"] in [line.split()[:2] for line in out.splitlines()]


def test_jobs_change_nothing_but_the_time(root: Path) -> None:
    (root / "certificates" / "6_A.json").write_text("{")
    alone, together = (run_json(root, "check-all", "--jobs", jobs) for jobs in ("1", "2"))
    assert alone[0] == together[0] == 1
    assert alone[1] | {"seconds": 0} == together[1] | {"seconds": 0}


@pytest.fixture
def everything(tmp_path: Path) -> Path:
    """Return a root with all certificates and proofs."""
    for folder in ("certificates", "proofs"):
        copytree(CHECKOUT / folder, tmp_path / folder)
    return tmp_path


def test_check_all_fails_for_a_theorem_alone(
    everything: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(
        theorems, "theorems", lambda *_: [Theorem("all", "All is well.", (), False)]
    )
    code, record = run_json(everything, "check-all")
    assert (code, record["ok"], record["rejected"]) == (1, False, [])


@pytest.mark.parametrize("name", ["5_B.json", "README.json", ".json"])
def test_check_all_rejects_strays(everything: Path, name: str) -> None:
    copy(everything / "certificates" / "5_A.json", everything / "certificates" / name)
    code, record = run_json(everything, "check-all")
    assert code == 1
    (rejected,) = record["rejected"]
    assert rejected["fault"].startswith("certificates/")
    assert rejected["fault"].endswith("the file is not named after a pattern")
    assert record["patterns"] == 174
    assert all(theorem["ok"] for theorem in record["theorems"])


@pytest.mark.parametrize("place", [nothing, to_itself, lambda path: path.write_text("1 0 0\n")])
def test_check_all_rejects_a_proof_of_completeness(
    everything: Path, place: Callable[[Path], None]
) -> None:
    path = everything / "proofs" / "complete.a.lrat"
    path.unlink()
    place(path)
    code, record = run_json(everything, "check-all", "--junit", str(everything / "report.xml"))
    assert (code, record["ok"], record["patterns"]) == (1, False, 174)
    (rejected,) = record["rejected"]
    assert rejected["pattern"] is None
    assert rejected["fault"].startswith("proofs/complete.a.lrat: ")
    shown = {theorem["id"]: theorem["ok"] for theorem in record["theorems"]}
    assert shown["boundaries"]
    assert not shown["patterns"]
    _, out, _ = run(everything, "check-all")
    assert f"rejected: {rejected['fault']}\n" in out
    failures = list(ElementTree.parse(everything / "report.xml").iter("failure"))
    assert len(failures) == list(shown.values()).count(False) + 1
    assert failures[0].get("message") == rejected["fault"]


def test_junit(root: Path) -> None:
    file = root / "report.xml"
    code, _, _ = run(root, "check-all", "--junit", str(file))
    suites = ElementTree.parse(file).getroot()
    cases = list(suites.iter("testcase"))
    failed = [case.get("name") for case in cases if case.find("failure") is not None]
    assert code == 1
    assert suites.get("tests") == str(len(cases))
    assert suites.get("failures") == str(len(failed))
    assert [case.get("name") for case in cases][:174] == list(PATTERN_NAMES)
    assert {case.get("classname") for case in cases} == {"certify.patterns", "certify.theorems"}
    assert "5_A" not in failed
    assert "6_A" in failed
    assert "patterns" in failed


def test_junit_of_the_checkout(tmp_path: Path) -> None:
    file = tmp_path / "report.xml"
    assert run(CHECKOUT, "check-all", "--junit", str(file))[0] == 0
    assert not list(ElementTree.parse(file).iter("failure"))


def test_junit_cannot_be_written(root: Path) -> None:
    code, out, err = run(root, "check-all", "--junit", str(root))
    assert (code, out) == (2, "")
    assert "--junit" in err


def test_processes_that_are_killed(root: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def broken(*_: object, **__: object) -> None:
        raise BrokenProcessPool

    monkeypatch.setattr(running, "ProcessPoolExecutor", broken)
    assert_usage_error(run(root, "check-all", "--jobs", "2"), "was killed")


@pytest.mark.parametrize("jobs", ["0", "-1", "x"])
def test_jobs_must_be_a_positive_number(root: Path, jobs: str) -> None:
    assert run(root, "check-all", "--jobs", jobs)[0] == 2


# list and show


def test_list_says_what_is_claimed(root: Path) -> None:
    code, out, _ = run(root, "list")
    assert code == 1
    assert "as claimed; check-all decides" in out
    assert "5_A 5 a 2 yes yes yes".split() in [line.split() for line in out.splitlines()]  # noqa: SIM905
    assert "rejected: certificates/5_B.json" not in out
    assert "rejected: certificates/6_A.json: 6_A.json is missing" in out


def test_list_does_not_check(root: Path) -> None:
    write(root, five_a() | {"instances": 99})
    assert "99" in run(root, "list")[1]


def test_list_of_the_checkout() -> None:
    code, record = run_json(CHECKOUT, "list")
    assert code == 0
    assert record["rejected"] == []
    assert "as claimed" in record["note"]
    assert [claim["pattern"] for claim in record["patterns"]] == list(PATTERN_NAMES)
    assert record["patterns"][0] == {
        "pattern": "5_A", "tetrahedra": 5, "boundary": "a", "instances": 2,
        "realizable": "yes", "convex": "yes", "valid": "yes",
    }  # fmt: skip


def test_show_prints_the_points_once(root: Path) -> None:
    code, out, _ = run(root, "show", "5_A")
    assert code == 0
    verdict, found, *_ = out.splitlines()
    assert verdict == "5_A: realizable yes, convex yes, valid yes"
    assert found == "5 tetrahedra, boundary type a, 2 instances; from certificates/5_A.json"
    assert "tetrahedra: 1236 1348 1368 1568 3678\n" in out
    assert out.count("vertex") == 1
    assert ["7", "1", "1", "1"] in [line.split() for line in out.splitlines()]
    assert "convex: yes, by the points of realizable\n" in out


def test_show_prints_fractions(root: Path) -> None:
    halves = [[f"{x}/2" for x in corner] for corner in CORNERS.values()]
    write(root, five_a() | {"valid": {"answer": "yes", "points": halves}})
    code, out, _ = run(root, "show", "5_A")
    assert code == 0
    assert ["7", "1/2", "1/2", "1/2"] in [line.split() for line in out.splitlines()]


def test_show_describes_a_refutation(root: Path) -> None:
    lines = (root / "proofs" / "15_A.realizable.lrat").read_text().splitlines()
    code, out, _ = run(root, "show", "15_A")
    evidence = f"proofs/15_A.realizable.lrat: {len(lines)} lemmas"
    assert code == 0
    assert f"realizable: no, by {evidence}\n" in out


def test_show_json(root: Path) -> None:
    code, record = run_json(root, "show", "15_A")
    assert code == 0
    assert record["verdict"]["ok"]
    assert record["certificate"]["realizable"]["proof"] == "proofs/15_A.realizable.lrat"
    assert record["certificate"]["realizable"]["lemmas"] > 0
    (root / "certificates" / "15_A.json").write_text("{")
    code, record = run_json(root, "show", "15_A")
    assert (code, record["certificate"], record["verdict"]["ok"]) == (1, None, False)


# export


def test_export_of_a_refutation(root: Path) -> None:
    to = root / "new" / "folder"
    code, out, _ = run(root, "export", "15_A", "realizable", "--to", str(to))
    assert code == 0
    assert len(out.splitlines()) == 3
    for suffix in ("lrat", "drat"):
        name = f"15_A.realizable.{suffix}"
        assert (to / name).read_bytes() == (root / "proofs" / name).read_bytes()
    lines = (to / "15_A.realizable.cnf").read_text(encoding="ascii").splitlines()
    comments = [line for line in lines if line.startswith("c ")]
    header, *clauses = lines[len(comments) :]
    assert "c 1: det 1234 > 0, 2: det 1234 < 0" in comments
    assert "c 139: det 5678 > 0, 140: det 5678 < 0" in comments
    assert header == f"p cnf 140 {len(clauses)}"
    formula = [tuple(map(int, line.split())) for line in clauses]
    assert {clause[-1] for clause in formula} == {0}
    replay([clause[:-1] for clause in formula], (to / "15_A.realizable.lrat").read_text())


def test_export_of_points(root: Path) -> None:
    code, out, _ = run(root, "export", "5_A", "convex", "--to", str(root))
    assert (code, out) == (0, f"5_A convex: {root / '5_A.convex.json'}\n")
    record = json.loads((root / "5_A.convex.json").read_text())
    assert record["tetrahedra"] == five_a()["tetrahedra"]
    assert record["points"] == [list(corner) for corner in CORNERS.values()]


def test_export_refuses_what_is_rejected(root: Path) -> None:
    write(root, five_a() | {"boundary": "b"})
    to = root / "exported"
    outcome = run(root, "export", "5_A", "convex", "--to", str(to))
    assert_rejects(outcome, "certificates/5_A.json", "boundary: stated b")
    assert not to.exists()


def test_export_of_an_open_question(root: Path) -> None:
    write(root, five_a() | {"valid": {"answer": "open"}})
    outcome = run(root, "export", "5_A", "valid", "--to", str(root))
    assert_usage_error(outcome, "5_A valid is open")


def test_export_of_no_question(root: Path) -> None:
    outcome = run(root, "export", "5_A", "beautiful", "--to", str(root))
    assert_usage_error(outcome, "unknown question beautiful")


def test_export_to_no_folder(root: Path) -> None:
    file = root / "file"
    file.touch()
    assert_usage_error(run(root, "export", "5_A", "valid", "--to", str(file)), "file")
    assert_usage_error(run(root, "export", "5_A", "valid", "--to", str(file / "below")), "file")


@pytest.mark.parametrize("place", [*NO_FILES, to_outside])
def test_export_without_a_regular_drat_file(root: Path, place: Callable[[Path], None]) -> None:
    path = root / "proofs" / "15_A.realizable.drat"
    path.unlink()
    place(path)
    to = root / "exported"
    outcome = run(root, "export", "15_A", "realizable", "--to", str(to))
    assert_rejects(outcome, path.name, "")
    assert not to.exists()


@pytest.mark.parametrize("letter", ["a", "g"])
def test_export_of_completeness(tmp_path: Path, letter: str) -> None:
    code, _, _ = run(CHECKOUT, "export", "complete", letter, "--to", str(tmp_path))
    assert code == 0
    stem = tmp_path / f"complete.{letter}"
    lines = Path(f"{stem}.cnf").read_text().splitlines()
    formula = [tuple(map(int, line.split()[:-1])) for line in lines if line[0] not in "cp"]
    replay(formula, Path(f"{stem}.lrat").read_text())
    lemmas = Path(f"{stem}.lrat").read_text().splitlines()
    assert len(Path(f"{stem}.drat").read_text().splitlines()) == len(lemmas)


def test_export_of_completeness_needs_all_patterns(root: Path) -> None:
    to = root / "exported"
    assert_usage_error(
        run(root, "export", "complete", "h", "--to", str(to)), "unknown boundary type h"
    )
    code, _, err = run(root, "export", "complete", "a", "--to", str(to))
    assert code == 1
    assert err.startswith("certify: rejected: certificates/6_A.json: ")
    assert not to.exists()


# show, for the engineer


def test_show_gives_the_quality_of_a_valid_hexahedron(root: Path) -> None:
    _, out, _ = run(root, "show", "5_A")
    assert "Jacobian at least 1 on the closed cube" in out
    assert f"scaled at the vertices 1..8: {' '.join(['1.000'] * 8)}" in out


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


# The program as a whole


@pytest.mark.parametrize("command", COMMANDS)
def test_help_has_an_example(command: str) -> None:
    result = CliRunner().invoke(cli, [command, "--help"])
    assert result.exit_code == 0
    assert f"  certify {command}" in result.output.partition("Example")[2]


def test_help_names_all_commands() -> None:
    result = CliRunner().invoke(cli, ["--help"])
    assert result.exit_code == 0
    assert all(command in result.output for command in COMMANDS)


@pytest.mark.parametrize(
    "args", [["frobnicate"], ["check"], ["show", "5_A", "6_A"], ["list", "-x"]]
)
def test_usage_errors(args: list[str]) -> None:
    assert CliRunner().invoke(cli, args).exit_code == 2


def test_interrupt(root: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def interrupt(*_: object) -> None:
        raise KeyboardInterrupt

    monkeypatch.setattr(checking, "shelling", interrupt)
    assert run(root, "check", "5_A") == (130, "", "\ncertify: interrupted\n")


def test_default_root(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    assert evidence.default_root() == CHECKOUT
    monkeypatch.setattr(evidence, "__file__", str(tmp_path / "certify" / "kernel" / "evidence.py"))
    (tmp_path / "certify" / "data").mkdir(parents=True)
    assert evidence.default_root() == tmp_path / "certify" / "data"


def test_version_and_help_do_without_sympy() -> None:
    result = spawn("--version", capture_output=True)
    assert (result.returncode, result.stdout) == (0, f"certify {__version__}\n")
    code = (
        "import sys\nfrom certify.cli import main\nsys.argv = ['certify', '--help']\n"
        "try:\n    main()\nexcept SystemExit:\n    sys.exit('sympy' in sys.modules)"
    )
    assert subprocess.run([sys.executable, "-c", code], cwd=CHECKOUT, check=False).returncode == 0


def test_program_uses_its_own_certificates() -> None:
    result = spawn("check", "5_A", capture_output=True)
    assert (result.returncode, result.stderr) == (0, "")
    assert result.stdout.startswith("5_A: realizable yes")


def test_program_writes_to_any_terminal(root: Path) -> None:
    write(root, five_a() | {"\u4e2d": 1})
    environment = os.environ | {"PYTHONIOENCODING": "latin-1", "COLUMNS": "20"}
    result = spawn("list", "--root", str(root), capture_output=True, env=environment)
    assert (result.returncode, result.stderr) == (1, "")
    assert r"unknown key '\u4e2d'" in result.stdout
    rows = [line.replace("|", " ").split() for line in result.stdout.splitlines()]
    assert ["15_A", "15", "g", "24", "no", "no", "no"] in rows


def test_progress_goes_to_a_terminal_on_standard_error(root: Path) -> None:
    command = [sys.executable, "-m", "certify", "check-all", "--json", "--root", str(root)]
    parent, child = pty.openpty()
    with (root / "out").open("wb") as out:
        process = subprocess.Popen(
            [*command, "--jobs", "2"], cwd=CHECKOUT, stdout=out, stderr=child
        )
    os.close(child)
    assert "checking" in drained(parent)
    assert process.wait() == 1
    assert json.loads((root / "out").read_text())["patterns"] == 2


def drained(terminal: int) -> str:
    """Return what is written to a terminal until its other end is closed."""
    content = b""
    try:
        while chunk := os.read(terminal, 1 << 12):
            content += chunk
    except OSError:  # so Linux says that the other end is closed
        pass
    os.close(terminal)
    return content.decode()


def test_program_survives_a_closed_pipe(root: Path) -> None:
    read, write_ = os.pipe()
    os.close(read)
    for args in (["check", "5_A"], ["list"], ["check-all", "--json"], ["--help"]):
        root_args = [] if args == ["--help"] else ["--root", str(root)]
        result = spawn(*args, *root_args, stdout=write_, stderr=subprocess.PIPE)
        assert "Traceback" not in result.stderr
        assert "Exception" not in result.stderr
    os.close(write_)
