"""Forged final polynomials: multipliers, vertices and signs changed, inequalities dropped."""

from collections.abc import Callable
from random import Random

from certify.kernel.chirotope import QUADRUPLES
from certify.kernel.hexahedron import VERTICES
from certify.opinions.attack.corpus import Corpus, Draft, Forgery, Mutator, Record


def _multiplier(random: Random, polynomials: list[Record]) -> None:
    """A multiplier changes."""
    row = random.choice(random.choice(polynomials)["inequalities"])
    row[0] = random.choice((-row[0], 0, row[0] + 1, row[0] - 1, 2 * row[0], 10**30))


def _indices(random: Random, polynomials: list[Record]) -> None:
    """Two vertices of an inequality change places, or one is replaced."""
    _, six = random.choice(random.choice(polynomials)["inequalities"])
    i, j = random.sample(range(6), 2)
    if random.random() < 0.6:
        six[i], six[j] = six[j], six[i]
    else:
        six[i] = random.choice([v for v in VERTICES if v not in six])


def _sign(random: Random, polynomials: list[Record]) -> None:
    """A sign changes."""
    signs = random.choice(polynomials)["signs"]
    key = random.choice(list(signs))
    signs[key] = random.choice([sign for sign in (-1, 0, 1) if sign != signs[key]])


def _sign_dropped(random: Random, polynomials: list[Record]) -> None:
    """A sign is not assumed any more."""
    signs = random.choice(polynomials)["signs"]
    signs.pop(random.choice(list(signs)))


def _sign_added(random: Random, polynomials: list[Record]) -> None:
    """One more sign is assumed."""
    quadruple = "".join(map(str, random.choice(QUADRUPLES)))
    random.choice(polynomials)["signs"].setdefault(quadruple, random.choice((-1, 0, 1)))


def _inequality_dropped(random: Random, polynomials: list[Record]) -> None:
    """An inequality is missing, or all of them are."""
    rows = random.choice(polynomials)["inequalities"]
    rows.pop(random.randrange(len(rows)))
    if random.random() < 0.2:
        rows.clear()


def _inequality_doubled(random: Random, polynomials: list[Record]) -> None:
    """An inequality is there twice, or all of them are."""
    rows = random.choice(polynomials)["inequalities"]
    rows += random.choice(([random.choice(rows)], rows))


def _polynomial_dropped(random: Random, polynomials: list[Record]) -> None:
    """A polynomial is missing."""
    polynomials.pop(random.randrange(len(polynomials)))


def _polynomials_reordered(random: Random, polynomials: list[Record]) -> None:
    """The polynomials, or the signs of one, stand in another order."""
    record = random.choice(polynomials)
    record["signs"] = dict(random.sample(list(record["signs"].items()), len(record["signs"])))
    random.shuffle(polynomials)


_POLYNOMIALS: dict[str, Callable[[Random, list[Record]], None]] = {
    "multiplier changed": _multiplier,
    "vertices changed": _indices,
    "sign changed": _sign,
    "sign dropped": _sign_dropped,
    "sign added": _sign_added,
    "inequality dropped": _inequality_dropped,
    "inequality doubled": _inequality_doubled,
    "dropped": _polynomial_dropped,
    "reordered": _polynomials_reordered,
}


def _changing_polynomials(change: Callable[[Random, list[Record]], None]) -> Mutator:
    def forge(random: Random, corpus: Corpus) -> Forgery:
        name, question = random.choice(corpus.answers["polynomials"])
        draft = Draft.of(corpus, name, question)
        change(random, draft.record[question]["final_polynomials"])
        return draft.finished()

    return forge


KINDS: dict[str, Mutator] = {
    f"polynomial: {name}": _changing_polynomials(change) for name, change in _POLYNOMIALS.items()
}
"""Kind -> how one forgery of it is made."""
