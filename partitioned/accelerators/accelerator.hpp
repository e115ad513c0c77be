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

/// How an iteration for r(x) = 0 on the interface goes on, r(x) = x~ - x being what one pass through the sub-problems
/// changes. One loop (coupling_stepper.hpp) drives every accelerator:
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
  /// It ended without an answer: what it taught is forgotten, the run may try again with a shorter step.
  virtual void abandon() {}
  /// From here on r is another function, much alike: of a shorter step, or a longer one.
  virtual void change(bool /*longer*/) {}
  /// Where |r| will be small enough. Told before each correction, for passes that work no further than that.
  virtual void aim(double /*residual*/) {}
  virtual AcceleratorStatus status() const = 0;
  /// The next residual may come from sub-problems solved in another way than the last: it is not compared with it
  /// alone.
  virtual bool allows_change() const { return true; }
  /// What is kept from one step to the next, for a restart that goes on bit for bit.
  virtual void keep(RestartArchive& /*archive*/) {}
};

}  // namespace fsi
