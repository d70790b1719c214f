"""Forgeries are what they are said to be, the kernel refuses them, and a blind one is caught."""

import json
from collections.abc import Callable
from dataclasses import asdict
from hashlib import sha256
from pathlib import Path
from random import Random
from typing import Any

import pytest

from certify.kernel import check, refutation
from certify.kernel.certificate import QUESTIONS
from certify.kernel.check import check_pattern
from certify.kernel.evidence import Evidence, completeness_file, kernel_digest
from certify.kernel.orientations import has_sign
from certify.kernel.theorems import Outcome
from certify.opinions.attack import campaign
from certify.opinions.attack.campaign import Finding, attack, write_out
from certify.opinions.attack.corpus import Corpus, ForgedList, Forgery, read_corpus
from certify.opinions.attack.judge import Judge
from certify.opinions.attack.kinds import KINDS, SCHEDULE, forge
from certify.opinions.rup import proof_fault
from tests.commands import run, run_json

SEEDS = range(6)


@pytest.fixture(scope="module")
def corpus(shipped: Path, outcome: Outcome) -> Corpus:
    return read_corpus(outcome, Evidence(shipped))


@pytest.fixture(scope="module")
def judge(corpus: Corpus) -> Judge:
    return Judge(corpus)


@pytest.fixture(autouse=True, scope="module")
def start_once(judge: Judge) -> Any:
    """Let every attack begin with what was accepted once."""

    def started(_: Path) -> Judge:
        return judge

    started.cache_clear = lambda: None  # type: ignore[attr-defined]
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(campaign, "_judge", started)
        yield


def shipped_as(corpus: Corpus, forgery: Forgery | ForgedList) -> tuple[object, ...]:
    """Return what ships in the place of a forgery: certificate or list, and proofs."""
    if isinstance(forgery, ForgedList):
        proof = corpus.proofs[completeness_file(forgery.letter)]
        return corpus.known[forgery.letter], proof.encode()
    record = json.loads(corpus.certificates[forgery.pattern])
    proofs = [record[q]["proof"] for q in QUESTIONS if "proof" in record[q]]
    return record, {path: corpus.proofs[path].encode() for path in proofs}


@pytest.mark.parametrize("kind", KINDS)
def test_forgeries_differ_from_what_ships(kind: str, corpus: Corpus) -> None:
    """And depend on the seed alone."""
    changed = 0
    for seed in SEEDS:
        forgery = KINDS[kind](Random(seed), corpus)
        assert forgery == KINDS[kind](Random(seed), corpus)
        if isinstance(forgery, ForgedList):
            changed += (forgery.known, forgery.proof) != shipped_as(corpus, forgery)
        else:
            changed += is_changed(corpus, forgery)
    assert changed


def is_changed(corpus: Corpus, forgery: Forgery) -> bool:
    """Is there more to a forgery than answers that were left open?"""
    shipped, proofs = shipped_as(corpus, forgery)
    assert isinstance(shipped, dict)
    assert isinstance(proofs, dict)
    try:
        record = json.loads(forgery.certificate)
        left_open = {q for q in QUESTIONS if record[q] == {"answer": "open"}}
    except (ValueError, KeyError, TypeError):
        return True
    expected = json.dumps(shipped | {q: record[q] for q in left_open}).encode()
    same_proofs = all(proofs.get(path) == content for path, content in forgery.proofs.items())
    return forgery.certificate != expected or not same_proofs


@pytest.mark.parametrize("kind", [kind for kind in KINDS if kind.startswith("refutation: ")])
def test_hash_is_that_of_the_forged_proof(kind: str, corpus: Corpus) -> None:
    for seed in SEEDS:
        forgery = KINDS[kind](Random(seed), corpus)
        assert isinstance(forgery, Forgery)
        record = json.loads(forgery.certificate)
        (answer,) = (record[q] for q in QUESTIONS if record[q]["answer"] == "no")
        assert sha256(forgery.proofs[answer["proof"]]).hexdigest() == answer["sha256"]


def changed_lines(corpus: Corpus, kind: str, seed: int) -> tuple[list[str], list[str]]:
    """Return the lines of a shipped proof that a forgery lacks, and those that it has instead."""
    forgery = KINDS[kind](Random(seed), corpus)
    if isinstance(forgery, ForgedList):
        path, content = completeness_file(forgery.letter), forgery.proof
    else:
        ((path, content),) = forgery.proofs.items()
    before, after = corpus.proofs[path].splitlines(), content.decode().splitlines()
    return [x for x in before if x not in after], [x for x in after if x not in before]


@pytest.mark.parametrize("proof", ["refutation", "completeness"])
@pytest.mark.parametrize(
    ("change", "gone", "new"),
    [
        ("step dropped", 1, 0),
        ("last step cut", 1, 0),
        ("step doubled", 0, 0),
        ("needed clause deleted", 0, 1),
        ("hint dropped", 1, 1),
        ("hint negative", 1, 1),
    ],
)
def test_one_line_changes(proof: str, change: str, gone: int, new: int, corpus: Corpus) -> None:
    for seed in SEEDS:
        lacking, instead = changed_lines(corpus, f"{proof}: {change}", seed)
        assert (len(lacking), len(instead)) == (gone, new)
        assert ("d" in " ".join(instead)) == (change == "needed clause deleted")


@pytest.mark.parametrize(("change", "by"), [("weakened", 1), ("strengthened", -1), ("negated", 0)])
def test_lemmas_change(change: str, by: int, corpus: Corpus) -> None:
    word = "literal" if change == "negated" else "lemma"
    for seed in SEEDS:
        (before,), (after,) = changed_lines(corpus, f"completeness: {word} {change}", seed)
        lengths = [len(line.split(" 0 ")[0].split()) for line in (before, after)]
        assert lengths[1] - lengths[0] == by


def test_flips_lead_to_other_triangulations(corpus: Corpus, judge: Judge) -> None:
    """Some are accepted, and the kernel and the judge agree that they are triangulations."""
    outcomes = []
    for seed in range(60):
        forgery = KINDS["tetrahedra: flipped"](Random(seed), corpus)
        assert isinstance(forgery, Forgery)
        outcomes.append(judge.outcome(forgery)[0])
    assert set(outcomes) == {"refused", "true"}


@pytest.mark.parametrize(
    "kind",
    [
        "points: coincident",
        "points: mirrored",
        "tetrahedra: dropped",
        "tetrahedra: doubled",
        "answer: no made yes",
        "answer: yes made no",
        "refutation: step doubled",
        "refutation: last step cut",
        "refutation: needed clause deleted",
        "refutation: hint negative",
        "polynomial: inequality dropped",
        "completeness: last step cut",
        "completeness: instance removed",
        "completeness: of another boundary",
        "structure: key dropped",
        "structure: key doubled",
    ],
)
def test_kinds_that_are_always_refused(kind: str, corpus: Corpus, judge: Judge) -> None:
    outcomes = {judge.outcome(KINDS[kind](Random(seed), corpus)) for seed in range(12)}
    assert outcomes == {("refused", "")}


def test_the_seed_and_the_number_say_which(corpus: Corpus) -> None:
    assert forge(corpus, 1, 7) == forge(corpus, 1, 7)
    assert forge(corpus, 1, 0) != forge(corpus, 2, 0)
    assert set(SCHEDULE) == KINDS.keys()
    assert [forge(corpus, 5, n)[0] for n in range(10)] == list(SCHEDULE[:10])


def test_no_false_acceptance(shipped: Path) -> None:
    told: list[tuple[str, int, int]] = []
    found = attack(shipped, 1, 1500, report=lambda *what: told.append(what))
    assert found.findings == ()
    assert found.tried == 1500
    assert all(counts.total() >= 5 for counts in found.counts.values())
    assert found.total["refused"] > 1000
    assert found.total["true"] > 100
    assert told[-1] == ("forging", 1500, 1500)


@pytest.mark.slow
def test_no_false_acceptance_among_many(shipped: Path) -> None:
    found = attack(shipped, 2, 10_000)
    assert found.findings == ()
    assert found.total["refused"] > 7000


def test_outcome_does_not_depend_on_processes(shipped: Path) -> None:
    one, two = (attack(shipped, 4, 250, jobs) for jobs in (1, 2))
    assert asdict(one) == asdict(two)


def accept(*_: object) -> None:
    """Check nothing."""


def accept_hash(evidence: Evidence, name: str, digest: str | None = None) -> str:
    return evidence._read(name, 1 << 24).decode("ascii")


BLIND: dict[str, tuple[Any, str, Callable[..., Any], str, int]] = {
    "realization": (check, "require_realization", accept, "points: coincident", 12),
    "convexity": (check, "require_convex_position", accept, "points: of another question", 60),
    "jacobian": (check, "require_positive_jacobian", accept, "points: of another question", 60),
    "lemmas": (refutation, "_require_implied", accept, "refutation: ended early", 6),
    "completeness": (refutation, "_require_implied", accept, "completeness: instance removed", 6),
    "replay": (check, "replay", accept, "answer: yes made no", 1),
    "hash": (Evidence, "proof", accept_hash, "proof: hash changed", 6),
}
"""What the kernel does not check any more -> a kind of forgery that gets through, and in how many
of them one does."""


@pytest.mark.parametrize("name", BLIND)
def test_a_blind_kernel_is_caught(
    name: str, corpus: Corpus, judge: Judge, monkeypatch: pytest.MonkeyPatch
) -> None:
    place, function, substitute, kind, many = BLIND[name]
    forgeries = [KINDS[kind](Random(seed), corpus) for seed in range(many)]
    assert "false" not in {judge.outcome(forgery)[0] for forgery in forgeries}
    monkeypatch.setattr(place, function, substitute)
    outcomes = [judge.outcome(forgery) for forgery in forgeries]
    assert any(outcome == "false" and reason for outcome, reason in outcomes)


def test_a_kernel_that_knows_no_final_polynomial_is_caught(
    corpus: Corpus, judge: Judge, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Each polynomial is taken at its word, as if the inequalities were not looked at."""
    monkeypatch.setattr(check, "excluded_signs", clause_of)
    kind = KINDS["polynomial: inequality dropped"]
    outcomes = [judge.outcome(kind(Random(seed), corpus))[0] for seed in range(4)]
    assert outcomes == ["false"] * 4


def clause_of(polynomial: refutation.FinalPolynomial) -> tuple[int, ...]:
    literals = []
    for quadruple, sign in polynomial.signs.items():
        if sign:
            literals.append(-has_sign(quadruple, sign))
        else:
            literals += [has_sign(quadruple, s) for s in (1, -1)]
    return tuple(literals)


@pytest.mark.parametrize(
    ("proof", "fault"),
    [
        ("5 1 0 1 2 0\n6 0 5 3 4 0", None),
        ("5 1 0 2 1 0\n5 d 1 2 0\n6 0 4 3 5 0\n", None),
        ("5 1 0 1 2 0", "the proof does not reach the empty clause"),
        ("5 3 0 3 0\n6 0 5 3 4 0", "lemma 5 does not follow by unit propagation"),
        ("6 0 1 2 0", "lemma 6 does not follow by unit propagation"),
    ],
)
def test_proof_fault(proof: str, fault: str | None) -> None:
    formula = [(1, 2), (1, -2), (-1, 3), (-1, -3)]
    again = list(map(frozenset, formula))
    assert proof_fault(formula, again, proof) == fault
    if fault is None:
        assert proof_fault(formula, again[1:], proof) == "clause 1 does not belong to the formula"


def test_unit_propagation_with_long_clauses() -> None:
    formula = [(1, 2, 3), (-1,), (-2, 4, 4), (-3, 4), (-4, 5, 1), (-5, -4), (6, -6)]
    again = list(map(frozenset, formula))
    assert proof_fault(formula, again, "8 0 1 2 3 4 5 6 7 0") is not None
    assert proof_fault(formula, again, "8 4 0 1 2 3 4 0\n9 0 8 5 6 2 7 0") is None


def test_command(shipped: Path) -> None:
    code, out, err = run(shipped, "attack", "--seed", "1", "--count", "90")
    assert (code, err) == (0, "")
    assert out.endswith("\nfalse acceptances: 0\n")
    assert all(kind.split(": ")[0] in out for kind in KINDS)
    code, record = run_json(shipped, "attack", "--seed", "1", "--count", "90")
    figures = record["figures"]
    assert (code, figures["forgeries"], figures["false acceptances"]) == (0, 90, 0)
    assert record["kernel_sha256"] == kernel_digest()
    assert record["kinds"].keys() == KINDS.keys()
    assert sum(counts["tried"] for counts in record["kinds"].values()) == 90


def test_command_reports_false_acceptances(
    shipped: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(check, "require_realization", accept)
    to = tmp_path / "found"
    arguments = ("attack", "--seed", "1", "--count", "20", "--to", str(to))
    code, out, _ = run(shipped, *arguments)
    lines = out.splitlines()
    assert code == 1
    assert not any(line == "false acceptances: 0" for line in lines)
    written = [Path(line.rpartition(": ")[2]) for line in lines if line.startswith("false: ")]
    assert written
    for place in written:
        note = json.loads((place / "forgery.json").read_text())
        assert note["kind"] in KINDS
        assert check_pattern(place, note["pattern"]).fault is None
        monkeypatch.undo()
        assert check_pattern(place, note["pattern"]).fault is not None
        monkeypatch.setattr(check, "require_realization", accept)
    assert run_json(shipped, *arguments)[1]["written"] == list(map(str, written))


def test_false_lists_are_written_out(corpus: Corpus, tmp_path: Path) -> None:
    forgery = KINDS["completeness: instance removed"](Random(1), corpus)
    assert isinstance(forgery, ForgedList)
    place = write_out(tmp_path, Finding(3, "some", "false", "why", forgery))
    note = json.loads((place / "forgery.json").read_text())
    assert len(note["listed"]) == len(corpus.known[forgery.letter]) - 1
    assert (place / completeness_file(forgery.letter)).read_bytes() == forgery.proof


@pytest.mark.parametrize("argument", ["0", "-3", "many"])
def test_command_needs_a_count(shipped: Path, argument: str) -> None:
    code, out, err = run(shipped, "attack", "--count", argument)
    assert (code, out) == (2, "")
    assert len(err.splitlines()) == 1
