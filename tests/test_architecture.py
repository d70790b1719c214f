"""The kernel imports nothing of ours; lint, format and types are clean."""

import ast
import re
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest

KERNEL = Path(__file__).resolve().parents[1] / "certify" / "kernel"


def run(root: Path, *arguments: str) -> tuple[int, str]:
    """Run Python on the repository; return exit code and output."""
    result = subprocess.run(
        [sys.executable, *arguments], cwd=root, capture_output=True, text=True, check=False
    )
    return result.returncode, result.stdout + result.stderr


def imported(path: Path) -> Iterator[str]:
    """Yield the modules that a file imports, anywhere in it; a relative one begins with a dot."""
    for node in ast.walk(ast.parse(path.read_text())):
        if isinstance(node, ast.Import):
            yield from (alias.name for alias in node.names)
        elif isinstance(node, ast.ImportFrom):
            yield "." * node.level + (node.module or "")


def is_allowed(module: str) -> bool:
    top, *rest = module.split(".")
    if top == "certify":
        return rest[:1] == ["kernel"]
    return top == "sympy" or (top in sys.stdlib_module_names and top not in LOADERS)


LOADERS = {"ctypes", "imp", "importlib", "pkgutil", "runpy", "subprocess", "zipimport"}
"""What could get other code to run."""


@pytest.mark.parametrize(
    ("module", "allowed"),
    [
        *((name, True) for name in ("json", "sympy.polys.matrices", "certify.kernel.check")),
        *((name, False) for name in ("numpy", "importlib.util", "certify", "certify.search", ".")),
    ],
)
def test_what_is_allowed(module: str, allowed: bool) -> None:
    assert is_allowed(module) == allowed


@pytest.mark.parametrize("path", sorted(KERNEL.rglob("*.py")), ids=lambda path: path.stem)
def test_kernel_imports(path: Path) -> None:
    """The standard library, sympy and itself, and it calls nothing that imports."""
    assert [module for module in imported(path) if not is_allowed(module)] == []
    tree = ast.parse(path.read_text())
    names = {node.id for node in ast.walk(tree) if isinstance(node, ast.Name)}
    assert names.isdisjoint({"__import__", "__builtins__", "eval", "exec", "compile"})


def test_kernel_is_python_only() -> None:
    assert {path.suffix for path in KERNEL.rglob("*") if path.is_file()} <= {".py", ".pyc"}
    assert len(list(KERNEL.glob("*.py"))) > 10


ALONE = """
import sys
from importlib.abc import MetaPathFinder
from pathlib import Path

class Hide(MetaPathFinder):
    def find_spec(self, name, path=None, target=None):
        top = name.partition(".")[0]
        if top in ("sympy", "mpmath", "flint", "gmpy2") or top in sys.stdlib_module_names:
            return None
        if name == "certify" or f"{name}.".startswith("certify.kernel."):
            return None
        raise ModuleNotFoundError(name, name=name)

sys.meta_path.insert(0, Hide())
from certify.kernel.check import check_pattern
from certify.kernel.theorems import theorems
for name in ("5_A", "15_A"):
    assert check_pattern(Path(), name).fault is None
assert theorems([], [])[0].ok
"""


def test_kernel_needs_nothing_else_at_run_time(shipped: Path) -> None:
    """It accepts certificates where all other modules are hidden but what sympy itself needs."""
    assert run(shipped, "-c", ALONE) == (0, "")


def test_import_contracts_are_kept(shipped: Path) -> None:
    script = "from importlinter.cli import lint_imports; raise SystemExit(lint_imports())"
    code, output = run(shipped, "-c", script)
    counts = re.search(r"Contracts: (\d+) kept, (\d+) broken", output)
    assert code == 0, output
    assert counts is not None
    assert int(counts[1]) > 0
    assert counts[2] == "0"


@pytest.mark.parametrize(
    "command",
    [("ruff", "check"), ("ruff", "format", "--check"), ("mypy",)],
    ids=["lint", "format", "types"],
)
def test_sources_are_clean(shipped: Path, command: tuple[str, ...]) -> None:
    code, output = run(shipped, "-m", *command)
    assert code == 0, output
