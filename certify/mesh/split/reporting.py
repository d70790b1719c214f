"""An answer as JSON, and what the variables and clauses of a contradiction mean."""

from collections.abc import Sequence
from typing import Any, TypeAlias

from certify.mesh.split.contradictions import Contradiction
from certify.mesh.split.splitting import Answer
from certify.mesh.split.tetrahedra import Shape

Record: TypeAlias = dict[str, Any]


def _comments(mesh: Path, found: Answer, own: Contradiction) -> list[str]:
    """Return what the cells, the variables and the clauses mean."""
    names = [found.faces.name(cell) for cell in own.cells]
    lines = [
        f"{printable(mesh.name)}: {', '.join(names)} contradict each other.",
        "",
        "Cells are counted from 1 among those of their kind, vertices from 1.",
        "A variable is true iff its quadrilateral is cut through its least vertex:",
    ]
    for variable, quad in enumerate(own.quadrilaterals, start=1):
        a, b, c, d = (int(v) + 1 for v in found.faces.quadrilaterals[quad])
        sides = [found.faces.name(cell) for cell in own.cells if cell in found.faces.sides[quad]]
        lines.append(
            f"  {variable}: quadrilateral {a} {b} {c} {d} of {' and '.join(sides)}; "
            f"true {a} {c}, false {b} {d}"
        )
    lines += [
        "",
        "A clause excludes diagonals of one cell with which no tetrahedra on its",
        "vertices fill it: by the exact signs of their determinants, and for a",
        "hexahedron by the list of all its triangulations (certify check-all).",
    ]
    return lines


def _record(mesh: Path, found: Answer, proofs: Sequence[str], quality: str) -> Record:
    """Return everything as JSON. Cells and vertices are counted from 1."""
    return {
        "mesh": str(mesh),
        "points": len(found.points),
        "cells": {kind: len(rows) for kind, rows in found.faces.cells.items()},
        "quadrilaterals": len(found.faces.sides),
        "split": "no" if found.tetrahedra is None else "yes",
        "quality": quality,
        "tetrahedra": None if found.shape is None else _figures(found.shape),
        "patterns": found.patterns,
        "laid_on_facets": found.laid,
        "recipe": {**_figures(found.recipe), "cells_beyond": found.beyond_recipe},
        "unfillable": [_unfillable_record(found, cell) for cell in found.unfillable],
        "contradictions": [
            {
                "cells": [found.faces.name(cell) for cell in own.cells],
                "smallest": own.smallest,
                "quadrilaterals": (found.faces.quadrilaterals[[*own.quadrilaterals]] + 1).tolist(),
                "clauses": len(own.formula),
                "steps": len(proof.splitlines()),
            }
            for own, proof in zip(found.contradictions, proofs, strict=True)
        ],
    }


def _figures(own: Shape) -> Record:
    some = len(own.angles) > 0
    return {
        "number": own.tetrahedra,
        "inverted_or_flat": own.not_positive,
        "cells_with_such": own.cells,
        "least_dihedral": float(own.angles.min()) if some and not own.not_positive else None,
        "least_mean_ratio": float(own.ratios.min()) if some and not own.not_positive else None,
        "mean_mean_ratio": float(own.ratios.mean()) if some else None,
    }


def _unfillable_record(found: Answer, cell: int) -> Record:
    own = found.why(cell)
    return {
        "cell": found.faces.name(cell),
        "boundaries": own.boundaries,
        "crossing": own.crossing,
        "corners": [vertex + 1 for vertex in own.corners],
    }
