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
  /// What they add without flow, which is then taken off. \param factor  k, 1/ms
  void subtract_still_pressures(double factor, double time, const std::vector<double>& reference,
                                std::vector<double>& pressures) const;
  /// Sets what the network keeps at a balance.
  void settle(const FluidInput& in, double time, const std::vector<double>& reference, std::vector<double>& kept) const;
  /// dp_i/dQ_j at a balance, row by row, kPa ms/mm^3.
  std::vector<double> slopes(const FluidInput& in, double time, const std::vector<double>& reference) const;
  /// Whether a valve that opened or closed since then has made the last slopes others, by far.
  bool outdated() const;
  /// At a finished level. The pressures of nodes that are openings are the fluid's there: those of a network with the flows of
  /// the level mean little behind a closed valve, which lets next to nothing through, where levels are extrapolated.
  NetworkState at_level(double time, const std::vector<double>& kept, const std::vector<double>& mesh,
                        const std::vector<double>& flow) const;

  /// Of a stage that finds no solution: what a valve did in it; empty where none had a part in it.
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
  /// Of elements that switch, since the last settle(): whether they were open, how often that changed. Told to the user of a
  /// run that fails.
  struct Course {
    bool seen = false, open = false;
    int changes = 0;
  };
  mutable std::vector<Course> courses_;
  mutable std::vector<double> conductances_, of_slopes_;  ///< of valves: at the last pressures, and at the last slopes
  mutable std::string unsettled_;
};

}  // namespace fsi
