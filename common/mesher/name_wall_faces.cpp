#include "mesher/name_wall_faces.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include "base/error.hpp"
#include "math/pi.hpp"
#include "mesh/boundary.hpp"
#include "mesh/disjoint_sets.hpp"
#include "mesh/facets.hpp"
#include "mesh/flat_parts.hpp"
#include "mesh/group_names.hpp"
#include "mesh/opening_shape.hpp"
#include "mesh/point_math.hpp"

namespace fsi {

namespace {

constexpr const char* option = "--wall-faces";
constexpr double crease = pi / 6;
constexpr double plane_within = 0.02;  // of the radius of the disk of a ring's area

template <int Order>
class WallBoundary {
  using Mesh = SimplexMesh<3, Order>;
  using Facets = std::vector<typename Mesh::Facet>;
  using Edges = std::map<std::pair<int, int>, std::vector<int>>;

 public:
  WallBoundary(const Mesh& mesh, const std::string& file) : mesh_(mesh), file_(file) {
    std::set<FacetKey<3>> mirrored;
    for (const auto& group : mesh.facet_groups)
      if (group::is_symmetry_plane(group.name))
        for (const auto& facet : group.facets) mirrored.insert(facet_key<3>(facet));
    for (const auto& facet : boundary_facets(mesh, {}))
      if (mirrored.count(facet_key<3>(facet.nodes)) == 0) facets_.push_back(facet.nodes);
    for (std::size_t f = 0; f < facets_.size(); ++f)
      for (int k = 0; k < 3; ++k)
        edges_[std::minmax(facets_[f][k], facets_[f][(k + 1) % 3])].push_back(static_cast<int>(f));
    find_ends();
  }

  /// Facets of the ends; of the two other faces, the inner one first.
  std::array<Facets, 3> faces() const {
    const auto rest = parts([&](int a, int b) { return is_end_[a] == 0 && is_end_[b] == 0; });
    std::vector<Facets> found;
    for (const auto& part : rest)
      if (is_end_[part.front()] == 0) found.push_back(facets_of(part));
    if (found.size() != 2 || ends_.empty())
      throw InputError(file_, option,
                       fmt::format("the wall's surface has {} plane {} and {} further {}, where a tube has two faces "
                                   "and at least one such end",
                                   ends_.size(), ends_.size() == 1 ? "ring" : "rings", found.size(),
                                   found.size() == 1 ? "part" : "parts") +
                           places(found),
                       "name the faces where the mesh is made, or give --group inner=PART, wall_ends=PART");
    // The outer normals of both look away from the wall: those of the inner face into the lumen.
    if (outwards(found[0]) > outwards(found[1])) std::swap(found[0], found[1]);
    Facets ends;
    for (const auto& end : ends_) ends.insert(ends.end(), end.begin(), end.end());
    return {ends, found[0], found[1]};
  }

  std::size_t ends() const { return ends_.size(); }

 private:
  Point area_vector(int f) const {
    return triangle_area_vector(mesh_.nodes[facets_[f][0]], mesh_.nodes[facets_[f][1]], mesh_.nodes[facets_[f][2]]);
  }

  /// Connected by edges across which `joins(a, b)`.
  template <class Joins>
  std::vector<std::vector<int>> parts(const Joins& joins) const {
    DisjointSets sets(facets_.size());
    for (const auto& [edge, at] : edges_)
      if (at.size() == 2 && joins(at[0], at[1])) sets.join(at[0], at[1]);
    std::map<int, std::vector<int>> by_root;
    for (std::size_t f = 0; f < facets_.size(); ++f)
      by_root[sets.root(static_cast<int>(f))].push_back(static_cast<int>(f));
    std::vector<std::vector<int>> found;
    for (auto& [root, part] : by_root) found.push_back(std::move(part));
    return found;
  }

  Facets facets_of(const std::vector<int>& part) const {
    Facets facets;
    for (const int f : part) facets.push_back(facets_[f]);
    return facets;
  }

  /// Plane parts with two rims.
  void find_ends() {
    is_end_.assign(facets_.size(), 0);
    const auto smooth = parts([&](int a, int b) {
      const Point u = area_vector(a), v = area_vector(b);
      return std::atan2(norm(cross(u, v)), dot(u, v)) < crease;
    });
    for (const auto& part : smooth) {
      const auto facets = facets_of(part);
      const auto shape = shape_of_opening(mesh_.nodes, facets);
      if (shape.rims != 2 || shape.off_plane > plane_within * shape.radius()) continue;
      for (const int f : part) is_end_[f] = 1;
      ends_.push_back(facets);
    }
  }

  /// The integral of x . n about the mesh's middle, three times the volume that a face turns its back on.
  double outwards(const Facets& facets) const {
    Point middle{0, 0, 0};
    for (const auto& x : mesh_.nodes) middle = middle + (1.0 / static_cast<double>(mesh_.nodes.size())) * x;
    double sum = 0;
    for (const auto& f : facets) {
      const Point &a = mesh_.nodes[f[0]], &b = mesh_.nodes[f[1]], &c = mesh_.nodes[f[2]];
      sum += dot((1.0 / 3) * (a + b + c) - middle, triangle_area_vector(a, b, c));
    }
    return sum;
  }

  std::string places(const std::vector<Facets>& found) const {
    constexpr std::size_t most = 4;
    std::string text;
    for (std::size_t i = 0; i < std::min(most, found.size()); ++i) {
      const auto shape = shape_of_opening(mesh_.nodes, found[i]);
      text += fmt::format("{}{:.3g} mm^2 about {}", i == 0 ? ": " : ", ", shape.area, place_of(shape.centre));
    }
    return text;
  }

  const Mesh& mesh_;
  const std::string& file_;
  Facets facets_;
  Edges edges_;
  std::vector<char> is_end_;
  std::vector<Facets> ends_;
};

}  // namespace

template <int Order>
std::string name_wall_faces(SimplexMesh<3, Order>& mesh, const std::string& file) {
  if (mesh.region_index(group::fluid) >= 0)
    throw InputError(file, option, "is for a wall alone, and the mesh has a volume fluid",
                     "the interface is the wall's inner face there; a wall alone is --group wall=PART");
  for (const char* name : {group::inner, group::outer, group::wall_ends})
    if (mesh.facets(name) != nullptr)
      throw InputError(file, option, fmt::format("the mesh has a surface {}", name), "leave the option out");
  const WallBoundary<Order> boundary(mesh, file);
  auto [ends, inner, outer] = boundary.faces();
  const auto size = [&](const auto& facets) { return shape_of_opening(mesh.nodes, facets).area; };
  std::string said = fmt::format("By their shape: inner, {:.4g} mm^2; outer, {:.4g} mm^2; wall_ends, {} plane {}.\n",
                                 size(inner), size(outer), boundary.ends(), boundary.ends() == 1 ? "ring" : "rings");
  mesh.facet_groups.push_back({group::wall_ends, std::move(ends)});
  mesh.facet_groups.push_back({group::inner, std::move(inner)});
  mesh.facet_groups.push_back({group::outer, std::move(outer)});
  return said;
}

template std::string name_wall_faces(SimplexMesh<3, 1>&, const std::string&);
template std::string name_wall_faces(SimplexMesh<3, 2>&, const std::string&);

}  // namespace fsi
