#include "scene/vessel_ends.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <map>
#include <set>
#include <utility>

#include "fem/elements.hpp"
#include "mesh/disjoint_sets.hpp"
#include "mesh/flat_parts.hpp"
#include "mesh/point_math.hpp"

namespace fsi {

namespace {

constexpr double cos_smooth = 0.866;  // of 30 degrees between the normals of a face's facets
constexpr double cos_edge = 0.766;    // of 40 degrees: at an edge normals are between 40 and 140 degrees apart

/// Vertices that a facet shares with a neighbour: of a triangle two, of an edge one.
template <int Dim>
std::array<std::array<int, Dim - 1>, Dim> sides_of(const int* facet) {
  std::array<std::array<int, Dim - 1>, Dim> sides;
  for (int i = 0; i < Dim; ++i) {
    for (int k = 0; k < Dim - 1; ++k) sides[i][k] = facet[(i + k) % Dim];
    std::sort(sides[i].begin(), sides[i].end());
  }
  return sides;
}

template <class Element>
class FaceFinder {
 public:
  static constexpr int dim = Element::dim;

  FaceFinder(const MeshOf<Element>& mesh, const WallFacets<Element>& boundary)
      : mesh_(mesh), boundary_(boundary), sets_(boundary.size()) {
    join();
    meet_inner();
    find_contacts();
  }

  VesselFaces<Element> sorted() {
    VesselFaces<Element> faces;
    decide(faces.unclear);
    for (std::size_t f = 0; f < boundary_.size(); ++f) {
      const auto& facet = boundary_[f];
      const int face = sets_.root(static_cast<int>(f));
      if (facet.kind == WallFacetKind::inner)
        faces.inner.push_back(facet.nodes);
      else if (dim == 3 && ends_.count(face) > 0)
        faces.ends.push_back(facet.nodes);
      else if (facet.kind == WallFacetKind::other && !is_candidate(face))
        faces.outer.push_back(facet.nodes);
    }
    return faces;
  }

 private:
  WallFacetKind kind(int face) const { return boundary_[static_cast<std::size_t>(face)].kind; }

  /// Calls visit(f, g) for facets that share a side.
  template <class Visit>
  void for_each_pair(Visit visit) {
    if (pairs_.empty()) {
      std::vector<std::pair<std::array<int, dim - 1>, int>> sides;
      for (std::size_t f = 0; f < boundary_.size(); ++f)
        for (const auto& side : sides_of<dim>(boundary_[f].nodes.data())) sides.emplace_back(side, static_cast<int>(f));
      std::sort(sides.begin(), sides.end());
      for (std::size_t i = 0; i < sides.size(); ++i)
        for (std::size_t k = i + 1; k < sides.size() && sides[k].first == sides[i].first; ++k)
          pairs_.emplace_back(sides[i].second, sides[k].second);
    }
    for (const auto& [f, g] : pairs_) visit(f, g);
  }

  void join() {
    for_each_pair([&](int f, int g) {
      const auto &a = boundary_[static_cast<std::size_t>(f)], &b = boundary_[static_cast<std::size_t>(g)];
      if (a.kind != b.kind) return;
      const bool one = a.kind == WallFacetKind::end || (a.kind == WallFacetKind::symmetry && a.plane == b.plane) ||
                       (a.kind == WallFacetKind::other && dot(a.normal, b.normal) > cos_smooth);
      if (one) sets_.join(f, g);
    });
  }

  void meet_inner() {
    for_each_pair([&](int f, int g) {
      if (kind(f) != WallFacetKind::inner) std::swap(f, g);
      if (kind(f) != WallFacetKind::inner || kind(g) == WallFacetKind::inner) return;
      const double cosine =
          dot(boundary_[static_cast<std::size_t>(f)].normal, boundary_[static_cast<std::size_t>(g)].normal);
      edges_[sets_.root(g)] += std::abs(cosine) < cos_edge ? 1 : -1;
    });
  }

  /// Whether a face may be an end, or is one by name.
  bool is_candidate(int face) const {
    if (kind(face) == WallFacetKind::end) return true;
    const auto found = edges_.find(face);
    return found != edges_.end() && (kind(face) == WallFacetKind::symmetry || found->second > 0);
  }

  void find_contacts() {
    std::vector<std::pair<int, int>> faces_at;  // vertex, face
    for (std::size_t f = 0; f < boundary_.size(); ++f) {
      const int face = sets_.root(static_cast<int>(f));
      if (!is_candidate(face)) continue;
      candidates_.insert(face);
      for (int i = 0; i < dim; ++i) faces_at.emplace_back(boundary_[f].nodes[i], face);
    }
    std::sort(faces_at.begin(), faces_at.end());
    for (std::size_t i = 0; i < faces_at.size(); ++i)
      for (std::size_t k = i + 1; k < faces_at.size() && faces_at[k].first == faces_at[i].first; ++k)
        if (faces_at[k].second != faces_at[i].second) {
          contacts_[faces_at[i].second].insert(faces_at[k].second);
          contacts_[faces_at[k].second].insert(faces_at[i].second);
        }
  }

  /// One of `among` that a face touches, -1 if it touches none.
  int touched(int face, const std::set<int>& among) const {
    const auto found = contacts_.find(face);
    if (found == contacts_.end()) return -1;
    for (const int other : found->second)
      if (among.count(other) > 0) return other;
    return -1;
  }

  void decide(std::string& unclear) {
    for (const int face : candidates_)
      if (kind(face) == WallFacetKind::end) ends_.insert(face);
    for (const WallFacetKind next : {WallFacetKind::other, WallFacetKind::symmetry}) {
      std::set<int> open;  // those that touch no end yet
      for (const int face : candidates_)
        if (kind(face) == next && touched(face, ends_) < 0) open.insert(face);
      std::set<int> found;
      for (const int face : open) {
        const int other = touched(face, open);
        if (other < 0)
          found.insert(face);
        else if (unclear.empty())
          unclear = fmt::format("the faces at {} and {} touch each other: one may be an end and the other a cut",
                                place_of(middle(face)), place_of(middle(other)));
      }
      ends_.insert(found.begin(), found.end());
    }
  }

  Point middle(int face) {
    Point sum{0, 0, 0};
    double count = 0;
    for (std::size_t f = 0; f < boundary_.size(); ++f)
      if (sets_.root(static_cast<int>(f)) == face)
        for (int i = 0; i < dim; ++i, ++count) sum = sum + mesh_.nodes[boundary_[f].nodes[i]];
    return (1 / count) * sum;
  }

  const MeshOf<Element>& mesh_;
  const WallFacets<Element>& boundary_;
  DisjointSets sets_;                       ///< of facets that make up a face, which is known by its root
  std::vector<std::pair<int, int>> pairs_;  ///< facets with a common side
  std::map<int, int> edges_;         ///< per face, how many more sides meet the inner face at an edge than do not
  std::set<int> candidates_, ends_;  ///< faces
  std::map<int, std::set<int>> contacts_{};  ///< faces with a common vertex
};

}  // namespace

template <class Element>
VesselFaces<Element> vessel_faces(const MeshOf<Element>& mesh, const WallFacets<Element>& boundary) {
  return FaceFinder<Element>(mesh, boundary).sorted();
}

#define FSI_INSTANTIATE(Element) \
  template VesselFaces<Element> vessel_faces<Element>(const MeshOf<Element>&, const WallFacets<Element>&);
FSI_FOR_EACH_ELEMENT(FSI_INSTANTIATE)
#undef FSI_INSTANTIATE

}  // namespace fsi
