#include "system/system.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <type_traits>
#include <utility>

#include "base/error.hpp"
#include "fem/dimensions.hpp"
#include "fem/function_space.hpp"
#include "parallel/stop_together.hpp"
#include "system/direct_linear_solver.hpp"
#include "system/step_change.hpp"

namespace fsi {

template <int n>
System<n>::System(std::string name, Scene<n>& scene, Numbering numbering, const LinearSolverFactory<n>& make_solver,
                  SystemNorm norm, const InterfaceImpedance* impedance)
    : name_(std::move(name)),
      scene_(scene),
      numbering_(std::move(numbering)),
      derivatives_(!numbering_.has_fluid()  ? FluidDerivatives::none
                   : !numbering_.has_mesh() ? FluidDerivatives::fluid
                                            : FluidDerivatives::fluid_and_domain),
      interface_(interface_pairs(scene)),
      mesh_tangent_(scene.nonlinear_mesh_motion && numbering_.has_mesh()
                        ? MeshMotionTangent<n>(scene.nonlinear_mesh_motion->graph())
                        : MeshMotionTangent<n>()),
      norm_(norm),
      impedance_(impedance),
      solver_(solver_by(make_solver)),
      increment_(numbering_.columns()),
      weights_(norm_weights()) {}

template <int n>
std::unique_ptr<LinearSolver> System<n>::solver_by(const LinearSolverFactory<n>& make_solver) {
  std::unique_ptr<LinearSolver> solver =
      make_solver ? make_solver(blocks()) : std::make_unique<DirectLinearSolver<n>>(blocks());
  if (!numbering_.has_fluid()) return solver;
  scene_.for_each_law(
      [&](const OpenBoundary<n>& open, const OutflowLaw&) { opening_terms_.push_back({&open.normals()}); });
  given_flows_ = GivenFlows<n>(scene_);
  for (std::size_t i = 0; i < given_flows_.count(); ++i)
    opening_terms_.push_back({&given_flows_.open(i).normals(), 0, nullptr, true, 0});
  if (opening_terms_.empty()) return solver;
  moving_terms_.resize(opening_terms_.size());
  auto with_terms = std::make_unique<LowRankLinearSolver<n>>(blocks(), std::move(solver), opening_terms_);
  with_terms_ = with_terms.get();
  return with_terms;
}

template <int n>
JacobianBlocks<n> System<n>::blocks() {
  JacobianBlocks<n> blocks{numbering_};
  if (numbering_.has_wall()) {
    blocks.wall = &scene_.wall->jacobian();
    blocks.wall_nodes = &scene_.wall->nodes();
  }
  if (numbering_.has_fluid()) {
    auto& jacobian = scene_.fluid->jacobian(derivatives_);
    blocks.fluid = &jacobian.fluid;
    if (numbering_.has_mesh()) blocks.shape_derivatives = &jacobian.shape_derivatives;
    blocks.fluid_nodes = &scene_.fluid->nodes();
  }
  if (numbering_.has_mesh()) {
    if (scene_.nonlinear_mesh_motion)
      blocks.mesh_tangent = &mesh_tangent_;
    else
      blocks.mesh_laplacian = &scene_.mesh_motion;
  }
  if (blocks.fluid && blocks.wall) blocks.interface = &interface_;
  if (!scene_.fluid_frames.empty()) blocks.fluid_frames = &scene_.fluid_frames;
  if (!scene_.wall_frames.empty()) blocks.wall_frames = &scene_.wall_frames;
  blocks.mesh_laplacian_version = &scene_.mesh_motion_assemblies;
  blocks.profile = &scene_.profile;
  return blocks;
}

template <int n>
void System<n>::work_on(State& state, const StepData& data) {
  state_ = &state;
  data_ = &data;
  if (numbering_.follow(data.rates.interface)) weights_ = norm_weights();
  if (rates_differ(data.rates)) usable_ = false;
}

template <int n>
double System<n>::evaluate() {
  if (numbering_.has_mesh()) scene_.renew_constant_operators();
  const auto phase = scene_.profile.phase("assembly: " + name_ + " residual");
  const AssemblyResult result = assemble(false);
  double sum = 0;
  for (double r : residual_) sum += r * r;
  if (const double forces = given_flows_.compare(*state_, *data_); processes().is_first()) sum += forces;
  // One number tells all: not a number where an element of any process is inverted.
  return std::sqrt(processes().sum(result.inverted() ? std::numeric_limits<double>::quiet_NaN() : sum));
}

template <int n>
void System<n>::linearise() {
  stop_together(processes());
  {
    const auto phase = scene_.profile.phase("assembly: " + name_ + " jacobian");
    assemble(true);
  }
  {
    const auto phase = scene_.profile.phase(std::string(solver_->preparation()) + ": " + name_);
    solver_->update();
  }
  point_.now = state_->now;
  point_.rates = data_->rates;
  point_.rates.wall_reference.clear();
  point_.wall_pressure = data_->wall_pressure;
  point_.support_loads = data_->support_loads;
  if (openings_move()) point_.opening_pressures = data_->opening_pressures;
  usable_ = true;
}

template <int n>
void System<n>::linearise_at(const LinearisationPoint& point) {
  State state;
  state.now = point.now;
  StepData data;
  data.rates = point.rates;
  data.wall_pressure = point.wall_pressure;
  if (!openings_move()) data.rates.windkessel_reference.clear();  // then no derivative depends on them
  std::size_t stores = 2 * given_flows_.count();
  scene_.for_each_law([&](const OpenBoundary<n>&, const OutflowLaw& law) { stores += law.stores() ? 1 : 0; });
  data.rates.windkessel_reference.resize(stores, 0.0);
  state.now.windkessel.resize(stores, 0.0);
  data.support_loads = point.support_loads;
  data.opening_pressures = point.opening_pressures;
  if (!point.rates.is_static() && scene_.wall)
    data.rates.acceleration_history.assign(scene_.wall->space().vector_size(), 0.0);
  work_on(state, data);
  linearise();
  state_ = nullptr;
  data_ = nullptr;
}

template <int n>
double System<n>::solve(double tolerance) {
  stop_together(processes());
  const auto phase = scene_.profile.phase("solve: " + name_);
  for (std::size_t i = 0; i < given_flows_.count(); ++i) opening_terms_[term_of(i)].gap = given_flows_.gap(i);
  linear_report_ = solver_->solve(residual_, tolerance, increment_);
  if (!linear_report_.converged) return std::numeric_limits<double>::quiet_NaN();
  flow_pressures_.clear();
  for (std::size_t i = 0; i < given_flows_.count(); ++i)
    flow_pressures_.push_back(-with_terms_->pressures()[term_of(i)]);
  increment_.resize(numbering_.columns());
  numbering_.update_copies(increment_);
  double sum = 0;
  for (std::size_t i = 0; i < increment_.size(); ++i) {
    increment_[i] = -increment_[i];
    if (i < weights_.size()) sum += weights_[i] * increment_[i] * increment_[i];
  }
  return std::sqrt(processes().sum(sum));
}

template <int n>
void System<n>::move(double step) {
  if (numbering_.has_mesh()) add_increment<Vector>(numbering_.mesh, scene_.fluid_frames, step, state_->now.mesh);
  if (numbering_.has_fluid()) add_increment<Mixed>(numbering_.fluid, scene_.fluid_frames, step, state_->now.fluid);
  if (numbering_.has_wall()) add_increment<Mixed>(numbering_.wall, scene_.wall_frames, step, state_->now.wall);
  for (std::size_t i = 0; i < given_flows_.count(); ++i)
    given_flows_.pressure(i, state_->now) += step * flow_pressures_[i];
}

template <int n>
template <class Layout>
void System<n>::add_increment(const UnknownMap& map, const NodalFrames<n>& frames, double step,
                              std::vector<double>& field) const {
  add_to_field(map, increment_, step, field);
  for (const int node : frames.nodes()) {  // in place of components of the frame, which that took for those of space
    Direction<n> turned{}, component{};
    for (int k = 0; k < n; ++k)
      if (const Unknown& unknown = map[Layout::vector(node, k)]; unknown.index >= 0)
        component[k] = turned[k] = step * unknown.factor * increment_[unknown.index];
    NodalFrames<n>::to_space(*frames.at(node), turned.data());
    for (int k = 0; k < n; ++k) field[Layout::vector(node, k)] += turned[k] - component[k];
  }
}

template <int n>
template <class Layout>
void System<n>::add_rows(const UnknownMap& map, const NodalFrames<n>& frames, const std::vector<double>& rows) {
  if (frames.empty()) {
    add_to_system(map, rows, residual_);
    return;
  }
  rows_ = rows;
  frames.template to_frames<Layout>(rows_);
  add_to_system(map, rows_, residual_);
}

template <int n>
double System<n>::size() const {
  return std::sqrt(processes().sum(weighted<Vector>(mesh_volumes_, state_->now.mesh, numbering_.has_mesh()) +
                                   weighted<Mixed>(fluid_volumes_, state_->now.fluid, numbering_.has_fluid()) +
                                   weighted<Mixed>(wall_volumes_, state_->now.wall, numbering_.has_wall())));
}

template <int n>
bool System<n>::negligible(double, double share) const {
  std::vector<double> sums;  // of each field of vectors and of scalars: squares of increment and size
  const auto measure = [&](const UnknownMap& map, const std::vector<double>& volumes, const std::vector<double>& field,
                           int entries) {
    for (const bool scalar : {false, true}) {
      double increment = 0, size = 0;
      for (std::size_t i = 0; i < map.size(); ++i) {
        if ((static_cast<int>(i % entries) == n) != scalar) continue;
        const double moved = map[i].index < 0 ? 0 : map[i].factor * increment_[map[i].index];
        increment += volumes[i / entries] * moved * moved;
        size += volumes[i / entries] * field[i] * field[i];
      }
      sums.insert(sums.end(), {increment, size});
    }
  };
  measure(numbering_.mesh, mesh_volumes_, state_->now.mesh, Vector::entries);
  measure(numbering_.fluid, fluid_volumes_, state_->now.fluid, Mixed::entries);
  if (numbering_.has_wall())
    measure(numbering_.wall, wall_volumes_, scene_.wall->from_unloaded(state_->now.wall), Mixed::entries);
  processes().sum(sums);
  for (std::size_t i = 0; i < sums.size(); i += 2)
    if (sums[i] > share * share * sums[i + 1]) return false;
  return true;
}

template <int n>
double System<n>::relative_increment() const {
  const auto moved = [&](const UnknownMap& map) {
    std::vector<double> field(map.size());
    for (std::size_t i = 0; i < map.size(); ++i)
      if (map[i].index >= 0) field[i] = map[i].factor * increment_[map[i].index];
    return field;
  };
  const std::vector<double> fluid = moved(numbering_.fluid), wall = moved(numbering_.wall);
  return relative_to_step<n>(*state_, *data_, {fluid_volumes_, fluid}, {wall_volumes_, wall}, processes());
}

template <int n>
double System<n>::rounding() {
  std::vector<double> x(numbering_.columns(), 0.0), terms(static_cast<std::size_t>(numbering_.size), 0.0);
  // At nodes with a frame the components of space will do: as large as those of the frame but for a factor near one.
  const auto values = [&](const UnknownMap& map, const std::vector<double>& field) {
    for (std::size_t i = 0; i < map.size(); ++i)
      if (map[i].index >= 0) x[map[i].index] = std::max(x[map[i].index], std::abs(field[i] / map[i].factor));
  };
  values(numbering_.mesh, state_->now.mesh);
  values(numbering_.fluid, state_->now.fluid);
  if (numbering_.has_wall()) values(numbering_.wall, scene_.wall->from_unloaded(state_->now.wall));
  const double forces = add_absolute_products(x, terms);
  double sum = processes().is_first() ? forces : 0;
  for (double t : terms) sum += t * t;
  return std::numeric_limits<double>::epsilon() * std::sqrt(processes().sum(sum));
}

template <int n>
std::vector<InterfacePair> System<n>::interface_pairs(const Scene<n>& scene) {
  std::vector<InterfacePair> pairs;
  for (const auto& node : scene.interface) pairs.push_back({node.fluid, node.wall});
  return pairs;
}

template <int n>
AssemblyResult System<n>::assemble(bool derivatives) {
  AssemblyResult result;
  residual_.assign(static_cast<std::size_t>(numbering_.size), 0.0);
  if (numbering_.has_mesh()) {
    mesh_residual_.resize(state_->now.mesh.size());
    if (scene_.nonlinear_mesh_motion) {
      result.include(scene_.nonlinear_mesh_motion->assemble(state_->now.mesh, mesh_residual_,
                                                            derivatives ? &mesh_tangent_ : nullptr));
      if (derivatives) scene_.fluid_frames.turn_blocks(mesh_tangent_);
    } else {
      multiply_mesh_motion<n>(scene_.mesh_motion, state_->now.mesh, mesh_residual_);
    }
    add_rows<Vector>(numbering_.mesh_rows, scene_.fluid_frames, mesh_residual_);
  }
  if (numbering_.has_fluid()) {
    assert(scene_.fluid);
    result.include(scene_.fluid->assemble(scene_.fluid_input(*state_, data_->rates), data_->opening_pressures,
                                          fluid_residual_, derivatives ? derivatives_ : FluidDerivatives::none));
    add_rows<Mixed>(numbering_.fluid_rows, scene_.fluid_frames, fluid_residual_);
    if (derivatives) {
      auto& jacobian = scene_.fluid->jacobian(derivatives_);
      scene_.fluid_frames.turn_blocks(jacobian.fluid);
      if (derivatives_ == FluidDerivatives::fluid_and_domain)
        scene_.fluid_frames.turn_blocks(jacobian.shape_derivatives);
    }
    if (derivatives) linearise_openings();
    if (impedance_) add_impedance(derivatives);
  }
  if (numbering_.has_wall()) {
    assert(scene_.wall);
    result.include(scene_.wall->assemble(scene_.wall_input(state_->now, *data_), data_->wall_pressure, state_->now.wall,
                                         wall_residual_, derivatives));
    if (!data_->interface_load.empty())
      for (std::size_t i = 0; i < wall_residual_.size(); ++i) wall_residual_[i] += data_->interface_load[i];
    add_rows<Mixed>(numbering_.wall_rows, scene_.wall_frames, wall_residual_);
    if (derivatives) scene_.wall_frames.turn_blocks(scene_.wall->jacobian());
  }
  return result;
}

template <int n>
bool System<n>::openings_move() const {
  if (numbering_.fluid_rows.empty()) return false;
  const auto& open = scene_.fluid->open_boundaries();
  return std::any_of(open.begin(), open.end(), [](const auto& boundary) { return boundary.moving() != nullptr; });
}

template <int n>
void System<n>::linearise_openings() {
  const FluidInput in = scene_.fluid_input(*state_, data_->rates);
  const auto linearise_flow = [&](const MovingSurface<n>& surface, std::size_t place) {
    OpeningTerm& term = opening_terms_[place];
    MovingTerm& moving = moving_terms_[place];
    moving.normals = surface.normals(in.mesh);
    term.normals = &moving.normals;
    if (numbering_.mesh.empty()) return;
    moving.by_mesh = surface.relative_outflow_slope(in);
    term.by_mesh = &moving.by_mesh;
  };
  std::size_t place = 0;
  scene_.for_each_law([&](const OpenBoundary<n>& open, const OutflowLaw& law) {
    opening_terms_[place].slope = law.slope(in.fluid_factor);
    if (open.moving()) linearise_flow(*open.moving(), place);
    ++place;
  });
  for (std::size_t i = 0; i < given_flows_.count(); ++i) linearise_flow(*given_flows_.open(i).moving(), term_of(i));
}

template <int n>
std::vector<double> System<n>::flow_gaps() const {
  std::vector<double> gaps;
  for (std::size_t i = 0; i < given_flows_.count(); ++i) gaps.push_back(given_flows_.gap(i));
  return gaps;
}

template <int n>
void System<n>::add_impedance(bool derivatives) {
  assert(impedance_->velocity.size() == impedance_->nodes.size() * n);
  for (std::size_t i = 0; i < impedance_->nodes.size(); ++i) {
    const int node = impedance_->nodes[i];
    const double c = impedance_->impedance[i];
    Direction<n> slip;
    for (int k = 0; k < n; ++k) slip[k] = state_->now.fluid[Mixed::vector(node, k)] - impedance_->velocity[i * n + k];
    if (const auto* axes = scene_.fluid_frames.at(node)) NodalFrames<n>::to_frame(*axes, slip.data());
    for (int k = 0; k < n; ++k) {
      const std::size_t entry = Mixed::vector(node, k);
      const Unknown& row = numbering_.fluid_rows[entry];
      if (row.index < 0) continue;
      residual_[row.index] += row.factor * c * slip[k];
      if (!derivatives) continue;
      auto& fluid = scene_.fluid->jacobian(derivatives_).fluid;
      fluid.block(fluid.graph->find(node, node))[k * Mixed::entries + k] += c;
    }
  }
}

template <int n>
double System<n>::add_absolute_products(const std::vector<double>& x, std::vector<double>& terms) {
  const JacobianBlocks<n> j = blocks();
  const auto add = [&](const auto& matrix, const UnknownMap& rows, const UnknownMap& columns, bool by_component) {
    constexpr int r = std::decay_t<decltype(matrix)>::rows, c = std::decay_t<decltype(matrix)>::columns;
    const auto& graph = *matrix.graph;
    const int rows_per_node = by_component ? c : r;
    for (int a = 0; a < graph.rows(); ++a)
      for (int at = graph.offsets[a]; at < graph.offsets[a + 1]; ++at)
        for (int i = 0; i < rows_per_node; ++i) {
          const Unknown& row = rows[static_cast<std::size_t>(a) * rows_per_node + i];
          if (row.index < 0) continue;
          double sum = 0;
          for (int k = by_component ? i : 0; k < (by_component ? i + 1 : c); ++k) {
            const Unknown& column = columns[static_cast<std::size_t>(graph.columns[at]) * c + k];
            const double value = matrix.block(at)[by_component ? k : i * c + k];
            if (column.index >= 0) sum += std::abs(value * column.factor) * x[column.index];
          }
          terms[row.index] += std::abs(row.factor) * sum;
        }
  };
  if (j.wall) add(*j.wall, numbering_.wall_rows, numbering_.wall, false);
  if (j.fluid) add(*j.fluid, numbering_.fluid_rows, numbering_.fluid, false);
  if (j.shape_derivatives) add(*j.shape_derivatives, numbering_.fluid_rows, numbering_.mesh, false);
  if (j.mesh_tangent) add(*j.mesh_tangent, numbering_.mesh_rows, numbering_.mesh, false);
  if (j.mesh_laplacian) add(*j.mesh_laplacian, numbering_.mesh_rows, numbering_.mesh, true);
  std::size_t given = 0;
  double forces = 0;
  for (const OpeningTerm& term : opening_terms_) {
    const auto &normals = term.normals, &by_mesh = term.by_mesh;
    double flow = 0;
    for (std::size_t i = 0; by_mesh && i < by_mesh->size(); ++i)
      if (const Unknown& column = numbering_.mesh[i]; column.index >= 0)
        flow += std::abs((*by_mesh)[i] * column.factor) * x[column.index];
    for (std::size_t i = 0; i < normals->size(); ++i)
      if (const Unknown& column = numbering_.fluid[i]; column.index >= 0)
        flow += std::abs((*normals)[i] * column.factor) * x[column.index];
    flow = processes().sum(flow);
    double pressure = term.slope * flow;
    if (term.given) {
      pressure = std::abs(given_flows_.pressure(given, state_->now));
      forces += std::pow(given_flows_.force_of_gap(given, data_->rates.fluid_factor) * flow, 2);
      ++given;
    }
    for (std::size_t i = 0; i < normals->size(); ++i)
      if (const Unknown& row = numbering_.fluid_rows[i]; row.index >= 0)
        terms[row.index] += std::abs((*normals)[i] * row.factor) * pressure;
  }
  return forces;
}

template <int n>
std::vector<double> System<n>::norm_weights() {
  std::vector<double> weights(static_cast<std::size_t>(numbering_.size), 0.0);
  const auto add = [&](const UnknownMap& map, const std::vector<double>& volumes, int entries) {
    for (std::size_t i = 0; i < map.size(); ++i)
      if (map[i].index >= 0 && map[i].index < numbering_.size)
        weights[map[i].index] += map[i].factor * map[i].factor * volumes[i / entries];
  };
  const auto weights_of = [&](const FunctionSpace<n>& space, const PartNodes& part) {
    std::vector<double> of_nodes =
        norm_ == SystemNorm::volumes ? space.volumes() : std::vector<double>(space.volumes().size(), 1.0);
    for (int a = 0; part.share && a < part.node_count(); ++a)
      if (!part.owns(a)) of_nodes[a] = 0;  // others count it
    return of_nodes;
  };
  if ((numbering_.has_fluid() || numbering_.has_mesh()) && fluid_volumes_.empty())
    mesh_volumes_ = fluid_volumes_ = weights_of(scene_.fluid->space(), scene_.fluid->nodes());
  if (numbering_.has_wall() && wall_volumes_.empty())
    wall_volumes_ = weights_of(scene_.wall->space(), scene_.wall->nodes());
  add(numbering_.mesh, mesh_volumes_, Vector::entries);
  add(numbering_.fluid, fluid_volumes_, Mixed::entries);
  add(numbering_.wall, wall_volumes_, Mixed::entries);
  return weights;
}

template <int n>
bool System<n>::rates_differ(const StepRates& rates) const {
  const StepRates& of_jacobian = point_.rates;
  return rates.step != of_jacobian.step || rates.interface.period != of_jacobian.interface.period ||
         rates.fluid_factor != of_jacobian.fluid_factor || rates.acceleration_factor != of_jacobian.acceleration_factor;
}

#define FSI_INSTANTIATE(n) template class System<n>;
FSI_FOR_EACH_DIMENSION(FSI_INSTANTIATE)

}  // namespace fsi
