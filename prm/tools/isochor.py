# Isochor: implicit, stabilised mixed Material Point Method on deal.II.
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Run a scene with changed parameters and read what the run has written.

    import isochor
    run = isochor.run("scene.prm", {"Material/Young modulus": 2e6}, directory="out")
    run.statistics["Time"]              one value per step
    run.points(0)["displacement_y"]     one value per material point, first output
    run.error, run.warnings             None and [] if all went well

Needs numpy, and for fields the Python package of vtk (9 or newer), on Debian
python3-numpy and python3-vtk9.
"""

import os
import re
import shutil
import subprocess
import tempfile
import threading
import time
import xml.etree.ElementTree
from collections import namedtuple
from pathlib import Path

import numpy as np

__all__ = [
    "OutputError",
    "Run",
    "Statistics",
    "Fields",
    "find_executable",
    "make_mesh",
    "run",
    "read_statistics",
    "read_times",
    "read_points",
    "read_points_at",
    "read_grid",
    "read_output",
]

# A warning of a run: its name, for `isochor --explain`, its text in one line,
# and how often it was issued.
Warning = namedtuple("Warning", "name text count")


class OutputError(RuntimeError):
    """The program failed, or what it wrote is not what this module reads."""


# ---------------------------------------------------------------- running ---


def find_executable():
    """Path of the program: $ISOCHOR, or build/isochor of this repository, or the
    one this file is installed with, or isochor on the PATH, in this order."""
    from_environment = os.environ.get("ISOCHOR")
    if from_environment:
        path = shutil.which(from_environment)
        if path is None:
            raise OutputError(
                f"The environment variable ISOCHOR is <{from_environment}>, "
                "which is not an executable program."
            )
        return path
    here = Path(__file__).resolve()
    # PREFIX/share/isochor/prm/tools/isochor.py belongs to PREFIX/bin/isochor
    places = [here.parents[2] / "build", *(p / "bin" for p in list(here.parents)[4:5])]
    for place in places:
        built = place / "isochor"
        if built.is_file() and os.access(built, os.X_OK):
            return str(built)
    path = shutil.which("isochor")
    if path is None:
        raise OutputError(
            "The program isochor was not found. Set the environment variable "
            f"ISOCHOR to its path, or build it as {places[0] / 'isochor'}, or put "
            "it on the PATH."
        )
    return path


class Run:
    """A run that has ended, or what is left of it: the files in its directory.

    directory   a Path; the log is isochor.log in it
    error       the message with which the run has ended, None if all went well
    cpu, wall   seconds of CPU of all processes, and from start to end
    memory      of the largest process (MiB)
    """

    def __init__(self, directory):
        self.directory = Path(directory)
        self.error = None
        self.cpu = self.wall = self.memory = float("nan")
        self._statistics = None

    @property
    def statistics(self):
        """See read_statistics(). Of a failed run as far as it came."""
        if self._statistics is None:
            try:
                self._statistics = read_statistics(self.directory)
            except OutputError as error:
                raise OutputError(self.error or error) from error
        return self._statistics

    @property
    def log(self):
        """What the run has printed."""
        path = self.directory / "isochor.log"
        return path.read_text(errors="replace") if path.is_file() else ""

    @property
    def warnings(self):
        """The warnings of the run, in the order in which they were issued first."""
        log, found = self.log, []
        counts = re.findall(r"^\d+ warnings?, see above: (.*)$", log, re.MULTILINE)
        for name, text in re.findall(
            r"^warning \[([^]]+)\]: (.*(?:\n  .*)*)", log, re.MULTILINE
        ):
            times = re.search(
                rf"{re.escape(name)} \((\d+) times\)", counts[-1] if counts else ""
            )
            count = int(times.group(1)) if times else 1
            found.append(Warning(name, " ".join(text.split()), count))
        return found

    def points(self, step=-1):
        """See read_points()."""
        return read_points(self.directory, step)

    def grid(self, step=-1):
        """The background grid of an output: see read_output()."""
        return read_output(self.directory, "grid", step)

    def times(self):
        """When fields were written (s): the steps of points() and grid()."""
        return np.array([record[0] for record in read_times(self.directory)])


def command_of(scene, parameters, executable, directory, ranks):
    """The words of the command that run() executes."""
    command = [str(executable or find_executable()), str(scene)]
    if ranks > 1:
        command = ["mpirun", "-np", str(ranks)] + command
    for name, value in (parameters or {}).items():
        if isinstance(value, (bool, np.bool_)):
            value = str(bool(value)).lower()
        command += ["--set", f"{name}={value}"]
    return command + ["--output-directory", str(directory)]


OUTPUTS = ("points", "subdomains", "grid", "rigid_bodies", "failure")


def remove_results(directory):
    """Delete the results of an earlier run, so that they can't be taken for those of
    the next one. Other files stay."""
    fields = [f"{kind}*.*vtu" for kind in OUTPUTS]
    for pattern in ("statistics.txt", "isochor.log", "*.pvd", *fields):
        for old in Path(directory).glob(pattern):
            old.unlink()


def run(
    scene,
    parameters=None,
    executable=None,
    directory=None,
    ranks=1,
    limit=None,
    check=False,
    keep=False,
):
    """Run the scene @p scene, a .prm file, and return a Run.

    parameters  what to change, a dict like {"Material/Poisson ratio": 0.499}; files
                among them are looked for from the working directory
    executable  None: find_executable()
    directory   for the results; those of an earlier run there are deleted, unless
                @p keep, as a run that is resumed wants. None: a temporary one, which
                ends with the Run
    ranks       with more than one the program runs under mpirun
    limit       seconds after which the run is ended
    check       raise an OutputError if the run fails, instead of the Run's error
    """
    temporary = tempfile.TemporaryDirectory() if directory is None else None
    result = Run(temporary.name if temporary else directory)
    result._temporary = temporary
    result.directory.mkdir(parents=True, exist_ok=True)
    if not keep:
        remove_results(result.directory)
    command = command_of(scene, parameters, executable, result.directory, ranks)
    environment = {"OMP_NUM_THREADS": "1", "OPENBLAS_NUM_THREADS": "1", **os.environ}
    start = time.perf_counter()
    try:
        with open(result.directory / "isochor.log", "w") as log:
            process = subprocess.Popen(
                command, stdout=log, stderr=subprocess.STDOUT, env=environment
            )
    except OSError as error:
        raise OutputError(f"Can't run {command[0]}: {error}") from error
    stopped = []
    timer = threading.Timer(
        limit or 0, lambda: (stopped.append(True), process.terminate())
    )
    if limit:
        timer.start()
    try:
        _, status, usage = os.wait4(process.pid, 0)
    except KeyboardInterrupt:
        process.terminate()
        raise
    finally:
        timer.cancel()
    process.returncode = code = os.waitstatus_to_exitcode(status)
    result.wall = time.perf_counter() - start
    result.cpu = usage.ru_utime + usage.ru_stime
    result.memory = usage.ru_maxrss / 1024
    if stopped:
        result.error = f"ended after {limit} seconds, the limit"
    elif code != 0:
        text = result.log
        _, found, message = text.rpartition("isochor: error")
        message = message.partition(": ")[2].strip() if found else ""
        result.error = message or f"code {code}: " + "\n".join(text.splitlines()[-20:])
    if check and result.error:
        raise OutputError(
            f"{result.error}\nCommand: "
            + " ".join(f"'{word}'" if " " in word else word for word in command)
            + f"\nLog: {result.directory / 'isochor.log'}"
        )
    return result


def make_mesh(geometry, mesh, dimension=2, options=(), **numbers):
    """Let gmsh mesh the file @p geometry with the @p numbers of it that are to be
    changed and further @p options, and write the file @p mesh, which is returned as a
    Path."""
    mesh = Path(mesh)
    mesh.parent.mkdir(parents=True, exist_ok=True)
    command = ["gmsh", f"-{dimension}", str(geometry), "-v", "1", "-o", str(mesh)]
    command += options
    for name, value in numbers.items():
        command += ["-setnumber", name, str(value)]
    try:
        subprocess.run(command, check=True, capture_output=True)
    except (OSError, subprocess.CalledProcessError) as error:
        raise OutputError(f"gmsh failed: {error}") from error
    return mesh


# ---------------------------------------------------------------- reading ---


class Statistics(dict):
    """Columns by name, numpy arrays with one value per step: as in the head of the
    file, "Time (s)", or without the unit, "Time". Asking for a missing one lists
    those there are."""

    def __init__(self, path):
        super().__init__()
        self.path = path

    @property
    def units(self):
        """Column name -> unit, "" for numbers without one."""
        return {name: split_unit(name)[1] for name in self}

    def __missing__(self, name):
        found = [known for known in self if split_unit(known)[0] == name]
        if len(found) == 1:
            return self[found[0]]
        raise OutputError(
            f"{self.path} has no column '{name}'. It has: "
            + ", ".join(f"'{known}'" for known in self)
        )


def split_unit(column):
    """("Time", "s") of the column "Time (s)"."""
    name, unit = re.fullmatch(r"(.*?)(?: \(([^()]*)\))?", column).groups()
    return name, unit or ""


def read_statistics(directory):
    """The Statistics of the run in @p directory, or of a file of this form. Columns
    that hold words become arrays of strings; what a row does not have is NaN."""
    path = Path(directory)
    if not path.is_file():
        path = path / "statistics.txt"
    if not path.is_file():
        raise OutputError(f"There is no {path}.")
    names, rows = [], []
    for number, line in enumerate(path.read_text().splitlines(), 1):
        if line.startswith("#"):
            index, _, name = line[1:].partition(":")
            if not index.strip().isdigit():
                continue  # a comment
            if int(index) != len(names) + 1:
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


class Fields(dict):
    """Arrays by name, one entry per point or node; 'displacement_x' and the like are
    components of vectors. Asking for a missing one lists those there are."""

    def __missing__(self, name):
        base, _, component = name.rpartition("_")
        if base in self and component in ("x", "y", "z"):
            return self[base][:, "xyz".index(component)]
        raise OutputError(
            f"There is no field '{name}'. There are: " + ", ".join(sorted(self))
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
    """The Fields of the material points of one output: 'position' (n, 3), 'time', and
    every field under its name; 'deformation_gradient' as (n, 3, 3). With CPDI also
    'corners' (n, d + 1, 3) of their subdomains, and where these were at t = 0,
    'reference'. @p step counts the outputs in points.pvd, -1 is the last."""
    data = read_output(directory, "points", step)
    del data["cells"]
    gradient = data.get("deformation_gradient")
    if gradient is not None and gradient.shape[-1] == 9:
        data["deformation_gradient"] = gradient.reshape(-1, 3, 3)
    if (Path(directory) / "subdomains.pvd").is_file():
        times = [
            [record[0] for record in read_times(directory, kind)]
            for kind in ("points", "subdomains")
        ]
        if times[0] == times[1]:
            _add_subdomains(data, read_output(directory, "subdomains", step))
    return data


def _add_subdomains(data, subdomains):
    """The corners of @p subdomains, in the order of the points in @p data."""
    cells = subdomains["cells"]
    corners = subdomains["position"][cells]
    order = np.argsort(subdomains["id"][cells[:, 0]])
    order = order[np.argsort(np.argsort(data["id"]))]
    data["corners"] = corners[order]
    data["reference"] = (corners - subdomains["displacement"][cells])[order]


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
    """The Fields of an output, with 'time', 'position' (n, 3) and 'cells' (m,
    vertices of a cell), those of all pieces together. @p kind: "grid", "points",
    "subdomains" (its cells), "rigid_bodies" (its cells are the facets), or, of a run
    that has failed, "failure-grid" and "failure-points"."""
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
    return Fields(time=time, **data)


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
    # not at the top: who reads no fields needs no vtk
    from vtkmodules.util.numpy_support import vtk_to_numpy
    from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridReader

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
