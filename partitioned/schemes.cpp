#include "partitioned/schemes.hpp"

#include <array>

#include "partitioned/accelerators/iqn_ils.hpp"
#include "partitioned/accelerators/iqn_imvj.hpp"
#include "partitioned/accelerators/newton_krylov.hpp"
#include "partitioned/accelerators/regularised_iqn.hpp"
#include "partitioned/accelerators/relaxation.hpp"

namespace fsi {

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
using Made = std::unique_ptr<Accelerator>;

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

constexpr auto other = "a larger partitioned.max_iterations, a smaller time.step, or the monolithic driver";
constexpr auto loose_advice = "a smaller time.step, or a scheme that iterates: partitioned.scheme = \"block-newton\"";
constexpr std::array<CouplingScheme, 15> coupling_schemes{{
    {"aitken", false, false, false, Loose::no, aitken,
     "partitioned.scheme = \"iqn-ils\", or a larger partitioned.max_iterations"},
    {"block-newton", true, false, false, Loose::no, robin_iqn, "a smaller time.step or load, or the monolithic driver"},
    {"constant", false, false, false, Loose::no, constant,
     "partitioned.scheme = \"iqn-ils\", or a smaller partitioned.relaxation"},
    {"explicit", false, false, true, Loose::no, constant,
     "a scheme that iterates: partitioned.scheme = \"iqn-ils\"; one pass a step is unstable where the fluid's added "
     "mass exceeds the wall's"},
    {"iqn-ils", false, false, false, Loose::no, iqn_ils, other},
    {"iqn-imvj", false, false, false, Loose::no, iqn_imvj, other},
    {"newton-krylov", false, false, false, Loose::no, newton_krylov, other},
    {"robin-neumann", true, false, false, Loose::no, robin,
     "partitioned.scheme = \"robin-neumann-iqn\", or a smaller time.step"},
    {"robin-neumann-inexact", true, false, false, Loose::no, regularised,
     "a smaller time.step, partitioned.scheme = \"block-newton\", which needs both media's Jacobians, or the "
     "monolithic "
     "driver"},
    {"robin-neumann-iqn", true, false, false, Loose::no, robin_iqn, other},
    {"robin-neumann-imvj", true, false, false, Loose::no, robin_imvj, other},
    {"robin-robin", false, false, true, Loose::in_turn, robin_iqn, loose_advice},
    {"robin-robin-corrected", false, false, true, Loose::corrected, robin_iqn, loose_advice},
    {"robin-robin-parallel", false, false, true, Loose::at_once, robin_iqn, loose_advice},
    {"semi-implicit", true, true, false, Loose::no, robin_iqn, other},
}};
static_assert(names_match(coupling_scheme_list, coupling_schemes), "case/choices.hpp owns these names");

}  // namespace

const CouplingScheme& coupling_scheme(const std::string& name) {
  for (const auto& scheme : coupling_schemes)
    if (scheme.name == name) return scheme;
  refuse_name("partitioned.scheme", name, coupling_scheme_names());
}

}  // namespace fsi
