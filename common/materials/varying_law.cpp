#include "materials/varying_law.hpp"

#include <type_traits>

namespace fsi {

LawConstants<double> law_constants(const Material& material, double of_structure) {
  LawConstants<double> constants;
  std::visit(
      [&](const auto& law) {
        using Law = std::decay_t<decltype(law)>;
        if constexpr (std::is_same_v<Law, MooneyRivlin>) {
          constants.c10 = law.c10;
          constants.c01 = law.c01;
        } else {
          constants.c10 = law.shear_modulus();
        }
        if constexpr (std::is_same_v<Law, Artery>) {
          constants.k1 = law.fibre_scale * law.k1;
          constants.k2 = law.k2;
          constants.kappa = law.kappa;
        }
        constants.bulk_modulus = law.own_bulk_modulus().value_or(of_structure);
      },
      material);
  return constants;
}

void PointConstants::set(int lane, const LawConstants<double>& from) {
  c10.set(lane, from.c10);
  c01.set(lane, from.c01);
  k1.set(lane, from.k1);
  k2.set(lane, from.k2);
  kappa.set(lane, from.kappa);
  bulk_modulus.set(lane, from.bulk_modulus);
  viscosity.set(lane, from.viscosity);
}

VaryingLaw varying_law(const Material& material, bool dispersed) {
  using Kind = VaryingLaw::Kind;
  return std::visit(
      [&](const auto& law) -> VaryingLaw {
        using Law = std::decay_t<decltype(law)>;
        if constexpr (std::is_same_v<Law, NeoHookean>)
          return {Kind::neo_hookean, {}};
        else if constexpr (std::is_same_v<Law, MooneyRivlin>)
          return {Kind::mooney_rivlin, {}};
        else if constexpr (std::is_same_v<Law, Artery>)
          return {dispersed ? Kind::dispersed_artery : Kind::artery, {}};
        else
          return {Kind::compressible, std::get<CompressibleLaw>(element_law(law)).kind};
      },
      material);
}

}  // namespace fsi
