#include <gtest/gtest.h>

#include <functional>

#include "base/error.hpp"
#include "mesher/artery/recommended_meshes.hpp"

namespace fsi {
namespace {

const AskedFor asked{"fsi-mesh", "--for", "--error"};

TEST(RecommendedMeshes, StandFromFewNodesToManyAndFromLargeErrorToSmall) {
  const RecommendedMesh* before = nullptr;
  for (const auto& mesh : recommended_meshes()) {
    SCOPED_TRACE(to_text(mesh));
    EXPECT_EQ(mesh.cells.around % 4, 0);  // so that a quarter can be made
    if (before && before->element == mesh.element && before->axisymmetric == mesh.axisymmetric &&
        before->waves == mesh.waves) {
      const auto nodes = [](const ArteryCells& c) {
        return (c.lumen + c.media + c.adventitia) * c.around * (c.axial + 1);
      };
      EXPECT_GT(nodes(mesh.cells), nodes(before->cells));
      EXPECT_LT(mesh.error(), before->error());  // else nobody would take it
    }
    before = &mesh;
  }
}

TEST(RecommendedMeshes, TheCheapestGoodEnoughOneIsTaken) {
  for (const auto& mesh : recommended_meshes()) {
    EXPECT_EQ(&recommended_mesh(mesh.element, mesh.axisymmetric, mesh.waves, mesh.error(), asked), &mesh);
    const auto& looser = recommended_mesh(mesh.element, mesh.axisymmetric, mesh.waves, 100, asked);
    EXPECT_GE(looser.error(), mesh.error());
  }
}

TEST(RecommendedMeshes, ThreeAndTenPercentAreTwoMeshesThatLeaveNotMuchLess) {
  for (const bool axisymmetric : {true, false})
    for (const auto waves : {Waves::damped, Waves::resolved}) {
      SCOPED_TRACE(axisymmetric ? "axisymmetric, " + wave_kinds().name_of(waves) : wave_kinds().name_of(waves));
      const auto& fine = recommended_mesh("p2p1", axisymmetric, waves, 3, asked);
      const auto& coarse = recommended_mesh("p2p1", axisymmetric, waves, 10, asked);
      EXPECT_NE(&fine, &coarse);
      EXPECT_GT(fine.error(), 1);
      EXPECT_GT(coarse.error(), 10.0 / 3);
    }
}

std::string refusal(const std::function<void()>& call) {
  try {
    call();
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

TEST(RecommendedMeshes, RefusesWhatTheyCannotDo) {
  EXPECT_EQ(refusal([] {
              recommended_mesh("p2p1", true, Waves::damped, 0.001, asked);
            }).find("fsi-mesh: --error: 0.001% is less than any"),
            0u);
  EXPECT_EQ(refusal([] { recommended_mesh("p3", true, Waves::damped, 3, asked); }),
            "fsi-mesh: --for: there are no meshes recommended for 'p3'; there are for p2p1");
}

TEST(RecommendedMeshes, ErrorsArePercentages) {
  EXPECT_EQ(percent_of("3%"), 3);
  EXPECT_EQ(percent_of("0.5 %"), 0.5);
  for (const char* text : {"3", "", "%", "-1%", "0%", "nan%", "3%%", "3% ", "three%", "inf%"})
    EXPECT_EQ(percent_of(text), std::nullopt) << text;
}

}  // namespace
}  // namespace fsi
