#pragma once

#include <optional>
#include <vector>

#include "materials/elastic_constants.hpp"
#include "materials/logarithm.hpp"
#include "materials/response.hpp"

namespace fsi {

/// Psi = mu/2 (I_1 - 3) - mu ln J + lambda/2 ln^2 J ([Bonet2008], docs/theory.md, section 5.9).
/// Psi' = mu/2 (I_1 - 3) - mu ln J - mu/3 ln^2 J is the energy here, K/2 ln^2 J the pressure's, with g = ln J.
struct CompressibleNeoHookean : ElasticConstants {
  double c10 = 0;           ///< kPa, the shear modulus
  double bulk_modulus = 0;  ///< kPa, K

  static constexpr const char* name = "compressible-neo-hookean";
  static std::vector<ParameterOf<CompressibleNeoHookean>> parameters() {
    auto all = parameters_of<CompressibleNeoHookean>();
    all.push_back({&CompressibleNeoHookean::c10, "c10", "isotropic stiffness", quantity::stiffness(), positive, false});
    all.push_back({&CompressibleNeoHookean::bulk_modulus, "bulk_modulus", "bulk modulus", quantity::bulk_modulus(),
                   positive, false});
    return all;
  }
  static ParameterSets parameter_sets() {
    auto sets = ElasticConstants::parameter_sets();
    sets.push_back({"c10", "bulk_modulus"});
    return sets;
  }

  double shear_modulus() const { return c10 > 0 ? c10 : ElasticConstants::shear_modulus(); }
  double compression_modulus() const { return c10 > 0 ? bulk_modulus : ElasticConstants::compression_modulus(); }
  std::optional<double> own_bulk_modulus() const { return compression_modulus(); }
  double fibre_stiffness() const { return 0; }
  /// (P_tt l_t - P_rr l_r) / l_t^2 = mu (1 - l_r^2 / l_t^2) tends to mu, and the pressure is its integral over dR/R.
  std::optional<double> inflation_modulus() const { return shear_modulus(); }

  /// S' = mu (I - C^-1) - 2/3 mu ln J C^-1, p = -K ln J, P = F S' - p F^-T
  template <class T, class Constant>
  static Response<T> response(const Constant& mu, const Mat3<T>& h, const Deformation<T>& f) {
    const T logarithm = log1p(f.volume_change);
    const Sym3<T> inverse_change = inverse_strain_change(strain_change(h), f.volume_change * (f.volume_ratio + 1.0));
    const T third = Pack(2.0 / 3) * logarithm;
    Sym3<T> stress = (third + 1.0) * inverse_change;
    for (int k = 0; k < 3; ++k) stress.c[k] -= third;
    return {f.gradient * (Pack(mu) * stress), logarithm, (Pack(1.0) / f.volume_ratio) * f.cofactor_gradient,
            f.volume_ratio};
  }

  /// With A = C - I and x = I_3 - 1 = tr A + tr cof A + det A, all of second order in A:
  ///   Psi' = mu/2 (x - ln(1 + x) - tr cof A - det A) - mu/3 ln^2 J
  template <class T, class Constant>
  static T energy(const Constant& mu, const Mat3<T>& h) {
    const Deformation<T> f = deformation(h);
    const Sym3<T> change = strain_change(h), cof = cofactor(change);
    const T third = change(0, 0) * cof(0, 0) + change(0, 1) * cof(0, 1) + change(0, 2) * cof(0, 2);
    const T logarithm = log1p(f.volume_change);
    return Pack(mu / 2) * (minus_log1p(f.volume_change * (f.volume_ratio + 1.0)) - trace(cof) - third) -
           Pack(mu / 3) * (logarithm * logarithm);
  }
};

}  // namespace fsi
