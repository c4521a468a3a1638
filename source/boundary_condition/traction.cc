/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <isochor/boundary_condition.h>
#include <isochor/expression.h>
#include <isochor/scene_checks.h>

namespace isochor
{
  /**
   * Dead load per area on boundaries of the grid. It acts on the faces of cells
   * that hold material. With M the P1 mass matrix of the face, the nodal forces
   * are f_I = Σ_J M_IJ t(x_J), exact for tractions linear on a face.
   */
  template <int dim>
  class Traction : public BoundaryCondition<dim>
  {
  public:
    static void
    declare_parameters(ParameterHandler &prm)
    {
      prm.declare_entry(
        "Traction",
        "",
        Patterns::Anything(),
        "Dead loads (Pa) on boundaries of the grid, formulas in x, y(, z), t: "
        "'boundary: t_x, t_y(, t_z); boundary: ...'.");
    }

    void
    parse_parameters(ParameterHandler &prm) override
    {
      const std::string name = "Boundary conditions/Traction";
      for (const auto &entry : split_named_list(prm.get("Traction"), name))
        {
          Load load{entry.first, 0, {}};
          for (const auto &item : split_formulas(entry.second, name))
            load.traction.emplace_back(item, name);
          AssertThrow(load.traction.size() == dim,
                      ExcMessage("The parameter <" + name + "> needs " +
                                 std::to_string(dim) + " components on <" +
                                 entry.first + ">."));
          loads.push_back(load);
        }
    }

    void
    initialize(const BackgroundGrid<dim> &grid) override
    {
      for (Load &load : loads)
        load.id =
          grid.boundary_id(load.boundary, "Boundary conditions/Traction");
    }

    void
    check_scene(const StepContext<dim> &step) const override
    {
      for (const Load &load : loads)
        warn_if_untouched(step,
                          "Boundary conditions/Traction",
                          load.boundary,
                          load.id,
                          Contact::occupied_face);
    }

    void
    add_external_force(const StepContext<dim> &step,
                       NodalField             &force) const override
    {
      if (loads.empty())
        return;
      const SimplexGeometry<dim> &geometry = step.grid.geometry();
      for (const BoundaryFace &face : step.grid.boundary_faces())
        for (const Load &load : loads)
          if (face.id == load.id && step.points.contains_cell(face.cell))
            {
              AssertThrow(has_active_nodes(step, face),
                          ExcMessage(
                            "The load of <Boundary conditions/Traction> on <" +
                            load.boundary +
                            "> meets a cell that the material touches only in "
                            "part. Use <Boundary conditions/Traction on body>, "
                            "or another <Quadrature/Type> than CPDI."));
              add_face(step, geometry, face, load, force);
            }
    }

  private:
    struct Load
    {
      std::string                  boundary;
      types::boundary_id           id;
      std::vector<Expression<dim>> traction;
    };

    /** A domain of CPDI may miss nodes of the cell that holds its point. */
    static bool
    has_active_nodes(const StepContext<dim> &step, const BoundaryFace &face)
    {
      const auto &vertices = step.grid.geometry().vertex_indices(face.cell);
      for (unsigned int v = 0; v <= dim; ++v)
        if (v != face.opposite_vertex &&
            step.nodes.node(vertices[v]) == numbers::invalid_unsigned_int)
          return false;
      return true;
    }

    static void
    add_face(const StepContext<dim>     &step,
             const SimplexGeometry<dim> &geometry,
             const BoundaryFace         &face,
             const Load                 &load,
             NodalField                 &force)
    {
      // |face| = dim |cell| / height, height = 1 / |∇λ_opposite|
      const double area =
        dim * geometry.measure(face.cell) *
        geometry.gradients(face.cell)[face.opposite_vertex].norm();
      const auto &vertices = geometry.vertex_indices(face.cell);
      for (unsigned int J = 0; J <= dim; ++J)
        for (unsigned int a = 0; a < dim && J != face.opposite_vertex; ++a)
          {
            const double t =
              load.traction[a](geometry.vertices()[vertices[J]], step.time);
            for (unsigned int I = 0; I <= dim; ++I)
              if (I != face.opposite_vertex)
                force.local_element(
                  step.nodes.node(vertices[I]) * step.n_components + a) +=
                  area * (I == J ? 2. : 1.) / (dim * (dim + 1)) * t;
          }
    }

    std::vector<Load> loads;
  };

  ISOCHOR_REGISTER_FOR_DIMENSION(BoundaryCondition, Traction, "Traction")
} // namespace isochor
