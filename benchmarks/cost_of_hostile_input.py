"""What hostile files cost, as multiples of checking one honest certificate in the same process.

    python -m benchmarks.cost_of_hostile_input [ROUNDS]

Each is checked once a round, by ``certify check``; the least over the rounds counts. Printed are
the dearest, what coordinates cost that are as long as they may be, and the most memory that the
process ever had.
"""

import sys
import tempfile
from pathlib import Path

from tests.hostile import (
    CERTIFICATES,
    PROOFS,
    certificate_root,
    fraction_root,
    proof_root,
    run_all,
)

DEAREST = 12
CHECKS = {"certificate": "5_A", "proof": "15_A"}
ROLES = {"certificate": (CERTIFICATES, certificate_root), "proof": (PROOFS, proof_root)}


def main() -> None:
    """Print a table of ratios."""
    rounds = int(sys.argv[1]) if len(sys.argv) > 1 else 3
    with tempfile.TemporaryDirectory() as folder:
        commands: dict[tuple[str, str], tuple[str, ...]] = {
            ("honest", "5_A"): ("certify", "check", "5_A")
        }
        for role, (hostile, arrange) in ROLES.items():
            for name, (place, _) in hostile.items():
                root = arrange(Path(folder, role, name.replace("/", "")), place)
                commands[role, name] = ("certify", "check", CHECKS[role], "--root", str(root))
        fractions = str(fraction_root(Path(folder, "fractions")))
        commands["fractions", "15_E"] = ("certify", "check", "15_E", "--root", fractions)
        commands["honest", "everything"] = ("certify", "check-all")
        commands["fractions", "everything"] = ("certify", "check-all", "--root", fractions)
        done = [*run_all(list(commands.values()) * rounds)]
    cost = {
        name: min(d.seconds for d in done[number :: len(commands)])
        for number, name in enumerate(commands)
    }
    unit = cost.pop(("honest", "5_A"))
    files = {name: seconds for name, seconds in cost.items() if name[1] != "everything"}
    for role, name in sorted(files, key=files.__getitem__, reverse=True)[:DEAREST]:
        print(f"{role:12} {name:30} {files[role, name] / unit:8.1f} x certify check 5_A")
    all_of_it = cost["fractions", "everything"] / cost["honest", "everything"]
    print(f"{'fractions':12} {'in all certificates':30} {all_of_it:8.1f} x certify check-all")
    print(f"{'peak memory':43} {max(d.megabytes for d in done):8.0f} MB")


if __name__ == "__main__":
    main()
