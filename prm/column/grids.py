# Isochor: implicit, stabilised mixed Material Point Method on deal.II.
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Irregular background grids of the column, as gmsh files."""

from pathlib import Path

import numpy as np


def write_jittered(path, columns, n, width, height, amplitude=0.25):
    """Squares of two triangles, 'columns' by n, whose vertices are moved at
    random by up to @p amplitude edge lengths; those on a side along it."""
    x, y = np.meshgrid(np.arange(columns + 1.0), np.arange(n + 1.0))
    shift = np.random.default_rng(1).uniform(-amplitude, amplitude, (2, *x.shape))
    shift[0][:, [0, -1]] = 0
    shift[1][[0, -1], :] = 0
    shift[:, [0, 0, -1, -1], [0, -1, 0, -1]] = 0  # corners
    x = (x + shift[0]) * width / columns
    y = (y + shift[1]) * height / n

    number = 1 + np.arange(x.size).reshape(x.shape)
    sides = [number[0], number[:, -1], number[-1], number[:, 0]]
    elements = [
        f"1 2 {side} {side} {a} {b}"
        for side, nodes in enumerate(sides, 1)
        for a, b in zip(nodes[:-1], nodes[1:])
    ]
    for a, b, c, d in zip(
        *(
            corner.ravel()
            for corner in (
                number[:-1, :-1],
                number[:-1, 1:],
                number[1:, 1:],
                number[1:, :-1],
            )
        )
    ):
        elements += [f"2 2 5 1 {a} {b} {c}", f"2 2 5 1 {a} {c} {d}"]

    names = ("bottom", "right", "top", "left")
    lines = ["$MeshFormat", "2.2 0 8", "$EndMeshFormat"]
    lines += ["$PhysicalNames", "5"]
    lines += [f'1 {tag} "{name}"' for tag, name in enumerate(names, 1)]
    lines += ['2 5 "column"', "$EndPhysicalNames", "$Nodes", str(x.size)]
    lines += [
        f"{i} {a:.16g} {b:.16g} 0"
        for i, a, b in zip(number.ravel(), x.ravel(), y.ravel())
    ]
    lines += ["$EndNodes", "$Elements", str(len(elements))]
    lines += [f"{i} {element}" for i, element in enumerate(elements, 1)]
    lines += ["$EndElements", ""]
    Path(path).write_text("\n".join(lines))
