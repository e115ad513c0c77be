#pragma once

#include <optional>
#include <vector>

#include "materials/elastic_constants.hpp"
#include "materials/response.hpp"

namespace fsi {

/// Psi = mu E : E + lambda/2 (tr E)^2, E = (C - I)/2: docs/theory.md, section 5.7.
/// Its share Psi' = mu dev E : dev E is the energy here; the rest, K/2 (tr E)^2, is the pressure's, with g = tr E.
struct SaintVenantKirchhoff : ElasticConstants {
  static constexpr const char* name = "saint-venant-kirchhoff";
  static std::vector<ParameterOf<SaintVenantKirchhoff>> parameters() { return parameters_of<SaintVenantKirchhoff>(); }

  std::optional<double> own_bulk_modulus() const { return compression_modulus(); }
  double fibre_stiffness() const { return 0; }
  /// It stiffens in extension.
  std::optional<double> inflation_modulus() const { return std::nullopt; }

  /// S' = 2 mu dev E, p = -K tr E, P = F S' - p F
  template <class T, class Constant>
  static Response<T> response(const Constant& mu, const Mat3<T>& h, const Deformation<T>& f) {
    const Sym3<T> change = strain_change(h);
    const T t = trace(change);
    Sym3<T> stress = Pack(mu) * change;
    const T mean = Pack(mu / 3) * t;
    for (int k = 0; k < 3; ++k) stress.c[k] -= mean;
    return {f.gradient * stress, Pack(0.5) * t, f.gradient, f.volume_ratio};
  }

  template <class T, class Constant>
  static T energy(const Constant& mu, const Mat3<T>& h) {
    const Sym3<T> change = strain_change(h);
    const T t = trace(change);
    return Pack(mu / 4) * (contract(change, change) - Pack(1.0 / 3) * (t * t));
  }
};

}  // namespace fsi
