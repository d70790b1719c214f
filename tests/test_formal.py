"""The theorems in Coq: what is generated, what Coq says of it, and that spoiled files break it."""

import json
import os
import re
import shutil
import subprocess
import sys
from collections.abc import Callable, Mapping
from dataclasses import replace
from fractions import Fraction
from hashlib import sha256
from itertools import combinations
from pathlib import Path
from typing import Any

import pytest

from certify.kernel.certificate import PATTERN_NAMES, QUESTIONS, Certificate, No, Yes
from certify.kernel.check import check_pattern, instances_bounded_by
from certify.kernel.hexahedron import BOUNDARY_TYPES, FACETS, SYMMETRIES, image
from certify.kernel.refutation import replay
from certify.kernel.theorems import Outcome
from certify.opinions import formal
from certify.opinions.second import second_opinions
from certify.search import separations
from tests.commands import CHECKOUT, needs_scripts, stand_in

SOURCES = CHECKOUT / "formal"

# What is generated.


def generated(module: str, root: Path = CHECKOUT, code: int = 0) -> str:
    """Return the module, or the error if the exit code is another."""
    program = f"generate{'_complete' if module.startswith('Completeness') else ''}.py"
    command = [sys.executable, "-B", str(SOURCES / program), module, "--root", str(root)]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    assert done.returncode == code, done.stderr
    assert code or not done.stderr
    return done.stderr if code else done.stdout


def numbers(text: str) -> list[int]:
    return [int(word) for word in re.findall(r"-?\d+", text)]


def in_fours(found: list[int]) -> list[tuple[int, ...]]:
    return [tuple(found[i : i + 4]) for i in range(0, len(found), 4)]


def test_the_catalogue_says_what_the_certificates_say(certificates: dict[str, Certificate]) -> None:
    """All that has to be trusted of the generators, read by other code."""
    said = {"Yes": "yes", "No": "no", "Unknown": "open"}
    form = r'Pattern "(\w+)" (\w+) (\w+) (\w+)\s+\[([^]]*)\]'
    found = re.findall(form, generated("Catalogue"))
    assert [own[0] for own in found] == [*PATTERN_NAMES]
    for name, *claims, tetrahedra in found:
        own = certificates[name]
        assert in_fours(numbers(tetrahedra)) == [*own.tetrahedra]
        answers = {"yes" if isinstance(a, Yes) else "no" if isinstance(a, No) else "open"
                   for a in own.answers.values()}  # fmt: skip
        assert answers == {said[claim] for claim in claims}
        for question, claim in zip(QUESTIONS, claims, strict=True):
            kind = {"Yes": Yes, "No": No}[claim]
            assert isinstance(own.answers[question], kind)


@pytest.mark.parametrize("question", QUESTIONS)
def test_points_are_those_of_the_certificates(
    question: str, certificates: dict[str, Certificate]
) -> None:
    found = dict(re.findall(r"\(\* (\w+) \*\) \[(.*)\]", generated(f"Points_{question}")))
    wanted = {n: c.answers[question] for n, c in certificates.items()}
    assert found.keys() == {n for n, answer in wanted.items() if isinstance(answer, Yes)}
    for name, text in found.items():
        answer = wanted[name]
        assert isinstance(answer, Yes)
        own = [Fraction(x) for point in answer.points for x in point]
        coordinates = numbers(text)
        scale = next(x / y for x, y in zip(coordinates, own, strict=True) if y)
        assert scale > 0
        assert coordinates == [scale * x for x in own]


@pytest.mark.parametrize("question", QUESTIONS)
def test_refutations_are_those_of_the_files(
    question: str, certificates: dict[str, Certificate]
) -> None:
    text = generated(f"Refutations_{question}")
    found = dict(
        re.findall(rf"Definition proof_{question}_(\w+) : list step := \[\n(.*?)\]\.\n", text, re.S)
    )
    no = {n for n, c in certificates.items() if isinstance(c.answers[question], No)}
    assert found.keys() == no
    for name, steps in found.items():
        own = SOURCES / "proofs" / f"{name}.lrat"
        if question != "valid" or not own.exists():
            own = CHECKOUT / "proofs" / f"{name}.{question}.lrat"
        lines = [line.split() for line in own.read_text().splitlines()]
        wanted = [[int(word) for word in line if word != "0"] for line in lines if line[1] != "d"]
        assert [numbers(step.replace("%Z", "")) for step in steps.split("Step ")[1:]] == wanted


@pytest.mark.parametrize("letter", BOUNDARY_TYPES)
def test_completeness_is_asked_of_the_same_boundary_and_list(
    letter: str, outcome: Outcome, certificates: dict[str, Certificate]
) -> None:
    text = generated(f"Completeness_{letter}")
    boundary, rest = text.split("Definition images")
    triangles = numbers(boundary.partition(":=")[2])
    found = [{*triangles[i : i + 3]} for i in range(0, len(triangles), 3)]
    assert len(found) == 12
    halves = [(a, b) for a, b in combinations(found, 2) if a | b in map(set, FACETS)]
    assert {tuple(sorted(a & b)) for a, b in halves} == {*BOUNDARY_TYPES[letter]}
    listed = []
    for place, relabelling in re.findall(
        r"\((\d+)%nat, \[([^]]*)\]\)", rest.split("Definition")[0]
    ):
        symmetry = tuple(numbers(relabelling))
        assert symmetry in SYMMETRIES
        tetrahedra = certificates[PATTERN_NAMES[int(place)]].tetrahedra
        listed.append(tuple(sorted(image(symmetry, t) for t in tetrahedra)))
    known = instances_bounded_by(letter, outcome.verdicts)
    assert listed == [tuple(sorted(own)) for own in known]


SPOILED_CERTIFICATES: dict[str, Callable[[dict[str, Any]], object]] = {
    "another's name": lambda c: c.update(pattern="6_A"),
    "another format": lambda c: c.update(format="certify-pattern/2"),
    "a name that says more": lambda c: c.update(pattern='5_A" Yes Yes Yes []. Axiom a : False. (*'),
    "a vertex that says more": lambda c: c["tetrahedra"][0].__setitem__(
        0, "1). Axiom a : False. (*"
    ),
    "a vertex that is none": lambda c: c["tetrahedra"][0].__setitem__(0, 9),
    "an answer that is none": lambda c: c["valid"].update(answer="perhaps"),
    "a coordinate that says more": lambda c: c["valid"]["points"][0].__setitem__(0, "1). Axiom"),
    "a coordinate that is infinite": lambda c: c["valid"]["points"][0].__setitem__(0, "1/0"),
    "no answer": lambda c: c.pop("valid"),
}


@pytest.mark.parametrize("fault", SPOILED_CERTIFICATES)
def test_a_spoiled_certificate_is_refused_in_one_line(root: Path, fault: str) -> None:
    path = root / "certificates" / "5_A.json"
    document = json.loads(path.read_text())
    SPOILED_CERTIFICATES[fault](document)
    path.write_text(json.dumps(document))
    (line,) = generated("Catalogue", root, code=1).splitlines()
    assert line.startswith(f"{path}: this is no certificate")


@pytest.mark.parametrize("content", ["", "[", "[]", "[" * 100_000, "\xff"])
def test_what_is_no_json_is_refused_in_one_line(root: Path, content: str) -> None:
    path = root / "certificates" / "5_A.json"
    path.write_text(content, "latin-1")
    (line,) = generated("Points_valid", root, code=1).splitlines()
    assert line.startswith(f"{path}: this is no certificate")


def restate(root: Path, proof: str) -> None:
    """Let the certificate state the digest that the proof has."""
    pattern, question, _ = Path(proof).name.split(".")
    path = root / "certificates" / f"{pattern}.json"
    document = json.loads(path.read_text())
    document[question]["sha256"] = sha256((root / proof).read_bytes()).hexdigest()
    path.write_text(json.dumps(document))


@pytest.mark.parametrize("line", ["1 0 x 0", "1", "1 2 3", "1 2 0 3", "1 0 ]. Axiom 0", ""])
def test_a_spoiled_proof_is_refused_in_one_line(root: Path, line: str) -> None:
    proof = "proofs/15_A.realizable.lrat"
    path = root / proof
    path.write_text(path.read_text() + f"{line}\n")
    (said,) = generated("Refutations_realizable", root, code=1).splitlines()
    assert said == f"{path}: this is not the proof that the certificate states"
    restate(root, proof)
    (said,) = generated("Refutations_realizable", root, code=1).splitlines()
    assert said.startswith(f"{path}: this is no LRAT proof")


def test_no_proof_can_be_changed(everything: Path, certificates: dict[str, Certificate]) -> None:
    """Not even one in whose place Coq has another."""
    for question in QUESTIONS:
        for name, certificate in certificates.items():
            answer = certificate.answers[question]
            if isinstance(answer, No):
                path = everything / answer.proof
                content = path.read_bytes()
                path.write_bytes(content[:-3] + b"\n")
                (said,) = generated(f"Refutations_{question}", everything, code=1).splitlines()
                assert said.startswith(f"{path}: "), name
                path.write_bytes(content)


# The proofs that are Coq's own.


def test_the_proofs_for_coq_are_found_again(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(sys, "argv", ["separations", str(tmp_path)])
    separations.main()
    found = {path.name: path.read_text() for path in tmp_path.iterdir()}
    assert found == {path.name: path.read_text() for path in SOURCES.glob("proofs/*")}
    for name in (*separations.WITH, *separations.WITHOUT):
        replay(separations.formula(name), found[f"{name}.lrat"])


def test_the_proofs_for_coq_are_those_that_need_sections(
    certificates: dict[str, Certificate], outcome: Outcome
) -> None:
    """And 15_B and 15_I, whose proofs in proofs/ happen to use some."""
    convex = {
        v.pattern for v in outcome.verdicts
        if (v.answers["valid"], v.answers["convex"]) == ("no", "yes")
    }  # fmt: skip
    assert set(separations.WITH) == convex
    listed = re.search(r"uses_intermediate_values[^[]*\[([^]]*)\]", code("Pattern.v"))
    assert listed is not None
    assert re.findall(r'"(\w+)"', listed[1]) == [*separations.WITH]


def test_the_lemmas_that_the_document_names_are_there() -> None:
    chapter = (CHECKOUT / "CHECKING.md").read_text().split("## 13 ")[-1].split("## 14 ")[0]
    named = re.findall(r"`(\w+\.v): (\w+)`", chapter)
    assert len(named) > 20
    for file, lemma in named:
        assert re.search(rf"^(Lemma|Theorem) {lemma}\b", (SOURCES / file).read_text(), re.M), lemma
    assert {*re.findall(r"^\| `(\w+)` \|", chapter, re.M)} == {*formal.THEOREMS}


# What Coq's answer is taken for.

PRINTED = (CHECKOUT / "tests" / "formal.txt").read_text()
"""What Coq 8.16 prints of the theorems."""


def test_all_theorems_are_closed() -> None:
    assert formal.judged(PRINTED) is None
    assert [*formal.statements(PRINTED)] == [*formal.THEOREMS]


def test_an_axiom_or_a_missing_theorem_is_noticed() -> None:
    assumed = PRINTED.replace(formal.CLOSED, "Axioms:\nchoice : forall x, x", 1)
    assert formal.judged(assumed) == "rests on axioms: realizable_171"
    fewer = PRINTED[: PRINTED.index("exactly_174")]
    assert formal.judged(fewer) == "not proved: exactly_174"
    assert formal.judged("") == f"not proved: {', '.join(formal.THEOREMS)}"


def code(name: str) -> str:
    """Return a file without its comments, with single spaces."""
    text = re.sub(r"\(\*.*?\*\)", "", (SOURCES / name).read_text(), flags=re.DOTALL)
    return " ".join(text.split())


def test_nothing_in_formal_is_admitted() -> None:
    """Print Assumptions would tell; this tells where."""
    words = r"\b(Admitted|admit|Axiom|Axioms|Parameter|Parameters|Conjecture|bypass_check)\b"
    for path in SOURCES.glob("*.v"):
        assert not re.search(words, code(path.name)), path.name


READ = {
    "Field.v": "59c987f7c9e1aae2",
    "Definitions.v": "7c6682f005074b67",
    "Triangulation.v": "ea75aec3329f3bb4",
    "Rationals.v": "c39dae8defba190f",
    "Theorems.v": "e2d22785a1ca93e9",
    "Pattern.v": "5f1f72197cf46f42",
}
"""The digest of what section 13 says has to be read. Whoever changes one reads it again first."""


def test_the_definitions_are_those_that_were_read() -> None:
    """A theorem with a weaker definition would be closed, too."""
    read = {name: code(name) for name in READ}
    read["Field.v"] = read["Field.v"].partition("Lemma")[0]
    read["Rationals.v"] = read["Rationals.v"].partition("Definition rationals")[2]
    read["Theorems.v"] = read["Theorems.v"].partition("Definition count")[2].partition("Theorem")[0]
    assert {name: sha256(text.encode()).hexdigest()[:16] for name, text in read.items()} == READ


@pytest.mark.parametrize(
    ("name", "last"),
    [("Theorems.v", "Catalogue Rationals Pattern Definitions"),
     ("Exactly174.v", "Catalogue Pattern Triangulation")],
)  # fmt: skip
def test_the_words_of_the_statements_are_those_of_the_definitions(name: str, last: str) -> None:
    """What is imported last hides what others call the same."""
    assert re.findall(r"From Certify Require Import ([\w ]+)\.", code(name))[-1] == last
    assert code("Triangulation.v").count("Require Export Definitions.") == 1


COMPILED = "mkdir -p build; cp {printed} build/Theorems.out; : > build/Exactly174.out"


@needs_scripts
@pytest.mark.parametrize(
    ("commands", "wanted"),
    [
        (COMPILED, None),
        (f"{COMPILED}; echo 'x\n     : y\nAxioms:' >> build/Theorems.out", "rests on axioms: x"),
        ("echo 'File \"build/Valid.v\", line 20:\nError: no.' >&2; exit 2",
         'does not compile: File "build/Valid.v", line 20: Error: no.'),
        ("echo 'certificates/5_A.json: this is none' >&2; exit 2",
         "does not compile: certificates/5_A.json: this is none"),
        ("exit 2", "does not compile: no message"),
        ("exit 0", "FileNotFoundError"),
    ],
)  # fmt: skip
def test_programs_on_the_path_are_run(
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    outcome: Outcome,
    commands: str,
    wanted: str | None,
) -> None:
    for name in formal.PROGRAMS:
        stand_in(tmp_path / name, commands.replace("{printed}", str(CHECKOUT / "tests/formal.txt")))
    path = f"{tmp_path}:/bin:/usr/bin"
    monkeypatch.setenv("PATH", path)
    theorems_alone = replace(outcome, verdicts=(), completeness=())
    opinion = {
        own.name: own for own in second_opinions(CHECKOUT, theorems_alone, 1, lambda *_: None)
    }["Coq"]
    assert opinion.asked == 1
    assert len(opinion.faults) == (wanted is not None)
    assert all(wanted and wanted in fault for fault in opinion.faults)


def test_coq_gets_what_the_kernel_read(tmp_path: Path, root: Path) -> None:
    name = "certificates/5_A.json"
    assert formal.fault(root, {name: "0" * 64}) == f"{name} is not what the kernel read"


def test_without_coq_it_is_said(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    monkeypatch.setenv("PATH", str(tmp_path))
    assert formal.absent() == "coqc is not on the PATH; see CHECKING.md, section 13"


@needs_scripts
@pytest.mark.skipif(shutil.which("make") is None, reason="make is not installed")
def test_what_is_built_is_what_the_files_say_not_what_is_newer(everything: Path) -> None:
    """Modules are replaced if they differ, and only then."""
    bin_ = everything / "bin"
    bin_.mkdir()
    for name in ("coqc", "coqdep"):
        stand_in(bin_ / name, "exit 0")
    folder = everything / "formal"
    shutil.copytree(SOURCES, folder, ignore=shutil.ignore_patterns("build", "__pycache__"))

    def built() -> dict[str, tuple[int, bytes]]:
        command = ["make", f"PYTHON={sys.executable}", "build/Catalogue.v", "build/Points_valid.v"]
        environment = {"PATH": f"{bin_}:/usr/bin:/bin", "PYTHONDONTWRITEBYTECODE": "1"}
        subprocess.run(command, cwd=folder, check=True, capture_output=True, env=environment)
        return {
            path.name: (path.stat().st_mtime_ns, path.read_bytes())
            for path in (folder / "build").glob("*.v")
        }

    first = built()
    assert built() == first
    certificate = everything / "certificates" / "5_A.json"
    flip(certificate, "valid")
    os.utime(certificate, (0, 0))
    changed = built()
    assert {name for name in first if changed[name] != first[name]} == {"Points_valid.v"}


@needs_scripts
@pytest.mark.skipif(shutil.which("make") is None, reason="make is not installed")
@pytest.mark.parametrize(
    ("words", "good"), [(formal.CLOSED, True), ("Axioms:\nfalse : False", False)]
)
def test_make_fails_if_a_theorem_rests_on_an_axiom(
    everything: Path, words: str, good: bool
) -> None:
    stand_in(everything / "coqc", f"printf '{words}\n'")
    stand_in(everything / "coqdep", "exit 0")
    shutil.copytree(
        SOURCES, everything / "formal", ignore=shutil.ignore_patterns("build", "__pycache__")
    )
    environment = {"PATH": f"{everything}:/usr/bin:/bin", "PYTHONDONTWRITEBYTECODE": "1"}
    command = ["make", "-C", "formal", f"PYTHON={sys.executable}"]
    done = subprocess.run(
        command, cwd=everything, env=environment, capture_output=True, text=True, check=False
    )
    assert (done.returncode == 0) == good, done.stderr
    assert words in done.stdout


# Coq itself.

COQ = shutil.which("coqc") and shutil.which("make")
coq = [
    pytest.mark.slow,
    pytest.mark.skipif(COQ is None, reason="Coq is not installed (Debian: coq)"),
    pytest.mark.xdist_group("formal"),
]


def with_coq(test: Any) -> Any:
    for mark in coq:
        test = mark(test)
    return test


@pytest.mark.skipif(COQ is None, reason="Coq is not installed (Debian: coq)")
def test_the_definitions_compile(tmp_path: Path) -> None:
    """All else that asks Coq is slow: ``python -m pytest -m slow``."""
    for name in ("Field", "Definitions", "Triangulation"):
        shutil.copy(SOURCES / f"{name}.v", tmp_path)
        command = ["coqc", "-q", "-R", ".", "Certify", f"{name}.v"]
        done = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True, check=False)
        assert done.returncode == 0, done.stderr


@pytest.fixture(scope="module")
def built(tmp_path_factory: pytest.TempPathFactory, outcome: Outcome) -> Path:
    """Return a folder with everything compiled."""
    folder = tmp_path_factory.mktemp("formal")
    assert formal.prepare(CHECKOUT, outcome.files, folder) is None
    done = formal.build(folder)
    assert done.returncode == 0, done.stderr
    return folder


def printed(folder: Path) -> str:
    return "".join((folder / "formal/build" / name).read_text() for name in formal.OUTPUT)


@with_coq
def test_every_theorem_is_proved_without_an_axiom(built: Path) -> None:
    """The statements are pinned, too, but as Coq 8.16 prints them."""
    found = formal.statements(printed(built))
    assert [*found] == [*formal.THEOREMS]
    assert {assumptions for _, assumptions in found.values()} == {formal.CLOSED}
    version = subprocess.run(["coqc", "--version"], capture_output=True, text=True, check=True)
    if "8.16" in version.stdout:
        assert printed(built) == PRINTED


def flip(path: Path, question: str) -> None:
    """Change the sign of a coordinate of the last vertex, in a way that the kernel rejects, too."""
    document = json.loads(path.read_text())
    point = document[question]["points"][7]
    axis = next(axis for axis, x in enumerate(point) if x)
    point[axis] = -point[axis] if isinstance(point[axis], int) else f"-{point[axis]}"
    path.write_text(json.dumps(document))
    assert check_pattern(path.parents[1], path.stem).fault is not None


def drop(path: Path) -> None:
    """Leave out the last hint of the last step, which ends in the contradiction."""
    lines = path.read_text().splitlines()
    words = lines[-1].split()
    lines[-1] = " ".join([*words[:-2], words[-1]])
    path.write_text("\n".join(lines) + "\n")


SPOILED: Mapping[str, tuple[str, Callable[[Path], None]]] = {
    "certificates/15_C.json": ("Realizable", lambda path: flip(path, "realizable")),
    "certificates/9_A.json": ("Realizable", lambda path: flip(path, "convex")),
    "certificates/5_A.json": ("Valid", lambda path: flip(path, "valid")),
    "proofs/15_A.realizable.lrat": ("NotRealizable", drop),
    "proofs/15_G.convex.lrat": ("NotConvex", drop),
    "proofs/14_A.valid.lrat": ("NotValid", drop),
    "formal/proofs/15_K.lrat": ("NotValid", drop),
    "proofs/complete.a.lrat": ("Exactly174", drop),
}
"""What is done to a file, and the module that does not compile then."""


@with_coq
@pytest.mark.parametrize("name", SPOILED)
def test_a_spoiled_file_breaks_the_build(built: Path, tmp_path: Path, name: str) -> None:
    folder = tmp_path / "spoiled"
    shutil.copytree(built, folder)
    module, spoil = SPOILED[name]
    spoil(folder / name)
    if re.fullmatch(r"proofs/\d.*", name):
        restate(folder, name)
    done = formal.build(folder, f"build/{module}.vo")
    assert done.returncode != 0
    assert formal.refusal(done.stderr).startswith(f'File "./build/{module}.v"')
