"""A whole mesh of hexahedra, wedges and pyramids into tetrahedra, or the proof that it cannot be.

No vertex is added. Every quadrilateral is cut by one of its two diagonals, the same for the cells
on its two sides; and the triangulated boundary of every cell is filled by tetrahedra that are
positively oriented and meet only in common faces. Which boundaries of a cell can be filled is
decided exactly: for a hexahedron by the complete list of its triangulations. What is left is a
finite choice, one bit a quadrilateral, and a question for a SAT solver: a yes is checked from the
definition, a no comes with cells that contradict each other, and a proof.
"""

from certify.mesh.split.checking import NotSplit, require_split
from certify.mesh.split.splitting import Answer, split

__all__ = ["Answer", "NotSplit", "require_split", "split"]
