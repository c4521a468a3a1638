# Isochor: implicit, stabilised mixed Material Point Method on deal.II.
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Run scenes over their choices, measure error and cost, and say what pays.

A *problem* is a question with a known answer, as the tip displacement of Cook's
membrane at a given Poisson ratio. A *series* is one way to answer it (a
formulation, a quadrature, a kind of grid, ...), run at several *sizes*. The
errors of a run are relative and have a sign; their names end with the kind of
quantity, as "u_y(A), displacement".
"""

import csv
import importlib.util
import re
import statistics as stat
import sys
from dataclasses import dataclass, field, replace
from itertools import product
from pathlib import Path

HERE = Path(__file__).resolve().parent
ROOT = HERE.parents[1]
sys.path.insert(0, str(ROOT / "prm" / "tools"))

import isochor_output as output  # noqa: E402
import numpy as np  # noqa: E402

PRM = ROOT / "prm"
# of scenes of which only the statistics are wanted
QUIET = {
    "Postprocess/Write grid": "false",
    "Postprocess/Write material points": "false",
    "Time/Output interval": 1e9,
}

TOLERANCES = (0.1, 0.03, 0.01, 0.003, 0.001)


def shortened(problem, length=150):
    """The beginning of what a failed run said, without the names of files."""
    text = re.sub(r"<?/[^\s>]+>?", "...", " ".join(str(problem).split()))
    return text[:length]


@dataclass(frozen=True)
class Run:
    """One run of the program. @p full: not in a quick benchmark. With @p places, more
    overrides each, it is made once with each of them: their mean is the result, and
    their spread its error bar."""

    problem: str
    series: str
    size: int
    prm: Path
    overrides: dict = field(default_factory=dict)
    full: bool = False
    processes: int = 1
    places: tuple = ()

    @property
    def name(self):
        text = f"{self.problem}-{self.series}-{self.size}"
        return re.sub(r"[^A-Za-z0-9.=+]+", "_", text)


@dataclass
class Cost:
    """CPU and wall seconds of each repetition, and the largest memory (MB)."""

    cpu: list
    wall: list
    memory: float = 0.0


class Scene:
    """What the benchmarks know about a scene; see scenes.py."""

    name = ""
    title = ""
    # what the size counts, for the tables
    size_label = "cells"

    def prepare(self, directory, quick):
        """Make meshes and the like in @p directory."""

    def runs(self, directory):
        """All runs, in the order in which they are made."""
        raise NotImplementedError

    def errors(self, run, directory):
        """{quantity: relative error} of the run that wrote @p directory."""
        raise NotImplementedError

    def anchors(self):
        """What others have measured or stated for the same scene, a list of
        Anchor."""
        return []


@dataclass(frozen=True)
class Anchor:
    """A result of somebody else, with its @p source, to draw beside ours. The
    cost is None where it isn't known."""

    problem: str
    quantity: str
    label: str
    source: str
    size: int
    error: float
    equations: int
    cpu: float = None


# ----------------------------------------------------------- preparations ---


def load(path):
    """The Python module in the file @p path, which is on no search path."""
    specification = importlib.util.spec_from_file_location(path.stem, path)
    module = importlib.util.module_from_spec(specification)
    specification.loader.exec_module(module)
    return module


def mesh(geo, path, **numbers):
    """Let gmsh mesh @p geo in 2D, unless @p path is there already."""
    return path if path.exists() else output.make_mesh(geo, path, **numbers)


def places(count):
    """Overrides that put a box of the grid at @p count places below a body: in cells,
    evenly along x, along y by the golden section."""
    return tuple(
        {
            "Grid/Offset": f"{(k + 0.5) / count - 0.5:.4f}, "
            f"{(0.618 * k + 0.3) % 1 - 0.5:.3f}"
        }
        for k in range(count)
    )


# ------------------------------------------------------------- measuring ---


def execute(executable, run, directory, cost, limit, keep=False):
    """Run once; adds to @p cost, raises OutputError. CPU time is what the system counts
    for the processes, loading and initialisation included."""
    done = output.run(
        run.prm,
        {"Output/Terminal": "verbose", **run.overrides},
        executable,
        directory,
        run.processes,
        limit,
        keep=keep,
    )
    cost.wall.append(done.wall)
    cost.cpu.append(done.cpu)
    cost.memory = max(cost.memory, done.memory)
    if done.error:
        raise output.OutputError(done.error)


def sections(directory):
    """{name of a phase: wall seconds} from the table that ends a run."""
    text = output.Run(directory).log
    pattern = r"^\| ([a-z][a-z -]*?) +\| +\d+ \| +([0-9.e+-]+)s \|"
    return {
        name: float(seconds)
        for name, seconds in re.findall(pattern, text, re.MULTILINE)
    }


def warnings_of(directory):
    """The number of warnings of a run."""
    return len(output.Run(directory).warnings)


def measure(executable, baseline, scene, run, directory, repeat, limit):
    """One row of the scene's table: what was run, errors and cost. With a
    @p baseline, another executable, each repetition runs both in turn."""
    row = {
        "problem": run.problem,
        "series": run.series,
        "size": run.size,
        "status": "ok",
    }
    cost, other = Cost([], []), Cost([], [])
    place = directory / run.name
    errors = {}
    try:
        for _, at in product(range(repeat), run.places or ({},)):
            there = replace(run, overrides={**run.overrides, **at})
            execute(executable, there, place, cost, limit)
            for quantity, error in scene.errors(run, place).items():
                errors.setdefault(quantity, []).append(error)
            if baseline:
                execute(baseline, there, directory / "baseline", other, limit)
        numbers = output.read_statistics(place)
        row["equations"] = int(max(numbers["Equations"]))
        row["points"] = int(max(numbers["Number of material points"]))
        row["steps"] = len(numbers["Step"])
        row["iterations"] = int(sum(numbers["Newton iterations"]))
        row["factorisations"] = int(sum(numbers["Factorisations"]))
        row["cuts"] = int(sum(numbers["Step cuts"]))
        row["warnings"] = warnings_of(place)
        for quantity, found in errors.items():
            row[f"error {quantity}"] = stat.fmean(found)
            if run.places:
                row[f"spread {quantity}"] = stat.pstdev(found)
        for section, seconds in sections(place).items():
            row[f"time {section}"] = seconds
    except (output.OutputError, OSError, ValueError) as problem:
        row["status"] = "failed: " + shortened(problem, 300)
    if cost.cpu:
        row["cpu"] = round(stat.median(cost.cpu), 4)
        row["cpu min"] = round(min(cost.cpu), 4)
        row["cpu max"] = round(max(cost.cpu), 4)
        row["wall"] = round(stat.median(cost.wall), 4)
        row["memory"] = round(cost.memory, 1)
    if baseline and other.cpu and len(other.cpu) == len(cost.cpu):
        ratios = [a / b for a, b in zip(cost.cpu, other.cpu)]
        row["cpu over baseline"] = round(stat.median(ratios), 4)
    return row


def write_rows(path, rows):
    columns = list(dict.fromkeys(key for row in rows for key in row))
    with open(path, "w", newline="") as stream:
        writer = csv.DictWriter(stream, columns, lineterminator="\n")
        writer.writeheader()
        for row in rows:
            writer.writerow(
                {
                    key: f"{value:.6g}" if isinstance(value, float) else value
                    for key, value in row.items()
                }
            )


def read_rows(path):
    """What write_rows() wrote; numbers are floats, empty entries left out."""
    rows = []
    with open(path, newline="") as stream:
        for entry in csv.DictReader(stream):
            row = {}
            for key, text in entry.items():
                if text == "":
                    continue
                try:
                    row[key] = float(text)
                except ValueError:
                    row[key] = text
            rows.append(row)
    return rows


# -------------------------------------------------------------- choosing ---


def quantities(rows):
    return list(
        dict.fromkeys(
            key[len("error ") :]
            for row in rows
            for key in row
            if key.startswith("error ")
        )
    )


def reliable_error(rows, row, quantity):
    """The error of @p row that can be relied on: the largest one of its series
    at this and at finer sizes, so that a curve that crosses the exact value
    by chance gains nothing. Where the grid was moved, that is the root mean square
    over its places. None if there is none."""
    key = f"error {quantity}"
    finer = [
        np.hypot(other[key], other.get(f"spread {quantity}", 0))
        for other in rows
        if other.get("problem") == row["problem"]
        and other.get("series") == row["series"]
        and other["size"] >= row["size"]
        and key in other
    ]
    return max(finer) if key in row and finer else None


def pareto_front(points):
    """Those (cost, error, ...) of which none other is cheaper and better."""
    front = []
    for point in sorted(points):
        if not front or point[1] < front[-1][1]:
            front.append(point)
    return front


def front_of(rows, problem, quantity):
    """Pareto front of a problem: a list of (cpu, error, row)."""
    points = []
    for number, row in enumerate(rows):
        if row["problem"] == problem and "cpu" in row:
            error = reliable_error(rows, row, quantity)
            if error is not None and error > 0:
                points.append((row["cpu"], error, number))
    return [(c, e, rows[k]) for c, e, k in pareto_front(points)]


def cheapest(rows, problem, quantity, tolerance):
    """The row that reaches @p tolerance in the least CPU time, or None."""
    for _, error, row in front_of(rows, problem, quantity):
        if error <= tolerance:
            return row
    return None


def observed_order(rows, problem, series, quantity):
    """Order of the error in 1/size between the two finest runs of a series
    whose error keeps its sign, else None."""
    key = f"error {quantity}"
    points = sorted(
        (row["size"], row[key])
        for row in rows
        if row["problem"] == problem and row["series"] == series and key in row
    )
    if len(points) < 2 or points[-1][1] * points[-2][1] <= 0:
        return None
    (n, e), (m, f) = points[-2:]
    return float(np.log(e / f) / np.log(m / n))
