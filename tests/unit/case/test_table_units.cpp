// Units in the headers of CSV tables: found in many spellings, converted, and said.

#include <gtest/gtest.h>

#include <string>

#include "base/error.hpp"
#include "case/case_reader.hpp"
#include "case/network_data.hpp"
#include "case/table_units.hpp"
#include "support/temporary_folder.hpp"

namespace fsi::test {

namespace {

double factor(const char* header, ColumnKind kind) {
  const auto unit = column_unit(header, kind);
  return unit ? unit->factor : 0;  // 0: none is named
}

TEST(TableUnits, AreFoundInManySpellings) {
  for (const char* header : {"time_ms", "t [ms]", "time (ms)", "ms", "t ms"})
    EXPECT_EQ(factor(header, ColumnKind::time), 1) << header;
  for (const char* header : {"time_s", "t [s]", "Time (s)", "s", "time_sec", "time_seconds", "Seconds"})
    EXPECT_EQ(factor(header, ColumnKind::time), 1000) << header;
  for (const char* header : {"flow_ml_per_s", "flow_mL/s", "Q [ml/s]", "flow_cm^3_per_s", "q cm3/s", "flow [ml s^-1]",
                             "flow_mm3_per_ms", "flow_mm^3/ms", "\"flow [ml/s]\"", "flow rate [ml/s]"})
    EXPECT_EQ(factor(header, ColumnKind::flow_rate), 1) << header;
  // A litre is 10^6 mm^3, a minute 60,000 ms.
  for (const char* header : {"flow_L_per_min", "Q (l/min)", "L/min"})
    EXPECT_NEAR(factor(header, ColumnKind::flow_rate), 1e6 / 6e4, 1e-12) << header;
  for (const char* header : {"p_mmHg", "pressure [mmHg]", "mmHg", "pressure_MMHG"})
    EXPECT_EQ(factor(header, ColumnKind::pressure), 0.133322) << header;  // 13.5951 g/cm^3 by 9.80665 m/s^2
  EXPECT_EQ(factor("p_Pa", ColumnKind::pressure), 1e-3);
  EXPECT_EQ(factor("p_MPa", ColumnKind::pressure), 1e3);
  EXPECT_EQ(factor("p_kPa", ColumnKind::pressure), 1);
  EXPECT_EQ(factor("p_dyn/cm^2", ColumnKind::pressure), 1e-4);
}

TEST(TableUnits, OfPlaneScenes) {
  EXPECT_EQ(factor("flow_mm2_per_ms", ColumnKind::flow_rate_of_depth), 1);
  EXPECT_EQ(factor("flow_mm3_per_ms", ColumnKind::flow_rate_of_depth), 1) << "through 1 mm of thickness";
  EXPECT_EQ(factor("flow_m2_per_s", ColumnKind::flow_rate_of_depth), 1000);
}

TEST(TableUnits, NamesWithoutUnitsStay) {
  for (const char* header : {"t", "time", "time_of_beat", ""}) EXPECT_EQ(factor(header, ColumnKind::time), 0) << header;
  for (const char* header : {"p", "pressure", "pressure_at_inlet", "value"})
    EXPECT_EQ(factor(header, ColumnKind::pressure), 0) << header;
  for (const char* header : {"q", "flow", "flow_rate", "inflow_left"})
    EXPECT_EQ(factor(header, ColumnKind::flow_rate), 0) << header;
}

class TableFiles : public FolderTest {
 protected:
  Case read(const std::string& csv, const std::string& key, const std::string& geometry = "") {
    write_text(folder_ / "a.csv", csv);
    return parse_case(geometry +
                          "[mesh]\nfile = \"a.msh\"\n[fluid]\ndensity = 1.0\nviscosity = 1.0\n[time]\nstep = 1.0\n"
                          "end = 800.0\n[[opening]]\nsurface = \"left\"\n" +
                          key + " = { file = \"a.csv\" }\n",
                      folder_ / "case.toml");
  }
};

TEST_F(TableFiles, AreConvertedAndSaid) {
  using Points = std::vector<std::pair<double, double>>;
  const Case flow = read("time_s,flow_L_per_min\n0,0\n0.25,6\n", "flow_rate");
  EXPECT_EQ(flow.openings.at("left").flow_rate->table.points, (Points{{0, 0}, {250, 100}}));
  ASSERT_EQ(flow.remarks.size(), 1u);
  EXPECT_EQ(flow.remarks[0],
            "opening.left.flow_rate.file: the file has times in s, times 1000 in ms; flow rates in L_per_min, times "
            "16.6667 in mm^3/ms");
  const Case pressure = read("t;p [mmHg]\n0;100\n1;200\n", "pressure");
  EXPECT_EQ(pressure.openings.at("left").pressure->points, (Points{{0, 100 * 0.133322}, {1, 200 * 0.133322}}));
  EXPECT_EQ(pressure.remarks.size(), 1u);
  EXPECT_TRUE(pressure.warnings.empty());
  const Case marked = read("\xEF\xBB\xBFs,mmHg\n0,100\n1,200\n", "pressure");
  EXPECT_EQ(marked.openings.at("left").pressure->points.back(), std::pair(1000.0, 200 * 0.133322));
}

TEST_F(TableFiles, InTheRightUnitsSayNothing) {
  EXPECT_TRUE(read("time_ms,pressure_kPa\n0,1\n1,2\n", "pressure").remarks.empty());
  EXPECT_TRUE(read("time,flow\n0,1\n1,2\n", "flow_rate").remarks.empty());
  EXPECT_TRUE(read("t,q_mm2_per_ms\n0,1\n", "flow_rate", "geometry = \"plane\"\n").remarks.empty());
}

TEST_F(TableFiles, OfPlaneScenesHaveFlowsOfDepthInNetworksToo) {
  const std::string plane = "geometry = \"plane\"\n";
  const std::string elements =
      "[[network.element]]\nname = \"leak\"\nkind = \"resistor\"\nbetween = [\"left\", \"ground\"]\nresistance = 1\n"
      "[[network.element]]\nname = \"pump\"\nkind = \"flow\"\nbetween = [\"ground\", \"left\"]\nflow_rate";
  const Case setup = read("t,q_m2_per_s\n0,1\n1,2\n", elements, plane);
  ASSERT_TRUE(setup.network);
  EXPECT_EQ(setup.network->elements.at(1).course->points.back(), std::pair(1.0, 2000.0));
}

TEST_F(TableFiles, WithoutAUnitAreDoubtedAsNumbersAre) {
  const Case setup = read("time,pressure\n0,100\n1,120\n", "pressure");
  ASSERT_EQ(setup.warnings.size(), 1u);
  EXPECT_NE(setup.warnings[0].find("looks like a value in mmHg"), std::string::npos);
}

TEST_F(TableFiles, TakeUnitsFromKeysBesideThem) {
  using Points = std::vector<std::pair<double, double>>;
  const auto of = [&](const std::string& value) {
    return parse_case(
        "[mesh]\nfile = \"a.msh\"\n[fluid]\ndensity = 1.0\nviscosity = 1.0\n[time]\nstep = 1.0\nend = "
        "800.0\n[[opening]]\nsurface = \"left\"\npressure = " +
            value + "\n",
        folder_ / "case.toml");
  };
  const Points expected{{0, 100 * 0.133322}, {250, 80 * 0.133322}};
  const std::string units = R"(, time_unit = "s", value_unit = "mmHg" })";
  write_text(folder_ / "a.csv", "t,p\n0,100\n0.25,80\n");
  const Case file = of(R"({ file = "a.csv")" + units), rows = of("{ rows = [[0, 100], [0.25, 80]]" + units);
  for (const Case* setup : {&file, &rows}) {
    EXPECT_EQ(setup->openings.at("left").pressure->points, expected);
    ASSERT_EQ(setup->remarks.size(), 1u);
    EXPECT_NE(setup->remarks[0].find("times in s, times 1000 in ms; pressures in mmHg, times 0.133322 in kPa"),
              std::string::npos)
        << setup->remarks[0];
    EXPECT_TRUE(setup->warnings.empty());
  }
  const auto refused = [&](const std::string& value) -> std::string {
    try {
      of(value);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_NE(refused(R"({ rows = [[0, 1]], time_unit = "hours" })").find("is no known unit; give ms, s"),
            std::string::npos);
  EXPECT_NE(refused(R"({ rows = [[0, 1]], value_unit = "ml/s" })").find("is a unit of flow rate, not of pressure"),
            std::string::npos);
  EXPECT_NE(refused(R"({ rows = [[0, 1]], file = "a.csv" })").find("stands beside file"), std::string::npos);
  write_text(folder_ / "a.csv", "t_ms,p\n0,100\n");
  EXPECT_NE(refused(R"({ file = "a.csv", time_unit = "s" })").find("column 1 is in ms, but time_unit = \"s\""),
            std::string::npos);
}

TEST_F(TableFiles, InSecondsWithoutAWordAreNoticed) {
  const std::string beat = "t,flow\n0,1\n0.2,5\n0.4,3\n0.8,1\n";
  const Case one = read(beat, "flow_rate");
  ASSERT_EQ(one.warnings.size(), 1u);
  EXPECT_NE(one.warnings[0].find("opening.left.flow_rate: the table ends at 0.8 ms, within the first step of 1 ms: its "
                                 "times look like seconds"),
            std::string::npos)
      << one.warnings[0];
  const Case periodic = read(beat, "period = 800.0\nflow_rate");
  ASSERT_EQ(periodic.warnings.size(), 1u);
  EXPECT_NE(periodic.warnings[0].find("ends at 0.8 ms beside a period of 800 ms"), std::string::npos);
  EXPECT_TRUE(read("t_s,flow\n0,1\n0.2,5\n0.4,3\n0.8,1\n", "period = 800.0\nflow_rate").warnings.empty());
  EXPECT_TRUE(read("t,flow\n0,1\n200,5\n400,3\n750,1\n", "period = 800.0\nflow_rate").warnings.empty());
  EXPECT_TRUE(read("t,flow\n0,0\n1,5\n2,3\n3,1\n", "flow_rate").warnings.empty()) << "a start of three steps";
}

}  // namespace

}  // namespace fsi::test
