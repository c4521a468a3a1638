#!/usr/bin/env python3
# Isochor: implicit, stabilised mixed Material Point Method on deal.II.
# SPDX-License-Identifier: LGPL-2.1-or-later
"""The settling column with all quadratures: run, compare with the exact
solution, draw.

Prints the L2 error of the vertical stress and the error of the settlement over
the grid's size, and writes convergence.png and convergence.svg. Ends with
code 1 if a run fails or a quadrature that should converge doesn't.
"""

import argparse
import sys
import time
from pathlib import Path

SCENE = Path(__file__).resolve().parent
sys.path.insert(0, str(SCENE.parent / "tools"))

import grids  # noqa: E402
import isochor_output as output  # noqa: E402
import numpy as np  # noqa: E402

HEIGHT, WIDTH, GRAVITY, YOUNG = 50.0, 6.25, 10.0, 1e4
QUADRATURES = {  # name: points per cell
    "points": 6,
    "cell-filled": 6,
    "cell-filled + boundary": 4,
    "CPDI": 4,
}
FORMULATIONS = {  # Poisson ratio, density (kg/m^3)
    "u": (0.0, 80.0),
    "u-p": (0.33, 80.0),
}
GRIDS = ("aligned", "unaligned", "jittered", "gmsh")
STRESS = "L2 error of stress yy"
# Six metres below the top: a probe at the surface may leave the points behind.
PROBE, PROBE_COLUMN = 44.0, "Displacement y of P (m)"


def exact_settlement(poisson_ratio, density):
    """Settlement (m) of the probe in the Neo-Hookean column.

    In confined compression with the stretch l the law gives
        s(l) = K (l - 1) + 2/3 G l^(-5/3) (l^2 - 1),
    and equilibrium s = - density g (H - Y) at the place Y at rest. The
    settlement is the integral of 1 - l from the base to the probe.
    """
    shear = YOUNG / (2 * (1 + poisson_ratio))
    bulk = YOUNG / (3 * (1 - 2 * poisson_ratio))
    weight = density * GRAVITY

    def stress(stretch):
        return bulk * (stretch - 1) + 2 / 3 * shear * stretch ** (-5 / 3) * (
            stretch**2 - 1
        )

    nodes, weights = np.polynomial.legendre.leggauss(200)
    place = 0.5 * PROBE * (nodes + 1)
    stretch = np.ones_like(place)
    for _ in range(100):  # the stress is concave and monotone: from above
        step = 1e-7
        slope = (stress(stretch + step) - stress(stretch - step)) / (2 * step)
        residual = stress(stretch) + weight * (HEIGHT - place)
        stretch = np.maximum(stretch - residual / slope, 0.2 * stretch)
    return 0.5 * PROBE * np.sum(weights * (1 - stretch))


def grid_overrides(kind, n, directory):
    """Parameters of a grid of n cells over the height of the body."""
    columns = max(1, round(n * WIDTH / HEIGHT))
    if kind in ("jittered", "gmsh"):
        path = directory / f"{kind}-n{n}.msh"
        if kind == "gmsh":
            grids.write_free(path, n)
        else:
            grids.write_jittered(path, columns, n, WIDTH, HEIGHT)
        return {"Grid/Type": "gmsh", "Grid/File": path}
    # unaligned: the body ends inside of cells, and the points lie on a lattice
    height = HEIGHT * (1.07 if kind == "unaligned" else 1.0)
    overrides = {
        "Grid/Subdivisions": f"{columns}, {n}",
        "Grid/Upper corner": f"{WIDTH}, {height}",
    }
    if kind == "unaligned":
        overrides["Material points/Lattice spacing"] = WIDTH / columns / 2
        overrides["Material points/Region"] = f"if(y<{HEIGHT}, 1, 0)"
    return overrides


def run_case(arguments, formulation, quadrature, n):
    """Relative L2 error of the stress, and of the settlement, and the run's
    wall time (s)."""
    poisson_ratio, density = FORMULATIONS[formulation]
    overrides = {
        **grid_overrides(arguments.grid, n, arguments.output_directory),
        "Material points/Points per cell": QUADRATURES[quadrature],
        "Quadrature/Type": quadrature,
        "Formulation/Type": formulation,
        "Formulation/PPP coefficient": 0.1,
        "Material/Poisson ratio": poisson_ratio,
        "Material/Density": density,
        "Time/Step size": 1 / arguments.steps,
        "Time/Output interval": 1,
        "Postprocess/Write grid": "false",
        "Postprocess/Exact stress": f"yy: -{density * GRAVITY}*t*({HEIGHT}-y)",
        **dict(setting.split("=", 1) for setting in arguments.set),
    }
    name = f"{arguments.grid}-{formulation}-{quadrature}-n{n}".replace(" ", "")
    start = time.perf_counter()
    directory = output.run(
        arguments.executable,
        SCENE / "column.prm",
        overrides,
        arguments.output_directory / name,
        arguments.processes,
    )
    wall_time = time.perf_counter() - start
    statistics = output.read_statistics(directory)
    settlement = exact_settlement(poisson_ratio, density)
    return (
        statistics[STRESS][-1],
        -statistics[PROBE_COLUMN][-1] / settlement - 1,
        wall_time,
    )


def draw(results, sizes, directory):
    """Stress error over the grid's size."""
    plt = output.plt
    figure, axes = plt.subplots(1, 2, figsize=(8, 3.4), sharey=True)
    for axis, formulation in zip(axes, FORMULATIONS):
        for quadrature, colour in zip(QUADRATURES, output.LINE_COLOURS):
            errors = [
                results.get((formulation, quadrature, n), (np.nan,))[0]
                for n in sizes
            ]
            axis.loglog(sizes, errors, "o-", color=colour, label=quadrature)
        axis.set(title=formulation, xlabel="cells over the height")
    axes[0].set_ylabel(r"relative $L_2$ error of $\sigma_{yy}$")
    axes[0].legend()
    figure.tight_layout()
    for suffix in ("png", "svg"):
        figure.savefig(directory / f"convergence.{suffix}")


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--executable", default=None)
    parser.add_argument("--output-directory", type=Path, default=Path("output"))
    parser.add_argument("--processes", type=int, default=1)
    parser.add_argument("--sizes", default="8,16,32,64,128")
    parser.add_argument("--steps", type=int, default=40)
    parser.add_argument("--formulations", default=",".join(FORMULATIONS))
    parser.add_argument("--quadratures", default=",".join(QUADRATURES))
    parser.add_argument("--grid", choices=GRIDS, default="aligned")
    parser.add_argument(
        "--set",
        action="append",
        default=[],
        metavar="SECTION/NAME=VALUE",
        help="any other parameter; may be repeated",
    )
    arguments = parser.parse_args()
    arguments.executable = arguments.executable or output.find_executable()
    arguments.output_directory.mkdir(parents=True, exist_ok=True)
    sizes = [int(n) for n in arguments.sizes.split(",")]

    results, failures = {}, []
    for formulation in arguments.formulations.split(","):
        print(f"{formulation}: stress error (settlement error in %), time")
        print(" " * 24 + "".join(f"{n:>26}" for n in sizes))
        for quadrature in arguments.quadratures.split(","):
            row = f"{quadrature:24}"
            for n in sizes:
                try:
                    result = run_case(arguments, formulation, quadrature, n)
                    results[formulation, quadrature, n] = result
                    row += f"{result[0]:9.5f} ({100 * result[1]:+6.2f})"
                    row += f"{result[2]:6.1f} s"
                except output.OutputError as error:
                    failures.append(f"{formulation}, {quadrature}, {n}: {error}")
                    row += f"{'failed':>26}"
            print(row, flush=True)
            errors = [
                results[formulation, quadrature, n][0]
                for n in sizes
                if (formulation, quadrature, n) in results
            ]
            if quadrature == "points" or len(errors) < 2:
                continue
            order = np.log2(errors[0] / errors[-1]) / np.log2(
                sizes[-1] / sizes[0]
            )
            if not order > 0.8:
                failures.append(
                    f"{formulation}, {quadrature}: convergence of order "
                    f"{order:.2f} only"
                )
    draw(results, sizes, arguments.output_directory)
    for failure in failures:
        print(failure, file=sys.stderr)
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
