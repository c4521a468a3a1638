# Isochor: implicit, stabilised mixed Material Point Method on deal.II.
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Run Isochor, read what it writes, draw fields on material points.

Needs numpy, matplotlib and the Python package of vtk (9 or newer), on Debian
python3-numpy, python3-matplotlib and python3-vtk9. Figures go to files; no
display is used.
"""

import os
import shutil
import subprocess
import xml.etree.ElementTree
from collections import namedtuple
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402  (after the choice of backend)
import numpy as np  # noqa: E402
from matplotlib.collections import EllipseCollection  # noqa: E402
from matplotlib.tri import Triangulation  # noqa: E402
from vtkmodules.util.numpy_support import vtk_to_numpy  # noqa: E402
from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridReader  # noqa: E402

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


class OutputError(RuntimeError):
    """The program failed, or what it wrote is not what this module reads."""


# ---------------------------------------------------------------- running ---


def find_executable():
    """Path of the program: $ISOCHOR, or build/isochor of this repository, or
    isochor on the PATH, in this order."""
    from_environment = os.environ.get("ISOCHOR")
    if from_environment:
        path = shutil.which(from_environment)
        if path is None:
            raise OutputError(
                f"The environment variable ISOCHOR is <{from_environment}>, "
                "which is not an executable program."
            )
        return path
    built = Path(__file__).resolve().parents[2] / "build" / "isochor"
    if built.is_file() and os.access(built, os.X_OK):
        return str(built)
    path = shutil.which("isochor")
    if path is None:
        raise OutputError(
            "The program isochor was not found. Set the environment variable "
            f"ISOCHOR to its path, or build it as {built}, or put it on the "
            "PATH."
        )
    return path


def run(executable, prm, overrides, outdir, processes=1):
    """Run the scene @p prm with the parameters @p overrides, a dict like
    {"Material/Poisson ratio": 0.499}, and let it write into @p outdir.

    @p executable None means find_executable(). With @p processes > 1 it runs
    under mpirun. Returns @p outdir as a Path; the log is isochor.log in it.
    Results of an earlier run there are deleted, so that they can't be taken
    for those of this one.
    """
    command = [executable or find_executable(), str(prm)]
    if processes > 1:
        command = ["mpirun", "-np", str(processes)] + command
    for name, value in overrides.items():
        command += ["--set", f"{name}={value}"]
    outdir = Path(outdir)
    outdir.mkdir(parents=True, exist_ok=True)
    for pattern in (
        "statistics.txt",
        "points*.*vtu",
        "grid*.*vtu",
        "rigid_bodies*.*vtu",
        "*.pvd",
    ):
        for old in outdir.glob(pattern):
            old.unlink()
    command += ["--output-directory", str(outdir)]

    log = outdir / "isochor.log"
    try:
        with open(log, "w") as stream:
            code = subprocess.run(
                command, stdout=stream, stderr=subprocess.STDOUT
            ).returncode
    except OSError as error:
        raise OutputError(f"Can't run {command[0]}: {error}") from error
    if code != 0:
        tail = "\n".join(log.read_text(errors="replace").split("\n")[-30:])
        raise OutputError(
            f"isochor ended with code {code}.\nCommand: "
            + " ".join(f"'{word}'" if " " in word else word for word in command)
            + f"\nEnd of {log}:\n{tail}"
        )
    return outdir


# ---------------------------------------------------------------- reading ---


def read_statistics(directory):
    """The columns of statistics.txt: a dict from name to numpy array, one
    entry per load step. Columns that hold words become arrays of strings."""
    path = Path(directory) / "statistics.txt"
    if not path.is_file():
        raise OutputError(f"There is no {path}.")
    names, rows = [], []
    for number, line in enumerate(path.read_text().splitlines(), 1):
        if line.startswith("#"):
            index, colon, name = line[1:].partition(":")
            if not colon or index.strip() != str(len(names) + 1):
                raise OutputError(
                    f"{path}, line {number}: expected the header "
                    f"'# {len(names) + 1}: name', not '{line}'."
                )
            names.append(name.strip())
        elif line.strip():
            rows.append(line.split())
            if len(rows[-1]) != len(names):
                raise OutputError(
                    f"{path}, line {number}: {len(rows[-1])} values for "
                    f"{len(names)} columns."
                )
    if len(set(names)) != len(names):
        raise OutputError(f"{path}: two columns have the same name.")

    statistics = Statistics(path)
    for name, column in zip(names, zip(*rows) if rows else [()] * len(names)):
        try:
            statistics[name] = np.array(column, dtype=float)
        except ValueError:
            statistics[name] = np.array(column)
    return statistics


class Statistics(dict):
    """Columns by name; asking for a missing one lists those there are."""

    def __init__(self, path):
        super().__init__()
        self.path = path

    def __missing__(self, name):
        raise OutputError(
            f"{self.path} has no column '{name}'. It has: "
            + ", ".join(f"'{known}'" for known in self)
        )


def read_times(directory, kind="points"):
    """Times and files, a list of pairs, that KIND.pvd lists."""
    path = Path(directory) / f"{kind}.pvd"
    if not path.is_file():
        raise OutputError(f"There is no {path}.")
    try:
        root = xml.etree.ElementTree.parse(path).getroot()
    except xml.etree.ElementTree.ParseError as error:
        raise OutputError(f"{path} is not readable XML: {error}") from error
    records = [
        (float(entry.get("timestep")), path.parent / entry.get("file"))
        for entry in root.iter("DataSet")
    ]
    if not records:
        raise OutputError(f"{path} lists no output.")
    return records


def read_points(directory, step=-1):
    """The material points of one output, a dict of numpy arrays: 'position'
    (n, 3), 'time', and every field under its name; 'deformation_gradient' as
    (n, 3, 3). @p step counts the outputs in points.pvd, -1 is the last."""
    data = read_output(directory, "points", step)
    del data["cells"]
    gradient = data.get("deformation_gradient")
    if gradient is not None and gradient.shape[-1] == 9:
        data["deformation_gradient"] = gradient.reshape(-1, 3, 3)
    return data


def read_points_at(directory, time):
    """read_points() of the output whose time is nearest to @p time."""
    times = [record[0] for record in read_times(directory)]
    return read_points(directory, int(np.argmin(np.abs(np.array(times) - time))))


def read_grid(directory, step=-1):
    """The active cells of one output of the background grid: like
    read_points(), with 'triangles' (m, 3), the vertices of the cells."""
    data = read_output(directory, "grid", step)
    data["triangles"] = data.pop("cells")
    if data["triangles"].shape[1] != 3:
        raise OutputError(f"The grid in {directory} is not of triangles.")
    return data


def read_output(directory, kind, step=-1):
    """Time, positions, cells (m, vertices of a cell) and fields of an output,
    those of all pieces together. @p kind: "grid", "points", "rigid_bodies" (its
    cells are the facets), or, of a run that has failed, "failure-grid" and
    "failure-points"."""
    records = read_times(directory, kind)
    if not -len(records) <= step < len(records):
        raise OutputError(
            f"{kind}.pvd in {directory} lists {len(records)} outputs; there "
            f"is no number {step}."
        )
    time, path = records[step]
    pieces = [piece for piece in map(_read_piece, _pieces(path)) if piece]
    if not pieces:
        raise OutputError(f"{path} holds no points.")
    if any(piece.keys() != pieces[0].keys() for piece in pieces):
        raise OutputError(f"The pieces of {path} hold different fields.")
    sizes = [len(piece["position"]) for piece in pieces]
    for piece, first in zip(pieces, np.cumsum([0] + sizes)):
        piece["cells"] = piece["cells"] + first
    data = {
        name: np.concatenate([piece[name] for piece in pieces])
        for name in pieces[0]
    }
    return {"time": time, **data}


def _pieces(path):
    """The .vtu files that @p path, a .pvtu or .vtu file, consists of."""
    if not path.is_file():
        raise OutputError(f"There is no {path}, which the .pvd file lists.")
    if path.suffix != ".pvtu":
        return [path]
    root = xml.etree.ElementTree.parse(path).getroot()
    return [path.parent / piece.get("Source") for piece in root.iter("Piece")]


def _read_piece(path):
    """Arrays of one .vtu file, {} if it is empty, as that of a process without
    material is. Pieces are read one by one, as VTK's reader of .pvtu files
    passes over a broken one."""
    if not path.is_file():
        raise OutputError(f"There is no {path}, a piece of an output.")
    errors = []
    reader = vtkXMLUnstructuredGridReader()
    reader.AddObserver("ErrorEvent", lambda *_: errors.append(path))
    reader.SetFileName(str(path))
    reader.Update()
    grid = reader.GetOutput()
    n = grid.GetNumberOfPoints()
    if errors or n != reader.GetNumberOfPoints():
        raise OutputError(f"{path} can't be read: broken or not complete.")
    if n == 0:
        return {}
    cells = vtk_to_numpy(grid.GetCells().GetConnectivityArray())
    arrays = {
        "position": vtk_to_numpy(grid.GetPoints().GetData()),
        "cells": cells.reshape(grid.GetNumberOfCells(), -1),
    }
    fields = grid.GetPointData()
    for index in range(fields.GetNumberOfArrays()):
        arrays[fields.GetArrayName(index)] = vtk_to_numpy(fields.GetArray(index))
    if any(len(array) != n for name, array in arrays.items() if name != "cells"):
        raise OutputError(f"{path}: a field has not one value per point.")
    # Copies, as VTK's memory ends with the reader; in double precision, as
    # the files hold single, in which sums over all points would lose digits.
    return {
        name: np.array(array, dtype=None if name == "cells" else float)
        for name, array in arrays.items()
    }


def field(data, name):
    """The scalar field @p name of @p data; 'displacement_x' and the like are
    components of vectors."""
    if name in data:
        return data[name]
    base, _, component = name.rpartition("_")
    if base in data and component in ("x", "y", "z"):
        return data[base][:, "xyz".index(component)]
    raise OutputError(
        f"There is no field '{name}'. There are: " + ", ".join(sorted(data))
    )


# ---------------------------------------------------------------- drawing ---


def colour_limits(values, kind="free", percentile=0.5):
    """Limits (low, high) of a colour scale for the arrays @p values, without
    the outermost @p percentile per cent on either side, so that a few points
    at a singular corner don't set the scale. @p kind as in FIELD_STYLES."""
    ranges = [np.percentile(v, [percentile, 100 - percentile]) for v in values]
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
    below = values is not None and np.min(values) < low
    above = values is not None and np.max(values) > high
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
        cmap=colour_map,
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
    triangles.set_mask(edges.max(axis=1) > allowed)
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
