#include "case/sample_keys.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <string>
#include <utility>

#include "case/key_values.hpp"

namespace fsi {

namespace {

constexpr int most_points = 100'000;  // of a line
constexpr std::size_t longest_name = 64;
using presence::optional, presence::required;

/// The name of a sample, which stands in a column of a table. \throws InputError for one that cannot
std::string sample_name(const CaseEntry& section, const CaseEntry& entry) {
  std::string name = entry.key().substr(section.key().size() + 1);
  const bool plain = !name.empty() && name.size() <= longest_name && std::all_of(name.begin(), name.end(), [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '-';
  });
  if (!plain)
    entry.refuse(fmt::format("\"{}\" cannot be the name of a sample", name),
                 fmt::format("use letters, digits, _ and -, at most {}", longest_name));
  return name;
}

/// A section whose children are named by the user and have a table of keys each.
template <class Request>
CaseKey<OutputData> named_sections(const std::string& name, const std::string& about,
                                   const std::vector<CaseKey<Request>>& keys,
                                   std::map<std::string, Request> SampleRequests::*place,
                                   const std::function<void(const CaseEntry&, Request&)>& check) {
  std::vector<KeyHelp> help;
  for (const auto& key : keys) help.push_back({name + ".NAME." + key.name, key.about, key.required});
  return {name,
          optional,
          about,
          [=](const CaseEntry& entry, OutputData& output) {
            for (const auto& child : entry.children()) {
              Request request;
              const std::string given = sample_name(entry, child);
              read_keys(child, keys, request);
              check(child, request);
              (output.samples.*place)[given] = std::move(request);
            }
          },
          [=](const OutputData& output, const std::string& path, std::vector<CaseValue>& values) {
            for (const auto& [given, request] : output.samples.*place)
              list_keys(keys, request, path + "." + given, values);
          },
          KeyRole::running,
          help};
}

// [output.points].

struct NamedPoint {
  Point at{0, 0, 0};
};

CaseKey<OutputData> points_key() {
  const auto coordinates = point(at(&NamedPoint::at), false);
  const std::string about = "a point where fields are sampled, reference coordinates [x, y, z] in mm";
  return {"points",
          optional,
          "points where fields are sampled, in points.csv",
          [=](const CaseEntry& entry, OutputData& output) {
            for (const auto& child : entry.children()) {
              const std::string given = sample_name(entry, child);
              NamedPoint named;
              coordinates.read(entry.child(given, about), named);
              output.samples.points[given] = named.at;
            }
          },
          [=](const OutputData& output, const std::string& path, std::vector<CaseValue>& values) {
            for (const auto& [given, x] : output.samples.points)
              values.push_back({path + "." + given, coordinates.write({x}), KeyRole::running});
          },
          KeyRole::running,
          {{"points.NAME", about, optional}}};
}

// [output.lines.NAME].

void read_openings(const CaseEntry& entry, LineRequest& line) {
  const auto names = entry.elements();
  if (names.size() != 2)
    entry.refuse_value("is no pair of openings", "give two surfaces, like [\"inlet\", \"outlet\"]");
  for (const auto& name : names) line.centerline.push_back(name.text());
  if (line.centerline[0] == line.centerline[1])
    entry.refuse_value("begins and ends at one opening", "give two surfaces, like [\"inlet\", \"outlet\"]");
}

std::vector<CaseKey<LineRequest>> line_keys() {
  return {
      leaf("from", optional, "first point of a straight line, reference coordinates [x, y, z] in {unit}",
           point(at(&LineRequest::from), false), KeyRole::running),
      leaf("to", optional, "last point of a straight line, in {unit}", point(at(&LineRequest::to), false),
           KeyRole::running),
      leaf<LineRequest>(
          "centerline", optional,
          "in place of from and to: the centre line of a tube, straight or bent, between two surfaces, like "
          "[\"inlet\", \"outlet\"]",
          {read_openings, [](const LineRequest& line) { return fmt::format("{}", fmt::join(line.centerline, ", ")); }},
          KeyRole::running),
      leaf("points", optional, "evenly spaced points, ends included, default {}",
           whole(at(&LineRequest::points), 2, most_points), KeyRole::running),
  };
}

void check_line(const CaseEntry& entry, const LineRequest& line) {
  const bool from = entry.has("from"), to = entry.has("to");
  const char* remedy = "give from and to, or centerline";
  if (line.is_centre_line() && (from || to))
    entry.child(from ? "from" : "to").refuse("stands beside centerline", remedy);
  if (line.is_centre_line()) return;
  if (!from && !to) entry.refuse("does not say where the line runs", remedy);
  if (!from || !to) entry.refuse(from ? "lacks its end" : "lacks its beginning", from ? "add to" : "add from");
  if (line.from == line.to) entry.child("to").refuse("is the point that the line begins at", "give another point");
}

// [output.planes.NAME].

std::vector<CaseKey<PlaneRequest>> plane_keys() {
  return {
      leaf("origin", required, "a point of the plane in {unit}, in or near the piece of its cut that counts",
           point(at(&PlaneRequest::origin), false), KeyRole::running),
      leaf("normal", required, "direction in which flow through the plane is positive",
           point(at(&PlaneRequest::normal), true), KeyRole::running),
  };
}

}  // namespace

std::vector<CaseKey<OutputData>> sample_keys() {
  return {points_key(),
          named_sections<LineRequest>("lines", "lines along which fields are sampled, in lines.csv", line_keys(),
                                      &SampleRequests::lines, check_line),
          named_sections<PlaneRequest>("planes", "flow and mean pressure where planes cut the fluid, in planes.csv",
                                       plane_keys(), &SampleRequests::planes, [](const CaseEntry&, PlaneRequest&) {})};
}

}  // namespace fsi
