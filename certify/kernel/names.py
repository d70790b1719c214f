"""What a name of the paper's big table says of its pattern, and which pattern of a cell bears it.

A name carries three facts: the number of tetrahedra, the letter of the boundary, and a status. The
patterns that share all three are a *cell* of the table. The order inside a cell is ours.
"""

from collections import defaultdict
from collections.abc import Mapping

from certify.kernel.certificate import PATTERN_NAMES
from certify.kernel.check import Tetrahedra, Verdict
from certify.kernel.hexahedron import BOUNDARY_TYPES
from certify.kernel.triangulation import boundary_diagonals

LETTERS: dict[str, str] = dict(
    zip(
        PATTERN_NAMES,
        "a"
        "debca"
        "bdgbc"
        "dggddbf"
        "dedgdfbdgdfff"
        "geedgdgdggfbgffgggdf"
        "gfdgcgggffggeedegedggggfggdbgggdgfg"
        "dggggeeedgeeggdfggggddgdggdgdc"
        "fggdfdedeedgdggddddccdfggggg"
        "cddeeedfdddccdcdggg"
        "gfdfccccdgg",
        strict=True,
    )
)
"""Name -> boundary letter, as printed."""

AMENDED = {"13_S": "c", "13_T": "d", "13_W": "g", "13_X": "f"}
"""Name -> letter, where the printed one contradicts the status (CHECKING.md, section 11)."""

BOLD = frozenset(("15_A", "15_B", "15_J"))
"""Printed bold: no realization."""

UNDERLINED = frozenset(
    f"{size}_{letter}"
    for size, letters in {12: "UY", 13: "TW", 14: "ANOPR", 15: "FGHI"}.items()
    for letter in letters
)
"""Printed underlined: no realization in convex position."""

NEEDS_FINAL_POLYNOMIAL = "15_G"
"""The one underlined of which the text says that a uniform sign vector survives.

So it cannot be 15_F or 15_H, which share its cell; it comes last there.
"""


def mean_what_the_table_says(patterns: Mapping[str, Verdict]) -> bool:
    """Has each of the 174 patterns the letter, the status and the place that its name has?

    The number of tetrahedra was compared when the certificate was checked. Inside a cell the order
    is lexicographic by the tetrahedra of the least instance with the representative's boundary,
    but 15_G comes last. Thus no two patterns can exchange their names.
    """
    cells = defaultdict(list)
    for name in sorted(PATTERN_NAMES, key=lambda name: name == NEEDS_FINAL_POLYNOMIAL):
        verdict = patterns[name]
        letter = (LETTERS | AMENDED)[name]
        if (verdict.boundary, _status(verdict)) != (letter, _printed_status(name)):
            return False
        cells[verdict.size, letter, _printed_status(name)].append(_least(verdict))
    return all(cell == sorted(cell) for cell in cells.values())


def _status(verdict: Verdict) -> tuple[bool, bool]:
    """Return whether the pattern has no realization, and whether it has one but none convex."""
    realizable, convex = verdict.answers["realizable"], verdict.answers["convex"]
    return realizable == "no", realizable == "yes" and convex == "no"


def _printed_status(name: str) -> tuple[bool, bool]:
    return name in BOLD, name in UNDERLINED


def _least(verdict: Verdict) -> Tetrahedra:
    """Return the least instance with the representative boundary of the pattern's type."""
    representative = BOUNDARY_TYPES[verdict.boundary]
    return min(i for i in verdict.instances if boundary_diagonals(i) == representative)
