"""Pictures as PDF and PNG, by matplotlib; the same bytes whenever the libraries are the same."""

# ruff: noqa: PLC0415 - matplotlib is an extra, and slow to import

from io import BytesIO
from typing import Any

from certify.atlas.draw.picture import (
    BASELINE,
    LOOKS,
    PALETTE,
    Circle,
    Label,
    Line,
    Picture,
    Polygon,
)

PIXELS_PER_INCH, POINTS_PER_INCH = 96, 72
POINT = POINTS_PER_INCH / PIXELS_PER_INCH
"""Points in a pixel."""


def pdf(picture: Picture) -> bytes:
    """Return the picture as PDF."""
    about = {"Title": picture.title, "Creator": "certify", "Producer": None, "CreationDate": None}
    return _rendered(picture, "pdf", about)


def png(picture: Picture) -> bytes:
    """Return the picture as PNG, two pixels for each of the page."""
    return _rendered(picture, "png", {"Title": picture.title, "Software": None})


def _rendered(picture: Picture, form: str, about: dict[str, str | None]) -> bytes:
    import matplotlib as mpl
    from matplotlib.figure import Figure

    with mpl.rc_context():
        mpl.rcdefaults()  # whatever the user's settings are
        mpl.rcParams["pdf.fonttype"] = 42
        size = (picture.width / PIXELS_PER_INCH, picture.height / PIXELS_PER_INCH)
        page = Figure(figsize=size, facecolor=_colour("paper"))
        axes = page.add_axes((0, 0, 1, 1))
        axes.set_axis_off()
        axes.set_xlim(0, picture.width)
        axes.set_ylim(picture.height, 0)
        for layer, mark in enumerate(picture.marks):
            axes.add_artist(_artist(mark, layer))
        out = BytesIO()
        page.savefig(out, format=form, dpi=2 * PIXELS_PER_INCH, metadata=about)
    return out.getvalue()


def _colour(name: str | None) -> str:
    return "none" if name is None else PALETTE[name][0]


def _artist(mark: Polygon | Line | Circle | Label, layer: int) -> Any:
    """Return what matplotlib draws for a mark."""
    from matplotlib import lines, patches, text

    look = LOOKS[mark.kind]
    width = look.width * POINT
    filled = {"facecolor": _colour(look.fill), "edgecolor": _colour(look.stroke)}
    match mark:
        case Polygon():
            settings = filled | {"linewidth": width, "joinstyle": "round", "zorder": layer}
            return patches.Polygon(mark.points, closed=True, **settings)
        case Circle():
            return patches.Circle(mark.centre, mark.radius, **filled, linewidth=width, zorder=layer)
        case Line():
            xs, ys = zip(*mark.points, strict=True)
            # Dashes are counted in widths of the line.
            dashes = (0, [dash / look.width for dash in look.dash] or None)
            return lines.Line2D(
                xs,
                ys,
                color=_colour(look.stroke),
                linewidth=width,
                linestyle=dashes,
                solid_capstyle="round",
                dash_capstyle="round",
                solid_joinstyle="round",
                zorder=layer,
            )
        case Label():
            return text.Text(
                mark.at[0],
                mark.at[1] + BASELINE * look.size,
                mark.text,
                color=_colour(look.fill),
                fontsize=look.size * POINT,
                fontweight="bold" if look.bold else "normal",
                horizontalalignment="left" if look.start else "center",
                verticalalignment="baseline",
                parse_math=False,
                zorder=layer,
            )
