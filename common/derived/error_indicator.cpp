#include "derived/error_indicator.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <optional>
#include <utility>

#include "derived/gradient_recovery.hpp"
#include "derived/recovery_mirrors.hpp"
#include "fem/elements.hpp"
#include "fem/nodal_layout.hpp"
#include "fluid/fluid_problem.hpp"
#include "host/threads.hpp"
#include "mesh/group_names.hpp"
#include "wall/wall_problem.hpp"

namespace fsi {

namespace {

/// Cells on which a field is smooth, with recovered gradients at their nodes.
struct SmoothCells {
  std::vector<int> cells;                     ///< here
  GradientRecovery vectors;                   ///< at own nodes of the cells
  std::optional<GradientRecovery> of_linear;  ///< at own vertices, of linear pressures of quadratic cells
  const GradientRecovery& pressure() const { return of_linear ? *of_linear : vectors; }
};

/// Recovered gradients at a node: of the vectors, row by row, then of the pressure.
constexpr int numbers_per_node = 12;

/// Integrals over cells, lane by lane.
struct Sums {
  Pack measure{0.0}, vectors{0.0}, pressure{0.0}, vector_slopes{0.0}, pressure_slopes{0.0};
};

template <class Element>
class IndicatorOf : public ErrorIndicator<Element::components> {
 public:
  static constexpr int n = Element::components;
  using Mixed = MixedLayout<n>;
  using Part = PartOf<Element>;

  /// \param here     this process's part of the medium; must outlive this
  /// \param whole    the whole of it
  /// \param regions  of the mesh: on the cells of each the fields are smooth
  IndicatorOf(const MeshOf<Element>& mesh, const Part& here, const Part& whole, const PartRestriction* restriction,
              const std::vector<int>& regions)
      : part_(here) {
    for (const int region : regions) smooth_.push_back(smooth_cells(mesh, whole, restriction, region));
    if (!restriction) return;
    std::vector<int> numbers;
    static_cast<void>(restriction->part(whole, numbers));
    order_.emplace(here.processes(), std::vector<std::int64_t>(numbers.begin(), numbers.end()), here.counted,
                   static_cast<std::int64_t>(whole.cells.size()));
  }

  std::size_t cells() const override { return part_.cells.size(); }
  const WholeOrder* order() const override { return order_ ? &*order_ : nullptr; }

  CellErrors of_cells(const std::vector<double>& field) const override {
    CellErrors errors{std::vector<double>(cells(), 0.0), std::vector<double>(cells(), 0.0)};
    for_cells(field, [&](int cell, int lane, const Sums& sums) {
      errors.vectors[cell] = std::sqrt(sums.vectors[lane] / sums.measure[lane]);
      errors.pressure[cell] = std::sqrt(sums.pressure[lane] / sums.measure[lane]);
    });
    return errors;
  }

  CellGradientErrors of_gradients(const std::vector<double>& field) const override {
    const std::vector<double> none(cells(), 0.0);
    CellGradientErrors errors{{none, none}, none};
    for_cells(field, [&](int cell, int lane, const Sums& sums) {
      errors.errors.vectors[cell] = std::sqrt(sums.vector_slopes[lane] / sums.measure[lane]);
      errors.errors.pressure[cell] = std::sqrt(sums.pressure_slopes[lane] / sums.measure[lane]);
      errors.measure[cell] = sums.measure[lane];
    });
    return errors;
  }

 private:
  static SmoothCells smooth_cells(const MeshOf<Element>& mesh, const Part& whole, const PartRestriction* restriction,
                                  int region) {
    const std::vector<int> axes{std::begin(Element::axis), std::end(Element::axis)};
    RecoveryCells cells{whole.nodes, {}, Element::nodes, Element::order, axes, Element::axisymmetric};
    RecoveryCells corners{whole.nodes, {}, Element::dim + 1, 1, axes, Element::axisymmetric};
    std::vector<int> here;
    int count = 0;
    for (std::size_t c = 0; c < whole.cells.size(); ++c) {
      const auto& cell = whole.cells[c];
      const bool is_here = !restriction || std::any_of(cell.begin(), cell.end(),
                                                       [&](int node) { return restriction->owns_whole(node); });
      if (is_here) ++count;
      if (whole.cell_region[c] != region) continue;
      if (is_here) here.push_back(count - 1);
      cells.nodes.insert(cells.nodes.end(), cell.begin(), cell.end());
      corners.nodes.insert(corners.nodes.end(), cell.begin(), cell.begin() + Element::dim + 1);
    }
    SmoothCells smooth{std::move(here), recovery(mesh, whole, restriction, cells), {}};
    if (Element::order > 1) smooth.of_linear.emplace(recovery(mesh, whole, restriction, corners));
    return smooth;
  }

  static GradientRecovery recovery(const MeshOf<Element>& mesh, const Part& whole, const PartRestriction* restriction,
                                   RecoveryCells& cells) {
    cells.mirrors = recovery_mirrors<Element>(mesh, whole, cells.nodes);
    std::vector<int> at = cells.nodes;
    std::sort(at.begin(), at.end());
    at.erase(std::unique(at.begin(), at.end()), at.end());
    if (restriction)
      at.erase(std::remove_if(at.begin(), at.end(), [&](int node) { return !restriction->owns_whole(node); }),
               at.end());
    GradientRecovery gradients(cells, std::move(at));
    if (restriction) gradients.restrict_to(*restriction);
    return gradients;
  }

  /// Recovered gradients at the nodes of these cells, ghosts too; zero at other nodes.
  std::vector<double> nodal(const SmoothCells& smooth, const std::vector<double>& field) const {
    std::vector<double> gradients(static_cast<std::size_t>(part_.node_count()) * numbers_per_node, 0.0);
    std::vector<double> buffer;
    const auto& far = smooth.vectors.template reach<Mixed>(field, buffer);
    const auto first = [](int node) { return static_cast<std::size_t>(node) * numbers_per_node; };
    const auto count = static_cast<std::int64_t>(smooth.vectors.size());
#pragma omp parallel for num_threads(threads())
    for (std::int64_t i = 0; i < count; ++i) {
      const auto at = static_cast<std::size_t>(i);
      const auto h = smooth.vectors.template gradient<Mixed>(at, far);
      for (int k = 0; k < 9; ++k) gradients[first(smooth.vectors.nodes()[at]) + k] = h(k / 3, k % 3);
    }
    const auto& of_pressure = smooth.pressure();
    std::vector<double> pressure_buffer;
    const auto& far_pressure = of_pressure.template reach<Mixed>(field, pressure_buffer);
    for (std::size_t i = 0; i < of_pressure.size(); ++i) {
      const auto slope = of_pressure.template scalar_gradient<Mixed>(i, far_pressure);
      for (int k = 0; k < 3; ++k) gradients[first(of_pressure.nodes()[i]) + 9 + k] = slope[k];
    }
    if (part_.share) part_.share->exchange.update(gradients, numbers_per_node);
    return gradients;
  }

  /// Calls visit(cell, lane, sums of its pack) for all cells here.
  template <class Visit>
  void for_cells(const std::vector<double>& field, Visit visit) const {
    for (const auto& smooth : smooth_) {
      const std::vector<double> gradients = nodal(smooth, field);
      const auto count = static_cast<std::int64_t>(smooth.cells.size());
      const std::int64_t packs = (count + pack_width - 1) / pack_width;
#pragma omp parallel for num_threads(threads())
      for (std::int64_t p = 0; p < packs; ++p) {
        std::array<int, pack_width> cells;
        for (std::int64_t lane = 0; lane < pack_width; ++lane)
          cells[lane] = smooth.cells[static_cast<std::size_t>(std::min(p * pack_width + lane, count - 1))];
        const Sums sums = integrals(cells, field, gradients);
        for (int lane = 0; lane < std::min<std::int64_t>(pack_width, count - p * pack_width); ++lane)
          visit(cells[lane], lane, sums);
      }
    }
  }

  /// The values of an array at a node of every lane's cell.
  template <class Place>
  static Pack gathered(const std::vector<double>& from, Place place) {
    Pack values;
    for (int lane = 0; lane < pack_width; ++lane) values.set(lane, from[place(lane)]);
    return values;
  }

  Sums integrals(const std::array<int, pack_width>& cells, const std::vector<double>& field,
                 const std::vector<double>& gradients) const {
    Vec3<Pack> x[Element::nodes], u[Element::nodes], centre{{Pack(0.0), Pack(0.0), Pack(0.0)}};
    Pack recovered[Element::nodes][numbers_per_node], p[Element::scalar_nodes];
    for (int a = 0; a < Element::nodes; ++a) {
      const auto node = [&](int lane) { return part_.cells[cells[lane]][a]; };
      u[a] = Vec3<Pack>{{Pack(0.0), Pack(0.0), Pack(0.0)}};
      for (int k = 0; k < n; ++k)
        u[a][Element::axis[k]] = gathered(field, [&](int lane) { return Mixed::vector(node(lane), k); });
      for (int k = 0; k < numbers_per_node; ++k)
        recovered[a][k] =
            gathered(gradients, [&](int lane) { return static_cast<std::size_t>(node(lane)) * numbers_per_node + k; });
      if (a < Element::scalar_nodes) p[a] = gathered(field, [&](int lane) { return Mixed::scalar(node(lane)); });
      for (int k = 0; k < 3; ++k) {
        for (int lane = 0; lane < pack_width; ++lane) x[a][k].set(lane, part_.nodes[node(lane)][k]);
        if (a <= Element::dim) centre[k] += Pack(1.0 / (Element::dim + 1)) * x[a][k];
      }
    }
    const auto geometry = Element::geometry(x);
    Sums sums;
    for (int q = 0; q < Element::points; ++q) add(Element::at(geometry, q), x, centre, u, p, recovered, sums);
    return sums;
  }

  template <class Point>
  static void add(const Point& g, const Vec3<Pack> (&x)[Element::nodes], const Vec3<Pack>& centre,
                  const Vec3<Pack> (&u)[Element::nodes], const Pack (&p)[Element::scalar_nodes],
                  const Pack (&recovered)[Element::nodes][numbers_per_node], Sums& sums) {
    const Vec3<Pack> none{{Pack(0.0), Pack(0.0), Pack(0.0)}};
    Mat3<Pack> delta;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) delta(i, j) = Pack(0.0);
    Vec3<Pack> pressure_delta = none, from_centre = none - centre;
    Pack hoop(0.0);
    for (int a = 0; a < Element::nodes; ++a) {
      const Pack value(g.vectors().value[a]);
      for (const int i : Element::axis) {
        for (const int j : Element::axis)
          delta(i, j) += value * recovered[a][3 * i + j] - g.vectors().gradient[a][j] * u[a][i];
        from_centre[i] += value * x[a][i];
      }
      if (Element::axisymmetric) hoop += value * recovered[a][4] - g.vectors().hoop[a] * u[a][0];
    }
    for (int a = 0; a < Element::scalar_nodes; ++a)
      for (const int j : Element::axis)
        pressure_delta[j] += Pack(g.scalars().value[a]) * recovered[a][9 + j] - g.scalars().gradient[a][j] * p[a];
    Pack vectors(0.0), slopes = hoop * hoop;
    Pack pressure(0.0), pressure_slopes(0.0);
    for (const int i : Element::axis) {
      Pack across(0.0);
      for (const int j : Element::axis) {
        across += delta(i, j) * from_centre[j];
        slopes += delta(i, j) * delta(i, j);
      }
      vectors += across * across;
      pressure += pressure_delta[i] * from_centre[i];
      pressure_slopes += pressure_delta[i] * pressure_delta[i];
    }
    sums.measure += g.weight;
    sums.vectors += g.weight * vectors;
    sums.pressure += g.weight * pressure * pressure;
    sums.vector_slopes += g.weight * slopes;
    sums.pressure_slopes += g.weight * pressure_slopes;
  }

  const Part& part_;
  std::vector<SmoothCells> smooth_;
  std::optional<WholeOrder> order_;
};

}  // namespace

template <class Element>
std::unique_ptr<ErrorIndicator<Element::components>> make_fluid_indicator(const MeshOf<Element>& mesh,
                                                                          const Scene<Element::components>& scene,
                                                                          const WholeParts<Element>& whole) {
  if (!scene.fluid) return nullptr;
  const auto& part = static_cast<const FluidProblem<Element>&>(*scene.fluid).part();
  return std::make_unique<IndicatorOf<Element>>(mesh, part, whole.fluid ? *whole.fluid : part, whole.fluid_here.get(),
                                                std::vector<int>{mesh.region_index(group::fluid)});
}

template <class Element>
std::unique_ptr<ErrorIndicator<Element::components>> make_wall_indicator(const Case& setup, const MeshOf<Element>& mesh,
                                                                         const Scene<Element::components>& scene,
                                                                         const WholeParts<Element>& whole) {
  if (!scene.wall) return nullptr;
  const auto& part = static_cast<const WallProblem<Element>&>(*scene.wall).part();
  std::vector<int> regions;
  for (const auto& [name, data] : setup.structure->layers) regions.push_back(mesh.region_index(name));
  return std::make_unique<IndicatorOf<Element>>(mesh, part, whole.wall ? *whole.wall : part, whole.wall_here.get(),
                                                regions);
}

#define FSI_INSTANTIATE(Element)                                                               \
  template std::unique_ptr<ErrorIndicator<Element::components>> make_fluid_indicator<Element>( \
      const MeshOf<Element>&, const Scene<Element::components>&, const WholeParts<Element>&);  \
  template std::unique_ptr<ErrorIndicator<Element::components>> make_wall_indicator<Element>(  \
      const Case&, const MeshOf<Element>&, const Scene<Element::components>&, const WholeParts<Element>&);
FSI_FOR_EACH_ELEMENT(FSI_INSTANTIATE)
#undef FSI_INSTANTIATE

}  // namespace fsi
