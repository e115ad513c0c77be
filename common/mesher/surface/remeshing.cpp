#include "mesher/surface/remeshing.hpp"

#include <CGAL/Polygon_mesh_processing/refine.h>
#include <CGAL/Polygon_mesh_processing/remesh.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/Polygon_mesh_processing/triangulate_hole.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <set>
#include <utility>

#include "base/error.hpp"
#include "mesh/flat_parts.hpp"
#include "mesh/point_math.hpp"
#include "mesher/surface/cgal_mesh.hpp"

namespace fsi {

namespace {

namespace pmp = CGAL::Polygon_mesh_processing;
using Vertex = CgalMesh::Vertex_index;
using Face = CgalMesh::Face_index;

constexpr const char* rough = "more --smoothing, or a smaller --edge-length";

Point centre_of(const TriangleSurface& surface, const SurfaceTriangle& t) {
  return (1.0 / 3) * (surface.nodes[t[0]] + surface.nodes[t[1]] + surface.nodes[t[2]]);
}

/// Neighbours that face each other: the surface is folded there.
void require_no_folds(const TriangleSurface& surface, const std::string& file) {
  constexpr double folded = -0.5;  // cosine of 120 degrees
  std::map<SurfaceEdge, int> behind;
  for (std::size_t t = 0; t < surface.triangles.size(); ++t)
    for (int k = 0; k < 3; ++k)
      behind[{surface.triangles[t][k], surface.triangles[t][(k + 1) % 3]}] = static_cast<int>(t);
  const auto normal = [&](int t) {
    const auto& [a, b, c] = surface.triangles[t];
    return triangle_area_vector(surface.nodes[a], surface.nodes[b], surface.nodes[c]);
  };
  for (const auto& [edge, t] : behind) {
    const auto other = behind.find({edge.second, edge.first});
    if (other == behind.end()) continue;
    const Point u = normal(t), v = normal(other->second);
    if (!(dot(u, v) > folded * norm(u) * norm(v)))
      throw InputError(file, "surface", "is folded at " + place_of(centre_of(surface, surface.triangles[t])), rough);
  }
}

/// The surface of a mesh that was remeshed. \throws InputError where it is folded or cuts itself
TriangleSurface checked(CgalMesh& mesh, const std::string& file) {
  mesh.collect_garbage();
  TriangleSurface made = from_cgal(mesh);
  require_no_folds(made, file);
  require_no_cuts(made, file, rough);
  return made;
}

/// Lengths of edges anywhere near a surface: those at the nearest of its nodes.
class EdgeField {
 public:
  EdgeField(const TriangleSurface& surface, std::vector<double> edges) : edges_(std::move(edges)) {
    limit_slope(surface);
    const std::size_t stride = 1 + surface.nodes.size() / 20'000;
    for (std::size_t i = 0; i < surface.nodes.size(); i += stride) places_.push_back({i, surface.nodes[i]});
  }

  double at(const Point& x) const {
    const auto nearest = std::min_element(places_.begin(), places_.end(), [&](const auto& a, const auto& b) {
      return dot(a.second - x, a.second - x) < dot(b.second - x, b.second - x);
    });
    return edges_[nearest->first];
  }
  double least() const { return *std::min_element(edges_.begin(), edges_.end()); }

 private:
  void limit_slope(const TriangleSurface& surface) {
    constexpr double slope = 0.3;
    for (bool changed = true; changed;) {
      changed = false;
      for (const auto& t : surface.triangles)
        for (int k = 0; k < 3; ++k) {
          const int a = t[k], b = t[(k + 1) % 3];
          const double step = slope * distance(surface.nodes[a], surface.nodes[b]);
          for (const auto& [one, other] : {std::pair(a, b), std::pair(b, a)})
            if (edges_[one] > edges_[other] + (1 + 1e-9) * step) {
              edges_[one] = edges_[other] + step;
              changed = true;
            }
        }
    }
  }

  std::vector<double> edges_;
  std::vector<std::pair<std::size_t, Point>> places_;
};

constexpr double band_width = 1.25;

/// Faces by the band in which the lengths wanted there lie. \param shift  of the bands' ends, in bands
std::map<int, std::vector<Face>> bands_of(const CgalMesh& mesh, const EdgeField& field, double shift) {
  std::map<int, std::vector<Face>> bands;
  for (const auto f : mesh.faces()) {
    Point centre{0, 0, 0};
    for (const auto v : mesh.vertices_around_face(mesh.halfedge(f))) {
      const auto& x = mesh.point(v);
      centre = centre + (1.0 / 3) * Point{x.x(), x.y(), x.z()};
    }
    bands[static_cast<int>(std::floor(std::log(field.at(centre) / field.least()) / std::log(band_width) + shift))]
        .push_back(f);
  }
  return bands;
}

/// The rim's halfedge that lies outside of the surface.
CgalMesh::Halfedge_index outside_of(const CgalMesh& mesh, const std::vector<int>& rim) {
  return mesh.opposite(mesh.halfedge(Vertex(rim[0]), Vertex(rim[1])));
}

void require_filled(const std::vector<Face>& faces, const TriangleSurface& surface, const std::vector<int>& rim,
                    const std::string& file) {
  if (!faces.empty()) return;
  throw InputError(file, "hole around " + place_of(plane_of(surface.nodes, rim).centre), "cannot be closed",
                   "mend the surface there");
}

}  // namespace

TriangleSurface remeshed(const TriangleSurface& surface, double edge, const std::string& file) {
  CgalMesh mesh = to_cgal(surface);
  pmp::isotropic_remeshing(faces(mesh), edge, mesh,
                           pmp::parameters::number_of_iterations(6).number_of_relaxation_steps(3));
  return checked(mesh, file);
}

TriangleSurface remeshed(const TriangleSurface& surface, std::vector<double> edges, const std::string& file) {
  const EdgeField field(surface, std::move(edges));
  CgalMesh mesh = to_cgal(surface);
  for (const double shift : {0.0, 0.5, 0.0}) {
    std::set<int> numbers;
    for (const auto& [number, unused] : bands_of(mesh, field, shift)) numbers.insert(number);
    for (const int number : numbers) {
      const auto bands = bands_of(mesh, field, shift);  // the last one changed the faces at its ends
      const auto band = bands.find(number);
      if (band == bands.end()) continue;
      const double edge = field.least() * std::pow(band_width, number + 0.5 - shift);
      pmp::isotropic_remeshing(band->second, edge, mesh,
                               pmp::parameters::number_of_iterations(4).number_of_relaxation_steps(3));
    }
  }
  return checked(mesh, file);
}

std::vector<SurfaceTriangle> flat_cap(TriangleSurface& surface, const std::vector<int>& rim, const std::string& file) {
  CgalMesh mesh = to_cgal(surface);
  const std::size_t known = surface.triangles.size();
  std::vector<Face> cap;
  std::vector<Vertex> added;
  pmp::triangulate_and_refine_hole(mesh, outside_of(mesh, rim), std::back_inserter(cap), std::back_inserter(added));
  require_filled(cap, surface, rim, file);
  double length = 0;
  for (std::size_t i = 0; i < rim.size(); ++i)
    length += distance(surface.nodes[rim[i]], surface.nodes[rim[(i + 1) % rim.size()]]);
  // The rim's own edges and nodes stay: the cap fits the surface.
  pmp::isotropic_remeshing(
      cap, length / static_cast<double>(rim.size()), mesh,
      pmp::parameters::number_of_iterations(6).number_of_relaxation_steps(3).protect_constraints(true));
  mesh.collect_garbage();
  surface = from_cgal(mesh);
  // Faces that were there come first, and none of them was removed.
  std::vector<SurfaceTriangle> triangles(surface.triangles.begin() + static_cast<std::ptrdiff_t>(known),
                                         surface.triangles.end());
  surface.triangles.resize(known);
  return triangles;
}

void close_hole(TriangleSurface& surface, const std::vector<int>& rim, const std::string& file) {
  CgalMesh mesh = to_cgal(surface);
  std::vector<Face> faces;
  std::vector<Vertex> added;
  pmp::triangulate_refine_and_fair_hole(mesh, outside_of(mesh, rim), std::back_inserter(faces),
                                        std::back_inserter(added));
  require_filled(faces, surface, rim, file);
  surface = from_cgal(mesh);
}

void require_no_cuts(const TriangleSurface& surface, const std::string& file, const std::string& remedy) {
  const CgalMesh mesh = to_cgal(surface);
  std::vector<std::pair<Face, Face>> pairs;
  pmp::self_intersections(mesh, std::back_inserter(pairs));
  if (pairs.empty()) return;
  throw InputError(
      file, "surface",
      fmt::format("cuts itself: {} pair{} of triangles cross, one at {}", pairs.size(), pairs.size() > 1 ? "s" : "",
                  place_of(centre_of(surface, surface.triangles[pairs.front().first.idx()]))),
      remedy);
}

}  // namespace fsi
