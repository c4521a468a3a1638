# Isochor: implicit, stabilised mixed Material Point Method on deal.II.
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Random scenes, which have to end well or with a clear error."""

import re

import harness
import numpy as np
from bench import SCENES
from fuzz_scenes import random_scene
from harness import QUIET, output

LIMIT = 600  # seconds of a run
# What two runs of one scene, with another number of ranks or resumed, may differ by.
# Rounding grows where bodies flow or touch.
SAME = 1e-6
# Warnings of what the scene is, not of what its result is worth
HARMLESS = (
    "no effect|surface in part off|no material|contradictory conditions|"
    "grid at its maximum"
)


def fuzz(bench):
    """Random scenes: each ends well, or with an error that names a parameter or says
    what to do. Well is: finite, at the end time, in equilibrium (the residual, and the
    reaction of the bottom against weight and loads), with the mass of the start, no
    point turned inside out, volume and energy right or a warning. Some are run on two or
    three ranks, or resumed in the middle, too, and must give the same. Bad seeds go to
    fuzz_bad_seeds.txt."""
    count = 20 if bench.quick else bench.arguments.scenes
    first = bench.arguments.first_seed
    bad, tally = [], {"well": 0, "error": 0, "ranks": 0, "resumed": 0, "warned": 0}
    for seed in range(first, first + count):
        for fault in faults_of_scene(bench, seed, tally):
            bad.append((seed, fault))
            print(f"fuzz: seed {seed}: {fault}", flush=True)
        if (seed + 1) % 50 == 0:
            print(f"fuzz: {seed + 1} scenes, {len(bad)} faults {tally}", flush=True)
    with open(bench.directory / "fuzz_bad_seeds.txt", "w") as stream:
        for seed, why in bad:
            stream.write(f"{seed}: {why}\n")
    bench.check(
        "fuzz",
        f"{count} random scenes from seed {first}: {tally['well']} ended well, "
        f"{tally['warned']} of them with a warning, {tally['error']} with a clear error; "
        f"{tally['ranks']} compared on other numbers of ranks, {tally['resumed']} "
        "resumed and compared; scenes with a fault",
        str(len({seed for seed, _ in bad})),
        "0",
        not bad,
    )


def faults_of_scene(bench, seed, tally):
    """What is wrong with the scene number @p seed: a list of texts."""
    scene = random_scene(seed)
    numbers, place, fault = attempt(bench, scene, f"fuzz {seed}")
    if numbers is None:
        tally["error"] += not fault
        return [fault] if fault else []
    warned = warnings_of(place)
    found = faults(scene, numbers, warned)
    if not found:
        found = [f"a fault in <{name}> isn't noticed" for name in blind(scene, numbers)]
    tally["well"] += not found
    tally["warned"] += warned and not found
    if warned:  # forces that jump, or a body that gives way, let rounding grow
        return found
    if scene.ranks > 1:
        other, _, fault = attempt(bench, scene, f"fuzz {seed} ranks", scene.ranks)
        found += [fault or difference(numbers, other, f"on {scene.ranks} ranks")]
        tally["ranks"] += 1
    # steps that follow their error are others after a run that ended early
    fixed_steps = "Time/Tolerated error" not in scene.overrides
    if scene.resumed and fixed_steps and scene.overrides["Time/Step size"] <= 0.5:
        first = {"Checkpoint/Interval": 3, "Time/End time": 0.5}
        name = f"fuzz {seed} resumed"
        other, _, fault = attempt(bench, scene, name, more=first)
        if other is not None:
            other, _, fault = attempt(
                bench, scene, name, more={"Checkpoint/Resume": "true"}, keep=True
            )
        found += [fault or difference(numbers, other, "when resumed")]
        tally["resumed"] += 1
    return [text for text in found if text]


def attempt(bench, scene, name, ranks=1, more=None, keep=False):
    """(statistics, directory, fault): no statistics if the run ended with an error, and
    no fault if that is a clear one."""
    overrides = {**QUIET, **scene.overrides, **(more or {})}
    run = harness.Run("", name, 0, SCENES / "fuzz.prm", overrides, False, ranks)
    place = bench.directory / "runs" / run.name
    executable = bench.arguments.executable
    try:
        harness.execute(executable, run, place, harness.Cost([], []), LIMIT, keep)
        return output.read_statistics(place), place, ""
    except output.OutputError as problem:
        return None, place, fault_of_error(str(problem), output.Run(place).log)


def fault_of_error(problem, text):
    """What is wrong with the error that ended a run, if anything is."""
    says = re.search(r"isochor: error: .{40,}", text, re.DOTALL)
    end = " ".join(text.split()[-40:])
    if "seconds, the limit" in problem:
        return f"more than {LIMIT} seconds"
    if not says or "nan" in text.lower().split("isochor: error")[0]:
        return end
    if "An error occurred in" in text or "Stacktrace" in text:
        return "an assertion: " + end
    return ""


def warnings_of(place):
    """Whether the run has warned of its result."""
    return not all(
        re.match(HARMLESS, warning.name) for warning in output.Run(place).warnings
    )


def faults(scene, numbers, warned):
    """What is wrong with the @p numbers of a run that ended without an error."""
    found = []

    def demand(what, true):
        if not true:
            found.append(what)

    real = [column for column in numbers.values() if column.dtype.kind == "f"]
    if not all(np.all(np.isfinite(column)) for column in real):
        return ["not finite"]
    mass, lowest = numbers["Mass (kg)"], numbers["Smallest J"].min()
    residual = numbers["Relative residual of forces"].max()
    demand("not at its end", numbers["Time (s)"][-1] > 0.999)
    demand(f"mass {mass[0]} to {mass[-1]}", np.ptp(mass) < 1e-9 * mass[0])
    demand(f"J of a point {lowest}", lowest > 0)
    demand(f"residual {residual}", residual < 1e-6)
    volume = next(v for k, v in numbers.items() if k.startswith("Material volume"))
    if scene.incompressible and not warned:
        change = np.abs(volume / mass - 1).max()  # the density is 1
        demand(f"volume of an incompressible body: {change:.1e}", change < 0.03)
    if not scene.inertia:
        for axis in scene.held:
            lost = unbalanced(scene, numbers, axis)
            demand(f"forces along {axis} out of balance: {lost:.1e}", lost < 1e-5)
    if not warned and (scene.inertia or scene.elastic):
        lost = energy_lost(numbers, scene.inertia)
        demand(f"energy lost: {lost:.3f}", lost < (0.1 if len(mass) >= 9 else 0.3))
    return found


def blind(scene, numbers):
    """The columns of which faults() doesn't notice a wrong last value."""
    wrong = {
        "Time (s)": 0.9,
        "Smallest J": -1.0,
        "Relative residual of forces": np.inf,
    }
    if len(numbers["Mass (kg)"]) > 1:
        wrong["Mass (kg)"] = 1.01
    if "y" in scene.held and not scene.inertia:
        wrong["Reaction y on bottom (N)"] = 1.01
    for name, factor in wrong.items():
        if name in numbers and np.abs(numbers[name][-1]) > 0:
            spoilt = {key: column.copy() for key, column in numbers.items()}
            spoilt[name][-1] *= factor
            if not faults(scene, spoilt, True):
                yield name


def unbalanced(scene, numbers, axis):
    """What is left of reactions, loads and weight along @p axis, relative to the largest
    of all forces."""
    weight = numbers["Mass (kg)"] * scene.gravity * numbers["Time (s)"]
    forces = {
        along: [
            column
            for name, column in numbers.items()
            if re.match(f"(Reaction|Load) {along} ", name)
        ]
        for along in "xy"
    }
    forces["y"].append(weight)
    largest = max(np.abs(force).max() for force in forces["x"] + forces["y"])
    return np.abs(sum(forces[axis])).max() / max(largest, 1e-12)


def energy_lost(numbers, inertia):
    """Relative to the largest energy of the body, or work done on it. In dynamics since
    the tenth step: what the steps don't resolve of a sudden start dies out before."""
    names = ["Strain energy (J)", "Plastic work (J)", "External work (J)"]
    if inertia:
        names.append("Kinetic energy (J)")
    largest = max(np.abs(numbers[name]).max() for name in names)
    lost = numbers["Energy lost by the scheme (J)"]
    start = 10 if inertia else 0
    if len(lost) <= start:
        return 0.0
    return np.abs(lost[start:] - (lost[start - 1] if inertia else 0)).max() / max(
        largest, 1e-12
    )


def difference(numbers, other, where):
    """In what the last state of two runs differs, if it does: relative to the largest
    value of that unit."""
    if other is None:
        return f"an error {where} only"
    scale = {}
    for name, column in numbers.items():
        unit = name.rpartition(" ")[2]
        scale[unit] = max(scale.get(unit, 0.0), np.abs(column).max())
    for name, column in numbers.items():
        unit = name.rpartition(" ")[2]
        # not what counts work, and what is rounding
        if unit in ("(m)", "(m^2)", "(m^3)", "(N)", "(J)", "(kg)", "(Pa)"):
            if abs(column[-1] - other[name][-1]) > SAME * scale[unit]:
                return f"{name} {where}: {column[-1]} and {other[name][-1]}"
    return ""
