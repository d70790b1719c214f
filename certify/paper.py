"""What the paper prints: facts to be checked, never relied on.

Pellerin, Verhetsel and Remacle, "There are 174 Subdivisions of the Hexahedron into Tetrahedra", ACM
Transactions on Graphics 37 (2018), 266. Its big table is in the kernel's names.py, as there is a
theorem about it.
"""

from certify.kernel.names import BOLD, NEEDS_FINAL_POLYNOMIAL, UNDERLINED


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


TABLE_1 = {
    "combinatorial": ((1, 5, 5, 7, 13, 20, 35, 30, 28, 19, 11), 174),
    "geometrical": ((1, 5, 5, 7, 13, 20, 35, 30, 28, 19, 8), 171),
}
"""Row -> its entries for 5, 6, ..., 15 tetrahedra, and the printed sum."""

EDGES = ("12", "14", "15", "23", "26", "34", "36", "48", "56", "58", "67", "78")
FACETS = ("1234", "1265", "1485", "2376", "3487", "5678")
"""The template of section 3. The list of edges is printed a second time, equal, in section 3.3."""

TRIANGULATIONS_IN_FIGURE = {5: 4, 8: 7}
"""Figure -> how many triangulations it shows: of the finite precision cube, of the boundary.

The caption of Table 2 refers to Figure 5 for the meaning of its letters; they are in Figure 8.
"""

NO_UNIFORM_MATROID = (
    *("12_U", "12_Y", "13_T", "13_W", "14_A", "14_N"),
    *("14_O", "14_P", "14_R", "15_F", "15_H", "15_I"),
)
"""Said in section 4.4 to admit no uniform oriented matroid in convex position."""

MESHES = (
    ("Cube", 127, (1, 5, 2, 1, 0, 0, 0, 0, 0, 0, 0), 9),
    ("Fusee", 11_975, (1, 5, 5, 7, 13, 9, 4, 0, 0, 0, 0), 44),
    ("CShaft", 23_245, (1, 5, 5, 7, 13, 17, 6, 0, 0, 0, 0), 54),
    ("Fusee_1", 71_947, (1, 5, 5, 7, 7, 1, 0, 0, 0, 0, 0), 26),
    ("Caliper", 130_572, (1, 5, 5, 7, 7, 1, 0, 0, 0, 0, 0), 26),
    ("CShaft2", 140_985, (1, 5, 5, 7, 8, 0, 1, 0, 0, 0, 0), 27),
    ("Fusee_2", 161_888, (1, 5, 5, 7, 7, 1, 0, 0, 0, 0, 0), 26),
    ("FT47_b", 221_780, (1, 5, 5, 7, 8, 2, 0, 0, 0, 0, 0), 28),
    ("FT47", 370_401, (1, 5, 5, 7, 7, 2, 0, 0, 0, 0, 0), 27),
    ("Fusee_3", 501_021, (1, 5, 5, 7, 8, 4, 0, 0, 0, 0, 0), 30),
    ("Los1", 583_561, (1, 5, 5, 7, 7, 2, 0, 0, 0, 0, 0), 27),
    ("Knuckle", 3_058_481, (1, 5, 5, 7, 8, 2, 0, 0, 0, 0, 0), 28),
)
"""Table 3: model, vertices, patterns found with 5, 6, ..., 15 tetrahedra, printed total."""

RANDOM_POINTS = (
    (3_000, (1, 5, 2, 7, 13, 16, 4, 0, 0, 0, 0), 51),
    (10_000, (1, 5, 5, 7, 13, 19, 10, 2, 0, 0, 0), 62),
    (20_000, (1, 5, 5, 7, 13, 19, 15, 2, 0, 0, 0), 67),
    (100_000, (1, 5, 5, 7, 13, 20, 24, 5, 0, 0, 0), 80),
    (500_000, (1, 5, 5, 7, 13, 20, 28, 12, 1, 0, 0), 92),
    (1_000_000, (1, 5, 5, 7, 13, 20, 30, 14, 0, 0, 0), 95),
    (2_000_000, (1, 5, 5, 7, 13, 20, 30, 15, 4, 1, 0), 101),
    (5_000_000, (1, 5, 5, 7, 13, 20, 30, 16, 4, 1, 0), 102),
    (10_000_000, (1, 5, 5, 7, 13, 20, 31, 16, 6, 1, 0), 105),
)
"""Table 4: random points, patterns found with 5, 6, ..., 15 tetrahedra, printed total."""
