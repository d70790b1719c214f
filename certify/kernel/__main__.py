"""The kernel's own door: ``python -m certify.kernel [ROOT]`` checks everything below a root.

It prints what was rejected, then the theorems, a line each, and last one line of JSON for machines.
Exit code 0: all is accepted and every theorem shown; 1: not so, or it cannot be told, which one
line on standard error says; 2: there is no such root.
"""

import json
import sys
from contextlib import suppress
from pathlib import Path

try:
    from certify.kernel.evidence import default_root
    from certify.kernel.theorems import check_all
except Exception as error:  # sympy is not there, or stumbles over a variable of the environment
    sys.exit(f"the kernel cannot be imported: {error}")


def main(arguments: list[str]) -> int:
    """Check the root that the only argument names, or the one that comes with the code."""
    asks = arguments in (["-h"], ["--help"])
    root = Path(arguments[0]) if arguments else default_root()
    if asks or len(arguments) > 1 or not (root / "certificates").is_dir():
        print("usage: python -m certify.kernel [ROOT], with a folder ROOT/certificates")
        return 0 if asks else 2
    outcome = check_all(root)
    for fault in outcome.faults:
        print(f"rejected: {fault}")
    for theorem in outcome.theorems:
        print(f"{'ok' if theorem.ok else 'not shown'}: {theorem.id}: {theorem.statement}")
    counts = {
        "ok": outcome.ok,
        "accepted": sum(verdict.fault is None for verdict in outcome.verdicts),
        "rejected": len(outcome.faults),
        "open": len(outcome.open),
        "theorems": sum(theorem.ok for theorem in outcome.theorems),
    }
    print(json.dumps(counts | outcome.about))
    return 0 if outcome.ok else 1


if __name__ == "__main__":
    if sys.stdout is None:
        sys.exit("standard output is closed")
    try:
        code = main(sys.argv[1:])
        sys.stdout.flush()
    except KeyboardInterrupt:
        code = 130
    except OSError as error:  # the root cannot be looked at, or the output not be written
        with suppress(OSError):
            sys.stdout.close()  # else Python would try once more to write what is left
        sys.exit(str(error))
    sys.exit(code)
