#!/usr/bin/env python3
# Isochor: implicit, stabilised mixed Material Point Method on deal.II.
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Check prm/tools: running scenes, reading and drawing what they write.

    check_tools.py PROGRAM

What needs vtk or Matplotlib is left out where these are missing. Exit code 1 and a list
of what is wrong.
"""
import importlib.util
import subprocess
import sys
from pathlib import Path

import numpy as np

ROOT = Path(__file__).resolve().parents[1]
TOOLS = ROOT / "prm" / "tools"
sys.path.insert(0, str(TOOLS))

import isochor  # noqa: E402

BAR = ROOT / "prm" / "tutorial" / "bar.prm"
BLOCKS = ROOT / "prm" / "two_blocks" / "two_blocks.prm"
wrong = []


def check(what, ok, found=""):
    print(f"{what}: {'OK' if ok else f'FAILED, {found}'}", flush=True)
    if not ok:
        wrong.append(what)


def message(function):
    """What an OutputError of @p function says."""
    try:
        function()
    except isochor.OutputError as error:
        return str(error)
    return "no error"


def check_message(what, function, *parts):
    text = message(function)
    check(what, all(part in text for part in parts), text)


def check_run(program):
    stiff = isochor.run(BAR, {"Material/Young modulus": 5e7}, program, "stiff")
    soft = isochor.run(BAR, {}, program, "soft")
    check("a run", soft.error is None and soft.cpu > 0 and soft.memory > 1, soft.error)
    tip = [abs(run.statistics["Displacement y of tip"][-1]) for run in (stiff, soft)]
    check("a changed parameter", 5 * tip[0] < tip[1] < 11 * tip[0], tip)
    statistics = soft.statistics
    check("names with and without a unit",
          np.allclose(statistics["Time (s)"], np.arange(1, 11) / 10)
          and statistics["Time"] is statistics["Time (s)"]
          and statistics.units["Time (s)"] == "s" and statistics.units["Step"] == "")
    check_message("a column that isn't there", lambda: statistics["Tme"],
                  "no column 'Tme'", "'Time (s)'")
    check("no warnings", soft.warnings == [], soft.warnings)
    temporary = isochor.run(BAR, {}, program)
    place = temporary.directory
    check("a temporary directory", "Time (s)" in temporary.statistics)
    del temporary
    check("that it ends with the run", not place.exists(), place)


def check_failures(program):
    wrong_name = isochor.run(BAR, {"Material/Yong modulus": 1}, program)
    check("a mistake in a name",
          wrong_name.error.startswith("option --set: unknown parameter"), wrong_name.error)
    check_message("the same, as an exception",
                  lambda: isochor.run(BAR, {"A": 1}, program, check=True), "<A>", "Log:")
    check_message("statistics of a run that did not start",
                  lambda: wrong_name.statistics, "unknown parameter")
    points = {"Quadrature/Type": "points", "Time/Minimum step size": 0.05}
    failed = isochor.run(BAR, points, program, "failed")
    check("a run that fails on its way",
          failed.error is not None and "failed" in failed.error
          and 0 < failed.statistics["Time"][-1] < 1, failed.error)
    check("a limit of time",
          "limit" in isochor.run(BAR, {}, program, limit=0.01).error)
    check_message("no program", lambda: isochor.run(BAR, {}, "./nothing"), "./nothing")
    rubber = {"Formulation/Type": "u", "Material/Poisson ratio": 0.4999}
    warned = isochor.run(BAR, rubber, program, "warned").warnings
    check("warnings", "volumetric locking" in [warning.name for warning in warned]
          and all(warning.text and warning.count >= 1 for warning in warned), warned)


def check_statistics():
    Path("nan.txt").write_text("# 1: Time (s)\n# 2: A (m)\n1 nan \n2 5 \n")
    table = isochor.read_statistics("nan.txt")
    check("a row without a value", np.isnan(table["A"][0]) and table["A"][1] == 5)
    Path("nan.txt").write_text("# 1: Time (s)\n# 2: A (m)\n1 nan \n2 ")
    check_message("a row that is being written",
                  lambda: isochor.read_statistics("nan.txt"), "line 4", "1 values")
    check_message("no statistics", lambda: isochor.read_statistics("nowhere"), "nowhere")


def check_fields(program):
    run = isochor.run(
        BLOCKS,
        {
            "Time/End time": 0.2,
            "Time/Output interval": 0.1,
            "Material 2/Model": "J2",
            "Material 2/J2/Yield stress": 1e9,
            "Postprocess/Write grid": True,
        },
        program,
        "blocks",
    )
    check("two materials", run.error is None, run.error)
    points = run.points()
    strain = points["equivalent_plastic_strain"]
    soft = points["material_id"] == 0
    check("a field that one material has",
          np.isnan(strain[soft]).all() and (strain[~soft] == 0).all())
    check("a component", np.array_equal(points["displacement_y"],
                                        points["displacement"][:, 1]))
    check("outputs", np.allclose(run.times()[[0, -1]], [run.points(0)["time"], 0.2]),
          run.times())
    check("the grid", run.grid()["cells"].max() < len(run.grid()["position"]))
    corners = points["corners"]
    side = corners[:, 1:] - corners[:, :1]
    area = abs(side[:, 0, 0] * side[:, 1, 1] - side[:, 0, 1] * side[:, 1, 0]) / 2
    check("corners of subdomains",
          np.allclose(area, points["volume"], rtol=1e-4)
          and np.allclose(points["reference"].min(axis=(0, 1)), 0, atol=1e-6),
          area / points["volume"])
    check_message("a field that isn't there", lambda: points["von"], "'von'", "pressure")
    check_message("an output that isn't there", lambda: run.points(99), "no number 99")
    solid = {
        "Dimension": 3,
        "Grid/Lower corner": "0, 0, 0",
        "Grid/Upper corner": "1, 2.5, 0.25",
        "Grid/Subdivisions": "4, 10, 1",
        "Boundary conditions/Displacement": "left: x=0; bottom: y=0; back: z=0; front: z=0",
        "Interaction: top - place/Displacement": "x=0, y=-0.3*t, z=0",
        "Material points/Region": "y < 1 || y > 1.25",
        "Boundary conditions/Surfaces of body": "top: y > 2.49",
        "Time/End time": 0.05,
        "Material 2/Model": "J2",
        "Material 2/J2/Yield stress": 1e9,
    }
    run = isochor.run(BLOCKS, solid, program, "solid_blocks")
    check("two materials in 3D", run.error is None, run.error)


def call(tool, *arguments):
    result = subprocess.run([sys.executable, str(TOOLS / tool), *arguments],
                            capture_output=True, text=True)
    return result.returncode, result.stdout + result.stderr


def check_pictures():
    for what, tool, arguments in (
        ("load over displacement", "plot.py",
         ["soft", "stiff", "--x", "Displacement y of tip", "--y", "Reaction y on left"]),
        ("a field with NaN in 3D", "solid_view.py",
         ["solid_blocks", "equivalent_plastic_strain", "--cut", "x"]),
    ):
        picture = Path(f"{tool}.png")
        picture.unlink(missing_ok=True)
        save = ["--save"] if tool == "plot.py" else []
        code, text = call(tool, *arguments, *save, str(picture))
        check(what, code == 0 and picture.is_file(), text)
    for what, tool, arguments, part in (
        ("a column that isn't there", "plot.py", ["soft", "--y", "Load"], "'Step'"),
        ("a field that isn't there", "solid_view.py", ["solid_blocks", "von", "a.png"],
         "There are: J, "),
        ("a body in the plane", "solid_view.py", ["blocks", "J", "a.png"], "bodies in 3D"),
    ):
        code, text = call(tool, *arguments)
        check(f"{tool}: {what}", code == 1 and text.startswith("Error: ")
              and part in text, text)
    code, text = call("plot.py", "soft")
    check("the columns", code == 0 and "Time (s)\n" in text, text)
    import isochor_output as output
    figure, axes = output.plt.subplots()
    output.plot_points(axes, output.read_points("blocks"), "equivalent_plastic_strain")
    output.plot_points(axes, output.read_points("blocks"), "equivalent_plastic_strain",
                       style="cells")
    output.save(figure, "blocks.png")


def main():
    program = sys.argv[1]
    check_run(program)
    check_failures(program)
    check_statistics()
    if importlib.util.find_spec("vtkmodules"):
        check_fields(program)
        if importlib.util.find_spec("matplotlib"):
            check_pictures()
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
