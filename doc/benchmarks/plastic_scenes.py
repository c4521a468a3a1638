# Isochor: implicit, stabilised mixed Material Point Method on deal.II.
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Scenes of the benchmarks: plastic bodies."""

from itertools import product

import numpy as np
from harness import PRM, QUIET, Run, Scene, mesh, output


class PlasticCylinder(Scene):
    """Limit pressure of a thick J2 cylinder, 2 / sqrt(3) ln 2 (Hill 1950)."""

    name = "plastic_cylinder"
    title = "Elastic-plastic thick cylinder"
    size_label = "cells over the thickness"
    FORMULATIONS = {
        "u": ({"Formulation/Type": "u", "Formulation/Stabilisation": "none"}, 0.499),
        "u-p, α = 1": ({}, 0.5),
    }

    def runs(self, directory):
        for name, n in product(self.FORMULATIONS, (4, 8, 16)):
            overrides, nu = self.FORMULATIONS[name]
            ring = PRM / "plastic_cylinder" / "ring.geo"
            path = directory / "meshes" / f"ring-{n}.msh"
            yield Run(
                "J2",
                name,
                n,
                PRM / "plastic_cylinder" / "plastic_cylinder.prm",
                {
                    **QUIET,
                    **overrides,
                    "Material/Poisson ratio": nu,
                    "Grid/File": mesh(ring, path, n=n),
                },
                full=n > 8,
            )

    def errors(self, run, directory):
        numbers = output.read_statistics(directory)
        load_ = numbers["Force x on bore by place (N)"][-1]
        limit = 2 / np.sqrt(3) * np.log(2) * 1e-5
        return {"limit pressure": abs(load_) / limit - 1}


class Prandtl(Scene):
    """The footing at small strain: q/c = 2 + π (Prandtl 1920)."""

    name = "prandtl"
    title = "Strip footing at small strain"
    size_label = "cells per width of the footing"
    POINTS = {"Quadrature/Type": "points", "Material points/Points per cell": 3}
    CHOICES = {
        "u, points": {
            **POINTS,
            "Formulation/Type": "u",
            "Formulation/Stabilisation": "none",
        },
        "u-p, points": POINTS,
        "u-p, CPDI": {},
        "finite elements, u-p": {
            **POINTS,
            "Material points/Points per cell": 1,
            "Grid reset/Steps between resets": 1000,
        },
    }

    def runs(self, directory):
        geo = PRM / "prandtl" / "prandtl.geo"
        for name, n in product(self.CHOICES, (8, 16, 32)):
            path = directory / "meshes" / f"prandtl-{n}.msh"
            yield Run(
                "φ = 0",
                name,
                n,
                PRM / "prandtl" / "prandtl.prm",
                {
                    **QUIET,
                    "Grid/File": mesh(geo, path, n=n),
                    **self.CHOICES[name],
                },
                full=n > 16,
            )

    def errors(self, run, directory):
        numbers = output.read_statistics(directory)
        q = -2 * numbers["Reaction y on footing (N)"][-1] / 1e3
        return {"collapse load": q / (2 + np.pi) - 1}


class Plate(Scene):
    """Tension of a J2 plate between clamped ends: the mean stress at the end
    over 2 / sqrt(3) of the yield stress (slip lines: Hill 1950)."""

    name = "plate"
    title = "Tension of a perfectly plastic plate"
    size_label = "cells per side"
    CHOICES = {
        "u, CPDI": (
            "u",
            "none",
            "CPDI",
            {"Material points/Points per cell": 4},
        ),
        "u-p, points": ("u-p", "PPP", "points", {}),
        "u-p, CPDI": (
            "u-p",
            "PPP",
            "CPDI",
            {"Material points/Points per cell": 4},
        ),
        "finite elements, u-p": (
            "u-p",
            "PPP",
            "points",
            {
                "Material points/Points per cell": 1,
                "Grid/Stretch": "",
                "Grid reset/Steps between resets": 1000,
            },
        ),
    }

    def runs(self, directory):
        geo = PRM / "tension_plate" / "plate.geo"
        for nu, name, n in product((0.33, 0.4999), self.CHOICES, (12, 25, 50, 100)):
            if name.startswith("u,") and nu != 0.33:
                continue
            form, stabilisation, quadrature, more = self.CHOICES[name]
            path = directory / "meshes" / f"plate-{n}.msh"
            yield Run(
                f"ν = {nu}",
                name,
                n,
                PRM / "tension_plate" / "tension_plate.prm",
                {
                    **QUIET,
                    "Formulation/Type": form,
                    "Formulation/Stabilisation": stabilisation,
                    "Material/Poisson ratio": nu,
                    "Quadrature/Type": quadrature,
                    "Grid/File": mesh(geo, path, h=0.1 / n),
                    **more,
                },
                full=n > 25,
            )

    def errors(self, run, directory):
        numbers = output.read_statistics(directory)
        stress = numbers["Reaction y on top (N)"][-1] / 0.1
        return {"limit load": stress / (2 / np.sqrt(3) * 150e6) - 1}


class Footing(Scene):
    """The footing pushed to twice its width, against two independent methods
    (prm/strip_footing/README.md), good to +-0.1 in q/c, which is 1.5 %."""

    name = "footing"
    title = "Strip footing pushed to twice its width"
    size_label = "cells per width of the footing"
    # settlement over B: q/c
    REFERENCE = {0.5: 5.95, 1.0: 6.4, 2.0: 7.0}
    # name: (h, h_edge, step, quick?)
    GRIDS = {
        "uniform below the footing": ((5, 0.2, 0.2), (10, 0.1, 0.1), (20, 0.05, 0.05)),
        "graded to the edge": ((20, 0.2, 0.05), (40, 0.1, 0.025)),
    }

    def runs(self, directory):
        geo = PRM / "strip_footing" / "footing.geo"
        for name, grids in self.GRIDS.items():
            for n, h, h_edge in grids:
                path = directory / "meshes" / f"footing-{h}-{h_edge}.msh"
                yield Run(
                    "φ = 0, steps of 5 mm",
                    name,
                    n,
                    PRM / "strip_footing" / "strip_footing.prm",
                    {
                        **QUIET,
                        "Grid/File": mesh(
                            geo, path, h=h, h_edge=h_edge, h_far=max(0.5, h)
                        ),
                    },
                    full=h < 0.2 or h_edge < 0.2,
                )

    def errors(self, run, directory):
        numbers = output.read_statistics(directory)
        load_ = -numbers["Reaction y on footing (N)"] / (0.5 * 1e3)
        return {
            f"q/c at w/B = {w:g}": np.interp(w, numbers["Time (s)"], load_) / q - 1
            for w, q in self.REFERENCE.items()
        }
