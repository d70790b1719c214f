"""Fuzz one target for a time: ``python -m tests.fuzz certificate --seconds 600``.

A target is fed with bytes that libFuzzer, through atheris, bends towards code that it has not seen
(see :mod:`tests.fuzz.targets`). One JSON object is printed; whatever goes wrong is kept in a file,
and the exit code is 1.
"""

import argparse
import json
import re
import subprocess
import sys
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

from certify.kernel.evidence import kernel_digest

TARGETS = ("certificate", "proof", "replay")
PROGRESS = re.compile(r"^#(\d+)\s.*\bcov: (\d+) ft: \d+ corp: (\d+)", re.MULTILINE)
"""Of the lines that libFuzzer writes: inputs so far, branches reached, and inputs that are kept."""


CHECKOUT = Path(__file__).resolve().parents[2]


def fuzz(
    target: str, findings: Path, seconds: int, runs: int = -1, checkout: Path = CHECKOUT
) -> dict[str, Any]:
    """Fuzz a target in a process of its own; return how often it was fed, and what was found."""
    findings.mkdir(parents=True, exist_ok=True)
    before = set(findings.iterdir())
    with TemporaryDirectory(prefix="certify-") as folder:
        arguments = [target, folder, str(findings.resolve()), str(seconds), str(runs)]
        command = [sys.executable, "-m", "tests.fuzz.targets", *arguments]
        done = subprocess.run(command, cwd=checkout, capture_output=True, check=False)
    text = done.stderr.decode("utf-8", "replace")
    found = sorted(path.name for path in set(findings.iterdir()) - before)
    progress = [tuple(map(int, figures)) for figures in PROGRESS.findall(text)]
    if not found and (done.returncode or not progress):
        raise RuntimeError(f"fuzzing broke off: {text[-2000:]}")
    inputs, branches, kept = progress[-1] if progress else (0, 0, 0)
    return {"inputs": inputs, "branches": branches, "inputs kept": kept, "findings": found}


def main() -> int:
    """Fuzz targets, one after the other, and print what was found as JSON."""
    parser = argparse.ArgumentParser(
        prog="python -m tests.fuzz", description="Fuzz what the kernel reads."
    )
    parser.add_argument("targets", nargs="*", default=TARGETS, metavar="|".join(TARGETS))
    parser.add_argument("--seconds", type=int, default=600, help="for each target (default 600)")
    parser.add_argument("--findings", type=Path, default=Path("findings"), metavar="DIR")
    asked = parser.parse_args()
    if unknown := set(asked.targets) - set(TARGETS):
        parser.error(f"unknown target {min(unknown)}")
    found = {target: fuzz(target, asked.findings, asked.seconds) for target in asked.targets}
    figures = {f"inputs to {target}": record["inputs"] for target, record in found.items()}
    figures["findings"] = sum(len(record["findings"]) for record in found.values())
    record = {"kernel_sha256": kernel_digest(), "figures": figures, "targets": found}
    sys.stdout.write(json.dumps(record, indent=2) + "\n")
    return 1 if figures["findings"] else 0


if __name__ == "__main__":
    sys.exit(main())
