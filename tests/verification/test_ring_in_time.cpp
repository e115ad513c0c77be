// The pulsating ring of docs/theory.md, section 13.2, in time: observed orders of the second-order schemes in the wall's
// radius, its velocity and the pressure at it, against the solution in continuous time, through the jump of the load.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>

#include "fem/elements.hpp"
#include "monolithic/coupled_numbering.hpp"
#include "partitioned/registry.hpp"
#include "scene/build_scene.hpp"
#include "support/errors.hpp"
#include "support/pulsating_ring.hpp"
#include "support/ring_meshes.hpp"
#include "support/scenes.hpp"
#include "system/newton_stepper.hpp"

namespace fsi::test::ring_in_time_tests {

namespace {

[[maybe_unused]] const int single_thread = set_threads(1);

constexpr double end = 12;  // ms

struct Pulse {
  double pressure, off;  ///< kPa, ms
};
/// Of the three materials of tubes().
constexpr Pulse pulses[] = {{0.10, 2}, {0.20, 1}, {0.20, 1}};

enum class Driver { monolithic, partitioned };

/// The motion at the ends of steps, in continuous time.
struct Course {
  std::vector<RingMotion> at;
  std::vector<double> pressure;  ///< of the fluid at the wall, kPa
};
Course exact_course(const PulsatingRing& ring, const Pulse& pulse, const TimeAxis& axis) {
  Course course;
  RingMotion now;
  for (int i = 1; i <= axis.steps(); ++i) {
    const double from = axis.time_of(i - 1), load = from < pulse.off - 1e-9 ? pulse.pressure : 0.0;
    march_on(ring, now, load, axis.time_of(i) - from, 0.01);
    course.at.push_back(now);
    course.pressure.push_back(pressure_at_wall(ring, now, load));
  }
  return course;
}

/// Root mean squares of errors over levels relative to the quantity's largest value, of a - R_i, the wall's velocity and
/// the pressure at the wall, the last without the millisecond after each jump; and the largest error of a relative to R_i.
template <class Element>
std::vector<double> ring_errors(const std::string& scheme, int material, const RingCells& cells, int steps,
                                Driver driver) {
  constexpr int n = Element::components;
  const PulsatingRing ring{tubes()[material]};
  const Pulse pulse = pulses[material];
  const auto mesh = ring_mesh<Element>(cells, ring.porous_radius, 0.4);
  static constexpr const char* names[] = {"neo-hookean", "mooney-rivlin", "artery"};
  Case setup = coupled_case(names[material], end / steps);
  setup.fluid->outlet = false;
  setup.structure->bulk_modulus = 1e9;
  setup.structure->layer_pressure = LayerPressure::separate;
  setup.inlet = PressureTable{{{0, pulse.pressure}, {pulse.off, pulse.pressure}, {pulse.off, 0}}};
  setup.time->end = end;
  setup.time->scheme = scheme;
  setup.partitioned.tolerance = 1e-9;
  setup.partitioned.max_iterations = 200;
  const auto scene = build_scene<Element>(setup, mesh);
  const Loads loads(setup);
  std::unique_ptr<Stepper> stepper;
  if (driver == Driver::monolithic) {
    NewtonOptions options;
    options.tolerance = 1e-9;
    stepper = std::make_unique<NewtonStepper<n>>(*scene, loads, options, number_scene(*scene));
  } else {
    stepper = make_coupling_stepper(*scene, loads, setup);
  }
  // A node of the interface where only the radius changes.
  const auto& places = scene->wall->nodes().nodes;
  const auto node = *std::find_if(scene->interface.begin(), scene->interface.end(), [&](const InterfaceNode& at) {
    return Element::axisymmetric ? places[at.wall][2] == 0 : places[at.wall][1] == 0;
  });
  const Course exact = exact_course(ring, pulse, loads.axis());
  struct Error {
    double squares = 0, largest = 0;
    int count = 0;
    void add(double value, double expected) {
      squares += (value - expected) * (value - expected);
      largest = std::max(largest, std::abs(expected));
      ++count;
    }
    double value() const { return std::sqrt(squares / count) / largest; }
  };
  Error a, v, p;
  double largest = 0;
  State state = scene->at_rest();
  const int lag = scene->integrator->pressures_lag() ? 1 : 0;
  for (int i = 1; i <= loads.steps(); ++i) {
    stepper->advance(state);
    const RingMotion& at = exact.at[i - 1];
    const double radius = inner_radius + state.now.wall[MixedLayout<n>::vector(node.wall)];
    largest = std::max(largest, std::abs(radius - at.a) / inner_radius);
    a.add(state.now.wall[MixedLayout<n>::vector(node.wall)], at.a - inner_radius);
    v.add(state.wall_velocity[VectorLayout<n>::vector(node.wall)], at.q / at.a);
    const int level = i - lag;
    if (level < 1) continue;
    const double time = state.times[lag], since = time > pulse.off + 1e-9 ? time - pulse.off : time;
    const double value = state.before[lag].fluid[MixedLayout<n>::scalar(node.fluid)];
    if (since > 1) p.add(value, exact.pressure[level - 1]);
  }
  return {a.value(), v.value(), p.value(), largest};
}

template <class Element>
ConvergenceTable ring_table(const std::string& name, const std::string& scheme, int material, const RingCells& cells,
                            const std::vector<int>& steps, Driver driver = Driver::monolithic) {
  ConvergenceTable errors(
      std::string(tubes()[material].name) + ", " + name + (Element::axisymmetric ? ", axisymmetric" : ", plane"),
      {"a", "wall velocity", "wall pressure", "largest of a / R_i"});
  for (int count : steps) errors.add(end / count, ring_errors<Element>(scheme, material, cells, count, driver));
  errors.print();
  return errors;
}

void expect_second_order(const ConvergenceTable& errors) {
  for (int quantity = 0; quantity < 3; ++quantity) {
    EXPECT_GT(errors.last_order(quantity), 1.8) << quantity;
    EXPECT_LT(errors.last_order(quantity), 2.4)
        << quantity;  // errors of the mesh, of both signs, are the tenth of these
  }
}

constexpr RingCells axisymmetric_cells{20, 3, 3, 1}, plane_cells{16, 3, 2, 6};

// Fibres begin and cease to act where S(a) has a kink: steps end there.
TEST(RingInTime, ExactSolutionIsRightToTwelveDigits) {
  for (int material : {0, 1, 2}) {
    const PulsatingRing ring{tubes()[material]};
    const auto at = [&](double step) {
      return ring_motion(ring, pulses[material].pressure, pulses[material].off, end, step);
    };
    const RingMotion coarse = at(0.004), fine = at(0.002);
    EXPECT_NEAR(coarse.a, fine.a, 2e-12) << ring.tube.name;
    EXPECT_NEAR(coarse.q, fine.q, 5e-12) << ring.tube.name;
  }
}

struct SchemeAndMaterial {
  const char* name;
  std::string scheme;
  int material;
};
class EachScheme : public testing::TestWithParam<SchemeAndMaterial> {};
std::vector<SchemeAndMaterial> all() {
  std::vector<SchemeAndMaterial> combinations;
  for (int material : {0, 1, 2})
    for (const auto& [name, scheme] :
         {std::pair{"Midpoint", "midpoint"}, std::pair{"Bdf2", "bdf2"}, std::pair{"TrBdf2", "tr-bdf2"},
          std::pair{"GeneralisedAlpha", "generalised-alpha"}})
      combinations.push_back({name, scheme, material});
  return combinations;
}
std::string name_of(const testing::TestParamInfo<SchemeAndMaterial>& test) {
  static constexpr const char* names[] = {"NeoHookean", "MooneyRivlin", "Artery"};
  return std::string(test.param.name) + names[test.param.material];
}
INSTANTIATE_TEST_SUITE_P(RingInTime, EachScheme, testing::ValuesIn(all()), name_of);

TEST_P(EachScheme, AxisymmetricIsOfSecondOrder) {
  expect_second_order(ring_table<P2P1AxisymmetricTriangle>(GetParam().name, GetParam().scheme, GetParam().material,
                                                           axisymmetric_cells, {120, 240, 480}));
}

TEST_P(EachScheme, PlaneIsOfSecondOrder) {
  expect_second_order(
      ring_table<P2P1PlaneTriangle>(GetParam().name, GetParam().scheme, GetParam().material, plane_cells, {120, 240}));
}

// The jump does not lie between steps of 0.06 ms: those before it are made shorter.
TEST_P(EachScheme, RadiusIsRightToAThousandthInTwoHundredSteps) {
  const auto [name, scheme, material] = GetParam();
  const double error =
      ring_errors<P2P1AxisymmetricTriangle>(scheme, material, axisymmetric_cells, 200, Driver::monolithic)[3];
  fmt::print("{}: {:.2e}\n", name, error);
  EXPECT_LT(error, 1e-3);
}

// The partitioned driver solves the same equations.
TEST(RingInTime, PartitionedHasTheMonolithicErrors) {
  for (const auto& [name, scheme] : {std::pair{"midpoint", "midpoint"}, std::pair{"tr-bdf2", "tr-bdf2"}}) {
    constexpr RingCells cells{12, 2, 2, 1};
    const auto whole = ring_errors<P2P1AxisymmetricTriangle>(scheme, 0, cells, 120, Driver::monolithic);
    const auto parts = ring_errors<P2P1AxisymmetricTriangle>(scheme, 0, cells, 120, Driver::partitioned);
    fmt::print("{}: {:.6e} {:.6e} {:.6e}; partitioned {:.6e} {:.6e} {:.6e}\n", name, whole[0], whole[1], whole[2],
               parts[0], parts[1], parts[2]);
    for (int quantity = 0; quantity < 3; ++quantity)
      EXPECT_NEAR(parts[quantity], whole[quantity], 1e-3 * whole[quantity]) << name;
  }
}

}  // namespace

}  // namespace fsi::test::ring_in_time_tests
