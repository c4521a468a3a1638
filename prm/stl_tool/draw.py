# Isochor: implicit, stabilised mixed Material Point Method on deal.II.
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Draw the punch and the block, of which a quarter is cut away, at the end:

    python3 draw.py output stl_tool.png
"""

import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent / "tools"))
import isochor_output as output  # noqa: E402
import numpy as np  # noqa: E402
import solid_view  # noqa: E402
from matplotlib.collections import PolyCollection  # noqa: E402

AZIMUTH, ELEVATION = 38, 24


def draw_rigid(ax, data):
    """The facets of @p data that face the eye, shaded by their slope."""
    right, up, eye = solid_view.view_axes(AZIMUTH, ELEVATION)
    corners = data["position"][data["cells"]]
    normal = np.cross(
        corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]
    )
    normal /= np.linalg.norm(normal, axis=1)[:, None]
    shown = normal @ eye > 0
    order = np.argsort(corners[shown].mean(axis=1) @ eye)
    corners, normal = corners[shown][order], normal[shown][order]
    light = 0.45 + 0.5 * np.clip(normal @ [0.3, 0.8, 0.5], 0, 1)
    ax.add_collection(
        PolyCollection(
            np.stack([corners @ right, corners @ up], axis=-1),
            facecolors=np.column_stack([light, light, light]),
            edgecolors=(0.2, 0.2, 0.25),
            linewidths=0.3,
        )
    )


def main(directory, picture):
    data = output.read_points(directory)
    s = {c: data["cauchy_stress_" + c] for c in ("xx", "yy", "zz", "xy", "xz", "yz")}
    data["mises"] = np.sqrt(
        (
            (s["xx"] - s["yy"]) ** 2
            + (s["yy"] - s["zz"]) ** 2
            + (s["zz"] - s["xx"]) ** 2
        )
        / 2
        + 3 * (s["xy"] ** 2 + s["xz"] ** 2 + s["yz"] ** 2)
    )
    figure, ax = output.plt.subplots(figsize=(8, 5))
    solid_view.plot_solid(
        ax,
        data,
        "mises",
        AZIMUTH,
        ELEVATION,
        cut=lambda x: (x[:, 0] < 0) | (x[:, 2] < 0),
        limits=(0, 30),
        scale=1e-3,
        unit="kPa",
    )
    draw_rigid(ax, output.read_output(directory, "rigid_bodies"))
    figure.savefig(picture, bbox_inches="tight", dpi=110)


if __name__ == "__main__":
    main(*sys.argv[1:3])
