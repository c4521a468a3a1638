# Isochor: implicit, stabilised mixed Material Point Method on deal.II.
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Stress tests: large strains, and cycles of load."""

import harness
import numpy as np
from bench import SCENES, plt, shortened
from harness import output


def homogeneous(bench, name, script, measure, exact, axis_label):
    """Deform a block homogeneously, with each quadrature: is its force right, or
    does the program say that it isn't? @p measure makes the measure of strain of
    the time, @p exact the force of that."""
    figure, axis = plt.subplots(figsize=(6, 3.6), constrained_layout=True)
    for quadrature, points in (
        ("points", 4),
        ("points", 16),
        ("cell-filled", 4),
        ("cell-filled + boundary", 4),
        ("CPDI", 4),
        ("CPDI", 16),
    ):
        label = f"{quadrature}, {points} points per cell"
        run = harness.Run("", f"{name} {label}", 0, script)
        place = bench.directory / "runs" / run.name
        columns, law = exact
        try:
            numbers = bench.run(
                script,
                {
                    "Quadrature/Type": quadrature,
                    "Material points/Points per cell": points,
                },
                f"{name} {label}",
            )
            warned = harness.warnings_of(place)
            message = f"{warned} warnings"
        except output.OutputError as problem:
            warned = 1
            message = "ends with an error: " + shortened(problem)
            try:
                numbers = output.read_statistics(place)
            except output.OutputError:
                bench.check(name, label, message, "right or warned", True)
                continue
        reached = measure(numbers["Time (s)"])
        force = sum(numbers[column] for column in columns)
        error = np.abs(force / law(reached) - 1)
        axis.semilogy(reached, np.maximum(error, 1e-12), label=label)
        # up to the first that is wrong
        wrong = np.flatnonzero(~(error < 0.02))
        good = len(reached) if len(wrong) == 0 else wrong[0]
        last_good = reached[good - 1] if good else measure(0.0)
        bench.check(
            name,
            f"{label}: right within 2 % up to {axis_label} {last_good:.1f} of "
            f"{reached[-1]:.1f}",
            message,
            "right or warned",
            warned > 0 or good == len(reached),
        )
    axis.set(xlabel=axis_label, ylabel="relative error of the force")
    axis.legend(fontsize=7)
    bench.save(figure, name)


def strain(bench):
    """Stretch of a homogeneous incompressible block to ten times its length in a
    grid that is put back in each step: what is right, and what is not says so."""
    # Neo-Hookean, plane strain, incompressible: first Piola stress times the
    # width at rest is G (l - l^-3)
    homogeneous(
        bench,
        "strain",
        SCENES / "stretch.prm",
        np.exp,
        (
            ("Reaction y on top by boundary points (N)",),
            lambda stretch: stretch - stretch**-3,
        ),
        "stretch",
    )


def shear(bench):
    """Simple shear of an incompressible block to γ = 5 in a grid that is put back in
    each step, its whole surface driven: what is right, and what is not says so."""
    homogeneous(
        bench,
        "shear",
        SCENES / "shear.prm",
        lambda time_: 5 * time_,
        # at its corners the top's share is carried by the points of the sides
        (
            (
                "Reaction x on top by boundary points (N)",
                "Reaction x on sides by boundary points (N)",
            ),
            lambda gamma: gamma,
        ),
        "γ",
    )


def cycles(bench):
    """Cyclic load: drift of the volume and of the largest displacement."""
    count = 20 if bench.quick else 200
    steps = 10
    figure, axis = plt.subplots(figsize=(6, 3.4), constrained_layout=True)
    for quadrature in ("cell-filled", "cell-filled + boundary", "CPDI"):
        try:
            numbers = bench.run(
                SCENES / "cycles.prm",
                {
                    "Quadrature/Type": quadrature,
                    "Time/End time": count,
                    "Time/Step size": 1 / steps,
                },
                f"cycles {quadrature}",
            )
        except output.OutputError as problem:
            # cells at the surface that count as full: known not to bear it
            bench.check(
                "cycles",
                f"{quadrature}: ends early",
                "error: " + shortened(problem),
                "no drift, or (cell-filled) an error",
                quadrature == "cell-filled" and str(problem).startswith("code 1"),
            )
            continue
        volume = numbers["Material volume (m^2)"]
        tip = numbers["Displacement y of P (m)"]
        peak = tip[steps // 4 :: steps]
        drift = abs(volume[-1] / volume[0] - 1)
        walk = abs(peak[-1] / peak[1] - 1)
        axis.plot(np.arange(len(peak)), peak / peak[1] - 1, label=quadrature)
        bench.check(
            "cycles",
            f"{quadrature}, {count * steps} steps: volume",
            f"{drift:.1e}",
            "1e-3",
            drift < 1e-3,
        )
        bench.check(
            "cycles",
            f"{quadrature}, {count * steps} steps: largest displacement of a cycle",
            f"{100 * walk:.2f} %",
            "2 %",
            walk < 0.02,
        )
    axis.set(xlabel="cycle", ylabel="drift of the largest displacement")
    axis.legend(fontsize=7)
    bench.save(figure, "cycles")
