"""The library: its examples, its errors, and that importing it is cheap."""

import doctest
import subprocess
import sys
from concurrent.futures.process import BrokenProcessPool
from fractions import Fraction
from itertools import repeat
from pathlib import Path
from typing import Any, NoReturn

import numpy as np
import pytest

import certify
from certify import api, processes
from certify.kernel.certificate import PATTERN_NAMES
from certify.kernel.hexahedron import CORNERS
from tests.commands import five_a, write

CUBE = list(CORNERS.values())


@pytest.mark.parametrize("module", [certify, api])
def test_examples(module: Any) -> None:
    failed, tried = doctest.testmod(module)
    assert failed == 0
    assert tried > 0


def test_importing_imports_nothing_else() -> None:
    code = "import sys; old = set(sys.modules); import certify; print(*set(sys.modules) - old)"
    result = subprocess.run(
        [sys.executable, "-c", code], capture_output=True, text=True, check=True
    )
    tops = {name.partition(".")[0] for name in result.stdout.split()}
    assert tops <= {"certify", *sys.stdlib_module_names}
    assert "certify." not in result.stdout


def test_names() -> None:
    assert certify.__all__ == api.__all__
    assert set(certify.__all__) < set(dir(certify))
    assert certify.check is api.check
    with pytest.raises(AttributeError, match="no attribute 'chekc'"):
        certify.chekc  # noqa: B018


def test_load_is_what_is_stored() -> None:
    fifteen = certify.load("15_A")
    assert (fifteen.name, len(fifteen.tetrahedra), fifteen.boundary) == ("15_A", 15, "g")
    assert fifteen.answers == dict.fromkeys(("realizable", "convex", "valid"), "no")
    assert fifteen.points() is None
    proof = fifteen.proof("realizable")
    assert proof is not None
    assert proof.endswith(" 0\n")
    eight = certify.load("8_E")
    assert eight.proof() is None
    points = eight.points("valid")
    assert points is not None
    certify.require("8_E", "valid", points)


def test_what_is_printed_is_short() -> None:
    assert repr(certify.load("8_E")).startswith("<Pattern 8_E below ")
    assert len(repr(certify.check("8_E"))) < 200


def test_patterns_are_all() -> None:
    assert certify.patterns() == PATTERN_NAMES


def test_check_of_another_root(root: Path) -> None:
    write(root, five_a() | {"boundary": "b"})
    assert certify.check("5_A", root).fault == (
        "certificates/5_A.json: boundary: stated b, but it is a"
    )
    assert certify.check("15_A", str(root)).fault is None
    assert not certify.check_all(root=root).ok
    with pytest.raises(certify.Malformed, match="is missing, or is not a regular file"):
        certify.load("6_A", root)
    with pytest.raises(certify.Malformed, match="boundary: stated b"):
        certify.require("5_A", "valid", CUBE, root)


@pytest.mark.parametrize(
    ("call", "message"),
    [
        (lambda: certify.check("5_Z"), "unknown pattern '5_Z'"),
        (lambda: certify.load("../5_A"), "unknown pattern"),
        (lambda: certify.load("5_A").points("nice"), "unknown question 'nice'"),
        (lambda: certify.load("5_A").proof("nice"), "must be one of realizable, convex, valid"),
        (lambda: certify.require("5_A", "nice", CUBE), "unknown question 'nice'"),
        (lambda: certify.check_all(jobs=0), "jobs is 0, but it must be a positive integer"),
        (lambda: certify.check_all(jobs="2"), "jobs is '2'"),  # type: ignore[arg-type]
        (lambda: certify.check("5_A", root="/nowhere"), "/nowhere has no folder certificates"),
        (lambda: certify.check_all(root="/nowhere"), "/nowhere has no folder certificates"),
        (lambda: certify.require("5_A", "valid", None), "the points: None is not a list"),  # type: ignore[arg-type]
        (lambda: certify.replay([1, 2], ""), "clause 1: 1 is not a list"),  # type: ignore[list-item]
        (lambda: certify.replay([], b""), "the proof is a bytes, not a text"),  # type: ignore[arg-type]
        (lambda: certify.replay([(1, 0)], ""), r"clause 1 is \(1, 0\), not some non-zero integers"),
        (lambda: certify.replay([(1,), (True,)], ""), "clause 2 is"),
        (lambda: certify.replay([b"\1\2"], ""), "clause 1: b.* is not a list"),
        (lambda: certify.replay(repeat((1,)), ""), "the formula: there are more than 10000000"),
        (lambda: certify.replay([repeat(1)], ""), "clause 1: there are more than 10000000"),
        (lambda: certify.replay(None, ""), "the formula: None is not a list"),  # type: ignore[arg-type]
        (lambda: certify.check("x" * 10**7), "unknown pattern 'x{79}; certify"),
        (lambda: certify.check("5_A", root="x" * 5000), "x{79} cannot be used: File name too long"),
        (lambda: certify.check_all(root="x" * 5000), "x{79} cannot be used: File name too long"),
        (lambda: certify.check("5_A").rests_on("nice"), "no answer to 'nice' was accepted"),
        (lambda: certify.check_all(jobs=True), "jobs is True, but it must be a positive integer"),
    ],
)
def test_wrong_arguments(call: Any, message: str) -> None:
    with pytest.raises(ValueError, match=message):
        call()


@pytest.mark.parametrize(
    ("points", "message"),
    [
        (CUBE[:7], "there are 7 points instead of eight"),
        (repeat((0, 0, 0)), "the points: there are more than 8"),
        ([repeat(0)] * 8, "vertex 1: there are more than 3"),
        (b"12345678", "the points: b.* is not a list"),
        ([*CUBE[:7], b"\0\1\1"], "vertex 8: b.* is not a list"),
        ([*CUBE[:7], (0, 1, "9" * 81)], "vertex 8: .* is not exact; .* of at most 80 characters"),
        ([*CUBE[:7], (0, 1, "9" * 10**7)], "vertex 8: '9{79} is not exact"),
        ([*CUBE, (0, 0, 0)], "the points: there are more than 8"),
        ([*CUBE[:7], (0, 1)], "vertex 8 has 2 coordinates instead of three"),
        ([*CUBE[:7], 5], "vertex 8: 5 is not a list"),
        ([*CUBE[:7], "011"], "vertex 8: '011' is not a list"),
        *(
            ([*CUBE[:7], (0, 1, x)], "vertex 8: .* is not exact; give an integer, a Fraction")
            for x in (1.0, float("nan"), float("inf"), True, None, "1e9", "1/0", "one", [1], 1j)
        ),
    ],
)
def test_wrong_points(points: Any, message: str) -> None:
    with pytest.raises(ValueError, match=message):
        certify.require("5_A", "realizable", points)


@pytest.mark.parametrize(
    "points",
    [
        CUBE,
        np.array(CUBE),
        [[Fraction(int(x), 3) for x in corner] for corner in CUBE],
        [[f"{x}/2" for x in corner] for corner in CUBE],
        [[f"{x * 10**30}" for x in corner] for corner in CUBE],
        (tuple(map(np.int8, corner)) for corner in CUBE),
    ],
)
def test_exact_points_of_all_kinds(points: Any) -> None:
    certify.require("5_A", "valid", points)


def test_rests_on_of_what_is_not_accepted(root: Path) -> None:
    write(root, five_a() | {"valid": {"answer": "open"}})
    with pytest.raises(ValueError, match="no answer to 'valid' was accepted"):
        certify.check("5_A", root).rests_on("valid")


def test_no_more_processes_than_every_system_allows(
    root: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    asked = []

    def pool(jobs: int, **_: Any) -> NoReturn:
        asked.append(jobs)
        raise BrokenProcessPool

    monkeypatch.setattr(processes, "ProcessPoolExecutor", pool)
    with pytest.raises(ChildProcessError, match="was killed"):
        certify.check_all(root=root, jobs=10**9)
    assert asked == [61]


def test_points_that_do_not_show_it() -> None:
    with pytest.raises(certify.NotRealized, match="tetrahedron 1236 is degenerate"):
        certify.require("5_A", "realizable", [(0, 0, 0), (0, 0, 0), *CUBE[2:]])
    dented = [
        (1, 1, 1),
        (3, 2, 0),
        (1, 3, 2),
        (0, 3, 2),
        (0, 1, 3),
        (2, 0, 1),
        (3, 3, 4),
        (0, 4, 3),
    ]
    certify.require("5_A", "realizable", dented)
    with pytest.raises(certify.NotRealized, match="vertex 3 is not an extreme point of the hull"):
        certify.require("5_A", "convex", dented)


def test_replay() -> None:
    square = [(1, 2), (-1, 2), (1, -2), (-1, -2)]
    assert certify.replay(square, "5 2 0 1 2 0\n6 0 5 3 4 0\n") == 2
    assert certify.replay(np.array(square), "5 2 0 1 2 0\n6 0 5 3 4 0\n") == 2
    with pytest.raises(certify.NotRefuted, match="line 1: there is no clause 9"):
        certify.replay(square, "5 2 0 9 0\n")
