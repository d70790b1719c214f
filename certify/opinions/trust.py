"""What the verdicts rest on, on one page: what is trusted, was replayed, doubted and attacked.

The first three parts are found in the run that prints them. How the kernel stood attacks and
mutations takes longer to find, so that is on record in ``measured/``: the output of the commands
that found it, with the SHA-256 of the kernel that they were run on.
"""

import ast
import json
import platform
from collections.abc import Iterator, Sequence
from dataclasses import asdict, dataclass
from hashlib import sha256
from pathlib import Path
from typing import Any

from sympy import ZZ
from sympy.external.gmpy import GROUND_TYPES
from sympy.polys.matrices import DomainMatrix

import certify.kernel
from certify.kernel.theorems import Outcome
from certify.manifest import Manifest
from certify.opinions.second import Opinion

RECORDS = {
    "forgeries": "certify attack --seed 1 --count 200000 --jobs 2",
    "fuzzing": "python -m tests.fuzz",
    "mutants": "python -m tests.mutation --jobs 2 --record",
}
"""What is on record -> the command that finds it again."""

LIMITS = (
    "The kernel's mathematics, sections 4 to 8 of CHECKING.md, is argued in words. Coq proves the "
    "main theorems of the same files (section 13), in part by other lemmas; it has not read the "
    "kernel.",
    "Here certify/run.py and certify/processes.py hand the kernel its patterns, and its verdicts "
    "back to it. python -m certify.kernel does without them.",
    "The second opinions were written by the same people, although from the documents and without "
    "a line of the kernel. The outside checkers were not.",
    "Forgeries and mutants try the program, not its mathematics.",
    "Python, sympy's integer determinants and the machine are taken as they are.",
    "Which triangulation of a cell (size, letter, status) bears which letter is ours, but for "
    "seven of those with 15 tetrahedra (CHECKING.md, section 11).",
    "A valid hexahedron is one whose Jacobian is positive. That its map is injective is not "
    "claimed.",
)


@dataclass(frozen=True)
class Module:
    """A file of the kernel: its lines, those that are neither empty nor comment, and SHA-256."""

    file: str
    lines: int
    code: int
    sha256: str


def modules() -> list[Module]:
    """Return the files of the kernel."""
    found = []
    for path in sorted(Path(certify.kernel.__file__).parent.glob("*.py")):
        content = path.read_bytes()
        text = content.decode()
        digest = sha256(content).hexdigest()
        found.append(Module(path.name, len(text.splitlines()), len(_code(text)), digest))
    return found


def _code(text: str) -> set[int]:
    """Return the numbers of the lines that are not empty, a comment, or part of a docstring."""
    quiet = set(_docstrings(ast.parse(text)))
    lines = enumerate(map(str.strip, text.splitlines()), start=1)
    return {k for k, line in lines if line and not line.startswith("#") and k not in quiet}


def _docstrings(tree: ast.AST) -> Iterator[int]:
    for node in ast.walk(tree):
        match node:
            case ast.Expr(value=ast.Constant(value=str())):
                yield from range(node.lineno, (node.end_lineno or node.lineno) + 1)


def determinants() -> str:
    """Return how sympy computes the kernel's determinants here."""
    matrix = DomainMatrix([[ZZ(1)]], (1, 1), ZZ)
    return f"{type(matrix.rep).__name__} over {matrix.domain}, with integers of {GROUND_TYPES}"


def on_record(name: str, kernel: str) -> dict[str, Any] | None:
    """Return what is on record, and whether it was found for this kernel; None if nothing is."""
    path = Path(__file__).parent / "measured" / f"{name}.json"
    if not path.is_file():
        return None
    record: dict[str, Any] = json.loads(path.read_text())
    return record | {"for_this_kernel": record["kernel_sha256"] == kernel}


def page(
    outcome: Outcome, manifest: Manifest | None, opinions: Sequence[Opinion]
) -> dict[str, Any]:
    """Return the page as a JSON object; ``opinions`` are those that were asked in this run."""
    kernel = outcome.about["kernel_sha256"]
    return {
        "trusted": {
            "kernel": list(map(asdict, modules())),
            "kernel_sha256": kernel,
            "python": f"{platform.python_implementation()} {outcome.about['python']}",
            "sympy": outcome.about["sympy"],
            "determinants": determinants(),
        },
        "replayed": {
            "ok": outcome.ok and not (manifest and manifest.faults),
            "certificates": sum(verdict.fault is None for verdict in outcome.verdicts),
            "files": len(outcome.files),
            "evidence_sha256": outcome.evidence_digest,
            "manifest": asdict(manifest) if manifest else None,
            "open": len(outcome.open),
            "rejected": outcome.faults,
            "theorems": {theorem.id: theorem.ok for theorem in outcome.theorems},
        },
        "second_opinions": list(map(asdict, opinions)),
        "on_record": {name: on_record(name, kernel) for name in RECORDS},
        "limits": LIMITS,
    }
