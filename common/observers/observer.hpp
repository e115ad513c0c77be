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

/// A step that has just been finished, as observers see it.
struct FinishedStep {
  const StepRecord& record;  ///< what it took
  const StepReport& report;
  const State& state;  ///< at its end
};

/// An observer of a run, which does not change it. The table of all kinds: observers.cpp. All functions are collective
/// over the processes that share a scene, and all processes get the same rows.
class Observer {
 public:
  virtual ~Observer() = default;

  /// The tables that it fills, with their columns.
  virtual std::vector<ResultTable> tables() const { return {}; }
  /// Whether it needs StepReport::balances.
  virtual bool wants_balances() const { return false; }
  /// The run begins, or continues, from a state; the result folder exists.
  virtual void begin(const State& /*state*/) {}

  /// Rows of the tables of levels. A restart computes them again, and columns with a measure must agree.
  virtual std::vector<TableRows> rows_at(const State& /*level*/) const { return {}; }
  /// Takes in a level whose pressures are known: each once, in a new run also the initial one.
  virtual void look(const State& /*level*/) {}
  /// Rows of the tables of steps.
  virtual std::vector<TableRows> after_step(const FinishedStep& /*step*/) { return {}; }

  /// Whether the run has reached its aim and may end early.
  virtual bool wants_end() const { return false; }

  /// The run has come to its end, after look() at all levels.
  virtual void end() {}

  /// Saves or recalls its state for a restart. The names get the observer's prefix (observers.cpp).
  virtual void keep(RestartArchive& /*archive*/) {}
  /// The phase of the profile for after_step(); levels count as "output".
  virtual const char* phase() const { return "output"; }
};

/// Receives what belongs in no table.
class Messages {
 public:
  virtual ~Messages() = default;
  /// A warning to the user: a line on the console and in the log.
  virtual void warn(const std::string& said) = 0;
  /// A message that is no warning, likewise.
  virtual void say(const std::string& said) = 0;
  /// An entry of the summary.
  virtual void note(const std::string& key, const nlohmann::json& value) = 0;
};

}  // namespace fsi
