"""The paper from abstract to discussion: every statement that can be decided, with its verdict.

A verdict is computed from what one run of the kernel has accepted. Nothing here is trusted for the
theorems; where a claim needs more than they say, the finding's evidence names what is recomputed.

One module for each section holds its claims: :mod:`opening`, :mod:`related` (section 2),
:mod:`combinatorial` (3), :mod:`geometrical` (4), :mod:`discussion` (5).
"""

from collections import Counter
from collections.abc import Sequence

from certify.audit import combinatorial, discussion, geometrical, opening, related
from certify.audit.claims import DECISIONS, Case, Claim, Decision, Finding, decide
from certify.kernel.check import Completeness, Verdict

__all__ = ["CLAIMS", "DECISIONS", "Decision", "Finding", "audit", "summary"]

CLAIMS: tuple[Claim, ...] = (
    *opening.ABSTRACT,
    *opening.INTRODUCTION,
    *opening.TABLE_1,
    *related.THE_CUBE,
    *related.FINITE_PRECISION,
    *combinatorial.DEFINITIONS,
    *combinatorial.TABLE_2,
    *combinatorial.BALLS,
    *combinatorial.BOUNDARY,
    *combinatorial.GRAPHS,
    *geometrical.REALIZATION,
    *geometrical.DEFINITIONS,
    *geometrical.FORMULATION,
    *geometrical.CONVEX,
    *geometrical.CAPTIONS,
    *geometrical.ONE_BY_ONE,
    *discussion.DISCUSSION,
    *discussion.MESH_TABLES,
)
"""All claims, in the order of the paper."""


def audit(verdicts: Sequence[Verdict], completeness: Sequence[Completeness]) -> list[Finding]:
    """Return a finding for every claim, decided by these verdicts."""
    case = Case(verdicts, completeness)
    return [decide(claim, case) for claim in CLAIMS]


def summary(findings: Sequence[Finding]) -> dict[str, int]:
    """Return how many findings have each verdict, those that none has included."""
    count = Counter(finding.verdict for finding in findings)
    return {decision: count[decision] for decision in DECISIONS}
