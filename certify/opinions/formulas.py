"""The formulas of the kernel a second time, from sections 1, 5, 7, 8 of CHECKING and from FORMAT.

Nothing here comes from the kernel: whoever reads the two documents should be able to write this
module, and get the same clauses. Every clause carries the name of its family, so that a difference
can be named. Clauses are sets of literals, and their order is left alone.

Where the kernel uses a rule, this module goes back to what the rule is about: Grassmann-Plücker
clauses come from the truth table of a product of two signs, the signs of the template from the
corners of the reference cube, the parity of a permutation from its cycles.
"""

from collections import Counter
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass
from functools import lru_cache
from itertools import combinations, permutations, product
from typing import TypeAlias

Vertices: TypeAlias = tuple[int, ...]
Clause: TypeAlias = frozenset[int]
Named: TypeAlias = tuple[str, Clause]
"""A clause behind the name of its family."""
Signs: TypeAlias = Mapping[Vertices, int]
"""Tetrahedron -> +1 or -1, the sign of its determinant."""

VERTICES: Vertices = tuple(range(1, 9))
QUADRUPLES = tuple(combinations(VERTICES, 4))
CORNERS: dict[int, Vertices] = {
    1: (0, 0, 0), 2: (1, 0, 0), 3: (1, 1, 0), 4: (0, 1, 0),
    5: (0, 0, 1), 6: (1, 0, 1), 7: (1, 1, 1), 8: (0, 1, 1),
}  # fmt: skip
FACETS = ("1234", "1265", "1485", "2376", "3487", "5678")


# Signs of determinants


def parity(vertices: Vertices) -> int:
    """Return the sign of the permutation that sorts the vertices.

    A cycle of n elements is a product of n - 1 exchanges.
    """
    place = {vertex: i for i, vertex in enumerate(sorted(vertices))}
    waiting = set(place.values())
    sign = 1
    while waiting:
        start = min(waiting)
        waiting.remove(start)
        after = place[vertices[start]]
        while after != start:
            waiting.remove(after)
            sign = -sign
            after = place[vertices[after]]
    return sign


def has(vertices: Vertices, sign: int) -> int:
    """Return the literal that says: the determinant of these vertices, so ordered, has the sign."""
    k = QUADRUPLES.index(tuple(sorted(vertices))) + 1
    return 2 * k - 1 if sign * parity(vertices) > 0 else 2 * k


def lacks(vertices: Vertices, sign: int) -> int:
    """Return the literal that says: the determinant has the other sign, or is zero."""
    return -has(vertices, sign)


def template_sign(vertices: Vertices) -> int:
    """Return the sign of the determinant for the corners of the reference cube."""
    origin, *others = (CORNERS[vertex] for vertex in vertices)
    rows = [[x - o for x, o in zip(point, origin, strict=True)] for point in others]
    determinant = sum(
        parity(columns) * rows[0][columns[0]] * rows[1][columns[1]] * rows[2][columns[2]]
        for columns in permutations(range(3))
    )
    return (determinant > 0) - (determinant < 0)


# The families of the three questions


def exclusive() -> list[Named]:
    """No determinant is both positive and negative."""
    return [("exclusive", frozenset({lacks(q, 1), lacks(q, -1)})) for q in QUADRUPLES]


Condition: TypeAlias = tuple[Callable[[Vertices, int], int], int]
"""What one literal says of a determinant: that it has, or that it lacks, a sign."""

MEETING: dict[Condition, set[int]] = {
    (has, 1): {1}, (has, -1): {-1}, (lacks, 1): {0, -1}, (lacks, -1): {0, 1},
}  # fmt: skip
"""Condition -> the signs that meet it."""


def ensuring(allowed: set[int]) -> list[tuple[Condition, Condition]]:
    """Return the weakest pairs of conditions on two signs under which their product is allowed.

    Read off the truth table: all pairs are tried, and one is left out if a weaker one is there.
    """
    pairs = {
        pair: set(product(MEETING[pair[0]], MEETING[pair[1]])) for pair in product(MEETING, MEETING)
    }
    enough = {
        pair: meeting for pair, meeting in pairs.items() if {x * y for x, y in meeting} <= allowed
    }
    return [
        pair
        for pair, meeting in enough.items()
        if not any(meeting < weaker for weaker in enough.values())
    ]


@lru_cache(maxsize=1)
def grassmann_pluecker() -> tuple[Named, ...]:
    """For each relation, no term has a sign unless another term has the opposite sign.

    The excluded case: one term has the sign, and each of the two others lacks the opposite one.
    """
    clauses = []
    for s, t in combinations(VERTICES, 2):
        for a, b, c, d in combinations([v for v in VERTICES if v not in (s, t)], 4):
            terms = [
                (1, (s, t, a, b), (s, t, c, d)),
                (-1, (s, t, a, c), (s, t, b, d)),
                (1, (s, t, a, d), (s, t, b, c)),
            ]
            for chosen, sign in product(terms, (1, -1)):
                cases = []
                for term in (chosen, *(other for other in terms if other != chosen)):
                    allowed = {sign} if term == chosen else {0, sign}
                    factor, x, y = term
                    cases.append(
                        [
                            {-first(x, f), -second(y, g)}
                            for (first, f), (second, g) in ensuring({factor * e for e in allowed})
                        ]
                    )
                clauses += [frozenset().union(*ways) for ways in product(*cases)]
    return tuple(("Grassmann-Plücker", clause) for clause in clauses)


def oriented(signs: Signs) -> list[Named]:
    """Each tetrahedron has its sign."""
    return [("oriented", frozenset({has(t, sign)})) for t, sign in signs.items()]


def coefficient(quintuple: Vertices, vertex: int) -> tuple[Vertices, int]:
    """Return a determinant and a factor: their product is the vertex's coefficient.

    The coefficients of the affine dependence of a quintuple are, with alternating signs, the
    determinants of the four others.
    """
    others = tuple(v for v in quintuple if v != vertex)
    return others, (-1) ** quintuple.index(vertex)


def is_signed(quintuple: Vertices, vertex: int, sign: int) -> int:
    """Return the literal that says: the coefficient of the vertex has the sign."""
    others, factor = coefficient(quintuple, vertex)
    return has(others, factor * sign)


def no_overlap(tetrahedra: Iterable[Vertices]) -> list[Named]:
    """No circuit has its positive side in one tetrahedron and its negative side in another.

    For a quintuple covered by the faces F and G: if a coefficient on F is positive, or one on G
    negative, then one outside F is positive, or one outside G negative.
    """
    clauses = []
    for quintuple in combinations(VERTICES, 5):
        faces = {frozenset(quintuple) & frozenset(t) for t in tetrahedra}
        maximal = [face for face in faces if not any(face < other for other in faces)]
        for f, g in product(maximal, maximal):
            if f | g == set(quintuple):
                conclusion = {is_signed(quintuple, v, 1) for v in quintuple if v not in f}
                conclusion |= {is_signed(quintuple, v, -1) for v in quintuple if v not in g}
                premises = [is_signed(quintuple, v, 1) for v in f]
                premises += [is_signed(quintuple, v, -1) for v in g]
                clauses += [frozenset({-premise, *conclusion}) for premise in premises]
    return [("no overlap", clause) for clause in clauses]


def on_hull() -> list[Named]:
    """No vertex is inside a tetrahedron of four others: its coefficient alone has a sign."""
    return [
        (
            "on hull",
            frozenset(-is_signed(quintuple, v, sign if v == inside else -sign) for v in quintuple),
        )
        for quintuple in combinations(VERTICES, 5)
        for inside in quintuple
        for sign in (1, -1)
    ]


def across(vertex: int, axis: int) -> int:
    """Return the vertex at the other end of the template's edge along an axis."""
    corner = tuple(x ^ (i == axis) for i, x in enumerate(CORNERS[vertex]))
    return next(v for v in VERTICES if CORNERS[v] == corner)


def corners() -> list[Named]:
    """At each corner the Jacobian has the sign that it has for the reference cube."""
    at = [(v, *(across(v, axis) for axis in range(3))) for v in VERTICES]
    return [("corners", frozenset({has(four, template_sign(four))})) for four in at]


def edges() -> list[Named]:
    """Along an edge, if both mixed determinants are negative, then two others have equal signs.

    The common sign of the four determinants is that which makes the first positive for the
    reference cube.
    """
    clauses = []
    for axis in range(3):
        for v in VERTICES:
            w = across(v, axis)
            if v > w:
                continue
            second, third = (other for other in range(3) if other != axis)
            p, q, far_p, far_q = (across(e, o) for e in (v, w) for o in (second, third))
            common = template_sign((v, w, p, q))
            premises = {lacks((v, w, p, far_q), -common), lacks((v, w, far_p, q), -common)}
            clauses += [
                frozenset({*premises, has((v, w, p, far_p), sign), has((v, w, q, far_q), -sign)})
                for sign in (1, -1)
            ]
    return [("edges", clause) for clause in clauses]


def sections(tetrahedra: Iterable[Vertices]) -> list[Named]:
    """If a plane between two opposite facets would not cut a disc, they have no opposite signs."""
    cells = [frozenset(t) for t in tetrahedra]
    faces = {frozenset(face) for cell in cells for n in (2, 3, 4) for face in combinations(cell, n)}
    clauses = []
    for axis in range(3):
        near = tuple(v for v in VERTICES if CORNERS[v][axis] == 0)
        far = tuple(across(v, axis) for v in near)
        cut = [face for face in faces if face & set(near) and face & set(far)]
        if sum((-1) ** len(face) for face in cut) != 1:
            clauses += [frozenset({lacks(near, sign), lacks(far, -sign)}) for sign in (1, -1)]
    return [("sections", clause) for clause in clauses]


def realizable(signs: Signs) -> list[Named]:
    """Return the clauses for: the tetrahedra, with these signs, have a realization."""
    return [*exclusive(), *grassmann_pluecker(), *oriented(signs), *no_overlap(signs)]


def convex(signs: Signs) -> list[Named]:
    """Return the clauses for: they have one with every point on the boundary of the hull."""
    return [*realizable(signs), *on_hull()]


def valid(signs: Signs) -> list[Named]:
    """Return the clauses for: they have one with a positive Jacobian."""
    return [*realizable(signs), *corners(), *edges(), *sections(signs)]


# Final polynomials


Inequality: TypeAlias = tuple[int, Vertices]
"""A multiplier and the vertices s, t, a, b, c, d."""


class NotAbsurd(ValueError):
    """A final polynomial does not exclude its signs; the message says why."""


def excluded(assumed: Signs, inequalities: Iterable[Inequality]) -> Named:
    """Return the clause that says: the determinants do not all have the assumed signs.

    Raise NotAbsurd unless the inequalities follow from the signs, one of them strictly, and
    every determinant occurs equally often on both of their sides.
    """

    def sign(*factors: Vertices) -> int | None:
        known = [assumed.get(tuple(sorted(factor))) for factor in factors]
        if 0 in known:
            return 0
        result = 1
        for value, factor in zip(known, factors, strict=True):
            if value is None:
                return None
            result *= value * parity(factor)
        return result

    balance: Counter[Vertices] = Counter()
    strict = False
    for times, (s, t, a, b, c, d) in inequalities:
        if times < 1:
            raise NotAbsurd(f"the multiplier {times} is not positive")
        larger = (s, t, a, b), (s, t, c, d)
        smaller = (s, t, a, c), (s, t, b, d)
        rest = sign((s, t, a, d), (s, t, b, c))
        if not sign(*smaller) or rest is None or rest == sign(*smaller):
            raise NotAbsurd(f"the signs do not imply the inequality of {(s, t, a, b, c, d)}")
        strict |= rest != 0
        for factor in larger:
            balance[tuple(sorted(factor))] += times
        for factor in smaller:
            balance[tuple(sorted(factor))] -= times
    if not strict:
        raise NotAbsurd("no inequality is strict")
    if any(balance.values()):
        raise NotAbsurd("a determinant does not occur equally often on both sides")
    literals = {lacks(q, s) for q, s in assumed.items() if s}
    literals |= {has(q, s) for q, zero in assumed.items() if not zero for s in (1, -1)}
    return "final polynomials", frozenset(literals)


# Completeness


TETRAHEDRA = tuple(
    q for q in QUADRUPLES if set(q) not in [set(map(int, facet)) for facet in FACETS]
)
"""The possible tetrahedra: variable k = 1..64 says that the k-th of them is there."""


def boundary_triangles(diagonals: Iterable[Vertices]) -> set[Vertices]:
    """Return the twelve triangles into which the diagonals cut the facets."""
    cuts = [set(diagonal) for diagonal in diagonals]
    return {
        triangle
        for facet in FACETS
        for triangle in combinations(sorted(map(int, facet)), 3)
        if any(cut <= set(triangle) for cut in cuts)
    }


def boundary_edges(diagonals: Iterable[Vertices]) -> set[Vertices]:
    """Return the eighteen edges of these triangles."""
    return {e for triangle in boundary_triangles(diagonals) for e in combinations(triangle, 2)}


def on(face: Iterable[int]) -> list[int]:
    """Return the variables of the tetrahedra with this face."""
    return [k for k, t in enumerate(TETRAHEDRA, start=1) if set(face) <= set(t)]


def triangle_families(diagonals: Iterable[Vertices]) -> list[Named]:
    """A boundary triangle lies in exactly one tetrahedron, every other in none or two."""
    boundary = boundary_triangles(diagonals)
    clauses = []
    for triangle in combinations(VERTICES, 3):
        possible = on(triangle)
        if triangle in boundary:
            clauses.append(frozenset(possible))
            clauses += [frozenset({-x, -y}) for x, y in combinations(possible, 2)]
        else:
            clauses += [frozenset({-x} | (set(possible) - {x})) for x in possible]
            clauses += [frozenset({-x, -y, -z}) for x, y, z in combinations(possible, 3)]
    return [("triangles", clause) for clause in clauses]


def cycles(vertices: Iterable[int], length: int) -> list[tuple[Vertices, ...]]:
    """Return the cycles of a length on some of the vertices, each as its edges."""
    found = {
        frozenset(tuple(sorted((order[i - 1], order[i]))) for i in range(length))
        for order in permutations(vertices, length)
    }
    return [tuple(cycle) for cycle in found]


def edge_families(diagonals: Iterable[Vertices]) -> list[Named]:
    """The tetrahedra around an edge form one fan, one wheel, or there are none.

    A boundary edge has no cycle in its link that avoids the two ends of the fan, another no two
    disjoint cycles. A cycle that needs four vertices of a facet is none.
    """
    boundary = boundary_triangles(diagonals)
    forbidden: list[tuple[Vertices, tuple[Vertices, ...]]] = []
    for u, w in combinations(VERTICES, 2):
        edge: Vertices = (u, w)
        others = [v for v in VERTICES if v not in edge]
        inside = [v for v in others if tuple(sorted((*edge, v))) not in boundary]
        if edge in boundary_edges(diagonals):
            links = [cycle for length in (3, 4) for cycle in cycles(inside, length)]
        else:
            links = [
                one + two
                for one, two in combinations(cycles(others, 3), 2)
                if not {v for e in one for v in e} & {v for e in two for v in e}
            ]
        forbidden += [(edge, link) for link in links]
    clauses = []
    for edge, link in forbidden:
        around = [tuple(sorted((*edge, *pair))) for pair in link]
        if all(t in TETRAHEDRA for t in around):
            clauses.append(frozenset(-TETRAHEDRA.index(t) - 1 for t in around))
    return [("edges", clause) for clause in clauses]


def is_or(variable: int, *cases: Iterable[int]) -> list[Clause]:
    """Return the clauses of: the variable is true iff all literals of one of the cases are."""
    clauses = [frozenset({variable, *(-x for x in case)}) for case in cases]
    return clauses + [frozenset({-variable, *choice}) for choice in product(*cases)]


class Definitions:
    """The variables from 65 on, in the order in which they are defined, and their clauses."""

    def __init__(self) -> None:
        self.last = len(TETRAHEDRA)
        self.clauses: list[Clause] = []

    def define(self, *cases: Iterable[int]) -> int:
        """Return a new variable that is true iff all literals of one of the cases are."""
        self.last += 1
        self.clauses += is_or(self.last, *cases)
        return self.last

    def at_least(self, literals: list[int], most: int) -> list[int]:
        """Return the variables for: at least 1, ..., at least ``most`` of the literals are true.

        At least j of the first n are iff at least j of the first n - 1 are, or the n-th is and at
        least j - 1 of the first n - 1.
        """
        before: list[int] = []
        for literal in literals:
            now = []
            for j in range(min(len(before) + 1, most)):
                newly = [literal, before[j - 1]] if j else [literal]
                now.append(self.define(*([[before[j]]] if j < len(before) else []), newly))
            before = now
        return before


def vertex_families(diagonals: Iterable[Vertices]) -> list[Named]:
    """At a vertex with b boundary triangles and i inner edges there are b - 2 + 2i tetrahedra.

    Said of all i from 0 to the greatest possible: if there are at least i inner edges, then at
    least b - 2 + 2i tetrahedra, and if not more than i, then not more than so many.
    """
    cuts = list(diagonals)
    defined = Definitions()
    outer = boundary_edges(cuts)
    inner = [edge for edge in combinations(VERTICES, 2) if edge not in outer]
    used = {edge: defined.define(*([k] for k in on(edge))) for edge in inner}
    for v in VERTICES:
        base = sum(v in triangle for triangle in boundary_triangles(cuts)) - 2
        here = [used[edge] for edge in inner if v in edge]
        inner_edges = defined.at_least(here, len(here))
        tetrahedra = defined.at_least(on([v]), base + 2 * len(here) + 1)
        for i in range(len(here) + 1):
            enough, too_many = tetrahedra[base + 2 * i - 1], tetrahedra[base + 2 * i]
            fewer = {-inner_edges[i - 1]} if i else set()
            more = {inner_edges[i]} if i < len(here) else set()
            defined.clauses += [frozenset({*fewer, enough}), frozenset({*more, -too_many})]
    return [("vertices", clause) for clause in defined.clauses]


def completeness(diagonals: Iterable[Vertices], known: Iterable[Iterable[Vertices]]) -> list[Named]:
    """Return the clauses of a triangulation with the boundary that is not among the known ones.

    diagonals: the six of the boundary; known: sets of tetrahedra.
    """
    cuts = list(diagonals)
    clauses = [*triangle_families(cuts), *edge_families(cuts), *vertex_families(cuts)]
    for chosen in map(set, known):
        clause = frozenset(-k if t in chosen else k for k, t in enumerate(TETRAHEDRA, start=1))
        clauses.append(("known", clause))
    return clauses


# Comparison


@dataclass(frozen=True)
class Difference:
    """How a list of clauses differs from the one written here, each counted as often as it occurs.

    missing: family -> the clauses of it that the list lacks; unexplained: those in the list that
    belong to no family.
    """

    missing: dict[str, list[Clause]]
    unexplained: list[Clause]

    def __bool__(self) -> bool:
        """Is there a difference?"""
        return bool(self.missing or self.unexplained)


def difference(expected: Iterable[Named], clauses: Iterable[Iterable[int]]) -> Difference:
    """Compare clauses with the expected ones; neither their order nor that of literals matters."""
    left = Counter(map(frozenset, clauses))
    missing: dict[str, list[Clause]] = {}
    for family, clause in expected:
        if left[clause]:
            left[clause] -= 1
        else:
            missing.setdefault(family, []).append(clause)
    return Difference(missing, list(left.elements()))
