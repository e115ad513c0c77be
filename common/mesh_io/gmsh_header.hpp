#pragma once

#include <cstdint>
#include <filesystem>

namespace fsi {

/// Smaller files are not checked here: the reader compares every count with the bytes that are left.
constexpr std::uint64_t large_gmsh_file = std::uint64_t{16} << 20;

/// Bytes that reading a .msh file of this size takes: its text or data, its nodes and elements, and the mesh made of
/// them. Their sizes add up to 2.1 to 2.9 times that of the file, for 4.1 and 2.2, binary and text.
constexpr double gmsh_reading_bytes(std::uint64_t file_bytes) {
  return 3.0 * static_cast<double>(file_bytes);
}

/// Compares what a large .msh file promises with its size and the available memory, having read little of it: the
/// number of nodes, and in binary files of version 4.1 that of elements and the places of the sections. What else may
/// be wrong is found when the file is read. Does nothing for a file that is not large.
/// \param room  available memory, bytes
/// \throws InputError for more nodes or elements than the file has bytes for, for sections that do not end where the
///         counts say, and for a mesh that will not fit into memory
void check_gmsh_header(const std::filesystem::path& path, double room);

}  // namespace fsi
