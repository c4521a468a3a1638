# Isochor: implicit, stabilised mixed Material Point Method on deal.II.
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Stress tests: what must not matter: the place in the grid, units, numbering, axes."""

import json

import harness
import numpy as np
import scenes
from bench import COOK, SCENES, plt
from harness import HERE, PRM, output


def offsets(bench):
    """The grid shifted below the body: what the place of the grid decides is
    the error bar of a result."""
    count = 8 if bench.quick else 64
    geo = PRM / "plastic_cylinder" / "ring.geo"

    n = 24
    path = bench.directory / "meshes" / "ring-8.msh"
    harness.mesh(geo, path, n=8)
    figure, axis = plt.subplots(figsize=(5.5, 3.6), constrained_layout=True)
    h = 3.2 / n
    # the symmetry planes are grid lines; the upper ones move instead
    for number, (quadrature, points, bound) in enumerate(
        (
            ("points", 6, None),
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
    axis.set_xticks(range(2), ["points", "CPDI"])
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
    straight = harness.mesh(
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
    for quadrature in ("points", "CPDI"):
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
    straight = harness.mesh(
        PRM / "cooks_membrane" / "membrane.geo",
        meshes / f"straight-{n}.msh",
        options=("-format", "msh22"),
        n=n,
    )
    figure, axis = plt.subplots(figsize=(5.5, 3.6), constrained_layout=True)
    # only CPDI has surfaces that can be held beside the grid's
    for quadrature, bound in (("CPDI", 0.02),):
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
                        "Interaction: clamp - place/Displacement": "x=0, y=0",
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
