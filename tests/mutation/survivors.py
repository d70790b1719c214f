"""The mutants that no test kills, each with the reason why it changes no verdict."""

import tomllib
from pathlib import Path

from tests.mutation.operators import Source

CERTIFY = Path(__file__).resolve().parents[2] / "certify"

SURVIVORS = Path(__file__).with_name("survivors.toml")
"""Groups of survivors, each with its reason."""

RECORD = CERTIFY / "opinions" / "measured" / "mutants.json"
"""What the last whole run found, for ``certify trust``."""


def all_sources() -> list[Source]:
    """Return the modules of the kernel, in the order of their names."""
    return [Source(path) for path in sorted((CERTIFY / "kernel").glob("*.py"))]


def listed() -> dict[str, str]:
    """Return the key of every survivor that is listed, and the reason."""
    groups = tomllib.loads(SURVIVORS.read_text(encoding="utf-8"))["group"]
    return {key: group["reason"] for group in groups for key in group["mutants"]}
