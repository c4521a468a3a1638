# Isochor: implicit, stabilised mixed Material Point Method on deal.II.
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Two ranks against one: the table of solvers.py about them.

Two scenes of five steps: the cube of scenes/pressed_cube.prm, whose grid is not reset, and that
of scenes/pressed_in_box.prm, whose grid is reset in each step. One rank and two run in
turn. Ranks that wait for each other keep their processors, so that what each of them
does is measured apart from MPI (mpi_waits.c): the processor time of the one that does
most. That can be had on a machine with other work to do, too; the elapsed time of the
run can't. Of all repetitions each phase has the least time.
"""

import os
import subprocess
from dataclasses import replace
from pathlib import Path

import harness
import report
from harness import output

HERE = Path(__file__).resolve().parent
RANKS = (1, 2)
BOXES, BOXES_QUICK = 32, 12
BOXES_OF_A_MILLION = 63
# rows of the table: the sections of the program that they have
PHASES = {
    "assembly": ("assembly",),
    "convective phase": ("convective phase",),
    "relocation": ("relocation", "division among ranks"),
    "weights, nodes, pattern": ("grid reset", "initialisation phase"),
    "set-up of the preconditioner": ("factorisation",),
    "iterations": ("solution",),
    "start (loader, grid, points)": ("outside of all", "setup"),
}


def kept(n):
    return harness.Run(
        "ranks",
        "kept",
        n,
        HERE / "scenes" / "pressed_cube.prm",
        {
            "Grid/Subdivisions": ", ".join([str(n)] * 3),
            "Grid reset/Steps between resets": 0,
            "Time/Step size": 0.2,
            "Linear solver/Solver": "Block FGMRES",
        },
    )


def put_back(n):
    wide = n + 2 * round(n / 8)
    return harness.Run(
        "ranks",
        "reset",
        n,
        HERE / "scenes" / "pressed_in_box.prm",
        {
            "Grid/Subdivisions": f"{wide}, {n}, {wide}",
            "Linear solver/Solver": "Block FGMRES",
        },
    )


def compile_waits(directory):
    """The library that tells work from waiting."""
    library = directory / "mpi_waits.so"
    command = ["mpicc", "-O2", "-shared", "-fPIC", HERE / "mpi_waits.c"]
    try:
        subprocess.run([*command, "-o", library, "-ldl"], check=True)
    except (OSError, subprocess.CalledProcessError) as error:
        raise output.OutputError(f"mpicc failed: {error}") from error
    return library


def work_of(directory, n_ranks):
    """{row of the table: seconds of the rank with most of it}, and of the run."""
    by_rank = []
    for rank in range(n_ranks):
        sections = {}
        for line in (directory / f"waits.{rank}").read_text().splitlines():
            work, _, name = line.split(maxsplit=2)
            sections[name] = float(work)
        by_rank.append(sections)
    rows = {
        row: max(sum(s.get(name, 0.0) for name in names) for s in by_rank)
        for row, names in PHASES.items()
    }
    rows["the whole run"] = max(sum(s.values()) for s in by_rank)
    return rows


def measure(arguments, run, n_ranks):
    """The work of one run by phase, and what else is said about it."""
    run = harness.Run(
        run.problem,
        run.series,
        run.size,
        run.prm,
        {**harness.QUIET, "Postprocess/Write material points": "false", **run.overrides},
        processes=n_ranks,
    )
    place = arguments.directory / "run"
    library = compile_waits(arguments.directory)
    cost = harness.Cost([], [])
    # the program alone, not mpirun
    executable = arguments.directory / "isochor-with-waits"
    executable.write_text(
        f'#!/bin/sh\nMPI_WAITS="{place}/waits" LD_PRELOAD="{library}" '
        f'exec "{arguments.executable}" "$@"\n'
    )
    os.chmod(executable, 0o755)
    harness.execute(str(executable), run, place, cost, 7200)
    numbers = output.read_statistics(place)
    work = work_of(place, n_ranks)
    about = {
        "scene": run.series,
        "ranks": n_ranks,
        "equations": int(numbers["Equations"][0]),
        "newton": int(sum(numbers["Newton iterations"])),
        "outer": int(sum(numbers["Linear iterations"])),
        "memory": cost.memory,
        "elapsed": cost.wall[0],
        "load": os.getloadavg()[0],
    }
    print(about, work, flush=True)
    return work, about


def compare(arguments, run, repeat):
    """{number of ranks: (least work by phase, what is said about the run)}."""
    best = {}
    for _ in range(repeat):
        for n_ranks in RANKS:
            work, about = measure(arguments, run, n_ranks)
            if n_ranks in best:
                earlier, other = best[n_ranks]
                work = {k: min(v, earlier[k]) for k, v in work.items()}
                about["memory"] = max(about["memory"], other["memory"])
                for key in ("elapsed", "load"):
                    about[key] = min(about[key], other[key])
            best[n_ranks] = (work, about)
    return best


def run_all(arguments):
    """The rows of ranks.csv and the text for doc/solvers.md."""
    n = BOXES_QUICK if arguments.quick else BOXES
    repeat = 1 if arguments.quick else arguments.repeat
    runs = {"scenes": (kept(n), put_back(n)), "million": ()}
    if not arguments.quick:
        million = kept(BOXES_OF_A_MILLION)
        million.overrides["Time/Step size"] = 1
        # nothing is kept for a later step, as in the other table
        del million.overrides["Grid reset/Steps between resets"]
        runs["million"] = (million,)
    scenes = {run.series: compare(arguments, run, repeat) for run in runs["scenes"]}
    text = table(scenes)
    compared = list(scenes.values())
    for run in runs["million"]:
        compared.append(compare(arguments, replace(run, series="a million"), 1))
        text += "\n\n" + sentence(compared[-1])
    rows = [{**about, **work} for pair in compared for work, about in pair.values()]
    return rows, text


def table(scenes):
    head = [""]
    for name in scenes:
        head += [f"{name}: one rank", "two", "ratio"]
    pairs = list(scenes.values())
    body = []
    for phase in pairs[0][1][0]:
        cells = [phase]
        for pair in pairs:
            one, two = (pair[n][0][phase] for n in RANKS)
            cells += [f"{one:.2f}", f"{two:.2f}", f"{one / max(two, 1e-9):.2f}"]
        body.append(cells)
    others_work = any(
        pair[n][1]["load"] > os.cpu_count() + 1 for pair in pairs for n in RANKS
    )
    for label, key, form in (
        *(() if others_work else (("elapsed", "elapsed", "{:.1f}"),)),
        ("load of the machine", "load", "{:.0f}"),
        ("Newton iterations", "newton", "{}"),
        ("outer iterations", "outer", "{}"),
        ("largest process, MB", "memory", "{:.0f}"),
    ):
        cells = [label]
        for pair in pairs:
            cells += [form.format(pair[n][1][key]) for n in RANKS] + [""]
        body.append(cells)
    equations = pairs[0][1][1]["equations"]
    return f"{equations} equations in the first step; seconds:\n\n" + report.table(
        head, body
    )


def sentence(pair):
    parts = []
    for n_ranks in RANKS:
        work, about = pair[n_ranks]
        linear = work["set-up of the preconditioner"] + work["iterations"]
        parts.append(
            f"{linear / about['newton']:.2f} s on {n_ranks} rank{'s' * (n_ranks > 1)} "
            f"(the run {work['the whole run']:.0f} s, the largest process "
            f"{about['memory']:.0f} MB)"
        )
    return (
        f"The linear algebra of a Newton iteration at {pair[1][1]['equations']} "
        "equations, the same cube in one step: " + ", ".join(parts) + "."
    )
