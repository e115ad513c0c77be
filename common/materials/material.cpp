#include "materials/material.hpp"

#include <algorithm>
#include <cstddef>
#include <utility>

#include "base/error.hpp"

namespace fsi {

namespace {

template <class Law>
Material make(const ParameterValues& values) {
  Law law;
  for (const auto& parameter : Law::parameters()) {
    const auto value = values.find(parameter.name);
    if (value != values.end()) law.*parameter.member = value->second;
  }
  return law;
}

template <class Law>
std::pair<std::string, MaterialKind> row() {
  MaterialKind kind{{}, has_fibres_v<Law>, make<Law>};
  for (const auto& p : Law::parameters())
    kind.parameters.push_back({p.name, p.about, &p.quantity, p.bounds, p.required, Law().*p.member});
  return {Law::name, kind};
}

template <std::size_t... i>
NameTable<MaterialKind> table_of(std::index_sequence<i...>) {
  return {"material", {row<std::variant_alternative_t<i, Material>>()...}};
}

std::vector<std::string> names_of(const std::vector<Parameter>& parameters) {
  std::vector<std::string> names;
  for (const auto& parameter : parameters) names.push_back(parameter.name);
  return names;
}

}  // namespace

const Parameter* MaterialKind::find(const std::string& name) const {
  const auto found = std::find_if(parameters.begin(), parameters.end(), [&](const auto& p) { return p.name == name; });
  return found == parameters.end() ? nullptr : &*found;
}

const NameTable<MaterialKind>& materials() {
  static const auto table = table_of(std::make_index_sequence<std::variant_size_v<Material>>());
  return table;
}

std::vector<std::string> materials_with_fibres() {
  std::vector<std::string> names;
  for (const auto& [name, kind] : materials().rows())
    if (kind.has_fibres) names.push_back(name);
  return names;
}

Material make_material(const std::string& name, const ParameterValues& values) {
  const MaterialKind& kind = materials().at(name);
  for (const auto& [parameter, value] : values)
    if (kind.find(parameter) == nullptr) refuse_name("parameter of " + name, parameter, names_of(kind.parameters));
  for (const auto& parameter : kind.parameters)
    if (parameter.required && values.count(parameter.name) == 0)
      throw InputError("", "parameter of " + name, parameter.name + " is missing", "give it (" + parameter.about + ")");
  return kind.make(values);
}

double shear_modulus(const Material& material) {
  return std::visit([](const auto& law) { return law.shear_modulus(); }, material);
}

double fibre_stiffness(const Material& material) {
  return std::visit([](const auto& law) { return law.fibre_stiffness(); }, material);
}

std::optional<double> inflation_modulus(const Material& material) {
  return std::visit([](const auto& law) { return law.inflation_modulus(); }, material);
}

double hoop_modulus(const Material& material, double bulk_modulus) {
  const double mu = shear_modulus(material), kappa = bulk_modulus;
  const double nu = (3 * kappa - 2 * mu) / (2 * (3 * kappa + mu));
  return (2 * mu * (1 + nu) + fibre_stiffness(material)) / (1 - nu * nu);
}

bool has_fibres(const Material& material) {
  return std::visit([](const auto& law) { return has_fibres_v<std::decay_t<decltype(law)>>; }, material);
}

double fibre_angle(const Material& material) {
  return std::visit(
      [](const auto& law) {
        if constexpr (has_fibres_v<std::decay_t<decltype(law)>>)
          return law.fibre_angle();
        else
          return 0.0;
      },
      material);
}

}  // namespace fsi
