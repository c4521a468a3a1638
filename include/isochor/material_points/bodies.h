/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_bodies_h
#define isochor_bodies_h

#include <deal.II/base/parameter_handler.h>

#include <isochor/material_points/body_seeding.h>

#include <memory>
#include <string>
#include <vector>

namespace isochor
{
  using namespace dealii;

  /**
   * The bodies of a scene. Each has displacements and pressures of its own, in
   * the layer of the grid (BackgroundGrid::set_layers()) that has its number.
   * Which body a point belongs to is decided at t = 0 and never changes. Reads
   * <Material points/Bodies>.
   */
  template <int dim>
  class Bodies
  {
  public:
    Bodies();
    ~Bodies();

    static void
    declare_parameters(ParameterHandler &prm);
    void
    parse_parameters(ParameterHandler &prm);

    /** What meets at places that are one of these apart (m) at t = 0 is one
     * body. */
    void
    set_periods(const std::vector<Tensor<1, dim>> &periods)
    {
      this->periods = periods;
    }

    /**
     * Divide @p seeds, with their zones, into bodies. Returns the body of each
     * seed, empty if there is one only.
     * @throws ExcMessage if the parameter names a body without points, or
     * bodies that meet across periodic sides.
     */
    std::vector<unsigned int>
    divide(const std::vector<Seed<dim>> &seeds);

    /** Whether the parameter names bodies. */
    bool
    are_named() const;

    /** Where the bodies are that the parameter names; the last that holds
     * counts. */
    std::vector<std::string>
    zones() const;

    /** The names, by number; one or more, all different. */
    const std::vector<std::string> &
    names() const
    {
      return all_names;
    }

    unsigned int
    size() const
    {
      return all_names.size();
    }

    /** The body at the place @p x at t = 0: the one whose point has a domain
     * around it, or else the one with the nearest point. */
    unsigned int
    at(const Point<dim> &x) const;

  private:
    /** Numbers of seeds by where they are. */
    struct SearchTree;

    /** By seed: the name of its zone in the parameter, `body` outside of
     * all. */
    std::vector<std::string>
    names_by_zones(const std::vector<Seed<dim>> &seeds) const;
    /** By seed: "body 1", "body 2", ... by connected part and material. */
    std::vector<std::string>
    names_by_parts(const std::vector<Seed<dim>> &seeds) const;

    std::string                 parameter;
    std::vector<Tensor<1, dim>> periods;
    std::vector<std::string>    all_names = {"body"};
    std::unique_ptr<SearchTree> tree; ///< null if there is one body
  };
} // namespace isochor

#endif
