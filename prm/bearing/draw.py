#!/usr/bin/python3
# Isochor: implicit, stabilised mixed Material Point Method on deal.II.
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Run the scene on a grid that is reset in each step and on one that is
never reset, and draw both:

    /usr/bin/python3 draw.py --executable /where/isochor
"""

import argparse
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent / "tools"))
import isochor_output as output  # noqa: E402
import matplotlib  # noqa: E402

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402

RUNS = [("reset", 1, "reset in each step"), ("no_reset", 0, "never reset")]


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--executable", default="isochor")
    parser.add_argument("--cells", type=int, default=1, help="times more a side")
    arguments = parser.parse_args()
    figure, axes = plt.subplots(2, 2, figsize=(12, 5.2))
    for row, (name, steps, title) in zip(axes, RUNS):
        run = output.run(
            HERE / "bearing.prm",
            {
                "Grid/Subdivisions": f"{80 * arguments.cells},{24 * arguments.cells}",
                "Grid reset/Steps between resets": steps,
            },
            arguments.executable,
            name,
            check=True,
        )
        force = -run.statistics["Reaction x on bottom (N)"][-1]
        points = run.points()
        for axis, field, limit in zip(row, ("pressure", "cauchy_stress_xy"), (2.0, 1.5)):
            output.plot_points(axis, points, field, scale=1e-6, unit="MPa", limits=(-limit, limit))
            axis.set_title(f"grid {title}: {force / 1e3:.1f} kN/m")
    figure.tight_layout()
    output.save(figure, HERE / "bearing.png")


if __name__ == "__main__":
    main()
