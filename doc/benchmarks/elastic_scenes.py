# Isochor: implicit, stabilised mixed Material Point Method on deal.II.
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Scenes of the benchmarks: elastic bodies at rest."""

import csv
import json
from itertools import product

import numpy as np
from harness import HERE, PRM, QUIET, Anchor, Run, Scene, load, mesh, output, places


class Cook(Scene):
    """Cook's membrane against an independent high-order solution."""

    name = "cook"
    title = "Cook's membrane"
    size_label = "cells per side"

    # problem: (Poisson ratio, load in N, load steps)
    PROBLEMS = {
        "ν = 0.33": (0.33, 1, 1),
        "ν = 0.499": (0.499, 1, 1),
        "ν = 0.5": (0.5, 1, 1),
        "ν = 0.499, P = 10": (0.499, 10, 5),
        "ν = 0.5, P = 25": (0.5, 25, 10),
    }
    FORMULATIONS = {
        "u": {"Formulation/Type": "u", "Formulation/Stabilisation": "none"},
        "u-p, α = 1": {"Formulation/PPP coefficient": 1},
        "u-p, α = 8": {"Formulation/PPP coefficient": 8},
    }
    # a grid that is never reset moves with the body, as finite elements do
    KEPT = {
        "Grid reset/Steps between resets": 0,
        "Grid reset/Smallest element quality": 0,
    }
    PROBES = ("24, 30", "12, 20", "40, 50")

    def __init__(self):
        with open(HERE / "references" / "cook_membrane.json") as stream:
            self.reference = json.load(stream)["results"]

    def runs(self, directory):
        common = {
            **QUIET,
            "Postprocess/Point probes": "A: 48, 60; "
            + "; ".join(f"P{i}: {p}" for i, p in enumerate(self.PROBES)),
        }
        for problem, (nu, load_, steps) in self.PROBLEMS.items():
            always = {
                **common,
                "Material/Poisson ratio": nu,
                "Time/Step size": 1 / steps,
            }
            yield from self.aligned(problem, always, nu, load_)
            yield from self.graded(directory, problem, always, load_)
            yield from self.in_a_box(directory, problem, always, nu, load_)

    def aligned(self, problem, always, nu, load_):
        """The body's own grid, halved quadrilaterals: with one point per
        triangle these are finite elements."""
        for name, n in product(self.FORMULATIONS, (8, 16, 32, 64, 128, 256)):
            if name == "u" and (nu == 0.5 or load_ > 1):
                continue
            if load_ > 1 and (n == 256 or name == "u-p, α = 8"):
                continue
            yield Run(
                problem,
                f"finite elements, {name}",
                n,
                PRM / "cooks_membrane" / "cooks_membrane.prm",
                {
                    **always,
                    **self.FORMULATIONS[name],
                    "Quadrature/Type": "points",
                    "Grid/Subdivisions": f"{n}, {n}",
                    "Boundary conditions/Traction": f"right: 0, {load_}*t/16",
                    **self.KEPT,
                },
                full=n > 128 or (n > 64 and load_ > 1),
            )

    def graded(self, directory, problem, always, load_):
        """The body's own grid from gmsh, fine at the singular corners."""
        geo = HERE / "scenes" / "cook_graded.geo"
        for n in (8, 16, 32, 64, 128):
            path = directory / "meshes" / f"cook_graded-{n}.msh"
            yield Run(
                problem,
                "finite elements, graded to the corners, u-p, α = 1",
                n,
                PRM / "cooks_membrane" / "cooks_membrane.prm",
                {
                    **always,
                    "Quadrature/Type": "points",
                    "Grid/Type": "gmsh",
                    "Grid/File": mesh(geo, path, n=n),
                    "Boundary conditions/Traction": f"right: 0, {load_}*t/16",
                    **self.KEPT,
                },
                full=n > 64 or (n > 32 and load_ > 1),
            )

    def in_a_box(self, directory, problem, always, nu, load_):
        """The body in a box that it doesn't fill; points cross cells. Where the box's
        lines lie below the body's corners decides about a half of the error: mean and
        spread over four places."""
        geo = PRM / "cooks_membrane" / "membrane.geo"
        for quadrature, n in product(
            ("points", "CPDI"), (16, 32, 64, 128)
        ):
            path = directory / "meshes" / f"membrane-{n}.msh"
            yield Run(
                problem,
                f"box, {quadrature}, α = 1",
                n,
                PRM / "cooks_membrane" / "large_load.prm",
                {
                    **always,
                    "Quadrature/Type": quadrature,
                    "Material points/Body mesh": mesh(geo, path, n=n),
                    "Boundary conditions/Mesh of body surfaces": path,
                    "Boundary conditions/Traction on body":
                    f"end: 0, {load_}*t/16",
                    # cells of the box are as large as those of the body
                    "Grid/Subdivisions": f"{54 * n // 48}, {81 * n // 48}",
                },
                full=n > 32 or nu == 0.33,
                places=places(4),
            )

    def errors(self, run, directory):
        nu, load_, _ = self.PROBLEMS[run.problem]
        exact = self.reference[f"nu={nu} P={load_}"]
        numbers = output.read_statistics(directory)
        errors = {
            "u_y(A)": numbers["Displacement y of A (m)"][-1] / exact["uy"] - 1
        }
        if "Pressure at P0 (Pa)" in numbers:  # the u form has no nodal pressure
            pressures = np.array(
                [numbers[f"Pressure at P{i} (Pa)"][-1] for i in range(3)]
            )
            reference = np.array(
                [exact[k] for k in ("p_24_30", "p_12_20", "p_40_50")]
            )
            errors["pressure at three points"] = np.linalg.norm(
                pressures - reference
            ) / np.linalg.norm(reference)
        return errors


    # Table 1 of the paper, u-p with stabilisation: u_y(A) over n
    PAPER = {
        "ν = 0.33": (0.1172, 0.1953, 0.2669, 0.3025, 0.315, 0.319),
        "ν = 0.499": (0.1277, 0.1932, 0.2424, 0.2648, 0.2725, 0.275),
    }

    def anchors(self):
        """The paper's table, and the authors' code of the time."""
        found = []
        for problem, values in self.PAPER.items():
            exact = self.reference[f"nu={self.PROBLEMS[problem][0]} P=1"]["uy"]
            for n, value in zip((2, 4, 8, 16, 32, 64), values):
                found.append(
                    Anchor(
                        problem,
                        "u_y(A)",
                        "paper, Table 1, u-p stabilised",
                        "Iaconeta, Larese, Rossi, Oñate, Computational Mechanics "
                        "63 (2019) 1243-1260",
                        n,
                        value / exact - 1,
                        3 * n * (n + 1),
                    )
                )
        exact = self.reference["nu=0.499 P=1"]["uy"]
        with open(HERE / "references" / "authors_2019_cook.csv") as stream:
            lines = [line for line in stream if not line.startswith("#")]
        for row in csv.DictReader(lines):
            if row["program"] == "kratos2019 quiet":
                n = int(row["n"])
                found.append(
                    Anchor(
                        "ν = 0.499",
                        "u_y(A)",
                        "the authors' code of 2019 (Kratos), SuperLU",
                        "run on a quiet machine of the same kind, wall time of one "
                        "thread (references/authors_2019_cook.csv)",
                        n,
                        float(row["u_y"]) / exact - 1,
                        3 * n * (n + 1),
                        float(row["wall_total"]),
                    )
                )
        return found


class Tube(Scene):
    """Inflation of an incompressible tube: the pressure at a given stretch of
    the bore, p / G = ln(l_a / l_b) + (l_b^-2 - l_a^-2) / 2 (Neo-Hookean)."""

    name = "tube"
    title = "Inflation of an incompressible tube, not aligned with the grid"
    size_label = "cells of the box per side"
    STRETCHES = (1.25, 1.5, 2.0)
    # quadrature, points per cell of the body's mesh
    CHOICES = (
        ("points", 6),
        ("CPDI", 4),
    )

    @staticmethod
    def pressure(stretch):
        outer = np.sqrt(3 + stretch**2) / 2
        return np.log(stretch / outer) + (outer**-2 - stretch**-2) / 2

    def runs(self, directory):
        ring = PRM / "plastic_cylinder" / "ring.geo"
        for (quadrature, points), n in product(self.CHOICES, (24, 48, 96)):
            path = directory / "meshes" / f"ring-{n // 3}.msh"
            yield Run(
                "ν = 0.5",
                f"{quadrature}, {points} points per cell of the body",
                n,
                HERE / "scenes" / "tube.prm",
                {
                    **QUIET,
                    "Quadrature/Type": quadrature,
                    "Grid/Subdivisions": f"{n}, {n}",
                    "Material points/Points per cell": points,
                    "Material points/Body mesh": mesh(ring, path, n=n // 3),
                    "Boundary conditions/Mesh of body surfaces": path,
                },
                full=n > 48,
            )
        yield from self.finite_elements(directory)

    def finite_elements(self, directory):
        """The floor: the body's own grid, never reset, one point per cell.
        Its cells are as large as those of the box."""
        ring = PRM / "plastic_cylinder" / "ring.geo"
        for n in (24, 48, 96):
            path = directory / "meshes" / f"ring-{n // 3}.msh"
            yield Run(
                "ν = 0.5",
                "finite elements",
                n,
                HERE / "scenes" / "tube.prm",
                {
                    **QUIET,
                    "Quadrature/Type": "points",
                    "Grid/Type": "gmsh",
                    "Grid/File": mesh(ring, path, n=n // 3),
                    "Grid reset/Steps between resets": 1000,
                    "Material points/Points per cell": 1,
                    "Material points/Body mesh": "",
                    "Boundary conditions/Mesh of body surfaces": path,
                },
                full=n > 48,
            )

    def errors(self, run, directory):
        numbers = output.read_statistics(directory)
        stretch = 1 + numbers["Displacement x of bore (m)"]
        errors = {}
        for wanted in self.STRETCHES:
            if np.any(stretch >= wanted):
                load_ = np.interp(
                    wanted, np.append(1, stretch), np.append(0, numbers["Time (s)"])
                )
                errors[f"pressure at a stretch of {wanted}"] = (
                    load_ / self.pressure(wanted) - 1
                )
        return errors  # without the stretches that a stiff result never reached


class Column(Scene):
    """The column of prm/column: points cross many cells."""

    name = "column"
    title = "Column under its own weight"
    size_label = "cells over the height"

    def __init__(self):
        import sys

        sys.path.insert(0, str(PRM / "column"))
        self.study = load(PRM / "column" / "study.py")

    def runs(self, directory):
        study = self.study
        for case, (quadrature, points), n in product(
            study.CASES, study.QUADRATURES.items(), (16, 32, 64, 128)
        ):
            form, nu, density, alpha, interval = study.CASES[case]
            weight = density * study.GRAVITY
            yield Run(
                case,
                quadrature,
                n,
                PRM / "column" / "column.prm",
                {
                    **study.grid_overrides("aligned", n, directory),
                    **QUIET,
                    "Material points/Points per cell": points,
                    "Quadrature/Type": quadrature,
                    "Formulation/Type": form,
                    "Formulation/PPP coefficient": alpha,
                    "Grid reset/Steps between resets": interval,
                    "Material/Poisson ratio": nu,
                    "Material/Density": density,
                    "Postprocess/Exact stress":
                    f"yy: -{weight}*t*({study.HEIGHT}-y)",
                },
                full=n > 64,
            )
        yield from self.finite_elements()

    def finite_elements(self):
        """The floor: the same grid is never reset, one point per cell."""
        for n in (16, 32, 64, 128):
            columns = max(1, round(n / 8))
            yield Run(
                "u",
                "finite elements",
                n,
                PRM / "column" / "column.prm",
                {
                    **QUIET,
                    "Grid/Subdivisions": f"{columns}, {n}",
                    "Material points/Points per cell": 1,
                    "Quadrature/Type": "points",
                    "Grid reset/Steps between resets": 1000,
                },
                full=n > 64,
            )

    def errors(self, run, directory):
        _, nu, density, _, _ = self.study.CASES[run.problem]
        numbers = output.read_statistics(directory)
        exact = self.study.exact_settlement(nu, density)
        return {
            "settlement": -numbers[self.study.PROBE_COLUMN][-1] / exact - 1,
            "stress (L2)": numbers[self.study.STRESS][-1],
        }


class Column3D(Scene):
    """The column in three dimensions."""

    name = "column_3d"
    title = "Column under its own weight, 3D"
    size_label = "cells over the height"

    def runs(self, directory):
        for n in (8, 16, 32):
            columns = max(1, n // 8)
            yield Run(
                "u",
                "CPDI",
                n,
                HERE / "scenes" / "column_3d.prm",
                {
                    **QUIET,
                    "Grid/Subdivisions": f"{columns}, {n}, {columns}",
                },
                full=n > 16,
            )

    def errors(self, run, directory):
        numbers = output.read_statistics(directory)
        return {"stress (L2)": numbers["L2 error of stress yy"][-1]}
