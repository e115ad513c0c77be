#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "base/names.hpp"
#include "case/case_keys.hpp"
#include "case/key_values.hpp"
#include "case/layer_keys.hpp"
#include "case/network_keys.hpp"
#include "case/opening_keys.hpp"
#include "case/parameter_keys.hpp"
#include "case/periodic_end.hpp"
#include "case/region_keys.hpp"
#include "case/support_keys.hpp"
#include "case/table_input.hpp"
#include "case/viscosity_keys.hpp"
#include "materials/material.hpp"
#include "mesh/group_names.hpp"
#include "mesher/artery/recommended_meshes.hpp"
#include "mesher/artery_generator.hpp"
#include "time/time_schemes.hpp"

namespace fsi {

namespace {

constexpr double smallest_part_of_end = 1e-9;  // of an adaptive step; times are told apart to 12 digits
using presence::optional, presence::required;

// [mesh].

void check_mesh(const CaseEntry& entry, MeshData& mesh) {
  if (mesh.file.empty() && mesh.level.empty() && mesh.error == 0)
    entry.refuse("neither file nor level", "give file = \"NAME.msh\", level = \"coarse\" or error = \"3%\"");
  if (!mesh.file.empty() && !mesh.level.empty()) entry.child("level").refuse("both file and level", "keep one of them");
  if (mesh.error > 0 && !(mesh.file.empty() && mesh.level.empty()))
    entry.child("error").refuse(mesh.file.empty() ? "both level and error" : "both file and error", "keep one of them");
  if (mesh.error == 0 && entry.has("waves"))
    entry.child("waves").refuse("belongs to error", "give error = \"3%\" as well, or leave waves out");
}

void read_mesh_error(const CaseEntry& entry, MeshData& mesh) {
  const auto percent = percent_of(entry.text());
  if (!percent) entry.refuse_value("is no percentage", "give one, like \"3%\"");
  mesh.error = *percent;
}

std::vector<CaseKey<MeshData>> mesh_keys() {
  return {
      leaf<MeshData>("file", optional, "gmsh mesh, path relative to the case file",
                     {[](const CaseEntry& entry, MeshData& mesh) { mesh.file = entry.path("path of a gmsh file"); },
                      [](const MeshData& mesh) { return mesh.file.string(); }}),
      leaf("level", optional, "artery mesh made on demand: {}", name_from(at(&MeshData::level), artery_levels())),
      leaf<MeshData>(
          "error", optional,
          "artery mesh made on demand: the smallest one recommended for the element with at most this error, like "
          "\"3%\"",
          {read_mesh_error,
           [](const MeshData& mesh) { return mesh.error > 0 ? fmt::format("{}%", mesh.error) : std::string(); }}),
      leaf("waves", optional,
           "waves for which error holds: {}; unless given, resolved where steps are of second order and adaptive or at "
           "most 0.1 ms, and damped elsewhere",
           name_from(at(&MeshData::waves), wave_kinds())),
  };
}

// [fluid].

void read_closed(const CaseEntry& entry, FluidData& fluid) {
  auto& names = fluid.closed.emplace();
  for (const CaseEntry& element : entry.elements()) {
    const std::string name = element.line();
    if (name.empty()) element.refuse_value("is empty", "give the name of a surface of the fluid");
    if (group::is_symmetry_plane(name))
      element.refuse_value("is the name of a plane of symmetry, where the fluid slides", "leave it out");
    if (std::find(names.begin(), names.end(), name) != names.end())
      element.refuse_value("is named twice", "name each surface once");
    names.push_back(name);
  }
  // Naming the outlet is the same as fluid.outlet = false.
  if (std::find(names.begin(), names.end(), group::outlet) != names.end()) fluid.outlet = false;
}

std::string text_of_closed(const FluidData& fluid) {
  return fluid.closed ? fmt::format("{}", fmt::join(*fluid.closed, ", ")) : std::string();
}

std::vector<CaseKey<FluidData>> fluid_keys() {
  return {
      leaf("density", required, "density in {unit}",
           number(at(&FluidData::density), positive, quantity::fluid_density())),
      leaf("viscosity", optional, "dynamic viscosity in {unit}",
           number(at(&FluidData::viscosity), positive, quantity::viscosity())),
      viscosity_model_key(),
      leaf("outlet", optional, "whether fluid leaves through a surface outlet, free of traction, default {}",
           flag(at(&FluidData::outlet))),
      leaf<FluidData>(
          "closed", optional,
          "names of surfaces that the fluid sticks to although the mesh names them; any other named surface "
          "of the fluid needs an opening",
          {read_closed, [](const FluidData& fluid) { return text_of_closed(fluid); }}, KeyRole::running),
      leaf("grad_div", optional, "grad-div stabilisation, default {}", flag(at(&FluidData::grad_div))),
  };
}

// [structure].

/// Without a name the scene chooses the frame, and a run puts it into the case before its hash is taken
/// (Scene::fibre_frame). Without fibres the value makes no difference.
KeyValue<StructureData> fibre_frame_value() {
  KeyValue<StructureData> value = name_from(at(&StructureData::fibre_frame), fibre_frames());
  value.write = [](const StructureData& data) {
    return std::string(fibre_frames().name_of(data.fibre_frame.value_or(FibreFrame::cylinder)));
  };
  return value;
}

KeyValue<StructureData> named_axis(KeyValue<StructureData> value) {
  value.read = [read = value.read](const CaseEntry& entry, StructureData& data) {
    read(entry, data);
    data.axis_is_named = true;
  };
  return value;
}

std::vector<CaseKey<StructureData>> structure_keys() {
  return {
      leaf("density", required, "density in {unit}",
           number(at(&StructureData::density), positive, quantity::density())),
      leaf("bulk_modulus", optional, "bulk modulus in {unit} of layers whose material has none of its own",
           number(at(&StructureData::bulk_modulus), positive, quantity::bulk_modulus())),
      leaf("stabilisation", optional,
           "alpha, factor of the wall's; default 0.05 with \"projected\" and a continuous layer_pressure, else 0.5",
           number(at(&StructureData::stabilisation), positive)),
      leaf("volume_factor", optional,
           "f: a state with det F below 1/f or above f in a nearly incompressible layer is no solution, default {}",
           number(at(&StructureData::volume_factor), Bounds{1, std::numeric_limits<double>::infinity(), false, false}),
           KeyRole::running),
      leaf("layer_pressure", optional, "the pressure where layers meet: {}",
           name_from(at(&StructureData::layer_pressure), layer_pressures())),
      leaf("fibre_frame", optional,
           "frame of the fibre directions: {}; cylinder: about the axis below; laplace: on a wall of any shape, by "
           "potentials between its inner and outer faces and between its ends; default cylinder for a wall that is one "
           "about that axis, else laplace",
           fibre_frame_value()),
      leaf("gravity", optional, "acceleration [x, y, z] in mm/ms^2 that loads all of the wall's mass, default {}",
           point(at(&StructureData::gravity), false)),
      leaf("axis_origin", optional,
           "point on the artery's axis in {unit}, default {}; of plane scenes where the upright axis stands",
           named_axis(point(at(&StructureData::axis_origin), false))),
      leaf("axis_direction", optional, "direction of the artery's axis in 3d, default {}",
           named_axis(point(at(&StructureData::axis_direction), true))),
      layers_key(),
      regions_key(),
  };
}

// [inlet], [load].

std::vector<CaseKey<TableInput>> pressure_keys() {
  const auto unlisted = [](const TableInput&) { return std::string(); };  // the section lists the table
  const auto read = [](const CaseEntry& entry, TableInput& input) { read_table(entry, pressure_kind(), false, input); };
  return {
      leaf<TableInput>("pressure", required,
                       "pressure in {unit}, or a table of [time in ms, pressure in {unit}], linear in between",
                       {read, unlisted, "", quantity::pressure().unit}),
      leaf<TableInput>("until", optional,
                       "time in {unit} at which a constant pressure falls to 0; without it the pressure stays",
                       {read_until, unlisted, "", quantity::time().unit}),
  };
}

CaseKey<Case> pressure_section(const std::string& name, const std::string& about,
                               std::optional<PressureTable> Case::*place) {
  const auto input = section<TableInput, TableInput>(
      name, optional, about, pressure_keys(), [](TableInput& all) -> TableInput& { return all; },
      [](const TableInput& all) { return &all; }, KeyRole::physics,
      [](const CaseEntry& entry, TableInput& all) { finish_table(entry, pressure_kind(), all); });
  return {name,
          optional,
          about,
          [read = input.read, place](const CaseEntry& entry, Case& scene) {
            TableInput given;
            read(entry, given);
            scene.*place = given.table;
          },
          [place](const Case& scene, const std::string& path, std::vector<CaseValue>& values) {
            if (!(scene.*place)) return;
            values.push_back({path + ".pressure", text_of_table(*(scene.*place)), KeyRole::physics});
          },
          KeyRole::physics,
          input.below};
}

// [time], [static].

/// A number, or "adaptive".
void read_step(const CaseEntry& entry, TimeData& time) {
  time.adaptive = entry.is_text() && entry.text() == "adaptive";
  time.step = 0;
  if (time.adaptive) return;
  if (entry.is_text()) {
    const std::string given = entry.text();
    if (edit_distance(given, "adaptive") <= 3) entry.refuse_name("is unknown", "did you mean \"adaptive\"?");
  }
  number(at(&TimeData::step), positive, quantity::time()).read(entry, time);
}

/// Adaptive steps: smallest <= first <= largest <= end, and none that vanishes beside the end.
void check_adaptive(const CaseEntry& entry, const TimeData& time) {
  const auto require = [&](const char* key, const std::optional<double>& value, const char* than, double bound) {
    if (value && *value > bound)
      entry.child(key).refuse(fmt::format("{} is more than the {} of {}", *value, than, bound),
                              fmt::format("give at most {}", bound));
  };
  const auto require_progress = [&](const char* key, const std::optional<double>& value, double part) {
    if (value && *value < part * time.end)
      entry.child(key).refuse(fmt::format("{} is less than {:g} of the end, {}", *value, part, time.end),
                              fmt::format("give at least {:.12g}", part * time.end));
  };
  require_progress("largest_step", time.largest_step, 1.0 / TimeData::most_steps);
  require_progress("first_step", time.first_step, smallest_part_of_end);
  require_progress("smallest_step", time.smallest_step, smallest_part_of_end);
  require("largest_step", time.largest_step, "end", time.end);
  require("first_step", time.first_step, time.largest_step ? "largest step" : "end",
          time.largest_step.value_or(time.end));
  require("smallest_step", time.smallest_step,
          time.first_step     ? "first step"
          : time.largest_step ? "largest step"
                              : "end",
          time.first_step.value_or(time.largest_step.value_or(time.end)));
}

void check_time(const CaseEntry& entry, TimeData& time) {
  if (!time.scheme && entry.has("damping")) time.scheme = "midpoint";  // the parameter of midpoint alone
  for (const auto& [scheme, row] : time_schemes().rows())
    for (const SchemeParameter& parameter : row.parameters) {
      if (!entry.has(parameter.name) || time.scheme == scheme) continue;
      const std::string found = time.scheme ? fmt::format("this run has \"{}\"", *time.scheme) : "this case names none";
      entry.child(parameter.name)
          .refuse(fmt::format("belongs to the scheme \"{}\", and {}", scheme, found),
                  fmt::format("remove it, or set time.scheme = \"{}\"", scheme));
    }
  const auto end = entry.child("end");
  if (time.adaptive) {
    check_adaptive(entry, time);
    return;
  }
  for (const char* key : {"tolerance", "first_step", "smallest_step", "largest_step"})
    if (entry.has(key))
      entry.child(key).refuse("belongs to adaptive steps, and this run has equal ones",
                              "remove it, or set time.step = \"adaptive\"");
  if (time.end < time.step)
    end.refuse(fmt::format("{} is less than one step of {}", time.end, time.step), "give an end >= step");
  const double steps = time.end / time.step;
  if (steps > TimeData::most_steps)
    entry.child("step").refuse(fmt::format("{} would take {:.3g} steps to {}", time.step, steps, time.end),
                               fmt::format("give a step that takes at most {}", TimeData::most_steps));
}

/// A parameter of one of the schemes.
CaseKey<TimeData> scheme_key(const SchemeParameter& p) {
  KeyValue<TimeData> value;
  value.read = parameter_reader(p, at(&TimeData::scheme_values));
  value.write = [p](const TimeData& time) {
    const auto found = time.scheme_values.find(p.name);
    if (found == time.scheme_values.end() && !p.standard) return std::string("chosen");
    return fmt::format("{}", found == time.scheme_values.end() ? *p.standard : found->second);
  };
  if (p.standard) value.standard = text_for_people(*p.standard);
  value.unit = p.quantity->unit;
  return leaf(p.name, optional, p.about, value);
}

std::vector<CaseKey<TimeData>> time_keys() {
  std::vector<CaseKey<TimeData>> keys = {
      leaf<TimeData>(
          "step", required, "time step in {unit}, or \"adaptive\"",
          {read_step, [](const TimeData& time) { return time.adaptive ? "adaptive" : fmt::format("{}", time.step); },
           "", quantity::time().unit},
          KeyRole::running),
      leaf("tolerance", optional, "error that adaptive steps aim at, relative to the solution, default {}",
           number(at(&TimeData::tolerance), Bounds{0, 1, false, false}), KeyRole::running),
      leaf("first_step", optional,
           "of adaptive ones, at the start and after each jump of the load, in {unit}; without it found from the scene",
           number(at(&TimeData::first_step), positive, quantity::time()), KeyRole::running),
      leaf("smallest_step", optional, "of adaptive ones, in {unit}; without it found from the scene",
           number(at(&TimeData::smallest_step), positive, quantity::time()), KeyRole::running),
      leaf("largest_step", optional, "of adaptive ones, in {unit}; without it found from the scene",
           number(at(&TimeData::largest_step), positive, quantity::time()), KeyRole::running),
      leaf("retries", optional,
           "times that a step which finds no solution is halved before the run gives up, default {}",
           whole(at(&TimeData::retries), 0, 20), KeyRole::running),
      leaf("end", required,
           "end of the run in {unit}; hit exactly, by shorter last steps where it is no multiple of step",
           number(at(&TimeData::end), positive, quantity::time()), KeyRole::running),
      periods_key(),
      leaf("period", optional, "in {unit}, of `periods` and of the lumped start; without it that of the openings",
           number(at(&TimeData::period), positive, quantity::time()), KeyRole::running),
      leaf("start", optional,
           "what Windkessels begin with: {}; lumped: initial_pressure of the periodic state that they have without the "
           "vessel",
           name_from(at(&TimeData::start), starts_of_openings()), KeyRole::running),
      leaf("scheme", optional,
           "time scheme: {}; without it midpoint, or tr-bdf2 where steps are long against the scene's time",
           name_from(at(&TimeData::scheme), time_schemes().names())),
      leaf("predictor", optional,
           "order of the extrapolated start of each step, default 2; euler of fsi-monolithic and explicit coupling 1",
           whole(at(&TimeData::predictor), 0, 2), KeyRole::running),
  };
  for (const auto& [scheme, row] : time_schemes().rows())
    for (const SchemeParameter& parameter : row.parameters) keys.push_back(scheme_key(parameter));
  return keys;
}

std::vector<CaseKey<StaticData>> static_keys() {
  return {
      leaf("load_steps", optional, "equal steps in which the load is raised, default {}",
           whole(at(&StaticData::load_steps), 1, TimeData::most_steps), KeyRole::running),
      leaf("retries", optional,
           "times that a load step which finds no solution is halved before the run gives up, default {}",
           whole(at(&StaticData::retries), 0, 20), KeyRole::running),
      leaf("check_path", optional,
           "whether load steps that are long for the solver are taken once more in two halves, which must lead to the "
           "same state, default {}",
           flag(at(&StaticData::check_path)), KeyRole::running),
  };
}

/// A section whose struct is an optional member of the case: present when the section is.
template <class Data>
CaseKey<Case> scene_section(const std::string& name, const std::string& about, const std::vector<CaseKey<Data>>& keys,
                            std::optional<Data> Case::*place,
                            std::function<void(const CaseEntry&, Data&)> check = nullptr) {
  return section<Data, Case>(
      name, optional, about, keys, [place](Case& scene) -> Data& { return (scene.*place).emplace(); },
      [place](const Case& scene) { return scene.*place ? &*(scene.*place) : nullptr; }, KeyRole::physics, check);
}

}  // namespace

std::vector<CaseKey<Case>> physics_keys() {
  return {
      leaf("title", optional, "what the case is, for people", any_text(at(&Case::title)), KeyRole::running),
      leaf("element", optional,
           "element pair: {}; p1: linear, equal order, stabilised; p2p1: Taylor-Hood, quadratic but for pressures",
           name_from(at(&Case::element), element_pairs())),
      leaf("geometry", optional,
           "space of the scene: {}; axisymmetric meshes are triangles in the plane of r = x and z, plane ones (plane "
           "strain) in that of x and y",
           name_from(at(&Case::geometry), geometries())),
      leaf("stabilisation", optional, "of equal-order elements: {}",
           name_from(at(&Case::stabilisation), stabilisation_kinds())),
      section<MeshData, Case>(
          "mesh", required, "where the mesh comes from", mesh_keys(),
          [](Case& scene) -> MeshData& { return scene.mesh; }, [](const Case& scene) { return &scene.mesh; },
          KeyRole::running, check_mesh),  // a checkpoint knows the mesh by its contents
      scene_section<FluidData>("fluid", "the fluid; without it a wall only", fluid_keys(), &Case::fluid,
                               check_viscosity),
      scene_section<StructureData>("structure", "the wall; without it a fluid between rigid walls", structure_keys(),
                                   &Case::structure, check_structure),
      pressure_section("inlet", "pressure at the inlet, in scenes with fluid", &Case::inlet),
      opening_key(),
      network_key(),
      pressure_section("load", "pressure on the inner face of the wall, in scenes without fluid", &Case::load),
      support_section(),
      prestress_section(),
      scene_section<TimeData>("time", "a run in time", time_keys(), &Case::time, check_time),
      scene_section("static", "a wall without inertia, instead of [time]", static_keys(), &Case::static_load),
      mesh_motion_section(),
  };
}

}  // namespace fsi
