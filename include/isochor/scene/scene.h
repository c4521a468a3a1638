/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_scene_h
#define isochor_scene_h

#include <isochor/adaptation/grid_adaptation.h>
#include <isochor/base/parameter_file.h>
#include <isochor/body_quadrature/body_quadrature.h>
#include <isochor/boundary_condition/boundary_condition.h>
#include <isochor/dynamics/inertia_term.h>
#include <isochor/dynamics/motion_starts.h>
#include <isochor/equations/mixed_kernel.h>
#include <isochor/material_points/body_shape.h>
#include <isochor/nonlinear_solver/load_stepping.h>
#include <isochor/postprocess/postprocessor.h>

#include <memory>
#include <vector>

namespace isochor
{
  template <int dim>
  class BodyPairTerm;
  template <int dim>
  class Interaction;
  template <int dim>
  class InteractionTerm;
  template <int dim>
  struct RigidBodyInScene;
  struct OneSidedWall;

  /** What decides which parameters a scene has. */
  struct SceneSections
  {
    /** In the subsections "Material", "Material 2", ... */
    unsigned int n_materials = 1;
    /** "Boundary conditions: name" and "Postprocess: name". */
    std::vector<NamedSection> boundary_conditions, postprocessors;
    /** "Interaction: body - partner". */
    std::vector<NamedSection> interactions;
    /** "Rigid body: name". */
    std::vector<NamedSection> rigid_bodies;

    SceneSections(const unsigned int n_materials = 1)
      : n_materials(n_materials)
    {}

    /** What the @p statements of a parameter file mention. */
    static SceneSections
    find(const std::vector<ParameterStatement> &statements);
  };

  /**
   * What a parameter file describes: the grid, the body and its materials, the
   * formulation, what acts on the body and what looks at it. How the equations
   * are set up and solved is not part of it, see StepSetup and Equilibrium.
   *
   * From step to step the points, the time and the state of boundary conditions
   * and post-processors change; all else stays as it was read.
   */
  template <int dim>
  class Scene
  {
  public:
    Scene(const MPI_Comm comm);

    static void
    declare_parameters(ParameterHandler &prm, const SceneSections &sections);
    void
    parse_parameters(ParameterHandler &prm);

    /**
     * Make the grid, fill the body with points, and tell boundary conditions
     * and post-processors of both. @p arrays will hold the points of each step.
     * Once. Collective.
     */
    void
    create(const PointArrays<dim> &arrays);

    bool
    mixed() const
    {
      return n_components == dim + 1;
    }

    /** Whether nodes that hardly any material touches should be tied, see
     * DiscreteExtension: few points in a large element leave motions free. */
    bool
    ties_cut_cells() const
    {
      return quadrature->ties_cut_cells() ||
             !grid.shape_functions().are_linear();
    }

    /** Whether each point has a domain, a simplex that it carries along. */
    bool
    points_have_domains() const
    {
      return quadrature->is_linear_on_domains();
    }

    /** Whether the points have velocities. */
    bool
    has_inertia() const
    {
      return inertia.is_active();
    }

    /** What a run of this scene never computes or stores, a list of phrases. */
    std::vector<std::string>
    not_needed() const;

    BackgroundGrid<dim> grid;
    GridAdaptation<dim> adaptation; ///< what an adaptive grid follows
    MaterialPoints<dim> points;
    BodyShape<dim>      shape;
    LoadStepping        time;

    /** How the body is integrated. */
    std::unique_ptr<BodyQuadrature<dim>> quadrature;

    /** The materials, and PPP's coefficient. */
    MixedKernel<dim> kernel;
    /** The names of the laws of its materials. */
    std::vector<std::string> laws;
    /** Unknowns of a node: dim in the u form, dim + 1 in the u-p form. */
    unsigned int n_components = dim + 1;
    /** Whether the matrix is symmetric. */
    bool symmetric = true;
    /** Whether a material may dissipate energy. */
    bool may_yield = false;

    /** Inertia and the scheme in time; without effect in statics. */
    InertiaTerm<dim>  inertia;
    MotionStarts<dim> motion_starts;

    std::vector<std::unique_ptr<BoundaryCondition<dim>>> boundary_conditions;
    std::vector<std::unique_ptr<Postprocessor<dim>>>     postprocessors;

    /** Those of the sections "Rigid body: NAME". */
    std::vector<std::shared_ptr<RigidBodyInScene<dim>>> rigid_bodies;

  private:
    void
    parse_formulation(ParameterHandler &prm);
    void
    parse_materials(ParameterHandler &prm);
    std::unique_ptr<MaterialModel<dim>>
    create_material(const std::string &model) const;
    /** Throw if, in axisymmetry, the grid reaches beyond the axis. */
    void
    check_axis() const;
    /** Throw if @p material, the one of number @p m, can't be used here. */
    void
    check_material(const MaterialModel<dim> &material,
                   const std::string        &model,
                   const unsigned int        m) const;
    void
    parse_plugins(ParameterHandler &prm);
    void
    parse_rigid_bodies(ParameterHandler &prm);
    void
    parse_interactions(ParameterHandler &prm);
    /** Let @p interaction have the rigid body of its partner's name. */
    void
    find_partner(Interaction<dim> &interaction) const;
    using Interactions = std::vector<std::unique_ptr<Interaction<dim>>>;
    /** Make the boundary conditions of what the sections ask for. */
    void
    add_interactions(Interactions                     of_bodies,
                     Interactions                     of_others,
                     Interactions                     loads,
                     const std::vector<OneSidedWall> &walls);

    /** Two of the boundary conditions, if there are such. */
    BodyPairTerm<dim>    *body_pairs           = nullptr;
    InteractionTerm<dim> *surface_interactions = nullptr;
  };
} // namespace isochor

#endif
