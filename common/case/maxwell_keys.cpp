#include "case/maxwell_keys.hpp"

#include <fmt/format.h>

#include <string>
#include <vector>

#include "case/key_values.hpp"

namespace fsi {

namespace {

using presence::optional, presence::required;
constexpr std::size_t most_branches = 16;  // six numbers each at every quadrature point and level
constexpr const char* form = "[{ shear = 20.0, time = 5.0 }, ...]";

/// Any that is positive: a spring may be as soft or stiff as it likes beside its layer.
const Quantity& spring_modulus() {
  static const Quantity q{"kPa", {}};
  return q;
}

const std::vector<CaseKey<MaxwellBranch>>& branch_keys() {
  static const std::vector<CaseKey<MaxwellBranch>> keys{
      leaf("shear", required, "shear modulus of the branch's spring in {unit}",
           number(at(&MaxwellBranch::shear), positive, spring_modulus())),
      leaf("time", required, "time in {unit} in which the branch's stress relaxes",
           number(at(&MaxwellBranch::time), positive, quantity::time())),
  };
  return keys;
}

void read_branches(const CaseEntry& entry, MaterialData& layer) {
  if (!entry.is_array()) entry.refuse_name("is no list of branches", fmt::format("give {}", form));
  const auto given = entry.elements();
  if (given.empty()) entry.refuse_name("has no branch", fmt::format("give {}, or leave it out", form));
  if (given.size() > most_branches)
    entry.refuse(fmt::format("{} branches", given.size()), fmt::format("give at most {}", most_branches));
  for (const CaseEntry& branch : given) {
    if (!branch.is_section()) branch.refuse_value("is no branch", "give { shear = ..., time = ... }");
    read_keys(branch, branch_keys(), layer.maxwell.emplace_back());
  }
}

}  // namespace

CaseKey<MaterialData> layer_branches_key() {
  return {"maxwell", optional,
          "of any material: " + std::string(form) +
              ", branches of a spring (shear modulus in kPa) and a dashpot that relaxes it in a time (ms), beside the "
              "elastic law",
          read_branches, [](const MaterialData& layer, const std::string& path, std::vector<CaseValue>& values) {
            for (std::size_t i = 0; i < layer.maxwell.size(); ++i)
              list_keys(branch_keys(), layer.maxwell[i], fmt::format("{}[{}]", path, i), values);
          }};
}

void check_layer_branches(const CaseEntry& whole_case, const Case& scene) {
  if (!scene.structure || !scene.static_load) return;
  const CaseEntry layers = whole_case.child("structure").child("layers");
  for (const auto& [name, layer] : scene.structure->layers)
    if (!layer.maxwell.empty())
      layers.child(name).child("maxwell").refuse(
          "relaxes in time, which a static case has none of",
          "remove it: at rest its branches bear nothing; or replace [static] by [time]");
}

}  // namespace fsi
