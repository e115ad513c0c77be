#include "partitioned/medium_solvers.hpp"

#include <cstdint>
#include <memory>

#include "fem/dimensions.hpp"
#include "linear/choice/general_solvers.hpp"
#include "linear/velocity_pressure/fast_solver.hpp"
#include "linear/velocity_pressure/jacobian_policy.hpp"
#include "system/numbering.hpp"

namespace fsi {

namespace {

/// Unknowns of both media, the mesh's included.
template <int n>
std::int64_t unknowns_of(const Scene<n>& scene) {
  return static_cast<std::int64_t>(number_fluid_and_domain(scene).size) + number_wall(scene).size;
}

}  // namespace

template <int n>
MediumSolvers<n> medium_solvers(const Scene<n>& scene, const PartitionedData& options) {
  if (options.linear_solver != "fast" || !scene.processes().is_alone()) {
    const auto of_either = general_solver_factory<n>(options.linear_solver, options.fast);
    return {of_either, of_either};
  }
  const std::int64_t size = unknowns_of(scene);
  const auto of_wall = std::make_shared<SolverDecision>();
  const auto of_either = [of_wall, fast = options.fast, size](const JacobianBlocks<n>& blocks) {
    return std::make_unique<FastSolver<n>>(blocks, fast, JacobianPolicy<n>(blocks, fast, size, of_wall));
  };
  return {of_either, of_either,
          SolverPolicy(SolvedSystem::jacobian, n, {options.fast.direct_below}).wall_decides(size)};
}

#define FSI_INSTANTIATE(n) \
  template MediumSolvers<n> medium_solvers<n>(const Scene<n>& scene, const PartitionedData& options);
FSI_FOR_EACH_DIMENSION(FSI_INSTANTIATE)
#undef FSI_INSTANTIATE

}  // namespace fsi
