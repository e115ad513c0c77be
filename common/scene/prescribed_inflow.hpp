#pragma once

#include <algorithm>
#include <cstddef>
#include <functional>
#include <utility>
#include <vector>

#include "fem/nodal_layout.hpp"
#include "time/step_data.hpp"

namespace fsi {

/// The velocity at the nodes of an opening whose flow is given (docs/theory.md, section 3.5): u = Q(t) times a nodal
/// profile of unit flow into the fluid, or a profile that changes in time.
/// \tparam n  components of a vector
template <int n>
class PrescribedInflow {
 public:
  /// Sets the opening's vectors in an array of the vector layout to mm/ms, for a time in ms and a flow in mm^3/ms.
  using Profile = std::function<void(double time, double flow, std::vector<double>& velocity)>;

  /// \param opening  its number among the scene's
  /// \param nodes    whose velocity is prescribed
  /// \param size     of an array in the fluid's vector layout
  PrescribedInflow(std::size_t opening, std::vector<int> nodes, std::size_t size, Profile profile)
      : opening_(opening), nodes_(std::move(nodes)), profile_(std::move(profile)), velocity_(size, 0.0) {}

  std::size_t opening() const { return opening_; }
  const std::vector<int>& nodes() const { return nodes_; }

  /// Writes the velocity of a balance to a flow array (u, p): level + carry (end - level), `end` being the velocity of
  /// the flow in `data` at the stage's end, which the scheme then reaches. Not thread-safe: uses storage of the object.
  /// \param level  flow array that the stage starts from
  /// \param data   without flows the fluid stands still there
  void impose(const std::vector<double>& level, const StepData& data, std::vector<double>& flow) const {
    using Mixed = MixedLayout<n>;
    if (data.opening_flows.empty())
      std::fill(velocity_.begin(), velocity_.end(), 0.0);
    else
      profile_(data.rates.end, data.opening_flows[opening_], velocity_);
    for (const int node : nodes_)
      for (int k = 0; k < n; ++k) {
        const std::size_t at = Mixed::vector(node, k);
        const double end = velocity_[VectorLayout<n>::vector(node, k)];
        flow[at] = data.rates.carry == 1 ? end : level[at] + data.rates.carry * (end - level[at]);
      }
  }

 private:
  std::size_t opening_;
  std::vector<int> nodes_;
  Profile profile_;
  mutable std::vector<double> velocity_;  ///< storage
};

}  // namespace fsi
