#pragma once

#include <memory>
#include <optional>
#include <string>

#include "base/stopwatch.hpp"
#include "case/case.hpp"
#include "host/idle_cores.hpp"
#include "io/first_process.hpp"
#include "io/folder_lock.hpp"
#include "restart/array_orders.hpp"
#include "run/command_line.hpp"
#include "run/load_scene.hpp"
#include "run/loading_report.hpp"
#include "run/process_summary.hpp"
#include "run/process_threads.hpp"
#include "run/run_messages.hpp"
#include "run/step_controller.hpp"
#include "run/stepper_maker.hpp"
#include "scene/loads.hpp"
#include "system/work_unit.hpp"

namespace fsi {

/// What a run is made of, in the order in which it is made.
template <int n>
struct RunParts {
  /// \param watch  of the cores, from the program's start on
  /// \param lock   of the result folder; empty at all processes but the first
  RunParts(const std::string& program, const CommandLine& line, const Case& setup, const StepperMaker& make_stepper,
           const CoreWatch& watch, const std::optional<FolderLock>& lock);
  ~RunParts();
  RunParts(const RunParts&) = delete;
  RunParts& operator=(const RunParts&) = delete;

  /// Whether a level is looked at one step later, when its pressures are known.
  bool lagging() const { return scene.integrator->pressures_lag(); }
  /// The level before the latest one of `at`, as a state for observers. The next call overwrites it.
  const State& level_before(const State& at);
  /// The last level whose pressures are known; the next call of level_before() may overwrite it.
  const State& shown_level() { return lagging() ? level_before(state) : state; }
  /// Goes on with the scheme that an earlier run had, whatever the case would be given now. Resets the state to rest,
  /// so that it must be called before a checkpoint's state is read.
  void keep_scheme(const std::string& kept);

  Clock::time_point start = Clock::now();
  std::string program;
  const CommandLine& line;
  const std::optional<FolderLock>& lock;
  const Case& setup;
  ThreadChoice threads;
  LoadingReport loading;  ///< what was said when there was no log
  LoadedScene<n> loaded;
  Scene<n>& scene;
  const std::string case_hash, case_text;  ///< of the case as it is computed, for checkpoints
  const Communicator& processes;
  FirstProcess first;
  ProcessSummary<n> about_processes;
  WorkUnitMeter<n> work_unit;
  ArrayOrders<n> orders;
  Loads loads;
  std::unique_ptr<Stepper> stepper;
  RunMessages messages;
  StepController<n> march;
  std::string scheme;  ///< in time; empty in statics
  State state;

 private:
  State shown_;  ///< a finished level, for output
};

}  // namespace fsi
