"""What is fuzzed: certificates, a proof of a no, and formulas with a proof of any kind.

What the kernel accepts is judged as forgeries are: by code that takes nothing from it. Its check
must not break off, and a certificate or a formula must read the same when it is written again.
"""

import json
import re
import sys
from collections.abc import Callable, Iterator
from hashlib import sha256
from pathlib import Path
from typing import Any, NamedTuple

import atheris

READERS = ["certify.dimacs", *(f"certify.kernel.{m}" for m in ("certificate", "refutation"))]

with atheris.instrument_imports(include=READERS):
    from certify.dimacs import read_dimacs, write_dimacs
    from certify.kernel.certificate import QUESTIONS, Certificate, No, Yes, read_certificate
    from certify.kernel.evidence import Evidence, Malformed, default_root
    from certify.kernel.refutation import NotRefuted, replay
    from certify.kernel.theorems import check_all
    from certify.opinions.attack.campaign import formulas_kept
    from certify.opinions.attack.corpus import Corpus, Forgery, read_corpus
    from certify.opinions.attack.judge import Judge
    from certify.opinions.rup import proof_fault
    from certify.report import claim_record, coordinates

SIZE = 1 << 14
"""Inputs are at most so long: longer ones reach no other code, and take more time."""

LIMITS = {"max_len": SIZE, "timeout": 10, "rss_limit_mb": 1024, "seed": 1}
"""For libFuzzer; a timeout, in seconds for one input, is a finding, and so is too much memory."""

SEEDS = ("5_A", "8_E", "11_AD", "12_U", "15_A", "15_E", "15_G", "15_K")
"""Patterns with answers of all kinds; 15_K has a no with few clauses, whose proof is fuzzed."""


class Wrong(Exception):
    """A target did what it must not do."""


class Target(NamedTuple):
    """How it is fed, what the first inputs are, and the words that inputs are made of."""

    feed: Callable[[Judge], Callable[[bytes], None]]
    seeds: Callable[[Corpus], Iterator[bytes]]
    words: str


def judged(judge: Judge, forgery: Forgery) -> None:
    """Raise Wrong if something false is accepted, or the check breaks off."""
    outcome, reason = judge.outcome(forgery)
    if outcome not in ("refused", "true"):
        raise Wrong(f"{outcome}: {reason}")


# Certificates


def certificates(judge: Judge) -> Callable[[bytes], None]:
    """Feed certificates, with the shipped proofs."""

    def feed(content: bytes) -> None:
        found = re.search(rb'"pattern":\s*"([0-9]+_[A-Z]+)"', content)
        pattern = found[1].decode() if found else "5_A"
        shipped = judge.corpus.proofs
        proofs = {path: text.encode() for path, text in shipped.items() if path.encode() in content}
        judged(judge, Forgery(pattern, content, proofs))
        try:
            certificate = read_certificate(pattern, content)
        except Malformed:
            return
        if read_certificate(pattern, written(certificate)) != certificate:
            raise Wrong("it reads otherwise when it is written again")

    return feed


def written(certificate: Certificate) -> bytes:
    """Return a certificate as FORMAT.md says."""
    record: dict[str, Any] = claim_record(certificate) | {
        "format": "certify-pattern/1",
        "tetrahedra": certificate.tetrahedra,
    }
    for question, answer in certificate.answers.items():
        record[question] = {"answer": record[question]}
        if isinstance(answer, Yes):
            record[question]["points"] = coordinates(answer.points)
        if isinstance(answer, No):
            record[question] |= {
                "proof": answer.proof,
                "sha256": answer.digest,
                "final_polynomials": [
                    {
                        "signs": {"".join(map(str, q)): sign for q, sign in p.signs.items()},
                        "inequalities": p.inequalities,
                    }
                    for p in answer.final_polynomials
                ],
            }
    return json.dumps(record).encode()


# Proofs


def refutations(judge: Judge) -> Callable[[bytes], None]:
    """Feed the proof of a no, with its SHA-256 in the certificate."""
    record = judge.corpus.record("15_K")
    record |= {question: {"answer": "open"} for question in QUESTIONS if question != "valid"}

    def feed(content: bytes) -> None:
        record["valid"]["sha256"] = sha256(content).hexdigest()
        proofs = {record["valid"]["proof"]: content}
        judged(judge, Forgery("15_K", json.dumps(record).encode(), proofs))

    return feed


def replays(_: Judge) -> Callable[[bytes], None]:
    """Feed a formula and a proof, with a percent sign between them."""

    def feed(content: bytes) -> None:
        formula, _, proof = content.decode("latin-1").partition("%")
        try:
            clauses = read_dimacs(formula)
            if read_dimacs(write_dimacs(clauses)) != clauses:
                raise Wrong("it reads otherwise when it is written again")
            replay(clauses, proof)
        except (Malformed, NotRefuted):
            return
        if fault := proof_fault(clauses, set(map(frozenset, clauses)), proof):
            raise Wrong(f"false: {fault}")

    return feed


TARGETS = {
    "certificate": Target(
        certificates,
        lambda corpus: (corpus.certificates[name] for name in SEEDS),
        '[ ] { } , : "yes" "no" "open" "1/2" "-7/3" -1 1e9 NaN null true "format" "pattern" '
        '"boundary" "instances" "tetrahedra" "realizable" "convex" "valid" "answer" "points" '
        '"proof" "sha256" "final_polynomials" "signs" "inequalities" "1234" \\ud800 0000000',
    ),
    "proof": Target(
        refutations,
        lambda corpus: (t.encode() for t in corpus.proofs.values() if len(t) <= SIZE),
        "0 00 - d 0\n0 1 -1",
    ),
    "replay": Target(
        replays,
        lambda _: iter(
            (
                b"p cnf 0 0\n%",
                b"c so\np cnf 1 2\n1 0 -1\n0\n%3 0 1 2 0\n",
                b"p cnf 2 4\n1 2 0\n1 -2 0\n-1 2 0\n-1 -2 0\n%5 1 0 1 2 0\n5 d 1 0\n6 0 5 3 4 0\n",
            )
        ),
        "p cnf c % 0 00 - d 0\n0 1 -1",
    ),
}


def main(name: str, folder: str, findings: str, seconds: str, runs: str) -> None:
    """Be fed until the time is up, then libFuzzer ends the process; the folder is for inputs."""
    target, root = TARGETS[name], default_root()
    corpus = read_corpus(check_all(root), Evidence(root))
    for number, seed in enumerate(target.seeds(corpus)):
        Path(folder, str(number)).write_bytes(seed)
    words = Path(folder, "words")
    words.write_text("".join(map(quoted, target.words.split(" "))))
    options = {"max_total_time": seconds, "runs": runs, "dict": words, **LIMITS}
    options["artifact_prefix"] = f"{findings}/"
    arguments = (f"-{key}={value}" for key, value in options.items())
    with formulas_kept():
        atheris.Setup([sys.argv[0], folder, *arguments], target.feed(Judge(corpus)))
        atheris.Fuzz()


def quoted(word: str) -> str:
    """Return a line of libFuzzer's dictionary."""
    return '"' + "".join(f"\\x{ord(char):02x}" for char in word) + '"\n'


if __name__ == "__main__":
    main(*sys.argv[1:])
