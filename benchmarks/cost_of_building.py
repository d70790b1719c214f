"""What ``certify build`` costs on two cores, as a multiple of one ``certify check-all``.

    python benchmarks/cost_of_building.py

It builds under several settings, each into a temporary folder, and says which of the results are
the shipped certificates and proofs, byte for byte.
"""

import os
import subprocess
import sys
import tempfile
import time
from pathlib import Path

SHIPPED = Path(__file__).resolve().parents[1]
FOLDERS = ("certificates", "proofs")
OLD = {"OPENBLAS_CORETYPE": "Prescott", "NPY_DISABLE_CPU_FEATURES": "X86_V3 X86_V4 AVX512_ICL"}
SETTINGS: dict[str, tuple[str, dict[str, str]]] = {
    "--jobs 2": ("2", {}),
    "--jobs 1": ("1", {}),
    "--jobs 2, one BLAS thread": ("2", {"OPENBLAS_NUM_THREADS": "1"}),
    "--jobs 2, an old processor": ("2", OLD),
}


def run(*arguments: str, **environment: str) -> float:
    """Return how long a certify command takes."""
    start = time.perf_counter()
    subprocess.run(
        [sys.executable, "-m", "certify", *arguments],
        check=True,
        capture_output=True,
        env=os.environ | environment,
    )
    return time.perf_counter() - start


def contents(root: Path) -> dict[str, bytes]:
    """Return every certificate and proof below the root."""
    files = [path for folder in FOLDERS for path in (root / folder).iterdir()]
    return {str(path.relative_to(root)): path.read_bytes() for path in files}


def main() -> None:
    """Print, for each setting, what the build costs and whether its result is the shipped one."""
    shipped = contents(SHIPPED)
    checked = run("check-all", "--root", str(SHIPPED))
    different = 0
    for name, (jobs, environment) in SETTINGS.items():
        with tempfile.TemporaryDirectory() as root:
            built = run("build", "--jobs", jobs, "--root", root, **environment)
            found = contents(Path(root))
        differing = [file for file in shipped | found if shipped.get(file) != found.get(file)]
        different += len(differing)
        verdict = f"{len(differing)} files differ" if differing else "byte-identical"
        print(f"{name:28} {built / checked:4.0f} x certify check-all   {verdict}", flush=True)
    sys.exit(different > 0)


if __name__ == "__main__":
    main()
