# Isochor, SPDX-License-Identifier: LGPL-2.1-or-later
"""Run the scenes of this directory, compare how far the bodies come with the
formulas, and draw them:

    /usr/bin/python3 draw.py --executable /where/isochor
"""

import argparse
import sys
from math import cos, pi, sin
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent / "tools"))
import isochor_output as output  # noqa: E402
import matplotlib  # noqa: E402

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402
import numpy as np  # noqa: E402

G, ANGLE = 9.81, pi / 3


def run(executable, scene, name, overrides=None):
    directory = HERE / "output" / name
    output.run(HERE / f"{scene}.prm", overrides, executable, directory, check=True)
    return directory


def way(directory, start):
    """How far the centre of mass has come along the slope, from x = start."""
    data = output.read_points(directory)
    mass = data["volume"] / data["J"]
    return mass @ data["position"][:, 0] / mass.sum() - start


def draw(ax, directory, times):
    for time in times:
        data = output.read_points_at(directory, time)
        data["speed"] = np.linalg.norm(data["velocity"], axis=1)
        for name in ("position", "corners"):
            x, y = data[name][..., 0].copy(), data[name][..., 1].copy()
            # turned back: the slope goes down to the right
            data[name][..., 0] = x * cos(ANGLE) + y * sin(ANGLE)
            data[name][..., 1] = y * cos(ANGLE) - x * sin(ANGLE)
        artist = output.plot_points(ax, data, "speed", limits=(0, 9), colour_bar=False)
    s = np.array([-0.7, 6])
    ax.plot(s * cos(ANGLE), -s * sin(ANGLE), "k")
    ax.set_aspect("equal")
    return artist


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--executable", default="isochor")
    arguments = parser.parse_args()
    executable = arguments.executable
    output.make_mesh(HERE / "disc.geo", HERE / "disc.msh")
    smooth = run(
        executable, "block", "smooth", {"Interaction: body - slope/Law": "unilateral"}
    )
    block = run(executable, "block", "block")
    disc = run(executable, "disc", "disc")
    for name, directory, start, exact in [
        ("block without friction", smooth, 0.5, G / 2 * sin(ANGLE)),
        ("block", block, 0.5, G / 2 * (sin(ANGLE) - 0.3 * cos(ANGLE))),
        ("disc", disc, 0, G / 3 * sin(ANGLE)),
    ]:
        found = way(directory, start)
        print(f"{name}: {found:.4f} m, {exact:.4f} m ({100 * (found / exact - 1):+.2f} %)")
    figure, axes = plt.subplots(1, 2, figsize=(8, 6), layout="constrained")
    draw(axes[0], block, [0.25, 0.5, 0.75, 1])
    artist = draw(axes[1], disc, [0.25, 0.5, 0.75, 1, 1.25])
    axes[0].set_title("block, friction 0.3")
    axes[1].set_title("disc")
    figure.colorbar(artist, ax=axes, label="velocity (m/s)")
    output.save(figure, HERE / "incline.png")


if __name__ == "__main__":
    main()
