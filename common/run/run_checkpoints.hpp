#pragma once

#include <optional>
#include <string>
#include <vector>

#include "io/checkpoint.hpp"
#include "io/earlier_tables.hpp"
#include "io/table_digest.hpp"
#include "observers/observers.hpp"
#include "restart/checkpoint_pace.hpp"
#include "restart/recalled_archive.hpp"
#include "run/run_parts.hpp"

namespace fsi {

/// The checkpoints of a run: what it goes on from, and what it leaves. For all processes together.
template <int n>
class RunCheckpoints {
 public:
  /// Both must outlive this.
  RunCheckpoints(RunParts<n>& parts, const Observers& observers);

  /// Takes over what the run in line.restart has left, if it can be believed: its checkpoint, and the tables, which are only
  /// read. Nothing where the run is new. \throws InputError
  std::optional<EarlierTables> recall();
  /// What could not be taken over, a line each.
  const std::vector<std::string>& warnings() const { return warnings_; }
  /// Entries that are not for the methods and watchers of this run; and that it goes on with another step. Empty: not so.
  const std::string& left_aside() const { return left_aside_; }
  const std::string& step_change() const { return step_change_; }

  /// The tables hold what a restart from this step goes on from.
  void vouch(ResultFolder& folder);
  /// To be called before each step: copies what a checkpoint needs, for save_finished(). An interrupted step changes
  /// what steppers keep, so that a checkpoint made after it would not restart to the same bits. Copies nothing where
  /// the folder holds the checkpoint of the last finished step.
  void keep_finished();
  /// After a step: the first process's clock decides. \param finished  it is the last one
  bool is_due(bool finished) const;
  bool writes_any() const { return pace_.writes_any(); }
  /// Writes a checkpoint of the state as it is. \throws WriteError
  void save();
  /// Writes the copy that keep_finished() has made, when a step is given up; nothing where there is none.
  void save_finished();

 private:
  Checkpoint of_now();
  void write(const Checkpoint& checkpoint) const;
  /// What march and stepper keep.
  void keep_method(RestartArchive& archive);
  void keep_scheme(RestartArchive& archive);
  std::string difference_to(const Checkpoint& head) const;
  std::string text_of_change(const Stretch& before) const;

  RunParts<n>& parts_;
  const Observers& observers_;
  CheckpointPace pace_;
  TableDigests digests_;
  int saved_ = -1;                      ///< the step whose checkpoint the folder has
  std::optional<Checkpoint> finished_;  ///< of the last finished step, where that is not written
  std::vector<std::string> warnings_;
  std::string left_aside_, step_change_;
};

}  // namespace fsi
