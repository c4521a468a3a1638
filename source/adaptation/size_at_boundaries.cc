/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <isochor/adaptation/cell_size_criterion.h>
#include <isochor/base/expression.h>

#include <algorithm>
#include <string>
#include <vector>

namespace isochor
{
  /** Small cells at boundaries of the grid, larger ones with the distance. */
  template <int dim>
  class SizeAtBoundaries : public CellSizeCriterion<dim>
  {
  public:
    static void
    declare_parameters(ParameterHandler &prm)
    {
      prm.declare_entry("Cell size at boundaries",
                        "",
                        Patterns::Anything(),
                        "'boundary: size; boundary: size': the largest size of "
                        "cells (m) at boundaries of the grid, where these are "
                        "at t = 0.");
      prm.declare_entry("Growth of size",
                        "0.25",
                        Patterns::Double(0),
                        "By how much the size may increase per distance from "
                        "these boundaries.");
    }

    void
    parse_parameters(ParameterHandler &prm) override
    {
      for (const auto &entry :
           split_list_of_unique_names(prm.get("Cell size at boundaries"), name))
        {
          places.push_back({entry.first, number_in(entry.second, name), {}});
          AssertThrow(places.back().size > 0,
                      ExcMessage("The size at <" + entry.first + "> of <" +
                                 name + "> must be positive."));
        }
      growth = prm.get_double("Growth of size");
    }

    void
    initialize(const BackgroundGrid<dim> &grid) override
    {
      const SimplexGeometry<dim> &geometry = grid.geometry();
      for (Place &place : places)
        {
          const types::boundary_id id = grid.boundary_id(place.boundary, name);
          for (const BoundaryFace &face : grid.boundary_faces())
            if (face.id == id)
              {
                place.faces.emplace_back();
                for (unsigned int v = 0, i = 0; v <= dim; ++v)
                  if (v != face.opposite_vertex)
                    place.faces.back()[i++] =
                      geometry
                        .vertices()[geometry.vertex_indices(face.cell)[v]];
              }
        }
    }

    double
    size_at(const Point<dim> &x, const double /*time*/) const override
    {
      double size = this->any_size;
      for (const Place &place : places)
        for (const auto &face : place.faces)
          size = std::min(size, place.size + growth * distance(x, face));
      return size;
    }

  private:
    using Face = std::array<Point<dim>, dim>;

    struct Place
    {
      std::string       boundary;
      double            size;
      std::vector<Face> faces;
    };

    static double
    distance_to_segment(const Point<dim> &x,
                        const Point<dim> &a,
                        const Point<dim> &b)
    {
      const Tensor<1, dim> edge = b - a;
      const double         s =
        std::min(1., std::max(0., (x - a) * edge / edge.norm_square()));
      return x.distance(a + s * edge);
    }

    static double
    distance(const Point<dim> &x, const Face &face)
    {
      if constexpr (dim == 2)
        return distance_to_segment(x, face[0], face[1]);
      else
        {
          const Tensor<1, 3> normal =
            cross_product_3d(face[1] - face[0], face[2] - face[0]);
          bool   above   = true; // in the prism over the triangle
          double nearest = CellSizeCriterion<dim>::any_size;
          for (unsigned int i = 0; i < 3; ++i)
            {
              const Point<3> &a = face[i], &b = face[(i + 1) % 3];
              above   = above && cross_product_3d(normal, b - a) * (x - a) >= 0;
              nearest = std::min(nearest, distance_to_segment(x, a, b));
            }
          return above ? std::abs(normal * (x - face[0])) / normal.norm() :
                         nearest;
        }
    }

    const std::string  name = "Adaptive grid/Cell size at boundaries";
    std::vector<Place> places;
    double             growth = 0;
  };

  ISOCHOR_REGISTER_FOR_DIMENSION(CellSizeCriterion,
                                 SizeAtBoundaries,
                                 "Cell size at boundaries")
} // namespace isochor
