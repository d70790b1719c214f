"""What is found of hexahedra agrees with the kernel, with direct evaluation, and with itself."""

import csv
import json
import math
from fractions import Fraction
from itertools import combinations
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from certify.kernel.certificate import QUESTIONS, Certificate, Yes
from certify.kernel.embedding import NotRealized
from certify.kernel.evidence import default_root
from certify.kernel.hexahedron import BOUNDARIES, CORNERS, boundary_letter
from certify.kernel.jacobian import require_positive_jacobian
from certify.mesh.hexahedra import VALID, Hexahedra
from certify.mesh.records import COLUMNS, Summary, boundaries_with, record, rows, write_table
from certify.mesh.shapes import least_dihedral_angles, mean_ratios, scaled_jacobians
from certify.paper import size

ROOT = default_root()
CUBE = np.array([*CORNERS.values()], float)
ALL = boundaries_with([])


def hexahedra(*points: Any) -> Hexahedra:
    return Hexahedra(np.array(points), ROOT)


def silent(_what: str, _done: int, _total: int) -> None:
    pass


# Figures.


def regular(edge: float) -> list[tuple[float, ...]]:
    return [(0, 0, 0), (edge, edge, 0), (edge, 0, edge), (0, edge, edge)]


@pytest.mark.parametrize("edge", [1e-9, 1.0, 1e9])
def test_figures_of_the_regular_tetrahedron(edge: float) -> None:
    points = np.array([regular(edge)])
    assert least_dihedral_angles(points)[0] == pytest.approx(math.degrees(math.acos(1 / 3)))
    assert mean_ratios(points)[0] == pytest.approx(1)


def test_figures_of_the_corner_of_a_cube() -> None:
    """Three angles are right; the other three have the tangent root 2."""
    points = CUBE[None, [0, 1, 3, 4]]
    assert least_dihedral_angles(points)[0] == pytest.approx(math.degrees(math.atan(2**0.5)))
    assert mean_ratios(points)[0] == pytest.approx(12 * 0.5 ** (2 / 3) / 9)


@pytest.mark.parametrize("flat", [[0, 1, 2, 3], [0, 1, 2, 2], [0, 0, 0, 0]])
def test_figures_of_flat_tetrahedra(flat: list[int]) -> None:
    points = CUBE[None, flat]
    assert least_dihedral_angles(points)[0] == pytest.approx(0, abs=1e-6)
    assert mean_ratios(points)[0] == pytest.approx(0, abs=1e-9)


def test_least_dihedral_angles_are_those_of_the_faces() -> None:
    """The angle at an edge is that between the heights above it of the two other vertices."""
    for points in np.random.default_rng(1).normal(size=(200, 4, 3)):
        angles = []
        for i, j in combinations(range(4), 2):
            along = (points[j] - points[i]) / np.linalg.norm(points[j] - points[i])
            heights = [points[k] - points[i] for k in range(4) if k not in (i, j)]
            a, b = (h - along * (h @ along) for h in heights)
            angles.append(math.degrees(math.acos(a @ b / np.linalg.norm(a) / np.linalg.norm(b))))
        assert least_dihedral_angles(points[None])[0] == pytest.approx(min(angles))


def test_scaled_jacobians_of_cubes() -> None:
    assert scaled_jacobians(np.array([CUBE, 1e5 * CUBE])).tolist() == [[1.0] * 8] * 2
    assert scaled_jacobians(np.array([CUBE * [1, 1, -1]])).tolist() == [[-1.0] * 8]
    assert scaled_jacobians(np.zeros((1, 8, 3))).tolist() == [[0.0] * 8]


# What is found of a hexahedron.


def test_the_cube() -> None:
    found = record(hexahedra(CUBE), 0, "cube")
    assert found["realized"] == len(found["triangulations"]) == 74
    assert {own["pattern"]: own["realized"] for own in found["patterns"]} == {
        "5_A": 2, "6_A": 24, "6_B": 4, "6_C": 24, "6_D": 12, "6_E": 8,
    }  # fmt: skip
    assert found["valid"] == "yes"
    assert found["jacobian"] == {"at_least": "1", "at_most": "1"}
    assert found["patterns"][0]["least_dihedral"] == pytest.approx(54.735610)
    assert len(found["boundaries"]["filled"]) == 46
    assert not found["boundaries"]["with_boundary_tetrahedra"]
    assert len(found["boundaries"]["impossible"]) == 18


def test_a_mirrored_cube() -> None:
    found, mirrored = (record(hexahedra(CUBE * [1, 1, s]), 0, "cube") for s in (1, -1))
    assert mirrored["mirrored"]
    assert mirrored["valid"] == "no"
    assert mirrored["failing_corners"] == [1, 2, 3, 4, 5, 6, 7, 8]
    assert len(mirrored["failing_edges"]) == 12
    for key in ("realized", "patterns", "boundaries", "triangulations"):
        assert mirrored[key] == found[key]


def test_points_without_a_triangulation() -> None:
    found = record(hexahedra(np.zeros((8, 3))), 0, "nothing")
    assert found["realized"] == 0
    assert not found["patterns"]
    assert len(found["boundaries"]["impossible"]) == 64


@pytest.mark.parametrize("question", QUESTIONS)
def test_witnesses_realize_their_pattern(
    certificates: dict[str, Certificate], question: str
) -> None:
    named = [
        (name, answer.points)
        for name, certificate in certificates.items()
        for answer in [certificate.answers[question]]
        if isinstance(answer, Yes)
    ]
    points = np.array([own for _, own in named], object)
    found = Hexahedra(points, ROOT)
    for index, (name, _) in enumerate(named):
        best = {own.instance.pattern: own for own in found.best(index)}
        assert name in best
        letters = {boundary_letter(BOUNDARIES[b]) for b in np.flatnonzero(found.fillable[index])}
        assert boundary_letter(BOUNDARIES[best[name].instance.boundary]) in letters
    if question == "valid":
        assert (found.valid == 1).all()
        assert (found.jacobian_at_least > 0).all()
        assert not found.corners.any()


def test_the_best_is_the_best() -> None:
    moved = CUBE + np.random.default_rng(3).normal(scale=0.2, size=(4, 8, 3))
    found = hexahedra(*moved)
    for index in range(4):
        every = record(found, index, "")["triangulations"]
        for best in found.best(index):
            angles, ratios = [], []
            own = [t["tetrahedra"] for t in every if t["pattern"] == best.instance.pattern]
            for tetrahedra in own:
                places = np.array([[int(v) - 1 for v in word] for word in tetrahedra])
                angles.append(least_dihedral_angles(moved[index][places]).min())
                ratios.append(mean_ratios(moved[index][places]).min())
            assert len(own) == best.realized
            assert best.dihedral == pytest.approx(max(angles))
            assert best.mean_ratio == pytest.approx(ratios[int(np.argmax(angles))])
        names = [best.instance.pattern for best in found.best(index)]
        assert names == sorted(names, key=lambda name: (size(name), name))


@settings(deadline=None)
@given(st.lists(st.lists(st.integers(-2, 4), min_size=3, max_size=3), min_size=8, max_size=8))
def test_validity_is_the_kernels(points: list[list[int]]) -> None:
    found = hexahedra(points)
    try:
        require_positive_jacobian([tuple(map(Fraction, point)) for point in points])
        assert VALID[int(found.valid[0])] == "yes"
    except NotRealized as fault:
        assert VALID[int(found.valid[0])] != "yes"
        if "not shown" not in str(fault):
            assert VALID[int(found.valid[0])] == "no"
    ends = {int(v) for v in np.flatnonzero(found.corners[0]) + 1}
    for edge in found.edges(0):
        ends -= {*edge}
    assert not ends


def test_a_restriction_leaves_the_others_out() -> None:
    diagonals = [(1, 3), (1, 6)]
    wanted = boundaries_with(diagonals)
    assert wanted.sum() == 16
    found = record(Hexahedra(CUBE[None], ROOT, wanted), 0, "cube")
    every = record(hexahedra(CUBE), 0, "cube")
    for key, words in found["boundaries"].items():
        assert words == [w for w in every["boundaries"][key] if w.startswith("13 16")]
    assert 0 < found["realized"] < 74


def test_numbers_of_any_size() -> None:
    """Figures do not overflow, and have no unit."""
    small = [Fraction(1, 10**400), Fraction(10**400)]
    points = np.array([[[s * int(x) for x in p] for p in CUBE.tolist()] for s in small], object)
    found = Hexahedra(points, ROOT)
    for index in range(2):
        told = record(found, index, "")
        assert told["realized"] == 74
        assert told["scaled_jacobians"] == [1.0] * 8
        assert told["patterns"][0]["least_dihedral"] == pytest.approx(54.735610)
    for scale in (1e-300, 1e300):
        assert record(hexahedra(scale * CUBE), 0, "")["realized"] == 74


# Tables.


def some() -> np.ndarray[Any, np.dtype[np.float64]]:
    return np.array([CUBE, CUBE * [1, 1, -1], 0 * CUBE, CUBE + 0.1, 2 * CUBE])


NAMES = ["cube", "mirrored", "nothing", "moved", "larger"]


def some_rows() -> list[dict[str, Any]]:
    return [*rows(some(), NAMES, ROOT, ALL, silent)]


def test_rows_say_what_records_say() -> None:
    found = some_rows()
    assert [row["hexahedron"] for row in found] == NAMES
    for index, row in enumerate(found):
        told = record(hexahedra(*some()), index, NAMES[index])
        assert [*row] == [*COLUMNS]
        for key in ("hexahedron", "valid", "mirrored", "realized"):
            assert row[key] == told[key]
        assert row["patterns"] == len(told["patterns"])
        assert row["filled_boundaries"] == len(told["boundaries"]["filled"])
        assert row["failing_corners"] == "".join(map(str, told["failing_corners"]))
        assert row["jacobian_at_least"] <= Fraction(told["jacobian"]["at_most"])


def test_the_same_rows_in_all_formats(tmp_path: Path) -> None:
    found = some_rows()
    for ending in (".csv", ".json", ".parquet"):
        write_table(tmp_path / f"table{ending}", found)
    assert json.loads((tmp_path / "table.json").read_text()) == found
    parquet = pytest.importorskip("pyarrow.parquet")
    assert parquet.read_table(tmp_path / "table.parquet").to_pylist() == found
    with (tmp_path / "table.csv").open() as file:
        read = [*csv.DictReader(file)]
    words = {True: "yes", False: "no", None: ""}
    for row, want in zip(read, found, strict=True):
        assert row == {
            key: words[value] if value is None or isinstance(value, bool) else str(value)
            for key, value in want.items()
        }


def test_the_worst_are_named() -> None:
    summary = Summary()
    assert [*summary.over(some_rows())] == some_rows()
    told = summary.record()
    assert told["worst"][:2] == ["nothing", "mirrored"]
    assert (told["hexahedra"], told["valid"], told["not_valid"]) == (5, 3, 2)
    assert (told["mirrored"], told["without_triangulation"]) == (1, 1)
    assert told["realized"] == [0, 74]
    assert told["tetrahedra"] == [5, 6]


def test_progress_is_told() -> None:
    heard: list[tuple[str, int, int]] = []
    for _ in rows(some(), NAMES, ROOT, ALL, lambda *own: heard.append(own)):
        pass
    assert heard == [("hexahedra", 5, 5)]
