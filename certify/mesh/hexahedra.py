"""What the theorems mean for given hexahedra: which triangulations, which boundaries, valid or not.

What is so or not is decided exactly; qualities are floating-point figures. That a boundary which
no listed triangulation fills has none at all, without further points, is the theorem
``exactly-174``: there are no others than the 6,966, boundary tetrahedra aside. (With one of these,
a facet of four points in a plane would have a tetrahedron of no volume, and another the wrong
diagonal.)
"""
