"""Do exact points realize a triangulation? In convex position?

*Realization*: a placement of the eight points in R^3 in which the tetrahedra are non-degenerate,
coherently oriented, and meet only in common faces: conv S ∩ conv T = conv(S ∩ T) for any two.
Everything is decided from the chirotope, and exactly so when points coincide or are coplanar too.
"""

from collections.abc import Mapping
from itertools import combinations

from certify.kernel.chirotope import Chirotope, circuits
from certify.kernel.hexahedron import Simplex
from certify.kernel.triangulation import label


class NotRealized(ValueError):
    """The points do not show what they should; the message says which test failed."""


def require_realization(orientation: Mapping[Simplex, int], signs: Chirotope) -> None:
    """Raise :class:`NotRealized` unless the points realize the oriented tetrahedra.

    Non-degenerate and coherently oriented, not mirrored: each determinant has its tetrahedron's
    sign. (A mirrored realization is a realization too; its mirror image passes this test.)

    Meeting only in common faces: Lemma. For two non-degenerate tetrahedra S, T the intersection of
    their convex hulls is conv(S ∩ T) iff no circuit has X+ in S and X- in T.
    Proof. A point of both hulls outside conv(S ∩ T) is s = t for two convex combinations that
    differ, as equal ones would be supported on S ∩ T. Then s - t is an affine dependence, positive
    only on S and negative only on T; it is a sum of circuits with signs conforming to its own
    (Rockafellar 1969; Ziegler, Lectures on Polytopes, Lemma 6.7), so one of them has X+ in S and
    X- in T. Conversely, the Radon point of such a circuit lies in both hulls; were it in
    conv(S ∩ T), then, barycentric coordinates in S and in T being unique, X+ and X- would both lie
    in S ∩ T, and the circuit be a dependence of the vertices of S, which has none.

    X+ lies in some tetrahedron and X- in some tetrahedron iff both are faces of the complex: the
    test over all pairs is one look-up a circuit. (S = T needs no exception, for the same reason.)
    """
    for tetrahedron, sign in orientation.items():
        if signs[tetrahedron] == 0:
            raise NotRealized(f"tetrahedron {label(tetrahedron)} is degenerate")
        if signs[tetrahedron] != sign:
            raise NotRealized(f"tetrahedron {label(tetrahedron)} is inverted")
    faces = {
        frozenset(face)
        for tetrahedron in orientation
        for size in (1, 2, 3, 4)
        for face in combinations(tetrahedron, size)
    }
    for positive, negative in circuits(signs):
        if positive in faces and negative in faces:
            raise NotRealized(
                f"faces {label(sorted(positive))} and {label(sorted(negative))} intersect"
            )


def require_convex_position(signs: Chirotope) -> None:
    """Raise :class:`NotRealized` unless every point is an extreme point of the hull.

    Lemma. If the points span R^3, vertex v is not extreme iff {v} is one side of a circuit.
    Proof. v is not extreme iff it is a convex combination of other points; as above the
    dependence v - combination then contains a circuit with X+ = {v}. Conversely such a circuit
    writes v as a convex combination of X-.
    """
    for circuit in circuits(signs):
        for side in circuit:
            if len(side) == 1:
                raise NotRealized(f"vertex {label(side)} is not an extreme point of the hull")
