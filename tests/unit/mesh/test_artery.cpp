#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <ostream>

#include "base/error.hpp"
#include "mesh/boundary.hpp"
#include "mesh/mesh_checks.hpp"
#include "mesh/point_math.hpp"
#include "mesh/quality.hpp"
#include "mesher/artery_generator.hpp"
#include "meshes.hpp"

namespace fsi {
namespace {

struct Expected {
  const char* level;
  double nodes, tetrahedra;  // of the paper's meshes (Langer & Yang, table of meshes)
  int media_layers, adventitia_layers;
  double min_eta;  // measured once, rounded down
};

void PrintTo(const Expected& expected, std::ostream* out) {
  *out << expected.level;
}

class ArteryLevel : public testing::TestWithParam<Expected> {};

TEST_P(ArteryLevel, HasThePapersSizeAndIsFitForUse) {
  const auto& expected = GetParam();
  const auto mesh = generate_artery(artery_level(expected.level));
  EXPECT_NO_THROW(check_scene_mesh(mesh, test::artery_needs(), expected.level));
  const auto quality = measure_quality(mesh);
  EXPECT_NEAR(static_cast<double>(quality.nodes) / expected.nodes, 1, 0.1);
  EXPECT_NEAR(static_cast<double>(quality.cells) / expected.tetrahedra, 1, 0.1);
  EXPECT_GT(quality.min_eta, expected.min_eta);
  EXPECT_EQ(quality.regions[1].layers, expected.media_layers);
  EXPECT_EQ(quality.regions[2].layers, expected.adventitia_layers);
}

INSTANTIATE_TEST_SUITE_P(All, ArteryLevel,
                         testing::Values(Expected{"coarse", 1034, 4824, 1, 1, 0.35},
                                         Expected{"intermediate", 7249, 38592, 2, 1, 0.55},
                                         Expected{"fine", 54521, 308736, 4, 2, 0.55}),
                         [](const auto& tested) { return std::string(tested.param.level); });

TEST(Artery, EveryInterfaceAndOuterNodeIsOnItsCylinder) {
  const auto mesh = test::coarse_artery();
  for (const int node : facet_nodes(interface_facets(mesh, 0, {1, 2})))
    EXPECT_NEAR(std::hypot(mesh.nodes[node][0], mesh.nodes[node][1]), 1.43, 1e-14);
  for (const int node : facet_nodes(*mesh.facets("outer")))
    EXPECT_NEAR(std::hypot(mesh.nodes[node][0], mesh.nodes[node][1]), 1.82, 1e-14);
}

TEST(Artery, VolumesLieBetweenTheInscribedPrismAndTheCylinder) {
  const auto quality = measure_quality(test::coarse_artery());
  const double polygon = 12 * 0.5 * std::sin(2 * M_PI / 12);  // of radius 1
  const double squares[] = {1.43 * 1.43, 1.69 * 1.69 - 1.43 * 1.43, 1.82 * 1.82 - 1.69 * 1.69};
  for (int r = 0; r < 3; ++r) {
    EXPECT_GT(quality.regions[r].volume, polygon * squares[r] * 18);
    EXPECT_LT(quality.regions[r].volume, M_PI * squares[r] * 18);
  }
}

TEST(Artery, VolumesConvergeToTheCylinderByTheSquareOfTheSize) {
  const auto lumen_error = [](double size) {
    ArteryOptions options;
    options.length = 4;
    options.size = size;
    return M_PI * 1.43 * 1.43 * 4 - measure_quality(generate_artery(options)).regions[0].volume;
  };
  EXPECT_NEAR(std::log2(lumen_error(0.75) / lumen_error(0.375)), 2, 0.1);
}

TEST(Artery, StationsCloseTogetherAreLeftInLine) {
  ArteryOptions options;
  options.length = 1;
  options.axial_size = 0.1;
  const auto mesh = generate_artery(options);
  EXPECT_NO_THROW(check_scene_mesh(mesh, test::artery_needs(), "in line"));
  const double polygon = 12 * 0.5 * std::sin(2 * M_PI / 12) * 1.43 * 1.43;
  EXPECT_NEAR(measure_quality(mesh).regions[0].volume, polygon, 1e-12);
}

TEST(Artery, DimensionsAreFree) {
  ArteryOptions options;
  options.inner_radius = 4;
  options.media = 1;
  options.adventitia = 0.5;
  options.length = 7;
  options.size = 0.9;
  const auto mesh = generate_artery(options);
  EXPECT_NO_THROW(check_scene_mesh(mesh, test::artery_needs(), "free"));
  double radius = 0, length = 0;
  for (const auto& x : mesh.nodes) {
    radius = std::max(radius, std::hypot(x[0], x[1]));
    length = std::max(length, x[2]);
  }
  EXPECT_NEAR(radius, 5.5, 1e-14);
  EXPECT_EQ(length, 7);
}

TEST(Artery, WithoutAdventitiaTheWallIsMediaAlone) {
  ArteryOptions options;
  options.adventitia = 0;
  const auto mesh = generate_artery(options);
  EXPECT_EQ(mesh.regions, (std::vector<std::string>{"fluid", "media"}));
  auto needs = test::artery_needs();
  needs.layers = {"media"};
  EXPECT_NO_THROW(check_scene_mesh(mesh, needs, "one layer"));
}

TEST(Artery, DiagonalsLeanBothWaysAroundTheTube) {
  const auto mesh = test::coarse_artery();
  int left = 0, right = 0;
  for (const auto& facet : *mesh.facets("outer"))
    for (int i = 0; i < 3; ++i) {
      const Point &a = mesh.nodes[facet[i]], &b = mesh.nodes[facet[(i + 1) % 3]];
      const double around = a[0] * b[1] - a[1] * b[0], along = b[2] - a[2];
      if (std::abs(around) < 1e-9 || std::abs(along) < 1e-9) continue;
      ++(around * along > 0 ? right : left);
    }
  EXPECT_EQ(left, right);
  EXPECT_GT(left, 0);
}

void expect_refused(const ArteryOptions& options, const std::string& message) {
  try {
    generate_artery(options);
    FAIL() << "accepted: " << message;
  } catch (const InputError& error) {
    EXPECT_EQ(std::string(error.what()).substr(0, message.size()), message);
  }
}

TEST(Artery, RefusesWhatIsNoTube) {
  ArteryOptions options;
  options.inner_radius = -1;
  expect_refused(options, "fsi-mesh: --inner-radius: -1 mm will not do; give a positive radius");
  options = {};
  options.media = 0;
  expect_refused(options, "fsi-mesh: --media: 0 mm will not do; give a positive thickness");
  options = {};
  options.adventitia = std::numeric_limits<double>::quiet_NaN();
  expect_refused(options, "fsi-mesh: --adventitia: nan mm will not do");
  options = {};
  options.length = std::numeric_limits<double>::infinity();
  expect_refused(options, "fsi-mesh: --length: inf mm will not do");
  options = {};
  options.axial_size = 0;
  expect_refused(options, "fsi-mesh: --axial-size: 0 mm will not do");
  options = {};
  options.size = 1e-5;
  expect_refused(options, "fsi-mesh: --size: 1e-05 mm asks for 3.01e+17 nodes");
  options = {};
  options.media = 1e-9;
  expect_refused(options, "fsi-mesh: --size: tetrahedra of mean ratio");
  try {
    artery_level("course");
    FAIL();
  } catch (const InputError& error) {
    EXPECT_STREQ(
        error.what(),
        "fsi-mesh: --level: there is no level 'course'; nearest: coarse; levels are coarse, intermediate or fine");
  }
}

}  // namespace
}  // namespace fsi
