// Mistakes in [network]: one message each, with place, problem and remedy; and what is read of right ones.

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "base/error.hpp"
#include "case/case_hash.hpp"
#include "case/case_reader.hpp"
#include "case/network_data.hpp"
#include "support/messages.hpp"
#include "support/temporary_folder.hpp"

namespace fsi::test {

namespace {

/// A rigid pipe with two openings and these elements; what follows begins in line 13.
std::string pipe_with(const std::string& text) {
  return "[mesh]\nlevel = \"coarse\"\n[fluid]\ndensity = 1.0\nviscosity = 1.0\n[time]\nstep = 1.0\nend = 20.0\n"
         "[[opening]]\nsurface = \"inlet\"\n[[opening]]\nsurface = \"outlet\"\n" +
         text;
}

std::string element(const std::string& name, const std::string& kind, const std::string& between,
                    const std::string& keys) {
  return "[[network.element]]\nname = \"" + name + "\"\nkind = \"" + kind + "\"\nbetween = [" + between + "]\n" + keys +
         "\n";
}

const std::string to_ground = element("a", "resistor", "\"inlet\", \"ground\"", "resistance = 1") +
                              element("b", "resistor", "\"outlet\", \"ground\"", "resistance = 1");

class Networks : public FolderTest {
 protected:
  Case read(const std::string& text, const std::vector<std::string>& overrides = {}) const {
    return parse_case(pipe_with(text), folder_ / "case.toml", overrides);
  }
  std::string complaint(const std::string& text) const {
    const std::string said = message_of<InputError>([&] { read(text); });
    const std::string place = folder_.string() + "/";
    const auto at = said.find(place);
    return at == std::string::npos ? said : said.substr(0, at) + said.substr(at + place.size());
  }
};

TEST_F(Networks, AreReadByName) {
  write_text(folder_ / "e.csv", "time_s,elastance_mmHg_per_ml\n0,1\n0.4,2\n0.8,1\n");
  const Case setup = read("[network]\nground_pressure = 0.5\n" + to_ground +
                              element("c", "capacitor", "\"inlet\", \"m\"", "compliance = 2\ninitial_pressure = -1") +
                              element("d", "elastance", "\"m\", \"ground\"",
                                      "elastance = { file = \"e.csv\" }\nperiod = 800\ninitial_volume = 3"),
                          {"network.element.b.resistance=7"});
  ASSERT_TRUE(setup.network);
  EXPECT_TRUE(setup.openings.at("inlet").joined);
  EXPECT_FALSE(setup.openings.at("inlet").is_free());
  const auto network = make_network(setup);
  EXPECT_EQ(network->nodes(), (std::vector<std::string>{"inlet", "outlet", "m"}));
  EXPECT_EQ(network->start(), (std::vector<double>{-2, 3}));
  EXPECT_EQ(setup.network->elements[1].values, (ParameterValues{{"resistance", 7}}));
  EXPECT_NEAR(setup.network->elements[3].course->at(400), 2 * 0.133322e-3, 1e-12) << "converted by the header";
  ASSERT_EQ(periods_of_network(setup).size(), 1u);
  EXPECT_EQ(periods_of_network(setup)[0].second, 800);
  const auto said = std::find_if(setup.remarks.begin(), setup.remarks.end(),
                                 [](const std::string& text) { return text.find("network: ") != std::string::npos; });
  ASSERT_NE(said, setup.remarks.end());
  EXPECT_NE(said->find("2 openings, 1 other node, 4 elements in 1 loop, not closed"), std::string::npos) << *said;
}

TEST_F(Networks, CountInTheHash) {
  std::vector<std::string> hashes;
  for (const std::string& text :
       {std::string("[inlet2]"), to_ground, "[network]\nground_pressure = 1\n" + to_ground,
        element("a", "diode", "\"inlet\", \"ground\"", "resistance = 1") +
            element("b", "resistor", "\"outlet\", \"ground\"", "resistance = 1"),
        element("a", "resistor", "\"ground\", \"inlet\"", "resistance = 1") +
            element("b", "resistor", "\"outlet\", \"ground\"", "resistance = 1"),
        to_ground + element("c", "pressure", "\"inlet\", \"ground\"", "pressure = 1"),
        to_ground + element("c", "pressure", "\"inlet\", \"ground\"", "pressure = [[0, 1], [3, 2]]")})
    hashes.push_back(hash_of_case(read(text == "[inlet2]" ? "" : text)));
  std::sort(hashes.begin(), hashes.end());
  EXPECT_EQ(std::unique(hashes.begin(), hashes.end()), hashes.end());
}

TEST_F(Networks, AreRefusedWithOneMessage) {
  struct Mistake {
    std::string text, message;
  };
  const std::string volume = "initial_volume = 1";
  const std::vector<Mistake> mistakes{
      {"[network]\nground_pressure = 1\n",
       "case.toml:13: network.element: missing; add [[network.element]] with name, kind and between, one for each "
       "element"},
      {element("a", "resistor", "\"inlet\", \"ground\"", "resistance = -1"),
       "case.toml:17: network.element.a.resistance: -1 is not positive; give a number > 0 (drop of the pressure over "
       "the flow in "
       "kPa ms/mm^3)"},
      {element("a", "resistor", "\"inlet\", \"ground\"", "resistence = 1"),
       "case.toml:17: network.element.a.resistence: unknown key; did you mean network.element.a.resistance?"},
      {element("a", "capacitor", "\"inlet\", \"ground\"", "resistance = 1"),
       "case.toml:17: network.element.a.resistance: unknown key; "},
      {element("a", "spring", "\"inlet\", \"ground\"", "resistance = 1"),
       "case.toml:15: network.element.a.kind: \"spring\" is unknown; "},
      {element("a", "resistor", "\"inlet\"", "resistance = 1"),
       "case.toml:16: network.element.a.between: is no pair of nodes; give [\"FROM\", \"TO\"]"},
      {to_ground + element("a", "resistor", "\"inlet\", \"ground\"", "resistance = 1"),
       "case.toml:24: network.element[3].name: \"a\" has a [[network.element]] already; give another name"},
      {to_ground + element("c", "resistor", "\"outlett\", \"ground\"", "resistance = 1"),
       "case.toml:26: network.element.c.between: nothing else is joined to the node \"outlett\", which is no "
       "[[opening]]: no fluid can "
       "pass it; join it to one of inlet, outlet, ground, or give \"outlett\" an [[opening]]"},
      {element("a", "resistor", "\"x\", \"ground\"", "resistance = 1") +
           element("b", "resistor", "\"x\", \"ground\"", "resistance = 1"),
       "case.toml:13: network: joins no opening: none of its nodes has the name of one; there are the openings inlet "
       "or outlet"},
      {element("a", "resistor", "\"inlet\", \"outlet\"", "resistance = 1"),
       "case.toml:16: network.element.a.between: no element leads from the node \"inlet\" to the ground: the level of "
       "the "
       "pressure is not determined there; join a capacitor or an elastance between that part of the network and "
       "\"ground\""},
      {element("a", "flow", "\"inlet\", \"ground\"", "flow_rate = 1") +
           element("b", "flow", "\"outlet\", \"ground\"", "flow_rate = 1"),
       "case.toml:16: network.element.a.between: the flows into the node \"inlet\" are all given, by a: it is "
       "over-determined, and its "
       "pressure is not determined; join a capacitor or a resistor to that node"},
      {element("a", "pressure", "\"inlet\", \"ground\"", "pressure = [[0, 1], [1, 1], [1, 2]]"),
       "case.toml:17: network.element.a.pressure: jumps, also where a period ends with another value than it begins "
       "with; let it "
       "change within a time that a few steps resolve"},
      {element("a", "elastance", "\"inlet\", \"ground\"", "elastance = { file = \"e.csv\" }\nperiod = 8\n" + volume),
       "e.csv: no such file; give a CSV file with a header and two columns, time in ms and elastance in kPa/mm^3"},
      {element("a", "pressure", "\"inlet\", \"ground\"", "pressure = 1") +
           element("b", "pressure", "\"inlet\", \"ground\"", "pressure = 2") +
           element("c", "resistor", "\"outlet\", \"ground\"", "resistance = 1"),
       "case.toml:21: network.element.b.between: closes a loop of elements that each give a difference of pressure "
       "(sources, capacitors, elastances): it is over-determined; put a resistor into the loop, or replace these "
       "elements by one"},
      {element("a", "elastance", "\"inlet\", \"ground\"", "elastance = [[0, 1], [1, 0]]\n" + volume),
       "case.toml:17: network.element.a.elastance: is 0 at 1 ms, which is not positive; give elastances > 0"},
      {element("a", "chamber", "\"inlet\", \"ground\"",
               "minimum = 1\nmaximum = 2\nperiod = 10\npeak = 4\nrelaxed = 3\n" + volume),
       "case.toml:21: network.element.a.relaxed: 3 ms are not behind peak, 4 ms; give a later time"},
      {to_ground + "[inlet]\npressure = 1\n", "opening.inlet: stands beside [inlet]; keep one of the two"},
  };
  for (const Mistake& mistake : mistakes) {
    const std::string said = complaint(mistake.text);
    EXPECT_NE(said.find(mistake.message), std::string::npos) << said << "\nnot\n" << mistake.message;
    EXPECT_EQ(said.find('\n'), std::string::npos) << said;
  }
}

TEST_F(Networks, LeaveNoOpeningTwoCauses) {
  const auto refused = [&](const std::string& keys, const std::string& time) {
    const std::string text =
        "[mesh]\nlevel = \"coarse\"\n[fluid]\ndensity = 1.0\nviscosity = 1.0\n[time]\nstep = 1.0\nend = 20.0\n" + time +
        "[[opening]]\nsurface = \"inlet\"\n" + keys + to_ground;
    return message_of<InputError>([&] { parse_case(text, folder_ / "case.toml", {}); });
  };
  EXPECT_NE(
      refused("pressure = 1\n", "").find("opening.inlet: has a condition of its own, and network.element.a joins it"),
      std::string::npos);
  EXPECT_NE(refused("", "").find("joins the node \"outlet\", which has no [[opening]]"), std::string::npos);
  EXPECT_NE(refused("[[opening]]\nsurface = \"outlet\"\n", "start = \"lumped\"\n")
                .find("time.start: \"lumped\" is for openings"),
            std::string::npos);
}

}  // namespace

}  // namespace fsi::test
