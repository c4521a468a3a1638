/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <isochor/material_model/axisymmetric_material.h>
#include <isochor/material_model/tensor_tools.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace isochor
{
  namespace
  {
    /** @p t with t_33 = @p out_of_plane. */
    Tensor<2, 3>
    extended(const Tensor<2, 2> &t, const double out_of_plane)
    {
      Tensor<2, 3> result;
      for (unsigned int i = 0; i < 2; ++i)
        for (unsigned int j = 0; j < 2; ++j)
          result[i][j] = t[i][j];
      result[2][2] = out_of_plane;
      return result;
    }
  } // namespace



  AxisymmetricMaterial::AxisymmetricMaterial(
    std::unique_ptr<MaterialModel<3>> law)
    : law(std::move(law))
  {}



  void
  AxisymmetricMaterial::parse_parameters(ParameterHandler &prm)
  {
    law->parse_parameters(prm);
  }



  StressStatus
  AxisymmetricMaterial::evaluate(const Kinematics<2> &kinematics,
                                 const double        *history_n,
                                 double              *history,
                                 StressResponse<3>   &response) const
  {
    history[0] = kinematics.hoop_increment * history_n[0];
    Kinematics<3> in_space;
    in_space.set_increment(
      extended(kinematics.F_increment, kinematics.hoop_increment));
    in_space.F            = extended(kinematics.F, history[0]);
    in_space.J            = kinematics.J;
    in_space.pressure     = kinematics.pressure;
    in_space.with_tangent = kinematics.with_tangent;
    in_space.with_history = kinematics.with_history;
    return law->evaluate(in_space,
                         history_n + n_own,
                         history + n_own,
                         response);
  }



  StressStatus
  AxisymmetricMaterial::evaluate(const Kinematics<2> &kinematics,
                                 const double        *history_n,
                                 double              *history,
                                 StressResponse<2>   &response) const
  {
    StressResponse<3>  in_space;
    const StressStatus status =
      evaluate(kinematics, history_n, history, in_space);
    response.deviatoric_stress           = in_space.deviatoric_stress;
    response.volumetric_strain           = in_space.volumetric_strain;
    response.volumetric_pressure_tangent = in_space.volumetric_pressure_tangent;
    if (!kinematics.with_tangent)
      return status;
    response.volumetric_tangent = in_plane<2>(in_space.volumetric_tangent);
    response.deviatoric_pressure_tangent =
      in_plane<2>(in_space.deviatoric_pressure_tangent);
    for (unsigned int i = 0; i < 2; ++i)
      for (unsigned int j = i; j < 2; ++j)
        for (unsigned int k = 0; k < 2; ++k)
          for (unsigned int l = k; l < 2; ++l)
            response.tangent[i][j][k][l] = in_space.tangent[i][j][k][l];
    return status;
  }



  std::vector<std::string>
  AxisymmetricMaterial::history_names() const
  {
    std::vector<std::string> names = {"hoop_stretch"};
    for (const std::string &name : law->history_names())
      names.push_back(name);
    return names;
  }



  void
  AxisymmetricMaterial::initialize_history(double *history) const
  {
    history[0] = 1.;
    law->initialize_history(history + n_own);
  }



  void
  AxisymmetricMaterial::to_mean_values(double *history) const
  {
    law->to_mean_values(history + n_own);
  }



  void
  AxisymmetricMaterial::from_mean_values(double *history) const
  {
    law->from_mean_values(history + n_own);
  }



  void
  AxisymmetricMaterial::scale_elastic_volume(const double factor,
                                             double      *history) const
  {
    law->scale_elastic_volume(factor, history + n_own);
  }



  double
  AxisymmetricMaterial::deviatoric_energy(const Tensor<2, 2> &F,
                                          const double       *history) const
  {
    return law->deviatoric_energy(extended(F, history[0]), history + n_own);
  }



  bool
  AxisymmetricMaterial::dissipates() const
  {
    return law->dissipates();
  }



  VolumetricMeasure
  AxisymmetricMaterial::volumetric_measure() const
  {
    return law->volumetric_measure();
  }



  bool
  AxisymmetricMaterial::depends_on_pressure() const
  {
    return law->depends_on_pressure();
  }



  bool
  AxisymmetricMaterial::is_associated() const
  {
    return law->is_associated();
  }



  bool
  AxisymmetricMaterial::has_symmetric_tangent() const
  {
    return law->has_symmetric_tangent();
  }



  double
  AxisymmetricMaterial::shear_modulus() const
  {
    return law->shear_modulus();
  }



  double
  AxisymmetricMaterial::inverse_bulk_modulus() const
  {
    return law->inverse_bulk_modulus();
  }



  double
  AxisymmetricMaterial::density() const
  {
    return law->density();
  }



  std::string
  AxisymmetricMaterial::doubts() const
  {
    return law->doubts();
  }



  std::string
  AxisymmetricMaterial::describe_strength() const
  {
    return law->describe_strength();
  }
} // namespace isochor
