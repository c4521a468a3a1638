# Isochor: implicit, stabilised mixed Material Point Method on deal.II.
# SPDX-License-Identifier: LGPL-2.1-or-later
"""The table of work.py on what each quadrature of the body makes of the same scenes."""

import elastic_scenes
import harness
import report
from harness import HERE, PRM, output

QUADRATURES = ("points", "CPDI")
SCENES = HERE / "scenes"


def bar(numbers):
    """Displacement of the bar's end; scenes/bar.prm."""
    return numbers["Displacement x of P (m)"][-1] / (0.2 * 1.999) - 1


def press(numbers):
    """Displacement of the block's top; scenes/pressed_by_load.prm."""
    return numbers["Displacement y of P (m)"][-1] / (-0.4 * 0.79) - 1


def settlement(numbers):
    """Of the heavy column; prm/column."""
    study = elastic_scenes.Column().study
    _, nu, density, _, _ = study.CASES["heavy"]
    exact = study.exact_settlement(nu, density)
    return -numbers[study.PROBE_COLUMN][-1] / exact - 1


def cases(directory):
    study = elastic_scenes.Column().study
    _, nu, density, alpha, _ = study.CASES["heavy"]
    heavy = {
        **study.grid_overrides("aligned", 32, directory),
        "Formulation/Type": "u-p",
        "Formulation/PPP coefficient": alpha,
        "Material/Poisson ratio": nu,
        "Material/Density": density,
        "Time/Step size": 1 / 40,
    }
    return {
        "incompressible bar of 40 by 4 cells, pulled by a load to 1.2 of its "
        "length: displacement": (SCENES / "bar.prm", {}, bar),
        "incompressible block of 10 by 8 cells, pressed by a load to 0.6 of its "
        "height: displacement": (SCENES / "pressed_by_load.prm", {}, press),
        "heavy column, n = 32 (prm/column): settlement": (
            PRM / "column" / "column.prm",
            heavy,
            settlement,
        ),
    }


def quadratures(work):
    """The same scenes with each quadrature of the body, on a grid that is reset after
    each step: error against closed forms, and the number of warnings that the run gave."""
    body = []
    for name, (prm, overrides, error_of) in cases(work.directory).items():
        row = [name]
        for quadrature in QUADRATURES:
            try:
                work.once(prm, {**overrides, "Quadrature/Type": quadrature})
                error = error_of(output.read_statistics(work.directory / "run"))
                warned = harness.warnings_of(work.directory / "run")
                row.append(f"{100 * error:+.2g} % ({warned})")
            except output.OutputError as problem:
                error, warned = None, None
                row.append("ends with an error")
                print(harness.shortened(problem))
            work.note(
                "quadratures",
                scene=name,
                quadrature=quadrature,
                error=error,
                warnings=warned,
            )
        body.append(row)
    return report.table(["", *QUADRATURES], body)
