/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_element_sums_h
#define isochor_element_sums_h

#include <deal.II/base/tensor.h>

#include <isochor/material_model/material_model.h>
#include <isochor/material_model/tensor_tools.h>

#include <array>
#include <memory>
#include <vector>

namespace isochor
{
  using namespace dealii;

  namespace internal
  {
    /** s = J θ'(J) of a volumetric measure, and J ds/dJ. */
    struct PressureFactor
    {
      double s, Js_prime;

      PressureFactor(const VolumetricMeasure measure, const double J)
        : s(measure == VolumetricMeasure::jacobian ? J : 1.)
        , Js_prime(measure == VolumetricMeasure::jacobian ? J : 0.)
      {}
    };

    /** The law of the point that a loop has come to, and what it answers for
     * all of its points alike: most neighbours have the same. */
    template <int dim>
    struct LawOfPoints
    {
      using Materials = std::vector<std::unique_ptr<MaterialModel<dim>>>;

      const Materials          &materials;
      const MaterialModel<dim> *material            = nullptr;
      double                    inverse_K           = 0;
      double                    inverse_G           = 0;
      double                    density             = 0;
      VolumetricMeasure         measure             = {};
      bool                      depends_on_pressure = false;
      bool                      evaluates_packs     = false;

      explicit LawOfPoints(const Materials &materials)
        : materials(materials)
      {}

      void
      set(const unsigned int index)
      {
        if (materials[index].get() == material)
          return;
        material            = materials[index].get();
        inverse_K           = material->inverse_bulk_modulus();
        inverse_G           = 1 / material->shear_modulus();
        density             = material->density();
        measure             = material->volumetric_measure();
        depends_on_pressure = material->depends_on_pressure();
        evaluates_packs     = material->evaluates_packs() &&
                          measure == VolumetricMeasure::jacobian &&
                          !depends_on_pressure;
      }
    };

    /** Sums over the points of an element: since P1 gradients are constant in
     * an element, stress and modulus are summed before they meet gradients. */
    template <int dim, std::size_t max_nodes>
    struct ElementSums
    {
      static constexpr unsigned int n =
        SymmetricTensor<2, dim>::n_independent_components;
      /** Those in plane of a symmetric tensor, in deal.II's order. */
      using Components = std::array<double, n>;

      /** The parts of p and of dev τ are apart until complete(). */
      Components                    stress{};  ///< Σ V τ
      ModulusComponents<dim>        modulus{}; ///< Σ V of that of τ
      double                        spherical        = 0; ///< Σ V p s
      double                        spherical_change = 0; ///< Σ V p J ds/dJ
      std::array<double, max_nodes> constraint{};         ///< R_p
      std::array<double, max_nodes> s{};                  ///< Σ V N_I s
      std::array<Components, max_nodes>
        volumetric_tangent{}; ///< Σ V N_I ∂θ^e/∂d
      /** Σ V N_I N_J (1/K - ∂θ^e/∂p), J >= I. */
      std::array<double, max_nodes * max_nodes> compressibility{};

      /** Of Element::start_weight: Σ V s_n (1 - m) (p - p_n) and
       * Σ V N_I s_n, Σ V N_I s. */
      double                        at_start = 0;
      std::array<double, max_nodes> s_at_start{}, s_at_end{};

      /** Σ V N_I ∂(dev τ)/∂p, of laws that depend on p. */
      bool                              pressure_dependent = false;
      std::array<Components, max_nodes> pressure_tangent{};

      /** A point's stress. */
      void
      add_stress(const StressResponse<dim> &response,
                 const double               V,
                 const double               p,
                 const PressureFactor      &factor,
                 const bool                 with_matrix)
      {
        for (unsigned int i = 0; i < n; ++i)
          stress[i] += V * response.deviatoric_stress.access_raw_entry(
                             component_in_3d<dim>(i));
        spherical += V * p * factor.s;
        if (!with_matrix)
          return;
        for (unsigned int i = 0; i < n * n; ++i)
          modulus[i] += V * response.tangent.access_raw_entry(i);
        spherical_change += V * p * factor.Js_prime;
      }

      /** Of κ e (MixedKernel::unseen_stiffness()), which changes with the
       * displacement. @p V_K_s: V κ s. */
      void
      add_bulk_stiffness(const StressResponse<dim> &response,
                         const double               V_K_s)
      {
        for (unsigned int i = 0; i < dim; ++i)
          for (unsigned int j = 0; j < n; ++j)
            modulus[i * n + j] +=
              V_K_s * response.volumetric_tangent.access_raw_entry(j);
      }

      /** A point's share of the pressure equation, with its @p excess
       * e = θ^e - p/K and @p kappa (MixedKernel::unseen_stiffness()). @p N:
       * its shape values. */
      template <typename Shape>
      void
      add_constraint(const StressResponse<dim> &response,
                     const LawOfPoints<dim>    &law,
                     const double               V,
                     const double               excess,
                     const double               kappa,
                     const PressureFactor      &factor,
                     const unsigned int         n_nodes,
                     const Shape               &N,
                     const bool                 with_matrix)
      {
        const bool   depends_on_pressure = law.depends_on_pressure;
        const double compliance =
          law.inverse_K -
          (depends_on_pressure ? response.volumetric_pressure_tangent : 0.);
        const double seen  = 1 - kappa * law.inverse_K;
        pressure_dependent = pressure_dependent || depends_on_pressure;
        for (unsigned int I = 0; I < n_nodes; ++I)
          {
            const double VN = V * seen * N(I);
            constraint[I] += VN * excess;
            if (!with_matrix)
              continue;
            s[I] += V * N(I) * (1 - kappa * compliance) * factor.s;
            for (unsigned int i = 0; i < n; ++i)
              volumetric_tangent[I][i] +=
                VN * response.volumetric_tangent.access_raw_entry(i);
            for (unsigned int J = I; J < n_nodes; ++J)
              compressibility[I * n_nodes + J] += VN * N(J) * compliance;
            if (depends_on_pressure)
              for (unsigned int i = 0; i < n; ++i)
                pressure_tangent[I][i] +=
                  V * N(I) *
                  response.deviatoric_pressure_tangent.access_raw_entry(i);
          }
      }

      /** What pressures that change add at the start of a step. */
      template <typename Shape>
      void
      add_at_start(const double       V_s_n,
                   const double       V_s,
                   const double       pressure_change,
                   const unsigned int n_nodes,
                   const Shape       &N)
      {
        at_start += V_s_n * pressure_change;
        for (unsigned int I = 0; I < n_nodes; ++I)
          {
            s_at_start[I] += V_s_n * N(I);
            s_at_end[I] += V_s * N(I);
          }
      }

      /** Add p's parts to stress and modulus. */
      void
      complete(const bool with_matrix)
      {
        for (unsigned int i = 0; i < dim; ++i)
          stress[i] += spherical;
        if (!with_matrix)
          return;
        for (unsigned int i = 0; i < n; ++i)
          {
            for (unsigned int j = 0; i < dim && j < dim; ++j)
              modulus[i * n + j] += spherical_change;
            // the identity of symmetric tensors halves shears
            modulus[i * n + i] -= (i < dim ? 2 : 1) * spherical;
          }
      }
    };

    /** t g of a symmetric tensor by its components. */
    template <int dim, std::size_t n>
    inline DEAL_II_ALWAYS_INLINE Tensor<1, dim>
    times(const std::array<double, n> &t, const Tensor<1, dim> &g)
    {
      Tensor<1, dim> result;
      for (unsigned int i = 0; i < dim; ++i)
        for (unsigned int j = 0; j < dim; ++j)
          result[i] += t[component_in_plane<dim>(i, j)] * g[j];
      return result;
    }
  } // namespace internal
} // namespace isochor

#endif
