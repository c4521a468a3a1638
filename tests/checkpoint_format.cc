/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */

// A checkpoint that another version of the program has written is told from one
// of this version, and ends no run that isn't to go on from it. What is saved
// is listed: if this changes, raise `version` in
// source/step/checkpoint_file.cc.

#include <isochor/step/checkpoint_file.h>
#include <isochor/step/step_setup.h>

#include <filesystem>
#include <fstream>
#include <iostream>
#include <type_traits>

#include "checkpoint_scene.h"

namespace
{
  template <typename T, typename = void>
  struct IsContainer : std::false_type
  {};
  template <typename T>
  struct IsContainer<T, std::void_t<typename T::value_type>> : std::true_type
  {};



  /** An archive that notes the sizes of the numbers that are saved, those of
   * one entry of each container in brackets. */
  class Layout
  {
  public:
    std::string text;

    template <typename T>
    Layout &
    operator&(T &value)
    {
      if constexpr (std::is_arithmetic<T>::value || std::is_enum<T>::value)
        text += std::to_string(sizeof(value)) + " ";
      else if constexpr (IsContainer<T>::value)
        {
          typename T::value_type entry{};
          text += "[";
          *this &entry;
          text += "]";
        }
      else
        value.serialize(*this, 0);
      return *this;
    }

    template <typename Key, typename T>
    Layout &
    operator&(std::pair<Key, T> &value)
    {
      std::remove_const_t<Key> key{};
      return *this & key & value.second;
    }
  };



  template <typename T>
  void
  print_layout(const std::string &name, T value = T())
  {
    Layout  layout;
    layout &value;
    std::cout << name << ": " << layout.text << std::endl;
  }



  std::string
  file_of_slot(const std::string &directory, const unsigned int slot)
  {
    return directory + "/checkpoint-" + std::to_string(slot) + ".0000.bin";
  }



  void
  check(const std::string &what, const bool is_right, const std::string &error)
  {
    std::cout << what << ": " << (is_right ? "OK" : "WRONG: " + error)
              << std::endl;
  }



  /** Runs where both checkpoints are files that @p write. */
  template <typename Write>
  void
  test_foreign(const std::string &what,
               const Write       &write,
               const std::string &expected)
  {
    const std::string directory = "checkpoint_format-a";
    create_output_directory(directory, MPI_COMM_WORLD);
    for (unsigned int slot = 0; slot < 2; ++slot)
      {
        write(file_of_slot(directory, slot));
        std::filesystem::remove(file_of_slot(directory, slot) + ".old");
      }
    const std::string error =
      run(MPI_COMM_WORLD, directory, {{"Checkpoint/Resume", "true"}}).error;
    check(what + ", resumed", error.find(expected) != std::string::npos, error);
    const std::string of_fresh = run(MPI_COMM_WORLD, directory).error;
    check(what + ", not resumed", of_fresh.empty(), of_fresh);
    check(what + ", put aside",
          std::ifstream(file_of_slot(directory, 0) + ".old").good(),
          "not there");
  }
} // namespace



int
main(int argc, char **argv)
{
  Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);

  print_layout<LoadStepping>("time");
  print_layout<LastMotion>("last motion");
  print_layout<GridReset<2>>("grid reset");
  print_layout<PointArrays<2>>("points of a kept grid");

  // a valid file with less in it than this version saves
  for (const std::size_t n : {0, 40, 4000})
    test_foreign(
      std::to_string(n) + " foreign bytes",
      [&](const std::string &name) {
        write_checkpoint_file(name, dim, std::string(n, '\x5a'));
      },
      "another version of the program");
  test_foreign(
    "another kind of file",
    [&](const std::string &name) { std::ofstream(name) << "text"; },
    "is no checkpoint of 2D and of this version");
  return 0;
}
