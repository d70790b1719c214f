"""Certificates on disk -> the kernel -> an outcome fit to print. Nothing here is trusted."""

import os
from collections.abc import Callable, Iterable, Iterator, Sequence
from concurrent.futures import ProcessPoolExecutor
from concurrent.futures.process import BrokenProcessPool
from contextlib import contextmanager
from multiprocessing import parent_process
from multiprocessing.connection import wait
from pathlib import Path
from signal import SIG_IGN, SIGINT, signal
from threading import Thread
from typing import Any

from certify.kernel.check import Verdict
from certify.kernel.theorems import Outcome, check_all

MAX_JOBS = 61
"""More processes than this are never started: Windows has no pool of more."""

Report = Callable[[str, int, int], object]
"""Told what is being done, how much of it is done, and how much there is."""


def run(root: Path, jobs: int = 1, report: Report | None = None) -> Outcome:
    """Return the kernel's outcome for a root, from ``jobs`` processes, at most MAX_JOBS.

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
    """Give the built-in ``map``, or that of a pool of at most MAX_JOBS processes.

    Raises:
        ChildProcessError: One of the processes was killed.
    """
    if jobs == 1:
        yield map
        return
    try:
        with ProcessPoolExecutor(min(jobs, MAX_JOBS), initializer=_obey_the_parent) as pool:
            yield pool.map
    except BrokenProcessPool:
        raise ChildProcessError("a process that checks was killed") from None


def _obey_the_parent() -> None:
    """Leave an interrupt to the parent, which then stops its processes, and end when it ends."""
    signal(SIGINT, SIG_IGN)
    Thread(target=_outlive_no_parent, daemon=True).start()


def _outlive_no_parent() -> None:
    if parent := parent_process():
        wait([parent.sentinel])
        os._exit(1)
