#include <fmt/ranges.h>

#include <algorithm>

#include "case/case_keys.hpp"
#include "case/derived_keys.hpp"
#include "case/key_values.hpp"
#include "case/sample_keys.hpp"
#include "linear/policy/solver_policy.hpp"

namespace fsi {

namespace {

using presence::optional;
constexpr int most_iterations = 1'000'000, most_smoothing = 1'000, most_directions = 10'000, most_levels = 100;
constexpr int most_steps_between = 1'000'000'000, most_unknowns = 2'000'000'000;
constexpr Bounds tolerance{0, 1, false, false}, tolerance_or_none{0, 1, true, false};

std::string direct_below_standards() {
  return fmt::format("default {} in three dimensions, {} in two",
                     SolverPolicy::standard_limit(SolvedSystem::jacobian, 3),
                     SolverPolicy::standard_limit(SolvedSystem::jacobian, 2));
}

std::string where_the_wall_decides() {
  return fmt::format("from {} on not where the wall's stiffness is below {:g} times its inertia",
                     SolverPolicy::wall_decides_from, SolverPolicy::wall_iterates_below);
}

std::vector<CaseKey<MultigridData>> multigrid_keys() {
  using M = MultigridData;
  using Coarsening = CoupledCoarseningOptions;
  using Smoothing = CoupledSmoothingOptions;
  using Sub = SubProblemCycleOptions;
  return {
      leaf("cycle", optional, "of the coupled amg: {}",
           name_from(at(&M::cycle, &CoupledCycleOptions::kind), coupled_cycle_kinds())),
      leaf("pre_smoothing", optional, "steps of the coupled smoother before the coarse correction, default {}",
           whole(at(&M::smoothing, &Smoothing::pre_smoothing), 0, most_smoothing)),
      leaf("post_smoothing", optional, "steps of the coupled smoother after the coarse correction, default {}",
           whole(at(&M::smoothing, &Smoothing::post_smoothing), 0, most_smoothing)),
      leaf("damping", optional, "damping factor of the coupled smoother, default {}: estimated on each level",
           number(at(&M::smoothing, &Smoothing::damping), {0, 1, true, true})),
      leaf("levels", optional, "levels at most, default {}",
           whole(at(&M::coarsening, &Coarsening::max_levels), 1, most_levels)),
      leaf("coarsest_nodes", optional, "fluid and wall nodes of the level that is solved directly, at most, default {}",
           whole(at(&M::coarsening, &Coarsening::coarsest_nodes), 1, most_unknowns)),
      leaf("coarsening", optional, "choice of coarse nodes: {}",
           name_from(at(&M::coarsening, &Coarsening::kind), coarsening_kinds())),
      leaf("fluid_smoother", optional, "smoother of the flow: {}",
           name_from(at(&M::sub_problems, &Sub::fluid_smoother), saddle_smoother_kinds())),
      leaf("wall_smoother", optional, "smoother of the wall: {}",
           name_from(at(&M::sub_problems, &Sub::wall_smoother), saddle_smoother_kinds())),
      leaf("sub_cycle", optional, "cycle of the sub-problems: {}",
           name_from(at(&M::sub_problems, &Sub::kind), linear_cycle_kinds())),
      leaf("sub_smoothing", optional, "smoothing steps of the sub-problems before and after, default {}",
           whole(at(&M::sub_problems, &Sub::smoothing), 1, most_smoothing)),
  };
}

void check_multigrid(const CaseEntry& entry, MultigridData& multigrid) {
  if (multigrid.smoothing.pre_smoothing + multigrid.smoothing.post_smoothing == 0)
    entry.refuse("neither pre_smoothing nor post_smoothing", "give at least one step");
}

/// Refuses the mode of version 0.1: its error estimate missed errors that appear in the pressure of the next steps.
KeyValue<NewtonOptions> newton_mode() {
  auto mode = name_from(at(&NewtonOptions::mode), newton_modes());
  mode.read = [read = mode.read](const CaseEntry& entry, NewtonOptions& newton) {
    if (entry.text() == "linearised")
      entry.refuse_name("is gone: it left up to 10 % of the pressure where it said 0.1 %",
                        "use \"kept\", with a looser newton.tolerance, 1e-2 say, where fewer solves are worth more "
                        "than digits");
    read(entry, newton);
  };
  return mode;
}

/// The value of a part of the case as a value of the case.
template <class Part>
KeyValue<Case> in_case(KeyValue<Part> value, Part Case::*part) {
  return {[read = value.read, part](const CaseEntry& entry, Case& scene) { read(entry, scene.*part); },
          [write = value.write, part](const Case& scene) { return write(scene.*part); }, value.standard, value.unit};
}

std::vector<CaseKey<NewtonOptions>> newton_keys() {
  using N = NewtonOptions;
  auto last_increment = number(at(&N::tolerance), tolerance);
  last_increment.standard = text_for_people(NewtonStandards::options().tolerance);
  return {
      leaf("mode", optional, "{}; kept: factors serve while the residual keeps falling; full: new ones each iteration",
           newton_mode()),
      leaf("tolerance", optional, "last increment relative to the first of the step, default {}", last_increment),
      leaf("error_tolerance", optional,
           fmt::format("estimated error of a step, relative to what it changes, in place of tolerance; default {} in "
                       "runs of fixed steps that name neither, {} without fluid, else 0: not demanded",
                       text_for_people(NewtonStandards::error_tolerance),
                       text_for_people(NewtonStandards::error_tolerance_of_wall)),
           number(at(&N::error_tolerance), tolerance_or_none)),
      leaf("residual_tolerance", optional, "residual relative to the first of the step, default {}: not demanded",
           number(at(&N::residual_tolerance), tolerance_or_none)),
      leaf("max_iterations", optional, "Newton iterations per step, default {}",
           whole(at(&N::max_iterations), 1, most_iterations)),
  };
}

std::vector<CaseKey<Case>> linear_keys() {
  using L = LinearData;
  return {
      leaf("tolerance", optional,
           "residual of each linear solve relative to its right-hand side, default {}: what Newton's convergence needs",
           number(at(&Case::newton, &NewtonOptions::linear_tolerance), tolerance_or_none)),
      leaf("max_iterations", optional, "of the paper's coupled solvers: iterations of each linear solve, default {}",
           in_case(whole(at(&L::krylov, &KrylovOptions::max_iterations), 1, most_iterations), &Case::linear)),
      leaf("restart", optional, "of the paper's coupled solvers: directions that GMRES and FGMRES keep, default {}",
           in_case(whole(at(&L::krylov, &KrylovOptions::restart), 1, most_directions), &Case::linear)),
      leaf("direct_below", optional,
           "unknowns below which fast factorises the matrix, " + direct_below_standards() + ", but " +
               where_the_wall_decides() +
               "; of the whole system, of a sub-problem, or with robin-neumann-inexact and block-newton of both media "
               "together",
           in_case(whole(at(&L::fast, &FastOptions::direct_below), 0, most_unknowns), &Case::linear)),
      leaf("preconditioner", optional,
           "of fast where it iterates, on one process: {}; block-factors: pressures, then velocities; simple: "
           "velocities, then "
           "pressures, which correct them",
           in_case(name_from(at(&L::fast, &FastOptions::preconditioner), flow_preconditioner_names()), &Case::linear)),
  };
}

std::vector<CaseKey<MonolithicData>> monolithic_keys() {
  using M = MonolithicData;
  return {
      leaf("linear_solver", optional,
           "{}; fast: chosen by size and speed; direct: sparse factorisation; petsc: the method of fast by PETSc, see "
           "[petsc]; "
           "the next are GMRES preconditioned by "
           "blocks, these inverted by multigrid or (..._exact) factorised; amg and amli are coupled multigrid, alone "
           "or inside GMRES or FGMRES",
           name_from(at(&M::linear_solver), linear_solver_names())),
      section<MultigridData, M>(
          "multigrid", optional, "multigrid of the sub-problems and of the coupled system", multigrid_keys(),
          [](M& monolithic) -> MultigridData& { return monolithic.multigrid; },
          [](const M& monolithic) { return &monolithic.multigrid; }, KeyRole::running, check_multigrid),
  };
}

std::vector<CaseKey<PartitionedData>> partitioned_keys() {
  using P = PartitionedData;
  using QuasiNewton = QuasiNewtonOptions;
  return {
      leaf("scheme", optional,
           "coupling: {}; default robin-neumann-inexact; where the wall stands in the fluid iqn-ils, or "
           "robin-neumann-iqn if no opening sets the pressure",
           name_from(at(&P::scheme), coupling_scheme_names())),
      leaf("tolerance", optional,
           fmt::format("gap between fluid and wall relative to the interface's displacement, default {}; "
                       "robin-neumann-inexact and "
                       "block-newton: error of a step relative to what it changes, without it what [newton] demands",
                       text_for_people(P::standard_tolerance)),
           number(at(&P::tolerance), tolerance)),
      leaf("tolerance_of", optional,
           "{}; pressure: the tolerance holds, besides, for the pressure that would make up the gap in one step, "
           "relative "
           "to that on the interface; displacement: for the displacement alone, as the paper has it",
           name_from(at(&P::tolerance_of), tolerance_kinds())),
      leaf("absolute_tolerance", optional,
           "interface change in {unit} (Euclidean norm) that is small enough too, default {}",
           number(at(&P::absolute_tolerance), not_negative, quantity::length())),
      leaf("force_tolerance", optional,
           "residual of the interface's momentum balance relative to the force, default {}: not demanded",
           number(at(&P::force_tolerance), tolerance_or_none)),
      leaf("velocity_gap", optional,
           "explicit ends when fluid and wall differ in velocity by more than this part of the largest so far, over 8 "
           "steps in a row, default {}",
           number(at(&P::velocity_gap), positive)),
      leaf("robin_coefficient", optional,
           "of the schemes that begin with robin-robin, traction per velocity of the interface, {unit}; default from "
           "wall "
           "and fluid: sqrt(K (density of the wall times its thickness + density of the fluid times half the radius)), "
           "K being the hoop stiffness",
           number(at(&P::robin_coefficient), positive, quantity::bedding_damping())),
      leaf("relaxation", optional, "constant factor or the scheme's first; without it the scheme chooses",
           number(at(&P::relaxation), {0, 2, false, false})),
      leaf("max_iterations", optional,
           "coupling iterations per step, of block-newton passes per linear system, default {}",
           whole(at(&P::max_iterations), 1, most_iterations)),
      leaf("reused_steps", optional, "earlier time steps whose differences iqn-ils keeps, default {}",
           whole(at(&P::quasi_newton, &QuasiNewton::reused_steps), 0, most_directions)),
      leaf("columns", optional, "differences that a quasi-Newton scheme keeps at most, default {}",
           whole(at(&P::quasi_newton, &QuasiNewton::columns), 1, most_directions)),
      leaf("filter", optional, "part of a difference that must be new for a quasi-Newton scheme to keep it, default {}",
           number(at(&P::quasi_newton, &QuasiNewton::filter), tolerance_or_none)),
      leaf("linear_solver", optional, "of the sub-problems: {}",
           name_from(at(&P::linear_solver), general_solver_names())),
  };
}

void read_fields(const CaseEntry& entry, OutputData& output) {
  output.fields.clear();
  for (const auto& element : entry.elements()) {
    require_name(element, output_field_names());
    const auto field = element.text();
    if (std::find(output.fields.begin(), output.fields.end(), field) != output.fields.end())
      element.refuse_value("is named twice", "name each field once");
    output.fields.push_back(field);
  }
}

/// Requires ascending times; check_output_times() in case_reader.cpp requires that they lie in the run.
void read_output_times(const CaseEntry& entry, OutputData& output) {
  output.times.clear();
  for (const CaseEntry& element : entry.elements()) {
    const double time = element.number(quantity::time());
    if (!output.times.empty() && !(time > output.times.back()))
      element.refuse(fmt::format("{} is not later than {}, the time before it", time, output.times.back()),
                     "give the times in ascending order");
    output.times.push_back(time);
  }
}

std::vector<CaseKey<OutputData>> output_keys() {
  const auto listed = [](const OutputData& output) { return fmt::format("{}", fmt::join(output.fields, ", ")); };
  std::vector<CaseKey<OutputData>> keys{
      leaf<OutputData>("fields", optional,
                       fmt::format("fields in fields.h5: any of {}; default {{}}", fmt::join(output_field_list, ", ")),
                       {read_fields, listed, listed(OutputData())}),
      leaf("every", optional, "steps between entries of fields.h5, default {}; 0: no fields",
           whole(at(&OutputData::every), 0, most_steps_between)),
      leaf("interval", optional,
           "time in {unit} between entries of fields.h5, in place of every: steps end there; with adaptive steps a "
           "twelfth of the run unless given",
           number(at(&OutputData::interval), positive, quantity::time())),
      leaf<OutputData>(
          "times", optional,
          "further times in {unit} at which steps end, whether equal or adaptive, and fields.h5 has entries, "
          "like [120, 133.5]",
          {read_output_times,
           [](const OutputData& output) { return fmt::format("[{}]", fmt::join(output.times, ", ")); }, "",
           quantity::time().unit}),
      leaf("checkpoint_every", optional,
           "steps between checkpoints; 0: none; unless given by time: at most 2 % of the run, at least each minute",
           whole(at(&OutputData::checkpoint_every), 0, most_steps_between)),
      leaf("checkpoint_seconds", optional,
           "age of the last checkpoint in seconds of real time at which the next is written, in place of that",
           number(at(&OutputData::checkpoint_seconds), not_negative)),
      leaf("energy", optional, "energy balance of each step in energy.csv, default {}", flag(at(&OutputData::energy))),
  };
  for (auto& key : derived_output_keys()) keys.push_back(std::move(key));
  for (auto& key : sample_keys()) keys.push_back(std::move(key));
  return keys;
}

std::vector<CaseKey<EconomyData>> economy_keys() {
  return {
      leaf("constant_operators", optional,
           "the mesh motion's operator, which never changes: {}; rebuilt: factorised at each use",
           name_from(at(&EconomyData::keep_constant_operators), constant_operator_modes())),
  };
}

/// A section with a default for everything in it.
template <class Data>
CaseKey<Case> default_section(const std::string& name, const std::string& about, const std::vector<CaseKey<Data>>& keys,
                              Data Case::*place) {
  return section<Data, Case>(
      name, optional, about, keys, [place](Case& scene) -> Data& { return scene.*place; },
      [place](const Case& scene) { return &(scene.*place); }, KeyRole::running);
}

}  // namespace

std::vector<CaseKey<Case>> solver_keys() {
  return {
      default_section("newton", "Newton's method of both drivers", newton_keys(), &Case::newton),
      section<Case, Case>(
          "linear", optional, "linear solvers of both drivers", linear_keys(),
          [](Case& scene) -> Case& { return scene; }, [](const Case& scene) { return &scene; }, KeyRole::running),
      default_section("monolithic", "for fsi-monolithic", monolithic_keys(), &Case::monolithic),
      default_section("partitioned", "for fsi-partitioned", partitioned_keys(), &Case::partitioned),
      petsc_section(),
      default_section("output", "what is written", output_keys(), &Case::output),
      default_section("economy", "savings to switch off, to see what they are worth", economy_keys(), &Case::economy),
  };
}

}  // namespace fsi
