#pragma once

#include <string>
#include <vector>

#include "time/restart_archive.hpp"

namespace fsi {

/// What an accelerator is doing, for the log and for coupling.csv.
struct AcceleratorStatus {
  double relaxation = 0;  ///< factor last used; 0 when the last correction was not a relaxation
  int columns = 0;        ///< differences or directions that the last correction used
};

/// Accelerates the fixed-point iteration for r(x) = 0 on the interface, r(x) = x~ - x with the result x~ of one pass
/// through the sub-problems. Vectors are interface vectors (interface_space.hpp). One loop (coupling_stepper.hpp)
/// drives every accelerator:
///   start(); repeat { r = r(x); correct(x, r); } until r is small; accept(x, r).
/// The x of a call need not be the one the last call proposed: a pass that fails is repeated closer to the last good x.
class Accelerator {
 public:
  virtual ~Accelerator() = default;
  /// A time step, or a stage of it, begins.
  virtual void start() = 0;
  /// Moves x, given its residual.
  virtual void correct(std::vector<double>& x, const std::vector<double>& r) = 0;
  /// The step, or stage, ended with this x and its residual.
  virtual void accept(const std::vector<double>& /*x*/, const std::vector<double>& /*r*/) {}
  /// The step, or stage, ended without a solution: forgets what was learned in it. start() follows.
  virtual void abandon() {}
  /// From here on r is another, similar function: that of a shorter step, or of a longer one. Called before start().
  virtual void change(bool /*longer*/) {}
  /// The |r| that will be small enough. Called before each correction, so that inner iterations stop there.
  virtual void aim(double /*residual*/) {}
  virtual AcceleratorStatus status() const = 0;
  /// Whether the next pass may solve the sub-problems in another way than the last: linearised or not. False while
  /// their residuals are subtracted to form a product with the Jacobian.
  virtual bool allows_change() const { return true; }
  /// What is kept from one step to the next, for a restart that goes on bit for bit.
  virtual void keep(RestartArchive& /*archive*/) {}
};

}  // namespace fsi
