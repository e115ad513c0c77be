// Units in the headers of CSV tables: found in many spellings, converted, and said.

#include <gtest/gtest.h>

#include <string>

#include "case/case_reader.hpp"
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
  for (const char* header : {"time_s", "t [s]", "Time (s)", "s", "time_sec"})
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
}

TEST_F(TableFiles, InTheRightUnitsSayNothing) {
  EXPECT_TRUE(read("time_ms,pressure_kPa\n0,1\n1,2\n", "pressure").remarks.empty());
  EXPECT_TRUE(read("time,flow\n0,1\n1,2\n", "flow_rate").remarks.empty());
  EXPECT_TRUE(read("t,q_mm2_per_ms\n0,1\n", "flow_rate", "geometry = \"plane\"\n").remarks.empty());
}

TEST_F(TableFiles, WithoutAUnitAreDoubtedAsNumbersAre) {
  const Case setup = read("time,pressure\n0,100\n1,120\n", "pressure");
  ASSERT_EQ(setup.warnings.size(), 1u);
  EXPECT_NE(setup.warnings[0].find("looks like a value in mmHg"), std::string::npos);
}

}  // namespace

}  // namespace fsi::test
