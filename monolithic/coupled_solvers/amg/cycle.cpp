#include "monolithic/coupled_solvers/amg/cycle.hpp"

#include "algebra/vector_operations.hpp"

namespace fsi {

void MultigridCycle::set_levels(const std::vector<int>& nodes, int entries,
                                std::vector<std::shared_ptr<const NodeTransfer>> transfers) {
  transfers_ = std::move(transfers);
  work_.assign(nodes.size(), {});
  for (std::size_t l = 0; l < nodes.size(); ++l) {
    const std::size_t size = static_cast<std::size_t>(nodes[l]) * entries;
    work_[l].r.resize(size);
    if (l == 0) continue;
    work_[l].b.resize(size);
    work_[l].x.resize(size);
  }
  set_cycle(cycle_options_.kind, cycle_options_.pre_smoothing, cycle_options_.post_smoothing);
}

void MultigridCycle::set_cycle(CycleKind kind, int pre_smoothing, int post_smoothing) {
  cycle_options_.kind = kind;
  cycle_options_.pre_smoothing = pre_smoothing;
  cycle_options_.post_smoothing = post_smoothing;
  if (kind != CycleKind::k) return;
  for (std::size_t l = 1; l + 1 < work_.size(); ++l)
    for (auto* v : {&work_[l].c1, &work_[l].c2, &work_[l].v1, &work_[l].v2}) v->resize(work_[l].r.size());
}

std::size_t MultigridCycle::cycle_bytes() const {
  std::size_t bytes = 0;
  for (const auto& w : work_)
    for (const auto* v : {&w.b, &w.x, &w.r, &w.c1, &w.c2, &w.v1, &w.v2}) bytes += v->size() * sizeof(double);
  for (const auto& t : transfers_) bytes += t->bytes();
  return bytes;
}

void MultigridCycle::cycle(int level, const std::vector<double>& b, std::vector<double>& x, bool from_zero) {
  ++cycles_;
  run(level, b, x, from_zero);
}

void MultigridCycle::run(int level, const std::vector<double>& b, std::vector<double>& x, bool from_zero) {
  if (level + 1 == levels()) {
    solve_coarsest(b, x);
    return;
  }
  if (from_zero) set_zero(x);
  const int pre = cycle_options_.pre_smoothing, post = cycle_options_.post_smoothing;
  if (pre > 0) smooth(level, b, x, pre, false, from_zero);

  Work& here = work_[level];
  Work& below = work_[level + 1];
  compute_residual(level, b, x, here.r);
  restrict_vector(level, here.r, below.b);
  const bool direct = level + 2 == levels();
  if (cycle_options_.kind == CycleKind::k && !direct) {
    accelerate(level + 1);
  } else {
    run(level + 1, below.b, below.x, true);
    if (cycle_options_.kind == CycleKind::w && !direct) run(level + 1, below.b, below.x, false);
  }
  prolongate_vector(level, below.x, x);
  if (post > 0) smooth(level, b, x, post, true, false);
}

/// At most two iterations of FGMRES(A_l, b_l) with a cycle as preconditioner, written as generalised conjugate
/// residuals, which gives the same iterates; [Notay2008].
void MultigridCycle::accelerate(int level) {
  Work& w = work_[level];
  const double before = dot(w.b, w.b);
  run(level, w.b, w.c1, true);
  apply(level, w.c1, w.v1);
  const double v1v1 = dot(w.v1, w.v1);
  const double a1 = v1v1 > 0 ? dot(w.v1, w.b) / v1v1 : 0;
  scaled_copy(a1, w.c1, w.x);
  axpy(-a1, w.v1, w.b);  // b is the residual from here on
  const double threshold = cycle_options_.k_threshold;
  if (dot(w.b, w.b) <= threshold * threshold * before) return;
  run(level, w.b, w.c2, true);
  apply(level, w.c2, w.v2);
  const double overlap = v1v1 > 0 ? dot(w.v1, w.v2) / v1v1 : 0;
  axpy(-overlap, w.v1, w.v2);
  axpy(-overlap, w.c1, w.c2);
  const double v2v2 = dot(w.v2, w.v2);
  if (v2v2 > 0) axpy(dot(w.v2, w.b) / v2v2, w.c2, w.x);
}

}  // namespace fsi
