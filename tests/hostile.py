"""Files that mean no good, and real commands on them: each in one process, and what it cost."""

import gzip
import json
import os
import socket
import subprocess
import sys
from collections.abc import Callable, Iterable, Iterator
from hashlib import sha256
from pathlib import Path
from shutil import copy, copytree
from stat import S_IFCHR
from typing import Any, NamedTuple

from sympy import nextprime

from certify.kernel.certificate import MAX_DIGITS, QUESTIONS
from tests.commands import CHECKOUT, five_a, to_itself, to_nothing, write

YES, NO = "certificates/5_A.json", "proofs/15_A.realizable.lrat"
COMPLETE = tuple(f"proofs/complete.{letter}.lrat" for letter in "abcdefg")

Place = Callable[[Path], object]
"""Puts something where no file is."""
Hostile = dict[str, tuple[Place, str]]
"""What it is -> how to put it there, and what is said of it."""


# Things that are no file to be read


def holding(content: bytes) -> Place:
    """Return what writes a file."""
    return lambda path: path.write_bytes(content)


def sparse(size: int, start: bytes = b"") -> Place:
    """Return what makes a file of a size that takes no room: all behind its start is zero."""

    def place(path: Path) -> None:
        path.write_bytes(start)
        os.truncate(path, size)

    return place


def linked_to(target: str) -> Place:
    return lambda path: path.symlink_to(target)


def to_outside(path: Path) -> None:
    """Link to the right content, below another root."""
    path.symlink_to(CHECKOUT / path.parent.name / path.name)


def device(path: Path) -> None:
    """Make one like /dev/zero, of which there is no end."""
    os.mknod(path, S_IFCHR | 0o666, Path("/dev/zero").stat().st_rdev)


def listening(path: Path) -> None:
    """Make a socket; its own path may be too long."""
    with socket.socket(socket.AF_UNIX) as bound:
        folder = os.open(path.parent, os.O_RDONLY)
        bound.bind(f"/proc/self/fd/{folder}/{path.name}")
        os.close(folder)


def unreadable(path: Path) -> None:
    path.touch(mode=0)


def unreadable_by_nobody() -> bool:
    """Is this user one who reads every file?"""
    return not hasattr(os, "geteuid") or os.geteuid() == 0


NO_FILE = "is missing, or is not a regular file"
A_LINK = "is a symbolic link, or lies behind one"

PLACES: Hostile = {
    "nothing": (lambda _: None, NO_FILE),
    "a folder": (Path.mkdir, NO_FILE),
    "a pipe": (os.mkfifo, NO_FILE),
    "a socket": (listening, NO_FILE),
    "a device": (device, NO_FILE),
    "a link to nothing": (to_nothing, A_LINK),
    "a link to itself": (to_itself, NO_FILE),
    "a link to the right content": (to_outside, A_LINK),
    "a link to /dev/zero": (linked_to("/dev/zero"), A_LINK),
    "a link to /dev/full": (linked_to("/dev/full"), A_LINK),
    "a link to standard input": (linked_to("/dev/stdin"), A_LINK),
    "a file without permissions": (unreadable, "cannot be read: Permission denied"),
    "a gigabyte of zeros": (sparse(1 << 30), "is larger than"),
    "a terabyte of zeros": (sparse(1 << 40), "is larger than"),
    "a million brackets": (holding(b"[" * 10**6 + b"]" * 10**6), "is larger than"),
    "a million objects": (holding(b'{"a":' * 10**6), "is larger than"),
    "a million digits": (holding(b'{"instances": ' + b"9" * 2 * 10**6 + b"}"), "is larger than"),
    "a line of many megabytes": (holding(b"1 " * 8 * 10**6), "is larger than"),
}
if unreadable_by_nobody():
    del PLACES["a file without permissions"]


# Certificates of 5_A

CUBE = json.dumps(five_a())


def spoiled(old: str, new: str) -> Place:
    """Return what writes the certificate with one thing changed."""
    assert old in CUBE
    return holding(CUBE.replace(old, new, 1).encode("utf-8", "surrogatepass"))


def refuted(proof: str) -> Place:
    answer = {"answer": "no", "proof": proof, "sha256": "0" * 64}
    return holding(json.dumps(five_a() | {"valid": answer}).encode())


NO_SUCH_PROOF = "valid: proof is not proofs/5_A.valid.lrat"

CERTIFICATES: Hostile = PLACES | {
    "empty": (holding(b""), "not JSON"),
    "binary": (holding(b"\0\1\2"), "not JSON"),
    "invalid UTF-8": (holding(b"\xff\xfe{}"), "not UTF-8"),
    "UTF-16": (holding(CUBE.encode("utf-16")), "not UTF-8"),
    "compressed": (holding(gzip.compress(CUBE.encode())), "not UTF-8"),
    "a byte order mark": (holding(b"\xef\xbb\xbf" + CUBE.encode()), "not JSON"),
    "cut off": (holding(CUBE.encode()[:99]), "not JSON"),
    "64 KiB of NUL": (holding(b"\0" * (1 << 16)), "not JSON"),
    "a NUL in a string": (spoiled('"5_A"', '"5_A\0"'), "not JSON"),
    "an escaped NUL": (spoiled('"5_A"', '"5_A\\u0000"'), "not one of the 174 names"),
    "a lone surrogate": (spoiled('"5_A"', '"\ud800"'), "not UTF-8"),
    "an escaped surrogate": (spoiled(": 2", ': 2, "\\ud800": 2'), r"unknown key '\ud800'"),
    "brackets within the limit": (holding(b"[" * (1 << 16)), "nested too deeply"),
    "objects within the limit": (holding(b'{"a":' * 13_000), "nested too deeply"),
    "digits within the limit": (spoiled(": 2", ": " + "9" * 60_000), "more than 40 characters"),
    "a fraction within the limit": (
        spoiled("[1, 0, 0]", f'[1, 0, "1/{"9" * 60_000}"]'),
        "point 2: a coordinate is neither an integer nor",
    ),
    "a long float": (spoiled(": 2", ": 0." + "9" * 60_000), "is not an integer"),
    "many tetrahedra": (
        spoiled("[1, 2, 3, 6]", ", ".join(["[1, 2, 3, 6]"] * 4000)),
        "tetrahedra are not",
    ),
    "many points": (spoiled("[1, 0, 0]", ", ".join(["[1, 0, 0]"] * 5000)), "instead of eight"),
    "many coordinates": (spoiled("[1, 0, 0]", "[1" + ", 0" * 20_000 + "]"), "instead of three"),
    "many keys": (
        holding(json.dumps(dict.fromkeys(map(str, range(4000)))).encode()),
        '"format" is missing',
    ),
    "a list": (holding(b"[]"), "not an object"),
    "no keys": (holding(b"{}"), '"format" is missing'),
    "another format": (spoiled('"certify-pattern/1"', '"certify-pattern/2"'), "format is not"),
    "no name": (spoiled('"5_A"', '"5_B"'), "pattern is not one of the 174 names"),
    "another name": (spoiled('"5_A"', '"6_A"'), "pattern is 6_A, but the file is named after 5_A"),
    "a list for a name": (spoiled('"5_A"', '["5_A"]'), "pattern is not a string"),
    "no letter": (spoiled('"a"', '"z"'), "boundary is not"),
    "another letter": (spoiled('"a"', '"b"'), "boundary: stated b, but it is a"),
    "a boolean": (spoiled(": 2", ": true"), "instances is not an integer"),
    "a float": (spoiled(": 2", ": 2.0"), "2.0 is not an integer"),
    "an exponent": (spoiled(": 2", ": 2e999"), "2e999 is not an integer"),
    "NaN": (spoiled(": 2", ": NaN"), "NaN is not an integer"),
    "infinity": (spoiled(": 2", ": -Infinity"), "-Infinity is not an integer"),
    "a key twice": (spoiled(": 2", ': 2, "instances": 2'), "an object has the same key twice"),
    "one key more": (spoiled(": 2", ': 2, "extra": 2'), "unknown key 'extra'"),
    "vertices out of order": (spoiled("[1, 2, 3, 6]", "[1, 2, 6, 3]"), "tetrahedra are not"),
    "a ninth vertex": (spoiled("[1, 2, 3, 6]", "[1, 2, 3, 9]"), "tetrahedra are not"),
    "a tetrahedron less": (spoiled("[1, 2, 3, 6], ", ""), "tetrahedra: "),
    "two coordinates": (
        spoiled("[1, 0, 0]", "[1, 0]"),
        "point 2: it has 2 coordinates instead of three",
    ),
    "a float for a coordinate": (spoiled("[1, 0, 0]", "[1, 0, 0.5]"), "0.5 is not an integer"),
    "a zero for a denominator": (
        spoiled("[1, 0, 0]", '[1, 0, "1/0"]'),
        "point 2: a coordinate is neither an integer nor",
    ),
    "a point twice": (
        spoiled("[1, 0, 0]", "[0, 0, 0]"),
        "realizable: tetrahedron 1236 is degenerate",
    ),
    "no answer": (spoiled('"yes"', '"maybe"'), "realizable: answer is not"),
    "a proof outside": (refuted("../x.lrat"), NO_SUCH_PROOF),
    "a proof anywhere": (refuted("/etc/passwd"), NO_SUCH_PROOF),
    "a proof with dots": (refuted("proofs/../5_A.valid.lrat"), NO_SUCH_PROOF),
}


# Proofs of the first answer of 15_A

FIRST = 30_000
"""No clause of a question's formula has this number or a larger one."""


def laborious() -> bytes:
    """Return a proof with as much work as a megabyte can hold: looking at n^1.5 literals.

    Clause 1 is (-1, -2). Every line of the second half looks at all clauses of the first, each of
    which leaves a single literal.
    """
    size = 250
    base = " ".join(map(str, (-1, -2, *range(1000, 1000 + size))))
    lines = [f"{FIRST + j} {base} {2000 + j} 0 1 0" for j in range(size)]
    hints = " ".join(str(FIRST + j) for j in range(size))
    length = sum(map(len, lines)) + len(lines)
    while length < (1 << 20) - 4000:
        lines.append(f"{FIRST + len(lines)} {base} 0 {hints} 1 0")
        length += len(lines[-1]) + 1
    return "\n".join(lines).encode()


def counted(text: str, *parts: str, count: int) -> bytes:
    """Return text with numbers between its two parts: a thousand, a thousand and one, ..."""
    return (text + " ".join(str(1000 + n) for n in range(count)) + "".join(parts)).encode()


PROOFS: Hostile = PLACES | {
    "empty": (holding(b""), "line 1: not a step in the LRAT format"),
    "a megabyte of NUL": (holding(b"\0" * (1 << 20)), "line 1: the binary form of LRAT"),
    "binary LRAT": (holding(b"a\xff\1\2\0\4\0"), "not ASCII text, nor is binary LRAT"),
    "compressed": (holding(gzip.compress(b"30000 0 1 0\n")), "not ASCII text"),
    "a byte order mark": (holding(b"\xef\xbb\xbf30000 0 1 0\n"), "not ASCII text"),
    "another zero": (holding("30000 0 \N{SUPERSCRIPT TWO} 0\n".encode()), "not ASCII text"),
    "line ends of Windows": (holding(b"30000 0 1 0\r\n"), "line 1: not a step"),
    "a megabyte of digits": (holding(b"9" * (1 << 20)), "line 1: not a step"),
    "a megabyte of line feeds": (holding(b"\n" * (1 << 20)), "line 1: not a step"),
    "a megabyte of spaces": (holding(b" " * (1 << 20)), "line 1: not a step"),
    "a megabyte of minus signs": (holding(b"1 " + b"-" * 10**6), "line 1: not a step"),
    "a number too long": (holding(b"1" * 10 + b" 0 1 0\n"), "line 1: not a step"),
    "the largest number": (
        holding(b"999999999 0 999999998 0\n"),
        "line 1: there is no clause 999999998",
    ),
    "a hint 340000 times": (
        holding(b"30000 0" + b" 17" * 340_000 + b" 0"),
        "line 1: hint 17 occurs 340000 times",
    ),
    "a literal 340000 times": (
        holding(b"30000" + b" 17" * 340_000 + b" 0 1 0"),
        "line 1: variable 17 occurs 340000 times",
    ),
    "many literals": (
        holding(counted("30000 ", " 0 71 0", count=150_000)),
        "line 1: hint 1 has",
    ),
    "many hints": (holding(counted("30000 0 ", " 0", count=18_000)), "line 1: hint 1 has"),
    "many deletions": (
        holding(b"".join(b"1 d %d 0\n" % n for n in range(1, 20_000))),
        "the proof ends without the empty clause",
    ),
    "many empty deletions": (holding(b"1 d 0\n" * 170_000), "the proof ends without"),
    "much work": (holding(laborious()), "the proof ends without the empty clause"),
    "a negative hint": (holding(b"30000 0 -1 0\n"), "RAT steps are outside this format"),
    "two spaces": (holding(b"30000 0  1 0\n"), "line 1: not a step in the LRAT format"),
}


# Formulas, for a replay

FORMULAS: Hostile = {
    "a terabyte of zeros": (sparse(1 << 40), "larger than 268435456 bytes"),
    "a megabyte of NUL": (holding(b"\0" * (1 << 20)), "is not an integer of at most"),
    "a million digits": (holding(b"p cnf " + b"9" * 10**6), "is not an integer of at most"),
    "huge counts": (holding(b"p cnf 999999999 999999999\n"), "announces 999999999 clauses"),
    "negative counts": (holding(b"p cnf -1 -1\n"), ""),
    "a million empty clauses": (holding(b"p cnf 1 1\n" + b"0 " * 10**6), "there are 1000000"),
    "a clause without end": (holding(b"p cnf 1 1\n" + b"1 " * 10**6), "does not end with 0"),
    "compressed": (holding(gzip.compress(b"p cnf 1 1\n")), "not ASCII text"),
}


# Roots with one of them, and commands


def certificate_root(folder: Path, place: Place) -> Path:
    """Make a root with two certificates, one of them hostile."""
    root = _small_root(folder)
    (root / YES).unlink()
    place(root / YES)
    return root


def proof_root(folder: Path, place: Place) -> Path:
    """Make a root with two certificates and a hostile proof, of the right SHA-256 if it has one."""
    root = _small_root(folder)
    (root / NO).unlink()
    place(root / NO)
    if _is_small(root / NO):
        record = json.loads((root / "certificates" / "15_A.json").read_text())
        record["realizable"]["sha256"] = sha256((root / NO).read_bytes()).hexdigest()
        write(root, record)
    return root


def complete_root(folder: Path, places: Iterable[Place]) -> Path:
    """Make a root with all there is, the first proofs of completeness hostile."""
    for name in ("certificates", "proofs"):
        copytree(CHECKOUT / name, folder / name)
    for file, place in zip(COMPLETE, places, strict=False):
        (folder / file).unlink()
        place(folder / file)
    return folder


def fraction_root(folder: Path) -> Path:
    """Make a root in which all coordinates are as long as the format allows, and all is true.

    Each is divided by a prime of its own, all of one length. That moves a point by almost nothing,
    once all are made larger again.
    """
    complete_root(folder, ())
    primes = [int(nextprime(10 ** (2 * MAX_DIGITS - 5)))]
    while len(primes) < 24:
        primes.append(int(nextprime(primes[-1])))
    for path in (folder / "certificates").iterdir():
        record = json.loads(path.read_text())
        for question in QUESTIONS:
            own = iter(primes)
            for point in record[question].get("points", []):
                point[:] = [f"{x}/{next(own)}" for x in point]
        path.write_text(json.dumps(record))
    return folder


def _small_root(folder: Path) -> Path:
    for name in ("certificates", "proofs"):
        (folder / name).mkdir(parents=True)
        for file in (CHECKOUT / name).glob("15_A.*"):
            copy(file, folder / name)
    write(folder, five_a())
    return folder


def _is_small(path: Path) -> bool:
    return path.is_file() and not path.is_symlink() and path.stat().st_size <= 1 << 20


class Done(NamedTuple):
    """How a command ended, what it printed, and the most memory its process has had so far."""

    code: int
    out: str
    err: str
    seconds: float
    megabytes: float


PROGRAM = """
import io, json, runpy, sys, time
from contextlib import redirect_stderr, redirect_stdout
from pathlib import Path

def peak():
    status = Path("/proc/self/status")
    lines = status.read_text().splitlines() if status.exists() else []
    return sum(int(line.split()[1]) / 1024 for line in lines if line.startswith("VmHWM:"))

for line in sys.stdin:
    module, *sys.argv[1:] = json.loads(line)
    out, err = io.StringIO(), io.StringIO()
    start, code = time.perf_counter(), None
    with redirect_stdout(out), redirect_stderr(err):
        try:
            runpy.run_module(module, run_name="__main__", alter_sys=True)
        except SystemExit as stop:
            code = stop.code if isinstance(stop.code, int) else 1 if stop.code else 0
            if isinstance(stop.code, str):
                print(stop.code, file=sys.stderr)
    seconds = time.perf_counter() - start
    print(json.dumps([code, out.getvalue(), err.getvalue(), seconds, peak()]), flush=True)
"""
"""Runs modules as programs, one after the other. (What the system says of a child's memory counts
its parent's too, as it was when the child began.)"""


def run_all(commands: Iterable[tuple[str, ...]], patience: float = 600) -> Iterator[Done]:
    """Run modules as programs, with their arguments, in one process of their own.

    Raises:
        TimeoutExpired: They hang: all together take longer than so many seconds.
    """
    process = subprocess.run(
        [sys.executable, "-c", PROGRAM],
        input="".join(f"{json.dumps(command)}\n" for command in commands),
        cwd=CHECKOUT,
        capture_output=True,
        text=True,
        timeout=patience,
        check=True,
    )
    for line in process.stdout.splitlines():
        record: list[Any] = json.loads(line)
        yield Done(*record)
