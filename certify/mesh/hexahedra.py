"""What the theorem means for given hexahedra: which triangulations, which boundaries, valid or not.

Whether something is so is decided exactly; qualities are floating-point figures. The Jacobian of
a hexahedron is that of the trilinear map which takes the corners of the unit cube to its vertices,
in volume units.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property, lru_cache
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from certify.kernel.chirotope import QUADRUPLES, Point, determinant, integral
from certify.kernel.evidence import default_root
from certify.kernel.hexahedron import CORNERS, VERTICES, Simplex, simplex, sorted_with_sign
from certify.mesh.compiled import compiled
from certify.mesh.instances import QUADRUPLE_INDEX, Instance
from certify.mesh.jacobian import positive
from certify.mesh.quality import scaled_jacobians
from certify.mesh.realized import Booleans, fillable, labelled, realized
from certify.mesh.shapes import least_dihedral_angle, mean_ratio
from certify.mesh.signs import Floats, Numbers, Signs, numbers, signs

EDGES = tuple(
    (v, w, axis)
    for axis in range(3)
    for v in VERTICES
    if CORNERS[v][axis] == 0
    for w in [next(x for x in VERTICES if CORNERS[x] == _moved(CORNERS[v], axis))]
)
