/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_smooth_wall_h
#define isochor_smooth_wall_h

#include <isochor/base/expression.h>
#include <isochor/boundary_condition/contact_search.h>
#include <isochor/boundary_condition/distance_to_body.h>
#include <isochor/boundary_condition/wall_surface.h>
#include <isochor/equations/equation_term.h>

#include <numeric>
#include <set>
#include <string>
#include <vector>

namespace isochor
{
  /** A smooth wall at a side of the grid, and what it knows of its nodes. */
  template <int dim>
  struct SmoothWall
  {
    /** A node at a wall, and one of its normals; the same on all ranks. */
    struct Node
    {
      unsigned int   vertex;
      Tensor<1, dim> normal; ///< at the vertex
      WallNode       contact;
      /** On a grid that is kept, at a curved wall: how far the wall has come
       * along its normal since the reset, from the boundary (m), and the node
       * (m); and the normal and the gap where it is now. */
      double         offset = 0;
      Tensor<1, dim> moved, normal_now;
      double         gap_now = 0;
    };

    std::string       boundary;
    bool              one_sided;
    Expression<dim>   displacement;
    WallSurface<dim>  surface;
    std::vector<Node> nodes;
    /** Distances of the body from the wall at the last reset of the grid, by
     * node; empty if they are not known. */
    std::vector<double> gap_of_body = {};

    /** Set gap_of_body, at a reset of the grid, whose vertices were at the
     * places @p reference when they were generated, by @p normals of nodes now.
     * Collective. */
    void
    measure_gaps(const StepContext<dim>            &step,
                 const std::vector<Point<dim>>     &reference,
                 const std::vector<Tensor<1, dim>> &normals)
    {
      gap_of_body.clear();
      // a vertex with several normals takes part in as many rounds
      std::vector<unsigned int> left(nodes.size());
      std::iota(left.begin(), left.end(), 0);
      while (!left.empty())
        {
          std::vector<unsigned int>   round, later, vertices;
          std::vector<Tensor<1, dim>> inwards;
          std::set<unsigned int>      taken;
          for (const unsigned int i : left)
            if (taken.insert(nodes[i].vertex).second)
              {
                round.push_back(i);
                vertices.push_back(nodes[i].vertex);
                inwards.push_back(normals[i]);
              }
            else
              later.push_back(i);
          const std::vector<double> gaps = gaps_of_body<dim>(
            step, reference, vertices, inwards, [&](const unsigned int k) {
              return displacement(reference[vertices[k]], step.old_time);
            });
          if (gaps.empty())
            return;
          gap_of_body.resize(nodes.size());
          for (unsigned int k = 0; k < round.size(); ++k)
            gap_of_body[round[k]] = gaps[k];
          left = later;
        }
      for (unsigned int i = 0; i < nodes.size(); ++i)
        if (step.old_time == 0 && gap_of_body[i] > 0)
          nodes[i].contact.released = nodes[i].contact.was_released = true;
    }

    /** By node, see update_gaps(). Collective. */
    void
    remember_gaps(std::vector<double> &gaps, const MPI_Comm comm)
    {
      std::vector<WallNode> contact;
      for (const Node &node : nodes)
        contact.push_back(node.contact);
      update_gaps(gaps, comm, contact);
      for (unsigned int i = 0; i < nodes.size(); ++i)
        nodes[i].contact = contact[i];
    }

    void
    add_vertices(std::vector<unsigned int> &vertices) const
    {
      for (const Node &node : nodes)
        vertices.push_back(node.vertex);
    }

    /** The displacement (m) in the step along @p normal of @p node, on a rank
     * that has it. */
    static double
    along(const Tensor<1, dim>   &normal,
          const unsigned int      node,
          const StepContext<dim> &step,
          const NodalField       &unknowns)
    {
      double sum = 0;
      for (unsigned int a = 0; a < dim; ++a)
        sum += normal[a] * unknowns.local_element(node * step.n_components + a);
      return sum;
    }
  };
} // namespace isochor

#endif
