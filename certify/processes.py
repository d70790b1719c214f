"""Processes that work for this one: they leave interrupts to it, and end when it does."""

import os
from collections.abc import Callable, Iterable, Iterator
from concurrent.futures import ProcessPoolExecutor
from concurrent.futures.process import BrokenProcessPool
from contextlib import contextmanager
from multiprocessing import parent_process
from multiprocessing.connection import wait
from signal import SIG_IGN, SIGINT, signal
from threading import Thread
from typing import Any

MAX_JOBS = 61
"""More processes than this are never started: Windows has no pool of more."""

Report = Callable[[str, int, int], object]
"""Told what is being done, how much of it is done, and how much there is."""


@contextmanager
def mapping(jobs: int) -> Iterator[Callable[..., Iterable[Any]]]:
    """Give the built-in ``map``, or that of a pool of at most MAX_JOBS processes.

    Raises:
        ChildProcessError: One of the processes was killed.
    """
    if jobs == 1:
        yield map
        return
    with pool(jobs) as workers:
        yield workers.map


@contextmanager
def pool(jobs: int, work: str = "checks") -> Iterator[ProcessPoolExecutor]:
    """Give a pool of at most MAX_JOBS processes; at the end, what it has not begun is left.

    work: what a process does, for the error.

    Raises:
        ChildProcessError: One of the processes was killed.
    """
    try:
        workers = ProcessPoolExecutor(min(jobs, MAX_JOBS), initializer=_obey_the_parent)
        try:
            yield workers
        finally:
            workers.shutdown(cancel_futures=True)
    except BrokenProcessPool:
        raise ChildProcessError(f"a process that {work} was killed") from None


def _obey_the_parent() -> None:
    """Leave an interrupt to the parent, which then stops its processes, and end when it ends."""
    signal(SIGINT, SIG_IGN)
    Thread(target=_outlive_no_parent, daemon=True).start()


def _outlive_no_parent() -> None:
    if parent := parent_process():
        wait([parent.sentinel])
        os._exit(1)
