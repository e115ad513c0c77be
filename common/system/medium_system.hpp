#pragma once

#include <string>
#include <vector>

#include "system/interface_impedance.hpp"
#include "system/system.hpp"

namespace fsi {

/// The discrete equations of one medium, fluid or wall, as a part of a coupled problem: a System with, optionally, an
/// impedance on the interface, linear solves with further forces, and access to its preconditioner.
template <int n>
class MediumSystem : public System<n> {
  using Base = System<n>;
  using Base::scene_, Base::numbering_, Base::openings_, Base::solver_, Base::linear_report_, Base::state_, Base::data_,
      Base::residual_, Base::increment_, Base::answer_;
  using typename Base::Mixed;

 public:
  /// \param numbering    of one medium, its mesh motion included
  /// \param impedance    added to its equations, must outlive this; null: none. Its c may change with the rates of a
  /// step
  MediumSystem(std::string name, Scene<n>& scene, Numbering numbering, const LinearSolverFactory<n>& make_solver = {},
               SystemNorm norm = SystemNorm::volumes, const InterfaceImpedance* impedance = nullptr);

  double evaluate() override;
  /// The next evaluate() reuses the medium's rows of the last one. To be called where only the interface's load or
  /// datum has changed since then.
  void keep_rows() { keeps_rows_ = Base::has_rows(); }

  double solve(double tolerance) override;
  /// Like solve(), with further forces f beside the residual, in nodal values of the medium along the axes of space.
  double solve_with(const std::vector<double>& forces, double tolerance);
  /// After either: increment -= J^-1 f, the response of the medium to forces f alone, up to |f - J x| <= tolerance |f|.
  /// \returns false when the linear solver failed
  bool add_response(const std::vector<double>& forces, double tolerance);

  /// The preconditioner of a solver that iterates, for an iteration over several media. Null where it factorises, and
  /// where openings join the Jacobian.
  MediumPreconditioner* preconditioner() { return solver_->medium_preconditioner(); }
  bool is_iterative() const { return solver_->is_iterative(); }
  /// For such an iteration: the increment becomes zero,
  void begin_increment();
  /// is corrected by -z,
  void correct_increment(const std::vector<double>& z);
  /// and has the linear residual R + f + J increment, f being forces as of solve_with().
  void linear_residual(const std::vector<double>& forces, std::vector<double>& residual);
  /// The last increment of the vector at a node, velocity or the wall's displacement, along the axes of space.
  Direction<n> increment_at(int node) const;

 private:
  void add_further_rows(std::vector<double>& residual) const override;
  void add_further_derivatives(FluidJacobian<n>& fluid, WallMatrix<n>& wall) const override;
  void add_fluid_impedance(std::vector<double>& residual) const;
  void add_wall_impedance(std::vector<double>& residual) const;
  /// Diagonal of the momentum rows that have an equation += factor c.
  void add_to_diagonal(WallMatrix<n>& matrix, const UnknownMap& rows, double factor) const;

  /// Equations += forces.
  void add_forces(const std::vector<double>& forces, std::vector<double>& equations);

  const InterfaceImpedance* impedance_;
  bool keeps_rows_ = false;         ///< the next evaluate() reuses them
  bool increment_is_zero_ = false;  ///< and J increment, too
  std::vector<double> loaded_;      ///< equations with forces
};

}  // namespace fsi
