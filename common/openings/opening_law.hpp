#pragma once

#include <string>
#include <vector>

namespace fsi {

/// What lies behind an opening: a pressure that depends on the flow through it (docs/theory.md, section 3.5). It keeps
/// m numbers y of its own, pressures or flows, which a time scheme integrates like any other quantity:
/// dy/dt = k (y - r) at a balance, k and r known. Its equations are linear, so that the pressure is an affine function
/// of the outward flow Q,
///   p = a + b Q,
/// and is solved with the step. Units: kPa, mm^3/ms, ms.
class OpeningLaw {
 public:
  virtual ~OpeningLaw() = default;

  /// y at the start, m numbers: the parameters whose names begin with "initial_", in their order.
  virtual std::vector<double> start() const = 0;
  /// y at a balance. \param k  1/ms \param reference  r, m numbers \param flow  Q
  virtual std::vector<double> kept(double k, const double* reference, double flow) const = 0;
  /// p = a + b Q at a balance. Without storage, k = 0, what a steady flow ends with.
  virtual double pressure(double k, const double* reference, double flow) const = 0;
  /// b = dp/dQ at a balance, kPa ms/mm^3.
  virtual double slope(double k) const = 0;
  /// dy/dt of y and Q.
  virtual std::vector<double> rates(const double* kept, double flow) const = 0;

  /// The pressure that tables show as that behind the opening, kPa.
  virtual double pressure_behind(const double* kept) const = 0;
  /// How long it remembers, ms: distal resistance times compliance, or a longer time of its; 0: nothing is kept.
  virtual double time_constant() const = 0;
  /// In words. \param volume  the unit of what flows, with which units are made: of a plane scene an area
  virtual std::string description(const std::string& volume) const = 0;
};

}  // namespace fsi
