#include "materials/varying_law.hpp"

#include <type_traits>

namespace fsi {

namespace {

/// visit(form) for the form of a material.
template <class Visit>
auto visit_form(const Material& material, bool varies, const Visit& visit) {
  return std::visit(
      [&](const auto& law) { return std::visit(visit, FormsOf<std::decay_t<decltype(law)>>::of(law, varies)); },
      material);
}

}  // namespace

LawConstants<double> law_constants(const Material& material, double of_structure) {
  LawConstants<double> constants;
  visit_form(material, false, [&](const auto& form) {
    const auto members = std::decay_t<decltype(form)>::constants();
    for (std::size_t i = 0; i < members.size(); ++i) constants.of_law[i] = form.*members[i];
  });
  std::visit(
      [&](const auto& law) {
        constants.shear_modulus = law.shear_modulus();
        constants.bulk_modulus = law.own_bulk_modulus().value_or(of_structure);
      },
      material);
  return constants;
}

void PointConstants::set(int lane, const LawConstants<double>& from) {
  for (std::size_t i = 0; i < of_law.size(); ++i) of_law[i].set(lane, from.of_law[i]);
  shear_modulus.set(lane, from.shear_modulus);
  bulk_modulus.set(lane, from.bulk_modulus);
  viscosity.set(lane, from.viscosity);
}

VaryingLaw::VaryingLaw(const Material& material, bool varies) {
  visit_form(material, varies, [&](const auto& form) {
    using Form = std::decay_t<decltype(form)>;
    form_ = index_of_law<Form, LawForms::variant>;
    if constexpr (std::is_same_v<Form, CompressibleLaw>) kind_ = form.kind;
  });
}

bool decides_form(const Material& material, const std::string& parameter) {
  return std::visit([&](const auto& law) { return FormsOf<std::decay_t<decltype(law)>>::decides(parameter); },
                    material);
}

ElementLaw element_law(const Material& material) {
  return visit_form(material, false, [&](const auto& form) -> ElementLaw {
    if constexpr (std::decay_t<decltype(form)>::has_own_loops)
      return form;
    else
      return VaryingLaw(material, false);
  });
}

}  // namespace fsi
