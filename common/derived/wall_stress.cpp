#include "derived/wall_stress.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <optional>
#include <type_traits>
#include <utility>

#include "derived/gradient_recovery.hpp"
#include "derived/recovery_mirrors.hpp"
#include "fem/elements.hpp"
#include "mesh/point_math.hpp"
#include "wall/varying_hyperelastic.hpp"
#include "wall/wall_problem.hpp"

namespace fsi {

namespace {

/// The integrand of the wall's weak form at a point of every lane: the first Piola-Kirchhoff stress P in kPa as flux,
/// and the volume condition -g - p / kappa as scalar source.
/// \param fibres  Fibres, or PointConstants for a VaryingLaw
template <class Law, class Point>
auto at_point_of(const Law& law, double bulk_modulus, const Mat3<Pack>& grad_d, const Pack& pressure,
                 const Point& fibres) {
  const Vec3<Pack> none{{Pack(0.0), Pack(0.0), Pack(0.0)}};
  const Hyperelastic<Law> form{0.0, bulk_modulus, 0.0, law};
  const auto prepared = form.prepare(grad_d, none, Unstabilised{});
  if constexpr (Hyperelastic<Law>::has_fibres) {
    return form.integrand(prepared, none, pressure, fibres);
  } else {
    static_cast<void>(fibres);
    return form.integrand(prepared, none, pressure, {});
  }
}

/// Bulk modulus over shear modulus above which a law counts as nearly incompressible: Poisson's ratio of 0.49.
constexpr double nearly_incompressible = 50;
constexpr int volume_steps = 3;

/// Corrects a gradient to fulfil the volume condition g(F) + p / kappa = 0 of the weak form, in the direction J F^-T U
/// with U the recovery's error directions: of all changes that do so to first order the likeliest (docs/theory.md,
/// section 11a.3). By the secant method; a lane that comes no nearer keeps its gradient, as where U is zero.
/// \param missing  missing(gradient): -g - p / kappa
/// \param where    lanes that are nearly incompressible
template <class Missing>
void keep_volume(const Missing& missing, const Mat3<Pack>& error_directions, Pack::Mask where, Mat3<Pack>& grad_d) {
  const Mat3<Pack> cofactors = deformation(grad_d).cofactor_gradient, way = cofactors * error_directions;
  const auto moved = [&](const Pack& by) { return grad_d + by * way; };
  const Pack first = missing(grad_d);
  Pack slope = Pack(-1.0) * contract(cofactors, way), by = Pack(0.0), left = first;
  for (int step = 0; step < volume_steps; ++step) {
    const Pack next = by - left / slope, of_next = missing(moved(next));
    const Pack::Mask changes = (left * left > Pack(0.0)) & ((of_next - left) * (of_next - left) > Pack(0.0));
    slope = select(changes, (of_next - left) / (next - by), slope);
    by = select(changes, next, by);
    left = select(changes, of_next, left);
  }
  const Pack::Mask nearer = where & (first * first > left * left);
  grad_d = moved(select(nearer, by, Pack(0.0)));
}

/// A node in a layer, whose stress is found.
struct StressNode {
  std::array<int, 2> ends;  ///< of its edge, where it lies in the middle of one; else the node itself, twice
  int place;                ///< of its stress
};

/// A layer: its nodes with recovered gradients, and the fibres there.
struct StressLayer {
  ElementLaw law;
  double bulk_modulus;  ///< kPa
  GradientRecovery gradients;
  std::vector<StressNode> nodes;  ///< per entry of gradients.nodes()
  bool has_fibres;
  std::vector<std::array<Vec3<double>, 2>> fibres;  ///< per entry of gradients.nodes(), unit length; or empty
  std::vector<LawConstants<double>> constants{};    ///< at the same nodes, of a law whose constants vary; or empty
  std::vector<Mat3<double>>
      to_unloaded{};  ///< (d unloaded / d mesh position)^-T at the same nodes; empty: no prestress
};

/// Calls visit(thread, index of the pack, point, lane, node, weight) for the nodes a of all elements at their
/// quadrature points, weight being N_a^2 of the point: in one order, whatever the threads.
template <class Element, class Visit>
void for_each_weight(const ElementPacks<Element>& all, Visit visit) {
  std::map<int, std::pair<int, std::size_t>> packs;  // by number
  for (int t = 0; t < all.thread_count(); ++t)
    for (std::size_t i = 0; i < all.of_thread(t).size(); ++i)
      packs.emplace(all.of_thread(t)[i].number, std::pair(t, i));
  for (const auto& [number, where] : packs) {
    const auto& pack = all.of_thread(where.first)[where.second];
    for (int q = 0; q < Element::points; ++q) {
      const auto g = Element::at(pack.geometry, q);
      for (int lane = 0; lane < pack.filled; ++lane)
        for (int a = 0; a < Element::nodes; ++a)
          visit(where.first, where.second, q, lane, pack.node[a][lane],
                g.weight[lane] * g.vectors().value[a] * g.vectors().value[a]);
    }
  }
}

/// Fibre directions at nodes: the mean of those at the quadrature points around them, weighted by N_a^2.
template <class Element>
std::vector<std::array<Vec3<double>, 2>> nodal_fibres(const WallLayer<Element>& layer, const std::vector<int>& nodes,
                                                      int node_count) {
  std::vector<std::array<Vec3<double>, 2>> sums(static_cast<std::size_t>(node_count));
  for (auto& sum : sums) sum = {};
  for_each_weight(layer.packs, [&](int t, std::size_t i, int q, int lane, int node, double weight) {
    const Fibres& fibres = layer.varies() ? layer.constants[t][i][q].fibres : layer.fibres[t][i][q];
    for (int family = 0; family < 2; ++family)
      for (int k = 0; k < 3; ++k) sums[node][family][k] += weight * fibres.direction[family][k][lane];
  });
  std::vector<std::array<Vec3<double>, 2>> directions;
  for (const int node : nodes) {
    auto direction = sums[node];
    for (auto& a : direction) a = (1 / std::sqrt(dot(a, a))) * a;
    directions.push_back(direction);
  }
  return directions;
}

/// Constants that vary, at nodes: means as for nodal_fibres().
template <class Element>
std::vector<LawConstants<double>> nodal_constants(const WallLayer<Element>& layer, const std::vector<int>& nodes,
                                                  int node_count) {
  std::vector<LawConstants<double>> sums(static_cast<std::size_t>(node_count));
  std::vector<double> weights(static_cast<std::size_t>(node_count), 0.0);
  for_each_weight(layer.packs, [&](int t, std::size_t i, int q, int lane, int node, double weight) {
    const PointConstants& here = layer.constants[t][i][q];
    LawConstants<double>& sum = sums[node];
    for (std::size_t k = 0; k < sum.of_law.size(); ++k) sum.of_law[k] += weight * here.of_law[k][lane];
    sum.shear_modulus += weight * here.shear_modulus[lane];
    sum.bulk_modulus += weight * here.bulk_modulus[lane];
    weights[node] += weight;
  });
  std::vector<LawConstants<double>> means;
  for (const int node : nodes) {
    means.push_back(sums[node]);
    for (double& constant : means.back().of_law) constant /= weights[node];
    means.back().shear_modulus /= weights[node];
    means.back().bulk_modulus /= weights[node];
  }
  return means;
}

template <class Element>
class WallStressOf : public WallStress<Element::components> {
 public:
  static constexpr int n = Element::components;
  using Mixed = MixedLayout<n>;

  WallStressOf(const Case& setup, const MeshOf<Element>& mesh, const Scene<n>& scene, const WholeParts<Element>& whole)
      : wall_(*scene.wall), node_count_(scene.wall->node_count()) {
    const auto& problem = static_cast<const WallProblem<Element>&>(*scene.wall);
    const PartRestriction* here = whole.wall_here.get();
    const auto& part = whole.wall ? *whole.wall : problem.part();
    const bool prestressed = scene.processes().any(!wall_.prestress().empty());
    share_.assign(static_cast<std::size_t>(node_count_), 0.0);
    fibre_share_ = share_;
    std::size_t index = 0;
    for (const auto& [name, data] : setup.structure->layers) {
      const WallLayer<Element>& layer = problem.layers()[index++];
      RecoveryCells cells{part.nodes,
                          {},
                          Element::nodes,
                          Element::order,
                          {std::begin(Element::axis), std::end(Element::axis)},
                          Element::axisymmetric};
      std::map<int, std::array<int, 2>> ends;  // of nodes
      bool curved = false;
      const int region = mesh.region_index(name);
      for (std::size_t c = 0; c < part.cells.size(); ++c) {
        if (part.cell_region[c] != region) continue;
        const auto& cell = part.cells[c];
        cells.nodes.insert(cells.nodes.end(), cell.begin(), cell.end());
        for (int a = 0; a < Element::nodes; ++a) ends[cell[a]] = ends_of(cell, a);
        curved = curved || has_curved_edges(part.nodes, cell);
      }
      cells.mirrors = recovery_mirrors<Element>(mesh, part, cells.nodes);
      // Flat facets do not determine the curvature of an irregular surface (docs/theory.md, section 11a.1).
      cells.along_boundaries = curved;
      std::vector<int> at;
      for (const auto& [node, of_node] : ends)
        if (!here || here->owns_whole(node)) at.push_back(node);
      StressLayer stress{layer.element_law(),
                         bulk_modulus(layer.material, scene.wall->constants().bulk_modulus),
                         GradientRecovery(cells, at),
                         {},
                         fsi::has_fibres(layer.material),
                         {}};
      if (here) stress.gradients.restrict_to(*here);
      for (std::size_t i = 0; i < at.size(); ++i) {
        auto of_node = ends.at(at[i]);
        if (here)
          for (int& end : of_node) end = here->local(end);
        const int place = take_place(stress.gradients.nodes()[i], of_node);
        stress.nodes.push_back({of_node, place});
        ++share_[place];
        if (stress.has_fibres) ++fibre_share_[place];
      }
      if (stress.has_fibres) stress.fibres = nodal_fibres(layer, stress.gradients.nodes(), node_count_);
      if (prestressed) stress.to_unloaded = to_unloaded(stress.gradients);
      if (layer.varies()) stress.constants = nodal_constants(layer, stress.gradients.nodes(), node_count_);
      layers_.push_back(std::move(stress));
    }
    for (auto* shares : {&share_, &fibre_share_})
      for (double& share : *shares) share = share > 0 ? 1 / share : 0;
  }

  bool has_fibres() const override {
    return std::any_of(layers_.begin(), layers_.end(), [](const auto& layer) { return layer.has_fibres; });
  }

  int place_of_middle(int node, std::array<int, 2> ends) const override {
    std::sort(ends.begin(), ends.end());
    const auto found = of_middles_.find({node, ends});
    return found == of_middles_.end() ? node : found->second;
  }

  WallStresses of(const std::vector<double>& now) const override {
    const std::vector<double> wall = wall_.from_unloaded(now);  // with prestress from another shape than the mesh's
    WallStresses all;
    all.cauchy.assign(share_.size(), Mat3<double>{});
    if (has_fibres())
      for (auto& family : all.of_fibres) family.assign(share_.size(), 0.0);
    std::vector<double> buffer;
    for (const auto& layer : layers_) {
      const auto& reached = layer.gradients.template reach<Mixed>(wall, buffer);
      std::visit([&](const auto& law) { add(law, layer, reached, all); }, layer.law);
    }
    if (wall_.nodes().share) update_ghosts(all);
    return all;
  }

 private:
  /// Whether a mid-edge node is off the middle of its edge: not in linear nor in straight-edged quadratic cells.
  template <class Cell>
  static bool has_curved_edges(const std::vector<Point>& nodes, const Cell& cell) {
    constexpr double least = 1e-3;  // of the edge: half a degree
    for (int a = Element::dim + 1; a < Element::nodes; ++a) {
      const auto [first, second] = ends_of(cell, a);
      const Point middle = 0.5 * (nodes[first] + nodes[second]);
      if (distance(nodes[cell[a]], middle) > least * distance(nodes[first], nodes[second])) return true;
    }
    return false;
  }

  /// The ends of a mid-edge node's edge, ascending; of a vertex that vertex, twice.
  template <class Cell>
  static std::array<int, 2> ends_of(const Cell& cell, int a) {
    if (a <= Element::dim) return {cell[a], cell[a]};
    const auto& edge = SimplexEdges<Element::dim>::vertices[a - Element::dim - 1];
    const auto [first, second] = std::minmax(cell[edge[0]], cell[edge[1]]);
    return {first, second};
  }

  /// The place of a node's stress: the node itself, unless another layer has it with other ends.
  int take_place(int node, std::array<int, 2> ends) {
    std::sort(ends.begin(), ends.end());
    const auto [known, is_new] = of_middles_.try_emplace({node, ends}, node);
    if (is_new && share_[node] > 0) {
      known->second = static_cast<int>(share_.size());
      share_.push_back(0);
      fibre_share_.push_back(0);
    }
    return known->second;
  }

  /// Gradients are recovered on the mesh: nodes without load, which a discrete problem has found, are less even than those
  /// of the mesh by as much as thin layers have between them.
  std::vector<Mat3<double>> to_unloaded(const GradientRecovery& gradients) const {
    const auto entries = static_cast<std::size_t>(node_count_) * Mixed::entries;
    const std::vector<double> prestress = wall_.from_unloaded(std::vector<double>(entries, 0.0));
    std::vector<double> buffer;
    const auto& reached = gradients.template reach<Mixed>(prestress, buffer);
    std::vector<Mat3<double>> found;
    for (std::size_t i = 0; i < gradients.size(); ++i) {
      Mat3<double> unloaded{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
      const Mat3<double> way = gradients.template gradient<Mixed>(i, reached);
      for (int r = 0; r < 3; ++r)
        for (int c = 0; c < 3; ++c) unloaded(r, c) -= way(r, c);
      const Mat3<double> cofactors = cofactor(unloaded);
      double volume = 0;
      for (int c = 0; c < 3; ++c) volume += unloaded(0, c) * cofactors(0, c);
      found.push_back((1 / volume) * cofactors);
    }
    return found;
  }

  void update_ghosts(WallStresses& all) const {
    const Exchange& exchange = wall_.nodes().share->exchange;
    std::vector<double> numbers;
    numbers.reserve(9 * all.cauchy.size());
    for (const auto& stress : all.cauchy)
      for (int i = 0; i < 9; ++i) numbers.push_back(stress(i / 3, i % 3));
    exchange.update(numbers, 9);  // nodes alone: places behind them belong to this process
    for (std::size_t i = 0; i < numbers.size(); ++i)
      all.cauchy[i / 9](static_cast<int>(i % 9) / 3, static_cast<int>(i % 9) % 3) = numbers[i];
    for (auto& family : all.of_fibres)
      if (has_fibres()) exchange.update(family);
  }

  /// kappa / mu at entry i of the layer's nodes.
  template <class Law>
  static double volume_to_shear(const Law& law, const StressLayer& layer, std::size_t i) {
    if constexpr (std::is_same_v<Law, VaryingLaw>)
      return layer.constants[i].bulk_modulus / layer.constants[i].shear_modulus;
    else
      return layer.bulk_modulus / law.shear_modulus();
  }

  /// Constants at `filled` nodes from `first` on, one per lane; other lanes repeat the last.
  static PointConstants constants_at(const StressLayer& layer, std::size_t first, std::size_t filled,
                                     const Fibres& fibres) {
    PointConstants at;
    for (std::size_t lane = 0; lane < pack_width; ++lane)
      at.set(static_cast<int>(lane), layer.constants[first + std::min(lane, filled - 1)]);
    at.fibres = fibres;
    return at;
  }

  template <class Law>
  void add(const Law& law, const StressLayer& layer, const std::vector<double>& wall, WallStresses& all) const {
    const auto& nodes = layer.gradients.nodes();
    for (std::size_t first = 0; first < nodes.size(); first += pack_width) {
      const std::size_t filled = std::min<std::size_t>(pack_width, nodes.size() - first);
      Mat3<Pack> grad_d, error_directions;
      Pack pressure(0.0), stiffness_ratio(0.0);
      Fibres fibres;
      for (std::size_t lane = 0; lane < pack_width; ++lane) {
        const std::size_t i = first + std::min(lane, filled - 1);
        const auto l = static_cast<int>(lane);
        auto h = layer.gradients.gradient<Mixed>(i, wall);
        if (!layer.to_unloaded.empty()) h = times_transposed(h, layer.to_unloaded[i]);
        for (int r = 0; r < 3; ++r)
          for (int c = 0; c < 3; ++c) {
            grad_d(r, c).set(l, h(r, c));
            error_directions(r, c).set(l, layer.gradients.error_directions(i)(r, c));
          }
        const auto& ends = layer.nodes[i].ends;
        pressure.set(l, 0.5 * (wall[Mixed::scalar(ends[0])] + wall[Mixed::scalar(ends[1])]));
        stiffness_ratio.set(l, volume_to_shear(law, layer, i));
        for (int family = 0; family < 2; ++family)
          for (int k = 0; k < 3; ++k)
            fibres.direction[family][k].set(l, layer.fibres.empty() ? 0.0 : layer.fibres[i][family][k]);
      }
      const auto at_point = [&](const Mat3<Pack>& gradient) {
        if constexpr (std::is_same_v<Law, VaryingLaw>)
          return at_point_of(law, layer.bulk_modulus, gradient, pressure, constants_at(layer, first, filled, fibres));
        else
          return at_point_of(law, layer.bulk_modulus, gradient, pressure, fibres);
      };
      keep_volume([&](const Mat3<Pack>& gradient) { return at_point(gradient).scalar_source; }, error_directions,
                  stiffness_ratio > Pack(nearly_incompressible), grad_d);
      const Mat3<Pack> piola = at_point(grad_d).flux;
      const Deformation<Pack> f = deformation(grad_d);
      Mat3<Pack> cauchy = (Pack(1.0) / f.volume_ratio) * times_transposed(piola, f.gradient);
      if constexpr (Hyperelastic<Law>::is_compressible)
        if (law.on_reference()) cauchy = piola;  // small strains: one stress for both configurations
      for (std::size_t lane = 0; lane < filled; ++lane) {
        const auto l = static_cast<int>(lane);
        const int place = layer.nodes[first + lane].place;
        Mat3<double> sigma;
        for (int r = 0; r < 3; ++r)  // symmetric but for rounding
          for (int c = 0; c < 3; ++c) sigma(r, c) = 0.5 * (cauchy(r, c)[l] + cauchy(c, r)[l]);
        all.cauchy[place] = all.cauchy[place] + share_[place] * sigma;
        if (layer.fibres.empty()) continue;
        for (std::size_t family = 0; family < 2; ++family) {
          Vec3<double> a{};
          for (int r = 0; r < 3; ++r)
            for (int c = 0; c < 3; ++c) a[r] += f.gradient(r, c)[l] * layer.fibres[first + lane][family][c];
          all.of_fibres[family][place] += fibre_share_[place] * dot(a, sigma * a) / dot(a, a);
        }
      }
    }
  }

  const Wall<n>& wall_;
  int node_count_;
  std::vector<StressLayer> layers_;
  std::map<std::pair<int, std::array<int, 2>>, int> of_middles_;  ///< places by node and ends, ascending
  std::vector<double> share_;                                     ///< per place: one over the layers that have it
  std::vector<double> fibre_share_;                               ///< likewise over those with fibres
};

}  // namespace

template <class Element>
std::unique_ptr<WallStress<Element::components>> make_wall_stress(const Case& setup, const MeshOf<Element>& mesh,
                                                                  const Scene<Element::components>& scene,
                                                                  const WholeParts<Element>& whole) {
  return std::make_unique<WallStressOf<Element>>(setup, mesh, scene, whole);
}

#define FSI_INSTANTIATE(Element)                                                       \
  template std::unique_ptr<WallStress<Element::components>> make_wall_stress<Element>( \
      const Case&, const MeshOf<Element>&, const Scene<Element::components>&, const WholeParts<Element>&);
FSI_FOR_EACH_ELEMENT(FSI_INSTANTIATE)
#undef FSI_INSTANTIATE

}  // namespace fsi
