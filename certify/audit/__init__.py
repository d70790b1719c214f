"""The referee's list: what the paper claims, as data, and a verdict on each claim.

claims.toml has one record for each claim, in the order of the paper: the exact place, the claim in
our words, a verdict, and the reasons for it (see :mod:`certify.audit.claims`). A verdict stands if
every reason that can be computed holds in the run at hand, and only then. What a claim needs beyond
theorems and accepted answers is a named check, in :mod:`certify.audit.checks` or
:mod:`certify.audit.pattern_checks`. Nothing here is trusted for the theorems.
"""

from collections import Counter
from collections.abc import Iterable

from certify.audit import pattern_checks  # noqa: F401 (registers its checks)
from certify.audit.checks import CHECKS
from certify.audit.claims import (
    VERDICTS,
    WEIGHTS,
    Accepted,
    BadClaims,
    Claim,
    Finding,
    decide,
    load_shipped,
)
from certify.kernel.theorems import Outcome

__all__ = [
    "CHECKS",
    "VERDICTS",
    "WEIGHTS",
    "BadClaims",
    "Claim",
    "Finding",
    "audit",
    "corrections",
    "load_shipped",
    "summary",
]


def audit(outcome: Outcome) -> list[Finding]:
    """Return a finding for every claim, in the order of the paper."""
    accepted = Accepted(outcome)
    return [decide(claim, accepted.holds) for claim in load_shipped()]


def summary(findings: Iterable[Finding]) -> dict[str, int]:
    """Return how many findings have each verdict, those that none has included."""
    count = Counter(finding.verdict for finding in findings)
    return {verdict: count[verdict] for verdict in VERDICTS}


def corrections(findings: Iterable[Finding]) -> list[Finding]:
    """Return the corrected claims by weight, the heaviest first, else in the order of the paper."""
    corrected = [finding for finding in findings if finding.verdict == "corrected"]
    return sorted(corrected, key=lambda finding: WEIGHTS.index(finding.weight))
