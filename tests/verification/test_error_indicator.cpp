// The error indicator of cells: zero where the element is exact, its order, the errors that it stands for, and that it
// does not depend on how a body lies.

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <memory>
#include <vector>

#include "derived/error_indicator.hpp"
#include "derived/mean_errors.hpp"
#include "fem/elements.hpp"
#include "support/channels.hpp"
#include "support/every_element.hpp"
#include "support/exact_fields.hpp"

namespace fsi::test::error_indicator_tests {

namespace {

[[maybe_unused]] const int single_thread = set_threads(1);

/// A smooth pressure.
double pressure_at(const Point& x) {
  return std::sin(1.3 * x[0] + 0.9 * x[1] - 0.8 * x[2] + 0.4);
}
Point pressure_slope(const Point& x) {
  const double c = std::cos(1.3 * x[0] + 0.9 * x[1] - 0.8 * x[2] + 0.4);
  return {1.3 * c, 0.9 * c, -0.8 * c};
}

/// A fluid whose nodes have the values of functions.
template <class Element>
struct InterpolatedFlow {
  static constexpr int n = Element::components;
  MeshOf<Element> mesh;
  Case setup = fluid_case(1, 0.4);
  std::unique_ptr<Scene<n>> scene;
  std::unique_ptr<ErrorIndicator<n>> indicator;
  std::vector<double> field;

  template <class Velocity, class Pressure>
  InterpolatedFlow(MeshOf<Element> on, Velocity velocity, Pressure pressure) : mesh(std::move(on)) {
    scene = build_scene<Element>(setup, mesh);
    indicator = make_fluid_indicator<Element>(mesh, *scene);
    field = scene->at_rest().now.fluid;
    for (int a = 0; a < scene->fluid->node_count(); ++a) {
      const Point& x = scene->fluid->nodes().nodes[a];
      const Point u = velocity(x);
      for (int k = 0; k < n; ++k) field[MixedLayout<n>::vector(a, k)] = u[Element::axis[k]];
      field[MixedLayout<n>::scalar(a)] = pressure(x);  // of mid-edge nodes without meaning
    }
  }
};

template <class Element>
InterpolatedFlow<Element> smooth_flow(MeshOf<Element> mesh) {
  const SineField<Element> exact{1.0, 0.3};
  return {std::move(mesh),
          [exact](const Point& x) {
            const auto u = exact.at(x).value;
            return Point{u[0][0], u[1][0], u[2][0]};
          },
          pressure_at};
}

/// Norms over the whole fluid: of gradients' errors, found and true, and of the indicator itself.
struct Norms {
  double vector_slopes = 0, pressure_slopes = 0;            ///< indicator's, mm^(3/2) times unit per mm
  double true_vector_slopes = 0, true_pressure_slopes = 0;  ///< exact functions against their interpolants
  double vectors = 0, pressure = 0;                         ///< root mean square of eta, unit of the quantity
  double true_vectors = 0, true_pressure = 0;               ///< likewise of the interpolation's error
};

/// Of the linear shape function of a vertex: 1 there, 1/2 in the middles of its edges, which shape functions of vectors
/// interpolate exactly.
template <class Element>
Point barycentric_slope(const ElementPoint<Element>& point, int vertex) {
  Point slope = point.gradient[vertex];
  if constexpr (Element::order == 2)
    for (std::size_t e = 0; e < SimplexEdges<Element::dim>::vertices.size(); ++e) {
      const auto& [a, b] = SimplexEdges<Element::dim>::vertices[e];
      if (a != vertex && b != vertex) continue;
      for (int j = 0; j < 3; ++j) slope[j] += 0.5 * point.gradient[Element::dim + 1 + e][j];
    }
  return slope;
}

template <class Element>
Norms norms_of(const InterpolatedFlow<Element>& flow) {
  constexpr int n = Element::components;
  const SineField<Element> exact{1.0, 0.3};
  Norms norms;
  const auto slopes = flow.indicator->of_gradients(flow.field);
  const auto eta = flow.indicator->of_cells(flow.field);
  double whole = 0;
  for (std::size_t c = 0; c < slopes.measure.size(); ++c) {
    const auto add = [&](double& sum, double value) { sum += slopes.measure[c] * value * value; };
    add(norms.vector_slopes, slopes.errors.vectors[c]);
    add(norms.pressure_slopes, slopes.errors.pressure[c]);
    add(norms.vectors, eta.vectors[c]);
    add(norms.pressure, eta.pressure[c]);
    whole += slopes.measure[c];
  }
  const auto& part = flow.scene->fluid->nodes();
  visit_points<Element>(flow.mesh, [&](const auto& cell, const ElementPoint<Element>& point) {
    const auto u = exact.at(point.x);
    Mat3<double> delta{};
    Vec3<double> value{}, slope{};
    double p = -pressure_at(point.x);
    for (int i = 0; i < 3; ++i) {
      value[i] = -u.value[i][0];
      for (int j = 0; j < 3; ++j) delta(i, j) = -u.gradient(i, j)[0];
    }
    for (const int j : Element::axis) slope[j] = -pressure_slope(point.x)[j];
    for (int a = 0; a < Element::nodes; ++a) {
      const int node = part.local_node[cell[a]];
      for (int k = 0; k < n; ++k) {
        const int i = Element::axis[k];
        const double nodal = flow.field[MixedLayout<n>::vector(node, k)];
        value[i] += point.shape[a] * nodal;
        for (const int j : Element::axis) delta(i, j) += point.gradient[a][j] * nodal;
        if (Element::axisymmetric && k == 0) delta(1, 1) += point.shape[a] * nodal / point.x[0];
      }
      if (a >= Element::scalar_nodes) continue;
      const double nodal = flow.field[MixedLayout<n>::scalar(node)];
      p += point.scalar_shape[a] * nodal;
      for (const int j : Element::axis) slope[j] += barycentric_slope(point, a)[j] * nodal;
    }
    norms.true_vector_slopes += point.weight * contract(delta, delta);
    norms.true_pressure_slopes += point.weight * dot(slope, slope);
    norms.true_vectors += point.weight * dot(value, value);
    norms.true_pressure += point.weight * p * p;
  });
  for (double* sum : {&norms.vectors, &norms.pressure, &norms.true_vectors, &norms.true_pressure}) *sum /= whole;
  for (double* sum :
       {&norms.vector_slopes, &norms.pressure_slopes, &norms.true_vector_slopes, &norms.true_pressure_slopes,
        &norms.vectors, &norms.pressure, &norms.true_vectors, &norms.true_pressure})
    *sum = std::sqrt(*sum);
  return norms;
}

template <class Element>
class Indicator : public testing::Test {};
TYPED_TEST_SUITE(Indicator, Elements, ElementNames);

// Of polynomials of the element's degree: they have no error.
TYPED_TEST(Indicator, IsZeroWhereTheElementIsExact) {
  constexpr int degree = TypeParam::order;
  constexpr double slope = TypeParam::axisymmetric ? 0 : 0.7;  // on the axis nothing rises with the radius
  const InterpolatedFlow<TypeParam> flow(
      channel<TypeParam>(TypeParam::dim == 3 ? 3 : 5, 0),
      [](const Point& x) {
        const double s = 0.4 + slope * x[0] - 0.3 * x[1] + 0.9 * x[2];
        return Point{x[0] * (degree == 1 || !TypeParam::axisymmetric ? 0.6 : s), s, degree == 1 ? s : s * s};
      },
      [](const Point& x) { return 0.3 + slope * x[0] - 2 * x[1] + 0.5 * x[2]; });
  const auto eta = flow.indicator->of_cells(flow.field);
  ASSERT_EQ(eta.vectors.size(), flow.mesh.cells.size());
  for (std::size_t c = 0; c < eta.vectors.size(); ++c) {
    EXPECT_LT(eta.vectors[c], 1e-11);
    EXPECT_LT(eta.pressure[c], 1e-11);
  }
}

// The recovered gradient is of a higher order than the element's own, so that its difference from that tends to the true
// error: the effectivity tends to one. The indicator itself has the order of the quantity's error.
TYPED_TEST(Indicator, TendsToTheErrorOfTheGradient) {
  constexpr int coarsest = TypeParam::dim == 3 ? 3 : 6, levels = TypeParam::dim == 3 && TypeParam::order == 2 ? 2 : 3;
  std::vector<Norms> norms;
  for (int l = 0; l < levels; ++l) {
    norms.push_back(norms_of(smooth_flow<TypeParam>(channel<TypeParam>(coarsest << l))));
    const Norms& found = norms.back();
    std::printf("effectivity, velocity's gradient %.3f, pressure's %.3f; eta over the true error %.2f, %.2f\n",
                found.vector_slopes / found.true_vector_slopes, found.pressure_slopes / found.true_pressure_slopes,
                found.vectors / found.true_vectors, found.pressure / found.true_pressure);
  }
  const Norms &before = norms[norms.size() - 2], &last = norms.back();
  const auto off = [](const Norms& of) { return std::abs(of.vector_slopes / of.true_vector_slopes - 1); };
  EXPECT_LT(off(last), 0.05);
  EXPECT_LT(off(last), 0.75 * off(before) + 0.005);
  EXPECT_LT(std::abs(last.pressure_slopes / last.true_pressure_slopes - 1), 0.05);
  EXPECT_NEAR(std::log2(before.vectors / last.vectors), TypeParam::order + 1, 0.2);
  EXPECT_NEAR(std::log2(before.pressure / last.pressure), 2, 0.2);
  // Of the size of the error of interpolation. On an interval it is sqrt(6)/2 = 1.22 of that for a parabola and linear
  // elements, sqrt(22)/2 = 2.35 for a cubic and quadratic ones, as integrals of polynomials show; on the tetrahedra of
  // cut boxes, whose longest edge is inside, half.
  for (const double ratio : {last.vectors / last.true_vectors, last.pressure / last.true_pressure}) {
    EXPECT_GT(ratio, 0.4);
    EXPECT_LT(ratio, 2.5);
  }
}

// A layer of the fluid where the velocity turns within a cell: the largest indicator is there.
TYPED_TEST(Indicator, IsLargestWhereTheFieldTurns) {
  const double where = TypeParam::axisymmetric ? 1.5 : 0.5;
  const InterpolatedFlow<TypeParam> flow(
      channel<TypeParam>(TypeParam::dim == 3 ? 6 : 12),
      [&](const Point& x) {
        Point u{0, 0, 0};
        u[along_axis<TypeParam>] = std::tanh(20 * (x[across_axis<TypeParam>] - where));
        return u;
      },
      [](const Point&) { return 1.0; });
  const auto eta = flow.indicator->of_cells(flow.field);
  const auto worst = std::max_element(eta.vectors.begin(), eta.vectors.end()) - eta.vectors.begin();
  double centre = 0;
  for (int a = 0; a <= TypeParam::dim; ++a)
    centre += flow.mesh.nodes[flow.mesh.cells[worst][a]][across_axis<TypeParam>] / (TypeParam::dim + 1);
  EXPECT_NEAR(centre, where, 0.15);
  for (const double p : eta.pressure) EXPECT_LT(p, 1e-11);
}

TYPED_TEST(Indicator, DoesNotDependOnHowTheBodyLies) {
  constexpr int n = TypeParam::components;
  const auto mesh = channel<TypeParam>(TypeParam::dim == 3 ? 3 : 5);
  const auto flow = smooth_flow<TypeParam>(mesh);
  const auto at_rest = flow.indicator->of_cells(flow.field);
  for (unsigned i = 0; i < 6; ++i) {
    const auto q = orthogonal<TypeParam>(i);
    auto body = smooth_flow<TypeParam>(turned<TypeParam>(mesh, q, i % 2 == 1));
    for (int a = 0; a < body.scene->fluid->node_count(); ++a) {
      Vec3<double> u{};
      for (int k = 0; k < n; ++k) u[TypeParam::axis[k]] = flow.field[MixedLayout<n>::vector(a, k)];
      u = q * u;
      for (int k = 0; k < n; ++k) body.field[MixedLayout<n>::vector(a, k)] = u[TypeParam::axis[k]];
      body.field[MixedLayout<n>::scalar(a)] = flow.field[MixedLayout<n>::scalar(a)];
    }
    const auto found = body.indicator->of_cells(body.field);
    for (std::size_t c = 0; c < found.vectors.size(); ++c) {
      EXPECT_NEAR(found.vectors[c], at_rest.vectors[c], 1e-10);
      EXPECT_NEAR(found.pressure[c], at_rest.pressure[c], 1e-10);
    }
  }
}

// A pressure that jumps between two layers, and is linear in each: it has no error.
TYPED_TEST(Indicator, OfTheWallIsFoundLayerByLayer) {
  constexpr int n = TypeParam::components;
  auto mesh = irregular_mesh<TypeParam>(TypeParam::dim == 3 ? 4 : 6, "media");
  mesh.regions.emplace_back("adventitia");
  const double from = TypeParam::axisymmetric ? 1 : 0;
  for (std::size_t c = 0; c < mesh.cells.size(); ++c) {
    double centre = 0;
    for (int a = 0; a <= TypeParam::dim; ++a)
      centre += mesh.nodes[mesh.cells[c][a]][across_axis<TypeParam>] / (TypeParam::dim + 1);
    if (centre > from + 0.5) mesh.cell_region[c] = 1;
  }
  name_surface<TypeParam>(mesh, group::inner, across_axis<TypeParam>, from);
  name_surface<TypeParam>(mesh, group::wall_ends, along_axis<TypeParam>, 0);
  Case setup = coupled_case("neo-hookean");
  setup.fluid.reset();
  setup.inlet.reset();
  setup.load = PressureTable{{{0.0, 1.0}}};
  setup.structure->layer_pressure = LayerPressure::separate;
  const auto scene = build_scene<TypeParam>(setup, mesh);
  const auto indicator = make_wall_indicator<TypeParam>(setup, mesh, *scene);
  EXPECT_EQ(make_fluid_indicator<TypeParam>(mesh, *scene), nullptr);

  auto wall = scene->at_rest().now.wall;
  const auto& part = scene->wall->nodes();
  const auto& layers = scene->wall->layer_data();
  for (std::size_t l = 0; l < layers.size(); ++l)
    for (const int node : layers[l].nodes) {
      const Point& x = part.nodes[node];
      wall[MixedLayout<n>::scalar(node)] = l == 0 ? 7 + x[across_axis<TypeParam>] : 2 * x[along_axis<TypeParam>];
    }
  auto errors = indicator->of_cells(wall);
  for (const double p : errors.pressure) EXPECT_LT(p, 1e-11);
  for (const double d : errors.vectors) EXPECT_EQ(d, 0);
}

TEST(MeanErrors, AreRootMeanSquaresOverTime) {
  MeanErrors mean;
  EXPECT_EQ(mean.mean(2).vectors, (std::vector<double>{0, 0}));
  mean.add(1.0, {{9, 9}, {9, 9}});  // the first level begins
  mean.add(2.0, {{3, 0}, {1, 2}});
  mean.add(2.0, {{7, 7}, {7, 7}});  // taken in already
  mean.add(5.0, {{1, 2}, {1, 0}});
  const auto found = mean.mean(2);
  EXPECT_DOUBLE_EQ(found.vectors[0], std::sqrt((1 * 9 + 3 * 1) / 4.0));
  EXPECT_DOUBLE_EQ(found.vectors[1], std::sqrt(3 * 4 / 4.0));
  EXPECT_DOUBLE_EQ(found.pressure[0], 1);
  EXPECT_DOUBLE_EQ(found.pressure[1], std::sqrt(1 * 4 / 4.0));
}

}  // namespace

}  // namespace fsi::test::error_indicator_tests
