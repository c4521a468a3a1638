/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <isochor/base/rounding.h>
#include <isochor/body_quadrature/domain_stencil.h>

#include <algorithm>
#include <cmath>

namespace isochor
{
  namespace
  {
    /** From the first corner of a simplex to the others. */
    template <int dim>
    Tensor<2, dim>
    edges_of(const CornerVectors<dim> &corners)
    {
      Tensor<2, dim> edges;
      for (unsigned int d = 0; d < dim; ++d)
        edges[d] = corners[d + 1] - corners[0];
      return edges;
    }

    /** ∇λ_c of the simplex with the given corners. */
    template <int dim>
    CornerVectors<dim>
    barycentric_gradients(const CornerVectors<dim> &corners)
    {
      const Tensor<2, dim> edges = edges_of<dim>(corners);
      const double         J     = determinant(edges);
      AssertThrow(std::abs(J) > rounding::numbers * std::pow(edges.norm(), dim),
                  ExcMessage("The domain of a material point is flat: the "
                             "deformation is too large for <Quadrature/Type = "
                             "CPDI>."));
      const Tensor<2, dim> inverse = invert(edges);
      CornerVectors<dim>   gradients;
      for (unsigned int c = 0; c < dim; ++c)
        for (unsigned int d = 0; d < dim; ++d)
          {
            gradients[c + 1][d] = inverse[d][c];
            gradients[0][d] -= inverse[d][c];
          }
      return gradients;
    }
  } // namespace



  template <int dim>
  void
  CornerNodes<dim>::evaluate(const ShapeFunctions<dim>  &functions,
                             const SimplexGeometry<dim> &geometry,
                             const LocateResult<dim>    &place,
                             const unsigned int          other,
                             const Point<dim>           &x)
  {
    if (other == SimplexGeometry<dim>::no_cell)
      functions.evaluate(place.cell, place.barycentric, at);
    else
      functions.evaluate(other, geometry.barycentric(other, x), at);
    nodes.clear();
    double sum = 0;
    // of a corner on a face the others are zero
    for (unsigned int I = 0; I < at.n_nodes; ++I)
      if (std::abs(at.shape[I]) >= rounding::accumulated)
        {
          nodes.emplace_back(at.vertex[I], at.shape[I]);
          sum += at.shape[I];
        }
    for (auto &node : nodes)
      node.second /= sum;
  }



  template <int dim>
  bool
  CornerNodes<dim>::touches_others(const ShapeFunctions<dim>       &functions,
                                   const std::vector<unsigned int> &cells) const
  {
    for (const auto &node : nodes)
      if (std::none_of(
            cells.begin(), cells.end(), [&](const unsigned int cell) {
              const auto of_cell = functions.nodes(cell);
              return std::find(of_cell.begin(), of_cell.end(), node.first) !=
                     of_cell.end();
            }))
        return true;
    return false;
  }



  template <int dim>
  void
  DomainStencil<dim>::set(const Corners            &corners,
                          const CornerVectors<dim> &places)
  {
    const auto gradients_of_corners = barycentric_gradients<dim>(places);
    n_nodes                         = 0;
    for (unsigned int c = 0; c <= dim; ++c)
      for (const auto &[vertex, N] : corners[c].nodes)
        {
          const unsigned int I = entry(vertex);
          shape[I] += N / (dim + 1);
          gradients[I] += N * gradients_of_corners[c];
        }
  }



  template <int dim>
  void
  DomainStencil<dim>::move(const Tensor<1, dim> &r)
  {
    for (unsigned int I = 0; I < n_nodes; ++I)
      shape[I] += gradients[I] * r;
  }



  template <int dim>
  void
  DomainStencil<dim>::append_to(PointArrays<dim> &points) const
  {
    for (unsigned int I = 0; I < n_nodes; ++I)
      {
        points.stencil_vertex.push_back(vertices[I]);
        points.stencil_shape.push_back(shape[I]);
        points.stencil_gradient.push_back(gradients[I]);
      }
    points.stencil_start.push_back(points.stencil_vertex.size());
  }



  template <int dim>
  unsigned int
  DomainStencil<dim>::entry(const unsigned int vertex)
  {
    unsigned int I = 0;
    while (I < n_nodes && vertices[I] != vertex)
      ++I;
    if (I == n_nodes)
      {
        ++n_nodes;
        if (n_nodes > vertices.size())
          {
            vertices.resize(n_nodes);
            shape.resize(n_nodes);
            gradients.resize(n_nodes);
          }
        vertices[I]  = vertex;
        shape[I]     = 0;
        gradients[I] = Tensor<1, dim>();
      }
    return I;
  }



  template <int dim>
  double
  part_of_domain(const CornerVectors<dim> &inside,
                 const CornerVectors<dim> &whole)
  {
    const double part =
      determinant(edges_of<dim>(inside)) / determinant(edges_of<dim>(whole));
    return std::abs(part - 1) < rounding::accumulated ? 1. : part;
  }



  template class CornerNodes<2>;
  template class CornerNodes<3>;
  template class DomainStencil<2>;
  template class DomainStencil<3>;
  template double
  part_of_domain<2>(const CornerVectors<2> &, const CornerVectors<2> &);
  template double
  part_of_domain<3>(const CornerVectors<3> &, const CornerVectors<3> &);
} // namespace isochor
