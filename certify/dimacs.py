"""Formulas in conjunctive normal form as DIMACS text."""

import re
from collections.abc import Iterable, Sequence

from certify.kernel.evidence import Malformed
from certify.kernel.orientations import Clause

_INTEGER = re.compile(r"0|-?[1-9][0-9]{0,8}")


def write_dimacs(formula: Sequence[Clause], comments: Iterable[str] = ()) -> str:
    """Return the formula as DIMACS text, with the comments on top."""
    variables = max((abs(literal) for clause in formula for literal in clause), default=0)
    lines = [f"c {comment}" for comment in comments]
    lines.append(f"p cnf {variables} {len(formula)}")
    lines += [" ".join(map(str, (*clause, 0))) for clause in formula]
    return "\n".join(lines) + "\n"


def read_dimacs(text: str) -> list[Clause]:
    """Return the clauses of DIMACS text, in their order.

    Raises:
        Malformed: It is not DIMACS: a header "p cnf VARIABLES CLAUSES" and as many clauses on these
            variables, each ended by 0; lines that begin with c are comments.
    """
    variables, count = -1, -1
    clauses: list[Clause] = []
    clause: list[int] = []
    for number, line in enumerate(text.split("\n"), start=1):
        words = line.split()
        if not words or words[0].startswith("c"):
            continue
        if words[:2] == ["p", "cnf"] and variables < 0 and len(words) == 4:
            variables, count = (_integer(word, number) for word in words[2:])
            if min(variables, count) < 0:
                raise Malformed(f"line {number}: the header announces a negative number")
            continue
        for literal in (_integer(word, number) for word in words):
            if abs(literal) > variables:
                announced = f"the {max(variables, 0)} variables announced so far"
                raise Malformed(f"line {number}: {literal} is beyond {announced}")
            if literal:
                clause.append(literal)
            else:
                clauses.append(tuple(clause))
                clause = []
    if variables < 0:
        raise Malformed('there is no header "p cnf VARIABLES CLAUSES"')
    if clause:
        raise Malformed("the last clause does not end with 0")
    if len(clauses) != count:
        raise Malformed(f"the header announces {count} clauses, but there are {len(clauses)}")
    return clauses


def _integer(word: str, line: int) -> int:
    if not _INTEGER.fullmatch(word):
        raise Malformed(f"line {line}: {word[:20]!a} is not an integer of at most nine digits")
    return int(word)
