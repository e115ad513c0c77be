#include "materials/viscosity_law.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <utility>

#include "materials/law_parameters.hpp"

namespace fsi {

namespace {

template <class Law>
ViscosityLaw make_viscosity(const ParameterValues& values) {
  return with_parameters<Law>(values);
}

template <class Law>
std::pair<std::string, ViscosityKind> viscosity_row() {
  ViscosityKind kind{parameters_of_law<Law>(), make_viscosity<Law>};
  return {Law::name, kind};
}

template <std::size_t... i>
NameTable<ViscosityKind> viscosity_table(std::index_sequence<i...>) {
  return {"viscosity model", {viscosity_row<std::variant_alternative_t<i, ViscosityLaw>>()...}};
}

}  // namespace

ParameterMismatch above_limit(const std::string& parameter, const std::string& limit, double value) {
  return {parameter, fmt::format("is more than {}, {}", limit, value), fmt::format("give at most {}", value)};
}

const Parameter* ViscosityKind::find(const std::string& name) const {
  const auto found = std::find_if(parameters.begin(), parameters.end(), [&](const auto& p) { return p.name == name; });
  return found == parameters.end() ? nullptr : &*found;
}

const NameTable<ViscosityKind>& viscosity_laws() {
  static const auto table = viscosity_table(std::make_index_sequence<std::variant_size_v<ViscosityLaw>>());
  return table;
}

std::optional<ParameterMismatch> problem_of(const ViscosityLaw& law) {
  return std::visit([](const auto& of_kind) { return of_kind.problem(); }, law);
}

ShearViscosity shear_viscosity(const ViscosityLaw& law, const Pack& shear_rate_squared) {
  constexpr double lowest = lowest_shear_rate * lowest_shear_rate;
  Dual<1> squared(shear_rate_squared);
  squared.slope[0] = Pack(1.0);
  const Dual<1> rate = sqrt(select(shear_rate_squared > Pack(lowest), squared, Dual<1>(lowest)));
  const Dual<1> mu = std::visit([&](const auto& of_kind) { return of_kind.viscosity(rate); }, law);
  return {mu.value, mu.slope[0]};
}

double viscosity_at(const ViscosityLaw& law, double shear_rate) {
  return shear_viscosity(law, Pack(shear_rate * shear_rate)).value[0];
}

}  // namespace fsi
