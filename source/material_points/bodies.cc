/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <deal.II/base/bounding_box.h>
#include <deal.II/numerics/rtree.h>

#include <isochor/base/disjoint_sets.h>
#include <isochor/base/expression.h>
#include <isochor/grid/simplex_coordinates.h>
#include <isochor/material_points/bodies.h>
#include <isochor/material_points/parts_of_body.h>

#include <algorithm>
#include <map>
#include <set>

namespace isochor
{
  namespace
  {
    constexpr const char *parameter_name = "Material points/Bodies";
    constexpr const char *automatic      = "auto";
    constexpr const char *one_field      = "one";
    /** The name of the only body, and of what is in no zone. */
    constexpr const char *unnamed = "body";

    /** The least barycentric coordinate of @p x in the domain of @p seed; -1
     * if it has none. */
    template <int dim>
    double
    least_coordinate(const Seed<dim> &seed, const Point<dim> &x)
    {
      const auto lambda =
        simplex_coordinates<dim>(seed.domain, x - seed.location);
      return *std::min_element(lambda.begin(), lambda.end());
    }

    template <int dim>
    bool
    has_domain(const Seed<dim> &seed)
    {
      return seed.domain[0].norm_square() > 0;
    }

    template <int dim>
    BoundingBox<dim>
    box_of(const Seed<dim> &seed)
    {
      std::pair<Point<dim>, Point<dim>> ends(seed.location, seed.location);
      for (const Tensor<1, dim> &corner : seed.domain)
        for (unsigned int d = 0; d < dim; ++d)
          {
            ends.first[d] =
              std::min(ends.first[d], seed.location[d] + corner[d]);
            ends.second[d] =
              std::max(ends.second[d], seed.location[d] + corner[d]);
          }
      return BoundingBox<dim>(ends);
    }
  } // namespace



  template <int dim>
  struct Bodies<dim>::SearchTree
  {
    std::vector<Seed<dim>>                           seeds;
    std::vector<unsigned int>                        body_of_seed;
    RTree<std::pair<BoundingBox<dim>, unsigned int>> boxes;
  };



  template <int dim>
  Bodies<dim>::Bodies() = default;



  template <int dim>
  Bodies<dim>::~Bodies() = default;



  template <int dim>
  void
  Bodies<dim>::declare_parameters(ParameterHandler &prm)
  {
    prm.enter_subsection("Material points");
    prm.declare_entry(
      "Bodies",
      automatic,
      Patterns::Anything(),
      "Bodies with displacements and pressures of their own, which interact "
      "where their surfaces touch: 'name: condition; name: condition', the "
      "conditions in x, y(, z) at a point's place at t = 0. The last condition "
      "that holds counts; points for which none holds are the body called "
      "'body'. auto: with <Quadrature/Type = CPDI>, what is not connected at t "
      "= 0, or of different materials, is a body, called 'body 1', 'body 2', "
      "... They are tied where they touch at t = 0, and come into contact "
      "elsewhere, if no section 'Interaction: name - name' has another law. "
      "one: all points have one field, and are tied where they share nodes of "
      "the grid.");
    prm.leave_subsection();
  }



  template <int dim>
  void
  Bodies<dim>::parse_parameters(ParameterHandler &prm)
  {
    prm.enter_subsection("Material points");
    parameter = Utilities::trim(prm.get("Bodies"));
    prm.leave_subsection();
    if (!are_named())
      return;
    for (const auto &zone : split_named_list(parameter, parameter_name))
      Expression<dim>(zone.second, parameter_name, FormulaVariables::space);
  }



  template <int dim>
  bool
  Bodies<dim>::are_named() const
  {
    return parameter != automatic && parameter != one_field;
  }



  template <int dim>
  std::vector<std::string>
  Bodies<dim>::zones() const
  {
    std::vector<std::string> zones;
    if (are_named())
      for (const auto &zone : split_named_list(parameter, parameter_name))
        zones.push_back(zone.second);
    return zones;
  }



  template <int dim>
  std::vector<std::string>
  Bodies<dim>::names_by_zones(const std::vector<Seed<dim>> &seeds) const
  {
    const auto zones = split_named_list(parameter, parameter_name);
    std::vector<std::string> names;
    names.reserve(seeds.size());
    for (const Seed<dim> &seed : seeds)
      names.push_back(seed.zone == 0 ? unnamed : zones[seed.zone - 1].first);
    for (const auto &zone : zones)
      AssertThrow(std::find(names.begin(), names.end(), zone.first) !=
                    names.end(),
                  ExcMessage("The parameter <" + std::string(parameter_name) +
                             "> names the body <" + zone.first +
                             ">, but it has no material point: its condition "
                             "holds at none, or later ones do."));
    if (!seeds.empty() && has_domain(seeds[0]))
      for (const auto &[s, t] : pairs_across(seeds, periods))
        AssertThrow(names[s] == names[t],
                    ExcMessage("The bodies <" + names[s] + "> and <" +
                               names[t] +
                               "> meet across <Boundary conditions/Periodic "
                               "sides>, where there is one field only: name "
                               "them as one in <" +
                               std::string(parameter_name) + ">."));
    return names;
  }



  namespace
  {
    /** What is connected and of one material. */
    template <int dim>
    struct Component
    {
      unsigned int     part, material;
      BoundingBox<dim> box;
      unsigned int     colour = 0;
    };

    /** The connected parts of each material, and by seed which it belongs to.
     */
    template <int dim>
    std::vector<Component<dim>>
    find_components(const std::vector<Seed<dim>> &seeds,
                    std::vector<unsigned int>    &component_of_seed)
    {
      const std::vector<unsigned int> parts = parts_by_domains(seeds);
      std::map<unsigned int, std::vector<unsigned int>> of_material;
      for (unsigned int s = 0; s < seeds.size(); ++s)
        of_material[seeds[s].material].push_back(s);
      std::vector<Component<dim>> components;
      component_of_seed.resize(seeds.size());
      for (const auto &[material, numbers] : of_material)
        {
          std::vector<Seed<dim>> of_one;
          for (const unsigned int s : numbers)
            of_one.push_back(seeds[s]);
          const std::vector<unsigned int> own   = parts_by_domains(of_one);
          const unsigned int              first = components.size();
          for (unsigned int i = 0; i < numbers.size(); ++i)
            {
              const unsigned int s       = numbers[i],
                                 c       = first + (own.empty() ? 0 : own[i]);
              component_of_seed[s]       = c;
              const BoundingBox<dim> box = box_of(seeds[s]);
              if (c == components.size())
                components.push_back(
                  {parts.empty() ? 0 : parts[s], material, box});
              else
                components[c].box.merge_with(box);
            }
        }
      return components;
    }

    /** Give components of one material and part other colours unless they are
     * several cells apart from each other: those of one colour may share the
     * nodes of a grid without feeling each other. */
    template <int dim>
    void
    colour_components(const std::vector<Seed<dim>> &seeds,
                      std::vector<Component<dim>>  &components)
    {
      Assert(!components.empty(), ExcInternalError());
      double size = 0;
      for (const Seed<dim> &seed : seeds)
        for (unsigned int c = 0; c < dim; ++c)
          size = std::max(size, (seed.domain[c + 1] - seed.domain[c]).norm());
      for (auto one = components.begin(); one != components.end(); ++one)
        {
          // a domain is no longer than a cell, and half of it as a rule
          BoundingBox<dim> around = one->box;
          around.extend(6 * size);
          std::set<unsigned int> taken;
          for (auto other = components.begin(); other != one; ++other)
            if (other->part == one->part && other->material == one->material &&
                around.get_neighbor_type(other->box) !=
                  NeighborType::not_neighbors)
              taken.insert(other->colour);
          while (taken.count(one->colour) != 0)
            ++one->colour;
        }
    }
  } // namespace



  template <int dim>
  std::vector<std::string>
  Bodies<dim>::names_by_parts(const std::vector<Seed<dim>> &seeds) const
  {
    std::vector<unsigned int>   component_of_seed;
    std::vector<Component<dim>> components =
      find_components(seeds, component_of_seed);
    colour_components(seeds, components);
    std::map<std::array<unsigned int, 3>, unsigned int> known;
    std::vector<unsigned int>                           body_of_component;
    for (const Component<dim> &c : components)
      body_of_component.push_back(
        known
          .emplace(std::array<unsigned int, 3>{{c.part, c.material, c.colour}},
                   known.size())
          .first->second);
    DisjointSets bodies(known.size());
    for (const auto &[s, t] : pairs_across(seeds, periods))
      bodies.merge(body_of_component[component_of_seed[s]],
                   body_of_component[component_of_seed[t]]);
    std::map<unsigned int, std::string> name_of_body;
    std::vector<std::string>            names;
    names.reserve(seeds.size());
    for (unsigned int s = 0; s < seeds.size(); ++s)
      names.push_back(
        name_of_body
          .emplace(bodies.root(body_of_component[component_of_seed[s]]),
                   "body " + std::to_string(name_of_body.size() + 1))
          .first->second);
    return names;
  }



  template <int dim>
  std::vector<unsigned int>
  Bodies<dim>::divide(const std::vector<Seed<dim>> &seeds)
  {
    tree.reset();
    all_names              = {unnamed};
    const bool has_domains = !seeds.empty() && has_domain(seeds[0]);
    if (parameter == one_field || (parameter == automatic && !has_domains))
      return {};
    const std::vector<std::string> names =
      parameter == automatic ? names_by_parts(seeds) : names_by_zones(seeds);
    // in the order of the first points
    std::map<std::string, unsigned int> numbers;
    std::vector<unsigned int>           body_of_seed;
    body_of_seed.reserve(seeds.size());
    all_names.clear();
    for (const std::string &name : names)
      {
        const auto found = numbers.emplace(name, all_names.size());
        if (found.second)
          all_names.push_back(name);
        body_of_seed.push_back(found.first->second);
      }
    if (size() == 1)
      {
        if (parameter == automatic)
          all_names = {unnamed};
        return {};
      }
    tree               = std::make_unique<SearchTree>();
    tree->seeds        = seeds;
    tree->body_of_seed = body_of_seed;
    std::vector<std::pair<BoundingBox<dim>, unsigned int>> boxes;
    for (unsigned int s = 0; s < seeds.size(); ++s)
      boxes.emplace_back(box_of(seeds[s]), s);
    tree->boxes = pack_rtree(boxes);
    return body_of_seed;
  }



  template <int dim>
  unsigned int
  Bodies<dim>::at(const Point<dim> &x) const
  {
    if (!tree)
      return 0;
    namespace bgi          = boost::geometry::index;
    double       best      = -1e-6; // rounding
    unsigned int best_seed = numbers::invalid_unsigned_int;
    for (const auto &entry :
         tree->boxes | bgi::adaptors::queried(bgi::intersects(x)))
      {
        const double least = least_coordinate(tree->seeds[entry.second], x);
        // of equals the first, whatever the order of the tree
        if (least > best || (least == best && entry.second < best_seed))
          {
            best      = least;
            best_seed = entry.second;
          }
      }
    if (best_seed == numbers::invalid_unsigned_int)
      for (const auto &entry :
           tree->boxes | bgi::adaptors::queried(bgi::nearest(x, 1)))
        best_seed = entry.second;
    return tree->body_of_seed[best_seed];
  }



  template class Bodies<2>;
  template class Bodies<3>;
} // namespace isochor
