#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>

#include "parallel/communicator.hpp"
#include "scene/scene.hpp"

namespace fsi {

/// Of the whole scene, what all processes have together. Unknowns of the interface count once, with the wall.
struct SceneSize {
  std::int64_t fluid_nodes = 0, wall_nodes = 0, interface_nodes = 0;
  std::int64_t fluid_unknowns = 0, wall_unknowns = 0, mesh_unknowns = 0;
};
/// For all processes together.
template <int n>
SceneSize size_of(const Scene<n>& scene);

/// What summary.json says of the processes of a run: each number as minimum, mean and maximum over them, but
/// reductions, of which all have as many.
template <int n>
class ProcessSummary {
 public:
  /// By all processes together, once the whole mesh is freed. \param scene  must outlive this
  explicit ProcessSummary(const Scene<n>& scene);

  /// Messages between processes count from now on.
  void steps_begin();
  /// Leaves out the messages since an earlier moment, which belong to no step.
  /// \param before  the scene's traffic at that moment
  void leave_out_since(const Traffic& before);

  /// For all processes together.
  /// \param steps    taken since steps_begin()
  /// \param seconds  that they took here
  nlohmann::json json(std::int64_t steps, double seconds) const;

 private:
  const Scene<n>& scene_;
  double reading_memory_;  ///< MiB
  std::int64_t halo_unknowns_ = 0;
  Traffic before_;
};

}  // namespace fsi
