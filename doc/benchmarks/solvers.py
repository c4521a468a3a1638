#!/usr/bin/env python3
# Isochor: implicit, stabilised mixed Material Point Method on deal.II.
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Time and memory of the linear solvers over the number of equations.

    solvers.py                  # a million equations in 3D need 5 GB
    solvers.py --quick          # up to 60 000, a minute
    solvers.py --only ranks     # two ranks against one, see ranks.py
    solvers.py --publish        # also doc/benchmarks/results and doc/solvers.md

Each run is one step of u-p with PPP, ν = 0.499: in 2D Cook's membrane, P = 1, in 3D a
cube between rough plates (scenes/pressed_cube.prm). The seconds of the linear algebra
are those of the program's own clock in the phases "factorisation" and "solution" (for the
iterative solver: set-up of the preconditioner and iterations), times the part of the
elapsed time that the process had a processor, over the number of Newton iterations, each
of which has a factorisation of its own.
"""

import shutil
import sys
import time
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE))

import harness  # noqa: E402
import numpy as np  # noqa: E402
import programs  # noqa: E402
import ranks  # noqa: E402
import report  # noqa: E402
from harness import PRM, output  # noqa: E402

plt = output.plt
COOK = PRM / "cooks_membrane" / "cooks_membrane.prm"
CUBE = HERE / "scenes" / "pressed_cube.prm"
SOLVERS = ("MUMPS", "Block FGMRES")
# boxes per side, the largest with the direct solver
SIZES = {"2D": ((64, 128, 256, 512), 512), "3D": ((8, 12, 16, 20, 24, 32, 48, 63), 24)}
LARGEST_QUICK = 60e3  # equations


def equations_of(dimension, n):
    """About so many."""
    return 3 * n**2 if dimension == "2D" else 4 * n**3


def measure(arguments, dimension, solver, n):
    """A row of the table; the run with the least CPU time of all repetitions."""
    boxes = ", ".join([str(n)] * int(dimension[0]))
    overrides = {
        **harness.QUIET,
        "Postprocess/Write material points": "false",
        "Grid/Subdivisions": boxes,
        "Linear solver/Solver": solver,
        "Newton/Reuse factorisation": 0,
        "Time/Step size": 1,
    }
    if dimension == "2D":
        overrides.update({"Material/Poisson ratio": 0.499, "Quadrature/Type": "points"})
    run = harness.Run(
        dimension, solver, n, COOK if dimension == "2D" else CUBE, overrides
    )
    place = arguments.directory / "run"
    rows = []
    for _ in range(arguments.repeat if equations_of(dimension, n) < 2e5 else 1):
        cost = harness.Cost([], [])
        harness.execute(arguments.executable, run, place, cost, 3600)
        numbers = output.read_statistics(place)
        phases = harness.sections(place)
        iterations = int(numbers["Newton iterations"][-1])
        linear = phases.get("factorisation", 0) + phases["solution"]
        rows.append(
            {
                "dimension": dimension,
                "solver": solver,
                "n": n,
                "equations": int(numbers["Equations"][-1]),
                "newton": iterations,
                "outer": int(numbers.get("Linear iterations", [0])[-1]),
                "linear": linear * cost.cpu[0] / cost.wall[0] / iterations,
                "cpu": cost.cpu[0],
                "memory": cost.memory,
            }
        )
    best = min(rows, key=lambda row: row["cpu"])
    print(best, flush=True)
    return best


def exponent(rows, what):
    """Of growth with the equations, by the larger half of the runs."""
    rows = rows[len(rows) // 2 :]
    if len(rows) < 2:
        return float("nan")
    return np.polyfit(
        np.log([row["equations"] for row in rows]),
        np.log([row[what] for row in rows]),
        1,
    )[0]


def selected(rows, dimension, solver):
    return [
        row for row in rows if (row["dimension"], row["solver"]) == (dimension, solver)
    ]


def crossover(rows, dimension):
    """The equations from which on the iterative solver's step is the shorter one, in
    words."""
    direct, iterative = (
        {row["n"]: row for row in selected(rows, dimension, solver)}
        for solver in SOLVERS
    )
    both = [n for n in direct if n in iterative]
    shorter = [n for n in both if iterative[n]["linear"] < direct[n]["linear"]]
    if not shorter:
        most = max(direct[n]["equations"] for n in both)
        return f"in {dimension} nowhere up to {most} equations"
    first = min(shorter)
    before = [direct[n]["equations"] for n in both if n < first]
    least = f"somewhere between {max(before)} and " if before else "below "
    return f"in {dimension} from {least}{direct[first]['equations']} equations on"


def table(rows):
    body = []
    for dimension in SIZES:
        for n in SIZES[dimension][0]:
            cells = []
            for solver in SOLVERS:
                row = next(
                    (r for r in selected(rows, dimension, solver) if r["n"] == n), None
                )
                if row is None:
                    cells += ["", "", ""]
                    continue
                cells += [
                    f"{row['linear']:.3g}",
                    f"{row['cpu']:.3g}",
                    f"{row['memory']:.0f}",
                ]
                equations, newton = row["equations"], row["newton"]
                outer = row["outer"]
            if any(cells):
                body.append(
                    (dimension, equations, *cells, f"{outer} ({newton})")
                )
    head = ("", "equations")
    for solver in SOLVERS:
        head += (f"{solver}: s per iteration", "run, CPU s", "MB")
    text = report.table((*head, "outer iterations (Newton's)"), body)
    growth = []
    for dimension in SIZES:
        for solver in SOLVERS:
            found = selected(rows, dimension, solver)
            if len(found) > 2:
                growth.append(
                    f"{dimension} {solver} n^{exponent(found, 'linear'):.2f} in time, "
                    f"n^{exponent(found, 'memory'):.2f} in memory"
                )
    text += "\n\nGrowth with the number n of equations, by the larger half of the runs: "
    text += "; ".join(growth) + ".\n\nThe iterative solver is the faster one "
    text += ", ".join(crossover(rows, dimension) for dimension in SIZES)
    return text + ".\n\n![time and memory](benchmarks/results/solvers.png)"


def draw(rows, path):
    figure, axes = plt.subplots(1, 2, figsize=(9, 3.8), constrained_layout=True)
    for axis, what, label in zip(
        axes,
        ("linear", "memory"),
        ("linear algebra of a Newton iteration, s", "memory of the run, MB"),
    ):
        for dimension, style in (("2D", "--"), ("3D", "-")):
            for solver, colour in zip(SOLVERS, ("C3", "C0")):
                found = selected(rows, dimension, solver)
                axis.loglog(
                    [row["equations"] for row in found],
                    [row[what] for row in found],
                    style,
                    marker="o",
                    ms=4,
                    color=colour,
                    label=f"{dimension}, {solver}",
                )
        axis.set(xlabel="equations", ylabel=label)
        axis.grid(True, which="major", color="0.9")
    axes[0].legend(fontsize=8)
    programs.save(figure, path)


def compare_solvers(arguments):
    rows = []
    for dimension, (sizes, largest_direct) in SIZES.items():
        for n in sizes:
            if arguments.quick and equations_of(dimension, n) > LARGEST_QUICK:
                continue
            for solver in SOLVERS:
                if solver != "MUMPS" or n <= largest_direct:
                    rows.append(measure(arguments, dimension, solver, n))
    draw(rows, arguments.directory / "solvers")
    finish(arguments, "solvers", rows, table(rows), ("png", "svg"))


def compare_ranks(arguments):
    rows, text = ranks.run_all(arguments)
    finish(arguments, "ranks", rows, text)


def finish(arguments, name, rows, text, pictures=()):
    """Write table and text, to the documentation, too, if asked."""
    harness.write_rows(arguments.directory / f"{name}.csv", rows)
    (arguments.directory / f"{name}.md").write_text(text + "\n")
    if arguments.publish:
        for suffix in ("csv", *pictures):
            file = f"{name}.{suffix}"
            shutil.copy(arguments.directory / file, HERE / "results" / file)
        report.insert(HERE.parent / "solvers.md", f"benchmark {name}", text)


def main():
    parser = programs.parser(__doc__, "output-solvers")
    parser.add_argument("--quick", action="store_true")
    parser.add_argument("--repeat", type=int, default=3)
    parser.add_argument("--only", choices=("solvers", "ranks"))
    arguments = programs.parse(parser)
    start = time.time()
    if arguments.only != "ranks":
        compare_solvers(arguments)
    if arguments.only != "solvers":
        compare_ranks(arguments)
    print(f"{(time.time() - start) / 60:.1f} minutes")
    return 0


if __name__ == "__main__":
    programs.end_with(main)
