#!/usr/bin/env python3
# Isochor: implicit, stabilised mixed Material Point Method on deal.II.
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Cook's membrane in all formulations: run, compare, draw.

Prints the displacement of A beside the independent P1 reference and the table
of the paper, and writes convergence.png, convergence.svg and pressure.png.
Ends with code 1 if a run fails or deviates from the independent P1 reference
by more than 1e-6 (relative).
"""

import argparse
import json
import sys
from collections import namedtuple
from pathlib import Path

SCENE = Path(__file__).resolve().parent
sys.path.insert(0, str(SCENE.parent / "tools"))

import isochor_output as output  # noqa: E402
import numpy as np  # noqa: E402

TOLERANCE = 1e-6
COLUMN = "Displacement y of A (m)"

Variant = namedtuple("Variant", "formulation stabilisation ppp_coefficient")
VARIANTS = {
    "u": Variant("u", "none", None),
    "u-p": Variant("u-p", "none", None),
    "u-p, PPP 1": Variant("u-p", "PPP", 1),
    "u-p, PPP 8": Variant("u-p", "PPP", 8),
}
# The Poisson ratios of the paper, what its u column is in truth (0.49995), and
# the limit that only the mixed form can take.
POISSON_RATIOS = {
    "u": (0.33, 0.499, 0.49995),
    "u-p": (0.33, 0.499, 0.49995, 0.5),
    "u-p, PPP 1": (0.33, 0.499, 0.49995, 0.5),
    "u-p, PPP 8": (0.33, 0.499, 0.49995, 0.5),
}


class Reference:
    """What reference.json says about a variant."""

    def __init__(self):
        with open(SCENE / "reference.json") as stream:
            data = json.load(stream)
        self.n = data["n"]
        self.p1 = {self._key(r): r for r in data["independent_p1"]["runs"]}
        self.paper = {self._key(c): c for c in data["paper"]["columns"]}
        self.converged = {
            v["poisson_ratio"]: v for v in data["converged"]["values"]
        }

    @staticmethod
    def _key(entry):
        return (
            entry["formulation"],
            entry["stabilisation"],
            entry.get("ppp_coefficient"),
            entry["poisson_ratio"],
        )

    def of(self, table, variant, poisson_ratio, n):
        """Entry of self.p1 or self.paper, None if it has none."""
        series = table.get((*variant, poisson_ratio))
        if series is None or n not in self.n:
            return None
        return series["u_y"][self.n.index(n)]


def run_variant(arguments, name, poisson_ratio, n):
    """Run one variant; its Run."""
    variant = VARIANTS[name]
    overrides = {
        "Grid/Subdivisions": f"{n}, {n}",
        "Formulation/Type": variant.formulation,
        "Formulation/Stabilisation": variant.stabilisation,
        "Material/Poisson ratio": poisson_ratio,
    }
    if variant.ppp_coefficient is not None:
        overrides["Formulation/PPP coefficient"] = variant.ppp_coefficient
    directory = arguments.output_directory / (
        f"{name.replace(', ', '-').replace(' ', '')}-nu{poisson_ratio}-n{n}"
    )
    return output.run(
        SCENE / "cooks_membrane.prm",
        overrides,
        arguments.executable,
        directory,
        arguments.processes,
        check=True,
    )


def run_all(arguments, sizes, fine_sizes):
    """Run everything: {(variant, nu, n): (u_y(A), directory)} and a list of
    messages about the runs that failed."""
    results, failures = {}, []
    for name, ratios in POISSON_RATIOS.items():
        extra = fine_sizes if VARIANTS[name].stabilisation == "PPP" else []
        for poisson_ratio in ratios:
            for n in sizes + extra:
                case = f"{name}, nu = {poisson_ratio}, n = {n}"
                print(f"running {case}", file=sys.stderr, flush=True)
                try:
                    run = run_variant(arguments, name, poisson_ratio, n)
                    column = run.statistics[COLUMN]
                    if len(column) != 1 or not np.isfinite(column[-1]):
                        raise output.OutputError(
                            f"{run.directory}: expected one finite value of "
                            f"'{COLUMN}', found {column}."
                        )
                    results[name, poisson_ratio, n] = column[-1], run.directory
                except output.OutputError as error:
                    failures.append(f"{case}: {error}")
    return results, failures


def print_table(results, reference):
    """All results beside the references; returns messages about deviations."""
    deviations = []

    def text(value, form):
        return format(value, form) if value is not None else "-"

    for name, ratios in POISSON_RATIOS.items():
        for ratio in ratios:
            converged = reference.converged.get(ratio)
            column = reference.paper.get((*VARIANTS[name], ratio))
            print(f"\n{name}, nu = {ratio}: u_y(A) in m")
            if column and column["printed_poisson_ratio"] != ratio:
                printed = column["printed_poisson_ratio"]
                print(f"(the paper prints nu = {printed} for it, see README.md)")
            print(
                "    n      Isochor  independent P1   deviation   paper"
                "   error to converged"
            )
            for n in (k[2] for k in results if k[:2] == (name, ratio)):
                value = results[name, ratio, n][0]
                p1 = reference.of(reference.p1, VARIANTS[name], ratio, n)
                paper = reference.of(reference.paper, VARIANTS[name], ratio, n)
                deviation = value / p1 - 1 if p1 else None
                error = value / converged["u_y"] - 1 if converged else None
                print(
                    f"{n:5d}  {value:11.8f}  {text(p1, '14.8f'):>14s}"
                    f"  {text(deviation, '+10.1e'):>10s}"
                    f"  {text(paper, '.4f'):>6s}  {text(error, '+10.3%'):>10s}"
                )
                if deviation is not None and abs(deviation) > TOLERANCE:
                    deviations.append(
                        f"{name}, nu = {ratio}, n = {n}: {value:.10f} instead "
                        f"of {p1:.10f}, relative {deviation:+.1e}"
                    )
    return deviations


def print_observed_order(results, reference):
    """Order at which the stabilised form approaches the converged solution."""
    print("\nObserved order log2(e(n/2) / e(n)) of the error of u_y(A)")
    for name, ratios in POISSON_RATIOS.items():
        for ratio in ratios:
            converged = reference.converged.get(ratio)
            if VARIANTS[name].stabilisation != "PPP" or converged is None:
                continue
            n, error = error_series(results, name, ratio, converged["u_y"])
            orders = [
                f"n = {n[i + 1]}: {np.log2(error[i] / error[i + 1]):.2f}"
                for i in range(len(n) - 1)
                if n[i + 1] == 2 * n[i] and error[i + 1] > 0
            ]
            print(f"  {name}, nu = {ratio}: " + ", ".join(orders))


def error_series(results, name, ratio, converged):
    """Sizes n and absolute relative errors of one variant."""
    pairs = [
        (n, abs(value / converged - 1))
        for (other, nu, n), (value, _) in results.items()
        if (other, nu) == (name, ratio)
    ]
    return np.array([p[0] for p in pairs]), np.array([p[1] for p in pairs])


def draw_convergence(results, reference, directory):
    figure, axes = output.plt.subplots(
        1, 2, figsize=(9.5, 4.2), sharey=True, constrained_layout=True
    )
    for ax, ratio in zip(axes, (0.33, 0.499)):
        converged = reference.converged[ratio]["u_y"]
        for (name, ratios), colour, marker in zip(
            POISSON_RATIOS.items(), output.LINE_COLOURS, "sovD"
        ):
            n, error = error_series(results, name, ratio, converged)
            ax.loglog(
                n, error, marker=marker, color=colour, label=name, ms=5, lw=1.6
            )
        draw_slopes(ax, sorted({key[2] for key in results}))
        ax.set_title(rf"$\nu$ = {ratio}")
        ax.set_xlabel("elements per side n")
        ax.grid(True, which="major", color="0.9")
    axes[0].set_ylabel(r"relative error of $u_y$(A)")
    axes[0].legend(loc="lower left")
    output.save(figure, directory / "convergence.png", ["png", "svg"])


def draw_slopes(ax, n):
    """Grey lines of slope 1 and 2 that meet below the curves at the finest
    grid."""
    series = [line.get_ydata() for line in ax.get_lines()]
    lowest = min(errors.min() for errors in series if len(errors))
    ends = np.array([n[-1] / 4, n[-1]])
    for order in (1, 2):
        errors = 0.15 * lowest * (ends / n[-1]) ** -order
        ax.loglog(ends, errors, color="0.6", lw=0.9, ls="--", zorder=1)
        ax.annotate(
            f"order {order}",
            (ends[0], errors[0]),
            xytext=(-3, 0),
            textcoords="offset points",
            ha="right",
            va="center",
            color="0.45",
            fontsize=8,
        )
    ax.set_xticks(n, [str(k) for k in n])
    ax.xaxis.set_minor_locator(output.plt.NullLocator())


def draw_pressure(results, reference, n, directory):
    """Pressure without and with stabilisation: on the points and, if the grid
    was written, the nodal field with its triangles."""
    ratio, names = 0.499, ("u-p", "u-p, PPP 1")
    if any((name, ratio, n) not in results for name in names):
        print("pressure.png needs runs that failed; not drawn")
        return
    directories = [results[name, ratio, n][1] for name in names]
    points = [output.read_points(d) for d in directories]
    print(f"\nNorm of the pressure on the points, nu = {ratio}, n = {n}")
    exact = reference.converged[ratio]["pressure_norm"]
    for name, data in zip(names, points):
        volume = data["volume"] / data["J"]
        norm = np.sqrt(np.sum(data["pressure"] ** 2 * volume))
        print(f"  {name}: {norm:.4f} Pa m, converged {exact:.4f} Pa m")

    with_grid = all((d / "grid.pvd").is_file() for d in directories)
    figure, axes = output.plt.subplots(
        1 + with_grid,
        2,
        figsize=(8.2, 4.6 * (1 + with_grid)),
        sharex=True,
        sharey=True,
        squeeze=False,
        constrained_layout=True,
    )
    # The stabilised field sets the scale; the other may exceed it.
    limits = output.colour_limits([points[1]["pressure"]], "symmetric")
    for ax, name, data in zip(axes[0], names, points):
        title = "no stabilisation" if name == "u-p" else r"PPP, $\alpha$ = 1"
        artist = output.plot_points(
            ax, data, "pressure", limits=limits, colour_bar=False
        )
        ax.set_title(f"{title}: material points")
    shown = [data["pressure"] for data in points]
    if with_grid:
        for ax, folder in zip(axes[1], directories):
            shown.append(draw_nodal_pressure(ax, folder, artist))
            ax.set_title("nodes of the grid")
    for ax in axes.flat:
        ax.set_xlabel("x (m)")
        ax.set_ylabel("y (m)")
        ax.label_outer()
    output.add_colour_bar(artist, axes, "pressure", np.concatenate(shown))
    output.save(figure, directory / "pressure.png")


def draw_nodal_pressure(ax, directory, like):
    """Draw the pressure of the grid's nodes in the colours of @p like; returns
    its values."""
    grid = output.read_grid(directory)
    x, y = grid["position"][:, 0], grid["position"][:, 1]
    ax.tripcolor(
        x,
        y,
        grid["triangles"],
        grid["pressure"],
        shading="gouraud",
        cmap=like.cmap,
        norm=like.norm,
        rasterized=True,
    )
    ax.set_aspect("equal")
    return grid["pressure"]


def parse_arguments():
    parser = argparse.ArgumentParser(
        description=__doc__.split("\n", maxsplit=1)[0]
    )
    size = parser.add_mutually_exclusive_group()
    size.add_argument("--quick", action="store_true", help="only n <= 16")
    size.add_argument(
        "--fine",
        action="store_true",
        help="with PPP also n = 128 and 256, and the observed order",
    )
    parser.add_argument(
        "--executable", help="path of isochor (default: see isochor_output.py)"
    )
    parser.add_argument(
        "--output-directory", type=Path, default=Path("output-cooks_membrane")
    )
    parser.add_argument(
        "--processes", type=int, default=1, help="MPI processes per run"
    )
    return parser.parse_args()


def main():
    arguments = parse_arguments()
    arguments.executable = arguments.executable or output.find_executable()
    reference = Reference()
    sizes = [n for n in reference.n if n <= 16 or not arguments.quick]
    fine_sizes = [128, 256] if arguments.fine else []

    results, failures = run_all(arguments, sizes, fine_sizes)
    deviations = print_table(results, reference)
    if arguments.fine:
        print_observed_order(results, reference)
    if results:
        draw_convergence(results, reference, arguments.output_directory)
        draw_pressure(
            results, reference, min(32, sizes[-1]), arguments.output_directory
        )

    for message in failures:
        print(f"FAILED {message}", file=sys.stderr)
    for message in deviations:
        print(f"DEVIATION {message}", file=sys.stderr)
    return 1 if failures or deviations else 0


if __name__ == "__main__":
    try:
        sys.exit(main())
    except output.OutputError as problem:
        sys.exit(f"Error: {problem}")
