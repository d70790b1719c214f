"""Pictures of what a census found."""

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from matplotlib import rc_context
from matplotlib.figure import Figure
from matplotlib.ticker import FuncFormatter, MaxNLocator

from certify.mesh.census.tally import SIZES, Run

STYLE = {"font.size": 9, "svg.hashsalt": "certify", "svg.fonttype": "none"}
"""Pictures have the same bytes whenever the libraries are the same."""

BLUE, RED = "#2a6f97", "#c1440e"


def draw(path: Path, runs: Sequence[Run], printed: Mapping[int, int]) -> None:
    """Draw one census as bars; several as the number of patterns over that of the vertices.

    printed: number of vertices -> how many patterns the paper's Table 4 has.
    """
    with rc_context(STYLE):
        figure = Figure(figsize=(6.4, 3.6), layout="constrained")
        axes = figure.add_subplot()
        if len(runs) == 1:
            _bars(axes, runs[0])
        else:
            _scatter(axes, runs, printed)
        for side in ("top", "right"):
            axes.spines[side].set_visible(False)
        metadata = {"Date": None} if path.suffix == ".svg" else {}
        figure.savefig(path, dpi=150, metadata=metadata)


def _bars(axes: Any, run: Run) -> None:
    found = [(size, times) for size, times in zip(SIZES, run.occurrences, strict=True) if times]
    bars = axes.bar([size for size, _ in found], [times for _, times in found], color=BLUE)
    patterns = dict(zip(SIZES, run.row, strict=True))
    axes.bar_label(bars, [str(patterns[size]) for size, _ in found], padding=2)
    axes.set_yscale("log")
    axes.set_ylim(bottom=0.5)
    axes.xaxis.set_major_locator(MaxNLocator(integer=True))
    axes.set_xlabel("tetrahedra of a hexahedron; above each bar, how many patterns")
    axes.set_ylabel("valid hexahedra")


def _scatter(axes: Any, runs: Sequence[Run], printed: Mapping[int, int]) -> None:
    numbers = sorted({run.vertices for run in runs})
    totals = {n: [sum(run.row) for run in runs if run.vertices == n] for n in numbers}
    axes.vlines(numbers, [min(totals[n]) for n in numbers], [max(totals[n]) for n in numbers],
                color=BLUE, linewidth=1)  # fmt: skip
    axes.plot([run.vertices for run in runs], [sum(run.row) for run in runs], "o",
              color=BLUE, markersize=3, label="here, a point for each seed")  # fmt: skip
    known = [n for n in numbers if n in printed]
    axes.plot(known, [printed[n] for n in known], "D", color=RED, markersize=5,
              markerfacecolor="none", label="the paper's Table 4")  # fmt: skip
    axes.set_xscale("log")
    axes.set_xticks(numbers)
    axes.minorticks_off()
    axes.xaxis.set_major_formatter(FuncFormatter(lambda x, _: f"{int(x):,}"))
    axes.tick_params(axis="x", rotation=30)
    axes.set_xlabel("random points")
    axes.set_ylabel("patterns of valid hexahedra")
    axes.legend(frameon=False)
