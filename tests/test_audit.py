"""The audit of the paper: its verdicts, and what becomes of them when certificates are missing."""

import re
from collections.abc import Callable, Iterable
from dataclasses import replace
from itertools import combinations

import networkx as nx
import pytest
from pysat.solvers import Cadical153

from certify import paper
from certify.audit import CLAIMS, DECISIONS, Finding, audit, summary
from certify.audit.examples import (
    DENTED,
    MOMENT,
    ON_A_SPHERE,
    PINCHED,
    SAGGING,
    has_inner_point,
    has_positive_jacobian,
    is_convex,
    jacobian_vanishes_at_a_corner_only,
    radon_points_are_as_printed,
    realizes,
    separates,
)
from certify.audit.graphs import (
    Network,
    Tetrahedra,
    around_interior_edges,
    chordless_cycles,
    classes,
    coloured,
    colourless,
    complex_of,
    decomposition,
    dual,
    is_sphere,
    isomorphic,
)
from certify.audit.matroids import convex_sign_vectors, is_uniform_chirotope
from certify.kernel.check import Completeness, Verdict
from certify.kernel.chirotope import QUADRUPLES, chirotope
from certify.kernel.hexahedron import BOUNDARIES, SYMMETRIES, boundary_triangles, image
from certify.kernel.orientations import convex_formula, has_sign
from certify.kernel.theorems import theorems
from certify.kernel.triangulation import orientation
from certify.search.decomposition import adjacency_key, canonical_key, decomposition_graph
from certify.search.spheres import canonical

Verdicts = dict[str, Verdict]

CORRECTED = {
    "ball-link",
    "ball-misprint",
    "convex-therefore",
    "discussion-smallest",
    "figure-valid-15s",
    "graph-adjacency",
    "graph-cycles",
    "graph-edges-again",
    "graph-relabelling",
    "introduction-valid",
    "matroid-alternating",
    "matroid-cospherical",
    "meshes-independent",
    "pattern-15-k",
    "random-up-to-9",
    "realization-hull",
    "sliver-patch",
    "table-2-figure",
    "table-2-underlined-letters",
    "table-4-totals",
    "template-edges",
}

UNDECIDED = {"ball-1296", "ball-nine", "meshes-rare", "table-3-entries", "table-4-entries"}

WITHOUT_CERTIFICATES = {
    "boundary-18",
    "boundary-64",
    "convex-inside",
    "convex-names",
    "cube-four-apexes",
    "cube-triangles-on-facets",
    "cube-types",
    "constraint-circuits",
    "graph-edges-again",
    "introduction-valid",
    "matroid-alternating",
    "matroid-cospherical",
    "matroid-plane",
    "matroid-relations",
    "meshes-additional",
    "meshes-fewer",
    "meshes-independent",
    "ball-pentagon",
    "sliver-no-facet",
    "sliver-patch",
    "sliver-types",
    "table-1-names",
    "table-1-sums",
    "table-2-figure",
    "table-2-names",
    "table-3-totals",
    "table-4-totals",
    "template-edges",
    "template-facets",
}

FIVE: Tetrahedra = ((1, 2, 3, 6), (1, 3, 4, 8), (1, 3, 6, 8), (1, 5, 6, 8), (3, 6, 7, 8))


@pytest.fixture(scope="session")
def findings(verdicts: Verdicts, completeness: list[Completeness]) -> dict[str, Finding]:
    return {f.id: f for f in audit(list(verdicts.values()), completeness)}


@pytest.fixture(scope="session")
def balls(verdicts: Verdicts) -> dict[str, Tetrahedra]:
    return {name: min(verdict.instances) for name, verdict in verdicts.items()}


def with_answer(verdicts: Verdicts, name: str, question: str, answer: str) -> list[Verdict]:
    answers = {**verdicts[name].answers, question: answer}
    return list({**verdicts, name: replace(verdicts[name], answers=answers)}.values())


def changed(findings: dict[str, Finding], others: Iterable[Finding]) -> dict[str, str]:
    return {f.id: f.verdict for f in others if f.verdict != findings[f.id].verdict}


def test_each_claim_has_one_finding(
    findings: dict[str, Finding], verdicts: Verdicts, completeness: list[Completeness]
) -> None:
    listed = audit(list(verdicts.values()), completeness)
    assert [f.id for f in listed] == [claim.id for claim in CLAIMS]
    assert len(findings) == len(CLAIMS) >= 90


def test_findings_are_fit_to_print(findings: dict[str, Finding]) -> None:
    for finding in findings.values():
        assert re.fullmatch(r"[a-z0-9]+(-[a-z0-9]+)*", finding.id)
        assert finding.place
        assert finding.claim.endswith(".")
        assert finding.evidence
        assert all(finding.evidence)
        assert bool(finding.truth) == (finding.verdict in ("corrected", "strengthened"))
        assert not finding.truth or finding.truth.endswith(".")
        for text in (finding.place, finding.claim, finding.truth, *finding.evidence):
            assert text == " ".join(text.split())
            assert text.isascii()
            assert not text.startswith("/")


def test_only_what_is_meant_to_be_is_left_undecided(findings: dict[str, Finding]) -> None:
    assert {f.id for f in findings.values() if f.verdict == "not decided here"} == UNDECIDED
    assert {claim.id for claim in CLAIMS if claim.holds is None} == UNDECIDED


def test_the_paper_is_corrected_where_it_is_wrong(findings: dict[str, Finding]) -> None:
    assert {f.id for f in findings.values() if f.verdict == "corrected"} == CORRECTED


def test_no_claim_hides_a_correction_it_does_not_need(findings: dict[str, Finding]) -> None:
    for claim in CLAIMS:
        if claim.correction and not claim.id.startswith("pattern-15"):
            assert findings[claim.id].verdict == "corrected"
        if claim.stronger:
            assert findings[claim.id].verdict == "strengthened"


def test_summary_counts_every_finding(findings: dict[str, Finding]) -> None:
    counts = summary(list(findings.values()))
    assert tuple(counts) == DECISIONS
    assert sum(counts.values()) == len(findings)
    assert counts["corrected"] == len(CORRECTED)
    assert summary([]) == dict.fromkeys(DECISIONS, 0)


def test_evidence_exists(
    findings: dict[str, Finding], verdicts: Verdicts, completeness: list[Completeness]
) -> None:
    known = {theorem.id for theorem in theorems(list(verdicts.values()), completeness)}
    for finding in findings.values():
        for evidence in finding.evidence:
            if evidence.startswith("theorem "):
                assert evidence.removeprefix("theorem ") in known
            if evidence.startswith("certificates/"):
                assert evidence.removeprefix("certificates/").removesuffix(".json") in verdicts
            if evidence.startswith("proofs/"):
                name, question, _ = evidence.removeprefix("proofs/").split(".")
                assert verdicts[name].answers[question] == "no"


def test_nothing_that_needs_certificates_is_decided_without_them() -> None:
    decided = {f.id for f in audit([], []) if f.verdict != "not decided here"}
    assert decided == WITHOUT_CERTIFICATES


def test_without_completeness_nothing_is_said_of_all_patterns(
    findings: dict[str, Finding], verdicts: Verdicts
) -> None:
    needs_all = {t.id for t in theorems([], []) if t.rests_on}
    for finding in audit(list(verdicts.values()), []):
        if needs_all.isdisjoint(e.removeprefix("theorem ") for e in finding.evidence):
            assert finding == findings[finding.id]
        else:
            assert finding.verdict == "not decided here"


def test_a_missing_certificate_leaves_undecided_what_rests_on_it(
    findings: dict[str, Finding], verdicts: Verdicts, completeness: list[Completeness]
) -> None:
    files = {evidence for finding in findings.values() for evidence in finding.evidence}
    named = {name for name in verdicts if f"certificates/{name}.json" in files}
    assert {"7_A", "11_AD", "13_T", "15_K"} <= named
    for name in (*named, "10_A"):
        rest = [verdict for verdict in verdicts.values() if verdict.pattern != name]
        for finding in audit(rest, completeness):
            file = f"certificates/{name}.json"
            if file in finding.evidence:
                assert finding.verdict == "not decided here", (name, finding)
            assert finding.verdict in ("not decided here", findings[finding.id].verdict)


def test_a_rejected_certificate_counts_as_missing(
    verdicts: Verdicts, completeness: list[Completeness]
) -> None:
    rejected = [*verdicts.values()]
    rejected[rejected.index(verdicts["15_K"])] = Verdict("15_K", fault="spoiled")
    missing = [verdict for name, verdict in verdicts.items() if name != "15_K"]
    assert audit(rejected, completeness) == audit(missing, completeness)


@pytest.mark.parametrize("question", ["realizable", "convex", "valid"])
def test_an_open_answer_never_turns_a_verdict(
    question: str,
    findings: dict[str, Finding],
    verdicts: Verdicts,
    completeness: list[Completeness],
) -> None:
    for name, verdict in verdicts.items():
        if verdict.answers[question] == "no" or verdict.size == 15:
            opened = audit(with_answer(verdicts, name, question, "open"), completeness)
            turned = changed(findings, opened)
            assert turned
            assert set(turned.values()) == {"not decided here"}


def test_verdicts_follow_the_answers(
    findings: dict[str, Finding], verdicts: Verdicts, completeness: list[Completeness]
) -> None:
    turned = changed(findings, audit(with_answer(verdicts, "15_K", "valid", "yes"), completeness))
    assert turned["figure-valid-15s"] == turned["pattern-15-k"] == "confirmed"
    assert turned["discussion-smallest"] == "not decided here"
    turned = changed(findings, audit(with_answer(verdicts, "15_C", "valid", "no"), completeness))
    assert turned["figure-valid-15s"] == "not decided here"
    assert turned["pattern-15-c"] == "corrected"


def test_verdicts_follow_the_print(
    monkeypatch: pytest.MonkeyPatch,
    findings: dict[str, Finding],
    verdicts: Verdicts,
    completeness: list[Completeness],
) -> None:
    (points, row, total), *others = paper.RANDOM_POINTS
    mended = ((points, (*row[:2], 5, *row[3:]), total), *others)
    monkeypatch.setattr(paper, "RANDOM_POINTS", mended)
    edges = tuple("37" if edge == "36" else edge for edge in paper.EDGES)
    monkeypatch.setattr(paper, "EDGES", edges)
    exchanged = {"13_T": "13_S", "13_S": "13_T", "13_W": "13_X", "13_X": "13_W"}
    letters = {name: paper.LETTERS[exchanged.get(name, name)] for name in paper.LETTERS}
    monkeypatch.setattr(paper, "LETTERS", letters)
    assert changed(findings, audit(list(verdicts.values()), completeness)) == dict.fromkeys(
        (
            "template-edges",
            "table-2-underlined-letters",
            "graph-edges-again",
            "table-4-totals",
            "random-up-to-9",
        ),
        "confirmed",
    )


def test_the_tables_add_up_as_the_findings_say() -> None:
    for row, total in paper.TABLE_1.values():
        assert sum(row) == total
    assert all(sum(row) == total for _, _, row, total in paper.MESHES)
    wrong = [points for points, row, total in paper.RANDOM_POINTS if sum(row) != total]
    assert wrong == [3000]
    assert all(len(row) == 11 for _, _, row, _ in paper.MESHES)
    assert all(len(row) == 11 for _, row, _ in paper.RANDOM_POINTS)


def test_the_printed_edges_do_not_bound_the_printed_facets() -> None:
    sides = {"".join(sorted((facet[i - 1], facet[i]))) for facet in paper.FACETS for i in range(4)}
    assert set(paper.EDGES) ^ sides == {"36", "37"}
    assert len(set(paper.EDGES)) == len(sides) == 12


def test_chordless_cycles_are_those_of_networkx(balls: dict[str, Tetrahedra]) -> None:
    for tetrahedra in balls.values():
        size, plain, _ = decomposition(tetrahedra)
        expected = {frozenset(cycle) for cycle in nx.chordless_cycles(nx.Graph(list(plain)))}
        assert chordless_cycles(size, plain) == expected
        assert around_interior_edges(tetrahedra) <= expected


def test_chordless_cycles_of_small_graphs() -> None:
    assert chordless_cycles(4, ((0, 1), (1, 2), (2, 3), (0, 3))) == {frozenset(range(4))}
    assert len(chordless_cycles(4, tuple(combinations(range(4), 2)))) == 4
    assert chordless_cycles(3, ((0, 1), (1, 2))) == frozenset()


def partition(
    balls: dict[str, Tetrahedra], key: Callable[[Tetrahedra], object]
) -> set[frozenset[str]]:
    groups: dict[object, set[str]] = {}
    for name, tetrahedra in balls.items():
        groups.setdefault(key(tetrahedra), set()).add(name)
    return set(map(frozenset, groups.values()))


@pytest.mark.parametrize(
    ("kind", "key"),
    [
        (coloured, lambda t: canonical_key(decomposition_graph(t))),
        (colourless, lambda t: adjacency_key(decomposition_graph(t))),
        (complex_of, canonical),
    ],
)
def test_classes_are_those_of_nauty(
    kind: Callable[[Tetrahedra], Network],
    key: Callable[[Tetrahedra], object],
    balls: dict[str, Tetrahedra],
) -> None:
    assert set(map(frozenset, classes(tuple(balls.items()), kind))) == partition(balls, key)


@pytest.mark.parametrize("kind", [coloured, colourless, complex_of, dual])
def test_symmetries_change_nothing(kind: Callable[[Tetrahedra], Network]) -> None:
    networks = [
        kind(tuple(sorted(image(symmetry, tetrahedron) for tetrahedron in FIVE)))
        for symmetry in SYMMETRIES
    ]
    assert all(isomorphic(networks[0], other) for other in networks)


def test_a_sphere_is_closed_connected_and_round() -> None:
    assert all(is_sphere(boundary_triangles(diagonals)) for diagonals in BOUNDARIES)
    tetrahedron = list(combinations((1, 2, 3, 4), 3))
    apart = [(*face[:2], face[2]) for face in combinations((5, 6, 7, 8), 3)]
    assert is_sphere(tetrahedron)
    assert not is_sphere(tetrahedron[1:])
    assert not is_sphere(tetrahedron + apart)


def solutions(tetrahedra: Tetrahedra, most: int) -> int:
    """Count uniform acyclic sign vectors of the kernel's convex formula, with a solver."""
    formula = [list(clause) for clause in convex_formula(orientation(tetrahedra))]
    formula += [[has_sign(quadruple, 1), has_sign(quadruple, -1)] for quadruple in QUADRUPLES]
    found = 0
    with Cadical153(bootstrap_with=formula) as solver:
        while found < most and solver.solve():
            found += 1
            solver.add_clause([-literal for literal in solver.get_model()])
    return found


def test_sign_vectors_are_those_of_a_solver(
    balls: dict[str, Tetrahedra], verdicts: Verdicts
) -> None:
    for name in sorted(paper.UNDERLINED):
        assert convex_sign_vectors(balls[name]) == solutions(balls[name], 2), name
    for name in ("5_A", "8_E", "15_C"):
        assert convex_sign_vectors(balls[name]) in (None, 1)
        assert solutions(balls[name], 1) == 1
    alone = {name for name in paper.UNDERLINED if convex_sign_vectors(balls[name])}
    assert alone == {paper.NEEDS_FINAL_POLYNOMIAL}


def test_chirotopes_of_general_points_are_uniform() -> None:
    signs = dict(chirotope(MOMENT))
    assert is_uniform_chirotope(signs)
    assert is_uniform_chirotope(chirotope(ON_A_SPHERE))
    assert not is_uniform_chirotope({**signs, (1, 2, 3, 4): 0})
    assert not is_uniform_chirotope({**signs, (1, 3, 5, 7): -signs[1, 3, 5, 7]})
    assert not is_uniform_chirotope(chirotope(PINCHED))


def test_the_examples_show_what_they_should() -> None:
    assert realizes(SAGGING, FIVE)
    assert is_convex(SAGGING)
    assert separates(SAGGING, (1, 2, 3))
    assert not separates(MOMENT, (1, 2, 3))
    assert realizes(DENTED, FIVE)
    assert has_positive_jacobian(DENTED)
    assert has_inner_point(DENTED)
    assert not is_convex(DENTED)
    assert not has_inner_point(SAGGING)
    assert not realizes(MOMENT, FIVE)
    assert not has_positive_jacobian(PINCHED)
    assert jacobian_vanishes_at_a_corner_only(PINCHED)
    assert not jacobian_vanishes_at_a_corner_only(SAGGING)
    assert radon_points_are_as_printed(MOMENT)
    assert not radon_points_are_as_printed(PINCHED)


def test_the_pinched_map_is_injective_on_a_grid() -> None:
    steps = range(7)
    images = {
        tuple(36 * 3 * x - u * v * w for x in (u, v, w))
        for u in steps
        for v in steps
        for w in steps
    }
    assert len(images) == 7**3
