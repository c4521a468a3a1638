# Isochor: implicit, stabilised mixed Material Point Method on deal.II.
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Draw fields on the body. Runs and their results are those of isochor.py,
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
from matplotlib.collections import LineCollection  # noqa: E402
from matplotlib.tri import Triangulation  # noqa: E402
from PIL import Image  # noqa: E402  (Matplotlib needs it, too)

# How a field is drawn: one colour map for each kind of quantity. Fields with a
# sign are white at zero, strains are pale at zero. 'limits' is how the colour
# scale lies: "symmetric" to zero, "from zero", or "free".
Style = namedtuple("Style", "label unit colour_map limits")
FIELD_STYLES = {
    "displacement_x": Style("horizontal displacement", "m", "RdBu_r", "symmetric"),
    "displacement_y": Style("vertical displacement", "m", "RdBu_r", "symmetric"),
    "pressure": Style("pressure (tension positive)", "Pa", "RdBu_r", "symmetric"),
    "cauchy_stress_xx": Style(r"$\sigma_{xx}$", "Pa", "RdBu_r", "symmetric"),
    "cauchy_stress_yy": Style(r"$\sigma_{yy}$", "Pa", "RdBu_r", "symmetric"),
    "cauchy_stress_zz": Style(r"$\sigma_{zz}$", "Pa", "RdBu_r", "symmetric"),
    "cauchy_stress_xy": Style(r"$\sigma_{xy}$", "Pa", "RdBu_r", "symmetric"),
    "mean_stress": Style("mean stress (tension positive)", "Pa", "RdBu_r", "symmetric"),
    "von_mises_stress": Style("von Mises stress", "Pa", "YlGnBu", "from zero"),
    "equivalent_plastic_strain": Style(
        "equivalent plastic strain", "-", "YlOrRd", "from zero"
    ),
    "J": Style("J", "-", "viridis", "free"),
}

# Colours that colour-blind readers can tell apart (Okabe and Ito).
LINE_COLOURS = ("#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00")
OUTLINE = dict(colors="#303030", linewidths=0.6)  # of bodies
GRID_LINES = dict(color="#b0b0b0", linewidth=0.25)  # of the background grid

plt.rcParams.update(
    {
        "figure.dpi": 100,
        "savefig.dpi": 130,
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


def mirrored(data, planes):
    """@p data of points and their mirror images at the coordinate @p planes, for
    example "xz" for x = 0 and z = 0. Shear stresses keep their sign."""
    for plane in planes:
        axis = "xyz".index(plane)
        image = Fields(data)
        for name in ("position", "displacement", "corners", "reference"):
            if name in data:
                image[name] = data[name].copy()
                image[name][..., axis] *= -1
        data = Fields(
            (n, np.concatenate([data[n], image[n]]) if np.ndim(data[n]) else data[n])
            for n in data
        )
    return data


def _part(data):
    """A number for each point, the same for those of one material and body."""
    part = np.zeros(len(data["position"]))
    for name in ("material_id", "body"):
        part = 1000 * part + data.get(name, 0)
    return part


def body_mesh(data):
    """The body as a mesh: positions of its vertices (n, 3), and its cells, those
    of the subdomains in @p data, or without subdomains in 2D triangles between
    the points. Subdomains of a material have a vertex in common where their corners
    are at the same place."""
    if "corners" not in data:
        triangles = Triangulation(*data["position"][:, :2].T)
        edges = data["position"][triangles.triangles]
        edges = np.linalg.norm(edges - np.roll(edges, 1, axis=1), axis=2)
        # longer ones bridge a gap or a concave part of the outline
        allowed = 3 * _spacing(data)[triangles.triangles].max(axis=1)
        return data["position"], triangles.triangles[edges.max(axis=1) < allowed]
    n, n_corners, _ = data["corners"].shape
    corners = data["corners"].reshape(-1, 3)
    edge = np.linalg.norm(data["corners"][:, 0] - data["corners"][:, 1], axis=1)
    kind = _part(data)
    # 1e-3 of an edge, but more than single precision rounds
    size = max(1e-3 * np.percentile(edge, 5), 3e-6 * np.abs(corners).max())
    label = np.arange(len(corners))
    for shift in np.ndindex(2, 2, 2):  # equal places may be rounded apart
        key = np.column_stack(
            [np.round(corners / size + np.array(shift) / 2), np.repeat(kind, n_corners)]
        )
        group = np.unique(key, axis=0, return_inverse=True)[1]
        least = np.full(group.max() + 1, len(corners))
        np.minimum.at(least, group, label)
        label = least[group]
    cells = np.unique(label, return_inverse=True)[1]
    count = np.bincount(cells)
    vertices = [np.bincount(cells, corners[:, d]) / count for d in range(3)]
    return np.column_stack(vertices), cells.reshape(n, n_corners)


def vertex_values(data, cells, values):
    """Means of the @p values of points at the vertices of body_mesh(), weighted
    by volume. Points whose value is NaN don't count; a vertex with no other is
    NaN."""
    if "corners" not in data:
        return values
    known = np.isfinite(values)
    weight = np.repeat(np.maximum(data["volume"], 1e-300) * known, cells.shape[1])
    many = np.repeat(np.where(known, values, 0), cells.shape[1])
    total = np.bincount(cells.ravel(), weight)
    return np.where(
        total > 0,
        np.bincount(cells.ravel(), many * weight) / np.where(total > 0, total, 1),
        np.nan,
    )


def outer_faces(cells):
    """The faces of @p cells that only one of them has, by their vertices, and the
    vertex opposite to each in its cell."""
    n = cells.shape[1]
    faces = np.concatenate([np.delete(cells, c, axis=1) for c in range(n)])
    opposite = np.concatenate([cells[:, c] for c in range(n)])
    _, first, count = np.unique(
        np.sort(faces, axis=1), axis=0, return_index=True, return_counts=True
    )
    outer = first[count == 1]
    return faces[outer], opposite[outer]


def outline(data, vertices, cells):
    """The edges (n, 2, 2) around a body in 2D, a mesh as of body_mesh(). Edges that
    only one cell has, but beyond which another of the same material and body lies
    (seeded with other distances) are none."""
    faces, opposite = outer_faces(cells)
    corners = vertices[faces][:, :, :2]
    if "corners" not in data:
        return corners
    # not at the top: who draws nothing needs no vtk
    from vtkmodules.util.numpy_support import numpy_to_vtk
    from vtkmodules.vtkCommonCore import vtkPoints
    from vtkmodules.vtkCommonDataModel import VTK_TRIANGLE, vtkCellArray
    from vtkmodules.vtkCommonDataModel import vtkStaticCellLocator, vtkUnstructuredGrid

    grid, points, triangles = vtkUnstructuredGrid(), vtkPoints(), vtkCellArray()
    points.SetData(numpy_to_vtk(np.ascontiguousarray(vertices), deep=1))
    triangles.SetData(
        numpy_to_vtk(np.arange(0, cells.size + 1, 3), deep=1),
        numpy_to_vtk(cells.ravel().astype(np.int64), deep=1),
    )
    grid.SetPoints(points)
    grid.SetCells(VTK_TRIANGLE, triangles)
    locator = vtkStaticCellLocator()
    locator.SetDataSet(grid)
    locator.BuildLocator()
    side = corners[:, 1] - corners[:, 0]
    normal = np.column_stack([side[:, 1], -side[:, 0]])  # as long as the edge
    middle = corners.mean(axis=1)
    inwards = ((vertices[opposite][:, :2] - middle) * normal).sum(axis=1) > 0
    normal[inwards] *= -1
    owner = {vertex: cell for cell, three in enumerate(cells) for vertex in three}
    part = _part(data)
    kept = np.ones(len(corners), dtype=bool)
    for e, (x, y) in enumerate(middle + 0.02 * normal):
        found = locator.FindCell((x, y, 0.0))
        kept[e] = found < 0 or part[found] != part[owner[opposite[e]]]
    return corners[kept]


def plot_points(
    ax,
    data,
    field_name,
    style="smooth",
    limits=None,
    scale=1.0,
    unit=None,
    colour_bar=True,
    window=None,
    mirror=False,
):
    """Draw the field @p field_name of the material points @p data (2D) on the body
    into @p ax: on its subdomains, or without these on triangles between points.

    style     "smooth": interpolated between vertices, where it is the mean of
              what is there; "cells": each subdomain in the colour of its own
              value: shows oscillations as they are
    limits    (low, high) of the colour scale, in scaled units
    scale     factor on the values, @p unit is then the unit they are in
    window    (x0, x1, y0, y1), what to show
    mirror    draw the image at x -> -x as well (half models)
    Returns what a colour bar can be made of.
    """
    if style not in ("smooth", "cells"):
        raise ValueError(f"style is 'smooth' or 'cells', not '{style}'.")
    look = FIELD_STYLES.get(field_name, Style(field_name, "", "viridis", "free"))
    if mirror:
        data = mirrored(data, "x")
    values = field(data, field_name) * scale
    if window is not None:
        x, y = data["position"][:, :2].T
        x0, x1, y0, y1 = window
        inside = (x > x0) & (x < x1) & (y > y0) & (y < y1)
        if not inside.any():
            raise OutputError(f"No material point lies in the window {window}.")
    else:
        inside = slice(None)
    limits = limits or colour_limits([values[inside]], look.limits)
    vertices, cells = body_mesh(data)
    at_vertices = vertex_values(data, cells, values)
    if style == "smooth":
        colours = {"shading": "gouraud"}
    elif "corners" in data:
        at_vertices, colours = [], {"facecolors": values, "edgecolors": "face"}
    else:
        colours = {"shading": "flat", "edgecolors": "face"}
    artist = ax.tripcolor(
        vertices[:, 0],
        vertices[:, 1],
        cells,
        *([at_vertices] if len(at_vertices) else []),
        cmap=with_grey(look.colour_map),
        vmin=limits[0],
        vmax=limits[1],
        rasterized=True,
        **colours,
    )
    edges = outline(data, vertices, cells)
    ax.add_collection(LineCollection(edges, **OUTLINE, capstyle="round"))
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


def _spacing(data):
    """Edge length (m) of the square that has a point's current volume, in
    axisymmetric bodies the area of the ring's section."""
    if "volume" not in data:
        raise OutputError("The points carry no field 'volume'.")
    area = np.maximum(data["volume"], 0)
    if "hoop_stretch" in data:
        area = area / (2 * np.pi * np.maximum(data["position"][:, 0], 1e-300))
    return np.sqrt(area)


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
        if ending == "png":  # 200 colours are enough, and small
            with Image.open(target) as image:
                small = image.convert("RGB").quantize(200, kmeans=2)
            small.save(target, optimize=True)
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
