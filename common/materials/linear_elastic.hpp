#pragma once

#include <optional>
#include <vector>

#include "materials/elastic_constants.hpp"
#include "materials/response.hpp"

namespace fsi {

/// Psi = mu eps : eps + lambda/2 (tr eps)^2, eps the symmetric part of grad d: small strains and small rotations,
/// docs/theory.md, section 5.8. Everything is linear in d; forces balance on the reference configuration.
/// Psi' = mu dev eps : dev eps is the energy here, K/2 (tr eps)^2 the pressure's, with g = tr eps.
struct LinearElastic : ElasticConstants {
  static constexpr const char* name = "linear-elastic";
  static constexpr bool on_reference = true;
  static std::vector<ParameterOf<LinearElastic>> parameters() { return parameters_of<LinearElastic>(); }

  std::optional<double> own_bulk_modulus() const { return compression_modulus(); }
  double fibre_stiffness() const { return 0; }
  /// The pressure acts on the current face, which grows with the displacement: a thin tube of radius A and thickness
  /// B - A under p takes u = p (A + u) A / (E' (B - A)), E' = E/(1 - nu^2), and no more than p = E' ln(B/A).
  std::optional<double> inflation_modulus() const { return plane_modulus(); }

  /// sigma' = 2 mu dev eps, p = -K tr eps, P = sigma' - p I. The configuration in which forces balance is the
  /// reference one, whose volume ratio is one.
  template <class T, class Constant>
  static Response<T> response(const Constant& mu, const Mat3<T>& h, const Deformation<T>&) {
    const T t = trace(h), mean = Pack(2 * mu / 3) * t;
    Response<T> r{{}, t, {}, T(1.0)};
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) {
        r.flux(i, j) = Pack(mu) * (h(i, j) + h(j, i));
        r.volume_gradient(i, j) = T(i == j ? 1.0 : 0.0);
      }
    for (int i = 0; i < 3; ++i) r.flux(i, i) -= mean;
    return r;
  }

  template <class T, class Constant>
  static T energy(const Constant& mu, const Mat3<T>& h) {
    const T t = trace(h);
    T squares = Pack(-1.0 / 3) * (t * t);
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) squares += Pack(0.5) * (h(i, j) * (h(i, j) + h(j, i)));
    return Pack(mu) * squares;
  }
};

}  // namespace fsi
