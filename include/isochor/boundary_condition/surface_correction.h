/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_surface_correction_h
#define isochor_surface_correction_h

#include <deal.II/lac/full_matrix.h>
#include <deal.II/lac/vector.h>

#include <isochor/boundary_condition/boundary_points.h>
#include <isochor/boundary_condition/surface_conditions.h>

#include <array>
#include <functional>
#include <iosfwd>
#include <vector>

namespace isochor
{
  /**
   * What displacements prescribed on surfaces of the body are corrected by, so
   * that springs which stretch under load bring each surface as a whole to
   * where it is meant to be. The springs of a surface and component a pull to
   * ū + c with a polynomial of second order in the reference place X,
   *   c(X) = Σ_k c_k φ_k(X), φ_0 = 1, φ_k = ξ_k = n_k·(X - X̄)/L_k, k <= dim,
   * n_k the principal axes of the surface and L_k its radii of gyration, and
   * the further φ_k the products ξ_i ξ_j, made orthogonal on the surface, such
   * that Σ_b A_b φ_k (u_b - ū) = 0 for all k: mean place, rotation and stretch
   * are exact, and springs don't yield to the pressure of an incompressible
   * layer that is bonded to the surface, a parabola. The force of the
   * springs by c is the multiplier of an augmented Lagrangian (Hestenes 1969,
   * Powell 1969; Simo & Laursen, Comput. Struct. 42 (1992) 97-116) for such
   * functions alone. Any grid can follow those that are affine; the others are
   * left out where the surface has too few cells, or is nearly an arc, so that
   * nothing locks. What else the gap is, is left to the springs.
   *
   * The coefficients are found when Newton's method has converged, by Broyden's
   * method (1965) on c ↦ gap, which begins with Uzawa's step and remembers what
   * it has learnt over the steps of the run; a step begins with coefficients
   * extrapolated from the last ones.
   */
  template <int dim>
  class SurfaceCorrection
  {
  public:
    /** u_b - ū, component @p a of point @p b (m). */
    using Gap = std::function<double(const unsigned int b, unsigned int a)>;

    /** A step of size @p step_size (s) begins, or begins again. */
    void
    start_step(const double step_size);

    /** Newton's method has converged: correct what is prescribed where the
     * affine part of the gap is more than a small part of @p moved, by
     * component (m). Whether it was; the same on all ranks. Collective. */
    bool
    update(const BoundaryPoints<dim>     &points,
           const SurfaceConditions<dim>  &conditions,
           const Gap                     &gap,
           const std::array<double, dim> &moved,
           const MPI_Comm                 comm);

    /** The step that ends at @p time is over. */
    void
    accept(const double time);

    /** c (m) at the end of the present step or, up to the time of the last one,
     * at its end. */
    double
    value(const unsigned int surface,
          const unsigned int a,
          const Point<dim>  &X,
          const double       time) const;

    void
    save(std::ostream &text) const;
    void
    load(std::istream &text);

  private:
    static constexpr unsigned int n_affine = dim + 1,
                                  n_modes  = (dim + 1) * (dim + 2) / 2;
    /** The values of 1, ξ_k and ξ_i ξ_j, i <= j, or a number for each. */
    using Monomials = std::array<double, n_modes>;

    struct Modes
    {
      double     area = 0;
      Point<dim> centre;
      /** ξ_k is direction_k·(X - centre); none if that is zero. */
      std::array<Tensor<1, dim>, dim> direction;
      /** φ_k as sums of monomials; none if all are zero. */
      std::array<Monomials, n_modes> combination{};

      /** Find them. @p mean_products: of the monomials on the surface, n_modes²
       * of them; @p size_of_cells: there, the mean (m). */
      void
      make_orthogonal(const double *mean_products, const double size_of_cells);
    };

    void
    find_modes(const BoundaryPoints<dim> &points,
               const unsigned int         n_surfaces,
               const MPI_Comm             comm);
    void
    find_axes(const BoundaryPoints<dim> &points, const MPI_Comm comm);
    void
    make_orthogonal(const BoundaryPoints<dim> &points, const MPI_Comm comm);

    static Monomials
    monomials(const Modes &at, const Point<dim> &X);

    Monomials
    shape(const unsigned int surface, const Point<dim> &X) const;

    /** The part of the gap that can be corrected, by coefficients. */
    Vector<double>
    gap_of_modes(const BoundaryPoints<dim>    &points,
                 const SurfaceConditions<dim> &conditions,
                 const Gap                    &gap,
                 const MPI_Comm                comm) const;

    bool
    is_small(const Vector<double>          &gap_of_modes,
             const std::array<double, dim> &moved) const;

    /** The gap doesn't close: leave all but affine functions as they were, or,
     * if they already are, all. Whether there is something left to correct. */
    bool
    give_up();

    void
    learn(const Vector<double> &new_gap);

    std::vector<Modes> modes; ///< by surface
    /** c_k: entry (dim surface + a) n_modes + k; of the present step, the last
     * one and the one before. */
    Vector<double> coefficients, accepted, before;
    /** Of the step after the last one, of that one itself (s; 0: none). */
    double step_size = 0, accepted_size = 0;
    double accepted_time = 0;

    FullMatrix<double> inverse; ///< ∂c/∂gap, by Broyden's method
    /** Of the present step: the last change, and the gap that it was made for.
     */
    Vector<double> change, last_gap;
    double         first_norm = 0; ///< of the gap
    unsigned int   n_updates  = 0;
    /** In the present step other conditions keep the surface from where it is
     * meant to be, or have done so in several steps. */
    bool         given_up        = false;
    bool         only_affine     = false; ///< from now on
    unsigned int n_steps_in_vain = 0;
  };
} // namespace isochor

#endif
