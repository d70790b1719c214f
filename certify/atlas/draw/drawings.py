"""Pictures of a certificate that the kernel accepted: closed, pulled apart, and its graph.

Every function returns a Picture, which picture.py makes SVG of.
"""

from certify.atlas.draw.marks import (
    EDGES,
    JOINED,
    apart_marks,
    ball_marks,
    cube_marks,
    graph_marks,
    legend_marks,
    types_of,
)
from certify.atlas.draw.picture import Label, Mark, Picture
from certify.atlas.draw.scene import witness
from certify.atlas.draw.space import Spot, viewed
from certify.graphs import Tetrahedra, edges
from certify.kernel.certificate import Certificate, No
from certify.kernel.chirotope import Point
from certify.kernel.hexahedron import BOUNDARY_TYPES
from certify.kernel.triangulation import boundary_diagonals, label

SHOWN = {
    "valid": ("Points of a valid hexahedron", "", ""),
    "convex": ("Points in convex position", "valid", "; there is no valid hexahedron"),
    "realizable": ("Points that realize it", "convex", "; none in convex position do"),
}
"""Question -> what its points are, the next question, and what is added if that has a no."""


def view(points: tuple[Point, ...], tetrahedra: Tetrahedra) -> tuple[Spot, ...]:
    """Return the points as they are seen from where the edges are best told apart."""
    return viewed(points, frozenset(edges(tetrahedra)))


def named(tetrahedra: Tetrahedra) -> str:
    """Return the tetrahedra in a row."""
    return " ".join(map(label, tetrahedra))


def shown(certificate: Certificate, question: str) -> str:
    """Return what the points are that answer a question."""
    says, following, reason = SHOWN[question]
    refuted = isinstance(certificate.answers.get(following), No)
    return says + reason * refuted


def closed(certificate: Certificate) -> Picture:
    """Return the hexahedron of a certificate's best points, its inner edges seen through it.

    If there are none: the cube with the diagonals, and the words that no points realize it.
    """
    tetrahedra, name = certificate.tetrahedra, certificate.pattern
    found = witness(certificate)
    if found is None:
        marks: list[Mark] = cube_marks(boundary_diagonals(tetrahedra), (34, 24, 172, 172))
        marks.append(Label("statement", (120, 226), "no points realize it"))
        says = "No points realize it. The cube shows only the diagonals of its facets."
    else:
        question, points = found
        marks = ball_marks(view(points, tetrahedra), tetrahedra, (24, 24, 192, 192))
        says = f"{shown(certificate, question)}: the hexahedron with all edges."
    return Picture(240, 240, tuple(marks), name, says)


def pair(certificate: Certificate) -> Picture:
    """Return the tetrahedra pulled apart, and beside them the closed hexahedron."""
    found = witness(certificate)
    if found is None:
        return unrealized(certificate)
    question, points = found
    tetrahedra = certificate.tetrahedra
    spots = view(points, tetrahedra)
    marks = [
        *apart_marks(spots, tetrahedra, (24, 24, 510, 452)),
        *ball_marks(spots, tetrahedra, (590, 100, 300, 300)),
        *legend_marks([*types_of(tetrahedra), *EDGES], 24, 512, 880),
    ]
    says = f"{shown(certificate, question)}. On the left the tetrahedra {named(tetrahedra)}."
    return Picture(920, 550, tuple(marks), certificate.pattern, says)


def graph(tetrahedra: Tetrahedra) -> Picture:
    """Return the decomposition graph: plain and dashed edges, nodes coloured by type."""
    marks = [
        *graph_marks(tetrahedra, (36, 36, 408, 388)),
        *legend_marks([*JOINED, *types_of(tetrahedra)], 24, 470, 432),
    ]
    title = f"Decomposition graph of {len(tetrahedra)} tetrahedra"
    return Picture(480, 510, tuple(marks), title, f"The nodes are {named(tetrahedra)}.")


def boundary_type(letter: str) -> Picture:
    """Return the representative boundary of a type on the template's cube."""
    diagonals = BOUNDARY_TYPES[letter]
    says = f"The cube 12345678 with the diagonals {named(tuple(sorted(diagonals)))}."
    marks = cube_marks(diagonals, (34, 28, 172, 172))
    return Picture(240, 230, tuple(marks), f"Boundary of type {letter}", says)


def unrealized(certificate: Certificate) -> Picture:
    """Return, of a pattern without points: its graph, its boundary on the cube, and the words."""
    tetrahedra = certificate.tetrahedra
    marks = [
        *graph_marks(tetrahedra, (48, 48, 460, 400)),
        *cube_marks(boundary_diagonals(tetrahedra), (620, 110, 240, 240)),
        Label("statement", (740, 410), "no points realize it"),
        *legend_marks([*JOINED, *types_of(tetrahedra), *EDGES[:2], EDGES[-1]], 24, 512, 880),
    ]
    says = (
        f"No points realize the tetrahedra {named(tetrahedra)}. On the left their decomposition "
        "graph, on the right the cube with the diagonals of its facets."
    )
    return Picture(920, 550, tuple(marks), f"{certificate.pattern}: no points realize it", says)
