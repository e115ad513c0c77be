#include "wall/wall_problem.hpp"

#include <algorithm>
#include <cmath>

#include "fem/elements.hpp"
#include "fem/facet_load.hpp"
#include "wall/layer_deformation.hpp"
#include "wall/maxwell_layers.hpp"
#include "wall/viscous_layers.hpp"
#include "wall/wall_assembly.hpp"
#include "wall/wall_energy.hpp"

namespace fsi {

namespace {

template <class Element, class Part>
double volume_of(const Part& part, const std::vector<int>& cells) {
  double volume = 0;
  for (int c : cells) {
    if (!part.counted.empty() && part.counted[c] == 0) continue;
    Vec3<Pack> x[Element::nodes];
    for (int a = 0; a < Element::nodes; ++a)
      for (int i = 0; i < 3; ++i) x[a][i] = Pack(part.nodes[part.cells[c][a]][i]);
    const auto geometry = Element::geometry(x);
    for (int q = 0; q < Element::points; ++q) volume += Element::at(geometry, q).weight[0];
  }
  return volume;
}

template <class Element, class Part>
LayerData measured_layer(const Part& part, const std::vector<int>& cells, const Material& material) {
  LayerData data{material, cells.size(), part.processes().sum(volume_of<Element>(part, cells)), {}, 0};
  for (int c : cells) data.nodes.insert(data.nodes.end(), part.cells[c].begin(), part.cells[c].end());
  std::sort(data.nodes.begin(), data.nodes.end());
  data.nodes.erase(std::unique(data.nodes.begin(), data.nodes.end()), data.nodes.end());
  return data;
}

/// Directions cos(alpha) t +- sin(alpha) z at another angle, in one lane.
void turn_fibres(Fibres& fibres, int lane, double from, double to) {
  for (int i = 0; i < 3; ++i) {
    const double first = fibres.direction[0][i][lane], second = fibres.direction[1][i][lane];
    const double around = std::cos(to) * (first + second) / (2 * std::cos(from));
    const double along = std::sin(to) * (first - second) / (2 * std::sin(from));
    fibres.direction[0][i].set(lane, around + along);
    fibres.direction[1][i].set(lane, around - along);
  }
}

}  // namespace

template <class Element>
WallProblem<Element>::WallProblem(Part part, const WallConstants& constants,
                                  const std::vector<std::pair<int, Material>>& layers, const CylinderAxis& axis,
                                  Facets pressurised, const FrameFields& frame)
    : part_(std::move(part)),
      constants_(constants),
      pressurised_(std::move(pressurised)),
      space_(function_space<Element>(part_)) {
  for (const auto& [region, material] : layers) {
    std::vector<int> cells;
    for (std::size_t c = 0; c < part_.cells.size(); ++c)
      if (part_.cell_region[c] == region) cells.push_back(static_cast<int>(c));
    layers_.push_back(
        {ElementPacks<Element>(part_.nodes, part_.cells, cells, *space_.graph(), part_.counted), material, {}, 0, {}});
    layer_cells_.push_back(cells);
    layer_data_.push_back(measured_layer<Element>(part_, cells, material));
    auto& layer = layers_.back();
    if (has_fibres(material))
      layer.fibres = frame.empty()
                         ? fibre_directions(layer.packs, part_.nodes, part_.cells, axis, fibre_angle(material))
                         : fibre_directions(layer.packs, frame, part_.cells, fibre_angle(material));
    if (std::holds_alternative<VaryingLaw>(layer.element_law())) {
      const LawHere everywhere{law_constants(material, constants_.bulk_modulus), fibre_angle(material)};
      set_constants(layers_.size() - 1, VaryingLaw(material, false),
                    [&](int, const Point&, double) { return everywhere; });
    }
  }
}

template <class Element>
void WallProblem<Element>::set_viscosity(std::size_t number, double viscosity) {
  auto& layer = layers_.at(number);
  layer.viscosity = viscosity;
  for (auto& of_thread : layer.constants)
    for (auto& of_pack : of_thread)
      for (auto& point : of_pack) point.viscosity = Pack(viscosity);
}

template <class Element>
void WallProblem<Element>::vary(std::size_t number, bool form_varies, const LawAt& at) {
  set_constants(number, VaryingLaw(layers_.at(number).material, form_varies), at);
}

template <class Element>
void WallProblem<Element>::set_constants(std::size_t number, const VaryingLaw& law, const LawAt& at) {
  WallLayer<Element>& layer = layers_.at(number);
  std::vector<int> index(part_.cells.size(), -1);
  std::vector<std::array<LawHere, Element::points>> of_cell;
  for (const int c : layer_cells_[number]) {
    index[static_cast<std::size_t>(c)] = static_cast<int>(of_cell.size());
    of_cell.emplace_back();
    Vec3<Pack> x[Element::nodes];
    for (int a = 0; a < Element::nodes; ++a)
      for (int i = 0; i < 3; ++i) x[a][i] = Pack(part_.nodes[part_.cells[c][a]][i]);
    const auto geometry = Element::geometry(x);
    for (int q = 0; q < Element::points; ++q) {
      const auto g = Element::at(geometry, q);
      Point place{0, 0, 0};
      for (int a = 0; a < Element::nodes; ++a)
        for (int i = 0; i < 3; ++i) place[i] += g.vectors().value[a] * x[a][i][0];
      of_cell.back()[q] = at(c, place, g.weight[0]);
    }
  }
  const bool fibres = !layer.fibres.empty();
  const double angle = fibre_angle(layer.material);
  layer.law = law;
  layer.constants.assign(static_cast<std::size_t>(layer.packs.thread_count()), {});
  for (int t = 0; t < layer.packs.thread_count(); ++t)
    for (std::size_t p = 0; p < layer.packs.of_thread(t).size(); ++p) {
      auto& points = layer.constants[t].emplace_back();
      const auto& pack = layer.packs.of_thread(t)[p];
      for (int q = 0; q < Element::points; ++q) {
        if (fibres) points[q].fibres = layer.fibres[t][p][q];
        for (int lane = 0; lane < pack_width; ++lane) {
          const LawHere& here = of_cell[static_cast<std::size_t>(index[pack.cell[lane]])][q];
          points[q].set(lane, here.constants);
          if (fibres && here.fibre_angle != angle) turn_fibres(points[q].fibres, lane, angle, here.fibre_angle);
        }
      }
    }
}

template <class Element>
void WallProblem<Element>::set_mean(std::size_t layer, const Material& material, double viscosity) {
  layers_.at(layer).material = layer_data_.at(layer).material = material;
  layers_.at(layer).viscosity = viscosity;
}

template <class Element>
AssemblyResult WallProblem<Element>::assemble(const WallInput& in, double pressure, const std::vector<double>& solution,
                                              std::vector<double>& residual, WallMatrix<n>* jacobian) {
  residual.assign(space_.mixed_size(), 0.0);
  if (finds_unloaded_shape_) return assemble_unloaded_shape(in, pressure, residual, jacobian);
  const auto result = assemble_wall(constants_, layers_, prestressed(in), residual, jacobian);
  if (pressure != 0) add_follower_pressure<Element>(part_.nodes, pressurised_, pressure, solution, residual, jacobian);
  if (this->supports()) this->supports()->add(in, residual, jacobian);
  if (is_viscous()) ViscousLayers<Element>::add(layers_, prestressed(in), residual, jacobian);
  if (places_.entries > 0) MaxwellLayers<Element>::add(layers_, places_, prestressed(in), residual, jacobian);
  return result;
}

template <class Element>
bool WallProblem<Element>::is_viscous() const {
  return places_.entries > 0 ||
         std::any_of(layers_.begin(), layers_.end(), [](const auto& layer) { return layer.viscosity > 0; });
}

template <class Element>
void WallProblem<Element>::set_branches(const std::vector<std::vector<MaxwellBranch>>& branches,
                                        const std::vector<std::int64_t>& whole_cell) {
  places_ = {};
  for (std::size_t i = 0; i < layers_.size(); ++i) {
    layers_[i].branches = branches.at(i);
    layer_data_[i].springs = 0;
    for (const auto& branch : branches[i]) layer_data_[i].springs += branch.shear;
    places_.branches = std::max(places_.branches, branches[i].size());
    if (!branches[i].empty()) places_.cells.insert(places_.cells.end(), layer_cells_[i].begin(), layer_cells_[i].end());
  }
  places_.entries = places_.branches * Element::points * 6;
  if (places_.entries == 0) return;
  std::sort(places_.cells.begin(), places_.cells.end());
  places_.place_of_cell.assign(part_.cells.size(), -1);
  for (const int cell : places_.cells) {
    places_.place_of_cell[cell] = static_cast<int>(places_.whole_cell.size());
    places_.whole_cell.push_back(whole_cell.empty() ? cell : whole_cell[cell]);
    places_.counted.push_back(part_.counted.empty() ? 1 : part_.counted[cell]);
  }
}

template <class Element>
std::vector<double> WallProblem<Element>::relaxed_branches(const std::vector<double>& wall) const {
  std::vector<double> branches(places_.size(), 0.0);
  WallInput in;
  in.wall = wall.data();
  settle_branches(in, branches);
  return branches;
}

template <class Element>
void WallProblem<Element>::settle_branches(const WallInput& in, std::vector<double>& branches) const {
  if (places_.size() > 0) MaxwellLayers<Element>::settle(layers_, places_, prestressed(in), branches.data());
}

template <class Element>
WallInput WallProblem<Element>::prestressed(WallInput in) const {
  if (!prestress_.empty()) in.prestress = prestress_.data();
  return in;
}

template <class Element>
AssemblyResult WallProblem<Element>::assemble_unloaded_shape(WallInput in, double pressure,
                                                             std::vector<double>& residual, WallMatrix<n>* jacobian) {
  WallMatrix<n> not_asked_for;
  if (!jacobian) not_asked_for = WallMatrix<n>(space_.graph());
  in.finds_unloaded_shape = true;
  std::vector<double> still;
  if (constants_.wave_speed > 0) {  // the stabilisation is then that of a wall with inertia
    still.assign(space_.vector_size(), 0.0);
    in.acceleration_history = still.data();
    in.acceleration_factor = 0;
  }
  const auto result = assemble_wall(constants_, layers_, in, residual, jacobian ? jacobian : &not_asked_for);
  // Loads act on the mesh: with displacements of zero, and no derivative.
  const std::vector<double> mesh(residual.size(), 0.0);
  if (pressure != 0)
    add_follower_pressure<Element>(part_.nodes, pressurised_, pressure, mesh.data(), residual, nullptr);
  WallInput loads;
  loads.wall = mesh.data();
  loads.support_loads = in.support_loads;
  if (this->supports()) this->supports()->add(loads, residual, nullptr);
  return result;
}

template <class Element>
void WallProblem<Element>::set_prestress(std::vector<double> displacement) {
  prestress_ = std::move(displacement);
  std::array<int, n> axes;
  std::copy_n(Element::axis, n, axes.begin());
  const std::vector<Point> unloaded = this->unloaded_nodes(axes);
  for (std::size_t i = 0; i < layers_.size(); ++i) {
    ElementPacks<Element> packs(unloaded, part_.cells, layer_cells_[i], *space_.graph(), part_.counted);
    packs.keep_sizes_of(layers_[i].packs);
    layers_[i].packs = std::move(packs);
  }
}

template <class Element>
WallEnergy WallProblem<Element>::energy(const std::vector<double>& wall, const std::vector<double>& velocity,
                                        const std::vector<double>& balance, const std::vector<double>& branches) const {
  WallEnergy energy = wall_energy(constants_, layers_, wall.data(), velocity.empty() ? nullptr : velocity.data(),
                                  balance.data(), prestress_.empty() ? nullptr : prestress_.data());
  if (branches.empty()) return energy;
  WallInput level;
  level.wall = wall.data();
  energy.branches = MaxwellLayers<Element>::stored(layers_, places_, prestressed(level), branches.data());
  return energy;
}

template <class Element>
WallWork WallProblem<Element>::work(const WallStep& step) const {
  WallStep here = step;
  here.balance = prestressed(step.balance);
  WallWork work = wall_work(constants_, layers_, here);
  if (is_viscous()) work.viscous = ViscousLayers<Element>::work(layers_, here);
  if (here.branches) {
    const MaxwellWork of_branches = MaxwellLayers<Element>::work(layers_, places_, here);
    work.viscous += of_branches.dissipated;
    work.stress += of_branches.beyond;
  }
  return work;
}

template <class Element>
std::vector<LayerDeformation> WallProblem<Element>::deformation(const std::vector<double>& wall) const {
  DeformationInput in;
  in.wall = wall.data();
  in.finds_unloaded_shape = finds_unloaded_shape_;
  if (!prestress_.empty() && !finds_unloaded_shape_) in.prestress = prestress_.data();
  std::vector<LayerDeformation> layers;
  for (const auto& layer : layers_) layers.push_back(layer_deformation<Element>(layer, part_, in));
  return worst_of_all(layers, part_.processes());
}

template <class Element>
double WallProblem<Element>::pressure_work(double pressure, const std::vector<double>& old,
                                           const std::vector<double>& now) const {
  if (pressure == 0) return 0;
  std::vector<double> load(now.size(), 0.0);
  add_follower_pressure<Element>(part_.nodes, pressurised_, pressure, now.data(), load, nullptr);
  double work = 0;
  for (std::size_t i = 0; i < load.size(); ++i)
    if (part_.owns(static_cast<int>(i / MixedLayout<n>::entries))) work -= load[i] * (now[i] - old[i]);
  return work;
}

template <class Element>
std::vector<int> WallProblem<Element>::cell_vertices() const {
  return vertices_of_cells(part_);
}

#define FSI_INSTANTIATE(Element) template class WallProblem<Element>;
FSI_FOR_EACH_ELEMENT(FSI_INSTANTIATE)
#undef FSI_INSTANTIATE

}  // namespace fsi
