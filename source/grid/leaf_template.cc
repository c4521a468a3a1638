/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <deal.II/base/point.h>
#include <deal.II/base/tensor.h>

#include <isochor/grid/leaf_template.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

namespace isochor
{
  using namespace dealii;

  namespace
  {
    /** The nodes of face @p f of a hexahedron, as the rule of its splitting
     * numbers them: the corners 00, 10, 11, 01, the middles of the edges
     * v = 0, u = 1, v = 1, u = 0, and the centre. @p frame is where u and v
     * point, see frame_of_face(). */
    std::array<unsigned char, 9>
    face_nodes(const unsigned int f, const unsigned int frame)
    {
      AssertIndexRange(f, 6);
      AssertIndexRange(frame, 8);
      constexpr unsigned int u[9] = {0, 2, 2, 0, 1, 2, 1, 0, 1};
      constexpr unsigned int v[9] = {0, 0, 2, 2, 0, 1, 2, 1, 1};
      const unsigned int n = f / 2, a = (n == 0 ? 1 : 0), b = (n == 2 ? 1 : 2);
      const bool         swap = frame & 4;
      std::array<unsigned char, 9> nodes;
      for (unsigned int k = 0; k < 9; ++k)
        {
          unsigned int i = swap ? v[k] : u[k], j = swap ? u[k] : v[k];
          i        = (frame & 1) ? 2 - i : i;
          j        = (frame & 2) ? 2 - j : j;
          nodes[k] = 2 * (f % 2) * power_of_three[n] + i * power_of_three[a] +
                     j * power_of_three[b];
        }
      return nodes;
    }

    using Triangles = std::vector<std::array<unsigned char, 3>>;

    /**
     * The triangles of a face by the numbers of face_nodes(), for each set of
     * middles of edges that are vertices (bits 0 to 3: v = 0, u = 1, v = 1,
     * u = 0). Where there is a choice it is the one whose worst triangle has
     * the best mean ratio, of equals the first.
     */
    const Triangles &
    face_triangles(const unsigned int middles, const bool has_centre)
    {
      AssertIndexRange(middles, 16);
      Assert(!has_centre || middles == 15,
             ExcMessage("A refined face has all middles."));
      const auto parse = [](const std::string &text) {
        // corners 0 to 3, then the middles of the four edges and the centre
        const std::string names = "0123brtlc";
        Triangles         triangles;
        for (std::size_t i = 0; i < text.size(); i += 4)
          {
            triangles.emplace_back();
            for (unsigned int v = 0; v < 3; ++v)
              triangles.back()[v] = names.find(text[i + v]);
          }
        return triangles;
      };
      static const std::array<Triangles, 16> tables = {
        {parse("012 023"),
         parse("b12 b23 b30"),
         parse("r23 r30 r01"),
         parse("0b3 b1r br3 r23"),
         parse("t30 t01 t12"),
         parse("0b3 b1t 12t bt3"),
         parse("01r 0rt r2t 0t3"),
         parse("0b3 b1r brt r2t bt3"),
         parse("l01 l12 l23"),
         parse("0bl b12 b2l 23l"),
         parse("01l 1rl r2l 23l"),
         parse("0bl b1r brl r2l 23l"),
         parse("01l 12t 1tl t3l"),
         parse("0bl b1t 12t btl t3l"),
         parse("01l 1rl r2t rtl t3l"),
         parse("0bl b1r brl r2t rtl t3l")}};
      static const Triangles refined = parse("0bc 0cl b1r brc cr2 c2t lct lt3");
      return has_centre ? refined : tables[middles];
    }

    template <int dim>
    Point<dim>
    lattice_point(const unsigned int node)
    {
      AssertIndexRange(node, LeafTemplate<dim>::n_nodes);
      Point<dim> x;
      for (unsigned int d = 0; d < dim; ++d)
        x[d] = coordinate(node, d);
      return x;
    }

    template <int dim>
    double
    signed_volume(const std::array<unsigned char, dim + 1> &simplex)
    {
      Tensor<2, dim> edges;
      for (unsigned int i = 0; i < dim; ++i)
        edges[i] =
          lattice_point<dim>(simplex[i + 1]) - lattice_point<dim>(simplex[0]);
      return determinant(edges);
    }

    /** A simplex of local nodes, positively oriented. */
    template <int dim>
    std::array<unsigned char, dim + 1>
    oriented(std::array<unsigned char, dim + 1> simplex)
    {
      if (signed_volume<dim>(simplex) < 0)
        std::swap(simplex[dim - 1], simplex[dim]);
      return simplex;
    }

    std::array<unsigned char, 3>
    simplex_2d(const unsigned char a,
               const unsigned char b,
               const unsigned char c)
    {
      return {{a, b, c}};
    }

    /** Mean ratio of a tetrahedron of local nodes, to the power 3/2 and but
     * for a factor: enough to compare. */
    double
    quality(const std::array<unsigned char, 4> &simplex)
    {
      double sum = 0;
      for (unsigned int i = 0; i < 4; ++i)
        for (unsigned int j = 0; j < i; ++j)
          sum += lattice_point<3>(simplex[i])
                   .distance_square(lattice_point<3>(simplex[j]));
      return signed_volume<3>(simplex) / std::pow(sum, 1.5);
    }

    LeafTemplate<2>
    split_square(const std::uint32_t present, const unsigned int frame)
    {
      AssertIndexRange(frame, 2);
      // the nodes of the sides, and for plain leaves the diagonal
      constexpr unsigned char sides[4][3] = {{6, 3, 0},
                                             {2, 5, 8},
                                             {0, 1, 2},
                                             {8, 7, 6}};
      LeafTemplate<2>         result;
      for (unsigned int f = 0; f < 4; ++f)
        if ((present >> sides[f][1]) & 1u)
          {
            result.sides[f].push_back({{sides[f][0], sides[f][1]}});
            result.sides[f].push_back({{sides[f][1], sides[f][2]}});
          }
        else
          result.sides[f].push_back({{sides[f][0], sides[f][2]}});
      if (present == corner_bits<2>())
        {
          const bool up = (frame == 0); // "/"
          result.simplices.push_back(up ? simplex_2d(0, 2, 8) :
                                          simplex_2d(0, 2, 6));
          result.simplices.push_back(up ? simplex_2d(0, 8, 6) :
                                          simplex_2d(2, 8, 6));
        }
      else
        for (const auto &side : result.sides)
          for (const auto &edge : side)
            result.simplices.push_back(
              oriented<2>({{LeafTemplate<2>::n_nodes / 2, edge[0], edge[1]}}));
      return result;
    }

    /** The tetrahedra between a node and all triangles on the @p sides that
     * don't contain it. */
    template <typename Sides>
    std::vector<std::array<unsigned char, 4>>
    cone(const Sides &sides, const unsigned char apex)
    {
      std::vector<std::array<unsigned char, 4>> simplices;
      for (const auto &side : sides)
        for (const auto &t : side)
          if (std::find(t.begin(), t.end(), apex) == t.end())
            simplices.push_back(oriented<3>({{apex, t[0], t[1], t[2]}}));
      return simplices;
    }

    LeafTemplate<3>
    split_cube(const std::uint32_t                present,
               const std::array<unsigned int, 6> &frames)
    {
      LeafTemplate<3> result;
      for (unsigned int f = 0; f < 6; ++f)
        {
          const auto   nodes   = face_nodes(f, frames[f]);
          unsigned int middles = 0;
          for (unsigned int k = 0; k < 4; ++k)
            middles |= ((present >> nodes[4 + k]) & 1u) << k;
          for (const auto &triangle :
               face_triangles(middles, ((present >> nodes[8]) & 1u) != 0))
            result.sides[f].push_back(
              {{nodes[triangle[0]], nodes[triangle[1]], nodes[triangle[2]]}});
        }
      double best = 0;
      for (unsigned int i = 0; present == corner_bits<3>() && i < 8; ++i)
        {
          const auto simplices = cone(result.sides, corner_node<3>(i));
          // with more, triangles of its own faces don't contain it
          if (simplices.size() != 6)
            continue;
          double worst = std::numeric_limits<double>::max();
          for (const auto &simplex : simplices)
            worst = std::min(worst, quality(simplex));
          if (worst > best * (1 + 1e-12))
            {
              best             = worst;
              result.simplices = simplices;
            }
        }
      if (result.simplices.empty())
        result.simplices = cone(result.sides, LeafTemplate<3>::n_nodes / 2);
      return result;
    }
  } // namespace



  template <int dim>
  LeafTemplate<dim>
  split_leaf(const std::uint32_t                      present,
             const std::array<unsigned int, 2 * dim> &frames)
  {
    Assert((present & corner_bits<dim>()) == corner_bits<dim>(),
           ExcMessage("The corners of a leaf are vertices."));
    if constexpr (dim == 2)
      return split_square(present, frames[0]);
    else
      return split_cube(present, frames);
  }



  template LeafTemplate<2>
  split_leaf<2>(const std::uint32_t, const std::array<unsigned int, 4> &);
  template LeafTemplate<3>
  split_leaf<3>(const std::uint32_t, const std::array<unsigned int, 6> &);
} // namespace isochor
