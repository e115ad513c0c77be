#pragma once

#include <string>

#include "io/step_record.hpp"
#include "run/run_parts.hpp"

namespace fsi {

/// What a run has taken: summary.json, and what goes into it.
template <int n>
class RunAccount {
 public:
  /// \param parts  must outlive this
  explicit RunAccount(RunParts<n>& parts) : parts_(parts) {}

  /// Starts the summary: program, case, mesh, unknowns. To be called once the state is known, by all processes.
  void begin();
  /// Counts a step that has been solved. \param length  of the step, ms
  void add(const StepRecord& record, double length);
  /// The seconds of a step, its output included.
  void add_seconds(double seconds) { step_seconds_ += seconds; }
  /// After a step: the matrices are there, and the run has taken long enough for a product to be nothing beside it.
  void measure_work_unit();
  /// Puts the totals up to now into the summary; writes nothing. To be called by all processes.
  void take_stock();
  /// take_stock(), then write_status().
  void write(const std::string& status);
  /// Writes summary.json with this status, at the first process; to be called by all. \throws WriteError at all of them
  void write_status(const std::string& status);
  /// What the scheme made of steps of different length; empty: nothing to say.
  std::string about_steps() const;

 private:
  RunParts<n>& parts_;
  StepRecord total_;
  double shortest_step_ = 0, longest_step_ = 0;  ///< ms, of this program so far
  int first_step_ = 0;                           ///< number of the step before the first of this program
  double step_seconds_ = 0;                      ///< of all steps of this program, their output included
};

}  // namespace fsi
