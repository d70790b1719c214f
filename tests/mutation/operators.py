"""Mutants of a module: the same source but for one small change to its syntax tree.

What can change no verdict is left alone: annotations and type aliases, docstrings, decorators
(which remember results, or freeze records), imports, and all that stands in a ``raise``, in an
f-string or in the key of a TypeVar, which is the text of a message or a name.
"""

import ast
from collections import Counter
from collections.abc import Callable, Iterator
from copy import copy, deepcopy
from dataclasses import dataclass
from pathlib import Path
from types import CodeType
from typing import Any, TypeAlias

Change = tuple[str, ast.AST]
"""What is changed, in words, and what comes in place of the node."""

Function: TypeAlias = ast.FunctionDef | ast.Lambda

Place = tuple[ast.AST, str, int | None]
"""A node's parent, the field there, and the index if the field is a list."""


@dataclass(frozen=True)
class Mutant:
    """One change to one module.

    key: names it: module and function, line of source, change, and a number from the second of
    several that agree in all this; unit: the first line of the outermost function (or lambda) that
    contains it, None if it is run on import.
    """

    key: str
    module: str
    unit: int | None
    source: "Source"
    place: Place
    new: ast.AST

    def compile(self) -> CodeType:
        """Return the code of the mutated module, or raise SyntaxError if it is not Python."""
        old = self._put(self.new)
        try:
            ast.fix_missing_locations(self.source.tree)
            return compile(self.source.tree, self.source.path, "exec", dont_inherit=True)
        finally:
            self._put(old)

    def _put(self, new: Any) -> Any:
        parent, field, index = self.place
        if index is None:
            old = getattr(parent, field)
            setattr(parent, field, new)
            return old
        siblings = getattr(parent, field)
        old, siblings[index] = siblings[index], new
        return old


class Source:
    """A module's source, and its mutants in the order of the source."""

    def __init__(self, path: Path) -> None:
        self.path = str(path)
        self.module = path.stem
        text = path.read_text(encoding="utf-8")
        self.lines = text.splitlines()
        self.tree = ast.parse(text)
        self.units = _outermost_functions(self.tree)
        """First line -> outermost function; methods and lambdas are functions too."""
        self._seen: Counter[str] = Counter()
        self.mutants = list(self._visit(self.tree, (), None))

    @property
    def unchanged(self) -> Mutant:
        """The module itself, as if its first function were a mutant."""
        place = (self.tree, "body", 0)
        return Mutant("unchanged", self.module, min(self.units), self, place, self.tree.body[0])

    def unit_at(self, line: int) -> int | None:
        """Return the first line of the outermost function around a line."""
        ends = ((first, node.end_lineno or first) for first, node in self.units.items())
        return next((first for first, last in ends if first <= line <= last), None)

    def reporting(self, name: str) -> CodeType:
        """Return the code of the module, in which every outermost function reports when it runs.

        It calls what has the given name in the module, with the number of its first line.
        """
        tree = deepcopy(self.tree)
        for first, function in _outermost_functions(tree).items():
            report = ast.Call(ast.Name(name, ast.Load()), [ast.Constant(first)], [])
            if isinstance(function, ast.Lambda):
                both = ast.Tuple([report, function.body], ast.Load())
                function.body = ast.Subscript(both, ast.Constant(1), ast.Load())
            else:
                function.body.insert(0, ast.Expr(report))
        return compile(ast.fix_missing_locations(tree), self.path, "exec", dont_inherit=True)

    def _visit(self, node: ast.AST, scope: tuple[str, ...], unit: int | None) -> Iterator[Mutant]:
        if isinstance(node, ast.FunctionDef | ast.ClassDef):
            scope = (*scope, node.name)
        inside = unit
        if unit is None and isinstance(node, ast.FunctionDef | ast.Lambda):
            inside = _first_line(node)
        for field, child, index in _children(node):
            # What stands in a function's head, its defaults, is run where the function is defined.
            within = unit if isinstance(child, ast.arguments) else inside
            if not _is_text(node, field, child):
                yield from self._changes(child, (node, field, index), scope, within)
                yield from self._visit(child, scope, within)

    def _changes(
        self, node: ast.AST, place: Place, scope: tuple[str, ...], unit: int | None
    ) -> Iterator[Mutant]:
        for kind, changes in OPERATORS.items():
            if isinstance(node, kind):
                for words, new in changes(node):
                    where = ".".join((self.module, *scope))
                    located = node.iter if isinstance(node, ast.comprehension) else node
                    line = self.lines[getattr(located, "lineno", 1) - 1].strip()
                    key = f"{where} | {line} | {words}"
                    self._seen[key] += 1
                    if self._seen[key] > 1:
                        key += f" #{self._seen[key]}"
                    there = ast.copy_location(new, node)
                    yield Mutant(key, self.module, unit, self, place, there)


def _first_line(function: Function) -> int:
    decorators: list[ast.expr] = getattr(function, "decorator_list", [])
    return min([function.lineno, *(decorator.lineno for decorator in decorators)])


def _outermost_functions(node: ast.AST) -> dict[int, Function]:
    found = {}
    for child in ast.iter_child_nodes(node):
        if isinstance(child, ast.FunctionDef | ast.Lambda):
            found[_first_line(child)] = child
        else:
            found |= _outermost_functions(child)
    return found


def _children(node: ast.AST) -> Iterator[tuple[str, ast.AST, int | None]]:
    for field, value in ast.iter_fields(node):
        if isinstance(value, list):
            for index, child in enumerate(value):
                if isinstance(child, ast.AST):
                    yield field, child, index
        elif isinstance(value, ast.AST):
            yield field, value, None


def _is_text(node: ast.AST, field: str, child: ast.AST) -> bool:
    """Can a change of the child change no verdict, whatever it is? (See the top.)"""
    if field in ("annotation", "returns", "decorator_list", "type_params"):
        return True
    match child:
        case (
            ast.JoinedStr()
            | ast.Import()
            | ast.ImportFrom()
            | ast.Expr(value=ast.Constant())
            | ast.AnnAssign(annotation=ast.Name(id="TypeAlias"))
            | ast.Assign(value=ast.Call(func=ast.Name(id="TypeVar")))
        ):
            return True
    return isinstance(node, ast.Raise)


def _with(node: ast.AST, **fields: Any) -> Any:
    new = copy(node)
    for field, value in fields.items():
        setattr(new, field, value)
    return new


def _without(items: list[Any], index: int) -> list[Any]:
    return [*items[:index], *items[index + 1 :]]


def _nth(index: int, items: list[Any]) -> str:
    return f" {index + 1}" if len(items) > 1 else ""


COMPARISONS: dict[type[ast.cmpop], tuple[str, tuple[type[ast.cmpop], ...]]] = {
    ast.Lt: ("<", (ast.LtE, ast.GtE)),
    ast.LtE: ("<=", (ast.Lt, ast.Gt)),
    ast.Gt: (">", (ast.GtE, ast.LtE)),
    ast.GtE: (">=", (ast.Gt, ast.Lt)),
    ast.Eq: ("==", (ast.NotEq, ast.LtE, ast.GtE)),
    ast.NotEq: ("!=", (ast.Eq, ast.Lt, ast.Gt)),
    ast.In: ("in", (ast.NotIn,)),
    ast.NotIn: ("not in", (ast.In,)),
    ast.Is: ("is", (ast.IsNot,)),
    ast.IsNot: ("is not", (ast.Is,)),
}
ARITHMETIC: dict[type[ast.operator], tuple[str, tuple[type[ast.operator], ...]]] = {
    ast.Add: ("+", (ast.Sub,)),
    ast.Sub: ("-", (ast.Add,)),
    ast.Mult: ("*", (ast.Add, ast.FloorDiv)),
    ast.FloorDiv: ("//", (ast.Mult,)),
    ast.Div: ("/", (ast.Mult,)),
    ast.Pow: ("**", (ast.Mult,)),
    ast.BitOr: ("|", (ast.BitAnd, ast.BitXor)),
    ast.BitAnd: ("&", (ast.BitOr,)),
    ast.BitXor: ("^", (ast.BitOr, ast.BitAnd)),
    ast.LShift: ("<<", (ast.RShift,)),
    ast.RShift: (">>", (ast.LShift,)),
}
FUNCTIONS = {"min": "max", "max": "min", "any": "all", "all": "any", "sorted": "list"}


def _is_a_text(node: ast.expr) -> bool:
    return isinstance(node, ast.Constant) and isinstance(node.value, str)


def _comparison(node: ast.Compare) -> Iterator[Change]:
    everything = [node.left, *node.comparators]
    for i, op in enumerate(node.ops):
        old, others = COMPARISONS[type(op)]
        if isinstance(op, ast.Eq | ast.NotEq) and any(map(_is_a_text, everything[i : i + 2])):
            others = others[:1]  # nothing is decided by an order of the alphabet
        for other in others:
            ops = [*node.ops]
            ops[i] = other()
            words = f"{old}{_nth(i, ops)} becomes {COMPARISONS[other][0]}"
            yield words, _with(node, ops=ops)
    if len(node.ops) > 1:
        for i, end in ((0, "first"), (len(everything) - 1, "last")):
            left, *rest = _without(everything, i)
            ops = _without(node.ops, min(i, len(node.ops) - 1))
            yield (
                f"without the {end} of the chain",
                _with(node, left=left, ops=ops, comparators=rest),
            )


def _junction(node: ast.BoolOp) -> Iterator[Change]:
    conjunction = isinstance(node.op, ast.And)
    old, other = ("and", "or") if conjunction else ("or", "and")
    yield f"{old} becomes {other}", _with(node, op=ast.Or() if conjunction else ast.And())
    for i in range(len(node.values)):
        rest = _without(node.values, i)
        new = _with(node, values=rest) if len(rest) > 1 else rest[0]
        yield f"without operand {i + 1} of {old}", new


def _unary(node: ast.UnaryOp) -> Iterator[Change]:
    if isinstance(node.op, ast.Not):
        yield "without not", node.operand
    if isinstance(node.op, ast.USub):
        yield "without minus", node.operand


def _constant(node: ast.Constant) -> Iterator[Change]:
    value = node.value
    if isinstance(value, bool):
        yield f"{value} becomes {not value}", ast.Constant(not value)
    elif isinstance(value, int):
        for other in (value + 1, value - 1):
            yield f"{value} becomes {other}", ast.Constant(other)
    elif isinstance(value, str):
        yield f"{value[:20]!a} becomes another text", ast.Constant(value + "x")
        if value:
            yield f"{value[:20]!a} becomes empty", ast.Constant("")


def _arithmetic(node: ast.BinOp | ast.AugAssign) -> Iterator[Change]:
    old, others = ARITHMETIC[type(node.op)]
    equals = "=" if isinstance(node, ast.AugAssign) else ""
    for other in others:
        words = f"{old}{equals} becomes {ARITHMETIC[other][0]}{equals}"
        yield words, _with(node, op=other())


def _condition(node: ast.If | ast.IfExp) -> Iterator[Change]:
    for value in (True, False):
        yield f"condition becomes {value}", _with(node, test=ast.Constant(value))


def _loop(node: ast.While) -> Iterator[Change]:
    yield "loop never entered", _with(node, test=ast.Constant(False))


def _filter(node: ast.comprehension) -> Iterator[Change]:
    for i in range(len(node.ifs)):
        yield f"without filter{_nth(i, node.ifs)}", _with(node, ifs=_without(node.ifs, i))
    yield "over nothing", _with(node, iter=ast.copy_location(ast.Tuple([], ast.Load()), node.iter))


def _deletion(node: ast.stmt) -> Iterator[Change]:
    nothing = ast.Tuple([], ast.Load())
    match node:
        case ast.Expr(value=ast.Yield() | ast.YieldFrom()):
            yield "deleted", ast.Expr(ast.YieldFrom(nothing))
        case ast.Continue():
            yield "continue becomes break", ast.Break()
            yield "deleted", ast.Pass()
        case ast.Break():
            yield "break becomes continue", ast.Continue()
        case ast.Return(value=ast.expr()):
            yield "returns None", ast.Return(ast.Constant(None))
        case ast.For():
            yield "loop over nothing", _with(node, iter=ast.copy_location(nothing, node))
        case (
            ast.Expr(value=ast.Call()) | ast.Assign() | ast.AugAssign() | ast.Delete() | ast.Raise()
        ):
            yield "deleted", ast.Pass()


def _raised(node: ast.Raise) -> Iterator[Change]:
    if isinstance(node.exc, ast.Call) and isinstance(node.exc.func, ast.Name):
        other = ast.copy_location(ast.Name("ArithmeticError", ast.Load()), node)
        yield f"raises no {node.exc.func.id}", _with(node, exc=_with(node.exc, func=other))


def _handler(node: ast.Try) -> Iterator[Change]:
    for i in range(len(node.handlers)):
        kept = _without(node.handlers, i)
        words = f"without handler{_nth(i, node.handlers)}"
        if kept:
            yield words, _with(node, handlers=kept)
        else:
            yield words, _with(node, handlers=[], finalbody=[ast.copy_location(ast.Pass(), node)])


def _slice(node: ast.Slice) -> Iterator[Change]:
    for end in ("lower", "upper", "step"):
        if getattr(node, end):
            yield f"slice without {end}", _with(node, **{end: None})


def _call(node: ast.Call) -> Iterator[Change]:
    if isinstance(node.func, ast.Name) and node.func.id in FUNCTIONS:
        other = FUNCTIONS[node.func.id]
        func = ast.copy_location(ast.Name(other, ast.Load()), node)
        keywords = [] if other == "list" else node.keywords
        yield f"{node.func.id} becomes {other}", _with(node, func=func, keywords=keywords)
    for i, keyword in enumerate(node.keywords):
        words = f"without {keyword.arg}="
        yield words, _with(node, keywords=_without(node.keywords, i))


def _elements(node: ast.Tuple | ast.List | ast.Set) -> Iterator[Change]:
    if not isinstance(node, ast.Set) and not isinstance(node.ctx, ast.Load):
        return
    for i in range(len(node.elts)):
        if len(node.elts) > 1 or not isinstance(node, ast.Set):
            yield f"without element {i + 1}", _with(node, elts=_without(node.elts, i))


def _items(node: ast.Dict) -> Iterator[Change]:
    for i in range(len(node.keys)):
        without = _with(node, keys=_without(node.keys, i), values=_without(node.values, i))
        yield f"without item {i + 1}", without


OPERATORS: dict[Any, Callable[[Any], Iterator[Change]]] = {
    ast.Compare: _comparison,
    ast.BoolOp: _junction,
    ast.UnaryOp: _unary,
    ast.Constant: _constant,
    ast.BinOp | ast.AugAssign: _arithmetic,
    ast.If | ast.IfExp: _condition,
    ast.While: _loop,
    ast.comprehension: _filter,
    ast.stmt: _deletion,
    ast.Raise: _raised,
    ast.Try: _handler,
    ast.Slice: _slice,
    ast.Call: _call,
    ast.Tuple | ast.List | ast.Set: _elements,
    ast.Dict: _items,
}
"""Kind of node -> what comes in its place."""
