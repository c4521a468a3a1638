/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <deal.II/base/mpi.h>

#include <isochor/base/disjoint_sets.h>
#include <isochor/base/mpi_sums.h>
#include <isochor/base/plain_message.h>
#include <isochor/grid/nearest_cells.h>
#include <isochor/material_points/point_spacing.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <sstream>
#include <unordered_map>

namespace isochor
{
  namespace
  {
    /** Points up to this share of their cell leave no cell empty that matters.
     */
    constexpr double harmless_share = 0.5;
    /** The part of the body in cells without points that is worth a warning: at
     * twice as much a tube needed a tenth less of pressure. */
    constexpr double tolerated_part = 0.01;
    /** Domains of CPDI may be so much longer than their cells: a bar with
     * domains of half of a cell at first was right up to a stretch of 2.4. */
    constexpr double tolerated_length = 1.2;
    /** From this share of their cells on, domains have hardly more corners than
     * the grid has nodes around them: those in rows of cells move all corners
     * alike when every other row of nodes goes too far and the next not far
     * enough. That is no harm as long as corners lie on nodes but for this
     * weight. */
    constexpr double as_large_as_cells = 0.9, on_node = 0.02;
    /** The relative difference of volumes that is worth a warning, if it is
     * there at so many resets one after the other. */
    constexpr double       tolerated_difference = 0.03;
    constexpr unsigned int n_resets_tolerated   = 5;

    /** The part of the points that may change cells with the plain quadrature
     * without a word. */
    constexpr double tolerated_changes = 0.1;

    /** Those that the corners of a domain with this stencil lie between. */
    template <typename Stencil>
    unsigned int
    n_nodes_felt(const Stencil &stencil)
    {
      return std::count_if(stencil.shape,
                           stencil.shape + stencil.n_nodes,
                           [](const double N) { return N > on_node; });
    }

    /** @p cells, each brought to the rank that owns it. */
    template <int dim>
    std::set<unsigned int>
    send_to_owners(const std::set<unsigned int> &cells,
                   const SimplexGeometry<dim>   &geometry)
    {
      const MPI_Comm comm = geometry.communicator();
      if (Utilities::MPI::n_mpi_processes(comm) == 1)
        return cells;
      std::map<unsigned int, std::vector<unsigned int>> messages;
      for (const unsigned int cell : cells)
        messages[geometry.owner(cell)].push_back(cell);
      std::set<unsigned int> own;
      for (const auto &received : Utilities::MPI::some_to_some(comm, messages))
        own.insert(received.second.begin(), received.second.end());
      return own;
    }
  } // namespace



  template <int dim>
  PointSpacing<dim>::PointSpacing(const BackgroundGrid<dim> &grid)
    : grid(grid)
  {}



  template <int dim>
  void
  PointSpacing<dim>::check(const PointArrays<dim> &points,
                           const double            time,
                           const bool              at_start,
                           Warnings               &warnings) const
  {
    if (at_start)
      warn_of_hinges(points, warnings);
    const MPI_Comm comm  = grid.communicator();
    const double   share = Utilities::MPI::max(largest_share(points), comm);
    if (at_start)
      warn_of_large_domains(points, share, warnings);
    warn_of_long_domains(points, time, warnings);
    if (share <= harmless_share)
      return;
    const std::set<unsigned int> bare = find_bare_cells(points);

    std::array<double, 3> sums{}; // bare cells, their volume, the body's
    for (const unsigned int cell : bare)
      {
        sums[0] += 1;
        sums[1] += grid.geometry().measure(cell);
      }
    for (unsigned int q = 0; q < points.n_points(); ++q)
      sums[2] += determinant(points.F[q]) * points.volume[q];
    sum_over_ranks(sums, comm);
    if (sums[1] <= tolerated_part * sums[2])
      return;

    std::ostringstream text;
    text.precision(3);
    text << "At t = " << time
         << " the material points are too far apart for the grid: " << sums[0]
         << " cells inside of the body, " << 100 * sums[1] / sums[2]
         << " % of its volume, hold none. They resist nothing or, "
            "as holes, with a guess of the state there. The largest point has "
         << share
         << " times the volume of its cell. Seed more points (<Material "
            "points/Points per cell>, <Material points/Lattice spacing>, or a "
            "finer <Material points/Body mesh>), or make the cells larger "
            "(<Grid>)."
         << (points.domain.empty() ?
               " Large points can also be split (<Material points/Split at "
               "share of cell> = 0.5)." :
               "");
    std::set<unsigned int> held(points.cell.begin(), points.cell.end());
    for (const auto &corner : points.domain_corners.cells)
      held.insert(corner.second);
    std::set<unsigned int> body = held;
    body.insert(bare.begin(), bare.end());
    const unsigned int n_held = n_pieces({held.begin(), held.end()}),
                       n_body = n_pieces({body.begin(), body.end()});
    if (n_held > n_body)
      text << " The body falls apart: the cells that hold points form "
           << n_held
           << " pieces that share no face, with the empty cells between them "
              "it were "
           << n_body
           << (n_body == 1 ? "." :
                             ": there are several bodies, or wider gaps.");
    AssertThrow(!at_start || n_held <= n_body, ExcMessage(text.str()));
    warnings.add("material points too far apart for the grid", text.str());
  }



  template <int dim>
  void
  PointSpacing<dim>::warn_of_hinges(const PointArrays<dim> &points,
                                    Warnings               &warnings) const
  {
    // domains connect what the cells of the points don't
    if (Utilities::MPI::max(points.domain_corners.cells.size(),
                            grid.communicator()) > 0)
      return;
    std::vector<unsigned int> cells;
    for (const unsigned int cell : points.cell)
      for (const unsigned int of_element : grid.shape_functions().element(cell))
        cells.push_back(of_element);
    const unsigned int by_faces = n_pieces(cells);
    if (by_faces == 1)
      return;
    const unsigned int by_vertices = n_pieces(cells, false);
    if (by_faces == by_vertices)
      return;
    warnings.add("a part of the body hangs on a vertex",
                 "The cells that hold material points form " +
                   std::to_string(by_faces) + " pieces that share faces, but " +
                   std::to_string(by_vertices) +
                   " that share vertices: a part of the body hangs on others "
                   "by " +
                   (dim == 2 ? "a vertex" : "vertices or edges") +
                   " and turns freely. In statics there may be no equilibrium. "
                   "Move the body against the grid, seed more points "
                   "(<Material points/Points per cell>), or use "
                   "<Quadrature/Type = CPDI>.");
  }



  template <int dim>
  void
  PointSpacing<dim>::warn_of_large_domains(const PointArrays<dim> &points,
                                           const double            share,
                                           Warnings &warnings) const
  {
    // a domain sees the shape functions at its corners only: with several
    // corners along an edge of the cell they are more than linear
    constexpr unsigned int n_needed = (1u << dim);
    if (grid.shape_functions().are_linear() || share < 1.1 / n_needed ||
        Utilities::MPI::max(points.domain_corners.cells.size(),
                            grid.communicator()) == 0)
      return;
    warnings.add("domains too large for the shape functions",
                 "The largest domain of a material point has " +
                   rounded(share) +
                   " times the volume of its cell. Domains see the shape "
                   "functions at their corners only, so that nothing is left "
                   "of the accuracy of <Grid/Shape functions>; the body can "
                   "even be stiffer than with P1. Seed " +
                   std::to_string(n_needed) + " or " +
                   std::to_string(dim == 2 ? 9 : 27) +
                   " points per cell (<Material points/Points per cell>), or "
                   "use another <Quadrature/Type>.");
  }



  template <int dim>
  void
  PointSpacing<dim>::warn_of_long_domains(const PointArrays<dim> &points,
                                          const double            time,
                                          Warnings &warnings) const
  {
    const MPI_Comm comm = grid.communicator();
    if (Utilities::MPI::max(points.domain_corners.cells.size(), comm) == 0)
      return;
    const auto           &geometry = grid.geometry();
    double                longest  = 0;
    std::array<double, 2> volumes{}; // of long domains, of all
    const auto            extent = [&](const unsigned int    cell,
                            const Tensor<1, dim> &edge) {
      double first = std::numeric_limits<double>::max(),
             last  = std::numeric_limits<double>::lowest();
      for (const unsigned int v : geometry.vertex_indices(cell))
        {
          const double place = geometry.vertices()[v] * edge;
          first              = std::min(first, place);
          last               = std::max(last, place);
        }
      return last - first; // times the edge's length
    };
    for (unsigned int k = 0; k < points.n_occupied_cells; ++k)
      for (unsigned int q = points.cell_start[k]; q < points.cell_start[k + 1];
           ++q)
        {
          double length = 0; // in that of the cell in the same direction
          for (unsigned int c = 0; c <= dim; ++c)
            for (unsigned int d = 0; d < c; ++d)
              {
                const Tensor<1, dim> edge =
                  points.F[q] * (points.domain[q][c] - points.domain[q][d]);
                double of_cell = extent(points.cell[k], edge);
                // tetrahedra of a mesh with other diagonals may be thin there
                if (edge.norm_square() > tolerated_length * of_cell)
                  for (const unsigned int other :
                       geometry.neighbours(points.cell[k]))
                    if (other != SimplexGeometry<dim>::no_cell)
                      of_cell = std::max(of_cell, extent(other, edge));
                length = std::max(length, edge.norm_square() / of_cell);
              }
          const double V = determinant(points.F[q]) * points.volume[q];
          volumes[1] += V;
          if (length > tolerated_length ||
              (V > as_large_as_cells * geometry.measure(points.cell[k]) &&
               n_nodes_felt(points.stencil(geometry, k, q)) > dim + 1))
            volumes[0] += V;
          longest = std::max(longest, length);
        }
    longest = Utilities::MPI::max(longest, comm);
    sum_over_ranks(volumes, comm);
    if (volumes[0] <= tolerated_part * volumes[1])
      return;
    std::ostringstream text;
    text.precision(3);
    text << "At t = " << time << ", " << 100 * volumes[0] / volumes[1]
         << " % of the body consist of points whose domains are as large as "
            "their cells or longer, up to "
         << longest
         << " times. Nodes between the corners of a domain feel nothing of it: "
            "displacements of the grid and of probes become arbitrary there, "
            "later also those of the body. Seed more points (<Material "
            "points/Points per cell>: domains grow by the stretch of the "
            "body), let them be split before (<Material points/Split at share "
            "of cell> = 0.2), take larger cells, or put the grid back less "
            "often, if it is done in each step (<Grid reset/Steps between "
            "resets>).";
    warnings.add("domains longer than the cells", text.str());
  }



  template <int dim>
  void
  PointSpacing<dim>::compare_volumes(const PointArrays<dim> &points,
                                     const double            time,
                                     Warnings               &warnings)
  {
    std::array<double, 2> volumes{}; // in the grid, of the points
    for (unsigned int q = 0; q < points.n_points(); ++q)
      {
        const double J = determinant(points.F[q]);
        volumes[0] += J * points.weight[q];
        volumes[1] += J * points.volume[q];
      }
    sum_over_ranks(volumes, grid.communicator());
    // domains stand for what a held boundary has left of them in the grid
    const bool have_domains =
      Utilities::MPI::max(points.domain_corners.cells.size(),
                          grid.communicator()) > 0;
    constexpr double much_outside = 0.01;
    const double     difference   = volumes[0] / volumes[1] - 1;
    const bool       apart        = std::abs(difference) >
                       (have_domains ? much_outside : tolerated_difference);
    n_resets_apart = apart ? n_resets_apart + 1 : 0;
    if (n_resets_apart < n_resets_tolerated)
      return;
    std::ostringstream text;
    text.precision(3);
    if (have_domains)
      {
        text << "At t = " << time << " " << -100 * difference
             << " % of the body are outside of the grid, where a boundary has "
                "drawn it out of a grid that is put back. This part carries no "
                "stress: forces along the boundary are wrong by as much, those "
                "across it by about half. Let the "
                "grid follow (<Grid/Stretch>), keep it (<Grid reset/Steps "
                "between resets>), or take a larger one, in which the body's "
                "own surface moves (<Boundary conditions/Displacement of "
                "body>).";
        warnings.add("a body in part outside of the grid", text.str());
        return;
      }
    text << "At t = " << time << " the body fills " << volumes[0] << " m^"
         << dim << " of the grid, but its material points stand for "
         << volumes[1] << ", and it has been so for " << n_resets_tolerated
         << " resets of the grid: the volumes differ by " << 100 * difference
         << " %. The points have been drawn apart or together. Seed more "
            "points (<Material points/Points per cell>), let them be split "
            "(<Material points/Split at share of cell>), or use "
            "<Quadrature/Type = CPDI>.";
    warnings.add("volume in the grid differs from the material's", text.str());
  }



  template <int dim>
  void
  PointSpacing<dim>::watch_changes_of_cells(const double n_changed,
                                            const double n_points,
                                            const double time,
                                            Warnings    &warnings)
  {
    const double before = changes_per_point;
    changes_per_point += n_changed / n_points;
    // once: it can only become more
    if (before > tolerated_changes || changes_per_point <= tolerated_changes)
      return;
    std::ostringstream text;
    text.precision(3);
    text << "Up to t = " << time << " " << 100 * changes_per_point
         << " % of the material points have changed their cell. With "
            "this <Quadrature/Type> forces jump then"
         << (grid.shape_functions().are_linear() ?
               "" :
               " (weights that fill cells are right for <Grid/Shape functions "
               "= P1> only)")
         << ": stresses are wrong "
            "by as much as they vary in a cell, however small the cells are, "
            "and the body is too soft. Use <Quadrature/Type = CPDI>, or keep "
            "the grid (<Grid reset/Steps between resets>).";
    warnings.add("points that change cells", text.str());
  }



  template <int dim>
  double
  PointSpacing<dim>::largest_share(const PointArrays<dim> &points) const
  {
    double share = 0;
    for (unsigned int k = 0; k < points.n_occupied_cells; ++k)
      {
        double largest = 0;
        for (unsigned int q = points.cell_start[k];
             q < points.cell_start[k + 1];
             ++q)
          largest =
            std::max(largest, determinant(points.F[q]) * points.volume[q]);
        share =
          std::max(share, largest / grid.geometry().measure(points.cell[k]));
      }
    return share;
  }



  template <int dim>
  std::set<unsigned int>
  PointSpacing<dim>::find_bare_cells(const PointArrays<dim> &points) const
  {
    const SimplexGeometry<dim> &geometry = grid.geometry();
    std::set<unsigned int>      covered;
    for (unsigned int k = 0; k < points.n_occupied_cells; ++k)
      for (unsigned int q = points.cell_start[k]; q < points.cell_start[k + 1];
           ++q)
        add_covered_cells(points, k, q, covered);
    std::set<unsigned int> bare = send_to_owners(covered, geometry);
    for (unsigned int k = 0; k < points.n_occupied_cells; ++k)
      bare.erase(points.cell[k]);

    std::set<unsigned int> with_corners;
    for (const auto &corner : points.domain_corners.cells)
      with_corners.insert(corner.second);
    for (const unsigned int cell : send_to_owners(with_corners, geometry))
      bare.erase(cell);
    return bare;
  }



  template <int dim>
  void
  PointSpacing<dim>::add_covered_cells(const PointArrays<dim> &points,
                                       const unsigned int      k,
                                       const unsigned int      q,
                                       std::set<unsigned int> &covered) const
  {
    const SimplexGeometry<dim> &geometry = grid.geometry();
    const Tensor<2, dim>        inverse  = invert(points.F[q]);
    const double                radius =
      std::pow(points.volume[q] * (dim == 2 ? 1. : 0.75) / numbers::PI,
               1. / dim);
    Point<dim> x;
    for (unsigned int v = 0; v <= dim; ++v)
      x += points.shape[q][v] * points.corner(geometry, k, v);

    // face by face from the point's own cell
    std::vector<unsigned int> to_follow = {points.cell[k]};
    std::set<unsigned int>    seen      = {points.cell[k]};
    while (!to_follow.empty())
      {
        const unsigned int cell = to_follow.back();
        to_follow.pop_back();
        for (const unsigned int next : geometry.neighbours(cell))
          if (next != SimplexGeometry<dim>::no_cell &&
              seen.insert(next).second &&
              (inverse * (cell_centroid(geometry, next) - x)).norm() < radius)
            {
              covered.insert(next);
              to_follow.push_back(next);
            }
      }
  }



  template <int dim>
  unsigned int
  PointSpacing<dim>::n_pieces(const std::vector<unsigned int> &own_cells,
                              const bool                       by_faces) const
  {
    const SimplexGeometry<dim>     &geometry = grid.geometry();
    const std::vector<unsigned int> cells =
      union_over_ranks(own_cells, grid.communicator());
    DisjointSets pieces(cells.size());
    if (by_faces)
      for (unsigned int k = 0; k < cells.size(); ++k)
        for (const unsigned int other : geometry.neighbours(cells[k]))
          {
            const auto place =
              std::lower_bound(cells.begin(), cells.begin() + k, other);
            if (place != cells.begin() + k && *place == other)
              pieces.merge(k, place - cells.begin());
          }
    else
      {
        std::unordered_map<unsigned int, unsigned int> cell_at_vertex;
        for (unsigned int k = 0; k < cells.size(); ++k)
          for (const unsigned int v : geometry.vertex_indices(cells[k]))
            pieces.merge(k, cell_at_vertex.emplace(v, k).first->second);
      }
    return pieces.size();
  }



  template class PointSpacing<2>;
  template class PointSpacing<3>;
} // namespace isochor
