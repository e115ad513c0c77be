#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "fluid/fluid_input.hpp"
#include "fluid/open_boundary.hpp"
#include "openings/joined_openings.hpp"
#include "openings/opening_law.hpp"

namespace fsi {

/// What lies behind the openings of the fluid, as far as the pressure depends on the flow, and what they keep from step
/// to step in Solution::openings: first the numbers of the laws, then those of the network, then pressure (kPa) and
/// outward flow (mm^3/ms) of each opening that moves and whose flow is given; laws and such openings in the order of
/// the openings. This class alone knows where. Processes that share the fluid ask together and get the same numbers.
/// \tparam n  components of a vector
template <int n>
class Openings {
 public:
  /// An opening whose pressure depends on the flow.
  struct Answering {
    std::size_t number;  ///< among the openings
    const OpenBoundary<n>* surface;
    std::shared_ptr<const OpeningLaw> law;
    std::size_t place;  ///< of its numbers
  };
  /// An opening that moves and whose flow is given: the pressure that drives it is found with the step.
  struct Driven {
    std::size_t number;
    const OpenBoundary<n>* surface;
    std::size_t place;  ///< of the pressure; the flow is behind it
  };
  /// What one opening has behind it.
  struct Behind {
    std::shared_ptr<const OpeningLaw> law;  ///< null: no law
    bool flow_given = false;
    bool joined = false;  ///< by the network
  };

  Openings() = default;
  /// \param surfaces  must outlive this and keep its place
  /// \param behind    of each
  /// \param network   that joins those that are joined; null: none is
  Openings(const std::vector<OpenBoundary<n>>& surfaces, const std::vector<Behind>& behind,
           std::shared_ptr<const Network> network = nullptr);

  const std::vector<Answering>& answering() const { return answering_; }
  /// The law at an opening; null: there is none. \param number  of the opening
  const Answering* answering(std::size_t number) const {
    for (const Answering& opening : answering_)
      if (opening.number == number) return &opening;
    return nullptr;
  }
  const std::vector<Driven>& driven() const { return driven_; }
  const JoinedOpenings<n>& joined() const { return joined_; }

  /// How many numbers they keep.
  std::size_t size() const { return size_; }
  /// These at the start. \param pressure  kPa, where the flow is given
  std::vector<double> start(double pressure) const;
  /// What the laws' numbers change by at the start, 1/ms. \param kept  start()
  std::vector<double> start_rates(const std::vector<double>& kept, const std::vector<double>& mesh,
                                  const std::vector<double>& flow) const;

  /// The pressures from outside at a balance, kPa, of all openings in their order.
  /// \param applied    by tables; missing ones are zero
  /// \param time       ms, of the balance
  /// \param reference  r of the numbers kept: dy/dt = in.fluid_factor (y - r)
  std::vector<double> pressures(const std::vector<double>& applied, const FluidInput& in, double time,
                                const std::vector<double>& reference, const std::vector<double>& kept) const;
  /// Sets what they keep at a balance from the flow there; pressures that drive flows are there already.
  void settle(const FluidInput& in, double time, const std::vector<double>& reference, std::vector<double>& kept) const;

  /// The pressure that drives a flow, kPa. \tparam Kept  their numbers, const or not
  template <class Kept>
  static auto& pressure(const Driven& opening, Kept& kept) {
    return kept[opening.place];
  }
  /// The flow outward that is given at a balance of the stage from the level with `kept` on, mm^3/ms.
  /// \param end    that at the stage's end
  /// \param carry  theta: the stage ends with y_0 + (y - y_0) / theta
  static double given_outflow(const Driven& opening, const std::vector<double>& kept, double end, double carry) {
    const double start = kept[opening.place + 1];
    return carry == 1 ? end : start + carry * (end - start);
  }

 private:
  std::size_t count_ = 0, size_ = 0;
  std::vector<Answering> answering_;
  JoinedOpenings<n> joined_;
  std::vector<Driven> driven_;
};

}  // namespace fsi
