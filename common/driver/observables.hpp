#pragma once

#include <vector>

#include "case/case.hpp"
#include "fem/p1_tetrahedron.hpp"
#include "io/result_folder.hpp"
#include "mesh/sampling.hpp"
#include "scene/scene.hpp"

namespace fsi {

/// What the CSV tables show of a state: centre-line pressure, inner-wall displacement, flow. Points are found once;
/// parts that a scene does not have cost nothing.
class Observables {
 public:
  /// \param mesh  the whole mesh that the scene was built on
  Observables(const Case& setup, const TetrahedralMesh& mesh, const Scene<P1Tetrahedron>& scene);

  ResultTables tables() const { return {!centre_line_.empty(), !wall_line_.empty(), scene_.fluid != nullptr}; }
  /// Adds the rows of the state's current time level.
  void write(const State& state, ResultFolder& folder) const;

 private:
  const Scene<P1Tetrahedron>& scene_;
  Axis axis_;
  std::vector<double> centre_z_, wall_z_;  ///< mm along the axis
  std::vector<PointSample> centre_line_;   ///< fluid nodes
  std::vector<WallSample> wall_line_;      ///< wall nodes, `angles` samples for each z
  static constexpr int angles = 16;
};

}  // namespace fsi
