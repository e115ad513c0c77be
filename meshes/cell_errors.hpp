#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "mesh_io/gmsh_reader.hpp"

namespace fsi {

/// How the error indicators of a run (output.error_indicator) are shared among the cells of its mesh.
struct ErrorShares {
  std::vector<double> shares;       ///< per cell of the mesh, of sum |K| eta_K^2; the sum over all cells is 1
  std::vector<std::string> fields;  ///< those that were read, GRID.FIELD
  double order = 3;                 ///< of the quantities' errors: the least of those of the fields
};

/// Of each field, a quantity on the grid of a medium, the share |K| eta_K^2 over its sum, and the mean of these shares
/// over the fields: so they count alike, whatever their units. eta_K is the mean over time in the run's last entry;
/// without one, the value there. Fields that are zero do not count.
/// \param run         result folder
/// \param quantities  of "velocity", "displacement", "pressure"; empty: all that are there
/// \throws InputError where the run has no such fields, or is of another mesh
ErrorShares read_error_shares(const AnyMesh& mesh, const std::filesystem::path& run,
                              const std::vector<std::string>& quantities);

}  // namespace fsi
