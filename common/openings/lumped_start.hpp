#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "openings/opening_law.hpp"

namespace fsi {

/// A vessel without resistance, inertia and compliance of its own: all its openings have one pressure, and what flows
/// in at some leaves by those with a law. Given is that pressure or, where `pressure` is empty, the flow that enters.
struct LumpedVessel {
  std::vector<std::shared_ptr<const OpeningLaw>> laws;
  std::function<double(double)> pressure;  ///< kPa at a time in ms
  std::function<double(double)> inflow;    ///< mm^3/ms at a time in ms
  double period = 0;                       ///< ms, of these
};

/// What the laws keep at time 0 in the periodic state, a vector for each law. The laws are linear, so that a period
/// (implicit midpoint rule, `steps` of them) is an affine map, whose fixed point this is. Where a flow is given, slopes
/// of laws must not be zero.
/// \throws std::runtime_error where there is none, or where a flow is given and there is no law
std::vector<std::vector<double>> periodic_start(const LumpedVessel& vessel, int steps = 2048);

}  // namespace fsi
