/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <deal.II/grid/reference_cell.h>

#include <isochor/base/safe_file.h>
#include <isochor/postprocess/field_output.h>

#include <algorithm>
#include <limits>
#include <sstream>

namespace isochor
{
  template <int patch_dim, int dim>
  unsigned int
  FieldPatches<patch_dim, dim>::add_scalar(const std::string &name)
  {
    return add(name, 1, DataComponentInterpretation::component_is_scalar);
  }



  template <int patch_dim, int dim>
  unsigned int
  FieldPatches<patch_dim, dim>::add_vector(const std::string &name)
  {
    return add(name,
               dim,
               DataComponentInterpretation::component_is_part_of_vector);
  }



  template <int patch_dim, int dim>
  unsigned int
  FieldPatches<patch_dim, dim>::add_tensor(const std::string &name)
  {
    return add(name,
               9,
               DataComponentInterpretation::component_is_part_of_tensor);
  }



  template <int patch_dim, int dim>
  unsigned int
  FieldPatches<patch_dim, dim>::add(
    const std::string                                             &name,
    const unsigned int                                             n_components,
    const DataComponentInterpretation::DataComponentInterpretation type)
  {
    Assert(patches.empty(), ExcMessage("Declare all fields before patches."));
    const unsigned int first = names.size();
    names.insert(names.end(), n_components, name);
    if (n_components > 1)
      ranges.emplace_back(first, first + n_components - 1, name, type);
    return first;
  }



  template <int patch_dim, int dim>
  void
  FieldPatches<patch_dim, dim>::reserve(const unsigned int n_patches)
  {
    patches.reserve(n_patches);
  }



  template <int patch_dim, int dim>
  typename FieldPatches<patch_dim, dim>::Patch &
  FieldPatches<patch_dim, dim>::add_patch(
    const ArrayView<const Point<dim>> &vertices)
  {
    AssertDimension(vertices.size(), patch_dim + 1);
    patches.emplace_back();
    Patch &patch      = patches.back();
    patch.patch_index = patches.size() - 1;
    if constexpr (patch_dim > 0) // a point has one cell and no choice
      patch.reference_cell = ReferenceCells::get_simplex<patch_dim>();
    std::copy(vertices.begin(), vertices.end(), std::begin(patch.vertices));
    patch.data.reinit(names.size(), patch_dim + 1);
    return patch;
  }



  template <int patch_dim, int dim>
  unsigned int
  FieldPatches<patch_dim, dim>::n_patches() const
  {
    return patches.size();
  }



  template <int patch_dim, int dim>
  const std::vector<typename FieldPatches<patch_dim, dim>::Patch> &
  FieldPatches<patch_dim, dim>::get_patches() const
  {
    return patches;
  }



  template <int patch_dim, int dim>
  std::vector<std::string>
  FieldPatches<patch_dim, dim>::get_dataset_names() const
  {
    return names;
  }



  template <int patch_dim, int dim>
  std::vector<
    std::tuple<unsigned int,
               unsigned int,
               std::string,
               DataComponentInterpretation::DataComponentInterpretation>>
  FieldPatches<patch_dim, dim>::get_nonscalar_data_ranges() const
  {
    return ranges;
  }



  OutputSeries::OutputSeries(const std::string &name,
                             const std::string &instance,
                             const unsigned int interval)
    : name(instance.empty() ? name : name + "-" + instance)
    , interval(interval)
  {
    std::replace(this->name.begin(), this->name.end(), ' ', '_');
    std::replace(this->name.begin(), this->name.end(), '/', '_');
  }



  bool
  OutputSeries::takes_next(const bool is_last)
  {
    return ++n_due % interval == 0 || is_last;
  }



  namespace
  {
    /** The name of output @p number, without its ending. */
    std::string
    numbered(const std::string &name, const unsigned int number)
    {
      return name + "-" + Utilities::int_to_string(number, 5);
    }
  } // namespace



  template <int patch_dim, int dim>
  void
  OutputSeries::write(FieldPatches<patch_dim, dim> &fields,
                      const double                  time,
                      const std::string            &directory,
                      const MPI_Comm                comm)
  {
    Assert(!name.empty(), ExcInternalError());
    times.push_back(time);
    const unsigned int rank    = Utilities::MPI::this_mpi_process(comm);
    const unsigned int n_ranks = Utilities::MPI::n_mpi_processes(comm);
    const std::string  path    = directory + "/";
    const std::string  stem    = numbered(name, times.size());
    const auto         piece   = [&](const unsigned int r) {
      return stem + "." + Utilities::int_to_string(r, 4) + ".vtu";
    };

    DataOutBase::VtkFlags flags;
    flags.time                = time;
    flags.cycle               = times.size();
    flags.print_date_and_time = false; // equal results, equal files
    flags.compression_level   = decltype(flags.compression_level)::best_speed;
    fields.set_flags(flags);
    // readers stumble over a piece without patches, of a rank without material
    const bool has_piece = fields.n_patches() > 0;
    run_on_all_ranks(comm, [&]() {
      if (has_piece)
        write_file_safely(path + piece(rank),
                          [&](std::ostream &out) { fields.write_vtu(out); });
    });

    std::vector<std::string> pieces;
    const auto               have_piece =
      Utilities::MPI::all_gather(comm, static_cast<unsigned int>(has_piece));
    for (unsigned int r = 0; r < n_ranks; ++r)
      if (have_piece[r])
        pieces.push_back(piece(r));
    std::vector<std::pair<double, std::string>> records;
    for (unsigned int k = 0; k < times.size(); ++k)
      records.emplace_back(times[k], numbered(name, k + 1) + ".pvtu");
    run_on_all_ranks(comm, [&]() {
      if (rank > 0)
        return;
      write_file_safely(path + stem + ".pvtu", [&](std::ostream &out) {
        fields.write_pvtu_record(out, pieces);
      });
      write_file_safely(path + name + ".pvd", [&](std::ostream &out) {
        out.precision(12);
        DataOutBase::write_pvd_record(out, records);
      });
    });
  }



  std::string
  OutputSeries::save_state() const
  {
    std::ostringstream state;
    state.precision(std::numeric_limits<double>::max_digits10);
    state << n_due << ' ';
    for (const double time : times)
      state << time << ' ';
    return state.str();
  }



  void
  OutputSeries::load_state(const std::string &text)
  {
    times.clear();
    std::istringstream state(text);
    state >> n_due;
    for (double time; state >> time;)
      times.push_back(time);
  }



  template class FieldPatches<0, 2>;
  template class FieldPatches<0, 3>;
  template class FieldPatches<1, 2>;
  template class FieldPatches<2, 2>;
  template class FieldPatches<2, 3>;
  template class FieldPatches<3, 3>;
  template void
  OutputSeries::write<0, 2>(FieldPatches<0, 2> &,
                            const double,
                            const std::string &,
                            const MPI_Comm);
  template void
  OutputSeries::write<0, 3>(FieldPatches<0, 3> &,
                            const double,
                            const std::string &,
                            const MPI_Comm);
  template void
  OutputSeries::write<1, 2>(FieldPatches<1, 2> &,
                            const double,
                            const std::string &,
                            const MPI_Comm);
  template void
  OutputSeries::write<2, 3>(FieldPatches<2, 3> &,
                            const double,
                            const std::string &,
                            const MPI_Comm);
  template void
  OutputSeries::write<2, 2>(FieldPatches<2, 2> &,
                            const double,
                            const std::string &,
                            const MPI_Comm);
  template void
  OutputSeries::write<3, 3>(FieldPatches<3, 3> &,
                            const double,
                            const std::string &,
                            const MPI_Comm);
} // namespace isochor
