"""The commands for engineers, as a user meets them."""

import json
from pathlib import Path

import numpy as np
import pytest

from certify.kernel.hexahedron import CORNERS
from tests.commands import (
    CHECKOUT,
    assert_rejects,
    assert_usage_error,
    run,
    run_json,
    to_itself,
)

Points = list[tuple[int, ...]]

CUBE: Points = [*CORNERS.values()]
TURNED: Points = [(3, 0, 0), *CUBE[1:]]
"""Vertex 1 is moved through the cube: nothing is realized, and the Jacobian is negative."""
FIVE = "1236 1348 1368 1568 3678"


def write(path: Path, *hexahedra: Points) -> Path:
    path.write_text(json.dumps(hexahedra))
    return path


@pytest.fixture
def cube(tmp_path: Path) -> Path:
    return write(tmp_path / "cube.json", CUBE)


@pytest.fixture
def three(tmp_path: Path) -> Path:
    larger: Points = [tuple(4 * x for x in point) for point in CUBE]
    return write(tmp_path / "three.json", CUBE, TURNED, larger)


def test_the_cube(cube: Path) -> None:
    code, out, err = run(CHECKOUT, "triangulate", str(cube))
    assert (code, err) == (0, "")
    assert max(map(len, out.splitlines())) <= 80
    assert out.startswith("cube.json: valid, ")
    assert "\nrealized: 74 of the 6,966 labelled triangulations, in 6 patterns\n" in out
    assert "\nboundaries filled by these: 46 of 64\n" in out
    assert "\nimpossible without further points: 18;" in out


def test_one_boundary(cube: Path) -> None:
    words = ["triangulate", str(cube), "--diagonals"]
    code, out, _ = run(CHECKOUT, *words, "13,16,18,36,38,68")
    assert code == 0
    assert "\nrealized with these diagonals: 5 of the 6,966" in out
    code, out, _ = run(CHECKOUT, *words, "13 16 27 38 45 57")
    assert code == 1
    assert "\nrealized with these diagonals: 0 of the 6,966" in out
    assert "impossible without further points: 1;" in out


def test_nothing_realized(tmp_path: Path) -> None:
    code, out, _ = run(CHECKOUT, "triangulate", str(write(tmp_path / "new.json", TURNED)))
    assert code == 1
    assert "not valid, the Jacobian is not positive at 1 2 and on " in " ".join(out.split())
    assert "the best" not in out


def test_json(cube: Path) -> None:
    code, found = run_json(CHECKOUT, "triangulate", str(cube))
    assert code == 0
    assert (found["hexahedron"], found["realized"]) == ("cube.json", 74)
    assert len(found["triangulations"]) == 74


def test_many(three: Path, tmp_path: Path) -> None:
    code, out, _ = run(CHECKOUT, "triangulate", str(three))
    assert code == 1
    assert max(map(len, out.splitlines())) <= 80
    assert out.startswith("3 hexahedra: 2 valid, 1 not valid, 0 undecided, 0 mirrored\n")
    assert "\nhexahedra without a triangulation: 1\n" in out
    code, found = run_json(CHECKOUT, "triangulate", str(three))
    assert code == 1
    assert [row["realized"] for row in found["hexahedra"]] == [74, 0, 74]
    assert found["summary"]["worst"][0] == "2"


@pytest.mark.parametrize("ending", ["csv", "json", "parquet"])
def test_a_table(three: Path, tmp_path: Path, ending: str) -> None:
    table = tmp_path / f"table.{ending}"
    code, out, _ = run(CHECKOUT, "triangulate", str(three), "--to", str(table))
    assert code == 1
    assert out.splitlines()[-1] == f"a row for each: {table}"
    assert table.stat().st_size > 100
    assert [path.name for path in tmp_path.iterdir() if path.name.startswith(".")] == []


def test_one_of_many(three: Path) -> None:
    assert run(CHECKOUT, "triangulate", str(three), "--cell", "3")[1].startswith("3: valid")
    assert run(CHECKOUT, "triangulate", str(three), "--cell", "2")[0] == 1


@pytest.mark.parametrize(
    ("words", "message"),
    [
        ("--diagonals 12", "12 is no diagonal of a facet"),
        ("--diagonals 13,24", "two of these are diagonals of the same facet"),
        ("--cell 4", "there is no hexahedron 4 in "),
        ("--cell 0", "there is no hexahedron 0 in "),
        ("--cell x", "'x' is not a valid integer"),
        ("--to table.xyz", "unknown ending; it must be one of .csv, .json, .parquet"),
    ],
)
def test_usage_errors(three: Path, words: str, message: str) -> None:
    assert_usage_error(run(CHECKOUT, "triangulate", str(three), *words.split()), message)


def test_the_file_that_is_read_is_never_replaced(three: Path) -> None:
    content = three.read_bytes()
    path = three.with_suffix(".csv")
    path.write_bytes(content)
    outcome = run(CHECKOUT, "triangulate", str(path), "--to", str(path))
    assert_usage_error(outcome, f"{path} is the file that is read")
    assert path.read_bytes() == content


def test_files_that_are_not_there(tmp_path: Path) -> None:
    for command in ("triangulate", "name"):
        outcome = run(CHECKOUT, command, str(tmp_path / "new.json"))
        assert_usage_error(outcome, "No such file")
        loop = tmp_path / f"{command}.json"
        to_itself(loop)
        assert run(CHECKOUT, command, str(loop))[0] == 2


def test_bad_files(tmp_path: Path) -> None:
    path = tmp_path / "new.json"
    path.write_text("[1, 2")
    for command in ("triangulate", "name"):
        assert_rejects(run(CHECKOUT, command, str(path)), "new.json", "it is not JSON")


def test_bad_certificates(root: Path, cube: Path, tmp_path: Path) -> None:
    (root / "certificates" / "6_A.json").write_text("[]")
    assert_rejects(run(root, "triangulate", str(cube)), "rejected: certificates/6_A.json", "")
    tetrahedra = tmp_path / "new.txt"
    tetrahedra.write_text(FIVE)
    assert_rejects(run(root, "name", str(tetrahedra)), "rejected: certificates/6_A.json", "")


def test_the_name_of_a_pattern(tmp_path: Path) -> None:
    path = tmp_path / "new.txt"
    path.write_text(FIVE.translate(str.maketrans("12345678", "hgfedcba")))
    code, out, _ = run(CHECKOUT, "name", str(path))
    assert code == 0
    assert out.startswith("5_A, with the facets ")
    code, found = run_json(CHECKOUT, "name", str(path))
    (own,) = found["patterns"]
    assert own["pattern"] == "5_A"
    assert sorted(own["vertices"]) == [*"abcdefgh"]
    assert sorted(own["vertices"].values()) == [*range(1, 9)]
    moved = {
        tuple(sorted(own["vertices"][name] for name in word)) for word in path.read_text().split()
    }
    assert moved == {tuple(map(int, word)) for word in FIVE.split()}


def test_several_names(tmp_path: Path) -> None:
    """Three patterns are the same tetrahedra with other facets marked."""
    certificate = json.loads((CHECKOUT / "certificates" / "15_A.json").read_text())
    path = tmp_path / "new.json"
    path.write_text(json.dumps(certificate["tetrahedra"]))
    code, out, _ = run(CHECKOUT, "name", str(path))
    assert code == 0
    names = [line.split(",")[0] for line in out.splitlines() if ", with the facets" in line]
    assert names == ["15_A", "15_B", "15_J"]
    marked = {"tetrahedra": certificate["tetrahedra"]}
    marked["facets"] = ["1234", "1265", "1485", "2376", "3487", "5678"]
    path.write_text(json.dumps(marked))
    assert run(CHECKOUT, "name", str(path))[1].startswith("15_A, ")
    assert run(CHECKOUT, "name", str(path))[1].count("facets") == 1


def test_no_name(tmp_path: Path) -> None:
    path = tmp_path / "new.txt"
    path.write_text(FIVE[:-5])
    assert_rejects(run(CHECKOUT, "name", str(path)), "new.txt", "7 vertices")


def test_the_library_is_what_the_command_is(cube: Path) -> None:
    import certify.mesh  # noqa: PLC0415

    _, found = run_json(CHECKOUT, "triangulate", str(cube))
    columns = np.flatnonzero(certify.mesh.triangulations([CUBE])[0])
    own = [["".join(map(str, t)) for t in certify.mesh.labelled()[k].tetrahedra] for k in columns]
    assert [row["tetrahedra"] for row in found["triangulations"]] == own
