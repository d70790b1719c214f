"""Forged tetrahedra: flipped, exchanged, dropped, doubled, relabelled; and forged claims.

A flip leads to another triangulation, so some of these are true.
"""

from collections.abc import Callable
from contextlib import suppress
from itertools import combinations
from random import Random

from certify.kernel.certificate import PATTERN_NAMES
from certify.kernel.check import Tetrahedra
from certify.kernel.chirotope import QUADRUPLES
from certify.kernel.hexahedron import SYMMETRIES, VERTICES, boundary_letter, image
from certify.kernel.triangulation import NotATriangulation, boundary_diagonals, orbit
from certify.opinions.attack.corpus import Corpus, Draft, Forgery, Mutator, size


def _flipped(random: Random, tetrahedra: list[tuple[int, ...]], _: Corpus) -> Tetrahedra:
    """A bistellar move: two tetrahedra become three, or three become two."""
    moves = []
    for five in combinations(VERTICES, 5):
        inside = {q for q in combinations(five, 4) if q in tetrahedra}
        if len(inside) in (2, 3):
            moves.append((inside, set(combinations(five, 4)) - inside))
    if not moves:
        return tuple(tetrahedra)
    old, new = random.choice(moves)
    return tuple(set(tetrahedra) - old | new)


def _exchanged(random: Random, tetrahedra: list[tuple[int, ...]], _: Corpus) -> Tetrahedra:
    """Another quadruple takes the place of a tetrahedron."""
    tetrahedra[random.randrange(len(tetrahedra))] = random.choice(QUADRUPLES)
    return tuple(tetrahedra)


def _added(random: Random, tetrahedra: list[tuple[int, ...]], _: Corpus) -> Tetrahedra:
    """One more quadruple is a tetrahedron."""
    return (*tetrahedra, random.choice(QUADRUPLES))


def _dropped(random: Random, tetrahedra: list[tuple[int, ...]], _: Corpus) -> Tetrahedra:
    """A tetrahedron is missing."""
    tetrahedra.pop(random.randrange(len(tetrahedra)))
    return tuple(tetrahedra)


def _doubled(random: Random, tetrahedra: list[tuple[int, ...]], _: Corpus) -> Tetrahedra:
    """A tetrahedron stands in the list twice."""
    return (*tetrahedra, random.choice(tetrahedra))


def _moved(random: Random, tetrahedra: list[tuple[int, ...]], _: Corpus) -> Tetrahedra:
    """A symmetry relabels the tetrahedra, but not the points or the proof."""
    symmetry = random.choice(SYMMETRIES)
    return tuple(image(symmetry, tetrahedron) for tetrahedron in tetrahedra)


def _permuted(random: Random, tetrahedra: list[tuple[int, ...]], _: Corpus) -> Tetrahedra:
    """Some permutation relabels the tetrahedra."""
    permutation = list(VERTICES)
    if random.random() < 0.5:  # two vertices exchanged
        v, w = random.sample(range(8), 2)
        permutation[v], permutation[w] = permutation[w], permutation[v]
    else:
        random.shuffle(permutation)
    return tuple(image(tuple(permutation), tetrahedron) for tetrahedron in tetrahedra)


def _of_another(random: Random, _: list[tuple[int, ...]], corpus: Corpus) -> Tetrahedra:
    """The tetrahedra are those of another pattern."""
    record = corpus.record(random.choice(PATTERN_NAMES))
    return tuple(map(tuple, record["tetrahedra"]))


def _mixed(random: Random, tetrahedra: list[tuple[int, ...]], corpus: Corpus) -> Tetrahedra:
    """Some tetrahedra come from another pattern."""
    other = _of_another(random, tetrahedra, corpus)
    cut = random.randrange(len(tetrahedra))
    return (*tetrahedra[:cut], *other[cut:])


_TETRAHEDRA: dict[str, Callable[[Random, list[tuple[int, ...]], Corpus], Tetrahedra]] = {
    "flipped": _flipped,
    "exchanged": _exchanged,
    "added": _added,
    "dropped": _dropped,
    "doubled": _doubled,
    "moved by a symmetry": _moved,
    "permuted": _permuted,
    "of another pattern": _of_another,
    "mixed": _mixed,
}


def _changing_tetrahedra(
    change: Callable[[Random, list[tuple[int, ...]], Corpus], Tetrahedra],
) -> Mutator:
    """The name, the boundary and the class are made to fit the new tetrahedra where they can."""

    def forge(random: Random, corpus: Corpus) -> Forgery:
        name, question = random.choice(corpus.answers[random.choice(("yes", "no"))])
        draft = Draft.of(corpus, name, question)
        tetrahedra = change(random, [tuple(t) for t in draft.record["tetrahedra"]], corpus)
        tetrahedra = tuple(sorted(tetrahedra))
        draft.record |= {"tetrahedra": tetrahedra, "instances": len(orbit(tetrahedra))}
        fitting = [n for n in PATTERN_NAMES if size(n) == str(len(tetrahedra))]
        if name not in fitting:
            draft.rename(random.choice(fitting or [name]))
        with suppress(NotATriangulation):
            draft.record["boundary"] = boundary_letter(boundary_diagonals(tetrahedra))
        return draft.finished()

    return forge


def _carried(random: Random, corpus: Corpus) -> Forgery:
    """A symmetry relabels the tetrahedra and carries the points along."""
    name, question = random.choice(corpus.answers["yes"])
    draft = Draft.of(corpus, name, question)
    symmetry, points = random.choice(SYMMETRIES), draft.record[question]["points"]
    draft.record["tetrahedra"] = sorted(image(symmetry, t) for t in draft.record["tetrahedra"])
    draft.record[question]["points"] = [points[symmetry.index(v)] for v in VERTICES]
    return draft.finished()


def _claimed(random: Random, corpus: Corpus) -> Forgery:
    """The certificate states another name, boundary or size of the class."""
    draft = Draft.of(corpus, random.choice(PATTERN_NAMES))
    key, value = random.choice(
        (
            ("pattern", random.choice(PATTERN_NAMES)),
            ("boundary", random.choice("abcdefgh")),
            ("instances", random.choice((1, 2, 4, 8, 12, 16, 24, 48, 96))),
        )
    )
    draft.record[key] = value
    return draft.finished()


KINDS: dict[str, Mutator] = {
    **{f"tetrahedra: {n}": _changing_tetrahedra(change) for n, change in _TETRAHEDRA.items()},
    "tetrahedra: moved with the points": _carried,
    "claims: changed": _claimed,
}
"""Kind -> how one forgery of it is made."""
