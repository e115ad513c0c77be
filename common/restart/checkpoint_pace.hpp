#pragma once

#include <optional>

namespace fsi {

/// When checkpoints are written. Times are seconds of wall-clock time since the steps began.
struct CheckpointRule {
  std::optional<int> every{};       ///< steps between checkpoints; 0: none; empty: by time
  std::optional<double> seconds{};  ///< s, by which the last is older than this; empty: by what checkpoints cost
  double share = 0.02;              ///< of the run's time that checkpoints may take, where neither is given
  double longest = 60;              ///< s, that a kill may cost at most then, beside the step in progress
  double first_guess = 0.02;        ///< s, of a checkpoint, until one was written
};

/// Decides after each step whether a checkpoint is due, by what the earlier ones have taken. It has no clock of its
/// own. The checkpoint at the end of a run does not depend on it.
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
  std::optional<double> cost_;  ///< s, of the slower of the last two; empty: none was written
  double last_seconds_ = 0;     ///< s, of the last one
  double spent_ = 0;            ///< s, on all of them
  double last_ = 0;             ///< when the last was written
};

}  // namespace fsi
