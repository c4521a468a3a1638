#!/usr/bin/env python3
# Isochor: implicit, stabilised mixed Material Point Method on deal.II.
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Plastic strain around the cone at the end, and its resistance over the depth.

    plot.py DIRECTORY [DIRECTORY ...]

The strain is that of the last one. Writes cone.png.
"""

import sys
from pathlib import Path

import numpy as np

SCENE = Path(__file__).resolve().parent
sys.path.insert(0, str(SCENE.parent / "tools"))

import isochor_output as output  # noqa: E402

output.plt.rcParams["savefig.dpi"] = 100
figure, axes = output.plt.subplots(1, 2, figsize=(9, 5.5), constrained_layout=True)
for directory in sys.argv[1:]:
    statistics = output.read_statistics(directory)
    depth = -statistics["Translation y of rigid body cone (m)"]
    force = -statistics["Force y on body by cone (N)"] / np.pi
    axes[1].plot(depth, force, label=Path(directory).name)
points = output.read_points(sys.argv[-1])
output.plot_points(axes[0], points, "equivalent_plastic_strain")
axes[0].set(xlim=(0, 5), ylim=(-10, 1.5))
for value, name in (
    (9.7, "Teh & Houlsby 1991, smooth"),
    (10.8, "Lu et al. 2004, smooth"),
    (12.1, "both, rough"),
):
    axes[1].axhline(value, color="k", linestyle=":", linewidth=1)
    axes[1].text(0.1, value + 0.1, name, fontsize=8)
axes[1].set(xlabel="depth / radius", ylabel="force / (c_u π R²)", ylim=(0, 13))
axes[1].legend(loc="lower right", fontsize=8)
output.save(figure, SCENE / "cone.png")
