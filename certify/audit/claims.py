"""The paper's claims: how claims.toml is read, and how a claim becomes a finding.

A record of the file states a verdict and gives reasons. The verdict is a claim of the file, no more
trusted than the paper: it stands iff every reason holds in the run at hand.
"""

import re
import tomllib
from collections import Counter
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, fields
from importlib.resources import files
from typing import Any

from certify.audit.checks import CHECKS, Inputs
from certify.kernel.certificate import PATTERN_NAMES, QUESTIONS
from certify.kernel.theorems import Outcome, theorems

COMPUTED = ("confirmed", "corrected", "strengthened", "illustrated")
"""Verdicts that need a computed reason: a theorem, an answer, or a check."""

UNDECIDED = "not decided here"
VERDICTS = (*COMPUTED, "argued", UNDECIDED)

WEIGHTS = ("mathematics", "table", "misprint", "wording")
"""Of corrections, the heaviest first."""

THEOREMS = tuple(theorem.id for theorem in theorems((), ()))


class BadClaims(ValueError):
    """The file of claims is not as it should be; the message names the record and the key."""


@dataclass(frozen=True)
class Claim:
    """One record of claims.toml: what the paper says where, a verdict, and the reasons for it.

    amendment: what is true instead (corrected, or argued) or beyond it (strengthened); the reasons
    are then reasons for the amendment. argument: a reason in words, which nothing computes.
    undecided: why there is no verdict.
    """

    id: str
    place: str
    claim: str
    verdict: str
    amendment: str = ""
    weight: str = ""
    theorems: tuple[str, ...] = ()
    answers: tuple[str, ...] = ()
    checks: tuple[str, ...] = ()
    argument: str = ""
    undecided: str = ""

    @property
    def computed(self) -> tuple[str, ...]:
        """The reasons that a run decides."""
        return (
            *(f"theorem {name}" for name in self.theorems),
            *self.answers,
            *(f"check {name}" for name in self.checks),
        )


@dataclass(frozen=True)
class Finding:
    """What became of one claim in one run.

    reasons: all that the verdict rests on; failed: those among them that did not hold, because of
    which the claim is not decided and nothing is amended.
    """

    id: str
    place: str
    claim: str
    verdict: str
    amendment: str
    weight: str
    reasons: tuple[str, ...]
    failed: tuple[str, ...]


class Accepted:
    """What one run has accepted: does a computed reason hold in it? Each check is run once."""

    def __init__(self, outcome: Outcome) -> None:
        self.inputs = Inputs({v.pattern: v for v in outcome.verdicts if v.instances})
        self._known = {f"theorem {theorem.id}": theorem.ok for theorem in outcome.theorems}

    def holds(self, reason: str) -> bool:
        """Is the theorem shown, was exactly this answer accepted, or is the check true?"""
        if reason not in self._known:
            self._known[reason] = self._decide(*reason.split())
        return self._known[reason]

    def _decide(self, first: str, second: str, *answer: str) -> bool:
        if first == "check":
            return CHECKS[second](self.inputs)
        verdict = self.inputs.patterns.get(first)
        return verdict is not None and verdict.answers[second] == answer[-1]


def decide(claim: Claim, holds: Callable[[str], bool]) -> Finding:
    """Return the finding: the stated verdict, unless a computed reason does not hold."""
    failed = tuple(reason for reason in claim.computed if not holds(reason))
    words = [f"in words: {claim.argument}"] if claim.argument else []
    words += [f"undecided: {claim.undecided}"] if claim.undecided else []
    return Finding(
        claim.id,
        claim.place,
        claim.claim,
        UNDECIDED if failed else claim.verdict,
        "" if failed else claim.amendment,
        "" if failed else claim.weight,
        (*claim.computed, *words),
        failed,
    )


def load(text: str) -> tuple[Claim, ...]:
    """Read claims, or raise :class:`BadClaims`."""
    try:
        data = tomllib.loads(text)
    except tomllib.TOMLDecodeError as error:
        raise BadClaims(f"not TOML: {error}") from None
    if data.keys() != {"claim"}:
        raise BadClaims(f"not a list of [[claim]]: {sorted(data)}")
    claims = tuple(_claim(number, record) for number, record in enumerate(data["claim"], start=1))
    for key in ("id", "claim"):
        for value, times in Counter(getattr(claim, key) for claim in claims).items():
            if times > 1:
                raise BadClaims(f"{key}: {value!r} occurs {times} times")
    return claims


def load_shipped() -> tuple[Claim, ...]:
    """Read claims.toml."""
    return load((files("certify.audit") / "claims.toml").read_text(encoding="utf-8"))


def _claim(number: int, record: dict[str, object]) -> Claim:
    """Check one record, and return its claim."""
    where = f"claim {number} ({record.get('id', 'without id')})"

    def require(true: object, key: str, problem: str) -> None:
        if not true:
            raise BadClaims(f"{where}: {key}: {problem}")

    for key in ("id", "place", "claim", "verdict"):
        require(key in record, key, "is missing")
    values: dict[str, Any] = {}
    for key, value in record.items():
        require(key in _KEYS, key, "is no key")
        if key in _LISTS:
            is_list = isinstance(value, list) and value and all(isinstance(v, str) for v in value)
            require(is_list, key, "is not a list of strings")
            values[key] = tuple(value) if isinstance(value, list) else ()
        else:
            is_text = isinstance(value, str) and value == " ".join(value.split()) != ""
            require(is_text and str(value).isascii(), key, "is not one line of ASCII")
            values[key] = value
    values["answers"] = tuple(_answers(where, values.get("answers", ())))
    claim = Claim(**values)
    require(re.fullmatch(r"[a-z0-9]+(-[a-z0-9]+)*", claim.id), "id", "is not like-this-1")
    require(claim.verdict in VERDICTS, "verdict", f"{claim.verdict!r} is none of {VERDICTS}")
    for name in claim.theorems:
        require(name in THEOREMS, "theorems", f"there is no theorem {name!r}")
    for name in claim.checks:
        require(name in CHECKS, "checks", f"there is no check {name!r}")
    twice = [reason for reason, times in Counter(claim.computed).items() if times > 1]
    require(not twice, "reasons", f"are given twice: {twice}")
    for key, (needed, allowed) in _RULES.items():
        present = bool(getattr(claim, key))
        require(present or claim.verdict not in needed, key, f"is needed if {claim.verdict}")
        require(not present or claim.verdict in allowed, key, f"is not for {claim.verdict}")
    require(claim.weight in ("", *WEIGHTS), "weight", f"{claim.weight!r} is none of {WEIGHTS}")
    return claim


_LISTS = ("theorems", "answers", "checks")
_KEYS = {field.name for field in fields(Claim)}
_RULES = {
    "computed": (COMPUTED, COMPUTED),
    "amendment": (("corrected", "strengthened"), ("corrected", "strengthened", "argued")),
    "weight": (("corrected",), ("corrected",)),
    "argument": (("argued",), (*COMPUTED, "argued")),
    "undecided": ((UNDECIDED,), (UNDECIDED,)),
}
"""Key -> the verdicts that need it, and those that may have it."""


def _answers(where: str, texts: Sequence[str]) -> Iterator[str]:
    """Write "15_A 15_B convex = no" as "15_A convex = no", "15_B convex = no"."""
    for text in texts:
        *names, question, equals, answer = text.split() if text.count(" ") > 2 else [""] * 4
        if not (
            set(names) <= set(PATTERN_NAMES)
            and question in QUESTIONS
            and (equals, answer) in (("=", "yes"), ("=", "no"))
        ):
            raise BadClaims(f"{where}: answers: {text!r} is not like '15_A convex = no'")
        yield from (f"{name} {question} = {answer}" for name in names)
