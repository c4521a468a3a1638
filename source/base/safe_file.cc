/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <deal.II/base/exceptions.h>

#include <isochor/base/plain_message.h>
#include <isochor/base/safe_file.h>

#include <fcntl.h>
#include <unistd.h>

#include <cstdio>
#include <fstream>
#include <sstream>

namespace isochor
{
  namespace
  {
    /** Force a file or directory onto the disk. */
    bool
    synchronise(const std::string &name)
    {
      const int descriptor = ::open(name.c_str(), O_RDONLY);
      if (descriptor < 0)
        return false;
      const bool success = ::fsync(descriptor) == 0;
      return ::close(descriptor) == 0 && success;
    }



    std::string
    directory_of(const std::string &file_name)
    {
      const auto slash = file_name.rfind('/');
      return slash == std::string::npos ? "." : file_name.substr(0, slash + 1);
    }
  } // namespace



  void
  write_file_safely(const std::string                         &file_name,
                    const std::function<void(std::ostream &)> &write,
                    const Durability                           durability)
  {
    const std::string temporary = file_name + ".part";
    bool              success   = false;
    try
      {
        std::ofstream file(temporary, std::ios::binary);
        write(file);
        file.close(); // what fails in here counts, too
        success = file.good() && (durability == Durability::of_program ||
                                  synchronise(temporary));
      }
    catch (const StandardExceptions::ExcIO &)
      {
        success = false; // said below in fewer words
      }
    catch (...)
      {
        std::remove(temporary.c_str());
        throw;
      }
    success = success &&
              std::rename(temporary.c_str(), file_name.c_str()) == 0 &&
              (durability == Durability::of_program ||
               synchronise(directory_of(file_name)));
    if (!success)
      std::remove(temporary.c_str());
    AssertThrow(success,
                ExcMessage("Can't write the file <" + file_name +
                           ">. Is the disk full, or the directory missing or "
                           "not yours?"));
  }



  void
  run_on_all_ranks(const MPI_Comm &comm, const std::function<void()> &action)
  {
    std::string error;
    try
      {
        action();
      }
    catch (const std::exception &exception)
      {
        error = error_message(exception);
        if (error.empty())
          error = "unknown error";
      }
    const unsigned int n_ranks = Utilities::MPI::n_mpi_processes(comm);
    const unsigned int first   = Utilities::MPI::min(
      error.empty() ? n_ranks : Utilities::MPI::this_mpi_process(comm), comm);
    if (first < n_ranks)
      AssertThrow(false,
                  ExcMessage(Utilities::MPI::broadcast(comm, error, first)));
  }
} // namespace isochor
