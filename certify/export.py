"""The evidence for one claim in other people's formats: DIMACS, LRAT, DRAT, JSON. Not trusted."""

from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any

from certify.dimacs import write_dimacs
from certify.families import Families, of_completeness, of_question
from certify.kernel.certificate import Certificate, No, Yes
from certify.kernel.check import instances_bounded_by
from certify.kernel.chirotope import QUADRUPLES
from certify.kernel.completeness import INNER
from certify.kernel.evidence import Evidence, Malformed, completeness_file
from certify.kernel.orientations import has_sign
from certify.kernel.theorems import Outcome
from certify.kernel.triangulation import label, orientation
from certify.mesh.files import positive
from certify.report import coordinates, json_text
from certify.writing import write_files


def steps(root: Path, certificate: Certificate) -> dict[str, int | None]:
    """Return, by question, how many clauses the proof adds; None where there is none to read."""
    return {
        question: _steps(root, answer) if isinstance(answer, No) else None
        for question, answer in certificate.answers.items()
    }


def _steps(root: Path, answer: No) -> int | None:
    try:
        lines = Evidence(root).proof(answer.proof, answer.digest).splitlines()
    except Malformed:
        return None
    return sum(line.split(" ")[1:2] != ["d"] for line in lines)


def export_answer(
    root: Path,
    certificate: Certificate,
    question: str,
    folder: Path,
    core: bool = False,
    plain: bool = False,
) -> list[Path]:
    """Write the evidence for one answer to files in ``folder``; return them.

    A yes makes a JSON file; a no makes a formula and two proofs of its unsatisfiability; an open
    question makes nothing. core: only the clauses of the formula that the proof names.
    plain: no comments in the formula.

    Raises:
        Malformed: A proof cannot be read.
    """
    answer = certificate.answers[question]
    contents: dict[str, str] = {}
    if isinstance(answer, Yes):
        contents["json"] = json_text(_placement(certificate, question, answer)) + "\n"
    if isinstance(answer, No):
        families = of_question(question, answer, orientation(certificate.tetrahedra))
        proof = Evidence(root).proof(answer.proof, answer.digest)
        comments = None if plain else _about(certificate, question)
        contents = refutation(families, proof, comments, core)
    return _write_all(folder, f"{certificate.pattern}.{question}", contents)


def export_completeness(
    root: Path,
    outcome: Outcome,
    letter: str,
    folder: Path,
    core: bool = False,
    plain: bool = False,
) -> list[Path]:
    """Write the formula and the two proofs that no triangulation with this boundary is missing.

    core and plain are as for an answer.
    """
    comments = [
        f"Triangulations of the hexahedron with boundary type {letter} that are not listed.",
        "Unsatisfiable: the list is complete. The tetrahedra of the variables:",
        *(f"{k}: {label(tetrahedron)}" for k, tetrahedron in enumerate(INNER, start=1)),
    ]
    name = completeness_file(letter)
    (replayed,) = (found for found in outcome.completeness if found.boundary == letter)
    families = of_completeness(letter, instances_bounded_by(letter, outcome.verdicts))
    proof = Evidence(root).proof(name, replayed.files[name])
    contents = refutation(families, proof, None if plain else comments, core)
    return _write_all(folder, f"complete.{letter}", contents)


def _write_all(folder: Path, stem: str, contents: dict[str, str]) -> list[Path]:
    named = {f"{stem}.{suffix}": text.encode("ascii") for suffix, text in contents.items()}
    return write_files(folder, named)


def refutation(
    families: Families, proof: str, comments: Sequence[str] | None, core: bool
) -> dict[str, str]:
    """Return the formula as DIMACS, the proof as LRAT, and as DRAT, by suffix.

    comments: those on top of the formula, followed by what its clauses are; None for none at all.
    """
    clauses = [(family, clause) for family in families for clause in families[family]]
    numbers = [*range(1, len(clauses) + 1)]
    steps = [line.split() for line in proof.splitlines()]
    if core:
        named = {int(word) for step in steps for word in step[step.index("0") + 1 : -1]}
        numbers = sorted(named.intersection(numbers))
        steps = _renumbered(steps, {old: new for new, old in enumerate(numbers, start=1)})
    top = [] if comments is None else [*comments, *_contents(families, numbers)]
    if core and comments is not None:
        top += ["Only the clauses that the proof names. Each with its number in the whole:"]
        top += [f"{new}: {old}" for new, old in enumerate(numbers, start=1)]
    added = [step[1 : step.index("0") + 1] for step in steps if step[1] != "d"]
    return {
        "cnf": write_dimacs([clauses[number - 1][1] for number in numbers], top),
        "lrat": "".join(f"{' '.join(step)}\n" for step in steps),
        "drat": "".join(f"{' '.join(literals)}\n" for literals in added),
    }


def _contents(families: Families, numbers: Sequence[int]) -> Iterator[str]:
    """Say which of the clauses, counted as they are written, belong to which family."""
    first, written = 1, 0
    for family, clauses in families.items():
        own = range(first, first := first + len(clauses))
        if count := sum(number in own for number in numbers):
            yield f"family {family}: clauses {written + 1} to {written + count}"
        written += count


def _renumbered(steps: Sequence[list[str]], numbers: dict[int, int]) -> list[list[str]]:
    """Return the steps with the formula's clauses numbered anew, and what they add after them."""
    new = {str(old): str(number) for old, number in numbers.items()}
    result = []
    for number, *rest in steps:
        if rest[0] != "d":
            new[number] = str(len(new) + 1)
        kept = rest.index("d" if rest[0] == "d" else "0") + 1
        hints = [new[hint] for hint in rest[kept:-1] if hint in new]
        result.append([new.get(number, str(len(new))), *rest[:kept], *hints, "0"])
    return result


def _placement(certificate: Certificate, question: str, answer: Yes) -> dict[str, Any]:
    signs = orientation(certificate.tetrahedra)
    return {
        "pattern": certificate.pattern,
        "question": question,
        "points": coordinates(answer.points),
        "orientation": "each tetrahedron abcd has det(b-a, c-a, d-a) > 0",
        "tetrahedra": [positive(t, sign) for t, sign in sorted(signs.items())],
    }


def _about(certificate: Certificate, question: str) -> list[str]:
    """Return what the formula of a question says, and what its variables mean."""
    comments = [
        f"Pattern {certificate.pattern}, question {question}: clauses that every placement of the",
        "eight points with that property satisfies. Unsatisfiable: there is no such placement.",
        "det abcd is the determinant of p_b - p_a, p_c - p_a, p_d - p_a.",
    ]
    for quadruple in QUADRUPLES:
        positive, negative = (has_sign(quadruple, sign) for sign in (1, -1))
        det = f"det {label(quadruple)}"
        comments.append(f"{positive}: {det} > 0, {negative}: {det} < 0")
    return comments
