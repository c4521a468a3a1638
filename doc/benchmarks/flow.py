#!/usr/bin/env python3
# Isochor: implicit, stabilised mixed Material Point Method on deal.II.
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Large plastic flow with all defaults: run the scenes, print a table.

    flow.py [--executable isochor] [--directory flow] [--quick] [scene ...]

Needs nothing but gmsh and the program. For each run: what was found beside what is
right, the spread of det F of the points (the shapes of their domains), iterations of
Newton's method per step, steps that were cut, CPU seconds.
"""

import argparse
import resource
import subprocess
import sys
from dataclasses import dataclass
from pathlib import Path

HERE = Path(__file__).resolve().parent
SCENES = HERE / "scenes"
ROOT = HERE.parents[1]


@dataclass(frozen=True)
class Flow:
    """A run: @p measures are tuples of what is measured, a function of the columns
    of the statistics (lists of numbers by name), and what is right. @p mesh: name of
    a .geo and its numbers. Not in a quick suite: @p full."""

    name: str
    scene: Path
    measures: tuple
    overrides: tuple = ()
    mesh: tuple = ()
    full: bool = False


def last(column, factor=1, offset=0):
    return lambda columns: offset + factor * columns[column][-1]


def at(time, column, factor=1):
    def value(columns):
        times = columns["Time (s)"]
        k = min(range(len(times)), key=lambda i: abs(times[i] - time))
        return factor * columns[column][k]

    return value


def mean_after(time, column, factor):
    def value(columns):
        values = [
            abs(v)
            for t, v in zip(columns["Time (s)"], columns[column])
            if t > time
        ]
        return factor * sum(values) / len(values) if values else float("nan")

    return value


def necking(n, steps, full):
    return Flow(
        f"necking, {n} cells over the radius, {steps} steps",
        SCENES / "necking.prm",
        (
            ("u_r of the neck at 3.5 mm (mm)",
             at(0.5, "Displacement x of neck (m)"), "-0.87"),
            ("at 7 mm", last("Displacement x of neck (m)"), "-3.87 (grid never reset)"),
            ("force (kN)", last("Reaction y on bottom (N)", -1e-3), "26.8 (the same)"),
        ),
        (f"Time/Step size={1 / steps}",),
        ("necking", f"n {n}"),
        full,
    )


FLOWS = (
    necking(10, 100, False),
    necking(10, 25, True),
    necking(10, 400, True),
    necking(20, 100, True),
    Flow(
        "Taylor bar, 8 cells over the radius",
        SCENES / "taylor_bar.prm",
        (
            ("length (mm)",
             last("Displacement y of head (m)", 1e3, 32.4), "21.2 to 21.7"),
            ("radius (mm)",
             last("Displacement x of foot (m)", 1e3, 3.2), "6.9 to 7.2"),
            ("energy lost (J)", last("Energy lost by the scheme (J)"), "240 J in all"),
        ),
    ),
    Flow(
        "slump, CPDI",
        SCENES / "slump.prm",
        (("crest (m)", last("Displacement y of crest (m)"), "no reference"),),
        full=True,
    ),
    Flow(
        "slump, cell-filled",
        SCENES / "slump.prm",
        (("crest (m)", last("Displacement y of crest (m)"), "no reference"),),
        ("Quadrature/Type=cell-filled",),
    ),
    Flow(
        "extrusion, 8 cells on the die",
        SCENES / "extrusion.prm",
        (
            ("force / slip lines', mean of t > 0.2",
             mean_after(0.2, "Reaction x on die (N)", 1 / 257.1), "1"),
        ),
        mesh=("extrusion", "n 16"),
        full=True,
    ),
    Flow(
        "rigid footing to w/B = 0.5",
        ROOT / "prm/footing_rigid/footing_rigid.prm",
        (("q/c_u", last("Force y on body by footing (N)", -2e-3), "5.94 (finite elements)"),),
        ("Time/End time=0.5",),
        full=True,
    ),
    Flow(
        "ring to half of its height",
        ROOT / "prm/ring_compression/ring_compression.prm",
        (("force (N)", last("Reaction y on bottom (N)"), "no reference"),),
        ("Time/End time=0.5",),
        full=True,
    ),
)


def columns_of(directory):
    """The statistics: lists of numbers by name."""
    names, rows = [], []
    for line in (directory / "statistics.txt").read_text().splitlines():
        if line.startswith("#"):
            names.append(line[1:].partition(":")[2].strip())
        elif line.strip():
            rows.append(line.split())
    columns = {}
    for i, name in enumerate(names):
        try:
            columns[name] = [float(row[i]) for row in rows]
        except ValueError:
            pass  # words
    return columns


def execute(flow, arguments):
    """CPU seconds and the statistics; how it ended, empty if well."""
    place = arguments.directory / "".join(
        c if c.isalnum() else "_" for c in flow.name
    )
    place.mkdir(parents=True, exist_ok=True)
    (place / "statistics.txt").unlink(missing_ok=True)
    overrides = list(flow.overrides) + [
        "Postprocess/Write grid=false",
        "Postprocess/Write material points=false",
        "Output/Terminal=quiet",
    ]
    if flow.mesh:
        geometry, numbers = flow.mesh
        mesh = place / (geometry + ".msh")
        subprocess.run(
            ["gmsh", "-2", str(SCENES / (geometry + ".geo")), "-v", "1",
             "-setnumber", *numbers.split(), "-o", str(mesh)],
            check=True,
        )
        overrides.append(f"Grid/File={mesh}")
    command = [arguments.executable, str(flow.scene), "--output-directory", str(place)]
    for override in overrides:
        command += ["--set", override]
    before = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime
    with open(place / "isochor.log", "w") as log:
        code = subprocess.run(command, stdout=log, stderr=subprocess.STDOUT).returncode
    cpu = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime - before
    return cpu, columns_of(place), code


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--executable", default="isochor")
    parser.add_argument("--directory", type=Path, default=Path("flow"))
    parser.add_argument("--quick", action="store_true", help="without the long ones")
    parser.add_argument("scenes", nargs="*", help="beginnings of their names")
    arguments = parser.parse_args()
    print("| scene | measured | right | det F | Newton | cuts | CPU, s |")
    print("|---|---|---|---|---|---|---|")
    failed = False
    for flow in FLOWS:
        if arguments.quick and flow.full:
            continue
        if arguments.scenes and not flow.name.startswith(tuple(arguments.scenes)):
            continue
        cpu, columns, code = execute(flow, arguments)
        failed = failed or code != 0
        ends = columns["Time (s)"][-1]
        found = "; ".join(
            f"{what}: {measure(columns):.4g}" for what, measure, _ in flow.measures
        )
        if code != 0:
            found += f" (ends with an error at t = {ends:.3g})"
        right = "; ".join(value for _, _, value in flow.measures)
        iterations = columns["Newton iterations"]
        print(
            f"| {flow.name} | {found} | {right} "
            f"| {columns['Smallest J'][-1]:.2f} to {columns['Largest J'][-1]:.2f} "
            f"| {sum(iterations) / len(iterations):.1f} "
            f"| {columns['Step cuts'][-1]:.0f} | {cpu:.0f} |",
            flush=True,
        )
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
