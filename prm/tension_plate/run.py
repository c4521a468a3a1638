#!/usr/bin/env python3
# Isochor: implicit, stabilised mixed Material Point Method on deal.II.
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Mesh the tension plate, run all cases and draw the figures.

    run.py [--h 0.001] [--directory output] [--grid-at-rest]

Needs gmsh. The four cases are u and u-p + PPP, nu = 0.33 and 0.4999. With
--grid-at-rest the last is also pulled at its own surface on a grid at rest.
"""

import argparse
import subprocess
import sys
from pathlib import Path

SCENE = Path(__file__).resolve().parent
sys.path.insert(0, str(SCENE.parent / "tools"))

import isochor_output as output  # noqa: E402

FORMULATIONS = {"u": ("u", "none"), "u-p": ("u-p", "PPP")}


def run_cases(directory, arguments):
    """Labels and output directories of the four cases."""
    mesh = directory / "plate.msh"
    output.make_mesh(SCENE / "plate.geo", mesh, h=arguments.h)
    cases = []
    for poisson_ratio in ("0.33", "0.4999"):
        for name, (form, stabilisation) in FORMULATIONS.items():
            case = directory / f"{name}-{poisson_ratio}"
            overrides = {
                "Grid/File": mesh,
                "Formulation/Type": form,
                "Formulation/Stabilisation": stabilisation,
                "Material/Poisson ratio": poisson_ratio,
            }
            print(f"{name}, nu = {poisson_ratio}", flush=True)
            scene = SCENE / "tension_plate.prm"
            output.run(scene, overrides, directory=case, check=True)
            cases.append((f"{name}, $\\nu$ = {poisson_ratio}", case))
    return cases


def run_on_grid_at_rest(directory, arguments):
    """The plate that leaves the grid's nodes; prints both reactions."""
    mesh = directory / "plate_room.msh"
    room = max(0.004, 2 * arguments.h)
    output.make_mesh(SCENE / "plate.geo", mesh, h=arguments.h, room=room)
    statistics = output.run(
        SCENE / "grid_at_rest.prm",
        {"Grid/File": mesh},
        directory=directory / "grid-at-rest",
        check=True,
    ).statistics
    top = statistics["Force y on top by place (N)"][-1]
    bottom = statistics["Reaction y on bottom (N)"][-1]
    print(f"grid at rest: top {top:.6e} N, bottom by nodes {bottom:.6e} N")


def main():
    parser = argparse.ArgumentParser(
        description=__doc__.split("\n", maxsplit=1)[0]
    )
    parser.add_argument("--h", type=float, default=0.001, help="edge length (m)")
    parser.add_argument("--directory", type=Path, default=Path("output"))
    parser.add_argument("--grid-at-rest", action="store_true")
    arguments = parser.parse_args()
    directory = arguments.directory.resolve()
    directory.mkdir(parents=True, exist_ok=True)

    cases = run_cases(directory, arguments)
    if arguments.grid_at_rest:
        run_on_grid_at_rest(directory, arguments)
    command = [sys.executable, str(SCENE / "plot.py")]
    command += [f"{label}={case}" for label, case in cases]
    command += ["--figures", str(directory)]
    return subprocess.run(command).returncode


if __name__ == "__main__":
    try:
        sys.exit(main())
    except output.OutputError as problem:
        sys.exit(f"Error: {problem}")
