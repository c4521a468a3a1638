# Isochor: implicit, stabilised mixed Material Point Method on deal.II.
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Scenes of the benchmarks: free vibrations."""

from itertools import product

import numpy as np
from harness import HERE, PRM, QUIET, Run, Scene, mesh, output


class TubeVibration(Scene):
    """Free radial vibration of the tube: one period, closed form by
    quadrature of the energy integral (scenes/tube_vibration.prm)."""

    name = "tube_vibration"
    title = "Free vibration of the tube over one period"
    size_label = "cells of the box per side"
    LARGEST = 1.13821  # bore (m)

    def runs(self, directory):
        ring = PRM / "plastic_cylinder" / "ring.geo"
        for quadrature, n, steps in product(
            ("points", "CPDI"), (16, 32), (50, 100)
        ):
            path = directory / "meshes" / f"ring-{n // 2}.msh"
            yield Run(
                f"{steps} steps",
                quadrature,
                n,
                HERE / "scenes" / "tube_vibration.prm",
                {
                    **QUIET,
                    "Quadrature/Type": quadrature,
                    "Grid reset/Steps between resets": 1,
                    "Grid/Subdivisions": f"{n}, {n}",
                    "Material points/Body mesh": mesh(ring, path, n=n // 2),
                    "Time/Step size": 4.26407 / steps,
                },
                full=n > 16 or steps > 50,
            )

    def errors(self, run, directory):
        numbers = output.read_statistics(directory)
        radius = 1 + numbers["Displacement x of bore (m)"]
        kinetic = numbers["Kinetic energy (J)"]
        start = 0.5 * 0.2**2 * np.log(2) * np.pi / 2
        return {
            "amplitude": (radius.max() - 1) / (self.LARGEST - 1) - 1,
            "kinetic energy after a period": kinetic[-1] / start - 1,
        }


class Cantilever(Scene):
    """A cantilever falls under its weight and swings back: what an undamped
    scheme must keep is its energy."""

    name = "cantilever"
    title = "Vibration of a nearly incompressible cantilever"
    size_label = "cells over the thickness"

    def runs(self, directory):
        for quadrature, n in product(
            ("points", "CPDI", "finite elements"), (2, 4)
        ):
            kept = quadrature == "finite elements"
            yield Run(
                "one period",
                quadrature,
                n,
                HERE / "scenes" / "cantilever.prm",
                {
                    **QUIET,
                    "Quadrature/Type": "points" if kept else quadrature,
                    "Grid reset/Steps between resets": 100000 if kept else 1,
                    "Grid/Subdivisions": f"{round(4.5 * n)}, {round(4 * n)}",
                },
                full=n > 2,
            )

    def errors(self, run, directory):
        numbers = output.read_statistics(directory)
        lost = numbers["Energy lost by the scheme (J)"][-1]
        largest = np.max(numbers["Kinetic energy (J)"])
        return {"energy lost, over the largest kinetic": lost / largest}
