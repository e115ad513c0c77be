#pragma once

#include <cmath>
#include <memory>
#include <utility>
#include <vector>

#include "algebra/block_products.hpp"
#include "case/multigrid_kinds.hpp"
#include "monolithic/coupled_solvers/amg/braess_sarazin.hpp"
#include "monolithic/coupled_solvers/amg/coarsening.hpp"
#include "monolithic/coupled_solvers/amg/coarsest.hpp"
#include "monolithic/coupled_solvers/amg/cycle.hpp"
#include "monolithic/coupled_solvers/amg/galerkin.hpp"
#include "monolithic/coupled_solvers/amg/vanka.hpp"

namespace fsi {

struct SaddleAmgOptions {
  CycleOptions cycle;
  CoarseningKind coarsening = CoarseningKind::colouring;
  bool interior_from_interface = true;  ///< see CoarseningOptions
  double strength = 0;                  ///< threshold of strong_graph()
  SaddleSmootherKind smoother = SaddleSmootherKind::braess_sarazin;
  BraessSarazinOptions braess_sarazin;
  VankaOptions vanka;
  /// The scalar-scalar entry of a coarse level is multiplied by (nodes of the finer / nodes of the coarser level) to
  /// this power: 2/3 in three dimensions, 1 in two, where the stabilisation is ~ h^2; 0 where it does not depend on the
  /// mesh size (a fluid whose stabilisation time is half the time step).
  double stabilisation_growth = 2.0 / 3.0;
  /// Factor of the scalar part of coarse corrections, below one where coarse vector spaces lock: their B A^-1 B^T is
  /// then too small and the correction too large.
  double scalar_correction = 1;
};

/// Factor of the scalar-scalar entries of the level below `t`.
double stabilisation_factor(const NodeTransfer& t, double growth);

/// The smoother that the options ask for, without values yet: update() gives it some.
template <int Size>
std::unique_ptr<SaddleSmoother<Size>> make_saddle_smoother(const BlockMatrix<Size, Size>& a,
                                                           const SaddleAmgOptions& options) {
  if (options.smoother == SaddleSmootherKind::vanka) return std::make_unique<Vanka<Size>>(a, options.vanka);
  return std::make_unique<BraessSarazin<Size>>(a, options.braess_sarazin);
}

/// Multigrid for saddle-point problems with blocks (vector, scalar) of `Size` entries a node: fluid and wall.
/// [Wabro2004]: vector and scalar are coarsened alike and never mixed; Galerkin matrices; the stabilisation is
/// rescaled.
template <int Size>
class SaddleAmg : public MultigridCycle {
 public:
  static constexpr int n = Size - 1;
  using Matrix = BlockMatrix<Size, Size>;
  using Transfers = std::vector<std::shared_ptr<const NodeTransfer>>;

  explicit SaddleAmg(const SaddleAmgOptions& options = {}) : MultigridCycle(options.cycle), options_(options) {}

  /// Coarsens and sets up. `finest` stays the owner's; boundary conditions are imposed in it.
  void build(const Matrix& finest, const NodeMarks& marks) {
    start(finest);
    CoarseningOptions rules;
    rules.kind = options_.coarsening;
    rules.interior_from_interface = options_.interior_from_interface;
    Transfers transfers;
    NodeMarks here = marks;
    while (static_cast<int>(matrices_.size()) < options_.cycle.max_levels &&
           matrices_.back()->graph->rows() > options_.cycle.coarsest_nodes) {
      const Matrix& a = *matrices_.back();
      Coarsening next = coarsen(strong_graph(a, n, options_.strength), here, rules);
      if (next.transfer.coarse_nodes > 0.8 * a.graph->rows()) break;
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

  /// Sets up on given matrices of all levels, which their owner keeps up to date, rescaled stabilisation and all.
  void build(const std::vector<const Matrix*>& matrices, const Transfers& transfers) {
    own_.clear();
    products_.clear();
    given_.clear();
    matrices_ = matrices;
    finish(transfers);
  }

  /// The matrix (all matrices, if given from outside) holds new values on the same pattern.
  /// \throws ConvergenceError, as build() does, where a pivot of the coarsest matrix is zero; a matrix that is singular
  /// to working precision throws in cycle()
  void update() {
    for (std::size_t l = 0; l < products_.size(); ++l) compute_level(l);
    for (std::size_t l = 0; l < smoothers_.size(); ++l) smoothers_[l]->update(*matrices_[l]);
    coarsest_.update(*matrices_.back());
  }

  const Matrix& matrix(int level) const { return *matrices_[level]; }
  const SaddleAmgOptions& options() const { return options_; }
  double operator_complexity() const {
    double sum = 0;
    for (const auto* a : matrices_) sum += a->graph->blocks();
    return sum / matrices_.front()->graph->blocks();
  }
  std::size_t bytes() const {
    std::size_t sum = cycle_bytes() + coarsest_.bytes();
    for (const auto& a : own_) sum += a->values.size() * sizeof(double) + a->graph->columns.size() * sizeof(int);
    for (const auto& s : smoothers_) sum += s->bytes();
    return sum;
  }

 protected:
  void apply(int level, const std::vector<double>& x, std::vector<double>& y) const override {
    fsi::multiply(*matrices_[level], x, y);
  }
  void compute_residual(int level, const std::vector<double>& b, const std::vector<double>& x,
                        std::vector<double>& r) const override {
    residual(*matrices_[level], b, x, r);
  }
  void smooth(int level, const std::vector<double>& b, std::vector<double>& x, int steps, bool post,
              bool from_zero) override {
    smoothers_[level]->smooth(*matrices_[level], b, x, steps, post, from_zero);
  }
  void restrict_vector(int level, const std::vector<double>& fine, std::vector<double>& coarse) const override {
    restrict_to<Size, n>(*transfer(level), fine, coarse);
  }
  void prolongate_vector(int level, const std::vector<double>& coarse, std::vector<double>& fine) const override {
    prolongate_add<Size, n>(*transfer(level), coarse, fine, options_.scalar_correction);
  }
  void solve_coarsest(const std::vector<double>& b, std::vector<double>& x) override { coarsest_.solve(b, x); }

 private:
  void start(const Matrix& finest) {
    matrices_.assign(1, &finest);
    own_.clear();
    products_.clear();
    given_.clear();
  }
  void add_level(const std::shared_ptr<const NodeTransfer>& t) {
    given_.push_back(t);
    products_.emplace_back(*matrices_.back()->graph, t, t);
    own_.push_back(std::make_unique<Matrix>(products_.back().make_coarse()));
    compute_level(products_.size() - 1);
    matrices_.push_back(own_.back().get());
  }
  void compute_level(std::size_t l) {
    products_[l].compute(*matrices_[l], *own_[l]);
    set_prescribed_diagonal(*own_[l], given_[l]->coarse_prescribed, n);
    scale_scalar_entries(*own_[l], stabilisation_factor(*given_[l], options_.stabilisation_growth));
  }
  void finish(Transfers transfers) {
    std::vector<int> nodes;
    smoothers_.clear();
    for (const auto* a : matrices_) nodes.push_back(a->graph->rows());
    for (std::size_t l = 0; l + 1 < matrices_.size(); ++l)
      smoothers_.push_back(make_saddle_smoother(*matrices_[l], options_));
    coarsest_ = {};
    set_levels(nodes, Size, std::move(transfers));
    for (std::size_t l = 0; l < smoothers_.size(); ++l) smoothers_[l]->update(*matrices_[l]);
    coarsest_.update(*matrices_.back());
  }

  SaddleAmgOptions options_;
  std::vector<const Matrix*> matrices_;
  std::vector<std::unique_ptr<Matrix>> own_;  ///< Galerkin matrices of levels 1, 2, ...
  std::vector<SaddleGalerkin<Size>> products_;
  Transfers given_;  ///< of products_
  std::vector<std::unique_ptr<SaddleSmoother<Size>>> smoothers_;
  CoarsestSolver<Size> coarsest_;
};

}  // namespace fsi
