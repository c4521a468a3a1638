/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */

#ifndef isochor_tests_material_test_tools_h
#define isochor_tests_material_test_tools_h

// What the tests of the constitutive laws share.

#include <deal.II/base/parameter_handler.h>

#include <isochor/material_model/material_model.h>

#include <iomanip>
#include <iostream>
#include <memory>
#include <optional>
#include <random>
#include <sstream>
#include <string>
#include <vector>

namespace isochor
{
  namespace test
  {
    /** The material @p name with the lines of @p settings, as they would stand
     * in the subsection "Material" of a parameter file. */
    template <int dim>
    std::unique_ptr<MaterialModel<dim>>
    make_material(const std::string &name, const std::string &settings = "")
    {
      ParameterHandler prm;
      PluginRegistry<MaterialModel<dim>>::declare_parameters(prm);
      prm.parse_input_from_string(settings);
      auto material = PluginRegistry<MaterialModel<dim>>::create(name);
      material->parse_parameters(prm);
      return material;
    }

    /** Print "what: OK", or what went wrong. */
    inline void
    report(const std::string &what, const bool ok, const std::string &details)
    {
      std::cout << what << ": " << (ok ? "OK" : "FAILED, " + details)
                << std::endl;
    }

    /** Keeps the largest of many errors and where it occurred. */
    struct WorstError
    {
      double      value = 0;
      std::string where;

      void
      add(const double error, const std::string &label)
      {
        // Not-a-number counts as infinitely wrong.
        if (!(error <= value))
          {
            value = (error == error ? error : 1e300);
            where = label;
          }
      }

      void
      report(const std::string &what, const double tolerance) const
      {
        std::ostringstream details;
        details << std::setprecision(3) << "error " << value << " > "
                << tolerance << " at " << where;
        test::report(what, value <= tolerance, details.str());
      }
    };

    /** A material and the state of one of its points. */
    template <int dim>
    struct Point
    {
      const MaterialModel<dim> &material;
      Tensor<2, dim>            F;
      std::vector<double>       history_n, history;
      StressResponse<dim>       response;
      StressStatus              status;
      std::optional<double>     pressure; ///< of u-p, given to the law
      double                    hoop_increment = 1; ///< in axisymmetry

      explicit Point(const MaterialModel<dim> &m)
        : material(m)
        , F(unit_symmetric_tensor<dim>())
        , history_n(m.history_names().size() + 1)
        , history(history_n)
      {
        material.initialize_history(history_n.data());
      }

      /** The response to @p F_increment, the state at t_n kept. */
      const StressResponse<dim> &
      evaluate(const Tensor<2, dim> &F_increment)
      {
        Kinematics<dim> kinematics;
        kinematics.set_increment(F_increment);
        kinematics.F              = F_increment * F;
        kinematics.J              = determinant(kinematics.F);
        kinematics.pressure       = pressure;
        kinematics.hoop_increment = hoop_increment;
        status                    = material.evaluate(kinematics,
                                   history_n.data(),
                                   history.data(),
                                   response);
        return response;
      }

      /** Move to t_{n+1}, the state of the last evaluate(). */
      void
      commit(const Tensor<2, dim> &F_increment)
      {
        F         = F_increment * F;
        history_n = history;
      }
    };

    /** τ = dev τ + K θ^e s 1 of the formulation u; K finite. */
    template <int dim>
    SymmetricTensor<2, 3>
    kirchhoff_stress(const MaterialModel<dim>  &material,
                     const StressResponse<dim> &response,
                     const double               J)
    {
      const double s =
        (material.volumetric_measure() == VolumetricMeasure::jacobian ? J : 1.);
      return response.deviatoric_stress + (s * response.volumetric_strain /
                                           material.inverse_bulk_modulus()) *
                                            unit_symmetric_tensor<3>();
    }

    /** Uniform random numbers in [-1, 1] by a fixed recipe: those of the
     * standard library's distributions differ between implementations. */
    class Random
    {
    public:
      double
      operator()()
      {
        return 2. * (generator() >> 11) / 9007199254740992. - 1;
      }

      /** A gradient with entries in [-amplitude, amplitude]. */
      template <int dim>
      Tensor<2, dim>
      gradient(const double amplitude)
      {
        Tensor<2, dim> g;
        for (unsigned int i = 0; i < dim; ++i)
          for (unsigned int j = 0; j < dim; ++j)
            g[i][j] = amplitude * (*this)();
        return g;
      }

      /** A rotation: Gram-Schmidt on a random tensor. */
      template <int dim>
      Tensor<2, dim>
      rotation()
      {
        Tensor<2, dim> Q = gradient<dim>(1);
        for (unsigned int i = 0; i < dim; ++i)
          {
            for (unsigned int j = 0; j < i; ++j)
              Q[i] -= (Q[i] * Q[j]) * Q[j];
            Q[i] /= Q[i].norm();
          }
        if (determinant(Q) < 0)
          Q[0] *= -1;
        return Q;
      }

    private:
      std::mt19937_64 generator{20190613};
    };

    /** @p Q as a rotation of space, about z in two dimensions. */
    template <int dim>
    Tensor<2, 3>
    in_space(const Tensor<2, dim> &Q)
    {
      Tensor<2, 3> result;
      result[2][2] = 1;
      for (unsigned int i = 0; i < dim; ++i)
        for (unsigned int j = 0; j < dim; ++j)
          result[i][j] = Q[i][j];
      return result;
    }
  } // namespace test
} // namespace isochor

#endif
