"""Find certificates on disk, and put them before the kernel. Nothing here is trusted."""

from collections.abc import Iterator, Sequence
from concurrent.futures import ProcessPoolExecutor
from concurrent.futures.process import BrokenProcessPool
from dataclasses import replace
from functools import partial
from pathlib import Path
from signal import SIG_IGN, SIGINT, signal

from certify.kernel.certificate import PATTERN_NAMES, Certificate, Malformed, read_certificate
from certify.kernel.check import (
    Completeness,
    Verdict,
    check_completeness,
    check_pattern,
    completeness_proof,
)
from certify.kernel.hexahedron import BOUNDARY_TYPES


def default_root() -> Path:
    """Return the folder of certificates/ and proofs/: the package's own data, or the checkout."""
    package = Path(__file__).resolve().parent
    data = package / "data"
    return data if data.is_dir() else package.parent


def printable(text: str) -> str:
    """Return the text with escapes for what could control a terminal or break a line."""
    return "".join(char if char.isprintable() else ascii(char)[1:-1] for char in text)


def rejection(pattern: str, why: str) -> Verdict:
    """Return the verdict that the certificate of a pattern is rejected, fit to print."""
    return Verdict(pattern, fault=printable(f"certificates/{pattern}.json: {why}"))


def read(root: Path, pattern: str) -> Certificate | Verdict:
    """Return the certificate of a pattern, unchecked, or its rejection if it cannot be read."""
    try:
        return read_certificate(root / "certificates" / f"{pattern}.json")
    except Malformed as error:
        return rejection(pattern, str(error))


def verdict(root: Path, pattern: str) -> Verdict:
    """Return the kernel's verdict, fit to print; a check that breaks off is a rejection."""
    try:
        found = check_pattern(root, pattern)
    except Exception as error:
        return rejection(pattern, f"{type(error).__name__}: {error}")
    return replace(found, fault=found.fault and printable(found.fault))


def verdicts(root: Path, patterns: Sequence[str], jobs: int = 1) -> Iterator[Verdict]:
    """Yield the kernel's verdicts in the order of the patterns, from ``jobs`` processes."""
    check = partial(verdict, root)
    if jobs == 1:
        yield from map(check, patterns)
        return
    try:
        # An interrupt is for the parent, which then stops the others.
        workers = min(jobs, len(patterns))
        with ProcessPoolExecutor(workers, initializer=signal, initargs=(SIGINT, SIG_IGN)) as pool:
            yield from pool.map(check, patterns)
    except BrokenProcessPool:
        raise ChildProcessError("a process that checks certificates was killed") from None


def strays(root: Path) -> list[Verdict]:
    """Return a rejection for every certificate that is none of the patterns'."""
    names = {path.stem for path in (root / "certificates").glob("*.json")}
    foreign = sorted(names.difference(PATTERN_NAMES))
    return [rejection(printable(name), "not the name of a pattern") for name in foreign]


def completeness(root: Path, verdicts: Sequence[Verdict]) -> list[Completeness]:
    """Return, for each type of boundary, whether the patterns are all, fit to print.

    It is asked only when every pattern is accepted: the proofs are of the full list.
    """
    if any(verdict.fault is not None for verdict in verdicts):
        return []
    return [_completeness(root, letter, verdicts) for letter in BOUNDARY_TYPES]


def _completeness(root: Path, letter: str, verdicts: Sequence[Verdict]) -> Completeness:
    try:
        found = check_completeness(root, letter, verdicts)
    except Exception as error:
        fault = f"{completeness_proof(letter)}: {type(error).__name__}: {error}"
        found = Completeness(letter, fault)
    return replace(found, fault=found.fault and printable(found.fault))
