#!/usr/bin/env python3
# Isochor: implicit, stabilised mixed Material Point Method on deal.II.
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Mesh the strip footing, run the cases asked for and draw the figures.

    run.py [--h 0.05] [--step 0.005] [--directory output] [CASE ...]

Needs gmsh. A case that ends early is reported and drawn as far as it came.
"""

import argparse
import subprocess
import sys
from pathlib import Path

SCENE = Path(__file__).resolve().parent
sys.path.insert(0, str(SCENE.parent / "tools"))

import isochor_output as output  # noqa: E402

HELD = "bottom: x=0, y=0; axis: x=0; far: x=0; "
# What each case changes in strip_footing.prm.
CASES = {
    "u-p, PPP": {},
    "u-p": {"Formulation/Stabilisation": "none"},
    "u": {
        "Formulation/Type": "u",
        "Formulation/Stabilisation": "none",
    },
    "smooth base": {
        "Boundary conditions/Displacement": HELD
        + "footing: y=-t"
    },
    "shaft that holds": {
        "Boundary conditions/Displacement": HELD
        + "shaft: x=0; footing: x=0, y=-t"
    },
    # the method of the paper, without a remedy
    "plain": {
        "Quadrature/Type": "points",
        "Material points/Points per cell": "12",
    },
}


def run_cases(directory, arguments):
    """Labels and output directories of the cases that made a step."""
    mesh = directory / "footing.msh"
    sizes = {
        name: float(getattr(arguments, name))
        for name in ("h", "h_far", "h_edge", "uniform")
    }
    output.make_mesh(SCENE / "footing.geo", mesh, **sizes)
    done = []
    for name in arguments.cases:
        case = directory / name.replace(", ", "-").replace(" ", "-")
        print(name, flush=True)
        overrides = {
            "Grid/File": mesh,
            "Time/Step size": arguments.step,
            **CASES[name],
        }
        run = output.run(SCENE / "strip_footing.prm", overrides, directory=case)
        if run.error:
            print(f"{name} ended early: {run.error}")
        if (case / "points.pvd").exists():
            done.append((name, case))
    return done


def parse_arguments():
    parser = argparse.ArgumentParser(
        description=__doc__.split("\n", maxsplit=1)[0]
    )
    parser.add_argument("--h", type=float, default=0.05, help="edge length (m)")
    parser.add_argument("--h-far", type=float, default=0.3, help="far away (m)")
    parser.add_argument(
        "--h-edge", type=float, help="at the edge of the footing (m), default: h"
    )
    parser.add_argument(
        "--uniform", action="store_true", help="edge length h in all of the soil"
    )
    parser.add_argument(
        "--step", type=float, default=0.005, help="settlement per step (m)"
    )
    parser.add_argument("--directory", type=Path, default=Path("output"))
    parser.add_argument(
        "cases",
        nargs="*",
        metavar="CASE",
        help="of: " + "; ".join(CASES) + ". Default: u-p, PPP",
    )
    arguments = parser.parse_args()
    arguments.h_edge = arguments.h_edge or arguments.h
    arguments.cases = arguments.cases or ["u-p, PPP"]
    for name in arguments.cases:
        if name not in CASES:
            parser.error(f"unknown case '{name}'; known: " + "; ".join(CASES))
    return arguments


def main():
    arguments = parse_arguments()
    directory = arguments.directory.resolve()
    directory.mkdir(parents=True, exist_ok=True)
    cases = run_cases(directory, arguments)
    if not cases:
        return 1
    command = [sys.executable, str(SCENE / "plot.py")]
    command += [f"{label}={case}" for label, case in cases]
    command += ["--inset", str(arguments.h_edge / 2), "--figures", str(directory)]
    return subprocess.run(command).returncode


if __name__ == "__main__":
    try:
        sys.exit(main())
    except output.OutputError as problem:
        sys.exit(f"Error: {problem}")
