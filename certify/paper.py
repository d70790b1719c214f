"""What the paper prints: facts to be checked, never relied on.

Pellerin, Verhetsel and Remacle, "There are 174 Subdivisions of the Hexahedron into Tetrahedra", ACM
Transactions on Graphics 37 (2018), 266. A name of its big table carries three facts: the number
of tetrahedra, the letter of the boundary, and a status.
"""

from certify.kernel.certificate import PATTERN_NAMES

BOLD = frozenset(("15_A", "15_B", "15_J"))
"""Printed bold: no realization."""

UNDERLINED = frozenset(
    f"{size}_{letter}"
    for size, letters in {12: "UY", 13: "TW", 14: "ANOPR", 15: "FGHI"}.items()
    for letter in letters
)
"""Printed underlined: no realization in convex position."""

NEEDS_FINAL_POLYNOMIAL = "15_G"
"""The one name underlined for which the text says that a uniform sign vector survives."""

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
"""Name -> printed boundary letter."""


def size(name: str) -> int:
    """Return the number of tetrahedra that a name carries."""
    return int(name.partition("_")[0])


def printed_status(name: str) -> str:
    """Return what the paper says of a name: one of the four values below."""
    if name in BOLD:
        return "no realization"
    if name == NEEDS_FINAL_POLYNOMIAL:
        return "not convex, by a final polynomial"
    return "not convex" if name in UNDERLINED else "convex"
