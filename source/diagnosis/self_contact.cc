/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <deal.II/base/mpi.h>
#include <deal.II/numerics/rtree.h>

#include <isochor/base/plain_message.h>
#include <isochor/diagnosis/diagnosis.h>
#include <isochor/equations/body_surface.h>
#include <isochor/grid/simplex_coordinates.h>

#include <algorithm>
#include <utility>

namespace isochor
{
  /**
   * Parts of one body that come together. They have one field: on a grid that
   * is reset they are as one from where they share a node, with a gap between
   * them; on a grid that is kept they go through each other. Only places count
   * that at t = 0 were further from each other than cells with a common node
   * are.
   */
  template <int dim>
  class SelfContact : public Diagnosis<dim>
  {
  public:
    void
    grid_reset(const Scene<dim> & /*scene*/,
               const StepContext<dim> &step,
               const ElementNodes & /*elements*/,
               const bool /*is_kept*/) override
    {
      look(step, false);
    }
    void
    step_converged(const ConvergedStep<dim> &converged) override
    {
      if (converged.result.step.grid_is_kept)
        look(converged.result.step, true);
    }

  private:
    using Face  = typename BodySurface<dim>::Face;
    using Place = typename BodySurface<dim>::Place;

    /** A place of the surface: its cell and point, outward normal and Gauss
     * point. */
    struct Spot
    {
      unsigned int   k, q;
      Tensor<1, dim> normal;
      Place          place;
    };

    /** Warn if parts have come together. Collective. */
    void
    look(const StepContext<dim> &step, const bool on_kept_grid)
    {
      const BackgroundGrid<dim> &grid = step.grid;
      BodySurface<dim>           surface;
      surface.find(step.points);
      std::vector<Spot> spots;
      for (const Face &face : surface.faces())
        {
          Tensor<1, dim> normal = face.normal * invert(step.points.F[face.q]);
          normal /= normal.norm();
          for (unsigned int g = 0; g < BodySurface<dim>::n_gauss; ++g)
            spots.push_back(
              {face.k, face.q, normal, BodySurface<dim>::place(step, face, g)});
        }
      const auto together = on_kept_grid ? penetrating(step, surface, spots) :
                                           at_one_node(step, spots);
      // the first of all ranks
      const MPI_Comm comm  = grid.communicator();
      const auto     found = Utilities::MPI::all_gather(
        comm,
        together == nullptr ? std::vector<Point<dim>>() :
                                  std::vector<Point<dim>>{together->place.x});
      for (const auto &of_rank : found)
        if (!of_rank.empty())
          {
            std::string where;
            for (unsigned int d = 0; d < dim; ++d)
              where += (d > 0 ? ", " : "") + rounded(of_rank[0][d]);
            this->warn("at t = " + rounded(step.old_time) + ", near (" + where +
                       "), parts of one body have come together: " +
                       (on_kept_grid ? "they go through each other. " :
                                       "within a cell they are as one, with a "
                                       "gap and without slip. ") +
                       "Make them bodies of their own (<Material "
                       "points/Bodies>).");
            return;
          }
    }

    /** Whether two places were so far apart at t = 0 that no cell of the size
     * of cell @p k could have had a node in common with theirs. */
    static bool
    were_apart(const StepContext<dim> &step,
               const unsigned int      k,
               const Place            &a,
               const Place            &b)
    {
      const auto corners  = step.points.corners(step.grid.geometry(), k);
      double     diameter = 0;
      for (const Point<dim> &one : corners)
        for (const Point<dim> &other : corners)
          diameter = std::max(diameter, one.distance(other));
      return a.X.distance(b.X) > 2 * diameter;
    }

    /** A place that faces one across a gap with which it has a node in common;
     * null if there is none. */
    static const Spot *
    at_one_node(const StepContext<dim> &step, const std::vector<Spot> &spots)
    {
      std::vector<std::pair<unsigned int, const Spot *>> of_nodes;
      for (const Spot &spot : spots)
        {
          const auto nodes =
            step.points.stencil(step.grid.geometry(), spot.k, spot.q);
          for (unsigned int I = 0; I < nodes.n_nodes; ++I)
            of_nodes.emplace_back(nodes.vertex[I], &spot);
        }
      std::sort(of_nodes.begin(), of_nodes.end());
      for (auto one = of_nodes.begin(); one != of_nodes.end(); ++one)
        for (auto other = one + 1;
             other != of_nodes.end() && other->first == one->first;
             ++other)
          {
            const Spot          &a = *one->second, &b = *other->second;
            const Tensor<1, dim> gap = b.place.x - a.place.x;
            // more against each other than across, unlike the sides of a corner
            const double opposite = -(a.normal * b.normal);
            if (2 * opposite * opposite > 1 && opposite > 0 &&
                gap * a.normal > 0 && gap * b.normal < 0 &&
                were_apart(step, a.k, a.place, b.place))
              return &a;
          }
      return nullptr;
    }

    /** A place within a subdomain with an outer face; null if there is none. */
    static const Spot *
    penetrating(const StepContext<dim>  &step,
                const BodySurface<dim>  &surface,
                const std::vector<Spot> &spots)
    {
      using Entry = std::pair<BoundingBox<dim>, std::size_t>;
      const PointArrays<dim>     &points   = step.points;
      const SimplexGeometry<dim> &geometry = step.grid.geometry();
      std::vector<Entry>          entries;
      const auto                  corners = [&](const Face &face) {
        CornerVectors<dim> r; // from the point
        for (unsigned int c = 0; c <= dim; ++c)
          r[c] = points.F[face.q] * points.domain[face.q][c];
        return r;
      };
      for (const Face &face : surface.faces())
        {
          const Point<dim>        x = points.location(geometry, face.k, face.q);
          std::vector<Point<dim>> places;
          for (const Tensor<1, dim> &r : corners(face))
            places.push_back(x + r);
          entries.emplace_back(BoundingBox<dim>(places), entries.size());
        }
      const auto tree = pack_rtree(entries);
      namespace bgi   = boost::geometry::index;
      for (const Spot &spot : spots)
        for (auto entry = tree.qbegin(bgi::intersects(spot.place.x));
             entry != tree.qend();
             ++entry)
          {
            const Face &face = surface.faces()[entry->second];
            if (step.grid.layer_of_cell(points.cell[face.k]) ==
                  step.grid.layer_of_cell(points.cell[spot.k]) &&
                is_inside(corners(face),
                          spot.place.x -
                            points.location(geometry, face.k, face.q)) &&
                were_apart(step,
                           spot.k,
                           spot.place,
                           BodySurface<dim>::place(step, face, 0)))
              return &spot;
          }
      return nullptr;
    }

    static bool
    is_inside(const CornerVectors<dim> &corners, const Tensor<1, dim> &x)
    {
      const auto lambda = simplex_coordinates<dim>(corners, x);
      return std::all_of(lambda.begin(), lambda.end(), [](const double l) {
        return l > 0;
      });
    }
  };

  ISOCHOR_REGISTER_DIAGNOSIS(
    SelfContact,
    "parts of one body in contact",
    ISOCHOR_ESSENTIAL,
    "CPDI: two parts of one body's surface that were more than two cells apart "
    "at t = 0 have come together. On a grid that is reset they face each other "
    "at the same node: from there on they are as one, with a gap between them "
    "and without slip. On a grid without resets one is within the other",
    "let the parts be bodies (`Material points/Bodies`) that are not tied to "
    "each other, which come into contact; smaller cells there")
} // namespace isochor
