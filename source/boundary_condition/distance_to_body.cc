/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <isochor/boundary_condition/distance_to_body.h>

#include <algorithm>
#include <limits>
#include <map>

namespace isochor
{
  namespace
  {
    constexpr double nowhere = std::numeric_limits<double>::infinity();

    /** Where the line @p x + t @p direction enters the simplex with the given
     * corners: t, or nowhere. */
    template <int dim, typename Corners>
    double
    entry(const Corners        &corners,
          const Point<dim>     &x,
          const Tensor<1, dim> &direction)
    {
      constexpr double rounding = 1e-9;
      Tensor<2, dim>   edges;
      for (unsigned int c = 0; c < dim; ++c)
        for (unsigned int a = 0; a < dim; ++a)
          edges[a][c] = corners[c + 1][a] - corners[0][a];
      const Tensor<2, dim> inverse = invert(edges);
      const Tensor<1, dim> at      = inverse * (x - corners[0]),
                           by      = inverse * direction;
      double     first = -nowhere, last = nowhere, at_0 = 1, by_0 = 0;
      const auto cut = [&](const double value, const double change) {
        // value + t change >= 0
        if (std::abs(change) <= rounding * by.norm())
          {
            if (value < -rounding)
              first = nowhere;
          }
        else if (change > 0)
          first = std::max(first, -value / change);
        else
          last = std::min(last, -value / change);
      };
      for (unsigned int c = 0; c < dim; ++c)
        {
          cut(at[c], by[c]);
          at_0 -= at[c];
          by_0 -= by[c];
        }
      cut(at_0, by_0);
      return first <= last + rounding / by.norm() ? first : nowhere;
    }
    /** Vertices of a wall, and its faces. */
    template <int dim>
    class WallFaces
    {
    public:
      WallFaces(const BackgroundGrid<dim>         &grid,
                const std::vector<unsigned int>   &vertices,
                const std::vector<Tensor<1, dim>> &inwards)
        : faces_at(vertices.size())
      {
        for (unsigned int i = 0; i < vertices.size(); ++i)
          place[vertices[i]] = i;
        for (const BoundaryFace &face : grid.boundary_faces())
          add(grid.geometry(), face, inwards);
      }

      /** The number of a vertex of the grid, or invalid_unsigned_int. */
      unsigned int
      number(const unsigned int vertex) const
      {
        const auto it = place.find(vertex);
        return it == place.end() ? numbers::invalid_unsigned_int : it->second;
      }

      /** Where the function @p distance, linear on faces of the wall, is above
       * the body at its corner @p x, which acts on vertex number @p i: raise
       * @p lower to what has to be taken off it at the vertices of the face
       * below x. Only what is further away than x comes nearer, in proportion,
       * and at most as near. */
      void
      note_corner(const unsigned int         i,
                  const Point<dim>          &x,
                  const std::vector<double> &distance,
                  std::vector<double>       &lower) const
      {
        constexpr double rounding = 1e-9;
        for (const unsigned int f : faces_at[i])
          {
            const Face             &face = faces[f];
            const Tensor<1, dim>    at   = face.to_foot * (x - face.origin);
            const double            of_x = at[dim - 1];
            std::array<double, dim> weight{{1.}}, above{};
            for (unsigned int v = 1; v < dim; ++v)
              {
                weight[v] = at[v - 1];
                weight[0] -= at[v - 1];
              }
            if (*std::min_element(weight.begin(), weight.end()) < -rounding)
              continue;
            double excess = 0, positive = 0;
            for (unsigned int v = 0; v < dim; ++v)
              if (distance[face.number[v]] < nowhere && weight[v] > rounding)
                {
                  above[v] = distance[face.number[v]] - of_x;
                  excess += weight[v] * above[v];
                  positive += weight[v] * std::max(0., above[v]);
                }
            if (excess > rounding * positive)
              for (unsigned int v = 0; v < dim; ++v)
                lower[face.number[v]] =
                  std::max(lower[face.number[v]], excess / positive * above[v]);
          }
      }

    private:
      struct Face
      {
        std::array<unsigned int, dim> number; ///< of its vertices
        Point<dim>                    origin; ///< the first one
        /** Takes a place to its coordinates along the edges from the first
         * vertex and, the last one, along the wall's normal. */
        Tensor<2, dim> to_foot;
      };

      void
      add(const SimplexGeometry<dim>        &geometry,
          const BoundaryFace                &boundary_face,
          const std::vector<Tensor<1, dim>> &inwards)
      {
        Face           face;
        unsigned int   n = 0;
        Tensor<1, dim> normal;
        Tensor<2, dim> frame;
        for (unsigned int v = 0; v <= dim; ++v)
          {
            if (v == boundary_face.opposite_vertex)
              continue;
            const unsigned int vertex =
              geometry.vertex_indices(boundary_face.cell)[v];
            const unsigned int i = number(vertex);
            if (i == numbers::invalid_unsigned_int)
              return;
            if (n == 0)
              face.origin = geometry.vertices()[vertex];
            else
              for (unsigned int a = 0; a < dim; ++a)
                frame[a][n - 1] =
                  geometry.vertices()[vertex][a] - face.origin[a];
            normal += inwards[i];
            face.number[n++] = i;
          }
        normal /= normal.norm();
        for (unsigned int a = 0; a < dim; ++a)
          frame[a][dim - 1] = normal[a];
        if (std::abs(determinant(frame)) <=
            1e-6 * std::pow(frame.norm(), dim - 1))
          return; // along the normal
        face.to_foot = invert(frame);
        for (const unsigned int i : face.number)
          faces_at[i].push_back(faces.size());
        faces.push_back(face);
      }

      std::map<unsigned int, unsigned int>   place;
      std::vector<Face>                      faces;
      std::vector<std::vector<unsigned int>> faces_at; ///< by vertex
    };

    /** Call @p act(i, corners) for all domains of points on this rank and the
     * vertices that they act on. */
    template <int dim, typename Action>
    void
    for_domains_at(const StepContext<dim> &step,
                   const WallFaces<dim>   &wall,
                   const Action           &act)
    {
      const PointArrays<dim>     &points   = step.points;
      const SimplexGeometry<dim> &geometry = step.grid.geometry();
      for (unsigned int k = 0; k < points.n_occupied_cells; ++k)
        for (unsigned int q = points.cell_start[k];
             q < points.cell_start[k + 1];
             ++q)
          {
            const auto stencil = points.stencil(geometry, k, q);
            std::array<Point<dim>, dim + 1> corners;
            bool                            placed = false;
            for (unsigned int I = 0; I < stencil.n_nodes; ++I)
              {
                const unsigned int i = wall.number(stencil.vertex[I]);
                if (i == numbers::invalid_unsigned_int)
                  continue;
                for (unsigned int c = 0; c <= dim && !placed; ++c)
                  {
                    corners[c] = Point<dim>(points.F[q] * points.domain[q][c]);
                    for (unsigned int v = 0; v <= dim; ++v)
                      corners[c] +=
                        points.shape[q][v] * points.corner(geometry, k, v);
                  }
                placed = true;
                act(i, corners);
              }
          }
    }
  } // namespace



  template <int dim>
  std::vector<double>
  distance_to_body(const StepContext<dim>            &step,
                   const std::vector<unsigned int>   &vertices,
                   const std::vector<Tensor<1, dim>> &inwards)
  {
    const MPI_Comm comm = step.grid.communicator();
    // a rank without points has no domains
    const bool known =
      step.points.has_stencils() && !step.points.domain.empty();
    if (Utilities::MPI::max(known ? 1 : 0, comm) == 0)
      return {};
    const WallFaces<dim> wall(step.grid, vertices, inwards);
    std::vector<double>  distance(vertices.size(), nowhere),
      lowest(vertices.size(), nowhere), lower(vertices.size(), 0.);
    for_domains_at(step, wall, [&](const unsigned int i, const auto &corners) {
      const Point<dim> &x = step.grid.geometry().vertices()[vertices[i]];
      for (const auto &corner : corners)
        lowest[i] = std::min(lowest[i], (corner - x) * inwards[i]);
      distance[i] = std::min(distance[i], entry<dim>(corners, x, inwards[i]));
    });
    Utilities::MPI::min(distance, comm, distance);
    Utilities::MPI::min(lowest, comm, lowest);
    for (unsigned int i = 0; i < distance.size(); ++i)
      if (distance[i] == nowhere)
        distance[i] = lowest[i];
    for_domains_at(step, wall, [&](const unsigned int i, const auto &corners) {
      for (const auto &corner : corners)
        wall.note_corner(i, corner, distance, lower);
    });
    Utilities::MPI::max(lower, comm, lower);
    for (unsigned int i = 0; i < distance.size(); ++i)
      distance[i] -= lower[i];
    return distance;
  }



  template <int dim>
  std::vector<double>
  gaps_of_body(const StepContext<dim>                          &step,
               const std::vector<Point<dim>>                   &reference,
               const std::vector<unsigned int>                 &vertices,
               const std::vector<Tensor<1, dim>>               &inwards,
               const std::function<double(const unsigned int)> &displacement)
  {
    constexpr double    rounding = 1e-10;
    std::vector<double> gaps     = distance_to_body(step, vertices, inwards);
    const auto         &place    = step.grid.geometry().vertices();
    double              size     = 0;
    for (const unsigned int v : vertices)
      size = std::max(size, place[v].norm());
    for (unsigned int i = 0; i < gaps.size(); ++i)
      {
        const unsigned int v = vertices[i];
        gaps[i] =
          gaps[i] < nowhere ?
            gaps[i] + (place[v] - reference[v]) * inwards[i] - displacement(i) :
            0.;
        if (std::abs(gaps[i]) < rounding * size)
          gaps[i] = 0.;
      }
    return gaps;
  }



  template std::vector<double>
  distance_to_body(const StepContext<2> &,
                   const std::vector<unsigned int> &,
                   const std::vector<Tensor<1, 2>> &);
  template std::vector<double>
  distance_to_body(const StepContext<3> &,
                   const std::vector<unsigned int> &,
                   const std::vector<Tensor<1, 3>> &);
  template std::vector<double>
  gaps_of_body(const StepContext<2> &,
               const std::vector<Point<2>> &,
               const std::vector<unsigned int> &,
               const std::vector<Tensor<1, 2>> &,
               const std::function<double(const unsigned int)> &);
  template std::vector<double>
  gaps_of_body(const StepContext<3> &,
               const std::vector<Point<3>> &,
               const std::vector<unsigned int> &,
               const std::vector<Tensor<1, 3>> &,
               const std::function<double(const unsigned int)> &);
} // namespace isochor
