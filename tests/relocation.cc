/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */

// relocate(): particles that drift and jump on a grid that moves, on every
// number of ranks, against an oracle that looks at all cells.

#include <deal.II/base/mpi.h>
#include <deal.II/distributed/shared_tria.h>
#include <deal.II/fe/fe_simplex_p.h>
#include <deal.II/fe/mapping_fe.h>
#include <deal.II/particles/particle_handler.h>

#include <isochor/material_points/point_locator.h>
#include <isochor/material_points/relocation.h>

#include <map>

#include "locator_tools.h"

namespace
{
  /** Particles that drift and jump on a grid that moves, compared with a copy
   * of all of them that every rank keeps. */
  template <int dim>
  class ParticleTest
  {
  public:
    ParticleTest(const Triangulation<dim> &tria, const std::string &name)
      : check("relocate " + std::to_string(dim) + "D " + name)
      , tria(tria)
      , mapping(FE_SimplexP<dim>(1))
      , handler(make_handler())
      , ordered(make_handler())
      , geometry(tria)
      , locator(geometry)
      , comm(geometry.communicator())
      , rank(Utilities::MPI::this_mpi_process(comm))
      , n_ranks(Utilities::MPI::n_mpi_processes(comm))
    {}

    void
    run()
    {
      seed();
      compare(0);
      for (unsigned int step = 1; step <= 20; ++step)
        {
          if (step % 5 == 0)
            move_grid(0.01 * step);
          move(step, step == 8);
          const RelocationReport<dim> report =
            relocate(handler, mapping, locator, {}, n_out_of_order);
          compare_report(report);
          compare(step);
          compare_order();
        }
      check.require(n_laid_out > 0 && n_laid_out < 20, "laid out", n_laid_out);
      check.require(n_moved > 2000, "too few moves:", n_moved);
      check.require(n_ranks == 1 || n_shipped > 300, "shipped", n_shipped);
    }

  private:
    static std::vector<types::particle_index>
    ids(const Particles::ParticleHandler<dim> &handler)
    {
      std::vector<types::particle_index> ids;
      for (const auto &particle : handler)
        ids.push_back(particle.get_id());
      return ids;
    }

    /** The order of particles is the same whether they have been laid out anew
     * each time or not; then they stand one behind the other in memory. */
    void
    compare_order()
    {
      n_laid_out += (n_out_of_order == 0);
      std::size_t many = n_particles;
      relocate(ordered, mapping, locator, {}, many);
      check.require(expected_lost.size() > 0 || many == 0,
                    "not laid out",
                    many);
      check.require(ids(*ordered) == ids(*handler), "order", n_laid_out);
      if (many == 0)
        require_sequence(*ordered);
      if (n_out_of_order == 0)
        require_sequence(*handler);
    }

    void
    require_sequence(const Particles::ParticleHandler<dim> &handler)
    {
      unsigned int n = 0;
      for (const auto &particle : handler)
        check.require(particle.get_local_index() == n++, "place", n);
    }

    std::unique_ptr<Particles::ParticleHandler<dim>>
    make_handler() const
    {
      return std::make_unique<Particles::ParticleHandler<dim>>(tria,
                                                               mapping,
                                                               n_properties);
    }

    struct Expected
    {
      Point<dim>   location;
      unsigned int cell;
    };

    static constexpr unsigned int n_particles  = 600;
    static constexpr unsigned int n_properties = 3;

    static double
    property(const unsigned int id, const unsigned int k)
    {
      return random(id, k, 77);
    }

    void
    seed()
    {
      const Oracle<dim> oracle(tria);
      for (unsigned int id = 0; id < n_particles; ++id)
        {
          const auto x    = oracle.random_point(id, 0);
          const auto cell = oracle.best(x).first;
          expected[id]    = {x, cell};
          if (geometry.cell_iterator(cell)->is_locally_owned())
            {
              std::vector<double> values;
              for (unsigned int k = 0; k < n_properties; ++k)
                values.push_back(property(id, k));
              for (auto *some : {handler.get(), ordered.get()})
                some->insert_particle(x,
                                      geometry.reference_location(
                                        oracle.barycentric(cell, x)),
                                      id,
                                      geometry.cell_iterator(cell),
                                      make_array_view(values));
            }
        }
      for (auto *some : {handler.get(), ordered.get()})
        some->update_cached_numbers();
    }

    void
    move_grid(const double amount)
    {
      auto vertices = tria.get_vertices();
      for (auto &vertex : vertices)
        vertex = transformed(vertex, amount);
      geometry.set_vertices(vertices);
    }

    /** Small moves, unless they lead out; jumps to anywhere for every fifth;
     * every 97th leaves the grid if @p lose is set. In every third step few
     * move at all. */
    void
    move(const unsigned int step, const bool lose)
    {
      const Oracle<dim> oracle(tria, geometry.vertices());
      n_changes = n_handed_over = 0;
      expected_lost.clear();
      for (auto entry = expected.begin(); entry != expected.end();)
        {
          const unsigned int id = entry->first;
          if (step % 3 == 0 && step % 5 != 0 && id % 10 != 0)
            {
              ++entry;
              continue;
            }
          Point<dim> x = entry->second.location;
          for (unsigned int d = 0; d < dim; ++d)
            x[d] += 0.2 * (2 * random(id, step, d) - 1);
          if (oracle.best(x).second < tolerance || (id + step) % 5 == 0)
            x = oracle.random_point(id, step);
          if (lose && id % 97 == 0)
            {
              expected_lost[id] = {x + Point<dim>::unit_vector(0) * 100,
                                   entry->second.cell};
              entry             = expected.erase(entry);
              continue;
            }
          const unsigned int old_cell = entry->second.cell;
          const unsigned int cell     = oracle.best(x).first;
          n_changes += (cell != old_cell);
          n_handed_over += (geometry.cell_iterator(cell)->subdomain_id() !=
                            geometry.cell_iterator(old_cell)->subdomain_id());
          entry->second = {x, cell};
          ++entry;
        }
      for (auto *some : {handler.get(), ordered.get()})
        for (auto &particle : *some)
          {
            const unsigned int id   = particle.get_id();
            const bool         gone = expected_lost.count(id) == 1;
            particle.set_location(gone ? expected_lost[id].location :
                                         expected[id].location);
          }
    }

    void
    compare_report(const RelocationReport<dim> &report)
    {
      check.require(report.n_moved == n_changes,
                    "n_moved",
                    report.n_moved,
                    n_changes);
      check.require(report.n_shipped == n_handed_over,
                    "n_shipped",
                    report.n_shipped,
                    n_handed_over);
      n_moved += report.n_moved;
      n_shipped += report.n_shipped;

      check.require(report.n_lost == expected_lost.size(),
                    "n_lost",
                    report.n_lost);
      check.require(Utilities::MPI::sum(report.lost.size(), comm) ==
                      report.n_lost,
                    "list of lost particles");
      for (unsigned int i = 0; i < report.lost.size(); ++i)
        {
          const unsigned int id = report.lost.ids[i];
          check.require(expected_lost.count(id) == 1 &&
                          expected_lost[id].location ==
                            report.lost.locations[i] &&
                          expected_lost[id].cell == report.lost.cells[i],
                        "lost",
                        id,
                        report.lost.locations[i]);
          for (unsigned int k = 0; k < n_properties; ++k)
            check.require(report.lost.payload(i)[k] == property(id, k),
                          "payload of lost",
                          id);
        }
    }

    void
    compare(const unsigned int step)
    {
      const Oracle<dim>                  oracle(tria, geometry.vertices());
      std::vector<types::particle_index> ids;
      for (auto &particle : *handler)
        {
          const unsigned int id   = particle.get_id();
          const auto         cell = particle.get_surrounding_cell();
          ids.push_back(id);
          check.require(expected.count(id) == 1, "stranger", step, id);
          if (expected.count(id) == 0)
            continue;
          const Point<dim> x = expected[id].location;
          check.require(particle.get_location() == x, "location", step, id);
          check.require(cell->active_cell_index() == expected[id].cell,
                        "cell",
                        step,
                        id);
          check.require(cell->is_locally_owned(), "owner", step, id);
          const auto lambda = oracle.barycentric(expected[id].cell, x);
          for (unsigned int d = 0; d < dim; ++d)
            check.require(std::abs(particle.get_reference_location()[d] -
                                   lambda[d + 1]) < tolerance,
                          "reference location",
                          step,
                          id);
          for (unsigned int k = 0; k < n_properties; ++k)
            check.require(particle.get_properties()[k] == property(id, k),
                          "property",
                          step,
                          id);
        }

      std::multiset<unsigned int> all_ids;
      for (const auto &theirs : Utilities::MPI::all_gather(comm, ids))
        all_ids.insert(theirs.begin(), theirs.end());
      for (const auto &entry : expected)
        check.require(all_ids.count(entry.first) == 1,
                      "times present:",
                      step,
                      entry.first,
                      all_ids.count(entry.first));
      check.require(handler->n_global_particles() == expected.size(),
                    "count",
                    step,
                    handler->n_global_particles());
      check.require(handler->n_locally_owned_particles() == ids.size(),
                    "local count",
                    step);
    }

    Check                     check;
    const Triangulation<dim> &tria;
    MappingFE<dim>            mapping;
    /** As relocate() decides, and always laid out anew. */
    std::unique_ptr<Particles::ParticleHandler<dim>> handler, ordered;
    SimplexGeometry<dim>                             geometry;
    PointLocator<dim>                                locator;
    const MPI_Comm                                   comm;
    const unsigned int                               rank;
    const unsigned int                               n_ranks;
    std::map<unsigned int, Expected>                 expected, expected_lost;
    unsigned int n_changes = 0, n_handed_over = 0;
    unsigned int n_moved = 0, n_shipped = 0;
    std::size_t  n_out_of_order = 0;
    unsigned int n_laid_out     = 0;
  };



  template <int dim>
  void
  check_particles(const std::string &name)
  {
    parallel::shared::Triangulation<dim> shared(
      MPI_COMM_WORLD,
      Triangulation<dim>::none,
      false,
      parallel::shared::Triangulation<dim>::partition_metis);
    make_grid(name, shared);
    ParticleTest<dim>(shared, name + ", shared grid").run();

    Triangulation<dim> serial;
    make_grid(name, serial);
    ParticleTest<dim>(serial, name + ", serial grid").run();
  }



  /** Without a hint a vertex belongs to the first of its cells. The
   * coordinates are such that there is no rounding. */
  void
  check_ties()
  {
    Check            check("ties");
    Triangulation<2> tria;
    GridGenerator::subdivided_hyper_cube_with_simplices(tria, 8);
    const SimplexGeometry<2>  geometry(tria);
    const PointLocator<2>     locator(geometry);
    std::vector<unsigned int> first(tria.n_vertices(), geometry.no_cell);
    for (const auto &cell : tria.active_cell_iterators())
      for (const unsigned int v : cell->vertex_indices())
        first[cell->vertex_index(v)] =
          std::min(first[cell->vertex_index(v)], cell->active_cell_index());
    for (unsigned int v = 0; v < first.size(); ++v)
      check.require(locator.locate(geometry.vertices()[v], geometry.no_cell)
                        .cell == first[v],
                    "vertex",
                    v);
  }



  /** Every rank sends a record to each rank; without payload, too. */
  void
  check_exchange()
  {
    Check                              check("exchange_points");
    parallel::shared::Triangulation<2> tria(
      MPI_COMM_WORLD,
      Triangulation<2>::none,
      false,
      parallel::shared::Triangulation<2>::partition_metis);
    make_grid("box", tria);
    const SimplexGeometry<2> geometry(tria);
    const unsigned int rank = Utilities::MPI::this_mpi_process(MPI_COMM_WORLD);
    const unsigned int n_ranks =
      Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD);

    for (const unsigned int n_payload : {0, 2})
      {
        PointRecords<2> records(n_payload);
        for (unsigned int c = 0; c < geometry.n_cells(); ++c)
          {
            const std::vector<double> values = {c + 0.25, -1. * rank};
            records.push_back(c,
                              rank * geometry.n_cells() + c,
                              Point<2>(0.1 * c, 0.3 * rank),
                              ArrayView<const double>(values.data(),
                                                      n_payload));
          }
        std::size_t  n_shipped = 0;
        const auto   received  = exchange_points(records, geometry, n_shipped);
        unsigned int n_mine    = 0;
        for (const auto &cell : tria.active_cell_iterators())
          n_mine += cell->is_locally_owned();
        check.require(received.size() == n_mine * n_ranks, "received");
        check.require(n_shipped == geometry.n_cells() - n_mine, "shipped");
        for (unsigned int i = 0; i < received.size(); ++i)
          {
            const unsigned int c      = received.cells[i];
            const unsigned int origin = received.ids[i] / geometry.n_cells();
            check.require(geometry.cell_iterator(c)->is_locally_owned() &&
                            received.ids[i] % geometry.n_cells() == c &&
                            received.locations[i] ==
                              Point<2>(0.1 * c, 0.3 * origin),
                          "record",
                          i);
            check.require(received.payload(i).size() == n_payload, "size", i);
            if (n_payload == 2)
              check.require(received.payload(i)[0] == c + 0.25 &&
                              received.payload(i)[1] == -1. * origin,
                            "payload",
                            i);
          }
      }
  }
} // namespace



int
main(int argc, char **argv)
{
  Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);

  check_ties();
  check_exchange();
  check_particles<2>("box");
  check_particles<2>("hole");
  check_particles<3>("box");
  check_particles<3>("L");
  return 0;
}
