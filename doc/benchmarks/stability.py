#!/usr/bin/env python3
# Isochor: implicit, stabilised mixed Material Point Method on deal.II.
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Stress tests of numerical stability, each with a number, a bound and a picture.

    stability.py                 # all
    stability.py --only nu --only alpha
    stability.py --quick         # small versions, a few minutes
    stability.py --publish       # also doc/benchmarks/results and doc/stability.md

A test that misses its bound is reported and makes the program end with code 1.
Needs numpy, matplotlib, vtk9 and gmsh. The inf-sup test is tests/inf_sup.cc.
"""

import argparse
import json
import os
import re
import shutil
import sys
import time
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE))

import harness  # noqa: E402
import numpy as np  # noqa: E402
import report  # noqa: E402
import scenes  # noqa: E402
from vertical_cut import cut  # noqa: E402
from harness import ROOT, output  # noqa: E402

plt = output.plt
PRM = ROOT / "prm"
COOK = PRM / "cooks_membrane" / "cooks_membrane.prm"
SCENES = HERE / "scenes"
QUIET = {"Postprocess/Write grid": "false", "Time/Output interval": 1e9}


class Bench:
    """Runs scenes, keeps what was found."""

    def __init__(self, arguments):
        self.arguments = arguments
        self.directory = arguments.directory
        self.quick = arguments.quick
        self.results = {}  # test: list of (what, value, bound, kept)

    def run(self, prm, overrides, name, processes=1):
        """Statistics of a run. Raises OutputError with the end of its log."""
        run = harness.Run("", name, 0, prm, {**QUIET, **overrides}, False, processes)
        place = self.place_of(name)
        harness.execute(
            self.arguments.executable, run, place, harness.Cost([], []), 1800
        )
        return output.read_statistics(place)

    def place_of(self, name):
        """Where run() writes."""
        return self.directory / "runs" / harness.Run("", name, 0, COOK).name

    def check(self, test, what, value, bound, kept):
        self.results.setdefault(test, []).append(
            (what, value, bound, bool(kept))
        )
        print(
            f"{test}: {what}: {value} (bound: {bound})"
            + ("" if kept else "   NOT KEPT"),
            flush=True,
        )

    def save(self, figure, name):
        for suffix in ("png", "svg"):
            figure.savefig(
                self.directory / f"stability_{name}.{suffix}",
                bbox_inches="tight",
                dpi=110,
            )
        plt.close(figure)


def shortened(problem):
    """The beginning of what a failed run said, without the names of files."""
    text = re.sub(r"<?/[^\s>]+>?", "...", " ".join(str(problem).split()))
    _, _, said = text.partition("isochor: error: ")
    return (said or text)[:150]


def oscillation(directory):
    """How much the pressure of neighbouring nodes differs from a smooth field:
    the root mean square over nodes of the pressure less the mean of its
    neighbours, relative to that of the pressure."""
    grid = output.read_grid(directory)
    pressure, triangles = grid["pressure"], grid["triangles"]
    # nodes are written once for each cell
    _, number = np.unique(
        np.round(grid["position"][:, :2], 9), axis=0, return_inverse=True
    )
    number = number.ravel()
    n = number.max() + 1
    value = np.zeros(n)
    value[number] = pressure
    corners = number[triangles]
    total, count = np.zeros(n), np.zeros(n)
    for a, b in ((0, 1), (1, 2), (2, 0)):
        for i, j in ((a, b), (b, a)):
            np.add.at(total, corners[:, i], value[corners[:, j]])
            np.add.at(count, corners[:, i], 1)
    used = count > 0
    rough = value[used] - total[used] / count[used]
    return float(np.sqrt(np.mean(rough**2) / np.mean(value[used] ** 2)))


# -------------------------------------------------------------- the tests ---


def alpha(bench):
    """The PPP coefficient from 0 to 1000, Cook's membrane: displacement and
    pressure have a plateau."""
    n = 32
    values = [0, 0.01, 0.1, 0.3, 1, 3, 8, 30, 100, 1000]
    with open(HERE / "references" / "cook_membrane.json") as stream:
        reference = json.load(stream)["results"]["nu=0.499 P=1"]["uy"]
    errors, roughness = [], []
    for value in values:
        name = f"alpha {value}"
        numbers = bench.run(
            COOK,
            {
                "Grid/Subdivisions": f"{n}, {n}",
                "Formulation/PPP coefficient": value,
                "Quadrature/Type": "points",
                "Postprocess/Write grid": "true",
                **(
                    {"Formulation/Stabilisation": "none"} if value == 0 else {}
                ),
            },
            name,
        )
        errors.append(numbers["Displacement y of A (m)"][-1] / reference - 1)
        place = bench.directory / "runs" / harness.Run("", name, 0, COOK).name
        roughness.append(oscillation(place))
    plateau = [e for v, e in zip(values, errors) if 0.1 <= v <= 10]
    spread = max(plateau) - min(plateau)
    bench.check(
        "alpha",
        f"spread of u_y(A) for 0.1 <= α <= 10, n = {n}",
        f"{100 * spread:.2f} %",
        "5 %",
        spread < 0.05,
    )
    rough = max(r for v, r in zip(values, roughness) if v >= 0.3)
    bench.check(
        "alpha",
        "largest roughness of the pressure for α >= 0.3, in units of that at 0",
        f"{rough / roughness[0]:.3f}",
        "0.5",
        rough < 0.5 * roughness[0],
    )
    figure, axes = plt.subplots(1, 2, figsize=(9, 3.4), constrained_layout=True)
    shown = [max(v, 3e-3) for v in values]
    axes[0].semilogx(shown, 100 * np.array(errors), "o-")
    axes[0].set(xlabel="α (leftmost: 0)", ylabel="error of u_y(A) (%)")
    axes[1].loglog(shown, roughness, "o-")
    axes[1].set(xlabel="α (leftmost: 0)", ylabel="roughness of the pressure")
    bench.save(figure, "alpha")


def nu(bench):
    """Poisson's ratio from 0.3 to exactly 1/2: u-p with PPP doesn't notice, and
    the u form locks."""
    n = 16 if bench.quick else 32
    values = [0.3, 0.4, 0.45, 0.49, 0.499, 0.4999, 0.49999, 0.5]
    curves = {}
    for label, overrides in (
        ("u-p, PPP", {}),
        (
            "u",
            {"Formulation/Type": "u", "Formulation/Stabilisation": "none"},
        ),
    ):
        tips, iterations = [], []
        for value in values if label != "u" else values[:-1]:
            numbers = bench.run(
                COOK,
                {
                    "Grid/Subdivisions": f"{n}, {n}",
                    "Material/Poisson ratio": value,
                    "Quadrature/Type": "points",
                    **overrides,
                },
                f"nu {label} {value}",
            )
            tips.append(numbers["Displacement y of A (m)"][-1])
            iterations.append(int(numbers["Newton iterations"][-1]))
        curves[label] = tips, iterations
    tips, iterations = curves["u-p, PPP"]
    jump = abs(tips[-1] / tips[-4] - 1)
    bench.check(
        "nu",
        "u_y(A) at ν = 0.5 against 0.499, u-p with PPP",
        f"{100 * jump:.2f} %",
        "0.5 % (exact: 0.12 %)",
        jump < 0.005,
    )
    bench.check(
        "nu",
        "Newton iterations over ν",
        f"{min(iterations)} to {max(iterations)}",
        "differ by at most 2",
        max(iterations) - min(iterations) <= 2,
    )
    figure, axis = plt.subplots(figsize=(5, 3.4), constrained_layout=True)
    for label, (tips, _) in curves.items():
        axis.plot(range(len(tips)), tips, "o-", label=label)
    axis.set_xticks(range(len(values)), [f"{v:g}" for v in values], rotation=45)
    axis.set(xlabel="ν", ylabel="u_y(A) (m)", ylim=(0, None))
    axis.legend()
    bench.save(figure, "nu")


def load_steps(bench):
    """Steps 1, 10 and 100 times too large: after cuts the same answer, or an
    error that says so; never NaN."""
    cases = {
        "membrane, P = 10": (
            COOK,
            {
                "Grid/Subdivisions": "16, 16",
                "Boundary conditions/Traction": "right: 0, 10*t/16",
                "Grid reset/Steps between resets": 1000,
                "Quadrature/Type": "points",
            },
            0.01,
            "Displacement y of A (m)",
        ),
        "column": (
            PRM / "column" / "column.prm",
            {"Quadrature/Type": "CPDI"},
            0.01,
            "Displacement y of P (m)",
        ),
    }
    for name, (prm, overrides, step, column) in cases.items():
        answers = []
        for factor in (1, 10, 100):
            try:
                numbers = bench.run(
                    prm,
                    {**overrides, "Time/Step size": step * factor},
                    f"load steps {name} {factor}",
                )
                answers.append(numbers[column][-1])
                text = f"{answers[-1]:.6g} m, {int(sum(numbers['Step cuts']))} cuts"
                finite = np.isfinite(answers[-1])
                spread = abs(answers[-1] / answers[0] - 1)
                bench.check(
                    "load_steps",
                    f"{name}, steps {factor} times larger: {text}",
                    f"{100 * spread:.3f} %",
                    "1 %, or an error",
                    finite and spread < 0.01,
                )
            except output.OutputError as problem:
                bench.check(
                    "load_steps",
                    f"{name}, steps {factor} times larger",
                    "error: " + shortened(problem),
                    "1 %, or an error",
                    str(problem).startswith("code 1") and factor > 1,
                )


def offsets(bench):
    """The grid shifted below the body: what the place of the grid decides is
    the error bar of a result."""
    count = 8 if bench.quick else 64
    geo = PRM / "plastic_cylinder" / "ring.geo"

    n = 24
    path = bench.directory / "meshes" / "ring-8.msh"
    scenes.mesh(geo, path, n=8)
    figure, axis = plt.subplots(figsize=(5.5, 3.6), constrained_layout=True)
    h = 3.2 / n
    # the symmetry planes are grid lines; the upper ones move instead
    for number, (quadrature, points, bound) in enumerate(
        (
            ("points", 6, None),
            ("cell-filled", 6, None),
            ("cell-filled + boundary", 12, 0.03),
            ("CPDI", 4, 0.01),
        )
    ):
        loads, iterations, failures = [], [], 0
        for k in range(count):
            # sizes of the cells between 1 and 1 + 1/n of the first
            shift = (k + 0.5) / count
            upper = 3.2 + shift * h
            try:
                numbers = bench.run(
                    SCENES / "tube.prm",
                    {
                        "Quadrature/Type": quadrature,
                        "Material points/Points per cell": points,
                        "Material points/Body mesh": path,
                        "Boundary conditions/Mesh of body surfaces": path,
                        "Grid/Upper corner": f"{upper}, {3.2 + (k * 0.618 % 1) * h}",
                        "Grid/Subdivisions": f"{n}, {n}",
                        "Time/End time": 0.3,
                        "Time/Step size": 0.03,
                    },
                    f"offsets {quadrature} {k}",
                )
                stretch = 1 + np.append(0, numbers["Displacement x of bore (m)"])
                loads.append(
                    np.interp(1.25, stretch, np.append(0, numbers["Time (s)"]))
                )
                iterations.append(int(sum(numbers["Newton iterations"])))
            except output.OutputError:
                failures += 1
        exact = scenes.Tube.pressure(1.25)
        errors = 100 * (np.array(loads) / exact - 1)
        axis.plot(
            [number + 0.3 * (k / count - 0.5) for k in range(len(errors))],
            errors,
            "o",
            ms=3,
        )
        if len(errors):
            bench.check(
                "offsets",
                f"load at a stretch of 1.25, tube, {quadrature}, {count} grids: "
                f"mean {errors.mean():+.2f} %, {failures} failed, "
                f"{np.mean(iterations):.0f} iterations; standard deviation",
                f"{errors.std():.2f} %",
                f"{100 * bound:g} %" if bound else "none: reported",
                bound is None or (errors.std() < 100 * bound and not failures),
            )
    axis.set_xticks(range(4), ["points", "cell-filled", "with boundary", "CPDI"])
    axis.set(ylabel="error of the load at stretch 1.25 (%)")
    axis.axhline(0, color="k", lw=0.8)
    bench.save(figure, "offsets")


def units(bench):
    """Lengths and stresses in units from 1e-9 to 1e9: the same to rounding."""
    reference = None
    worst = 0.0
    powers = (-9, 0, 9) if bench.quick else (-9, -6, -3, 0, 3, 6, 9)
    for length in powers:
        for stress in powers:
            a, s = 10.0**length, 10.0**stress
            numbers = bench.run(
                COOK,
                {
                    "Grid/Corners": "; ".join(
                        f"{x * a:.17g}, {y * a:.17g}"
                        for x, y in ((0, 0), (48, 44), (48, 60), (0, 44))
                    ),
                    "Grid/Subdivisions": "8, 8",
                    "Material/Young modulus": f"{70 * s:.17g}",
                    "Boundary conditions/Traction": f"right: 0, {s / 16:.17g}*t",
                    "Postprocess/Point probes": f"A: {48 * a:.17g}, {60 * a:.17g}",
                    "Quadrature/Type": "points",
                },
                f"units {length} {stress}",
            )
            tip = numbers["Displacement y of A (m)"][-1] / a
            reference = reference or tip
            worst = max(worst, abs(tip / reference - 1))
    bench.check(
        "units",
        f"u_y(A) in {len(powers) ** 2} systems of units",
        f"{worst:.1e}",
        "1e-11",
        worst < 1e-11,
    )


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


def transformed_mesh(source, target, place, permuted=False, reversed_=False):
    """A copy of the gmsh file (version 2) @p source with each vertex at @p
    place(x, y); vertices and cells in another order if @p permuted. A mirror
    image has its triangles @p reversed_."""
    lines = source.read_text().split("\n")
    first = lines.index("$Nodes") + 2
    n = int(lines[first - 1])
    random = np.random.default_rng(1)
    order = random.permutation(n) if permuted else np.arange(n)
    vertices = [line.split() for line in lines[first : first + n]]
    number = {old[0]: str(k + 1) for k, old in enumerate(vertices[i] for i in order)}
    for k, i in enumerate(order):
        x, y = place(*map(float, vertices[i][1:3]))
        lines[first + k] = f"{k + 1} {x:.17g} {y:.17g} 0"
    first = lines.index("$Elements") + 2
    n = int(lines[first - 1])
    elements = []
    for line in lines[first : first + n]:
        words = line.split()
        head = 3 + int(words[2])
        corners = [number[c] for c in words[head:]]
        if reversed_ and len(corners) == 3:
            corners[1:] = reversed(corners[1:])
        elements.append((words[1:head], corners))
    if permuted:
        elements = [elements[i] for i in random.permutation(n)]
    for k, (head, corners) in enumerate(elements):
        lines[first + k] = " ".join([str(k + 1), *head, *corners])
    target.write_text("\n".join(lines))
    return target


def symmetry(bench):
    """Cook's membrane, P = 10 in five steps, with its vertices and cells (and so its
    points) in another order, turned by 90 degrees, mirrored, and moved far away: the
    same displacement to rounding."""
    meshes = bench.directory / "meshes"
    straight = scenes.mesh(
        SCENES / "cook_graded.geo",
        meshes / "graded-8.msh",
        options=("-format", "msh22"),
        n=8,
    )
    # name: (matrix, shift, permuted, bound)
    images = {
        "as it is": ((1, 0, 0, 1), 0, False, 0),
        "permuted": ((1, 0, 0, 1), 0, True, 1e-10),
        "turned by 90 degrees": ((0, -1, 1, 0), 0, False, 1e-10),
        "mirrored": ((1, 0, 0, -1), 0, False, 1e-10),
        # coordinates lose three of their digits
        "moved by 1e4 m": ((1, 0, 0, 1), 1e4, False, 1e-8),
    }
    for quadrature in ("points", "cell-filled", "CPDI"):
        tips = {}
        for name, ((a, b, c, d), shift, permuted, bound) in images.items():

            def place(x, y):
                return a * x + b * y + shift, c * x + d * y + shift

            path = transformed_mesh(
                straight,
                meshes / ("image-" + name.split()[0] + ".msh"),
                place,
                permuted,
                a * d - b * c < 0,
            )
            tip = place(48, 60)
            numbers = bench.run(
                COOK,
                {
                    "Grid/Type": "gmsh",
                    "Grid/File": path,
                    "Quadrature/Type": quadrature,
                    "Boundary conditions/Traction":
                    f"right: {b}*10*t/16, {d}*10*t/16",
                    "Material points/Points per cell": 3,
                    "Grid reset/Steps between resets": 1000,
                    "Postprocess/Point probes": f"A: {tip[0]!r}, {tip[1]!r}",
                    "Time/Step size": 0.2,
                    "Newton/Tolerance": 1e-12,
                },
                f"symmetry {quadrature} {name}",
            )
            u = [numbers[f"Displacement {k} of A (m)"][-1] for k in "xy"]
            # back to the frame of the first
            tips[name] = b * u[0] + d * u[1]
            error = abs(tips[name] / tips["as it is"] - 1)
            if bound:
                bench.check(
                    "symmetry",
                    f"u_y(A), {quadrature}, {name}",
                    f"{error:.1e}",
                    f"{bound:g}",
                    error < bound,
                )


def turned(bench):
    """Cook's membrane turned by 0 to 45 degrees over a grid that stays: the spread
    is the error bar that the direction of the grid lines gives a result."""
    n = 16 if bench.quick else 32
    angles = (0, 15, 30, 45) if bench.quick else tuple(range(0, 46, 5))
    with open(HERE / "references" / "cook_membrane.json") as stream:
        exact = json.load(stream)["results"]["nu=0.499 P=1"]["uy"]
    meshes = bench.directory / "meshes"
    straight = scenes.mesh(
        PRM / "cooks_membrane" / "membrane.geo",
        meshes / f"straight-{n}.msh",
        options=("-format", "msh22"),
        n=n,
    )
    figure, axis = plt.subplots(figsize=(5.5, 3.6), constrained_layout=True)
    for quadrature, bound in (
        ("points", None),
        ("cell-filled", None),
        ("cell-filled + boundary", 0.02),
        ("CPDI", 0.02),
    ):
        errors, failures = [], 0
        for degrees in angles:
            angle = np.radians(degrees)
            c, s = np.cos(angle), np.sin(angle)
            path = transformed_mesh(
                straight,
                meshes / f"turned-{n}-{degrees}.msh",
                lambda x, y: (
                    24 + c * (x - 24) - s * (y - 30),
                    30 + s * (x - 24) + c * (y - 30),
                ),
            )
            # the coordinate along the membrane, from the clamped side
            along = f"24 + ({c:.17g})*(x-24) + ({s:.17g})*(y-30)"
            tip = (24 + c * 24 - s * 30, 30 + s * 24 + c * 30)
            try:
                numbers = bench.run(
                    PRM / "cooks_membrane" / "large_load.prm",
                    {
                        "Quadrature/Type": quadrature,
                        "Material/Poisson ratio": 0.499,
                        "Material points/Body mesh": path,
                        "Grid/Lower corner": "-22.3, -15.7",
                        "Grid/Upper corner": "69.7, 76.3",
                        "Grid/Subdivisions": f"{92 * n // 48}, {92 * n // 48}",
                        "Boundary conditions/Displacement": "",
                        "Boundary conditions/Mesh of body surfaces": path,
                        "Boundary conditions/Surfaces of body":
                        f"clamp: if({along} < 1e-3, 1, 0); "
                        f"end: if({along} > 47.999, 1, 0)",
                        "Boundary conditions/Displacement of body": "clamp: x=0, y=0",
                        "Boundary conditions/Traction on body":
                        f"end: {-s:.17g}*t/16, {c:.17g}*t/16",
                        "Postprocess/Point probes": f"A: {tip[0]:.17g}, {tip[1]:.17g}",
                        "Time/Step size": 1,
                    },
                    f"turned {quadrature} {degrees}",
                )
                u = [numbers[f"Displacement {d} of A (m)"][-1] for d in "xy"]
                errors.append(100 * ((-s * u[0] + c * u[1]) / exact - 1))
            except output.OutputError:
                failures += 1
        axis.plot(angles[: len(errors)], errors, "o-", ms=3, label=quadrature)
        if errors:
            spread = np.std(errors)
            bench.check(
                "turned",
                f"u_y(A), n = {n}, {quadrature}, {len(angles)} directions: mean "
                f"{np.mean(errors):+.2f} %, {failures} failed; standard deviation",
                f"{spread:.2f} %",
                f"{100 * bound:g} %" if bound else "none: reported",
                bound is None or (spread < 100 * bound and not failures),
            )
    axis.set(xlabel="angle (degrees)", ylabel="error of u_y(A) (%)")
    axis.axhline(0, color="k", lw=0.8)
    axis.legend(fontsize=7)
    bench.save(figure, "turned")


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


def fuzz(bench):
    """Random scenes: each ends well, with finite numbers, or with an error that
    names a parameter or says what to do. Bad seeds go to fuzz_bad_seeds.txt."""
    count = 20 if bench.quick else bench.arguments.scenes
    bad, ended_well = [], 0
    for seed in range(bench.arguments.first_seed, bench.arguments.first_seed + count):
        overrides = random_scene(np.random.default_rng(seed))
        run = harness.Run(
            "", f"fuzz {seed}", 0, SCENES / "fuzz.prm", {**QUIET, **overrides}
        )
        place = bench.directory / "runs" / run.name
        try:
            harness.execute(
                bench.arguments.executable, run, place, harness.Cost([], []), 120
            )
            numbers = output.read_statistics(place)
            finite = all(
                np.all(np.isfinite(column))
                for column in numbers.values()
                if column.dtype.kind == "f"
            )
            last = numbers["Time (s)"][-1]
            ended_well += 1
            if not finite or last < 0.999:
                bad.append((seed, "not finite or not at its end"))
        except output.OutputError as problem:
            text = (place / "isochor.log").read_text(errors="replace")
            says = re.search(r"isochor: error: .{40,}", text, re.DOTALL)
            if "code 124" in str(problem):
                bad.append((seed, "more than two minutes"))
            elif not says or "nan" in text.lower().split("isochor: error")[0]:
                bad.append((seed, " ".join(text.split()[-40:])))
            elif "An error occurred in" in text or "Stacktrace" in text:
                bad.append((seed, "an assertion: " + " ".join(text.split()[-40:])))
        if (seed + 1) % 50 == 0:
            print(f"fuzz: {seed + 1} scenes, {len(bad)} bad", flush=True)
    with open(bench.directory / "fuzz_bad_seeds.txt", "w") as stream:
        for seed, why in bad:
            stream.write(f"{seed}: {why}\n")
    bench.check(
        "fuzz",
        f"{count} random scenes from seed {bench.arguments.first_seed}: "
        f"{ended_well} ended well, {count - ended_well - len(bad)} with a clear "
        "error; neither of both",
        str(len(bad)),
        "0",
        not bad,
    )


def random_scene(random):
    """Overrides of scenes/fuzz.prm."""

    def pick(*choices):
        return choices[random.integers(len(choices))]

    form = pick("u", "u-p")
    nu_ = pick(0.0, 0.3, 0.45, 0.499, 0.5) if form == "u-p" else pick(0, 0.3, 0.49)
    scene = {
        "Formulation/Type": form,
        "Formulation/Stabilisation": pick("PPP", "PPP", "none")
        if form == "u-p"
        else "none",
        "Material/Poisson ratio": nu_,
        "Material/Model": pick("Neo-Hookean", "J2", "Mohr-Coulomb"),
        "Material/J2/Yield stress": pick(1.0, 10.0, 1e3),
        "Material/Mohr-Coulomb/Cohesion": pick(1.0, 10.0),
        "Material/Mohr-Coulomb/Friction angle": pick(0, 20, 35),
        "Quadrature/Type": pick(
            "points", "cell-filled", "cell-filled + boundary", "CPDI"
        ),
        "Material points/Points per cell": pick(1, 3, 4, 6, 9, 12),
        "Grid/Subdivisions": f"{random.integers(3, 20)}, {random.integers(3, 20)}",
        "Grid/Diagonals": pick("/", "backslash", "alternating"),
        "Grid reset/Steps between resets": pick(1, 1, 3, 1000),
        "Boundary conditions/Gravity": f"0, {-random.uniform(0, 3):.3f}*t",
        "Dynamics/Inertia": pick("false", "false", "true"),
        "Time/Step size": pick(0.05, 0.1, 0.5, 1),
    }
    if random.random() < 0.5:
        x, y, r = random.uniform(0.6, 1.4), random.uniform(0.3, 1.2), random.uniform(
            0.1, 0.7
        )
        scene["Material points/Region"] = (
            f"if((x-{x:.3f})^2+(y-{y:.3f})^2 < {r:.3f}^2 || y < 0.3, 1, 0)"
        )
    else:
        scene["Material points/Region"] = (
            f"if(x < {random.uniform(0.3, 2):.3f} && y < {random.uniform(0.2, 1.5):.3f}, 1, 0)"
        )
    scene["Boundary conditions/Displacement"] = "bottom: x=0, y=0" + pick(
        "", "; left: x=0", "; left: x>=0; right: x<=0", "; right: x=-0.1*t"
    )
    return scene


TESTS = {
    test.__name__: test
    for test in (
        alpha,
        nu,
        load_steps,
        offsets,
        turned,
        symmetry,
        units,
        cut,
        strain,
        shear,
        cycles,
        fuzz,
    )
}


# ------------------------------------------------------------------- main ---


def page(bench):
    parts = []
    for name, found in bench.results.items():
        body = [
            (what, value, bound, "yes" if kept else "**no**")
            for what, value, bound, kept in found
        ]
        text = f"### {name}\n\n{' '.join(TESTS[name].__doc__.split())}\n\n"
        text += report.table(("what", "measured", "bound", "kept"), body)
        if (bench.directory / f"stability_{name}.png").exists():
            text += f"\n\n![{name}](benchmarks/results/stability_{name}.png)"
        parts.append(text)
    return parts


def main():
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--quick", action="store_true")
    parser.add_argument("--only", action="append", choices=list(TESTS))
    parser.add_argument("--executable")
    parser.add_argument("--scenes", type=int, default=1000, help="of the fuzzer")
    parser.add_argument("--first-seed", type=int, default=0)
    parser.add_argument("--directory", type=Path, default=Path("output-stability"))
    parser.add_argument("--publish", action="store_true")
    arguments = parser.parse_args()
    arguments.directory = arguments.directory.resolve()
    arguments.directory.mkdir(parents=True, exist_ok=True)
    arguments.executable = os.path.abspath(
        arguments.executable or output.find_executable()
    )
    bench = Bench(arguments)
    start = time.time()
    for name in arguments.only or TESTS:
        try:
            TESTS[name](bench)
        except output.OutputError as problem:
            bench.check(name, "runs", shortened(problem), "", False)
    parts = page(bench)
    (arguments.directory / "stability.md").write_text("\n\n".join(parts) + "\n")
    if arguments.publish:
        results = HERE / "results"
        results.mkdir(exist_ok=True)
        for path in arguments.directory.glob("stability_*.*"):
            shutil.copy(path, results / path.name)
        for name, part in zip(bench.results, parts):
            report.insert(HERE.parent / "stability.md", f"stability {name}", part)
    missed = sum(not kept for found in bench.results.values() for *_, kept in found)
    print(f"{missed} bounds not kept, {(time.time() - start) / 60:.1f} minutes")
    return 1 if missed else 0


if __name__ == "__main__":
    sys.exit(main())
