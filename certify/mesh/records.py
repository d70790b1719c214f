"""What is found of hexahedra, as records and as a table."""

import csv
import json
from collections import Counter
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass, field
from heapq import nsmallest
from itertools import islice
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from certify.kernel.hexahedron import BOUNDARIES, FACETS, Simplex, simplex
from certify.kernel.triangulation import label
from certify.mesh.hexahedra import VALID, Best, Hexahedra
from certify.mesh.realized import Booleans, labelled

CHUNK = 1000
"""So many hexahedra are looked at together: what is found of their triangulations takes some sixty
megabytes."""

DIAGONALS = frozenset(simplex(pair) for a, b, c, d in FACETS for pair in ((a, c), (b, d)))
"""The twelve diagonals of the facets."""

COLUMNS = {
    "hexahedron": "string",
    "valid": "string",
    "jacobian_at_least": "double",
    "scaled_jacobian": "double",
    "failing_corners": "string",
    "failing_edges": "string",
    "mirrored": "bool",
    "realized": "int64",
    "patterns": "int64",
    "fewest_tetrahedra": "int64",
    "most_tetrahedra": "int64",
    "filled_boundaries": "int64",
    "boundaries_filled_at_all": "int64",
    "best_pattern": "string",
    "least_dihedral": "double",
    "mean_ratio": "double",
}
"""The columns of a table of hexahedra, with their types as Parquet calls them."""

Record = dict[str, Any]


def boundaries_with(diagonals: Iterable[Simplex]) -> Booleans:
    """Return which of the 64 boundaries have all of some diagonals."""
    wanted = frozenset(diagonals)
    return np.array([wanted <= own for own in BOUNDARIES])


def record(hexahedra: Hexahedra, index: int, name: str) -> Record:
    """Return everything that is found of a hexahedron."""
    least, most = hexahedra.jacobian_bounds(index)
    at_all, filled = hexahedra.fillable_at_all[index], hexahedra.fillable[index]
    return {
        "hexahedron": name,
        "valid": VALID[int(hexahedra.valid[index])],
        "jacobian": {"at_least": str(least), "at_most": str(most)},
        "scaled_jacobians": [round(x, 6) for x in hexahedra.scaled_jacobians[index].tolist()],
        "failing_corners": (np.flatnonzero(hexahedra.corners[index]) + 1).tolist(),
        "failing_edges": [label(edge) for edge in hexahedra.edges(index)],
        "mirrored": bool(hexahedra.mirrored[index]),
        "realized": int(hexahedra.realized[index].sum()),
        "patterns": [_pattern(best) for best in hexahedra.best(index)],
        "boundaries": {
            "filled": _diagonals(filled),
            "with_boundary_tetrahedra": _diagonals(at_all & ~filled),
            "impossible": _diagonals(hexahedra.boundaries & ~at_all),
        },
        "triangulations": [
            {"pattern": own.pattern, "tetrahedra": [label(t) for t in own.tetrahedra]}
            for place in np.flatnonzero(hexahedra.realized[index]).tolist()
            for own in [labelled(hexahedra.root)[place]]
        ],
    }


def _pattern(best: Best) -> Record:
    return {
        "pattern": best.instance.pattern,
        "tetrahedra": len(best.instance.signs),
        "realized": best.realized,
        "least_dihedral": round(best.dihedral, 6),
        "mean_ratio": round(best.mean_ratio, 6),
        "best": [label(tetrahedron) for tetrahedron in best.instance.tetrahedra],
    }


def _diagonals(boundaries: Booleans) -> list[str]:
    return [
        " ".join(map(label, sorted(BOUNDARIES[place])))
        for place in np.flatnonzero(boundaries).tolist()
    ]


def rows(
    points: NDArray[Any],
    names: Sequence[str],
    root: Path,
    boundaries: Booleans,
    report: Callable[[str, int, int], None],
) -> Iterator[Record]:
    """Yield a row for each hexahedron, with the same keys; ``report`` is told how many are done."""
    for start in range(0, len(points), CHUNK):
        part = Hexahedra(points[start : start + CHUNK], root, boundaries)
        for index in range(len(part.points)):
            yield _row(part, index, names[start + index])
        report("hexahedra", start + len(part.points), len(points))


def _row(part: Hexahedra, index: int, name: str) -> Record:
    patterns = part.best(index)
    sizes = [len(own.instance.signs) for own in patterns]
    best = max(patterns, key=lambda own: own.dihedral, default=None)
    return {
        "hexahedron": name,
        "valid": VALID[int(part.valid[index])],
        "jacobian_at_least": float(part.jacobian_at_least[index]),
        "scaled_jacobian": float(part.scaled_jacobians[index].min()),
        "failing_corners": label(np.flatnonzero(part.corners[index]) + 1),
        "failing_edges": " ".join(label(edge) for edge in part.edges(index)),
        "mirrored": bool(part.mirrored[index]),
        "realized": sum(own.realized for own in patterns),
        "patterns": len(patterns),
        "fewest_tetrahedra": min(sizes, default=None),
        "most_tetrahedra": max(sizes, default=None),
        "filled_boundaries": int(part.fillable[index].sum()),
        "boundaries_filled_at_all": int(part.fillable_at_all[index].sum()),
        "best_pattern": best.instance.pattern if best else None,
        "least_dihedral": best.dihedral if best else None,
        "mean_ratio": best.mean_ratio if best else None,
    }


@dataclass
class Summary:
    """What is told of many hexahedra: numbers of them, extremes, and the worst."""

    hexahedra: int = 0
    valid: Counter[str] = field(default_factory=Counter)
    mirrored: int = 0
    without: int = 0
    realized: set[int] = field(default_factory=set)
    tetrahedra: set[int] = field(default_factory=set)
    worst: list[Record] = field(default_factory=list)

    def over(self, found: Iterable[Record]) -> Iterator[Record]:
        """Pass rows on, and count them."""
        for row in found:
            self.hexahedra += 1
            self.valid[row["valid"]] += 1
            self.mirrored += row["mirrored"]
            self.without += not row["realized"]
            self.realized.add(row["realized"])
            self.tetrahedra |= {row["fewest_tetrahedra"], row["most_tetrahedra"]} - {None}
            self.worst = nsmallest(WORST, [*self.worst, row], key=_rank)
            yield row

    def record(self) -> Record:
        """Return it as a record."""
        return {
            "hexahedra": self.hexahedra,
            **{word: self.valid[key] for key, word in VALIDITY.items()},
            "mirrored": self.mirrored,
            "without_triangulation": self.without,
            "realized": [min(self.realized), max(self.realized)],
            "tetrahedra": [min(self.tetrahedra), max(self.tetrahedra)] if self.tetrahedra else None,
            "worst": [row["hexahedron"] for row in self.worst],
        }


VALIDITY = {"yes": "valid", "no": "not_valid", "undecided": "undecided"}

WORST = 5
"""So many hexahedra are named."""


def _rank(row: Record) -> tuple[bool, bool, float]:
    """Those without a triangulation are worst, then those that are not valid."""
    return row["realized"] > 0, row["valid"] == "yes", row["scaled_jacobian"]


def write_table(path: Path, found: Iterable[Record]) -> None:
    """Write rows to a file, in the format that its ending tells, as they come."""
    FORMATS[path.suffix.lower()](path, iter(found))


def _csv(path: Path, found: Iterator[Record]) -> None:
    with path.open("w", encoding="utf-8", newline="") as file:
        writer = csv.DictWriter(file, COLUMNS, lineterminator="\n")
        writer.writeheader()
        for row in found:
            writer.writerow({key: _word(value) for key, value in row.items()})


def _word(value: object) -> object:
    """Return what a cell of a CSV file says: yes or no for a boolean, nothing for None."""
    return {True: "yes", False: "no"}[value] if isinstance(value, bool) else value


def _json(path: Path, found: Iterator[Record]) -> None:
    with path.open("w", encoding="utf-8") as file:
        separator = "[\n"
        for row in found:
            file.write(separator + json.dumps(row))
            separator = ",\n"
        file.write("\n]\n")


def _parquet(path: Path, found: Iterator[Record]) -> None:
    import pyarrow  # noqa: PLC0415 - an optional library
    from pyarrow.parquet import ParquetWriter  # noqa: PLC0415

    schema = pyarrow.schema([*COLUMNS.items()])
    with ParquetWriter(path, schema) as writer:
        while part := [*islice(found, CHUNK)]:
            writer.write_table(pyarrow.Table.from_pylist(part, schema))


FORMATS: dict[str, Callable[[Path, Iterator[Record]], None]] = {
    ".csv": _csv,
    ".json": _json,
    ".parquet": _parquet,
}
"""Ending -> what writes a file of rows."""
