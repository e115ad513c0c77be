#include "monolithic/study/linear_study.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <chrono>
#include <cmath>
#include <functional>
#include <limits>
#include <nlohmann/json.hpp>
#include <sstream>

#include "algebra/vector_operations.hpp"
#include "base/error.hpp"
#include "base/names.hpp"
#include "base/output_file.hpp"
#include "base/version.hpp"
#include "case/case_hash.hpp"
#include "host/removed_on_signal.hpp"
#include "host/threads.hpp"
#include "io/atomic_file.hpp"
#include "io/folder_lock.hpp"
#include "linear/choice/general_solvers.hpp"
#include "linear/distributed/petsc_factories.hpp"
#include "linear/interface/jacobian_product.hpp"
#include "monolithic/coupled_numbering.hpp"
#include "monolithic/coupled_solvers/amg/sub_problem_options.hpp"
#include "monolithic/coupled_solvers/block/coupled_system.hpp"
#include "monolithic/linear_solvers.hpp"
#include "monolithic/study/sub_problem_study.hpp"
#include "run/console.hpp"
#include "run/load_scene.hpp"
#include "system/newton_stepper.hpp"

namespace fsi {

namespace {

constexpr int n = 3;  // components: of three-dimensional scenes only
using Json = nlohmann::json;

std::vector<std::string> split(const std::string& text, char separator) {
  std::vector<std::string> parts;
  std::istringstream stream(text);
  for (std::string part; std::getline(stream, part, separator);) parts.push_back(part);
  return parts;
}

double seconds_of(const std::function<void()>& work) {
  const auto start = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// Median of up to `most` timings, fewer once they have taken a second: a single one of a short solve means little.
double median_seconds(int most, const std::function<void()>& work) {
  std::vector<double> times;
  double sum = 0;
  while (static_cast<int>(times.size()) < most && (times.size() < 2 || sum < 1)) {
    times.push_back(seconds_of(work));
    sum += times.back();
    if (times.size() == 1 && sum > 1) break;
  }
  std::sort(times.begin(), times.end());
  return times[times.size() / 2];
}

std::vector<std::string> parse_solvers(const std::string& text) {
  const auto known = linear_solver_names();
  auto names = split(text, ',');
  if (names.empty()) throw InputError("", "--solvers", "no solver named", "give some of " + one_of(known));
  for (const auto& name : names)
    if (std::find(known.begin(), known.end(), name) == known.end()) refuse_name("--solvers", name, known);
  return names;
}

double parse_tolerance(const std::string& text) {
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || !(value > 0 && value < 1))
    throw InputError("", "--tolerance", "\"" + text + "\" is no tolerance", "give a number between 0 and 1");
  return value;
}

/// Largest over the fields of |a - b| / |b|, each field in the 2-norm: no field hides behind another's units.
double difference(const Numbering& numbering, const std::vector<double>& a, const std::vector<double>& b) {
  double largest = 0;
  const auto compare = [&](const UnknownMap& map, int entries, int from, int to) {
    double error = 0, size = 0;
    for (std::size_t i = 0; i < map.size(); ++i) {
      const int k = static_cast<int>(i % entries);
      if (map[i].index < 0 || k < from || k >= to) continue;
      error += std::pow(a[map[i].index] - b[map[i].index], 2);
      size += std::pow(b[map[i].index], 2);
    }
    if (size > 0) largest = std::max(largest, std::sqrt(error / size));
  };
  compare(numbering.mesh, n, 0, n);
  compare(numbering.fluid, MixedLayout<n>::entries, 0, n);
  compare(numbering.fluid, MixedLayout<n>::entries, n, n + 1);
  compare(numbering.wall, MixedLayout<n>::entries, 0, n);
  compare(numbering.wall, MixedLayout<n>::entries, n, n + 1);
  return largest;
}

/// One run of the study: the scene, marched to the named systems.
class LinearStudy {
 public:
  LinearStudy(const Case& setup, std::vector<NamedSystem> systems, std::vector<std::string> solvers, double tolerance,
              bool sub_problems, bool quiet)
      : setup_(setup),
        systems_(std::move(systems)),
        solvers_(std::move(solvers)),
        tolerance_(tolerance),
        with_sub_problems_(sub_problems),
        console_(0, Console::style_for(quiet)),
        loaded_(load_scene<n>(setup)),
        scene_(loaded_.scene.get()),
        loads_(setup) {
    if (!scene_->coupled())
      throw InputError(setup.path.string(), "", "a study of linear systems needs a scene of fluid and wall",
                       "give [fluid] and [structure]");
    refuse_pressures_per_layer(setup, scene_->wall->nodes(), linear_study_program);
    refuse_nonlinear_mesh_motion(setup, linear_study_program);
    refuse_turned_frames<n>(setup, &scene_->fluid_frames, &scene_->wall_frames, linear_study_program);
    for (const auto& opening : scene_->openings.answering())
      throw InputError(
          setup.path.string(), "opening." + opening.surface->name(),
          "a study of linear systems is about matrices, and the pressure of a resistance or a windkessel is in none",
          "give this opening a pressure");
    for (const auto& opening : scene_->openings.joined().openings())
      throw InputError(
          setup.path.string(), "opening." + opening.surface->name(),
          "a study of linear systems is about matrices, and the pressures that a network gives are in none",
          "give this opening a pressure");
    for (const auto& opening : scene_->openings.driven())
      throw InputError(
          setup.path.string(), "opening." + opening.surface->name(),
          "a study of linear systems is about matrices, and the pressure that drives the flow which is given at an "
          "opening that moves is in none",
          "give this opening a pressure, or clamp the wall there");
    if (systems_.back().step > loads_.steps())
      throw InputError("", "--systems", fmt::format("the run has no step {}", systems_.back().step),
                       fmt::format("give steps up to {}", loads_.steps()));
  }

  /// The whole result; `complete` is false when a solver failed or a named system did not come up.
  Json run(bool& complete) {
    Json json;
    json["program"] = linear_study_program;
    json["version"] = version;
    json["title"] = setup_.title;
    json["case_hash"] = hash_of_case(setup_);
    json["threads"] = threads();
    json["tolerance"] = tolerance_;
    json["mesh"] = {{"name", loaded_.mesh.name},
                    {"hash", loaded_.mesh.hash},
                    {"nodes", loaded_.mesh.nodes},
                    {"tetrahedra", loaded_.mesh.cells},
                    {"fluid_nodes", scene_->fluid->node_count()},
                    {"wall_nodes", scene_->wall->node_count()},
                    {"interface_nodes", scene_->interface.size()}};
    json["newton"] = Json::array();
    json["systems"] = Json::array();
    const auto make_fast = [&](const JacobianBlocks<n>& blocks) { return make_linear_solver("fast", setup_, blocks); };
    NewtonOptions options = setup_.newton;
    NewtonStepper<n> stepper(*scene_, loads_, options, number_scene(*scene_), make_fast);
    System<n> system("coupled", *scene_, number_scene(*scene_), make_fast);
    State state = scene_->at_rest();
    while (state.step < systems_.back().step) {
      const int step = state.step + 1;
      const bool named =
          std::any_of(systems_.begin(), systems_.end(), [&](const NamedSystem& s) { return s.step == step; });
      if (named)
        json["newton"].push_back(study_step(system, state, json["systems"]));
      else
        stepper.advance(state);
    }
    if (with_sub_problems_) json["sub_problems"] = sub_problems_;
    complete = complete_ && json["systems"].size() == systems_.size();
    return json;
  }

 private:
  /// The next step by Newton's method with a new Jacobian in each iteration; named systems, of its last stage, are
  /// studied as they come.
  Json study_step(System<n>& system, State& state, Json& answers) {
    Json history;
    const int stages = scene_->integrator->stages(state);
    for (int stage = 0; stage < stages; ++stage) history = study_stage(system, state, stage, answers);
    return history;
  }

  /// \returns how Newton's method went in the stage
  Json study_stage(System<n>& system, State& state, int stage, Json& answers) {
    const StepData data = loads_.next(state, *scene_->integrator, stage);
    scene_->integrator->predict(state, scene_->predictor, data);
    scene_->impose_conditions(state.now);
    scene_->impose_interface(state, data.rates);
    system.work_on(state, data);
    NewtonOptions options = setup_.newton;
    options.mode = NewtonMode::full;
    options.stop_at_rounding = false;  // the last increment tells the order of convergence
    options.linear_tolerance = std::min(1e-9, tolerance_);
    options.observe_system = [&](int iteration) {
      for (const auto& named : systems_)
        if (data.rates.last_stage && named.step == state.step + 1 && named.iteration == iteration)
          answers.push_back(study(system, named, data.time));
    };
    const NewtonReport solved = newton(system, options);
    if (!solved.converged)
      throw ConvergenceError(
          fmt::format("step {}: Newton's method did not converge: {}", state.step + 1, solved.failure),
          "a smaller time.step or load");
    Json increments = Json::array(), residuals = Json::array();
    for (const auto& iteration : solved.iterations) {
      increments.push_back(iteration.increment);
      residuals.push_back(iteration.residual);
    }
    Json history = {{"step", state.step + 1},
                    {"time_ms", data.time},
                    {"increments", increments},
                    {"residuals", residuals},
                    {"iterations", increments.size()}};
    scene_->impose_interface(state, data.rates);
    scene_->integrator->accept(state, data);
    return history;
  }

  /// The system that `system` holds, solved with every solver.
  Json study(System<n>& system, const NamedSystem& named, double time) {
    const auto blocks = system.blocks();
    std::vector<double> b = system.residual();
    for (double& value : b) value = -value;
    const double norm_b = norm(b);

    CoupledSystem<n> paper(blocks);
    paper.update();
    auto k_x = paper.matrix().zero_vector(), k_y = k_x;
    paper.expand(b, k_x);
    const auto zero = paper.matrix().zero_vector();
    const double product = median_seconds(21, [&] { paper.matrix().residual(zero, k_x, k_y); });

    Json answer = {{"step", named.step},
                   {"newton_iteration", named.iteration},
                   {"time_ms", time},
                   {"unknowns",
                    {{"mesh", k_x.mesh.size()},
                     {"flow", k_x.fluid.size()},
                     {"wall", k_x.wall.size()},
                     {"total", k_x.mesh.size() + k_x.fluid.size() + k_x.wall.size()},
                     {"condensed", b.size()}}},
                   {"product_seconds", product},
                   {"right_hand_side", norm_b}};
    if (with_sub_problems_ && sub_problems_.empty()) study_sub_problems(paper);
    JacobianProduct<n> jacobian(blocks);
    std::vector<double> reference;
    // The direct solution first, whatever its place in the list: it is what the others are compared with.
    std::vector<std::string> order = solvers_;
    std::stable_partition(order.begin(), order.end(), [](const std::string& name) { return name == "direct"; });
    std::vector<Json> entries;
    for (const auto& name : order) {
      say(fmt::format("system {}:{}  {}", named.step, named.iteration, name));
      Json entry = {{"name", name}, {"converged", false}};
      try {
        std::vector<double> x;
        entry.update(solved_by(name, blocks, jacobian, b, product, x));
        const bool converged = entry["converged"].get<bool>();
        complete_ = complete_ && converged;
        if (converged && reference.empty())
          reference = x;
        else if (converged)
          entry["difference"] = difference(system.numbering(), x, reference);
      } catch (const ConvergenceError& failure) {
        complete_ = false;
        entry["message"] = failure.what();
      }
      if (!entry.contains("difference")) entry["difference"] = nullptr;
      say(fmt::format("    {} iterations, {}", entry.value("iterations", 0),
                      entry["converged"].get<bool>() ? fmt::format("{:.3f} s", entry["solve_seconds"].get<double>())
                                                     : "not converged: " + entry["message"].get<std::string>()));
      entries.push_back(std::move(entry));
    }
    answer["solvers"] = Json::array();
    for (const auto& name : solvers_)
      for (auto& entry : entries)
        if (entry["name"] == name) answer["solvers"].push_back(entry);
    return answer;
  }

  /// What one solver takes for J x = b, with its solution x. \param product  seconds of one product with the matrix
  Json solved_by(const std::string& name, const JacobianBlocks<n>& blocks, JacobianProduct<n>& jacobian,
                 const std::vector<double>& b, double product, std::vector<double>& x) {
    std::unique_ptr<LinearSolver> solver;
    const double set_up = seconds_of([&] {
      solver = make_linear_solver(name, setup_, blocks);
      solver->update();
    });
    LinearReport report;
    const LinearStatistics before = solver->statistics();
    const double first = seconds_of([&] { report = solver->solve(b, tolerance_, x); });
    const LinearStatistics after = solver->statistics();
    const double seconds = first > 0.5 ? first : median_seconds(5, [&] { report = solver->solve(b, tolerance_, x); });
    std::vector<double> left;
    jacobian.multiply(x, left);
    for (std::size_t i = 0; i < b.size(); ++i) left[i] = b[i] - left[i];
    const double relative = norm(left) / norm(b);
    return {{"converged",
             report.converged && relative <= 1.01 * tolerance_},  // two sums of one residual differ by rounding
            {"iterations", report.iterations},
            {"relative_residual", relative},
            {"set_up_seconds", set_up},
            {"solve_seconds", seconds},
            {"work_units", seconds / product},
            {"cycles",
             {{"mesh", after.mesh_cycles - before.mesh_cycles},
              {"flow", after.fluid_cycles - before.fluid_cycles},
              {"wall", after.wall_cycles - before.wall_cycles}}},
            {"operator_complexity", after.operator_complexity},
            {"levels", after.levels},
            {"memory_MiB", after.memory_mib},
            {"message", report.failure}};
  }

  /// The multigrid of each sub-problem of the first named system as a solver of its own. Large meshes get a smaller
  /// range, for time.
  void study_sub_problems(const CoupledSystem<n>& paper) {
    const auto& k = paper.matrix();
    NodeMarks fluid(k.fluid_nodes()), wall(k.wall_nodes()), mesh(k.fluid_nodes());
    fluid.prescribed = whole_nodes<n>(paper.constraints().velocity_fixed);
    mesh.prescribed = whole_nodes<n>(paper.constraints().mesh_fixed);
    wall.prescribed = whole_nodes<n>(paper.constraints().wall_fixed);
    for (const auto& node : paper.interface()) {
      fluid.interface[node.fluid] = mesh.interface[node.fluid] = wall.interface[node.wall] = 1;
      mesh.prescribed[node.fluid] = wall.prescribed[node.wall] = 0;  // given, but an unknown of the coupled system
    }
    MultigridStudyRange range;
    range.max_iterations = 40;
    if (loaded_.mesh.nodes > 20000) {
      range.coarsenings = {"colouring"};
      range.cycles = {"v"};
    }
    const auto add = [&](const char* problem, const std::vector<MultigridStudyRow>& rows) {
      for (const auto& row : rows)
        sub_problems_.push_back({{"problem", problem},
                                 {"coarsening", row.coarsening},
                                 {"smoother", row.smoother},
                                 {"cycle", fmt::format("{}({},{})", row.cycle, row.pre_smoothing, row.post_smoothing)},
                                 {"levels", row.result.levels},
                                 {"factor", row.result.convergence_factor},
                                 {"iterations", row.result.iterations},
                                 {"converged", row.result.converged},
                                 {"milliseconds_per_cycle", 1e3 * row.result.seconds_per_cycle},
                                 {"operator_complexity", row.result.operator_complexity}});
      say(fmt::format("multigrid of the {} alone: {} settings", problem, rows.size()));
    };
    add("mesh", study_elliptic_multigrid<n>(*k.mesh, mesh, mesh_amg_options(), range));
    add("fluid", study_saddle_multigrid(*k.fluid, fluid, fluid_amg_options(), range));
    for (const auto& [name, smoother] : saddle_smoother_kinds().rows()) {
      range.smoothers = {name};
      add("wall", study_saddle_multigrid(*k.wall, wall, wall_amg_options(smoother), range));
    }
  }

  void say(const std::string& text) { console_.line(text); }

  const Case& setup_;
  std::vector<NamedSystem> systems_;
  std::vector<std::string> solvers_;
  double tolerance_;
  bool with_sub_problems_;
  Console console_;
  Json sub_problems_ = Json::array();
  LoadedScene<n> loaded_;
  Scene<n>* scene_;
  Loads loads_;
  bool complete_ = true;
};

}  // namespace

std::vector<NamedSystem> parse_systems(const std::string& text) {
  std::vector<NamedSystem> systems;
  for (const auto& part : split(text, ',')) {
    const auto numbers = split(part, ':');
    NamedSystem system;
    const auto read = [](const std::string& from, int& to) {
      const auto [end, error] = std::from_chars(from.data(), from.data() + from.size(), to);
      return error == std::errc() && end == from.data() + from.size() && to >= 1;
    };
    if (numbers.size() != 2 || !read(numbers[0], system.step) || !read(numbers[1], system.iteration))
      throw InputError("", "--systems", "\"" + part + "\" names no system",
                       "give STEP:ITERATION, both from 1 on, for example 1:1,12:2");
    systems.push_back(system);
  }
  if (systems.empty()) throw InputError("", "--systems", "no system named", "give for example 1:1,12:2");
  std::sort(systems.begin(), systems.end(), [](const NamedSystem& a, const NamedSystem& b) {
    return a.step != b.step ? a.step < b.step : a.iteration < b.iteration;
  });
  return systems;
}

std::vector<ExtraOption> LinearStudyRequest::options() {
  // fsi-compare looks for this.
  const std::string without = has_petsc() ? "" : "; petsc is not in this build";
  return {{"--systems", "STEP:ITERATION,...", "The Newton systems that are solved, default 1:1", &systems_, nullptr},
          {"--solvers", "NAME,...", "Linear solvers, default fast,direct" + without, &solvers_, nullptr},
          {"--tolerance", "NUMBER", "Relative residual, default 1e-9", &tolerance_, nullptr},
          {"--sub-problems", "", "The multigrid of the sub-problems, too, as solvers of their own", nullptr,
           &sub_problems_}};
}

int LinearStudyRequest::run(const CommandLine& line, const Case& setup) const {
  const auto file = line.output / "linear_solvers.json";
  require_regular_or_absent(file, false);  // before anything is computed
  LinearStudy study(setup, parse_systems(systems_.empty() ? "1:1" : systems_),
                    parse_solvers(solvers_.empty() ? "fast,direct" : solvers_),
                    tolerance_.empty() ? 1e-9 : parse_tolerance(tolerance_), sub_problems_, line.quiet);
  std::vector<RemovedOnSignal> on_signal;
  {
    const SignalsWait until_kept;
    const auto made = make_folder(line.output);
    for (auto above = made.rbegin(); above != made.rend(); ++above) on_signal.emplace_back(*above);
    on_signal.emplace_back(temporary_name(file));
  }
  regular_output_file(file);
  bool complete = true;
  const Json answer = study.run(complete);
  write_atomically(file, answer.dump(2) + "\n");
  return complete ? exit_done : exit_not_converged;
}

}  // namespace fsi
