"""What the documents show is run, word for word, and the output is compared.

A fenced block is of one of these kinds; HTML comments right above it say more.

    sh         run with bash; <!-- main command --> and <!-- test command --> are run by .ci/run
    console    "$ command" and what it prints; only seconds may differ        <!-- exit: 1 -->
    python     run
    pycon      run, and what it prints is compared (doctest)
    json       the value of a file, or some of its keys                <!-- part of: FILE [KEY] -->
    cnf, lrat  a file for the blocks that follow <!-- file: NAME -->, or <!-- words of: FILE -->
    text       the map of the code                                                <!-- map -->

<!-- slow --> makes it a slow test; <!-- needs: PROGRAM --> skips it where the program is missing.
The blocks below one heading run in order, in one scratch copy of the checkout.
"""

import importlib.util
import json
import os
import re
import shutil
import subprocess
import sys
from dataclasses import dataclass
from itertools import accumulate
from pathlib import Path

import pytest
from _pytest.mark import ParameterSet

from certify.audit import audit, summary
from certify.kernel.certificate import Certificate, No, Yes
from certify.kernel.check import refuted_formula
from certify.kernel.chirotope import QUADRUPLES, determinant, integral
from certify.kernel.orientations import exclusive, grassmann_pluecker, no_overlap, oriented
from certify.kernel.theorems import Outcome
from certify.kernel.triangulation import label, orientation
from certify.kernel.validity import corners, edges, sections

ROOT = Path(__file__).resolve().parents[1]
DOCUMENTS = (
    "README.md",
    "CHECKING.md",
    "FORMAT.md",
    "docs/API.md",
    "docs/meshes.md",
    "docs/outside-checkers.md",
)
COPIED = (
    "certify",
    "certificates",
    "proofs",
    "docs",
    "benchmarks",
    "*.md",
    "*.toml",
    "*.sha256",
    "LICENSE",
)
RUN = ("sh", "console", "python", "pycon")
FILES = ("cnf", "lrat")
FENCED = re.compile(
    r"^(?P<notes>(?:<!-- .* -->\n)*)```(?P<kind>.*)\n(?P<text>(?:.*\n)*?)```$", re.MULTILINE
)
NOTE = re.compile(r"<!-- ([a-z ]+)(?:: (.+))? -->")
HEADING = re.compile(r"^#+ (.*)$", re.MULTILINE)
SECONDS = re.compile(r"\b\d+\.\d+ s\b")


@dataclass(frozen=True)
class Block:
    """One fenced block: where it stands, its kind and text, and the comments right above it."""

    document: str
    line: int
    heading: str
    kind: str
    text: str
    notes: dict[str, str]

    @property
    def is_set_up(self) -> bool:
        """Is it one of the commands that .ci/run runs in fresh environments?"""
        return bool(self.notes.keys() & {"main command", "test command"})

    @property
    def is_plain(self) -> bool:
        """Is it fast, and does it need nothing that may be missing?"""
        return not self.notes.keys() & {"slow", "needs"}


def blocks_of(document: str) -> list[Block]:
    """Return the fenced blocks of a document, in order."""
    text = (ROOT / document).read_text()
    found, heading, end = [], "", 0
    for match in FENCED.finditer(text):
        heading = [heading, *HEADING.findall(text[end : match.start()])][-1]
        line, end = text.count("\n", 0, match.start("kind")) + 1, match.end()
        notes = dict(NOTE.findall(match["notes"]))
        found.append(Block(document, line, heading, match["kind"], match["text"], notes))
    assert 2 * len(found) == len(re.findall("^```", text, flags=re.MULTILINE))
    return found


BLOCKS = [block for document in DOCUMENTS for block in blocks_of(document)]


def in_order(block: Block) -> list[Block]:
    """Return the plain blocks below the same heading that come before it, and the block."""
    return [
        other
        for other in BLOCKS
        if (other.document, other.heading) == (block.document, block.heading)
        and (other is block or (other.line < block.line and other.is_plain))
        and (other.kind in RUN or "file" in other.notes)
        and not other.is_set_up
    ]


def cases() -> list[ParameterSet]:
    """Return what is run together: the plain blocks below a heading, and each other by itself."""
    runs: dict[tuple[str, str, bool | int], list[Block]] = {}
    for block in BLOCKS:
        if block.kind in RUN and not block.is_set_up:
            runs[block.document, block.heading, block.is_plain or block.line] = in_order(block)
    return [
        pytest.param(
            blocks,
            id=f"{document}:{heading}" + (f":{plain}" if plain is not True else ""),
            marks=[pytest.mark.slow] if "slow" in blocks[-1].notes else [],
        )
        for (document, heading, plain), blocks in runs.items()
    ]


@pytest.fixture
def copy(tmp_path: Path) -> Path:
    """Return a scratch copy of the checkout, with the command ``certify`` that runs it."""
    checkout = tmp_path / "checkout"
    checkout.mkdir()
    for path in (path for pattern in COPIED for path in ROOT.glob(pattern)):
        if path.is_dir():
            ignored = shutil.ignore_patterns("__pycache__")
            shutil.copytree(path, checkout / path.name, ignore=ignored)
        else:
            shutil.copy(path, checkout)
    command = tmp_path / "bin" / "certify"
    command.parent.mkdir()
    command.write_text(f'#!/bin/sh\nexec "{sys.executable}" -m certify "$@"\n')
    command.chmod(0o755)
    return checkout


def run(copy: Path, *command: str) -> tuple[int, str]:
    """Run a command in the copy; return its exit code, and what it prints on both streams."""
    path = [copy.parent / "bin", Path(sys.executable).parent, os.environ["PATH"]]
    environment = {key: os.environ[key] for key in ("HOME", "TMPDIR") if key in os.environ}
    environment |= {
        "PATH": os.pathsep.join(map(str, path)),
        "PYTHONPATH": str(copy),
        "PYTHONUTF8": "1",
        "LC_ALL": "C.UTF-8",
        "COLUMNS": "80",
    }
    result = subprocess.run(
        command,
        cwd=copy,
        env=environment,
        stdin=subprocess.DEVNULL,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
        check=False,
    )
    return result.returncode, result.stdout


def bash(copy: Path, script: str) -> tuple[int, str]:
    """Run a script with bash, which stops at the first command that fails."""
    return run(copy, "bash", "-euo", "pipefail", "-c", script)


def without_seconds(text: str) -> str:
    """Return the text with every figure of seconds, and spaces at line ends, left out."""
    return "\n".join(line.rstrip() for line in SECONDS.sub("... s", text).splitlines())


def run_block(copy: Path, block: Block) -> None:
    """Run one block as its kind asks for."""
    expected = int(block.notes.get("exit", 0))
    if block.kind in FILES:
        (copy / block.notes["file"]).write_text(block.text)
    elif block.kind == "sh":
        code, output = bash(copy, block.text)
        assert code == expected, output[-2000:]
    elif block.kind == "console":
        _, *commands = re.split(r"^\$ ", block.text, flags=re.MULTILINE)
        for command, shown in (text.split("\n", 1) for text in commands):
            code, output = bash(copy, command)
            assert without_seconds(output) == without_seconds(shown)
            assert code == expected
    else:
        script = copy / f"block.{block.kind}"
        script.write_text(block.text)
        options = ["-m", "doctest"] if block.kind == "pycon" else []
        code, output = run(copy, sys.executable, *options, str(script))
        assert code == expected, output[-2000:]


def is_missing(program: str) -> bool:
    """Is this neither a command nor a module?"""
    return shutil.which(program) is None and importlib.util.find_spec(program) is None


@pytest.mark.parametrize("blocks", cases())
def test_blocks_do_what_they_show(copy: Path, blocks: list[Block]) -> None:
    for block in blocks:
        needed = block.notes.get("needs")
        if needed and is_missing(needed):
            pytest.skip(f"{needed} is not installed")
        run_block(copy, block)


# No block is left out.


@pytest.mark.parametrize("document", DOCUMENTS)
def test_every_block_is_of_a_kind_that_is_tested(document: str) -> None:
    run_blocks = [block for case in cases() for block in case.values[0]]  # type: ignore[union-attr]
    for block in blocks_of(document):
        where = f"{document}, line {block.line}"
        match block.kind:
            case "sh" | "console" | "python" | "pycon":
                assert block.is_set_up or block in run_blocks, where
            case "json":
                assert "part of" in block.notes, where
            case "cnf" | "lrat":
                assert "words of" in block.notes or block in run_blocks, where
            case "text":
                assert "map" in block.notes, where
            case other:
                pytest.fail(f"{where}: a block of kind {other or 'none'} is not tested")


@pytest.mark.parametrize("document", DOCUMENTS)
def test_no_block_is_indented(document: str) -> None:
    text = re.sub(
        r"^```.*?^```$", "", (ROOT / document).read_text(), flags=re.DOTALL | re.MULTILINE
    )
    assert re.findall(r"^(?: {4}|\t|~~~| +```).*", text, flags=re.MULTILINE) == []


@pytest.mark.parametrize("name", ["main", "test"])
def test_set_up_commands_are_run_in_ci(name: str) -> None:
    """The two blocks are what the function ``block`` of .ci/run extracts, and it is called."""
    (block,) = (block for block in BLOCKS if f"{name} command" in block.notes)
    script = (ROOT / ".ci" / "run").read_text()
    function = re.search(r"^block\(\) \{$.*?^\}$", script, flags=re.DOTALL | re.MULTILINE)
    assert function is not None
    assert "for name in main test; do" in script
    assert bash(ROOT, f"{function[0]}\nblock {name}") == (0, block.text)


@pytest.mark.parametrize("document", DOCUMENTS)
def test_lines_are_not_long(document: str) -> None:
    lines, inside = (ROOT / document).read_text().splitlines(), False
    for number, line in enumerate(lines, start=1):
        inside ^= line.startswith("```")
        table = line.startswith("|") and line.endswith("|")
        if not inside and not table and not line.startswith("!["):
            assert len(line) <= 110, f"{document}, line {number}"


# Blocks that show files.


def of_kind(*kinds: str, note: str) -> list[ParameterSet]:
    chosen = [block for block in BLOCKS if block.kind in kinds and note in block.notes]
    assert chosen
    return [pytest.param(block, id=f"{block.document}:{block.line}") for block in chosen]


@pytest.mark.parametrize("block", of_kind("json", note="part of"))
def test_json_is_that_of_the_file(block: Block) -> None:
    path, *keys = block.notes["part of"].split()
    value = json.loads((ROOT / path).read_text())
    for key in keys:
        value = value[key]
    shown = json.loads(block.text)
    assert shown == {key: value[key] for key in shown}


@pytest.mark.parametrize("block", of_kind("lrat", note="words of"))
def test_words_are_those_of_the_file(block: Block) -> None:
    assert block.text.split() == (ROOT / block.notes["words of"]).read_text().split()


def test_the_map_shows_what_there_is() -> None:
    (block,) = (block for block in BLOCKS if "map" in block.notes)
    listed, above = set(), ""
    for line in block.text.splitlines():
        name = line.split()[0]
        above = above if line.startswith(" ") else name
        listed |= {f"{above}{name}"} if line.startswith(" ") else {name}
    assert [name for name in sorted(listed) if not (ROOT / name).exists()] == []
    rooms = [path for path in (ROOT / "certify").iterdir() if not path.name.startswith(("_", "."))]
    shown = {ROOT / name for name in listed}
    unshown = [path.name for path in rooms if path.suffix != ".typed" and path not in shown]
    assert sorted(unshown) == []
    kernel = [path for path in (ROOT / "certify" / "kernel").glob("*.py") if path.name[0] != "_"]
    assert [path.name for path in kernel if path not in shown] == []


@pytest.mark.parametrize("document", ["README.md", "CHECKING.md"])
def test_counts_of_the_audit_are_those_of_the_audit(document: str, outcome: Outcome) -> None:
    text = (ROOT / document).read_text()
    counts = summary(audit(outcome))
    numbers = [sum(counts.values()), *counts.values()]
    (paragraph,) = (p for p in text.split("\n\n") if f" {numbers[0]} claims" in p)
    sentence = paragraph[paragraph.index(f" {numbers[0]} claims") :]
    assert [int(n) for n in re.findall(r"\b\d+\b", sentence)][: len(numbers)] == numbers


def test_the_picture_is_what_certify_draws(copy: Path) -> None:
    code, output = run(copy, "certify", "draw", "8_E", "--to", "drawn.svg")
    assert code == 0, output[-2000:]
    assert (copy / "drawn.svg").read_text() == (ROOT / "docs" / "8_E.svg").read_text()


# Tables.


def rows(document: str, heading: str) -> list[list[str]]:
    """Return the cells of the first table behind some words, without its top."""
    text = (ROOT / document).read_text().partition(heading)[2]
    table = re.search(r"(?:^\|.*\n)+", text, flags=re.MULTILINE)
    assert table is not None
    lines = table[0].splitlines()[2:]
    return [[cell.strip() for cell in line.strip("|").split("|")] for line in lines]


CLAIMS = "\n## 9 From each claim to the command that replays it"
QUICK = [
    command
    for command in sorted(
        {c for row in rows("CHECKING.md", CLAIMS) for c in re.findall(r"`(certify .*?)`", row[1])}
    )
    if command != "certify spheres"
]


@pytest.mark.parametrize(
    "command", [*QUICK, pytest.param("certify spheres", marks=pytest.mark.slow)]
)
def test_commands_of_the_claims(copy: Path, command: str) -> None:
    code, output = bash(copy, command)
    assert code == 0, output[-2000:]


def test_theorems_of_the_claims_exist(copy: Path) -> None:
    code, output = bash(copy, "certify check-all --json")
    assert code == 0, output[-2000:]
    theorems = {theorem["id"] for theorem in json.loads(output)["theorems"]}
    named = {t for row in rows("CHECKING.md", CLAIMS) for t in re.findall(r"`(.*?)`", row[2])}
    assert named
    assert named <= theorems


def test_references_are_listed_and_used() -> None:
    """Every key like DK74 in the text has an entry in the bibliography, and the reverse."""
    text, _, entries = (ROOT / "CHECKING.md").read_text().partition("\n## 14 Bibliography\n")
    listed = re.findall(r"^\* \[([A-Za-z]+\d\d)\] ", entries, flags=re.MULTILINE)
    assert listed == sorted(set(listed), key=str.casefold)
    assert set(re.findall(r"\b[A-Z][A-Za-z]+\d\d\b", text)) == set(listed)


def test_digests_can_be_recomputed(copy: Path) -> None:
    """The kernel's own door prints the two digests that sha256sum gives."""
    (block,) = (block for block in BLOCKS if "digests" in block.notes)
    _, computed = bash(copy, block.text)
    code, output = bash(copy, "python -m certify.kernel")
    digests = re.findall(r"\b[0-9a-f]{64}\b", computed)
    assert code == 0, output[-2000:]
    assert len(digests) == 2
    assert set(digests) <= set(re.findall(r"\b[0-9a-f]{64}\b", output))


def reads(literal: int) -> str:
    """Write a literal as a comparison with zero."""
    comparison = "><"[abs(literal) % 2 - 1] if literal > 0 else "≤≥"[abs(literal) % 2 - 1]
    return f"{label(QUADRUPLES[(abs(literal) - 1) // 2])} {comparison} 0"


def test_hints_are_decoded_rightly(certificates: dict[str, Certificate], shipped: Path) -> None:
    """Replay the proof that FORMAT follows by hand, and compare the rows of its table."""
    certificate = certificates["15_K"]
    answer = certificate.answers["valid"]
    assert isinstance(answer, No)
    formula = refuted_formula("valid", answer, orientation(certificate.tetrahedra))
    _, _, hints = (shipped / answer.proof).read_text().partition(" 0 ")
    true: list[int] = []
    replayed = {}
    for place, number in enumerate(map(int, hints.split()[:-1]), start=1):
        clause = formula[number - 1]
        left = [literal for literal in clause if -literal not in true]
        assert len(left) < 2
        true += left
        words = (" ".join(map(str, clause)).replace("-", "−"), ", or ".join(map(reads, clause)))
        forced = reads(left[0]) if left else "nothing is left"
        replayed[str(place)] = [str(place), str(number), *words, forced]
    shown = rows("FORMAT.md", "<!-- hints of: 15_K valid -->")
    assert len(shown) > 9
    assert shown == [replayed[place] for place, *_ in shown]
    assert shown[-1][0] == str(len(replayed))


def test_the_families_end_where_format_says(certificates: dict[str, Certificate]) -> None:
    signs = orientation(certificates["15_K"].tetrahedra)
    families = (
        exclusive(),
        grassmann_pluecker(),
        oriented(signs),
        no_overlap(signs),
        corners(),
        edges(),
        sections(signs),
    )
    (ends,) = rows(
        "FORMAT.md", "The formula has 22 829 clauses. The families end at these numbers:"
    )
    assert list(map(int, ends)) == list(accumulate(len(list(family)) for family in families))


def test_the_yes_is_computed_rightly(certificates: dict[str, Certificate]) -> None:
    """Every determinant that FORMAT prints of 5_A, and the circuit that it takes from them."""
    certificate = certificates["5_A"]
    answer = certificate.answers["realizable"]
    assert isinstance(answer, Yes)
    points = integral(answer.points)

    def edges_of(quadruple: str) -> list[list[int]]:
        first, *others = (points[int(vertex) - 1] for vertex in quadruple)
        return [[x - y for x, y in zip(other, first, strict=True)] for other in others]

    shown = rows("FORMAT.md", "**Determinants.** With the rows *b*−*a*, *c*−*a*, *d*−*a*:")
    assert [name for name, *_ in shown] == list(map(label, certificate.tetrahedra))
    for name, edges_shown, value, sign in shown:
        vectors = edges_of(name)
        assert edges_shown.replace("−", "-") == " ".join(
            f"({','.join(map(str, vector))})" for vector in vectors
        )
        assert int(value.replace("−", "-")) == determinant(vectors)
        must_be = orientation(certificate.tetrahedra)[tuple(map(int, name))]
        assert sign == {1: "positive", -1: "negative"}[must_be]
    quadruples, values, coefficients = (
        row[1:] for row in rows("FORMAT.md", "quintuples, and each is treated as this one, 12368.")
    )
    computed = [determinant(edges_of(quadruple)) for quadruple in quadruples]
    assert [int(value.replace("−", "-")) for value in values] == computed
    dependent = [(-1) ** i * value for i, value in enumerate(computed)]
    assert [int(value.replace("−", "-")) for value in coefficients] == dependent
