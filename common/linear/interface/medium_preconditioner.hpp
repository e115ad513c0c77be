#pragma once

#include <cstddef>
#include <vector>

#include "algebra/vector_view.hpp"

namespace fsi {

/// A medium's Jacobian J in single precision beside a preconditioner, a cycle that nearly inverts it: what an iteration
/// over several media is made of. Its vectors hold velocities, the components of a node one behind the other along the axes
/// of its frame, and pressures; what J has of the mesh motion beside the interface is left out and comes back through the
/// residual. A displacement d of the wall stands as the velocity d / period.
class MediumPreconditioner {
 public:
  using Input = VectorView<const float>;
  using Output = VectorView<float>;  ///< of size()

  virtual ~MediumPreconditioner() = default;

  virtual std::size_t size() const = 0;
  /// Of a node of the medium: the place of its velocity's first component in the vectors; -1 where it is held.
  virtual int place(int node) const = 0;
  /// y = J x
  virtual void multiply(Input x, Output y) const = 0;
  /// y is about J^-1 x.
  virtual void apply(Input x, Output y) = 0;
  /// Also product = J y. Overridden where the preconditioner already knows part of that product.
  virtual void apply(Input x, Output y, Output product) {
    apply(x, y);
    multiply(y, product);
  }

  /// Copies the entries of velocities and pressures from a vector of the system, equations or unknowns, to `mine`.
  virtual void gather(const std::vector<double>& of_system, Output mine) const = 0;
  /// Restricts a residual of the system to velocities and pressures, and keeps the restricted one in double precision.
  /// \param tolerance  to which it will be solved for, relative
  /// \returns the Euclidean norm of the restricted residual
  virtual double restrict_residual(const std::vector<double>& residual, double tolerance) = 0;
  /// Writes the residual of the last restrict_residual() times a factor.
  virtual void write_restricted(double factor, Output right) const = 0;
  /// correction = a solution times a factor, in the unknowns of the system, with the mesh motion that follows from it.
  /// \param tolerance  relative, as in restrict_residual(); decides how exactly the mesh motion is solved
  virtual void expand(Input x, double factor, double tolerance, std::vector<double>& correction) = 0;
  /// y = J x, all of it, in the unknowns of the system.
  virtual void multiply_whole(const std::vector<double>& x, std::vector<double>& y) = 0;
};

}  // namespace fsi
