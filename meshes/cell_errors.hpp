#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "mesher/geo_script.hpp"

namespace fsi {

/// What the cells of a mesh have of the error indicators that a run has left (output.error_indicator).
struct ErrorShares {
  std::vector<double> shares;       ///< per cell of the mesh, of sum |K| eta_K^2; the sum over all cells is 1
  std::vector<std::string> fields;  ///< those that were read, GRID.FIELD
  double order = 3;                 ///< of the quantities' errors: the least of those of the fields
};

/// Of each quantity the share |K| eta_K^2 over its sum over all cells, and the mean of these shares over the quantities: so
/// they count alike, whatever their units. The mean over time of the run's last entry is taken, or the last level of a run
/// without time.
/// \param run         result folder
/// \param quantities  of "velocity", "displacement", "pressure"; empty: all that are there
/// \throws InputError where the run has no such fields, or is of another mesh
ErrorShares read_error_shares(const AnyMesh& mesh, const std::filesystem::path& run,
                              const std::vector<std::string>& quantities);

}  // namespace fsi
