#include "run/run_account.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>

#include "base/version.hpp"
#include "fem/dimensions.hpp"
#include "host/available_memory.hpp"
#include "host/threads.hpp"
#include "io/summary.hpp"
#include "run/cost_summary.hpp"

namespace fsi {

namespace {

template <int n>
nlohmann::json scene_json(const std::string& program, const Case& setup, const std::string& case_hash,
                          const MeshFacts& mesh, const Scene<n>& scene) {
  nlohmann::json json;
  json["program"] = program;
  json["version"] = version;
  json["machine"] = machine_json();
  json["build"] = build_json();
  json["title"] = setup.title;
  json["case"] = setup.path.string();
  json["case_hash"] = case_hash;
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

}  // namespace

template <int n>
void RunAccount<n>::begin() {
  auto& summary = parts_.messages.summary;
  summary = scene_json(parts_.program, parts_.setup, parts_.case_hash, parts_.loaded.mesh, parts_.scene);
  if (parts_.scene.fibre_frame) summary["fibre_frame"] = fibre_frames().name_of(*parts_.scene.fibre_frame);
  first_step_ = parts_.state.step;
  if (first_step_ > 0) summary["restarted_from_step"] = first_step_;
}

template <int n>
void RunAccount<n>::add(const StepRecord& record, double length) {
  shortest_step_ = longest_step_ == 0 ? length : std::min(shortest_step_, length);
  longest_step_ = std::max(longest_step_, length);
  total_.outer_iterations += record.outer_iterations;
  total_.newton_iterations += record.newton_iterations;
  total_.linear_iterations += record.linear_iterations;
  total_.wall_seconds += record.wall_seconds;
  total_.solver_error = std::max(total_.solver_error, record.solver_error);
}

template <int n>
void RunAccount<n>::measure_work_unit() {
  const Traffic before = parts_.processes.traffic();
  parts_.work_unit.measure(seconds_since(parts_.start), parts_.stepper->matrix_values());
  parts_.about_processes.leave_out_since(before);
}

template <int n>
void RunAccount<n>::take_stock() {
  auto& summary = parts_.messages.summary;
  const WorkUnit& unit = parts_.work_unit.unit();
  const Attempts& attempts = parts_.march.attempts();
  const int steps = parts_.state.step - first_step_;
  summary["work_unit"] = work_unit_json(unit);
  summary["totals"] = {{"steps", parts_.state.step},
                       {"outer_iterations", total_.outer_iterations},
                       {"newton_iterations", total_.newton_iterations},
                       {"linear_iterations", total_.linear_iterations},
                       {"largest_solver_error", total_.solver_error},
                       {"rejected_steps", attempts.rejected},
                       {"steps_above_tolerance", attempts.beyond},
                       {"failed_steps", attempts.failed},
                       {"load_steps_checked_by_halves", attempts.checked},
                       {"work_units_per_step", work_units_per_step(unit, total_.wall_seconds, steps)},
                       {"wall_s", seconds_since(parts_.start)}};
  summary["peak_memory_MiB"] = peak_memory_mib();
  summary.update(profile_json(parts_.scene.profile));
  if (!parts_.processes.is_alone()) summary["per_process"] = parts_.about_processes.json(steps, step_seconds_);
}

template <int n>
void RunAccount<n>::write(const std::string& status) {
  take_stock();
  write_status(status);
}

template <int n>
void RunAccount<n>::write_status(const std::string& status) {
  parts_.messages.summary["status"] = status;
  parts_.first.now([&] { write_summary(parts_.line.output, parts_.messages.summary); });
}

template <int n>
std::string RunAccount<n>::about_steps() const {
  if (parts_.scene.is_static() || shortest_step_ >= longest_step_ * (1 - 1e-9)) return {};
  const std::string about = parts_.scene.integrator->about(shortest_step_, longest_step_);
  return about.empty() ? "" : fmt::format("steps of {:.4g} to {:.4g} ms: {}", shortest_step_, longest_step_, about);
}

#define FSI_INSTANTIATE(n) template class RunAccount<n>;
FSI_FOR_EACH_DIMENSION(FSI_INSTANTIATE)
#undef FSI_INSTANTIATE

}  // namespace fsi
