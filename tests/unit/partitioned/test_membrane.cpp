#include <gtest/gtest.h>

#include "fem/p1_tetrahedron.hpp"
#include "partitioned/interface/membrane.hpp"
#include "support/scenes.hpp"

namespace fsi::test {

namespace {

TEST(Membrane, ImpedanceIsTheHarmonicMeanOfPushAndShear) {
  Membrane wall;
  wall.thickness = 0.4;
  wall.density = 1.2;
  wall.shear_modulus = 3;
  wall.tension = 4;
  wall.radius = 2;
  const double dt = 0.1, a = 1 / (dt * dt);
  const double push = dt * (100 * 1.2 * 0.4 + 1.0);  // kPa/(mm/ms)
  const double depth = std::sqrt(3 / (100 * 1.2));   // mm
  const double shear = dt * 100 * 1.2 * depth * std::tanh(0.4 / depth);
  EXPECT_NEAR(wall.impedance(a, dt), 2 * push * shear / (push + shear), 1e-12);
}

TEST(Membrane, OfASceneHasItsWallsMass) {
  const Case setup = coupled_case("neo-hookean");
  const auto scene = build_scene<P1Tetrahedron>(setup, fluid_and_wall_box(2));
  const Membrane wall = membrane_of(*scene);
  double volume = 0;
  for (const auto& layer : scene->wall->layer_data()) volume += layer.volume;
  EXPECT_GT(volume, 0);
  EXPECT_NEAR(wall.thickness * wall.area, volume, 1e-12 * volume);
  double area = 0;
  for (double node_area : wall.node_areas) {
    EXPECT_GT(node_area, 0);
    area += node_area;
  }
  EXPECT_NEAR(wall.area, area, 1e-12);
  // Incompressible: E / (1 - nu^2) = 4 mu.
  EXPECT_NEAR(wall.tension, 4 * wall.shear_modulus * wall.thickness, 1e-3 * wall.tension);
}

// Two ways to the same number: c_w^2 = E h / ((1 - nu^2) 2 rho R).
TEST(Membrane, CarriesTheWaveThatTheStabilisationKnows) {
  Case setup = coupled_case("artery");
  setup.stabilisation = Stabilisation::projected;
  const auto mesh = fluid_and_wall_box(2);
  const auto scene = build_scene<P1Tetrahedron>(setup, mesh);
  const Membrane wall = membrane_of(*scene);
  const double speed = std::sqrt(wall.tension / (2 * setup.fluid->density * wall.radius));
  EXPECT_NEAR(scene->fluid->form().wave_speed, speed, 1e-12 * speed);
  EXPECT_EQ(scene->wall->constants().wave_speed, scene->fluid->form().wave_speed);

  setup.structure->layer_pressure = LayerPressure::separate;
  EXPECT_EQ(build_scene<P1Tetrahedron>(setup, mesh)->wall->constants().stabilisation, 0.5);
  setup.structure->layer_pressure = LayerPressure::continuous;
  EXPECT_EQ(build_scene<P1Tetrahedron>(setup, mesh)->wall->constants().stabilisation, 0.05) << "leaks between layers";

  setup.stabilisation = Stabilisation::paper;
  const auto papers = build_scene<P1Tetrahedron>(setup, mesh);
  EXPECT_EQ(papers->fluid->form().wave_speed, 0);
  EXPECT_EQ(papers->wall->constants().wave_speed, 0);
  EXPECT_EQ(papers->wall->constants().stabilisation, 0.5);
}

TEST(Membrane, FibresStiffenIt) {
  const Case slack = coupled_case("neo-hookean"), fibres = coupled_case("artery");
  const auto mesh = fluid_and_wall_box(2);
  EXPECT_GT(membrane_of(*build_scene<P1Tetrahedron>(fibres, mesh)).tension,
            1.5 * membrane_of(*build_scene<P1Tetrahedron>(slack, mesh)).tension);
}

}  // namespace

}  // namespace fsi::test
