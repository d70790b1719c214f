"""The kernel is mutated in tests/mutation/; here is what keeps its list of survivors honest."""

import ast
import json
import os
import signal
import subprocess
import sys
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from textwrap import dedent
from typing import Any

import pytest

from certify.kernel.evidence import kernel_digest
from tests.commands import CHECKOUT
from tests.mutation.operators import Mutant, Source
from tests.mutation.session import KILLED, SURVIVED, TIMED_OUT, in_copies
from tests.mutation.survivors import RECORD, all_sources, listed

MUTANTS = [mutant for source in all_sources() for mutant in source.mutants]


def source_of(folder: Path, text: str) -> Source:
    path = folder / "module.py"
    path.write_text(dedent(text))
    return Source(path)


def changes(folder: Path, text: str) -> list[str]:
    """Return how a module is changed, without the places."""
    return [mutant.key.split(" | ")[2] for mutant in source_of(folder, text).mutants]


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("x < y", ["< becomes <=", "< becomes >="]),
        ("x == y", ["== becomes !=", "== becomes <=", "== becomes >="]),
        ("x != 'a'", ["!= becomes ==", "'a' becomes another text", "'a' becomes empty"]),
        (
            "w <= x is y",
            [
                "<= 1 becomes <",
                "<= 1 becomes >",
                "is 2 becomes is not",
                "without the first of the chain",
                "without the last of the chain",
            ],
        ),
        (
            "x and not y",
            [
                "and becomes or",
                "without operand 1 of and",
                "without operand 2 of and",
                "without not",
            ],
        ),
        ("-x * y", ["* becomes +", "* becomes //", "without minus"]),
        ("x[3:]", ["slice without lower", "3 becomes 4", "3 becomes 2"]),
        ("[x for x in y if x]", ["over nothing", "without filter"]),
        ("f(True, key=x)", ["deleted", "without key=", "True becomes False"]),
        (
            "min('a')",
            ["deleted", "min becomes max", "'a' becomes another text", "'a' becomes empty"],
        ),
        ("(x, *y)", ["without element 1", "without element 2"]),
        ("{x: y}", ["without item 1"]),
        ("x = y", ["deleted"]),
        ("x += y", ["+= becomes -=", "deleted"]),
        ("if x: y", ["condition becomes True", "condition becomes False"]),
        ("while x: y", ["loop never entered"]),
        ("for x in y: break", ["loop over nothing", "break becomes continue"]),
        ("raise X(f(1))", ["deleted", "raises no X"]),
        (
            "try: x\nexcept (Y, Z): w",
            ["without handler", "without element 1", "without element 2"],
        ),
        ("def f():\n  return x", ["returns None"]),
        ("def f():\n  yield x", ["deleted"]),
    ],
)
def test_mutants(tmp_path: Path, text: str, expected: list[str]) -> None:
    assert sorted(changes(tmp_path, text)) == sorted(expected)


@pytest.mark.parametrize(
    "text",
    [
        '"""Text."""',
        "import x",
        "T = TypeVar('T', bound=int)",
        "X: TypeAlias = Y | Z",
        "@lru_cache(maxsize=1)\ndef f(x: 'Y' = y) -> 'Z':\n  'Text.'",
        "f'{x + 1}'",
    ],
)
def test_what_changes_no_verdict_is_left_alone(tmp_path: Path, text: str) -> None:
    assert changes(tmp_path, text) == []


def test_a_mutant_is_compiled_with_one_change(tmp_path: Path) -> None:
    source = source_of(tmp_path, "x = 1\ny = x + 2\n")
    found = []
    for mutant in source.mutants:
        if "deleted" not in mutant.key:
            values: dict[str, int] = {}
            exec(mutant.compile(), values)
            found.append((values["x"], values["y"]))
    assert found == [(2, 4), (0, 2), (1, -1), (1, 4), (1, 2)]


def test_keys_name_the_place(tmp_path: Path) -> None:
    text = """
        A = 1

        class C:
            def f(self, x=2):
                return 3 + 3
    """
    source = source_of(tmp_path, text)
    keys = {mutant.key: mutant.unit for mutant in source.mutants}
    assert keys["module | A = 1 | 1 becomes 2"] is None
    assert keys["module.C.f | def f(self, x=2): | 2 becomes 3"] is None
    assert keys["module.C.f | return 3 + 3 | 3 becomes 4"] == 5
    assert keys["module.C.f | return 3 + 3 | 3 becomes 4 #2"] == 5


def test_every_mutant_of_the_kernel_has_its_own_key() -> None:
    assert len({mutant.key for mutant in MUTANTS}) == len(MUTANTS) > 1000


def test_every_mutant_of_the_kernel_is_changed() -> None:
    for mutant in MUTANTS:
        parent, field, index = mutant.place
        old = getattr(parent, field) if index is None else getattr(parent, field)[index]
        assert ast.dump(old) != ast.dump(mutant.new), mutant.key


# Trying them.


@dataclass(frozen=True)
class Fake:
    """A mutant that is asked nothing."""

    behave: Callable[[], int]


def survive() -> int:
    return SURVIVED


def fail() -> int:
    return KILLED


def break_off() -> int:
    raise ArithmeticError


def run_forever() -> int:
    signal.setitimer(signal.ITIMER_VIRTUAL, 0.01)
    while True:
        pass


def fall() -> int:
    os.kill(os.getpid(), signal.SIGSEGV)
    return SURVIVED


@pytest.mark.parametrize("jobs", [1, 3])
def test_how_a_mutant_fares(jobs: int) -> None:
    expected = {survive: SURVIVED, fail: KILLED, run_forever: TIMED_OUT, fall: KILLED}

    def attempt(mutant: Mutant, _: Path) -> int:
        assert isinstance(mutant, Fake)
        return mutant.behave()

    fakes: list[Any] = [Fake(behave) for behave in expected]
    trials = in_copies(jobs, fakes, attempt)
    found = {fakes.index(mutant): trial.outcome for mutant, trial in trials}
    assert found == dict(enumerate(expected.values()))


def test_a_mutant_that_was_not_tried_is_not_killed() -> None:
    with pytest.raises(RuntimeError, match="a process ended with 3"):
        list(in_copies(1, MUTANTS[:1], lambda _, __: break_off()))


@pytest.mark.slow
def test_some_mutants_are_killed() -> None:
    """All are tried by ``python -m tests.mutation``; which ones here depends on the kernel."""
    command = [sys.executable, "-m", "tests.mutation", "--sample", "4"]
    result = subprocess.run(command, cwd=CHECKOUT, capture_output=True, text=True, check=False)
    assert result.returncode == 0, result.stdout


# The list of survivors.


def test_every_survivor_is_a_mutant() -> None:
    assert listed().keys() <= {mutant.key for mutant in MUTANTS}


def test_every_survivor_has_a_reason() -> None:
    for reason in listed().values():
        assert len(reason.split()) > 3
        assert reason.endswith(".")


def test_the_score_is_of_this_kernel() -> None:
    """If not: run ``python -m tests.mutation --jobs 2 --record``."""
    record = json.loads(RECORD.read_bytes())
    total, *killed, survived = record["figures"].values()
    assert record["kernel_sha256"] == kernel_digest()
    assert total == len(MUTANTS) == sum(killed) + survived
    assert survived == len(listed())
