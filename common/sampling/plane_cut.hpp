#pragma once

#include <memory>
#include <vector>

#include "mesh/submesh.hpp"

namespace fsi {

/// What passes a plane.
struct PlaneRow {
  double flow = 0;      ///< mm^3/ms along the plane's normal; of plane scenes mm^2/ms, per mm of thickness
  double pressure = 0;  ///< kPa, mean over the area; 0 where that is empty
  double area = 0;      ///< mm^2; of plane scenes mm
};

/// A plane fixed in space and the fluid that it cuts where the mesh stands at the time: of the cut the connected piece
/// nearest to the origin. Its flow is the integral of u . n over that piece,
///   sum over cut cells of integral u . cof(dx/dxi) N dS,
/// x being the present position of the nodes. As the plane stands still, flow through two planes differs by what the
/// volume between them gains.
///
/// Straight cells are cut by the plane itself; curved ones by a surface near it (cut_cell) whose pieces meet from cell to
/// cell and whose rim lies on the curved wall, so that the flow of a velocity without divergence is not changed by it.
class PlaneCut {
 public:
  virtual ~PlaneCut() = default;
  /// \param mesh   displacement of the fluid's nodes, vectors; empty: they do not move
  /// \param fluid  (u, p)
  virtual PlaneRow look(const std::vector<double>& mesh, const std::vector<double>& fluid) const = 0;
};

/// \param part    the fluid; must outlive what is returned
/// \param normal  of any length; of triangle parts its component in their plane counts, which must not be zero
/// \param turned  whether triangles stand for the body that they are turned out of: areas are multiplied by 2 pi r
/// \returns null when the plane does not cut the part at rest. A plane on a face of the part cuts it
template <int Dim, int Order>
std::shared_ptr<const PlaneCut> plane_cut(const Submesh<Dim, Order>& part, const Point& origin, const Point& normal,
                                          bool turned);

}  // namespace fsi
