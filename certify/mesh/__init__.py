"""The engineer's room: eight points, hexahedral meshes, tetrahedral meshes. No theorem needs it.

>>> import certify.mesh
>>> cube = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1)]
>>> found = certify.mesh.triangulations([cube])
>>> sorted({own.pattern for own, yes in zip(certify.mesh.labelled(), found[0]) if yes})
['5_A', '6_A', '6_B', '6_C', '6_D', '6_E']

The functions need the extra ``mesh``; importing this package imports nothing.
"""

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from certify.mesh.realized import fillable, labelled, triangulations

__all__ = ["fillable", "labelled", "triangulations"]


def __getattr__(name: str) -> Any:
    if name not in __all__:
        raise AttributeError(f"module 'certify.mesh' has no attribute {name!r}")
    from certify.mesh import realized  # noqa: PLC0415 - on first use: numba is optional

    return getattr(realized, name)


def __dir__() -> list[str]:
    return sorted([*globals(), *__all__])
