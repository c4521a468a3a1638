#!/usr/bin/env python3
# Isochor: implicit, stabilised mixed Material Point Method on deal.II.
# SPDX-License-Identifier: LGPL-2.1-or-later
"""The billet with a quarter cut out, and force against reduction of height.

    plot.py SOLID_DIRECTORY AXISYMMETRIC_DIRECTORY

from two output directories. Writes billet.png.
"""

import sys
from pathlib import Path

SCENE = Path(__file__).resolve().parent
sys.path.insert(0, str(SCENE.parent / "tools"))

import isochor_output as output  # noqa: E402
import numpy as np  # noqa: E402
import solid_view  # noqa: E402

output.plt.rcParams["savefig.dpi"] = 100
figure, axes = output.plt.subplots(1, 3, figsize=(13, 3.8), constrained_layout=True)
# in 3D the plate has four quarters
for label, directory, parts in (
    ("3D", sys.argv[1], 4),
    ("axisymmetric", sys.argv[2], 1),
):
    statistics = output.read_statistics(directory)
    force = -parts * statistics["Reaction y on plate (N)"] / 1e6
    axes[0].plot(100 * statistics["Time (s)"], force, label=label)
reduction = np.linspace(0, 0.5, 50)[1:]
tau = (700 - 300 * np.log(1 - reduction)) / (1 + 300 / 200e3)  # MPa
smooth = np.pi * 1e-4 * tau / (1 - reduction)
axes[0].plot(100 * reduction, smooth, "k:", label="smooth plates, closed form")
axes[0].set(xlabel="reduction of height (%)", ylabel="force (MN)", ylim=(0, None))
axes[0].legend(loc="lower right", fontsize=8)

solid = output.read_points(sys.argv[1])
for axis, field, scale, unit in (
    (axes[1], "pressure", 1e-6, "MPa"),
    (axes[2], "equivalent_plastic_strain", 1, None),
):
    whole = output.mirrored(solid, "xyz")
    solid_view.plot_solid(
        axis,
        whole,
        field,
        azimuth=45,
        elevation=20,
        cut="xz",
        limits=tuple(np.percentile(whole[field] * scale, (1, 99))),
        scale=scale,
        unit=unit,
    )
output.save(figure, SCENE / "billet", ["png"])
