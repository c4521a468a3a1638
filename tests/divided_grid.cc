/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */

// A body that fills a part of a grid that does not adapt, or moves through it,
// is shared by the ranks at all times, and all is as on one rank.

#include <isochor/grid/coordinate_bisection.h>

#include <set>

#include "ranks_alike.h"

/** The same of a scene for which the grid has to be divided anew. */
template <int dim>
void
compare(const std::string              &name,
        const std::string              &settings,
        const std::vector<std::string> &columns = {})
{
  compare_results<dim>(name, settings, columns);
  const unsigned int n_ranks = Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD);
  test::check("the grid is divided anew, if there are several ranks",
              n_ranks == 1 ? shares.n_divisions == 0 : shares.n_divisions > 0,
              std::to_string(shares.n_divisions) + " times");
  test::check_error("all ranks have as many points then",
                    shares.after_division,
                    0.1);
  test::check_error("and in all steps", shares.largest, 0.1);
}

/** A block that is carried through a box and swings. */
void
test_space()
{
  compare<3>("3D, dynamic",
             "Grid/Type = box\nGrid/Upper corner = 1, 1, 8\n"
             "Grid/Subdivisions = 4, 4, 32\n"
             "Quadrature/Type = points\n"
             "Material points/Region = z < 2\n"
             "Material/Young modulus = 1000\nMaterial/Poisson ratio = 0.499\n"
             "Material/Density = 1\n"
             "Dynamics/Inertia = true\n"
             "Grid reset/Steps between resets = 1\n"
             "Dynamics/Initial velocity = 0, 0, 1 + 0.2*sin(pi*z/2)\n"
             "Boundary conditions/Displacement = left: x=0; bottom: y=0\n"
             "Time/End time = 4\nTime/Step size = 0.25\n",
             {"Strain energy (J)", "Kinetic energy (J)"});
}

/** A block of soft metal, squeezed between its ends, which move through the
 * grid, the hind one faster. */
void
test_plastic()
{
  compare<2>("2D, plastic, CPDI",
             "Grid/Type = box\nGrid/Upper corner = 3, 1.25\n"
             "Grid/Subdivisions = 48, 20\nQuadrature/Type = CPDI\n"
             "Material points/Region = (x < 1.5) * (y < 1)\n"
             "Newton/Tolerance = 1e-10\nMaterial/Model = J2\n"
             "Material/Young modulus = 1000\nMaterial/Poisson ratio = 0.3\n"
             "Material/J2/Yield stress = 10\n"
             "Boundary conditions/Displacement = bottom: y = 0\n"
             "Boundary conditions/Surfaces of body = hind: x < 0.01; "
             "front: x > 1.49\n"
             "Interaction: hind - place/Displacement = x=0.3*t\n"
             "Interaction: front - place/Displacement = x=0.28*t\n"
             "Postprocess/Write energies = always\n"
             "Postprocess/Reactions = bottom\n"
             "Material/Density = 1\nBoundary conditions/Gravity = 0, -1\n"
             "Time/End time = 2\nTime/Step size = 0.1\n",
             {"Plastic work (J)",
              "External work (J)",
              "Reaction y on bottom (N)"});
}

/** A block that slides on a floor and is stopped by a wall. */
std::string
sliding_block(const std::string &quadrature)
{
  return "Grid/Type = box\nGrid/Upper corner = 4, 1.5\n"
         "Grid/Subdivisions = 48, 18\nQuadrature/Type = " +
         quadrature +
         "\nMaterial points/Region = (x < 1) * (y < 1)\n"
         "Material/Young modulus = 500\nMaterial/Poisson ratio = 0.45\n"
         "Material/Density = 1\nDynamics/Inertia = true\n"
         "Dynamics/Initial velocity = 2, 0\n"
         "Boundary conditions/Gravity = 0, -1\n"
         "Boundary conditions/Displacement = bottom: y = 0" +
         (quadrature == "CPDI" ?
            "\nBoundary conditions/Walls = right: n >= 0; left: n >= 0\n" :
            "; right: x = 0\n") +
         "Time/End time = 1.8\nTime/Step size = 0.05\n";
}

/** Such a block, with @p settings. */
void
test_contact(const std::string &quadrature, const std::string &settings)
{
  compare<2>("2D, contact, " + quadrature + (settings.empty() ? "" : ", ") +
               settings.substr(0, settings.find('\n')),
             sliding_block(quadrature) + settings,
             {"Strain energy (J)", "Kinetic energy (J)", "External work (J)"});
}

/** A block on a rigid floor that takes it along. */
void
test_rigid_floor()
{
  compare<2>("2D, on a rigid floor",
             sliding_block("CPDI") +
               "Dynamics/Initial velocity = 1, 0\n"
               "Boundary conditions/Displacement = \n"
               "Rigid body: floor/Shape = half plane\n"
               "Rigid body: floor/Motion = x=t\n"
               "Boundary conditions/Surfaces of body = base: y < 0.01\n"
               "Interaction: base - floor/Law = tie\n",
             {"Strain energy (J)",
              "External work (J)",
              "Force y on base by floor (N)",
              "Moment on base by floor (N m)"});
}

/** A run that is resumed in the middle goes on with the same division, bit by
 * bit. */
void
test_resume(const std::string &settings)
{
  // MUMPS adds in the order in which messages come
  const std::string scene = sliding_block("CPDI") + settings +
                            "Linear solver/Solver = Amesos\n"
                            "Checkpoint/Interval = 10\n";
  const Results through = run<2>(MPI_COMM_WORLD, scene, {});
  crash_after_step      = 16;
  bool is_interrupted   = false;
  try
    {
      run<2>(MPI_COMM_WORLD, scene, {});
    }
  catch (const ExceptionBase &)
    {
      is_interrupted = true;
    }
  crash_after_step = numbers::invalid_unsigned_int;
  const Results resumed =
    run<2>(MPI_COMM_WORLD, scene + "Checkpoint/Resume = true\n", {});
  test::check("resumed: all is the same",
              is_interrupted && resumed.points == through.points,
              "points differ");
  test::check_error("and the ranks' shares are", shares.largest, 0.1);
}

/** Cells of a lattice: parts of equal weight with plane ends, whatever the
 * order, and whatever is beside them. */
void
test_bisection()
{
  constexpr unsigned int n = 16;
  using Bisection          = CoordinateBisection<3>;
  const auto place         = [](const unsigned int i) {
    return Bisection::Place{{i % n, i / n % n, i / n / n}};
  };
  for (const unsigned int n_ranks : {1, 2, 3, 5, 8})
    {
      std::vector<Bisection::Weight> weights;
      for (unsigned int i = 0; i < n * n * n; ++i)
        weights.push_back({place(i), 1. + i * 7919 % 20});
      const Bisection division(weights, n_ranks);
      std::reverse(weights.begin(), weights.end());
      const Bisection     reversed(weights, n_ranks);
      std::vector<double> sums(n_ranks);
      bool                same = true;
      for (const auto &w : weights)
        {
          sums[division.rank(w.place)] += w.weight;
          same = same && division.rank(w.place) == reversed.rank(w.place);
        }
      double mean = 0, error = 0;
      for (const double sum : sums)
        mean += sum / n_ranks;
      for (const double sum : sums)
        error = std::max(error, std::abs(sum - mean));
      // half of a weight at each of three cuts
      test::check_error("bisection among " + std::to_string(n_ranks) +
                          ": equal parts",
                        error,
                        3 * 20 / 2.);
      test::check("in any order", same, "");
    }

  std::vector<Bisection::Weight> equal;
  for (unsigned int i = 0; i < n * n * n; ++i)
    equal.push_back({place(i), 1.});
  const Bisection halves(equal, 2);
  unsigned int    n_common = 0;
  for (const auto &w : equal)
    for (unsigned int d = 0; d < 3; ++d)
      if (w.place[d] + 1 < n)
        {
          auto next = w.place;
          ++next[d];
          n_common += halves.rank(w.place) != halves.rank(next);
        }
  test::check("a cube is cut along a plane",
              n_common == n * n,
              std::to_string(n_common) + " faces");

  test::check("without weights all is of the first rank",
              Bisection({}, 4).rank(place(9)) == 0,
              "");
}

/** Ranks take turns with the vertices that they share. */
void
test_vertex_owners()
{
  ParameterHandler prm;
  BackgroundGrid<3>::declare_parameters(prm);
  test::set_parameters(prm,
                       "Grid/Type = box\nGrid/Upper corner = 1, 1, 2\n"
                       "Grid/Subdivisions = 7, 7, 14\n");
  BackgroundGrid<3> grid(MPI_COMM_WORLD);
  grid.parse_parameters(prm);
  grid.create();
  const unsigned int n_ranks = Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD);

  const SimplexGeometry<3>           &geometry = grid.geometry();
  std::vector<std::set<unsigned int>> ranks(geometry.vertices().size());
  std::vector<unsigned int>           n_cells(n_ranks);
  for (unsigned int cell = 0; cell < geometry.n_cells(); ++cell)
    {
      ++n_cells[geometry.owner(cell)];
      for (const unsigned int v : geometry.vertex_indices(cell))
        ranks[v].insert(geometry.owner(cell));
    }
  test::check_error("as many cells for each rank",
                    *std::max_element(n_cells.begin(), n_cells.end()) *
                        double(n_ranks) / geometry.n_cells() -
                      1,
                    0.01);

  bool is_of_its_cells = true;
  // by the ranks that share vertices: how many each of them owns
  std::map<std::set<unsigned int>, std::map<unsigned int, unsigned int>> owned;
  for (unsigned int v = 0; v < ranks.size(); ++v)
    {
      is_of_its_cells &= ranks[v].count(grid.vertex_owner(v)) == 1;
      ++owned[ranks[v]][grid.vertex_owner(v)];
    }
  test::check("a vertex has the rank of one of its cells", is_of_its_cells, "");
  // in four rounds, each part of which is one vertex larger than another one
  unsigned int largest_difference = 0;
  for (const auto &[sharing, n_owned] : owned)
    {
      unsigned int least = ranks.size(), most = 0;
      for (const unsigned int rank : sharing)
        {
          const auto         found = n_owned.find(rank);
          const unsigned int n     = found == n_owned.end() ? 0 : found->second;
          least                    = std::min(least, n);
          most                     = std::max(most, n);
        }
      largest_difference = std::max(largest_difference, most - least);
    }
  test::check("and ranks share evenly what they have in common",
              largest_difference <= 4,
              std::to_string(largest_difference));
}

int
main(int argc, char **argv)
{
  Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  test_bisection();
  test_vertex_owners();
  test_space();
  test_plastic();
  for (const std::string quadrature : {"points", "CPDI"})
    test_contact(quadrature, "");
  test_contact("points", "Grid reset/Steps between resets = 3\n");
  test_contact("CPDI", "Grid/Stretch = y: 0 -> 0, 1.5 -> 0.2*t\n");
  test_rigid_floor();
  test_resume("");
  test_resume("Grid reset/Steps between resets = 3\n");
  return 0;
}
