// Windkessels in the clinic's units are noticed, those in the right ones are not.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "case/case_reader.hpp"

namespace fsi::test {

namespace {

// A beat of 800 ms with a mean of 5 ml/s: triangles from 0 to 10.
constexpr const char* inflow = "surface = \"inlet\"\nflow_rate = [[0, 0], [400, 10], [800, 0]]\nperiod = 800\n";

std::vector<std::string> warnings(const std::string& windkessel, const std::string& more = inflow) {
  return parse_case(
             "[mesh]\nfile = \"a.msh\"\n[fluid]\ndensity = 1.06\nviscosity = 3.5e-3\n[time]\nstep = 1.0\n"
             "end = 4000.0\n[[opening]]\n" +
                 more + "[[opening]]\nsurface = \"outlet\"\nwindkessel = " + windkessel + "\n",
             "case.toml")
      .warnings;
}

// 100 mmHg at 5 ml/s: 20 mmHg s/ml, 2.67 kPa ms/mm^3; with 1.4 s a compliance of 0.075 ml/mmHg, 560 mm^3/kPa.
constexpr const char* right = "{ proximal = 0.2, compliance = 560, distal = 2.46 }";

TEST(WindkesselUnits, RightOnesAreNotDoubted) {
  EXPECT_TRUE(warnings(right).empty());
  EXPECT_TRUE(warnings("{ proximal = 0.2, compliance = 560, distal = 2.46, initial_pressure = 10.7 }").empty());
  // A start from a low pressure: what the flow raises in the end is no vessel's excess.
  EXPECT_TRUE(warnings("{ proximal = 0.2, compliance = 560, distal = 2.46, initial_pressure = 1.9 }").empty());
  // Of a short run without a period, as in gallery/bifurcation.
  EXPECT_TRUE(warnings("{ proximal = 0.2, compliance = 5, distal = 2 }",
                       "surface = \"inlet\"\nflow_rate = [[0, 0], [4, 2], [20, 2]]\n")
                  .empty());
}

TEST(WindkesselUnits, BothInTheClinicsUnits) {
  const auto said = warnings("{ proximal = 1.5, compliance = 0.075, distal = 18.5 }");
  ASSERT_EQ(said.size(), 2u);
  EXPECT_NE(
      said[0].find("opening.outlet.windkessel: the mean flow would raise 100 kPa behind the outlets, as resistances "
                   "in mmHg s/ml do; multiply such resistances by 0.133322: kPa ms/mm^3 are expected"),
      std::string::npos)
      << said[0];
  EXPECT_NE(
      said[1].find("distal times compliance is 1.39 ms beside 800 ms of a period, which looks like a number of "
                   "seconds; multiply resistances in mmHg s/ml by 0.133322 and compliances in ml/mmHg by 7500.64"),
      std::string::npos)
      << said[1];
}

TEST(WindkesselUnits, ResistancesAlone) {
  const auto said = warnings("{ proximal = 1.5, compliance = 560, distal = 18.5 }");
  ASSERT_EQ(said.size(), 1u);
  EXPECT_NE(said[0].find("as resistances in mmHg s/ml do"), std::string::npos);
  // At rest 100 mmHg, given as 13.3 kPa: a smaller flow shows it by that.
  const auto beside = warnings("{ proximal = 1.5, compliance = 560, distal = 18.5, initial_pressure = 6.7 }",
                               "surface = \"inlet\"\nflow_rate = [[0, 0], [400, 5], [800, 0]]\nperiod = 800\n");
  ASSERT_EQ(beside.size(), 1u);
  EXPECT_NE(beside[0].find("would raise 50 kPa"), std::string::npos) << beside[0];
}

TEST(WindkesselUnits, ComplianceAlone) {
  const auto said = warnings("{ proximal = 0.2, compliance = 0.075, distal = 2.46 }");
  ASSERT_EQ(said.size(), 1u) << "0.18 ms";
  EXPECT_NE(said[0].find("multiply a compliance in ml/mmHg by 7500.64: mm^3/kPa are expected"), std::string::npos);
}

TEST(WindkesselUnits, ByTheTimeConstantWhereNoFlowIsGiven) {
  const auto said = warnings("{ proximal = 1.5, compliance = 0.075, distal = 18.5 }",
                             "surface = \"inlet\"\npressure = [[0, 10], [400, 16], [800, 10]]\nperiod = 800\n");
  ASSERT_EQ(said.size(), 1u);
  EXPECT_NE(said[0].find("distal times compliance is 1.39 ms"), std::string::npos);
  EXPECT_TRUE(
      warnings(right, "surface = \"inlet\"\npressure = [[0, 10], [400, 16], [800, 10]]\nperiod = 800\n").empty());
}

}  // namespace

}  // namespace fsi::test
