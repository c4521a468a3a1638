#!/usr/bin/env python3
# Isochor: implicit, stabilised mixed Material Point Method on deal.II.
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Cook's membrane on adaptive and on uniform grids: the error of the tip's
displacement over the number of equations.

Prints both series with the order in equations, and writes convergence.png and
grid.png.
"""

import argparse
import json
import sys
from pathlib import Path

SCENE = Path(__file__).resolve().parent
COOK = SCENE.parent / "cooks_membrane"
sys.path.insert(0, str(SCENE.parent / "tools"))

import isochor_output as output  # noqa: E402
import matplotlib.pyplot as plt  # noqa: E402
import numpy as np  # noqa: E402

COLUMN = "Displacement y of A (m)"


def reference(poisson_ratio):
    """The converged displacement of the tip, an independent solution."""
    with open(COOK / "reference.json") as stream:
        values = json.load(stream)["converged"]["values"]
    return next(v["u_y"] for v in values if v["poisson_ratio"] == poisson_ratio)


def run(arguments, scene, overrides, name):
    """Run a scene; its last row of statistics and the seconds it took."""
    overrides = {"Material/Poisson ratio": arguments.poisson_ratio, **overrides}
    done = output.run(
        scene,
        overrides,
        arguments.executable,
        arguments.output_directory / name,
        arguments.processes,
        check=True,
    )
    row = {key: column[-1] for key, column in done.statistics.items()}
    return row, done.wall, done.directory


def print_series(title, rows, exact):
    """Equations, error, order in equations."""
    print(f"\n{title}")
    print("  equations      u_y(A)     error   order   seconds   estimated")
    previous = None
    for row, seconds, _ in rows:
        n, error = row["Equations"], row[COLUMN] / exact - 1
        order = (
            f"{-np.log(error / previous[1]) / np.log(n / previous[0]):7.2f}"
            if previous
            else "       "
        )
        estimate = row.get("Estimated relative error of stresses", np.nan)
        print(
            f"{n:11.0f}  {row[COLUMN]:10.7f}  {error:+8.3%} {order}"
            f"  {seconds:8.1f}   {estimate:9.4f}"
        )
        previous = n, error


def draw(adaptive, uniform, exact, path):
    """Error over equations."""
    figure, axes = plt.subplots(figsize=(5, 3.6))
    for rows, label, colour in (
        (uniform, "uniform", output.LINE_COLOURS[1]),
        (adaptive, "adaptive", output.LINE_COLOURS[0]),
    ):
        axes.loglog(
            [row["Equations"] for row, _, _ in rows],
            [100 * abs(row[COLUMN] / exact - 1) for row, _, _ in rows],
            "o-",
            color=colour,
            label=label,
        )
    axes.set_xlabel("equations")
    axes.set_ylabel("error of the tip's displacement in %")
    axes.legend()
    output.save(figure, path)


def draw_grid(directory, path):
    """The cells of the last grid."""
    grid = output.read_grid(directory)
    figure, axes = plt.subplots(figsize=(5, 5))
    axes.triplot(
        grid["position"][:, 0],
        grid["position"][:, 1],
        grid["triangles"],
        color="#303030",
        linewidth=0.25,
    )
    axes.set_aspect("equal")
    axes.set_axis_off()
    output.save(figure, path)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--executable", default=None)
    parser.add_argument("--output-directory", type=Path, default=Path("output"))
    parser.add_argument("--processes", type=int, default=1)
    parser.add_argument("--poisson-ratio", type=float, default=0.499)
    parser.add_argument(
        "--targets", type=float, nargs="+", default=[0.16, 0.08, 0.04, 0.02]
    )
    parser.add_argument("--uniform", type=int, nargs="+", default=[16, 32, 64, 128])
    arguments = parser.parse_args()
    if arguments.executable is None:
        arguments.executable = output.find_executable()

    exact = reference(arguments.poisson_ratio)
    adaptive = [
        run(
            arguments,
            SCENE / "cook_adaptive.prm",
            {"Adaptive grid/Target of relative error": target},
            f"adaptive-{target}",
        )
        for target in arguments.targets
    ]
    uniform = [
        run(
            arguments,
            COOK / "cooks_membrane.prm",
            {"Grid/Subdivisions": f"{n}, {n}"},
            f"uniform-{n}",
        )
        for n in arguments.uniform
    ]
    print_series("adaptive", adaptive, exact)
    print_series("uniform", uniform, exact)
    draw(adaptive, uniform, exact, SCENE / "convergence.png")
    draw_grid(adaptive[min(1, len(adaptive) - 1)][2], SCENE / "grid.png")
    return 0


if __name__ == "__main__":
    sys.exit(main())
