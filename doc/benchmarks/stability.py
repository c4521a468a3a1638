#!/usr/bin/env python3
# Isochor: implicit, stabilised mixed Material Point Method on deal.II.
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Stress tests of numerical stability, each with a number, a bound and a picture.

    stability.py                 # all
    stability.py --only nu --only alpha
    stability.py --quick         # small versions, a few minutes
    stability.py --publish       # also doc/benchmarks/results and doc/stability.md

A test that misses its bound is reported and makes the program end with code 1.
Needs numpy, matplotlib, vtk9 and gmsh. The inf-sup test is tests/inf_sup.cc.
"""

import shutil
import sys
import time
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE))

import programs  # noqa: E402
import report  # noqa: E402
from bench import Bench, shortened  # noqa: E402
from fuzzer import fuzz  # noqa: E402
from harness import output  # noqa: E402
from stability_cuts import convergence  # noqa: E402
from stability_cycles import ten_cycles, two_discs  # noqa: E402
from stability_faces import axes, on_faces  # noqa: E402
from stability_parameters import alpha, load_steps, nu  # noqa: E402
from stability_places import offsets, symmetry, turned, units  # noqa: E402
from stability_strains import cycles, shear, strain  # noqa: E402
from vertical_cut import cut  # noqa: E402

TESTS = {
    test.__name__: test
    for test in (
        alpha,
        nu,
        load_steps,
        offsets,
        convergence,
        turned,
        symmetry,
        axes,
        on_faces,
        units,
        cut,
        strain,
        shear,
        cycles,
        ten_cycles,
        two_discs,
        fuzz,
    )
}


# ------------------------------------------------------------------- main ---


def page(bench):
    parts = []
    for name, found in bench.results.items():
        body = [
            (what, value, bound, "yes" if kept else "**no**")
            for what, value, bound, kept in found
        ]
        text = f"### {name}\n\n{' '.join(TESTS[name].__doc__.split())}\n\n"
        text += report.table(("what", "measured", "bound", "kept"), body)
        if (bench.directory / f"stability_{name}.png").exists():
            text += f"\n\n![{name}](benchmarks/results/stability_{name}.png)"
        parts.append(text)
    return parts


def main():
    parser = programs.parser(__doc__, "output-stability")
    parser.add_argument("--quick", action="store_true")
    parser.add_argument("--only", action="append", choices=list(TESTS))
    parser.add_argument("--scenes", type=int, default=1000, help="of the fuzzer")
    parser.add_argument("--first-seed", type=int, default=0)
    arguments = programs.parse(parser)
    bench = Bench(arguments)
    start = time.time()
    for name in arguments.only or TESTS:
        try:
            TESTS[name](bench)
        except output.OutputError as problem:
            bench.check(name, "runs", shortened(problem), "", False)
    parts = page(bench)
    (arguments.directory / "stability.md").write_text("\n\n".join(parts) + "\n")
    if arguments.publish:
        results = HERE / "results"
        results.mkdir(exist_ok=True)
        for path in arguments.directory.glob("stability_*.*"):
            shutil.copy(path, results / path.name)
        for name, part in zip(bench.results, parts):
            report.insert(HERE.parent / "stability.md", f"stability {name}", part)
    missed = sum(not kept for found in bench.results.values() for *_, kept in found)
    print(f"{missed} bounds not kept, {(time.time() - start) / 60:.1f} minutes")
    return 1 if missed else 0


if __name__ == "__main__":
    programs.end_with(main)
