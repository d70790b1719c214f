"""Every answer that the kernel accepted, asked again by code that shares nothing with it.

Each opinion is a question about many subjects, such as "do planes separate the tetrahedra?" about
every placement. A subject on which an opinion differs from the kernel is a failure. An opinion that
needs a program which is not there does not run, and says so.
"""

import shutil
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass, field
from functools import partial
from importlib.util import find_spec
from pathlib import Path
from typing import NamedTuple

from certify.dimacs import read_dimacs
from certify.export import refutation
from certify.families import Families, of_completeness, of_question
from certify.kernel.certificate import Answer, Certificate, No, Yes
from certify.kernel.check import Tetrahedra, Verdict, instances_bounded_by
from certify.kernel.evidence import Evidence, completeness_file
from certify.kernel.hexahedron import BOUNDARY_TYPES
from certify.kernel.theorems import Outcome
from certify.kernel.triangulation import orientation
from certify.opinions import formal, formulas, outside
from certify.opinions.balls import ball_fault, coherent_orientation, instances
from certify.opinions.bounds import jacobian_fault
from certify.opinions.exhaustive import triangulations
from certify.opinions.outside import PROGRAMS
from certify.opinions.planes import convexity_fault, realization_fault
from certify.processes import Report, mapping


@dataclass
class Opinion:
    """What was asked again, by what means, about how many subjects, and where it differs."""

    name: str
    means: str
    asked: int = 0
    faults: list[str] = field(default_factory=list)
    absent: str | None = None
    """Why it did not run, None if it did."""


class Inquiry(NamedTuple):
    """One subject of an opinion; ``ask`` returns None, or how it differs from the kernel."""

    opinion: str
    subject: str
    ask: Callable[[], str | None]


class Refuted(NamedTuple):
    """A function that writes a formula, and the proof against it that the kernel accepted."""

    subject: str
    families: Callable[[], Families]
    proof: str


def second_opinions(root: Path, outcome: Outcome, jobs: int, report: Report) -> list[Opinion]:
    """Ask every opinion about everything that was accepted, in ``jobs`` processes."""
    opinions = {opinion.name: opinion for opinion in not_asked()}
    present = {name for name, opinion in opinions.items() if opinion.absent is None}
    inquiries = [i for i in _inquiries(root, outcome) if i.opinion in present]
    with mapping(jobs) as mapped:
        answers = zip(inquiries, mapped(_ask, inquiries), strict=True)
        for done, (inquiry, fault) in enumerate(answers, start=1):
            opinions[inquiry.opinion].asked += 1
            if fault:
                opinions[inquiry.opinion].faults.append(f"{inquiry.subject}: {fault}")
            report("second opinions", done, len(inquiries))
    return list(opinions.values())


def _ask(inquiry: Inquiry) -> str | None:
    try:
        return inquiry.ask()
    except Exception as error:  # an opinion that breaks off has not agreed
        return ascii(error)


def not_asked() -> Iterator[Opinion]:
    """Yield every opinion before it is asked, and whether it can be."""
    yield Opinion("balls", "by discs as links and by a collapse, not by shellings")
    yield Opinion("realizations", "by planes that separate the tetrahedra, two at a time")
    yield Opinion("convex position", "by a plane that supports the hull at every vertex")
    yield Opinion("Jacobians", "by Taylor forms on boxes, not by Bernstein coefficients")
    yield Opinion("formulas", "as they were written a second time, from the documents")
    yield Opinion("completeness", "by an exhaustive search, without a formula")
    yield Opinion("Coq", "by theorems that rest on no axiom", absent=formal.absent())
    absent = None if find_spec("drup") else "it is on PyPI: pip install drup"
    yield Opinion("drup", "by unit propagation, in code extracted from a proof", absent=absent)
    for name, program in PROGRAMS.items():
        absent = None if shutil.which(name) else "not on the PATH; see docs/outside-checkers.md"
        means = f"by a program on the PATH, from {program.form.upper()}"
        yield Opinion(name, means, absent=absent)


def _inquiries(root: Path, outcome: Outcome) -> Iterator[Inquiry]:
    """Yield every subject of every opinion, the longest first."""
    if outcome.theorems and outcome.ok:
        yield Inquiry("Coq", "the theorems", partial(formal.fault, root, outcome.files))
    for found in outcome.completeness:
        if found.fault is None:
            searched = partial(_searched, found.boundary, found.listed)
            yield Inquiry("completeness", found.boundary, searched)
    for refuted in _refuted(root, outcome):
        for program in PROGRAMS:
            yield Inquiry(program, refuted.subject, partial(_run, program, refuted))
        yield Inquiry("drup", refuted.subject, partial(_drup, refuted))
    for letter in (found.boundary for found in outcome.completeness if found.fault is None):
        known = instances_bounded_by(letter, outcome.verdicts)
        yield Inquiry("formulas", f"complete {letter}", partial(_listing, letter, known))
    for verdict, certificate in _accepted(outcome):
        yield Inquiry("balls", verdict.pattern, partial(_ball, certificate, verdict.instances))
        for question, answer in _answers(verdict, certificate):
            subject = f"{verdict.pattern} {question}"
            if isinstance(answer, Yes):
                for name, ask in _about_points(question, certificate, answer):
                    yield Inquiry(name, subject, ask)
            if isinstance(answer, No):
                yield Inquiry("formulas", subject, partial(_written, certificate, question, answer))


def _accepted(outcome: Outcome) -> Iterator[tuple[Verdict, Certificate]]:
    for verdict in outcome.verdicts:
        if verdict.certificate and verdict.instances:
            yield verdict, verdict.certificate


def _answers(verdict: Verdict, certificate: Certificate) -> Iterator[tuple[str, Answer]]:
    """Yield question and answer where the kernel accepted it."""
    for question, answer in certificate.answers.items():
        if verdict.answers[question] != "rejected":
            yield question, answer


def _refuted(root: Path, outcome: Outcome) -> Iterator[Refuted]:
    """Yield all refutations that were accepted, those of completeness first."""
    for found in outcome.completeness:
        if found.fault is None:
            letter, name = found.boundary, completeness_file(found.boundary)
            known = instances_bounded_by(letter, outcome.verdicts)
            proof = Evidence(root).proof(name, found.files[name])
            yield Refuted(f"complete {letter}", partial(of_completeness, letter, known), proof)
    for verdict, certificate in _accepted(outcome):
        for question, answer in _answers(verdict, certificate):
            if isinstance(answer, No):
                signs = orientation(certificate.tetrahedra)
                proof = Evidence(root).proof(answer.proof, answer.digest)
                families = partial(of_question, question, answer, signs)
                yield Refuted(f"{verdict.pattern} {question}", families, proof)


def _ball(certificate: Certificate, orbit: Iterable[object]) -> str | None:
    tetrahedra = certificate.tetrahedra
    if fault := ball_fault(tetrahedra):
        return fault
    if coherent_orientation(tetrahedra) != orientation(tetrahedra):
        return "another orientation"
    return None if instances(tetrahedra) == set(orbit) else "other instances"


def _about_points(
    question: str, certificate: Certificate, answer: Yes
) -> Iterator[tuple[str, Callable[[], str | None]]]:
    yield "realizations", partial(realization_fault, certificate.tetrahedra, answer.points)
    if question == "convex":
        yield "convex position", partial(convexity_fault, answer.points)
    if question == "valid":
        yield "Jacobians", partial(jacobian_fault, answer.points)


def _written(certificate: Certificate, question: str, answer: No) -> str | None:
    write = {
        "realizable": formulas.realizable,
        "convex": formulas.convex,
        "valid": formulas.valid,
    }[question]
    again = write(coherent_orientation(certificate.tetrahedra))
    again += [formulas.excluded(p.signs, p.inequalities) for p in answer.final_polynomials]
    signs = orientation(certificate.tetrahedra)
    return _formula(of_question(question, answer, signs), again)


def _listing(letter: str, known: Sequence[Tetrahedra]) -> str | None:
    again = formulas.completeness(BOUNDARY_TYPES[letter], known)
    return _formula(of_completeness(letter, known), again)


def _formula(written: Families, again: Sequence[formulas.Named]) -> str | None:
    clauses = [clause for family in written.values() for clause in family]
    difference = formulas.difference(again, clauses)
    if not difference:
        return None
    missing = [f"{len(lacking)} of {family}" for family, lacking in difference.missing.items()]
    return f"missing: {', '.join(missing) or 'none'}; unexplained: {len(difference.unexplained)}"


def _searched(letter: str, listed: Iterable[Iterable[tuple[int, ...]]]) -> str | None:
    found = triangulations(BOUNDARY_TYPES[letter])
    return None if found == set(map(frozenset, listed)) else "other triangulations were found"


def _drup(refuted: Refuted) -> str | None:
    import drup  # noqa: PLC0415 - it is optional

    files = refutation(refuted.families(), refuted.proof, [], core=True)
    lemmas = [tuple(map(int, line.split()))[:-1] for line in files["drat"].splitlines()]
    outcome = drup.check_proof(read_dimacs(files["cnf"]), lemmas).outcome
    return None if outcome == drup.Outcome.VALID else str(outcome)


def _run(program: str, refuted: Refuted) -> str | None:
    files = refutation(refuted.families(), refuted.proof, [], core=True)
    return outside.fault(program, files["cnf"], files[PROGRAMS[program].form])
