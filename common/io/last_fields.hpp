#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "io/field_grid.hpp"

namespace fsi {

/// A grid of a result folder, and what its fields of cells were when they were written last.
struct LastFields {
  std::filesystem::path file;                         ///< for messages
  FieldGrid grid;                                     ///< name, points and cells
  std::map<std::string, std::vector<double>> values;  ///< by field: a number per cell
};

/// Reads the last file of a run's fields. Of the fields that are named those that it has; grids that have none are left out.
/// \param run  result folder
/// \throws InputError where it is no folder, has no fields.h5, or a damaged one
std::vector<LastFields> last_fields_of_cells(const std::filesystem::path& run, const std::vector<std::string>& names);

}  // namespace fsi
