#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "io/result_tables.hpp"
#include "io/step_record.hpp"
#include "time/restart_archive.hpp"
#include "time/state.hpp"
#include "time/stepper.hpp"

namespace fsi {

/// A step that has just been finished, as a watcher sees it.
struct FinishedStep {
  const StepRecord& record;  ///< what it took
  const StepReport& report;
  const State& state;  ///< at its end
};

/// An observer of a run, which changes nothing of it. Which observers a case has, and where a new one is entered:
/// observers.cpp. Processes that share a scene call all of these together, and all get the same rows.
class Observer {
 public:
  virtual ~Observer() = default;

  /// The tables that it fills, with their columns.
  virtual std::vector<ResultTable> tables() const { return {}; }
  /// Whether it looks at StepReport::balances.
  virtual bool wants_balances() const { return false; }
  /// The run begins, or goes on, from a state; the result folder is there.
  virtual void begin(const State& /*state*/) {}

  /// What the tables of levels show of one. A restart asks for them again, and what has a measure must be the same.
  virtual std::vector<TableRows> rows_at(const State& /*level*/) const { return {}; }
  /// Takes in a level whose pressures are known: of a new run the first, then each once.
  virtual void look(const State& /*level*/) {}
  /// Rows of the tables of steps.
  virtual std::vector<TableRows> after_step(const FinishedStep& /*step*/) { return {}; }

  /// Whether the run has come to what it was to come to, and may end before its time.
  virtual bool wants_end() const { return false; }

  /// The run has come to its end, and all levels have been looked at.
  virtual void end() {}

  /// What it needs to go on after a restart. The names get the watcher's own word before them (observers.cpp).
  virtual void keep(RestartArchive& /*archive*/) {}
  /// The phase of the profile that the seconds of after_step() count for; levels count as output.
  virtual const char* phase() const { return "output"; }
};

/// Where a watcher says what belongs into no table.
class Messages {
 public:
  virtual ~Messages() = default;
  /// To the user: a line on the console and in the log.
  virtual void warn(const std::string& said) = 0;
  /// The same of what is as it should be.
  virtual void say(const std::string& said) = 0;
  /// An entry of the summary.
  virtual void note(const std::string& key, const nlohmann::json& value) = 0;
};

}  // namespace fsi
