#pragma once

#include <memory>
#include <vector>

#include "mesh/submesh.hpp"

namespace fsi {

/// Flow, mean pressure and area of a plane cut.
struct PlaneRow {
  double flow = 0;      ///< mm^3/ms along the plane's normal; of plane scenes mm^2/ms, per mm of thickness
  double pressure = 0;  ///< kPa, mean over the area; 0 where that is empty
  double area = 0;      ///< mm^2; of plane scenes mm
};

/// A plane fixed in space that cuts the fluid, whose mesh moves through it; the connected piece of the cut nearest to
/// the plane's origin counts. Its flow is the integral of u . n over that piece,
///   sum over cut cells of integral u . cof(dx/dxi) N dS,
/// x being the current position of the nodes. As the planes stand still, the flows through two of them differ by the
/// rate at which the volume between them grows.
///
/// Straight cells are cut by the plane itself; curved ones by a surface near it (cut_cell) whose pieces meet from cell
/// to cell and whose rim lies on the curved wall, so that the flow of a velocity without divergence stays the same.
///
/// Where processes share the part, a piece may extend over several of them. Each sends its integrals over the pieces of
/// its cells, and each makes the row of all messages: pieces of two processes are one where both have the same cell.
class PlaneCut {
 public:
  virtual ~PlaneCut() = default;
  /// Row of a part that is whole here.
  /// \param mesh   displacement of the fluid's nodes, mm, vector layout; empty: they do not move
  /// \param fluid  (u, p), mixed layout
  virtual PlaneRow look(const std::vector<double>& mesh, const std::vector<double>& fluid) const = 0;

  /// The same plane through another copy of its part, or a process's share of it. The original part is no longer
  /// needed.
  /// \param here  a part of the same dimension and order; must outlive what is returned
  virtual std::shared_ptr<const PlaneCut> through(const PartNodes& here) const = 0;
  /// Of such a share: appends this process's integrals and shared cells to the message `said`.
  virtual void say(const std::vector<double>& mesh, const std::vector<double>& fluid,
                   std::vector<double>& said) const = 0;
};

/// The rows of planes through one part, in their order, by one message per process. Collective over the processes that
/// share the part. Parameters as in PlaneCut::look().
std::vector<PlaneRow> look_at(const std::vector<const PlaneCut*>& planes, const std::vector<double>& mesh,
                              const std::vector<double>& fluid, const Communicator& processes);
/// The message of one process, and below the rows that all messages, one behind the other, make.
std::vector<double> message_on(const std::vector<const PlaneCut*>& planes, const std::vector<double>& mesh,
                               const std::vector<double>& fluid);
std::vector<PlaneRow> rows_of_messages(const std::vector<double>& messages, std::size_t planes);

/// Makes a plane cut of a part.
/// \param part    the fluid; must outlive what is returned
/// \param origin  a point of the plane, mm
/// \param normal  of any length; in triangle meshes its component in their plane counts
/// \param turned  whether triangles stand for a body of revolution: areas are multiplied by 2 pi r
/// \returns null if the plane does not cut the part at rest, or that component is zero. A plane on a face of the part
/// cuts it
template <int Dim, int Order>
std::shared_ptr<const PlaneCut> plane_cut(const Submesh<Dim, Order>& part, const Point& origin, const Point& normal,
                                          bool turned);

}  // namespace fsi
