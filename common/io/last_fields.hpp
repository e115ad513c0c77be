#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "io/field_grid.hpp"

namespace fsi {

/// A grid of a result folder with the last written values of its fields of cells.
struct LastFields {
  std::filesystem::path file;                         ///< for messages
  FieldGrid grid;                                     ///< name, points and cells
  std::map<std::string, std::vector<double>> values;  ///< by field: a number per cell
};

/// Reads fields of cells from the last of a run's files that has any of them. Grids without any of them are left out.
/// \param run    result folder
/// \param names  of the fields; those that the file does not have are left out
/// \throws InputError where it is no folder, has no fields.h5, or a damaged one
std::vector<LastFields> last_fields_of_cells(const std::filesystem::path& run, const std::vector<std::string>& names);

}  // namespace fsi
