/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <isochor/base/plain_message.h>
#include <isochor/rigid_body/closed_mesh.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace isochor
{
  namespace
  {
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
  ClosedMesh<dim>::ClosedMesh(SurfaceMesh<dim>   surface,
                              const std::string &subject)
    : mesh(std::move(surface))
  {
    Assert(!mesh.facets.empty(), ExcMessage("There is no surface."));
    find_neighbours(subject);
    turn_outwards(orient(subject));
  }



  template <int dim>
  Tensor<1, dim>
  ClosedMesh<dim>::normal_vector(const unsigned int facet) const
  {
    const auto          &corners = mesh.facets[facet];
    const Tensor<1, dim> a =
      mesh.vertices[corners[1]] - mesh.vertices[corners[0]];
    if constexpr (dim == 2)
      return Tensor<1, 2>({a[1], -a[0]});
    else
      return cross_product_3d(a,
                              mesh.vertices[corners[2]] -
                                mesh.vertices[corners[0]]);
  }



  template <int dim>
  typename ClosedMesh<dim>::Ridge
  ClosedMesh<dim>::ridge(const unsigned int facet, const unsigned int i) const
  {
    Ridge result;
    for (unsigned int k = 0; k + 1 < dim; ++k)
      result[k] = mesh.facets[facet][(i + 1 + k) % dim];
    std::sort(result.begin(), result.end());
    return result;
  }



  template <int dim>
  void
  ClosedMesh<dim>::find_neighbours(const std::string &subject)
  {
    const unsigned int n = mesh.facets.size();
    std::map<Ridge, std::vector<std::pair<unsigned int, unsigned int>>> all;
    for (unsigned int f = 0; f < n; ++f)
      for (unsigned int i = 0; i < dim; ++i)
        all[ridge(f, i)].emplace_back(f, i);
    neighbours.resize(n);
    ridges.resize(n);
    unsigned int number = 0;
    for (const auto &[vertices, sides] : all)
      {
        std::string where = text(mesh.vertices[vertices.front()]);
        if (dim == 3)
          where += " - " + text(mesh.vertices[vertices.back()]);
        AssertThrow(sides.size() == 2,
                    ExcMessage(
                      subject + "is not a closed surface: " +
                      std::to_string(sides.size()) +
                      (dim == 2 ? " lines end at " : " triangles share ") +
                      (dim == 2 ? "the point " : "the edge ") + where +
                      ", where there must be 2."));
        for (const unsigned int k : {0, 1})
          {
            const auto [f, i] = sides[k];
            neighbours[f][i]  = sides[1 - k].first;
            ridges[f][i]      = number;
          }
        ++number;
      }
  }



  template <int dim>
  bool
  ClosedMesh<dim>::agree(const unsigned int facet,
                         const unsigned int other,
                         const Ridge       &ridge) const
  {
    // they do if they run through the ridge in opposite directions
    const auto runs_up = [&](const unsigned int f) {
      const auto        &corners = mesh.facets[f];
      const unsigned int i =
        std::find(corners.begin(), corners.end(), ridge[0]) - corners.begin();
      if constexpr (dim == 2)
        return i == 0;
      else
        return corners[(i + 1) % dim] == ridge.back();
    };
    return runs_up(facet) != runs_up(other);
  }



  template <int dim>
  void
  ClosedMesh<dim>::turn(const unsigned int facet)
  {
    for (auto *of_corners : {&mesh.facets, &neighbours, &ridges})
      std::swap((*of_corners)[facet][0], (*of_corners)[facet][1]);
  }



  template <int dim>
  std::vector<unsigned int>
  ClosedMesh<dim>::orient(const std::string &subject)
  {
    constexpr unsigned int    none = numbers::invalid_unsigned_int;
    std::vector<unsigned int> part(mesh.facets.size(), none);
    unsigned int              n_parts = 0;
    for (unsigned int first = 0; first < part.size(); ++first)
      {
        if (part[first] != none)
          continue;
        std::vector<unsigned int> pending(1, first);
        part[first] = n_parts;
        while (!pending.empty())
          {
            const unsigned int f = pending.back();
            pending.pop_back();
            for (unsigned int i = 0; i < dim; ++i)
              {
                const unsigned int other  = neighbours[f][i];
                const Ridge        common = ridge(f, i);
                const bool         agrees = agree(f, other, common);
                AssertThrow(part[other] == none || agrees,
                            ExcMessage(subject +
                                       "has no inside: its facets can't all "
                                       "look outwards, near " +
                                       text(mesh.vertices[common[0]]) + "."));
                if (part[other] != none)
                  continue;
                if (!agrees)
                  turn(other);
                part[other] = n_parts;
                pending.push_back(other);
              }
          }
        ++n_parts;
      }
    return part;
  }



  template <int dim>
  void
  ClosedMesh<dim>::turn_outwards(const std::vector<unsigned int> &part)
  {
    std::vector<std::vector<unsigned int>> parts;
    for (unsigned int f = 0; f < part.size(); ++f)
      {
        parts.resize(std::max<std::size_t>(parts.size(), part[f] + 1));
        parts[part[f]].push_back(f);
      }
    for (const auto &facets : parts)
      {
        // dim times the volume
        double           volume = 0;
        const Point<dim> origin = mesh.vertices[mesh.facets[facets[0]][0]];
        for (const unsigned int f : facets)
          {
            volume +=
              normal_vector(f) * (mesh.vertices[mesh.facets[f][0]] - origin);
          }
        if (volume < 0)
          for (const unsigned int f : facets)
            turn(f);
      }
    // how many other parts are around each
    std::vector<unsigned int> n_around(parts.size(), 0);
    for (unsigned int p = 0; p < parts.size(); ++p)
      for (unsigned int q = 0; q < parts.size(); ++q)
        if (p != q)
          n_around[p] +=
            winding(parts[q], mesh.vertices[mesh.facets[parts[p][0]][0]]) > 0.5;
    for (unsigned int p = 0; p < parts.size(); ++p)
      if (n_around[p] % 2 == 1)
        for (const unsigned int f : parts[p])
          turn(f);
  }



  template <int dim>
  double
  ClosedMesh<dim>::winding(const std::vector<unsigned int> &facets,
                           const Point<dim>                &x) const
  {
    double sum = 0;
    for (const unsigned int f : facets)
      {
        std::array<Tensor<1, dim>, dim> arm;
        for (unsigned int i = 0; i < dim; ++i)
          arm[i] = mesh.vertices[mesh.facets[f][i]] - x;
        if constexpr (dim == 2)
          sum += std::atan2(arm[0][0] * arm[1][1] - arm[0][1] * arm[1][0],
                            arm[0] * arm[1]);
        else
          {
            // van Oosterom & Strackee, IEEE Trans. Biomed. Eng. 30 (1983) 125
            const double a = arm[0].norm(), b = arm[1].norm(),
                         c = arm[2].norm();
            sum += std::atan2(arm[0] * cross_product_3d(arm[1], arm[2]),
                              a * b * c + (arm[0] * arm[1]) * c +
                                (arm[1] * arm[2]) * a + (arm[2] * arm[0]) * b);
          }
      }
    return sum / (2 * numbers::PI);
  }



  template class ClosedMesh<2>;
  template class ClosedMesh<3>;
} // namespace isochor
