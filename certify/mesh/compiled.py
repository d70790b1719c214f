"""Ways to compile: by numba, with floating-point operations as they are written."""

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Any, TypeVar, cast

import numba

F = TypeVar("F", bound=Callable[..., Any])


def compiled(function: F) -> F:
    """Return the function as machine code, kept on disk between runs.

    Error bounds rest on IEEE arithmetic: nothing may be reordered or contracted (no fastmath).
    """
    return cast("F", numba.njit(cache=True, fastmath=False, error_model="numpy")(function))


def borrowing(function: F) -> F:
    """Return as machine code a function that makes no arrays.

    It is not compiled to count references to its arguments, which in a short function takes most of
    the time. Numba refuses to compile a function so that makes arrays all the same.
    """
    options = {"cache": True, "fastmath": False, "error_model": "numpy", "_nrt": False}
    options["forceinline"] = True
    return cast("F", numba.njit(**options)(function))


@contextmanager
def interruptible() -> Iterator[None]:
    """Let an interrupt be one that comes while a compiled function runs.

    It is noticed when Numba makes Python objects of the result, and Numba says SystemError then.
    """
    try:
        yield
    except SystemError as error:
        cause: BaseException | None = error
        while cause and not isinstance(cause, KeyboardInterrupt):
            cause = cause.__cause__ or cause.__context__
        if cause:
            raise KeyboardInterrupt from None
        raise
