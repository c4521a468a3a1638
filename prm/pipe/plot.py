#!/usr/bin/env python3
# Isochor: implicit, stabilised mixed Material Point Method on deal.II.
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Plastic strain around a smooth and a rough pipe, and the resistance.

    plot.py SMOOTH_DIRECTORY ROUGH_DIRECTORY

Writes pipe.png.
"""

import sys
from pathlib import Path

SCENE = Path(__file__).resolve().parent
sys.path.insert(0, str(SCENE.parent / "tools"))

import isochor_output as output  # noqa: E402

output.plt.rcParams["savefig.dpi"] = 100
figure, axes = output.plt.subplots(1, 3, figsize=(12, 4), constrained_layout=True)
for axis, directory, name, exact in (
    (axes[0], sys.argv[1], "smooth", 9.14),
    (axes[1], sys.argv[2], "rough", 11.94),
):
    points = output.read_points(directory)
    output.plot_points(axis, points, "equivalent_plastic_strain")
    axis.set(xlim=(0, 4), ylim=(-4, 4), title=name)
    statistics = output.read_statistics(directory)
    way = 0.25 * (statistics["Time (s)"] - 1)
    force = -statistics["Force y on body by pipe (N)"] / 1e3
    axes[2].plot(way[way > 0], force[way > 0], label=name)
    axes[2].axhline(exact, color="k", linestyle=":")
axes[2].set(xlabel="w/D", ylabel="force / (c_u D)", ylim=(0, 13))
axes[2].legend(loc="lower right", fontsize=8)
output.save(figure, SCENE / "pipe.png")
