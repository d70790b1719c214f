"""Which of our patterns gets which name of the paper's big table.

A name carries three facts: the number of tetrahedra, the letter of the boundary, and a status (of
15_G the text says more than the table). The order inside a cell is ours: lexicographic.
"""

from collections import Counter, defaultdict
from collections.abc import Mapping, Sequence

from certify.kernel.certificate import PATTERN_NAMES
from certify.kernel.names import LETTERS
from certify.paper import printed_status, size


def assign_names(facts: Sequence[tuple[int, str, str]]) -> list[str]:
    """Return a name for each pattern, given its number of tetrahedra, letter and status.

    The patterns come in the order they shall have inside a cell. Names keep their status; the
    letters are the printed ones, amended where those cannot be true.
    """
    letters = amended_letters(Counter(facts))
    free: defaultdict[tuple[int, str, str], list[str]] = defaultdict(list)
    for name in PATTERN_NAMES:
        free[size(name), letters[name], printed_status(name)].append(name)
    return [free[fact].pop(0) for fact in facts]


def amended_letters(found: Mapping[tuple[int, str, str], int]) -> dict[str, str]:
    """Return the printed letters after the fewest exchanges that make all counts those found.

    A name in bold or underlined whose letter is printed more often than found for its size and
    status exchanges letters with the nearest name of the same size for which it is the other way
    round.
    """
    letters = dict(LETTERS)

    def cell(name: str, letter: str) -> tuple[int, str, str]:
        return size(name), letter, printed_status(name)

    def surplus(name: str, letter: str) -> int:
        key = cell(name, letter)
        return sum(cell(*item) == key for item in letters.items()) - found.get(key, 0)

    names = PATTERN_NAMES
    for i, name in enumerate(names):
        if printed_status(name) == "convex" or surplus(name, letters[name]) <= 0:
            continue
        candidates = [
            other
            for other in names
            if size(other) == size(name)
            and surplus(other, letters[other]) > 0
            and surplus(name, letters[other]) < 0
        ]
        if candidates:
            other = min(candidates, key=lambda other: abs(names.index(other) - i))
            letters[name], letters[other] = letters[other], letters[name]
    return letters
