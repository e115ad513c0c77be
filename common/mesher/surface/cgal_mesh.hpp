#pragma once

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>

#include <array>
#include <vector>

#include "mesher/surface/triangle_surface.hpp"

namespace fsi {

using CgalKernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using CgalMesh = CGAL::Surface_mesh<CgalKernel::Point_3>;

/// Nodes and triangles keep their numbers. \param surface  sound (mesher/surface/sound_surface.hpp)
inline CgalMesh to_cgal(const TriangleSurface& surface) {
  CgalMesh mesh;
  std::vector<CgalMesh::Vertex_index> vertices;
  for (const Point& x : surface.nodes) vertices.push_back(mesh.add_vertex({x[0], x[1], x[2]}));
  for (const auto& [a, b, c] : surface.triangles) mesh.add_face(vertices[a], vertices[b], vertices[c]);
  return mesh;
}

/// \param mesh  of triangles, without removed parts
inline TriangleSurface from_cgal(const CgalMesh& mesh) {
  TriangleSurface surface;
  for (const auto v : mesh.vertices()) {
    const auto& x = mesh.point(v);
    surface.nodes.push_back({x.x(), x.y(), x.z()});
  }
  for (const auto f : mesh.faces()) {
    SurfaceTriangle triangle{};
    int k = 0;
    for (const auto v : mesh.vertices_around_face(mesh.halfedge(f))) triangle[k++] = static_cast<int>(v.idx());
    surface.triangles.push_back(triangle);
  }
  return surface;
}

}  // namespace fsi
