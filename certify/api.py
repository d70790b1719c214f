"""The library: what ``import certify`` offers. Everything is decided by the kernel.

A *root* is a folder with certificates/ and proofs/; by default it is the one that comes with the
code. What is wrong with an argument is told by a ValueError; a root that is no path at all is a
TypeError.
"""

import re
from collections.abc import Iterable
from dataclasses import dataclass
from fractions import Fraction
from itertools import islice
from numbers import Integral, Rational
from pathlib import Path
from typing import TypeVar

from certify.kernel.certificate import (
    MAX_DIGITS,
    PATTERN_NAMES,
    QUESTIONS,
    Certificate,
    No,
    Yes,
    read_certificate,
)
from certify.kernel.check import Verdict, check_answer, check_pattern
from certify.kernel.chirotope import Point
from certify.kernel.embedding import NotRealized
from certify.kernel.evidence import Evidence, Malformed, default_root
from certify.kernel.hexahedron import VERTICES, Simplex
from certify.kernel.orientations import Clause
from certify.kernel.refutation import NotRefuted
from certify.kernel.refutation import replay as kernel_replay
from certify.kernel.theorems import Outcome, Theorem
from certify.kernel.triangulation import orientation
from certify.report import claimed
from certify.run import run

__all__ = [
    "Malformed",
    "NotRealized",
    "NotRefuted",
    "Outcome",
    "Pattern",
    "Theorem",
    "Verdict",
    "check",
    "check_all",
    "load",
    "patterns",
    "replay",
    "require",
]

Coordinate = int | Rational | str
"""An integer, a fraction, or a string like "-3" or "1/2"."""

MAX_CLAUSES = 10_000_000
"""More clauses, or literals in one, are taken to be endless."""

T = TypeVar("T")

_EXACT = re.compile(r"-?[0-9]+(/0*[1-9][0-9]*)?", re.ASCII)


def patterns() -> tuple[str, ...]:
    """Return the names of the 174 patterns, in the order of the paper's Table 2.

    >>> len(patterns()), patterns()[0], patterns()[-1]
    (174, '5_A', '15_K')
    """
    return PATTERN_NAMES


@dataclass(frozen=True)
class Pattern:
    """A certificate as it is stored: what it claims, and its evidence.

    Nothing of it has been checked: that is what :func:`check` is for.
    """

    certificate: Certificate
    root: Path

    def __repr__(self) -> str:
        return f"<Pattern {self.name} below {self.root}>"

    @property
    def name(self) -> str:
        """The name, for instance 8_E."""
        return self.certificate.pattern

    @property
    def tetrahedra(self) -> tuple[Simplex, ...]:
        """The tetrahedra, each as an increasing quadruple of the vertices 1..8."""
        return self.certificate.tetrahedra

    @property
    def boundary(self) -> str:
        """The letter a..g of the boundary type."""
        return self.certificate.boundary

    @property
    def instances(self) -> int:
        """How many labelled triangulations the 48 symmetries of the hexahedron make of it."""
        return self.certificate.instances

    @property
    def answers(self) -> dict[str, str]:
        """For each of the three questions "yes", "no" or "open"."""
        return {question: claimed(answer) for question, answer in self.certificate.answers.items()}

    def points(self, question: str = "realizable") -> tuple[Point, ...] | None:
        """Return the eight points that show a yes, vertex 1 first, or None for another answer.

        >>> [int(x) for x in load("5_A").points()[6]]
        [1, 1, 1]
        """
        answer = self.certificate.answers[_question(question)]
        return answer.points if isinstance(answer, Yes) else None

    def proof(self, question: str = "realizable") -> str | None:
        """Return the LRAT text of the proof of a no, or None for another answer.

        Raises:
            Malformed: The proof cannot be read, or is not the one that the certificate names.

        >>> len(load("15_K").proof("valid").splitlines())
        1
        """
        answer = self.certificate.answers[_question(question)]
        if not isinstance(answer, No):
            return None
        return Evidence(self.root).proof(answer.proof, answer.digest)


def load(pattern: str, root: Path | str | None = None) -> Pattern:
    """Return the certificate of a pattern, unchecked.

    Raises:
        Malformed: There is no such file, or it is not a certificate.

    >>> eight = load("8_E")
    >>> eight.boundary, eight.instances, len(eight.tetrahedra)
    ('d', 48, 8)
    """
    folder = _root(root)
    content = Evidence(folder).certificate(_pattern(pattern))
    return Pattern(read_certificate(pattern, content), folder)


def check(pattern: str, root: Path | str | None = None) -> Verdict:
    """Return the kernel's verdict on the certificate of one pattern.

    ``verdict.fault`` is None if it was accepted, else it says why it was rejected.

    >>> verdict = check("15_A")
    >>> verdict.fault is None, verdict.answers["realizable"]
    (True, 'no')
    >>> verdict.rests_on("realizable")
    ('certificates/15_A.json', 'proofs/15_A.realizable.lrat')
    """
    return check_pattern(_root(root), _pattern(pattern))


def check_all(*, root: Path | str | None = None, jobs: int = 1) -> Outcome:
    """Return the verdicts on all certificates, and the theorems that they prove together.

    It takes a few seconds; ``jobs`` processes share the work, but never more than 61.

    Raises:
        ValueError: There is no such root, or jobs is not a positive integer.
        ChildProcessError: One of the processes was killed.

    >>> outcome = check_all()
    >>> outcome.ok, len(outcome.verdicts), sum(theorem.ok for theorem in outcome.theorems)
    (True, 174, 16)
    """
    if type(jobs) is not int or jobs < 1:
        raise ValueError(f"jobs is {_short(jobs)}, but it must be a positive integer")
    return run(_root(root), jobs)


def require(
    pattern: str,
    question: str,
    points: Iterable[Iterable[Coordinate]],
    root: Path | str | None = None,
) -> None:
    """Raise NotRealized, with the reason, unless the points show a yes for the pattern.

    Args:
        pattern: A name; its tetrahedra are read from its certificate.
        question: "realizable", "convex" or "valid".
        points: Eight points of three exact coordinates each, vertex 1 first: integers, fractions,
            or strings "p/q" of at most 80 characters. Floats are refused, since they seldom are
            the numbers that were meant.
        root: Where the certificate is.

    Raises:
        NotRealized: They do not show it.
        Malformed: The certificate has no triangulation that the kernel accepts.
        ValueError: There is no such pattern or question, or these are not eight exact points.

    >>> cube = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (1, 1, 1),
    ...         (0, 1, 1)]
    >>> require("5_A", "valid", cube)
    >>> require("7_A", "realizable", cube)
    Traceback (most recent call last):
    ...
    certify.kernel.embedding.NotRealized: tetrahedron 2368 is inverted
    """
    given = _items(points, len(VERTICES), "the points")
    if len(given) != len(VERTICES):
        raise ValueError(f"there are {len(given)} points instead of eight")
    exact = tuple(_point(vertex, point) for vertex, point in enumerate(given, start=1))
    verdict = check(pattern, root)
    if verdict.certificate is None or not verdict.instances:
        raise Malformed(verdict.fault)
    signs = orientation(verdict.certificate.tetrahedra)
    check_answer(_question(question), Yes(exact), signs, Evidence(_root(root)))


def replay(clauses: Iterable[Iterable[int]], proof: str) -> int:
    r"""Return in how many steps an LRAT proof refutes a formula, or raise NotRefuted.

    Steps are replayed by unit propagation, as for the proofs of certify; the RAT rule is outside.

    Args:
        clauses: The formula; a clause is some non-zero integers, -3 for "not 3". They are numbered
            from 1.
        proof: The text of an LRAT file.

    Raises:
        NotRefuted: It does not; the message says where.
        ValueError: These are not clauses, or more than ten million, or the proof is not a text.

    >>> replay([(1, 2), (-1, 2), (1, -2), (-1, -2)], "5 2 0 1 2 0\n6 0 5 3 4 0\n")
    2
    """
    if not isinstance(proof, str):
        raise ValueError(f"the proof is a {type(proof).__name__}, not a text")
    given = _items(clauses, MAX_CLAUSES, "the formula")
    return kernel_replay([_clause(*item) for item in enumerate(given, start=1)], proof)


def _items(given: Iterable[T], most: int, what: str) -> tuple[T, ...]:
    """Return what is given one by one, but no more than ``most`` items: it may have no end.

    Bytes have items too, integers even, but whoever gives them means something else.
    """
    if isinstance(given, str | bytes | bytearray) or not isinstance(given, Iterable):
        raise ValueError(f"{what}: {_short(given)} is not a list")
    items = tuple(islice(given, most + 1))
    if len(items) > most:
        raise ValueError(f"{what}: there are more than {most}")
    return items


def _short(value: object) -> str:
    """Return a value as a message shows it."""
    return f"{value!a:.80}"


def _clause(number: int, clause: Iterable[int]) -> Clause:
    literals = _items(clause, MAX_CLAUSES, f"clause {number}")
    if not all(isinstance(x, Integral) and not isinstance(x, bool) and x for x in literals):
        raise ValueError(f"clause {number} is {_short(clause)}, not some non-zero integers")
    return tuple(map(int, literals))


def _root(root: Path | str | None) -> Path:
    folder = default_root() if root is None else Path(root)
    try:
        if (folder / "certificates").is_dir():
            return folder
    except OSError as error:
        raise ValueError(f"{_short(str(folder))} cannot be used: {error.strerror}") from None
    raise ValueError(f"{folder} has no folder certificates")


def _pattern(name: str) -> str:
    if name not in PATTERN_NAMES:
        raise ValueError(f"unknown pattern {_short(name)}; certify.patterns() lists them")
    return name


def _question(name: str) -> str:
    if name not in QUESTIONS:
        raise ValueError(
            f"unknown question {_short(name)}; it must be one of {', '.join(QUESTIONS)}"
        )
    return name


def _point(vertex: int, point: Iterable[Coordinate]) -> Point:
    given = _items(point, 3, f"vertex {vertex}")
    if len(given) != 3:
        raise ValueError(f"vertex {vertex} has {len(given)} coordinates instead of three")
    return tuple(_coordinate(vertex, value) for value in given)


def _coordinate(vertex: int, value: Coordinate) -> Fraction:
    if isinstance(value, str) and len(value) <= 2 * MAX_DIGITS and _EXACT.fullmatch(value):
        return Fraction(value)
    if isinstance(value, Rational) and not isinstance(value, bool):
        return Fraction(int(value.numerator), int(value.denominator))
    raise ValueError(
        f"vertex {vertex}: {_short(value)} is not exact; "
        "give an integer, a Fraction, or a string p/q of at most 80 characters"
    )
