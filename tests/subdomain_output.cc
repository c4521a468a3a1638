/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */

// The subdomains of a bent beam, as they are written for ParaView: they fill
// the body, before and after it has deformed, and their stresses fit together.

#include <isochor/postprocess/point_fields.h>
#include <isochor/postprocess/postprocessor.h>

#include <filesystem>

#include "scene.h"

using namespace isochor;
using namespace isochor::test;

namespace
{
  template <int dim>
  struct Subdomains : FieldPatches<dim, dim>
  {
    Subdomains(FieldPatches<dim, dim> &&fields)
      : FieldPatches<dim, dim>(std::move(fields))
    {}
    using FieldPatches<dim, dim>::get_patches;

    unsigned int
    row(const std::string &name) const
    {
      const auto names = this->get_dataset_names();
      return std::find(names.begin(), names.end(), name) - names.begin();
    }
  };

  /** Of all ranks, at the last output. */
  struct Found
  {
    double measure = 0, reference_measure = 0; ///< of all subdomains
    double wrong_volume = 0, wrong_stress = 0; ///< the largest relative error
    double outside = 0; ///< how far corners were outside of the body at t = 0
  } found;



  template <int dim>
  double
  measure(const std::array<Point<dim>, dim + 1> &corners)
  {
    Tensor<2, dim> edges;
    for (unsigned int v = 0; v < dim; ++v)
      edges[v] = corners[v + 1] - corners[0];
    return std::abs(determinant(edges)) / (dim == 2 ? 2 : 6);
  }



  template <int dim>
  class Look : public Postprocessor<dim>
  {
  public:
    void
    evaluate_points(const StepResult<dim> &result, Statistics &) override
    {
      const Subdomains<dim> fields(
        point_fields<dim>(result.points, result.step.kernel));
      const unsigned int u = fields.row("displacement"),
                         s = fields.row("cauchy_stress_xx"),
                         m = fields.row("von_mises_stress"),
                         p = fields.row("mean_stress"),
                         V = fields.row("volume");
      found                = Found();
      for (const auto &patch : fields.get_patches())
        {
          const auto                     &data = patch.data;
          std::array<Point<dim>, dim + 1> now, then;
          for (unsigned int v = 0; v <= dim; ++v)
            {
              now[v] = then[v] = patch.vertices[v];
              for (unsigned int d = 0; d < dim; ++d)
                then[v][d] -= data(u + d, v);
              for (unsigned int d = 0; d < dim; ++d)
                found.outside = std::max({found.outside,
                                          -then[v][d],
                                          then[v][d] - (d == 0 ? 1 : 0.25)});
            }
          found.measure += measure<dim>(now);
          found.reference_measure += measure<dim>(then);
          found.wrong_volume =
            std::max(found.wrong_volume,
                     std::abs(measure<dim>(now) / data(V, dim) - 1));
          double square = 0, sum = 0;
          for (unsigned int i = 0; i < 3; ++i)
            {
              square += std::pow(data(s + i, 0) - data(s + (i + 1) % 3, 0), 2);
              sum += data(s + i, 0);
            }
          for (unsigned int i = 3; i < n_symmetric_components<dim>; ++i)
            square += 6 * std::pow(data(s + i, 0), 2);
          found.wrong_stress =
            std::max({found.wrong_stress,
                      std::abs(data(m, 1) - std::sqrt(square / 2)) / 1e3,
                      std::abs(data(p, dim) - sum / 3) / 1e3});
        }
      const MPI_Comm comm = result.step.grid.communicator();
      found.measure       = Utilities::MPI::sum(found.measure, comm);
      found.reference_measure =
        Utilities::MPI::sum(found.reference_measure, comm);
      found.wrong_volume = Utilities::MPI::max(found.wrong_volume, comm);
      found.wrong_stress = Utilities::MPI::max(found.wrong_stress, comm);
      found.outside      = Utilities::MPI::max(found.outside, comm);
    }
  };
  ISOCHOR_REGISTER_FOR_DIMENSION(Postprocessor, Look, "Look at subdomains")



  template <int dim>
  void
  test_beam(const std::string &corners, const std::string &gravity)
  {
    const std::string directory = "subdomains_" + std::to_string(dim);
    if (this_rank() == 0)
      {
        std::filesystem::remove_all(directory);
        std::filesystem::create_directory(directory);
      }
    wait_for_all_ranks();
    const auto problem = run_scene<dim>(
      corners +
      "Quadrature/Type = CPDI\nMaterial points/Points per cell = 1\n"
      "Material/Density = 1000\nMaterial/Young modulus = 2e5\n"
      "Material/Poisson ratio = 0.3\nBoundary conditions/Displacement = left: "
      "x=0, y=0" +
      (dim == 3 ? ", z=0" : "") + "\nBoundary conditions/Gravity = " + gravity +
      "\nTime/Step size = 0.5\nOutput/Directory = " + directory + "\n");
    const std::string name = std::to_string(dim) + "D: ";
    const double      body = dim == 2 ? 0.25 : 0.0625;
    check(name + "the body at t = 0",
          std::abs(found.reference_measure / body - 1) < 1e-6 &&
            found.outside < 1e-6,
          std::to_string(found.reference_measure) + ", outside by " +
            std::to_string(found.outside));
    const double volume =
      get(*problem,
          dim == 2 ? "Material volume (m^2)" : "Material volume (m^3)");
    check(name + "the body as it is",
          std::abs(found.measure / volume - 1) < 1e-6 &&
            found.wrong_volume < 1e-4,
          std::to_string(found.measure) + " for " + std::to_string(volume) +
            ", " + std::to_string(found.wrong_volume));
    check(name + "von Mises stress and mean stress",
          found.wrong_stress < 1e-5,
          std::to_string(found.wrong_stress));
    bool written =
      std::filesystem::exists(directory + "/subdomains.pvd") &&
      std::filesystem::exists(directory + "/subdomains-00002.pvtu");
    for (unsigned int rank = 0; rank < n_ranks(); ++rank)
      written =
        written && std::filesystem::exists(directory + "/subdomains-00002.000" +
                                           std::to_string(rank) + ".vtu");
    check(name + "a file of each rank", written, directory);
  }
} // namespace

int
main(int argc, char **argv)
{
  MPISession mpi(argc, argv);
  test_beam<2>("Grid/Lower corner = 0, -1\nGrid/Upper corner = 1.25, 0.5\n"
               "Grid/Subdivisions = 10, 12\n"
               "Material points/Region = x < 1 && y > 0 && y < 0.25\n",
               "0, -5*t");
  test_beam<3>(
    "Grid/Lower corner = 0, -0.5, 0\n"
    "Grid/Upper corner = 1.25, 0.5, 0.25\nGrid/Subdivisions = 5, 4, 1\n"
    "Material points/Region = x < 1 && y > 0 && y < 0.25\n",
    "0, -5*t, 0");
  return 0;
}
