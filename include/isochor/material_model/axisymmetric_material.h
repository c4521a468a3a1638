/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_axisymmetric_material_h
#define isochor_axisymmetric_material_h

#include <isochor/material_model/material_model.h>

#include <memory>

namespace isochor
{
  /**
   * A law in a body of revolution whose section is the plane: x = r is the
   * distance from the axis, y = z the place along it, and the third direction
   * is θ. The law itself is asked in 3D, with
   *   F = F_plane + F_θθ e_θ ⊗ e_θ,   F_θθ = r / R,
   * so that every law can be used without knowing of it.
   *
   * F_θθ is the first of the history variables. F_θθ = r/R holds to rounding,
   * since r changes by the increment that Kinematics::hoop_increment is made
   * of.
   */
  class AxisymmetricMaterial : public MaterialModel<2>
  {
  public:
    explicit AxisymmetricMaterial(std::unique_ptr<MaterialModel<3>> law);

    void
    parse_parameters(ParameterHandler &prm) override;

    /** The response in 3D. */
    StressStatus
    evaluate(const Kinematics<2> &kinematics,
             const double        *history_n,
             double              *history,
             StressResponse<3>   &response) const;

    /** Its part in the plane; all of the stress. */
    StressStatus
    evaluate(const Kinematics<2> &kinematics,
             const double        *history_n,
             double              *history,
             StressResponse<2>   &response) const override;

    std::vector<std::string>
    history_names() const override;
    void
    initialize_history(double *history) const override;
    void
    to_mean_values(double *history) const override;
    void
    from_mean_values(double *history) const override;
    void
    scale_elastic_volume(const double factor, double *history) const override;
    double
    deviatoric_energy(const Tensor<2, 2> &F,
                      const double       *history) const override;
    bool
    dissipates() const override;
    VolumetricMeasure
    volumetric_measure() const override;
    bool
    depends_on_pressure() const override;
    bool
    is_associated() const override;
    bool
    has_symmetric_tangent() const override;
    double
    shear_modulus() const override;
    double
    inverse_bulk_modulus() const override;
    double
    density() const override;
    std::string
    doubts() const override;
    std::string
    describe_strength() const override;

  private:
    std::unique_ptr<MaterialModel<3>> law;
    /** History variables in front of those of the law. */
    static constexpr unsigned int n_own = 1;
  };
} // namespace isochor

#endif
