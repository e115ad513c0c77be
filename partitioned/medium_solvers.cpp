#include "partitioned/medium_solvers.hpp"

#include <cstdint>
#include <limits>
#include <memory>
#include <utility>

#include "fem/dimensions.hpp"
#include "linear/choice/general_solvers.hpp"
#include "linear/velocity_pressure/fast_solver.hpp"
#include "linear/velocity_pressure/plane_judge.hpp"
#include "system/numbering.hpp"

namespace fsi {

namespace {

/// Unknowns of both media, the mesh's included.
template <int n>
std::int64_t unknowns_of(const Scene<n>& scene) {
  return static_cast<std::int64_t>(number_fluid_and_domain(scene).size) + number_wall(scene).size;
}

/// Both media factorise, or both iterate, as a system of all their unknowns would: one that iterates beside one that is
/// factorised is solved for each datum by itself, which takes longer than either.
template <int n>
FastOptions for_both(const Scene<n>& scene, FastOptions fast) {
  if (!scene.processes().is_alone()) return fast;
  const bool factorise = unknowns_of(scene) < fast.direct_below.value_or(FastOptions::standard_direct_below(n));
  fast.direct_below = factorise ? std::numeric_limits<std::int64_t>::max() : 0;
  return fast;
}

/// Whether the wall's stiffness decides in place of the size, as in a coupled system of all unknowns.
template <int n>
bool is_judged(const Scene<n>& scene, const PartitionedData& options) {
  return options.linear_solver == "fast" && scene.processes().is_alone() &&
         options.fast.are_judged(n, unknowns_of(scene));
}

/// The wall's, whose word is passed on to the fluid's solver.
template <int n>
class WallJudge : public PlaneJudge<n> {
 public:
  WallJudge(const JacobianBlocks<n>& blocks, std::shared_ptr<bool> word)
      : PlaneJudge<n>(blocks), word_(std::move(word)) {}
  bool iterates() override { return *word_ = PlaneJudge<n>::iterates(); }

 private:
  std::shared_ptr<bool> word_;
};

/// Repeats what the wall's judge has said of the wall's present Jacobian, which is made before the fluid's.
class FluidJudge : public IterationJudge {
 public:
  explicit FluidJudge(std::shared_ptr<bool> word) : word_(std::move(word)) {}
  bool iterates() override { return *word_; }

 private:
  std::shared_ptr<bool> word_;
};

}  // namespace

template <int n>
MediumSolvers<n> medium_solvers(const Scene<n>& scene, const PartitionedData& options) {
  if (!is_judged(scene, options)) {
    const auto of_either = general_solver_factory<n>(options.linear_solver, for_both(scene, options.fast));
    return {of_either, of_either};
  }
  const auto word = std::make_shared<bool>(false);
  const FastOptions fast = options.fast;
  return {[word, fast](const JacobianBlocks<n>& blocks) {
            return std::make_unique<FastSolver<n>>(blocks, fast, std::make_shared<FluidJudge>(word));
          },
          [word, fast](const JacobianBlocks<n>& blocks) {
            return std::make_unique<FastSolver<n>>(blocks, fast, std::make_shared<WallJudge<n>>(blocks, word));
          },
          true};
}

#define FSI_INSTANTIATE(n) \
  template MediumSolvers<n> medium_solvers<n>(const Scene<n>& scene, const PartitionedData& options);
FSI_FOR_EACH_DIMENSION(FSI_INSTANTIATE)
#undef FSI_INSTANTIATE

}  // namespace fsi
