"""The commands that check: check, check-all, replay."""

import json
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures.process import BrokenProcessPool
from pathlib import Path
from shutil import rmtree
from xml.etree import ElementTree

import pytest
from click.testing import CliRunner

from certify import processes
from certify.cli import cli
from certify.kernel import theorems
from certify.kernel.certificate import PATTERN_NAMES, QUESTIONS
from certify.kernel.theorems import Theorem
from tests.commands import (
    CHECKOUT,
    Outcome,
    assert_rejects,
    assert_usage_error,
    five_a,
    nothing,
    run,
    run_json,
    to_itself,
    write,
)


def test_check_prints_a_line_a_pattern(root: Path) -> None:
    code, out, err = run(root, "check", "5_A", "15_A")
    first, second = out.splitlines()
    assert (code, err) == (0, "")
    assert first == "ok: 5_A: realizable yes, convex yes, valid yes"
    assert second.startswith("ok: 15_A: realizable no, convex no, valid ")


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
        "rejected: certificates/5_A.json: instances: stated 3, but it is 2\nok: 15_A:"
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


# check-all


def test_check_all_of_the_checkout() -> None:
    code, record = run_json(CHECKOUT, "check-all")
    assert list(record) == [
        "ok", "certify", "python", "sympy", "kernel_sha256", "evidence_sha256",
        "manifest", "patterns", *QUESTIONS, "open", "rejected", "theorems", "seconds",
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
    assert summary.startswith("ok: 174 accepted, 0 rejected, 0 open, 16 of 16 theorems, ")
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


def without(name: str) -> Callable[[Path], None]:
    return lambda root: (root / name).unlink()


def renamed(name: str, other: str) -> Callable[[Path], None]:
    def rename(root: Path) -> None:
        (root / name).rename(root / other)

    return rename


def emptied(name: str) -> Callable[[Path], None]:
    def empty(root: Path) -> None:
        rmtree(root / name)
        (root / name).mkdir()

    return empty


YES, NO = "certificates/8_E.json", "proofs/15_K.valid.lrat"


@pytest.mark.parametrize(
    ("lose", "accepted", "named"),
    [
        pytest.param(without(YES), 173, YES, id="no file"),
        pytest.param(renamed(YES, f"{YES}.old"), 173, YES, id="another suffix"),
        pytest.param(renamed(YES, "certificates/8_EE.json"), 173, YES, id="another name"),
        pytest.param(renamed(YES, "8_E.json"), 173, YES, id="another folder"),
        pytest.param(emptied("certificates"), 0, YES, id="no certificates"),
        pytest.param(without(NO), 173, NO, id="no proof"),
        pytest.param(renamed(NO, f"{NO}.old"), 173, NO, id="another name for a proof"),
        pytest.param(emptied("proofs"), 143, NO, id="no proofs"),
        pytest.param(lambda root: rmtree(root / "proofs"), 143, NO, id="no folder of proofs"),
    ],
)
def test_nothing_that_is_missing_is_passed_over(
    everything: Path, lose: Callable[[Path], None], accepted: int, named: str
) -> None:
    """Neither in silence nor by a smaller number that is called a success."""
    lose(everything)
    code, out, err = run(everything, "check-all")
    *lines, last = out.splitlines()
    assert (code, err) == (1, "")
    assert last.startswith(f"not ok: {accepted} accepted, ")
    assert [line for line in lines if line.startswith("rejected: ") and Path(named).name in line]
    assert [line for line in lines if line.startswith("not shown: valid: ")]


def test_a_folder_without_certificates_is_no_root(everything: Path) -> None:
    rmtree(everything / "certificates")
    for command in ("check-all", "audit"):
        assert_usage_error(run(everything, command), "has no folder certificates")


def test_check_all_fails_for_a_theorem_alone(
    everything: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(
        theorems, "theorems", lambda *_: [Theorem("all", "All is well.", (), False)]
    )
    code, record = run_json(everything, "check-all")
    assert (code, record["ok"], record["rejected"]) == (1, False, [])


@pytest.mark.parametrize("name", [f"certificates/{name}.json" for name in ("5_B", "README", "")])
def test_check_all_rejects_strays(everything: Path, name: str) -> None:
    (everything / name).touch()
    code, record = run_json(everything, "check-all")
    assert code == 1
    fault = f"{name}: the file is not named after a pattern"
    assert record["rejected"] == [{"pattern": name, "fault": fault}]
    assert record["patterns"] == 174
    assert all(theorem["ok"] for theorem in record["theorems"])


@pytest.mark.parametrize("name", ["certificates/README", "proofs/5_B.lrat"])
def test_files_of_other_kinds_are_nobodys_concern(everything: Path, name: str) -> None:
    (everything / name).touch()
    assert run(everything, "check-all")[0] == 0


def test_check_all_rejects_a_folder_that_cannot_be_listed(
    everything: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    list_it = Path.iterdir

    def refuse(path: Path) -> Iterator[Path]:
        if path.name == "certificates":
            raise PermissionError(13, "Permission denied")
        return list_it(path)

    monkeypatch.setattr(Path, "iterdir", refuse)
    code, record = run_json(everything, "check-all")
    fault = "certificates: the folder cannot be listed: Permission denied"
    assert (code, record["rejected"]) == (1, [{"pattern": "certificates", "fault": fault}])


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

    monkeypatch.setattr(processes, "ProcessPoolExecutor", broken)
    line = "certify: a process that checks was killed\n"
    assert run(root, "check-all", "--jobs", "2") == (1, "", line)


@pytest.mark.parametrize("jobs", ["0", "-1", "x"])
def test_jobs_must_be_a_positive_number(root: Path, jobs: str) -> None:
    assert run(root, "check-all", "--jobs", jobs)[0] == 2


# replay


FORMULA = "c a square\np cnf 2 4\n1 2 0\n-1 2 0\n1 -2 0\n-1\n-2 0\n"
PROOF = "5 2 0 1 2 0\n6 0 5 3 4 0\n"


def replayed(folder: Path, formula: str | bytes, proof: str | bytes, *args: str) -> Outcome:
    """Return what replay says of a formula and a proof."""
    paths = []
    for name, content in (("f.cnf", formula), ("p.lrat", proof)):
        paths.append(folder / name)
        paths[-1].write_bytes(content.encode() if isinstance(content, str) else content)
    result = CliRunner().invoke(cli, ["replay", *map(str, paths), *args])
    return result.exit_code, result.stdout, result.stderr


def test_replay_of_any_proof(tmp_path: Path) -> None:
    formula, proof = tmp_path / "f.cnf", tmp_path / "p.lrat"
    line = f"ok: {proof} refutes {formula} in 2 steps\n"
    assert replayed(tmp_path, FORMULA, PROOF) == (0, line, "")
    code, out, _ = replayed(tmp_path, FORMULA, PROOF, "--json")
    assert (code, json.loads(out)) == (0, {"ok": True, "steps": 2, "fault": None})


@pytest.mark.parametrize(
    ("formula", "proof", "fault"),
    [
        (FORMULA, "", "p.lrat: line 1: not a step in the LRAT format"),
        (FORMULA, "5 2 0 1 0\n", "p.lrat: line 1: the hints do not reach a contradiction"),
        (
            FORMULA,
            "5 0 1 -2 0\n",
            "p.lrat: line 1: a hint is negative: RAT steps",
        ),
        (FORMULA, b"a\xff\0\1", "p.lrat: not ASCII text; binary formats are not read"),
        ("p cnf 2 4\n1 2 0\n-1 2 0\nc \f1 -2 0\f-1 -2 0\n", PROOF, "but there are 2"),
        ("", PROOF, 'f.cnf: there is no header "p cnf VARIABLES CLAUSES"'),
        ("1 0\n", PROOF, "f.cnf: line 1: 1 is beyond the 0 variables announced so far"),
        ("p cnf 2 1\n3 0\n", PROOF, "f.cnf: line 2: 3 is beyond the 2 variables announced so far"),
        ("p cnf 2 2\n1 0\n", PROOF, "f.cnf: the header announces 2 clauses, but there are 1"),
        ("p cnf 2 1\n1 0 2\n", PROOF, "f.cnf: the last clause does not end with 0"),
        ("p cnf 2 1\nx 0\n", PROOF, "f.cnf: line 2: 'x' is not an integer of at most"),
        ("p cnf 2 1\n" + "9" * 99, PROOF, "is not an integer of at most nine digits"),
        ("p cnf 2 1\n1 -0\n", PROOF, "f.cnf: line 2: '-0' is not an integer"),
        ("p cnf 2 1\n01 0\n", PROOF, "f.cnf: line 2: '01' is not an integer"),
        ("p cnf 2 -1\n", PROOF, "f.cnf: line 1: the header announces a negative number"),
        ("p cnf -2 0\n", PROOF, "f.cnf: line 1: the header announces a negative number"),
        ("p cnf 2 1\np cnf 2 1\n", PROOF, "f.cnf: line 2: 'p' is not an integer"),
    ],
)
def test_replay_rejects(tmp_path: Path, formula: str, proof: str | bytes, fault: str) -> None:
    outcome = replayed(tmp_path, formula, proof)
    assert_rejects(outcome, "", fault)
    assert outcome[1].startswith("rejected: ")


def test_replay_of_missing_files(tmp_path: Path) -> None:
    result = CliRunner().invoke(cli, ["replay", str(tmp_path / "f"), str(tmp_path / "p")])
    assert (result.exit_code, result.stdout) == (2, "")
    assert result.stderr.endswith("f is missing, or is not a regular file\n")


@pytest.mark.parametrize(("pattern", "question"), [("15_K", "valid"), ("15_A", "realizable")])
def test_replay_of_what_is_exported(tmp_path: Path, pattern: str, question: str) -> None:
    stem = tmp_path / f"{pattern}.{question}"
    assert run(CHECKOUT, "export", pattern, question, "--to", str(tmp_path))[0] == 0
    result = CliRunner().invoke(cli, ["replay", f"{stem}.cnf", f"{stem}.lrat"])
    assert (result.exit_code, result.stdout[:3]) == (0, "ok:")
