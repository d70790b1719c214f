"""Blocks searched here, by processes, or by the workers of a Dask cluster."""

import os
from collections.abc import Callable, Iterable, Iterator
from concurrent.futures import FIRST_COMPLETED, Executor, Future, ProcessPoolExecutor, wait
from concurrent.futures.process import BrokenProcessPool
from contextlib import contextmanager
from multiprocessing import parent_process
from multiprocessing.connection import wait as wait_for_any
from signal import SIG_IGN, SIGINT, signal
from threading import Thread
from typing import TypeVar

T = TypeVar("T")
S = TypeVar("S")

AHEAD = 2
"""So many blocks a process are under way or wait: it never waits, and memory is bounded."""

MAX_JOBS = 61
"""More processes than this are never started: Windows has no pool of more."""


@contextmanager
def mapping(
    jobs: int = 1, scheduler: str | None = None
) -> Iterator[Callable[[Callable[[S], T], Iterable[S]], Iterator[T]]]:
    """Give a ``map`` that yields what is done first, and takes no more than it needs ahead.

    Args:
        jobs: How many processes.
        scheduler: The address of a Dask scheduler, whose workers are used instead.

    Raises:
        ChildProcessError: One of the processes was killed.
        OSError: The scheduler does not answer.
    """
    if scheduler is not None:
        from distributed import Client  # noqa: PLC0415 - an optional library

        with Client(scheduler, set_as_default=False) as client:
            threads = max(1, sum(client.nthreads().values()))
            yield lambda function, items: _mapped(client.get_executor(), threads, function, items)
    elif jobs == 1:
        yield map
    else:
        count = min(jobs, MAX_JOBS)
        pool = ProcessPoolExecutor(count, initializer=_obey_the_parent)
        try:
            yield lambda function, items: _mapped(pool, count, function, items)
        except BrokenProcessPool:
            raise ChildProcessError("a process that searches was killed") from None
        finally:
            pool.shutdown(cancel_futures=True)


def _mapped(
    pool: Executor, jobs: int, function: Callable[[S], T], items: Iterable[S]
) -> Iterator[T]:
    waiting: set[Future[T]] = set()
    try:
        for item in items:
            waiting.add(pool.submit(function, item))
            while len(waiting) >= AHEAD * jobs:
                done, waiting = wait(waiting, return_when=FIRST_COMPLETED)
                for future in done:
                    yield future.result()
        while waiting:
            done, waiting = wait(waiting, return_when=FIRST_COMPLETED)
            for future in done:
                yield future.result()
    finally:
        for future in waiting:
            future.cancel()


def _obey_the_parent() -> None:
    """Leave an interrupt to the parent, which then stops its processes, and end when it ends."""
    signal(SIGINT, SIG_IGN)
    Thread(target=_outlive_no_parent, daemon=True).start()


def _outlive_no_parent() -> None:
    if parent := parent_process():
        wait_for_any([parent.sentinel])
        os._exit(1)
