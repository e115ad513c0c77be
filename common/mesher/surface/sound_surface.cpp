#include "mesher/surface/sound_surface.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>

#include "base/error.hpp"
#include "mesh/flat_parts.hpp"
#include "mesh/point_math.hpp"
#include "mesher/surface/remeshing.hpp"

namespace fsi {

namespace {

using TrianglesAtEdge = std::map<SurfaceEdge, std::vector<int>>;

/// Triangles of the same three nodes but the first. \return how many there were
std::size_t leave_out_doubles(TriangleSurface& surface) {
  std::set<SurfaceTriangle> known;
  std::vector<char> keep;
  for (auto key : surface.triangles) {
    std::sort(key.begin(), key.end());
    keep.push_back(known.insert(key).second ? 1 : 0);
  }
  const auto before = surface.triangles.size();
  surface = part_of(surface, keep);
  return before - surface.triangles.size();
}

TrianglesAtEdge triangles_at_edges(const TriangleSurface& surface, const std::string& file) {
  TrianglesAtEdge at;
  for (std::size_t t = 0; t < surface.triangles.size(); ++t)
    for (int k = 0; k < 3; ++k)
      at[std::minmax(surface.triangles[t][k], surface.triangles[t][(k + 1) % 3])].push_back(static_cast<int>(t));
  for (const auto& [edge, triangles] : at)
    if (triangles.size() > 2)
      throw InputError(file, "edge at " + place_of(0.5 * (surface.nodes[edge.first] + surface.nodes[edge.second])),
                       fmt::format("{} triangles meet there", triangles.size()),
                       "mend the surface: two must meet at each edge, one on a rim");
  return at;
}

bool runs(const SurfaceTriangle& t, int a, int b) {
  return (t[0] == a && t[1] == b) || (t[1] == a && t[2] == b) || (t[2] == a && t[0] == b);
}

struct Shells {
  std::vector<int> of;              ///< per triangle
  std::vector<std::size_t> counts;  ///< triangles
  std::size_t turned = 0;           ///< triangles
};

/// Connected parts; triangles of each are turned to look to the side of most of them.
Shells shells_of(TriangleSurface& surface, const TrianglesAtEdge& at_edges, const std::string& file) {
  Shells shells{std::vector<int>(surface.triangles.size(), -1), {}};
  std::vector<char> turn(surface.triangles.size(), 0);
  for (std::size_t first = 0; first < surface.triangles.size(); ++first) {
    if (shells.of[first] >= 0) continue;
    const int shell = static_cast<int>(shells.counts.size());
    std::vector<int> part{static_cast<int>(first)};
    shells.of[first] = shell;
    std::size_t turned = 0;
    for (std::size_t i = 0; i < part.size(); ++i) {
      const auto triangle = surface.triangles[part[i]];
      turned += static_cast<std::size_t>(turn[part[i]]);
      for (int k = 0; k < 3; ++k) {
        const int a = triangle[k], b = triangle[(k + 1) % 3];
        for (const int other : at_edges.at(std::minmax(a, b))) {
          if (other == part[i]) continue;
          const char as_found = runs(surface.triangles[other], a, b) ? 1 : 0;
          const char wanted = static_cast<char>(turn[part[i]] ^ as_found);
          if (shells.of[other] < 0) {
            shells.of[other] = shell;
            turn[other] = wanted;
            part.push_back(other);
          } else if (turn[other] != wanted) {
            throw InputError(file, "surface", "has one side only, seen near " + place_of(surface.nodes[a]),
                             "mend it: a lumen has an inside");
          }
        }
      }
    }
    if (2 * turned > part.size()) {
      for (const int t : part) turn[t] ^= 1;
      turned = part.size() - turned;
    }
    shells.turned += turned;
    shells.counts.push_back(part.size());
  }
  for (std::size_t t = 0; t < turn.size(); ++t)
    if (turn[t]) std::swap(surface.triangles[t][1], surface.triangles[t][2]);
  return shells;
}

/// Nodes around which the triangles are not one fan.
void require_fans(const TriangleSurface& surface, const std::string& file) {
  std::vector<std::map<int, int>> next(surface.nodes.size());
  for (const auto& t : surface.triangles)
    for (int k = 0; k < 3; ++k) next[t[k]][t[(k + 1) % 3]] = t[(k + 2) % 3];
  for (std::size_t node = 0; node < next.size(); ++node) {
    std::set<int> ends;
    for (const auto& [from, to] : next[node]) ends.insert(to);
    int start = next[node].begin()->first;
    for (const auto& [from, to] : next[node])
      if (ends.count(from) == 0) start = from;
    std::size_t seen = 0;
    for (auto at = next[node].find(start); at != next[node].end() && seen < next[node].size(); ++seen)
      at = next[node].find(at->second);
    if (seen != next[node].size())
      throw InputError(file, "node at " + place_of(surface.nodes[node]), "parts of the surface touch there",
                       "mend the surface: the triangles around a node must be one fan");
  }
}

std::string described(const TriangleSurface& surface, const Shells& shells) {
  constexpr std::size_t most = 4;
  std::string text;
  for (std::size_t s = 0; s < std::min(most, shells.counts.size()); ++s) {
    const auto first = std::find(shells.of.begin(), shells.of.end(), static_cast<int>(s)) - shells.of.begin();
    text += fmt::format("{}{} triangle{} at {}", s > 0 ? ", " : "", shells.counts[s], shells.counts[s] > 1 ? "s" : "",
                        place_of(surface.nodes[surface.triangles[first][0]]));
  }
  return shells.counts.size() > most ? text + fmt::format(", and {} more", shells.counts.size() - most) : text;
}

}  // namespace

SoundSurface sound_surface(TriangleSurface surface, bool largest, const std::string& file) {
  SoundSurface sound;
  if (const auto doubles = leave_out_doubles(surface); doubles > 0)
    sound.done.push_back(fmt::format("{} triangles that were there twice are left out.", doubles));
  const Shells shells = shells_of(surface, triangles_at_edges(surface, file), file);
  if (shells.turned > 0)
    sound.done.push_back(
        fmt::format("{} triangles looked the other way than those around them and are turned.", shells.turned));
  if (shells.counts.size() > 1) {
    if (!largest)
      throw InputError(file, "surface",
                       fmt::format("has {} shells: {}", shells.counts.size(), described(surface, shells)),
                       "leave out what is no lumen, or give --largest-shell");
    const auto most = std::max_element(shells.counts.begin(), shells.counts.end()) - shells.counts.begin();
    std::vector<char> keep;
    for (const int shell : shells.of) keep.push_back(shell == static_cast<int>(most) ? 1 : 0);
    sound.done.push_back(fmt::format("{} shells of {} triangles are left out.", shells.counts.size() - 1,
                                     shells.of.size() - shells.counts[most]));
    surface = part_of(surface, keep);
  }
  require_fans(surface, file);
  if (enclosed_volume(surface) < 0) {
    for (auto& t : surface.triangles) std::swap(t[1], t[2]);
    sound.done.emplace_back("All triangles looked inwards and are turned.");
  }
  require_no_cuts(surface, file, "mend it: no triangle may cut another one");
  sound.surface = std::move(surface);
  return sound;
}

}  // namespace fsi
