#include "observers/requested_samples.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>
#include <utility>

#include "base/error.hpp"
#include "base/names.hpp"
#include "fem/elements.hpp"
#include "mesh/point_math.hpp"
#include "sampling/centre_line.hpp"
#include "sampling/point_sampling.hpp"

namespace fsi {

namespace {

constexpr int found_line_points = 181;

std::string text(const Point& x) {
  return fmt::format("({:.6g}, {:.6g}, {:.6g})", x[0], x[1], x[2]);
}

NodalSample nodal(const std::vector<int>& nodes, const std::vector<double>& weights) {
  return {{nodes.begin(), nodes.begin() + static_cast<std::ptrdiff_t>(weights.size())}, weights};
}

template <class Element>
class Requests {
  static constexpr int dim = Element::dim, order = Element::order;

 public:
  Requests(const Case& setup, const MeshOf<Element>& mesh, const VesselParts<Element>& parts, ObservationPoints& points)
      : setup_(setup), mesh_(mesh), parts_(parts), points_(points) {}

  RequestedSamples find() {
    const SampleRequests& wanted = setup_.output.samples;
    RequestedSamples samples;
    for (const auto& [name, at] : wanted.points) {
      const auto found = sampled(name, {{at}, {0}});
      if (found.empty()) warn("points." + name, fmt::format("{} lies outside the mesh and is left out", text(at)));
      samples.points.insert(samples.points.end(), found.begin(), found.end());
    }
    for (const auto& [name, line] : wanted.lines) add(samples.lines, name, curve_of(name, line));
    if (wanted.lines.count(found_line) == 0) add_found_line(samples.lines);
    for (const auto& [name, plane] : wanted.planes) add(samples.planes, name, plane);
    return samples;
  }

 private:
  void warn(const std::string& key, const std::string& problem) {
    points_.warnings.push_back(fmt::format("output.{}: {}", key, problem));
  }
  [[noreturn]] void refuse(const std::string& key, const std::string& problem, const std::string& remedy) const {
    throw InputError(setup_.path.string(), "output." + key, problem, remedy);
  }

  /// Samples at the points that lie in fluid or wall; on the interface those of the fluid.
  std::vector<SampledPoint> sampled(const std::string& name, const CurvePoints& curve) const {
    std::vector<std::optional<PointSample>> in_fluid(curve.at.size()), in_wall(curve.at.size());
    if (parts_.fluid) in_fluid = locate_in_cells(*parts_.fluid, curve.at);
    if (parts_.wall) in_wall = locate_in_cells(*parts_.wall, curve.at);
    std::vector<SampledPoint> found;
    for (std::size_t i = 0; i < curve.at.size(); ++i) {
      const auto& sample = in_fluid[i] ? in_fluid[i] : in_wall[i];
      if (!sample) continue;
      found.push_back({name, curve.s[i], curve.at[i], in_fluid[i].has_value(), nodal(sample->nodes, sample->weights),
                       nodal(sample->nodes, sample->scalar_weights)});
    }
    return found;
  }

  void add(std::vector<SampledPoint>& lines, const std::string& name, const std::optional<CurvePoints>& curve) {
    if (!curve) return;
    const auto found = sampled(name, *curve);
    lines.insert(lines.end(), found.begin(), found.end());
    const std::size_t missing = curve->at.size() - found.size();
    if (missing == 0) return;
    std::size_t first = 0;
    while (first < found.size() && found[first].s == curve->s[first]) ++first;
    warn("lines." + name, fmt::format("{} of {} points lie outside the mesh and are left out, the first at {}", missing,
                                      curve->at.size(), text(curve->at[first])));
  }

  /// Empty, with a warning, where there is no centre line.
  std::optional<CurvePoints> curve_of(const std::string& name, const LineRequest& line) {
    if (line.is_centre_line()) {
      const std::string key = "lines." + name + ".centerline";
      if (!parts_.fluid) refuse(key, "the case has no fluid", "give from and to");
      std::array<FacetsOf<Element>, 2> ends;
      for (std::size_t end = 0; end < 2; ++end) ends[end] = opening(key, line.centerline[end]);
      try {
        return centre_line<dim, order>(*parts_.fluid, ends[0], ends[1], line.points, Element::axisymmetric,
                                       of_part(mirror_planes(mesh_), *parts_.fluid));
      } catch (const ConvergenceError& failure) {
        warn(key, failure.what());
        return std::nullopt;
      }
    }
    CurvePoints curve;
    curve.s = evenly_spaced(0, distance(line.from, line.to), line.points);
    for (int i = 0; i < line.points; ++i) {
      const double t = static_cast<double>(i) / (line.points - 1);
      Point x;
      for (int d = 0; d < 3; ++d) x[d] = (1 - t) * line.from[d] + t * line.to[d];
      curve.at.push_back(x);
    }
    return curve;
  }

  /// Facets of a surface of the fluid, with the part's node numbers.
  FacetsOf<Element> opening(const std::string& key, const std::string& name) const {
    auto facets = group_facets(mesh_, name);
    if (facets.empty()) {
      std::vector<std::string> names;
      for (const auto& group : mesh_.facet_groups) names.push_back(group.name);
      refuse(key, "there is no surface " + name, name_remedy(name, names));
    }
    for (auto& facet : facets) {
      for (const int node : facet)
        if (parts_.fluid->local_node[node] < 0)
          refuse(key, "the surface " + name + " does not bound the fluid", "give two openings of the fluid");
      facet = parts_.fluid->local(facet);
    }
    return facets;
  }

  /// The centre line of a tube that does not follow the axis of its case.
  void add_found_line(std::vector<SampledPoint>& lines) {
    const auto openings = tube_openings<Element>(setup_, mesh_);
    if (openings.empty() || Element::axisymmetric || !points_.centre_line.empty()) return;
    LineRequest request;
    request.centerline = openings;
    request.points = found_line_points;
    add(lines, found_line, curve_of(found_line, request));
    points_.notes.push_back(
        fmt::format("the fluid does not lie around the axis from end to end: no "
                    "centerline_pressure.csv; its centre line, found from {} to {}, is the line {} "
                    "of lines.csv",
                    openings[0], openings[1], found_line));
  }

  void add(std::vector<SampledPlane>& planes, const std::string& name, const PlaneRequest& plane) {
    const std::string key = "planes." + name;
    if (!parts_.fluid) refuse(key, "the case has no fluid", "take the section out");
    Point normal = plane.normal;
    if constexpr (dim == 2) normal[Element::axisymmetric ? 1 : 2] = 0;
    if (norm(normal) == 0)
      refuse(key + ".normal", "is normal to the plane of the mesh",
             Element::axisymmetric ? "give one with components along r = x and z, like [0, 0, 1]"
                                   : "give one with components along x and y, like [1, 0, 0]");
    auto cut = plane_cut(*parts_.fluid, plane.origin, plane.normal, Element::axisymmetric);
    if (!cut)
      warn(key, fmt::format("the plane through {} cuts no fluid and is left out", text(plane.origin)));
    else
      planes.push_back({name, std::move(cut)});
  }

  const Case& setup_;
  const MeshOf<Element>& mesh_;
  const VesselParts<Element>& parts_;
  ObservationPoints& points_;
};

}  // namespace

template <class Element>
RequestedSamples requested_samples(const Case& setup, const MeshOf<Element>& mesh, const VesselParts<Element>& parts,
                                   ObservationPoints& points) {
  return Requests<Element>(setup, mesh, parts, points).find();
}

#define FSI_INSTANTIATE(Element)                                                                                \
  template RequestedSamples requested_samples(const Case&, const MeshOf<Element>&, const VesselParts<Element>&, \
                                              ObservationPoints&);
FSI_FOR_EACH_ELEMENT(FSI_INSTANTIATE)
#undef FSI_INSTANTIATE

}  // namespace fsi
