/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <isochor/base/plugin_registry.h>
#include <isochor/rigid_body/faceted_surface.h>

#include <memory>

namespace isochor
{
  /** What a closed surface from a file encloses. */
  template <int dim>
  class RigidMesh : public RigidShape<dim>
  {
  public:
    static void
    declare_parameters(ParameterHandler &prm)
    {
      prm.declare_entry("File",
                        "",
                        Patterns::FileName(),
                        std::string("The file of a mesh: a gmsh .msh file "
                                    "(text) with ") +
                          (dim == 2 ?
                             "lines or triangles." :
                             "triangles or tetrahedra, or an STL file (text "
                             "or binary).") +
                          " The surface must be closed.");
      prm.declare_entry("Scale",
                        "1",
                        Patterns::Double(0),
                        "What the coordinates in the file of a mesh are "
                        "multiplied by to be in m: 0.001 for mm.");
    }

    void
    parse_parameters(ParameterHandler &prm) override
    {
      const std::string name = prm.get("File"), path = this->parameter("File");
      auto              mesh  = read_surface_mesh<dim>(name, path);
      const double      scale = this->get_positive(prm, "Scale");
      for (Point<dim> &vertex : mesh.vertices)
        vertex *= scale;
      outline = std::make_unique<FacetedSurface<dim>>(std::move(mesh),
                                                      "The mesh file <" + name +
                                                        "> of the parameter <" +
                                                        path + "> ");
    }

    ClosestPoint<dim>
    closest(const Point<dim> &x) const override
    {
      return outline->closest(x);
    }

    std::vector<typename RigidShape<dim>::Facet>
    surface(const double /*reach*/) const override
    {
      return outline->facets();
    }

    BoundingBox<dim>
    box() const override
    {
      return outline->box();
    }

  private:
    std::unique_ptr<FacetedSurface<dim>> outline;
  };

  ISOCHOR_REGISTER_FOR_DIMENSION(RigidShape, RigidMesh, "mesh")
} // namespace isochor
