#include "driver/driver.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>

#include "base/error.hpp"
#include "base/finite.hpp"
#include "base/idle_cores.hpp"
#include "base/memory.hpp"
#include "base/printable.hpp"
#include "base/standard_streams.hpp"
#include "base/stop_request.hpp"
#include "base/stopwatch.hpp"
#include "base/threads.hpp"
#include "base/version.hpp"
#include "case/case_hash.hpp"
#include "case/case_reader.hpp"
#include "case/statistics_period.hpp"
#include "diagnostics/energy_balance.hpp"
#include "diagnostics/failure_hint.hpp"
#include "diagnostics/ringing_monitor.hpp"
#include "driver/check.hpp"
#include "driver/checkpoint_arrays.hpp"
#include "driver/checkpoint_pace.hpp"
#include "driver/command_line.hpp"
#include "driver/console.hpp"
#include "driver/cost_summary.hpp"
#include "driver/field_output.hpp"
#include "driver/interruption.hpp"
#include "driver/load_scene.hpp"
#include "driver/loading_report.hpp"
#include "driver/march.hpp"
#include "driver/observables.hpp"
#include "driver/opening_observer.hpp"
#include "driver/prestress.hpp"
#include "driver/process_summary.hpp"
#include "driver/process_threads.hpp"
#include "driver/program.hpp"
#include "driver/ringing_remedy.hpp"
#include "driver/state_checkpoint.hpp"
#include "driver/step_beyond.hpp"
#include "io/earlier_fields.hpp"
#include "io/first_process.hpp"
#include "io/folder_lock.hpp"
#include "io/hdf5_library.hpp"
#include "io/run_log.hpp"
#include "io/summary.hpp"
#include "io/write_error.hpp"
#include "linear_solvers/general_solvers.hpp"
#include "parallel/communicator.hpp"
#include "petsc_solver/petsc_options.hpp"
#include "scene/time_scheme.hpp"
#include "system/work_unit.hpp"
#include "time/balance.hpp"
#include "time/time_schemes.hpp"

namespace fsi {

namespace {

constexpr const char* scheme_name = "time_scheme";           // the run's, as the number of its TimeScheme
constexpr const char* field_entries_name = "field_entries";  // written up to the last level observed

template <int n>
nlohmann::json scene_json(const std::string& program, const Case& setup, const MeshFacts& mesh, const Scene<n>& scene) {
  nlohmann::json json;
  json["program"] = program;
  json["version"] = version;
  json["machine"] = machine_json();
  json["build"] = build_json();
  json["title"] = setup.title;
  json["case"] = setup.path.string();
  json["case_hash"] = hash_of_case(setup);
  json["threads"] = threads();
  json["element"] = element_pairs().name_of(setup.element);
  json["geometry"] = geometries().name_of(setup.geometry);
  const SceneSize size = size_of(scene);
  json["processes"] = scene.processes().size();
  json["mesh"] = {{"name", mesh.name},
                  {"hash", mesh.hash},
                  {"nodes", mesh.nodes},
                  {mesh.cell, mesh.cells},
                  {"fluid_nodes", size.fluid_nodes},
                  {"wall_nodes", size.wall_nodes},
                  {"interface_nodes", size.interface_nodes}};
  // The interface counts once, with the wall: the sub-problems share no unknowns.
  json["unknowns"] = {{"coupled", size.fluid_unknowns + size.wall_unknowns + size.mesh_unknowns},
                      {"fluid", size.fluid_unknowns},
                      {"wall", size.wall_unknowns},
                      {"mesh_motion", size.mesh_unknowns}};
  return json;
}

/// Whether a run goes on in the folder that it began in.
bool in_place(const CommandLine& line) {
  std::error_code error;
  return !line.restart.empty() &&
         (line.output == line.restart || std::filesystem::equivalent(line.output, line.restart, error));
}

/// A run that is going on is no run to continue: its files are of different steps at different moments.
void require_no_run_in_source(const CommandLine& line) {
  if (!line.restart.empty() && !in_place(line))
    require_no_run_in(line.restart, "wait for its end, or stop it (Ctrl-C), before it is continued");
}

/// Nothing is replaced that the user has not named, whether to be replaced or to be continued. Changes nothing.
void require_folder(const CommandLine& line) {
  if (!line.restart.empty()) require_regular_results(line.restart, true);
  require_regular_results(line.output, false);
  if (in_place(line)) return;
  if (!line.force) require_no_results(line.output, restart_command(line));
  require_results_only(line.output);
}

/// What a WriteError said that an action ended with; empty when it came to its end.
template <class Action>
std::string write_error_of(Action action) {
  try {
    action();
  } catch (const WriteError& failure) {
    return failure.what();
  }
  return {};
}

/// One run: everything from the scene at rest, or a checkpoint, to the last step.
template <int n>
class Run {
 public:
  /// \param watch  of the cores, from the program's start on
  /// \param lock   of the result folder; empty at all processes but the first
  Run(const std::string& program, const CommandLine& line, const Case& setup, const StepperMaker& make_stepper,
      const CoreWatch& watch, const std::optional<FolderLock>& lock)
      : program_(program),
        line_(line),
        lock_(lock),
        setup_(setup),
        loading_(program, line.quiet),
        loaded_(load_scene<n>(setup, loading_.follower([&](std::size_t cells) {
          threads_ = set_as_chosen(threads_of_process(line.threads, cells, watch, Communicator::world()));
        }))),
        scene_(loaded_.scene.get()),
        processes_(shared_by_all(*scene_)),
        first_(processes_),
        about_processes_(*scene_),
        work_unit_(*scene_),
        orders_(*scene_, loaded_.derived.statistics ? &loaded_.derived.shear->nodes() : nullptr),
        loads_(setup),
        stepper_(make_stepper.make(*scene_, loads_, setup)),
        march_(setup, *scene_, *stepper_, loads_, [this](const std::string& said) { say(said); }),
        state_(scene_->at_rest()),
        observables_(loaded_.points, *scene_),
        openings_(setup, *scene_) {
    set_memory_notices([this](const std::string& said) { say(said); });
    if (scene_->is_static()) return;
    scheme_ = time_scheme_of(setup_, *scene_);
    ringing_.emplace(scene_time(setup, *scene_));
    require_resolvable(setup, *scene_);
  }
  ~Run() { set_memory_notices({}); }
  Run(const Run&) = delete;
  Run& operator=(const Run&) = delete;

  /// To the last step or a signal; returns the program's exit code.
  int march() {
    const Activity activity("preparing the first step");
    const bool restarted = !line_.restart.empty();
    ResultTables tables = observables_.tables();
    tables.openings = openings_.names();
    tables.coupling = stepper_->reports_coupling();
    if (setup_.output.energy) tables.energy = EnergyBalance<n>::parts_of(*scene_);
    if (loaded_.derived.forces) tables.surfaces = loaded_.derived.forces->names();
    // All that a restart reads is checked before anything is written.
    std::optional<EarlierTables> earlier;
    if (restarted) earlier = recall(tables);
    if (setup_.output.energy) {
      const auto phase = scene_->profile.phase("energy balance");
      energy_.emplace(*scene_, state_);
    }
    stepper_->keep_balances(energy_ || loaded_.derived.forces);
    note_signals();     // until here nothing has been written
    processes_.wait();  // until all have read
    ResultFolder folder =
        earlier ? ResultFolder(line_.output, tables, *earlier, first_) : ResultFolder(line_.output, tables, first_);
    earlier.reset();
    RunLog log(line_.output, in_place(line_), first_);
    log_ = &log;
    if (loaded_.prestress)
      write_checkpoint(prestress_file(line_.output), *loaded_.prestress, processes_, orders_.sharing());
    FieldOutput<n> fields(setup_, *scene_, loaded_.derived, loaded_.grids, std::move(loaded_.grid_shares),
                          loads_.axis(), line_.output, line_.restart, restarted ? observed_until() : 0);
    loading_.end();
    Console console(loads_.steps(), Console::style_for(line_.quiet || !first_.is_here()));

    answer_signals_within({}, console);

    if (restarted) first_.now([&] { require_no_run_in_source(line_); });  // while it was read
    summary_ = scene_json(program_, setup_, loaded_.mesh, *scene_);
    if (restarted) summary_["restarted_from_step"] = state_.step;
    write("running");
    announce(console, log);
    watch_console(console, log);
    if (!restarted) take_in(state_);
    if (!restarted && fields.write(state_)) field_entries_ = 1;
    if (restarted) vouch(folder);
    if (restarted && wants_fields())
      field_entries_ = found_field_entries(line_.output);
    else if (restarted && !std::filesystem::exists(line_.output / "fields.h5"))
      field_entries_ = 0;
    // A new folder can be gone on from as soon as it holds all that the earlier one has.
    if (restarted && pace_.writes_any() && !in_place(line_)) save();
    try {
      about_processes_.steps_begin();
      while (state_.step < loads_.steps() && !is_stopped()) {
        step(folder, fields, console, log);
        measure_work_unit();
      }
      if (state_.step == loads_.steps()) end(folder, fields, console, log);
    } catch (const Stopped&) {
      loads_.axis().drop_insertions_after(state_.step);
      gave_up_step_ = is_stopped();
    } catch (const ConvergenceError& failure) {
      const std::string hint = failure_hint(setup_, *scene_, loads_, state_);
      std::string said = hint.empty() ? failure.what() : fmt::format("{} [{}]", failure.what(), hint);
      summary_["failure"] = said;
      // What cannot be written now must not hide why the run ends.
      const std::string not_logged = write_error_of([&] {
        for (const auto& entry : stepper_->report().history) log.info("  " + entry);
        log.error(said);
      });
      const std::string not_closed = write_error_of([&] { folder.close(); });
      const bool whole = complete_ == state_.step;  // else its tables are not, and the last checkpoint stays
      const std::string not_saved = write_error_of([&] {
        if (state_.step > 0 && whole) save();
      });
      const std::string not_summed_up = write_error_of([&] { write("not converged"); });
      if (state_.step > 0 && whole && not_saved.empty())
        said += fmt::format(
            " [the state after step {} is saved; with other solver settings, or another step, continue "
            "by: {}]",
            state_.step, restart_command(line_));
      for (const auto& besides : {not_logged, not_closed, not_saved, not_summed_up})
        if (!besides.empty()) said += fmt::format(" [besides, {}]", besides);
      throw ConvergenceError(said, "");
    } catch (const WriteError& failure) {
      static_cast<void>(write_error_of([&] { log.error(failure.what()); }));  // perhaps it is the log that failed
      throw;
    }
    folder.close();
    if (state_.step < loads_.steps()) return interrupted(signal_, log);
    sum_up_steps(log);
    log.info("done");
    log.close();
    write_status("done");  // last: whoever reads it finds everything on the disk
    return exit_done;
  }

 private:
  static ThreadChoice set_as_chosen(const ThreadChoice& choice) {
    set_threads(choice.count);
    return choice;
  }

  /// \throws InputError where a scene is not shared out by all processes
  static const Communicator& shared_by_all(const Scene<n>& scene) {
    if (scene.processes().size() == Communicator::world().size()) return scene.processes();
    throw InputError("mpirun", "", "this scene works on one process", "start the program by itself");
  }

  /// Whether a signal has come to one of the processes: they stop after the same step.
  bool is_stopped() {
    signal_ = static_cast<int>(processes_.largest(look_for_stop()));
    return signal_ != 0;
  }

  /// Leaves a folder that a later run goes on from.
  int interrupted(int signal, RunLog& log) {
    std::string said = "before the end of the first step; nothing is lost by starting again";
    if (gave_up_step_) log.info(fmt::format("step {} is given up", state_.step + 1));
    if (state_.step > 0) {
      if (!gave_up_step_)
        save();
      else if (finished_)
        save(*finished_);
      said = fmt::format("after step {} of {}, whose state is saved; continue by: {}", state_.step, loads_.steps(),
                         restart_command(line_));
    }
    log.warning("interrupted " + said);
    write("interrupted");
    print_error((program_ + ": interrupted " + printable(said) + "\n").c_str());
    return interrupted_exit_code(signal);
  }

  void step(ResultFolder& folder, FieldOutput<n>& fields, Console& console, RunLog& log) {
    const auto start = Clock::now();
    console.expect(loads_.steps());
    console.working(state_.step + 1, loads_.time_of(state_.step + 1), "solving");
    keep_finished();
    const StepReport report = [&] {
      const Activity activity("solving a step");
      return march_.step(state_);
    }();
    const Activity activity("writing results");
    note_length(state_.times[0] - state_.times[1]);
    watch_ringing(report, console, log);
    first_.later([&] { lock_->require_held(); });
    StepRecord record;
    record.step = state_.step;
    record.time = state_.time;
    record.outer_iterations = report.outer_iterations;
    record.newton_iterations = report.newton_iterations;
    record.linear_iterations = report.linear_iterations;
    record.wall_seconds = seconds_since(start);
    total_.outer_iterations += record.outer_iterations;
    total_.newton_iterations += record.newton_iterations;
    total_.linear_iterations += record.linear_iterations;
    total_.wall_seconds += record.wall_seconds;
    record.solver_error = report.solver_error;
    total_.solver_error = std::max(total_.solver_error, record.solver_error);
    if (energy_) {
      const auto phase = scene_->profile.phase("energy balance");
      folder.write_energy(record, energy_->step_to(state_, report));
    }
    {
      const auto phase = scene_->profile.phase("output");
      folder.write_iterations(record);
      if (report.coupling) folder.write_coupling(record, *report.coupling);
      if (loaded_.derived.forces) write_forces(report.balances.back(), folder);
      if (lagging() && state_.step > 1) observe(level_before(state_), folder, fields);
      if (lagging()) vouch(folder);
      if (!lagging()) observe(state_, folder, fields);
      if (!lagging()) vouch(folder);
      first_.agree();  // the tables hold what the checkpoint says
    }
    if (checkpoint_is_due()) save();
    complete_ = state_.step;
    log.info(fmt::format("step {}  t = {:g} ms  coupling {}  newton {}{}", record.step, record.time,
                         record.outer_iterations, record.newton_iterations,
                         march_.errors() && march_.errors()->known ? "  error: " + march_.errors()->text() : ""));
    console.expect(loads_.steps());
    for (const auto& entry : report.history) log.info("  " + entry);
    console.step_done(record);
    step_seconds_ += seconds_since(start);
    watch_console(console, log);
    const double waited = longest_time_between_looks();
    answer_signals_within(std::max(waited, waited_), console);
    waited_ = waited;
  }

  /// After a step: the matrices are there, and the run has taken long enough for a product to be nothing beside it.
  void measure_work_unit() {
    const Traffic before = processes_.traffic();
    work_unit_.measure(seconds_since(start_));
    about_processes_.leave_out_since(before);
  }

  /// What a signal is answered from now on: when the run will look for it, as far as the last two steps tell.
  void answer_signals_within(std::optional<double> seconds, const Console& console) {
    if (!line_.quiet) answer_signals(program_, seconds, console.rewrites());
  }

  /// Before a step that may have to be given up. What it leaves behind would not go on to the same bits, so that the
  /// checkpoint is of what there is now; where the folder has it, nothing needs to be kept.
  void keep_finished() {
    finished_.reset();
    if (state_.step > 0 && saved_ != state_.step) finished_ = checkpoint_of_now();
  }

  /// What is left to do after the last step, whose state is saved.
  void end(ResultFolder& folder, FieldOutput<n>& fields, Console& console, RunLog& log) {
    if (const std::string open = stepper_->unchecked(); !open.empty()) {
      summary_["unchecked"] = open;
      log.warning(open);
      warn(program_, open);
    }
    take_stock();
    if (!lagging()) return;
    const Activity activity("settling the pressures of the last level");
    if (pressures_settled(state_) || !shows_pressures())
      observe(state_, folder, fields);
    else if (const auto last = settled_last_level(console, log))
      observe(*last, folder, fields);
    first_.agree();
  }

  /// The last level with the pressures that it has in a longer run, by a step behind the end of this one, which counts
  /// apart. Empty, and said, where there is none: then tables and fields end with the level before.
  std::optional<State> settled_last_level(Console& console, RunLog& log) {
    const auto start = Clock::now();
    auto& account = summary_["step_behind_the_end"];
    const auto leave_out = [&](const std::string& why) {
      account["failure"] = why;
      const auto said = fmt::format(
          "tables and fields lack the last level, t = {:g} ms: its pressures are interpolated up to a step behind the "
          "end of the run, {}",
          state_.time, why);
      log.warning(said);
      warn(program_, said);
      return std::nullopt;
    };
    if (is_stopped()) return leave_out("which was interrupted");
    console.working(state_.step, state_.time, "settling the pressures of the last level");
    log.info(fmt::format("a step behind the end settles the pressures of t = {:g} ms, and is not kept", state_.time));
    stepper_->keep_balances(false);
    try {
      const StepBeyond beyond = step_beyond(setup_, state_, loads_, march_);
      account = {{"outer_iterations", beyond.report.outer_iterations},
                 {"newton_iterations", beyond.report.newton_iterations},
                 {"linear_iterations", beyond.report.linear_iterations},
                 {"wall_s", seconds_since(start)}};
      return level_before(beyond.state);
    } catch (const Stopped&) {
      return leave_out("which was interrupted");
    } catch (const ConvergenceError& failure) {
      account["wall_s"] = seconds_since(start);
      return leave_out(fmt::format("which found no solution ({})", failure.what()));
    }
  }

  /// Whether tables or fields show pressures, of the fluid or of the wall.
  bool shows_pressures() const {
    const auto& requested = loaded_.points.requested;
    return scene_->fluid || !requested.points.empty() || !requested.lines.empty() || wants_fields();
  }

  void note_length(double step) {
    shortest_step_ = longest_step_ == 0 ? step : std::min(shortest_step_, step);
    longest_step_ = std::max(longest_step_, step);
  }

  /// Says once that progress cannot be shown any more. A reader who went away has seen what he wanted.
  void watch_console(const Console& console, RunLog& log) {
    if (console.error() == 0 || console_failed_) return;
    console_failed_ = true;
    const auto said =
        fmt::format("the standard output cannot be written ({}); the run goes on without showing progress",
                    std::strerror(console.error()));
    log.warning(said);
    if (!nobody_reads(console.error())) warn(program_, said);
  }

  /// Into the log, of a step in progress.
  void say(const std::string& text) {
    if (log_ != nullptr) log_->warning(text);
  }

  /// Names a pressure that alternates from step to step, once, and keeps the largest of it.
  void watch_ringing(const StepReport& report, Console& console, RunLog& log) {
    if (scene_->is_static() || loaded_.points.centre_line.empty()) return;
    // On the centre line: at the rim of the inlet, where the pressure is singular, nodes always tremble.
    const auto pressures = observables_.centre_line_pressure(state_.last_balance().fluid);
    for (const double p : pressures) largest_pressure_ = std::max(largest_pressure_, std::abs(p));
    const auto amplitude = ringing_->look(state_.has_balances() ? state_.balance_times[0] : state_.time, pressures);
    if (loads_.axis().jumps_at(state_.time)) ringing_->restart();
    if (!amplitude || *amplitude <= ringing_amplitude_) return;
    const bool first = ringing_amplitude_ == 0;
    ringing_amplitude_ = *amplitude;
    const std::string said =
        said_of({*amplitude, state_.time, largest_pressure_, std::max(total_.solver_error, report.solver_error),
                 report.coupling.has_value(), scene_->integrator->against_ringing()},
                setup_);
    summary_["ringing"] = {{"amplitude_Pa", 1e3 * *amplitude}, {"time_ms", state_.time}, {"said", said}};
    if (!first) return;
    console.line(said);
    log.warning(said);
  }

  /// Whether a level is looked at one step later, when its pressures are known.
  bool lagging() const { return scene_->integrator->pressures_lag(); }
  /// Time of the last level that tables and fields hold, ms.
  double observed_until() const { return lagging() ? state_.times[1] : state_.time; }
  void observe(const State& level, ResultFolder& folder, FieldOutput<n>& fields) {
    observables_.write(level, folder);
    openings_.write(level, folder);
    take_in(level);
    if (fields.write(level) && level.time <= observed_until()) ++field_entries_;
  }
  /// Into the statistics over periods, if there are any.
  void take_in(const State& level) {
    auto& statistics = loaded_.derived.statistics;
    if (!statistics) return;
    const auto phase = scene_->profile.phase("wall shear stress");
    statistics->add(level.time, loaded_.derived.shear->at_nodes(level.now));
  }
  /// The forces of a balance, at its time.
  void write_forces(const Balance& balance, ResultFolder& folder) {
    const auto phase = scene_->profile.phase("surface forces");
    const auto& forces = *loaded_.derived.forces;
    const auto found = forces.at(balance);
    std::vector<SurfaceRecord> records;
    for (std::size_t i = 0; i < found.size(); ++i) {
      const auto &f = found[i].force, &p = found[i].pressure;
      records.push_back({forces.names()[i], found[i].area, {f[0], f[1], f[2]}, {p[0], p[1], p[2]}});
    }
    folder.write_surfaces(balance.data.rates.time, records);
  }
  /// The tables hold what a restart from this step goes on from.
  void vouch(ResultFolder& folder) {
    folder.take_digests();
    digests_ = folder.digests();
  }
  /// The last level but one as a state, for those who look at it.
  const State& level_before(const State& state) {
    shown_.step = state.step - 1;
    shown_.time = state.times[1];
    shown_.now = state.before[1];
    shown_.wall_velocity = state.wall_velocity_before;
    return shown_;
  }

  void announce(Console& console, RunLog& log) {
    const auto text = fmt::format(
        "{} {}: {} | {} nodes, {} {}, {} unknowns, {}{} threads{}, {}", program_, version, shortened(setup_.title, 200),
        loaded_.mesh.nodes, loaded_.mesh.cells, loaded_.mesh.cell, summary_["unknowns"]["coupled"].get<long>(),
        processes_.is_alone() ? "" : fmt::format("{} processes, ", processes_.size()), threads(),
        processes_.is_alone() ? "" : " each",
        loads_.axis().is_adaptive() ? fmt::format("adaptive steps, tolerance {:g}", setup_.time->tolerance)
                                    : fmt::format("{} steps", loads_.steps()));
    console.line(text);
    log.info(text);
    log.info(fmt::format("threads: {}, {}", threads_.count, threads_.reason));
    announce_steps(log);
    const bool sub_problems = program_ == "fsi-partitioned" && scene_->coupled();
    if (const std::string other =
            other_solver_on_processes(sub_problems ? setup_.partitioned.linear_solver : setup_.monolithic.linear_solver,
                                      sub_problems ? setup_.partitioned.fast : setup_.monolithic.fast, n, processes_);
        !other.empty())
      log.info(other);
    for (const auto& choice : stepper_->choices()) {
      log.info(fmt::format("{} = {}: {}", choice.key, choice.value, choice.reason));
      summary_["choices"][choice.key] = {{"value", choice.value}, {"reason", choice.reason}};
    }
    for (const auto& warning : setup_.warnings) log.warning(warning);
    loading_.write_to(log);
    for (const auto& notice : scene_->notices) {
      log.warning(notice);
      warn(program_, notice);
    }
    for (const auto& remark : scene_->remarks) log.info(remark);
    if (const auto said = about_statistics(setup_); !said.empty()) log.info(said);
    for (const auto& note : loaded_.points.notes) log.info(note);
    for (const auto& warning : loaded_.points.warnings) {
      log.warning(warning);
      warn(program_, warning);
    }
    if (lock_ && !lock_->said().empty()) log.warning(lock_->said());
    if (state_.step == 0) return;
    log.info(fmt::format("restarted after step {}, t = {:g} ms", state_.step, state_.time));
    if (!statistics_begin_.empty()) log.warning(statistics_begin_);
    if (!step_change_.empty()) {
      console.line(step_change_);
      log.info(step_change_);
    }
  }

  /// The time scheme, and steps at the end that are shorter.
  void announce_steps(RunLog& log) {
    if (scene_->is_static()) return;
    if (const std::string why = about_time_scheme(setup_, *scene_, scheme_); !why.empty()) log.info(why);
    const bool adaptive = setup_.time->adaptive;
    const double step = setup_.time->step, longest = adaptive ? std::numeric_limits<double>::infinity() : step;
    if (const std::string about = scene_->integrator->about(step, longest); !about.empty()) log.info(about);
    if (const double last = loads_.axis().shorter_last_steps(); last > 0)
      log.info(fmt::format("the last steps have {:.6g} ms in place of {:g} ms: the run ends at {:.12g} ms", last, step,
                           setup_.time->end));
    if (const std::string said = lost_order(*setup_.time, *scene_->integrator); !said.empty()) {
      log.warning(said);
      warn(program_, said);
    }
  }
  /// What the scheme made of steps of different length.
  void sum_up_steps(RunLog& log) {
    if (scene_->is_static() || shortest_step_ >= longest_step_ * (1 - 1e-9)) return;
    if (const std::string about = scene_->integrator->about(shortest_step_, longest_step_); !about.empty())
      log.info(fmt::format("steps of {:.4g} to {:.4g} ms: {}", shortest_step_, longest_step_, about));
  }

  Checkpoint checkpoint_of_now() {
    Checkpoint checkpoint;
    checkpoint.program = program_;
    checkpoint.case_hash = hash_of_case(setup_);
    checkpoint.case_text = readable_dump(setup_);
    checkpoint.mesh_hash = loaded_.mesh.hash;
    store(state_, stepper_->memory(), loads_.axis(), checkpoint);
    for (const auto& [name, numbers] : march_.memory()) checkpoint.arrays[march_prefix + name] = numbers;
    if (loaded_.derived.statistics)
      for (const auto& [name, numbers] : loaded_.derived.statistics->memory())
        checkpoint.arrays[statistics_prefix + name] = numbers;
    store(digests_, checkpoint);
    if (!scene_->is_static()) checkpoint.integers[scheme_name] = time_schemes().at(scheme_).number;
    if (field_entries_ > 0) checkpoint.integers[field_entries_name] = field_entries_;
    require_kinds(checkpoint);
    return checkpoint;
  }

  /// After a step, for all processes together: the first one's clock decides.
  bool checkpoint_is_due() {
    if (!pace_.writes_any()) return false;
    if (state_.step == loads_.steps()) return true;
    return processes_.any(first_.is_here() && pace_.is_due(state_.step, seconds_since(start_)));
  }

  void save() {
    const auto phase = scene_->profile.phase("checkpoint");
    const auto start = Clock::now();
    save(checkpoint_of_now());
    saved_ = state_.step;
    pace_.written(seconds_since(start_), seconds_since(start));
  }
  void save(const Checkpoint& checkpoint) {
    do_together(processes_, [&] {
      for (const auto& [name, numbers] : checkpoint.arrays) require_finite(numbers, "the checkpoint's " + name);
    });
    write_checkpoint(checkpoint_file(line_.output), checkpoint, processes_, orders_.sharing());
  }

  /// A scheme that was chosen for the steps of the run so far stays, since the state is its own.
  void keep_scheme(const Checkpoint& checkpoint) {
    if (scene_->is_static() || setup_.time->scheme) return;
    const auto found = checkpoint.integers.find(scheme_name);
    if (found == checkpoint.integers.end() || found->second == time_schemes().at(scheme_).number) return;
    for (const auto chosen : {scheme_for_short_steps, scheme_for_long_steps})
      if (found->second == time_schemes().at(chosen).number) scheme_ = chosen;
    scene_->integrator = make_time_scheme(setup_, *scene_, scheme_);
    state_ = scene_->at_rest();
    march_.keep_scheme();
  }

  /// Takes over what the run in line_.restart has left, if it can be believed: its checkpoint, and the tables, which are
  /// only read. \throws InputError
  EarlierTables recall(const ResultTables& tables) {
    const auto file = checkpoint_file(line_.restart);
    const Checkpoint checkpoint = read_checkpoint(file, processes_, orders_.sharing());
    require_same_run(file, checkpoint, program_, hash_of_case(setup_), loaded_.mesh.hash,
                     difference_of_cases(checkpoint.case_text, readable_dump(setup_)));
    keep_scheme(checkpoint);
    Memory memory;
    do_together(processes_, [&] { memory = restore(file, checkpoint, n * scene_->interface.size(), state_); });
    require_not_beyond(file, state_, setup_.time ? setup_.time->end : 1);
    const EarlierSteps past{checkpoint.step,
                            state_.time,
                            state_.step - (lagging() ? 1 : 0),
                            observables_.points().centre_z,
                            observables_.points().wall_z,
                            stored_digests(checkpoint)};
    EarlierTables earlier(line_.restart, tables, past);
    StoredSteps steps = stored_steps(file, checkpoint, state_, earlier.times());
    if (past.levels > 0) observables_.require_same(lagging() ? level_before(state_) : state_, earlier);
    if (past.levels > 0) openings_.require_same(lagging() ? level_before(state_) : state_, earlier);
    recall_fields(file, checkpoint);

    const Stretch before = steps.stretches.back();
    memory.step_changed =
        loads_.axis().go_on(std::move(steps.stretches), state_.step, state_.time, std::move(steps.insertions));
    std::map<std::string, std::vector<double>> of_march;
    for (const auto& [name, numbers] : checkpoint.arrays)
      if (name.rfind(march_prefix, 0) == 0) of_march[name.substr(std::string(march_prefix).size())] = numbers;
    march_.recall(of_march);
    recall_statistics(checkpoint);
    if (memory.step_changed) step_change_ = text_of_change(before);
    stepper_->recall(memory);
    complete_ = first_step_ = state_.step;
    if (in_place(line_)) saved_ = state_.step;
    return earlier;
  }

  /// The averages in progress. Those of an earlier run without, or of another period, do not serve: then the period that
  /// the restart falls into has none.
  void recall_statistics(const Checkpoint& checkpoint) {
    if (!loaded_.derived.statistics) return;
    std::map<std::string, std::vector<double>> memory;
    const std::string prefix = statistics_prefix;
    for (const auto& [name, numbers] : checkpoint.arrays)
      if (name.rfind(prefix, 0) == 0) memory[name.substr(prefix.size())] = numbers;
    auto& statistics = loaded_.derived.statistics;
    const bool recalled = statistics->recall(memory, loaded_.derived.shear->nodes().size());
    if (!processes_.any(!recalled)) return;
    if (recalled) statistics.emplace(setup_.output.derived.period.value());  // as at the others
    statistics_begin_ = "the statistics begin anew: the earlier run had none of this period";
  }

  /// Entries of fields in a folder up to the last level observed.
  std::int64_t found_field_entries(const std::filesystem::path& folder) const {
    std::int64_t found = 0;
    do_together(processes_, [&] { found = checked_field_entries(folder, loaded_.grids, observed_until()); });
    return found;
  }

  /// The fields of the earlier run, as far as this one goes on with them.
  void recall_fields(const std::filesystem::path& file, const Checkpoint& checkpoint) {
    const auto stored = checkpoint.integers.find(field_entries_name);
    field_entries_ = stored == checkpoint.integers.end() ? 0 : stored->second;
    if (!wants_fields()) return;
    const auto found = found_field_entries(line_.restart);
    if (found < field_entries_)
      throw InputError((line_.restart / "fields.h5").string(), "",
                       fmt::format("{} of {} entries up to {:g} ms are missing, which {} knows of",
                                   field_entries_ - found, field_entries_, observed_until(), file.string()),
                       "bring the file back, or continue without fields by --set output.every=0");
  }
  bool wants_fields() const { return writes_fields(setup_); }

  /// "time.step is 0.0625 ms from step 3 on, 0.125 ms before: 8 steps to come"
  std::string text_of_change(const Stretch& before) const {
    const double asked = loads_.axis().stretches().back().asked;
    if (loads_.axis().is_adaptive())
      return fmt::format("time.step is adaptive from step {} on, {:g} ms before", state_.step + 1, before.asked);
    if (before.asked == 0)
      return fmt::format("time.step is {:g} ms from step {} on, adaptive before: {} steps to come", asked,
                         state_.step + 1, loads_.steps() - state_.step);
    return loads_.axis().is_static()
               ? fmt::format("static.load_steps is {:g} from load step {} on, {:g} before: {} steps to come", asked,
                             state_.step + 1, before.asked, loads_.steps() - state_.step)
               : fmt::format("time.step is {:g} ms from step {} on, {:g} ms before: {} steps to come", asked,
                             state_.step + 1, before.asked, loads_.steps() - state_.step);
  }

  void write(const std::string& status) {
    take_stock();
    write_status(status);
  }
  void write_status(const std::string& status) {
    summary_["status"] = status;
    first_.now([&] { write_summary(line_.output, summary_); });
  }
  /// What the run has taken up to now, into the summary.
  void take_stock() {
    const WorkUnit& unit = work_unit_.unit();
    const int steps = state_.step - first_step_;
    summary_["work_unit"] = work_unit_json(unit);
    summary_["totals"] = {{"steps", state_.step},
                          {"outer_iterations", total_.outer_iterations},
                          {"newton_iterations", total_.newton_iterations},
                          {"linear_iterations", total_.linear_iterations},
                          {"largest_solver_error", total_.solver_error},
                          {"rejected_steps", march_.attempts().rejected},
                          {"steps_above_tolerance", march_.attempts().beyond},
                          {"failed_steps", march_.attempts().failed},
                          {"work_units_per_step", work_units_per_step(unit, total_.wall_seconds, steps)},
                          {"wall_s", seconds_since(start_)}};
    summary_["peak_memory_MiB"] = peak_memory_mib();
    summary_.update(profile_json(scene_->profile));
    if (!processes_.is_alone()) summary_["per_process"] = about_processes_.json(steps, step_seconds_);
  }

  Clock::time_point start_ = Clock::now();
  std::string program_;
  const CommandLine& line_;
  const std::optional<FolderLock>& lock_;
  const Case& setup_;
  ThreadChoice threads_;
  LoadingReport loading_;  ///< what was said when there was no log
  LoadedScene<n> loaded_;
  Scene<n>* scene_;
  const Communicator& processes_;
  FirstProcess first_;
  ProcessSummary<n> about_processes_;
  WorkUnitMeter<n> work_unit_;
  ArrayOrders<n> orders_;
  Loads loads_;
  std::unique_ptr<Stepper> stepper_;
  March<n> march_;
  RunLog* log_ = nullptr;  ///< once there is one
  bool console_failed_ = false;
  std::optional<RingingMonitor> ringing_;
  std::string scheme_;                           ///< in time; empty in statics
  double shortest_step_ = 0, longest_step_ = 0;  ///< ms, of this run so far
  double ringing_amplitude_ = 0;                 ///< kPa, the largest so far
  double largest_pressure_ = 0;                  ///< kPa, on the centre line so far
  int complete_ = 0;                             ///< last step whose rows are all written
  int first_step_ = 0;                           ///< of this program: the one before
  double step_seconds_ = 0;                      ///< of all steps of this program, their output included
  int signal_ = 0;                               ///< that has come to one of the processes
  bool gave_up_step_ = false;                    ///< in the middle, at a signal
  double waited_ = 0;                            ///< s, longest time of the last step in which no signal was looked for
  int saved_ = -1;                               ///< the step whose checkpoint the folder has
  CheckpointPace pace_{{setup_.output.checkpoint_every, setup_.output.checkpoint_seconds}};
  std::optional<Checkpoint> finished_;  ///< of the last finished step, where that is not written
  State state_;
  State shown_;  ///< a finished level, for output
  TableDigests digests_;
  std::int64_t field_entries_ = 0;  ///< of the levels up to observed_until()
  Observables<n> observables_;
  OpeningObserver<n> openings_;
  std::optional<EnergyBalance<n>> energy_;
  StepRecord total_;
  std::string statistics_begin_;  ///< said when they could not be taken over
  std::string step_change_;       ///< said when the run goes on with another step
  nlohmann::json summary_;
};

/// What is done in place of a run is done by one process.
void require_no_other_task(const OtherTask& other) {
  for (const ExtraOption& option : other.options)
    if ((option.flag != nullptr && *option.flag) || (option.text != nullptr && !option.text->empty()))
      throw InputError("mpirun", option.name, "works on one process", "start the program by itself");
}

/// What to do once a file can be written again.
std::string way_on(const CommandLine& line) {
  std::error_code error;
  if (std::filesystem::exists(checkpoint_file(line.output), error)) return "continue by: " + restart_command(line);
  return line.force ? "run it again" : "run it again with --force";
}

}  // namespace

int run_driver(const std::string& program, const std::string& description, int argc, const char* const* argv,
               const StepperMaker& make_stepper, const OtherTask& other) {
  guard_standard_streams();
  wait_briefly(argv);
  end_at_signals(program, "before the first step; nothing is lost by starting again");
  std::optional<ProcessGroup> group;  // to the last words
  return run_program(program, [&] {
    const CoreWatch watch;
    begin_hdf5();
    group.emplace();
    const Communicator& processes = Communicator::world();
    keep_streams_silent(!processes.is_first());
    if (!processes.is_alone()) expect_launcher();
    auto line = parse_command_line(program, description, argc, argv, other.options);
    if (!line) return static_cast<int>(exit_done);
    line->processes = processes.size();
    set_threads(line->threads);  // for the other task; a run chooses
    const Case setup = read_case(line->case_file, line->overrides);
    set_petsc_options(setup.petsc.options, setup.path.string());
    for (const auto& warning : setup.warnings) warn(program, warning);
    if (line->check) {
      const Activity activity("looking at what a run would be");
      return components_of(setup) == 2 ? check_case<2>(program, *line, setup, make_stepper, watch)
                                       : check_case<3>(program, *line, setup, make_stepper, watch);
    }
    if (!processes.is_alone()) require_no_other_task(other);
    if (other.run)
      if (const auto code = other.run(*line, setup)) return *code;
    std::optional<FolderLock> lock;
    at_first(processes, [&] {
      require_no_run_in_source(*line);
      require_no_run_in(line->output, "wait for its end, or give -o another folder");
      require_folder(*line);
      lock.emplace(line->output, program);
      if (!lock->said().empty()) warn(program, lock->said());
      require_folder(*line);  // again: a run may have ended in it meanwhile
    });
    const Activity activity("reading the mesh and building the scene");
    try {
      return components_of(setup) == 2 ? Run<2>(program, *line, setup, make_stepper, watch, lock).march()
                                       : Run<3>(program, *line, setup, make_stepper, watch, lock).march();
    } catch (const WriteError& failure) {
      throw failure.then(way_on(*line));
    }
  });
}

}  // namespace fsi
