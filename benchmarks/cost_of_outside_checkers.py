"""What other people's checkers cost, as multiples of the kernel's replay of the same proofs.

    python benchmarks/cost_of_outside_checkers.py [ROUNDS]

All proofs go to each program on the PATH, one process a proof, and to the kernel, and drup if it is
installed, in this process; reading the files counts for all of them. What a program takes for a
formula of four clauses is its start-up, and told apart. The medians over the rounds count. At last
comes a ``check-all --second-opinion``, on two cores, against a ``check-all``.
"""

import shutil
import statistics
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable
from functools import partial
from importlib.util import find_spec
from pathlib import Path

from certify.dimacs import read_dimacs
from certify.export import export_answer, export_completeness
from certify.kernel.certificate import No
from certify.kernel.hexahedron import BOUNDARY_TYPES
from certify.kernel.refutation import replay
from certify.kernel.theorems import Outcome, check_all
from certify.opinions.outside import PROGRAMS, judged

SHIPPED = Path(__file__).resolve().parents[1]
TRIVIAL = {
    "cnf": "p cnf 3 4\n1 2 0\n1 -2 0\n-1 3 0\n-1 -3 0\n",
    "lrat": "5 1 0 1 2 0\n6 0 5 3 4 0\n",
    "drat": "1 0\n0\n",
}

Checker = Callable[[Path], None]
"""Checks the proof next to a formula; it accepts, or there is no use in going on."""


def export_all(outcome: Outcome, folder: Path, core: bool) -> list[Path]:
    """Write every formula that is refuted, with its proofs; return the formulas."""
    for verdict in outcome.verdicts:
        if verdict.certificate:
            for question, answer in verdict.certificate.answers.items():
                if isinstance(answer, No):
                    export_answer(SHIPPED, verdict.certificate, question, folder, core)
    for letter in BOUNDARY_TYPES:
        export_completeness(SHIPPED, outcome, letter, folder, core)
    return prepared(folder)


def prepared(folder: Path) -> list[Path]:
    """Write next to every formula the proof that each program gets; return the formulas."""
    formulas = sorted(folder.glob("*.cnf"))
    for formula in formulas:
        for name, program in PROGRAMS.items():
            proof = formula.with_suffix(f".{program.form}").read_text()
            formula.with_suffix(f".{name}").write_text(program.prepared(formula.read_text(), proof))
    return formulas


def kernel(formula: Path) -> None:
    """Replay the LRAT proof."""
    replay(read_dimacs(formula.read_text()), formula.with_suffix(".lrat").read_text())


def drup(formula: Path) -> None:
    """Let drup check the DRAT proof."""
    import drup  # noqa: PLC0415 - it is optional

    lines = formula.with_suffix(".drat").read_text().splitlines()
    lemmas = [tuple(map(int, line.split()))[:-1] for line in lines]
    result = drup.check_proof(read_dimacs(formula.read_text()), lemmas)
    if result.outcome != drup.Outcome.VALID:
        sys.exit(f"drup: {formula.name}: {result.outcome}")


def outside(name: str, formula: Path) -> None:
    """Let a program check the proof that was prepared for it."""
    program = PROGRAMS[name]
    done = subprocess.run(
        [name, formula, formula.with_suffix(f".{name}"), *program.options],
        capture_output=True,
        text=True,
        check=False,
    )
    if fault := judged(program, done.returncode, done.stdout, done.stderr):
        sys.exit(f"{name}: {formula.name}: {fault}")


def seconds(check: Checker, formulas: list[Path]) -> float:
    """Return how long a checker takes for all formulas."""
    start = time.perf_counter()
    for formula in formulas:
        check(formula)
    return time.perf_counter() - start


def table(title: str, checkers: dict[str, Checker], formulas: list[Path], rounds: int) -> None:
    """Print, for each checker, its work on all formulas and its start-ups, in units of the kernel.

    The start-up is taken as often as there are formulas, so that both are of one kind.
    """
    (folder,) = {formula.parent.parent for formula in formulas}
    trivial = [folder / "trivial" / "tiny.cnf"] * len(formulas)
    times: dict[str, list[tuple[float, float]]] = {name: [] for name in checkers}
    for _ in range(rounds):
        for name, check in checkers.items():
            times[name].append((seconds(check, formulas), seconds(check, trivial)))
    medians = {name: [*map(statistics.median, zip(*t, strict=True))] for name, t in times.items()}
    unit = medians["the kernel"][0] - medians["the kernel"][1]
    print(f"{title:24} {'work':>8} {'start-up':>8}   x the kernel's work, {len(formulas)} proofs")
    for name, (whole, start_up) in medians.items():
        print(f"{name:24} {(whole - start_up) / unit:8.2f} {start_up / unit:8.2f}")
    print(flush=True)


def command(*arguments: str) -> float:
    """Return how long a certify command takes."""
    start = time.perf_counter()
    options = ["--root", str(SHIPPED), "--jobs", "2"]
    subprocess.run(
        [sys.executable, "-m", "certify", *arguments, *options], check=True, capture_output=True
    )
    return time.perf_counter() - start


def main() -> None:
    """Print a table for the cores and one for the whole formulas, and the cost of all opinions."""
    rounds = int(sys.argv[1]) if len(sys.argv) > 1 else 5
    present: dict[str, Checker] = {
        name: partial(outside, name) for name in PROGRAMS if shutil.which(name)
    }
    checkers: dict[str, Checker] = {"the kernel": kernel, **present}
    outcome = check_all(SHIPPED)
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        for title in ("trivial", "core", "whole"):
            (folder / title).mkdir()
        for suffix, text in TRIVIAL.items():
            (folder / "trivial" / f"tiny.{suffix}").write_text(text)
        prepared(folder / "trivial")
        cores = export_all(outcome, folder / "core", core=True)
        table("cores", checkers, cores, rounds)
        table("whole formulas", checkers, export_all(outcome, folder / "whole", False), rounds)
        if find_spec("drup"):
            table("cores, one round", {"the kernel": kernel, "drup": drup}, cores, 1)
    ratio = command("check-all", "--second-opinion") / command("check-all")
    print(f"check-all --second-opinion: {ratio:.0f} x check-all")


if __name__ == "__main__":
    main()
