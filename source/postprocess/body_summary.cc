/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <deal.II/base/mpi.h>

#include <isochor/base/thickness.h>
#include <isochor/postprocess/body_summary.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <sstream>

namespace isochor
{
  namespace
  {
    /** Of the section, of a body of revolution in space. */
    template <int dim>
    double
    volume_at_start(const Particles::ParticleAccessor<dim> &point,
                    const PointLayout                      &l)
    {
      const auto properties = point.get_properties();
      return properties[l.volume] *
             thickness(l.axisymmetric,
                       point.get_location()[0] - properties[l.displacement]);
    }

    template <int dim>
    std::string
    unit_of_volume(const PointLayout &l)
    {
      return dim == 2 && !l.axisymmetric ? " m^2, " : " m^3, ";
    }
  } // namespace



  template <int dim>
  std::string
  body_summary(const MaterialPoints<dim> &points, const MPI_Comm comm)
  {
    const PointLayout      &l    = points.layout();
    double                  mass = 0, volume = 0;
    std::array<double, dim> lower, upper;
    lower.fill(std::numeric_limits<double>::max());
    upper.fill(std::numeric_limits<double>::lowest());
    for (const auto &point : points.handler())
      {
        const auto properties = point.get_properties();
        mass += properties[l.mass];
        volume += volume_at_start(point, l);
        for (unsigned int d = 0; d < dim; ++d)
          {
            lower[d] = std::min(lower[d], point.get_location()[d]);
            upper[d] = std::max(upper[d], point.get_location()[d]);
          }
      }

    std::ostringstream text;
    text << "Body: " << Utilities::MPI::sum(volume, comm)
         << unit_of_volume<dim>(l) << Utilities::MPI::sum(mass, comm)
         << " kg, points in ";
    for (unsigned int d = 0; d < dim; ++d)
      text << (d == 0 ? "[" : " x [") << Utilities::MPI::min(lower[d], comm)
           << ", " << Utilities::MPI::max(upper[d], comm) << "]";
    return text.str();
  }



  /** The law with its elasticity and strength, as users give them. */
  template <int dim>
  static std::string
  describe_law(const MaterialModel<dim> &material, const std::string &law)
  {
    const double G        = material.shear_modulus(),
                 per_K    = material.inverse_bulk_modulus();
    const double       nu = (3 - 2 * G * per_K) / (6 + 2 * G * per_K);
    std::ostringstream text;
    text << law << ", E = " << 9 * G / (3 + G * per_K)
         << " Pa, nu = " << (std::abs(nu) < rounding::numbers ? 0. : nu);
    if (const std::string strength = material.describe_strength();
        !strength.empty())
      text << ", " << strength;
    return text.str();
  }



  template <int dim>
  std::string
  material_summary(
    const MaterialPoints<dim>                              &points,
    const std::vector<std::unique_ptr<MaterialModel<dim>>> &materials,
    const std::vector<std::string>                         &laws,
    const MPI_Comm                                          comm)
  {
    const std::size_t n = materials.size();
    if (n == 1)
      return "  Material: " + describe_law(*materials[0], laws[0]);
    const PointLayout  &l = points.layout();
    std::vector<double> number(n, 0.), volume(n, 0.);
    for (const auto &point : points.handler())
      {
        const unsigned int material = point.get_properties()[l.material];
        number[material] += 1;
        volume[material] += volume_at_start(point, l);
      }
    Utilities::MPI::sum(number, comm, number);
    Utilities::MPI::sum(volume, comm, volume);
    std::ostringstream text;
    for (unsigned int m = 0; m < n; ++m)
      {
        text << (m > 0 ? "\n" : "") << "  "
             << (m == 0 ? "Material" : "Material " + std::to_string(m + 1))
             << ": ";
        if (number[m] > 0)
          text << static_cast<unsigned long long>(number[m]) << " points, "
               << volume[m] << unit_of_volume<dim>(l) << materials[m]->density()
               << " kg/m^3, " << describe_law(*materials[m], laws[m]);
        else
          text << "no points";
      }
    return text.str();
  }



  template std::string
  body_summary(const MaterialPoints<2> &, const MPI_Comm);
  template std::string
  body_summary(const MaterialPoints<3> &, const MPI_Comm);
  template std::string
  material_summary(const MaterialPoints<2> &,
                   const std::vector<std::unique_ptr<MaterialModel<2>>> &,
                   const std::vector<std::string> &,
                   const MPI_Comm);
  template std::string
  material_summary(const MaterialPoints<3> &,
                   const std::vector<std::unique_ptr<MaterialModel<3>>> &,
                   const std::vector<std::string> &,
                   const MPI_Comm);
} // namespace isochor
