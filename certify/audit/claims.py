"""The paper's claims: how claims.toml is read, and how a claim becomes a finding.

A record of the file states a verdict and gives reasons. The verdict is a claim of the file, no more
trusted than the paper: it stands iff every reason holds in the run at hand.
"""

import re
import tomllib
from collections import Counter
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import MISSING, dataclass, fields
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

    amendment: what is true instead (corrected, or argued), beyond it (strengthened), or in examples
    (illustrated); the reasons are then reasons for the amendment. argument: a reason in words,
    which nothing computes. undecided: why there is no verdict.
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


def load_shipped() -> tuple[Claim, ...]:
    """Read claims.toml."""
    return load((files("certify.audit") / "claims.toml").read_text(encoding="utf-8"))


def load(text: str) -> tuple[Claim, ...]:
    """Read claims, or raise :class:`BadClaims`."""
    try:
        data = tomllib.loads(text)
    except tomllib.TOMLDecodeError as error:
        raise BadClaims(f"not TOML: {error}") from None
    records = data.get("claim")
    if len(data) != 1 or not (isinstance(records, list) and all(type(r) is dict for r in records)):
        raise BadClaims("not a list of [[claim]], and nothing else")
    claims = []
    for number, record in enumerate(records, start=1):
        try:
            claims.append(_checked(Claim(**_values(record))))
        except BadClaims as error:
            name = record.get("id", "without id")
            raise BadClaims(f"claim {number} ({name}): {error}") from None
    for key in ("id", "claim"):
        for value, times in Counter(getattr(claim, key) for claim in claims).items():
            _require(times == 1, key, f"{value!r} occurs {times} times")
    return tuple(claims)


def _require(true: object, key: str, problem: str) -> None:
    if not true:
        raise BadClaims(f"{key}: {problem}")


_LISTS = ("theorems", "answers", "checks")
_KEYS = {field.name: field.default is MISSING for field in fields(Claim)}
"""Key -> whether every record has it."""


def _values(record: Mapping[str, object]) -> dict[str, Any]:
    """Return the fields of a claim, of the types that they should have."""
    for key, needed in _KEYS.items():
        _require(key in record or not needed, key, "is missing")
    values: dict[str, Any] = {}
    for key, value in record.items():
        _require(key in _KEYS, key, "is no key")
        texts: Any = value if key in _LISTS else [value]
        _require(isinstance(texts, list) and texts, key, "is not a list of strings")
        for text in texts:
            good = isinstance(text, str) and text.isascii() and text == " ".join(text.split()) != ""
            _require(good, key, f"{text!r} is not one line of ASCII")
        values[key] = tuple(texts) if key in _LISTS else value
    return values | {"answers": tuple(_answers(values.get("answers", ())))}


def _answers(texts: Sequence[str]) -> Iterator[str]:
    """Write "15_A 15_B convex = no" as "15_A convex = no", "15_B convex = no"."""
    for text in texts:
        match = re.fullmatch(r"((?:\w+ )+)(\w+) = (yes|no)", text)
        names = match[1].split() if match else []
        good = match and match[2] in QUESTIONS and set(names) <= set(PATTERN_NAMES)
        _require(good, "answers", f"{text!r} is not like '15_A convex = no'")
        yield from (text.replace(match[1], f"{name} ") for name in names if match)


_RULES = {
    "computed": (COMPUTED, COMPUTED),
    "amendment": (("corrected", "strengthened"), (*COMPUTED[1:], "argued")),
    "weight": (("corrected",), ("corrected",)),
    "argument": (("argued",), (*COMPUTED, "argued")),
    "undecided": ((UNDECIDED,), (UNDECIDED,)),
}
"""Key -> the verdicts that need it, and those that may have it."""


def _checked(claim: Claim) -> Claim:
    """Return a claim whose names are known, and that has what its verdict needs."""
    _require(re.fullmatch(r"[a-z0-9]+(-[a-z0-9]+)*", claim.id), "id", "is not like-this-1")
    known = {"theorems": THEOREMS, "checks": CHECKS, "verdict": VERDICTS, "weight": ("", *WEIGHTS)}
    for key, names in known.items():
        value = getattr(claim, key)
        for name in value if key in _LISTS else [value]:
            _require(name in names, key, f"{name!r} is none of {', '.join(filter(None, names))}")
    twice = [reason for reason, times in Counter(claim.computed).items() if times > 1]
    _require(not twice, "reasons", f"are given twice: {', '.join(twice)}")
    for key, (needed, allowed) in _RULES.items():
        present = bool(getattr(claim, key))
        what = "a theorem, an answer or a check" if key == "computed" else key
        _require(present or claim.verdict not in needed, what, f"is needed if {claim.verdict}")
        _require(not present or claim.verdict in allowed, what, f"is not for {claim.verdict}")
    return claim
