#pragma once

#include "case/case_keys.hpp"

namespace fsi {

/// `structure.layers.NAME.maxwell`, of any material: branches of spring and dashpot beside it. Layers without branches
/// do not list it, so that the key does not change their hash.
CaseKey<MaterialData> layer_branches_key();
/// Refuses it in a case without time. \throws InputError
void check_layer_branches(const CaseEntry& whole_case, const Case& scene);

}  // namespace fsi
