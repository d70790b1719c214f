"""Blocks searched here, by processes, or by the workers of a Dask cluster."""

from collections.abc import Callable, Iterable, Iterator
from concurrent.futures import FIRST_COMPLETED, Executor, Future, wait
from contextlib import contextmanager
from typing import TypeVar

from certify.processes import pool

T = TypeVar("T")
S = TypeVar("S")

AHEAD = 2
"""So many blocks a process are under way or wait: it never waits, and memory is bounded."""


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
        with pool(jobs, "searches") as workers:
            yield lambda function, items: _mapped(workers, jobs, function, items)


def _mapped(
    workers: Executor, jobs: int, function: Callable[[S], T], items: Iterable[S]
) -> Iterator[T]:
    waiting: set[Future[T]] = set()
    try:
        for item in items:
            waiting.add(workers.submit(function, item))
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
