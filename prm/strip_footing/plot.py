#!/usr/bin/env python3
# Isochor: implicit, stabilised mixed Material Point Method on deal.II.
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Figures of the strip footing from one or several output directories.

    plot.py "u"=DIR1 "u-p"=DIR2 "u-p, PPP"=DIR3

Writes the load curve beside the reference, the heave of the surface with the
balance of volume, and the fields of all directories side by side, each on one
colour scale (for stresses that of the last directory). A directory may come
without a label.
"""

import argparse
import sys
from pathlib import Path

SCENE = Path(__file__).resolve().parent
sys.path.insert(0, str(SCENE.parent / "tools"))

import isochor_output as output  # noqa: E402
import numpy as np  # noqa: E402

HALF_WIDTH = 0.5  # of the footing, B/2 (m)
SURFACE = 10.0  # initial height of the soil (m)
SMALL_STRAIN_LIMIT = 2 + np.pi  # Prandtl's q / c_u

# q / c_u over w / B by two independent methods, see README.md, and the width
# of the band that they leave open.
REFERENCE = np.array(
    [(0.25, 5.6), (0.5, 5.95), (1.0, 6.4), (1.5, 6.75), (2.0, 7.0)]
)
REFERENCE_BAND = 0.1

# Field, file, factor and unit to draw in, and which case sets the colour
# scale: for stresses the last one, as oscillations of another would hide it.
FIELDS = (
    ("displacement_x", "displacement_x.png", 1, "m", None),
    ("displacement_y", "displacement_y.png", 1, "m", None),
    ("cauchy_stress_yy", "cauchy_stress_yy.png", 1e-3, "kPa", -1),
    ("pressure", "pressure.png", 1e-3, "kPa", -1),
)


def load_curve(directory, arguments):
    """w/B and q/c_u of an output. The reaction, the force on the soil, points
    down; that of the half model acts on half the width."""
    statistics = output.read_statistics(directory)
    settlement = statistics["Time (s)"] * arguments.rate
    pressure = -statistics["Reaction y on footing (N)"] / HALF_WIDTH
    return settlement / (2 * HALF_WIDTH), pressure / arguments.cohesion


def draw_load_curves(cases, arguments):
    figure, ax = output.plt.subplots(figsize=(6.4, 4.4), constrained_layout=True)
    highest = 8.0
    for index, (label, directory) in enumerate(cases):
        depth, load = load_curve(directory, arguments)
        ax.plot(
            np.append(0, depth),
            np.append(0, load),
            color=output.LINE_COLOURS[index % len(output.LINE_COLOURS)],
            lw=1.4,
            label=label,
        )
        # A locking form may leave the picture; the reference must not shrink.
        highest = max(highest, min(1.1 * load.max(), 16))
        report_load(label, depth, load)
    ax.errorbar(
        *REFERENCE.T,
        yerr=REFERENCE_BAND,
        fmt="ko",
        ms=4,
        capsize=3,
        lw=1,
        label="reference, large deformation",
        zorder=5,
    )
    ax.axhline(SMALL_STRAIN_LIMIT, color="0.3", lw=0.9, ls=":")
    ax.annotate(
        r"$2 + \pi$, small strain",
        (1, SMALL_STRAIN_LIMIT),
        xycoords=("axes fraction", "data"),
        xytext=(-2, -12),
        textcoords="offset points",
        ha="right",
        color="0.3",
        fontsize=9,
    )
    ax.set_xlim(left=0)
    ax.set_ylim(0, highest)
    ax.set_xlabel("settlement w / B")
    ax.set_ylabel(r"q / $c_u$")
    ax.legend(loc="lower right")
    output.save(figure, arguments.figures / "load_settlement.png")


def report_load(label, depth, load):
    """Print the curve at the depths of the reference that it reaches."""
    print(f"{label}: q / c_u")
    for at, expected in REFERENCE:
        if at <= depth[-1] * (1 + 1e-9):
            value = np.interp(at, depth, load)
            print(
                f"  w/B = {at:4.2f}: {value:6.3f}, reference {expected} +- "
                f"{REFERENCE_BAND}"
            )


def surface_profile(data, arguments):
    """The soil's surface beside the footing as a line of points (x, y): the
    edge of the footing's base, what the footing has left behind up to the
    initial surface, and the surface of the soil at rest as it has moved."""
    edge = HALF_WIDTH - arguments.inset
    settlement = data["time"] * arguments.rate
    wake = wake_profile(data, edge, settlement, arguments.bin_width)
    top = moved_surface(data, edge, arguments.bin_width)
    risen = np.argmax(top[:, 1] > SURFACE)
    corner = [[edge, SURFACE - settlement]]
    return np.vstack([corner, wake, top[risen:]]).T


def wake_profile(data, edge, settlement, bin_width):
    """The soil's left side above the footing's base: in each layer the first
    point, less half of its size."""
    x, y = data["position"][:, 0], data["position"][:, 1]
    left = x - 0.5 * np.sqrt(data["volume"])
    layers = np.arange(SURFACE - settlement, SURFACE, bin_width)
    layer = np.digitize(y, layers) - 1
    beside = (layer >= 0) & (y < SURFACE) & (x > edge)
    first = np.full(len(layers), np.inf)
    np.minimum.at(first, layer[beside], left[beside])
    filled = np.isfinite(first)
    centres = layers + 0.5 * bin_width
    return np.c_[np.maximum(first, edge), centres][filled]


def moved_surface(data, edge, bin_width):
    """The topmost point of each column of the soil at rest, moved up with the
    soil by the depth that it had below the surface."""
    rest = data["position"][:, :2] - data["displacement"][:, :2]
    depth = SURFACE - rest[:, 1]
    near = (depth < 0.5) & (rest[:, 0] > edge)
    order = np.flatnonzero(near)[np.argsort(depth[near])]
    columns = np.round(rest[order, 0] / bin_width)
    _, first = np.unique(columns, return_index=True)
    chosen = order[first]
    up = depth[chosen, None] * data["deformation_gradient"][chosen, :2, 1]
    return data["position"][chosen, :2] + up


def draw_heave(cases, arguments):
    """The surface at the chosen depths, a panel per case; prints the volume
    above the initial surface beside that which the footing displaced."""
    figure, axes = output.plt.subplots(
        len(cases),
        1,
        figsize=(6.4, 0.6 + 2.4 * len(cases)),
        sharex=True,
        sharey=True,
        squeeze=False,
        constrained_layout=True,
    )
    for ax, (label, directory) in zip(axes[:, 0], cases):
        drawn = set()
        for depth, colour in zip(arguments.depths, output.LINE_COLOURS):
            data = output.read_points_at(
                directory, depth * 2 * HALF_WIDTH / arguments.rate
            )
            if data["time"] in drawn:  # the run did not get that far
                continue
            drawn.add(data["time"])
            settlement = data["time"] * arguments.rate
            x, y = surface_profile(data, arguments)
            report_volume(label, settlement, data, x, y, arguments)
            ax.plot(
                x,
                y - SURFACE,
                color=colour,
                label=f"w/B = {settlement / (2 * HALF_WIDTH):.2f}",
            )
            ax.plot([0, HALF_WIDTH], 2 * [-settlement], color=colour, lw=3)
        ax.axhline(0, color="0.6", lw=0.8)
        ax.set_title(label)
        ax.set_ylabel("height above the\ninitial surface (m)")
        ax.legend(loc="lower right", ncol=2)
    axes[-1, 0].set_xlim(0, arguments.window[1])
    axes[-1, 0].set_xlabel("x (m)")
    output.save(figure, arguments.figures / "heave.png")


def report_volume(label, settlement, data, x, y, arguments):
    """The area between the initial surface and the present one against that
    which the footing has taken. What the soil leaves open beside the footing
    counts as the footing's."""
    displaced = (HALF_WIDTH - arguments.inset) * settlement
    heave = np.sum(np.diff(x) * (y[1:] + y[:-1] - 2 * SURFACE)) / 2
    heave += (arguments.soil_width - x[-1]) * (y[-1] - SURFACE)
    change = np.sum(data["volume"] * (1 - 1 / data["J"]))
    print(
        f"{label}, w = {settlement:.3f} m: displaced {displaced:.4f} m^2, "
        f"heave {heave:.4f} m^2 ({100 * (heave / displaced - 1):+.1f} %), "
        f"change of the soil's volume {change:+.4f} m^2"
    )


def draw_fields(cases, arguments):
    """One figure per field with all cases."""
    data = [
        (label, output.read_points(directory, arguments.step))
        for label, directory in cases
    ]
    fields = list(FIELDS)
    if all("equivalent_plastic_strain" in points for _, points in data):
        name = "equivalent_plastic_strain"
        fields.append((name, name + ".png", 1, "-", None))
    for name, file_name, scale, unit, scale_from in fields:
        output.compare_points(
            data,
            name,
            arguments.figures / file_name,
            columns=min(arguments.columns, len(cases)),
            scale_from=scale_from,
            scale=scale,
            unit=unit,
            window=arguments.window,
            style="cells",  # oscillations as they are
        )


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
        "--columns", type=int, default=3, help="panels side by side"
    )
    parser.add_argument(
        "--step", type=int, default=-1, help="which output of points.pvd"
    )
    parser.add_argument(
        "--rate",
        type=float,
        default=1.0,
        help="settlement of the footing per unit of time (m/s)",
    )
    parser.add_argument("--cohesion", type=float, default=1e3, help="c_u (Pa)")
    parser.add_argument(
        "--depths",
        type=float,
        nargs="+",
        default=[0.5, 1.0, 1.5, 2.0],
        help="w/B of the heave profiles, at most 5",
    )
    parser.add_argument(
        "--bin-width", type=float, default=0.05, help="of the profile (m)"
    )
    parser.add_argument(
        "--inset",
        type=float,
        default=0.025,
        help="of footing.geo, half of h_edge (m)",
    )
    parser.add_argument(
        "--soil-width", type=float, default=12.0, help="of the half model (m)"
    )
    parser.add_argument(
        "--window",
        type=float,
        nargs=4,
        default=(0.0, 6.0, 5.0, 11.5),
        metavar=("X0", "X1", "Y0", "Y1"),
        help="what the fields show (m)",
    )
    return parser.parse_args()


def main():
    arguments = parse_arguments()
    cases = [output.parse_case(argument) for argument in arguments.outputs]
    draw_load_curves(cases, arguments)
    draw_heave(cases, arguments)
    draw_fields(cases, arguments)


if __name__ == "__main__":
    try:
        main()
    except output.OutputError as problem:
        sys.exit(f"Error: {problem}")
