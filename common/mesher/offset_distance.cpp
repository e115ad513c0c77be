#include "mesher/offset_distance.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

#include "mesh/point_math.hpp"
#include "mesher/rim_planes.hpp"

namespace fsi {

namespace {

constexpr double tolerance = 1e-4;    // of the thickness
constexpr double most_of_way = 0.9;   // to the surface that a step may go
constexpr double least_slope = 0.05;  // of the distance along the way; below it another part is as near

/// A half space that a point is to be moved into.
struct HalfSpace {
  Point inwards;   ///< its unit normal's part in the planes that the point moves in
  double missing;  ///< mm: a way leads into it if its scalar product with `inwards` is this or more
};

/// The shortest way into all half spaces, by projecting onto one after the other (Hildreth's method).
Point shortest_way_into(const std::vector<HalfSpace>& spaces) {
  constexpr int most_rounds = 100;
  constexpr double steepest = 20;  // way over what is missing, beyond which the half spaces have no point in common
  std::vector<double> multiplier(spaces.size(), 0.0);
  double longest = 0;
  for (const auto& space : spaces) longest = std::max(longest, steepest * space.missing);
  Point way{0, 0, 0};
  for (int round = 0; round < most_rounds; ++round) {
    double largest = 0;
    for (std::size_t i = 0; i < spaces.size(); ++i) {
      const auto& [inwards, missing] = spaces[i];
      const double before = multiplier[i];
      multiplier[i] = std::max(0.0, before + (missing - dot(inwards, way)) / dot(inwards, inwards));
      way = way + (multiplier[i] - before) * inwards;
      largest = std::max(largest, std::abs(multiplier[i] - before));
    }
    if (largest <= 1e-7 * longest || norm(way) > longest) break;
  }
  return way;
}

}  // namespace

OffsetDistance::OffsetDistance(const std::vector<Point>& nodes, const std::vector<std::array<int, 3>>& facets,
                               std::vector<double> thickness)
    : surface_(nodes, facets), thickness_(std::move(thickness)) {}

OffsetDistance::Place OffsetDistance::at(const Point& x, int guess) const {
  const auto near = surface_.nearest(x, guess);
  Place place;
  place.distance = near.distance;
  place.asked = 0;
  for (int k = 0; k < 3; ++k) place.asked += near.weights[k] * thickness_[surface_.facets()[near.facet][k]];
  place.away = (1 / std::max(near.distance, 1e-300)) * (x - near.at);
  place.nearest = near.at;
  place.facet = near.facet;
  return place;
}

Point OffsetDistance::along(const Point& from, const Point& way, double asked, double reach) const {
  constexpr int most_steps = 100;
  constexpr double begin = 0.05;  // of the thickness
  double s = begin * reach * asked;
  int guess = -1;
  for (int step = 0; step < most_steps; ++step) {
    const Place place = at(from + s * way, guess);
    const double wanted = reach * place.asked, missing = wanted - place.distance;
    if (std::abs(missing) < tolerance * wanted || dot(place.away, way) < least_slope) break;
    s += std::min(missing, most_of_way * place.distance);
    guess = place.facet;
  }
  return from + s * way;
}

Point OffsetDistance::onto(Point x, double reach, const std::vector<Point>& planes, int guess) const {
  constexpr int most_steps = 60, most_in_vain = 6;
  constexpr std::size_t most_spaces = 8;
  struct Seen {
    Point nearest, away, inwards;
    double wanted;
  };
  std::vector<Seen> seen;
  Point best = x;
  double least = std::numeric_limits<double>::infinity();
  int in_vain = 0;
  for (int step = 0; step < most_steps && in_vain < most_in_vain; ++step) {
    const Place place = at(x, guess);
    guess = place.facet;
    const double wanted = reach * place.asked, missing = wanted - place.distance;
    in_vain = std::abs(missing) < 0.99 * least * wanted ? 0 : in_vain + 1;
    if (std::abs(missing) < least * wanted) {
      least = std::abs(missing) / wanted;
      best = x;
    }
    const Point inwards = in_planes(place.away, planes);
    if (std::abs(missing) < tolerance * wanted || norm(inwards) < least_slope) break;
    if (missing < 0) {  // back, straight towards the surface
      seen.clear();
      x = x + (missing / dot(inwards, inwards)) * inwards;
      continue;
    }
    if (seen.size() == most_spaces) seen.erase(seen.begin());
    seen.push_back({place.nearest, place.away, inwards, wanted});
    std::vector<HalfSpace> spaces;
    for (const auto& [nearest, away, into, far] : seen) spaces.push_back({into, far - dot(x - nearest, away)});
    Point way = shortest_way_into(spaces);
    if (const double length = norm(way); length > most_of_way * place.distance)
      way = (most_of_way * place.distance / length) * way;
    x = x + way;
  }
  return best;
}

}  // namespace fsi
