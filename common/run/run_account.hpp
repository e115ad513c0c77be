#pragma once

#include <string>

#include "io/step_record.hpp"
#include "run/run_parts.hpp"

namespace fsi {

/// What a run has taken: summary.json, and what goes into it.
template <int n>
class RunAccount {
 public:
  /// Both must outlive this.
  explicit RunAccount(RunParts<n>& parts) : parts_(parts) {}

  /// What the run is, once its state is known.
  void begin();
  /// A step of this program has been solved. \param length  ms
  void add(const StepRecord& record, double length);
  /// The seconds of a step, its output included.
  void add_seconds(double seconds) { step_seconds_ += seconds; }
  /// After a step: the matrices are there, and the run has taken long enough for a product to be nothing beside it.
  void measure_work_unit();
  /// What the run has taken up to now, into the summary.
  void take_stock();
  void write(const std::string& status);
  void write_status(const std::string& status);
  /// What the scheme made of steps of different length; empty: nothing to say.
  std::string about_steps() const;

 private:
  RunParts<n>& parts_;
  StepRecord total_;
  double shortest_step_ = 0, longest_step_ = 0;  ///< ms, of this program so far
  int first_step_ = 0;                           ///< of this program: the one before
  double step_seconds_ = 0;                      ///< of all steps of this program, their output included
};

}  // namespace fsi
