#pragma once

#include <algorithm>
#include <vector>

#include "scene/scene.hpp"
#include "time/restart_archive.hpp"
#include "time/stepper.hpp"

namespace fsi {

/// How well fluid and wall satisfy the interface conditions (docs/theory.md, section 10.6). Root mean squares are over
/// the interface's area.
struct InterfaceAgreement {
  double slip = 0;                ///< mm, root mean square of the integral of u - v over time
  double largest_slip = 0;        ///< mm, of a node, at the end
  double largest_separation = 0;  ///< mm, of a node, of d_m - d_s at any level so far
  double motion = 0;              ///< mm, the largest displacement of a node from where the run began, so far
  /// kPa, root mean square of the unbalanced traction, averaged over the steps looked at, weighted by their lengths
  double lasting_traction = 0;
  double largest_traction = 0;  ///< kPa, root mean square of the unbalanced traction in the worst of these steps
  double traction = 0;          ///< kPa, root mean square of the fluid's traction, largest of these steps
  int weighed_steps = 0;        ///< steps whose tractions were looked at

  /// Gap relative to the motion, unbalanced traction relative to the fluid's; 0 where nothing moves, or bears.
  double gap_share() const { return motion > 0 ? std::max(largest_slip, largest_separation) / motion : 0; }
  double traction_share() const { return traction > 0 ? lasting_traction / traction : 0; }
};

/// Watches the residual of the conditions between fluid and wall over a run, independently of the solver's own tests. A
/// gap too small for a step's test shows when it accumulates. Reads states and balances only. Processes that share the
/// scene call it together.
template <int n>
class InterfaceWatch {
 public:
  using Vector = VectorLayout<n>;
  using Mixed = MixedLayout<n>;

  /// \param scene  coupled, in time; must outlive this
  explicit InterfaceWatch(const Scene<n>& scene)
      : scene_(scene), slip_(scene.interface.size() * n, 0.0), unbalanced_(slip_) {}

  /// The run begins, or goes on, from a level.
  void begin(const State& level);
  /// Takes in the step that led to a level. \param balances  of that step
  void follow(const State& level, const std::vector<Balance>& balances);
  /// Takes in the tractions of a balance. Assembles fluid and wall once.
  void weigh(const Balance& balance);

  InterfaceAgreement so_far() const;
  /// What a restart needs.
  void keep(RestartArchive& archive);

 private:
  double root_mean_square(const std::vector<double>& vectors) const;
  /// Of nodal forces, kPa: sqrt(sum of |force|^2 / area over the whole area).
  double root_mean_traction(const std::vector<double>& forces) const;
  /// sqrt(sum of |vector|^2 weight(area) over the whole area), nodes without area left out.
  template <class Weight>
  double root_mean(const std::vector<double>& vectors, Weight weight) const;
  double largest(const std::vector<double>& vectors) const;
  /// Sets the components of nodal forces that conditions of the wall hold to zero.
  void leave_free(std::vector<double>& forces) const;

  const Scene<n>& scene_;
  std::vector<double> start_;       ///< mm, vectors per interface node: d_s where the run began
  std::vector<double> slip_;        ///< mm, likewise: integral of u - v
  std::vector<double> unbalanced_;  ///< mN ms, likewise: sum over the steps weighed, times their lengths
  double weighed_ = 0, weighed_time_ = 0, separation_ = 0, motion_ = 0, largest_traction_ = 0, traction_ = 0;
  std::vector<double> fluid_rows_, wall_rows_;
};

}  // namespace fsi
