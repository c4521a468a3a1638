# Isochor: implicit, stabilised mixed Material Point Method on deal.II.
# SPDX-License-Identifier: LGPL-2.1-or-later
"""What the stress tests of stability.py share: running scenes, keeping numbers."""

import harness
import numpy as np
import programs
from harness import HERE, PRM, QUIET, output, shortened  # noqa: F401

plt = output.plt
COOK = PRM / "cooks_membrane" / "cooks_membrane.prm"
SCENES = HERE / "scenes"


class Bench:
    """Runs scenes, keeps what was found."""

    def __init__(self, arguments):
        self.arguments = arguments
        self.directory = arguments.directory
        self.quick = arguments.quick
        self.results = {}  # test: list of (what, value, bound, kept)

    def run(self, prm, overrides, name, processes=1):
        """Statistics of a run. Raises OutputError with the end of its log."""
        run = harness.Run("", name, 0, prm, {**QUIET, **overrides}, False, processes)
        place = self.place_of(name)
        harness.execute(
            self.arguments.executable, run, place, harness.Cost([], []), 1800
        )
        return output.read_statistics(place)

    def place_of(self, name):
        """Where run() writes."""
        return self.directory / "runs" / harness.Run("", name, 0, COOK).name

    def check(self, test, what, value, bound, kept):
        self.results.setdefault(test, []).append(
            (what, value, bound, bool(kept))
        )
        print(
            f"{test}: {what}: {value} (bound: {bound})"
            + ("" if kept else "   NOT KEPT"),
            flush=True,
        )

    def save(self, figure, name):
        programs.save(figure, self.directory / f"stability_{name}")


def oscillation(directory):
    """How much the pressure of neighbouring nodes differs from a smooth field:
    the root mean square over nodes of the pressure less the mean of its
    neighbours, relative to that of the pressure."""
    grid = output.read_grid(directory)
    pressure, triangles = grid["pressure"], grid["triangles"]
    # nodes are written once for each cell
    _, number = np.unique(
        np.round(grid["position"][:, :2], 9), axis=0, return_inverse=True
    )
    number = number.ravel()
    n = number.max() + 1
    value = np.zeros(n)
    value[number] = pressure
    corners = number[triangles]
    total, count = np.zeros(n), np.zeros(n)
    for a, b in ((0, 1), (1, 2), (2, 0)):
        for i, j in ((a, b), (b, a)):
            np.add.at(total, corners[:, i], value[corners[:, j]])
            np.add.at(count, corners[:, i], 1)
    used = count > 0
    rough = value[used] - total[used] / count[used]
    return float(np.sqrt(np.mean(rough**2) / np.mean(value[used] ** 2)))
