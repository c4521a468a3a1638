# Isochor: implicit, stabilised mixed Material Point Method on deal.II.
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Stress tests: numerical parameters, and steps that are too large."""

import json

import harness
import numpy as np
from bench import COOK, oscillation, plt, shortened
from harness import HERE, PRM, output


def alpha(bench):
    """The PPP coefficient from 0 to 1000, Cook's membrane: displacement and
    pressure have a plateau. A beam with few cells over its height is softer: its
    tip goes down by 0.255 m in place of 0.2125 m with α = 8 and 4 cells (0.225 m
    with 8), by 0.314 m with α = 20."""
    n = 32
    values = [0, 0.01, 0.1, 0.3, 1, 3, 8, 30, 100, 1000]
    with open(HERE / "references" / "cook_membrane.json") as stream:
        reference = json.load(stream)["results"]["nu=0.499 P=1"]["uy"]
    errors, roughness = [], []
    for value in values:
        name = f"alpha {value}"
        numbers = bench.run(
            COOK,
            {
                "Grid/Subdivisions": f"{n}, {n}",
                "Formulation/PPP coefficient": value,
                "Quadrature/Type": "points",
                "Postprocess/Write grid": "true",
                **(
                    {"Formulation/Stabilisation": "none"} if value == 0 else {}
                ),
            },
            name,
        )
        errors.append(numbers["Displacement y of A (m)"][-1] / reference - 1)
        place = bench.directory / "runs" / harness.Run("", name, 0, COOK).name
        roughness.append(oscillation(place))
    for value in (0, 1, 8, 100, 1000):
        k = values.index(value)
        bench.check(
            "alpha",
            f"α = {value}: error of u_y(A), n = {n}; roughness of the pressure "
            f"{roughness[k]:.2g}",
            f"{100 * errors[k]:+.2f} %",
            "none: reported",
            np.isfinite(errors[k]),
        )
    plateau = [e for v, e in zip(values, errors) if 0.1 <= v <= 10]
    spread = max(plateau) - min(plateau)
    bench.check(
        "alpha",
        f"spread of u_y(A) for 0.1 <= α <= 10, n = {n}",
        f"{100 * spread:.2f} %",
        "5 %",
        spread < 0.05,
    )
    rough = max(r for v, r in zip(values, roughness) if v >= 0.3)
    bench.check(
        "alpha",
        "largest roughness of the pressure for α >= 0.3, in units of that at 0",
        f"{rough / roughness[0]:.3f}",
        "0.5",
        rough < 0.5 * roughness[0],
    )
    figure, axes = plt.subplots(1, 2, figsize=(9, 3.4), constrained_layout=True)
    shown = [max(v, 3e-3) for v in values]
    axes[0].semilogx(shown, 100 * np.array(errors), "o-")
    axes[0].set(xlabel="α (leftmost: 0)", ylabel="error of u_y(A) (%)")
    axes[1].loglog(shown, roughness, "o-")
    axes[1].set(xlabel="α (leftmost: 0)", ylabel="roughness of the pressure")
    bench.save(figure, "alpha")


def nu(bench):
    """Poisson's ratio from 0.3 to exactly 1/2: u-p with PPP doesn't notice, and
    the u form locks."""
    n = 16 if bench.quick else 32
    values = [0.3, 0.4, 0.45, 0.49, 0.499, 0.4999, 0.49999, 0.5]
    curves = {}
    for label, overrides in (
        ("u-p, PPP", {}),
        (
            "u",
            {"Formulation/Type": "u", "Formulation/Stabilisation": "none"},
        ),
    ):
        tips, iterations = [], []
        for value in values if label != "u" else values[:-1]:
            numbers = bench.run(
                COOK,
                {
                    "Grid/Subdivisions": f"{n}, {n}",
                    "Material/Poisson ratio": value,
                    "Quadrature/Type": "points",
                    **overrides,
                },
                f"nu {label} {value}",
            )
            tips.append(numbers["Displacement y of A (m)"][-1])
            iterations.append(int(numbers["Newton iterations"][-1]))
        curves[label] = tips, iterations
    tips, iterations = curves["u-p, PPP"]
    with open(HERE / "references" / "cook_membrane.json") as stream:
        reference = json.load(stream)["results"]
    errors = {
        value: 100 * (tip / reference[f"nu={value} P=1"]["uy"] - 1)
        for value, tip in zip(values, tips)
        if f"nu={value} P=1" in reference
    }
    bench.check(
        "nu",
        f"error of u_y(A), n = {n}, u-p with PPP: "
        + ", ".join(f"ν = {value}: {error:+.2f} %" for value, error in errors.items())
        + "; largest difference",
        f"{max(errors.values()) - min(errors.values()):.2f} %",
        "0.5 %",
        max(errors.values()) - min(errors.values()) < 0.5,
    )
    locked = 100 * (curves["u"][0][-1] / reference["nu=0.5 P=1"]["uy"] - 1)
    bench.check(
        "nu",
        "the u form at ν = 0.49999 locks: error of u_y(A)",
        f"{locked:+.0f} %",
        "below -20 %, or the test shows nothing",
        locked < -20,
    )
    jump = abs(tips[-1] / tips[-4] - 1)
    bench.check(
        "nu",
        "u_y(A) at ν = 0.5 against 0.499, u-p with PPP",
        f"{100 * jump:.2f} %",
        "0.5 % (exact: 0.12 %)",
        jump < 0.005,
    )
    bench.check(
        "nu",
        "Newton iterations over ν",
        f"{min(iterations)} to {max(iterations)}",
        "differ by at most 2",
        max(iterations) - min(iterations) <= 2,
    )
    figure, axis = plt.subplots(figsize=(5, 3.4), constrained_layout=True)
    for label, (tips, _) in curves.items():
        axis.plot(range(len(tips)), tips, "o-", label=label)
    axis.set_xticks(range(len(values)), [f"{v:g}" for v in values], rotation=45)
    axis.set(xlabel="ν", ylabel="u_y(A) (m)", ylim=(0, None))
    axis.legend()
    bench.save(figure, "nu")


def load_steps(bench):
    """Steps 1, 10 and 100 times too large: after cuts the same answer, or an
    error with the reason; never NaN."""
    cases = {
        "membrane, P = 10": (
            COOK,
            {
                "Grid/Subdivisions": "16, 16",
                "Boundary conditions/Traction": "right: 0, 10*t/16",
                "Grid reset/Steps between resets": 1000,
                "Quadrature/Type": "points",
            },
            0.01,
            "Displacement y of A (m)",
        ),
        "column": (
            PRM / "column" / "column.prm",
            {"Quadrature/Type": "CPDI"},
            0.01,
            "Displacement y of P (m)",
        ),
    }
    for name, (prm, overrides, step, column) in cases.items():
        answers = []
        for factor in (1, 10, 100):
            try:
                numbers = bench.run(
                    prm,
                    {**overrides, "Time/Step size": step * factor},
                    f"load steps {name} {factor}",
                )
                answers.append(numbers[column][-1])
                text = f"{answers[-1]:.6g} m, {int(sum(numbers['Step cuts']))} cuts"
                finite = np.isfinite(answers[-1])
                spread = abs(answers[-1] / answers[0] - 1)
                bench.check(
                    "load_steps",
                    f"{name}, steps {factor} times larger: {text}",
                    f"{100 * spread:.3f} %",
                    "1 %, or an error",
                    finite and spread < 0.01,
                )
            except output.OutputError as problem:
                bench.check(
                    "load_steps",
                    f"{name}, steps {factor} times larger",
                    "error: " + shortened(problem),
                    "1 %, or an error",
                    str(problem).startswith("code 1") and factor > 1,
                )
