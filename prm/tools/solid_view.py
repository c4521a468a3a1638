# Isochor: implicit, stabilised mixed Material Point Method on deal.II.
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Draw bodies in 3D: the outer faces of their subdomains (CPDI), coloured by a
field, with rigid bodies if there are any. Needs no display.

    python3 prm/tools/solid_view.py output von_mises_stress picture.png
"""

import argparse
import sys

import isochor_output as output
import numpy as np
from matplotlib import cm, colors
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import VTK_TETRA, vtkCellArray, vtkPlane
from vtkmodules.vtkCommonDataModel import vtkUnstructuredGrid
from vtkmodules.vtkFiltersGeneral import vtkDataSetTriangleFilter
from vtkmodules.vtkFiltersGeneral import vtkTableBasedClipDataSet

GREY = (0.62, 0.65, 0.70)  # of rigid bodies


def view_axes(azimuth, elevation):
    """Unit vectors to the right, upwards, and to the eye, that looks at the body
    from @p azimuth (from the z axis to the x axis) and @p elevation above the
    x-z plane (degrees). y points upwards."""
    a, e = np.radians([azimuth, elevation])
    eye = np.array([np.sin(a) * np.cos(e), np.sin(e), np.cos(a) * np.cos(e)])
    right = np.array([np.cos(a), 0, -np.sin(a)])
    return right, np.cross(eye, right), eye


def clip(vertices, cells, values, axis, sign):
    """The part of a mesh of tetrahedra where sign * x[axis] > 0."""
    grid, points, connectivity = vtkUnstructuredGrid(), vtkPoints(), vtkCellArray()
    points.SetData(numpy_to_vtk(np.ascontiguousarray(vertices), deep=1))
    offsets = np.arange(0, cells.size + 1, 4)
    connectivity.SetData(
        numpy_to_vtk(offsets.astype(np.int64), deep=1),
        numpy_to_vtk(cells.ravel().astype(np.int64), deep=1),
    )
    grid.SetPoints(points)
    grid.SetCells(VTK_TETRA, connectivity)
    array = numpy_to_vtk(values, deep=1)
    array.SetName("values")
    grid.GetPointData().AddArray(array)
    plane, cut = vtkPlane(), vtkTableBasedClipDataSet()
    plane.SetNormal(*(sign * np.eye(3)[axis]))
    cut.SetInputData(grid)
    cut.SetClipFunction(plane)
    cut.Update()
    simplices = vtkDataSetTriangleFilter()  # wedges of the cut become tetrahedra
    simplices.SetInputConnection(cut.GetOutputPort())
    simplices.TetrahedraOnlyOn()
    simplices.Update()
    part = simplices.GetOutput()
    kept = vtk_to_numpy(part.GetCells().GetConnectivityArray()).reshape(-1, 4)
    return (
        vtk_to_numpy(part.GetPoints().GetData()).astype(float),
        kept.copy(),
        vtk_to_numpy(part.GetPointData().GetArray("values")).copy(),
    )


def outer_surface(vertices, cells, values):
    """Triangles (n, 3, 3) of the surface, @p values and normals at their corners;
    normals are smooth where the surface has no edge."""
    faces, inside = output.outer_faces(cells)
    corners = vertices[faces]
    normal = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    length = np.linalg.norm(normal, axis=1)
    unit = normal / np.maximum(length, 1e-300)[:, None]
    outwards = np.einsum("ij,ij->i", unit, corners[:, 0] - vertices[inside])
    unit[outwards < 0] *= -1
    mean = np.zeros_like(vertices)
    for c in range(3):
        np.add.at(mean, faces[:, c], unit * length[:, None])
    mean /= np.maximum(np.linalg.norm(mean, axis=1), 1e-300)[:, None]
    smooth = mean[faces]
    edge = np.einsum("ijk,ik->ij", smooth, unit) < 0.93
    smooth[edge] = np.repeat(unit[:, None], 3, axis=1)[edge]
    return corners, values[faces], smooth


class Canvas:
    """A picture of shaded triangles with depth."""

    def __init__(self, low, high, axes, pixels):
        self.axes, self.low = axes, np.array(low)
        self.scale = pixels / max(np.array(high) - low)
        self.shape = np.ceil((np.array(high) - low)[::-1] * self.scale).astype(int) + 1
        self.depth = np.full(self.shape, -np.inf)
        self.normal = np.zeros((*self.shape, 3))
        self.colour = np.ones((*self.shape, 3))

    def draw(self, corners, values, normals, colour_of):
        """@p colour_of gives colours (n, 3) for values (n)."""
        x = corners @ np.array(self.axes).T  # right, up, depth
        x[..., :2] = (x[..., :2] - self.low) * self.scale
        area = np.cross(x[:, 1, :2] - x[:, 0, :2], x[:, 2, :2] - x[:, 0, :2])
        lows = np.clip(np.floor(x[..., :2].min(axis=1)).astype(int), 0, None)
        highs = np.ceil(x[..., :2].max(axis=1)).astype(int) + 1
        value = np.zeros(self.shape)
        seen = np.zeros(self.shape, dtype=bool)
        for t in np.flatnonzero(np.abs(area) > 1e-9):
            (i0, j0), (i1, j1) = lows[t], highs[t]
            i1, j1 = min(i1, self.shape[1]), min(j1, self.shape[0])
            px, py = np.arange(i0, i1)[None, :], np.arange(j0, j1)[:, None]
            (ax, ay, az), (bx, by, bz), (cx, cy, cz) = x[t]
            u = ((bx - px) * (cy - py) - (by - py) * (cx - px)) / area[t]
            v = ((cx - px) * (ay - py) - (cy - py) * (ax - px)) / area[t]
            w = 1 - u - v
            z = u * az + v * bz + w * cz
            place = (slice(j0, j1), slice(i0, i1))
            hit = (u >= -1e-6) & (v >= -1e-6) & (w >= -1e-6) & (z > self.depth[place])
            if hit.any():
                u, v, w = u[hit], v[hit], w[hit]
                self.depth[place][hit] = z[hit]
                seen[place][hit] = True
                value[place][hit] = np.column_stack([u, v, w]) @ values[t]
                self.normal[place][hit] = np.column_stack([u, v, w]) @ normals[t]
        self.colour[seen] = colour_of(value[seen])

    def image(self):
        """RGBA with half of the pixels a side, shaded, with lines along edges."""
        covered = np.isfinite(self.depth)
        n = self.normal / np.maximum(
            np.linalg.norm(self.normal, axis=2, keepdims=True), 1e-300
        )
        towards = n @ self.axes[2]
        n[towards < 0] *= -1
        light = np.array([-0.35, 0.75, 0.56]) @ np.array(self.axes)
        shade = 0.7 + 0.22 * np.clip(n @ light, 0, 1) + 0.14 * np.abs(towards)
        rgb = np.clip(self.colour * shade[..., None], 0, 1)
        line = np.zeros(self.shape, dtype=bool)
        reach = 12 / self.scale
        for axis in (0, 1):
            z, m, c = (np.moveaxis(a, axis, 0) for a in (self.depth, n, covered))
            differs = c[1:] != c[:-1]
            both = c[1:] & c[:-1]
            with np.errstate(invalid="ignore"):
                differs |= both & (np.abs(z[1:] - z[:-1]) > reach)
            differs |= both & (np.einsum("ijk,ijk->ij", m[1:], m[:-1]) < 0.75)
            np.moveaxis(line, axis, 0)[1:] |= differs
        rgb[line] = 0.25
        covered = covered | line
        picture = np.dstack([np.where(covered[..., None], rgb, 1), covered])
        h, w = self.shape // 2
        parts = picture[: 2 * h, : 2 * w].reshape(h, 2, w, 2, 4)
        weight = np.maximum(parts[..., 3:].sum(axis=(1, 3)), 1e-9)
        colour = (parts[..., :3] * parts[..., 3:]).sum(axis=(1, 3)) / weight
        return np.dstack([colour, parts[..., 3].mean(axis=(1, 3))])


def plot_solid(
    ax,
    data,
    field_name,
    azimuth=35,
    elevation=25,
    cut="",
    limits=None,
    scale=1.0,
    unit=None,
    rigid=None,
    colour_bar=True,
    pixels=1600,
):
    """Draw the field @p field_name of the material points @p data, which have
    subdomains, into @p ax. @p cut: "xz" takes the part x > 0, z > 0 away, "x" the
    part x > 0; @p rigid: rigid bodies as read_output() reads them; @p limits,
    @p scale and @p unit as for isochor_output.plot_points()."""
    style = output.FIELD_STYLES.get(
        field_name, output.Style(field_name, "", "viridis", "free")
    )
    values = output.field(data, field_name) * scale
    if np.shape(data.get("corners", ()))[1:] != (4, 3):
        raise output.OutputError("Only bodies in 3D with subdomains (CPDI) are drawn.")
    limits = limits or output.colour_limits([values], style.limits)
    vertices, cells = output.body_mesh(data)
    whole = (vertices, cells, output.vertex_values(data, cells, values))
    parts = [] if cut else [whole]
    for plane in cut:
        axis = "xyz".index(plane)
        parts.append(clip(*whole, axis, -1))
        whole = clip(*whole, axis, 1)
    surfaces = [outer_surface(*part) for part in parts if len(part[1])]
    triangles = [np.concatenate(arrays) for arrays in zip(*surfaces)]
    return plot_triangles(
        ax, *triangles[:2], field_name, azimuth, elevation, limits, unit, rigid,
        colour_bar, pixels, triangles[2]
    )


def plot_triangles(
    ax,
    corners,
    values,
    field_name,
    azimuth=35,
    elevation=25,
    limits=None,
    unit=None,
    rigid=None,
    colour_bar=False,
    pixels=1600,
    normals=None,
):
    """Draw triangles by their corners (n, 3, 3), with @p values and @p normals at
    them (n, 3); the rest as for plot_solid()."""
    style = output.FIELD_STYLES.get(
        field_name, output.Style(field_name, "", "viridis", "free")
    )
    if normals is None:
        normals = flat_normals(corners)
    axes = view_axes(azimuth, elevation)
    shown = [corners]
    if rigid is not None:
        shown.append(rigid["position"][rigid["cells"]])
    seen = np.concatenate(shown).reshape(-1, 3) @ np.array(axes[:2]).T
    margin = 0.01 * np.ptp(seen, axis=0).max()
    low, high = seen.min(axis=0) - margin, seen.max(axis=0) + margin
    canvas = Canvas(low, high, axes, pixels)
    mappable = cm.ScalarMappable(
        colors.Normalize(*limits), output.with_grey(style.colour_map)
    )
    canvas.draw(corners, values, normals, lambda v: mappable.to_rgba(v)[:, :3])
    if rigid is not None:
        tool = shown[-1]
        none = np.zeros((len(tool), 3))
        canvas.draw(tool, none, flat_normals(tool), lambda v: np.tile(GREY, (len(v), 1)))
    mappable.set_array(values.ravel())
    ax.imshow(
        canvas.image(),
        origin="lower",
        extent=(low[0], high[0], low[1], high[1]),
        interpolation="antialiased",
    )
    ax.set_axis_off()
    mappable.axes = ax
    if colour_bar:
        output.add_colour_bar(mappable, ax, field_name, values, unit)
    return mappable


def flat_normals(corners):
    normal = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    normal /= np.maximum(np.linalg.norm(normal, axis=1), 1e-300)[:, None]
    return np.repeat(normal[:, None], 3, axis=1)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("directory", help="of the run's output")
    parser.add_argument("field")
    parser.add_argument("picture")
    parser.add_argument("--step", type=int, default=-1, help="number of the output")
    parser.add_argument("--mirror", default="", help='planes of symmetry: "xz"')
    parser.add_argument("--cut", default="", help='"xz" cuts x > 0, z > 0 out')
    parser.add_argument("--azimuth", type=float, default=35)
    parser.add_argument("--elevation", type=float, default=25)
    parser.add_argument("--scale", type=float, default=1)
    parser.add_argument("--unit")
    arguments = parser.parse_args()
    try:
        draw(arguments)
    except output.OutputError as error:
        sys.exit(f"Error: {error}")


def draw(arguments):
    data = output.read_points(arguments.directory, arguments.step)
    rigid = None
    if (output.Path(arguments.directory) / "rigid_bodies.pvd").is_file():
        rigid = output.read_output(
            arguments.directory, "rigid_bodies", arguments.step
        )
    figure, ax = output.plt.subplots(figsize=(5, 4))
    plot_solid(
        ax,
        output.mirrored(data, arguments.mirror),
        arguments.field,
        arguments.azimuth,
        arguments.elevation,
        arguments.cut,
        scale=arguments.scale,
        unit=arguments.unit,
        rigid=rigid,
    )
    output.save(figure, arguments.picture)


if __name__ == "__main__":
    main()
