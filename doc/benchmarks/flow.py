#!/usr/bin/env python3
# Isochor: implicit, stabilised mixed Material Point Method on deal.II.
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Large plastic flow with all defaults: run the scenes, print a table.

    flow.py [--executable isochor] [--directory flow] [--quick] [scene ...]

Needs gmsh, numpy and the program. For each run: what was found beside what is
right, the spread of det F of the points (the shapes of their domains), iterations of
Newton's method per step, steps that were cut, CPU seconds.
"""

import argparse
import sys
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

HERE = Path(__file__).resolve().parent
SCENES = HERE / "scenes"
ROOT = HERE.parents[1]
sys.path.insert(0, str(ROOT / "prm" / "tools"))

import isochor  # noqa: E402


@dataclass(frozen=True)
class Flow:
    """A run: @p measures are tuples of what is measured, a function of the
    statistics, and what is right. @p mesh: name of
    a .geo and its numbers. Not in a quick suite: @p full."""

    name: str
    scene: Path
    measures: tuple
    overrides: dict = field(default_factory=dict)
    mesh: tuple = ()
    full: bool = False


def last(column, factor=1, offset=0):
    return lambda columns: offset + factor * columns[column][-1]


def at(time, column, factor=1):
    def value(columns):
        times = columns["Time (s)"]
        return factor * columns[column][np.argmin(abs(times - time))]

    return value


def mean_after(time, column, factor):
    def value(columns):
        is_after = columns["Time (s)"] > time
        if not is_after.any():
            return float("nan")
        weights = columns["Step size (s)"][is_after]  # of cut steps, too
        return factor * np.average(abs(columns[column][is_after]), weights=weights)

    return value


def necking(n, steps, full, kept=False):
    # references: necking_calculix.py
    return Flow(
        f"necking, {n} cells over the radius, {steps} steps"
        + (", grid never reset" if kept else ""),
        SCENES / "necking.prm",
        (
            ("u_r of the neck at 3.5 mm (mm)",
             at(0.5, "Displacement x of neck (m)"), "-0.847"),
            ("at 7 mm", last("Displacement x of neck (m)"), "-4.36"),
            ("force (kN)", last("Reaction y on bottom (N)", -1e-3), "17.5"),
        ),
        {"Time/Step size": 1 / steps} | ({"Grid reset/Steps between resets": 0} if kept else {}),
        ("necking", {"n": n}),
        full,
    )


def extrusion(cells):
    return Flow(
        f"extrusion, {cells} cells on the die",
        SCENES / "extrusion.prm",
        (
            ("force / slip lines', mean of t > 0.2",
             mean_after(0.2, "Reaction x on die (N)", 1 / 257.1), "1"),
        ),
        mesh=("extrusion", {"n": 2 * cells}),
        full=True,
    )


def heavy_footing(cells):
    return Flow(
        f"footing on soil with weight and friction, {cells} cells on its half",
        SCENES / "heavy_footing.prm",
        (
            ("force / exact",
             last("Force y on body by boundary footing (N)", -1 / 153.06), "1"),
        ),
        mesh=("heavy_footing", {"n": cells}),
        full=cells > 10,
    )


def tube_ratio(columns):
    """The force over its closed form, after the first steps."""
    a = 1 + columns["Time (s)"]
    exact = a * 2e4 / np.sqrt(3) * np.log(np.sqrt(3 + a**2) / a)
    return (abs(columns["Force x on bore by place (N)"]) / exact)[a > 1.05]


def tube(name, overrides):
    return Flow(
        "tube, bore widened to twice" + name,
        SCENES / "tube_in_flow.prm",
        (
            ("force / exact, least", lambda columns: tube_ratio(columns).min(), "1"),
            ("largest", lambda columns: tube_ratio(columns).max(), "1"),
        ),
        overrides,
    )


def spherical_cavity(cells, full):
    name = "Force y on cavity by place (N)"
    return Flow(
        f"spherical cavity, {cells} cells over its radius",
        SCENES / "cavity_sphere.prm",
        (
            ("pressure / exact at twice its radius", at(0.5, name, 1 / 60.544), "1"),
            ("at three times", last(name, 1 / 97.684), "1"),
        ),
        {"Grid/Subdivisions": f"{9 * cells}, {9 * cells}"},
        full=full,
    )


FLOWS = (
    necking(10, 100, False),
    necking(10, 25, True),
    necking(10, 400, True),
    necking(20, 100, True),
    necking(20, 100, True, kept=True),
    Flow(
        "Taylor bar, 8 cells over the radius",
        SCENES / "taylor_bar.prm",
        (
            ("length (mm)",
             last("Displacement y of head (m)", 1e3, 32.4), "21.2 to 21.7"),
            ("radius (mm)",
             last("Displacement x of foot (m)", 1e3, 3.2), "6.9 to 7.2"),
            ("energy lost (J)", last("Energy lost by the scheme (J)"), "240 J in all"),
        ),
    ),
    Flow(
        "slump",
        SCENES / "slump.prm",
        (("crest (m)", last("Displacement y of crest (m)"), "no reference"),),
        full=True,
    ),
    Flow(
        "cylindrical cavity, 4 cells over its radius",
        SCENES / "cavity_cylinder.prm",
        (
            ("pressure / exact at three times its radius",
             last("Force x on cavity by place (N)", 1 / 35.946), "1"),
        ),
    ),
    tube("", {}),
    tube(", E/σ_Y = 1000", {"Material/Young modulus": 1e7}),
    tube(", quarter steps", {"Time/Step size": 0.0025}),
    tube(", grid never reset", {"Grid reset/Steps between resets": 0}),
    spherical_cavity(4, False),
    spherical_cavity(8, True),
    Flow(
        "shear to ten times the height",
        SCENES / "shear_flow.prm",
        (("shear stress / strength", last("Force x on top by place (N)"), "1"),),
    ),
    heavy_footing(7),
    heavy_footing(13),
    extrusion(8),
    extrusion(16),
    Flow(
        "rigid footing to w/B = 0.5",
        ROOT / "prm/footing_rigid/footing_rigid.prm",
        (("q/c_u", last("Force y on body by footing (N)", -2e-3), "5.94 (finite elements)"),),
        {"Time/End time": 0.5},
        full=True,
    ),
    Flow(
        "ring to half of its height",
        ROOT / "prm/ring_compression/ring_compression.prm",
        (("force (N)", last("Reaction y on bottom (N)"), "no reference"),),
        {"Time/End time": 0.5},
        full=True,
    ),
)


def execute(flow, arguments):
    """The Run."""
    place = arguments.directory / "".join(
        c if c.isalnum() else "_" for c in flow.name
    )
    overrides = {
        **flow.overrides,
        "Postprocess/Write grid": False,
        "Postprocess/Write material points": False,
        "Output/Terminal": "quiet",
    }
    if flow.mesh:
        geometry, numbers = flow.mesh
        mesh = place / (geometry + ".msh")
        overrides["Grid/File"] = isochor.make_mesh(
            SCENES / (geometry + ".geo"), mesh, **numbers
        )
    return isochor.run(flow.scene, overrides, arguments.executable, place)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--executable", default="isochor")
    parser.add_argument("--directory", type=Path, default=Path("flow"))
    parser.add_argument("--quick", action="store_true", help="without the long ones")
    parser.add_argument("scenes", nargs="*", help="beginnings of their names")
    arguments = parser.parse_args()
    print("| scene | measured | right | det F | Newton | cuts | CPU, s |")
    print("|---|---|---|---|---|---|---|")
    failed = False
    for flow in FLOWS:
        if arguments.quick and flow.full:
            continue
        if arguments.scenes and not flow.name.startswith(tuple(arguments.scenes)):
            continue
        run = execute(flow, arguments)
        columns = run.statistics
        failed = failed or bool(run.error)
        ends = columns["Time (s)"][-1]
        found = "; ".join(
            f"{what}: {measure(columns):.4g}" for what, measure, _ in flow.measures
        )
        if run.error:
            found += f" (ends with an error at t = {ends:.3g})"
        right = "; ".join(value for _, _, value in flow.measures)
        iterations = columns["Newton iterations"]
        print(
            f"| {flow.name} | {found} | {right} "
            f"| {columns['Smallest J'][-1]:.2f} to {columns['Largest J'][-1]:.2f} "
            f"| {sum(iterations) / len(iterations):.1f} "
            f"| {columns['Step cuts'][-1]:.0f} | {run.cpu:.0f} |",
            flush=True,
        )
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
