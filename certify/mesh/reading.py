"""What engineers have in files: meshes, hexahedra, tetrahedra. Numbers are taken exactly.

In CSV and JSON ``0.1`` is one tenth, and ``"1/3"`` a third. Other files are read by meshio, into
floating-point numbers; each is taken for the rational number that it is. Tried are VTK, VTU, Gmsh
(versions 2 and 4), Medit and Abaqus; whatever else meshio reads should do. Where a format says how
a file ends, a file that ends otherwise is refused, for meshio would take what is left for the
whole, or never come back.

Whatever is wrong with a file is told in one line that names it.
"""

import json
import re
from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from fractions import Fraction
from pathlib import Path
from stat import S_ISREG
from typing import Any

import meshio
import numpy as np
from numpy.typing import NDArray

from certify.mesh.files import silence
from certify.mesh.signs import numbers

KINDS = {"tetra": 4, "pyramid": 5, "wedge": 6, "hexahedron": 8}
"""The kinds of solid cells, by meshio's names, and how many vertices they have."""

MAX_TEXT = 1 << 30
"""Bytes of a CSV or JSON file: some four million hexahedra."""

TAIL = 1 << 10
"""In so many bytes the end of a file must be seen."""

MAX_NUMBER = 400
"""Characters of a number in them; the longest double has 310 digits before the point."""

MAX_EXPONENT = 400

_NUMBER = re.compile(r"[+-]?(\d+(/\d+)?|(\d+\.?\d*|\.\d+)(?:[eE]([+-]?\d{1,4}))?)", re.ASCII)


GMSH = (
    rb"\$End(Comments|Elements|ElementData|ElementNodeData|Entities|GhostElements"
    rb"|InterpolationScheme|Nodes|NodeData|Parametrizations|PartitionedEntities|Periodic"
    rb"|PhysicalNames)\s*\Z"
)
"""Every part of a Gmsh file ends so; the file does with the last part."""

ENDS = {
    ".msh": (GMSH, "Gmsh's $End"),
    **dict.fromkeys((".bdf", ".fem", ".nas"), (rb"(?im)^ENDDATA\b", "Nastran's ENDDATA")),
}
"""Ending of the name -> what must be found in the last bytes, and what that is."""

UNENDING = (".dat", ".tec")
"""Tecplot: meshio's reader does not come to an end if the file is shorter than it says."""


class BadMesh(ValueError):
    """A file is not what it should be; the message names it and says where."""


@dataclass(frozen=True)
class Mesh:
    """The solid cells of a mesh.

    points: an array (n, 3) of float64; cells: kind -> an array of indices from 0, a row for each
    cell, its vertices in the order of VTK. Cells of one kind are counted from 1 in the order of the
    file.
    """

    points: NDArray[Any]
    cells: dict[str, NDArray[np.int64]]


@dataclass(frozen=True)
class Tetrahedra:
    """Four names of vertices for each tetrahedron, and for each marked facet if they are known."""

    cells: tuple[tuple[str, ...], ...]
    facets: tuple[tuple[str, ...], ...] | None = None


@contextmanager
def _naming(path: Path) -> Iterator[None]:
    """Put the name of the file before what is wrong with it."""
    try:
        yield
    except BadMesh as fault:
        raise BadMesh(f"{path}: {fault}") from None


def read_mesh(path: Path) -> Mesh:
    """Read the solid cells of a mesh file; points, lines and surfaces are left out.

    Raises:
        BadMesh: It cannot be read, has no solid cells or others than KINDS, or a coordinate is not
            finite, or a cell has a vertex twice or one that does not exist.
        OSError: There is no such file, or it may not be read.
    """
    with _naming(path):
        return _mesh(path)


def _mesh(path: Path) -> Mesh:
    _require_content(path)
    _require_end(path)
    try:
        with silence() as said:
            mesh = meshio.read(path)
    except SystemExit:  # it exits where it knows no reader that does
        words = _first_line(said.getvalue()) or "it says no more"
        raise BadMesh(f"meshio cannot read it: {words}") from None
    except KeyError as error:
        name = _first_line(str(error))
        raise BadMesh(f"meshio cannot read it: it names {name}, which is not there") from None
    except Exception as error:
        words = _first_line(str(error)) or type(error).__name__
        raise BadMesh(f"meshio cannot read it: {words}") from None
    points = _points(np.asarray(mesh.points))
    before = 0
    for block in mesh.cells:
        if block.dim == 3 and block.type not in KINDS:
            what = f"cell {before + 1} is of the kind {block.type}"
            raise BadMesh(f"{what}; supported are only {', '.join(KINDS)}")
        before += len(block.data)
    found = {kind: _cells(mesh.cells, kind, width) for kind, width in KINDS.items()}
    cells = {kind: rows for kind, rows in found.items() if len(rows)}
    if not cells:
        raise BadMesh("there are no solid cells in it")
    for kind, rows in cells.items():
        _require_vertices(kind, rows, len(points))
    return Mesh(points, cells)


def _first_line(words: str) -> str:
    """Return the first line that is not empty, without the names that numpy puts before numbers."""
    line = next(filter(None, map(str.strip, words.splitlines())), "")
    return re.sub(r"\bnp\.\w+\((\w+)\)", r"\1", line)[:200]


def _require_end(path: Path) -> None:
    """Raise BadMesh if the format says how a file ends, and this one does not."""
    ending = path.suffix.lower()
    if ending in UNENDING:
        raise BadMesh("files of Tecplot are not supported")
    if ending in ENDS:
        pattern, what = ENDS[ending]
        with path.open("rb") as file:
            file.seek(max(0, path.stat().st_size - TAIL))
            if not re.search(pattern, file.read()):
                raise BadMesh(f"it is cut off: {what} is missing at the end")


def _require_content(path: Path) -> None:
    """Raise BadMesh unless the file is a regular one whose first bytes are not all zero."""
    if not S_ISREG(path.stat().st_mode):
        raise BadMesh("it is not a regular file")
    with path.open("rb") as file:
        start = file.read(1 << 16)
    if not start.strip(b"\0 \t\r\n"):
        raise BadMesh("there is nothing in it")
    if b"<!DOCTYPE" in start or b"<!ENTITY" in start:
        raise BadMesh("declarations of a document type are not supported")


def _points(given: Any) -> NDArray[Any]:
    if given.ndim != 2 or given.shape[1] != 3:
        raise BadMesh("its points have not three coordinates")
    if given.dtype.kind == "f" and not np.isfinite(given).all():
        number = int(np.flatnonzero(~np.isfinite(given).all(axis=1))[0]) + 1
        raise BadMesh(f"point {number} has a coordinate that is not a finite number")
    return numbers(given)


def _cells(blocks: Iterable[Any], kind: str, width: int) -> NDArray[np.int64]:
    """Return the cells of a kind, one below the other."""
    own = [np.asarray(block.data) for block in blocks if block.type == kind]
    for rows in own:
        if rows.ndim != 2 or rows.shape[1] != width or rows.dtype.kind not in "iu":
            raise BadMesh(f"a {kind} has not {width} vertices")
    found: NDArray[np.int64] = np.concatenate([np.empty((0, width), np.int64), *own])
    return found.astype(np.int64)


def _require_vertices(kind: str, rows: NDArray[np.int64], points: int) -> None:
    outside = ((rows < 0) | (rows >= points)).any(axis=1)
    if outside.any():
        number = int(outside.argmax())
        vertex = next(v for v in rows[number].tolist() if not 0 <= v < points)
        raise BadMesh(f"{kind} {number + 1} has vertex {vertex + 1}, with {points} points in all")
    ordered = np.sort(rows, axis=1)
    twice = (ordered[:, 1:] == ordered[:, :-1]).any(axis=1)
    if twice.any():
        raise BadMesh(f"{kind} {int(twice.argmax()) + 1} has a vertex twice")


def read_hexahedra(path: Path) -> tuple[NDArray[Any], list[str]]:
    """Read the vertices of hexahedra, in the order of the template, which is that of VTK.

    CSV: eight lines with three numbers for each, or a line of 24; the first line may be a heading.
    JSON: eight points, or a list of such, or an object with "points". Else a mesh.

    Returns:
        An array (n, 8, 3) of float64, or of Fractions if some are no floats; and a name for each.

    Raises:
        BadMesh: As read_mesh does, or there are no hexahedra.
        OSError: There is no such file, or it may not be read.
    """
    with _naming(path):
        points = _hexahedra(path)
    names = [str(number) for number in range(1, len(points) + 1)]
    return points, names if len(points) > 1 else [path.name]


def _hexahedra(path: Path) -> NDArray[Any]:
    ending = path.suffix.lower()
    if ending in (".csv", ".txt", ".json"):
        text = _text(path)
        found = _from_json(text) if ending == ".json" else _from_csv(text)
        return numbers(np.array(found, object).reshape(-1, 8, 3))
    mesh = _mesh(path)
    if "hexahedron" not in mesh.cells:
        raise BadMesh(f"there are no hexahedra in it, but {' and '.join(mesh.cells)} cells")
    vertices: NDArray[Any] = mesh.points[mesh.cells["hexahedron"]]
    return vertices


def _text(path: Path) -> str:
    """Return the text of a file."""
    _require_content(path)
    if path.stat().st_size > MAX_TEXT:
        raise BadMesh(f"it is larger than {MAX_TEXT} bytes")
    try:
        text = path.read_text("utf-8-sig")
    except UnicodeDecodeError:
        raise BadMesh("it is not UTF-8 text") from None
    if "\0" in text:
        raise BadMesh("it is not text, for it contains a NUL")
    return text


def _from_csv(text: str) -> list[Fraction]:
    """Return the coordinates in a CSV file, one after the other."""
    rows = _lines(text)
    if rows and not any(map(_numeric, rows[0][1])):
        del rows[0]  # a heading
    width = 24 if rows and len(rows[0][1]) == 24 else 3
    for line, words in rows:
        if len(words) != width:
            raise BadMesh(f"line {line} has {len(words)} numbers instead of {width}")
    found = [_number(word, f"line {line}") for line, words in rows for word in words]
    _require_whole_hexahedra(len(found), f"{len(rows)} lines")
    return found


def _numeric(word: str) -> bool:
    """Is this a number, or what is called one, such as nan?"""
    try:
        float(word)
    except ValueError:
        return _NUMBER.fullmatch(word) is not None
    return True


def _lines(text: str) -> list[tuple[int, list[str]]]:
    """Return the words of each line, with its number; comments and empty lines are left out."""
    found = []
    for line, content in enumerate(text.splitlines(), start=1):
        words = re.split(r"\s*[,;]\s*|\s+", content.partition("#")[0].strip())
        if words != [""]:
            found.append((line, words))
    return found


def _number(word: object, place: str) -> Fraction:
    """Return the number that a word is, exactly."""
    text = str(word)
    match = _NUMBER.fullmatch(text) if len(text) <= MAX_NUMBER else None
    if match is None or isinstance(word, bool) or (match[2] and not int(match[2][1:])):
        raise BadMesh(f"{place}: {text[:40]!a} is not a number")
    if match[4] and abs(int(match[4])) > MAX_EXPONENT:
        raise BadMesh(f"{place}: the exponent of {text[:40]} is beyond {MAX_EXPONENT}")
    return Fraction(text)


def _require_whole_hexahedra(coordinates: int, what: str) -> None:
    if not coordinates or coordinates % 24:
        raise BadMesh(f"{what} are not eight points for each hexahedron")


def _from_json(text: str) -> list[Fraction]:
    """Return the coordinates in a JSON file, one after the other."""
    value = _json(text)
    if isinstance(value, dict):
        value = value.get("points")
    if not isinstance(value, list):
        raise BadMesh("there is no list of points in it")
    single = all(isinstance(own, list) and len(own) == 3 for own in value) and not any(
        isinstance(x, list) for own in value for x in own
    )
    found = []
    for place, own in enumerate([value] if single else value, start=1):
        if not isinstance(own, list) or len(own) != 8:
            raise BadMesh(f"hexahedron {place} is not a list of eight points")
        for number, point in enumerate(own, start=1):
            where = f"hexahedron {place}, point {number}"
            if not isinstance(point, list) or len(point) != 3:
                raise BadMesh(f"{where} is not a list of three numbers")
            found += [_number(x, where) for x in point]
    _require_whole_hexahedra(len(found), "its points")
    return found


def _json(text: str) -> Any:
    """Return what JSON says, with numbers as they are written."""
    try:
        return json.loads(text, parse_float=str, parse_int=str, parse_constant=str)
    except (ValueError, RecursionError) as error:
        raise BadMesh(f"it is not JSON: {_first_line(str(error))}") from None


def read_tetrahedra(path: Path) -> Tetrahedra:
    """Read tetrahedra, whose vertices may have any names.

    Text: words of four characters, one for each vertex, or a line of four names for each
    tetrahedron. JSON: a list of such words or of lists of four names, or an object with
    "tetrahedra" and perhaps "facets". Else a mesh, whose points are called 1, 2, ...

    Raises:
        BadMesh: As read_mesh does, or there are no tetrahedra.
        OSError: There is no such file, or it may not be read.
    """
    with _naming(path):
        return _tetrahedra(path)


def _tetrahedra(path: Path) -> Tetrahedra:
    ending = path.suffix.lower()
    if ending == ".json":
        return _tetrahedra_of_json(_json(_text(path)))
    if ending in (".csv", ".txt"):
        return Tetrahedra(_tetrahedra_of_text(_text(path)))
    mesh = _mesh(path)
    if [*mesh.cells] != ["tetra"]:
        raise BadMesh(f"there are {' and '.join(mesh.cells)} cells in it, not tetrahedra alone")
    return Tetrahedra(tuple(tuple(map(str, row)) for row in (mesh.cells["tetra"] + 1).tolist()))


def _tetrahedra_of_text(text: str) -> tuple[tuple[str, ...], ...]:
    """Return tetrahedra; four names in each line, eight in all, are not four words of four."""
    rows = _lines(text)
    names = {word for _, words in rows for word in words}
    if rows and all(len(words) == 4 for _, words in rows) and len(names) == 8:
        return tuple(tuple(words) for _, words in rows)
    for line, words in rows:
        for word in words:
            if len(word) != 4:
                raise BadMesh(f"line {line}: {word[:40]!a} has not a character for each vertex")
    if not rows:
        raise BadMesh("there are no tetrahedra in it")
    return tuple(tuple(word) for _, words in rows for word in words)


def _tetrahedra_of_json(value: Any) -> Tetrahedra:
    facets = None
    if isinstance(value, dict):
        facets = value.get("facets")
        value = value.get("tetrahedra")
    cells = _fours(value, "tetrahedra")
    return Tetrahedra(cells, None if facets is None else _fours(facets, "facets"))


def _fours(value: Any, what: str) -> tuple[tuple[str, ...], ...]:
    """Return the names of the vertices of tetrahedra or facets, four of each."""
    if not isinstance(value, list) or not value:
        raise BadMesh(f"there is no list of {what} in it")
    for number, own in enumerate(value, start=1):
        if (
            not isinstance(own, list | str)
            or len(own) != 4
            or not all(isinstance(name, str) for name in own)
        ):
            raise BadMesh(f"number {number} of the {what} has not four vertices")
    return tuple(map(tuple, value))
