#pragma once

#include <functional>
#include <limits>
#include <memory>
#include <vector>

#include "linear/interface/jacobian_product.hpp"
#include "linear/interface/linear_solver.hpp"
#include "linear/velocity_pressure/interface_shape_derivatives.hpp"
#include "linear/velocity_pressure/velocity_pressure_layout.hpp"
#include "mesh_motion/mesh_extension.hpp"

namespace fsi {

/// The outer iteration around a solver of velocities and pressures: it computes residuals of the whole system in double
/// precision, takes the mesh displacement along by its extension, and brings the shape derivatives back that the inner
/// solver leaves out, small against the rest, through the residual. Where the scene is shared out among processes, each
/// holds the rows of its unknowns, and solutions with ghosts.
template <int n>
class CondensedIteration {
 public:
  struct InnerReport {
    int iterations = 0;
    /// Over |right|, by the inner solver's own estimate, rounding of its matrix with it; infinite: it has none. For
    /// tolerances of 1e-3 and more it must be the residual of an F that has the `inner_shape_derivatives` of solve().
    double relative_residual = std::numeric_limits<double>::infinity();
  };
  /// solution = approximate F^-1 right in the order of the layout, places of ghosts as they are; `scale` is |right| > 0.
  /// \param tolerance  residual over |right|
  using InnerSolver = std::function<InnerReport(const std::vector<double>& right, double scale, double tolerance,
                                                std::vector<double>& solution)>;
  /// \param inner  per entry of the mesh motion: it is sought here
  using MakeExtension =
      std::function<std::unique_ptr<MeshExtension<n>>(const JacobianBlocks<n>& blocks, std::vector<char> inner)>;

  /// \param layout          of the blocks; must outlive this
  /// \param make_extension  called where there is a mesh motion
  /// \param max_iterations  of the inner solver, in one solve
  CondensedIteration(const JacobianBlocks<n>& blocks, const VelocityPressureLayout<n>& layout,
                     const MakeExtension& make_extension, int max_iterations);
  ~CondensedIteration();

  /// The block matrices hold new values.
  void update();

  /// \param tolerance                demanded |b - J x| / |b|
  /// \param x                        overwritten
  /// \param inner_shape_derivatives  those that the inner solver's matrix has; null: none. They serve where its estimate
  ///                                 does in place of a product with the whole Jacobian, more than all the rest of an
  ///                                 iteration's products
  LinearReport solve(const std::vector<double>& b, double tolerance, const InnerSolver& inner_solver,
                     std::vector<double>& x, const InterfaceShapeDerivatives<n>* inner_shape_derivatives = nullptr);

  /// |b - J x| / |b| after a single correction from x = 0. With an exact inner solver this is the effect of the shape
  /// derivatives that its matrix has not.
  double left_by_a_correction(const std::vector<double>& b, const InnerSolver& inner_solver);

  /// The two steps of a correction around the inner solver, for an iteration over several systems. restrict_residual()
  /// sets `right` to the right-hand side of velocities and pressures in the order of the layout. expand() turns their
  /// solution into a correction of the system's unknowns, with ghosts and the mesh motion that follows.
  /// \param tolerance  relative, of the solution for velocities and pressures
  void restrict_residual(const std::vector<double>& residual, double tolerance, std::vector<double>& right);
  void expand(const std::vector<double>& solution, double tolerance, std::vector<double>& correction);
  /// y = J x
  void multiply(const std::vector<double>& x, std::vector<double>& y) { jacobian_.multiply(x, y); }

  const MeshExtension<n>* extension() const { return extension_.get(); }  ///< null without mesh motion

 private:
  /// Of the mesh motion that the mesh equations' own residual asks for: it enters the flow's right-hand side only, and
  /// what it leaves comes back in the next residual.
  static constexpr double mesh_rows_tolerance = 1e-3;
  /// Tolerance of a correction's mesh motion: over that of its velocities and pressures, and its largest value. What it
  /// leaves is a residual of the mesh equations, and the next correction's. So a solution of Newton's method holds them
  /// as well as the others.
  static constexpr double extension_share = 0.01, loosest_extension = 1e-3;
  /// Of linear solves whose inner residual may be known in single precision.
  static constexpr double estimated_from = 1e-3;

  void count_extension();
  /// Of rows, which all processes have some of.
  double norm_of_all(const std::vector<double>& x) const;

  /// A bound of |b - J correction| / norm_b, of the first correction: what the inner solver left, by its estimate, and what
  /// the shape derivatives do beside those that it knows; of the mesh's own equations what an iteration leaves, while factors
  /// solve them to six digits. Infinite where the estimate has not the digits of `tolerance`.
  /// \param left  by the inner solver, a norm
  double bound_of_residual(const std::vector<double>& b, double norm_b, double tolerance, double left,
                           const InterfaceShapeDerivatives<n>* inner_shape_derivatives);

  /// correction = approximate solution for the residual: velocities and pressures by the inner solver, then the mesh.
  /// \returns norm of the residual that the inner solver left, by its estimate
  double correct(double tolerance, const InnerSolver& inner_solver, LinearReport& report);
  /// Mesh displacements inside, of mesh_right_ and the given ones.
  void extend(double tolerance);

  /// What the mesh equations' own residual does to the flow: right -= A_fm A_m^-1 r_m. Usually r_m is nothing but
  /// rounding, or what an iterative extension left.
  void subtract_mesh_rows(const std::vector<double>& residual, double tolerance, std::vector<double>& right);

  JacobianBlocks<n> blocks_;
  const VelocityPressureLayout<n>& layout_;
  JacobianProduct<n> jacobian_;
  int max_iterations_;
  std::unique_ptr<MeshExtension<n>> extension_;
  int extension_version_ = 0;       ///< of the operator that it was made of
  bool shape_derivatives_ = false;  ///< they are not all zero (as they are at rest)
  std::vector<double> right_, solution_, residual_, jacobian_times_x_, correction_;
  std::vector<double> left_out_;  ///< of velocities and pressures: what the inner solver's matrix does not have
  std::vector<double> mesh_, mesh_right_, fluid_rows_;
};

}  // namespace fsi
