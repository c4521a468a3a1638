#!/usr/bin/env python3
# Isochor: implicit, stabilised mixed Material Point Method on deal.II.
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Figures of the tension plate from one or several output directories.

    plot.py "u, 0.33"=DIR1 "u-p, 0.33"=DIR2 "u, 0.4999"=DIR3 "u-p, 0.4999"=DIR4

Writes the fields of all directories side by side, each on one colour scale
(for stresses that of the last directory), and the stress-displacement curves.
A directory may come without a label.
"""

import argparse
import sys
from pathlib import Path

SCENE = Path(__file__).resolve().parent
sys.path.insert(0, str(SCENE.parent / "tools"))

import isochor_output as output  # noqa: E402
import numpy as np  # noqa: E402

# Limit of the mean axial stress over the yield stress: the slip lines at 45
# degrees of a strip as high as wide between clamped ends, plane strain.
LIMIT = 2 / np.sqrt(3)

# Field, file, factor and unit to draw in, and which case sets the colour
# scale: for stresses the last one, as oscillations of another would hide it.
FIELDS = (
    ("displacement_x", "displacement_x.png", 1e3, "mm", None),
    ("displacement_y", "displacement_y.png", 1e3, "mm", None),
    ("equivalent_plastic_strain", "equivalent_plastic_strain.png", 1, "-", None),
    ("cauchy_stress_yy", "cauchy_stress_yy.png", 1e-6, "MPa", -1),
    ("pressure", "pressure.png", 1e-6, "MPa", -1),
)


def draw_fields(cases, arguments):
    """One figure per field with all cases."""
    data = [
        (label, output.read_points(directory, arguments.step))
        for label, directory in cases
    ]
    for name, file_name, scale, unit, scale_from in FIELDS:
        output.compare_points(
            data,
            name,
            arguments.figures / file_name,
            columns=min(arguments.columns, len(cases)),
            scale_from=scale_from,
            scale=scale,
            unit=unit,
        )


def draw_curves(cases, arguments):
    """Mean axial stress over the prescribed displacement."""
    figure, ax = output.plt.subplots(figsize=(6, 4), constrained_layout=True)
    for index, (label, directory) in enumerate(cases):
        statistics = output.read_statistics(directory)
        displacement = statistics["Time (s)"] * arguments.rate
        stress = statistics["Reaction y on top (N)"] / arguments.width
        ax.plot(
            np.append(0, displacement) * 1e3,
            np.append(0, stress) / arguments.yield_stress,
            color=output.LINE_COLOURS[index % len(output.LINE_COLOURS)],
            lw=max(1.0, 3.0 - 0.6 * index),  # equal curves stay visible
            label=label,
        )
        final = stress[-1] / arguments.yield_stress
        print(
            f"{label}: last mean axial stress {final:.4f} yield stresses, "
            f"{final / LIMIT - 1:+.2%} of the exact limit {LIMIT:.4f}"
        )
    ax.axhline(LIMIT, color="0.3", lw=0.9, ls=":")
    ax.annotate(
        r"exact limit $2/\sqrt{3}$",
        (1, LIMIT),
        xycoords=("axes fraction", "data"),
        xytext=(-2, -4),
        textcoords="offset points",
        ha="right",
        va="top",
        color="0.3",
        fontsize=9,
    )
    ax.set_xlim(left=0)
    ax.set_ylim(0, max(1.3, ax.get_ylim()[1]))
    ax.set_xlabel("prescribed displacement (mm)")
    ax.set_ylabel(r"mean axial stress / $\sigma_Y$")
    ax.legend(loc="lower right")
    output.save(figure, arguments.figures / "stress_displacement.png")


def parse_arguments():
    parser = argparse.ArgumentParser(
        description=__doc__.split("\n", maxsplit=1)[0]
    )
    parser.add_argument(
        "outputs", nargs="+", metavar="LABEL=DIRECTORY", help="outputs to draw"
    )
    parser.add_argument(
        "--figures", type=Path, default=Path("."), help="where the files go"
    )
    parser.add_argument(
        "--columns", type=int, default=2, help="panels side by side"
    )
    parser.add_argument(
        "--step", type=int, default=-1, help="which output of points.pvd"
    )
    parser.add_argument(
        "--rate",
        type=float,
        default=1e-3,
        help="prescribed displacement per unit of time (m/s)",
    )
    parser.add_argument("--yield-stress", type=float, default=150e6)
    parser.add_argument("--width", type=float, default=0.1, help="plate (m)")
    return parser.parse_args()


def main():
    arguments = parse_arguments()
    cases = [output.parse_case(argument) for argument in arguments.outputs]
    draw_curves(cases, arguments)
    draw_fields(cases, arguments)


if __name__ == "__main__":
    try:
        main()
    except output.OutputError as problem:
        sys.exit(f"Error: {problem}")
