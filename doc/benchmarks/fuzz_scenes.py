# Isochor: implicit, stabilised mixed Material Point Method on deal.II.
# SPDX-License-Identifier: LGPL-2.1-or-later
"""The random scenes of the fuzzer: what they are drawn from."""

from dataclasses import dataclass, field

import numpy as np


@dataclass
class RandomScene:
    """Overrides of scenes/fuzz.prm, and what is known of the scene: @p held are the
    components of which `bottom` alone carries what acts on the body."""

    overrides: dict = field(default_factory=dict)
    held: str = ""
    ranks: int = 1
    resumed: bool = False
    dim: int = 2

    @property
    def inertia(self):
        return self.overrides["Dynamics/Inertia"] == "true"

    @property
    def gravity(self):
        """-g/t in the vertical direction."""
        return float(self.overrides["Boundary conditions/Gravity"].split("*")[0].split()[-1])

    @property
    def incompressible(self):
        form = self.overrides["Formulation/Type"]
        return form == "u-p" and self.overrides["Material/Poisson ratio"] == 0.5

    @property
    def elastic(self):
        return all(
            value == "Neo-Hookean"
            for name, value in self.overrides.items()
            if name.startswith("Material") and name.endswith("/Model")
        )


def random_scene(seed):
    """The scene number @p seed, always the same."""
    random = np.random.default_rng(seed)

    def pick(*choices):
        return choices[random.integers(len(choices))]

    def chance(share):
        return bool(random.random() < share)

    scene = RandomScene(dim=3 if chance(0.15) else 2)
    set_ = scene.overrides
    set_["Dimension"] = scene.dim
    materials(scene, pick, chance)
    grid(scene, random, pick, chance)
    body(scene, random, pick, chance)
    steps(scene, pick, chance)
    vertical = f"{-random.uniform(0, 3):.3f}*t"
    set_["Boundary conditions/Gravity"] = f"0, {vertical}" + ", 0" * (scene.dim - 2)
    supports(scene, random, pick, chance)
    scene.ranks = pick(2, 3) if chance(0.12) else 1
    scene.resumed = chance(0.12)
    return scene


def materials(scene, pick, chance):
    set_ = scene.overrides
    form = pick("u", "u-p")
    set_["Formulation/Type"] = form
    if form == "u-p":
        set_["Formulation/Stabilisation"] = pick("PPP", "PPP", "PPP", "none")
    if scene.dim == 2 and chance(0.2):
        set_["Formulation/Geometry"] = "axisymmetric"
    for name in ("Material",) + (("Material 2",) if chance(0.25) else ()):
        law = pick("Neo-Hookean", "Neo-Hookean", "J2", "Mohr-Coulomb")
        set_[f"{name}/Model"] = law
        set_[f"{name}/Young modulus"] = pick(30, 100, 1000)
        set_[f"{name}/Poisson ratio"] = (
            pick(0.0, 0.3, 0.45, 0.499, 0.5) if form == "u-p" else pick(0, 0.3, 0.49)
        )
        if law == "J2":
            set_[f"{name}/J2/Yield stress"] = pick(1.0, 10.0, 1e3)
            set_[f"{name}/J2/Hardening modulus"] = pick(0, 0, 10)
        elif law == "Mohr-Coulomb":
            friction = pick(0, 20, 35)
            set_[f"{name}/Mohr-Coulomb/Cohesion"] = pick(1.0, 10.0)
            set_[f"{name}/Mohr-Coulomb/Friction angle"] = friction
            set_[f"{name}/Mohr-Coulomb/Dilation angle"] = pick(0, 0, min(10, friction))
    if "Material 2/Model" in set_:
        set_["Material 2/Density"] = 1
        set_["Material points/Materials in zones"] = pick(
            "2: if(y > 0.2, 1, 0)", "2: if(x > 0.5, 1, 0)"
        )


def grid(scene, random, pick, chance):
    set_ = scene.overrides
    most = 13 if scene.dim == 2 else 5
    kind = pick("box", "box", "box", "box", "trapezoid", "adaptive", "adaptive")
    if scene.dim == 3:
        set_["Grid/Lower corner"], set_["Grid/Upper corner"] = "0, 0, 0", "2, 2, 1"
        kind = pick("box", "box", "adaptive")
    cells = random.integers(3, most, scene.dim)
    if kind == "adaptive":
        cells = np.minimum(cells, 6 if scene.dim == 2 else 3)
        set_["Adaptive grid/Maximum level"] = pick(1, 2, 3) if scene.dim == 2 else 1
        name, value = pick(
            ("Cell size", "0.1 + 0.2*abs(x - t)"),
            ("Cell size at surface of body", 0.1),
            ("Cell size in plastic zones", 0.1),
            ("Target of relative error", 0.1),
            ("Target number of leaves", 60),
        )
        set_[f"Adaptive grid/{name}"] = value
        set_["Adaptive grid/Repetitions of first step"] = pick(0, 0, 1)
        set_["Adaptive grid/Resets between changes"] = pick(1, 1, 3)
    else:
        set_["Grid/Diagonals"] = pick("/", "backslash", "alternating")
        set_["Grid/Shape functions"] = pick("P1", "P1", "P1", "Q1")
        if chance(0.3):
            set_["Grid/Offset"] = ", ".join(
                f"{random.uniform(0, 0.9):.3f}" for _ in range(scene.dim)
            )
    if scene.dim == 2 and kind != "trapezoid":
        set_["Grid/Upper corner"] = pick("2, 2", "2.4, 2.2", "2.4, 2.2")
    if kind == "trapezoid":
        set_["Grid/Corners"] = "0, 0; 2, 0; 2, {:.2f}; 0, {:.2f}".format(
            *random.uniform(1.6, 2.4, 2)
        )
    set_["Grid/Type"] = kind
    set_["Grid/Subdivisions"] = ", ".join(str(n) for n in cells)
    set_["Grid reset/Steps between resets"] = pick("auto", 1, 1, 3, 0)
    set_["Cut cells/Extension"] = pick("auto", "auto", "auto", "never")


def body(scene, random, pick, chance):
    set_ = scene.overrides
    set_["Quadrature/Type"] = pick("points", "CPDI", "CPDI")
    set_["Material points/Points per cell"] = (
        pick(1, 3, 4, 6, 9, 12) if scene.dim == 2 else pick(1, 4, 8)
    )
    if chance(0.2):
        set_["Material points/Split at share of cell"] = pick(0.2, 0.5)
    shape = pick("disc on a slab", "block", "block", "two blocks", "all")
    if shape == "disc on a slab":
        x, y = random.uniform(0.6, 1.4), random.uniform(0.3, 1.2)
        condition = (
            f"(x-{x:.3f})^2+(y-{y:.3f})^2 < {random.uniform(0.1, 0.7):.3f}^2 || y < 0.3"
        )
    elif shape == "block":
        condition = (
            f"x < {random.uniform(0.3, 2):.3f} && y < {random.uniform(0.2, 1.5):.3f}"
        )
    elif shape == "two blocks":
        condition = (
            f"x < 0.7 && y < {random.uniform(0.3, 1.2):.3f} || "
            f"x > {random.uniform(0.8, 1.4):.3f} && y < {random.uniform(0.3, 1.2):.3f}"
        )
    else:
        condition = "y < 3"
    set_["Material points/Region"] = f"if({condition}, 1, 0)"


def steps(scene, pick, chance):
    set_ = scene.overrides
    inertia = chance(0.3)
    cpdi = set_["Quadrature/Type"] == "CPDI"
    set_["Dynamics/Inertia"] = "true" if inertia else "false"
    set_["Time/Step size"] = pick(0.05, 0.1, 0.1, 0.5, 1)
    set_["Postprocess/Write energies"] = "always"
    if not inertia:
        return
    set_["Time/Step size"] = pick(0.02, 0.05, 0.1)
    set_["Dynamics/Scheme"] = pick("Bossak", "Bossak", "Newmark")
    if set_["Dynamics/Scheme"] == "Bossak":
        set_["Dynamics/Spectral radius"] = pick(0.5, 0.9, 1)
    set_["Dynamics/Transfer"] = pick("PIC", "PIC", "FLIP")
    set_["Dynamics/Acceleration"] = pick(
        "auto", "carried", "from stresses" if cpdi else "auto"
    )
    if chance(0.3):
        set_["Time/Tolerated error"] = pick(1e-2, 1e-3)
        set_["Time/Minimum step size"] = 0.002
    if chance(0.3):
        set_["Dynamics/Initial velocity"] = "0, -0.5*y" + ", 0" * (scene.dim - 2)


def supports(scene, random, pick, chance):
    """What holds the body, and loads besides its weight."""
    set_ = scene.overrides
    zero = "x=0, y=0" + (", z=0" if scene.dim == 3 else "")
    axis = "Formulation/Geometry" in set_
    kind = pick("held", "held", "walls", "one-sided", "rigid", "periodic", "by its surface")
    held = f"bottom: {zero}"
    sides = ""
    scene.held = "xy"
    if kind == "held":
        sides = pick("", "", "; left: x=0", "; right: x=-0.1*t")
        scene.held = "xy" if sides == "" else "y"
    elif kind == "walls":
        held = ""
        set_["Boundary conditions/Walls"] = "bottom: n = 0; left: n = 0" + pick(
            "", "; right: n = 0.1*t"
        )
        scene.held = ""
    elif kind == "one-sided":
        held = "left: x=0" + ("; back: z=0" if scene.dim == 3 else "")
        set_["Boundary conditions/Walls"] = "bottom: n >= 0" + pick(
            "", "; right: n >= 0.1*t", "; top: n >= -0.2"
        )
        set_["Quadrature/Type"] = "CPDI"
        scene.held = ""
    elif kind == "rigid" and not axis:
        held = ""
        turn = "rotation" if scene.dim == 2 else "rz"
        set_["Quadrature/Type"] = "CPDI"
        set_["Rigid body: foot/Shape"] = "half plane"
        set_["Material points/Bodies"] = "one"
        set_["Rigid body: foot/Motion"] = pick("y=-0.1*t", f"x=0.1*t, {turn}=0.2*t", "")
        set_["Interaction: body - foot/Law"] = "tie"
        set_["Interaction: body - foot/Surface"] = "y < 0.01"
        scene.held = ""
    elif kind == "periodic" and not axis and set_["Grid/Type"] != "trapezoid":
        set_["Boundary conditions/Periodic sides"] = "left: right, " + pick(
            "x=0", "x=0.1*t", "force y=0.1*t"
        )
        scene.held = ""
    elif kind == "by its surface" and set_["Quadrature/Type"] == "CPDI":
        held = ""
        set_["Boundary conditions/Surfaces of body"] = "foot: bottom"
        set_["Interaction: foot - place/Displacement"] = zero
    set_["Boundary conditions/Displacement"] = held + sides
    if "bottom" in held:
        set_["Postprocess/Reactions"] = "bottom"
    if kind in ("held", "one-sided", "by its surface") and chance(0.4):
        surfaces = set_.get("Boundary conditions/Surfaces of body", "")
        set_["Boundary conditions/Surfaces of body"] = (
            surfaces + ("; " if surfaces else "") + "upper: if(y > 0.15, 1, 0)"
        )
        size = random.uniform(0, 2)
        what, formula = pick(
            ("Traction on body", f"{size:.3f}*t, {-size:.3f}*t" + ", 0" * (scene.dim - 2)),
            ("Pressure on body", f"{size:.3f}*t"),
        )
        set_[f"Boundary conditions/{what}"] = f"upper: {formula}"
    if axis:  # radial forces of a ring add up to no force
        scene.held = scene.held.replace("x", "")
