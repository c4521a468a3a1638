# Isochor: implicit, stabilised mixed Material Point Method on deal.II.
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Stress tests: energy and momentum of free motions over ten cycles, and of two discs
that collide."""

import numpy as np
from bench import SCENES, plt

QUADRATURES = ("points", "CPDI")
TIME, LOST = "Time (s)", "Energy lost by the scheme (J)"
SPIN = "Angular momentum z (kg m^2/s)"


def ten_cycles(bench):
    """Free motions over ten cycles at 50 steps each, all parameters but the quadrature at
    their defaults: what the scheme loses in a cycle, of the largest kinetic energy, and
    what the turning square loses of its angular momentum in a turn and gets of linear
    momentum. CPDI resets the grid in each step, the others keep it."""
    cycles = 10
    figure, axes = plt.subplots(1, 4, figsize=(13, 3.2), constrained_layout=True)
    for axis, scene in zip(
        axes, ("beam_vibration", "pendulum", "spinning_square", "tube_ten_cycles")
    ):
        # only CPDI has a surface that can hang on a pin
        for quadrature in QUADRATURES if scene != "pendulum" else ("CPDI",):
            numbers = bench.run(
                SCENES / f"{scene}.prm",
                {"Quadrature/Type": quadrature},
                f"ten_cycles {scene} {quadrature}",
            )
            time, lost = numbers[TIME], numbers[LOST]
            largest = numbers["Kinetic energy (J)"].max()
            ends = np.linspace(0, time[-1], cycles + 1)
            percent = 100 / largest * np.diff(np.interp(ends, [0, *time], [0, *lost]))
            axis.plot(time, 100 * lost / largest, label=quadrature)
            bench.check(
                "ten_cycles",
                f"{scene}, {quadrature}, {cycles} cycles: energy lost in each, % "
                f"(mean {percent.mean():.2f})",
                f"{percent.min():.2f} to {percent.max():.2f}",
                "-0.1 to 1",
                percent.min() > -0.1 and percent.max() <= 1,
            )
            if scene == "spinning_square":
                check_momenta(bench, quadrature, numbers, ends)
        axis.set(title=scene, xlabel="t (s)", ylabel="energy lost (%)")
    axes[0].legend(fontsize=7)
    bench.save(figure, "ten_cycles")


def two_discs(bench):
    """Two elastic discs bounce and part, in steps of 1/140, 1/560 and 1/2240 of the
    time: what is left of their energy, by the default quadrature. (Others reset the grid while the discs are together, and say what they lose.)"""
    energies = ("Kinetic energy (J)", "Strain energy (J)")
    figure, axis = plt.subplots(figsize=(5, 3.2), constrained_layout=True)
    left = []
    for step in (0.005, 0.00125, 0.0003125):
        numbers = bench.run(
            SCENES / "two_discs.prm", {"Time/Step size": step}, f"two_discs {step}"
        )
        total = sum(numbers[name] for name in energies)
        left.append(total[-1] / total[0])
        axis.plot(numbers[TIME], total / total[0], label=f"Δt = {step} s")
        bench.check(
            "two_discs",
            f"two discs, Δt = {step} s: energy after the collision over that before",
            f"{left[-1]:.4f}",
            "0.95 to 1.001",
            0.95 <= left[-1] <= 1.001,
        )
    spread = max(left) - min(left)
    bench.check(
        "two_discs",
        "two discs: spread over the three sizes of steps",
        f"{spread:.4f}",
        "0.02",
        spread <= 0.02,
    )
    axis.set(xlabel="t (s)", ylabel="kinetic and strain energy, of the first")
    axis.legend(fontsize=7)
    bench.save(figure, "two_discs")


def check_momenta(bench, quadrature, numbers, ends):
    spin = np.interp(ends[1:], numbers[TIME], numbers[SPIN])
    change = np.abs(np.diff(spin, prepend=numbers[SPIN][0])).max() / numbers[SPIN][0]
    linear = max(np.abs(numbers[f"Momentum {d} (kg m/s)"]).max() for d in "xy")
    bench.check(
        "ten_cycles",
        f"spinning_square, {quadrature}: angular momentum lost in the worst turn",
        f"{change:.1e}",
        "1e-3",
        change < 1e-3,
    )
    # against that of half of the square
    linear /= numbers["Mass (kg)"][0] * 0.25
    bench.check(
        "ten_cycles",
        f"spinning_square, {quadrature}: linear momentum over that of half of it",
        f"{linear:.0e}",
        "1e-12",
        linear < 1e-12,
    )
