/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_pack_sums_h
#define isochor_pack_sums_h

#include <isochor/equations/element_sums.h>
#include <isochor/equations/mixed_kernel.h>
#include <isochor/material_model/pack_response.h>
#include <isochor/material_points/point_arrays.h>

namespace isochor
{
  namespace internal
  {
    /**
     * What ElementSums sums over the points of an element whose law evaluates
     * packs, two points at a time. As their change of volume is elastic, s = J
     * and ∂θ^e/∂d = J 1.
     */
    template <int dim, std::size_t max_nodes>
    class PackSums
    {
    public:
      /** @p kinematics: the increment of the element. */
      PackSums(const Kinematics<dim> &kinematics)
      {
        for (unsigned int i = 0; i < dim; ++i)
          for (unsigned int j = 0; j < dim; ++j)
            of_pack.F_increment[i][j] = kinematics.F_increment[i][j];
        of_pack.isochoric_scale = kinematics.isochoric_scale;
        of_pack.with_tangent    = kinematics.with_tangent;
      }

      /** Add the points [@p begin, @p end) of @p law, a law of @p kernel.
       * @p mixed and @p pressure, the nodal values of p, are those of the
       * element, @p shape(q, I) is N_I at point q. */
      template <bool mixed, typename Shape>
      EvaluationStatus
      add(const MixedKernel<dim>              &kernel,
          const PointArrays<dim>              &points,
          const unsigned int                   begin,
          const unsigned int                   end,
          const LawOfPoints<dim>              &law,
          const unsigned int                   n_nodes,
          const std::array<double, max_nodes> &pressure,
          const Shape                         &shape)
      {
        for (unsigned int q = begin; q < end; q += 2)
          {
            // the last of an odd number is a pack with a point of no volume
            const unsigned int r = q + 1 < end ? q + 1 : q;
            set_deformation(points.F[q], points.F[r]);
            if (!(of_pack.J[0] > 0 && of_pack.J[1] > 0))
              return EvaluationStatus::inverted_point;
            const std::size_t n = points.n_history;
            const double     *h = points.history.data();
            if (law.material->evaluate_pack(of_pack,
                                            {{h + q * n, h + r * n}},
                                            response) != StressStatus::success)
              return EvaluationStatus::return_map_failed;
            const PointPack V(points.weight[q], r > q ? points.weight[r] : 0.);
            if constexpr (mixed)
              {
                std::array<PointPack, max_nodes> N;
                PointPack                        p = 0.;
                for (unsigned int I = 0; I < n_nodes; ++I)
                  {
                    N[I] = PointPack(shape(q, I), shape(r, I));
                    p += N[I] * pressure[I];
                  }
                const PointPack kappa(kernel.unseen_stiffness(points, q),
                                      kernel.unseen_stiffness(points, r)),
                  excess = of_pack.J - 1. - p * law.inverse_K;
                add_stress(V, V * (p + kappa * excess) * of_pack.J);
                if (of_pack.with_tangent)
                  bulk += V * kappa * of_pack.J * of_pack.J;
                add_constraint(N,
                               V * (1. - kappa * law.inverse_K),
                               excess,
                               law.inverse_K,
                               n_nodes);
              }
            else
              {
                const PointPack V_J = V * of_pack.J;
                add_stress(V, V_J * (of_pack.J - 1.) * (1. / law.inverse_K));
                if (of_pack.with_tangent)
                  bulk += V_J * of_pack.J * (1. / law.inverse_K);
              }
          }
        return EvaluationStatus::success;
      }

      /** Add all to @p sums. */
      void
      add_to(ElementSums<dim, max_nodes> &sums,
             const unsigned int           n_nodes) const
      {
        for (unsigned int i = 0; i < n; ++i)
          sums.stress[i] += sum(stress[i]);
        sums.spherical += sum(spherical);
        for (unsigned int I = 0; I < n_nodes; ++I)
          sums.constraint[I] += sum(constraint[I]);
        if (!of_pack.with_tangent)
          return;
        for (unsigned int i = 0; i < n * n; ++i)
          sums.modulus[i] += sum(modulus[i]);
        sums.spherical_change += sum(spherical); // J ds/dJ = s
        for (unsigned int i = 0; i < dim; ++i)
          for (unsigned int j = 0; j < dim; ++j)
            sums.modulus[i * n + j] += sum(bulk);
        for (unsigned int I = 0; I < n_nodes; ++I)
          {
            const double s_I = sum(s[I]);
            sums.s[I] += s_I;
            for (unsigned int i = 0; i < dim; ++i)
              sums.volumetric_tangent[I][i] += s_I;
            for (unsigned int J = I; J < n_nodes; ++J)
              sums.compressibility[I * n_nodes + J] +=
                sum(compressibility[I * n_nodes + J]);
          }
      }

    private:
      static constexpr unsigned int n =
        SymmetricTensor<2, dim>::n_independent_components;

      PackKinematics<dim> of_pack;
      PackResponse<dim>   response;

      // see ElementSums
      std::array<PointPack, n>                     stress{};
      ModulusComponents<dim, PointPack>            modulus{};
      PointPack                                    spherical = 0., bulk = 0.;
      std::array<PointPack, max_nodes>             constraint{}, s{};
      std::array<PointPack, max_nodes * max_nodes> compressibility{};

      inline DEAL_II_ALWAYS_INLINE void
      set_deformation(const Tensor<2, dim> &first, const Tensor<2, dim> &second)
      {
        const auto     &dF = of_pack.F_increment;
        auto           &F  = of_pack.F;
        TensorPack<dim> F_n;
        unrolled<dim>([&](const auto i) {
          unrolled<dim>([&](const auto j) {
            F_n[i][j] = PointPack(first[i()][j()], second[i()][j()]);
          });
        });
        unrolled<dim>([&](const auto i) {
          unrolled<dim>([&](const auto j) {
            F[i][j] = dF[i][0] * F_n[0][j];
            unrolled<dim - 1>(
              [&](const auto k) { F[i][j] += dF[i][k + 1] * F_n[k + 1][j]; });
          });
        });
        if constexpr (dim == 2)
          of_pack.J = F[0][0] * F[1][1] - F[0][1] * F[1][0];
        else
          of_pack.J = F[0][0] * (F[1][1] * F[2][2] - F[1][2] * F[2][1]) -
                      F[0][1] * (F[1][0] * F[2][2] - F[1][2] * F[2][0]) +
                      F[0][2] * (F[1][0] * F[2][1] - F[1][1] * F[2][0]);
      }

      inline DEAL_II_ALWAYS_INLINE void
      add_stress(const PointPack &V, const PointPack &V_p_s)
      {
        unrolled<n>([&](const auto i) {
          stress[i] += V * response.deviatoric_stress.in_plane(i);
        });
        spherical += V_p_s;
        if (of_pack.with_tangent)
          unrolled<n * n>(
            [&](const auto i) { modulus[i] += V * response.tangent[i]; });
      }

      inline DEAL_II_ALWAYS_INLINE void
      add_constraint(const std::array<PointPack, max_nodes> &N,
                     const PointPack                        &V,
                     const PointPack                        &excess,
                     const double                            inverse_K,
                     const unsigned int                      n_nodes)
      {
        for (unsigned int I = 0; I < n_nodes; ++I)
          {
            const PointPack VN = V * N[I];
            constraint[I] += VN * excess;
            if (!of_pack.with_tangent)
              continue;
            s[I] += VN * of_pack.J;
            for (unsigned int J = I; J < n_nodes; ++J)
              compressibility[I * n_nodes + J] += VN * N[J] * inverse_K;
          }
      }
    };
  } // namespace internal
} // namespace isochor

#endif
