"""Certificates on disk -> the kernel -> an outcome fit to print.

Whoever runs the kernel by ``certify`` trusts that this hands its verdicts back to it unchanged,
from this process or others. ``python -m certify.kernel`` does without.
"""

from collections.abc import Callable, Iterator, Sequence
from pathlib import Path

from certify.kernel.check import Verdict
from certify.kernel.theorems import Outcome, check_all
from certify.processes import Report, mapping


def run(root: Path, jobs: int = 1, report: Report | None = None) -> Outcome:
    """Return the kernel's outcome for a root, from ``jobs`` processes, at most MAX_JOBS.

    Raises:
        ChildProcessError: One of the processes was killed.
    """

    def apply(check: Callable[[str], Verdict], patterns: Sequence[str]) -> Iterator[Verdict]:
        with mapping(min(jobs, len(patterns))) as mapped:
            for done, verdict in enumerate(mapped(check, patterns), start=1):
                yield verdict
                if report:
                    report("checking", done, len(patterns))

    return check_all(root, apply)
