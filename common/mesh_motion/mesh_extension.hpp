#pragma once

#include <vector>

namespace fsi {

/// Solves the linear equations of a mesh motion, or those one is linearised to, for what is not given of a field of
/// n numbers a node.
template <int n>
class MeshExtension {
 public:
  virtual ~MeshExtension() = default;
  /// The operator has new values.
  /// \throws ConvergenceError when it is singular
  virtual void update() = 0;
  /// Sets the inner values of `field` so that the rows of A field at inner entries equal `right` there; other values
  /// are given. Both hold n numbers a node. By all processes together.
  /// \param tolerance  residual over that of zero inner values; a factorisation solves to rounding
  virtual void solve(const std::vector<double>& right, std::vector<double>& field, double tolerance) = 0;
  /// All of it is solved by iteration.
  virtual bool iterates() const = 0;
  virtual double memory_mib() const = 0;
  /// Conjugate gradient iterations of the last solve.
  virtual int iterations() const = 0;
};

}  // namespace fsi
