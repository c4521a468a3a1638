/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_approach_watch_h
#define isochor_approach_watch_h

#include <isochor/equations/element_nodes.h>
#include <isochor/equations/equation_term.h>
#include <isochor/material_points/material_points.h>
#include <isochor/material_points/point_locator.h>
#include <isochor/transfer/held_boundary.h>

#include <array>
#include <map>
#include <set>
#include <string>
#include <vector>

namespace isochor
{
  /**
   * On a grid that moves with the body bodies don't feel each other, nor the
   * boundaries that they did not touch when it was last put back: contact is
   * what points of the undeformed grid have in common, nodes. This finds where
   * it would begin. After each step the points in cells at the surface of the
   * body are located in the undeformed grid, which has to be put back if the
   * cells that points of two bodies are in have come to share a vertex, or
   * those of places of one that an empty cell lay between and that are half as
   * far from each other as they were. Or if a point has come into a cell at the
   * boundary, or would by another step like the last one, one with vertices
   * there that conditions hold, that points which slide along the boundary have
   * not come to, and that face another way than the boundary its own cell
   * touches. Whether stencils reach the boundary doesn't count: a node of a
   * small weight lets the body through, of which its cell takes no notice.
   * Bodies that have nodes in common at t = 0 are one.
   *
   * On grids that are stretched boundaries are not looked at. Cells that touch
   * the boundary with a vertex only don't count as cells at the boundary.
   */
  template <int dim>
  class ApproachWatch
  {
  public:
    /** The vertices that boundary conditions hold in any direction, ascending.
     */
    void
    set_walls(const std::vector<unsigned int> &vertices)
    {
      boundary.set(vertices);
    }

    /** The grid has been put back. */
    void
    start()
    {
      is_started = false;
    }

    enum class Approach
    {
      none,
      to_boundary,
      of_bodies
    };
    /** The step has converged, and the @p points are where it ended; the
     * @p elements are those of all equations. Collective. */
    Approach
    look(const StepContext<dim>  &step,
         const ElementNodes      &elements,
         const PointLocator<dim> &locator,
         const NodalField        &unknowns,
         MaterialPoints<dim>     &points);

    /** Where bodies were found to come together: " near (x y)", or nothing if
     * they had nodes in common when the grid was put back. */
    const std::string &
    place_of_contact() const
    {
      return place;
    }

    /** If bodies were found to come together: how many they were before; 0 if
     * parts of one did. */
    unsigned int
    n_bodies_apart() const
    {
      return n_apart;
    }

    template <class Archive>
    void
    serialize(Archive &archive, const unsigned int /*version*/)
    {
      archive &n_parts;
    }

  private:
    /** What of the body is near a vertex. */
    struct Mark
    {
      unsigned int least_part, largest_part;
      double       cell_size;
      /** Of the points that were furthest in -x, x, -y, y ... at the last
       * reset: where they were, and where they are. */
      struct Way
      {
        Point<dim> from, to;
      };
      std::array<Way, 2 * dim> furthest;

      void
      add(const Mark &other);
    };
    using Marks = std::map<unsigned int, Mark>;

    void
    find_surface(const StepContext<dim> &step, const ElementNodes &elements);
    /** Those of all ranks. */
    static void
    share(const MPI_Comm comm, Marks &marks);
    /** Whether an empty cell lies between points that some of the @p marks
     * name, in the grid as it was put back; finds the place where they are now.
     */
    bool
                      any_gap(const StepContext<dim>  &step,
                              const PointLocator<dim> &locator,
                              const Marks             &marks);
    HeldBoundary<dim> boundary;
    /** A vertex and a part: of the faces at which parts touched the boundary at
     * the last reset. Of all ranks. */
    std::set<VertexOfPart> touched;
    /** The parts that touched the boundary. */
    std::set<unsigned int> attached;
    bool                   is_started = false;
    std::string            place;
    /** How many bodies there were at the last reset; 0: not known. */
    unsigned int n_parts = 0;
    unsigned int n_apart = 0; ///< see n_bodies_apart()
    /** By occupied cell: whether it has a face at the boundary. */
    std::vector<unsigned char> has_face;
    /** By occupied cell: whether a neighbour is empty; its part; the number of
     * its entry in boundary_normals, from 1 on, if it touches the boundary
     * where its part does, else 0. */
    std::vector<unsigned char>               at_surface;
    std::vector<unsigned int>                part, at_boundary;
    std::vector<std::vector<Tensor<1, dim>>> boundary_normals;
    /** By point: the cell that it was last found in. */
    std::vector<unsigned int> hint;
  };
} // namespace isochor

#endif
