/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_ghost_penalty_h
#define isochor_ghost_penalty_h

#include <deal.II/base/parameter_handler.h>

#include <isochor/cell_occupancy.h>
#include <isochor/equation_term.h>

namespace isochor
{
  /**
   * Ghost penalty on the faces of cut cells (Burman, Comptes Rendus
   * Mathematique 348 (2010) 1217-1220), so that nodes which hardly any material
   * touches are held by their neighbours, however small the cut is:
   *
   *   R_u += γ Σ_F G h_F |F| [[∂_n Δu]] [[∂_n w]],
   *   R_p -= γ_p Σ_F 1/G h_F³ |F| [[∂_n p]] [[∂_n q]],
   *
   * h_F = |F|^{1/(d-1)}. It penalises the increments of the step, not the
   * deformation. Faces are those between cells all of whose nodes are active,
   * with or without points, of which at least one is cut; see
   * CellOccupancy::is_cut(). One element per face, with d + 2 nodes. On a grid
   * that is kept (see GridReset) faces and gradients stay those of the reset.
   */
  template <int dim>
  class GhostPenalty : public EquationTerm<dim>
  {
  public:
    GhostPenalty(const BackgroundGrid<dim> &grid,
                 const CellOccupancy<dim>  &occupancy);

    static void
    declare_parameters(ParameterHandler &prm);
    void
    parse_parameters(ParameterHandler &prm);

    /** Whether there is a penalty, with the plain quadrature or another. */
    bool
    is_active(const bool plain_quadrature) const;

    /** Find the faces. @p occupancy is that of the step. */
    void
    touch_vertices(std::vector<unsigned int> &vertices) override;

    void
    collect_elements(const StepContext<dim> &step,
                     ElementNodes           &elements) override;

    EvaluationStatus
    assemble(const StepContext<dim> &step,
             const NodalField       &unknowns,
             const NodalField       &pending,
             const unsigned int      first_element,
             const bool              with_matrix,
             MixedSystem<dim>       &system) override;

    /** The faces found last. */
    template <class Archive>
    void
    serialize(Archive &archive, const unsigned int /*version*/)
    {
      archive &faces;
    }

  private:
    static constexpr unsigned int n_nodes = dim + 2;

    struct Face
    {
      std::array<unsigned int, n_nodes> vertices;
      /** [[∂_n N_I]] (1/m). */
      std::array<double, n_nodes> jump;
      double                      h, area;
      double shear_modulus; ///< of the cells; 0 if both are empty

      template <class Archive>
      void
      serialize(Archive &archive, const unsigned int /*version*/)
      {
        archive &vertices &jump &h &area &shear_modulus;
      }
    };

    Face
    make_face(const unsigned int cell, const unsigned int opposite) const;
    double
    shear_modulus_in(const unsigned int cell) const;

    enum class Use
    {
      automatic,
      always,
      never
    } use                           = Use::automatic;
    double displacement_coefficient = 1, pressure_coefficient = 0.1;

    const BackgroundGrid<dim> &grid;
    const CellOccupancy<dim>  &occupancy;
    std::vector<Face>          faces;
  };
} // namespace isochor

#endif
