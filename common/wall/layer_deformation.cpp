#include "wall/layer_deformation.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <type_traits>
#include <variant>

#include "fem/elements.hpp"
#include "fem/field_gradients.hpp"
#include "math/kinematics.hpp"
#include "mesh/curved_cells.hpp"

namespace fsi {

namespace {

/// A value at a quadrature point of a cell; cell -1: nowhere.
struct PointValue {
  double value = 0;
  int cell = -1, point = 0;
};

/// NaN is less than all, and stays.
void take_less(double value, int cell, int point, PointValue& least) {
  if (std::isnan(least.value) || value >= least.value) return;
  least = {value, cell, point};
}
void take_greater(double value, int cell, int point, PointValue& greatest) {
  if (value > greatest.value) greatest = {value, cell, point};
}

/// What a pack of elements has for extremes.
struct PackDeformation {
  PointValue least{1}, greatest{1}, strain, rotation;
  ValueAt folded{1};
};

/// The largest absolute eigenvalue of a symmetric matrix, by the trigonometric solution of its characteristic equation.
double spectral_norm(const double (&a)[3][3]) {
  const double mean = (a[0][0] + a[1][1] + a[2][2]) / 3;
  double square = 0;  // |dev a|^2 / 6
  double dev[3][3];
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      dev[i][j] = a[i][j] - (i == j ? mean : 0.0);
      square += dev[i][j] * dev[i][j] / 6;
    }
  const double p = std::sqrt(square);
  if (!(p > 0)) return std::abs(mean);
  const double det = dev[0][0] * (dev[1][1] * dev[2][2] - dev[1][2] * dev[2][1]) -
                     dev[0][1] * (dev[1][0] * dev[2][2] - dev[1][2] * dev[2][0]) +
                     dev[0][2] * (dev[1][0] * dev[2][1] - dev[1][1] * dev[2][0]);
  const double angle = std::acos(std::clamp(det / (2 * p * p * p), -1.0, 1.0)) / 3;
  constexpr double third_of_turn = 2.0943951023931953;
  return std::max(std::abs(mean + 2 * p * std::cos(angle)), std::abs(mean + 2 * p * std::cos(angle + third_of_turn)));
}

/// Strain and rotation of the small strain tensor, of one lane.
void include_small_strain(const Mat3<Pack>& h, int lane, int cell, int point, PackDeformation& pack) {
  double strain[3][3], square = 0, rotation = 0;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      strain[i][j] = 0.5 * (h(i, j)[lane] + h(j, i)[lane]);
      square += strain[i][j] * strain[i][j];
      const double turn = 0.5 * (h(i, j)[lane] - h(j, i)[lane]);
      rotation += 0.5 * turn * turn;
    }
  take_greater(std::sqrt(rotation), cell, point, pack.rotation);
  if (std::sqrt(square) > pack.strain.value) take_greater(spectral_norm(strain), cell, point, pack.strain);
}

template <class Element>
bool is_linear(const WallLayer<Element>& layer) {
  return std::holds_alternative<LinearElastic>(layer.material);
}

/// The nodes of a cell where its deformation puts them.
template <class Element, class Part>
auto moved_nodes(const Part& part, int cell, const DeformationInput& in) {
  constexpr int n = Element::components;
  std::array<Point, Element::nodes> x;
  const double sign = in.finds_unloaded_shape ? -1 : 1;
  for (int a = 0; a < Element::nodes; ++a) {
    const int node = part.cells[static_cast<std::size_t>(cell)][static_cast<std::size_t>(a)];
    x[a] = part.nodes[static_cast<std::size_t>(node)];
    for (int k = 0; k < n; ++k) x[a][Element::axis[k]] += sign * in.wall[MixedLayout<n>::vector(node, k)];
  }
  return x;
}

/// Looks whether a quadratic cell is folded between its quadrature points.
template <class Element, class Part>
void include_fold(const Part& part, int cell, const DeformationInput& in, ValueAt& folded) {
  const auto moved = moved_nodes<Element>(part, cell, in);
  if (is_surely_positive<Element::dim>(moved)) return;
  const CellJacobian now = cell_jacobian<Element::dim>(moved);
  if (now.positive || !(now.ratio() < folded.value)) return;
  folded = {std::min(0.0, now.ratio()), now.where};
}

template <class Element, class Part>
PackDeformation pack_deformation(const typename ElementPacks<Element>::ElementPack& pack, const Part& part,
                                 const DeformationInput& in, bool linear) {
  constexpr int n = Element::components;
  constexpr int points = Element::constant_gradients && !Element::axisymmetric ? 1 : Element::points;
  NodalVector<Element> d;
  gather<MixedLayout<n>>(d, pack, in.wall);
  if (in.prestress) {
    NodalVector<Element> first;
    gather<VectorLayout<n>>(first, pack, in.prestress);
    for (int a = 0; a < Element::nodes; ++a)
      for (int k = 0; k < n; ++k) d.at[a][k] += first.at[a][k];
  }
  PackDeformation result;
  const FieldGradients<Element> grad_d(d);
  for (int q = 0; q < points; ++q) {
    const Mat3<Pack> h = gradient_of(grad_d, Element::at(pack.geometry, q));
    const Pack change = in.finds_unloaded_shape ? volume_change(-1.0 * h) : volume_change(h);
    for (int lane = 0; lane < pack.filled; ++lane) {
      if (!pack.counted[lane]) continue;
      const double ratio = in.finds_unloaded_shape ? 1 / (1 + change[lane]) : 1 + change[lane];
      take_less(ratio, pack.cell[lane], q, result.least);
      take_greater(ratio, pack.cell[lane], q, result.greatest);
      if (linear) include_small_strain(h, lane, pack.cell[lane], q, result);
    }
  }
  if constexpr (Element::order == 2)
    for (int lane = 0; lane < pack.filled; ++lane)
      if (pack.counted[lane]) include_fold<Element>(part, pack.cell[lane], in, result.folded);
  return result;
}

/// Where on the mesh a quadrature point is.
template <class Element, class Part>
ValueAt placed(const PointValue& at, const Part& part) {
  if (at.cell < 0) return {at.value, {0, 0, 0}};
  Vec3<Pack> x[Element::nodes];
  const auto& cell = part.cells[static_cast<std::size_t>(at.cell)];
  for (int a = 0; a < Element::nodes; ++a)
    for (int i = 0; i < 3; ++i) x[a][i] = Pack(part.nodes[static_cast<std::size_t>(cell[a])][i]);
  const auto g = Element::at(Element::geometry(x), at.point);
  ValueAt value{at.value, {0, 0, 0}};
  for (int a = 0; a < Element::nodes; ++a)
    for (int i = 0; i < 3; ++i) value.where[i] += g.vectors().value[a] * x[a][i][0];
  return value;
}

/// Of several parts of a layer the worst; of alike ones the first's.
void include(const LayerDeformation& other, LayerDeformation& all) {
  if (!std::isnan(all.least.value) && !(other.least.value >= all.least.value)) all.least = other.least;
  if (other.greatest.value > all.greatest.value) all.greatest = other.greatest;
  if (other.folded.value < all.folded.value) all.folded = other.folded;
  if (other.strain.value > all.strain.value) all.strain = other.strain;
  if (other.rotation.value > all.rotation.value) all.rotation = other.rotation;
}

}  // namespace

template <class Element>
LayerDeformation layer_deformation(const WallLayer<Element>& layer, const Submesh<Element::dim, Element::order>& part,
                                   const DeformationInput& in) {
  const bool linear = is_linear(layer) && !in.finds_unloaded_shape;
  std::vector<PackDeformation> of_pack(layer.packs.pack_count());
  for_each_thread(layer.packs, serial_sum_elements, [&](int, const auto& mine) {
    for (const auto& pack : mine)
      if (pack.counted_here())
        of_pack[static_cast<std::size_t>(pack.number)] = pack_deformation<Element>(pack, part, in, linear);
  });
  PackDeformation all;
  for (const PackDeformation& one : of_pack) {
    take_less(one.least.value, one.least.cell, one.least.point, all.least);
    take_greater(one.greatest.value, one.greatest.cell, one.greatest.point, all.greatest);
    take_greater(one.strain.value, one.strain.cell, one.strain.point, all.strain);
    take_greater(one.rotation.value, one.rotation.cell, one.rotation.point, all.rotation);
    if (one.folded.value < all.folded.value) all.folded = one.folded;
  }
  const auto place = [&](const PointValue& at) { return placed<Element>(at, part); };
  return {place(all.least), place(all.greatest), all.folded, place(all.strain), place(all.rotation)};
}

std::vector<LayerDeformation> worst_of_all(const std::vector<LayerDeformation>& layers, const Communicator& processes) {
  if (processes.is_alone()) return layers;
  const auto values = [](auto& layer) {
    return std::array{&layer.least, &layer.greatest, &layer.folded, &layer.strain, &layer.rotation};
  };
  std::vector<double> mine;
  for (const LayerDeformation& layer : layers)
    for (const ValueAt* at : values(layer)) {
      mine.push_back(at->value);
      mine.insert(mine.end(), at->where.begin(), at->where.end());
    }
  const std::vector<double> all = processes.gather(mine);
  std::vector<LayerDeformation> worst(layers.size());
  for (std::size_t at = 0; at < all.size();)
    for (LayerDeformation& layer : worst) {
      LayerDeformation one;
      for (ValueAt* value : values(one)) {
        *value = {all[at], {all[at + 1], all[at + 2], all[at + 3]}};
        at += 4;
      }
      include(one, layer);
    }
  return worst;
}

#define FSI_INSTANTIATE(Element)                                                                                       \
  template LayerDeformation layer_deformation(const WallLayer<Element>&, const Submesh<Element::dim, Element::order>&, \
                                              const DeformationInput&);
FSI_FOR_EACH_ELEMENT(FSI_INSTANTIATE)
#undef FSI_INSTANTIATE

}  // namespace fsi
