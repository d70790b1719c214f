"""Write the data in certificates/ and proofs/ as Coq modules.

    python3 generate.py MODULE [--root FOLDER]

prints one module; the folder is the one that holds certificates/ and proofs/. Nothing that this
program does needs to be trusted, but for one thing: that the module Catalogue says what the
certificates say. Points and proofs are checked inside Coq, whoever made them. In the place of
seventeen proofs it takes others, from the folder proofs beside this file, see NotValid.v. It shares
no code with the Python package.

Only names and numbers of the files come into a module, so that no file can say anything else to
Coq. A file that is not what it should be ends the program with one line.
"""

import argparse
import json
import re
import sys
from collections.abc import Callable, Iterable, Iterator, Sequence
from fractions import Fraction
from hashlib import sha256
from math import lcm
from pathlib import Path
from typing import Any

FORMAT = "certify-pattern/1"

QUESTIONS = ("realizable", "convex", "valid")

Said = dict[str, Any]
"""What a certificate, or a part of it, says."""


# -- reading ------------------------------------------------------------------------------------


def certificates(root: Path) -> list[Said]:
    """Return the certificates in the order 5_A, 6_A, ..., 15_K."""
    found = [certificate(path) for path in (root / "certificates").glob("*.json")]
    return sorted(found, key=lambda c: (len(c["tetrahedra"]), len(c["pattern"]), c["pattern"]))


def certificate(path: Path) -> Said:
    """Return what a certificate says, after a look at everything that is taken from it."""
    try:
        said: Said = json.loads(path.read_text("utf-8"))
        require(said["format"] == FORMAT and said["pattern"] == path.stem)
        require(re.fullmatch(r"[0-9]{1,2}_[A-Z]{1,2}", said["pattern"]))
        for four in said["tetrahedra"]:
            require(len(four) == 4 and all(type(v) is int and 1 <= v <= 8 for v in four))
        for question in QUESTIONS:
            require(said[question]["answer"] in ("yes", "no", "open"))
            for point in said[question].get("points", ()):
                require(len(point) == 3 and all(map(is_rational, point)))
            if said[question]["answer"] == "no":
                require(re.fullmatch(r"[0-9a-f]{64}", said[question]["sha256"]))
            for final in said[question].get("final_polynomials", ()):
                for quadruple, sign in final["signs"].items():
                    require(re.fullmatch(r"[1-8]{4}", quadruple) and sign in (-1, 0, 1))
                for times, six in final["inequalities"]:
                    require(type(times) is int and times > 0 and len(six) == 6)
                    require(all(type(v) is int and 1 <= v <= 8 for v in six))
    except (ValueError, LookupError, TypeError, AttributeError, RecursionError, OSError) as error:
        sys.exit(f"{path}: this is no certificate ({type(error).__name__})")
    return said


def require(condition: object) -> None:
    """Raise ValueError unless a condition holds."""
    if not condition:
        raise ValueError


def is_rational(x: object) -> bool:
    """Is this an integer, or a text such as "-3/7"?"""
    return type(x) is int or (
        isinstance(x, str) and re.fullmatch(r"-?[0-9]+/0*[1-9][0-9]*", x) is not None
    )


def answered(root: Path, question: str, answer: str) -> list[Said]:
    """Return the certificates with this answer to the question."""
    return [c for c in certificates(root) if c[question]["answer"] == answer]


def proof_file(root: Path, said: Said, question: str) -> Path:
    """Return the proof of a no: one made for Coq if there is one, else the certificate's.

    That must be there in any case, with the digest that the certificate states.
    """
    name = said["pattern"]
    path = root / "proofs" / f"{name}.{question}.lrat"
    if not path.is_file() or sha256(path.read_bytes()).hexdigest() != said[question]["sha256"]:
        sys.exit(f"{path}: this is not the proof that the certificate states")
    own = Path(__file__).resolve().parent / "proofs" / f"{name}.lrat"
    return own if question == "valid" and own.exists() else path


def lrat_steps(path: Path) -> Iterator[tuple[str, list[str], list[str]]]:
    """Yield number, literals and hints of every step that adds a clause; deletions are left out.

    A clause that is not deleted does no harm: every clause follows from the formula.
    """
    try:
        for line in path.read_text("ascii").splitlines():
            words = line.split(" ")
            if words[1] != "d":
                end = words.index("0")
                require(words[-1] == "0" and all(re.fullmatch(r"-?[0-9]+", w) for w in words))
                yield words[0], words[1:end], words[end + 1 : -1]
    except (ValueError, LookupError, OSError) as error:
        sys.exit(f"{path}: this is no LRAT proof ({type(error).__name__})")


# -- writing ------------------------------------------------------------------------------------


def coq_list(items: Iterable[str], separator: str = "; ") -> str:
    """Return a list in Coq's notation."""
    return f"[{separator.join(items)}]"


def vertices(numbers: Sequence[int]) -> str:
    """Return a tuple of vertices."""
    return f"({', '.join(f'V{v}' for v in numbers)})"


def tetrahedra(certificate: Said) -> str:
    """Return the list of tetrahedra of a certificate."""
    return coq_list(map(vertices, certificate["tetrahedra"]))


def integral(points: Sequence[Sequence[int | str]]) -> str:
    """Return eight points, all multiplied by one positive integer that makes them integral."""
    exact = [[Fraction(x) for x in point] for point in points]
    scale = lcm(*(x.denominator for point in exact for x in point))
    return coq_list(f"({', '.join(number(int(x * scale)) for x in point)})" for point in exact)


def number(n: int | str) -> str:
    """Return an integer that may stand in a tuple."""
    return f"({n})" if str(n).startswith("-") else str(n)


def proof(path: Path) -> str:
    """Return an LRAT proof as a list of steps, in the notation of Lrat.v."""
    return coq_list(
        (
            f"Step {name} {coq_list(literals)}%Z {coq_list(hints)}"
            for name, literals, hints in lrat_steps(path)
        ),
        ";\n  ",
    )


def polynomial(final: Said) -> str:
    """Return a final polynomial: signs of quadruples, then inequalities with their multipliers."""
    signs = (
        f"({vertices([*map(int, q)])}, {('Vanishes', 'Positive', 'Negative')[sign]})"
        for q, sign in final["signs"].items()
    )
    inequalities = (f"({times}, {vertices(six)})" for times, six in final["inequalities"])
    return f"FinalPolynomial\n  {coq_list(signs)}\n  {coq_list(inequalities)}%nat"


def module(requires: str, *definitions: str) -> str:
    """Return a module."""
    head = f"(* Written by generate.py. *)\n{requires}\nImport ListNotations.\n"
    return "\n".join([head, *definitions, ""])


def definition(name: str, type_: str, items: Iterable[str]) -> str:
    """Return the definition of a list, one item a line."""
    return f"Definition {name} : {type_} :=\n{coq_list(items, ';' + chr(10))}.\n"


# -- the modules --------------------------------------------------------------------------------


def catalogue(root: Path) -> str:
    """Return the 174 patterns with their names and the answers that are claimed."""
    return module(
        "From Coq Require Import List String.\nFrom Certify Require Import Definitions Pattern.",
        definition(
            "catalogue",
            "list pattern",
            (
                f'Pattern "{c["pattern"]}" {claims(c)}\n  {tetrahedra(c)}'
                for c in certificates(root)
            ),
        ),
    )


def claims(certificate: Said) -> str:
    """Return the answers to the three questions."""
    said = {"yes": "Yes", "no": "No", "open": "Unknown"}
    return " ".join(said[certificate[question]["answer"]] for question in QUESTIONS)


def points(question: str) -> Callable[[Path], str]:
    """Return the writer of the module with the points of all patterns with the answer yes."""

    def write(root: Path) -> str:
        return module(
            "From Coq Require Import List ZArith.\nFrom Certify Require Import Integral.\n"
            "Local Open Scope Z_scope.",
            definition(
                f"{question}_points",
                "list (list zpoint)",
                (
                    f"(* {c['pattern']} *) {integral(c[question]['points'])}"
                    for c in answered(root, question, "yes")
                ),
            ),
        )

    return write


def refutations(question: str) -> Callable[[Path], str]:
    """Return the writer of the module with the refutations of all patterns with the answer no."""

    def write(root: Path) -> str:
        definitions, items = [], []
        for c in answered(root, question, "no"):
            name = f"{question}_{c['pattern']}"
            steps = proof(proof_file(root, c, question))
            final = map(polynomial, c[question].get("final_polynomials", ()))
            definitions += [
                f"Definition proof_{name} : list step := [\n  {steps[1:]}.\n",
                f"Definition polynomials_{name} : list final_polynomial :=\n{coq_list(final)}.\n",
            ]
            items.append(f"(polynomials_{name}, proof_{name})")
        return module(
            "From Coq Require Import List ZArith.\n"
            "From Certify Require Import Definitions Lrat Polynomials.\n"
            "Local Open Scope positive_scope.",
            *definitions,
            definition(f"{question}_refutations", "list refutation", items),
        )

    return write


MODULES: dict[str, Callable[[Path], str]] = {
    "Catalogue": catalogue,
    **{f"Points_{question}": points(question) for question in QUESTIONS},
    **{f"Refutations_{question}": refutations(question) for question in QUESTIONS},
}


def main() -> None:
    """Print one module."""
    parser = argparse.ArgumentParser(description=re.split(r"\n\n", __doc__)[0])
    parser.add_argument("module", choices=MODULES)
    parser.add_argument("--root", type=Path, default=Path(__file__).resolve().parent.parent)
    arguments = parser.parse_args()
    print(MODULES[arguments.module](arguments.root), end="")


if __name__ == "__main__":
    main()
