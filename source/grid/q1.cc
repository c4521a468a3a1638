/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <isochor/base/plugin_registry.h>
#include <isochor/base/rounding.h>
#include <isochor/grid/shape_functions.h>

#include <algorithm>
#include <sstream>

namespace isochor
{
  /**
   * Bilinear in quadrilaterals that consist of two triangles each, trilinear in
   * hexahedra of six tetrahedra: on the unit square or cube products of linear
   * functions of each coordinate, and in space the same with
   * x(ξ) = Σ N_I(ξ) x_I. The grid's source says which cells belong together.
   *
   * Side faces of hexahedra that are not plane are not those of the
   * tetrahedra: near them a place may belong to the hexahedron next to that
   * whose functions are taken. What is linear stays exact.
   */
  template <int dim>
  class Q1 : public ShapeFunctions<dim>
  {
  public:
    using typename ShapeFunctions<dim>::Barycentric;
    using typename ShapeFunctions<dim>::Cells;
    using typename ShapeFunctions<dim>::Values;

    void
    set_grid(const GridSource<dim>      &source,
             const SimplexGeometry<dim> &geometry) override;

    ArrayView<const unsigned int>
    nodes(const unsigned int cell) const override
    {
      const auto &vertices = hypercubes[hypercube_of[cell]].vertices;
      return ArrayView<const unsigned int>(vertices.data(), n_corners);
    }

    Cells
    element(const unsigned int cell) const override
    {
      const auto &cells = hypercubes[hypercube_of[cell]].cells;
      return Cells(cells.begin(), cells.end());
    }

    void
    evaluate(const unsigned int cell,
             const Barycentric &lambda,
             Values            &values) const override;

  private:
    static constexpr unsigned int n_corners = 1u << dim;

    /** x at ξ, and J = ∂x/∂ξ. */
    struct Place
    {
      Point<dim>     x;
      Tensor<2, dim> J;
    };

    /** N_I and its derivatives by ξ. */
    static void
    evaluate_on_unit_cube(const Point<dim> &xi, Values &values);
    Place
    place(const Hypercube<dim> &cube, const Values &on_unit_cube) const;
    void
    evaluate_linearly(const unsigned int cell,
                      const Barycentric &lambda,
                      Values            &values) const;
    [[noreturn]] void
    complain(const Hypercube<dim> &cube) const;

    const SimplexGeometry<dim> *simplices = nullptr;
    std::vector<Hypercube<dim>> hypercubes;
    std::vector<unsigned int>   hypercube_of; ///< by cell
  };



  namespace
  {
    /** Corner @p i of the unit square or cube, numbered in binary. */
    template <int dim>
    Point<dim>
    unit_corner(const unsigned int i)
    {
      Point<dim> corner;
      for (unsigned int d = 0; d < dim; ++d)
        corner[d] = (i >> d) & 1u;
      return corner;
    }
  } // namespace



  template <int dim>
  void
  Q1<dim>::set_grid(const GridSource<dim>      &source,
                    const SimplexGeometry<dim> &geometry)
  {
    simplices  = &geometry;
    hypercubes = source.hypercubes();
    AssertThrow(!hypercubes.empty(),
                ExcMessage(
                  std::string("The parameter <Grid/Shape functions = Q1> needs "
                              "a grid whose ") +
                  (dim == 2 ? "triangles form quadrilaterals" :
                              "tetrahedra form hexahedra") +
                  ", as those of <Grid/Type = box> and <Grid/Type = trapezoid> "
                  "do, while gmsh and adaptive grids don't. Use <Grid/Shape "
                  "functions = P1>, or another <Grid/Type>."));
    // copies of those of the first layer
    const unsigned int n_layers = geometry.n_layers(),
                       n_cubes  = hypercubes.size();
    hypercubes.reserve(n_layers * n_cubes);
    for (unsigned int layer = 1; layer < n_layers; ++layer)
      for (unsigned int h = 0; h < n_cubes; ++h)
        {
          hypercubes.push_back(hypercubes[h]);
          for (unsigned int &v : hypercubes.back().vertices)
            v += layer * (geometry.vertices().size() / n_layers);
          for (unsigned int &c : hypercubes.back().cells)
            c += layer * (geometry.n_cells() / n_layers);
        }
    hypercube_of.assign(geometry.n_cells(), numbers::invalid_unsigned_int);
    Values values;
    for (unsigned int h = 0; h < hypercubes.size(); ++h)
      {
        const Hypercube<dim> &cube = hypercubes[h];
        for (const unsigned int cell : cube.cells)
          {
            hypercube_of[cell] = h;
            for (const unsigned int v : geometry.vertex_indices(cell))
              AssertThrow(std::count(cube.vertices.begin(),
                                     cube.vertices.end(),
                                     v) == 1,
                          ExcInternalError());
          }
        // the map is one-to-one; if it turns the cell inside out, everywhere
        double least = std::numeric_limits<double>::max(), largest = -least;
        for (unsigned int i = 0; i < n_corners; ++i)
          {
            evaluate_on_unit_cube(unit_corner<dim>(i), values);
            const double J = determinant(place(cube, values).J);
            least          = std::min(least, J);
            largest        = std::max(largest, J);
          }
        if (!(least * largest > 0))
          complain(cube);
      }
    AssertThrow(*std::max_element(hypercube_of.begin(), hypercube_of.end()) <
                  hypercubes.size(),
                ExcInternalError());
  }



  template <int dim>
  void
  Q1<dim>::evaluate_on_unit_cube(const Point<dim> &xi, Values &values)
  {
    for (unsigned int i = 0; i < n_corners; ++i)
      {
        std::array<double, dim> factor, slope;
        for (unsigned int d = 0; d < dim; ++d)
          {
            const bool upper = (i >> d) & 1u;
            factor[d]        = upper ? xi[d] : 1 - xi[d];
            slope[d]         = upper ? 1. : -1.;
          }
        values.shape[i] = 1;
        for (unsigned int d = 0; d < dim; ++d)
          {
            values.shape[i] *= factor[d];
            values.gradient[i][d] = 1;
            for (unsigned int e = 0; e < dim; ++e)
              values.gradient[i][d] *= (d == e ? slope[e] : factor[e]);
          }
      }
  }



  template <int dim>
  typename Q1<dim>::Place
  Q1<dim>::place(const Hypercube<dim> &cube, const Values &on_unit_cube) const
  {
    Place place;
    for (unsigned int i = 0; i < n_corners; ++i)
      {
        const Tensor<1, dim> x = simplices->vertices()[cube.vertices[i]];
        place.x += on_unit_cube.shape[i] * x;
        place.J += outer_product(x, on_unit_cube.gradient[i]);
      }
    return place;
  }



  template <int dim>
  void
  Q1<dim>::evaluate(const unsigned int cell,
                    const Barycentric &lambda,
                    Values            &values) const
  {
    constexpr unsigned int most_iterations = 30;
    // beyond the element the inverse of x(ξ) need not exist. On its sides both
    // are the same
    if (*std::min_element(lambda.begin(), lambda.end()) <
        -rounding::accumulated)
      {
        evaluate_linearly(cell, lambda, values);
        return;
      }
    const Hypercube<dim> &cube = hypercubes[hypercube_of[cell]];
    Point<dim>            x, xi; // for a parallelogram ξ is linear in λ
    double                size = 0;
    for (unsigned int v = 0; v <= dim; ++v)
      {
        const unsigned int   vertex = simplices->vertex_indices(cell)[v];
        const Tensor<1, dim> corner = simplices->vertices()[vertex];
        x += lambda[v] * corner;
        xi += lambda[v] *
              unit_corner<dim>(
                std::find(cube.vertices.begin(), cube.vertices.end(), vertex) -
                cube.vertices.begin());
        size = std::max(size, corner.norm());
      }
    for (unsigned int iteration = 0;; ++iteration)
      {
        if (iteration == most_iterations)
          complain(cube);
        evaluate_on_unit_cube(xi, values);
        const Place at = place(cube, values);
        if (!(std::abs(determinant(at.J)) > 0))
          complain(cube);
        const Tensor<2, dim> inverse = invert(at.J);
        const Tensor<1, dim> change  = inverse * (x - at.x);
        // far from the origin coordinates are rounded
        if (change.norm() <
            rounding::arithmetic + 1e-15 * inverse.norm() * size)
          {
            values.n_nodes = n_corners;
            for (unsigned int i = 0; i < n_corners; ++i)
              {
                values.vertex[i]   = cube.vertices[i];
                values.gradient[i] = values.gradient[i] * inverse;
              }
            return;
          }
        xi += change;
      }
  }



  template <int dim>
  void
  Q1<dim>::evaluate_linearly(const unsigned int cell,
                             const Barycentric &lambda,
                             Values            &values) const
  {
    values.n_nodes = dim + 1;
    for (unsigned int v = 0; v <= dim; ++v)
      {
        values.vertex[v]   = simplices->vertex_indices(cell)[v];
        values.shape[v]    = lambda[v];
        values.gradient[v] = simplices->gradients(cell)[v];
      }
  }



  template <int dim>
  void
  Q1<dim>::complain(const Hypercube<dim> &cube) const
  {
    std::ostringstream corners;
    for (const unsigned int v : cube.vertices)
      corners << " (" << simplices->vertices()[v] << ")";
    AssertThrow(false,
                ExcMessage(
                  "The cell of the grid with the corners" + corners.str() +
                  " is too distorted for <Grid/Shape functions = Q1>: " +
                  (dim == 2 ? "the quadrilateral is not convex." :
                              "the trilinear map is not one-to-one.") +
                  " Use <Grid/Shape functions = P1>, or a less distorted "
                  "grid."));
    std::abort(); // not reached
  }



  ISOCHOR_REGISTER_FOR_DIMENSION(ShapeFunctions, Q1, "Q1")
} // namespace isochor
