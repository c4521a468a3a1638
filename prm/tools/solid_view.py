# Isochor: implicit, stabilised mixed Material Point Method on deal.II.
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Draw bodies in 3D: the material points as discs, from the far ones to the
near ones, so that near ones hide what is behind them. Needs no display.

    python3 prm/tools/solid_view.py output field picture.png
"""

import argparse
import sys

import isochor_output as output
import numpy as np
from matplotlib.collections import EllipseCollection


def view_axes(azimuth, elevation):
    """Unit vectors to the right, upwards, and to the eye, that looks at the body
    from @p azimuth (from the z axis to the x axis) and @p elevation above the
    x-z plane (degrees). y points upwards."""
    a, e = np.radians([azimuth, elevation])
    eye = np.array([np.sin(a) * np.cos(e), np.sin(e), np.cos(a) * np.cos(e)])
    right = np.array([np.cos(a), 0, -np.sin(a)])
    return right, np.cross(eye, right), eye


def mirrored(data, names, planes):
    """The fields @p names and 'position' and 'volume' of @p data with the mirror
    images at the coordinate @p planes, for example "xz" for x = 0 and z = 0."""
    result = {n: data[n] for n in {*names, "position", "volume"}}
    for plane in planes:
        image = dict(result)
        image["position"] = result["position"] * [
            -1 if c == plane else 1 for c in "xyz"
        ]
        result = {n: np.concatenate([result[n], image[n]]) for n in result}
    return result


def plot_solid(
    ax,
    data,
    field_name,
    azimuth=35,
    elevation=25,
    cut=None,
    limits=None,
    scale=1.0,
    unit=None,
):
    """Draw the field @p field_name of the material points @p data into @p ax.
    @p cut: a function of the positions (n, 3) that says which points to show;
    @p limits, @p scale and @p unit as for isochor_output.plot_points()."""
    style = output.FIELD_STYLES.get(
        field_name, output.Style(field_name, "", "viridis", "free")
    )
    position, volume = data["position"], data["volume"]
    values = output.field(data, field_name) * scale
    if cut is not None:
        shown = cut(position)
        position, volume, values = position[shown], volume[shown], values[shown]
    right, up, eye = view_axes(azimuth, elevation)
    order = np.argsort(position @ eye)  # far ones first
    position, volume, values = position[order], volume[order], values[order]
    diameter = 1.7 * np.cbrt(np.maximum(volume, 0))
    limits = limits or output.colour_limits([values], style.limits)
    discs = EllipseCollection(
        diameter,
        diameter,
        np.zeros(len(diameter)),
        units="xy",
        offsets=np.column_stack([position @ right, position @ up]),
        transOffset=ax.transData,
        array=values,
        cmap=output.with_grey(style.colour_map),
        linewidths=0.15,
        edgecolors=(0, 0, 0, 0.35),
        rasterized=True,
    )
    discs.set_clim(*limits)
    ax.add_collection(discs)
    ax.update_datalim(np.column_stack([position @ right, position @ up]))
    ax.autoscale_view()
    ax.set_aspect("equal")
    ax.set_axis_off()
    output.add_colour_bar(discs, ax, field_name, values, unit)
    return discs


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("directory", help="of the run's output")
    parser.add_argument("field")
    parser.add_argument("picture")
    parser.add_argument("--mirror", default="", help='planes of symmetry: "xz"')
    parser.add_argument("--azimuth", type=float, default=35)
    parser.add_argument("--elevation", type=float, default=25)
    parser.add_argument("--scale", type=float, default=1)
    parser.add_argument("--unit")
    arguments = parser.parse_args()
    try:
        data = output.read_points(arguments.directory)
        data[arguments.field] = output.field(data, arguments.field)
    except output.OutputError as error:
        sys.exit(f"Error: {error}")
    data = mirrored(data, [arguments.field], arguments.mirror)
    figure, ax = output.plt.subplots(figsize=(5, 4))
    plot_solid(
        ax,
        data,
        arguments.field,
        arguments.azimuth,
        arguments.elevation,
        scale=arguments.scale,
        unit=arguments.unit,
    )
    figure.savefig(arguments.picture, bbox_inches="tight")


if __name__ == "__main__":
    main()
