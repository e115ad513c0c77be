#pragma once

#include <optional>
#include <vector>

#include "materials/power.hpp"
#include "materials/shear_law.hpp"

namespace fsi {

/// Casson's law, sqrt(tau) = sqrt(tau_y) + sqrt(mu_p g), with the yield stress regularised as Papanastasiou does,
///   mu = (sqrt(mu_p) + sqrt(tau_y / g) (1 - exp(-sqrt(m g))))^2,
/// so that it is (sqrt(mu_p) + sqrt(tau_y m))^2 at rest: docs/theory.md, section 3.9 [Casson1959, Papanastasiou1987].
struct Casson {
  double yield_stress = 0;       ///< tau_y, kPa
  double plastic_viscosity = 0;  ///< mu_p, kPa ms
  double regularisation = 0;     ///< m, ms

  static constexpr const char* name = "casson";
  static std::vector<ParameterOf<Casson>> parameters() {
    return {
        {&Casson::yield_stress, "yield_stress", "yield stress", quantity::pressure(), not_negative},
        {&Casson::plastic_viscosity, "plastic_viscosity", "viscosity at high shear rates", quantity::viscosity(),
         positive},
        {&Casson::regularisation, "regularisation",
         "time m by which the yield stress is regularised, long against 1/(shear rate)", quantity::time(), positive}};
  }
  std::optional<ParameterMismatch> problem() const { return std::nullopt; }

  /// With x = sqrt(m g), sqrt(tau_y / g) (1 - exp(-x)) = sqrt(tau_y m) phi(-x).
  /// \param shear_rate  g, positive, 1/ms \return kPa ms
  template <class T>
  T viscosity(const T& shear_rate) const {
    const T root = Pack(std::sqrt(yield_stress * regularisation)) * phi(-sqrt(Pack(regularisation) * shear_rate)) +
                   std::sqrt(plastic_viscosity);
    return root * root;
  }
};

}  // namespace fsi
