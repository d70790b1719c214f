"""All kinds of forgeries: each is a shipped certificate, proof or list with one thing changed."""

from random import Random

from certify.opinions.attack import answers, points, polynomials, proofs, tetrahedra, text
from certify.opinions.attack.corpus import Corpus, ForgedList, Forgery, Mutator

KINDS: dict[str, Mutator] = (
    points.KINDS | tetrahedra.KINDS | answers.KINDS | proofs.KINDS | polynomials.KINDS | text.KINDS
)
"""Kind -> how one forgery of it is made."""

SCHEDULE: tuple[str, ...] = tuple(
    kind for turn in range(4) for kind in KINDS if turn == 0 or "completeness" not in kind
)
"""The kinds in turn; the proofs of completeness are long, and come less often."""


def forge(corpus: Corpus, seed: int, number: int) -> tuple[str, Forgery | ForgedList]:
    """Return the kind of a forgery, and the forgery."""
    kind = SCHEDULE[number % len(SCHEDULE)]
    return kind, KINDS[kind](Random(f"{seed}/{number}"), corpus)
