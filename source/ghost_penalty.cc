/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <deal.II/base/mpi.h>

#include <isochor/ghost_penalty.h>

#include <algorithm>
#include <cmath>

namespace isochor
{
  template <int dim>
  GhostPenalty<dim>::GhostPenalty(const BackgroundGrid<dim> &grid,
                                  const CellOccupancy<dim>  &occupancy)
    : grid(grid)
    , occupancy(occupancy)
  {}



  template <int dim>
  void
  GhostPenalty<dim>::declare_parameters(ParameterHandler &prm)
  {
    prm.enter_subsection("Ghost penalty");
    prm.declare_entry("Use",
                      "auto",
                      Patterns::Selection("auto|always|never"),
                      "Whether the faces of cells that the body cuts get a "
                      "penalty, which bounds the condition number however "
                      "small the cuts are. auto: with every 'Quadrature/Type' "
                      "but 'points'.");
    prm.declare_entry("Displacement coefficient",
                      "1",
                      Patterns::Double(0),
                      "The factor gamma of G h |F| [[grad u n]]^2 / 2.");
    prm.declare_entry("Pressure coefficient",
                      "0.1",
                      Patterns::Double(0),
                      "The factor gamma_p of h^3 |F| / G [[grad p n]]^2 / 2; "
                      "useful are 0.1 to 1.");
    prm.leave_subsection();
  }



  template <int dim>
  void
  GhostPenalty<dim>::parse_parameters(ParameterHandler &prm)
  {
    prm.enter_subsection("Ghost penalty");
    const std::string name   = prm.get("Use");
    displacement_coefficient = prm.get_double("Displacement coefficient");
    pressure_coefficient     = prm.get_double("Pressure coefficient");
    prm.leave_subsection();
    use = name == "auto"   ? Use::automatic :
          name == "always" ? Use::always :
                             Use::never;
  }



  template <int dim>
  bool
  GhostPenalty<dim>::is_active(const bool plain_quadrature) const
  {
    return use == Use::always || (use == Use::automatic && !plain_quadrature);
  }



  template <int dim>
  void
  GhostPenalty<dim>::touch_vertices(std::vector<unsigned int> &vertices)
  {
    constexpr unsigned int      none     = SimplexGeometry<dim>::no_cell;
    const SimplexGeometry<dim> &geometry = grid.geometry();
    const unsigned int          rank =
      Utilities::MPI::this_mpi_process(grid.communicator());

    // a cut cell has a vertex at an empty cell or at an open boundary
    std::vector<unsigned int> cut;
    for (const unsigned int v : occupancy.active_vertices())
      if (occupancy.is_at_empty_cell(v) || occupancy.is_at_open_boundary(v))
        for (const unsigned int cell : occupancy.cells_at(v))
          if (occupancy.is_closed(cell) && occupancy.is_cut(cell))
            cut.push_back(cell);
    std::sort(cut.begin(), cut.end());
    cut.erase(std::unique(cut.begin(), cut.end()), cut.end());

    // the lower of its two cells owns a face
    std::vector<std::pair<unsigned int, unsigned int>> pairs;
    for (const unsigned int cell : cut)
      for (const unsigned int other : geometry.neighbours(cell))
        if (other != none && occupancy.is_closed(other) &&
            geometry.owner(std::min(cell, other)) == rank)
          pairs.emplace_back(std::min(cell, other), std::max(cell, other));
    std::sort(pairs.begin(), pairs.end());
    pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());

    faces.clear();
    for (const auto &pair : pairs)
      {
        const auto &neighbours = geometry.neighbours(pair.first);
        faces.push_back(make_face(
          pair.first,
          std::find(neighbours.begin(), neighbours.end(), pair.second) -
            neighbours.begin()));
        vertices.insert(vertices.end(),
                        faces.back().vertices.begin(),
                        faces.back().vertices.end());
      }
  }



  template <int dim>
  typename GhostPenalty<dim>::Face
  GhostPenalty<dim>::make_face(const unsigned int cell,
                               const unsigned int opposite) const
  {
    const SimplexGeometry<dim> &geometry  = grid.geometry();
    const unsigned int          other     = geometry.neighbours(cell)[opposite];
    const auto                 &gradients = geometry.gradients(cell);
    const double                slope     = gradients[opposite].norm();
    const Tensor<1, dim>        normal    = -gradients[opposite] / slope;

    Face face;
    face.area = dim * geometry.measure(cell) * slope;
    face.h    = dim == 2 ? face.area : std::sqrt(face.area);
    face.shear_modulus =
      std::max(shear_modulus_in(cell), shear_modulus_in(other));
    for (unsigned int I = 0; I <= dim; ++I)
      {
        face.vertices[I] = geometry.vertex_indices(cell)[I];
        face.jump[I]     = gradients[I] * normal;
      }
    for (unsigned int J = 0; J <= dim; ++J)
      {
        const unsigned int vertex = geometry.vertex_indices(other)[J];
        const unsigned int I      = std::find(face.vertices.begin(),
                                         face.vertices.begin() + dim + 1,
                                         vertex) -
                               face.vertices.begin();
        const double slope_beyond = geometry.gradients(other)[J] * normal;
        if (I <= dim)
          face.jump[I] -= slope_beyond;
        else
          {
            face.vertices[dim + 1] = vertex;
            face.jump[dim + 1]     = -slope_beyond;
          }
      }
    return face;
  }



  template <int dim>
  double
  GhostPenalty<dim>::shear_modulus_in(const unsigned int cell) const
  {
    const auto *const content = occupancy.content(cell);
    return content != nullptr && content->reference_volume > 0 ?
             content->volume_times_G / content->reference_volume :
             0.;
  }



  template <int dim>
  void
  GhostPenalty<dim>::collect_elements(const StepContext<dim> &step,
                                      ElementNodes           &elements)
  {
    for (Face &face : faces)
      {
        if (face.shear_modulus == 0)
          face.shear_modulus = step.kernel.materials[0]->shear_modulus();
        std::array<unsigned int, n_nodes> nodes;
        for (unsigned int I = 0; I < n_nodes; ++I)
          nodes[I] = step.nodes.node(face.vertices[I]);
        elements.add(nodes.begin(), nodes.end());
      }
  }



  template <int dim>
  EvaluationStatus
  GhostPenalty<dim>::assemble(const StepContext<dim> &step,
                              const NodalField       &unknowns,
                              const NodalField       &pending,
                              const unsigned int      first_element,
                              const bool              with_matrix,
                              MixedSystem<dim>       &system)
  {
    const unsigned int                     n_components = step.n_components;
    const unsigned int                     n_dofs = n_nodes * n_components;
    std::array<double, n_nodes *(dim + 1)> residual;
    std::array<double, n_nodes *(dim + 1) * n_nodes *(dim + 1)> matrix;
    for (unsigned int f = 0; f < faces.size(); ++f)
      {
        const Face  &face  = faces[f];
        const double G     = face.shear_modulus;
        const double stiff = displacement_coefficient * G * face.h * face.area;
        const double soft =
          -pressure_coefficient / G * face.h * face.h * face.h * face.area;
        matrix.fill(0.);
        for (unsigned int a = 0; a < n_components; ++a)
          {
            const double factor = (a < dim ? stiff : soft);
            double       jump   = 0;
            for (unsigned int I = 0; I < n_nodes; ++I)
              jump += face.jump[I] *
                      unknowns.local_element(
                        step.nodes.node(face.vertices[I]) * n_components + a);
            for (unsigned int I = 0; I < n_nodes; ++I)
              {
                const unsigned int row = I * n_components + a;
                residual[row]          = factor * face.jump[I] * jump;
                for (unsigned int J = 0; with_matrix && J < n_nodes; ++J)
                  matrix[row * n_dofs + J * n_components + a] =
                    factor * face.jump[I] * face.jump[J];
              }
          }
        system.add_element(first_element + f,
                           residual.data(),
                           with_matrix ? matrix.data() : nullptr,
                           pending);
      }
    return EvaluationStatus::success;
  }



  template class GhostPenalty<2>;
  template class GhostPenalty<3>;
} // namespace isochor
