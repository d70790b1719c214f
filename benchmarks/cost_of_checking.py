"""What checking costs, as multiples of ``python -c "import sympy"`` in the same run.

    python benchmarks/cost_of_checking.py [ROUNDS]

The commands take turns, each in a cold process on one core; the median over the rounds counts.
"""

import resource
import statistics
import subprocess
import sys
import time

COMMANDS = {
    "import sympy": ["-c", "import sympy"],
    "certify check 15_A": ["-m", "certify", "check", "15_A"],
    "the kernel's door": ["-m", "certify.kernel"],
    "certify check-all": ["-m", "certify", "check-all"],
    "check-all --jobs 2": ["-m", "certify", "check-all", "--jobs", "2"],
    "certify audit": ["-m", "certify", "audit"],
}


def seconds(arguments: list[str]) -> float:
    """Return how long a fresh interpreter takes for the arguments."""
    start = time.perf_counter()
    subprocess.run([sys.executable, *arguments], check=True, capture_output=True)
    return time.perf_counter() - start


def main() -> None:
    """Print a table of ratios, and the largest memory that any of the commands used."""
    rounds = int(sys.argv[1]) if len(sys.argv) > 1 else 7
    times: dict[str, list[float]] = {name: [] for name in COMMANDS}
    for _ in range(rounds):
        for name, arguments in COMMANDS.items():
            times[name].append(seconds(arguments))
    unit = statistics.median(times["import sympy"])
    for name, measured in times.items():
        print(f"{name:20} {statistics.median(measured) / unit:6.2f} x import sympy")
    peak = resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss
    print(f"{'peak memory':20} {peak / 1024:6.0f} MB")


if __name__ == "__main__":
    main()
