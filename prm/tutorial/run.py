#!/usr/bin/env python3
# Isochor: implicit, stabilised mixed Material Point Method on deal.II.
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Run the scenes of doc/tutorial.md, print its numbers, draw its pictures.

Takes about a minute. Writes bar.png, bar_3d.png, swing.png, convergence.png and
adaptive_grid.png, and the output of the runs into 'output-tutorial'.
"""

import argparse
import sys
from pathlib import Path

SCENE = Path(__file__).resolve().parent
sys.path.insert(0, str(SCENE.parent / "tools"))

import isochor_output as output  # noqa: E402
import matplotlib.pyplot as plt  # noqa: E402
import numpy as np  # noqa: E402
import solid_view  # noqa: E402

TIP = "Displacement y of tip (m)"
BLUE, ORANGE = output.LINE_COLOURS[:2]
plt.rcParams["savefig.dpi"] = 130

# The bar: length and height (m), Young's modulus (Pa), Poisson's ratio, weight
# per length (N/m, of a bar of 1 m width)
LENGTH, HEIGHT, YOUNG, POISSON, WEIGHT = 1.0, 0.1, 5e6, 0.499, 981.0


def sag_of_a_beam(stiffness, weight, n=1000):
    """How far the tip of a clamped beam comes down under its weight (N/m):
    bending at any rotation, no stretch, no shear. With the slope theta, positive
    downwards, stiffness theta'' = -weight (L - s) cos theta, theta(0) = 0,
    theta'(L) = 0; the curvature at the wall is found by bisection."""

    def right_side(s, y):
        moment_per_length = weight * (LENGTH - s) * np.cos(y[0])
        return np.array([y[1], -moment_per_length / stiffness, np.sin(y[0])])

    def end(curvature):
        y, h = np.array([0.0, curvature, 0.0]), LENGTH / n
        for s in np.arange(n) * h:  # Runge and Kutta's method
            a = right_side(s, y)
            b = right_side(s + h / 2, y + h / 2 * a)
            c = right_side(s + h / 2, y + h / 2 * b)
            d = right_side(s + h, y + h * c)
            y = y + h / 6 * (a + 2 * b + 2 * c + d)
        return y

    low, high = 0.0, weight * LENGTH**2 / stiffness
    for _ in range(40):
        middle = (low + high) / 2
        low, high = (low, middle) if end(middle)[1] > 0 else (middle, high)
    return end(low)[2]


def beam_theory():
    """Sag (m) in plane strain and of a square bar, and the period (s) of small
    vibrations in plane strain."""
    inertia = HEIGHT**3 / 12
    plane_strain = YOUNG / (1 - POISSON**2) * inertia
    mass = WEIGHT / 9.81
    frequency = 1.8751**2 * np.sqrt(plane_strain / (mass * LENGTH**4))
    return (
        sag_of_a_beam(plane_strain, WEIGHT),
        sag_of_a_beam(YOUNG * inertia, WEIGHT),
        2 * np.pi / frequency,
    )


class Runs:
    def __init__(self, executable, directory):
        self.executable, self.directory = executable, directory

    def __call__(self, name, scene="bar.prm", **overrides):
        """Run a scene, print what it gives at the end; its statistics."""
        settings = {key.replace("__", "/").replace("_", " "): value
                    for key, value in overrides.items()}  # fmt: skip
        table = output.run(
            SCENE / scene, settings, self.executable, self.directory / name, check=True
        ).statistics
        print(
            f"{name:28s} {table['Equations'][-1]:7.0f} equations, tip "
            f"{table[TIP][-1]:9.5f} m, reaction "
            f"{table['Reaction y on left (N)'][-1]:10.4f} N"
        )
        return table

    def points(self, name):
        return output.read_points(self.directory / name)

    def grid(self, name):
        return output.read_grid(self.directory / name)


def lines_of(axes, grid, colour="#b0b0b0"):
    axes.triplot(
        grid["position"][:, 0],
        grid["position"][:, 1],
        grid["triangles"],
        color=colour,
        linewidth=0.3,
    )


def draw_bar(runs):
    """Axial stress at the points, and the cells that hold them."""
    figure, axes = plt.subplots(figsize=(6.5, 2.6))
    lines_of(axes, runs.grid("bar"))
    output.plot_points(
        axes, runs.points("bar"), "cauchy_stress_xx", scale=1e-3, unit="kPa"
    )
    axes.set_xlim(-0.02, 1.02)
    axes.set_ylim(-0.24, 0.13)
    output.save(figure, SCENE / "bar.png")


def draw_bar_3d(runs):
    data = runs.points("bar_3d")
    data = output.mirrored(data, "z")
    figure, axes = plt.subplots(figsize=(6, 3.2))
    solid_view.plot_solid(
        axes, data, "cauchy_stress_xx", 30, 20, scale=1e-3, unit="kPa"
    )
    output.save(figure, SCENE / "bar_3d.png")


def draw_swing(swing, kept, static):
    figure, axes = plt.subplots(figsize=(5.5, 3))
    axes.axhline(static, color="#909090", linewidth=1, linestyle="--")
    axes.text(0, static, "at rest", va="bottom", color="#606060")
    for table, label, colour in (
        (swing, "bar_dynamics.prm", BLUE),
        (kept, "finer, no reset", ORANGE),
    ):
        axes.plot(table["Time (s)"], table[TIP], color=colour, label=label)
    axes.set_xlabel("time (s)")
    axes.set_ylabel("displacement of the tip (m)")
    axes.legend(loc="lower center", bbox_to_anchor=(0.5, 1), ncol=2)
    output.save(figure, SCENE / "swing.png")


def draw_convergence(uniform, adaptive):
    figure, axes = plt.subplots(figsize=(5, 3.2))
    for tables, label, colour in (
        (uniform, "equal cells", ORANGE),
        (adaptive, "adaptive grid", BLUE),
    ):
        axes.semilogx(
            [table["Equations"][-1] for table in tables],
            [table[TIP][-1] for table in tables],
            "o-",
            color=colour,
            label=label,
        )
    axes.set_xlabel("equations")
    axes.set_ylabel("displacement of the tip (m)")
    axes.legend()
    output.save(figure, SCENE / "convergence.png")


def draw_adaptive_grid(runs):
    figure, axes = plt.subplots(figsize=(6.5, 2.6))
    lines_of(axes, runs.grid("bar_adaptive"), "#303030")
    axes.set_aspect("equal")
    axes.set_axis_off()
    output.save(figure, SCENE / "adaptive_grid.png")


def cells(n):
    """The grid with n times as many cells along each side."""
    return {"Grid__Subdivisions": f"{44 * n}, {28 * n}"}


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--executable", default=None)
    parser.add_argument(
        "--output-directory", type=Path, default=Path("output-tutorial")
    )
    arguments = parser.parse_args()
    runs = Runs(
        arguments.executable or output.find_executable(),
        arguments.output_directory,
    )
    sag, sag_3d, period = beam_theory()
    print(f"beam theory: {-sag:.4f} m, 3D {-sag_3d:.4f} m, {period:.3f} s")

    uniform = [runs("bar")] + [runs(f"bar, {n} times", **cells(n)) for n in (2, 4, 8)]
    runs("u", Formulation__Type="u")
    for n in (3, 9):
        runs(f"{n} points per cell", Material_points__Points_per_cell=n)
    for size in (0.2, 0.05):
        runs(f"steps of {size}", Time__Step_size=size)
    adaptive = [
        runs(
            name,
            "bar_adaptive.prm",
            Adaptive_grid__Target_of_relative_error=target,
            Adaptive_grid__Maximum_level=level,
        )
        for name, target, level in (
            ("adaptive, 0.3", 0.3, 4),
            ("adaptive, 0.2", 0.2, 4),
            ("bar_adaptive", 0.15, 4),  # as the file says
            ("adaptive, 0.1", 0.1, 6),
        )
    ]
    runs("bar_3d", "bar_3d.prm")
    swing = runs("bar_dynamics", "bar_dynamics.prm")
    kept = runs(
        "dynamics, finer, kept",
        "bar_dynamics.prm",
        **cells(2),
        Time__Step_size=0.01,
        Grid_reset__Steps_between_resets=0,
    )
    for name, table in (("bar_dynamics", swing), ("finer, kept", kept)):
        energy = table["Kinetic energy (J)"] + table["Strain energy (J)"]
        lost = table["Energy lost by the scheme (J)"]
        print(
            f"{name}: largest energy {energy.max():.2f} J, lost at most "
            f"{np.abs(lost).max():.3f} J; lowest tip {table[TIP].min():.4f} m"
        )

    draw_bar(runs)
    draw_bar_3d(runs)
    draw_swing(swing, kept, uniform[-1][TIP][-1])
    draw_convergence(uniform, adaptive)
    draw_adaptive_grid(runs)


if __name__ == "__main__":
    main()
