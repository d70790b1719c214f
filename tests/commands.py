"""Run commands on a small root: what tests of the command line share."""

import json
import os
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest
from click.testing import CliRunner

from certify.cli import cli
from certify.kernel.certificate import QUESTIONS
from certify.kernel.hexahedron import CORNERS

CHECKOUT = Path(__file__).resolve().parents[1]

Outcome = tuple[int, str, str]


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


def to_nothing(path: Path) -> None:
    path.symlink_to("nothing")


def to_itself(path: Path) -> None:
    path.symlink_to(path.name)


def nothing(_: Path) -> None:
    """Leave the place empty."""


needs_scripts = pytest.mark.skipif(os.name != "posix", reason="the program is a shell script")


def stand_in(path: Path, commands: str) -> None:
    """Write a program that does what these shell commands do."""
    path.write_text(f"#!/bin/sh\n{commands}\n")
    path.chmod(0o755)
