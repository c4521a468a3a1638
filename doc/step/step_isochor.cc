/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */

// @sect3{A program on top of the library}
//
// The program <code>isochor</code> reads a scene from a parameter file. This
// one is for those who want to do without the file: it brings a material and
// a post-processor of its own, sets up a scene in C++, runs it for several
// loads and compares the results with a closed form. Copy it and change it.
//
// The scene: a block of rubber under plane strain lies on a smooth floor and is
// compressed by a smooth plate. Its sides are free. The deformation is
// homogeneous, which is why we know the answer: an incompressible block of
// height ratio $\lambda$ is $1/\lambda$ as wide, and the plate bears per
// initial area
// @f[ P = 2 W'(\bar I) (\lambda - \lambda^{-3}), \qquad
//     \bar I = \lambda^2 + \lambda^{-2} + 1 . @f]

// @sect4{Include files}
//
// The class MaterialPointMethod is the algorithm. It includes what the plugins
// need. The other two headers help to write isochoric laws.
#include <deal.II/base/mpi.h>

#include <isochor/material_model/isochoric_elasticity.h>
#include <isochor/material_model/tensor_tools.h>
#include <isochor/step/material_point_method.h>

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <iostream>

namespace Step
{
  using namespace dealii;
  using namespace isochor;

  // @sect4{A material}
  //
  // Rubber stiffens when it is strained a lot. Yeoh's law describes this by
  // one more constant than the Neo-Hookean law has:
  // @f[ W = K \frac{(J-1)^2}{2} + \frac G2 (\bar I - 3) + C (\bar I - 3)^2,
  //     \qquad \bar I = \mathrm{tr}\, \bar b, \quad
  //     \bar b = J^{-2/3} F F^T . @f]
  // The Kirchhoff stress is $2 W'(\bar I)\, \mathrm{dev}\, \bar b$ plus a
  // pressure. Pressure is not our business here: a material tells its
  // deviatoric stress and its elastic volume change, and works in the
  // formulations `u` and `u-p` alike.
  template <int dim>
  class Yeoh : public MaterialModel<dim>
  {
  public:
    // Parameters are declared in one place and read in another. Both are
    // called within the subsection "Material". What isotropic laws have in
    // common, $E$, $\nu$ and $\rho$, is there already.
    static void
    declare_parameters(ParameterHandler &prm)
    {
      IsotropicElasticity::declare_parameters(prm);
      prm.enter_subsection("Yeoh");
      prm.declare_entry("C",
                        "0",
                        Patterns::Double(0),
                        "The second constant of the law, in Pa.");
      prm.leave_subsection();
    }

    void
    parse_parameters(ParameterHandler &prm) override
    {
      elasticity.parse_parameters(prm);
      prm.enter_subsection("Yeoh");
      C = prm.get_double("C");
      prm.leave_subsection();
    }

    // The law itself. It must not keep anything between two calls: Newton's
    // method asks again and again, and goes back if an iterate is bad. A law
    // with a memory gets it as <code>history_n</code> and fills
    // <code>history</code>.
    StressStatus
    evaluate(const Kinematics<dim> &kinematics,
             const double * /*history_n*/,
             double * /*history*/,
             StressResponse<dim> &response) const override
    {
      const double                J = kinematics.J;
      const SymmetricTensor<2, 3> b_bar =
        push_forward(kinematics.F, unit_symmetric_tensor<3>()) /
        std::cbrt(J * J);
      const SymmetricTensor<2, 3> dev_b_bar = deviator(b_bar);
      const double                modulus =
        elasticity.shear_modulus + 4 * C * (trace(b_bar) - 3);

      response.deviatoric_stress = modulus * dev_b_bar;
      // The tangent is with respect to the symmetric velocity gradient d. With
      // the modulus fixed it is that of the Neo-Hookean law. The modulus
      // changes by $8 C\, \mathrm{dev}\, \bar b : d$. A wrong tangent shows in
      // the test <code>material_tangents</code>, which differentiates all
      // materials that live in <code>source/material_model/</code>.
      response.tangent = isochoric_modulus<dim>(modulus * trace(b_bar) / 3,
                                                response.deviatoric_stress);
      const SymmetricTensor<2, dim> in_plane_part = in_plane<dim>(dev_b_bar);
      response.tangent += 8 * C * outer_product(in_plane_part, in_plane_part);
      set_elastic_volume_change(J, response);
      return StressStatus::success;
    }

    // $\bar W = \frac{G}{2} (\mathrm{tr}\, \bar b - 3) + C (\mathrm{tr}\, \bar
    // b
    // - 3)^2$, for the energies in the statistics.
    double
    deviatoric_energy(const Tensor<2, dim> &F,
                      const double * /*history*/) const override
    {
      const double J = determinant(F);
      const double excess =
        trace(push_forward(F, unit_symmetric_tensor<3>())) / std::cbrt(J * J) -
        3;
      return (elasticity.shear_modulus / 2 + C * excess) * excess;
    }

    double
    shear_modulus() const override
    {
      return elasticity.shear_modulus;
    }

    double
    inverse_bulk_modulus() const override
    {
      return elasticity.inverse_bulk_modulus;
    }

    double
    density() const override
    {
      return elasticity.density;
    }

  private:
    IsotropicElasticity elasticity;
    double              C = 0;
  };

  // This line makes it known as "Yeoh", in two and three dimensions.
  ISOCHOR_REGISTER_FOR_DIMENSION(MaterialModel, Yeoh, "Yeoh")

  // @sect4{A post-processor}
  //
  // It is called after each step and adds columns to the statistics, which
  // also go to the file <code>statistics.txt</code>. Ours walks over the
  // material points and measures the volume and the mean stretches. A field of
  // a point stands in its properties where the layout says. Each rank has its
  // own points only, hence the sums.
  template <int dim>
  class Shape : public Postprocessor<dim>
  {
  public:
    static void
    declare_parameters(ParameterHandler & /*prm*/)
    {}

    void
    parse_parameters(ParameterHandler & /*prm*/) override
    {}

    void
    evaluate_points(const StepResult<dim> &result,
                    Statistics            &statistics) override
    {
      const PointLayout &layout = result.points.layout();
      double             V_0 = 0, V = 0, stretch = 0;
      for (const auto &point : result.points.handler())
        {
          const auto     properties = point.get_properties();
          const double   volume     = properties[layout.volume];
          Tensor<2, dim> F;
          for (unsigned int i = 0; i < dim; ++i)
            for (unsigned int j = 0; j < dim; ++j)
              F[i][j] = properties[layout.F + i * dim + j];
          V_0 += volume;
          V += volume * determinant(F);
          stretch += volume * F[0][0];
        }
      V_0     = Utilities::MPI::sum(V_0, MPI_COMM_WORLD);
      V       = Utilities::MPI::sum(V, MPI_COMM_WORLD);
      stretch = Utilities::MPI::sum(stretch, MPI_COMM_WORLD);
      statistics.set("Volume ratio", V / V_0);
      statistics.set("Mean stretch x", stretch / V_0);
    }
  };

  ISOCHOR_REGISTER_FOR_DIMENSION(Postprocessor, Shape, "Shape")

  // @sect4{The scene}
  //
  // What a parameter file would say. The text could also come from
  // <code>prm.parse_input("scene.prm")</code>. The left side is a plane of
  // symmetry, so that this is the right half of a block of width 2 m.
  void
  describe_scene(ParameterHandler &prm, const double lambda)
  {
    prm.parse_input_from_string(R"(
      subsection Grid
        set Type         = box
        set Subdivisions = 4, 6
      end
      subsection Material points
        set Points per cell = 3
      end
      subsection Quadrature
        set Type = points
      end
      subsection Formulation
        set Type          = u-p
        set Stabilisation = PPP
      end
      subsection Material
        set Model         = Yeoh
        set Young modulus = 3e6
        set Poisson ratio = 0.5
        subsection Yeoh
          set C = 2e5
        end
      end
      subsection Postprocess
        set Reactions = top
      end
      subsection Output
        set Directory = step_output
        set Terminal  = quiet
      end)");
    prm.enter_subsection("Boundary conditions");
    prm.set("Displacement",
            "bottom: y = 0; left: x = 0; top: y = t*(" +
              std::to_string(lambda - 1) + ")");
    prm.leave_subsection();
  }

  // @sect4{Running it}
  //
  // The whole compression is one step here: the deformation is homogeneous, so
  // that nothing is lost. Note that a homogeneous deformation in several steps
  // would not be exact any more: after the first one the side of the block cuts
  // through cells of the grid.
  void
  run(const double lambda)
  {
    ParameterHandler prm;
    MaterialPointMethod<2>::declare_parameters(prm);
    describe_scene(prm, lambda);

    MaterialPointMethod<2> problem(MPI_COMM_WORLD);
    problem.parse_parameters(prm);
    problem.run();

    const Statistics &results = problem.last_statistics();
    const double      G = 1e6, C = 2e5;
    const double      I = lambda * lambda + 1 / (lambda * lambda) + 1;
    const double      expected =
      (G + 4 * C * (I - 3)) * (lambda - 1 / (lambda * lambda * lambda));
    if (Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0)
      std::printf("%8.2f %10.6f %12.6f %12.4f %12.4f\n",
                  lambda,
                  results.get("Mean stretch x"),
                  results.get("Volume ratio"),
                  results.get("Reaction y on top (N)") / 1e3,
                  expected / 1e3);
  }
} // namespace Step

int
main(int argc, char **argv)
{
  dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  try
    {
      std::filesystem::create_directories("step_output");
      if (dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0)
        std::printf("  height      width       volume   force (kN)     expected"
                    "\n");
      for (const double lambda : {0.9, 0.8, 0.7, 0.6, 1.2, 1.4})
        Step::run(lambda);
    }
  catch (const std::exception &exc)
    {
      std::cerr << exc.what() << std::endl;
      return 1;
    }
}
