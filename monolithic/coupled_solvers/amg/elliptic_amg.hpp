#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <utility>
#include <vector>

#include "algebra/block_products.hpp"
#include "linear/krylov/power_iteration.hpp"
#include "monolithic/coupled_solvers/amg/coarsening.hpp"
#include "monolithic/coupled_solvers/amg/coarsest.hpp"
#include "monolithic/coupled_solvers/amg/cycle.hpp"
#include "monolithic/coupled_solvers/amg/galerkin.hpp"
#include "monolithic/coupled_solvers/amg/gauss_seidel.hpp"

namespace fsi {

struct EllipticAmgOptions {
  CycleOptions cycle;
  CoarseningKind coarsening = CoarseningKind::colouring;
  bool interior_from_interface = false;  ///< see CoarseningOptions
  /// Smooths the prolongation by I - smoothing/lambda D^-1 A with the largest eigenvalue lambda of D^-1 A; 4/3 is the
  /// classical choice with aggregation, 0 leaves it as it is.
  double smoothing = 0;
};

/// Multigrid for an elliptic problem whose `Components` components do not couple: mesh motion. Gauss-Seidel, forwards
/// before and backwards after the coarse correction, so that a V-cycle with as many steps before as after is symmetric
/// where the matrix is.
/// \tparam Numbers  numbers a node pair: 1 for all components, or one for each (axisymmetric)
template <int Components, int Numbers = 1>
class EllipticAmg : public MultigridCycle {
 public:
  using Matrix = BlockMatrix<1, Numbers>;
  using Transfers = std::vector<std::shared_ptr<const NodeTransfer>>;

  explicit EllipticAmg(const EllipticAmgOptions& options = {}) : MultigridCycle(options.cycle), options_(options) {}

  /// Coarsens and sets up. `finest` stays the owner's; boundary conditions are imposed in it.
  void build(const Matrix& finest, const NodeMarks& marks) {
    start(finest);
    CoarseningOptions rules;
    rules.kind = options_.coarsening;
    rules.interior_from_interface = options_.interior_from_interface;
    rules.scalar_part = false;
    Transfers transfers;
    NodeMarks here = marks;
    while (static_cast<int>(matrices_.size()) < options_.cycle.max_levels &&
           matrices_.back()->graph->rows() > options_.cycle.coarsest_nodes) {
      const Matrix& a = *matrices_.back();
      Coarsening next = coarsen(*a.graph, here, rules);
      if (options_.smoothing > 0) {
        next.transfer = smoothed(a, here, next.transfer, rules, options_.smoothing / largest_eigenvalue_of(a));
        next.marks.prescribed = next.transfer.coarse_prescribed;
      }
      if (next.transfer.coarse_nodes == 0 || next.transfer.coarse_nodes > 0.8 * a.graph->rows()) break;
      transfers.push_back(std::make_shared<NodeTransfer>(std::move(next.transfer)));
      add_level(transfers.back());
      here = std::move(next.marks);
    }
    finish(std::move(transfers));
  }

  /// Sets up on given transfers; coarse matrices are own Galerkin products.
  void build(const Matrix& finest, const Transfers& transfers) {
    start(finest);
    for (const auto& t : transfers) add_level(t);
    finish(transfers);
  }

  /// Sets up on given matrices of all levels, which their owner keeps up to date.
  void build(const std::vector<const Matrix*>& matrices, const Transfers& transfers) {
    own_.clear();
    products_.clear();
    matrices_ = matrices;
    finish(transfers);
  }

  /// The matrix (all matrices, if given from outside) holds new values on the same pattern.
  /// \throws ConvergenceError, as build() does, where a pivot of the coarsest matrix is zero; a matrix that is singular
  /// to working precision throws in cycle()
  void update() {
    for (std::size_t l = 0; l < products_.size(); ++l) {
      products_[l].compute(*matrices_[l], *own_[l]);
      set_prescribed_numbers(*own_[l], products_transfers_[l]->coarse_prescribed);
    }
    for (std::size_t l = 0; l < smoothers_.size(); ++l) smoothers_[l].update(*matrices_[l]);
    const Matrix& coarsest = *matrices_.back();
    for (int k = 0; k < Numbers; ++k) {
      component_ = BlockMatrix<1, 1>(coarsest.graph);
      for (int at = 0; at < coarsest.graph->blocks(); ++at) component_.values[at] = coarsest.block(at)[k];
      coarsest_[k].update(component_);
    }
  }

  const Matrix& matrix(int level) const { return *matrices_[level]; }
  double operator_complexity() const {
    double sum = 0;
    for (const auto* a : matrices_) sum += a->graph->blocks();
    return sum / matrices_.front()->graph->blocks();
  }
  std::size_t bytes() const {
    std::size_t sum = cycle_bytes();
    for (const auto& a : own_) sum += a->values.size() * sizeof(double) + a->graph->columns.size() * sizeof(int);
    for (const auto& s : smoothers_) sum += s.bytes();
    for (const auto& c : coarsest_) sum += c.bytes();
    return sum;
  }

 protected:
  void apply(int level, const std::vector<double>& x, std::vector<double>& y) const override {
    multiply_components<Components>(*matrices_[level], x, y);
  }
  void compute_residual(int level, const std::vector<double>& b, const std::vector<double>& x,
                        std::vector<double>& r) const override {
    residual_components<Components>(*matrices_[level], b, x, r);
  }
  void smooth(int level, const std::vector<double>& b, std::vector<double>& x, int steps, bool post, bool) override {
    smoothers_[level].smooth(*matrices_[level], b, x, steps, post);
  }
  void restrict_vector(int level, const std::vector<double>& fine, std::vector<double>& coarse) const override {
    restrict_to<Components, Components>(*transfer(level), fine, coarse);
  }
  void prolongate_vector(int level, const std::vector<double>& coarse, std::vector<double>& fine) const override {
    prolongate_add<Components, Components>(*transfer(level), coarse, fine);
  }
  void solve_coarsest(const std::vector<double>& b, std::vector<double>& x) override {
    const std::size_t nodes = component_b_.size();
    for (int k = 0; k < Components; ++k) {
      for (std::size_t i = 0; i < nodes; ++i) component_b_[i] = b[i * Components + k];
      coarsest_[Numbers == 1 ? 0 : k].solve(component_b_, component_x_);
      for (std::size_t i = 0; i < nodes; ++i) x[i * Components + k] = component_x_[i];
    }
  }

 private:
  void start(const Matrix& finest) {
    matrices_.assign(1, &finest);
    own_.clear();
    products_.clear();
    products_transfers_.clear();
  }
  void add_level(const std::shared_ptr<const NodeTransfer>& t) {
    products_.emplace_back(*matrices_.back()->graph, t, t);
    products_transfers_.push_back(t);
    own_.push_back(std::make_unique<Matrix>(products_.back().make_coarse()));
    products_.back().compute(*matrices_.back(), *own_.back());
    set_prescribed_numbers(*own_.back(), t->coarse_prescribed);
    matrices_.push_back(own_.back().get());
  }
  void finish(Transfers transfers) {
    std::vector<int> nodes;
    smoothers_.clear();
    for (const auto* a : matrices_) nodes.push_back(a->graph->rows());
    for (std::size_t l = 0; l + 1 < matrices_.size(); ++l) smoothers_.emplace_back(*matrices_[l]);
    coarsest_ = {};
    component_b_.resize(nodes.back());
    component_x_.resize(nodes.back());
    set_levels(nodes, Components, std::move(transfers));
    update();
  }

  /// Largest eigenvalue of D^-1 A, first component.
  static double largest_eigenvalue_of(const Matrix& a) {
    std::vector<double> start(a.graph->rows());
    RoughSequence rough;
    for (double& v : start) v = rough();
    return largest_eigenvalue(std::move(start), 15, [&](const auto& x, auto& y) {
      for (int i = 0; i < a.graph->rows(); ++i) {
        double sum = 0;
        for (int at = a.graph->offsets[i]; at < a.graph->offsets[i + 1]; ++at)
          sum += a.block(at)[0] * x[a.graph->columns[at]];
        y[i] = sum / a.block(a.graph->find(i, i))[0];
      }
    });
  }

  EllipticAmgOptions options_;
  std::vector<const Matrix*> matrices_;
  std::vector<std::unique_ptr<Matrix>> own_;  ///< Galerkin matrices of levels 1, 2, ...
  std::vector<EllipticGalerkin<Numbers>> products_;
  Transfers products_transfers_;
  std::vector<GaussSeidel<Components, Numbers>> smoothers_;
  std::array<CoarsestSolver<1>, Numbers> coarsest_;
  BlockMatrix<1, 1> component_;
  std::vector<double> component_b_, component_x_;
};

}  // namespace fsi
