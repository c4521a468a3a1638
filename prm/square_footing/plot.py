#!/usr/bin/env python3
# Isochor: implicit, stabilised mixed Material Point Method on deal.II.
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Draw the cells of a run of the square footing at the surface and the planes of
symmetry, in the colour of the plastic strain.

    plot.py output picture.png
"""

import argparse
import sys
from pathlib import Path

SCENE = Path(__file__).resolve().parent
sys.path.insert(0, str(SCENE.parent / "tools"))

import isochor_output as output  # noqa: E402
import numpy as np  # noqa: E402
from matplotlib.collections import PolyCollection  # noqa: E402
from solid_view import view_axes  # noqa: E402


def visible_faces(grid):
    """Faces of the cells in the planes x = 0, y = 0 (which moves by little) and
    z = 0, by their vertices, and the centres of their cells."""
    position, cells = grid["position"], grid["cells"]
    faces, centres = [], []
    for left_out in range(4):
        face = np.delete(cells, left_out, axis=1)
        for axis in range(3):
            distance = np.abs(position[face][:, :, axis]).max(axis=1)
            seen = distance < (0.02 if axis == 1 else 1e-6)
            faces.append(face[seen])
            centres.append(position[cells[seen]].mean(axis=1))
    return np.concatenate(faces), np.concatenate(centres)


def nearest(points, places):
    """The number of the point that is nearest to each place."""
    return np.array(
        [np.argmin(((points - place) ** 2).sum(axis=1)) for place in places]
    )


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("directory")
    parser.add_argument("picture")
    arguments = parser.parse_args()
    grid = output.read_output(arguments.directory, "grid")
    points = output.read_points(arguments.directory)
    faces, centres = visible_faces(grid)
    strain = points["equivalent_plastic_strain"][
        nearest(points["position"], centres)
    ]
    right, up, _ = view_axes(225, 30)
    corners = grid["position"][faces]
    figure, ax = output.plt.subplots(figsize=(6, 4.2))
    polygons = PolyCollection(
        np.stack([corners @ right, corners @ up], axis=-1),
        array=strain,
        cmap="YlOrRd",
        edgecolors="#303030",
        linewidths=0.25,
    )
    polygons.set_clim(0, np.percentile(strain, 98))
    ax.add_collection(polygons)
    ax.autoscale_view()
    ax.set_aspect("equal")
    ax.set_axis_off()
    output.add_colour_bar(polygons, ax, "equivalent_plastic_strain", strain)
    output.save(figure, arguments.picture)


if __name__ == "__main__":
    main()
