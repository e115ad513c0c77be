#include "condensed_solver/fast_solver.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <utility>

#include "algebra/direct_solver.hpp"
#include "algebra/vector_operations.hpp"
#include "condensed_solver/velocity_pressure_preconditioner.hpp"
#include "fem/dimensions.hpp"
#include "mesh_motion/harmonic_extension.hpp"
#include "mesh_motion/tangent_extension.hpp"
#include "solvers/krylov/single_gmres.hpp"
#include "system/jacobian_product.hpp"

namespace fsi {

template <int n>
struct FastSolver<n>::Iterative {
  VelocityPressureLayout<n> layout;
  VelocityPressureMatrix<n> matrix;
  VelocityPressurePreconditioner<n> preconditioner;
  JacobianProduct<n> jacobian;
  std::unique_ptr<MeshExtension<n>> extension;  ///< null without mesh motion
  int extension_version = 0;                    ///< of the operator that it was made of
  bool shape_derivatives = false;               ///< they are not all zero (as they are at rest)
  SingleGmres gmres;
  std::vector<float> single_right, single_solution;
  std::vector<double> right, solution, residual, jacobian_times_x, correction;
  std::vector<double> mesh, mesh_right, fluid_rows;

  explicit Iterative(const JacobianBlocks<n>& blocks)
      : layout(blocks), matrix(blocks, layout), preconditioner(matrix), jacobian(blocks) {
    if (blocks.mesh_laplacian || blocks.mesh_tangent) {
      std::vector<char> inner(blocks.numbering.mesh_rows.size());
      for (std::size_t i = 0; i < inner.size(); ++i) inner[i] = blocks.numbering.mesh_rows[i].index >= 0;
      if (blocks.mesh_tangent) {
        extension = std::make_unique<TangentExtension<n>>(*blocks.mesh_tangent, std::move(inner));
        extension_version = *blocks.mesh_laplacian_version;
      } else {
        extension = std::make_unique<HarmonicExtension<n>>(*blocks.mesh_laplacian, std::move(inner),
                                                           HarmonicExtensionOptions{}, blocks.fluid_frames);
        count_extension(blocks);
      }
      mesh.resize(blocks.numbering.mesh.size());
      mesh_right.resize(mesh.size());
      fluid_rows.resize(blocks.numbering.fluid.size());
    }
  }
  void count_extension(const JacobianBlocks<n>& blocks) {
    extension_version = *blocks.mesh_laplacian_version;
    if (blocks.profile) blocks.profile->count("mesh motion factorisations");
  }
};

template <int n>
FastSolver<n>::FastSolver(const JacobianBlocks<n>& blocks, const FastOptions& options)
    : blocks_(blocks), options_(options) {
  if (blocks.numbering.size < options.direct_below.value_or(FastOptions::standard_direct_below(n)))
    direct_ = std::make_unique<DirectLinearSolver<n>>(blocks);
}

template <int n>
const char* FastSolver<n>::preparation() const {
  return direct_ && !iterative_ ? direct_->preparation() : LinearSolver::preparation();
}

template <int n>
void FastSolver<n>::update() {
  if (iterative_) direct_.reset();
  if (direct_) {
    const OneDenseThread same_bits_for_any_number;
    direct_->update();
  } else {
    const OneDenseThread same_bits_for_any_number;  // the extension may be factorised
    if (!iterative_) iterative_ = std::make_unique<Iterative>(blocks_);
    if (blocks_.mesh_tangent) {
      iterative_->extension->update();
      iterative_->count_extension(blocks_);
    }
    iterative_->layout.update();
    iterative_->matrix.fill();
    set_up_preconditioner(false);
    find_shape_derivatives();
  }
  ready_ = true;
}

template <int n>
LinearReport FastSolver<n>::solve(const std::vector<double>& b, double tolerance, std::vector<double>& x) {
  if (direct_) {
    const OneDenseThread same_bits_for_any_number;
    return direct_->solve(b, tolerance, x);
  }
  LinearReport report = iterate(b, tolerance, x);
  if (report.converged) return report;
  if (!strengthened_) {
    count("linear solves repeated with a stronger preconditioner");
    set_up_preconditioner(true);
    LinearReport second = iterate(b, tolerance, x);
    second.iterations += report.iterations;
    if (second.converged) return second;
    report = second;
  }
  // From here on a factorisation, however long it takes: better than no answer.
  count("linear solves rescued by factorisation");
  direct_ = std::make_unique<DirectLinearSolver<n>>(blocks_);
  const OneDenseThread same_bits_for_any_number;
  direct_->update();
  const LinearReport third = direct_->solve(b, tolerance, x);
  report.converged = third.converged;
  report.relative_residual = third.relative_residual;
  return report;
}

template <int n>
double FastSolver<n>::keep_contraction() const {
  return direct_ ? direct_->keep_contraction() : LinearSolver::keep_contraction();
}

template <int n>
int FastSolver<n>::solves_worth_an_update() const {
  return direct_ ? direct_->solves_worth_an_update() : LinearSolver::solves_worth_an_update();
}

template <int n>
LinearStatistics FastSolver<n>::statistics() const {
  LinearStatistics s;
  if (direct_) s = direct_->statistics();
  if (iterative_) {
    s.memory_mib += static_cast<double>(iterative_->matrix.bytes() + iterative_->preconditioner.bytes() +
                                        iterative_->gmres.bytes()) /
                    (1 << 20);
    if (iterative_->extension) s.memory_mib += iterative_->extension->memory_mib();
    s.operator_complexity = iterative_->preconditioner.multigrid().operator_complexity();
    s.levels = iterative_->preconditioner.multigrid().levels();
  }
  return s;
}

template <int n>
void FastSolver<n>::set_up_preconditioner(bool strong) {
  typename VelocityPressurePreconditioner<n>::Options options;
  options.momentum_sweeps = strong ? options_.strong_sweeps : options_.momentum_sweeps;
  if (strong) options.coarse_from = 0;
  iterative_->preconditioner.options() = options;
  iterative_->preconditioner.set_up();
  strengthened_ = strong;
}

template <int n>
void FastSolver<n>::count(const char* event) const {
  if (blocks_.profile) blocks_.profile->count(event);
}

template <int n>
void FastSolver<n>::find_shape_derivatives() {
  iterative_->shape_derivatives = false;
  if (blocks_.shape_derivatives)
    for (double value : blocks_.shape_derivatives->values)
      if (value != 0) {
        iterative_->shape_derivatives = true;
        break;
      }
}

namespace {

/// Directions of the outer iteration, with their products with the Jacobian, orthonormal by these: the generalised
/// conjugate residual method [Eisenstat1983]. Each step takes what of the residual lies along the latest.
class OuterDirections {
 public:
  bool in_use() const { return used_; }
  void use() { used_ = true; }

  void add(std::vector<double> direction, std::vector<double> product) {
    if (directions_.size() == most) {
      directions_.erase(directions_.begin());
      products_.erase(products_.begin());
    }
    for (std::size_t k = 0; k < directions_.size(); ++k) {
      const double along = dot(product, products_[k]);
      axpy(-along, products_[k], product);
      axpy(-along, directions_[k], direction);
    }
    const double length = norm(product);
    if (!(length > 0)) return;
    scale(1 / length, product);
    scale(1 / length, direction);
    directions_.push_back(std::move(direction));
    products_.push_back(std::move(product));
  }
  void step(const std::vector<double>& residual, std::vector<double>& x) const {
    if (!directions_.empty()) axpy(dot(residual, products_.back()), directions_.back(), x);
  }

 private:
  static constexpr std::size_t most = 10;
  bool used_ = false;
  std::vector<std::vector<double>> directions_, products_;
};

/// Of an outer iteration: beyond it directions are worth keeping.
constexpr double slow_contraction = 0.3;

}  // namespace

template <int n>
LinearReport FastSolver<n>::iterate(const std::vector<double>& b, double tolerance, std::vector<double>& x) {
  Iterative& it = *iterative_;
  LinearReport report;
  report.converged = false;
  x.assign(b.size(), 0.0);
  const double norm_b = norm(b);
  if (norm_b == 0) {
    report.converged = true;
    return report;
  }
  it.residual = b;
  OuterDirections directions;
  double relative = 1;
  double shape_contraction = 0.05;  // what an outer iteration leaves of the residual for want of shape derivatives
  while (report.iterations < options_.max_iterations) {
    const double wanted = 0.8 * tolerance / relative;
    const double inner = it.shape_derivatives ? std::max(wanted, 0.5 * shape_contraction) : wanted;
    correct(inner, relative, report);
    const auto step_along_directions = [&] {
      it.jacobian.multiply(it.correction, it.jacobian_times_x);
      directions.add(it.correction, it.jacobian_times_x);
      directions.step(it.residual, x);
    };
    const auto find_residual = [&] {
      it.jacobian.multiply(x, it.jacobian_times_x);
      for (std::size_t i = 0; i < b.size(); ++i) it.residual[i] = b[i] - it.jacobian_times_x[i];
      return norm(it.residual) / norm_b;
    };
    if (directions.in_use())
      step_along_directions();
    else
      axpy(1, it.correction, x);
    double now = find_residual();
    if (!directions.in_use() && now > slow_contraction * relative && now > tolerance) {
      directions.use();  // from this very correction on, as far as it is good
      axpy(-1, it.correction, x);
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
    // Either the shape derivatives set the pace, or the inner tolerance did and they may be smaller than thought.
    shape_contraction = contraction > 2 * inner ? std::clamp(contraction, 1e-3, 0.2) : 0.2 * shape_contraction;
    if (contraction > 0.95) {
      report.failure = fmt::format("the linear solver stalls at a relative residual of {:.1e}", relative);
      return report;
    }
  }
  report.failure = fmt::format("the linear solver reached a relative residual of {:.1e} only", relative);
  return report;
}

template <int n>
void FastSolver<n>::correct(double tolerance, double relative, LinearReport& report) {
  Iterative& it = *iterative_;
  const Numbering& numbering = blocks_.numbering;
  const OneDenseThread same_bits_for_any_number;  // the extension may be factorised
  it.layout.take(it.residual, it.right);
  if (it.extension && it.extension_version != *blocks_.mesh_laplacian_version) {
    it.extension->update();
    it.count_extension(blocks_);
  }
  if (it.extension) subtract_mesh_rows(tolerance);
  // Scaled to one, so that small residuals do not leave the range of single precision.
  const double scale = norm(it.right);
  it.solution.assign(it.right.size(), 0.0);
  if (scale > 0) {
    it.matrix.take(it.right, 1 / scale, it.single_right);
    const auto solved = it.gmres.solve([&](const auto& in, auto& out) { it.matrix.multiply(in, out); },
                                       [&](const auto& in, auto& out) { it.preconditioner.apply(in, out); },
                                       it.single_right, it.single_solution, tolerance, options_.restart);
    report.iterations += solved.iterations;
    it.matrix.give(it.single_solution, scale, it.solution);
  }
  it.correction.assign(it.residual.size(), 0.0);
  it.layout.give(it.solution, it.correction);
  if (it.extension) {
    for (std::size_t i = 0; i < it.mesh.size(); ++i) {
      const Unknown& unknown = numbering.mesh[i];
      it.mesh[i] = unknown.index < 0 ? 0 : unknown.factor * it.correction[unknown.index];
    }
    it.extension->solve(it.mesh_right, it.mesh,
                        std::min(loosest_extension, HarmonicExtensionOptions().tolerance / relative));
    for (std::size_t i = 0; i < it.mesh.size(); ++i)
      if (numbering.mesh_rows[i].index >= 0) it.correction[numbering.mesh_rows[i].index] = it.mesh[i];
  }
}

template <int n>
void FastSolver<n>::subtract_mesh_rows(double tolerance) {
  Iterative& it = *iterative_;
  const Numbering& numbering = blocks_.numbering;
  bool any = false;
  for (std::size_t i = 0; i < it.mesh_right.size(); ++i) {
    const auto row = numbering.mesh_rows[i].index;
    it.mesh_right[i] = row < 0 ? 0 : it.residual[row];
    any = any || it.mesh_right[i] != 0;
  }
  if (!any || !it.shape_derivatives) return;
  // An iteration costs too much for what the flow would not notice.
  if (it.extension->iterates() && norm(it.mesh_right) <= 0.01 * tolerance * norm(it.right)) return;
  set_zero(it.mesh);
  it.extension->solve(it.mesh_right, it.mesh, mesh_rows_tolerance);
  multiply(*blocks_.shape_derivatives, it.mesh, it.fluid_rows);
  std::vector<double>& all = it.jacobian_times_x;
  all.assign(it.residual.size(), 0.0);
  add_to_system(numbering.fluid_rows, it.fluid_rows, all);
  it.layout.take(all, it.solution);
  axpy(-1, it.solution, it.right);
}

template <int n>
FastSolver<n>::~FastSolver() = default;

#define FSI_INSTANTIATE(n) template class FastSolver<n>;
FSI_FOR_EACH_DIMENSION(FSI_INSTANTIATE)

}  // namespace fsi
