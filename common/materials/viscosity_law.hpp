#pragma once

#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "base/name_table.hpp"
#include "materials/carreau_yasuda.hpp"
#include "materials/casson.hpp"
#include "materials/power_law.hpp"
#include "materials/shear_law.hpp"
#include "math/tensor.hpp"

namespace fsi {

/// How the viscosity of a generalised Newtonian fluid depends on its shear rate g = sqrt(2 D : D), D the symmetric part
/// of the velocity's gradient: the list of all laws. A new one is a file beside these and an entry here; case files and
/// `--help-keys` follow from it. A law L states
///   L::name          its name in case files
///   L::parameters()  its parameters, see ParameterOf
///   problem()        what is wrong with them together; empty: nothing
///   viscosity(g)     kPa ms, of a positive shear rate in 1/ms
using ViscosityLaw = std::variant<CarreauYasuda, Casson, PowerLaw>;

/// A law as the case reader sees it.
struct ViscosityKind {
  std::vector<Parameter> parameters;
  ViscosityLaw (*make)(const ParameterValues& values);

  const Parameter* find(const std::string& name) const;
};

/// All kinds by name, in the order of ViscosityLaw. A constant viscosity, `newtonian`, is none of them.
const NameTable<ViscosityKind>& viscosity_laws();

/// What is wrong with a law's parameters together, each being within its bounds; empty: nothing.
std::optional<ParameterMismatch> problem_of(const ViscosityLaw& law);

/// Lower shear rates count as this one, 1/ms, and without derivative: a shear rate of zero has none.
inline constexpr double lowest_shear_rate = 1e-9;

/// The shear rate, 1/ms, whose viscosity is taken where a scene needs a single one: 100 1/s.
inline constexpr double reference_shear_rate = 0.1;

/// A viscosity with its derivative with respect to g^2.
struct ShearViscosity {
  Pack value;  ///< kPa ms
  Pack slope;  ///< kPa ms^3
};
/// \param shear_rate_squared  g^2, 1/ms^2
ShearViscosity shear_viscosity(const ViscosityLaw& law, const Pack& shear_rate_squared);
double viscosity_at(const ViscosityLaw& law, double shear_rate);  ///< kPa ms

/// g^2 = 2 D : D of a velocity gradient, 1/ms^2.
template <class T>
T shear_rate_squared(const Mat3<T>& l) {
  T sum = l(0, 0) * l(0, 0) + l(1, 1) * l(1, 1) + l(2, 2) * l(2, 2);
  sum = sum + sum;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < i; ++j) {
      const T twice = l(i, j) + l(j, i);
      sum += twice * twice;
    }
  return sum;
}

/// The viscosity at a point, kPa ms, with the derivatives that its velocity gradient has.
/// \param l  grad u F^-1, 1/ms
inline Pack local_viscosity(const ViscosityLaw& law, const Mat3<Pack>& l) {
  return shear_viscosity(law, shear_rate_squared(l)).value;
}
template <int N>
Dual<N> local_viscosity(const ViscosityLaw& law, const Mat3<Dual<N>>& l) {
  const Dual<N> squared = shear_rate_squared(l);
  const ShearViscosity mu = shear_viscosity(law, squared.value);
  return detail::chained(mu.value, mu.slope, squared);
}

}  // namespace fsi
