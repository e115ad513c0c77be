#pragma once

#include <cstdint>
#include <vector>

#include "scene/scene.hpp"
#include "time/stepper.hpp"

namespace fsi {

/// What a run's seconds are divided by to compare machines: the seconds of one product y = K x with the matrix of the
/// whole scene, by the threads and processes of the run (docs/guide/solvers.md, "Work units").
struct WorkUnit {
  double seconds = 0;        ///< of the fastest product
  int products = 0;          ///< that were timed; 0: the unit is not known
  std::int64_t entries = 0;  ///< numbers of K that one product reads, of all processes
  double spent = 0;          ///< s, on measuring
};

/// K of a scene: the Jacobian of fluid, mesh motion and wall at once, all with derivatives by the movement of the
/// domain, boundary and interface conditions not imposed; of a scene of one medium that one's.
///
///     | F  S  . |   F: (momentum, continuity) by (u, p)     S: the same by d_m
///     | .  M  . |   M: the mesh motion, one number a component, or blocks where it is not linear
///     | .  .  W |   W: (momentum, volume) by (d_s, p_s)
///
/// F, S and M have one sparsity, the fluid's graph, and a product's time depends on the sparsity, not on the values. So
/// F's values, which are at least as many, stand for those of S and M. That makes K the same for both drivers: the
/// partitioned one has no S, and making one would take the time of several products, and memory.
template <int n>
class CoupledProduct {
 public:
  /// \param scene  must outlive this
  explicit CoupledProduct(const Scene<n>& scene);

  /// For all processes together: ghosts get their owners' values, then each has its rows. x is one everywhere.
  /// \param values  of F and W, of the media that the scene has
  void multiply(const MatrixValues& values);

  /// Of the last product, in the layouts of the media. Meaningful only where the scene has one medium.
  const std::vector<double>& fluid_rows() const { return fluid_rows_; }
  const std::vector<double>& mesh_rows() const { return mesh_rows_; }
  const std::vector<double>& wall_rows() const { return wall_rows_; }

  /// For all processes together.
  std::int64_t entries() const;

 private:
  const Scene<n>& scene_;
  std::vector<double> fluid_, mesh_, wall_, fluid_rows_, mesh_rows_, wall_rows_;
};

/// Measures the work unit of a run, a product after each of its first steps. Nothing that a step reads is changed.
template <int n>
class WorkUnitMeter {
 public:
  static constexpr int enough = 5;                ///< products
  static constexpr double largest_share = 0.005;  ///< of the run so far, but for the first product

  /// \param scene  must outlive this
  explicit WorkUnitMeter(const Scene<n>& scene) : scene_(scene) {}

  /// Times another product unless there are `enough`, or they would take too large a share. For all processes together.
  /// \param elapsed  s, of the run so far
  /// \param values   of the matrices that the run solves with; nothing is measured without those of each medium
  void measure(double elapsed, const MatrixValues& values);

  const WorkUnit& unit() const { return unit_; }

 private:
  const Scene<n>& scene_;
  WorkUnit unit_;
};

}  // namespace fsi
