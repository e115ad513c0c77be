#pragma once

#include <complex>
#include <cstddef>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "fluid/inflow_profile.hpp"
#include "fluid/periodic_flow.hpp"

namespace fsi {

/// Velocity on an opening of the fully developed flow of a periodic flow rate (Womersley). The rate's Fourier modes
/// have a profile each (docs/theory.md, section 3.6):
///   circle, circle about the axis   1 - J_0(l r) / J_0(l R),     l^2 = -i k w / nu,
///   straight segment                1 - cosh(l s) / cosh(l h),   l^2 = i k w / nu,
///   else the solution of i k w f - nu Laplace f = 1, f = 0 where the fluid sticks, on the opening's facets.
/// Each is scaled to a discrete flow of one. As many modes are taken as leave less than 0.5 % of the rate's root mean
/// square, 64 at most. What they leave, and what a rate asked for differs by, flows with the real part of the last
/// mode's profile, so that the discrete flow is that asked for to rounding.
class WomersleyInflow {
 public:
  using Complex = std::complex<double>;
  struct Modes {
    std::vector<std::size_t> entries;            ///< per node of the opening, first entry of its vector, vector layout
    std::vector<double> direction;               ///< components of the inward normal
    std::vector<std::vector<Complex>> profiles;  ///< per mode and node, of unit flow, 1/mm^2
    std::vector<Complex> coefficients;           ///< per mode, of the flow rate, mm^3/ms
  };

  WomersleyInflow(PeriodicFlow flow, Modes modes, std::string instead)
      : flow_(std::move(flow)), modes_(std::move(modes)), instead_(std::move(instead)) {}

  /// Sets the vectors of the opening's nodes, in the vector layout of the part (its other entries stay), to the
  /// velocity in mm/ms at a time in ms. \param flow_rate  that the discrete flow into the fluid shall have, mm^3/ms
  void set(double time, double flow_rate, std::vector<double>& velocity) const;
  /// The same with the periodic rate itself.
  void set(double time, std::vector<double>& velocity) const { set(time, flow_.at(time), velocity); }

  /// Restricts the inflow to a part of the fluid and renumbers it.
  /// \param entry_there  maps the first entry of a node's vector to that in the part; negative: the node is not in it
  void keep(const std::function<std::ptrdiff_t(std::size_t entry)>& entry_there);

  const PeriodicFlow& flow() const { return flow_; }
  int modes() const { return static_cast<int>(modes_.profiles.size()) - 1; }  ///< besides the mean
  /// A sentence: what was taken in place of the closed forms; empty: nothing.
  const std::string& instead() const { return instead_; }

 private:
  PeriodicFlow flow_;
  Modes modes_;
  std::string instead_;
};

/// \param density    mg/mm^3
/// \param viscosity  kPa ms
/// \throws InputError as plug_inflow()
template <class Element>
WomersleyInflow womersley_inflow(const InflowOpening<Element>& opening, const PeriodicFlow& flow, double density,
                                 double viscosity);

}  // namespace fsi
