#pragma once

#include "case/case_keys.hpp"

namespace fsi {

/// `fluid.viscosity_model`: the law that the viscosity follows, with its parameters.
CaseKey<FluidData> viscosity_model_key();

/// Checks [fluid] as a whole: `viscosity` is required without a law. With a law it may be absent, and becomes the law's
/// at the reference shear rate (docs/theory.md, section 3.9). \throws InputError
void check_viscosity(const CaseEntry& fluid, FluidData& data);

/// `structure.layers.NAME.viscosity`, of any material. Elastic layers do not list it, so that the key does not change
/// their hash.
CaseKey<MaterialData> layer_viscosity_key();
/// Refuses it in a case without time. \throws InputError
void check_layer_viscosities(const CaseEntry& whole_case, const Case& scene);

}  // namespace fsi
