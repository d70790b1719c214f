"""The paper's road to the 174 patterns: 3-spheres, hexahedra in them, decomposition graphs.

What the paper says of decomposition graphs on this road (section 3.3) is for the audit to judge.
"""

from dataclasses import dataclass

from certify.graphs import Tetrahedra, classes, coloured
from certify.kernel.theorems import Outcome
from certify.kernel.triangulation import orbit
from certify.opinions.spheres import Report, hexahedra, spheres


@dataclass(frozen=True)
class SecondDerivation:
    """What the paper's road leads to."""

    spheres: int
    """How many 3-spheres with nine vertices there are."""
    hexahedra: frozenset[Tetrahedra]
    """The least instance of every class, by symmetries, of the hexahedra found in them."""
    graphs: int
    """How many classes of decomposition graphs these have."""
    agrees: bool
    """Are they the patterns that the kernel accepted, each with a graph of its own?"""


def second_derivation(outcome: Outcome, report: Report) -> SecondDerivation:
    """Derive the classes of triangulated hexahedra from the 3-spheres with nine vertices.

    outcome: what the kernel found, to be compared with.
    """
    nine_vertex_spheres = spheres(9, report)
    found = frozenset(min(orbit(tetrahedra)) for tetrahedra in hexahedra(nine_vertex_spheres))
    graphs = len(classes({str(tetrahedra): tetrahedra for tetrahedra in found}, coloured))
    report(f"{len(found)} classes of hexahedra, {graphs} of decomposition graphs")
    accepted = {min(verdict.instances) for verdict in outcome.verdicts if verdict.instances}
    return SecondDerivation(
        spheres=len(nine_vertex_spheres),
        hexahedra=found,
        graphs=graphs,
        agrees=found == accepted and graphs == len(found),
    )
