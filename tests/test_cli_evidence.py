"""The commands that show evidence: list, show, export."""

import json
from pathlib import Path

import pytest

from certify.kernel.certificate import PATTERN_NAMES
from certify.kernel.hexahedron import CORNERS
from certify.kernel.refutation import replay
from tests.commands import (
    CHECKOUT,
    assert_rejects,
    assert_usage_error,
    five_a,
    run,
    run_json,
    write,
)


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
    assert verdict == "ok: 5_A: realizable yes, convex yes, valid yes"
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
    evidence = f"proofs/15_A.realizable.lrat: {len(lines)} steps"
    assert code == 0
    assert f"realizable: no, by {evidence}\n" in out


def test_show_json(root: Path) -> None:
    code, record = run_json(root, "show", "15_A")
    assert code == 0
    assert record["verdict"]["ok"]
    assert record["certificate"]["realizable"]["proof"] == "proofs/15_A.realizable.lrat"
    assert record["certificate"]["realizable"]["steps"] > 0
    (root / "certificates" / "15_A.json").write_text("{")
    code, record = run_json(root, "show", "15_A")
    assert (code, record["certificate"], record["verdict"]["ok"]) == (1, None, False)


# export


def test_export_of_a_refutation(root: Path) -> None:
    to = root / "new" / "folder"
    code, out, _ = run(root, "export", "15_A", "realizable", "--to", str(to))
    assert code == 0
    assert len(out.splitlines()) == 3
    proof = (to / "15_A.realizable.lrat").read_bytes()
    assert proof == (root / "proofs" / "15_A.realizable.lrat").read_bytes()
    assert_drat_has_the_lemmas(to / "15_A.realizable")
    lines = (to / "15_A.realizable.cnf").read_text(encoding="ascii").splitlines()
    comments = [line for line in lines if line.startswith("c ")]
    header, *clauses = lines[len(comments) :]
    assert "c 1: det 1234 > 0, 2: det 1234 < 0" in comments
    assert "c 139: det 5678 > 0, 140: det 5678 < 0" in comments
    assert header == f"p cnf 140 {len(clauses)}"
    formula = [tuple(map(int, line.split())) for line in clauses]
    assert {clause[-1] for clause in formula} == {0}
    replay([clause[:-1] for clause in formula], (to / "15_A.realizable.lrat").read_text())


def test_export_of_a_plain_core(root: Path) -> None:
    code, _, _ = run(root, "export", "15_A", "realizable", "--core", "--plain", "--to", str(root))
    header, *clauses = (root / "15_A.realizable.cnf").read_text().splitlines()
    assert code == 0
    assert header.split()[:2] == ["p", "cnf"]
    assert len(clauses) == int(header.split()[3])


def test_export_of_points(root: Path) -> None:
    code, out, _ = run(root, "export", "5_A", "convex", "--to", str(root))
    assert (code, out) == (0, f"5_A convex: {root / '5_A.convex.json'}\n")
    record = json.loads((root / "5_A.convex.json").read_text())
    assert [sorted(row) for row in record["tetrahedra"]] == five_a()["tetrahedra"]
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


@pytest.mark.parametrize("letter", ["a", "g"])
def test_export_of_completeness(tmp_path: Path, letter: str) -> None:
    code, _, _ = run(CHECKOUT, "export", "complete", letter, "--to", str(tmp_path))
    assert code == 0
    stem = tmp_path / f"complete.{letter}"
    lines = Path(f"{stem}.cnf").read_text().splitlines()
    formula = [tuple(map(int, line.split()[:-1])) for line in lines if line[0] not in "cp"]
    replay(formula, Path(f"{stem}.lrat").read_text())
    assert_drat_has_the_lemmas(stem)


def assert_drat_has_the_lemmas(stem: Path) -> None:
    steps = [line.split() for line in Path(f"{stem}.lrat").read_text().splitlines()]
    lemmas = [" ".join(step[1 : step.index("0") + 1]) for step in steps]
    assert Path(f"{stem}.drat").read_text().splitlines() == lemmas


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
