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

/// All observers of a run, in the order in which they look.
class Observers {
 public:
  /// Those that a case asks for.
  template <int n>
  explicit Observers(const RunView<n>& watched);

  /// iterations.csv first.
  const std::vector<ResultTable>& tables() const { return tables_; }
  bool want_balances() const;
  void begin(const State& state) const;
  /// The first level of a new run, which no table shows.
  void look(const State& level) const;
  /// A level, with its rows.
  void look(const State& level, ResultFolder& folder) const;
  void after_step(const FinishedStep& step, ResultFolder& folder) const;
  /// Refuses tables of an earlier run whose last rows the level, from its checkpoint, does not give again. \throws InputError
  void require_same(const State& level, const EarlierTables& earlier) const;
  /// Whether one of them has seen what the run was for.
  bool want_end() const;
  void end() const;
  void keep(RestartArchive& archive) const;

 private:
  struct Entry {
    std::string word;  ///< before the names in the memory
    std::unique_ptr<Observer> observer;
  };
  std::vector<Entry> observers_;
  std::vector<ResultTable> tables_;
  Profile& profile_;
};

/// Files of all tables that some run may have.
std::vector<std::string> table_files();
/// What the names of all that watchers keep for a restart begin with.
std::vector<std::string> words_of_observers();

}  // namespace fsi
