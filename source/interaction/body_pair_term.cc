/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <isochor/base/mpi_sums.h>
#include <isochor/base/rounding.h>
#include <isochor/interaction/body_pair_term.h>

#include <algorithm>
#include <limits>
#include <sstream>

namespace isochor
{
  namespace
  {
    template <int dim>
    double
    size_of(const std::array<Point<dim>, dim> &corners)
    {
      double size = 0;
      for (unsigned int i = 1; i < dim; ++i)
        size = std::max(size, corners[i].distance(corners[0]));
      return size;
    }

    template <int dim>
    Point<dim>
    place_on(const std::array<Point<dim>, dim> &corners,
             const std::array<double, dim>     &weights)
    {
      Tensor<1, dim> place;
      for (unsigned int i = 0; i < dim; ++i)
        place += weights[i] * corners[i];
      return Point<dim>(place);
    }

    template <int dim>
    BoundingBox<dim>
    box_around(const std::array<Point<dim>, dim> &corners, const double margin)
    {
      BoundingBox<dim> box(
        std::vector<Point<dim>>(corners.begin(), corners.end()));
      box.extend(margin);
      return box;
    }
  } // namespace



  template <int dim>
  BodyPairTerm<dim>::BodyPairTerm(
    std::vector<std::unique_ptr<Interaction<dim>>> &&interactions)
    : laws(std::move(interactions))
    , default_tie(PluginRegistry<InteractionLaw<dim>>::create("tie"))
  {
    this->name = "Interactions of bodies";
  }



  template <int dim>
  void
  BodyPairTerm<dim>::set_bodies(const std::vector<std::string> &names)
  {
    body_names = names;
    laws.set_bodies(names);
  }



  template <int dim>
  void
  BodyPairTerm<dim>::touch_vertices(std::vector<unsigned int> &vertices)
  {
    if (grid->n_layers() == 1)
      return;
    surface.find(*points);
    memory.send(surface, grid->communicator());
    copies    = copy_faces(*grid, *points, surface, memory, given());
    first_own = 0;
    for (unsigned int n = surface.faces().size();
         first_own + n < copies.size() && n > 0 &&
         copies[first_own].key !=
           BodySurface<dim>::key(surface.faces().front());)
      ++first_own;
    find_elements();
    for (const Element &element : elements)
      vertices.insert(vertices.end(),
                      element.vertices.begin(),
                      element.vertices.end());
  }



  template <int dim>
  bool
  BodyPairTerm<dim>::find_tie(const Point<dim> &X, Element &element) const
  {
    // meshes of bodies are rounded to some digits in their files
    constexpr double     close = 1e-4;
    const FaceCopy<dim> &own   = copies[element.own];
    for (const unsigned int i : element.others)
      {
        const FaceCopy<dim>      &other = copies[i];
        const FaceProjection<dim> at(X, other.X);
        if (at.distance_square > std::pow(close * size_of<dim>(other.X), 2) ||
            at.normal * own.normal > 0)
          continue;
        const InteractionLaw<dim> *const law = laws.given(own, other);
        if (law != nullptr && law->is_unilateral())
          continue;
        element.is_tied = true;
        element.tied_at = at.xi;
        element.others  = {i};
        return true;
      }
    return false;
  }



  template <int dim>
  double
  BodyPairTerm<dim>::margin_of(const FaceCopy<dim> &face) const
  {
    return size_of<dim>(face.x) + 2 * largest_increment;
  }



  template <int dim>
  void
  BodyPairTerm<dim>::find_elements()
  {
    namespace bgi = boost::geometry::index;
    using Entry   = std::pair<BoundingBox<dim>, unsigned int>;
    std::vector<Entry> at_start, now;
    reach           = std::numeric_limits<double>::max();
    way_since_reset = 0;
    for (unsigned int i = 0; i < copies.size(); ++i)
      {
        const double size   = size_of<dim>(copies[i].X),
                     margin = margin_of(copies[i]);
        reach               = std::min(reach, margin / 2);
        at_start.emplace_back(box_around<dim>(copies[i].X, 1e-3 * size), i);
        now.emplace_back(box_around<dim>(copies[i].x, margin), i);
      }
    const auto tree_at_start = pack_rtree(at_start), tree_now = pack_rtree(now);
    elements.clear();
    std::vector<Entry> near;
    const auto         find = [&](const auto       &tree,
                          const Point<dim> &x,
                          Element          &element,
                          const auto       &may_act) {
      near.clear();
      tree.query(bgi::intersects(x), std::back_inserter(near));
      element.others.clear();
      const FaceCopy<dim> &own = copies[element.own];
      for (const Entry &entry : near)
        if (const FaceCopy<dim> &other = copies[entry.second];
            own.body != other.body && may_act(own, other))
          element.others.push_back(entry.second);
      std::sort(element.others.begin(), element.others.end());
      return !element.others.empty();
    };
    const auto acts = [&](const FaceCopy<dim> &a, const FaceCopy<dim> &b) {
      return laws.of(a, b).acts();
    };
    const auto is_contact = [&](const FaceCopy<dim> &a,
                                const FaceCopy<dim> &b) {
      return tied_pairs.count(std::minmax(a.body, b.body)) == 0 &&
             laws.of(a, b).acts() && laws.of(a, b).is_unilateral();
    };
    if (!knows_tied_pairs)
      for (unsigned int i = 0; i < copies.size(); ++i)
        {
          Element element;
          element.own        = i;
          const Point<dim> X = copies[i].centre();
          if (find(tree_at_start, X, element, acts) && find_tie(X, element))
            tied_pairs.insert(
              std::minmax(copies[i].body, copies[element.others[0]].body));
        }
    knows_tied_pairs = true;
    bool any_contact = false;
    for (unsigned int a = 0; a < body_names.size(); ++a)
      for (unsigned int b = a + 1; b < body_names.size(); ++b)
        any_contact = any_contact || (tied_pairs.count({a, b}) == 0 &&
                                      laws.have_contact(a, b));
    if (!any_contact) // what is tied stays where it is
      reach = std::numeric_limits<double>::max();
    for (unsigned int f = 0; f < surface.faces().size(); ++f)
      for (unsigned int g = 0; g < BodySurface<dim>::n_gauss; ++g)
        {
          Element element;
          element.own              = first_own + f;
          element.gauss_point      = g;
          const auto       weights = BodySurface<dim>::coordinates(g);
          const auto      &own     = copies[element.own];
          const Point<dim> X       = place_on<dim>(own.X, weights),
                           x       = place_on<dim>(own.x, weights);
          if (!(find(tree_at_start, X, element, acts) &&
                find_tie(X, element)) &&
              !find(tree_now, x, element, is_contact))
            continue;
          element.number_vertices(copies);
          elements.push_back(element);
        }
  }



  template <int dim>
  void
  BodyPairTerm<dim>::collect_elements(const StepContext<dim> &step,
                                      ElementNodes           &all)
  {
    std::vector<unsigned int> nodes;
    for (const Element &element : elements)
      {
        nodes.clear();
        for (const unsigned int vertex : element.vertices)
          nodes.push_back(step.nodes.node(vertex));
        all.add(nodes.begin(), nodes.end());
      }
  }



  template <int dim>
  void
  BodyPairTerm<dim>::resume(const StepContext<dim> &step)
  {
    const double              saved_reach = reach, saved_way = way_since_reset;
    std::vector<unsigned int> vertices;
    touch_vertices(vertices);
    reach                = saved_reach;
    way_since_reset      = saved_way;
    const auto is_active = [&](const unsigned int copy) {
      const auto &of_copy = copies[copy].vertex;
      return std::all_of(of_copy.begin(),
                         of_copy.end(),
                         [&](const unsigned int vertex) {
                           return step.nodes.node(vertex) !=
                                  numbers::invalid_unsigned_int;
                         });
    };
    std::vector<Element> found;
    found.swap(elements);
    for (Element &element : found)
      {
        std::vector<unsigned int> others;
        std::copy_if(element.others.begin(),
                     element.others.end(),
                     std::back_inserter(others),
                     is_active);
        if (others.empty())
          continue;
        element.others = others;
        element.number_vertices(copies);
        elements.push_back(element);
      }
  }



  template <int dim>
  void
  BodyPairTerm<dim>::prepare(const StepContext<dim> &step)
  {
    if (grid->n_layers() == 1)
      return;
    if (surface.faces().empty())
      resume(step);
    else if (step.grid_is_kept)
      copies = copy_faces(*grid, *points, surface, memory, given());
    for (FaceCopy<dim> &copy : copies)
      start_step(step, copy);
    for (Element &element : elements)
      element.has_start = false;
    find_contact(step);
  }



  template <int dim>
  void
  BodyPairTerm<dim>::find_contact(const StepContext<dim> &step)
  {
    StepContext<dim> start = step;
    start.time             = step.old_time;
    NodalField rest;
    step.nodes.initialize(rest, step.n_components);
    rest.update_ghost_values();
    BodyPairKernel<dim> kernel = kernel_at(start, rest);
    // of what is so near the elements have all faces, whenever they were found
    double near = std::numeric_limits<double>::max();
    for (const FaceCopy<dim> &copy : copies)
      near = std::min(near, margin_of(copy) / 2);
    for (Element &element : elements)
      {
        element.touches = -1; // as long as it is looked for
        if (!element.is_tied)
          element.touches = kernel.touched(element);
        const unsigned int f   = element.own - first_own;
        const double       gap = element.is_tied ?
                                   std::numeric_limits<double>::lowest() :
                                   kernel.gap(element);
        element.is_farther =
          gap > near ||
          (others != nullptr &&
           gap > others->in_contact().gap(f, element.gauss_point));
        if (others != nullptr && !element.is_farther)
          others->in_contact().set_farther(f, element.gauss_point);
      }
  }



  template <int dim>
  void
  BodyPairTerm<dim>::note_start(const StepContext<dim> &start,
                                const NodalField       &unknowns,
                                const NodalField & /*forces*/)
  {
    BodyPairKernel<dim> kernel = kernel_at(start, unknowns);
    for (Element &element : elements)
      {
        kernel.evaluate(element, false);
        element.start     = kernel.action().end;
        element.has_start = true;
      }
  }



  template <int dim>
  EvaluationStatus
  BodyPairTerm<dim>::assemble(const StepContext<dim> &step,
                              const NodalField       &unknowns,
                              const NodalField       &pending,
                              const unsigned int      first_element,
                              const bool              with_matrix,
                              MixedSystem<dim>       &system)
  {
    BodyPairKernel<dim> kernel = kernel_at(step, unknowns);
    for (unsigned int e = 0; e < elements.size(); ++e)
      {
        const EvaluationStatus status =
          kernel.evaluate(elements[e], with_matrix);
        if (status != EvaluationStatus::success)
          return status;
        system.add_element(first_element + e,
                           kernel.sums().residual.data(),
                           with_matrix ? kernel.sums().matrix.data() : nullptr,
                           pending);
      }
    return EvaluationStatus::success;
  }



  template <int dim>
  void
  BodyPairTerm<dim>::add_unit_residual(const StepContext<dim> &step,
                                       NodalField             &scale) const
  {
    for (const Element &element : elements)
      {
        const FaceCopy<dim> &own   = copies[element.own],
                            &other = copies[element.others.front()];
        const double gamma =
          2 * own.gamma * other.gamma / (own.gamma + other.gamma);
        const double area =
          own.area * thickness(step.kernel.axisymmetric, own.x[0][0]);
        for (const FaceCopy<dim> *side : {&own, &other})
          add_rounding_of_gap(step,
                              side->vertex.size(),
                              side->vertex.data(),
                              side->shape.data(),
                              area,
                              gamma,
                              own.x[0].norm(),
                              scale);
      }
  }



  template <int dim>
  void
  BodyPairTerm<dim>::add_boundary_force(const StepContext<dim> &step,
                                        const NodalField       &unknowns,
                                        NodalField             &force) const
  {
    BodyPairKernel<dim> kernel = kernel_at(step, unknowns);
    for (const Element &element : elements)
      {
        // what can't be evaluated stops assemble(), too
        if (kernel.evaluate(element, false) != EvaluationStatus::success)
          return;
        for (unsigned int I = 0; I < element.vertices.size(); ++I)
          for (unsigned int a = 0; a < step.n_components; ++a)
            force.local_element(
              step.nodes.node(element.vertices[I]) * step.n_components + a) -=
              kernel.sums().residual[I * step.n_components + a];
      }
  }



  template <int dim>
  void
  BodyPairTerm<dim>::evaluate(const StepContext<dim> &step,
                              const NodalField       &unknowns,
                              const MixedSystem<dim> & /*system*/,
                              const NodalConstraints & /*constraints*/,
                              Statistics &statistics) const
  {
    const unsigned int n_bodies = body_names.size();
    if (grid->n_layers() == 1)
      return;
    // by pair of bodies, on the first of them
    std::vector<double> forces(n_bodies * n_bodies * dim);
    BodyPairKernel<dim> kernel = kernel_at(step, unknowns);
    memory.start_noting();
    for (const Element &element : elements)
      {
        kernel.evaluate(element, false);
        const auto &action = kernel.action();
        if (!action.meets)
          continue;
        const FaceCopy<dim> &own  = copies[element.own];
        const unsigned int   body = own.body, other = copies[action.other].body;
        for (unsigned int a = 0; a < dim; ++a)
          {
            forces[(body * n_bodies + other) * dim + a] += action.force[a];
            forces[(other * n_bodies + body) * dim + a] -= action.force[a];
          }
        if (action.kept < 1 || action.remembered.norm_square() > 0)
          memory.set_next(own.key,
                          element.gauss_point,
                          action.remembered,
                          action.kept);
      }
    Utilities::MPI::sum(forces, step.grid.communicator(), forces);
    for (unsigned int i = 0; i < n_bodies; ++i)
      for (unsigned int j = i + 1; j < n_bodies; ++j)
        for (unsigned int a = 0; a < dim; ++a)
          statistics.set(std::string("Force ") + "xyz"[a] + " on " +
                           body_names[i] + " by " + body_names[j] + " (N)",
                         forces[(i * n_bodies + j) * dim + a]);
  }



  template <int dim>
  void
  BodyPairTerm<dim>::advance(const StepContext<dim> &step,
                             const NodalField       &unknowns)
  {
    if (grid->n_layers() == 1)
      return;
    memory.accept();
    const NodalUnknowns<dim> nodal(step, unknowns);
    double                   largest = 0;
    for (unsigned int f = 0; f < surface.faces().size(); ++f)
      largest = std::max(
        largest,
        increment_at(nodal, copies[first_own + f], Tensor<1, dim>()).norm());
    largest_increment = Utilities::MPI::max(largest, step.grid.communicator());
    way_since_reset += 2 * largest_increment;
  }



  template <int dim>
  std::string
  BodyPairTerm<dim>::save_state() const
  {
    std::ostringstream state;
    state.precision(std::numeric_limits<double>::max_digits10);
    state << largest_increment << ' ' << reach << ' ' << way_since_reset << '\n'
          << memory.save(grid->communicator());
    return state.str();
  }



  template class BodyPairTerm<2>;
  template class BodyPairTerm<3>;
} // namespace isochor
