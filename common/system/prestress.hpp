#pragma once

#include <functional>
#include <vector>

#include "linear/interface/linear_solver.hpp"
#include "scene/scene.hpp"

namespace fsi {

/// A wall under load in the shape of its mesh (docs/theory.md, section 4.6).
struct WallPrestress {
  std::vector<double> displacement;  ///< from the unloaded shape to the mesh, vector layout, mm
  std::vector<double> wall;          ///< (0, p) under that load, mixed layout, kPa
  int newton_iterations = 0;         ///< that it took to find them; 0: they were known
};

/// How far the search for it has come: an iteration of Newton's method.
struct PrestressProgress {
  double load = 0;      ///< share of the load that is tried, 0 to 1
  int iteration = 0;    ///< at this share, from 1
  double residual = 0;  ///< over that at the start of this share
};
using PrestressObserver = std::function<void(const PrestressProgress&)>;

/// Finds the shape that the scene's wall has without load, given that under the load it has the one of its mesh. The
/// wall itself is not changed.
/// \param pressure       kPa, on the wall's pressurised facets
/// \param support_loads  kPa, in the order of the wall's supports
/// \param make_solver    of the linearised equations; empty: the direct one
/// \param observe        called after each iteration; may be empty
/// \throws ConvergenceError where none is found, as for walls too soft to bear the load in any shape
template <int n>
WallPrestress find_prestress(Scene<n>& scene, double pressure, const std::vector<double>& support_loads,
                             const LinearSolverFactory<n>& make_solver = {}, const PrestressObserver& observe = {});

/// Puts the wall under this prestress, and the scene at rest under the load that belongs to it: the fluid under the
/// same pressure everywhere.
template <int n>
void start_from(const WallPrestress& prestress, double pressure, const std::vector<double>& support_loads,
                Scene<n>& scene);

}  // namespace fsi
