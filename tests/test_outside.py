"""Other people's checkers: they accept every exported proof, and what they say is not misread.

The programs themselves are asked where they are on the PATH; otherwise these tests are skipped.
The outputs further down are theirs too, word for word, without the lines that only count.
"""

import os
import re
import shutil
from collections.abc import Iterator
from importlib.util import find_spec
from pathlib import Path

import pytest

from certify import export
from certify.dimacs import read_dimacs, write_dimacs
from certify.kernel.certificate import Certificate, No
from certify.kernel.hexahedron import BOUNDARY_TYPES
from certify.kernel.refutation import NotRefuted, replay
from certify.kernel.theorems import Outcome
from certify.opinions import outside
from certify.opinions.outside import PROGRAMS, fault, judged, with_a_goal
from tests.commands import needs_scripts, stand_in

Files = dict[str, str]
"""A formula and its proofs, by suffix."""


def read(paths: list[Path]) -> Files:
    return {path.suffix[1:]: path.read_text(encoding="ascii") for path in paths}


def exported(
    root: Path, outcome: Outcome, certificates: dict[str, Certificate], to: Path, core: bool
) -> Iterator[tuple[str, Files]]:
    """Yield the name and the files of every refutation."""
    for pattern, certificate in certificates.items():
        for question, answer in certificate.answers.items():
            if isinstance(answer, No):
                paths = export.export_answer(root, certificate, question, to, core)
                yield f"{pattern} {question}", read(paths)
    for letter in BOUNDARY_TYPES:
        paths = export.export_completeness(root, outcome, letter, to, core)
        yield f"complete {letter}", read(paths)


@pytest.fixture(scope="module")
def cores(
    shipped: Path,
    outcome: Outcome,
    certificates: dict[str, Certificate],
    tmp_path_factory: pytest.TempPathFactory,
) -> dict[str, Files]:
    folder = tmp_path_factory.mktemp("cores")
    return dict(exported(shipped, outcome, certificates, folder, core=True))


@pytest.fixture(params=PROGRAMS)
def name(request: pytest.FixtureRequest) -> str:
    """Return the name of a program that is there."""
    found: str = request.param
    if shutil.which(found) is None:
        pytest.skip(f"{found} is not on the PATH")
    return found


def asked(name: str, files: Files) -> str | None:
    return fault(name, files["cnf"], files[PROGRAMS[name].form])


# The programs themselves.


def test_it_accepts_every_core(name: str, cores: dict[str, Files]) -> None:
    assert {subject: asked(name, files) for subject, files in cores.items()} == dict.fromkeys(cores)


@pytest.mark.slow
def test_it_accepts_every_whole_formula(
    name: str,
    shipped: Path,
    outcome: Outcome,
    certificates: dict[str, Certificate],
    tmp_path: Path,
) -> None:
    for subject, files in exported(shipped, outcome, certificates, tmp_path, core=False):
        assert asked(name, files) is None, subject


def spoiled(files: Files, other: Files) -> dict[str, Files]:
    """Return a formula with proofs that do not refute it, and a weaker formula, by what is wrong.

    What is wrong with the hints alone is in LRAT alone, and so is the lack of the last step: the
    clauses before it refute the formula by unit propagation.
    """
    *clauses, _ = read_dimacs(files["cnf"])
    lrat, drat = (files[form].splitlines() for form in ("lrat", "drat"))
    k = len(lrat) // 2
    number, zero, first, *hints, last, end = lrat[-1].split()
    redirected = "1" if first != "1" else "2"
    empty = {
        "a hint redirected": [number, zero, redirected, *hints, last, end],
        "the last hint left out": [number, zero, first, *hints, end],
        "no hints": [number, zero, end],
    }
    proofs = {
        "a step left out": ([*lrat[:k], *lrat[k + 1 :]], [*drat[:k], *drat[k + 1 :]]),
        "the empty clause alone": ([f"{number} 0 0"], ["0"]),
        "no step": ([], []),
        "the proof of another": (other["lrat"].splitlines(), other["drat"].splitlines()),
        "without the last step": (lrat[:-1], None),
        **{how: ([*lrat[:-1], " ".join(step)], None) for how, step in empty.items()},
    }
    found = {"a clause less": files | {"cnf": write_dimacs(clauses)}}
    for how, (steps, lemmas) in proofs.items():
        found[how] = {"cnf": files["cnf"], "lrat": "".join(f"{step}\n" for step in steps)}
        if lemmas is not None:
            found[how]["drat"] = "".join(f"{lemma}\n" for lemma in lemmas)
    return found


SPOILED = {"15_A realizable": "15_B realizable", "15_G convex": "15_F convex"}


@pytest.mark.parametrize("subject", SPOILED)
def test_it_accepts_nothing_spoiled(name: str, cores: dict[str, Files], subject: str) -> None:
    wrong = spoiled(cores[subject], cores[SPOILED[subject]])
    said = {how: asked(name, files) for how, files in wrong.items() if PROGRAMS[name].form in files}
    assert [how for how, message in said.items() if message is None] == []


@pytest.mark.parametrize("subject", SPOILED)
def test_the_kernel_accepts_nothing_spoiled(cores: dict[str, Files], subject: str) -> None:
    for files in spoiled(cores[subject], cores[SPOILED[subject]]).values():
        with pytest.raises(NotRefuted):
            replay(read_dimacs(files["cnf"]), files["lrat"])


@pytest.mark.parametrize("announced", ["6 6", "6 9", "6 1", "1 6", "x y"])
def test_it_refutes_no_satisfiable_formula(
    name: str, announced: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Whatever the header. Without one, lrat-check goes on reading for ever."""
    monkeypatch.setattr(outside, "SECONDS", 2)
    formula = f"p cnf {announced}\n1 2 3 0\n-1 0\n-2 0\n1 2 4 0\n1 2 5 0\n1 2 6 0\n"
    proof = {"drat": "0\n", "lrat": "7 0 2 3 1 0\n"}[PROGRAMS[name].form]
    assert fault(name, formula, proof) is not None


# The files are such that all of them can read them.


@pytest.mark.skipif(find_spec("drup") is None, reason="drup has no wheel for this platform")
@pytest.mark.parametrize(("proof", "expected"), [("15_A", "VALID"), ("15_B", "INVALID")])
def test_the_reader_of_drup_needs_plain_files(
    shipped: Path, certificates: dict[str, Certificate], tmp_path: Path, proof: str, expected: str
) -> None:
    import drup  # noqa: PLC0415 - it is optional

    for pattern in ("15_A", "15_B"):
        certificate = certificates[pattern]
        export.export_answer(shipped, certificate, "realizable", tmp_path, core=True, plain=True)
    formula, lemmas = "15_A.realizable.cnf", f"{proof}.realizable.drat"
    found = drup.check_proof_from_files(tmp_path / formula, tmp_path / lemmas)
    assert found.outcome.name == expected


@pytest.mark.parametrize("form", ["cnf", "lrat", "drat"])
def test_files_hold_nothing_that_a_program_misreads(cores: dict[str, Files], form: str) -> None:
    """The longest line that lrat-check can skip has 1023 characters.

    The header is to drat-trim the first word "cnf" that two numbers follow; and to it a proof is
    binary if certain characters are among its first twelve.
    """
    for files in cores.values():
        comments: list[str] = []
        proper: list[str] = []
        for line in files[form].splitlines():
            (comments if line.startswith("c ") else proper).append(line)
        assert all(len(comment) < 1023 and "cnf" not in comment.split() for comment in comments)
        assert all(re.fullmatch(r"(?:p cnf )?-?\d+(?: -?\d+)*", line) for line in proper)
        assert files[form].endswith("\n")


def test_a_goal_is_added() -> None:
    proof = "5 1 0 1 2 0\n6 0 5 3 4 0\n"
    assert (
        with_a_goal("c 6\np cnf 2 4\n", proof)
        == "5 1 0 1 2 0\n6 -7 0 0\n7 7 0 5 3 4 0\n8 0 6 7 0\n"
    )


# What they say.

SAYS_YES = {
    "drat-trim": "\rc 72 of 73 clauses in core                            \n\rs VERIFIED\n",
    "lrat-check": "c parsed a formula with 131 variables and 73 clauses\nc VERIFIED\n",
    "lrat-trim": "c parsed original proof with 3 added and 0 deleted clauses\ns VERIFIED\n",
    "cake_lpr": "s VERIFIED UNSAT\n",
}
"""The four before the core of 15_A realizable."""


@pytest.mark.parametrize("name", PROGRAMS)
def test_a_yes_is_understood(name: str) -> None:
    program = PROGRAMS[name]
    assert judged(program, program.code, SAYS_YES[name], "") is None


@pytest.mark.parametrize("name", PROGRAMS)
def test_a_yes_needs_exit_code_and_line(name: str) -> None:
    program, out = PROGRAMS[name], SAYS_YES[name]
    for code, text, err in [
        (1, out, ""),
        (0 if program.code else 20, out, ""),
        (-6, out, "realloc(): invalid next size\n"),
        (program.code, "", out),
        (program.code, f"{out}{out}", ""),
        (program.code, f"{out}s NOT VERIFIED\n", ""),
        (program.code, out.replace("VERIFIED", "VERIFIED?"), ""),
        (program.code, f"{out.rstrip()} not", ""),
        (program.code, "", ""),
    ]:
        assert judged(program, code, text, err) is not None


NOES = [
    (
        "drat-trim",
        1,
        "\rc RUP check failed\nc failed at proof line 2 (modulo deletion errors)\n"
        "\ns NOT VERIFIED\n\rc verification time: 0.083 seconds\n",
        "",
        "rejects the proof: s NOT VERIFIED",
    ),
    (
        "drat-trim",
        80,
        "\rc WARNING: early EOF of the input formula\n",
        "",
        "did not answer: exit code 80, c WARNING: early EOF of the input formula",
    ),
    (
        "drat-trim",
        0,
        "\rc illegal literal -3 due to max var 1\n",
        "",
        "did not answer: exit code 0, c illegal literal -3 due to max var 1",
    ),
    ("drat-trim", 0, "s TIMEOUT\n", "", "did not answer: exit code 0, s TIMEOUT"),
    (
        "drat-trim",
        255,
        '\rc error opening "core.drat".\n',
        "",
        'did not answer: exit code 255, c error opening "core.drat".',
    ),
    (
        "lrat-check",
        1,
        "c WARNING: Verification incomplete. Last line checked = 75\nc NOT VERIFIED\n",
        "",
        "rejects the proof: c NOT VERIFIED",
    ),
    (
        "lrat-check",
        -6,
        "",
        "realloc(): invalid next size\n",
        "did not answer: exit code -6, realloc(): invalid next size",
    ),
    ("lrat-check", -11, "", "", "did not answer: exit code -11, no output"),
    (
        "lrat-trim",
        0,
        "c no empty clause found and checked\nc total time of 0.00 seconds\n",
        "",
        "rejects the proof: c no empty clause found and checked",
    ),
    (
        "lrat-trim",
        1,
        "",
        "lrat-trim: antecedent '1' does not produce unit while checking clause '76'\n",
        "rejects the proof: "
        "lrat-trim: antecedent '1' does not produce unit while checking clause '76'",
    ),
    (
        "lrat-trim",
        1,
        "",
        "lrat-trim: propagating antecedents does not yield conflict while checking clause '76'\n",
        "rejects the proof: "
        "lrat-trim: propagating antecedents does not yield conflict while checking clause '76'",
    ),
    (
        "lrat-trim",
        1,
        "",
        "lrat-trim: parse error in 'core.lrat' in line 1: unexpected first byte '0x00'\n",
        "did not answer: exit code 1, "
        "lrat-trim: parse error in 'core.lrat' in line 1: unexpected first byte '0x00'",
    ),
    (
        "cake_lpr",
        0,
        "",
        "c empty clause not derived at end of proof\n",
        "rejects the proof: c empty clause not derived at end of proof",
    ),
    (
        "cake_lpr",
        0,
        "",
        "c Checking failed at line: 1. Reason: clause index unavailable: 75\n",
        "rejects the proof: c Checking failed at line: 1. Reason: clause index unavailable: 75",
    ),
    (
        "cake_lpr",
        0,
        "",
        "c DIMACS parse failed at line: 151. Reason: incorrect number of clauses\n",
        "did not answer: exit code 0, "
        "c DIMACS parse failed at line: 151. Reason: incorrect number of clauses",
    ),
    (
        "cake_lpr",
        1,
        "",
        "CakeML heap space exhausted.\n",
        "did not answer: exit code 1, CakeML heap space exhausted.",
    ),
]
"""Program, exit code, standard output, standard error: how we tell it."""


@pytest.mark.parametrize(("name", "code", "out", "err", "told"), NOES)
def test_a_no_is_told(name: str, code: int, out: str, err: str, told: str) -> None:
    assert judged(PROGRAMS[name], code, out, err) == told


def test_what_is_told_cannot_control_a_terminal() -> None:
    assert judged(PROGRAMS["cake_lpr"], 1, "", "\x1b[2J\n") == (
        "did not answer: exit code 1, \\x1b[2J"
    )


@needs_scripts
@pytest.mark.parametrize(
    ("commands", "told"),
    [
        ("echo 's VERIFIED UNSAT'", None),
        ("echo nothing", "did not answer: exit code 0, nothing"),
        ("exec sleep 600", "did not answer in 0.5 seconds"),
        ("kill -9 $$", "did not answer: exit code -9, no output"),
        ('test "$1 $2" = "core.cnf core.lrat" && grep p "$1"', "did not answer: exit code 0, p"),
    ],
)
def test_a_program_is_run(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, commands: str, told: str | None
) -> None:
    monkeypatch.setenv("PATH", str(tmp_path), prepend=os.pathsep)
    if "sleep" in commands:
        monkeypatch.setattr(outside, "SECONDS", 0.5)
    stand_in(tmp_path / "cake_lpr", commands)
    assert fault("cake_lpr", "p\n", "0\n") == told


def test_a_program_that_is_not_there_has_not_answered(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("PATH", "")
    message = fault("cake_lpr", "p\n", "0\n")
    assert message is not None
    assert message.startswith("did not answer: ")
