"""The mutants that no test kills, each with the reason why it changes no verdict."""

import tomllib
from pathlib import Path

from tests.mutation.operators import Source

KERNEL = Path(__file__).resolve().parents[2] / "certify" / "kernel"

SURVIVORS = Path(__file__).with_name("survivors.toml")
"""Groups of survivors, each with its reason."""

SCORE = Path(__file__).with_name("score.json")
"""What the last whole run found, and the SHA-256 of the kernel it was about."""


def all_sources() -> list[Source]:
    """Return the modules of the kernel, in the order of their names."""
    return [Source(path) for path in sorted(KERNEL.glob("*.py"))]


def listed() -> dict[str, str]:
    """Return the key of every survivor that is listed, and the reason."""
    groups = tomllib.loads(SURVIVORS.read_text(encoding="utf-8"))["group"]
    return {key: group["reason"] for group in groups for key in group["mutants"]}
