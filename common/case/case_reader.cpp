#include "case/case_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <limits>
#include <optional>
#include <system_error>

#include "base/error.hpp"
#include "base/names.hpp"
#include "case/case_entry.hpp"
#include "case/case_overrides.hpp"

namespace fsi {

namespace {

constexpr int most_steps = 1'000'000;
constexpr bool required = true, optional = false;

// Readers: how the value of a key gets into its place.

template <class Target, class Value>
using Member = Value Target::*;
template <class Target>
using Reader = std::function<void(const CaseEntry&, Target&)>;

template <class Target>
Reader<Target> positive(Member<Target, double> place) {
  return [place](const CaseEntry& entry, Target& target) {
    target.*place = entry.number();
    if (!(target.*place > 0)) entry.refuse_value("is not positive", "give a number > 0");
  };
}

template <class Target>
Reader<Target> not_negative(Member<Target, double> place) {
  return [place](const CaseEntry& entry, Target& target) {
    target.*place = entry.number();
    if (!(target.*place >= 0)) entry.refuse_value("is negative", "give a number >= 0");
  };
}

/// A number in an interval whose ends belong to it or not.
struct Interval {
  double low, high;
  bool with_low, with_high;

  bool contains(double x) const { return (with_low ? x >= low : x > low) && (with_high ? x <= high : x < high); }
  std::string text() const {
    return fmt::format("{} {} and {} {}", with_low ? ">=" : ">", low, with_high ? "<=" : "<", high);
  }
};

template <class Target>
Reader<Target> inside(Member<Target, double> place, Interval interval) {
  return [=](const CaseEntry& entry, Target& target) {
    target.*place = entry.number();
    if (!interval.contains(target.*place)) entry.refuse_value("is out of range", "give a number " + interval.text());
  };
}

template <class Target, class Whole>  // int, or an optional one
Reader<Target> whole(Member<Target, Whole> place, int low, int high = std::numeric_limits<int>::max()) {
  return [=](const CaseEntry& entry, Target& target) {
    const int value = entry.whole_number();
    target.*place = value;
    if (value < low || value > high)
      entry.refuse_value("is out of range", high == std::numeric_limits<int>::max()
                                                ? fmt::format("give a whole number >= {}", low)
                                                : fmt::format("give a whole number from {} to {}", low, high));
  };
}

template <class Target>
Reader<Target> flag(Member<Target, bool> place) {
  return [place](const CaseEntry& entry, Target& target) { target.*place = entry.boolean(); };
}

template <class Target>
Reader<Target> any_text(Member<Target, std::string> place) {
  return [place](const CaseEntry& entry, Target& target) { target.*place = entry.text(); };
}

/// \param planned  names that will be valid one day: not misspelt, but refused
void require_name(const CaseEntry& entry, const std::vector<std::string>& names,
                  const std::vector<std::string>& planned = {}) {
  const auto name = entry.text();
  if (std::find(names.begin(), names.end(), name) != names.end()) return;
  if (std::find(planned.begin(), planned.end(), name) != planned.end())
    entry.refuse_name("is not available yet", "give " + one_of(names));
  if (names.size() == 1) entry.refuse_name("is unknown", "give " + names.front());
  entry.refuse_name("is unknown", "did you mean " + nearest_name(name, names) + "? There are " + one_of(names));
}

template <class Target>
Reader<Target> name_from(Member<Target, std::string> place, std::vector<std::string> names,
                         std::vector<std::string> planned = {}) {
  return [=](const CaseEntry& entry, Target& target) {
    require_name(entry, names, planned);
    target.*place = entry.text();
  };
}

template <class Target>
Reader<Target> point(Member<Target, Point> place, bool nonzero) {
  return [=](const CaseEntry& entry, Target& target) {
    const auto coordinates = entry.elements();
    if (coordinates.size() != 3) entry.refuse_value("is no point", "give [x, y, z]");
    auto& p = target.*place;
    for (std::size_t i = 0; i < 3; ++i) p[i] = coordinates[i].number();
    if (nonzero && std::hypot(p[0], p[1], p[2]) == 0)
      entry.refuse_value("has no direction", "give a vector other than 0");
  };
}

/// A section: its keys are read into the struct that `place` finds or makes; `check` looks at the whole of it.
template <class Target, class Parent>
CaseKey<Parent> section(const std::string& name, bool is_required, const std::string& about,
                        std::vector<CaseKey<Target>> keys, std::function<Target&(Parent&)> place,
                        std::function<void(const CaseEntry&, Target&)> check = nullptr) {
  CaseKey<Parent> key{name, is_required, about, nullptr, {}};
  for (const auto& child : keys) {
    key.below.push_back({name + "." + child.name, child.about, child.required});
    for (const auto& grandchild : child.below)
      key.below.push_back({name + "." + grandchild.path, grandchild.about, grandchild.required});
  }
  key.read = [keys = std::move(keys), place, check](const CaseEntry& entry, Parent& parent) {
    Target& target = place(parent);
    read_keys(entry, keys, target);
    if (check) check(entry, target);
  };
  return key;
}

// [mesh].

/// Relative to the case file; given by --set, relative to the working directory if the file is there.
void read_mesh_file(const CaseEntry& entry, MeshData& mesh) {
  const std::filesystem::path file = entry.text();
  if (file.empty()) entry.refuse_value("is empty", "give the path of a gmsh file");
  std::error_code error;
  if (entry.source().is_overridden(entry.key()) && std::filesystem::exists(file, error))
    mesh.file = file;
  else
    mesh.file = std::filesystem::path(entry.source().file).parent_path() / file;
}

void check_mesh(const CaseEntry& entry, MeshData& mesh) {
  if (mesh.file.empty() && mesh.level.empty())
    entry.refuse("neither file nor level", "give file = \"NAME.msh\" or level = \"coarse\"");
  if (!mesh.file.empty() && !mesh.level.empty()) entry.child("level").refuse("both file and level", "keep one of them");
}

const std::vector<CaseKey<MeshData>>& mesh_keys() {
  static const std::vector<CaseKey<MeshData>> keys = {
      {"file", optional, "gmsh mesh, path relative to the case file", read_mesh_file},
      {"level", optional, "artery mesh made on demand: coarse, intermediate or fine",
       name_from(&MeshData::level, {"coarse", "intermediate", "fine"})},
  };
  return keys;
}

// [fluid].

const std::vector<CaseKey<FluidData>>& fluid_keys() {
  static const std::vector<CaseKey<FluidData>> keys = {
      {"density", required, "density in mg/mm^3", positive(&FluidData::density)},
      {"viscosity", required, "dynamic viscosity in kPa ms", positive(&FluidData::viscosity)},
      {"grad_div", optional, "grad-div stabilisation, default false", flag(&FluidData::grad_div)},
  };
  return keys;
}

// [structure].

using Material = MaterialData;

const CaseKey<Material>& c10_key() {
  static const CaseKey<Material> key{"c10", required, "isotropic stiffness in kPa", positive(&Material::c10)};
  return key;
}

/// The parameters that each material takes.
const std::map<std::string, std::vector<CaseKey<Material>>>& material_table() {
  static const std::map<std::string, std::vector<CaseKey<Material>>> table = {
      {"neo-hookean", {c10_key()}},
      {"mooney-rivlin",
       {c10_key(), {"c01", required, "second isotropic stiffness in kPa", not_negative(&Material::c01)}}},
      {"artery",
       {c10_key(),
        {"k1", required, "fibre stiffness in kPa", not_negative(&Material::k1)},
        {"k2", required, "fibre exponent", positive(&Material::k2)},
        {"alpha", required, "degrees between fibres and circumference", inside(&Material::alpha, {0, 90, true, true})},
        {"fibre_scale", optional, "factor on the fibre energy, default 1", positive(&Material::fibre_scale)}}},
  };
  return table;
}

std::vector<std::string> material_names() {
  std::vector<std::string> names;
  for (const auto& [name, keys] : material_table()) names.push_back(name);
  return names;
}

void read_layer(const CaseEntry& entry, Material& layer) {
  const std::string about = "its model: " + one_of(material_names());
  const auto children = entry.children();
  if (!entry.has("material")) {
    // A misspelt `material` explains better why there is none.
    for (const auto& child : children)
      if (edit_distance(child.key(), entry.key() + ".material") <= 2)
        child.refuse("unknown key", "did you mean " + entry.key() + ".material?");
    entry.refuse_missing("material", "add it (" + about + ")");
  }
  const auto name = entry.child("material", about);
  require_name(name, material_names());

  std::vector<CaseKey<Material>> keys = {{"material", required, about, any_text(&Material::material)}};
  const auto& parameters = material_table().at(name.text());
  keys.insert(keys.end(), parameters.begin(), parameters.end());
  // A parameter of another material is no misprint; say what this one takes.
  for (const auto& child : children) {
    const auto is_child = [&](const auto& key) { return entry.key() + "." + key.name == child.key(); };
    if (std::any_of(keys.begin(), keys.end(), is_child)) continue;
    for (const auto& [other, other_keys] : material_table()) {
      if (!std::any_of(other_keys.begin(), other_keys.end(), is_child)) continue;
      std::vector<std::string> own;
      for (const auto& key : parameters) own.push_back(key.name);
      child.refuse("is no parameter of " + name.text() + " but of " + other,
                   "remove it (" + name.text() + " takes " + one_of(own) + ")");
    }
  }
  read_keys(entry, keys, layer);
}

void read_layers(const CaseEntry& entry, StructureData& structure) {
  const auto layers = entry.children();
  if (layers.empty())
    entry.refuse("has no layer", "add a section [structure.layers.NAME] per volume group of the wall");
  for (const auto& layer : layers) {
    const auto name = layer.key().substr(entry.key().size() + 1);
    if (name == "fluid" || name.empty())
      layer.refuse("\"" + name + "\" cannot be a layer", "use the name of a volume group of the wall");
    read_layer(layer, structure.layers[name]);
  }
}

std::vector<KeyHelp> layers_help() {
  std::vector<KeyHelp> help = {{"layers.NAME.material", one_of(material_names()), required}};
  for (const auto& [material, keys] : material_table())
    for (const auto& key : keys) help.push_back({"layers.NAME." + key.name, material + ": " + key.about, key.required});
  return help;
}

const std::vector<CaseKey<StructureData>>& structure_keys() {
  static const std::vector<CaseKey<StructureData>> keys = {
      {"density", required, "density in mg/mm^3", positive(&StructureData::density)},
      {"bulk_modulus", required, "bulk modulus in kPa", positive(&StructureData::bulk_modulus)},
      {"stabilisation", optional, "alpha in tau = alpha h^2/(2 mu), default 0.5",
       positive(&StructureData::stabilisation)},
      {"axis_origin", optional, "point on the artery's axis in mm, default [0, 0, 0]",
       point(&StructureData::axis_origin, false)},
      {"axis_direction", optional, "direction of the artery's axis, default [0, 0, 1]",
       point(&StructureData::axis_direction, true)},
      {"layers", required, "a section [structure.layers.NAME] per volume group of the wall", read_layers,
       layers_help()},
  };
  return keys;
}

// [inlet], [load].

/// `pressure` and `until` as they stand in the file.
struct PressureInput {
  PressureTable table;
  bool is_table = false;
  std::optional<double> until;
};

void read_pressure(const CaseEntry& entry, PressureInput& input) {
  input.is_table = entry.is_array();
  if (!input.is_table) {
    input.table.points = {{0.0, entry.number()}};
    return;
  }
  auto& points = input.table.points;
  for (const auto& row : entry.elements()) {
    const auto pair = row.is_array() ? row.elements() : std::vector<CaseEntry>{};
    if (pair.size() != 2) row.refuse_value("is no pair", "give [time, pressure]");
    points.emplace_back(pair[0].number(), pair[1].number());
    const auto n = points.size();
    if (n > 1 && points[n - 1].first < points[n - 2].first)
      row.refuse_value(fmt::format("comes before the time {} of the row above", points[n - 2].first),
                       "sort the table by time");
    if (n > 2 && points[n - 1].first == points[n - 3].first)
      row.refuse_value("is the third row with this time", "give two rows for a jump");
  }
  if (points.empty()) entry.refuse_name("is empty", "give at least one row [time, pressure]");
}

void read_until(const CaseEntry& entry, PressureInput& input) {
  input.until = entry.number();
  if (!(*input.until > 0)) entry.refuse_value("is not positive", "give a time > 0");
}

void check_pressure(const CaseEntry& entry, PressureInput& input) {
  if (!input.until) return;
  if (input.is_table)
    entry.child("until").refuse("stands beside a table of pressures",
                                "remove it; the table says when the pressure ends");
  auto& points = input.table.points;
  const double pressure = points.front().second;
  points = {{0.0, pressure}, {*input.until, pressure}, {*input.until, 0.0}};
}

const std::vector<CaseKey<PressureInput>>& pressure_keys() {
  static const std::vector<CaseKey<PressureInput>> keys = {
      {"pressure", required, "pressure in kPa, or a table of [time in ms, pressure in kPa], linear in between",
       read_pressure},
      {"until", optional, "time in ms at which a constant pressure falls to 0; without it the pressure stays",
       read_until},
  };
  return keys;
}

CaseKey<Case> pressure_section(const std::string& name, const std::string& about,
                               Member<Case, std::optional<PressureTable>> place) {
  auto key = section<PressureInput, PressureInput>(
      name, optional, about, pressure_keys(), [](PressureInput& input) -> PressureInput& { return input; },
      check_pressure);
  return {name, optional, about,
          [read = key.read, place](const CaseEntry& entry, Case& scene) {
            PressureInput input;
            read(entry, input);
            scene.*place = input.table;
          },
          key.below};
}

// [time], [static].

void check_time(const CaseEntry& entry, TimeData& time) {
  const auto end = entry.child("end");
  if (time.end < time.step)
    end.refuse(fmt::format("{} is less than one step of {}", time.end, time.step), "give an end >= step");
  const double steps = time.end / time.step;
  if (steps > most_steps)
    entry.child("step").refuse(fmt::format("{} would take {:.3g} steps to {}", time.step, steps, time.end),
                               fmt::format("give a step that takes at most {}", most_steps));
  const double whole_steps = std::round(steps);
  if (std::abs(steps - whole_steps) > 1e-9)
    end.refuse(fmt::format("{} is no multiple of the step {}", time.end, time.step),
               fmt::format("give {:.12g} or {:.12g}", std::floor(steps) * time.step, std::ceil(steps) * time.step));
}

const std::vector<CaseKey<TimeData>>& time_keys() {
  constexpr Interval newmark{0, 1, false, true};
  static const std::vector<CaseKey<TimeData>> keys = {
      {"step", required, "time step in ms", positive(&TimeData::step)},
      {"end", required, "end of the run in ms, a multiple of the step", positive(&TimeData::end)},
      {"newmark_beta", optional, "Newmark's beta of the wall, default 1", inside(&TimeData::newmark_beta, newmark)},
      {"newmark_gamma", optional, "Newmark's gamma of the wall, default 1", inside(&TimeData::newmark_gamma, newmark)},
      {"predictor", optional,
       "order of the extrapolated start of each step, default 1; coupling schemes that iterate 2",
       whole(&TimeData::predictor, 0, 2)},
  };
  return keys;
}

const std::vector<CaseKey<StaticData>>& static_keys() {
  static const std::vector<CaseKey<StaticData>> keys = {
      {"load_steps", optional, "equal steps in which the load is raised, default 10",
       whole(&StaticData::load_steps, 1, most_steps)},
  };
  return keys;
}

// Solvers and output.

constexpr Interval tolerance{0, 1, false, false};

const std::vector<CaseKey<MultigridData>>& multigrid_keys() {
  static const std::vector<CaseKey<MultigridData>> keys = {
      {"cycle", optional, "of the coupled amg: v, w (default) or k", name_from(&MultigridData::cycle, {"v", "w", "k"})},
      {"pre_smoothing", optional, "steps of the coupled smoother before the coarse correction, default 5",
       whole(&MultigridData::pre_smoothing, 0)},
      {"post_smoothing", optional, "steps of the coupled smoother after the coarse correction, default 5",
       whole(&MultigridData::post_smoothing, 0)},
      {"damping", optional, "damping factor of the coupled smoother, default 0: estimated on each level",
       inside(&MultigridData::damping, {0, 1, true, true})},
      {"levels", optional, "levels at most, default 10", whole(&MultigridData::levels, 1)},
      {"coarsest_nodes", optional, "fluid and wall nodes of the level that is solved directly, at most, default 400",
       whole(&MultigridData::coarsest_nodes, 1)},
      {"coarsening", optional, "choice of coarse nodes: colouring (default) or aggregation",
       name_from(&MultigridData::coarsening, {"colouring", "aggregation"})},
      {"fluid_smoother", optional, "smoother of the flow: braess-sarazin (default) or vanka",
       name_from(&MultigridData::fluid_smoother, {"braess-sarazin", "vanka"})},
      {"wall_smoother", optional, "smoother of the wall: braess-sarazin (default) or vanka",
       name_from(&MultigridData::wall_smoother, {"braess-sarazin", "vanka"})},
      {"sub_cycle", optional, "cycle of the sub-problems: v or w (default)",
       name_from(&MultigridData::sub_cycle, {"v", "w"})},
      {"sub_smoothing", optional, "smoothing steps of the sub-problems before and after, default 2",
       whole(&MultigridData::sub_smoothing, 1)},
  };
  return keys;
}

void check_multigrid(const CaseEntry& entry, MultigridData& multigrid) {
  if (multigrid.pre_smoothing + multigrid.post_smoothing == 0)
    entry.refuse("neither pre_smoothing nor post_smoothing", "give at least one step");
}

const std::vector<CaseKey<MonolithicData>>& monolithic_keys() {
  static const std::vector<CaseKey<MonolithicData>> keys = {
      {"linear_solver", optional,
       "fast (default): chosen by size and speed; direct: sparse factorisation; GMRES with diagonal, lower, upper, "
       "ssor, ilu, by multigrid or (..._exact) factorisation; "
       "coupled multigrid amg, amli, alone or with _gmres, _fgmres",
       name_from(&MonolithicData::linear_solver, linear_solver_names())},
      {"linear_tolerance", optional,
       "residual of each linear solve relative to its right-hand side, default 0: what Newton's convergence needs",
       inside(&MonolithicData::linear_tolerance, {0, 1, true, false})},
      {"max_linear_iterations", optional, "iterations of each linear solve, default 500",
       whole(&MonolithicData::max_linear_iterations, 1)},
      {"direct_below", optional, "unknowns below which fast factorises the matrix, default 2000",
       whole(&MonolithicData::direct_below, 0)},
      {"krylov_restart", optional, "directions that GMRES and FGMRES keep, default 250",
       whole(&MonolithicData::krylov_restart, 1)},
      section<MultigridData, MonolithicData>(
          "multigrid", optional, "multigrid of the sub-problems and of the coupled system", multigrid_keys(),
          [](MonolithicData& monolithic) -> MultigridData& { return monolithic.multigrid; }, check_multigrid),
      {"mode", optional,
       "kept: factors serve while the residual keeps falling (default); full: new ones each iteration",
       name_from(&MonolithicData::mode, {"kept", "full"})},
      {"newton_tolerance", optional, "last increment relative to the first of the step, default 1e-8",
       inside(&MonolithicData::newton_tolerance, tolerance)},
      {"residual_tolerance", optional, "residual relative to the first of the step, default 0: not demanded",
       inside(&MonolithicData::residual_tolerance, {0, 1, true, false})},
      {"max_iterations", optional, "Newton iterations per step, default 30", whole(&MonolithicData::max_iterations, 1)},
  };
  return keys;
}

const std::vector<CaseKey<PartitionedData>>& partitioned_keys() {
  static const std::vector<CaseKey<PartitionedData>> keys = {
      {"scheme", optional,
       "coupling: robin-neumann-iqn (default), robin-neumann-imvj, robin-neumann, iqn-ils, iqn-imvj, newton-krylov, "
       "aitken, constant, or explicit",
       name_from(&PartitionedData::scheme, coupling_scheme_names())},
      {"tolerance", optional, "interface change relative to its displacement, default 1e-6",
       inside(&PartitionedData::tolerance, tolerance)},
      {"absolute_tolerance", optional,
       "interface change in mm (Euclidean norm) that is small enough too, default 1e-13",
       not_negative(&PartitionedData::absolute_tolerance)},
      {"force_tolerance", optional,
       "what the interface's momentum balance may lack relative to the force, default 0: not demanded",
       inside(&PartitionedData::force_tolerance, {0, 1, true, false})},
      {"velocity_gap", optional,
       "explicit ends when fluid and wall differ in velocity by more than this part of the largest so far, over 8 "
       "steps in a row, default 0.5",
       positive(&PartitionedData::velocity_gap)},
      {"relaxation", optional, "constant factor or the scheme's first; without it the scheme chooses",
       inside(&PartitionedData::relaxation, {0, 2, false, false})},
      {"max_iterations", optional, "coupling iterations per step, default 200",
       whole(&PartitionedData::max_iterations, 1)},
      {"reused_steps", optional, "earlier time steps whose differences iqn-ils keeps, default 10",
       whole(&PartitionedData::reused_steps, 0)},
      {"columns", optional, "differences that a quasi-Newton scheme keeps at most, default 200",
       whole(&PartitionedData::columns, 1)},
      {"filter", optional, "part of a difference that must be new for a quasi-Newton scheme to keep it, default 1e-2",
       inside(&PartitionedData::filter, {0, 1, true, false})},
      {"linear_solver", optional, "of the sub-problems: fast (default) or direct",
       name_from(&PartitionedData::linear_solver, {"fast", "direct"})},
      {"direct_below", optional, "unknowns of a sub-problem below which fast factorises the matrix, default 2000",
       whole(&PartitionedData::direct_below, 0)},
  };
  return keys;
}

void read_fields(const CaseEntry& entry, OutputData& output) {
  output.fields.clear();
  for (const auto& element : entry.elements()) {
    require_name(element, {"displacement", "velocity", "pressure"});
    const auto field = element.text();
    if (std::find(output.fields.begin(), output.fields.end(), field) != output.fields.end())
      element.refuse_value("is named twice", "name each field once");
    output.fields.push_back(field);
  }
}

const std::vector<CaseKey<OutputData>>& output_keys() {
  static const std::vector<CaseKey<OutputData>> keys = {
      {"fields", optional, "fields in fields.h5: any of displacement, velocity, pressure; default all", read_fields},
      {"every", optional, "steps between entries of fields.h5, default 8; 0: no fields", whole(&OutputData::every, 0)},
      {"checkpoint_every", optional, "steps between checkpoints, default 1; 0: none",
       whole(&OutputData::checkpoint_every, 0)},
      {"energy", optional, "energy balance of each step in energy.csv, default true", flag(&OutputData::energy)},
  };
  return keys;
}

const std::vector<CaseKey<EconomyData>>& economy_keys() {
  static const std::vector<CaseKey<EconomyData>> keys = {
      {"constant_operators", optional,
       "the mesh motion's operator, which never changes: kept (default), or rebuilt and factorised at each use",
       name_from(&EconomyData::constant_operators, {"kept", "rebuilt"})},
  };
  return keys;
}

// The whole case.

/// A section whose struct is an optional member of the case: present when the section is.
template <class Data>
CaseKey<Case> scene_section(const std::string& name, const std::string& about, const std::vector<CaseKey<Data>>& keys,
                            Member<Case, std::optional<Data>> place, Reader<Data> check = nullptr) {
  return section<Data, Case>(
      name, optional, about, keys, [place](Case& scene) -> Data& { return (scene.*place).emplace(); }, check);
}

/// A section with a default for everything in it.
template <class Data>
CaseKey<Case> default_section(const std::string& name, bool is_required, const std::string& about,
                              const std::vector<CaseKey<Data>>& keys, Member<Case, Data> place,
                              Reader<Data> check = nullptr) {
  return section<Data, Case>(
      name, is_required, about, keys, [place](Case& scene) -> Data& { return scene.*place; }, check);
}

const std::vector<CaseKey<Case>>& case_keys() {
  static const std::vector<CaseKey<Case>> keys = {
      {"title", optional, "what the case is, for people", any_text(&Case::title)},
      {"element", optional, "element pair: p1 (default)", name_from(&Case::element, {"p1"}, {"p2p1"})},
      default_section("mesh", required, "where the mesh comes from", mesh_keys(), &Case::mesh, {check_mesh}),
      scene_section("fluid", "the fluid; without it a wall only", fluid_keys(), &Case::fluid),
      scene_section("structure", "the wall; without it a fluid between rigid walls", structure_keys(),
                    &Case::structure),
      pressure_section("inlet", "pressure at the inlet, in scenes with fluid", &Case::inlet),
      pressure_section("load", "pressure on the inner face of the wall, in scenes without fluid", &Case::load),
      scene_section("time", "a run in time", time_keys(), &Case::time, {check_time}),
      scene_section("static", "a wall without inertia, instead of [time]", static_keys(), &Case::static_load),
      default_section("monolithic", optional, "for fsi-monolithic", monolithic_keys(), &Case::monolithic),
      default_section("partitioned", optional, "for fsi-partitioned", partitioned_keys(), &Case::partitioned),
      default_section("output", optional, "what is written", output_keys(), &Case::output),
      default_section("economy", optional, "savings to switch off, to see what they are worth", economy_keys(),
                      &Case::economy),
  };
  return keys;
}

/// What sections must be there, or must not, given the others.
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
      {fluid && !scene.inlet, "", "no [inlet]", "add [inlet] with pressure, since there is a fluid"},
      {!fluid && scene.inlet, "inlet", "stands in a case without fluid", "rename it to [load], or add [fluid]"},
      {!fluid && !scene.load, "", "no [load]", "add [load] with pressure, since there is no fluid"},
      {fluid && scene.load, "load", "is for a wall without fluid", "rename it to [inlet], or remove it"},
      {in_static && scene.load && scene.load->points.size() > 1, "load", "changes in time, but the case is static",
       "give one pressure, without until"},
  };
  for (const auto& rule : rules)
    if (rule.broken) whole_case.child(rule.section).refuse(rule.problem, rule.remedy);
}

std::string contents_of(const std::filesystem::path& file) {
  std::error_code error;
  if (!std::filesystem::exists(file, error))
    throw InputError(file.string(), "", "no such file", "give the path of a case file");
  if (std::filesystem::is_directory(file, error))
    throw InputError(file.string(), "", "is a folder", "give the path of a case file");
  std::ifstream stream(file, std::ios::binary);
  std::string text((std::istreambuf_iterator<char>(stream)), std::istreambuf_iterator<char>());
  if (!stream) throw InputError(file.string(), "", "cannot be read", "check its permissions");
  return text;
}

toml::table parsed_document(const std::string& text, const CaseSource& source) {
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
  CaseSource source{file.string(), {}};
  toml::table document = parsed_document(text, source);
  apply_overrides(overrides, document, source);

  const CaseEntry whole_case(document, "", "", source);
  Case scene;
  scene.path = file;
  read_keys(whole_case, case_keys(), scene);
  check_sections(whole_case, scene);
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
