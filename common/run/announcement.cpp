#include "run/announcement.hpp"

#include <fmt/format.h>

#include <cstdint>
#include <limits>
#include <vector>

#include "base/printable.hpp"
#include "base/version.hpp"
#include "case/scene_period.hpp"
#include "fem/dimensions.hpp"
#include "host/standard_streams.hpp"
#include "host/threads.hpp"
#include "linear/choice/general_solvers.hpp"
#include "run/program.hpp"
#include "scene/time_scheme.hpp"
#include "time/time_text.hpp"

namespace fsi {

namespace {

nlohmann::json described(const std::vector<VaryingConstant>& constants) {
  nlohmann::json list = nlohmann::json::array();
  for (const auto& c : constants)
    list.push_back({{"layer", c.layer},
                    {"constant", c.constant},
                    {"unit", c.unit},
                    {"smallest", c.smallest},
                    {"largest", c.largest},
                    {"mean", c.mean},
                    {"sources", c.sources}});
  return list;
}

/// The time scheme, and steps at the end that are shorter.
template <int n>
void announce_steps(const RunParts<n>& parts, RunLog& log) {
  if (parts.scene.is_static()) return;
  if (const std::string why = about_time_scheme(parts.setup, parts.scene, parts.scheme); !why.empty()) log.info(why);
  const bool adaptive = parts.setup.time->adaptive;
  const double step = parts.setup.time->step, longest = adaptive ? std::numeric_limits<double>::infinity() : step;
  if (const std::string about = parts.scene.integrator->about(step, longest); !about.empty()) log.info(about);
  if (const double last = parts.loads.axis().shorter_last_steps(); last > 0)
    log.info(fmt::format("the last steps have {:.6g} ms in place of {:g} ms: the run ends at {:.12g} ms", last, step,
                         parts.setup.time->end));
  if (const std::string said = lost_order(*parts.setup.time, *parts.scene.integrator); !said.empty()) {
    log.warning(said);
    warn(parts.program, said);
  }
}

}  // namespace

template <int n>
void announce(RunParts<n>& parts, const RunCheckpoints<n>& checkpoints, Console& console, RunLog& log) {
  const auto& mesh = parts.loaded.mesh;
  nlohmann::json& summary = parts.messages.summary;
  const auto unknowns = summary["unknowns"]["coupled"].get<std::int64_t>();
  const auto text = fmt::format("{} {}: {} | {} nodes, {} {}, {} unknowns, {}{} threads{}, {}", parts.program, version,
                                shortened(parts.setup.title, 200), mesh.nodes, mesh.cells, mesh.cell, unknowns,
                                parts.processes.is_alone() ? "" : fmt::format("{} processes, ", parts.processes.size()),
                                threads(), parts.processes.is_alone() ? "" : " each",
                                parts.loads.axis().is_adaptive()
                                    ? fmt::format("adaptive steps, tolerance {:g}", parts.setup.time->tolerance)
                                    : fmt::format("{} steps", parts.loads.steps()));
  console.line(text);
  log.info(text);
  if (const auto coupling = parts.stepper->coupling_method()) {
    log.info(fmt::format("coupling kind: {}; {}", coupling->kind, coupling->does));
    summary["coupling_kind"] = coupling->kind;
    summary["coupling_pass"] = coupling->does;
  }
  if (const std::string numbers = text_of_numbers(parts.loaded.numbers); !numbers.empty()) log.info(numbers);
  log.info(fmt::format("threads: {}, {}", parts.threads.count, parts.threads.reason));
  if (!parts.threads.warning.empty()) {
    log.warning(parts.threads.warning);
    warn(parts.program, parts.threads.warning);
  }
  announce_steps(parts, log);
  const auto& monolithic = parts.setup.monolithic;
  const auto& partitioned = parts.setup.partitioned;
  const bool by_parts = parts.stepper->reports_coupling();
  const std::string& solver = by_parts ? partitioned.linear_solver : monolithic.linear_solver;
  const std::string in_words = linear_solver_in_words(solver, parts.setup.linear.fast, parts.processes);
  log.info("linear solver: " + in_words);
  summary["linear_solver"] = in_words;
  if (const std::string other = other_solver_on_processes(solver, parts.setup.linear.fast, n, parts.processes);
      !other.empty())
    log.info(other);
  for (const auto& choice : parts.stepper->choices()) {
    log.info(fmt::format("{} = {}: {}", choice.key, choice.value, choice.reason));
    summary["choices"][choice.key] = {{"value", choice.value}, {"reason", choice.reason}};
  }
  for (const auto& [name, least, most, from_inside] : mesh.wall)
    summary["wall_thickness"].push_back({{"layer", name},
                                         {"smallest", least.distance},
                                         {"smallest_at", least.at},
                                         {"largest", most.distance},
                                         {"largest_at", most.at},
                                         {"unit", "mm"}});
  if (!parts.scene.varying_constants.empty()) summary["varying_constants"] = described(parts.scene.varying_constants);
  for (const auto& warning : parts.setup.warnings) log.warning(warning);
  parts.loading.write_to(log);
  for (const auto& notice : parts.scene.notices) {
    log.warning(notice);
    warn(parts.program, notice);
  }
  for (const auto& remark : parts.scene.remarks) log.info(remark);
  if (const auto said = about_statistics(parts.setup); !said.empty()) log.info(said);
  if (const auto said = about_periodic_end(parts.setup); !said.empty()) log.info(said);
  for (const auto& note : parts.loaded.points.notes) log.info(note);
  for (const auto& warning : parts.loaded.points.warnings) {
    log.warning(warning);
    warn(parts.program, warning);
  }
  if (parts.lock && !parts.lock->said().empty()) log.warning(parts.lock->said());
  if (parts.state.step == 0) return;
  log.info(fmt::format("restarted after step {}, {}", parts.state.step,
                       time_text(parts.state.time, parts.scene.is_static())));
  for (const auto& warning : checkpoints.warnings()) log.warning(warning);
  if (!checkpoints.left_aside().empty()) log.info(checkpoints.left_aside());
  if (!checkpoints.step_change().empty()) {
    console.line(checkpoints.step_change());
    log.info(checkpoints.step_change());
  }
}

#define FSI_INSTANTIATE(n) template void announce<n>(RunParts<n>&, const RunCheckpoints<n>&, Console&, RunLog&);
FSI_FOR_EACH_DIMENSION(FSI_INSTANTIATE)
#undef FSI_INSTANTIATE

}  // namespace fsi
