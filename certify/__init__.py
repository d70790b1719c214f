"""Exact, machine-replayable audit of the 174 subdivisions of the hexahedron into tetrahedra.

>>> import certify
>>> certify.check("8_E").answers
{'realizable': 'yes', 'convex': 'yes', 'valid': 'yes'}

The names below are those of :mod:`certify.api`, which is imported when one of them is first used:
importing this package imports nothing else.
"""

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from certify.api import (
        Malformed,
        NotRealized,
        NotRefuted,
        Outcome,
        Pattern,
        Theorem,
        Verdict,
        check,
        check_all,
        load,
        patterns,
        replay,
        require,
    )

__version__ = "0.1.0"

__all__ = [
    "Malformed",
    "NotRealized",
    "NotRefuted",
    "Outcome",
    "Pattern",
    "Theorem",
    "Verdict",
    "check",
    "check_all",
    "load",
    "patterns",
    "replay",
    "require",
]


def __getattr__(name: str) -> Any:
    if name not in __all__:
        raise AttributeError(f"module 'certify' has no attribute {name!r}")
    from certify import api  # noqa: PLC0415 - on first use, so that importing certify is cheap

    return getattr(api, name)


def __dir__() -> list[str]:
    return sorted([*globals(), *__all__])
