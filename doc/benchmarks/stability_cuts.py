# Isochor: implicit, stabilised mixed Material Point Method on deal.II.
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Stress test: a body that cuts the cells of its grid anywhere, refined."""

import json

import harness
import numpy as np
from bench import plt
from harness import HERE, PRM

SCENE = PRM / "cooks_membrane" / "large_load.prm"
TIP = "Displacement y of A (m)"


class Membrane:
    """Cook's membrane, P = 25, ν = 1/2, in a box: the error of its tip."""

    def __init__(self, bench):
        self.bench = bench
        with open(HERE / "references" / "cook_membrane.json") as stream:
            self.exact = json.load(stream)["results"]["nu=0.5 P=25"]["uy"]

    def error(self, n, name, overrides):
        """In per cent, with cells of 48/n; the body is seeded in a mesh of such."""
        path = self.bench.directory / "meshes" / f"membrane-{n}.msh"
        harness.mesh(PRM / "cooks_membrane" / "membrane.geo", path, n=n)
        numbers = self.bench.run(
            SCENE,
            {
                "Material/Poisson ratio": 0.5,
                "Material points/Body mesh": path,
                "Boundary conditions/Mesh of body surfaces": path,
                "Boundary conditions/Traction on body": "end: 0, 25*t/16",
                "Grid/Subdivisions": f"{54 * n // 48}, {81 * n // 48}",
                "Time/Step size": 0.1,
                **overrides,
            },
            f"convergence {n} {name}",
        )
        return 100 * (numbers[TIP][-1] / self.exact - 1)


def convergence(bench):
    """Cook's membrane, P = 25, ν = 1/2, in a box that it cuts anywhere, P1 with PPP. A
    single series of grids converges unevenly, since the clamped corner, which is singular,
    lies elsewhere in a cell in each of them; the mean over places of the grid doesn't."""
    membrane = Membrane(bench)
    sizes = (16, 32) if bench.quick else (16, 32, 64)
    count = 4 if bench.quick else 8
    figure, axes = plt.subplots(1, 2, figsize=(9, 3.6), constrained_layout=True)
    means = []
    for n in sizes:
        errors = np.array(
            [
                membrane.error(n, f"place {k} of {count}", at)
                for k, at in enumerate(harness.places(count))
            ]
        )
        axes[0].semilogx(
            np.full(count, n), errors, "C0.", alpha=0.4
        )
        means.append(errors.mean())
        order = np.log2(means[-2] / means[-1]) if len(means) > 1 else np.nan
        bench.check(
            "convergence",
            f"n = {n}, {count} grids: {min(errors):+.2f} to "
            f"{max(errors):+.2f} %, mean {errors.mean():+.2f} ± {errors.std():.2f} %"
            + ("" if np.isnan(order) else "; order of the mean"),
            "" if np.isnan(order) else f"{order:.1f}",
            "" if np.isnan(order) else "at least 0.8",
            np.isnan(order) or order > 0.8,
        )
    axes[0].semilogx(sizes, means, "C0-")
    axes[0].set_xticks(sizes, [str(n) for n in sizes])
    axes[0].set(xlabel="n", ylabel="error of u_y(A) (%)")
    axes[0].minorticks_off()
    where_it_sits(bench, membrane, axes[1])
    bench.save(figure, "convergence")


def where_it_sits(bench, membrane, axis):
    """The same with cells of an eighth near one corner: which one makes the spread?"""
    places = {
        "cells of 3 m everywhere": "10",
        "cells of 0.4 m around (0, 44), where the clamp ends above":
        "if(x^2+(y-44)^2<8^2, 0.4, 10)",
        "around (0, 0), where it ends below": "if(x^2+y^2<8^2, 0.4, 10)",
        "along the loaded side": "if(x>42, 0.4, 10)",
    }
    shifts = 3 * ((np.arange(4) + 0.5) / 4 - 0.5)
    spreads = []
    for name, size in places.items():
        errors = np.array(
            [
                membrane.error(
                    16,
                    f"{name} {k}",
                    {
                        "Grid/Type": "adaptive",
                        "Grid/Lower corner": f"0, {-3 + shift}",
                        "Grid/Upper corner": f"54, {78 + shift}",
                        "Adaptive grid/Maximum level": 3,
                        "Adaptive grid/Cell size": size,
                    },
                )
                for k, shift in enumerate(shifts)
            ]
        )
        spreads.append(errors.std())
        axis.plot(shifts / 3, errors, "o-", ms=3, label=name.split(", where")[0])
        at_corner = "above" in name
        bench.check(
            "convergence",
            f"{name}: mean {errors.mean():+.2f} %, 4 grids shifted along y; standard "
            "deviation",
            f"{errors.std():.2f} %",
            "a fifth of the first" if at_corner else "none: reported",
            not at_corner or spreads[-1] < spreads[0] / 5,
        )
    axis.set(xlabel="shift of the grid (cells)", ylabel="error of u_y(A), n = 16 (%)")
    axis.axhline(0, color="k", lw=0.8)
    axis.legend(fontsize=7)

