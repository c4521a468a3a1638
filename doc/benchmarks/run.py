#!/usr/bin/env python3
# Isochor: implicit, stabilised mixed Material Point Method on deal.II.
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Run time against error: run the scenes over their choices, compare with what
is known to be right, and write CSV files, pictures and tables.

    run.py --quick              # five minutes of CPU
    run.py                      # all, twenty minutes to half an hour
    run.py --scene cook --scene tube
    run.py --baseline /path/of/another/isochor    # ratios by pairs
    run.py --draw               # tables and pictures from the CSV files again

Everything goes to --directory (default: output-benchmarks); with --publish the
CSV files and pictures also to doc/benchmarks/results and the tables to
doc/benchmarks/results/run_time.md. Needs gmsh, numpy, matplotlib and vtk9.
"""

import datetime
import os
import platform
import shutil
import sys
import time
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE))

import harness  # noqa: E402
import programs  # noqa: E402
import report  # noqa: E402
import scenes  # noqa: E402

RESULTS = HERE / "results"
PAGE = HERE / "results" / "run_time.md"


def machine():
    """What the numbers were measured on, a sentence."""
    name = platform.processor() or platform.machine()
    try:
        for line in Path("/proc/cpuinfo").read_text().splitlines():
            if line.startswith("model name"):
                name = line.split(":", 1)[1].strip()
                break
    except OSError:
        pass
    return (
        f"{name}, {os.cpu_count()} cores, one process and one thread per run, "
        f"load of the machine at the start {os.getloadavg()[0]:.1f}, "
        f"{datetime.date.today().isoformat()}"
    )


def run_scene(scene, arguments):
    """All rows of a scene; written after each run, so that nothing is lost."""
    path = arguments.directory / f"{scene.name}.csv"
    rows = []
    for run in scene.runs(arguments.directory):
        if arguments.quick and run.full:
            continue
        row = harness.measure(
            arguments.executable,
            arguments.baseline,
            scene,
            run,
            arguments.directory / "runs" / scene.name,
            arguments.repeat,
            arguments.limit,
        )
        rows.append(row)
        harness.write_rows(path, rows)
        errors = "  ".join(
            f"{key[6:]} {100 * value:+.3g} %"
            for key, value in row.items()
            if key.startswith("error ")
        )
        print(
            f"{scene.name}: {run.problem}, {run.series}, {run.size}: "
            f"{row.get('cpu', float('nan')):.2f} s  {errors}"
            + ("" if row["status"] == "ok" else row["status"][:200]),
            flush=True,
        )
    return rows


def draw(scene, rows, directory):
    for quantity in harness.quantities(rows):
        name = "".join(c if c.isalnum() else "_" for c in quantity).strip("_")
        for abscissa, label in (
            ("cpu", "CPU time (s)"),
            ("equations", "equations"),
        ):
            report.draw_error_over(
                rows,
                scene,
                abscissa,
                label,
                quantity,
                directory / f"{scene.name}_{name}_{abscissa}",
            )


def publish(scene, rows, arguments, where):
    """CSV, pictures and tables of a scene into the documentation."""
    RESULTS.mkdir(exist_ok=True)
    for pattern in (f"{scene.name}.csv", f"{scene.name}_*.png", f"{scene.name}_*.svg"):
        for path in arguments.directory.glob(pattern):
            shutil.copy(path, RESULTS / path.name)
    pictures = "\n".join(
        f"![{path.stem}]({path.name})"
        for path in sorted(RESULTS.glob(f"{scene.name}_*_cpu.png"))
    )
    report.insert(
        PAGE,
        f"benchmark {scene.name}",
        f"### {scene.title}\n\n{where}\n\n"
        + report.tolerance_table(scene, rows)
        + "\n\n"
        + pictures
        + "\n\n"
        + report.anchor_table(scene, rows)
        + "\n\n<details><summary>All runs</summary>\n\n"
        + report.series_table(scene, rows)
        + "\n\n</details>",
    )


def parse_arguments():
    parser = programs.parser(__doc__, "output-benchmarks")
    parser.add_argument("--quick", action="store_true", help="small sizes only")
    parser.add_argument(
        "--scene",
        action="append",
        choices=list(scenes.SCENES),
        help="only this one; may be repeated",
    )
    parser.add_argument(
        "--baseline", help="another isochor, run in turn with the first"
    )
    parser.add_argument(
        "--repeat", type=int, default=1, help="runs per case; medians are kept"
    )
    parser.add_argument(
        "--limit", type=int, default=3600, help="seconds after which a run fails"
    )
    parser.add_argument(
        "--draw", action="store_true", help="run nothing, use the CSV files there"
    )
    return programs.parse(parser, lambda arguments: not arguments.draw)


def main():
    arguments = parse_arguments()
    where = arguments.directory / "machine.txt"
    if not arguments.draw:
        where.write_text(machine() + "\n")
    start = time.time()
    failed, all_rows = 0, {}
    for name in arguments.scene or scenes.SCENES:
        scene = scenes.SCENES[name]()
        path = arguments.directory / f"{name}.csv"
        if arguments.draw:
            if not path.exists():
                continue
            rows = harness.read_rows(path)
        else:
            run_scene(scene, arguments)
            rows = harness.read_rows(path)
        failed += sum(row["status"] != "ok" for row in rows)
        all_rows[name] = rows
        draw(scene, rows, arguments.directory)
        page = report.tolerance_table(scene, rows)
        page += "\n\n" + report.series_table(scene, rows) + "\n"
        (arguments.directory / f"{name}.md").write_text(page)
        if arguments.publish:
            publish(scene, rows, arguments, f"Measured on: {where.read_text().strip()}.")
    report.draw_sections(all_rows, arguments.directory / "phases")
    if arguments.publish:
        for path in arguments.directory.glob("phases.*"):
            shutil.copy(path, RESULTS / path.name)
        report.insert(
            PAGE,
            "benchmark phases",
            "### Where the time goes\n\nThe most expensive run of each scene.\n\n"
            + report.phases_table(all_rows)
            + "\n\n![phases](phases.png)",
        )
    print(
        f"{sum(map(len, all_rows.values()))} runs, {failed} failed, "
        f"{(time.time() - start) / 60:.1f} minutes. Results: {arguments.directory}"
    )
    return 0


if __name__ == "__main__":
    programs.end_with(main)
