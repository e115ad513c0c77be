#include <gtest/gtest.h>

#include <functional>

#include "base/error.hpp"
#include "mesher/artery_generator.hpp"
#include "meshes/artery_request.hpp"

namespace fsi {
namespace {

/// The coarse level, three millimetres of it.
ArteryRequest short_request() {
  ArteryRequest request;
  static_cast<ArteryOptions&>(request.sizes) = artery_level("coarse");
  request.sizes.length = 3;
  return request;
}

template <int Dim, int Order>
SimplexMesh<Dim, Order> made(const ArteryRequest& request) {
  return std::get<SimplexMesh<Dim, Order>>(make_artery(request));
}

TEST(ArteryRequest, SizesAloneGiveTheMeshOfTheLevels) {
  const auto request = short_request();
  const auto mesh = made<3, 1>(request), level = generate_artery(request.sizes);
  EXPECT_EQ(mesh.nodes, level.nodes);
  EXPECT_EQ(mesh.cells, level.cells);
}

TEST(ArteryRequest, OrderTwoKeepsTheNodesOfTheLevel) {
  auto request = short_request();
  request.order = 2;
  const auto mesh = made<3, 2>(request);
  const auto level = generate_artery(request.sizes);
  ASSERT_EQ(mesh.cells.size(), level.cells.size());
  EXPECT_TRUE(std::equal(level.nodes.begin(), level.nodes.end(), mesh.nodes.begin()));
}

TEST(ArteryRequest, NumbersThatAreNotGivenFollowFromTheSizes) {
  auto request = short_request();
  request.axisymmetric = true;  // coarse: 2 cells through the lumen, 1 and 1 through the layers, 4 along 3 mm
  EXPECT_EQ((made<2, 1>(request).nodes.size()), 5u * 5);
  request.media_cells = 3;
  EXPECT_EQ((made<2, 1>(request).nodes.size()), 7u * 5);
  request.axial_cells = 6;
  request.order = 2;
  EXPECT_EQ((made<2, 2>(request).nodes.size()), 13u * 13);
}

TEST(ArteryRequest, EveryNumberGoesWhereItsNameSays) {
  auto request = short_request();
  request.lumen_cells = 5;
  request.media_cells = 3;
  request.adventitia_cells = 2;
  request.around = 16;
  request.axial_cells = 7;
  request.axial_grading = 3;
  request.lumen_grading = 2;
  ArteryCells cells;
  cells.lumen = 5;
  cells.media = 3;
  cells.adventitia = 2;
  cells.around = 16;
  cells.axial = 7;
  cells.axial_grading = 3;
  cells.lumen_grading = 2;
  const auto expected = generate_artery(request.sizes, cells);
  const auto mesh = made<3, 1>(request);
  EXPECT_EQ(mesh.nodes, expected.nodes);
  EXPECT_EQ(mesh.cells, expected.cells);
}

TEST(ArteryRequest, MirroredSectorsAreTheWholeTube) {
  auto request = short_request();
  for (const int degrees : {30, 45, 60, 90, 180}) {
    SCOPED_TRACE(degrees);
    request.sector = degrees;
    request.mirrored = false;
    const auto part = made<3, 1>(request);
    request.mirrored = true;
    const auto whole = made<3, 1>(request);
    EXPECT_EQ(whole.cells.size(), part.cells.size() * (360 / degrees));
    for (const char* plane : {"symmetry_x", "symmetry_y", "symmetry_1"}) EXPECT_EQ(whole.facets(plane), nullptr);
  }
}

TEST(ArteryRequest, SizesThatASectorDoesNotDivideAreMadeALittleFiner) {
  auto request = short_request();
  request.sizes.size = 0.5;  // 18 cells around
  request.sector = 90;
  EXPECT_EQ((made<3, 1>(request).facets("outer")->size()), 2u * 5 * (4));
}

TEST(ArteryRequest, RecommendedMeshIsQuadraticUnlessStraightEdgesAreAskedFor) {
  auto request = short_request();
  request.for_element = "p2p1";
  request.axisymmetric = true;
  request.axial_cells = 4;
  EXPECT_TRUE((std::holds_alternative<SimplexMesh<2, 2>>(make_artery(request))));
  request.order = 1;
  EXPECT_TRUE((std::holds_alternative<SimplexMesh<2, 1>>(make_artery(request))));
}

TEST(ArteryRequest, EveryRecommendedMeshCanBeMade) {
  for (const auto& mesh : recommended_meshes()) {
    auto request = short_request();
    request.for_element = mesh.element;
    request.error = std::to_string(mesh.error()) + "%";
    request.waves = wave_kinds().name_of(mesh.waves);
    request.axisymmetric = mesh.axisymmetric;
    request.sector = mesh.axisymmetric ? 360 : 90;
    request.order = 1;
    EXPECT_EQ(recommendation(request)->cells.axial, mesh.cells.axial);
    EXPECT_NO_THROW(make_artery(request));
  }
}

void expect_refused(const std::string& message, const std::function<void(ArteryRequest&)>& spoil) {
  auto request = short_request();
  spoil(request);
  try {
    make_artery(request);
    FAIL() << "accepted: " << message;
  } catch (const InputError& error) {
    EXPECT_EQ(std::string(error.what()).substr(0, message.size()), message);
  }
}

TEST(ArteryRequest, RefusesOptionsThatContradictEachOther) {
  expect_refused("fsi-mesh: --sector: an axisymmetric mesh has no sectors", [](auto& r) {
    r.axisymmetric = true;
    r.sector = 90;
  });
  expect_refused("fsi-mesh: --around: an axisymmetric mesh has no cells around the axis", [](auto& r) {
    r.axisymmetric = true;
    r.around = 12;
  });
  expect_refused("fsi-mesh: --mirrored: there is no sector to mirror; give --sector, 90 or 180",
                 [](auto& r) { r.mirrored = true; });
  expect_refused("fsi-mesh: --adventitia-cells: the wall has no adventitia", [](auto& r) {
    r.sizes.adventitia = 0;
    r.adventitia_cells = 2;
  });
  expect_refused("fsi-mesh: --error: belongs to --for", [](auto& r) { r.error = "3%"; });
  expect_refused("fsi-mesh: --order: there are no meshes of order 3; give 1 or 2", [](auto& r) { r.order = 3; });
  expect_refused("fsi-mesh: --mirrored: 3 sectors of 120 degrees are not each other's mirror images all the way round",
                 [](auto& r) {
                   r.sector = 120;
                   r.mirrored = true;
                 });
  expect_refused("fsi-mesh: --sector: 100 degrees will not do", [](auto& r) { r.sector = 100; });
  expect_refused("fsi-mesh: --sector: -90 degrees will not do", [](auto& r) { r.sector = -90; });
  expect_refused("fsi-mesh: --around: 10 cells cannot be shared", [](auto& r) {
    r.sector = 90;
    r.around = 10;
  });
}

}  // namespace
}  // namespace fsi
