"""Many forgeries, from a seed: how many of each kind are refused, and which should have been."""

import json
from collections import Counter
from collections.abc import Callable, Iterator
from contextlib import ExitStack, contextmanager
from dataclasses import dataclass
from functools import lru_cache, partial
from pathlib import Path
from typing import Any
from unittest.mock import patch

from certify.kernel import check
from certify.kernel.completeness import triangulation_formula
from certify.kernel.evidence import Evidence, completeness_file
from certify.opinions.attack.corpus import ForgedList, Forgery, Record, read_corpus
from certify.opinions.attack.judge import Judge
from certify.opinions.attack.kinds import KINDS, forge
from certify.processes import Report, mapping
from certify.run import run
from certify.writing import write_files

CHUNK = 100
"""So many forgeries are tried by one process before it reports."""


class NotAccepted(ValueError):
    """What ships is not accepted, so that nothing can be measured by it."""


@dataclass(frozen=True)
class Finding:
    """A forgery that the kernel should have refused, and did not, or broke off over."""

    number: int
    kind: str
    outcome: str
    reason: str
    forgery: Forgery | ForgedList


@dataclass(frozen=True)
class Attack:
    """How many forgeries of each kind ended how, and those that the kernel should have refused."""

    counts: dict[str, Counter[str]]
    findings: tuple[Finding, ...]

    @property
    def tried(self) -> int:
        """The number of forgeries."""
        return self.total.total()

    @property
    def total(self) -> Counter[str]:
        """How many forgeries of all kinds ended how."""
        return sum(self.counts.values(), start=Counter())


def attack(
    root: Path, seed: int, count: int, jobs: int = 1, report: Report | None = None
) -> Attack:
    """Try forgeries 0, 1, ..., count - 1 of a seed; the outcome does not depend on ``jobs``.

    Raises:
        NotAccepted: What ships below the root is not accepted.
        ChildProcessError: One of the processes was killed.
    """
    _judge.cache_clear()
    _judge(root)
    counts: dict[str, Counter[str]] = {kind: Counter() for kind in KINDS}
    findings: list[Finding] = []
    chunks = [range(start, min(start + CHUNK, count)) for start in range(0, count, CHUNK)]
    done = 0
    with mapping(max(1, min(jobs, len(chunks)))) as mapped:
        for found, wrong in mapped(partial(_try, root, seed), chunks):
            for (kind, outcome), number in found.items():
                counts[kind][outcome] += number
            findings += wrong
            done += found.total()
            if report:
                report("forging", done, count)
    return Attack(counts, tuple(findings))


def _try(root: Path, seed: int, numbers: range) -> tuple[Counter[tuple[str, str]], list[Finding]]:
    judge = _judge(root)
    found: Counter[tuple[str, str]] = Counter()
    findings = []
    with formulas_kept():
        for number in numbers:
            kind, forgery = forge(judge.corpus, seed, number)
            outcome, reason = judge.outcome(forgery)
            found[kind, outcome] += 1
            if outcome not in ("refused", "true"):
                findings.append(Finding(number, kind, outcome, reason, forgery))
    return found, findings


@contextmanager
def formulas_kept() -> Iterator[None]:
    """Let the kernel write each formula once, not once for each forgery. Verdicts are not kept."""

    def kept(formula: Callable[[dict[Any, int]], Any]) -> Callable[[dict[Any, int]], Any]:
        write = lru_cache(maxsize=64)(lambda items: formula(dict(items)))
        return lambda signs: write(tuple(signs.items()))

    with ExitStack() as stack:
        formulas = {question: kept(formula) for question, formula in check.FORMULAS.items()}
        stack.enter_context(patch.dict(check.FORMULAS, formulas))
        once = lru_cache(triangulation_formula)
        stack.enter_context(patch.object(check, "triangulation_formula", once))
        yield


@lru_cache(maxsize=1)
def _judge(root: Path) -> Judge:
    outcome = run(root)
    if not outcome.ok:
        raise NotAccepted(next(iter(outcome.faults), "a theorem is not shown"))
    return Judge(read_corpus(outcome, Evidence(root)))


def write_out(folder: Path, found: Finding) -> Path:
    """Write a forgery as a root of its own, with what is wrong in ``forgery.json``; return it."""
    forgery = found.forgery
    note: Record = {key: getattr(found, key) for key in ("number", "kind", "outcome", "reason")}
    if isinstance(forgery, ForgedList):
        files = {completeness_file(forgery.letter): forgery.proof}
        note |= {"boundary": forgery.letter, "listed": forgery.known}
    else:
        files = {f"certificates/{forgery.pattern}.json": forgery.certificate, **forgery.proofs}
        note |= {"pattern": forgery.pattern}
    files["forgery.json"] = json.dumps(note).encode()
    write_files(folder / str(found.number), files)
    return folder / str(found.number)
