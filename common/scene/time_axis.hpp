#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "case/case.hpp"

namespace fsi {

/// Steps of one length, up to the next stretch or the end of the run.
struct Stretch {
  int after = 0;     ///< number of the step before its first
  double start = 0;  ///< end of that step: ms; in statics the fraction of the load
  double asked = 0;  ///< what the case said then: time.step in ms, 0 if adaptive; in statics static.load_steps
};

/// A step whose end is no planned one: half of a step that failed, or one that an error estimate chose.
struct Insertion {
  int step = 0;
  double end = 0, length = 0;  ///< ms; in statics fractions of the load
};

/// Where the steps of a run begin and end. Steps end where a load jumps, and at the times of output.interval and
/// output.times: up to there a stretch has equal steps, none longer than asked. Where steps as long as asked would miss
/// the end of the run, the last one is shorter. Where it would be less than half as long, the last two share what is
/// left: the last planned step is then longer than asked, and an inserted one is its first half. A run that goes on
/// from a checkpoint may have another step from there on; what lies before keeps its times. Adaptive steps are inserted
/// one by one, before a plan that only estimates how many are left. Times are ms, in statics fractions of the load.
class TimeAxis {
 public:
  /// One stretch from the start to the end, as the case asks.
  /// \param setup  must outlive this
  explicit TimeAxis(const Case& setup);
  explicit TimeAxis(Case&& setup) = delete;

  /// Number of the run's last step; of adaptive steps an estimate.
  int steps() const;
  /// End of a step, 0 for step 0. To twelve digits: 3 * 0.1 is 0.3, as it is for a run that ends there, so that one
  /// that goes on from it has the same times.
  double time_of(int step) const;
  /// Length of a step, ms; 0 in statics. Steps as long as asked, and equal adaptive ones, have the same bits.
  double length_of(int step) const;

  /// Numbers and ends of the steps of the plan alone, without inserted ones.
  int planned_steps() const;
  double planned_time_of(int step) const;

  bool is_adaptive() const { return time_ != nullptr && time_->adaptive; }
  /// Length of the shorter last steps of a run of equal ones, ms; 0: the end is met by steps as long as the others.
  double shorter_last_steps() const;
  /// The latest time, ms, up to which a step that begins at `time` may go.
  double next_stop(double time) const;
  /// Adaptive steps: `step`, which begins at `time`, is the first of equal ones to the next stop, none longer than
  /// `longest` (ms) unless by rounding. Returns its length.
  double choose(int step, double time, double longest);
  /// Halves a step, or a load step: it ends in the middle, and the rest becomes the step after it.
  void halve(int step);
  /// Takes back what was inserted behind step `last`.
  void drop_insertions_after(int last);
  const std::vector<Insertion>& insertions() const { return insertions_; }

  /// Whether a load jumps at the end of a step, which ends at `time`.
  bool jumps_at(double time) const;

  const std::vector<Stretch>& stretches() const { return stretches_; }
  bool is_static() const { return time_ == nullptr; }

  /// Goes on from step `last`, which ended at `time`, in a run with these stretches. Returns whether the case asks for
  /// another step than the last of them; from there on it holds.
  bool go_on(std::vector<Stretch> past, int last, double time, std::vector<Insertion> inserted = {});

 private:
  /// Equal steps up to a stop, or the end of the run; the last of them may be longer, or a single one shorter, at the end.
  struct Piece {
    double start, end;
    int steps;
    double step;  ///< ms
  };
  /// The pieces of a stretch up to the end of the run, kept because asking for a step must not cost the more the more
  /// times of output there are.
  struct Plan {
    std::vector<Piece> pieces;
    std::vector<int> until;  ///< per piece: steps of the stretch up to its end
  };
  /// Times that follow each other at one distance.
  struct Row {
    double first, last, distance;
  };
  static std::vector<Row> rows_of(const std::vector<double>& times);

  std::size_t stretch_of(int step) const;
  /// Calls visit(piece) for one piece of a stretch after the other, as long as it returns true.
  template <class Visit>
  void for_each_piece(const Stretch& stretch, Visit visit) const;
  const Plan& plan(std::size_t stretch) const;
  void set_stretches(std::vector<Stretch> stretches);
  int planned(std::size_t stretch) const;  ///< steps from its start to the end of the run
  int estimated(const Stretch& stretch) const;
  double length_in(const Stretch& stretch) const;
  double start_of_last_planned() const;
  /// Halves the last planned step where it is longer than asked.
  void share_rest();
  /// Of the steps inserted behind `last`, keeps the parts of the planned step that is in progress alone.
  void drop_later_insertions(int last);
  bool go_on_as_planned(std::vector<Stretch> past, int last, double time, std::vector<Insertion> inserted);
  int inserted_before(int step) const;
  const Insertion* insertion(int step) const;

  const TimeData* time_;       ///< null in statics
  std::vector<double> jumps_;  ///< ms, ascending, between start and end of the run
  std::vector<double> stops_;  ///< likewise: jumps and times of output
  std::vector<Row> rows_;      ///< the same, shorter
  std::vector<Stretch> stretches_;
  mutable std::vector<std::optional<Plan>> plans_;  ///< per stretch, those that were asked for
  std::vector<Insertion> insertions_;               ///< ascending in step
};

}  // namespace fsi
