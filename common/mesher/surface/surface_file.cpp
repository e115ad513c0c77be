#include "mesher/surface/surface_file.hpp"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/IO/OBJ.h>
#include <CGAL/IO/PLY.h>
#include <CGAL/IO/STL.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <fstream>
#include <limits>
#include <map>
#include <string>
#include <system_error>
#include <vector>

#include "base/error.hpp"
#include "fields/field_samples.hpp"
#include "fields/vtk_file.hpp"

namespace fsi {

namespace {

using CgalPoint = CGAL::Exact_predicates_inexact_constructions_kernel::Point_3;
constexpr const char* kinds = "give a surface of triangles: .stl, .ply, .obj or .vtp";

struct Polygons {
  std::vector<CgalPoint> points;
  std::vector<std::vector<std::size_t>> polygons;
};

std::string kind_of(const std::filesystem::path& file) {
  std::string kind = file.extension().string();
  std::transform(kind.begin(), kind.end(), kind.begin(), [](unsigned char c) { return std::tolower(c); });
  return kind;
}

/// Places as whole numbers of 1e-9 of the surface's extent: where a script goes once around, the last point of a seam
/// may differ from the first one by rounding.
class Places {
 public:
  explicit Places(const std::vector<CgalPoint>& points) {
    Point high{-infinite, -infinite, -infinite};
    for (const auto& p : points)
      for (int d = 0; d < 3; ++d) {
        low_[d] = std::min(low_[d], p[d]);
        high[d] = std::max(high[d], p[d]);
      }
    double extent = 0;
    for (int d = 0; d < 3; ++d) extent = std::max(extent, high[d] - low_[d]);
    if (std::isfinite(extent) && extent > 0) step_ = 1e-9 * extent;
  }
  std::array<long long, 3> operator()(const Point& x) const {
    std::array<long long, 3> place;
    for (int d = 0; d < 3; ++d) place[d] = std::llround((x[d] - low_[d]) / step_);
    return place;
  }

 private:
  Point low_{infinite, infinite, infinite};
  double step_ = 1;
  static constexpr double infinite = std::numeric_limits<double>::infinity();
};

/// Nodes at one place are one node; polygons are fans; triangles with two equal corners are left out.
TriangleSurface joined(const Polygons& found, const std::string& file) {
  TriangleSurface surface;
  for (std::size_t i = 0; i < found.points.size(); ++i)
    for (int d = 0; d < 3; ++d)
      if (!std::isfinite(found.points[i][d]))
        throw InputError(file, fmt::format("point {}", i + 1), "has a coordinate that is no finite number",
                         "write the surface anew");
  const Places place(found.points);
  std::map<std::array<long long, 3>, int> known;
  std::vector<int> number;
  for (const auto& p : found.points) {
    const Point x{p.x(), p.y(), p.z()};
    const auto [at, is_new] = known.try_emplace(place(x), static_cast<int>(surface.nodes.size()));
    if (is_new) surface.nodes.push_back(x);
    number.push_back(at->second);
  }
  for (const auto& polygon : found.polygons) {
    for (const std::size_t node : polygon)
      if (node >= number.size())
        throw InputError(file, "", fmt::format("names the point {} of {}", node + 1, number.size()),
                         "the file is damaged: write it anew");
    for (std::size_t k = 2; k < polygon.size(); ++k) {
      const SurfaceTriangle t{number[polygon[0]], number[polygon[k - 1]], number[polygon[k]]};
      if (t[0] != t[1] && t[1] != t[2] && t[2] != t[0]) surface.triangles.push_back(t);
    }
  }
  return part_of(surface, std::vector<char>(surface.triangles.size(), 1));
}

Polygons polygons_of_vtp(const std::filesystem::path& file) {
  const std::string name = file.string();
  const VtkMesh mesh = read_vtk(text_of_file(file, kinds), name, [](const VtkMesh::Array&) { return false; });
  if (!mesh.is_surface) throw InputError(name, "", "holds no PolyData of VTK", kinds);
  if (mesh.strips > 0) throw InputError(name, "", "holds strips of triangles", "write its surface as polygons");
  Polygons found;
  for (const auto& x : mesh.nodes) found.points.emplace_back(x[0], x[1], x[2]);
  for (const auto& cell : mesh.cells) found.polygons.emplace_back(cell.begin(), cell.end());
  return found;
}

/// \param kind  of the text: .stl, .ply or .obj
Polygons polygons_of(std::istream& in, const std::string& kind, const std::string& file) {
  Polygons found;
  bool whole = false;
  try {
    whole = kind == ".stl"   ? CGAL::IO::read_STL(in, found.points, found.polygons)
            : kind == ".ply" ? CGAL::IO::read_PLY(in, found.points, found.polygons)
                             : CGAL::IO::read_OBJ(in, found.points, found.polygons);
  } catch (const std::exception&) {  // of what the file promises and does not hold
  }
  if (!whole) throw InputError(file, "", "cannot be read as " + kind + ": it is damaged or cut off", kinds);
  return found;
}

}  // namespace

TriangleSurface read_triangles(const std::filesystem::path& file) {
  const std::string name = file.string(), kind = kind_of(file);
  if (std::error_code error; !std::filesystem::is_regular_file(file, error))
    throw InputError(name, "", "no such file", kinds);
  if (kind != ".stl" && kind != ".ply" && kind != ".obj" && kind != ".vtp")
    throw InputError(name, "", kind.empty() ? "has no extension" : "the extension " + kind + " is unknown", kinds);
  std::ifstream in(file, std::ios::binary);
  if (!in) throw InputError(name, "", "cannot be read", "check its permissions");
  TriangleSurface surface = joined(kind == ".vtp" ? polygons_of_vtp(file) : polygons_of(in, kind, name), name);
  if (surface.triangles.empty()) throw InputError(name, "", "holds no triangles", kinds);
  return surface;
}

}  // namespace fsi
