"""The theorems once more, proved in Coq from the same certificates and proofs.

Nothing here proves anything: the folder formal/ and the files that the kernel accepted are copied
into a scratch folder, make is run there, and what Coq printed is read. A theorem counts if Coq says
after it that it rests on no axiom. CHECKING.md, section 13, says what the theorems say.
"""

import os
import re
import shlex
import shutil
import signal
import subprocess
import sys
from collections.abc import Iterable, Mapping
from hashlib import sha256
from pathlib import Path
from tempfile import TemporaryDirectory

from certify.kernel.evidence import default_root
from certify.printable import printable

SECONDS = 3600
"""A build that takes longer has not answered."""

PROGRAMS = ("coqc", "coqdep", "make")

THEOREMS = (
    *("realizable_171", "not_realizable_3", "convex_158", "not_convex_16", "not_convex_position"),
    *("valid_143", "not_valid_16", "not_valid_31", "catalogue_counts", "rational_realizability"),
    "exactly_174",
)

CLOSED = "Closed under the global context"
"""What Coq prints of a theorem that rests on no axiom."""

OUTPUT = ("Theorems.out", "Exactly174.out")
"""The files below build/ with what Coq printed of the theorems."""


def absent() -> str | None:
    """Return why Coq cannot be asked, None if it can."""
    for name in PROGRAMS:
        if shutil.which(name) is None:
            return f"{name} is not on the PATH; see CHECKING.md, section 13"
    return None if _sources().is_dir() else "the folder formal/ is not there"


def _sources() -> Path:
    return default_root() / "formal"


def fault(root: Path, files: Mapping[str, str]) -> str | None:
    """Compile formal/ on some files; return None if all theorems are closed, else what is wrong.

    Args:
        root: Where the files are.
        files: The path below the root and the SHA-256 of each.
    """
    with TemporaryDirectory(prefix="certify-") as scratch:
        if changed := prepare(root, files, Path(scratch)):
            return f"{changed} is not what the kernel read"
        try:
            done = build(Path(scratch))
        except subprocess.TimeoutExpired:
            return f"did not answer in {SECONDS} seconds"
        if done.returncode:
            return f"does not compile: {refusal(done.stderr)}"
        printed = "".join((Path(scratch, "formal/build") / name).read_text() for name in OUTPUT)
    return judged(printed)


def prepare(root: Path, files: Mapping[str, str], folder: Path) -> str | None:
    """Copy formal/ and the files; return the first of these that has changed, None if none has."""
    shutil.copytree(
        _sources(), folder / "formal", ignore=shutil.ignore_patterns("build", "__pycache__")
    )
    for name, digest in files.items():
        content = (root / name).read_bytes()
        if sha256(content).hexdigest() != digest:
            return name
        path = folder / name
        path.parent.mkdir(exist_ok=True)
        path.write_bytes(content)
    return None


def build(folder: Path, *targets: str) -> "subprocess.CompletedProcess[str]":
    """Run make in formal/ below a folder, by default for everything."""
    return subprocess.run(
        ["make", f"PYTHON={shlex.quote(sys.executable)}", *targets],
        cwd=folder / "formal",
        env={**os.environ, "PYTHONDONTWRITEBYTECODE": "1", "MAKEFLAGS": "", "LC_ALL": "C"},
        stdin=subprocess.DEVNULL,
        capture_output=True,
        text=True,
        errors="replace",
        timeout=SECONDS,
        check=False,
        preexec_fn=_interruptible if os.name == "posix" else None,
    )


def _interruptible() -> None:
    """Let an interrupt end make and Coq, too: the processes that work for us ignore it."""
    signal.signal(signal.SIGINT, signal.SIG_DFL)


def refusal(error: str) -> str:
    """Return in one line where Coq, or a generator, gave up and why."""
    lines = [line.strip() for line in error.splitlines() if line.strip()]
    place = next((k for k, line in enumerate(lines) if line.startswith("File ")), None)
    if place is None:
        return printable(lines[0] if lines else "no message")
    message = " ".join(lines[place : place + 4]).split(" make: ")[0]
    return printable(message[:300])


def statements(printed: str) -> dict[str, tuple[str, str]]:
    """Return for each theorem its statement, and what Coq says of its axioms."""
    parts = re.split(r"^(\w+)\n +: ", printed, flags=re.MULTILINE)[1:]
    found = {}
    for name, text in zip(parts[::2], parts[1::2], strict=True):
        statement, _, assumptions = text.rstrip().rpartition("\n")
        found[name] = " ".join(statement.split()), assumptions
    return found


def judged(printed: str) -> str | None:
    """Return None if Coq said of every theorem that it is closed, otherwise of which it did not."""
    found = statements(printed)
    return _listed("not proved", [name for name in THEOREMS if name not in found]) or _listed(
        "rests on axioms", [name for name in found if found[name][1] != CLOSED]
    )


def _listed(what: str, names: Iterable[str]) -> str | None:
    return f"{what}: {', '.join(names)}" if names else None
