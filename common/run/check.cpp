#include "run/check.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <limits>
#include <map>
#include <vector>

#include "base/error.hpp"
#include "base/profile.hpp"
#include "base/stopwatch.hpp"
#include "case/scene_period.hpp"
#include "fem/dimensions.hpp"
#include "host/available_memory.hpp"
#include "host/standard_streams.hpp"
#include "host/threads.hpp"
#include "linear/choice/general_solvers.hpp"
#include "observers/field_output.hpp"
#include "run/case_description.hpp"
#include "run/console.hpp"
#include "run/loading_report.hpp"
#include "run/prestress.hpp"
#include "run/process_summary.hpp"
#include "run/process_threads.hpp"
#include "run/program.hpp"
#include "run/step_controller.hpp"
#include "scene/time_scheme.hpp"

namespace fsi {

namespace {

constexpr std::int64_t small_wall = 20'000;  // unknowns for which a prestress is found in seconds
constexpr double short_step = 5;             // s, after which a second step is tried

void describe_samples(const Case& setup, const ObservationPoints& points, Description& lines) {
  if (!points.centre_line.empty())
    lines.push_back({"centre line", fmt::format("{} points from z = {:g} to {:g} mm", points.centre_line.size(),
                                                points.centre_z.front(), points.centre_z.back())});
  if (!points.wall_line.empty())
    lines.push_back({"inner wall", fmt::format("{} points along the axis", points.wall_z.size())});
  for (const auto& point : points.requested.points)
    lines.push_back({"point " + point.name, fmt::format("[{:g}, {:g}, {:g}] mm in the {}", point.at[0], point.at[1],
                                                        point.at[2], point.in_fluid ? "fluid" : "wall")});
  std::map<std::string, int> counts;
  for (const auto& point : points.requested.lines) ++counts[point.name];
  for (const auto& [name, count] : counts) lines.push_back({"line " + name, fmt::format("{} points", count)});
  for (const auto& plane : points.requested.planes) {
    const PlaneRequest& asked = setup.output.samples.planes.at(plane.name);
    lines.push_back({"plane " + plane.name,
                     fmt::format("through [{:g}, {:g}, {:g}] mm", asked.origin[0], asked.origin[1], asked.origin[2])});
  }
  for (const auto& name : setup.output.derived.surfaces) lines.push_back({"forces on " + name, "of the fluid"});
  for (const auto& [name, surfaces] : setup.output.derived.forces)
    lines.push_back({"forces on " + name, fmt::format("of the fluid, {} together", fmt::join(surfaces, ", "))});
  if (const auto said = about_statistics(setup); !said.empty()) lines.push_back({"statistics", said});
  if (const auto said = about_periodic_end(setup); !said.empty()) lines.push_back({"end", said});
  for (const auto& note : points.notes) lines.push_back({"note", note});
}

template <int n>
void describe_scene(const Case& setup, const LoadedScene<n>& loaded, const SceneSize& size, Description& lines) {
  lines.push_back({"mesh", fmt::format("{}: {} nodes, {} {}; {} {}", loaded.mesh.name, loaded.mesh.nodes,
                                       loaded.mesh.cells, loaded.mesh.cell, element_pairs().name_of(setup.element),
                                       geometries().name_of(setup.geometry))});
  describe_fluid(setup, lines);
  describe_wall(setup, lines);
  if (setup.structure) {
    auto layer = loaded.scene->wall->layer_data().begin();  // in the order of the names
    for (const auto& [name, material] : setup.structure->layers)
      lines.push_back({"layer " + name, fmt::format("{}; {:.4g} {}", text_of_layer(material), (layer++)->volume,
                                                    unit_of_volume(setup))});
  }
  describe_openings(setup, loaded.mesh.surfaces, lines);
  describe_numbers(loaded.numbers, lines);
  describe_supports(setup, loaded.mesh.surfaces, lines);
  describe_samples(setup, loaded.points, lines);
  lines.push_back(
      {"unknowns", fmt::format("{}: {} fluid, {} wall, {} mesh motion; {} nodes on the interface",
                               size.fluid_unknowns + size.wall_unknowns + size.mesh_unknowns, size.fluid_unknowns,
                               size.wall_unknowns, size.mesh_unknowns, size.interface_nodes)});
}

/// Whether the wall is as a run begins with it.
template <int n>
bool bring_under_prestress(const Case& setup, const SceneSize& size, LoadingReport& loading, LoadedScene<n>& loaded,
                           Description& lines) {
  if (!setup.prestress) return true;
  const std::string load = fmt::format("{:g} kPa", setup.prestress->pressure);
  if (loaded.prestress) {
    lines.push_back({"prestress", load + ", from " + setup.prestress->file.string()});
    return true;
  }
  if (size.wall_unknowns > small_wall) {
    lines.push_back({"prestress", load + ", will be found before the first step; not tried here, nor is a step"});
    return false;
  }
  loaded.prestress = apply_prestress(setup, loaded.mesh.hash, *loaded.scene, loading.follower().prestress_goes_on);
  lines.push_back({"prestress", load + ", found"});
  return true;
}

/// What the first steps took.
struct Trial {
  std::vector<double> seconds;  ///< a step each
  StepReport first;
  std::string failure;
};

template <int n>
Trial try_steps(StepController<n>& march, const Scene<n>& scene, const Loads& loads) {
  Trial trial;
  State state = scene.at_rest();
  try {
    while (state.step < std::min(2, loads.steps()) && (state.step == 0 || trial.seconds.back() < short_step)) {
      const auto start = Clock::now();
      StepReport report = march.step(state);
      if (trial.seconds.empty()) trial.first = std::move(report);
      // As many steps for all processes.
      trial.seconds.push_back(scene.processes().largest(seconds_since(start)));
    }
  } catch (const ConvergenceError& failure) {
    trial.failure = failure.what();
  }
  return trial;
}

std::string text_of_iterations(const StepReport& report) {
  std::string text = report.outer_iterations > 1 ? fmt::format("{} coupling, ", report.outer_iterations) : "";
  return text + fmt::format("{} Newton, {} linear iterations", report.newton_iterations, report.linear_iterations);
}

void describe_trial(const Trial& trial, const Loads& loads, const Communicator& processes, Description& lines) {
  if (!trial.failure.empty()) lines.push_back({"step tried", "finds no solution: " + trial.failure});
  const double memory = processes.sum(peak_memory_mib());
  lines.push_back({"memory", fmt::format("about {} with the step tried{}", memory_text(memory * 1024 * 1024),
                                         processes.is_alone() ? "" : ", all processes together")});
  if (trial.seconds.empty()) return;
  lines.push_back({"first step", fmt::format("{}, {:.3g} s", text_of_iterations(trial.first), trial.seconds.front())});
  if (!trial.failure.empty()) return;
  const double run = trial.seconds.front() + (loads.steps() - 1) * trial.seconds.back();
  lines.push_back({"run", fmt::format("about {} if all {} steps are like {}, without output", readable_duration(run),
                                      loads.steps(), trial.seconds.size() > 1 ? "the second" : "the first")});
}

}  // namespace

template <int n>
int check_case(const std::string& program, const CommandLine& line, const Case& setup, const StepperMaker& make_stepper,
               const CoreWatch& watch) {
  LoadingReport loading(program, line.quiet);
  ThreadChoice threads;
  LoadingScene follower = loading.follower([&](std::size_t cells) {
    threads = threads_of_process(line.threads, cells, watch, Communicator::world());
    set_threads(threads.count);
  });
  follower.find_prestress = false;
  LoadedScene<n> loaded = load_scene<n>(setup, follower);
  Scene<n>& scene = *loaded.scene;
  const SceneSize size = size_of(scene);
  Description lines{{program, setup.title}, {"case", setup.path.string()}};
  describe_scene(setup, loaded, size, lines);
  const bool as_a_run_begins = bring_under_prestress(setup, size, loading, loaded, lines);
  loading.end();
  describe_time(setup, setup.time ? time_scheme_of(setup, *loaded.scene) : "", lines);
  Loads loads(setup);
  const auto stepper = make_stepper.make(scene, loads, setup);
  require_resolvable(setup, scene);
  StepController<n> march(setup, scene, *stepper, loads, [&lines](const std::string& said) {
    lines.push_back({"step tried", said});
  });
  if (setup.time) {
    const double step = setup.time->step;
    const double longest = setup.time->adaptive ? std::numeric_limits<double>::infinity() : step;
    if (const std::string about = scene.integrator->about(step, longest); !about.empty())
      lines.push_back({"time scheme", about});
  }
  for (const auto& choice : stepper->choices()) lines.push_back({choice.key, choice.value + ": " + choice.reason});
  const bool by_parts = stepper->reports_coupling();
  const std::string solver =
      linear_solver_in_words(by_parts ? setup.partitioned.linear_solver : setup.monolithic.linear_solver,
                             setup.linear.fast, scene.processes());
  lines.push_back({"linear solver", by_parts ? solver + ", of fluid and wall each" : solver});
  lines.push_back({"threads", fmt::format("{}, {}", threads.count, threads.reason)});
  for (const auto& remark : scene.remarks) lines.push_back({"note", remark});
  for (const auto& notice : scene.notices) warn(program, notice);
  for (const auto& warning : loaded.points.warnings) warn(program, warning);
  if (as_a_run_begins) describe_trial(try_steps(march, scene, loads), loads, scene.processes(), lines);
  print(text_of(lines));
  return exit_done;
}

#define FSI_INSTANTIATE(n)                                                                             \
  template int check_case<n>(const std::string&, const CommandLine&, const Case&, const StepperMaker&, \
                             const CoreWatch&);
FSI_FOR_EACH_DIMENSION(FSI_INSTANTIATE)
#undef FSI_INSTANTIATE

}  // namespace fsi
