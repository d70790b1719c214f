"""All opinions at once: they agree on what is true, and differ on what only looks accepted."""

import os
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import pytest

from certify.kernel.certificate import Certificate, Yes
from certify.kernel.check import Verdict
from certify.kernel.theorems import Outcome
from certify.opinions import formal
from certify.opinions.outside import PROGRAMS
from certify.opinions.second import Opinion, second_opinions
from tests.commands import CHECKOUT, needs_scripts, run, stand_in

SOME = ["5_A", "7_A", "15_A", "15_K"]


def asked(verdicts: list[Verdict]) -> dict[str, Opinion]:
    outcome = Outcome(tuple(verdicts), (), ())
    found = second_opinions(CHECKOUT, outcome, 1, lambda *_: None)
    return {opinion.name: opinion for opinion in found}


@pytest.fixture
def some(verdicts: dict[str, Verdict]) -> list[Verdict]:
    return [verdicts[name] for name in SOME]


def certificate_of(verdict: Verdict) -> Certificate:
    assert verdict.certificate is not None
    return verdict.certificate


def test_they_agree(some: list[Verdict]) -> None:
    opinions = asked(some)
    assert not [fault for opinion in opinions.values() for fault in opinion.faults]
    counts = {name: opinion.asked for name, opinion in opinions.items()}
    assert counts["balls"] == 4
    assert counts["realizations"] == 8  # three times for 5_A and 7_A, twice for 15_K
    assert (counts["convex position"], counts["Jacobians"]) == (3, 2)
    assert counts["formulas"] == 4  # three for 15_A, one for 15_K
    assert counts["drup"] == (0 if opinions["drup"].absent else 4)


def test_nothing_accepted_is_nothing_asked() -> None:
    assert {opinion.asked for opinion in asked([Verdict("5_A", fault="spoiled")]).values()} == {0}


def mirrored(certificate: Certificate) -> Certificate:
    answers = dict(certificate.answers)
    for question, answer in answers.items():
        assert isinstance(answer, Yes)
        answers[question] = Yes(tuple((-x, y, z) for x, y, z in answer.points))
    return replace(certificate, answers=answers)


def flat(certificate: Certificate) -> Certificate:
    """Vertex 7 comes so near that the hexahedron is neither convex nor valid."""
    answers = dict(certificate.answers)
    answer = answers["valid"]
    assert isinstance(answer, Yes)
    points = tuple(
        tuple(x / 4 for x in point) if vertex == 7 else point
        for vertex, point in enumerate(answer.points, start=1)
    )
    return replace(certificate, answers=answers | dict.fromkeys(answers, Yes(points)))


def no_ball(certificate: Certificate) -> Certificate:
    return replace(certificate, tetrahedra=certificate.tetrahedra[:-1])


@pytest.mark.parametrize(
    ("forge", "differing"),
    [
        (mirrored, {"realizations": 3, "Jacobians": 1}),
        (flat, {"realizations": 3, "convex position": 1, "Jacobians": 1}),
        (no_ball, {"balls": 1}),
    ],
)
def test_they_differ_on_forged_verdicts(
    some: list[Verdict], forge: Callable[[Certificate], Certificate], differing: dict[str, int]
) -> None:
    forged = replace(some[0], certificate=forge(certificate_of(some[0])))
    found = {name: len(o.faults) for name, o in asked([forged]).items() if o.faults}
    assert found == differing


@needs_scripts
@pytest.mark.parametrize("spoiled", [False, True])
def test_programs_on_the_path_are_asked(
    some: list[Verdict], tmp_path: Path, monkeypatch: pytest.MonkeyPatch, spoiled: bool
) -> None:
    for name, program in PROGRAMS.items():
        stand_in(tmp_path / name, f"echo '{program.accepts}'; exit {program.code + spoiled}")
    monkeypatch.setenv("PATH", str(tmp_path), prepend=os.pathsep)
    opinions = asked([verdict for verdict in some if verdict.pattern == "15_K"])
    for name, program in PROGRAMS.items():
        assert (opinions[name].asked, opinions[name].absent) == (1, None)
        said = f"15_K valid: did not answer: exit code {program.code + 1}, {program.accepts}"
        assert opinions[name].faults == ([said] if spoiled else [])


@pytest.mark.slow
def test_command(monkeypatch: pytest.MonkeyPatch) -> None:
    """Without Coq, which tests/test_formal.py asks."""
    monkeypatch.setattr(formal, "PROGRAMS", ("no-such-program",))
    code, out, _ = run(CHECKOUT, "check-all", "--second-opinion", "--jobs", "2")
    assert code == 0
    assert "agrees: balls: 174 of 174, " in out
    assert "agrees: completeness: 7 of 7, " in out
    assert "did not run: Coq: no-such-program is not on the PATH" in out
    assert "differs" not in out
