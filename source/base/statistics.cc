/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <deal.II/base/exceptions.h>

#include <isochor/base/safe_file.h>
#include <isochor/base/statistics.h>

#include <algorithm>
#include <cstdio>

namespace isochor
{
  using namespace dealii;

  void
  Statistics::open(const std::string &name, const unsigned int n_rows)
  {
    file_name = name;
    std::string kept;
    columns.clear();
    if (n_rows > 0)
      {
        // drop what an interrupted run wrote after its last checkpoint
        std::ifstream old(file_name);
        std::string   line;
        unsigned int  n_kept = 0;
        while (n_kept < n_rows && std::getline(old, line))
          {
            if (line[0] == '#')
              columns.push_back(line.substr(line.find(": ") + 2));
            else
              ++n_kept;
            kept += line + "\n";
          }
        AssertThrow(n_kept == n_rows,
                    ExcMessage("The file <" + file_name + "> has " +
                               std::to_string(n_kept) +
                               " rows, but the "
                               "checkpoint was made after " +
                               std::to_string(n_rows) + "."));
        n_columns_written = columns.size();
      }
    write_file_safely(file_name, [&](std::ostream &out) { out << kept; });
    file.open(file_name, std::ios::app);
    AssertThrow(file, ExcMessage("Can't write the file <" + file_name + ">."));
  }



  void
  Statistics::set(const std::string &name, const double value)
  {
    const std::string column = prefix + name;
    if (std::find(columns.begin(), columns.end(), column) == columns.end())
      columns.push_back(column);
    row[column] = value;
  }



  double
  Statistics::get(const std::string &column) const
  {
    const auto present = row.find(column);
    if (present != row.end())
      return present->second;
    const auto last = last_row.find(column);
    AssertThrow(last != last_row.end(),
                ExcMessage("There is no column <" + column +
                           "> in the statistics."));
    return last->second;
  }



  void
  Statistics::rewrite()
  {
    // the rows that are there get nan in the columns that are new
    std::string rows;
    if (n_columns_written > 0)
      {
        std::string missing;
        for (std::size_t i = n_columns_written; i < columns.size(); ++i)
          missing += "nan ";
        std::ifstream old(file_name);
        for (std::string line; std::getline(old, line);)
          if (line[0] != '#')
            rows += line + missing + "\n";
      }
    file.close();
    write_file_safely(file_name, [&](std::ostream &out) {
      for (unsigned int i = 0; i < columns.size(); ++i)
        out << "# " << i + 1 << ": " << columns[i] << '\n';
      out << rows;
    });
    file.open(file_name, std::ios::app);
    n_columns_written = columns.size();
  }



  void
  Statistics::end_row()
  {
    if (file.is_open())
      {
        if (n_columns_written < columns.size())
          rewrite();
        char value[40];
        for (const std::string &column : columns)
          {
            const auto entry = row.find(column);
            if (entry == row.end())
              {
                file << "nan ";
                continue;
              }
            std::snprintf(value, sizeof(value), "%.12g", entry->second);
            file << value << ' ';
          }
        file << std::endl;
        AssertThrow(file,
                    ExcMessage("Can't write to the file <" + file_name +
                               ">. Is the disk full?"));
      }
    last_row.swap(row);
    row.clear();
  }
} // namespace isochor
