#pragma once

#include <algorithm>
#include <vector>

#include "scene/scene.hpp"

namespace fsi {

/// Jacobians of fluid and wall of a second pair of systems on a scene. A scene has one set of matrices, to which solvers of
/// all its systems refer: each pair solves with its own values there.
template <int n>
class OwnJacobians {
 public:
  explicit OwnJacobians(Scene<n>& scene) : scene_(scene) {}

  /// For as long as it lives the scene has the values of the second pair.
  class Use {
   public:
    explicit Use(OwnJacobians& own) : own_(own) { own_.exchange(); }
    ~Use() { own_.exchange(); }
    Use(const Use&) = delete;
    Use& operator=(const Use&) = delete;

   private:
    OwnJacobians& own_;
  };

 private:
  void exchange() {
    exchange(scene_.fluid->jacobian(FluidDerivatives::fluid).fluid.values, fluid_);
    exchange(scene_.wall->jacobian().values, wall_);
  }
  /// In place: solvers may know where the numbers are.
  static void exchange(std::vector<double>& a, std::vector<double>& b) {
    b.resize(a.size());
    std::swap_ranges(a.begin(), a.end(), b.begin());
  }

  Scene<n>& scene_;
  std::vector<double> fluid_, wall_;
};

}  // namespace fsi
