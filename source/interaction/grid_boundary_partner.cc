/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <isochor/base/rounding.h>
#include <isochor/interaction/grid_boundary_partner.h>

#include <algorithm>

namespace isochor
{
  namespace
  {
    /** The vertices of a face without corner @p c, ascending. */
    template <int dim>
    std::array<unsigned int, dim - 1>
    edge_of(const std::array<unsigned int, dim> &face, const unsigned int c)
    {
      std::array<unsigned int, dim - 1> edge;
      unsigned int                      n = 0;
      for (unsigned int i = 0; i < dim; ++i)
        if (i != c)
          edge[n++] = face[i];
      std::sort(edge.begin(), edge.end());
      return edge;
    }

    /** The direction from an edge to a vertex, across the edge. */
    template <int dim>
    Tensor<1, dim>
    way_from(const std::vector<Point<dim>>           &vertices,
             const std::array<unsigned int, dim - 1> &edge,
             const unsigned int                       vertex)
    {
      Tensor<1, dim> way = vertices[vertex] - vertices[edge[0]];
      if (dim == 3)
        {
          const Tensor<1, dim> along =
            vertices[edge[dim - 2]] - vertices[edge[0]];
          way -= (way * along) / along.norm_square() * along;
        }
      return way / way.norm();
    }
  } // namespace



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
  typename GridBoundaryPartner<dim>::Edges
  GridBoundaryPartner<dim>::edges_of(const Faces &faces) const
  {
    Edges edges;
    for (unsigned int f = 0; f < faces.size(); ++f)
      for (unsigned int c = 0; c < dim; ++c)
        {
          const Edge edge = edge_of<dim>(faces[f].vertices, c);
          edges[edge].push_back(
            {f, way_from<dim>(reference, edge, faces[f].vertices[c])});
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
            vertices[n++] = grid->geometry().vertex_indices(face.cell)[v];
        for (unsigned int c = 0; c < dim; ++c)
          {
            const Edge edge  = edge_of<dim>(vertices, c);
            const auto found = edges.find(edge);
            if (found != edges.end())
              found->second.push_back(
                {numbers::invalid_unsigned_int,
                 way_from<dim>(reference, edge, vertices[c])});
          }
      }
    return edges;
  }



  template <int dim>
  typename GridBoundaryPartner<dim>::Facets::Rim
  GridBoundaryPartner<dim>::rim_of(const Faces               &faces,
                                   const unsigned int         f,
                                   const std::vector<AtEdge> &at_edge,
                                   std::vector<unsigned int> &smooth) const
  {
    auto rim = Facets::Rim::free;
    for (const AtEdge &other : at_edge)
      {
        if (other.face == f)
          continue;
        if (other.face != numbers::invalid_unsigned_int &&
            faces[other.face].normal * faces[f].normal >
              cosine_of_smooth_walls())
          {
            smooth.push_back(other.face);
            return Facets::Rim::none;
          }
        if (other.way * faces[f].normal > rounding::accumulated)
          rim = Facets::Rim::concave;
      }
    return rim;
  }



  template <int dim>
  void
  GridBoundaryPartner<dim>::find_rims()
  {
    const Faces                            faces = faces_at(reference, {});
    const Edges                            edges = edges_of(faces);
    std::vector<std::vector<unsigned int>> smooth(faces.size());
    rims.assign(faces.size(), {});
    for (unsigned int f = 0; f < faces.size(); ++f)
      for (unsigned int c = 0; c < dim; ++c)
        rims[f][c] = rim_of(faces,
                            f,
                            edges.at(edge_of<dim>(faces[f].vertices, c)),
                            smooth[f]);
    // what is connected smoothly is a part
    parts.assign(faces.size(), numbers::invalid_unsigned_int);
    unsigned int n_parts = 0;
    for (unsigned int first = 0; first < faces.size(); ++first)
      {
        if (parts[first] != numbers::invalid_unsigned_int)
          continue;
        std::vector<unsigned int> front(1, first);
        while (!front.empty())
          {
            const unsigned int f = front.back();
            front.pop_back();
            if (parts[f] != numbers::invalid_unsigned_int)
              continue;
            parts[f] = n_parts;
            front.insert(front.end(), smooth[f].begin(), smooth[f].end());
          }
        ++n_parts;
      }
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
  double
  GridBoundaryPartner<dim>::distance_of_chord(const Point<dim> &X) const
  {
    if (at_start->is_flat())
      return 0.;
    const auto  place = at_start->nearest(X, Tensor<1, dim>());
    const auto &facet = at_start->facets()[place.facet];
    Point<dim>  p;
    for (unsigned int v = 0; v < dim; ++v)
      p += place.weights[v] * facet.corners[v];
    const bool is_on_facet =
                 X.distance(p) <= rounding::accumulated *
                                    facet.corners[0].distance(facet.corners[1]),
               is_behind_chord =
                 place.distance < 0 && (X - p) * facet.normal > 0;
    return is_on_facet || is_behind_chord ? place.distance : 0.;
  }



  template <int dim>
  PartnerPlace<dim>
  GridBoundaryPartner<dim>::nearest(
    const typename Partner<dim>::SurfacePlace &place) const
  {
    const Point<dim> x     = place.start->x + place.increment;
    const auto       found = (now ? now : at_start)->nearest(x, place.normal);
    return nearest_place<dim>(found.distance - shift -
                                distance_of_chord(place.start->X),
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
    const double      at_zero = formula(X, 0.);
    PartnerPlace<dim> result;
    result.gap_by_x = unit_symmetric_tensor<dim>();
    result.gap      = place.start->displacement + place.increment - (x - X) -
                 (shift - at_zero) * found.normal;
    return result;
  }



  template class GridBoundaryPartner<2>;
  template class GridBoundaryPartner<3>;
} // namespace isochor
