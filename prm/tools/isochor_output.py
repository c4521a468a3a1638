# Isochor: implicit, stabilised mixed Material Point Method on deal.II.
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Draw fields on material points. Runs and their results are those of isochor.py,
whose names this module has, too.

Needs numpy, matplotlib and the Python package of vtk (9 or newer), on Debian
python3-numpy, python3-matplotlib and python3-vtk9. Figures go to files; no
display is used.
"""

from collections import namedtuple
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402  (after the choice of backend)
import numpy as np  # noqa: E402
from isochor import *  # noqa: E402, F403
from isochor import Fields, OutputError, read_points  # noqa: E402
from matplotlib.collections import EllipseCollection  # noqa: E402
from matplotlib.tri import Triangulation  # noqa: E402

# How a field is drawn. Fields with a sign get a diverging colour map that is
# white at zero, the others one that grows from dark to bright. 'limits' says
# how the colour scale lies: "symmetric" to zero, "from zero", or "free".
Style = namedtuple("Style", "label unit colour_map limits")
FIELD_STYLES = {
    "displacement_x": Style("horizontal displacement", "m", "RdBu_r", "symmetric"),
    "displacement_y": Style("vertical displacement", "m", "RdBu_r", "symmetric"),
    "pressure": Style("pressure (tension positive)", "Pa", "RdBu_r", "symmetric"),
    "cauchy_stress_xx": Style(r"$\sigma_{xx}$", "Pa", "RdBu_r", "symmetric"),
    "cauchy_stress_yy": Style(r"$\sigma_{yy}$", "Pa", "RdBu_r", "symmetric"),
    "cauchy_stress_zz": Style(r"$\sigma_{zz}$", "Pa", "RdBu_r", "symmetric"),
    "cauchy_stress_xy": Style(r"$\sigma_{xy}$", "Pa", "RdBu_r", "symmetric"),
    "equivalent_plastic_strain": Style(
        "equivalent plastic strain", "-", "inferno", "from zero"
    ),
    "J": Style("J", "-", "viridis", "free"),
}

# Colours that colour-blind readers can tell apart (Okabe and Ito).
LINE_COLOURS = ("#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00")

plt.rcParams.update(
    {
        "figure.dpi": 100,
        "savefig.dpi": 200,
        "font.size": 10,
        "axes.titlesize": 10,
        "axes.spines.top": False,
        "axes.spines.right": False,
        "legend.frameon": False,
        "svg.hashsalt": "isochor",  # the same picture gives the same file
    }
)


def field(data, name):
    """The scalar field @p name of @p data, a dict of arrays; 'displacement_x' and the
    like are components of vectors."""
    return Fields(data)[name]


# ---------------------------------------------------------------- drawing ---


def colour_limits(values, kind="free", percentile=0.5):
    """Limits (low, high) of a colour scale for the arrays @p values, without
    the outermost @p percentile per cent on either side, so that a few points
    at a singular corner don't set the scale. @p kind as in FIELD_STYLES."""
    # a field that only some of the materials have is NaN elsewhere
    finite = [v[np.isfinite(v)] for v in values]
    if not any(len(v) for v in finite):
        raise OutputError("The field has no value at any point, it is NaN.")
    ranges = [np.percentile(v, [percentile, 100 - percentile]) for v in finite if len(v)]
    low = min(r[0] for r in ranges)
    high = max(r[1] for r in ranges)
    if kind == "symmetric":
        high = max(abs(low), abs(high))
        low = -high
    elif kind == "from zero":
        low = 0.0
    if not high > low:  # a constant field
        high, low = low + (abs(low) or 1), low - (abs(low) or 1)
    return low, high


def with_grey(colour_map):
    """The colour map of this name, grey where a field is NaN."""
    return plt.get_cmap(colour_map).with_extremes(bad="#c0c0c0")


def plot_points(
    ax,
    data,
    field_name,
    style="markers",
    limits=None,
    scale=1.0,
    unit=None,
    colour_bar=True,
    window=None,
    mirror=False,
):
    """Draw the field @p field_name on the material points @p data into @p ax.

    style     "markers": a disc per point as large as the point's volume asks
              for, each in the colour of its own value: shows oscillations as
              they are; "triangles": interpolated between neighbouring points
    limits    (low, high) of the colour scale, in scaled units
    scale     factor on the values, @p unit is then the unit they are in
    window    (x0, x1, y0, y1), what to show
    mirror    draw the image at x -> -x as well (half models)
    Returns what a colour bar can be made of.
    """
    look = FIELD_STYLES.get(field_name, Style(field_name, "", "viridis", "free"))
    positions = data["position"][:, :2]
    values = field(data, field_name) * scale
    if mirror:
        sign = -1 if field_name == "displacement_x" else 1
        positions = np.vstack([positions, positions * [-1, 1]])
        values = np.concatenate([values, sign * values])
    spacing = _spacing(data, len(positions))
    if window is not None:
        margin = 2 * spacing.max()
        inside = (
            (positions[:, 0] > window[0] - margin)
            & (positions[:, 0] < window[1] + margin)
            & (positions[:, 1] > window[2] - margin)
            & (positions[:, 1] < window[3] + margin)
        )
        if not inside.any():
            raise OutputError(f"No material point lies in the window {window}.")
        positions, values = positions[inside], values[inside]
        spacing = spacing[inside]
    limits = limits or colour_limits([values], look.limits)
    draw = {"markers": _draw_markers, "triangles": _draw_triangles}
    if style not in draw:
        raise ValueError(f"style is 'markers' or 'triangles', not '{style}'.")
    artist = draw[style](ax, positions, values, spacing, look.colour_map, limits)
    ax.set_aspect("equal")
    if window is not None:
        ax.set_xlim(window[:2])
        ax.set_ylim(window[2:])
    ax.set_xlabel("x (m)")
    ax.set_ylabel("y (m)")
    if colour_bar:
        add_colour_bar(artist, ax, field_name, values, unit)
    return artist


def add_colour_bar(artist, axes, field_name, values=None, unit=None, **options):
    """Colour bar with label and unit beside @p axes (one or several); pointed
    at an end beyond which @p values go."""
    look = FIELD_STYLES.get(field_name, Style(field_name, "", "viridis", "free"))
    low, high = artist.get_clim()
    below = values is not None and np.nanmin(values) < low
    above = values is not None and np.nanmax(values) > high
    extend = {(0, 0): "neither", (1, 0): "min", (0, 1): "max", (1, 1): "both"}
    settings = {"shrink": 0.8, "aspect": 25, "pad": 0.02, **options}
    bar = artist.axes.figure.colorbar(
        artist, ax=axes, extend=extend[int(below), int(above)], **settings
    )
    unit = look.unit if unit is None else unit
    bar.set_label(look.label + (f" ({unit})" if unit else ""))
    bar.outline.set_visible(False)
    return bar


def _spacing(data, n):
    """Edge length (m) of the square that has a point's current volume, in bodies of
    revolution the area of the ring's section."""
    if "volume" not in data:
        raise OutputError("The points carry no field 'volume'.")
    area = np.maximum(data["volume"], 0)
    if "hoop_stretch" in data:
        area = area / (2 * np.pi * np.maximum(data["position"][:, 0], 1e-300))
    spacing = np.sqrt(area)
    return np.resize(spacing, n)  # repeats it for the mirror image


def _draw_markers(ax, positions, values, spacing, colour_map, limits):
    # Discs on a square lattice of this spacing leave no gap if their diameter
    # is sqrt(2) times the spacing; a little more for uneven points.
    diameter = 1.6 * spacing
    discs = EllipseCollection(
        diameter,
        diameter,
        np.zeros(len(diameter)),
        units="xy",
        offsets=positions,
        transOffset=ax.transData,
        array=values,
        cmap=with_grey(colour_map),
        linewidths=0,
        rasterized=True,
    )
    discs.set_clim(*limits)
    ax.add_collection(discs)
    ax.update_datalim(positions)
    ax.autoscale_view()
    return discs


def _draw_triangles(ax, positions, values, spacing, colour_map, limits):
    triangles = Triangulation(positions[:, 0], positions[:, 1])
    corners = positions[triangles.triangles]
    edges = np.linalg.norm(corners - np.roll(corners, 1, axis=1), axis=2)
    # Longer ones bridge a gap or a concave part of the outline.
    allowed = 3 * spacing[triangles.triangles].max(axis=1)
    without = np.isnan(values[triangles.triangles]).any(axis=1)
    triangles.set_mask((edges.max(axis=1) > allowed) | without)
    return ax.tripcolor(
        triangles,
        values,
        shading="gouraud",
        cmap=colour_map,
        vmin=limits[0],
        vmax=limits[1],
        rasterized=True,
    )


def compare_points(
    cases, field_name, path, columns=None, scale_from=None, **options
):
    """Draw @p field_name of several outputs side by side on one colour scale
    and save the figure as @p path. @p cases: list of (title, data); the scale
    spans all of them, or is that of the case number @p scale_from; @p options
    as for plot_points()."""
    columns = columns or len(cases)
    rows = -(-len(cases) // columns)
    look = FIELD_STYLES.get(field_name, Style(field_name, "", "viridis", "free"))
    scale = options.get("scale", 1.0)
    values = [field(data, field_name) * scale for _, data in cases]
    options["limits"] = options.get("limits") or colour_limits(
        values if scale_from is None else [values[scale_from]], look.limits
    )
    width, height = _extent(cases, options)
    panel = 4.2  # inches, of the longer side
    size = panel / max(width, height)
    figure, axes = plt.subplots(
        rows,
        columns,
        figsize=(
            columns * (size * width + 0.4) + 1.2,
            rows * (size * height + 0.6),
        ),
        squeeze=False,
        sharex=True,
        sharey=True,
        constrained_layout=True,
    )
    for ax in axes.flat[len(cases) :]:
        ax.set_visible(False)
    for ax, (title, data) in zip(axes.flat, cases):
        artist = plot_points(ax, data, field_name, colour_bar=False, **options)
        ax.set_title(title)
        ax.label_outer()
    add_colour_bar(
        artist, axes, field_name, np.concatenate(values), options.get("unit")
    )
    save(figure, path)


def _extent(cases, options):
    if options.get("window"):
        x0, x1, y0, y1 = options["window"]
        return x1 - x0, y1 - y0
    everything = np.vstack([data["position"][:, :2] for _, data in cases])
    width, height = np.ptp(everything, axis=0)
    return width * (2 if options.get("mirror") else 1), height


def save(figure, path, formats=None):
    """Save @p figure as @p path, or with each ending of @p formats."""
    path = Path(path)
    path.parent.mkdir(parents=True, exist_ok=True)
    for ending in formats or [path.suffix.lstrip(".")]:
        target = path.with_suffix("." + ending)
        # Without the date the same results give the same bytes.
        metadata = {"Date": None} if ending == "svg" else None
        # tight: with equal axes the layout may leave no room for titles
        figure.savefig(target, metadata=metadata, bbox_inches="tight")
        print(f"wrote {target}")
    plt.close(figure)


def parse_case(argument):
    """'LABEL=DIRECTORY' or 'DIRECTORY' (its name is then the label), for the
    command lines of the plot scripts: a pair (label, Path). Labels and
    directories may hold further '='."""
    if Path(argument).is_dir():
        return Path(argument).name, Path(argument)
    parts = argument.split("=")
    for n in range(1, len(parts)):
        path = Path("=".join(parts[n:]))
        if path.is_dir() and path != Path(""):
            return "=".join(parts[:n]), path
    raise OutputError(f"There is no directory {parts[-1]}.")
