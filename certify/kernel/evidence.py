"""The files that a verdict rests on: each is read once, up to a limit, and its SHA-256 is kept.

A root is a folder that holds certificates/ and proofs/. Files are named by their path below it.
"""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from hashlib import sha256
from os.path import realpath
from pathlib import Path

MAX_CERTIFICATE_BYTES = 1 << 16
"""About twenty times the largest certificate that ships (15_G.json, 3,441 bytes)."""
MAX_PROOF_BYTES = 1 << 20
"""About four times the longest proof that ships (complete.g.lrat, 267,762 bytes)."""


class Malformed(ValueError):
    """A file is not what it should be; the message says in one line where it departs from it."""


@dataclass
class Evidence:
    """The files below a root, as far as they have been read."""

    root: Path
    files: dict[str, str] = field(default_factory=dict)
    """File -> the SHA-256 of what was read."""

    def certificate(self, pattern: str) -> bytes:
        """Return the content of a pattern's certificate, or raise Malformed."""
        return self._read(certificate_file(pattern), MAX_CERTIFICATE_BYTES)

    def proof(self, name: str, digest: str | None = None) -> str:
        """Return the text of a proof, which must have the digest if one is given.

        Raise Malformed if it has not, or is not ASCII text.
        """
        content = self._read(name, MAX_PROOF_BYTES)
        if digest not in (None, self.files[name]):
            what = f"the SHA-256 of {name} is not the one that the certificate states"
            raise Malformed(what + _if_converted(content, digest))
        try:
            return content.decode("ascii")
        except UnicodeDecodeError:
            raise Malformed(f"{name} is not ASCII text, nor is binary LRAT") from None

    def _read(self, name: str, limit: int) -> bytes:
        """Return the content of a file that really lies below the root: no link leads there."""
        path = self.root / name
        if Path(realpath(path)) != Path(realpath(self.root)) / name:
            raise Malformed(f"{name} is a symbolic link, or lies behind one")
        content = read_file(path, limit)
        self.files[name] = sha256(content).hexdigest()
        return content


def _if_converted(content: bytes, digest: str | None) -> str:
    """Return what to add where the digest would fit if lines ended at a line feed alone."""
    as_written = content.replace(b"\r\n", b"\n")
    return "; its line ends were converted" if sha256(as_written).hexdigest() == digest else ""


def read_file(path: Path, limit: int) -> bytes:
    """Return the content of a regular file of at most ``limit`` bytes, or raise Malformed."""
    try:
        if not path.is_file():
            raise Malformed(f"{path.name} is missing, or is not a regular file")
        with path.open("rb") as file:
            content = file.read(limit + 1)
    except OSError as error:
        raise Malformed(f"{path.name} cannot be read: {error.strerror}") from None
    if len(content) > limit:
        raise Malformed(f"{path.name} is larger than {limit} bytes")
    return content


def certificate_file(pattern: str) -> str:
    """Return the path below the root of a pattern's certificate."""
    return f"certificates/{pattern}.json"


def proof_file(pattern: str, question: str) -> str:
    """Return the path below the root of the proof of a no."""
    return f"proofs/{pattern}.{question}.lrat"


def completeness_file(letter: str) -> str:
    """Return the path below the root of the proof that a type of boundary has no more patterns."""
    return f"proofs/complete.{letter}.lrat"


def strays(root: Path, patterns: Iterable[str]) -> dict[str, str]:
    """Return path below the root -> what is wrong with it, for what no pattern's verdict tells of.

    That is a certificate that is named after no pattern, or a folder that cannot be listed.
    """
    expected = set(map(certificate_file, patterns))
    try:
        names = sorted(f"certificates/{path.name}" for path in (root / "certificates").iterdir())
    except OSError as error:
        return {"certificates": f"the folder cannot be listed: {error.strerror}"}
    odd = [name for name in names if name.endswith(".json") and name not in expected]
    return {ascii(name)[1:-1]: "the file is not named after a pattern" for name in odd}


def digest(files: Mapping[str, str]) -> str:
    """Return one SHA-256 for many files, given by the SHA-256 of each.

    It is that of the list which the command sha256sum prints of the files in the order of their
    names, so that it can be computed without this program.
    """
    lines = "".join(f"{files[name]}  {name}\n" for name in sorted(files))
    return sha256(lines.encode()).hexdigest()


def kernel_digest() -> str:
    """Return one SHA-256 for the modules of this package."""
    here = Path(__file__).parent
    return digest({p.name: sha256(p.read_bytes()).hexdigest() for p in here.glob("*.py")})


def default_root() -> Path:
    """Return the root that comes with the code: the installed package's data, or the checkout."""
    package = Path(__file__).resolve().parents[1]
    data = package / "data"
    return data if data.is_dir() else package.parent
