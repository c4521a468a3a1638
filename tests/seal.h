/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_tests_seal_h
#define isochor_tests_seal_h

// Round bodies between plates.

#include "run_scene.h"

namespace isochor
{
  namespace test
  {
    /** The force per length between two plates that bring a cylinder of radius
     * 1 and E = 1 nearer by @p squeeze (K. L. Johnson, Contact Mechanics
     * (1985), eq. 5.57: 2P/(π E*) (2 ln(4R/a) - 1), a² = 4PR/(π E*)). */
    inline double
    line_contact(const double squeeze, const double nu)
    {
      const double E_star = 1 / (1 - nu * nu);
      double       low = 1e-9, high = 1;
      for (unsigned int i = 0; i < 100; ++i)
        {
          const double P = 0.5 * (low + high),
                       a = std::sqrt(4 * P / (test::pi * E_star));
          (2 * P / (test::pi * E_star) * (2 * std::log(4 / a) - 1) < squeeze ?
             low :
             high)       = P;
        }
      return low;
    }

    /** Write half of a disc of radius 1 around (0, 1) to disc.msh: @p n rings
     * of triangles, 3 i edges on circle i. */
    inline void
    write_disc(const unsigned int n)
    {
      const auto first = [](const unsigned int i) {
        return i + 3 * i * (i - (i > 0)) / 2 + 1; // of circle i
      };
      std::ostringstream triangles;
      unsigned int       n_triangles = 0;
      const auto         add =
        [&](const unsigned int a, const unsigned int b, const unsigned int c) {
          triangles << ++n_triangles << " 2 2 1 1 " << a << ' ' << b << ' ' << c
                    << '\n';
        };
      for (unsigned int i = 1; i <= n; ++i)
        for (unsigned int sector = 0; sector < 3; ++sector)
          for (unsigned int k = 0; k < i; ++k)
            {
              const unsigned int inner = first(i - 1) + sector * (i - 1) + k,
                                 outer = first(i) + sector * i + k;
              add(outer, outer + 1, inner);
              if (k + 1 < i)
                add(inner, outer + 1, inner + 1);
            }
      if (test::this_rank() == 0)
        {
          std::ofstream file("disc.msh");
          file << "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n"
               << first(n + 1) - 1 << '\n';
          for (unsigned int i = 0; i <= n; ++i)
            for (unsigned int k = 0; k <= 3 * i; ++k)
              {
                const double r = double(i) / n,
                             a = test::pi * (i == 0 ? 0. : k / (3. * i) - 0.5);
                file << first(i) + k << ' '
                     << (k == 0 || k == 3 * i ? 0. : r * std::cos(a)) << ' '
                     << 1 + r * std::sin(a) << " 0\n";
              }
          file << "$EndNodes\n$Elements\n"
               << n_triangles << '\n'
               << triangles.str() << "$EndElements\n";
        }
      test::wait_for_all_ranks();
    }

    /** A round seal between smooth plates that the grid follows, of which half
     * is computed, with @p n cells over its radius. */
    inline std::string
    seal(const unsigned int n,
         const double       squeeze,
         const std::string &settings)
    {
      const std::string u = std::to_string(squeeze) + "*t";
      return "Grid/Upper corner = 1.5, 2\nGrid/Subdivisions = " +
             std::to_string(3 * n / 2) + ", " + std::to_string(2 * n) +
             "\nGrid/Stretch = y: 0 -> 0, 2 -> -" + u +
             "\nMaterial points/Body mesh = disc.msh\n"
             "Material points/Points per cell = 1\n"
             "Material/Young modulus = 1\nMaterial/Poisson ratio = 0.49\n"
             "Formulation/Type = u-p\nTime/Step size = 0.25\n"
             "Boundary conditions/Displacement = left: x=0; bottom: y>=0; top: "
             "y<=-" +
             u + "\nPostprocess/Reactions = bottom\n" + settings;
    }

  } // namespace test
} // namespace isochor

#endif
