#include "case/case_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <utility>

#include "base/error.hpp"
#include "base/input_file.hpp"
#include "case/case_entry.hpp"
#include "case/case_keys.hpp"
#include "case/case_overrides.hpp"
#include "case/derived_keys.hpp"
#include "case/key_depth.hpp"
#include "case/lumped_start_keys.hpp"
#include "case/maxwell_keys.hpp"
#include "case/named_lists.hpp"
#include "case/network_keys.hpp"
#include "case/opening_keys.hpp"
#include "case/periodic_end.hpp"
#include "case/pressure_doubts.hpp"
#include "case/renamed_keys.hpp"
#include "case/start_pressure.hpp"
#include "case/support_keys.hpp"
#include "case/table_times.hpp"
#include "case/viscosity_keys.hpp"
#include "case/windkessel_units.hpp"
#include "time/time_schemes.hpp"

namespace fsi {

namespace {

/// A rule on which sections must be there, or must not, given the others.
struct SceneRule {
  bool broken;
  const char* section;  ///< at fault; "" when one is missing
  const char* problem;
  const char* remedy;
};

void check_sections(const CaseEntry& whole_case, const Case& scene) {
  const bool fluid = scene.fluid.has_value(), wall = scene.structure.has_value();
  const bool in_time = scene.time.has_value(), in_static = scene.static_load.has_value();
  const SceneRule rules[] = {
      {!fluid && !wall, "", "neither [fluid] nor [structure]", "add at least one of them"},
      {in_time && in_static, "static", "stands beside [time]", "keep one of the two"},
      {in_static && fluid, "static", "is for a wall without fluid", "replace it by [time]"},
      {!in_time && !in_static && fluid, "", "no [time]", "add [time] with step and end"},
      {!in_time && !in_static, "", "neither [time] nor [static]", "add [time] with step and end, or [static]"},
      {fluid && !scene.inlet && scene.openings.empty() && !scene.fluid->closed, "", "no [inlet]",
       "add [inlet] with pressure, since there is a fluid, or [[opening]]; for a fluid that nothing enters or leaves, "
       "closed = [...] in [fluid] with the names of its surfaces, [] where the wall encloses it"},
      {!fluid && scene.inlet, "inlet", "stands in a case without fluid", "rename it to [load], or add [fluid]"},
      {!fluid && !scene.load && support_loads_of(scene).empty(), "", "no [load]",
       "add [load] with pressure, since there is no fluid"},
      {fluid && scene.load, "load", "is for a wall without fluid", "rename it to [inlet], or remove it"},
      {whole_case.has("mesh_motion") && !(fluid && wall), "mesh_motion",
       "is for scenes of fluid and wall, where the fluid's mesh moves", "remove it"},
      {in_static && scene.load && scene.load->points.size() > 1, "load", "changes in time, but the case is static",
       "give one pressure, without until"},
  };
  for (const auto& rule : rules)
    if (rule.broken) whole_case.child(rule.section).refuse(rule.problem, rule.remedy);
}

/// Scenes in two dimensions have the axis that their geometry gives them.
void check_axis(const CaseEntry& whole_case, const Case& scene) {
  if (!scene.structure || scene.geometry == Geometry::three_dimensional) return;
  const CaseEntry structure = whole_case.child("structure");
  const bool axisymmetric = scene.geometry == Geometry::axisymmetric;
  const auto& direction = scene.structure->axis_direction;
  const auto& origin = scene.structure->axis_origin;
  if (direction[0] != 0 || direction[1] != 0)
    structure.child("axis_direction")
        .refuse(axisymmetric ? "the axis of an axisymmetric scene is the z axis"
                             : "the axis of a plane scene stands upright on its plane: it is along z",
                "leave this key out");
  if (axisymmetric && (origin[0] != 0 || origin[1] != 0))
    structure.child("axis_origin").refuse("the axis of an axisymmetric scene is the z axis", "leave this key out");
}

/// A load lies in the space of its scene.
void check_gravity(const CaseEntry& whole_case, const Case& scene) {
  if (!scene.structure) return;
  const auto& g = scene.structure->gravity;
  const CaseEntry structure = whole_case.child("structure");
  if (scene.geometry == Geometry::axisymmetric && (g[0] != 0 || g[1] != 0))
    structure.child("gravity").refuse("is along another direction than the axis of the body of revolution",
                                      "give [0, 0, g]");
  if (scene.geometry == Geometry::plane && g[2] != 0)
    structure.child("gravity").refuse("points out of the plane of the scene", "give [g_x, g_y, 0]");
}

/// Named times lie in the run, and no closer together than its steps may be.
void check_named_times(const CaseEntry& whole_case, const Case& scene) {
  const auto& times = scene.output.times;
  if (times.empty()) return;
  const CaseEntry entry = whole_case.child("output").child("times");
  if (!scene.time) entry.refuse("belong to a run in time, and this case is static", "leave this key out");
  const double end = scene.time->end;
  for (const double time : {times.front(), times.back()})
    if (!(time > 0 && time <= end))
      entry.refuse(fmt::format("{} ms does not lie in the run", time),
                   fmt::format("give times > 0 and <= time.end, {}", end));
  for (std::size_t i = 1; i < times.size(); ++i)
    if (const double apart = times[i] - times[i - 1]; apart * TimeData::most_steps < end)
      entry.refuse(fmt::format("{:.12g} and {:.12g} are {:.3g} ms apart", times[i - 1], times[i], apart),
                   fmt::format("leave {:.12g} ms between times", end / TimeData::most_steps));
}

void check_output_times(const CaseEntry& whole_case, const Case& scene) {
  check_named_times(whole_case, scene);
  if (!scene.output.interval) return;
  const CaseEntry output = whole_case.child("output"), interval = output.child("interval");
  // --set output.every=0 switches the fields of any case off.
  const CaseSource& source = whole_case.source();
  if (scene.output.every == 0 && (!source.is_overridden("output.every") || source.is_overridden("output.interval")))
    interval.refuse("asks for fields, and output.every = 0 writes none", "remove one of the two");
  if (!scene.time) return;
  const double times = scene.time->end / *scene.output.interval;
  if (times > TimeData::most_steps)
    interval.refuse(fmt::format("{} would end {:.3g} steps for the sake of output", *scene.output.interval, times),
                    fmt::format("give at least {:.12g}", scene.time->end / TimeData::most_steps));
}

/// Elements that are stable by themselves have nothing to stabilise.
void warn_of_stabilisation(const CaseEntry& whole_case, const Case& scene) {
  if (scene.element != ElementPair::p2p1) return;
  const auto warn = [](const CaseEntry& entry) {
    entry.warn("not used: the element p2p1 needs no stabilisation", "leave this key out, or set element = \"p1\"");
  };
  if (scene.fluid && scene.fluid->grad_div) warn(whole_case.child("fluid").child("grad_div"));
  if (scene.structure && whole_case.child("structure").has("stabilisation"))
    warn(whole_case.child("structure").child("stabilisation"));
}

/// Short steps of second order keep waves that longer steps and those of first order damp.
bool keeps_short_waves(const Case& scene) {
  constexpr double short_step = 0.1;  // ms: the recommended meshes' two kinds are for 1/8 and for 1/32 or less
  if (!scene.time) return false;
  if (scene.time->scheme && prototype(*scene.time->scheme)->error_terms().order == 1) return false;
  return scene.time->adaptive || scene.time->step <= short_step;
}

/// mesh.error holds for one kind of waves: the one that the case's steps leave, unless mesh.waves names it.
void choose_waves(const CaseEntry& whole_case, Case& scene) {
  if (scene.mesh.error == 0 || !keeps_short_waves(scene)) return;
  const CaseEntry mesh = whole_case.child("mesh");
  if (mesh.has("waves")) {
    if (scene.mesh.waves == Waves::damped)
      mesh.child("waves").warn(
          "is for backward Euler with 1/8 ms; shorter steps of second order keep waves that this mesh does not resolve",
          "leave it out, or set \"resolved\", for a mesh that does");
    return;
  }
  scene.mesh.waves = Waves::resolved;
  mesh.child("error").remark(
      "taken for resolved waves, which short steps of second order keep; waves = \"damped\" takes a coarser mesh");
}

/// Beside a fluid in the right unit, a wall a thousand times denser is intended, as in studies of the added mass.
/// Without such a fluid it is a wrong unit.
void warn_of_wall_density(const CaseEntry& whole_case, const Case& scene) {
  if (!scene.structure) return;
  if (scene.fluid && !unit_slip(quantity::fluid_density(), scene.fluid->density)) return;
  whole_case.child("structure").child("density").warn_of_unit(quantity::wall_density(), scene.structure->density);
}

/// Default stopping criterion of Newton's method. With fixed steps an error that is small beside the step's change is
/// corrected by the next steps; a wall alone swings undamped, so that its errors add up. Load steps are results
/// themselves, and adaptive steps must not see the solver's error: there the increment decides.
void choose_newton_stop(const CaseEntry& whole_case, Case& scene) {
  if (!scene.time || scene.time->adaptive) return;
  const CaseEntry newton = whole_case.child("newton");
  if (newton.has("tolerance") || newton.has("error_tolerance")) return;
  scene.newton.error_tolerance =
      scene.fluid ? NewtonStandards::error_tolerance : NewtonStandards::error_tolerance_of_wall;
}

std::string contents_of(const std::filesystem::path& file) {
  constexpr std::uint64_t largest = 16 << 20;
  constexpr const char* remedy = "give the path of a case file";
  require_regular_file(file, {"no such file", remedy, remedy, largest});
  std::ifstream stream(file, std::ios::binary);
  // read() reports errors of a device by the stream's state; iterators would let the library's exceptions through.
  std::string text, block(1 << 16, '\0');
  while (stream.read(block.data(), static_cast<std::streamsize>(block.size())) && text.size() <= largest) text += block;
  text.append(block, 0, static_cast<std::size_t>(stream.gcount()));
  if (stream.bad() || !stream.eof()) throw InputError(file.string(), "", "cannot be read", "check its permissions");
  return text;
}

toml::table parsed_document(const std::string& text, const CaseSource& source) {
  if (const auto line = line_of_deep_key(text))
    throw InputError(fmt::format("{}:{}", source.file, *line), "",
                     fmt::format("a key of more than {} parts", deepest_key), "see --help-keys for valid keys");
  try {
    return toml::parse(text, source.file);
  } catch (const toml::parse_error& error) {
    std::string description(error.description());
    std::replace(description.begin(), description.end(), '\n', ' ');
    throw InputError(fmt::format("{}:{}", source.file, error.source().begin.line), "", "no valid TOML: " + description,
                     "correct this line");
  }
}

}  // namespace

Case read_case(const std::filesystem::path& file, const std::vector<std::string>& overrides) {
  return parse_case(contents_of(file), file, overrides);
}

Case parse_case(const std::string& text, const std::filesystem::path& file, const std::vector<std::string>& overrides) {
  CaseSource source{file.string(), {}, {}};
  toml::table document = parsed_document(text, source);
  name_lists(document, source);
  apply_overrides(overrides, document, source);
  rename_keys(document, source);

  const CaseEntry whole_case(document, "", "", source);
  Case scene;
  scene.path = file;
  read_keys(whole_case, case_keys(), scene);
  check_sections(whole_case, scene);
  join_network(whole_case, scene);
  check_openings(whole_case, scene);
  check_closed(whole_case, scene);
  set_lumped_start(whole_case, scene);
  warn_of_windkessel_units(whole_case, scene);
  warn_of_table_times(whole_case, scene);
  warn_of_start_pressure(whole_case, scene);
  if (scene.structure) scene.structure->stabilisation = wall_stabilisation(scene);
  check_axis(whole_case, scene);
  check_supports(whole_case, scene);
  check_layer_viscosities(whole_case, scene);
  check_layer_branches(whole_case, scene);
  check_gravity(whole_case, scene);
  check_output_times(whole_case, scene);
  check_periodic_end(whole_case, scene);
  check_derived_output(whole_case, scene);
  choose_newton_stop(whole_case, scene);
  scene.partitioned.fast = scene.linear.fast;
  warn_of_wall_density(whole_case, scene);
  warn_of_stabilisation(whole_case, scene);
  choose_waves(whole_case, scene);
  scene.warnings = source.warnings;
  for (auto& warning : warnings_of_doubts(source.doubts, scene)) scene.warnings.push_back(std::move(warning));
  scene.remarks = source.remarks;
  return scene;
}

std::string case_keys_help() {
  std::vector<KeyHelp> lines;
  for (const auto& key : case_keys()) {
    lines.push_back({key.below.empty() ? key.name : "[" + key.name + "]", key.about, key.required});
    for (const auto& line : key.below) lines.push_back(line);
  }
  std::string text = "Keys of a case file; * must be given where their section is.\n";
  for (const auto& line : lines)
    text += fmt::format("{} {:<36} {}\n", line.required ? '*' : ' ', line.path, line.about);
  return text;
}

}  // namespace fsi
