#pragma once

#include <array>
#include <vector>

#include "fem/nodal_frames.hpp"
#include "linear/interface/field_numbering.hpp"
#include "linear/interface/medium_preconditioner.hpp"
#include "linear/krylov/gmres.hpp"
#include "partitioned/block_newton/block_vector.hpp"
#include "scene/scene.hpp"

namespace fsi {

/// The linear system of block Newton (docs/theory.md, section 10.4) where both media iterate: flexible GMRES in single
/// precision for fluid, wall and datum together, preconditioned by a pass in which each medium takes one cycle.
/// z_f and z_w being the media's unknowns as velocities, x the datum, C the impedance of the Robin condition:
///   J_f z_f - C x = r_f,   J_w z_w - C (z_f - x) = r_w,   C (z_w - z_f) = r_x,
/// all terms with C on the interface, J_f with C in its rows there. A pass is, with cycles for the inverses,
///   x = -r_x / C,   z_f = J_f^-1 (r_f + C x),   z_w = J_w^-1 (r_w + C (z_f - x)).
/// GMRES weights the rows of the datum by 3, as the gap converges last. No medium is solved exactly for a datum that is
/// not yet right.
template <int n>
class JointIteration {
 public:
  /// Counters of the seconds of each medium, added to.
  struct Seconds {
    double &fluid, &wall;
  };

  JointIteration(const Scene<n>& scene, const Numbering& fluid, const Numbering& wall);

  /// The Jacobians hold new values, or the Robin condition has another impedance.
  /// \param impedance  C, kPa mm^2/(mm/ms), per node of the scene's interface; zero where there is no condition
  void update(MediumPreconditioner& fluid, MediumPreconditioner& wall, const std::vector<double>& impedance);

  /// Layout of the vectors of solve(), as of the last update().
  const BlockLayout& layout() const { return layout_; }

  /// Solves for z and x up to a residual of `tolerance` |r|, by Euclidean norms with the datum's rows weighted.
  /// \param right     r; overwritten
  /// \param solution  (z_f, z_w, x)
  /// \returns iterations, also where it has not converged
  int solve(std::vector<float>& right, double tolerance, int most_iterations, std::vector<float>& solution,
            const Seconds& seconds);

 private:
  /// A node of the interface in the vectors of both media.
  struct Link {
    int fluid, wall;  ///< place of its velocity; -1: none
    float impedance;
    const NodalAxes<n>*fluid_axes, *wall_axes;  ///< null: those of space
    std::array<bool, n> fluid_free, wall_free;  ///< whether a component has an equation
  };
  using Vector = std::array<float, n>;
  using Blocks = BlockView<float>;
  static Vector vector_at(VectorView<const float> x, int place, const NodalAxes<n>* axes);
  static void add_to(const Vector& x, int place, const NodalAxes<n>* axes, const std::array<bool, n>& free,
                     VectorView<float> to);

  /// wall += sign C (z_f - x)
  void load_wall(const Blocks& z, float sign, VectorView<float> wall) const;
  /// z = the result of the pass for r, y = the matrix times z.
  void pass(const std::vector<float>& r, std::vector<float>& z, std::vector<float>& y, const Seconds& seconds);
  /// Adds the interface terms times z to the products of the media's Jacobians; the datum's products are set.
  void add_interface_terms(const Blocks& z, const Blocks& products) const;

  const Scene<n>& scene_;
  const Numbering &fluid_numbering_, &wall_numbering_;
  MediumPreconditioner *fluid_ = nullptr, *wall_ = nullptr;
  BlockLayout layout_;
  std::vector<Link> links_;
  SingleGmres gmres_;
  std::vector<float> in_;  ///< r of a pass, with the forces of the interface
};

}  // namespace fsi
