/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_field_output_h
#define isochor_field_output_h

#include <deal.II/base/data_out_base.h>
#include <deal.II/base/mpi.h>

#include <string>
#include <tuple>
#include <utility>
#include <vector>

namespace isochor
{
  using namespace dealii;

  /**
   * Named fields on points (@p patch_dim = 0) or simplices (cells, or of one
   * dimension less facets of a surface): what is needed to let deal.II write
   * them. Declare the fields first, then add the patches.
   */
  template <int patch_dim, int dim>
  class FieldPatches : public DataOutInterface<patch_dim, dim>
  {
  public:
    using Patch = DataOutBase::Patch<patch_dim, dim>;

    /** Add a field; returns the row of its (first) component in a patch. */
    unsigned int
    add_scalar(const std::string &name);
    /** Of @p dim components. */
    unsigned int
    add_vector(const std::string &name);
    /** A 3D tensor: nine components by rows. */
    unsigned int
    add_tensor(const std::string &name);

    void
    reserve(const unsigned int n_patches);

    /** Append a patch with these vertices (patch_dim + 1). Set
     * data(row, vertex) of what is returned; the reference is valid until the
     * next call. */
    Patch &
    add_patch(const ArrayView<const Point<dim>> &vertices);

    unsigned int
    n_patches() const;

  protected:
    const std::vector<Patch> &
    get_patches() const override;

    std::vector<std::string>
    get_dataset_names() const override;

    std::vector<
      std::tuple<unsigned int,
                 unsigned int,
                 std::string,
                 DataComponentInterpretation::DataComponentInterpretation>>
    get_nonscalar_data_ranges() const override;

  private:
    unsigned int
    add(const std::string &name,
        const unsigned int n_components,
        const DataComponentInterpretation::DataComponentInterpretation type);

    std::vector<Patch>       patches;
    std::vector<std::string> names;
    std::vector<
      std::tuple<unsigned int,
                 unsigned int,
                 std::string,
                 DataComponentInterpretation::DataComponentInterpretation>>
      ranges;
  };



  /**
   * The outputs of a run, for ParaView and the like: the k-th is
   * `<name>-<k>.pvtu` with a .vtu file from each rank that has any, and
   * `<name>.pvd` lists them with their times.
   */
  class OutputSeries
  {
  public:
    /** In a named instance of a post-processor the files are called
     * `<name>-<instance>`. One of @p interval output times is taken. */
    explicit OutputSeries(const std::string &name,
                          const std::string &instance = "",
                          const unsigned int interval = 1);

    /** An output time has come: whether something is to be written, the last
     * time in any case. To be called at each output time. */
    bool
    takes_next(const bool is_last);

    /** Write the next output. Throws on all ranks if a file can't be written
     * on any. Collective. */
    template <int patch_dim, int dim>
    void
    write(FieldPatches<patch_dim, dim> &fields,
          const double                  time,
          const std::string            &directory,
          const MPI_Comm                comm);

    /** The outputs so far, as text. */
    std::string
    save_state() const;
    void
    load_state(const std::string &state);

  private:
    std::string         name;
    unsigned int        interval;
    unsigned int        n_due = 0; ///< output times so far
    std::vector<double> times;     ///< those taken
  };
} // namespace isochor

#endif
