"""The kernel imports nothing of ours; lint, format and types are clean."""

import ast
import importlib.metadata
import json
import re
import subprocess
import sys
import venv
from collections import Counter
from collections.abc import Iterator
from pathlib import Path
from shutil import copytree
from typing import Any

import pytest

from certify.kernel.theorems import Outcome, check_all

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
import runpy
import sys
from importlib.abc import MetaPathFinder

class Hide(MetaPathFinder):
    def find_spec(self, name, path=None, target=None):
        top = name.partition(".")[0]
        if top in ("sympy", "mpmath", "flint", "gmpy2") or top in sys.stdlib_module_names:
            return None
        if name == "certify" or f"{name}.".startswith("certify.kernel."):
            return None
        raise ModuleNotFoundError(name, name=name)

sys.meta_path.insert(0, Hide())
runpy.run_module("certify.kernel", run_name="__main__")
"""


def test_kernel_needs_nothing_else_at_run_time(shipped: Path) -> None:
    """Its own door opens where all modules are hidden but its own and those that sympy needs."""
    code, output = run(shipped, "-c", ALONE)
    *lines, last = output.splitlines()
    assert code == 0
    assert len(lines) == 16
    assert all(line.startswith("ok: ") for line in lines)
    assert json.loads(last)["theorems"] == 16


@pytest.mark.slow
def test_kernel_needs_nothing_else_installed(shipped: Path, tmp_path: Path) -> None:
    """In an environment with sympy alone the door opens, and the command line does not."""
    venv.create(tmp_path / "venv", with_pip=True)
    python = tmp_path / "venv" / "bin" / "python"
    sympy = f"sympy=={importlib.metadata.version('sympy')}"
    subprocess.run([python, "-m", "pip", "install", "--quiet", sympy], check=True)
    door, program = (
        subprocess.run([python, "-m", name], cwd=shipped, capture_output=True, check=False)
        for name in ("certify.kernel", "certify")
    )
    assert (door.returncode, door.stdout.count(b"\nok: ")) == (0, 15)
    assert program.returncode == 1
    assert b"No module named 'click'" in program.stderr


def test_kernel_door_rejects(tmp_path: Path, shipped: Path) -> None:
    copytree(shipped / "certificates", tmp_path / "certificates")
    copytree(shipped / "proofs", tmp_path / "proofs")
    (tmp_path / "proofs" / "15_A.realizable.lrat").unlink()
    code, output = run(shipped, "-m", "certify.kernel", str(tmp_path))
    first, *_, last = output.splitlines()
    assert code == 1
    assert first.startswith("rejected: certificates/15_A.json: realizable: ")
    assert "\nnot shown: realizable: " in output
    assert "\nok: valid: " in output
    record = json.loads(last)
    assert (record["ok"], record["accepted"], record["rejected"]) == (False, 173, 1)


@pytest.mark.parametrize("arguments", [["nowhere"], ["a", "b"]])
def test_kernel_door_needs_a_root(shipped: Path, arguments: list[str]) -> None:
    code, output = run(shipped, "-m", "certify.kernel", *arguments)
    assert code == 2
    assert output.startswith("usage: python -m certify.kernel [ROOT]")


def test_digests_are_those_of_sha256sum(shipped: Path, outcome: Outcome) -> None:
    """As CHECKING.md says, anyone can compute them."""
    sums = (
        ("kernel_sha256", "cd certify/kernel && sha256sum *.py | sha256sum"),
        ("evidence_sha256", "sha256sum certificates/*.json proofs/*.lrat | sha256sum"),
    )
    for name, command in sums:
        result = subprocess.run(
            ["bash", "-c", f"export LC_ALL=C; {command}"],
            cwd=shipped,
            capture_output=True,
            text=True,
            check=True,
        )
        assert result.stdout.split()[0] == outcome.about[name]


def test_each_file_is_read_once(shipped: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    opened: Counter[str] = Counter()
    original = Path.open

    def counting(path: Path, *args: Any, **settings: Any) -> Any:
        opened[path.name] += 1
        return original(path, *args, **settings)

    monkeypatch.setattr(Path, "open", counting)
    outcome = check_all(shipped)
    assert opened == {Path(name).name: 1 for result in outcome.results for name in result.files}


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
