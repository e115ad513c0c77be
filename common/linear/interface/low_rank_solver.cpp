#include "linear/interface/low_rank_solver.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "algebra/vector_operations.hpp"
#include "fem/dimensions.hpp"
#include "linear/direct/dense_inverse.hpp"

namespace fsi {

namespace {

constexpr double tolerance_of_terms = 1e-8;  // of A^-1 w by an iterative solver
constexpr int most_corrections = 4;          // of a solution by an iterative solver

}  // namespace

template <int n>
LowRankLinearSolver<n>::LowRankLinearSolver(const JacobianBlocks<n>& blocks, std::unique_ptr<LinearSolver> solver,
                                            const std::vector<OpeningTerm>& terms)
    : blocks_(blocks), solver_(std::move(solver)), terms_(terms), product_(blocks) {}

template <int n>
void LowRankLinearSolver<n>::update() {
  solver_->update();
  const Numbering& numbering = blocks_.numbering;
  const auto size = static_cast<std::size_t>(numbering.size);
  of_system_.resize(terms_.size());
  for (std::size_t i = 0; i < terms_.size(); ++i) {
    Term& term = of_system_[i];
    term.slope = terms_[i].slope;
    term.given = terms_[i].given;
    term.slopes = terms_[i].slopes ? *terms_[i].slopes : std::vector<double>();
    std::vector<double> normals = *terms_[i].normals;
    if (blocks_.fluid_frames) blocks_.fluid_frames->template to_frames<MixedLayout<n>>(normals);
    term.rows.assign(size, 0.0);
    term.columns.assign(numbering.columns(), 0.0);
    add_to_system(numbering.fluid_rows, normals, term.rows);
    add_to_system(numbering.fluid, normals, term.columns);
    if (term.given) term.size = norm_of(term.rows);
    if (terms_[i].by_mesh && !numbering.mesh.empty()) {
      std::vector<double> by_mesh = *terms_[i].by_mesh;
      if (blocks_.fluid_frames) blocks_.fluid_frames->template to_frames<VectorLayout<n>>(by_mesh);
      add_to_system(numbering.mesh, by_mesh, term.columns);
    }
    term.columns.resize(size);  // ghosts have no part in the normals
  }
  prepared_ = false;
  preconditioner_.reset();
}

template <int n>
LinearReport LowRankLinearSolver<n>::prepare(Effort effort) {
  LinearReport report;
  // Counted apart from those of the step that happens to need it: after a restart it is another one.
  const auto count = [this](int iterations) {
    if (blocks_.profile && iterations > 0)
      blocks_.profile->count("linear iterations that prepare openings", iterations);
  };
  for (Term& term : of_system_) {
    report = effort == Effort::any ? solver_->solve(term.rows, tolerance_of_terms, term.solution)
                                   : solver_->try_to_solve(term.rows, tolerance_of_terms, term.solution);
    count(report.iterations);
    if (!report.converged) return report;
  }
  const std::size_t m = of_system_.size();
  std::vector<double> matrix(m * m);
  for (std::size_t j = 0; j < m; ++j) {
    const std::vector<double> answers = flows(of_system_[j].solution);
    for (std::size_t i = 0; i < m; ++i)
      matrix[i * m + j] = of_system_[i].given ? answers[i] : (i == j ? 1 : 0) + answer(of_system_[i], i, answers);
    of_system_[j].answer = answers[j];
  }
  for (std::size_t i = 0; i < m; ++i)
    for (std::size_t j = 0; of_system_[i].given && j < m; ++j) matrix[i * m + j] /= of_system_[i].answer;
  inverse_ = dense_inverse(matrix, static_cast<int>(m));
  report.converged =
      !inverse_.empty() && std::all_of(inverse_.begin(), inverse_.end(), [](double x) { return std::isfinite(x); });
  if (!report.converged) report.failure = "the equations of the openings are singular";
  prepared_ = report.converged;
  return report;
}

template <int n>
std::vector<double> LowRankLinearSolver<n>::correct(std::vector<double>& z, const std::vector<double>& gaps) const {
  const std::size_t m = of_system_.size();
  const std::vector<double> flow = flows(z);
  std::vector<double> right(m), pressures(m);
  for (std::size_t i = 0; i < m; ++i)
    right[i] = of_system_[i].given ? (flow[i] - gaps[i]) / of_system_[i].answer : answer(of_system_[i], i, flow);
  for (std::size_t i = 0; i < m; ++i) {
    double sum = 0;
    for (std::size_t j = 0; j < m; ++j) sum += inverse_[i * m + j] * right[j];
    pressures[i] = sum;
    axpy(-sum, of_system_[i].solution, z);
  }
  return pressures;
}

template <int n>
double LowRankLinearSolver<n>::residual_norm(const std::vector<double>& b, std::vector<double>& x) {
  blocks_.numbering.update_ghosts(x);
  product_.multiply(x, residual_);
  const std::vector<double> flow = flows(x);
  for (std::size_t i = 0; i < flow.size(); ++i)
    axpy(of_system_[i].given ? pressures_[i] : answer(of_system_[i], i, flow), of_system_[i].rows, residual_);
  for (std::size_t i = 0; i < b.size(); ++i) residual_[i] = b[i] - residual_[i];
  return norm_of(residual_);
}

template <int n>
std::vector<double> LowRankLinearSolver<n>::flows(const std::vector<double>& x) const {
  std::vector<double> all;
  for (const Term& term : of_system_) all.push_back(dot(term.columns, x));
  blocks_.numbering.processes->sum(all);
  return all;
}

template <int n>
double LowRankLinearSolver<n>::norm_of(const std::vector<double>& equations) const {
  return std::sqrt(blocks_.numbering.processes->sum(dot(equations, equations)));
}

template <int n>
LinearReport LowRankLinearSolver<n>::solve(const std::vector<double>& b, double tolerance, std::vector<double>& x) {
  if (!prepared_) {
    LinearReport preparing = prepare(Effort::any);
    if (!prepared_) return preparing;
  }
  LinearReport report = solver_->solve(b, tolerance, x);
  int iterations = report.iterations;
  if (!report.converged) return report;
  std::vector<double> gaps;
  for (const OpeningTerm& term : terms_) gaps.push_back(term.gap);
  pressures_ = correct(x, gaps);
  double size = norm_of(b);  // with what the pressures take, which may be all there is
  for (std::size_t i = 0; i < terms_.size(); ++i)
    if (of_system_[i].given) size += std::abs(pressures_[i]) * of_system_[i].size;
  if (report.relative_residual > 0 && size > 0) {
    double left = residual_norm(b, x) / size;
    for (int k = 0; k < most_corrections && left > tolerance; ++k) {
      const LinearReport again = solver_->solve(residual_, 0.5 * tolerance / left, correction_);
      iterations += again.iterations;
      if (!again.converged) break;
      const std::vector<double> further = correct(correction_, std::vector<double>(terms_.size(), 0.0));
      for (std::size_t i = 0; i < further.size(); ++i) pressures_[i] += further[i];
      axpy(1, correction_, x);
      left = residual_norm(b, x) / size;
    }
    report.relative_residual = left;
    if (left > 2 * tolerance) {
      report.converged = false;
      report.failure = "the pressures that answer the flow at openings keep the residual too large";
    }
  }
  report.iterations = iterations;
  return report;
}

template <int n>
bool LowRankLinearSolver<n>::is_iterative() const {
  return solver_->is_iterative() &&
         std::none_of(terms_.begin(), terms_.end(), [](const auto& term) { return term.given; });
}

template <int n>
MediumPreconditioner* LowRankLinearSolver<n>::medium_preconditioner() {
  MediumPreconditioner* medium = solver_->medium_preconditioner();
  if (medium == nullptr || !is_iterative()) return nullptr;
  if (!prepared_) prepare(Effort::no_factorisation);
  if (!prepared_) return nullptr;
  if (!preconditioner_) {
    std::vector<LowRankPreconditioner::Term> terms;
    for (const Term& term : of_system_)
      terms.push_back({term.slope, &term.slopes, &term.rows, &term.columns, &term.solution});
    preconditioner_ = std::make_unique<LowRankPreconditioner>(*medium, terms, inverse_);
  }
  return preconditioner_.get();
}

template <int n>
LinearStatistics LowRankLinearSolver<n>::statistics() const {
  LinearStatistics statistics = solver_->statistics();
  for (const Term& term : of_system_)
    statistics.memory_mib += 8.0 * static_cast<double>(3 * term.rows.size()) / (1 << 20);
  return statistics;
}

#define FSI_INSTANTIATE(n) template class LowRankLinearSolver<n>;
FSI_FOR_EACH_DIMENSION(FSI_INSTANTIATE)

}  // namespace fsi
