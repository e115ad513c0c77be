#pragma once

#include <array>
#include <string>
#include <vector>

#include "mesh/simplex_mesh.hpp"

namespace fsi {

/// Mean ratio of a tetrahedron, eta = 12 (3 V)^(2/3) / sum of squared edge lengths: 1 when regular, 0 when flat,
/// negative when inverted [Liu1994].
double mean_ratio(const std::array<Point, 4>& corners);

/// Mean ratio of a triangle in its plane, eta = 4 sqrt(3) A / sum of squared edge lengths, likewise.
double mean_ratio(const std::array<Point, 3>& corners);

/// Smallest of the six angles between the facets of a tetrahedron, in degrees; 70.53 when regular.
double smallest_dihedral(const std::array<Point, 4>& corners);

/// Smallest of the three angles of a triangle, in degrees; 60 when regular.
double smallest_angle(const std::array<Point, 3>& corners);

/// Quality of a mesh. Mean ratios and angles are those of the straight cells between the vertices.
struct MeshQuality {
  struct Region {
    std::string name;
    std::size_t cells = 0;
    double volume = 0;        ///< mm^3; of triangles their area, mm^2; that of the curved cells
    double min_eta = 0;       ///< smallest mean ratio
    double mean_eta = 0;      ///< mean of the mean ratios
    double min_angle = 0;     ///< degrees; smallest dihedral angle of tetrahedra, smallest angle of triangles
    double min_jacobian = 1;  ///< smallest ratio of least to mean det J in a cell; 1 where cells are straight
    int layers = 0;           ///< element layers across, see element_layers(); 0 where it is undefined
    std::size_t poor = 0;     ///< elements below poor_eta, poor_angle or poor_jacobian
    int worst = -1;           ///< number in the mesh, from 0, of the element with the smallest eta or least/mean det J
    Point worst_at{};         ///< its centre, mm
    double worst_eta = 0;     ///< its mean ratio
  };
  int dimension = 3, order = 1;
  std::size_t nodes = 0;
  std::size_t cells = 0;
  double min_eta = 0;
  double mean_eta = 0;
  double min_angle = 0;  ///< degrees
  double min_jacobian = 1;
  std::vector<Region> regions;
};

/// Element layers across a shell-like region: the fewest element edges, all inside the region, from one of its faces to
/// the other. Faces are the connected parts of its boundary without `wall_ends` and the planes of symmetry. 0 when
/// there are not exactly two of them (a solid region such as the fluid has one).
template <int Dim, int Order>
int element_layers(const SimplexMesh<Dim, Order>& mesh, int region);

template <int Dim, int Order>
MeshQuality measure_quality(const SimplexMesh<Dim, Order>& mesh);

/// Below this mean ratio linear systems are hard to solve and results poor: the stabilisation's length and the
/// stiffness differ by more than ten between the directions of such an element.
constexpr double poor_eta = 0.2;
constexpr double poor_angle = 5;  ///< the same of a (dihedral) angle, degrees
/// Where det J falls below this part of its mean in the element, quadratic shape functions interpolate poorly.
constexpr double poor_jacobian = 0.2;

/// One sentence for each region with poor elements: how many, which is the worst, where, and what to do.
std::vector<std::string> warnings_of(const MeshQuality& quality);

/// A table for the console, one line per region and one for the whole mesh, each ended by a newline.
std::string to_text(const MeshQuality& quality);

}  // namespace fsi
