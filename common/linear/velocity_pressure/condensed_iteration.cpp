#include "linear/velocity_pressure/condensed_iteration.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "algebra/vector_operations.hpp"
#include "fem/dimensions.hpp"
#include "linear/direct/direct_solver.hpp"

namespace fsi {

namespace {

/// Directions of the outer iteration and their products with the Jacobian, the products being orthonormal: the
/// generalised conjugate residual method [Eisenstat1983]. A step projects the residual onto the latest product.
class OuterDirections {
 public:
  explicit OuterDirections(const Communicator& processes) : processes_(processes) {}
  bool in_use() const { return used_; }
  void use() { used_ = true; }

  void add(std::vector<double> direction, std::vector<double> product) {
    if (directions_.size() == most) {
      directions_.erase(directions_.begin());
      products_.erase(products_.begin());
    }
    for (std::size_t k = 0; k < directions_.size(); ++k) {
      const double along = processes_.sum(dot(product, products_[k]));
      axpy(-along, products_[k], product);
      axpy(-along, directions_[k], direction);
    }
    const double length = std::sqrt(processes_.sum(dot(product, product)));
    if (!(length > 0)) return;
    scale(1 / length, product);
    scale(1 / length, direction);
    directions_.push_back(std::move(direction));
    products_.push_back(std::move(product));
  }
  void step(const std::vector<double>& residual, std::vector<double>& x) const {
    if (!directions_.empty()) axpy(processes_.sum(dot(residual, products_.back())), directions_.back(), x);
  }

 private:
  static constexpr std::size_t most = 10;
  const Communicator& processes_;
  bool used_ = false;
  std::vector<std::vector<double>> directions_, products_;
};

/// Of an outer iteration: beyond it directions are worth keeping.
constexpr double slow_contraction = 0.3;

}  // namespace

template <int n>
CondensedIteration<n>::CondensedIteration(const JacobianBlocks<n>& blocks, const VelocityPressureLayout<n>& layout,
                                          const MakeExtension& make_extension, int max_iterations)
    : blocks_(blocks), layout_(layout), jacobian_(blocks), max_iterations_(max_iterations) {
  if (!blocks.mesh_laplacian && !blocks.mesh_tangent) return;
  const Numbering& numbering = blocks.numbering;
  std::vector<char> inner(numbering.mesh_rows.size());
  for (std::size_t i = 0; i < inner.size(); ++i) inner[i] = numbering.mesh_rows[i].index >= 0;
  extension_ = make_extension(blocks, std::move(inner));
  if (blocks.mesh_tangent)
    extension_version_ = *blocks.mesh_laplacian_version;
  else
    count_extension();
  mesh_.resize(numbering.mesh.size());
  mesh_right_.resize(mesh_.size());
  fluid_rows_.resize(numbering.fluid.size());
}

template <int n>
CondensedIteration<n>::~CondensedIteration() = default;

template <int n>
void CondensedIteration<n>::count_extension() {
  extension_version_ = *blocks_.mesh_laplacian_version;
  if (blocks_.profile) blocks_.profile->count("mesh motion factorisations");
}

template <int n>
void CondensedIteration<n>::update() {
  if (blocks_.mesh_tangent) {
    extension_->update();
    count_extension();
  }
  bool any = false;
  if (blocks_.shape_derivatives)
    for (double value : blocks_.shape_derivatives->values)
      if (value != 0) {
        any = true;
        break;
      }
  shape_derivatives_ = blocks_.numbering.processes->any(any);
}

template <int n>
double CondensedIteration<n>::norm_of_all(const std::vector<double>& x) const {
  return std::sqrt(blocks_.numbering.processes->sum(dot(x, x)));
}

template <int n>
LinearReport CondensedIteration<n>::solve(const std::vector<double>& b, double tolerance,
                                          const InnerSolver& inner_solver, std::vector<double>& x,
                                          const InterfaceShapeDerivatives<n>* inner_shape_derivatives) {
  const Numbering& numbering = blocks_.numbering;
  LinearReport report;
  report.converged = false;
  x.assign(numbering.columns(), 0.0);
  const double norm_b = norm_of_all(b);
  if (norm_b == 0) {
    report.converged = true;
    return report;
  }
  residual_ = b;
  OuterDirections directions(*numbering.processes);
  double relative = 1;
  bool first = true;
  // `lacking` estimates the share of the residual that an outer iteration leaves however exact the inner solver is,
  // since the inner matrix has not all shape derivatives and fewer digits. A much smaller inner tolerance is wasted.
  const bool lacks = shape_derivatives_ || inner_shape_derivatives;
  double lacking = shape_derivatives_ ? 0.05 : 0.01;
  while (report.iterations < max_iterations_) {
    const double wanted = 0.8 * tolerance / relative;
    const double inner = lacks ? std::max(wanted, 0.5 * lacking) : wanted;
    const double left = correct(inner, inner_solver, report);
    if (std::exchange(first, false)) {
      const double bound = bound_of_residual(b, norm_b, tolerance, left, inner_shape_derivatives);
      if (bound <= tolerance) {
        x = correction_;
        report.relative_residual = bound;
        report.converged = true;
        return report;
      }
    }
    const auto step_along_directions = [&] {
      jacobian_.multiply(correction_, jacobian_times_x_);
      directions.add(correction_, jacobian_times_x_);
      directions.step(residual_, x);
    };
    const auto find_residual = [&] {
      jacobian_.multiply(x, jacobian_times_x_);
      for (std::size_t i = 0; i < b.size(); ++i) residual_[i] = b[i] - jacobian_times_x_[i];
      return norm_of_all(residual_) / norm_b;
    };
    if (directions.in_use())
      step_along_directions();
    else
      axpy(1, correction_, x);
    double now = find_residual();
    if (!directions.in_use() && now > slow_contraction * relative && now > tolerance) {
      directions.use();  // from this very correction on, as far as it is good
      axpy(-1, correction_, x);
      find_residual();
      step_along_directions();
      now = find_residual();
    }
    const double contraction = now / relative;
    relative = now;
    report.relative_residual = relative;
    if (!std::isfinite(relative)) {
      report.failure = "the residual of the linear solver is not finite";
      return report;
    }
    if (relative <= tolerance) {
      report.converged = true;
      return report;
    }
    // Either they set the pace, or the inner tolerance did and they may be smaller than thought.
    lacking = contraction > 2 * inner ? std::clamp(contraction, 1e-3, 0.2) : 0.2 * lacking;
    if (contraction > 0.95) {
      report.failure = fmt::format("the linear solver stalls at a relative residual of {:.1e}", relative);
      return report;
    }
  }
  report.failure = fmt::format("the linear solver reached a relative residual of {:.1e} only", relative);
  return report;
}

template <int n>
double CondensedIteration<n>::left_by_a_correction(const std::vector<double>& b, const InnerSolver& inner_solver) {
  LinearReport report;
  residual_ = b;
  correct(loosest_extension, inner_solver, report);
  jacobian_.multiply(correction_, jacobian_times_x_);
  for (std::size_t i = 0; i < b.size(); ++i) residual_[i] -= jacobian_times_x_[i];
  return norm_of_all(residual_) / norm_of_all(b);
}

template <int n>
double CondensedIteration<n>::bound_of_residual(const std::vector<double>& b, double norm_b, double tolerance,
                                                double left,
                                                const InterfaceShapeDerivatives<n>* inner_shape_derivatives) {
  constexpr double infinite = std::numeric_limits<double>::infinity();
  if (!std::isfinite(left) || tolerance < estimated_from || left > tolerance * norm_b) return infinite;
  // b - J x = (right - F x) + (b - right) - (S - those of F) mesh in the rows of the flow.
  layout_.take(b, left_out_);
  axpy(-1, right_, left_out_);
  if (shape_derivatives_) {
    fsi::multiply(*blocks_.shape_derivatives, mesh_, fluid_rows_);
    jacobian_times_x_.assign(b.size(), 0.0);
    add_to_system(blocks_.numbering.fluid_rows, fluid_rows_, jacobian_times_x_);
    layout_.take(jacobian_times_x_, right_);
    axpy(-1, right_, left_out_);
    if (inner_shape_derivatives) inner_shape_derivatives->add_product(mesh_, left_out_);
  }
  const double of_flow = left + norm_of_all(left_out_);
  if (!extension_ || !extension_->iterates()) return of_flow / norm_b;
  jacobian_.multiply_mesh_rows(correction_, jacobian_times_x_);
  double of_mesh = 0;
  for (const Unknown& row : blocks_.numbering.mesh_rows)
    if (row.index >= 0) of_mesh += std::pow(b[row.index] - jacobian_times_x_[row.index], 2);
  return std::hypot(of_flow, std::sqrt(blocks_.numbering.processes->sum(of_mesh))) / norm_b;
}

template <int n>
double CondensedIteration<n>::correct(double tolerance, const InnerSolver& inner_solver, LinearReport& report) {
  restrict_residual(residual_, tolerance, right_);
  solution_.assign(right_.size(), 0.0);
  double left = 0;
  if (const double scale = norm_of_all(right_); scale > 0) {
    const InnerReport inner = inner_solver(right_, scale, tolerance, solution_);
    report.iterations += inner.iterations;
    left = scale * inner.relative_residual;
  }
  expand(solution_, tolerance, correction_);
  return left;
}

template <int n>
void CondensedIteration<n>::restrict_residual(const std::vector<double>& residual, double tolerance,
                                              std::vector<double>& right) {
  const OneDenseThread same_bits_for_any_number;  // the extension may be factorised
  layout_.take(residual, right);
  if (!extension_) return;
  if (extension_version_ != *blocks_.mesh_laplacian_version) {
    extension_->update();
    count_extension();
  }
  subtract_mesh_rows(residual, tolerance, right);
}

template <int n>
void CondensedIteration<n>::expand(const std::vector<double>& solution, double tolerance,
                                   std::vector<double>& correction) {
  const Numbering& numbering = blocks_.numbering;
  const OneDenseThread same_bits_for_any_number;
  correction.assign(numbering.columns(), 0.0);
  layout_.give(solution, correction);
  numbering.update_ghosts(correction);
  if (!extension_) return;
  for (std::size_t i = 0; i < mesh_.size(); ++i) {
    const Unknown& unknown = numbering.mesh[i];
    mesh_[i] = unknown.index < 0 ? 0 : unknown.factor * correction[unknown.index];
  }
  extend(std::min(loosest_extension, extension_share * tolerance));
  for (std::size_t i = 0; i < mesh_.size(); ++i)
    if (numbering.mesh_rows[i].index >= 0) correction[numbering.mesh_rows[i].index] = mesh_[i];
  numbering.update_ghosts(correction);
}

template <int n>
void CondensedIteration<n>::subtract_mesh_rows(const std::vector<double>& residual, double tolerance,
                                               std::vector<double>& right) {
  const Numbering& numbering = blocks_.numbering;
  bool any = false;
  for (std::size_t i = 0; i < mesh_right_.size(); ++i) {
    const auto row = numbering.mesh_rows[i].index;
    mesh_right_[i] = row < 0 ? 0 : residual[row];
    any = any || mesh_right_[i] != 0;
  }
  if (!shape_derivatives_ || !numbering.processes->any(any)) return;
  if (norm_of_all(mesh_right_) <= 0.01 * tolerance * norm_of_all(right)) return;  // the flow would not notice
  set_zero(mesh_);
  extend(mesh_rows_tolerance);
  fsi::multiply(*blocks_.shape_derivatives, mesh_, fluid_rows_);
  std::vector<double>& all = jacobian_times_x_;
  all.assign(residual.size(), 0.0);
  add_to_system(numbering.fluid_rows, fluid_rows_, all);
  layout_.take(all, solution_);
  axpy(-1, solution_, right);
}

template <int n>
void CondensedIteration<n>::extend(double tolerance) {
  if (!blocks_.profile) return extension_->solve(mesh_right_, mesh_, tolerance);
  const auto phase = blocks_.profile->phase("solve: mesh motion");
  extension_->solve(mesh_right_, mesh_, tolerance);
}

#define FSI_INSTANTIATE(n) template class CondensedIteration<n>;
FSI_FOR_EACH_DIMENSION(FSI_INSTANTIATE)

}  // namespace fsi
