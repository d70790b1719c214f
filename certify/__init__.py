"""Exact, machine-replayable audit of the 174 subdivisions of the hexahedron into tetrahedra."""

__version__ = "0.1.0"
