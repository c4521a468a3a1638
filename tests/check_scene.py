#!/usr/bin/env python3
# Isochor: implicit, stabilised mixed Material Point Method on deal.II.
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Run scenes of tests/scenes and compare with their committed NAME.statistics.

    check_scene.py PROGRAM [NAME ...]            all scenes, or some
    check_scene.py PROGRAM --write [NAME ...]    write what differs anew

A number may differ by 1e-6 of the largest number of its unit in the table (without a
unit: of its column, or of 1). Lines of the scene that change this, the last one where all
numbers of a unit are only rounding:

    # tolerance: 1e-5
    # tolerance of Reaction x on left (N): 1e-3
    # scale of N: 100

Of a scene of many steps some are enough: the line '# every: 20' leaves each 20th.

Names of warnings are compared, too.
"""
import argparse
import re
import sys
from pathlib import Path

import numpy as np

SCENES = Path(__file__).resolve().parent / "scenes"
sys.path.insert(0, str(SCENES.parents[1] / "prm" / "tools"))

import isochor  # noqa: E402

TOLERANCE = 1e-6
# Rounding, or of the division among ranks: not written.
NOISE = {
    "Relative residual of forces",
    "Entries of the factors",
    "Largest share of points on a rank",
    "Imbalance of points",
    "Divisions of grid",
}
# What it costs to get there: written, for the eye, but not compared.
COST = {"Newton iterations", "Factorisations", "Linear iterations"}
# Fields would only take time.
SETTINGS = {
    "Postprocess/Write grid": False,
    "Postprocess/Write material points": False,
    "Output/Terminal": "quiet",
}


def remarks(scene, key):
    """Values of the lines '# KEY: value' and '# KEY of COLUMN: value' of a scene, by
    column, "" for the first."""
    found = re.findall(
        rf"^# {key}(?: of (.*))?: (\S+)$", scene.read_text(), re.MULTILINE
    )
    return {column: float(value) for column, value in found}


def scales(table, given):
    """For each column the size of a number in it; of some units it is @p given."""
    sizes = dict(given)
    for name, unit in table.units.items():
        largest = np.nanmax(np.abs(table[name]), initial=0)
        key = unit or name
        sizes[key] = max(sizes.get(key, 0 if unit else 1), largest)
    return {name: sizes[unit or name] or 1 for name, unit in table.units.items()}


def differences(found, expected, tolerances, sizes):
    """Lines that say what is different."""
    lines = [f"  new column '{name}'" for name in found if name not in expected]
    lines += [f"  no column '{name}'" for name in expected if name not in found]
    n = min(len(next(iter(table.values()))) for table in (found, expected))
    times = expected["Time (s)"]
    if len(found["Time (s)"]) != len(times):
        lines.append(f"  {len(found['Time (s)'])} rows instead of {len(times)}")
    for name in expected:
        if name not in found or name in COST:
            continue
        a, b = found[name][:n], expected[name][:n]
        tolerance = tolerances.get(name, tolerances.get("", TOLERANCE))
        error = np.abs(a - b) / sizes[name]
        error[np.isnan(a) & np.isnan(b)] = 0
        wrong = ~(error <= tolerance)
        if wrong.any():
            lines.append(f"  {name}: {wrong.sum()} of {n} rows differ")
            first, worst = np.argmax(wrong), np.argmax(np.nan_to_num(error, nan=np.inf))
            for row in sorted({first, worst}):
                lines.append(
                    f"    t = {times[row]:.6g}: {a[row]:.10g} instead of {b[row]:.10g}"
                    f" ({error[row]:.1e}, allowed {tolerance:.0e})"
                )
    return lines


def write(path, table, warnings, sizes):
    """Nine digits, and zero for what is rounding beside others of its unit."""
    lines = [f"# warnings: {warnings}"]
    lines += [f"# {i}: {name}" for i, name in enumerate(table, 1)]
    for row in range(len(table["Time (s)"])):
        values = ((column[row], sizes[name]) for name, column in table.items())
        lines.append(
            " ".join("0" if abs(v) < 1e-9 * size else f"{v:.9g}" for v, size in values)
        )
    path.write_text("\n".join(lines) + "\n")


def check(program, name, ranks, place, writes):
    """Whether the scene is as expected, or has been written anew."""
    scene = SCENES / f"{name}.prm"
    reference = scene.with_suffix(".statistics")
    place = place / (name if ranks == 1 else f"{name}.mpirun={ranks}")
    run = isochor.run(scene, SETTINGS, program, place, ranks=ranks)
    if run.error:
        print(f"{name}: {run.error}")
        return False
    table = run.statistics
    for column in NOISE & table.keys():
        del table[column]
    every = remarks(scene, "every").get("", 1)
    shown = table["Step"] % every == 0
    for column in table:
        table[column] = table[column][shown]
    warnings = ", ".join(warning.name for warning in run.warnings) or "none"

    lines = [f"  there is no {reference.name} yet"]
    if reference.is_file():
        expected = isochor.read_statistics(reference)
        sizes = scales(expected, remarks(scene, "scale"))
        lines = differences(table, expected, remarks(scene, "tolerance"), sizes)
        known = reference.read_text().split("\n", 1)[0].partition(": ")[2]
        if warnings != known:
            lines.append(f"  warnings: {warnings}; instead of: {known}")
        for column in COST & table.keys() & expected.keys():
            sums = [table[column].sum(), expected[column].sum()]
            if sums[0] != sums[1]:
                print(f"{name}: {sums[0]:.0f} {column}, {sums[1]:.0f} when written")
    if lines and writes:
        write(reference, table, warnings, scales(table, remarks(scene, "scale")))
        lines = [f"{name}: written"] + lines
    elif lines:
        lines = [f"{name}: FAILED"] + lines
    else:
        lines = [f"{name}: OK, {len(table['Time (s)'])} steps, {run.cpu:.1f} s"]
    print("\n".join(lines), flush=True)
    return writes or len(lines) == 1


def main():
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("program")
    parser.add_argument("--write", action="store_true", help="write what differs")
    parser.add_argument("--ranks", type=int, default=1)
    parser.add_argument(
        "--directory", type=Path, default="output-scenes", help="for the results"
    )
    parser.add_argument("names", nargs="*", metavar="NAME")
    arguments = parser.parse_intermixed_args()
    known = sorted(path.stem for path in SCENES.glob("*.prm"))
    for name in arguments.names:
        if name not in known:
            sys.exit(f"There is no scene '{name}'. There are: " + ", ".join(known))
    good = [
        check(
            arguments.program,
            name,
            arguments.ranks,
            arguments.directory,
            arguments.write,
        )
        for name in arguments.names or known
    ]
    return 0 if all(good) else 1


if __name__ == "__main__":
    sys.exit(main())
