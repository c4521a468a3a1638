/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <deal.II/base/mpi.h>

#include <isochor/base/plain_message.h>
#include <isochor/boundary_condition/periodic_vertices.h>

#include <algorithm>
#include <set>

namespace isochor
{
  namespace
  {
    template <int dim>
    std::vector<unsigned int>
    vertices_on(const BackgroundGrid<dim> &grid,
                const std::string         &boundary,
                const std::string         &parameter,
                const unsigned int         layer)
    {
      const types::boundary_id id = grid.boundary_id(boundary, parameter);
      std::set<unsigned int>   found;
      for (const BoundaryFace &face : grid.boundary_faces())
        for (unsigned int v = 0; v <= dim && face.id == id &&
                                 grid.layer_of_cell(face.cell) == layer;
             ++v)
          if (v != face.opposite_vertex)
            found.insert(grid.geometry().vertex_indices(face.cell)[v]);
      return {found.begin(), found.end()};
    }

    template <int dim>
    std::string
    text(const Point<dim> &x)
    {
      std::string result = "(";
      for (unsigned int d = 0; d < dim; ++d)
        result += (d > 0 ? ", " : "") + rounded(x[d]);
      return result + ")";
    }
  } // namespace



  template <int dim>
  Tensor<1, dim>
  period_between(const BackgroundGrid<dim> &grid,
                 const std::string         &first,
                 const std::string         &second,
                 const std::string         &parameter)
  {
    const auto mean = [&](const std::string &boundary) {
      const auto     on = vertices_on(grid, boundary, parameter, 0);
      Tensor<1, dim> sum;
      for (const unsigned int v : on)
        sum += grid.geometry().vertices()[v] / double(on.size());
      return sum;
    };
    return mean(second) - mean(first);
  }



  template <int dim>
  std::map<unsigned int, unsigned int>
  PeriodicVertices<dim>::match(const BackgroundGrid<dim> &grid,
                               const std::string         &first,
                               const std::string         &second,
                               const std::string         &parameter)
  {
    std::map<unsigned int, unsigned int> image;
    for (unsigned int layer = 0; layer < grid.n_layers(); ++layer)
      image.merge(match_in_layer(grid, first, second, parameter, layer));
    return image;
  }



  template <int dim>
  std::map<unsigned int, unsigned int>
  PeriodicVertices<dim>::match_in_layer(const BackgroundGrid<dim> &grid,
                                        const std::string         &first,
                                        const std::string         &second,
                                        const std::string         &parameter,
                                        const unsigned int         layer)
  {
    const std::string pair =
      "the sides <" + first + "> and <" + second + "> of <" + parameter + ">";
    const std::string remedy =
      grid.is_adaptive() ?
        " Periodic sides need the same mesh: the cells on both have to be "
        "refined alike, as by a formula in <Adaptive grid/Cell size> that is "
        "the same on both and small enough for the other criteria." :
        " Periodic sides need the same mesh.";
    const auto &x    = grid.geometry().vertices();
    const auto  from = vertices_on(grid, first, parameter, layer);
    const auto  to   = vertices_on(grid, second, parameter, layer);
    AssertThrow(from.size() == to.size(),
                ExcMessage("The vertices of " + pair +
                           " don't match: there are " +
                           std::to_string(from.size()) + " and " +
                           std::to_string(to.size()) + " of them." + remedy));
    Tensor<1, dim> shift;
    double         smallest = std::numeric_limits<double>::max();
    for (unsigned int i = 0; i < from.size(); ++i)
      {
        shift += (x[to[i]] - x[from[i]]) / double(from.size());
        if (i > 0)
          smallest = std::min(smallest, x[from[i]].distance(x[from[i - 1]]));
      }
    const double tolerance = 1e-6 * std::min(smallest, shift.norm());

    // sorted by place, but for rounding
    std::map<unsigned int, unsigned int> image;
    std::vector<unsigned int>            left = from;
    for (const unsigned int v : to)
      {
        const auto nearest =
          std::min_element(left.begin(),
                           left.end(),
                           [&](const unsigned int a, const unsigned int b) {
                             return x[v].distance_square(x[a] + shift) <
                                    x[v].distance_square(x[b] + shift);
                           });
        const double distance = x[v].distance(x[*nearest] + shift);
        AssertThrow(distance <= tolerance,
                    ExcMessage(
                      "The vertices of " + pair + " don't match: that at " +
                      text(x[v]) + " on <" + second + "> is " +
                      rounded(distance) + " m away from the image of " +
                      text(x[*nearest]) + " on <" + first +
                      ">, if the sides are moved on top of each other by the "
                      "distance of their means." +
                      remedy));
        image[v] = *nearest;
        left.erase(nearest);
      }
    return image;
  }



  template <int dim>
  void
  PeriodicVertices<dim>::initialize(
    const BackgroundGrid<dim>                              &grid,
    const std::vector<std::pair<std::string, std::string>> &pairs,
    const std::string                                      &parameter)
  {
    all_images.clear();
    images_of_root.clear();
    shared.clear();
    std::vector<std::map<unsigned int, unsigned int>> first_of;
    std::set<unsigned int>                            seconds;
    for (const auto &pair : pairs)
      {
        first_of.push_back(match(grid, pair.first, pair.second, parameter));
        for (const auto &image : first_of.back())
          seconds.insert(image.first);
      }
    for (const unsigned int vertex : seconds)
      {
        Image image{vertex, vertex, {}, true};
        for (bool moved = true; moved;)
          {
            moved = false;
            for (unsigned int k = 0; k < pairs.size(); ++k)
              {
                const auto first = first_of[k].find(image.root);
                if (first == first_of[k].end())
                  continue;
                AssertThrow(std::find(image.pairs.begin(),
                                      image.pairs.end(),
                                      k) == image.pairs.end(),
                            ExcMessage("The parameter <" + parameter +
                                       "> goes round in a circle at <" +
                                       pairs[k].second + ">."));
                image.root = first->second;
                image.pairs.push_back(k);
                moved = true;
              }
          }
        std::sort(image.pairs.begin(), image.pairs.end());
        all_images.push_back(image);
        images_of_root[image.root].push_back(vertex);
        shared[image.root] = true;
      }
  }



  template <int dim>
  std::vector<std::pair<unsigned int, unsigned int>>
  PeriodicVertices<dim>::images_by(const unsigned int p) const
  {
    std::vector<std::pair<unsigned int, unsigned int>> result;
    for (const Image &image : all_images)
      if (image.pairs == std::vector<unsigned int>{p})
        result.emplace_back(image.root, image.vertex);
    return result;
  }



  template <int dim>
  void
  PeriodicVertices<dim>::share(const std::vector<unsigned int> &held)
  {
    for (const auto &root : images_of_root)
      {
        const auto is_held = [&held](const unsigned int v) {
          return std::binary_search(held.begin(), held.end(), v);
        };
        shared[root.first] =
          is_held(root.first) +
            std::count_if(root.second.begin(), root.second.end(), is_held) >
          1;
      }
    for (Image &image : all_images)
      image.shared = shared.at(image.root);
  }



  template <int dim>
  std::vector<unsigned int>
  PeriodicVertices<dim>::all() const
  {
    std::vector<unsigned int> vertices;
    for (const auto &root : images_of_root)
      {
        vertices.push_back(root.first);
        vertices.insert(vertices.end(), root.second.begin(), root.second.end());
      }
    return vertices;
  }



  template <int dim>
  std::vector<unsigned int>
  PeriodicVertices<dim>::corners() const
  {
    std::set<unsigned int> roots;
    for (const Image &image : all_images)
      if (image.pairs.size() == dim)
        roots.insert(image.root);
    return {roots.begin(), roots.end()};
  }



  template <int dim>
  bool
  PeriodicVertices<dim>::touch_images(const BackgroundGrid<dim> &grid,
                                      std::vector<unsigned int> &touched) const
  {
    const unsigned int rank =
      Utilities::MPI::this_mpi_process(grid.communicator());
    std::set<unsigned int> here(touched.begin(), touched.end());
    // of each root: touched by any rank
    std::vector<unsigned int> by_any;
    for (const auto &root : images_of_root)
      by_any.push_back(
        here.count(root.first) != 0 ||
        std::any_of(root.second.begin(),
                    root.second.end(),
                    [&](const unsigned int v) { return here.count(v) != 0; }));
    const std::vector<unsigned int> by_this = by_any;
    if (!by_any.empty())
      Utilities::MPI::max(by_any, grid.communicator(), by_any);
    unsigned int k   = 0;
    bool         any = false;
    for (const auto &root : images_of_root)
      {
        const auto owns = [&](const unsigned int v) {
          return grid.vertex_owner(v) == rank;
        };
        if (by_any[k] != 0 &&
            (by_this[k] != 0 || shared.at(root.first) || owns(root.first) ||
             std::any_of(root.second.begin(), root.second.end(), owns)))
          {
            touched.push_back(root.first);
            touched.insert(touched.end(),
                           root.second.begin(),
                           root.second.end());
          }
        any = any || by_any[k] != 0;
        ++k;
      }
    return any;
  }



  template Tensor<1, 2>
  period_between(const BackgroundGrid<2> &,
                 const std::string &,
                 const std::string &,
                 const std::string &);
  template Tensor<1, 3>
  period_between(const BackgroundGrid<3> &,
                 const std::string &,
                 const std::string &,
                 const std::string &);
  template class PeriodicVertices<2>;
  template class PeriodicVertices<3>;
} // namespace isochor
