#include "mesher/surface/lumen_openings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "base/error.hpp"
#include "math/pi.hpp"
#include "mesh/flat_parts.hpp"
#include "mesh/flat_regions.hpp"
#include "mesh/point_math.hpp"
#include "mesher/surface/domed_ends.hpp"

namespace fsi {

namespace {

/// The normal points out of the lumen: triangles run around a rim the other way than those of its cap would.
LumenOpening opening_at(const TriangleSurface& surface, const std::vector<int>& rim) {
  const LoopPlane plane = plane_of(surface.nodes, rim);
  return {"", false, plane.centre, -1.0 * plane.normal, plane.area};
}

constexpr const char* inner_face =
    "give the inner face alone, its ends open or cut flat; fsi-mesh import takes meshes of volumes";

/// A rim that encloses far less area than its length could, as points that are there twice leave; empty without one.
LumenFault slit_of(const OpenedLumen& lumen) {
  // Length squared over 4 pi times the area: 1 of a circle, 50 of a rectangle 157 times as long as wide.
  constexpr double longest = 50;
  const TriangleSurface& surface = lumen.surface;
  for (const auto& rim : rims_of(surface)) {
    double length = 0;
    for (std::size_t i = 0; i < rim.size(); ++i)
      length += distance(surface.nodes[rim[i]], surface.nodes[rim[(i + 1) % rim.size()]]);
    const LoopPlane plane = plane_of(surface.nodes, rim);
    if (length * length <= longest * 4 * pi * plane.area) continue;
    const auto nearest =
        std::min_element(lumen.openings.begin(), lumen.openings.end(), [&](const auto& a, const auto& b) {
          return distance(a.centre, plane.centre) < distance(b.centre, plane.centre);
        });
    return {
        fmt::format("has a slit near {}, as points that are there twice leave", place_of(surface.nodes[rim.front()])),
        fmt::format("join them, or give --closed {}, its number in --list-openings",
                    nearest - lumen.openings.begin() + 1)};
  }
  return {};
}

}  // namespace

double LumenOpening::diameter() const {
  return std::sqrt(4 * area / pi);
}

OpenedLumen opened(const TriangleSurface& surface) {
  std::vector<char> keep(surface.triangles.size(), 1);
  std::vector<Point> caps;
  for (const auto& part : flat_regions(surface.nodes, surface.triangles)) {
    for (const int t : part.triangles) keep[t] = 0;
    caps.push_back(part.centre);
  }
  std::vector<char> taken;
  for (const char kept : keep) taken.push_back(kept == 0 ? 1 : 0);
  for (const auto& end : domed_ends(surface, taken)) {
    for (const int t : end.triangles) keep[t] = 0;
    caps.push_back(end.centre);
  }
  OpenedLumen lumen{part_of(surface, keep), {}};
  for (const auto& rim : rims_of(lumen.surface)) lumen.openings.push_back(opening_at(lumen.surface, rim));
  for (auto& opening : lumen.openings) {
    const auto nearer = [&](double limit) {
      return std::any_of(caps.begin(), caps.end(),
                         [&](const Point& cap) { return distance(cap, opening.centre) < limit; });
    };
    opening.capped = nearer(opening.diameter() / 4);
  }
  std::stable_sort(lumen.openings.begin(), lumen.openings.end(),
                   [](const auto& a, const auto& b) { return a.area > b.area; });
  return lumen;
}

std::string to_text(const std::vector<LumenOpening>& openings) {
  std::string text = fmt::format("{:>6} {:>9} {:>13}  {:<34} {:<26} {}\n", "number", "area/mm^2", "diameter/mm",
                                 "centre", "normal", "in the file");
  for (std::size_t i = 0; i < openings.size(); ++i) {
    const auto& opening = openings[i];
    text +=
        fmt::format("{:>6} {:>9.4g} {:>13.4g}  {:<34} {:<26} {}\n", i + 1, opening.area, opening.diameter(),
                    place_of(opening.centre), text_of_normal(opening.normal), opening.capped ? "flat part" : "hole");
  }
  return text;
}

LumenFault not_a_lumen(const OpenedLumen& lumen) {
  const auto& openings = lumen.openings;
  if (auto slit = slit_of(lumen)) return slit;
  for (std::size_t i = 0; i < openings.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) {
      const double width = std::min(openings[i].diameter(), openings[j].diameter());
      if (distance(openings[i].centre, openings[j].centre) < width / 4 &&
          std::abs(dot(openings[i].normal, openings[j].normal)) > 0.9)
        return {
            fmt::format("openings {} and {} lie around each other at {}, as those of the inner and the outer face of a "
                        "wall do",
                        j + 1, i + 1, place_of(openings[j].centre)),
            inner_face};
    }
  if (!openings.empty()) return {};
  std::set<SurfaceEdge> edges;
  std::set<int> nodes;
  for (const auto& t : lumen.surface.triangles)
    for (int k = 0; k < 3; ++k) {
      edges.insert(std::minmax(t[k], t[(k + 1) % 3]));
      nodes.insert(t[k]);
    }
  const auto euler = static_cast<long>(nodes.size() + lumen.surface.triangles.size()) - static_cast<long>(edges.size());
  if (euler != 2)
    return {"is closed and runs through itself like a ring, as the inner and the outer face of a wall with its ends do",
            inner_face};
  return {"is closed, and no part of it is an end: flat or slightly domed, with a sharp rim", inner_face};
}

std::size_t chosen(const std::vector<LumenOpening>& openings, const OpeningChoice& choice, const std::string& option) {
  const std::string count = fmt::format("the surface has {}; --list-openings shows them", openings.size());
  if (choice.number > 0) {
    if (static_cast<std::size_t>(choice.number) <= openings.size()) return static_cast<std::size_t>(choice.number) - 1;
    throw InputError("fsi-mesh", option, fmt::format("there is no opening {}", choice.number), count);
  }
  const auto nearest = std::min_element(openings.begin(), openings.end(), [&](const auto& a, const auto& b) {
    return distance(a.centre, choice.at) < distance(b.centre, choice.at);
  });
  if (nearest == openings.end()) throw InputError("fsi-mesh", option, "the surface has no opening", count);
  const double away = distance(nearest->centre, choice.at);
  if (away > nearest->diameter())
    throw InputError("fsi-mesh", option,
                     fmt::format("{} is {:.3g} mm away from the nearest opening, at {}", place_of(choice.at), away,
                                 place_of(nearest->centre)),
                     fmt::format("give a point within its diameter, {:.3g} mm; ", nearest->diameter()) + count);
  return static_cast<std::size_t>(nearest - openings.begin());
}

std::vector<int> rim_of(const TriangleSurface& surface, LumenOpening& opening) {
  const auto rims = rims_of(surface);
  const auto nearest = std::min_element(rims.begin(), rims.end(), [&](const auto& a, const auto& b) {
    return distance(plane_of(surface.nodes, a).centre, opening.centre) <
           distance(plane_of(surface.nodes, b).centre, opening.centre);
  });
  if (nearest == rims.end()) return {};
  const LumenOpening now = opening_at(surface, *nearest);
  opening.centre = now.centre;
  opening.normal = now.normal;
  opening.area = now.area;
  return *nearest;
}

}  // namespace fsi
