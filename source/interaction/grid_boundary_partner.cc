/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <isochor/interaction/grid_boundary_partner.h>

#include <algorithm>
#include <map>
#include <numeric>

namespace isochor
{
  template <int dim>
  GridBoundaryPartner<dim>::GridBoundaryPartner(
    const std::vector<OneSidedWall> &walls,
    const unsigned int               which)
    : wall(walls[which])
    , boundaries(1, wall.boundary)
    , formula(wall.formula, wall.parameter)
  {
    for (const OneSidedWall &other : walls)
      if (other.boundary != wall.boundary && other.formula == wall.formula)
        boundaries.push_back(other.boundary);
    const std::string axes = std::string("xyz").substr(0, dim);
    for (const std::string &name : names_in_formula(wall.formula))
      depends_on_place =
        depends_on_place || axes.find(name) != std::string::npos;
  }



  template <int dim>
  void
  GridBoundaryPartner<dim>::initialize(const BackgroundGrid<dim> &of_scene)
  {
    grid      = &of_scene;
    reference = grid->vertices_at_time(0.);
    find_rims();
    at_start = facets_at(reference, {});
    is_built = false;
  }



  template <int dim>
  typename GridBoundaryPartner<dim>::Faces
  GridBoundaryPartner<dim>::faces_at(
    const std::vector<Point<dim>>          &vertices,
    const typename WallSurface<dim>::Shift &move) const
  {
    std::vector<types::boundary_id> ids;
    for (const std::string &boundary : boundaries)
      ids.push_back(grid->boundary_id(boundary, wall.parameter));
    WallSurface<dim> surface;
    surface.initialize(
      *grid, vertices, ids, 0, [](auto, auto, auto) { return true; }, move);
    Faces faces;
    for (const auto &face : surface.faces())
      if (face.boundary == 0 && grid->layer_of_cell(face.cell) == 0)
        faces.push_back(face);
    return faces;
  }



  template <int dim>
  std::unique_ptr<SmoothFacets<dim>>
  GridBoundaryPartner<dim>::facets_at(
    const std::vector<Point<dim>>          &vertices,
    const typename WallSurface<dim>::Shift &move) const
  {
    const Faces                         faces = faces_at(vertices, move);
    std::vector<typename Facets::Facet> facets;
    for (unsigned int f = 0; f < faces.size(); ++f)
      facets.push_back({faces[f].corners,
                        faces[f].normals,
                        faces[f].normal,
                        rims[f],
                        parts[f]});
    return std::make_unique<Facets>(std::move(facets));
  }



  template <int dim>
  void
  GridBoundaryPartner<dim>::find_rims()
  {
    const double smooth = std::cos(40. / 180. * numbers::PI); // as WallSurface
    constexpr double rounding = 1e-8;
    const auto      &geometry = grid->geometry();
    const Faces      faces    = faces_at(reference, {});
    // a face at an edge: its number if it is of this boundary, its normal, and
    // the direction in it from the edge
    struct AtEdge
    {
      unsigned int   number;
      Tensor<1, dim> normal, way;
    };
    using Edge = std::array<unsigned int, dim - 1>;
    std::map<Edge, std::vector<AtEdge>> at_edge;
    const auto edge_of = [](const std::array<unsigned int, dim> &of_face,
                            const unsigned int                   c) {
      Edge         edge;
      unsigned int n = 0;
      for (unsigned int i = 0; i < dim; ++i)
        if (i != c)
          edge[n++] = of_face[i];
      std::sort(edge.begin(), edge.end());
      return edge;
    };
    const auto way_from = [&](const Edge &edge, const unsigned int v) {
      Tensor<1, dim> way = reference[v] - reference[edge[0]];
      if (dim == 3)
        {
          Tensor<1, dim> along = reference[edge[dim - 2]] - reference[edge[0]];
          along /= along.norm();
          way -= (way * along) * along;
        }
      return way / way.norm();
    };
    for (unsigned int f = 0; f < faces.size(); ++f)
      for (unsigned int c = 0; c < dim; ++c)
        {
          const Edge edge = edge_of(faces[f].vertices, c);
          at_edge[edge].push_back(
            {f, faces[f].normal, way_from(edge, faces[f].vertices[c])});
        }
    const types::boundary_id own =
      grid->boundary_id(wall.boundary, wall.parameter);
    for (const BoundaryFace &face : grid->boundary_faces())
      {
        if (face.id == own || grid->layer_of_cell(face.cell) != 0)
          continue;
        std::array<unsigned int, dim> vertices;
        unsigned int                  n = 0;
        for (unsigned int v = 0; v <= dim; ++v)
          if (v != face.opposite_vertex)
            vertices[n++] = geometry.vertex_indices(face.cell)[v];
        for (unsigned int c = 0; c < dim; ++c)
          {
            const Edge edge  = edge_of(vertices, c);
            const auto found = at_edge.find(edge);
            if (found != at_edge.end())
              found->second.push_back({numbers::invalid_unsigned_int,
                                       {},
                                       way_from(edge, vertices[c])});
          }
      }
    rims.assign(faces.size(), {});
    parts.resize(faces.size());
    std::iota(parts.begin(), parts.end(), 0);
    const auto root = [&](unsigned int f) {
      while (parts[f] != f)
        f = parts[f];
      return f;
    };
    for (unsigned int f = 0; f < faces.size(); ++f)
      for (unsigned int c = 0; c < dim; ++c)
        {
          rims[f][c] = Facets::Rim::free;
          for (const AtEdge &other : at_edge[edge_of(faces[f].vertices, c)])
            if (other.number == f)
              continue;
            else if (other.number != numbers::invalid_unsigned_int &&
                     other.normal * faces[f].normal > smooth)
              {
                rims[f][c] = Facets::Rim::none;
                parts[std::max(root(f), root(other.number))] =
                  std::min(root(f), root(other.number));
                break;
              }
            else if (other.way * faces[f].normal > rounding)
              rims[f][c] = Facets::Rim::concave;
        }
    std::map<unsigned int, unsigned int> number;
    for (unsigned int f = 0; f < faces.size(); ++f)
      parts[f] = root(f); // the first of a part has the least number
    for (unsigned int &part : parts)
      part = number.emplace(part, number.size()).first->second;
  }



  template <int dim>
  double
  GridBoundaryPartner<dim>::shift_at(const Point<dim> &x) const
  {
    const auto value = [&](const double t) { return formula(x, t); };
    return trial.size == 0 ? value(time) : trial.at_end(value);
  }



  template <int dim>
  void
  GridBoundaryPartner<dim>::update(const StepContext<dim> &step,
                                   const NodalField & /*unknowns*/)
  {
    if (is_built && step.time == time)
      return;
    time     = step.time;
    is_built = true;
    shift    = depends_on_place ? 0. : shift_at(Point<dim>());
    if (depends_on_place)
      now = facets_at(grid->vertices_at_time(time), [&](const unsigned int v) {
        return shift_at(reference[v]);
      });
    else if (grid->is_moving())
      now = facets_at(grid->vertices_at_time(time), {});
  }



  template <int dim>
  PartnerPlace<dim>
  GridBoundaryPartner<dim>::nearest(
    const typename Partner<dim>::SurfacePlace &place) const
  {
    const Point<dim> x     = place.start->x + place.increment;
    const auto       found = (now ? now : at_start)->nearest(x, place.normal);
    return nearest_place<dim>(found.distance - shift,
                              found.normal,
                              found.curvature,
                              place.slip + place.increment,
                              Tensor<2, dim>(unit_symmetric_tensor<dim>()));
  }



  template <int dim>
  PartnerPlace<dim>
  GridBoundaryPartner<dim>::original(
    const typename Partner<dim>::SurfacePlace &place) const
  {
    const auto  found = at_start->nearest(place.start->X, place.normal);
    const auto &facet = at_start->facets()[found.facet];
    Point<dim>  X, x;
    const auto &facet_now = (now ? now : at_start)->facets()[found.facet];
    for (unsigned int v = 0; v < dim; ++v)
      {
        X += found.weights[v] * facet.corners[v];
        x += found.weights[v] * facet_now.corners[v];
      }
    // what the vertices have at t = 0 by the formula is no motion
    const double at_zero = formula(X, 0.);
    PartnerPlace<dim> result;
    result.gap_by_x = unit_symmetric_tensor<dim>();
    result.gap      = place.start->displacement + place.increment - (x - X) -
                 (shift - at_zero) * found.normal;
    return result;
  }



  template class GridBoundaryPartner<2>;
  template class GridBoundaryPartner<3>;
} // namespace isochor
