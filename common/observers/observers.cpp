#include "observers/observers.hpp"

#include <array>

#include "fem/dimensions.hpp"
#include "observers/energy_observer.hpp"
#include "observers/error_observer.hpp"
#include "observers/field_observer.hpp"
#include "observers/force_observer.hpp"
#include "observers/interface_observer.hpp"
#include "observers/network_observer.hpp"
#include "observers/observables.hpp"
#include "observers/opening_observer.hpp"
#include "observers/periodicity_observer.hpp"
#include "observers/ringing_observer.hpp"
#include "observers/same_rows.hpp"
#include "observers/statistics_observer.hpp"
#include "observers/step_observer.hpp"
#include "observers/wall_observer.hpp"

namespace fsi {

namespace {

/// A kind of observer.
template <int n>
struct Kind {
  const char* word;                                              ///< prefix of its names in the restart archive
  std::vector<const char*> files;                                ///< of the tables that it may fill
  std::unique_ptr<Observer> (*make)(const RunView<n>& watched);  ///< null where the case does not ask for it
};

/// All kinds, in the order in which they are called. A new one is a row here.
template <int n>
const std::vector<Kind<n>>& kinds() {
  static const std::vector<Kind<n>> rows{
      {"", {iterations_file, coupling_file}, make_step_observer<n>},
      {"", {}, make_ringing_observer<n>},
      {"", {energy_file}, make_energy_observer<n>},
      {"interface.", {}, make_interface_observer<n>},
      {"", {}, make_wall_observer<n>},
      {"", {surfaces_file}, make_force_observer<n>},
      {"", {centreline_file, wall_file, flow_file, points_file, lines_file, planes_file}, make_observables<n>},
      {"", {openings_file}, make_opening_observer<n>},
      {"", {network_file}, make_network_observer<n>},
      {"statistics.", {}, make_statistics_observer<n>},
      {"periodicity.", {}, make_periodicity_observer<n>},
      {"errors.", {}, make_error_observer<n>},
      {"", {}, make_field_observer<n>},
  };
  return rows;
}

}  // namespace

template <int n>
Observers::Observers(const RunView<n>& watched) : profile_(watched.scene.profile) {
  for (const Kind<n>& kind : kinds<n>()) {
    auto observer = kind.make(watched);
    if (!observer) continue;
    for (ResultTable& table : observer->tables()) tables_.push_back(std::move(table));
    observers_.push_back({kind.word, std::move(observer)});
  }
}

bool Observers::want_balances() const {
  return std::any_of(observers_.begin(), observers_.end(),
                     [](const Entry& entry) { return entry.observer->wants_balances(); });
}

void Observers::begin(const State& state) const {
  for (const auto& [word, observer] : observers_) observer->begin(state);
}

void Observers::look(const State& level) const {
  for (const auto& [word, observer] : observers_) observer->look(level);
}

void Observers::look(const State& level, ResultFolder& folder) const {
  const auto phase = profile_.phase("output");
  for (const auto& [word, observer] : observers_) {
    for (const TableRows& rows : observer->rows_at(level)) folder.write(rows);
    observer->look(level);
  }
}

void Observers::after_step(const FinishedStep& step, ResultFolder& folder) const {
  for (const auto& [word, observer] : observers_) {
    const auto phase = profile_.phase(observer->phase());
    for (const TableRows& rows : observer->after_step(step)) folder.write(rows);
  }
}

void Observers::require_same(const State& level, const EarlierTables& earlier) const {
  for (const auto& [word, observer] : observers_) {
    const auto tables = observer->tables();
    for (const TableRows& rows : observer->rows_at(level))
      for (const ResultTable& table : tables)
        if (table.file == rows.file) require_same_rows(earlier, table, level.time, rows.rows);
  }
}

bool Observers::want_end() const {
  return std::any_of(observers_.begin(), observers_.end(),
                     [](const Entry& entry) { return entry.observer->wants_end(); });
}

void Observers::end() const {
  for (const auto& [word, observer] : observers_) observer->end();
}

void Observers::keep(RestartArchive& archive) const {
  for (const auto& [word, observer] : observers_) {
    PrefixedArchive own(word, archive);
    observer->keep(own);
  }
}

std::vector<std::string> table_files() {
  std::vector<std::string> files;
  for (const auto& kind : kinds<2>()) files.insert(files.end(), kind.files.begin(), kind.files.end());
  return files;
}

std::vector<std::string> words_of_observers() {
  std::vector<std::string> words;
  for (const auto& kind : kinds<2>())
    if (kind.word[0] != '\0') words.emplace_back(kind.word);
  return words;
}

#define FSI_INSTANTIATE(n) template Observers::Observers(const RunView<n>&);
FSI_FOR_EACH_DIMENSION(FSI_INSTANTIATE)
#undef FSI_INSTANTIATE

}  // namespace fsi
