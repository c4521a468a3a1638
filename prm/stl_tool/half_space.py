# Isochor: implicit, stabilised mixed Material Point Method on deal.II.
# SPDX-License-Identifier: LGPL-2.1-or-later
"""The punch of punch.stl on a linear elastic half space without friction:
pressures that are constant on n x n squares, whose displacements are Love's
(K. L. Johnson, Contact Mechanics, 3.25). Prints n, the force and the mean
distance of the pressure from the axis, which times the friction is the moment
of a punch that slips all over.

    python3 half_space.py 40
"""

import sys

import numpy as np

E, NU, DEPTH = 1e6, 0.3, 0.02
HALF, CORNER, EDGE = 0.5, 0.2, 0.04


def distance_from_outline(x, z):
    """Of a place in the punch's plan, inwards."""
    x, z = abs(x) - (HALF - CORNER), abs(z) - (HALF - CORNER)
    outside = np.hypot(np.maximum(x, 0), np.maximum(z, 0))
    return CORNER - outside - np.minimum(np.maximum(x, z), 0)


def influence(x, z, a):
    """Displacement at (x, z) by a unit pressure on |x|, |z| < a."""

    def term(s, t):
        return s * np.arcsinh(t / abs(s))

    total = 0
    for sx in (1, -1):
        for sz in (1, -1):
            u, v = x + sx * a, z + sz * a
            total = total + sx * sz * (term(u, v) + term(v, u))
    return total * (1 - NU**2) / (np.pi * E)


def main(n):
    size = 2 * HALF / n
    centres = -HALF + size * (np.arange(n) + 0.5)
    x, z = map(np.ravel, np.meshgrid(centres, centres))
    inside = distance_from_outline(x, z)
    x, z, inside = x[inside > 0], z[inside > 0], inside[inside > 0]
    rise = EDGE - np.sqrt(EDGE**2 - np.maximum(EDGE - inside, 0) ** 2)
    matrix = influence(
        x[:, None] - x[None, :], z[:, None] - z[None, :], size / 2
    )
    active = rise < DEPTH
    while True:
        pressure = np.zeros(len(x))
        pressure[active] = np.linalg.solve(
            matrix[np.ix_(active, active)], DEPTH - rise[active]
        )
        if pressure.min() >= 0:
            break
        active &= pressure > 0
    force = pressure.sum() * size**2
    lever = (pressure * np.hypot(x, z)).sum() / pressure.sum()
    print(n, round(force, 1), round(lever, 5), round(active.sum() * size**2, 4))


if __name__ == "__main__":
    main(int(sys.argv[1]))
