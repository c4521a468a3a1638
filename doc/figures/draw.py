#!/usr/bin/env python3
# Isochor: implicit, stabilised mixed Material Point Method on deal.II.
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Draw the figures of doc/method.md: the phases of a step, the stencil of a CPDI
subdomain, a layer of the grid for each body."""

from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402
import numpy as np  # noqa: E402
from matplotlib.collections import PolyCollection  # noqa: E402

HERE = Path(__file__).resolve().parent
GRID, BODY, EDGE = "#b8b8b8", "#9ecae1", "#3182bd"
plt.rcParams.update({"font.size": 10, "svg.hashsalt": "isochor", "svg.fonttype": "path"})


def lattice(nx, ny):
    """Vertices and triangles of nx by ny squares of two triangles."""
    x = np.array([(i, j) for j in range(ny + 1) for i in range(nx + 1)], float)
    cells = []
    for j in range(ny):
        for i in range(nx):
            a = j * (nx + 1) + i
            cells += [(a, a + 1, a + nx + 2), (a, a + nx + 2, a + nx + 1)]
    return x, np.array(cells)


def draw_grid(ax, x, cells, **style):
    ax.triplot(x[:, 0], x[:, 1], cells, **{"color": GRID, "linewidth": 0.8, **style})


def draw_body(ax, x, cells, colour=BODY):
    ax.add_collection(
        PolyCollection(x[cells], facecolors=colour, edgecolors="white", linewidths=0.6)
    )
    centres = x[cells].mean(axis=1)
    ax.plot(*centres.T, ".", color=EDGE, markersize=3)


def finish(axes, name):
    for ax in np.ravel(axes):
        ax.set_aspect("equal")
        ax.set_axis_off()
    path = HERE / f"{name}.svg"
    plt.gcf().savefig(path, bbox_inches="tight", metadata={"Date": None})
    plt.close()
    print(f"wrote {path}")


def bend(x):
    """A motion of the body: it sags and gets longer."""
    return x + np.stack([0.06 * x[:, 0], -0.045 * x[:, 0] ** 2], axis=1)


def phases():
    figure, axes = plt.subplots(1, 3, figsize=(9, 2.6))
    x, cells = lattice(6, 3)
    body, parts = lattice(8, 2)
    body = body * [0.55, 0.55] + [0, 1.55]
    titles = (
        "1 initialisation",
        "2 updated Lagrangian",
        "3 convective, reset",
    )
    for ax, title in zip(axes, titles):
        ax.set_title(title, fontsize=9)
    draw_body(axes[0], body, parts)
    draw_grid(axes[0], x, cells)
    draw_body(axes[1], bend(body), parts)
    draw_grid(axes[1], bend(x), cells)
    draw_body(axes[2], bend(body), parts)
    draw_grid(axes[2], x, cells)
    for ax in axes:
        ax.set_xlim(-0.1, 6.5)
        ax.set_ylim(-1.7, 3.1)
    finish(axes, "phases")


def subdomain():
    figure, ax = plt.subplots(figsize=(4.2, 3))
    x, cells = lattice(4, 3)
    draw_grid(ax, x, cells)
    corners = np.array([[1.35, 0.75], [2.55, 1.15], [1.75, 1.8]])
    nodes = set()
    for corner in corners:
        i, j = np.floor(corner).astype(int)
        upper = corner[1] - j > corner[0] - i
        nodes |= {(i, j), (i + 1, j + 1), (i, j + 1) if upper else (i + 1, j)}
    ax.add_patch(plt.Polygon(corners, facecolor=BODY, edgecolor=EDGE, alpha=0.9))
    ax.plot(*corners.T, "o", color=EDGE, markersize=5)
    ax.plot(*corners.mean(axis=0), ".", color="black")
    ax.plot(*np.array(sorted(nodes)).T, "s", color="#d95f0e", markersize=6, zorder=5)
    for place, text in zip(corners, ("$x_1$", "$x_2$", "$x_3$")):
        ax.annotate(text, place, xytext=(5, 4), textcoords="offset points")
    ax.annotate("p", corners.mean(axis=0), xytext=(4, -11), textcoords="offset points")
    finish(ax, "subdomain")


def layers():
    figure, axes = plt.subplots(1, 3, figsize=(9, 2.2))
    x, cells = lattice(6, 3)
    lower, parts = lattice(8, 2)
    upper = lower * [0.4, 0.45] + [1.3, 1.45]
    lower = lower * [0.7, 0.65] + [0.2, 0.15]
    shown = ((lower, upper), (lower,), (upper,))
    titles = ("two bodies, one place", "layer of body 1", "layer of body 2")
    for ax, bodies, title in zip(axes, shown, titles):
        draw_grid(ax, x, cells)
        for body in bodies:
            draw_body(ax, body, parts, BODY if body is lower else "#fdbe85")
            touched = set()
            for corner in body:
                i, j = np.floor(corner).astype(int)
                up = corner[1] - j > corner[0] - i
                touched |= {(i, j), (i + 1, j + 1), (i, j + 1) if up else (i + 1, j)}
            if len(bodies) == 1:
                ax.plot(*np.array(sorted(touched)).T, "s", color="#d95f0e", markersize=4, zorder=5)
        ax.set_title(title, fontsize=9)
    finish(axes, "layers")


if __name__ == "__main__":
    phases()
    subdomain()
    layers()
