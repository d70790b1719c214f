"""Write the data of the completeness proofs as Coq modules.

    python3 generate_complete.py MODULE [--root FOLDER]

prints Completeness_a to Completeness_g: one of the seven boundaries, the images of the 174 patterns
that have exactly this boundary, and the proof that no triangulation with this boundary is missing.
All of it is checked inside Coq: nothing that this program does needs to be trusted.
"""

import argparse
import re
from itertools import combinations, permutations
from pathlib import Path

from generate import certificates, coq_list, definition, module, proof, vertices

FACETS = ((1, 2, 3, 4), (1, 5, 6, 2), (1, 4, 8, 5), (2, 6, 7, 3), (3, 7, 8, 4), (5, 8, 7, 6))
"""Each in cyclic order."""

DIAGONALS = {
    "a": "13 16 18 36 38 68",
    "b": "13 16 18 27 38 68",
    "c": "13 16 36 45 47 57",
    "d": "13 16 18 27 38 57",
    "e": "13 16 18 27 47 57",
    "f": "13 16 27 38 45 68",
    "g": "13 16 27 38 45 57",
}
"""One boundary of each type, by the diagonals of the facets."""

Face = tuple[int, ...]


def boundary(diagonals: str) -> list[Face]:
    """Return the triangles of a boundary, as two for each facet."""
    chosen = {tuple(map(int, diagonal)) for diagonal in diagonals.split()}
    return [
        triangle
        for a, b, c, d in FACETS
        for triangle in (
            ((a, b, c), (a, c, d)) if tuple(sorted((a, c))) in chosen else ((a, b, d), (b, c, d))
        )
    ]


def symmetries() -> list[Face]:
    """Return the relabellings of 1..8 that take facets to facets."""
    facets = {frozenset(facet) for facet in FACETS}
    return [
        s
        for s in permutations(range(1, 9))
        if all(frozenset(s[v - 1] for v in facet) in facets for facet in FACETS)
    ]


def boundary_of(tetrahedra: list[Face]) -> set[Face]:
    """Return the triangles that lie in one tetrahedron only."""
    triangles = [triangle for t in tetrahedra for triangle in combinations(t, 3)]
    return {triangle for triangle in triangles if triangles.count(triangle) == 1}


def images(root: Path, letter: str) -> list[tuple[int, Face]]:
    """Return pattern (its place in the catalogue) and relabelling of the images with a boundary.

    Equal images occur once; the order is the lexicographic one of the images, as in the proof.
    """
    wanted = {tuple(sorted(triangle)) for triangle in boundary(DIAGONALS[letter])}
    found: dict[tuple[Face, ...], tuple[int, Face]] = {}
    group = symmetries()
    for place, certificate in enumerate(certificates(root)):
        patterns = [tuple(sorted(t)) for t in certificate["tetrahedra"]]
        border = boundary_of(patterns)
        for s in group:
            if {tuple(sorted(s[v - 1] for v in triangle)) for triangle in border} == wanted:
                image = tuple(sorted(tuple(sorted(s[v - 1] for v in t)) for t in patterns))
                found.setdefault(image, (place, s))
    return [found[image] for image in sorted(found)]


def completeness(root: Path, letter: str) -> str:
    """Return the module for one boundary."""
    triangles = map(vertices, boundary(DIAGONALS[letter]))
    steps = proof(root / "proofs" / f"complete.{letter}.lrat")
    return module(
        "From Coq Require Import List ZArith.\n"
        "From Certify Require Import Triangulation Lrat.\n"
        "Local Open Scope positive_scope.",
        f"Definition boundary : list triangle :=\n  {coq_list(triangles)}.\n",
        definition(
            "images",
            "list (nat * list vertex)",
            (f"({place}%nat, {coq_list(f'V{v}' for v in s)})" for place, s in images(root, letter)),
        ),
        f"Definition proof : list step := [\n  {steps[1:]}.\n",
    )


def main() -> None:
    """Print one module."""
    parser = argparse.ArgumentParser(description=re.split(r"\n\n", __doc__)[0])
    parser.add_argument("module", choices=[f"Completeness_{letter}" for letter in DIAGONALS])
    parser.add_argument("--root", type=Path, default=Path(__file__).resolve().parent.parent)
    arguments = parser.parse_args()
    print(completeness(arguments.root, arguments.module[-1]), end="")


if __name__ == "__main__":
    main()
