"""Forged proofs: steps dropped, exchanged, weakened, strengthened; hints redirected; deletions.

And lists of triangulations that lack one, with the proof that none is missing made to fit.
"""

from collections.abc import Callable
from dataclasses import dataclass
from random import Random

from certify.kernel.chirotope import QUADRUPLES
from certify.kernel.evidence import completeness_file
from certify.opinions.attack.corpus import Corpus, Draft, ForgedList, Forgery, Mutator


@dataclass
class Step:
    """One line of a proof."""

    number: int
    literals: list[int]
    hints: list[int]
    deletes: bool = False

    @classmethod
    def read(cls, line: str) -> "Step":
        """Return the step on a line."""
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
    first, second = Step.read(lines[i]), Step.read(lines[j])
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
    step = Step.read(lines[i])
    lines[i:] = [str(Step(step.number, [], step.hints))]


def _last_cut(_: Random, lines: list[str]) -> None:
    """The last step is missing."""
    lines.pop()


def _needed_deleted(random: Random, lines: list[str]) -> None:
    """A clause is deleted just before it is needed."""
    i = random.randrange(len(lines))
    step = Step.read(lines[i])
    lines.insert(i, str(Step(step.number, [], [random.choice(step.hints or [1])], deletes=True)))


def _editing(
    change: Callable[[Random, Step], None], lemmas: bool = False
) -> Callable[[Random, list[str]], None]:
    """Change one step, which is not the last if ``lemmas`` are wanted and there are any."""

    def edit(random: Random, lines: list[str]) -> None:
        i = random.randrange(max(len(lines) - lemmas, 1))
        step = Step.read(lines[i])
        change(random, step)
        lines[i] = str(step)

    return edit


def _weakened(random: Random, step: Step) -> None:
    step.literals.append(random.choice((-1, 1)) * random.randint(1, 140))


def _strengthened(random: Random, step: Step) -> None:
    if step.literals:
        step.literals.pop(random.randrange(len(step.literals)))


def _negated(random: Random, step: Step) -> None:
    if step.literals:
        step.literals[random.randrange(len(step.literals))] *= -1


def _hint_redirected(random: Random, step: Step) -> None:
    i = random.randrange(len(step.hints))
    nearby = step.hints[i] + random.choice((-1, 1))
    step.hints[i] = random.choice((nearby, random.randint(1, step.number)))


def _hint_dropped(random: Random, step: Step) -> None:
    step.hints.pop(random.randrange(len(step.hints)))


def _hint_added(random: Random, step: Step) -> None:
    step.hints.insert(random.randrange(len(step.hints) + 1), random.randint(1, step.number))


def _hints_exchanged(random: Random, step: Step) -> None:
    i = random.randrange(len(step.hints))
    j = random.choice((max(i - 1, 0), random.randrange(len(step.hints))))
    step.hints[i], step.hints[j] = step.hints[j], step.hints[i]


def _hint_negative(random: Random, step: Step) -> None:
    step.hints[random.randrange(len(step.hints))] *= -1


def _renumbered(random: Random, step: Step) -> None:
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
        draft = Draft.of(corpus, name, question)
        draft.proofs[question] = _changed(random, draft.proofs[question], change)
        return draft.finished()

    return forge


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
        first_lemma = Step.read(lines[0]).number
        proof = _without(lines, first_lemma - len(known) + gone)
    known.pop(gone)
    return ForgedList(letter, tuple(known), proof.encode())


def _without(lines: list[str], gone: int) -> str:
    """Return a proof for the formula without one clause, which no hint names any more."""
    text = []
    for step in map(Step.read, lines):
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


KINDS: dict[str, Mutator] = {
    **{f"refutation: {name}": _changing_refutation(change) for name, change in _PROOFS.items()},
    **{f"completeness: {name}": _changing_completeness(c) for name, c in _PROOFS.items()},
    "completeness: instance removed": _instance_removed,
    "completeness: instance exchanged": _instance_exchanged,
    "completeness: of another boundary": _other_letter,
}
"""Kind -> how one forgery of it is made."""
