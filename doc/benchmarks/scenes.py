# Isochor: implicit, stabilised mixed Material Point Method on deal.II.
# SPDX-License-Identifier: LGPL-2.1-or-later
"""The scenes of the benchmarks: what is varied, and what is right.

A scene to add is one class, a harness.Scene, in one of the modules imported here, and a
line in SCENES.
"""

from elastic_scenes import Column, Column3D, Cook, Tube
from plastic_scenes import Footing, PlasticCylinder, Plate, Prandtl
from vibration_scenes import Cantilever, TubeVibration

SCENES = {
    scene.name: scene
    for scene in (
        Cook,
        Tube,
        Column,
        PlasticCylinder,
        Prandtl,
        Plate,
        Footing,
        TubeVibration,
        Cantilever,
        Column3D,
    )
}
