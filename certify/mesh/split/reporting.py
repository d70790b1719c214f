"""An answer as a mesh file, as JSON, and the legend of a contradiction.

A mesh file is read back before it is believed. Points are those of the mesh that was split, with
the same numbers. Tetrahedra are positive in the order of their vertices, and have as data, in the
formats that can hold it:

- ``cell``: the number of the cell among those of its kind, from 1;
- ``kind``: the kind of that cell, by the number that VTK has for it;
- ``pattern``: if it is a hexahedron, the place of the pattern that fills it among the names that
  ``certify list`` prints, from 1; else 0, also of a boundary tetrahedron laid on a hexahedron.

Medit has one number for each: the cell.
"""

from collections import Counter
from collections.abc import Sequence
from pathlib import Path
from typing import Any, NamedTuple, TypeAlias

import meshio
import numpy as np
from numpy.typing import NDArray

from certify.mesh.files import NotExact, silence
from certify.mesh.split.contradictions import Contradiction
from certify.mesh.split.kinds import VTK_TYPES
from certify.mesh.split.splitting import Answer
from certify.mesh.split.tetrahedra import Shape

Record: TypeAlias = dict[str, Any]


class Format(NamedTuple):
    """How meshio writes a file. data: its name for an array -> ours; constant: those that are 1."""

    name: str
    data: dict[str, str]
    constant: tuple[str, ...]
    options: dict[str, Any]


_ALL = {name: name for name in ("cell", "kind", "pattern")}

FORMATS = {
    ".vtu": Format("vtu", _ALL, (), {"binary": True, "compression": "zlib"}),
    ".vtk": Format("vtk", _ALL, (), {"binary": True}),
    ".msh": Format("gmsh22", _ALL, ("gmsh:physical", "gmsh:geometrical"), {"binary": True}),
    ".mesh": Format("medit", {"medit:ref": "cell"}, (), {"float_fmt": ".16e"}),
}
"""Ending -> format."""


def write_tetrahedra(path: Path, answer: Answer) -> None:
    """Write a file of the format that the ending of ``path`` tells, and compare what it says.

    Raises:
        NotExact: The format cannot hold the coordinates, or the file differs.
        ValueError: There are no tetrahedra.
    """
    if answer.tetrahedra is None:
        raise ValueError("there are no tetrahedra to write")
    if answer.points.dtype == object:
        raise NotExact("a coordinate is no double, and mesh files hold no others")
    form = FORMATS[path.suffix.lower()]
    found = data(answer)
    arrays = {name: [found[own]] for name, own in form.data.items()}
    arrays |= {name: [np.ones(len(found["cell"]), np.int32)] for name in form.constant}
    cells = [("tetra", answer.tetrahedra.vertices.astype(np.int32))]
    mesh = meshio.Mesh(answer.points, cells, cell_data=arrays)
    with silence():
        meshio.write(path, mesh, form.name, **form.options)
        _require_equal(path, answer, {name: found[own] for name, own in form.data.items()})


def data(answer: Answer) -> dict[str, NDArray[np.int32]]:
    """Return the arrays that go with the tetrahedra."""
    if answer.tetrahedra is None:
        return {}
    cells, kinds = np.empty(answer.faces.number, np.int32), np.empty(answer.faces.number, np.int32)
    for kind, rows in answer.faces.cells.items():
        own = slice(answer.faces.start(kind), answer.faces.start(kind) + len(rows))
        cells[own], kinds[own] = np.arange(1, len(rows) + 1), VTK_TYPES[kind]
    of = answer.tetrahedra.cells
    patterns = answer.tetrahedra.patterns.astype(np.int32)
    return {"cell": cells[of], "kind": kinds[of], "pattern": patterns}


def _require_equal(path: Path, answer: Answer, arrays: dict[str, NDArray[np.int32]]) -> None:
    """Read a file back, and raise NotExact unless it has these tetrahedra, points and data."""
    try:
        mesh = meshio.read(path)
        blocks = [(block.type, np.asarray(block.data)) for block in mesh.cells]
        points = np.asarray(mesh.points, np.float64)
        found = {name: np.concatenate(mesh.cell_data.get(name, [[]])) for name in arrays}
    except (Exception, SystemExit) as error:  # it exits where it knows no reader that does
        raise NotExact(f"{path.name} cannot be read back: {error!a}") from None
    own = answer.tetrahedra.vertices if answer.tetrahedra else np.empty((0, 4), np.int64)
    if {kind for kind, _ in blocks} != {"tetra"} or not (
        np.array_equal(np.concatenate([rows for _, rows in blocks]), own)
        and np.array_equal(points, answer.points)
    ):
        raise NotExact(f"{path.name} has other cells or coordinates when it is read back")
    for name, array in arrays.items():
        if not np.array_equal(found[name], array):
            raise NotExact(f"{path.name} has another {name} when it is read back")


def comments(mesh: str, found: Answer, own: Contradiction) -> list[str]:
    """Return what the cells, the variables and the clauses mean."""
    names = [found.faces.name(cell) for cell in own.cells]
    lines = [
        f"{mesh}: {', '.join(names)} contradict each other.",
        "",
        "Cells are counted from 1 among those of their kind, vertices from 1.",
        "A variable is true iff its quadrilateral is cut through its least vertex:",
    ]
    clauses = Counter(own.owners)
    for variable, quad in enumerate(own.quadrilaterals, start=1):
        a, b, c, d = (int(v) + 1 for v in found.faces.quadrilaterals[quad])
        sides = [found.faces.name(cell) for cell in own.cells if cell in found.faces.sides[quad]]
        lines.append(
            f"  {variable}: quadrilateral {a} {b} {c} {d} of {' and '.join(sides)}; "
            f"true {a} {c}, false {b} {d}"
        )
    lines += ["", "The clauses, in their order:"]
    lines += [f"  {clauses[cell]} of {found.faces.name(cell)}" for cell in own.cells]
    lines += [
        "",
        "A clause excludes diagonals of one cell with which no tetrahedra on its",
        "vertices fill it: by the exact signs of their determinants, and for a",
        "hexahedron by the list of all its triangulations (certify check-all).",
    ]
    return lines


def record(mesh: str, found: Answer, proofs: Sequence[str], quality: str) -> Record:
    """Return everything as JSON. Cells and vertices are counted from 1."""
    return {
        "mesh": mesh,
        "points": len(found.points),
        "cells": {kind: len(rows) for kind, rows in found.faces.cells.items()},
        "quadrilaterals": len(found.faces.sides),
        "split": "no" if found.tetrahedra is None else "yes",
        "quality": quality,
        "tetrahedra": None if found.shape is None else _figures(found.shape),
        "patterns": found.patterns,
        "laid_on_facets": found.laid,
        "by_numbers": {**_figures(found.by_numbers), "cells_beyond": found.beyond_numbers},
        "by_template": _figures(found.by_template),
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
        "quadrilaterals_cut_differently": own.disagreements,
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
