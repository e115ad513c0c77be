#include "partitioned/schemes.hpp"

#include "base/error.hpp"
#include "base/names.hpp"
#include "partitioned/accelerators/iqn_ils.hpp"
#include "partitioned/accelerators/iqn_imvj.hpp"
#include "partitioned/accelerators/newton_krylov.hpp"
#include "partitioned/accelerators/relaxation.hpp"

namespace fsi {

namespace {

constexpr double dirichlet_factor = 0.01;  // below the coarse artery's limit of about 0.014
constexpr double largest_aitken_start = 0.05;
constexpr double robin_factor = 1;  // plain Robin-Neumann needs no relaxation

double factor_or(double fallback, const PartitionedData& options) {
  return options.relaxation > 0 ? options.relaxation : fallback;
}

/// Dirichlet-Neumann overshoots what the differences have not explained yet, by some factor of one to ten.
constexpr double dirichlet_mixing = 0.5, robin_mixing = 1;

QuasiNewtonOptions dirichlet_quasi_newton(const PartitionedData& o) {
  return {factor_or(dirichlet_factor, o), dirichlet_mixing, o.columns, o.reused_steps, o.filter};
}
QuasiNewtonOptions robin_quasi_newton(const PartitionedData& o) {
  return {factor_or(robin_factor, o), robin_mixing, o.columns, o.reused_steps, o.filter};
}

using Options = PartitionedData;
using Made = std::unique_ptr<Accelerator>;

Made constant(const Options& o) {
  return std::make_unique<ConstantRelaxation>(factor_or(dirichlet_factor, o));
}
Made aitken(const Options& o) {
  return std::make_unique<AitkenRelaxation>(factor_or(dirichlet_factor, o), largest_aitken_start);
}
Made iqn_ils(const Options& o) {
  return std::make_unique<IqnIls>(dirichlet_quasi_newton(o));
}
Made iqn_imvj(const Options& o) {
  return std::make_unique<IqnImvj>(dirichlet_quasi_newton(o));
}
Made newton_krylov(const Options& o) {
  return std::make_unique<NewtonKrylov>(o.tolerance, dirichlet_quasi_newton(o));
}
Made robin(const Options& o) {
  return std::make_unique<ConstantRelaxation>(factor_or(robin_factor, o));
}
Made robin_iqn(const Options& o) {
  return std::make_unique<IqnIls>(robin_quasi_newton(o));
}
Made robin_imvj(const Options& o) {
  return std::make_unique<IqnImvj>(robin_quasi_newton(o));
}

}  // namespace

const std::vector<CouplingScheme>& coupling_schemes() {
  static const std::string other = "a larger partitioned.max_iterations, a smaller time.step, or the monolithic driver";
  static const std::vector<CouplingScheme> schemes = {
      {"aitken", false, false, aitken, "partitioned.scheme = \"iqn-ils\", or a larger partitioned.max_iterations"},
      {"constant", false, false, constant, "partitioned.scheme = \"iqn-ils\", or a smaller partitioned.relaxation"},
      {"explicit", false, true, constant,
       "a scheme that iterates: partitioned.scheme = \"iqn-ils\"; one pass a step is unstable where the fluid's added "
       "mass exceeds the wall's"},
      {"iqn-ils", false, false, iqn_ils, other},
      {"iqn-imvj", false, false, iqn_imvj, other},
      {"newton-krylov", false, false, newton_krylov, other},
      {"robin-neumann", true, false, robin, "partitioned.scheme = \"robin-neumann-iqn\", or a smaller time.step"},
      {"robin-neumann-iqn", true, false, robin_iqn, other},
      {"robin-neumann-imvj", true, false, robin_imvj, other},
  };
  return schemes;
}

const CouplingScheme& coupling_scheme(const std::string& name) {
  std::vector<std::string> names;
  for (const auto& scheme : coupling_schemes()) {
    if (scheme.name == name) return scheme;
    names.push_back(scheme.name);
  }
  throw InputError("", "partitioned.scheme", "unknown scheme \"" + name + "\"", "use " + one_of(names));
}

}  // namespace fsi
