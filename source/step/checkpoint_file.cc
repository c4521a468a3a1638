/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <isochor/base/safe_file.h>
#include <isochor/step/checkpoint_file.h>

#include <cstring>
#include <fstream>
#include <iterator>

namespace isochor
{
  namespace
  {
    /** How a file starts. Read back on a machine of other byte order or word
     * size, or from another kind of file, it does not compare equal. */
    struct Header
    {
      char magic[8] = {'I', 's', 'o', 'c', 'h', 'o', 'r', '\n'};
      /** Of whatever is saved; tests/checkpoint_format reminds of raising it.
       */
      std::uint64_t version    = 41;
      std::uint64_t byte_order = 0x0102030405060708;
      std::uint64_t dimension  = 0;
      std::uint64_t size       = 0; ///< of the rest, in bytes
      std::uint64_t checksum   = 0; ///< of the rest
    };
  } // namespace



  std::uint64_t
  fnv1a(const void *data, const std::size_t n_bytes, const std::uint64_t hash)
  {
    std::uint64_t        result = hash;
    const unsigned char *bytes  = static_cast<const unsigned char *>(data);
    for (std::size_t i = 0; i < n_bytes; ++i)
      result = (result ^ bytes[i]) * 1099511628211ull;
    return result;
  }



  void
  write_checkpoint_file(const std::string &name,
                        const unsigned int dimension,
                        const std::string &data)
  {
    Header header;
    header.dimension = dimension;
    header.size      = data.size();
    header.checksum  = fnv1a(data.data(), data.size());
    write_file_safely(
      name,
      [&](std::ostream &out) {
        out.write(reinterpret_cast<const char *>(&header), sizeof(header));
        out.write(data.data(), data.size());
      },
      Durability::of_machine);
  }



  std::string
  read_checkpoint_file(const std::string &name,
                       const unsigned int dimension,
                       std::string       &data)
  {
    std::ifstream file(name, std::ios::binary);
    if (!file)
      return "The file <" + name + "> does not exist.";

    Header       header;
    const Header expected;
    file.read(reinterpret_cast<char *>(&header), sizeof(header));
    if (!file || std::memcmp(header.magic, expected.magic, 8) != 0 ||
        header.version != expected.version ||
        header.byte_order != expected.byte_order ||
        header.dimension != dimension)
      return "The file <" + name + "> is no checkpoint of " +
             std::to_string(dimension) +
             "D and of this version of the program and machine.";
    data.assign(std::istreambuf_iterator<char>(file),
                std::istreambuf_iterator<char>());
    if (data.size() != header.size ||
        fnv1a(data.data(), data.size()) != header.checksum)
      return "The file <" + name + "> is damaged.";
    return {};
  }
} // namespace isochor
