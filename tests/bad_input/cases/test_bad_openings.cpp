// Mistakes in [[opening]]: one message each, with place, problem and remedy; and what is read of right ones.

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "base/error.hpp"
#include "case/case_hash.hpp"
#include "case/case_reader.hpp"
#include "case/openings.hpp"
#include "support/messages.hpp"
#include "support/temporary_folder.hpp"

namespace fsi::test {

namespace {

/// A rigid pipe with these openings.
std::string case_with(const std::string& openings) {
  return "[mesh]\nlevel = \"coarse\"\n[fluid]\ndensity = 1.0\nviscosity = 1.0\n[time]\nstep = 1.0\nend = 2000.0\n" +
         openings;
}

class Openings : public FolderTest {
 protected:
  Case read(const std::string& openings, const std::vector<std::string>& overrides = {}) const {
    return parse_case(case_with(openings), folder_ / "case.toml", overrides);
  }
  std::string complaint(const std::string& openings, const std::vector<std::string>& overrides = {}) const {
    const std::string said = message_of<InputError>([&] { read(openings, overrides); });
    const std::string place = folder_.string() + "/";
    const auto at = said.find(place);
    return at == std::string::npos ? said : said.substr(0, at) + said.substr(at + place.size());
  }
};

std::string opening(const std::string& keys) {
  return "[[opening]]\nsurface = \"left\"\n" + keys + "\n";
}

TEST_F(Openings, AreReadByName) {
  write_text(folder_ / "p.csv", "t,p\r\n0, 1\r\n 4,3e0\n\n");
  const Case setup = read(
      "[[opening]]\nsurface = \"b\"\npressure = { file = \"p.csv\" }\nperiod = 4\n"
      "[[opening]]\nsurface = \"a\"\nflow_rate = 2\nuntil = 3\nprofile = \"plug\"\n"
      "[[opening]]\nsurface = \"c\"\nresistance = 5\ndistal_pressure = -1\n"
      "[[opening]]\nsurface = \"d\"\nwindkessel = { proximal = 0, compliance = 2, distal = 3, initial_pressure = 4 }\n"
      "[[opening]]\nsurface = \"e\"\n",
      {"opening.c.resistance=6"});
  const auto all = openings_of(setup);
  ASSERT_EQ(all.size(), 6u);
  const std::vector<std::string> names{"a", "b", "c", "d", "e", "outlet"};
  for (std::size_t i = 0; i < all.size(); ++i) EXPECT_EQ(all[i].surface, names[i]);
  using Points = std::vector<std::pair<double, double>>;
  EXPECT_EQ(all[0].flow_rate->table.points, (Points{{0, 2}, {3, 2}, {3, 0}}));
  EXPECT_EQ(all[0].flow_rate->profile, InflowProfile::plug);
  EXPECT_EQ(all[1].pressure->points, (Points{{0, 1}, {4, 3}}));
  EXPECT_EQ(all[1].pressure->period, 4);
  EXPECT_EQ(all[2].law->name, "resistance");
  EXPECT_EQ(all[2].law->values, (ParameterValues{{"resistance", 6}, {"distal_pressure", -1}}));
  EXPECT_TRUE(all[2].law->make()->start().empty());
  EXPECT_EQ(all[3].law->make()->start(), std::vector<double>{4});
  EXPECT_TRUE(all[4].is_free());
  EXPECT_TRUE(all[4].demanded);
  EXPECT_FALSE(all[5].demanded) << "the mesh may have no outlet";
}

TEST_F(Openings, CountInTheHash) {
  const auto hash = [&](const std::string& openings) { return hash_of_case(read(openings)); };
  std::vector<std::string> hashes;
  write_text(folder_ / "p.csv", "t,p\n0,1\n4,3\n");
  for (const std::string keys :
       {"", "pressure = 1", "pressure = { file = \"p.csv\" }", "pressure = { file = \"p.csv\" }\nperiod = 4",
        "flow_rate = 1", "flow_rate = 1\nprofile = \"plug\"", "resistance = 1", "resistance = 2",
        "windkessel = { proximal = 1, compliance = 1, distal = 1 }"})
    hashes.push_back(hash(opening(keys)));
  const std::string from_file = hashes[2];
  EXPECT_EQ(hash(opening("pressure = [[0, 1], [4, 3]]")), from_file) << "the numbers count, not where they stand";
  std::sort(hashes.begin(), hashes.end());
  EXPECT_EQ(std::unique(hashes.begin(), hashes.end()), hashes.end());
}

TEST_F(Openings, AreRefusedWithOneMessage) {
  write_text(folder_ / "words.csv", "time,flow\n0,1\n1,two\n");
  write_text(folder_ / "bare.csv", "0,1\n1,2\n");
  write_text(folder_ / "back.csv", "time,flow\n1,1\n0,2\n");
  write_text(folder_ / "empty.csv", "time,flow\n");
  struct Mistake {
    std::string keys, message;
  };
  const std::string windkessel = "windkessel = { proximal = 1, compliance = 1, distal = 1 }";
  const std::vector<Mistake> mistakes{
      {"pressure = 1\nresistance = 2",
       "case.toml:12: opening.left.resistance: stands beside pressure; keep one of them: what happens here has one "
       "cause"},
      {"resistance = -2",
       "case.toml:11: opening.left.resistance: -2 is negative; give a number >= 0 (pressure over "
       "outward flow in kPa ms/mm^3, in place of a pressure)"},
      {"windkessel = { proximal = 1, compliance = -1, distal = 1 }",
       "case.toml:11: opening.left.windkessel.compliance: -1 is not positive; give a number > 0 (in mm^3/kPa)"},
      {"windkessel = { proximal = 1, compliance = 1 }",
       "case.toml:11: opening.left.windkessel.distal: missing; add it (resistance behind the compliance in kPa "
       "ms/mm^3)"},
      {windkessel + "\ndistal_pressure = 1",
       "case.toml:12: opening.left.distal_pressure: stands beside windkessel; put it into the section windkessel"},
      {"presure = 1", "case.toml:11: opening.left.presure: unknown key; did you mean opening.left.pressure?"},
      {"pressure = [[0, 1], [5, 2]]\nperiod = 4",
       "case.toml:12: opening.left.period: 4 is shorter than the table, which ends at 5 ms; give at least 5, or a "
       "shorter table"},
      {"pressure = 1\nperiod = 4",
       "case.toml:12: opening.left.period: stands beside a pressure that never changes; "
       "remove it, or give a table"},
      {"resistance = 1\nperiod = 4",
       "case.toml:12: opening.left.period: belongs to pressure or flow_rate; remove it, "
       "or give pressure or flow_rate as well"},
      {"pressure = [[0, 1], [0.01, 2]]\nperiod = 0.01",
       "case.toml:12: opening.left.period: the table would jump 2e+05 times in 2000 ms, and end a step each time; give "
       "a longer period, or a table without jumps whose last value is its first"},
      {"flow_rate = { file = \"words.csv\" }",
       "words.csv:3: opening.left.flow_rate.file: is no row of two numbers; give a CSV file with a header and two "
       "columns, time in ms and flow_rate in mm^3/ms"},
      {"flow_rate = { file = \"bare.csv\" }",
       "bare.csv:1: opening.left.flow_rate.file: the first line is a row of numbers; put a header above it, like "
       "time_ms,flow_rate"},
      {"flow_rate = { file = \"back.csv\" }",
       "back.csv:3: opening.left.flow_rate.file: 0,2 comes before the time 1 of the row above; sort the table by time"},
      {"flow_rate = [[0, 1], [1, 2]]\nprofile = \"womersley\"",
       "case.toml:12: opening.left.profile: \"womersley\" is the profile of a flow rate that repeats itself; give "
       "period, or profile = \"parabolic\""},
      {"pressure = 1\nprofile = \"plug\"",
       "case.toml:12: opening.left.profile: belongs to flow_rate; remove it, or give flow_rate as well"},
      {"flow_rate = 1\nbackflow = 0.2",
       "case.toml:12: opening.left.backflow: stands beside flow_rate, which says what "
       "enters; remove it"},
      {"backflow = -1",
       "case.toml:11: opening.left.backflow: -1 is negative; give a number >= 0 (factor of the "
       "stabilisation against fluid that enters where its flow is not given, 0: none; default 0.5, which "
       "lets no kinetic energy in)"},
      {"flow_rate = 1\nprofile = \"plugg\"",
       "case.toml:12: opening.left.profile: \"plugg\" is unknown; did you mean "
       "plug? There are plug, parabolic, biparabolic or womersley"},
  };
  for (const std::string symbol : {"Rp", "R1", "r_p"})
    EXPECT_EQ(complaint(opening("windkessel = { " + symbol + " = 1, C = 1, Rd = 1 }")),
              "case.toml:11: opening.left.windkessel." + symbol +
                  ": unknown key; did you mean proximal? There are proximal (Rp), compliance (C), distal (Rd), "
                  "initial_pressure and distal_pressure");
  EXPECT_NE(complaint(opening("windkessel = { proximal = 1, C = 1, Rd = 1 }")).find("did you mean compliance?"),
            std::string::npos);
  for (const auto& [keys, message] : mistakes) EXPECT_EQ(complaint(opening(keys)), message);
  const std::string missing = complaint(opening("pressure = { file = \"none.csv\" }"));
  EXPECT_NE(missing.find("none.csv: no such file; give a CSV file with a header"), std::string::npos) << missing;
  EXPECT_EQ(missing.find("give a CSV file"), missing.rfind("give a CSV file")) << missing;
  EXPECT_NE(complaint(opening("pressure = { file = \"empty.csv\" }")).find("has no row below its header"),
            std::string::npos);
  EXPECT_NE(complaint(opening("pressure = { file = \".\" }")).find("cannot be read"), std::string::npos);
  EXPECT_EQ(complaint("[inlet]\npressure = 1\n[[opening]]\nsurface = \"inlet\"\n"),
            "case.toml:11: opening.inlet: stands beside [inlet]; keep one of the two");
  EXPECT_EQ(complaint("[[opening]]\nsurface = \"a,b\"\n"),
            "case.toml:9: opening.a,b: has a comma in its name, which openings.csv could not show; give the surface a "
            "name without");
  EXPECT_EQ(complaint(""),
            "case.toml: no [inlet]; add [inlet] with pressure, since there is a fluid, or [[opening]]; for a fluid "
            "that nothing enters or leaves, "
            "closed = [...] in [fluid] with the names of its surfaces, [] where the wall encloses it");
}

TEST_F(Openings, HeadersWithUnitsOfSomethingElseAreRefused) {
  const auto said = [&](const std::string& header, const std::string& keys = "flow_rate = { file = \"a.csv\" }") {
    write_text(folder_ / "a.csv", header + "\n0,1\n1,2\n");
    return complaint(opening(keys));
  };
  EXPECT_EQ(said("time_ms,flow_mmHg"),
            "a.csv:1: opening.left.flow_rate.file: column 2: mmHg is a unit of pressure, not of flow rate; give it in "
            "mm^3/ms: mm3/ms, ml/s, L/min, ml/min, cm3/s, mm3/s, m3/s, L/s, cc/s or ul/s");
  EXPECT_EQ(
      said("time_kPa,flow"),
      "a.csv:1: opening.left.flow_rate.file: column 1: kPa is a unit of pressure, not of time; give it in ms: ms, "
      "s, us, min, msec, sec, second, seconds, millisecond, milliseconds, minute or minutes");
  for (const std::string header : {"t,velocity_m_per_s", "t,flow [m/s]", "t,v_cm/s"})
    EXPECT_NE(said(header).find("is a unit of velocity, not of flow rate"), std::string::npos) << said(header);
  for (const std::string header : {"t,flow_gallons_per_min", "t,flow [gpm]", "t,Q (barrels/d)"})
    EXPECT_NE(said(header).find(": column 2: "), std::string::npos) << said(header);
  EXPECT_NE(said("t,flow [gpm]").find("gpm is no known unit of flow rate"), std::string::npos);
  EXPECT_NE(said("t,p_mPa", "pressure = { file = \"a.csv\" }").find("mPa is no known unit"), std::string::npos);
  EXPECT_NE(said("t,flow_mm2_per_ms").find("is a unit of the flow in a plane scene"), std::string::npos);
}

TEST_F(Openings, ClosedSurfacesAreNoOpenings) {
  const auto said = [&](const std::string& closed, const std::string& openings) {
    const std::string place = folder_.string() + "/", text = case_with(openings);
    const auto at = text.find("viscosity");
    std::string message = message_of<InputError>(
        [&] { parse_case(text.substr(0, at) + closed + "\n" + text.substr(at), folder_ / "case.toml", {}); });
    return message.erase(0, message.find(place) == 0 ? place.size() : 0);
  };
  EXPECT_EQ(said("closed = [\"left\"]", opening("pressure = 1")),
            "case.toml:5: fluid.closed: names \"left\", which an [[opening]] opens; keep one of the two");
  EXPECT_EQ(said("closed = [\"inlet\"]", "[inlet]\npressure = 1\n"),
            "case.toml:5: fluid.closed: names \"inlet\", which [inlet] opens; keep one of the two");
  EXPECT_EQ(said("outlet = true\nclosed = [\"outlet\"]", opening("pressure = 1")),
            "case.toml:6: fluid.closed: names \"outlet\" beside outlet = true; keep one of the two");
  EXPECT_EQ(said("closed = [\"a\", \"a\"]", opening("pressure = 1")),
            "case.toml:5: fluid.closed[1]: \"a\" is named twice; name each surface once");
  EXPECT_EQ(said("closed = [\"symmetry_x\"]", opening("pressure = 1")),
            "case.toml:5: fluid.closed[0]: \"symmetry_x\" is the name of a plane of symmetry, where the fluid slides; "
            "leave it out");
}

}  // namespace

}  // namespace fsi::test
