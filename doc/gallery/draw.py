#!/usr/bin/env python3
# Isochor: implicit, stabilised mixed Material Point Method on deal.II.
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Make the small pictures of the first page (README.md): parts of the pictures of
the scenes, and for scenes without one a run. Needs gmsh for two of them.

    doc/gallery/draw.py                 all
    doc/gallery/draw.py column prandtl  these
"""

import sys
import tempfile
from pathlib import Path

GALLERY = Path(__file__).resolve().parent
PRM = GALLERY.parents[1] / "prm"
sys.path.insert(0, str(PRM / "tools"))

import isochor_output as output  # noqa: E402
from PIL import Image  # noqa: E402  (Matplotlib needs it, too)

WIDTH, HEIGHT = 330, 250  # pixels

# Pictures that are there: the file and which part of it to show, as fractions
# (left, top, right, bottom).
PARTS = {
    "tutorial": ("tutorial/bar_3d.png", (0, 0, 0.79, 1)),
    "cooks_membrane": ("cooks_membrane/pressure.png", (0.47, 0.52, 0.85, 0.93)),
    "cook_adaptive": ("cook_adaptive/grid.png", (0, 0, 1, 1)),
    "tension_plate": (
        "tension_plate/equivalent_plastic_strain.png",
        (0.493, 0.03, 0.885, 0.455),
    ),
    "strip_footing": (
        "strip_footing/equivalent_plastic_strain.png",
        (0.503, 0.06, 0.9, 0.89),
    ),
    "compression_block": ("compression_block/pressure.png", (0, 0, 0.76, 1)),
    "cooks_membrane_3d": ("cooks_membrane_3d/pressure.png", (0, 0, 0.74, 1)),
    "square_footing": ("square_footing/displacement_y.png", (0, 0, 0.76, 1)),
    "billet": ("billet/billet.png", (0.675, 0, 0.935, 1)),
    "vertical_cut": ("vertical_cut/shear_band.png", (0, 0, 0.46, 1)),
    "twisted_column": ("twisted_column/displacement_x.png", (0, 0, 0.5, 1)),
}


def store(image, name):
    """Save @p image as the picture @p name, no larger than the others and with
    128 colours."""
    image = image.convert("RGB")
    image.thumbnail((WIDTH, HEIGHT), Image.LANCZOS)
    canvas = Image.new("RGB", (WIDTH, HEIGHT), "white")
    canvas.paste(
        image, ((WIDTH - image.width) // 2, (HEIGHT - image.height) // 2)
    )
    path = GALLERY / f"{name}.png"
    canvas.quantize(128).save(path, optimize=True)
    print(f"wrote {path}")


def part_of_picture(name):
    path, (left, top, right, bottom) = PARTS[name]
    with Image.open(PRM / path) as image:
        w, h = image.size
        store(
            image.crop((int(left * w), int(top * h), int(right * w), int(bottom * h))),
            name,
        )


def draw(name, panels, **options):
    """Draw (points, field, window) side by side, without axes."""
    figure, axes = output.plt.subplots(
        1, len(panels), squeeze=False, figsize=(3.3, 2.5)
    )
    for ax, (points, field, window) in zip(axes.flat, panels):
        output.plot_points(
            ax, points, field, window=window, colour_bar=False, **options
        )
        ax.set_axis_off()
    path = GALLERY / f"{name}.png"
    figure.savefig(path, bbox_inches="tight", dpi=150)
    output.plt.close(figure)
    with Image.open(path) as image:
        store(image.copy(), name)


def column(directory):
    overrides = {"Quadrature/Type": "CPDI", "Grid/Subdivisions": "8, 64"}
    scene = PRM / "column" / "column.prm"
    output.run(scene, overrides, directory=directory, check=True)
    window = (-6, 12, -1, 51)
    last = len(output.read_times(directory)) - 1
    draw(
        "column",
        [
            (output.read_points(directory, step), "cauchy_stress_yy", window)
            for step in (0, last // 2, last)
        ],
        limits=(-4e4, 4e4),
    )


def plastic_cylinder(directory):
    mesh_file = directory / "ring.msh"
    output.make_mesh(PRM / "plastic_cylinder" / "ring.geo", mesh_file, n=16)
    scene = PRM / "plastic_cylinder" / "plastic_cylinder.prm"
    # the plastic zone has gone halfway through
    overrides = {"Grid/File": mesh_file, "Time/End time": 0.66}
    output.run(scene, overrides, directory=directory, check=True)
    points = output.read_points(directory)
    draw("plastic_cylinder", [(points, "equivalent_plastic_strain", None)])


def footing(name, scene, directory, rings=False):
    """The ground under a footing at collapse. @p rings: points are those of a
    section through a body of revolution, their volumes those of rings."""
    mesh_file = directory / "prandtl.msh"
    output.make_mesh(PRM / "prandtl" / "prandtl.geo", mesh_file, n=16)
    overrides = {"Grid/File": mesh_file}
    output.run(PRM / scene, overrides, directory=directory, check=True)
    points = output.read_points(directory)
    if rings:
        points["volume"] /= 2 * output.np.pi * points["position"][:, 0]
    top = points["position"][:, 1].max()
    width = 1.3 if rings else 2.2
    window = (0, width, top - 0.55 * width, top + 0.05)
    field = "equivalent_plastic_strain"
    # so that the fan shows beside the zone below the edge
    limits = (0, output.np.percentile(points[field], 97))
    draw(name, [(points, field, window)], limits=limits)


def prandtl(directory):
    footing("prandtl", "prandtl/prandtl.prm", directory)


def circular_footing(directory):
    scene = "circular_footing/circular_footing.prm"
    footing("circular_footing", scene, directory, rings=True)


RUNS = {
    "column": column,
    "plastic_cylinder": plastic_cylinder,
    "prandtl": prandtl,
    "circular_footing": circular_footing,
}


def main():
    for name in sys.argv[1:] or [*PARTS, *RUNS]:
        if name in PARTS:
            part_of_picture(name)
        else:
            with tempfile.TemporaryDirectory() as directory:
                RUNS[name](Path(directory))


if __name__ == "__main__":
    main()
