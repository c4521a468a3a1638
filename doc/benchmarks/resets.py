# Isochor: implicit, stabilised mixed Material Point Method on deal.II.
# SPDX-License-Identifier: LGPL-2.1-or-later
"""The table of work.py on how often the grid is reset."""

import elastic_scenes
import report
from harness import PRM, output

COLUMN = PRM / "column" / "column.prm"
# steps, steps between two resets of the grid (0: never)
CHOICES = ((10, 1), (40, 1), (160, 1), (40, 4), (40, 10), (40, 0))
RESET = {1: "each reset", 4: "every 4th", 10: "every 10th", 0: "none"}


def resets(work):
    """Column under its own weight (prm/column), all runs to the same load: relative L2
    error of the stress for so many steps and resets of the grid."""
    study = elastic_scenes.Column().study
    body = []
    for form, n in (("u", 32), ("u", 64), ("u-p", 32), ("u-p", 64)):
        _, nu, density, alpha, _ = study.CASES[form]
        for quadrature, points in study.QUADRATURES.items():
            row = [f"{form}, n = {n}: {quadrature}"]
            for steps, interval in CHOICES:
                work.once(
                    COLUMN,
                    {
                        **study.grid_overrides("aligned", n, work.directory),
                        "Material points/Points per cell": points,
                        "Quadrature/Type": quadrature,
                        "Formulation/Type": form,
                        "Formulation/PPP coefficient": alpha,
                        "Material/Poisson ratio": nu,
                        "Material/Density": density,
                        "Time/Step size": 1 / steps,
                        "Grid reset/Steps between resets": interval,
                    },
                )
                numbers = output.read_statistics(work.directory / "run")
                settlement = -numbers[study.PROBE_COLUMN][-1]
                error = numbers[study.STRESS][-1]
                work.note(
                    "resets",
                    form=form,
                    n=n,
                    quadrature=quadrature,
                    steps=steps,
                    interval=interval,
                    stress=error,
                    settlement=settlement / study.exact_settlement(nu, density) - 1,
                )
                row.append(f"{error:.4f}")
            body.append(row)
    head = [f"{steps} steps, {RESET[interval]}" for steps, interval in CHOICES]
    return report.table(["", *head], body)

