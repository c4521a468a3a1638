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
import solid_view  # noqa: E402


def main(directory, picture):
    figure, ax = output.plt.subplots(figsize=(8, 5))
    solid_view.plot_solid(
        ax,
        output.read_points(directory),
        "von_mises_stress",
        azimuth=38,
        elevation=24,
        cut="xz",
        limits=(0, 25),
        scale=1e-3,
        unit="kPa",
        rigid=output.read_output(directory, "rigid_bodies"),
    )
    output.save(figure, picture)


if __name__ == "__main__":
    main(*sys.argv[1:3])
