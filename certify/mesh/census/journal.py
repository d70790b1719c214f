"""What a block was found to have, and the file that keeps it: an interrupted census can go on.

The file is text, one JSON object a line. The first line says of which mesh and of which blocks;
each other line is a block. A last line that is cut short is left out, and its block is done again.
"""

import json
import os
from collections.abc import Mapping
from contextlib import AbstractContextManager, nullcontext
from pathlib import Path
from typing import Any, NamedTuple, Protocol

VERSION = 1


class Counts(NamedTuple):
    """What a block has.

    patterns: how many valid hexahedra of each; witnesses: the first found of each; undecided: those
    of which nobody knows whether they are valid.
    """

    patterns: Mapping[str, int]
    witnesses: Mapping[str, tuple[int, ...]]
    undecided: tuple[tuple[int, ...], ...]


class NotItsJournal(ValueError):
    """The file is no journal, or that of another census; the message says which."""


class Journal(Protocol):
    """Where the counts of blocks are kept."""

    def __call__(self, block: int, counts: Counts) -> None:
        """Keep the counts of a block."""


def opened(
    path: Path | None, about: Mapping[str, Any]
) -> tuple[dict[int, Counts], AbstractContextManager[Journal]]:
    """Return the blocks that a journal has, and a context in which it takes others.

    Args:
        path: The file, which is made if there is none; with None nothing is kept.
        about: What the census is about. The journal must have been about the same.

    Raises:
        NotItsJournal: The file is another's.
        OSError: It cannot be read or written.
    """
    if path is None:
        return {}, nullcontext(_forget)
    head = json.dumps({"census": VERSION, **about}, sort_keys=True)
    done, length = _read(path, head) if path.exists() and path.stat().st_size else ({}, 0)
    return done, _Appending(path, length, head)


def _forget(block: int, counts: Counts) -> None:
    """Keep nothing."""


class _Appending(AbstractContextManager[Journal]):
    def __init__(self, path: Path, length: int, head: str) -> None:
        self.path, self.length, self.head = path, length, head

    def __enter__(self) -> Journal:
        self.file = self.path.open("ab")
        self.file.truncate(self.length)
        if not self.length:
            self._write(self.head)
        return lambda block, counts: self._write(json.dumps({"block": block, **counts._asdict()}))

    def _write(self, line: str) -> None:
        self.file.write(line.encode() + b"\n")
        self.file.flush()
        os.fsync(self.file.fileno())

    def __exit__(self, *_: object) -> None:
        self.file.close()


def _read(path: Path, head: str) -> tuple[dict[int, Counts], int]:
    """Return the blocks, and the length of the file up to the last complete line."""
    content = path.read_bytes()
    lines = content[: content.rfind(b"\n") + 1].splitlines(keepends=True)
    if not lines or lines[0].rstrip(b"\n") != head.encode():
        raise NotItsJournal(f"{path} is not the journal of a census of this mesh by such blocks")
    done = {}
    for number, line in enumerate(lines[1:], start=2):
        try:
            found = json.loads(line)
            done[int(found["block"])] = Counts(
                {str(name): int(count) for name, count in found["patterns"].items()},
                {str(name): tuple(map(int, own)) for name, own in found["witnesses"].items()},
                tuple(tuple(map(int, own)) for own in found["undecided"]),
            )
        except (ValueError, TypeError, KeyError, AttributeError):
            raise NotItsJournal(f"{path}: line {number} is not that of a block") from None
    return done, sum(map(len, lines))
