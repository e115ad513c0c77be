#pragma once

#include <cstddef>
#include <vector>

namespace fsi {

/// A medium's Jacobian J in single precision beside a cycle that nearly inverts it: what an iteration over several media
/// is made of. Its vectors hold velocities, the components of a node one behind the other along the axes of its frame, and
/// pressures; what J has of the mesh motion beside the interface is left out and comes back through the residual. A
/// displacement d of the wall stands as the velocity d / period.
class CycledMedium {
 public:
  virtual ~CycledMedium() = default;

  virtual std::size_t size() const = 0;
  /// Of a node of the medium: the place of its velocity's first component in the vectors; -1 where it is held.
  virtual int place(int node) const = 0;
  /// y = J x, y resized
  virtual void multiply(const std::vector<float>& x, std::vector<float>& y) const = 0;
  /// y, resized, is about J^-1 x.
  virtual void cycle(const std::vector<float>& x, std::vector<float>& y) = 0;
  /// Besides, product = J y: a cycle may know half of it.
  virtual void cycle(const std::vector<float>& x, std::vector<float>& y, std::vector<float>& product) {
    cycle(x, y);
    multiply(y, product);
  }

  /// Of a vector of the system, equations or unknowns, those of velocities and pressures.
  virtual void order(const std::vector<double>& of_system, std::vector<double>& mine) const = 0;
  /// What velocities and pressures are to answer of a residual of the system, likewise in order.
  /// \param tolerance  of that answer, relative
  virtual void take(const std::vector<double>& residual, double tolerance, std::vector<double>& right) = 0;
  /// Such a vector in single precision, times a factor.
  virtual void shorten(const std::vector<double>& right, double factor, std::vector<float>& x) const = 0;
  /// A solution times a factor as unknowns of the system, those of the mesh motion with it.
  virtual void complete(const std::vector<float>& x, double factor, double tolerance,
                        std::vector<double>& correction) = 0;
  /// y = J x, all of it, in the unknowns of the system.
  virtual void multiply_whole(const std::vector<double>& x, std::vector<double>& y) = 0;
};

}  // namespace fsi
