#!/usr/bin/env python3
# Isochor: implicit, stabilised mixed Material Point Method on deal.II.
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Draw the cells of the adaptive grid and the plastic strain at several settlements.

    draw_grid.py [OUTPUT] [PICTURE]

OUTPUT is the directory that adaptive.prm has written (default: output).
"""

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "tools"))

import isochor_output as output  # noqa: E402

SETTLEMENTS = (0.25, 1, 2)  # w / B, and w in metres


def main():
    directory = Path(sys.argv[1] if len(sys.argv) > 1 else "output")
    picture = Path(sys.argv[2] if len(sys.argv) > 2 else "adaptive_grid.png")
    times = [time for time, _ in output.read_times(directory)]
    figure, axes = output.plt.subplots(
        2, len(SETTLEMENTS), figsize=(10, 6.8), constrained_layout=True
    )
    for above, below, settlement in zip(*axes, SETTLEMENTS):
        step = min(range(len(times)), key=lambda i: abs(times[i] - settlement))
        grid = output.read_grid(directory, step)
        above.triplot(
            grid["position"][:, 0],
            grid["position"][:, 1],
            grid["triangles"],
            **output.GRID_LINES,
        )
        above.set_title(f"w = {times[step]:.3g} B")
        artist = output.plot_points(
            below,
            output.read_points(directory, step),
            "equivalent_plastic_strain",
            limits=(0, 1),
            colour_bar=False,
        )
        for ax in (above, below):
            ax.set(aspect="equal", xlim=(0, 4), ylim=(6.2, 10.6))
            ax.set_axis_off()
    output.add_colour_bar(
        artist, axes[1], "equivalent_plastic_strain", location="bottom", shrink=0.4
    )
    output.save(figure, picture)


if __name__ == "__main__":
    try:
        main()
    except output.OutputError as problem:
        sys.exit(f"Error: {problem}")
