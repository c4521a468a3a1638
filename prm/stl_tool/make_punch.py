# Isochor: implicit, stabilised mixed Material Point Method on deal.II.
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Write punch.stl: a square punch, 1 m wide and 0.6 m high, that stands on
y = 0. In plan its corners are rounded by 0.2 m, its lower edge by 0.04 m."""

import math

HALF, CORNER, EDGE, HEIGHT = 0.5, 0.2, 0.04, 0.6
CORNER_STEPS, EDGE_STEPS = 4, 3


def outline(inset, y):
    """The outline in plan, @p inset from the outer one, at the height @p y."""
    points = []
    for quarter in range(4):
        for k in range(CORNER_STEPS + 1):
            angle = math.pi / 2 * (quarter + k / CORNER_STEPS)
            centre = [HALF - CORNER, HALF - CORNER]
            if quarter in (1, 2):
                centre[0] = -centre[0]
            if quarter in (2, 3):
                centre[1] = -centre[1]
            radius = CORNER - inset
            points.append(
                (
                    centre[0] + radius * math.cos(angle),
                    y,
                    centre[1] + radius * math.sin(angle),
                )
            )
    return points


def normal(a, b, c):
    u = [b[i] - a[i] for i in range(3)]
    v = [c[i] - a[i] for i in range(3)]
    n = [
        u[1] * v[2] - u[2] * v[1],
        u[2] * v[0] - u[0] * v[2],
        u[0] * v[1] - u[1] * v[0],
    ]
    size = math.sqrt(sum(x * x for x in n))
    return [x / size for x in n]


def main():
    rings = []
    for k in range(EDGE_STEPS + 1):
        angle = math.pi / 2 * k / EDGE_STEPS
        rings.append(
            outline(EDGE * (1 - math.sin(angle)), EDGE * (1 - math.cos(angle)))
        )
    rings.append(outline(0, HEIGHT))
    n = len(rings[0])
    triangles = []
    for i in range(1, n - 1):
        low, high = rings[0], rings[-1]
        triangles.append((low[0], low[i], low[i + 1]))
        triangles.append((high[0], high[i + 1], high[i]))
    for lower, upper in zip(rings, rings[1:]):
        for i in range(n):
            j = (i + 1) % n
            triangles.append((lower[i], upper[i], upper[j]))
            triangles.append((lower[i], upper[j], lower[j]))
    with open("punch.stl", "w") as out:
        out.write("solid punch\n")
        for corners in triangles:
            out.write("facet normal %.6g %.6g %.6g\nouter loop\n" % tuple(normal(*corners)))
            for corner in corners:
                out.write("vertex %.9g %.9g %.9g\n" % corner)
            out.write("endloop\nendfacet\n")
        out.write("endsolid punch\n")


if __name__ == "__main__":
    main()
