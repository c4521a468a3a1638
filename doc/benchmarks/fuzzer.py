# Isochor: implicit, stabilised mixed Material Point Method on deal.II.
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Random scenes, which have to end well or with a clear error."""

import re

import harness
import numpy as np
from bench import SCENES
from harness import QUIET, output


def fuzz(bench):
    """Random scenes: each ends well, with finite numbers, or with an error that
    names a parameter or says what to do. Bad seeds go to fuzz_bad_seeds.txt."""
    count = 20 if bench.quick else bench.arguments.scenes
    bad, ended_well = [], 0
    for seed in range(bench.arguments.first_seed, bench.arguments.first_seed + count):
        overrides = random_scene(np.random.default_rng(seed))
        run = harness.Run(
            "", f"fuzz {seed}", 0, SCENES / "fuzz.prm", {**QUIET, **overrides}
        )
        place = bench.directory / "runs" / run.name
        try:
            harness.execute(
                bench.arguments.executable, run, place, harness.Cost([], []), 120
            )
            numbers = output.read_statistics(place)
            finite = all(
                np.all(np.isfinite(column))
                for column in numbers.values()
                if column.dtype.kind == "f"
            )
            last = numbers["Time (s)"][-1]
            ended_well += 1
            if not finite or last < 0.999:
                bad.append((seed, "not finite or not at its end"))
        except output.OutputError as problem:
            text = (place / "isochor.log").read_text(errors="replace")
            says = re.search(r"isochor: error: .{40,}", text, re.DOTALL)
            if "code 124" in str(problem):
                bad.append((seed, "more than two minutes"))
            elif not says or "nan" in text.lower().split("isochor: error")[0]:
                bad.append((seed, " ".join(text.split()[-40:])))
            elif "An error occurred in" in text or "Stacktrace" in text:
                bad.append((seed, "an assertion: " + " ".join(text.split()[-40:])))
        if (seed + 1) % 50 == 0:
            print(f"fuzz: {seed + 1} scenes, {len(bad)} bad", flush=True)
    with open(bench.directory / "fuzz_bad_seeds.txt", "w") as stream:
        for seed, why in bad:
            stream.write(f"{seed}: {why}\n")
    bench.check(
        "fuzz",
        f"{count} random scenes from seed {bench.arguments.first_seed}: "
        f"{ended_well} ended well, {count - ended_well - len(bad)} with a clear "
        "error; neither of both",
        str(len(bad)),
        "0",
        not bad,
    )


def random_scene(random):
    """Overrides of scenes/fuzz.prm."""

    def pick(*choices):
        return choices[random.integers(len(choices))]

    form = pick("u", "u-p")
    nu_ = pick(0.0, 0.3, 0.45, 0.499, 0.5) if form == "u-p" else pick(0, 0.3, 0.49)
    scene = {
        "Formulation/Type": form,
        "Formulation/Stabilisation": pick("PPP", "PPP", "none")
        if form == "u-p"
        else "none",
        "Material/Poisson ratio": nu_,
        "Material/Model": pick("Neo-Hookean", "J2", "Mohr-Coulomb"),
        "Material/J2/Yield stress": pick(1.0, 10.0, 1e3),
        "Material/Mohr-Coulomb/Cohesion": pick(1.0, 10.0),
        "Material/Mohr-Coulomb/Friction angle": pick(0, 20, 35),
        "Quadrature/Type": pick(
            "points", "cell-filled", "cell-filled + boundary", "CPDI"
        ),
        "Material points/Points per cell": pick(1, 3, 4, 6, 9, 12),
        "Grid/Subdivisions": f"{random.integers(3, 20)}, {random.integers(3, 20)}",
        "Grid/Diagonals": pick("/", "backslash", "alternating"),
        "Grid reset/Steps between resets": pick(1, 1, 3, 1000),
        "Boundary conditions/Gravity": f"0, {-random.uniform(0, 3):.3f}*t",
        "Dynamics/Inertia": pick("false", "false", "true"),
        "Time/Step size": pick(0.05, 0.1, 0.5, 1),
    }
    if random.random() < 0.5:
        x, y, r = random.uniform(0.6, 1.4), random.uniform(0.3, 1.2), random.uniform(
            0.1, 0.7
        )
        scene["Material points/Region"] = (
            f"if((x-{x:.3f})^2+(y-{y:.3f})^2 < {r:.3f}^2 || y < 0.3, 1, 0)"
        )
    else:
        scene["Material points/Region"] = (
            f"if(x < {random.uniform(0.3, 2):.3f} && y < {random.uniform(0.2, 1.5):.3f}, 1, 0)"
        )
    scene["Boundary conditions/Displacement"] = "bottom: x=0, y=0" + pick(
        "", "; left: x=0", "; left: x>=0; right: x<=0", "; right: x=-0.1*t"
    )
    return scene
