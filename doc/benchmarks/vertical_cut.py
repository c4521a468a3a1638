# Isochor: implicit, stabilised mixed Material Point Method on deal.II.
# SPDX-License-Identifier: LGPL-2.1-or-later
"""The vertical cut of stability.py: a load that the cut cells must not carry."""

from pathlib import Path

import numpy as np
from harness import output

plt = output.plt
SCENE = Path(__file__).resolve().parents[2] / "prm/vertical_cut/vertical_cut.prm"
# gamma H/c of the collapse: lower and upper bounds of limit analysis
EXACT = {20: (5.4, 5.5), 0: (3.77, 3.83)}
CASES = {  # name: parameters, how much above the upper bound it may be, quick
    "CPDI": ({"Quadrature/Type": "CPDI"}, 0.04, True),
    "CPDI, no extension": (
        {"Quadrature/Type": "CPDI", "Cut cells/Extension": "never"}, 0.04, False),
    "CPDI, '/'": (
        {"Quadrature/Type": "CPDI", "Grid/Diagonals": "/"}, 0.2, False),
}


def curve(bench, name, overrides):
    """gamma H/c and displacement of the crest; the run ends with an error
    where no equilibrium is left, which is what is looked for."""
    try:
        numbers = bench.run(SCENE, overrides, name)
    except output.OutputError:
        numbers = output.read_statistics(bench.place_of(name))
    crest = np.hypot(
        numbers["Displacement x of crest (m)"],
        numbers["Displacement y of crest (m)"],
    )
    return 8 * np.array(numbers["Time (s)"]), crest


def collapse(load, crest):
    """The load at which the crest begins to run, ten times faster than at the
    start; the last one if it never does."""
    speed = np.diff(crest) / np.diff(load)
    running = np.flatnonzero(speed > 10 * crest[4] / load[4])
    return load[running[0] + 1] if running.size else load[-1]


def cut(bench):
    """A vertical cut in soil under a growing weight, with defaults: the load at
    which its crest begins to run away, against the bounds of limit analysis;
    what ties the nodes outside of the body must not carry any of it."""
    figure, axes = plt.subplots(1, 2, figsize=(9.5, 3.6), constrained_layout=True)
    for axis, (angle, (lower, upper)) in zip(axes, EXACT.items()):
        for name, (overrides, bound, quick) in CASES.items():
            if bench.quick and not (quick and (angle == 20 or name == "CPDI")):
                continue
            load, crest = curve(
                bench,
                f"cut {angle} {name}",
                {
                    **overrides,
                    "Material/Mohr-Coulomb/Friction angle": angle,
                    "Material/Mohr-Coulomb/Dilation angle": angle,
                },
            )
            found = collapse(load, crest)
            bench.check(
                "cut",
                f"φ = {angle}°, {name}: γ H/c = {found:.2f}, exact {lower} to "
                f"{upper}; above the upper value",
                f"{100 * (found / upper - 1):+.1f} %",
                f"{100 * bound:.0f} %",
                lower <= found <= (1 + bound) * upper * (1 + 1e-9),
            )
            axis.plot(1000 * crest, load, label=name, lw=1.2)
        axis.axhspan(lower, upper, color="0.8", label="exact")
        axis.set(
            xlim=(0, 60),
            ylim=(0, 1.3 * upper),
            xlabel="displacement of the crest (mm)",
            ylabel="γ H / c",
            title=f"φ = ψ = {angle}°",
        )
    axes[0].legend(fontsize=7)
    bench.save(figure, "cut")
