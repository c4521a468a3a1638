# Isochor: implicit, stabilised mixed Material Point Method on deal.II.
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Run the scene and draw the strip at a quarter, half and a full turn:

    python3 draw.py --executable /where/isochor
"""

import argparse
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent / "tools"))
import isochor_output as output  # noqa: E402
import matplotlib  # noqa: E402

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402

TURNS = [(0.25, "a quarter"), (0.5, "half"), (1.0, "a full turn")]


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--executable", default="isochor")
    parser.add_argument("--output", default="output")
    arguments = parser.parse_args()
    output.run(
        HERE / "bent_ring.prm",
        {"Time/Output interval": 0.25},
        arguments.executable,
        arguments.output,
        check=True,
    )
    figure, axes = plt.subplots(1, 3, figsize=(11, 3.6))
    for ax, (time, name) in zip(axes, TURNS):
        data = output.read_points_at(arguments.output, time)
        artist = output.plot_points(
            ax,
            data,
            "pressure",
            limits=(-0.4, 0.4),
            scale=1e-3,
            colour_bar=False,
        )
        ax.set_title(name)
        ax.set_xlim(-2, 8.5)
        ax.set_ylim(-1, 6)
    output.add_colour_bar(artist, axes, "pressure", unit="kPa")
    output.save(figure, HERE / "ring.png")


if __name__ == "__main__":
    main()
