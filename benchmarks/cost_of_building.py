"""What ``certify build`` costs on two cores, as a multiple of one ``certify check-all``.

    python benchmarks/cost_of_building.py

It builds into a temporary folder, twice, and says whether the two builds are byte-identical.
"""

import subprocess
import sys
import tempfile
import time
from pathlib import Path


def run(*arguments: str) -> float:
    """Return how long a certify command takes."""
    start = time.perf_counter()
    subprocess.run([sys.executable, "-m", "certify", *arguments], check=True, capture_output=True)
    return time.perf_counter() - start


def contents(root: Path) -> dict[str, bytes]:
    """Return every file below the root."""
    return {str(p.relative_to(root)): p.read_bytes() for p in root.rglob("*") if p.is_file()}


def main() -> None:
    """Print the ratio and whether the builds agree."""
    with tempfile.TemporaryDirectory() as first, tempfile.TemporaryDirectory() as second:
        built = [run("build", "--jobs", "2", "--root", root) for root in (first, second)]
        checked = run("check-all", "--root", first)
        same = contents(Path(first)) == contents(Path(second))
    print(f"certify build {min(built) / checked:.0f} x certify check-all")
    print("byte-identical" if same else "NOT byte-identical")
    sys.exit(not same)


if __name__ == "__main__":
    main()
