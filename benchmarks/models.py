"""Tetrahedral meshes made for hexahedra, like those of the paper's Table 3, which are not ours.

    python benchmarks/models.py MODEL SIZE FILE

MODEL is cube, cylinder, shaft or knuckle, each about one unit large; SIZE is the length of the
edges asked for. gmsh (from PyPI) places the points for hexahedra: on surfaces by its packing of
parallelograms, inside by its R-tree (Baudouin and others 2014, "A frontal approach to hex-dominant
mesh generation"), and does not recombine them. FILE is written by meshio; .vtu is good.
"""

import sys
from collections.abc import Callable
from math import pi
from pathlib import Path
from typing import Any

import gmsh
import meshio
import numpy as np

PARALLELOGRAMS, R_TREE = 9, 9
"""Numbers of gmsh's algorithms for surfaces and for solids."""


def cube(occ: Any) -> None:
    """A cube."""
    occ.addBox(0, 0, 0, 1, 1, 1)


def cylinder(occ: Any) -> None:
    """A cylinder as high as it is wide."""
    occ.addCylinder(0, 0, 0, 0, 0, 1, 0.5)


def shaft(occ: Any) -> None:
    """A crank shaft: three journals in line, two pins beside them, and webs between."""
    parts = [(3, occ.addCylinder(x, 0, 0, 0.2, 0, 0, 0.09)) for x in (0, 0.44, 0.88)]
    for x, side in ((0.26, 1), (0.7, -1)):
        parts.append((3, occ.addCylinder(x, 0, 0.16 * side, 0.12, 0, 0, 0.07)))
        for start in (x - 0.08, x + 0.1):
            low = -0.12 if side > 0 else -0.26
            parts.append((3, occ.addBox(start, -0.11, low, 0.1, 0.22, 0.38)))
    occ.fuse(parts[:1], parts[1:])


def knuckle(occ: Any) -> None:
    """A steering knuckle: a hub with a bore, a plate with holes, and two arms with eyes."""
    parts = [(3, occ.addCylinder(0, 0, 0, 0, 0, 0.3, 0.22))]
    parts.append((3, occ.addBox(-0.3, -0.3, 0, 0.6, 0.6, 0.1)))
    for turn in (0, pi):
        arm = [(3, occ.addBox(0.15, -0.06, 0.02, 0.45, 0.12, 0.12))]
        arm.append((3, occ.addCylinder(0.6, 0, -0.02, 0, 0, 0.2, 0.11)))
        occ.rotate(arm, 0, 0, 0, 0, 0, 1, turn + 0.4)
        parts += arm
    (whole, *_), _ = occ.fuse(parts[:1], parts[1:])
    holes = [(3, occ.addCylinder(0, 0, -0.1, 0, 0, 0.6, 0.12))]
    holes += [
        (3, occ.addCylinder(x, y, -0.1, 0, 0, 0.4, 0.04))
        for x in (-0.24, 0.24)
        for y in (-0.24, 0.24)
    ]
    for turn in (0, pi):
        eye = [(3, occ.addCylinder(0.6, 0, -0.1, 0, 0, 0.4, 0.05))]
        occ.rotate(eye, 0, 0, 0, 0, 0, 1, turn + 0.4)
        holes += eye
    occ.cut([whole], holes)


MODELS: dict[str, Callable[[Any], None]] = {
    own.__name__: own for own in (cube, cylinder, shaft, knuckle)
}


def tetrahedra(model: str, size: float) -> tuple[Any, Any]:
    """Return the points (n, 3) and the tetrahedra (m, 4) of a mesh of a model."""
    gmsh.initialize(interruptible=False)
    try:
        gmsh.option.setNumber("General.Terminal", 0)
        gmsh.option.setNumber("General.NumThreads", 1)
        for option in ("MeshSizeMin", "MeshSizeMax"):
            gmsh.option.setNumber(f"Mesh.{option}", size)
        gmsh.option.setNumber("Mesh.Algorithm", PARALLELOGRAMS)
        gmsh.option.setNumber("Mesh.Algorithm3D", R_TREE)
        MODELS[model](gmsh.model.occ)
        gmsh.model.occ.synchronize()
        gmsh.model.mesh.generate(3)
        tags, coordinates, _ = gmsh.model.mesh.getNodes()
        _, nodes = gmsh.model.mesh.getElementsByType(4)
    finally:
        gmsh.finalize()
    number = np.full(int(tags.max()) + 1, -1)
    number[tags.astype(int)] = np.arange(len(tags))
    rows = number[nodes.astype(int)].reshape(-1, 4)
    used, rows = np.unique(rows, return_inverse=True)
    return coordinates.reshape(-1, 3)[used], rows.reshape(-1, 4)


def main(model: str, size: str, path: str) -> None:
    """Write a mesh, and print how large it is."""
    points, rows = tetrahedra(model, float(size))
    meshio.write(Path(path), meshio.Mesh(points, [("tetra", rows)]))
    print(f"{model}: {len(points)} vertices, {len(rows)} tetrahedra")


if __name__ == "__main__":
    if len(sys.argv) != 4 or sys.argv[1] not in MODELS:
        sys.exit(__doc__)
    main(*sys.argv[1:])
