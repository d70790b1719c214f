"""Theorems are shown by all they rest on together; what they state is counted again."""

import json
import platform
import re
from collections import Counter
from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from functools import cached_property
from hashlib import sha256
from itertools import combinations, product
from pathlib import Path
from random import Random
from shutil import copytree
from typing import Any

import pytest
import sympy

from certify.kernel.certificate import PATTERN_NAMES, QUESTIONS
from certify.kernel.check import Completeness, Verdict
from certify.kernel.cube import TETRAHEDRON_TYPES, triangulates_cube
from certify.kernel.evidence import (
    certificate_file,
    completeness_file,
    digest,
    kernel_digest,
    proof_file,
)
from certify.kernel.names import LETTERS
from certify.kernel.theorems import Outcome, Theorem, check_all, theorems
from certify.kernel.triangulation import orientation
from tests.geometry import (
    CUBE,
    QUADRUPLES,
    VERTICES,
    Tetrahedra,
    cube_symmetries,
    dot,
    meet_in_common_face,
    minus,
    relabel,
    strictly_inside,
    volume,
)

Verdicts = dict[str, Verdict]

OF_THE_TEMPLATE = ["boundaries", "tetrahedra"]
OF_THE_LIST = ["patterns", "sizes", "letters", "instances"]
OF_THE_CUBE = ["cube", "finite-precision-cube", "ten"]
OF_SPACE = [
    "realizable",
    "realizable-sizes",
    "convex",
    "names",
    "valid",
    "not-valid",
    "valid-sizes",
]
ALL = [*OF_THE_TEMPLATE, *OF_THE_LIST, *OF_THE_CUBE, *OF_SPACE]

every_theorem = pytest.mark.parametrize("name", ALL)
every_theorem_about_patterns = pytest.mark.parametrize(
    "name", [name for name in ALL if name not in OF_THE_TEMPLATE]
)


def shown(verdicts: Verdicts, completeness: list[Completeness]) -> set[str]:
    """Return the ids of the theorems that are shown."""
    return {theorem.id for theorem in theorems(list(verdicts.values()), completeness) if theorem.ok}


@pytest.fixture(scope="module")
def proved(verdicts: Verdicts, completeness: list[Completeness]) -> dict[str, Theorem]:
    """Return the theorems that the shipped certificates show, by id."""
    found = theorems(list(verdicts.values()), completeness)
    return {theorem.id: theorem for theorem in found if theorem.ok}


# What they rest on.


def test_ids_are_unique() -> None:
    assert [theorem.id for theorem in theorems([], [])] == ALL
    assert len(set(ALL)) == len(ALL)


@every_theorem
def test_shipped_certificates_show(proved: dict[str, Theorem], name: str) -> None:
    theorem = proved[name]
    assert bool(theorem.rests_on) == (name not in OF_THE_TEMPLATE)
    assert theorem.statement.endswith(".")


def test_theorems_rest_on_existing_files(shipped: Path, proved: dict[str, Theorem]) -> None:
    for theorem in proved.values():
        assert len(set(theorem.rests_on)) == len(theorem.rests_on)
        assert all((shipped / file).is_file() for file in theorem.rests_on)


CERTIFICATES = [*map(certificate_file, PATTERN_NAMES)]
COMPLETENESS = [*map(completeness_file, "abcdefg")]
QUESTIONS_OF = {
    "realizable": ["realizable"],
    "realizable-sizes": ["realizable"],
    "convex": ["realizable", "convex"],
    "names": ["realizable", "convex"],
    "valid": ["valid"],
    "not-valid": [*QUESTIONS],
    "valid-sizes": ["valid"],
}


@every_theorem_about_patterns
def test_rests_on_is_exact(
    proved: dict[str, Theorem], verdicts: Verdicts, completeness: list[Completeness], name: str
) -> None:
    """All it names is needed: without any one file the theorem is not shown. Nothing else is."""
    refutations = [
        proof_file(pattern, question)
        for question in QUESTIONS_OF.get(name, [])
        for pattern in sorted(PATTERN_NAMES)
        if verdicts[pattern].answers[question] == "no"
    ]
    assert proved[name].rests_on == (*CERTIFICATES, *COMPLETENESS, *refutations)


@pytest.mark.parametrize("proof", ["15_A.realizable", "15_G.convex", "15_K.valid", "complete.c"])
def test_a_spoiled_proof_spoils_what_rests_on_it_alone(
    shipped: Path, tmp_path: Path, proof: str
) -> None:
    for folder in ("certificates", "proofs"):
        copytree(shipped / folder, tmp_path / folder)
    (tmp_path / "proofs" / f"{proof}.lrat").write_text("1 0 0\n")
    outcome = check_all(tmp_path)
    assert len(outcome.faults) == 1
    assert f"proofs/{proof}.lrat" in outcome.faults[0]
    for theorem, before in zip(outcome.theorems, check_all(shipped).theorems, strict=True):
        assert theorem.ok == (f"proofs/{proof}.lrat" not in before.rests_on)


@pytest.mark.parametrize(
    ("pattern", "question", "files"),
    [
        ("15_A", "realizable", ["certificates/15_A.json", "proofs/15_A.realizable.lrat"]),
        ("8_E", "valid", ["certificates/8_E.json"]),
    ],
)
def test_an_answer_rests_on_its_certificate_and_its_proof(
    verdicts: Verdicts, pattern: str, question: str, files: list[str]
) -> None:
    assert [*verdicts[pattern].rests_on(question)] == files
    assert set(files) <= verdicts[pattern].files.keys()


def test_nothing_shows_the_theorems_of_the_template_only() -> None:
    assert shown({}, []) == set(OF_THE_TEMPLATE)


SOME = ["5_A", "7_B", "11_AD", "12_U", "15_A", "15_C", "15_K"]
"""Patterns of all kinds."""


@pytest.mark.parametrize("name", SOME)
def test_no_theorem_about_patterns_without(
    verdicts: Verdicts, completeness: list[Completeness], name: str
) -> None:
    """A certificate is missing, rejected, or about the class of another pattern."""
    others = {other: verdict for other, verdict in verdicts.items() if other != name}
    assert shown(others, completeness) == set(OF_THE_TEMPLATE)

    rejected = Verdict(name, fault="spoiled")
    assert shown(verdicts | {name: rejected}, completeness) == set(OF_THE_TEMPLATE)

    for other in ("5_A", "15_J"):
        double = replace(verdicts[name], instances=verdicts[other].instances)
        assert (shown(verdicts | {name: double}, completeness) == set(ALL)) == (name == other)


@pytest.mark.parametrize("letter", "abcdefg")
def test_no_theorem_about_patterns_unless_complete_for(
    verdicts: Verdicts, completeness: list[Completeness], letter: str
) -> None:
    others = [found for found in completeness if found.boundary != letter]
    (own,) = (found for found in completeness if found.boundary == letter)
    assert shown(verdicts, others) == set(OF_THE_TEMPLATE)
    assert shown(verdicts, [*others, replace(own, fault="spoiled")]) == set(OF_THE_TEMPLATE)
    assert shown(verdicts, [*others, own]) == set(ALL)


@pytest.mark.parametrize("letter", "abcdefg")
def test_completeness_counts_only_for_what_it_lists(
    verdicts: Verdicts, completeness: list[Completeness], letter: str
) -> None:
    """A proof about a list with a triangulation that no verdict has accepted shows nothing."""
    others = [found for found in completeness if found.boundary != letter]
    (own,) = (found for found in completeness if found.boundary == letter)
    foreign = ((1, 2, 3, 4),)
    wider = replace(own, listed=own.listed | {foreign})
    assert shown(verdicts, [*others, wider]) == set(OF_THE_TEMPLATE)
    known = frozenset[Any]().union(*(verdict.instances for verdict in verdicts.values()))
    assert shown(verdicts, [*others, replace(own, listed=known)]) == set(ALL)


def test_completeness_does_not_make_up_for_a_pattern(
    verdicts: Verdicts, completeness: list[Completeness]
) -> None:
    """All that is listed is known, but not as the classes of the 174 patterns, each by itself."""
    both = verdicts["5_A"].instances | verdicts["15_K"].instances
    wide = verdicts | {"5_A": replace(verdicts["5_A"], instances=both)}
    missing = {name: verdict for name, verdict in wide.items() if name != "15_K"}
    twice = wide | {"15_K": replace(verdicts["15_K"], instances=frozenset((min(both),)))}
    foreign = replace(verdicts["15_K"], pattern="15_L", instances=frozenset((((1, 2, 3, 4),),)))
    for spoiled in (missing, twice, verdicts | {"15_L": foreign}):
        assert shown(spoiled, completeness) == set(OF_THE_TEMPLATE)


def answering(verdicts: Verdicts, name: str, question: str, answer: str) -> Verdicts:
    """Return the verdicts with another answer for one pattern."""
    verdict = verdicts[name]
    return verdicts | {name: replace(verdict, answers=verdict.answers | {question: answer})}


DECIDED = {
    "realizable": {"realizable", "realizable-sizes"},
    "convex": {"convex"},
    "valid": {"valid", "valid-sizes"},
}
"""Question -> theorems that need all 174 answers."""


@pytest.mark.parametrize("question", QUESTIONS)
@pytest.mark.parametrize("name", SOME)
def test_open_and_opposite_answers_do_not_count(
    verdicts: Verdicts, completeness: list[Completeness], name: str, question: str
) -> None:
    opposite = {"yes": "no", "no": "yes"}[verdicts[name].answers[question]]
    for answer, no_more in (("open", DECIDED[question]), (opposite, {question})):
        still = shown(answering(verdicts, name, question, answer), completeness)
        assert still.isdisjoint(no_more)
        assert still >= {*OF_THE_TEMPLATE, *OF_THE_LIST, *OF_THE_CUBE}


@pytest.mark.parametrize(
    ("theorem", "question", "name"),
    [("not-valid", "valid", "5_A"), ("convex", "realizable", "15_A")],
)
def test_open_answers_are_not_counted_as_the_others(
    verdicts: Verdicts, completeness: list[Completeness], theorem: str, question: str, name: str
) -> None:
    """As long as one is open, it is not known of how many these are the others."""
    assert theorem not in shown(answering(verdicts, name, question, "open"), completeness)


@pytest.mark.parametrize(
    ("one", "other"),
    [
        pytest.param("8_A", "8_B", id="other letter"),
        pytest.param("15_I", "15_K", id="other status"),
        pytest.param("15_A", "15_C", id="bold"),
        pytest.param("8_B", "8_C", id="same cell"),
        pytest.param("15_F", "15_G", id="same cell, but 15_G is last"),
        pytest.param("15_G", "15_H", id="same cell, and 15_G is last"),
        pytest.param("13_S", "13_T", id="letters as printed"),
    ],
)
def test_no_two_patterns_can_exchange_their_names(
    verdicts: Verdicts, completeness: list[Completeness], one: str, other: str
) -> None:
    exchanged = {
        one: replace(verdicts[other], pattern=one),
        other: replace(verdicts[one], pattern=other),
    }
    still = shown(verdicts | exchanged, completeness)
    assert "names" not in still
    assert still >= {*OF_THE_TEMPLATE, *OF_THE_LIST}


# What they count, if it were other than it is. Where all is complete and the classes are different,
# their numbers can change only if some triangulations are in two of them.


def with_more(verdicts: Verdicts, more: dict[str, int]) -> Verdicts:
    """Return the verdicts with so many instances more, by name: those that others lose, or have."""
    changed = dict(verdicts)
    everything = sorted({i for verdict in verdicts.values() for i in verdict.instances})
    lost: list[Tetrahedra] = []
    for name, number in sorted(more.items(), key=lambda item: item[1]):
        own = verdicts[name].instances
        if number < 0:
            lost += sorted(own)[number:]
            own = own.difference(lost)
        for _ in range(number):
            others = lost or everything
            own |= {next(i for i in reversed(others) if i not in own)}
            lost = lost[:-1]
        changed[name] = replace(verdicts[name], instances=own)
    return changed


@pytest.mark.parametrize(
    ("theorem", "more"),
    [
        pytest.param("instances", {"5_A": 1, "8_A": -1}, id="3 and 47, not 2"),
        pytest.param("instances", {"8_A": 1, "8_B": -1}, id="47 and 49 as well"),
        pytest.param("instances", {"11_E": -8, "12_AD": 8}, id="8 and 24, not 16"),
        pytest.param("instances", {"6_A": 24}, id="48 for 24: too many"),
        pytest.param("instances", {"6_A": 24, "8_A": -24, "8_B": -24}, id="24 for 48: too few"),
        pytest.param("cube", {"6_A": 24}, id="a large class"),
        pytest.param("cube", {"8_A": 24, "6_A": -12}, id="a small class"),
    ],
)
def test_other_numbers_of_instances(
    verdicts: Verdicts, completeness: list[Completeness], theorem: str, more: dict[str, int]
) -> None:
    still = shown(with_more(verdicts, more), completeness)
    assert theorem not in still
    assert "patterns" in still


@pytest.mark.parametrize(
    ("theorem", "answers"),
    [
        ("realizable", ["5_A realizable no"]),
        ("realizable", ["15_A realizable yes"]),
        ("realizable-sizes", ["5_A realizable no"]),
        ("realizable-sizes", ["15_A realizable yes"]),
        ("convex", ["5_A realizable no", "5_A convex no"]),
        ("convex", ["12_U realizable no"]),
        ("convex", ["15_A realizable yes"]),
        ("convex", ["15_A convex yes"]),
        ("names", ["5_A realizable no"]),
        ("names", ["15_A realizable yes", "15_A convex yes"]),
        ("valid", ["5_A valid no"]),
        ("valid", ["15_A valid yes"]),
        ("not-valid", ["5_A valid no"]),
        ("not-valid", ["11_AD valid yes"]),
        ("not-valid", ["12_U valid yes"]),
        ("not-valid", ["15_A valid yes"]),
        ("not-valid", ["15_A valid yes", "15_A realizable yes"]),
        ("valid-sizes", ["5_A valid no"]),
        ("valid-sizes", ["11_AD valid yes"]),
        ("valid-sizes", ["15_C valid no"]),
        ("valid-sizes", ["15_K valid yes"]),
    ],
)
def test_other_numbers_of_answers(
    verdicts: Verdicts, completeness: list[Completeness], theorem: str, answers: list[str]
) -> None:
    for other in answers:
        name, question, answer = other.split()
        verdicts = answering(verdicts, name, question, answer)
    still = shown(verdicts, completeness)
    assert theorem not in still
    assert "patterns" in still


def taken_for(verdicts: Verdicts, name: str, other: str) -> Verdicts:
    """Return the verdicts with instances of another pattern as those of a pattern.

    Its own ones are added to the class that has the least of all.
    """
    least = {pattern: min(verdict.instances) for pattern, verdict in verdicts.items()}
    first = min(least, key=least.__getitem__)
    foreign = verdicts[other].instances - set(least.values())
    letter = verdicts[other].boundary
    everything = verdicts[first].instances | verdicts[name].instances
    return verdicts | {
        first: replace(verdicts[first], instances=everything),
        name: replace(verdicts[name], instances=foreign, boundary=letter),
    }


@pytest.mark.parametrize(
    ("theorem", "taken"),
    [
        pytest.param("cube", {"6_A": "8_A"}, id="five of the cube"),
        pytest.param("cube", {"8_A": "6_A"}, id="seven of the cube"),
        pytest.param("finite-precision-cube", {"7_B": "8_A"}, id="three with slivers"),
        pytest.param("finite-precision-cube", {"8_A": "7_B"}, id="five with slivers"),
        pytest.param("ten", {"8_A": "7_B"}, id="eleven"),
        pytest.param("ten", {"7_B": "8_A"}, id="nine"),
        pytest.param("ten", {"8_A": "7_B", "5_A": "9_A"}, id="ten, but not 5_A"),
        pytest.param("ten", {"8_A": "7_B", "6_A": "9_A"}, id="ten, but not 6_A"),
        pytest.param("ten", {"8_A": "7_B", "7_C": "9_A"}, id="ten, but not 7_C"),
        pytest.param("ten", {"7_A": "7_B", "7_C": "9_A"}, id="ten, but 7_A"),
    ],
)
def test_other_triangulations_of_the_cube(
    verdicts: Verdicts, completeness: list[Completeness], theorem: str, taken: dict[str, str]
) -> None:
    spoiled = verdicts
    for name, other in taken.items():
        spoiled = taken_for(spoiled, name, other)
    still = shown(spoiled, completeness)
    assert theorem not in still
    assert "patterns" in still


def test_the_cube_has_no_triangulation_with_more_than_six_tetrahedra(
    verdicts: Verdicts, completeness: list[Completeness]
) -> None:
    """One with eight, in a class as large as that of the one with six which it stands for."""
    spoiled = taken_for(taken_for(verdicts, "8_A", "6_A"), "6_A", "9_A")
    spoiled = with_more(spoiled, {"8_A": 1})
    assert len(spoiled["8_A"].instances) == len(verdicts["6_A"].instances)
    assert "cube" not in shown(spoiled, completeness)


# What a run says of all this.


def test_a_run_in_which_all_is_shown(shipped: Path, outcome: Outcome) -> None:
    names = [*CERTIFICATES, *COMPLETENESS]
    names += [v.certificate.answers[q].proof for v, q in refuted(outcome)]  # type: ignore[union-attr]
    files = {name: sha256((shipped / name).read_bytes()).hexdigest() for name in names}
    assert (outcome.ok, outcome.faults, outcome.open) == (True, [], [])
    assert outcome.files == files
    assert outcome.evidence_digest == digest(files)
    assert outcome.about == {
        "python": platform.python_version(),
        "sympy": sympy.__version__,
        "kernel_sha256": kernel_digest(),
        "evidence_sha256": digest(files),
    }


def refuted(outcome: Outcome) -> list[tuple[Verdict, str]]:
    return [(v, q) for v in outcome.verdicts for q, a in v.answers.items() if a == "no"]


def test_a_run_in_which_not_all_is_shown(outcome: Outcome) -> None:
    first, *theorems = outcome.theorems
    one, *verdicts = outcome.verdicts
    none = replace(outcome, theorems=(replace(first, ok=False), *theorems))
    assert (none.ok, none.faults) == (False, [])
    spoiled = replace(outcome, verdicts=(Verdict(one.pattern, fault="spoiled"), *verdicts))
    assert (spoiled.ok, spoiled.faults) == (False, ["spoiled"])
    answers = one.answers | {"convex": "open", "valid": "open"}
    undecided = replace(outcome, verdicts=(replace(one, answers=answers), *verdicts))
    assert undecided.open == [("5_A", "convex"), ("5_A", "valid")]


def test_completeness_is_not_asked_unless_all_tetrahedra_were_accepted(root: Path) -> None:
    outcome = check_all(root)
    assert sum(verdict.fault is None for verdict in outcome.verdicts) == 2
    assert outcome.completeness == ()


# What they state, counted again from the files and from scratch.


@dataclass(frozen=True)
class Shipped:
    """What the certificates say, and nothing that the kernel makes of it."""

    records: dict[str, Any]

    def answering(self, question: str, answer: str) -> list[str]:
        return [n for n, r in self.records.items() if r[question]["answer"] == answer]

    def tetrahedra(self, name: str) -> Tetrahedra:
        return tuple(map(tuple, self.records[name]["tetrahedra"]))

    def row(self, names: list[str]) -> list[int]:
        """Return how many of the patterns have 5, 6, ..., 15 tetrahedra."""
        sizes = Counter(len(self.tetrahedra(name)) for name in names)
        return [sizes[size] for size in range(5, 16)]

    @cached_property
    def classes(self) -> dict[str, int]:
        """Return the number of instances of each pattern."""
        return {
            name: len({relabel(s, self.tetrahedra(name)) for s in cube_symmetries()})
            for name in self.records
        }

    def filling(self, slivers: bool) -> list[str]:
        """Return the patterns that fill the cube without or with core diagonals."""
        return [
            name
            for name in self.records
            if (solid := solids(self.tetrahedra(name))) and fill_the_cube(solid)
            if (len(solid) < len(self.tetrahedra(name))) == slivers
            if slivers or all(meet_in_common_face(CUBE, s, t) for s, t in combinations(solid, 2))
        ]


@pytest.fixture(scope="module")
def said(shipped: Path) -> Shipped:
    paths = {name: shipped / "certificates" / f"{name}.json" for name in PATTERN_NAMES}
    return Shipped({name: json.loads(path.read_bytes()) for name, path in paths.items()})


SIXTHS = {q: abs(volume(*(CUBE[v - 1] for v in q))) for q in QUADRUPLES}
"""Volumes in the unit cube, in sixths."""


def solids(tetrahedra: Tetrahedra) -> Tetrahedra:
    return tuple(t for t in tetrahedra if SIXTHS[t])


SIDE = 10**9
DICE = Random(12)
SAMPLES = [tuple(DICE.randrange(SIDE) for _ in range(3)) for _ in range(300)]
INSIDE = {
    q: sum(
        1 << n
        for n, point in enumerate(SAMPLES)
        if strictly_inside(point, [tuple(SIDE * x for x in CUBE[v - 1]) for v in q])
    )
    for q in QUADRUPLES
}
"""Quadruple -> which of the sample points in the cube are inside, as a set of bits.

None of them is by chance in a plane through vertices: some tetrahedra would be missing below.
"""


def fill_the_cube(solid: Tetrahedra) -> bool:
    """Have they the volume of the cube, and do no two share a sample point?"""
    return sum(SIXTHS[t] for t in solid) == 6 and not any(
        INSIDE[s] & INSIDE[t] for s, t in combinations(solid, 2)
    )


def boundary_classes() -> list[int]:
    """Return the sizes of the classes of triangulated boundaries."""
    facets = [[v for v in VERTICES if CUBE[v - 1][axis] == k] for axis in range(3) for k in (0, 1)]
    diagonals = [[e for e in combinations(facet, 2) if squared_length(e) == 2] for facet in facets]
    boundaries = {frozenset(choice) for choice in product(*diagonals)}
    orbits = {frozenset(relabel(s, boundary) for s in cube_symmetries()) for boundary in boundaries}
    assert len(boundaries) == sum(map(len, orbits))
    return sorted(map(len, orbits))


def squared_length(edge: tuple[int, ...]) -> int:
    v, w = edge
    return dot(*[minus(CUBE[v - 1], CUBE[w - 1])] * 2)


EDGES_OF_TYPE = {
    "corner": (1, 1, 1, 2, 2, 2),
    "staircase": (1, 1, 1, 2, 2, 3),
    "slanted": (1, 1, 2, 2, 2, 3),
    "core": (2, 2, 2, 2, 2, 2),
    "core diagonal": (1, 1, 2, 2, 3, 3),
    "boundary": (1, 1, 1, 1, 2, 2),
}
"""The squared lengths of the edges of four vertices of the cube, in increasing order."""


def edges_of(quadruple: tuple[int, ...]) -> tuple[int, ...]:
    return tuple(sorted(map(squared_length, combinations(quadruple, 2))))


def test_types_are_those_of_congruent_tetrahedra() -> None:
    for quadruple, kind in TETRAHEDRON_TYPES.items():
        assert edges_of(quadruple) == EDGES_OF_TYPE[kind]
        assert (SIXTHS[quadruple] == 0) == (kind in ("core diagonal", "boundary"))
    assert TETRAHEDRON_TYPES.keys() == set(QUADRUPLES)


def type_counts() -> list[int]:
    counts = Counter(map(edges_of, QUADRUPLES))
    return [counts[edges] for edges in EDGES_OF_TYPE.values()]


COUNTED: dict[str, Callable[[Shipped], list[object]]] = {
    "boundaries": lambda _: [64, 7, *boundary_classes()],
    "tetrahedra": lambda _: [*type_counts()],
    "patterns": lambda said: [len(said.records), len(cube_symmetries())],
    "sizes": lambda said: [len(said.records), *said.row([*said.records]), 5, 6, 15],
    "letters": lambda said: [
        len(said.records),
        *(sum(r["boundary"] == letter for r in said.records.values()) for letter in "abcdefg"),
    ],
    "names": lambda said: [n for n, r in said.records.items() if r["boundary"] != LETTERS[n]],
    "instances": lambda said: [
        len(said.records),
        *sorted(set(said.classes.values())),
        sum(said.classes.values()),
    ],
    "cube": lambda said: [
        sum(said.classes[name] for name in said.filling(slivers=False)),
        len(said.filling(slivers=False)),
        *sorted(said.classes[name] for name in said.filling(slivers=False)),
        *sorted({len(said.tetrahedra(name)) for name in said.filling(slivers=False)}),
    ],
    "finite-precision-cube": lambda said: [
        len(said.records),
        *said.filling(slivers=True),
        *{len(said.tetrahedra(name)) for name in said.filling(slivers=True)},
    ],
    "ten": lambda said: [
        len(said.records),
        7,
        *(
            name
            for name in said.records
            if len(said.tetrahedra(name)) <= 7
            and name not in (*said.filling(slivers=False), *said.filling(slivers=True))
        ),
    ],
    "realizable": lambda said: [
        len(said.answering("realizable", "yes")),
        len(said.records),
        *said.answering("realizable", "no"),
    ],
    "realizable-sizes": lambda said: [
        len(said.answering("realizable", "yes")),
        *said.row(said.answering("realizable", "yes")),
        *(5, 6, 15),
    ],
    "convex": lambda said: [
        len(said.answering("convex", "yes")),
        len(said.records),
        len(set(said.answering("convex", "no")) & set(said.answering("realizable", "yes"))),
    ],
    "valid": lambda said: [len(said.answering("valid", "yes")), len(said.records)],
    "not-valid": lambda said: [
        len(invalid := set(said.answering("valid", "no"))),
        len(invalid & set(said.answering("realizable", "no"))),
        len(
            invalid & set(said.answering("realizable", "yes")) & set(said.answering("convex", "no"))
        ),
        len(invalid & set(said.answering("convex", "yes"))),
    ],
    "valid-sizes": lambda said: [
        *extreme(said, said.answering("valid", "no"), min),
        *extreme(said, said.answering("valid", "yes"), max),
    ],
}
"""Id -> the numbers and names that the statement has, in this order."""


def extreme(said: Shipped, names: list[str], choose: Callable[[Iterator[int]], int]) -> list[str]:
    """Return the names with the fewest or the most tetrahedra."""
    best = choose(len(said.tetrahedra(name)) for name in names)
    return [name for name in names if len(said.tetrahedra(name)) == best]


@every_theorem
def test_statement_is_what_is_counted(proved: dict[str, Theorem], said: Shipped, name: str) -> None:
    words = re.findall(r"\d+_[A-Z]+|\d+", proved[name].statement)
    stated = [word if "_" in word else int(word) for word in words]
    if name == "boundaries":
        assert stated[:2] == COUNTED[name](said)[:2]
        stated[2:] = sorted(stated[2:])
    assert stated == COUNTED[name](said)


def fillings() -> Iterator[Tetrahedra]:
    """Yield the sets of tetrahedra in which every sample point is exactly once."""
    everywhere = (1 << len(SAMPLES)) - 1

    def extend(chosen: Tetrahedra, covered: int) -> Iterator[Tetrahedra]:
        if covered == everywhere:
            yield tuple(sorted(chosen))
            return
        first = ~covered & (covered + 1)
        for quadruple, inside in INSIDE.items():
            if inside & first and not inside & covered:
                yield from extend((*chosen, quadruple), covered | inside)

    return extend((), 0)


def fit_face_to_face(tetrahedra: Tetrahedra) -> bool:
    """Is every triangle in two tetrahedra, or in one and on a facet?"""
    count = Counter(face for t in tetrahedra for face in combinations(t, 3))
    return all(
        times == 2 - any(len({CUBE[v - 1][axis] for v in face}) == 1 for axis in range(3))
        for face, times in count.items()
    )


def test_the_cube_is_filled_by_its_74_triangulations(verdicts: Verdicts) -> None:
    """All sets that fill the cube, by sample points, and those of them that fit face to face."""
    found = set(fillings())
    assert all(fill_the_cube(tetrahedra) for tetrahedra in found)
    triangulations = {tetrahedra for tetrahedra in found if fit_face_to_face(tetrahedra)}
    assert len(triangulations) == 74 < len(found)
    assert triangulations == {
        instance
        for verdict in verdicts.values()
        if triangulates_cube(orientation(min(verdict.instances)))
        for instance in verdict.instances
    }
