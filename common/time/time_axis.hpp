#pragma once

#include <vector>

#include "case/case.hpp"

namespace fsi {

/// Steps of one length, up to the next stretch or the end of the run.
struct Stretch {
  int after = 0;     ///< number of the step before its first
  double start = 0;  ///< end of that step: ms; in statics the fraction of the load
  double asked = 0;  ///< what the case said then: time.step in ms; in statics static.load_steps
};

/// Where the steps of a run begin and end. Steps end where a load jumps: up to there a stretch has equal steps, none longer
/// than asked. A run that goes on from a checkpoint may have another step from there on;
/// what lies before keeps its times. Times are ms, in statics fractions of the load.
class TimeAxis {
 public:
  /// One stretch from the start to the end, as the case asks.
  explicit TimeAxis(const Case& setup);

  /// Number of the run's last step.
  int steps() const;
  /// End of a step, 0 for step 0. To twelve digits: 3 * 0.1 is 0.3, as it is for a run that ends there, so that one
  /// that goes on from it has the same times.
  double time_of(int step) const;

  /// Whether a load jumps at the end of a step, which ends at `time`.
  bool jumps_at(double time) const;

  const std::vector<Stretch>& stretches() const { return stretches_; }
  bool is_static() const { return time_ == nullptr; }

  /// Goes on from step `last`, which ended at `time`, in a run with these stretches. Returns whether the case asks for
  /// another step than the last of them; from there on it holds. The end is hit: a last step may be shorter.
  bool go_on(std::vector<Stretch> past, int last, double time);

 private:
  /// Equal steps up to a jump, or the end of the run; the last of them may be shorter at the end.
  struct Piece {
    double start, end;
    int steps;
    double step;  ///< ms
  };
  const Stretch& stretch_of(int step) const;
  std::vector<Piece> pieces(const Stretch& stretch) const;
  int planned(const Stretch& stretch) const;  ///< steps from its start to the end of the run

  const TimeData* time_;       ///< null in statics
  std::vector<double> jumps_;  ///< ms, ascending, between start and end of the run
  std::vector<Stretch> stretches_;
};

}  // namespace fsi
