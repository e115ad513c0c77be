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
///
/// Where the part is shared out among processes, a piece may run through several of them. Each says what it sees of the
/// pieces, and all make the row of what all have said: pieces of two processes are one where both have the same cell.
class PlaneCut {
 public:
  virtual ~PlaneCut() = default;
  /// Of a part that is whole here.
  /// \param mesh   displacement of the fluid's nodes, vectors; empty: they do not move
  /// \param fluid  (u, p)
  virtual PlaneRow look(const std::vector<double>& mesh, const std::vector<double>& fluid) const = 0;

  /// The same plane through another copy of its part, or the share of it that a process holds: its own part need not be there
  /// any more. \param here  must outlive what is returned
  virtual std::shared_ptr<const PlaneCut> through(const PartNodes& here) const = 0;
  /// Of such a share: adds to `said` what its process sees of the plane.
  virtual void say(const std::vector<double>& mesh, const std::vector<double>& fluid,
                   std::vector<double>& said) const = 0;
};

/// The rows of planes through one part, in their order. Processes that share the part out ask for them together, in one
/// message. Parameters as in PlaneCut::look().
std::vector<PlaneRow> look_at(const std::vector<const PlaneCut*>& planes, const std::vector<double>& mesh,
                              const std::vector<double>& fluid, const Communicator& processes);
/// The message of one process to the others in it, and what all of them, one after the other, say.
std::vector<double> message_on(const std::vector<const PlaneCut*>& planes, const std::vector<double>& mesh,
                               const std::vector<double>& fluid);
std::vector<PlaneRow> rows_of_messages(const std::vector<double>& messages, std::size_t planes);

/// \param part    the fluid; must outlive what is returned
/// \param normal  of any length; of triangle parts its component in their plane counts, which must not be zero
/// \param turned  whether triangles stand for the body that they are turned out of: areas are multiplied by 2 pi r
/// \returns null when the plane does not cut the part at rest. A plane on a face of the part cuts it
template <int Dim, int Order>
std::shared_ptr<const PlaneCut> plane_cut(const Submesh<Dim, Order>& part, const Point& origin, const Point& normal,
                                          bool turned);

}  // namespace fsi
