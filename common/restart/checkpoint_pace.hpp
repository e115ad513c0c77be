#pragma once

#include <optional>

namespace fsi {

/// When checkpoints are written. Seconds are wall time since the steps began; the class has no clock of its own.
struct CheckpointRule {
  std::optional<int> every{};       ///< steps between checkpoints; 0: none; empty: by time
  std::optional<double> seconds{};  ///< s, by which the last is older than this; empty: by what checkpoints cost
  double share = 0.02;              ///< of the run's time that checkpoints may take, where neither is given
  double longest = 60;              ///< s, that a kill may cost at most then, beside the step in progress
  double first_guess = 0.02;        ///< s, of a checkpoint, until one was written
};

/// Decides after each step whether a checkpoint is due, by what the ones before have taken. The one that is written at
/// the end of a run does not ask.
class CheckpointPace {
 public:
  explicit CheckpointPace(const CheckpointRule& rule) : rule_(rule) {}

  /// \param step  that was finished, counted from 1
  /// \param now   s
  bool is_due(int step, double now) const;
  /// One was written at a time and took so long, both in s.
  void written(double now, double seconds);
  bool writes_any() const { return !rule_.every || *rule_.every > 0; }

 private:
  CheckpointRule rule_;
  std::optional<double> cost_;  ///< of the longer of the last two, s
  double last_seconds_ = 0;     ///< of the last one
  double spent_ = 0;            ///< s, on all of them
  double last_ = 0;             ///< when the last was written
};

}  // namespace fsi
