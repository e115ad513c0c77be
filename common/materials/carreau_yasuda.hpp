#pragma once

#include <optional>
#include <vector>

#include "materials/power.hpp"
#include "materials/shear_law.hpp"

namespace fsi {

/// mu = mu_inf + (mu_0 - mu_inf) (1 + (lambda g)^a)^((n - 1) / a): docs/theory.md, section 3.9 [Yasuda1981]. a = 2 is
/// Carreau's law.
struct CarreauYasuda {
  double mu0 = 0, mu_inf = 0;  ///< kPa ms
  double lambda = 0;           ///< ms
  double a = 2, n = 1;

  static constexpr const char* name = "carreau-yasuda";
  static std::vector<ParameterOf<CarreauYasuda>> parameters() {
    return {{&CarreauYasuda::mu0, "mu0", "viscosity at rest", quantity::viscosity(), positive},
            {&CarreauYasuda::mu_inf, "mu_inf", "viscosity at high shear rates", quantity::viscosity(), positive},
            {&CarreauYasuda::lambda, "lambda", "time constant", quantity::time(), positive},
            {&CarreauYasuda::a, "a", "width of the change between both", quantity::number(), positive, false},
            {&CarreauYasuda::n, "n", "exponent", quantity::number(), shear_exponent}};
  }
  /// With mu_inf above mu_0 and n above 1 the viscosity would become negative.
  std::optional<ParameterMismatch> problem() const {
    if (mu_inf <= mu0) return std::nullopt;
    return above_limit("mu_inf", "mu0", mu0);
  }

  /// \param shear_rate  g, positive, 1/ms \return kPa ms
  template <class T>
  T viscosity(const T& shear_rate) const {
    return Pack(mu0 - mu_inf) * power(power(Pack(lambda) * shear_rate, a) + 1.0, (n - 1) / a) + mu_inf;
  }
};

}  // namespace fsi
