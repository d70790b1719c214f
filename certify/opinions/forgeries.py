"""Forged certificates and proofs: shipped ones with one thing changed, for the kernel to refuse.

A change need not make a claim false: another triangulation is one, and points have room to move.
What the kernel accepts all the same is judged in :mod:`certify.opinions.attack`. Where a proof is
changed, the certificate states its new SHA-256, so that the hash cannot be what tells. Answers that
a forgery is not about are left open: nothing else in it can be what is refused.
"""

import json
from collections.abc import Callable
from contextlib import suppress
from dataclasses import dataclass, field
from fractions import Fraction
from hashlib import sha256
from itertools import combinations
from random import Random
from typing import Any, TypeAlias

from certify.kernel.certificate import PATTERN_NAMES, QUESTIONS
from certify.kernel.check import Tetrahedra
from certify.kernel.chirotope import QUADRUPLES
from certify.kernel.evidence import Evidence, completeness_file, proof_file
from certify.kernel.hexahedron import BOUNDARY_TYPES, SYMMETRIES, VERTICES, boundary_letter, image
from certify.kernel.theorems import Outcome
from certify.kernel.triangulation import NotATriangulation, boundary_diagonals, orbit

Record: TypeAlias = dict[str, Any]
Points: TypeAlias = list[list[Fraction]]


@dataclass(frozen=True)
class Forgery:
    """A certificate for a pattern, with the proofs that it names: path below the root -> bytes."""

    pattern: str
    certificate: bytes
    proofs: dict[str, bytes]


@dataclass(frozen=True)
class ForgedList:
    """A proof that no triangulation with a type of boundary is missing from a list."""

    letter: str
    known: tuple[Tetrahedra, ...]
    proof: bytes


@dataclass(frozen=True, eq=False)
class Corpus:
    """What forgeries are made from: all that ships, with all of it accepted."""

    certificates: dict[str, bytes]
    proofs: dict[str, str]
    known: dict[str, tuple[Tetrahedra, ...]]
    """Type of boundary -> all triangulations with the representative boundary."""
    answers: dict[str, list[tuple[str, str]]]
    """Answer -> the (pattern, question) that have it; under "polynomials" and "lemmas" those noes
    whose evidence has some."""

    def record(self, pattern: str) -> Record:
        """Return a pattern's certificate as JSON gives it, to be changed at will."""
        record: Record = json.loads(self.certificates[pattern])
        return record


def read_corpus(outcome: Outcome, evidence: Evidence) -> Corpus:
    """Return the corpus of a root that was accepted."""
    certificates = {name: evidence.certificate(name) for name in PATTERN_NAMES}
    answers: dict[str, list[tuple[str, str]]] = {
        answer: [] for answer in ("yes", "no", "open", "polynomials", "lemmas")
    }
    proofs = {file: evidence.proof(file) for file in map(completeness_file, BOUNDARY_TYPES)}
    for name, content in certificates.items():
        record = json.loads(content)
        for question in QUESTIONS:
            answer = record[question]
            answers[answer["answer"]].append((name, question))
            if answer.get("final_polynomials"):
                answers["polynomials"].append((name, question))
            if "proof" in answer:
                proofs[answer["proof"]] = text = evidence.proof(answer["proof"])
                if len(text.splitlines()) > 1:
                    answers["lemmas"].append((name, question))
    return Corpus(
        certificates,
        proofs,
        {result.boundary: tuple(sorted(result.listed)) for result in outcome.completeness},
        answers,
    )


Mutator: TypeAlias = Callable[[Random, Corpus], Forgery | ForgedList]


@dataclass
class _Draft:
    """A certificate in the making, with the text of the proof of each no."""

    record: Record
    proofs: dict[str, str] = field(default_factory=dict)

    def rename(self, name: str) -> None:
        self.record["pattern"] = name
        for question in self.proofs:
            self.record[question]["proof"] = proof_file(name, question)

    def answer_no(self, question: str, proof: str) -> None:
        self.proofs[question] = proof
        path = proof_file(self.record["pattern"], question)
        self.record[question] = {"answer": "no", "proof": path}

    def finished(self) -> Forgery:
        proofs = {}
        for question, proof in self.proofs.items():
            content = proof.encode()
            self.record[question]["sha256"] = sha256(content).hexdigest()
            proofs[self.record[question]["proof"]] = content
        return Forgery(self.record["pattern"], json.dumps(self.record).encode(), proofs)


def _draft(corpus: Corpus, name: str, *questions: str) -> _Draft:
    """Return a shipped certificate, with the answers to other questions left open."""
    record = corpus.record(name)
    record |= {question: {"answer": "open"} for question in QUESTIONS if question not in questions}
    proofs = {q: corpus.proofs[record[q]["proof"]] for q in questions if "proof" in record[q]}
    return _Draft(record, proofs)


# Points


def _nudged(random: Random, points: Points) -> None:
    """A coordinate moves by up to twice the extent of the points."""
    extent = max(max(column) - min(column) for column in zip(*points, strict=True))
    step = extent * random.choice((1, 2, 5, 10, 20)) / random.choice((1, 10, 100))
    random.choice(points)[random.randrange(3)] += random.choice((-1, 1)) * round(step)


def _rational(random: Random, points: Points) -> None:
    """A coordinate moves by a fraction."""
    step = Fraction(random.randint(-999, 999), random.choice((7, 1000, 10**12)))
    random.choice(points)[random.randrange(3)] += step


def _swapped(random: Random, points: Points) -> None:
    """Two vertices exchange their points, or two of their coordinates."""
    v, w = random.sample(range(8), 2)
    for axis in random.choice(((0,), (1,), (2,), (0, 1, 2))):
        points[v][axis], points[w][axis] = points[w][axis], points[v][axis]


def _coincident(random: Random, points: Points) -> None:
    """A vertex moves to the place of another one."""
    v, w = random.sample(range(8), 2)
    points[v] = list(points[w])


def _collinear(random: Random, points: Points) -> None:
    """A vertex moves to the line through two others."""
    v, a, b = random.sample(range(8), 3)
    t = random.choice((Fraction(1, 2), Fraction(1, 3), Fraction(-1), Fraction(2)))
    points[v] = [p + t * (q - p) for p, q in zip(points[a], points[b], strict=True)]


def _coplanar(random: Random, points: Points) -> None:
    """A vertex moves along an axis to the plane of three others, or a little beyond it."""
    v, a, b, c = random.sample(range(8), 4)
    axis = random.randrange(3)
    here = _volume(points[v], points[a], points[b], points[c])
    moved = list(points[v])
    moved[axis] += 1
    rate = _volume(moved, points[a], points[b], points[c]) - here
    if rate:
        points[v][axis] -= here / rate * random.choice((1, 1, Fraction(101, 100)))


def _volume(a: list[Fraction], b: list[Fraction], c: list[Fraction], d: list[Fraction]) -> Fraction:
    u, v, w = ([x - y for x, y in zip(p, a, strict=True)] for p in (b, c, d))
    return sum(
        (u[i] * (v[i - 2] * w[i - 1] - v[i - 1] * w[i - 2]) for i in range(3)), start=Fraction()
    )


def _mirrored(random: Random, points: Points) -> None:
    """All points are mirrored."""
    axis = random.randrange(3)
    for point in points:
        point[axis] = -point[axis]


def _projected(random: Random, points: Points) -> None:
    """All points, or some, move into one plane."""
    axis, size = random.randrange(3), random.randint(3, 8)
    for v in random.sample(range(8), size):
        points[v][axis] = points[0][axis]


_POINTS: dict[str, Callable[[Random, Points], None]] = {
    "nudged": _nudged,
    "rational": _rational,
    "swapped": _swapped,
    "coincident": _coincident,
    "collinear": _collinear,
    "coplanar": _coplanar,
    "mirrored": _mirrored,
    "projected": _projected,
}


def _changing_points(change: Callable[[Random, Points], None]) -> Mutator:
    def forge(random: Random, corpus: Corpus) -> Forgery:
        name, question = random.choice(corpus.answers["yes"])
        draft = _draft(corpus, name, question)
        answer = draft.record[question]
        points = [[Fraction(value) for value in point] for point in answer["points"]]
        change(random, points)
        answer["points"] = [[_written(value) for value in point] for point in points]
        return draft.finished()

    return forge


def _written(value: Fraction) -> int | str:
    """Return a coordinate as certificates have it."""
    if value.denominator == 1:
        return value.numerator
    return f"{value.numerator}/{value.denominator}"


def _points_of(*same: str) -> Mutator:
    """Points come from another pattern of the same size, or from another question."""

    def forge(random: Random, corpus: Corpus) -> Forgery:
        name, question = random.choice(corpus.answers["yes"])
        others = [
            (pattern, asked)
            for pattern, asked in corpus.answers["yes"]
            if ("pattern" in same) == (pattern == name)
            and _size(pattern) == _size(name)
            and ("question" not in same or asked == question)
        ]
        other, asked = random.choice(others or corpus.answers["yes"])
        draft = _draft(corpus, name, question)
        wanted = random.choice(QUESTIONS) if "pattern" in same else question
        draft.record[question] = {"answer": "open"}
        draft.record[wanted] = corpus.record(other)[asked]
        return draft.finished()

    return forge


def _size(name: str) -> str:
    return name.partition("_")[0]


# Tetrahedra


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
        draft = _draft(corpus, name, question)
        tetrahedra = change(random, [tuple(t) for t in draft.record["tetrahedra"]], corpus)
        tetrahedra = tuple(sorted(tetrahedra))
        draft.record |= {"tetrahedra": tetrahedra, "instances": len(orbit(tetrahedra))}
        fitting = [n for n in PATTERN_NAMES if _size(n) == str(len(tetrahedra))]
        if name not in fitting:
            draft.rename(random.choice(fitting or [name]))
        with suppress(NotATriangulation):
            draft.record["boundary"] = boundary_letter(boundary_diagonals(tetrahedra))
        return draft.finished()

    return forge


def _carried(random: Random, corpus: Corpus) -> Forgery:
    """A symmetry relabels the tetrahedra and carries the points along."""
    name, question = random.choice(corpus.answers["yes"])
    draft = _draft(corpus, name, question)
    symmetry, points = random.choice(SYMMETRIES), draft.record[question]["points"]
    draft.record["tetrahedra"] = sorted(image(symmetry, t) for t in draft.record["tetrahedra"])
    draft.record[question]["points"] = [points[symmetry.index(v)] for v in VERTICES]
    return draft.finished()


def _claimed(random: Random, corpus: Corpus) -> Forgery:
    """The certificate states another name, boundary or size of the class."""
    draft = _draft(corpus, random.choice(PATTERN_NAMES))
    key, value = random.choice(
        (
            ("pattern", random.choice(PATTERN_NAMES)),
            ("boundary", random.choice("abcdefgh")),
            ("instances", random.choice((1, 2, 4, 8, 12, 16, 24, 48, 96))),
        )
    )
    draft.record[key] = value
    return draft.finished()


# Answers


def _no_made_yes(random: Random, corpus: Corpus) -> Forgery:
    """A no becomes a yes, by points of the same pattern for another question if there are any."""
    name, question = random.choice(corpus.answers["no"])
    draft = _draft(corpus, name)
    own = [(n, q) for n, q in corpus.answers["yes"] if n == name]
    other, asked = random.choice(own or corpus.answers["yes"])
    draft.record[question] = corpus.record(other)[asked]
    return draft.finished()


def _yes_made_no(random: Random, corpus: Corpus) -> Forgery:
    """A yes becomes a no, by the proof of another pattern, with its final polynomials."""
    name, question = random.choice(corpus.answers["yes"])
    return _proved_by(corpus, name, question, random.choice(corpus.answers["no"]))


def _proof_of_another(random: Random, corpus: Corpus) -> Forgery:
    """A no gets the proof of another no."""
    name, question = random.choice(corpus.answers["no"])
    own = [(n, q) for n, q in corpus.answers["no"] if n == name]
    others = random.choice((own, corpus.answers["no"]))
    return _proved_by(corpus, name, question, random.choice(others))


def _proved_by(corpus: Corpus, name: str, question: str, no: tuple[str, str]) -> Forgery:
    draft, answer = _draft(corpus, name), corpus.record(no[0])[no[1]]
    draft.answer_no(question, corpus.proofs[answer["proof"]])
    if "final_polynomials" in answer:
        draft.record[question]["final_polynomials"] = answer["final_polynomials"]
    return draft.finished()


# Proofs


@dataclass
class _Step:
    """One line of a proof."""

    number: int
    literals: list[int]
    hints: list[int]
    deletes: bool = False

    @classmethod
    def read(cls, line: str) -> "_Step":
        words = line.split(" ")
        if words[1] == "d":
            return cls(int(words[0]), [], list(map(int, words[2:-1])), deletes=True)
        end = words.index("0")
        literals, hints = words[1:end], words[end + 1 : -1]
        return cls(int(words[0]), list(map(int, literals)), list(map(int, hints)))

    def __str__(self) -> str:
        literals = ["d"] if self.deletes else [*self.literals, 0]
        return " ".join(map(str, (self.number, *literals, *self.hints, 0)))


def _step_dropped(random: Random, lines: list[str]) -> None:
    """A step is missing."""
    lines.pop(random.randrange(len(lines)))


def _steps_exchanged(random: Random, lines: list[str]) -> None:
    """A step changes places with another, often the one before; the numbers move along or not."""
    i = random.randrange(len(lines))
    j = random.choice((max(i - 1, 0), random.randrange(len(lines))))
    first, second = _Step.read(lines[i]), _Step.read(lines[j])
    if random.random() < 0.5:
        first.number, second.number = second.number, first.number
    lines[i], lines[j] = str(second), str(first)


def _step_doubled(random: Random, lines: list[str]) -> None:
    """A step is there twice."""
    i = random.randrange(len(lines))
    lines.insert(i, lines[i])


def _ended_early(random: Random, lines: list[str]) -> None:
    """A lemma is said to be the empty clause, and the proof ends there."""
    i = random.randrange(len(lines))
    step = _Step.read(lines[i])
    lines[i:] = [str(_Step(step.number, [], step.hints))]


def _last_cut(_: Random, lines: list[str]) -> None:
    """The last step is missing."""
    lines.pop()


def _needed_deleted(random: Random, lines: list[str]) -> None:
    """A clause is deleted just before it is needed."""
    i = random.randrange(len(lines))
    step = _Step.read(lines[i])
    lines.insert(i, str(_Step(step.number, [], [random.choice(step.hints or [1])], deletes=True)))


def _editing(
    change: Callable[[Random, _Step], None], lemmas: bool = False
) -> Callable[[Random, list[str]], None]:
    """Change one step, which is not the last if ``lemmas`` are wanted and there are any."""

    def edit(random: Random, lines: list[str]) -> None:
        i = random.randrange(max(len(lines) - lemmas, 1))
        step = _Step.read(lines[i])
        change(random, step)
        lines[i] = str(step)

    return edit


def _weakened(random: Random, step: _Step) -> None:
    step.literals.append(random.choice((-1, 1)) * random.randint(1, 140))


def _strengthened(random: Random, step: _Step) -> None:
    if step.literals:
        step.literals.pop(random.randrange(len(step.literals)))


def _negated(random: Random, step: _Step) -> None:
    if step.literals:
        step.literals[random.randrange(len(step.literals))] *= -1


def _hint_redirected(random: Random, step: _Step) -> None:
    i = random.randrange(len(step.hints))
    nearby = step.hints[i] + random.choice((-1, 1))
    step.hints[i] = random.choice((nearby, random.randint(1, step.number)))


def _hint_dropped(random: Random, step: _Step) -> None:
    step.hints.pop(random.randrange(len(step.hints)))


def _hint_added(random: Random, step: _Step) -> None:
    step.hints.insert(random.randrange(len(step.hints) + 1), random.randint(1, step.number))


def _hints_exchanged(random: Random, step: _Step) -> None:
    i = random.randrange(len(step.hints))
    j = random.choice((max(i - 1, 0), random.randrange(len(step.hints))))
    step.hints[i], step.hints[j] = step.hints[j], step.hints[i]


def _hint_negative(random: Random, step: _Step) -> None:
    step.hints[random.randrange(len(step.hints))] *= -1


def _renumbered(random: Random, step: _Step) -> None:
    step.number = random.choice((step.number - 1, step.number + 1, random.randint(1, step.number)))


_PROOFS: dict[str, Callable[[Random, list[str]], None]] = {
    "step dropped": _step_dropped,
    "steps exchanged": _steps_exchanged,
    "step doubled": _step_doubled,
    "ended early": _ended_early,
    "last step cut": _last_cut,
    "needed clause deleted": _needed_deleted,
    "lemma weakened": _editing(_weakened, lemmas=True),
    "lemma strengthened": _editing(_strengthened, lemmas=True),
    "literal negated": _editing(_negated, lemmas=True),
    "hint redirected": _editing(_hint_redirected),
    "hint dropped": _editing(_hint_dropped),
    "hint added": _editing(_hint_added),
    "hints exchanged": _editing(_hints_exchanged),
    "hint negative": _editing(_hint_negative),
    "step renumbered": _editing(_renumbered),
}


def _changed(random: Random, proof: str, change: Callable[[Random, list[str]], None]) -> str:
    lines = proof.splitlines()
    change(random, lines)
    return "".join(f"{line}\n" for line in lines)


def _changing_refutation(change: Callable[[Random, list[str]], None]) -> Mutator:
    def forge(random: Random, corpus: Corpus) -> Forgery:
        name, question = random.choice(corpus.answers[random.choice(("no", "lemmas", "lemmas"))])
        draft = _draft(corpus, name, question)
        draft.proofs[question] = _changed(random, draft.proofs[question], change)
        return draft.finished()

    return forge


# Completeness

_LETTERS = "aaaaaabbbbbbddddccceefg"
"""Types of boundary, the more often the shorter their proofs are."""


def _changing_completeness(change: Callable[[Random, list[str]], None]) -> Mutator:
    def forge(random: Random, corpus: Corpus) -> ForgedList:
        letter = random.choice(_LETTERS)
        proof = _changed(random, corpus.proofs[completeness_file(letter)], change)
        return ForgedList(letter, corpus.known[letter], proof.encode())

    return forge


def _instance_removed(random: Random, corpus: Corpus) -> ForgedList:
    """A triangulation is missing from the list, and the proof is made to fit its numbers or not."""
    letter = random.choice(_LETTERS)
    known, proof = list(corpus.known[letter]), corpus.proofs[completeness_file(letter)]
    gone = random.randrange(len(known))
    if random.random() < 0.7:
        lines = proof.splitlines()
        first_lemma = _Step.read(lines[0]).number
        proof = _without(lines, first_lemma - len(known) + gone)
    known.pop(gone)
    return ForgedList(letter, tuple(known), proof.encode())


def _without(lines: list[str], gone: int) -> str:
    """Return a proof for the formula without one clause, which no hint names any more."""
    text = []
    for step in map(_Step.read, lines):
        step.number -= 1
        step.hints = [hint - (hint > gone) for hint in step.hints if hint != gone]
        text.append(f"{step}\n")
    return "".join(text)


def _instance_exchanged(random: Random, corpus: Corpus) -> ForgedList:
    """A triangulation of the list is replaced by one that it has already, or by a like one."""
    letter = random.choice(_LETTERS)
    known = list(corpus.known[letter])
    other = list(random.choice(known))
    if random.random() < 0.5:
        other[random.randrange(len(other))] = random.choice(QUADRUPLES)
    known[random.randrange(len(known))] = tuple(sorted(other))
    return ForgedList(letter, tuple(known), corpus.proofs[completeness_file(letter)].encode())


def _other_letter(random: Random, corpus: Corpus) -> ForgedList:
    """The list, the proof or both are those of another type of boundary."""
    letter, other = random.sample("abcdefg", 2)
    known = corpus.known[random.choice((letter, other))]
    return ForgedList(letter, known, corpus.proofs[completeness_file(other)].encode())


# Final polynomials


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
        draft = _draft(corpus, name, question)
        change(random, draft.record[question]["final_polynomials"])
        return draft.finished()

    return forge


# Bytes


def _flip(random: Random, content: bytearray) -> None:
    """A bit changes, or a digit."""
    i = random.randrange(len(content))
    if random.random() < 0.5:
        digits = [k for k, byte in enumerate(content) if chr(byte).isdigit()]
        content[random.choice(digits)] = random.choice(b"0123456789")
    else:
        content[i] ^= 1 << random.randrange(8)


def _cut(random: Random, content: bytearray) -> None:
    """Some bytes are missing."""
    i = random.randrange(len(content))
    del content[i : i + random.choice((1, 1, 2, 10, len(content)))]


def _insert(random: Random, content: bytearray) -> None:
    """Some bytes are new."""
    new = random.choice(
        (b" ", b"\n", b"0", b"-", b",", b"1 ", b".0", b"e0", b"\xff", b"\xef\xbb\xbf")
    )
    i = random.choice((0, len(content), random.randrange(len(content))))
    content[i:i] = new


_BYTES: dict[str, Callable[[Random, bytearray], None]] = {
    "flipped": _flip,
    "cut": _cut,
    "inserted": _insert,
}


def _changing_certificate(change: Callable[[Random, bytearray], None]) -> Mutator:
    def forge(random: Random, corpus: Corpus) -> Forgery:
        made = _draft(corpus, random.choice(PATTERN_NAMES), random.choice(QUESTIONS)).finished()
        content = bytearray(made.certificate)
        change(random, content)
        return Forgery(made.pattern, bytes(content), made.proofs)

    return forge


def _changing_proof(change: Callable[[Random, bytearray], None]) -> Mutator:
    def forge(random: Random, corpus: Corpus) -> Forgery:
        name, question = random.choice(corpus.answers["no"])
        draft = _draft(corpus, name, question)
        content = bytearray(draft.proofs[question].encode())
        change(random, content)
        draft.record[question]["sha256"] = sha256(content).hexdigest()
        certificate = json.dumps(draft.record).encode()
        return Forgery(name, certificate, {draft.record[question]["proof"]: bytes(content)})

    return forge


def _hash_changed(random: Random, corpus: Corpus) -> Forgery:
    """The stated SHA-256 is another one."""
    name, question = random.choice(corpus.answers["no"])
    made = _draft(corpus, name, question).finished()
    record = json.loads(made.certificate)
    digits = list(record[question]["sha256"])
    digits[random.randrange(64)] = random.choice("0123456789abcdefABCDEF")
    record[question]["sha256"] = "".join(digits)
    return Forgery(name, json.dumps(record).encode(), made.proofs)


# Structure


def _places(value: Any) -> list[tuple[Any, Any]]:
    """Return everything in a JSON value, as (object or list, key or index)."""
    inner = value.items() if isinstance(value, dict) else enumerate(value)
    found = [(value, key) for key, _ in inner]
    for container, key in list(found):
        if isinstance(container[key], dict | list):
            found += _places(container[key])
    return found


def _key_dropped(random: Random, record: Record) -> None:
    """A key or an item is missing."""
    container, key = random.choice(_places(record))
    del container[key]


def _key_renamed(random: Random, record: Record) -> None:
    """A key has another name."""
    objects = [container for container, _ in _places(record) if isinstance(container, dict)]
    chosen = random.choice(objects)
    key = random.choice(list(chosen))
    chosen[random.choice((key.upper(), key + " ", key[:-1], "answer", "valid"))] = chosen.pop(key)


def _key_added(random: Random, record: Record) -> None:
    """There is one more key or item."""
    container, key = random.choice(_places(record))
    if isinstance(container, dict):
        container[random.choice(("comment", "points", "1234", ""))] = container[key]
    else:
        container.append(container[key])


def _type_changed(random: Random, record: Record) -> None:
    """A value has another type, or another size."""
    container, key = random.choice(_places(record))
    value = container[key]
    others: list[Any] = [
        None,
        True,
        False,
        0,
        -1,
        0.0,
        1.5,
        10**41,
        "",
        "1/0",
        "01/2",
        "2/2",
        "open",
    ]
    others += [str(value), [value], {"answer": value}, [], {}]
    if isinstance(value, int):
        others += [float(value), value == 1, f"{value}/1", f"{2 * value}/2", f"{value}/01"]
    container[key] = random.choice(others)


_STRUCTURE: dict[str, Callable[[Random, Record], None]] = {
    "key dropped": _key_dropped,
    "key renamed": _key_renamed,
    "key added": _key_added,
    "type changed": _type_changed,
}


def _changing_structure(change: Callable[[Random, Record], None]) -> Mutator:
    def forge(random: Random, corpus: Corpus) -> Forgery:
        name = random.choice(PATTERN_NAMES)
        made = _draft(corpus, name, random.choice(QUESTIONS)).finished()
        record = json.loads(made.certificate)
        change(random, record)
        return Forgery(name, json.dumps(record).encode(), made.proofs)

    return forge


def _key_doubled(random: Random, corpus: Corpus) -> Forgery:
    """A key occurs twice in an object, with the same or another value."""
    name, question = random.choice(corpus.answers["yes"] + corpus.answers["no"])
    made = _draft(corpus, name, question).finished()
    text = made.certificate.decode()
    record = json.loads(text)
    key = random.choice([key for container, key in _places(record) if isinstance(container, dict)])
    value = random.choice((json.dumps(record.get(key, "yes")), "null", '"open"', "[]"))
    text = text.replace(f'"{key}":', f'"{key}": {value}, "{key}":', 1)
    return Forgery(name, text.encode(), made.proofs)


KINDS: dict[str, Mutator] = {
    **{f"points: {name}": _changing_points(change) for name, change in _POINTS.items()},
    "points: of another pattern": _points_of("question"),
    "points: of another question": _points_of("pattern"),
    **{f"tetrahedra: {n}": _changing_tetrahedra(change) for n, change in _TETRAHEDRA.items()},
    "tetrahedra: moved with the points": _carried,
    "claims: changed": _claimed,
    "answer: no made yes": _no_made_yes,
    "answer: yes made no": _yes_made_no,
    "answer: proof of another no": _proof_of_another,
    **{f"refutation: {name}": _changing_refutation(change) for name, change in _PROOFS.items()},
    **{f"polynomial: {n}": _changing_polynomials(change) for n, change in _POLYNOMIALS.items()},
    **{f"completeness: {name}": _changing_completeness(c) for name, c in _PROOFS.items()},
    "completeness: instance removed": _instance_removed,
    "completeness: instance exchanged": _instance_exchanged,
    "completeness: of another boundary": _other_letter,
    **{f"certificate: bytes {n}": _changing_certificate(change) for n, change in _BYTES.items()},
    **{f"proof: bytes {name}": _changing_proof(change) for name, change in _BYTES.items()},
    "proof: hash changed": _hash_changed,
    **{f"structure: {name}": _changing_structure(c) for name, c in _STRUCTURE.items()},
    "structure: key doubled": _key_doubled,
}
"""Kind -> how one forgery of it is made."""
