# Isochor: implicit, stabilised mixed Material Point Method on deal.II.
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Stress test: points that lie exactly on faces, edges and vertices of the cells."""

from itertools import product

import numpy as np
from bench import SCENES
from harness import output

# Grid offsets with which points (-1/4), centres of triangular domains (-1/6) or corners
# of domains (0) lie on lines of the grid
PLACES = (0.0, -1 / 4, -1 / 6)
SPACE = {
    "Dimension": 3,
    "Grid/Upper corner": "0.75, 0.75, 0.75",
    "Grid/Subdivisions": "6, 6, 6",
    "Material points/Region": "if(x < 0.5 && y < 0.5 && z < 0.5, 1, 0)",
    "Boundary conditions/Displacement": "bottom: x=0, y=0, z=0; left: x=0; back: z=0",
    "Boundary conditions/Gravity": "0, -10*t, 0",
    "Postprocess/Point probes": "top: 0, 0.46875, 0",
}


def on_faces(bench):
    """A heavy block seeded on a lattice whose points, or corners of domains, lie exactly
    on vertices, edges and faces of the cells, against grids shifted by ± 1e-9 of a cell,
    where they lie to either side: with CPDI it must not matter on which."""
    for dim, quadrature in product(
        (2, 3), ("points", "CPDI")
    ):
        if bench.quick and dim == 3:
            continue
        jumps, errors, most = [0.0], 0, 0
        for place in PLACES:
            tips = []
            for shift in (0, 1e-9, -1e-9):
                moved = [place + shift, place - shift, place + shift][:dim]
                try:
                    numbers = bench.run(
                        SCENES / "lattice.prm",
                        {
                            **(SPACE if dim == 3 else {}),
                            "Quadrature/Type": quadrature,
                            "Grid/Offset": ", ".join(f"{x:.12f}" for x in moved),
                        },
                        f"on_faces {dim} {quadrature} {place:.3f} {shift}",
                    )
                except output.OutputError as problem:
                    if not str(problem).startswith("code 1"):
                        raise
                    errors += 1
                    continue
                tips.append(numbers["Displacement y of top (m)"][-1])
                most = max(most, int(numbers["Newton iterations"].max()))
            if tips:
                jumps.append(np.ptp(tips) / abs(tips[0]))
        strict = quadrature == "CPDI"
        bench.check(
            "on_faces",
            f"settlement, {dim}D, {quadrature}: of {3 * len(PLACES)} runs {errors} end "
            "with an error (too few points for the cells), the others with at most "
            f"{most} iterations in a step; largest difference",
            f"{max(jumps):.1e}",
            "1e-6, no error" if strict else "none: reported",
            not strict or (max(jumps) < 1e-6 and errors == 0),
        )


def axes(bench):
    """In space: a nearly incompressible cube between rough plates, pressed along x, y or
    z, and in other units: the same force to rounding."""
    sides = {"x": ("left", "right"), "y": ("bottom", "top"), "z": ("front", "back")}
    for quadrature in ("points", "CPDI"):
        forces = {}
        for axis, (rest, moved) in sides.items():
            for length, stress in ((1.0, 1.0), (1e-9, 1e9), (1e9, 1e-9)):
                if length != 1.0 and (axis != "y" or bench.quick):
                    continue
                plates = ", ".join(
                    f"{a} = -{0.05 * length:.17g}*t" if a == axis else f"{a} = 0"
                    for a in "xyz"
                )
                numbers = bench.run(
                    SCENES / "pressed_cube.prm",
                    {
                        "Quadrature/Type": quadrature,
                        "Grid/Upper corner": ", ".join([f"{length:.17g}"] * 3),
                        "Grid/Subdivisions": "5, 5, 5",
                        "Material/Young modulus": f"{1000 * stress:.17g}",
                        "Boundary conditions/Displacement":
                        f"{rest}: x=0, y=0, z=0; {moved}: {plates}",
                        "Postprocess/Reactions": moved,
                    },
                    f"axes {quadrature} {axis} {length}",
                )
                force = numbers[f"Reaction {axis} on {moved} (N)"][-1]
                forces[axis, length] = force / (length**2 * stress)
        one = forces["y", 1.0]
        worst = max(abs(force / one - 1) for force in forces.values())
        bench.check(
            "axes",
            f"force of a cube, {quadrature}, {len(forces)} ways to write it: {one:.6g} N; "
            "largest difference",
            f"{worst:.1e}",
            "1e-10",
            worst < 1e-10,
        )
