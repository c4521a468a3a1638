#!/usr/bin/env python3
# Isochor: implicit, stabilised mixed Material Point Method on deal.II.
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Stresses in the middle of the way, and the forces on the die: plot.py DIRECTORY

Writes ironing.png.
"""

import sys
from pathlib import Path

SCENE = Path(__file__).resolve().parent
sys.path.insert(0, str(SCENE.parent / "tools"))

import isochor_output as output  # noqa: E402

output.plt.rcParams["savefig.dpi"] = 100
figure, axes = output.plt.subplots(1, 2, figsize=(12, 3.4), constrained_layout=True)
points = output.read_points_at(sys.argv[1], 2.5)
output.plot_points(axes[0], points, "cauchy_stress_yy", unit="MPa")
axes[0].set(xlabel="x (mm)", ylabel="y (mm)")
statistics = output.read_statistics(sys.argv[1])
time = statistics["Time (s)"]
for component, label in (("y", "down"), ("x", "along")):
    force = abs(statistics[f"Force {component} on top by place (N)"])
    axes[1].plot(time, force, label=label)
# Fischer & Wriggers, Yastrebov, Hartmann et al., Poulios & Renard, Code_Aster
for at, forces in (
    (1, (297.9, 289.7, 319.5, 267.9, 332.0)),
    (3.5, (365.1, 359.5, 408.4, 337.4, 421.0)),
    (1, (62.1, 58.5, 67.2, 55.3, 71.0)),
    (3.5, (188.8, 170.8, 160.2, 102.1, 143.3)),
):
    axes[1].plot([at] * len(forces), forces, "k_")
axes[1].set(xlabel="t", ylabel="force on the die (N/mm)")
axes[1].legend(fontsize=8)
output.save(figure, SCENE / "ironing.png")
