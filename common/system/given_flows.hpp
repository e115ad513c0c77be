#pragma once

#include <cstddef>
#include <vector>

#include "scene/scene.hpp"
#include "time/step_data.hpp"

namespace fsi {

/// The openings of a scene that move and whose flow is given (docs/theory.md, section 3.8): the residual of their
/// flows, and its weight in norms. Processes that share the scene call it together and get the same numbers.
template <int n>
class GivenFlows {
 public:
  GivenFlows() = default;  ///< none
  /// \param scene  must outlive this
  explicit GivenFlows(const Scene<n>& scene);

  std::size_t count() const { return flows_.size(); }
  const OpenBoundary<n>& open(std::size_t i) const { return *flows_[i].opening->surface; }
  /// The pressure that drives the flow, kPa: unknown, part of a solution. \tparam AnySolution  const or not
  template <class AnySolution>
  auto& pressure(std::size_t i, AnySolution& solution) const {
    return Openings<n>::pressure(*flows_[i].opening, solution.openings);
  }
  /// Outward flow less the given one at the last compare(), mm^3/ms.
  double gap(std::size_t i) const { return flows_[i].gap; }

  /// Finds the gaps of state.now. \returns the sum of squares of gap() times force_of_gap()
  double compare(const State& state, const StepData& data);
  /// The weight of 1 mm^3/ms of a gap, kPa mm^2: the force on the opening of a pressure which within a step accelerates
  /// the flow over the opening's width, and widens the wall by what has come in. \param fluid_factor  of the step, 1/ms
  double force_of_gap(std::size_t i, double fluid_factor) const;

 private:
  struct Flow {
    const typename Openings<n>::Driven* opening;
    double normal, area;  ///< at rest, mm^2: Euclidean norm of the integrals of N_a n; the area
    double gap;
  };
  const Scene<n>* scene_ = nullptr;
  double stiffness_ = 0;  ///< of the wall around the fluid's volume, kPa/mm^3
  std::vector<Flow> flows_;
};

}  // namespace fsi
