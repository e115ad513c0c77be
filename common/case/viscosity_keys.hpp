#pragma once

#include "case/case_keys.hpp"

namespace fsi {

/// `fluid.viscosity_model`: the law that the viscosity follows, with its parameters.
CaseKey<FluidData> viscosity_model_key();

/// `fluid.viscosity` of the whole section: required where there is no law. Where there is one it may be absent, and is
/// the law's at the reference shear rate then.
void check_viscosity(const CaseEntry& fluid, FluidData& data);

/// `structure.layers.NAME.viscosity`, of any material. An elastic layer does not list it: its hash is that of before.
CaseKey<MaterialData> layer_viscosity_key();
/// Refuses it in a case without time. \throws InputError
void check_layer_viscosities(const CaseEntry& whole_case, const Case& scene);

}  // namespace fsi
