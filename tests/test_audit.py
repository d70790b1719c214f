"""The audit: each reason turns its verdict, each check can fail, the file of claims is strict."""

import re
from collections.abc import Callable
from dataclasses import replace
from itertools import product
from typing import Any

import pytest
from pysat.solvers import Cadical153

from certify.audit import CHECKS, VERDICTS, Claim, Finding, audit, corrections, summary
from certify.audit.checks import Inputs
from certify.audit.claims import THEOREMS, Accepted, BadClaims, decide, load, load_shipped
from certify.audit.matroids import Formula, uniform_sign_vectors
from certify.audit.samples import Sample
from certify.kernel import names
from certify.kernel.certificate import PATTERN_NAMES, QUESTIONS, Certificate, No
from certify.kernel.check import Verdict
from certify.kernel.chirotope import QUADRUPLES
from certify.kernel.hexahedron import CORNERS
from certify.kernel.orientations import convex_formula, has_sign, realization_formula
from certify.kernel.theorems import Outcome, theorems
from certify.kernel.triangulation import orientation

CLAIMS = load_shipped()
NOTHING = Outcome((), (), tuple(theorems((), ())))
UNDECIDED = "not decided here"


@pytest.fixture(scope="module")
def findings(outcome: Outcome) -> list[Finding]:
    return audit(outcome)


@pytest.fixture(scope="module")
def inputs(outcome: Outcome) -> Inputs:
    return Accepted(outcome).inputs


@pytest.fixture
def all_checks_true(monkeypatch: pytest.MonkeyPatch) -> None:
    """Let checks, which are slow and tested below, not run."""
    for name in CHECKS:
        monkeypatch.setitem(CHECKS, name, lambda _: True)


def with_answer(outcome: Outcome, name: str, question: str, answer: str) -> Outcome:
    verdicts = [
        replace(v, answers={**v.answers, question: answer}) if v.pattern == name else v
        for v in outcome.verdicts
    ]
    return replace(outcome, verdicts=tuple(verdicts))


def proved_anew(outcome: Outcome) -> Outcome:
    return replace(outcome, theorems=tuple(theorems(outcome.verdicts, outcome.completeness)))


# The verdicts


def test_every_verdict_stands(findings: list[Finding]) -> None:
    assert [f.failed for f in findings if f.failed] == []
    assert [(f.id, f.verdict) for f in findings] == [(c.id, c.verdict) for c in CLAIMS]
    assert summary(findings) == {
        "confirmed": 44,
        "corrected": 11,
        "strengthened": 20,
        "illustrated": 4,
        "argued": 12,
        UNDECIDED: 7,
    }
    assert summary([]) == dict.fromkeys(VERDICTS, 0)


def test_corrections_come_by_weight(findings: list[Finding]) -> None:
    assert [(f.weight, f.id) for f in corrections(findings)] == [
        ("mathematics", "table-2-underlined-letters"),
        ("mathematics", "graph-cycles"),
        ("mathematics", "graph-adjacency"),
        ("mathematics", "realization-hull"),
        ("mathematics", "figure-valid-15s"),
        ("mathematics", "discussion-smallest"),
        ("table", "table-4-totals"),
        ("misprint", "template-edges"),
        ("misprint", "table-2-figure"),
        ("misprint", "ball-misprint"),
        ("wording", "matroid-cospherical"),
    ]


def test_all_checks_are_used() -> None:
    assert {name for claim in CLAIMS for name in claim.checks} == set(CHECKS)
    assert {name for claim in CLAIMS for name in claim.theorems} == set(THEOREMS)


@pytest.mark.parametrize("claim", CLAIMS, ids=lambda claim: claim.id)
def test_places_can_be_found(claim: Claim) -> None:
    for place in claim.place.split("; "):
        assert re.match(
            r"(abstract, sentence|section \d(\.\d)?, |caption of (Figure|Table) \d+|Table \d)",
            place,
        )


# Each reason is load-bearing

FLIPS = [(claim, reason) for claim in CLAIMS for reason in claim.computed]


@pytest.mark.parametrize(("claim", "reason"), FLIPS, ids=lambda x: getattr(x, "id", x))
def test_each_reason_turns_its_verdict(
    claim: Claim,
    reason: str,
    outcome: Outcome,
    all_checks_true: None,
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    assert decide(claim, Accepted(outcome).holds).verdict == claim.verdict
    first, second, *answer = reason.split()
    if first == "check":
        monkeypatch.setitem(CHECKS, second, lambda _: False)
        others = [outcome]
    elif first == "theorem":
        unproved = [replace(t, ok=t.ok and t.id != second) for t in outcome.theorems]
        others = [replace(outcome, theorems=tuple(unproved))]
    else:
        others = [
            with_answer(outcome, first, second, other)
            for other in {"yes", "no", "open", "rejected"} - {answer[-1]}
        ]
    for other in others:
        finding = decide(claim, Accepted(other).holds)
        assert (finding.verdict, finding.failed) == (UNDECIDED, (reason,))
        assert finding.amendment == finding.weight == ""


def test_each_answer_turns_exactly_what_names_it(
    outcome: Outcome, findings: list[Finding], all_checks_true: None
) -> None:
    for name, question in product(PATTERN_NAMES, QUESTIONS):
        turned = {f.id for f in audit(with_answer(outcome, name, question, "open")) if f.failed}
        assert turned == {
            claim.id
            for claim in CLAIMS
            if any(answer.startswith(f"{name} {question} =") for answer in claim.answers)
        }


@pytest.mark.parametrize(
    ("name", "question", "turned"),
    [
        ("15_K", "valid", {"figure-valid-15s", "discussion-smallest", "discussion-missed"}),
        ("11_AD", "valid", {"discussion-smallest", "discussion-largest", "tables-3-4-possible"}),
        ("13_T", "convex", {"table-2-underlined", "table-2-underlined-letters", "convex-13"}),
        (
            "15_A",
            "realizable",
            {"theorem-2", "table-2-bold", "realization-three", "figure-all-15s"},
        ),
        ("7_A", "valid", {"discussion-theorem-4", "meshes-171"}),
    ],
)
def test_an_answer_turns_what_rests_on_its_theorems(
    name: str, question: str, turned: set[str], outcome: Outcome
) -> None:
    old = next(v for v in outcome.verdicts if v.pattern == name).answers[question]
    other = {"yes": "no", "no": "yes"}[old]
    flipped = audit(proved_anew(with_answer(outcome, name, question, other)))
    assert turned <= {f.id for f in flipped if f.failed}


def test_without_certificates_only_print_and_template_are_judged() -> None:
    def needs_certificates(claim: Claim) -> bool:
        of_patterns = any(
            CHECKS[name].__module__.endswith("pattern_checks") for name in claim.checks
        )
        return of_patterns or bool(
            claim.answers or set(claim.theorems) - {"boundaries", "tetrahedra"}
        )

    failed = {finding.id for finding in audit(NOTHING) if finding.failed}
    assert failed == {claim.id for claim in CLAIMS if needs_certificates(claim)}


def test_a_rejected_certificate_counts_as_missing(outcome: Outcome) -> None:
    rejected = [
        Verdict("15_K", fault="spoiled") if v.pattern == "15_K" else v for v in outcome.verdicts
    ]
    missing = [v for v in outcome.verdicts if v.pattern != "15_K"]
    one, other = (
        audit(proved_anew(replace(outcome, verdicts=tuple(v)))) for v in (rejected, missing)
    )
    assert one == other
    assert next(f for f in one if f.id == "figure-valid-15s").verdict == UNDECIDED


# Each check can fail

Perturbation = Callable[[Inputs], Inputs]


def field(**changes: Callable[[Inputs], Any]) -> Perturbation:
    """Replace fields of the inputs by what is made of them."""
    return lambda inputs: inputs._replace(**{key: new(inputs) for key, new in changes.items()})


def verdict(name: str, change: Callable[[Inputs], dict[str, Any]]) -> Perturbation:
    """Replace fields of one accepted verdict."""

    def perturbed(inputs: Inputs) -> Inputs:
        changed = replace(inputs.patterns[name], **change(inputs))
        return inputs._replace(patterns={**inputs.patterns, name: changed})

    return perturbed


def as_if(name: str, other: str) -> Perturbation:
    """Let one pattern have the tetrahedra of another."""
    return verdict(name, lambda inputs: {"instances": inputs.patterns[other].instances})


def instances(name: str, *tetrahedra: tuple[tuple[int, ...], ...]) -> Perturbation:
    return verdict(name, lambda _: {"instances": frozenset(tetrahedra)})


def of_15_g(change: Callable[[Certificate], dict[str, Any]]) -> Perturbation:
    """Replace fields of the certificate of 15_G."""

    def changed(inputs: Inputs) -> dict[str, Any]:
        certificate = inputs.patterns["15_G"].certificate
        assert certificate is not None
        return {"certificate": replace(certificate, **change(certificate))}

    return verdict("15_G", changed)


def polynomials_of_15_g(change: Callable[[Any], Any]) -> Perturbation:
    """Change the signs that the final polynomials of 15_G assume."""

    def changed(certificate: Certificate) -> dict[str, Any]:
        answer = certificate.answers["convex"]
        assert isinstance(answer, No)
        polynomials = [replace(p, signs=change(p.signs)) for p in answer.final_polynomials]
        other = replace(answer, final_polynomials=tuple(polynomials))
        return {"answers": {**certificate.answers, "convex": other}}

    return of_15_g(changed)


def letters(**changes: str) -> Perturbation:
    return field(
        letters=lambda i: {**i.letters, **{k[1:]: letter for k, letter in changes.items()}}
    )


def types(kind: str, quadruple: tuple[int, ...]) -> Perturbation:
    return field(types=lambda i: {**i.types, quadruple: kind})


def samples_without(numbers: slice, *sizes: int) -> Perturbation:
    """Take from some of our samples the patterns with so many tetrahedra."""

    def changed(inputs: Inputs) -> tuple[Sample, ...]:
        samples = list(inputs.random_samples)
        samples[numbers] = [
            Sample(v, {name: n for name, n in own.items() if int(name.split("_")[0]) not in sizes})
            for v, own in samples[numbers]
        ]
        return tuple(samples)

    return field(random_samples=changed)


def without_e_and_f(inputs: Inputs) -> Inputs:
    """Turn the letters e and f into g, in print and in what was found: then two have no counts."""
    new = {**dict(zip("abcdefg", "abcdefg", strict=True)), "e": "g", "f": "g"}
    found = {n: replace(v, boundary=new[v.boundary]) for n, v in inputs.patterns.items()}
    printed = {name: new[letter] for name, letter in inputs.letters.items()}
    return inputs._replace(patterns=found, letters=printed)


def from_eleven_tetrahedra(inputs: Inputs) -> Inputs:
    """Let ten more patterns, of ten tetrahedra, have further cycles, and ten of fifteen not."""
    for letter in "ABCDEFGHIJKLMNOPQRST":
        inputs = as_if(f"10_{letter}", "15_K")(inputs)
    for letter in "ABCDEFGHIJ":
        inputs = as_if(f"15_{letter}", "5_A")(inputs)
    return inputs


CUBE_IN_FIVE = ((1, 2, 3, 6), (1, 3, 4, 8), (1, 3, 6, 8), (1, 5, 6, 8), (3, 6, 7, 8))
CUBE_POINTS = tuple(CORNERS.values())
ONE_EDGE = ((1, 2, 3, 4), (1, 2, 5, 6), (1, 2, 7, 8))
"""Twelve boundary triangles, but no ball."""

PERTURBED: dict[str, list[Perturbation]] = {
    "table-1-adds-up": [field(table_1=lambda i: {**i.table_1, "geometrical": ((1, 5), 171)})],
    "table-2-has-the-counts-of-table-1": [
        field(bold=lambda i: i.bold - {"15_B"}),
        field(letters=lambda i: {k: v for k, v in i.letters.items() if k != "9_M"}),
    ],
    "table-2-has-no-gaps": [
        field(letters=lambda i: {k: v for k, v in i.letters.items() if k != "9_C"})
    ],
    "letters-are-seven": [
        field(triangulations_in_figure=lambda _: {5: 7, 8: 7}),
        field(triangulations_in_figure=lambda _: {5: 4, 8: 8}),
        field(letters=lambda i: dict.fromkeys(i.letters, "a")),
    ],
    "text-names-the-underlined": [field(no_matroid=lambda i: (*i.no_matroid[1:], "12_A"))],
    "facets-are-those-of-a-cube": [field(facets=lambda i: ("1243", *i.facets[1:]))],
    "edge-36-is-a-diagonal": [
        field(edges=lambda i: tuple("37" if edge == "36" else edge for edge in i.edges)),
        field(edges=lambda i: (*i.edges, "37")),
        field(edges=lambda i: (*i.edges, "13")),
    ],
    "boundaries-have-18-edges": [
        field(boundaries=lambda i: (*i.boundaries, frozenset(sorted(i.boundaries[0])[1:])))
    ],
    "types-are-orbits": [types("slanted", (1, 2, 4, 5))],
    "triangles-have-four-apexes": [types("slanted", (1, 2, 4, 5))],
    "core-diagonals-touch-no-facet": [types("core diagonal", (1, 2, 4, 5))],
    "grassmann-pluecker-is-an-identity": [
        field(
            relations=lambda i: (tuple((x, y, 1) for x, y, _ in i.relations[0]), *i.relations[1:])
        ),
        field(relations=lambda i: i.relations[1:]),
    ],
    "cramer-is-an-identity": [
        field(
            dependences=lambda i: tuple(tuple((v, q, 1) for v, q, _ in d) for d in i.dependences)
        ),
        field(dependences=lambda i: i.dependences[1:]),
    ],
    "cospherical-points-can-be-uniform": [
        field(on_a_sphere=lambda i: (*i.on_a_sphere[:7], i.on_a_sphere[0])),
        field(on_a_sphere=lambda i: (*i.on_a_sphere[:7], tuple(2 * x for x in i.on_a_sphere[7]))),
    ],
    "one-triangle-turns": [
        field(in_the_plane=lambda i: (i.in_the_plane[0],) * 2),
        field(in_the_plane=lambda i: (i.in_the_plane[0], (*i.in_the_plane[0][:3], (6, 0)))),
    ],
    "table-3-adds-up": [field(meshes=lambda i: ((*i.meshes[0][:3], 10), *i.meshes[1:]))],
    "row-of-3000-points-is-wrong": [
        field(random_points=lambda i: ((*i.random_points[0][:2], 48), *i.random_points[1:])),
        field(random_points=lambda i: (*i.random_points[:8], (*i.random_points[8][:2], 104))),
    ],
    "meshes-have-eight-or-more": [
        field(meshes=lambda i: (("Cube", 127, (1, 5, 2, *[0] * 8), 8), *i.meshes[1:])),
    ],
    "meshes-have-fewer-than-random-points": [
        field(
            meshes=lambda i: (*i.meshes[:11], ("Knuckle", 3_058_481, i.random_points[8][1], 105))
        ),
        field(
            meshes=lambda i: (
                i.meshes[0],
                ("Fusee", 11_975, i.random_points[1][1], 62),
                *i.meshes[2:],
            )
        ),
    ],
    "table-4-lies-within-samples": [
        field(
            random_points=lambda i: (
                (3_000, (1, 5, 5, 7, 13, 16, 4, 0, 0, 0, 0), 51),
                *i.random_points[1:],
            )
        ),
        field(random_samples=lambda i: i.random_samples[20:]),
        field(random_samples=lambda i: (*i.random_samples[:20], *i.random_samples[60:])),
        samples_without(slice(1), 7),
    ],
    "random-points-have-all-up-to-nine": [
        field(random_samples=lambda i: i.random_samples[1:]),
        samples_without(slice(19, 20), 9),
    ],
    "more-than-eleven-are-rare": [
        samples_without(slice(-5, None), 5, 6, 7, 8, 9, 10),
        samples_without(slice(-5, None), 12, 13, 14, 15),
    ],
    "letters-fit-in-one-way": [
        letters(_5_A="b"),
        without_e_and_f,
        verdict("13_T", lambda _: {"boundary": "c"}),
    ],
    "letters-of-the-bold-are-right": [letters(_15_A="f")],
    "letters-of-two-underlined-are-wrong": [
        letters(_13_T="d", _13_W="g"),
        letters(_14_A="d"),
        field(underlined=lambda i: i.underlined - {"13_T"}),
        verdict("13_T", lambda _: {"boundary": "c"}),
    ],
    "either-regular-or-diameter": [as_if("6_A", "7_A"), as_if("6_A", "5_A")],
    "two-have-a-regular-tetrahedron": [
        as_if("5_A", "6_A"),
        instances("5_A", CUBE_IN_FIVE, (CUBE_IN_FIVE[2],)),
    ],
    "duals-tell-five-apart": [as_if("6_A", "6_B"), as_if("6_A", "5_A"), as_if("5_A", "6_A")],
    "cells-of-cubes-are-interior-edges": [as_if("6_A", "15_A")],
    "slivers-leave-two-prisms": [
        as_if("7_B", "7_A"),
        field(types=lambda i: dict.fromkeys(i.types, "core diagonal")),
    ],
    "cones-close-the-balls": [instances("9_A", ONE_EDGE), instances("9_A", ((1, 2, 3, 6),))],
    "cycles-need-not-be-edges": [
        as_if("15_A", "5_A"),
        as_if("5_A", "15_A"),
        from_eleven_tetrahedra,
    ],
    "coloured-graphs-tell-patterns-apart": [as_if("6_C", "6_D")],
    "isomorphism-needs-colours": [as_if("6_C", "6_D"), as_if("6_A", "6_B")],
    "balls-forget-facets": [as_if("15_A", "15_C"), as_if("15_K", "15_C"), as_if("6_A", "6_B")],
    "three-have-no-oriented-matroid": [
        as_if("15_A", "15_C"),
        field(bold=lambda i: i.bold - {"15_B"}),
    ],
    "of-thirteen-one-has-an-oriented-matroid": [
        as_if("12_U", "12_A"),
        as_if("15_G", "15_H"),
        field(underlined=lambda i: i.underlined - {"12_U"}),
    ],
    "final-polynomial-excludes-the-oriented-matroid": [
        of_15_g(lambda _: {"tetrahedra": CUBE_IN_FIVE}),
        polynomials_of_15_g(lambda signs: {q: -sign for q, sign in signs.items()}),
    ],
    "valid-need-not-be-convex": [
        field(dented=lambda _: CUBE_POINTS),
        as_if("5_A", "6_A"),
    ],
    "tables-3-and-4-are-possible": [
        verdict("9_A", lambda i: {"answers": {**i.patterns["9_A"].answers, "valid": "no"}}),
    ],
}


@pytest.mark.parametrize("name", CHECKS)
def test_each_check_holds_and_can_fail(name: str, inputs: Inputs) -> None:
    assert CHECKS[name](inputs)
    assert PERTURBED[name]
    for number, perturb in enumerate(PERTURBED[name]):
        assert not CHECKS[name](perturb(inputs)), number


def test_sign_vectors_are_those_of_a_solver(inputs: Inputs) -> None:
    def solutions(name: str, formula: Formula) -> int:
        signs = orientation(min(inputs.patterns[name].instances))
        clauses = [*formula(signs), *((has_sign(q, 1), has_sign(q, -1)) for q in QUADRUPLES)]
        found = 0
        with Cadical153(bootstrap_with=clauses) as solver:
            while found < 2 and solver.solve():
                found += 1
                solver.add_clause([-literal for literal in solver.get_model()])
        return found

    for formula, patterns in (
        (realization_formula, sorted(names.BOLD)),
        (convex_formula, [*sorted(names.UNDERLINED), "5_A", "15_C"]),
    ):
        for name in patterns:
            ours = uniform_sign_vectors(min(inputs.patterns[name].instances), formula)
            assert (2 if ours is None else len(ours)) == solutions(name, formula), name


# The file of claims

RECORD = {
    "id": '"a-claim"',
    "place": '"section 1"',
    "claim": '"It is so."',
    "verdict": '"confirmed"',
    "theorems": '["patterns"]',
}


def toml(**changes: str | None) -> str:
    record = {**RECORD, **changes}
    return "[[claim]]\n" + "".join(f"{k} = {v}\n" for k, v in record.items() if v is not None)


def test_a_record_becomes_a_claim() -> None:
    answers = '["15_A 15_B convex = no", "5_A valid = yes"]'
    (claim,) = load(toml(answers=answers, checks='["table-1-adds-up"]'))
    assert claim.computed == (
        "theorem patterns",
        "15_A convex = no",
        "15_B convex = no",
        "5_A valid = yes",
        "check table-1-adds-up",
    )


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("[[claim]\n", "not TOML"),
        ("[[claims]]\n", "not a list"),
        ("claim = 1\n", "not a list"),
        ("claim = [1]\n", "not a list"),
        ("x = 1\n" + toml(), "not a list"),
        (toml() + toml(claim='"Else."'), "id: 'a-claim' occurs 2 times"),
        (toml() + toml(id='"b"'), "claim: 'It is so.' occurs 2 times"),
        (toml(id=None), r"claim 1 \(without id\): id: is missing"),
        *((toml(**{key: None}), f"a-claim.*{key}: is missing") for key in ("place", "claim")),
        (toml(verdict=None), "verdict: is missing"),
        (toml(check='"table-1-adds-up"'), "check: is no key"),
        (toml(theorems='"patterns"'), "theorems: is not a list of strings"),
        (toml(theorems="[]"), "theorems: is not a list of strings"),
        (toml(theorems="[1]"), "theorems: 1 is not one line"),
        (toml(place="1"), "place: .* is not one line of ASCII"),
        (toml(place='""'), "place: .* is not one line of ASCII"),
        (toml(claim='"Pl\u00fccker."'), "claim: .* is not one line of ASCII"),
        (toml(claim='" It is so."'), "claim: .* is not one line of ASCII"),
        (toml(id='"A claim"'), "id: is not like-this-1"),
        (toml(verdict='"true"'), "verdict: 'true' is none of"),
        (toml(theorems='["pattern"]'), "theorems: 'pattern' is none of"),
        (toml(checks='["table-2-adds-up"]'), "checks: 'table-2-adds-up' is none of"),
        (toml(theorems='["patterns", "patterns"]'), "reasons: are given twice"),
        (toml(answers='["15_A convex = no", "15_A convex = no"]'), "reasons: are given twice"),
        *(
            (toml(answers=f'["{text}"]'), "answers: .* is not like")
            for text in ("15_A convex", "16_A convex = no", "15_A flat = no", "15_A convex = open")
        ),
        (toml(answers='["convex = no"]'), "answers: .* is not like"),
        (toml(answers='["convex convex = no"]'), "answers: .* is not like"),
        (toml(answers='["15_A convex no no"]'), "answers: .* is not like"),
        *(
            (
                toml(verdict=f'"{verdict}"', theorems=None),
                "a theorem, an answer or a check: is needed",
            )
            for verdict in ("confirmed", "illustrated")
        ),
        (toml(theorems=None, argument='"So."'), "check: is needed if confirmed"),
        (toml(amendment='"Else."'), "amendment: is not for confirmed"),
        (toml(verdict='"strengthened"'), "amendment: is needed if strengthened"),
        (toml(verdict='"corrected"', weight='"table"'), "amendment: is needed if corrected"),
        (toml(verdict='"corrected"', amendment='"No."'), "weight: is needed if corrected"),
        (toml(weight='"table"'), "weight: is not for confirmed"),
        (
            toml(verdict='"corrected"', amendment='"No."', weight='"taste"'),
            "weight: 'taste' is none of",
        ),
        (toml(undecided='"Why."'), "undecided: is not for confirmed"),
        (toml(verdict='"argued"', argument='"So."'), "check: is not for argued"),
        (toml(verdict='"argued"', theorems=None), "argument: is needed if argued"),
        (toml(verdict=f'"{UNDECIDED}"', theorems=None), "undecided: is needed"),
        (toml(verdict=f'"{UNDECIDED}"', undecided='"Why."'), "check: is not for not decided"),
    ],
)
def test_a_bad_record_is_refused(text: str, message: str) -> None:
    with pytest.raises(BadClaims, match=message):
        load(text)
