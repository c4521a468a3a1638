#!/usr/bin/env python3
# Isochor: implicit, stabilised mixed Material Point Method on deal.II.
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Write scenes/necking.prm for CalculiX (Debian's package calculix-ccx): quadratic
axisymmetric elements with reduced integration, an independent reference.

    necking_calculix.py RADIAL AXIAL NAME     writes NAME.inp
    ccx NAME                                  writes NAME.dat

prints of the neck u_r (mm) and of the end a force to be multiplied by 180 (a sector of
two degrees). With CalculiX 2.20, steps of at most 0.005, at 3.5 and 7 mm:

    5 x 20    -0.860 mm  73.51 kN   -4.302 mm  21.2 kN
    10 x 40   -0.852     73.62      -4.331     18.5
    20 x 80   -0.847     73.68      -4.363     17.5

With steps of 0.04, 0.01 and 0.0025 10 x 40 elements give -4.588, -4.373 and -4.311 mm.
"""

import sys

import numpy as np

RADIUS, LENGTH, TAPER = 6.413, 26.667, 0.982


def places(radial, axial):
    """Corner and midside nodes: {(i, j): (number, r, z)}, rows finer at the neck."""
    s = np.linspace(0, 1, 2 * axial + 1)
    z = LENGTH * np.expm1(1.5 * s) / np.expm1(1.5)
    z[1::2] = (z[:-1:2] + z[2::2]) / 2
    nodes = {}
    for j in range(2 * axial + 1):
        radius = RADIUS * (TAPER + (1 - TAPER) * z[j] / LENGTH)
        for i in range(2 * radial + 1):
            if i % 2 == 0 or j % 2 == 0:
                nodes[i, j] = (len(nodes) + 1, radius * i / (2 * radial), z[j])
    return nodes


def hardening(plastic_strain):
    return 450 + 129.24 * plastic_strain + 265 * -np.expm1(-16.93 * plastic_strain)


def lines(radial, axial):
    nodes = places(radial, axial)
    yield "*NODE,NSET=NALL"
    for number, r, z in nodes.values():
        yield f"{number},{r:.9g},{z:.9g},0"
    yield "*ELEMENT,TYPE=CAX8R,ELSET=EALL"
    for j in range(axial):
        for i in range(radial):
            corners = [(0, 0), (2, 0), (2, 2), (0, 2), (1, 0), (2, 1), (1, 2), (0, 1)]
            numbers = (nodes[2 * i + a, 2 * j + b][0] for a, b in corners)
            yield f"{j * radial + i + 1}," + ",".join(map(str, numbers))
    sets = {
        "AXIS": lambda i, j: i == 0,
        "BOTTOM": lambda i, j: j == 0,
        "TOP": lambda i, j: j == 2 * axial,
        "NECK": lambda i, j: (i, j) == (2 * radial, 0),
    }
    for name, is_in in sets.items():
        yield f"*NSET,NSET={name}"
        yield from (f"{node[0]}," for place, node in nodes.items() if is_in(*place))
    yield "*MATERIAL,NAME=METAL\n*ELASTIC\n206900,.29\n*PLASTIC"
    for strain in np.concatenate([np.linspace(0, 0.3, 61), np.linspace(0.32, 4, 90)]):
        yield f"{hardening(strain):.5f},{strain:.6f}"
    yield "*SOLID SECTION,ELSET=EALL,MATERIAL=METAL"
    yield "*STEP,NLGEOM,INC=2000\n*STATIC\n0.005,1.,1e-7,0.005"
    yield "*BOUNDARY\nAXIS,1,1\nBOTTOM,2,2\nTOP,1,1\nTOP,2,2,7."
    yield "*NODE PRINT,NSET=NECK,FREQUENCY=20\nU"
    yield "*NODE PRINT,NSET=BOTTOM,TOTALS=ONLY,FREQUENCY=20\nRF\n*END STEP"


def main():
    if len(sys.argv) != 4:
        sys.exit(__doc__)
    with open(sys.argv[3] + ".inp", "w", encoding="utf-8") as file:
        file.writelines(line + "\n" for line in lines(int(sys.argv[1]), int(sys.argv[2])))


if __name__ == "__main__":
    main()
