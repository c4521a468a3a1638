#!/usr/bin/env python3
# Isochor: implicit, stabilised mixed Material Point Method on deal.II.
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Run the scenes of the first page (README.md) and draw their pictures, all in
one style; and strip.png, the four at its top. Needs gmsh.

    doc/gallery/draw.py                        all, half an hour
    doc/gallery/draw.py column prandtl strip   these
    doc/gallery/draw.py --runs directory ...   keep the runs, use those that are there
"""

import argparse
import sys
import tempfile
from collections import namedtuple
from pathlib import Path

GALLERY = Path(__file__).resolve().parent
PRM = GALLERY.parents[1] / "prm"
sys.path.insert(0, str(PRM / "tools"))

import isochor_output as output  # noqa: E402
import numpy as np  # noqa: E402
import solid_view  # noqa: E402
from PIL import Image  # noqa: E402  (Matplotlib needs it, too)

SIZE = 4.4, 3.3  # inches, at 150 dpi
STRAIN, PRESSURE = "equivalent_plastic_strain", "pressure"

# A scene: its file, the arguments of gmsh, parameters that aren't the file's, and
# the one that names the mesh.
Scene = namedtuple(
    "Scene", "prm mesh overrides parameter", defaults=((), {}, "Grid/File")
)
BODY_MESH = "Material points/Body mesh"
TIMES = "Time/Output interval"
SCENES = {
    "tutorial": Scene("tutorial/bar_3d.prm"),
    "cooks_membrane": Scene(
        "cooks_membrane/cooks_membrane.prm",
        (),
        {
            "Grid/Subdivisions": "32, 32",
            "Quadrature/Type": "CPDI",
            "Material/Poisson ratio": "0.499",
        },
    ),
    "cook_adaptive": Scene(
        "cook_adaptive/cook_adaptive.prm",
        (),
        {"Adaptive grid/Target of relative error": "0.08"},
    ),
    "column": Scene(
        "column/column.prm",
        (),
        {"Quadrature/Type": "CPDI", "Grid/Subdivisions": "8, 64", TIMES: "0.5"},
    ),
    "tension_plate": Scene(
        "tension_plate/tension_plate.prm",
        ("plate.geo", 2, {"h": 0.002}, "plate.msh"),
        {"Quadrature/Type": "CPDI", "Material points/Points per cell": "3", TIMES: "1"},
    ),
    "plastic_cylinder": Scene(
        "plastic_cylinder/plastic_cylinder.prm",
        ("ring.geo", 2, {"n": 16}, "ring.msh"),
        {"Time/End time": "0.66"},
    ),
    "prandtl": Scene(
        "prandtl/prandtl.prm",
        ("prandtl.geo", 2, {"n": 16}, "prandtl.msh"),
        {"Quadrature/Type": "CPDI", "Material points/Points per cell": "3"},
    ),
    "strip_footing": Scene(
        "strip_footing/adaptive.prm",
        ("coarse.geo", 2, {}, "footing_coarse.msh"),
        {TIMES: "1"},
    ),
    "compression_block": Scene("compression_block/compression_block.prm", (), {TIMES: "1"}),
    "cooks_membrane_3d": Scene("cooks_membrane_3d/cooks_membrane_3d.prm", (), {TIMES: "1"}),
    "square_footing": Scene(
        "square_footing/square_footing.prm",
        ("square_footing.geo", 3, {"n": 12}, "square_footing.msh"),
    ),
    "twisted_column": Scene(
        "twisted_column/twisted_column.prm", ("column.geo", 3, {"n": 5}, "twisted_column.msh")
    ),
    "vertical_cut": Scene("vertical_cut/vertical_cut.prm", (), {TIMES: "0.05"}),
    "circular_footing": Scene(
        "circular_footing/circular_footing.prm",
        ("../prandtl/prandtl.geo", 2, {"n": 16}, "prandtl.msh"),
        {"Quadrature/Type": "CPDI", "Material points/Points per cell": "3"},
    ),
    "bent_ring": Scene("bent_ring/bent_ring.prm", (), {TIMES: "0.25"}),
    "billet": Scene("billet/billet.prm", ("billet.geo", 3, {"n": 6}, "billet.msh")),
    "bearing": Scene("bearing/bearing.prm"),
    "ring_compression": Scene("ring_compression/ring_compression.prm"),
    "stl_tool": Scene("stl_tool/stl_tool.prm"),
    "pipe": Scene(
        "pipe/pipe.prm", ("pipe.geo", 2, {"n": 8}, "pipe.msh"), {}, BODY_MESH
    ),
    "cone": Scene("cone/cone.prm", ("cone.geo", 2, {"n": 6}, "cone.msh")),
    "shallow_ironing": Scene(
        "shallow_ironing/shallow_ironing.prm",
        ("ironing.geo", 2, {"h": 0.2}, "ironing.msh"),
        {"Grid/Subdivisions": "65, 28", "Time/End time": 1.8, TIMES: 1.8},
        BODY_MESH,
    ),
}


def run(name, runs):
    """The directory of the scene's output; it is run if it isn't there."""
    scene, directory = SCENES[name], runs / name
    if (directory / "finished").exists():
        return directory
    directory.mkdir(parents=True, exist_ok=True)
    file, overrides = PRM / scene.prm, dict(scene.overrides)
    if scene.mesh:
        geometry, dimension, numbers, mesh = scene.mesh
        overrides[scene.parameter] = output.make_mesh(
            file.parent / geometry, directory / mesh, dimension, **numbers
        )
    check = name != "vertical_cut"  # which is run until it falls
    output.run(file, overrides, directory=directory, check=check)
    (directory / "finished").touch()
    return directory


def plane(axes, directory, field, step=-1, grid=False, **options):
    """Draw a body in the plane without a frame, with the cells of the grid or
    without them."""
    data = output.read_points(directory, step)
    output.plot_points(axes, data, field, colour_bar=False, **options)
    if grid:
        cells = output.read_output(directory, "grid", step)
        x, y = cells["position"][:, :2].T
        axes.triplot(x, y, cells["cells"], color="#505050", linewidth=0.2)
    axes.set_axis_off()


def solid(axes, directory, field, planes="", **options):
    data = output.mirrored(output.read_points(directory), planes)
    solid_view.plot_solid(axes, data, field, colour_bar=False, **options)


def column(axes, directory):
    for shift, step in enumerate((0, 1, -1)):
        data = output.read_points(directory, step)
        for name in ("position", "corners"):
            data[name][..., 0] += 14 * shift
        output.plot_points(
            axes, data, "cauchy_stress_yy", limits=(-4e4, 4e4), colour_bar=False
        )
    axes.set_xlim(-8, 42)
    axes.set_axis_off()


def bent_ring(axes, directory):
    for step in (0, 1, -1):
        plane(axes, directory, PRESSURE, step, limits=(-400, 400))


def footing(axes, directory, width):
    data = output.read_points(directory)
    top = data["position"][:, 1].max()
    window = (-width, width, top - 0.75 * width, top + 0.05)
    # so that the fan shows beside the zone below the edge
    limits = (0, 1.5 * np.percentile(data[STRAIN], 97))
    plane(axes, directory, STRAIN, window=window, mirror=True, limits=limits)


def strip_footing(axes, directory):
    window = (-2.6, 2.6, 6.9, 10.8)
    plane(axes, directory, STRAIN, window=window, mirror=True, limits=(0, 3))
    axes.fill([-0.5, 0.5, 0.5, -0.5], [8, 8, 10.8, 10.8], color=solid_view.GREY)


def pipe(axes, directory):
    plane(axes, directory, STRAIN, window=(-4, 4, -3.3, 2.7), mirror=True)
    angle = np.linspace(0, 2 * np.pi, 200)
    axes.fill(np.cos(angle), np.sin(angle) - 0.3, color=solid_view.GREY)


def cone(axes, directory):
    window = (-6.5, 6.5, -9, 0.8)
    plane(axes, directory, STRAIN, window=window, mirror=True, limits=(0, 2))
    x = np.array([0, 0.17, 1, 1])
    y = np.array([-8, -7.9, -6.47, 0.8])
    axes.fill([*x, *-x[::-1]], [*y, *y[::-1]], color=solid_view.GREY)


def ring_compression(axes, directory):
    """Half of the ring, its section turned about the axis."""
    data = output.read_points(directory)
    section, cells = output.body_mesh(data)
    values = output.vertex_values(data, cells, output.field(data, STRAIN))
    edges, _ = output.outer_faces(cells)
    angles = np.linspace(-0.3 * np.pi, 1.2 * np.pi, 91)
    place = lambda x, a: np.stack([x[..., 0] * np.sin(a), x[..., 1], x[..., 0] * np.cos(a)], -1)
    parts = [place(section[cells], angles[k]) for k in (0, -1)]
    colours = [values[cells]] * 2
    for a, b in zip(angles[:-1], angles[1:]):
        e = section[edges]
        p = [place(e[:, 0], a), place(e[:, 1], a), place(e[:, 1], b), place(e[:, 0], b)]
        v = values[edges]
        parts += [np.stack([p[0], p[1], p[2]], 1), np.stack([p[0], p[2], p[3]], 1)]
        colours += [v[:, [0, 1, 1]], v[:, [0, 1, 0]]]
    solid_view.plot_triangles(
        axes, np.concatenate(parts), np.concatenate(colours), STRAIN, 25, 32, (0, 1.0)
    )


PICTURES = {
    "tutorial": lambda a, d: solid(a, d, "cauchy_stress_xx", "z", azimuth=25, elevation=20),
    "cooks_membrane": lambda a, d: plane(a, d, PRESSURE),
    "cook_adaptive": lambda a, d: plane(a, d, PRESSURE, grid=True),
    "column": column,
    "tension_plate": lambda a, d: plane(a, d, STRAIN),
    "plastic_cylinder": lambda a, d: plane(a, d, STRAIN),
    "prandtl": lambda a, d: footing(a, d, 2.2),
    "strip_footing": strip_footing,
    "compression_block": lambda a, d: solid(a, d, PRESSURE, "xz"),
    "cooks_membrane_3d": lambda a, d: solid(a, d, PRESSURE, azimuth=20),
    "square_footing": lambda a, d: solid(a, d, STRAIN, azimuth=225, limits=(0, 0.02)),
    "twisted_column": lambda a, d: solid(a, d, "displacement_x", azimuth=20, elevation=12),
    "vertical_cut": lambda a, d: plane(a, d, STRAIN, window=(0, 9, 1, 6.05), limits=(0, 0.006)),
    "circular_footing": lambda a, d: footing(a, d, 1.2),
    "bent_ring": bent_ring,
    "billet": lambda a, d: solid(a, d, STRAIN, "xyz", azimuth=45, elevation=20, cut="xz"),
    "bearing": lambda a, d: plane(a, d, "cauchy_stress_xy", limits=(-1.5e6, 1.5e6)),
    "ring_compression": ring_compression,
    "pipe": pipe,
    "cone": cone,
    "shallow_ironing": lambda a, d: plane(a, d, "cauchy_stress_yy", limits=(-500, 500)),
    "stl_tool": lambda a, d: solid(
        a,
        d,
        "von_mises_stress",
        azimuth=38,
        elevation=24,
        cut="xz",
        limits=(0, 25e3),
        rigid=output.read_output(d, "rigid_bodies"),
    ),
}
STRIP = ("stl_tool", "twisted_column", "ring_compression", "strip_footing")


def trimmed(path):
    """The picture @p path without its white frame."""
    with Image.open(path) as image:
        image = image.convert("RGB")
    dark = np.array(image).min(axis=2) < 250
    rows, columns = np.flatnonzero(dark.any(axis=1)), np.flatnonzero(dark.any(axis=0))
    return image.crop((columns[0], rows[0], columns[-1] + 1, rows[-1] + 1))


def store(image, name):
    path = GALLERY / f"{name}.png"
    image.save(path, optimize=True)
    if path.stat().st_size > 150_000:
        palette = image.quantize(256, kmeans=3)
        colours = np.array(palette.getpalette()).reshape(-1, 3)
        colours[colours.min(axis=1) > 247] = 255  # white stays white
        palette.putpalette(colours.ravel().tolist())
        dither = Image.Dither.FLOYDSTEINBERG
        image.quantize(palette=palette, dither=dither).save(path, optimize=True)
    print(f"wrote {path}, {path.stat().st_size // 1000} kB")


def on_canvas(image, width, height):
    image.thumbnail((width - 8, height - 8), Image.LANCZOS)
    canvas = Image.new("RGB", (width, height), "white")
    canvas.paste(image, ((width - image.width) // 2, (height - image.height) // 2))
    return canvas


def picture(name, runs):
    figure, axes = output.plt.subplots(figsize=SIZE)
    PICTURES[name](axes, run(name, runs))
    path = runs / f"{name}.png"
    figure.savefig(path, bbox_inches="tight", dpi=220)
    output.plt.close(figure)
    return trimmed(path)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--runs", type=Path)
    parser.add_argument("names", nargs="*")
    arguments = parser.parse_args()
    with tempfile.TemporaryDirectory() as directory:
        runs = (arguments.runs or Path(directory)).resolve()
        for name in arguments.names or [*PICTURES, "strip"]:
            if name == "strip":
                parts = [on_canvas(picture(n, runs), 420, 330) for n in STRIP]
                strip = Image.new("RGB", (420 * len(parts), 330), "white")
                for k, part in enumerate(parts):
                    strip.paste(part, (420 * k, 0))
                store(strip, "strip")
            else:
                store(on_canvas(picture(name, runs), 480, 360), name)


if __name__ == "__main__":
    main()
