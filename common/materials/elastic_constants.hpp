#pragma once

#include <limits>
#include <vector>

#include "materials/parameter.hpp"

namespace fsi {

/// The two constants of an isotropic solid at small strains, in one of the pairs that textbooks give them in
/// (docs/theory.md, section 5.5). Exactly one pair is given; what is not given is zero.
struct ElasticConstants {
  static constexpr bool on_reference = false;  ///< of a law: forces balance on the reference configuration

  double young = 0;        ///< E, kPa
  double poisson = 0;      ///< nu, more than -1 and less than 0.5
  double lame_lambda = 0;  ///< lambda, kPa; more than -2/3 lame_mu
  double lame_mu = 0;      ///< mu, kPa

  /// mu, kPa
  double shear_modulus() const { return young > 0 ? young / (2 * (1 + poisson)) : lame_mu; }
  /// K = lambda + 2 mu / 3 = E / (3 (1 - 2 nu)), kPa
  double compression_modulus() const {
    return young > 0 ? young / (3 * (1 - 2 * poisson)) : lame_lambda + 2 * lame_mu / 3;
  }
  /// E / (1 - nu^2), kPa: stress per strain where the strain across vanishes, as around a thin tube of fixed length.
  double plane_modulus() const {
    const double mu = shear_modulus(), k = compression_modulus();
    return 4 * mu * (3 * k + mu) / (3 * k + 4 * mu);
  }

  /// The pairs by name, for ParameterSets.
  static ParameterSets parameter_sets() { return {{"young", "poisson"}, {"lame_lambda", "lame_mu"}}; }

  /// The four constants as parameters of a Law that derives from this.
  template <class Law>
  static std::vector<ParameterOf<Law>> parameters_of() {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    return {young_of<Law>(),
            poisson_of<Law>(),
            {&Law::lame_lambda,
             "lame_lambda",
             "Lame's first constant",
             quantity::stiffness(),
             {-infinity, infinity, false, false},
             false},
            {&Law::lame_mu, "lame_mu", "Lame's second constant, the shear modulus", quantity::stiffness(), positive,
             false}};
  }
  template <class Law>
  static ParameterOf<Law> young_of() {
    return {&Law::young, "young", "Young's modulus", quantity::stiffness(), positive, false};
  }
  template <class Law>
  static ParameterOf<Law> poisson_of() {
    return {&Law::poisson, "poisson", "Poisson's ratio", quantity::number(), {-1, 0.5, false, false}, false};
  }
};

}  // namespace fsi
