"""Replay of a clausal proof, and final polynomials as further clauses.

A refutation of a formula is an LRAT file (Cruz-Filipe, Heule, Hunt, Kaufmann and Schneider-Kamp
2017) without the RAT rule, so that every step is a logical consequence. A line

    7041 -3 12 0 5 901 33 0       adds clause 7041, -3 or 12, by the clauses 5, 901, 33;
    7041 d 5 901 0                forgets clauses 5 and 901.

The clauses of the formula are numbered from 1 in the order in which the kernel writes them.
"""

import re
from collections import Counter
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import TypeAlias

from certify.kernel.hexahedron import Simplex, simplex, sorted_with_sign
from certify.kernel.orientations import Clause, has_sign

Brackets: TypeAlias = tuple[tuple[int, ...], tuple[int, ...]]
"""Two determinants that are multiplied, each given by four vertices in some order."""

_STEP = re.compile(
    r"([1-9][0-9]{0,8}) (?:(d )|((?:-?[1-9][0-9]{0,8} )*+)0 )((?:[1-9][0-9]{0,8} )*+)0", re.ASCII
)
"""Number, then "d" or literals and 0, then hints (or numbers to delete) and 0.

A repetition is never tried shorter (``*+``): a 0 ends it. So a long line costs no memory.
"""


class NotRefuted(ValueError):
    """The proof does not show that the formula is unsatisfiable; the message says where."""


def replay(formula: Sequence[Clause], proof: str) -> int:
    """Raise :class:`NotRefuted` unless ``proof`` derives the empty clause; return its steps.

    Lemma (reverse unit propagation, Goldberg and Novikov 2003). Let every literal of a clause C be
    false. If going through the hints each has all literals false but one, which is thereby made
    true, and a last one has all literals false, then C follows from the hints. Hence each
    added clause follows from the formula, and the empty clause makes it unsatisfiable.
    """
    clauses = dict(enumerate(formula, start=1))
    last = len(clauses)
    lines = proof.removesuffix("\n").split("\n")
    for steps, line in enumerate(lines, start=1):
        try:
            number, deletes, clause, hints = _read_line(line)
            if deletes:
                for hint in hints:
                    del clauses[hint]
                continue
            if number <= last:
                raise NotRefuted(f"clause number {number} is not larger than {last}")
            _require_distinct(map(abs, clause), "variable")
            _require_distinct(hints, "hint")
            _require_implied(clause, [clauses[hint] for hint in hints])
        except KeyError as error:
            raise NotRefuted(f"line {steps}: there is no clause {error.args[0]}") from None
        except NotRefuted as error:
            raise NotRefuted(f"line {steps}: {error}") from None
        if not clause and steps < len(lines):
            raise NotRefuted(f"line {steps + 1}: the proof goes on after the empty clause")
        if not clause:
            return steps
        clauses[number], last = clause, number
    raise NotRefuted("the proof ends without the empty clause")


def _read_line(line: str) -> tuple[int, bool, Clause, Clause]:
    """Return (number, is it a deletion, literals, hints or numbers to delete) of one line."""
    match = _STEP.fullmatch(line)
    if match is None and "-" in line.partition(" 0 ")[2] and not line.strip("-0123456789 "):
        raise NotRefuted("a hint is negative: RAT steps are outside this format")
    if match is None and "\0" in line:
        raise NotRefuted("the binary form of LRAT is outside this format")
    if match is None:
        raise NotRefuted("not a step in the LRAT format")
    number, deletes, literals, hints = match.groups(default="")
    return int(number), bool(deletes), _numbers(literals), _numbers(hints)


def _require_distinct(numbers: Iterable[int], what: str) -> None:
    """Raise :class:`NotRefuted` if a number occurs twice.

    Needed for speed alone. A hint of k literals asks for k literals in the clause and the hints
    before it. If neither repeats, a file of n numbers is therefore replayed by looking at literals
    at most about n^1.5 times.
    """
    seen = Counter(numbers)
    if len(seen) < seen.total():
        twice = max(seen, key=seen.__getitem__)
        raise NotRefuted(f"{what} {twice} occurs {seen[twice]} times")


def _numbers(text: str) -> Clause:
    return tuple(map(int, text.split()))


def _require_implied(clause: Clause, hints: Sequence[Clause]) -> None:
    """Raise :class:`NotRefuted` unless the hints, in this order, propagate to a contradiction."""
    false = set(clause)
    for position, hint in enumerate(hints, start=1):
        remaining = {literal for literal in hint if literal not in false}
        if not remaining:
            return
        if len(remaining) > 1:
            raise NotRefuted(f"hint {position} has {len(remaining)} literals that are not false")
        false.add(-remaining.pop())
    raise NotRefuted("the hints do not reach a contradiction")


@dataclass(frozen=True)
class FinalPolynomial:
    """Signs that no eight points have, with the reason (Bokowski and Richter 1990).

    signs: quadruple -> assumed sign of its determinant, -1, 0 or 1.
    inequalities: (multiplier, (s, t, a, b, c, d)), read |[stab][stcd]| >= |[stac][stbd]|.
    """

    signs: Mapping[Simplex, int]
    inequalities: tuple[tuple[int, tuple[int, ...]], ...]


def excluded_signs(polynomial: FinalPolynomial) -> Clause:
    """Return the clause "not all of these signs", or raise :class:`NotRefuted`.

    Write A = [stab][stcd], B = [stac][stbd], C = [stad][stbc]; the Grassmann-Pluecker relation is
    A = B - C. If B is not zero, and C has not its sign, then |A| = |B| + |C|: the inequality
    |A| >= |B| holds, strictly unless C = 0, and A is not zero. Let every inequality follow from
    the assumed signs in this way, and one of them strictly. Multiplied together, each as often as
    its multiplier says, they give "product of the |A| > product of the |B|" between non-zero
    numbers. If every determinant occurs equally often on both sides, this is absurd.
    """
    surplus: Counter[Simplex] = Counter()
    strict = False
    for multiplier, indices in polynomial.inequalities:
        if multiplier <= 0:
            raise NotRefuted(f"multiplier {multiplier} is not positive")
        larger, smaller, rest = products(indices)
        sign = _product_sign(smaller, polynomial.signs)
        sign_rest = _product_sign(rest, polynomial.signs)
        if sign in (0, sign_rest):
            raise NotRefuted(f"the signs do not imply the inequality of {indices}")
        strict = strict or sign_rest != 0
        for vertices in larger:
            surplus[simplex(vertices)] += multiplier
        for vertices in smaller:
            surplus[simplex(vertices)] -= multiplier
    if not strict or any(surplus.values()):
        raise NotRefuted("the inequalities do not multiply to a contradiction")
    return tuple(
        literal
        for quadruple, sign in polynomial.signs.items()
        for literal in (
            (-has_sign(quadruple, sign),)
            if sign
            else (has_sign(quadruple, 1), has_sign(quadruple, -1))
        )
    )


def products(indices: tuple[int, ...]) -> tuple[Brackets, Brackets, Brackets]:
    """Return the brackets of A, B and C, as above, for indices (s, t, a, b, c, d)."""
    s, t, a, b, c, d = indices
    return (
        ((s, t, a, b), (s, t, c, d)),
        ((s, t, a, c), (s, t, b, d)),
        ((s, t, a, d), (s, t, b, c)),
    )


def _product_sign(brackets: Brackets, signs: Mapping[Simplex, int]) -> int:
    """Return the sign of a product of brackets; one zero factor is enough for zero."""
    factors = [sorted_with_sign(vertices) for vertices in brackets]
    if any(signs.get(quadruple) == 0 for quadruple, _ in factors):
        return 0
    result = 1
    for quadruple, parity in factors:
        if quadruple not in signs:
            raise NotRefuted(f"no sign is assumed for {quadruple}")
        result *= parity * signs[quadruple]
    return result
