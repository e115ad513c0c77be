#include "materials/material.hpp"

#include <algorithm>
#include <cstddef>
#include <type_traits>
#include <utility>

#include "base/error.hpp"
#include "materials/law_parameters.hpp"

namespace fsi {

namespace {

template <class Law, class = void>
struct HasFibres : std::false_type {};
template <class Law>
struct HasFibres<Law, std::void_t<decltype(&Law::fibre_angle)>> : std::true_type {};
template <class Law>
inline constexpr bool has_fibres_v = HasFibres<Law>::value;

template <class Law, class = void>
struct SetsOf {
  static ParameterSets get() { return {}; }
};
template <class Law>
struct SetsOf<Law, std::void_t<decltype(Law::parameter_sets())>> {
  static ParameterSets get() { return Law::parameter_sets(); }
};

template <class Law, class = void>
struct SettlesOf : std::false_type {};
template <class Law>
struct SettlesOf<Law, std::void_t<decltype(&Law::settle)>> : std::true_type {};

template <class Law>
Material make(const ParameterValues& values) {
  Law law = with_parameters<Law>(values);
  if constexpr (SettlesOf<Law>::value) law.settle();
  return law;
}

template <class Law>
std::pair<std::string, MaterialKind> row() {
  MaterialKind kind{{}, SetsOf<Law>::get(), has_fibres_v<Law>, make<Law>};
  for (const auto& p : Law::parameters()) {
    const bool of_a_set = std::any_of(kind.sets.begin(), kind.sets.end(), [&](const auto& set) {
      return std::find(set.begin(), set.end(), p.name) != set.end();
    });
    kind.parameters.push_back({p.name, p.about, &p.quantity, p.bounds, p.required, Law().*p.member, of_a_set});
  }
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

/// "a", "a and b" or "a, b and c"
std::string all_of(const std::vector<std::string>& names) {
  std::string text;
  for (std::size_t i = 0; i < names.size(); ++i)
    text += (i == 0 ? "" : i + 1 == names.size() ? " and " : ", ") + names[i];
  return text;
}

/// "give c10, or young and poisson"
std::string choice_of(const ParameterSets& sets) {
  std::string text = "give ";
  for (std::size_t i = 0; i < sets.size(); ++i) text += (i == 0 ? "" : ", or ") + all_of(sets[i]);
  return text;
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

std::optional<ParameterProblem> problem_of(const MaterialKind& kind, const ParameterValues& values) {
  if (kind.sets.empty()) return std::nullopt;
  std::vector<std::string> given;
  for (const auto& parameter : kind.parameters)
    if (parameter.of_a_set && values.count(parameter.name) > 0) given.push_back(parameter.name);
  const bool whole = std::any_of(kind.sets.begin(), kind.sets.end(), [&](const auto& set) {
    return set.size() == given.size() && std::is_permutation(set.begin(), set.end(), given.begin());
  });
  if (given.empty()) return ParameterProblem{"has too few constants", choice_of(kind.sets)};
  if (!whole)
    return ParameterProblem{
        all_of(given) + (given.size() == 1 ? " alone is" : " together are") + " no set of its constants",
        choice_of(kind.sets)};
  const auto bulk = std::visit([](const auto& law) { return law.own_bulk_modulus(); }, kind.make(values));
  if (bulk && !(*bulk > 0))
    return ParameterProblem{"lame_lambda + 2/3 lame_mu, the bulk modulus, is not positive",
                            "give a lame_lambda of more than -2/3 lame_mu"};
  return std::nullopt;
}

Material make_material(const std::string& name, const ParameterValues& values) {
  const MaterialKind& kind = materials().at(name);
  for (const auto& [parameter, value] : values)
    if (kind.find(parameter) == nullptr) refuse_name("parameter of " + name, parameter, names_of(kind.parameters));
  for (const auto& parameter : kind.parameters)
    if (parameter.required && values.count(parameter.name) == 0)
      throw InputError("", "parameter of " + name, parameter.name + " is missing", "give it (" + parameter.about + ")");
  if (const auto wrong = problem_of(kind, values))
    throw InputError("", "parameters of " + name, wrong->problem, wrong->remedy);
  return kind.make(values);
}

ParameterValues parameter_values(const Material& material) {
  return std::visit(
      [](const auto& law) {
        ParameterValues values;
        for (const auto& p : law.parameters()) values[p.name] = law.*p.member;
        return values;
      },
      material);
}

double shear_modulus(const Material& material) {
  return std::visit([](const auto& law) { return law.shear_modulus(); }, material);
}

double bulk_modulus(const Material& material, double of_structure) {
  return std::visit([](const auto& law) { return law.own_bulk_modulus(); }, material).value_or(of_structure);
}

bool needs_bulk_modulus(const Material& material) {
  return !std::visit([](const auto& law) { return law.own_bulk_modulus(); }, material);
}

double fibre_stiffness(const Material& material) {
  return std::visit([](const auto& law) { return law.fibre_stiffness(); }, material);
}

std::optional<double> inflation_modulus(const Material& material) {
  return std::visit([](const auto& law) { return law.inflation_modulus(); }, material);
}

double hoop_modulus(const Material& material, double of_structure) {
  const double mu = shear_modulus(material), kappa = bulk_modulus(material, of_structure);
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
