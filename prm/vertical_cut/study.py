#!/usr/bin/env python3
# Isochor: implicit, stabilised mixed Material Point Method on deal.II.
# SPDX-License-Identifier: LGPL-2.1-or-later
"""The vertical cut on adaptive and on uniform grids: the load at which it falls
over the number of equations, and a picture of the finest adaptive run.

    ./study.py                      friction angle 20 degrees
    ./study.py --angle 0
"""

import argparse
import sys
from pathlib import Path

SCENE = Path(__file__).resolve().parent
sys.path.insert(0, str(SCENE.parent / "tools"))

import isochor_output as output  # noqa: E402
import numpy as np  # noqa: E402

EXACT = {20: "5.4 to 5.5", 0: "3.77 to 3.83"}
END = {20: 1, 0: 0.5}  # without friction the cut goes on to bulge


def collapse(numbers):
    """gamma H/c at which the crest begins to run, ten times faster than at the
    start; the last one in equilibrium if it never does."""
    load = 8 * numbers["Time (s)"]
    crest = np.hypot(
        numbers["Displacement x of crest (m)"],
        numbers["Displacement y of crest (m)"],
    )
    speed = np.diff(crest) / np.diff(load)
    running = np.flatnonzero(speed > 10 * crest[4] / load[4])
    return load[running[0] + 1] if running.size else load[-1]


def run(arguments, scene, overrides, name):
    """Print a line on one run, which ends with an error where no equilibrium is
    left. Its directory."""
    overrides = {
        "Material/Mohr-Coulomb/Friction angle": arguments.angle,
        "Material/Mohr-Coulomb/Dilation angle": arguments.angle,
        "Time/End time": END[arguments.angle],
        "Time/Output interval": END[arguments.angle],
        **overrides,
    }
    directory = arguments.output_directory / f"{name} {arguments.angle}"
    done = output.run(SCENE / scene, overrides, arguments.executable, directory)
    numbers = done.statistics
    equations = numbers["Equations"]
    print(
        f"{name:>12}  gamma H/c = {collapse(numbers):.2f}, equations: "
        f"{equations.mean():.0f} in the mean, {equations.max():.0f} at most, "
        f"{numbers['Number of material points'][-1]:.0f} points, "
        f"{done.cpu:.0f} s of CPU",
        flush=True,
    )
    return directory


def draw(directory, path):
    """Cells and plastic strain of the last equilibrium."""
    kinds = ("failure-grid", "failure-points")
    if not (directory / "failure-grid.pvd").is_file():
        kinds = ("grid", "points")
    grid, points = (output.read_output(directory, kind) for kind in kinds)
    figure, axes = output.plt.subplots(
        1, 2, figsize=(11, 4), constrained_layout=True
    )
    axes[0].triplot(
        grid["position"][:, 0],
        grid["position"][:, 1],
        grid["cells"],
        **output.GRID_LINES,
    )
    output.plot_points(
        axes[1],
        points,
        "equivalent_plastic_strain",
        limits=(0, 0.01),
    )
    for ax in axes:
        ax.set(aspect="equal", xlim=(0, 9), ylim=(0, 6.2))
        ax.set_axis_off()
    output.save(figure, path)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--executable", default=None)
    parser.add_argument("--output-directory", type=Path, default=Path("output"))
    parser.add_argument("--angle", type=int, choices=EXACT, default=20)
    parser.add_argument("--levels", type=int, nargs="+", default=[2, 3, 4])
    parser.add_argument("--uniform", type=int, nargs="+", default=[2, 3])
    arguments = parser.parse_args()
    print(f"exact: {EXACT[arguments.angle]}")
    for level in arguments.uniform:
        n = 2**level
        run(
            arguments,
            "vertical_cut.prm",
            {
                "Grid/Subdivisions": f"{16 * n}, {7 * n}",
                "Grid/Diagonals": "alternating",
            },
            f"uniform {level}",
        )
    for level in arguments.levels:
        directory = run(
            arguments,
            "adaptive.prm",
            {
                "Adaptive grid/Maximum level": level,
                "Adaptive grid/Cell size in plastic zones": 2.0**-level,
            },
            f"level {level}",
        )
    draw(directory, SCENE / "shear_band.png")
    return 0


if __name__ == "__main__":
    sys.exit(main())
