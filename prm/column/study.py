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
from pathlib import Path

SCENE = Path(__file__).resolve().parent
sys.path.insert(0, str(SCENE.parent / "tools"))

import grids  # noqa: E402
import isochor_output as output  # noqa: E402
import numpy as np  # noqa: E402

HEIGHT, WIDTH, GRAVITY, YOUNG = 50.0, 6.25, 10.0, 1e4
QUADRATURES = {  # name: points per cell
    "points": 6,
    "CPDI": 4,
}
# formulation, Poisson ratio, density (kg/m^3), PPP coefficient, steps between
# two resets of the grid
CASES = {
    "u": ("u", 0.0, 80.0, 0.1, 1),
    "u-p": ("u-p", 0.33, 80.0, 0.1, 1),
    # nearly incompressible and so heavy, density g H = 250 G, that it settles
    # by a quarter all the same
    "heavy": ("u-p", 0.499, 1667.8, 0.05, 4),
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
            output.make_mesh(SCENE / "column.geo", path, n=n)
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


def case_name(grid, case, quadrature, n):
    """Of the directory of a run."""
    return f"{grid}-{case}-{quadrature}-n{n}".replace(" ", "")


def run_case(arguments, case, quadrature, n):
    """Relative L2 errors of stress and settlement; wall time of the run (s)."""
    formulation, poisson_ratio, density, alpha, interval = CASES[case]
    overrides = {
        **grid_overrides(arguments.grid, n, arguments.output_directory),
        "Material points/Points per cell": QUADRATURES[quadrature],
        "Quadrature/Type": quadrature,
        "Formulation/Type": formulation,
        "Formulation/PPP coefficient": alpha,
        "Grid reset/Steps between resets": interval,
        "Material/Poisson ratio": poisson_ratio,
        "Material/Density": density,
        "Time/Step size": 1 / arguments.steps,
        "Time/Output interval": 1,
        "Postprocess/Write grid": "false",
        "Postprocess/Exact stress": f"yy: -{density * GRAVITY}*t*({HEIGHT}-y)",
        **dict(setting.split("=", 1) for setting in arguments.set),
    }
    name = case_name(arguments.grid, case, quadrature, n)
    run = output.run(
        SCENE / "column.prm",
        overrides,
        arguments.executable,
        arguments.output_directory / name,
        arguments.processes,
        check=True,
    )
    statistics = run.statistics
    settlement = exact_settlement(poisson_ratio, density)
    return (
        statistics[STRESS][-1],
        -statistics[PROBE_COLUMN][-1] / settlement - 1,
        run.wall,
    )


def draw_stress(axis, case, n, directory):
    """Stress of the points of two quadratures along the height at rest."""
    density = CASES[case][2]
    for quadrature in ("points", "CPDI"):
        run = directory / case_name("aligned", case, quadrature, n)
        if not (run / "points.pvd").is_file():
            continue
        points = output.read_points(run)
        place = points["position"][:, 1] - points["displacement"][:, 1]
        colour = output.LINE_COLOURS[list(QUADRATURES).index(quadrature)]
        stress = 1e-3 * output.field(points, "cauchy_stress_yy")
        axis.plot(stress, place, ".", ms=2, color=colour, label=quadrature)
    exact = -1e-3 * density * GRAVITY * HEIGHT
    axis.plot([exact, 0], [0, HEIGHT], "k-", lw=1, label="exact")
    axis.set(
        title=f"{case}, n = {n}",
        xlabel=r"$\sigma_{yy}$ (kPa)",
        ylabel="height at rest (m)",
    )
    axis.legend(markerscale=4)


def draw(results, sizes, directory):
    """Stress error over the grid's size, and a stress along the height."""
    cases = [case for case in CASES if any(key[0] == case for key in results)]
    plt = output.plt
    figure, axes = plt.subplots(
        1, len(cases) + 1, figsize=(3.6 * (len(cases) + 1), 3.4)
    )
    for axis, case in zip(axes, cases):
        for quadrature, colour in zip(QUADRATURES, output.LINE_COLOURS):
            errors = [
                results.get((case, quadrature, n), (np.nan,))[0] for n in sizes
            ]
            axis.loglog(sizes, errors, "o-", color=colour, label=quadrature)
        axis.loglog(sizes, 0.3 / np.array(sizes), "k:", lw=1, label="order 1")
        axis.set(title=case, xlabel="cells over the height", ylim=(5e-5, 1))
        axis.set_xticks(sizes, labels=[str(n) for n in sizes])
        axis.minorticks_off()
    axes[0].set_ylabel(r"relative $L_2$ error of $\sigma_{yy}$")
    axes[0].legend(fontsize=8, loc="lower left")
    draw_stress(axes[-1], cases[0], sizes[len(sizes) // 2], directory)
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
    parser.add_argument("--cases", default="u,u-p")
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
    for case in arguments.cases.split(","):
        print(f"{case}: stress error (settlement error in %), time")
        print(" " * 24 + "".join(f"{n:>26}" for n in sizes))
        for quadrature in arguments.quadratures.split(","):
            row = f"{quadrature:24}"
            for n in sizes:
                try:
                    result = run_case(arguments, case, quadrature, n)
                    results[case, quadrature, n] = result
                    row += f"{result[0]:9.5f} ({100 * result[1]:+6.2f})"
                    row += f"{result[2]:6.1f} s"
                except output.OutputError as error:
                    failures.append(f"{case}, {quadrature}, {n}: {error}")
                    row += f"{'failed':>26}"
            print(row, flush=True)
            errors = [
                results[case, quadrature, n][0]
                for n in sizes
                if (case, quadrature, n) in results
            ]
            if quadrature == "points" or len(errors) < 2:
                continue
            order = np.log2(errors[0] / errors[-1]) / np.log2(
                sizes[-1] / sizes[0]
            )
            if not order > 0.8:
                failures.append(
                    f"{case}, {quadrature}: convergence of order "
                    f"{order:.2f} only"
                )
    if arguments.grid == "aligned" and results:
        draw(results, sizes, arguments.output_directory)
    for failure in failures:
        print(failure, file=sys.stderr)
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
