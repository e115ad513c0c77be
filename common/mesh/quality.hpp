#pragma once

#include <array>
#include <string>
#include <vector>

#include "mesh/simplex_mesh.hpp"

namespace fsi {

/// Mean ratio of a tetrahedron, eta = 12 (3 V)^(2/3) / sum of squared edge lengths: 1 when regular, 0 when flat,
/// negative when inverted [Liu1994].
double mean_ratio(const std::array<Point, 4>& corners);

/// Smallest of the six angles between the facets of a tetrahedron, in degrees; 70.53 when regular.
double smallest_dihedral(const std::array<Point, 4>& corners);

/// Figures that tell whether a mesh is fit for use.
struct MeshQuality {
  struct Region {
    std::string name;
    std::size_t tetrahedra = 0;
    double volume = 0;        ///< mm^3
    double min_eta = 0;       ///< smallest mean ratio
    double mean_eta = 0;      ///< mean of the mean ratios
    double min_dihedral = 0;  ///< degrees
    int layers = 0;           ///< element layers across, see element_layers(); 0 where the question has no answer
    std::size_t poor = 0;     ///< elements beyond poor_eta or poor_dihedral
    int worst = -1;           ///< the element of the smallest mean ratio: its number in the mesh,
    Point worst_at{};         ///< and its centre, mm
  };
  std::size_t nodes = 0;
  std::size_t tetrahedra = 0;
  double min_eta = 0;
  double mean_eta = 0;
  double min_dihedral = 0;  ///< degrees
  std::vector<Region> regions;
};

/// Element layers across a shell-like region: the fewest element edges, all inside the region, that lead from one of
/// its faces to the other. Faces are the connected parts of its boundary without the group `wall_ends`. 0 when there
/// are not exactly two of them (a solid region such as the fluid has one).
int element_layers(const TetrahedralMesh& mesh, int region);

MeshQuality measure_quality(const TetrahedralMesh& mesh);

/// A mean ratio below this, or a dihedral angle below that, makes the linear systems hard and the answer poor: the
/// stabilisation's length and the stiffness differ by more than ten between the directions of such an element.
constexpr double poor_eta = 0.2;
constexpr double poor_dihedral = 5;  ///< degrees

/// One sentence for each region with poor elements: how many, which is the worst, where, and what to do.
std::vector<std::string> warnings_of(const MeshQuality& quality);

/// A table for the console, one line per region and one for the whole mesh, each ended by a newline.
std::string to_text(const MeshQuality& quality);

}  // namespace fsi
