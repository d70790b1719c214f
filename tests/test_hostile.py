"""No file makes a command stumble: one line says what is wrong, and that costs next to nothing."""

from collections.abc import Callable
from pathlib import Path

import pytest

from certify.kernel.check import check_pattern
from tests.commands import assert_rejects
from tests.hostile import (
    CERTIFICATES,
    COMPLETE,
    FORMULAS,
    NO,
    PLACES,
    PROOFS,
    YES,
    Done,
    Hostile,
    Place,
    certificate_root,
    complete_root,
    fraction_root,
    proof_root,
    run_all,
    spoiled,
)

MEGABYTES = 200
"""The most memory for any of these files; Python with sympy takes a third of it."""

Answers = dict[str, dict[str, Done]]
"""What is hostile -> command -> how it ended."""


def asked(
    folder: Path, hostile: Hostile, arrange: Callable[[Path, Place], Path], pattern: str
) -> Answers:
    """Run all commands on all hostile files, each of which has a root to itself."""
    commands: dict[tuple[str, str], tuple[str, ...]] = {}
    for number, (name, (place, _)) in enumerate(hostile.items()):
        try:
            root = str(arrange(folder / str(number), place))
        except PermissionError:  # to make a device, one must be allowed to
            continue
        to = str(folder / "exported")
        commands |= {
            (name, "check"): ("certify", "check", pattern, "--root", root),
            (name, "show"): ("certify", "show", pattern, "--root", root),
            (name, "export"): ("certify", "export", pattern, "valid", "--to", to, "--root", root),
            (name, "check-all"): ("certify", "check-all", "--root", root),
            (name, "door"): ("certify.kernel", root),
        }
    answers: Answers = {}
    for (name, command), done in zip(commands, run_all(commands.values()), strict=True):
        answers.setdefault(name, {})[command] = done
    assert not (folder / "exported").exists()
    return answers


@pytest.fixture(scope="module")
def certificates(tmp_path_factory: pytest.TempPathFactory) -> Answers:
    folder = tmp_path_factory.mktemp("hostile")
    return asked(folder, CERTIFICATES, certificate_root, "5_A")


@pytest.fixture(scope="module")
def proofs(tmp_path_factory: pytest.TempPathFactory) -> Answers:
    return asked(tmp_path_factory.mktemp("hostile"), PROOFS, proof_root, "15_A")


def assert_harmless(answers: dict[str, Done], file: str, fault: str) -> None:
    """Each command tells of the file in one line, with exit code 1, and takes little memory."""
    for command in ("check", "export"):
        assert_rejects(answers[command][:3], file, fault)
    assert fault in answers["show"].out.splitlines()[0]
    for command in ("check-all", "door"):
        (line,) = (x for x in answers[command].out.splitlines() if file in x)
        assert line.startswith("rejected: ")
        assert fault in line
    for done in answers.values():
        assert done.code == 1
        assert "Traceback" not in done.out + done.err
        assert done.megabytes < MEGABYTES


@pytest.mark.parametrize("name", CERTIFICATES)
def test_certificate(certificates: Answers, name: str) -> None:
    if name not in certificates:
        pytest.skip("this user must not make a device")
    assert_harmless(certificates[name], YES, CERTIFICATES[name][1])


@pytest.mark.parametrize("name", PROOFS)
def test_proof(proofs: Answers, name: str) -> None:
    if name not in proofs:
        pytest.skip("this user must not make a device")
    fault = PROOFS[name][1]
    assert_harmless(proofs[name], "certificates/15_A.json", fault)
    shown = f"realizable: no is claimed, but rejected, by {NO}: "
    assert shown in proofs[name]["show"].out
    unreadable = name in PLACES or "not ASCII" in fault
    missing = "not there, or not the proof that the certificate names"
    assert (f"{shown}{missing}" in proofs[name]["show"].out) == unreadable


@pytest.fixture(scope="module")
def formulas(tmp_path_factory: pytest.TempPathFactory) -> dict[str, Done]:
    folder, commands = tmp_path_factory.mktemp("hostile"), []
    (folder / "proof").write_text("1 0 2 0\n")
    for number, (place, _) in enumerate(FORMULAS.values()):
        place(folder / str(number))
        commands.append(("certify", "replay", str(folder / str(number)), str(folder / "proof")))
    return dict(zip(FORMULAS, run_all(commands), strict=True))


@pytest.mark.parametrize("name", FORMULAS)
def test_formula(formulas: dict[str, Done], name: str) -> None:
    assert_rejects(formulas[name][:3], "rejected: ", FORMULAS[name][1])
    assert formulas[name].megabytes < MEGABYTES


SEVEN = (
    *("a pipe", "a link to the right content", "a terabyte of zeros", "a megabyte of NUL"),
    *("a megabyte of digits", "the largest number", "many empty deletions"),
)


def test_proofs_of_completeness(tmp_path: Path) -> None:
    root = str(complete_root(tmp_path / "root", (PROOFS[name][0] for name in SEVEN)))
    for done in run_all([("certify", "check-all", "--root", root), ("certify.kernel", root)]):
        rejected = [x for x in done.out.splitlines() if x.startswith("rejected: ")]
        assert done.code == 1
        assert done.err == ""
        assert done.megabytes < MEGABYTES
        for line, file, name in zip(rejected, COMPLETE, SEVEN, strict=True):
            assert line.startswith(f"rejected: {file}: ")
            assert PROOFS[name][1] in line


# What is long, and yet as it should be


def test_fractions_as_long_as_they_may_be(tmp_path: Path) -> None:
    root = str(fraction_root(tmp_path / "root"))
    commands = [
        ("certify", "check-all"),
        ("certify", "show", "15_E"),
        ("certify", "explain", "8_E", "valid"),
        ("certify", "draw", "8_E", "--to", str(tmp_path / "8_E.svg")),
        ("certify.kernel",),
    ]
    asked = [(*command, *(["--root"] * ("kernel" not in command[0])), root) for command in commands]
    for done in run_all(asked):
        assert (done.code, done.err) == (0, "")
        assert done.megabytes < MEGABYTES


def test_a_negative_zero_is_zero(tmp_path: Path) -> None:
    root = certificate_root(tmp_path, spoiled("[0, 0, 0]", '[-0, "-0/9", 0]'))
    (done,) = run_all([("certify", "check", "5_A", "--root", str(root))])
    assert (done.code, done.out) == (0, "ok: 5_A: realizable yes, convex yes, valid yes\n")


@pytest.mark.parametrize("sign", ["", "-"])
@pytest.mark.parametrize("denominator", [1, 39, 78])
def test_a_fraction_has_at_most_eighty_characters(
    tmp_path: Path, sign: str, denominator: int
) -> None:
    """Sign and slash are counted; a point moved by next to nothing, or far out, tells which."""
    for length, told in ((80, False), (81, True)):
        numerator = length - denominator - 1 - len(sign)
        if numerator:
            text = f"{sign}{'1' * numerator}/{'1' * denominator}"
            assert len(text) == length
            root = certificate_root(tmp_path / text, spoiled("[1, 0, 0]", f'[1, 0, "{text}"]'))
            fault = check_pattern(root, "5_A").fault or ""
            assert ("neither an integer nor a fraction" in fault) == told
