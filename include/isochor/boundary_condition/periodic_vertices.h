/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_periodic_vertices_h
#define isochor_periodic_vertices_h

#include <isochor/boundary_condition/condition_roles.h>
#include <isochor/grid/background_grid.h>

#include <map>
#include <string>
#include <utility>
#include <vector>

namespace isochor
{
  /** A boundary condition that may make sides of the grid the same place. */
  class HasPeriods
  {
  public:
    virtual ~HasPeriods() = default;

    /** The boundaries that are pairs of sides, first and second. */
    virtual std::vector<std::pair<std::string, std::string>>
    periodic_sides() const = 0;

    /** All that are the same place as others. */
    virtual std::vector<unsigned int>
    periodic_vertices() const = 0;

    /** Each vertex that is the same place as another one, and its root
     * (PeriodicVertices). */
    virtual std::vector<std::pair<unsigned int, unsigned int>>
    periodic_images() const = 0;

    /** What ConstrainsNodes::held_vertices() of all conditions name, sorted:
     * once they are initialised, and when the grid has changed. */
    virtual void
    set_held_vertices(const std::vector<unsigned int> &vertices) = 0;

    /** Material points have left the grid as it was put back, through
     * @p boundaries: what of this condition may be the cause, for the message.
     */
    virtual std::string
    why_points_left(const std::vector<std::string> &boundaries) const = 0;
  };

  /** From the vertices of the boundary @p first to those of @p second, at t =
   * 0, in the mean (m). @p parameter names the boundaries. */
  template <int dim>
  Tensor<1, dim>
  period_between(const BackgroundGrid<dim> &grid,
                 const std::string         &first,
                 const std::string         &second,
                 const std::string         &parameter);

  /** The periods of the pairs of all @p conditions, a list of pointers. */
  template <int dim, typename Conditions>
  std::vector<Tensor<1, dim>>
  find_periods(const BackgroundGrid<dim> &grid, const Conditions &conditions)
  {
    std::vector<Tensor<1, dim>> periods;
    for (const auto *const condition : with_role<const HasPeriods>(conditions))
      for (const auto &[first, second] : condition->periodic_sides())
        periods.push_back(
          period_between(grid, first, second, "Periodic sides"));
    return periods;
  }

  /** Those of all @p conditions, a list of pointers to them. */
  template <typename Conditions>
  std::vector<unsigned int>
  find_periodic_vertices(const Conditions &conditions)
  {
    std::vector<unsigned int> vertices;
    for (const auto *const condition : with_role<const HasPeriods>(conditions))
      for (const unsigned int v : condition->periodic_vertices())
        vertices.push_back(v);
    return vertices;
  }

  /** The images of all @p conditions and their roots. */
  template <typename Conditions>
  std::vector<std::pair<unsigned int, unsigned int>>
  find_periodic_images(const Conditions &conditions)
  {
    std::vector<std::pair<unsigned int, unsigned int>> images;
    for (const auto *const condition : with_role<const HasPeriods>(conditions))
      for (const auto &image : condition->periodic_images())
        images.push_back(image);
    return images;
  }

  /**
   * The vertices on pairs of sides that are the same place of a periodic body.
   * Each vertex of a second side is the image of one of the first; where pairs
   * meet, images have images, and all go back to one *root*, which is on no
   * second side. The same on all ranks.
   */
  template <int dim>
  class PeriodicVertices
  {
  public:
    struct Image
    {
      unsigned int              vertex, root;
      std::vector<unsigned int> pairs; ///< by which it is the root's image
      /** Whether all ranks know it. */
      bool shared = true;
    };

    /** Find the images for the @p pairs of boundary names, first and second.
     * @throws ExcMessage, naming @p parameter, if vertices don't match. */
    void
    initialize(const BackgroundGrid<dim>                              &grid,
               const std::vector<std::pair<std::string, std::string>> &pairs,
               const std::string &parameter);

    /** By ascending vertex. */
    const std::vector<Image> &
    images() const
    {
      return all_images;
    }

    /** The root and the vertex of images by pair @p p alone. */
    std::vector<std::pair<unsigned int, unsigned int>>
    images_by(const unsigned int p) const;

    /** Other conditions determine the displacements of @p held vertices
     * (sorted). Where two that are the same place are held, what is periodic
     * may determine unknowns that all ranks know: all of them then have to know
     * these vertices, from touch_images() on. */
    void
    share(const std::vector<unsigned int> &held);

    /** All vertices on the sides. */
    std::vector<unsigned int>
    all() const;

    /** The roots of vertices that are images by pairs in all directions. */
    std::vector<unsigned int>
    corners() const;

    /**
     * Add to @p touched all images and the root of vertices in it, of those
     * that this rank owns and others touch, and of those that all ranks share
     * and any touches; whether there are any. Collective.
     */
    bool
    touch_images(const BackgroundGrid<dim> &grid,
                 std::vector<unsigned int> &touched) const;

  private:
    /** The vertex of the first side for each of the second one. */
    static std::map<unsigned int, unsigned int>
    match(const BackgroundGrid<dim> &grid,
          const std::string         &first,
          const std::string         &second,
          const std::string         &parameter);
    /** The same of the vertices of one layer of the grid. */
    static std::map<unsigned int, unsigned int>
    match_in_layer(const BackgroundGrid<dim> &grid,
                   const std::string         &first,
                   const std::string         &second,
                   const std::string         &parameter,
                   const unsigned int         layer);

    std::vector<Image>                                all_images;
    std::map<unsigned int, std::vector<unsigned int>> images_of_root;
    std::map<unsigned int, bool>                      shared; ///< by root
  };
} // namespace isochor

#endif
