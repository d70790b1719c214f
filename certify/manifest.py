"""Is this what was released? The manifest of a root, in the format of sha256sum(1). Not trusted.

It adds nothing to a theorem: who can change a certificate can change the list as well. It tells an
honest reader that he checks what was released, unless the list itself is signed.
"""

import os
import re
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from hashlib import sha256
from pathlib import Path

import certify.kernel
from certify.kernel.evidence import Malformed, default_root, kernel_files, read_file
from certify.kernel.theorems import Outcome

NAME = "MANIFEST.sha256"
KERNEL = "certify/kernel"
EVIDENCE = {"certificates": ".json", "proofs": ".lrat"}
MAX_BYTES = 1 << 20
"""A limit for the manifest, and for a file that the kernel did not read."""

_LINE = re.compile(
    rf"([0-9a-f]{{64}})  ({KERNEL}/[^/]+\.py|certificates/[^/]+\.json|proofs/[^/]+\.lrat)"
)


@dataclass(frozen=True)
class Manifest:
    """How many files are as listed, which are not, and whether the kernel was among them."""

    files: int
    kernel: bool
    faults: tuple[str, ...]


def compare(root: Path, outcome: Outcome) -> Manifest | None:
    """Compare what was read in a run with the manifest that lies below its root, if there is one.

    Certificates and proofs that the kernel did not read are read for this. The manifest speaks of
    the kernel that runs if the root is the one that comes with it, and else perhaps of another.
    """
    path = root / NAME
    if not os.path.lexists(path):
        return None
    kernel = root.resolve() == default_root()
    try:
        listed = _listed(read_file(path, MAX_BYTES))
    except Malformed as error:
        return Manifest(0, kernel, (str(error),))
    if not kernel:
        listed = {name: digest for name, digest in listed.items() if not name.startswith(KERNEL)}
    found = outcome.files | _unread(root, outcome) | (_kernel() if kernel else {})
    return Manifest(
        sum(found.get(name) == digest for name, digest in listed.items()),
        kernel,
        tuple(_differences(root, listed, found)),
    )


def evidence(root: Path) -> list[str]:
    """Return the certificates and proofs below a root, by their paths there, sorted."""
    return sorted(
        f"{folder}/{path.name}"
        for folder, suffix in EVIDENCE.items()
        for path in (root / folder).glob(f"*{suffix}")
    )


def _differences(root: Path, listed: Mapping[str, str], found: Mapping[str, str]) -> Iterator[str]:
    for name in sorted(listed.keys() | found.keys()):
        printed = ascii(name)[1:-1]
        if name not in found:
            yield f"{printed} is missing"
        elif name not in listed:
            yield f"{printed} is not in {NAME}"
        elif listed[name] != found[name]:
            reason = "; its line ends were converted" * _converted(root, name, listed[name])
            yield f"{printed} is not the one in {NAME}{reason}"


def _converted(root: Path, name: str, digest: str) -> bool:
    """Would a file have the digest, had its lines no carriage returns at their ends?"""
    own = Path(certify.kernel.__file__).parent / Path(name).name
    try:
        content = read_file(own if name.startswith(KERNEL) else root / name, MAX_BYTES)
    except Malformed:
        return False
    return sha256(content.replace(b"\r\n", b"\n")).hexdigest() == digest


def _listed(content: bytes) -> dict[str, str]:
    """Return file -> SHA-256, or raise Malformed."""
    if b"\r\n" in content:
        raise Malformed(f"{NAME}: its line ends were converted")
    listed: dict[str, str] = {}
    lines = content.decode("utf-8", "replace").removesuffix("\n").split("\n")
    for number, line in enumerate(lines, start=1):
        match = _LINE.fullmatch(line)
        if match is None or match[2] in listed:
            what = "the SHA-256 and the name of a kernel file, a certificate or a proof, once each"
            raise Malformed(f"{NAME}, line {number}: not {what}")
        listed[match[2]] = match[1]
    return listed


def _unread(root: Path, outcome: Outcome) -> dict[str, str]:
    """Return the SHA-256 of the certificates and proofs that the kernel had no reason to read."""
    digests = {}
    for name in set(evidence(root)).difference(outcome.files):
        try:
            digests[name] = sha256(read_file(root / name, MAX_BYTES)).hexdigest()
        except Malformed:
            digests[name] = "none"
    return digests


def _kernel() -> dict[str, str]:
    return {f"{KERNEL}/{name}": digest for name, digest in kernel_files().items()}
