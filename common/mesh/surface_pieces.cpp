#include "mesh/surface_pieces.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

#include "mesh/disjoint_sets.hpp"
#include "mesh/flat_parts.hpp"
#include "mesh/point_math.hpp"

namespace fsi {

namespace {

constexpr double leaning_away = 0.5;   // cosine of 60 degrees
constexpr double looks_one_way = 0.5;  // of a piece's area, the least that its mean normal has

/// The facet's normal times its size. Edges lie in the plane y = 0 or z = 0, so that one of the two terms is zero.
template <int Dim, std::size_t Nodes>
Point area_vector(const std::vector<Point>& nodes, const std::array<int, Nodes>& f) {
  if constexpr (Dim == 3) {
    return triangle_area_vector(nodes[f[0]], nodes[f[1]], nodes[f[2]]);
  } else {
    const Point along = nodes[f[1]] - nodes[f[0]];
    return {along[1] + along[2], -along[0], 0};  // turned in the mesh's plane
  }
}

/// The parts of some facets that shared sides connect, the largest first.
template <int Dim, std::size_t Nodes>
std::vector<SurfacePiece> connected(const std::vector<Point>& nodes, const std::vector<std::array<int, Nodes>>& surface,
                                    const std::vector<std::size_t>& some) {
  DisjointSets sets(some.size());
  std::map<std::pair<int, int>, int> first;  // side: the first facet that has it
  for (std::size_t i = 0; i < some.size(); ++i)
    for (int k = 0; k < Dim; ++k) {
      const int a = surface[some[i]][k], b = Dim == 3 ? surface[some[i]][(k + 1) % Dim] : a;
      const auto [known, is_new] = first.try_emplace(std::minmax(a, b), static_cast<int>(i));
      if (!is_new) sets.join(known->second, static_cast<int>(i));
    }
  std::map<int, SurfacePiece> by_root;
  for (std::size_t i = 0; i < some.size(); ++i) {
    SurfacePiece& piece = by_root[sets.root(static_cast<int>(i))];
    const auto& f = surface[some[i]];
    const double size = norm(area_vector<Dim>(nodes, f));
    piece.facets.push_back(some[i]);
    piece.size += size;
    for (int k = 0; k < Dim; ++k) piece.centre = piece.centre + (size / Dim) * nodes[f[k]];
  }
  std::vector<SurfacePiece> pieces;
  for (auto& [root, piece] : by_root) {
    if (piece.size > 0) piece.centre = (1 / piece.size) * piece.centre;
    pieces.push_back(std::move(piece));
  }
  std::stable_sort(pieces.begin(), pieces.end(), [](const auto& a, const auto& b) { return a.size > b.size; });
  return pieces;
}

std::size_t count_of(const std::vector<SurfacePiece>& pieces) {
  std::size_t count = 0;
  for (const auto& piece : pieces) count += piece.facets.size();
  return count;
}

}  // namespace

template <int Dim, std::size_t Nodes>
SurfacePieces pieces_of(const std::vector<Point>& nodes, const std::vector<std::array<int, Nodes>>& surface) {
  SurfacePieces found;
  std::vector<std::size_t> all(surface.size()), leaning;
  for (std::size_t f = 0; f < all.size(); ++f) all[f] = f;
  found.pieces = connected<Dim>(nodes, surface, all);
  for (const auto& piece : found.pieces) {
    Point mean{0, 0, 0};
    for (const std::size_t f : piece.facets) mean = mean + area_vector<Dim>(nodes, surface[f]);
    if (!(norm(mean) > looks_one_way * piece.size)) continue;
    for (const std::size_t f : piece.facets) {
      const Point normal = area_vector<Dim>(nodes, surface[f]);
      if (dot(normal, mean) < leaning_away * norm(normal) * norm(mean)) leaning.push_back(f);
    }
  }
  std::sort(leaning.begin(), leaning.end());
  if (!leaning.empty()) found.leaning = connected<Dim>(nodes, surface, leaning);
  return found;
}

template <int Dim>
std::string places_of(const std::vector<SurfacePiece>& pieces) {
  constexpr std::size_t most = 4;
  std::string text;
  for (std::size_t i = 0; i < std::min(most, pieces.size()); ++i)
    text += fmt::format("{}{:.3g} {} about {}", i > 0 ? ", " : "", pieces[i].size, Dim == 3 ? "mm^2" : "mm",
                        place_of(pieces[i].centre));
  return pieces.size() > most ? text + fmt::format(" and {} more", pieces.size() - most) : text;
}

template <int Dim>
std::string said_of(const SurfacePieces& found) {
  constexpr const char* facets = Dim == 3 ? "triangles" : "edges";
  std::string text;
  if (found.pieces.size() > 1)
    text = fmt::format("is in {} pieces: {}", found.pieces.size(), places_of<Dim>(found.pieces));
  if (!found.leaning.empty())
    text += fmt::format("{}has {} of its {} {} leaning away from its plane by more than 60 degrees: {}",
                        text.empty() ? "" : "; it ", count_of(found.leaning), count_of(found.pieces), facets,
                        places_of<Dim>(found.leaning));
  return text;
}

template SurfacePieces pieces_of<2>(const std::vector<Point>&, const std::vector<std::array<int, 2>>&);
template SurfacePieces pieces_of<2>(const std::vector<Point>&, const std::vector<std::array<int, 3>>&);
template SurfacePieces pieces_of<3>(const std::vector<Point>&, const std::vector<std::array<int, 3>>&);
template SurfacePieces pieces_of<3>(const std::vector<Point>&, const std::vector<std::array<int, 6>>&);
template std::string places_of<2>(const std::vector<SurfacePiece>&);
template std::string places_of<3>(const std::vector<SurfacePiece>&);
template std::string said_of<2>(const SurfacePieces&);
template std::string said_of<3>(const SurfacePieces&);

}  // namespace fsi
