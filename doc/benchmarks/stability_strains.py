# Isochor: implicit, stabilised mixed Material Point Method on deal.II.
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Stress tests: large strains, and cycles of load."""

import re

import harness
import numpy as np
from bench import SCENES, plt, shortened
from harness import output


def homogeneous(bench, name, script, measure, exact, axis_label):
    """Deform a block homogeneously with CPDI, which alone has surfaces that can be
    moved: is its force right, or does the program say that it isn't? @p measure makes the measure of strain of
    the time, @p exact the force of that."""
    figure, axis = plt.subplots(figsize=(6, 3.6), constrained_layout=True)
    for points in (4, 16):
        label = f"{points} points per cell"
        run = harness.Run("", f"{name} {label}", 0, script)
        place = bench.directory / "runs" / run.name
        columns, law = exact
        try:
            numbers = bench.run(
                script,
                {"Material points/Points per cell": points},
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
    grid that is reset in each step: what is right, and a warning for what is not."""
    # Neo-Hookean, plane strain, incompressible: first Piola stress times the
    # width at rest is G (l - l^-3)
    homogeneous(
        bench,
        "strain",
        SCENES / "stretch.prm",
        np.exp,
        (
            ("Force y on top by place (N)",),
            lambda stretch: stretch - stretch**-3,
        ),
        "stretch",
    )


def shear(bench):
    """Simple shear of an incompressible block to γ = 5 in a grid that is reset in
    each step, its surface driven: what is right, and a warning for what is not."""
    homogeneous(
        bench,
        "shear",
        SCENES / "shear.prm",
        lambda time_: 5 * time_,
        (("Force x on top by place (N)",), lambda gamma: gamma),
        "γ",
    )


STEPS = 10  # of a cycle
# name, overrides, cycles of the quick and of the full test, what is demanded
CYCLIC = (
    ("CPDI", {}, 20, 200, "told"),
    ("CPDI, cells half as large", {"Grid/Subdivisions": "54, 62"}, 3, 40, "told"),
    (
        "CPDI, the grid reset every seventh step",
        {"Grid reset/Steps between resets": 7},
        5,
        200,
        "told",
    ),
    (
        "CPDI, the grid never reset",
        {"Grid reset/Steps between resets": 0, "Grid reset/Smallest element quality": 0},
        20,
        200,
        "none",
    ),
)


def drift_of(tip):
    """After each cycle, how much places in it have moved since the first one, the largest
    at any of its steps, relative to the amplitude of the first."""
    rounds = tip[: len(tip) // STEPS * STEPS].reshape(-1, STEPS)
    return np.abs(rounds - rounds[0]).max(axis=1) / (np.ptp(rounds[0]) / 2)


def cycles(bench):
    """Cyclic load on an elastic body at rest, ten steps in a cycle: wherever the grid is
    reset in between, the body drifts, and has to say so before it matters. A grid that
    goes along drifts by rounding only."""
    figure, axis = plt.subplots(figsize=(6, 3.4), constrained_layout=True)
    for name, overrides, few, many, demand in CYCLIC:
        count = few if bench.quick else many
        run = f"cycles {name}"
        place = bench.place_of(run)
        end = ""
        try:
            bench.run(
                SCENES / "cycles.prm",
                {**overrides, "Time/End time": count, "Time/Step size": 1 / STEPS},
                run,
            )
        except output.OutputError as problem:
            end = f"; ends in cycle {{}} with the error: {shortened(problem, 60)} ..."
        numbers = output.read_statistics(place)
        reached = int(numbers["Time (s)"][-1]) + 1
        drift = drift_of(numbers["Displacement y of P (m)"])
        volume = numbers["Material volume (m^2)"]
        axis.semilogy(np.arange(len(drift)), np.maximum(drift, 1e-12), label=name)
        far = np.flatnonzero(drift > 0.05)
        told = time_of_warning(place, "energy balance")
        bench.check(
            "cycles",
            f"{name}: drift {drift[min(9, len(drift) - 1)]:.2g} of the amplitude after "
            f"{min(10, len(drift))} cycles, {drift[-1]:.2g} after {len(drift)}; volume "
            f"{abs(volume[-1] / volume[0] - 1):.1e}" + end.format(reached),
            (f"5 % in cycle {far[0] + 1}" if len(far) else "never 5 %")
            + (f", warned in cycle {int(told) + 1}" if told else ", no warning"),
            "a warning before 5 %" if demand == "told" else "1e-6, no warning",
            len(far) == 0 or (told is not None and told < far[0] + 1)
            if demand == "told"
            else drift.max() < 1e-6 and told is None,
        )
    axis.set(xlabel="cycle", ylabel="drift / amplitude", ylim=(1e-12, None))
    axis.legend(fontsize=7)
    bench.save(figure, "cycles")


def time_of_warning(place, name):
    """When the run in @p place has issued the warning @p name, or None."""
    for warning in output.Run(place).warnings:
        found = re.match(r"up to t = ([0-9.e+-]+)", warning.text)
        if warning.name == name and found:
            return float(found.group(1))
    return None
