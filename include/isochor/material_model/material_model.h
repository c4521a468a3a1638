/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */

#ifndef isochor_material_model_h
#define isochor_material_model_h

#include <deal.II/base/symmetric_tensor.h>
#include <deal.II/base/tensor.h>

#include <isochor/base/plugin_registry.h>
#include <isochor/material_model/point_pack.h>

#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace isochor
{
  /**
   * The deformation of one material point over a step. In plane strain
   * (`dim` = 2) the out-of-plane stretch is 1, so that J = det F holds for
   * both dimensions. In axisymmetry laws are asked in 3D, see
   * AxisymmetricMaterial.
   */
  template <int dim>
  struct Kinematics
  {
    /** ΔF = 1 + ∇_n Δu, from t_n to t_{n+1}; see set_increment(). */
    Tensor<2, dim> F_increment;
    /** (det ΔF)^(-2/3), which makes ΔF b ΔF^T isochoric: a root that all points
     * of an element share. */
    double isochoric_scale = std::numeric_limits<double>::quiet_NaN();
    /** F_{n+1} = ΔF F_n. */
    Tensor<2, dim> F;
    /** det F_{n+1} > 0 (checked by the caller). */
    double J;
    /** The pressure unknown p at the point, in Pa: in u-p for laws that depend
     * on it (MaterialModel::depends_on_pressure()), else empty. */
    std::optional<double> pressure = {};
    /** Whether the tangents of the response are asked for. */
    bool with_tangent = true;
    /** Whether the history at t_{n+1} is asked for: only when a step has
     * converged. */
    bool with_history = true;
    /** r_{n+1} / r_n; only read by AxisymmetricMaterial. */
    double hoop_increment = 1;

    /** Set the first two members. */
    void
    set_increment(const Tensor<2, dim> &increment)
    {
      F_increment     = increment;
      const double dJ = determinant(increment);
      isochoric_scale = 1 / std::cbrt(dJ * dJ);
    }
  };

  /**
   * The measure of volume change whose conjugate is the pressure unknown.
   * With θ(J) the measure and s = J θ'(J), the volumetric part of the Kirchhoff
   * stress is p s 1.
   */
  enum class VolumetricMeasure
  {
    /** θ = J - 1, s = J: p is the mean Cauchy stress. */
    jacobian,
    /** θ = ln J, s = 1: p is the mean Kirchhoff stress. */
    logarithmic
  };

  /**
   * What a material point answers to a deformation. The law is split into a
   * deviatoric stress and an *elastic* volumetric strain θ^e; the mean stress
   * is p = K θ^e. That one split serves both formulations: `u` eliminates
   * p = K θ^e at the point, `u-p` asks for θ^e - p/K = 0 weakly. Stresses are
   * Kirchhoff stresses, tension positive, full 3D tensors also in plane strain.
   *
   * Tangents are with respect to the spatial velocity gradient l = δΔu,x
   * at the end of the step, d = sym l:
   *   δ τ_dev = l τ_dev + τ_dev l^T + tangent : d   (the Lie derivative),
   *   δ θ^e   = volumetric_tangent : d.
   *
   * A law whose strength depends on the mean stress is asked differently in
   * u-p, where the mean stress that balances forces is the pressure unknown p,
   * not K θ^e: it gets p with the deformation and answers dev τ and θ^e at that
   * p (see MaterialModel::depends_on_pressure()). Its tangents are those at
   * fixed p, and the last two members complete them.
   *
   * Without Kinematics::with_tangent a law may leave the tangents as they are,
   * without Kinematics::with_history the history.
   */
  template <int dim>
  struct StressResponse
  {
    /** dev τ = τ - p s 1. Traceless, except where a given p exceeds what the
     * material can bear: there it also takes off what is too much. */
    SymmetricTensor<2, 3> deviatoric_stress;
    /** The in-plane part of the algorithmic modulus of dev τ. It has minor
     * symmetry; major symmetry only if MaterialModel::has_symmetric_tangent().
     */
    SymmetricTensor<4, dim> tangent;
    /** θ^e, for elastic volume change and isochoric flow simply θ(J). */
    double volumetric_strain;
    /** ∂θ^e/∂d; s 1 for elastic volume change and isochoric flow. */
    SymmetricTensor<2, dim> volumetric_tangent;
    /** The in-plane part of ∂(dev τ)/∂p at fixed deformation; 0 unless p was
     * given. */
    SymmetricTensor<2, dim> deviatoric_pressure_tangent;
    /** ∂θ^e/∂p at fixed deformation, in 1/Pa; 0 unless p was given. */
    double volumetric_pressure_tangent = 0;
  };

  /** Whether a point could be evaluated. */
  enum class StressStatus
  {
    success,
    return_map_failed
  };

  template <int dim>
  struct PackKinematics;
  template <int dim>
  struct PackResponse;

  /**
   * Interface of the constitutive laws. To add one, write
   * `source/material_model/<name>.cc` with the class and its registration.
   * Everything declared lives in the subsection "Material".
   */
  template <int dim>
  class MaterialModel
  {
  public:
    virtual ~MaterialModel() = default;

    /** Read the law's parameters and throw (AssertThrow with a message that
     * names the parameter and what is allowed) on values out of range. */
    virtual void
    parse_parameters(ParameterHandler &prm) = 0;

    /**
     * The response to @p kinematics from the history at t_n. A pure function:
     * it writes only @p history (at t_{n+1}) and @p response, so that a
     * rejected iteration has nothing to undo.
     */
    virtual StressStatus
    evaluate(const Kinematics<dim> &kinematics,
             const double          *history_n,
             double                *history,
             StressResponse<dim>   &response) const = 0;

    /** The names of the history variables, one per double stored, in order.
     * Empty for an elastic law. Names are what the output shows. */
    virtual std::vector<std::string>
    history_names() const
    {
      return {};
    }

    /** Fill the history of a virgin point. */
    virtual void
    initialize_history(double * /*history*/) const
    {}

    /**
     * The mean state of several points is formed from sums of their history
     * variables. A variable whose mean would not be a state of the material
     * (a stress outside of the yield surface, say) is replaced by one that may
     * be averaged in to_mean_values(), and from_mean_values() leads back. Both
     * work on one @p history in place.
     */
    virtual void
    to_mean_values(double * /*history*/) const
    {}
    virtual void
    from_mean_values(double * /*history*/) const
    {}

    /** Change @p history so that θ^e is that of @p factor times the volume, and
     * nothing else. A law whose θ^e follows from its history, and not from
     * det F, has to know how (UnseenVolume). */
    virtual void
    scale_elastic_volume(const double /*factor*/, double * /*history*/) const
    {}

    /** The part of the stored elastic energy that goes with dev τ, in J per
     * m^dim of reference volume; p²/(2K) is the other one. For statistics: a
     * law that doesn't tell has `nan` there. */
    virtual double
    deviatoric_energy(const Tensor<2, dim> & /*F*/,
                      const double * /*history*/) const
    {
      return std::numeric_limits<double>::quiet_NaN();
    }

    /** Whether work of the stresses may be neither stored nor given back. */
    virtual bool
    dissipates() const
    {
      return !history_names().empty();
    }

    virtual VolumetricMeasure
    volumetric_measure() const
    {
      return VolumetricMeasure::jacobian;
    }

    /** Whether dev τ or θ^e at a given deformation depend on the pressure
     * unknown of u-p. Only then is Kinematics::pressure set, and only then are
     * the derivatives with respect to it asked for. */
    virtual bool
    depends_on_pressure() const
    {
      return false;
    }

    /** Whether plastic strains are normal to the yield surface. If not, a body
     * may lose its equilibria before it carries all that it could. */
    virtual bool
    is_associated() const
    {
      return true;
    }

    /** Whether the tangents of u and of u-p are symmetric. */
    virtual bool
    has_symmetric_tangent() const
    {
      return true;
    }

    /** Shear modulus G in Pa, the scale of stabilisation and penalties. */
    virtual double
    shear_modulus() const = 0;

    /** 1/K in 1/Pa; 0 for an incompressible material. */
    virtual double
    inverse_bulk_modulus() const = 0;

    /** Reference density in kg/m^3. */
    virtual double
    density() const = 0;

    /** What in the parameters is possible but hardly meant, such as numbers in
     * other units: a sentence for a warning, or nothing. */
    virtual std::string
    doubts() const
    {
      return "";
    }

    /** The strength, for the line that lists a material when a run starts:
     * "yield stress = 1e+06 Pa". Nothing of laws without one. */
    virtual std::string
    describe_strength() const
    {
      return "";
    }

    /** Whether evaluate_pack() can be used: an offer of laws with elastic
     * volume change, θ^e = J - 1, that do not depend on the pressure. It makes
     * assembly faster and is not another law. */
    virtual bool
    evaluates_packs() const
    {
      return false;
    }

    /** dev τ and its modulus, as evaluate() would give them, at the points of
     * a pack. @p history_n has the history of each. */
    virtual StressStatus
    evaluate_pack(
      const PackKinematics<dim> & /*kinematics*/,
      const std::array<const double *, PointPack::size> & /*history_n*/,
      PackResponse<dim> & /*response*/) const
    {
      return StressStatus::return_map_failed;
    }
  };

  /** Components of a symmetric 3D tensor that deformations of dimension @p dim
   * can make nonzero: xx, yy, zz, xy (dim = 2) and xz, yz (dim = 3). */
  template <int dim>
  constexpr unsigned int n_symmetric_components = (dim == 2 ? 4 : 6);

  /** E, ν and ρ: what every isotropic law reads. Declared once, shared. */
  struct IsotropicElasticity
  {
    double shear_modulus        = 0; ///< G = E / (2 (1 + ν)), Pa
    double inverse_bulk_modulus = 0; ///< 1/K = 3 (1 - 2ν) / E, 1/Pa
    double density              = 0; ///< ρ_0, kg/m^3

    static void
    declare_parameters(ParameterHandler &prm);

    /** Throws unless E > 0, -1 < ν <= 0.5, ρ >= 0. */
    void
    parse_parameters(ParameterHandler &prm);
  };

  /** For MaterialModel::doubts(): a @p strength (Pa), the value of
   * @p parameter, that no strain of less than one reaches. */
  std::string
  doubtful_strength(const std::string         &parameter,
                    const double               strength,
                    const IsotropicElasticity &elasticity);

} // namespace isochor

#endif
