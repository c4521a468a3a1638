#!/usr/bin/env python3
# Isochor: implicit, stabilised mixed Material Point Method on deal.II.
# SPDX-License-Identifier: LGPL-2.1-or-later
"""What a scene doesn't need, and what leaving it out saves.

    work.py                              # all tables
    work.py --only grid --only skipped
    work.py --baseline /path/of/another/isochor
    work.py --publish                    # also into results/work.md

All times are CPU seconds of the whole process. What is compared runs in turn, so
that a machine whose speed varies hits both; medians are shown. The time of a step
is the difference of two runs that differ in nothing but the number of steps, over
that number: start and set-up cancel. tests/skipped_work.cc shows that the results
stay what they are.
"""

import os
import shutil
import statistics as stat
import subprocess
import sys
import time
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE))

import harness  # noqa: E402
import programs  # noqa: E402
import report  # noqa: E402
from quadratures import quadratures  # noqa: E402
from resets import resets  # noqa: E402
from harness import ROOT  # noqa: E402

PRM = ROOT / "prm"
PAGE = HERE / "results" / "work.md"
COOK = PRM / "cooks_membrane" / "cooks_membrane.prm"
BLOCK = HERE / "scenes" / "block_in_grid.prm"


class Work:
    """Runs the program and keeps the numbers."""

    def __init__(self, arguments):
        self.arguments = arguments
        self.repeat = arguments.repeat
        self.directory = arguments.directory
        self.rows = []

    def once(self, prm, overrides, executable=None):
        """(CPU seconds, MB) of one run."""
        run = harness.Run("", "work", 0, prm, {**harness.QUIET, **overrides})
        cost = harness.Cost([], [])
        harness.execute(
            executable or self.arguments.executable,
            run,
            self.directory / "run",
            cost,
            self.arguments.limit,
        )
        return cost.cpu[0], cost.memory

    def compare(self, cases):
        """Medians of CPU seconds and MB for each of the @p cases, a dict of
        (prm, overrides, executable), run in turn."""
        found = {name: [] for name in cases}
        for _ in range(self.repeat):
            for name, case in cases.items():
                found[name].append(self.once(*case))
        return {
            name: tuple(stat.median(values) for values in zip(*runs))
            for name, runs in found.items()
        }

    def compare_steps(self, cases, few, many):
        """CPU seconds of a step for each of the @p cases, a dict of (prm,
        overrides), from runs of @p few and of @p many steps of the same size."""
        both = {}
        for name, (prm, overrides) in cases.items():
            for n in (few, many):
                end = overrides["Time/Step size"] * n
                both[name, n] = (prm, {**overrides, "Time/End time": end}, None)
        cost = self.compare(both)
        return {
            name: (cost[name, many][0] - cost[name, few][0]) / (many - few)
            for name in cases
        }

    def note(self, table, **numbers):
        self.rows.append({"table": table, **numbers})
        print(table, numbers, flush=True)


def milliseconds(seconds):
    return f"{1e3 * seconds:.2f}"


# -------------------------------------------------------------- the tables ---


def grid(work):
    """A block of 20 x 20 cells in a grid of 24 x 24, and of 10 to 1000 times that: what
    a step costs, and what an empty cell costs once."""
    area = (1, 10, 100, 1000)

    def overrides(factor, steps):
        columns = 24 * (10 if factor >= 100 else 1)
        rows = 24 * 24 * factor // columns
        return {
            "Grid/Upper corner": f"{columns / 20}, {rows / 20}",
            "Grid/Subdivisions": f"{columns}, {rows}",
            "Time/End time": steps * 0.01,
            "Boundary conditions/Gravity": "0, -0.5*t",
        }

    few, many = 1, 401
    cases = {
        (factor, n): (BLOCK, overrides(factor, n), None)
        for factor in area
        for n in (few, many)
    }
    cost = work.compare(cases)
    step = {
        factor: (cost[factor, many][0] - cost[factor, few][0]) / (many - few)
        for factor in area
    }
    body = []
    for factor in area:
        columns, rows = (
            int(n) for n in overrides(factor, 1)["Grid/Subdivisions"].split(",")
        )
        cells = 2 * columns * rows
        empty = cells - 2 * 20 * 20
        seconds = cost[factor, few][0] - cost[1, few][0]
        memory = cost[factor, few][1] - cost[1, few][1]
        work.note(
            "grid",
            factor=factor,
            cells=cells,
            step=step[factor],
            start=cost[factor, few][0],
            memory=cost[factor, few][1],
        )
        body.append(
            (
                factor,
                cells,
                milliseconds(step[factor]),
                f"{step[factor] / step[1]:.2f}",
                f"{cost[factor, few][0]:.2f}",
                f"{cost[factor, few][1]:.0f}",
                f"{1e6 * seconds / empty:.1f}" if factor > 1 else "",
                f"{1e6 * memory / empty:.0f}" if factor > 1 else "",
            )
        )
    return report.table(
        (
            "grid over the smallest",
            "cells",
            "a step, ms",
            "over the smallest",
            "one step and all before it, s",
            "MB",
            "µs per empty cell",
            "bytes per empty cell",
        ),
        body,
    )


def skipped(work):
    """What a step costs with each kind of work, and without it."""
    plane = {"Time/Step size": 0.01, "Grid/Subdivisions": "60, 60"}
    block = {**plane, "Grid/Upper corner": "1.2, 1.2"}
    still = {**block, "Boundary conditions/Gravity": "0, -0.1*t"}
    elastic = {"Material/Model": "J2", "Material/J2/Yield stress": 1e9}
    strong = {"Material/Model": "Mohr-Coulomb", "Material/Mohr-Coulomb/Cohesion": 1e9}
    pairs = {
        "pressures at the nodes": (
            {**block, "Formulation/Type": "u-p"},
            {**block, "Formulation/Type": "u"},
            "`Formulation/Type = u`",
        ),
        "stabilisation": (
            {**block, "Formulation/Type": "u-p"},
            {**block, "Formulation/Type": "u-p", "Formulation/PPP coefficient": 0},
            "`PPP coefficient = 0`",
        ),
        "masses and inertia": (
            {
                **block,
                "Dynamics/Inertia": "true",
                "Grid reset/Steps between resets": 1,
            },
            block,
            "quasi-static",
        ),
        "history of the points": (
            {**block, **elastic},
            block,
            "Neo-Hookean instead of a J2 law that stays elastic",
        ),
        "lower triangle of the matrix": (
            {**block, **strong, "Material/Mohr-Coulomb/Friction angle": 30},
            {**block, **strong},
            "a law with a symmetric tangent",
        ),
        "domains of the points": (
            {**block, "Quadrature/Type": "CPDI"},
            block,
            "`Quadrature/Type = points`",
        ),
        "search for the points, nodes, pattern, analysis": (
            still,
            {**still, "Grid reset/Steps between resets": 100000},
            "a grid that is not reset",
        ),
        "factorisations": (
            {**still, "Newton/Reuse factorisation": 0},
            {**still, "Newton/Reuse factorisation": 0.1},
            "one that still serves",
        ),
        "output of fields": (
            {
                **still,
                "Time/Output interval": 0,
                "Postprocess/Write grid": "true",
            },
            still,
            "no output asked for",
        ),
    }
    body = []
    for name, (with_it, without, how) in pairs.items():
        cost = work.compare_steps(
            {
                "with": (BLOCK, with_it),
                "without": (BLOCK, without),
            },
            2,
            22,
        )
        saved = 1 - cost["without"] / cost["with"]
        work.note("skipped", name=name, with_it=cost["with"], without=cost["without"])
        body.append(
            (
                name,
                how,
                milliseconds(cost["with"]),
                milliseconds(cost["without"]),
                f"{100 * saved:.0f} %",
            )
        )
    return report.table(
        ("left out", "if", "a step with it, ms", "without, ms", "saved"), body
    )


def finite_elements(work):
    """What material points cost over finite elements on the same grid: a block of
    100 x 100 cells under its weight, in a grid of 120 x 120, in steps of equal size,
    by CPU time. Factorisations are kept where they serve (the default), or each
    iteration has its own (`Newton/Reuse factorisation = 0`)."""
    kept = {"Grid reset/Steps between resets": 100000}
    fourth = {"Grid reset/Steps between resets": 4}
    cases = {
        "finite elements: never reset, 1 point per cell": ("points", 1, kept),
        "finite elements: never reset, 3 points per cell": ("points", 3, kept),
        "reset in each step, points, 1 per cell": ("points", 1, {}),
        "reset in each step, points, 3 per cell": ("points", 3, {}),
        "reset in each step, CPDI, 3 per cell": ("CPDI", 3, {}),
        "reset in every 4th step, points, 3 per cell": ("points", 3, fourth),
        "reset in every 4th step, CPDI, 3 per cell": ("CPDI", 3, fourth),
    }
    settings = {
        (name, own): {
            "Grid/Subdivisions": "120, 120",
            "Time/Step size": 0.01,
            "Quadrature/Type": quadrature,
            "Material points/Points per cell": n,
            "Newton/Reuse factorisation": 0 if own else 0.1,
            **others,
        }
        for name, (quadrature, n, others) in cases.items()
        for own in (False, True)
    }
    cost = work.compare_steps(
        {key: (BLOCK, overrides) for key, overrides in settings.items()}, 2, 10
    )
    floor = "finite elements: never reset, 3 points per cell"
    body = []
    for name in cases:
        row = [name]
        for own in (False, True):
            seconds = cost[name, own]
            work.note("finite elements", name=name, own=own, step=seconds)
            row += [
                milliseconds(seconds),
                f"{100 * (seconds / cost[floor, own] - 1):+.0f} %",
            ]
        body.append(row)
    return report.table(
        (
            "",
            "a step, ms",
            "over three points",
            "own factorisations: a step, ms",
            "over three points",
        ),
        body,
    )


def start(work):
    """What a run costs before it does anything: `isochor --help`, which is the loading
    of the libraries that Debian's deal.II is linked with, and the smallest scene, one
    step on 2 x 2 cells; run in turn."""
    smallest = {"Grid/Subdivisions": "2, 2", "Time/End time": 0.01}
    smallest.update(harness.QUIET)
    setting = [f"--set={key}={value}" for key, value in smallest.items()]
    setting.append(f"--set=Output/Directory={work.directory / 'run'}")
    programs_run = {
        "`isochor --help`": [work.arguments.executable, "--help"],
        "smallest scene": [work.arguments.executable, *setting, BLOCK],
    }
    if work.arguments.baseline:
        programs_run["smallest scene, baseline"] = [
            work.arguments.baseline,
            *setting,
            BLOCK,
        ]
    times = {name: [] for name in programs_run}
    for _ in range(3 * work.repeat):
        for name, command in programs_run.items():
            before = os.times()
            subprocess.run(command, check=True, capture_output=True)
            after = os.times()
            cpu = (
                after.children_user
                + after.children_system
                - before.children_user
                - before.children_system
            )
            elapsed = after.elapsed - before.elapsed
            times[name].append((round(cpu, 2), round(elapsed, 2)))
    for name, values in times.items():
        work.note("start", name=name, times=values)
    return report.table(
        ("run", "CPU s", "elapsed s"),
        [
            (name, *(f"{stat.median(column):.2f}" for column in zip(*values)))
            for name, values in times.items()
        ],
    )


def overhead(work):
    """The whole run over its factorisations and solutions, wall time of the
    program's own clocks: the plate (h = 0.001 m, ν = 0.33) and Cook's membrane."""
    meshes = work.directory / "meshes"
    plate = harness.mesh(
        PRM / "tension_plate" / "plate.geo", meshes / "plate.msh", h=0.001
    )
    cases = {
        "plate, h = 0.001 m, ν = 0.33": (
            PRM / "tension_plate" / "tension_plate.prm",
            {"Grid/File": plate, "Material/Poisson ratio": 0.33},
        ),
        "Cook's membrane, n = 256": (
            COOK,
            {"Grid/Subdivisions": "256, 256", "Quadrature/Type": "points"},
        ),
    }
    body = []
    for name, (prm, overrides) in cases.items():
        ratios, times = [], []
        for _ in range(max(1, work.repeat // 2)):
            cpu, _ = work.once(prm, overrides)
            phases = harness.sections(work.directory / "run")
            phases.pop("relocation", None)  # a part of the reset
            reset = phases.pop("grid reset", 0)
            whole = sum(phases.values())
            phases["grid reset"] = reset
            solving = phases["factorisation"] + phases["solution"]
            ratios.append(whole / solving)
            times.append((cpu, phases, whole))
        ratio = stat.median(ratios)
        cpu, phases, whole = times[0]
        work.note("overhead", name=name, ratio=ratio, cpu=cpu)
        body.append(
            (
                name,
                f"{cpu:.1f}",
                f"{ratio:.2f}",
                ", ".join(
                    f"{key} {100 * value / whole:.0f} %"
                    for key, value in sorted(phases.items(), key=lambda x: -x[1])
                ),
            )
        )
    return report.table(
        ("run", "CPU s", "whole over factorisations and solutions", "shares"), body
    )


def pairs(work):
    """This program over the baseline, CPU time and memory, run in turn."""
    if not work.arguments.baseline:
        return None
    meshes = work.directory / "meshes"
    foot = harness.mesh(
        PRM / "strip_footing" / "footing.geo",
        meshes / "footing.msh",
        h=0.1,
        h_edge=0.025,
    )
    plate = harness.mesh(
        PRM / "tension_plate" / "plate.geo", meshes / "plate.msh", h=0.001
    )
    old = work.arguments.baseline_prm
    cases = {
        "one step on a grid of 100 times the body": (
            BLOCK,
            BLOCK,
            {
                "Grid/Upper corner": "30, 30",
                "Grid/Subdivisions": "600, 600",
                "Time/End time": 0.01,
            },
        ),
        "Cook's membrane, n = 256, ν = 0.499": (
            COOK,
            COOK,
            {"Grid/Subdivisions": "256, 256", "Quadrature/Type": "points"},
        ),
        "column, 16 x 128 cells, CPDI": (
            PRM / "column" / "column.prm",
            old / "column" / "column.prm",
            {"Grid/Subdivisions": "16, 128", "Quadrature/Type": "CPDI"},
        ),
        "plate, h = 0.001 m": (
            PRM / "tension_plate" / "tension_plate.prm",
            old / "tension_plate" / "tension_plate.prm",
            {"Grid/File": plate, "Material/Poisson ratio": 0.33},
        ),
        "footing to w = B/2, graded grid": (
            PRM / "strip_footing" / "strip_footing.prm",
            old / "strip_footing" / "strip_footing.prm",
            {"Grid/File": foot, "Time/End time": 0.5},
        ),
        "footing to w = 2 B, graded grid": (
            PRM / "strip_footing" / "strip_footing.prm",
            old / "strip_footing" / "strip_footing.prm",
            {"Grid/File": foot, "Time/End time": 2},
        ),
    }
    rarely = {"footing to w = 2 B, graded grid"}  # minutes each
    body = []
    for name, (prm, old_prm, overrides) in cases.items():
        ours, theirs = [], []
        # the baseline takes the interval of outputs for one that is due up to t = 0.1
        overrides = {**overrides, "Postprocess/Write material points": "false"}
        for _ in range(min(2, work.repeat) if name in rarely else work.repeat):
            ours.append(work.once(prm, overrides))
            theirs.append(work.once(old_prm, overrides, work.arguments.baseline))
        ratio = stat.median(a[0] / b[0] for a, b in zip(ours, theirs))
        work.note("pairs", name=name, ratio=ratio, ours=ours, theirs=theirs)
        body.append(
            (
                name,
                f"{stat.median(a[0] for a in ours):.2f}",
                f"{stat.median(b[0] for b in theirs):.2f}",
                f"{ratio:.2f}",
                f"{ours[0][1]:.0f}",
                f"{theirs[0][1]:.0f}",
            )
        )
    return report.table(
        ("run", "CPU s", "baseline's", "ratio", "MB", "baseline's"), body
    )


TABLES = {
    table.__name__: table
    for table in (
        quadratures,
        grid,
        skipped,
        finite_elements,
        start,
        overhead,
        pairs,
        resets,
    )
}


def main():
    parser = programs.parser(__doc__, "output-work")
    parser.add_argument("--only", action="append", choices=list(TABLES))
    parser.add_argument("--baseline", help="another isochor, for the tables 'start' and 'pairs'")
    parser.add_argument(
        "--baseline-prm", type=Path, default=PRM, help="the scenes it understands"
    )
    parser.add_argument("--repeat", type=int, default=5)
    parser.add_argument("--limit", type=int, default=3600)
    arguments = programs.parse(parser)
    start = time.time()
    work = Work(arguments)
    for name in arguments.only or TABLES:
        text = TABLES[name](work)
        if text is None:
            continue
        words = " ".join(TABLES[name].__doc__.split())
        (arguments.directory / f"work_{name}.md").write_text(f"{words}\n\n{text}\n")
        harness.write_rows(arguments.directory / f"work_{name}.csv", work.rows)
        work.rows = []
        if arguments.publish:
            results = HERE / "results"
            shutil.copy(
                arguments.directory / f"work_{name}.csv", results / f"work_{name}.csv"
            )
            report.insert(PAGE, f"work {name}", f"{words}\n\n{text}")
    print(f"{(time.time() - start) / 60:.1f} minutes")
    return 0


if __name__ == "__main__":
    programs.end_with(main)
