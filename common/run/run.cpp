#include "run/run.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstring>

#include "base/error.hpp"
#include "base/printable.hpp"
#include "diagnostics/failure_hint.hpp"
#include "fem/dimensions.hpp"
#include "host/available_memory.hpp"
#include "host/standard_streams.hpp"
#include "host/stop_request.hpp"
#include "io/run_log.hpp"
#include "io/write_error.hpp"
#include "observers/field_output.hpp"
#include "observers/observers.hpp"
#include "run/announcement.hpp"
#include "run/extra_final_step.hpp"
#include "run/interruption.hpp"
#include "run/prestress.hpp"
#include "run/program.hpp"
#include "run/result_place.hpp"
#include "run/run_account.hpp"
#include "run/run_checkpoints.hpp"
#include "run/run_parts.hpp"
#include "scene/time_scheme.hpp"
#include "time/balance.hpp"
#include "time/time_text.hpp"

namespace fsi {

namespace {

/// Runs the action; returns the message of the WriteError it threw, or an empty string.
template <class Action>
std::string write_error_of(Action action) {
  try {
    action();
  } catch (const WriteError& failure) {
    return failure.what();
  }
  return {};
}

StepRecord record_of(const StepReport& report, const State& state, double seconds) {
  StepRecord record;
  record.step = state.step;
  record.time = state.time;
  record.outer_iterations = report.outer_iterations;
  record.newton_iterations = report.newton_iterations;
  record.linear_iterations = report.linear_iterations;
  record.wall_seconds = seconds;
  record.solver_error = report.solver_error;
  return record;
}

template <int n>
RunView<n> watched(RunParts<n>& parts) {
  auto& loaded = parts.loaded;
  return {parts.setup,        parts.scene,       parts.loads,
          *parts.stepper,     parts.state,       parts.scene.is_static() ? 0 : scene_time(parts.setup, parts.scene),
          loaded.points,      loaded.derived,    loaded.grids,
          loaded.grid_shares, parts.line.output, parts.line.restart,
          parts.messages};
}

template <int n>
class Run {
 public:
  explicit Run(RunParts<n>& parts)
      : parts_(parts), observers_(watched(parts)), account_(parts), checkpoints_(parts, observers_) {}

  int march() {
    const Activity activity("preparing the first step");
    prepare();
    try {
      parts_.about_processes.steps_begin();
      while (!is_finished() && !is_stopped()) {
        step();
        account_.measure_work_unit();
      }
      if (is_finished()) end();
      if (is_finished()) observers_.end();
    } catch (const Stopped&) {
      parts_.loads.axis().drop_insertions_after(state().step);
      gave_up_step_ = is_stopped();
    } catch (const ConvergenceError& failure) {
      without_solution(failure);
    } catch (const WriteError& failure) {
      static_cast<void>(write_error_of([&] { log_->error(failure.what()); }));  // perhaps it is the log that failed
      throw;
    }
    folder_->close();
    if (!is_finished()) return interrupted();
    if (const std::string about = account_.about_steps(); !about.empty()) log_->info(about);
    log_->info("done");
    log_->close();
    account_.write_status("done");  // last: whoever reads it finds everything on the disk
    return exit_done;
  }

 private:
  State& state() { return parts_.state; }
  int last_step() const { return parts_.loads.steps(); }
  bool is_finished() const { return parts_.state.step == last_step() || observers_.want_end(); }

  /// From what the earlier run has left, where there is one, to the moment before the first step.
  void prepare() {
    const CommandLine& line = parts_.line;
    // All that a restart reads is checked before anything is written.
    std::optional<EarlierTables> earlier = checkpoints_.recall();
    complete_ = state().step;
    parts_.stepper->keep_balances(observers_.want_balances());
    note_signals();           // until here nothing has been written
    parts_.processes.wait();  // until all have read
    if (earlier)
      folder_.emplace(line.output, observers_.tables(), table_files(), *earlier, parts_.first);
    else
      folder_.emplace(line.output, observers_.tables(), table_files(), parts_.first);
    earlier.reset();
    log_.emplace(line.output, in_place(line), parts_.first);
    if (const auto& prestress = parts_.loaded.prestress)
      write_checkpoint(prestress_file(line.output), *prestress, parts_.processes,
                       parts_.orders.sharing(prestress->kinds));
    observers_.begin(state());
    parts_.loading.end();
    console_.emplace(last_step(), Console::style_for(line.quiet || !parts_.first.is_here()));
    parts_.messages.to(*log_, *console_);
    answer_signals_within({});
    parts_.first.now([&] { require_no_run_in_source(line); });  // while it was read
    account_.begin();
    account_.write("running");
    announce(parts_, checkpoints_, *console_, *log_);
    watch_console();
    if (state().step == 0) return observers_.look(state());
    checkpoints_.vouch(*folder_);
    // A new folder can be gone on from as soon as it holds all that the earlier one has.
    if (checkpoints_.writes_any() && !in_place(line)) checkpoints_.save();
  }

  std::string said(double time) const { return time_text(time, parts_.scene.is_static()); }

  void step() {
    const auto start = Clock::now();
    console_->expect(last_step());
    console_->working(state().step + 1, said(parts_.loads.time_of(state().step + 1)), "solving");
    checkpoints_.keep_finished();
    const StepReport report = [&] {
      const Activity activity("solving a step");
      return parts_.march.step(state());
    }();
    const Activity activity("writing results");
    parts_.first.later([&] { parts_.lock->require_held(); });
    const StepRecord record = record_of(report, state(), seconds_since(start));
    account_.add(record, state().times[0] - state().times[1]);
    observers_.after_step({record, report, state()}, *folder_);
    if (const State& shown = parts_.shown_level(); shown.step > 0) observers_.look(shown, *folder_);
    {
      const auto phase = parts_.scene.profile.phase("output");
      checkpoints_.vouch(*folder_);
      parts_.first.agree();  // the tables hold what the checkpoint says
    }
    if (checkpoints_.is_due(is_finished())) checkpoints_.save();
    complete_ = state().step;
    const auto& errors = parts_.march.errors();
    log_->info(fmt::format("step {}  {}  coupling {}  newton {}{}", record.step, said(record.time),
                           record.outer_iterations, record.newton_iterations,
                           errors && errors->known ? "  error: " + errors->text() : ""));
    console_->expect(last_step());
    for (const auto& entry : report.history) log_->info("  " + entry);
    console_->step_done(record, said(record.time));
    account_.add_seconds(seconds_since(start));
    watch_console();
    const double waited = longest_time_between_looks();
    answer_signals_within(std::max(waited, waited_));
    waited_ = waited;
  }

  /// What is left to do after the last step, whose state is saved.
  void end() {
    if (const std::string open = parts_.stepper->unchecked(); !open.empty()) {
      parts_.messages.note("unchecked", open);
      log_->warning(open);
      warn(parts_.program, open);
    }
    account_.take_stock();
    if (!parts_.lagging()) return;
    const Activity activity("settling the pressures of the last level");
    if (pressures_settled(state()) || !shows_pressures())
      observers_.look(state(), *folder_);
    else if (const auto last = settled_last_level())
      observers_.look(*last, *folder_);
    parts_.first.agree();
  }

  /// The last level with the pressures that it has in a longer run, by a step behind the end of this one, which counts
  /// apart. Empty, and said, where there is none: then tables and fields end with the level before.
  std::optional<State> settled_last_level() {
    const auto start = Clock::now();
    auto& account = parts_.messages.summary["step_behind_the_end"];
    const auto leave_out = [&](const std::string& why) {
      account["failure"] = why;
      const auto said = fmt::format(
          "tables and fields lack the last level, t = {:g} ms: its pressures are interpolated up to a step behind the "
          "end of the run, {}",
          state().time, why);
      log_->warning(said);
      warn(parts_.program, said);
      return std::nullopt;
    };
    if (is_stopped()) return leave_out("which was interrupted");
    console_->working(state().step, said(state().time), "settling the pressures of the last level");
    log_->info(
        fmt::format("a step behind the end settles the pressures of t = {:g} ms, and is not kept", state().time));
    parts_.stepper->keep_balances(false);
    try {
      const ExtraFinalStep beyond = extra_final_step(parts_.setup, state(), parts_.loads, parts_.march);
      account = {{"outer_iterations", beyond.report.outer_iterations},
                 {"newton_iterations", beyond.report.newton_iterations},
                 {"linear_iterations", beyond.report.linear_iterations},
                 {"wall_s", seconds_since(start)}};
      return parts_.level_before(beyond.state);
    } catch (const Stopped&) {
      return leave_out("which was interrupted");
    } catch (const ConvergenceError& failure) {
      account["wall_s"] = seconds_since(start);
      return leave_out(fmt::format("which found no solution ({})", failure.what()));
    }
  }

  /// Whether tables or fields show pressures, of the fluid or of the wall.
  bool shows_pressures() const {
    const auto& requested = parts_.loaded.points.requested;
    return parts_.scene.fluid || !requested.points.empty() || !requested.lines.empty() || writes_fields(parts_.setup);
  }

  /// A step has no solution: the run leaves what it has, and ends.
  [[noreturn]] void without_solution(const ConvergenceError& failure) {
    const std::string hint = failure_hint(parts_.setup, parts_.scene, parts_.loads, state());
    std::string said = hint.empty() ? failure.what() : fmt::format("{} [{}]", failure.what(), hint);
    parts_.messages.note("failure", said);
    // What cannot be written now must not hide why the run ends.
    const std::string not_logged = write_error_of([&] {
      for (const auto& entry : parts_.stepper->report().history) log_->info("  " + entry);
      log_->error(said);
    });
    const std::string not_closed = write_error_of([&] { folder_->close(); });
    const bool whole = complete_ == state().step;  // else its tables are not, and the last checkpoint stays
    const std::string not_saved = write_error_of([&] {
      if (state().step > 0 && whole) checkpoints_.save();
    });
    const std::string not_summed_up = write_error_of([&] { account_.write("not converged"); });
    if (state().step > 0 && whole && not_saved.empty())
      said += fmt::format(
          " [the state after step {} is saved; with other solver settings, or another step, continue by: {}]",
          state().step, restart_command(parts_.line));
    for (const auto& besides : {not_logged, not_closed, not_saved, not_summed_up})
      if (!besides.empty()) said += fmt::format(" [besides, {}]", besides);
    throw ConvergenceError(said, "");
  }

  /// Whether a signal has come to one of the processes: they stop after the same step.
  bool is_stopped() {
    signal_ = static_cast<int>(parts_.processes.largest(look_for_stop()));
    return signal_ != 0;
  }

  /// Leaves a folder that a later run goes on from.
  int interrupted() {
    std::string said = "before the end of the first step; nothing is lost by starting again";
    if (gave_up_step_) log_->info(fmt::format("step {} is given up", state().step + 1));
    if (state().step > 0) {
      if (gave_up_step_)
        checkpoints_.save_finished();
      else
        checkpoints_.save();
      said = fmt::format("after step {} of {}, whose state is saved; continue by: {}", state().step, last_step(),
                         restart_command(parts_.line));
    }
    log_->warning("interrupted " + said);
    account_.write("interrupted");
    print_error((parts_.program + ": interrupted " + printable(said) + "\n").c_str());
    return interrupted_exit_code(signal_);
  }

  /// What a signal is answered from now on: when the run will look for it, as far as the last two steps tell.
  void answer_signals_within(std::optional<double> seconds) {
    if (!parts_.line.quiet) answer_signals(parts_.program, seconds, console_->rewrites());
  }

  /// Says once that progress cannot be shown any more. A reader that has closed the stream has seen what it wanted.
  void watch_console() {
    if (console_->error() == 0 || console_failed_) return;
    console_failed_ = true;
    const auto said =
        fmt::format("the standard output cannot be written ({}); the run goes on without showing progress",
                    std::strerror(console_->error()));
    log_->warning(said);
    if (!nobody_reads(console_->error())) warn(parts_.program, said);
  }

  RunParts<n>& parts_;
  Observers observers_;
  RunAccount<n> account_;
  RunCheckpoints<n> checkpoints_;
  std::optional<ResultFolder> folder_;
  std::optional<RunLog> log_;
  std::optional<Console> console_;
  bool console_failed_ = false;
  int complete_ = 0;           ///< last step whose rows are all written
  int signal_ = 0;             ///< that has come to one of the processes
  bool gave_up_step_ = false;  ///< in the middle, at a signal
  double waited_ = 0;          ///< s, longest time of the last step in which no signal was looked for
};

}  // namespace

template <int n>
int run_case(const std::string& program, const CommandLine& line, const Case& setup, const StepperMaker& make_stepper,
             const CoreWatch& watch, const std::optional<FolderLock>& lock) {
  RunParts<n> parts(program, line, setup, make_stepper, watch, lock);
  return Run<n>(parts).march();
}

#define FSI_INSTANTIATE(n)                                                                                             \
  template int run_case<n>(const std::string&, const CommandLine&, const Case&, const StepperMaker&, const CoreWatch&, \
                           const std::optional<FolderLock>&);
FSI_FOR_EACH_DIMENSION(FSI_INSTANTIATE)
#undef FSI_INSTANTIATE

}  // namespace fsi
