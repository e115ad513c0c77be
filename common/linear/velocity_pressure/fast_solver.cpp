#include "linear/velocity_pressure/fast_solver.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

#include "algebra/vector_operations.hpp"
#include "fem/dimensions.hpp"
#include "linear/direct/direct_solver.hpp"
#include "linear/interface/direct_linear_solver.hpp"
#include "linear/interface/linear_attempts.hpp"
#include "linear/krylov/gmres.hpp"
#include "linear/velocity_pressure/condensed_iteration.hpp"
#include "linear/velocity_pressure/factorised_flow.hpp"
#include "linear/velocity_pressure/flow_preconditioner.hpp"
#include "mesh_motion/harmonic_extension.hpp"
#include "mesh_motion/tangent_extension.hpp"

namespace fsi {

namespace {

template <int n>
std::unique_ptr<MeshExtension<n>> make_extension(const JacobianBlocks<n>& blocks, std::vector<char> inner) {
  const bool few_digits = true;  // are asked for: CondensedIteration::extension_share
  if (blocks.mesh_tangent) {
    TangentExtensionOptions options;
    options.single_precision = few_digits;
    return std::make_unique<TangentExtension<n>>(*blocks.mesh_tangent, std::move(inner), options);
  }
  HarmonicExtensionOptions options;
  options.single_precision = few_digits;
  return std::make_unique<HarmonicExtension<n>>(*blocks.mesh_laplacian, std::move(inner), options, blocks.fluid_frames);
}

constexpr std::int64_t apart_from = 2000;  // unknowns: factors of smaller systems take no time, and solve them exactly
constexpr std::int64_t single_from = 10000;  // unknowns: smaller factors lie in the processor's cache anyway

/// \param few_digits  are asked for
template <int n>
DirectSolver::Options factors(bool few_digits, const JacobianBlocks<n>& blocks) {
  DirectSolver::Options options;
  // UMFPACK by itself takes the other strategy where one unknown in ten is a pressure, whose diagonal is zero: factors of
  // velocities and pressures are then larger (docs/archive.md).
  options.strategy = "symmetric";
  options.single_precision = few_digits && blocks.numbering.size >= single_from;
  return options;
}

}  // namespace

template <int n>
struct FastSolver<n>::Iterative : MediumPreconditioner {
  VelocityPressureLayout<n> layout;
  VelocityPressureMatrix<n> matrix;
  std::unique_ptr<FlowPreconditioner<n>> preconditioner;
  CondensedIteration<n> iteration;
  SingleGmres gmres;
  std::vector<float> single_right, single_solution;
  std::vector<double> restricted, solution;
  mutable std::vector<double> gathered;

  Iterative(const JacobianBlocks<n>& blocks, const FastOptions& options, const FastParts<n>& parts)
      : layout(blocks),
        matrix(blocks, layout),
        preconditioner(make_flow_preconditioner<n>(options.preconditioner, matrix)),
        iteration(blocks, layout,
                  parts.extension ? parts.extension : typename CondensedIteration<n>::MakeExtension(make_extension<n>),
                  options.max_iterations),
        gmres(matrix.processes()) {}

  std::size_t size() const override { return matrix.size(); }
  int place(int node) const override {
    const int velocity = (layout.velocity_of_fluid.empty() ? layout.velocity_of_wall : layout.velocity_of_fluid)[node];
    return velocity < 0 ? -1 : velocity * VelocityPressureMatrix<n>::lanes;
  }
  void multiply(Input x, Output y) const override { matrix.multiply(x, y); }
  void apply(Input x, Output y) override { preconditioner->apply(x, y); }
  void apply(Input x, Output y, Output product) override { preconditioner->apply(x, y, product); }
  void gather(const std::vector<double>& of_system, Output mine) const override {
    layout.take(of_system, gathered);
    matrix.take(gathered, 1, mine);
  }
  double restrict_residual(const std::vector<double>& residual, double tolerance) override {
    iteration.restrict_residual(residual, tolerance, restricted);
    return norm(restricted);
  }
  void write_restricted(double factor, Output right) const override { matrix.take(restricted, factor, right); }
  void expand(Input x, double factor, double tolerance, std::vector<double>& correction) override {
    matrix.give(x, factor, solution);
    iteration.expand(solution, tolerance, correction);
  }
  void multiply_whole(const std::vector<double>& x, std::vector<double>& y) override { iteration.multiply(x, y); }
};

/// The mesh displacement by its own factors, velocities and pressures by theirs.
template <int n>
struct FastSolver<n>::Factorised {
  static constexpr int most_corrections = 30;  // for want of shape derivatives
  /// Of a right-hand side, by a correction. It was 0.08 at most in Turek-Hron FSI1 to FSI3, and 0.9 to 60,000 in a short tube
  /// that a heart fills in steps of 2 ms.
  static constexpr double most_left = 0.25;

  VelocityPressureLayout<n> layout;
  FactorisedFlow<n> flow;
  CondensedIteration<n> iteration;
  double loosest;  ///< tolerance of a solve

  Factorised(const JacobianBlocks<n>& blocks, const FastOptions& options)
      : layout(blocks),
        flow(blocks, layout, factors(true, blocks)),
        iteration(blocks, layout, make_extension<n>, most_corrections),
        loosest(options.exact ? FastOptions::exact_to : 1) {}
  /// \returns whether shape derivatives are small enough to come back through residuals: by the Jacobian alone, of forces
  /// that vary from node to node
  bool update(std::int64_t size) {
    layout.update();
    iteration.update();
    flow.update();
    std::vector<double> forces(layout.size(), 0.0), b(size, 0.0);
    std::fill_n(forces.begin(), layout.velocity_size(), 1.0);
    layout.give(forces, b);
    double place = 0;
    for (double& force : b) {
      place += 0.6180339887498949;  // the golden section's multiples are spread evenly
      if (force != 0) force = place - std::floor(place) - 0.5;
    }
    if (!(iteration.left_by_a_correction(b, inner_solver()) > most_left)) return true;
    flow.discard();
    return false;
  }
  LinearReport solve(const std::vector<double>& b, double tolerance, std::vector<double>& x) {
    const OneDenseThread same_bits_for_any_number;
    return iteration.solve(b, std::min(tolerance, loosest), inner_solver(), x);
  }

 private:
  typename CondensedIteration<n>::InnerSolver inner_solver() {
    return [this](const std::vector<double>& right, double, double wanted, std::vector<double>& solution) {
      flow.solve(right, wanted, solution);
      return typename CondensedIteration<n>::InnerReport{1};
    };
  }
};

template <int n>
FastSolver<n>::FastSolver(const JacobianBlocks<n>& blocks, const FastOptions& options)
    : FastSolver(blocks, options, JacobianPolicy<n>(blocks, options)) {}

template <int n>
FastSolver<n>::FastSolver(const JacobianBlocks<n>& blocks, const FastOptions& options, JacobianPolicy<n> policy,
                          FastParts<n> parts)
    : blocks_(blocks), options_(options), policy_(std::move(policy)), parts_(std::move(parts)) {
  assert(blocks.numbering.processes->is_alone() || (parts_.extension && parts_.factors && parts_.rescue));
  if (!policy_.wall_decides() && !policy_.iterates()) make_factors();
}

template <int n>
void FastSolver<n>::make_factors() {
  if (parts_.factors) {
    if (!direct_) direct_ = parts_.factors(blocks_);
    return;
  }
  const bool mesh_moves = blocks_.mesh_laplacian || blocks_.mesh_tangent;
  if (n == 2 && mesh_moves && blocks_.numbering.size >= apart_from) {
    if (!factorised_) factorised_ = std::make_unique<Factorised>(blocks_, options_);
  } else {
    make_whole_factors();
  }
}

template <int n>
void FastSolver<n>::make_whole_factors() {
  // Newton's method asks for a few digits of each increment of a coupled system; callers that make one of it by parts learn
  // from differences of solutions, and want all digits.
  if (!direct_) direct_ = std::make_unique<DirectLinearSolver<n>>(blocks_, factors(blocks_.coupled(), blocks_));
}

template <int n>
const char* FastSolver<n>::preparation() {
  if (policy_.wall_decides()) return policy_.iterates() ? LinearSolver::preparation() : "factorisation";
  return iterative_ || !uses_factorisation() ? LinearSolver::preparation() : "factorisation";
}

template <int n>
std::string FastSolver<n>::decides() const {
  return policy_.rule();
}

template <int n>
void FastSolver<n>::choose() {
  if (policy_.iterates()) {
    direct_.reset();
    factorised_.reset();
    return;
  }
  iterative_.reset();
  make_factors();
}

template <int n>
void FastSolver<n>::update() {
  if (policy_.wall_decides())
    choose();
  else if (iterative_)
    direct_.reset();
  policy_.forget();
  const OneDenseThread same_bits_for_any_number;
  if (factorised_ && factorised_->update(blocks_.numbering.columns())) {
    direct_.reset();
  } else if (factorised_ || direct_) {
    if (factorised_) count("factorisations with the mesh motion");
    if (!direct_) make_whole_factors();
    direct_->update();
  } else {
    if (!iterative_) iterative_ = std::make_unique<Iterative>(blocks_, options_, parts_);
    iterative_->iteration.update();
    iterative_->layout.update();
    iterative_->matrix.fill();
    set_up_preconditioner(false);
  }
  ready_ = true;
}

template <int n>
LinearReport FastSolver<n>::try_to_solve(const std::vector<double>& b, double tolerance, std::vector<double>& x) {
  return solve(b, tolerance, x, false);
}

template <int n>
LinearReport FastSolver<n>::solve(const std::vector<double>& b, double tolerance, std::vector<double>& x) {
  return solve(b, tolerance, x, true);
}

template <int n>
LinearReport FastSolver<n>::solve(const std::vector<double>& b, double tolerance, std::vector<double>& x,
                                  bool may_factorise) {
  const auto by_factors = [&] {
    const OneDenseThread same_bits_for_any_number;
    return direct_->solve(b, tolerance, x);
  };
  if (direct_) return by_factors();
  LinearAttempts attempts;
  attempts.profile = blocks_.profile;
  attempts.iterate = [&] { return factorised_ ? factorised_->solve(b, tolerance, x) : iterate(b, tolerance, x); };
  attempts.strengthen = [&] { set_up_preconditioner(true); };
  attempts.strengthenings = factorised_ || strengthened_ ? 0 : policy_.policy().strengthenings();
  if (may_factorise || factorised_)  // factors of a part become factors of the whole
    attempts.factorise = [&] {
      direct_ = parts_.rescue ? parts_.rescue(blocks_) : std::make_unique<DirectLinearSolver<n>>(blocks_);
      const OneDenseThread same_bits_for_any_number;
      direct_->update();
      return by_factors();
    };
  return attempts.run();
}

template <int n>
double FastSolver<n>::keep_contraction() const {
  return uses_factorisation() ? 0.4 : LinearSolver::keep_contraction();
}

template <int n>
LinearStatistics FastSolver<n>::statistics() const {
  LinearStatistics s;
  if (direct_) s = direct_->statistics();
  if (factorised_ && !direct_) {
    s.memory_mib += factorised_->flow.bytes() / (1 << 20);
    if (const auto* extension = factorised_->iteration.extension()) s.memory_mib += extension->memory_mib();
  }
  if (iterative_) {
    s.memory_mib += static_cast<double>(iterative_->matrix.bytes() + iterative_->preconditioner->bytes() +
                                        iterative_->gmres.bytes()) /
                    (1 << 20);
    if (const auto* extension = iterative_->iteration.extension()) s.memory_mib += extension->memory_mib();
    s.operator_complexity = iterative_->preconditioner->operator_complexity();
    s.levels = iterative_->preconditioner->levels();
  }
  return s;
}

template <int n>
MediumPreconditioner* FastSolver<n>::medium_preconditioner() {
  return uses_factorisation() || !blocks_.numbering.processes->is_alone() ? nullptr : iterative_.get();
}

template <int n>
void FastSolver<n>::set_up_preconditioner(bool strong) {
  BlockPreconditionerChoices choices;
  choices.momentum_sweeps = strong ? options_.strong_sweeps : options_.momentum_sweeps;
  if (strong) choices.coarse_from = 0;
  iterative_->preconditioner->set_up(choices);
  strengthened_ = strong;
}

template <int n>
void FastSolver<n>::count(const char* event) const {
  if (blocks_.profile) blocks_.profile->count(event);
}

template <int n>
LinearReport FastSolver<n>::iterate(const std::vector<double>& b, double tolerance, std::vector<double>& x) {
  Iterative& it = *iterative_;
  const auto inner = [&](const std::vector<double>& right, double scale, double wanted, std::vector<double>& solution) {
    // Scaled to one, so that small residuals do not leave the range of single precision.
    it.single_right.resize(it.matrix.size());
    it.matrix.take(right, 1 / scale, it.single_right);
    const auto solved =
        it.gmres.solve_from_zero([&](const auto& r, auto& z, auto& y) { it.preconditioner->apply(r, z, y); },
                                 it.single_right, it.single_solution, wanted, options_.restart);
    it.matrix.give(it.single_solution, scale, solution);
    return typename CondensedIteration<n>::InnerReport{
        solved.iterations, solved.relative_residual + it.matrix.rounding(it.single_solution)};
  };
  return it.iteration.solve(b, tolerance, inner, x, &it.matrix.shape_derivatives());
}

template <int n>
FastSolver<n>::~FastSolver() = default;

#define FSI_INSTANTIATE(n) template class FastSolver<n>;
FSI_FOR_EACH_DIMENSION(FSI_INSTANTIATE)

}  // namespace fsi
