# Isochor: implicit, stabilised mixed Material Point Method on deal.II.
# SPDX-License-Identifier: LGPL-2.1-or-later
"""The scenes of the benchmarks: what is varied, and what is right.

A scene to add is one class here, listed in SCENES at the end.
"""

import csv
import importlib.util
import json
import subprocess
from itertools import product

import numpy as np
from harness import HERE, ROOT, Anchor, Run, Scene, output

PRM = ROOT / "prm"


def load(path):
    """The Python module in the file @p path, which is on no search path."""
    specification = importlib.util.spec_from_file_location(path.stem, path)
    module = importlib.util.module_from_spec(specification)
    specification.loader.exec_module(module)
    return module


def mesh(geo, path, options=(), **numbers):
    """Let gmsh mesh @p geo in 2D, unless @p path is there already."""
    if path.exists():
        return path
    path.parent.mkdir(parents=True, exist_ok=True)
    command = ["gmsh", "-2", str(geo), "-o", str(path), *options]
    for name, value in numbers.items():
        command += ["-setnumber", name, str(value)]
    try:
        subprocess.run(command, check=True, capture_output=True)
    except (OSError, subprocess.CalledProcessError) as error:
        raise output.OutputError(f"gmsh failed: {error}") from error
    return path


QUIET = {"Postprocess/Write grid": "false", "Time/Output interval": 1e9}


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
    # a grid that is never put back moves with the body, as finite elements do
    KEPT = {"Grid reset/Steps between resets": 1000}
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
        """The body in a box that it doesn't fill; points cross cells."""
        geo = PRM / "cooks_membrane" / "membrane.geo"
        for quadrature, n in product(
            ("points", "cell-filled + boundary", "CPDI"), (16, 32, 64)
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
        ("cell-filled", 6),
        ("cell-filled + boundary", 6),
        ("cell-filled + boundary", 12),
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
        """The floor: the body's own grid, never put back, one point per cell.
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
        """The floor: the same grid is never put back, one point per cell."""
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


class Plate(Scene):
    """Tension of a J2 plate between clamped ends: the mean stress at the end
    over 2 / sqrt(3) of the yield stress (slip lines: Hill 1950)."""

    name = "plate"
    title = "Tension of a perfectly plastic plate"
    size_label = "cells per side"
    CHOICES = {
        "u, cell-filled": ("u", "none", "cell-filled", {}),
        "u-p, points": ("u-p", "PPP", "points", {}),
        "u-p, cell-filled": ("u-p", "PPP", "cell-filled", {}),
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


class Prandtl(Scene):
    """The footing at small strain: q/c = 2 + π (Prandtl 1920)."""

    name = "prandtl"
    title = "Strip footing at small strain"
    size_label = "cells per width of the footing"
    CHOICES = {
        "u, points": {
            "Formulation/Type": "u",
            "Formulation/Stabilisation": "none",
        },
        "u-p, points": {},
        "u-p, cell-filled": {"Quadrature/Type": "cell-filled"},
        "finite elements, u-p": {
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
                    "Quadrature/Type": "points",
                    "Material/Poisson ratio": nu,
                    "Grid/File": mesh(ring, path, n=n),
                },
                full=n > 8,
            )

    def errors(self, run, directory):
        numbers = output.read_statistics(directory)
        load_ = numbers["Reaction x on bore by boundary points (N)"][-1]
        limit = 2 / np.sqrt(3) * np.log(2) * 1e-5
        return {"limit pressure": abs(load_) / limit - 1}


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
            ("points", "cell-filled + boundary", "CPDI"), (16, 32), (50, 100)
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
            ("points", "cell-filled + boundary", "CPDI", "finite elements"), (2, 4)
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


class Column3D(Scene):
    """The column in three dimensions."""

    name = "column_3d"
    title = "Column under its own weight, 3D"
    size_label = "cells over the height"

    def runs(self, directory):
        for quadrature, n in product(("cell-filled", "CPDI"), (8, 16, 32)):
            columns = max(1, n // 8)
            yield Run(
                "u",
                quadrature,
                n,
                HERE / "scenes" / "column_3d.prm",
                {
                    **QUIET,
                    "Quadrature/Type": quadrature,
                    "Grid/Subdivisions": f"{columns}, {n}, {columns}",
                },
                full=n > 16,
            )

    def errors(self, run, directory):
        numbers = output.read_statistics(directory)
        return {"stress (L2)": numbers["L2 error of stress yy"][-1]}


SCENES = {
    scene.name: scene
    for scene in (
        Cook,
        Tube,
        Column,
        PlasticCylinder,
        Prandtl,
        Plate,
        Footing,
        TubeVibration,
        Cantilever,
        Column3D,
    )
}
