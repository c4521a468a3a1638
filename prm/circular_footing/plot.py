#!/usr/bin/env python3
# Isochor: implicit, stabilised mixed Material Point Method on deal.II.
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Load curve and plastic zone of the circular footing.

    plot.py SMOOTH_DIRECTORY ROUGH_DIRECTORY

from two output directories. Writes circular_footing.png.
"""

import sys
from pathlib import Path

SCENE = Path(__file__).resolve().parent
sys.path.insert(0, str(SCENE.parent / "tools"))

import isochor_output as output  # noqa: E402
import numpy as np  # noqa: E402

AREA = np.pi / 4  # of the footing (m^2)
COHESION = 1e3
EXACT = {"smooth": 5.69, "rough": 6.05}

figure, (left, right) = output.plt.subplots(
    1, 2, figsize=(9.6, 3.8), constrained_layout=True
)
for index, (label, directory) in enumerate(zip(EXACT, sys.argv[1:3])):
    statistics = output.read_statistics(directory)
    load = -statistics["Reaction y on footing (N)"] / AREA / COHESION
    colour = output.LINE_COLOURS[index]
    left.plot(
        np.append(0, 0.04 * statistics["Time (s)"]),
        np.append(0, load),
        color=colour,
        label=label,
    )
    left.axhline(EXACT[label], color=colour, lw=0.9, ls=":")
left.set_xlabel("settlement / B (%)")
left.set_ylabel("load / (area c)")
left.legend(loc="lower right")
left.set_title("dotted: exact")
shown = output.plot_points(
    right,
    output.read_points(sys.argv[2]),
    "equivalent_plastic_strain",
    limits=(0, 3e-3),
    window=(-1.2, 1.2, -0.9, 0.05),
    mirror=True,
)
right.set_title("equivalent plastic strain, rough")
output.save(figure, SCENE / "circular_footing", ["png"])
