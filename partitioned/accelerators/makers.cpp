#include "partitioned/accelerators/makers.hpp"

#include "partitioned/accelerators/iqn_ils.hpp"
#include "partitioned/accelerators/iqn_imvj.hpp"
#include "partitioned/accelerators/newton_krylov.hpp"
#include "partitioned/accelerators/regularised_iqn.hpp"
#include "partitioned/accelerators/relaxation.hpp"

namespace fsi::accelerators {

namespace {

constexpr double dirichlet_factor = 0.01;  // below the coarse artery's limit of about 0.014
constexpr double largest_aitken_start = 0.05;
constexpr double robin_factor = 1;  // plain Robin-Neumann needs no relaxation

double factor_or(double fallback, const PartitionedData& options) {
  return options.relaxation.value_or(fallback);
}

/// Dirichlet-Neumann overshoots what the differences have not explained yet, by some factor of one to ten.
constexpr double dirichlet_mixing = 0.5, robin_mixing = 1;

QuasiNewtonOptions quasi_newton(const PartitionedData& o, double factor, double mixing) {
  QuasiNewtonOptions options = o.quasi_newton;
  options.relaxation = factor_or(factor, o);
  options.mixing = mixing;
  return options;
}
QuasiNewtonOptions dirichlet_quasi_newton(const PartitionedData& o) {
  return quasi_newton(o, dirichlet_factor, dirichlet_mixing);
}
QuasiNewtonOptions robin_quasi_newton(const PartitionedData& o) {
  return quasi_newton(o, robin_factor, robin_mixing);
}

using Options = PartitionedData;
using Space = InterfaceSpace;

}  // namespace

Made constant(const Options& o, const Space&) {
  return std::make_unique<ConstantRelaxation>(factor_or(dirichlet_factor, o));
}
Made aitken(const Options& o, const Space& space) {
  return std::make_unique<AitkenRelaxation>(factor_or(dirichlet_factor, o), largest_aitken_start, space);
}
Made iqn_ils(const Options& o, const Space& space) {
  return std::make_unique<IqnIls>(dirichlet_quasi_newton(o), space);
}
Made iqn_imvj(const Options& o, const Space& space) {
  return std::make_unique<IqnImvj>(dirichlet_quasi_newton(o), space);
}
Made newton_krylov(const Options& o, const Space& space) {
  return std::make_unique<NewtonKrylov>(dirichlet_quasi_newton(o), space);
}
Made robin(const Options& o, const Space&) {
  return std::make_unique<ConstantRelaxation>(factor_or(robin_factor, o));
}
Made robin_iqn(const Options& o, const Space& space) {
  return std::make_unique<IqnIls>(robin_quasi_newton(o), space);
}
Made regularised(const Options& o, const Space& space) {
  return std::make_unique<RegularisedIqn>(robin_quasi_newton(o), space);
}
Made robin_imvj(const Options& o, const Space& space) {
  return std::make_unique<IqnImvj>(robin_quasi_newton(o), space);
}

}  // namespace fsi::accelerators
