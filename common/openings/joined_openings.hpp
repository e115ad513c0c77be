#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "fluid/fluid_input.hpp"
#include "fluid/open_boundary.hpp"
#include "network/network.hpp"

namespace fsi {

/// Openings that a network joins: what flows out at one of them changes the pressure at all. The network gives their
/// pressures with each residual, from the flows there at the same time, so that nothing lags behind.
/// \tparam n  components of a vector
template <int n>
class JoinedOpenings {
 public:
  struct Opening {
    std::size_t number;  ///< among the openings
    const OpenBoundary<n>* surface;
  };

  JoinedOpenings() = default;
  /// \param openings  in the order of the network's
  /// \param place     of what the network keeps, in Solution::openings
  JoinedOpenings(std::vector<Opening> openings, std::shared_ptr<const Network> network, std::size_t place);

  const std::vector<Opening>& openings() const { return openings_; }
  bool empty() const { return openings_.empty(); }
  /// Not to be asked for where there are none.
  const Network& network() const { return *network_; }
  std::size_t place() const { return place_; }

  /// dy/dt at the start. \param kept, rates  of all openings
  void start_rates(const std::vector<double>& kept, const std::vector<double>& mesh, const std::vector<double>& flow,
                   std::vector<double>& rates) const;
  /// Adds the pressures at a balance, kPa; not a number where a valve finds neither open nor closed.
  /// \param time       ms, of the balance
  /// \param reference  r of all that openings keep
  void add_pressures(const FluidInput& in, double time, const std::vector<double>& reference,
                     std::vector<double>& pressures) const;
  /// Subtracts what add_pressures() would add without flow. \param factor  k, 1/ms
  void subtract_still_pressures(double factor, double time, const std::vector<double>& reference,
                                std::vector<double>& pressures) const;
  /// Sets what the network keeps at a balance.
  void settle(const FluidInput& in, double time, const std::vector<double>& reference, std::vector<double>& kept) const;
  /// dp_i/dQ_j at a balance, row by row, kPa ms/mm^3.
  std::vector<double> slopes(const FluidInput& in, double time, const std::vector<double>& reference) const;
  /// Whether a valve has opened or closed since slopes() was called, so that those slopes are far off.
  bool outdated() const;
  /// At a finished level. Nodes that are openings get the fluid's mean pressures: behind a closed valve, pressures of a
  /// network with the flows of an extrapolated level would mean little.
  NetworkState at_level(double time, const std::vector<double>& kept, const std::vector<double>& mesh,
                        const std::vector<double>& flow) const;

  /// For a stage without solution: what a valve did in it; empty where no valve had a part in that.
  std::string complaint() const;
  /// What helps against that.
  static constexpr const char* remedy = "a larger width or leak of that valve, or a capacitor or an inductor beside it";

 private:
  std::vector<double> inflows(const FluidInput& in) const;
  NetworkState with_flows_of_level(double time, const std::vector<double>& kept, const std::vector<double>& mesh,
                                   const std::vector<double>& flow) const;
  NetworkState at_balance(const FluidInput& in, double time, const std::vector<double>& reference) const;
  void watch_valves(const FluidInput& in, double time, const std::vector<double>& reference,
                    const NetworkState& state) const;

  std::vector<Opening> openings_;
  std::shared_ptr<const Network> network_;
  std::size_t place_ = 0;
  /// Of elements that switch, since the last settle(): whether they were open, how often that changed. For complaint().
  struct Course {
    bool seen = false, open = false;
    int changes = 0;
  };
  mutable std::vector<Course> courses_;
  mutable std::vector<double> conductances_, of_slopes_;  ///< of valves: at the last pressures, and at the last slopes
  mutable std::string unsettled_;
};

}  // namespace fsi
