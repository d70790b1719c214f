"""Certificates on disk -> the kernel -> an outcome fit to print. Nothing here is trusted."""

from collections.abc import Callable, Iterable, Iterator, Sequence
from concurrent.futures import ProcessPoolExecutor
from concurrent.futures.process import BrokenProcessPool
from contextlib import contextmanager
from pathlib import Path
from signal import SIG_IGN, SIGINT, signal
from typing import Any

from certify.kernel.check import Verdict
from certify.kernel.theorems import Outcome, check_all

Report = Callable[[str, int, int], object]
"""Told what is being done, how much of it is done, and how much there is."""


def printable(text: str) -> str:
    """Return the text with escapes for what could control a terminal or break a line."""
    return "".join(char if char.isprintable() else ascii(char)[1:-1] for char in text)


def run(root: Path, jobs: int = 1, report: Report | None = None) -> Outcome:
    """Return the kernel's outcome for a root, from ``jobs`` processes.

    Raises:
        ChildProcessError: One of the processes was killed.
    """

    def apply(check: Callable[[str], Verdict], patterns: Sequence[str]) -> Iterator[Verdict]:
        with mapping(min(jobs, len(patterns))) as mapped:
            for done, verdict in enumerate(mapped(check, patterns), start=1):
                yield verdict
                if report:
                    report("checking", done, len(patterns))

    return check_all(root, apply)


@contextmanager
def mapping(jobs: int) -> Iterator[Callable[..., Iterable[Any]]]:
    """Give the built-in ``map``, or that of a pool of processes.

    Raises:
        ChildProcessError: One of the processes was killed.
    """
    if jobs == 1:
        yield map
        return
    try:
        # An interrupt is for the parent, which then stops the others.
        with ProcessPoolExecutor(jobs, initializer=signal, initargs=(SIGINT, SIG_IGN)) as pool:
            yield pool.map
    except BrokenProcessPool:
        raise ChildProcessError("a process that checks was killed") from None
