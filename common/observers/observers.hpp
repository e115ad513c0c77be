#pragma once

#include <memory>
#include <string>
#include <vector>

#include "base/profile.hpp"
#include "io/earlier_tables.hpp"
#include "io/result_folder.hpp"
#include "observers/observer.hpp"
#include "observers/run_view.hpp"

namespace fsi {

/// All observers of a run, in the order in which they are called.
class Observers {
 public:
  /// Those that a case asks for.
  template <int n>
  explicit Observers(const RunView<n>& watched);

  /// iterations.csv first.
  const std::vector<ResultTable>& tables() const { return tables_; }
  bool want_balances() const;
  void begin(const State& state) const;
  /// The initial level of a new run, which tables do not show.
  void look(const State& level) const;
  /// A level, whose rows are written.
  void look(const State& level, ResultFolder& folder) const;
  void after_step(const FinishedStep& step, ResultFolder& folder) const;
  /// \throws InputError if the last rows of an earlier run's tables differ from those of the level in its checkpoint
  void require_same(const State& level, const EarlierTables& earlier) const;
  /// Whether one of them wants the run to end, see Observer::wants_end().
  bool want_end() const;
  void end() const;
  void keep(RestartArchive& archive) const;

 private:
  struct Entry {
    std::string word;  ///< prefix of its names in the restart archive
    std::unique_ptr<Observer> observer;
  };
  std::vector<Entry> observers_;
  std::vector<ResultTable> tables_;
  Profile& profile_;
};

/// Files of all tables that a run may have.
std::vector<std::string> table_files();
/// Prefixes of the names that observers have in a restart archive.
std::vector<std::string> words_of_observers();

}  // namespace fsi
