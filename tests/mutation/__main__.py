"""Try every mutant of the kernel against the tests: ``python -m tests.mutation --jobs 2``.

A mutant is killed if a test fails, or runs far longer than it does with the unchanged kernel. One
that survives must be listed in survivors.toml, with the reason why it changes no verdict; what is
listed is tried only with --listed, and must then survive. Exit code 0: it is so; 1: it is not.
"""

import argparse
import json
import os
import sys
import time
from collections import Counter, defaultdict
from collections.abc import Callable, Iterable, Iterator, Sequence
from contextlib import suppress
from dataclasses import asdict
from functools import partial
from hashlib import sha256
from importlib import import_module
from pathlib import Path
from random import Random
from tempfile import TemporaryDirectory

from tests.mutation.operators import Mutant, Source
from tests.mutation.session import (
    KILLED,
    SURVIVED,
    TIMED_OUT,
    Cold,
    Cost,
    Trial,
    Warm,
    alone,
    in_copies,
    read_costs,
    write_costs,
)
from tests.mutation.survivors import RECORD, all_sources, listed

PATIENCE = 0.1
"""What the tests that a mutant has to survive may cost, as a share of the whole suite."""
WHOLE = 1.0
"""The same for a mutant that survived and is not listed: it has to survive every test."""


class Results:
    """How mutants fared, kept in a folder, so that a run can be resumed.

    What was killed stays so while its module is unchanged: tests are added, not taken away. In the
    same way, what tests cost and call is measured once as long as the kernel is the same.
    """

    def __init__(self, folder: Path, sources: Iterable[Source]) -> None:
        folder.mkdir(exist_ok=True)
        self._path = folder / "trials"
        self._digests = {
            source.module: sha256(Path(source.path).read_bytes()).hexdigest() for source in sources
        }
        kernel = sha256("".join(self._digests.values()).encode()).hexdigest()
        self.costs = folder / f"costs-{kernel[:16]}.json"
        self.trials: dict[str, Trial] = {}
        self._killers: defaultdict[tuple[str, int | None], dict[str, None]] = defaultdict(dict)
        self.load()

    def load(self) -> None:
        """Read what is in the folder; another process may have written it."""
        for line in self._path.read_text().splitlines() if self._path.exists() else ():
            record = json.loads(line)
            if record["source"] in self._digests.values():
                self.trials[record["mutant"]] = Trial(record["outcome"], record["by"])

    def outcome(self, mutant: Mutant) -> int:
        """Return how the mutant fared; what was not tried survived."""
        trial = self.trials.get(mutant.key)
        return trial.outcome if trial else SURVIVED

    def add(self, mutant: Mutant, trial: Trial) -> None:
        self.trials[mutant.key] = trial
        record = {"mutant": mutant.key, "source": self._digests[mutant.module], **asdict(trial)}
        if trial.outcome != SURVIVED:
            killers = self._killers[mutant.module, mutant.unit]
            killers.pop(trial.by, None)
            killers[trial.by] = None
        with self._path.open("a") as file:
            file.write(json.dumps(record) + "\n")

    def killers(self, mutant: Mutant) -> list[str]:
        """Return the tests that killed mutants of the same function, the last one first."""
        return [*reversed(self._killers[mutant.module, mutant.unit])]

    def follow(self, trials: Iterator[tuple[Mutant, Trial]], total: int, what: str) -> None:
        """Keep what comes, and show a live line with the rate."""
        start = time.monotonic()
        survived = 0
        for done, (mutant, trial) in enumerate(trials, start=1):
            self.add(mutant, trial)
            if trial.outcome == SURVIVED:
                survived += 1
                sys.stderr.write(f"\rsurvived: {mutant.key}\n")
            rate = done / (time.monotonic() - start)
            line = f"{what}: {done} of {total}, {survived} survived, {rate:.1f} a second"
            sys.stderr.write(f"\r{line} ")
        sys.stderr.write("\n")


def try_all(
    mutants: Sequence[Mutant], sources: list[Source], results: Results, jobs: int, patience: float
) -> None:
    """Try mutants: first, in a process that has imported the kernel, those of functions."""
    unchanged = next(s for s in sources if s.module == "triangulation").unchanged
    with TemporaryDirectory() as scratch:
        notes = Path(scratch) / "notes"
        child = os.fork()
        if child == 0:
            try:
                use = partial(try_warm, mutants, unchanged, results, jobs, patience, notes)
                Warm(sources, use).start()
            finally:
                os._exit(0)
        os.waitpid(child, 0)
        if not notes.exists():
            raise SystemExit("the tests do not pass with the unchanged kernel")
        results.load()
        early, modules = json.loads(notes.read_text())
    for name in modules:  # what the tests import, so that each copy need not
        with suppress(Exception):
            import_module(name)
    costs = read_costs(results.costs)
    rest = [m for m in mutants if m.unit is None or [m.module, m.unit] in early]

    def attempt(mutant: Mutant, folder: Path) -> int:
        return Cold(costs, budget(costs, patience), results.killers, mutant, folder).start()

    require_survival(unchanged, attempt)
    results.follow(in_copies(jobs, rest, attempt), len(rest), "on import")


def try_warm(
    mutants: Sequence[Mutant],
    unchanged: Mutant,
    results: Results,
    jobs: int,
    patience: float,
    notes: Path,
    plugin: Warm,
) -> None:
    """Measure the unchanged kernel, and try mutants of the functions that are not called early."""

    def measure(_: Path) -> int:
        write_costs(results.costs, plugin.measure())
        return SURVIVED

    if not results.costs.exists():
        alone(measure)
    costs = read_costs(results.costs)
    attempt = partial(plugin.try_mutant, costs, budget(costs, patience), results.killers)
    require_survival(unchanged, attempt)
    ours = ("certify", "tests", "__main__")
    modules = [name for name in sys.modules if name.partition(".")[0] not in ours]
    notes.write_text(json.dumps([sorted(plugin.early), modules]))
    late = [m for m in mutants if m.unit is not None and (m.module, m.unit) not in plugin.early]
    results.follow(in_copies(jobs, late, attempt), len(late), "when called")


def require_survival(unchanged: Mutant, attempt: Callable[[Mutant, Path], int]) -> None:
    """End the program if what is no mutant is killed."""
    for _, trial in in_copies(1, [unchanged], attempt):
        if trial.outcome != SURVIVED:
            raise SystemExit(f"the unchanged kernel does not pass {trial.by}")


def budget(costs: dict[str, Cost], patience: float) -> float:
    """Return what tests may cost that are worth this share of the suite, in seconds."""
    return patience * sum(cost.own for cost in costs.values())


def parse() -> argparse.Namespace:
    parser = argparse.ArgumentParser(prog="python -m tests.mutation", description=__doc__)
    parser.add_argument("--jobs", type=int, default=1, help="how many to try at a time")
    parser.add_argument("--only", nargs="+", metavar="MODULE", help="of these modules alone")
    parser.add_argument("--sample", type=int, metavar="N", help="only N, which the kernel decides")
    parser.add_argument("--listed", action="store_true", help="those too that are listed")
    parser.add_argument(
        "--patience", type=float, default=PATIENCE, help="share of the suite to run"
    )
    parser.add_argument(
        "--results", type=Path, metavar="FOLDER", help="keep them, and go on from there"
    )
    parser.add_argument("--record", action="store_true", help="keep the score for certify trust")
    return parser.parse_args()


def chosen(
    sources: Iterable[Source], results: Results, options: argparse.Namespace
) -> list[Mutant]:
    """Return the mutants to try."""
    mutants = [mutant for source in sources for mutant in source.mutants]
    if options.only:
        mutants = [mutant for mutant in mutants if mutant.module in options.only]
    if not options.listed:
        known = listed()
        mutants = [mutant for mutant in mutants if mutant.key not in known]
    if options.sample:
        seed = "".join(Path(source.path).read_text(encoding="utf-8") for source in sources)
        mutants = Random(seed).sample(mutants, options.sample)
    return [mutant for mutant in mutants if results.outcome(mutant) == SURVIVED]


def unlisted(mutants: Iterable[Mutant], results: Results) -> list[Mutant]:
    """Return the mutants that survived although no reason for it is listed."""
    known = listed()
    return [m for m in mutants if results.outcome(m) == SURVIVED and m.key not in known]


def score(sources: Iterable[Source], results: Results) -> dict[str, object]:
    """Return how many mutants there are, and how many of them were killed or survived."""
    from certify.kernel.evidence import kernel_digest  # noqa: PLC0415 (not before the last mutant)

    mutants = [mutant for source in sources for mutant in source.mutants]
    outcomes = Counter(results.outcome(mutant) for mutant in mutants)
    return {
        "kernel_sha256": kernel_digest(),
        "figures": {
            "mutants": len(mutants),
            "killed by a test": outcomes[KILLED],
            "killed by the limit of time": outcomes[TIMED_OUT],
            "survived, each with its reason": outcomes[SURVIVED],
        },
    }


def report(mutants: Iterable[Mutant], results: Results) -> int:
    """Print what is wrong, and what was found of these mutants; return the exit code."""
    known = listed()
    outcomes: Counter[str] = Counter()
    wrong = 0
    for mutant in mutants:
        survived = results.outcome(mutant) == SURVIVED
        if survived != (mutant.key in known):
            wrong += 1
            print(f"{'not listed' if survived else 'listed, but killed'}: {mutant.key}")
        outcomes["killed by a test"] += results.outcome(mutant) == KILLED
        outcomes["killed by the limit of time"] += results.outcome(mutant) == TIMED_OUT
        outcomes["survived, as listed"] += survived and mutant.key in known
        outcomes["survived, not listed"] += survived and mutant.key not in known
    for what, count in outcomes.items():
        print(f"{count:6} {what}")
    print(f"{outcomes.total():6} mutants")
    return 1 if wrong else 0


def main() -> int:
    options = parse()
    sources = all_sources()
    with TemporaryDirectory() as scratch:
        results = Results(options.results or Path(scratch), sources)
        mutants = chosen(sources, results, options)
        try_all(mutants, sources, results, options.jobs, options.patience)
        doubted = unlisted(mutants, results)
        if doubted and options.patience < WHOLE:  # a busy machine may have used up the patience
            try_all(doubted, sources, results, options.jobs, WHOLE)
    whole = not (options.only or options.sample)
    of_all = [mutant for source in sources for mutant in source.mutants]
    code = report(of_all if whole else mutants, results)
    if options.record and whole and code == 0:
        RECORD.write_text(json.dumps(score(sources, results), indent=2) + "\n", encoding="utf-8")
    return code


if __name__ == "__main__":
    try:
        sys.exit(main())
    except KeyboardInterrupt:
        sys.exit(130)
