#pragma once

#include <string>

#include "mesher/wall_growth.hpp"

namespace CLI {
class App;
}

namespace fsi {

/// A wall whose thickness varies.
struct ThicknessOptions {
  double ratio = 0;  ///< thickness over local radius
  std::string file;  ///< .csv or .vtp
  std::string field = "thickness";
  std::string unit, points_unit;  ///< of lengths in the file; empty: mm, of points that of the thickness
  int smoothing = 5;
  bool varies() const { return ratio > 0 || !file.empty(); }
};

/// --thickness-ratio, --thickness-from, --thickness-field, --thickness-unit, --thickness-points-unit and
/// --thickness-smoothing.
void add_thickness_options(CLI::App& command, ThicknessOptions& options);

/// The whole wall's thickness at each node that it grows on, mm; empty where it does not vary.
/// \throws InputError for shares of layers that do not add up to 1, and for what is missing in the file
std::map<int, double> total_thickness(const TetrahedralMesh& lumen, const WallGrowth& growth,
                                      const ThicknessOptions& options);

}  // namespace fsi
