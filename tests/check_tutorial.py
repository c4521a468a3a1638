#!/usr/bin/env python3
"""Run what doc/tutorial.md says and compare with the numbers that stand there.

    check_tutorial.py program case ...    run these cases; 'text': the text alone

A case is a scene of prm/tutorial with some parameters. What it must give is
written as in the text, where it must be found, and may differ by one unit of the
last digit; the weight is known exactly. Messages must be in the text and in what
the program says. The parts of parameter files that the text shows must be parts of
the scenes. Exit code 1 and a list of what is wrong.
"""
import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
sys.path.insert(0, str(ROOT / "prm" / "tools"))

import isochor  # noqa: E402

SCENES = ROOT / "prm" / "tutorial"
PAGE = (ROOT / "doc" / "tutorial.md").read_text()

TIP = "Displacement y of tip (m)"
HOLDS = "Reaction y on left (N)"
LOST = "Energy lost by the scheme (J)"
# scene, parameters, {column: value at the end}, messages, exit code
CASES = {
    "bar": ("bar.prm", {}, {TIP: "-0.2053", HOLDS: "981.000"}, ["No warnings."], 0),
    "finer": (
        "bar.prm",
        {"Grid/Subdivisions": "88, 56"},
        {TIP: "-0.2104", HOLDS: "981.000"},
        [],
        0,
    ),
    "locking": ("bar.prm", {"Formulation/Type": "u"}, {TIP: "-0.0152"}, [], 0),
    "adaptive": ("bar_adaptive.prm", {}, {TIP: "-0.2123", HOLDS: "981.000"}, [], 0),
    "dynamics": ("bar_dynamics.prm", {}, {LOST: "1.32"}, ["No warnings."], 0),
    # two of ten steps: a fifth of the weight of half of the bar
    "3d": ("bar_3d.prm", {"Time/End time": "0.2"}, {HOLDS: "9.8100"}, [], 0),
    "misspelt": (
        "misspelt.prm",
        {},
        {},
        ["unknown parameter <Material/Poison ratio>; did you mean <Material/Poisson ratio>?"],
        1,
    ),
    "free": (
        "bar.prm",
        {"Boundary conditions/Displacement": ""},
        {},
        ["without support: a body, free in translation in x, translation in y, rotation"],
        1,
    ),
    "small": (
        "bar.prm",
        {"Grid/Lower corner": "0, -0.1"},
        {},
        ["material points left the background grid", "Enlarge the grid"],
        1,
    ),
    "plain": (
        "bar.prm",
        {"Quadrature/Type": "points"},
        {},
        ["No equilibrium found near t = 0.6, and the material is elastic."],
        1,
    ),
}  # fmt: skip
NOT_IN_TEXT = {"9.8100", "1.32"}


def run(program, name):
    """What is wrong with the case @p name."""
    scene, parameters, values, messages, expected_code = CASES[name]
    directory = pathlib.Path(f"output-tutorial-{name}")
    directory.mkdir(exist_ok=True)
    path = SCENES / scene
    if name == "misspelt":
        path = directory / scene
        path.write_text((SCENES / "bar.prm").read_text().replace("Poisson", "Poison"))
    result = isochor.run(path, parameters, program, directory)
    if bool(result.error) != (expected_code != 0):
        return [f"{name}: {result.error or 'no error'}"]
    said = " ".join(result.log.split())
    wrong = [f"{name}: no message '{m}'" for m in messages if m not in said]
    for column, quoted in values.items():
        unit = 10.0 ** -len(quoted.partition(".")[2])
        value = result.statistics[column][-1]
        if not abs(value - float(quoted)) <= unit:
            wrong.append(f"{name}: {column} is {value}, not {quoted}")
    return wrong


def check_text():
    """The scenes, numbers and messages that the text shows."""
    wrong = []
    text = " ".join(PAGE.split())
    for name, (_, _, values, messages, _) in CASES.items():
        for shown in [*values.values(), *messages]:
            if shown not in text and shown not in NOT_IN_TEXT:
                wrong.append(f"the text doesn't have '{shown}' ({name})")
    scenes = [path.read_text() for path in SCENES.glob("*.prm")]
    for block in re.findall(r"```prm\n(.*?)```", PAGE, re.DOTALL):
        if not any(block in scene for scene in scenes):
            wrong.append(f"no scene has the block\n{block}")
    for path in re.findall(r"\]\(([^)#:]+)", PAGE):
        if not (ROOT / "doc" / path).exists():
            wrong.append(f"a link leads nowhere: {path}")
    return wrong


def main():
    program, names = sys.argv[1], sys.argv[2:]
    wrong = []
    for name in names:
        wrong += check_text() if name == "text" else run(program, name)
    print("\n".join(wrong) if wrong else "OK")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
