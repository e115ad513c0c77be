#pragma once

#include <cstddef>
#include <memory>
#include <utility>
#include <vector>

#include "case/multigrid_kinds.hpp"
#include "linear/direct/direct_solver.hpp"
#include "monolithic/coupled_solvers/amg/transfer.hpp"

namespace fsi {

struct CycleOptions {
  CycleKind kind = CycleKind::v;
  int pre_smoothing = 1;
  int post_smoothing = 1;
  int max_levels = 12;
  int coarsest_nodes = 300;   ///< levels of at most so many nodes are solved directly
  double k_threshold = 0.25;  ///< the second inner iteration of a K-cycle is skipped below this residual reduction
};

/// The multigrid iteration over levels of nodes; [Langer2018], algorithms 3 and 4.
/// Knows transfers and vectors; matrices and smoothers are the hierarchy's. Level 0 is the finest.
class MultigridCycle {
 public:
  explicit MultigridCycle(const CycleOptions& options) : cycle_options_(options) {}
  virtual ~MultigridCycle() = default;
  MultigridCycle(const MultigridCycle&) = delete;
  MultigridCycle& operator=(const MultigridCycle&) = delete;

  int levels() const { return static_cast<int>(work_.size()); }
  const std::shared_ptr<const NodeTransfer>& transfer(int level) const { return transfers_[level]; }
  const std::vector<std::shared_ptr<const NodeTransfer>>& transfers() const { return transfers_; }
  /// Kind and steps may change between cycles.
  void set_cycle(CycleKind kind, int pre_smoothing, int post_smoothing);

  /// One cycle for A_level x = b, from x = 0 or from the given x; on the coarsest level the direct solution. Sizes must
  /// fit; does not allocate. \throws ConvergenceError where the coarsest matrix is singular to working precision
  void cycle(int level, const std::vector<double>& b, std::vector<double>& x, bool from_zero = true);
  /// y = A_level x
  void multiply(int level, const std::vector<double>& x, std::vector<double>& y) const { apply(level, x, y); }
  /// Cycles asked for so far, over all levels; inner ones not counted.
  long long cycles() const { return cycles_; }

 protected:
  /// Makes vectors for levels of `nodes[l]` nodes with `entries` entries each.
  void set_levels(const std::vector<int>& nodes, int entries,
                  std::vector<std::shared_ptr<const NodeTransfer>> transfers);
  std::size_t cycle_bytes() const;

  virtual void apply(int level, const std::vector<double>& x, std::vector<double>& y) const = 0;
  virtual void compute_residual(int level, const std::vector<double>& b, const std::vector<double>& x,
                                std::vector<double>& r) const = 0;
  virtual void smooth(int level, const std::vector<double>& b, std::vector<double>& x, int steps, bool post,
                      bool from_zero) = 0;
  virtual void restrict_vector(int level, const std::vector<double>& fine, std::vector<double>& coarse) const = 0;
  virtual void prolongate_vector(int level, const std::vector<double>& coarse, std::vector<double>& fine) const = 0;
  virtual void solve_coarsest(const std::vector<double>& b, std::vector<double>& x) = 0;

 private:
  struct Work {
    std::vector<double> b, x, r;         ///< of this level's problem in a cycle from above
    std::vector<double> c1, c2, v1, v2;  ///< of the K-cycle
  };
  void run(int level, const std::vector<double>& b, std::vector<double>& x, bool from_zero);
  void accelerate(int level);

  CycleOptions cycle_options_;
  std::vector<std::shared_ptr<const NodeTransfer>> transfers_;
  std::vector<Work> work_;
  long long cycles_ = 0;
};

}  // namespace fsi
