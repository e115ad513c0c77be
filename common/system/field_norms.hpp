#pragma once

#include <vector>

#include "scene/scene.hpp"
#include "system/numbering.hpp"

namespace fsi {

/// The norm of increments and iterates.
enum class SystemNorm {
  volumes,  ///< L2, each entry weighted with the volume that belongs to its node
  entries   ///< Euclidean
};

/// Norms of the solutions of a system, and of their increments in its unknowns: mm, mm/ms and kPa added up as they are
/// (docs/theory.md, section 9.3). Where the scene is shared out, all processes ask together and get the same numbers.
template <int n>
class FieldNorms {
 public:
  /// \param scene, numbering  must outlive this
  FieldNorms(const Scene<n>& scene, const Numbering& numbering, SystemNorm norm);

  /// To be called when the numbering's factors have changed.
  void follow_factors();

  /// Of an increment ([Langer2018], algorithm 1).
  double of_increment(const std::vector<double>& increment) const;
  double of_solution(const Solution& now) const;
  /// Whether the increment is at most `share` of the solution, each field by itself: units decide how large
  /// displacements are beside pressures.
  bool negligible(const std::vector<double>& increment, const Solution& now, double share) const;
  /// relative_to_step() of the increment: the largest of velocities, displacements of the wall and pressures of both.
  double relative_to_change(const std::vector<double>& increment, const State& state, const StepData& data) const;
  /// The largest |entry / factor| of each unknown, for estimates of rounding.
  std::vector<double> magnitudes(const Solution& now) const;

 private:
  using Vector = VectorLayout<n>;
  using Mixed = MixedLayout<n>;

  const Communicator& processes() const { return *numbering_.processes; }

  const Scene<n>& scene_;
  const Numbering& numbering_;
  std::vector<double> mesh_volumes_, fluid_volumes_, wall_volumes_;  ///< per node; zero at ghosts
  std::vector<double> weights_;                                      ///< per unknown, of the squared norm of increments
  mutable std::vector<double> fluid_, wall_;                         ///< storage
};

}  // namespace fsi
