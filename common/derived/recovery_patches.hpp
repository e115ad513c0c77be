#pragma once

#include <cstddef>
#include <vector>

#include "math/tensor.hpp"
#include "mesh/simplex_mesh.hpp"

namespace fsi {

/// A plane in which a body is mirrored: beyond it lies the mirror image. The axis of a body of revolution is such a
/// plane of the half that is meshed.
struct RecoveryMirror {
  Point normal;            ///< unit vector, either way round
  std::vector<int> nodes;  ///< that lie in it
};

/// The cells on which a field is smooth, and the axes of space of its coordinates and components.
struct RecoveryCells {
  const std::vector<Point>& points;  ///< mm, per node
  std::vector<int> nodes;            ///< of the cells, nodes_per_cell for each
  int nodes_per_cell;
  int order;              ///< of the element: 1 or 2
  std::vector<int> axes;  ///< of space, one per coordinate
  bool axisymmetric = false;
  std::vector<RecoveryMirror> mirrors{};
  bool along_boundaries = false;  ///< the field follows curved boundaries, as in thin layers of a wall
  int corners = static_cast<int>(axes.size()) + 1;  ///< of a cell, its first nodes; facets have one less
};

/// A node of a patch, or an image of one.
struct PatchPoint {
  int node;
  int image;       ///< the isometry that brings it here, a number of RecoveryPatches; 0: the node itself
  Point position;  ///< mm
};

/// Rings of cells around nodes, continued by mirror images at planes of symmetry: a patch there reaches equally far to
/// both sides. Where planes meet at an angle pi/m their images fill the space around the edge. At another
/// angle, or where cells lie on both sides of a plane, the images make no body, and the patch ends at the cells.
class RecoveryPatches {
 public:
  /// \param cells  must outlive this
  explicit RecoveryPatches(const RecoveryCells& cells);

  /// Begins a new patch with a node alone, which stays its first point.
  void begin(int node);
  /// Adds the nodes of all cells that touch the patch.
  void grow();
  const std::vector<PatchPoint>& points() const { return patch_; }

  /// The linear part of an image: a vector field u at a node is `turn * u` at the node's image. Of 0 the identity.
  const Mat3<double>& turn(int image) const { return isometries_[static_cast<std::size_t>(image)].turn; }
  int images() const { return static_cast<int>(isometries_.size()); }

 private:
  struct Isometry {  ///< x -> turn x + shift
    Mat3<double> turn;
    Point shift;
    Point operator()(const Point& x) const;
  };
  struct Plane {
    Point normal;
    double offset;  ///< mm, of normal . x on it
  };

  void set_planes();
  /// Whether the planes at a node mirror the cells there, and each other.
  bool are_mirrors(int node, const std::vector<int>& planes) const;
  /// The number of the isometry that mirrors in a plane first and does `image` then.
  int after_mirror(int image, int plane);
  /// The images of the cells around a point of the patch.
  std::vector<int> images_around(const PatchPoint& point);
  void add(int node, int image);

  const RecoveryCells& cells_;
  std::vector<std::size_t> offsets_, cells_of_;  ///< cells around nodes
  std::vector<Plane> planes_;
  std::vector<std::vector<int>> planes_at_;     ///< per node; empty when there are no planes
  std::vector<Isometry> isometries_;            ///< those met so far, the identity first
  std::vector<std::vector<int>> after_mirror_;  ///< per isometry and plane, its number; -1: not met
  std::vector<PatchPoint> patch_;
  std::vector<int> first_, next_;  ///< per node and per point of the patch: points of the same node; -1: none
  std::size_t grown_ = 0;          ///< points whose cells are in the patch
};

}  // namespace fsi
