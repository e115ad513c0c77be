#pragma once

#include <cmath>
#include <limits>
#include <memory>
#include <utility>
#include <vector>

#include "fem/gather_blocks.hpp"
#include "fluid/fluid_problem.hpp"
#include "linear/direct/direct_solver.hpp"
#include "linear/direct/gathered_matrix.hpp"
#include "mesh_motion/mesh_motion.hpp"
#include "nonlinear/newton.hpp"
#include "support/nodal_arrays.hpp"
#include "wall/wall_problem.hpp"

namespace fsi::test {

/// Own unknowns for all entries of a nodal array that `prescribed(node, entry)` does not hold.
template <class Prescribed>
std::pair<UnknownMap, std::int64_t> number_entries(int nodes, int entries, Prescribed prescribed) {
  UnknownMap map(static_cast<std::size_t>(nodes) * entries);
  std::int64_t next = 0;
  for (int a = 0; a < nodes; ++a)
    for (int k = 0; k < entries; ++k)
      if (!prescribed(a, k)) map[static_cast<std::size_t>(a) * entries + k] = {next++, 1.0};
  return {map, next};
}

/// One sub-problem with prescribed entries of any kind and a load vector: what the programs do not need but
/// manufactured solutions and symmetry planes do. Residual and Jacobian are the sub-problem's own.
class SubProblem : public NewtonProblem {
 public:
  std::vector<double> solution;  ///< nodal array; prescribed entries hold their values
  std::vector<double> load;      ///< subtracted from the residual; empty: none

  SubProblem(UnknownMap map, std::int64_t size) : map_(std::move(map)), size_(size), increment_(size) {}

  double evaluate() override {
    std::vector<double> nodal;
    if (assemble(solution, nodal, false).inverted()) return std::numeric_limits<double>::quiet_NaN();
    for (std::size_t i = 0; i < load.size(); ++i) nodal[i] -= load[i];
    residual_.assign(static_cast<std::size_t>(size_), 0.0);
    add_to_system(map_, nodal, residual_);
    return norm(residual_);
  }
  void linearise() override {
    std::vector<double> nodal;
    assemble(solution, nodal, true);
    if (matrix_.matrix().size() <= 0) {
      GatheredMatrix::Builder builder(size_);
      gather(builder, map_);
      matrix_ = GatheredMatrix(std::move(builder));
    }
    matrix_.update();
    solver_.factorise(matrix_.matrix());
  }
  bool linearised() const override { return solver_.factorised(); }
  double solve(double) override {
    solver_.solve(matrix_.matrix(), residual_, increment_);
    for (double& x : increment_) x = -x;
    return norm(increment_);
  }
  void move(double step) override { add_to_field(map_, increment_, step, solution); }
  double size() const override { return norm(solution); }
  /// eps |J| |x| with x the largest value of the solution: generous enough to cover the prescribed values' terms.
  double rounding() override {
    const SparseMatrix& a = matrix_.matrix();
    std::vector<double> terms(static_cast<std::size_t>(size_), 0.0);
    for (std::size_t k = 0; k < a.rows.size(); ++k) terms[a.rows[k]] += std::abs(a.values[k]);
    return std::numeric_limits<double>::epsilon() * largest(solution) * norm(terms);
  }

 protected:
  virtual AssemblyResult assemble(const std::vector<double>& at, std::vector<double>& residual, bool derivatives) = 0;
  virtual void gather(GatheredMatrix::Builder& builder, const UnknownMap& map) = 0;

 private:
  UnknownMap map_;
  std::int64_t size_;
  std::vector<double> residual_, increment_;
  GatheredMatrix matrix_;
  DirectSolver solver_;
};

/// What the fluid's residual depends on in a backward Euler step; no meshes: a rigid domain.
/// \param step  ms
inline FluidInput euler_input(const std::vector<double>* mesh, const std::vector<double>* mesh_old,
                              const std::vector<double>& flow, const std::vector<double>& fluid_old, double step) {
  FluidInput in;
  if (mesh) {
    in.mesh = mesh->data();
    in.mesh_reference = mesh_old->data();
    in.mesh_factor = 1 / step;
  }
  in.fluid = flow.data();
  in.fluid_reference = fluid_old.data();
  in.fluid_factor = 1 / step;
  in.step = step;
  return in;
}

/// One backward Euler step, of the length that the fluid's form has, of the fluid on a given moving mesh.
template <class Element>
class FluidStep : public SubProblem {
 public:
  std::vector<double> mesh, mesh_old, fluid_old;
  std::vector<double> pressures;  ///< kPa, of the fluid's open boundaries

  template <class Prescribed>
  FluidStep(FluidProblem<Element>& fluid, Prescribed prescribed)
      : FluidStep(fluid, number_entries(fluid.node_count(), Element::components + 1, prescribed)) {}

 private:
  FluidStep(FluidProblem<Element>& fluid, std::pair<UnknownMap, std::int64_t> numbered)
      : SubProblem(std::move(numbered.first), numbered.second),
        fluid_(fluid),
        jacobian_(fluid.graph(), FluidDerivatives::fluid) {
    const auto nodes = static_cast<std::size_t>(fluid.node_count());
    solution.assign(nodes * (Element::components + 1), 0.0);
    fluid_old = solution;
    mesh.assign(nodes * Element::components, 0.0);
    mesh_old = mesh;
  }
  AssemblyResult assemble(const std::vector<double>& at, std::vector<double>& residual, bool derivatives) override {
    return fluid_.assemble(euler_input(&mesh, &mesh_old, at, fluid_old, fluid_.form().step), pressures, residual,
                           derivatives ? &jacobian_ : nullptr);
  }
  void gather(GatheredMatrix::Builder& builder, const UnknownMap& map) override {
    gather_blocks(builder, jacobian_.fluid, map, map);
  }

  FluidProblem<Element>& fluid_;
  FluidJacobian<Element::components> jacobian_;
};

/// The wall in statics.
template <class Element>
class WallEquilibrium : public SubProblem {
 public:
  double pressure = 0;  ///< kPa on the pressurised facets

  template <class Prescribed>
  WallEquilibrium(WallProblem<Element>& wall, Prescribed prescribed)
      : WallEquilibrium(wall, number_entries(wall.node_count(), Element::components + 1, prescribed)) {}

 private:
  WallEquilibrium(WallProblem<Element>& wall, std::pair<UnknownMap, std::int64_t> numbered)
      : SubProblem(std::move(numbered.first), numbered.second), wall_(wall), jacobian_(wall.graph()) {
    solution.assign(static_cast<std::size_t>(wall.node_count()) * (Element::components + 1), 0.0);
  }
  AssemblyResult assemble(const std::vector<double>& at, std::vector<double>& residual, bool derivatives) override {
    return wall_.assemble({at.data(), nullptr, 0.0}, pressure, at, residual, derivatives ? &jacobian_ : nullptr);
  }
  void gather(GatheredMatrix::Builder& builder, const UnknownMap& map) override {
    gather_blocks(builder, jacobian_, map, map);
  }

  WallProblem<Element>& wall_;
  WallMatrix<Element::components> jacobian_;
};

/// Harmonic mesh motion, values prescribed on the boundary.
template <class Element>
class MeshMotionEquilibrium : public SubProblem {
 public:
  template <class Prescribed>
  MeshMotionEquilibrium(const MeshMotionMatrix<Element::components>& matrix, Prescribed prescribed)
      : MeshMotionEquilibrium(matrix, number_entries(matrix.graph->rows(), Element::components, prescribed)) {}

 private:
  MeshMotionEquilibrium(const MeshMotionMatrix<Element::components>& matrix,
                        std::pair<UnknownMap, std::int64_t> numbered)
      : SubProblem(std::move(numbered.first), numbered.second), matrix_(matrix) {
    solution.assign(static_cast<std::size_t>(matrix.graph->rows()) * Element::components, 0.0);
  }
  AssemblyResult assemble(const std::vector<double>& at, std::vector<double>& residual, bool) override {
    residual.resize(at.size());
    multiply_mesh_motion<Element::components>(matrix_, at, residual);
    return {};
  }
  void gather(GatheredMatrix::Builder& builder, const UnknownMap& map) override {
    gather_diagonal_blocks(builder, matrix_, map, map);
  }

  const MeshMotionMatrix<Element::components>& matrix_;
};

}  // namespace fsi::test
