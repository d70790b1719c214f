"""Programs of other people that check a clausal proof, and what each prints if it accepts one.

Nothing here checks anything: a formula and a proof are written to files, a program is run, and its
output is read. docs/outside-checkers.md says what each of the programs believes.
"""

import re
import shutil
import subprocess
from collections.abc import Callable
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import NamedTuple

from certify.printable import printable

SECONDS = 600
"""A program that takes longer for one proof has not answered."""


class Program(NamedTuple):
    """A program on the PATH that is called with a formula, a proof and options."""

    form: str
    """The suffix of the proofs that it reads."""
    accepts: str
    """The line that it prints, on standard output, if it accepts the proof."""
    code: int
    """Its exit code then."""
    rejects: tuple[str, ...]
    """How the lines begin in which it says that the proof is wrong."""
    options: tuple[str, ...] = ()
    prepared: Callable[[str, str], str] = lambda _, proof: proof
    """Makes of formula and proof what the program gets as the proof."""


def with_a_goal(formula: str, proof: str) -> str:
    """Return an LRAT proof that adds a literal of its own before it adds the empty clause.

    For lrat-check, which does not ask whether the hints of an empty clause end in a contradiction.
    It does ask if the clause has literals, unless the negative of the first occurs in no clause:
    then nothing can contradict that literal, and it may be added. So let z be a variable that
    occurs nowhere. The new proof adds -z, for that reason; then z, by the hints for the empty
    clause, which now have to end in a contradiction; and then the empty clause.
    """
    z = 1 + max(map(int, re.findall(r"\d+", formula + proof)))
    steps = []
    for step in proof.splitlines():
        number, _, rest = step.partition(" ")
        if rest.startswith("0 "):
            n, hints = int(number), rest[2:]
            steps += [f"{n} -{z} 0 0", f"{n + 1} {z} 0 {hints}", f"{n + 2} 0 {n} {n + 1} 0"]
            break
        steps.append(step)
    return "".join(f"{step}\n" for step in steps)


PROGRAMS = {
    "drat-trim": Program("drat", "s VERIFIED", 0, ("s NOT VERIFIED",), ("-U", "-W")),
    "lrat-check": Program("lrat", "c VERIFIED", 0, ("c NOT VERIFIED",), prepared=with_a_goal),
    "lrat-trim": Program(
        "lrat", "s VERIFIED", 20, ("c no empty clause", "lrat-trim: antecedent", "lrat-trim: prop")
    ),
    "cake_lpr": Program(
        "lrat", "s VERIFIED UNSAT", 0, ("c empty clause not derived", "c Checking failed at line")
    ),
}
"""Checkers, looked for on the PATH. The options: no RAT steps, and no going on after a warning."""


def fault(name: str, formula: str, proof: str) -> str | None:
    """Hand formula and proof to a program; return None if it accepts, otherwise what it says.

    The formula is DIMACS text, the proof text in the form that the program reads.
    """
    program = PROGRAMS[name]
    with TemporaryDirectory(prefix="certify-") as folder:
        files = {"core.cnf": formula, f"core.{program.form}": program.prepared(formula, proof)}
        for file, text in files.items():
            Path(folder, file).write_bytes(text.encode("ascii"))
        command = [str(Path(shutil.which(name) or name).absolute()), *files, *program.options]
        try:
            done = subprocess.run(
                command,
                cwd=folder,
                stdin=subprocess.DEVNULL,
                capture_output=True,
                timeout=SECONDS,
                check=False,
            )
        except subprocess.TimeoutExpired:
            return f"did not answer in {SECONDS} seconds"
        except OSError as error:
            return f"did not answer: {printable(str(error))}"
    out, err = (stream.decode("ascii", "replace") for stream in (done.stdout, done.stderr))
    return judged(program, done.returncode, out, err)


def judged(program: Program, code: int, out: str, err: str) -> str | None:
    """Return None if this exit code and output accept the proof, otherwise what they say.

    Of the lines with the word VERIFIED there must be one, word for word the right one.
    """
    said = [line.strip() for line in out.splitlines()]
    if [line for line in said if "VERIFIED" in line] == [program.accepts] and code == program.code:
        return None
    lines = [line for line in (*said, *map(str.strip, err.splitlines())) if line]
    rejections = [line for line in lines if line.startswith(program.rejects)]
    if rejections:
        return f"rejects the proof: {printable(rejections[0])}"
    last = printable(lines[-1]) if lines else "no output"
    return f"did not answer: exit code {code}, {last}"
